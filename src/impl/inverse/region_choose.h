/* region_choose.h: which subtrees a region holds whole: those that leave the least to be read */
#ifndef SLI_REGION_CHOOSE_H
#define SLI_REGION_CHOOSE_H

#include "selected_ask.h"
#include "region_parts.h"

/* The supernodes inside and the boundary while they are chosen, over the compiled reach of the set. A row
 * is in the boundary if it is asked for, or below a supernode inside, and not inside itself. */
typedef struct sli_choice {
    const sl_symbolic *S;
    uint64_t *seeds, *scratch; /* count: columns of the set, ascending */
    sl_int count;
    size_t most; /* bytes that a region with a boundary may have */
    sli_reach reach;
    sli_step *steps;          /* of the reach */
    sl_int *rows;             /* reach.n_rows */
    sl_off *rows_begin;       /* reach.count + 1 */
    uint64_t *order, *sorted; /* reach.count: steps by the size of their subtrees; scratch */
    sl_int *children;         /* reach.count: of each step, in the reach */
    sl_int *inside;           /* the same, those of them that are inside; */
    unsigned char *is_inside; /* is the step itself? */
    sl_int *wanted;           /* reach.columns: how many want each row in the boundary */
    sl_int n_roots, boundary; /* as it stands */
    double cost;              /* of L inside */
} sli_choice;

/* What a solve takes, in doubles read of L: those inside twice, and for the boundary a square. Half of that is
 * stored and read once from afar; counted so, patches of 2000 vertices would be solved 4 percent faster with a fifth
 * more bytes. A cost for each supernode moves the choice by less than what can be measured. */
SLI_INLINE double sli_choice_step(const sli_step *s) {
    return 2.0 * (double)sli_entries_from(s->width, s->below, s->first_tile);
}

SLI_INLINE double sli_choice_boundary(sl_int boundary) {
    return (double)boundary * ((double)boundary + 2.0 * SLI_REGION_COLUMNS);
}

SLI_INLINE double sli_choice_cost(const sli_choice *c) {
    return c->cost + sli_choice_boundary(c->boundary);
}

/* Does a region of so many rows and subtrees keep within its bytes? */
static int sli_region_bytes_fit(sl_int boundary, sl_int n_roots, size_t most) {
    sli_block b = {NULL, 0, 0};
    sl_region R;
    if (boundary == 0 || most == 0) {
        return 1;
    }
    if ((double)boundary * (double)boundary * (0.5 * sizeof(double)) > (double)most) {
        return 0; /* the sum over its chunks would take long to say so */
    }
    R.fence.n_rows = boundary;
    R.fence.n_roots = n_roots;
    sli_region_layout(&R, &b);
    return !b.overflow && b.used <= most;
}

SLI_INLINE int sli_choice_fits(const sli_choice *c) {
    return sli_region_bytes_fit(c->boundary, c->n_roots, c->most);
}

/* A step whose children in the reach all are inside goes in. */
static void sli_choice_enter(sli_choice *c, sl_int k) {
    const sli_step *step = &c->steps[k];
    const sl_int *rows = c->rows + c->rows_begin[k];
    sl_int i;
    for (i = 0; i < sli_step_columns(step); i++) {
        c->boundary -= c->wanted[step->base + i] > 0;
    }
    for (i = 0; i < step->below; i++) {
        c->boundary += c->wanted[rows[i]]++ == 0;
    }
    c->n_roots += 1 - c->inside[k];
    c->is_inside[k] = 1;
    c->cost += sli_choice_step(step);
    if (step->up != -1) {
        c->inside[step->up]++;
    }
}

/* A step whose parent is outside comes out again. */
static void sli_choice_leave(sli_choice *c, sl_int k) {
    const sli_step *step = &c->steps[k];
    const sl_int *rows = c->rows + c->rows_begin[k];
    sl_int i;
    if (step->up != -1) {
        c->inside[step->up]--;
    }
    c->cost -= sli_choice_step(step);
    c->is_inside[k] = 0;
    c->n_roots -= 1 - c->inside[k];
    for (i = 0; i < step->below; i++) {
        c->boundary -= --c->wanted[rows[i]] == 0;
    }
    for (i = 0; i < sli_step_columns(step); i++) {
        c->boundary += c->wanted[step->base + i] > 0;
    }
}

/* All supernodes go in, those with small subtrees first, and come out again to where the cost was least. */
static void sli_choice_sweep(sli_choice *c) {
    const sl_int count = c->reach.count;
    sl_int k, best = 0;
    double least = sli_choice_fits(c) ? sli_choice_cost(c) : HUGE_VAL;
    for (k = 0; k < count; k++) {
        double cost;
        sli_choice_enter(c, sli_value(c->order[k]));
        cost = sli_choice_cost(c);
        if (cost < least && sli_choice_fits(c)) {
            least = cost;
            best = k + 1;
        }
    }
    if (least == HUGE_VAL) {
        best = count;
    }
    for (k = count; k > best; k--) {
        sli_choice_leave(c, sli_value(c->order[k - 1]));
    }
}

/* Most times that the rim is looked over. */
#define SLI_REGION_PASSES 8

/* Single supernodes at the rim go in or out while that makes the cost less. */
static void sli_choice_improve(sli_choice *c) {
    sl_int pass, k;
    int is_better = 1;
    for (pass = 0; pass < SLI_REGION_PASSES && is_better; pass++) {
        is_better = 0;
        for (k = 0; k < c->reach.count; k++) {
            const sl_int up = c->steps[k].up;
            const double before = sli_choice_cost(c);
            if (!c->is_inside[k] && c->inside[k] == c->children[k]) {
                sli_choice_enter(c, k);
                if (sli_choice_cost(c) < before && sli_choice_fits(c)) {
                    is_better = 1;
                } else {
                    sli_choice_leave(c, k);
                }
            } else if (c->is_inside[k] && (up == -1 || !c->is_inside[up])) {
                sli_choice_leave(c, k);
                if (sli_choice_cost(c) < before && sli_choice_fits(c)) {
                    is_better = 1;
                } else {
                    sli_choice_enter(c, k);
                }
            }
        }
    }
}

/* How many times the cost may be if the inverse then can be read: on grids of 1e5 and 1e6 vertices 37 and 21 of 100
 * patches of 2000 take it, are solved in 1.3 times the time, and made in a third and a thirtieth (bench region). */
#define SLI_REGION_DETOUR 2.0

/* The subtree of one supernode that holds the whole set, where it costs little more than what is chosen: the rows
 * below it are among themselves on the pattern of L, so that a selected inverse has their part. */
static void sli_choice_one(sli_choice *c) {
    const sl_symbolic *S = c->S;
    double inside = 0.0, least = SLI_REGION_DETOUR * sli_choice_cost(c);
    sl_int k, first, last, best = -1;
    if (c->count == 0) {
        return;
    }
    first = S->super_of[sli_key(c->seeds[0])];
    last = S->super_of[sli_key(c->seeds[c->count - 1])];
    for (k = 0; k < c->reach.count; k++) {
        const sli_step *step = &c->steps[k];
        const sl_int s = S->super_of[step->column];
        inside += sli_choice_step(step);
        if (s >= last && S->descendant[s] <= first &&
            inside + sli_choice_boundary(step->below) <= least &&
            sli_region_bytes_fit(step->below, 1, c->most)) {
            least = inside + sli_choice_boundary(step->below);
            best = k;
        }
    }
    for (k = c->reach.count - 1; k >= 0 && best >= 0; k--) {
        if (c->is_inside[k]) {
            sli_choice_leave(c, k);
        }
    }
    for (k = 0; k <= best; k++) {
        sli_choice_enter(c, k);
    }
}

static void sli_choice_layout_reach(sli_choice *c, sli_block *b) {
    const uint64_t count = (uint64_t)c->reach.count;
    c->steps = SLI_TAKE(b, sli_step, count);
    c->rows = SLI_TAKE(b, sl_int, c->reach.n_rows);
    c->rows_begin = SLI_TAKE(b, sl_off, count + 1);
    c->order = SLI_TAKE(b, uint64_t, count);
    c->sorted = SLI_TAKE(b, uint64_t, count);
    c->children = SLI_TAKE(b, sl_int, count);
    c->inside = SLI_TAKE(b, sl_int, count);
    c->is_inside = SLI_TAKE(b, unsigned char, count);
    c->wanted = SLI_TAKE(b, sl_int, c->reach.columns);
}

/* Nothing inside: the set is the boundary. */
static void sli_choice_begin(sli_choice *c) {
    const sl_symbolic *S = c->S;
    sl_int k, at = 0;
    sli_reach_fill(S, c->seeds, c->count, c->steps, c->rows, &c->reach);
    memset(c->children, 0, (size_t)c->reach.count * sizeof *c->children);
    memset(c->inside, 0, (size_t)c->reach.count * sizeof *c->inside);
    memset(c->is_inside, 0, (size_t)c->reach.count);
    memset(c->wanted, 0, (size_t)c->reach.columns * sizeof *c->wanted);
    c->rows_begin[0] = 0;
    for (k = 0; k < c->reach.count; k++) {
        const sl_int s = S->super_of[c->steps[k].column];
        c->rows_begin[k + 1] = c->rows_begin[k] + c->steps[k].below;
        c->order[k] = sli_keyed(S->super_first[s + 1] - S->super_first[S->descendant[s]], k);
        if (c->steps[k].up != -1) {
            c->children[c->steps[k].up]++;
        }
    }
    sli_sort(c->order, c->reach.count, c->sorted);
    c->n_roots = 0;
    c->boundary = c->count;
    c->cost = 0.0;
    for (k = 0; k < c->count; k++) {
        c->wanted[sli_reach_place(&c->reach, &at, sli_key(c->seeds[k]))] = 1;
    }
}

/* Rows of A as columns of L, ascending, each once. NULL: all. */
static sl_status sli_choice_sort(sli_choice *c, const sl_int *set, sl_stats *stats) {
    const sl_symbolic *S = c->S;
    sl_int k, once = 0;
    sl_status status = SL_OK;
    if (set == NULL) {
        for (k = 0; k < c->count; k++) {
            c->seeds[k] = sli_keyed(k, 0);
        }
        return SL_OK;
    }
    status = sli_selected_sort(S, set, c->count, c->seeds, c->scratch, stats);
    for (k = 0; k < c->count && status == SL_OK; k++) {
        if (k == 0 || c->seeds[k] != c->seeds[k - 1]) {
            c->seeds[once++] = c->seeds[k];
        }
    }
    c->count = once;
    return status;
}

#endif

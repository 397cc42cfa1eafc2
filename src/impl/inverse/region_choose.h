/* region_choose.h: chooses the subtrees and the boundary of a region for the cheapest solves */
#ifndef SLI_INVERSE_REGION_CHOOSE_H
#define SLI_INVERSE_REGION_CHOOSE_H

#include "row_sets.h"
#include "region_types.h"

/* The state of the choice: which supernodes of the compiled reach of the set are inside the region.
 * A row is in the boundary if it is not inside and either belongs to the set or is below a
 * supernode inside. */
typedef struct sli_choice {
    const sl_symbolic *S;
    uint64_t *seeds, *scratch; /* count: columns of the set, ascending */
    sl_int count;
    int may_copy;     /* the numbers can be those of a selected inverse */
    size_t bytes_max; /* of a region that has a boundary; 0: no limit */
    sli_reach reach;
    sli_step *steps;          /* of the reach */
    sl_int *rows;             /* reach.n_rows */
    sl_off *rows_begin;       /* reach.count + 1 */
    uint64_t *order, *sorted; /* reach.count: steps by the size of their subtrees; scratch */
    sl_int *n_children;       /* reach.count: children of each step in the reach */
    sl_int *n_inside;         /* reach.count: children of each step that are inside */
    unsigned char *is_inside; /* reach.count: is the step inside? */
    /* reach.columns: supernodes inside that have the row below them, plus 1 if the set has it */
    sl_int *needed;
    sl_int n_roots, boundary; /* subtrees and rows of the boundary of the current choice */
    double cost;              /* of L inside */
} sli_choice;

/* The cost of a solve, in doubles read of L: supernodes inside count twice, the boundary counts its
 * square. Only half of the square is stored, and it is read from memory once; counting that instead
 * would make solves of patches of 2000 vertices 4 % faster, but their regions a fifth larger. A
 * constant per supernode changes the choice by less than can be measured. */
SLI_INLINE double sli_choice_step_cost(const sli_step *s) {
    return 2.0 * (double)sli_entries_from(s->width, s->below, s->first_tile);
}

SLI_INLINE double sli_choice_boundary_cost(sl_int boundary) {
    return (double)boundary * ((double)boundary + 2.0 * SLI_REGION_COLUMNS);
}

SLI_INLINE double sli_choice_cost(const sli_choice *c) {
    return c->cost + sli_choice_boundary_cost(c->boundary);
}

/* Is a region with this boundary and number of subtrees within the limit of bytes? */
static int sli_region_bytes_fit(sl_int boundary, sl_int n_roots, size_t bytes_max) {
    sli_block b = {NULL, 0};
    sl_region R;
    SLI_CLEAR(R);
    if (boundary == 0 || bytes_max == 0) {
        return 1;
    }
    if ((double)boundary * (double)boundary * (0.5 * sizeof(double)) > (double)bytes_max) {
        return 0; /* decided without the slow sum over the chunks of the layout */
    }
    R.extent.n_rows = boundary;
    R.extent.n_roots = n_roots;
    sli_region_layout(&R, &b);
    return b.used <= bytes_max;
}

SLI_INLINE int sli_choice_fits(const sli_choice *c) {
    return sli_region_bytes_fit(c->boundary, c->n_roots, c->bytes_max);
}

/* Adds a step to the inside; all of its children in the reach are inside. */
static void sli_choice_add(sli_choice *c, sl_int k) {
    const sli_step *step = &c->steps[k];
    const sl_int *rows = c->rows + c->rows_begin[k];
    sl_int i;
    for (i = 0; i < sli_step_columns(step); i++) {
        c->boundary -= c->needed[step->base + i] > 0;
    }
    for (i = 0; i < step->below; i++) {
        c->boundary += c->needed[rows[i]]++ == 0;
    }
    c->n_roots += 1 - c->n_inside[k];
    c->is_inside[k] = 1;
    c->cost += sli_choice_step_cost(step);
    if (step->up != -1) {
        c->n_inside[step->up]++;
    }
}

/* Removes a step from the inside; its parent is outside. */
static void sli_choice_remove(sli_choice *c, sl_int k) {
    const sli_step *step = &c->steps[k];
    const sl_int *rows = c->rows + c->rows_begin[k];
    sl_int i;
    if (step->up != -1) {
        c->n_inside[step->up]--;
    }
    c->cost -= sli_choice_step_cost(step);
    c->is_inside[k] = 0;
    c->n_roots -= 1 - c->n_inside[k];
    for (i = 0; i < step->below; i++) {
        c->boundary -= --c->needed[rows[i]] == 0;
    }
    for (i = 0; i < sli_step_columns(step); i++) {
        c->boundary += c->needed[step->base + i] > 0;
    }
}

/* Adds all supernodes, those with small subtrees first, then goes back to the choice with the least
 * cost. One fits: with all supernodes inside there is no boundary. */
static void sli_choice_sweep(sli_choice *c) {
    const sl_int count = c->reach.count;
    sl_int k, best = 0;
    double least = sli_choice_fits(c) ? sli_choice_cost(c) : HUGE_VAL;
    for (k = 0; k < count; k++) {
        double cost;
        sli_choice_add(c, sli_value(c->order[k]));
        cost = sli_choice_cost(c);
        if (cost < least && sli_choice_fits(c)) {
            least = cost;
            best = k + 1;
        }
    }
    for (k = count; k > best; k--) {
        sli_choice_remove(c, sli_value(c->order[k - 1]));
    }
}

/* Bound on the passes over the supernodes. */
#define SLI_REGION_PASSES 8

/* Adds or removes single supernodes at the border of the subtrees while that lowers the cost. */
static void sli_choice_improve(sli_choice *c) {
    sl_int pass, k;
    int is_better = 1;
    for (pass = 0; is_better; pass++) {
        if (pass == SLI_REGION_PASSES) { /* untested: there are fewer passes */
            break;                       /* untested: the same */
        }
        is_better = 0;
        for (k = 0; k < c->reach.count; k++) {
            const sl_int up = c->steps[k].up;
            const double before = sli_choice_cost(c);
            if (!c->is_inside[k] && c->n_inside[k] == c->n_children[k]) {
                sli_choice_add(c, k);
                if (sli_choice_cost(c) < before) { /* with a smaller boundary, which fits */
                    is_better = 1;
                } else {
                    sli_choice_remove(c, k);
                }
            } else if (c->is_inside[k] && (up == -1 || !c->is_inside[up])) {
                sli_choice_remove(c, k);
                if (sli_choice_cost(c) < before && sli_choice_fits(c)) {
                    is_better = 1;
                } else {
                    sli_choice_add(c, k);
                }
            }
        }
    }
}

/* How many times as much a solve may cost if the entries can then be copied from a selected
 * inverse. On grids of 1e5 and 1e6 vertices, 37 and 21 of 100 patches of 2000 vertices choose that;
 * they are solved in 1.3 times the time, and their regions made in a third and a thirtieth (bench
 * region). */
#define SLI_REGION_DETOUR 2.0

/* Chooses the subtree of one supernode that holds the whole set, if it costs at most
 * SLI_REGION_DETOUR times the choice so far. The rows below one supernode are pairwise in the
 * pattern of L, so a selected inverse has all entries between them. */
static void sli_choice_single_subtree(sli_choice *c) {
    const sl_symbolic *S = c->S;
    double inside = 0.0, least = SLI_REGION_DETOUR * sli_choice_cost(c);
    sl_int k, first, last, best = -1;
    SLI_ASSERT(c->count > 0); /* there is a boundary */
    first = S->super_of[sli_key(c->seeds[0])];
    last = S->super_of[sli_key(c->seeds[c->count - 1])];
    for (k = 0; k < c->reach.count; k++) {
        const sli_step *step = &c->steps[k];
        const sl_int s = S->super_of[step->column];
        inside += sli_choice_step_cost(step);
        if (s >= last && S->first_descendant[s] <= first &&
            inside + sli_choice_boundary_cost(step->below) <= least &&
            sli_region_bytes_fit(step->below, 1, c->bytes_max)) {
            least = inside + sli_choice_boundary_cost(step->below);
            best = k;
        }
    }
    for (k = c->reach.count - 1; k >= 0 && best >= 0; k--) {
        if (c->is_inside[k]) {
            sli_choice_remove(c, k);
        }
    }
    for (k = 0; k <= best; k++) {
        sli_choice_add(c, k);
    }
}

static void sli_choice_layout_reach(sli_choice *c, sli_block *b) {
    const uint64_t count = (uint64_t)c->reach.count;
    c->steps = SLI_TAKE(b, sli_step, count);
    c->rows = SLI_TAKE(b, sl_int, c->reach.n_rows);
    c->rows_begin = SLI_TAKE(b, sl_off, count + 1);
    c->order = SLI_TAKE(b, uint64_t, count);
    c->sorted = SLI_TAKE(b, uint64_t, count);
    c->n_children = SLI_TAKE(b, sl_int, count);
    c->n_inside = SLI_TAKE(b, sl_int, count);
    c->is_inside = SLI_TAKE(b, unsigned char, count);
    c->needed = SLI_TAKE(b, sl_int, c->reach.columns);
}

/* Starts with no supernode inside: the boundary is the set. */
static void sli_choice_init(sli_choice *c) {
    const sl_symbolic *S = c->S;
    sl_int k, at = 0;
    sli_reach_fill(S, c->seeds, c->count, c->steps, c->rows, &c->reach);
    SLI_ZERO(c->n_children, c->reach.count);
    SLI_ZERO(c->n_inside, c->reach.count);
    SLI_ZERO(c->is_inside, c->reach.count);
    SLI_ZERO(c->needed, c->reach.columns);
    c->rows_begin[0] = 0;
    for (k = 0; k < c->reach.count; k++) {
        const sl_int s = S->super_of[c->steps[k].column];
        c->rows_begin[k + 1] = c->rows_begin[k] + c->steps[k].below;
        c->order[k] = sli_keyed(S->super_first[s + 1] - S->super_first[S->first_descendant[s]], k);
        if (c->steps[k].up != -1) {
            c->n_children[c->steps[k].up]++;
        }
    }
    sli_sort(c->order, c->reach.count, c->sorted);
    c->n_roots = 0;
    c->boundary = c->count;
    c->cost = 0.0;
    for (k = 0; k < c->count; k++) {
        c->needed[sli_reach_index(&c->reach, &at, sli_key(c->seeds[k]))] = 1;
    }
}

/* Sorts the rows of A by column of L, without repetitions. NULL: all rows. */
static sl_status sli_choice_sort(sli_choice *c, const sl_int *set, sl_stats *stats) {
    const sl_symbolic *S = c->S;
    sl_int k, unique = 0;
    sl_status status = SL_OK;
    if (set == NULL) {
        for (k = 0; k < c->count; k++) {
            c->seeds[k] = sli_keyed(k, 0);
        }
        return SL_OK;
    }
    status = sli_sort_rows(S, set, c->count, c->seeds, c->scratch, stats);
    for (k = 0; k < c->count && status == SL_OK; k++) {
        if (k == 0 || c->seeds[k] != c->seeds[k - 1]) {
            c->seeds[unique++] = c->seeds[k];
        }
    }
    c->count = unique;
    return status;
}

#endif

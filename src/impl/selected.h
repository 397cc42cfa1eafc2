/* selected.h: the selected inverse: a sweep from the roots to the leaves, each front gathered from its parent's */
#ifndef SLI_SELECTED_H
#define SLI_SELECTED_H

#include "../public/selected.h"
#include "factor.h"
#include "reach.h"
#include "work.h"

/* The sweep, planned: a front must stay until the last of its children has taken its part, and children come
 * last to first. Fronts of even and of odd depth have a stack each, which grow towards each other: when
 * a front is made, its parent's is the top of the other stack. */
typedef struct sli_descent {
    sl_int *up;     /* count: the parent, as a number in the list of supernodes, -1 at a root */
    sl_int *last;   /* count: the child that comes last, -1 where there is none */
    sl_int *side;   /* count: depth % 2 */
    sl_off *front;  /* count: where the front begins, in doubles */
    sl_off fronts;  /* doubles for all of them */
    sl_off scratch; /* doubles for the kernels */
} sli_descent;

struct sl_selected {
    sl_allocator allocator;
    const sl_symbolic *S; /* borrowed */
    const sl_factor *F;   /* Z is its inverse, and .. */
    uint64_t generation;  /* .. of these numbers of it */
    sl_int count;         /* supernodes */
    sl_int *supers;       /* count, ascending */
    sl_off *begin;        /* count + 1: the panels, in doubles */
    double *Z;
    sli_descent descent;
    size_t bytes;
};

/* The supernodes of the reach of seeds, columns of L in ascending order. */
static void sli_selected_reach(sl_selected *Z, const uint64_t *seeds, sl_int count) {
    const sl_symbolic *S = Z->S;
    sl_int k = 0, at = 0, s, next;
    while (k < count) {
        s = S->super_of[sli_key(seeds[k])];
        next = sli_next_seed(S, seeds, count, &k);
        for (; s != -1 && s < next; s = S->super_parent[s]) {
            Z->supers[at++] = s;
        }
    }
    SLI_ASSERT(at == Z->count);
}

static void sli_selected_layout(sl_selected *Z, sli_block *b) {
    (void)sli_take(b, 1, sizeof(sl_selected));
    Z->supers = SLI_TAKE(b, sl_int, Z->count);
    Z->begin = SLI_TAKE(b, sl_off, (uint64_t)Z->count + 1);
    Z->descent.up = SLI_TAKE(b, sl_int, Z->count);
    Z->descent.last = SLI_TAKE(b, sl_int, Z->count);
    Z->descent.side = SLI_TAKE(b, sl_int, Z->count);
    Z->descent.front = SLI_TAKE(b, sl_off, Z->count);
    Z->bytes = b->used;
}

/* Rows of A as columns of L, ascending, for a reach. */
static sl_status sli_selected_sort(const sl_symbolic *S, const sl_int *set, sl_int count,
                                   uint64_t *seeds, uint64_t *scratch, sl_stats *stats) {
    sl_int k;
    for (k = 0; k < count; k++) {
        if (set[k] < 0 || set[k] >= S->n) {
            return sli_fail_at(stats, SL_ERR_ARGUMENT, set[k], -1, 0.0);
        }
        seeds[k] = sli_keyed(S->iperm[set[k]], 0);
    }
    sli_sort(seeds, count, scratch);
    return SL_OK;
}

/* The object, all but its numbers. */
static sl_status sli_selected_list(sl_selected **out, const sl_symbolic *S, const sl_int *set,
                                   sl_int count, const sl_allocator *a, sl_stats *stats) {
    sli_block temporary = {NULL, 0, 0}, kept = {NULL, 0, 0};
    uint64_t *seeds = NULL, *scratch = NULL;
    sl_selected draft;
    sl_status status = SL_OK;
    sl_int k;
    int pass;
    memset(&draft, 0, sizeof draft);
    draft.allocator = *a;
    draft.S = S;
    draft.count = S->n_supers;
    if (set != NULL) {
        sli_reach R;
        for (pass = 0; pass < 2 && status == SL_OK; pass++) {
            seeds = SLI_TAKE(&temporary, uint64_t, count);
            scratch = SLI_TAKE(&temporary, uint64_t, count);
            status = pass == 0 ? sli_block_alloc(&temporary, a) : SL_OK;
        }
        if (status == SL_OK) {
            status = sli_selected_sort(S, set, count, seeds, scratch, stats);
        }
        if (status == SL_OK) {
            sli_reach_measure(S, seeds, count, &R);
            draft.count = R.count;
        }
    }
    for (pass = 0; pass < 2 && status == SL_OK; pass++) {
        sli_selected_layout(&draft, &kept);
        status = pass == 0 ? sli_block_alloc(&kept, a) : SL_OK;
    }
    if (status == SL_OK) {
        for (k = 0; k < draft.count && set == NULL; k++) {
            draft.supers[k] = k;
        }
        if (set != NULL) {
            sli_selected_reach(&draft, seeds, count);
        }
        draft.begin[0] = 0;
        for (k = 0; k < draft.count; k++) {
            const sl_int s = draft.supers[k];
            draft.begin[k + 1] = draft.begin[k] + (S->panel_begin[s + 1] - S->panel_begin[s]);
        }
        *out = (sl_selected *)(void *)kept.base;
        **out = draft;
    }
    sli_free(a, temporary.base);
    return status;
}

/* Doubles of a front: whole row tiles of all its columns. */
SLI_INLINE sl_off sli_square_size(const sli_step *s) {
    const sl_int h = s->width + s->below;
    return (sl_off)SLI_TILE * sli_tiles(h) * h;
}

/* Parents, and the child that comes last. A supernode's parent is the next one of the chain of ancestors at hand
 * that is not below it, as the list is in postorder and closed under the parent relation. */
static void sli_descent_tree(sli_descent *d, const sl_selected *Z) {
    const sl_symbolic *S = Z->S;
    sl_int k, up = -1;
    for (k = Z->count - 1; k >= 0; k--) {
        const sl_int parent = S->super_parent[Z->supers[k]];
        while (up != -1 && Z->supers[up] != parent) {
            up = d->up[up];
        }
        d->up[k] = up;
        d->last[k] = -1;
        d->side[k] = 0;
        if (up != -1) {
            d->last[up] = k;
            d->side[k] = 1 - d->side[up];
        }
        up = k;
    }
}

static void sli_descent_plan(sli_descent *d, const sl_selected *Z) {
    const sl_symbolic *S = Z->S;
    sl_off top[2] = {0, 0};
    sl_int k, tallest = 0, widest = 0;
    sli_descent_tree(d, Z);
    d->fronts = 0;
    for (k = Z->count - 1; k >= 0; k--) {
        const sli_step *step = &S->steps[Z->supers[k]];
        const sl_off size = sli_square_size(step);
        const sl_int side = d->side[k], up = d->up[k];
        d->front[k] = side == 0 ? top[0] : -(top[1] + size);
        top[side] += size;
        d->fronts = top[0] + top[1] > d->fronts ? top[0] + top[1] : d->fronts;
        if (up != -1 && d->last[up] == k) {
            top[1 - side] -= sli_square_size(&S->steps[Z->supers[up]]);
        }
        if (d->last[k] == -1) {
            top[side] -= size;
        }
        tallest = sli_max(tallest, step->width + step->below);
        widest = sli_max(widest, step->width);
    }
    for (k = 0; k < Z->count; k++) { /* the second stack counts from the end, which is known now */
        d->front[k] += d->side[k] == 0 ? 0 : d->fronts;
    }
    d->scratch = sli_dual_scratch(tallest, widest);
}

/* The columns of a front to the panel. */
static void sli_selected_keep(const sli_dual *f, double *panel) {
    const sl_int w = f->width, h = w + f->below, tiles = sli_tiles(h);
    sl_int t, j;
    for (t = 0; t < tiles; t++) {
        double *to = panel + sli_tile_offset(w, t);
        const sl_int columns = sli_min(w, SLI_TILE * (t + 1)), rows = h - SLI_TILE * t;
        memcpy(to, f->front + sli_square_offset(h, t), SLI_TILE * (size_t)columns * sizeof *to);
        for (j = 0; j < columns && rows < SLI_TILE; j++) { /* padding */
            memset(to + SLI_TILE * (ptrdiff_t)j + rows, 0, (size_t)(SLI_TILE - rows) * sizeof *to);
        }
    }
}

/* Most of a panel that is asked for before its turn: read from the last to the first they meet no hardware that runs
 * ahead of them, and waiting for L was a fifth of all time on 2D meshes. */
#define SLI_PANEL_AHEAD ((sl_off)1024)

static void sli_selected_prefetch(const double *panel, sl_off size) {
    sl_off k;
    for (k = 0; k < size && k < SLI_PANEL_AHEAD; k += SLI_TILE) {
        SLI_PREFETCH(panel + k, 0);
    }
}

/* All fronts, parents before children. */
static void sli_selected_sweep(sl_selected *Z, const sl_factor *F, const sli_descent *d,
                               double *fronts, double *scratch) {
    const sl_symbolic *S = Z->S;
    sl_int k;
    for (k = Z->count - 1; k >= 0; k--) {
        const sl_int s = Z->supers[k], up = d->up[k];
        const sli_step *step = &S->steps[s];
        sli_dual f;
        f.panel = F->L + step->panel;
        f.D = F->D + step->column;
        f.front = fronts + d->front[k];
        f.width = step->width;
        f.below = step->below;
        if (up != -1) {
            const sli_step *parent = &S->steps[Z->supers[up]];
            F->kernels->gather(&f, fronts + d->front[up], parent->width + parent->below,
                               S->places + S->rows_begin[s]);
        }
        if (k > 0) {
            const sl_int next = Z->supers[k - 1];
            sli_selected_prefetch(F->L + S->panel_begin[next],
                                  S->panel_begin[next + 1] - S->panel_begin[next]);
        }
        F->kernels->takahashi(&f, scratch);
        sli_selected_keep(&f, Z->Z + Z->begin[k]);
    }
}

/* The numbers, in a workspace. F fits. */
static sl_status sli_selected_fill(sl_selected *Z, const sl_factor *F, sl_work *W) {
    sli_block b = {NULL, 0, 0};
    double *fronts = NULL, *scratch = NULL;
    sl_status status = SL_OK;
    int pass;
    for (pass = 0; pass < 2 && status == SL_OK; pass++) {
        fronts = SLI_TAKE(&b, double, Z->descent.fronts);
        scratch = SLI_TAKE(&b, double, Z->descent.scratch);
        if (pass == 0) {
            status = b.overflow ? SL_ERR_TOO_LARGE : sli_work_grow(W, b.used);
            b.base = (unsigned char *)W->block;
            b.used = 0;
        }
    }
    if (status == SL_OK) {
        sli_selected_sweep(Z, F, &Z->descent, fronts, scratch);
        Z->F = F;
        Z->generation = F->generation;
    }
    return status;
}

/* The same in the caller's workspace, or in one for this call. */
static sl_status sli_selected_fill_in(sl_selected *Z, const sl_factor *F, sl_work *W) {
    sl_work own;
    sl_status status;
    own.allocator = Z->allocator;
    own.block = NULL;
    own.size = 0;
    status = sli_selected_fill(Z, F, W == NULL ? &own : W);
    sli_free(&own.allocator, own.block);
    return status;
}

/* Room for the numbers. */
static sl_status sli_selected_room(sl_selected *Z) {
    sli_block b = {NULL, 0, 0};
    sl_status status = SL_OK;
    int pass;
    for (pass = 0; pass < 2 && status == SL_OK; pass++) {
        Z->Z = SLI_TAKE(&b, double, Z->begin[Z->count]);
        Z->bytes += pass == 0 ? b.used : 0;
        status = pass == 0 ? sli_block_alloc(&b, &Z->allocator) : SL_OK;
    }
    return status;
}

static void sli_selected_stats(const sl_selected *Z, double started, sl_stats *stats) {
    sl_int k;
    if (stats != NULL) {
        stats->z_supernodes = Z->count;
        stats->z_columns = 0;
        for (k = 0; k < Z->count; k++) {
            stats->z_columns += Z->S->steps[Z->supers[k]].width;
        }
        stats->z_entries = Z->begin[Z->count];
        stats->seconds_selected = sli_seconds() - started;
        stats->bytes_selected = Z->bytes;
    }
}

SL_API sl_status sl_selected_create(sl_selected **out, const sl_factor *F, const sl_int *set,
                                    sl_int count, const sl_options *opt, sl_stats *stats) {
    const double started = sli_seconds();
    const sl_allocator a = sli_allocator(opt);
    sl_selected *Z = NULL;
    sl_status status;
    sli_stats_clear_error(stats);
    if (out == NULL) {
        return SL_ERR_ARGUMENT;
    }
    *out = NULL;
    if (F == NULL || (set != NULL && count < 0) || !sli_allocator_is_whole(opt)) {
        return SL_ERR_ARGUMENT;
    }
    if (!F->is_good) {
        return SL_ERR_STATE;
    }
    status = sli_selected_list(&Z, F->S, set, count, &a, stats);
    if (status == SL_OK) {
        sli_descent_plan(&Z->descent, Z);
        status = sli_selected_room(Z);
    }
    if (status == SL_OK) {
        status = sli_selected_fill_in(Z, F, NULL);
    }
    if (status == SL_OK) {
        sli_selected_stats(Z, started, stats);
        *out = Z;
    } else {
        sl_selected_free(Z);
    }
    return status;
}

SL_API sl_status sl_selected_refill(sl_selected *Z, const sl_factor *F, sl_work *W) {
    if (Z == NULL || F == NULL) {
        return SL_ERR_ARGUMENT;
    }
    return F->is_good && F->S == Z->S ? sli_selected_fill_in(Z, F, W) : SL_ERR_STATE;
}

SL_API void sl_selected_free(sl_selected *Z) {
    if (Z != NULL) {
        const sl_allocator a = Z->allocator;
        sli_free(&a, Z->Z);
        sli_free(&a, Z);
    }
}

/* The place of supernode s in the list, or -1. */
SLI_INLINE sl_int sli_selected_find(const sl_selected *Z, sl_int s) {
    sl_int at = s;
    if (Z->count < Z->S->n_supers) {
        at = sli_lower_bound(Z->supers, Z->count, s);
    }
    return at < Z->count && Z->supers[at] == s ? at : -1;
}

/* Where the entry of pivots k and l stands in Z, or -1. */
static sl_off sli_selected_at(const sl_selected *Z, sl_int k, sl_int l) {
    const sl_symbolic *S = Z->S;
    const sl_int column = sli_min(k, l), row = sli_max(k, l), s = S->super_of[column];
    const sl_int at = sli_selected_find(Z, s), first = S->super_first[s];
    const sl_int width = S->steps[s].width, below = S->steps[s].below;
    sl_int r = row - first;
    if (at == -1) {
        return -1;
    }
    if (r >= width) {
        const sl_int *rows = S->rows + S->rows_begin[s];
        const sl_int i = sli_lower_bound(rows, below, row);
        if (i == below || rows[i] != row) {
            return -1;
        }
        r = width + i;
    }
    return Z->begin[at] + sli_panel_at(width, r, column - first);
}

/* All entries asked for are looked up before the first is written: out stays untouched on error. */
static sl_status sli_selected_ask(const sl_selected *Z, double *out, const sl_int *rows,
                                  const sl_int *columns, sl_int count, sl_stats *stats) {
    const sl_symbolic *S = Z->S;
    sl_int k;
    int pass;
    for (pass = 0; pass < 2; pass++) {
        for (k = 0; k < count; k++) {
            const sl_int i = rows == NULL ? k : rows[k], j = columns == NULL ? i : columns[k];
            sl_off at;
            if (pass == 0 && (i < 0 || i >= S->n || j < 0 || j >= S->n)) {
                return sli_fail_at(stats, SL_ERR_ARGUMENT, i, columns == NULL ? -1 : j, 0.0);
            }
            at = sli_selected_at(Z, S->iperm[i], S->iperm[j]);
            if (at == -1) {
                return sli_fail_at(stats, SL_ERR_PATTERN, i, columns == NULL ? -1 : j, 0.0);
            }
            if (pass == 1) {
                out[k] = Z->Z[at];
            }
        }
    }
    return SL_OK;
}

/* The diagonal in the order of the panels: looked up row by row it took a twelfth of the whole time. */
static void sli_selected_all(const sl_selected *Z, double *out) {
    const sl_symbolic *S = Z->S;
    sl_int s, j;
    for (s = 0; s < S->n_supers; s++) {
        const sl_int width = S->steps[s].width, *row = S->perm + S->super_first[s];
        for (j = 0; j < width; j++) {
            out[row[j]] = Z->Z[Z->begin[s] + sli_panel_at(width, j, j)];
        }
    }
}

SL_API sl_status sl_selected_diagonal(const sl_selected *Z, double *out, const sl_int *rows,
                                      sl_int count, sl_stats *stats) {
    sli_stats_clear_error(stats);
    if (Z == NULL || (rows != NULL && count < 0)) {
        return SL_ERR_ARGUMENT;
    }
    count = rows == NULL ? Z->S->n : count;
    if (count > 0 && out == NULL) {
        return SL_ERR_ARGUMENT;
    }
    if (rows == NULL && Z->count == Z->S->n_supers) {
        sli_selected_all(Z, out);
        return SL_OK;
    }
    return sli_selected_ask(Z, out, rows, NULL, count, stats);
}

SL_API sl_status sl_selected_entries(const sl_selected *Z, double *out, const sl_int *rows,
                                     const sl_int *columns, sl_int count, sl_stats *stats) {
    sli_stats_clear_error(stats);
    if (Z == NULL || count < 0 || (count > 0 && (out == NULL || rows == NULL || columns == NULL))) {
        return SL_ERR_ARGUMENT;
    }
    return sli_selected_ask(Z, out, rows, columns, count, stats);
}

SL_API sl_selected_view_t sl_selected_view(const sl_selected *Z) {
    sl_selected_view_t v = {NULL, 0, NULL, NULL, NULL};
    if (Z != NULL) {
        v.symbolic = Z->S;
        v.count = Z->count;
        v.supers = Z->supers;
        v.begin = Z->begin;
        v.Z = Z->Z;
    }
    return v;
}

#endif

/* region_ending.h: solves that end at the boundary of a region: sets, chunks, the product with Z */
#ifndef SLI_INVERSE_REGION_ENDING_H
#define SLI_INVERSE_REGION_ENDING_H

#include "../solve/compile.h"
#include "region_types.h"

SLI_INLINE const sl_region *sli_region_of(const sli_ending *e) {
    return (const sl_region *)(const void *)e;
}

static int sli_region_belongs(const sli_ending *e, const sl_symbolic *S) {
    const sl_region *R = sli_region_of(e);
    return R->S == S;
}

/* Is every row of a sorted set in the region? The set of all rows counts as outside. */
static int sli_set_is_within(const sl_symbolic *S, const sli_set *set,
                             const sli_region_extent *extent) {
    sl_int k;
    for (k = 0; set->rows != NULL && k < set->count; k++) {
        const sl_int column = sli_key(set->seeds[k]);
        if (sli_extent_find(S, extent, S->super_of[column]) == -1 &&
            sli_extent_boundary(extent, column) == -1) {
            return 0;
        }
    }
    return set->rows != NULL;
}

/* Assigns a set to the region that contains it: seeds in subtrees first, boundary rows after them,
 * both ascending. */
static void sli_set_partition(const sl_symbolic *S, sli_set *set, const sli_region_extent *extent) {
    sl_int k, inside = 0, rest = 0;
    for (k = 0; k < set->count; k++) {
        if (sli_extent_find(S, extent, S->super_of[sli_key(set->seeds[k])]) != -1) {
            set->seeds[inside++] = set->seeds[k];
        } else {
            set->scratch[rest++] = set->seeds[k];
        }
    }
    for (k = 0; k < rest; k++) {
        set->seeds[inside + k] = set->scratch[k];
    }
    set->inside = inside;
    set->extent = extent;
}

static int sli_region_place(const sli_ending *e, sli_set *b, sli_set *x) {
    const sl_region *R = sli_region_of(e);
    if (!sli_set_is_within(R->S, b, &R->extent) || !sli_set_is_within(R->S, x, &R->extent)) {
        return 0;
    }
    sli_set_partition(R->S, b, &R->extent);
    sli_set_partition(R->S, x, &R->extent);
    b->n_marks = x->n_marks = sli_region_chunks(R->extent.n_rows);
    return 1;
}

/* Marks the chunks of the boundary that a compiled set uses: those of its own rows, and those of
 * the rows below its subtrees, which are the rows below their roots. */
static void sli_set_mark(sli_set *set, const sli_reach *R) {
    const sl_int n = set->extent->n_rows, base = R->columns - n;
    const sl_int *rows = R->rows;
    sl_int k, i;
    memset(set->marks, 0, (size_t)sli_region_chunks(n));
    for (k = set->inside; k < set->count; k++) {
        set->marks[(set->index[sli_value(set->seeds[k])] - base) / SLI_REGION_COLUMNS] = 1;
    }
    for (k = 0; k < R->count; k++) {
        for (i = 0; R->steps[k].up == -1 && i < R->steps[k].below; i++) {
            set->marks[(rows[i] - base) / SLI_REGION_COLUMNS] = 1;
        }
        rows += R->steps[k].below;
    }
}

/* Doubles of the region's inverse in the chunks that either set uses. */
static sl_off sli_boundary_entries(const sl_region *R, const sli_set *b, const sli_set *x) {
    sl_off sum = 0;
    sl_int k;
    for (k = 0; k < sli_region_chunks(R->extent.n_rows); k++) {
        sum += b->marks[k] || x->marks[k] ? R->begin[k + 1] - R->begin[k] : 0;
    }
    return sum;
}

static void sli_region_finish(const sli_ending *e, sli_query *q, sli_set *b, sli_set *x) {
    const sl_region *R = sli_region_of(e);
    sli_set_mark(b, &q->forward);
    sli_set_mark(x, &q->backward);
    q->used.b = b->marks;
    q->used.x = x->marks;
    q->used.entries = sli_boundary_entries(R, b, x);
}

static int sli_region_holds(const sli_query *q, const sl_factor *F) {
    return sli_region_fits(sli_region_of(q->ending), F);
}

static uint64_t sli_region_vectors_of(const sli_ending *e, sl_int lanes) {
    return 3 * (uint64_t)sli_region_of(e)->extent.n_rows * (uint64_t)lanes;
}

static size_t sli_region_scratch_of(const sli_ending *e, sl_int lanes) {
    return sli_sweep_scratch(SLI_REGION_COLUMNS + sli_region_of(e)->extent.n_rows,
                             SLI_REGION_COLUMNS, lanes);
}

/* Applies the region's inverse: u is at the end of y, Z u goes to the end of x. */
static void sli_region_cross(const sl_factor *F, const sli_query *q, int kind,
                             const sli_vectors *v) {
    const ptrdiff_t n = q->ending->rows;
    sli_vectors boundary = *v;
    boundary.y += (q->forward.columns - n) << kind;
    boundary.x += (q->backward.columns - n) << kind;
    sli_region_apply(sli_region_of(q->ending), &q->used, F->kernels, kind, &boundary);
}

static void sli_region_give_back(const sli_ending *e) {
    sl_region_free((sl_region *)(void *)e);
}

static const sli_ending_calls sli_region_calls = {
    sli_region_belongs,    sli_region_place,      sli_region_finish, sli_region_holds,
    sli_region_vectors_of, sli_region_scratch_of, sli_region_cross,  sli_region_give_back};

/* Makes the region an ending of queries. */
SLI_INLINE void sli_region_begin(sl_region *R) {
    R->ending.calls = &sli_region_calls;
    R->ending.rows = R->extent.n_rows;
}

#endif

/* factor_parts.h: the factor object, and what both ways to factor share: loading a panel, taking a pivot */
#ifndef SLI_FACTOR_PARTS_H
#define SLI_FACTOR_PARTS_H

#include "csc.h"
#include "select.h"
#include "status.h"
#include "symbolic_types.h"

struct sl_factor {
    sl_allocator allocator;
    sl_stats stats;       /* the factor group and the error fields */
    const sl_symbolic *S; /* borrowed */
    const sli_kernels *kernels;
    double null_tolerance;
    int is_good;      /* L and D hold a factor */
    double *L;        /* the panels */
    double *D;        /* n pivots */
    double *buffer;   /* kernel scratch */
    sl_method method;
    /* multifrontal */
    double *waiting;   /* S->waiting: update matrices on their way to the parents */
    double *magnitude; /* rows of the tallest front: what its diagonal was made of */
    /* up-looking */
    double *x;        /* n: updates on their way up row k; all 0 between rows */
    sl_int *head;     /* n: first supernode whose next row is k, -1 for none */
    sl_int *next;     /* n_supers: the others, as a list */
    sl_int *position; /* n_supers: how many rows below have been done */
    uint64_t *list;   /* n_supers: the reach of row k */
    uint64_t *list_scratch;
};

/* The column of A that holds position p. */
static sl_int sli_column_of(const sl_csc *A, sl_int p) {
    sl_int low = 0, high = A->n_cols - 1;
    while (low < high) { /* the last column that starts at or before p */
        const sl_int middle = low + (high - low + 1) / 2;
        if (A->p[middle] <= p) {
            low = middle;
        } else {
            high = middle - 1;
        }
    }
    return low;
}

/* Puts A's entries into supernode s's panel, over zeros. */
static sl_status sli_panel_load(sl_factor *F, const sl_csc *A, sl_int s) {
    const sl_symbolic *S = F->S;
    const size_t size = (size_t)(S->panel_begin[s + 1] - S->panel_begin[s]);
    sl_off m;
    memset(F->L + S->panel_begin[s], 0, size * sizeof(double));
    for (m = S->map_begin[s]; m < S->map_begin[s + 1]; m++) {
        const double a = A->x[S->map_from[m]];
        if (!sli_is_finite(a)) {
            const sl_int p = S->map_from[m];
            return sli_fail_at(&F->stats, SL_ERR_NOT_FINITE, A->i[p], sli_column_of(A, p), a);
        }
        F->L[S->map_to[m]] += a;
    }
    return SL_OK;
}

/* Refuses a pivot that is not a number or null against what it was made of; otherwise counts it. */
static sl_status sli_take_pivot(sl_factor *F, sl_int k, double pivot, double magnitude) {
    const double size = fabs(pivot);
    sl_stats *stats = &F->stats;
    if (!sli_is_finite(pivot)) {
        return sli_fail_at(stats, SL_ERR_NOT_FINITE, F->S->perm[k], -1, pivot);
    }
    if (size == 0.0 || size <= F->null_tolerance * magnitude) {
        stats->null++;
        return sli_fail_at(stats, SL_ERR_PIVOT, F->S->perm[k], -1, pivot);
    }
    stats->positive += pivot > 0.0;
    stats->negative += pivot < 0.0;
    stats->pivot_min = k == 0 || size < stats->pivot_min ? size : stats->pivot_min;
    stats->pivot_max = k == 0 || size > stats->pivot_max ? size : stats->pivot_max;
    F->D[k] = pivot;
    return SL_OK;
}

#endif

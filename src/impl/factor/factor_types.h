/* factor_parts.h: the factor object, and what both ways to factor share: loading a panel, taking a pivot */
#ifndef SLI_FACTOR_PARTS_H
#define SLI_FACTOR_PARTS_H

#include "csc.h"
#include "schedule.h"
#include "select.h"
#include "status.h"

/* Where a factorization takes the entries of its matrix from: A, or a sum of arrays in the order of the
 * analysis's map. */
typedef struct sli_source {
    const sl_csc *A;             /* NULL: the sum over t of coefficients[t] values[t] */
    const double *const *values; /* terms arrays of map_begin[n_supers] */
    const double *coefficients;  /* terms */
    sl_int terms;
} sli_source;

/* The first thing that went wrong in a factorization. */
typedef struct sli_failure {
    sl_status status;
    sl_int super; /* the supernode it happened in */
    sl_int pivot; /* the pivot that is null or not finite, or -1 */
    sl_off
        position; /* the entry that is not finite, in the order of the map, or -1: a coefficient */
    double value;
} sli_failure;

struct sl_factor {
    sl_allocator allocator;
    sl_stats stats;       /* the factor group and the error fields */
    const sl_symbolic *S; /* borrowed */
    const sli_kernels *kernels;
    sli_pivot_rule rule;
    sl_definiteness definiteness;
    sl_method method;
    int is_good;         /* L and D hold a factor */
    sl_status status;    /* what the last factorization came to */
    uint64_t generation; /* of the numbers: how often they were begun anew */
    double *L;           /* the panels */
    double *D;           /* n pivots */
    sl_int *
        regularized; /* n: the pivots that regularization changed, ascending; NULL: there is none */
    /* null pivots */
    double consistency; /* what |z' b| may be against the sum of |b|; negative: not looked at */
    int checks;         /* there are null pivots, and solves look whether b is consistent */
    int is_centred;     /* there are null pivots, and solves are centred by mass: */
    sl_int n_nulls;
    sl_int *nulls; /* n: n_nulls null pivots, ascending */
    sl_int n_anchors;
    sl_int *anchors; /* a tree each: the null pivots that weights take care of, ascending */
    double *mass;    /* n, in pivot order; NULL: none */
    double *centre;  /* n: v = D^-1 L^-1 m / z' m */
    double *squares; /* a tree each: v' D v of the one of each anchor */
    double *divide;  /* n: D with 1 for null pivots: x is given there */
    double *centre_scratch;
    double *buffer; /* kernel scratch, for each worker */
    /* multifrontal; what a worker needs stands once for each */
    sl_threads threads;
    sli_schedule schedule;
    double *waiting;       /* schedule.waiting: update matrices on their way to the parents */
    double *magnitude;     /* rows of the tallest front: what its diagonal was made of */
    double *inverse;       /* SLI_FRONT_INVERSE */
    sli_failure *failures; /* one */
    /* up-looking */
    double *x;        /* n: updates on their way up row k; all 0 between rows */
    sl_int *head;     /* n: first supernode whose next row is k, -1 for none */
    sl_int *next;     /* n_supers: the others, as a list */
    sl_int *position; /* n_supers: how many rows below have been done */
    uint64_t *list;   /* n_supers: the reach of row k */
    uint64_t *list_scratch;
};

/* Fills a failure in and returns its status. */
SLI_INLINE sl_status sli_fail(sli_failure *f, sl_status status, sl_int super, sl_int pivot,
                              sl_off position, double value) {
    f->status = status;
    f->super = super;
    f->pivot = pivot;
    f->position = position;
    f->value = value;
    return status;
}

SLI_INLINE void sli_keep_first_failure(sli_failure *f, const sli_failure *other) {
    if (other->status != SL_OK && (f->status == SL_OK || other->super < f->super)) {
        *f = *other;
    }
}

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

/* Adds the entries first .. last-1 of the map to supernode s's panel: each from its own place in x, or,
 * with map_from NULL, x holds them alone. */
SLI_ALWAYS_INLINE sl_status sli_panel_add_entries(const sl_factor *F, sl_int s, sl_off first,
                                                  sl_off last, const double *x,
                                                  const sl_int *map_from, sli_failure *failure) {
    const sl_off *to = F->S->map_to;
    sl_off m;
    for (m = first; m < last; m++) {
        const double a = map_from != NULL ? x[map_from[m]] : x[m - first];
        if (!sli_is_finite(a)) {
            return sli_fail(failure, SL_ERR_NOT_FINITE, s, -1, m, a);
        }
        F->L[to[m]] += a;
    }
    return SL_OK;
}

#define SLI_SUMMED 64 /* entries that are summed at a time: most supernodes have no more */

/* sums := the entries of the map from first on */
static void sli_source_sum(const sli_source *from, sl_off first, sl_int count, double *sums) {
    sl_int k, t;
    memset(sums, 0, (size_t)count * sizeof(double));
    for (t = 0; t < from->terms; t++) {
        const double c = from->coefficients[t], *v = from->values[t] + first;
        for (k = 0; k < count; k++) {
            const double product = c * v[k]; /* rounded, as in a sum that the caller makes */
            sums[k] += product;
        }
    }
}

/* Adds the matrix's entries to supernode s's panel. */
static sl_status sli_panel_add(const sl_factor *F, const sli_source *from, sl_int s,
                               sli_failure *failure) {
    const sl_symbolic *S = F->S;
    const sl_off end = S->map_begin[s + 1];
    sl_off m = S->map_begin[s], last;
    double sums[SLI_SUMMED];
    sl_status status = SL_OK;
    if (from->A != NULL) {
        return sli_panel_add_entries(F, s, m, end, from->A->x, S->map_from, failure);
    }
    for (; m < end && status == SL_OK; m = last) {
        last = end - m < SLI_SUMMED ? end : m + SLI_SUMMED;
        sli_source_sum(from, m, (sl_int)(last - m), sums);
        status = sli_panel_add_entries(F, s, m, last, sums, NULL, failure);
    }
    return status;
}

/* Refuses a pivot that is not a number or null against what it was made of. */
/* Was pivot k null and skipped? */
SLI_INLINE int sli_is_skipped(const sl_factor *F, sl_int k) {
    return F->definiteness == SL_SEMIDEFINITE && F->D[k] == SLI_NULL_PIVOT;
}

/* Was pivot k changed by regularization? */
SLI_INLINE int sli_is_regularized(const sl_factor *F, sl_int k) {
    return F->rule.shifts != NULL && F->rule.shifts[k] != 0.0;
}

/* Refuses a pivot that is not a number, or null against what it was made of and not replaced. */
SLI_INLINE sl_status sli_check_pivot(const sl_factor *F, sl_int k, double pivot, double magnitude,
                                     sli_failure *failure) {
    if (!sli_is_finite(pivot)) {
        return sli_fail(failure, SL_ERR_NOT_FINITE, F->S->super_of[k], k, -1, pivot);
    }
    if (!F->rule.replaces && sli_is_null(pivot, magnitude, F->rule.null_tolerance)) {
        return sli_fail(failure, SL_ERR_PIVOT, F->S->super_of[k], k, -1, pivot);
    }
    return SL_OK;
}

/* Counts and bounds of the first pivots. */
static void sli_count_pivots(sl_factor *F, sl_int count) {
    sl_stats *stats = &F->stats;
    sl_int k;
    stats->positive = stats->negative = stats->null = stats->regularized = 0;
    stats->pivot_min = stats->pivot_max = 0.0;
    for (k = 0; k < count; k++) {
        const double size = fabs(F->D[k]);
        if (sli_is_skipped(F, k)) {
            stats->null++;
            continue;
        }
        if (sli_is_regularized(F, k)) {
            F->regularized[stats->regularized++] = k;
        }
        if (stats->positive + stats->negative == 0) {
            stats->pivot_min = size;
        }
        stats->positive += F->D[k] > 0.0;
        stats->negative += F->D[k] < 0.0;
        stats->pivot_min = size < stats->pivot_min ? size : stats->pivot_min;
        stats->pivot_max = size > stats->pivot_max ? size : stats->pivot_max;
    }
}

#endif

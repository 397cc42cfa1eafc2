/* uplooking.h: the up-looking factorization: row k of L is a sparse triangular solve over the reach of row k of A */
#ifndef SLI_UPLOOKING_H
#define SLI_UPLOOKING_H

#include "csc.h"
#include "reach.h"
#include "select.h"
#include "sort.h"
#include "status.h"

struct sl_factor {
    sl_allocator allocator;
    sl_stats stats;       /* the factor group and the error fields */
    const sl_symbolic *S; /* borrowed */
    const sli_kernels *kernels;
    double null_tolerance;
    int is_good;      /* L and D hold a factor */
    double *L;        /* the panels */
    double *D;        /* n pivots */
    double *x;        /* n: updates on their way up row k; all 0 between rows */
    double *buffer;   /* kernel scratch */
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

/* Hangs supernode s onto the list of its next row, if it has one. */
static void sli_wait_for_row(sl_factor *F, sl_int s) {
    const sl_off at = F->S->rows_begin[s] + F->position[s];
    if (at < F->S->rows_begin[s + 1]) {
        const sl_int k = F->S->rows[at];
        F->next[s] = F->head[k];
        F->head[k] = s;
    }
}

/* Row q of supernode s, local numbering; see sli_row_kernel. */
static void sli_do_row(sl_factor *F, sl_int s, sl_int q, double *pivot, double *magnitude) {
    const sl_symbolic *S = F->S;
    const sl_int first = S->super_first[s];
    F->kernels->row(F->L + S->panel_begin[s], S->steps[s].width, q, S->rows + S->rows_begin[s],
                    F->D + first, F->x + first, F->x, F->buffer, pivot, magnitude);
}

/* Row k: the supernodes that wait for it, in ascending order so that descendants come first, then
 * its own. */
static void sli_do_all_rows(sl_factor *F, sl_int k, double *pivot, double *magnitude) {
    const sl_symbolic *S = F->S;
    const sl_int own = S->super_of[k];
    sl_int s, m, count = 0;
    for (s = F->head[k]; s != -1; s = F->next[s]) {
        F->list[count++] = sli_keyed(s, 0);
    }
    sli_sort(F->list, count, F->list_scratch);
    for (m = 0; m < count; m++) {
        s = sli_key(F->list[m]);
        sli_do_row(F, s, S->steps[s].width + F->position[s], pivot, magnitude);
        F->position[s]++;
        sli_wait_for_row(F, s);
    }
    if (k > S->super_first[own]) {
        sli_do_row(F, own, k - S->super_first[own], pivot, magnitude);
    }
}

/* Refuses a pivot that is not a number or null against what it was made of; otherwise counts it. */
static sl_status sli_take_pivot(sl_factor *F, sl_int k, double pivot, double magnitude) {
    const double size = fabs(pivot);
    sl_stats *stats = &F->stats;
    if (!sli_is_finite(pivot)) {
        return sli_fail_at(stats, SL_ERR_NOT_FINITE, F->S->perm[k], -1, pivot);
    }
    /* terms that overflow in magnitude and not in sum tell nothing about what was lost */
    if (size == 0.0 || (sli_is_finite(magnitude) && size <= F->null_tolerance * magnitude)) {
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

/* The whole factorization. A fits the analysis. [LDL05], [Davis06] 4.7 */
static sl_status sli_uplooking(sl_factor *F, const sl_csc *A) {
    const sl_symbolic *S = F->S;
    sl_status status = SL_OK;
    sl_int k;
    F->stats.positive = F->stats.negative = F->stats.null = 0;
    F->stats.pivot_min = F->stats.pivot_max = 0.0;
    for (k = 0; k < S->n; k++) {
        F->head[k] = -1;
    }
    for (k = 0; k < S->n && status == SL_OK; k++) {
        const sl_int s = S->super_of[k], q = k - S->super_first[s];
        double *diagonal, pivot, magnitude;
        if (q == 0) {
            status = sli_panel_load(F, A, s);
            if (status != SL_OK) {
                break;
            }
        }
        diagonal = F->L + S->panel_begin[s] + sli_panel_at(S->steps[s].width, q, q);
        pivot = *diagonal;
        magnitude = fabs(pivot);
        *diagonal = 0.0;
        sli_do_all_rows(F, k, &pivot, &magnitude);
        status = sli_take_pivot(F, k, pivot, magnitude);
        if (q == S->steps[s].width - 1) {
            F->position[s] = 0;
            sli_wait_for_row(F, s);
        }
    }
    if (status != SL_OK) {
        memset(F->x, 0, (size_t)S->n * sizeof(double));
    }
    return status;
}

#endif

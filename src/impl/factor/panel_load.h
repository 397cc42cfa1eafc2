/* panel_load.h: adds the entries of A to the panel of a supernode */
#ifndef SLI_FACTOR_PANEL_LOAD_H
#define SLI_FACTOR_PANEL_LOAD_H

#include "factor_types.h"

/* An entry of A in float. None becomes 0, which would hide that its row is too small. */
SLI_INLINE float sli_single(double a) {
    const float x = (float)a;
    return x != 0.0F || a == 0.0 ? x : a < 0.0 ? -FLT_MIN : FLT_MIN;
}

/* A's entries are read in the order of the map, which processors do not foresee. */
#define SLI_ENTRIES_AHEAD 32

/* What entry a at this place of a panel adds to the mark of its supernode, which so does not depend
 * on the order of the entries. */
SLI_INLINE uint64_t sli_mark_entry(double a, sl_off place) {
    uint64_t bits;
    memcpy(&bits, &a, sizeof bits);
    return sli_fold(sli_fold(bits ^ SLI_HASH_1, (uint64_t)place + SLI_HASH_2), SLI_HASH_3);
}

/* The mark of a supernode without entries. */
#define SLI_MARK_BEGIN SLI_HASH_4

/* Adds the entries first .. last-1 of the scatter map to the panel of supernode s, in double or, if
 * that is NULL, in float, and records the largest magnitude, which may not exceed `most`. is_half:
 * the panel has the first columns of pairs only. marks: gets the mark of what is added, or NULL.
 * With scatter_from, x is the value array of A and scatter_from[m] the position of entry m;
 * without, x[0] is the value of entry `first`. */
SLI_ALWAYS_INLINE sl_status sli_panel_load_entries(const sl_factor *F, sl_int s, double *panel,
                                                   float *single, int is_half, double most,
                                                   uint64_t *marks, sl_off first, sl_off last,
                                                   const double *x, const sl_int *scatter_from,
                                                   sli_failure *failure) {
    const sl_off *to = F->S->scatter_to, begin = F->S->steps[s].panel;
    const sl_off ahead = F->S->scatter_begin[F->S->n_supers] - SLI_ENTRIES_AHEAD;
    double largest = F->extents[s].entry;
    uint64_t mark = 0;
    sl_off m;
    for (m = first; m < last; m++) {
        if (scatter_from != NULL && m < ahead) { /* untested: constant */
            SLI_PREFETCH(x + scatter_from[m + SLI_ENTRIES_AHEAD], 0);
        }
        const double a =
            scatter_from != NULL ? x[scatter_from[m]] : x[m - first]; /* untested: constant */
        const double size = fabs(a);
        if (!(size <= most)) {
            const sl_status status = /* untested: finite only in float */
                sli_is_finite(a) ? SL_ERR_INACCURATE : SL_ERR_NOT_FINITE; /* untested: the same */
            return sli_fail(failure, status, s, -1, m, a);
        }
        if (panel == NULL) { /* untested: constant */
            single[to[m] - begin] += sli_single(a);
        } else if (is_half) { /* untested: constant */
            if ((to[m] & SLI_TILE) == 0) { /* untested: constant where is_half is 0 */
                panel[sli_half_at(to[m] - begin)] += a;
            }
        } else {
            panel[to[m] - begin] += a;
        }
        if (marks != NULL) { /* untested: constant in float */
            mark += sli_mark_entry(a, to[m] - begin);
        }
        largest = size > largest ? size : largest;
    }
    F->extents[s].entry = largest;
    if (marks != NULL) { /* untested: the same */
        marks[s] += mark;
    }
    return SL_OK;
}

#define SLI_SUM_ENTRIES 64 /* entries that are summed at a time; most supernodes have no more */

/* sums := the weighted sums of the map's entries first .. first+count-1 */
static void sli_source_sum(const sli_source *from, sl_off first, sl_int count, double *sums) {
    sl_int k, t;
    memset(sums, 0, (size_t)count * sizeof(double));
    for (t = 0; t < from->terms; t++) {
        const double c = from->coefficients[t], *v = from->values[t] + first;
        for (k = 0; k < count; k++) {
            const double product = c * v[k]; /* rounded, as in a sum that the caller computes */
            sums[k] += product;
        }
    }
}

/* Adds the matrix's entries to the panel of supernode s, in double or, if NULL, in float. */
static sl_status sli_panel_load(const sl_factor *F, const sli_source *from, sl_int s, double *panel,
                                float *single, sli_failure *failure) {
    const sl_symbolic *S = F->S;
    const sl_off end = S->scatter_begin[s + 1];
    sl_off m = S->scatter_begin[s], last;
    double sums[SLI_SUM_ENTRIES];
    sl_status status = SL_OK;
    F->extents[s].entry = F->extents[s].magnitude = 0.0;
    F->extents[s].pivot = -1;
    F->extents[s].zero = 0;
    if (F->marks != NULL) {
        F->marks[s] = SLI_MARK_BEGIN;
    }
    if (from->A != NULL && panel == NULL) {
        return sli_panel_load_entries(F, s, NULL, single, 0, SLI_SINGLE_MOST, NULL, m, end,
                                      from->A->x, S->scatter_from, failure);
    }
    if (from->A != NULL && sli_is_complex(F)) {
        return sli_panel_load_entries(F, s, panel, NULL, 1, DBL_MAX, F->marks, m, end, from->A->x,
                                      S->scatter_from, failure);
    }
    if (from->A != NULL) {
        return sli_panel_load_entries(F, s, panel, NULL, 0, DBL_MAX, F->marks, m, end, from->A->x,
                                      S->scatter_from, failure);
    }
    for (; m < end && status == SL_OK; m = last) {
        last = end - m < SLI_SUM_ENTRIES ? end : m + SLI_SUM_ENTRIES;
        sli_source_sum(from, m, (sl_int)(last - m), sums);
        if (panel == NULL) {
            status = sli_panel_load_entries(F, s, NULL, single, 0, SLI_SINGLE_MOST, NULL, m, last,
                                            sums, NULL, failure);
        } else {
            status = sli_panel_load_entries(F, s, panel, NULL, 0, DBL_MAX, F->marks, m, last, sums,
                                            NULL, failure);
        }
    }
    return status;
}

#endif

/* panel_load.h: the entries of a matrix or of a weighted sum, for the panels of supernodes */
#ifndef SLI_FACTOR_PANEL_LOAD_H
#define SLI_FACTOR_PANEL_LOAD_H

#include "factor_types.h"

/* A's entries are read in the order of the map, which processors do not foresee. */
#define SLI_ENTRIES_AHEAD 32

/* What entry a at this place of a panel adds to the mark of its supernode, which so does not depend
 * on the order of the entries. */
SLI_INLINE uint64_t sli_mark_entry(double a, sl_off place) {
    uint64_t bits;
    memcpy(&bits, &a, sizeof bits);
    return sli_fold(bits ^ SLI_HASH_1, (uint64_t)place * SLI_HASH_3 + SLI_HASH_2);
}

/* The mark of a supernode without entries. */
#define SLI_MARK_BEGIN SLI_HASH_4

#define SLI_SUM_ENTRIES 64 /* entries that are summed at a time; most supernodes have no more */

/* sums := the weighted sums of the map's entries first .. first+count-1 */
static void sli_source_sum(const sli_source *from, sl_off first, sl_int count, double *sums) {
    sl_int k, t;
    SLI_ZERO(sums, count);
    for (t = 0; t < from->terms; t++) {
        const double c = from->coefficients[t], *v = from->values[t] + first;
        for (k = 0; k < count; k++) {
            const double product = c * v[k]; /* rounded, as in a sum that the caller computes */
            sums[k] += product;
        }
    }
}

/* After a refusal: reports the first entry that is not finite instead, if there is one. */
SLI_COLD static void sli_entries_finite_check(const sl_symbolic *S, const sli_source *from,
                                              sli_failure *failure) {
    sl_off m;
    sl_int s;
    for (s = 0; s < S->n_supers; s++) {
        for (m = S->scatter_begin[s]; m < S->scatter_begin[s + 1]; m++) {
            double a;
            if (from->A != NULL) {
                a = from->A->x[S->scatter_from[m]];
            } else {
                sli_source_sum(from, m, 1, &a);
            }
            if (!sli_is_finite(a)) {
                (void)sli_fail(failure, SL_ERR_NOT_FINITE, s, -1, m, a);
                return;
            }
        }
    }
}

/* Entries of the scatter map to add to a panel: entry m, first <= m < last, has the value
 * x[scatter_from[m]] or, if that is NULL, x[m - first]. */
typedef struct sli_loading {
    const double *x;
    const sl_int *scatter_from;
    sl_off first, last;
} sli_loading;

/* Begins the panel of supernode s. */
SLI_INLINE void sli_panel_begin(const sl_factor *F, sl_int s) {
    F->extents[s].entry = F->extents[s].magnitude = 0.0;
    F->extents[s].pivot = -1;
    F->extents[s].suspects = 0;
    if (F->history.marks != NULL) {
        F->history.marks[s] = SLI_MARK_BEGIN;
    }
}

#endif

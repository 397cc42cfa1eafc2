/* symmetry.h: are the values of both triangles the same? */
#ifndef SLI_FACTOR_SYMMETRY_H
#define SLI_FACTOR_SYMMETRY_H

#include "../analysis/symbolic_types.h"
#include "../base/status.h"

/* Of a matrix that stores both triangles one is read. If the other one is not the same, the matrix
 * is not symmetric, as M^-1 L for a Laplacian L.
 *
 * For weights x, A x and A' x are compared, which takes one pass in any order of the entries, with
 * duplicates. Weights are between 1 and 2 and look random, so that differences do not cancel.
 * Values computed in single precision may differ by their rounding. */
#define SLI_ASYMMETRY_MOST 1e-6 /* relative to the sum of the magnitudes in the row */

SLI_INLINE double sli_symmetry_weight(sl_int i) {
    return 1.0 + (double)((uint32_t)i * 2654435769u) / 4294967296.0;
}

/* The sum of the entries (i, j). */
static double sli_symmetry_entry(const sl_csc *A, sl_int i, sl_int j) {
    double sum = 0.0;
    sl_int q;
    for (q = A->p[j]; q < A->p[j + 1]; q++) {
        sum += A->i[q] == i ? A->x[q] : 0.0;
    }
    return sum;
}

/* Compares row r with column r, entry by entry: names what is not finite, or else the entry that
 * differs most. */
SLI_COLD static sl_status sli_symmetry_report(const sl_csc *A, sl_int r, sl_stats *stats) {
    double most = 0.0, value = 0.0;
    sl_int q, column = -1;
    for (q = A->p[r]; q < A->p[r + 1]; q++) {
        const double mirror = sli_symmetry_entry(A, A->i[q], r);
        const double entry = sli_symmetry_entry(A, r, A->i[q]);
        if (!sli_is_finite(mirror) || !sli_is_finite(entry)) {
            const int is_mirror = !sli_is_finite(mirror);
            return sli_fail_at(stats, SL_ERR_NOT_FINITE, is_mirror ? A->i[q] : r,
                               is_mirror ? r : A->i[q], is_mirror ? mirror : entry,
                               "an entry of A is not finite");
        }
        if (fabs(entry - mirror) > fmax(most, SLI_ASYMMETRY_MOST * fabs(entry))) {
            most = fabs(entry - mirror);
            value = entry;
            column = A->i[q];
        }
    }
    return column == -1 ? SL_OK
                        : sli_fail_at(stats, SL_ERR_MALFORMED, r, column, value,
                                      "the values of the two triangles differ; options.triangle "
                                      "chooses one");
}

/* Refuses a matrix that was analyzed with both triangles, whose values differ. A has the analyzed
 * pattern. */
static sl_status sli_symmetry_check(const sl_symbolic *S, const sl_csc *A, const sl_allocator *a,
                                    sl_stats *stats) {
    sl_status status = SL_OK;
    double *difference = NULL, *magnitude = NULL;
    sli_block b = {NULL, 0};
    sl_int j, q;
    if (S->stats.symbolic.triangle != SL_TRIANGLE_BOTH) {
        return SL_OK;
    }
    SLI_LAYOUT(&b, a, status) {
        difference = SLI_TAKE(&b, double, S->n);
        magnitude = SLI_TAKE(&b, double, S->n);
    }
    if (status != SL_OK) {
        return status;
    }
    SLI_ZERO(difference, S->n);
    for (j = 0; j < S->n; j++) {
        const double x = sli_symmetry_weight(j);
        double sum = 0.0, size = 0.0;
        for (q = A->p[j]; q < A->p[j + 1]; q++) {
            const double term = A->x[q] * sli_symmetry_weight(A->i[q]);
            sum += term;
            size += fabs(term);
            difference[A->i[q]] += A->x[q] * x;
        }
        difference[j] -= sum;
        magnitude[j] = size;
    }
    for (j = 0; j < S->n && status == SL_OK; j++) {
        if (!sli_is_finite(difference[j]) || /* entries are not, or their sums overflow */
            fabs(difference[j]) > SLI_ASYMMETRY_MOST * magnitude[j]) {
            status = sli_symmetry_report(A, j, stats);
        }
    }
    sli_free(a, b.base);
    return status;
}

#endif

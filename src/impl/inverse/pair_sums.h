/* pair_sums.h: entries of the inverse from a forward sweep: sums over columns, weighted by 1/D */
#ifndef SLI_INVERSE_PAIR_SUMS_H
#define SLI_INVERSE_PAIR_SUMS_H

#include "../../public/inverse.h"
#include "row_sets.h"
#include "unit_vectors.h"

/* z = y / d in every lane, by one division and products with the quotient. If 1/d overflows or is
 * denormal, each lane is divided by d. */
SLI_ALWAYS_INLINE void sli_divide_lanes(double *z, const double *y, double d, sl_int lanes) {
    const double inverse = 1.0 / d, size = fabs(inverse);
    sl_int k;
    if (size >= DBL_MIN && size <= DBL_MAX) {
        for (k = 0; k < lanes; k++) {
            z[k] = y[k] * inverse;
        }
    } else {
        for (k = 0; k < lanes; k++) {
            z[k] = y[k] / d;
        }
    }
}

/* sums[m] = y_i' D^-1 y_j over the columns of a sweep, with lanes i = first[m] and j = second[m].
 */
static void sli_pair_sums(const sl_factor *F, const sli_forward *f, sl_int count,
                          const sl_int *first, const sl_int *second, double *sums) {
    sl_int s, k, m;
    for (m = 0; m < count; m++) {
        sums[m] = 0.0;
    }
    for (s = 0; s < f->reach.count; s++) {
        const sli_step *step = &f->reach.steps[s];
        const double *d = F->D + step->column, *y = f->y + (ptrdiff_t)step->base * f->lanes;
        for (k = 0; k < sli_step_columns(step); k++, y += f->lanes) {
            double z[SLI_LANES_MAX];
            sli_divide_lanes(z, y, d[k], f->lanes);
            for (m = 0; m < count; m++) { /* sum(m) += y(k, i) / d(k) y(k, j) */
                sums[m] += z[first[m]] * y[second[m]];
            }
        }
    }
}

/* Clears the inverse group: nothing requested yet. */
static void sli_inverse_clear_stats(sl_stats *stats) {
    if (stats != NULL) {
        SLI_CLEAR(stats->inverse);
    }
}

#endif

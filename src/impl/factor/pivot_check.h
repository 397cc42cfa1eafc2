/* pivot_check.h: which pivots are refused, and what is recorded of the others */
#ifndef SLI_FACTOR_PIVOT_CHECK_H
#define SLI_FACTOR_PIVOT_CHECK_H

#include "factor_types.h"

/* Is the tolerance the default? */
SLI_INLINE int sli_tolerance_is_default(const sl_factor *F) {
    return F->rule.null_tolerance == sli_null_tolerance(F->S->n);
}

/* options.null_tolerance for a factor with the same tolerance. */
SLI_INLINE double sli_tolerance_option(const sl_factor *F) {
    return sli_tolerance_is_default(F) ? 0.0 : F->rule.null_tolerance;
}

/* Gives the rule what it reads of the analysis. */
SLI_NOINLINE static void sli_tolerance_begin(sl_factor *F) {
    const int is_default = sli_tolerance_is_default(F);
    F->rule.super_of = is_default ? F->S->super_of : NULL;
    F->rule.super_first = F->S->super_first;
    F->rule.first_descendant = F->S->first_descendant;
}

/* Keeps the largest sum of magnitudes that a pivot k of supernode s was computed from. */
SLI_INLINE void sli_record_magnitude(const sl_factor *F, sl_int s, sl_int k, double magnitude) {
    if (magnitude > F->extents[s].magnitude) {
        F->extents[s].magnitude = magnitude;
        F->extents[s].pivot = k;
    }
}

/* Refuses pivot k, which is null or has the wrong sign. */
SLI_COLD static sl_status sli_refuse_pivot(const sl_factor *F, sl_int s, sl_int k, double pivot,
                                           double magnitude, sli_failure *failure) {
    (void)sli_fail(failure, SL_ERR_PIVOT, s, k, -1, pivot);
    failure->bound = fmax(sli_rule_tolerance(&F->rule, k), 0.0) * magnitude;
    return failure->status;
}

/* Refuses pivot k if it is null; by the default tolerance leaves it to sli_nulls_judge unless it is
 * 0. */
SLI_COLD static sl_status sli_check_small(const sl_factor *F, sl_int s, sl_int k, double pivot,
                                          double magnitude, sli_failure *failure) {
    if (!sli_is_null(pivot, magnitude, sli_rule_tolerance(&F->rule, k))) {
        return SL_OK;
    }
    if (pivot == 0.0 || F->rule.super_of == NULL) {
        return sli_refuse_pivot(F, s, k, pivot, magnitude, failure);
    }
    if (F->extents[s].suspects == 0) {
        F->extents[s].suspects = 1 + k - F->S->super_first[s];
    }
    return SL_OK;
}

/* Records the magnitudes that pivot k of supernode s was computed from. Refuses a pivot that is not
 * finite, or one that is null against these magnitudes and was not replaced. */
SLI_INLINE sl_status sli_check_pivot(const sl_factor *F, sl_int s, sl_int k, double pivot,
                                     double magnitude, sli_failure *failure) {
    sli_record_magnitude(F, s, k, magnitude);
    if (!sli_is_finite(pivot)) {
        return sli_fail(failure, SL_ERR_NOT_FINITE, s, k, -1, pivot);
    }
    if (!F->rule.replaces && sli_is_null(pivot, magnitude, F->rule.null_tolerance)) {
        return sli_check_small(F, s, k, pivot, magnitude, failure);
    }
    if (sli_skips_nulls(F) && !sli_is_skipped(F, k) &&
        !(pivot * F->rule.signs[k] > 0.0)) { /* indefinite */
        return sli_refuse_pivot(F, s, k, pivot, magnitude, failure);
    }
    return SL_OK;
}

/* At the first column k of a 2x2 pivot of supernode s: records the magnitudes that both columns
 * were computed from, and refuses a pivot that is not finite or null. */
SLI_INLINE sl_status sli_check_pair(const sl_factor *F, sl_int s, sl_int k, const double *magnitude,
                                    sli_failure *failure) {
    double a, b, e;
    sl_int r;
    if (F->S->pairs[k] == SLI_PAIR_SECOND) {
        return SL_OK;
    }
    a = F->D[k];
    b = F->D[k + 1];
    e = F->E[k];
    for (r = 0; r < 2; r++) { /* e does not show in the magnitudes */
        sli_record_magnitude(F, s, k + r, magnitude[r] > fabs(e) ? magnitude[r] : fabs(e));
    }
    if (!sli_is_finite(a) || !sli_is_finite(b) || !sli_is_finite(e)) {
        return sli_fail(failure, SL_ERR_NOT_FINITE, s, k, -1,
                        !sli_is_finite(a)   ? a
                        : !sli_is_finite(b) ? b
                                            : e);
    }
    if (!F->rule.replaces &&
        sli_pair_is_null(a, b, e, magnitude[0], magnitude[1], sli_rule_tolerance(&F->rule, k))) {
        return sli_fail(failure, SL_ERR_PIVOT, s, k, -1, a);
    }
    return SL_OK;
}

/* The eigenvalues of the 2x2 pivot of columns k, k+1, the one of larger magnitude first. */
SLI_NOINLINE static void sli_pair_eigenvalues(const sl_factor *F, sl_int k, double *values) {
    const double a = F->D[k], b = F->D[k + 1], e = F->E[k];
    const double middle = 0.5 * a + 0.5 * b, half = 0.5 * a - 0.5 * b;
    const double size = fabs(half) > fabs(e) ? fabs(half) : fabs(e);
    const double x = size > 0.0 ? half / size : 0.0, y = size > 0.0 ? e / size : 0.0;
    const double radius = size * sqrt(x * x + y * y);
    values[0] = middle < 0.0 ? middle - radius : middle + radius;
    /* the product of both is the determinant; their difference would cancel */
    values[1] = a * (b / values[0]) - e * (e / values[0]);
}

/* What n numbers without 0 are: how many are positive, and the least and the largest magnitude. */
typedef struct sli_spread {
    sl_int positive;
    double least, most;
} sli_spread;

/* As integers: the order of the bits of magnitudes is theirs, and the latency of a minimum of
 * doubles would be longer than all else. */
static sli_spread sli_spread_of(const double *D, sl_int n) {
    uint64_t least = UINT64_MAX, most = 0, negative = 0, bits;
    sli_spread r;
    sl_int k;
    for (k = 0; k < n; k++) {
        memcpy(&bits, &D[k], sizeof bits);
        negative += bits + bits < bits; /* the carry */
        bits += bits;
        least = bits < least ? bits : least;
        most = bits > most ? bits : most;
    }
    least /= 2;
    most /= 2;
    memcpy(&r.least, &least, sizeof least);
    memcpy(&r.most, &most, sizeof most);
    r.positive = n - (sl_int)negative;
    return r;
}

/* Counts one eigenvalue of D by its sign, and records its magnitude. */
SLI_INLINE void sli_count_pivot(sl_factor_info *info, double d) {
    const double size = fabs(d);
    if (info->positive + info->negative == 0) {
        info->pivot_min = size;
    }
    info->positive += d > 0.0;
    info->negative += d < 0.0;
    info->pivot_min = size < info->pivot_min ? size : info->pivot_min;
    info->pivot_max = size > info->pivot_max ? size : info->pivot_max;
}

/* Refuses the first pivot that is negative, or has a negative eigenvalue. There is one. */
SLI_COLD static void sli_refuse_negative(const sl_factor *F, sli_failure *failure) {
    double values[2] = {0.0, 0.0};
    sl_int k = -1;
    do {
        k++;
        values[0] = values[1] = F->D[k];
        if (F->E != NULL && F->S->pairs[k] == SLI_PAIR_FIRST) {
            sli_pair_eigenvalues(F, k, values);
        } /* a second column is not reached before its first one */
    } while (!(values[0] < 0.0) && !(values[1] < 0.0));
    (void)sli_fail(failure, SL_ERR_PIVOT, F->S->super_of[k], k, -1, fmin(values[0], values[1]));
}

/* Lists those of the first pivots that regularization changed. Returns how many. */
static sl_int sli_list_regularized(const sl_factor *F, sl_int count) {
    sl_int k, listed = 0;
    for (k = 0; k < count && F->rule.shifts != NULL; k++) {
        if (F->rule.shifts[k] != 0.0) {
            F->rule.regularized[listed++] = k;
        }
    }
    return listed;
}

/* Counts the first pivots by sign and records their least and largest magnitude. */
static void sli_count_pivots(sl_factor *F, sl_int count) {
    sl_factor_info info = F->stats.factor; /* in registers: 3 times as fast */
    sl_int k = 0;
    info.positive = info.negative = info.null = info.weak = 0;
    info.regularized = sli_list_regularized(F, count);
    info.pivot_min = info.pivot_max = 0.0;
    if (count > 0 && F->E == NULL && !sli_skips_nulls(F)) {
        const sli_spread r = sli_spread_of(F->D, count);
        if (r.least > 0.0) { /* regularization may underflow */
            info.positive = r.positive;
            info.negative = count - r.positive;
            info.pivot_min = r.least;
            info.pivot_max = r.most;
            k = count;
        }
    }
    for (; k < count; k++) {
        double values[2] = {F->D[k], 0.0};
        int v, n_values = 1;
        if (sli_is_skipped(F, k)) {
            info.null++;
            continue;
        }
        info.weak += F->rule.kinds != NULL && F->rule.kinds[k] == SLI_PIVOT_WEAK;
        if (F->E != NULL && F->S->pairs[k] != SLI_PAIR_NONE) {
            n_values = F->S->pairs[k] == SLI_PAIR_FIRST ? 2 : 0;
            if (n_values > 0) {
                sli_pair_eigenvalues(F, k, values);
            }
        }
        for (v = 0; v < n_values; v++) {
            sli_count_pivot(&info, values[v]);
        }
    }
    F->stats.factor = info;
}

#endif

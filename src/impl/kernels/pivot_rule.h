/* pivot_rule.h: replacement of null pivots and of pivots of the wrong sign */
#ifndef SLI_KERNELS_PIVOT_RULE_H
#define SLI_KERNELS_PIVOT_RULE_H

#include "../base/base.h"

/* What is known about a pivot of a semidefinite matrix before it is computed. */
enum {
    SLI_PIVOT_UNKNOWN = 0, /* null by the tolerance */
    SLI_PIVOT_NULL,        /* the last pivot of a component with a known null vector */
    SLI_PIVOT_KEPT,        /* another pivot of such a component: never null */
    SLI_PIVOT_WEAK         /* the same, and it was within rounding of 0 */
};

/* The arrays are indexed by the column of L. */
typedef struct sli_pivot_rule {
    double null_tolerance; /* of all pivots, or the largest one */
    /* by default each supernode has a tolerance of its own, which follows from its subtree: arrays
     * of the analysis, set with each factorization; NULL: null_tolerance is that of all */
    const sl_int *super_of, *super_first, *first_descendant;
    int replaces;          /* 0: pivots are used as computed, and the caller looks for null ones */
    double regularization; /* 0: a null pivot becomes SLI_NULL_PIVOT */
    signed char *signs;    /* n: 1, -1, or 0 if both signs are right; NULL: all 1 */
    signed char *kinds;    /* n: SLI_PIVOT_*; NULL if null pivots are not skipped */
    /* n: for kept pivots the rounding error that the heaviest row of the component may cause */
    const double *rounding;
    double *shifts;      /* n: what regularization added to each pivot; NULL without it */
    sl_int *regularized; /* n: the pivots that it changed, ascending; NULL: no regularization */
} sli_pivot_rule;

/* Replaces a null pivot that is skipped. It is so large that a division by it gives 0 or almost 0,
 * and finite, so that 0 times it is 0. */
#define SLI_NULL_PIVOT DBL_MAX

/* The last pivot of a singular Laplacian is rounding error. Over meshes, grids and paths of n = 1e2
 * to 1e6 rows it stayed below 60 + n/16 units of rounding. Smaller pivots may be right as well
 * (factor/pivot_judge.h). */
static double sli_null_tolerance(sl_int n) {
    return (64.0 + n / 8) * DBL_EPSILON;
}

/* The tolerance for pivot k. */
SLI_NOINLINE static double sli_rule_tolerance(const sli_pivot_rule *rule, sl_int k) {
    const sl_int *first = rule->super_first, s = rule->super_of == NULL ? 0 : rule->super_of[k];
    return rule->super_of == NULL
               ? rule->null_tolerance
               : sli_null_tolerance(first[s + 1] - first[rule->first_descendant[s]]);
}

/* A pivot is null if |pivot| <= tolerance * magnitude, the sum of the magnitudes that it was
 * computed from. If the magnitude overflows and the pivot does not, nothing is known about
 * cancellation, and only 0 is null. */
SLI_INLINE int sli_is_null(double pivot, double magnitude, double tolerance) {
    const double size = fabs(pivot);
    return size == 0.0 || (sli_is_finite(magnitude) && size <= tolerance * magnitude);
}

/* Is pivot k null by the rule? */
SLI_INLINE int sli_is_null_by_rule(const sli_pivot_rule *rule, sl_int k, double pivot,
                                   double magnitude) {
    return sli_is_null(pivot, magnitude, rule->null_tolerance) &&
           sli_is_null(pivot, magnitude, sli_rule_tolerance(rule, k));
}

/* The pivot of column k where null pivots are skipped. A kept pivot is not null in exact
 * arithmetic. Rounding may have made it 0, or of the wrong sign if it is small, because it may come
 * from rows that are heavier than this one. A pivot below one rounding error of its own row gets
 * that size, and a small one of the wrong sign changes its sign: both are changes of A within
 * rounding. A larger pivot of the wrong sign means that A is indefinite; the caller refuses it. */
SLI_INLINE double sli_pivot_skipped(const sli_pivot_rule *rule, sl_int k, double d,
                                    double magnitude) {
    const int is_null = sli_is_null_by_rule(rule, k, d, magnitude);
    const double sign = rule->signs[k] < 0 ? -1.0 : 1.0, least = DBL_EPSILON * magnitude;
    const int is_wrong = d * sign < 0.0;
    if (!sli_is_finite(d)) {
        return d;
    }
    if (rule->kinds[k] == SLI_PIVOT_NULL) {
        return SLI_NULL_PIVOT;
    }
    if (rule->kinds[k] == SLI_PIVOT_UNKNOWN) {
        return is_null ? SLI_NULL_PIVOT : d;
    }
    rule->kinds[k] = is_null || is_wrong ? SLI_PIVOT_WEAK : SLI_PIVOT_KEPT;
    if (is_wrong && !(fabs(d) <= rule->rounding[k])) {
        return d;
    }
    return fabs(d) < least ? sign * least : sign * fabs(d);
}

/* The pivot of column k, d as computed, by a rule that replaces pivots. A regularized null pivot is
 * regularization * magnitude, so that scaling A changes nothing. A pivot of the wrong sign that is
 * too large for a rounding error keeps its size and changes its sign: a small value would let L
 * grow without bound. Not inlined: inlining slows the factorization of definite matrices by up to 8
 * %. */
SLI_NOINLINE static double sli_pivot_by_rule(const sli_pivot_rule *rule, sl_int k, double d,
                                             double magnitude) {
    int is_null, sign;
    double least;
    if (rule->regularization == 0.0) {
        return sli_pivot_skipped(rule, k, d, magnitude);
    }
    is_null = sli_is_null_by_rule(rule, k, d, magnitude);
    sign = rule->signs == NULL ? 1 : rule->signs[k];
    rule->shifts[k] = 0.0;
    if (!is_null && !(d * sign < 0.0)) {
        return d;
    }
    sign = sign != 0 ? sign : d < 0.0 ? -1 : 1;
    least = rule->regularization * (magnitude > 0.0 ? magnitude : 1.0);
    least = sign * (fabs(d) > least ? fabs(d) : least);
    rule->shifts[k] = least - d;
    return least;
}

#endif

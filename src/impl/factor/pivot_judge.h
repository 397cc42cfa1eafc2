/* pivot_judge.h: after a factorization: are its smallest pivots null, or right? */
#ifndef SLI_FACTOR_PIVOT_JUDGE_H
#define SLI_FACTOR_PIVOT_JUDGE_H

#include "pivot_suspects.h"
#include "storage_type.h"

/* The default tolerance grows with the rows that a pivot may have been computed from. A pivot below
 * it is a rounding error of a singular matrix, or it is right: pivots of smoothing,
 * (I + t D'D) x = y, are 1e-12 of what they were computed from. Such pivots are kept until L is
 * there, which shows the error of each.
 *
 * L D L' = A + E has |E_ij| of the order of epsilon sqrt(m_i m_j), m_j = (|L| |D| |L'|)_jj. Let z
 * be row k of L^-1, so that d_k = z' A z and z_k = 1. The error of d_k is z' E z. With
 * t_j = z_j^2 m_j sqrt(1 + r_j), where r_j columns have an entry in row j, it is estimated as
 *
 *     epsilon (6 (sum t_j^2)^(1/2) + sum t_j c_j / 10),  c_j = 1 + max(0, r_j - 4) / 3,
 *
 * the first term for errors of random sign, the second one for errors of one sign: those of meshes
 * with equal weights, and, by c, of large fronts of equal numbers, which round alike. A pivot
 * within it is null: with a unit diagonal, A is singular up to rounding. The last pivots of
 * singular Laplacians were at most 0.61 of the estimate, in complete bipartite graphs; 0.1 in
 * sparse ones of 10 to 1e5 rows. Those of smoothing with t = 1e15 are above it, and accurate.
 * Beyond 200 rows of equal weights, dense singular matrices may have last pivots above the
 * tolerance, which nothing judges. */
#define SLI_JUDGE_RANDOM 6.0
#define SLI_JUDGE_BIASED 0.1
#define SLI_JUDGE_ALIKE 3.0 /* of c */
#define SLI_JUDGE_FEW 4.0   /* the same */

/* Pivots are judged until this many times the entries of L have been read. Those that are left are
 * null. */
#define SLI_JUDGE_READS 64.0

typedef struct sli_judge {
    sl_factor *F;
    double *z, *t, *bias; /* n: z; m_j sqrt(1 + r_j); the same times c_j */
    double reads;         /* entries of L that may still be read */
    double error;         /* of the pivot that was judged last; 0: not known */
} sli_judge;

/* Row r of the front of supernode s, as a column of L. */
SLI_INLINE sl_int sli_judge_row(const sl_symbolic *S, sl_int s, sl_int r) {
    const sli_step *step = &S->steps[s];
    return r < step->width ? step->column + r : S->rows[S->rows_begin[s] + r - step->width];
}

/* Computes t of the columns of supernodes first .. last, whose descendants are among them. */
SLI_COLD static void sli_judge_weigh(const sli_judge *judge, sl_int first, sl_int last) {
    const sl_factor *F = judge->F;
    const sl_symbolic *S = F->S;
    const sl_int begin = S->super_first[first], end = S->super_first[last + 1];
    sl_int s, j, r;
    for (j = begin; j < end; j++) {
        judge->z[j] = 1.0; /* counts the entries of the row */
        judge->t[j] = 0.0;
    }
    for (s = first; s <= last; s++) {
        const sli_step *step = &S->steps[s];
        for (j = 0; j < step->width; j++) {
            const sl_int c = step->column + j;
            double size = fabs(F->D[c]);
            if (F->E != NULL) { /* of a 2x2 pivot, the sum of a row of its block */
                size += fabs(F->E[S->pairs[c] == SLI_PAIR_SECOND ? c - 1 : c]);
            }
            judge->t[c] += size;
            for (r = j + 1; r < step->width + step->below; r++) {
                const sl_int row = sli_judge_row(S, s, r);
                double l;
                if (row >= end) {
                    break;
                }
                l = sli_entry(F, step->panel + sli_panel_at(step->width, r, j));
                judge->t[row] += 2.0 * l * l * size;
                judge->z[row] += 1.0;
            }
        }
    }
    for (j = begin; j < end; j++) {
        judge->t[j] *= sqrt(judge->z[j]);
        judge->bias[j] =
            judge->t[j] * (1.0 + fmax(judge->z[j] - 1.0 - SLI_JUDGE_FEW, 0.0) / SLI_JUDGE_ALIKE);
    }
}

/* z := row k of L^-1 in the columns of supernode s, from the columns after it. */
static void sli_judge_super(const sli_judge *judge, sl_int s, sl_int k) {
    const sl_symbolic *S = judge->F->S;
    const sli_step *step = &S->steps[s];
    sl_int j, r;
    for (j = sli_min(step->width, k - step->column) - 1; j >= 0; j--) {
        double sum = 0.0;
        for (r = j + 1; r < step->width + step->below; r++) {
            const sl_int row = sli_judge_row(S, s, r);
            if (row > k) {
                break;
            }
            sum +=
                judge->z[row] * sli_entry(judge->F, step->panel + sli_panel_at(step->width, r, j));
        }
        judge->z[step->column + j] = -sum;
    }
}

/* Is pivot k within its error? */
SLI_COLD static int sli_judge_is_null(sli_judge *judge, sl_int k) {
    const sl_factor *F = judge->F;
    const sl_symbolic *S = F->S;
    const sl_int own = S->super_of[k], from = S->first_descendant[own];
    const double size = fabs(F->D[k]);
    double sum = 0.0, squares = 0.0;
    sl_int s, j;
    judge->reads -= (double)(S->panel_begin[own + 1] - S->panel_begin[from]);
    judge->error = 0.0;
    if (judge->reads < 0.0) {
        return 1;
    }
    judge->z[k] = 1.0;
    for (s = own; s >= from; s--) {
        sli_judge_super(judge, s, k);
    }
    for (j = S->super_first[from]; j <= k; j++) {
        const double square = judge->z[j] * judge->z[j], t = square * (judge->t[j] / size);
        sum += square * (judge->bias[j] / size);
        squares += t * t;
    }
    judge->error = DBL_EPSILON * (SLI_JUDGE_RANDOM * sqrt(squares) + SLI_JUDGE_BIASED * sum) * size;
    return !(judge->error < size);
}

/* Prepares to judge pivot k and others. */
SLI_COLD static sl_status sli_judge_begin(sli_judge *judge, sl_factor *F, sl_int k,
                                          sli_failure *failure) {
    judge->F = F;
    judge->reads = SLI_JUDGE_READS * (double)F->S->panel_begin[F->S->n_supers];
    judge->z = (double *)sli_judge_memory(F, F->S->n, 3 * sizeof(double));
    if (judge->z == NULL) {
        return sli_judge_not(F, k, failure);
    }
    judge->t = judge->z + F->S->n;
    judge->bias = judge->t + F->S->n;
    return SL_OK;
}

/* Refuses pivot k, which is null. bound: up to which size it is, if its error is not known. */
SLI_COLD static sl_status sli_judge_end(sli_judge *judge, sl_int k, double bound,
                                        sli_failure *failure) {
    const sl_factor *F = judge->F;
    (void)sli_fail(failure, SL_ERR_PIVOT, F->S->super_of[k], k, -1, F->D[k]);
    failure->bound = judge->error > 0.0 ? judge->error : bound;
    return failure->status;
}

SLI_COLD static void sli_suspects_clear(sl_factor *F) {
    sl_int s;
    for (s = 0; s < F->S->n_supers; s++) {
        F->extents[s].suspects = 0;
    }
}

/* Refuses the first null pivot among the suspects of supernodes 0 .. last. at: as below; its
 * numbers need not be there. */
static sl_status sli_judge_suspects(sl_factor *F, sl_int last, sl_int at, sli_failure *failure) {
    const sl_symbolic *S = F->S;
    sli_judge judge;
    sl_int s, k = S->super_first[last] + F->extents[last].suspects - 1;
    int is_null = 0;
    if (sli_judge_begin(&judge, F, k, failure) != SL_OK) {
        return failure->status;
    }
    sli_judge_weigh(&judge, 0, at == last ? last - 1 : last);
    for (s = 0; s <= last && !is_null; s++) {
        const double bound =
            sli_rule_tolerance(&F->rule, S->super_first[s]) * F->extents[s].magnitude;
        const sl_int end = F->extents[s].suspects > 0 ? S->super_first[s + 1] : -1;
        for (k = S->super_first[s] + F->extents[s].suspects - 1; k < end && !is_null; k++) {
            judge.error = 0.0;
            is_null = fabs(F->D[k]) <= bound && (F->E == NULL || S->pairs[k] == SLI_PAIR_NONE) &&
                      (s == at || sli_judge_is_null(&judge, k));
            if (is_null) {
                (void)sli_judge_end(&judge, k, bound, failure);
            }
        }
    }
    sli_free(&F->allocator, judge.z);
    return failure->status;
}

/* Refuses the first null pivot among those that the factorization left to this function. at: the
 * supernode in which it failed, perhaps because of such a pivot, or -1. */
SLI_COLD static sl_status sli_nulls_judge(sl_factor *F, sl_int at, sli_failure *failure) {
    const sl_symbolic *S = F->S;
    sl_int s, last = -1;
    for (s = 0; s < S->n_supers; s++) {
        last = F->extents[s].suspects > 0 && (at == -1 || s <= at) ? s : last;
    }
    if (last != -1) {
        (void)sli_judge_suspects(F, last, at, failure);
        sli_suspects_clear(F);
    }
    return failure->status;
}

/* Is pivot `last` null, or is an earlier pivot of its tree lost in the rounding of heavier ones?
 * Nothing is known of a pivot that was computed from such a one. */
static int sli_judge_last(sli_judge *judge, sl_int last) {
    const sl_factor *F = judge->F;
    const sl_symbolic *S = F->S;
    double most = 0.0;
    sl_int k = last, first;
    int is_null;
    while (S->parent[k] != -1) { /* explicit zeros join other components to this one */
        k = S->parent[k];
    }
    first = S->first_descendant[S->super_of[k]];
    sli_judge_weigh(judge, first, S->super_of[last]);
    first = S->super_first[first];
    is_null = sli_judge_is_null(judge, last);
    for (k = first; k < last && !is_null; k++) {
        const double size = fabs(F->D[k]);
        most = size > most ? size : most;
        is_null = size <= sli_null_rounding(k - first + 1) * most && sli_judge_is_null(judge, k);
    }
    return is_null;
}

/* Refuses the first one of `count` last pivots of components, if it is not known to be right. The
 * components have constants as a null vector within rounding. */
SLI_COLD static sl_status sli_lasts_judge(sl_factor *F, const sl_int *last, sl_int count,
                                          sli_failure *failure) {
    sli_judge judge;
    sl_int m;
    if (sli_judge_begin(&judge, F, last[0], failure) != SL_OK) {
        return failure->status;
    }
    for (m = 0; m < count && failure->status == SL_OK; m++) {
        if (sli_judge_last(&judge, last[m])) {
            (void)sli_judge_end(&judge, last[m], 0.0, failure);
        }
    }
    sli_free(&F->allocator, judge.z);
    return failure->status;
}

/* May sli_signs_judge find a pivot? */
static int sli_signs_are_suspected(const sl_factor *F) {
    const sl_factor_info *info = &F->stats.factor;
    return F->rule.super_of != NULL && !F->rule.replaces && F->E == NULL && info->positive > 0 &&
           info->negative > 0 &&
           info->pivot_min <= 0.125 * sli_null_rounding(F->S->n) * info->pivot_max;
}

/* A pivot whose sign is rounding error would be counted in the inertia. Refuses the first pivot of
 * a tree that has another sign than those before it, if it is within its error; if it is not, A is
 * indefinite. Only a pivot that is small against the largest one can be. */
SLI_COLD static sl_status sli_signs_judge(sl_factor *F, sli_failure *failure) {
    const sl_symbolic *S = F->S;
    sl_int k, first = 0, is_mixed = 0;
    double most = 0.0;
    for (k = 0; k < S->n && failure->status == SL_OK; k++) {
        const double size = fabs(F->D[k]);
        if (!is_mixed && (F->D[k] < 0.0) != (F->D[first] < 0.0)) {
            sli_judge judge;
            is_mixed = 1;
            if (size <= 0.125 * sli_null_rounding(k - first + 1) * most &&
                sli_judge_begin(&judge, F, k, failure) == SL_OK) {
                sli_judge_weigh(&judge, S->first_descendant[S->super_of[k]], S->super_of[k]);
                if (sli_judge_is_null(&judge, k)) {
                    (void)sli_judge_end(&judge, k, 0.0, failure);
                }
                sli_free(&F->allocator, judge.z);
            }
        }
        most = size > most ? size : most;
        if (S->parent[k] == -1) {
            first = k + 1;
            is_mixed = 0;
            most = 0.0;
        }
    }
    return failure->status;
}

#endif

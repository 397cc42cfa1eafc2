/* growth.h: after a factorization: its pivot growth, and the pivot that causes it */
#ifndef SLI_FACTOR_GROWTH_H
#define SLI_FACTOR_GROWTH_H

#include "storage_type.h"

/* The computed factors satisfy L D L' = P A P' + E, |E| <= c n epsilon |L| |D| |L'| [Hi02] 11.1.
 * No entry of the semidefinite matrix |L| |D| |L'| exceeds its largest diagonal entry. Null pivots
 * are judged by that diagonal: pivot k is computed from magnitudes of sum
 * |a_kk| + sum_j |l_kj d_j l_kj|. So growth costs one comparison a pivot.
 *
 * If all pivots of a component have one sign, the sum is 2 |a_kk| - |d_k|: the growth is at most 2,
 * however A is scaled. In the other components it says how many digits of A the factor has lost.
 * Over 1e5 random systems of 24 families (tests/lib/random_systems.h) the backward error of a solve
 * stayed below 1.5 epsilon times the growth.
 *
 * The limit. Three refinements brought every quasi-definite system with a growth below 1e14 to a
 * backward error below 1e-10, and all up to 2e15 below 1e-8. So the factorization refuses only
 * where L D L' may have no digit of A. */
#define SLI_GROWTH_LIMIT (1.0 / DBL_EPSILON)
#define SLI_GROWTH_LIMIT_FLOAT (1.0 / (double)FLT_EPSILON) /* where L is rounded to float */

/* The pivot j that contributes most to row k, max |l_kj d_j l_kj|; -1 if row k of L is empty. */
SLI_COLD static sl_int sli_growth_cause(const sl_factor *F, sl_int k) {
    const sl_symbolic *S = F->S;
    const sl_int own = S->super_of[k];
    double most = 0.0;
    sl_int s, j, cause = -1;
    for (s = S->first_descendant[own]; s <= own; s++) {
        const sli_step *step = &S->steps[s];
        const sl_int *rows = S->rows + S->rows_begin[s];
        const sl_int at = s == own ? -1 : sli_lower_bound(rows, step->below, k);
        const sl_int r = s == own ? k - step->column : step->width + at;
        if (s != own && (at == step->below || rows[at] != k)) {
            continue;
        }
        for (j = 0; j < sli_min(r, step->width); j++) {
            const sl_off entry = step->panel + sli_panel_at(step->width, r, j);
            const sl_int c = step->column + j;
            const double l = sli_entry(F, entry);
            double size = fabs(l * F->D[c] * l);
            if (F->E != NULL && S->pairs[c] == SLI_PAIR_FIRST) { /* L(r, r) is stored as 0 */
                size += 2.0 * fabs(l * F->E[c] * sli_entry(F, entry + SLI_TILE));
            }
            if (size > most) {
                most = size;
                cause = step->column + j;
            }
        }
    }
    return cause;
}

/* The growth of the largest magnitude. The sum may overflow, but no term of a finite pivot does.
 * Subnormal numbers are rounded as if epsilon were larger. */
SLI_INLINE double sli_growth(double magnitude, double entry) {
    const double finite = magnitude < DBL_MAX ? magnitude : DBL_MAX; /* fmin is a call */
    const double growth = magnitude > 0.0 ? finite / entry : 0.0;
    return entry < DBL_MIN && growth > 0.0 ? growth * (DBL_MIN / entry) : growth;
}

/* Refuses the tree of supernodes first .. last, whose growth exceeds the limit. entry: the largest
 * |a|. Row k of the first such magnitude is where the growth shows; it goes back to a pivot that is
 * small. */
SLI_COLD static sl_status sli_growth_refuse(const sl_factor *F, sl_int first, sl_int last,
                                            double entry, sli_failure *failure) {
    const double bound = F->limits.growth * entry;
    sl_int s = first, k, cause;
    while (s < last && !(sli_growth(F->extents[s].magnitude, entry) > F->limits.growth)) {
        s++;
    }
    k = F->extents[s].pivot;
    do {
        cause = sli_growth_cause(F, k);
        k = cause == -1 ? k : cause;
    } while (cause != -1 && fabs(F->D[k]) > bound);
    return sli_fail(failure, SL_ERR_INACCURATE, F->S->super_of[k], k, -1, F->D[k]);
}

/* Measures the growth of every tree, and refuses the first one beyond the limit. Returns whether
 * pivots are left to sli_nulls_judge. */
static int sli_growth_check(sl_factor *F, sli_failure *failure) {
    const sl_int *low = F->S->first_descendant;
    const sli_extent *const extents = F->extents;
    double most_growth = 0.0, most_entry = 0.0, bound = 0.0;
    sl_int s, first, root, suspects = 0;
    int has_refused = 0;
    for (root = F->S->n_supers - 1; root >= 0; root = first - 1) {
        uint64_t bits[2], most[2]; /* integers: half of the latency */
        double entry, magnitude, growth;
        memcpy(most, &extents[root], sizeof most); /* entry, magnitude */
        suspects |= extents[root].suspects;
        first = low[root];
        for (s = first; s < root; s++) {
            memcpy(bits, &extents[s], sizeof bits);
            most[0] = bits[0] > most[0] ? bits[0] : most[0];
            most[1] = bits[1] > most[1] ? bits[1] : most[1];
            suspects |= extents[s].suspects;
        }
        memcpy(&entry, &most[0], sizeof entry);
        memcpy(&magnitude, &most[1], sizeof magnitude);
        most_entry = entry > most_entry ? entry : most_entry; /* fmax is a call */
        if (entry >= DBL_MIN && magnitude <= bound * entry) {
            continue; /* the growth is not the largest: no division */
        }
        growth = sli_growth(magnitude, entry);
        most_growth = growth > most_growth ? growth : most_growth;
        /* 1 has no rounding, and 4 epsilon exceed those of a product and a quotient */
        bound = most_growth * (1.0 - 4.0 * DBL_EPSILON);
        bound = most_growth < 1.0 || most_growth > F->limits.growth ? 0.0
                : bound > 1.0                                       ? bound
                                                                    : 1.0;
        if (growth > F->limits.growth &&
            (failure->status == SL_OK || has_refused)) { /* branches untested: no other failure */
            has_refused = 1;                             /* of several trees, the first one */
            (void)sli_growth_refuse(F, first, root, entry, failure);
        }
    }
    F->stats.factor.growth = most_growth;
    F->stats.factor.entry_max = most_entry;
    return suspects != 0;
}

#endif

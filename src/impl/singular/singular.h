/* singular.h: the calls of factors that skip null pivots, as a table */
#ifndef SLI_SINGULAR_SINGULAR_H
#define SLI_SINGULAR_SINGULAR_H

#include "centering.h"
#include "consistency.h"
#include "nullspace.h"

static void sli_null_layout(sl_factor *F, sli_block *b, int has_mass) {
    const uint64_t n = (uint64_t)F->S->n, vectors = (uint64_t)F->null.vectors;
    const sl_int trees = F->S->stats.symbolic.components;
    F->null.pivots = SLI_TAKE(b, sl_int, n);
    F->rule.kinds = SLI_TAKE(b, signed char, n);
    F->null.z = SLI_TAKE(b, double, n *vectors);
    F->null.g = SLI_TAKE(b, double, n *vectors);
    if (has_mass) {
        F->null.anchors = SLI_TAKE(b, sl_int, trees);
        F->null.squares = SLI_TAKE(b, double, trees);
        F->null.mass = SLI_TAKE(b, double, n);
        F->null.center = SLI_TAKE(b, double, n *(uint64_t)sli_center_count(F));
        F->null.ratios = SLI_TAKE(b, double, trees);
    }
}

static void sli_null_layout_scratch(sl_factor *F, sli_block *b) {
    const sl_symbolic *S = F->S;
    const uint64_t n = (uint64_t)S->n;
    F->rule.signs = SLI_TAKE(b, signed char, n);
    F->null.rows = SLI_TAKE(b, sli_null_row, n);
    F->null.last = SLI_TAKE(b, sl_int, n);
    F->null.rounding = SLI_TAKE(b, double, n);
    F->null.sweep = SLI_TAKE(b, double, sli_sweep_scratch(S->tallest, S->widest, 1));
    if (F->null.vectors > 1) {
        F->null.chain = SLI_TAKE(b, sl_int, n);
        F->null.row_entries = SLI_TAKE(b, sl_int, n);
        F->null.products = SLI_TAKE(b, double, n *((uint64_t)F->null.vectors + 2));
    }
}

/* Copies the weights to pivot order. A component whose weights are all 0, such as a vertex without
 * a face, gets weight 1 in each row. */
static sl_status sli_mass_fill(sl_factor *F, const double *mass, sl_stats *stats) {
    const sl_symbolic *S = F->S;
    sl_int k, first = 0, any = 0;
    for (k = 0; k < S->n; k++) {
        const double m = mass[S->perm[k]];
        if (!sli_is_finite(m)) {
            return sli_fail_at(stats, SL_ERR_ARGUMENT, S->perm[k], -1, m,
                               "options.mass is not finite");
        }
        F->null.mass[k] = m;
        any |= m != 0.0;
        if (S->parent[k] == -1) { /* in a postorder a tree ends at its root */
            for (; first <= k; first++) {
                F->null.mass[first] = any ? F->null.mass[first] : 1.0;
            }
            any = 0;
        }
    }
    return SL_OK;
}

/* Copies the null vectors and the weights. */
static sl_status sli_null_fill(sl_factor *F, const sl_options *opt, sl_stats *stats) {
    const sl_symbolic *S = F->S;
    sl_int i, j;
    memset(F->rule.kinds, 0, (size_t)S->n);
    for (j = 0; j < F->null.vectors; j++) {
        const size_t column = (size_t)j * (size_t)S->n;
        for (i = 0; i < S->n; i++) {
            const double z = opt->null_vector == NULL ? 1.0 : opt->null_vector[column + (size_t)i];
            if (!sli_is_finite(z)) {
                return sli_fail_at(stats, SL_ERR_ARGUMENT, i, -1, z,
                                   "options.null_vector is not finite");
            }
            F->null.z[column + (size_t)S->iperm[i]] = z;
        }
    }
    return F->null.mass != NULL ? sli_mass_fill(F, opt->mass, stats) : SL_OK;
}

/* Ends a factorization. */
static sl_status sli_null_finish(sl_factor *F, const sli_source *from, sli_failure *failure) {
    if (failure->status == SL_OK) {
        (void)sli_nulls_find(F, from, failure);
    }
    if (failure->status == SL_ERR_PIVOT) {
        sli_entries_finite_check(F->S, from, failure); /* kinds and signs of pivots depend on it */
    }
    return failure->status;
}

static const sli_singular sli_singular_calls = {
    sli_null_layout,   sli_null_layout_scratch,
    sli_null_fill,     sli_null_vectors_check,
    sli_null_finish,   sli_null_load,
    sli_null_forward,  sli_null_check,
    sli_center,        sli_norms,
    sli_null_dot_next,
};

#endif

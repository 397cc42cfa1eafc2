/* centering.h: between the sweeps: the solution that the weights choose */
#ifndef SLI_SINGULAR_CENTERING_H
#define SLI_SINGULAR_CENTERING_H

#include "null_sums.h"

/* For one tree and each right-hand side: c' and t of nullspace.h; with several null vectors
 * (center_several.h) c is U' y for the columns of V, and V' y for those of U. */
typedef struct sli_center_terms {
    sl_int count; /* columns of c */
    double c[2 * SLI_NULL_VECTORS_MAX][SLI_TILE], t[SLI_TILE];
} sli_center_terms;

/* Computes the terms of the tree of steps first .. root, for up to 8 lanes from `lane` on. m: the
 * number of its anchor, if it has only one. */
static void sli_center_tree_terms(const sl_factor *F, const sli_packed *y, sl_int lane,
                                  sl_int first, sl_int root, sl_int m, sli_center_terms *terms) {
    const sl_int lanes = sli_min(y->lanes, SLI_TILE), count = terms->count;
    sl_int s, j, r, at;
    for (j = 0; j < count; j++) {
        double chains[SLI_TILE] = {0.0};
        for (s = first; s <= root; s++) {
            sli_chains_add_step(chains, F->null.center + (size_t)j * (size_t)F->S->n, y,
                                &y->R->steps[s], lane);
        }
        sli_chains_sum(chains, lanes, terms->c[(j + count / 2) % count]);
    }
    at = count == 1 ? sli_reach_index_of(y->R, F->null.anchors[m]) : -1;
    for (r = 0; r < lanes && count == 1; r++) {
        const double c = at != -1 ? sli_packed_row(y, at)[lane + r] * F->null.ratios[m] : 0.0;
        terms->t[r] = c * F->null.squares[m] - terms->c[0][r];
        terms->c[0][r] = c;
    }
}

/* row := y - c w on the columns of one step of the backward sweep. Called with constant lanes. */
SLI_ALWAYS_INLINE void sli_center_columns(double *row, const double *v, const double *D,
                                          sl_int columns, sl_int width, const double *c,
                                          sl_int lanes) {
    sl_int k, r;
    for (k = 0; k < columns; k++, row += width) {
        const double w = v[k] * D[k];
        SLI_UNROLL
        for (r = 0; r < lanes; r++) {
            row[r] -= c[r] * w;
        }
    }
}

/* x(j) := 0 at the null pivots from number m on of a tree with several null vectors. */
static void sli_center_clear(const sl_factor *F, const sli_packed *x, sl_int lane, sl_int m,
                             sl_int root) {
    for (; m < F->null.count && F->null.pivots[m] <= root; m++) {
        const sl_int null = F->null.pivots[m], j = sli_reach_index_of(x->R, null);
        if (j != -1 && F->rule.kinds[null] == SLI_PIVOT_NULL) {
            SLI_ZERO(sli_packed_row(x, j) + lane, sli_min(x->lanes, SLI_TILE));
        }
    }
}

/* Subtracts the terms of a tree in one step of the backward vector. */
static void sli_center_step(const sl_factor *F, const sli_packed *x, sl_int lane,
                            const sli_step *step, const sli_center_terms *terms) {
    double *row = sli_packed_row(x, step->base) + lane;
    const sl_int columns = sli_step_columns(step), width = x->lanes;
    sl_int j;
    for (j = 0; j < terms->count; j++) {
        const double *v = F->null.center + (size_t)j * (size_t)F->S->n + step->column;
        const double *D = F->divisors + step->column;
#define SLI_CALL(constant) sli_center_columns(row, v, D, columns, width, terms->c[j], constant)
        SLI_FOR_LANES(width, SLI_CALL)
#undef SLI_CALL
    }
}

/* Centers between the sweeps. y is the forward vector and x, which may be the same, the backward
 * vector. Trees ascend in both. Trees without a row of b need nothing. uses: how many pins hold
 * each null pivot, which is then left alone; NULL: none. Where components have several null
 * vectors, x is 0 at their null pivots before, also if there are no weights: the columns of L are 0
 * there, and a local solve may reach some of them with b only, or with x. */
static void sli_center(const sl_factor *F, const sli_query *q, const sli_vectors *v, sl_int lanes,
                       const sl_int *uses) {
    const sli_packed y = sli_packed_of(&q->forward, v->y, lanes);
    const sli_packed x = sli_packed_of(&q->backward, v->x, lanes);
    const int is_one = F->null.vectors == 1;
    const sl_int *list = is_one ? F->null.anchors : F->null.pivots;
    const sl_int listed = is_one ? F->null.n_anchors : F->null.count;
    const sli_reach *to = x.R;
    sli_center_terms terms;
    sl_int first = 0, at = 0, root, m, j, k, lane;
    terms.count = F->null.is_centered ? sli_center_count(F) : 0;
    for (root = 0; root < y.R->count && listed > 0; root++) {
        sli_tree_range tree;
        if (y.R->steps[root].up != -1) {
            continue;
        }
        tree = sli_tree_range_of(F->S, &y.R->steps[root]);
        m = sli_lower_bound(list, listed, tree.first);
        if (m < listed && list[m] <= tree.root &&
            (uses == NULL || uses[sli_lower_bound(F->null.pivots, F->null.count, list[m])] == 0)) {
            j = is_one ? sli_reach_index_of(to, list[m]) : -1;
            for (lane = 0, k = at; lane < y.lanes; lane += SLI_TILE) {
                sli_center_tree_terms(F, &y, lane, first, root, m, &terms);
                if (!is_one) {
                    sli_center_clear(F, &x, lane, m, tree.root);
                }
                for (k = at; k < to->count && to->steps[k].column <= tree.root; k++) {
                    if (to->steps[k].column >= tree.first) {
                        sli_center_step(F, &x, lane, &to->steps[k], &terms);
                    }
                }
                if (j != -1) { /* the backward sweep divides by 1 there */
                    SLI_COPY(sli_packed_row(&x, j) + lane, terms.t, sli_min(x.lanes, SLI_TILE));
                }
            }
            at = k;
        }
        first = root + 1;
    }
}

#endif

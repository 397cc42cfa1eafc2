/* singular.h: solves with null pivots: the consistency check, and centering */
#ifndef SLI_SOLVE_SINGULAR_H
#define SLI_SOLVE_SINGULAR_H

#include "../analysis/reach.h"
#include "../factor/null_basis.h"
#include "query.h"

/* Sums over the `count` doubles of a step, which begins at a whole tile. 8 independent chains of
 * additions hide the latency. Double f of a step goes to chain f % 8, in a local sweep as in a full
 * one, so the bits agree. next: from 8 doubles to the next 8. */
static void sli_chains_norm(double *chains, const double *row, ptrdiff_t count, ptrdiff_t next) {
    ptrdiff_t f = 0;
    sl_int q;
    for (; f + SLI_TILE <= count; f += SLI_TILE, row += next) {
        SLI_UNROLL
        for (q = 0; q < SLI_TILE; q++) {
            chains[q] += fabs(row[q]);
        }
    }
    for (q = 0; f < count; q++, f++) {
        chains[q] += fabs(row[q]);
    }
}

/* The same for products with v; called with constant lanes. */
SLI_ALWAYS_INLINE void sli_chains_dot(double *chains, const double *v, const double *row,
                                      ptrdiff_t next, sl_int columns, sl_int lanes) {
    const ptrdiff_t count = (ptrdiff_t)columns * lanes;
    ptrdiff_t f = 0;
    double sums[SLI_TILE]; /* in registers: chains could be a part of v */
    sl_int q;
    memcpy(sums, chains, sizeof sums);
    for (; f + SLI_TILE <= count; f += SLI_TILE, v += SLI_TILE / lanes, row += next) {
        SLI_UNROLL
        for (q = 0; q < SLI_TILE; q++) { /* sum(r) += v(k) y(k, r) */
            sums[q] += v[q / lanes] * row[q];
        }
    }
    memcpy(chains, sums, sizeof sums);
    for (q = 0; f < count; q++, f++) { /* untested: none left of 8 lanes */
        chains[q] += v[q / lanes] * row[q];
    }
}

/* sums(r) := the sum of the chains of right-hand side r, in order. */
static void sli_chains_sum(const double *chains, sl_int lanes, double *sums) {
    sl_int q;
    for (q = 0; q < lanes; q++) {
        sums[q] = chains[q];
    }
    for (; q < SLI_TILE; q++) {
        sums[q % lanes] += chains[q];
    }
}

/* Expands a call for each number of lanes, as a constant. */
#define SLI_FOR_LANES(lanes, call) \
    if ((lanes) == 1) { \
        call(1); \
    } else if ((lanes) == 2) { \
        call(2); \
    } else if ((lanes) == 4) { \
        call(4); \
    } else { \
        call(8); \
    }

static void sli_chains_add(double *chains, const double *v, const double *row, ptrdiff_t next,
                           sl_int columns, sl_int lanes) {
#define SLI_CALL(constant) sli_chains_dot(chains, v, row, next, columns, constant)
    SLI_FOR_LANES(lanes, SLI_CALL)
#undef SLI_CALL
}

/* A packed block of vectors over a reach: columns x lanes. Sums take 8 lanes after 8 lanes. */
typedef struct sli_packed {
    const sli_reach *R;
    double *v;
    sl_int lanes;
} sli_packed;

SLI_INLINE sli_packed sli_packed_of(const sli_reach *R, double *v, sl_int lanes) {
    sli_packed b;
    b.R = R;
    b.v = v;
    b.lanes = lanes;
    return b;
}

SLI_INLINE double *sli_packed_row(const sli_packed *b, sl_int row) {
    return b->v + (ptrdiff_t)row * b->lanes;
}

/* Adds the products of v with lanes r .. r+7 of a step, or with all lanes if they are fewer. */
static void sli_chains_add_step(double *chains, const double *v, const sli_packed *b,
                                const sli_step *step, sl_int r) {
    sli_chains_add(chains, v + step->column, sli_packed_row(b, step->base) + r,
                   sli_max(b->lanes, SLI_TILE), sli_step_columns(step),
                   sli_min(b->lanes, SLI_TILE));
}

/* sums(r) := those of the chains of all lanes. */
static void sli_chains_sum_all(const double *chains, sl_int lanes, double *sums) {
    sl_int r;
    for (r = 0; r < lanes; r += SLI_TILE) {
        sli_chains_sum(chains + r, sli_min(lanes, SLI_TILE), sums + r);
    }
}

/* norms(r) := the sum of |b|. */
static void sli_norms(const sli_packed *b, double *norms) {
    const sli_reach *R = b->R;
    const sl_int lanes = b->lanes;
    double chains[SLI_BLOCK_SINGULAR];
    sl_int s, r;
    SLI_ZERO(chains, sli_max(lanes, SLI_TILE));
    for (s = 0; s < R->count; s++) {
        for (r = 0; r < lanes; r += SLI_TILE) {
            sli_chains_norm(chains + r, sli_packed_row(b, R->steps[s].base) + r,
                            (ptrdiff_t)sli_step_columns(&R->steps[s]) * sli_min(lanes, SLI_TILE),
                            sli_max(lanes, SLI_TILE));
        }
    }
    sli_chains_sum_all(chains, lanes, norms);
}

/* The columns of the whole tree whose root is a step of a reach. */
typedef struct sli_tree_range {
    sl_int first, root;
} sli_tree_range;

SLI_INLINE sli_tree_range sli_tree_range_of(const sl_symbolic *S, const sli_step *root) {
    const sl_int super = S->super_of[root->column];
    sli_tree_range tree;
    tree.first = S->super_first[S->first_descendant[super]];
    tree.root = S->super_first[super + 1] - 1;
    return tree;
}

/* z' b of a null pivot whose null vector z is known, scaled to 1 there. */
typedef struct sli_null_dot {
    sl_int null;
    sl_int number; /* among the null pivots */
    sl_int next;   /* the number that the search continues with */
    double sums[SLI_BLOCK_SINGULAR];
} sli_null_dot;

/* Finds the next null pivot of a tree, from number dot->next on, whose null vector is known, and
 * computes z' b before the forward sweep of the tree's steps first .. root. Returns 0 if there is
 * none. */
static int sli_null_dot_next(const sl_factor *F, const sli_packed *b, sl_int first, sl_int root,
                             sli_null_dot *dot) {
    const sl_int last = sli_tree_range_of(F->S, &b->R->steps[root]).root, lanes = b->lanes;
    double chains[SLI_BLOCK_SINGULAR];
    const double *z;
    sl_int column = -1, r;
    for (; dot->next < F->null.count && F->null.pivots[dot->next] <= last && column == -1;
         dot->next++) {
        dot->number = dot->next;
        dot->null = F->null.pivots[dot->next];
        column = sli_null_column(F, dot->null);
    }
    if (column == -1) {
        return 0;
    }
    z = F->null.g + (size_t)column * (size_t)F->S->n;
    SLI_ZERO(chains, sli_max(lanes, SLI_TILE));
    for (; first <= root; first++) {
        for (r = 0; r < lanes; r += SLI_TILE) {
            sli_chains_add_step(chains + r, z, b, &b->R->steps[first], r);
        }
    }
    sli_chains_sum_all(chains, lanes, dot->sums);
    for (r = 0; r < lanes; r++) {
        dot->sums[r] /= z[dot->null];
    }
    return 1;
}

/* The number of the first null pivot in the tree of a root. */
SLI_INLINE sl_int sli_null_first(const sl_factor *F, const sli_reach *R, sl_int root) {
    return sli_lower_bound(F->null.pivots, F->null.count,
                           sli_tree_range_of(F->S, &R->steps[root]).first);
}

/* Before the forward sweep, where components have several null vectors: Y := z' b for all that are
 * known or, if Y is NULL, is |z' b| small? Their null pivots need not be in the reach. */
static int sli_null_dots(const sl_factor *F, const sli_packed *b, const double *norms, double *Y,
                         size_t ldy, sl_int nrhs) {
    const sli_reach *R = b->R;
    sl_int first = 0, s, r;
    for (s = 0; s < R->count; s++) {
        sli_null_dot dot;
        if (R->steps[s].up != -1) {
            continue;
        }
        dot.next = sli_null_first(F, R, s);
        while (sli_null_dot_next(F, b, first, s, &dot)) {
            for (r = 0; r < nrhs; r++) {
                if (Y != NULL) {
                    Y[(size_t)dot.number + (size_t)r * ldy] = dot.sums[r];
                } else if (fabs(dot.sums[r]) > F->null.consistency * norms[r]) {
                    return 0;
                }
            }
        }
        first = s + 1;
    }
    return 1;
}

/* After the forward sweep: is |z' b| small at every null pivot? NaN and overflow pass: they show in
 * x. Where components have several null vectors, those that are known have been judged already. */
static int sli_is_consistent(const sl_factor *F, const sli_packed *y, const double *norms) {
    const sli_reach *R = y->R;
    const sl_int lanes = y->lanes;
    sl_int s, m, r;
    for (s = 0; s < R->count; s++) {
        sli_tree_range tree;
        if (R->steps[s].up != -1) {
            continue;
        }
        tree = sli_tree_range_of(F->S, &R->steps[s]);
        for (m = sli_lower_bound(F->null.pivots, F->null.count, tree.first);
             m < F->null.count && F->null.pivots[m] <= tree.root; m++) {
            const int is_judged =
                F->null.vectors > 1 && sli_null_column(F, F->null.pivots[m]) != -1;
            const sl_int at = is_judged ? -1 : sli_reach_index_of(R, F->null.pivots[m]);
            for (r = 0; at != -1 && r < lanes; r++) {
                if (fabs(sli_packed_row(y, at)[r]) > F->null.consistency * norms[r]) {
                    return 0;
                }
            }
        }
    }
    return 1;
}

/* For one tree and each right-hand side: c' and t of nullspace.h; with several null vectors
 * (null_center.h) c is U' y for the columns of V, and V' y for those of U. */
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
static void sli_center(const sl_factor *F, const sli_packed *y, const sli_packed *x,
                       const sl_int *uses) {
    const int is_one = F->null.vectors == 1;
    const sl_int *list = is_one ? F->null.anchors : F->null.pivots;
    const sl_int listed = is_one ? F->null.n_anchors : F->null.count;
    const sli_reach *to = x->R;
    sli_center_terms terms;
    sl_int first = 0, at = 0, root, m, j, k, lane;
    terms.count = F->null.is_centered ? sli_center_count(F) : 0;
    for (root = 0; root < y->R->count; root++) {
        sli_tree_range tree;
        if (y->R->steps[root].up != -1) {
            continue;
        }
        tree = sli_tree_range_of(F->S, &y->R->steps[root]);
        m = sli_lower_bound(list, listed, tree.first);
        if (m < listed && list[m] <= tree.root &&
            (uses == NULL || uses[sli_lower_bound(F->null.pivots, F->null.count, list[m])] == 0)) {
            j = is_one ? sli_reach_index_of(to, list[m]) : -1;
            for (lane = 0, k = at; lane < y->lanes; lane += SLI_TILE) {
                sli_center_tree_terms(F, y, lane, first, root, m, &terms);
                if (!is_one) {
                    sli_center_clear(F, x, lane, m, tree.root);
                }
                for (k = at; k < to->count && to->steps[k].column <= tree.root; k++) {
                    if (to->steps[k].column >= tree.first) {
                        sli_center_step(F, x, lane, &to->steps[k], &terms);
                    }
                }
                if (j != -1) { /* the backward sweep divides by 1 there */
                    SLI_COPY(sli_packed_row(x, j) + lane, terms.t, sli_min(x->lanes, SLI_TILE));
                }
            }
            at = k;
        }
        first = root + 1;
    }
}

#undef SLI_FOR_LANES

#endif

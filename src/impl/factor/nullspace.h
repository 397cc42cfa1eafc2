/* nullspace.h: null pivots in solves: is a right-hand side consistent, and the solution that is centred by weights */
#ifndef SLI_NULLSPACE_H
#define SLI_NULLSPACE_H

#include "factor_parts.h"
#include "reach.h"

/* A null pivot k, skipped, has the null vector z = P' L^-T e_k, 1 in its own row, and z' b = (L^-1 P b)(k): the
 * forward sweep tells by how much b fails to be consistent.
 *
 * Centred solves, in a component (a tree) with one null pivot and weights m: of A x = b - c m with c = z' b / z' m the x
 * with m' x = 0. With w = L^-1 P m / z' m and y = L^-1 P b that is P x = L^-T (D^+ (y - c' w) + t e_k), c' = y(k),
 * t = - w' D^+ (y - c' w): a dot product over the columns of the forward sweep, a difference over those of the
 * backward sweep, both in their vectors. Kept are v = D^+ w and, for each component, w' D^+ w. Columns that a local solve leaves out are exact zeros in the dot product of the full
 * one, so that both have the same bits. */

/* The weights in pivot order. A component without any, such as a vertex without a face, gets 1 for each row. */
static sl_status sli_mass_fill(sl_factor *F, const double *mass, sl_stats *stats) {
    const sl_symbolic *S = F->S;
    sl_int k, first = 0, any = 0;
    for (k = 0; k < S->n; k++) {
        const double m = mass[S->perm[k]];
        if (!sli_is_finite(m)) {
            return sli_fail_at(stats, SL_ERR_ARGUMENT, S->perm[k], -1, m);
        }
        F->mass[k] = m;
        any |= m != 0.0;
        if (S->parent[k] == -1) { /* in a postorder a tree ends at its root */
            for (; first <= k; first++) {
                F->mass[first] = any ? F->mass[first] : 1.0;
            }
            any = 0;
        }
    }
    return SL_OK;
}

/* flags(k): 1 where row k of L has an entry that is not 0, else 0. */
static void sli_rows_used(const sl_factor *F, double *flags) {
    const sl_symbolic *S = F->S;
    sl_int s, r, j;
    memset(flags, 0, (size_t)S->n * sizeof(double));
    for (s = 0; s < S->n_supers; s++) {
        const sli_step *step = &S->steps[s];
        const double *panel = F->L + step->panel;
        for (r = 1; r < step->width + step->below; r++) {
            const sl_int row =
                r < step->width ? step->column + r : S->rows[S->rows_begin[s] + r - step->width];
            for (j = 0; j < sli_min(r, step->width); j++) {
                flags[row] = panel[sli_panel_at(step->width, r, j)] != 0.0 ? 1.0 : flags[row];
            }
        }
    }
}

/* The null pivot of each tree whose vector the weights tell apart. A row of zeros, as of a vertex whose faces are all
 * degenerate, is a component by itself: its row of L is empty, its x is 0. Besides those a tree may have one. */
static sl_status sli_anchors_make(sl_factor *F, sli_failure *failure) {
    const sl_symbolic *S = F->S;
    double *used = F->divide;
    int is_known = 0;
    sl_int k, m = 0, first;
    F->n_anchors = 0;
    for (k = 0; k < S->n && m < F->n_nulls; k++) {
        sl_int anchor = -1;
        if (S->parent[k] != -1) {
            continue;
        }
        for (first = m; m < F->n_nulls && F->nulls[m] <= k; m++) {
        }
        if (m - first == 1) {
            anchor = F->nulls[first++];
        } else if (m - first > 1 && !is_known) {
            sli_rows_used(F, used);
            is_known = 1;
        }
        for (; first < m; first++) {
            const sl_int null = F->nulls[first];
            if (used[null] != 0.0 && anchor != -1) {
                return sli_fail(failure, SL_ERR_PIVOT, S->super_of[null], null, -1, 0.0);
            }
            anchor = used[null] != 0.0 ? null : anchor;
        }
        if (anchor != -1) {
            F->anchors[F->n_anchors++] = anchor;
        }
    }
    return SL_OK;
}

/* v on the columns of one tree, first .. root, which hold w z'm; total: the sum of |m| there; m: the number of its anchor,
 * if it has one. */
static sl_status sli_centre_tree(sl_factor *F, sl_int first, sl_int root, double total, sl_int m,
                                 sli_failure *failure) {
    const sl_int anchor = m < F->n_anchors ? F->anchors[m] : F->S->n;
    double *v = F->centre, a, sum = 0.0;
    sl_int k;
    if (anchor > root) {
        memset(v + first, 0, ((size_t)(root - first) + 1) * sizeof(double));
        return SL_OK;
    }
    a = v[anchor];
    if (!sli_is_finite(a) || !(fabs(a) > F->S->n * DBL_EPSILON * total)) {
        return sli_fail(failure, SL_ERR_ARGUMENT, F->S->super_of[anchor], anchor, -1, a);
    }
    for (k = first; k <= root; k++) {
        const double w = v[k] / a;
        v[k] = sli_is_skipped(F, k) ? 0.0 : w / F->D[k];
        sum += w * v[k];
    }
    F->divide[anchor] = 1.0;
    F->squares[m] = sum;
    return SL_OK;
}

/* v and what else centring needs, by one forward sweep. */
static sl_status sli_centre_make(sl_factor *F, sli_failure *failure) {
    const sl_symbolic *S = F->S;
    const sli_reach all = sli_reach_all(S);
    sl_status status = sli_anchors_make(F, failure);
    double total = 0.0;
    sl_int k, first = 0, m = 0;
    memcpy(F->divide, F->D, (size_t)S->n * sizeof(double));
    memcpy(F->centre, F->mass, (size_t)S->n * sizeof(double));
    F->kernels->forward[SLI_LANES_1](all.count, all.steps, all.rows, F->L, F->centre,
                                     F->centre_scratch);
    for (k = 0; k < S->n && status == SL_OK; k++) {
        total += fabs(F->mass[k]);
        if (S->parent[k] == -1) {
            status = sli_centre_tree(F, first, k, total, m, failure);
            m += m < F->n_anchors && F->anchors[m] <= k;
            total = 0.0;
            first = k + 1;
        }
    }
    return status;
}

/* What solves need to know of null pivots, once a factor is made. */
static sl_status sli_nulls_make(sl_factor *F, sli_failure *failure) {
    sl_int k;
    F->n_nulls = 0;
    for (k = 0; k < F->S->n; k++) {
        if (sli_is_skipped(F, k)) {
            F->nulls[F->n_nulls++] = k;
        }
    }
    F->is_centred = F->mass != NULL && F->n_nulls > 0;
    F->checks = F->mass == NULL && F->n_nulls > 0 && F->consistency >= 0.0;
    return F->is_centred ? sli_centre_make(F, failure) : SL_OK;
}

/* Sums over the columns of a step, from a whole tile on, in 8 chains so that none waits for another: number f of the
 * step's doubles goes to chain f % 8, in a local sweep as in the full one. Called with constant lanes. */
SLI_ALWAYS_INLINE void sli_chains_norm(double *chains, const double *row, sl_int columns,
                                       sl_int lanes) {
    const ptrdiff_t count = (ptrdiff_t)columns * lanes;
    ptrdiff_t f = 0;
    sl_int q;
    for (; f + SLI_TILE <= count; f += SLI_TILE) {
        SLI_UNROLL
        for (q = 0; q < SLI_TILE; q++) {
            chains[q] += fabs(row[f + q]);
        }
    }
    for (q = 0; f < count; q++) {
        chains[q] += fabs(row[f++]);
    }
}

SLI_ALWAYS_INLINE void sli_chains_dot(double *chains, const double *v, const double *row,
                                      sl_int columns, sl_int lanes) {
    const ptrdiff_t count = (ptrdiff_t)columns * lanes;
    ptrdiff_t f = 0;
    sl_int q;
    for (; f + SLI_TILE <= count; f += SLI_TILE, v += SLI_TILE / lanes) {
        SLI_UNROLL
        for (q = 0; q < SLI_TILE; q++) { /* sum(r) += v(k) y(k, r) */
            chains[q] += v[q / lanes] * row[f + q];
        }
    }
    for (q = 0; f < count; q++) {
        chains[q] += v[q / lanes] * row[f++];
    }
}

/* The chains of each lane, one after the other. */
static void sli_chains_sum(const double *chains, sl_int lanes, double *sums) {
    sl_int q;
    for (q = 0; q < lanes; q++) {
        sums[q] = chains[q];
    }
    for (; q < SLI_TILE; q++) {
        sums[q % lanes] += chains[q];
    }
}

/* Calls a body for a constant number of lanes. */
#define SLI_FOR_LANES(lanes, call)                                                                 \
    if ((lanes) == 1) {                                                                            \
        call(1);                                                                                   \
    } else if ((lanes) == 2) {                                                                     \
        call(2);                                                                                   \
    } else if ((lanes) == 4) {                                                                     \
        call(4);                                                                                   \
    } else {                                                                                       \
        call(8);                                                                                   \
    }

/* norms(r) = sum of |b| in a packed block of right-hand sides */
static void sli_norms(const sli_reach *R, const double *b, sl_int lanes, double *norms) {
    double chains[SLI_TILE];
    sl_int s;
    memset(chains, 0, sizeof chains);
    for (s = 0; s < R->count; s++) {
        const sl_int columns = sli_step_columns(&R->steps[s]);
        const double *row = b + (ptrdiff_t)R->steps[s].base * lanes;
#define SLI_CALL(constant) sli_chains_norm(chains, row, columns, constant)
        SLI_FOR_LANES(lanes, SLI_CALL)
#undef SLI_CALL
    }
    sli_chains_sum(chains, lanes, norms);
}

/* The columns of a whole tree, as the one whose root is a step of a reach. */
typedef struct sli_whole_tree {
    sl_int first, root;
} sli_whole_tree;

SLI_INLINE sli_whole_tree sli_whole_tree_of(const sl_symbolic *S, const sli_step *root) {
    const sl_int super = S->super_of[root->column];
    sli_whole_tree tree;
    tree.first = S->super_first[S->descendant[super]];
    tree.root = S->super_first[super + 1] - 1;
    return tree;
}

/* After the forward sweep: is |z' b| small at every null pivot? A NaN passes, and so does what overflows: they show in
 * x. */
static int sli_is_consistent(const sl_factor *F, const sli_reach *R, const double *y, sl_int lanes,
                             const double *norms) {
    sl_int s, m, r;
    for (s = 0; s < R->count; s++) {
        sli_whole_tree tree;
        if (R->steps[s].up != -1) {
            continue;
        }
        tree = sli_whole_tree_of(F->S, &R->steps[s]);
        for (m = sli_lower_bound(F->nulls, F->n_nulls, tree.first);
             m < F->n_nulls && F->nulls[m] <= tree.root; m++) {
            const sl_int at = sli_reach_place_of(R, F->nulls[m]);
            for (r = 0; at != -1 && r < lanes; r++) {
                if (fabs(y[(ptrdiff_t)at * lanes + r]) > F->consistency * norms[r]) {
                    return 0;
                }
            }
        }
    }
    return 1;
}

/* What centring takes from one tree of the forward sweep. */
typedef struct sli_shares {
    double c[SLI_TILE], t[SLI_TILE];
} sli_shares;

/* The tree that begins at step s; returns the step after its root. m: the number of its anchor, or -1. */
static sl_int sli_centre_ask(const sl_factor *F, const sli_reach *R, sl_int s, const double *y,
                             sl_int lanes, sl_int *m, sli_whole_tree *tree, sli_shares *share) {
    double chains[SLI_TILE], sums[SLI_TILE];
    sl_int r, at, up = s;
    memset(share, 0, sizeof *share);
    memset(chains, 0, sizeof chains);
    while (up != -1) {
        const sli_step *step = &R->steps[s++];
        const double *v = F->centre + step->column, *row = y + (ptrdiff_t)step->base * lanes;
        const sl_int columns = sli_step_columns(step);
#define SLI_CALL(constant) sli_chains_dot(chains, v, row, columns, constant)
        SLI_FOR_LANES(lanes, SLI_CALL)
#undef SLI_CALL
        up = step->up;
    }
    *tree = sli_whole_tree_of(F->S, &R->steps[s - 1]);
    *m = sli_lower_bound(F->anchors, F->n_anchors, tree->first);
    if (*m == F->n_anchors || F->anchors[*m] > tree->root) {
        *m = -1;
        return s;
    }
    at = sli_reach_place_of(R, F->anchors[*m]);
    if (at != -1) {
        memcpy(share->c, y + (ptrdiff_t)at * lanes, (size_t)lanes * sizeof(double));
    }
    sli_chains_sum(chains, lanes, sums);
    for (r = 0; r < lanes; r++) {
        share->t[r] = share->c[r] * F->squares[*m] - sums[r];
    }
    return s;
}

/* y - c w on the columns of a step of the backward sweep. Called with constant lanes. */
SLI_ALWAYS_INLINE void sli_centre_give(double *row, const double *v, const double *D,
                                       sl_int columns, const double *c, sl_int lanes) {
    sl_int k, r;
    for (k = 0; k < columns; k++, row += lanes) {
        const double w = v[k] * D[k];
        SLI_UNROLL
        for (r = 0; r < lanes; r++) {
            row[r] -= c[r] * w;
        }
    }
}

/* Between the sweeps: y in the columns of the one reach, x, which may be y, in those of the other. Trees ascend in both;
 * where b has no row there is nothing to do. */
static void sli_centre(const sl_factor *F, const sli_reach *from, const double *y,
                       const sli_reach *to, double *x, sl_int lanes) {
    sl_int s = 0, at = 0, m;
    while (s < from->count && at < to->count) {
        sli_shares share;
        sli_whole_tree tree;
        sl_int place;
        s = sli_centre_ask(F, from, s, y, lanes, &m, &tree, &share);
        for (; at < to->count && to->steps[at].column <= tree.root; at++) {
            const sli_step *step = &to->steps[at];
            const double *v = F->centre + step->column, *D = F->D + step->column;
            double *row = x + (ptrdiff_t)step->base * lanes;
            const sl_int columns = sli_step_columns(step);
            if (m != -1 && step->column >= tree.first) {
#define SLI_CALL(constant) sli_centre_give(row, v, D, columns, share.c, constant)
                SLI_FOR_LANES(lanes, SLI_CALL)
#undef SLI_CALL
            }
        }
        place = m != -1 ? sli_reach_place_of(to, F->anchors[m]) : -1;
        if (place != -1) { /* x is given there */
            memcpy(x + (ptrdiff_t)place * lanes, share.t, (size_t)lanes * sizeof(double));
        }
    }
}

#undef SLI_FOR_LANES

#endif

/* consistency.h: forward sweeps of singular systems, and whether right-hand sides are consistent */
#ifndef SLI_SINGULAR_CONSISTENCY_H
#define SLI_SINGULAR_CONSISTENCY_H

#include "../solve/backward.h"
#include "null_sums.h"

/* Before the forward sweep, where components have several null vectors: is |z' b| small for all
 * that are known? Their null pivots need not be in the reach. */
static int sli_null_dots(const sl_factor *F, const sli_packed *b, const double *norms) {
    const sli_reach *R = b->R;
    sl_int first = 0, s, r;
    for (s = 0; s < R->count; s++) {
        sli_null_dot dot;
        if (R->steps[s].up != -1) {
            continue;
        }
        dot.next = sli_null_first(F, R, s);
        while (sli_null_dot_next(F, b, first, s, &dot)) {
            for (r = 0; r < b->lanes; r++) {
                if (fabs(dot.sums[r]) > F->null.consistency * norms[r]) {
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

/* Does the consistency check need the forward sweep? Not for known null vectors z, whose z' b are
 * sums over b, and not where a row is all of its tree, so that y is b there. */
static int sli_check_sweeps(const sl_factor *F, const sli_reach *R) {
    sl_int s, m;
    for (s = 0; s < R->count; s++) {
        sl_int known = 0;
        sli_tree_range tree;
        if (R->steps[s].up != -1) {
            continue;
        }
        tree = sli_tree_range_of(F->S, &R->steps[s]);
        m = tree.first == tree.root ? F->null.count : sli_null_first(F, R, s);
        for (; m < F->null.count && F->null.pivots[m] <= tree.root; m++) {
            const int is_known = sli_null_column(F, F->null.pivots[m]) != -1;
            known += is_known;
            if (!is_known || /* branches untested: one vector has one null pivot in a tree */
                (known > 1 && F->null.vectors == 1)) { /* branches untested: the same */
                return 1;
            }
        }
    }
    return 0;
}

/* y := L^-1 y in the forward vector, and y(k) := z' b at known null vectors z, tree by tree. Where
 * components have several of them, their y(k) has no meaning. sweeps: 0: the latter only. */
static void sli_null_trees(const sl_factor *F, const sli_reach *R, const sli_vectors *v, int kind,
                           int sweeps) {
    const sli_packed b = sli_packed_of(R, v->y, (sl_int)1 << kind);
    sli_reach tree = *R;
    sl_int first = 0, s;
    if (F->null.vectors > 1 && sweeps) {
        sli_forward_sweep(F, kind, R, v->y, v->scratch);
    }
    for (s = 0; s < R->count && F->null.vectors == 1; s++) {
        sli_null_dot dot;
        sl_int at;
        if (R->steps[s].up != -1) {
            continue;
        }
        dot.next = sli_null_first(F, R, s);
        at = sli_null_dot_next(F, &b, first, s, &dot) ? sli_reach_index_of(R, dot.null) : -1;
        if (sweeps) {
            tree.steps = R->steps;
            tree.plain = R->plain;
            sli_reach_cut(&tree, first, s + 1 - first);
            sli_forward_sweep(F, kind, &tree, v->y, v->scratch);
        }
        if (at != -1) {
            memcpy(sli_packed_row(&b, at), dot.sums, sizeof(double) << kind);
        }
        for (; first <= s; first++) {
            tree.rows += R->steps[first].below;
        }
    }
}

static void sli_null_forward(const sl_factor *F, const sli_reach *R, const sli_vectors *v,
                             sl_int nrhs) {
    sli_null_trees(F, R, v, sli_lanes_kind(nrhs), 1);
}

/* y := P b for a block of right-hand sides and, if it sweeps, L^-1 y. Returns 0 if F checks
 * consistency and one is inconsistent. */
static int sli_null_judge(const sl_factor *F, const sli_query *q, const sli_vectors *v,
                          const sli_rhs *rhs, int sweeps) {
    const int kind = sli_lanes_kind(rhs->nrhs), ends = q->ending != NULL && q->ending->rows > 0;
    const sli_packed b = sli_packed_of(&q->forward, v->y, (sl_int)1 << kind);
    double norms[SLI_BLOCK_SINGULAR];
    sli_pack(F, q, v->y, rhs);
    if (F->null.checks) {
        sli_norms(&b, norms);
        if (F->null.vectors > 1 && !ends && !sli_null_dots(F, &b, norms)) {
            return 0;
        }
    }
    sli_null_trees(F, &q->forward, v, kind, sweeps);
    return !F->null.checks || sli_is_consistent(F, &b, norms);
}

static int sli_null_load(const sl_factor *F, const sli_query *q, const sli_vectors *v,
                         const sli_rhs *rhs) {
    return sli_null_judge(F, q, v, rhs, 1);
}

/* Are all right-hand sides consistent? Writes only to `memory`. */
static int sli_null_check(const sl_factor *F, const sli_query *q, const sli_rhs *rhs,
                          void *memory) {
    const int sweeps = sli_check_sweeps(F, &q->forward);
    int is_consistent = 1;
    sl_int r;
    for (r = 0; r < rhs->nrhs && is_consistent; r += sli_min(8, rhs->nrhs - r)) {
        const sli_rhs block = sli_rhs_part(rhs, r, sli_min(8, rhs->nrhs - r));
        const sli_vectors v = sli_vectors_of(q, block.nrhs, memory);
        is_consistent = sli_null_judge(F, q, &v, &block, sweeps);
    }
    return is_consistent;
}

#endif

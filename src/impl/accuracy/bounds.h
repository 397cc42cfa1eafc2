/* bounds.h: sl_plan_solve_bounded: local solves with a bound for the error of each number */
#ifndef SLI_ACCURACY_BOUNDS_H
#define SLI_ACCURACY_BOUNDS_H

#include "../../public/bounds.h"
#include "../solve/plan.h"
#include "certify.h"

/* With u(b) = D^-1/2 L^-1 P b, and u(i) that of a unit vector, x(i) is u(i)' u(b), and its error is
 * u(i)' T u(b) with ||T|| <= eta, to first order. T(k, l) is 0 unless one of the columns k and l is
 * an ancestor of the other: E and the rounding errors of the sweeps have the pattern of L D L', and
 * L^-1 has no entries between subtrees. Let c be the columns that the path of i shares with those
 * of b, the end of that path. The rest of the path is in no other path of b, so
 *
 *    |x(i) - exact| <= eta min(|u(i)| |u(b)|, |u(i)_c| |u(b)| + |u(i)_rest| |u(b)_c|),
 *
 * which is small if b and i meet far up. Terms of higher order are below 4 eta^2 |u(i)| |u(b)|.
 *
 * Centered solves (singular/nullspace.h). x = v + t z, where v is 0 in the row k of the anchor and
 * solves the other rows with b - c m, and t is -w' u(b - c m) for w = u(m / z' m) and the null
 * vector z, 1 in row k. Each product of two vectors u has an error of at most eta times their
 * norms, and so
 *
 *    |x(i) - exact| <= eta (|u(i)| + 2 |z(i)| |w|) |u(b - c m)|,
 *
 * where one of the two is for the rounding of w. What the null vector of L differs from z by is in
 * eta (certify.h). |u(b - c m)| is at most |u(b)| + |c| |u(m)|. All columns of a tree have entries
 * of m: the bound is no smaller where b and i meet far up. */

/* The scales of a row of x. */
enum { SLI_SCALE_COMMON, SLI_SCALE_REST, SLI_SCALE_ALL, SLI_SCALE_JOINT, SLI_SCALES };

/* In place of the joint: x is 0 in the row of a null pivot, but for the division by DBL_MAX. */
#define SLI_JOINT_NULL (-2)
/* In a tree that is centered. */
#define SLI_JOINT_CENTERED (-3)

/* A norm that is smaller than this part of the whole is taken as this part: its square may
 * underflow. */
#define SLI_NORM_FLOOR 1e-50

/* A smaller sum of squares may lack some that are not small beside it. */
#define SLI_SQUARE_LEAST 1e-200

typedef struct sli_bounds {
    const sl_factor *F;
    const sli_query *q;
    double *scales;        /* 2 numbers that identify them, then SLI_SCALES of each row of x */
    unsigned char *memory; /* vectors of the sweeps */
    /* the squares of path norms: of the columns from each step of the forward reach on up to the
     * root; then the norm of all. By rows: one for each right-hand side of a block */
    double *norms;
    /* while scales are computed: the rows of x by their index in the vector, sorted; then a block
     * of up to 8 of them, its reach and its vector */
    uint64_t *order, *sorting;
    sli_step *steps;
    sl_int *rows;
    double *y, *scratch;
} sli_bounds;

/* needs: SLI_NEEDS_NOTHING where the scales are known, or what their computation needs. */
enum { SLI_NEEDS_NOTHING, SLI_NEEDS_ROOM, SLI_NEEDS_SCALES };
static void sli_bounds_layout(sli_bounds *p, sli_block *b, sl_int nrhs, int needs) {
    const sli_reach *R = &p->q->backward;
    const uint64_t paths = (uint64_t)p->q->forward.count + 1;
    const sl_int most = sli_block_most(p->F);
    const size_t scratch = sli_sweep_scratch_up_to(R->tallest, R->widest, SLI_TILE);
    p->memory = (unsigned char *)sli_take(b, sli_vectors_bytes(p->q, nrhs, most), 1);
    p->norms = SLI_TAKE(b, double, paths << sli_lanes_kind(sli_block_size(nrhs, most)));
    if (needs == SLI_NEEDS_NOTHING) {
        return;
    }
    if (needs == SLI_NEEDS_SCALES) {
        p->scales = SLI_TAKE(b, double, (uint64_t)p->q->nx *SLI_SCALES + 2);
    }
    p->order = SLI_TAKE(b, uint64_t, p->q->nx);
    p->sorting = SLI_TAKE(b, uint64_t, p->q->nx);
    p->steps = SLI_TAKE(b, sli_step, R->count);
    p->rows = SLI_TAKE(b, sl_int, R->n_rows);
    p->y = SLI_TAKE(b, double, (uint64_t)R->columns *SLI_TILE);
    p->scratch = SLI_TAKE(b, double, scratch);
}

/* What the scales depend on: the numbers of F and its weights, both reaches, and the rows of x. */
static sli_hash sli_scales_identity(const sli_bounds *p) {
    const sli_null_space *null = &p->F->null;
    sli_hash h = p->F->identity;
    h = sli_hash_words(h, null->squares, null->is_centered ? null->n_anchors : 0);
    h = sli_hash_ints(h, (const sl_int *)(const void *)p->q->forward.steps,
                      (sl_off)p->q->forward.count * (sl_off)(sizeof(sli_step) / sizeof(sl_int)));
    h = sli_hash_ints(h, (const sl_int *)(const void *)p->q->backward.steps,
                      (sl_off)p->q->backward.count * (sl_off)(sizeof(sli_step) / sizeof(sl_int)));
    return sli_hash_ints(h, p->q->x_index, p->q->nx);
}

/* The step of the forward reach where the path of supernode s enters it, or -1. *anchor: of the
 * tree of s if it is centered, or -1. */
static sl_int sli_path_joint(const sli_bounds *p, sl_int s, sl_int *anchor) {
    const sl_symbolic *S = p->q->S;
    sl_int at = -1, root = s;
    for (; s != -1; s = S->super_parent[s]) {
        at = at == -1 ? sli_reach_step_of(&p->q->forward, S->super_first[s + 1] - 1) : at;
        root = s;
    }
    *anchor = sli_anchor_in(p->F, S->super_first[S->first_descendant[root]],
                            S->super_first[root + 1] - 1);
    return at;
}

/* Adds the squares of the columns of one step, relative to the pivots `base` of the rows, to the
 * scales of a block: lane r is the row of x in order[r]. from: where the columns are that b
 * shares. */
static void sli_scales_add(const sli_bounds *p, const sli_step *step, sl_int from, sl_int lanes,
                           sl_int count, double (*squares)[SLI_TILE]) {
    const double *y = p->y + (ptrdiff_t)step->base * lanes;
    sl_int k, r;
    for (k = 0; k < sli_step_columns(step); k++, y += lanes) {
        const sl_int column = step->column + k;
        double *to = squares[column >= from ? SLI_SCALE_COMMON : SLI_SCALE_REST];
        for (r = 0; r < count && !sli_is_skipped(p->F, column); r++) {
            to[r] += y[r] * (y[r] / p->F->D[column]); /* y y may overflow */
        }
    }
}

/* Computes the scales of the `count` rows of x in p->order[first ..]. */
static void sli_scales_block(sli_bounds *p, sl_int first, sl_int count) {
    const sl_symbolic *S = p->q->S;
    const int kind = sli_lanes_kind(count);
    const sl_int lanes = (sl_int)1 << kind;
    double squares[2][SLI_TILE];
    sli_reach R;
    sl_int s, r, at = 0;
    sli_reach_fill(S, p->order + first, count, p->steps, p->rows, &R);
    SLI_ZERO(p->y, (size_t)R.columns * (size_t)lanes);
    for (r = 0; r < count; r++) {
        const sl_int row = sli_reach_index(&R, &at, sli_key(p->order[first + r]));
        p->y[(ptrdiff_t)row * lanes + r] = 1.0;
    }
    sli_forward_sweep(p->F, kind, &R, p->y, p->scratch);
    memset(squares, 0, sizeof squares);
    for (s = 0; s < R.count; s++) {
        const sl_int last = R.steps[s].column + sli_step_columns(&R.steps[s]) - 1;
        const sl_int in_b = sli_reach_step_of(&p->q->forward, last);
        sli_scales_add(p, &R.steps[s], in_b == -1 ? last + 1 : p->q->forward.steps[in_b].column,
                       lanes, count, squares);
    }
    for (r = 0; r < count; r++) {
        const uint64_t row = p->order[first + r];
        const double common = squares[SLI_SCALE_COMMON][r], rest = squares[SLI_SCALE_REST][r];
        const double all = sqrt(common + rest), least = SLI_NORM_FLOOR * all;
        double *scale = p->scales + 2 + (ptrdiff_t)sli_value(row) * SLI_SCALES;
        sl_int m;
        const sl_int joint = sli_path_joint(p, S->super_of[sli_key(row)], &m);
        scale[SLI_SCALE_COMMON] = joint == -1 ? 0.0 : fmax(sqrt(common), least);
        scale[SLI_SCALE_REST] = fmax(sqrt(rest), least);
        scale[SLI_SCALE_ALL] = joint == -1 ? 0.0 : all;
        scale[SLI_SCALE_JOINT] = joint;
        if (m != -1 && joint != -1) {
            scale[SLI_SCALE_ALL] +=
                2.0 * fabs(sli_anchor_vector(p->F, m, sli_key(row))) * sqrt(p->F->null.squares[m]);
            scale[SLI_SCALE_JOINT] = SLI_JOINT_CENTERED;
        }
        if (sli_is_skipped(p->F, sli_key(row)) &&
            !(m != -1 && p->F->null.anchors[m] == sli_key(row))) {
            scale[SLI_SCALE_JOINT] = SLI_JOINT_NULL;
        }
    }
}

/* Sorts the rows of x by column of L, and computes their scales in blocks of up to 8. */
static void sli_scales_fill(sli_bounds *p) {
    const sli_reach *R = &p->q->backward;
    sl_int k, at = 0;
    for (k = 0; k < p->q->nx; k++) {
        p->order[k] = sli_keyed(p->q->x_index[k], k);
    }
    sli_sort(p->order, p->q->nx, p->sorting);
    for (k = 0; k < p->q->nx; k++) {
        const sl_int index = sli_key(p->order[k]);
        while (index >= R->steps[at].base + sli_step_columns(&R->steps[at])) {
            at++;
        }
        p->order[k] =
            sli_keyed(index - R->steps[at].base + R->steps[at].column, sli_value(p->order[k]));
    }
    for (k = 0; k < p->q->nx; k += SLI_TILE) {
        sli_scales_block(p, k, sli_min(SLI_TILE, p->q->nx - k));
    }
}

/* The sum of y(k)^2 / d(k) over the columns of a step. d is DBL_MAX in null pivots. Independent
 * sums hide the latency, and compilers divide by two pivots at a time. */
static double sli_norms_one(const double *D, const double *y, sl_int columns) {
    double a = 0.0, b = 0.0, c = 0.0, d = 0.0;
    sl_int k;
    for (k = 0; k + 4 <= columns; k += 4) {
        a += y[k] * (y[k] / D[k]);
        b += y[k + 1] * (y[k + 1] / D[k + 1]);
        c += y[k + 2] * (y[k + 2] / D[k + 2]);
        d += y[k + 3] * (y[k + 3] / D[k + 3]);
    }
    for (; k < columns; k++) {
        a += y[k] * (y[k] / D[k]);
    }
    return (a + b) + (c + d);
}

/* The same for several vectors: own(r). */
static void sli_norms_step(const double *D, const double *y, sl_int columns, sl_int lanes,
                           double *own) {
    sl_int k, r;
    SLI_ZERO(own, lanes);
    for (k = 0; k < columns; k++, y += lanes) {
        const double d = 1.0 / D[k];
        for (r = 0; r < lanes; r++) {
            own[r] += y[r] * (y[r] * d);
        }
    }
}

/* The norm from the sum of squares of vector r. It is not known if squares may have been lost, of
 * numbers near the ends of the range. */
static double sli_norm_of(const sli_bounds *p, double square, const double *y, sl_int r,
                          sl_int lanes) {
    const sli_reach *R = &p->q->forward;
    sl_int s, k;
    if (square >= SLI_SQUARE_LEAST) {
        return sqrt(square);
    }
    for (s = 0; s < R->count; s++) {
        for (k = 0; k < sli_step_columns(&R->steps[s]); k++) {
            if (y[(ptrdiff_t)(R->steps[s].base + k) * lanes + r] != 0.0 &&
                !sli_is_skipped(p->F, R->steps[s].column + k)) {
                return HUGE_VAL;
            }
        }
    }
    return 0.0;
}

/* The norms of one block of `count` vectors from its forward vector. */
static void sli_bounds_norms(const sli_bounds *p, const double *y, sl_int count) {
    const sli_reach *R = &p->q->forward;
    const sl_int lanes = (sl_int)1 << sli_lanes_kind(count);
    double *all = p->norms + (ptrdiff_t)R->count * lanes;
    sl_int s, r;
    SLI_ZERO(all, lanes);
    for (s = R->count - 1; s >= 0; s--) {
        const sli_step *step = &R->steps[s];
        double *own = p->norms + (ptrdiff_t)s * lanes;
        const double *D = p->F->D + step->column, *own_y = y + (ptrdiff_t)step->base * lanes;
        if (lanes == 1) {
            *own = sli_norms_one(D, own_y, sli_step_columns(step));
        } else {
            sli_norms_step(D, own_y, sli_step_columns(step), lanes, own);
        }
        for (r = 0; r < lanes; r++) {
            all[r] += own[r];
            own[r] += step->up == -1 ? 0.0 : p->norms[(ptrdiff_t)step->up * lanes + r];
        }
    }
    for (r = 0; r < count; r++) {
        all[r] = sli_norm_of(p, all[r], y, r, lanes);
    }
    for (s = 0; s < R->count && p->F->null.is_centered; s++) { /* |c| |u(m)| */
        const sli_tree_range tree = sli_tree_range_of(p->F->S, &R->steps[s]);
        const sl_int m = R->steps[s].up == -1 ? sli_anchor_in(p->F, tree.first, tree.root) : -1;
        const sl_int at = m == -1 ? -1 : sli_reach_index_of(R, p->F->null.anchors[m]);
        for (r = 0; r < count && at != -1; r++) {
            all[r] += fabs(y[(ptrdiff_t)at * lanes + r] * p->F->null.ratios[m]) *
                      sqrt(p->F->null.squares[m]);
        }
    }
}

/* Writes the bounds of one block, whose solutions are in X. */
static void sli_bounds_write(const sli_bounds *p, double *to, const sli_rhs *X) {
    const sli_dense at = sli_dense_of(X->ldx);
    const sl_int lanes = (sl_int)1 << sli_lanes_kind(X->nrhs);
    const double *all = p->norms + (ptrdiff_t)p->q->forward.count * lanes;
    const double given = p->F->certificate.eta;
    const double eta = given / (1.0 - 2.0 * given) * (1.0 + 1e-8); /* roundings of the norms */
    sl_int k, r;
    for (k = 0; k < p->q->nx; k++) {
        const double *scale = p->scales + 2 + (ptrdiff_t)k * SLI_SCALES;
        const double common = scale[SLI_SCALE_COMMON], rest = scale[SLI_SCALE_REST];
        const sl_int joint = (sl_int)scale[SLI_SCALE_JOINT];
        const double *squares = joint < 0 ? all : p->norms + (ptrdiff_t)joint * lanes;
        for (r = 0; r < X->nrhs; r++) {
            const size_t here = (size_t)k * at.row + (size_t)r * at.column;
            const double whole = joint == -1 ? 0.0 : scale[SLI_SCALE_ALL] * all[r];
            const double shared = fmax(sqrt(squares[r]), SLI_NORM_FLOOR * all[r]);
            const double part = joint < 0 ? whole : common * all[r] + rest * shared;
            to[here] = joint == SLI_JOINT_NULL
                           ? fabs(X->X[here])
                           : eta * (part < whole ? part : whole) + 4.0 * eta * eta * whole;
        }
    }
}

/* sli_sweep_blocks with bounds. */
static sl_status sli_bounds_blocks(const sli_bounds *p, const sli_rhs *rhs, double *bounds) {
    sl_int r, count, is_finite = 1;
    for (r = 0; r < rhs->nrhs; r += count) {
        sli_rhs block;
        sli_vectors v;
        count = sli_block_size(rhs->nrhs - r, sli_block_most(p->F));
        block = sli_rhs_part(rhs, r, count);
        v = sli_vectors_of(p->q, count, p->memory);
        (void)sli_sweep_load(p->F, p->q, &v, &block);
        sli_bounds_norms(p, v.y, count);
        sli_sweep_backward(p->F, p->q, &v, count);
        is_finite &= sli_sweep_is_finite(p->F, p->q, v.x, (sl_int)1 << sli_lanes_kind(count));
        sli_unpack(p->F, p->q, &block, v.x);
        sli_bounds_write(p, bounds + (size_t)r * sli_dense_of(rhs->ldx).column, &block);
    }
    return is_finite ? SL_OK : sli_not_finite(rhs, p->q->nb);
}

/* Solves in a workspace. */
static sl_status sli_bounds_run(sli_bounds *p, const sli_rhs *rhs, double *bounds, sl_work *W) {
    const sli_hash identity = sli_scales_identity(p);
    const int needs = p->scales == NULL                                    ? SLI_NEEDS_SCALES
                      : memcmp(p->scales, &identity, sizeof identity) == 0 ? SLI_NEEDS_NOTHING
                                                                           : SLI_NEEDS_ROOM;
    sli_block b = {NULL, 0};
    sl_status status;
    sli_bounds_layout(p, &b, rhs->nrhs, needs);
    status = sli_work_block(W, &b);
    if (status != SL_OK) {
        return status;
    }
    sli_bounds_layout(p, &b, rhs->nrhs, needs);
    if (sli_sweep_check(p->F, p->q, rhs, p->memory) != SL_OK) {
        return sli_inconsistent();
    }
    if (needs != SLI_NEEDS_NOTHING) {
        sli_scales_fill(p);
        memcpy(p->scales, &identity, sizeof identity);
    }
    return sli_bounds_blocks(p, rhs, bounds);
}

SL_API sl_status sl_plan_solve_bounded(const sl_plan *P, const sl_factor *F, double *X, size_t ldx,
                                       double *bounds, const double *B, size_t ldb, sl_int nrhs,
                                       double *scales, sl_work *W, sl_stats *stats) {
    const sli_rhs rhs = sli_rhs_of(X, ldx, B, ldb, nrhs);
    sli_bounds p;
    sl_work own;
    sl_status status;
    sli_stats_clear_error(stats);
    status = sli_argument(P == NULL ? "P is NULL" : F == NULL ? "F is NULL" : NULL);
    status = status == SL_OK ? sli_rhs_check(&rhs, P->query.nx, P->query.nb) : status;
    if (status == SL_OK && nrhs > 0 && P->query.nx > 0) {
        status = sli_argument(bounds == NULL               ? "bounds is NULL"
                              : bounds == X || bounds == B ? "bounds is X or B"
                                                           : NULL);
    }
    status = status == SL_OK ? sli_query_check(&P->query, F) : status;
    if (status == SL_OK && (F->certificate.certainty == SL_UNCERTIFIED ||
                            F->certificate.generation != F->generation)) {
        status = sli_refuse(SL_ERR_STALE, "the present F is not certified: sl_factor_certify");
    }
    if (status == SL_OK && P->query.ending != NULL) {
        status = sli_refuse_region();
    }
    if (status != SL_OK) {
        return sli_report(stats, status);
    }
    if (stats != NULL) {
        SLI_CLEAR(stats->certificate);
        stats->certificate.certainty = F->certificate.certainty;
        stats->certificate.eta = F->certificate.eta;
    }
    if (nrhs == 0 || P->query.nx == 0) {
        return SL_OK;
    }
    p.F = F;
    p.q = &P->query;
    p.scales = scales;
    own = sli_work_own(&F->allocator);
    status = sli_bounds_run(&p, &rhs, bounds, W == NULL ? &own : W);
    sli_free(&own.allocator, own.block);
    return sli_report(stats, status);
}

#endif

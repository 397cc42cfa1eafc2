/* sweep.h: one block of right-hand sides through the forward reach, across to the backward reach, and out */
#ifndef SLI_SWEEP_H
#define SLI_SWEEP_H

#include "reach.h"
#include "factor_parts.h"
#include "work.h"

/* A compiled question: the reach of b, the reach of x, and where the caller's rows stand in their
 * vectors. */
typedef struct sli_query {
    const sl_symbolic *S;
    sl_int nb, nx;
    int is_shared; /* one reach and one vector serve both sweeps */
    sli_reach forward, backward;
    const sl_int *b_place; /* nb */
    const sl_int *x_place; /* nx */
} sli_query;

/* Everything known and everything wanted: the full solve. */
static sli_query sli_query_all(const sl_symbolic *S) {
    sli_query q;
    q.S = S;
    q.nb = q.nx = S->n;
    q.is_shared = 1;
    q.forward = q.backward = sli_reach_all(S);
    q.b_place = q.x_place = S->iperm;
    return q;
}

/* The kernel for the next block of nrhs right-hand sides, and how many lanes it has. */
SLI_INLINE int sli_lanes_kind(sl_int nrhs) {
    return nrhs <= 1   ? SLI_LANES_1
           : nrhs == 2 ? SLI_LANES_2
           : nrhs <= 4 ? SLI_LANES_4
                       : SLI_LANES_8;
}

/* The vectors and scratch of one block, cut from a workspace. */
typedef struct sli_vectors {
    double *y, *x, *scratch;
} sli_vectors;

static void sli_vectors_layout(sli_vectors *v, sli_block *b, const sli_query *q, sl_int nrhs) {
    const sl_int lanes = (sl_int)1 << sli_lanes_kind(nrhs);
    const size_t forward = sli_scratch_size(q->forward.tallest, q->forward.widest, lanes);
    const size_t backward = sli_scratch_size(q->backward.tallest, q->backward.widest, lanes);
    v->y = SLI_TAKE(b, double, (uint64_t)q->forward.columns *(uint64_t)lanes);
    v->x =
        q->is_shared ? v->y : SLI_TAKE(b, double, (uint64_t)q->backward.columns *(uint64_t)lanes);
    v->scratch = SLI_TAKE(b, double, forward > backward ? forward : backward);
}

/* Bytes for any block of up to nrhs right-hand sides; SIZE_MAX if they cannot be counted. One and
 * two lanes keep partial sums that more lanes do not need, so both ends are looked at. */
static size_t sli_vectors_bytes(const sli_query *q, sl_int nrhs) {
    sli_block few = {NULL, 0, 0}, many = {NULL, 0, 0};
    sli_vectors v;
    sli_vectors_layout(&v, &few, q, sli_min(nrhs, 2));
    sli_vectors_layout(&v, &many, q, sli_min(nrhs, 8));
    return few.overflow || many.overflow ? SIZE_MAX : few.used > many.used ? few.used : many.used;
}

/* Columns of M, ld apart, to the interleaved rows place[k] of v. Called with constant numbers of
 * columns: moving rows in and out is a fifth of a full solve, and a counted inner loop would double
 * that. */
SLI_INLINE void sli_interleave(double *v, sl_int lanes, const sl_int *place, sl_int count,
                               const double *M, size_t ld, sl_int columns) {
    sl_int k, r;
    for (k = 0; k < count; k++) {
        SLI_UNROLL
        for (r = 0; r < columns; r++) {
            v[(ptrdiff_t)place[k] * lanes + r] = M[(size_t)k + (size_t)r * ld];
        }
    }
}

/* The way back. */
SLI_INLINE void sli_separate(double *M, size_t ld, const double *v, sl_int lanes,
                             const sl_int *place, sl_int count, sl_int columns) {
    sl_int k, r;
    for (k = 0; k < count; k++) {
        SLI_UNROLL
        for (r = 0; r < columns; r++) {
            M[(size_t)k + (size_t)r * ld] = v[(ptrdiff_t)place[k] * lanes + r];
        }
    }
}

/* b into the forward vector, interleaved; unknown rows and idle lanes are 0. */
static void sli_pack(const sli_query *q, double *y, const double *B, size_t ldb, sl_int lanes,
                     sl_int nrhs) {
    if (q->nb < q->forward.columns || nrhs < lanes) {
        memset(y, 0, (size_t)q->forward.columns * (size_t)lanes * sizeof(double));
    }
    switch (nrhs) {
    case 8:
        sli_interleave(y, 8, q->b_place, q->nb, B, ldb, 8);
        break;
    case 3:
        sli_interleave(y, 4, q->b_place, q->nb, B, ldb, 3);
        break;
    case 1:
        sli_interleave(y, 1, q->b_place, q->nb, B, ldb, 1);
        break;
    default:
        sli_interleave(y, lanes, q->b_place, q->nb, B, ldb, nrhs);
    }
}

/* The wanted rows out of the backward vector. */
static void sli_unpack(const sli_query *q, double *X, size_t ldx, const double *x, sl_int lanes,
                       sl_int nrhs) {
    switch (nrhs) {
    case 8:
        sli_separate(X, ldx, x, 8, q->x_place, q->nx, 8);
        break;
    case 3:
        sli_separate(X, ldx, x, 4, q->x_place, q->nx, 3);
        break;
    case 1:
        sli_separate(X, ldx, x, 1, q->x_place, q->nx, 1);
        break;
    default:
        sli_separate(X, ldx, x, lanes, q->x_place, q->nx, nrhs);
    }
}

/* y carried over to the columns that both reaches have; the rest of the backward vector starts from
 * 0. */
static void sli_cross(const sli_query *q, const double *y, double *x, sl_int lanes) {
    const sli_step *f = q->forward.steps, *b = q->backward.steps;
    const sli_step *f_end = f + q->forward.count, *b_end = b + q->backward.count;
    memset(x, 0, (size_t)q->backward.columns * (size_t)lanes * sizeof(double));
    while (f < f_end && b < b_end) {
        if (f->panel == b->panel) { /* a panel belongs to one supernode */
            const sl_int column = sli_max(f->column, b->column);
            const sl_int count = f->column + sli_step_columns(f) - column;
            memcpy(x + (ptrdiff_t)(b->base + column - b->column) * lanes,
                   y + (ptrdiff_t)(f->base + column - f->column) * lanes,
                   (size_t)count * (size_t)lanes * sizeof(double));
            f++;
            b++;
        } else if (f->panel < b->panel) {
            f++;
        } else {
            b++;
        }
    }
}

/* A x = b for the rows of a query: y = L^-1 P b, z = D^-1 y, P x = L'^-1 z. W has room; F is good.
 */
static void sli_sweep(const sl_factor *F, const sli_query *q, double *X, size_t ldx,
                      const double *B, size_t ldb, sl_int nrhs, void *memory) {
    sl_int r;
    for (r = 0; r < nrhs; r += 8) {
        const sl_int block = sli_min(8, nrhs - r);
        const int kind = sli_lanes_kind(block);
        const sl_int lanes = (sl_int)1 << kind;
        sli_block b;
        sli_vectors v;
        b.base = (unsigned char *)memory;
        b.used = 0;
        b.overflow = 0;
        sli_vectors_layout(&v, &b, q, block);
        sli_pack(q, v.y, B + (size_t)r * ldb, ldb, lanes, block);
        F->kernels->forward[kind](q->forward.count, q->forward.steps, q->forward.rows, F->L, v.y,
                                  v.scratch);
        if (!q->is_shared) {
            sli_cross(q, v.y, v.x, lanes);
        }
        F->kernels->backward[kind](q->backward.count, q->backward.steps,
                                   q->backward.rows + q->backward.n_rows, F->L, F->D, v.x,
                                   v.scratch);
        sli_unpack(q, X + (size_t)r * ldx, ldx, v.x, lanes, block);
    }
}

/* What every solve asks of its dense arguments. */
static sl_status sli_check_dense(const double *X, size_t ldx, sl_int nx, const double *B,
                                 size_t ldb, sl_int nb, sl_int nrhs) {
    const int bad_x = nx > 0 && (X == NULL || ldx < (size_t)nx);
    const int bad_b = nb > 0 && (B == NULL || ldb < (size_t)nb);
    /* in place, yet one column upon another */
    const int torn = X == B && ldx != ldb && nx > 0 && nb > 0;
    return nrhs < 0 || (nrhs > 0 && (bad_x || bad_b || torn)) ? SL_ERR_ARGUMENT : SL_OK;
}

/* A query answered in the caller's workspace, or in one of this call's own. */
static sl_status sli_answer(const sl_factor *F, const sli_query *q, double *X, size_t ldx,
                            const double *B, size_t ldb, sl_int nrhs, sl_work *W) {
    sl_work own;
    sl_status status;
    size_t bytes;
    if (nrhs == 0 || q->nx == 0) {
        return SL_OK;
    }
    own.allocator = F->allocator;
    own.block = NULL;
    own.size = 0;
    W = W == NULL ? &own : W;
    bytes = sli_vectors_bytes(q, nrhs);
    status = bytes == SIZE_MAX ? SL_ERR_TOO_LARGE : sli_work_grow(W, bytes);
    if (status == SL_OK) {
        sli_sweep(F, q, X, ldx, B, ldb, nrhs, W->block);
    }
    sli_free(&own.allocator, own.block);
    return status;
}

#endif

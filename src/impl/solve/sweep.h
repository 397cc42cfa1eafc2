/* sweep.h: one block of right-hand sides through the forward reach, across to the backward reach, and out */
#ifndef SLI_SWEEP_H
#define SLI_SWEEP_H

#include "nullspace.h"
#include "region_parts.h"
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
    sli_shore shore;       /* of the region */
    const sl_region
        *region; /* both reaches end there, and its boundary is the end of their vectors; or NULL */
} sli_query;

/* Everything known and everything wanted: the full solve. */
static sli_query sli_query_all(const sl_symbolic *S) {
    sli_query q;
    q.S = S;
    q.nb = q.nx = S->n;
    q.is_shared = 1;
    q.forward = q.backward = sli_reach_all(S);
    q.b_place = q.x_place = S->iperm;
    q.region = NULL;
    q.shore.entries = 0;
    return q;
}

/* Can the query be answered by what F holds? */
SLI_INLINE int sli_query_fits(const sli_query *q, const sl_factor *F) {
    return F->is_good && F->S == q->S && (q->region == NULL || sli_region_fits(q->region, F));
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
    double *y, *x, *product, *scratch;
} sli_vectors;

static void sli_vectors_layout(sli_vectors *v, sli_block *b, const sli_query *q, sl_int nrhs) {
    const sl_int lanes = (sl_int)1 << sli_lanes_kind(nrhs);
    const size_t forward = sli_scratch_size(q->forward.tallest, q->forward.widest, lanes);
    const size_t backward = sli_scratch_size(q->backward.tallest, q->backward.widest, lanes);
    const size_t across = q->region == NULL ? 0 : sli_region_scratch(q->region, lanes);
    const size_t most = forward > backward ? forward : backward;
    v->y = SLI_TAKE(b, double, (uint64_t)q->forward.columns *(uint64_t)lanes);
    v->x =
        q->is_shared ? v->y : SLI_TAKE(b, double, (uint64_t)q->backward.columns *(uint64_t)lanes);
    v->product = SLI_TAKE(b, double, q->region == NULL ? 0 : sli_region_vectors(q->region, lanes));
    v->scratch = SLI_TAKE(b, double, most > across ? most : across);
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

/* How a dense block of the caller's lies, and how far apart its rows and its columns stand. */
typedef enum sli_layout { SLI_COLUMN_MAJOR, SLI_INTERLEAVED } sli_layout;

typedef struct sli_dense {
    size_t row, column; /* one of them is 1 */
} sli_dense;

SLI_INLINE sli_dense sli_dense_of(sli_layout layout, size_t ld) {
    sli_dense at;
    at.row = layout == SLI_INTERLEAVED ? ld : 1;
    at.column = layout == SLI_INTERLEAVED ? 1 : ld;
    return at;
}

/* Rows of the vector that the loops below ask for ahead. The caller's order jumps about in it, which
 * only matters where a row fills a cache line: with 8 lanes this made packing at n = 1e6 2 times
 * faster, with one it costs 3 percent of a solve. */
#define SLI_ROWS_AHEAD 32

/* Rows of M to the interleaved rows place[k] of v. Called with constant numbers of columns, and one
 * of the two strides 1: moving rows in and out is a fifth of a full solve, and a counted inner loop
 * would double that. */
SLI_ALWAYS_INLINE void sli_pack_rows(double *v, sl_int lanes, const sl_int *place, sl_int count,
                                     const double *M, sli_dense at, sl_int columns) {
    sl_int k, r;
    for (k = 0; k < count; k++) {
        if (lanes >= 4) {
            SLI_PREFETCH(v + (ptrdiff_t)place[sli_min(k + SLI_ROWS_AHEAD, count - 1)] * lanes, 0);
        }
        SLI_UNROLL
        for (r = 0; r < columns; r++) {
            v[(ptrdiff_t)place[k] * lanes + r] = M[(size_t)k * at.row + (size_t)r * at.column];
        }
    }
}

/* The way back. */
SLI_ALWAYS_INLINE void sli_unpack_rows(double *M, sli_dense at, const double *v, sl_int lanes,
                                       const sl_int *place, sl_int count, sl_int columns) {
    sl_int k, r;
    for (k = 0; k < count; k++) {
        if (lanes >= 4) {
            SLI_PREFETCH(v + (ptrdiff_t)place[sli_min(k + SLI_ROWS_AHEAD, count - 1)] * lanes, 0);
        }
        SLI_UNROLL
        for (r = 0; r < columns; r++) {
            M[(size_t)k * at.row + (size_t)r * at.column] = v[(ptrdiff_t)place[k] * lanes + r];
        }
    }
}

/* b into the forward vector; unknown rows and idle lanes are 0. */
static void sli_pack(const sli_query *q, double *y, const double *B, sli_dense at, sl_int lanes,
                     sl_int nrhs) {
    const sl_int *place = q->b_place, count = q->nb;
    if (q->nb < q->forward.columns || nrhs < lanes) {
        memset(y, 0, (size_t)q->forward.columns * (size_t)lanes * sizeof(double));
    }
    if (nrhs == 8 && at.row == 1) {
        sli_pack_rows(y, 8, place, count, B, sli_dense_of(SLI_COLUMN_MAJOR, at.column), 8);
    } else if (nrhs == 8) {
        sli_pack_rows(y, 8, place, count, B, sli_dense_of(SLI_INTERLEAVED, at.row), 8);
    } else if (nrhs == 3) {
        sli_pack_rows(y, 4, place, count, B, at, 3);
    } else if (nrhs == 1) {
        sli_pack_rows(y, 1, place, count, B, at, 1);
    } else {
        sli_pack_rows(y, lanes, place, count, B, at, nrhs);
    }
}

/* The wanted rows out of the backward vector. */
static void sli_unpack(const sli_query *q, double *X, sli_dense at, const double *x, sl_int lanes,
                       sl_int nrhs) {
    const sl_int *place = q->x_place, count = q->nx;
    if (nrhs == 8 && at.row == 1) {
        sli_unpack_rows(X, sli_dense_of(SLI_COLUMN_MAJOR, at.column), x, 8, place, count, 8);
    } else if (nrhs == 8) {
        sli_unpack_rows(X, sli_dense_of(SLI_INTERLEAVED, at.row), x, 8, place, count, 8);
    } else if (nrhs == 3) {
        sli_unpack_rows(X, at, x, 4, place, count, 3);
    } else if (nrhs == 1) {
        sli_unpack_rows(X, at, x, 1, place, count, 1);
    } else {
        sli_unpack_rows(X, at, x, lanes, place, count, nrhs);
    }
}

/* y carried over to the columns that both reaches have; the rest of the backward vector starts from
 * 0. */
static void sli_cross(const sli_query *q, const double *y, double *x, sl_int lanes) {
    sli_meeting m = sli_meeting_of(&q->forward, &q->backward);
    memset(x, 0, (size_t)q->backward.columns * (size_t)lanes * sizeof(double));
    while (sli_meet(&m)) {
        memcpy(x + (ptrdiff_t)m.in_b * lanes, y + (ptrdiff_t)m.in_a * lanes,
               (size_t)m.count * (size_t)lanes * sizeof(double));
    }
}

/* The boundary of the query's region: u at the end of y, Z u at the end of x. */
static void sli_cross_region(const sl_factor *F, const sli_query *q, int kind,
                             const sli_vectors *v) {
    const ptrdiff_t n = q->region->fence.n_rows;
    sli_region_apply(q->region, &q->shore, F->kernels, kind,
                     v->y + ((q->forward.columns - n) << kind),
                     v->x + ((q->backward.columns - n) << kind), v->product, v->scratch);
}

/* The vectors of the next block of right-hand sides, in memory that has room. */
static sli_vectors sli_vectors_of(const sli_query *q, sl_int nrhs, void *memory) {
    sli_block b = {NULL, 0, 0};
    sli_vectors v;
    b.base = (unsigned char *)memory;
    sli_vectors_layout(&v, &b, q, nrhs);
    return v;
}

/* y := L^-1 y in the forward vector. */
static void sli_sweep_forward(const sl_factor *F, const sli_query *q, const sli_vectors *v,
                              sl_int nrhs) {
    F->kernels->forward[sli_lanes_kind(nrhs)](q->forward.count, q->forward.steps, q->forward.rows,
                                              F->L, v->y, v->scratch);
}

/* y = L^-1 P b for up to 8 right-hand sides. Returns whether there is a solution, where F asks. */
static int sli_sweep_in(const sl_factor *F, const sli_query *q, const sli_vectors *v,
                        const double *B, sli_dense at, sl_int nrhs) {
    const sl_int lanes = (sl_int)1 << sli_lanes_kind(nrhs);
    double norms[SLI_TILE];
    sli_pack(q, v->y, B, at, lanes, nrhs);
    if (F->checks) {
        sli_norms(&q->forward, v->y, lanes, norms);
    }
    sli_sweep_forward(F, q, v, nrhs);
    return !F->checks || sli_is_consistent(F, &q->forward, v->y, lanes, norms);
}

/* P x = L'^-1 D^-1 y in the backward vector. */
static void sli_sweep_backward(const sl_factor *F, const sli_query *q, const sli_vectors *v,
                               sl_int nrhs) {
    const int kind = sli_lanes_kind(nrhs);
    const sl_int lanes = (sl_int)1 << kind;
    if (!q->is_shared) {
        sli_cross(q, v->y, v->x, lanes);
    }
    if (q->region != NULL) {
        sli_cross_region(F, q, kind, v);
    }
    if (F->is_centred) {
        sli_centre(F, &q->forward, v->y, &q->backward, v->x, lanes);
    }
    F->kernels->backward[kind](q->backward.count, q->backward.steps,
                               q->backward.rows + q->backward.n_rows, F->L,
                               F->is_centred ? F->divide : F->D, v->x, v->scratch);
}

/* Only whether A x = b has solutions; nothing but memory is written. */
static sl_status sli_sweep_check(const sl_factor *F, const sli_query *q, const double *B,
                                 sli_dense b_at, sl_int nrhs, void *memory) {
    sl_int r;
    for (r = 0; r < nrhs; r += 8) {
        const sl_int block = sli_min(8, nrhs - r);
        const sli_vectors v = sli_vectors_of(q, block, memory);
        if (!sli_sweep_in(F, q, &v, B + (size_t)r * b_at.column, b_at, block)) {
            return SL_ERR_INCONSISTENT;
        }
    }
    return SL_OK;
}

/* A x = b for the rows of a query, block after block: y = L^-1 P b, z = D^-1 y, P x = L'^-1 z. Memory has room; F is
 * good. The first block that is not consistent is where it ends. */
static sl_status sli_sweep_blocks(const sl_factor *F, const sli_query *q, double *X, sli_dense x_at,
                                  const double *B, sli_dense b_at, sl_int nrhs, void *memory) {
    sl_int r;
    for (r = 0; r < nrhs; r += 8) {
        const sl_int block = sli_min(8, nrhs - r);
        const sli_vectors v = sli_vectors_of(q, block, memory);
        if (!sli_sweep_in(F, q, &v, B + (size_t)r * b_at.column, b_at, block)) {
            return SL_ERR_INCONSISTENT;
        }
        sli_sweep_backward(F, q, &v, block);
        sli_unpack(q, X + (size_t)r * x_at.column, x_at, v.x, (sl_int)1 << sli_lanes_kind(block),
                   block);
    }
    return SL_OK;
}

/* The same, where nothing of X may be written before all blocks are known to be consistent. */
static sl_status sli_sweep(const sl_factor *F, const sli_query *q, double *X, sli_dense x_at,
                           const double *B, sli_dense b_at, sl_int nrhs, void *memory) {
    sl_status status = SL_OK;
    if (F->checks && nrhs > 8 && q->nb > 0) {
        status = sli_sweep_check(F, q, B + 8 * b_at.column, b_at, nrhs - 8, memory);
    }
    return status == SL_OK ? sli_sweep_blocks(F, q, X, x_at, B, b_at, nrhs, memory) : status;
}

/* What every solve asks of its dense arguments: leading dimensions reach over the rows of a column,
 * or over the columns of a row. */
static sl_status sli_check_dense(const double *X, size_t ldx, sl_int nx, const double *B,
                                 size_t ldb, sl_int nb, sli_layout layout, sl_int nrhs) {
    const int by_rows = layout == SLI_INTERLEAVED;
    const int bad_x = nx > 0 && (X == NULL || ldx < (size_t)(by_rows ? nrhs : nx));
    const int bad_b = nb > 0 && (B == NULL || ldb < (size_t)(by_rows ? nrhs : nb));
    /* in place, yet one column or row upon another */
    const int torn = X == B && ldx != ldb && nx > 0 && nb > 0;
    return nrhs < 0 || (nrhs > 0 && (bad_x || bad_b || torn)) ? SL_ERR_ARGUMENT : SL_OK;
}

/* A query answered in the caller's workspace, or in one of this call's own. */
static sl_status sli_answer(const sl_factor *F, const sli_query *q, double *X, sli_dense x_at,
                            const double *B, sli_dense b_at, sl_int nrhs, sl_work *W) {
    sl_work own;
    sl_status status;
    size_t bytes;
    if (nrhs == 0 || q->nx == 0) {
        return SL_OK;
    }
    own = sli_work_own(&F->allocator);
    W = W == NULL ? &own : W;
    bytes = sli_vectors_bytes(q, nrhs);
    status = bytes == SIZE_MAX ? SL_ERR_TOO_LARGE : sli_work_grow(W, bytes);
    if (status == SL_OK) {
        status = sli_sweep(F, q, X, x_at, B, b_at, nrhs, W->block);
    }
    sli_free(&own.allocator, own.block);
    return status;
}

/* The same for arguments not looked at yet. */
static sl_status sli_solve(const sl_factor *F, const sli_query *q, double *X, size_t ldx,
                           const double *B, size_t ldb, sli_layout layout, sl_int nrhs,
                           sl_work *W) {
    const sl_status status = sli_check_dense(X, ldx, q->nx, B, ldb, q->nb, layout, nrhs);
    if (status != SL_OK) {
        return status;
    }
    if (!sli_query_fits(q, F)) {
        return SL_ERR_STATE;
    }
    return sli_answer(F, q, X, sli_dense_of(layout, ldx), B, sli_dense_of(layout, ldb), nrhs, W);
}

#endif

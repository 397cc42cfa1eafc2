/* query.h: the query, a compiled solve, and moving right-hand sides in and out of it */
#ifndef SLI_SOLVE_QUERY_H
#define SLI_SOLVE_QUERY_H

#include "../analysis/reach.h"
#include "../factor/factor_types.h"
#include "../matrix/dense.h"
#include "work.h"

/* Where the sweeps of a query end before the roots. The object of a pack begins with this; rows of
 * the boundary, which has the role of the roots, are at the end of both vectors. */
typedef struct sli_ending {
    const struct sli_ending_calls *calls;
    sl_int rows;          /* of the boundary */
    sli_atomic borrowers; /* plans */
} sli_ending;

/* The parts of an ending that a query uses: what `place` and `finish` have marked. */
typedef struct sli_ending_use {
    const unsigned char *b, *x; /* the parts that the sets use */
    sl_off entries;             /* doubles that a solve reads */
} sli_ending_use;

/* A compiled solve: the reach of b, the reach of x, and the index of each of the caller's rows in
 * their vectors. */
typedef struct sli_query {
    const sl_symbolic *S;
    sl_int nb, nx;
    int is_shared; /* the reaches are equal: one vector serves both sweeps */
    int b_repeats; /* the b-set repeats a row: its values add up */
    sli_reach forward, backward;
    const sl_int *b_index;    /* nb */
    const sl_int *x_index;    /* nx */
    const sli_ending *ending; /* NULL: both reaches end at the roots */
    sli_ending_use used;      /* of the ending */
} sli_query;

struct sli_set;
struct sli_vectors;
typedef struct sli_ending_calls {
    /* Does the ending belong to this analysis? */
    int (*belongs)(const sli_ending *e, const sl_symbolic *S);
    /* Places two sorted sets within the ending; 0: they are not inside it, and end at the roots. */
    int (*place)(const sli_ending *e, struct sli_set *b, struct sli_set *x);
    /* Fills q->used. */
    void (*finish)(const sli_ending *e, sli_query *q, struct sli_set *b, struct sli_set *x);
    /* Has it the numbers of F? */
    int (*fits)(const sli_query *q, const sl_factor *F);
    /* Doubles of its vectors and of its scratch. */
    uint64_t (*vectors)(const sli_ending *e, sl_int lanes);
    size_t (*scratch)(const sli_ending *e, sl_int lanes);
    /* From the end of the forward vector to that of the backward vector. */
    void (*apply)(const sl_factor *F, const sli_query *q, int kind, const struct sli_vectors *v);
    /* Ends a borrowing. */
    void (*give_back)(const sli_ending *e);
} sli_ending_calls;

/* The query of a full solve: b is given, and x wanted, in all rows. */
static sli_query sli_query_all(const sl_symbolic *S) {
    sli_query q;
    q.S = S;
    q.nb = q.nx = S->n;
    q.is_shared = 1;
    q.b_repeats = 0;
    q.forward = q.backward = sli_reach_all(S);
    q.b_index = q.x_index = S->iperm;
    q.ending = NULL;
    q.used.entries = 0;
    return q;
}

/* Does F hold the numbers that the query needs? */
SLI_INLINE int sli_query_fits(const sli_query *q, const sl_factor *F) {
    return F->is_valid && F->S == q->S && (q->ending == NULL || q->ending->calls->fits(q, F));
}

SLI_COLD static sl_status sli_query_refuse_analysis(void) {
    return sli_refuse(SL_ERR_MISMATCH, "the plan is of another analysis than F");
}

/* The same as a status with its reason. */
static sl_status sli_query_check(const sli_query *q, const sl_factor *F) {
    return sli_query_fits(q, F) ? SL_OK
           : !F->is_valid       ? sli_factor_has_numbers(F)
           : F->S == q->S
               ? sli_refuse(SL_ERR_STALE, "the region of the plan is not of the present F: "
                                          "sl_region_refactor")
               : sli_query_refuse_analysis();
}

/* Refuses a plan in a region, for a call that needs the paths to the roots. */
SLI_COLD static sl_status sli_refuse_region(void) {
    return sli_refuse(SL_ERR_UNSUPPORTED, "this call takes no plan in a region: create one without "
                                          "options.region");
}

/* The sweep kernel for a block of nrhs right-hand sides. It takes 1 << kind of them. */
SLI_INLINE int sli_lanes_kind(sl_int nrhs) {
    int kind = SLI_NRHS_1;
    while ((sl_int)1 << kind < nrhs) {
        kind++;
    }
    return kind;
}

/* The size of the next block of at most `most` of nrhs right-hand sides: 64, 32, 16 or up to 8. As
 * 5 to 7 take a sweep of 8, with its bits, 13 to 15 take one of 16. */
SLI_INLINE sl_int sli_block_size(sl_int nrhs, sl_int most) {
    const sl_int size = sli_min(nrhs, most);
    return size >= 64   ? 64
           : size >= 32 ? 32
           : size >= 16 ? 16
           : size > 12  ? size
                        : sli_min(size, 8);
}

/* The largest blocks: a sweep over L is shared by all right-hand sides of a block, which takes as
 * many vectors. Sums over a block, for singular matrices, take 8 of them at a time. */
#define SLI_BLOCK_MOST 64
#define SLI_BLOCK_SINGULAR 32
SLI_INLINE sl_int sli_block_most(const sl_factor *F) {
    return F->null.count > 0 ? SLI_BLOCK_SINGULAR : SLI_BLOCK_MOST;
}

/* Vectors and scratch of one block, cut from a workspace. */
typedef struct sli_vectors {
    double *y, *x, *product, *scratch;
} sli_vectors;

static void sli_vectors_layout(sli_vectors *v, sli_block *b, const sli_query *q, sl_int nrhs) {
    const sl_int lanes = (sl_int)1 << sli_lanes_kind(nrhs);
    const size_t forward = sli_sweep_scratch(q->forward.tallest, q->forward.widest, lanes);
    const size_t backward = sli_sweep_scratch(q->backward.tallest, q->backward.widest, lanes);
    const size_t across = q->ending == NULL ? 0 : q->ending->calls->scratch(q->ending, lanes);
    const size_t most = forward > backward ? forward : backward;
    v->y = SLI_TAKE_INLINE(b, double, (uint64_t)q->forward.columns *(uint64_t)lanes);
    v->x = q->is_shared
               ? v->y
               : SLI_TAKE_INLINE(b, double, (uint64_t)q->backward.columns *(uint64_t)lanes);
    v->product = SLI_TAKE_INLINE(
        b, double, q->ending == NULL ? 0 : q->ending->calls->vectors(q->ending, lanes));
    v->scratch = SLI_TAKE_INLINE(b, double, most > across ? most : across);
}

/* Bytes for the blocks of up to nrhs right-hand sides, at most `most` in a block; SIZE_MAX if that
 * overflows. Kernels of one and two right-hand sides keep partial sums that wider ones do not need,
 * so both ends are measured. */
static size_t sli_vectors_bytes(const sli_query *q, sl_int nrhs, sl_int most) {
    sli_block few = {NULL, 0}, many = {NULL, 0};
    sli_vectors v;
    sli_vectors_layout(&v, &few, q, sli_min(nrhs, 2));
    if (nrhs > 2) {
        sli_vectors_layout(&v, &many, q, sli_block_size(nrhs, most));
    }
    return few.used > many.used ? few.used : many.used;
}

/* Cuts the vectors of a block from memory that is large enough. */
static sli_vectors sli_vectors_of(const sli_query *q, sl_int nrhs, void *memory) {
    sli_block b = {NULL, 0};
    sli_vectors v;
    b.base = (unsigned char *)memory;
    sli_vectors_layout(&v, &b, q, nrhs);
    return v;
}

/* The right-hand sides of a call and their solutions, in the caller's arrays, or some of them. */
typedef struct sli_rhs {
    double *X;
    const double *B; /* may be X */
    size_t ldx, ldb; /* as the caller gives them */
    sl_int nrhs;
} sli_rhs;

SLI_INLINE sli_rhs sli_rhs_of(double *X, size_t ldx, const double *B, size_t ldb, sl_int nrhs) {
    sli_rhs r;
    r.X = X;
    r.B = B;
    r.ldx = ldx;
    r.ldb = ldb;
    r.nrhs = nrhs;
    return r;
}

/* Right-hand sides first .. first+count-1. X or B is NULL if it has no rows. */
SLI_INLINE sli_rhs sli_rhs_part(const sli_rhs *all, sl_int first, sl_int count) {
    sli_rhs r = *all;
    if (r.X != NULL) { /* branches untested: all callers have it */
        r.X += (size_t)first * sli_dense_of(r.ldx).column;
    }
    if (r.B != NULL) {
        r.B += (size_t)first * sli_dense_of(r.ldb).column;
    }
    r.nrhs = count;
    return r;
}

/* Checks the right-hand sides of a call, in any layout, for nx rows of X and nb of B. */
static sl_status sli_rhs_check(const sli_rhs *r, sl_int nx, sl_int nb) {
    sl_status status;
    if (r->nrhs == 0) {
        return SL_OK;
    }
    status = sli_argument(r->nrhs < 0              ? "nrhs is below 0"
                          : nx > 0 && r->X == NULL ? "X is NULL"
                          : nb > 0 && r->B == NULL ? "B is NULL"
                                                   : NULL);
    status = status == SL_OK ? sli_dense_check(sli_small_ldx, r->ldx, nx, r->nrhs) : status;
    status = status == SL_OK ? sli_dense_check(sli_small_ldb, r->ldb, nb, r->nrhs) : status;
    return status == SL_OK && r->X == r->B && r->ldx != r->ldb && nx > 0 && nb > 0
               ? sli_argument("X is B, but ldx is not ldb") /* or the layouts differ */
               : status;
}

/* How many rows ahead the loops below prefetch. With one right-hand side rows share cache lines. */
#define SLI_ROWS_AHEAD 32

SLI_ALWAYS_INLINE void sli_prefetch_row(const double *v, sli_rows rows, sl_int k) {
    if (rows.lanes >= 4) { /* untested: constant */
        const sl_int ahead = rows.index[sli_min(k + SLI_ROWS_AHEAD, rows.count - 1)];
        SLI_PREFETCH(v + (ptrdiff_t)ahead * rows.lanes, 0);
    }
}

/* Copies the rows of M to the given rows of v. Called with a constant number of columns and with
 * one of the two strides 1: moving rows in and out is a fifth of a full solve, and an inner loop of
 * variable length would double that. */
SLI_ALWAYS_INLINE void sli_pack_rows(double *v, sli_rows rows, const double *M, sli_dense at,
                                     sl_int columns) {
    sl_int k, r;
    for (k = 0; k < rows.count; k++) {
        sli_prefetch_row(v, rows, k);
        SLI_UNROLL
        for (r = 0; r < columns; r++) {
            v[(ptrdiff_t)rows.index[k] * rows.lanes + r] =
                M[(size_t)k * at.row + (size_t)r * at.column];
        }
    }
}

/* Adds the rows of M to the given rows of v, which may repeat. */
static void sli_pack_sums(double *v, sli_rows rows, const double *M, sli_dense at, sl_int columns) {
    sl_int k, r;
    for (k = 0; k < rows.count; k++) {
        for (r = 0; r < columns; r++) {
            v[(ptrdiff_t)rows.index[k] * rows.lanes + r] +=
                M[(size_t)k * at.row + (size_t)r * at.column];
        }
    }
}

/* Copies the given rows of v to the rows of M. */
SLI_ALWAYS_INLINE void sli_unpack_rows(double *M, sli_dense at, const double *v, sli_rows rows,
                                       sl_int columns) {
    sl_int k, r;
    for (k = 0; k < rows.count; k++) {
        sli_prefetch_row(v, rows, k);
        SLI_UNROLL
        for (r = 0; r < columns; r++) {
            M[(size_t)k * at.row + (size_t)r * at.column] =
                v[(ptrdiff_t)rows.index[k] * rows.lanes + r];
        }
    }
}

/* Rows that are moved at a time, 8 columns after 8 columns: their rows of the vector stay in the
 * second cache. */
#define SLI_PACK_CHUNK 1024

/* Doubles of a vector that will not be in a cache any more when the sweep reads it: it is written
 * around the caches, which saves reading each line first. */
#if defined(SLI_SMALL_TASKS)
#define SLI_STREAMED 1
#else
#define SLI_STREAMED 4000000
#endif

/* The last 5 to 7 columns of a block. */
#define SLI_LAST_CASES(columns, call) \
    switch (columns) { \
        SLI_CASE(5, call) \
        SLI_CASE(6, call) \
    default: \
        call(7); \
    }

#define SLI_PACK_LAST(count) sli_pack_rows(v, rows, M, at, count)
SLI_NOINLINE static void sli_pack_last(double *v, sli_rows rows, const double *M, sli_dense at,
                                       sl_int columns){SLI_LAST_CASES(columns, SLI_PACK_LAST)}

#define SLI_UNPACK_LAST(count) sli_unpack_rows(M, at, v, rows, count)
SLI_NOINLINE static void sli_unpack_last(double *M, sli_dense at, const double *v, sli_rows rows,
                                         sl_int columns) {
    SLI_LAST_CASES(columns, SLI_UNPACK_LAST)
}
#undef SLI_LAST_CASES
#undef SLI_PACK_LAST
#undef SLI_UNPACK_LAST

/* Moves rows begin .. end-1 of a block of b into the forward vector, where no row repeats. */
SLI_NOINLINE static void sli_pack_part(const sl_factor *F, const sli_query *q, double *y,
                                       const sli_rhs *rhs, sl_int begin, sl_int end) {
    const sli_dense at = sli_dense_of(rhs->ldb);
    const sl_int nrhs = rhs->nrhs, lanes = (sl_int)1 << sli_lanes_kind(nrhs), count = end - begin;
    const sl_int *index = q->b_index + begin;
    const double *B = rhs->B + (size_t)begin * at.row;
    const int is_streamed = (size_t)q->nb * (size_t)lanes > SLI_STREAMED;
    sl_int first, chunk, r;
    if (nrhs == 1 && q->b_index == F->S->iperm && at.row == 1) {
        sli_unpack_rows(y + begin, at, rhs->B, sli_rows_of(F->S->perm + begin, count, 1), 1);
    } else if (nrhs == 1) {
        sli_pack_rows(y, sli_rows_of(index, count, 1), B, at, 1);
    } else if (nrhs == 2) {
        sli_pack_rows(y, sli_rows_of(index, count, 2), B, at, 2);
    } else if (nrhs == 3) {
        sli_pack_rows(y, sli_rows_of(index, count, 4), B, at, 3);
    } else if (nrhs == 4) {
        sli_pack_rows(y, sli_rows_of(index, count, 4), B, at, 4);
    } else if (nrhs > SLI_TILE && at.row > 1) { /* whole rows */
        for (r = 0; r < count; r++) {
            memcpy(y + (ptrdiff_t)index[r] * lanes, B + (size_t)r * at.row,
                   (size_t)nrhs * sizeof(double));
        }
    } else {
        for (first = 0; first < count; first += chunk) {
            chunk = sli_min(SLI_PACK_CHUNK, count - first);
            for (r = 0; r < nrhs; r += SLI_TILE) {
                const sli_rows rows = sli_rows_of(index + first, chunk, lanes);
                const double *M = B + (size_t)first * at.row + (size_t)r * at.column;
                if (nrhs - r < SLI_TILE) {
                    sli_pack_last(y + r, rows, M, at, nrhs - r);
                } else if (at.row == 1) {
                    F->kernels->interleave(y + r, rows, M, at.column, is_streamed);
                } else {
                    sli_pack_rows(y + r, rows, M, sli_dense_by_rows(at.row), SLI_TILE);
                }
            }
        }
    }
}

/* Moves a block of b into the forward vector. Rows that are not given, and unused columns of the
 * block, are 0. */
static void sli_pack(const sl_factor *F, const sli_query *q, double *y, const sli_rhs *rhs) {
    const sl_int lanes = (sl_int)1 << sli_lanes_kind(rhs->nrhs);
    if (q->b_repeats || q->nb < q->forward.columns || rhs->nrhs < lanes) {
        SLI_ZERO(y, (size_t)q->forward.columns * (size_t)lanes);
    }
    if (q->b_repeats) {
        sli_pack_sums(y, sli_rows_of(q->b_index, q->nb, lanes), rhs->B, sli_dense_of(rhs->ldb),
                      rhs->nrhs);
    } else if (q->nb > 0) {
        sli_pack_part(F, q, y, rhs, 0, q->nb);
    }
}

/* Moves the wanted rows begin .. end-1 of a block out of the backward vector. */
SLI_AT_LINE SLI_NOINLINE static void sli_unpack_part(const sl_factor *F, const sli_query *q,
                                                     const sli_rhs *rhs, const double *x,
                                                     sl_int begin, sl_int end) {
    const sli_dense at = sli_dense_of(rhs->ldx);
    const sl_int nrhs = rhs->nrhs, lanes = (sl_int)1 << sli_lanes_kind(nrhs), count = end - begin;
    const sl_int *index = q->x_index + begin;
    double *X = rhs->X + (size_t)begin * at.row;
    sl_int first, chunk, r;
    if (nrhs == 1) {
        sli_unpack_rows(X, at, x, sli_rows_of(index, count, 1), 1);
    } else if (nrhs == 2) {
        sli_unpack_rows(X, at, x, sli_rows_of(index, count, 2), 2);
    } else if (nrhs == 3) {
        sli_unpack_rows(X, at, x, sli_rows_of(index, count, 4), 3);
    } else if (nrhs == 4) {
        sli_unpack_rows(X, at, x, sli_rows_of(index, count, 4), 4);
    } else if (nrhs > SLI_TILE && at.row > 1) {
        for (r = 0; r < count; r++) {
            memcpy(X + (size_t)r * at.row, x + (ptrdiff_t)index[r] * lanes,
                   (size_t)nrhs * sizeof(double));
        }
    } else {
        for (first = 0; first < count; first += chunk) {
            chunk = sli_min(SLI_PACK_CHUNK, count - first);
            for (r = 0; r < nrhs; r += SLI_TILE) {
                const sli_rows rows = sli_rows_of(index + first, chunk, lanes);
                double *M = X + (size_t)first * at.row + (size_t)r * at.column;
                if (nrhs - r < SLI_TILE) {
                    sli_unpack_last(M, at, x + r, rows, nrhs - r);
                } else if (at.row == 1) {
                    F->kernels->separate(M, at.column, x + r, rows);
                } else {
                    sli_unpack_rows(M, sli_dense_by_rows(at.row), x + r, rows, SLI_TILE);
                }
            }
        }
    }
}

/* Moves the wanted rows of a block out of the backward vector. */
static void sli_unpack(const sl_factor *F, const sli_query *q, const sli_rhs *rhs,
                       const double *x) {
    sli_unpack_part(F, q, rhs, x, 0, q->nx);
}

#endif

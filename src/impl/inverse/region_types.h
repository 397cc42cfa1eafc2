/* region_types.h: the region object, and the product with its cached inverse */
#ifndef SLI_INVERSE_REGION_TYPES_H
#define SLI_INVERSE_REGION_TYPES_H

#include "../../public/region.h"
#include "../factor/factor_types.h"
#include "../analysis/reach.h"
#include "../solve/query.h"

/* Let T be a set of whole subtrees of the elimination tree, and let S, the boundary, contain the
 * rows of L below them. For b on T and S, a forward sweep inside T gives y = L_TT^-1 b_T and
 * u = b_S - L_ST y, and the backward sweep inside T starts from
 *
 *    x_S = Z_SS u,  Z = A^-1.
 *
 * Z_SS takes the place of everything above T. It is stored as N with Z_SS = N + N', where N is
 * lower triangular with half of the diagonal, in chunks of columns. Each chunk is a panel: -N is
 * below its diagonal block, and its own columns are 0. The forward step of such a panel is then a
 * product with N and its backward step one with N'. The panel is read twice, the second time from
 * the L1 cache. */
struct sl_region {
    sli_ending ending;
    sl_allocator allocator;
    const sl_symbolic *S;
    sli_numbers numbers;  /* Z is a part of the inverse of these */
    sli_region_extent extent;
    sl_int *roots, *rows; /* of the extent: roots of the subtrees, boundary */
    sl_int *requested;    /* boundary rows: as rows of A */
    sl_int *relative;     /* boundary rows: relative indices in the second vector of the product */
    sl_off *begin;        /* chunks + 1: where each panel begins, in doubles */
    double *Z;
    int is_copied;    /* Z was copied from a selected inverse */
    int is_mapped;    /* Z is in mapped memory, and not a part of the object's block */
    int is_immutable; /* mapped, or of a file that this version reads in part */
    double seconds;
    size_t bytes;
};

/* Columns of a chunk: as many as the kernels keep in registers. */
#define SLI_REGION_COLUMNS 8

SLI_INLINE sl_int sli_region_chunks(sl_int rows) {
    return rows / SLI_REGION_COLUMNS + (rows % SLI_REGION_COLUMNS != 0);
}

/* The step of the chunk that begins at column `first` of the boundary. */
SLI_INLINE sli_step sli_region_step(const sl_region *R, sl_int first) {
    sli_step step;
    step.panel = R->begin[first / SLI_REGION_COLUMNS];
    step.column = 0;
    step.base = first;
    step.width = sli_min(SLI_REGION_COLUMNS, R->extent.n_rows - first);
    step.below = R->extent.n_rows - first;
    step.first_tile = 0;
    step.up = -1;
    return step;
}

/* Doubles of the chunk after which and with which the boundary has this many rows: whole tiles. */
SLI_INLINE sl_off sli_region_chunk_size(sl_int rows) {
    const sl_int width = sli_min(SLI_REGION_COLUMNS, rows);
    return sli_tile_offset(width, sli_tiles(width + rows));
}

/* Doubles of Z for a boundary of this many rows. */
static sl_off sli_region_entries(sl_int rows) {
    sl_off size = 0;
    sl_int first;
    for (first = 0; first < rows; first += SLI_REGION_COLUMNS) {
        size += sli_region_chunk_size(rows - first);
    }
    return size;
}

static void sli_region_layout(sl_region *R, sli_block *b) {
    const sl_int rows = R->extent.n_rows;
    (void)sli_take(b, 1, sizeof(sl_region));
    R->roots = SLI_TAKE(b, sl_int, R->extent.n_roots);
    R->rows = SLI_TAKE(b, sl_int, rows);
    R->requested = SLI_TAKE(b, sl_int, rows);
    R->relative = SLI_TAKE(b, sl_int, rows);
    R->begin = SLI_TAKE(b, sl_off, (uint64_t)sli_region_chunks(rows) + 1);
    R->Z = R->is_mapped ? R->Z : SLI_TAKE(b, double, sli_region_entries(rows));
    R->bytes = b->used;
}

/* Is Z the inverse of the numbers that F holds? */
SLI_INLINE int sli_region_fits(const sl_region *R, const sl_factor *F) {
    return sli_numbers_are_of(&R->numbers, F);
}

/* Doubles of a product's vectors: u, the result, and u again. */
/* boundary: 1 for each chunk with a row that the forward sweep may change or the backward sweep
 * reads.
 *
 * x := Z_SS u, interleaved, in the chunks that are used; u is v->y, and x, which may be u, is v->x.
 * In the forward step the columns of a chunk are u and its rows the result. In the backward step,
 * where the vector begins one boundary later, the columns are the result and the rows u. */
static void sli_region_apply(const sl_region *R, const sli_ending_use *boundary,
                             const sli_kernels *kernels, int kind, const sli_vectors *v) {
    static const double sli_ones[SLI_REGION_COLUMNS] = {1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0};
    const sli_sweeps *sweeps = &kernels->sweeps; /* Z is in double */
    const sl_int n = R->extent.n_rows;
    const size_t size = (size_t)n << kind;
    double *vectors = v->product;
    sli_reach reach;
    sl_int first;
    if (n == 0) {
        return;
    }
    SLI_CLEAR(reach);
    reach.count = 1;
    memcpy(vectors, v->y, size * sizeof(double));
    memset(vectors + size, 0, size * sizeof(double));
    memcpy(vectors + 2 * size, v->y, size * sizeof(double));
    for (first = 0; first < n; first += SLI_REGION_COLUMNS) {
        const sli_step step = sli_region_step(R, first);
        reach.steps = &step;
        reach.n_rows = step.below;
        if (boundary->b[first / SLI_REGION_COLUMNS]) {
            reach.rows = R->relative + first;
            sweeps->forward[kind](&reach, R->Z, vectors, v->scratch);
        }
        if (boundary->x[first / SLI_REGION_COLUMNS]) {
            reach.rows = R->relative + n - step.below;
            sweeps->backward[kind](&reach, R->Z, sli_ones, vectors + size, v->scratch);
        }
    }
    memcpy(v->x, vectors + size, size * sizeof(double));
}

#endif

/* region_parts.h: the region object, and what a sweep that ends there needs: the product with the cached inverse */
#ifndef SLI_REGION_PARTS_H
#define SLI_REGION_PARTS_H

#include "../public/region.h"
#include "factor_parts.h"
#include "reach.h"

/* Let T be whole subtrees of the elimination tree and S, the boundary, contain the rows of L below them. For b
 * on T and S, y = L_TT^-1 b_T and u = b_S - L_ST y are what a forward sweep inside T leaves, and
 *
 *     x_S = Z_SS u, Z = A^-1,
 *
 * is where the backward sweep inside T starts: all that is above T is in Z_SS. It is kept as N with
 * Z_SS = N + N', N lower triangular with half of the diagonal, in chunks of columns, and -N stands in the
 * places below the diagonal block of a panel whose own columns are 0. What a step does to the rows below it on
 * the way forward is then a product with N, and what these do to it on the way back one with N': the panel is
 * read twice, the second time from the first cache. */
struct sl_region {
    sl_allocator allocator;
    const sl_symbolic *S; /* borrowed */
    const sl_factor *F;   /* Z is its inverse, and .. */
    uint64_t generation;  /* .. of these numbers of it; 0 for none */
    sli_fence fence;
    sl_int *roots, *rows; /* of the fence */
    sl_int *asked;        /* fence.n_rows: rows of A */
    sl_int inside;        /* rows of A in the subtrees */
    sl_int *places;       /* fence.n_rows: those of the boundary in the product's second vector */
    sl_off *begin;        /* chunks + 1: the panels, in doubles */
    double *Z;
    int is_copied; /* Z is out of a selected inverse */
    double seconds;
    size_t bytes;
};

/* Columns of a chunk: kernels keep all of so few in registers. */
#define SLI_REGION_COLUMNS 8

SLI_INLINE sl_int sli_region_chunks(sl_int rows) {
    return rows / SLI_REGION_COLUMNS + (rows % SLI_REGION_COLUMNS != 0);
}

/* The chunk that begins at column `first` of a boundary, as a step. */
SLI_INLINE sli_step sli_region_step(const sl_region *R, sl_int first) {
    sli_step step;
    step.panel = R->begin[first / SLI_REGION_COLUMNS];
    step.column = 0;
    step.base = first;
    step.width = sli_min(SLI_REGION_COLUMNS, R->fence.n_rows - first);
    step.below = R->fence.n_rows - first;
    step.first_tile = 0;
    step.up = -1;
    return step;
}

static void sli_region_layout(sl_region *R, sli_block *b) {
    const sl_int rows = R->fence.n_rows;
    sl_off size = 0;
    sl_int first;
    (void)sli_take(b, 1, sizeof(sl_region));
    R->roots = SLI_TAKE(b, sl_int, R->fence.n_roots);
    R->rows = SLI_TAKE(b, sl_int, rows);
    R->asked = SLI_TAKE(b, sl_int, rows);
    R->places = SLI_TAKE(b, sl_int, rows);
    R->begin = SLI_TAKE(b, sl_off, (uint64_t)sli_region_chunks(rows) + 1);
    for (first = 0; first < rows; first += SLI_REGION_COLUMNS) {
        size += sli_panel_size(sli_min(SLI_REGION_COLUMNS, rows - first), rows - first);
    }
    R->Z = SLI_TAKE(b, double, size);
    R->bytes = b->used;
}

/* Does Z belong to the numbers that F holds? */
SLI_INLINE int sli_region_fits(const sl_region *R, const sl_factor *F) {
    return R->F == F && R->generation == F->generation;
}

/* Doubles for a product: u, the result, and u again, then the scratch of the kernels. */
SLI_INLINE uint64_t sli_region_vectors(const sl_region *R, sl_int lanes) {
    return 3 * (uint64_t)R->fence.n_rows * (uint64_t)lanes;
}

SLI_INLINE size_t sli_region_scratch(const sl_region *R, sl_int lanes) {
    return sli_scratch_size(SLI_REGION_COLUMNS + R->fence.n_rows, SLI_REGION_COLUMNS, lanes);
}

/* What a plan has to do with a boundary: 1 for each chunk with a row that its forward sweep may leave a number in, or
 * that its backward sweep reads. */
typedef struct sli_shore {
    const unsigned char *b, *x; /* chunks each */
    sl_off entries;             /* doubles of the inverse in those of either kind */
} sli_shore;

/* x := Z_SS u, interleaved, where u and x matter; x may be u. On the way forward a chunk's columns are u and its
 * rows the result; on the way back, where the vector begins one boundary later, its columns are the result and its
 * rows u. */
static void sli_region_apply(const sl_region *R, const sli_shore *shore, const sli_kernels *kernels,
                             int kind, const double *u, double *x, double *vectors,
                             double *scratch) {
    static const double sli_ones[SLI_REGION_COLUMNS] = {1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0};
    const sl_int n = R->fence.n_rows;
    const size_t size = (size_t)n << kind;
    sl_int first;
    if (n == 0) {
        return;
    }
    memcpy(vectors, u, size * sizeof(double));
    memset(vectors + size, 0, size * sizeof(double));
    memcpy(vectors + 2 * size, u, size * sizeof(double));
    for (first = 0; first < n; first += SLI_REGION_COLUMNS) {
        const sli_step step = sli_region_step(R, first);
        if (shore->b[first / SLI_REGION_COLUMNS]) {
            kernels->forward[kind](1, &step, R->places + first, R->Z, vectors, scratch);
        }
        if (shore->x[first / SLI_REGION_COLUMNS]) {
            kernels->backward[kind](1, &step, R->places + n, R->Z, sli_ones, vectors + size,
                                    scratch);
        }
    }
    memcpy(x, vectors + size, size * sizeof(double));
}

#endif

/* table.h: the table of kernels, which every instruction set fills */
#ifndef SLI_KERNELS_TABLE_H
#define SLI_KERNELS_TABLE_H

#include "../../public/types.h"
#include "front.h"
#include "inverse_front.h"
#include "pairs.h"
#include "step.h"

/* sums(i, j) -= y(k, i) z(k, j) over `count` rows k of 8 values each. sums: 8 x 8, row-major. All
 * arrays are 64-byte aligned. */
typedef void (*sli_products_kernel)(sl_int count, const double *y, const double *z, double *sums);

/* Changes the `columns` columns of one row tile l by k = 2, 4 or 8 vectors: w(r) -= l y(r), then
 * l += sum over r of b(r) w(r). w: [k][8]; c: for each column y(0) .. y(k-1), -b(0) .. -b(k-1). */
typedef void (*sli_change_kernel)(double *l, sl_int columns, const double *c, double *w);

/* k = 2 .. 8 vectors on their way through the pivots: W U diag(alpha) U' W'. 64-byte aligned. */
typedef struct sli_ranks {
    double U[SLI_TILE][SLI_TILE]; /* column by column, with a unit diagonal */
    double alpha[SLI_TILE];
    double e[SLI_TILE], magnitude[SLI_TILE]; /* new pivots, and the sums that they are made of */
    sl_int ranks, lanes;
} sli_ranks;

/* The pivots of one column tile l: changes u and fills c, as sli_change_kernel takes it. d: the
 * pivots. w: [k][8], rows of the tile; if l is NULL, what a forward sweep makes of them. Returns
 * how many pivots were computed: all, or up to one that vanishes. */
typedef sl_int (*sli_ranks_kernel)(sli_ranks *u, const double *l, sl_int columns, const double *d,
                                   const double *w, double *c);

/* The change of a panel by one vector w w'/s, from a row tile on. On entry `sum` is -s, on return
 * what is left of it for the rows below. w, b, e: 64-byte aligned, by local rows, up to a multiple
 * of 8. */
typedef struct sli_rank_one {
    double *panel;
    const double *D; /* of its columns */
    sl_int width, below, first_tile;
    int is_trial; /* computes the pivots alone */
    double sum;
    double *w; /* the vector; on return y, and what is left below */
    double *b; /* scratch */
    double *e; /* the new pivots */
} sli_rank_one;
typedef void (*sli_rank_one_kernel)(sli_rank_one *u);

/* Copies rows 0 .. count-1 of 8 columns of M, ldm apart, to v + index[k] stride, and back. v is
 * 64-byte aligned, stride is a multiple of 8. is_streamed: v is not read before it would have left
 * the caches. */
typedef void (*sli_interleave_kernel)(double *v, sl_int stride, const sl_int *index, sl_int count,
                                      const double *M, size_t ldm, int is_streamed);
typedef void (*sli_separate_kernel)(double *M, size_t ldm, const double *v, sl_int stride,
                                    const sl_int *index, sl_int count);

typedef struct sli_kernels {
    sl_isa isa;
    sli_sweeps sweeps[3]; /* of sl_storage */
    sli_row_kernel row;
    sli_front_kernels fronts[3]; /* in double, in float, of complex matrices */
    sli_products_kernel products;
    sli_interleave_kernel interleave;
    sli_separate_kernel separate;
    sli_gather_kernel gather;
    sli_inverse_phase_kernel inverse_phase;
    sli_takahashi_kernel takahashi;
    sli_change_kernel change[SLI_NRHS_KINDS - 1]; /* from 2 vectors on */
    sli_ranks_kernel change_ranks;
    sli_rank_one_kernel change_panel;
} sli_kernels;

#endif

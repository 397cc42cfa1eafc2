/* change_kernels.h: the kernels of rank-k changes, for every instruction set */
#ifndef SLI_CHANGE_CHANGE_KERNELS_H
#define SLI_CHANGE_CHANGE_KERNELS_H

#include "../kernels/dispatch.h"

/* Changes the `columns` columns of one row tile l by k = 2, 4 or 8 vectors: w(r) -= l y(r), then
 * l += sum over r of b(r) w(r). w: [k][8]; c: for each column y(0) .. y(k-1), -b(0) .. -b(k-1). A
 * trial leaves l as it is. */
typedef void (*sli_change_kernel)(double *l, sl_int columns, const double *c, double *w,
                                  int is_trial);

/* The same for k = 2 and two row tiles l and l1. w: [tile][k][8] */
typedef void (*sli_change_pair_kernel)(double *l, double *l1, sl_int columns, const double *c,
                                       double *w, int is_trial);

/* Adds |l| |d| |l| of the columns of row tile l, or of 4 `stride` doubles apart, to the sums w of
 * their rows. w: [tile][8], 64-byte aligned */
typedef void (*sli_magnitudes_kernel)(const double *l, ptrdiff_t stride, sl_int tiles,
                                      sl_int columns, const double *d, double *w);

/* k = 2 .. 8 vectors that pass the pivots: W U diag(alpha) U' W'. 64-byte aligned. */
typedef struct sli_ranks {
    double U[SLI_TILE][SLI_TILE]; /* column by column, with a unit diagonal */
    double alpha[SLI_TILE];
    double e[SLI_TILE], magnitude[SLI_TILE]; /* new pivots, and the sums that they are made of */
    double square[SLI_TILE], unit[SLI_TILE]; /* of the largest entry of each vector, and 1 / it */
    double swept[SLI_TILE]; /* of each pivot: the sum of alpha y^2 with y by the old L, at most */
    sl_int ranks, lanes;
    int is_mixed; /* pivots have both signs: f(r) has the errors of the vectors before it, too */
} sli_ranks;

/* The pivots of one column tile l: changes u and fills c, as sli_change_kernel takes it. d: the
 * pivots. w: [k][8], rows of the tile. c has room for 8 more. Returns how many pivots were
 * computed: all, or up to one that vanishes. */
typedef sl_int (*sli_ranks_kernel)(sli_ranks *u, const double *l, sl_int columns, const double *d,
                                   const double *w, double *c);

/* The change of a panel by one vector w w'/s, from a row tile on. w, y, b, e: 64-byte aligned, by
 * local rows, up to a multiple of 8. */
typedef struct sli_rank_one {
    double *panel;
    const double *D; /* of its columns */
    sl_int super, width, below, first_tile;
    ptrdiff_t ahead; /* a change prefetches so many bytes ahead */
    double sum;      /* -s, then what is left of it for the rows below */
    double *w;       /* the vector; after the change of the panel, what is left of it below */
    double *y; /* what a forward sweep makes of w: of its columns or, in a sweep, of all rows */
    double *b; /* scratch */
    double *e; /* the new pivots */
} sli_rank_one;
/* A sweep fills y, b and e and changes sum. A change, by y and b, changes the panel and w; with a
 * sweep, by those of the columns, which the sweep finds on the way. */
typedef void (*sli_rank_one_kernel)(sli_rank_one *u, int has_sweep, int has_change);

typedef struct sli_change_kernels {
    sli_change_kernel change[SLI_NRHS_KINDS - 1]; /* from 2 vectors on */
    sli_change_pair_kernel pair;
    sli_magnitudes_kernel magnitudes;
    sli_ranks_kernel ranks;
    sli_rank_one_kernel panel;
} sli_change_kernels;

#define SLV_SINGLE 0
#define SLV_COMPLEX 0
#define SLI_FOR_ISA "../change/change.list.h"
#include "../kernels/each_isa.list.h"
#undef SLI_FOR_ISA
#undef SLV_SINGLE
#undef SLV_COMPLEX

/* The table of an instruction set. */
SLI_INLINE const sli_change_kernels *sli_change_kernels_of(sl_isa isa) {
    static const sli_change_kernels *const tables[] = SLI_ISA_TABLES(sli_change_kernels);
    return tables[isa];
}

#endif

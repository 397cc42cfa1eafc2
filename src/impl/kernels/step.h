/* step.h: the steps of a sweep, one for each supernode, and the contract of sweep kernels */
#ifndef SLI_KERNELS_STEP_H
#define SLI_KERNELS_STEP_H

#include "panel.h"

/* One supernode of a reach. The vector x of a sweep holds only the columns of the reach, without
 * gaps; for a full sweep the reach is every column and base is the column itself. A sweep enters a
 * supernode at the start of a row tile. So a local sweep does the same operations in the same order
 * as a full one, which computes with zeros in the columns that the local one leaves out. */
typedef struct sli_step {
    sl_off panel;      /* position of the panel in L */
    sl_int column;     /* first column needed: 8 first_tile columns into the supernode */
    sl_int base;       /* position of that column in x */
    sl_int width;      /* columns of the supernode */
    sl_int below;      /* rows below its diagonal block; the sweep lists their positions in x */
    sl_int first_tile; /* tiles and columns before it are not needed */
    sl_int up;         /* step of the parent supernode, -1 at a root */
} sli_step;

/* Columns of x that belong to a step. */
SLI_INLINE sl_int sli_step_columns(const sli_step *s) {
    return s->width - SLI_TILE * s->first_tile;
}

/* Right-hand sides are interleaved: row i of x is x[i nrhs] .. x[i nrhs + nrhs - 1], with nrhs = 1,
 * 2, 4 or 8, and for sweeps also 16, 32 or 64. A table of kernels has one kernel for each; nrhs is
 * 1 << kind. A right-hand side has the same bits in sweeps of 8 and more. */
enum {
    SLI_NRHS_1,
    SLI_NRHS_2,
    SLI_NRHS_4,
    SLI_NRHS_8,
    SLI_NRHS_16,
    SLI_NRHS_32,
    SLI_NRHS_64,
    SLI_SWEEP_KINDS,
    SLI_NRHS_KINDS = SLI_NRHS_16
};

/* Rows of such a block: their positions, and the right-hand sides of a row. */
typedef struct sli_rows {
    const sl_int *index; /* count */
    sl_int count, lanes;
} sli_rows;

SLI_ALWAYS_INLINE sli_rows sli_rows_of(const sl_int *index, sl_int count, sl_int lanes) {
    sli_rows rows;
    rows.index = index;
    rows.count = count;
    rows.lanes = lanes;
    return rows;
}

#if defined(SLI_SIMD)
/* The rows of a tile, as rows of a vector. */
static const sl_int sli_tile_rows[SLI_TILE] = {0, 1, 2, 3, 4, 5, 6, 7};
#endif

/* A compiled reach: its supernodes ascending, each from the first column needed, and the rows below
 * them as indices into a compact vector that has the columns of the reach only. */
typedef struct sli_reach {
    sl_int count;           /* supernodes */
    sl_int columns;         /* length of the compact vector */
    sl_int tallest, widest; /* largest height and width, for the scratch */
    sl_off n_rows;          /* length of rows */
    sl_off entries;         /* doubles of L that a sweep reads */
    const sli_step *steps;  /* count */
    const sl_int *rows;     /* n_rows, step after step */
    /* count: the rows below supernodes of one column, the panels of which follow each other; -1:
     * wider ones. A sweep then reads 4 bytes of such a step. NULL: not known */
    const sl_int *plain;
} sli_reach;

/* x := L^-1 x over the steps in ascending order. L: as it is stored, 64-byte aligned. scratch:
 * sli_sweep_scratch doubles for the tallest and widest step, 64-byte aligned. */
typedef void (*sli_forward_kernel)(const sli_reach *R, const void *L, double *x, double *scratch);

/* x := L'^-1 D^-1 x over the steps in descending order. */
typedef void (*sli_backward_kernel)(const sli_reach *R, const void *L, const double *D, double *x,
                                    double *scratch);

/* All sweeps over L of one type. */
typedef struct sli_sweeps {
    sli_forward_kernel forward[SLI_SWEEP_KINDS];
    sli_backward_kernel backward[SLI_SWEEP_KINDS];
} sli_sweeps;

/* The row that the up-looking factorization computes. */
typedef struct sli_row {
    double *L;
    const double *D;
    double *x;       /* n: minus the updates so far */
    double *scratch; /* for a sweep */
    double pivot, magnitude;
} sli_row;

/* Its part l in a supernode: local row q of the panel, which holds the row of A on entry. Computes
 * l, adds its updates to the rows of x before q, and clears x on the columns of the supernode.
 * pivot -= l' D l; magnitude += |l' D l|, summed entry by entry. rows: below the supernode. */
typedef void (*sli_row_kernel)(sli_row *k, const sli_step *s, sl_int q, const sl_int *rows);

/* Doubles of scratch for a step of a given height (width + below) and width. Kernels for 1 and 2
 * right-hand sides copy all rows and keep 8 partial sums for each column. The others work on x in
 * place and copy only the rows of one tile. */
SLI_INLINE size_t sli_sweep_scratch(sl_int height, sl_int width, sl_int nrhs) {
    const size_t tile = SLI_TILE;
    return nrhs > 2 ? tile * (size_t)nrhs
                    : tile * ((size_t)sli_tiles(height) * (size_t)nrhs + (size_t)width);
}

/* The same for sweeps of any number of right-hand sides up to nrhs: those of one and two keep
 * partial sums that wider ones do not need. */
SLI_INLINE size_t sli_sweep_scratch_up_to(sl_int height, sl_int width, sl_int nrhs) {
    const size_t few = sli_sweep_scratch(height, width, sli_min(nrhs, 2));
    const size_t many = sli_sweep_scratch(height, width, nrhs);
    return few > many ? few : many;
}

/* Distance in bytes from the entries of L that a sweep reads to those that it prefetches. Small
 * supernodes are read too slowly for the hardware prefetcher to run far enough ahead, and it starts
 * again at every page. */
#define SLI_PREFETCH_DISTANCE 4096

/* Rows of x are whole cache lines in sweeps of 8 and more right-hand sides, and the hardware does
 * not foresee where the next ones are. The lists of rows say it: while a step is computed, the rows
 * of the step SLI_STEPS_AHEAD from it are prefetched, up to SLI_ROWS_FETCHED of each kind. With
 * more, a step takes long enough to hide most misses. It costs a tenth if x is in the cache anyway:
 * below SLI_FETCHED_BYTES. */
#define SLI_STEPS_AHEAD 2
#define SLI_ROWS_FETCHED 24
#if defined(SLI_SMALL_TASKS)
#define SLI_FETCHED_BYTES 1
#else
#define SLI_FETCHED_BYTES 4000000
#endif

SLI_INLINE int sli_steps_exceed_cache(sl_int count, const sli_step *s, sl_int nrhs) {
    return nrhs >= 8 && count > SLI_STEPS_AHEAD &&
           (size_t)s[count - 1].base * (size_t)nrhs * sizeof(double) > SLI_FETCHED_BYTES;
}

/* rows: of the step */
SLI_NOINLINE static void sli_step_prefetch(const sli_step *s, const sl_int *rows, const double *x,
                                           sl_int nrhs) {
    const sl_int columns = sli_min(sli_step_columns(s), SLI_ROWS_FETCHED);
    const sl_int below = sli_min(s->below, SLI_ROWS_FETCHED);
    sl_int k, r;
    SLI_KEEP_CALL; /* gcc drops the call of a function that does nothing but this */
    for (k = 0; k < columns * nrhs; k += 8) {
        SLI_PREFETCH(x + (ptrdiff_t)s->base * nrhs + k, 0);
    }
    for (r = 0; r < below; r++) {
        for (k = 0; k < nrhs; k += 8) {
            SLI_PREFETCH(x + (ptrdiff_t)rows[r] * nrhs + k, 0);
        }
    }
}

#endif

/* inverse_front.h: a front of the inverse, and the contract of the kernels that compute it */
#ifndef SLI_INVERSE_INVERSE_FRONT_H
#define SLI_INVERSE_INVERSE_FRONT_H

#include "../kernels/panel.h"

/* Z is the inverse of P A P'. The front of a supernode holds Z on its columns and the rows below, h
 * in all, both triangles, in row tiles [tile][h][8] with the tile numbers of the panel. */
typedef struct sli_inverse_front {
    const double *panel; /* L .. */
    const double *D;     /* .. and its pivots */
    double *front;
    sl_int width, below;
    sl_int first; /* groups of columns that end before this column are not completed */
} sli_inverse_front;

/* Position of row tile t of an inverse front of h rows, in doubles. */
SLI_INLINE ptrdiff_t sli_square_offset(sl_int h, sl_int t) {
    return (ptrdiff_t)SLI_TILE * h * t;
}

/* Columns are completed in groups: column tiles and columns of a group, and doubles in a row tile
 * of its L'^-1. */
#define SLI_INVERSE_GROUP 16
#define SLI_INVERSE_COLUMNS (SLI_INVERSE_GROUP * SLI_TILE)
#define SLI_INVERSE_ROW (SLI_INVERSE_COLUMNS * SLI_TILE)

/* First column of the last group. */
SLI_INLINE sl_int sli_inverse_last_group(const sli_inverse_front *f) {
    return (f->width - 1) / SLI_INVERSE_COLUMNS * SLI_INVERSE_COLUMNS;
}

/* Columns of the group that begins at column j0. */
SLI_INLINE sl_int sli_inverse_group_columns(const sli_inverse_front *f, sl_int j0) {
    return sli_min(SLI_INVERSE_COLUMNS, f->width - j0);
}

/* The scratch of a group holds N and P, SLI_INVERSE_GROUP row tiles each, then W: where W begins,
 * its distance in doubles from one column tile to the next, and the doubles of scratch for
 * supernodes of a given height and width. */
SLI_INLINE double *sli_inverse_weights(double *scratch) {
    return scratch + 2 * SLI_INVERSE_GROUP * SLI_INVERSE_ROW;
}
SLI_INLINE ptrdiff_t sli_inverse_stride(const sli_inverse_front *f, sl_int j0) {
    const sl_int above = (j0 + sli_inverse_group_columns(f, j0)) / SLI_TILE;
    return SLI_TILE * SLI_TILE * (ptrdiff_t)(sli_tiles(f->width + f->below) - above);
}
SLI_INLINE sl_off sli_inverse_scratch(sl_int height, sl_int width) {
    return 2 * SLI_INVERSE_GROUP * SLI_INVERSE_ROW +
           (sl_off)SLI_TILE * SLI_TILE * sli_min(sli_tiles(width), SLI_INVERSE_GROUP) *
               sli_tiles(height);
}

/* Copies Z of the rows below a supernode, row tiles t0 .. t1-1, from the front of its parent, which
 * has `height` rows. relative: the relative indices, ascending: the local row in the parent's front
 * of each row below. */
typedef void (*sli_gather_kernel)(const sli_inverse_front *f, const double *from, sl_int height,
                                  const sl_int *relative, sl_int t0, sl_int t1);

/* Completes the front by Takahashi's equations, one group of columns J after another, from the last
 * to the first. S: all rows after the group. With N = -L_JJ'^-1, P = -N D^-1 and W = L_SJ L_JJ^-1:
 * Z_SJ = -Z_SS W and Z_JJ = P N' - W' Z_SJ. */
typedef void (*sli_takahashi_kernel)(const sli_inverse_front *f, double *scratch);

/* The phases of a group, in order. The row tiles of a phase may be distributed over threads. */
typedef enum sli_inverse_phase {
    SLI_INVERSE_TRIANGLE = 0, /* N and P: tiles of the group */
    SLI_INVERSE_WEIGHTS,      /* W: tiles of S */
    SLI_INVERSE_PRODUCT,      /* Z_SJ: tiles of S */
    SLI_INVERSE_MIRROR,       /* Z_JS = Z_SJ': tiles of S */
    SLI_INVERSE_SQUARE        /* Z_JJ: tiles of the group */
} sli_inverse_phase;
#define SLI_INVERSE_PHASES 5

/* Row tiles first .. last-1. */
typedef struct sli_tile_range {
    sl_int first, last;
} sli_tile_range;

/* The row tiles of a phase. */
SLI_INLINE sli_tile_range sli_inverse_tiles(const sli_inverse_front *f, sl_int j0,
                                            sli_inverse_phase phase) {
    const sl_int m = sli_inverse_group_columns(f, j0), h = f->width + f->below;
    sli_tile_range range = {0, sli_tiles(m)};
    if (phase != SLI_INVERSE_TRIANGLE && phase != SLI_INVERSE_SQUARE) {
        range.last = j0 + m < h ? sli_tiles(h) : 0;
        range.first = sli_min((j0 + m) / SLI_TILE, range.last);
    }
    return range;
}

/* Row tiles t0 .. t1-1 of one phase. */
typedef void (*sli_inverse_phase_kernel)(const sli_inverse_front *f, sl_int j0,
                                         sli_inverse_phase phase, sl_int t0, sl_int t1,
                                         double *scratch);

#endif

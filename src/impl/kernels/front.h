/* front.h: a front of the factorization, and the contract of the kernels that work on it */
#ifndef SLI_KERNELS_FRONT_H
#define SLI_KERNELS_FRONT_H

#include "panel.h"
#include "pivot_rule.h"

/* The front of a supernode with w columns and u rows below is its panel and its update matrix. The
 * update matrix is the lower triangle, in row tiles as in a panel, that begins at row tile w / 8 of
 * the front, so that the rows below have the same lane in both. Its first w % 8 rows and columns
 * and the part above the diagonal are not used. */

/* Position of row tile t of a triangle, in entries. */
SLI_INLINE sl_off sli_triangle_offset(sl_int t) {
    return 32 * (sl_off)t * (t + 1);
}

/* Row tiles of the update matrix of a supernode with w columns and u rows below. */
SLI_INLINE sl_int sli_update_tiles(sl_int w, sl_int u) {
    return u == 0 ? 0 : sli_tiles(w % SLI_TILE + u);
}

/* Blocking of the products: column tiles that are updated together, and columns that they are
 * updated by at a time. A row tile reads 8 KB of a chunk (three of them and a column tile fit the
 * first cache of 32 KB), the group 64 KB (fits the second). */
#define SLI_GROUP_TILES 8
#define SLI_CHUNK_COLUMNS 128

/* Distance in bytes from the entries that extend-add moves to those that it prefetches. */
#define SLI_ASSEMBLE_DISTANCE 1024

/* Entries of scratch for fronts of some width. */
SLI_INLINE sl_int sli_front_scratch(sl_int width) {
    return SLI_GROUP_TILES * SLI_TILE * sli_min(width, SLI_CHUNK_COLUMNS);
}

/* Entries of the array `reciprocals` of a front: 24 for each column tile of a group. */
#define SLI_FRONT_RECIPROCALS (3 * SLI_GROUP_TILES * SLI_TILE)

/* Groups of column tiles of a front. */
SLI_INLINE sl_int sli_front_groups(sl_int width) {
    return (sli_tiles(width) + SLI_GROUP_TILES - 1) / SLI_GROUP_TILES;
}

typedef struct sli_front {
    double *panel;
    sl_int width, below;
    double *update;
    double *D;         /* width pivots */
    double *magnitude; /* 8 for each row tile: what the diagonal was computed from, in magnitude */
    const unsigned char *pairs; /* width: SLI_PAIR_*; NULL: no 2x2 pivots */
    double *E;                  /* width: D(k+1, k); NULL: no 2x2 pivots */
    /* 24 for each column tile of a group: 8 values 1/d, 8 values -sign(d) and, in a tile with 2x2
     * pivots, 8 divisors. The first 1/d is 0 if any of them is out of range. */
    double *reciprocals;
    int is_small; /* one row tile: its pivots are eliminated from the update matrix at once */
    const sli_pivot_rule *rule;
    sl_int super, column; /* the supernode and its first column */
} sli_front;

/* A front is eliminated by groups of SLI_GROUP_TILES column tiles that begin at tile c0: first the
 * row tiles of the group's pivots, then all row tiles below them. The update matrix comes last.
 *
 * On entry panel and update hold A plus the contributions of the children, and magnitude the sum of
 * their magnitudes on the diagonal. At the end the panel holds L, D holds the pivots, and L D L' is
 * subtracted from update. In the rows of the panel magnitude is that of the pivot; in the others it
 * has grown by |L D L'| on the diagonal. Every row tile is computed independently of the others, so
 * they may be distributed over threads.
 *
 * Rows, columns and tiles of a front of a complex matrix are those of its real one. The magnitude
 * of a pair of rows is the sum of two numbers, except in rows of the panel. */

/* The row tiles of a group's pivots. */
typedef void (*sli_pivots_kernel)(const sli_front *f, sl_int c0, void *scratch);

/* Row tiles t0 .. t1-1 of a group, all below its pivots. */
typedef void (*sli_rows_kernel)(const sli_front *f, sl_int c0, sl_int t0, sl_int t1, void *scratch);

/* Row tiles t0 .. t1-1 and column tiles c0 .. c1-1 of the update matrix, or of a triangle that is a
 * part of it. update points to the triangle that begins at tile c0. No tile is before the last tile
 * of pivots. scratch: sli_front_scratch entries. */
typedef void (*sli_update_kernel)(const sli_front *f, sl_int c0, sl_int c1, sl_int t0, sl_int t1,
                                  void *scratch);

/* Extend-add: adds rows first .. last-1 of a descendant's update matrix to a front, in row i the
 * columns 0 .. min(i, columns-1). The first `skipped` rows and columns of the matrix are not used;
 * row 0 is the first after them. relative: the relative indices, ascending: the local row in the
 * front of each row. Two calls for the same front must not run at the same time on rows of the same
 * tile of the front. from: doubles. */
typedef void (*sli_assemble_kernel)(const sli_front *f, const void *from, sl_int skipped,
                                    const sl_int *relative, sl_int columns, sl_int first,
                                    sl_int last);

typedef struct sli_front_kernels {
    sli_pivots_kernel pivots;
    sli_rows_kernel rows;
    sli_update_kernel update;
    sli_assemble_kernel assemble;
} sli_front_kernels;

#endif

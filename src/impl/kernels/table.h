/* kernels.h: the contract of the numerical kernels: panels, steps, sweeps, and the table that an ISA fills */
#ifndef SLI_KERNELS_H
#define SLI_KERNELS_H

#include "../public/types.h"
#include "base.h"

/* Panels. Supernode s, w columns and u rows below them, is stored as row tiles of 8,
 * [tile][column][8], whatever the ISA: local row r of column j stands in tile r/8, lane r%8. Tiles
 * of the diagonal block keep only their first 8 (tile + 1) columns; the unit diagonal, what is
 * above it, and the padding of the last tile are 0. */
#define SLI_TILE 8

/* Bytes between what a solve reads of L and what it asks for ahead. Small supernodes are read too
 * slowly for the hardware to run ahead far enough, and at every page it starts anew. */
#define SLI_AHEAD 4096

/* A sweep of so few steps is taken for one that finds L in a cache. There two row tiles at a time are
 * faster; from main memory only the strict order of the panels keeps the hardware reading ahead. The
 * numbers are the same. */
#define SLI_FEW_STEPS 4096

/* Where tile t of a panel of w columns starts, in doubles: the trapezoid grows until it is w
 * columns wide. */
SLI_INLINE sl_off sli_tile_offset(sl_int w, sl_int t) {
    sl_off whole = w / SLI_TILE, tile = t;
    return tile <= whole ? 32 * tile * (tile + 1)
                         : 32 * whole * (whole + 1) + (tile - whole) * SLI_TILE * w;
}

/* Tiles that hold a number of rows. */
SLI_INLINE sl_int sli_tiles(sl_int rows) {
    return rows / SLI_TILE + (rows % SLI_TILE != 0);
}

/* Doubles of a panel of w columns and u rows below them. */
SLI_INLINE sl_off sli_panel_size(sl_int w, sl_int u) {
    return sli_tile_offset(w, sli_tiles(w + u));
}

/* Where local row r of column j stands in a panel of w columns. */
SLI_INLINE sl_off sli_panel_at(sl_int w, sl_int r, sl_int j) {
    return sli_tile_offset(w, r / SLI_TILE) + (sl_off)j * SLI_TILE + r % SLI_TILE;
}

/* One supernode of a reach. A sweep's vector x holds only the columns of its reach, closely packed;
 * a whole analysis is the reach in which base is the column itself. A supernode is entered at a
 * whole tile, so that a local sweep does the same operations in the same order as the full one,
 * which computes with zeros where the local one has nothing. */
typedef struct sli_step {
    sl_off panel;      /* position of the panel in L */
    sl_int column;     /* first column needed: 8 first_tile columns into the supernode */
    sl_int base;       /* where that column stands in x */
    sl_int width;      /* columns of the supernode */
    sl_int below;      /* rows below them; their places in x come with the sweep, step after step */
    sl_int first_tile; /* tiles and columns before it are not needed */
    sl_int up;         /* the step of the parent supernode, -1 at a root */
} sli_step;

/* Columns of x that a step owns. */
SLI_INLINE sl_int sli_step_columns(const sli_step *s) {
    return s->width - SLI_TILE * s->first_tile;
}

/* Right-hand sides are interleaved: row i of x is x[i lanes] .. x[i lanes + lanes - 1], lanes = 1,
 * 2, 4 or 8. */
enum { SLI_LANES_1, SLI_LANES_2, SLI_LANES_4, SLI_LANES_8, SLI_LANES_COUNT };

/* x := L^-1 x over the steps, ascending. rows: places of the rows below, in step order.
 * scratch: sli_scratch_size doubles for the tallest step, 64-byte aligned. */
typedef void (*sli_forward_kernel)(sl_int count, const sli_step *steps, const sl_int *rows,
                                   const double *L, double *x, double *scratch);

/* x := L'^-1 D^-1 x over the steps, descending. rows_end: one past the last place of the last step.
 */
typedef void (*sli_backward_kernel)(sl_int count, const sli_step *steps, const sl_int *rows_end,
                                    const double *L, const double *D, double *x, double *scratch);

/* Row q of a panel, up-looking: on entry the panel holds A there and x minus the updates so far;
 * turns the row into L, passes its updates on to the rows above q in x, clears x on the supernode's
 * columns. D: the supernode's pivots. *pivot loses the row's share l' D l of the pivot; *magnitude
 * gains its absolute value. */
typedef void (*sli_row_kernel)(double *panel, sl_int width, sl_int q, const sl_int *rows,
                               const double *D, double *x_super, double *x, double *scratch,
                               double *pivot, double *magnitude);

/* Doubles of scratch that a step of some height (width + below) and width needs: the rows in one or
 * two lanes, and for those 8 partial sums of every column; more lanes work upon x itself, and keep
 * only the rows of one tile. */
SLI_INLINE size_t sli_scratch_size(sl_int height, sl_int width, sl_int lanes) {
    const size_t tile = SLI_TILE;
    return lanes > 2 ? tile * (size_t)lanes
                     : tile * ((size_t)sli_tiles(height) * (size_t)lanes + (size_t)width);
}

/* The rows that a lanes kernel keeps in registers at once, 4 or 8: op(0, k) op(1, k) .., and halves
 * from the last down. */
#define SLI_EACH4(op, k) op(0, k) op(1, k) op(2, k) op(3, k)
#define SLI_EACH8(op, k) SLI_EACH4(op, k) op(4, k) op(5, k) op(6, k) op(7, k)
#define SLI_EACH4_AGAIN(op, k) op(0, k) op(1, k) op(2, k) op(3, k)
#define SLI_EACH8_AGAIN(op, k) SLI_EACH4_AGAIN(op, k) op(4, k) op(5, k) op(6, k) op(7, k)
#define SLI_HIGH4(op, k) op(3, k) op(2, k)
#define SLI_HIGH8(op, k) op(7, k) op(6, k) op(5, k) op(4, k)
#define SLI_LOW4(op, k) op(1, k) op(0, k)
#define SLI_LOW8(op, k) op(3, k) op(2, k) op(1, k) op(0, k)

/* Calls one of 8 copies of a body that is compiled for a constant number of columns, w = 1 .. 8. */
#define SLI_CASE(k, call)                                                                          \
    case k:                                                                                        \
        call(k);                                                                                   \
        break;
#define SLI_CASES(call)                                                                            \
    switch (w) {                                                                                   \
        SLI_CASE(1, call)                                                                          \
        SLI_CASE(2, call)                                                                          \
        SLI_CASE(3, call)                                                                          \
        SLI_CASE(4, call)                                                                          \
        SLI_CASE(5, call)                                                                          \
        SLI_CASE(6, call)                                                                          \
        SLI_CASE(7, call)                                                                          \
    default:                                                                                       \
        call(8);                                                                                   \
    }

/* Fronts. The front of a supernode of w columns and u rows below is its panel and its update
 * matrix: the lower triangle, by tiles as in a panel, over the same row tiles from tile w/8 on, so
 * that the rows below keep their lanes. What its first w % 8 rows and columns and the part above the
 * diagonal hold means nothing. */

/* Where row tile t of a triangle starts, in doubles. */
SLI_INLINE sl_off sli_triangle_offset(sl_int t) {
    return 32 * (sl_off)t * (t + 1);
}

/* Row tiles of the update matrix of w columns and u rows below. */
SLI_INLINE sl_int sli_update_tiles(sl_int w, sl_int u) {
    return u == 0 ? 0 : sli_tiles(w % SLI_TILE + u);
}

/* Column tiles that are updated together, and columns they are updated by at a time: what a row tile
 * needs of a chunk is 16 KB, what the group needs is 128 KB. */
#define SLI_GROUP 8
#define SLI_CHUNK 256

/* Doubles of scratch for fronts of some width. */
SLI_INLINE sl_int sli_front_scratch(sl_int width) {
    return SLI_GROUP * SLI_TILE * sli_min(width, SLI_CHUNK);
}

/* Doubles of a front's inverse. */
#define SLI_FRONT_INVERSE (2 * SLI_GROUP * SLI_TILE)

/* What becomes of a pivot that is null, or of the wrong sign. Its arrays go by the column of L. */
typedef struct sli_pivot_rule {
    double null_tolerance;
    int replaces;          /* anything at all; else null pivots are the caller's to find */
    double regularization; /* 0: a null pivot becomes SLI_NULL_PIVOT */
    signed char *signs;    /* n: 1, -1, or 0 where either will do; NULL: all 1 */
    double *shifts;        /* n: what regularization added to each pivot; NULL: there is none */
} sli_pivot_rule;

typedef struct sli_front {
    double *panel;
    sl_int width, below;
    double *update;
    double *D;         /* width pivots */
    double *magnitude; /* 8 a tile: what each diagonal entry was made of, in absolute value */
    double *inverse;   /* 16 a column tile: 1/d, or 0 first where they are out of range; -sign d */
    const sli_pivot_rule *rule;
    sl_int column; /* the first of the supernode */
} sli_front;

/* Stands for a null pivot that is skipped: so large that what is divided by it is nothing, and 0 times
 * it is still 0. */
#define SLI_NULL_PIVOT DBL_MAX

/* Is a pivot null against the magnitude of what it was made of? Terms that overflow in magnitude and
 * not in sum tell nothing about what was lost. */
SLI_INLINE int sli_is_null(double pivot, double magnitude, double tolerance) {
    const double size = fabs(pivot);
    return size == 0.0 || (sli_is_finite(magnitude) && size <= tolerance * magnitude);
}

/* The pivot of column k by a rule that replaces. A regularized one has the size of what it was made of, times a
 * factor: a scaling of A changes nothing. One whose wrong sign is no rounding error is only turned: made small
 * it would let L grow beyond all bounds. Never inlined: it would cost definite matrices up to 8 percent. */
SLI_APART static double sli_pivot_ruled(const sli_pivot_rule *rule, sl_int k, double d,
                                        double magnitude) {
    const int is_null = sli_is_null(d, magnitude, rule->null_tolerance);
    int sign = rule->signs == NULL ? 1 : rule->signs[k];
    double least;
    if (rule->regularization == 0.0) {
        return is_null ? SLI_NULL_PIVOT : d;
    }
    rule->shifts[k] = 0.0;
    if (!is_null && !(d * sign < 0.0)) {
        return d;
    }
    sign = sign != 0 ? sign : d < 0.0 ? -1 : 1;
    least = rule->regularization * (magnitude > 0.0 ? magnitude : 1.0);
    least = sign * (fabs(d) > least ? fabs(d) : least);
    rule->shifts[k] = least - d;
    return least;
}

/* The steps of a front, group after group of column tiles c0 .. c0 + SLI_GROUP - 1, then the rest. On
 * entry panel and update hold A and what the children hand over, magnitude their absolute values. At
 * the end the panel holds L, D the pivots, update has lost L D L'; magnitude is that of the pivot in
 * the rows of the panel and has gained |L D L'| in the others. Every row tile goes its own way, so
 * that row tiles may be shared out. Null pivots are the caller's to find. */

/* A group's row tiles of pivots. */
typedef void (*sli_pivots_kernel)(const sli_front *f, sl_int c0, double *scratch);

/* A group's row tiles t0 .. t1-1, all below its pivots. */
typedef void (*sli_rows_kernel)(const sli_front *f, sl_int c0, sl_int t0, sl_int t1,
                                double *scratch);

/* Row tiles t0 .. t1-1 and column tiles c0 .. c1-1 of the triangle that starts at tile c0, all in or
 * below the last tile of pivots: of the update matrix, or of a part of it. */
typedef void (*sli_update_kernel)(const sli_front *f, sl_int c0, sl_int c1, sl_int t0, sl_int t1,
                                  double *scratch);

/* Adds rows first .. last-1 of a descendant's update matrix, columns up to the row or to columns-1, to
 * a front; the first `skipped` rows and columns of the matrix mean nothing, and row 0 comes after
 * them. places: the local row in the front of each row, ascending. No two calls for one front may run
 * at once on rows of one tile. */
typedef void (*sli_assemble_kernel)(const sli_front *f, const double *from, sl_int skipped,
                                    const sl_int *places, sl_int columns, sl_int first,
                                    sl_int last);

/* sums(i, j) -= y(k, i) z(k, j) over `count` rows of 8 lanes each; sums is 8 x 8 by rows. All 64-byte
 * aligned. */
typedef void (*sli_products_kernel)(sl_int count, const double *y, const double *z, double *sums);

/* Fronts of the inverse Z of P A P'. That of a supernode holds Z of its columns and the rows below, h in
 * all, both triangles: row tiles [tile][h][8], numbered as in the panel. */
typedef struct sli_dual {
    const double *panel; /* L and .. */
    const double *D;     /* .. its pivots */
    double *front;
    sl_int width, below;
    sl_int first; /* groups of columns before this one are left out */
} sli_dual;

/* Where row tile t of a front of the inverse of h rows starts, in doubles. */
SLI_INLINE ptrdiff_t sli_square_offset(sl_int h, sl_int t) {
    return (ptrdiff_t)SLI_TILE * h * t;
}

/* Column tiles, and columns, that are completed together: a group; doubles of a row tile of their L'^-1. */
#define SLI_DUAL_GROUP 16
#define SLI_DUAL_COLUMNS (SLI_DUAL_GROUP * SLI_TILE)
#define SLI_DUAL_ROW (SLI_DUAL_COLUMNS * SLI_TILE)

/* The first column of the last group, columns of the group that starts at j0. */
SLI_INLINE sl_int sli_dual_last(const sli_dual *f) {
    return (f->width - 1) / SLI_DUAL_COLUMNS * SLI_DUAL_COLUMNS;
}
SLI_INLINE sl_int sli_dual_columns(const sli_dual *f, sl_int j0) {
    return sli_min(SLI_DUAL_COLUMNS, f->width - j0);
}

/* Scratch of a group: N and P, SLI_DUAL_GROUP rows each, then W: where it starts, doubles from a column tile to the
 * next, and doubles of all for supernodes of some height and width. */
SLI_INLINE double *sli_dual_weights(double *scratch) {
    return scratch + 2 * SLI_DUAL_GROUP * SLI_DUAL_ROW;
}
SLI_INLINE ptrdiff_t sli_dual_stride(const sli_dual *f, sl_int j0) {
    const sl_int above = (j0 + sli_dual_columns(f, j0)) / SLI_TILE;
    return SLI_TILE * SLI_TILE * (ptrdiff_t)(sli_tiles(f->width + f->below) - above);
}
SLI_INLINE sl_off sli_dual_scratch(sl_int height, sl_int width) {
    return 2 * SLI_DUAL_GROUP * SLI_DUAL_ROW + (sl_off)SLI_TILE * SLI_TILE *
                                                   sli_min(sli_tiles(width), SLI_DUAL_GROUP) *
                                                   sli_tiles(height);
}

/* Z of the rows below a supernode, row tiles t0 .. t1-1, out of the front of its parent of that height; places: their
 * rows there, ascending. */
typedef void (*sli_gather_kernel)(const sli_dual *f, const double *from, sl_int height,
                                  const sl_int *places, sl_int t0, sl_int t1);

/* The rest of the front, by Takahashi's equations, group after group of columns J, the last one first, with S all rows
 * after it. With N = -L_JJ'^-1, P = -N D^-1 and W = L_SJ L_JJ^-1: Z_SJ = -Z_SS W, Z_JJ = P N' - W' Z_SJ. */
typedef void (*sli_takahashi_kernel)(const sli_dual *f, double *scratch);

/* The parts of a group, one after the other, each of which may be shared out by row tiles. */
typedef enum sli_dual_part {
    SLI_DUAL_INVERSE = 0, /* N and P: tiles of the group */
    SLI_DUAL_WEIGHTS,     /* W: tiles of S */
    SLI_DUAL_PRODUCT,     /* Z_SJ: tiles of S */
    SLI_DUAL_MIRROR,      /* Z_JS: tiles of S */
    SLI_DUAL_SQUARE       /* Z_JJ: tiles of the group */
} sli_dual_part;
#define SLI_DUAL_PARTS 5

typedef struct sli_span {
    sl_int first, last;
} sli_span;

/* The row tiles of a part: first .. last-1. */
SLI_INLINE sli_span sli_dual_span(const sli_dual *f, sl_int j0, sli_dual_part part) {
    const sl_int m = sli_dual_columns(f, j0), h = f->width + f->below;
    sli_span span = {0, sli_tiles(m)};
    if (part != SLI_DUAL_INVERSE && part != SLI_DUAL_SQUARE) {
        span.last = j0 + m < h ? sli_tiles(h) : 0;
        span.first = sli_min((j0 + m) / SLI_TILE, span.last);
    }
    return span;
}

/* Row tiles t0 .. t1-1 of one part. */
typedef void (*sli_dual_kernel)(const sli_dual *f, sl_int j0, sli_dual_part part, sl_int t0,
                                sl_int t1, double *scratch);

/* Numbers that stand side by side, spread over the lanes of a tile one by one: where no instruction
 * does it. */
#define SLI_SPREAD_PLAIN(mask, lanes, count)                                                       \
    const sl_int *lanes_ = (lanes), count_ = (count);                                              \
    (void)(mask);
#define SLI_SPREAD_ADD_PLAIN(to, from)                                                             \
    {                                                                                              \
        double *to_ = (to);                                                                        \
        const double *from_ = (from);                                                              \
        sl_int i_;                                                                                 \
        for (i_ = 0; i_ < count_; i_++) {                                                          \
            to_[lanes_[i_]] += from_[i_];                                                          \
        }                                                                                          \
    }

typedef struct sli_kernels {
    sl_isa isa;
    sli_forward_kernel forward[SLI_LANES_COUNT];
    sli_backward_kernel backward[SLI_LANES_COUNT];
    sli_row_kernel row;
    sli_pivots_kernel pivots;
    sli_rows_kernel rows;
    sli_update_kernel update;
    sli_assemble_kernel assemble;
    sli_products_kernel products;
    sli_gather_kernel gather;
    sli_dual_kernel dual;
    sli_takahashi_kernel takahashi;
} sli_kernels;

#endif

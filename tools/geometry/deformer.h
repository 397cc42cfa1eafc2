/* deformer.h: deforms a mesh by handles, which are pins on one factor */
#ifndef TOOLS_DEFORMER_H
#define TOOLS_DEFORMER_H

#include "arap_surface.h"

typedef enum deform_method {
    DEFORM_ARAP = 0,  /* as rigid as possible: L y = b(R) */
    DEFORM_BIHARMONIC /* displacements u with the least energy u' L M^-1 L u */
} deform_method;

/* The matrix K, L or L M^-1 L, is singular by a constant on each component. It is factored once,
 * with SL_PIVOTS_SKIP_NULL. Vertices that are held are pins (sl_constraints), which change nothing
 * in the factor; hundreds are fixed by sl_fixed instead. A component without held vertices keeps
 * its mean position (ARAP) or is at rest.
 *
 * Unknowns are displacements: K u = b(R) - K x with the positions x at rest; b(R) - K x = 0 for
 * DEFORM_BIHARMONIC, whose solutions are those of the system that is not squared
 * (deformer_mixed.h). A step of the deformation is
 *
 *  deformer_rotations    ARAP only: the best rotations for the present positions
 *  deformer_solve        the best positions for these rotations
 */
typedef struct deformer {
    const mesh *m; /* at rest; borrowed */
    deform_method method;
    sl_int n;
    sl_matrix *K; /* lower triangle */
    sl_symbolic *S;
    sl_factor *F;
    sl_constraints *pins;
    sl_fixed *fixed; /* of deformer_solve_anew; NULL: not made for these handles yet */
    sl_work *W;
    sl_stats stats; /* of analysis and factorization */
    /* DEFORM_BIHARMONIC, see deformer_mixed.h */
    sl_matrix *L;                 /* lower triangle */
    double *mass;                 /* n */
    struct deformer_mixed *mixed; /* NULL: not made for these handles */
    bool squared;                 /* K has a factor and, as far as is known, enough digits */
    bool accurate;                /* with these handles, corrections are below 1e-6 */
    arap_surface arap;            /* DEFORM_ARAP */
    double *rest;                 /* n x 3, column-major, as all below */
    double *Y;                    /* n x 3: present positions */
    double *balance;              /* n x 3: K x */
    double *B;                    /* n x 3: right-hand side of the last solve */
    double *U;                    /* n x 3: scratch */
    double *G;                    /* n x 3: displacements of the pins, leading dimension n */
    sl_int *held;                 /* n_pins vertices that are pins, in their order */
    sl_int n_pins;
    double *target; /* 3 n: where each held vertex is held */
    unsigned char *is_held;
    sl_int n_components;
    sl_int *component; /* n */
    sl_int *n_held;    /* n_components: held vertices */
    double *mean;      /* 3 n_components: scratch */
    sl_int *sizes;     /* n_components */
    sl_plan *near;     /* of deformer_watch */
    sl_int *watched;   /* n_watched vertices */
    sl_int n_watched;
    double diameter; /* diagonal of the bounding box */
    bool anew;       /* pins are not used: each set of handles has a factor of the other rows */
    bool refused;    /* because they were refused, with stats.error.row */
} deformer;

/** Prepares a deformation: assembles, orders, analyzes and factors K.
 *
 *  out  [out]  release with deformer_free; all zero on error.
 *  m    [in]   borrowed, must outlive out.
 *  Returns  SL_OK; SL_ERR_MEMORY; as sl_symbolic_create and, for DEFORM_ARAP, sl_factor_create.
 *  Example  tests/tools/test_deformer.c
 */
sl_status deformer_create(deformer *out, const mesh *m, deform_method method);

/** Releases everything and sets d to all zero. */
void deformer_free(deformer *d);

/** Holds vertices where they are, all or none. Those that are held already stay so.
 *
 *  Returns  SL_OK; as sl_constraints_add, with the vertex in stats.error.row; where that finds a
 *           null pivot, pins are no longer used.
 *  Cost     that of sl_constraints_add; beyond 200 pins the next solve makes a factor of the other
 *           rows.
 */
sl_status deformer_hold(deformer *d, const sl_int *vertices, sl_int count);

/** Moves a held vertex to a position, which the next solve reaches. */
void deformer_move(deformer *d, sl_int vertex, const double position[3]);

/** Releases the held ones of some vertices, all or none. Returns as sl_constraints_release. */
sl_status deformer_release(deformer *d, const sl_int *vertices, sl_int count);

/** Computes the best rotations for the present positions; returns the energy. 0 and no effect for
 *  DEFORM_BIHARMONIC. */
double deformer_rotations(deformer *d);

/** Computes all positions for the present rotations. Returns as sl_constraints_solve;
 *  SL_ERR_NOT_FINITE: positions beyond the range of numbers, and d->Y is as before. */
sl_status deformer_solve(deformer *d);

/** X = K^-1 d->B with displacement 0 of held vertices; X (n x 3, column-major) has the mean 0 on
 *  components without any. Returns as sl_constraints_solve. */
sl_status deformer_solve_step(deformer *d, double *X);

/** Prepares local solves at some vertices; DEFORM_BIHARMONIC only, where the right-hand side is 0.
 *
 *  vertices  [in]  count different ones; copied.
 *  Returns  as sl_plan_create; SL_ERR_UNSUPPORTED: the other method.
 */
sl_status deformer_watch(deformer *d, const sl_int *vertices, sl_int count);

/** The positions of the watched vertices alone, by a local solve: Y is n_watched x 3, column-major.
 *  Returns as sl_constraints_solve. */
sl_status deformer_solve_watched(deformer *d, double *Y);

/** Repeats the last deformer_solve with a new factor: analyzes and factors K without the rows that
 *  are held.
 *
 *  difference  [out]  largest distance between the positions of both, relative to the diagonal of
 *                     the bounding box at rest.
 *  seconds     [out]  of order, analysis, factorization and solve.
 *  Returns  SL_OK; SL_ERR_MEMORY; as sl_symbolic_create, sl_factor_create and sl_factor_solve.
 *           Biharmonic ones are corrected, or a new factor of the mixed system takes their place.
 */
sl_status deformer_compare(deformer *d, double *difference, double *seconds);

#endif

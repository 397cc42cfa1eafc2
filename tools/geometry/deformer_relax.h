/* deformer_relax.h: as-rigid-as-possible positions to convergence, by few solves with the factor */
#ifndef TOOLS_DEFORMER_RELAX_H
#define TOOLS_DEFORMER_RELAX_H

#include "deformer.h"

/** How deformer_relax has ended. */
typedef struct deformer_rest {
    int solves;
    double energy; /* ARAP: of the last positions */
    double moved;  /* largest displacement by the last step, relative to the diagonal */
    double lately; /* the same by the second half of the solves; 0 if it has converged */
    bool converged;
} deformer_rest;

/** Lowers the energy of DEFORM_ARAP until a step moves no vertex farther than `tolerance`
 *  diagonals of the bounding box and lowers the energy by at most that part, twice in a row.
 *
 *  Steps are Newton's, each with a factor of the Hessian of its own, until they move no vertex far;
 *  then those of the limited-memory quasi-Newton method (L-BFGS) with the last factor, which is
 *  renewed now and then. They are shortened until the energy falls, or lengthened while it does.
 *
 *  d      [in,out]  positions d->Y; first those of held vertices move to their targets.
 *  limit  [in]      the largest number of solves, 1 or more.
 *  how    [out]     of the end.
 *  Returns  SL_OK, also if it has not converged; SL_ERR_MEMORY; as deformer_solve.
 *  Source   Liu, Bouaziz, Kavan: Quasi-Newton methods for real-time simulation of hyperelastic
 *           materials, 2017.
 *  Example  tests/tools/test_deformer.c
 */
sl_status deformer_relax(deformer *d, double tolerance, int limit, deformer_rest *how);

#endif

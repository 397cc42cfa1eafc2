/* deformer_anew.h: the displacements of a deformation where pins are refused or many */
#ifndef TOOLS_DEFORMER_ANEW_H
#define TOOLS_DEFORMER_ANEW_H

#include "deformer.h"

/** Computes d->U from d->B and the held vertices by a factor of K without their rows, which is kept
 *  in d->fixed. Vertices of components without held ones stay where they are (ARAP) or are at rest;
 *  those in rows of null pivots are at rest. With at_rest the held vertices, and those of
 *  components without any, have displacement 0.
 *
 *  Returns  SL_OK; SL_ERR_MEMORY; as sl_fixed_create and sl_fixed_solve.
 *  Cost     a factorization after handles have changed.
 */
sl_status deformer_solve_anew(deformer *d, bool at_rest);

#endif

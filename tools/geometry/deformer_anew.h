/* deformer_anew.h: the displacements of a deformation where pins are refused */
#ifndef TOOLS_DEFORMER_ANEW_H
#define TOOLS_DEFORMER_ANEW_H

#include "deformer.h"

/** Computes d->U from d->B and the held vertices by a new factor of K without their rows. Vertices
 *  of components without held ones stay where they are (ARAP) or are at rest; those in rows of null
 *  pivots are at rest.
 *
 *  Returns  SL_OK; SL_ERR_MEMORY; as sl_symbolic_create, sl_factor_create and sl_factor_solve.
 *  Cost     an analysis and a factorization.
 */
sl_status deformer_solve_anew(deformer *d);

#endif

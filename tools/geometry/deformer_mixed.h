/* deformer_mixed.h: biharmonic displacements by the system that does not square the Laplacian */
#ifndef TOOLS_DEFORMER_MIXED_H
#define TOOLS_DEFORMER_MIXED_H

#include "deformer.h"

/* The displacements u with the least energy u' L M^-1 L u solve, with w = M^-1 L u,
 *
 *     -M w + L u = 0
 *      L w       = 0 in the rows of vertices that are not held.
 *
 * Eliminating w gives K = L M^-1 L, whose condition is that of this system squared, and more where
 * masses differ: a face as thin as 1e-7 leaves no digit. Solutions with K are therefore corrected
 * until they solve the mixed system; where that leads nowhere, it is factored itself, with 2x2
 * pivots. */
struct deformer_mixed; /* a factor for one set of handles */

/** X = K^-1 d->B, with 0 at held vertices and components without any. */
typedef sl_status deformer_step(void *context, deformer *d, double *X);

/** Corrects the displacements d->U by solves with K.
 *
 *  step, context  [in]   the solves.
 *  first          [out]  the first correction, as a part of the largest displacement.
 *  good           [out]  whether the last correction was below 1e-9 of it. If not, K has too few
 *                        digits.
 *  Returns  SL_OK; as `step`, where refusals are not errors: then good is false.
 *  Cost     a solve or two where K is good, at most 10.
 */
sl_status deformer_correct(deformer *d, deformer_step *step, void *context, double *first,
                           bool *good);

/** Computes d->U by a factor of the mixed system for these handles, which is kept in d->mixed until
 *  they change, or, if `anew`, made and not kept.
 *
 *  Returns  SL_OK; SL_ERR_MEMORY; as sl_symbolic_create_pivoted, sl_factor_create and
 *           sl_factor_refine.
 */
sl_status deformer_solve_mixed(deformer *d, bool anew);

/** Releases a factor; NULL is allowed. */
void deformer_mixed_free(struct deformer_mixed *x);

/** Whether a status says that the digits do not suffice. */
bool deformer_is_refusal(sl_status status);

#endif

/* heat_factors.h: the two factors of the heat method, of a mesh or of files of sparse-local save */
#ifndef TOOLS_HEAT_FACTORS_H
#define TOOLS_HEAT_FACTORS_H

#include "app.h"
#include "tools/geometry/heat_distance.h"

/* Range of times tried, in units of the squared mean edge length. From several sources fronts meet,
 * where a large time does harm. */
enum { HEAT_FACTORS_FIRST = 4, HEAT_FACTORS_SEVERAL = 1, HEAT_FACTORS_LAST = 256 };

/** Factors with the Laplacian that an option chooses. Like all functions of this folder, those
 *  below end the program with a message on errors.
 *
 *  s          [out]  release with heat_solver_free.
 *  surface    [out]  what s borrows, or all zero; release with intrinsic_free, after s.
 *  m          [in]   borrowed, must outlive both.
 *  laplacian  [in]   the value of --laplacian (laplacian_choice.h).
 *  t          [in]   as in heat_solver_create.
 *  opt        [in]   allocator of analysis and factors; may be NULL.
 */
void heat_factors_create(heat_solver *s, intrinsic *surface, const mesh *m, const char *laplacian,
                         double t, const sl_options *opt);

/** Doubles the time, from `first` squared mean edge lengths, until no heat of the
 *  sources is negative in the ball of `heat`, and prints a line if that took a larger time. Each
 *  step is a numerical refactorization with the same analysis.
 *
 *  s  [in,out]  with the time first squared_edge.
 */
void heat_factors_find_time(heat_solver *s, double first, double squared_edge,
                            const sl_int *sources, sl_int count, const heat_options *heat);

/** The factors of two files that heat_factors_create's were saved in: mapped, and checked against
 *  the mesh.
 *
 *  heat, poisson  [in]  names of the files.
 *  Others as in heat_factors_create.
 */
void heat_factors_open(heat_solver *s, intrinsic *surface, const mesh *m, const char *laplacian,
                       const char *heat, const char *poisson);

#endif

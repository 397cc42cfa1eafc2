/* solve_accuracy.h: warns where a mesh leaves few digits to the solutions of its systems */
#ifndef TOOLS_SOLVE_ACCURACY_H
#define TOOLS_SOLVE_ACCURACY_H

#include "app.h"

/** The faces of a triangulation whose weights rounding can spoil. */
typedef struct accuracy_faces {
    double angle;  /* the smallest angle in degrees, of the faces with weights; 180 without any */
    sl_int needle; /* faces with an angle below ACCURACY_ANGLE */
    sl_int flat;   /* faces without weights (laplacian.h) */
} accuracy_faces;

/** In degrees. Below it, a coordinate of a file in single precision moves a weight by a percent. */
#define ACCURACY_ANGLE 1e-3

/** Measures the faces of m, or those with these lengths (intrinsic.h) unless lengths is NULL. */
accuracy_faces accuracy_of_faces(const mesh *m, const double *lengths);

/** Prints a warning with the numbers if rounding can cost ACCURACY_DIGITS or more of the 16 digits
 *  of a solution, or if faces have angles below ACCURACY_ANGLE. Sound meshes get none.
 *
 *  faces  [in]  may be NULL: not known.
 *  F      [in]  the factor of the system; may be NULL if A is given: it is made where it is needed.
 *  A      [in]  the system, its lower triangle; NULL: only the range of the pivots is known.
 *  Cost   O(entries of A) where the row sums bound the condition; else sl_factor_rcond.
 */
void accuracy_warn(const accuracy_faces *faces, const sl_factor *F, const sl_csc *A);

enum { ACCURACY_DIGITS = 10 };

/** The same for Poisson problems on a surface, whose matrix is singular: M + t L is judged, with
 *  the area of the surface as t, so that all but the constants depend on L alone.
 *
 *  lengths, share  [in]  as in laplacian_system_of.
 */
void accuracy_warn_poisson(const mesh *m, const double *lengths, double share);

#endif

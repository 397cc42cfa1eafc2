/* rotation_fit.h: the rotation nearest to a 3 x 3 matrix */
#ifndef TOOLS_ROTATION_FIT_H
#define TOOLS_ROTATION_FIT_H

/** The rotation R (det 1) with the largest trace of R' S; R and S are column-major.
 *
 *  With S = sum of w y x' it minimizes the sum of w |y - R x|^2. If several rotations are equally
 *  good, as for S of rank 1, it is one of them; for S = 0 or not finite the identity.
 *
 *  R  [out]  may be S itself.
 *  Returns  the trace of R' S.
 *  Source   Horn: Closed-form solution of absolute orientation using unit quaternions, 1987: the
 *           quaternion of R is the eigenvector of the largest eigenvalue of a 4 x 4 matrix.
 *  Example  tests/tools/test_arap_surface.c
 */
double rotation_fit(double R[9], const double S[9]);

#endif

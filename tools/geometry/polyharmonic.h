/* polyharmonic.h: harmonic, biharmonic and triharmonic systems M + t (L M^-1)^(k-1) L of a mesh */
#ifndef TOOLS_POLYHARMONIC_H
#define TOOLS_POLYHARMONIC_H

#include <stdbool.h>

#include "tools/mesh/mesh.h"

enum { POLYHARMONIC_MAX_ORDER = 3 };

/** Lower triangle of M + t (L M^-1)^(k-1) L, with the cotangent Laplacian L and the lumped mass M
 *  of laplacian.h.
 *
 *  The matrix is positive definite for t >= 0, up to rounding. k = 1 is laplacian_system. k = 2
 *  couples vertices at two edges, k = 3 at three: about 7, 19 and 37 entries per row of the full
 *  matrix. The product is symmetric up to rounding and is symmetrized.
 *
 *  With t = s^(2k) all three orders smooth over the length s. The condition number is then about
 *  (8 s^2/h^2)^k for edges of length h: s/h = 100 with k = 3 uses 14 to 15 of a double's 16 digits.
 *
 *  out  [out]  n_vertices x n_vertices, release with sl_matrix_free; NULL on error.
 *  k    [in]   1..POLYHARMONIC_MAX_ORDER.
 *  t    [in]   0..1e200.
 *  Returns  true; false: k or t out of range, a face index out of range, too many entries, out of
 *           memory.
 *  Example  tests/tools/test_polyharmonic.c
 */
bool polyharmonic_system(sl_matrix **out, const mesh *m, int k, double t);

/** Lower triangle of (L M^-1)^(k-1) L alone. It is semi-definite; its null vectors are constant on
 *  each component. Arguments and errors as above. */
bool polyharmonic_energy(sl_matrix **out, const mesh *m, int k);

#endif

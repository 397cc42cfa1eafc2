/* harmonic.h: harmonic, biharmonic and triharmonic systems M + t (L M^-1)^(k-1) L of a triangle mesh */
#ifndef TOOLS_HARMONIC_H
#define TOOLS_HARMONIC_H

#include <stdbool.h>

#include "mesh.h"

enum { HARMONIC_MOST = 3 };

/** Lower triangle of M + t (L M^-1)^(k-1) L: L the cotangent Laplacian, M the lumped mass, both as in laplacian.h.
 *
 *  Definite for t >= 0 but for rounding. k = 1 is laplacian_system; k = 2 couples vertices two edges apart, k = 3
 *  three: about 7, 19 and 37 entries a row. The product comes out symmetric but for rounding and is symmetrized.
 *
 *  With t = s^(2k) all three smooth over the length s; the condition is then about (8 s^2/h^2)^k, h the length of an
 *  edge: s/h = 100 at k = 3 uses up 14 to 15 digits of a double's 16.
 *
 *  out  [out]  n_vertices x n_vertices, release with sl_matrix_free; NULL on error.
 *  k    [in]   1..HARMONIC_MOST.
 *  t    [in]   0 or more, finite.
 *  Returns  true; false: k or t out of range, a face index out of range, too many entries, out of memory.
 *  Example  tests/test_harmonic.c
 */
bool harmonic_system(sl_matrix **out, const mesh *m, int k, double t);

#endif

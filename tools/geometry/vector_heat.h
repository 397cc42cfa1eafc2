/* vector_heat.h: parallel transport and the logarithmic map by diffusion, on the mesh or a ball */
#ifndef TOOLS_VECTOR_HEAT_H
#define TOOLS_VECTOR_HEAT_H

#include "connection.h"
#include "tools/mesh/incidence.h"

/* Tangent vectors are complex numbers (connection.h). With the lumped mass M, the cotangent
 * Laplacian L, the connection Laplacian C and a short time t, the vector heat method [SSC19] solves
 *
 *  (M + t C) y = given vectors       directions: y is the vectors, transported and diffused
 *  (M + t L) u = their lengths       lengths: u / h is that of the nearest source
 *  (M + t L) h = 1 at the sources
 *
 * The transported vector is y / |y| u / h.
 *
 * The logarithm of a vertex, the vector from the source to it along the surface, is found by the
 * same diffusion of points in place of vectors [SS25]. A point p in the tangent plane of i becomes
 * r p + e in that of j, where r turns as for vectors, and e is the vector of the edge from j to i.
 * The weight of points is h, and their weighted sum q solves
 *
 *  (M + t C) q = t sum over edges  weight e h_i
 *
 * The source lies at q / h in the tangent plane of each vertex. Transport to the source gives the
 * logarithm. On a plane all of this is exact, for any t, if the heat is above 0.
 *
 * Within a radius all solves are local. Those for y, u and h have the bits of the solves on the
 * whole mesh. For q, h is needed around the ball as well: up to VECTOR_HEAT_MARGIN sqrt(t), beyond
 * which it has no influence above rounding.
 *
 *  [SSC19]  Sharp, Soliman, Crane: The vector heat method, ACM TOG 38(3), 2019.
 *  [SS25]   Soliman, Sharp: The affine heat method, Computer Graphics Forum 44(5), 2025.
 */
typedef struct vector_heat {
    const mesh *m; /* borrowed */
    double t;
    connection frames;
    incidence inc;
    sl_symbolic *S, *complex_S;
    sl_factor *heat;    /* of M + t L */
    sl_factor *vectors; /* of M + t C, 2 n_vertices real rows */
    sl_work *work;
    sl_stats stats; /* of the complex analysis and factor */
} vector_heat;

#define VECTOR_HEAT_MARGIN 20.0

/** Analyzes and factors both systems.
 *
 *  out  [out]  release with vector_heat_free; all zero on error.
 *  m    [in]   borrowed, must outlive out.
 *  t    [in]   above 0, at most 1e200, in squared units of length; usually the squared mean edge
 *              length.
 *  Returns  SL_OK; SL_ERR_ARGUMENT: t or a face index is out of range; SL_ERR_TOO_LARGE;
 *           SL_ERR_MEMORY; as sl_factor_create.
 *  Example  tools/cli/command_vectors.c
 */
sl_status vector_heat_create(vector_heat *out, const mesh *m, double t);

/** Releases everything and sets s to all zero. */
void vector_heat_free(vector_heat *s);

/** Tangent vectors at some vertices, nearest to the sources first. */
typedef struct vector_field {
    sl_int n;
    sl_int *vertices; /* n */
    double *z;        /* 2 n: complex; NaN where no heat arrives */
    sl_int unreached; /* vertices whose heat is not above 0: t is too small, or faces are obtuse */
    sl_stats stats;   /* plan: what the solve for directions reads */
} vector_field;

/** Releases the arrays and sets f to all zero. */
void vector_field_free(vector_field *f);

/** Transports vectors from some vertices to all others within a distance: each vertex gets the
 *  vector of the nearest source, smoothly where two are almost equally near.
 *
 *  out      [out]  z in the tangent planes of the vertices; release with vector_field_free; all
 *                  zero on error.
 *  sources  [in]   count distinct vertices.
 *  vectors  [in]   2 count: complex.
 *  radius   [in]   along edges; 0: all vertices that edges join to a source.
 *  Returns  SL_OK; SL_ERR_ARGUMENT: no source, a source out of range or given twice, radius
 *           negative or NaN, a vector that is not finite; SL_ERR_MEMORY.
 *  Cost     with a radius O(ball + its paths in the elimination tree to the root).
 */
sl_status vector_heat_transport(vector_field *out, vector_heat *s, const sl_int *sources,
                                const double *vectors, sl_int count, double radius);

/** Computes the logarithmic map of a vertex.
 *
 *  out     [out]  z in the tangent plane of the source: the vector to each vertex.
 *  source, radius  [in]  as above.
 *  Returns, Cost  as vector_heat_transport.
 */
sl_status vector_heat_logarithm(vector_field *out, vector_heat *s, sl_int source, double radius);

#endif

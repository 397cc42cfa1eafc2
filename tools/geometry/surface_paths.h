/* surface_paths.h: short paths over the faces of a mesh, and what they say about distances */
#ifndef TOOLS_SURFACE_PATHS_H
#define TOOLS_SURFACE_PATHS_H

#include "tools/mesh/incidence.h"

/** Searches for the shortest paths from some vertices through the vertices and some evenly spaced
 *  points of each edge, straight across faces. Their lengths are upper bounds of the distances on
 *  the surface; the relative error falls with the square of the number of points. */
typedef struct surface_search surface_search;

/** Prepares searches.
 *
 *  out     [out]  release with surface_search_free; NULL on error.
 *  inc     [in]   the mesh; borrowed, must outlive out.
 *  points  [in]   of each edge, 0..15.
 *  Returns  true; false: out of memory, or too many points.
 *  Cost     O(faces), about 40 + 20 points bytes for each face.
 */
bool surface_search_create(surface_search **out, const incidence *inc, int points);

/** Finds the paths up to a length. Forgets those of the search before.
 *
 *  sources  [in]  count vertices.
 *  limit    [in]  longer paths are not followed; INFINITY: all.
 *  Returns  true; false: out of memory.
 *  Cost     O(k log k) for the k points found: about 1 s for 100 000 vertices and 3 points.
 *  Example  tests/tools/test_intrinsic.c
 */
bool surface_search_run(surface_search *s, const sl_int *sources, sl_int count, double limit);

/** Makes all points of some edges sources of the searches that follow, beside their sources. The
 *  origin of a path that starts between the ends of an edge is 0.
 *
 *  ends  [in]  count pairs of vertices.
 *  Returns  true; false: two vertices are not joined by an edge, out of memory.
 */
bool surface_search_set_curve(surface_search *s, const sl_int *ends, sl_int count);

/** The lengths of the last search by vertex of the mesh; INFINITY where no path leads. */
const double *surface_search_lengths(const surface_search *s);

/** The position in `sources` of the vertex where the path to each vertex starts; defined where the
 *  length is finite. */
const sl_int *surface_search_origins(const surface_search *s);

/** Straightens the paths of the last search to some vertices. Each becomes the shortest one within
 *  the strip of triangles that it crosses, which is unfolded (a funnel); where it bends at a vertex
 *  around whose other side it would be shorter, the strip goes there, as long as that helps.
 *
 *  vertices  [in]  count of them.
 *  Returns  lengths by vertex of the mesh, INFINITY at the others and where no path leads; valid
 *           until the next call. Each is that of a path, at most that of surface_search_lengths,
 *           and exact where the surface is flat. NULL: out of memory.
 *  Cost     O(triangles crossed) for each vertex, on the way to a nearer one that is straightened,
 *           and O(faces) at the first call: about 10 s for 100,000 vertices.
 *  Source   Lee, Preparata: Euclidean shortest paths in the presence of rectilinear barriers, 1984;
 *           Sharp, Crane: You can find geodesic paths in triangle meshes by just flipping edges,
 *           2020.
 *  Example  tests/tools/test_straight_paths.c
 */
const double *surface_search_straighten(surface_search *s, const sl_int *vertices, sl_int count);

/** Releases everything; NULL is allowed. */
void surface_search_free(surface_search *s);

/** What surface_paths_correct did with the distances that a path reaches. */
typedef struct surface_correction {
    sl_int kept, raised, lowered; /* how many stayed, or became the length of the path */
    double largest;               /* the largest change */
} surface_correction;

/** Compares distances with the lengths of straightened paths, which none can exceed. Those that do,
 *  or fall short of them by more than slack, become these lengths.
 *
 *  distance  [in,out]  n values of the vertices `vertices`; NaNs stay.
 *  straight  [in]      by vertex of the mesh; distances stay where it is infinite.
 *  slack     [in]      0 or more.
 */
surface_correction surface_paths_correct(double *distance, const sl_int *vertices, sl_int n,
                                         const double *straight, double slack);

#endif

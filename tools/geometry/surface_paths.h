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

/** The lengths of the last search by vertex of the mesh; INFINITY where no path leads. */
const double *surface_search_lengths(const surface_search *s);

/** The position in `sources` of the vertex where the path to each vertex starts; defined where the
 *  length is finite. */
const sl_int *surface_search_origins(const surface_search *s);

/** Distances where the surface is flat: those of vertices that a path can reach through vertices
 *  whose faces fill 360 degrees, or of the border of such a part. Where it crosses the edge of a
 *  face opposite to a vertex, the distance there follows from those at the ends of that edge as in
 *  the plane.
 *
 *  mixed  [in]  whether the distances at the ends of an edge may be those of different sources. If
 *               so, none is too large, else none is too small; they differ where fronts meet. Near
 *               the limit of the search both may be too large.
 *  Returns  by vertex of the mesh, INFINITY at the others, for the sources of the last search and
 *           within its limit; valid until the next search. NULL: out of memory.
 *  Cost     O(k log k) for the k vertices found, and O(faces) at the first call.
 *  Example  tests/tools/test_intrinsic.c
 */
const double *surface_search_unfold(surface_search *s, bool mixed);

/** Releases everything; NULL is allowed. */
void surface_search_free(surface_search *s);

/** What surface_paths_correct did. */
typedef struct surface_correction {
    sl_int raised, lowered; /* vertices whose distance changed */
    double largest;         /* the largest change */
    double mean_width;      /* estimated errors that remain: u1 - u3 + slack */
    double largest_width;
} surface_correction;

/** What is known of the distance at each vertex of a mesh. */
typedef struct surface_lengths {
    const double *one, *three;  /* of the shortest paths through 1 and 3 points of each edge */
    const double *flat, *mixed; /* surface_search_unfold, of one source an edge, or of two */
} surface_lengths;

/** Moves distances into the intervals that lengths of paths leave to them.
 *
 *  Errors of u3, through 3 points, and of u1, through 1, fall with the square of the number of
 *  points. Distances below u3 - slack - (u1 - u3) / 2 are raised to that, those above u3 are
 *  lowered to it. Where the surface is flat, distances are moved to within `slack` of what they are
 *  there.
 *
 *  distance  [in,out]  n values of the vertices `vertices`; NaNs stay.
 *  u         [in]      by vertex of the mesh; distances stay where u3 is infinite, and are
 *                      only lowered where u1 is.
 *  slack     [in]      0 or more.
 */
surface_correction surface_paths_correct(double *distance, const sl_int *vertices, sl_int n,
                                         const surface_lengths *u, double slack);

#endif

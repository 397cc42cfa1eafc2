/* surface_paths.h: short paths over the faces of a mesh, and what they say about distances */
#ifndef TOOLS_SURFACE_PATHS_H
#define TOOLS_SURFACE_PATHS_H

#include "tools/mesh/incidence.h"

/** Lengths of the shortest paths from some vertices through the vertices and `points` evenly spaced
 *  points of each edge, straight across faces. They are upper bounds of the distances on the
 *  surface; their relative error falls with the square of the number of points.
 *
 *  length   [out]  n_vertices; INFINITY where no path leads.
 *  inc      [in]   the mesh.
 *  sources  [in]   count vertices.
 *  points   [in]   0..15.
 *  Returns  true; false: out of memory, or too many points.
 *  Cost     O(k log k) for k = (points + 1) n_edges: about 1 s for 100 000 vertices and 3 points.
 *  Example  tests/tools/test_intrinsic.c
 */
bool surface_paths(double *length, const incidence *inc, const sl_int *sources, sl_int count,
                   int points);

/** What surface_paths_correct did. */
typedef struct surface_correction {
    sl_int raised, lowered; /* vertices whose distance changed */
    double largest;         /* the largest change */
    double mean_width;      /* estimated errors that remain: u1 - u3 + slack */
    double largest_width;
} surface_correction;

/** Moves distances into the intervals that two lengths of paths leave to them.
 *
 *  With u1 and u3, by fewer and more points, the error of u3 is at most about (u1 - u3) / 3,
 *  because errors fall with the square of the number of points. Distances below
 *  u3 - slack - (u1 - u3) / 2 are raised to that, those above u3 are lowered to it.
 *
 *  distance  [in,out]  n values of the vertices `vertices`; NaNs stay.
 *  u1, u3    [in]      by vertex of the mesh.
 *  slack     [in]      0 or more: what the distances may be shorter than u3 in any case.
 */
surface_correction surface_paths_correct(double *distance, const sl_int *vertices, sl_int n,
                                         const double *u1, const double *u3, double slack);

#endif

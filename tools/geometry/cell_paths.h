/* cell_paths.h: moves vertices of Voronoi cells to sites that paths over the faces show nearer */
#ifndef TOOLS_CELL_PATHS_H
#define TOOLS_CELL_PATHS_H

#include "surface_paths.h"

/** What cell_paths_correct found. */
typedef struct cell_correction {
    sl_int moved;    /* vertices given to another site */
    sl_int given;    /* vertices that had no site */
    double farther;  /* the largest excess of a distance over that to the nearest site, before; */
    double remains;  /* and after the moves */
    double mean_gap; /* of the vertices that paths give to another site and that were not moved */
    sl_int disputed; /* the number of these */
} cell_correction;

/** Compares cells with the sites whose paths are shortest. A vertex moves to the site of its
 *  shortest path if its own site is farther by more than slack and half of what the paths through 1
 *  and 3 points of an edge differ by.
 *
 *  c         [out]
 *  cell      [in,out]  n_vertices: position in sites; -1: none, which a radius leaves as it is.
 *  one, three [in,out] searches with 1 and 3 points.
 *  sites     [in]      count vertices.
 *  radius    [in]      paths are followed so far; 0: without a limit.
 *  slack     [in]      0 or more.
 *  progress  [in]      called with the fraction of the sites that are done; may be NULL.
 *  Returns  true; false: out of memory.
 *  Cost     a search over the mesh, and one in each disputed cell.
 *  Example  tests/tools/test_path_checks.c
 */
bool cell_paths_correct(cell_correction *c, sl_int *cell, surface_search *one,
                        surface_search *three, sl_int n_vertices, const sl_int *sites, sl_int count,
                        double radius, double slack, void (*progress)(double fraction));

#endif

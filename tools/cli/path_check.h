/* path_check.h: compares the distances and cells of the heat method with paths over the faces */
#ifndef TOOLS_PATH_CHECK_H
#define TOOLS_PATH_CHECK_H

#include "app.h"
#include "tools/geometry/cell_paths.h"
#include "tools/geometry/edge_curve.h"
#include "tools/geometry/heat_patch.h"

/** Searches on one mesh, and what they found so far. Like all functions of this folder, those below
 *  end the program with a message on errors. */
typedef struct path_check {
    const mesh *m; /* borrowed */
    incidence inc;
    surface_search *three;   /* through 3 points of each edge */
    const edge_curve *curve; /* whose edges are sources too, borrowed; NULL: none */
    double edge;             /* the mean length */
    double slack; /* what a distance may fall short of a path in any case, in mean edges */
    double seconds;
    sl_off kept, paths, lines; /* distances that stayed, are lengths of paths or straight lines, */
    sl_off others;             /* have no path: their sum is that of all distances */
    double largest;            /* the largest change */
    double gap, widest; /* what straightening took off the paths: the sum, and the largest one */
} path_check;

/** Prepares the searches; release with path_check_close. m must outlive it. */
void path_check_open(path_check *check, const mesh *m);

/** From now on, distances are those from all points of these curves, whose vertices are among the
 *  sources. */
void path_check_set_curve(path_check *check, const edge_curve *curve);

/** Moves distances that cannot be right (surface_paths_correct), and counts which are which.
 *
 *  f       [in,out]  distances from the sources. With a radius, of a whole patch; those that are
 *                    then beyond the radius are removed.
 *  radius  [in]      0: none.
 *  limit   [in]      paths are followed so far; above the radius; INFINITY: all.
 */
void path_check_distances(path_check *check, heat_field *f, const sl_int *sources, sl_int count,
                          double radius, double limit);

/** Prints which distances are which and how far off they can be, and warns of large errors. */
void path_check_report(const path_check *check);

/** Moves vertices to nearer sites (cell_paths_correct), prints what was done and what errors
 *  remain, and warns if much was wrong. */
void path_check_cells(path_check *check, sl_int *cell, const sl_int *sites, sl_int count,
                      double radius);

void path_check_close(path_check *check);

#endif

/* grid.h: made-up problems of any size: triangulated grids, flat or closed, and the Laplacians of 2D and 3D grids */
#ifndef TOOLS_GRID_H
#define TOOLS_GRID_H

#include <stdbool.h>
#include <stdint.h>

#include "mesh.h"

/** A flat grid of nx x ny vertices (each 1 or more), each square cut into two triangles along the same diagonal.
 *
 *  Vertex (ix, iy) is number ix + nx iy and lies at (ix h, iy h, 0), h = 1 / (max(nx, ny) - 1), so that the longer
 *  side spans 0..1. Vertices off the border are then moved by up to jitter h in x and in y: the same seed gives the
 *  same mesh on every machine; jitter 0 gives the regular grid; below 0.25 no triangle can turn over.
 *
 *  out  [out]  the mesh, release with mesh_free; all zero on error.
 *  Returns  true; false: nx or ny below 1, jitter negative or not finite, too many vertices or faces, out of memory.
 */
bool mesh_grid(mesh *out, sl_int nx, sl_int ny, double jitter, uint64_t seed);

/** A closed surface: a torus of nu vertices around the ring, of radius 1, and nv around the tube, of radius 0.4 (each 3 or
 *  more), each square cut into two triangles that turn the same way as seen from outside.
 *
 *  Vertex (iu, iv) is number iu + nu iv; each is moved on the surface by up to jitter steps in both directions.
 *
 *  out  [out]  the mesh, release with mesh_free; all zero on error.
 *  Returns  true; false: nu or nv below 3, jitter negative or not finite, too many vertices or faces, out of memory.
 */
bool mesh_torus(mesh *out, sl_int nu, sl_int nv, double jitter, uint64_t seed);

/** Lower triangle of the 5-point Laplacian of a grid of nx x ny points (each 1 or more), with a shifted diagonal.
 *
 *  Entry -1 for each pair of neighbours, number of neighbours + shift on the diagonal (rows of the full matrix sum
 *  to the shift): definite for shift > 0, singular for shift = 0. Point (ix, iy) is row ix + nx iy.
 *
 *  out  [out]  the matrix, release with sl_matrix_free; NULL on error.
 *  Returns  true; false: a size below 1, too many points, out of memory.
 */
bool grid_laplacian_2d(sl_matrix **out, sl_int nx, sl_int ny, double shift);

/** The same for the 7-point Laplacian of nx x ny x nz points; point (ix, iy, iz) is row ix + nx (iy + ny iz). */
bool grid_laplacian_3d(sl_matrix **out, sl_int nx, sl_int ny, sl_int nz, double shift);

#endif

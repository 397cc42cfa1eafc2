/* grid.h: synthetic problems of any size: grid and torus meshes, Laplacians of 2D and 3D grids */
#ifndef TOOLS_GRID_H
#define TOOLS_GRID_H

#include <stdbool.h>
#include <stdint.h>

#include "mesh.h"

/** A flat grid of nx x ny vertices. All squares are split into two triangles by the same diagonal.
 *
 *  Vertex (ix, iy) is number ix + nx iy and lies at (ix h, iy h, 0) with h = 1 / (max(nx, ny) - 1),
 *  so that the longer side is [0, 1]. Interior vertices are then displaced by at most jitter h in x
 *  and in y. Below a jitter of 0.25 no triangle can flip; a jitter of 0 gives the regular grid. The
 *  same seed gives the same mesh on every machine.
 *
 *  out     [out]  the mesh, release with mesh_free; all zero on error.
 *  nx, ny  [in]   1 or more.
 *  Returns  true; false: nx or ny below 1, jitter negative or not finite, too many vertices or
 *           faces, out of memory.
 */
bool mesh_grid(mesh *out, sl_int nx, sl_int ny, double jitter, uint64_t seed);

/** A closed torus: nu vertices around the ring (radius 1) and nv around the tube (radius 0.4). Each
 *  square is split into two triangles; all faces are oriented outward.
 *
 *  Vertex (iu, iv) is number iu + nu iv. It is displaced along the surface by at most jitter grid
 *  steps in each direction.
 *
 *  out     [out]  the mesh, release with mesh_free; all zero on error.
 *  nu, nv  [in]   3 or more.
 *  Returns  true; false: nu or nv below 3, jitter negative or not finite, too many vertices or
 *           faces, out of memory.
 */
bool mesh_torus(mesh *out, sl_int nu, sl_int nv, double jitter, uint64_t seed);

/** Lower triangle of the 5-point Laplacian of an nx x ny grid plus shift times the identity.
 *
 *  Off-diagonal entries are -1 for each pair of neighbors; a diagonal entry is the number of
 *  neighbors plus shift. Rows of the full matrix sum to shift: the matrix is positive definite for
 *  shift > 0 and singular for shift = 0. Point (ix, iy) is row ix + nx iy.
 *
 *  out     [out]  the matrix, release with sl_matrix_free; NULL on error.
 *  nx, ny  [in]   1 or more.
 *  Returns  true; false: a size below 1, too many points, out of memory.
 */
bool grid_laplacian_2d(sl_matrix **out, sl_int nx, sl_int ny, double shift);

/** The same for the 7-point Laplacian of an nx x ny x nz grid; point (ix, iy, iz) is row
 *  ix + nx (iy + ny iz). */
bool grid_laplacian_3d(sl_matrix **out, sl_int nx, sl_int ny, sl_int nz, double shift);

#endif

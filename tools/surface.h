/* surface.h: made-up surfaces of any size, by a short name: grids, spheres, tori, knots, bumpy ones */
#ifndef TOOLS_SURFACE_H
#define TOOLS_SURFACE_H

#include <stdbool.h>
#include <stddef.h>

#include "mesh.h"

/** Makes the surface that a text names:
 *
 *  grid:WxH     flat, W x H vertices, the inner ones jittered (mesh_grid in grid.h, jitter 0.2)
 *  hills:WxH    the same grid with hills: a graph over the plane
 *  sphere:K     the unit sphere: an icosahedron cut K times (0 to 10): 10 4^K + 2 vertices
 *  blob:K       a sphere with bumps, without any symmetry
 *  star:K       a sphere with five arms
 *  torus:WxH    a torus of W vertices around its axis and H around its tube (each 3 or more)
 *  knot:WxH     a tube around a trefoil knot, W vertices along and H around
 *
 *  out      [out]  the mesh, faces oriented outwards (upwards), release with mesh_free; all zero on error.
 *  message  [out]  on error what is wrong; may be NULL.
 *  Returns  true; false: malformed, out of range, out of memory.
 */
bool surface_make(mesh *out, const char *text, char *message, size_t message_size);

/** Does the text begin as one of those names and a colon do? */
bool surface_is_named(const char *text);

#endif

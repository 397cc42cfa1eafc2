/* surface_generator.h: synthetic surfaces of any size, by name: grids, spheres, tori, a knot */
#ifndef TOOLS_SURFACE_GENERATOR_H
#define TOOLS_SURFACE_GENERATOR_H

#include <stdbool.h>
#include <stddef.h>

#include "mesh.h"

/** Generates the surface that a text specifies:
 *
 *  grid:WxH     flat, W x H vertices, interior vertices jittered (mesh_grid in grid.h, jitter 0.2)
 *  hills:WxH    a height field over the same grid
 *  sphere:K     the unit sphere: an icosahedron subdivided K times (0 to 10), 10 4^K + 2 vertices
 *  blob:K       a bumpy sphere without any symmetry
 *  star:K       a sphere with five arms
 *  torus:WxH    a torus with W vertices around its axis and H around its tube (each 3 or more)
 *  knot:WxH     a tube around a trefoil knot, W vertices along it and H around it
 *
 *  out      [out]  the mesh, faces oriented outward (upward), release with mesh_free; all zero on
 *                  error.
 *  message  [out]  the reason on error, message_size bytes; may be NULL.
 *  Returns  true; false: malformed text, size out of range, out of memory.
 */
bool surface_generate(mesh *out, const char *text, char *message, size_t message_size);

/** Returns whether a text begins with one of these names and a colon. */
bool surface_is_specification(const char *text);

#endif

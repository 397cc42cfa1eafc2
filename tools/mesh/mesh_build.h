/* mesh_build.h: builds a mesh while a file is read: growing arrays, polygons, index checks */
#ifndef TOOLS_MESH_BUILD_H
#define TOOLS_MESH_BUILD_H

#include "tools/io/input.h"
#include "mesh.h"

/** A mesh under construction. Arrays double when full, so memory follows the data and not the
 *  counts of a header. */
typedef struct mesh_build {
    input *in;
    mesh result;
    size_t vertex_capacity;
    size_t face_capacity;
    sl_int *corners; /* of the current polygon */
    size_t n_corners;
    size_t corner_capacity;
    /* polygons of more than three corners: the first triangle, and the number of triangles */
    sl_int *polygon;
    size_t n_polygon; /* two for each */
    size_t polygon_capacity;
    sl_int largest; /* largest index in any face, -1: none; faces may precede their vertices */
    int64_t largest_line; /* the line of that index; 0 for binary files */
    int64_t largest_face; /* the polygon of that index, counted from 0 */
    int64_t polygons;
    char note[400]; /* of mesh_build_note, separated by semicolons */
    char left[200]; /* of mesh_build_leave, separated by commas */
} mesh_build;

/** Adds a vertex. Like the next two functions, sets the message of b->in and returns false on
 *  error.
 *
 *  Returns  true; false: a coordinate is not finite, too many vertices, out of memory.
 */
bool mesh_build_vertex(mesh_build *b, double x, double y, double z);

/** Adds a corner to the current polygon.
 *
 *  Returns  true; false: vertex is negative or too large, out of memory.
 */
bool mesh_build_corner(mesh_build *b, int64_t vertex);

/** Ends the current polygon and adds it as a fan of triangles, which become ears at the end of the
 *  file if the fan turns triangles over.
 *
 *  Returns  true; false: fewer than three corners, too many triangles, out of memory.
 */
bool mesh_build_polygon(mesh_build *b);

/** Merges vertices with equal coordinates; the first of each keeps its rank in the order of the
 *  file.
 *
 *  first_vertex, first_face  [in]  only vertices and faces from these on are concerned; no other
 *                                  face uses these vertices, and all their corners are in range.
 *  Returns  true; false: out of memory.
 */
bool mesh_build_weld(mesh_build *b, sl_int first_vertex, sl_int first_face);

/** Adds a strip of triangles, given as the corners of the current polygon: each of the corners
 *  from the third on makes one with the two before it, in alternating order. Triangles with a
 *  repeated vertex, which join strips, are left out.
 *
 *  Returns  true; false: as mesh_build_polygon.
 */
bool mesh_build_strip(mesh_build *b);

/** Whether all corners so far are vertices; if not, sets the message of b->in. */
bool mesh_build_is_in_range(mesh_build *b);

/** Notes what is odd about a file that can be read. A note beyond 400 bytes is cut. */
void mesh_build_note(mesh_build *b, const char *format, ...) INPUT_PRINTF(2, 3);

/** Names something that the file has and a mesh has not. */
void mesh_build_leave(mesh_build *b, const char *format, ...) INPUT_PRINTF(2, 3);

/* One reader per format. Each reads all of b->in into b; false: b->in has the message. */
bool mesh_read_obj(mesh_build *b);
bool mesh_read_off(mesh_build *b);
bool mesh_read_ply(mesh_build *b);
bool mesh_read_stl(mesh_build *b);
bool mesh_read_vtk(mesh_build *b);
bool mesh_read_gltf(mesh_build *b); /* .gltf and .glb */

#endif

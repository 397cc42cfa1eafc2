/* mesh.h: triangle meshes in memory, and reading them from OBJ, OFF, PLY and STL files */
#ifndef TOOLS_MESH_H
#define TOOLS_MESH_H

#include <stdbool.h>
#include <stddef.h>

#include "../sparse_local.h"

/** A triangle mesh as it stood in its file: nothing (but the corners of STL) is merged, dropped, reordered or oriented.
 *
 *  Vertices that no face uses, vertices at the same place, faces of zero area, faces with a repeated vertex and
 *  edges of three or more faces are all kept: whoever computes on a mesh must bear them.
 */
typedef struct mesh {
    sl_int n_vertices;
    sl_int n_faces;
    double
        *xyz; /* 3 n_vertices: x y z of vertex 0, of vertex 1, ...; finite when read from a file */
    sl_int *faces; /* 3 n_faces: corners of face 0, of face 1, ..., in 0..n_vertices-1 */
} mesh;

/** Reads a triangle mesh; the ending of the name tells the format: .obj .off .ply .stl, plain or .gz.
 *
 *  OBJ  v and f lines (corners v, v/vt, v//vn, v/vt/vn; negative indices count back from the latest vertex; lines
 *       may be continued by a backslash); every other line is passed over.
 *  OFF  ASCII, the first word OFF, COFF, NOFF, STOFF or a mixture of them, or none; comments; counts on the first
 *       line or on their own; one vertex and one face a line, what follows coordinates or corners is passed over.
 *  PLY  1.0, ascii, binary_little_endian, binary_big_endian; properties of any scalar type in any order; the corners
 *       in a list vertex_indices or vertex_index; other elements and properties are passed over.
 *  STL  ascii and binary (which one its length tells); corners with the same coordinates become one vertex, numbered as
 *       they first come; normals and attributes are passed over.
 *
 *  A polygon of k corners becomes a fan of k - 2 triangles around its first corner.
 *
 *  out           [out]  the mesh, release with mesh_free; all zero on error.
 *  message       [out]  on error what is wrong, with the file and the line or element; "" otherwise; may be NULL.
 *  message_size  [in]   bytes at message.
 *  Returns  true; false: no such file, another format, truncated, an index out of range, fewer than three corners, a
 *           coordinate that is not finite, an OBJ file without vertices, more than 2^31-1 of anything, more than
 *           2 GiB of content, out of memory.
 *  Cost     O(file size) in time and memory: counts in a header are not believed before the data are there.
 *  Example  tests/test_mesh.c, tests/test_mesh_ply.c, tests/test_mesh_stl.c
 */
bool mesh_read(mesh *out, const char *path, char *message, size_t message_size);

/** Releases the arrays and makes the mesh empty; an empty (all zero) mesh is fine. */
void mesh_free(mesh *m);

#endif

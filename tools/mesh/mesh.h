/* mesh.h: triangle meshes in memory, and a reader for OBJ, OFF, PLY, STL, VTK and glTF files */
#ifndef TOOLS_MESH_H
#define TOOLS_MESH_H

#include <stdbool.h>
#include <stddef.h>

#include "sparse_local.h"

/** A triangle mesh exactly as its file gives it. Nothing is merged (except STL corners and
 *  vertices of glTF), dropped, reordered or reoriented.
 *
 *  Unused vertices, coincident vertices, faces of zero area, faces with a repeated vertex and edges
 *  with three or more faces are all kept. Code that computes on a mesh must handle them.
 */
typedef struct mesh {
    sl_int n_vertices;
    sl_int n_faces;
    double *xyz;   /* 3 n_vertices: x y z of vertex 0, then vertex 1, ...; finite if from a file */
    sl_int *faces; /* 3 n_faces: corners of face 0, of face 1, ..., each in 0..n_vertices-1 */
} mesh;

/** Reads a triangle mesh. The file name selects the format: .obj .off .ply .stl .vtk .glb .gltf,
 *  plain or .gz. The name - is standard input, whose first bytes select it.
 *
 *  OBJ  v, f and fo lines. Corners are v, v/vt, v//vn or v/vt/vn; a negative index counts back
 *       from the latest vertex; a backslash continues a line. All other lines are ignored.
 *  OFF  The first word is OFF or off, optionally with the prefixes ST, C and N, or is missing.
 *       ASCII: comments are allowed. The counts are on the first line or on a line of their own.
 *       Each vertex begins a line, and each face, whose corners may go on in the next ones;
 *       anything after the coordinates or corners is ignored. After the word BINARY and the end of
 *       its line: big-endian counts and corners as int32, coordinates and colors as float, four of
 *       the latter for a vertex of COFF, and of a face so many as a count after its corners says.
 *  PLY  1.0: ascii, binary_little_endian, binary_big_endian. Properties of any scalar type in any
 *       order; the corners are a list vertex_indices or vertex_index of element face, or strips of
 *       element tristrips, in which -1 begins a new strip. Other properties are ignored; other
 *       elements too, which is noted, and values beyond the declared ones in the line of a row.
 *  STL  ASCII or binary; the file length decides which. Corners with equal coordinates become one
 *       vertex, numbered in order of first appearance. Normals and attributes are ignored, as are
 *       bytes behind the last triangle of a binary file, which is noted.
 *
 *  VTK  Legacy, ASCII or binary, versions 1 to 5. Polygonal data: polygons and triangle strips.
 *       Unstructured grids: triangles, quadrilaterals, polygons and strips, and the surface of
 *       tetrahedra, hexahedra, voxels, wedges and pyramids (vtk_grid.h), which is noted. Lines,
 *       single vertices and faces of solids are ignored, which is noted, and data at points and
 *       cells, which is noted if the file is mixed.
 *  glTF 2.0, as text (.gltf) with buffers in data URIs or in files of the same folder, or as a
 *       container (.glb): all meshes of the scene, placed by their nodes; triangles, strips and
 *       fans. Points and lines are ignored, which is noted. Vertices with equal coordinates in one
 *       mesh become one, because files repeat them where normals or colors differ; this is noted,
 *       too, and not done in files of mesh_write.
 *
 *  Triangles of a strip with a repeated vertex, which only join its parts, are left out.
 *  A polygon with k corners becomes a fan of k - 2 triangles around its first corner; if that turns
 *  triangles over, which needs a corner that is not convex, it is divided by ears (polygon_ears.h).
 *  A polygon that crosses itself remains a fan, which is noted.
 *
 *  out           [out]  the mesh, release with mesh_free; all zero on error.
 *  message       [out]  the reason on error, with the file and the line or element; "" otherwise;
 *                       may be NULL.
 *  message_size  [in]   bytes at message.
 *  Returns  true; false: no such file, unknown format, truncated file, index out of range, polygon
 *           with fewer than three corners, coordinate that is not finite, OBJ file without
 *           vertices, more than 2^31-1 vertices or faces, more than 2 GiB of content, out of
 *           memory; VTK: another kind of data; glTF: compressed meshes, buffers elsewhere, nodes
 *           that repeat meshes to more than 64 elements for each byte.
 *  Cost     O(file size) in time and memory; for polygons that are not convex the squares of their
 *           corners: more than 8192 of them, or than 2^33 squares in all, are refused. Memory
 *           grows with the data that is read, not with the counts that a header claims.
 *  Example  tests/tools/test_mesh_obj_off.c, test_mesh_ply.c, test_mesh_stl.c,
 *           test_mesh_vtk.c, test_mesh_gltf.c, test_mesh_polygons.c
 */
bool mesh_read(mesh *out, const char *path, char *message, size_t message_size);

/** The same, and tells what is odd about a file that can be read.
 *
 *  note  [out]  the odd things, with the file, note_size bytes; "" if there is none or on error;
 *               may be NULL with note_size 0.
 */
bool mesh_read_noting(mesh *out, const char *path, char *message, size_t message_size, char *note,
                      size_t note_size);

/** The same, and names what the file has beside vertices and triangles, and no mesh has: groups,
 *  materials, texture coordinates, data.
 *
 *  left  [out]  "2 groups, normals", left_size >= 1 bytes; "" if there is nothing or on error.
 */
bool mesh_read_telling(mesh *out, const char *path, char *message, size_t message_size, char *note,
                       size_t note_size, char *left, size_t left_size);

/** Whether all corners of faces are vertices of the mesh. */
bool mesh_faces_are_in_range(const mesh *m);

/** Releases the arrays and sets m to all zero. An empty mesh and NULL are allowed. */
void mesh_free(mesh *m);

#endif

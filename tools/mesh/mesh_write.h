/* mesh_write.h: writes meshes with vertex values and colors as OBJ, PLY, VTK and glTF files */
#ifndef TOOLS_MESH_WRITE_H
#define TOOLS_MESH_WRITE_H

#include <stdbool.h>
#include <stddef.h>

#include "rgb.h"
#include "mesh.h"

/** A named value at each vertex. */
typedef struct mesh_field {
    const char *name;    /* letters, digits, underscores */
    const double *value; /* n_vertices */
} mesh_field;

/** Optional data to write with a mesh. All pointers may be NULL; all zero writes the mesh alone. */
typedef struct mesh_extra {
    const double *uv;        /* 2 n_vertices: texture coordinates u v */
    const double *corner_uv; /* 6 n_faces: texture coordinates of corners; OBJ only, replaces uv */
    const rgb *color;        /* n_vertices */
    const mesh_field *fields;
    int n_fields;
    const char
        *source; /* the file that the mesh was read from, with all of its vertices and faces */
} mesh_extra;

/** How many of n rows of `width` numbers are no value: a number in them is NaN or infinite. */
sl_int mesh_missing(const double *value, int width, sl_int n);

/** The endings of names for messages: ".obj, .ply, ...". */
extern const char mesh_write_formats[];

/** Whether the name of a file selects one of the formats of mesh_write. */
bool mesh_write_knows(const char *path);

/** Whether mesh_write writes the lines of `source`, if it is unchanged, to this file. */
bool mesh_write_keeps_source(const char *path, const mesh_extra *extra);

/** Writes a mesh. The file name selects the format: .obj, .ply, .vtk, .glb or .gltf, plain or
 *  with .gz.
 *
 *  OBJ  v lines, with r g b in 0..1 after x y z if there are colors; vt lines and f v/vt corners if
 *       there are texture coordinates. Without texture coordinates the first field is written as u,
 *       scaled from its range to 0..1. A face with a corner that has none is written without them.
 *       If `source` is an OBJ file and there are no other texture coordinates, its lines are
 *       written with the coordinates of m: polygons, groups and texture coordinates stay.
 *       All fields follow as comment lines "#field NAME" and "#f VALUE", where nan is no value.
 *  PLY  binary little-endian: x y z as double, fields as double properties by name, s t for texture
 *       coordinates, red green blue.
 *  VTK  legacy polygonal data, binary, version 3.0: fields as scalars of the points by name.
 *  glTF 2.0, as a container (.glb) or as text with the numbers in base64 (.gltf): one mesh in
 *       single precision; fields as attributes _NAME in capital letters; COLOR_0 and TEXCOORD_0. A
 *       value that is not finite, which glTF does not allow, becomes the lowest number of single
 *       precision, and an attribute _HAS_NAME is 0 there and 1 elsewhere. A mesh far from the
 *       origin, or of a size that single precision does not have, is translated and scaled by its
 *       node (single_frame.h). A mesh without faces becomes points.
 *
 *  In PLY and VTK a missing value is NaN.
 *
 *  path     [in]   the file; an existing one is replaced only by a complete one (output_open).
 *  extra    [in]   may be NULL.
 *  message  [out]  the reason on error, message_size bytes; may be NULL.
 *  Returns  true; false: unknown file name extension, the file cannot be written, or for glTF:
 *           a coordinate is not finite.
 *  Example  tests/tools/test_mesh_write.c
 */
bool mesh_write(const char *path, const mesh *m, const mesh_extra *extra, char *message,
                size_t message_size);

#endif

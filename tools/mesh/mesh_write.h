/* mesh_write.h: writes triangle meshes with numbers and colours at their vertices as OBJ and PLY files */
#ifndef TOOLS_MESH_WRITE_H
#define TOOLS_MESH_WRITE_H

#include <stdbool.h>
#include <stddef.h>

#include "colors.h"
#include "mesh.h"

/** A number at each vertex. */
typedef struct mesh_field {
    const char *name;    /* letters, digits, underscores */
    const double *value; /* n_vertices */
} mesh_field;

/** What goes into the file beside vertices and faces; all zero is nothing. */
typedef struct mesh_extra {
    const double *uv;        /* 2 n_vertices texture coordinates */
    const double *corner_uv; /* 6 n_faces texture coordinates of corners; OBJ only, instead of uv */
    const rgb *color;        /* n_vertices */
    const mesh_field *fields;
    int n_fields;
} mesh_extra;

/** Writes a mesh; the ending of the name tells the format: .obj or .ply, plain or with .gz after it.
 *
 *  OBJ  v lines (with r g b in 0..1 behind x y z where there are colours), vt lines and f v/vt corners where there are
 *       texture coordinates; without these the first field takes their place as u (what lies between its smallest and
 *       largest value, as 0..1). All fields stand in comment lines "#field NAME" and "#f VALUE".
 *  PLY  binary little-endian: x y z as doubles, fields as double properties of their names, s t for texture
 *       coordinates, red green blue.
 *
 *  message  [out]  on error what is wrong; may be NULL.
 *  Returns  true; false: another ending, or the file cannot be written.
 *  Example  tests/test_tools_mesh_write.c
 */
bool mesh_write(const char *path, const mesh *m, const mesh_extra *extra, char *message,
                size_t message_size);

#endif

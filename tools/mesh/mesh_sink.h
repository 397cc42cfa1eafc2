/* mesh_sink.h: where mesh writers put text and numbers: a plain or gzipped file */
#ifndef TOOLS_MESH_SINK_H
#define TOOLS_MESH_SINK_H

#include <stdbool.h>
#include <stddef.h>

#include <zlib.h>

#include "mesh_write.h"
#include "tools/io/input.h"

/** A file being written; failed is set by the first error. */
typedef struct mesh_sink {
    gzFile file;
    bool failed;
} mesh_sink;

/** Writes bytes. */
void sink_put(mesh_sink *s, const void *bytes, size_t length);

/** Writes text of up to 511 characters. */
INPUT_PRINTF(2, 3) void sink_print(mesh_sink *s, const char *format, ...);

/** Writes numbers in binary form, little-endian unless big_endian. */
void sink_double(mesh_sink *s, double x, bool big_endian);
void sink_int(mesh_sink *s, sl_int k, bool big_endian);

/* Writers of one format each; extra is not NULL. */
void mesh_write_obj(mesh_sink *s, const mesh *m, const mesh_extra *extra);
void mesh_write_ply(mesh_sink *s, const mesh *m, const mesh_extra *extra);
void mesh_write_vtk(mesh_sink *s, const mesh *m, const mesh_extra *extra);

/** Writes the lines of the OBJ file extra->source with the coordinates of m. Returns false, and
 *  writes nothing, if there is none, or if it has other vertices or faces. */
bool mesh_write_source(mesh_sink *s, const mesh *m, const mesh_extra *extra);

/** Writes lines vt with a field as texture coordinate u, scaled from its range to 0..1. */
void sink_field_as_uv(mesh_sink *s, const mesh_field *field, sl_int n);

/** Writes a mesh whose coordinates are finite.
 *
 *  is_container  [in]  true: .glb; false: .gltf, with the numbers as base64.
 */
void mesh_write_gltf(mesh_sink *s, const mesh *m, const mesh_extra *extra, bool is_container);

#endif

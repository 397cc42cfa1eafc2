/* mesh_write.c: writes meshes with vertex values and colors: selects the format; OBJ, PLY */
#define _POSIX_C_SOURCE 200809L
#include "mesh_write.h"

#include <math.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include "mesh_sink.h"
#include "tools/io/output_file.h"

sl_int mesh_missing(const double *value, int width, sl_int n) {
    sl_int missing = 0;
    for (sl_int v = 0; v < n; v++) {
        bool is_known = true;
        for (int k = 0; k < width; k++) {
            is_known = is_known && isfinite(value[(size_t)width * (size_t)v + (size_t)k]);
        }
        missing += !is_known;
    }
    return missing;
}

void sink_field_as_uv(mesh_sink *s, const mesh_field *field, sl_int n) {
    double low = HUGE_VAL, high = -HUGE_VAL;
    for (sl_int v = 0; v < n; v++) {
        if (isfinite(field->value[v])) {
            low = fmin(low, field->value[v]);
            high = fmax(high, field->value[v]);
        }
    }
    for (sl_int v = 0; v < n; v++) {
        double t = high > low ? (field->value[v] - low) / (high - low) : 0;
        sink_print(s, "vt %.9g 0\n", isfinite(t) ? t : 0);
    }
}

/* Returns whether texture coordinates were written. */
static bool print_uv(mesh_sink *s, const mesh *m, const mesh_extra *extra) {
    const double *uv = extra->corner_uv != NULL ? extra->corner_uv : extra->uv;
    size_t count = extra->corner_uv != NULL ? 3 * (size_t)m->n_faces : (size_t)m->n_vertices;
    if (uv == NULL && extra->n_fields > 0) {
        sink_field_as_uv(s, &extra->fields[0], m->n_vertices);
        return true;
    }
    for (size_t k = 0; uv != NULL && k < count; k++) {
        bool fine = isfinite(uv[2 * k]) && isfinite(uv[2 * k + 1]);
        sink_print(s, "vt %.17g %.17g\n", fine ? uv[2 * k] : 0, fine ? uv[2 * k + 1] : 0);
    }
    return uv != NULL;
}

/* Whether all corners of face f have texture coordinates: those of a corner without a value, which
 * are 0 to keep the count, belong to no face. */
static bool has_texture(const mesh *m, const mesh_extra *extra, size_t f) {
    const double *uv = extra->corner_uv != NULL ? extra->corner_uv : extra->uv;
    sl_int missing = 0;
    for (size_t k = 3 * f; k < 3 * f + 3; k++) {
        const size_t v = (size_t)m->faces[k];
        missing += extra->corner_uv != NULL ? mesh_missing(uv + 2 * k, 2, 1)
                   : uv != NULL             ? mesh_missing(uv + 2 * v, 2, 1)
                                            : mesh_missing(extra->fields[0].value + v, 1, 1);
    }
    return missing == 0;
}

static void print_triangles(mesh_sink *s, const mesh *m, const mesh_extra *extra) {
    for (size_t v = 0; v < (size_t)m->n_vertices; v++) {
        const double *x = m->xyz + 3 * v;
        sink_print(s, "v %.17g %.17g %.17g", x[0], x[1], x[2]);
        if (extra->color != NULL) {
            rgb c = extra->color[v];
            sink_print(s, " %.4f %.4f %.4f", c.r / 255.0, c.g / 255.0, c.b / 255.0);
        }
        sink_print(s, "\n");
    }
    bool textured = print_uv(s, m, extra);
    for (size_t f = 0; f < (size_t)m->n_faces; f++) {
        const bool is_textured = textured && has_texture(m, extra, f);
        sink_print(s, "f");
        for (size_t c = 0; c < 3; c++) {
            long vertex = (long)m->faces[3 * f + c] + 1;
            long texture = extra->corner_uv != NULL ? (long)(3 * f + c) + 1 : vertex;
            if (is_textured) {
                sink_print(s, " %ld/%ld", vertex, texture);
            } else {
                sink_print(s, " %ld", vertex);
            }
        }
        sink_print(s, "\n");
    }
}

void mesh_write_obj(mesh_sink *s, const mesh *m, const mesh_extra *extra) {
    if (!mesh_write_source(s, m, extra)) {
        print_triangles(s, m, extra);
    }
    for (int k = 0; k < extra->n_fields; k++) {
        sink_print(s, "#field %s\n", extra->fields[k].name);
        for (sl_int v = 0; v < m->n_vertices; v++) {
            sink_print(s, "#f %.17g\n", extra->fields[k].value[v]);
        }
    }
}

static void put_face(mesh_sink *s, const sl_int *f) {
    unsigned char bytes[13] = {3};
    for (int k = 0; k < 12; k++) {
        bytes[1 + k] = (unsigned char)((uint32_t)f[k / 4] >> (8 * (k % 4)));
    }
    sink_put(s, bytes, sizeof bytes);
}

void mesh_write_ply(mesh_sink *s, const mesh *m, const mesh_extra *extra) {
    sink_print(s, "ply\nformat binary_little_endian 1.0\nelement vertex %ld\n",
               (long)m->n_vertices);
    sink_print(s, "property double x\nproperty double y\nproperty double z\n");
    for (int k = 0; k < extra->n_fields; k++) {
        sink_print(s, "property double %s\n", extra->fields[k].name);
    }
    if (extra->uv != NULL) {
        sink_print(s, "property double s\nproperty double t\n");
    }
    if (extra->color != NULL) {
        sink_print(s, "property uchar red\nproperty uchar green\nproperty uchar blue\n");
    }
    sink_print(s, "element face %ld\nproperty list uchar int vertex_indices\nend_header\n",
               (long)m->n_faces);
    for (size_t v = 0; v < (size_t)m->n_vertices; v++) {
        for (size_t d = 0; d < 3; d++) {
            sink_double(s, m->xyz[3 * v + d], false);
        }
        for (int k = 0; k < extra->n_fields; k++) {
            sink_double(s, extra->fields[k].value[v], false);
        }
        if (extra->uv != NULL) {
            sink_double(s, extra->uv[2 * v], false);
            sink_double(s, extra->uv[2 * v + 1], false);
        }
        if (extra->color != NULL) {
            sink_put(s, &extra->color[v], 3);
        }
    }
    for (size_t f = 0; f < (size_t)m->n_faces; f++) {
        put_face(s, m->faces + 3 * f);
    }
}

static bool fail(char *message, size_t size, const char *path, const char *words) {
    if (message != NULL && size > 0) {
        (void)snprintf(message, size, "%s: %s", path, words);
    }
    return false;
}

/* The formats by the ends of names. */
enum { OBJ, PLY, VTK, GLB, GLTF, FORMATS };

static int format_of(const char *path) {
    static const char *const endings[FORMATS] = {".obj", ".ply", ".vtk", ".glb", ".gltf"};
    for (int k = 0; k < FORMATS; k++) {
        if (input_path_ends(path, endings[k])) {
            return k;
        }
    }
    return FORMATS;
}

const char mesh_write_formats[] = ".obj, .ply, .vtk, .glb or .gltf, optionally followed by .gz";

bool mesh_write_knows(const char *path) {
    return format_of(path) < FORMATS;
}

static void write_as(int format, mesh_sink *s, const mesh *m, const mesh_extra *extra) {
    static const mesh_extra nothing = {NULL, NULL, NULL, NULL, 0, NULL};
    const mesh_extra *more = extra != NULL ? extra : &nothing;
    if (format == OBJ) {
        mesh_write_obj(s, m, more);
    } else if (format == PLY) {
        mesh_write_ply(s, m, more);
    } else if (format == VTK) {
        mesh_write_vtk(s, m, more);
    } else {
        mesh_write_gltf(s, m, more, format == GLB);
    }
}

bool mesh_write(const char *path, const mesh *m, const mesh_extra *extra, char *message,
                size_t message_size) {
    const int format = format_of(path);
    size_t length = strlen(path);
    bool packed = length > 3 && strcmp(path + length - 3, ".gz") == 0;
    if (format == FORMATS) {
        char words[160];
        (void)snprintf(words, sizeof words, "unknown mesh format: the name must end in %s",
                       mesh_write_formats);
        return fail(message, message_size, path, words);
    }
    if ((format == GLB || format == GLTF) && mesh_missing(m->xyz, 3, m->n_vertices) > 0) {
        return fail(message, message_size, path, "coordinates that are not finite");
    }
    FILE *file = output_open(path, message, message_size);
    if (file == NULL) {
        return false;
    }
    /* zlib writes to the descriptor of the stream, which itself stays empty. */
    int fd = dup(fileno(file));
    mesh_sink s = {fd >= 0 ? gzdopen(fd, packed ? "wb6" : "wbT") : NULL, false};
    bool written = s.file != NULL;
    if (written) {
        (void)gzbuffer(s.file, 1u << 17);
        write_as(format, &s, m, extra);
        written = gzclose(s.file) == Z_OK && !s.failed;
    } else if (fd >= 0) {
        (void)close(fd);
    }
    if (!written) {
        output_discard(file);
        return fail(message, message_size, path, "could not be written completely");
    }
    return output_close(file, message, message_size);
}

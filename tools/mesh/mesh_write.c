/* mesh_write.c: writes triangle meshes with vertex values and colors as OBJ and PLY files */
#define _POSIX_C_SOURCE 200809L
#include "mesh_write.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <zlib.h>

#include "tools/io/input.h"
#include "tools/io/output_file.h"

/* A file being written, plain or gzipped; failed is set by the first error. */
typedef struct sink {
    gzFile file;
    bool failed;
} sink;

static void put(sink *s, const void *bytes, size_t length) {
    s->failed = s->failed || (length > 0 && gzwrite(s->file, bytes, (unsigned)length) <= 0);
}

INPUT_PRINTF(2, 3) static void print(sink *s, const char *format, ...) {
    char line[512];
    va_list list;
    va_start(list, format);
    int length = vsnprintf(line, sizeof line, format, list);
    va_end(list);
    s->failed = s->failed || length < 0 || (size_t)length >= sizeof line;
    if (!s->failed) {
        put(s, line, (size_t)length);
    }
}

/* Writes a field as the texture coordinate u, scaled from its range to 0..1. */
static void print_field_as_uv(sink *s, const mesh_field *field, sl_int n) {
    double low = HUGE_VAL, high = -HUGE_VAL;
    for (sl_int v = 0; v < n; v++) {
        if (isfinite(field->value[v])) {
            low = fmin(low, field->value[v]);
            high = fmax(high, field->value[v]);
        }
    }
    for (sl_int v = 0; v < n; v++) {
        double t = high > low ? (field->value[v] - low) / (high - low) : 0;
        print(s, "vt %.9g 0\n", isfinite(t) ? t : 0);
    }
}

/* Returns whether texture coordinates were written. */
static bool print_uv(sink *s, const mesh *m, const mesh_extra *extra) {
    const double *uv = extra->corner_uv != NULL ? extra->corner_uv : extra->uv;
    size_t count = extra->corner_uv != NULL ? 3 * (size_t)m->n_faces : (size_t)m->n_vertices;
    if (uv == NULL && extra->n_fields > 0) {
        print_field_as_uv(s, &extra->fields[0], m->n_vertices);
        return true;
    }
    for (size_t k = 0; uv != NULL && k < count; k++) {
        bool fine = isfinite(uv[2 * k]) && isfinite(uv[2 * k + 1]);
        print(s, "vt %.17g %.17g\n", fine ? uv[2 * k] : 0, fine ? uv[2 * k + 1] : 0);
    }
    return uv != NULL;
}

static void write_obj(sink *s, const mesh *m, const mesh_extra *extra) {
    for (size_t v = 0; v < (size_t)m->n_vertices; v++) {
        const double *x = m->xyz + 3 * v;
        print(s, "v %.17g %.17g %.17g", x[0], x[1], x[2]);
        if (extra->color != NULL) {
            rgb c = extra->color[v];
            print(s, " %.4f %.4f %.4f", c.r / 255.0, c.g / 255.0, c.b / 255.0);
        }
        print(s, "\n");
    }
    bool textured = print_uv(s, m, extra);
    for (size_t f = 0; f < (size_t)m->n_faces; f++) {
        print(s, "f");
        for (size_t c = 0; c < 3; c++) {
            long vertex = (long)m->faces[3 * f + c] + 1;
            long texture = extra->corner_uv != NULL ? (long)(3 * f + c) + 1 : vertex;
            if (textured) {
                print(s, " %ld/%ld", vertex, texture);
            } else {
                print(s, " %ld", vertex);
            }
        }
        print(s, "\n");
    }
    for (int k = 0; k < extra->n_fields; k++) {
        print(s, "#field %s\n", extra->fields[k].name);
        for (sl_int v = 0; v < m->n_vertices; v++) {
            print(s, "#f %.17g\n", extra->fields[k].value[v]);
        }
    }
}

/* A double, little-endian. */
static void put_number(sink *s, double x) {
    unsigned char bytes[8];
    uint64_t bits;
    memcpy(&bits, &x, sizeof bits);
    for (int k = 0; k < 8; k++) {
        bytes[k] = (unsigned char)(bits >> (8 * k));
    }
    put(s, bytes, sizeof bytes);
}

static void put_face(sink *s, const sl_int *f) {
    unsigned char bytes[13] = {3};
    for (int k = 0; k < 12; k++) {
        bytes[1 + k] = (unsigned char)((uint32_t)f[k / 4] >> (8 * (k % 4)));
    }
    put(s, bytes, sizeof bytes);
}

static void write_ply(sink *s, const mesh *m, const mesh_extra *extra) {
    print(s, "ply\nformat binary_little_endian 1.0\nelement vertex %ld\n", (long)m->n_vertices);
    print(s, "property double x\nproperty double y\nproperty double z\n");
    for (int k = 0; k < extra->n_fields; k++) {
        print(s, "property double %s\n", extra->fields[k].name);
    }
    if (extra->uv != NULL) {
        print(s, "property double s\nproperty double t\n");
    }
    if (extra->color != NULL) {
        print(s, "property uchar red\nproperty uchar green\nproperty uchar blue\n");
    }
    print(s, "element face %ld\nproperty list uchar int vertex_indices\nend_header\n",
          (long)m->n_faces);
    for (size_t v = 0; v < (size_t)m->n_vertices; v++) {
        for (size_t d = 0; d < 3; d++) {
            put_number(s, m->xyz[3 * v + d]);
        }
        for (int k = 0; k < extra->n_fields; k++) {
            put_number(s, extra->fields[k].value[v]);
        }
        if (extra->uv != NULL) {
            put_number(s, extra->uv[2 * v]);
            put_number(s, extra->uv[2 * v + 1]);
        }
        if (extra->color != NULL) {
            put(s, &extra->color[v], 3);
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

bool mesh_write_knows(const char *path) {
    return input_path_ends(path, ".obj") || input_path_ends(path, ".ply");
}

bool mesh_write(const char *path, const mesh *m, const mesh_extra *extra, char *message,
                size_t message_size) {
    static const mesh_extra nothing = {NULL, NULL, NULL, NULL, 0};
    bool obj = input_path_ends(path, ".obj");
    size_t length = strlen(path);
    bool packed = length > 3 && strcmp(path + length - 3, ".gz") == 0;
    if (!mesh_write_knows(path)) {
        return fail(
            message, message_size, path,
            "unknown mesh format: the name must end in .obj or .ply, optionally followed by .gz");
    }
    FILE *file = output_open(path, message, message_size);
    if (file == NULL) {
        return false;
    }
    /* zlib writes to the descriptor of the stream, which itself stays empty. */
    int fd = dup(fileno(file));
    sink s = {fd >= 0 ? gzdopen(fd, packed ? "wb6" : "wbT") : NULL, false};
    bool written = s.file != NULL;
    if (written) {
        (void)gzbuffer(s.file, 1u << 17);
        (obj ? write_obj : write_ply)(&s, m, extra != NULL ? extra : &nothing);
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

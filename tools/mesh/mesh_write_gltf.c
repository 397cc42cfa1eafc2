/* mesh_write_gltf.c: writes a mesh and its fields as a glTF 2 file, text or container */
#include <ctype.h>
#include <float.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "mesh_sink.h"
#include "single_frame.h"

/* A growing text: the document, whose length a container tells before it. */
typedef struct text {
    char *at;
    size_t used, capacity;
    bool failed;
} text;

static void append(text *t, const char *words, size_t length) {
    if (!t->failed && t->used + length + 1 > t->capacity) {
        size_t wanted = 2 * (t->capacity + length) + 256;
        char *larger = (char *)realloc(t->at, wanted);
        t->failed = larger == NULL;
        t->at = larger != NULL ? larger : t->at;
        t->capacity = larger != NULL ? wanted : t->capacity;
    }
    if (!t->failed && length > 0) {
        memcpy(t->at + t->used, words, length);
        t->used += length;
    }
}

/* Appends up to 511 characters. */
INPUT_PRINTF(2, 3) static void add(text *t, const char *format, ...) {
    char part[512];
    va_list list;
    va_start(list, format);
    int length = vsnprintf(part, sizeof part, format, list);
    va_end(list);
    t->failed = t->failed || length < 0 || (size_t)length >= sizeof part;
    append(t, part, t->failed ? 0 : (size_t)length);
}

/* The binary part: written as it is, or as base64. */
typedef struct bytes {
    mesh_sink *s;
    bool is_text;
    unsigned held; /* bits that wait for their digit */
    int n_held;
} bytes;

static void put_digit(bytes *b, unsigned digit) {
    static const char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    sink_put(b->s, digits + (digit & 63), 1);
}

static void put_word(bytes *b, uint32_t word) {
    unsigned char four[4];
    for (int k = 0; k < 4; k++) {
        four[k] = (unsigned char)(word >> (8 * k));
    }
    if (!b->is_text) {
        sink_put(b->s, four, sizeof four);
        return;
    }
    for (int k = 0; k < 4; k++) {
        b->held = b->held << 8 | four[k];
        for (b->n_held += 8; b->n_held >= 6; b->n_held -= 6) {
            put_digit(b, b->held >> (b->n_held - 6));
        }
    }
}

/* Base64 ends with a digit for the bits that are left, and fills up its last four characters. */
static void end_bytes(bytes *b, int64_t length) {
    if (b->is_text && b->n_held > 0) {
        put_digit(b, b->held << (6 - b->n_held));
        sink_put(b->s, "==", length % 3 == 1 ? 2 : 1);
    }
}

/* glTF has no NaNs: the lowest number says that there is no value. */
static void put_float(bytes *b, double x) {
    const float single = isfinite(x) ? (float)fmax(-FLT_MAX, fmin(FLT_MAX, x)) : -FLT_MAX;
    uint32_t bits;
    memcpy(&bits, &single, sizeof bits);
    put_word(b, bits);
}

/* An array of the buffer, one view and one accessor each. */
typedef struct layout {
    text views, accessors, attributes;
    int64_t length; /* bytes so far */
    int count;
} layout;

/* Describes the next array: `count` rows of `bytes` bytes. `more` is the rest of its accessor. */
static void describe(layout *l, const char *attribute, int64_t count, int row, const char *more) {
    const char *comma = l->count > 0 ? "," : "";
    add(&l->views, "%s{\"buffer\":0,\"byteOffset\":%lld,\"byteLength\":%lld}", comma,
        (long long)l->length, (long long)(count * row));
    add(&l->accessors, "%s{\"bufferView\":%d,\"count\":%lld,%s}", comma, l->count, (long long)count,
        more);
    if (attribute != NULL) {
        add(&l->attributes, "%s\"%s\":%d", l->attributes.used > 0 ? "," : "", attribute, l->count);
    }
    l->length += count * row;
    l->count++;
}

/* The rows of numbers of one attribute of the vertices, and whether one of them is no value. */
typedef struct attribute {
    char name[64];
    const double *value;
    int width;
    bool has_gaps;
} attribute;

/* Attribute k: a field, or the texture coordinates after the last field. "_ADF" for adf: names of
 * one's own begin with _. Returns whether there is one. */
static bool attribute_at(attribute *a, const mesh *m, const mesh_extra *extra, int k) {
    const bool is_field = k < extra->n_fields;
    if (k > extra->n_fields || (!is_field && extra->uv == NULL)) {
        return false;
    }
    (void)snprintf(a->name, sizeof a->name, is_field ? "_%s" : "%s",
                   is_field ? extra->fields[k].name : "TEXCOORD_0");
    for (char *c = a->name; *c != '\0'; c++) {
        *c = (char)toupper((unsigned char)*c);
    }
    a->value = is_field ? extra->fields[k].value : extra->uv;
    a->width = is_field ? 1 : 2;
    a->has_gaps = mesh_missing(a->value, a->width, m->n_vertices) > 0;
    return true;
}

/* Positions need their bounds, as they are in single precision. */
static void describe_positions(layout *l, const mesh *m, const single_frame *frame) {
    double low[3] = {0, 0, 0}, high[3] = {0, 0, 0};
    char more[300];
    for (size_t k = 0; k < 3 * (size_t)m->n_vertices; k++) {
        const double x = (double)single_frame_coordinate(frame, m, k);
        low[k % 3] = k < 3 || x < low[k % 3] ? x : low[k % 3];
        high[k % 3] = k < 3 || x > high[k % 3] ? x : high[k % 3];
    }
    (void)snprintf(more, sizeof more,
                   "\"componentType\":5126,\"type\":\"VEC3\",\"min\":[%.17g,%.17g,%.17g],"
                   "\"max\":[%.17g,%.17g,%.17g]",
                   low[0], low[1], low[2], high[0], high[1], high[2]);
    describe(l, "POSITION", m->n_vertices, 12, more);
}

/* All arrays, in the order in which put_arrays writes them. */
static void describe_arrays(layout *l, const mesh *m, const mesh_extra *extra,
                            const single_frame *frame) {
    static const char scalars[] = "\"componentType\":5126,\"type\":\"SCALAR\"";
    attribute a;
    char mask[80];
    if (m->n_faces > 0) {
        describe(l, NULL, 3 * (int64_t)m->n_faces, 4, "\"componentType\":5125,\"type\":\"SCALAR\"");
    }
    describe_positions(l, m, frame);
    for (int k = 0; attribute_at(&a, m, extra, k); k++) {
        describe(l, a.name, m->n_vertices, 4 * a.width,
                 a.width == 1 ? scalars : "\"componentType\":5126,\"type\":\"VEC2\"");
        (void)snprintf(mask, sizeof mask, "_HAS%s%s", a.name[0] == '_' ? "" : "_", a.name);
        if (a.has_gaps) {
            describe(l, mask, m->n_vertices, 4, scalars);
        }
    }
    if (extra->color != NULL) {
        describe(l, "COLOR_0", m->n_vertices, 4,
                 "\"componentType\":5121,\"type\":\"VEC4\",\"normalized\":true");
    }
}

static void put_arrays(bytes *b, const mesh *m, const mesh_extra *extra,
                       const single_frame *frame) {
    const size_t n = (size_t)m->n_vertices;
    attribute a;
    for (size_t k = 0; k < 3 * (size_t)m->n_faces; k++) {
        put_word(b, (uint32_t)m->faces[k]);
    }
    for (size_t k = 0; k < 3 * n; k++) {
        put_float(b, (double)single_frame_coordinate(frame, m, k));
    }
    for (int i = 0; attribute_at(&a, m, extra, i); i++) {
        const size_t width = (size_t)a.width;
        for (size_t k = 0; k < width * n; k++) {
            put_float(b, a.value[k]);
        }
        for (size_t v = 0; v < n && a.has_gaps; v++) {
            put_float(b, mesh_missing(a.value + width * v, a.width, 1) > 0 ? 0 : 1);
        }
    }
    for (size_t v = 0; extra->color != NULL && v < n; v++) {
        const rgb c = extra->color[v];
        put_word(b, (uint32_t)c.r | (uint32_t)c.g << 8 | (uint32_t)c.b << 16 | 0xFF000000u);
    }
}

/* The document up to the buffer, whose data URI may follow. A mesh without faces is one of points,
 * and one without vertices an empty scene. */
static void write_document(text *t, const layout *l, const mesh *m, const single_frame *frame) {
    const double *c = frame->center;
    add(t, "{\"asset\":{\"version\":\"2.0\",\"generator\":\"sparse-local\"},\"scene\":0,"
           "\"scenes\":[{");
    if (m->n_vertices == 0) {
        add(t, "}]}");
        return;
    }
    add(t, "\"nodes\":[0]}],\"nodes\":[{\"mesh\":0");
    if (!single_frame_is_identity(frame)) {
        add(t, ",\"translation\":[%.17g,%.17g,%.17g],\"scale\":[%.17g,%.17g,%.17g]", c[0], c[1],
            c[2], frame->scale, frame->scale, frame->scale);
    }
    add(t, "}],\"meshes\":[{\"primitives\":[{");
    add(t, m->n_faces > 0 ? "\"indices\":0,\"attributes\":{" : "\"mode\":0,\"attributes\":{");
    append(t, l->attributes.at, l->attributes.used);
    add(t, "}}]}],\"bufferViews\":[");
    append(t, l->views.at, l->views.used);
    add(t, "],\"accessors\":[");
    append(t, l->accessors.at, l->accessors.used);
    add(t, "],\"buffers\":[{\"byteLength\":%lld", (long long)l->length);
}

void mesh_write_gltf(mesh_sink *s, const mesh *m, const mesh_extra *extra, bool is_container) {
    layout l;
    text t = {NULL, 0, 0, false};
    bytes b = {s, !is_container, 0, 0};
    const single_frame frame = single_frame_of(m);
    memset(&l, 0, sizeof l);
    const bool has_data = m->n_vertices > 0;
    describe_arrays(&l, m, extra, &frame);
    write_document(&t, &l, m, &frame);
    add(&t, is_container && has_data ? "}]}" : "");
    while (is_container && t.used % 4 != 0 && !t.failed) {
        add(&t, " "); /* chunks have multiples of 4 bytes; those of the arrays are */
    }
    const int64_t total = 20 + (int64_t)t.used + (has_data ? 8 + l.length : 0);
    s->failed = s->failed || t.failed || l.views.failed || l.accessors.failed ||
                l.attributes.failed || (is_container && total > UINT32_MAX);
    if (s->failed) { /* nothing is written */
    } else if (is_container) {
        const uint32_t header[5] = {0x46546C67, 2, (uint32_t)total, (uint32_t)t.used, 0x4E4F534A};
        for (int k = 0; k < 5; k++) {
            put_word(&b, header[k]);
        }
        sink_put(s, t.at, t.used);
        if (has_data) {
            put_word(&b, (uint32_t)l.length);
            put_word(&b, 0x004E4942);
            put_arrays(&b, m, extra, &frame);
        }
    } else {
        sink_put(s, t.at, t.used);
        if (has_data) {
            sink_print(s, ",\"uri\":\"data:application/octet-stream;base64,");
            put_arrays(&b, m, extra, &frame);
            end_bytes(&b, l.length);
            sink_print(s, "\"}]}\n");
        }
    }
    free(t.at);
    free(l.views.at);
    free(l.accessors.at);
    free(l.attributes.at);
}

/* mesh.c: reads triangle meshes: selects the format, collects vertices and faces, checks indices */
#include "mesh.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "mesh_build.h"
#include "polygon_ears.h"

bool mesh_faces_are_in_range(const mesh *m) {
    for (size_t k = 0; k < 3 * (size_t)m->n_faces; k++) {
        if (m->faces[k] < 0 || m->faces[k] >= m->n_vertices) {
            return false;
        }
    }
    return true;
}

void mesh_free(mesh *m) {
    if (m != NULL) {
        free(m->xyz);
        free(m->faces);
        memset(m, 0, sizeof *m);
    }
}

/* Ensures room for `more` elements after `count`, by doubling.
 * Returns the array, moved or not; NULL: out of memory, the old array is still valid. */
static void *grow_array(void *array, size_t *capacity, size_t count, size_t more, size_t element) {
    if (count + more <= *capacity && array != NULL) {
        return array;
    }
    size_t wanted = 2 * *capacity > count + more ? 2 * *capacity : count + more;
    wanted = wanted < 64 ? 64 : wanted;
    void *larger = wanted <= SIZE_MAX / element ? realloc(array, wanted * element) : NULL;
    if (larger != NULL) {
        *capacity = wanted;
    }
    return larger;
}

bool mesh_build_vertex(mesh_build *b, double x, double y, double z) {
    if (!isfinite(x) || !isfinite(y) || !isfinite(z)) {
        return input_error(b->in, "vertex %d: a coordinate is not finite",
                           (int)b->result.n_vertices);
    }
    if (b->result.n_vertices == INT32_MAX) {
        return input_error(b->in, "more than 2^31-1 vertices");
    }
    size_t count = (size_t)b->result.n_vertices;
    double *xyz =
        (double *)grow_array(b->result.xyz, &b->vertex_capacity, count, 1, 3 * sizeof *xyz);
    if (xyz == NULL) {
        return input_error(b->in, "out of memory");
    }
    b->result.xyz = xyz;
    xyz[3 * count] = x;
    xyz[3 * count + 1] = y;
    xyz[3 * count + 2] = z;
    b->result.n_vertices++;
    return true;
}

bool mesh_build_corner(mesh_build *b, int64_t vertex) {
    if (vertex < 0 || vertex >= INT32_MAX) {
        return input_error(b->in, "face %lld: vertex %lld (counted from 0) is out of range",
                           (long long)b->polygons, (long long)vertex);
    }
    sl_int *corners =
        (sl_int *)grow_array(b->corners, &b->corner_capacity, b->n_corners, 1, sizeof *corners);
    if (corners == NULL) {
        return input_error(b->in, "out of memory");
    }
    b->corners = corners;
    corners[b->n_corners++] = (sl_int)vertex;
    if ((sl_int)vertex > b->largest) {
        b->largest = (sl_int)vertex;
        b->largest_line = b->in->line;
        b->largest_face = b->polygons;
    }
    return true;
}

/* Returns room for the triangles of the current polygon, NULL on error. */
static sl_int *room_for_triangles(mesh_build *b) {
    if (b->n_corners < 3) {
        (void)input_error(b->in, "face %lld has %d corners; 3 or more are needed",
                          (long long)b->polygons, (int)b->n_corners);
        return NULL;
    }
    size_t count = (size_t)b->result.n_faces;
    size_t more = b->n_corners - 2;
    if (more > (size_t)INT32_MAX - count) {
        (void)input_error(b->in, "more than 2^31-1 triangles");
        return NULL;
    }
    sl_int *faces =
        (sl_int *)grow_array(b->result.faces, &b->face_capacity, count, more, 3 * sizeof *faces);
    if (faces == NULL) {
        (void)input_error(b->in, "out of memory");
        return NULL;
    }
    b->result.faces = faces;
    return faces + 3 * count;
}

/* Ends the current polygon, which has become `count` triangles. */
static bool end_polygon(mesh_build *b, size_t count) {
    b->result.n_faces += (sl_int)count;
    b->n_corners = 0;
    b->polygons++;
    return true;
}

/* Keeps where the triangles of a polygon are: its vertices may come later. */
static bool note_polygon(mesh_build *b) {
    if (b->n_corners == 3) {
        return true;
    }
    sl_int *polygon =
        (sl_int *)grow_array(b->polygon, &b->polygon_capacity, b->n_polygon, 2, sizeof *polygon);
    if (polygon == NULL) {
        return input_error(b->in, "out of memory");
    }
    b->polygon = polygon;
    polygon[b->n_polygon++] = b->result.n_faces;
    polygon[b->n_polygon++] = (sl_int)(b->n_corners - 2);
    return true;
}

bool mesh_build_polygon(mesh_build *b) {
    sl_int *face = room_for_triangles(b);
    for (size_t k = 2; face != NULL && k < b->n_corners; k++, face += 3) {
        face[0] = b->corners[0];
        face[1] = b->corners[k - 1];
        face[2] = b->corners[k];
    }
    return face != NULL && note_polygon(b) && end_polygon(b, b->n_corners - 2);
}

bool mesh_build_strip(mesh_build *b) {
    size_t count = 0;
    sl_int *face = room_for_triangles(b);
    for (size_t k = 2; face != NULL && k < b->n_corners; k++) {
        const sl_int *c = b->corners + k - 2;
        if (c[0] != c[1] && c[1] != c[2] && c[2] != c[0]) {
            face[3 * count] = c[k % 2];
            face[3 * count + 1] = c[1 - k % 2];
            face[3 * count++ + 2] = c[2];
        }
    }
    return face != NULL && end_polygon(b, count);
}

/* Appends to a text of `size` bytes, after a separator of two characters. */
static void append(char *text, size_t size, const char *between, const char *format, va_list list) {
    const size_t used = strlen(text);
    const size_t gap = used > 0 && used + 3 < size ? 2 : 0;
    memcpy(text + used, between, gap);
    (void)vsnprintf(text + used + gap, size - used - gap, format, list);
}

void mesh_build_note(mesh_build *b, const char *format, ...) {
    va_list list;
    va_start(list, format);
    append(b->note, sizeof b->note, "; ", format, list);
    va_end(list);
}

void mesh_build_leave(mesh_build *b, const char *format, ...) {
    va_list list;
    va_start(list, format);
    append(b->left, sizeof b->left, ", ", format, list);
    va_end(list);
}

bool mesh_build_is_in_range(mesh_build *b) {
    if (b->largest < b->result.n_vertices) {
        return true;
    }
    b->in->line = b->largest_line;
    return input_error(
        b->in, "face %lld: vertex %d (counted from 0) is out of range: the mesh has %d vertices",
        (long long)b->largest_face, (int)b->largest, (int)b->result.n_vertices);
}

/* Divides the polygons that are not convex by ears where their fans turn triangles over. */
static bool cut_ears(mesh_build *b) {
    const double most_work = 0x1p33; /* squares of corners: seconds */
    const mesh *m = &b->result;
    int64_t crossed = 0;
    double work = 0;
    for (size_t k = 0; k < b->n_polygon; k += 2) {
        const double corners = (double)b->polygon[k + 1] + 2;
        sl_int *faces = m->faces + 3 * (size_t)b->polygon[k];
        const ears_result r = ears_instead_of_fan(faces, (size_t)b->polygon[k + 1] + 2, m->xyz);
        if (r == EARS_NO_MEMORY) {
            b->in->line = 0;
            return input_error(b->in, "out of memory");
        }
        crossed += r == EARS_IMPOSSIBLE;
        work += r == EARS_FAN ? 0 : corners * corners;
        if (r == EARS_TOO_LARGE || work > most_work) {
            b->in->line = 0;
            return input_error(b->in,
                               "polygons of %.0f corners that are not convex: at most %d corners "
                               "are divided into triangles, and at most 128 polygons of so many; "
                               "divide them before",
                               corners, (int)EARS_CORNERS_MAX);
        }
    }
    if (crossed > 0) {
        mesh_build_note(b,
                        "%lld polygons cross themselves: some of their triangles are turned over",
                        (long long)crossed);
    }
    return true;
}

/* The ending of a file name for what standard input begins with; OBJ has no sign of its own. */
static const char *ending_of(const input *in) {
    static const struct {
        const char *start, *ending;
    } signs[] = {{"ply", ".ply"},   {"# vtk", ".vtk"}, {"glTF", ".glb"}, {"{", ".gltf"},
                 {"solid", ".stl"}, {"OFF", ".off"},   {"off", ".off"},  {"COFF", ".off"},
                 {"NOFF", ".off"},  {"STOFF", ".off"}};
    for (size_t k = 0; k < sizeof signs / sizeof *signs; k++) {
        if (strncmp(in->at, signs[k].start, strlen(signs[k].start)) == 0) {
            return signs[k].ending;
        }
    }
    return memchr(in->at, 0, (size_t)(in->end - in->at)) != NULL ? ".stl" : ".obj";
}

bool mesh_read(mesh *out, const char *path, char *message, size_t message_size) {
    return mesh_read_noting(out, path, message, message_size, NULL, 0);
}

bool mesh_read_noting(mesh *out, const char *path, char *message, size_t message_size, char *note,
                      size_t note_size) {
    char left[2];
    return mesh_read_telling(out, path, message, message_size, note, note_size, left, sizeof left);
}

bool mesh_read_telling(mesh *out, const char *path, char *message, size_t message_size, char *note,
                       size_t note_size, char *left, size_t left_size) {
    static const struct {
        const char *ending;
        bool (*read)(mesh_build *b);
    } formats[] = {{".obj", mesh_read_obj},  {".off", mesh_read_off}, {".ply", mesh_read_ply},
                   {".stl", mesh_read_stl},  {".vtk", mesh_read_vtk}, {".glb", mesh_read_gltf},
                   {".gltf", mesh_read_gltf}};
    memset(out, 0, sizeof *out);
    left[0] = '\0';
    if (note_size > 0) {
        note[0] = '\0';
    }
    input in;
    if (!input_open(&in, path, message, message_size)) {
        return false;
    }
    mesh_build b;
    memset(&b, 0, sizeof b);
    b.in = &in;
    b.largest = -1;
    bool known = false;
    bool ok = false;
    const char *name = strcmp(path, "-") == 0 ? ending_of(&in) : path;
    for (size_t k = 0; k < sizeof formats / sizeof formats[0] && !known; k++) {
        known = input_path_ends(name, formats[k].ending);
        ok = known && formats[k].read(&b) && mesh_build_is_in_range(&b) && cut_ears(&b);
    }
    if (!known) {
        in.line = 0;
        (void)input_error(&in, "unknown mesh format: the name must end in .obj, .off, .ply, .stl, "
                               ".vtk, .glb or .gltf, optionally followed by .gz");
    }
    free(b.corners);
    free(b.polygon);
    input_close(&in);
    if (ok) {
        *out = b.result;
        if (b.n_polygon > 0) {
            mesh_build_leave(&b, "polygons of more than three corners");
        }
        (void)snprintf(left, left_size, "%s", b.left);
        if (note_size > 0 && b.note[0] != '\0') {
            (void)snprintf(note, note_size, "%s: %s", path, b.note);
        }
    } else {
        mesh_free(&b.result);
    }
    return ok;
}

/* app_files.c: input and output shared by all commands: meshes, vertex lists, tables */
#include "app.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>

#include "tools/geometry/laplacian.h"
#include "tools/io/output_file.h"
#include "tools/mesh/surface_generator.h"

const char app_mesh_help[] =
    "a mesh file (.obj, .off, .ply, .stl, .vtk, .glb, .gltf, optionally .gz) or a generated "
    "surface: "
    "grid:100x100, hills:100x100, sphere:5, blob:5, star:5, torus:120x40, knot:400x24.";

void app_mesh(mesh *out, const char *operand, bool faces_needed) {
    char message[512], note[512] = "";
    bool made = surface_is_specification(operand);
    if (made ? !surface_generate(out, operand, message, sizeof message)
             : !mesh_read_noting(out, operand, message, sizeof message, note, sizeof note)) {
        app_die("%s", message);
    }
    if (note[0] != '\0') {
        app_warn("%s", note);
    }
    if (faces_needed && out->n_faces == 0) {
        app_die("%s: has no faces, only %d vertices; this command needs a surface", operand,
                (int)out->n_vertices);
    }
}

bool app_is_saved(const char *operand) {
    const size_t length = strlen(operand);
    return length > 4 && strcmp(operand + length - 4, ".slf") == 0;
}

/* Reads a vertex number at *text and advances *text past it. */
static sl_int read_vertex(const char *option_name, const char **text, sl_int n) {
    char *after = NULL;
    errno = 0;
    long v = strtol(*text, &after, 10);
    if (after == *text || **text == '+' || **text == '-') {
        app_die_usage("--%s: \"%s\" is not a list of vertices (3,17,100-200 or all or random:5)",
                      option_name, *text);
    }
    if (errno != 0 || v >= n) {
        app_die("--%s: there is no vertex %.*s; the last one is %d", option_name,
                (int)(after - *text), *text, (int)n - 1);
    }
    *text = after;
    return (sl_int)v;
}

/* Names the vertices that were drawn, so that a run can be repeated with a part of them. */
static void print_drawn(const char *option_name, const sl_int *vertices, sl_int count) {
    enum { SHOWN = 200 };
    printf("drawn      --%s ", option_name);
    for (sl_int k = 0; k < count && k < SHOWN; k++) {
        printf(k > 0 ? ",%d" : "%d", (int)vertices[k]);
    }
    if (count > SHOWN) {
        printf(" and %d more", (int)(count - SHOWN));
    }
    printf("\n");
}

static sl_int *random_vertices(const char *option_name, const char *text, sl_int n, uint64_t seed,
                               sl_int *count) {
    char *after = NULL;
    long wanted = strtol(text, &after, 10);
    if (after == text || *after != '\0' || wanted < 1 || wanted > n) {
        app_die_usage("--%s random:%s: expected a number from 1 to %d", option_name, text, (int)n);
    }
    sl_int *all = app_alloc((size_t)n, sizeof *all);
    for (sl_int v = 0; v < n; v++) {
        all[v] = v;
    }
    for (sl_int k = 0; k < wanted; k++) {
        sl_int from = k + app_random_below(&seed, n - k);
        sl_int v = all[from];
        all[from] = all[k];
        all[k] = v;
    }
    *count = (sl_int)wanted;
    print_drawn(option_name, all, *count);
    return all;
}

sl_int *app_vertices(const char *option_name, const char *text, sl_int n, uint64_t seed,
                     sl_int *count) {
    if (strncmp(text, "random:", 7) == 0) {
        return random_vertices(option_name, text + 7, n, seed, count);
    }
    bool all = strcmp(text, "all") == 0;
    size_t capacity = all ? (size_t)n : 0;
    sl_int *list = app_alloc(capacity, sizeof *list);
    sl_int used = 0;
    for (; all && used < n; used++) {
        list[used] = used;
    }
    while (!all) {
        sl_int first = read_vertex(option_name, &text, n);
        sl_int last = first;
        if (*text == '-') {
            text++;
            last = read_vertex(option_name, &text, n);
        }
        if (last < first || last - first >= INT32_MAX - used) {
            app_die_usage("--%s: %d-%d is an empty range or makes the list too long", option_name,
                          (int)first, (int)last);
        }
        size_t needed = (size_t)used + (size_t)(last - first) + 1;
        if (needed > capacity) {
            capacity = 2 * needed;
            sl_int *larger = realloc(list, capacity * sizeof *list);
            if (larger == NULL) {
                app_die("out of memory");
            }
            list = larger;
        }
        for (sl_int v = first; v <= last; v++) {
            list[used++] = v;
        }
        if (*text == '\0') {
            break;
        }
        if (*text++ != ',') {
            app_die_usage("--%s: \"%s\": expected a comma between vertices", option_name, text - 1);
        }
    }
    *count = used;
    return list;
}

sl_int app_distinct(sl_int *vertices, sl_int count, sl_int n) {
    unsigned char *seen = app_alloc((size_t)n, 1);
    sl_int kept = 0;
    for (sl_int k = 0; k < count; k++) {
        if (!seen[vertices[k]]) {
            seen[vertices[k]] = 1;
            vertices[kept++] = vertices[k];
        }
    }
    free(seen);
    return kept;
}

FILE *app_create(const char *path) {
    char message[512];
    FILE *file = output_open(path, message, sizeof message);
    if (file == NULL) {
        app_die("%s", message);
    }
    return file;
}

void app_close(FILE *file) {
    char message[512];
    if (!output_close(file, message, sizeof message)) {
        app_die("%s", message);
    }
}

sl_int app_default_vertex(const mesh *m) {
    sl_int first = INT32_MAX, any = INT32_MAX;
    for (size_t f = 0; f < (size_t)m->n_faces; f++) {
        const sl_int *v = m->faces + 3 * f;
        sl_int least = v[0] < v[1] ? v[0] : v[1];
        least = v[2] < least ? v[2] : least;
        any = least < any ? least : any;
        if (least < first && laplacian_of_face(m, v).area > 0) {
            first = least;
        }
    }
    return first < INT32_MAX ? first : any < INT32_MAX ? any : 0;
}

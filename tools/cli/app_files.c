/* app_files.c: input and output shared by all commands: meshes, vertex lists, tables */
#include "app.h"

#include <errno.h>
#include <math.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include "tools/geometry/laplacian.h"
#include "tools/io/input.h"
#include "tools/io/output_file.h"
#include "tools/mesh/coincident.h"
#include "tools/mesh/int_list.h"
#include "tools/mesh/surface_generator.h"

const char app_mesh_help[] =
    "a mesh file (.obj, .off, .ply, .stl, .vtk, .glb, .gltf, optionally .gz), - for a mesh "
    "from standard input, or a generated surface: "
    "grid:100x100, hills:100x100, sphere:5, blob:5, star:5, torus:120x40, knot:400x24.";

double app_weld = -1;
const char *app_weld_map = NULL;

/* Of --weld: the vertices of the file, and what each has become, of the `n` that are left. */
static struct { sl_int count, n, *map; } welded;

/* Writes the table of --weld-map. */
static void write_map(void) {
    FILE *csv = app_create(app_weld_map);
    fprintf(csv, "vertex,merged\n");
    for (sl_int v = 0; v < welded.count; v++) {
        fprintf(csv, "%d,%d\n", (int)v, (int)welded.map[v]);
    }
    app_close(csv);
}

/* Merges vertices of a mesh if the option asks for it, or warns of those that could be. */
static void weld(mesh *m, const char *operand, bool is_file) {
    coincident_merged merged;
    const sl_int count = app_weld < 0 && is_file ? coincident_count(m) : 0;
    welded.count = m->n_vertices;
    free(welded.map);
    welded.map = NULL;
    if (count < 0 || (app_weld >= 0 && !coincident_merge(m, &merged, &welded.map, app_weld))) {
        app_die("%s: out of memory for vertices at the same place", operand);
    }
    welded.n = m->n_vertices;
    if (app_weld < 0 && app_weld_map != NULL) {
        app_die_usage("--weld-map: only with --weld");
    }
    if (app_weld_map != NULL) {
        write_map();
    }
    if (app_weld >= 0) {
        printf("%d vertices are merged with others; %d faces that lost a corner are left out.\n",
               (int)merged.vertices, (int)merged.faces);
    } else if (count > 0) {
        app_warn("%s: %d of %d vertices have the coordinates of others, and faces at them are "
                 "not joined; --weld merges them",
                 operand, (int)count, (int)m->n_vertices);
    }
}

const char *app_source = NULL;

/* What the file of the last mesh has and no mesh has, and its name; NULL: no file. */
static char left[200];
static const char *left_of;

void app_print_left(const char *out, const mesh_extra *extra) {
    if (left_of != NULL && left[0] != '\0' && !mesh_write_keeps_source(out, extra)) {
        printf("%s has triangles only; left out of %s: %s.\n", out, left_of, left);
    }
}

void app_mesh(mesh *out, const char *operand, bool faces_needed) {
    char message[512], note[512] = "";
    bool made = surface_is_specification(operand);
    if (made ? !surface_generate(out, operand, message, sizeof message)
             : !mesh_read_telling(out, operand, message, sizeof message, note, sizeof note, left,
                                  sizeof left)) {
        app_die("%s", message);
    }
    if (note[0] != '\0') {
        app_warn("%s", note);
    }
    left_of = made ? NULL : operand;
    weld(out, operand, !made);
    app_source = made || app_weld >= 0 || strcmp(operand, "-") == 0 ? NULL : operand;
    if (faces_needed && out->n_faces == 0) {
        app_die("%s: has no faces, only %d vertices; this command needs a surface", operand,
                (int)out->n_vertices);
    }
}

double app_mean_edge_length(const mesh *m) {
    const double length = mesh_mean_edge_length(m);
    if (isnan(length)) {
        app_die("out of memory for the edges of %d vertices", (int)m->n_vertices);
    }
    return length;
}

bool app_is_saved(const char *operand) {
    const size_t length = strlen(operand);
    return length > 4 && strcmp(operand + length - 4, ".slf") == 0;
}

void app_refuse_weld(const char *operand) {
    if (app_weld >= 0) {
        app_die_usage("%s: a saved factor has no mesh for --weld", operand);
    }
}

/* A list of vertices that is being read, and what is wrong with it. */
typedef struct list_reader {
    const char *at; /* the text that is left */
    sl_int n;
    int_list list;
    char *message;
    size_t message_size;
} list_reader;

APP_PRINTF_OF(3)
static int refuse(const list_reader *r, int status, const char *format, ...) {
    va_list arguments;
    va_start(arguments, format);
    (void)vsnprintf(r->message, r->message_size, format, arguments);
    va_end(arguments);
    return status;
}

/* Reads a vertex number and advances past it. Returns 0 or the exit status. */
static int read_vertex(list_reader *r, sl_int *vertex) {
    char *after = NULL;
    errno = 0;
    long v = strtol(r->at, &after, 10);
    if (*r->at < '0' || *r->at > '9') { /* a blank or a sign, which strtol accepts, too */
        return refuse(r, 2, "\"%.80s\" is not a list of vertices such as 3,17,100-200", r->at);
    }
    if (errno != 0 || v >= r->n) {
        return refuse(r, 1, "there is no vertex %.*s; the last one is %d", (int)(after - r->at),
                      r->at, (int)r->n - 1);
    }
    r->at = after;
    *vertex = (sl_int)v;
    return 0;
}

/* Adds the vertices first .. last. */
static int add_range(list_reader *r, sl_int first, sl_int last) {
    if (last < first || (size_t)(last - first) >= INT32_MAX - r->list.count) {
        return refuse(r, 2, "%d-%d is an empty range or makes the list too long", (int)first,
                      (int)last);
    }
    for (sl_int v = first; v <= last; v++) {
        if (!int_list_add(&r->list, v)) {
            return refuse(r, 1, "out of memory for the list");
        }
    }
    return 0;
}

static int read_ranges(list_reader *r) {
    for (;;) {
        sl_int first = 0;
        int status = read_vertex(r, &first);
        sl_int last = first;
        if (status == 0 && *r->at == '-') {
            r->at++;
            status = read_vertex(r, &last);
        }
        status = status == 0 ? add_range(r, first, last) : status;
        if (status != 0 || *r->at == '\0') {
            return status;
        }
        if (*r->at++ != ',') {
            return refuse(r, 2, "\"%.80s\": expected a comma between vertices", r->at - 1);
        }
    }
}

int app_read_vertices(sl_int **out, sl_int *count, const char *text, sl_int n, char *message,
                      size_t message_size) {
    list_reader r = {text, n, {NULL, 0, 0}, message, message_size};
    const bool all = strcmp(text, "all") == 0;
    const int status = !all ? read_ranges(&r) : n > 0 ? add_range(&r, 0, n - 1) : 0;
    if (status != 0) {
        free(r.list.at);
        r.list.at = NULL;
        r.list.count = 0;
    }
    *out = r.list.at;
    *count = (sl_int)r.list.count;
    return status;
}

/* Names the vertices that were drawn, so that a run can be repeated with a part of them. */
static void print_drawn(const char *option_name, const sl_int *vertices, sl_int count) {
    enum { SHOWN = 200 };
    app_detail("drawn      --%s ", option_name);
    for (sl_int k = 0; k < count && k < SHOWN; k++) {
        app_detail(k > 0 ? ",%d" : "%d", (int)vertices[k]);
    }
    if (count > SHOWN) {
        app_detail(" and %d more", (int)(count - SHOWN));
    }
    app_detail("\n");
}

static sl_int *random_vertices(const char *option_name, const char *text, sl_int n, uint64_t seed,
                               sl_int *count) {
    char *after = NULL;
    long wanted = *text >= '0' && *text <= '9' ? strtol(text, &after, 10) : 0;
    if (wanted < 1 || wanted > n || *after != '\0') {
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
    char *copy = app_list_text(option_name, text);
    for (char *c = copy; text[0] == '@' && *c != '\0'; c++) {
        *c = *c == ';' ? ',' : *c;
    }
    sl_int *list = app_vertices_in_order(option_name, copy, n, count);
    const bool is_mapped = welded.map != NULL && n == welded.n && strcmp(copy, "all") != 0;
    *count = is_mapped ? app_distinct(list, *count, n) : *count;
    free(copy);
    return list;
}

char *app_list_text(const char *option_name, const char *text) {
    char message[512] = "";
    input in;
    if (text[0] != '@') {
        const size_t size = strlen(text) + 1;
        char *copy = app_alloc(size, 1);
        memcpy(copy, text, size);
        return copy;
    }
    if (!input_open(&in, text + 1, message, sizeof message)) {
        app_die("--%s: %s", option_name, message);
    }
    char *list = app_alloc((size_t)(in.end - in.data) + 1, 1), *to = list;
    bool in_comment = false;
    for (const char *c = in.data; c < in.end; c++) {
        const bool is_end = *c == '\n' || *c == '\r';
        in_comment = !is_end && (in_comment || *c == '#');
        if (!in_comment && strchr(" \t\n\r,", *c) == NULL) {
            *to++ = *c;
        } else if (is_end && to > list) {
            to -= strchr(",;", to[-1]) != NULL;
            *to++ = ';';
        } else if (to > list && strchr(",;", to[-1]) == NULL) {
            *to++ = ',';
        }
    }
    while (to > list && strchr(",;", to[-1]) != NULL) {
        *--to = '\0';
    }
    input_close(&in);
    return list;
}

sl_int *app_vertices_in_order(const char *option_name, const char *text, sl_int n, sl_int *count) {
    char message[512];
    sl_int *list;
    const bool is_mapped = welded.map != NULL && n == welded.n && strcmp(text, "all") != 0;
    const int status = app_read_vertices(&list, count, text, is_mapped ? welded.count : n, message,
                                         sizeof message);
    if (status == 2) {
        app_die_usage("--%s: %s", option_name, message);
    }
    if (status != 0) {
        app_die("--%s: %s", option_name, message);
    }
    for (sl_int k = 0; k < *count && is_mapped; k++) {
        list[k] = welded.map[list[k]];
    }
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

/* The smallest vertex of the part of v; links lead to smaller vertices of the same part. */
static sl_int root_of(sl_int *part, sl_int v) {
    while (part[v] != v) {
        v = part[v] = part[part[v]];
    }
    return v;
}

/* Joins the vertices of each face. */
static sl_int *parts_of(const mesh *m) {
    sl_int *part = app_alloc((size_t)m->n_vertices, sizeof *part);
    for (sl_int v = 0; v < m->n_vertices; v++) {
        part[v] = v;
    }
    for (size_t k = 0; k < 3 * (size_t)m->n_faces; k++) {
        const sl_int a = root_of(part, m->faces[k]), b = root_of(part, m->faces[k - k % 3]);
        part[a > b ? a : b] = a > b ? b : a;
    }
    return part;
}

sl_int app_default_vertex(const mesh *m) {
    sl_int first = INT32_MAX, any = INT32_MAX, largest = -1;
    sl_int *part = parts_of(m);
    double *area = app_alloc((size_t)m->n_vertices, sizeof *area); /* of the part of a root */
    for (size_t f = 0; f < (size_t)m->n_faces; f++) {
        const sl_int root = root_of(part, m->faces[3 * f]);
        area[root] += laplacian_of_face(m, m->faces + 3 * f).area;
        largest = area[root] > 0 && (largest < 0 || area[root] > area[largest]) ? root : largest;
    }
    for (size_t f = 0; f < (size_t)m->n_faces; f++) {
        const sl_int *v = m->faces + 3 * f;
        sl_int least = v[0] < v[1] ? v[0] : v[1];
        least = v[2] < least ? v[2] : least;
        any = least < any ? least : any;
        if (least < first && root_of(part, v[0]) == largest && laplacian_of_face(m, v).area > 0) {
            first = least;
        }
    }
    free(area);
    free(part);
    return first < INT32_MAX ? first : any < INT32_MAX ? any : 0;
}

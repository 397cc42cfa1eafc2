/* command_view.c: a mesh and the tables of other commands as an HTML page to turn and to query */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "app.h"
#include "command.h"
#include "heat_system.h"
#include "laplacian_choice.h"
#include "tools/draw/view_page.h"
#include "tools/io/field_table.h"
#include "tools/mesh/repeated_faces.h"

enum { MOST_TABLES = 31 };

static const options_usage usage = {
    "view", "MESH [TABLE.csv ...]", 1, 1 + MOST_TABLES,
    "Writes a page that shows a mesh in a browser: it turns, and a click shows vertex and value."};

static const options_manual manual = {
    "The tables are those that heat, adf, hks and geodesic write with --csv. Each column is a "
    "field that the page can show, as colors with a legend, on a linear or a logarithmic scale or "
    "on quantiles, with or without isolines; it opens on the first of these scales on which "
    "most values differ in color. Vertices without a value are gray. The page is one file: it "
    "loads nothing from the network and can be sent to others. It needs a browser with WebGL 2.\n"
    "With --live the page has three more fields, which it computes itself and which follow when "
    "the "
    "first marked vertex is dragged: heat from there; distances by the heat method, without the "
    "comparison with paths; and the harmonic function that is 1 there and 0 at the other marked "
    "vertices, or at the farthest one. The library, compiled to WebAssembly, is in the page; the "
    "program has it if it was built by make live.",
    "The page, and a line on what it holds.",
    "bunny.obj --out bunny.html\nbunny.obj heat.csv adf.csv --out bunny.html\n"
    "bunny.obj --live --from 17 --out bunny.html"};

/* The tables, and their columns one after another. */
typedef struct view_fields {
    field_table tables[MOST_TABLES];
    int n_tables;
    view_field *fields;
    char **names;
    size_t n_fields;
} view_fields;

/* "heat (heat.csv)" */
static char *field_name(const char *path, const char *column) {
    const char *slash = strrchr(path, '/'), *file = slash != NULL ? slash + 1 : path;
    const size_t size = strlen(file) + strlen(column) + 4;
    char *name = app_alloc(size, 1);
    (void)snprintf(name, size, "%s (%s)", column, file);
    return name;
}

static void read_tables(view_fields *f, const char *const *paths, sl_int n) {
    char message[512];
    size_t count = 0;
    memset(f, 0, sizeof *f);
    for (; f->n_tables < MOST_TABLES && paths[f->n_tables] != NULL; f->n_tables++) {
        field_table *table = &f->tables[f->n_tables];
        if (!field_table_read(table, paths[f->n_tables], n, message, sizeof message)) {
            app_die("%s", message);
        }
        count += table->n_fields;
    }
    f->fields = app_alloc(count + 1, sizeof *f->fields);
    f->names = app_alloc(count + 1, sizeof *f->names);
    for (int t = 0; t < f->n_tables; t++) {
        for (size_t k = 0; k < f->tables[t].n_fields; k++) {
            f->names[f->n_fields] = field_name(paths[t], f->tables[t].names[k]);
            f->fields[f->n_fields].name = f->names[f->n_fields];
            f->fields[f->n_fields++].value = f->tables[t].values[k];
        }
    }
}

static void free_tables(view_fields *f) {
    for (int t = 0; t < f->n_tables; t++) {
        field_table_free(&f->tables[t]);
    }
    for (size_t k = 0; k < f->n_fields; k++) {
        free(f->names[k]);
    }
    free(f->fields);
    free(f->names);
}

/* Where the first field begins: heat at its largest value, distances and paths at their smallest.
 * -1: it is another field, or has no value. */
static sl_int source_of(const view_fields *f, sl_int n) {
    const char *name = f->n_fields > 0 ? f->tables[0].names[0] : "";
    const bool is_heat = strcmp(name, "heat") == 0;
    sl_int source = -1;
    if (!is_heat && strcmp(name, "distance") != 0 && strcmp(name, "path") != 0) {
        return -1;
    }
    const double *value = f->fields[0].value;
    for (sl_int v = 0; v < n; v++) {
        if (isfinite(value[v]) &&
            (source < 0 || (is_heat ? value[v] > value[source] : value[v] < value[source]))) {
            source = v;
        }
    }
    return source;
}

/* The vertices of --from, or the source of the first field. Returns their number. */
static sl_int marked_vertices(sl_int **marked, const char *from, const view_fields *f, sl_int n) {
    sl_int count = 0;
    if (from != NULL) {
        *marked = app_vertices("from", from, n, 1, &count);
        return app_distinct(*marked, count, n);
    }
    *marked = app_alloc(1, sizeof **marked);
    **marked = source_of(f, n);
    return **marked >= 0;
}

/* The camera of pictures: on the side of the marked vertices. */
static void aim(double axes[3][3], app_output *camera, const mesh *m, const sl_int *marked,
                sl_int n_marked) {
    render_view view;
    app_set_up(camera, m, true);
    if (n_marked > 0) {
        app_aim_camera(camera, m, marked, n_marked, false);
    }
    app_view(&view, camera);
    render_axes(axes, &view, m);
}

/* Of each face, the lengths of the edges opposite to its corners. */
static double *edge_lengths(const mesh *m) {
    double *lengths = app_alloc(3 * (size_t)m->n_faces, sizeof *lengths);
    for (size_t k = 0; k < 3 * (size_t)m->n_faces; k++) {
        const sl_int *face = m->faces + 3 * (k / 3);
        const double *a = m->xyz + 3 * (size_t)face[(k + 1) % 3];
        const double *b = m->xyz + 3 * (size_t)face[(k + 2) % 3];
        lengths[k] = hypot(hypot(a[0] - b[0], a[1] - b[1]), a[2] - b[2]);
    }
    return lengths;
}

/* What a live page solves with. surface [out]: the Delaunay triangulation, if it is used; release
 * with intrinsic_free. */
static void prepare_live(view_live *live, intrinsic *surface, const mesh *m, heat_time *time) {
    if (time->time == 0 && time->scaled == 0 && time->area == 0) {
        time->scaled = 4; /* as for distances */
    }
    live->t = heat_time_value(time, m, 0);
    const bool is_intrinsic = laplacian_choose(surface, m, time->laplacian);
    live->surface = is_intrinsic ? &surface->m : m;
    live->share = is_intrinsic ? surface->share : 1;
    if (!is_intrinsic) {
        surface->lengths = edge_lengths(m);
    }
    live->lengths = surface->lengths;
}

int command_view(int argc, char **argv) {
    const char *operands[1 + MOST_TABLES + 1] = {NULL}, *out = NULL, *from = NULL;
    app_output camera;
    bool is_live = false;
    heat_time time = {0, 0, 0, NULL};
    memset(&camera, 0, sizeof camera);
    const option options[] = {
        {OPTION_OUTPUT, "out", &out, "FILE", "the page to write: required"},
        {OPTION_TEXT, "from", &from, "VERTICES",
         "vertices to mark, on whose side the camera is at first: 3,17,100-200 (where the first "
         "field is heat or a distance: its source)"},
        {OPTION_FLAG, "live", &is_live, NULL,
         "the page solves: heat, distances and a harmonic function from a vertex that is dragged"},
        HEAT_TIME_OPTIONS(&time, "with --live; otherwise S = 4"),
        APP_CAMERA_OPTIONS(&camera),
        APP_WELD_OPTION,
        {OPTION_END, NULL, NULL, NULL, NULL}};
    options_read(&usage, &manual, options, argc, argv, operands);
    app_check_output(&camera, NULL);
    if (is_live && view_live_kernel[0] == NULL) {
        app_die("view: --live: this program was built without the kernel that solves in browsers; "
                "make live builds both, by clang, lld and wasi-libc");
    }
    if (!is_live && (time.time != 0 || time.scaled != 0 || time.area != 0 || time.laplacian)) {
        app_die_usage("view: times and --laplacian are for --live");
    }
    mesh given, m;
    view_fields f;
    view_page page;
    view_live live;
    intrinsic surface;
    sl_int removed = 0, *marked;
    app_mesh(&given, operands[0], true);
    if (out == NULL) {
        app_die_usage("view: --out FILE is missing");
    }
    if (!mesh_without_repeated_faces(&m, &given, &removed)) {
        app_die("out of memory");
    }
    mesh_free(&given);
    read_tables(&f, operands + 1, m.n_vertices);
    memset(&page, 0, sizeof page);
    page.m = &m;
    page.title = operands[0];
    page.fields = f.fields;
    page.n_fields = f.n_fields;
    page.n_marked = marked_vertices(&marked, from, &f, m.n_vertices);
    page.marked = marked;
    if (is_live) {
        if (page.n_marked == 0) {
            *marked = app_default_vertex(&m);
            page.n_marked = 1;
        }
        prepare_live(&live, &surface, &m, &time);
        page.live = &live;
    }
    aim(page.axes, &camera, &m, marked, page.n_marked);
    app_stage("writing the page");
    FILE *file = app_create(out);
    view_page_write(file, &page);
    app_close(file);
    app_progress_end();
    printf("%s: %d vertices, %d faces, %d fields\n", out, (int)m.n_vertices, (int)m.n_faces,
           (int)f.n_fields);
    if (removed > 0) {
        printf("%d faces with the vertices of others are left out.\n", (int)removed);
    }
    if (is_live) {
        intrinsic_free(&surface);
    }
    free(marked);
    free_tables(&f);
    mesh_free(&m);
    return 0;
}

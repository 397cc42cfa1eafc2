/* command_reach.c: the columns of L that a local solve on a patch visits, as counts and pictures */
#include <stdlib.h>
#include <string.h>

#include "app.h"
#include "command.h"
#include "tools/draw/dissection.h"
#include "tools/draw/draw_graph.h"
#include "tools/draw/draw_tree.h"
#include "tools/geometry/laplacian.h"
#include "tools/mesh/adjacency.h"

static const options_usage usage = {"reach", "MESH", 1, 1,
                                    "Draws the columns of L that a local solve on a patch visits."};

static const options_manual manual = {
    "A local solve on a patch reads the columns of L on the paths from the patch to the root of "
    "the "
    "elimination tree, and no others (Figures 1 and 2 of the paper). The patch grows from a vertex "
    "by breadth-first search. Supernodes are not relaxed, so columns and entries are those of L "
    "itself.",
    "Number of columns and entries of L visited, and the sizes of the separators of the nested "
    "dissection by level. --png shows the patch (orange) and the other vertices visited (blue), "
    "--separators one color per level, --tree the elimination tree, --pattern P A P' and L. --csv "
    "has a row per vertex.",
    "star:6 --patch 2000 --center 100 --png reach.png --tree tree.svg\n"
    "grid:6x5 --center 7 --patch 3 --graph graph.svg --pattern pattern.png"};

enum { IN_PATCH = 0, VISITED = 1 }; /* color_of_kind: orange and blue */

typedef struct reach_options {
    const char *center, *separators, *tree, *pattern, *graph;
    sl_int size, levels;
} reach_options;

/* Analyzes without relaxation, so that columns and entries are those of L itself, as in the
 * paper. */
static sl_symbolic *analyze(const sl_csc *A) {
    sl_symbolic *S = NULL;
    sl_options opt;
    memset(&opt, 0, sizeof opt);
    opt.relaxation = SL_RELAXATION_NONE;
    app_must(sl_symbolic_create(&S, A, &opt, NULL), "analysis", NULL);
    return S;
}

static sl_int *grow_patch(const mesh *m, const reach_options *o, sl_int *count) {
    adjacency graph;
    char vertex[16];
    sl_int centers = 0;
    (void)snprintf(vertex, sizeof vertex, "%d", (int)app_default_vertex(m));
    sl_int *center =
        app_vertices("center", o->center != NULL ? o->center : vertex, m->n_vertices, 1, &centers);
    sl_int *patch = app_alloc((size_t)o->size, sizeof *patch);
    unsigned char *seen = app_alloc((size_t)m->n_vertices, 1);
    if (centers != 1) {
        app_die_usage("--center %s: expected one vertex", o->center);
    }
    if (!adjacency_from_mesh(&graph, m)) {
        app_die("out of memory for the graph of %d vertices", (int)m->n_vertices);
    }
    *count = adjacency_bfs(patch, o->size, &graph, center[0], seen);
    adjacency_free(&graph);
    free(seen);
    free(center);
    return patch;
}

/* Sets kind[k] of pivot k to IN_PATCH, VISITED or -1; returns the number of columns visited. Each
 * path is followed until it meets an earlier one, so the cost is the number of columns visited. */
static sl_int walk_paths(int *kind, const sl_symbolic_arrays *view, const sl_int *patch,
                         sl_int count) {
    sl_int visited = 0;
    for (sl_int k = 0; k < view->n; k++) {
        kind[k] = -1;
    }
    for (sl_int v = 0; v < count; v++) {
        for (sl_int k = view->iperm[patch[v]]; k >= 0 && kind[k] < 0; k = view->parent[k]) {
            kind[k] = VISITED;
            visited++;
        }
    }
    for (sl_int v = 0; v < count; v++) {
        kind[view->iperm[patch[v]]] = IN_PATCH;
    }
    return visited;
}

enum { MOST_KEYS = 20 };

static const rgb plain = {0xe6, 0xe3, 0xde};

/* The colors of a picture: the number of vertices of each kind, then those of none. Returns the
 * number of keys. name: of the kinds from 0 on; NULL: they are levels. */
static int keys_of(legend_key keys[MOST_KEYS], const int *kind, sl_int n, const char *const *name) {
    int count = 0, rest = 0;
    for (int k = 0; k < MOST_KEYS - 1; k++) {
        int of_kind = 0;
        for (sl_int i = 0; i < n; i++) {
            of_kind += kind[i] == k;
        }
        if (of_kind > 0) {
            keys[count].color = color_of_kind(k);
            if (name != NULL) {
                (void)snprintf(keys[count].text, sizeof keys->text, "%s\n%d", name[k], of_kind);
            } else {
                (void)snprintf(keys[count].text, sizeof keys->text, "level %d\n%d", k, of_kind);
            }
            count++;
        }
    }
    for (sl_int i = 0; i < n; i++) {
        rest += kind[i] < 0;
    }
    if (rest > 0) {
        keys[count].color = plain;
        (void)snprintf(keys[count].text, sizeof keys->text, "others\n%d", rest);
        count++;
    }
    return count;
}

/* What a picture of vertices shows: by pivot, a kind or -1, and the title and names of the
 * legend. */
typedef struct shown_kinds {
    const int *kind;
    const char *title;
    const char *const *name; /* of the kinds; NULL: they are levels */
} shown_kinds;

static void draw_vertices(const char *path, const app_output *output, const mesh *m,
                          const sl_symbolic_arrays *view, const shown_kinds *shown) {
    const int *kind = shown->kind;
    legend_key keys[MOST_KEYS];
    const int n_keys = keys_of(keys, kind, view->n, shown->name);
    rgb *color = app_alloc((size_t)m->n_vertices, sizeof *color);
    for (sl_int v = 0; v < m->n_vertices; v++) {
        int k = kind[view->iperm[v]];
        color[v] = k >= 0 ? color_of_kind(k) : plain;
    }
    app_output drawn = *output;
    drawn.png = path;
    const mesh_extra extra = {.color = color};
    const rgb thin = {0x90, 0x90, 0x90};
    const render_style style = {.vertex_color = color,
                                .nearest = true,
                                .edges = m->n_faces <= 2000 ? 1 : 0,
                                .edge_color = thin,
                                .legend = shown->title,
                                .keys = keys,
                                .n_keys = n_keys};
    app_write(&drawn, m, &extra, &style);
    free(color);
}

static void write_csv(const char *path, const mesh *m, const sl_symbolic_arrays *view,
                      const int *kind, const sl_int *level) {
    FILE *csv = app_create(path);
    fprintf(csv, "vertex,pivot,parent_vertex,entries_of_column,separator_level,in_patch,visited\n");
    for (sl_int v = 0; v < m->n_vertices; v++) {
        sl_int k = view->iperm[v], up = view->parent[k];
        fprintf(csv, "%d,%d,%d,%d,%d,%d,%d\n", (int)v, (int)k, up >= 0 ? (int)view->perm[up] : -1,
                (int)view->counts[k], (int)level[k], kind[k] == IN_PATCH, kind[k] >= 0);
    }
    app_close(csv);
}

static void draw(const reach_options *o, const app_output *output, const mesh *m, const sl_csc *A,
                 const sl_symbolic_arrays *view, const int *kind, const sl_int *level) {
    char message[512];
    if (output->png != NULL || output->out != NULL) {
        static const char *const names[] = {"patch", "visited"};
        const shown_kinds shown = {kind, "vertices\nthat a local\nsolve on a\npatch visits", names};
        draw_vertices(output->png, output, m, view, &shown);
    }
    if (o->separators != NULL) {
        int *by_level = app_alloc((size_t)view->n, sizeof *by_level);
        app_output only_png = *output;
        only_png.out = NULL;
        for (sl_int k = 0; k < view->n; k++) {
            by_level[k] = (int)level[k];
        }
        const shown_kinds shown = {by_level, "separators\nof nested\ndissection", NULL};
        draw_vertices(o->separators, &only_png, m, view, &shown);
        free(by_level);
    }
    if (o->graph != NULL) {
        int *by_vertex = app_alloc((size_t)view->n, sizeof *by_vertex);
        for (sl_int k = 0; k < view->n; k++) {
            by_vertex[view->perm[k]] = kind[k];
        }
        if (!draw_graph(o->graph, m, by_vertex, message, sizeof message)) {
            app_die("%s", message);
        }
        free(by_vertex);
    }
    if (o->tree != NULL && !draw_tree(o->tree, view, kind, message, sizeof message)) {
        app_die("%s", message);
    }
    if (o->pattern != NULL) {
        picture p;
        render_view picture_view;
        app_view(&picture_view, output);
        if (!draw_pattern(&p, A, view, kind, 500 * picture_view.scale)) {
            app_die("%s: out of memory for the picture", o->pattern);
        }
        app_write_png(&p, o->pattern);
        picture_free(&p);
    }
}

static void print_reach(const sl_symbolic_arrays *view, const int *kind, const sl_int *level,
                        sl_int count, sl_int visited, sl_int levels) {
    double entries = 0, all = 0;
    for (sl_int k = 0; k < view->n; k++) {
        entries += kind[k] >= 0 ? view->counts[k] : 0;
        all += view->counts[k];
    }
    printf("A solve on a patch of %d of %d vertices visits %d columns, %d of them outside the "
           "patch.\n",
           (int)count, (int)view->n, (int)visited, (int)(visited - count));
    printf("They have %.0f of the %.0f entries of L (%.2f %%).\n", entries, all,
           100 * entries / all);
    for (sl_int d = 0; d < levels; d++) {
        sl_int columns = 0;
        for (sl_int k = 0; k < view->n; k++) {
            columns += level[k] == d;
        }
        app_detail("separators of level %d: %d vertices\n", (int)d, (int)columns);
    }
}

int command_reach(int argc, char **argv) {
    const char *operand = NULL;
    reach_options o = {NULL, NULL, NULL, NULL, NULL, 500, 6};
    app_output output;
    memset(&output, 0, sizeof output);
    const option options[] = {
        {OPTION_TEXT, "center", &o.center, "VERTEX",
         "vertex from which the patch grows (the first vertex of a face with an area)"},
        {OPTION_COUNT, "patch", &o.size, "K", "number of vertices of the patch (500)"},
        {OPTION_COUNT, "levels", &o.levels, "K", "number of levels of separators (6)"},
        {OPTION_OUTPUT, "separators", &o.separators, "FILE", "draw the separators (.png)"},
        {OPTION_OUTPUT, "tree", &o.tree, "FILE", "draw the elimination tree (.svg)"},
        {OPTION_OUTPUT, "pattern", &o.pattern, "FILE", "draw the patterns of P A P' and L (.png)"},
        {OPTION_OUTPUT, "graph", &o.graph, "FILE",
         "draw the mesh, at most 500 vertices, with vertex numbers (.svg)"},
        APP_OUTPUT_OPTIONS(&output),
        APP_WELD_OPTION,
        {OPTION_END, NULL, NULL, NULL, NULL}};
    options_read(&usage, &manual, options, argc, argv, &operand);
    if (o.size < 1 || o.levels < 1) {
        app_die_usage("--patch and --levels: expected 1 or more");
    }
    app_check_output(&output, output.out);
    mesh m;
    sl_matrix *L = NULL;
    app_mesh(&m, operand, true);
    app_set_up(&output, &m, output.png != NULL || o.separators != NULL);
    if (o.graph != NULL && m.n_vertices > 500) {
        app_die("--graph: the mesh has %d vertices, at most 500 fit into the picture",
                (int)m.n_vertices);
    }
    if (!laplacian_cotangent(&L, &m)) {
        app_die("out of memory for the Laplacian of %d vertices", (int)m.n_vertices);
    }
    sl_csc A = sl_matrix_view(L);
    sl_symbolic *S = analyze(&A);
    sl_symbolic_arrays view = sl_symbolic_view(S);
    sl_int count = 0;
    o.size = o.size < m.n_vertices ? o.size : m.n_vertices;
    sl_int *patch = grow_patch(&m, &o, &count);
    int *kind = app_alloc((size_t)view.n, sizeof *kind);
    sl_int *level = app_alloc((size_t)view.n, sizeof *level);
    sl_int visited = walk_paths(kind, &view, patch, count);
    sl_int found = dissection_levels(level, &view, o.levels);
    if (found < 0) {
        app_die("out of memory");
    }
    print_reach(&view, kind, level, count, visited, found);
    if (output.csv != NULL) {
        write_csv(output.csv, &m, &view, kind, level);
    }
    app_aim_camera(&output, &m, patch, count, false);
    draw(&o, &output, &m, &A, &view, kind, level);
    free(level);
    free(kind);
    free(patch);
    sl_symbolic_free(S);
    sl_matrix_free(L);
    mesh_free(&m);
    return 0;
}

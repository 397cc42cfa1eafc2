/* command_reach.c: pictures of what a local solve touches: the patch, the paths to the root, the separators */
#include <stdlib.h>
#include <string.h>

#include "app.h"
#include "command.h"
#include "dissection.h"
#include "draw_graph.h"
#include "draw_tree.h"
#include "laplacian.h"
#include "patch.h"

static const options_usage usage = {
    "reach", "MESH", 1, 1,
    "A local solve on a patch needs the columns of L on the paths from the patch to the root of "
    "the elimination tree, and "
    "no others: pictures 1 and 2 of the paper. The patch grows from a vertex by breadth-first "
    "search. --png shows the "
    "patch (orange) and the vertices visited beyond it (blue); --separators the separators of the "
    "nested dissection, "
    "level by level; --tree the elimination tree; --pattern the entries of P A P' and of L."};

enum { IN_PATCH = 0, VISITED = 1 }; /* kinds: orange and blue */

typedef struct reach_question {
    const char *center, *separators, *tree, *pattern, *graph;
    sl_int size, levels;
} reach_question;

/* The analysis without relaxation: columns and entries are those of L itself, as in the paper. */
static sl_symbolic *analyse(const sl_csc *A) {
    sl_symbolic *S = NULL;
    sl_options opt;
    memset(&opt, 0, sizeof opt);
    opt.relaxation = SL_RELAXATION_NONE;
    app_must(sl_symbolic_create(&S, A, &opt, NULL), "analysis", NULL);
    return S;
}

static sl_int *grow_patch(const mesh *m, const reach_question *q, sl_int *count) {
    adjacency graph;
    sl_int centers = 0;
    sl_int *center = app_vertices("center", q->center, m->n_vertices, 1, &centers);
    sl_int *patch = app_alloc((size_t)q->size, sizeof *patch);
    unsigned char *seen = app_alloc((size_t)m->n_vertices, 1);
    if (centers != 1) {
        app_die_usage("--center %s: one vertex", q->center);
    }
    if (!adjacency_from_mesh(&graph, m)) {
        app_die("no memory for the graph of %d vertices", (int)m->n_vertices);
    }
    *count = patch_bfs(patch, q->size, &graph, center[0], seen);
    adjacency_free(&graph);
    free(seen);
    free(center);
    return patch;
}

/* kind[k] of pivot k: IN_PATCH, VISITED, or -1. Walks each path until it meets one that was walked before: the time is
 * that of the columns visited. */
static sl_int walk_paths(int *kind, const sl_symbolic_view_t *view, const sl_int *patch,
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

static void draw_vertices(const char *path, const app_output *output, const mesh *m,
                          const sl_symbolic_view_t *view, const int *kind) {
    const rgb plain = {0xe6, 0xe3, 0xde};
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
                                .edge_color = thin};
    app_write(&drawn, m, &extra, &style);
    free(color);
}

static void write_csv(const char *path, const mesh *m, const sl_symbolic_view_t *view,
                      const int *kind, const sl_int *level) {
    FILE *csv = app_create(path);
    fprintf(csv, "vertex,pivot,parent_vertex,entries_of_column,separator_level,in_patch,visited\n");
    for (sl_int v = 0; v < m->n_vertices; v++) {
        sl_int k = view->iperm[v], up = view->parent[k];
        fprintf(csv, "%d,%d,%d,%d,%d,%d,%d\n", (int)v, (int)k, up >= 0 ? (int)view->perm[up] : -1,
                (int)view->counts[k], (int)level[k], kind[k] == IN_PATCH, kind[k] >= 0);
    }
    app_close(csv, path);
}

static void draw(const reach_question *q, const app_output *output, const mesh *m, const sl_csc *A,
                 const sl_symbolic_view_t *view, const int *kind, const sl_int *level) {
    char message[512];
    if (output->png != NULL || output->out != NULL) {
        draw_vertices(output->png, output, m, view, kind);
    }
    if (q->separators != NULL) {
        int *by_level = app_alloc((size_t)view->n, sizeof *by_level);
        app_output only_png = *output;
        only_png.out = NULL;
        for (sl_int k = 0; k < view->n; k++) {
            by_level[k] = (int)level[k];
        }
        draw_vertices(q->separators, &only_png, m, view, by_level);
        free(by_level);
    }
    if (q->graph != NULL) {
        int *by_vertex = app_alloc((size_t)view->n, sizeof *by_vertex);
        for (sl_int k = 0; k < view->n; k++) {
            by_vertex[view->perm[k]] = kind[k];
        }
        if (!draw_graph(q->graph, m, by_vertex, message, sizeof message)) {
            app_die("%s", message);
        }
        free(by_vertex);
    }
    if (q->tree != NULL && !draw_tree(q->tree, view, kind, message, sizeof message)) {
        app_die("%s", message);
    }
    if (q->pattern != NULL) {
        picture p;
        if (!draw_pattern(&p, A, view, kind, 500)) {
            app_die("%s: no memory for the picture", q->pattern);
        }
        app_write_png(&p, q->pattern);
        picture_free(&p);
    }
}

static void print_reach(const sl_symbolic_view_t *view, const int *kind, const sl_int *level,
                        sl_int count, sl_int visited, sl_int levels) {
    double entries = 0, all = 0;
    for (sl_int k = 0; k < view->n; k++) {
        entries += kind[k] >= 0 ? view->counts[k] : 0;
        all += view->counts[k];
    }
    printf("patch %d of %d vertices; columns visited %d, %d of them beyond the patch\n", (int)count,
           (int)view->n, (int)visited, (int)(visited - count));
    printf("entries of L in them: %.0f of %.0f (%.2f %%)\n", entries, all, 100 * entries / all);
    for (sl_int d = 0; d < levels; d++) {
        sl_int columns = 0;
        for (sl_int k = 0; k < view->n; k++) {
            columns += level[k] == d;
        }
        printf("separators of level %d: %d vertices\n", (int)d, (int)columns);
    }
}

int command_reach(int argc, char **argv) {
    const char *operand = NULL;
    reach_question q = {"0", NULL, NULL, NULL, NULL, 500, 6};
    app_output output;
    memset(&output, 0, sizeof output);
    const option options[] = {
        {OPTION_TEXT, "center", &q.center, "VERTEX", "where the patch begins (0)"},
        {OPTION_COUNT, "patch", &q.size, "K", "its vertices (500)"},
        {OPTION_COUNT, "levels", &q.levels, "K", "levels of separators (6)"},
        {OPTION_TEXT, "separators", &q.separators, "FILE", "draw the separators: a .png"},
        {OPTION_TEXT, "tree", &q.tree, "FILE", "draw the elimination tree: an .svg"},
        {OPTION_TEXT, "pattern", &q.pattern, "FILE", "draw the entries of P A P' and L: a .png"},
        {OPTION_TEXT, "graph", &q.graph, "FILE",
         "draw a small mesh (up to 500 vertices) with its vertices numbered: an .svg"},
        APP_OUTPUT_OPTIONS(&output),
        {OPTION_END, NULL, NULL, NULL, NULL}};
    options_read(&usage, options, argc, argv, &operand);
    if (q.size < 1 || q.levels < 1) {
        app_die_usage("--patch and --levels: 1 or more");
    }
    mesh m;
    sl_matrix *L = NULL;
    app_mesh(&m, operand, true);
    if (q.graph != NULL && m.n_vertices > 500) {
        app_die("--graph: %d vertices, no more than 500 can be told apart", (int)m.n_vertices);
    }
    if (!laplacian_cotangent(&L, &m)) {
        app_die("no memory for the Laplacian of %d vertices", (int)m.n_vertices);
    }
    sl_csc A = sl_matrix_view(L);
    sl_symbolic *S = analyse(&A);
    sl_symbolic_view_t view = sl_symbolic_view(S);
    sl_int count = 0;
    q.size = q.size < m.n_vertices ? q.size : m.n_vertices;
    sl_int *patch = grow_patch(&m, &q, &count);
    int *kind = app_alloc((size_t)view.n, sizeof *kind);
    sl_int *level = app_alloc((size_t)view.n, sizeof *level);
    sl_int visited = walk_paths(kind, &view, patch, count);
    sl_int found = dissection_levels(level, &view, q.levels);
    if (found < 0) {
        app_die("out of memory");
    }
    print_reach(&view, kind, level, count, visited, found);
    if (output.csv != NULL) {
        write_csv(output.csv, &m, &view, kind, level);
    }
    app_look_at(&output, &m, patch, count);
    draw(&q, &output, &m, &A, &view, kind, level);
    free(level);
    free(kind);
    free(patch);
    sl_symbolic_free(S);
    sl_matrix_free(L);
    mesh_free(&m);
    return 0;
}

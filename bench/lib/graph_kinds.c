/* graph_kinds.c: lattices, surfaces, quadtrees and CAD parts, and the Laplacians of all graphs */
#include "graph_makers.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "tools/geometry/polyharmonic.h"
#include "tools/matrix/triplets.h"
#include "tools/mesh/grid.h"
#include "tools/mesh/surface_generator.h"

const char *const kind_group_names[KIND_GROUPS] = {
    "surfaces", "thin", "graded", "volumes", "fans", "networks", "dense rows"};

void graph_add(graph *g, sl_int a, sl_int b) {
    bench_must(triplets_add(&g->edges, a > b ? a : b, a > b ? b : a, -1.0) ? SL_OK : SL_ERR_MEMORY,
               "adding an edge");
}

double graph_random_share(uint64_t *state) {
    return 0.5 + 0.5 * bench_random_unit(state);
}

/* ---- lattices ---- */

static sl_int lattice_index(const kind *k, const sl_int *at) {
    return at[0] + k->size[0] * (at[1] + k->size[1] * at[2]);
}

/* Adds the edges to those of the neighbors that follow in the order of an unbounded lattice. */
static void lattice_edges(graph *g, const kind *k, const sl_int *at, const sl_int *name) {
    for (int c = 14; c < 27; c++) { /* of the 27 offsets, number 13 is the point itself */
        const int step[3] = {c % 3 - 1, c / 3 % 3 - 1, c / 9 - 1};
        const int along = abs(step[0]) + abs(step[1]) + abs(step[2]);
        const int falls = step[0] < 0 || step[1] < 0;
        sl_int to[3];
        int is_inside =
            k->neighbors == STENCIL_BOX || (k->neighbors == STENCIL_AXES ? along == 1 : !falls);
        for (int d = 0; d < 3; d++) {
            to[d] = at[d] + step[d];
            if (d < k->periodic) {
                to[d] = (to[d] + k->size[d]) % k->size[d];
            }
            is_inside = is_inside && to[d] >= 0 && to[d] < k->size[d];
        }
        if (is_inside && name[lattice_index(k, to)] != -1) {
            graph_add(g, name[lattice_index(k, at)], name[lattice_index(k, to)]);
        }
    }
}

static void lattice(graph *g, const kind *k) {
    const size_t points = (size_t)k->size[0] * (size_t)k->size[1] * (size_t)k->size[2];
    sl_int *name = bench_alloc(points, sizeof *name);
    for (int pass = 0; pass < 2; pass++) { /* names the points, then joins them */
        sl_int at[3];
        for (at[2] = 0; at[2] < k->size[2]; at[2]++) {
            for (at[1] = 0; at[1] < k->size[1]; at[1]++) {
                for (at[0] = 0; at[0] < k->size[0]; at[0]++) {
                    sl_int *v = &name[lattice_index(k, at)];
                    if (pass == 0) {
                        *v = !k->contains || k->contains(k, at) ? g->n++ : -1;
                    } else if (*v != -1) {
                        lattice_edges(g, k, at, name);
                    }
                }
            }
        }
    }
    free(name);
}

/* A hole of radius 8 for every 700 squares. */
static int has_no_hole(const kind *k, const sl_int *at) {
    const double radius = 8, area = 700;
    uint64_t state = 5;
    int inside = 1;
    for (int hole = 0; hole < k->size[0] * k->size[1] / area; hole++) {
        const double x = k->size[0] * graph_random_share(&state);
        const double y = k->size[1] * graph_random_share(&state);
        inside = inside && hypot(at[0] - x, at[1] - y) > radius;
    }
    return inside;
}

/* Teeth of 8 columns, 8 apart, on a spine of 8 rows. */
static int is_comb(const kind *k, const sl_int *at) {
    (void)k;
    return at[1] < 8 || at[0] % 16 < 8;
}

/* ---- surfaces and graded meshes ---- */

static void sphere(graph *g, const kind *k) {
    char text[32];
    mesh m;
    adjacency a;
    snprintf(text, sizeof text, "sphere:%d", (int)k->size[0]);
    bench_must(surface_generate(&m, text, NULL, 0) && adjacency_from_mesh(&a, &m) ? SL_OK
                                                                                  : SL_ERR_MEMORY,
               "creating a sphere");
    g->n = a.n;
    for (sl_int v = 0; v < a.n; v++) {
        for (sl_off p = a.begin[v]; p < a.begin[v + 1]; p++) {
            if (a.neighbor[p] > v) {
                graph_add(g, a.neighbor[p], v);
            }
        }
    }
    adjacency_free(&a);
    mesh_free(&m);
}

/* Divides a square of side `size` until its cells are as small as their place asks for, and names
 * the cells. */
static void divide(sl_int *cell, graph *g, const kind *k, sl_int x, sl_int y, sl_int size) {
    const sl_int side = (sl_int)1 << k->size[0];
    const double u = (x + 0.5 * size) / side, v = (y + 0.5 * size) / side;
    const double to_circle = fabs(hypot(u - 0.5, v - 0.5) - 0.3);
    const double distance = fmin(to_circle, hypot(u, v)); /* from a circle and a corner */
    if (size > 1 && size > 1 + 0.01 * k->size[1] * distance * side) {
        for (int c = 0; c < 4; c++) {
            divide(cell, g, k, x + c % 2 * (size / 2), y + c / 2 * (size / 2), size / 2);
        }
        return;
    }
    for (sl_int row = y; row < y + size; row++) {
        for (sl_int column = x; column < x + size; column++) {
            cell[row * side + column] = g->n;
        }
    }
    g->n++;
}

/* The cells of a quadtree, joined where they share a side. size: levels, growth of the cells in
 * percent of their distance. */
static void quadtree(graph *g, const kind *k) {
    const sl_int side = (sl_int)1 << k->size[0];
    sl_int *cell = bench_alloc((size_t)side * (size_t)side, sizeof *cell);
    divide(cell, g, k, 0, 0, side);
    for (sl_int p = 0; p < side * side; p++) {
        if (p % side + 1 < side && cell[p] != cell[p + 1]) {
            graph_add(g, cell[p], cell[p + 1]);
        }
        if (p + side < side * side && cell[p] != cell[p + side]) {
            graph_add(g, cell[p], cell[p + side]);
        }
    }
    free(cell);
}

/* ---- CAD parts ---- */

/* Divides the polygon of the vertices first .. first + size[0]-1 into fans of up to size[2] edges,
 * most of them of a few. */
static void cap_with_fans(graph *g, const kind *k, sl_int first) {
    sl_int *outline = bench_alloc((size_t)k->size[0], sizeof *outline), left = k->size[0];
    uint64_t state = 19;
    for (sl_int v = 0; v < left; v++) {
        outline[v] = first + v;
    }
    while (left > 3) {
        const sl_int wanted = 2 + (sl_int)(k->size[2] * pow(graph_random_share(&state), 6));
        const sl_int edges = wanted < left - 1 ? wanted : left - 1;
        const sl_int apex = bench_random_below(&state, left - edges);
        for (sl_int p = apex + 2; p <= apex + edges; p++) {
            graph_add(g, outline[apex], outline[p]);
        }
        memmove(outline + apex + 1, outline + apex + edges,
                (size_t)(left - apex - edges) * sizeof *outline);
        left -= edges - 1;
    }
    free(outline);
}

/* An outline of size[0] vertices, extruded to size[1] rings, with both ends capped by fans. */
static void extrusion(graph *g, const kind *k) {
    const sl_int around = k->size[0];
    g->n = around * k->size[1];
    for (sl_int v = 0; v < g->n; v++) {
        const sl_int next = v / around * around + (v + 1) % around;
        graph_add(g, v, next);
        if (v + around < g->n) {
            graph_add(g, v, v + around);
            graph_add(g, v, next + around);
        }
    }
    cap_with_fans(g, k, 0);
    cap_with_fans(g, k, g->n - around);
}

/* ---- matrices ---- */

/* Every vertex becomes `size` rows, all of them adjacent to one another and to those of the
 * neighbors, as in elasticity. */
static void make_blocks(graph *g, int size) {
    triplets edges = g->edges;
    memset(&g->edges, 0, sizeof g->edges);
    for (sl_int v = 0; v < g->n; v++) {
        for (int i = 0; i < size; i++) {
            for (int j = 0; j < i; j++) {
                graph_add(g, v * size + i, v * size + j);
            }
        }
    }
    for (size_t e = 0; e < edges.count; e++) {
        for (int c = 0; c < size * size; c++) {
            graph_add(g, edges.i[e] * size + c % size, edges.j[e] * size + c / size);
        }
    }
    triplets_free(&edges);
    g->n *= size;
}

/* The Laplacian plus 0.01; releases the edges. */
static sl_matrix *graph_matrix(graph *g) {
    double *diagonal = bench_alloc((size_t)g->n, sizeof *diagonal);
    sl_matrix *M;
    int held = 1;
    for (sl_int v = 0; v < g->n; v++) {
        diagonal[v] = 0.01;
    }
    for (size_t e = 0; e < g->edges.count; e++) {
        diagonal[g->edges.i[e]] += 1;
        diagonal[g->edges.j[e]] += 1;
    }
    for (sl_int v = 0; v < g->n; v++) {
        held = held && triplets_add(&g->edges, v, v, diagonal[v]);
    }
    bench_must(held ? triplets_finish(&M, g->n, g->n, &g->edges, true) : SL_ERR_MEMORY,
               "assembling a Laplacian");
    free(diagonal);
    return M;
}

/* The k-harmonic system of a grid that smooths over a tenth of its diagonal. size: side, k. */
static sl_matrix *k_harmonic(const kind *k) {
    const double square = 0.02; /* of a tenth of the diagonal */
    const int order = (int)k->size[1];
    sl_matrix *M;
    mesh m;
    bench_must(mesh_grid(&m, k->size[0], k->size[0], 0.2, 1) &&
                       polyharmonic_system(&M, &m, order, pow(square, order))
                   ? SL_OK
                   : SL_ERR_MEMORY,
               "assembling a k-harmonic matrix");
    mesh_free(&m);
    return M;
}

#define AXES STENCIL_AXES
#define SIMPLICES STENCIL_SIMPLICES
#define BOX STENCIL_BOX

static const kind kinds[KINDS] = {
    {KIND_SURFACES, "grid 20^2", lattice, {20, 20, 1}, SIMPLICES, 0, NULL, 0},
    {KIND_SURFACES, "grid 50^2", lattice, {50, 50, 1}, SIMPLICES, 0, NULL, 0},
    {KIND_SURFACES, "grid 100^2", lattice, {100, 100, 1}, SIMPLICES, 0, NULL, 0},
    {KIND_SURFACES, "grid 316^2", lattice, {316, 316, 1}, SIMPLICES, 0, NULL, 0},
    {KIND_SURFACES, "5-point 100^2", lattice, {100, 100, 1}, AXES, 0, NULL, 0},
    {KIND_SURFACES, "9-point 100^2", lattice, {100, 100, 1}, BOX, 0, NULL, 0},
    {KIND_SURFACES, "torus 120^2", lattice, {120, 120, 1}, SIMPLICES, 2, NULL, 0},
    {KIND_SURFACES, "sphere", sphere, {5, 0, 0}, AXES, 0, NULL, 0},
    {KIND_SURFACES, "plate with holes", lattice, {200, 200, 1}, SIMPLICES, 0, has_no_hole, 0},
    {KIND_THIN, "strip 4x5000", lattice, {4, 5000, 1}, SIMPLICES, 0, NULL, 0},
    {KIND_THIN, "strip 20x3000", lattice, {20, 3000, 1}, SIMPLICES, 0, NULL, 0},
    {KIND_THIN, "tube 12x3000", lattice, {12, 3000, 1}, SIMPLICES, 1, NULL, 0},
    {KIND_THIN, "comb", lattice, {320, 208, 1}, SIMPLICES, 0, is_comb, 0},
    {KIND_THIN, "strip with holes", lattice, {60, 600, 1}, SIMPLICES, 0, has_no_hole, 0},
    {KIND_GRADED, "quadtree 2^8", quadtree, {8, 6, 0}, AXES, 0, NULL, 0},
    {KIND_GRADED, "quadtree 2^9", quadtree, {9, 6, 0}, AXES, 0, NULL, 0},
    {KIND_GRADED, "quadtree, steep", quadtree, {10, 25, 0}, AXES, 0, NULL, 0},
    {KIND_VOLUMES, "7-point 24^3", lattice, {24, 24, 24}, AXES, 0, NULL, 0},
    {KIND_VOLUMES, "27-point 12^3", lattice, {12, 12, 12}, BOX, 0, NULL, 0},
    {KIND_VOLUMES, "tetrahedra 18^3", lattice, {18, 18, 18}, SIMPLICES, 0, NULL, 0},
    {KIND_VOLUMES, "plate 60x60x4", lattice, {60, 60, 4}, SIMPLICES, 0, NULL, 0},
    {KIND_VOLUMES, "bar 8x8x400", lattice, {8, 8, 400}, SIMPLICES, 0, NULL, 0},
    {KIND_FANS, "fans 1000x2", extrusion, {1000, 2, 500}, AXES, 0, NULL, 0},
    {KIND_FANS, "fans 6000x6", extrusion, {6000, 6, 500}, AXES, 0, NULL, 0},
    {KIND_FANS, "fans 19000x2", extrusion, {19000, 2, 500}, AXES, 0, NULL, 0},
    {KIND_NETWORKS, "roads", network_roads, {100, 0, 0}, AXES, 0, NULL, 0},
    {KIND_NETWORKS, "random points, 2D", network_geometric, {20000, 2, 7}, AXES, 0, NULL, 0},
    {KIND_NETWORKS, "random points, 3D", network_geometric, {20000, 3, 10}, AXES, 0, NULL, 0},
    {KIND_NETWORKS, "path", network_path, {100000, 0, 0}, AXES, 0, NULL, 0},
    {KIND_NETWORKS, "tree", network_tree, {100000, 0, 0}, AXES, 0, NULL, 0},
    {KIND_NETWORKS, "pairs", network_pairs, {100000, 0, 0}, AXES, 0, NULL, 0},
    {KIND_NETWORKS, "star", network_hubs, {20000, 1, 0}, AXES, 0, NULL, 0},
    {KIND_DENSE_ROWS, "biharmonic 120^2", NULL, {120, 2, 0}, AXES, 0, NULL, 0},
    {KIND_DENSE_ROWS, "triharmonic 80^2", NULL, {80, 3, 0}, AXES, 0, NULL, 0},
    {KIND_DENSE_ROWS, "tetrahedra 10^3 x 3", lattice, {10, 10, 10}, SIMPLICES, 0, NULL, 3}};

const char *kind_name(int k) {
    return kinds[k].name;
}

kind_group kind_group_of(int k) {
    return kinds[k].group;
}

sl_matrix *kind_matrix(int k) {
    graph g;
    memset(&g, 0, sizeof g);
    if (!kinds[k].make) {
        return k_harmonic(&kinds[k]);
    }
    kinds[k].make(&g, &kinds[k]);
    if (kinds[k].block > 1) {
        make_blocks(&g, kinds[k].block);
    }
    return graph_matrix(&g);
}

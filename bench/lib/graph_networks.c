/* graph_networks.c: random points, roads, paths, pairs, trees and stars */
#include "graph_makers.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Random points of the unit square or cube, joined up to a distance; by buckets as wide as it.
 * size: vertices, dimensions, mean number of neighbors. */
void network_geometric(graph *g, const kind *k) {
    const double pi = 3.141592653589793, density = (double)k->size[2] / k->size[0];
    const int is_flat = k->size[1] == 2;
    const double r = is_flat ? sqrt(density / pi) : cbrt(density / (4 * pi / 3));
    const sl_int wide = (sl_int)(1 / r), deep = is_flat ? 1 : wide;
    sl_int *first = bench_alloc((size_t)wide * (size_t)wide * (size_t)deep, sizeof *first);
    sl_int *next = bench_alloc((size_t)k->size[0], sizeof *next);
    double(*at)[3] = bench_alloc((size_t)k->size[0], sizeof *at);
    uint64_t state = 7;
    memset(first, -1, (size_t)wide * (size_t)wide * (size_t)deep * sizeof *first);
    for (sl_int v = 0; v < k->size[0]; v++) {
        sl_int box[3];
        for (int d = 0; d < 3; d++) {
            at[v][d] = d < 2 || !is_flat ? graph_random_share(&state) : 0;
            box[d] = (sl_int)(at[v][d] * wide);
        }
        for (int c = 0; c < 27; c++) {
            const sl_int x = box[0] + c % 3 - 1, y = box[1] + c / 3 % 3 - 1, z = box[2] + c / 9 - 1;
            const int is_there = x >= 0 && x < wide && y >= 0 && y < wide && z >= 0 && z < deep;
            sl_int u = is_there ? first[x + wide * (y + wide * z)] : -1;
            for (; u != -1; u = next[u]) {
                const double dx = at[u][0] - at[v][0], dy = at[u][1] - at[v][1];
                if (hypot(hypot(dx, dy), at[u][2] - at[v][2]) < r) {
                    graph_add(g, u, v);
                }
            }
        }
        sl_int *head = &first[box[0] + wide * (box[1] + wide * box[2])];
        next[v] = *head;
        *head = v;
    }
    g->n = k->size[0];
    free(at);
    free(next);
    free(first);
}

/* Streets of a square grid, one in five closed, with up to seven vertices along each. */
void network_roads(graph *g, const kind *k) {
    const sl_int side = k->size[0];
    uint64_t state = 11;
    g->n = side * side;
    for (sl_int v = 0; v < side * side; v++) {
        for (int d = 0; d < 2; d++) {
            const int is_inside = d == 0 ? v % side + 1 < side : v + side < side * side;
            sl_int from = v, vertices = bench_random_below(&state, 8);
            if (is_inside && bench_random_below(&state, 5) != 0) {
                for (; vertices > 0; vertices--) {
                    graph_add(g, from, g->n);
                    from = g->n++;
                }
                graph_add(g, from, d == 0 ? v + 1 : v + side);
            }
        }
    }
}

/* A path whose vertices are numbered at random. */
void network_path(graph *g, const kind *k) {
    sl_int *name = bench_alloc((size_t)k->size[0], sizeof *name);
    uint64_t state = 13;
    g->n = k->size[0];
    for (sl_int v = 0; v < g->n; v++) {
        const sl_int other = bench_random_below(&state, v + 1);
        name[v] = name[other];
        name[other] = v;
    }
    for (sl_int v = 1; v < g->n; v++) {
        graph_add(g, name[v - 1], name[v]);
    }
    free(name);
}

/* Each row has one neighbor: a matrix that is nearly diagonal. */
void network_pairs(graph *g, const kind *k) {
    g->n = k->size[0];
    for (sl_int v = 1; v < g->n; v += 2) {
        graph_add(g, v, v - 1);
    }
}

void network_tree(graph *g, const kind *k) {
    uint64_t state = 17;
    g->n = k->size[0];
    for (sl_int v = 1; v < g->n; v++) {
        graph_add(g, v, bench_random_below(&state, v));
    }
}

/* A path of size[1] hubs to which all other vertices are attached in turn. */
void network_hubs(graph *g, const kind *k) {
    g->n = k->size[0];
    for (sl_int v = 1; v < g->n; v++) {
        graph_add(g, v, v < k->size[1] ? v - 1 : v % k->size[1]);
    }
}

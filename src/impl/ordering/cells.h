/* cells.h: are halves of space as good subgraphs as any? decided in a coarse graph of cells */
#ifndef SLI_ORDERING_CELLS_H
#define SLI_ORDERING_CELLS_H

#include "geometric.h"

/* The coarse graph has about SLI_CELLS cells, which are ranges of at least half of SLI_CELL_LEAST
 * vertices. Two trees of SLI_CELLS_DEPTH levels are compared in it. */
#define SLI_CELLS 1024
#define SLI_CELL_LEAST 64
#define SLI_CELLS_DEPTH 3

/* A graph that has this share of its vertices as cells is not connected as its points are. */
#define SLI_CELLS_SHARE 4

/* Halves of space are taken if they are estimated to cost at most this percentage of the subgraphs
 * that multilevel dissection finds among the cells. Flat grids have 70 to 100. Wherever the first
 * separators become better without coordinates, there are 115 or more: straits between islands,
 * spirals, strips. */
#define SLI_CELLS_AS_GOOD 105

/* And at most this percentage of a flat square grid: flat grids have 80 to 92. On a closed surface,
 * where a plane cuts at least two sheets, halves of space cost up to 16 % more in path weight even
 * if the first separators are as good as any; spheres have 250, tori 150. */
#define SLI_CELLS_FLAT 110

/* In a lattice, at least this percentage of the vertices have equal degrees, of at least
 * LATTICE_DEGREE. In other meshes, the smallest separators are not straight: halves of space cost 2
 * to 9 % more fill even if these are flat and uniform, and 14 % in a five-point grid, where
 * diagonals have the fewest vertices. */
#define SLI_LATTICE_SHARE 75
#define SLI_LATTICE_DEGREE 6
#define SLI_LATTICE_DEGREES 32

/* Is the graph that of a grid, apart from its boundary, with at least `least` neighbors? Six are
 * those of triangles, four those of five points. */
static int sli_is_lattice(const sli_level *g, sl_off least) {
    sl_int count[SLI_LATTICE_DEGREES] = {0}, v, most = 0;
    for (v = 0; v < g->n; v++) {
        const sl_off degree = g->begin[v + 1] - g->begin[v];
        if (degree >= least && degree < SLI_LATTICE_DEGREES) {
            count[degree]++;
            most = sli_max(most, count[degree]);
        }
    }
    return 100 * (int64_t)most >= SLI_LATTICE_SHARE * (int64_t)g->n;
}

/* Finds the connected parts of the cells, which are ranges of `sorted`, of at most `most` vertices.
 * Returns their number. cell: n of scratch. */
static sl_int sli_cells_find(const sli_level *g, const sl_int *sorted, sl_int most, sl_int *cell,
                             sli_clusters *parts) {
    sl_int end[SLI_LEVELS_MAX], depth = 1, first = 0, k, count = 0, head = 0, tail = 0;
    sl_off e;
    end[0] = g->n;
    while (depth > 0) {
        const sl_int size = end[depth - 1] - first;
        if (size > most) {
            end[depth++] = first + size / 2;
            continue;
        }
        for (k = first; k < first + size; k++) {
            cell[sorted[k]] = first;
            g->coarse[sorted[k]] = -1;
        }
        first = end[--depth];
    }
    for (k = 0; k < g->n; k++) {
        if (g->coarse[sorted[k]] != -1) {
            continue;
        }
        parts->start[count] = tail;
        g->coarse[sorted[k]] = count;
        parts->member[tail++] = sorted[k];
        for (; head < tail; head++) {
            const sl_int v = parts->member[head];
            for (e = g->begin[v]; e < g->begin[v + 1]; e++) {
                const sl_int u = g->to[e];
                if (g->coarse[u] == -1 && cell[u] == cell[v]) {
                    g->coarse[u] = count;
                    parts->member[tail++] = u;
                }
            }
        }
        count++;
    }
    parts->start[count] = tail;
    return count;
}

/* The estimate of sli_dissect_cost from the edges between cells. On a straight border of a grid
 * that has k edges for each vertex, a vertex has k - 1 edges to the other side. *flat := the same
 * for square flat grids. */
static sli_tree_cost sli_cells_cost(sli_dissection *d, const sl_int *label, sli_tree_cost *flat) {
    const sli_level *g = &d->levels[1];
    const sl_int n = d->levels[0].n;
    const sl_off edges = d->levels[0].begin[n] / 2;
    const uint64_t across = (uint64_t)(edges - n); /* of a lattice: more than n */
    sli_tree_cost cost = {0, 0};
    sl_int *cut = d->nodes, k;
    sl_off e;
    memset(cut, 0, (size_t)d->tree.count * sizeof(sl_int));
    for (k = 0; k < g->n; k++) {
        for (e = g->begin[k]; e < g->begin[k + 1]; e++) {
            if (label[k] < label[g->to[e]]) {
                cut[sli_label_tree_lca(&d->tree, label[k], label[g->to[e]])] += g->edge[e];
            }
        }
    }
    *flat = cost;
    for (k = 0; k < d->tree.count; k++) {
        const uint64_t weight = (uint64_t)d->tree.weight[k];
        const uint64_t border = (uint64_t)cut[k] * (uint64_t)n / across;
        if (!sli_label_tree_is_leaf(&d->tree, k)) {
            sli_tree_cost_add(&cost, weight * border, border);
            sli_tree_cost_add(flat, weight, weight);
        }
    }
    return cost;
}

/* Compares both trees in the graph of cells, which is level 1. */
static sl_status sli_cells_compare(sli_dissection *d, const sl_int *sorted, int *is_good) {
    const sl_int n = d->levels[0].n, leaf = d->leaf_size;
    sl_int k, top = n;
    sli_tree_cost halves, graph, flat;
    sl_status status;
    for (k = 0; k < SLI_CELLS_DEPTH && top > leaf; k++) {
        top = top / 2 + 1;
    }
    sli_dissect_points(d, sorted, top);
    for (k = 0; k < n; k++) {
        d->other[d->levels[0].coarse[k]] = d->label[k];
    }
    halves = sli_cells_cost(d, d->other, &flat);
    *is_good = !sli_tree_cost_is_less(sli_tree_cost_times(flat, SLI_CELLS_FLAT),
                                      sli_tree_cost_times(halves, 100));
    if (!*is_good) {
        return SL_OK;
    }
    d->leaf_size = top;
    status = sli_dissect_levels(d, 0);
    d->leaf_size = leaf;
    if (status == SL_OK) {
        graph = sli_cells_cost(d, d->label, &flat);
        *is_good = !sli_tree_cost_is_less(sli_tree_cost_times(graph, SLI_CELLS_AS_GOOD),
                                          sli_tree_cost_times(halves, 100));
    }
    return status;
}

/* *is_good := whether halves of space cost no more than the subgraphs that multilevel dissection
 * finds. sorted: the vertices as sli_points_sort leaves them. */
static sl_status sli_dissect_try_points(sli_dissection *d, const sl_int *sorted, sl_int cell,
                                        int *is_good) {
    const sli_level *g = &d->levels[0];
    sli_clusters parts;
    sl_int count;
    sl_status status;
    parts.member = d->other;
    parts.start = d->begin;
    *is_good = 0;
    count = sli_cells_find(g, sorted, cell, d->label, &parts);
    if (count > g->n / SLI_CELLS_SHARE) {
        return SL_OK;
    }
    status = sli_coarsen_clusters(g, count, &parts, &d->levels[1], &d->ranges, d->a);
    if (status == SL_OK) {
        d->n_levels = 2;
        status = sli_cells_compare(d, sorted, is_good);
        sli_dissect_free_levels(d);
    }
    return status;
}

/* Finds labels by coordinates if the graph is a lattice, and if their cost is that of a flat mesh
 * and no higher than without coordinates; otherwise without coordinates. In lattices that may be
 * volumes, the cheaper labels are taken. */
static sl_status sli_dissect_geometric(sli_dissection *d, const sli_points *points,
                                       sli_projection *projections) {
    const sl_int n = d->levels[0].n, cell = sli_max(SLI_CELL_LEAST, n / SLI_CELLS);
    sl_int *sorted = (sl_int *)(void *)projections, k;
    sli_tree_cost graph, flat;
    sl_status status;
    int is_good;
    if (!sli_is_lattice(&d->levels[0], SLI_LATTICE_DEGREE)) {
        return sli_dissect_graph(d);
    }
    for (k = 0; k < n; k++) {
        d->order[k] = k;
    }
    sli_points_sort(points, d->order, n, sli_min(cell, d->leaf_size), projections);
    memcpy(sorted, d->order, (size_t)n * sizeof(sl_int));
    status = sli_dissect_try_points(d, sorted, cell, &is_good);
    if (status == SL_OK && !is_good) {
        status = sli_dissect_graph(d);
        if (status != SL_OK || (!d->is_volume && !d->may_be_seven_point)) {
            return status;
        }
        graph = sli_dissect_cost(d, &flat);
        sli_dissect_points(d, sorted, d->leaf_size);
        if (!sli_tree_cost_is_less(sli_dissect_cost(d, &flat), graph)) {
            return sli_dissect_graph(d);
        }
    } else if (status == SL_OK) {
        sli_dissect_points(d, sorted, d->leaf_size);
    }
    d->band_growth = 0;
    return status;
}

#endif

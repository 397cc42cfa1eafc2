/* graph_makers.h: a graph while it is made, and the makers that have a file of their own */
#ifndef BENCH_GRAPH_MAKERS_H
#define BENCH_GRAPH_MAKERS_H

#include "graph_kinds.h"
#include "tools/matrix/triplets.h"

/* The neighbors of a point of a lattice of one, two or three dimensions. */
typedef enum stencil {
    STENCIL_AXES,      /* along the axes: 5 or 7 points */
    STENCIL_SIMPLICES, /* squares as two triangles, cubes as six tetrahedra */
    STENCIL_BOX        /* all around: 9 or 27 points */
} stencil;

typedef struct kind kind;

typedef struct graph {
    sl_int n;
    triplets edges; /* i > j, value -1; a repeated edge has twice the weight */
} graph;

struct kind {
    kind_group group;
    const char *name;
    void (*make)(graph *g, const kind *k);
    sl_int size[3];
    stencil neighbors; /* of a lattice, as are the next two */
    int periodic;      /* its first dimensions that are closed to rings */
    int (*contains)(const kind *k, const sl_int *at); /* NULL: all points */
    int block;                                        /* rows a vertex; 0 means 1 */
};

/** Adds an edge, once more if it is there. */
void graph_add(graph *g, sl_int a, sl_int b);

/** Uniform in (0, 1). */
double graph_random_share(uint64_t *state);

/** Networks of k->size: graph_networks.c says what each number is. */
void network_geometric(graph *g, const kind *k);
void network_roads(graph *g, const kind *k);
void network_path(graph *g, const kind *k);
void network_pairs(graph *g, const kind *k);
void network_tree(graph *g, const kind *k);
void network_hubs(graph *g, const kind *k);

#endif

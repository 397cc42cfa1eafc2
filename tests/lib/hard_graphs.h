/* hard_graphs.h: graphs of 500 to 6000 rows that are hard to order: hubs, cliques, dense rows */
#ifndef SL_TEST_HARD_GRAPHS_H
#define SL_TEST_HARD_GRAPHS_H

#include "gen_matrices.h"

/* A path of hubs, with the other rows attached to them in turn; two hubs make a double broom. */
static inline void edges_caterpillar(gen_list_t *t, sl_int hubs, uint64_t *state) {
    for (sl_int k = 1; k < t->n; k++) {
        gen_add(t, k, k < hubs ? k - 1 : k % hubs, gen_real(state));
    }
}

/* A row of cliques in which neighbors share two rows. */
static inline void edges_cliques(gen_list_t *t, sl_int size, uint64_t *state) {
    for (sl_int first = 0; first + size <= t->n; first += size - 2) {
        for (sl_int j = first; j < first + size; j++) {
            for (sl_int i = first == 0 || j >= first + 2 ? j + 1 : first + 2; i < first + size;
                 i++) {
                gen_add(t, i, j, gen_real(state));
            }
        }
    }
}

/* A random tree: each row is adjacent to one earlier row. */
static inline void edges_tree(gen_list_t *t, uint64_t *state) {
    for (sl_int k = 1; k < t->n; k++) {
        const sl_int up = gen_below(state, k);
        gen_add(t, k, up, gen_real(state));
    }
}

/* Each row is adjacent to `degree` random earlier rows, so that there are no small separators.
 * Edges may repeat, which gives duplicate entries. */
static inline void edges_expander(gen_list_t *t, sl_int degree, uint64_t *state) {
    for (sl_int k = 1; k < t->n; k++) {
        for (sl_int e = 0; e < degree; e++) {
            const sl_int other = gen_below(state, k);
            gen_add(t, k, other, gen_real(state));
        }
    }
}

/* A sparse band and two dense rows, each adjacent to all rows. */
static inline void edges_dense_rows(gen_list_t *t, uint64_t *state) {
    gen_edges_star(t, 7, state);
    for (sl_int k = 0; k < t->n; k++) {
        if (k != 7 && k != 9) {
            gen_add(t, 9, k, gen_real(state));
        }
    }
    for (sl_int k = 60; k < t->n; k++) {
        gen_add(t, k, k - 1, gen_real(state));
        gen_add(t, k, k - 50, gen_real(state));
    }
}

/* A triangulated grid: squares with one diagonal each. */
static inline void edges_triangles(gen_list_t *t, sl_int nx, sl_int ny, uint64_t *state) {
    gen_edges_grid(t, nx, ny, 1, state);
    for (sl_int y = 1; y < ny; y++) {
        for (sl_int x = 1; x < nx; x++) {
            gen_add(t, x + nx * y, x - 1 + nx * (y - 1), gen_real(state));
        }
    }
}

/* Two grids joined along a row of vertices, only one of them triangulated. */
static inline void edges_book(gen_list_t *t, sl_int side, uint64_t *state) {
    edges_triangles(t, side, side, state);
    for (sl_int y = 0; y < side; y++) {
        for (sl_int x = 0; x < side; x++) {
            const sl_int v = side * side + x + side * y;
            gen_add(t, v, y == 0 ? x : v - side, gen_real(state));
            if (x > 0) {
                gen_add(t, v, v - 1, gen_real(state));
            }
        }
    }
}

enum {
    HARD_NO_EDGES,
    HARD_PATH,
    HARD_STAR,
    HARD_TWO_HUBS,
    HARD_CATERPILLAR,
    HARD_CLIQUE,
    HARD_CLIQUES,
    HARD_TREE,
    HARD_EXPANDER,
    HARD_DENSE_ROWS,
    HARD_TRIANGLES,
    HARD_STRIP,
    HARD_BOOK,
    HARD_GRID,
    HARD_VOLUME,
    HARD_COMPONENTS,
    HARD_KINDS
};

static inline gen_list_t hard_graph(int kind) {
    static const sl_int rows[HARD_KINDS] = {3000, 6000, 4000, 3000, 4000, 500,  1500, 4000,
                                            700,  2500, 3600, 4000, 2450, 2500, 2744, 6000};
    gen_list_t t = gen_list(rows[kind]);
    uint64_t state = 77;
    switch (kind) {
    case HARD_PATH:
        gen_edges_path(&t, &state);
        break;
    case HARD_STAR:
        gen_edges_star(&t, 11, &state);
        break;
    case HARD_TWO_HUBS:
        edges_caterpillar(&t, 2, &state);
        break;
    case HARD_CATERPILLAR:
        edges_caterpillar(&t, 40, &state);
        break;
    case HARD_CLIQUE:
        gen_edges_random(&t, 1000, &state);
        break;
    case HARD_CLIQUES:
        edges_cliques(&t, 30, &state);
        break;
    case HARD_TREE:
        edges_tree(&t, &state);
        break;
    case HARD_EXPANDER:
        edges_expander(&t, 2, &state);
        break;
    case HARD_DENSE_ROWS:
        edges_dense_rows(&t, &state);
        break;
    case HARD_TRIANGLES:
        edges_triangles(&t, 60, 60, &state);
        break;
    case HARD_STRIP:
        edges_triangles(&t, 4, 1000, &state);
        break;
    case HARD_BOOK:
        edges_book(&t, 35, &state);
        break;
    case HARD_GRID:
        gen_edges_grid(&t, 50, 50, 1, &state);
        break;
    case HARD_VOLUME:
        gen_edges_grid(&t, 14, 14, 14, &state);
        break;
    case HARD_COMPONENTS:
        gen_components(&t, &state);
        break;
    default:
        break;
    }
    for (sl_int k = 0; k < t.n; k++) {
        gen_add(&t, k, k, 1.0);
    }
    return t;
}

#endif

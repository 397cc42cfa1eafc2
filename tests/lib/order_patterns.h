/* order_patterns.h: patterns of 1500 to 11000 rows that an ordering has to deal with */
#ifndef SL_TEST_ORDER_PATTERNS_H
#define SL_TEST_ORDER_PATTERNS_H

#include "gen_matrices.h"

/* Each row is adjacent to two random earlier rows: no small separators, so that the costs of cuts
 * are close to each other. */
static inline void edges_expander(gen_list_t *t, uint64_t *state) {
    for (sl_int k = 1; k < t->n; k++) {
        gen_add(t, k, gen_below(state, k), 1.0);
        gen_add(t, k, gen_below(state, k), 1.0);
    }
}

/* Cliques of 3 rows on a grid: compressed before they are ordered. */
static inline void edges_cliques(gen_list_t *t, sl_int side, uint64_t *state) {
    gen_list_t grid = gen_list(side * side);
    gen_edges_grid(&grid, side, side, 1, state);
    for (size_t k = 0; k < grid.count; k++) {
        for (sl_int c = 0; c < 9; c++) {
            gen_add(t, 3 * grid.row[k] + c / 3, 3 * grid.col[k] + c % 3, 1.0);
        }
    }
    gen_list_free(&grid);
}

/* Squares of 5 x 5 rows on a grid are cliques: a wide graph, coarsened by neighborhoods. */
static inline void edges_squares(gen_list_t *t, sl_int side) {
    for (sl_int v = 0; v < t->n; v++) {
        for (sl_int k = 3; k < 15; k++) {
            const sl_int x = v % side + k % 5 - 2, y = v / side + k / 5;
            if (x >= 0 && x < side && y < side) {
                gen_add(t, x + side * y, v, 1.0);
            }
        }
    }
}

enum {
    ORDER_GRID,
    ORDER_RENAMED,
    ORDER_VOLUME,
    ORDER_STRIP,
    ORDER_PATH,
    ORDER_DENSE_ROW,
    ORDER_FOREST,
    ORDER_RANDOM,
    ORDER_EXPANDER,
    ORDER_CLIQUES,
    ORDER_WIDE,
    ORDER_COMPONENTS,
    ORDER_FANS,
    ORDER_KINDS
};

static inline gen_list_t pattern(int kind) {
    static const sl_int rows[ORDER_KINDS] = {10000, 10000, 10648, 6000, 5000, 5000,
                                             5000,  1500,  3000,  5043, 6400, 6000, 6144};
    gen_list_t t = gen_list(rows[kind]);
    uint64_t state = 11;
    switch (kind) {
    case ORDER_GRID:
    case ORDER_RENAMED:
        gen_edges_grid(&t, 100, 100, 1, &state);
        break;
    case ORDER_VOLUME:
        gen_edges_grid(&t, 22, 22, 22, &state);
        break;
    case ORDER_STRIP:
        gen_edges_grid(&t, 6, 1000, 1, &state);
        break;
    case ORDER_PATH:
        gen_edges_path(&t, &state);
        break;
    case ORDER_DENSE_ROW:
        gen_edges_grid(&t, 50, 100, 1, &state);
        gen_edges_star(&t, 7, &state);
        break;
    case ORDER_FOREST:
        gen_edges_forest(&t, &state);
        break;
    case ORDER_RANDOM:
        gen_edges_random(&t, 3, &state);
        break;
    case ORDER_EXPANDER:
        edges_expander(&t, &state);
        break;
    case ORDER_CLIQUES:
        edges_cliques(&t, 41, &state);
        break;
    case ORDER_WIDE:
        edges_squares(&t, 80);
        break;
    case ORDER_FANS:
        gen_edges_fans(&t, 2048, &state);
        break;
    default:
        gen_components(&t, &state);
        break;
    }
    if (kind != ORDER_GRID) {
        gen_rename(&t, 5);
    }
    for (sl_int k = 0; k < t.n; k++) {
        gen_add(&t, k, k, 1.0);
    }
    return t;
}

#endif

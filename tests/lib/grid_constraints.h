/* grid_constraints.h: a grid with constraints, [H C'; C -shift], and its factor */
#ifndef SL_TEST_GRID_CONSTRAINTS_H
#define SL_TEST_GRID_CONSTRAINTS_H

#include "factored.h"

enum { GRID_SIDE = 15, GRID_ROWS = GRID_SIDE * GRID_SIDE, GRID_ALL = GRID_ROWS + GRID_ROWS / 4 };

/* Where the shift is: on the diagonal, or by regularization. Large: on the diagonal, and a row of
 * the grid has a diagonal entry of 1e12, beside which growth is small. */
typedef enum grid_shift_t {
    SHIFT_DIAGONAL,
    SHIFT_REGULARIZED,
    SHIFT_LARGE,
    GRID_SHIFTS
} grid_shift_t;

/* H is a Laplacian + 0.1; a constraint joins three random rows of H. All have one pattern. */
static inline gen_matrix_t grid_constraints(double shift, grid_shift_t kind) {
    gen_list_t t = gen_list(GRID_ALL);
    uint64_t seed = 99;
    for (sl_int j = 0; j < GRID_ROWS; j++) {
        gen_add(&t, j, j, kind == SHIFT_LARGE && j == 17 ? 1e12 : 4.1);
        if ((j + 1) % GRID_SIDE) {
            gen_add(&t, j + 1, j, -1.0);
        }
        if (j + GRID_SIDE < GRID_ROWS) {
            gen_add(&t, j + GRID_SIDE, j, -1.0);
        }
    }
    for (sl_int k = GRID_ROWS; k < GRID_ALL; k++) {
        sl_int row = gen_below(&seed, GRID_ROWS / 3);
        for (int e = 0; e < 3; e++) {
            gen_add(&t, k, row, gen_real(&seed));
            row += 1 + gen_below(&seed, GRID_ROWS / 3);
        }
        gen_add(&t, k, k, kind == SHIFT_REGULARIZED ? 0.0 : -shift);
    }
    const gen_matrix_t M = gen_store(&t, gen_style(0), 1);
    gen_list_free(&t);
    return M;
}

/* The factor, with the instruction set, method and allocator of opt. */
static inline factored_t grid_factored(double shift, grid_shift_t kind, sl_options opt,
                                       sl_stats *stats) {
    factored_t y = {grid_constraints(shift, kind), NULL, NULL};
    sl_int signs[GRID_ALL];
    for (sl_int k = 0; k < GRID_ALL; k++) {
        signs[k] = k < GRID_ROWS ? 1 : -1;
    }
    SL_CHECK(sl_symbolic_create(&y.S, &y.M.view, FOR_ANALYSIS(&opt), NULL));
    if (kind == SHIFT_REGULARIZED) {
        opt.regularization = shift;
        opt.signs = signs;
    }
    SL_CHECK(sl_factor_create(&y.F, y.S, &y.M.view, FOR_FACTOR(&opt), stats));
    return y;
}

#endif

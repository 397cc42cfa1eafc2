/* test_order_kkt.c: KKT systems are dissected only where that can win: on chains */
#include "tests/lib/ordering_meshes.h"

/* Variables 0 .. variables-1, then constraints; a diagonal entry in each row. */
static gen_list_t kkt(sl_int variables, sl_int constraints) {
    gen_list_t t = gen_list(variables + constraints);
    for (sl_int k = 0; k < t.n; k++) {
        gen_add(&t, k, k, k < variables ? 1.0 : -1.0);
    }
    return t;
}

/* A bound of variable v is constraint v. */
static void add_bounds(gen_list_t *t, sl_int first, sl_int from, sl_int to) {
    for (sl_int v = from; v < to; v++) {
        gen_add(t, first + v - from, v, 1.0);
    }
}

/* L y = u on a grid, and bounds on u: rows y, u, constraints, bounds. */
static gen_list_t pde_control(sl_int side) {
    const sl_int m = side * side;
    gen_list_t t = kkt(2 * m, 2 * m);
    for (sl_int v = 0; v < m; v++) {
        const sl_int x = v % side, row = 2 * m + v;
        gen_add(&t, row, v, 4.0);
        gen_add(&t, row, m + v, -1.0);
        if (x > 0) {
            gen_add(&t, row, v - 1, -1.0);
            gen_add(&t, row - 1, v, -1.0);
        }
        if (v >= side) {
            gen_add(&t, row, v - side, -1.0);
            gen_add(&t, row - side, v, -1.0);
        }
    }
    add_bounds(&t, 3 * m, m, 2 * m);
    return t;
}

/* Half of the variables are joined to another one; a constraint has 4 variables anywhere. */
static gen_list_t random_program(sl_int variables) {
    gen_list_t t = kkt(variables, variables / 2);
    uint64_t seed = 5;
    for (sl_int v = 2; v < variables; v += 2) {
        gen_add(&t, v, gen_below(&seed, v), 0.1);
    }
    for (sl_int k = variables; k < t.n; k++) {
        for (int c = 0; c < 4; c++) {
            gen_add(&t, k, gen_below(&seed, variables), 0.5);
        }
    }
    return t;
}

/* Least squares: each of 100 residuals for each column is a constraint on a seventh of the
 * columns. */
static gen_list_t least_squares(sl_int columns) {
    const sl_int m = 100 * columns, variables = columns + m;
    gen_list_t t = kkt(variables, m);
    uint64_t seed = 3;
    for (sl_int k = 0; k < m; k++) {
        gen_add(&t, variables + k, columns + k, -1.0);
        for (sl_int v = 0; v < columns; v++) {
            if (gen_below(&seed, 7) == 0) {
                gen_add(&t, variables + k, v, 0.5);
            }
        }
    }
    return t;
}

/* Constraints without bounds: a sixth of all entries is not zero. */
static gen_list_t dense_constraints(sl_int variables) {
    gen_list_t t = kkt(variables, variables / 2);
    uint64_t seed = 5;
    for (sl_int k = 0; k < t.n; k++) {
        for (sl_int v = 0; v < (k < variables ? k : variables); v++) {
            if (gen_below(&seed, 6) == 0) {
                gen_add(&t, k, v, 0.5);
            }
        }
    }
    return t;
}

/* A linear system of 8 states and 3 inputs over `steps` steps, half of its entries 0; bounds. */
static gen_list_t horizon(sl_int steps) {
    enum { STATES = 8, STEP = 11 };
    const sl_int variables = steps * STEP, bounds = variables + steps * STATES;
    gen_list_t t = kkt(variables, steps * STATES + variables);
    uint64_t seed = 8;
    for (sl_int k = 0; k < steps * STATES; k++) {
        const sl_int step = k / STATES;
        gen_add(&t, variables + k, step * STEP + k % STATES, -1.0);
        for (sl_int j = 0; j < STEP && step > 0; j++) {
            if (gen_below(&seed, 2) == 0) {
                gen_add(&t, variables + k, (step - 1) * STEP + j, 0.5);
            }
        }
    }
    add_bounds(&t, bounds, 0, variables);
    return t;
}

/* Constraint k is one on the variables k - 2 .. k + 2; bounds. */
static gen_list_t chain(sl_int variables) {
    gen_list_t t = kkt(variables, 2 * variables);
    for (sl_int k = 0; k < variables; k++) {
        for (sl_int v = k < 2 ? 0 : k - 2; v <= k + 2 && v < variables; v++) {
            gen_add(&t, variables + k, v, 0.5);
        }
    }
    add_bounds(&t, 2 * variables, 0, variables);
    return t;
}

/* All variables in one dense block; bounds. */
static gen_list_t dense_program(sl_int variables) {
    gen_list_t t = kkt(variables, variables);
    for (sl_int v = 0; v < variables; v++) {
        for (sl_int k = 0; k < v; k++) {
            gen_add(&t, v, k, 0.5);
        }
    }
    add_bounds(&t, variables, 0, variables);
    return t;
}

/* What the default order costs relative to minimum degree. */
static order_quality relative(gen_list_t *t) {
    gen_matrix_t M = gen_store(t, gen_style(0), 1);
    sl_options opt = options_none();
    order_quality chosen = order_quality_of(&M.view, &opt), mindeg;
    opt.ordering = SL_ORDERING_MINDEG;
    mindeg = order_quality_of(&M.view, &opt);
    chosen.fill /= mindeg.fill;
    chosen.path /= mindeg.path;
    print_message("%.3f times the entries of minimum degree, %.3f times the path weight\n",
                  chosen.fill, chosen.path);
    gen_matrix_free(&M);
    gen_list_free(t);
    return chosen;
}

/* By dissection: 1.20 times the entries, 0.81 times the path weight, 3 to 5 times the time. */
static void control_in_the_plane_is_not_dissected(void **state) {
    (void)state;
    gen_list_t t = pde_control(50);
    const order_quality q = relative(&t);
    assert_true(q.fill < 1.02 && q.path < 1.02);
}

/* By dissection: 1.46 times the entries, 1.12 times the path weight. */
static void random_constraints_are_not_dissected(void **state) {
    (void)state;
    gen_list_t t = random_program(2000);
    const order_quality q = relative(&t);
    assert_true(q.fill < 1.02 && q.path < 1.02);
}

static void horizons_are_dissected(void **state) {
    (void)state;
    gen_list_t t = horizon(300);
    const order_quality q = relative(&t);
    assert_true(q.path < 0.3);
}

/* Its graph is bipartite, as that of control in the plane is. */
static void chains_of_constraints_are_dissected(void **state) {
    (void)state;
    gen_list_t t = chain(1000);
    const order_quality q = relative(&t);
    assert_true(q.path < 0.3);
}

/* By dissection: 1.75 times the entries, 1.36 times the path weight. No row is peeled. */
static void dense_constraints_are_not_dissected(void **state) {
    (void)state;
    gen_list_t t = dense_constraints(400);
    const order_quality q = relative(&t);
    assert_true(q.fill < 1.02 && q.path < 1.02);
}

/* Dissection has no fill either, and 0.995 times the path weight. */
static void least_squares_are_not_dissected(void **state) {
    (void)state;
    gen_list_t t = least_squares(30);
    const order_quality q = relative(&t);
    assert_true(q.fill == 1.0 && q.path == 1.0);
}

/* Without the bounds each row has too many neighbors for minimum degree, which counts none. */
static void dense_programs_have_no_fill(void **state) {
    (void)state;
    const sl_int variables = 200;
    gen_list_t t = dense_program(variables);
    gen_matrix_t M = gen_store(&t, gen_style(0), 1);
    const order_quality q = order_quality_of(&M.view, NULL);
    assert_true(q.fill == 0.5 * variables * (variables + 1) + 2 * variables);
    gen_matrix_free(&M);
    gen_list_free(&t);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(control_in_the_plane_is_not_dissected),
        cmocka_unit_test(random_constraints_are_not_dissected),
        cmocka_unit_test(dense_constraints_are_not_dissected),
        cmocka_unit_test(least_squares_are_not_dissected),
        cmocka_unit_test(horizons_are_dissected),
        cmocka_unit_test(chains_of_constraints_are_dissected),
        cmocka_unit_test(dense_programs_have_no_fill),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

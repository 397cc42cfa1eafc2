/* kkt_programs.c: KKT systems of quadratic programs, as triplets */
#include "kkt_programs.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const double shift = 1e-6, inequality = -10.0, equation = -0.01; /* -1/r */

/* The lower triangle of K as triplets. The generators fill it twice: first they only count. */
typedef struct triplets {
    sl_int n, count, room;
    sl_int *row, *column;
    double *x;
    uint64_t rng;
} triplets;

static void add(triplets *t, sl_int i, sl_int j, double x) {
    if (t->count < t->room) {
        t->row[t->count] = i > j ? i : j;
        t->column[t->count] = i > j ? j : i;
        t->x[t->count] = x;
    }
    t->count++;
}

/* An entry with a probability of `percent`. */
static void add_some(triplets *t, sl_int i, sl_int j, sl_int percent) {
    const double x = bench_random_unit(&t->rng);
    if (bench_random_below(&t->rng, 100) < percent) {
        add(t, i, j, x);
    }
}

static void diagonal(triplets *t, sl_int first, sl_int count, double x) {
    for (sl_int k = 0; k < count; k++) {
        add(t, first + k, first + k, x);
    }
}

/* P = M M' of M with 15 % of entries, and `rows` constraints with 15 % as well. */
static void dense_program(triplets *t, sl_int variables, sl_int rows, double penalty) {
    const size_t n = (size_t)variables;
    double *M = bench_alloc(n * n, sizeof *M);
    for (size_t k = 0; k < n * n; k++) {
        const double x = bench_random_unit(&t->rng);
        M[k] = bench_random_below(&t->rng, 100) < 15 ? x : 0.0;
    }
    for (size_t j = 0; j < n; j++) {
        for (size_t i = j; i < n; i++) {
            double sum = i == j ? 0.01 + shift : 0.0;
            for (size_t k = 0; k < n; k++) {
                sum += M[k * n + i] * M[k * n + j];
            }
            if (sum != 0.0) {
                add(t, (sl_int)i, (sl_int)j, sum);
            }
        }
    }
    free(M);
    diagonal(t, variables, rows, penalty);
    for (sl_int r = 0; r < rows; r++) {
        for (sl_int j = 0; j < variables; j++) {
            add_some(t, variables + r, j, 15);
        }
    }
    t->n = variables + rows;
}

/* Assets x and factors y = F' x, with half of the entries of F; the sum of x is given, x >= 0. */
static void portfolio(triplets *t, sl_int factors) {
    const sl_int assets = 100 * factors, sum = assets + factors, y = sum + 1, bounds = y + factors;
    for (sl_int i = 0; i < assets; i++) {
        add(t, i, i, sqrt((double)factors) * fabs(bench_random_unit(&t->rng)) + shift);
        add(t, sum, i, 1.0);
        add(t, bounds + i, i, 1.0);
        for (sl_int k = 0; k < factors; k++) {
            add_some(t, y + k, i, 50);
        }
    }
    diagonal(t, assets, factors, 1.0 + shift);
    diagonal(t, sum, 1 + factors, equation);
    diagonal(t, bounds, assets, inequality);
    for (sl_int k = 0; k < factors; k++) {
        add(t, y + k, assets + k, -1.0);
    }
    t->n = bounds + assets;
}

/* 15 % of the entries of a row of data, in the first columns. */
static void data_row(triplets *t, sl_int row, sl_int features) {
    for (sl_int j = 0; j < features; j++) {
        add_some(t, row, j, 15);
    }
}

/* min y'y + sum w: y = D x - b, -w <= x <= w; 100 points for each feature, as in the next two. */
static void lasso(triplets *t, sl_int features) {
    const sl_int points = 100 * features, w = features + points, rows = w + features;
    const sl_int low = rows + points, high = low + features;
    diagonal(t, 0, features, shift);
    diagonal(t, features, points, 2.0 + shift);
    diagonal(t, w, features, shift);
    diagonal(t, rows, points, equation);
    diagonal(t, low, 2 * features, inequality);
    for (sl_int r = 0; r < points; r++) {
        data_row(t, rows + r, features);
        add(t, rows + r, features + r, -1.0);
    }
    for (sl_int j = 0; j < features; j++) {
        add(t, low + j, j, 1.0);
        add(t, low + j, w + j, -1.0);
        add(t, high + j, j, 1.0);
        add(t, high + j, w + j, 1.0);
    }
    t->n = high + features;
}

/* min x'x + sum v: v >= D x + 1, v >= 0. */
static void support_vectors(triplets *t, sl_int features) {
    const sl_int points = 100 * features, rows = features + points, bounds = rows + points;
    diagonal(t, 0, features, 1.0 + shift);
    diagonal(t, features, points, shift);
    diagonal(t, rows, 2 * points, inequality);
    for (sl_int r = 0; r < points; r++) {
        data_row(t, rows + r, features);
        add(t, rows + r, features + r, -1.0);
        add(t, bounds + r, features + r, 1.0);
    }
    t->n = bounds + points;
}

/* min u'u + sum (r + s): D x - b - u = r - s, r >= 0, s >= 0. */
static void huber(triplets *t, sl_int features) {
    const sl_int points = 100 * features, u = features, r = u + points, s = r + points;
    const sl_int rows = s + points, low = rows + points, high = low + points;
    diagonal(t, 0, features, shift);
    diagonal(t, u, points, 1.0 + shift);
    diagonal(t, r, 2 * points, shift);
    diagonal(t, rows, points, equation);
    diagonal(t, low, 2 * points, inequality);
    for (sl_int k = 0; k < points; k++) {
        data_row(t, rows + k, features);
        add(t, rows + k, u + k, -1.0);
        add(t, rows + k, r + k, -1.0);
        add(t, rows + k, s + k, 1.0);
        add(t, low + k, r + k, 1.0);
        add(t, high + k, s + k, 1.0);
    }
    t->n = high + points;
}

/* 10 steps of a dense system x' = F x + G u with half as many inputs as states; a dense cost of the
 * last state; bounds on all. */
static void control(triplets *t, sl_int states) {
    enum { STEPS = 10 };
    const sl_int inputs = states / 2, u = states * (STEPS + 1), variables = u + inputs * STEPS;
    const sl_int rows = variables, bounds = rows + states * (STEPS + 1);
    for (sl_int k = 0; k < u; k++) {
        const double q = 10.0 * fabs(bench_random_unit(&t->rng));
        add(t, k, k, shift + (bench_random_below(&t->rng, 100) < 70 ? q : 0.0));
    }
    diagonal(t, u, inputs * STEPS, 0.1 + shift);
    for (sl_int j = 0; j < states; j++) {
        for (sl_int i = j + 1; i < states; i++) {
            add(t, states * STEPS + i, states * STEPS + j, 0.1 * bench_random_unit(&t->rng));
        }
    }
    diagonal(t, rows, states * (STEPS + 1), equation);
    diagonal(t, bounds, variables, inequality);
    for (sl_int k = 0; k < states * (STEPS + 1); k++) {
        const sl_int step = k / states - 1;
        add(t, rows + k, k, -1.0);
        for (sl_int j = 0; j < states && step >= 0; j++) {
            const double x = 0.1 * bench_random_unit(&t->rng);
            add(t, rows + k, step * states + j, x + (j == k % states ? 1.0 : 0.0));
        }
        for (sl_int j = 0; j < inputs && step >= 0; j++) {
            add(t, rows + k, u + step * inputs + j, bench_random_unit(&t->rng));
        }
    }
    for (sl_int k = 0; k < variables; k++) {
        add(t, bounds + k, k, 1.0);
    }
    t->n = bounds + variables;
}

/* Half of the variables have an entry of P with another one; a constraint has 3 variables. */
static void sparse_program(triplets *t, sl_int variables) {
    t->n = 3 * variables;
    for (sl_int k = 0; k < variables; k++) {
        const sl_int other = bench_random_below(&t->rng, variables);
        add(t, k, k, 4 + shift);
        if (k % 2 == 0 && other != k) {
            add(t, other, k, bench_random_unit(&t->rng));
        }
    }
    for (sl_int k = variables; k < t->n; k++) {
        sl_int v = bench_random_below(&t->rng, variables);
        for (int c = 0; c < 3; c++) {
            add(t, k, v, bench_random_unit(&t->rng));
            v = (v + 1 + bench_random_below(&t->rng, variables / 4)) % variables;
        }
    }
    diagonal(t, variables, 2 * variables, inequality);
}

/* A linear system of 10 states and 4 inputs over `steps` steps: x' = F x + G u, half of the entries
 * of F and G zero; bounds on all. */
static void mpc_program(triplets *t, sl_int steps) {
    enum { STATES = 10, INPUTS = 4, STEP = STATES + INPUTS };
    const sl_int variables = steps * STEP, bounds = variables + steps * STATES;
    t->n = bounds + variables;
    for (sl_int k = 0; k < variables; k++) {
        add(t, k, k, 1 + shift);
        add(t, bounds + k, k, 1);
    }
    for (sl_int s = 0; s < steps; s++) {
        for (sl_int i = 0; i < STATES; i++) {
            const sl_int row = variables + s * STATES + i;
            add(t, row, s * STEP + i, -1);
            for (sl_int j = 0; j < STEP && s > 0; j++) {
                add_some(t, row, (s - 1) * STEP + j, 50);
            }
        }
    }
    diagonal(t, variables, bounds, inequality);
}

/* A state y on a grid, L y = u with a five-point Laplacian L, and bounds on u. */
static void pde_program(triplets *t, sl_int side) {
    const sl_int m = side * side;
    t->n = 4 * m;
    for (sl_int v = 0; v < m; v++) {
        add(t, v, v, 1 + shift);
        add(t, m + v, m + v, 0.01 + shift);
        add(t, 2 * m + v, v, 4);
        add(t, 2 * m + v, m + v, -1);
        add(t, 3 * m + v, m + v, 1);
        for (int k = 0; k < 4; k++) {
            const sl_int x = v % side + (k == 0) - (k == 1), y = v / side + (k == 2) - (k == 3);
            if (x >= 0 && x < side && y >= 0 && y < side) {
                add(t, 2 * m + v, x + side * y, -1);
            }
        }
    }
    diagonal(t, 2 * m, 2 * m, inequality);
}

/* The sizes are numbers of variables, factors, features, states, steps, or a side. */
static const struct {
    const char *name;
    void (*fill)(triplets *t, sl_int size);
    sl_int size[2];
} programs[KKT_KINDS] = {
    {"random QP", NULL, {30, 150}},     {"equality QP", NULL, {100, 500}},
    {"portfolio", portfolio, {10, 50}}, {"lasso", lasso, {10, 60}},
    {"SVM", support_vectors, {10, 60}}, {"Huber", huber, {10, 60}},
    {"control", control, {10, 40}},     {"sparse QP", sparse_program, {500, 2000}},
    {"MPC", mpc_program, {100, 1158}},  {"PDE control", pde_program, {30, 100}}};

const char *kkt_name(kkt_kind kind) {
    return programs[kind].name;
}

sl_matrix *kkt_matrix(kkt_kind kind, int size) {
    const sl_int m = programs[kind].size[size];
    triplets t;
    sl_matrix *M = NULL;
    memset(&t, 0, sizeof t);
    for (int pass = 0; pass < 2; pass++) {
        t.room = t.count;
        t.row = bench_alloc((size_t)t.room + 1, sizeof *t.row);
        t.column = bench_alloc((size_t)t.room + 1, sizeof *t.column);
        t.x = bench_alloc((size_t)t.room + 1, sizeof *t.x);
        t.count = 0;
        t.rng = 7;
        if (kind == KKT_RANDOM) {
            dense_program(&t, m, 10 * m, inequality);
        } else if (kind == KKT_EQUALITY) {
            dense_program(&t, m, m / 2, equation);
        } else {
            programs[kind].fill(&t, m);
        }
        if (pass == 1) {
            bench_must(
                sl_matrix_from_triplets(&M, t.n, t.n, t.count, t.row, t.column, t.x, NULL, NULL),
                "assembling");
        }
        free(t.row);
        free(t.column);
        free(t.x);
    }
    return M;
}

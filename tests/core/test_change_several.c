/* test_change_several.c: what several vectors at once lose where pivots grow, and drift says */
#include "tests/lib/gen_graphs.h"
#include "tests/lib/test.h"

enum { MOST = 6, MOST_VECTORS = 4 };

/* A small matrix with a factor in natural order, and what it becomes, in long double. */
typedef struct small_t {
    sl_int n;
    long double a[MOST][MOST];
    sl_symbolic *S;
    sl_factor *F;
} small_t;

static double number(uint64_t *rng, double low, double high) {
    return low + (high - low) * fabs(gen_real(rng));
}

/* 1, 1e-3 or 1e-6, times a number of that size. */
static double tiny(uint64_t *rng) {
    const double size = pow(1e-3, (double)gen_below(rng, 3));
    return size * number(rng, 0.5, 1.5);
}

/* L D L' with pivots that may be tiny, and entries of L that are large beside them. */
static void fill_definite(small_t *y, uint64_t *rng) {
    double l[MOST][MOST] = {{0.0}}, d[MOST];
    for (sl_int j = 0; j < y->n; j++) {
        d[j] = tiny(rng);
        l[j][j] = 1.0;
        for (sl_int i = j + 1; i < y->n; i++) {
            l[i][j] = gen_real(rng) / sqrt(d[j]);
        }
    }
    for (sl_int i = 0; i < y->n; i++) {
        for (sl_int j = 0; j <= i; j++) {
            double sum = 0.0;
            for (sl_int k = 0; k <= j; k++) {
                sum += l[i][k] * d[k] * l[j][k];
            }
            y->a[i][j] = y->a[j][i] = sum;
        }
    }
}

/* Entries are multiples of 1/4, and some of the diagonal nearly 0. */
static void fill_indefinite(small_t *y, uint64_t *rng) {
    for (sl_int i = 0; i < y->n; i++) {
        for (sl_int j = 0; j < i; j++) {
            y->a[i][j] = y->a[j][i] = (double)(gen_below(rng, 9) - 4) / 4.0;
        }
        y->a[i][i] = gen_below(rng, 4) ? 1.0 : 1e-6;
        y->a[i][i] *= gen_below(rng, 2) ? 1.0 : -1.0;
    }
}

/* Returns whether there is a factor. */
static int factor_small(small_t *y) {
    sl_int p[MOST + 1], i[MOST * MOST], count = 0;
    double x[MOST * MOST];
    sl_options options;
    sl_status status;
    memset(&options, 0, sizeof options);
    options.ordering = SL_ORDERING_NATURAL;
    for (sl_int j = 0; j < y->n; j++) {
        p[j] = count;
        for (sl_int k = j; k < y->n; k++) {
            i[count] = k;
            x[count++] = (double)y->a[k][j];
        }
    }
    p[y->n] = count;
    const sl_csc A = {y->n, y->n, p, i, x};
    SL_CHECK(sl_symbolic_create(&y->S, &A, &options, NULL));
    status = sl_factor_create(&y->F, y->S, &A, NULL, NULL);
    assert_true(status == SL_OK || status == SL_ERR_PIVOT || status == SL_ERR_INACCURATE);
    return status == SL_OK;
}

/* The backward error of a solve. */
static double error_of(const small_t *y, uint64_t *rng) {
    double b[MOST], x[MOST];
    long double most = 0.0, largest = 0.0, error = 0.0;
    for (sl_int k = 0; k < y->n; k++) {
        b[k] = gen_real(rng);
    }
    SL_CHECK(sl_factor_solve(y->F, x, (size_t)y->n, b, (size_t)y->n, 1, NULL));
    for (sl_int i = 0; i < y->n; i++) {
        long double r = b[i];
        for (sl_int j = 0; j < y->n; j++) {
            r -= y->a[i][j] * x[j];
            largest = fmaxl(largest, fabsl(y->a[i][j]));
        }
        error = fmaxl(error, fabsl(r));
        most = fmaxl(most, fabs(x[i]));
    }
    return (double)(error / (largest * most + 1.0));
}

/* Two to four vectors, with weights of both signs. Returns whether the change was accepted. */
static int update_small(small_t *y, uint64_t *rng, sl_stats *stats) {
    const sl_int count = 2 + gen_below(rng, MOST_VECTORS - 1);
    sl_int p[MOST_VECTORS + 1], i[MOST_VECTORS * MOST], at = 0;
    double x[MOST_VECTORS * MOST], sigma[MOST_VECTORS];
    for (sl_int v = 0; v < count; v++) {
        p[v] = at;
        for (sl_int k = 0; k < y->n; k++) {
            if (k == y->n - 1 || gen_below(rng, 2)) {
                i[at] = k;
                x[at] = pow(1e-2, (double)gen_below(rng, 3));
                x[at++] *= gen_real(rng);
            }
        }
        sigma[v] = gen_below(rng, 3) ? 1.0 : -0.01 * fabs(gen_real(rng));
    }
    p[count] = at;
    const sl_csc V = {y->n, count, p, i, x};
    const sl_status status = sl_factor_rank_update(y->F, &V, sigma, NULL, stats);
    assert_true(status == SL_OK || status == SL_ERR_PIVOT || status == SL_ERR_INACCURATE);
    for (sl_int v = 0; v < count && status == SL_OK; v++) {
        for (sl_int s = p[v]; s < p[v + 1]; s++) {
            for (sl_int t = p[v]; t < p[v + 1]; t++) {
                y->a[i[s]][i[t]] += (long double)sigma[v] * x[s] * x[t];
            }
        }
    }
    return status == SL_OK;
}

/* One entry off the diagonal, which two vectors change. */
static int change_small(small_t *y, uint64_t *rng, sl_stats *stats) {
    const sl_int row = 1 + gen_below(rng, y->n - 1), column = gen_below(rng, row);
    const double size = 0.25 * (double)(1 + gen_below(rng, 4));
    const double delta = gen_below(rng, 2) ? size : -size;
    const sl_status status =
        sl_factor_change_entries(y->F, NULL, &row, &column, &delta, 1, NULL, stats);
    assert_true(status == SL_OK || status == SL_ERR_PIVOT || status == SL_ERR_INACCURATE);
    if (status == SL_OK) {
        y->a[row][column] += delta;
        y->a[column][row] = y->a[row][column];
    }
    return status == SL_OK;
}

/* Sequences of six changes. The error is at most `factor` times what growth and drift say. */
static void run(int is_definite, int count, double factor) {
    uint64_t rng = 5;
    int accepted = 0;
    for (int k = 0; k < count; k++) {
        small_t y;
        sl_stats stats;
        memset(&y, 0, sizeof y);
        memset(&stats, 0, sizeof stats);
        y.n = 2 + gen_below(&rng, MOST - 1);
        if (is_definite) {
            fill_definite(&y, &rng);
        } else {
            fill_indefinite(&y, &rng);
        }
        for (int step = 0, is_there = factor_small(&y); step < 6 && is_there; step++) {
            if (is_definite ? update_small(&y, &rng, &stats) : change_small(&y, &rng, &stats)) {
                const double said = fmax(DBL_EPSILON * stats.factor.growth, stats.change.drift);
                assert_true(error_of(&y, &rng) <= factor * said);
                accepted++;
            }
        }
        sl_factor_free(y.F);
        sl_symbolic_free(y.S);
    }
    assert_true(accepted >= count);
}

static void updates_of_tiny_pivots_say_what_they_lose(void **state) {
    (void)state;
    run(1, 5000, 4.0);
}

static void entries_of_indefinite_matrices_say_what_they_lose(void **state) {
    (void)state;
    run(0, 20000, 100.0);
}

/* The pivot -2e-6 becomes -0.5; the last one was computed from 281,249. */
static void a_pivot_grows_below_a_large_row(void **state) {
    const sl_int row = 1, column = 0;
    const double delta = -0.5;
    uint64_t rng = 1;
    small_t y;
    sl_stats stats;
    (void)state;
    memset(&y, 0, sizeof y);
    y.n = 3;
    y.a[0][0] = 0.5;
    y.a[1][1] = -2e-6;
    y.a[2][1] = y.a[1][2] = 0.75;
    y.a[2][2] = -1.0;
    assert_true(factor_small(&y));
    SL_CHECK(sl_factor_change_entries(y.F, NULL, &row, &column, &delta, 1, NULL, &stats));
    y.a[1][0] = y.a[0][1] = -0.5;
    const double error = error_of(&y, &rng);
    assert_true(error > 1e-8);
    assert_true(stats.change.drift >= error);
    sl_factor_free(y.F);
    sl_symbolic_free(y.S);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(updates_of_tiny_pivots_say_what_they_lose),
        cmocka_unit_test(entries_of_indefinite_matrices_say_what_they_lose),
        cmocka_unit_test(a_pivot_grows_below_a_large_row),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

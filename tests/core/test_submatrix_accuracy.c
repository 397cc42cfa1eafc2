/* test_submatrix_accuracy.c: restrictions and pins of all families of random systems: right or
 * refused */
#include "tests/lib/random_systems.h"
#include "tests/lib/subset.h"
#include "tests/lib/constraint_calls.h"

typedef struct tally_t {
    int solved, refused, unsupported, grown;
    int lost; /* pins that rounding has lost: |A^-1 b| is much larger than |x| */
    double worst;
} tally_t;

static sl_symbolic *analyze(const random_system_t *y, int is_pivoted) {
    sl_symbolic *S = NULL;
    SL_CHECK(is_pivoted ? sl_symbolic_create_pivoted(&S, &y->M.view, NULL, NULL)
                        : sl_symbolic_create(&S, &y->M.view, NULL, NULL));
    return S;
}

/* Rows to keep: about half of them, or all but a few; of KKT systems also the last ones, whose
 * diagonal is zero. */
static sl_int choose(const random_system_t *y, sl_int *rows, uint64_t *seed) {
    const sl_int kind = gen_below(seed, 4), first = kind == 3 ? y->n / 2 : 0;
    sl_int count = 0;
    for (sl_int i = first; i < y->n; i++) {
        if (kind == 3 || gen_below(seed, kind == 0 ? 2 : 8) > 0) {
            rows[count++] = i;
        }
    }
    return count;
}

static void restrict_and_judge(const random_system_t *y, const sl_factor *F, uint64_t *seed,
                               tally_t *t) {
    sl_int *rows = test_ints((size_t)y->n);
    const sl_int count = choose(y, rows, seed);
    sl_symbolic *S = NULL;
    sl_factor *G = NULL;
    sl_stats stats;
    const sl_status status = sl_factor_submatrix(&S, &G, F, &y->M.view, rows, count, NULL, &stats);
    if (status == SL_OK && count > 0) {
        const size_t n = (size_t)count;
        gen_matrix_t B = subset_matrix(&y->M.view, rows, count);
        double *X = test_reals(n), *r = test_reals(n), error = NAN;
        const int is_trusted =
            stats.factor.regularized == 0 && DBL_EPSILON * stats.factor.growth <= 1e-8;
        SL_CHECK(sl_factor_solve(G, X, n, y->b, n, 1, NULL));
        SL_CHECK(sl_csc_residual(&B.view, r, n, &error, X, n, y->b, n, 1));
        assert_true(error <= 1e-8 || !is_trusted);
        t->worst = is_trusted ? fmax(t->worst, error) : t->worst;
        t->solved += is_trusted;
        t->grown += !is_trusted;
        gen_matrix_free(&B);
        free(X);
        free(r);
    } else if (status != SL_OK) {
        assert_true(status == SL_ERR_PIVOT || status == SL_ERR_INACCURATE ||
                    status == SL_ERR_UNSUPPORTED);
        assert_true(status == SL_ERR_UNSUPPORTED || stats.error.row >= 0);
        assert_true(status != SL_ERR_INACCURATE || !y->is_definite);
        t->refused += status != SL_ERR_UNSUPPORTED;
        t->unsupported += status == SL_ERR_UNSUPPORTED;
    }
    sl_factor_free(G);
    sl_symbolic_free(S);
    free(rows);
}

/* The largest residual of the rows without a pin, relative to |A| |x| + |b| by norms, and of the
 * pins. */
static double pinned_error(const random_system_t *y, const double *X, const sl_int *rows,
                           const double *g, sl_int count) {
    const size_t n = (size_t)y->n;
    double *r = test_reals(n), a = 0.0, x = 0.0, b = 0.0, most = 0.0, error = NAN;
    SL_CHECK(sl_csc_residual(&y->M.view, r, n, &error, X, n, y->b, n, 1));
    for (sl_int k = 0; k < y->M.p[y->n]; k++) {
        a = fmax(a, fabs(y->M.x[k]));
    }
    for (sl_int k = 0; k < count; k++) {
        r[rows[k]] = 0.0;
    }
    for (size_t i = 0; i < n; i++) {
        x = fmax(x, fabs(X[i]));
        b = fmax(b, fabs(y->b[i]));
        most = r[i] == r[i] ? fmax(most, fabs(r[i])) : (double)INFINITY;
    }
    error = most / (a * x * (double)n + b);
    for (sl_int k = 0; k < count; k++) {
        error = fmax(error, fabs(X[rows[k]] - g[k]) / (x + fabs(g[k])));
    }
    free(r);
    return error;
}

static void pin_and_judge(const random_system_t *y, const sl_factor *F, uint64_t *seed, int is_good,
                          tally_t *t) {
    const size_t n = (size_t)y->n;
    const sl_int most = 1 + y->n / 4;
    sl_int *rows = test_ints(n), count = 0;
    double *X = test_reals(n), *g = test_reals(n);
    sl_constraints *P = NULL;
    sl_status status = sl_constraints_create(&P, F, NULL);
    sl_stats stats;
    if (status != SL_OK) {
        assert_int_equal(status, SL_ERR_UNSUPPORTED);
        t->unsupported++;
    } else {
        gen_set(rows, y->n, y->n, gen_bits(seed));
        gen_reals(g, n, gen_bits(seed));
        status = sl_constraints_add(P, rows, NULL, most, &stats);
        count = pins_count(P);
        assert_int_equal(count, status == SL_OK ? most : 0);
        t->refused += status != SL_OK;
        status = sl_constraints_solve(P, NULL, X, n, y->b, n, g, n, 1, NULL);
        assert_true(status == SL_OK || (status == SL_ERR_INACCURATE && !is_good));
        t->grown += status != SL_OK;
    }
    if (P != NULL && status == SL_OK) {
        const double error = pinned_error(y, X, rows, g, count);
        t->worst = fmax(t->worst, is_good ? error : 0.0);
        t->lost += error > 1e-8;
        t->solved++;
    }
    sl_constraints_free(P);
    free(rows);
    free(X);
    free(g);
}

static void restrictions_and_pins_are_right_or_refused(void **state) {
    (void)state;
    tally_t restricted = {0, 0, 0, 0, 0, 0.0}, pinned = {0, 0, 0, 0, 0, 0.0};
    for (int family = 0; family < 2 * SYSTEM_FAMILIES; family++) {
        /* families of moderate condition: pins go through A^-1, which loses as many digits */
        const int is_good = family % SYSTEM_FAMILIES < 2;
        for (uint64_t seed = 1; seed <= 60; seed++) {
            uint64_t random = seed * 99 + (uint64_t)family;
            random_system_t y = random_system(family % SYSTEM_FAMILIES, seed);
            sl_symbolic *S = analyze(&y, family >= SYSTEM_FAMILIES);
            sl_factor *F = NULL;
            sl_options opt = options_none();
            opt.regularization = y.regularization;
            opt.signs = y.signs;
            if (sl_factor_create(&F, S, &y.M.view, &opt, NULL) == SL_OK) {
                restrict_and_judge(&y, F, &random, &restricted);
                pin_and_judge(&y, F, &random, is_good, &pinned);
            }
            sl_factor_free(F);
            sl_symbolic_free(S);
            random_system_free(&y);
        }
    }
    print_message("restrictions: %d solved, %d flagged, %d refused, %d not supported, worst %.2g\n",
                  restricted.solved, restricted.grown, restricted.refused, restricted.unsupported,
                  restricted.worst);
    print_message("pins: %d solved, %d inaccurate, %d not supported, %d lost, worst %.2g\n",
                  pinned.solved, pinned.grown, pinned.unsupported, pinned.lost, pinned.worst);
    assert_true(pinned.solved > 500 && pinned.unsupported > 500 && pinned.worst <= 1e-8);
    assert_true(restricted.solved > 500 && restricted.refused > 25 && restricted.unsupported > 50);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(restrictions_and_pins_are_right_or_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

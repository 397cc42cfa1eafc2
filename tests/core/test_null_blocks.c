/* test_null_blocks.c: small pivots of random blocks: unrelated rows, long double, the inertia */
#include "tests/lib/small_pivots.h"

/* Small pivots beside many rows that nothing joins to them. Definite: v v' + D, v of ones.
 * Quasi-definite: [-1e-8 v'; v h I], natural order, whose pivots after the second are about 2 h and
 * computed from 2e8. */
static void rows_that_nothing_joins_do_not_decide(void **state) {
    (void)state;
    enum { M = 12, N = 30000 };
    const variant_list_t variants = variants_present();
    uint64_t seed = 7;
    for (int turn = 0; turn < 24; turn++) {
        double block[M * M] = {0.0};
        const sl_int m = 3 + gen_below(&seed, M - 3);
        const int is_definite = turn % 2;
        const double small = is_definite ? 1e-12 : 4e-5;
        sl_options opt = options_none();
        sl_stats stats;
        for (sl_int i = 0; i < m; i++) {
            for (sl_int j = 0; j < i; j++) {
                CELL(block, m, i, j) = is_definite || j == 0 ? 1.0 : 0.0;
            }
            CELL(block, m, i, i) = (is_definite ? 1.0 : 0.0) + (i > 0 ? small : 0.0);
        }
        block[0] += is_definite ? 0.0 : -1e-8;
        gen_matrix_t A = beside(block, m, N);
        options_set_variant(&opt, &variants, turn % variants.count);
        opt.ordering = SL_ORDERING_NATURAL;
        SL_CHECK(factor_and_solve(&A, &opt, &stats));
        assert_int_equal(stats.factor.positive, is_definite ? N : N - 1);
        assert_int_equal(stats.factor.negative, !is_definite);
        if (is_definite) { /* where null pivots are replaced, these are not */
            opt.pivots = SL_PIVOTS_SKIP_NULL;
            SL_CHECK(factor_and_solve(&A, &opt, &stats));
            assert_int_equal(stats.factor.null, 0);
            opt.pivots = SL_PIVOTS_NONZERO;
            opt.regularization = 1e-8;
            SL_CHECK(factor_and_solve(&A, &opt, &stats));
            assert_int_equal(stats.factor.regularized, 0);
        }
        gen_matrix_free(&A);
    }
}

/* The backward error of the dense LDL' of M, lower triangle, in long double, in the given order; 1
 * if a pivot is 0. */
static double error_in_long_double(const double *M, sl_int m) {
    long double *L = (long double *)test_array((size_t)(m * m), sizeof *L), worst = 0.0L;
    long double *b = (long double *)test_array((size_t)m, sizeof *b), row, norm = 0.0L, x = 0.0L;
    for (sl_int k = 0; k < m * m; k++) {
        L[k] = M[k];
    }
    for (sl_int k = 0; k < m; k++) {
        for (sl_int i = k + 1; i < m; i++) {
            for (sl_int j = k + 1; j <= i; j++) {
                CELL(L, m, i, j) -= CELL(L, m, i, k) * CELL(L, m, j, k) / CELL(L, m, k, k);
            }
        }
        b[k] = 1.0L;
        worst = CELL(L, m, k, k) == 0.0L ? 1.0L : worst;
    }
    for (sl_int k = 0; k < m && worst == 0.0L; k++) {
        for (sl_int j = 0; j < k; j++) {
            b[k] -= CELL(L, m, k, j) / CELL(L, m, j, j) * b[j];
        }
    }
    for (sl_int k = m; k-- > 0 && worst == 0.0L;) {
        for (sl_int i = k + 1; i < m; i++) {
            b[k] -= CELL(L, m, i, k) * b[i];
        }
        b[k] /= CELL(L, m, k, k);
    }
    for (sl_int i = 0; i < m && worst < 1.0L; i++) {
        long double r = 1.0L;
        row = 0.0L;
        for (sl_int j = 0; j < m; j++) {
            const double a = j <= i ? CELL(M, m, i, j) : CELL(M, m, j, i);
            r -= a * b[j];
            row += fabs(a);
        }
        norm = row > norm ? row : norm;
        x = fabsl(b[i]) > x ? fabsl(b[i]) : x;
        worst = fabsl(r) > worst ? fabsl(r) : worst;
    }
    free(L);
    free(b);
    return (double)(worst < 1.0L || norm * x > 1.0L ? worst / (norm * x + 1.0L) : worst);
}

/* Chains, trees with a few more springs, dense blocks and quasi-definite blocks, with a shift that
 * is small against their entries. */
static void small_block(double *M, sl_int m, int kind, uint64_t *seed) {
    const double shift = system_scale(seed, kind < 6 ? -12.5 : -10.0, -7.0);
    const sl_int half = kind < 6 ? m : m - m / 3;
    for (sl_int i = 1; i < half; i++) {
        const sl_int up = kind % 3 == 0 ? i - 1 : gen_below(seed, i);
        system_spring(M, m, i, up, system_scale(seed, -1.0, 0.0));
        if (gen_below(seed, kind % 3 == 2 ? 1 : 6) == 0) {
            system_spring(M, m, i, gen_below(seed, i), system_scale(seed, -1.0, 0.0));
        }
    }
    for (sl_int i = 0; i < m; i++) {
        CELL(M, m, i, i) += i < half ? shift : -shift;
    }
    for (sl_int i = half; i < m; i++) {
        CELL(M, m, i, gen_below(seed, half)) += 1.0;
        CELL(M, m, i, gen_below(seed, half)) += gen_real(seed);
    }
}

/* Definite systems are solved. Of the quasi-definite ones 1 % are refused: a pivot is within its
 * error. Without a tolerance a quarter of these has another inertia. */
static void what_long_double_solves_is_not_refused(void **state) {
    (void)state;
    enum { M = 60, N = 30000, TURNS = 1800 };
    const variant_list_t variants = variants_present();
    uint64_t seed = 23;
    int solved = 0, refused = 0;
    if (under_valgrind()) {
        TEST_SKIP("long double has the digits of double");
    }
    for (int turn = 0; turn < TURNS; turn++) {
        double block[M * M] = {0.0};
        const sl_int m = 2 + gen_below(&seed, M - 1);
        const int is_definite = turn % 9 < 6;
        sl_options opt = options_none();
        sl_stats stats;
        small_block(block, m, turn % 9, &seed);
        gen_matrix_t A = beside(block, m, m + (turn % 5 == 0 ? N : 0));
        options_set_variant(&opt, &variants, turn % variants.count);
        opt.ordering = SL_ORDERING_NATURAL;
        if (error_in_long_double(block, m) <= 1e-8) {
            const sl_status status = factor_and_solve(&A, &opt, &stats);
            assert_true(status == SL_OK || (status == SL_ERR_PIVOT && !is_definite &&
                                            fabs(stats.error.value) <= stats.factor.null_bound));
            solved += status == SL_OK;
            refused += status == SL_ERR_PIVOT;
        }
        gen_matrix_free(&A);
    }
    assert_true(solved + refused > TURNS - TURNS / 20 && refused < TURNS / 50);
}

/* A definite grid whose weights spread over many digits: no pivot is negative, in float neither. */
static void the_inertia_of_definite_matrices_has_no_negative_pivot(void **state) {
    (void)state;
    const isa_list_t isas = isas_with_storages();
    uint64_t seed = 11;
    int solved = 0;
    for (int turn = 0; turn < 6000; turn++) {
        enum { N = 25 };
        double M[N * N] = {0.0};
        sl_options opt = options_none();
        sl_stats stats;
        system_grid(M, N, 16.0 * fabs(gen_real(&seed)), &seed);
        for (sl_int i = 0; i < N; i++) {
            CELL(M, N, i, i) += system_scale(&seed, -15.0, 0.0);
        }
        gen_matrix_t A = beside(M, N, N);
        opt.isa = isas.isa[turn % isas.count];
        opt.storage = turn % 4 == 0 ? SL_STORAGE_DOUBLE : SL_STORAGE_FLOAT;
        const sl_status status = factor_and_solve(&A, &opt, &stats);
        if (status == SL_OK) {
            assert_int_equal(stats.factor.negative, 0);
            solved++;
        } else {
            SL_EXPECT(SL_ERR_PIVOT, status);
        }
        gen_matrix_free(&A);
    }
    assert_true(solved > 5000);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(rows_that_nothing_joins_do_not_decide),
        cmocka_unit_test(what_long_double_solves_is_not_refused),
        cmocka_unit_test(the_inertia_of_definite_matrices_has_no_negative_pivot),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

/* test_complex.c: complex Hermitian systems against complex arithmetic */
#include "tests/lib/connection.h"

static void every_form_gives_the_same_solution(void **state) {
    (void)state;
    connection_t *c = connection_make(0.01, 3);
    sl_int *p = test_ints(N + 1), *i = test_ints(2 * ENTRIES);
    double *x = test_reals(2 * ENTRIES), *im = test_reals(2 * ENTRIES);
    double b[2 * N], first[2 * N], X[2 * N];
    gen_reals(b, 2 * N, 5);
    for (int form = 0; form < 4; form++) {
        const sl_hermitian H = form == 0 ? c->H : other_form(c, form == 2, form == 3, p, i, x, im);
        system_t y = system_make(&H);
        SL_CHECK(sl_factor_solve(y.F, X, 2 * N, b, 2 * N, 1, NULL));
        assert_true(residual(c, X, b) < 1e-11);
        for (sl_int k = 0; k < 2 * N; k++) {
            first[k] = form == 0 ? X[k] : first[k];
            assert_true(fabs(X[k] - first[k]) < 1e-10 * (1 + fabs(first[k])));
        }
        system_free(&y);
    }
    free(im);
    free(x);
    free(i);
    free(p);
    free(c);
}

static void local_solves_equal_full_ones(void **state) {
    (void)state;
    static const sl_int bset[3] = {40, 7, 62}, xset[4] = {41, 0, 80, 7};
    connection_t *c = connection_make(0.3, 4);
    system_t y = system_make(&c->H);
    double b[6], full_b[2 * N] = {0}, full[2 * N], X[8];
    sl_plan *P;
    gen_reals(b, 6, 8);
    for (int k = 0; k < 3; k++) {
        full_b[2 * bset[k]] = b[2 * k];
        full_b[2 * bset[k] + 1] = b[2 * k + 1];
    }
    SL_CHECK(sl_factor_solve(y.F, full, 2 * N, full_b, 2 * N, 1, NULL));
    SL_CHECK(sl_complex_plan_create(&P, y.S, bset, 3, xset, 4, NULL, NULL));
    SL_CHECK(sl_plan_solve(P, y.F, X, 8, b, 6, 1, NULL));
    for (int k = 0; k < 4; k++) {
        SAME_VALUES(X + 2 * k, full + 2 * xset[k], 2);
    }
    sl_plan_free(P);
    /* all rows, and none */
    double all[2 * N];
    SL_CHECK(sl_complex_plan_create(&P, y.S, bset, 3, NULL, SL_ALL, NULL, NULL));
    SL_CHECK(sl_plan_solve(P, y.F, all, 2 * N, b, 6, 1, NULL));
    SAME_VALUES(all, full, 2 * N);
    sl_plan_free(P);
    SL_CHECK(sl_complex_plan_create(&P, y.S, bset, 0, xset, 4, NULL, NULL));
    SL_CHECK(sl_plan_solve(P, y.F, X, 8, b, 6, 1, NULL));
    for (int k = 0; k < 8; k++) {
        assert_true(X[k] == 0.0);
    }
    sl_plan_free(P);
    system_free(&y);
    free(c);
}

static void entries_of_the_inverse(void **state) {
    (void)state;
    static const sl_int rows[6] = {6, 7, 110, 111, 108, 109}, columns[2] = {108, 6};
    connection_t *c = connection_make(0.3, 6);
    system_t y = system_make(&c->H);
    double Z[2 * 3 * 2], b[2 * N], x[2 * N];
    SL_CHECK(sl_inverse_block(y.F, Z, 6, rows, 6, columns, 2, NULL, NULL));
    for (int k = 0; k < 2; k++) {
        memset(b, 0, sizeof b);
        b[columns[k]] = 1.0;
        SL_CHECK(sl_factor_solve(y.F, x, 2 * N, b, 2 * N, 1, NULL));
        for (int r = 0; r < 6; r++) {
            assert_true(fabs(Z[6 * k + r] - x[rows[r]]) < 1e-12);
        }
    }
    assert_true(fabs(Z[6 + 1]) < 1e-13); /* the diagonal of the inverse is real */
    system_free(&y);
    free(c);
}

/* log |det| and the sign of a dense Hermitian matrix, by elimination without pivoting. */
static double dense_logdet(const connection_t *c, double *sign) {
    double *re = test_reals(N * N), *im = test_reals(N * N), sum = 0.0;
    *sign = 1.0;
    for (sl_int j = 0; j < N; j++) {
        for (sl_int p = c->p[j]; p < c->p[j + 1]; p++) {
            re[c->i[p] * N + j] = re[j * N + c->i[p]] = c->re[p];
            im[c->i[p] * N + j] = c->im[p];
            im[j * N + c->i[p]] = -c->im[p];
        }
    }
    for (sl_int k = 0; k < N; k++) {
        const double d = re[k * N + k];
        sum += log(fabs(d));
        *sign *= d < 0 ? -1.0 : 1.0;
        for (sl_int i = k + 1; i < N; i++) {
            const double a = re[i * N + k] / d, b = im[i * N + k] / d;
            for (sl_int j = k + 1; j < N; j++) {
                re[i * N + j] -= a * re[k * N + j] - b * im[k * N + j];
                im[i * N + j] -= a * im[k * N + j] + b * re[k * N + j];
            }
        }
    }
    free(im);
    free(re);
    return sum;
}

static void determinants_and_inertia(void **state) {
    (void)state;
    static const double shifts[4] = {0.5, -2.2, -3.9, -9.3};
    int signs = 0;
    for (int k = 0; k < 4; k++) {
        connection_t *c = connection_make(shifts[k], 9);
        system_t y = system_make(&c->H);
        double sign, value, wanted_sign, wanted = dense_logdet(c, &wanted_sign);
        sl_stats stats;
        stats.factor = sl_factor_view(y.F).info;
        assert_int_equal(stats.factor.negative % 2, 0);
        assert_int_equal(stats.factor.positive + stats.factor.negative, 2 * N);
        SL_CHECK(sl_complex_logdet(y.F, &value, &sign));
        assert_true(fabs(value - wanted) < 1e-9 * (1 + fabs(wanted)));
        assert_true(sign == wanted_sign);
        signs |= sign < 0 ? 1 : 2;
        system_free(&y);
        free(c);
    }
    assert_int_equal(signs, 3); /* both signs occurred */
}

static void wrong_arguments(void **state) {
    (void)state;
    connection_t *c = connection_make(0.4, 12);
    system_t y = system_make(&c->H);
    sl_matrix *M = y.M;
    sl_plan *P = (sl_plan *)(void *)&M;
    sl_stats stats;
    sl_int set[2] = {5, N};
    double value, sign;
    SL_EXPECT(SL_ERR_ARGUMENT, sl_matrix_from_hermitian(NULL, &c->H, NULL, NULL));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_matrix_from_hermitian(&M, NULL, NULL, NULL));
    assert_null(M);
    c->x[2 * c->p[7] + 1] = 1e-30; /* a diagonal entry that is not real */
    SL_EXPECT(SL_ERR_ARGUMENT, sl_matrix_from_hermitian(&M, &c->H, NULL, &stats));
    assert_int_equal(stats.error.row, 7);
    c->x[2 * c->p[7] + 1] = NAN;
    SL_EXPECT(SL_ERR_ARGUMENT, sl_matrix_from_hermitian(&M, &c->H, NULL, &stats));
    c->x[2 * c->p[7] + 1] = 0;
    c->H.x = NULL;
    c->H.im = c->im;
    SL_EXPECT(SL_ERR_ARGUMENT, sl_matrix_from_hermitian(&M, &c->H, NULL, NULL));
    c->H.im = NULL;
    SL_CHECK(sl_matrix_from_hermitian(&M, &c->H, NULL, NULL)); /* the pattern alone */
    assert_null(sl_matrix_view(M).x);
    sl_matrix_free(M);
    c->H.x = c->x;
    c->i[3] = N;
    SL_EXPECT(SL_ERR_MALFORMED, sl_matrix_from_hermitian(&M, &c->H, NULL, &stats));
    assert_int_equal(stats.error.row, N);
    assert_null(M);

    SL_EXPECT(SL_ERR_ARGUMENT, sl_complex_plan_create(&P, y.S, set, 2, set, 1, NULL, &stats));
    assert_int_equal(stats.error.row, N);
    assert_null(P);
    SL_EXPECT(SL_ERR_ARGUMENT, sl_complex_plan_create(&P, y.S, set, 1, set, 2, NULL, &stats));
    assert_int_equal(stats.error.row, N);
    SL_EXPECT(SL_ERR_ARGUMENT, sl_complex_plan_create(&P, y.S, set, -1, set, 1, NULL, NULL));
    const sl_int below[1] = {-1};
    SL_EXPECT(SL_ERR_ARGUMENT, sl_complex_plan_create(&P, y.S, below, 1, set, 1, NULL, &stats));
    assert_int_equal(stats.error.row, -1);
    SL_EXPECT(SL_ERR_ARGUMENT, sl_complex_plan_create(&P, NULL, set, 1, set, 1, NULL, NULL));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_complex_plan_create(NULL, y.S, set, 1, set, 1, NULL, NULL));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_complex_logdet(NULL, &value, &sign));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_complex_logdet(y.F, NULL, &sign));

    system_free(&y);
    free(c);
}

/* A real system with an odd number of rows is no complex one. */
static void odd_systems_are_refused(void **state) {
    (void)state;
    static const sl_int p[4] = {0, 1, 2, 3}, i[3] = {0, 1, 2}, none[1] = {0};
    static const double x[3] = {1, 2, 3};
    const sl_csc A = {3, 3, p, i, x};
    sl_symbolic *S;
    sl_factor *F;
    sl_plan *P;
    double out[2];
    SL_CHECK(sl_symbolic_create(&S, &A, NULL, NULL));
    SL_CHECK(sl_factor_create(&F, S, &A, NULL, NULL));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_complex_plan_create(&P, S, none, 1, none, 1, NULL, NULL));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_complex_logdet(F, out, out + 1));
    sl_factor_free(F);
    sl_symbolic_free(S);
}

/* Every allocation of the calls fails in turn. */
static void failing_allocations(void **state) {
    (void)state;
    static const sl_int set[3] = {3, 55, 54};
    connection_t *c = connection_make(0.3, 13);
    system_t y = system_make(&c->H);
    for (int call = 0; call < 2; call++) {
        sl_status status = SL_ERR_MEMORY;
        for (int64_t k = 0; status != SL_OK; k++) {
            counter_t counter = counter_make();
            sl_options opt = options_counted(&counter);
            sl_matrix *M = NULL;
            sl_plan *P = NULL;
            counter.fail_at = k;
            status = call == 0 ? sl_matrix_from_hermitian(&M, &c->H, &opt, NULL)
                               : sl_complex_plan_create(&P, y.S, set, 3, set, 3, &opt, NULL);
            assert_true(status == SL_OK || status == SL_ERR_MEMORY);
            assert_int_equal(status == SL_OK, counter.calls <= (size_t)counter.fail_at);
            assert_true(k > 0 || status == SL_ERR_MEMORY);
            sl_matrix_free(M);
            sl_plan_free(P);
            COUNTER_CLEAN(&counter);
        }
    }
    system_free(&y);
    free(c);
}

/* The two columns of a complex row follow each other in one supernode, whichever triangles H
 * stores, also if it is diagonal. */
static void columns_stay_in_pairs(void **state) {
    (void)state;
    connection_t *c = connection_make(0.5, 8);
    sl_options opt;
    sl_options_init(&opt, sizeof opt);
    opt.block_size = 2;
    for (int kind = 0; kind < 4; kind++) { /* lower triangle, both, upper, diagonal */
        sl_int p[N + 1], i[2 * ENTRIES], at = 0, count = 0;
        double x[4 * ENTRIES];
        for (sl_int j = 0; j < N; j++) {
            p[j] = at;
            for (sl_int k = 0; k < N; k++) {
                for (sl_int q = c->p[k]; q < c->p[k + 1]; q++) {
                    const int lower = k == j, upper = c->i[q] == j && c->i[q] != k;
                    const sl_int row = lower ? c->i[q] : k;
                    if ((kind == 3 && row != j) || (lower && row != j && kind >= 2) ||
                        (upper && kind == 0) || (!lower && !upper)) {
                        continue;
                    }
                    i[at] = row;
                    x[2 * at] = c->re[q];
                    x[2 * at++ + 1] = lower ? c->im[q] : -c->im[q];
                }
            }
        }
        p[N] = at;
        const sl_hermitian H = {N, p, i, x, NULL};
        sl_matrix *M = NULL;
        sl_symbolic *S = NULL;
        SL_CHECK(sl_matrix_from_hermitian(&M, &H, NULL, NULL));
        const sl_csc A = sl_matrix_view(M);
        SL_CHECK(sl_symbolic_create(&S, &A, &opt, NULL));
        const sl_symbolic_arrays v = sl_symbolic_view(S);
        for (sl_int s = 0; s <= v.n_supers; s++) {
            assert_int_equal(v.super_first[s] % 2, 0);
        }
        for (sl_int k = 0; k < 2 * N; k += 2) {
            assert_int_equal(v.perm[k] % 2, 0);
            assert_int_equal(v.perm[k + 1], v.perm[k] + 1);
            count += A.p[k + 2] - A.p[k];
        }
        assert_int_equal(count, A.p[2 * N]);
        sl_symbolic_free(S);
        sl_matrix_free(M);
    }
    free(c);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_form_gives_the_same_solution),
        cmocka_unit_test(local_solves_equal_full_ones),
        cmocka_unit_test(entries_of_the_inverse),
        cmocka_unit_test(determinants_and_inertia),
        cmocka_unit_test(columns_stay_in_pairs),
        cmocka_unit_test(wrong_arguments),
        cmocka_unit_test(odd_systems_are_refused),
        cmocka_unit_test(failing_allocations),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

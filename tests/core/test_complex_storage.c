/* test_complex_storage.c: L as complex: every other column of L in double, in every call */
#include "tests/lib/complex_pair.h"
#include "tests/lib/local_solve.h"
#include "tests/lib/parallel_for.h"

/* L, dense. */
static double *lower_of(const sl_factor *F, sl_int n) {
    sl_matrix *L = NULL;
    double *dense = test_reals((size_t)n * (size_t)n);
    SL_CHECK(sl_factor_lower(&L, F, NULL));
    const sl_csc v = sl_matrix_view(L);
    for (sl_int j = 0; j < n; j++) {
        for (sl_int p = v.p[j]; p < v.p[j + 1]; p++) {
            dense[(size_t)v.i[p] + (size_t)j * (size_t)n] = v.x[p];
        }
    }
    sl_matrix_free(L);
    return dense;
}

/* L and D are a factorization. They consist of blocks [a -b; b a] and [d 0; 0 d], to the last bit
 * (unless the instruction set keeps L in double), and any number of threads gives the same. */
static void check_half(const pair_t *y, sl_isa isa) {
    const int keeps = isa_keeps_storage(isa);
    sl_options opt = options_complex(isa);
    sl_factor *G = NULL;
    sl_stats stats;
    int calls = 0;
    opt.threads.count = 3;
    opt.threads.run = run_backwards;
    opt.threads.context = &calls;
    SL_CHECK(sl_factor_create(&G, y->S, &y->A, &opt, &stats));
    assert_int_equal(stats.factor.storage, keeps ? SL_STORAGE_COMPLEX : SL_STORAGE_DOUBLE);
    SL_CHECK(sl_factor_refactor(G, &y->A, NULL));
    const size_t n = (size_t)y->n;
    const double *D = sl_factor_view(y->F[1]).D;
    double *L = lower_of(y->F[1], y->n), *other = lower_of(G, y->n);
    SAME_VALUES(D, sl_factor_view(G).D, n);
    SAME_VALUES(L, other, n * n);
    assert_int_equal(sl_factor_view(G).L == NULL, keeps);
    assert_null(sl_factor_view(G).L_float);
    for (size_t j = 0; j < n && keeps; j++) {
        const double *first = L + (j - j % 2) * n;
        assert_true(D[j] == D[j - j % 2]);
        for (size_t i = j; i < n; i++) {
            assert_true(i / 2 == j / 2 ? L[i + j * n] == (i == j ? 1.0 : 0.0)
                        : j % 2 == 0   ? 1
                        : i % 2 == 0   ? L[i + j * n] == -first[i + 1]
                                       : L[i + j * n] == first[i - 1]);
        }
    }
    double *A = ref_dense(&y->A), *C = ref_permute(y->n, A, sl_symbolic_view(y->S).perm);
    NOTHING_WRONG(check_product(y->n, C, L, D));
    free(A);
    free(C);
    free(L);
    free(other);
    sl_factor_free(G);
}

static void l_is_a_factor_of_blocks(void **state) {
    (void)state;
    for_each(check_half);
    /* a front of several chunks and pieces */
    pair_t y = pair_make(GEN_DENSE, 270, 0, SL_ISA_AUTO);
    check_half(&y, SL_ISA_AUTO);
    pair_free(&y);
}

/* L does not depend on the scale, also where pivots have no reciprocal. */
static void pivots_without_reciprocal_are_divided_by(void **state) {
    (void)state;
    const isa_list_t isas = isas_present();
    for (int k = 0; k < 4 * isas.count; k++) {
        pair_t y = pair_make(k % 2 ? GEN_DENSE : GEN_GRID2, k % 2 ? 30 : 100, 0, isas.isa[k / 4]);
        const size_t n = (size_t)y.n, entries = (size_t)y.A.p[y.n];
        const int power = k / 2 % 2 ? 1000 : -1000;
        double *x = test_reals(entries), *D = test_reals(n);
        sl_csc A = y.A;
        A.x = x;
        for (size_t e = 0; e < entries; e++) {
            x[e] = ldexp(y.A.x[e], power);
        }
        double *before = lower_of(y.F[1], y.n);
        memcpy(D, sl_factor_view(y.F[1]).D, n * sizeof *D);
        SL_CHECK(sl_factor_refactor(y.F[1], &A, NULL));
        double *after = lower_of(y.F[1], y.n);
        for (size_t e = 0; e < n * n; e++) {
            assert_true(fabs(after[e] - before[e]) <= 1e-13);
        }
        for (size_t j = 0; j < n; j++) {
            const double d = ldexp(sl_factor_view(y.F[1]).D[j], -power);
            assert_true(fabs(d - D[j]) <= 1e-12 * fabs(D[j]));
        }
        free(before);
        free(after);
        free(D);
        free(x);
        pair_free(&y);
    }
}

/* Any number of right-hand sides solve to rounding; local solves have the bits of full ones, also
 * of sets that divide pairs. */
static void check_solves(const pair_t *y, sl_isa isa) {
    static const sl_int counts[] = {1, 2, 3, 4, 5, 8, 11, 61, 77};
    const size_t n = (size_t)y->n;
    double *B = test_reals(77 * n), *X = test_reals(77 * n);
    sl_work *W = NULL;
    (void)isa;
    SL_CHECK(sl_work_create(&W, NULL));
    gen_reals(B, 77 * n, 7);
    for (size_t k = 0; k < sizeof counts / sizeof counts[0]; k++) {
        SL_CHECK(sl_factor_solve(y->F[1], X, n ? n : 1, B, n ? n : 1, counts[k], W));
        BACKWARD_PASSES(&y->A, X, n ? n : 1, B, n ? n : 1, counts[k]);
        for (sl_int some = 0; some < 4; some++) {
            const sl_int nb = some == 3 ? -1 : some < y->n ? some : y->n;
            const sl_int nx = some == 0 ? -1 : 3 * some < y->n ? 3 * some : y->n;
            local_solve_t q =
                local_solve_random(y->F[1], y->n, nb, nx, counts[k], 31 + (uint64_t)some);
            local_solve_check(y->S, y->F[1], &q, W);
            local_solve_free(&q);
        }
    }
    sl_work_free(W);
    free(B);
    free(X);
}

/* A number of B that is not finite is found at each place, in the last rows of trees, too. */
static void check_not_finite(const pair_t *y, sl_isa isa) {
    const size_t n = (size_t)y->n;
    double *b = test_reals(3 * n), *x = test_reals(3 * n);
    gen_reals(b, 3 * n, 7);
    (void)isa;
    for (sl_int nrhs = 1; nrhs <= 3; nrhs++) {
        SL_CHECK(sl_factor_solve(y->F[1], x, n ? n : 1, b, n ? n : 1, nrhs, NULL));
        for (size_t k = 0; k < n * (size_t)nrhs; k++) {
            const double keep = b[k];
            b[k] = k % 2 == 0 ? (double)NAN : (double)INFINITY;
            SL_EXPECT(SL_ERR_NOT_FINITE,
                      sl_factor_solve(y->F[1], x, n ? n : 1, b, n ? n : 1, nrhs, NULL));
            b[k] = keep;
        }
    }
    free(b);
    free(x);
}

static void numbers_that_are_not_finite_are_found(void **state) {
    (void)state;
    for_each(check_not_finite);
}

static void solves_are_exact_and_local(void **state) {
    (void)state;
    const isa_list_t isas = isas_present();
    for_each(check_solves);
    for (int k = 0; k < isas.count; k++) { /* small supernodes between wide ones */
        pair_t y = pair_make(GEN_GRID2, 900, 0, isas.isa[k]);
        check_solves(&y, isas.isa[k]);
        pair_free(&y);
    }
}

/* What reads L in other ways agrees with L in double. */
static void check_other_calls(const pair_t *y, sl_isa isa) {
    const size_t n = (size_t)y->n;
    double *B = test_reals(2 * n), *X[2], *diagonal[2], logdet[2], sign[2], block[2][8], rcond[2];
    const sl_int last = y->n - 2, rows[4] = {0, 1, last, last + 1}, columns[2] = {0, last};
    sl_stats stats[2];
    memset(stats, 0, sizeof stats);
    (void)isa;
    gen_reals(B, 2 * n, 9);
    for (int k = 0; k < 2 && n > 0; k++) {
        sl_selected *Z = NULL;
        X[k] = test_reals(6 * n);
        diagonal[k] = test_reals(n);
        SL_CHECK(sl_factor_solve_part(y->F[k], NULL, SL_PART_L, X[k], n, B, n, 2, NULL));
        SL_CHECK(sl_factor_solve_part(y->F[k], NULL, SL_PART_LT, X[k] + 2 * n, n, B, n, 2, NULL));
        SL_CHECK(sl_factor_multiply_part(y->F[k], SL_PART_L | SL_PART_LT, X[k] + 4 * n, n, B, n, 2,
                                         NULL));
        SL_CHECK(sl_complex_logdet(y->F[k], &logdet[k], &sign[k]));
        SL_CHECK(sl_inverse_block(y->F[k], block[k], 4, rows, 4, columns, 2, NULL, NULL));
        stats[k].factor = sl_factor_view(y->F[k]).info;
        SL_CHECK(sl_selected_create(&Z, y->F[k], NULL, SL_ALL, NULL, NULL));
        SL_CHECK(sl_selected_entries(Z, diagonal[k], NULL, NULL, y->n, NULL));
        SL_CHECK(sl_factor_rcond(y->F[k], &y->A, &rcond[k], NULL));
        sl_selected_free(Z);
    }
    if (n > 0) {
        double most = 0.0, largest = 0.0, entry = 0.0;
        for (size_t i = 0; i < 6 * n; i++) {
            largest = fmax(largest, fabs(X[0][i]));
            most = fmax(most, fabs(X[0][i] - X[1][i]));
        }
        assert_true(most <= 1e-12 * largest);
        for (size_t i = 0; i < n; i++) {
            entry = fmax(entry, fabs(diagonal[0][i]));
        }
        for (size_t i = 0; i < n; i++) {
            assert_true(fabs(diagonal[0][i] - diagonal[1][i]) <= 1e-11 * entry);
        }
        for (int i = 0; i < 8; i++) {
            assert_true(fabs(block[0][i] - block[1][i]) <= 1e-11 * entry);
        }
        assert_true(fabs(logdet[0] - logdet[1]) <= 1e-12 * (double)n && sign[0] == sign[1]);
        assert_int_equal(stats[0].factor.positive, stats[1].factor.positive);
        assert_int_equal(stats[0].factor.negative, stats[1].factor.negative);
        assert_true(stats[1].factor.positive + stats[1].factor.negative == y->n);
        assert_true(fabs(rcond[0] - rcond[1]) <= 0.1 * rcond[0]); /* ties of the estimator */
        for (int k = 0; k < 2; k++) {
            free(X[k]);
            free(diagonal[k]);
        }
    }
    free(B);
}

static void other_calls_agree(void **state) {
    (void)state;
    for_each(check_other_calls);
}

/* Half of the bytes of L. */
static void memory_is_halved(void **state) {
    (void)state;
    pair_t y = pair_make(GEN_DENSE, 200, 0, SL_ISA_AUTO);
    sl_stats full, half;
    full.symbolic = sl_symbolic_view(y.S).info;
    half = full;
    full.factor = sl_factor_view(y.F[0]).info;
    half.factor = sl_factor_view(y.F[1]).info;
    /* dense: the one panel is needed in double as well while it is factored */
    assert_true((double)half.factor.bytes <
                (double)full.factor.bytes + 4.1 * (double)full.symbolic.nnz_panels + 4096);
    pair_free(&y);
    y = pair_make(GEN_GRID2, 3000, 0, SL_ISA_AUTO);
    full.symbolic = sl_symbolic_view(y.S).info;
    half = full;
    full.factor = sl_factor_view(y.F[0]).info;
    half.factor = sl_factor_view(y.F[1]).info;
    assert_true((double)half.factor.bytes <
                (double)full.factor.bytes - 3.0 * (double)full.symbolic.nnz_panels);
    pair_free(&y);
}

enum { FORWARD, REVERSED, HALVES, WAYS_TO_RESTRICT };

/* Restricted to two of three blocks, in two orders, and to halves of neighbors: where a block is
 * split, L is in double. */
static void check_restricted(const pair_t *y, sl_isa isa) {
    for (int way = 0; way < WAYS_TO_RESTRICT; way++) {
        sl_int *rows = test_ints((size_t)y->n), count = 0;
        for (sl_int k = 0; k < y->n; k++) {
            rows[count] = way == REVERSED ? y->n - 1 - k : k;
            count += way == HALVES ? k > 0 && k + 1 < y->n : rows[count] / 2 % 3 > 0;
        }
        const size_t n = (size_t)count, ld = n > 0 ? n : 1;
        double *b = test_reals(n), *x[2] = {test_reals(n), test_reals(n)}, most = 0.0;
        gen_reals(b, n, 3);
        for (int k = 0; k < 2; k++) {
            const int is_half = k == 1 && isa_keeps_storage(isa);
            sl_symbolic *S = NULL;
            sl_factor *G = NULL;
            sl_stats stats;
            SL_CHECK(sl_factor_submatrix(&S, &G, y->F[k], &y->A, rows, count, NULL, &stats));
            assert_true(!is_half || stats.submatrix.kept == 0);
            assert_int_equal(stats.factor.storage, is_half && (way == FORWARD || n == 0)
                                                ? SL_STORAGE_COMPLEX
                                                : SL_STORAGE_DOUBLE);
            SL_CHECK(sl_factor_solve(G, x[k], ld, b, ld, 1, NULL));
            sl_factor_free(G);
            sl_symbolic_free(S);
        }
        for (size_t k = 0; k < n; k++) {
            most = fmax(most, fabs(x[0][k]));
        }
        for (size_t k = 0; k < n; k++) {
            assert_true(fabs(x[0][k] - x[1][k]) <= 1e-10 * most);
        }
        free(rows);
        free(b);
        free(x[0]);
        free(x[1]);
    }
}

static void restrictions_are_complex(void **state) {
    (void)state;
    for_each(check_restricted);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(l_is_a_factor_of_blocks),
        cmocka_unit_test(pivots_without_reciprocal_are_divided_by),
        cmocka_unit_test(solves_are_exact_and_local),
        cmocka_unit_test(numbers_that_are_not_finite_are_found),
        cmocka_unit_test(other_calls_agree),
        cmocka_unit_test(memory_is_halved),
        cmocka_unit_test(restrictions_are_complex),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

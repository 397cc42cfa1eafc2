/* test_checks.c: the checks of tests/lib detect results that were damaged on purpose */
#include "tests/lib/factored.h"

/* Damages one value, checks that this is detected, restores it. */
#define DETECTED(variable, damaged, check) \
    do { \
        double keep_ = (variable); \
        (variable) = (damaged); \
        if (!(check)) { \
            print_error("not detected: %s = %s\n", #variable, #damaged); \
            fail(); \
        } \
        (variable) = keep_; \
    } while (0)

/* The arrays of the library, writable; only this test may write them. */
static double *writable(const double *x) {
    return (double *)(uintptr_t)x;
}

static sl_int *writable_ints(const sl_int *x) {
    return (sl_int *)(uintptr_t)x;
}

static void a_damaged_factor_is_detected(void **state) {
    (void)state;
    isa_list_t isas = isas_present();
    for (int k = 0; k < isas.count; k++) {
        sl_options opt = options_none();
        opt.isa = isas.isa[k];
        factored_t y = factored_make(GEN_GRID2, 49, 1, 0, &opt);
        sl_factor_arrays f = sl_factor_view(y.F);
        sl_symbolic_arrays v = sl_symbolic_view(y.S);
        double *L = writable(f.L), *D = writable(f.D);
        NOTHING_WRONG(check_factor(y.F, &y.M.view));
        for (sl_int j = 0; j < 49; j++) {
            DETECTED(D[j], D[j] * (1 + 1e-11), check_factor(y.F, &y.M.view));
            DETECTED(D[j], NAN, check_factor(y.F, &y.M.view));
        }
        /* values, padding and upper entries: all of them */
        for (sl_off q = 0; q < panel_doubles(y.F); q++) {
            DETECTED(L[q], L[q] * (1 + 1e-10) + 1e-10, check_factor(y.F, &y.M.view));
        }
        /* a permutation with a repeated row */
        sl_int *perm = writable_ints(v.perm), first = perm[3];
        perm[3] = perm[20];
        assert_non_null(check_permutation(49, v.perm, v.iperm));
        perm[20] = first;
        assert_non_null(check_permutation(49, v.perm, v.iperm));
        assert_non_null(check_factor(y.F, &y.M.view));
        perm[20] = perm[3];
        perm[3] = first;
        NOTHING_WRONG(check_factor(y.F, &y.M.view));
        factored_free(&y);
    }
}

static void a_damaged_analysis_is_detected(void **state) {
    (void)state;
    gen_matrix_t M = gen_matrix(GEN_GRID2, 81, 1, 1);
    sl_options opt = options_none();
    sl_symbolic *S = NULL;
    opt.relaxation = SL_RELAXATION_NONE;
    SL_CHECK(sl_symbolic_create(&S, &M.view, &opt, NULL));
    sl_symbolic_arrays v = sl_symbolic_view(S);
    sl_int *parent = writable_ints(v.parent), *counts = writable_ints(v.counts),
           *rows = writable_ints(v.rows);
    sl_int *up = writable_ints(v.super_parent);
    NOTHING_WRONG(check_structure(&v, &M.view, 1));
    NOTHING_WRONG(check_supernodes(&v));
    NOTHING_WRONG(check_postorder(v.n_supers, v.super_parent));
    for (sl_int k = 0; k < v.n; k++) {
        parent[k]++;
        assert_non_null(check_structure(&v, &M.view, 1));
        parent[k]--;
        counts[k]--;
        assert_non_null(check_structure(&v, &M.view, 1));
        counts[k]++;
    }
    for (sl_off q = 0; q < v.rows_begin[v.n_supers]; q++) {
        rows[q]++;
        assert_true(check_supernodes(&v) || check_structure(&v, &M.view, 1));
        rows[q]--;
    }
    for (sl_int s = 0; s < v.n_supers; s++) {
        up[s]++;
        assert_non_null(check_supernodes(&v));
        up[s]--;
    }
    sl_symbolic_free(S);
    /* chain: 0 is a child of 2 and 1 of 3, not contiguous; good: a postorder; back: a parent before
     * its child */
    const sl_int chain[5] = {2, 3, 4, 4, -1}, good[5] = {4, 2, 4, 4, -1}, back[3] = {1, 0, -1};
    assert_non_null(check_postorder(5, chain));
    assert_null(check_postorder(5, good));
    assert_non_null(check_postorder(3, back));
    gen_matrix_free(&M);
}

static void a_damaged_solution_is_detected(void **state) {
    (void)state;
    factored_t y = factored_make(GEN_GRID2, 100, 1, 0, NULL);
    double X[100], Y[100], B[100];
    gen_reals(B, 100, 1);
    SL_CHECK(sl_factor_solve(y.F, X, 100, B, 100, 1, NULL));
    memcpy(Y, X, sizeof X);
    assert_true(worst_backward(&y.M.view, X, 100, B, 100, 1) <= pass_figure(100));
    assert_int_equal(first_difference(X, Y, 100), -1);
    for (int k = 0; k < 100; k++) {
        /* the bound is 10 n eps = 2.2e-13 here */
        DETECTED(X[k], X[k] + 1e-10,
                 !(worst_backward(&y.M.view, X, 100, B, 100, 1) <= pass_figure(100)));
        DETECTED(X[k], NAN, !(worst_backward(&y.M.view, X, 100, B, 100, 1) <= pass_figure(100)));
        DETECTED(X[k], X[k] * (1 + DBL_EPSILON), first_difference(X, Y, 100) == k);
        DETECTED(X[k], NAN, first_difference(X, Y, 100) == k);
    }
    Y[5] = X[5] = 0.0;
    Y[5] = -Y[5];
    assert_int_equal(first_difference(X, Y, 100), -1); /* the sign of a zero does not matter */
    /* two rows exchanged */
    double keep = X[10];
    X[10] = X[70];
    X[70] = keep;
    assert_true(worst_backward(&y.M.view, X, 100, B, 100, 1) > pass_figure(100));
    factored_free(&y);
}

/* Every value of L affects the solution: each entry that the statistics of a local solve count is
 * read. */
static void every_value_of_l_affects_the_solution(void **state) {
    (void)state;
    sl_options opt = options_none();
    opt.relaxation = SL_RELAXATION_NONE;
    factored_t y = factored_make(GEN_DENSE, 30, 1, 0, &opt);
    sl_symbolic_arrays v = sl_symbolic_view(y.S);
    double *L = writable(sl_factor_view(y.F).L), B[30], X[30], Y[30];
    gen_reals(B, 30, 1);
    SL_CHECK(sl_factor_solve(y.F, X, 30, B, 30, 1, NULL));
    assert_int_equal(v.n_supers, 1);
    for (sl_int c = 0; c < 30; c++) {
        for (sl_int r = c + 1; r < 30; r++) {
            sl_off q = ref_position(30, r, c);
            double keep = L[q];
            L[q] += 1e-3;
            SL_CHECK(sl_factor_solve(y.F, Y, 30, B, 30, 1, NULL));
            assert_true(first_difference(X, Y, 30) >= 0);
            L[q] = keep;
        }
    }
    factored_free(&y);
}

static void memory_errors_are_detected(void **state) {
    (void)state;
    counter_t counter = counter_make();
    /* a block that is not released, a write past its end, a failed allocation */
    unsigned char *a = (unsigned char *)counter_allocate(&counter, 10);
    assert_int_equal(counter.live_blocks, 1);
    assert_int_equal(counter.live_bytes, 10);
    a[10] ^= 1;
    counter_release(&counter, a);
    assert_int_equal(counter.damaged, 1);
    assert_int_equal(counter.live_blocks, 0);
    counter.fail_at = (int64_t)counter.calls + 1;
    a = (unsigned char *)counter_allocate(&counter, 1);
    assert_non_null(a);
    assert_null(counter_allocate(&counter, 1));
    unsigned char *b = (unsigned char *)counter_allocate(&counter, 1);
    assert_non_null(b);
    counter_release(&counter, a);
    counter_release(&counter, b);
    assert_int_equal(counter.live_blocks, 0);
}

/* The dense references agree with each other; they share no code. */
static void the_dense_references_agree(void **state) {
    (void)state;
    for (int kind = GEN_ONE; kind < GEN_SCALED; kind++) {
        gen_matrix_t A = gen_matrix((gen_kind_t)kind, 25, 0, 3);
        sl_int n = A.view.n_cols;
        size_t square = (size_t)n * (size_t)n;
        double *M = ref_dense(&A.view), *L = test_reals(square), *D = test_reals((size_t)n),
               *Z = ref_inverse(n, M);
        char *fill = ref_pattern(&A.view);
        ref_ldl(n, M, L, D);
        assert_null(check_product(n, M, L, D));
        ref_fill(n, fill);
        for (sl_int j = 0; j < n; j++) {
            for (sl_int i = 0; i < n; i++) {
                double sum = 0;
                for (sl_int k = 0; k < n; k++) {
                    sum += AT(M, i, k) * AT(Z, k, j);
                }
                assert_true(fabs(sum - (i == j)) < 1e-11);
                assert_true(AT(L, i, j) == 0 || i < j ||
                            AT(fill, i, j)); /* no entry outside the fill */
            }
        }
        AT(L, n - 1, 0) += 1e-9;
        assert_true(n == 1 || check_product(n, M, L, D));
        free(M);
        free(L);
        free(D);
        free(Z);
        free(fill);
        gen_matrix_free(&A);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_damaged_factor_is_detected),
        cmocka_unit_test(a_damaged_analysis_is_detected),
        cmocka_unit_test(a_damaged_solution_is_detected),
        cmocka_unit_test(every_value_of_l_affects_the_solution),
        cmocka_unit_test(memory_errors_are_detected),
        cmocka_unit_test(the_dense_references_agree),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

/* test_complex_storage_use.c: L as complex: what is refused, and allocations that fail */
#include "tests/lib/complex_pair.h"
#include "tests/lib/saved_pair.h"

static sl_status create(const sl_symbolic *S, const sl_csc *A, sl_options opt) {
    sl_factor *F = NULL;
    opt.storage = SL_STORAGE_COMPLEX;
    const sl_status status = sl_factor_create(&F, S, A, &opt, NULL);
    assert_int_equal(status == SL_OK, F != NULL);
    sl_factor_free(F);
    return status;
}

/* The same with 2x2 pivots. */
static sl_status create_pivoted(const sl_csc *A) {
    sl_symbolic *S = NULL;
    SL_CHECK(sl_symbolic_create_pivoted(&S, A, NULL, NULL));
    const sl_status status = create(S, A, options_none());
    sl_symbolic_free(S);
    return status;
}

/* A number that is not finite is refused as in double, with its row and column. */
static void what_is_not_finite_is_named(void **state) {
    (void)state;
    pair_t y = pair_make(GEN_GRID2, 16, 0, SL_ISA_AUTO);
    const size_t entries = (size_t)y.A.p[y.n];
    double *x = test_reals(entries);
    sl_csc A = y.A;
    A.x = x;
    for (size_t k = 0; k < entries; k++) {
        sl_stats stats[2];
        memcpy(x, y.A.x, entries * sizeof *x);
        x[k] = k % 2 ? (double)NAN : (double)INFINITY;
        for (int m = 0; m < 2; m++) {
            SL_EXPECT(SL_ERR_NOT_FINITE, sl_factor_refactor(y.F[m], &A, &stats[m]));
        }
        assert_int_equal(stats[0].error.row, stats[1].error.row);
        assert_int_equal(stats[0].error.column, stats[1].error.column);
        assert_string_equal(stats[0].error.what, stats[1].error.what);
    }
    free(x);
    pair_free(&y);
}

/* Real matrices, null pivots that are replaced, sums, changes and files are refused. */
static void what_is_not_complex_is_refused(void **state) {
    (void)state;
    pair_t y = pair_make(GEN_GRID2, 49, 0, SL_ISA_AUTO);
    const size_t entries = (size_t)y.A.p[y.n];
    double *x = test_reals(entries);
    sl_csc A = y.A;
    sl_options opt = options_none();
    sl_stats stats;
    size_t bytes;
    A.x = x;
    for (size_t k = 0; k < entries; k++) { /* each entry once */
        memcpy(x, y.A.x, entries * sizeof *x);
        x[k] += 0.5;
        assert_int_equal(create(y.S, &A, opt), SL_ERR_UNSUPPORTED);
    }
    SL_EXPECT(SL_ERR_UNSUPPORTED, sl_factor_refactor(y.F[1], &A, &stats));
    assert_non_null(strstr(stats.error.what, "not one matrix of blocks"));
    assert_int_equal(sl_factor_refactor(y.F[1], &A, NULL), SL_ERR_UNSUPPORTED);
    assert_int_equal(sl_factor_solve(y.F[1], x, (size_t)y.n, x, (size_t)y.n, 1, NULL),
                     SL_ERR_STALE);
    SL_CHECK(sl_factor_refactor(y.F[1], &y.A, NULL));
    opt.pivots = SL_PIVOTS_SKIP_NULL;
    assert_int_equal(create(y.S, &y.A, opt), SL_ERR_UNSUPPORTED);
    opt = options_none();
    opt.regularization = 1e-3;
    assert_int_equal(create(y.S, &y.A, opt), SL_ERR_UNSUPPORTED);
    assert_int_equal(pair_save_memory(NULL, &bytes, y.S, y.F[1]), SL_ERR_UNSUPPORTED);
    const sl_int p[2] = {0, 1}, row = 3;
    const double one = 1.0;
    const sl_csc V = {y.n, 1, p, &row, &one};
    assert_int_equal(sl_factor_rank_update(y.F[1], &V, &one, NULL, NULL), SL_ERR_UNSUPPORTED);
    opt = options_complex(SL_ISA_AUTO);
    double *terms = test_reals((size_t)scatter_length(y.S));
    const double *const term[1] = {terms};
    sl_factor *G = NULL;
    SL_CHECK(sl_symbolic_scatter(y.S, terms, &y.A, NULL));
    assert_int_equal(sl_factor_create_sums(&G, 1, y.S, &one, term, 1, &opt, NULL, NULL),
                     SL_ERR_UNSUPPORTED);
    const double none = (double)NAN; /* a coefficient that is not finite is refused as such */
    assert_int_equal(sl_factor_create_sums(&G, 1, y.S, &none, term, 1, &opt, NULL, NULL),
                     SL_ERR_NOT_FINITE);
    terms[7] = (double)NAN; /* and so is a term */
    assert_int_equal(sl_factor_create_sums(&G, 1, y.S, &one, term, 1, &opt, NULL, NULL),
                     SL_ERR_NOT_FINITE);
    assert_int_equal(create_pivoted(&y.A), SL_ERR_UNSUPPORTED);
    free(terms);
    free(x);
    pair_free(&y);
    /* rows that are not in pairs: an odd number of them, and pairs that the order divides */
    for (sl_int n = 8; n <= 9; n++) {
        factored_t f = factored_make(GEN_PATH, n, 1, 0, NULL);
        assert_int_equal(create(f.S, &f.M.view, options_none()), SL_ERR_UNSUPPORTED);
        factored_free(&f);
    }
}

/* Plain C keeps L in double where SIMD is compiled in. It takes the same matrices. */
static void plain_c_refuses_what_is_not_complex(void **state) {
    (void)state;
    pair_t y = pair_make(GEN_GRID2, 49, 0, SL_ISA_SCALAR);
    const sl_options opt = options_complex(SL_ISA_SCALAR);
    const size_t entries = (size_t)y.A.p[y.n];
    double *x = test_reals(entries);
    sl_int *same = test_ints((size_t)y.n);
    const sl_int changed = 4;
    sl_factor *G = NULL;
    sl_csc A = y.A;
    A.x = x;
    memcpy(x, y.A.x, entries * sizeof *x);
    x[A.p[changed]] += 0.5;
    for (sl_int k = 0; k < y.n; k++) {
        same[k] = k;
    }
    assert_int_equal(create(y.S, &A, opt), SL_ERR_UNSUPPORTED);
    SL_CHECK(sl_factor_edit(&G, y.F[1], y.S, &y.A, same, &opt, NULL));
    sl_factor_free(G);
    assert_int_equal(sl_factor_edit(&G, y.F[1], y.S, &A, same, &opt, NULL), SL_ERR_UNSUPPORTED);
    assert_null(G);
    SL_CHECK(sl_factor_change_entries(y.F[1], &y.A, NULL, &changed, NULL, 1, NULL, NULL));
    assert_int_equal(sl_factor_change_entries(y.F[1], &A, NULL, &changed, NULL, 1, NULL, NULL),
                     SL_ERR_UNSUPPORTED);
    assert_int_equal(sl_factor_refactor(y.F[1], &A, NULL), SL_ERR_UNSUPPORTED);
    SL_CHECK(sl_factor_refactor(y.F[1], &y.A, NULL));
    free(same);
    free(x);
    pair_free(&y);
}

/* Neither is a matrix in which an entry of a block is not stored, unless it is the 0 beside a
 * diagonal entry, nor is a random one of real numbers. */
static void blocks_must_be_complete(void **state) {
    (void)state;
    pair_t y = pair_make(GEN_GRID2, 16, 0, SL_ISA_AUTO);
    const sl_int entries = y.A.p[y.n];
    sl_int *p = test_ints((size_t)y.n + 1), *i = test_ints((size_t)entries), refused = 0;
    double *x = test_reals((size_t)entries);
    sl_options opt = options_none();
    opt.block_size = 2;
    for (sl_int k = 0; k < entries; k++) {
        sl_int to = 0;
        for (sl_int j = 0; j < y.n; j++) {
            p[j] = to;
            for (sl_int q = y.A.p[j]; q < y.A.p[j + 1]; q++) {
                i[to] = y.A.i[q];
                x[to] = y.A.x[q];
                to += q != k;
            }
        }
        p[y.n] = to;
        const sl_csc A = {y.n, y.n, p, i, x};
        sl_symbolic *S = NULL;
        if (sl_symbolic_create(&S, &A, &opt, NULL) == SL_OK) {
            const sl_status status = create(S, &A, options_none());
            assert_true(status == SL_ERR_UNSUPPORTED || (status == SL_OK && y.A.x[k] == 0.0));
            refused += status != SL_OK;
        }
        sl_symbolic_free(S);
    }
    assert_true(refused > entries / 2);
    free(p);
    free(i);
    free(x);
    pair_free(&y);
    for (sl_int k = 0; k < 400; k++) {
        gen_list_t t = gen_make(GEN_RANDOM, 4 + k % 10, 1, (uint64_t)k);
        gen_matrix_t M = gen_store(&t, gen_style(0), 1);
        sl_symbolic *S = analyze_natural(&M.view, SL_RELAXATION_NONE);
        assert_int_equal(create(S, &M.view, options_none()), SL_ERR_UNSUPPORTED);
        sl_symbolic_free(S);
        gen_matrix_free(&M);
        gen_list_free(&t);
    }
}

/* A block of which one column is empty, or has only the 0 beside its diagonal entry. */
static void a_column_without_a_diagonal_is_refused(void **state) {
    (void)state;
    static const struct {
        sl_int p[3], i[2];
    } blocks[] = {{{0, 0, 2}, {0, 1}}, {{0, 2, 2}, {0, 1}}, {{0, 1, 2}, {0, 0}}};
    sl_options opt = options_none();
    opt.block_size = 2;
    for (size_t k = 0; k < 2 * sizeof blocks / sizeof *blocks; k++) {
        const double x[2] = {2.0, k % 2 == 0 ? 0.0 : 2.0};
        const sl_csc A = {2, 2, blocks[k / 2].p, blocks[k / 2].i, x};
        sl_symbolic *S = NULL;
        SL_CHECK(sl_symbolic_create(&S, &A, &opt, NULL));
        assert_int_equal(sl_symbolic_view(S).n_supers, 1);
        assert_int_equal(create(S, &A, options_none()), SL_ERR_UNSUPPORTED);
        sl_symbolic_free(S);
    }
}

static void an_infinite_entry_is_refused(void **state) {
    (void)state;
    static const sl_int p[3] = {0, 2, 3}, i[3] = {0, 1, 1};
    static const double x[3] = {INFINITY, 0.0, INFINITY};
    const sl_csc A = {2, 2, p, i, x};
    sl_options opt = options_none();
    sl_symbolic *S = NULL;
    opt.block_size = 2;
    SL_CHECK(sl_symbolic_create(&S, &A, &opt, NULL));
    assert_int_equal(create(S, &A, options_none()), SL_ERR_NOT_FINITE);
    sl_symbolic_free(S);
}

static void failing_allocations(void **state) {
    (void)state;
    pair_t y = pair_make(GEN_GRID2, 49, 0, SL_ISA_AUTO);
    sl_status status = SL_ERR_MEMORY;
    for (int64_t k = 0; status != SL_OK; k++) {
        counter_t counter = counter_make();
        sl_options opt = options_counted(&counter);
        sl_factor *F = NULL;
        opt.storage = SL_STORAGE_COMPLEX;
        counter.fail_at = k;
        status = sl_factor_create(&F, y.S, &y.A, &opt, NULL);
        assert_true(status == SL_OK || status == SL_ERR_MEMORY);
        assert_true(k > 0 || status == SL_ERR_MEMORY);
        sl_factor_free(F);
        COUNTER_CLEAN(&counter);
    }
    pair_free(&y);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(what_is_not_finite_is_named),
        cmocka_unit_test(what_is_not_complex_is_refused),
        cmocka_unit_test(plain_c_refuses_what_is_not_complex),
        cmocka_unit_test(blocks_must_be_complete),
        cmocka_unit_test(a_column_without_a_diagonal_is_refused),
        cmocka_unit_test(an_infinite_entry_is_refused),
        cmocka_unit_test(failing_allocations),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

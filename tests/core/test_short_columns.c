/* test_short_columns.c: columns with up to 7 rows below, kept apart where L is large */
#include "tests/lib/check_factor.h"
#include "tests/lib/graph_laplacian.h"
#include "tests/lib/local_solve.h"
#include "tests/lib/parallel_for.h"

/* A path and, from one row in `every`, a chord over up to 40 rows; every 0: none. */
static gen_list_t path_with_chords(sl_int n, sl_int every) {
    gen_list_t t = gen_list(n);
    uint64_t seed = 3;
    for (sl_int k = 0; k < n; k++) {
        gen_add(&t, k, k, 9.0);
        if (k > 0) {
            gen_add(&t, k, k - 1, -1.0);
        }
        if (every > 0 && k > 40 && gen_below(&seed, every) == 0) {
            gen_add(&t, k, k - 2 - gen_below(&seed, 38), -0.5);
        }
    }
    return t;
}

/* The numbers that L has for each of its entries, by the default order. */
static double stored_of(const sl_csc *A, sl_purpose purpose, double *entries) {
    sl_options opt = options_none();
    sl_symbolic *S = NULL;
    sl_stats stats;
    memset(&stats, 0, sizeof stats);
    opt.purpose = purpose;
    SL_CHECK(sl_symbolic_create(&S, A, &opt, &stats));
    *entries = (double)stats.symbolic.nnz_l;
    sl_symbolic_free(S);
    return (double)stats.symbolic.nnz_panels / *entries;
}

static double stored(sl_int n, sl_int every, sl_purpose purpose, double *entries) {
    gen_list_t t = path_with_chords(n, every);
    gen_matrix_t M = gen_store(&t, gen_style(0), 1);
    const double numbers = stored_of(&M.view, purpose, entries);
    gen_matrix_free(&M);
    gen_list_free(&t);
    return numbers;
}

/* Below 200,000 entries a path is in supernodes that solves go through faster, in the cache. From
 * there on its columns are apart, but not those of a grid, which has more entries in each. */
static void a_large_path_is_in_columns(void **state) {
    (void)state;
    double small, large;
    assert_true(stored(60000, 0, SL_PURPOSE_MANY_SOLVES, &small) > 4.0);
    assert_true(stored(70000, 0, SL_PURPOSE_MANY_SOLVES, &large) < 1.05);
    assert_true(small < 200000 && large > 200000);
    gen_matrix_t grid = gen_matrix(GEN_GRID2, 10000, 1, 1);
    assert_true(stored_of(&grid.view, SL_PURPOSE_MANY_SOLVES, &large) > 1.3);
    assert_true(large > 200000);
    gen_matrix_free(&grid);
}

/* Where the numbers of rows below vary, some columns are merged, and few zeros are stored. */
static void large_networks_have_few_zeros(void **state) {
    (void)state;
    double small, large;
    const double before = stored(30000, 4, SL_PURPOSE_MANY_SOLVES, &small);
    const double held = stored(60000, 4, SL_PURPOSE_MANY_SOLVES, &large);
    const double one = stored(60000, 4, SL_PURPOSE_ONE_FACTOR, &large);
    print_message("panels %.2f, large %.2f, for one factor %.2f times the entries of L\n", before,
                  held, one);
    assert_true(small < 200000 && large > 200000);
    assert_true(held > 1.05 && held < 2.2 && held < 0.7 * before && one < 2.2);
}

/* Columns apart from 0 to 9 rows below, by every method, instruction set and storage: L is right,
 * local solves have the bits of full ones, a number that is not finite is refused, and a null
 * pivot is replaced. */
static void short_columns_are_right(void **state) {
    (void)state;
    const variant_list_t variants = variants_present();
    gen_list_t t = path_with_chords(400, 3);
    gen_matrix_t M = gen_store(&t, gen_style(0), 1);
    gen_list_free(&t);
    for (int k = 0; k < 4 * STORAGES * variants.count; k++) {
        const int way = k / STORAGES % 4;
        sl_options opt = options_none();
        sl_symbolic *S = NULL;
        sl_factor *F = NULL;
        sl_work *W = NULL;
        sl_stats stats;
        int calls = 0;
        const double keep = M.x[M.p[100]];
        memset(&stats, 0, sizeof stats);
        options_set_variant(&opt, &variants, k / (4 * STORAGES));
        opt.storage = storage_at(k);
        opt.threads.count = way < 2 ? 0 : 3;
        opt.threads.run = way < 2 ? NULL : run_backwards;
        opt.threads.context = &calls;
        opt.relaxation = way % 2 ? SL_RELAXATION_NONE : SL_RELAXATION_DEFAULT;
        SL_CHECK(sl_symbolic_create(&S, &M.view, FOR_ANALYSIS(&opt), NULL));
        SL_CHECK(sl_factor_create(&F, S, &M.view, FOR_FACTOR(&opt), &stats));
        if (stats.factor.storage == SL_STORAGE_DOUBLE) {
            NOTHING_WRONG(check_factor(F, &M.view));
        }
        SL_CHECK(sl_work_create(&W, NULL));
        for (sl_int nrhs = 1; nrhs <= 9; nrhs += 4) {
            local_solve_t q = local_solve_random(F, M.view.n_cols, 4, 5, nrhs, (uint64_t)nrhs);
            local_solve_check(S, F, &q, W);
            local_solve_free(&q);
        }
        M.x[M.p[100]] = (double)NAN;
        SL_EXPECT(SL_ERR_NOT_FINITE, sl_factor_refactor(F, &M.view, &stats));
        M.x[M.p[100]] = keep;
        SL_CHECK(sl_factor_refactor(F, &M.view, &stats));
        sl_work_free(W);
        sl_factor_free(F);
        sl_symbolic_free(S);
    }
    gen_matrix_free(&M);
}

/* Along a ring the entries of the last row of L fall below the range of float, as nothing does in
 * the magnitudes of the row. */
static void tiny_entries_are_rounded(void **state) {
    (void)state;
    const variant_list_t variants = variants_present();
    for (int k = 0; k < variants.count; k++) {
        gen_list_t t = path_with_chords(200, 0);
        gen_add(&t, 199, 0, -1.0);
        gen_matrix_t M = gen_store(&t, gen_style(0), 1);
        gen_list_free(&t);
        sl_options opt = options_none();
        sl_factor *F = NULL;
        sl_symbolic *S = analyze_natural(&M.view, SL_RELAXATION_NONE);
        options_set_variant(&opt, &variants, k);
        opt.storage = SL_STORAGE_FLOAT;
        SL_CHECK(sl_factor_create(&F, S, &M.view, FOR_FACTOR(&opt), NULL));
        sl_factor_free(F);
        sl_symbolic_free(S);
        gen_matrix_free(&M);
    }
}

/* The last pivot of a Laplacian is null, in whatever column of a path it is. */
static void null_pivots_are_replaced(void **state) {
    (void)state;
    const variant_list_t variants = variants_present();
    for (int k = 0; k < STORAGES * variants.count; k++) {
        sl_int components;
        gen_matrix_t M = laplacian(GEN_PATH, 200, k % GEN_STYLES, &components);
        sl_options opt = options_skip_null(&variants, k / STORAGES);
        sl_symbolic *S = NULL;
        sl_factor *F = NULL;
        sl_stats stats;
        memset(&stats, 0, sizeof stats);
        opt.storage = storage_at(k);
        opt.relaxation = SL_RELAXATION_NONE;
        SL_CHECK(sl_symbolic_create(&S, &M.view, FOR_ANALYSIS(&opt), NULL));
        SL_CHECK(sl_factor_create(&F, S, &M.view, FOR_FACTOR(&opt), &stats));
        assert_int_equal(stats.factor.null, components);
        sl_factor_free(F);
        sl_symbolic_free(S);
        gen_matrix_free(&M);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_large_path_is_in_columns),
        cmocka_unit_test(large_networks_have_few_zeros),
        cmocka_unit_test(short_columns_are_right),
        cmocka_unit_test(tiny_entries_are_rounded),
        cmocka_unit_test(null_pivots_are_replaced),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

/* test_refactor_wrong.c: a refused refactorization keeps the factor; a numeric failure does not */
#include "tests/lib/factored.h"

enum { N = 400, TERMS = 2 };

/* Everything about a factor that a refused call could change. */
typedef struct snapshot_t {
    double *L, *D, *x;
    size_t panels;
    sl_stats stats;
} snapshot_t;

static void solve(const sl_factor *F, sl_status status, double *x) {
    double b[N];
    gen_reals(b, N, 5);
    SL_EXPECT(status, sl_factor_solve(F, x, N, b, N, 1, NULL));
}

static snapshot_t snapshot(const sl_factor *F) {
    sl_factor_arrays v = sl_factor_view(F);
    snapshot_t s;
    memset(&s, 0, sizeof s);
    s.panels = (size_t)panel_doubles(F);
    s.L = test_reals(s.panels);
    s.D = test_reals(N);
    s.x = test_reals(N);
    memcpy(s.L, v.L, s.panels * sizeof(double));
    memcpy(s.D, v.D, N * sizeof(double));
    solve(F, SL_OK, s.x);
    s.stats.factor = sl_factor_view(F).info;
    return s;
}

static void snapshot_free(snapshot_t *s) {
    free(s->L);
    free(s->D);
    free(s->x);
}

static void assert_unchanged(const sl_factor *F, const snapshot_t *s) {
    sl_factor_arrays v = sl_factor_view(F);
    sl_stats stats;
    double x[N];
    memset(&stats, 0, sizeof stats);
    stats.factor = sl_factor_view(F).info;
    assert_memory_equal(v.L, s->L, s->panels * sizeof(double));
    assert_memory_equal(v.D, s->D, N * sizeof(double));
    assert_memory_equal(&stats.factor, &s->stats.factor, sizeof stats.factor);
    solve(F, SL_OK, x);
    SAME_VALUES(x, s->x, N);
}

/* ---- matrices that do not fit ---- */

enum { WRONG = 9 };

/* Makes A wrong in way number `which`, on copies of its arrays. Returns the status to expect. */
static sl_status wrong_matrix(int which, const sl_csc *A, sl_csc *bad, sl_int *p, sl_int *i) {
    sl_int j = 0, nnz = A->p[N];
    memcpy(p, A->p, (N + 1) * sizeof *p);
    memcpy(i, A->i, (size_t)nnz * sizeof *i);
    *bad = *A;
    bad->p = p;
    bad->i = i;
    switch (which) {
    case 0: /* other n */
        bad->n_rows = bad->n_cols = N - 1;
        return SL_ERR_OTHER_PATTERN;
    case 1: /* other number of entries */
        p[N]--;
        return SL_ERR_OTHER_PATTERN;
    case 2: /* another row in one place */
        while (p[j + 1] - p[j] < 2 || i[p[j + 1] - 1] == N - 1) {
            j++;
        }
        i[p[j + 1] - 1]++;
        return SL_ERR_OTHER_PATTERN;
    case 3: /* the same entries, other columns */
        while (p[j + 1] - p[j] < 2) {
            j++;
        }
        p[j + 1]--;
        return SL_ERR_OTHER_PATTERN;
    case 4: /* the columns do not begin at 0 */
        p[0] = 1;
        return SL_ERR_MALFORMED;
    case 5: /* a row that does not exist */
        i[nnz / 2] = N;
        return SL_ERR_MALFORMED;
    case 6: /* no values */
        bad->x = NULL;
        return SL_ERR_ARGUMENT;
    case 7: /* no rows */
        bad->i = NULL;
        return SL_ERR_ARGUMENT;
    default: /* no columns */
        bad->p = NULL;
        return SL_ERR_ARGUMENT;
    }
}

/* The analysis of a forest keeps the arrays of its matrix, that of a grid their hash. */
static void a_wrong_matrix_changes_nothing(void **state) {
    (void)state;
    variant_list_t variants = variants_present();
    for (int k = 0; k < 2 * variants.count; k++) {
        sl_options opt = options_none();
        options_set_variant(&opt, &variants, k / 2);
        factored_t y = factored_make(k % 2 ? GEN_FOREST : GEN_GRID2, N, 1, 0, &opt);
        snapshot_t before = snapshot(y.F);
        sl_int *p = test_ints(N + 1), *i = test_ints((size_t)y.M.p[N]), column = 7;
        SL_EXPECT(SL_ERR_ARGUMENT, sl_factor_refactor(y.F, NULL, NULL));
        SL_EXPECT(SL_ERR_ARGUMENT,
                  sl_factor_change_entries(y.F, NULL, NULL, &column, NULL, 1, NULL, NULL));
        assert_unchanged(y.F, &before);
        for (int which = 0; which < WRONG; which++) {
            sl_csc bad;
            sl_status status = wrong_matrix(which, &y.M.view, &bad, p, i);
            sl_stats stats;
            memset(&stats, 0, sizeof stats);
            SL_EXPECT(status, sl_factor_refactor(y.F, &bad, &stats));
            assert_unchanged(y.F, &before);
            SL_EXPECT(status, sl_factor_refactor(y.F, &bad, NULL));
            SL_EXPECT(status,
                      sl_factor_change_entries(y.F, &bad, NULL, &column, NULL, 1, NULL, &stats));
            assert_unchanged(y.F, &before);
        }
        SL_CHECK(sl_factor_refactor(y.F, &y.M.view, NULL)); /* and it still can be factored again */
        solve(y.F, SL_OK, before.x);
        free(p);
        free(i);
        snapshot_free(&before);
        factored_free(&y);
    }
}

/* A region of the factor still fits it after a refused call: the numbers are the same. */
static void a_region_stays_valid(void **state) {
    (void)state;
    factored_t y = factored_make(GEN_GRID2, N, 1, 0, NULL);
    gen_matrix_t other = gen_matrix(GEN_PATH, N, 1, 1);
    const sl_int set[4] = {3, 4, 23, 24};
    double b[4] = {1, 2, 3, 4}, first[4], second[4];
    sl_options opt = options_none();
    sl_region *R = NULL;
    sl_plan *P = NULL;
    SL_CHECK(sl_region_create(&R, y.F, set, 4, NULL, NULL, NULL));
    opt.region = R;
    SL_CHECK(sl_plan_create(&P, y.S, set, 4, set, 4, &opt, NULL));
    SL_CHECK(sl_plan_solve(P, y.F, first, 4, b, 4, 1, NULL));
    SL_EXPECT(SL_ERR_OTHER_PATTERN, sl_factor_refactor(y.F, &other.view, NULL));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_factor_refactor_sums(&y.F, 1, NULL, NULL, 1, NULL, NULL, NULL));
    SL_CHECK(sl_plan_solve(P, y.F, second, 4, b, 4, 1, NULL));
    SAME_VALUES(first, second, 4);
    SL_CHECK(sl_factor_refactor(y.F, &y.M.view, NULL)); /* new numbers, even if they are equal */
    SL_EXPECT(SL_ERR_STALE, sl_plan_solve(P, y.F, second, 4, b, 4, 1, NULL));
    sl_plan_free(P);
    sl_region_free(R);
    gen_matrix_free(&other);
    factored_free(&y);
}

/* ---- numeric failures ---- */

static void a_numeric_failure_leaves_no_factor(void **state) {
    (void)state;
    variant_list_t variants = variants_present();
    for (int k = 0; k < variants.count; k++) {
        sl_options opt = options_none();
        options_set_variant(&opt, &variants, k);
        factored_t y = factored_make(GEN_GRID2, N, 1, 0, &opt);
        size_t nnz = (size_t)y.M.p[N];
        double *zeros = test_reals(nnz), *poison = test_reals(nnz), x[N];
        sl_csc Z = y.M.view, bad = y.M.view;
        snapshot_t before = snapshot(y.F);
        gen_matrix_t other = gen_matrix(GEN_PATH, N, 1, 1);
        memcpy(poison, y.M.x, nnz * sizeof *poison);
        poison[nnz / 3] = INFINITY;
        Z.x = zeros;
        bad.x = poison;
        SL_EXPECT(SL_ERR_PIVOT, sl_factor_refactor(y.F, &Z, NULL));
        solve(y.F, SL_ERR_STALE, x);
        SL_EXPECT(SL_ERR_OTHER_PATTERN,
                  sl_factor_refactor(y.F, &other.view, NULL)); /* still none */
        solve(y.F, SL_ERR_STALE, x);
        SL_CHECK(sl_factor_refactor(y.F, &y.M.view, NULL));
        solve(y.F, SL_OK, x);
        SAME_VALUES(x, before.x, N);
        SL_EXPECT(SL_ERR_NOT_FINITE, sl_factor_refactor(y.F, &bad, NULL));
        solve(y.F, SL_ERR_STALE, x);
        gen_matrix_free(&other);
        snapshot_free(&before);
        free(zeros);
        free(poison);
        factored_free(&y);
    }
}

/* The weights fix the null vector (1, 1) of the first matrix, but not (1, 2) of the second: there
 * the null pivot is refused. */
static void weights_that_fit_no_more(void **state) {
    (void)state;
    const sl_int p[3] = {0, 2, 3}, i[3] = {0, 1, 1};
    const double first[3] = {1, -1, 1}, second[3] = {4, -2, 1}, m[2] = {2, -1}, b[2] = {1, -1};
    sl_csc A = {2, 2, p, i, first};
    variant_list_t variants = variants_present();
    for (int k = 0; k < variants.count; k++) {
        sl_options opt = options_none();
        sl_symbolic *S = NULL;
        sl_factor *F = NULL;
        sl_stats stats;
        double x[2];
        memset(&stats, 0, sizeof stats);
        options_set_variant(&opt, &variants, k);
        opt.pivots = SL_PIVOTS_SKIP_NULL;
        opt.mass = m;
        A.x = first;
        SL_CHECK(sl_symbolic_create(&S, &A, NULL, NULL));
        SL_CHECK(sl_factor_create(&F, S, &A, &opt, NULL));
        SL_CHECK(sl_factor_solve(F, x, 2, b, 2, 1, NULL));
        A.x = second;
        SL_EXPECT(SL_ERR_PIVOT, sl_factor_refactor(F, &A, &stats));
        assert_in_range(stats.error.row, 0, 1);
        assert_int_equal(stats.factor.null, 1);
        SL_EXPECT(SL_ERR_STALE, sl_factor_solve(F, x, 2, b, 2, 1, NULL));
        sl_factor_free(F);
        sl_symbolic_free(S);
    }
}

/* ---- combinations, one by one and in a batch ---- */

static void a_wrong_combination_changes_nothing(void **state) {
    (void)state;
    variant_list_t variants = variants_present();
    for (int k = 0; k < variants.count; k++) {
        sl_options opt = options_none();
        options_set_variant(&opt, &variants, k);
        factored_t y = factored_make(GEN_GRID2, N, 1, 0, &opt);
        size_t entries = (size_t)scatter_length(y.S);
        double *values = test_reals(entries), c[2 * TERMS] = {1, 2, 1, 3}, x[N];
        const double *good[TERMS] = {values, values}, *missing[TERMS] = {values, NULL};
        double poison[2 * TERMS] = {1, 2, 1, NAN};
        sl_factor *F[2] = {NULL, NULL};
        sl_int failed = 5;
        SL_CHECK(sl_symbolic_scatter(y.S, values, &y.M.view, NULL));
        for (int m = 0; m < 2; m++) {
            SL_CHECK(sl_factor_create_sums(&F[m], 1, y.S, c, good, TERMS, &opt, NULL, NULL));
        }
        snapshot_t before = snapshot(F[0]), other = snapshot(F[1]);
        SL_EXPECT(SL_ERR_ARGUMENT,
                  sl_factor_refactor_sums(&F[0], 1, c, missing, TERMS, NULL, NULL, NULL));
        SL_EXPECT(SL_ERR_ARGUMENT,
                  sl_factor_refactor_sums(&F[0], 1, NULL, good, TERMS, NULL, NULL, NULL));
        SL_EXPECT(SL_ERR_ARGUMENT,
                  sl_factor_refactor_sums(&F[0], 1, c, NULL, TERMS, NULL, NULL, NULL));
        SL_EXPECT(SL_ERR_ARGUMENT,
                  sl_factor_refactor_sums(&F[0], 1, c, good, -1, NULL, NULL, NULL));
        SL_EXPECT(SL_ERR_ARGUMENT,
                  sl_factor_refactor_sums(F, 2, c, missing, TERMS, NULL, &failed, NULL));
        SL_EXPECT(SL_ERR_ARGUMENT,
                  sl_factor_refactor_sums(F, 2, NULL, good, TERMS, NULL, NULL, NULL));
        assert_int_equal(failed, -1);
        assert_unchanged(F[0], &before);
        assert_unchanged(F[1], &other);
        SL_EXPECT(SL_ERR_NOT_FINITE,
                  sl_factor_refactor_sums(F, 2, poison, good, TERMS, NULL, &failed, NULL));
        assert_int_equal(failed, 1);
        solve(F[0], SL_OK, x);
        solve(F[1], SL_ERR_STALE, x);
        SL_EXPECT(SL_ERR_NOT_FINITE,
                  sl_factor_refactor_sums(&F[0], 1, poison + TERMS, good, TERMS, NULL, NULL, NULL));
        solve(F[0], SL_ERR_STALE, x);
        free(values);
        snapshot_free(&before);
        snapshot_free(&other);
        sl_factor_free(F[0]);
        sl_factor_free(F[1]);
        factored_free(&y);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_wrong_matrix_changes_nothing),
        cmocka_unit_test(a_region_stays_valid),
        cmocka_unit_test(a_numeric_failure_leaves_no_factor),
        cmocka_unit_test(weights_that_fit_no_more),
        cmocka_unit_test(a_wrong_combination_changes_nothing),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

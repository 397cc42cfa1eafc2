/* test_changed.c: factoring again after local changes: the same factor to rounding, the rest untouched, wrong use */
#include "problem.h"

/* Largest relative difference of two factors: D by pivot, L against the largest of 1 and its column. */
static double distance(const sl_factor *F, const sl_factor *G) {
    sl_factor_view_t f = sl_factor_view(F), g = sl_factor_view(G);
    sl_symbolic_view_t v = sl_symbolic_view(f.symbolic);
    double worst = 0.0;
    for (sl_int k = 0; k < v.n; k++) {
        worst = fmax(worst, fabs(f.D[k] - g.D[k]) / fabs(g.D[k]));
    }
    for (sl_int s = 0; s < v.n_supers; s++) {
        sl_int width = ref_width(&v, s), height = ref_height(&v, s);
        for (sl_int c = 0; c < width; c++) {
            for (sl_int r = c + 1; r < height; r++) {
                sl_off at = v.panel_begin[s] + ref_place(width, r, c);
                worst = fmax(worst, fabs(f.L[at] - g.L[at]) / fmax(1.0, fabs(g.L[at])));
            }
        }
    }
    return worst;
}

/* Marks the supernodes that changes in some columns of A reach. */
static char *reached(const sl_symbolic *S, const sl_csc *A, const sl_int *columns, sl_int count) {
    sl_symbolic_view_t v = sl_symbolic_view(S);
    char *mark = (char *)test_array((size_t)v.n_supers, 1);
    for (sl_int k = 0; k < count; k++) {
        for (sl_int p = A->p[columns[k]]; p < A->p[columns[k] + 1]; p++) {
            sl_int a = v.iperm[A->i[p]], b = v.iperm[columns[k]];
            for (sl_int s = v.super_of[a < b ? a : b]; s != -1; s = v.super_parent[s]) {
                mark[s] = 1;
            }
        }
    }
    return mark;
}

/* Makes the entries of some columns larger: the matrix stays dominated by its diagonal where that grows as well. */
static void change(gen_matrix_t *M, const sl_int *columns, sl_int count, uint64_t *seed) {
    for (sl_int k = 0; k < count; k++) {
        sl_int j = columns[k];
        for (sl_int p = M->p[j]; p < M->p[j + 1]; p++) {
            M->x[p] *= M->i[p] == j ? 1.0 + fabs(gen_real(seed)) : 0.5 + 0.4 * fabs(gen_real(seed));
        }
    }
}

static void equals_a_whole_factorization(void **state) {
    (void)state;
    static const sl_int sizes[3] = {20, 150, 900};
    isa_list_t isas = isas_present();
    uint64_t seed = 21;
    for (int kind = 1; kind < GEN_REGULAR; kind++) {
        for (int size = 0; size < 3; size++) {
            for (int style = 0; style < GEN_STYLES; style += 5) {
                sl_options opt = options_none();
                opt.isa = isas.isa[(kind + size + style) % isas.count];
                opt.method = style == 5 ? SL_METHOD_AUTO : SL_METHOD_SUPERNODAL;
                problem_t y = problem_make((gen_kind_t)kind, sizes[size], 0, style, &opt);
                sl_int n = y.M.view.n_cols, *columns = test_ints((size_t)n);
                sl_symbolic_view_t v = sl_symbolic_view(y.S);
                sl_factor *F = NULL, *G = NULL;
                SL_CHECK(sl_factor_create(&F, y.S, &y.M.view, &opt, NULL));
                sl_stats stats;
                memset(&stats, 0, sizeof stats);
                sl_factor_stats(F, &stats);
                for (sl_int count = 1; count <= n; count = 2 * count + gen_below(&seed, 5)) {
                    gen_set(columns, count, n, gen_bits(&seed));
                    change(&y.M, columns, count, &seed);
                    char *mark = reached(y.S, &y.M.view, columns, count);
                    size_t doubles = (size_t)panel_doubles(F);
                    double *before = test_reals(doubles);
                    memcpy(before, sl_factor_view(F).L, doubles * sizeof *before);
                    SL_CHECK(sl_factor_refactor_changed(F, &y.M.view, columns, count, &stats));
                    SL_CHECK(sl_factor_create(&G, y.S, &y.M.view, &opt, NULL));
                    double grown = kind == GEN_SCALED || kind == GEN_KKT ? 1e6 : 1.0;
                    assert_true(distance(F, G) <= 64.0 * grown * (double)(n + 1) * DBL_EPSILON);
                    assert_int_equal(stats.positive + stats.negative, n);
                    for (sl_int s = 0; s < v.n_supers && stats.method == SL_METHOD_SUPERNODAL;
                         s++) {
                        size_t at = (size_t)v.panel_begin[s], end = (size_t)v.panel_begin[s + 1];
                        if (!mark[s]) { /* not computed again, not even to the same bits */
                            assert_memory_equal(before + at, sl_factor_view(F).L + at,
                                                (end - at) * sizeof(double));
                        }
                    }
                    sl_factor_free(G);
                    G = NULL;
                    free(mark);
                    free(before);
                }
                sl_factor_free(F);
                free(columns);
                problem_free(&y);
            }
        }
    }
}

/* Only what is reached is read: a NaN elsewhere is not met, one inside is named. */
static void reads_only_what_is_reached(void **state) {
    (void)state;
    sl_options opt = options_none();
    opt.method = SL_METHOD_SUPERNODAL;
    problem_t y = problem_make(GEN_COMPONENTS, 400, 1, 0, &opt);
    sl_int n = y.M.view.n_cols;
    char *mark = NULL;
    sl_int column = 0, other = -1;
    sl_symbolic_view_t v = sl_symbolic_view(y.S);
    mark = reached(y.S, &y.M.view, &column, 1);
    for (sl_int j = 0; j < n; j++) {
        if (y.M.p[j] < y.M.p[j + 1] && !mark[v.super_of[v.iperm[j]]] &&
            !mark[v.super_of[v.iperm[y.M.i[y.M.p[j]]]]]) {
            other = j;
        }
    }
    assert_true(other >= 0);
    double keep = y.M.x[y.M.p[other]];
    y.M.x[y.M.p[other]] = NAN;
    SL_CHECK(sl_factor_refactor_changed(y.F, &y.M.view, &column, 1, NULL));
    sl_stats stats;
    memset(&stats, 0, sizeof stats);
    SL_EXPECT(SL_ERR_NOT_FINITE, sl_factor_refactor_changed(y.F, &y.M.view, &other, 1, &stats));
    assert_int_equal(stats.error_row, y.M.i[y.M.p[other]]);
    assert_int_equal(stats.error_column, other);
    /* a failed factor has to be made whole again */
    SL_EXPECT(SL_ERR_STATE, sl_factor_refactor_changed(y.F, &y.M.view, &column, 1, &stats));
    y.M.x[y.M.p[other]] = keep;
    SL_CHECK(sl_factor_refactor(y.F, &y.M.view, NULL));
    SL_CHECK(sl_factor_refactor_changed(y.F, &y.M.view, &column, 1, &stats));
    free(mark);
    problem_free(&y);
}

static void a_null_pivot_is_named(void **state) {
    (void)state;
    sl_options opt = options_none();
    opt.method = SL_METHOD_SUPERNODAL;
    problem_t y = problem_make(GEN_GRID2, 400, 1, 0, &opt);
    for (sl_int j = 7; j < y.M.view.n_cols; j += 61) {
        sl_stats stats;
        memset(&stats, 0, sizeof stats);
        size_t bytes = (size_t)y.M.p[y.M.view.n_cols] * sizeof(double);
        double *keep = test_reals(bytes / sizeof(double));
        memcpy(keep, y.M.x, bytes);
        for (sl_int k = 0; k <= j; k++) { /* row and column j are 0 */
            for (sl_int p = y.M.p[k]; p < y.M.p[k + 1]; p++) {
                y.M.x[p] = k == j || y.M.i[p] == j ? 0.0 : y.M.x[p];
            }
        }
        sl_int *columns = test_ints((size_t)j + 1);
        for (sl_int k = 0; k <= j; k++) {
            columns[k] = k;
        }
        SL_EXPECT(SL_ERR_PIVOT, sl_factor_refactor_changed(y.F, &y.M.view, columns, j + 1, &stats));
        assert_int_equal(stats.error_row, j);
        assert_int_equal(stats.null, 1);
        memcpy(y.M.x, keep, bytes);
        SL_CHECK(sl_factor_refactor(y.F, &y.M.view, NULL));
        free(columns);
        free(keep);
    }
    problem_free(&y);
}

static void wrong_use(void **state) {
    (void)state;
    counter_t counter = counter_make();
    sl_options opt = options_counted(&counter);
    opt.method = SL_METHOD_SUPERNODAL;
    problem_t y = problem_make(GEN_GRID2, 100, 1, 0, &opt);
    gen_matrix_t other = gen_matrix(GEN_PATH, 100, 1, 1);
    const sl_int fine[2] = {3, 3}, below[2] = {3, -1}, above[2] = {100, 3};
    sl_stats stats;
    memset(&stats, 0, sizeof stats);
    SL_EXPECT(SL_ERR_ARGUMENT, sl_factor_refactor_changed(NULL, &y.M.view, fine, 2, NULL));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_factor_refactor_changed(y.F, NULL, fine, 2, NULL));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_factor_refactor_changed(y.F, &y.M.view, NULL, 2, NULL));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_factor_refactor_changed(y.F, &y.M.view, fine, -1, NULL));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_factor_refactor_changed(y.F, &y.M.view, below, 2, &stats));
    assert_int_equal(stats.error_row, -1);
    SL_EXPECT(SL_ERR_ARGUMENT, sl_factor_refactor_changed(y.F, &y.M.view, above, 2, &stats));
    assert_int_equal(stats.error_row, 100);
    SL_EXPECT(SL_ERR_PATTERN, sl_factor_refactor_changed(y.F, &other.view, fine, 2, NULL));
    counter.fail_at = (int64_t)counter.calls;
    SL_EXPECT(SL_ERR_MEMORY, sl_factor_refactor_changed(y.F, &y.M.view, fine, 2, NULL));
    counter.fail_at = -1;
    double b[100], x[100];
    gen_reals(b, 100, 2);
    SL_CHECK(sl_factor_solve(y.F, x, 100, b, 100, 1, NULL)); /* F is as it was */
    BACKWARD_PASSES(&y.M.view, x, 100, b, 100, 1);
    SL_CHECK(sl_factor_refactor_changed(y.F, &y.M.view, fine, 2, NULL)); /* twice the same column */
    SL_CHECK(sl_factor_refactor_changed(y.F, &y.M.view, NULL, 0, NULL));
    SL_CHECK(sl_factor_solve(y.F, x, 100, b, 100, 1, NULL));
    BACKWARD_PASSES(&y.M.view, x, 100, b, 100, 1);
    gen_matrix_free(&other);
    problem_free(&y);
    COUNTER_CLEAN(&counter);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(equals_a_whole_factorization),
        cmocka_unit_test(reads_only_what_is_reached),
        cmocka_unit_test(a_null_pivot_is_named),
        cmocka_unit_test(wrong_use),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

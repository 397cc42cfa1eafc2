/* test_change_columns.c: sl_factor_change_entries by columns: what is recomputed, errors */
#include "tests/lib/factored.h"

/* Largest difference of two factors: of D relative to each pivot, of L relative to max(1, |l|). */
static double largest_difference(const sl_factor *F, const sl_factor *G) {
    sl_factor_arrays f = sl_factor_view(F), g = sl_factor_view(G);
    sl_symbolic_arrays v = sl_symbolic_view(f.symbolic);
    double worst = 0.0;
    for (sl_int k = 0; k < v.n; k++) {
        worst = fmax(worst, fabs(f.D[k] - g.D[k]) / fabs(g.D[k]));
    }
    for (sl_int s = 0; s < v.n_supers; s++) {
        sl_int width = ref_width(&v, s), height = ref_height(&v, s);
        for (sl_int c = 0; c < width; c++) {
            for (sl_int r = c + 1; r < height; r++) {
                sl_off at = v.panel_begin[s] + ref_position(width, r, c);
                worst = fmax(worst, fabs(f.L[at] - g.L[at]) / fmax(1.0, fabs(g.L[at])));
            }
        }
    }
    return worst;
}

/* Marks the supernodes on the tree paths that start at entries in these columns of A. */
static char *mark_reach(const sl_symbolic *S, const sl_csc *A, const sl_int *columns,
                        sl_int count) {
    sl_symbolic_arrays v = sl_symbolic_view(S);
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

/* Scales the entries of some columns so that the matrix stays diagonally dominant. */
static void scale_columns(gen_matrix_t *M, const sl_int *columns, sl_int count, uint64_t *seed) {
    for (sl_int k = 0; k < count; k++) {
        sl_int j = columns[k];
        for (sl_int p = M->p[j]; p < M->p[j + 1]; p++) {
            M->x[p] *= M->i[p] == j ? 1.0 + fabs(gen_real(seed)) : 0.5 + 0.4 * fabs(gen_real(seed));
        }
    }
}

static void a_local_refactor_equals_a_full_one(void **state) {
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
                opt.triangle = style == 5 ? SL_TRIANGLE_LOWER : SL_TRIANGLE_NONE; /* of both */
                factored_t y = factored_make((gen_kind_t)kind, sizes[size], 0, style, &opt);
                sl_int n = y.M.view.n_cols, *columns = test_ints((size_t)n);
                sl_symbolic_arrays v = sl_symbolic_view(y.S);
                sl_factor *F = NULL, *G = NULL;
                opt.triangle = SL_TRIANGLE_NONE; /* only the analysis reads it */
                SL_CHECK(sl_factor_create(&F, y.S, &y.M.view, &opt, NULL));
                sl_stats stats;
                memset(&stats, 0, sizeof stats);
                stats.factor = sl_factor_view(F).info;
                for (sl_int count = 1; count <= n; count = 2 * count + gen_below(&seed, 5)) {
                    gen_set(columns, count, n, gen_bits(&seed));
                    scale_columns(&y.M, columns, count, &seed);
                    char *mark = mark_reach(y.S, &y.M.view, columns, count);
                    size_t doubles = (size_t)panel_doubles(F);
                    double *before = test_reals(doubles);
                    memcpy(before, sl_factor_view(F).L, doubles * sizeof *before);
                    SL_CHECK(sl_factor_change_entries(F, &y.M.view, NULL, columns, NULL, count,
                                                      NULL, &stats));
                    SL_CHECK(sl_factor_create(&G, y.S, &y.M.view, &opt, NULL));
                    double grown = kind == GEN_SCALED || kind == GEN_KKT ? 1e6 : 1.0;
                    assert_true(largest_difference(F, G) <=
                                64.0 * grown * (double)(n + 1) * DBL_EPSILON);
                    assert_int_equal(stats.factor.positive + stats.factor.negative, n);
                    for (sl_int s = 0;
                         s < v.n_supers && stats.factor.method == SL_METHOD_SUPERNODAL; s++) {
                        size_t at = (size_t)v.panel_begin[s], end = (size_t)v.panel_begin[s + 1];
                        if (!mark[s]) { /* not recomputed, not even to the same bits */
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
                factored_free(&y);
            }
        }
    }
}

/* Only the columns in the reach are read: a NaN elsewhere has no effect, one inside is reported. */
static void only_the_reach_is_read(void **state) {
    (void)state;
    sl_options opt = options_none();
    opt.method = SL_METHOD_SUPERNODAL;
    factored_t y = factored_make(GEN_COMPONENTS, 400, 1, 0, &opt);
    sl_int n = y.M.view.n_cols;
    char *mark = NULL;
    sl_int column = 0, other = -1;
    sl_symbolic_arrays v = sl_symbolic_view(y.S);
    mark = mark_reach(y.S, &y.M.view, &column, 1);
    for (sl_int j = 0; j < n; j++) {
        if (y.M.p[j] < y.M.p[j + 1] && !mark[v.super_of[v.iperm[j]]] &&
            !mark[v.super_of[v.iperm[y.M.i[y.M.p[j]]]]]) {
            other = j;
        }
    }
    assert_true(other >= 0);
    double keep = y.M.x[y.M.p[other]];
    y.M.x[y.M.p[other]] = NAN;
    SL_CHECK(sl_factor_change_entries(y.F, &y.M.view, NULL, &column, NULL, 1, NULL, NULL));
    sl_stats stats;
    memset(&stats, 0, sizeof stats);
    SL_EXPECT(SL_ERR_NOT_FINITE,
              sl_factor_change_entries(y.F, &y.M.view, NULL, &other, NULL, 1, NULL, &stats));
    assert_int_equal(stats.error.row, y.M.i[y.M.p[other]]);
    assert_int_equal(stats.error.column, other);
    /* after a failure only a full refactor is accepted */
    SL_EXPECT(SL_ERR_STALE,
              sl_factor_change_entries(y.F, &y.M.view, NULL, &column, NULL, 1, NULL, &stats));
    y.M.x[y.M.p[other]] = keep;
    SL_CHECK(sl_factor_refactor(y.F, &y.M.view, NULL));
    SL_CHECK(sl_factor_change_entries(y.F, &y.M.view, NULL, &column, NULL, 1, NULL, &stats));
    free(mark);
    factored_free(&y);
}

static void a_null_pivot_is_reported(void **state) {
    (void)state;
    sl_options opt = options_none();
    opt.method = SL_METHOD_SUPERNODAL;
    factored_t y = factored_make(GEN_GRID2, 400, 1, 0, &opt);
    for (sl_int j = 7; j < y.M.view.n_cols; j += 61) {
        sl_stats stats;
        memset(&stats, 0, sizeof stats);
        size_t bytes = (size_t)y.M.p[y.M.view.n_cols] * sizeof(double);
        double *keep = test_reals(bytes / sizeof(double));
        memcpy(keep, y.M.x, bytes);
        for (sl_int k = 0; k <= j; k++) { /* row and column j become 0 */
            for (sl_int p = y.M.p[k]; p < y.M.p[k + 1]; p++) {
                y.M.x[p] = k == j || y.M.i[p] == j ? 0.0 : y.M.x[p];
            }
        }
        sl_int *columns = test_ints((size_t)j + 1);
        for (sl_int k = 0; k <= j; k++) {
            columns[k] = k;
        }
        SL_EXPECT(SL_ERR_PIVOT, sl_factor_change_entries(y.F, &y.M.view, NULL, columns, NULL, j + 1,
                                                         NULL, &stats));
        assert_int_equal(stats.error.row, j);
        assert_int_equal(stats.factor.null, 1);
        memcpy(y.M.x, keep, bytes);
        SL_CHECK(sl_factor_refactor(y.F, &y.M.view, NULL));
        free(columns);
        free(keep);
    }
    factored_free(&y);
}

static void invalid_arguments_are_refused(void **state) {
    (void)state;
    counter_t counter = counter_make();
    sl_options opt = options_counted(&counter);
    opt.method = SL_METHOD_SUPERNODAL;
    factored_t y = factored_make(GEN_GRID2, 100, 1, 0, &opt);
    gen_matrix_t other = gen_matrix(GEN_PATH, 100, 1, 1);
    const sl_int fine[2] = {3, 3}, below[2] = {3, -1}, above[2] = {100, 3};
    sl_stats stats;
    memset(&stats, 0, sizeof stats);
    SL_EXPECT(SL_ERR_ARGUMENT,
              sl_factor_change_entries(NULL, &y.M.view, NULL, fine, NULL, 2, NULL, NULL));
    SL_EXPECT(SL_ERR_ARGUMENT,
              sl_factor_change_entries(y.F, NULL, NULL, fine, NULL, 2, NULL, NULL));
    SL_EXPECT(SL_ERR_ARGUMENT,
              sl_factor_change_entries(y.F, &y.M.view, NULL, NULL, NULL, 2, NULL, NULL));
    SL_EXPECT(SL_ERR_ARGUMENT,
              sl_factor_change_entries(y.F, &y.M.view, NULL, fine, NULL, -1, NULL, NULL));
    SL_EXPECT(SL_ERR_ARGUMENT,
              sl_factor_change_entries(y.F, &y.M.view, NULL, below, NULL, 2, NULL, &stats));
    assert_int_equal(stats.error.row, -1);
    SL_EXPECT(SL_ERR_ARGUMENT,
              sl_factor_change_entries(y.F, &y.M.view, NULL, above, NULL, 2, NULL, &stats));
    assert_int_equal(stats.error.row, 100);
    SL_EXPECT(SL_ERR_OTHER_PATTERN,
              sl_factor_change_entries(y.F, &other.view, NULL, fine, NULL, 2, NULL, NULL));
    for (int k = 0; k < 2; k++) { /* both allocations */
        counter.fail_at = (int64_t)counter.calls + k;
        SL_EXPECT(SL_ERR_MEMORY,
                  sl_factor_change_entries(y.F, &y.M.view, NULL, fine, NULL, 2, NULL, NULL));
    }
    counter.fail_at = -1;
    double b[100], x[100];
    gen_reals(b, 100, 2);
    SL_CHECK(sl_factor_solve(y.F, x, 100, b, 100, 1, NULL)); /* F is unchanged */
    BACKWARD_PASSES(&y.M.view, x, 100, b, 100, 1);
    SL_CHECK(sl_factor_change_entries(y.F, &y.M.view, NULL, fine, NULL, 2, NULL,
                                      NULL)); /* the same column twice */
    SL_CHECK(sl_factor_change_entries(y.F, &y.M.view, NULL, NULL, NULL, 0, NULL, NULL));
    SL_CHECK(sl_factor_solve(y.F, x, 100, b, 100, 1, NULL));
    BACKWARD_PASSES(&y.M.view, x, 100, b, 100, 1);
    gen_matrix_free(&other);
    factored_free(&y);
    COUNTER_CLEAN(&counter);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_local_refactor_equals_a_full_one),
        cmocka_unit_test(only_the_reach_is_read),
        cmocka_unit_test(a_null_pivot_is_reported),
        cmocka_unit_test(invalid_arguments_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

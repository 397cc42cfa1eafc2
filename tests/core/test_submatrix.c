/* test_submatrix.c: sl_factor_submatrix: the factor of A[R, R], what is kept, solves with it */
#include "tests/lib/check_inverse.h"
#include "tests/lib/submatrix.h"
#include "tests/lib/constraint_calls.h"

static void restrictions_are_factors_of_the_submatrix(void **state) {
    (void)state;
    isa_list_t isas = isas_present();
    int kept = 0, anew = 0;
    for (int kind = 0; kind < GEN_REGULAR; kind++) {
        for (int shape = 0; shape < SUBSET_SHAPES; shape++) {
            for (int k = 0; k < 4; k++) {
                sl_options opt = options_none();
                opt.isa = isas.isa[(k + shape) % isas.count];
                opt.relaxation = k == 1 ? SL_RELAXATION_NONE : SL_RELAXATION_DEFAULT;
                opt.method = k == 2 ? SL_METHOD_UP_LOOKING : SL_METHOD_AUTO;
                submatrix_t t = submatrix_make((gen_kind_t)kind, k % 2 ? 150 : 60,
                                               kind == GEN_KKT || k < 3 ? 1 : -1,
                                               (3 * shape + k) % GEN_STYLES, shape, &opt);
                submatrix_check(&t);
                kept += t.stats.submatrix.kept > 0 && t.stats.submatrix.computed > 0;
                anew += t.stats.submatrix.is_anew;
                submatrix_free(&t);
            }
        }
    }
    assert_true(kept > 100 && anew > 50); /* both ways were taken */
}

/* With all rows nothing is computed, and L has the same bits. */
static void all_rows_give_the_same_factor(void **state) {
    (void)state;
    for (int kind = 0; kind < GEN_REGULAR; kind++) {
        submatrix_t t = submatrix_make((gen_kind_t)kind, 150, 1, 0, SUBSET_ALL, NULL);
        assert_int_equal(t.stats.submatrix.kept, t.count);
        assert_same_bits(t.y.F, t.G);
        submatrix_free(&t);
    }
}

/* Columns without a removed descendant have the same pivots, bit for bit, if they were kept. */
static void kept_pivots_have_the_same_bits(void **state) {
    (void)state;
    submatrix_t t = submatrix_make(GEN_GRID2, 400, 1, 0, SUBSET_HALF, NULL);
    sl_symbolic_arrays a = sl_symbolic_view(t.y.S), b = sl_symbolic_view(t.S);
    const double *D = sl_factor_view(t.y.F).D, *E = sl_factor_view(t.G).D;
    char *is_below = (char *)test_array((size_t)a.n, 1); /* removed, or a descendant is */
    sl_int same = 0;
    memset(is_below, 1, (size_t)a.n);
    for (sl_int k = 0; k < t.count; k++) {
        is_below[a.iperm[t.rows[k]]] = 0;
    }
    for (sl_int k = 0; k < a.n; k++) {
        if (is_below[k] && a.parent[k] != -1) {
            is_below[a.parent[k]] = 1;
        }
    }
    for (sl_int k = 0; k < t.count; k++) {
        const sl_int from = a.iperm[t.rows[k]];
        same += !is_below[from] && D[from] == E[b.iperm[k]];
    }
    assert_true(same >= t.stats.submatrix.kept);
    assert_true(t.stats.submatrix.kept > t.count / 2 && t.stats.submatrix.kept < t.count);
    assert_true(t.stats.submatrix.entries > 0);
    free(is_below);
    submatrix_free(&t);
}

/* The order of the rows only numbers them. */
static void rows_may_be_in_any_order(void **state) {
    (void)state;
    submatrix_t t = submatrix_make(GEN_GRID3, 216, 1, 2, SUBSET_HALF, NULL);
    sl_int n = t.count, *order = test_ints((size_t)n), *rows = test_ints((size_t)n);
    sl_symbolic *S = NULL;
    sl_factor *G = NULL;
    gen_permutation(order, n, 8);
    for (sl_int k = 0; k < n; k++) {
        rows[k] = t.rows[order[k]];
    }
    SL_CHECK(sl_factor_submatrix(&S, &G, t.y.F, &t.y.M.view, rows, n, NULL, NULL));
    double *b = test_reals((size_t)n), *x = test_reals((size_t)n), *y = test_reals((size_t)n);
    gen_reals(b, (size_t)n, 4);
    SL_CHECK(sl_factor_solve(t.G, x, (size_t)n, b, (size_t)n, 1, NULL));
    for (sl_int k = 0; k < n; k++) {
        y[k] = b[order[k]];
    }
    SL_CHECK(sl_factor_solve(G, y, (size_t)n, y, (size_t)n, 1, NULL));
    for (sl_int k = 0; k < n; k++) {
        assert_true(fabs(y[k] - x[order[k]]) <= 1e-13 * fabs(x[order[k]]) + 1e-15);
    }
    free(order);
    free(rows);
    free(b);
    free(x);
    free(y);
    sl_factor_free(G);
    sl_symbolic_free(S);
    submatrix_free(&t);
}

/* A small set is found by hashing: a few rows of many, near each other and far apart. */
static void few_rows_of_many(void **state) {
    (void)state;
    factored_t y = factored_make(GEN_GRID2, 6400, 1, 0, NULL);
    const sl_int n = y.M.view.n_cols;
    for (sl_int count = 0; count <= 48; count += 12) {
        sl_int rows[49];
        for (sl_int k = 0; k < count; k++) {
            rows[k] = k % 2 == 0 ? n / 2 + k : (k * 130 + 7) % (n / 2);
        }
        submatrix_t t;
        memset(&t, 0, sizeof t);
        t.count = count;
        t.B = subset_matrix(&y.M.view, rows, count);
        SL_CHECK(sl_factor_submatrix(&t.S, &t.G, y.F, &y.M.view, rows, count, NULL, &t.stats));
        submatrix_check(&t);
        sl_factor_free(t.G);
        sl_symbolic_free(t.S);
        gen_matrix_free(&t.B);
        if (count > 0) {
            sl_stats stats;
            rows[count] = rows[count / 2];
            assert_int_equal(
                sl_factor_submatrix(&t.S, &t.G, y.F, &y.M.view, rows, count + 1, NULL, &stats),
                SL_ERR_ARGUMENT);
            assert_int_equal(stats.error.row, rows[count]);
            assert_true(t.S == NULL && t.G == NULL);
        }
    }
    factored_free(&y);
}

/* Small sets of neighbors, with and without kept supernodes, and one row far away: the filter takes
 * a row below the first one, which is not in the set, for this one. */
static void few_neighbors_of_many(void **state) {
    (void)state;
    enum { COUNT = 24, SETS = 60, PERIOD = 4096, SIDE = 80 };
    factored_t y = factored_make(GEN_GRID2, SIDE * SIDE, 1, 0, NULL);
    const sl_int *perm = sl_symbolic_view(y.S).perm;
    int with_kept = 0;
    for (sl_int set = 0; set < SETS; set++) {
        sl_int rows[COUNT + 1];
        submatrix_t t;
        memset(&t, 0, sizeof t);
        for (sl_int k = 0; k < COUNT; k++) {
            rows[k] = perm[101 * set + k];
        }
        rows[COUNT] = rows[0] + SIDE + PERIOD;
        t.count = rows[COUNT] < SIDE * SIDE ? COUNT + 1 : COUNT;
        t.B = subset_matrix(&y.M.view, rows, t.count);
        SL_CHECK(sl_factor_submatrix(&t.S, &t.G, y.F, &y.M.view, rows, t.count, NULL, &t.stats));
        submatrix_check(&t);
        with_kept += t.stats.submatrix.kept > 0;
        sl_factor_free(t.G);
        sl_symbolic_free(t.S);
        gen_matrix_free(&t.B);
    }
    assert_in_range(with_kept, 1, SETS - 1);
    factored_free(&y);
}

/* F may be released; inverse, selected inverse, region, pins work on what remains. */
static void restrictions_are_independent_and_complete(void **state) {
    (void)state;
    for (int shape = SUBSET_HALF; shape < SUBSET_SHAPES; shape++) {
        submatrix_t t = submatrix_make(GEN_GRID2, 225, 1, shape % GEN_STYLES, shape, NULL);
        sl_int n = t.count;
        sl_factor_free(t.y.F);
        sl_symbolic_free(t.y.S);
        t.y.F = NULL;
        t.y.S = NULL;
        double *M = ref_dense(&t.B.view), *Z = ref_inverse(n, M);
        double *diagonal = test_reals((size_t)n), *b = test_reals((size_t)n),
               *x = test_reals((size_t)n);
        sl_selected *selected = NULL;
        sl_region *region = NULL;
        sl_constraints *pins = NULL;
        const double two = 2.0;
        SL_CHECK(sl_inverse_diagonal(t.G, diagonal, NULL, n, NULL, NULL));
        for (sl_int k = 0; k < n; k++) {
            assert_true(fabs(diagonal[k] - AT(Z, k, k)) <= 1e-12 * fabs(AT(Z, k, k)));
        }
        SL_CHECK(sl_selected_create(&selected, t.G, NULL, SL_ALL, NULL, NULL));
        SL_CHECK(sl_selected_entries(selected, diagonal, NULL, NULL, n, NULL));
        for (sl_int k = 0; k < n; k++) {
            assert_true(fabs(diagonal[k] - AT(Z, k, k)) <= 1e-12 * fabs(AT(Z, k, k)));
        }
        sl_int some[3] = {0, n / 2, n - 1};
        SL_CHECK(sl_region_create(&region, t.G, some, 3, NULL, NULL, NULL));
        gen_reals(b, (size_t)n, 6);
        SL_CHECK(sl_constraints_create(&pins, t.G, NULL));
        SL_CHECK(pin_row(pins, n / 2, NULL));
        SL_CHECK(sl_constraints_solve(pins, NULL, x, (size_t)n, b, (size_t)n, &two, 1, 1, NULL));
        assert_true(fabs(x[n / 2] - 2.0) <= 1e-14);
        sl_constraints_free(pins);
        sl_region_free(region);
        sl_selected_free(selected);
        free(M);
        free(Z);
        free(diagonal);
        free(b);
        free(x);
        submatrix_free(&t);
    }
}

/* Where R has few rows of A, many and most: its entries are found by a filter or by an array, and
 * read from a copy or in place. */
static void every_entry_that_is_not_finite_is_named(void **state) {
    (void)state;
    const sl_int counts[] = {5, 40, 150};
    factored_t y = factored_make(GEN_GRID2, 225, 1, 0, NULL);
    for (int c = 0; c < 3; c++) {
        sl_int rows[150], named = 0;
        for (sl_int k = 0; k < counts[c]; k++) {
            rows[k] = counts[c] - 1 - k;
        }
        for (sl_int j = 0; j < counts[c]; j++) {
            for (sl_int p = y.M.p[j]; p < y.M.p[j + 1]; p++) {
                const double keep = y.M.x[p];
                sl_symbolic *S = NULL;
                sl_factor *G = NULL;
                sl_stats stats;
                y.M.x[p] = NAN;
                if (sl_factor_submatrix(&S, &G, y.F, &y.M.view, rows, counts[c], NULL, &stats) !=
                    SL_OK) {
                    assert_int_equal(stats.error.row, y.M.i[p]);
                    assert_int_equal(stats.error.column, j);
                    named += y.M.i[p] != j;
                }
                y.M.x[p] = keep;
                sl_factor_free(G);
                sl_symbolic_free(S);
            }
        }
        assert_true(named > 0);
    }
    factored_free(&y);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(restrictions_are_factors_of_the_submatrix),
        cmocka_unit_test(all_rows_give_the_same_factor),
        cmocka_unit_test(kept_pivots_have_the_same_bits),
        cmocka_unit_test(rows_may_be_in_any_order),
        cmocka_unit_test(few_rows_of_many),
        cmocka_unit_test(few_neighbors_of_many),
        cmocka_unit_test(every_entry_that_is_not_finite_is_named),
        cmocka_unit_test(restrictions_are_independent_and_complete),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

/* test_inverse_diagonal.c: sl_inverse_diagonal and sl_inverse_pairs: sweeps or a traversal */
#include "tests/lib/check_inverse.h"
#include "tests/lib/parallel_for.h"

/* The pivot index of a row of A, by which the reference is addressed. */
static sl_int pivot_of(const factored_t *y, sl_int row) {
    return sl_symbolic_view(y->S).iperm[row];
}

static void assert_near(const factored_t *y, const reference_t *r, sl_int row, sl_int column,
                        double value) {
    sl_int n = y->M.view.n_cols, i = pivot_of(y, row), j = pivot_of(y, column);
    if (!(fabs(value - AT(r->Z, i, j)) <= AT(r->bound, i, j))) {
        print_error("(%ld, %ld): %.17g, should be %.17g, within %.3g\n", (long)row, (long)column,
                    value, AT(r->Z, i, j), AT(r->bound, i, j));
        fail();
    }
}

static sl_inverse_method diagonal(const factored_t *y, double *out, const sl_int *rows,
                                  sl_int count, sl_work *W) {
    sl_stats stats;
    memset(&stats, 0, sizeof stats);
    SL_CHECK(sl_inverse_diagonal(y->F, out, rows, count, W, &stats));
    assert_true(stats.plan.b_entries == 0 && stats.selected.columns == 0); /* unchanged */
    assert_true((stats.inverse.method == SL_INVERSE_FORWARD) == (stats.inverse.entries > 0));
    assert_true((stats.inverse.method == SL_INVERSE_NONE) == (stats.inverse.columns == 0));
    return stats.inverse.method;
}

/* All rows, by NULL or by a list, and some rows, with either method. The traversal gives the bits
 * of the selected inverse. */
static void the_diagonal_equals_the_dense_inverse(void **state) {
    (void)state;
    static const sl_int sizes[5] = {1, 9, 30, 77, 150};
    variant_list_t variants = variants_present();
    uint64_t seed = 11;
    for (int kind = GEN_ONE; kind < GEN_REGULAR; kind++) {
        for (int size = 0; size < 5; size++) {
            for (int k = 0; k < variants.count; k++) {
                sl_options opt = options_none();
                options_set_variant(&opt, &variants, k);
                opt.ordering = (size + k) % 4 == 1 ? SL_ORDERING_NATURAL : SL_ORDERING_ND;
                factored_t y = factored_make((gen_kind_t)kind, sizes[size], (size + k) % 3 - 1,
                                             (size + k) % GEN_STYLES, &opt);
                reference_t r = reference_make(&y.M.view, y.F);
                sl_int n = y.M.view.n_cols, *rows = test_ints((size_t)(3 * n));
                double *all = test_reals((size_t)n), *kept = test_reals((size_t)n),
                       *some = test_reals((size_t)(3 * n));
                sl_selected *Z = NULL;
                sl_work *W = NULL;
                SL_CHECK(sl_work_create(&W, NULL));
                assert_int_equal(diagonal(&y, all, NULL, SL_ALL, W), SL_INVERSE_SELECTED);
                SL_CHECK(sl_selected_create(&Z, y.F, NULL, SL_ALL, NULL, NULL));
                SL_CHECK(sl_selected_entries(Z, kept, NULL, NULL, SL_ALL, NULL));
                SAME_VALUES(all, kept, (size_t)n);
                for (sl_int count = 1; count <= 3 * n; count = 2 * count + 1) {
                    random_rows(rows, count, n, &seed);
                    sl_inverse_method method = diagonal(&y, some, rows, count, W);
                    assert_true(count > 1 || method == SL_INVERSE_FORWARD);
                    for (sl_int i = 0; i < count; i++) {
                        assert_near(&y, &r, rows[i], rows[i], some[i]);
                        assert_true(method == SL_INVERSE_FORWARD || some[i] == kept[rows[i]]);
                    }
                }
                sl_work_free(W);
                sl_selected_free(Z);
                reference_free(&r);
                factored_free(&y);
                free(rows);
                free(all);
                free(kept);
                free(some);
            }
        }
    }
}

/* Forward sweeps for a few rows; for many, a traversal of only their reach. */
static void the_cheaper_method_is_chosen(void **state) {
    (void)state;
    isa_list_t isas = isas_present();
    for (int k = 0; k < isas.count; k++) {
        sl_options opt = options_none();
        opt.isa = isas.isa[k];
        factored_t y = factored_make(GEN_GRID2, 4900, 1, 0, &opt);
        sl_symbolic_arrays v = sl_symbolic_view(y.S);
        sl_int n = v.n, half = n / 2, reached = 0, *rows = test_ints((size_t)n);
        double *out = test_reals((size_t)n), *all = test_reals((size_t)n);
        char *mark = (char *)test_array((size_t)v.n_supers, 1);
        sl_stats stats;
        assert_int_equal(diagonal(&y, all, NULL, SL_ALL, NULL), SL_INVERSE_SELECTED);
        for (sl_int i = 0; i < n; i++) {
            rows[i] = n - 1 - i;
        }
        for (sl_int count = 1; count <= 16; count *= 4) {
            assert_int_equal(diagonal(&y, out, rows, count, NULL), SL_INVERSE_FORWARD);
        }
        assert_int_equal(diagonal(&y, out, rows, n, NULL), SL_INVERSE_SELECTED);
        for (sl_int i = 0; i < n; i++) {
            assert_true(out[i] == all[rows[i]]);
        }
        memset(&stats, 0, sizeof stats);
        SL_CHECK(sl_inverse_diagonal(y.F, out, rows, half, NULL, &stats));
        assert_int_equal(stats.inverse.method, SL_INVERSE_SELECTED);
        for (sl_int i = 0; i < half; i++) {
            assert_true(out[i] == all[rows[i]]);
            for (sl_int s = v.super_of[v.iperm[rows[i]]]; s != -1; s = v.super_parent[s]) {
                reached += !mark[s];
                mark[s] = 1;
            }
        }
        assert_int_equal(stats.inverse.supernodes, reached);
        assert_true(reached < v.n_supers);
        free(rows);
        free(out);
        free(all);
        free(mark);
        factored_free(&y);
    }
}

/* In a wide supernode, the groups of columns before the first requested one are left out: the
 * others have the same bits. Repetitions make the traversal the cheaper method for some of these
 * lists. */
static void leading_columns_of_a_supernode_are_skipped(void **state) {
    (void)state;
    enum { TIMES = 2560 };
    isa_list_t isas = isas_present();
    for (int k = 0; k < isas.count; k++) {
        for (int kind = 0; kind < 2; kind++) {
            sl_options opt = options_none();
            int calls = 0, traversals = 0;
            opt.isa = isas.isa[k];
            opt.method = SL_METHOD_SUPERNODAL;
            opt.ordering = kind ? SL_ORDERING_ND : SL_ORDERING_NATURAL;
            opt.threads.count = 1 + kind;
            opt.threads.run = run_threads;
            opt.threads.context = &calls;
            factored_t y =
                factored_make(kind ? GEN_GRID3 : GEN_DENSE, kind ? 3375 : 300, 1, 0, &opt);
            sl_symbolic_arrays v = sl_symbolic_view(y.S);
            sl_int n = v.n, root = v.n_supers - 1, width = n - v.super_first[root];
            sl_int *rows = test_ints((size_t)(width * TIMES));
            double *all = test_reals((size_t)n), *out = test_reals((size_t)(width * TIMES));
            assert_true(width > 128);
            assert_int_equal(diagonal(&y, all, NULL, SL_ALL, NULL), SL_INVERSE_SELECTED);
            for (sl_int late = 1; late < width; late += late / 2 + 1) {
                for (sl_int i = 0; i < late * TIMES; i++) {
                    rows[i] = v.perm[n - late + i % late];
                }
                if (diagonal(&y, out, rows, late * TIMES, NULL) == SL_INVERSE_FORWARD) {
                    continue;
                }
                traversals += late < width - 128;
                for (sl_int i = 0; i < late * TIMES; i++) {
                    assert_true(out[i] == all[rows[i]]);
                }
            }
            /* scalar kernels: the traversal may never be the cheaper method */
            assert_true(traversals > 0 || opt.isa == SL_ISA_SCALAR);
            free(rows);
            free(all);
            free(out);
            factored_free(&y);
        }
    }
}

/* All entries of the pattern of A, in either triangle, by a traversal; with one entry that L does
 * not store, by sweeps. */
static void pairs_in_the_pattern_equal_the_selected_inverse(void **state) {
    (void)state;
    isa_list_t isas = isas_present();
    for (int k = 0; k < isas.count; k++) {
        sl_options opt = options_none();
        opt.isa = isas.isa[k];
        factored_t y = factored_make(GEN_GRID2, 900, 1, 0, &opt);
        sl_int n = y.M.view.n_cols, count = y.M.p[n], p;
        sl_int *rows = test_ints((size_t)count + 1), *columns = test_ints((size_t)count + 1);
        double *out = test_reals((size_t)count + 1), *kept = test_reals((size_t)count + 1);
        sl_selected *Z = NULL;
        sl_stats stats;
        memset(&stats, 0, sizeof stats);
        for (sl_int j = 0; j < n; j++) {
            for (p = y.M.p[j]; p < y.M.p[j + 1]; p++) {
                rows[p] = p % 2 ? j : y.M.i[p];
                columns[p] = p % 2 ? y.M.i[p] : j;
            }
        }
        SL_CHECK(sl_selected_create(&Z, y.F, NULL, SL_ALL, NULL, NULL));
        SL_CHECK(sl_selected_entries(Z, kept, rows, columns, count, NULL));
        SL_CHECK(sl_inverse_pairs(y.F, out, rows, columns, count, NULL, &stats));
        assert_int_equal(stats.inverse.method, SL_INVERSE_SELECTED);
        SAME_VALUES(out, kept, (size_t)count);
        for (sl_int j = 1; j < n; j++) { /* the first entry of column 0 that L does not store */
            sl_status status = sl_selected_entries(Z, kept + count, &j, rows, 1, NULL);
            if (status != SL_OK) {
                SL_EXPECT(SL_ERR_OTHER_PATTERN, status);
                rows[count] = j;
                columns[count] = rows[0];
                break;
            }
        }
        SL_CHECK(sl_inverse_pairs(y.F, out, rows, columns, count + 1, NULL, &stats));
        assert_int_equal(stats.inverse.method, SL_INVERSE_FORWARD);
        double largest = 0;
        for (p = 0; p < count; p++) {
            largest = fmax(largest, fabs(kept[p]));
        }
        for (p = 0; p < count; p++) { /* the diagonal dominates, so the condition is small */
            assert_true(fabs(out[p] - kept[p]) <= 64.0 * (double)n * DBL_EPSILON * largest);
        }
        sl_selected_free(Z);
        free(rows);
        free(columns);
        free(out);
        free(kept);
        factored_free(&y);
    }
}

/* ---- memory ---- */

static void every_allocation_may_fail(void **state) {
    (void)state;
    for (int is_full = 0; is_full < 2; is_full++) {
        for (sl_int threads = 1; threads <= 3; threads++) {
            counter_t counter = counter_make();
            sl_options opt = options_counted(&counter);
            int calls = 0;
            opt.threads.count = threads;
            opt.threads.run = run_backwards;
            opt.threads.context = &calls;
            opt.method = SL_METHOD_SUPERNODAL;
            factored_t y = factored_make(GEN_GRID2, 2500, 1, 0, &opt);
            sl_int n = y.M.view.n_cols, *rows = test_ints((size_t)n);
            double *out = test_reals((size_t)n);
            for (sl_int i = 0; i < n; i++) {
                rows[i] = i;
            }
            for (int own = 0; own < 2; own++) {
                sl_status status = SL_ERR_MEMORY;
                int failures = 0;
                sl_work *W = NULL;
                for (int64_t k = 0; status != SL_OK; k++) {
                    sl_work_free(W);
                    W = NULL;
                    if (!own) {
                        SL_CHECK(sl_work_create(&W, FOR_OTHERS(&opt)));
                    }
                    out[7] = 4321.5;
                    counter.fail_at = (int64_t)counter.calls + k;
                    status = sl_inverse_diagonal(y.F, out, is_full ? NULL : rows, n, W, NULL);
                    counter.fail_at = -1;
                    assert_true(status == SL_OK || status == SL_ERR_MEMORY);
                    assert_true((status == SL_OK) == (out[7] != 4321.5));
                    failures += status != SL_OK;
                }
                assert_in_range(failures, 1, 4);
                if (W) {
                    size_t grown = counter.calls, bytes = sl_work_bytes(W);
                    for (int round = 0; round < 3; round++) {
                        SL_CHECK(sl_inverse_diagonal(y.F, out, is_full ? NULL : rows, n, W, NULL));
                    }
                    assert_int_equal(counter.calls, grown);
                    assert_int_equal(sl_work_bytes(W), bytes);
                }
                sl_work_free(W);
            }
            free(rows);
            free(out);
            factored_free(&y);
            COUNTER_CLEAN(&counter);
        }
    }
}

/* ---- singular matrices ---- */

/* With null pivots skipped, Z is the inverse of the matrix without the null rows and columns, and 0
 * in those. It is a generalized inverse, A Z A = A, if the matrix has as many null vectors as null
 * pivots. */
static void null_rows_are_zero(void **state) {
    (void)state;
    variant_list_t variants = variants_present();
    gen_list_t t = gen_make(GEN_SINGULAR, 64, 1, 42);
    gen_matrix_t M = gen_store(&t, gen_style(0), 1);
    sl_int n = M.view.n_cols;
    for (int k = 0; k < variants.count; k++) {
        sl_options opt = options_none();
        factored_t y = {M, NULL, NULL};
        sl_int null_row = -1, count = 0, *rows = test_ints((size_t)n);
        double *some = test_reals((size_t)n), *all = test_reals((size_t)n);
        options_set_variant(&opt, &variants, k);
        opt.pivots = SL_PIVOTS_SKIP_NULL;
        SL_CHECK(sl_symbolic_create(&y.S, &M.view, FOR_ANALYSIS(&opt), NULL));
        SL_CHECK(sl_factor_create(&y.F, y.S, &M.view, FOR_FACTOR(&opt), NULL));
        SL_CHECK(sl_factor_pivot_rows(y.F, SL_PIVOT_NULL, &null_row, NULL, 1, &count));
        assert_int_equal(count, 1);
        double *G = ref_dense(&M.view);
        for (sl_int i = 0; i < n; i++) {
            AT(G, i, null_row) = AT(G, null_row, i) = i == null_row;
            rows[i] = i;
        }
        double *Z = ref_inverse(n, G), largest = 0;
        AT(Z, null_row, null_row) = 0;
        for (sl_int i = 0; i < n; i++) {
            largest = fmax(largest, AT(Z, i, i));
        }
        assert_int_equal(diagonal(&y, all, NULL, SL_ALL, NULL), SL_INVERSE_SELECTED);
        for (sl_int i = 0; i < n; i++) {
            const double allowed = 100 * (double)n * DBL_EPSILON * largest;
            assert_int_equal(diagonal(&y, some + i, rows + i, 1, NULL), SL_INVERSE_FORWARD);
            assert_true(fabs(all[i] - AT(Z, i, i)) <= allowed);
            assert_true(fabs(some[i] - AT(Z, i, i)) <= allowed);
        }
        assert_true(all[null_row] == 0.0 && some[null_row] == 0.0);
        sl_factor_free(y.F);
        sl_symbolic_free(y.S);
        free(rows);
        free(some);
        free(all);
        free(G);
        free(Z);
    }
    gen_matrix_free(&M);
    gen_list_free(&t);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_diagonal_equals_the_dense_inverse),
        cmocka_unit_test(the_cheaper_method_is_chosen),
        cmocka_unit_test(leading_columns_of_a_supernode_are_skipped),
        cmocka_unit_test(pairs_in_the_pattern_equal_the_selected_inverse),
        cmocka_unit_test(every_allocation_may_fail),
        cmocka_unit_test(null_rows_are_zero),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

/* test_selected.c: the selected inverse, whole and on a reach, against dense inverses */
#include "tests/lib/check_inverse.h"

/* The public queries return the values of the panels. */
static void assert_queries_match_panels(const sl_selected *Z) {
    sl_selected_arrays z = sl_selected_view(Z);
    sl_symbolic_arrays v = sl_symbolic_view(z.symbolic);
    for (sl_int k = 0; k < z.count; k++) {
        sl_int s = z.supers[k], width = ref_width(&v, s), height = ref_height(&v, s);
        for (sl_int c = 0; c < width; c++) {
            for (sl_int q = c; q < height; q++) {
                double value = z.Z[z.begin[k] + ref_position(width, q, c)], got[2];
                sl_int i = v.perm[ref_row(&v, s, q)], j = v.perm[v.super_first[s] + c];
                sl_int rows[2] = {i, j}, columns[2] = {j, i};
                SL_CHECK(sl_selected_entries(Z, got, rows, columns, 2, NULL));
                assert_true(got[0] == value && got[1] == value);
                if (i == j) {
                    SL_CHECK(sl_selected_entries(Z, got, rows, NULL, 2, NULL));
                    assert_true(got[0] == value && got[1] == value);
                }
            }
        }
    }
}

static void entries_match_the_dense_inverse(void **state) {
    (void)state;
    static const sl_int sizes[5] = {2, 9, 30, 77, 150};
    variant_list_t variants = variants_present();
    for (int kind = 0; kind < GEN_REGULAR; kind++) {
        for (int size = 0; size < 5; size++) {
            for (int k = 0; k < variants.count; k++) {
                sl_options opt = options_none();
                options_set_variant(&opt, &variants, k);
                opt.relaxation =
                    (kind + size + k) % 3 == 0 ? SL_RELAXATION_NONE : SL_RELAXATION_DEFAULT;
                opt.ordering = (size + k) % 4 == 1 ? SL_ORDERING_NATURAL : SL_ORDERING_ND;
                factored_t y = factored_make((gen_kind_t)kind, sizes[size], (size + k) % 3 - 1,
                                             (size + k) % GEN_STYLES, &opt);
                reference_t r = reference_make(&y.M.view, y.F);
                sl_selected *Z = NULL;
                sl_stats stats;
                memset(&stats, 0, sizeof stats);
                SL_CHECK(sl_selected_create(&Z, y.F, NULL, SL_ALL, NULL, &stats));
                const char *wrong = check_selected(Z, &r);
                if (wrong) {
                    print_error("%s, n = %d, isa %d: %s\n", gen_name((gen_kind_t)kind),
                                (int)y.M.view.n_cols, (int)opt.isa, wrong);
                    fail();
                }
                assert_int_equal(stats.selected.columns, y.M.view.n_cols);
                assert_int_equal(stats.selected.supernodes, sl_symbolic_view(y.S).n_supers);
                assert_true(stats.selected.entries == panel_doubles(y.F));
                if (sizes[size] == 30) {
                    assert_queries_match_panels(Z);
                }
                sl_selected_free(Z);
                reference_free(&r);
                factored_free(&y);
            }
        }
    }
}

/* Wide supernodes: several groups of columns, the last one of any width, and several chunks of rows
 * below. */
static void wide_supernodes_match_the_dense_inverse(void **state) {
    (void)state;
    isa_list_t isas = isas_present();
    for (sl_int n = 120; n < 330; n += 23) {
        for (int k = 0; k < isas.count; k++) {
            sl_options opt = options_none();
            opt.isa = isas.isa[k];
            opt.ordering = SL_ORDERING_NATURAL;
            factored_t y = factored_make(n % 2 ? GEN_DENSE : GEN_GRID3, n, 1, 0, &opt);
            reference_t r = reference_make(&y.M.view, y.F);
            sl_selected *Z = NULL;
            SL_CHECK(sl_selected_create(&Z, y.F, NULL, SL_ALL, FOR_OTHERS(&opt), NULL));
            NOTHING_WRONG(check_selected(Z, &r));
            sl_selected_free(Z);
            reference_free(&r);
            factored_free(&y);
        }
    }
}

/* On a grid too large for a dense inverse: columns of the inverse by full solves, compared where
 * the pattern has an entry. */
static void entries_match_full_solves(void **state) {
    (void)state;
    isa_list_t isas = isas_present();
    for (int k = 0; k < isas.count; k++) {
        sl_options opt = options_none();
        opt.isa = isas.isa[k];
        factored_t y = factored_make(GEN_GRID2, 10000, 1, 0, &opt);
        sl_int n = y.M.view.n_cols;
        double *b = test_reals((size_t)n), *x = test_reals((size_t)n),
               *diagonal = test_reals((size_t)n);
        sl_selected *Z = NULL;
        uint64_t seed = 5;
        SL_CHECK(sl_selected_create(&Z, y.F, NULL, SL_ALL, NULL, NULL));
        SL_CHECK(sl_selected_entries(Z, diagonal, NULL, NULL, SL_ALL, NULL));
        for (int times = 0; times < 60; times++) {
            sl_int j = gen_below(&seed, n);
            double largest = 0.0;
            b[j] = 1.0;
            SL_CHECK(sl_factor_solve(y.F, x, (size_t)n, b, (size_t)n, 1, NULL));
            b[j] = 0.0;
            for (sl_int i = 0; i < n; i++) {
                largest = fmax(largest, fabs(x[i]));
            }
            /* The matrix is diagonally dominant, so no condition number enters. */
            double allowed = 64.0 * (double)n * DBL_EPSILON * largest;
            assert_true(fabs(diagonal[j] - x[j]) <= allowed);
            /* The pattern of A is part of the pattern of L. */
            for (sl_int p = y.M.p[j]; p < y.M.p[j + 1]; p++) {
                double z;
                SL_CHECK(sl_selected_entries(Z, &z, &y.M.i[p], &j, 1, NULL));
                assert_true(fabs(z - x[y.M.i[p]]) <= allowed);
            }
        }
        sl_selected_free(Z);
        free(b);
        free(x);
        free(diagonal);
        factored_free(&y);
    }
}

static void a_set_gives_the_same_bits(void **state) {
    (void)state;
    static const sl_int sizes[3] = {12, 100, 700};
    isa_list_t isas = isas_present();
    uint64_t seed = 3;
    for (int kind = 0; kind < GEN_REGULAR; kind++) {
        for (int size = 0; size < 3; size++) {
            sl_options opt = options_none();
            opt.isa = isas.isa[(kind + size) % isas.count];
            factored_t y = factored_make((gen_kind_t)kind, sizes[size], 1, 0, &opt);
            sl_symbolic_arrays v = sl_symbolic_view(y.S);
            sl_int n = v.n, *set = test_ints((size_t)n + 2);
            sl_selected *all = NULL;
            SL_CHECK(sl_selected_create(&all, y.F, NULL, SL_ALL, NULL, NULL));
            for (sl_int count = 0; count <= n; count = 3 * count + 1) {
                char *mark = (char *)test_array((size_t)v.n_supers, 1);
                sl_selected *some = (sl_selected *)(void *)&seed;
                sl_stats stats;
                sl_int reached = 0, columns = 0;
                memset(&stats, 0, sizeof stats);
                gen_set(set, count, n, gen_bits(&seed));
                for (sl_int k = 0; k < count; k++) {
                    for (sl_int s = v.super_of[v.iperm[set[k]]]; s != -1; s = v.super_parent[s]) {
                        mark[s] = 1;
                    }
                }
                /* The set may hold a row twice. */
                sl_int twice = count > 0 ? count + 1 : 0;
                set[count] = set[0];
                SL_CHECK(sl_selected_create(&some, y.F, set, twice, NULL, &stats));
                sl_selected_arrays z = sl_selected_view(some), whole = sl_selected_view(all);
                for (sl_int s = 0; s < v.n_supers; s++) {
                    if (mark[s]) {
                        assert_true(reached < z.count && z.supers[reached] == s);
                        size_t bytes =
                            (size_t)(z.begin[reached + 1] - z.begin[reached]) * sizeof(double);
                        assert_memory_equal(z.Z + z.begin[reached], whole.Z + whole.begin[s],
                                            bytes);
                        reached++;
                        columns += ref_width(&v, s);
                    }
                }
                assert_int_equal(z.count, reached);
                assert_int_equal(stats.selected.supernodes, reached);
                assert_int_equal(stats.selected.columns, columns);
                for (sl_int i = 0; i < n; i++) {
                    double d = 7.0, e;
                    sl_status wanted = mark[v.super_of[v.iperm[i]]] ? SL_OK : SL_ERR_OTHER_PATTERN;
                    SL_EXPECT(wanted, sl_selected_entries(some, &d, &i, NULL, 1, &stats));
                    SL_CHECK(sl_selected_entries(all, &e, &i, NULL, 1, NULL));
                    assert_int_equal(stats.error.row, wanted == SL_OK ? -1 : i);
                    assert_true(d == (wanted == SL_OK ? e : 7.0));
                }
                sl_selected_free(some);
                free(mark);
            }
            sl_selected_free(all);
            free(set);
            factored_free(&y);
        }
    }
}

/* A test of check_selected: an error in the middle of the mantissa of any entry is detected. */
static void a_wrong_entry_is_detected(void **state) {
    (void)state;
    factored_t y = factored_make(GEN_GRID2, 49, 1, 0, NULL);
    reference_t r = reference_make(&y.M.view, y.F);
    sl_selected *Z = NULL;
    SL_CHECK(sl_selected_create(&Z, y.F, NULL, SL_ALL, NULL, NULL));
    sl_selected_arrays z = sl_selected_view(Z);
    sl_symbolic_arrays v = sl_symbolic_view(y.S);
    double *numbers = (double *)(uintptr_t)z.Z;
    NOTHING_WRONG(check_selected(Z, &r));
    for (sl_int s = 0; s < v.n_supers; s++) {
        sl_int width = ref_width(&v, s);
        for (sl_int c = 0; c < width; c++) {
            for (sl_int q = c; q < (ref_height(&v, s) + 7) / 8 * 8; q++) {
                double *at = numbers + z.begin[s] + ref_position(width, q, c), keep = *at;
                *at += 1e-10 * (1.0 + fabs(keep));
                assert_non_null(check_selected(Z, &r));
                *at = keep;
            }
        }
    }
    sl_selected_free(Z);
    reference_free(&r);
    factored_free(&y);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(entries_match_the_dense_inverse),
        cmocka_unit_test(wide_supernodes_match_the_dense_inverse),
        cmocka_unit_test(entries_match_full_solves),
        cmocka_unit_test(a_set_gives_the_same_bits),
        cmocka_unit_test(a_wrong_entry_is_detected),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

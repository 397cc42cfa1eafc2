/* test_inverse.c: entries and blocks of the inverse against dense inverses */
#include "tests/lib/check_inverse.h"

/* Error bound of an entry: |z - Z(i,j)| <= c n eps times a norm of the inverse around it. For a
 * definite matrix this is sqrt(|Z(i,i) Z(j,j)|), which bounds the terms y(k) z(k) / d(k); otherwise
 * it is the largest entry. c = 100: PASS_C as for a solve, times 10 for the condition of the
 * generated matrices, whose rows are scaled. */
static double allowed(sl_int n, const double *Z, sl_int i, sl_int j, int is_definite) {
    double largest = 0;
    for (sl_int k = 0; !is_definite && k < n * n; k++) {
        largest = fabs(Z[k]) > largest ? fabs(Z[k]) : largest;
    }
    return 10 * pass_figure(n) *
           (is_definite ? sqrt(fabs(AT(Z, i, i)) * fabs(AT(Z, j, j))) : largest);
}

#define IS_NEAR(n, Z, i, j, is_definite, value) \
    do { \
        double error_ = fabs((value)-AT(Z, i, j)), \
               allowed_ = allowed((n), (Z), (i), (j), (is_definite)); \
        if (!(error_ <= allowed_)) { \
            print_error("(%ld, %ld): %.17g, should be %.17g; error %.3g, allowed %.3g\n", \
                        (long)(i), (long)(j), (value), AT(Z, i, j), error_, allowed_); \
            fail(); \
        } \
    } while (0)

/* Every call on random rows, unsorted and repeated: 0 .. 20 rows, and more than one group of a
 * block holds. */
static void check_all_calls(const sl_factor *F, sl_int n, const double *Z, int definite,
                            sl_int count, uint64_t *seed, sl_work *W) {
    sl_int *rows = test_ints((size_t)count), *columns = test_ints((size_t)count),
           nc = count / 2 + 1;
    size_t ldz = (size_t)count + 1;
    double *out = test_reals((size_t)count + 1), *block = test_reals(ldz * (size_t)(count + 1));
    random_rows(rows, count, n, seed);
    random_rows(columns, count, n, seed);
    for (size_t k = 0; k < ldz * (size_t)(count + 1); k++) {
        block[k] = 4321.5;
    }
    out[count] = 4321.5;
    SL_CHECK(sl_inverse_diagonal(F, out, rows, count, W, NULL));
    for (sl_int k = 0; k < count; k++) {
        IS_NEAR(n, Z, rows[k], rows[k], definite, out[k]);
    }
    SL_CHECK(sl_inverse_pairs(F, out, rows, columns, count, W, NULL));
    for (sl_int k = 0; k < count; k++) {
        IS_NEAR(n, Z, rows[k], columns[k], definite, out[k]);
    }
    /* rows and columns exchanged */
    SL_CHECK(sl_inverse_pairs(F, out, columns, rows, count, W, NULL));
    for (sl_int k = 0; k < count; k++) {
        IS_NEAR(n, Z, rows[k], columns[k], definite, out[k]);
    }
    assert_true(out[count] == 4321.5);
    /* tall, wide and symmetric blocks of overlapping sets */
    for (int shape = 0; shape < 3 && nc <= count; shape++) {
        const sl_int *r = rows, *c = shape == 2 ? rows : columns;
        sl_int nr = shape == 1 ? nc : count, nb = shape == 0 ? nc : count;
        if (shape < 2) {
            columns[0] = rows[0];
        }
        SL_CHECK(sl_inverse_block(F, block, ldz, r, nr, c, nb, W, NULL));
        for (sl_int j = 0; j < nb; j++) {
            for (sl_int i = 0; i < nr; i++) {
                double z = block[(size_t)i + ldz * (size_t)j];
                IS_NEAR(n, Z, r[i], c[j], definite, z);
                if (shape == 2) {
                    assert_true(z == block[(size_t)j + ldz * (size_t)i]);
                }
            }
            assert_true(block[(size_t)count + ldz * (size_t)j] == 4321.5);
        }
        assert_true(block[ldz * (size_t)count] == 4321.5);
    }
    free(rows);
    free(columns);
    free(out);
    free(block);
}

static void entries_equal_dense_inverses(void **state) {
    (void)state;
    isa_list_t isas = isas_present();
    uint64_t seed = 5;
    for (int kind = GEN_ONE; kind < GEN_REGULAR; kind++) {
        for (int which = 0; which < isas.count; which++) {
            for (int round = 0; round < 2; round++) {
                sl_options opt = options_none();
                sl_work *W = NULL;
                opt.isa = isas.isa[which];
                opt.ordering = round ? SL_ORDERING_NATURAL : SL_ORDERING_ND;
                factored_t y = factored_make((gen_kind_t)kind, 60, round ? -1 : 1, 0, &opt);
                sl_int n = y.M.view.n_cols;
                int definite = kind != GEN_KKT;
                double *M = ref_dense(&y.M.view), *Z = ref_scaled_inverse(n, M),
                       *all = test_reals((size_t)n);
                SL_CHECK(sl_work_create(&W, NULL));
                for (sl_int count = 0; count <= 20; count++) {
                    check_all_calls(y.F, n, Z, definite, count, &seed, count % 3 ? W : NULL);
                }
                check_all_calls(y.F, n, Z, definite, 150, &seed, W);
                SL_CHECK(sl_inverse_diagonal(y.F, all, NULL, SL_ALL, W,
                                             NULL)); /* all rows; count is not read */
                for (sl_int k = 0; k < n; k++) {
                    IS_NEAR(n, Z, k, k, definite, all[k]);
                }
                sl_work_free(W);
                factored_free(&y);
                free(M);
                free(Z);
                free(all);
            }
        }
    }
}

/* Against full solves where paths have many supernodes; blocks with more groups than are kept at a
 * time. */
static void entries_equal_full_solves_on_a_larger_grid(void **state) {
    (void)state;
    enum { COUNT = 300 };
    factored_t y = factored_make(GEN_GRID2, 10000, 1, 0, NULL);
    sl_int n = y.M.view.n_cols, rows[COUNT], columns[COUNT];
    double *X = test_reals((size_t)n * 12), *Z = test_reals(COUNT * COUNT),
           *S = test_reals(COUNT * COUNT);
    double *pairs = test_reals(COUNT), *swapped = test_reals(COUNT), *diagonal = test_reals(COUNT);
    double largest = 0;
    uint64_t seed = 3;
    sl_stats stats;
    memset(&stats, 0, sizeof stats);
    random_rows(rows, COUNT, n, &seed);
    random_rows(columns, COUNT, n, &seed);
    for (int k = 0; k < 12; k++) {
        X[(size_t)k * (size_t)n + (size_t)columns[25 * k]] = 1;
    }
    SL_CHECK(sl_factor_solve(y.F, X, (size_t)n, X, (size_t)n, 12, NULL));
    for (int k = 0; k < 12; k++) {
        rows[25 * k + 1] = columns[25 * k]; /* the largest entries */
    }
    SL_CHECK(sl_inverse_block(y.F, Z, COUNT, rows, COUNT, columns, COUNT, NULL, &stats));
    assert_int_equal(stats.inverse.method, SL_INVERSE_FORWARD);
    assert_true(stats.inverse.entries > 0 && stats.inverse.columns > 0);
    SL_CHECK(sl_inverse_block(y.F, S, COUNT, rows, COUNT, rows, COUNT, NULL, NULL));
    SL_CHECK(sl_inverse_pairs(y.F, pairs, rows, columns, COUNT, NULL, NULL));
    SL_CHECK(sl_inverse_pairs(y.F, swapped, columns, rows, COUNT, NULL, NULL));
    SL_CHECK(sl_inverse_diagonal(y.F, diagonal, rows, COUNT, NULL, NULL));
    for (size_t k = 0; k < 12 * (size_t)n; k++) {
        largest = fabs(X[k]) > largest ? fabs(X[k]) : largest;
    }
    const double bound = 1000 * DBL_EPSILON * largest; /* tree height times a small factor */
    for (int k = 0; k < 12; k++) {
        for (int i = 0; i < COUNT; i++) {
            assert_true(fabs(Z[i + COUNT * 25 * k] - X[(size_t)k * (size_t)n + (size_t)rows[i]]) <=
                        bound);
        }
        assert_true(fabs(pairs[25 * k] - X[(size_t)k * (size_t)n + (size_t)rows[25 * k]]) <= bound);
    }
    for (int k = 0; k < COUNT; k++) {
        assert_true(fabs(pairs[k] - Z[k + COUNT * k]) <= bound);
        assert_true(fabs(pairs[k] - swapped[k]) <= bound);
        assert_true(fabs(diagonal[k] - S[k + COUNT * k]) <= bound);
        for (int i = 0; i < COUNT; i++) {
            assert_true(S[i + COUNT * k] == S[k + COUNT * i]);
        }
    }
    free(X);
    free(Z);
    free(S);
    free(pairs);
    free(swapped);
    free(diagonal);
    factored_free(&y);
}

/* Single pairs, near and far, in one tree and in several: by sweeps or by a local solve. */
static void single_pairs(void **state) {
    (void)state;
    static const gen_kind_t kinds[3] = {GEN_GRID2, GEN_FOREST, GEN_KKT};
    for (int kind = 0; kind < 3; kind++) {
        factored_t y = factored_make(kinds[kind], 144, 1, 0, NULL);
        const sl_int n = y.M.view.n_cols;
        double *b = test_reals((size_t)n), *x = test_reals((size_t)n);
        int local = 0, swept = 0;
        for (sl_int i = 0; i < n; i += 7) {
            memset(b, 0, (size_t)n * sizeof *b);
            b[i] = 1.0;
            SL_CHECK(sl_factor_solve(y.F, x, (size_t)n, b, (size_t)n, 1, NULL));
            for (sl_int j = 0; j < n; j++) {
                double z = NAN;
                sl_stats pair, plan;
                SL_CHECK(sl_inverse_pairs(y.F, &z, &j, &i, 1, NULL, &pair));
                SL_CHECK(sl_local_solve(y.F, &i, 1, &j, 1, b, 1, &z, 1, 0, NULL, &plan));
                assert_true(fabs(z - x[j]) <= 1e-13 * fabs(x[j]) + 1e-15);
                assert_int_equal(pair.inverse.method, SL_INVERSE_FORWARD);
                if (i != j && pair.inverse.entries == plan.plan.b_entries + plan.plan.x_entries) {
                    local++;
                } else {
                    swept++;
                }
            }
        }
        assert_true(local > 100 && swept > 40);
        free(b);
        free(x);
        factored_free(&y);
    }
    factored_t y = factored_make(GEN_GRID2, 100, 1, 0, NULL);
    const sl_int row = 3, beyond = 100;
    double z = 7.0;
    sl_stats stats;
    SL_EXPECT(SL_ERR_ARGUMENT, sl_inverse_pairs(y.F, &z, &row, &beyond, 1, NULL, &stats));
    assert_int_equal(stats.error.column, 100);
    assert_true(z == 7.0);
    factored_free(&y);
}

/* Entries of one row or column, as pairs or as a block, are those of a local solve. */
static void entries_of_one_column(void **state) {
    (void)state;
    static const gen_kind_t kinds[3] = {GEN_GRID2, GEN_FOREST, GEN_KKT};
    enum { MOST = 20, LD = 3 };
    for (int kind = 0; kind < 3; kind++) {
        factored_t y = factored_make(kinds[kind], 144, 1, 0, NULL);
        const sl_int n = y.M.view.n_cols;
        const double one = 1.0;
        uint64_t seed = 5;
        for (sl_int column = 0; column < n; column += 7) {
            for (sl_int count = 2; count <= MOST; count += 3) {
                sl_int rows[MOST], same[MOST];
                double x[MOST], z[4][MOST], wide[LD * MOST];
                sl_stats stats, plan;
                random_rows(rows, count, n, &seed);
                rows[0] = column; /* of the diagonal */
                for (sl_int k = 0; k < count; k++) {
                    same[k] = column;
                }
                for (sl_int k = 0; k < LD * MOST; k++) {
                    wide[k] = 4321.5;
                }
                rows[1] += rows[1] == column ? column == 0 ? 1 : -1 : 0;
                SL_CHECK(
                    sl_local_solve(y.F, &column, 1, rows, count, x, MOST, &one, 1, 1, NULL, &plan));
                SL_CHECK(sl_inverse_pairs(y.F, z[0], rows, same, count, NULL, &stats));
                assert_int_equal(stats.inverse.method, SL_INVERSE_FORWARD);
                assert_int_equal(stats.inverse.entries, plan.plan.b_entries + plan.plan.x_entries);
                SL_CHECK(sl_inverse_pairs(y.F, z[1], same, rows, count, NULL, NULL));
                SL_CHECK(sl_inverse_block(y.F, z[2], MOST, rows, count, &column, 1, NULL, &stats));
                assert_int_equal(stats.inverse.entries, plan.plan.b_entries + plan.plan.x_entries);
                SL_CHECK(sl_inverse_block(y.F, wide, LD, &column, 1, rows, count, NULL, NULL));
                for (sl_int k = 0; k < LD * MOST; k++) {
                    if (k % LD == 0 && k < LD * count) {
                        z[3][k / LD] = wide[k];
                    } else {
                        assert_true(wide[k] == 4321.5);
                    }
                }
                for (int way = 0; way < 4; way++) {
                    SAME_VALUES(z[way], x, (size_t)count);
                }
            }
        }
        const sl_int wrong[3] = {1, n, 2}, same[3] = {4, 4, 4};
        double z[3] = {7.0, 7.0, 7.0};
        sl_stats stats;
        SL_EXPECT(SL_ERR_ARGUMENT, sl_inverse_pairs(y.F, z, wrong, same, 3, NULL, &stats));
        assert_true(stats.error.row == n && stats.error.column == -1);
        SL_EXPECT(SL_ERR_ARGUMENT, sl_inverse_pairs(y.F, z, same, wrong, 3, NULL, &stats));
        assert_true(stats.error.row == -1 && stats.error.column == n);
        SL_EXPECT(SL_ERR_ARGUMENT, sl_inverse_block(y.F, z, 3, wrong, 3, same, 1, NULL, &stats));
        assert_true(stats.error.row == n && z[0] == 7.0);
        factored_free(&y);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(single_pairs),
        cmocka_unit_test(entries_of_one_column),
        cmocka_unit_test(entries_equal_dense_inverses),
        cmocka_unit_test(entries_equal_full_solves_on_a_larger_grid),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

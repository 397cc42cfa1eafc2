/* test_change.c: sl_factor_rank_update, sl_factor_change_entries: the new factor and its accuracy
 * */
#include "tests/lib/changed.h"

enum { EDGES = 24 };

/* The sizes of the changes make passes of 1, 2, 4 and 8 vectors, and several passes. */
static void changed_entries_give_the_factor_of_the_new_matrix(void **state) {
    (void)state;
    static const sl_int counts[6] = {1, 2, 3, 7, 8, EDGES};
    isa_list_t isas = isas_present();
    uint64_t seed = 5;
    for (int kind = 1; kind < GEN_REGULAR; kind++) {
        for (int k = 0; k < 6 * isas.count; k++) {
            sl_options opt = options_none();
            opt.isa = isas.isa[k % isas.count];
            opt.method = k % 4 == 3 ? SL_METHOD_UP_LOOKING : SL_METHOD_AUTO;
            changed_t c = changed_make((gen_kind_t)kind, k % 2 ? 120 : 40, 1, &opt);
            sl_int rows[3 * EDGES], columns[3 * EDGES], at = 0;
            double deltas[3 * EDGES];
            sl_stats stats;
            sl_work *W = NULL;
            SL_CHECK(sl_work_create(&W, NULL));
            for (sl_int e = 0; e < counts[k / isas.count]; e++) {
                sl_int i, j;
                random_entry(&c, &seed, &i, &j);
                at = add_edge(&c, i, j, 0.5 + 0.4 * gen_real(&seed), rows, columns, deltas, at);
            }
            sl_status status = sl_factor_change_entries(c.y.F, NULL, rows, columns, deltas, at,
                                                        k % 2 ? W : NULL, &stats);
            if (kind == GEN_KKT && status == SL_ERR_PIVOT) { /* may become singular on its way */
                sl_work_free(W);
                changed_free(&c);
                continue;
            }
            SL_CHECK(status);
            double growth = kind == GEN_SCALED || kind == GEN_KKT ? 1e4 : 1.0;
            assert_true(changed_error(&c) <= 64.0 * growth * DBL_EPSILON * (double)at);
            assert_int_equal(stats.change.method, SL_CHANGE_UPDATE);
            assert_true(stats.change.ranks >= 1 && stats.change.ranks <= at);
            assert_int_equal(stats.change.updates, stats.change.ranks);
            assert_int_equal(stats.factor.positive + stats.factor.negative, c.y.M.view.n_cols);
            sl_work_free(W);
            changed_free(&c);
        }
    }
}

/* An edge is one rank, an entry of the diagonal one, another entry up to three; edges that share
 * rows do not leave changes of the diagonal. */
static void ranks_are_as_few_as_the_edges(void **state) {
    (void)state;
    changed_t c = changed_make(GEN_GRID2, 100, 1, NULL);
    sl_int rows[32], columns[32], at = 0;
    double deltas[32];
    sl_stats stats;
    at = add_edge(&c, 3, 4, 0.3, rows, columns, deltas, at);
    at = add_edge(&c, 4, 5, 0.1, rows, columns, deltas, at);
    at = add_edge(&c, 5, 4, 0.7, rows, columns, deltas, at); /* the same edge from the other side */
    SL_CHECK(sl_factor_change_entries(c.y.F, NULL, rows, columns, deltas, at, NULL, &stats));
    assert_int_equal(stats.change.ranks, 2);
    at = add_edge(&c, 7, 7, 0.5, rows, columns, deltas, 0);
    SL_CHECK(sl_factor_change_entries(c.y.F, NULL, rows, columns, deltas, at, NULL, &stats));
    assert_int_equal(stats.change.ranks, 1);
    rows[0] = 8;
    columns[0] = 9;
    deltas[0] = 0.01;
    changed_add(&c, 8, 9, 0.01);
    SL_CHECK(sl_factor_change_entries(c.y.F, NULL, rows, columns, deltas, 1, NULL, &stats));
    assert_int_equal(stats.change.ranks, 3);
    deltas[0] = 0.0;
    SL_CHECK(sl_factor_change_entries(c.y.F, NULL, rows, columns, deltas, 1, NULL, &stats));
    assert_int_equal(stats.change.ranks, 0);
    assert_int_equal(stats.change.method, SL_CHANGE_NONE);
    SL_CHECK(sl_factor_change_entries(c.y.F, NULL, NULL, NULL, NULL, 0, NULL, &stats));
    assert_int_equal(stats.change.updates, 6);
    assert_true(changed_error(&c) <= 1e-14);
    changed_free(&c);
}

/* Vectors on a clique of L: any signs, any length, duplicates. */
static void vectors_give_the_factor_of_the_new_matrix(void **state) {
    (void)state;
    isa_list_t isas = isas_present();
    for (int k = 0; k < isas.count; k++) {
        for (int sign = -1; sign <= 1; sign += 2) {
            sl_options opt = options_none();
            opt.isa = isas.isa[k];
            changed_t c = changed_make(GEN_DENSE, 37, sign, &opt);
            sl_int p[4] = {0, 3, 40, 41}, i[41];
            double x[41], sigma[3] = {0.5 * sign, 0.01 * sign, -0.01 * sign};
            sl_csc V = {37, 3, p, i, x};
            for (sl_int m = 0; m < 37; m++) {
                i[3 + m] = m;
            }
            i[0] = i[1] = 5;
            i[2] = 9;
            i[40] = 36;
            gen_reals(x, 41, 3);
            for (int v = 0; v < 3; v++) {
                for (sl_int a = p[v]; a < p[v + 1]; a++) {
                    for (sl_int b = p[v]; b < p[v + 1]; b++) {
                        c.dense[i[a] * 37 + i[b]] += sigma[v] * x[a] * x[b];
                    }
                }
            }
            SL_CHECK(sl_factor_rank_update(c.y.F, &V, sigma, NULL, NULL));
            assert_true(changed_error(&c) <= 1e-14);
            changed_free(&c);
        }
    }
}

/* One vector through a panel of many tiles, entered at any row, with weights of both signs. */
static void one_vector_changes_a_wide_panel(void **state) {
    (void)state;
    isa_list_t isas = isas_present();
    for (int k = 0; k < isas.count; k++) {
        for (sl_int n = 61; n < 75; n++) {
            sl_options opt = options_none();
            opt.isa = isas.isa[k];
            changed_t c = changed_make(GEN_DENSE, n, n % 2 ? 1 : -1, &opt);
            const sl_int *perm = sl_symbolic_view(c.y.S).perm;
            for (sl_int first = 0; first < n; first += 7) {
                sl_int p[2] = {0, n - first}, i[75];
                double x[75], sigma = (first % 2 ? 0.5 : -0.01) * (n % 2 ? 1.0 : -1.0);
                gen_reals(x, 75, (uint64_t)first + 3);
                for (sl_int m = 0; m < n - first; m++) {
                    i[m] = perm[first + m];
                }
                for (sl_int a = 0; a < n - first; a++) {
                    for (sl_int b = 0; b < n - first; b++) {
                        c.dense[i[a] * n + i[b]] += sigma * x[a] * x[b];
                    }
                }
                sl_csc V = {n, 1, p, i, x};
                SL_CHECK(sl_factor_rank_update(c.y.F, &V, &sigma, NULL, NULL));
                assert_true(changed_error(&c) <= 1e-14);
            }
            changed_free(&c);
        }
    }
}

/* One vector after the other in a factor with pivots of both signs, whose supernodes have several
 * tiles of rows below. */
static void one_vector_changes_pivots_of_both_signs(void **state) {
    (void)state;
    isa_list_t isas = isas_present();
    for (int k = 0; k < isas.count; k++) {
        static const sl_int p[2] = {0, 1};
        sl_options opt = options_none();
        opt.isa = isas.isa[k];
        changed_t c = changed_make(GEN_GRID3, 343, 0, &opt);
        const sl_int n = c.y.M.view.n_cols, *perm = sl_symbolic_view(c.y.S).perm;
        sl_stats stats;
        for (sl_int row = 0; row < n; row += 50) {
            const double sigma = row % 20 ? 0.5 : -0.25, x = 0.5;
            const sl_csc V = {n, 1, p, &perm[row], &x};
            changed_add(&c, perm[row], perm[row], sigma * x * x);
            SL_CHECK(sl_factor_rank_update(c.y.F, &V, &sigma, NULL, &stats));
            assert_true(stats.factor.positive > 0 && stats.factor.negative > 0);
        }
        assert_true(changed_error(&c) <= 1e-14);
        changed_free(&c);
    }
}

static void an_update_and_its_downdate_return(void **state) {
    (void)state;
    isa_list_t isas = isas_present();
    uint64_t seed = 11;
    for (int k = 0; k < isas.count; k++) {
        sl_options opt = options_none();
        opt.isa = isas.isa[k];
        changed_t c = changed_make(GEN_GRID2, 400, 1, &opt);
        size_t size = (size_t)panel_doubles(c.y.F);
        double *before = test_reals(size);
        memcpy(before, sl_factor_view(c.y.F).L, size * sizeof *before);
        for (int e = 0; e < 20; e++) {
            sl_int rows[3 * EDGES], columns[3 * EDGES], at = 0;
            double deltas[3 * EDGES];
            for (int m = 0; m <= e; m++) {
                sl_int i, j;
                random_entry(&c, &seed, &i, &j);
                at = add_edge(&c, i, j, 1.0, rows, columns, deltas, at);
            }
            SL_CHECK(sl_factor_change_entries(c.y.F, NULL, rows, columns, deltas, at, NULL, NULL));
            for (sl_int m = 0; m < at; m++) {
                deltas[m] = -deltas[m];
            }
            SL_CHECK(sl_factor_change_entries(c.y.F, NULL, rows, columns, deltas, at, NULL, NULL));
        }
        for (size_t m = 0; m < size; m++) {
            assert_true(fabs(sl_factor_view(c.y.F).L[m] - before[m]) <= 1e-12);
        }
        free(before);
        changed_free(&c);
    }
}

/* 10,000 random edits, up and down, against a fresh factor: the error stays below the drift. */
static void ten_thousand_edits_stay_below_the_drift(void **state) {
    (void)state;
    changed_t c = changed_make(GEN_GRID2, 100, 1, NULL);
    sl_work *W = NULL;
    SL_CHECK(sl_work_create(&W, NULL));
    uint64_t seed = 3;
    double weight[100] = {0.0};
    sl_stats stats;
    for (int e = 0; e < 10000; e++) {
        sl_int i = gen_below(&seed, 100), j = i % 10 < 9 ? i + 1 : i - 1;
        double w = fabs(gen_real(&seed)) * (e % 7 == 0 ? 100.0 : 1.0);
        sl_int rows[3], columns[3];
        double deltas[3];
        sl_int at = add_edge(&c, i, j, w - weight[i], rows, columns, deltas, 0);
        weight[i] = w;
        SL_CHECK(sl_factor_change_entries(c.y.F, NULL, rows, columns, deltas, at, W, &stats));
    }
    assert_true(stats.change.updates > 9000 && stats.change.updates <= 10000);
    assert_true(changed_error(&c) <= stats.change.drift);
    assert_true(stats.change.drift <= 1e-10 && stats.factor.growth <= 2.0);
    SL_CHECK(sl_factor_refactor(c.y.F, &c.y.M.view, NULL));
    SL_CHECK(sl_factor_change_entries(c.y.F, NULL, NULL, NULL, NULL, 0, W, &stats));
    assert_int_equal(stats.change.updates, 0);
    assert_true(stats.change.drift == 0.0);
    sl_work_free(W);
    changed_free(&c);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(changed_entries_give_the_factor_of_the_new_matrix),
        cmocka_unit_test(ranks_are_as_few_as_the_edges),
        cmocka_unit_test(vectors_give_the_factor_of_the_new_matrix),
        cmocka_unit_test(one_vector_changes_a_wide_panel),
        cmocka_unit_test(one_vector_changes_pivots_of_both_signs),
        cmocka_unit_test(an_update_and_its_downdate_return),
        cmocka_unit_test(ten_thousand_edits_stay_below_the_drift),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

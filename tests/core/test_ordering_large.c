/* test_ordering_large.c: orderings of large graphs and of heavy vertices */
#include "tests/lib/check_factor.h"

/* Entries of L under an ordering, after a check of its permutation and separator tree. */
static double fill_of(const sl_csc *A, const sl_options *opt) {
    sl_symbolic *S = NULL;
    sl_stats stats;
    memset(&stats, 0, sizeof stats);
    SL_CHECK(sl_symbolic_create(&S, A, opt, &stats));
    const sl_symbolic_arrays v = sl_symbolic_view(S);
    NOTHING_WRONG(check_permutation(v.n, v.perm, v.iperm));
    NOTHING_WRONG(check_septree(&v, A));
    sl_symbolic_free(S);
    return (double)stats.symbolic.nnz_l;
}

static gen_matrix_t store(gen_list_t *t) {
    for (sl_int k = 0; k < t->n; k++) {
        gen_add(t, k, k, 1.0);
    }
    gen_matrix_t M = gen_store(t, gen_style(0), 1);
    gen_list_free(t);
    return M;
}

/* A path whose vertices are blocks of rows that are indistinguishable: few vertices, and a few of
 * them as heavy as a leaf should be. The fill is close to that of the natural order, which is
 * minimal. */
static void heavy_vertices_stay_whole(void **state) {
    (void)state;
    const sl_int vertices = 150, block = 40;
    gen_list_t t = gen_list(vertices * block);
    for (sl_int j = 0; j < t.n; j++) {
        for (sl_int i = j + 1; i < t.n && i < (j / block + 2) * block; i++) {
            gen_add(&t, i, j, 1.0);
        }
    }
    gen_matrix_t M = store(&t);
    sl_options opt = options_none();
    opt.ordering = SL_ORDERING_NATURAL;
    const double least = fill_of(&M.view, &opt);
    opt.ordering = SL_ORDERING_ND;
    assert_true(fill_of(&M.view, &opt) <= 1.5 * least);
    gen_matrix_free(&M);
}

/* Random graphs without small separators, and with vertices of very many neighbors. */
static void graphs_without_separators_are_ordered(void **state) {
    (void)state;
    for (int kind = 0; kind < 3; kind++) {
        gen_list_t t = gen_list(kind == 0 ? 14000 : 6000);
        uint64_t seed = 8;
        for (sl_int k = 1; k < t.n; k++) {
            if (kind == 0) {
                gen_add(&t, k, gen_below(&seed, k), 1.0);
                if (k % 3 == 0) {
                    gen_add(&t, k, gen_below(&seed, k), 1.0);
                }
            } else {
                const sl_int hubs = kind == 1 ? 10 : 30;
                gen_add(&t, k, k < hubs ? k - 1 : gen_below(&seed, hubs), 1.0);
                if (k % (kind == 1 ? 40 : 5) == 0) {
                    gen_add(&t, k, gen_below(&seed, k), 1.0);
                }
            }
        }
        gen_matrix_t M = store(&t);
        sl_options opt = options_none();
        const double n = M.view.n_cols, fill = fill_of(&M.view, &opt);
        assert_true(fill < n * n / 2);
        gen_matrix_free(&M);
    }
}

/* A complete graph has so many edges that its degrees are not compared: one supernode. */
static void complete_graphs_are_one_supernode(void **state) {
    (void)state;
    const sl_int n = 1100;
    gen_list_t t = gen_list(n);
    for (sl_int j = 0; j < n; j++) {
        for (sl_int i = j + 1; i < n; i++) {
            gen_add(&t, i, j, 1.0);
        }
    }
    gen_matrix_t M = store(&t);
    sl_symbolic *S;
    sl_stats stats;
    SL_CHECK(sl_symbolic_create(&S, &M.view, NULL, &stats));
    assert_int_equal(stats.symbolic.supernodes, 1);
    assert_int_equal(stats.symbolic.nnz_l, n * (n + 1) / 2);
    sl_symbolic_free(S);
    gen_matrix_free(&M);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(heavy_vertices_stay_whole),
        cmocka_unit_test(graphs_without_separators_are_ordered),
        cmocka_unit_test(complete_graphs_are_one_supernode),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

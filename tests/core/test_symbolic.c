/* test_symbolic.c: tree, counts, rows and panels of an analysis against dense elimination */
#include "tests/lib/check_factor.h"

static sl_symbolic *analyze(const sl_csc *A, const sl_options *opt, sl_stats *stats) {
    sl_symbolic *S = NULL;
    SL_CHECK(sl_symbolic_create(&S, A, opt, stats));
    assert_non_null(S);
    return S;
}

/* Checks everything that the analysis promises about a small matrix. */
static void check_all(const sl_csc *A, const sl_options *opt) {
    sl_stats stats;
    memset(&stats, 0, sizeof stats);
    sl_symbolic *S = analyze(A, opt, &stats);
    sl_symbolic_arrays v = sl_symbolic_view(S);
    sl_int n = A->n_cols, roots = 0, height = 0, *depth = test_ints((size_t)n);
    sl_off nnz = 0;
    double flops = 0;
    assert_int_equal(v.n, n);
    NOTHING_WRONG(check_permutation(n, v.perm, v.iperm));
    NOTHING_WRONG(check_supernodes(&v));
    NOTHING_WRONG(check_postorder(v.n_supers, v.super_parent));
    NOTHING_WRONG(check_structure(&v, A, opt->relaxation == SL_RELAXATION_NONE));
    for (sl_int k = n; k-- > 0;) {
        depth[k] = v.parent[k] < 0 ? 1 : depth[v.parent[k]] + 1;
        height = depth[k] > height ? depth[k] : height;
        roots += v.parent[k] < 0;
        nnz += v.counts[k];
        flops += (double)v.counts[k] * (double)v.counts[k];
    }
    assert_int_equal(stats.symbolic.n, n);
    assert_int_equal(stats.symbolic.nnz_l, nnz);
    assert_true(stats.symbolic.flops == flops);
    assert_int_equal(stats.symbolic.nnz_panels, v.panel_begin[v.n_supers]);
    assert_int_equal(stats.symbolic.supernodes, v.n_supers);
    assert_true(stats.symbolic.supernodes_fundamental >= v.n_supers);
    if (opt->relaxation == SL_RELAXATION_NONE) {
        assert_int_equal(stats.symbolic.supernodes_fundamental, v.n_supers);
    }
    assert_int_equal(stats.symbolic.tree_height, height);
    assert_int_equal(stats.symbolic.components, roots);
    assert_true(stats.symbolic.seconds_order >= 0 && stats.symbolic.seconds_analyze >= 0);
    assert_true(stats.symbolic.bytes > 0);
    assert_int_equal(stats.error.row, -1);

    sl_stats again;
    memset(&again, 0, sizeof again);
    again.factor.positive = 77; /* another group: not touched */
    again.symbolic = sl_symbolic_view(S).info;
    assert_int_equal(again.symbolic.nnz_l, nnz);
    assert_int_equal(again.symbolic.nnz_a, stats.symbolic.nnz_a);
    assert_int_equal(again.symbolic.triangle, stats.symbolic.triangle);
    assert_int_equal(again.factor.positive, 77);
    free(depth);
    sl_symbolic_free(S);
}

static void the_zoo_in_every_style_and_ordering(void **state) {
    (void)state;
    static const sl_int sizes[3] = {3, 17, 60};
    for (int kind = 0; kind < GEN_KINDS; kind++) {
        for (int size = 0; size < 3; size++) {
            gen_list_t t = gen_make((gen_kind_t)kind, sizes[size], 1, 12);
            sl_int *perm = test_ints((size_t)t.n);
            gen_permutation(perm, t.n, 3);
            for (int which = 0; which<GEN_STYLES; which += sizes[size]> 20 ? 5 : 1) {
                gen_matrix_t M = gen_store(&t, gen_style(which), 4);
                M.view.x = NULL; /* values are not read */
                for (int ordering = SL_ORDERING_ND; ordering <= ORDERING_LAST; ordering++) {
                    if (!ordering_is_present((sl_ordering)ordering)) {
                        continue;
                    }
                    for (int relaxation = SL_RELAXATION_DEFAULT; relaxation <= SL_RELAXATION_NONE;
                         relaxation++) {
                        sl_options opt = options_none();
                        opt.ordering = (sl_ordering)ordering;
                        opt.relaxation = (sl_relaxation)relaxation;
                        opt.perm = perm;
                        check_all(&M.view, &opt);
                    }
                }
                gen_matrix_free(&M);
            }
            free(perm);
            gen_list_free(&t);
        }
    }
}

static void many_random_patterns(void **state) {
    (void)state;
    uint64_t seed = 2024;
    for (int round = 0; round < 300; round++) {
        gen_list_t t = gen_list(1 + gen_below(&seed, 24));
        gen_edges_random(&t, 20 + gen_below(&seed, 400), &seed);
        if (round % 3) {
            gen_dominate(&t, 1, &seed);
        } /* otherwise no diagonal is stored */
        gen_matrix_t M = gen_store(&t, gen_style(round % GEN_STYLES), seed);
        for (int relaxation = SL_RELAXATION_DEFAULT; relaxation <= SL_RELAXATION_NONE;
             relaxation++) {
            sl_options opt = options_none();
            opt.ordering = round % 2 ? SL_ORDERING_NATURAL : SL_ORDERING_ND;
            opt.relaxation = (sl_relaxation)relaxation;
            check_all(&M.view, &opt);
        }
        gen_matrix_free(&M);
        gen_list_free(&t);
    }
}

/* Columns of several stars in turns, each with its center first: all of L below the centers is
 * fill, and no column follows its child. So many lists would be moved that the tree is found
 * first. */
static void stars_in_turns(void **state) {
    (void)state;
    for (sl_int stars = 2; stars < 6; stars++) {
        gen_list_t t = gen_list(240);
        uint64_t seed = 31;
        for (sl_int k = stars; k < t.n; k++) {
            gen_add(&t, k, k % stars, -1);
        }
        gen_dominate(&t, 1, &seed);
        gen_matrix_t M = gen_store(&t, gen_style(0), seed);
        sl_options opt = options_none();
        opt.ordering = SL_ORDERING_NATURAL;
        for (int relaxation = SL_RELAXATION_DEFAULT; relaxation <= SL_RELAXATION_NONE;
             relaxation++) {
            opt.relaxation = (sl_relaxation)relaxation;
            check_all(&M.view, &opt);
        }
        gen_matrix_free(&M);
        gen_list_free(&t);
    }
}

static void every_style_gives_the_same_analysis(void **state) {
    (void)state;
    gen_list_t t = gen_make(GEN_COMPONENTS, 70, 1, 3);
    gen_matrix_t first = gen_store(&t, gen_style(0), 1);
    sl_stats stats;
    memset(&stats, 0, sizeof stats);
    sl_symbolic *S = analyze(&first.view, NULL, &stats);
    sl_symbolic_arrays v = sl_symbolic_view(S);
    for (int which = 1; which < GEN_STYLES; which++) {
        gen_matrix_t M = gen_store(&t, gen_style(which), 77);
        sl_stats other;
        memset(&other, 0, sizeof other);
        sl_symbolic *T = analyze(&M.view, NULL, &other);
        sl_symbolic_arrays w = sl_symbolic_view(T);
        size_t ints = (size_t)v.n * sizeof(sl_int);
        assert_memory_equal(v.perm, w.perm, ints);
        assert_memory_equal(v.parent, w.parent, ints);
        assert_memory_equal(v.counts, w.counts, ints);
        assert_int_equal(v.n_supers, w.n_supers);
        assert_memory_equal(v.rows, w.rows, (size_t)v.rows_begin[v.n_supers] * sizeof(sl_int));
        assert_int_equal(other.symbolic.triangle, gen_style(which).triangle);
        if (!gen_style(which).duplicated) {
            /* one triangle, whatever is stored */
            assert_int_equal(other.symbolic.nnz_a, (sl_off)t.count);
        }
        sl_symbolic_free(T);
        gen_matrix_free(&M);
    }
    sl_symbolic_free(S);
    gen_matrix_free(&first);
    gen_list_free(&t);
}

static void wrong_arguments(void **state) {
    (void)state;
    gen_matrix_t M = gen_matrix(GEN_GRID2, 9, 1, 2);
    const sl_int twice[9] = {0, 1, 2, 3, 4, 5, 6, 7, 0}, big[9] = {0, 1, 2, 9, 4, 5, 6, 7, 8};
    const sl_int low[9] = {0, -1, 2, 3, 4, 5, 6, 7, 8};
    sl_symbolic *S = (sl_symbolic *)(void *)&M;
    sl_options opt = options_none();
    sl_stats stats;
    memset(&stats, 0, sizeof stats);
    opt.ordering = SL_ORDERING_GIVEN;
    SL_EXPECT(SL_ERR_ARGUMENT, sl_symbolic_create(&S, &M.view, &opt, &stats)); /* no perm */
    assert_null(S);
    opt.perm = twice;
    SL_EXPECT(SL_ERR_ARGUMENT, sl_symbolic_create(&S, &M.view, &opt, &stats));
    assert_int_equal(stats.error.row, 8);
    opt.perm = big;
    SL_EXPECT(SL_ERR_ARGUMENT, sl_symbolic_create(&S, &M.view, &opt, &stats));
    assert_int_equal(stats.error.row, 3);
    opt.perm = low;
    SL_EXPECT(SL_ERR_ARGUMENT, sl_symbolic_create(&S, &M.view, &opt, &stats));
    assert_int_equal(stats.error.row, 1);
    SL_EXPECT(SL_ERR_ARGUMENT, sl_symbolic_create(&S, &M.view, &opt, NULL));
    opt.ordering = (sl_ordering)17;
    SL_EXPECT(SL_ERR_ARGUMENT, sl_symbolic_create(&S, &M.view, &opt, NULL));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_symbolic_create(&S, NULL, NULL, NULL));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_symbolic_create(NULL, &M.view, NULL, NULL));
    sl_csc bad = M.view;
    bad.n_rows = 10;
    SL_EXPECT(SL_ERR_ARGUMENT, sl_symbolic_create(&S, &bad, NULL, NULL));
    bad = M.view;
    bad.p = NULL;
    SL_EXPECT(SL_ERR_ARGUMENT, sl_symbolic_create(&S, &bad, NULL, NULL));
    bad = M.view;
    M.i[3] = 9;
    SL_EXPECT(SL_ERR_MALFORMED, sl_symbolic_create(&S, &M.view, NULL, NULL));
    M.i[3] = -1;
    SL_EXPECT(SL_ERR_MALFORMED, sl_symbolic_create(&S, &M.view, NULL, NULL));
    M.p[4] = M.p[9] + 1;
    SL_EXPECT(SL_ERR_MALFORMED, sl_symbolic_create(&S, &M.view, NULL, NULL));
    assert_null(S);
    sl_symbolic_free(NULL);
    gen_matrix_free(&M);

    /* Both triangles are stored and one entry has no mirror image: the error names it in the
     * caller's numbering. */
    const sl_int p[4] = {0, 2, 3, 3}, i[3] = {1, 2, 0};
    sl_csc lonely = {3, 3, p, i, NULL};
    memset(&stats, 0, sizeof stats);
    SL_EXPECT(SL_ERR_MALFORMED, sl_symbolic_create(&S, &lonely, NULL, &stats));
    assert_int_equal(stats.error.row, 2);
    assert_int_equal(stats.error.column, 0);
}

/* Arbitrary integers as positions and indices give a status, never a crash. What is accepted must
 * keep all promises. */
static void hostile_arrays(void **state) {
    (void)state;
    uint64_t seed = 31337;
    int accepted = 0;
    for (int round = 0; round < 20000; round++) {
        sl_int n = gen_below(&seed, 5), p[6], i[12];
        p[0] = gen_below(&seed, 12) ? 0 : gen_below(&seed, 5) - 2;
        for (sl_int j = 0; j < n; j++) {
            sl_int step = gen_below(&seed, 20)  ? gen_below(&seed, 3)
                          : gen_below(&seed, 2) ? -2
                                                : INT32_MAX;
            int64_t next = (int64_t)p[j] + step;
            p[j + 1] = next > 12 && step != INT32_MAX ? 12
                       : next > INT32_MAX             ? INT32_MAX
                                                      : (sl_int)next;
        }
        if (p[n] >
            /* A position beyond the array would be a wrong promise of the caller, not a malformed
             * view. */
            12) {
            p[n] = 12;
        }
        for (int k = 0; k < 12; k++) {
            i[k] = gen_below(&seed, 30) || n == 0 ? (n ? gen_below(&seed, n) : 0)
                                                  : gen_below(&seed, 3) * n - 1;
        }
        sl_csc A = {n, n, p, i, NULL};
        sl_options opt = options_none();
        opt.ordering = round % 2 ? SL_ORDERING_NATURAL : SL_ORDERING_ND;
        sl_symbolic *S = NULL;
        sl_status status = sl_symbolic_create(&S, &A, &opt, NULL);
        assert_int_equal(S != NULL, status == SL_OK);
        if (S) {
            accepted++;
            sl_symbolic_free(S);
            SL_CHECK(sl_csc_check(&A, NULL));
            check_all(&A, &opt);
        } else {
            assert_int_equal(status, SL_ERR_MALFORMED);
        }
    }
    assert_true(accepted > 1000 && accepted < 19000);
}

static void large_graphs_do_not_recurse(void **state) {
    (void)state;
    /* The elimination tree of a path in natural order has height n: recursion would exhaust the
     * stack. */
    static const gen_kind_t kinds[3] = {GEN_PATH, GEN_ARROW, GEN_DIAGONAL};
    for (int k = 0; k < 3; k++) {
        gen_matrix_t M = gen_matrix(kinds[k], 200000, 1, 1);
        sl_options opt = options_none();
        sl_stats stats;
        memset(&stats, 0, sizeof stats);
        opt.ordering = SL_ORDERING_NATURAL;
        sl_symbolic *S = analyze(&M.view, &opt, &stats);
        sl_symbolic_arrays v = sl_symbolic_view(S);
        NOTHING_WRONG(check_permutation(v.n, v.perm, v.iperm));
        NOTHING_WRONG(check_supernodes(&v));
        assert_int_equal(stats.symbolic.tree_height, kinds[k] == GEN_PATH    ? 200000
                                                     : kinds[k] == GEN_ARROW ? 2
                                                                             : 1);
        sl_symbolic_free(S);
        if (kinds[k] == GEN_DIAGONAL) { /* 200000 components of one row */
            S = analyze(&M.view, NULL, &stats);
            assert_int_equal(stats.symbolic.components, 200000);
            sl_symbolic_free(S);
        }
        gen_matrix_free(&M);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_zoo_in_every_style_and_ordering),
        cmocka_unit_test(many_random_patterns),
        cmocka_unit_test(stars_in_turns),
        cmocka_unit_test(every_style_gives_the_same_analysis),
        cmocka_unit_test(wrong_arguments),
        cmocka_unit_test(hostile_arrays),
        cmocka_unit_test(large_graphs_do_not_recurse),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

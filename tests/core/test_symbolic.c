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
    sl_symbolic_stats(S, &again);
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
                for (int ordering = SL_ORDERING_ND; ordering <= SL_ORDERING_MINDEG; ordering++) {
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

/* Analyses A in the order perm, or by SL_ORDERING_NATURAL if perm is NULL. */
static sl_symbolic *analyze_in_order(const sl_csc *A, const sl_int *perm,
                                     sl_relaxation relaxation) {
    sl_options opt = options_none();
    opt.ordering = perm ? SL_ORDERING_GIVEN : SL_ORDERING_NATURAL;
    opt.relaxation = relaxation;
    opt.perm = perm;
    return analyze(A, &opt, NULL);
}

/* Checks that v's order is equivalent to perm: each row has the same column count and the same
 * parent row as in a dense elimination in the order perm. */
static void check_equivalent(const sl_csc *A, const sl_int *perm, const sl_symbolic_arrays *v) {
    sl_int n = A->n_cols, *counts = test_ints((size_t)n), *parent = test_ints((size_t)n);
    char *P = ref_pattern(A), *fill = ref_permute_pattern(n, P, perm);
    ref_fill(n, fill);
    ref_counts(n, fill, counts);
    ref_etree(n, fill, parent);
    for (sl_int k = 0; k < n; k++) {
        sl_int at = v->iperm[perm[k]];
        assert_int_equal(v->counts[at], counts[k]);
        assert_int_equal(v->parent[at] < 0 ? -1 : v->perm[v->parent[at]],
                         parent[k] < 0 ? -1 : perm[parent[k]]);
    }
    free(P);
    free(fill);
    free(counts);
    free(parent);
}

/* Returns whether perm is a postorder of the supernodes in v: the rows of each supernode are
 * consecutive in perm, and so are those of each subtree. last[s] := the last position of supernode
 * s. */
static int is_postorder_of(const sl_symbolic_arrays *v, const sl_int *perm, sl_int *last) {
    sl_int *at = test_ints((size_t)v->n), *low = test_ints((size_t)v->n_supers);
    sl_int *size = test_ints((size_t)v->n_supers);
    int is_postorder = 1;
    for (sl_int k = 0; k < v->n; k++) {
        at[perm[k]] = k;
    }
    for (sl_int s = 0; s < v->n_supers; s++) {
        sl_int first = v->n, width = v->super_first[s + 1] - v->super_first[s];
        last[s] = -1;
        for (sl_int k = v->super_first[s]; k < v->super_first[s + 1]; k++) {
            sl_int here = at[v->perm[k]];
            assert_true(here > last[s]); /* the rows of a supernode keep the order of perm */
            first = here < first ? here : first;
            last[s] = here;
        }
        low[s] = size[s] == 0 || first < low[s] ? first : low[s];
        size[s] += width;
        is_postorder =
            is_postorder && last[s] - first + 1 == width && last[s] - low[s] + 1 == size[s];
        sl_int up = v->super_parent[s];
        if (up != -1) {
            low[up] = size[up] == 0 || low[s] < low[up] ? low[s] : low[up];
            size[up] += size[s];
        }
    }
    free(at);
    free(low);
    free(size);
    return is_postorder;
}

/* Checks an analysis in the order perm. Returns whether the order was kept. */
static int check_kept(const sl_csc *A, const sl_int *perm, const sl_symbolic *S) {
    sl_symbolic_arrays v = sl_symbolic_view(S);
    sl_int *last = test_ints((size_t)v.n_supers), *latest = test_ints((size_t)v.n_supers + 1);
    int is_kept = memcmp(v.perm, perm, (size_t)v.n * sizeof(sl_int)) == 0;
    check_equivalent(A, perm, &v);
    NOTHING_WRONG(check_postorder(v.n_supers, v.super_parent));
    assert_int_equal(is_kept, is_postorder_of(&v, perm, last));
    for (sl_int s = 0; s <= v.n_supers; s++) {
        latest[s] = -1;
    }
    for (sl_int s = 0; s < v.n_supers; s++) { /* siblings follow each other as in perm */
        sl_int up = v.super_parent[s] == -1 ? v.n_supers : v.super_parent[s];
        assert_true(last[s] > latest[up]);
        latest[up] = last[s];
    }
    free(last);
    free(latest);
    return is_kept;
}

/* NATURAL and GIVEN keep an order that is a postorder of the supernodes, and replace any other one
 * by an equivalent order. */
static void the_callers_order_is_kept_where_it_can_be(void **state) {
    (void)state;
    uint64_t seed = 5;
    int kept[2][2] = {{0, 0}, {0, 0}}, rounds = 0;
    for (; rounds < 120; rounds++) {
        gen_matrix_t M = gen_matrix((gen_kind_t)(GEN_PATH + rounds % 10), 30, 1, (uint64_t)rounds);
        sl_int n = M.view.n_cols, *perm = test_ints((size_t)n);
        for (int relaxation = 0; relaxation < 2; relaxation++) {
            for (int given = 0; given < 2; given++) {
                for (sl_int k = 0; k < n; k++) {
                    perm[k] = k;
                }
                if (given) {
                    gen_permutation(perm, n, gen_bits(&seed));
                }
                sl_symbolic *S =
                    analyze_in_order(&M.view, given ? perm : NULL, (sl_relaxation)relaxation);
                kept[relaxation][given] += check_kept(&M.view, perm, S);
                /* The order of an analysis without relaxation is a postorder of the elimination
                 * tree, so that it is kept when it is given. */
                memcpy(perm, sl_symbolic_view(S).perm, (size_t)n * sizeof(sl_int));
                sl_symbolic *T = analyze_in_order(&M.view, perm, (sl_relaxation)relaxation);
                assert_true(check_kept(&M.view, perm, T) || relaxation == SL_RELAXATION_DEFAULT);
                sl_symbolic_free(S);
                sl_symbolic_free(T);
            }
        }
        free(perm);
        gen_matrix_free(&M);
    }
    for (int relaxation = 0; relaxation < 2; relaxation++) {
        assert_true(kept[relaxation][0] > 0 && kept[relaxation][0] < rounds);
        assert_true(kept[relaxation][1] < rounds);
    }
}

/* The elimination tree 0 -> 2, 1 -> 3, 2 -> 3, in which the subtree {0, 2} is not consecutive.
 * The order is kept if all rows are merged into one supernode; without relaxation it becomes 1 0
 * 2 3. */
static void small_orders(void **state) {
    (void)state;
    static const sl_int p[5] = {0, 1, 2, 3, 3}, i[3] = {2, 3, 3}, natural[4] = {0, 1, 2, 3};
    static const sl_int moved[4] = {1, 0, 2, 3}, given[4] = {3, 0, 2, 1};
    const sl_csc A = {4, 4, p, i, NULL};
    sl_symbolic *S = analyze_in_order(&A, NULL, SL_RELAXATION_DEFAULT);
    assert_memory_equal(sl_symbolic_view(S).perm, natural, sizeof natural);
    sl_symbolic_free(S);
    S = analyze_in_order(&A, given, SL_RELAXATION_DEFAULT);
    assert_memory_equal(sl_symbolic_view(S).perm, given, sizeof given);
    sl_symbolic_free(S);
    S = analyze_in_order(&A, NULL, SL_RELAXATION_NONE);
    assert_memory_equal(sl_symbolic_view(S).perm, moved, sizeof moved);
    sl_symbolic_free(S);
    S = analyze_in_order(&A, moved, SL_RELAXATION_NONE);
    assert_memory_equal(sl_symbolic_view(S).perm, moved, sizeof moved);
    sl_symbolic_free(S);
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
    SL_EXPECT(SL_ERR_PATTERN, sl_symbolic_create(&S, &M.view, NULL, NULL));
    M.i[3] = -1;
    SL_EXPECT(SL_ERR_PATTERN, sl_symbolic_create(&S, &M.view, NULL, NULL));
    M.p[4] = M.p[9] + 1;
    SL_EXPECT(SL_ERR_PATTERN, sl_symbolic_create(&S, &M.view, NULL, NULL));
    assert_null(S);
    sl_symbolic_free(NULL);
    gen_matrix_free(&M);

    /* Both triangles are stored and one entry has no mirror image: the error names it in the
     * caller's numbering. */
    const sl_int p[4] = {0, 2, 3, 3}, i[3] = {1, 2, 0};
    sl_csc lonely = {3, 3, p, i, NULL};
    memset(&stats, 0, sizeof stats);
    SL_EXPECT(SL_ERR_PATTERN, sl_symbolic_create(&S, &lonely, NULL, &stats));
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
            assert_int_equal(status, SL_ERR_PATTERN);
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
        cmocka_unit_test(the_callers_order_is_kept_where_it_can_be),
        cmocka_unit_test(small_orders),
        cmocka_unit_test(every_style_gives_the_same_analysis),
        cmocka_unit_test(wrong_arguments),
        cmocka_unit_test(hostile_arrays),
        cmocka_unit_test(large_graphs_do_not_recurse),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

/* test_symbolic_order.c: analyses in a given order: it is kept, or replaced by an equivalent one */
#include "tests/lib/check_factor.h"

/* Analyzes A in the order perm, or by SL_ORDERING_NATURAL if perm is NULL. */
static sl_symbolic *analyze_in_order(const sl_csc *A, const sl_int *perm,
                                     sl_relaxation relaxation) {
    sl_options opt = options_none();
    sl_symbolic *S = NULL;
    opt.ordering = perm ? SL_ORDERING_GIVEN : SL_ORDERING_NATURAL;
    opt.relaxation = relaxation;
    opt.perm = perm;
    SL_CHECK(sl_symbolic_create(&S, A, &opt, NULL));
    return S;
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

/* The elimination tree 0 -> 2, 1 -> 3, 2 -> 3, in which the subtree {0, 2} is not consecutive. The
 * order becomes 1 0 2 3. With relaxation too: columns that need no front are not merged. */
static void small_orders(void **state) {
    (void)state;
    static const sl_int p[5] = {0, 1, 2, 3, 3}, i[3] = {2, 3, 3}, moved[4] = {1, 0, 2, 3};
    const sl_csc A = {4, 4, p, i, NULL};
    sl_symbolic *S = analyze_in_order(&A, NULL, SL_RELAXATION_DEFAULT);
    assert_memory_equal(sl_symbolic_view(S).perm, moved, sizeof moved);
    sl_symbolic_free(S);
    S = analyze_in_order(&A, NULL, SL_RELAXATION_NONE);
    assert_memory_equal(sl_symbolic_view(S).perm, moved, sizeof moved);
    sl_symbolic_free(S);
    S = analyze_in_order(&A, moved, SL_RELAXATION_NONE);
    assert_memory_equal(sl_symbolic_view(S).perm, moved, sizeof moved);
    sl_symbolic_free(S);
}

/* Bundle adjustment: points of 3 rows, each with 8 of the cameras of 6 rows, which follow those. */
static gen_matrix_t bundle(sl_int cameras, sl_int points) {
    gen_list_t t = gen_list(6 * cameras + 3 * points);
    uint64_t seed = 4;
    for (sl_int row = 0; row < t.n; row++) {
        const int is_point = row < 3 * points;
        for (sl_int k = 1; k <= (is_point ? row % 3 : (row - 3 * points) % 6); k++) {
            gen_add(&t, row, row - k, 0.1);
        }
    }
    for (sl_int v = 0; v < 8 * points; v++) {
        const sl_int camera = (v / 8 * cameras / points + v % 8) % cameras;
        for (sl_int k = 0; k < 18; k++) {
            gen_add(&t, 3 * points + 6 * camera + k % 6, v / 8 * 3 + k / 6, 0.1);
        }
    }
    gen_dominate(&t, 1, &seed);
    gen_matrix_t M = gen_store(&t, gen_style(0), 1);
    gen_list_free(&t);
    return M;
}

/* Many leaves follow their siblings, so that their update matrices do not wait for a subtree. */
static void many_leaves_are_last(void **state) {
    (void)state;
    gen_matrix_t M = bundle(40, 1500);
    const sl_options opt = options_none();
    sl_symbolic *S = NULL;
    sl_factor *F = NULL;
    sl_stats stats;
    sl_int mixed = 0;
    memset(&stats, 0, sizeof stats);
    SL_CHECK(sl_symbolic_create(&S, &M.view, &opt, NULL));
    SL_CHECK(sl_factor_create(&F, S, &M.view, &opt, &stats));
    const sl_symbolic_arrays v = sl_symbolic_view(S);
    sl_int *leaves = test_ints((size_t)v.n_supers), *first = test_ints((size_t)v.n_supers);
    sl_int *children = test_ints((size_t)v.n_supers);
    for (sl_int s = 0; s < v.n_supers; s++) {
        const sl_int up = v.super_parent[s];
        first[s] = -1;
        if (up != -1) {
            children[up]++;
            leaves[up] += children[s] == 0 && v.rows_begin[s + 1] - v.rows_begin[s] >= 24;
        }
    }
    for (sl_int s = v.n_supers - 1; s >= 0; s--) { /* first: the last wide sibling with children */
        const sl_int up = v.super_parent[s];
        const sl_int width = v.super_first[s + 1] - v.super_first[s];
        if (up != -1 && children[s] > 0 && leaves[up] >= 64 && width > 1) {
            first[up] = first[up] == -1 ? s : first[up];
            mixed++;
        }
    }
    for (sl_int s = 0; s < v.n_supers; s++) {
        const sl_int up = v.super_parent[s];
        const sl_off below = v.rows_begin[s + 1] - v.rows_begin[s];
        assert_true(up == -1 || leaves[up] < 64 || children[s] > 0 || below < 24 || s > first[up]);
    }
    print_message("%d subtrees beside leaves, %.1f MB, of which L has %.1f\n", (int)mixed,
                  1e-6 * (double)stats.factor.bytes, 8e-6 * (double)v.panel_begin[v.n_supers]);
    assert_true(mixed > 0);
    NOTHING_WRONG(check_factor(F, &M.view));
    free(leaves);
    free(first);
    free(children);
    sl_factor_free(F);
    sl_symbolic_free(S);
    gen_matrix_free(&M);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_callers_order_is_kept_where_it_can_be),
        cmocka_unit_test(small_orders),
        cmocka_unit_test(many_leaves_are_last),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

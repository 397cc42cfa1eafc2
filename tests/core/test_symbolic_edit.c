/* test_symbolic_edit.c: sl_symbolic_edit: analyses that follow random edits of the pattern */
#include "tests/lib/edited.h"

/* Edits a matrix `edits` times, each time in another way, and checks every analysis. Returns how
 * many of them kept their order. */
static int follow(gen_kind_t kind, sl_int size, int style, int edits, edit_kind_t first,
                  const sl_options *opt) {
    uint64_t state = (uint64_t)((int)kind + 100 * style + 7);
    gen_list_t t = gen_make(kind, size, 1, 42);
    gen_matrix_t A = gen_store(&t, gen_style(style), 1);
    sl_symbolic *S = NULL;
    int local = 0;
    SL_CHECK(sl_symbolic_create(&S, &A.view, opt, NULL));
    for (int k = 0; k < edits; k++) {
        edit_kind_t how = first;
        how.numbers = (edit_numbers_t)(((int)first.numbers + k) % EDIT_NUMBERS);
        sl_int *new_of = test_ints((size_t)t.n);
        gen_list_t e = edited_list(&t, how, new_of, &state);
        gen_matrix_t B = gen_store(&e, gen_style(k % 3 == 2 && style < 6 ? k % 6 : style), 1);
        sl_symbolic *T = NULL;
        sl_stats stats;
        SL_CHECK(sl_symbolic_edit(&T, S, &A.view, &B.view, new_of, opt, &stats));
        edited_check(T, &B, opt != NULL && opt->relaxation == SL_RELAXATION_NONE);
        assert_int_equal(stats.symbolic.n, e.n);
        assert_true(stats.edit.growth > 0 && stats.edit.computed <= e.n);
        assert_true(stats.edit.changed <= e.n && stats.edit.reordered <= e.n);
        local += !stats.edit.is_anew;
        free(new_of);
        gen_list_free(&t);
        gen_matrix_free(&A);
        sl_symbolic_free(S);
        t = e;
        A = B;
        S = T;
    }
    gen_list_free(&t);
    gen_matrix_free(&A);
    sl_symbolic_free(S);
    return local;
}

static void every_kind_of_matrix_follows_edits(void **state) {
    (void)state;
    int local = 0, all = 0;
    for (int kind = 0; kind < GEN_KINDS; kind++) {
        for (int k = 0; k < 12; k++) {
            sl_options opt = options_none();
            opt.relaxation = k % 2 ? SL_RELAXATION_NONE : SL_RELAXATION_DEFAULT;
            opt.ordering = k % 5 == 4   ? SL_ORDERING_NATURAL
                           : k % 5 == 2 ? SL_ORDERING_MINDEG
                                        : SL_ORDERING_ND;
            local += follow((gen_kind_t)kind, k % 3 == 0 ? 36 : 100, k % GEN_STYLES, 4,
                            edit_kinds[k % 4], &opt);
            all += 4;
        }
    }
    print_message("%d of %d edits kept the order\n", local, all);
    assert_true(local > all / 4 && local < all); /* both ways were taken */
}

static void many_edits_follow_each_other(void **state) {
    (void)state;
    const edit_kind_t small = {1, 1, 1, 1, EDIT_IN_ORDER};
    assert_true(follow(GEN_GRID2, 400, 0, 100, small, NULL) > 80);
    assert_true(follow(GEN_GRID3, 125, 2, 30, small, NULL) > 20);
}

/* Rows that only get other numbers keep their order, and so does the structure of L. */
static void renumbering_changes_nothing(void **state) {
    (void)state;
    for (int style = 0; style < GEN_STYLES; style++) {
        uint64_t random = 3;
        gen_list_t t = gen_make(GEN_GRID2, 400, 1, 42);
        gen_matrix_t A = gen_store(&t, gen_style(style), 1);
        sl_int *new_of = test_ints((size_t)t.n);
        gen_permutation(new_of, t.n, gen_bits(&random));
        for (size_t k = 0; k < t.count; k++) {
            const sl_int i = new_of[t.row[k]], j = new_of[t.col[k]];
            t.row[k] = i > j ? i : j;
            t.col[k] = i > j ? j : i;
        }
        gen_matrix_t B = gen_store(&t, gen_style((style + 1) % 6), 1);
        sl_symbolic *S = NULL, *T = NULL;
        sl_stats stats, before;
        SL_CHECK(sl_symbolic_create(&S, &A.view, NULL, &before));
        SL_CHECK(sl_symbolic_edit(&T, S, &A.view, &B.view, new_of, NULL, &stats));
        edited_check(T, &B, 0);
        if (style < 6) { /* without duplicates, whose number may differ */
            assert_int_equal(stats.edit.changed, 0);
            assert_int_equal(stats.edit.computed, 0);
            assert_int_equal(stats.symbolic.nnz_l, before.symbolic.nnz_l);
            const sl_symbolic_arrays a = sl_symbolic_view(S), b = sl_symbolic_view(T);
            for (sl_int k = 0; k < t.n; k++) {
                assert_int_equal(b.perm[k], new_of[a.perm[k]]);
            }
        }
        free(new_of);
        gen_list_free(&t);
        gen_matrix_free(&A);
        gen_matrix_free(&B);
        sl_symbolic_free(S);
        sl_symbolic_free(T);
    }
}

static sl_int column(const sl_csc *A, sl_int p) {
    sl_int j = 0;
    while (A->p[j + 1] <= p) {
        j++;
    }
    return j;
}

/* A cut: the vertices on a line of a grid are doubled, and the right side gets the doubles. */
static void a_cut_is_an_edit(void **state) {
    (void)state;
    enum { W = 20 };
    uint64_t random = 4;
    gen_list_t t = gen_list(W * W), e = gen_list(W * W + W / 2);
    gen_edges_grid(&t, W, W, 1, &random);
    for (size_t k = 0; k < t.count; k++) { /* row y, column x = W / 2, for y < W / 2 */
        const sl_int i = t.row[k], j = t.col[k];
        const int is_cut = i == j + 1 && j % W == W / 2 && j / W < W / 2;
        const int is_line = i == j + W && j % W == W / 2 && i / W < W / 2;
        gen_add(&e, i, is_cut ? W * W + j / W : j, t.x[k]);
        if (is_line) {
            gen_add(&e, W * W + i / W, W * W + j / W, t.x[k]);
        }
    }
    gen_add(&e, W * W + W / 2 - 1, (W / 2) * W + W / 2, -0.5);
    gen_dominate(&t, 1, &random);
    gen_dominate(&e, 1, &random);
    gen_matrix_t A = gen_store(&t, gen_style(0), 1), B = gen_store(&e, gen_style(0), 1);
    sl_int new_of[W * W];
    for (sl_int k = 0; k < W * W; k++) {
        new_of[k] = k;
    }
    sl_symbolic *S = NULL, *T = NULL;
    sl_stats stats;
    SL_CHECK(sl_symbolic_create(&S, &A.view, NULL, NULL));
    SL_CHECK(sl_symbolic_edit(&T, S, &A.view, &B.view, new_of, NULL, &stats));
    edited_check(T, &B, 0);
    assert_int_equal(stats.edit.is_anew, 0);
    assert_in_range(stats.edit.changed, W, 4 * W);
    assert_true(column(&B.view, 0) == 0);
    sl_symbolic_free(S);
    sl_symbolic_free(T);
    gen_matrix_free(&A);
    gen_matrix_free(&B);
    gen_list_free(&t);
    gen_list_free(&e);
}

/* Also a matrix without rows, before or after. */
static void everything_may_come_or_go(void **state) {
    (void)state;
    gen_matrix_t A = gen_matrix(GEN_GRID2, 49, 1, 1), none = gen_matrix(GEN_NONE, 0, 1, 1);
    sl_int gone[49];
    sl_symbolic *S = NULL, *T = NULL, *U = NULL;
    sl_stats stats;
    for (int k = 0; k < 49; k++) {
        gone[k] = -1;
    }
    SL_CHECK(sl_symbolic_create(&S, &A.view, NULL, NULL));
    SL_CHECK(sl_symbolic_edit(&T, S, &A.view, &none.view, gone, NULL, &stats));
    assert_int_equal(sl_symbolic_view(T).n, 0);
    SL_CHECK(sl_symbolic_edit(&U, T, &none.view, &A.view, NULL, NULL, &stats));
    edited_check(U, &A, 0);
    assert_int_equal(stats.edit.is_anew, 1);
    sl_symbolic_free(T);
    for (int k = 0; k < 49; k++) { /* all edges go */
        gone[k] = k;
    }
    gen_matrix_t diagonal = gen_matrix(GEN_DIAGONAL, 49, 1, 1);
    SL_CHECK(sl_symbolic_edit(&T, S, &A.view, &diagonal.view, gone, NULL, &stats));
    edited_check(T, &diagonal, 0);
    assert_int_equal(stats.edit.changed, 49);
    gen_matrix_free(&diagonal);
    sl_symbolic_free(S);
    sl_symbolic_free(T);
    sl_symbolic_free(U);
    gen_matrix_free(&A);
    gen_matrix_free(&none);
}

/* Entries that options.triangle leaves out are not compared. */
static void one_triangle_is_read(void **state) {
    (void)state;
    for (int k = 0; k < 2; k++) {
        sl_options opt = options_none();
        gen_list_t t = gen_make(GEN_GRID2, 400, 1, 42);
        gen_matrix_t A = gen_store(&t, gen_style(2), 1);
        gen_add(&t, 230, 150, 0.25);
        gen_add(&t, 231, 151, 0.25);
        gen_matrix_t B = gen_store(&t, gen_style(2), 1);
        sl_int map[400];
        sl_symbolic *S = NULL, *T = NULL, *whole = NULL;
        sl_stats stats, all;
        for (sl_int i = 0; i < 400; i++) {
            map[i] = i;
        }
        SL_CHECK(sl_symbolic_create(&S, &A.view, NULL, NULL));
        SL_CHECK(sl_symbolic_edit(&whole, S, &A.view, &B.view, map, NULL, &all));
        sl_symbolic_free(S);
        opt.triangle = k == 0 ? SL_TRIANGLE_LOWER : SL_TRIANGLE_UPPER;
        SL_CHECK(sl_symbolic_create(&S, &A.view, &opt, NULL));
        SL_CHECK(sl_symbolic_edit(&T, S, &A.view, &B.view, map, &opt, &stats));
        edited_check(T, &B, 0);
        assert_int_equal(stats.edit.is_anew, 0);
        assert_int_equal(stats.edit.changed, 4);
        assert_int_equal(stats.edit.changed, all.edit.changed);
        assert_true(stats.symbolic.nnz_l == all.symbolic.nnz_l);
        sl_symbolic_free(S);
        sl_symbolic_free(T);
        sl_symbolic_free(whole);
        gen_matrix_free(&A);
        gen_matrix_free(&B);
        gen_list_free(&t);
    }
}

/* Two chains of supernodes, whose lower ends are joined by more and more new entries: searches that
 * climb them end after a moderate number of steps, in any part of the edit. New rows join in. */
static void long_searches_end(void **state) {
    (void)state;
    enum { LENGTH = 150, N = 2 * LENGTH + 1 };
    int local = 0, anew = 0;
    for (int way = 0; way < 4; way++) {
        for (sl_int joined = 1; joined < 24; joined++) {
            const sl_int n = way % 2 ? N : N - 1, added = 3;
            gen_list_t t = gen_list(n), e = gen_list(n + added);
            uint64_t random = (uint64_t)joined;
            sl_int map[N], perm[N];
            sl_options opt = options_none();
            sl_symbolic *S = NULL, *T = NULL;
            sl_stats stats;
            for (sl_int k = 0; k < n; k++) { /* with n odd both end in the last row */
                const sl_int up = k == 2 * LENGTH ? -1 : k % LENGTH + 1 < LENGTH ? k + 1 : n - 1;
                map[k] = perm[k] = k;
                if (up > k && (up < 2 * LENGTH ? up / LENGTH == k / LENGTH : way % 2 == 1)) {
                    gen_add(&t, up, k, 1.0);
                    gen_add(&e, up, k, 1.0);
                }
            }
            for (sl_int k = 0; k < joined; k++) {
                gen_add(&e, LENGTH + (way < 2 ? 3 * k : 2 * k), 3 * k, 1.0);
            }
            for (sl_int k = 0; k < added; k++) {
                gen_add(&e, n + k, 5 * k, 1.0);
                gen_add(&e, n + k, LENGTH + 7 * k, 1.0);
            }
            gen_dominate(&t, 1, &random);
            gen_dominate(&e, 1, &random);
            gen_matrix_t A = gen_store(&t, gen_style(0), 1), B = gen_store(&e, gen_style(0), 1);
            opt.ordering = SL_ORDERING_GIVEN;
            opt.perm = perm;
            opt.relaxation = SL_RELAXATION_NONE;
            SL_CHECK(sl_symbolic_create(&S, &A.view, &opt, NULL));
            opt.ordering = SL_ORDERING_ND;
            opt.perm = NULL;
            SL_CHECK(sl_symbolic_edit(&T, S, &A.view, &B.view, map, &opt, &stats));
            edited_check(T, &B, 1);
            anew += stats.edit.is_anew;
            local += !stats.edit.is_anew;
            sl_symbolic_free(S);
            sl_symbolic_free(T);
            gen_matrix_free(&A);
            gen_matrix_free(&B);
            gen_list_free(&t);
            gen_list_free(&e);
        }
    }
    print_message("%d of %d edits kept the order\n", local, local + anew);
    assert_true(local > 0 && anew > 0);
}

static void wrong_maps_and_matrices_are_refused(void **state) {
    (void)state;
    gen_matrix_t A = gen_matrix(GEN_GRID2, 49, 1, 1), B = gen_matrix(GEN_PATH, 49, 1, 1),
                 small = gen_matrix(GEN_GRID2, 36, 1, 1);
    sl_int new_of[49];
    sl_symbolic *S = NULL, *T = (sl_symbolic *)(void *)new_of;
    sl_stats stats;
    sl_options opt = options_none();
    static const struct {
        sl_int row, value;
    } wrong[4] = {{7, 49}, {8, -2}, {9, 3}, {0, INT32_MAX}};
    SL_CHECK(sl_symbolic_create(&S, &A.view, NULL, NULL));
    for (int k = 0; k < 4; k++) {
        for (sl_int i = 0; i < 49; i++) {
            new_of[i] = i;
        }
        new_of[wrong[k].row] = wrong[k].value;
        assert_int_equal(sl_symbolic_edit(&T, S, &A.view, &B.view, new_of, NULL, &stats),
                         SL_ERR_ARGUMENT);
        assert_null(T);
        assert_int_equal(stats.error.row, wrong[k].row);
        new_of[wrong[k].row] = wrong[k].row;
    }
    assert_int_equal(sl_symbolic_edit(&T, S, &A.view, &B.view, NULL, NULL, NULL), SL_ERR_ARGUMENT);
    assert_int_equal(sl_symbolic_edit(&T, NULL, &A.view, &B.view, new_of, NULL, NULL),
                     SL_ERR_ARGUMENT);
    assert_int_equal(sl_symbolic_edit(&T, S, NULL, &B.view, new_of, NULL, NULL), SL_ERR_ARGUMENT);
    assert_int_equal(sl_symbolic_edit(&T, S, &A.view, NULL, new_of, NULL, NULL), SL_ERR_ARGUMENT);
    assert_int_equal(sl_symbolic_edit(NULL, S, &A.view, &B.view, new_of, NULL, NULL),
                     SL_ERR_ARGUMENT);
    assert_int_equal(sl_symbolic_edit(&T, S, &B.view, &A.view, new_of, NULL, NULL),
                     SL_ERR_OTHER_PATTERN);
    assert_int_equal(sl_symbolic_edit(&T, S, &small.view, &A.view, new_of, NULL, NULL),
                     SL_ERR_OTHER_PATTERN);
    sl_matrix *other; /* with as many entries */
    sl_int perm[49];
    for (sl_int i = 0; i < 49; i++) {
        perm[i] = (i + 1) % 49;
    }
    SL_CHECK(sl_matrix_submatrix(&other, &A.view, perm, 49, NULL, NULL));
    const sl_csc rotated = sl_matrix_view(other);
    assert_int_equal(sl_symbolic_edit(&T, S, &rotated, &B.view, new_of, NULL, NULL),
                     SL_ERR_OTHER_PATTERN);
    sl_matrix_free(other);
    opt.relaxation = (sl_relaxation)7;
    assert_int_equal(sl_symbolic_edit(&T, S, &A.view, &B.view, new_of, &opt, NULL),
                     SL_ERR_ARGUMENT);
    assert_null(T);
    sl_symbolic_free(S);
    SL_CHECK(sl_symbolic_create_pivoted(&S, &A.view, NULL, NULL));
    assert_int_equal(sl_symbolic_edit(&T, S, &A.view, &B.view, new_of, NULL, NULL),
                     SL_ERR_UNSUPPORTED);
    sl_symbolic_free(S);
    sl_factor *F = NULL, *G = NULL;
    SL_CHECK(sl_symbolic_create(&S, &A.view, NULL, NULL));
    SL_CHECK(sl_factor_create(&F, S, &A.view, NULL, NULL));
    SL_CHECK(sl_factor_submatrix(&T, &G, F, &A.view, new_of, 20, NULL, NULL));
    sl_symbolic *U = NULL;
    assert_int_equal(sl_symbolic_edit(&U, T, &A.view, &B.view, new_of, NULL, NULL),
                     SL_ERR_UNSUPPORTED);
    sl_factor_free(F);
    sl_factor_free(G);
    sl_symbolic_free(S);
    sl_symbolic_free(T);
    gen_matrix_free(&A);
    gen_matrix_free(&B);
    gen_matrix_free(&small);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_kind_of_matrix_follows_edits),
        cmocka_unit_test(many_edits_follow_each_other),
        cmocka_unit_test(renumbering_changes_nothing),
        cmocka_unit_test(a_cut_is_an_edit),
        cmocka_unit_test(everything_may_come_or_go),
        cmocka_unit_test(one_triangle_is_read),
        cmocka_unit_test(long_searches_end),
        cmocka_unit_test(wrong_maps_and_matrices_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

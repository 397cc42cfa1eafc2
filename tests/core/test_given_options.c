/* test_given_options.c: every call on a factor, with each option and history of it, as without */
#include "tests/lib/given_calls.h"

/* The options that a factor has after its history: of null pivots, restrictions refuse all, and
 * files do not have that others must be positive. */
static sl_options mode_of(const world *w, int mode, history h) {
    sl_options opt = w->modes[mode];
    if (h == RESTRICTED && opt.pivots == SL_PIVOTS_SKIP_NULL) {
        opt.pivots = SL_PIVOTS_NONZERO;
        opt.null_vector = opt.mass = NULL;
        opt.null_vector_count = 0;
        opt.consistency_tolerance = 0.0;
    }
    if ((h == LOADED || h == MAPPED) && opt.pivots == SL_PIVOTS_POSITIVE) {
        opt.pivots = SL_PIVOTS_NONZERO;
    }
    return opt;
}

static int history_compare(const world *w, int pivoted, int mode, history h, kind of,
                           int *answered) {
    const sl_options opt = mode_of(w, mode, h);
    given g = {NULL, NULL, NULL};
    target t = target_make(w, of, 1, &opt);
    char how[80];
    int wrong = 0;
    given_make(&g, w, pivoted, &w->modes[mode], h, of);
    const sl_status s = sl_factor_create(&t.F, w->S[pivoted], &t.A, &opt, NULL);
    snprintf(how, sizeof how, "%s, %s%s", history_names[h], w->names[mode],
             pivoted ? ", pairs" : "");
    if (g.F != NULL && s != SL_OK) {
        print_error("%s matrix, F %s: new %s\n", kind_names[of], how, sl_status_string(s));
        wrong = 1;
    } else if (g.F != NULL) {
        answers a, b;
        target u = t;
        answers_take(&b, &t, CALLS);
        u.F = g.F;
        answers_take(&a, &u,
                     h == RESTRICTED ? OF_RESTRICTIONS
                     : h == MAPPED   ? CALLS - CHANGING
                                     : CALLS);
        wrong = answers_compare(&a, &b, how, of, tolerance_of(&opt, of), answered);
    }
    sl_factor_free(t.F);
    given_free(&g);
    return wrong;
}

/* Options of F, with a history: it answers as a factor made new with these options. */
static void a_factor_answers_as_a_new_one(void **state) {
    (void)state;
    world w;
    int answered = 0, wrong = 0;
    world_make(&w);
    for (int mode = 0; mode < w.n_modes; mode++) {
        for (int h = 0; h < HISTORIES; h++) {
            for (int of = 0; of < KINDS; of++) {
                wrong += history_compare(&w, 0, mode, (history)h, (kind)of, &answered);
                wrong += history_compare(&w, 1, mode, (history)h, (kind)of, &answered);
            }
        }
    }
    world_free(&w);
    assert_int_equal(wrong, 0);
    assert_true(answered > 20000);
}

/* The answers of new factors, by options, matrix and pivots. */
typedef struct news {
    sl_status status[MODES][KINDS][2];
    answers *of[MODES][KINDS][2];
} news;

static news *news_make(const world *w) {
    news *all = (news *)test_array(1, sizeof *all);
    for (int mode = 0; mode < w->n_modes; mode++) {
        for (int k = 0; k < 2 * KINDS; k++) {
            const int of = k / 2, pivoted = k % 2;
            target t = target_make(w, (kind)of, 0, &w->modes[mode]);
            sl_status *s = &all->status[mode][of][pivoted];
            *s = sl_factor_create(&t.F, w->S[pivoted], &t.A, t.opt, NULL);
            if (*s == SL_OK) {
                all->of[mode][of][pivoted] = (answers *)test_array(1, sizeof(answers));
                answers_take(all->of[mode][of][pivoted], &t, CALLS);
            }
            sl_factor_free(t.F);
        }
    }
    return all;
}

static void news_free(news *all) {
    for (int k = 0; k < MODES * KINDS * 2; k++) {
        free((&all->of[0][0][0])[k]);
    }
    free(all);
}

/* Makes a factor follow F with each of all options, over an analysis with pairs or without. */
static int edits_compare(const world *w, const news *all, const sl_factor *F, const char *how,
                         kind of, int *kept) {
    int wrong = 0, answered = 0;
    for (int m = 0; m < 2 * w->n_modes; m++) {
        const int mode = m / 2, pivoted = m % 2;
        target t = target_make(w, of, 0, &w->modes[mode]);
        const sl_status expected = all->status[mode][of][pivoted];
        sl_stats stats;
        char name[160];
        const sl_status s = sl_factor_edit(&t.F, F, w->S[pivoted], &t.A, w->same, t.opt, &stats);
        snprintf(name, sizeof name, "%s -> %s%s", how, w->names[mode], pivoted ? ", pairs" : "");
        if (s != expected) {
            print_error("edit, %s matrix, F %s: %s, new %s\n", kind_names[of], name,
                        sl_status_string(s), sl_status_string(expected));
            wrong++;
        } else if (s == SL_OK) {
            answers a;
            *kept += !stats.reuse.is_anew;
            if (!stats.reuse.is_anew) {
                answers_take(&a, &t, CALLS);
                wrong += answers_compare(&a, all->of[mode][of][pivoted], name, of,
                                         tolerance_of(t.opt, of), &answered);
            }
        }
        sl_factor_free(t.F);
    }
    return wrong;
}

/* F with each option and a history, and a factor with each option that follows it. */
static void a_factor_follows_any_other(void **state) {
    (void)state;
    world w;
    int kept = 0, wrong = 0;
    world_make(&w);
    news *all = news_make(&w);
    for (int mode = 0; mode < w.n_modes; mode++) {
        for (int h = 0; h < HISTORIES; h++) {
            for (int of = 0; of < 2 * KINDS; of++) {
                given g = {NULL, NULL, NULL};
                char how[80];
                given_make(&g, &w, of % 2, &w.modes[mode], (history)h, (kind)(of / 2));
                snprintf(how, sizeof how, "%s, %s%s", history_names[h], w.names[mode],
                         of % 2 ? ", pairs" : "");
                if (g.F != NULL) {
                    wrong += edits_compare(&w, all, g.F, how, (kind)(of / 2), &kept);
                }
                given_free(&g);
            }
        }
    }
    news_free(all);
    world_free(&w);
    assert_int_equal(wrong, 0);
    assert_true(kept > 1800);
}

/* The factor of some rows has the options of F: as one made new in the same order. */
static int restriction_compare(const world *w, int mode, history h, kind of, int *answered) {
    const sl_options opt = mode_of(w, mode, RESTRICTED);
    sl_options order = options_none();
    given g = {NULL, NULL, NULL};
    target t = target_make(w, of, 1, &opt), u;
    sl_symbolic *S[2] = {NULL, NULL};
    sl_matrix *M = NULL;
    sl_status s, expected;
    char how[80];
    int wrong = 0;
    given_make(&g, w, 0, &w->modes[mode], h, of);
    if (g.F == NULL) {
        return 0;
    }
    t.n -= opt.storage == SL_STORAGE_COMPLEX ? 8 : 7; /* pairs of rows stay together */
    SL_CHECK(sl_matrix_submatrix(&M, &t.A, w->same, t.n, NULL, NULL));
    u = t;
    t.A = u.A = sl_matrix_view(M);
    const sl_csc whole = sl_matrix_view(w->M[of][1]);
    s = sl_factor_submatrix(&S[0], &u.F, g.F, &whole, w->same, t.n, NULL, NULL);
    order.ordering = s == SL_OK ? SL_ORDERING_GIVEN : SL_ORDERING_ND;
    order.perm = sl_symbolic_view(S[0]).perm;
    SL_CHECK(sl_symbolic_create(&S[1], &t.A, &order, NULL));
    expected = sl_factor_create(&t.F, S[1], &t.A, &opt, NULL);
    snprintf(how, sizeof how, "restricted, %s, %s", history_names[h], w->names[mode]);
    if (s != expected) {
        print_error("submatrix, %s matrix, F %s: %s, new %s\n", kind_names[of], how,
                    sl_status_string(s), sl_status_string(expected));
        wrong = 1;
    } else if (s == SL_OK) {
        answers a, b;
        answers_take(&a, &u, OF_RESTRICTIONS);
        answers_take(&b, &t, OF_RESTRICTIONS);
        wrong = answers_compare(&a, &b, how, of, tolerance_of(&opt, of), answered);
    }
    sl_factor_free(t.F);
    sl_factor_free(u.F);
    sl_symbolic_free(S[0]);
    sl_symbolic_free(S[1]);
    sl_matrix_free(M);
    given_free(&g);
    return wrong;
}

static void a_restriction_has_the_options_of_its_factor(void **state) {
    (void)state;
    world w;
    int answered = 0, wrong = 0;
    world_make(&w);
    for (int mode = 0; mode < w.n_modes; mode++) {
        for (int h = 0; h < RESTRICTED; h++) {
            for (int of = 0; of < KINDS; of++) {
                const sl_options opt = mode_of(&w, mode, (history)h);
                if (opt.pivots == w.modes[mode].pivots) { /* else they are not saved */
                    wrong += restriction_compare(&w, mode, (history)h, (kind)of, &answered);
                }
            }
        }
    }
    world_free(&w);
    assert_int_equal(wrong, 0);
    assert_true(answered > 8000);
}

/* Growth beyond the default limit, which F allows. */
static void a_restriction_keeps_the_limit_of_growth(void **state) {
    (void)state;
    static const sl_int p[4] = {0, 2, 3, 4}, i[4] = {0, 1, 1, 2}, rows[2] = {0, 1};
    static const double x[4] = {1e-20, 1.0, 1.0, 1.0};
    const sl_csc A = {3, 3, p, i, x};
    sl_options opt = options_none();
    sl_symbolic *S = analyze_natural(&A, SL_RELAXATION_DEFAULT), *T = NULL;
    sl_factor *F = NULL, *G = NULL;
    SL_EXPECT(SL_ERR_INACCURATE, sl_factor_create(&F, S, &A, &opt, NULL));
    opt.growth_limit = -1.0;
    SL_CHECK(sl_factor_create(&F, S, &A, &opt, NULL));
    SL_CHECK(sl_factor_submatrix(&T, &G, F, &A, rows, 2, NULL, NULL));
    sl_factor_free(G);
    sl_factor_free(F);
    sl_symbolic_free(T);
    sl_symbolic_free(S);
}

/* The sign of a row that is computed again. */
static void a_restriction_keeps_the_signs(void **state) {
    (void)state;
    static const sl_int p[4] = {0, 2, 4, 5}, i[5] = {0, 1, 1, 2, 2}, rows[2] = {1, 2};
    static const sl_int signs[3] = {1, -1, 1};
    static const double x[5] = {2.0, 1.0, 3.0, 1.0, 2.0};
    const sl_csc A = {3, 3, p, i, x};
    sl_options opt = options_none();
    sl_symbolic *S = analyze_natural(&A, SL_RELAXATION_NONE), *T = NULL;
    sl_factor *F = NULL, *G = NULL;
    opt.regularization = 1e-3;
    opt.signs = signs;
    SL_CHECK(sl_factor_create(&F, S, &A, &opt, NULL));
    SL_CHECK(sl_factor_submatrix(&T, &G, F, &A, rows, 2, NULL, NULL));
    assert_int_equal(sl_factor_view(G).info.negative, 1);
    sl_factor_free(G);
    sl_factor_free(F);
    sl_symbolic_free(T);
    sl_symbolic_free(S);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_factor_answers_as_a_new_one),
        cmocka_unit_test(a_factor_follows_any_other),
        cmocka_unit_test(a_restriction_has_the_options_of_its_factor),
        cmocka_unit_test(a_restriction_keeps_the_limit_of_growth),
        cmocka_unit_test(a_restriction_keeps_the_signs),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

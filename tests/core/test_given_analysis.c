/* test_given_analysis.c: sl_symbolic_edit: with each option, of any analysis, as without one */
#include "tests/lib/given_factors.h"

enum { TRIES = 14 };

/* Options of analyses, each with a value that the result shows. */
static int analysis_options(sl_options *opt, const sl_int *backward) {
    for (int k = 0; k < TRIES; k++) {
        opt[k] = options_none();
    }
    opt[1].ordering = SL_ORDERING_MINDEG;
    opt[2].ordering = SL_ORDERING_NATURAL;
    opt[3].ordering = SL_ORDERING_GIVEN;
    opt[3].perm = backward;
    opt[4].ordering = SL_ORDERING_GIVEN; /* without an order */
    opt[5].ordering = (sl_ordering)31;
    opt[6].relaxation = SL_RELAXATION_NONE;
    opt[7].relaxation = (sl_relaxation)31;
    opt[8].triangle = SL_TRIANGLE_LOWER;
    opt[9].triangle = SL_TRIANGLE_UPPER;
    opt[10].triangle = (sl_triangle)31;
    opt[11].block_size = 2;
    opt[12].block_size = 5; /* does not divide n */
    opt[13].purpose = SL_PURPOSE_ONE_FACTOR;
    return TRIES;
}

/* What follows an analysis: its triangle, and a solution with its factor. */
static sl_status analysis_solve(const sl_symbolic *S, const sl_csc *A, double *x) {
    sl_factor *F = NULL;
    sl_status s = sl_factor_create(&F, S, A, NULL, NULL);
    for (sl_int k = 0; k < N; k++) {
        x[k] = cos(k);
    }
    s = s == SL_OK ? sl_factor_solve(F, x, N, x, N, 1, NULL) : s;
    x[N] = sl_symbolic_view(S).info.triangle;
    sl_factor_free(F);
    return s;
}

/* Edits the analysis S of A into one of B with each option. If all rows are new, the order is the
 * one that the options ask for. */
static int analyses_compare(const sl_symbolic *S, const sl_csc *A, const sl_csc *B,
                            const sl_int *new_of, int is_new, const char *how) {
    sl_int backward[N];
    sl_options opt[TRIES];
    int wrong = 0;
    for (sl_int k = 0; k < N; k++) {
        backward[k] = N - 1 - k;
    }
    const int tries = analysis_options(opt, backward);
    for (int k = 0; k < tries; k++) {
        double x[NUMBERS] = {0.0}, y[NUMBERS] = {0.0};
        sl_symbolic *T = NULL, *U = NULL;
        sl_status s = sl_symbolic_edit(&T, S, A, B, new_of, &opt[k], NULL);
        sl_status expected = sl_symbolic_create(&U, B, &opt[k], NULL);
        int differs = s != expected;
        if (s == SL_OK && expected == SL_OK) {
            s = analysis_solve(T, B, x);
            expected = analysis_solve(U, B, y);
            differs = s != expected || !(difference(x, y) <= 1e-9) ||
                      (is_new && memcmp(sl_symbolic_view(T).perm, sl_symbolic_view(U).perm,
                                        N * sizeof(sl_int)) != 0);
        }
        if (differs) {
            print_error("symbolic_edit, %s, option %d: %s, new %s, difference %g\n", how, k,
                        sl_status_string(s), sl_status_string(expected), difference(x, y));
            wrong++;
        }
        sl_symbolic_free(T);
        sl_symbolic_free(U);
    }
    return wrong;
}

/* Analyses made with any options, edited and loaded ones, and the options of the edit. */
static void an_analysis_follows_any_other(void **state) {
    (void)state;
    world w;
    sl_int backward[N], fresh[N];
    sl_options opt[TRIES];
    int wrong = 0, made = 0;
    world_make(&w);
    for (sl_int k = 0; k < N; k++) {
        backward[k] = N - 1 - k;
        fresh[k] = -1;
    }
    const sl_csc A = sl_matrix_view(w.M[DEFINITE][0]);
    const int tries = analysis_options(opt, backward);
    for (int k = 0; k < 3 * tries; k++) {
        sl_symbolic *S = NULL, *T = NULL;
        sl_status s = sl_symbolic_create(&S, &A, &opt[k / 3], NULL);
        if (s == SL_OK && k % 3 == 1) {
            s = sl_symbolic_edit(&T, S, &A, &A, w.same, NULL, NULL);
        } else if (s == SL_OK && k % 3 == 2) {
            size_t bytes = 0;
            SL_CHECK(pair_save_memory(NULL, &bytes, S, NULL));
            void *memory = test_array(bytes, 1);
            SL_CHECK(pair_save_memory(memory, &bytes, S, NULL));
            s = pair_load_memory(&T, NULL, memory, bytes, SL_LOAD_VERIFIED, NULL);
            free(memory);
        }
        if (s == SL_OK) {
            static const char *const hows[3] = {"created", "edited", "loaded"};
            const sl_symbolic *from = k % 3 == 0 ? S : T;
            wrong += analyses_compare(from, &A, &A, w.same, 0, hows[k % 3]);
            wrong += analyses_compare(from, &A, &A, fresh, 1, hows[k % 3]);
            made++;
        }
        sl_symbolic_free(T);
        sl_symbolic_free(S);
    }
    world_free(&w);
    assert_int_equal(wrong, 0);
    assert_true(made >= 3 * 9);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(an_analysis_follows_any_other),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

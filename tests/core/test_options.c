/* test_options.c: wishes that make no sense: half an allocator and unknown enum values, refused by who reads them */
#include "problem.h"

#define GARBAGE(type) ((type *)(void *)&y)

/* Each call that takes options, with one function of an allocator alone. */
static void half_an_allocator_is_refused(void **state) {
    (void)state;
    problem_t y = problem_make(GEN_GRID2, 25, 1, GEN_STYLES - 1, NULL);
    const sl_int row[1] = {0};
    const double one[1] = {1};
    const char text[] = "%%MatrixMarket matrix coordinate real general\n1 1 1\n1 1 1\n";
    counter_t counter = counter_make();
    sl_int perm[25];
    gen_permutation(perm, 25, 1);
    for (int half = 0; half < 2; half++) {
        sl_options opt = options_counted(&counter);
        if (half) {
            opt.allocator.allocate = NULL;
        } else {
            opt.allocator.release = NULL;
        }
        sl_matrix *M = GARBAGE(sl_matrix);
        sl_symbolic *S = GARBAGE(sl_symbolic);
        sl_factor *F = GARBAGE(sl_factor);
        sl_plan *P = GARBAGE(sl_plan);
        sl_work *W = GARBAGE(sl_work);
        sl_triangle triangle = SL_TRIANGLE_NONE;
        SL_EXPECT(SL_ERR_ARGUMENT, sl_matrix_from_triplets(&M, 1, 1, 1, row, row, one, &opt, NULL));
        assert_null(M);
        M = GARBAGE(sl_matrix);
        SL_EXPECT(SL_ERR_ARGUMENT, sl_matrix_parse(&M, text, strlen(text), &opt, NULL));
        assert_null(M);
        M = GARBAGE(sl_matrix);
        SL_EXPECT(SL_ERR_ARGUMENT, sl_matrix_read(&M, "no_such_file.mtx", &opt, NULL));
        assert_null(M);
        M = GARBAGE(sl_matrix);
        SL_EXPECT(SL_ERR_ARGUMENT, sl_matrix_transpose(&M, &y.M.view, &opt));
        assert_null(M);
        M = GARBAGE(sl_matrix);
        SL_EXPECT(SL_ERR_ARGUMENT, sl_matrix_permute(&M, &y.M.view, perm, &opt));
        assert_null(M);
        M = GARBAGE(sl_matrix);
        SL_EXPECT(SL_ERR_ARGUMENT, sl_factor_lower(&M, y.F, &opt));
        assert_null(M);
        SL_EXPECT(SL_ERR_ARGUMENT, sl_csc_triangle(&y.M.view, &triangle, &opt, NULL));
        assert_int_equal(triangle, SL_TRIANGLE_NONE);
        SL_EXPECT(SL_ERR_ARGUMENT, sl_symbolic_create(&S, &y.M.view, &opt, NULL));
        assert_null(S);
        SL_EXPECT(SL_ERR_ARGUMENT, sl_factor_create(&F, y.S, &y.M.view, &opt, NULL));
        assert_null(F);
        SL_EXPECT(SL_ERR_ARGUMENT, sl_plan_create(&P, y.S, row, 1, row, 1, &opt, NULL));
        assert_null(P);
        SL_EXPECT(SL_ERR_ARGUMENT, sl_work_create(&W, &opt));
        assert_null(W);
    }
    assert_int_equal(counter.calls, 0);
    problem_free(&y);
}

static void unknown_values_are_refused(void **state) {
    (void)state;
    problem_t y = problem_make(GEN_GRID2, 25, 1, 0, NULL);
    static const int unknown[3] = {-1, SL_ORDERING_QUALITY + 1, 1000};
    double X[25] = {1}, Y[25] = {7};
    for (int k = 0; k < 3; k++) {
        sl_options opt = options_none();
        sl_symbolic *S = GARBAGE(sl_symbolic);
        opt.ordering = (sl_ordering)unknown[k];
        SL_EXPECT(SL_ERR_ARGUMENT, sl_symbolic_create(&S, &y.M.view, &opt, NULL));
        assert_null(S);
        opt = options_none();
        opt.relaxation = (sl_relaxation)unknown[k];
        SL_EXPECT(SL_ERR_ARGUMENT, sl_symbolic_create(&S, &y.M.view, &opt, NULL));
        assert_null(S);
        SL_EXPECT(SL_ERR_ARGUMENT,
                  sl_csc_multiply(&y.M.view, (sl_reading)unknown[k], Y, 25, X, 25, 1));
        assert_true(Y[0] == 7);
        SL_EXPECT(SL_ERR_ARGUMENT,
                  sl_csc_write(&y.M.view, (sl_reading)unknown[k], "no/such/folder/file.mtx"));
        sl_factor *F = GARBAGE(sl_factor);
        opt = options_none();
        opt.isa = (sl_isa)(unknown[k] + 100); /* as one that this processor has not */
        SL_EXPECT(SL_ERR_UNSUPPORTED, sl_factor_create(&F, y.S, &y.M.view, &opt, NULL));
        assert_null(F);
    }
    problem_free(&y);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(half_an_allocator_is_refused),
        cmocka_unit_test(unknown_values_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

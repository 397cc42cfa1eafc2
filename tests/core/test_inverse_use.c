/* test_inverse_use.c: entries and blocks of the inverse: memory, range, invalid arguments */
#include "tests/lib/check_inverse.h"

/* ---- memory ---- */

typedef struct call_t {
    const sl_factor *F;
    sl_int rows[40], columns[40];
    double out[40 * 40];
} call_t;

enum { CALLS = 4 };

static sl_status run_call(call_t *q, int which, sl_int count, sl_work *W) {
    switch (which) {
    case 0:
        return sl_inverse_diagonal(q->F, q->out, q->rows, count, W, NULL);
    case 1:
        return sl_inverse_pairs(q->F, q->out, q->rows, q->columns, count, W, NULL);
    case 2:
        return sl_inverse_block(q->F, q->out, 40, q->rows, count, q->columns, count, W, NULL);
    default:
        return sl_inverse_block(q->F, q->out, 40, q->rows, count, q->rows, count, W, NULL);
    }
}

static call_t *call_make(const sl_factor *F, sl_int n) {
    call_t *q = (call_t *)test_array(1, sizeof *q);
    uint64_t seed = 8;
    q->F = F;
    random_rows(q->rows, 40, n, &seed);
    random_rows(q->columns, 40, n, &seed);
    return q;
}

static void a_grown_workspace_allocates_nothing(void **state) {
    (void)state;
    factored_t y = factored_make(GEN_GRID2, 2500, 1, 0, NULL);
    call_t *q = call_make(y.F, 2500);
    for (int which = 0; which < CALLS; which++) {
        counter_t counter = counter_make();
        sl_options opt = options_counted(&counter);
        sl_work *W = NULL;
        SL_CHECK(sl_work_create(&W, &opt));
        SL_CHECK(run_call(q, which, 40, W));
        const size_t calls = counter.calls, bytes = sl_work_bytes(W);
        for (int round = 0; round < 5; round++) {
            SL_CHECK(run_call(q, which, 40, W));
        }
        assert_int_equal(counter.calls, calls);
        assert_int_equal(sl_work_bytes(W), bytes);
        sl_work_free(W);
        COUNTER_CLEAN(&counter);
    }
    free(q);
    factored_free(&y);
}

static void every_allocation_may_fail(void **state) {
    (void)state;
    for (int own = 0; own < 2; own++) {
        for (int which = 0; which < CALLS; which++) {
            counter_t counter = counter_make();
            sl_options opt = options_counted(&counter);
            factored_t y = factored_make(GEN_GRID2, 400, 1, 0, &opt);
            call_t *q = call_make(y.F, 400);
            sl_status status = SL_ERR_MEMORY;
            int failures = 0;
            for (int64_t k = 0; status != SL_OK; k++) {
                sl_work *W = NULL;
                if (!own) {
                    SL_CHECK(sl_work_create(&W, &opt));
                }
                for (int i = 0; i < 40 * 40; i++) {
                    q->out[i] = 4321.5;
                }
                counter.fail_at = (int64_t)counter.calls + k;
                status = run_call(q, which, 40, W);
                counter.fail_at = -1;
                assert_true(status == SL_OK || status == SL_ERR_MEMORY);
                failures += status != SL_OK;
                for (int i = 0; i < 40 * 40 && status != SL_OK; i++) {
                    assert_true(q->out[i] == 4321.5); /* unchanged */
                }
                if (status != SL_OK && W) {
                    SL_CHECK(run_call(q, which, 40, W)); /* the workspace is still usable */
                }
                sl_work_free(W);
            }
            assert_in_range(failures, 1, 4);
            free(q);
            factored_free(&y);
            COUNTER_CLEAN(&counter);
        }
    }
}

/* One pair, by a local solve. */
static void allocations_of_one_pair_may_fail(void **state) {
    (void)state;
    static const sl_int row[1] = {3}, column[1] = {396};
    counter_t counter = counter_make();
    sl_options opt = options_counted(&counter);
    factored_t y = factored_make(GEN_GRID2, 400, 1, 0, &opt);
    sl_status status = SL_ERR_MEMORY;
    double out = 4321.5;
    sl_stats stats;
    sl_int failures = 0;
    for (int64_t k = 0; status != SL_OK; k++) {
        assert_true(out == 4321.5);
        counter.fail_at = (int64_t)counter.calls + k;
        status = sl_inverse_pairs(y.F, &out, row, column, 1, NULL, &stats);
        assert_true(status == SL_OK || status == SL_ERR_MEMORY);
        failures += status != SL_OK;
    }
    assert_true(out != 4321.5 && failures > 0);
    assert_int_equal(stats.inverse.method, SL_INVERSE_FORWARD);
    counter.fail_at = -1;
    factored_free(&y);
    COUNTER_CLEAN(&counter);
}

/* ---- single pairs of large factors, and beyond the range of double ---- */

/* A band of 100 in natural order: the paths of two rows have 6e5 numbers of L. */
static void a_pair_with_long_paths(void **state) {
    (void)state;
    enum { WIDTH = 100, N = 60 * WIDTH };
    static const sl_int rows[3] = {0, N - 1, 17}, columns[3] = {N / 2, 0, 4};
    uint64_t seed = 3;
    gen_list_t t = gen_list(N);
    gen_edges_grid(&t, WIDTH, N / WIDTH, 1, &seed);
    gen_dominate(&t, 1, &seed);
    gen_matrix_t M = gen_store(&t, gen_style(0), 1);
    sl_symbolic *S = analyze_natural(&M.view, SL_RELAXATION_DEFAULT);
    sl_factor *F = NULL;
    double *b = test_reals(N), *x = test_reals(N);
    SL_CHECK(sl_factor_create(&F, S, &M.view, NULL, NULL));
    assert_true(sl_symbolic_view(S).panel_begin[sl_symbolic_view(S).n_supers] > 500000);
    for (int k = 0; k < 3; k++) {
        double got = 0.0;
        memset(b, 0, N * sizeof *b);
        b[columns[k]] = 1.0;
        SL_CHECK(sl_factor_solve(F, x, N, b, N, 1, NULL));
        SL_CHECK(sl_inverse_pairs(F, &got, rows + k, columns + k, 1, NULL, NULL));
        assert_true(fabs(got - x[rows[k]]) <= pass_figure(N) * fabs(x[columns[k]]));
    }
    sl_factor_free(F);
    sl_symbolic_free(S);
    gen_matrix_free(&M);
    gen_list_free(&t);
    free(b);
    free(x);
}

/* L(2, 0) and L(2, 1) are 128 and the last pivot is 2^-1020: their entry of the inverse, which a
 * local solve computes, is 2^1034. One that does not fit is infinite in every call. */
static void an_entry_may_overflow(void **state) {
    (void)state;
    static const sl_int p[4] = {0, 2, 4, 5}, i[5] = {0, 2, 1, 2, 2};
    static const sl_int rows[2] = {0, 2}, columns[2] = {1, 2};
    const double small = ldexp(1.0, -1000), beside = ldexp(1.0, -993), last = ldexp(1.0, -1020);
    const double x[5] = {small, beside, small, beside, ldexp(1.0, -985) + last};
    const sl_csc A = {3, 3, p, i, x};
    sl_symbolic *S = analyze_natural(&A, SL_RELAXATION_NONE);
    sl_factor *F = NULL;
    double one = 0.0, two[2];
    SL_CHECK(sl_factor_create(&F, S, &A, NULL, NULL));
    assert_true(sl_factor_view(F).D[2] == last);
    SL_CHECK(sl_inverse_pairs(F, &one, rows, columns, 1, NULL, NULL));
    SL_CHECK(sl_inverse_pairs(F, two, rows, columns, 2, NULL, NULL));
    assert_true(one == HUGE_VAL && two[0] == HUGE_VAL && two[1] == 1.0 / last);
    sl_factor_free(F);
    sl_symbolic_free(S);
}

/* ---- bytes ---- */

/* Bytes of a workspace for a fixed patch near a corner, per column of its reach, which grows like
 * sqrt(n) on grids. */
static void bytes_of_a_patch(sl_int side, double bytes[CALLS], sl_int *reach) {
    sl_int n = side * side, count = 0, *perm = test_ints((size_t)n);
    gen_list_t t = gen_list(n);
    uint64_t seed = 1;
    sl_options opt = options_none();
    sl_symbolic *S = NULL;
    sl_factor *F = NULL;
    sl_stats stats;
    memset(&stats, 0, sizeof stats);
    gen_edges_grid(&t, side, side, 1, &seed);
    gen_dominate(&t, 1, &seed);
    gen_matrix_t M = gen_store(&t, gen_style(0), 1);
    opt.ordering = SL_ORDERING_GIVEN;
    opt.perm = perm;
    assert_int_equal(gen_dissect(perm, 0, side, 0, side, 0, side), n);
    SL_CHECK(sl_symbolic_create(&S, &M.view, FOR_ANALYSIS(&opt), NULL));
    SL_CHECK(sl_factor_create(&F, S, &M.view, FOR_FACTOR(&opt), NULL));
    call_t *q = call_make(F, n);
    for (sl_int k = 0; k < 40; k++) {
        q->rows[k] = 10 + k % 7 + side * (10 + k / 7);
        q->columns[count++] = 12 + k % 8 + side * (10 + k / 8);
    }
    SL_CHECK(sl_inverse_block(F, q->out, 40, q->rows, 40, q->columns, 40, NULL, &stats));
    *reach = stats.inverse.columns;
    for (int which = 0; which < CALLS; which++) {
        counter_t counter = counter_make();
        sl_work *W = NULL;
        opt = options_counted(&counter);
        SL_CHECK(sl_work_create(&W, &opt));
        SL_CHECK(run_call(q, which, 40, W));
        bytes[which] = (double)counter.total_bytes / (double)stats.inverse.columns;
        sl_work_free(W);
        COUNTER_CLEAN(&counter);
    }
    free(q);
    sl_factor_free(F);
    sl_symbolic_free(S);
    gen_matrix_free(&M);
    gen_list_free(&t);
    free(perm);
}

static void memory_does_not_grow_with_n(void **state) {
    (void)state;
    double first[CALLS], now[CALLS];
    sl_int reach_first, reach;
    bytes_of_a_patch(100, first, &reach_first);
    for (sl_int side = 200; side <= 400; side *= 2) {
        bytes_of_a_patch(side, now, &reach);
        assert_true(reach < reach_first * (side == 200 ? 3 : 6));
        for (int which = 0; which < CALLS; which++) {
            print_message("n = %ld, call %d: %.0f bytes per column of the reach, %.0f at 1e4\n",
                          (long)(side * side), which, now[which], first[which]);
            /* arrays of n elements would need 4 times as much for each column; 2 allows for a
             * kernel with more lanes */
            assert_true(now[which] <= 2.0 * first[which]);
        }
    }
}

/* ---- invalid arguments ---- */

static void invalid_arguments_are_refused(void **state) {
    (void)state;
    factored_t y = factored_make(GEN_GRID2, 25, 1, 0, NULL);
    const sl_int good[3] = {3, 24, 0}, low[3] = {3, -1, 0}, high[3] = {3, 0, 25};
    double out[9];
    sl_stats stats;
    memset(&stats, 0, sizeof stats);
    for (int k = 0; k < 9; k++) {
        out[k] = 4321.5;
    }
#define REFUSED(call) SL_EXPECT(SL_ERR_ARGUMENT, call)
    REFUSED(sl_inverse_diagonal(NULL, out, good, 3, NULL, NULL));
    REFUSED(sl_inverse_diagonal(y.F, NULL, good, 3, NULL, NULL));
    REFUSED(sl_inverse_diagonal(y.F, NULL, NULL, SL_ALL, NULL, NULL));
    REFUSED(sl_inverse_diagonal(y.F, out, good, -1, NULL, NULL));
    REFUSED(sl_inverse_diagonal(y.F, out, low, 3, NULL, &stats));
    assert_int_equal(stats.error.row, -1);
    REFUSED(sl_inverse_diagonal(y.F, out, high, 3, NULL, &stats));
    assert_int_equal(stats.error.row, 25);
    REFUSED(sl_inverse_pairs(NULL, out, good, good, 3, NULL, NULL));
    REFUSED(sl_inverse_pairs(y.F, NULL, good, good, 3, NULL, NULL));
    REFUSED(sl_inverse_pairs(y.F, NULL, good, good + 1, 1, NULL, NULL));
    REFUSED(sl_inverse_pairs(y.F, out, NULL, good, 3, NULL, NULL));
    REFUSED(sl_inverse_pairs(y.F, out, good, NULL, 3, NULL, NULL));
    REFUSED(sl_inverse_pairs(y.F, out, good, good, -1, NULL, NULL));
    REFUSED(sl_inverse_pairs(y.F, out, high, good, 3, NULL, &stats));
    assert_int_equal(stats.error.row, 25);
    assert_int_equal(stats.error.column, -1);
    REFUSED(sl_inverse_pairs(y.F, out, good, high, 3, NULL, &stats));
    assert_int_equal(stats.error.row, -1);
    assert_int_equal(stats.error.column, 25);
    REFUSED(sl_inverse_block(NULL, out, 3, good, 3, good, 3, NULL, NULL));
    REFUSED(sl_inverse_block(y.F, NULL, 3, good, 3, good, 3, NULL, NULL));
    REFUSED(sl_inverse_block(y.F, out, 2, good, 3, good, 3, NULL, NULL));
    REFUSED(sl_inverse_block(y.F, out, 3, NULL, 3, good, 3, NULL, NULL));
    REFUSED(sl_inverse_block(y.F, out, 3, good, 3, NULL, 3, NULL, NULL));
    REFUSED(sl_inverse_block(y.F, out, 3, good, -3, good, 3, NULL, NULL));
    REFUSED(sl_inverse_block(y.F, out, 3, good, 3, good, -3, NULL, NULL));
    REFUSED(sl_inverse_block(y.F, out, 3, low, 3, good, 3, NULL, NULL));
    REFUSED(sl_inverse_block(y.F, out, 3, good, 3, high, 3, NULL, &stats));
    assert_int_equal(stats.error.column, 25);
    for (int k = 0; k < 9; k++) {
        assert_true(out[k] == 4321.5);
    }
    /* empty requests */
    SL_CHECK(sl_inverse_diagonal(y.F, NULL, good, 0, NULL, NULL));
    SL_CHECK(sl_inverse_pairs(y.F, NULL, NULL, NULL, 0, NULL, NULL));
    SL_CHECK(sl_inverse_block(y.F, NULL, 0, NULL, 0, good, 3, NULL, NULL));
    SL_CHECK(sl_inverse_block(y.F, NULL, 0, good, 3, NULL, 0, NULL, NULL));
    /* a failed factor */
    y.M.x[0] = NAN;
    SL_EXPECT(SL_ERR_NOT_FINITE, sl_factor_refactor(y.F, &y.M.view, NULL));
    out[0] = 4321.5;
    SL_EXPECT(SL_ERR_STALE, sl_inverse_diagonal(y.F, out, good, 3, NULL, NULL));
    SL_EXPECT(SL_ERR_STALE, sl_inverse_pairs(y.F, out, good, good, 3, NULL, NULL));
    SL_EXPECT(SL_ERR_STALE, sl_inverse_block(y.F, out, 3, good, 3, good, 3, NULL, NULL));
    assert_true(out[0] == 4321.5);
#undef REFUSED
    factored_free(&y);
}

static void an_empty_matrix_has_an_empty_inverse(void **state) {
    (void)state;
    factored_t y = factored_make(GEN_NONE, 0, 1, 0, NULL);
    const sl_int row = 0;
    double out = 4321.5;
    SL_CHECK(sl_inverse_diagonal(y.F, NULL, NULL, 0, NULL, NULL));
    SL_CHECK(sl_inverse_pairs(y.F, NULL, NULL, NULL, 0, NULL, NULL));
    SL_CHECK(sl_inverse_block(y.F, NULL, 0, NULL, 0, NULL, 0, NULL, NULL));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_inverse_diagonal(y.F, &out, &row, 1, NULL, NULL));
    assert_true(out == 4321.5);
    factored_free(&y);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_grown_workspace_allocates_nothing),
        cmocka_unit_test(every_allocation_may_fail),
        cmocka_unit_test(allocations_of_one_pair_may_fail),
        cmocka_unit_test(a_pair_with_long_paths),
        cmocka_unit_test(an_entry_may_overflow),
        cmocka_unit_test(memory_does_not_grow_with_n),
        cmocka_unit_test(invalid_arguments_are_refused),
        cmocka_unit_test(an_empty_matrix_has_an_empty_inverse),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

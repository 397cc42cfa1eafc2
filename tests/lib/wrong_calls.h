/* wrong_calls.h: wrong calls that sl_error_text has a sentence for: arguments, options, pins */
#ifndef SL_TEST_WRONG_CALLS_H
#define SL_TEST_WRONG_CALLS_H

#include "factored.h"
#include "transposed.h"

enum { N = 100 };

/* What the wrong calls are made with. */
typedef struct wrong_t {
    factored_t y, other; /* two analyses of one matrix */
    sl_factor *failed;   /* without numbers */
    sl_matrix *upper;    /* the transpose of the matrix */
    double x[2 * N], b[2 * N];
} wrong_t;

static wrong_t w;

static inline void wrong_set_up(void) {
    sl_options natural = options_none();
    sl_stats stats;
    double *zeros;
    sl_csc bad;
    natural.ordering = SL_ORDERING_NATURAL;
    w.y = factored_make(GEN_GRID2, N, 1, 0, NULL);
    w.other = factored_make(GEN_GRID2, N, 1, 0, &natural);
    w.upper = transposed(&w.y.M.view);
    SL_CHECK(sl_factor_create(&w.failed, w.y.S, &w.y.M.view, NULL, NULL));
    zeros = test_reals((size_t)w.y.M.p[N]);
    bad = w.y.M.view;
    bad.x = zeros;
    SL_EXPECT(SL_ERR_PIVOT, sl_factor_refactor(w.failed, &bad, &stats));
    free(zeros);
    gen_reals(w.b, 2 * N, 3);
}

static inline void wrong_tear_down(void) {
    sl_matrix_free(w.upper);
    sl_factor_free(w.failed);
    factored_free(&w.y);
    factored_free(&w.other);
}

#define WRONG(name) static inline sl_status name(sl_stats *stats)

/* ---- arguments ---- */

WRONG(no_factor) {
    (void)stats;
    return sl_factor_solve(NULL, w.x, N, w.b, N, 1, NULL);
}

WRONG(small_ldx) {
    (void)stats;
    return sl_factor_solve(w.y.F, w.x, N - 1, w.b, N, 1, NULL);
}

/* A negative number that has become a size_t. */
WRONG(negative_ldx) {
    (void)stats;
    return sl_factor_solve(w.y.F, w.x, (size_t)-7, w.b, N, 1, NULL);
}

WRONG(small_ldb) {
    const sl_int row = 3;
    return sl_local_solve(w.y.F, NULL, SL_ALL, &row, 1, w.x, 1, w.b, 7, 1, NULL, stats);
}

WRONG(in_place) {
    (void)stats;
    return sl_factor_solve(w.y.F, w.x, N, w.x, N + 1, 1, NULL);
}

/* By rows ldx spans the right-hand sides. */
WRONG(small_ldx_of_rows) {
    (void)stats;
    return sl_factor_solve(w.y.F, w.x, SL_ROWS(1), w.b, N, 2, NULL);
}

WRONG(small_ldy) {
    (void)stats;
    return sl_csc_multiply(&w.y.M.view, SL_AS_SYMMETRIC, w.x, 3, w.b, N, 1);
}

WRONG(small_ldr) {
    double r[N];
    (void)stats;
    return sl_csc_residual(&w.y.M.view, r, 0, NULL, w.x, N, w.b, N, 1);
}

WRONG(no_such_row) {
    const sl_int row = N;
    return sl_local_solve(w.y.F, &row, 1, &row, 1, w.x, 1, w.b, 1, 1, NULL, stats);
}

WRONG(row_below_0) {
    const sl_int row = -1;
    sl_plan *P = NULL;
    return sl_plan_create(&P, w.y.S, &row, 1, &row, 1, NULL, stats);
}

WRONG(column_below_0) {
    const sl_int row = 3, column = -1;
    double z;
    return sl_inverse_block(w.y.F, &z, 1, &row, 1, &column, 1, NULL, stats);
}

WRONG(entry_below_0) {
    const sl_int row = 3, column = -2;
    const double delta = 1;
    return sl_factor_change_entries(w.y.F, NULL, &row, &column, &delta, 1, NULL, stats);
}

WRONG(triplet_from_1) {
    const sl_int i[] = {0, 2}, j[] = {0, 1};
    sl_matrix *M = NULL;
    return sl_matrix_from_triplets(&M, 2, 2, 2, i, j, w.b, NULL, stats);
}

/* Number 1 of the second right-hand side of a plan is infinite. */
WRONG(infinite_b) {
    const sl_int rows[] = {5, 8};
    const double b[] = {1, 2, 3, (double)INFINITY};
    sl_plan *P = NULL;
    (void)stats;
    SL_CHECK(sl_plan_create(&P, w.y.S, rows, 2, rows, 2, NULL, NULL));
    const sl_status status = sl_plan_solve(P, w.y.F, w.x, 2, b, 2, 2, NULL);
    sl_plan_free(P);
    return status;
}

/* By rows, in a full solve of more right-hand sides than a block has. */
WRONG(infinite_b_of_rows) {
    enum { COLUMNS = 70 };
    double *X = test_reals(N * COLUMNS), *B = test_reals(N * COLUMNS);
    (void)stats;
    B[7 * COLUMNS + 66] = -(double)INFINITY;
    const sl_status status =
        sl_factor_solve(w.y.F, X, SL_ROWS(COLUMNS), B, SL_ROWS(COLUMNS), COLUMNS, NULL);
    free(X);
    free(B);
    return status;
}

/* b is lost. */
WRONG(infinite_in_place) {
    double b[N] = {(double)INFINITY};
    (void)stats;
    return sl_factor_solve(w.y.F, b, N, b, N, 1, NULL);
}

WRONG(infinite_in_batch) {
    double b[2 * N] = {0};
    sl_request requests[2] = {{NULL, w.x, N, w.b, N, 1, NULL}, {NULL, w.x + N, N, b, N, 1, NULL}};
    (void)stats;
    b[9] = (double)INFINITY;
    return sl_batch_solve(w.y.F, requests, 2, NULL, NULL, NULL);
}

/* G of fixed rows, of which A has couplings, and of pins. */
WRONG(infinite_fixed) {
    const sl_int row = 5;
    const double g[] = {1, (double)INFINITY};
    sl_fixed *D = NULL;
    (void)stats;
    SL_CHECK(sl_fixed_create(&D, &w.y.M.view, &row, 1, NULL, NULL));
    const sl_status status = sl_fixed_solve(D, w.x, N, w.b, N, g, 1, 2, NULL);
    sl_fixed_free(D);
    return status;
}

WRONG(infinite_pin) {
    const sl_int rows[] = {5, 50};
    const double g[] = {1, (double)INFINITY};
    sl_constraints *P = NULL;
    (void)stats;
    SL_CHECK(sl_constraints_create(&P, w.y.F, NULL));
    SL_CHECK(sl_constraints_add(P, rows, NULL, 2, NULL));
    const sl_status status = sl_constraints_solve(P, NULL, w.x, N, w.b, N, g, 2, 1, NULL);
    sl_constraints_free(P);
    return status;
}

WRONG(no_numbers) {
    (void)stats;
    return sl_factor_solve(w.failed, w.x, N, w.b, N, 1, NULL);
}

WRONG(other_analysis) {
    sl_plan *P = NULL;
    (void)stats;
    SL_CHECK(sl_plan_create(&P, w.y.S, NULL, SL_ALL, NULL, SL_ALL, NULL, NULL));
    const sl_status status = sl_plan_solve(P, w.other.F, w.x, N, w.b, N, 1, NULL);
    sl_plan_free(P);
    return status;
}

/* ---- options ---- */

/* An analysis with options that something is wrong with. */
static inline sl_status analyze(const sl_options *opt, sl_stats *stats) {
    sl_symbolic *S = NULL;
    const sl_status status = sl_symbolic_create(&S, &w.y.M.view, opt, stats);
    assert_true(status != SL_OK && S == NULL);
    return status;
}

static inline sl_status factor(const sl_options *opt, sl_stats *stats) {
    sl_factor *F = NULL;
    const sl_status status = sl_factor_create(&F, w.y.S, &w.y.M.view, opt, stats);
    assert_true(status != SL_OK && F == NULL);
    return status;
}

WRONG(no_perm) {
    sl_options opt = options_none();
    opt.ordering = SL_ORDERING_GIVEN;
    return analyze(&opt, stats);
}

WRONG(row_twice_in_perm) {
    sl_options opt = options_none();
    sl_int perm[N];
    for (sl_int k = 0; k < N; k++) {
        perm[k] = k;
    }
    perm[7] = 2;
    opt.ordering = SL_ORDERING_GIVEN;
    opt.perm = perm;
    return analyze(&opt, stats);
}

WRONG(not_initialized) {
    sl_options opt;
    memset(&opt, 0x5a, sizeof opt);
    return analyze(&opt, stats);
}

WRONG(reserved) {
    sl_options opt = options_none();
    opt.reserved[0] = 1;
    return analyze(&opt, stats);
}

WRONG(negative_threads) {
    sl_options opt = options_none();
    opt.threads.count = -1;
    return factor(&opt, stats);
}

WRONG(half_an_allocator) {
    counter_t c = counter_make();
    sl_options opt = options_counted(&c);
    opt.allocator.release = NULL;
    return factor(&opt, stats);
}

WRONG(blocks_do_not_divide) {
    sl_options opt = options_none();
    opt.block_size = 3;
    return analyze(&opt, stats);
}

WRONG(no_ordering) {
    sl_options opt = options_none();
    opt.ordering = (sl_ordering)2;
    return analyze(&opt, stats);
}

WRONG(regularized_and_skipped) {
    sl_options opt = options_none();
    opt.pivots = SL_PIVOTS_SKIP_NULL;
    opt.regularization = 1e-8;
    return factor(&opt, stats);
}

WRONG(wrong_sign) {
    sl_options opt = options_none();
    sl_int signs[N] = {1, 1, 1, 7};
    opt.regularization = 1e-8;
    opt.signs = signs;
    return factor(&opt, stats);
}

WRONG(infinite_weight) {
    sl_options opt = options_none();
    for (int k = 0; k < N; k++) {
        w.x[k] = 1;
    }
    w.x[4] = (double)INFINITY;
    opt.pivots = SL_PIVOTS_SKIP_NULL;
    opt.mass = w.x;
    return factor(&opt, stats);
}

/* ---- patterns ---- */

WRONG(counted_from_1) {
    const sl_int p[] = {0, 1, 2}, i[] = {1, 2};
    const double x[] = {1, 1};
    const sl_csc A = {2, 2, p, i, x};
    sl_symbolic *S = NULL;
    return sl_symbolic_create(&S, &A, NULL, stats);
}

WRONG(negative_row_of_a) {
    const sl_int p[] = {0, 1, 2}, i[] = {0, -1};
    const double x[] = {1, 1};
    const sl_csc A = {2, 2, p, i, x};
    return sl_csc_check(&A, stats);
}

WRONG(other_triangle) {
    const sl_csc A = sl_matrix_view(w.upper);
    return sl_factor_refactor(w.y.F, &A, stats);
}

/* Two rows of one column swapped: the matrix is the same, its pattern is not the analyzed one. */
WRONG(rows_swapped) {
    const sl_csc *A = &w.y.M.view;
    sl_int *i = test_ints((size_t)A->p[N]), p;
    sl_csc B = *A;
    memcpy(i, A->i, (size_t)A->p[N] * sizeof *i);
    p = A->p[5];
    i[p] = A->i[p + 1];
    i[p + 1] = A->i[p];
    B.i = i;
    const sl_status status = sl_factor_refactor(w.y.F, &B, stats);
    free(i);
    return status;
}

WRONG(not_read) {
    static const sl_int p[] = {0, 2, 3, 5}, i[] = {0, 1, 1, 0, 2}, other[] = {0, 1, 1, 1, 2};
    static const double x[] = {2, 1, 2, 1, 2};
    sl_csc A = {3, 3, p, i, x};
    sl_options opt = options_none();
    sl_symbolic *S = NULL;
    sl_factor *F = NULL;
    opt.triangle = SL_TRIANGLE_LOWER;
    SL_CHECK(sl_symbolic_create(&S, &A, &opt, NULL));
    A.i = other;
    opt.triangle = SL_TRIANGLE_NONE;
    sl_status status = sl_factor_create(&F, S, &A, &opt, stats);
    sl_symbolic_free(S);
    return status;
}

WRONG(another_size) {
    const sl_int p[] = {0, 1}, i[] = {0};
    const double x[] = {1};
    const sl_csc A = {1, 1, p, i, x};
    return sl_factor_refactor(w.y.F, &A, stats);
}

/* ---- pins, entries of L, memory ---- */

WRONG(pinned_twice) {
    const sl_int row = 5;
    sl_constraints *P = NULL;
    SL_CHECK(sl_constraints_create(&P, w.y.F, NULL));
    SL_CHECK(sl_constraints_add(P, &row, NULL, 1, NULL));
    const sl_status status = sl_constraints_add(P, &row, NULL, 1, stats);
    sl_constraints_free(P);
    return status;
}

WRONG(depends_on_pins) {
    const sl_int rows[] = {5, 6};
    const double ones[] = {1, 1};
    sl_constraints *P = NULL;
    SL_CHECK(sl_constraints_create(&P, w.y.F, NULL));
    SL_CHECK(sl_constraints_add(P, rows, NULL, 2, NULL));
    const sl_status status = sl_constraints_add(P, rows, ones, 2, stats);
    sl_constraints_free(P);
    return status;
}

WRONG(old_pins) {
    const double g = 1;
    const sl_int row = 5;
    sl_constraints *P = NULL;
    (void)stats;
    SL_CHECK(sl_constraints_create(&P, w.y.F, NULL));
    SL_CHECK(sl_constraints_add(P, &row, NULL, 1, NULL));
    SL_CHECK(sl_factor_refactor(w.y.F, &w.y.M.view, NULL));
    const sl_status status = sl_constraints_solve(P, NULL, w.x, N, w.b, N, &g, 1, 1, NULL);
    sl_constraints_free(P);
    return status;
}

WRONG(not_in_l) {
    const sl_int row = 0, column = N - 1;
    const double delta = 1;
    factored_t path = factored_make(GEN_PATH, N, 1, 0, NULL);
    const sl_status status =
        sl_factor_change_entries(path.F, NULL, &row, &column, &delta, 1, NULL, stats);
    factored_free(&path);
    return status;
}

WRONG(no_memory) {
    sl_work *W = NULL;
    (void)stats;
    counter_t c = counter_make();
    c.fail_at = 0;
    const sl_options opt = options_counted(&c);
    return sl_work_create(&W, &opt);
}

#endif

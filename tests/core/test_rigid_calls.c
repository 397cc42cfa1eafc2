/* test_rigid_calls.c: every call on a factor with several null vectors in each component */
#include "tests/lib/bodies.h"
#include "tests/lib/saved.h"

enum { R = BODIES_RHS };

/* A vertex that is in a body, with all its rows. */
static sl_int body_row(const bodies_t *f, sl_int from) {
    from -= from % f->y.dim;
    while (f->y.body[from] == -1) {
        from += f->y.dim;
    }
    return from;
}

/* The same status from every kind of solve of a right-hand side with one nonzero. A refused one
 * leaves X alone. */
static void expect_solves(const bodies_t *f, sl_status status, const sl_int *rows, const double *b,
                          sl_int count) {
    double *full = test_reals(f->n), *x = test_reals(f->n), *y = test_reals(f->n);
    const sl_int xset[3] = {rows[0], 0, f->y.n - 1};
    sl_plan *P = NULL;
    for (sl_int k = 0; k < count; k++) {
        full[rows[k]] = b[k];
    }
    x[0] = y[0] = -7.5;
    SL_EXPECT(status, sl_factor_solve(f->F, x, f->n, full, f->n, 1, NULL));
    SL_EXPECT(status, sl_factor_solve(f->F, y, SL_ROWS(1), full, SL_ROWS(1), 1, NULL));
    SAME_VALUES(x, y, f->n);
    assert_true((x[0] == -7.5) == (status != SL_OK));
    /* the eleventh of twelve right-hand sides: nothing is written if it is refused */
    double *many = test_reals(12 * f->n), *X = test_reals(12 * f->n);
    memcpy(many + 10 * f->n, full, f->n * sizeof *full);
    X[0] = -7.5;
    SL_EXPECT(status, sl_factor_solve(f->F, X, f->n, many, f->n, 12, NULL));
    assert_true((X[0] == -7.5) == (status != SL_OK));
    free(many);
    free(X);
    y[0] = y[1] = y[2] = -7.5;
    SL_CHECK(sl_plan_create(&P, f->S, rows, count, xset, 3, NULL, NULL));
    SL_EXPECT(status, sl_plan_solve(P, f->F, y, 3, b, (size_t)count, 1, NULL));
    for (int k = 0; k < 3; k++) {
        assert_true(status == SL_OK ? y[k] == x[xset[k]] : y[k] == -7.5);
    }
    SL_EXPECT(status,
              sl_local_solve(f->F, rows, count, xset, 3, y, 3, b, (size_t)count, 1, NULL, NULL));
    sl_plan_free(P);
    free(full);
    free(x);
    free(y);
}

/* Two opposite forces along the line through two vertices are in balance; across it they turn the
 * body. One force moves it. In a row of zeros there is no balance. */
static void check_forces(bodies_t *f, const sl_options *opt) {
    const int dim = f->y.dim;
    (void)opt;
    for (sl_int from = 0; from + dim < f->y.n / 2; from += 5) {
        const sl_int a = body_row(f, from);
        sl_int b = a + dim, rows[6];
        double force[6], length = 0.0;
        while (f->y.body[b] != f->y.body[a] && b + dim < f->y.n) {
            b += dim;
        }
        if (f->y.body[b] != f->y.body[a]) {
            continue;
        }
        for (int c = 0; c < dim; c++) {
            rows[c] = a + c;
            rows[dim + c] = b + c;
            force[c] = f->y.at[b + c] - f->y.at[a + c];
            force[dim + c] = -force[c];
            length += fabs(force[c]);
        }
        expect_solves(f, SL_OK, rows, force, 2 * dim);
        force[0] += 0.01 * length;
        expect_solves(f, SL_ERR_INCONSISTENT, rows, force, 2 * dim);
        force[dim] -= 0.01 * length; /* no resultant, but a moment */
        expect_solves(f, SL_ERR_INCONSISTENT, rows, force, 2 * dim);
    }
    for (sl_int i = 0; i < f->y.n; i++) {
        const double one = 1.0;
        expect_solves(f, SL_ERR_INCONSISTENT, &i, &one, 1);
    }
}

static void inconsistent_right_hand_sides_are_refused(void **state) {
    (void)state;
    for_all(check_forces);
}

/* Y = Z' B, where Z is 1 in one null row each; without Y in these rows B has a solution. */
static void check_defects(bodies_t *f, const sl_options *opt) {
    const size_t nulls = (size_t)f->y.null;
    double *B = test_reals(f->n * R), *Y = test_reals(nulls * R), *X = test_reals(f->n * R);
    (void)opt;
    gen_reals(B, f->n * R, 3);
    SL_EXPECT(SL_ERR_INCONSISTENT, sl_factor_solve(f->F, X, f->n, B, f->n, R, NULL));
    SL_CHECK(sl_factor_defects(f->F, Y, nulls, B, f->n, R, NULL));
    for (size_t r = 0; r < R; r++) {
        for (size_t k = 0; k < nulls; k++) {
            B[(size_t)f->nulls[k] + r * f->n] -= Y[k + r * nulls];
        }
    }
    SL_CHECK(sl_factor_solve(f->F, X, f->n, B, f->n, R, NULL));
    BACKWARD_PASSES(&f->y.A, X, f->n, B, f->n, R);
    memset(B, 0, f->n * R * sizeof *B);
    for (size_t k = 0; k < nulls; k++) { /* a unit in one null row is a unit defect there */
        B[f->nulls[k]] = 1.0;
        SL_CHECK(sl_factor_defects(f->F, Y, nulls, B, f->n, 1, NULL));
        B[f->nulls[k]] = 0.0;
        for (size_t j = 0; j < nulls; j++) {
            assert_true(Y[j] == (j == k ? 1.0 : 0.0));
        }
    }
    free(B);
    free(Y);
    free(X);
}

static void defects_make_right_hand_sides_consistent(void **state) {
    (void)state;
    for_all(check_defects);
}

static void check_refinement(bodies_t *f, const sl_options *opt) {
    double *X = test_reals(f->n * R), rcond = -1.0;
    sl_stats stats;
    (void)opt;
    gen_reals(X, f->n * R, 8);
    SL_CHECK(sl_factor_refine(f->F, &f->y.A, X, f->n, f->B, f->n, R, 5, NULL, &stats));
    assert_true(stats.refine.steps > 0 && stats.refine.backward_error < 1e-14);
    SL_CHECK(sl_factor_rcond(f->F, &f->y.A, &rcond, NULL));
    assert_true(rcond == 0.0);
    free(X);
}

static void solutions_are_refined(void **state) {
    (void)state;
    for_all(check_refinement);
}

/* G is 0 in the null rows and columns, and A G A = A. The other ways to entries of G give the same
 * up to rounding. */
static void check_inverse(bodies_t *f, const sl_options *opt) {
    const sl_int n = f->y.n;
    double *G = test_reals(f->n * f->n), *d = test_reals(f->n), *e = test_reals(f->n);
    double *AG = test_reals(f->n * f->n), *a = test_reals(f->n), largest = 0.0;
    sl_int *all = test_ints(f->n);
    sl_selected *Z = NULL;
    (void)opt;
    for (sl_int i = 0; i < n; i++) {
        all[i] = i;
    }
    SL_CHECK(sl_inverse_block(f->F, G, f->n, all, n, all, n, NULL, NULL));
    for (size_t k = 0; k < f->n * f->n; k++) {
        largest = fmax(largest, fabs(G[k]));
    }
    for (sl_int k = 0; k < f->y.null; k++) {
        for (sl_int i = 0; i < n; i++) {
            assert_true(fabs(G[i + f->nulls[k] * n]) < 1e-290);
            assert_true(fabs(G[f->nulls[k] + i * n]) < 1e-290);
        }
    }
    /* A G is checked on B = A X: A G B = B */
    SL_CHECK(sl_csc_multiply(&f->y.A, SL_AS_SYMMETRIC, AG, f->n, G, f->n, n));
    for (size_t r = 0; r < R; r++) {
        for (size_t i = 0; i < f->n; i++) {
            double sum = 0.0;
            for (size_t k = 0; k < f->n; k++) {
                sum += AG[i + k * f->n] * f->B[k + r * f->n];
            }
            assert_true(fabs(sum - f->B[i + r * f->n]) <= 1e-14 * (double)n * largest);
        }
    }
    SL_CHECK(sl_inverse_diagonal(f->F, d, NULL, SL_ALL, NULL, NULL));
    SL_CHECK(sl_selected_create(&Z, f->F, NULL, SL_ALL, NULL, NULL));
    SL_CHECK(sl_selected_entries(Z, e, all, all, n, NULL));
    SL_CHECK(sl_inverse_pairs(f->F, a, all, all, n, NULL, NULL));
    for (sl_int i = 0; i < n; i++) {
        const double bound = 1e-12 * largest;
        assert_true(fabs(d[i] - G[i + i * n]) <= bound && fabs(e[i] - G[i + i * n]) <= bound);
        assert_true(fabs(a[i] - G[i + i * n]) <= bound);
    }
    sl_selected_free(Z);
    free(G);
    free(AG);
    free(a);
    free(d);
    free(e);
    free(all);
}

static void the_inverse_is_a_generalized_one(void **state) {
    (void)state;
    for_all(check_inverse);
}

/* Solves in a region agree with full solves of consistent right-hand sides. */
static void check_region(bodies_t *f, const sl_options *opt) {
    double *B = test_reals(f->n), *X = test_reals(f->n), largest = 0.0;
    (void)opt;
    for (sl_int size = 2; size <= 40; size += 19) {
        sl_int set[40];
        for (sl_int k = 0; k < size; k++) {
            set[k] = body_row(f, f->y.n / 3) + k;
        }
        sl_region *region = NULL;
        sl_plan *P = NULL;
        sl_options in = options_none();
        SL_CHECK(sl_region_create(&region, f->F, set, size, NULL, NULL, NULL));
        in.region = region;
        SL_CHECK(sl_plan_create(&P, f->S, set, size, set, size, &in, NULL));
        /* the solution that is G b for any b: only its residual may be nonzero in null rows */
        gen_reals(B, (size_t)size, 9);
        double *full = test_reals(f->n), *wanted = test_reals(f->n);
        sl_options any = f->opt;
        sl_factor *F = NULL;
        any.consistency_tolerance = -1.0;
        SL_CHECK(sl_factor_create(&F, f->S, &f->y.A, &any, NULL));
        for (sl_int k = 0; k < size; k++) {
            full[set[k]] = B[k];
        }
        SL_CHECK(sl_factor_solve(F, wanted, f->n, full, f->n, 1, NULL));
        SL_EXPECT(SL_ERR_STALE, sl_plan_solve(P, F, X, (size_t)size, B, (size_t)size, 1, NULL));
        sl_status status = sl_plan_solve(P, f->F, X, (size_t)size, B, (size_t)size, 1, NULL);
        assert_true(status == SL_OK || status == SL_ERR_INCONSISTENT);
        for (size_t i = 0; i < f->n; i++) {
            largest = fmax(largest, fabs(wanted[i]));
        }
        for (sl_int k = 0; k < size && status == SL_OK; k++) {
            assert_true(fabs(X[k] - wanted[set[k]]) <= 1e-11 * largest);
        }
        sl_factor_free(F);
        sl_plan_free(P);
        sl_region_free(region);
        free(full);
        free(wanted);
    }
    free(B);
    free(X);
}

/* A region without a boundary holds whole bodies: right-hand sides are checked as usual. */
static void check_whole_region(bodies_t *f, const sl_options *opt) {
    const sl_int row = body_row(f, 0), set[2] = {row, row + 1};
    const double b[2] = {1.0, 0.0};
    double x[2] = {-7.5, -7.5};
    sl_options bytes = options_none(), in = options_none();
    sl_region *region = NULL;
    sl_plan *P = NULL;
    sl_stats stats;
    (void)opt;
    bytes.region_bytes = 1;
    SL_CHECK(sl_region_create(&region, f->F, set, 2, NULL, &bytes, &stats));
    assert_int_equal(stats.region.boundary, 0);
    in.region = region;
    SL_CHECK(sl_plan_create(&P, f->S, set, 2, set, 2, &in, NULL));
    SL_EXPECT(SL_ERR_INCONSISTENT, sl_plan_solve(P, f->F, x, 2, b, 2, 1, NULL));
    assert_true(x[0] == -7.5 && x[1] == -7.5);
    sl_plan_free(P);
    sl_region_free(region);
}

static void regions_give_the_same_solutions(void **state) {
    (void)state;
    for_all(check_region);
    for_all(check_whole_region);
}

static void check_parts(bodies_t *f, const sl_options *opt) {
    double *X = test_reals(f->n * R);
    (void)opt;
    SL_CHECK(sl_factor_solve_part(f->F, NULL, SL_PART_P | SL_PART_L, X, f->n, f->B, f->n, R, NULL));
    SL_CHECK(sl_factor_solve_part(f->F, NULL, SL_PART_D, X, f->n, X, f->n, R, NULL));
    SL_CHECK(sl_factor_solve_part(f->F, NULL, SL_PART_LT | SL_PART_PT, X, f->n, X, f->n, R, NULL));
    SAME_VALUES(X, f->X, f->n * R);
    free(X);
}

static void half_solves_make_a_solve(void **state) {
    (void)state;
    for_all(check_parts);
}

static void check_saved(bodies_t *f, const sl_options *opt) {
    sl_options any = *opt;
    any.consistency_tolerance = -1.0;
    sl_factor_free(f->F);
    SL_CHECK(sl_factor_create(&f->F, f->S, &f->y.A, &any, NULL));
    saved_t m = saved_make(f->S, f->F);
    for (int way = 0; way < 2; way++) {
        const saved_call_t call = way == 0 ? pair_load_memory : pair_map_memory;
        sl_options use = options_none();
        sl_symbolic *S = NULL;
        sl_factor *G = NULL;
        double *Y = test_reals((size_t)f->y.null), *V = test_reals((size_t)f->y.null);
        use.isa = opt->isa;
        SL_CHECK(call(&S, &G, m.bytes, m.size, SL_LOAD_VERIFIED, &use));
        assert_same_answers(f->F, G);
        SL_CHECK(sl_factor_defects(f->F, Y, (size_t)f->y.null, f->B, f->n, 1, NULL));
        SL_CHECK(sl_factor_defects(G, V, (size_t)f->y.null, f->B, f->n, 1, NULL));
        SAME_VALUES(Y, V, (size_t)f->y.null);
        if (way == 0) {
            SL_CHECK(sl_factor_refactor(G, &f->y.A, NULL));
            assert_same_answers(f->F, G);
        }
        sl_factor_free(G);
        sl_symbolic_free(S);
        free(Y);
        free(V);
    }
    saved_free(&m);
}

static void factors_are_saved(void **state) {
    (void)state;
    for_all(check_saved);
}

static void check_refusals(bodies_t *f, const sl_options *opt) {
    double *Z = test_reals(33 * f->n);
    const sl_int row = body_row(f, 0), p[2] = {0, 1};
    const double one = 1.0;
    const sl_csc v = {f->y.n, 1, p, &row, &one};
    sl_options bad = *opt;
    sl_factor *F = NULL;
    sl_stats stats;
    SL_EXPECT(SL_ERR_UNSUPPORTED, sl_factor_rank_update(f->F, &v, NULL, NULL, NULL));
    bad.null_vector = Z;
    bad.null_vector_count = 33;
    SL_EXPECT(SL_ERR_ARGUMENT, sl_factor_create(&F, f->S, &f->y.A, &bad, NULL));
    bad.null_vector_count = 32;
    Z[31 * f->n + 5] = NAN;
    SL_EXPECT(SL_ERR_ARGUMENT, sl_factor_create(&F, f->S, &f->y.A, &bad, &stats));
    assert_int_equal(stats.error.row, 5);
    bad.null_vector = NULL;
    SL_EXPECT(SL_ERR_ARGUMENT, sl_factor_create(&F, f->S, &f->y.A, &bad, NULL));
    assert_null(F);
    free(Z);
}

static void what_is_not_supported_is_refused(void **state) {
    (void)state;
    for_all(check_refusals);
}

/* L in float: the null pivots within a tree are no entries that float cannot hold, and refinement
 * brings the accuracy of double. */
static void check_float(bodies_t *f, const sl_options *from) {
    sl_options opt = *from;
    sl_factor *F = NULL;
    double *x = test_reals(f->n);
    sl_int *nulls = test_ints(f->n), count = 0;
    opt.storage = SL_STORAGE_FLOAT;
    SL_CHECK(sl_factor_create(&F, f->S, &f->y.A, &opt, NULL));
    SL_CHECK(sl_factor_pivot_rows(F, SL_PIVOT_NULL, nulls, NULL, f->y.n, &count));
    assert_int_equal(count, f->y.null);
    SL_CHECK(sl_factor_solve(F, x, f->n, f->B, f->n, 1, NULL));
    SL_CHECK(sl_factor_refine(F, &f->y.A, x, f->n, f->B, f->n, 1, 5, NULL, NULL));
    BACKWARD_PASSES(&f->y.A, x, f->n, f->B, f->n, 1);
    free(nulls);
    free(x);
    sl_factor_free(F);
}

static void in_single_precision(void **state) {
    (void)state;
    for_all(check_float);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(inconsistent_right_hand_sides_are_refused),
        cmocka_unit_test(defects_make_right_hand_sides_consistent),
        cmocka_unit_test(solutions_are_refined),
        cmocka_unit_test(the_inverse_is_a_generalized_one),
        cmocka_unit_test(regions_give_the_same_solutions),
        cmocka_unit_test(half_solves_make_a_solve),
        cmocka_unit_test(factors_are_saved),
        cmocka_unit_test(what_is_not_supported_is_refused),
        cmocka_unit_test(in_single_precision),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

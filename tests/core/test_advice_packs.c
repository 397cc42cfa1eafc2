/* test_advice_packs.c: whoever does what a text of a call says gets a right answer */
#include "tests/lib/advised_calls.h"
#include "tests/lib/kkt.h"

/* Each call below is refused with its text, and with `heeds` does what the text says. */

static const sl_int ends[] = {0, N - 1};

/* Solves in a region, if it was made. Releases it and F. */
static sl_status in_region(sl_factor *F, sl_region *R, sl_status status) {
    const double two[] = {1.0, -1.0};
    double local[2];
    sl_options opt = options_none();
    sl_plan *P = NULL;
    opt.region = R;
    if (status == SL_OK) {
        SL_CHECK(sl_plan_create(&P, grid.S, ends, 2, ends, 2, &opt, NULL));
        status = sl_plan_solve(P, F, local, 2, two, 2, 1, NULL);
    }
    status = as_in_full(F, local, status);
    sl_plan_free(P);
    sl_region_free(R);
    sl_factor_free(F);
    return status;
}

/* ---- objects of older numbers ---- */

static sl_status stale_pins(int heeds) {
    const sl_int row = 5;
    const double g = 0.0;
    sl_factor *F = factor_of(grid.S, &grid.M.view, NULL);
    sl_constraints *P = NULL;
    SL_CHECK(sl_constraints_create(&P, F, NULL));
    SL_CHECK(sl_constraints_add(P, &row, NULL, 1, NULL));
    SL_CHECK(sl_factor_refactor(F, &grid.M.view, NULL));
    if (heeds) {
        SL_CHECK(sl_constraints_refactor(P, NULL));
    }
    const sl_status status = sl_constraints_solve(P, NULL, x, N, b, N, &g, 1, 1, NULL);
    sl_constraints_free(P);
    sl_factor_free(F);
    return judged(&grid.M.view, row, status);
}

static sl_status stale_inverse(int heeds) {
    sl_factor *F = factor_of(grid.S, &grid.M.view, NULL);
    sl_selected *Z = NULL;
    sl_region *R = NULL;
    SL_CHECK(sl_selected_create(&Z, F, NULL, SL_ALL, NULL, NULL));
    SL_CHECK(sl_factor_refactor(F, &grid.M.view, NULL));
    if (heeds) {
        SL_CHECK(sl_selected_refactor(Z, F, NULL));
    }
    const sl_status status = sl_region_create(&R, F, ends, 2, Z, NULL, NULL);
    sl_selected_free(Z);
    return in_region(F, R, status);
}

static sl_status stale_region(int heeds) {
    sl_factor *F = factor_of(grid.S, &grid.M.view, NULL);
    sl_region *R = NULL;
    SL_CHECK(sl_region_create(&R, F, ends, 2, NULL, NULL, NULL));
    SL_CHECK(sl_factor_refactor(F, &grid.M.view, NULL));
    if (heeds) {
        SL_CHECK(sl_region_refactor(R, F, NULL, NULL));
    }
    return in_region(F, R, SL_OK);
}

static sl_status uncertified(int heeds) {
    double bounds[N];
    sl_factor *F = factor_of(grid.S, &grid.M.view, NULL);
    sl_plan *P = NULL;
    SL_CHECK(sl_plan_create(&P, grid.S, NULL, SL_ALL, NULL, SL_ALL, NULL, NULL));
    if (heeds) {
        SL_CHECK(sl_factor_certify(F, &grid.M.view, SL_ESTIMATED, NULL, NULL));
    }
    const sl_status status = sl_plan_solve_bounded(P, F, x, N, bounds, b, N, 1, NULL, NULL, NULL);
    sl_plan_free(P);
    sl_factor_free(F);
    return judged(&grid.M.view, -1, status);
}

static sl_status failed_fixed(int heeds) {
    const sl_int row = 5;
    const double g = 0.0;
    double *zeros = test_reals((size_t)grid.M.p[N]);
    sl_csc Z = grid.M.view;
    sl_fixed *D = NULL;
    Z.x = zeros;
    SL_CHECK(sl_fixed_create(&D, &grid.M.view, &row, 1, NULL, NULL));
    SL_EXPECT(SL_ERR_PIVOT, sl_fixed_refactor(D, &Z, NULL));
    if (heeds) {
        SL_CHECK(sl_fixed_refactor(D, &grid.M.view, NULL));
    }
    const sl_status status = sl_fixed_solve(D, x, N, b, N, &g, 1, 1, NULL);
    sl_fixed_free(D);
    free(zeros);
    return judged(&grid.M.view, row, status);
}

/* ---- plans and regions ---- */

static sl_status plan_in_region(int heeds) {
    const double two[] = {1.0, -1.0};
    double local[2];
    sl_options opt = options_none();
    sl_region *R = NULL;
    sl_constraints *C = NULL;
    sl_plan *P = NULL;
    SL_CHECK(sl_region_create(&R, grid.F, ends, 2, NULL, NULL, NULL));
    opt.region = heeds ? NULL : R;
    SL_CHECK(sl_plan_create(&P, grid.S, ends, 2, ends, 2, &opt, NULL));
    SL_CHECK(sl_constraints_create(&C, grid.F, NULL));
    const sl_status status = sl_constraints_solve(C, P, local, 2, two, 2, NULL, 1, 1, NULL);
    sl_constraints_free(C);
    sl_plan_free(P);
    sl_region_free(R);
    return as_in_full(grid.F, local, status);
}

static sl_status foreign_region(int heeds) {
    sl_options natural = options_none(), opt = options_none();
    sl_symbolic *S = NULL;
    sl_plan *P = NULL;
    sl_region *R = NULL;
    double local[2];
    const double two[] = {1.0, -1.0};
    natural.ordering = SL_ORDERING_NATURAL;
    SL_CHECK(sl_symbolic_create(&S, &grid.M.view, &natural, NULL));
    sl_factor *F = factor_of(S, &grid.M.view, NULL);
    SL_CHECK(sl_region_create(&R, heeds ? grid.F : F, ends, 2, NULL, NULL, NULL));
    opt.region = R;
    sl_status status = sl_plan_create(&P, grid.S, ends, 2, ends, 2, &opt, NULL);
    status = status == SL_OK ? sl_plan_solve(P, grid.F, local, 2, two, 2, 1, NULL) : status;
    sl_plan_free(P);
    sl_region_free(R);
    sl_factor_free(F);
    sl_symbolic_free(S);
    return as_in_full(grid.F, local, status);
}

/* Both sets of a local solve of a KKT system get the rows that one call lists. */
static sl_status regularized_rows(int heeds) {
    kkt_t k = kkt_make(90, 0, SL_ORDERING_ND);
    sl_options opt = options_none();
    sl_int set[N] = {0, 1}, rows[N], count = 0, all = 0;
    double local[N], two[N] = {1.0, -1.0}, whole[N] = {1.0, -1.0};
    sl_plan *P = NULL;
    opt.regularization = 1e-7;
    opt.signs = k.signs;
    sl_factor *F = factor_of(k.S, &k.M.view, &opt);
    if (heeds) {
        SL_CHECK(sl_factor_pivot_rows(F, SL_PIVOT_REGULARIZED, rows, NULL, N, &count));
    }
    all = 2;
    for (sl_int m = 0; m < count; m++) {
        if (rows[m] > 1) {
            set[all++] = rows[m];
        }
    }
    SL_CHECK(sl_plan_create(&P, k.S, set, all, set, all, NULL, NULL));
    const sl_status status =
        sl_plan_solve_regularized(P, F, local, (size_t)all, two, (size_t)all, 1, 20, NULL, NULL);
    if (status == SL_OK) {
        sl_symbolic *S = NULL;
        SL_CHECK(sl_symbolic_create_pivoted(&S, &k.M.view, NULL, NULL));
        sl_factor *G = factor_of(S, &k.M.view, NULL);
        SL_CHECK(sl_factor_solve(G, x, N, whole, N, 1, NULL));
        sl_factor_free(G);
        sl_symbolic_free(S);
        for (sl_int m = 0; m < all; m++) {
            assert_true(fabs(local[m] - x[set[m]]) <= 1e-6 * (1.0 + fabs(x[set[m]])));
        }
    }
    sl_plan_free(P);
    sl_factor_free(F);
    kkt_free(&k);
    return status;
}

/* ---- bounds, refinement, parts ---- */

static sl_status neither_certainty(int heeds) {
    sl_factor *F = factor_of(grid.S, &grid.M.view, NULL);
    const sl_certainty which = heeds ? SL_GUARANTEED : SL_UNCERTIFIED;
    const sl_status status = sl_factor_certify(F, &grid.M.view, which, NULL, NULL);
    sl_factor_free(F);
    return status;
}

static sl_status limit_of_errors(int heeds) {
    sl_options opt = options_none();
    opt.error_limit = heeds ? 0.0 : 1e-300;
    sl_factor *F = factor_of(grid.S, &grid.M.view, &opt);
    SL_CHECK(sl_factor_solve(F, x, N, b, N, 1, NULL));
    const sl_status status = sl_factor_refine(F, &grid.M.view, x, N, b, N, 1, 3, NULL, NULL);
    sl_factor_free(F);
    return judged(&grid.M.view, -1, status);
}

/* All parts solve; with pivots of both signs, or 2x2 ones, D has no root. The values that select
 * pivots may be others. */
static sl_status parts_of(const double *selected, const double *values, int heeds) {
    static const sl_int p[] = {0, 2, 3}, i[] = {0, 1, 1};
    const sl_csc A = {2, 2, p, i, values}, first = {2, 2, p, i, selected};
    const unsigned around = SL_PART_P | SL_PART_L | SL_PART_LT | SL_PART_PT;
    sl_symbolic *S = NULL;
    SL_CHECK(sl_symbolic_create_pivoted(&S, &first, NULL, NULL));
    sl_factor *F = factor_of(S, &A, NULL);
    const unsigned parts = around | (heeds ? SL_PART_D : SL_PART_SQRT_D);
    const sl_status status = sl_factor_solve_part(F, NULL, parts, x, 2, b, 2, 1, NULL);
    sl_factor_free(F);
    sl_symbolic_free(S);
    return judged(&A, -1, status);
}

static sl_status root_of_negative(int heeds) {
    static const double values[] = {4.0, 1.0, -3.0};
    return parts_of(values, values, heeds);
}

static sl_status root_of_pair(int heeds) {
    static const double selected[] = {0.0, 1.0, 0.0}, definite[] = {2.0, 1.0, 2.0};
    return parts_of(selected, definite, heeds);
}

static sl_status unknown_part(int heeds) {
    sl_plan *P = NULL;
    sl_int count = 0;
    SL_CHECK(sl_plan_create(&P, grid.S, ends, 2, ends, 2, NULL, NULL));
    const sl_status status = sl_plan_columns(P, heeds ? SL_PART_LT : SL_PART_D, NULL, 0, &count);
    assert_true(status != SL_OK || count > 0);
    sl_plan_free(P);
    return status;
}

static sl_status unknown_kind(int heeds) {
    sl_int count = -1;
    const sl_pivot_kind kind = heeds ? SL_PIVOT_NULL : (sl_pivot_kind)7;
    const sl_status status = sl_factor_pivot_rows(grid.F, kind, NULL, NULL, 0, &count);
    assert_true(status != SL_OK || count == 0);
    return status;
}

/* ---- null vectors ---- */

/* D L D for the Laplacian L of a path: its null vector is D^-1 1. b is in its range. */
static sl_status scaled_path(sl_status (*call)(sl_factor *F, const sl_csc *A), int has_mass,
                             int heeds) {
    enum { M = 12 };
    sl_int p[M + 1], i[2 * M];
    double values[2 * M], d[M], null[M], mass[M];
    sl_int at = 0;
    for (sl_int k = 0; k < M; k++) {
        d[k] = 1.0 + 0.25 * (double)(k % 3);
        null[k] = 1.0 / d[k];
        mass[k] = 1.0;
    }
    for (sl_int k = 0; k < M; k++) {
        p[k] = at;
        i[at] = k;
        values[at++] = d[k] * d[k] * (k == 0 || k == M - 1 ? 1.0 : 2.0);
        if (k + 1 < M) {
            i[at] = k + 1;
            values[at++] = -d[k] * d[k + 1];
        }
    }
    p[M] = at;
    const sl_csc A = {M, M, p, i, values};
    sl_options opt = skipping();
    sl_symbolic *S = NULL;
    opt.mass = has_mass ? mass : NULL;
    opt.null_vector = heeds ? null : NULL;
    SL_CHECK(sl_symbolic_create(&S, &A, NULL, NULL));
    sl_factor *F = factor_of(S, &A, &opt);
    const sl_status status = call(F, &A);
    sl_factor_free(F);
    sl_symbolic_free(S);
    return status;
}

static sl_status certified(sl_factor *F, const sl_csc *A) {
    return sl_factor_certify(F, A, SL_ESTIMATED, NULL, NULL);
}

static sl_status bounds_of_unknown_null(int heeds) {
    return scaled_path(certified, 1, heeds);
}

/* Held in one row, x solves the others for any b. */
static sl_status pinned(sl_factor *F, const sl_csc *A) {
    const sl_int row = 0;
    const double g = 0.0;
    sl_constraints *P = NULL;
    SL_CHECK(sl_constraints_create(&P, F, NULL));
    sl_status status = sl_constraints_add(P, &row, NULL, 1, NULL);
    if (status == SL_OK) {
        status = sl_constraints_solve(P, NULL, x, N, b, N, &g, 1, 1, NULL);
    }
    sl_constraints_free(P);
    return judged(A, row, status);
}

static sl_status pins_of_unknown_null(int heeds) {
    return scaled_path(pinned, 0, heeds);
}

/* In a region, for b on two rows in the range of A. */
static sl_status solved_in_region(sl_factor *F, const sl_csc *A) {
    static const sl_int rows[] = {0, 1};
    const double two[] = {1.0, -1.25};
    double local[2], whole[N] = {1.0, -1.25};
    sl_options opt = options_none();
    sl_region *R = NULL;
    sl_plan *P = NULL;
    sl_status status = sl_region_create(&R, F, rows, 2, NULL, NULL, NULL);
    if (status == SL_OK) {
        opt.region = R;
        SL_CHECK(sl_plan_create(&P, sl_factor_view(F).symbolic, rows, 2, rows, 2, &opt, NULL));
        SL_CHECK(sl_plan_solve(P, F, local, 2, two, 2, 1, NULL));
        SL_CHECK(sl_factor_solve(F, whole, (size_t)A->n_cols, whole, (size_t)A->n_cols, 1, NULL));
        assert_true(fabs(local[0] - whole[0]) + fabs(local[1] - whole[1]) <= 1e-9);
    }
    sl_plan_free(P);
    sl_region_free(R);
    return status;
}

static sl_status region_with_mass(int heeds) {
    return scaled_path(solved_in_region, !heeds, heeds);
}

/* Two blocks v v' of 3 rows in one tree, which a zero joins: each has two null vectors. b is v.
 * Both blocks need columns of their own. */
static sl_status null_columns(int columns, int has_mass, sl_certainty certainty) {
    static const sl_int p[] = {0, 3, 5, 7, 10, 12, 13};
    static const sl_int i[] = {0, 1, 2, 1, 2, 2, 3, 3, 4, 5, 4, 5, 5};
    static const double values[] = {1, 1, 1, 1, 1, 1, 0, 1, 1, 1, 1, 1, 1};
    static const double shared[] = {1, -1, 0, 1, -1, 0, 0, 1, -1, 0, 1, -1};
    static const double own[] = {1, -1, 0, 0, 0,  0, 0, 1, -1, 0, 0, 0,
                                 0, 0,  0, 1, -1, 0, 0, 0, 0,  0, 1, -1};
    const double v[] = {1, 1, 1, 1, 1, 1};
    const sl_csc A = {6, 6, p, i, values};
    sl_options opt = skipping();
    sl_symbolic *S = NULL;
    sl_factor *F = NULL;
    opt.null_vector = columns == 2 ? shared : own;
    opt.null_vector_count = columns;
    opt.mass = has_mass ? v : NULL;
    SL_CHECK(sl_symbolic_create(&S, &A, NULL, NULL));
    sl_status status = sl_factor_create(&F, S, &A, &opt, NULL);
    if (status == SL_OK && certainty != SL_UNCERTIFIED) {
        status = sl_factor_certify(F, &A, certainty, NULL, NULL);
    } else if (status == SL_OK) {
        SL_CHECK(sl_factor_solve(F, x, 6, v, 6, 1, NULL));
        assert_true(fabs(x[0] + x[1] + x[2] - 1.0) + fabs(x[3] + x[4] + x[5] - 1.0) <= 1e-12);
    }
    sl_factor_free(F);
    sl_symbolic_free(S);
    return status;
}

static sl_status too_few_null_columns(int heeds) {
    return null_columns(heeds ? 4 : 2, 0, SL_UNCERTIFIED);
}

static sl_status bounds_of_several_nulls(int heeds) {
    return null_columns(4, !heeds, SL_ESTIMATED);
}

/* Two paths of 3 rows, of which one has no fixed row. */
static sl_status unfixed_component(int heeds) {
    static const sl_int p[] = {0, 2, 4, 5, 7, 9, 10}, i[] = {0, 1, 1, 2, 2, 3, 4, 4, 5, 5};
    static const double values[] = {1, -1, 2, -1, 1, 1, -1, 2, -1, 1};
    const sl_csc A = {6, 6, p, i, values};
    const sl_int rows[] = {0, 3};
    const double g[] = {0.0, 0.0};
    sl_fixed *D = NULL;
    sl_status status = sl_fixed_create(&D, &A, rows, heeds ? 2 : 1, NULL, NULL);
    if (status == SL_OK) {
        double f[6] = {0.0, 1.0, 2.0, 0.0, 3.0, 4.0};
        SL_CHECK(sl_fixed_solve(D, x, 6, f, 6, g, 2, 1, NULL));
        assert_true(fabs(2.0 * x[4] - x[5] - 3.0) + fabs(x[5] - x[4] - 4.0) <= 1e-12);
    }
    sl_fixed_free(D);
    return status;
}

/* ---- edits ---- */

static sl_status edited(const sl_symbolic *S, const sl_csc *A, sl_symbolic *own) {
    sl_symbolic *E = NULL;
    sl_int *new_of = test_ints((size_t)A->n_cols);
    for (sl_int k = 0; k < A->n_cols; k++) {
        new_of[k] = k;
    }
    sl_status status = sl_symbolic_edit(&E, S, A, A, new_of, NULL, NULL);
    if (status == SL_OK) {
        sl_factor *F = factor_of(E, A, NULL);
        SL_CHECK(sl_factor_solve(F, x, N, b, N, 1, NULL));
        sl_factor_free(F);
    }
    sl_symbolic_free(E);
    sl_symbolic_free(own);
    free(new_of);
    return judged(A, -1, status);
}

static sl_status edit_of_pivoted(int heeds) {
    sl_symbolic *S = NULL;
    SL_CHECK(sl_symbolic_create_pivoted(&S, &grid.M.view, NULL, NULL));
    return edited(heeds ? grid.S : S, &grid.M.view, S);
}

static sl_status edit_of_submatrix(int heeds) {
    sl_symbolic *S = NULL;
    sl_factor *G = NULL;
    sl_int rows[N];
    for (sl_int k = 0; k < N; k++) {
        rows[k] = k;
    }
    SL_CHECK(sl_factor_submatrix(&S, &G, grid.F, &grid.M.view, rows, N, NULL, NULL));
    sl_factor_free(G);
    return edited(heeds ? grid.S : S, &grid.M.view, S);
}

/* ---- complex storage ---- */

/* [1 i; -i 1] has the null vector (1, i), which is two of the real matrix. */
static sl_status null_in_complex(int heeds) {
    static const sl_int p[] = {0, 2, 3}, i[] = {0, 1, 1};
    static const double h[] = {1, 0, 0, -1, 1, 0}, z[] = {1, 0, 0, 1, 0, 1, -1, 0};
    static const double right[] = {1, 0, 0, -1};
    const sl_hermitian H = {2, p, i, h, NULL};
    sl_options opt = skipping(), pairs = options_none();
    sl_matrix *M = NULL;
    sl_symbolic *S = NULL;
    sl_factor *F = NULL;
    opt.storage = SL_STORAGE_COMPLEX;
    pairs.block_size = 2;
    opt.null_vector = z;
    opt.null_vector_count = heeds ? 2 : 1;
    SL_CHECK(sl_matrix_from_hermitian(&M, &H, NULL, NULL));
    const sl_csc A = sl_matrix_view(M);
    SL_CHECK(sl_symbolic_create(&S, &A, &pairs, NULL));
    const sl_status status = sl_factor_create(&F, S, &A, &opt, NULL);
    if (status == SL_OK) {
        SL_CHECK(sl_factor_solve(F, x, 4, right, 4, 1, NULL));
        assert_true(fabs(x[0] - x[3] - 1.0) + fabs(x[1] + x[2]) <= 1e-15);
    }
    sl_factor_free(F);
    sl_symbolic_free(S);
    sl_matrix_free(M);
    return status;
}

static const advice_t advices[] = {
    {"SL_STORAGE_COMPLEX: blocks of 2 rows, 2 null vectors, not regularized", null_in_complex},
    {"F has changed since the pins were made: sl_constraints_refactor", stale_pins},
    {"Z is not of the present F: sl_selected_refactor", stale_inverse},
    {"the region of the plan is not of the present F: sl_region_refactor", stale_region},
    {"the present F is not certified: sl_factor_certify", uncertified},
    {"the last sl_fixed_refactor has failed", failed_fixed},
    {"this call takes no plan in a region: create one without options.region", plan_in_region},
    {"options.region is a region of another analysis", foreign_region},
    {"a region with options.mass", region_with_mass},
    {"a set lacks this regularized row; sl_factor_pivot_rows lists all", regularized_rows},
    {"certainty is neither SL_ESTIMATED nor SL_GUARANTEED", neither_certainty},
    {"the backward error is above options.error_limit", limit_of_errors},
    {"SL_PART_SQRT_D with a pivot below 0", root_of_negative},
    {"SL_PART_SQRT_D with 2x2 pivots", root_of_pair},
    {"part is neither SL_PART_L nor SL_PART_LT", unknown_part},
    {"kind is not a value of sl_pivot_kind", unknown_kind},
    {"bounds with options.mass and a null vector that is not known: set options.null_vector",
     bounds_of_unknown_null},
    {"null vectors of F are not known in the tree of this row: options.null_vector",
     pins_of_unknown_null},
    {"A has more null vectors than columns are given, options.null_vector_count",
     too_few_null_columns},
    {"bounds with options.mass and several null vectors: leave out options.mass",
     bounds_of_several_nulls},
    {"the free rows are singular: fix a row of this component, or see options.pivots and "
     "sl_symbolic_create_pivoted",
     unfixed_component},
    {"an analysis of sl_symbolic_create_pivoted", edit_of_pivoted},
    {"an analysis of sl_factor_submatrix", edit_of_submatrix},
};

static void advice_of_packs_is_right(void **state) {
    (void)state;
    follow_all(advices, sizeof advices / sizeof *advices);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(advice_of_packs_is_right),
    };
    return cmocka_run_group_tests(tests, advice_set_up, advice_tear_down);
}

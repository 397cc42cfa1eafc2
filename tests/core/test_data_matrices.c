/* test_data_matrices.c: real matrices of $SL_DATA are solved, or refused with a row */
#include "tests/lib/real_data.h"
#include "tests/lib/transposed.h"

#include "tools/io/input.h"
#include "tools/io/matrix_file.h"

/* Matrices that need no pivoting. Their inertia is that of dense eigenvalues or, above n = 2600,
 * that of another LDL' code. */
typedef struct known_matrix_t {
    const char *name;
    sl_int positive, negative;
    /* 1: the bound DATA_STABLE; 0: pass_figure, since entries of L may grow */
    int is_stable;
} known_matrix_t;

static const known_matrix_t known[] = {
    {"LFAT5.mtx", 14, 0, 1},
    {"bcsstk01.rb", 48, 0, 1},
    {"k01up_cholmod.txt", 48, 0, 1},
    {"pts5ldd03.mtx", 161, 0, 1},
    {"nos5.mtx.gz", 468, 0, 1},
    {"1138_bus.mtx", 1138, 0, 1},
    {"bcsstk16_csparse.txt.gz", 4884, 0, 1},
    {"lap2D_5pt_n100.mtx.gz", 10000, 0, 1},
    {"hs21_3x3_K_0.mtx", 10, 7, 1},
    {"primalc1_3x3_K_0.mtx.gz", 448, 454, 1},
    {"cvxqp1_m_3x3_K_0.mtx.gz", 4500, 3000, 1},
    {"cvxqp1_m_3x3_K_10.mtx.gz", 4500, 3000, 0}, /* quasi-definite, but pivots down to 1e-8 */
    {"stcqp1_2x2_K_0.mtx.gz", 10246, 12291, 1},
    {"c-41.mtx.gz", 5449, 4320, 0},
    {"bcsstm34.mtx.gz", 351, 237, 0},
};

static const known_matrix_t *known_as(const char *path) {
    for (size_t k = 0; k < sizeof known / sizeof known[0]; k++) {
        if (strcmp(dataset_basename(path), known[k].name) == 0) {
            return &known[k];
        }
    }
    return NULL;
}

static sl_matrix *read_or_fail(const char *path) {
    char message[300];
    sl_matrix *M = NULL;
    if (!matrix_file_read(&M, path, message, sizeof message)) {
        print_error("%s\n", message);
        fail();
    }
    return M;
}

/* The path of the file called name, which the caller frees. Skips the test if there is none. */
static char *path_or_skip(const char *name) {
    dataset d = data_or_skip("matrices");
    const char *path = data_find(&d, name);
    char *copy = path ? (char *)test_array(strlen(path) + 1, 1) : NULL;
    if (copy) {
        memcpy(copy, path, strlen(path));
    }
    dataset_free(&d);
    if (!copy) {
        TEST_SKIP("SL_DATA has no %s", name);
    }
    return copy;
}

static sl_matrix *read_or_skip(const char *name) {
    char *path = path_or_skip(name);
    sl_matrix *M = read_or_fail(path);
    free(path);
    return M;
}

/* Reads both or skips the test. */
static void read_both_or_skip(const char *one, sl_matrix **M, const char *other, sl_matrix **N) {
    free(path_or_skip(one));
    *N = read_or_skip(other);
    *M = read_or_skip(one);
}

/* ---- matrices that need no pivoting ---- */

/* Local solves of 1 and 3 right-hand sides on random sets of one to many rows. */
static void check_local_solves(const sl_symbolic *S, const sl_factor *F, sl_int n, sl_work *W) {
    const sl_int sizes[4][2] = {{1, 1}, {1, -1}, {n / 50 + 1, n / 10 + 1}, {n / 2, n / 200 + 2}};
    for (int k = 0; k < 4; k++) {
        for (sl_int nrhs = 1; nrhs <= 3; nrhs += 2) {
            local_solve_t q =
                local_solve_random(F, n, sizes[k][0], sizes[k][1], nrhs, (uint64_t)(17 * k + nrhs));
            local_solve_check(S, F, &q, W);
            local_solve_free(&q);
        }
    }
}

/* Returns the largest backward error over all instruction sets. */
static double check_known(const known_matrix_t *reference, const sl_csc *A, sl_ordering ordering,
                          sl_work *W) {
    isa_list_t isas = isas_present();
    sl_options opt = options_none();
    sl_symbolic *S = NULL;
    sl_int n = A->n_cols;
    double allowed = reference->is_stable ? DATA_STABLE : pass_figure(n), worst = 0.0;
    opt.ordering = ordering;
    SL_CHECK(sl_symbolic_create(&S, A, FOR_ANALYSIS(&opt), NULL));
    for (int k = 0; k < isas.count; k++) {
        sl_factor *F = NULL;
        sl_stats stats;
        memset(&stats, 0, sizeof stats);
        opt.isa = isas.isa[k];
        SL_CHECK(sl_factor_create(&F, S, A, FOR_FACTOR(&opt), &stats));
        assert_int_equal(stats.factor.isa, isas.isa[k]);
        assert_int_equal(stats.factor.positive, reference->positive);
        assert_int_equal(stats.factor.negative, reference->negative);
        assert_int_equal(stats.factor.null, 0);
        for (sl_int nrhs = 1; nrhs <= 3; nrhs += 2) {
            worst = fmax(worst, data_solve(F, A, nrhs, allowed, W));
        }
        check_local_solves(S, F, n, W);
        sl_factor_free(F);
    }
    sl_symbolic_free(S);
    return worst;
}

static void known_matrices_are_solved_accurately(void **state) {
    (void)state;
    dataset d = data_or_skip("matrices");
    double stable = 0.0;
    size_t count = 0;
    sl_work *W = NULL;
    SL_CHECK(sl_work_create(&W, NULL));
    for (size_t k = 0; k < d.count; k++) {
        const known_matrix_t *reference = known_as(d.paths[k]);
        if (reference) {
            sl_matrix *M = read_or_fail(d.paths[k]);
            sl_csc A = sl_matrix_view(M);
            double worst = check_known(reference, &A, SL_ORDERING_ND, W);
            if (A.n_cols <= 2000) { /* the fill of the natural order is acceptable */
                worst = fmax(worst, check_known(reference, &A, SL_ORDERING_NATURAL, W));
            }
            stable = reference->is_stable ? fmax(stable, worst) : stable;
            count++;
            sl_matrix_free(M);
        }
    }
    print_message("%lu of %lu known matrices solved; backward error up to %.1f eps where stable\n",
                  (unsigned long)count, (unsigned long)(sizeof known / sizeof known[0]),
                  stable / DBL_EPSILON);
    sl_work_free(W);
    dataset_free(&d);
}

/* ---- matrices that may need pivoting ---- */

/* Solved accurately, or refused with a valid row; returns the status. */
static sl_status solved_or_refused(const sl_csc *A, sl_ordering ordering) {
    isa_list_t isas = isas_present();
    sl_options opt = options_none();
    sl_symbolic *S = NULL;
    sl_status status = SL_OK;
    opt.ordering = ordering;
    SL_CHECK(sl_symbolic_create(&S, A, FOR_ANALYSIS(&opt), NULL));
    for (int k = 0; k < isas.count; k++) {
        sl_factor *F = NULL;
        sl_stats stats;
        memset(&stats, 0, sizeof stats);
        opt.isa = isas.isa[k];
        status = sl_factor_create(&F, S, A, FOR_FACTOR(&opt), &stats);
        if (status == SL_OK) {
            (void)data_solve(F, A, 3, pass_figure(A->n_cols), NULL);
            assert_int_equal(stats.factor.positive + stats.factor.negative, A->n_cols);
        } else {
            assert_int_equal(status, SL_ERR_PIVOT);
            assert_null(F);
            assert_int_equal(stats.factor.null, 1);
            assert_in_range(stats.error.row, 0, A->n_cols - 1);
            assert_true(isfinite(stats.error.value));
        }
        sl_factor_free(F);
    }
    sl_symbolic_free(S);
    return status;
}

/* Every square symmetric file in the folder that is not in `known`. */
static void other_matrices_are_solved_or_refused(void **state) {
    (void)state;
    dataset d = data_or_skip("matrices");
    size_t solved = 0, refused = 0;
    for (size_t k = 0; k < d.count; k++) {
        if (!known_as(d.paths[k])) {
            sl_matrix *M = read_or_fail(d.paths[k]);
            sl_csc A = sl_matrix_view(M);
            sl_triangle triangle;
            if (A.n_rows == A.n_cols && sl_csc_triangle(&A, &triangle, NULL, NULL) == SL_OK) {
                sl_status status = solved_or_refused(&A, SL_ORDERING_ND);
                solved += status == SL_OK;
                refused += status != SL_OK;
            }
            sl_matrix_free(M);
        }
    }
    print_message("%lu others solved, %lu refused with a row\n", (unsigned long)solved,
                  (unsigned long)refused);
    dataset_free(&d);
}

/* Singular matrices are refused in any order; in natural order at the row where exact elimination
 * stops. */
static void singular_matrices_are_refused(void **state) {
    (void)state;
    static const struct {
        const char *name;
        /* s4 is magic(4) + its transpose, of rank 3; the other stores no entry (0, 0) */
        sl_int row;
    } singular[] = {{"s4.rb", 3}, {"coordinate_hermitian_real_row_general_dup.mtx", 0}};
    for (size_t k = 0; k < sizeof singular / sizeof singular[0]; k++) {
        sl_matrix *M = read_or_skip(singular[k].name);
        sl_csc A = sl_matrix_view(M);
        sl_factor *F = NULL;
        sl_stats stats;
        memset(&stats, 0, sizeof stats);
        assert_int_equal(solved_or_refused(&A, SL_ORDERING_ND), SL_ERR_PIVOT);
        sl_symbolic *S = analyze_natural(&A, SL_RELAXATION_DEFAULT);
        SL_EXPECT(SL_ERR_PIVOT, sl_factor_create(&F, S, &A, NULL, &stats));
        assert_int_equal(stats.error.row, singular[k].row);
        sl_symbolic_free(S);
        sl_matrix_free(M);
    }
}

/* Natural orders that are bad: 122 zeros on the diagonal of one matrix, small pivots that are lost
 * to rounding in the other. */
static void a_bad_order_gives_no_wrong_solution(void **state) {
    (void)state;
    static const char *const names[2] = {"tumorAntiAngiogenesis_2.mtx", "cvxqp1_m_3x3_K_10.mtx.gz"};
    for (int k = 0; k < 2; k++) {
        sl_matrix *M = read_or_skip(names[k]);
        sl_csc A = sl_matrix_view(M);
        print_message("%s in its natural order: %s\n", names[k],
                      sl_status_string(solved_or_refused(&A, SL_ORDERING_NATURAL)));
        sl_matrix_free(M);
    }
}

/* ---- one pattern, several matrices ---- */

/* Iterations 1 and 10 of an interior-point method: a refactor with the values of the other, and
 * back. */
static void refactor_equals_create(void **state) {
    (void)state;
    sl_matrix *M0 = NULL, *M10 = NULL;
    read_both_or_skip("cvxqp1_m_3x3_K_0.mtx.gz", &M0, "cvxqp1_m_3x3_K_10.mtx.gz", &M10);
    sl_csc A[2] = {sl_matrix_view(M0), sl_matrix_view(M10)};
    isa_list_t isas = isas_present();
    sl_symbolic *S = NULL;
    size_t n = (size_t)A[0].n_cols;
    assert_int_equal(A[1].n_cols, A[0].n_cols);
    assert_memory_equal(A[0].p, A[1].p, (n + 1) * sizeof *A[0].p);
    assert_memory_equal(A[0].i, A[1].i, (size_t)A[0].p[n] * sizeof *A[0].i);
    SL_CHECK(sl_symbolic_create(&S, &A[0], NULL, NULL));
    for (int k = 0; k < isas.count; k++) {
        sl_options opt = options_none();
        sl_factor *fresh[2] = {NULL, NULL}, *F = NULL;
        opt.isa = isas.isa[k];
        SL_CHECK(sl_factor_create(&fresh[0], S, &A[0], &opt, NULL));
        SL_CHECK(sl_factor_create(&fresh[1], S, &A[1], &opt, NULL));
        SL_CHECK(sl_factor_create(&F, S, &A[0], &opt, NULL));
        for (int round = 1; round <= 2; round++) {
            sl_stats now, then;
            memset(&now, 0, sizeof now);
            memset(&then, 0, sizeof then);
            SL_CHECK(sl_factor_refactor(F, &A[round % 2], &now));
            then.factor = sl_factor_view(fresh[round % 2]).info;
            assert_same_bits(F, fresh[round % 2]);
            assert_int_equal(now.factor.positive, then.factor.positive);
            assert_int_equal(now.factor.negative, then.factor.negative);
            assert_true(now.factor.pivot_min == then.factor.pivot_min &&
                        now.factor.pivot_max == then.factor.pivot_max);
        }
        sl_factor_free(F);
        sl_factor_free(fresh[0]);
        sl_factor_free(fresh[1]);
    }
    sl_symbolic_free(S);
    sl_matrix_free(M0);
    sl_matrix_free(M10);
}

/* One matrix in two files: its upper triangle, and its lower triangle with values of 12 digits. */
static void either_triangle_gives_the_same_solution(void **state) {
    (void)state;
    sl_matrix *lower = NULL, *upper = NULL, *turned = NULL;
    read_both_or_skip("bcsstk01.rb", &lower, "k01up_cholmod.txt", &upper);
    sl_csc L = sl_matrix_view(lower), U = sl_matrix_view(upper);
    sl_symbolic *S[2] = {NULL, NULL};
    sl_factor *F[2] = {NULL, NULL};
    double B[48], X[48];
    turned = transposed(&U);
    sl_csc T = sl_matrix_view(turned);
    SL_CHECK(sl_symbolic_create(&S[0], &U, NULL, NULL));
    SL_CHECK(sl_symbolic_create(&S[1], &T, NULL, NULL));
    SL_CHECK(sl_factor_create(&F[0], S[0], &U, NULL, NULL));
    SL_CHECK(sl_factor_create(&F[1], S[1], &T, NULL, NULL));
    assert_same_bits(F[0], F[1]);
    gen_reals(B, 48, 3);
    SL_CHECK(sl_factor_solve(F[0], X, 48, B, 48, 1, NULL));
    assert_true(worst_backward(&U, X, 48, B, 48, 1) <= DATA_STABLE);
    assert_true(worst_backward(&L, X, 48, B, 48, 1) <= 1e-12); /* precision of the file */
    for (int k = 0; k < 2; k++) {
        sl_factor_free(F[k]);
        sl_symbolic_free(S[k]);
    }
    sl_matrix_free(lower);
    sl_matrix_free(upper);
    sl_matrix_free(turned);
}

/* A pattern without values has the analysis of the same matrix of ones, and cannot be factored. */
static void a_pattern_without_values_is_only_analyzed(void **state) {
    (void)state;
    char *path = path_or_skip("bcspwr10.mtx.gz");
    sl_matrix *ones = read_or_fail(path), *pattern = NULL;
    sl_symbolic *S = NULL;
    sl_factor *F = NULL;
    sl_stats with, without;
    input in;
    memset(&with, 0, sizeof with);
    memset(&without, 0, sizeof without);
    assert_true(input_open(&in, path, NULL, 0));
    SL_CHECK(sl_matrix_parse(&pattern, in.data, (size_t)(in.end - in.data), NULL, NULL));
    sl_csc A = sl_matrix_view(ones), P = sl_matrix_view(pattern);
    assert_null(P.x);
    SL_CHECK(sl_symbolic_create(&S, &A, NULL, &with));
    sl_symbolic_free(S);
    SL_CHECK(sl_symbolic_create(&S, &P, NULL, &without));
    assert_int_equal(without.symbolic.n, 5300);
    assert_int_equal(without.symbolic.nnz_a, 13571);
    assert_int_equal(without.symbolic.nnz_l, with.symbolic.nnz_l);
    SL_EXPECT(SL_ERR_ARGUMENT, sl_factor_create(&F, S, &P, NULL, NULL));
    assert_null(F);
    sl_symbolic_free(S);
    sl_matrix_free(ones);
    sl_matrix_free(pattern);
    input_close(&in);
    free(path);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(known_matrices_are_solved_accurately),
        cmocka_unit_test(other_matrices_are_solved_or_refused),
        cmocka_unit_test(singular_matrices_are_refused),
        cmocka_unit_test(a_bad_order_gives_no_wrong_solution),
        cmocka_unit_test(refactor_equals_create),
        cmocka_unit_test(either_triangle_gives_the_same_solution),
        cmocka_unit_test(a_pattern_without_values_is_only_analyzed),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

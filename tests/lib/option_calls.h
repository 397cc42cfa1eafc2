/* option_calls.h: every call that takes sl_options, by one signature, and the options it reads */
#ifndef SL_TEST_OPTION_CALLS_H
#define SL_TEST_OPTION_CALLS_H

#include "matrix_pair.h"

/* Groups of options that a call reads beyond size, allocator and threads. */
enum {
    READS_NOTHING = 0,
    READS_TRIANGLE = 1,
    READS_ANALYSIS = 2,
    READS_FACTOR = 4,
    READS_REGION = 8,
    READS_REGION_BYTES = 16,
    READS_ISA = 32
};

/* Objects that the calls need, made with default options. */
typedef struct option_fixture_t {
    matrix_pair_t pair;
    sl_csc U; /* the union of the pair */
    double coefficients[TERMS];
    sl_factor *F;
    sl_region *region;
    sl_int *perm; /* 0 .. n-1 */
} option_fixture_t;

static inline option_fixture_t *option_fixture_make(void) {
    option_fixture_t *f = (option_fixture_t *)test_array(1, sizeof *f);
    f->pair = matrix_pair_make(GEN_GRID2, 25, 0, 0, NULL);
    f->U = sl_matrix_view(f->pair.U);
    f->coefficients[0] = f->coefficients[1] = 1;
    SL_CHECK(sl_factor_create_sums(&f->F, 1, f->pair.S, f->coefficients,
                                   matrix_pair_values(&f->pair), TERMS, NULL, NULL, NULL));
    f->perm = test_ints((size_t)f->pair.n);
    for (sl_int k = 0; k < f->pair.n; k++) {
        f->perm[k] = k;
    }
    SL_CHECK(sl_region_create(&f->region, f->F, f->perm, 2, NULL, NULL, NULL));
    return f;
}

static inline void option_fixture_free(option_fixture_t *f) {
    sl_region_free(f->region);
    sl_factor_free(f->F);
    matrix_pair_free(&f->pair);
    free(f->perm);
    free(f);
}

/* One call with opt: asserts that *out is NULL if and only if it fails, and frees what it made. */
typedef sl_status (*option_call_t)(option_fixture_t *f, const sl_options *opt);

/* A pointer that is not NULL, to see that the call sets it to NULL. */
#define OPTION_GARBAGE(type) ((type *)(void *)f)

#define OPTION_CALL(name, type, call) \
    static inline sl_status name(option_fixture_t *f, const sl_options *opt) { \
        type *out = OPTION_GARBAGE(type); \
        const sl_status status = call; \
        assert_true((out != NULL) == (status == SL_OK)); \
        type##_free(out); \
        return status; \
    }

#define OPTION_TEXT "%%MatrixMarket matrix coordinate real general\n1 1 1\n1 1 1\n"

OPTION_CALL(option_triplets, sl_matrix,
            sl_matrix_from_triplets(&out, 1, 1, 1, f->perm, f->perm, f->coefficients, opt, NULL))
OPTION_CALL(option_parse, sl_matrix,
            sl_matrix_parse(&out, OPTION_TEXT, strlen(OPTION_TEXT), opt, NULL))
static const int64_t option_wide_p[2] = {0, 1}, option_wide_i[1] = {0};
static const sl_csc64 option_wide = {1, 1, option_wide_p, option_wide_i, NULL};
OPTION_CALL(option_csc64, sl_matrix, sl_matrix_from_csc64(&out, &option_wide, opt, NULL))
static const sl_int option_hermitian_p[2] = {0, 1}, option_hermitian_i[1] = {0};
static const sl_hermitian option_hermitian = {1, option_hermitian_p, option_hermitian_i, NULL,
                                              NULL};
OPTION_CALL(option_from_hermitian, sl_matrix,
            sl_matrix_from_hermitian(&out, &option_hermitian, opt, NULL))
OPTION_CALL(option_submatrix, sl_matrix, sl_matrix_submatrix(&out, &f->U, f->perm, 2, opt, NULL))
OPTION_CALL(option_fixed, sl_fixed, sl_fixed_create(&out, f->pair.terms, f->perm, 2, opt, NULL))
OPTION_CALL(option_sum, sl_matrix,
            sl_matrix_sum(&out, f->coefficients, f->pair.terms, TERMS, opt, NULL))
OPTION_CALL(option_lower, sl_matrix, sl_factor_lower(&out, f->F, opt))
OPTION_CALL(option_symbolic, sl_symbolic, sl_symbolic_create(&out, &f->U, opt, NULL))
OPTION_CALL(option_pivoted, sl_symbolic,
            sl_symbolic_create_pivoted(&out, &f->pair.terms[1], opt, NULL))
OPTION_CALL(option_factor, sl_factor,
            sl_factor_create(&out, f->pair.S, &f->pair.terms[1], opt, NULL))
OPTION_CALL(option_edit_factor, sl_factor,
            sl_factor_edit(&out, f->F, f->pair.S, &f->pair.terms[1], f->perm, opt, NULL))
OPTION_CALL(option_work, sl_work, sl_work_create(&out, opt))
OPTION_CALL(option_plan, sl_plan,
            sl_plan_create(&out, f->pair.S, f->perm, 1, f->perm, 1, opt, NULL))
OPTION_CALL(option_selected, sl_selected, sl_selected_create(&out, f->F, NULL, SL_ALL, opt, NULL))
OPTION_CALL(option_region, sl_region, sl_region_create(&out, f->F, f->perm, 1, NULL, opt, NULL))
OPTION_CALL(option_batch_factor, sl_factor,
            sl_factor_create_sums(&out, 1, f->pair.S, f->coefficients, matrix_pair_values(&f->pair),
                                  TERMS, opt, NULL, NULL))

/* The file does not exist: SL_ERR_IO if the options are accepted. */
static inline sl_status option_read(option_fixture_t *f, const sl_options *opt) {
    sl_matrix *out = OPTION_GARBAGE(sl_matrix);
    const sl_status status = sl_matrix_read(&out, "no_such_folder/matrix.mtx", opt, NULL);
    assert_null(out);
    return status == SL_ERR_IO ? SL_OK : status;
}

/* The bytes are no saved factor: SL_ERR_UNSUPPORTED if the options are accepted. */
static inline sl_status option_load(option_fixture_t *f, const sl_options *opt) {
    static const char nothing[64];
    sl_saved_set set = {0};
    set.symbolic = OPTION_GARBAGE(sl_symbolic);
    const sl_status status = sl_load(&set, NULL, nothing, 64, SL_LOAD_CHECKED, opt);
    assert_null(set.symbolic);
    return status == SL_ERR_UNSUPPORTED ? SL_OK : status;
}

static inline sl_status option_save(option_fixture_t *f, const sl_options *opt) {
    sl_saved_set set;
    memset(&set, 0, sizeof set);
    set.symbolic = f->pair.S;
    set.factor = f->F;
    return sl_save(NOWHERE, NULL, NULL, &set, opt);
}

/* The identity of U's rows: an edit that changes nothing. */
OPTION_CALL(option_edit, sl_symbolic,
            sl_symbolic_edit(&out, f->pair.S, &f->U, &f->U, f->perm, opt, NULL))

static inline sl_status option_factor_submatrix(option_fixture_t *f, const sl_options *opt) {
    sl_symbolic *S = OPTION_GARBAGE(sl_symbolic);
    sl_factor *G = OPTION_GARBAGE(sl_factor);
    double *x = test_reals((size_t)f->U.p[f->U.n_cols]);
    sl_csc A = f->U; /* with the values of the unit matrix */
    A.x = x;
    for (sl_int j = 0; j < A.n_cols; j++) {
        for (sl_int p = A.p[j]; p < A.p[j + 1]; p++) {
            x[p] = A.i[p] == j ? 1.0 : 0.0;
        }
    }
    const sl_status status = sl_factor_submatrix(&S, &G, f->F, &A, f->perm, 2, opt, NULL);
    assert_true((S != NULL) == (status == SL_OK) && (G != NULL) == (status == SL_OK));
    sl_factor_free(G);
    sl_symbolic_free(S);
    free(x);
    return status;
}

static inline sl_status option_triangle(option_fixture_t *f, const sl_options *opt) {
    sl_triangle triangle = SL_TRIANGLE_BOTH;
    const sl_status status = sl_csc_triangle(&f->U, &triangle, opt, NULL);
    assert_int_equal(triangle, status == SL_OK ? SL_TRIANGLE_LOWER : SL_TRIANGLE_BOTH);
    return status;
}

/* A full solve in either layout; x keeps its value if the options are refused. */
static inline sl_status option_batch_solve_as(option_fixture_t *f, const sl_options *opt,
                                              int by_rows) {
    const size_t n = (size_t)f->pair.n;
    double *b = test_reals(n), *x = test_reals(n);
    sl_request request;
    memset(&request, 0, sizeof request);
    b[0] = 1;
    x[0] = 4321.5;
    request.X = x;
    request.B = b;
    request.nrhs = 1;
    request.ldx = request.ldb = by_rows ? SL_ROWS(1) : n;
    const sl_status status = sl_batch_solve(f->F, &request, 1, opt, NULL, NULL);
    assert_true((x[0] == 4321.5) == (status != SL_OK));
    free(b);
    free(x);
    return status;
}

static inline sl_status option_batch_solve(option_fixture_t *f, const sl_options *opt) {
    return option_batch_solve_as(f, opt, 0);
}

static inline sl_status option_batch_by_rows(option_fixture_t *f, const sl_options *opt) {
    return option_batch_solve_as(f, opt, 1);
}

static inline sl_status option_batch_refactor(option_fixture_t *f, const sl_options *opt) {
    return sl_factor_refactor_sums(&f->F, 1, f->coefficients, matrix_pair_values(&f->pair), TERMS,
                                   opt, NULL, NULL);
}

static const struct {
    const char *name;
    option_call_t call;
    int reads;
} option_calls[] = {
    {"sl_matrix_from_triplets", option_triplets, READS_NOTHING},
    {"sl_matrix_from_csc64", option_csc64, READS_NOTHING},
    {"sl_matrix_from_hermitian", option_from_hermitian, READS_NOTHING},
    {"sl_matrix_parse", option_parse, READS_NOTHING},
    {"sl_matrix_read", option_read, READS_NOTHING},
    {"sl_matrix_submatrix", option_submatrix, READS_NOTHING},
    {"sl_csc_triangle", option_triangle, READS_TRIANGLE},
    {"sl_matrix_sum", option_sum, READS_TRIANGLE},
    {"sl_symbolic_create", option_symbolic, READS_ANALYSIS | READS_TRIANGLE},
    {"sl_symbolic_create_pivoted", option_pivoted, READS_ANALYSIS | READS_TRIANGLE},
    {"sl_symbolic_edit", option_edit, READS_ANALYSIS | READS_TRIANGLE},
    {"sl_factor_create", option_factor, READS_FACTOR | READS_ISA},
    {"sl_factor_edit", option_edit_factor, READS_FACTOR | READS_ISA},
    {"sl_factor_lower", option_lower, READS_NOTHING},
    {"sl_factor_submatrix", option_factor_submatrix, READS_NOTHING},
    {"sl_fixed_create", option_fixed, READS_ANALYSIS | READS_TRIANGLE | READS_FACTOR | READS_ISA},
    {"sl_work_create", option_work, READS_NOTHING},
    {"sl_plan_create", option_plan, READS_REGION},
    {"sl_selected_create", option_selected, READS_NOTHING},
    {"sl_region_create", option_region, READS_REGION_BYTES},
    {"sl_factor_create_sums", option_batch_factor, READS_FACTOR | READS_ISA},
    {"sl_load", option_load, READS_ISA},
    {"sl_save", option_save, READS_NOTHING},
    {"sl_batch_solve", option_batch_solve, READS_NOTHING},
    {"sl_batch_solve by rows", option_batch_by_rows, READS_NOTHING},
    {"sl_factor_refactor_sums", option_batch_refactor, READS_NOTHING},
};

enum { OPTION_CALLS = sizeof option_calls / sizeof option_calls[0] };

/* Fails with the name of the call unless it returns `expected`. */
static inline void assert_option_call(option_fixture_t *f, int k, const sl_options *opt,
                                      sl_status expected) {
    test_status(option_calls[k].call(f, opt), expected, option_calls[k].name, __FILE__, __LINE__);
}

#endif

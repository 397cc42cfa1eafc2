/* test_advice_calls.c: whoever does what a text of the core says gets a right answer */
#include "tests/lib/advised_calls.h"
#include "tests/lib/parallel_for.h"

/* Each call below is refused with its text, and with `heeds` does what the text says. */

/* Analyzes and factors A, and solves. */
static sl_status solved(const sl_csc *A, const sl_options *opt) {
    const size_t n = (size_t)A->n_cols;
    sl_symbolic *S = NULL;
    sl_factor *F = NULL;
    sl_status status = sl_symbolic_create(&S, A, FOR_ANALYSIS(opt), NULL);
    status = status == SL_OK ? sl_factor_create(&F, S, A, FOR_FACTOR(opt), NULL) : status;
    status = status == SL_OK ? sl_factor_solve(F, x, n, b, n, 1, NULL) : status;
    sl_factor_free(F);
    sl_symbolic_free(S);
    return judged(A, -1, status);
}

/* ---- options ---- */

/* A wrong value, which with `heeds` is left out. */
#define SPOILED(name, statement) \
    static sl_status name(int heeds) { \
        sl_options opt = options_none(); \
        if (!heeds) { \
            statement; \
        } \
        return solved(&grid.M.view, &opt); \
    }

static sl_int twos[N];
static double infinite[N];

static void *allocate(void *context, size_t bytes) {
    (void)context;
    return malloc(bytes);
}

SPOILED(size_of_another, opt.size = 8)
SPOILED(reserved_field, opt.reserved[0] = 1)
SPOILED(half_allocator, opt.allocator.allocate = allocate)
SPOILED(threads_below_0, opt.threads.count = -1)
SPOILED(no_relaxation, opt.relaxation = (sl_relaxation)9)
SPOILED(no_triangle, opt.triangle = (sl_triangle)9)
SPOILED(no_ordering, opt.ordering = (sl_ordering)9)
SPOILED(no_purpose, opt.purpose = (sl_purpose)9)
SPOILED(no_perm, opt.ordering = SL_ORDERING_GIVEN)
SPOILED(twice_in_perm, (opt.ordering = SL_ORDERING_GIVEN, opt.perm = twos))
SPOILED(negative_blocks, opt.block_size = -3)
SPOILED(odd_blocks, opt.block_size = 3)
SPOILED(no_method, opt.method = (sl_method)9)
SPOILED(no_storage, opt.storage = (sl_storage)9)
SPOILED(no_pivots, opt.pivots = (sl_pivots)9)
SPOILED(foreign_isa, opt.isa = (sl_isa)30)
SPOILED(nan_null_tolerance, opt.null_tolerance = (double)NAN)
SPOILED(nan_consistency, opt.consistency_tolerance = (double)NAN)
SPOILED(nan_growth_limit, opt.growth_limit = (double)NAN)
SPOILED(nan_error_limit, opt.error_limit = (double)NAN)
SPOILED(negative_regularization, opt.regularization = -1.0)
SPOILED(regularized_skips, (opt.regularization = 1e-8, opt.pivots = SL_PIVOTS_SKIP_NULL))
SPOILED(too_many_nulls, (opt.pivots = SL_PIVOTS_SKIP_NULL, opt.null_vector_count = 33))
SPOILED(negative_nulls, (opt.pivots = SL_PIVOTS_SKIP_NULL, opt.null_vector_count = -1))
SPOILED(no_null_vector, (opt.pivots = SL_PIVOTS_SKIP_NULL, opt.null_vector_count = 2))
SPOILED(no_signs, (opt.regularization = 1e-8, opt.signs = twos))
#if !defined(SL_NO_SINGULAR)
SPOILED(infinite_mass, (opt.pivots = SL_PIVOTS_SKIP_NULL, opt.mass = infinite))
SPOILED(infinite_null, (opt.pivots = SL_PIVOTS_SKIP_NULL, opt.null_vector = infinite))
#endif

/* ---- what is not compiled in: the macro, or as here doing without ---- */

#if defined(SL_NO_METIS) || !defined(SL_METIS)
SPOILED(without_metis, opt.ordering = SL_ORDERING_METIS)
#endif
#if !defined(SL_WITH_ALL) && !defined(SL_WITH_FLOAT)
SPOILED(without_float, opt.storage = SL_STORAGE_FLOAT)
#endif
#if !defined(SL_WITH_ALL) && !defined(SL_WITH_COMPLEX)
SPOILED(without_complex, opt.storage = SL_STORAGE_COMPLEX)
#endif
#if defined(SL_NO_SINGULAR)
SPOILED(without_skipping, opt.pivots = SL_PIVOTS_SKIP_NULL)
SPOILED(without_mass, opt.mass = infinite)
SPOILED(without_null_vector, opt.null_vector = infinite)
SPOILED(without_consistency, opt.consistency_tolerance = 1.0)
#endif

#if !defined(_OPENMP) && !defined(SL_PTHREADS)
static sl_status without_pool(int heeds) {
    sl_options opt = options_none();
    int calls = 0;
    opt.threads.count = 2;
    if (heeds) {
        opt.threads.run = run_threads;
        opt.threads.context = &calls;
    }
    return solved(&grid.M.view, &opt);
}
#endif

/* ---- lists and leading dimensions ---- */

static sl_status list_with_all(int heeds) {
    sl_int rows[N];
    for (sl_int k = 0; k < N; k++) {
        rows[k] = k;
    }
    return judged(&grid.M.view, -1,
                  sl_local_solve(grid.F, heeds ? NULL : rows, SL_ALL, NULL, SL_ALL, x, N, b, N, 1,
                                 NULL, NULL));
}

static sl_status list_without_count(int heeds) {
    return judged(
        &grid.M.view, -1,
        sl_local_solve(grid.F, NULL, heeds ? SL_ALL : 3, NULL, SL_ALL, x, N, b, N, 1, NULL, NULL));
}

static sl_status small_ldx(int heeds) {
    return judged(&grid.M.view, -1, sl_factor_solve(grid.F, x, heeds ? N : N - 1, b, N, 1, NULL));
}

static sl_status small_ldb(int heeds) {
    return judged(&grid.M.view, -1,
                  sl_factor_solve(grid.F, x, N, b, heeds ? SL_ROWS(1) : SL_ROWS(0), 1, NULL));
}

static sl_status small_ldy(int heeds) {
    double product[N];
    SL_CHECK(sl_factor_solve(grid.F, x, N, b, N, 1, NULL));
    const sl_status status =
        sl_csc_multiply(&grid.M.view, SL_AS_SYMMETRIC, product, heeds ? N : 1, x, N, 1);
    for (int k = 0; k < N && status == SL_OK; k++) {
        assert_true(fabs(product[k] - b[k]) <= 1e-10);
    }
    return status;
}

static sl_status small_ldr(int heeds) {
    double r[N];
    SL_CHECK(sl_factor_solve(grid.F, x, N, b, N, 1, NULL));
    const sl_status status = sl_csc_residual(&grid.M.view, r, heeds ? N : 1, NULL, x, N, b, N, 1);
    for (int k = 0; k < N && status == SL_OK; k++) {
        assert_true(fabs(r[k]) <= 1e-10);
    }
    return status;
}

static sl_status no_reading(int heeds) {
    double product[N];
    const sl_reading reading = heeds ? SL_AS_SYMMETRIC : (sl_reading)9;
    SL_CHECK(sl_factor_solve(grid.F, x, N, b, N, 1, NULL));
    const sl_status status = sl_csc_multiply(&grid.M.view, reading, product, N, x, N, 1);
    for (int k = 0; k < N && status == SL_OK; k++) {
        assert_true(fabs(product[k] - b[k]) <= 1e-10);
    }
    return status;
}

/* ---- values ---- */

/* The lower triangle of a 3 x 3 matrix. */
static sl_status dense(const double *values, const sl_options *opt) {
    static const sl_int p[] = {0, 3, 5, 6}, i[] = {0, 1, 2, 1, 2, 2};
    const sl_csc A = {3, 3, p, i, values};
    return solved(&A, opt);
}

static sl_status two_triangles(int heeds) {
    static const sl_int p[] = {0, 2, 4}, i[] = {0, 1, 0, 1};
    static const double values[] = {2.0, 1.0, 0.5, 2.0};
    const sl_csc A = {2, 2, p, i, values};
    sl_options opt = options_none();
    opt.triangle = heeds ? SL_TRIANGLE_LOWER : SL_TRIANGLE_NONE;
    return solved(&A, &opt);
}

static sl_status large_tolerance(int heeds) {
    static const double values[] = {1.0, 1.0, 0.0, 1.0 + 1e-9, 0.0, 1.0};
    sl_options opt = options_none();
    opt.null_tolerance = heeds ? 0.0 : 1e-6;
    return dense(values, &opt);
}

static sl_status wanted_positive(int heeds) {
    static const double values[] = {1.0, 0.0, 0.0, -2.0, 0.0, 1.0};
    sl_options opt = options_none();
    opt.pivots = heeds ? SL_PIVOTS_NONZERO : SL_PIVOTS_POSITIVE;
    return dense(values, &opt);
}

#if !defined(SL_NO_SINGULAR)
static sl_status skipping_indefinite(int heeds) {
    static const double values[] = {1.0, 2.0, 0.0, 1.0, 0.0, 1.0};
    sl_options opt = options_none();
    opt.pivots = heeds ? SL_PIVOTS_NONZERO : SL_PIVOTS_SKIP_NULL;
    return dense(values, &opt);
}

/* v v' of v = (1, 2, 3), for b = v: semidefinite, and no Laplacian. */
static sl_status semidefinite(int heeds) {
    static const double values[] = {1.0, 2.0, 3.0, 4.0, 6.0, 9.0};
    double kept[3];
    sl_options opt = options_none();
    opt.pivots = heeds ? SL_PIVOTS_SKIP_NULL : SL_PIVOTS_NONZERO;
    memcpy(kept, b, sizeof kept);
    for (int k = 0; k < 3; k++) {
        b[k] = k + 1.0;
    }
    const sl_status status = dense(values, &opt);
    memcpy(b, kept, sizeof kept);
    return status;
}

/* The Laplacian of a triangle, for a b that does not sum to 0: weights take a part of b away. */
static sl_status triangle(const double *mass) {
    static const sl_int p[] = {0, 3, 5, 6}, i[] = {0, 1, 2, 1, 2, 2};
    static const double values[] = {2.0, -1.0, -1.0, 2.0, -1.0, 2.0}, f[] = {4.0, 0.0, 0.0};
    const sl_csc A = {3, 3, p, i, values};
    sl_options opt = options_none();
    sl_symbolic *S = NULL;
    sl_factor *F = NULL;
    opt.pivots = SL_PIVOTS_SKIP_NULL;
    opt.mass = mass;
    SL_CHECK(sl_symbolic_create(&S, &A, NULL, NULL));
    sl_status status = sl_factor_create(&F, S, &A, &opt, NULL);
    status = status == SL_OK ? sl_factor_solve(F, x, 3, f, 3, 1, NULL) : status;
    sl_factor_free(F);
    sl_symbolic_free(S);
    if (status == SL_OK) {
        assert_true(fabs(x[0] + x[1] + 2.0 * x[2]) <= 1e-12);
        assert_true(fabs(2.0 * x[0] - x[1] - x[2] - 3.0) <= 1e-12);
    }
    return status;
}

static const double weights[] = {1.0, 1.0, 2.0}, balanced[] = {1.0, 1.0, -2.0};

static sl_status inconsistent(int heeds) {
    return triangle(heeds ? weights : NULL);
}

static sl_status weights_without_sum(int heeds) {
    return triangle(heeds ? weights : balanced);
}
#endif

static const advice_t advices[] = {
    {"options.size is not that of the library: sl_options_init sets it", size_of_another},
    {"a reserved field of options is not 0: sl_options_init sets all fields", reserved_field},
    {"options.allocator has only one of its two functions", half_allocator},
    {"options.threads.count is below 0", threads_below_0},
    {"options.relaxation is not a value of sl_relaxation", no_relaxation},
    {"options.triangle is not a value of sl_triangle", no_triangle},
    {"options.ordering is not a value of sl_ordering", no_ordering},
    {"options.purpose is not a value of sl_purpose", no_purpose},
    {"options.perm is NULL though ordering is GIVEN", no_perm},
    {"options.perm has a row out of range or twice at this position", twice_in_perm},
    {"options.block_size is below 0", negative_blocks},
    {"options.block_size does not divide n", odd_blocks},
    {"options.method is not a value of sl_method", no_method},
    {"options.storage is not a value of sl_storage", no_storage},
    {"options.pivots is not a value of sl_pivots", no_pivots},
    {"options.isa is not that of this processor", foreign_isa},
    {"options.null_tolerance is NaN", nan_null_tolerance},
    {"options.consistency_tolerance is NaN", nan_consistency},
    {"options.growth_limit is NaN", nan_growth_limit},
    {"options.error_limit is NaN", nan_error_limit},
    {"options.regularization is below 0 or not finite", negative_regularization},
    {"options.regularization needs options.pivots = SL_PIVOTS_NONZERO", regularized_skips},
    {"options.null_vector_count is below 0 or above 32", too_many_nulls},
    {"options.null_vector_count is below 0 or above 32", negative_nulls},
    {"options.null_vector is NULL", no_null_vector},
    {"options.signs has a value other than -1, 0 and 1", no_signs},
#if defined(SL_NO_METIS) || !defined(SL_METIS)
    {"options.ordering needs SL_METIS", without_metis},
#endif
#if !defined(SL_WITH_ALL) && !defined(SL_WITH_FLOAT)
    {"options.storage needs SL_WITH_FLOAT", without_float},
#endif
#if !defined(SL_WITH_ALL) && !defined(SL_WITH_COMPLEX)
    {"options.storage needs SL_WITH_COMPLEX", without_complex},
#endif
#if defined(SL_NO_SINGULAR)
    {"options.pivots = SL_PIVOTS_SKIP_NULL: compiled with SL_NO_SINGULAR", without_skipping},
    {"options.mass: compiled with SL_NO_SINGULAR", without_mass},
    {"options.null_vector: compiled with SL_NO_SINGULAR", without_null_vector},
    {"options.consistency_tolerance: compiled with SL_NO_SINGULAR", without_consistency},
#else
    {"options.mass is not finite", infinite_mass},
    {"options.null_vector is not finite", infinite_null},
    {"the pivot has the wrong sign, beyond options.null_tolerance: SL_PIVOTS_SKIP_NULL takes "
     "semidefinite matrices",
     skipping_indefinite},
    {"if A is regular, sl_symbolic_create_pivoted factors it; if it is semidefinite, "
     "options.pivots = SL_PIVOTS_SKIP_NULL",
     semidefinite},
    {"b has a part along a null vector of A, so that no x solves it; with options.mass solves "
     "leave that part out",
     inconsistent},
    {"A is indefinite, or options.null_vector or options.mass does not suit its null vectors",
     weights_without_sum},
#endif
#if !defined(_OPENMP) && !defined(SL_PTHREADS)
    {"threads.count is above 1: compile with SL_PTHREADS or OpenMP, or set threads.run",
     without_pool},
#endif
    {"the count of a list is below 0; SL_ALL goes with NULL", list_with_all},
    {"the list is NULL: its count must be SL_ALL, n, or 0", list_without_count},
    {"ldx is below the rows of X, or nrhs with SL_ROWS (least 100, value 99)", small_ldx},
    {"ldb is below the rows of B, or nrhs with SL_ROWS (least 1)", small_ldb},
    {"ldy is below the rows of Y, or nrhs with SL_ROWS (least 100, value 1)", small_ldy},
    {"ldr is below the rows of R, or nrhs with SL_ROWS (least 100, value 1)", small_ldr},
    {"reading is not a value of sl_reading", no_reading},
    {"the values of the two triangles differ; options.triangle chooses one", two_triangles},
    {"the pivot is within options.null_tolerance, which is above its default", large_tolerance},
    {"SL_PIVOTS_POSITIVE: the pivot is not positive, and A not positive definite", wanted_positive},
};

static void advice_of_calls_is_right(void **state) {
    (void)state;
    for (int k = 0; k < N; k++) {
        twos[k] = 2;
        infinite[k] = (double)INFINITY;
    }
    follow_all(advices, sizeof advices / sizeof *advices);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(advice_of_calls_is_right),
    };
    return cmocka_run_group_tests(tests, advice_set_up, advice_tear_down);
}

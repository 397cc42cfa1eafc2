/* test_signalling_nans.c: no call computes with memory that nobody has set, divides by zero or
 * overflows on good input: blocks, workspaces and results start as signalling NaNs, and each such
 * operation traps. clang computes what a branch may discard unless it is told that operations can
 * trap (-ffp-exception-behavior=maytrap), so that the tests are left out there. */
#ifndef _GNU_SOURCE
#define _GNU_SOURCE /* feenableexcept */
#endif
#include <fenv.h>

#include "tests/lib/factored.h"
#include "tests/lib/graph_laplacian.h"

#if defined(__GLIBC__) && defined(FE_INVALID) && !defined(__clang__)

enum { MOST_RHS = 9, TRAPS = FE_INVALID | FE_DIVBYZERO | FE_OVERFLOW };

static void fill_signalling(void *block, size_t bytes) {
    const uint64_t nan = UINT64_C(0x7ff4dead7ff4dead); /* two floats that signal, too */
    for (size_t k = 0; k < bytes; k++) {
        ((unsigned char *)block)[k] = ((const unsigned char *)&nan)[k % sizeof nan];
    }
}

static void *allocate_signalling(void *context, size_t bytes) {
    void *block = malloc(bytes);
    (void)context;
    if (block) {
        fill_signalling(block, bytes);
    }
    return block;
}

static void release(void *context, void *block) {
    (void)context;
    free(block);
}

/* Results and sets of one test. */
typedef struct buffers_t {
    sl_options opt; /* the allocator */
    sl_int n, nb, nx;
    sl_int *bset, *xset;
    double *B, *X;
    size_t bytes; /* of X */
} buffers_t;

static double *signalling(buffers_t *y) {
    fill_signalling(y->X, y->bytes);
    return y->X;
}

static void solve_all(buffers_t *y, const sl_csc *A, const sl_symbolic *S, const sl_factor *F) {
    const size_t n = (size_t)y->n;
    sl_plan *P = NULL;
    sl_work *W = NULL;
    sl_stats stats;
    double rcond;
    SL_CHECK(sl_work_create(&W, &y->opt));
    SL_CHECK(sl_plan_create(&P, S, y->bset, y->nb, y->xset, y->nx, &y->opt, &stats));
    for (sl_int nrhs = 1; nrhs <= MOST_RHS; nrhs++) {
        const size_t row = (size_t)nrhs;
        SL_CHECK(sl_factor_solve(F, signalling(y), n, y->B, n, nrhs, W));
        /* singular systems are inconsistent here, and some are changed by regularization */
        const sl_status refined = sl_factor_refine(F, A, y->X, n, y->B, n, nrhs, 2, W, &stats);
        assert_true(refined == SL_OK || refined == SL_ERR_INACCURATE);
        SL_CHECK(sl_factor_solve(F, signalling(y), SL_ROWS(row), y->B, SL_ROWS(row), nrhs, W));
        SL_CHECK(sl_plan_solve(P, F, signalling(y), n, y->B, n, nrhs, W));
        SL_CHECK(sl_plan_solve(P, F, signalling(y), SL_ROWS(row), y->B, SL_ROWS(row), nrhs, W));
        SL_CHECK(sl_local_solve(F, y->bset, y->nb, y->xset, y->nx, signalling(y), n, y->B, n, nrhs,
                                W, &stats));
        SL_CHECK(sl_factor_defects(F, signalling(y), n, y->B, n, nrhs, W));
    }
    SL_CHECK(sl_factor_rcond(F, A, &rcond, W));
    sl_plan_free(P);
    sl_work_free(W);
}

/* Plans of a region. */
static void solve_in_region(buffers_t *y, const sl_symbolic *S, const sl_factor *F,
                            const sl_region *R, sl_work *W) {
    sl_plan *P = NULL;
    sl_options opt = y->opt;
    opt.region = R;
    SL_CHECK(sl_plan_create(&P, S, y->bset, y->nb, y->bset, y->nb, &opt, NULL));
    for (sl_int nrhs = 1; nrhs <= MOST_RHS; nrhs++) {
        SL_CHECK(sl_plan_solve(P, F, signalling(y), (size_t)y->n, y->B, (size_t)y->n, nrhs, W));
    }
    sl_plan_free(P);
}

static void invert_all(buffers_t *y, const sl_symbolic *S, const sl_factor *F) {
    const size_t n = (size_t)y->n;
    sl_work *W = NULL;
    sl_region *R = NULL;
    sl_selected *Z = NULL;
    sl_stats stats;
    SL_CHECK(sl_work_create(&W, &y->opt));
    SL_CHECK(sl_inverse_diagonal(F, signalling(y), y->bset, y->nb, W, &stats));
    SL_CHECK(sl_inverse_diagonal(F, signalling(y), NULL, y->n, W, &stats));
    SL_CHECK(sl_inverse_pairs(F, signalling(y), y->bset, y->xset, y->nb, W, &stats));
    SL_CHECK(sl_inverse_block(F, signalling(y), n, y->bset, y->nb, y->xset, y->nb, W, &stats));
    SL_CHECK(sl_selected_create(&Z, F, NULL, SL_ALL, &y->opt, &stats));
    sl_selected_free(Z);
    if (stats.factor.null == 0) {
        const sl_status status = sl_region_create(&R, F, y->bset, y->nb, NULL, &y->opt, &stats);
        assert_true(status == SL_OK || status == SL_ERR_UNSUPPORTED);
        if (status == SL_OK) {
            solve_in_region(y, S, F, R, W);
        }
        sl_region_free(R);
    }
    sl_work_free(W);
}

static void run(gen_matrix_t *M, sl_options *for_factor) {
    const sl_allocator allocator = {allocate_signalling, release, NULL};
    buffers_t y;
    sl_symbolic *S = NULL;
    sl_factor *F = NULL;
    uint64_t seed = 5;
    y.opt = options_none();
    y.opt.allocator = allocator;
    for_factor->allocator = allocator;
    y.n = M->view.n_cols;
    y.nb = y.n < 7 ? y.n : 7;
    y.nx = y.n < 12 ? y.n : 12;
    y.bset = test_ints((size_t)y.n + 1);
    y.xset = test_ints((size_t)y.n + 1);
    gen_set(y.bset, y.nb, y.n, gen_bits(&seed));
    gen_set(y.xset, y.nx, y.n, gen_bits(&seed));
    y.bytes = (size_t)(y.n + 1) * MOST_RHS * sizeof(double);
    y.X = test_reals((size_t)(y.n + 1) * MOST_RHS);
    y.B = test_reals((size_t)(y.n + 1) * MOST_RHS);
    gen_reals(y.B, (size_t)y.n * MOST_RHS, 3);
    (void)feclearexcept(FE_ALL_EXCEPT);
    (void)feenableexcept(TRAPS);
    SL_CHECK(sl_symbolic_create(&S, &M->view, &y.opt, NULL));
    SL_CHECK(sl_factor_create(&F, S, &M->view, for_factor, NULL));
    SL_CHECK(sl_factor_refactor(F, &M->view, NULL));
    const sl_int changed = 0;
    SL_CHECK(sl_factor_change_entries(F, &M->view, NULL, &changed, NULL, y.n > 0, NULL, NULL));
    solve_all(&y, &M->view, S, F);
    invert_all(&y, S, F);
    (void)fedisableexcept(TRAPS);
    sl_factor_free(F);
    sl_symbolic_free(S);
    free(y.bset);
    free(y.xset);
    free(y.X);
    free(y.B);
}

static void nothing_unset_is_computed_with(void **state) {
    (void)state;
    static const sl_int sizes[3] = {5, 40, 300};
    variant_list_t variants = variants_present();
    if (feenableexcept(0) == -1) {
        TEST_SKIP("the processor has no traps of floating-point errors");
    }
    for (int size = 0; size < 3; size++) {
        for (int kind = 0; kind < GEN_REGULAR; kind++) {
            gen_matrix_t M = gen_matrix((gen_kind_t)kind, sizes[size], 1, 4);
            for (int k = 0; k < variants.count; k++) {
                sl_options opt = options_skip_null(&variants, k);
                opt.pivots = SL_PIVOTS_NONZERO;
                run(&M, &opt);
                opt.regularization = 1e-8;
                run(&M, &opt);
                opt.regularization = 0.0;
                opt.pivots = SL_PIVOTS_SKIP_NULL;
                if (kind != GEN_KKT) { /* regular components */
                    run(&M, &opt);
                }
            }
            gen_matrix_free(&M);
        }
    }
}

static void neither_with_null_pivots(void **state) {
    (void)state;
    variant_list_t variants = variants_present();
    if (feenableexcept(0) == -1) {
        TEST_SKIP("the processor has no traps of floating-point errors");
    }
    for (int kind = 0; kind < LAPLACIAN_KINDS; kind++) {
        sl_int components = 0;
        gen_matrix_t M = laplacian(laplacian_kinds[kind], 90, 0, &components);
        double *mass = test_reals((size_t)M.view.n_cols);
        gen_reals(mass, (size_t)M.view.n_cols, 4);
        for (sl_int k = 0; k < M.view.n_cols; k++) {
            mass[k] = 1.5 + mass[k];
        }
        for (int k = 0; k < variants.count; k++) {
            sl_options opt = options_skip_null(&variants, k);
            opt.consistency_tolerance = -1.0;
            run(&M, &opt);
            opt.consistency_tolerance = 0.0;
            opt.mass = mass;
            run(&M, &opt);
        }
        free(mass);
        gen_matrix_free(&M);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(nothing_unset_is_computed_with),
        cmocka_unit_test(neither_with_null_pivots),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

#else

static void there_are_no_traps(void **state) {
    (void)state;
    TEST_SKIP("the processor has no traps of floating-point errors");
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(there_are_no_traps),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

#endif

/* test_float_flags.c: good input raises no floating-point flag, whatever the memory held before */
#include <fenv.h>

#include "tests/lib/factored.h"

enum { SET = 20, NRHS = 9 };

/* Fills blocks with signaling NaN: arithmetic on one that was never written raises a flag. */
static void *allocate(void *context, size_t bytes) {
    const uint64_t signaling = (uint64_t)0x7FF4 << 48;
    unsigned char *block = (unsigned char *)malloc(bytes);
    (void)context;
    for (size_t k = 0; block && k + sizeof signaling <= bytes; k += sizeof signaling) {
        memcpy(block + k, &signaling, sizeof signaling);
    }
    return block;
}

static void release(void *context, void *block) {
    (void)context;
    free(block);
}

#if defined(FE_INVALID) && defined(FE_DIVBYZERO) && defined(FE_OVERFLOW)
#define FLAGS (FE_INVALID | FE_DIVBYZERO | FE_OVERFLOW)
#else
#define FLAGS 0
#endif

/* A call that succeeds and raises none of the flags. */
#define QUIET(call) \
    do { \
        (void)feclearexcept(FE_ALL_EXCEPT); \
        SL_CHECK(call); \
        if (fetestexcept(FLAGS)) { \
            print_error("%s raised flags %x\n", #call, (unsigned)fetestexcept(FLAGS)); \
            fail(); \
        } \
    } while (0)

static void assert_quiet(const sl_csc *A, sl_options opt) {
    const size_t n = (size_t)A->n_cols;
    sl_symbolic *S = NULL;
    sl_factor *F = NULL;
    sl_selected *Z = NULL;
    sl_region *R = NULL;
    sl_plan *P = NULL;
    sl_work *W = NULL;
    double *X = test_reals(n * NRHS), *B = test_reals(n * NRHS), value;
    sl_int set[SET];
    gen_reals(B, n * NRHS, 3);
    for (sl_int k = 0; k < SET; k++) {
        set[k] = (sl_int)(n / SET) * k;
    }
    QUIET(sl_symbolic_create(&S, A, FOR_ANALYSIS(&opt), NULL));
    QUIET(sl_factor_create(&F, S, A, FOR_FACTOR(&opt), NULL));
    QUIET(sl_factor_refactor(F, A, NULL));
    QUIET(sl_factor_refactor_changed(F, A, set, 5, NULL));
    QUIET(sl_work_create(&W, FOR_OTHERS(&opt)));
    for (sl_int nrhs = 1; nrhs <= NRHS; nrhs++) {
        QUIET(sl_factor_solve(F, X, n, B, n, nrhs, W));
        QUIET(sl_local_solve(F, set, SET, set, SET, X, SET, B, SET, nrhs, W, NULL));
    }
    QUIET(sl_factor_solve(F, X, n, B, n, 3, W));
    QUIET(sl_factor_refine(F, A, X, n, B, n, 3, 2, W, NULL));
    QUIET(sl_factor_rcond(F, A, &value, W));
    QUIET(sl_inverse_diagonal(F, X, NULL, 0, W, NULL));
    QUIET(sl_inverse_diagonal(F, X, set, SET, W, NULL));
    QUIET(sl_inverse_pairs(F, X, set, set + 1, SET - 1, W, NULL));
    QUIET(sl_inverse_block(F, X, SET, set, SET, set, SET, W, NULL));
    QUIET(sl_inverse_bilinear(F, &value, set, B, SET, set, B, SET, W, NULL));
    QUIET(sl_selected_create(&Z, F, set, 7, FOR_OTHERS(&opt), NULL));
    sl_selected_free(Z);
    QUIET(sl_selected_create(&Z, F, NULL, 0, FOR_OTHERS(&opt), NULL));
    QUIET(sl_region_create(&R, F, set, SET, Z, FOR_REGION(&opt), NULL));
    opt.region = R;
    QUIET(sl_plan_create(&P, S, set, SET, set, SET, FOR_PLAN(&opt), NULL));
    for (sl_int nrhs = 1; nrhs <= NRHS; nrhs++) {
        QUIET(sl_plan_solve(P, F, X, SET, B, SET, nrhs, W));
    }
    sl_plan_free(P);
    sl_region_free(R);
    sl_selected_free(Z);
    sl_work_free(W);
    sl_factor_free(F);
    sl_symbolic_free(S);
    free(X);
    free(B);
}

/* The dense matrices have a root whose columns fill groups of 128 and a part of a tile. */
static void good_input_raises_no_flag(void **state) {
    (void)state;
    static const struct {
        gen_kind_t kind;
        sl_int size;
    } cases[] = {{GEN_GRID2, 400}, {GEN_GRID3, 343}, {GEN_DENSE, 139},
                 {GEN_DENSE, 267}, {GEN_STAR, 60},   {GEN_COMPONENTS, 90}};
    const variant_list_t variants = variants_present();
    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
        for (int v = 0; v < variants.count; v++) {
            gen_matrix_t M = gen_matrix(cases[k].kind, cases[k].size, 1, 5);
            sl_options opt = options_none();
            options_set_variant(&opt, &variants, v);
            opt.allocator.allocate = allocate;
            opt.allocator.release = release;
            assert_quiet(&M.view, opt);
            gen_matrix_free(&M);
        }
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(good_input_raises_no_flag)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}

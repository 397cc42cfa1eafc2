/* test_save_use.c: what may be done with loaded and mapped factors, and what is refused */
#include "tests/lib/parallel_for.h"
#include "tests/lib/saved.h"

/* ---- the analysis alone, and what fits what ---- */

static void an_analysis_is_saved_without_a_factor(void **state) {
    (void)state;
    factored_t y = factored_make(GEN_GRID2, 144, 1, 0, NULL);
    saved_t m = saved_make(y.S, NULL), whole = saved_make(y.S, y.F);
    saved_call_t calls[2] = {pair_load_memory, pair_map_memory};
    for (int k = 0; k < 2; k++) {
        sl_symbolic *S = NULL;
        sl_factor *F = y.F, *G = NULL;
        SL_CHECK(calls[k](&S, &F, m.bytes, m.size, SL_LOAD_CHECKED, NULL));
        assert_null(F);
        assert_same_analysis(y.S, S);
        SL_CHECK(sl_factor_create(&G, S, &y.M.view, NULL, NULL)); /* also over mapped arrays */
        assert_same_answers(y.F, G);
        SL_CHECK(sl_factor_refactor(G, &y.M.view, NULL));
        saved_t again = saved_make(S, G);
        assert_memory_equal(again.bytes, whole.bytes, whole.size);
        saved_free(&again);
        sl_factor_free(G);
        sl_symbolic_free(S);
        SL_CHECK(calls[k](&S, NULL, whole.bytes, whole.size, SL_LOAD_CHECKED, NULL));
        assert_same_analysis(y.S, S);
        sl_symbolic_free(S);
    }
    assert_true(m.size < whole.size);
    saved_free(&m);
    saved_free(&whole);
    factored_free(&y);
}

static void two_loads_are_independent(void **state) {
    (void)state;
    factored_t y = factored_make(GEN_GRID2, 400, 1, 0, NULL);
    saved_t m = saved_make(y.S, y.F);
    sl_symbolic *S[3];
    sl_factor *F[3], *G = NULL;
    SL_CHECK(pair_load_memory(&S[0], &F[0], m.bytes, m.size, SL_LOAD_CHECKED, NULL));
    SL_CHECK(pair_map_memory(&S[1], &F[1], m.bytes, m.size, SL_LOAD_CHECKED, NULL));
    SL_CHECK(pair_map_memory(&S[2], &F[2], m.bytes, m.size, SL_LOAD_TRUSTED, NULL));
    for (int k = 0; k < 3; k++) {
        assert_same_answers(F[k], F[(k + 1) % 3]); /* their plans refuse each other's factor */
    }
    SL_CHECK(
        sl_factor_create(&G, S[1], &y.M.view, NULL, NULL)); /* a second factor over a mapped one */
    assert_same_answers(F[1], G);
    sl_factor_free(F[0]);
    sl_symbolic_free(S[0]);
    assert_same_answers(F[2], G);
    sl_factor_free(G);
    sl_factor_free(F[1]);
    sl_symbolic_free(S[1]);
    assert_same_answers(y.F, F[2]);
    /* of another analysis */
    SL_EXPECT(SL_ERR_MISMATCH, pair_save_memory(m.bytes, &m.size, S[2], y.F));
    sl_factor_free(F[2]);
    sl_symbolic_free(S[2]);
    saved_free(&m);
    factored_free(&y);
}

/* ---- refactorizations ---- */

static void a_loaded_factor_can_be_refactored(void **state) {
    (void)state;
    variant_list_t variants = variants_present();
    for (int k = 0; k < variants.count; k++) {
        for (int way = 0; way < SAVED_WAYS; way++) {
            sl_options from = options_none(), opt = options_none();
            options_set_variant(&from, &variants, k);
            opt.isa = from.isa;
            int runs = 0;
            opt.threads.count = 2;
            opt.threads.run = run_backwards;
            opt.threads.context = &runs;
            saved_case_t c = saved_case_make(way, GEN_GRID2, 400, 0, &from);
            saved_t m = saved_make(c.y.S, c.y.F);
            sl_symbolic *S = NULL;
            sl_factor *F = NULL;
            const sl_csc *A = &c.y.M.view;
            sl_csc B = *A;
            const sl_int columns[2] = {5, 77};
            double *x = test_reals((size_t)A->p[A->n_cols]);
            for (sl_int p = 0; p < A->p[A->n_cols]; p++) {
                x[p] = A->x[p] * 1.5;
            }
            B.x = x;
            SL_CHECK(pair_load_memory(&S, &F, m.bytes, m.size, SL_LOAD_CHECKED, &opt));
            SL_CHECK(sl_factor_change_entries(F, A, NULL, columns, NULL, 2, NULL, NULL));
            SL_CHECK(sl_factor_change_entries(c.y.F, A, NULL, columns, NULL, 2, NULL, NULL));
            assert_same_answers(c.y.F, F);
            SL_CHECK(sl_factor_refactor(F, &B, NULL));
            SL_CHECK(sl_factor_refactor(c.y.F, &B, NULL));
            assert_same_answers(c.y.F, F);
            sl_factor_free(F);
            sl_symbolic_free(S);
            free(x);
            saved_free(&m);
            saved_case_free(&c);
        }
    }
}

static void a_mapped_factor_is_immutable(void **state) {
    (void)state;
    factored_t y = factored_make(GEN_GRID2, 144, 1, 0, NULL);
    saved_t m = saved_make(y.S, y.F);
    sl_symbolic *S = NULL;
    sl_factor *F = NULL;
    const sl_int column = 3;
    const double one = 1;
    const double *values = y.M.view.x;
    sl_int failed = 7;
    SL_CHECK(pair_map_memory(&S, &F, m.bytes, m.size, SL_LOAD_CHECKED, NULL));
    SL_EXPECT(SL_ERR_READ_ONLY, sl_factor_refactor(F, &y.M.view, NULL));
    SL_EXPECT(SL_ERR_READ_ONLY,
              sl_factor_change_entries(F, &y.M.view, NULL, &column, NULL, 1, NULL, NULL));
    SL_EXPECT(SL_ERR_READ_ONLY,
              sl_factor_change_entries(F, &y.M.view, NULL, &column, NULL, 0, NULL, NULL));
    SL_EXPECT(SL_ERR_READ_ONLY,
              sl_factor_refactor_sums(&F, 1, &one, &values, 1, NULL, &failed, NULL));
    assert_int_equal(failed, 0);
    assert_same_answers(y.F, F);
    sl_factor_free(F);
    sl_symbolic_free(S);
    saved_free(&m);
    factored_free(&y);
}

static void batches_refactor_loaded_factors(void **state) {
    (void)state;
    factored_t y = factored_make(GEN_GRID2, 144, 1, 0, NULL);
    saved_t m = saved_make(y.S, NULL);
    sl_symbolic *S = NULL;
    sl_factor *F[2] = {NULL, NULL}, *G[2] = {NULL, NULL};
    sl_stats stats;
    stats.symbolic = sl_symbolic_view(y.S).info;
    double *values = test_reals((size_t)stats.symbolic.nnz_a);
    const double *const arrays[1] = {values};
    const double coefficients[2] = {1, 2};
    saved_free(&m);
    SL_CHECK(sl_symbolic_scatter(y.S, values, &y.M.view, NULL));
    m = saved_make(y.S, y.F);
    SL_CHECK(pair_load_memory(&S, &F[0], m.bytes, m.size, SL_LOAD_CHECKED, NULL));
    SL_CHECK(sl_factor_create(&F[1], S, &y.M.view, NULL, NULL));
    SL_CHECK(sl_factor_refactor_sums(F, 2, coefficients, arrays, 1, NULL, NULL, NULL));
    SL_CHECK(sl_factor_create_sums(G, 2, y.S, coefficients, arrays, 1, NULL, NULL, NULL));
    assert_same_answers(F[0], G[0]);
    assert_same_answers(F[1], G[1]);
    for (int k = 0; k < 2; k++) {
        sl_factor_free(F[k]);
        sl_factor_free(G[k]);
    }
    sl_symbolic_free(S);
    free(values);
    saved_free(&m);
    factored_free(&y);
}

/* ---- arguments, and memory that fails ---- */

/* L in float is not loaded with an instruction set that keeps it in double. */
static void l_in_float_needs_its_kernels(void **state) {
    (void)state;
    static const saved_call_t calls[2] = {pair_load_memory, pair_map_memory};
    const sl_options from = options_none();
    sl_options opt = options_none();
    opt.isa = SL_ISA_SCALAR;
    for (int k = 0; k < 4; k++) {
        saved_case_t c =
            saved_case_make(SAVED_FLOAT, GEN_GRID2, 70, 0, &from);
        saved_t m = saved_make(c.y.S, c.y.F);
        sl_symbolic *S = c.y.S;
        sl_factor *F = c.y.F;
        SL_EXPECT(isa_keeps_storage(opt.isa) ? SL_OK : SL_ERR_UNSUPPORTED,
                  calls[k / 2](&S, &F, m.bytes, m.size, SL_LOAD_CHECKED, &opt));
        assert_int_equal(S != NULL && F != NULL, isa_keeps_storage(opt.isa));
        sl_factor_free(F);
        sl_symbolic_free(S);
        saved_free(&m);
        saved_case_free(&c);
    }
}

static void wrong_arguments_are_refused(void **state) {
    (void)state;
    factored_t y = factored_make(GEN_GRID2, 25, 1, 0, NULL),
               z = factored_make(GEN_GRID2, 36, 1, 0, NULL);
    saved_t m = saved_make(y.S, y.F);
    saved_call_t calls[2] = {pair_load_memory, pair_map_memory};
    size_t size = 0;
    sl_options opt = options_none();
    SL_EXPECT(SL_ERR_ARGUMENT, pair_save_memory(NULL, NULL, y.S, y.F));
    SL_EXPECT(SL_ERR_ARGUMENT, pair_save_memory(NULL, &size, NULL, y.F));
    SL_EXPECT(SL_ERR_MISMATCH, pair_save_memory(NULL, &size, y.S, z.F));
    SL_EXPECT(SL_ERR_ARGUMENT, pair_save_memory(m.bytes, NULL, y.S, y.F));
    SL_EXPECT(SL_ERR_ARGUMENT, pair_save_memory(m.bytes, &m.size, NULL, y.F));
    SL_EXPECT(SL_ERR_ARGUMENT, pair_save_file(NULL, y.S, y.F, NULL));
    double *zeros = test_reals((size_t)y.M.p[25]);
    sl_csc bad = y.M.view;
    bad.x = zeros;
    SL_EXPECT(SL_ERR_PIVOT, sl_factor_refactor(y.F, &bad, NULL));
    SL_EXPECT(SL_ERR_STALE, pair_save_memory(NULL, &size, y.S, y.F)); /* a failed factor */
    assert_int_equal(size, 0);
    for (int k = 0; k < 2; k++) {
        sl_symbolic *S = y.S;
        sl_factor *F = y.F;
#define REFUSED(status, call) \
    S = y.S; \
    F = y.F; \
    SL_EXPECT(status, call); \
    assert_null(F)
        REFUSED(SL_ERR_ARGUMENT, calls[k](&S, &F, NULL, m.size, SL_LOAD_CHECKED, NULL));
        assert_null(S);
        REFUSED(SL_ERR_ARGUMENT, calls[k](&S, &F, m.bytes, m.size, (unsigned)3, NULL));
        assert_null(S);
        REFUSED(SL_ERR_ARGUMENT, calls[k](&S, &F, m.bytes, m.size, (unsigned)-1, NULL));
        opt = options_none();
        opt.size = 1;
        REFUSED(SL_ERR_ARGUMENT, calls[k](&S, &F, m.bytes, m.size, SL_LOAD_CHECKED, &opt));
        opt = options_none();
        opt.isa = SL_ISA_NEON;
        if (!isa_is_present(SL_ISA_NEON)) {
            REFUSED(SL_ERR_UNSUPPORTED, calls[k](&S, &F, m.bytes, m.size, SL_LOAD_CHECKED, &opt));
            assert_null(S);
        }
        REFUSED(SL_ERR_IO, calls[k](&S, &F, m.bytes, 0, SL_LOAD_CHECKED, NULL));
        REFUSED(SL_ERR_IO, calls[k](&S, &F, m.bytes, m.size - 64, SL_LOAD_CHECKED, NULL));
        assert_null(S);
    }
    saved_t moved = saved_of_size(m.size + 64);
    sl_symbolic *S = NULL;
    sl_factor *F = NULL;
    for (size_t k = 1; k < 64; k++) { /* copies need no alignment */
        memcpy(moved.bytes + k, m.bytes, m.size);
        SL_EXPECT(SL_ERR_ARGUMENT,
                  pair_map_memory(&S, &F, moved.bytes + k, m.size, SL_LOAD_CHECKED, NULL));
        SL_CHECK(pair_load_memory(&S, &F, moved.bytes + k, m.size, SL_LOAD_VERIFIED, NULL));
        sl_factor_free(F);
        sl_symbolic_free(S);
    }
    free(zeros);
    saved_free(&moved);
    saved_free(&m);
    factored_free(&y);
    factored_free(&z);
}

/* Each allocation fails in turn, and no call takes more than the saved bytes and two structs. */
static void allocations_may_fail(void **state) {
    (void)state;
    for (int way = 0; way < SAVED_WAYS; way++) {
        saved_case_t c = saved_case_make(way, GEN_GRID2, 100, 0, NULL);
        saved_t m = saved_make(c.y.S, c.y.F);
        for (int64_t k = 0, done = 0; !done; k++) {
            counter_t counter = counter_make();
            sl_options opt = options_counted(&counter);
            sl_symbolic *S = c.y.S;
            sl_factor *F = c.y.F;
            counter.fail_at = k;
            sl_status status = pair_load_memory(&S, &F, m.bytes, m.size, SL_LOAD_CHECKED, &opt);
            assert_true(status == SL_OK || status == SL_ERR_MEMORY);
            assert_true((S != NULL) == (status == SL_OK) && (F != NULL) == (status == SL_OK));
            if (status == SL_OK) {
                assert_true(counter.total_bytes < m.size + 4096);
                status = sl_factor_refactor(F, &c.y.M.view, NULL);
                assert_true(status == SL_OK || status == SL_ERR_MEMORY);
                counter.fail_at = -1;
                assert_same_answers(c.y.F, F); /* as it was, or the same numbers again */
                done = status == SL_OK;
            }
            sl_factor_free(F);
            sl_symbolic_free(S);
            COUNTER_CLEAN(&counter);
        }
        saved_free(&m);
        saved_case_free(&c);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(an_analysis_is_saved_without_a_factor),
        cmocka_unit_test(two_loads_are_independent),
        cmocka_unit_test(a_loaded_factor_can_be_refactored),
        cmocka_unit_test(a_mapped_factor_is_immutable),
        cmocka_unit_test(batches_refactor_loaded_factors),
        cmocka_unit_test(l_in_float_needs_its_kernels),
        cmocka_unit_test(wrong_arguments_are_refused),
        cmocka_unit_test(allocations_may_fail),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

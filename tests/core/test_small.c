/* test_small.c: small systems: one order however they are stored, and no clock */
#include "tests/lib/check_factor.h"

static sl_stats analyze(const sl_csc *A, sl_purpose purpose, sl_symbolic **S) {
    sl_options opt = options_none();
    sl_stats stats;
    memset(&stats, 0, sizeof stats);
    opt.purpose = purpose;
    opt.relaxation = SL_RELAXATION_NONE; /* the order of the elimination tree is kept */
    SL_CHECK(sl_symbolic_create(S, A, &opt, &stats));
    return stats;
}

/* One order however the matrix is stored, and a correct analysis. */
static void orders_are_valid(void **state) {
    (void)state;
    for (int kind = 0; kind < GEN_KINDS; kind++) {
        for (sl_int size = 1; size < 300; size += 1 + size / 5) {
            for (int purpose = SL_PURPOSE_MANY_SOLVES; purpose <= SL_PURPOSE_ONE_FACTOR;
                 purpose++) {
                sl_symbolic *S[GEN_STYLES];
                gen_list_t t = gen_make((gen_kind_t)kind, size, 1, 3);
                for (int style = 0; style < GEN_STYLES; style++) {
                    gen_matrix_t M = gen_store(&t, gen_style(style), 1);
                    (void)analyze(&M.view, (sl_purpose)purpose, &S[style]);
                    gen_matrix_free(&M);
                }
                const sl_symbolic_arrays v = sl_symbolic_view(S[0]);
                NOTHING_WRONG(check_permutation(v.n, v.perm, v.iperm));
                NOTHING_WRONG(check_supernodes(&v));
                for (int style = 0; style < GEN_STYLES; style++) {
                    const sl_symbolic_arrays w = sl_symbolic_view(S[style]);
                    assert_memory_equal(v.perm, w.perm, (size_t)v.n * sizeof(sl_int));
                }
                for (int style = 0; style < GEN_STYLES; style++) {
                    sl_symbolic_free(S[style]);
                }
                gen_list_free(&t);
            }
        }
    }
}

/* A full row without a diagonal entry is not eliminated after all of its neighbors. */
static void constraints_come_before(void **state) {
    (void)state;
    for (sl_int n = 10; n < 200; n += 50) {
        gen_list_t t = gen_list(n);
        for (sl_int v = 0; v < n - 1; v++) {
            gen_add(&t, n - 1, v, 1.0);
            gen_add(&t, v, v, 2.0);
        }
        gen_matrix_t M = gen_store(&t, gen_style(0), 1);
        sl_symbolic *S = NULL;
        (void)analyze(&M.view, SL_PURPOSE_MANY_SOLVES, &S);
        const sl_symbolic_arrays v = sl_symbolic_view(S);
        assert_int_equal(v.n, n);
        assert_true(v.iperm[n - 1] < n - 1);
        sl_symbolic_free(S);
        gen_matrix_free(&M);
        gen_list_free(&t);
    }
}

/* Reading the clock would take longer than what it measures. */
static void small_systems_take_no_time(void **state) {
    (void)state;
    gen_matrix_t M = gen_matrix(GEN_GRID2, 100, 1, 3);
    sl_symbolic *S = NULL;
    sl_factor *F = NULL;
    sl_stats stats;
    SL_CHECK(sl_symbolic_create(&S, &M.view, NULL, &stats));
    assert_true(stats.symbolic.seconds_order + stats.symbolic.seconds_analyze == 0.0);
    SL_CHECK(sl_factor_create(&F, S, &M.view, NULL, &stats));
    assert_true(stats.factor.seconds + stats.factor.seconds_setup == 0.0);
    SL_CHECK(sl_factor_refactor(F, &M.view, &stats));
    assert_true(stats.factor.seconds == 0.0);
    sl_factor_free(F);
    sl_symbolic_free(S);
    gen_matrix_free(&M);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(orders_are_valid),
        cmocka_unit_test(constraints_come_before),
        cmocka_unit_test(small_systems_take_no_time),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

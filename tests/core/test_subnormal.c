/* test_subnormal.c: matrices whose entries are all near the smallest numbers */
#include "tests/lib/gen_matrices.h"

/* Entries near the smallest numbers have few digits, and growth says so. */
static void growth_counts_the_digits_of_subnormal_entries(void **state) {
    (void)state;
    enum { N = 49 };
    variant_list_t variants = variants_present();
    gen_matrix_t M = gen_matrix(GEN_GRID2, N, 1, 3);
    double *keep = test_reals((size_t)M.p[N]), b[N], x[N], y[N];
    sl_symbolic *S = NULL;
    memcpy(keep, M.x, (size_t)M.p[N] * sizeof *keep);
    gen_reals(b, N, 5);
    SL_CHECK(sl_symbolic_create(&S, &M.view, NULL, NULL));
    for (int k = 0; k < 60 * variants.count; k++) {
        const int power = -1020 - k / variants.count;
        sl_options opt = options_none();
        sl_factor *F = NULL;
        sl_stats stats;
        double error = 0.0;
        options_set_variant(&opt, &variants, k % variants.count);
        for (sl_int p = 0; p < M.p[N]; p++) {
            M.x[p] = ldexp(keep[p], power);
        }
        const sl_status status = sl_factor_create(&F, S, &M.view, &opt, &stats);
        if (status == SL_OK) {
            for (int i = 0; i < N; i++) {
                y[i] = ldexp(b[i], power);
            }
            SL_CHECK(sl_factor_solve(F, x, N, y, N, 1, NULL));
            for (sl_int p = 0; p < M.p[N]; p++) { /* as they were rounded, without underflow */
                M.x[p] = ldexp(M.x[p], -power);
            }
            for (int i = 0; i < N; i++) {
                y[i] = ldexp(y[i], -power);
            }
            SL_CHECK(sl_csc_residual(&M.view, b, N, &error, x, N, y, N, 1));
            gen_reals(b, N, 5);
            assert_true(error <= 8.0 * DBL_EPSILON * stats.factor.growth);
            assert_true(power < -1022 || stats.factor.growth <= 2.0);
        } else {
            assert_true(status == SL_ERR_INACCURATE || status == SL_ERR_PIVOT);
            assert_true(power < -1065);
        }
        sl_factor_free(F);
    }
    sl_symbolic_free(S);
    gen_matrix_free(&M);
    free(keep);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(growth_counts_the_digits_of_subnormal_entries),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

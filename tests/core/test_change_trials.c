/* test_change_trials.c: downdates by several vectors on one long path, which are tried first */
#include "tests/lib/factored.h"

/* A dense matrix with more entries than a log of one pass may have, so that a pass of 2 to 4
 * vectors is tried before it changes anything; of up to 8, with AVX-512. */
enum { ROWS = 1040, MOST = 8 };

/* Vectors of one entry each, in the first rows of L. */
typedef struct downdate_t {
    sl_int p[MOST + 1];
    const sl_int *rows;
    double x[MOST], sigma[MOST];
} downdate_t;

static void downdate_fill(downdate_t *d, const sl_symbolic *S, sl_int count, double sigma) {
    d->rows = sl_symbolic_view(S).perm;
    for (sl_int k = 0; k < count; k++) {
        d->p[k] = k;
        d->x[k] = 1.0 - 0.05 * (double)k;
        d->sigma[k] = sigma;
    }
    d->p[count] = count;
}

/* The largest residual of a solve with the factor of A - sum of x^2 in the rows of d. */
static double residual_of(const factored_t *y, const downdate_t *d, sl_int count) {
    double *b = test_reals(ROWS), *x = test_reals(ROWS), *r = test_reals(ROWS), most = 0.0;
    gen_reals(b, ROWS, 3);
    SL_CHECK(sl_factor_solve(y->F, x, ROWS, b, ROWS, 1, NULL));
    SL_CHECK(sl_csc_multiply(&y->M.view, SL_AS_SYMMETRIC, r, ROWS, x, ROWS, 1));
    for (sl_int k = 0; k < count; k++) {
        r[d->rows[k]] += d->sigma[k] * d->x[k] * d->x[k] * x[d->rows[k]];
    }
    for (size_t k = 0; k < ROWS; k++) {
        most = fmax(most, fabs(r[k] - b[k]));
    }
    free(b);
    free(x);
    free(r);
    return most;
}

static void downdates_are_tried(void **state) {
    (void)state;
    const isa_list_t isas = isas_present();
    for (int isa = 0; isa < isas.count; isa++) {
        sl_options opt = options_none();
        opt.isa = isas.isa[isa];
        factored_t y = factored_make(GEN_DENSE, ROWS, 1, 0, &opt);
        double *before = test_reals(ROWS);
        for (sl_int count = 2; count <= MOST; count += count < 4 ? 1 : 4) {
            downdate_t d;
            sl_stats stats;
            memcpy(before, sl_factor_view(y.F).D, ROWS * sizeof *before);
            downdate_fill(&d, y.S, count, -0.1);
            const sl_csc V = {ROWS, count, d.p, d.rows, d.x};
            d.sigma[count - 1] = -1e5; /* too much for a pivot */
            SL_EXPECT(SL_ERR_PIVOT, sl_factor_rank_update(y.F, &V, d.sigma, NULL, &stats));
            assert_memory_equal(sl_factor_view(y.F).D, before, ROWS * sizeof *before);
            assert_true(residual_of(&y, &d, 0) <= 1e-11);
            downdate_fill(&d, y.S, count, -0.1);
            d.sigma[0] = count % 2 ? 1e5 : -0.1; /* a pivot grows, or none */
            SL_CHECK(sl_factor_rank_update(y.F, &V, d.sigma, NULL, &stats));
            assert_true(stats.change.entries > 1 << 19);
            assert_true(residual_of(&y, &d, count) <= 1e-11);
            SL_CHECK(sl_factor_refactor(y.F, &y.M.view, NULL));
        }
        free(before);
        factored_free(&y);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(downdates_are_tried)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}

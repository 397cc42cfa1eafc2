/* judge_bounds.h: the way of judges through certified factors: no error is above its bound */
#ifndef SL_TEST_JUDGE_BOUNDS_H
#define SL_TEST_JUDGE_BOUNDS_H

#include "exact_solve.h"
#include "judge.h"

/* Bounds of a local solve against the exact solution. A factor that cannot be certified says so.
 * Solves by F that do not converge to an exact solution leave nothing to compare with: A is too ill
 * conditioned for refinement, and the certificate has to be refused. */
static inline void judge_way_bounds(judge_t *t) {
    const size_t n = t->n;
    const sl_int nb = 1 + gen_below(&t->state, (sl_int)n), nx = 1 + gen_below(&t->state, (sl_int)n);
    const sl_csc *A = &t->y->M.view;
    sl_int *bset = test_ints(n), *xset = test_ints(n);
    double *b = test_reals(n), *full = test_reals(n), *x = test_reals(n), *bounds = test_reals(n);
    twice_t *exact = (twice_t *)test_array(n, sizeof *exact);
    sl_stats stats;
    sl_plan *P = NULL;
    gen_set(bset, nb, (sl_int)n, gen_bits(&t->state));
    gen_set(xset, nx, (sl_int)n, gen_bits(&t->state));
    gen_reals(b, n, gen_bits(&t->state));
    for (sl_int k = 0; k < nb; k++) {
        full[bset[k]] = b[k];
    }
    if (t->stats.factor.null == 0 && /* else exact solutions are those of a submatrix */
        sl_factor_certify(t->F, A, gen_below(&t->state, 4) ? SL_ESTIMATED : SL_GUARANTEED, NULL,
                          &stats) == SL_OK) {
        SL_CHECK(sl_plan_create(&P, t->S, bset, nb, xset, nx, NULL, NULL));
        if (judge_succeeded(t,
                            sl_plan_solve_bounded(P, t->F, x, n, bounds, b, n, 1, NULL, NULL, NULL),
                            "bounds")) {
            double worst = 0.0;
            exact_solve(t->F, A, full, NULL, exact);
            for (sl_int k = 0; k < nx; k++) {
                const twice_t z = exact[xset[k]];
                const double error = fabs((z.high - x[k]) + z.low);
                worst = fmax(worst, error > bounds[k] ? error / (bounds[k] + DBL_MIN) : 0.0);
            }
            judge_answer(t, worst, 1.0, 0, "bounds");
        }
    }
    sl_plan_free(P);
    free(bset);
    free(xset);
    free(b);
    free(full);
    free(x);
    free(bounds);
    free(exact);
}

#endif

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
    const sl_csc *A = &t->y->M.view;
    judge_question_t q = judge_question(t);
    double *x = test_reals(n), *bounds = test_reals(n);
    twice_t *exact = (twice_t *)test_array(n, sizeof *exact);
    sl_stats stats;
    sl_plan *P = NULL;
    if (t->stats.factor.null == 0 && /* else exact solutions are those of a submatrix */
        sl_factor_certify(t->F, A, gen_below(&t->state, 4) ? SL_ESTIMATED : SL_GUARANTEED, NULL,
                          &stats) == SL_OK) {
        SL_CHECK(sl_plan_create(&P, t->S, q.bset, q.nb, q.xset, q.nx, NULL, NULL));
        if (judge_succeeded(
                t, sl_plan_solve_bounded(P, t->F, x, n, bounds, q.b, n, 1, NULL, NULL, NULL),
                "bounds")) {
            double worst = 0.0;
            exact_solve(t->F, A, q.full, NULL, exact);
            for (sl_int k = 0; k < q.nx; k++) {
                const twice_t z = exact[q.xset[k]];
                const double error = fabs((z.high - x[k]) + z.low);
                worst = fmax(worst, error > bounds[k] ? error / (bounds[k] + DBL_MIN) : 0.0);
            }
            judge_answer(t, worst, 1.0, 0, "bounds");
        }
    }
    sl_plan_free(P);
    judge_question_free(&q);
    free(x);
    free(bounds);
    free(exact);
}

#endif

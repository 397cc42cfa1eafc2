/* judge_bounds.h: the way of judges through certified factors: no error is above its bound */
#ifndef SL_TEST_JUDGE_BOUNDS_H
#define SL_TEST_JUDGE_BOUNDS_H

#include "exact_centered.h"
#include "judge.h"

/* The exact answers to a question: with skipped null pivots those that are 0 in their rows or, with
 * weights, that have a weighted mean of 0. */
static inline void judge_exact(const judge_t *t, const sl_factor *F, const double *b, twice_t *x) {
    const judge_system_t *y = t->y;
    sl_options opt = t->opt;
    sl_factor *exact = NULL; /* without weights */
    sl_int count = 0, *rows = test_ints(t->n);
    int *held = (int *)test_array(t->n, sizeof *held);
    opt.mass = NULL;
    opt.consistency_tolerance = -1.0;
    SL_CHECK(sl_factor_pivot_rows(F, SL_PIVOT_NULL, rows, NULL, y->n, &count));
    for (sl_int k = 0; k < count; k++) {
        held[rows[k]] = 1;
    }
    if (count > 0) {
        SL_CHECK(sl_factor_create(&exact, t->S, &y->M.view, &opt, NULL));
    }
    if (count > 0 && t->opt.mass) {
        exact_centered(exact, &y->M.view, b, y->mass, y->vectors > 0 ? y->Z : NULL, y->of, held, x);
    } else {
        exact_solve(exact ? exact : F, &y->M.view, b, held, x);
    }
    sl_factor_free(exact);
    free(rows);
    free(held);
}

/* Bounds of a local solve against the exact solution. A factor that cannot be certified says so.
 * Solves by F that do not converge to an exact solution leave nothing to compare with: A is too ill
 * conditioned for refinement, and the certificate has to be refused. */
static inline void judge_way_bounds(judge_t *t) {
    const size_t n = t->n;
    const sl_csc *A = &t->y->M.view;
    const sl_certainty certainty = gen_below(&t->state, 4) ? SL_ESTIMATED : SL_GUARANTEED;
    judge_question_t q = judge_question(t);
    double *x = test_reals(n), *bounds = test_reals(n);
    twice_t *exact = (twice_t *)test_array(n, sizeof *exact);
    sl_options opt = t->opt;
    sl_factor *F = NULL;
    sl_stats stats;
    sl_plan *P = NULL;
    opt.consistency_tolerance = -1.0;
    SL_CHECK(sl_factor_create(&F, t->S, A, &opt, NULL));
    if (judge_succeeded(t, sl_factor_certify(F, A, certainty, NULL, &stats), "certify")) {
        SL_CHECK(sl_plan_create(&P, t->S, q.bset, q.nb, q.xset, q.nx, NULL, NULL));
        if (judge_succeeded(t,
                            sl_plan_solve_bounded(P, F, x, n, bounds, q.b, n, 1, NULL, NULL, NULL),
                            "bounds")) {
            double worst = 0.0;
            judge_exact(t, F, q.full, exact);
            for (sl_int k = 0; k < q.nx; k++) {
                const twice_t z = exact[q.xset[k]];
                const double found = fabs((z.high - x[k]) + z.low);
                const double error = found > 1e-290 ? found : 0.0; /* b / DBL_MAX in null rows */
                worst = fmax(worst, error > bounds[k] ? error / (bounds[k] + DBL_MIN) : 0.0);
                t->tally->bounds += error > 0.0;
            }
            judge_answer(t, worst, 1.0, 0, "bounds");
        }
    }
    sl_plan_free(P);
    sl_factor_free(F);
    judge_question_free(&q);
    free(x);
    free(bounds);
    free(exact);
}

#endif

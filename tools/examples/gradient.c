/* gradient.c: the derivative of a few answers by a source and by edge weights: two local solves */
#define SL_WITH_CHANGE
#include "example.h"

enum { SOURCE = 10 * SIDE + 10, SENSORS = 2, EDGES = 3, ROWS = 2 * EDGES };

static const sl_int sensors[SENSORS] = {12 * SIDE + 11, 14 * SIDE + 13};
static const double wanted[SENSORS] = {0.05, 0.02};
/* the edges from tails[e] to tails[e] + 1, whose weights may change */
static const sl_int tails[EDGES] = {11 * SIDE + 10, 12 * SIDE + 12, 30 * SIDE + 30};

/* Both ends of all edges, and where b and the sensors are. */
static sl_int plan_rows(sl_int *rows) {
    sl_int e;
    for (e = 0; e < EDGES; e++) {
        rows[2 * e] = tails[e];
        rows[2 * e + 1] = tails[e] + 1;
    }
    return ROWS;
}

/* half the sum of (x - wanted)^2 over the sensors, its residuals, and x at the ends of the edges */
static double loss(const sl_factor *F, const sl_plan *P, double b, double *residuals, double *x) {
    double answers[SENSORS + ROWS], sum = 0.0;
    sl_int k;
    ok(sl_plan_solve(P, F, answers, SENSORS + ROWS, &b, 1, 1, NULL));
    for (k = 0; k < SENSORS; k++) {
        residuals[k] = answers[k] - wanted[k];
        sum += residuals[k] * residuals[k] / 2.0;
    }
    for (k = 0; k < ROWS; k++) {
        x[k] = answers[SENSORS + k];
    }
    return sum;
}

int main(void) {
    sl_matrix *M = grid_laplacian(0.1);
    const sl_csc A = sl_matrix_view(M);
    sl_symbolic *S = NULL;
    sl_factor *F = NULL;
    sl_plan *forward = NULL, *adjoint = NULL;
    sl_int rows[SENSORS + ROWS] = {sensors[0], sensors[1]}, back[1 + ROWS] = {SOURCE}, e;
    const sl_int source = SOURCE;
    double residuals[SENSORS], other[SENSORS], x[ROWS], lambda[1 + ROWS], unused[ROWS], worst = 0.0;
    const double step = 1e-5;
    plan_rows(rows + SENSORS);
    plan_rows(back + 1);
    ok(sl_symbolic_create(&S, &A, NULL, NULL));
    ok(sl_factor_create(&F, S, &A, NULL, NULL));
    /* ---- plans ---- */
    /* x at the sensors and the edges; then lambda = A^-1 dl/dx at the source and the edges */
    ok(sl_plan_create(&forward, S, &source, 1, rows, SENSORS + ROWS, NULL, NULL));
    ok(sl_plan_create(&adjoint, S, sensors, SENSORS, back, 1 + ROWS, NULL, NULL));
    loss(F, forward, 1.0, residuals, x);
    ok(sl_plan_solve(adjoint, F, lambda, 1 + ROWS, residuals, SENSORS, 1, NULL));
    /* ---- end ---- */
    printf("by the source: %.6e, by differences %.6e\n", lambda[0],
           (loss(F, forward, 1.0 + step, other, unused) -
            loss(F, forward, 1.0 - step, other, unused)) /
               (2.0 * step));
    /* dA = dw (e_i - e_j)(e_i - e_j)', and dl = -lambda' dA x */
    for (e = 0; e < EDGES; e++) {
        const double *l = lambda + 1 + 2 * e, *at = x + 2 * e;
        const double derivative = -(l[0] - l[1]) * (at[0] - at[1]);
        const sl_int p[2] = {0, 2}, i[2] = {tails[e], tails[e] + 1};
        double v[2], losses[2], sigma = 1.0;
        int k;
        for (k = 0; k < 2; k++) { /* with the weight changed, and back */
            const sl_csc V = {N, 1, p, i, v};
            v[0] = sqrt(step);
            v[1] = -v[0];
            sigma = k == 0 ? 1.0 : -2.0;
            ok(sl_factor_rank_update(F, &V, &sigma, NULL, NULL));
            losses[k] = loss(F, forward, 1.0, other, unused);
        }
        ok(sl_factor_refactor(F, &A, NULL));
        printf("by edge %d: %.6e, by differences %.6e\n", (int)e, derivative,
               (losses[0] - losses[1]) / (2.0 * step));
        worst = fmax(worst, fabs((losses[0] - losses[1]) / (2.0 * step) - derivative));
    }
    sl_plan_free(forward);
    sl_plan_free(adjoint);
    sl_factor_free(F);
    sl_symbolic_free(S);
    sl_matrix_free(M);
    return !(worst < 1e-8);
}

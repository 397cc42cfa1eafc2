/* local.c: a local solve: heat at one vertex, temperatures wanted at three, by a plan */
#include "example.h"

int main(void) {
    sl_matrix *M = grid_laplacian(0.1);
    const sl_csc A = sl_matrix_view(M);
    sl_symbolic *S = NULL;
    sl_factor *F = NULL;
    const sl_int source[] = {820}, wanted[] = {821, 860, 1599};
    const double heat[] = {1.0};
    double x[3];
    sl_plan *P = NULL;
    sl_stats stats;
    sl_work *W = NULL;
    ok(sl_symbolic_create(&S, &A, NULL, NULL));
    ok(sl_factor_create(&F, S, &A, NULL, NULL));
    ok(sl_plan_create(&P, S, source, 1, wanted, 3, NULL, &stats));
    ok(sl_work_create(&W, NULL));                               /* one for each thread */
    ok(sl_plan_solve(P, F, x, 3, heat, 1, 1, W));               /* any number of times */
    printf("%g %g %g from %d and %d of %d columns\n", x[0], x[1], x[2], (int)stats.plan.b_columns,
           (int)stats.plan.x_columns, N);
    sl_work_free(W);
    sl_plan_free(P);
    sl_factor_free(F);
    sl_symbolic_free(S);
    sl_matrix_free(M);
    return !(x[0] > x[2] && x[2] > 0.0 && stats.plan.b_columns < N);
}

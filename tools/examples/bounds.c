/* bounds.c: a local solve that says how far each of its answers is from the exact one */
#define SL_WITH_ACCURACY
#include "example.h"

enum { SOURCE = 20 * SIDE + 20, COUNT = 4 };

int main(void) {
    sl_matrix *M = grid_laplacian(0.1);
    const sl_csc A = sl_matrix_view(M);
    const sl_int source = SOURCE, rows[COUNT] = {SOURCE, SOURCE + 1, SOURCE + 4, SOURCE + 15};
    const double one = 1.0;
    double x[COUNT], bounds[COUNT], scales[4 * COUNT + 2] = {0.0}; /* 0: not computed yet */
    sl_symbolic *S = NULL;
    sl_factor *F = NULL;
    sl_plan *P = NULL;
    sl_stats stats;
    int k, is_small = 1;
    ok(sl_symbolic_create(&S, &A, NULL, NULL));
    ok(sl_factor_create(&F, S, &A, NULL, NULL));
    /* ---- bounds ---- */
    ok(sl_factor_certify(F, &A, SL_ESTIMATED, NULL, &stats));
    printf("relative error in the energy norm at most %.1e\n", stats.certificate.eta);
    ok(sl_plan_create(&P, S, &source, 1, rows, COUNT, NULL, NULL));
    ok(sl_plan_solve_bounded(P, F, x, COUNT, bounds, &one, 1, 1, scales, NULL, NULL));
    /* ---- end ---- */
    for (k = 0; k < COUNT; k++) {
        printf("x = %.15f +- %.1e\n", x[k], bounds[k]);
        is_small &= bounds[k] < 1e-13;
    }
    sl_plan_free(P);
    sl_factor_free(F);
    sl_symbolic_free(S);
    sl_matrix_free(M);
    return !is_small;
}

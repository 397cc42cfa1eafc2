/* poisson.c: a singular Laplacian: the zero-mean solution of a Poisson problem */
#include "example.h"

int main(void) {
    sl_matrix *M = grid_laplacian(0.0);
    const sl_csc A = sl_matrix_view(M);
    sl_symbolic *S = NULL;
    sl_factor *F = NULL;
    static double mass[N], b[N], x[N];
    sl_options opt;
    double mean = 0.0;
    sl_int k;
    for (k = 0; k < N; k++) {
        mass[k] = 1.0 / N;
    }
    b[0] = 1.0; /* need not be consistent: a multiple of mass makes it so */
    sl_options_init(&opt, sizeof opt);
    opt.pivots = SL_PIVOTS_SKIP_NULL;
    opt.mass = mass;
    ok(sl_symbolic_create(&S, &A, NULL, NULL));
    ok(sl_factor_create(&F, S, &A, &opt, NULL));
    ok(sl_factor_solve(F, x, N, b, N, 1, NULL));
    for (k = 0; k < N; k++) {
        mean += mass[k] * x[k];
    }
    printf("x(0) = %g, mean %.1e\n", x[0], mean);
    sl_factor_free(F);
    sl_symbolic_free(S);
    sl_matrix_free(M);
    return !(fabs(mean) < 1e-14 && x[0] > 0.0);
}

/* constraints.c: a membrane held at a few vertices, which are grabbed, moved and released */
#define SL_WITH_CONSTRAINTS
#include "example.h"

int main(void) {
    sl_matrix *M = grid_laplacian(0.0);
    const sl_csc A = sl_matrix_view(M);
    const sl_int handles[4] = {0, SIDE - 1, N - SIDE, N / 2 + SIDE / 2}, last = 3;
    static double b[N], x[N];
    double heights[4] = {0.0, 0.0, 0.0, 1.0};
    sl_options options;
    sl_symbolic *S = NULL;
    sl_factor *F = NULL;
    sl_constraints *P = NULL;
    sl_options_init(&options, sizeof options);
    options.pivots = SL_PIVOTS_SKIP_NULL; /* without pins the Laplacian is singular */
    ok(sl_symbolic_create(&S, &A, NULL, NULL));
    ok(sl_factor_create(&F, S, &A, &options, NULL));
    /* ---- pins ---- */
    ok(sl_constraints_create(&P, F, NULL));
    ok(sl_constraints_add(P, handles, NULL, 4, NULL)); /* a forward sweep each; F stays as it is */
    ok(sl_constraints_solve(P, NULL, x, N, b, N, heights, 4, 1, NULL));
    printf("three corners at 0, the middle at %g: the fourth corner at %.4f\n", x[handles[3]],
           x[N - 1]);
    heights[3] = 2.0; /* moved: the solution is twice as high */
    const double before = x[N - 1];
    ok(sl_constraints_solve(P, NULL, x, N, b, N, heights, 4, 1, NULL));
    const double twice = x[N - 1];
    ok(sl_constraints_release(P, &last, 1, NULL));
    ok(sl_constraints_solve(P, NULL, x, N, b, N, heights, 4, 1, NULL));
    /* ---- end ---- */
    printf("moved to 2: %.4f; released: %.4f\n", twice, fabs(x[N - 1]));
    sl_constraints_free(P);
    sl_factor_free(F);
    sl_symbolic_free(S);
    sl_matrix_free(M);
    return !(fabs(twice - 2.0 * before) < 1e-12 && fabs(x[N - 1]) < 1e-12);
}

/* sample.c: samples with covariance A^-1 on a few rows alone, by half of a local solve */
#define SL_WITH_ACCURACY
#define SL_WITH_INVERSE
#include "example.h"

int main(void) {
    sl_matrix *M = grid_laplacian(0.1);
    const sl_csc A = sl_matrix_view(M);
    sl_symbolic *S = NULL;
    sl_factor *F = NULL;
    enum { MOST = 512 };
    const unsigned parts = SL_PART_SQRT_D | SL_PART_LT | SL_PART_PT;
    const sl_int wanted[] = {820};
    static double z[MOST];
    double x, sum = 0.0, exact;
    sl_plan *P = NULL;
    sl_stats stats;
    sl_int k;
    int q, draw;
    ok(sl_symbolic_create(&S, &A, NULL, NULL));
    ok(sl_factor_create(&F, S, &A, NULL, NULL));
    ok(sl_plan_create(&P, S, wanted, 0, wanted, 1, NULL, &stats));
    for (draw = 0; draw < 4000 && stats.plan.x_columns <= MOST; draw++) {
        for (k = 0; k < stats.plan.x_columns; k++) { /* nearly normal: 12 uniforms */
            for (z[k] = -6.0, q = 0; q < 12; q++) {
                z[k] += rand() / (RAND_MAX + 1.0);
            }
        }
        ok(sl_factor_solve_part(F, P, parts, &x, 1, z, (size_t)stats.plan.x_columns, 1, NULL));
        sum += x * x;
    }
    ok(sl_inverse_diagonal(F, &exact, wanted, 1, NULL, NULL));
    printf("variance %.4f, exactly %.4f\n", sum / 4000, exact);
    sl_plan_free(P);
    sl_factor_free(F);
    sl_symbolic_free(S);
    sl_matrix_free(M);
    return !(fabs(sum / 4000 - exact) < 0.15 * exact);
}

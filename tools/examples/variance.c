/* variance.c: entries of the inverse: the variances of a few unknowns and of a sum of them */
#define SL_WITH_INVERSE
#include "example.h"

int main(void) {
    sl_matrix *M = grid_laplacian(0.1);
    const sl_csc A = sl_matrix_view(M);
    sl_symbolic *S = NULL;
    sl_factor *F = NULL;
    const sl_int rows[] = {0, 20, 820};
    const double weights[] = {0.5, -0.25, 1.0};
    double variance[3], covariance, x[3], sum = 0.0;
    const sl_int other[] = {821};
    sl_int k;
    ok(sl_symbolic_create(&S, &A, NULL, NULL));
    ok(sl_factor_create(&F, S, &A, NULL, NULL));
    ok(sl_inverse_diagonal(F, variance, rows, 3, NULL, NULL));
    ok(sl_inverse_pairs(F, &covariance, rows + 2, other, 1, NULL, NULL));
    for (k = 0; k < 3; k++) {
        printf("row %d: variance %.6f\n", (int)rows[k], variance[k]);
    }
    printf("correlation of 820 and 821 is about %.3f\n", covariance / variance[2]);
    /* the variance of w' x for weights w of these rows: w' A^-1 w, by a local solve */
    ok(sl_local_solve(F, rows, 3, rows, 3, x, 3, weights, 3, 1, NULL, NULL));
    for (k = 0; k < 3; k++) {
        sum += weights[k] * x[k];
    }
    printf("weighted sum: variance %.6f\n", sum);
    sl_factor_free(F);
    sl_symbolic_free(S);
    sl_matrix_free(M);
    return !(variance[0] > variance[2] && covariance > 0.0 && covariance < variance[2] &&
             sum > 0.0);
}

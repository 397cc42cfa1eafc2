/* fixed.c: a harmonic map: the border of a mesh is laid on a circle, the rest follows */
#define SL_WITH_FIXED
#include "example.h"

int main(void) {
    sl_matrix *M = grid_laplacian(0.0);
    const sl_csc A = sl_matrix_view(M);
    const sl_int count = 4 * (SIDE - 1);
    static sl_int border[4 * SIDE];
    static double circle[8 * SIDE], uv[2 * N];
    double most = 0.0, middle = 0.0;
    sl_fixed *D = NULL;
    sl_int k;
    for (k = 0; k < SIDE - 1; k++) { /* around the border, side after side */
        border[k] = k;
        border[k + SIDE - 1] = SIDE * (k + 1) - 1;
        border[k + 2 * (SIDE - 1)] = N - 1 - k;
        border[k + 3 * (SIDE - 1)] = SIDE * (SIDE - 1 - k);
    }
    for (k = 0; k < count; k++) {
        circle[2 * k] = cos(6.283185307179586 * k / count);
        circle[2 * k + 1] = sin(6.283185307179586 * k / count);
    }
    /* ---- solve ---- */
    ok(sl_fixed_create(&D, &A, border, count, NULL, NULL));
    ok(sl_fixed_solve(D, uv, SL_ROWS(2), NULL, 0, circle, SL_ROWS(2), 2, NULL));
    /* ---- end ---- */
    for (k = 0; k < N; k++) { /* a harmonic function is largest on the border */
        most = fmax(most, hypot(uv[2 * k], uv[2 * k + 1]));
    }
    middle = hypot(uv[2 * (N / 2 + SIDE / 2)], uv[2 * (N / 2 + SIDE / 2) + 1]);
    printf("all vertices within %.6f of the center, the middle one within %.4f\n", most, middle);
    for (k = 0; k < 2 * count; k++) {
        circle[k] *= 3.0; /* moved: no new factorization */
    }
    ok(sl_fixed_solve(D, uv, SL_ROWS(2), NULL, 0, circle, SL_ROWS(2), 2, NULL));
    sl_fixed_free(D);
    sl_matrix_free(M);
    return !(fabs(most - 1.0) < 1e-12 && middle < 0.1 &&
             fabs(hypot(uv[2 * border[5]], uv[2 * border[5] + 1]) - 3.0) < 1e-12);
}

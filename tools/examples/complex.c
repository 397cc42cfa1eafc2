/* complex.c: a vector carried over a surface by a complex Hermitian system */
#define SL_WITH_COMPLEX
#include "example.h"

/* The tangent plane of vertex v has an x-axis of its own, here rotated by frame(v). */
static double frame(sl_int v) {
    return 0.7 * (double)(v % SIDE) + 0.01 * (double)v * (double)v / N;
}

/* grid_laplacian(0) t + I, with each weight turned from the frame of one vertex to the other's. */
static void turn(const sl_csc *L, double t, double *values) {
    for (sl_int j = 0; j < N; j++) {
        for (sl_int p = L->p[j]; p < L->p[j + 1]; p++) {
            const sl_int i = L->i[p];
            const double angle = i == j ? 0.0 : frame(j) - frame(i);
            values[2 * p] = t * L->x[p] * cos(angle) + (i == j ? 1.0 : 0.0);
            values[2 * p + 1] = i == j ? 0.0 : t * L->x[p] * sin(angle);
        }
    }
}

int main(void) {
    sl_matrix *grid = grid_laplacian(0.0), *M = NULL;
    const sl_csc L = sl_matrix_view(grid);
    const sl_int source[1] = {SIDE / 2}, wanted[2] = {N / 2 + 7, N - 1};
    const double b[2] = {1.0, 0.0}; /* the vector 1 in the frame of the source */
    static double values[6 * N];
    double x[4], worst = 0.0;
    sl_options options;
    sl_symbolic *S = NULL;
    sl_factor *F = NULL;
    sl_plan *P = NULL;
    turn(&L, 100.0, values);
    /* ---- solve ---- */
    const sl_hermitian H = {N, L.p, L.i, values, NULL};
    ok(sl_matrix_from_hermitian(&M, &H, NULL, NULL));
    const sl_csc A = sl_matrix_view(M); /* 2 N real rows */
    sl_options_init(&options, sizeof options);
    options.block_size = 2; /* the two rows of a vertex stay together */
    ok(sl_symbolic_create(&S, &A, &options, NULL));
    sl_options_init(&options, sizeof options);
    options.storage = SL_STORAGE_COMPLEX; /* of two columns that say the same, L keeps one */
    ok(sl_factor_create(&F, S, &A, &options, NULL));
    ok(sl_complex_plan_create(&P, S, source, 1, wanted, 2, NULL, NULL)); /* in complex rows */
    ok(sl_plan_solve(P, F, x, 4, b, 2, 1, NULL));
    /* ---- end ---- */
    for (int k = 0; k < 2; k++) {
        const double found = atan2(x[2 * k + 1], x[2 * k]);
        /* the grid is flat: the vector is parallel everywhere, and only the frame differs */
        const double expected = frame(source[0]) - frame(wanted[k]);
        printf("vertex %4d: angle %7.4f\n", (int)wanted[k], found);
        worst = fmax(worst, fabs(sin(found - expected)));
    }
    sl_plan_free(P);
    sl_factor_free(F);
    sl_symbolic_free(S);
    sl_matrix_free(M);
    sl_matrix_free(grid);
    return !(worst < 1e-9);
}

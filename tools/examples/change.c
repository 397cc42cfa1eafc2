/* change.c: edges of a graph become stiffer one after the other; the factor follows each change */
#define SL_WITH_CHANGE
#include "example.h"

int main(void) {
    sl_matrix *M = grid_laplacian(0.1);
    const sl_csc A = sl_matrix_view(M);
    static double values[3 * N], b[N], x[N], y[N];
    sl_csc changed = A;
    sl_symbolic *S = NULL;
    sl_factor *F = NULL;
    sl_stats stats = {0};
    sl_int v, step;
    double error = 0.0;
    b[0] = 1.0;
    changed.x = values;
    for (v = 0; v < A.p[N]; v++) {
        values[v] = A.x[v];
    }
    ok(sl_symbolic_create(&S, &A, NULL, NULL));
    ok(sl_factor_create(&F, S, &A, NULL, NULL));
    for (step = 0; step < 5; step++) { /* the first entries of column v: its diagonal and v + 1 */
        const sl_int at = 7 * step, right = at + 1, rows[3] = {at, right, right};
        const sl_int columns[3] = {at, right, at};
        const double deltas[3] = {2.0, 2.0, -2.0};
        values[A.p[at]] += 2.0;
        values[A.p[right]] += 2.0;
        values[A.p[at] + 1] -= 2.0;
        ok(sl_factor_change_entries(F, &changed, rows, columns, deltas, 3, NULL, &stats));
    }
    ok(sl_factor_solve(F, x, N, b, N, 1, NULL));
    printf("%d rank-one changes since the factorization\n", (int)stats.change.updates);
    ok(sl_factor_refactor(F, &changed, NULL)); /* for comparison */
    ok(sl_factor_solve(F, y, N, b, N, 1, NULL));
    for (v = 0; v < N; v++) {
        error = fmax(error, fabs(x[v] - y[v]));
    }
    sl_factor_free(F);
    sl_symbolic_free(S);
    sl_matrix_free(M);
    return !(error < 1e-14);
}

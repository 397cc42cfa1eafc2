/* signatures.c: heat kernel signatures: the diagonal of (M + t K)^-1 for several t */
#define SL_WITH_BATCH
#define SL_WITH_INVERSE
#include "example.h"

enum { TIMES = 4, ROWS = 2 };

static void *allocate(sl_off count) {
    void *block = malloc((size_t)count * sizeof(double));
    if (block == NULL) {
        exit(1);
    }
    return block;
}

int main(void) {
    sl_matrix *laplacian = grid_laplacian(0.0);
    const sl_csc K = sl_matrix_view(laplacian);
    static sl_int p[N + 1], i[N];
    static double masses[N];
    const sl_csc M = {N, N, p, i, masses};
    const sl_int rows[ROWS] = {0, 820}; /* a corner, and a vertex in the middle */
    double h[TIMES][ROWS], *m, *k;
    sl_symbolic *S = NULL;
    sl_factor *F[TIMES] = {NULL};
    sl_stats stats;
    int t, is_right = 1;
    for (sl_int v = 0; v < N; v++) {
        p[v + 1] = v + 1;
        i[v] = v;
        masses[v] = 1.0;
    }
    /* ---- sums ---- */
    ok(sl_symbolic_create(&S, &K, NULL, &stats)); /* K has entries wherever M has one */
    m = allocate(stats.symbolic.nnz_a);
    k = allocate(stats.symbolic.nnz_a);
    ok(sl_symbolic_scatter(S, m, &M, NULL)); /* once for each term */
    ok(sl_symbolic_scatter(S, k, &K, NULL));
    const double *const terms[2] = {m, k};
    const double weights[2 * TIMES] = {1, 0.1, 1, 1, 1, 10, 1, 100}; /* 1 and t, for each t */
    ok(sl_factor_create_sums(F, TIMES, S, weights, terms, 2, NULL, NULL, NULL));
    for (t = 0; t < TIMES; t++) {
        ok(sl_inverse_diagonal(F[t], h[t], rows, ROWS, NULL, NULL));
    }
    /* ---- end ---- */
    for (t = 0; t < TIMES; t++) {
        printf("t = %5g: %.4f stays in the corner, %.4f in the middle\n", weights[2 * t + 1],
               h[t][0], h[t][1]);
        is_right &= h[t][0] > h[t][1] && (t == 0 || h[t][0] < h[t - 1][0]);
        sl_factor_free(F[t]);
    }
    free(m);
    free(k);
    sl_symbolic_free(S);
    sl_matrix_free(laplacian);
    return !is_right;
}

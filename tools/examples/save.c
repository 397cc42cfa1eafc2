/* save.c: a factor in a file, mapped by another process without reading or copying it */
#define SL_WITH_SAVE
#include "example.h"

int main(void) {
    sl_matrix *M = grid_laplacian(0.1);
    const sl_csc A = sl_matrix_view(M);
    sl_symbolic *S = NULL;
    sl_factor *F = NULL;
    static double b[N], x[N], y[N];
    sl_saved_set set = {0}, got = {0};
    const char *path = "example.slf";
    b[7] = 1.0;
    ok(sl_symbolic_create(&S, &A, NULL, NULL));
    ok(sl_factor_create(&F, S, &A, NULL, NULL));
    ok(sl_factor_solve(F, x, N, b, N, 1, NULL));
    set.symbolic = S;
    set.factor = F;
    ok(sl_save(path, NULL, NULL, &set, NULL));
    ok(sl_load(&got, path, NULL, 0, SL_LOAD_MAPPED, NULL)); /* here or in any other process */
    ok(sl_factor_solve(got.factor, y, N, b, N, 1, NULL));
    printf("x(7) = %.15f, from the file %.15f\n", x[7], y[7]);
    sl_saved_set_free(&got);
    remove(path);
    sl_factor_free(F);
    sl_symbolic_free(S);
    sl_matrix_free(M);
    return x[7] != y[7];
}

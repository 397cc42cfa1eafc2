/* ordering.c: an order for many local solves, and one for the earliest factor */
#include "example.h"

int main(void) {
    sl_matrix *M = grid_laplacian(0.1);
    const sl_csc A = sl_matrix_view(M);
    const char *const text[] = {"many solves", "one factor"};
    const sl_purpose purpose[] = {SL_PURPOSE_MANY_SOLVES, SL_PURPOSE_ONE_FACTOR};
    const sl_int corner[] = {0};
    sl_off reads[2];
    int k;
    for (k = 0; k < 2; k++) {
        sl_symbolic *S = NULL;
        sl_plan *P = NULL;
        sl_options options;
        sl_stats stats;
        sl_options_init(&options, sizeof options);
        options.purpose = purpose[k];
        ok(sl_symbolic_create(&S, &A, &options, &stats));
        ok(sl_plan_create(&P, S, corner, 1, corner, 1, NULL, &stats));
        reads[k] = stats.plan.b_entries + stats.plan.x_entries;
        printf("%s: %ld entries of L, %ld read at a corner\n", text[k],
               (long)stats.symbolic.nnz_l, (long)reads[k]);
        sl_plan_free(P);
        sl_symbolic_free(S);
    }
    sl_matrix_free(M);
    return !(reads[0] > 0 && reads[1] > 0);
}

/* errors.c: a call fails and says why, where, and what helps */
#include "example.h"

int main(void) {
    static const sl_int p[] = {0, 2, 4, 5}, i[] = {0, 1, 1, 2, 2};
    static const double x[] = {1, -1, 2, -1, 1}; /* a chain of three rows: singular */
    const sl_csc A = {3, 3, p, i, x};
    sl_symbolic *S = NULL;
    sl_factor *F = NULL;
    sl_options options;
    sl_stats stats;
    sl_status status;
    char text[300];
    ok(sl_symbolic_create(&S, &A, NULL, NULL));
    status = sl_factor_create(&F, S, &A, NULL, &stats);
    sl_error_text(text, sizeof text, status, &stats);
    printf("%s\n", text);
    sl_options_init(&options, sizeof options);
    options.pivots = SL_PIVOTS_SKIP_NULL; /* A is semidefinite */
    ok(sl_factor_create(&F, S, &A, &options, &stats));
    printf("%d null pivot was skipped\n", (int)stats.factor.null);
    sl_factor_free(F);
    sl_symbolic_free(S);
    return status != SL_ERR_PIVOT || stats.factor.null != 1;
}

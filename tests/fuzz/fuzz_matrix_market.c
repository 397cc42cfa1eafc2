/* fuzz_matrix_market.c: parses any bytes as a Matrix Market file; accepted matrices must be valid,
 * small ones are solved */
#include <math.h>
#include <stdint.h>
#include <stdlib.h>

#include "sparse_local.h"

#define PROMISE(condition) ((condition) ? (void)0 : abort())

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

enum { MOST = 64 };

/* A valid header may ask for 2^31 empty columns. No input here needs that much. */
static void *allocate(void *context, size_t bytes) {
    (void)context;
    return bytes > ((size_t)1 << 26) ? NULL : malloc(bytes);
}

static void release(void *context, void *block) {
    (void)context;
    free(block);
}

static void solve(const sl_csc *A) {
    double B[MOST], X[MOST], Y[MOST];
    sl_symbolic *S = NULL;
    sl_factor *F = NULL;
    const sl_int last = A->n_cols - 1;
    const sl_status status = sl_symbolic_create(&S, A, NULL, NULL);
    PROMISE((S != NULL) == (status == SL_OK));
    if (S && A->x && sl_factor_create(&F, S, A, NULL, NULL) == SL_OK) {
        for (sl_int k = 0; k < A->n_cols; k++) {
            B[k] = 1.0 + k;
            Y[k] = k == last ? B[k] : 0.0;
        }
        const sl_status first = sl_factor_solve(F, X, MOST, B, MOST, 1, NULL);
        const sl_status full = sl_factor_solve(F, Y, MOST, Y, MOST, 1, NULL);
        PROMISE(first == SL_OK || first == SL_ERR_NOT_FINITE); /* x overflows */
        PROMISE(full == SL_OK || full == SL_ERR_NOT_FINITE);
        if (last >= 0) {
            const sl_status local =
                sl_local_solve(F, &last, 1, &last, 1, X, 1, B + last, 1, 1, NULL, NULL);
            PROMISE(local == full || (full == SL_ERR_NOT_FINITE && local == SL_OK));
            PROMISE(full != SL_OK || X[0] == Y[last] || (X[0] != X[0] && Y[last] != Y[last]));
        }
    }
    sl_factor_free(F);
    sl_symbolic_free(S);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    sl_matrix *M = NULL;
    sl_stats stats = {0};
    sl_options opt = {0};
    opt.allocator.allocate = allocate;
    opt.allocator.release = release;
    const sl_status status = sl_matrix_parse(&M, (const char *)data, size, &opt, &stats);
    PROMISE((M != NULL) == (status == SL_OK));
    if (status == SL_ERR_IO) {
        PROMISE(stats.error.line >= 0 && (size_t)stats.error.line <= size + 1);
    }
    if (M) {
        const sl_csc A = sl_matrix_view(M);
        PROMISE(sl_csc_check(&A, NULL) == SL_OK);
        if (A.n_rows == A.n_cols && A.n_cols <= MOST) {
            solve(&A);
        }
    }
    sl_matrix_free(M);
    return 0;
}

/* edit_check.c: compares a factor that followed edits with a new one */
#include "edit_check.h"

#include <math.h>
#include <stdlib.h>

#include "app.h"

edit_check edit_check_factor(const sl_csc *A, const sl_factor *F, sl_work *W, uint64_t *random) {
    const size_t n = (size_t)A->n_cols;
    edit_check check = {0, 0, 0, 0};
    sl_symbolic *S = NULL;
    sl_factor *fresh = NULL;
    double *b = app_alloc(3 * n, sizeof *b), *x = b + n, *y = x + n, largest = 0;
    double began = app_processor_ms();
    app_must(sl_symbolic_create(&S, A, NULL, NULL), "analysis", NULL);
    app_must(sl_factor_create(&fresh, S, A, NULL, NULL), "factorization", NULL);
    check.anew_ms = app_processor_ms() - began;
    began = app_processor_ms();
    app_must(sl_factor_refactor(fresh, A, NULL), "refactorization", NULL);
    check.refactor_ms = app_processor_ms() - began;
    for (size_t k = 0; k < n; k++) {
        b[k] = (double)(app_random(random) >> 11) * 0x1p-52 - 1;
    }
    app_must(sl_factor_solve(F, x, n, b, n, 1, W), "solve", NULL);
    app_must(sl_factor_solve(fresh, y, n, b, n, 1, W), "solve", NULL);
    for (size_t k = 0; k < n; k++) {
        largest = fmax(largest, fabs(y[k]));
        /* written so that a NaN counts */
        check.difference =
            fabs(x[k] - y[k]) <= check.difference ? check.difference : fabs(x[k] - y[k]);
    }
    check.difference /= largest > 0 ? largest : 1;
    app_must(sl_csc_residual(A, y, n, &check.backward_error, x, n, b, n, 1), "residual", NULL);
    sl_factor_free(fresh);
    sl_symbolic_free(S);
    free(b);
    return check;
}

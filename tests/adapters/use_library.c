/* use_library.c: solves on a library that is loaded by its path; for glibc, musl and Windows
 *
 *     use_library LIBRARY SAVED
 *
 * The matrix is that of a chain of springs. A factor is saved to the file SAVED, and loaded and
 * mapped from it. Ends with 0 if the residual is small and all solutions have the same bits.
 */
#define SL_WITH_ALL
#include "sparse_local.h"
#include <math.h>
#include <stdio.h>
#include <string.h>
#if defined(_WIN32)
#include <windows.h>
#else
#include <dlfcn.h>
#endif

enum { N = 3000, NNZ = 2 * N - 1 };

static void *address(const char *library, const char *name) {
    void *found = NULL;
#if defined(_WIN32)
    const HMODULE module = LoadLibraryA(library);
    const FARPROC call = module ? GetProcAddress(module, name) : NULL;
    memcpy(&found, &call, sizeof found);
    if (!found) printf("%s: error %lu\n", name, GetLastError());
#else
    void *module = dlopen(library, RTLD_NOW | RTLD_LOCAL);
    if (module) found = dlsym(module, name);
    if (!found) printf("%s\n", dlerror());
#endif
    return found;
}

/* a pointer NAME_ to the call NAME */
#define CALL(name)                                 \
    __typeof__(name) *name##_;                     \
    *(void **)&name##_ = address(library, #name);  \
    if (!name##_) return 1

static sl_int Ap[N + 1], Ai[NNZ];
static double Ax[NNZ], b[N], x[N], y[N];

/* The lower triangle of the matrix: 2.1 on the diagonal, -1 below it. */
static sl_csc chain(void) {
    const sl_csc A = {N, N, Ap, Ai, Ax};
    for (sl_int j = 0, p = 0; j < N; j++) {
        Ai[p] = j, Ax[p++] = 2.1;
        if (j + 1 < N) Ai[p] = j + 1, Ax[p++] = -1;
        Ap[j + 1] = p;
    }
    return A;
}

static double residual(void) {
    double most = 0;
    for (int k = 0; k < N; k++) {
        const double below = k > 0 ? x[k - 1] : 0, above = k + 1 < N ? x[k + 1] : 0;
        const double r = fabs(b[k] - 2.1 * x[k] + below + above);
        most = r > most ? r : most;
    }
    return most;
}

int main(int argc, char **argv) {
    if (argc != 3) return puts("use_library LIBRARY SAVED"), 1;
    const char *library = argv[1], *saved = argv[2];
    CALL(sl_symbolic_create);
    CALL(sl_factor_create);
    CALL(sl_factor_solve);
    CALL(sl_factor_logdet);
    CALL(sl_save);
    CALL(sl_load);
    CALL(sl_saved_set_free);
    CALL(sl_factor_free);
    CALL(sl_symbolic_free);
    CALL(sl_error_text);
    const sl_csc A = chain();
    for (int k = 0; k < N; k++)
        b[k] = k % 7 - 3;
    sl_symbolic *S = NULL;
    sl_factor *F = NULL;
    sl_saved_set set, loaded;
    sl_stats stats;
    double log_det = 0, sign = 0;
    memset(&set, 0, sizeof set);
    memset(&loaded, 0, sizeof loaded);
    sl_status status = sl_symbolic_create_(&S, &A, NULL, &stats);
    if (!status) status = sl_factor_create_(&F, S, &A, NULL, &stats);
    if (!status) status = sl_factor_solve_(F, x, N, b, N, 1, NULL);
    if (!status) status = sl_factor_logdet_(F, &log_det, &sign);
    set.symbolic = S, set.factor = F;
    if (!status) status = sl_save_(saved, NULL, NULL, &set, NULL);
    for (unsigned flags = 0; flags <= SL_LOAD_MAPPED && !status; flags += SL_LOAD_MAPPED) {
        status = sl_load_(&loaded, saved, NULL, 0, flags, NULL);
        if (!status) status = sl_factor_solve_(loaded.factor, y, N, b, N, 1, NULL);
        if (!status && memcmp(x, y, sizeof x) != 0) return puts("loaded: other bits"), 1;
        sl_saved_set_free_(&loaded);
    }
    char text[300];
    sl_error_text_(text, sizeof text, status, &stats);
    printf("%s; residual %.1e, log det %.6f, sign %g\n", text, residual(), log_det, sign);
    sl_factor_free_(F);
    sl_symbolic_free_(S);
    remove(saved);
    const double root = (2.1 + sqrt(0.41)) / 2, wanted = (N + 1) * log(root) - 0.5 * log(0.41);
    return status || !(residual() < 1e-13) || !(fabs(log_det - wanted) < 1e-9);
}

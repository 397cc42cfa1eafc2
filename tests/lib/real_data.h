/* real_data.h: files of real matrices and meshes, and solves of known accuracy with them */
#ifndef SL_TEST_REAL_DATA_H
#define SL_TEST_REAL_DATA_H

#include "factored.h"
#include "local_solve.h"

#include "tools/io/dataset.h"

/* The files in $SL_DATA/name. Skips the test if there are none. */
static inline dataset data_or_skip(const char *name) {
    dataset d;
    if (!dataset_list(&d, NULL, name)) {
        TEST_SKIP("SL_DATA has no folder %s", name);
    }
    return d;
}

/* The path of the file called name, or NULL. */
static inline const char *data_find(const dataset *d, const char *name) {
    for (size_t k = 0; k < d->count; k++) {
        if (strcmp(dataset_basename(d->paths[k]), name) == 0) {
            return d->paths[k];
        }
    }
    return NULL;
}

/* Backward error of S A S y = S b with x = S y. S is diagonal, with powers of two that bring the
 * diagonal of A near 1. LDL' without pivoting makes the same rounding errors in both systems, but
 * the scaled error gives equal weight to rows of tiny entries, which the norms of A and x hide. */
static inline double scaled_backward(const sl_csc *A, const double *X, const double *B,
                                     sl_int nrhs) {
    size_t n = (size_t)A->n_cols, entries = (size_t)A->p[n];
    double *values = test_reals(entries), *Y = test_reals(n * (size_t)nrhs);
    double *C = test_reals(n * (size_t)nrhs), *diagonal = test_reals(n);
    int *power = (int *)test_array(n, sizeof(int)); /* exponents: S = diag(2^power) */
    for (sl_int j = 0; j < A->n_cols; j++) {
        for (sl_int p = A->p[j]; p < A->p[j + 1]; p++) {
            diagonal[j] += A->i[p] == j ? A->x[p] : 0.0;
        }
        (void)frexp(diagonal[j], &power[j]);
        power[j] = -power[j] / 2;
    }
    for (sl_int j = 0; j < A->n_cols; j++) {
        for (sl_int p = A->p[j]; p < A->p[j + 1]; p++) {
            values[p] = ldexp(A->x[p], power[A->i[p]] + power[j]);
        }
    }
    for (size_t k = 0; k < n * (size_t)nrhs; k++) {
        Y[k] = ldexp(X[k], -power[k % n]);
        C[k] = ldexp(B[k], power[k % n]);
    }
    const sl_csc scaled = {A->n_rows, A->n_cols, A->p, A->i, values};
    double worst = worst_backward(&scaled, Y, n, C, n, nrhs);
    free(values);
    free(Y);
    free(C);
    free(diagonal);
    free(power);
    return worst;
}

/* Bound on the plain and the scaled backward error of a stable factorization: c n eps with c n =
 * 20. After scaling, the rows of L D^(1/2) have norm at most 1.5 and most rounding errors cancel;
 * the largest error seen is 5 eps for n from 5 to 163842. */
#define DATA_STABLE (20.0 * DBL_EPSILON)

/* Solves nrhs random right-hand sides. Fails if the plain or the scaled backward error exceeds
 * allowed; returns the larger one. */
static inline double data_solve(const sl_factor *F, const sl_csc *A, sl_int nrhs, double allowed,
                                sl_work *W) {
    size_t n = (size_t)A->n_cols;
    double *B = test_reals(n * (size_t)nrhs), *X = test_reals(n * (size_t)nrhs);
    gen_reals(B, n * (size_t)nrhs, 11 + (uint64_t)nrhs);
    SL_CHECK(sl_factor_solve(F, X, n, B, n, nrhs, W));
    double plain = worst_backward(A, X, n, B, n, nrhs), scaled = scaled_backward(A, X, B, nrhs);
    if (!(plain <= allowed && scaled <= allowed)) {
        print_error("backward error %.3g, scaled %.3g, allowed %.3g\n", plain, scaled, allowed);
        fail();
    }
    free(B);
    free(X);
    return plain > scaled ? plain : scaled;
}

#endif

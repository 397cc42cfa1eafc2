/* data.h: what the programs over real matrices and meshes share: their files, and how well a factor must solve */
#ifndef SL_TEST_DATA_H
#define SL_TEST_DATA_H

#include "problem.h"
#include "question.h"

#include "../tools/dataset.h"

/* The files of $SL_DATA/name, or the test is skipped. */
static inline dataset data_or_skip(const char *name) {
    dataset d;
    if (!dataset_list(&d, NULL, name)) {
        print_message("SL_DATA names no folder with %s: nothing is factored here\n", name);
        skip();
    }
    return d;
}

/* The path of one of them, or NULL. */
static inline const char *data_find(const dataset *d, const char *name) {
    for (size_t k = 0; k < d->count; k++) {
        if (strcmp(dataset_basename(d->paths[k]), name) == 0) {
            return d->paths[k];
        }
    }
    return NULL;
}

/* The backward error of S A S y = S b with x = S y. LDL' without pivoting rounds alike in both systems, and here S is
 * diagonal with powers of two that bring the diagonal near 1: so rows of tiny entries, lost in the norms of A and x,
 * count as much as the others. */
static inline double scaled_backward(const sl_csc *A, const double *X, const double *B,
                                     sl_int nrhs) {
    size_t n = (size_t)A->n_cols, entries = (size_t)A->p[n];
    double *values = test_reals(entries), *Y = test_reals(n * (size_t)nrhs);
    double *C = test_reals(n * (size_t)nrhs), *diagonal = test_reals(n);
    int *half = (int *)test_array(n, sizeof(int)); /* exponents: S = diag(2^half) */
    for (sl_int j = 0; j < A->n_cols; j++) {
        for (sl_int p = A->p[j]; p < A->p[j + 1]; p++) {
            diagonal[j] += A->i[p] == j ? A->x[p] : 0.0;
        }
        (void)frexp(diagonal[j], &half[j]);
        half[j] = -half[j] / 2;
    }
    for (sl_int j = 0; j < A->n_cols; j++) {
        for (sl_int p = A->p[j]; p < A->p[j + 1]; p++) {
            values[p] = ldexp(A->x[p], half[A->i[p]] + half[j]);
        }
    }
    for (size_t k = 0; k < n * (size_t)nrhs; k++) {
        Y[k] = ldexp(X[k], -half[k % n]);
        C[k] = ldexp(B[k], half[k % n]);
    }
    const sl_csc scaled = {A->n_rows, A->n_cols, A->p, A->i, values};
    double worst = worst_backward(&scaled, Y, n, C, n, nrhs);
    free(values);
    free(Y);
    free(C);
    free(diagonal);
    free(half);
    return worst;
}

/* What a definite matrix may leave, plain and scaled: c n eps with c n = 20. Scaled, the rows of L D^(1/2) are no
 * longer than 1.5, rounding errors mostly cancel, and the worst seen is 5 eps, for n from 5 to 163842. */
#define DATA_STEADY (20.0 * DBL_EPSILON)

/* Solves with nrhs random right-hand sides; both backward errors are at most allowed, the larger is returned. */
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

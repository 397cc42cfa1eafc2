/* checks.c: checks of results before timing: residuals, and equality with the full solve */
#include <math.h>
#include <stdlib.h>

#include "bench.h"

/* The largest number of entries of a row of the symmetric matrix that A stores a triangle of. */
static sl_int longest_row(const sl_csc *A) {
    sl_int *count = bench_alloc((size_t)A->n_cols, sizeof *count), longest = 0;
    for (sl_int j = 0; j < A->n_cols; j++) {
        count[j] = 0;
    }
    for (sl_int j = 0; j < A->n_cols; j++) {
        for (sl_int p = A->p[j]; p < A->p[j + 1]; p++) {
            count[A->i[p]]++;
            count[j] += A->i[p] != j;
        }
    }
    for (sl_int j = 0; j < A->n_cols; j++) {
        longest = count[j] > longest ? count[j] : longest;
    }
    free(count);
    return longest;
}

int bench_check_residual(bench_run *run, const bench_system *system, const double *X,
                         const double *B, sl_int nrhs, const char *method) {
    size_t n = (size_t)system->n;
    double *R = bench_alloc(n * (size_t)nrhs, sizeof *R);
    double *error = bench_alloc((size_t)nrhs, sizeof *error);
    /* rounding errors accumulate along the paths of the elimination tree and in sums over a row;
     * indefinite factors multiply them by what L D L' has grown to */
    const double length = 10.0 + system->stats.symbolic.tree_height + longest_row(&system->A);
    const double bound = 2.3e-16 * length * fmax(1.0, system->stats.factor.growth);
    int passed = 1;
    bench_must(sl_csc_residual(&system->A, R, n, error, X, n, B, n, nrhs), "residual");
    for (sl_int r = 0; r < nrhs; r++) {
        passed &= bench_expect(run, error[r] <= bound, "%s, %s: backward error %.2g above %.2g",
                               system->name, method, error[r], bound);
    }
    free(error);
    free(R);
    return passed;
}

void bench_note_residual(bench_report *report, const bench_system *system, const double *X,
                         const double *B, sl_int nrhs, const char *method) {
    const size_t n = (size_t)system->n, count = n * (size_t)nrhs;
    double *R = bench_alloc(count, sizeof *R);
    double *error = bench_alloc((size_t)nrhs, sizeof *error), worst = 0, r = 0, b = 0;
    bench_must(sl_csc_residual(&system->A, R, n, error, X, n, B, n, nrhs), "residual");
    for (sl_int c = 0; c < nrhs; c++) {
        worst = fmax(worst, error[c]);
    }
    for (size_t k = 0; k < count; k++) {
        r = fmax(r, fabs(R[k]));
        b = fmax(b, fabs(B[k]));
    }
    bench_report_note(report,
                      "%-14s   %s: max |r| %.2e, max |b| %.2e; backward "
                      "error %.1e",
                      "", method, r, b, worst);
    free(error);
    free(R);
}

int bench_check_bits(bench_run *run, const bench_system *system, const double *X,
                     const sl_int *xset, sl_int nx, const double *full, sl_int nrhs,
                     const char *method) {
    sl_int differ = 0;
    for (sl_int r = 0; r < nrhs; r++) {
        for (sl_int k = 0; k < nx; k++) {
            double local = X[(size_t)r * (size_t)nx + (size_t)k];
            double expected = full[(size_t)r * (size_t)system->n + (size_t)xset[k]];
            differ += !(local == expected); /* true for NaN too */
        }
    }
    return bench_expect(run, differ == 0, "%s, %s: %d of %d values differ from the full solve",
                        system->name, method, (int)differ, (int)(nx * nrhs));
}

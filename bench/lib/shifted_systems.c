/* shifted_systems.c: M + t L of a system for eight values of t, and ways to factor all of them */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "shifted_systems.h"

const double *const *shifted_systems_values(const shifted_systems *f) {
    return (const double *const *)f->values;
}

/* Splits A into the diagonal matrix M of its row sums and the rest, L on the pattern of A. */
static void split(shifted_systems *f) {
    const sl_csc A = f->system->A;
    const size_t n = (size_t)A.n_cols, nnz = (size_t)A.p[n];
    sl_int *p = bench_alloc(n + 1, sizeof *p), *i = bench_alloc(n, sizeof *i);
    double *mass = bench_alloc(n, sizeof *mass), *l = bench_alloc(nnz, sizeof *l);
    const sl_csc M = {A.n_rows, A.n_cols, p, i, mass}, L = {A.n_rows, A.n_cols, A.p, A.i, l};
    memset(mass, 0, n * sizeof *mass);
    for (sl_int j = 0; j < A.n_cols; j++) {
        p[j] = i[j] = j;
        for (sl_int at = A.p[j]; at < A.p[j + 1]; at++) {
            mass[j] += A.x[at];
            mass[A.i[at]] += A.i[at] != j ? A.x[at] : 0.0;
        }
    }
    p[n] = A.n_cols;
    for (sl_int j = 0; j < A.n_cols; j++) {
        for (sl_int at = A.p[j]; at < A.p[j + 1]; at++) {
            l[at] = A.x[at] - (A.i[at] == j ? mass[j] : 0.0);
        }
    }
    f->M = M;
    f->L = L;
}

void shifted_systems_make(shifted_systems *f, const bench_system *system) {
    const sl_symbolic *S = system->S;
    memset(f, 0, sizeof *f);
    f->system = system;
    split(f);
    const size_t nnz = (size_t)system->A.p[system->n];
    const sl_csc terms[SHIFTED_TERMS] = {f->M, f->L};
    for (int t = 0; t < SHIFTED_TERMS; t++) {
        f->values[t] = bench_alloc((size_t)system->stats.symbolic.nnz_a, sizeof(double));
        bench_must(sl_symbolic_scatter(S, f->values[t], &terms[t], NULL), "scatter");
    }
    f->sum = bench_alloc(nnz, sizeof *f->sum);
    for (int k = 0; k < SHIFTED_COUNT; k++) {
        f->c[SHIFTED_TERMS * k] = 1;
        f->c[SHIFTED_TERMS * k + 1] = ldexp(1, k - 4);
        f->sums[k] = bench_alloc(nnz, sizeof(double));
        memcpy(f->sums[k], shifted_systems_sum(f, k), nnz * sizeof(double));
    }
    bench_must(sl_factor_create_sums(f->F, SHIFTED_COUNT, S, f->c, shifted_systems_values(f),
                                     SHIFTED_TERMS, NULL, NULL, NULL),
               "factor a batch");
}

void shifted_systems_free(shifted_systems *f) {
    for (int k = 0; k < SHIFTED_COUNT; k++) {
        sl_factor_free(f->F[k]);
        free(f->sums[k]);
    }
    for (int t = 0; t < SHIFTED_TERMS; t++) {
        free(f->values[t]);
    }
    free(f->sum);
    free((void *)(uintptr_t)f->M.p);
    free((void *)(uintptr_t)f->M.i);
    free((void *)(uintptr_t)f->M.x);
    free((void *)(uintptr_t)f->L.x);
}

const double *shifted_systems_sum(shifted_systems *f, int k) {
    const sl_csc A = f->system->A;
    const double t = f->c[SHIFTED_TERMS * k + 1], *m = f->M.x, *l = f->L.x;
    for (sl_int j = 0; j < A.n_cols; j++) {
        for (sl_int p = A.p[j]; p < A.p[j + 1]; p++) {
            f->sum[p] = (A.i[p] == j ? m[j] : 0.0) + t * l[p];
        }
    }
    return f->sum;
}

void shifted_call_presummed(void *state) {
    shifted_systems *f = state;
    sl_csc A = f->system->A;
    for (int k = 0; k < SHIFTED_COUNT; k++) {
        A.x = f->sums[k];
        bench_must(sl_factor_refactor(f->F[k], &A, NULL), "refactor");
    }
}

void shifted_call_summed_by_hand(void *state) {
    shifted_systems *f = state;
    sl_csc A = f->system->A;
    for (int k = 0; k < SHIFTED_COUNT; k++) {
        A.x = shifted_systems_sum(f, k);
        bench_must(sl_factor_refactor(f->F[k], &A, NULL), "refactor");
    }
}

void shifted_call_one_by_one(void *state) {
    shifted_systems *f = state;
    for (int k = 0; k < SHIFTED_COUNT; k++) {
        bench_must(sl_factor_refactor_sums(&f->F[k], 1, f->c + SHIFTED_TERMS * k,
                                           shifted_systems_values(f), SHIFTED_TERMS, NULL, NULL,
                                           NULL),
                   "refactor a combination");
    }
}

void shifted_call_batch(void *state) {
    shifted_systems *f = state;
    sl_options options = {.threads = f->threads};
    bench_must(sl_factor_refactor_sums(f->F, SHIFTED_COUNT, f->c, shifted_systems_values(f),
                                       SHIFTED_TERMS, &options, NULL, NULL),
               "refactor a batch");
}

int shifted_systems_check(bench_run *run, shifted_systems *f) {
    const size_t panels = (size_t)f->system->stats.symbolic.nnz_panels;
    sl_factor *plain;
    int passed = 1;
    sl_csc A = f->system->A;
    bench_must(sl_factor_create(&plain, f->system->S, &A, NULL, NULL), "factor");
    f->threads = bench_threads(2);
    shifted_call_batch(f);
    for (int k = 0; k < SHIFTED_COUNT; k++) {
        A.x = f->sums[k];
        bench_must(sl_factor_refactor(plain, &A, NULL), "refactor");
        const double *L = sl_factor_view(plain).L;
        passed &= bench_expect(run, memcmp(L, sl_factor_view(f->F[k]).L, panels * sizeof *L) == 0,
                               "%s: the factor of t[%d] differs from that of the presummed matrix",
                               f->system->name, k);
    }
    sl_factor_free(plain);
    return passed;
}

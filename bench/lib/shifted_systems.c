/* family.c: M + t L of a system for eight values of t, summed beforehand, by hand, or by the library */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "family.h"

const double *const *family_values(const family *f) {
    return (const double *const *)f->values;
}

const sl_factor *const *family_factors(const family *f) {
    return (const sl_factor *const *)f->F;
}

/* Masses as a diagonal matrix, and L on A's pattern. */
static void split(family *f) {
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

void family_make(family *f, const bench_system *system) {
    const sl_symbolic *S = system->S;
    memset(f, 0, sizeof *f);
    f->system = system;
    split(f);
    const size_t nnz = (size_t)system->A.p[system->n];
    const sl_csc terms[FAMILY_TERMS] = {f->M, f->L};
    for (int t = 0; t < FAMILY_TERMS; t++) {
        f->values[t] = bench_alloc((size_t)sl_symbolic_entries(S), sizeof(double));
        bench_must(sl_symbolic_spread(S, f->values[t], &terms[t], NULL), "spread");
    }
    f->by_hand = bench_alloc(nnz, sizeof *f->by_hand);
    for (int k = 0; k < FAMILY_TIMES; k++) {
        f->c[FAMILY_TERMS * k] = 1;
        f->c[FAMILY_TERMS * k + 1] = ldexp(1, k - 4);
        f->sums[k] = bench_alloc(nnz, sizeof(double));
        memcpy(f->sums[k], family_sum(f, k), nnz * sizeof(double));
    }
    bench_must(sl_batch_factor(f->F, FAMILY_TIMES, S, f->c, family_values(f), FAMILY_TERMS, NULL,
                               NULL, NULL),
               "factor a batch");
}

void family_free(family *f) {
    for (int k = 0; k < FAMILY_TIMES; k++) {
        sl_factor_free(f->F[k]);
        free(f->sums[k]);
    }
    for (int t = 0; t < FAMILY_TERMS; t++) {
        free(f->values[t]);
    }
    free(f->by_hand);
    free((void *)(uintptr_t)f->M.p);
    free((void *)(uintptr_t)f->M.i);
    free((void *)(uintptr_t)f->M.x);
    free((void *)(uintptr_t)f->L.x);
}

const double *family_sum(family *f, int k) {
    const sl_csc A = f->system->A;
    const double t = f->c[FAMILY_TERMS * k + 1], *m = f->M.x, *l = f->L.x;
    for (sl_int j = 0; j < A.n_cols; j++) {
        for (sl_int p = A.p[j]; p < A.p[j + 1]; p++) {
            f->by_hand[p] = (A.i[p] == j ? m[j] : 0.0) + t * l[p];
        }
    }
    return f->by_hand;
}

void family_call_summed_before(void *state) {
    family *f = state;
    sl_csc A = f->system->A;
    for (int k = 0; k < FAMILY_TIMES; k++) {
        A.x = f->sums[k];
        bench_must(sl_factor_refactor(f->F[k], &A, NULL), "refactor");
    }
}

void family_call_summed_by_hand(void *state) {
    family *f = state;
    sl_csc A = f->system->A;
    for (int k = 0; k < FAMILY_TIMES; k++) {
        A.x = family_sum(f, k);
        bench_must(sl_factor_refactor(f->F[k], &A, NULL), "refactor");
    }
}

void family_call_one_by_one(void *state) {
    family *f = state;
    for (int k = 0; k < FAMILY_TIMES; k++) {
        bench_must(sl_factor_refactor_combination(f->F[k], f->c + FAMILY_TERMS * k,
                                                  family_values(f), FAMILY_TERMS, NULL),
                   "refactor a combination");
    }
}

void family_call_batch(void *state) {
    family *f = state;
    bench_must(sl_batch_refactor(f->F, FAMILY_TIMES, f->c, family_values(f), FAMILY_TERMS,
                                 &f->threads, NULL, NULL),
               "refactor a batch");
}

int family_check(bench_run *run, family *f) {
    const size_t panels = (size_t)f->system->stats.nnz_panels;
    sl_factor *plain;
    int good = 1;
    sl_csc A = f->system->A;
    bench_must(sl_factor_create(&plain, f->system->S, &A, NULL, NULL), "factor");
    f->threads = bench_threads(2);
    family_call_batch(f);
    for (int k = 0; k < FAMILY_TIMES; k++) {
        A.x = f->sums[k];
        bench_must(sl_factor_refactor(plain, &A, NULL), "refactor");
        const double *L = sl_factor_view(plain).L;
        good &= bench_expect(run, memcmp(L, sl_factor_view(f->F[k]).L, panels * sizeof *L) == 0,
                             "%s: the factor of t[%d] is not that of the matrix summed before",
                             f->system->name, k);
    }
    sl_factor_free(plain);
    return good;
}

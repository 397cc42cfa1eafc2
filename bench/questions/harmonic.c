/* harmonic.c: how much more do biharmonic and triharmonic systems cost than harmonic ones? */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "bench/lib/bench.h"

/* M + t (L M^-1)^(k-1) L for k = 1, 2, 3: the systems of diffusion, smoothing and deformation
 * with one, two and three Laplacians, and patterns that grow denser with k. Three right-hand
 * sides at once, as for coordinates. The condition number grows with the k-th power, so the
 * largest residual entry is printed beside the times. */
enum { NRHS = 3, ORDERS = 3 };

typedef struct job {
    const bench_system *system;
    sl_options given;
    sl_symbolic *S;
    sl_factor *F;
    double *B, *X; /* n x NRHS */
    sl_work *W;
} job;

static void ready_analyze(void *state) {
    job *j = state;
    sl_symbolic_free(j->S);
    j->S = NULL;
}

static void call_analyze(void *state) {
    job *j = state;
    bench_must(sl_symbolic_create(&j->S, &j->system->A, &j->given, NULL), "analysis");
}

static void ready_first(void *state) {
    job *j = state;
    sl_factor_free(j->F);
    j->F = NULL;
}

static void call_first(void *state) {
    job *j = state;
    bench_must(sl_factor_create(&j->F, j->system->S, &j->system->A, NULL, NULL), "factor");
}

static void call_refactor(void *state) {
    job *j = state;
    bench_must(sl_factor_refactor(j->system->F, &j->system->A, NULL), "refactor");
}

static void call_solve(void *state) {
    job *j = state;
    const size_t n = (size_t)j->system->n;
    bench_must(sl_factor_solve(j->system->F, j->X, n, j->B, n, NRHS, j->W), "full solve");
}

/* Sets B = A X, where X is 1 in the first column and random in the others. */
static void fill_b(job *j) {
    const size_t n = (size_t)j->system->n;
    uint64_t rng = 17;
    bench_random_fill(&rng, j->X, n * NRHS);
    for (size_t i = 0; i < n; i++) {
        j->X[i] = 1;
    }
    bench_must(sl_csc_multiply(&j->system->A, SL_AS_SYMMETRIC, j->B, n, j->X, n, NRHS), "product");
}

static void one_system(bench_run *run, bench_report *report, const bench_system *system) {
    static const char *const methods[4] = {"order given", "first, memory included", "refactor",
                                           "full solve"};
    static const char *const cases[4] = {"analyze", "factor", "factor", "solve"};
    const size_t n = (size_t)system->n;
    job j = {system, {0}, NULL, NULL, NULL, NULL, NULL};
    bench_contender contenders[4] = {{call_analyze, &j, 1, ready_analyze},
                                     {call_first, &j, 1, ready_first},
                                     {call_refactor, &j, 1, NULL},
                                     {call_solve, &j, 1, NULL}};
    bench_sample samples[4];
    j.given.ordering = SL_ORDERING_GIVEN;
    j.given.perm = sl_symbolic_view(system->S).perm;
    bench_must(sl_work_create(&j.W, NULL), "workspace");
    j.B = bench_alloc(n * NRHS, sizeof *j.B);
    j.X = bench_alloc(n * NRHS, sizeof *j.X);
    fill_b(&j);
    call_refactor(&j);
    call_solve(&j);
    if (bench_check_residual(run, system, j.X, j.B, NRHS, "full solve")) {
        bench_race(samples, contenders, 3, run->seconds / 2);
        bench_race(samples + 3, contenders + 3, 1, run->seconds / 4);
        for (int c = 0; c < 4; c++) {
            bench_row row = {.what = cases[c],
                             .method = methods[c],
                             .time = samples[c],
                             .baseline = samples[2].median};
            row.flops = c == 1 || c == 2 ? system->stats.symbolic.flops : 0;
            row.nrhs = c == 3 ? NRHS : 0;
            if (c == 3) {
                bench_row_full(&row, system);
            }
            bench_report_row(report, system, &row);
        }
        call_solve(&j);
        bench_note_residual(report, system, j.X, j.B, NRHS, "full solve");
    }
    free(j.X);
    free(j.B);
    sl_work_free(j.W);
    sl_factor_free(j.F);
    sl_symbolic_free(j.S);
}

void bench_harmonic(bench_run *run) {
    static const double wanted[] = {1e4, 1e5, 4e5};
    const int count = run->mesh_path               ? 1
                      : run->size == BENCH_QUICK   ? 1
                      : run->size == BENCH_DEFAULT ? 2
                                                   : 3;
    bench_report *report = bench_report_open(
        run, "harmonic", "M + t (L M^-1)^(k-1) L, k = 1, 2, 3, on one mesh", "refactor");
    for (int c = 0; c < count; c++) {
        for (int k = 1; k <= ORDERS; k++) {
            const bench_system *system = bench_k_harmonic(run, wanted[c], k);
            if (system) {
                one_system(run, report, system);
            }
        }
    }
    bench_report_close(report);
}

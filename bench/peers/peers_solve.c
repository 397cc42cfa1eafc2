/* peers_solve.c: full solves with 1 to 64 right-hand sides against CHOLMOD and Eigen */
#include <string.h>

#include "peers_steps.h"

enum { CHECKED = 2, CHECKED_PEERS = 8, THREADED_FROM = 8, FEW_RHS = 8, MAX_SOLVE_ROWS = 8 };

static void ours_call(void *state) {
    comparison *cmp = state;
    size_t n = (size_t)cmp->system->n;
    bench_must(sl_factor_solve(cmp->system->F, cmp->X, n, cmp->B, n, cmp->nrhs, cmp->W),
               "full solve");
}

static void avx2_call(void *state) {
    comparison *cmp = state;
    size_t n = (size_t)cmp->system->n;
    bench_must(sl_factor_solve(cmp->avx2.F, cmp->X, n, cmp->B, n, cmp->nrhs, cmp->W), "full solve");
}

static void cholmod_call(void *state) {
    comparison *cmp = state;
    cmp->answer = peer_cholmod_solve(cmp->cholmod, cmp->B, cmp->nrhs);
}

static void cholmod_simplicial_call(void *state) {
    comparison *cmp = state;
    cmp->answer = peer_cholmod_solve_simplicial(cmp->cholmod, cmp->B, cmp->nrhs);
}

static void eigen_call(void *state) {
    comparison *cmp = state;
    peer_eigen_solve(cmp->eigen, cmp->X, cmp->B, cmp->nrhs);
}

static void cholmod_defaults_call(void *state) {
    comparison *cmp = state;
    cmp->answer = peer_cholmod_own_solve(cmp->cholmod_defaults, cmp->B, cmp->nrhs);
}

static void eigen_defaults_call(void *state) {
    comparison *cmp = state;
    peer_eigen_amd_solve(cmp->eigen_defaults, cmp->X, cmp->B, cmp->nrhs);
}

/* Checks the last few columns of every solver's result. */
static int check_answers(bench_run *run, comparison *cmp) {
    const sl_int few = cmp->nrhs < CHECKED ? cmp->nrhs : CHECKED;
    const size_t skipped = (size_t)(cmp->nrhs - few) * (size_t)cmp->system->n;
    const double *B = cmp->B + skipped;
    ours_call(cmp);
    int passed = bench_check_residual(run, cmp->system, cmp->X + skipped, B, few, "full solve");
    if (cmp->avx2.F) {
        avx2_call(cmp);
        passed &=
            bench_check_residual(run, cmp->system, cmp->X + skipped, B, few, "full solve, AVX2");
    }
    if (cmp->nrhs <= CHECKED_PEERS) {
        cholmod_call(cmp);
        bench_check_residual(run, cmp->system, cmp->answer + skipped, B, few, "CHOLMOD supernodal");
        cholmod_simplicial_call(cmp);
        bench_check_residual(run, cmp->system, cmp->answer + skipped, B, few, "CHOLMOD simplicial");
        cholmod_defaults_call(cmp);
        bench_check_residual(run, cmp->system, cmp->answer + skipped, B, few, "CHOLMOD defaults");
        if (cmp->eigen_defaults) {
            eigen_defaults_call(cmp);
            bench_check_residual(run, cmp->system, cmp->X + skipped, B, few, "Eigen defaults");
        }
    }
    return passed;
}

/* Times CHOLMOD's supernodal solve with OpenBLAS on threads. */
static void threaded_row(bench_run *run, bench_report *report, comparison *cmp, timed_row one,
                         double baseline) {
    one.threads = PEERS_THREADS;
    one.sample.count = 0;
    peer_cholmod_threads(PEERS_THREADS);
    peers_race(run->seconds / 4, report, cmp, "full solve", cmp->nrhs, &one, 1, NULL, baseline);
    peer_cholmod_threads(1);
    peers_wait_idle(NULL);
}

/* The peers over our permutation. Returns the new count. */
static int add_peers(const comparison *cmp, timed_row *rows, int count) {
    const double entries = 2 * peer_cholmod_nnz(cmp->cholmod);
    rows[count++] =
        (timed_row){.method = "CHOLMOD supernodal", .call = cholmod_call, .entries = entries};
    if (cmp->nrhs <= FEW_RHS || !cmp->is_brief) {
        rows[count++] = (timed_row){
            .method = "CHOLMOD simplicial", .call = cholmod_simplicial_call, .entries = entries};
    }
    if (cmp->eigen && cmp->nrhs <= (cmp->is_brief ? 1 : FEW_RHS)) {
        rows[count++] = (timed_row){/* one right-hand side after the other */
                                    .method = "Eigen simplicial",
                                    .call = eigen_call,
                                    .passes = cmp->nrhs,
                                    .entries = entries * cmp->nrhs};
    }
    return count;
}

/* The peers over their own orderings, for the numbers of right-hand sides of the README's table. */
static int add_defaults(const comparison *cmp, timed_row *rows, int count) {
    if (cmp->nrhs == 1 || cmp->nrhs == FEW_RHS) {
        rows[count++] = (timed_row){.method = "CHOLMOD defaults",
                                    .call = cholmod_defaults_call,
                                    .entries = 2 * peer_cholmod_own_nnz(cmp->cholmod_defaults)};
    }
    if (cmp->nrhs == 1 && cmp->eigen_defaults) {
        rows[count++] = (timed_row){.method = "Eigen defaults",
                                    .call = eigen_defaults_call,
                                    .entries = 2 * peer_eigen_amd_nnz(cmp->eigen_defaults)};
    }
    return count;
}

/* Keeps CHOLMOD's fastest full solve for the step of local solves. */
static void keep_best_full(comparison *cmp, const timed_row *rows, int first, int count) {
    bench_sample *best = &cmp->best_full[cmp->nrhs];
    for (int c = first; c < count; c++) {
        if (strncmp(rows[c].method, "CHOLMOD", 7) == 0 &&
            (best->count == 0 || rows[c].sample.median < best->median)) {
            *best = rows[c].sample;
        }
    }
}

void peers_solve(bench_run *run, bench_report *report, comparison *cmp, sl_int nrhs) {
    const double entries = 2 * (double)cmp->system->stats.symbolic.nnz_panels;
    timed_row rows[MAX_SOLVE_ROWS] = {{.method = "ours", .call = ours_call, .entries = entries}};
    int ours = 1, count;
    uint64_t rng = 99 + (uint64_t)nrhs;
    cmp->nrhs = nrhs;
    bench_random_fill(&rng, cmp->B, (size_t)cmp->system->n * (size_t)nrhs);
    if (!check_answers(run, cmp)) {
        return;
    }
    if (cmp->avx2.F) {
        rows[ours++] = (timed_row){.method = "ours, AVX2 forced",
                                   .call = avx2_call,
                                   .isa = SL_ISA_AVX2,
                                   .entries = entries};
    }
    count = add_defaults(cmp, rows, add_peers(cmp, rows, ours));
    for (int c = 0; c < count; c++) {
        rows[c].state = cmp;
        rows[c].is_peer = c >= ours;
    }
    const double baseline = peers_race(cmp->is_brief ? run->seconds : run->seconds / 2, report, cmp,
                                       "full solve", nrhs, rows, count, NULL, 0);
    if (nrhs <= 2) {
        keep_best_full(cmp, rows, ours, count);
    }
    if (nrhs >= THREADED_FROM) {
        threaded_row(run, report, cmp, rows[ours], baseline);
    }
}

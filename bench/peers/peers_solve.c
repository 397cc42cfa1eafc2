/* peers_solve.c: full solves beside CHOLMOD's and Eigen's, from one right-hand side to many */
#include "peers_steps.h"

enum { CHECKED = 2, CHECKED_PEERS = 8, THREADED_FROM = 8, FEW_RHS = 8 };

static void ours_call(void *state) {
    match *m = state;
    size_t n = (size_t)m->system->n;
    bench_must(sl_factor_solve(m->system->F, m->X, n, m->B, n, m->nrhs, m->W), "full solve");
}

static void narrow_call(void *state) {
    match *m = state;
    size_t n = (size_t)m->system->n;
    bench_must(sl_factor_solve(m->narrow.F, m->X, n, m->B, n, m->nrhs, m->W), "full solve");
}

static void cholmod_call(void *state) {
    match *m = state;
    m->answer = peer_cholmod_solve(m->cholmod, m->B, m->nrhs);
}

static void cholmod_simple_call(void *state) {
    match *m = state;
    m->answer = peer_cholmod_solve_simple(m->cholmod, m->B, m->nrhs);
}

static void eigen_call(void *state) {
    match *m = state;
    peer_eigen_solve(m->eigen, m->X, m->B, m->nrhs);
}

/* The last few columns of what everybody answers. */
static int check_answers(bench_run *run, match *m) {
    const sl_int few = m->nrhs < CHECKED ? m->nrhs : CHECKED;
    const size_t skipped = (size_t)(m->nrhs - few) * (size_t)m->system->n;
    const double *B = m->B + skipped;
    ours_call(m);
    int good = bench_check_residual(run, m->system, m->X + skipped, B, few, "full solve");
    if (m->narrow.F) {
        narrow_call(m);
        good &= bench_check_residual(run, m->system, m->X + skipped, B, few, "full solve, AVX2");
    }
    if (m->nrhs <= CHECKED_PEERS) {
        cholmod_call(m);
        bench_check_residual(run, m->system, m->answer + skipped, B, few, "CHOLMOD supernodal");
        cholmod_simple_call(m);
        bench_check_residual(run, m->system, m->answer + skipped, B, few, "CHOLMOD simplicial");
    }
    return good;
}

/* CHOLMOD's supernodal solve with OpenBLAS on threads. */
static void threaded_row(bench_run *run, bench_report *report, match *m, entry one,
                         double baseline) {
    one.threads = PEERS_THREADS;
    one.sample.count = 0;
    peer_cholmod_threads(PEERS_THREADS);
    peers_race(run->seconds / 4, report, m, "full solve", m->nrhs, &one, 1, NULL, baseline);
    peer_cholmod_threads(1);
    peers_nap(NULL);
}

void peers_solve(bench_run *run, bench_report *report, match *m, sl_int nrhs) {
    const double ours = 2 * (double)m->system->stats.nnz_panels;
    const double theirs = 2 * peer_cholmod_nnz(m->cholmod);
    entry entries[5] = {{.method = "ours", .call = ours_call}};
    int count = 1;
    uint64_t chance = 99 + (uint64_t)nrhs;
    m->nrhs = nrhs;
    bench_random_fill(&chance, m->B, (size_t)m->system->n * (size_t)nrhs);
    if (!check_answers(run, m)) {
        return;
    }
    if (m->narrow.F) {
        entries[count++] =
            (entry){.method = "ours, AVX2 forced", .call = narrow_call, .isa = SL_ISA_AVX2};
    }
    const int foreign = count;
    entries[count++] = (entry){.method = "CHOLMOD supernodal", .call = cholmod_call};
    if (nrhs <= FEW_RHS || !m->is_brief) {
        entries[count++] = (entry){.method = "CHOLMOD simplicial", .call = cholmod_simple_call};
    }
    if (m->eigen && nrhs <= (m->is_brief ? 1 : FEW_RHS)) {
        entries[count++] = (entry){.method = "Eigen simplicial", .call = eigen_call};
        if (nrhs > 1) { /* one after the other */
            entries[count - 1].passes = nrhs;
        }
    }
    for (int c = 0; c < count; c++) {
        entries[c].state = m;
        entries[c].foreign = c >= foreign;
        entries[c].entries = c < foreign ? ours : theirs;
        entries[c].entries *= entries[c].passes > 1 ? entries[c].passes : 1;
    }
    const double baseline = peers_race(m->is_brief ? run->seconds : run->seconds / 2, report, m,
                                       "full solve", nrhs, entries, count, NULL, 0);
    if (nrhs <= 2) {
        const entry *super = &entries[foreign], *simple = &entries[foreign + 1];
        const int is_super = super->sample.median < simple->sample.median;
        m->best_full[nrhs] = is_super ? super->sample : simple->sample;
    }
    if (nrhs >= THREADED_FROM) {
        threaded_row(run, report, m, entries[foreign], baseline);
    }
}

/* peers_steps.c: one system in the hands of this library and of its peers, and races between them */
#define _POSIX_C_SOURCE 200112L
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "peers_steps.h"

enum { MOST_ENTRIES = 8 };

static const double most_flops_eigen = 5e10, large_panels = 5e7;

match *match_create(const bench_run *run, const bench_system *system, sl_int most_rhs) {
    match *m = bench_alloc(1, sizeof *m);
    const sl_int *perm = sl_symbolic_view(system->S).perm;
    const size_t n = (size_t)system->n;
    sl_options options;
    memset(m, 0, sizeof *m);
    memset(&options, 0, sizeof options);
    m->system = system;
    m->is_brief = (double)system->stats.nnz_panels > large_panels && run->size != BENCH_FULL;
    m->given.ordering = SL_ORDERING_GIVEN;
    m->given.perm = perm;
    bench_must(sl_factor_create(&m->F, system->S, &system->A, NULL, NULL), "factor");
    m->narrow = *system;
    m->narrow.F = NULL;
    options.isa = SL_ISA_AVX2;
    if (system->stats.isa == SL_ISA_AVX512) {
        bench_must(
            sl_factor_create(&m->narrow.F, system->S, &system->A, &options, &m->narrow.stats),
            "factor with AVX2");
    }
    options.isa = SL_ISA_AUTO;
    options.threads = bench_threads(PEERS_THREADS);
    bench_must(sl_factor_create(&m->threaded, system->S, &system->A, &options, NULL), "factor");
    bench_must(sl_work_create(&m->W, NULL), "workspace");
    m->B = bench_alloc(n * (size_t)most_rhs, sizeof *m->B);
    m->X = bench_alloc(n * (size_t)most_rhs, sizeof *m->X);
    bench_progress("[%s: CHOLMOD]\n", system->name);
    m->cholmod = peer_cholmod_create(&system->A, perm);
    if (system->stats.flops < most_flops_eigen) {
        bench_progress("[%s: Eigen]\n", system->name);
        bench_must(sl_matrix_permute(&m->permuted, &system->A, perm, NULL), "permuting for Eigen");
        const sl_csc C = sl_matrix_view(m->permuted);
        m->eigen = peer_eigen_create(&C);
        const double start = bench_now();
        peer_eigen_analyse(m->eigen);
        const double middle = bench_now();
        peer_eigen_factor(m->eigen);
        m->eigen_analyse = middle - start;
        m->eigen_first = bench_now() - middle;
    }
    return m;
}

void match_free(match *m) {
    if (m->eigen) {
        peer_eigen_free(m->eigen);
    }
    sl_matrix_free(m->permuted);
    peer_cholmod_free(m->cholmod);
    sl_work_free(m->W);
    sl_factor_free(m->threaded);
    sl_factor_free(m->narrow.F);
    sl_factor_free(m->first);
    sl_factor_free(m->F);
    sl_symbolic_free(m->S);
    free(m->X);
    free(m->B);
    free(m);
}

double peers_race(double seconds, bench_report *report, const match *m, const char *what,
                  sl_int nrhs, entry *entries, int count, const sl_stats *reach, double baseline) {
    bench_contender contenders[MOST_ENTRIES] = {{NULL, NULL, 0, NULL}};
    bench_sample samples[MOST_ENTRIES];
    int racing = 0;
    for (int c = 0; c < count; c++) {
        if (entries[c].sample.count == 0) {
            contenders[racing++] = (bench_contender){entries[c].call, entries[c].state,
                                                     entries[c].batch, entries[c].ready};
        }
    }
    bench_race(samples, contenders, racing, seconds);
    racing = 0;
    for (int c = 0; c < count; c++) {
        if (entries[c].sample.count == 0) {
            entries[c].sample = samples[racing++];
        }
        bench_row row = {.what = what,
                         .method = entries[c].method,
                         .isa = entries[c].isa,
                         .foreign = entries[c].foreign,
                         .threads = entries[c].threads,
                         .nrhs = nrhs,
                         .entries = entries[c].entries,
                         .passes = entries[c].passes,
                         .flops = entries[c].flops,
                         .time = entries[c].sample};
        if (reach) {
            row.reach = *reach;
        }
        baseline = baseline > 0 ? baseline : entries[0].sample.median;
        row.baseline = baseline;
        bench_report_row(report, m->system, &row);
    }
    return baseline;
}

void peers_nap(void *state) {
    const struct timespec nap = {0, 40 * 1000 * 1000};
    (void)state;
    (void)nanosleep(&nap, NULL);
}

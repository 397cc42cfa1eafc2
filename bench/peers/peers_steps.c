/* peers_steps.c: one system factored by all libraries; timing and printing of a step */
#define _POSIX_C_SOURCE 200112L
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "peers_steps.h"

enum { MAX_ROWS = 10 };

static const double max_flops_eigen = 5e10, min_panels_brief = 5e7;

/* P A P' with ascending rows, which Eigen needs: those of triplets are. */
static sl_matrix *permute_sorted(const sl_csc *A, const sl_int *perm) {
    sl_matrix *permuted = NULL, *sorted = NULL;
    bench_must(sl_matrix_submatrix(&permuted, A, perm, A->n_cols, NULL, NULL), "permuting");
    const sl_csc view = sl_matrix_view(permuted);
    const sl_int count = view.p[view.n_cols];
    sl_int *columns = bench_alloc((size_t)count, sizeof *columns);
    for (sl_int j = 0; j < view.n_cols; j++) {
        for (sl_int p = view.p[j]; p < view.p[j + 1]; p++) {
            columns[p] = j;
        }
    }
    bench_must(sl_matrix_from_triplets(&sorted, view.n_cols, view.n_cols, count, view.i, columns,
                                       view.x, NULL, NULL),
               "sorting");
    free(columns);
    sl_matrix_free(permuted);
    return sorted;
}

comparison *comparison_create(const bench_run *run, const bench_system *system, sl_int max_rhs) {
    comparison *cmp = bench_alloc(1, sizeof *cmp);
    const sl_int *perm = sl_symbolic_view(system->S).perm;
    const size_t n = (size_t)system->n;
    sl_options options;
    memset(cmp, 0, sizeof *cmp);
    memset(&options, 0, sizeof options);
    cmp->system = system;
    cmp->is_brief =
        (double)system->stats.symbolic.nnz_panels > min_panels_brief && run->size != BENCH_FULL;
    cmp->given.ordering = SL_ORDERING_GIVEN;
    cmp->given.perm = perm;
    bench_must(sl_factor_create(&cmp->F, system->S, &system->A, NULL, NULL), "factor");
    cmp->avx2 = *system;
    cmp->avx2.F = NULL;
    options.isa = SL_ISA_AVX2;
    if (system->stats.factor.isa == SL_ISA_AVX512) {
        bench_must(
            sl_factor_create(&cmp->avx2.F, system->S, &system->A, &options, &cmp->avx2.stats),
            "factor with AVX2");
    }
    options.isa = SL_ISA_AUTO;
    options.threads = bench_threads(PEERS_THREADS);
    bench_must(sl_factor_create(&cmp->threaded, system->S, &system->A, &options, NULL), "factor");
    bench_must(sl_work_create(&cmp->W, NULL), "workspace");
    cmp->B = bench_alloc(n * (size_t)max_rhs, sizeof *cmp->B);
    cmp->X = bench_alloc(n * (size_t)max_rhs, sizeof *cmp->X);
    bench_progress("[%s: CHOLMOD]\n", system->name);
    cmp->cholmod = peer_cholmod_create(&system->A, perm);
    if (system->stats.symbolic.flops < max_flops_eigen) {
        bench_progress("[%s: Eigen]\n", system->name);
        cmp->permuted = permute_sorted(&system->A, perm);
        const sl_csc C = sl_matrix_view(cmp->permuted);
        cmp->eigen = peer_eigen_create(&C);
        const double start = bench_now();
        peer_eigen_analyze(cmp->eigen);
        const double middle = bench_now();
        peer_eigen_factor(cmp->eigen);
        cmp->eigen_analyze = middle - start;
        cmp->eigen_first = bench_now() - middle;
    }
    return cmp;
}

void comparison_free(comparison *cmp) {
    if (cmp->eigen) {
        peer_eigen_free(cmp->eigen);
    }
    sl_matrix_free(cmp->permuted);
    peer_eigen_amd_free(cmp->eigen_defaults);
    peer_cholmod_own_free(cmp->cholmod_defaults);
    peer_cholmod_own_free(cmp->cholmod_metis);
    peer_cholmod_free(cmp->cholmod);
    sl_work_free(cmp->W);
    sl_factor_free(cmp->threaded);
    sl_factor_free(cmp->avx2.F);
    sl_factor_free(cmp->first);
    sl_factor_free(cmp->F);
    sl_symbolic_free(cmp->S);
    free(cmp->X);
    free(cmp->B);
    free(cmp);
}

void peers_time(double seconds, timed_row *rows, int count) {
    bench_contender contenders[MAX_ROWS] = {{NULL, NULL, 0, NULL}};
    bench_sample samples[MAX_ROWS];
    int racing = 0;
    for (int c = 0; c < count; c++) {
        if (rows[c].sample.count == 0) {
            contenders[racing++] =
                (bench_contender){rows[c].call, rows[c].state, rows[c].batch, rows[c].ready};
        }
    }
    bench_race(samples, contenders, racing, seconds);
    racing = 0;
    for (int c = 0; c < count; c++) {
        if (rows[c].sample.count == 0) {
            rows[c].sample = samples[racing++];
        }
    }
}

double peers_report(bench_report *report, const comparison *cmp, const char *what, sl_int nrhs,
                    const timed_row *rows, int count, const sl_stats *reach, double baseline) {
    for (int c = 0; c < count; c++) {
        bench_row row = {.what = what,
                         .method = rows[c].method,
                         .isa = rows[c].isa,
                         .is_peer = rows[c].is_peer,
                         .threads = rows[c].threads,
                         .nrhs = nrhs,
                         .entries = rows[c].entries,
                         .passes = rows[c].passes,
                         .flops = rows[c].flops,
                         .time = rows[c].sample};
        if (reach) {
            row.reach = *reach;
        }
        baseline = baseline > 0 ? baseline : rows[0].sample.median;
        row.baseline = baseline;
        bench_report_row(report, cmp->system, &row);
    }
    return baseline;
}

double peers_race(double seconds, bench_report *report, const comparison *cmp, const char *what,
                  sl_int nrhs, timed_row *rows, int count, const sl_stats *reach, double baseline) {
    peers_time(seconds, rows, count);
    return peers_report(report, cmp, what, nrhs, rows, count, reach, baseline);
}

bench_sample peers_one_sample(double seconds) {
    const bench_sample sample = {1, seconds, seconds, seconds};
    return sample;
}

bench_sample peers_time_once(void (*call)(void *), void *state) {
    const double start = bench_now();
    call(state);
    return peers_one_sample(bench_now() - start);
}

void peers_wait_idle(void *state) {
    const struct timespec pause = {0, 40 * 1000 * 1000};
    (void)state;
    (void)nanosleep(&pause, NULL);
}

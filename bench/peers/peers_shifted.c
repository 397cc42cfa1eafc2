/* peers_shifted.c: how do eight refactorizations of M + t L compare with CHOLMOD's? */
#include <stdlib.h>
#include <string.h>

#include "bench/lib/shifted_systems.h"
#include "peers_steps.h"

/* CHOLMOD can add a multiple of the identity while it factors, but no other matrix. So M + t L
 * is summed for it beforehand, in one loop over its entries. Times are those of all eight. */
typedef struct shifted_comparison {
    shifted_systems f;
    comparison *cmp;
} shifted_comparison;

static void ours_call(void *state) {
    shifted_call_batch(&((shifted_comparison *)state)->f);
}

static void cholmod_call(void *state) {
    shifted_comparison *c = state;
    for (int k = 0; k < SHIFTED_COUNT; k++) {
        peer_cholmod_values(c->cmp->cholmod, shifted_systems_sum(&c->f, k));
        peer_cholmod_factor(c->cmp->cholmod);
    }
}

/* CHOLMOD's last factor and ours solve the last system. */
static void check_last(bench_run *run, shifted_comparison *c) {
    const size_t n = (size_t)c->cmp->system->n;
    bench_system last = *c->cmp->system;
    uint64_t rng = 45;
    last.A.x = c->f.sums[SHIFTED_COUNT - 1];
    bench_random_fill(&rng, c->cmp->B, n);
    cholmod_call(c);
    memcpy(c->cmp->X, peer_cholmod_solve(c->cmp->cholmod, c->cmp->B, 1), n * sizeof(double));
    bench_check_residual(run, &last, c->cmp->X, c->cmp->B, 1, "CHOLMOD, M + t L");
    bench_must(sl_factor_solve(c->f.F[SHIFTED_COUNT - 1], c->cmp->X, n, c->cmp->B, n, 1, c->cmp->W),
               "full solve");
    bench_check_residual(run, &last, c->cmp->X, c->cmp->B, 1, "ours, M + t L");
}

static void one_system(bench_run *run, bench_report *report, const bench_system *system) {
    shifted_comparison *c = bench_alloc(1, sizeof *c);
    double baseline = 0;
    c->cmp = comparison_create(run, system, 1);
    shifted_systems_make(&c->f, system);
    if (shifted_systems_check(run, &c->f)) {
        check_last(run, c);
        for (sl_int threads = 1; threads <= PEERS_THREADS; threads++) {
            timed_row rows[2] = {{.method = "ours, a batch", .call = ours_call},
                                 {.method = "CHOLMOD, one by one", .call = cholmod_call}};
            for (int k = 0; k < 2; k++) {
                rows[k].state = c;
                rows[k].is_peer = k;
                rows[k].threads = threads;
                rows[k].flops = SHIFTED_COUNT * system->stats.symbolic.flops;
                rows[k].ready = threads > 1 ? peers_wait_idle : NULL;
            }
            c->f.threads = bench_threads(threads);
            peer_cholmod_threads(threads);
            baseline = peers_race(2 * run->seconds, report, c->cmp, "8 refactorized", 0, rows, 2,
                                  NULL, baseline);
        }
        peer_cholmod_threads(1);
    }
    shifted_systems_free(&c->f);
    comparison_free(c->cmp);
    free(c);
}

void bench_peers_shifted(bench_run *run) {
    static const double wanted[] = {1e4, 1e5};
    const bench_system *systems[3];
    int count = bench_systems(run, wanted, 2, systems);
    bench_report *report = bench_report_open(
        run, "peers_shifted", "eight refactorizations of M + t L against CHOLMOD, one analysis",
        "ours on one thread");
    if (!run->mesh_path) {
        systems[count++] = bench_volume(run->size == BENCH_QUICK ? 20 : 30);
    }
    for (int k = 0; k < count; k++) {
        one_system(run, report, systems[k]);
    }
    bench_report_close(report);
}

/* peers_several.c: how do eight refactorizations M + t L compare with CHOLMOD's, over one analysis and one permutation? */
#include <stdlib.h>
#include <string.h>

#include "family.h"
#include "peers_steps.h"

/* CHOLMOD adds a multiple of the identity while it factors, and nothing else: M + t L is summed by hand for it, in one
 * loop over its entries. Times are those of all eight. */
typedef struct contest {
    family f;
    match *m;
} contest;

static void ours_call(void *state) {
    family_call_batch(&((contest *)state)->f);
}

static void cholmod_call(void *state) {
    contest *c = state;
    for (int k = 0; k < FAMILY_TIMES; k++) {
        peer_cholmod_values(c->m->cholmod, family_sum(&c->f, k));
        peer_cholmod_factor(c->m->cholmod);
    }
}

/* CHOLMOD's last factor and ours solve the last system. */
static void check_last(bench_run *run, contest *c) {
    const size_t n = (size_t)c->m->system->n;
    bench_system last = *c->m->system;
    uint64_t chance = 45;
    last.A.x = c->f.sums[FAMILY_TIMES - 1];
    bench_random_fill(&chance, c->m->B, n);
    cholmod_call(c);
    memcpy(c->m->X, peer_cholmod_solve(c->m->cholmod, c->m->B, 1), n * sizeof(double));
    bench_check_residual(run, &last, c->m->X, c->m->B, 1, "CHOLMOD, M + t L");
    bench_must(sl_factor_solve(c->f.F[FAMILY_TIMES - 1], c->m->X, n, c->m->B, n, 1, c->m->W),
               "full solve");
    bench_check_residual(run, &last, c->m->X, c->m->B, 1, "ours, M + t L");
}

static void one_system(bench_run *run, bench_report *report, const bench_system *system) {
    contest *c = bench_alloc(1, sizeof *c);
    double baseline = 0;
    c->m = match_create(run, system, 1);
    family_make(&c->f, system);
    if (family_check(run, &c->f)) {
        check_last(run, c);
        for (sl_int threads = 1; threads <= PEERS_THREADS; threads++) {
            entry entries[2] = {{.method = "ours, a batch", .call = ours_call},
                                {.method = "CHOLMOD, one by one", .call = cholmod_call}};
            for (int k = 0; k < 2; k++) {
                entries[k].state = c;
                entries[k].foreign = k;
                entries[k].threads = threads;
                entries[k].flops = FAMILY_TIMES * system->stats.flops;
                entries[k].ready = threads > 1 ? peers_nap : NULL;
            }
            c->f.threads = bench_threads(threads);
            peer_cholmod_threads(threads);
            baseline = peers_race(2 * run->seconds, report, c->m, "8 refactorized", 0, entries, 2,
                                  NULL, baseline);
        }
        peer_cholmod_threads(1);
    }
    family_free(&c->f);
    match_free(c->m);
    free(c);
}

void bench_peers_several(bench_run *run) {
    static const double wanted[] = {1e4, 1e5};
    const bench_system *systems[3];
    int count = bench_systems(run, wanted, 2, systems);
    bench_report *report = bench_report_open(
        run, "peers_several", "M + t L for eight t beside CHOLMOD, same analysis for all of them",
        "ours on one thread");
    bench_machine_write(run, "peers_several");
    if (!run->mesh_path) {
        systems[count++] = bench_volume(run->size == BENCH_QUICK ? 20 : 30);
    }
    for (int k = 0; k < count; k++) {
        one_system(run, report, systems[k]);
    }
    bench_report_close(report);
}

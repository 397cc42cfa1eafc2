/* two_threads.c: how much faster are two threads, from the ordering to batches of local solves? */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "bench/lib/bench.h"

/* Times are of the wall clock, on a machine with two free cores. The baseline of a ratio is one
 * thread, in the same round; results are checked to have the same bits first. */
enum { MOST_RHS = 64, PLANS = 200 };

typedef struct contestant {
    const bench_system *system;
    sl_options options;
    sl_symbolic *S;
    sl_factor *F;
    sl_work *W;
    double *X;
    const double *B;
    sl_int nrhs;
    sl_request requests[PLANS];
} contestant;

static void call_analyze(void *state) {
    contestant *c = state;
    sl_symbolic_free(c->S);
    bench_must(sl_symbolic_create(&c->S, &c->system->A, &c->options, NULL), "analysis");
}

static void call_refactor(void *state) {
    contestant *c = state;
    bench_must(sl_factor_refactor(c->F, &c->system->A, NULL), "refactorization");
}

static void call_solve(void *state) {
    contestant *c = state;
    const size_t n = (size_t)c->system->n;
    bench_must(sl_factor_solve(c->F, c->X, n, c->B, n, c->nrhs, c->W), "full solve");
}

static void call_batch(void *state) {
    contestant *c = state;
    bench_must(sl_batch_solve(c->F, c->requests, PLANS, &c->options, NULL, NULL), "batch");
}

/* Races one and two threads. `numbers` of X are compared first, 0 of a call that writes none. */
static void race(bench_run *run, bench_report *report, contestant *both, const char *what,
                 void (*call)(void *), size_t numbers) {
    bench_contender contenders[2] = {{call, &both[0], 1, NULL}, {call, &both[1], 1, NULL}};
    bench_sample samples[2];
    for (int k = 0; k < 2; k++) {
        call(&both[k]);
    }
    if (!bench_expect(run, memcmp(both[0].X, both[1].X, numbers * sizeof(double)) == 0,
                      "%s, %s: two threads give other bits than one", both[0].system->name, what)) {
        return;
    }
    bench_race(samples, contenders, 2, run->seconds / 4);
    for (int k = 0; k < 2; k++) {
        bench_row row = {.what = what, .method = k == 0 ? "one thread" : "two threads"};
        row.threads = k + 1;
        row.nrhs = call == call_solve ? both[0].nrhs : 0;
        row.time = samples[k];
        row.baseline = samples[0].median;
        bench_report_row(report, both[0].system, &row);
    }
}

static void one_system(bench_run *run, bench_report *report, const bench_system *system) {
    static const sl_int counts[] = {1, 3, 8, 24, MOST_RHS};
    const size_t n = (size_t)system->n;
    double *B = bench_alloc(n * MOST_RHS, sizeof *B);
    contestant *both = bench_alloc(2, sizeof *both);
    uint64_t rng = 29;
    bench_random_fill(&rng, B, n * MOST_RHS);
    memset(both, 0, 2 * sizeof *both);
    for (int k = 0; k < 2; k++) {
        both[k].system = system;
        both[k].options.threads = bench_threads(k + 1);
        both[k].X = bench_alloc(n * MOST_RHS, sizeof *both[k].X);
        both[k].B = B;
        bench_must(sl_factor_create(&both[k].F, system->S, &system->A, &both[k].options, NULL),
                   "factor");
        bench_must(sl_work_create(&both[k].W, &both[k].options), "workspace");
    }
    race(run, report, both, "order, analyze", call_analyze, 0);
    race(run, report, both, "refactor", call_refactor, 0);
    for (size_t c = 0; c < sizeof counts / sizeof *counts; c++) {
        both[0].nrhs = both[1].nrhs = counts[c];
        race(run, report, both, "full solve", call_solve, n * (size_t)counts[c]);
    }
    for (int k = 0; k < PLANS; k++) {
        const sl_int row = (sl_int)(bench_random(&rng) % (uint64_t)system->n);
        sl_plan *P;
        bench_must(sl_plan_create(&P, system->S, &row, 1, &row, 1, NULL, NULL), "plan");
        for (int t = 0; t < 2; t++) {
            sl_request *r = &both[t].requests[k];
            r->plan = P;
            r->X = both[t].X + k;
            r->B = B + k;
            r->ldx = r->ldb = 1;
            r->nrhs = 1;
        }
    }
    race(run, report, both, "200 vertices", call_batch, PLANS);
    for (int k = 0; k < PLANS; k++) {
        sl_plan_free((sl_plan *)(uintptr_t)both[0].requests[k].plan);
    }
    for (int k = 0; k < 2; k++) {
        sl_work_free(both[k].W);
        sl_factor_free(both[k].F);
        sl_symbolic_free(both[k].S);
        free(both[k].X);
    }
    free(both);
    free(B);
}

void bench_two_threads(bench_run *run) {
    static const double wanted[] = {1e4, 1e5, 1e6};
    const bench_system *systems[3];
    const int count = bench_systems(run, wanted, 3, systems);
    bench_report *report = bench_report_open(
        run, "two_threads", "two threads against one, on two free cores", "one thread");
    for (int k = 0; k < count; k++) {
        one_system(run, report, systems[k]);
    }
    if (!run->mesh_path) {
        one_system(run, report, bench_volume(run->size == BENCH_QUICK ? 20 : 40));
    }
    bench_report_close(report);
}

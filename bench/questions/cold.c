/* cold.c: from the caller's matrix to the first solution: the time of each stage */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "bench/lib/bench.h"

/* Everything is created anew and released in every round, as in a program that solves one system. A
 * run that is not counted comes first, because pages of memory that a virtual machine has never
 * used take several times as long to clear as others.
 *
 * Times are of the wall clock, which threads shorten. "Analyze" is the time of a further
 * sl_symbolic_create that is given the order; "order" is what the first one takes beyond it, and at
 * least the ordering's own processor time divided by the threads. */
enum { STAGES = 5, MIN_ROUNDS = 2, MAX_ROUNDS = 30 };

static const char *const stages[STAGES] = {"order", "analyze", "first factor", "first solve",
                                           "together"};

typedef struct variant {
    const char *name;
    sl_purpose purpose;
    sl_int threads;
} variant;

static const variant variants[] = {{"many solves", SL_PURPOSE_MANY_SOLVES, 1},
                                   {"many solves", SL_PURPOSE_MANY_SOLVES, 2},
                                   {"one factor", SL_PURPOSE_ONE_FACTOR, 1},
                                   {"one factor", SL_PURPOSE_ONE_FACTOR, 2}};
enum { VARIANTS = sizeof variants / sizeof *variants };

/* The seconds of an analysis whose order is that of S. */
static double analyze_in_order(const bench_system *system, const sl_options *like,
                               const sl_symbolic *S) {
    sl_options opt = *like;
    sl_symbolic *again;
    opt.ordering = SL_ORDERING_GIVEN;
    opt.perm = sl_symbolic_view(S).perm;
    const double start = bench_now();
    bench_must(sl_symbolic_create(&again, &system->A, &opt, NULL), "analysis in a given order");
    const double seconds = bench_now() - start;
    sl_symbolic_free(again);
    return seconds;
}

/* One round: times[k] := the seconds of stage k. */
static void run_once(const bench_system *system, const sl_options *opt, double *x, const double *b,
                     double *times) {
    const size_t n = (size_t)system->n;
    sl_symbolic *S;
    sl_factor *F;
    sl_work *W;
    sl_stats stats;
    const double start = bench_now();
    bench_must(sl_symbolic_create(&S, &system->A, opt, &stats), "analysis");
    const double analyzed = bench_now();
    bench_must(sl_factor_create(&F, S, &system->A, opt, NULL), "factor");
    const double factored = bench_now();
    bench_must(sl_work_create(&W, opt), "workspace"); /* it has the threads of a solve */
    bench_must(sl_factor_solve(F, x, n, b, n, 1, W), "solve");
    times[4] = bench_now() - start;
    times[3] = times[4] - (factored - start);
    times[2] = factored - analyzed;
    times[1] = analyze_in_order(system, opt, S);
    times[0] = fmax(analyzed - start - times[1],
                    stats.symbolic.seconds_order / opt->threads.count);
    sl_work_free(W);
    sl_factor_free(F);
    sl_symbolic_free(S);
}

static sl_options options_of(const variant *v) {
    sl_options opt;
    memset(&opt, 0, sizeof opt);
    opt.purpose = v->purpose;
    opt.threads = bench_threads(v->threads);
    return opt;
}

/* Rounds of all variants in turn. */
static void one_system(bench_run *run, bench_report *report, const bench_system *system) {
    const size_t n = (size_t)system->n;
    double *x = bench_alloc(n, sizeof *x), *b = bench_alloc(n, sizeof *b);
    double(*times)[STAGES][MAX_ROUNDS] = bench_alloc(VARIANTS, sizeof *times);
    double once[STAGES];
    uint64_t rng = 17;
    int rounds = 0;
    bench_random_fill(&rng, b, n);
    const sl_options first = options_of(&variants[0]);
    run_once(system, &first, x, b, once);
    const double start = bench_now();
    while (rounds < MIN_ROUNDS ||
           (rounds < MAX_ROUNDS && bench_now() - start < 4 * run->seconds)) {
        for (int v = 0; v < VARIANTS; v++) {
            const sl_options opt = options_of(&variants[v]);
            run_once(system, &opt, x, b, once);
            if (rounds == 0) {
                bench_check_residual(run, system, x, b, 1, variants[v].name);
            }
            for (int k = 0; k < STAGES; k++) {
                times[v][k][rounds] = once[k];
            }
        }
        rounds++;
    }
    const double baseline = bench_sample_of(times[0][STAGES - 1], rounds).median;
    for (int v = 0; v < VARIANTS; v++) {
        for (int k = 0; k < STAGES; k++) {
            bench_row row = {.what = variants[v].name, .method = stages[k]};
            row.threads = variants[v].threads;
            row.time = bench_sample_of(times[v][k], rounds);
            row.baseline = baseline;
            bench_report_row(report, system, &row);
        }
    }
    free(times);
    free(b);
    free(x);
}

void bench_cold(bench_run *run) {
    static const double wanted[] = {1e4, 1e5, 5e5, 1e6, 4e6};
    const bench_system *systems[5];
    const int count = bench_systems(run, wanted, 5, systems);
    bench_report *report =
        bench_report_open(run, "cold", "from the matrix to the first solution", "all stages");
    for (int k = 0; k < count; k++) {
        one_system(run, report, systems[k]);
    }
    if (!run->mesh_path) {
        one_system(run, report, bench_volume(run->size == BENCH_QUICK ? 20 : 40));
    }
    bench_report_close(report);
}

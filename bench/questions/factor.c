/* factor.c: how long does factoring take, beside the alternatives and the limits? */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "bench.h"

#if defined(__GLIBC__)
#include <malloc.h>
#define RETURN_MEMORY() (void)malloc_trim(0)
#else
#define RETURN_MEMORY() (void)0
#endif

/* Every way to factor one system, over the order that its analysis found; the permutation is given, so the analysis
 * is timed without METIS. A solve with each is checked. The rate is stats.flops (the sum over columns of entries^2,
 * twice the multiply-adds of L without relaxation) a second, the limit these flops at the peak of the ISA, times the
 * threads. */
enum { MAX_SYSTEMS = 8, MOST_WAYS = 8, THREADS = 2 };

/* What is slow is timed apart, so that the rest gets more rounds, and where it would take minutes not at all. */
static const double most_flops_uplooking = 3e11, most_flops_scalar = 1e9;

typedef struct way {
    const char *method;
    sl_options options;
    const bench_system *system;
    sl_factor *F;
    int slow;
} way;

static void call_refactor(void *state) {
    way *w = state;
    bench_must(sl_factor_refactor(w->F, &w->system->A, NULL), w->method);
}

/* A first factorization, memory given back to the system before it: page faults and all. */
static void ready_first(void *state) {
    way *w = state;
    sl_factor_free(w->F);
    w->F = NULL;
    RETURN_MEMORY();
}

static void call_first(void *state) {
    way *w = state;
    bench_must(sl_factor_create(&w->F, w->system->S, &w->system->A, &w->options, NULL), w->method);
}

typedef struct analysis {
    const bench_system *system;
    sl_options options;
    sl_symbolic *S;
} analysis;

static void ready_analyse(void *state) {
    analysis *a = state;
    sl_symbolic_free(a->S);
    a->S = NULL;
    RETURN_MEMORY();
}

static void call_analyse(void *state) {
    analysis *a = state;
    bench_must(sl_symbolic_create(&a->S, &a->system->A, &a->options, NULL), "analysis");
}

static void note_memory(bench_report *report, const bench_system *system, sl_options options) {
    const bench_memory m = bench_memory_of(system, options);
    bench_report_note(report,
                      "%-14s   memory: A %.1f MB, panels of L %.1f MB; analysis %.1f MB (%.1f at "
                      "its peak), factor %.1f MB;",
                      "", 1e-6 * m.matrix, 1e-6 * m.panels, 1e-6 * m.analysis,
                      1e-6 * m.analysis_peak, 1e-6 * m.factor);
    bench_report_note(report, "%-14s   peak of analyse + factor %.1f MB = %.2f (A + panels of L)",
                      "", 1e-6 * m.peak, m.peak / (m.matrix + m.panels));
}

/* ---- ways ---- */

static int add_way(way *ways, int count, const bench_system *system, const char *method,
                   sl_method how, sl_isa isa, sl_int threads) {
    way *w = &ways[count];
    memset(w, 0, sizeof *w);
    w->method = method;
    w->system = system;
    w->options.method = how;
    w->options.isa = isa;
    if (threads > 1) {
        w->options.threads = bench_threads(threads);
    }
    const sl_status status = sl_factor_create(&w->F, system->S, &system->A, &w->options,
                                              NULL); /* not every ISA is here */
    if (status == SL_ERR_UNSUPPORTED) {
        return count;
    }
    bench_must(status, method);
    return count + 1;
}

/* The supernodal method of the best ISA comes first: it is the baseline. */
static int make_ways(way *ways, const bench_system *system) {
    const double flops = system->stats.flops;
    const sl_isa best = system->stats.isa;
    int count = add_way(ways, 0, system, "refactor", SL_METHOD_SUPERNODAL, SL_ISA_AUTO, 1), fast;
    count = add_way(ways, count, system, "refactor, 2 threads", SL_METHOD_SUPERNODAL, SL_ISA_AUTO,
                    THREADS);
    if (best != SL_ISA_AVX2) {
        count = add_way(ways, count, system, "refactor, AVX2 forced", SL_METHOD_SUPERNODAL,
                        SL_ISA_AVX2, 1);
    }
    fast = count;
    if (best != SL_ISA_SCALAR && flops < most_flops_scalar) {
        count = add_way(ways, count, system, "refactor, scalar forced", SL_METHOD_SUPERNODAL,
                        SL_ISA_SCALAR, 1);
    }
    if (flops < most_flops_uplooking) {
        count = add_way(ways, count, system, "refactor, up-looking", SL_METHOD_UP_LOOKING,
                        SL_ISA_AUTO, 1);
    }
    for (int c = fast; c < count; c++) {
        ways[c].slow = 1;
    }
    return count;
}

static int check_way(bench_run *run, way *w) {
    const size_t n = (size_t)w->system->n;
    double *b = bench_alloc(n, sizeof *b), *x = bench_alloc(n, sizeof *x);
    uint64_t chance = 6;
    bench_random_fill(&chance, b, n);
    bench_must(sl_factor_solve(w->F, x, n, b, n, 1, NULL), "full solve");
    const int good = bench_check_residual(run, w->system, x, b, 1, w->method);
    free(x);
    free(b);
    return good;
}

static void report_ways(bench_report *report, const bench_system *system, const way *ways,
                        const bench_sample *samples, int count, double baseline) {
    for (int c = 0; c < count; c++) {
        sl_stats stats = system->stats;
        bench_row row = {.what = "factor",
                         .method = ways[c].method,
                         .flops = system->stats.flops,
                         .time = samples[c],
                         .baseline = baseline};
        sl_factor_stats(ways[c].F, &stats);
        row.isa = stats.isa;
        row.threads = ways[c].options.threads.count;
        bench_report_row(report, system, &row);
    }
}

static void one_system(bench_run *run, bench_report *report, const bench_system *system) {
    way ways[MOST_WAYS], first = {"first, memory included", {0}, system, NULL, 0};
    analysis a = {system, {0}, NULL};
    bench_contender contenders[MOST_WAYS];
    bench_sample samples[MOST_WAYS], prepared[2];
    int count = make_ways(ways, system), fast = 0, good = 1;
    a.options.ordering = SL_ORDERING_GIVEN;
    a.options.perm = sl_symbolic_view(system->S).perm;
    for (int c = 0; c < count; c++) {
        good &= check_way(run, &ways[c]);
        fast += !ways[c].slow;
        contenders[c] = (bench_contender){call_refactor, &ways[c], 1, NULL};
    }
    if (good) {
        bench_race(samples, contenders, fast, run->seconds);
        bench_race(samples + fast, contenders + fast, count - fast, run->seconds / 20);
        const double baseline = samples[0].median;
        bench_contender cold[2] = {{call_analyse, &a, 1, ready_analyse},
                                   {call_first, &first, 1, ready_first}};
        bench_race(prepared, cold, 2, run->seconds / 2);
        bench_row row = {
            .what = "analyse", .method = "order given", .time = prepared[0], .baseline = baseline};
        bench_report_row(report, system, &row);
        report_ways(report, system, &first, &prepared[1], 1, baseline);
        report_ways(report, system, ways, samples, count, baseline);
        sl_symbolic_free(a.S);
        sl_factor_free(first.F);
    }
    for (int c = 0; c < count; c++) {
        sl_factor_free(ways[c].F);
    }
    note_memory(report, system, a.options);
}

void bench_factor(bench_run *run) {
    static const double wanted[] = {1e4, 1e5, 1e6, 4e6};
    static const sl_int sides[] = {20, 40, 60}; /* volumes */
    const bench_system *systems[MAX_SYSTEMS];
    int count = bench_systems(run, wanted, 4, systems);
    bench_report *report = bench_report_open(
        run, "factor", "the ways to factor: methods, instruction sets, threads", "refactor");
    for (int k = 0; k < count; k++) {
        one_system(run, report, systems[k]);
    }
    for (int k = 0; k < 3 && !run->mesh_path; k++) {
        if (run->size == BENCH_QUICK ? k == 0 : k == 1 || (k == 2 && run->size == BENCH_FULL)) {
            one_system(run, report, bench_volume(sides[k]));
        }
    }
    bench_report_close(report);
}

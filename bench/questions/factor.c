/* factor.c: how long does a factorization take, and how far is it from the limits? */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "bench/lib/bench.h"

#if defined(__GLIBC__)
#include <malloc.h>
#define RETURN_MEMORY() (void)malloc_trim(0)
#else
#define RETURN_MEMORY() (void)0
#endif

/* Every variant factors one system in the ordering that its analysis found. That ordering is
 * given to the analysis, whose time therefore contains no ordering. A solve with each factor is
 * checked. The rate is stats.symbolic.flops (the sum over columns of entries^2, twice the
 * multiply-adds of L without relaxation) per second; the limit is these flops at the peak of the
 * instruction set, times the threads. */
enum { MAX_SYSTEMS = 8, MAX_VARIANTS = 8, THREADS = 2 };

/* Slow variants are timed in a race of their own, so that the others get more rounds; variants
 * that would take minutes are left out. */
static const double max_flops_uplooking = 3e11, max_flops_scalar = 1e9;

typedef struct variant {
    const char *method;
    sl_options options;
    const bench_system *system;
    sl_factor *F;
    int is_slow;
} variant;

static void call_refactor(void *state) {
    variant *w = state;
    bench_must(sl_factor_refactor(w->F, &w->system->A, NULL), w->method);
}

/* A first factorization. Memory is returned to the system before it, so its time includes the
 * page faults. */
static void ready_first(void *state) {
    variant *w = state;
    sl_factor_free(w->F);
    w->F = NULL;
    RETURN_MEMORY();
}

static void call_first(void *state) {
    variant *w = state;
    bench_must(sl_factor_create(&w->F, w->system->S, &w->system->A, &w->options, NULL), w->method);
}

typedef struct analysis {
    const bench_system *system;
    sl_options options;
    sl_symbolic *S;
} analysis;

static void ready_analyze(void *state) {
    analysis *a = state;
    sl_symbolic_free(a->S);
    a->S = NULL;
    RETURN_MEMORY();
}

static void call_analyze(void *state) {
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
    bench_report_note(report, "%-14s   peak of analyze + factor %.1f MB = %.2f (A + panels of L)",
                      "", 1e-6 * m.peak, m.peak / (m.matrix + m.panels));
}

/* ---- variants ---- */

static int add_variant(variant *variants, int count, const bench_system *system, const char *method,
                       sl_method how, sl_isa isa, sl_int threads) {
    variant *w = &variants[count];
    memset(w, 0, sizeof *w);
    w->method = method;
    w->system = system;
    w->options.method = how;
    w->options.isa = isa;
    if (threads > 1) {
        w->options.threads = bench_threads(threads);
    }
    const sl_status status = sl_factor_create(&w->F, system->S, &system->A, &w->options,
                                              NULL); /* the instruction set may be absent */
    if (status == SL_ERR_UNSUPPORTED) {
        return count;
    }
    bench_must(status, method);
    return count + 1;
}

/* The supernodal method with the best instruction set comes first: it is the baseline. */
static int add_variants(variant *variants, const bench_system *system) {
    const double flops = system->stats.symbolic.flops;
    const sl_isa best = system->stats.factor.isa;
    int count = add_variant(variants, 0, system, "refactor", SL_METHOD_SUPERNODAL, SL_ISA_AUTO, 1),
        fast;
    count = add_variant(variants, count, system, "refactor, 2 threads", SL_METHOD_SUPERNODAL,
                        SL_ISA_AUTO, THREADS);
    if (best != SL_ISA_AVX2) {
        count = add_variant(variants, count, system, "refactor, AVX2 forced", SL_METHOD_SUPERNODAL,
                            SL_ISA_AVX2, 1);
    }
    fast = count;
    if (best != SL_ISA_SCALAR && flops < max_flops_scalar) {
        count = add_variant(variants, count, system, "refactor, scalar forced",
                            SL_METHOD_SUPERNODAL, SL_ISA_SCALAR, 1);
    }
    if (flops < max_flops_uplooking) {
        count = add_variant(variants, count, system, "refactor, up-looking", SL_METHOD_UP_LOOKING,
                            SL_ISA_AUTO, 1);
    }
    for (int c = fast; c < count; c++) {
        variants[c].is_slow = 1;
    }
    return count;
}

static int check_variant(bench_run *run, variant *w) {
    const size_t n = (size_t)w->system->n;
    double *b = bench_alloc(n, sizeof *b), *x = bench_alloc(n, sizeof *x);
    uint64_t rng = 6;
    bench_random_fill(&rng, b, n);
    bench_must(sl_factor_solve(w->F, x, n, b, n, 1, NULL), "full solve");
    const int passed = bench_check_residual(run, w->system, x, b, 1, w->method);
    free(x);
    free(b);
    return passed;
}

static void report_variants(bench_report *report, const bench_system *system,
                            const variant *variants, const bench_sample *samples, int count,
                            double baseline) {
    for (int c = 0; c < count; c++) {
        sl_stats stats = system->stats;
        bench_row row = {.what = "factor",
                         .method = variants[c].method,
                         .flops = system->stats.symbolic.flops,
                         .time = samples[c],
                         .baseline = baseline};
        stats.factor = sl_factor_view(variants[c].F).info;
        row.isa = stats.factor.isa;
        row.threads = variants[c].options.threads.count;
        bench_report_row(report, system, &row);
    }
}

static void one_system(bench_run *run, bench_report *report, const bench_system *system) {
    variant variants[MAX_VARIANTS], first = {"first, memory included", {0}, system, NULL, 0};
    analysis a = {system, {0}, NULL};
    bench_contender contenders[MAX_VARIANTS];
    bench_sample samples[MAX_VARIANTS], prepared[2];
    int count = add_variants(variants, system), fast = 0, passed = 1;
    a.options.ordering = SL_ORDERING_GIVEN;
    a.options.perm = sl_symbolic_view(system->S).perm;
    for (int c = 0; c < count; c++) {
        passed &= check_variant(run, &variants[c]);
        fast += !variants[c].is_slow;
        contenders[c] = (bench_contender){call_refactor, &variants[c], 1, NULL};
    }
    if (passed) {
        bench_race(samples, contenders, fast, run->seconds);
        bench_race(samples + fast, contenders + fast, count - fast, run->seconds / 20);
        const double baseline = samples[0].median;
        bench_contender cold[2] = {{call_analyze, &a, 1, ready_analyze},
                                   {call_first, &first, 1, ready_first}};
        bench_race(prepared, cold, 2, run->seconds / 2);
        bench_row row = {
            .what = "analyze", .method = "order given", .time = prepared[0], .baseline = baseline};
        bench_report_row(report, system, &row);
        report_variants(report, system, &first, &prepared[1], 1, baseline);
        report_variants(report, system, variants, samples, count, baseline);
        sl_symbolic_free(a.S);
        sl_factor_free(first.F);
    }
    for (int c = 0; c < count; c++) {
        sl_factor_free(variants[c].F);
    }
    note_memory(report, system, a.options);
}

void bench_factor(bench_run *run) {
    static const double wanted[] = {1e4, 1e5, 1e6, 4e6};
    static const sl_int sides[] = {20, 40, 60}; /* volumes */
    const bench_system *systems[MAX_SYSTEMS];
    int count = bench_systems(run, wanted, 4, systems);
    bench_report *report = bench_report_open(
        run, "factor", "factorization by method, instruction set and threads", "refactor");
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

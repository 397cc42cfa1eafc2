/* scaling.c: how do ordering, analysis, factorization and nnz(L) grow with n? */
#include <stdio.h>
#include <stdlib.h>

#include "bench/lib/bench.h"

/* Figure 6 (left) of [HDA17]: nested dissection of a flat mesh should give O(n log n) entries of
 * L and O(n^1.5) operations. Times of ordering and analysis are the processor seconds that the
 * library reports. */
enum { MAX_SYSTEMS = 8, MAX_REPEATS = 50, PHASES = 4 };

static const char *const phases[PHASES] = {"order", "analyze", "factor, first", "refactor"};

typedef struct factor_state {
    const bench_system *system;
    sl_factor *F, *first;
} factor_state;

static void free_first(void *state) {
    factor_state *r = state;
    sl_factor_free(r->first);
    r->first = NULL;
}

static void call_factor(void *state) {
    factor_state *r = state;
    bench_must(sl_factor_create(&r->first, r->system->S, &r->system->A, NULL, NULL), "factor");
}

static void call_refactor(void *state) {
    factor_state *r = state;
    bench_must(sl_factor_refactor(r->F, &r->system->A, NULL), "refactor");
}

/* Repeats the analysis while time remains; the analysis that built the system is the first
 * sample. */
static void time_analysis(const bench_run *run, const bench_system *system, bench_sample *out) {
    double order[MAX_REPEATS], analyze[MAX_REPEATS], start = bench_now();
    int count = 1;
    order[0] = system->stats.symbolic.seconds_order;
    analyze[0] = system->stats.symbolic.seconds_analyze;
    while (count < MAX_REPEATS && bench_now() - start + system->stats.symbolic.seconds_order +
                                          system->stats.symbolic.seconds_analyze <
                                      run->seconds) {
        sl_symbolic *S;
        sl_stats stats;
        bench_must(sl_symbolic_create(&S, &system->A, NULL, &stats), "analysis");
        sl_symbolic_free(S);
        order[count] = stats.symbolic.seconds_order;
        analyze[count++] = stats.symbolic.seconds_analyze;
    }
    out[0] = bench_sample_of(order, count);
    out[1] = bench_sample_of(analyze, count);
}

static void check_factor(bench_run *run, const factor_state *r) {
    size_t n = (size_t)r->system->n;
    double *b = bench_alloc(n, sizeof *b), *x = bench_alloc(n, sizeof *x);
    uint64_t rng = 6;
    bench_random_fill(&rng, b, n);
    bench_must(sl_factor_solve(r->F, x, n, b, n, 1, NULL), "full solve");
    bench_check_residual(run, r->system, x, b, 1, "refactor");
    free(x);
    free(b);
}

static void one_system(bench_run *run, bench_report *report, const bench_system *system,
                       double *seconds) {
    bench_sample samples[PHASES];
    factor_state r = {system, NULL, NULL};
    bench_contender contenders[2] = {{call_factor, &r, 1, free_first},
                                     {call_refactor, &r, 1, NULL}};
    bench_must(sl_factor_create(&r.F, system->S, &system->A, NULL, NULL), "factor");
    bench_must(sl_factor_refactor(r.F, &system->A, NULL), "refactor");
    check_factor(run, &r);
    time_analysis(run, system, samples);
    bench_race(&samples[2], contenders, 2, run->seconds);
    free_first(&r);
    sl_factor_free(r.F);
    for (int c = 0; c < PHASES; c++) {
        bench_row row = {.what = "setup",
                         .method = phases[c],
                         .time = samples[c],
                         .baseline = samples[3].median};
        row.flops = c >= 2 ? system->stats.symbolic.flops : 0;
        bench_report_row(report, system, &row);
        seconds[c] = samples[c].median;
    }
    bench_report_note(
        report,
        "%-14s   %d supernodes (%d before relaxation), %.4g flops, tree height %d columns, %.1f MB "
        "analysis, %.1f MB factor",
        "", (int)system->stats.symbolic.supernodes,
        (int)system->stats.symbolic.supernodes_fundamental, system->stats.symbolic.flops,
        (int)system->stats.symbolic.tree_height, 1e-6 * (double)system->stats.symbolic.bytes,
        1e-6 * (double)system->stats.factor.bytes);
}

static void report_exponents(bench_report *report, const bench_system *const *systems, int count,
                             double (*seconds)[PHASES]) {
    double n[MAX_SYSTEMS], nnz[MAX_SYSTEMS], flops[MAX_SYSTEMS], phase[PHASES][MAX_SYSTEMS];
    for (int k = 0; k < count; k++) {
        n[k] = systems[k]->n;
        nnz[k] = (double)systems[k]->stats.symbolic.nnz_l;
        flops[k] = systems[k]->stats.symbolic.flops;
        for (int c = 0; c < PHASES; c++) {
            phase[c][k] = seconds[k][c];
        }
    }
    bench_report_note(
        report,
        "exponents of n, fitted: nnz(L) %.2f, flops %.2f, order %.2f, analyze %.2f, first factor "
        "%.2f, refactor %.2f",
        bench_fit_exponent(n, nnz, count), bench_fit_exponent(n, flops, count),
        bench_fit_exponent(n, phase[0], count), bench_fit_exponent(n, phase[1], count),
        bench_fit_exponent(n, phase[2], count), bench_fit_exponent(n, phase[3], count));
}

void bench_scaling(bench_run *run) {
    static const double wanted[] = {1e4, 5e4, 1e5, 2e5, 5e5, 1e6, 4e6};
    static const sl_int sides[] = {15, 20, 30, 40, 60}; /* of volumes */
    const bench_system *systems[MAX_SYSTEMS];
    double seconds[MAX_SYSTEMS][PHASES];
    int count = bench_systems(run, wanted, 7, systems);
    int volumes = run->mesh_path               ? 0
                  : run->size == BENCH_QUICK   ? 2
                  : run->size == BENCH_DEFAULT ? 4
                                               : 5;
    bench_report *report = bench_report_open(
        run, "scaling", "ordering, analysis, factorization ([HDA17] Figure 6)", "refactor");
    bench_plot *plot = bench_plot_open(run, "scaling", "Ordering, analysis, factorization",
                                       "vertices", "seconds", "xy");
    for (int is_volume = 0; is_volume < 2; is_volume++) {
        if (is_volume == 1) {
            for (count = 0; count < volumes; count++) {
                systems[count] = bench_volume(sides[count]);
            }
        }
        for (int k = 0; k < count; k++) {
            one_system(run, report, systems[k], seconds[k]);
            for (int c = 0; c < PHASES && is_volume == 0; c++) {
                bench_plot_point(plot, phases[c], "linespoints", systems[k]->n, seconds[k][c]);
            }
        }
        if (count > 1) {
            printf("\n");
            report_exponents(report, systems, count, seconds);
        }
    }
    bench_plot_close(plot);
    bench_report_close(report);
}

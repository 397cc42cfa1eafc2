/* scaling.c: how do ordering, analysis, factorization and the size of L grow with the mesh? */
#include <stdio.h>
#include <stdlib.h>

#include "bench.h"

/* Figure 6 (left) of [HDA17]: nested dissection of a flat mesh should give n log n entries of L and n^1.5 operations.
 * Times of ordering and analysis are the processor seconds that the library itself reports. */
enum { MAX_SYSTEMS = 8, MAX_REPEATS = 50, PHASES = 4 };

static const char *const phases[PHASES] = {"order", "analyse", "factor, first", "refactor"};

typedef struct refactoring {
    const bench_system *system;
    sl_factor *F, *first;
} refactoring;

static void free_first(void *state) {
    refactoring *r = state;
    sl_factor_free(r->first);
    r->first = NULL;
}

static void call_factor(void *state) {
    refactoring *r = state;
    bench_must(sl_factor_create(&r->first, r->system->S, &r->system->A, NULL, NULL), "factor");
}

static void call_refactor(void *state) {
    refactoring *r = state;
    bench_must(sl_factor_refactor(r->F, &r->system->A, NULL), "refactor");
}

/* Analyses again while time remains; the analysis that built the system counts as the first sample. */
static void time_analysis(const bench_run *run, const bench_system *system, bench_sample *out) {
    double order[MAX_REPEATS], analyse[MAX_REPEATS], start = bench_now();
    int count = 1;
    order[0] = system->stats.seconds_order;
    analyse[0] = system->stats.seconds_analyse;
    while (count < MAX_REPEATS &&
           bench_now() - start + system->stats.seconds_order + system->stats.seconds_analyse <
               run->seconds) {
        sl_symbolic *S;
        sl_stats stats;
        bench_must(sl_symbolic_create(&S, &system->A, NULL, &stats), "analysis");
        sl_symbolic_free(S);
        order[count] = stats.seconds_order;
        analyse[count++] = stats.seconds_analyse;
    }
    out[0] = bench_sample_of(order, count);
    out[1] = bench_sample_of(analyse, count);
}

static void check_factor(bench_run *run, const refactoring *r) {
    size_t n = (size_t)r->system->n;
    double *b = bench_alloc(n, sizeof *b), *x = bench_alloc(n, sizeof *x);
    uint64_t chance = 6;
    bench_random_fill(&chance, b, n);
    bench_must(sl_factor_solve(r->F, x, n, b, n, 1, NULL), "full solve");
    bench_check_residual(run, r->system, x, b, 1, "refactor");
    free(x);
    free(b);
}

static void one_system(bench_run *run, bench_report *report, const bench_system *system,
                       double *seconds) {
    bench_sample samples[PHASES];
    refactoring r = {system, NULL, NULL};
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
        bench_row row = {.what = "prepare",
                         .method = phases[c],
                         .time = samples[c],
                         .baseline = samples[3].median};
        row.flops = c >= 2 ? system->stats.flops : 0;
        bench_report_row(report, system, &row);
        seconds[c] = samples[c].median;
    }
    bench_report_note(
        report,
        "%-14s   %d supernodes (%d before relaxation), %.4g flops, tree %d columns high, %.1f MB "
        "analysis, %.1f MB factor",
        "", (int)system->stats.supernodes, (int)system->stats.supernodes_fundamental,
        system->stats.flops, (int)system->stats.tree_height,
        1e-6 * (double)system->stats.bytes_symbolic, 1e-6 * (double)system->stats.bytes_factor);
}

static void fits(bench_report *report, const bench_system *const *systems, int count,
                 double (*seconds)[PHASES]) {
    double n[MAX_SYSTEMS], nnz[MAX_SYSTEMS], flops[MAX_SYSTEMS], phase[PHASES][MAX_SYSTEMS];
    for (int k = 0; k < count; k++) {
        n[k] = systems[k]->n;
        nnz[k] = (double)systems[k]->stats.nnz_l;
        flops[k] = systems[k]->stats.flops;
        for (int c = 0; c < PHASES; c++) {
            phase[c][k] = seconds[k][c];
        }
    }
    bench_report_note(
        report,
        "exponents of n, fitted: nnz(L) %.2f, flops %.2f, order %.2f, analyse %.2f, first factor "
        "%.2f, refactor %.2f",
        bench_fit_exponent(n, nnz, count), bench_fit_exponent(n, flops, count),
        bench_fit_exponent(n, phase[0], count), bench_fit_exponent(n, phase[1], count),
        bench_fit_exponent(n, phase[2], count), bench_fit_exponent(n, phase[3], count));
}

void bench_scaling(bench_run *run) {
    static const double wanted[] = {1e4, 5e4, 1e5, 2e5, 5e5, 1e6, 4e6};
    static const sl_int sides[] = {15, 20, 30, 40, 60}; /* volumes; by size of the run */
    const bench_system *systems[MAX_SYSTEMS];
    double seconds[MAX_SYSTEMS][PHASES];
    int count = bench_systems(run, wanted, 7, systems);
    int volumes = run->mesh_path               ? 0
                  : run->size == BENCH_QUICK   ? 2
                  : run->size == BENCH_DEFAULT ? 4
                                               : 5;
    bench_report *report = bench_report_open(
        run, "scaling", "ordering, analysis, factorization (paper: Figure 6)", "refactor");
    bench_plot *plot =
        bench_plot_open(run, "scaling", "Preparing a factorization", "vertices", "seconds", "xy");
    for (int part = 0; part < 2; part++) {
        if (part == 1) {
            for (count = 0; count < volumes; count++) {
                systems[count] = bench_volume(sides[count]);
            }
        }
        for (int k = 0; k < count; k++) {
            one_system(run, report, systems[k], seconds[k]);
            for (int c = 0; c < PHASES && part == 0; c++) {
                bench_plot_point(plot, phases[c], "linespoints", systems[k]->n, seconds[k][c]);
            }
        }
        if (count > 1) {
            printf("\n");
            fits(report, systems, count, seconds);
        }
    }
    bench_plot_close(plot);
    bench_report_close(report);
}

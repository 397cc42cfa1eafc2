/* amortize.c: after how many patches does one factorization of the whole mesh pay off? */
#include <stdio.h>
#include <stdlib.h>

#include "bench/lib/bench.h"

/* Figure 6 (right) of [HDA17]: the time to analyze and factor A(patch, patch), divided by that
 * of the whole matrix, against the patch's share of the vertices. Its inverse is the number of
 * patches from which on the whole factorization is cheaper, without the solves. In the paper the
 * ratio depends on the share alone, and 20 % of the vertices take a tenth of the time. */
enum { SHARES = 8 };

typedef struct setup {
    const sl_csc *A;
} setup;

static void call_setup(void *state) {
    const setup *p = state;
    sl_symbolic *S;
    sl_factor *F;
    bench_must(sl_symbolic_create(&S, p->A, NULL, NULL), "analysis");
    bench_must(sl_factor_create(&F, S, p->A, NULL, NULL), "factor");
    sl_factor_free(F);
    sl_symbolic_free(S);
}

static void one_system(const bench_run *run, bench_report *report, bench_plot *plot,
                       const bench_system *system) {
    static const double shares[SHARES] = {0.01, 0.02, 0.05, 0.1, 0.2, 0.4, 0.6, 0.8};
    setup whole = {&system->A};
    bench_contender contender = {call_setup, &whole, 1, NULL};
    bench_row row = {.what = "whole", .method = "analyze and factor"};
    bench_race(&row.time, &contender, 1, run->seconds);
    row.baseline = row.time.median;
    bench_report_row(report, system, &row);
    for (int k = 0; k < SHARES; k++) {
        sl_int size = (sl_int)(shares[k] * system->n);
        bench_patch patch;
        char what[48], series[48];
        if (bench_patch_pick(&patch, 1, system, size) == 0) {
            continue;
        }
        setup patch_only = {&patch.A};
        contender.state = &patch_only;
        snprintf(what, sizeof what, "patch of %.0f %%", 100 * shares[k]);
        snprintf(series, sizeof series, "mesh of %d vertices", (int)system->n);
        row.what = what;
        bench_race(&row.time, &contender, 1, run->seconds / 2);
        bench_report_row(report, system, &row);
        bench_plot_point(plot, series, "linespoints", shares[k], row.time.median / row.baseline);
        bench_patch_free(&patch);
    }
}

void bench_amortize(bench_run *run) {
    static const double wanted[] = {1e4, 5e4, 2e5, 1e6};
    const bench_system *systems[4];
    int count = bench_systems(run, wanted, run->size == BENCH_FULL ? 4 : 3, systems);
    bench_report *report =
        bench_report_open(run, "amortize",
                          "setup for a patch alone against setup for the mesh ([HDA17] Figure 6, "
                          "right)",
                          "analyze and factor the whole mesh");
    bench_plot *plot =
        bench_plot_open(run, "amortize", "Setup for a patch alone, against the whole mesh",
                        "share of the vertices", "share of the time", "xy");
    for (int k = 0; k < count; k++) {
        one_system(run, report, plot, systems[k]);
    }
    bench_plot_close(plot);
    bench_report_close(report);
}

/* amortize.c: how many patches, each factored for itself, take as long as factoring the whole mesh? */
#include <stdio.h>
#include <stdlib.h>

#include "bench.h"

/* Figure 6 (right) of [HDA17]: the time of analysing and factoring A(patch, patch) over that of the whole matrix, against
 * the patch's share of the vertices. One over it is the number of patches from which on the whole factorization pays,
 * the solves left aside. In the paper the ratio depends on the share alone, and 20 % of the vertices take a tenth of the
 * time. */
enum { SHARES = 8 };

typedef struct preparation {
    const sl_csc *A;
} preparation;

static void call_prepare(void *state) {
    const preparation *p = state;
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
    preparation whole = {&system->A};
    bench_contender contender = {call_prepare, &whole, 1, NULL};
    bench_row row = {.what = "whole", .method = "analyse and factor"};
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
        preparation part = {&patch.A};
        contender.state = &part;
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
                          "preparing a patch alone against preparing the mesh (paper: Figure 6, "
                          "right)",
                          "analyse and factor the whole mesh");
    bench_plot *plot =
        bench_plot_open(run, "amortize", "Preparing a patch alone, against the whole mesh",
                        "share of the vertices", "share of the time", "xy");
    for (int k = 0; k < count; k++) {
        one_system(run, report, plot, systems[k]);
    }
    bench_plot_close(plot);
    bench_report_close(report);
}

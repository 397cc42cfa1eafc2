/* multi_rhs.c: how much faster are several right-hand sides in one call than in one call each? */
#include <stdio.h>
#include <stdlib.h>

#include "bench/lib/bench.h"

/* [HDA17] section 3 reports a factor of 2.5 for 8 right-hand sides. The baseline of a ratio is
 * the same number in one call each, in the same round; the plot shows the speedup. */
enum { MAX_RHS = 8 };

typedef struct contestants {
    const char *what;
    void (*together)(void *), (*one_by_one)(void *);
} contestants;

static void one_count(bench_run *run, bench_report *report, bench_plot *plot, bench_queries *q,
                      const contestants *f) {
    bench_contender contenders[2] = {{f->together, q, q->count, NULL},
                                     {f->one_by_one, q, q->count, NULL}};
    int full = f->one_by_one == bench_call_full_one_by_one;
    if (full) {
        contenders[0].batch = contenders[1].batch = 1;
    }
    bench_sample samples[2];
    bench_row row = {.what = f->what, .method = "together", .nrhs = q->nrhs};
    sl_stats reach = bench_queries_reach(q);
    char series[64];
    bench_race(samples, contenders, 2, run->seconds / 4);
    row.baseline = samples[1].median;
    for (int c = 0; c < 2; c++) {
        if (full) {
            bench_row_full(&row, q->system);
        } else {
            bench_row_reach(&row, &reach);
        }
        if (c == 1) {
            row.method = "one by one";
            row.entries *= q->nrhs;
            row.passes = q->nrhs;
        }
        row.time = samples[c];
        bench_report_row(report, q->system, &row);
    }
    snprintf(series, sizeof series, "%s, n %d", f->what, (int)q->system->n);
    bench_plot_point(plot, series, "linespoints", q->nrhs, samples[1].median / samples[0].median);
}

/* For the full solves, B is random in all n rows. */
static void one_system(bench_run *run, bench_report *report, bench_plot *plot,
                       const bench_system *system) {
    static const int counts[] = {1, 2, 4, 8};
    static const contestants full = {"full", bench_call_full, bench_call_full_one_by_one};
    static const contestants interleaved = {"full, inter.", bench_call_full_interleaved,
                                            bench_call_full_one_by_one};
    static const contestants vertex = {"vertex", bench_call_plan_solve,
                                       bench_call_plan_solve_one_by_one};
    static const contestants patch = {"patch 2000", bench_call_plan_solve,
                                      bench_call_plan_solve_one_by_one};
    bench_patch patches[4];
    int n_patches = bench_patch_pick(patches, 4, system, 2000);
    for (int c = 0; c < (int)(sizeof counts / sizeof *counts); c++) {
        bench_queries *v = bench_queries_vertices(system, 64, counts[c]);
        uint64_t rng = 5;
        if (bench_queries_check(run, v, 2)) {
            one_count(run, report, plot, v, &vertex);
        }
        bench_random_fill(&rng, v->B_full, (size_t)system->n * (size_t)counts[c]);
        bench_call_full(v);
        if (bench_check_residual(run, system, v->X_full, v->B_full, counts[c], "full solve")) {
            one_count(run, report, plot, v, &full);
            if (counts[c] == 8) {
                one_count(run, report, plot, v, &interleaved);
            }
        }
        bench_queries_free(v);
        bench_queries *p = bench_queries_create(system, 4, counts[c]);
        for (int k = 0; k < n_patches; k++) {
            bench_queries_add(p, patches[k].boundary, patches[k].n_boundary, patches[k].vertices,
                              patches[k].size);
        }
        if (n_patches > 0 && bench_queries_check(run, p, 1)) {
            one_count(run, report, plot, p, &patch);
        }
        bench_queries_free(p);
    }
    for (int k = 0; k < n_patches; k++) {
        bench_patch_free(&patches[k]);
    }
}

void bench_multi_rhs(bench_run *run) {
    static const double wanted[] = {1e4, 1e5, 5e5, 1e6};
    const bench_system *systems[4];
    int count = bench_systems(run, wanted, 4, systems);
    bench_report *report = bench_report_open(
        run, "multi_rhs", "1 to 8 right-hand sides in one call ([HDA17]: 2.5 times as fast for 8)",
        "one call per right-hand side");
    bench_plot *plot =
        bench_plot_open(run, "multi_rhs", "Right-hand sides in one call against one call each",
                        "right-hand sides", "times faster", "");
    for (int k = 0; k < count; k++) {
        one_system(run, report, plot, systems[k]);
    }
    bench_plot_close(plot);
    bench_report_close(report);
}

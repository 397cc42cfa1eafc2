/* locality.c: does the cost of a local solve per entry of L grow with the mesh? */
#include <stdio.h>
#include <stdlib.h>

#include "bench/lib/bench.h"

/* A patch of 500 vertices in the middle of the mesh with b at its center, and single vertices
 * with b and x at the same vertex. Paths to the root grow with the mesh, so the entries read
 * grow too (about 2.4 n for one vertex of a flat mesh). The time per entry must not grow: any
 * copy, clearing or allocation of O(n) would show there. */
enum { PATCH = 500, VERTICES = 64, MAX_SYSTEMS = 8 };

typedef struct trend {
    double n[MAX_SYSTEMS], entries[MAX_SYSTEMS], seconds[BENCH_SOLVE_VARIANTS][MAX_SYSTEMS];
    int count;
} trend;

/* Size in bytes of a workspace that has run these queries but no full solve. */
static size_t workspace_bytes(const bench_queries *q) {
    size_t bytes;
    bench_queries alone = *q;
    bench_must(sl_work_create(&alone.W, NULL), "workspace");
    for (int k = 0; k < q->count; k++) {
        bench_call_one_shot(&alone);
    }
    bytes = sl_work_bytes(alone.W);
    sl_work_free(alone.W);
    return bytes;
}

static void time_queries(bench_run *run, bench_report *report, bench_queries *q, const char *what,
                         trend *t) {
    double medians[BENCH_SOLVE_VARIANTS];
    sl_stats reach = bench_queries_reach(q);
    double entries = (double)reach.plan.b_entries + (double)reach.plan.x_entries;
    if (!bench_solve_variants_time(run, report, q, what, medians)) {
        return;
    }
    bench_report_note(
        report,
        "%-14s   per entry read: plan solve %.3f ns, one shot %.3f ns; columns %d + %d;"
        " workspace %.1f kB (a full-length vector: %.1f kB)",
        "", 1e9 * medians[BENCH_PLAN_SOLVE] / entries, 1e9 * medians[BENCH_ONE_SHOT] / entries,
        (int)reach.plan.b_columns, (int)reach.plan.x_columns, 1e-3 * (double)workspace_bytes(q),
        8e-3 * q->system->n);
    t->n[t->count] = q->system->n;
    t->entries[t->count] = entries;
    for (int c = 0; c < BENCH_SOLVE_VARIANTS; c++) {
        t->seconds[c][t->count] = medians[c];
    }
    t->count++;
}

static void plot_trend(const bench_run *run, bench_report *report, const trend *t, const char *what,
                       const char *file) {
    char title[96];
    snprintf(title, sizeof title, "Locality: %s", what);
    bench_plot *plot =
        bench_plot_open(run, file, title, "vertices of the mesh", "microseconds", "xy");
    for (int c = 0; c < BENCH_SOLVE_VARIANTS; c++) {
        for (int k = 0; k < t->count; k++) {
            bench_plot_point(plot, bench_solve_variants[c], "linespoints", t->n[k],
                             1e6 * t->seconds[c][k]);
        }
    }
    if (t->count > 1) {
        bench_report_note(
            report,
            "%s grows with n as: entries read n^%.2f, plan solve n^%.2f, plan create n^%.2f, one "
            "shot n^%.2f, full solve n^%.2f",
            what, bench_fit_exponent(t->n, t->entries, t->count),
            bench_fit_exponent(t->n, t->seconds[0], t->count),
            bench_fit_exponent(t->n, t->seconds[1], t->count),
            bench_fit_exponent(t->n, t->seconds[2], t->count),
            bench_fit_exponent(t->n, t->seconds[3], t->count));
    }
    bench_plot_close(plot);
}

void bench_locality(bench_run *run) {
    static const double wanted[] = {1e4, 5e4, 1e5, 2e5, 5e5, 1e6, 4e6};
    static trend patch, vertex;
    const bench_system *systems[MAX_SYSTEMS];
    int count = bench_systems(run, wanted, 7, systems);
    bench_report *report = bench_report_open(
        run, "locality", "the same local solve on meshes of growing size", "plan solve");
    patch.count = vertex.count = 0;
    for (int k = 0; k < count; k++) {
        /* the middle of a square grid; its vertices are numbered ix + side iy */
        sl_int side = 1;
        while ((side + 1) * (double)(side + 1) <= systems[k]->n) {
            side++;
        }
        bench_patch p = bench_patch_create(systems[k], side / 2 + side * (side / 2) - 1, PATCH);
        bench_queries *q = bench_queries_create(systems[k], 1, 1);
        bench_queries_add(q, p.vertices, 1, p.vertices, p.size);
        time_queries(run, report, q, "patch 500", &patch);
        bench_queries_free(q);
        bench_patch_free(&p);
        q = bench_queries_vertices(systems[k], VERTICES, 1);
        time_queries(run, report, q, "vertex", &vertex);
        bench_queries_free(q);
    }
    printf("\n");
    plot_trend(run, report, &patch, "a patch of 500 around its center", "locality_patch");
    plot_trend(run, report, &vertex, "b and x at one vertex", "locality_vertex");
    bench_report_close(report);
}

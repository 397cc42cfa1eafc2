/* locality.c: does the cost of a plan and of a solve per entry of L grow with the mesh? */
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

/* ---- long chains ---- */

/* Matrices whose elimination tree in natural order is one chain. In the ring and in the wheel (a
 * ring plus its hub as the last row) every supernode also has a row at the far end of the chain. A
 * plan that climbed to the far row from each of them would take a thousand times as long on these
 * matrices, and more as n grows. */
enum { PATH, RING, WHEEL, N_CHAINS, CHAIN_LENGTH = 150000 };

static const char *const chain_names[N_CHAINS] = {"chain: path", "chain: ring", "chain: wheel"};

typedef struct chain {
    sl_symbolic *S;
    sl_stats stats;
} chain;

static chain chain_make(int kind) {
    const sl_int n = CHAIN_LENGTH;
    const sl_int rim = kind == WHEEL ? n - 1 : n; /* rows of the path or of the ring */
    sl_int *i = (sl_int *)bench_alloc(3 * (size_t)n, sizeof *i);
    sl_int *j = (sl_int *)bench_alloc(3 * (size_t)n, sizeof *j);
    sl_off count = 0;
    for (sl_int k = 0; k < n; k++) {
        i[count] = j[count] = k;
        count++;
        if (k + 1 < rim) {
            i[count] = k + 1;
            j[count++] = k;
        }
        if (kind == WHEEL && k < rim) {
            i[count] = rim;
            j[count++] = k;
        }
    }
    if (kind != PATH) {
        i[count] = rim - 1;
        j[count++] = 0;
    }
    sl_matrix *M = NULL;
    bench_must(sl_matrix_from_triplets(&M, n, n, count, i, j, NULL, NULL, NULL), "chain");
    const sl_csc A = sl_matrix_view(M);
    const sl_options natural = {.ordering = SL_ORDERING_NATURAL};
    chain c = {0};
    bench_must(sl_symbolic_create(&c.S, &A, &natural, &c.stats), "analysis of a chain");
    sl_matrix_free(M);
    free(j);
    free(i);
    return c;
}

/* A plan from the leaf of the chain: its reach is the whole chain. */
static void call_plan_from_leaf(void *state) {
    chain *c = (chain *)state;
    const sl_int leaf = 0;
    sl_plan *P = NULL;
    bench_must(sl_plan_create(&P, c->S, &leaf, 1, &leaf, 1, NULL, &c->stats), "plan of a chain");
    sl_plan_free(P);
}

/* The baseline of the ratios is the path. */
static void time_chains(bench_run *run, bench_report *report) {
    chain chains[N_CHAINS];
    bench_contender contenders[N_CHAINS];
    bench_sample samples[N_CHAINS];
    for (int kind = 0; kind < N_CHAINS; kind++) {
        chains[kind] = chain_make(kind);
        contenders[kind] = (bench_contender){call_plan_from_leaf, &chains[kind], 1, NULL};
        call_plan_from_leaf(&chains[kind]);
        bench_expect(run, chains[kind].stats.plan.b_columns == CHAIN_LENGTH,
                     "%s: the plan visits %d columns", chain_names[kind],
                     (int)chains[kind].stats.plan.b_columns);
    }
    bench_race(samples, contenders, N_CHAINS, run->seconds / 4);
    const bench_system system = {
        .name = "a chain in natural order", .n = CHAIN_LENGTH, .stats = chains[PATH].stats};
    for (int kind = 0; kind < N_CHAINS; kind++) {
        bench_row row = {.what = chain_names[kind],
                         .method = bench_solve_variants[BENCH_PLAN_CREATE],
                         .nrhs = 1,
                         .time = samples[kind],
                         .baseline = samples[PATH].median};
        row.reach = chains[kind].stats;
        bench_report_row(report, &system, &row);
        sl_symbolic_free(chains[kind].S);
    }
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
    time_chains(run, report);
    printf("\n");
    plot_trend(run, report, &patch, "a patch of 500 around its center", "locality_patch");
    plot_trend(run, report, &vertex, "b and x at one vertex", "locality_vertex");
    bench_report_close(report);
}

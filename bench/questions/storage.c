/* storage.c: what does L in float save in time and memory, and what does it cost in accuracy? */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "bench/lib/bench.h"

/* Two factors of each system: in double, and with L in float; the baseline is double. The accuracy
 * is that of k-harmonic systems for a known x: the componentwise backward error, and the largest
 * error relative to the largest x, after 0 to 3 steps of refinement. */
enum { QUERIES = 64, PATCHES = 16, PATCH = 1000, MAX_SYSTEMS = 4, STEPS = 3, ORDERS = 3 };
enum { TYPES = 2 };

static const char *const names[TYPES] = {"double", "float"};

/* The system with L in float in place of that in double. Release the factor. */
static bench_system in_float(const bench_system *system, sl_stats *stats) {
    bench_system copy = *system;
    sl_options options;
    memset(&options, 0, sizeof options);
    options.storage = SL_STORAGE_FLOAT;
    copy.F = NULL;
    bench_must(sl_factor_create(&copy.F, system->S, &system->A, &options, stats), "factor");
    return copy;
}

static void call_refactor(void *state) {
    const bench_system *system = state;
    bench_must(sl_factor_refactor(system->F, &system->A, NULL), "refactor");
}

static void race(bench_run *run, bench_report *report, const bench_system *system,
                 bench_contender *contenders, int count, bench_row row) {
    bench_sample times[TYPES];
    bench_race(times, contenders, count, run->seconds);
    for (int k = 0; k < count; k++) {
        row.method = names[k];
        row.time = times[k];
        row.baseline = times[0].median;
        bench_report_row(report, system, &row);
    }
}

/* Checks the local solves of both types, then times them. */
static void race_queries(bench_run *run, bench_report *report, bench_queries *const *q,
                         const char *what) {
    bench_contender contenders[2];
    bench_row row = {.what = what, .nrhs = q[0]->nrhs};
    const sl_stats reach = bench_queries_reach(q[0]);
    const bench_query *first = &q[1]->all[0];
    int passed = 1;
    passed &= bench_queries_check(run, q[0], 2);
    bench_call_full(q[1]);
    q[1]->next = 0;
    bench_call_plan_solve(q[1]);
    passed &= bench_check_bits(run, q[1]->system, first->X, first->xset, first->nx, q[1]->X_full,
                               q[1]->nrhs, "float");
    for (int k = 0; k < 2; k++) {
        contenders[k] = (bench_contender){bench_call_plan_solve, q[k], q[k]->count, NULL};
    }
    if (passed) {
        bench_row_reach(&row, &reach);
        race(run, report, q[0]->system, contenders, 2, row);
    }
}

static void time_vertices(bench_run *run, bench_report *report, const bench_system *systems) {
    bench_queries *const q[2] = {bench_queries_vertices(&systems[0], QUERIES, 1),
                                 bench_queries_vertices(&systems[1], QUERIES, 1)};
    race_queries(run, report, q, "vertex");
    bench_queries_free(q[0]);
    bench_queries_free(q[1]);
}

static void time_patches(bench_run *run, bench_report *report, const bench_system *systems) {
    bench_patch patches[PATCHES];
    bench_queries *const q[2] = {bench_queries_create(&systems[0], PATCHES, 1),
                                 bench_queries_create(&systems[1], PATCHES, 1)};
    const int found = bench_patch_pick(patches, PATCHES, &systems[0], PATCH);
    for (int k = 0; k < found; k++) {
        for (int s = 0; s < 2; s++) {
            bench_queries_add(q[s], patches[k].vertices, PATCH, patches[k].vertices, PATCH);
        }
        bench_patch_free(&patches[k]);
    }
    if (found > 0) {
        race_queries(run, report, q, "patch 1000");
    }
    bench_queries_free(q[0]);
    bench_queries_free(q[1]);
}

static void time_full(bench_run *run, bench_report *report, bench_system *systems) {
    bench_contender contenders[TYPES];
    for (sl_int nrhs = 1; nrhs <= 8; nrhs *= 8) {
        bench_queries *q[2];
        bench_row row = {.what = "full solve", .nrhs = nrhs};
        for (int k = 0; k < 2; k++) {
            q[k] = bench_queries_vertices(&systems[k], 1, nrhs);
            contenders[k] = (bench_contender){bench_call_full, q[k], 1, NULL};
        }
        bench_row_full(&row, &systems[0]);
        race(run, report, &systems[0], contenders, 2, row);
        bench_queries_free(q[0]);
        bench_queries_free(q[1]);
    }
    bench_row row = {.what = "refactor", .flops = systems[0].stats.symbolic.flops};
    for (int k = 0; k < TYPES; k++) {
        contenders[k] = (bench_contender){call_refactor, &systems[k], 1, NULL};
    }
    race(run, report, &systems[0], contenders, TYPES, row);
}

static void time_system(bench_run *run, bench_report *report, const bench_system *system) {
    sl_stats full, single;
    bench_system systems[TYPES] = {*system, in_float(system, &single)};
    full.factor = sl_factor_view(system->F).info;
    time_vertices(run, report, systems);
    time_patches(run, report, systems);
    time_full(run, report, systems);
    const double entries = (double)system->stats.symbolic.nnz_panels;
    bench_report_note(report,
                      "%-14s   L: %.1f MB, in float %.1f MB; whole factor: %.1f, %.1f MB", "",
                      8e-6 * entries, 4e-6 * entries, 1e-6 * (double)full.factor.bytes,
                      1e-6 * (double)single.factor.bytes);
    sl_factor_free(systems[1].F);
}

static double largest_error(const double *x, const double *exact, size_t n) {
    double error = 0, size = 0;
    for (size_t i = 0; i < n; i++) {
        error = fmax(error, fabs(x[i] - exact[i]));
        size = fmax(size, fabs(exact[i]));
    }
    return error / size;
}

/* Prints the errors of one factor after 0 .. STEPS refinements, and returns the last backward
 * error. */
static double note_errors(bench_report *report, const bench_system *system, const char *name,
                          const double *exact, const double *b, double *x) {
    const size_t n = (size_t)system->n;
    char text[STEPS + 1][40];
    sl_stats stats;
    memset(&stats, 0, sizeof stats);
    bench_must(sl_factor_solve(system->F, x, n, b, n, 1, NULL), "full solve");
    for (int steps = 0; steps <= STEPS; steps++) {
        const sl_status status =
            sl_factor_refine(system->F, &system->A, x, n, b, n, 1, steps > 0, NULL, &stats);
        bench_must(status == SL_ERR_INACCURATE ? SL_OK : status, "refinement");
        snprintf(text[steps], sizeof text[0], "%.0e %.0e", stats.refine.backward_error,
                 largest_error(x, exact, n));
    }
    bench_report_note(report, "%-14s   %-12s  %s; %s; %s; %s", system->name, name, text[0], text[1],
                      text[2], text[3]);
    return stats.refine.backward_error;
}

static void accuracy(bench_run *run, bench_report *report, const bench_system *system) {
    const size_t n = (size_t)system->n;
    const bench_system single = in_float(system, NULL);
    double *exact = bench_alloc(n, sizeof *exact), *b = bench_alloc(n, sizeof *b);
    double *x = bench_alloc(n, sizeof *x), rcond;
    uint64_t rng = 5;
    bench_random_fill(&rng, exact, n);
    bench_must(sl_csc_multiply(&system->A, SL_AS_SYMMETRIC, b, n, exact, n, 1), "product");
    bench_must(sl_factor_rcond(system->F, &system->A, &rcond, NULL), "condition");
    bench_report_note(report, "%-14s   condition %.0e", system->name, 1 / rcond);
    (void)note_errors(report, system, names[0], exact, b, x);
    const double error = note_errors(report, &single, names[1], exact, b, x);
    bench_expect(run, error <= 1e-10 || rcond < 1e-12, "%s: refined backward error %.1e",
                 system->name, error);
    sl_factor_free(single.F);
    free(exact);
    free(b);
    free(x);
}

void bench_storage(bench_run *run) {
    static const double wanted[] = {1e4, 1e5, 1e6};
    const bench_system *systems[MAX_SYSTEMS];
    const int count = bench_systems(run, wanted, 3, systems);
    bench_report *report =
        bench_report_open(run, "storage", "L in float against L in double", "double");
    for (int k = 0; k < count; k++) {
        time_system(run, report, systems[k]);
    }
    bench_report_note(report, "backward and forward error after 0; 1; 2; 3 steps of refinement:");
    for (int c = 0; c < count; c++) {
        for (int k = 1; k <= ORDERS; k++) {
            const int is_small = k == 1 || wanted[c] <= 1e5 || run->size == BENCH_FULL;
            const bench_system *system = is_small ? bench_k_harmonic(run, wanted[c], k) : NULL;
            if (system != NULL) {
                accuracy(run, report, system);
            }
        }
    }
    bench_report_close(report);
}

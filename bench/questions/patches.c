/* patches.c: how fast are local solves on a patch, against the alternatives? */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "bench/lib/bench.h"

#include "tools/matrix/cg.h"

/* The parameterization of [HDA17] section 4, Figures 4 and 5: b is nonzero on the boundary of a
 * patch, x is wanted on the whole patch, with two right-hand sides. The local solve uses the
 * factor of the whole mesh. The alternatives never see the whole mesh: they solve with A(patch,
 * patch), zero outside the patch, for the same b. The time to extract that matrix is not
 * counted. */
enum { NRHS = 2, MAX_SEEDS = 5, CG_LIMIT = 100000 };

static const double cg_tolerance = 1e-8;

typedef struct alternative {
    const bench_patch *patches;
    int count, next;
    double *b, *x, *work; /* b, x: size x NRHS */
    long iterations, solves;
} alternative;

static const bench_patch *next_patch(alternative *r, const bench_queries *q) {
    const bench_patch *patch = &r->patches[r->next];
    const bench_query *one = &q->all[r->next];
    size_t size = (size_t)patch->size;
    for (size_t k = 0; k < size * NRHS; k++) {
        r->b[k] = 0;
    }
    for (size_t c = 0; c < NRHS; c++) {
        for (sl_int k = 0; k < patch->n_boundary; k++) {
            r->b[c * size + (size_t)patch->boundary_index[k]] =
                one->B[c * (size_t)one->nb + (size_t)k];
        }
    }
    r->next = (r->next + 1) % r->count;
    return patch;
}

typedef struct alternative_call {
    alternative *alternative;
    const bench_queries *queries;
} alternative_call;

static void call_refactorize(void *state) {
    alternative_call *call = state;
    const bench_patch *patch = next_patch(call->alternative, call->queries);
    size_t size = (size_t)patch->size;
    sl_symbolic *S;
    sl_factor *F;
    bench_must(sl_symbolic_create(&S, &patch->A, NULL, NULL), "analysis of a patch");
    bench_must(sl_factor_create(&F, S, &patch->A, NULL, NULL), "factor of a patch");
    bench_must(
        sl_factor_solve(F, call->alternative->x, size, call->alternative->b, size, NRHS, NULL),
        "solve of a patch");
    sl_factor_free(F);
    sl_symbolic_free(S);
}

static void call_cg(void *state) {
    alternative_call *call = state;
    alternative *r = call->alternative;
    const bench_patch *patch = next_patch(r, call->queries);
    for (int c = 0; c < NRHS; c++) {
        size_t at = (size_t)c * (size_t)patch->size;
        r->iterations +=
            cg_jacobi(&patch->A, r->x + at, r->b + at, cg_tolerance, CG_LIMIT, r->work);
        r->solves++;
    }
}

/* Solves on the next patch and checks ||b - A x|| <= tolerance ||b||. */
static void check_alternative(bench_run *run, alternative_call *call, void (*solve)(void *),
                              double tolerance, const char *method) {
    const bench_patch *patch = &call->alternative->patches[call->alternative->next];
    size_t size = (size_t)patch->size;
    double *R = bench_alloc(size * NRHS, sizeof *R);
    solve(call);
    bench_must(sl_csc_residual(&patch->A, R, size, NULL, call->alternative->x, size,
                               call->alternative->b, size, NRHS),
               "residual");
    for (size_t c = 0; c < NRHS; c++) {
        double r2 = 0, b2 = 0;
        for (size_t k = c * size; k < (c + 1) * size; k++) {
            r2 += R[k] * R[k];
            b2 += call->alternative->b[k] * call->alternative->b[k];
        }
        bench_expect(run, sqrt(r2) <= tolerance * sqrt(b2), "%s: relative residual %.2g", method,
                     sqrt(r2 / b2));
    }
    free(R);
}

typedef struct plots {
    bench_plot *by_mesh, *by_patch;
    double largest_n;
} plots;

static void plot_point(plots *p, const bench_system *system, sl_int size, const char *method,
                       double seconds, int dash) {
    if (dash > 0) { /* one color for each size */
        char name[48], style[40];
        snprintf(name, sizeof name, "%s, %d", method, (int)size);
        snprintf(style, sizeof style, "linespoints lc %d dt %d",
                 size <= 2000 ? 1 : 2 + (int)(size / 20000), dash);
        bench_plot_point(p->by_mesh, name, style, system->n, 1e3 * seconds);
    }
    if (system->n == p->largest_n) {
        bench_plot_point(p->by_patch, method, "linespoints", size, 1e3 * seconds);
    }
}

static void time_alternatives(bench_run *run, bench_report *report, plots *p,
                              const bench_queries *q, const bench_patch *patches, bench_row *row) {
    sl_int size = patches[0].size;
    alternative r = {patches, q->count, 0, NULL, NULL, NULL, 0, 0};
    alternative_call call = {&r, q};
    bench_contender contenders[2] = {{call_refactorize, &call, 1, NULL}, {call_cg, &call, 1, NULL}};
    r.b = bench_alloc((size_t)size * NRHS, sizeof *r.b);
    r.x = bench_alloc((size_t)size * NRHS, sizeof *r.x);
    r.work = bench_alloc((size_t)size * 4, sizeof *r.work);
    check_alternative(run, &call, call_refactorize, 1e-10, "refactorize the patch");
    check_alternative(run, &call, call_cg, 10 * cg_tolerance, "conjugate gradients");
    bench_race(&row->time, &contenders[0], 1, run->seconds / 2);
    row->method = "refactorize the patch";
    bench_report_row(report, q->system, row);
    plot_point(p, q->system, size, "refactorize", row->time.median, 2);
    r.iterations = r.solves = 0;
    bench_race(&row->time, &contenders[1], 1, run->seconds / 2);
    row->method = "conjugate gradients";
    bench_report_row(report, q->system, row);
    plot_point(p, q->system, size, "conjugate gradients", row->time.median, 0);
    bench_report_note(report,
                      "%-14s   %.0f iterations per right-hand side, to a relative residual of %.0e",
                      "", (double)r.iterations / (double)r.solves, cg_tolerance);
    free(r.work);
    free(r.x);
    free(r.b);
}

static void one_size(bench_run *run, bench_report *report, plots *p, const bench_system *system,
                     sl_int size) {
    bench_patch patches[MAX_SEEDS];
    int count = bench_patch_pick(patches, run->size == BENCH_QUICK ? 2 : MAX_SEEDS, system, size);
    bench_queries *q = bench_queries_create(system, MAX_SEEDS, NRHS);
    for (int k = 0; k < count; k++) {
        bench_queries_add(q, patches[k].boundary, patches[k].n_boundary, patches[k].vertices,
                          patches[k].size);
    }
    double medians[BENCH_SOLVE_VARIANTS];
    char what[32];
    snprintf(what, sizeof what, "patch %d", (int)size);
    if (count > 0 && bench_solve_variants_time(run, report, q, what, medians)) {
        bench_row row = {.what = what, .nrhs = NRHS, .baseline = medians[BENCH_PLAN_SOLVE]};
        for (int c = 0; c < BENCH_SOLVE_VARIANTS; c++) {
            if (c != BENCH_PLAN_CREATE) {
                plot_point(p, system, size, bench_solve_variants[c], medians[c],
                           c == BENCH_PLAN_SOLVE);
            }
        }
        time_alternatives(run, report, p, q, patches, &row);
    }
    bench_queries_free(q);
    for (int k = 0; k < count; k++) {
        bench_patch_free(&patches[k]);
    }
}

void bench_patches(bench_run *run) {
    static const double wanted[] = {1e4, 5e4, 2e5, 5e5, 1e6, 4e6};
    static const sl_int sizes[] = {2000, 10000, 30000, 50000};
    const bench_system *systems[6];
    int first = run->size == BENCH_QUICK ? 0 : 1; /* the smallest grid is used in quick runs only */
    int count = bench_systems(run, wanted + first, 6 - first, systems);
    bench_report *report = bench_report_open(
        run, "patches",
        "local solves on a patch, b on its boundary, x on the whole patch ([HDA17] Figures 4, 5)",
        "plan solve");
    plots p = {NULL, NULL, 0};
    p.by_mesh =
        bench_plot_open(run, "patches_by_mesh", "Solving on a patch: time against mesh size",
                        "vertices of the mesh", "milliseconds, 2 right-hand sides", "xy");
    p.by_patch = bench_plot_open(run, "patches_by_patch", "Solving on a patch of the largest mesh",
                                 "vertices of the patch", "milliseconds, 2 right-hand sides", "xy");
    p.largest_n = count > 0 ? systems[count - 1]->n : 0;
    for (int k = 0; k < count; k++) {
        for (size_t s = 0; s < sizeof sizes / sizeof *sizes; s++) {
            if (2 * sizes[s] <= systems[k]->n && (run->size != BENCH_QUICK || sizes[s] <= 10000)) {
                one_size(run, report, &p, systems[k], sizes[s]);
            }
        }
    }
    bench_plot_close(p.by_mesh);
    bench_plot_close(p.by_patch);
    bench_report_close(report);
}

/* neumann.c: what do zero-mean solutions of singular Laplacians cost? */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "bench/lib/bench.h"

/* The row sums of a system A = M + t L are M, so A - M is the singular Laplacian t L. Shifted it
 * is t L + 1e-8 M, which is definite. Sources and sinks are pairs of vertices of patches; x is
 * wanted on the patch. There are four factors: shifted, the baseline; with zero mean weighted by
 * M; and t L with x = 0 in the null row, with and without the check of b for consistency. Their
 * L have the same pattern, so plans and entries read are the same. Refinement is one step on the
 * shifted factor: a residual, a solve, and another residual. */
enum { PATCHES = 16, PATCH = 1000, MAX_SYSTEMS = 4, VARIANTS = 4 };

#define SHIFT 1e-8

static const char *const names[VARIANTS] = {"shifted", "zero mean", "null row 0, checked",
                                            "null row 0, not checked"};

typedef struct variant {
    const bench_system *system;
    sl_csc matrix; /* on the pattern of A */
    sl_factor *F;
    sl_work *W;
    bench_patch *patches;
    sl_plan **plans;
    double *b, *x, *x_patch; /* n, n, PATCH */
    int next;
} variant;

static void call_refactor(void *state) {
    variant *w = state;
    bench_must(sl_factor_refactor(w->F, &w->matrix, NULL), "refactor");
}

static void call_full(void *state) {
    variant *w = state;
    const size_t n = (size_t)w->system->n;
    bench_must(sl_factor_solve(w->F, w->x, n, w->b, n, 1, w->W), "full solve");
}

static void start_from_0(void *state) {
    variant *w = state;
    memset(w->x, 0, (size_t)w->system->n * sizeof *w->x);
}

static void call_refine(void *state) {
    variant *w = state;
    const size_t n = (size_t)w->system->n;
    bench_must(sl_factor_refine(w->F, &w->matrix, w->x, n, w->b, n, 1, 1, w->W, NULL), "refine");
}

static void call_local(void *state) {
    static const double pair[2] = {1, -1};
    variant *w = state;
    const size_t nx = (size_t)w->patches[w->next].size;
    bench_must(sl_plan_solve(w->plans[w->next], w->F, w->x_patch, nx, pair, 2, 1, w->W), "plan");
    w->next = (w->next + 1) % PATCHES;
}

/* Values of A - M, whose rows sum to 0, plus shift M. mass receives the row sums of A. */
static double *laplacian_values(const bench_system *system, double shift, double *mass) {
    const sl_csc *A = &system->A;
    const size_t n = (size_t)A->n_cols;
    double *x = bench_alloc((size_t)A->p[n], sizeof *x), *sums = bench_alloc(n, sizeof *sums);
    memcpy(x, A->x, (size_t)A->p[n] * sizeof *x);
    memset(mass, 0, n * sizeof *mass);
    memset(sums, 0, n * sizeof *sums);
    for (sl_int j = 0; j < A->n_cols; j++) {
        for (sl_int p = A->p[j]; p < A->p[j + 1]; p++) {
            const sl_int i = A->i[p];
            mass[i] += x[p];
            if (i != j) {
                mass[j] += x[p];
                sums[i] -= x[p];
                sums[j] -= x[p];
            }
        }
    }
    for (sl_int j = 0; j < A->n_cols; j++) {
        for (sl_int p = A->p[j]; p < A->p[j + 1]; p++) {
            x[p] = A->i[p] == j ? sums[j] + shift * mass[j] : x[p];
        }
    }
    free(sums);
    return x;
}

/* Checks residual and mean of the zero-mean solution, and that its local solve equals the full
 * one bit for bit. Returns the error of the shifted solution relative to the largest entry, or
 * -1 if a check failed. */
static double check(bench_run *run, variant *variants, const double *mass, int patch) {
    const bench_system *system = variants[1].system;
    const size_t n = (size_t)system->n;
    const bench_patch *p = &variants[1].patches[patch];
    double *r = bench_alloc(n, sizeof *r), eta, mean = 0, largest = 0, total = 0, off = 0;
    int passed = 1;
    for (int k = 0; k < VARIANTS; k++) {
        memset(variants[k].b, 0, n * sizeof *variants[k].b);
        variants[k].b[p->vertices[0]] = 1;
        variants[k].b[p->vertices[p->size - 1]] = -1;
        call_full(&variants[k]);
    }
    const double *x = variants[1].x;
    bench_must(sl_csc_residual(&variants[1].matrix, r, n, &eta, x, n, variants[1].b, n, 1),
               "residual");
    for (size_t i = 0; i < n; i++) {
        mean += mass[i] * x[i];
        total += mass[i];
        largest = fmax(largest, fabs(x[i]));
        off = fmax(off, fabs(x[i] - variants[0].x[i]));
    }
    passed &=
        bench_expect(run, eta <= 1e-13, "%s: zero mean: backward error %.1e", system->name, eta);
    passed &= bench_expect(run, fabs(mean) <= 1e-13 * total * largest,
                           "%s: zero mean: mean %.1e of %.1e", system->name, mean / total, largest);
    variants[1].next = patch;
    call_local(&variants[1]);
    passed &=
        bench_check_bits(run, system, variants[1].x_patch, p->vertices, p->size, x, 1, "zero mean");
    double difference = 0; /* the solution with x = 0 in the null row differs by a constant */
    for (size_t i = 0; i < n; i++) {
        difference = fmax(difference, fabs(variants[2].x[i] - variants[2].x[0] - (x[i] - x[0])));
    }
    passed &= bench_expect(run, difference <= 1e-9 * largest,
                           "%s: solutions differ by %.1e of %.1e beyond a constant", system->name,
                           difference, largest);
    free(r);
    return passed ? off / largest : -1;
}

static void variant_create(variant *w, const bench_system *system, int k, const double *values,
                           const double *mass, bench_patch *patches, sl_plan **plans) {
    sl_options options;
    memset(&options, 0, sizeof options);
    options.pivots = k > 0 ? SL_PIVOTS_SKIP_NULL : SL_PIVOTS_NONZERO;
    options.mass = k == 1 ? mass : NULL;
    options.consistency_tolerance = k == 3 ? -1 : 0;
    memset(w, 0, sizeof *w);
    w->system = system;
    w->matrix = system->A;
    w->matrix.x = values;
    w->patches = patches;
    w->plans = plans;
    w->b = bench_alloc((size_t)system->n, sizeof *w->b);
    w->x = bench_alloc((size_t)system->n, sizeof *w->x);
    w->x_patch = bench_alloc(PATCH, sizeof *w->x_patch);
    bench_must(sl_factor_create(&w->F, system->S, &w->matrix, &options, NULL), names[k]);
    bench_must(sl_work_create(&w->W, NULL), "workspace");
}

static void report_variants(bench_report *report, const bench_system *system,
                            const bench_sample *times, const char *what, const sl_stats *reach) {
    for (int k = 0; k < VARIANTS; k++) {
        bench_row row = {.what = what, .method = names[k], .time = times[k]};
        row.baseline = times[0].median;
        if (strcmp(what, "refactor") == 0) {
            row.flops = system->stats.symbolic.flops;
        } else {
            row.nrhs = 1;
            if (reach) {
                bench_row_reach(&row, reach);
            } else {
                bench_row_full(&row, system);
            }
        }
        bench_report_row(report, system, &row);
    }
}

static void race(bench_run *run, bench_report *report, variant *variants) {
    const bench_system *system = variants[0].system;
    bench_contender contenders[VARIANTS];
    bench_sample times[VARIANTS], refine;
    sl_stats reach;
    memset(&reach, 0, sizeof reach);
    sl_plan_stats(variants[0].plans[0], &reach);
    void (*const calls[3])(void *) = {call_refactor, call_full, call_local};
    static const char *const what[3] = {"refactor", "full solve", "patch 1000"};
    for (int c = 0; c < 3; c++) {
        for (int k = 0; k < VARIANTS; k++) {
            variants[k].next = 0;
            contenders[k] = (bench_contender){calls[c], &variants[k], c == 2 ? PATCHES : 1, NULL};
        }
        bench_race(times, contenders, VARIANTS, run->seconds);
        report_variants(report, system, times, what[c], c == 2 ? &reach : NULL);
        if (c == 1) {
            bench_contender one = {call_refine, &variants[0], 1, start_from_0};
            bench_race(&refine, &one, 1, run->seconds / 4);
            bench_row row = {.what = "full solve",
                             .method = "one step of refinement",
                             .nrhs = 1,
                             .time = refine,
                             .baseline = times[0].median};
            bench_row_full(&row, system);
            bench_report_row(report, system, &row);
        }
    }
}

static void one_system(bench_run *run, bench_report *report, const bench_system *system) {
    const size_t n = (size_t)system->n;
    bench_patch patches[PATCHES];
    sl_plan *plans[PATCHES];
    double *mass = bench_alloc(n, sizeof *mass), worst = 0;
    double *shifted = laplacian_values(system, SHIFT, mass);
    double *singular = laplacian_values(system, 0, mass);
    variant variants[VARIANTS];
    const int found = bench_patch_pick(patches, PATCHES, system, PATCH);
    for (int k = 0; k < found; k++) {
        const sl_int pair[2] = {patches[k].vertices[0], patches[k].vertices[patches[k].size - 1]};
        bench_must(sl_plan_create(&plans[k], system->S, pair, 2, patches[k].vertices,
                                  patches[k].size, NULL, NULL),
                   "plan");
    }
    for (int k = 0; k < VARIANTS; k++) {
        variant_create(&variants[k], system, k, k > 0 ? singular : shifted, mass, patches, plans);
    }
    for (int k = 0; k < found && k < 3 && worst >= 0; k++) {
        const double off = check(run, variants, mass, k);
        worst = off < 0 ? off : fmax(off, worst);
    }
    if (found == PATCHES && worst >= 0) {
        race(run, report, variants);
        bench_report_note(report,
                          "%-14s   a shift of 1e-8 M changes x by %.1e of its largest entry; zero "
                          "mean is exact up to rounding",
                          "", worst);
    }
    for (int k = 0; k < VARIANTS; k++) {
        sl_factor_free(variants[k].F);
        sl_work_free(variants[k].W);
        free(variants[k].b);
        free(variants[k].x);
        free(variants[k].x_patch);
    }
    for (int k = 0; k < found; k++) {
        sl_plan_free(plans[k]);
        bench_patch_free(&patches[k]);
    }
    free(singular);
    free(shifted);
    free(mass);
}

void bench_neumann(bench_run *run) {
    static const double wanted[] = {1e4, 1e5, 1e6};
    const bench_system *systems[MAX_SYSTEMS];
    int count = bench_systems(run, wanted, 3, systems);
    bench_report *report = bench_report_open(
        run, "neumann", "zero-mean solutions of singular Laplacians against shifted ones",
        "shifted");
    for (int k = 0; k < count; k++) {
        one_system(run, report, systems[k]);
    }
    bench_report_close(report);
}

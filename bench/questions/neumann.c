/* neumann.c: what does a zero-mean solution of a raw Laplacian cost, beside a shifted one, and what does a shift spoil? */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "bench.h"

/* Of a system A = M + t L the row sums are M, and A - M is the raw Laplacian t L; shifted it is t L + 1e-8 M, which is
 * definite. Sources and sinks are pairs of vertices of patches, x is wanted on the patch. Four factors: shifted, the
 * baseline; centred by M; and t L with x = 0 in the null row, with b looked at and without. Their L have the same
 * pattern, so that plans and entries read are the same. Refinement is one step on the shifted factor: a product for the
 * residual before, one behind, and a solve. */
enum { PATCHES = 16, PATCH = 1000, MAX_SYSTEMS = 4, WAYS = 4 };

#define SHIFT 1e-8

static const char *const names[WAYS] = {"shifted", "centred", "null row 0, checked",
                                        "null row 0, not checked"};

typedef struct way {
    const bench_system *system;
    sl_csc matrix; /* A's pattern */
    sl_factor *F;
    sl_work *W;
    bench_patch *patches;
    sl_plan **plans;
    double *b, *x, *x_patch; /* n, n, PATCH */
    int next;
} way;

static void call_refactor(void *state) {
    way *w = state;
    bench_must(sl_factor_refactor(w->F, &w->matrix, NULL), "refactor");
}

static void call_full(void *state) {
    way *w = state;
    const size_t n = (size_t)w->system->n;
    bench_must(sl_factor_solve(w->F, w->x, n, w->b, n, 1, w->W), "full solve");
}

static void start_from_0(void *state) {
    way *w = state;
    memset(w->x, 0, (size_t)w->system->n * sizeof *w->x);
}

static void call_refine(void *state) {
    way *w = state;
    const size_t n = (size_t)w->system->n;
    bench_must(sl_factor_refine(w->F, &w->matrix, w->x, n, w->b, n, 1, 1, w->W, NULL), "refine");
}

static void call_local(void *state) {
    static const double pair[2] = {1, -1};
    way *w = state;
    const size_t nx = (size_t)w->patches[w->next].size;
    bench_must(sl_plan_solve(w->plans[w->next], w->F, w->x_patch, nx, pair, 2, 1, w->W), "plan");
    w->next = (w->next + 1) % PATCHES;
}

/* The diagonal of A - M, so that rows sum up to 0, plus shift M; mass: the row sums of A. */
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

/* Residual and mean of the centred solution; its local solve has the bits of the full one. Returns the error of the
 * shifted solution, relative to the largest entry, and -1 where a check failed. */
static double check(bench_run *run, way *ways, const double *mass, int patch) {
    const bench_system *system = ways[1].system;
    const size_t n = (size_t)system->n;
    const bench_patch *p = &ways[1].patches[patch];
    double *r = bench_alloc(n, sizeof *r), eta, mean = 0, most = 0, total = 0, off = 0;
    int good = 1;
    for (int k = 0; k < WAYS; k++) {
        memset(ways[k].b, 0, n * sizeof *ways[k].b);
        ways[k].b[p->vertices[0]] = 1;
        ways[k].b[p->vertices[p->size - 1]] = -1;
        call_full(&ways[k]);
    }
    const double *x = ways[1].x;
    bench_must(sl_csc_residual(&ways[1].matrix, r, n, &eta, x, n, ways[1].b, n, 1), "residual");
    for (size_t i = 0; i < n; i++) {
        mean += mass[i] * x[i];
        total += mass[i];
        most = fmax(most, fabs(x[i]));
        off = fmax(off, fabs(x[i] - ways[0].x[i]));
    }
    good &= bench_expect(run, eta <= 1e-13, "%s: centred: backward error %.1e", system->name, eta);
    good &= bench_expect(run, fabs(mean) <= 1e-13 * total * most, "%s: centred: mean %.1e of %.1e",
                         system->name, mean / total, most);
    ways[1].next = patch;
    call_local(&ways[1]);
    good &= bench_check_bits(run, system, ways[1].x_patch, p->vertices, p->size, x, 1, "centred");
    double apart = 0; /* x with 0 in the null row differs by a constant */
    for (size_t i = 0; i < n; i++) {
        apart = fmax(apart, fabs(ways[2].x[i] - ways[2].x[0] - (x[i] - x[0])));
    }
    good &= bench_expect(run, apart <= 1e-9 * most, "%s: differences apart by %.1e of %.1e",
                         system->name, apart, most);
    free(r);
    return good ? off / most : -1;
}

static void make(way *w, const bench_system *system, int k, const double *values,
                 const double *mass, bench_patch *patches, sl_plan **plans) {
    sl_options options;
    memset(&options, 0, sizeof options);
    options.definiteness = k > 0 ? SL_SEMIDEFINITE : SL_DEFINITE;
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

static void report_ways(bench_report *report, const bench_system *system, const bench_sample *times,
                        const char *what, const sl_stats *reach) {
    for (int k = 0; k < WAYS; k++) {
        bench_row row = {.what = what, .method = names[k], .time = times[k]};
        row.baseline = times[0].median;
        if (strcmp(what, "refactor") == 0) {
            row.flops = system->stats.flops;
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

static void race(bench_run *run, bench_report *report, way *ways) {
    const bench_system *system = ways[0].system;
    bench_contender contenders[WAYS];
    bench_sample times[WAYS], refine;
    sl_stats reach;
    memset(&reach, 0, sizeof reach);
    sl_plan_stats(ways[0].plans[0], &reach);
    void (*const calls[3])(void *) = {call_refactor, call_full, call_local};
    static const char *const what[3] = {"refactor", "full solve", "patch 1000"};
    for (int c = 0; c < 3; c++) {
        for (int k = 0; k < WAYS; k++) {
            ways[k].next = 0;
            contenders[k] = (bench_contender){calls[c], &ways[k], c == 2 ? PATCHES : 1, NULL};
        }
        bench_race(times, contenders, WAYS, run->seconds);
        report_ways(report, system, times, what[c], c == 2 ? &reach : NULL);
        if (c == 1) {
            bench_contender one = {call_refine, &ways[0], 1, start_from_0};
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
    double *raw = laplacian_values(system, 0, mass);
    way ways[WAYS];
    const int found = bench_patch_pick(patches, PATCHES, system, PATCH);
    for (int k = 0; k < found; k++) {
        const sl_int pair[2] = {patches[k].vertices[0], patches[k].vertices[patches[k].size - 1]};
        bench_must(sl_plan_create(&plans[k], system->S, pair, 2, patches[k].vertices,
                                  patches[k].size, NULL, NULL),
                   "plan");
    }
    for (int k = 0; k < WAYS; k++) {
        make(&ways[k], system, k, k > 0 ? raw : shifted, mass, patches, plans);
    }
    for (int k = 0; k < found && k < 3 && worst >= 0; k++) {
        const double off = check(run, ways, mass, k);
        worst = off < 0 ? off : fmax(off, worst);
    }
    if (found == PATCHES && worst >= 0) {
        race(run, report, ways);
        bench_report_note(report,
                          "%-14s   a shift of 1e-8 M puts x off by %.1e of its largest entry, "
                          "centring by rounding",
                          "", worst);
    }
    for (int k = 0; k < WAYS; k++) {
        sl_factor_free(ways[k].F);
        sl_work_free(ways[k].W);
        free(ways[k].b);
        free(ways[k].x);
        free(ways[k].x_patch);
    }
    for (int k = 0; k < found; k++) {
        sl_plan_free(plans[k]);
        bench_patch_free(&patches[k]);
    }
    free(raw);
    free(shifted);
    free(mass);
}

void bench_neumann(bench_run *run) {
    static const double wanted[] = {1e4, 1e5, 1e6};
    const bench_system *systems[MAX_SYSTEMS];
    int count = bench_systems(run, wanted, 3, systems);
    bench_report *report = bench_report_open(
        run, "neumann", "zero-mean solutions of raw Laplacians beside shifted ones", "shifted");
    for (int k = 0; k < count; k++) {
        one_system(run, report, systems[k]);
    }
    bench_report_close(report);
}

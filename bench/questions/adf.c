/* adf.c: what does auto-diffusion cost at every vertex? */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "bench/lib/bench.h"

/* The auto-diffusion function at t is the diagonal of (M + t L)^-1. [HDA17] section 5 reports 11
 * s for a mesh of 53 thousand vertices, by one local solve per vertex; full solves take 225 s,
 * and 300 eigenvectors, another way to compute the function, 39 s. Here the mesh is a torus of
 * the same size, and with SL_DATA also meshes/kitten.obj.gz, of 53123 vertices; t is as in all
 * questions, the square of a tenth of the diameter. A new t needs a refactorization and the
 * diagonal; the rows show both together and each alone. What takes long is timed on a sample and
 * scaled to n vertices; the names of those rows say so. */
enum { SAMPLE = 64, NEAR = 256, CHECKED = 5, VARIANTS = 6, MAX_SYSTEMS = 3 };

typedef struct adf {
    const bench_system *system;
    sl_factor *F, *threaded;
    sl_selected *Z;
    sl_work *W;
    double *out;    /* n */
    sl_int *nearby; /* NEAR */
    double *b;      /* n: one unit vector at a time */
    int next;
    sl_stats stats;
} adf;

static void call_refactor(void *state) {
    adf *a = state;
    bench_must(sl_factor_refactor(a->F, &a->system->A, NULL), "refactor");
}

static void call_diagonal(void *state) {
    adf *a = state;
    bench_must(sl_inverse_diagonal(a->F, a->out, NULL, SL_ALL, a->W, &a->stats), "diagonal");
}

static void call_both(void *state) {
    call_refactor(state);
    call_diagonal(state);
}

static void call_threaded(void *state) {
    adf *a = state;
    bench_must(sl_factor_refactor(a->threaded, &a->system->A, NULL), "refactor");
    bench_must(sl_inverse_diagonal(a->threaded, a->out, NULL, SL_ALL, a->W, &a->stats), "diagonal");
}

static void call_threaded_diagonal(void *state) {
    adf *a = state;
    bench_must(sl_inverse_diagonal(a->threaded, a->out, NULL, SL_ALL, a->W, &a->stats), "diagonal");
}

static void call_selected_refactor(void *state) {
    adf *a = state;
    bench_must(sl_selected_refactor(a->Z, a->F, a->W), "selected refactor");
    bench_must(sl_selected_entries(a->Z, a->out, NULL, NULL, SL_ALL, NULL), "diagonal");
}

/* A set of NEAR nearby vertices, by forward sweeps that they share; for a set this small the
 * library chooses that method. */
static void call_near(void *state) {
    adf *a = state;
    bench_must(sl_inverse_diagonal(a->F, a->out, a->nearby, NEAR, a->W, &a->stats), "diagonal");
}

static void call_full(void *state) {
    adf *a = state;
    const size_t n = (size_t)a->system->n;
    const sl_int row = (sl_int)((unsigned)a->next++ * 7919u % (unsigned)n);
    a->b[row] = 1;
    bench_must(sl_factor_solve(a->F, a->out, n, a->b, n, 1, a->W), "full solve");
    a->b[row] = 0;
}

static adf adf_create(const bench_system *system) {
    adf a;
    sl_options options;
    bench_patch patch = bench_patch_create(system, system->n / 3, NEAR);
    memset(&a, 0, sizeof a);
    memset(&options, 0, sizeof options);
    a.system = system;
    bench_must(sl_factor_create(&a.F, system->S, &system->A, NULL, NULL), "factor");
    options.threads = bench_threads(2);
    bench_must(sl_factor_create(&a.threaded, system->S, &system->A, &options, NULL), "factor");
    bench_must(sl_selected_create(&a.Z, a.F, NULL, SL_ALL, NULL, NULL), "selected inverse");
    bench_must(sl_work_create(&a.W, NULL), "workspace");
    a.out = bench_alloc((size_t)system->n, sizeof *a.out);
    a.b = bench_alloc((size_t)system->n, sizeof *a.b);
    memset(a.b, 0, (size_t)system->n * sizeof *a.b);
    a.nearby = bench_alloc(NEAR, sizeof *a.nearby);
    for (int k = 0; k < NEAR; k++) { /* the connected component may be smaller */
        a.nearby[k] = patch.vertices[k % patch.size];
    }
    bench_patch_free(&patch);
    return a;
}

static void adf_free(adf *a) {
    sl_factor_free(a->F);
    sl_factor_free(a->threaded);
    sl_selected_free(a->Z);
    sl_work_free(a->W);
    free(a->out);
    free(a->b);
    free(a->nearby);
}

/* Checks entries of the diagonal against full solves, with relative error 1e-9. */
static int check(bench_run *run, adf *a, void (*call)(void *), const char *method) {
    const size_t n = (size_t)a->system->n;
    double *x = bench_alloc(n, sizeof *x);
    uint64_t rng = 9;
    int passed = 1;
    memset(a->out, 0, n * sizeof *a->out);
    call(a);
    for (int k = 0; k < CHECKED; k++) {
        const sl_int row = bench_random_below(&rng, a->system->n);
        a->b[row] = 1;
        bench_must(sl_factor_solve(a->system->F, x, n, a->b, n, 1, NULL), "full solve");
        a->b[row] = 0;
        passed &= bench_expect(run, fabs(a->out[row] - x[row]) <= 1e-9 * x[row],
                               "%s, %s: entry %d is %.17g instead of %.17g", a->system->name,
                               method, (int)row, a->out[row], x[row]);
    }
    free(x);
    return passed;
}

/* Prints a row with the sample scaled by a factor. Returns its median. */
static double report_time(bench_report *report, const adf *a, const char *what, const char *method,
                          sl_int threads, bench_sample time, double scale, double baseline) {
    bench_row row = {.what = what, .method = method, .threads = threads, .time = time};
    row.time.min *= scale;
    row.time.median *= scale;
    row.time.max *= scale;
    row.baseline = baseline;
    bench_report_row(report, a->system, &row);
    return row.time.median;
}

static void one_system(bench_run *run, bench_report *report, const bench_system *system) {
    adf a = adf_create(system);
    const double n = (double)system->n;
    if (check(run, &a, call_diagonal, "diagonal") &&
        check(run, &a, call_threaded_diagonal, "2 threads") &&
        check(run, &a, call_selected_refactor, "selected")) {
        bench_contender variants[VARIANTS] = {
            {call_both, &a, 1, NULL},     {call_refactor, &a, 1, NULL},
            {call_diagonal, &a, 1, NULL}, {call_selected_refactor, &a, 1, NULL},
            {call_threaded, &a, 1, NULL}, {call_threaded_diagonal, &a, 1, NULL}};
        bench_sample samples[VARIANTS], each[4];
        bench_race(samples, variants, VARIANTS, 4 * run->seconds);
        bench_queries *q = bench_queries_vertices(system, SAMPLE, 1);
        bench_queries_check(run, q, 2);
        bench_contender singles[4] = {{call_near, &a, 1, NULL},
                                      {bench_call_plan_solve, q, SAMPLE, NULL},
                                      {bench_call_one_shot, q, SAMPLE, NULL},
                                      {call_full, &a, 4, NULL}};
        bench_race(each, singles, 4, run->seconds);
        const int is_forward = a.stats.inverse.method == SL_INVERSE_FORWARD;
        const double all = report_time(report, &a, "every vertex", "refactor + diagonal", 1,
                                       samples[0], 1, samples[0].median);
        report_time(report, &a, "every vertex", "refactor + diagonal", 2, samples[4], 1, all);
        report_time(report, &a, "factor", "refactor", 1, samples[1], 1, all);
        report_time(report, &a, "diagonal", "diagonal", 1, samples[2], 1, all);
        report_time(report, &a, "diagonal", "diagonal", 2, samples[5], 1, all);
        report_time(report, &a, "diagonal", "selected, refactor", 1, samples[3], 1, all);
        if (is_forward) {
            report_time(report, &a, "diagonal", "forward, 256 near, x n/256", 1, each[0], n / NEAR,
                        all);
        }
        report_time(report, &a, "diagonal", "plan solve, 64, x n", 1, each[1], n, all);
        const double local =
            report_time(report, &a, "diagonal", "one shot, 64, x n", 1, each[2], n, all);
        const double full =
            report_time(report, &a, "diagonal", "full solve, 4, x n", 1, each[3], n, all);
        bench_report_note(
            report,
            "%-14s   [HDA17], 53 thousand vertices: 11 s by local solves, 225 s by full "
            "solves, 39 s by 300 eigenvectors",
            "");
        bench_report_note(
            report,
            "%-14s   here: %.3f s with the refactorization, %.3f s on two threads; local "
            "solves %.1f s, full solves %.0f s",
            "", all, samples[4].median, local, full);
        bench_queries_free(q);
    }
    adf_free(&a);
}

void bench_adf(bench_run *run) {
    const bench_system *systems[MAX_SYSTEMS];
    const char *data = getenv("SL_DATA");
    int count = 0;
    if (run->mesh_path) {
        systems[count++] = bench_mesh(run->mesh_path);
    } else {
        systems[count++] = bench_torus(53e3);
        if (data && data[0]) {
            char path[512];
            snprintf(path, sizeof path, "%s/meshes/kitten.obj.gz", data);
            systems[count] = bench_mesh(path);
            count += systems[count] != NULL;
        }
        if (run->size != BENCH_QUICK) {
            systems[count++] = bench_torus(1e6);
        }
    }
    bench_report *report = bench_report_open(
        run, "adf", "auto-diffusion at every vertex ([HDA17] section 5)", "refactor + diagonal");
    for (int k = 0; k < count; k++) {
        one_system(run, report, systems[k]);
    }
    bench_report_close(report);
}

/* restrict.c: is the factor of a patch cheaper from that of the whole mesh than from its matrix? */
#include <stdlib.h>
#include <string.h>

#include "bench/lib/bench.h"

/* Patches of a 100th, a 10th and half of the vertices, and sets of which little or nothing can be
 * kept: every 10th vertex, every second one, and a band around a patch of a 10th. The baseline is
 * the analysis and factorization of the submatrix, which is given with both triangles, in the order
 * of the whole matrix: the times of its extraction and of an ordering are not included. */
enum { PATCHES = 3 };

typedef struct restricted {
    const bench_system *system;
    bench_patch patch;
    sl_int *perm; /* the order of the whole matrix */
    sl_symbolic *S;
    sl_factor *G;
} restricted;

static void release(void *state) {
    restricted *c = state;
    sl_factor_free(c->G);
    sl_symbolic_free(c->S);
    c->G = NULL;
    c->S = NULL;
}

static void call_restrict(void *state) {
    restricted *c = state;
    bench_must(sl_factor_restrict(&c->S, &c->G, c->system->F, &c->system->A, c->patch.vertices,
                                  c->patch.size, NULL, NULL),
               "restriction");
}

static void call_anew(void *state) {
    restricted *c = state;
    sl_options opt;
    sl_options_init(&opt, sizeof opt);
    opt.ordering = SL_ORDERING_GIVEN;
    opt.perm = c->perm;
    bench_must(sl_symbolic_create(&c->S, &c->patch.A, &opt, NULL), "analysis");
    bench_must(sl_factor_create(&c->G, c->S, &c->patch.A, NULL, NULL), "factor");
}

static int by_key(const void *a, const void *b) {
    const sl_int *x = a, *y = b;
    return (*x > *y) - (*x < *y);
}

/* The order of the patch's rows in L of the whole matrix. */
static sl_int *inherited_order(const bench_system *system, const bench_patch *patch) {
    const sl_int *iperm = sl_symbolic_view(system->S).iperm;
    const size_t size = (size_t)patch->size;
    sl_int *keyed = bench_alloc(2 * size, sizeof *keyed), *perm = bench_alloc(size, sizeof *perm);
    for (size_t k = 0; k < size; k++) {
        keyed[2 * k] = iperm[patch->vertices[k]];
        keyed[2 * k + 1] = (sl_int)k;
    }
    qsort(keyed, size, 2 * sizeof *keyed, by_key);
    for (size_t k = 0; k < size; k++) {
        perm[k] = keyed[2 * k + 1];
    }
    free(keyed);
    return perm;
}

/* The solutions of both factors have small residuals, in the matrix of the patch. */
static int check(bench_run *run, restricted *c, void (*call)(void *), const char *method) {
    const size_t n = (size_t)c->patch.size;
    double *b = bench_alloc(n, sizeof *b), *x = bench_alloc(n, sizeof *x);
    double *r = bench_alloc(n, sizeof *r), error = 0.0;
    uint64_t rng = 5;
    bench_random_fill(&rng, b, n);
    call(c);
    bench_must(sl_factor_solve(c->G, x, n, b, n, 1, NULL), "solve");
    bench_must(sl_csc_residual(&c->patch.A, r, n, &error, x, n, b, n, 1), "residual");
    release(c);
    free(b);
    free(x);
    free(r);
    return bench_expect(run, error < 1e-14 * (double)n, "%s: backward error %g", method, error);
}

/* Times the restriction to a patch, which it releases. */
static void time_set(bench_run *run, bench_report *report, const bench_system *system,
                     bench_patch patch, const char *shape) {
    restricted c;
    memset(&c, 0, sizeof c);
    c.system = system;
    c.patch = patch;
    c.perm = inherited_order(system, &c.patch);
    if (check(run, &c, call_anew, "anew") && check(run, &c, call_restrict, "restriction")) {
        const bench_contender contenders[2] = {
            {.call = call_anew, .state = &c, .ready = release},
            {.call = call_restrict, .state = &c, .ready = release}};
        static const char *const methods[2] = {"analyze and factor", "restrict"};
        bench_sample samples[2];
        char what[32];
        snprintf(what, sizeof what, "%s%d rows", shape, (int)c.patch.size);
        bench_race(samples, contenders, 2, run->seconds);
        for (int k = 0; k < 2; k++) {
            bench_row row = {.what = what, .method = methods[k], .nrhs = 1};
            row.time = samples[k];
            row.baseline = samples[0].median;
            bench_report_row(report, system, &row);
        }
        release(&c);
    }
    free(c.perm);
    bench_patch_free(&c.patch);
}

/* Every step-th vertex, or of a patch of a 10th of the vertices the last tenth that a breadth-first
 * search finds. */
static void time_thin(bench_run *run, bench_report *report, const bench_system *system) {
    const sl_int n = system->n, ring = n / 10;
    sl_int *vertices = bench_alloc((size_t)n, sizeof *vertices);
    bench_patch patch = bench_patch_create(system, n / 2, ring);
    sl_int first = patch.size - patch.size / 10;
    time_set(run, report, system,
             bench_patch_of(system, patch.vertices + first, patch.size - first), "ring ");
    bench_patch_free(&patch);
    for (sl_int step = 2; step <= 10; step += 8) {
        sl_int count = 0;
        for (sl_int v = 0; v < n; v += step) {
            vertices[count++] = v;
        }
        time_set(run, report, system, bench_patch_of(system, vertices, count), "thin ");
    }
    free(vertices);
}

void bench_restrict(bench_run *run) {
    static const double wanted[] = {1e4, 1e5, 1e6};
    static const sl_int parts[PATCHES] = {100, 10, 2};
    const bench_system *systems[3];
    const int count = bench_systems(run, wanted, 3, systems);
    bench_report *report =
        bench_report_open(run, "restrict", "the factor of a patch", "analyze and factor");
    for (int k = 0; k < count; k++) {
        for (int part = 0; part < PATCHES; part++) {
            time_set(run, report, systems[k],
                     bench_patch_create(systems[k], systems[k]->n / 2,
                                        systems[k]->n / parts[part]),
                     "");
        }
        time_thin(run, report, systems[k]);
    }
    bench_report_note(report, "the submatrix is given, in the order of the whole one");
    bench_report_close(report);
}

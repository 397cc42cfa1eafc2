/* submatrix.c: is the factor of a patch cheaper from that of the whole mesh than from A? */
#include <stdlib.h>
#include <string.h>

#include "bench/lib/bench.h"

/* Sets of which much, little and nothing can be kept: discs, half of the vertices, a ring, bands
 * around a vertex, and rows at random. The baseline is the analysis and factorization of the
 * submatrix in the order of the whole matrix; another contender orders it anew. Both are given the
 * submatrix, the first one also its order: the times of extraction are not included. */
typedef struct restricted {
    const bench_system *system;
    bench_patch patch;
    sl_int *perm; /* the order of the whole matrix; NULL: a new one */
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

static void call_submatrix(void *state) {
    restricted *c = state;
    bench_must(sl_factor_submatrix(&c->S, &c->G, c->system->F, &c->system->A, c->patch.vertices,
                                   c->patch.size, NULL, NULL),
               "restriction");
}

static void call_anew(void *state) {
    restricted *c = state;
    sl_options opt;
    sl_options_init(&opt, sizeof opt);
    if (c->perm != NULL) {
        opt.ordering = SL_ORDERING_GIVEN;
        opt.perm = c->perm;
    }
    opt.triangle = SL_TRIANGLE_LOWER; /* both are stored */
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
    restricted c, d;
    memset(&c, 0, sizeof c);
    c.system = system;
    c.patch = patch;
    d = c;
    c.perm = inherited_order(system, &c.patch);
    if (check(run, &c, call_anew, "anew") && check(run, &c, call_submatrix, "restriction")) {
        const bench_contender contenders[3] = {
            {.call = call_anew, .state = &c, .ready = release},
            {.call = call_anew, .state = &d, .ready = release},
            {.call = call_submatrix, .state = &c, .ready = release}};
        static const char *const methods[3] = {"analyze and factor", "order, analyze and factor",
                                               "submatrix"};
        bench_sample samples[3];
        char what[40];
        snprintf(what, sizeof what, "%s %d", shape, (int)c.patch.size);
        bench_race(samples, contenders, 3, run->seconds);
        for (int k = 0; k < 3; k++) {
            bench_row row = {.what = what, .method = methods[k], .nrhs = 1};
            row.time = samples[k];
            row.baseline = samples[0].median;
            bench_report_row(report, system, &row);
        }
        release(&c);
        release(&d);
    }
    free(c.perm);
    bench_patch_free(&c.patch);
}

static void time_discs(bench_run *run, bench_report *report, const bench_system *system) {
    const sl_int n = system->n;
    for (sl_int size = 100; size <= n / 9; size *= 10) {
        time_set(run, report, system, bench_patch_create(system, n / 2, size), "disc");
    }
    time_set(run, report, system, bench_patch_create(system, n / 2, n / 2), "half");
}

/* Of the breadth-first search from a vertex: the last tenth of the first tenth, and 2 of 16 levels
 * of all. */
static void time_bands(bench_run *run, bench_report *report, const bench_system *system) {
    const adjacency *graph = &system->graph;
    const sl_int n = system->n;
    sl_int *vertices = bench_alloc((size_t)n, sizeof *vertices);
    sl_int *level = bench_alloc((size_t)n, sizeof *level), count = 0;
    const sl_int reached = adjacency_bfs(vertices, n, graph, n / 2, system->seen);
    const sl_int ring = reached / 10, first = ring - ring / 10;
    time_set(run, report, system, bench_patch_of(system, vertices + first, ring - first), "ring");
    for (sl_int v = 0; v < n; v++) {
        level[v] = -1;
    }
    for (sl_int k = 0; k < reached; k++) {
        const sl_int v = vertices[k];
        level[v] = k == 0 ? 0 : level[v];
        for (sl_off p = graph->begin[v]; p < graph->begin[v + 1]; p++) {
            const sl_int u = graph->neighbor[p];
            level[u] = level[u] == -1 ? level[v] + 1 : level[u];
        }
    }
    for (sl_int v = 0; v < n; v++) {
        if (level[v] >= 0 && level[v] % 16 < 2) {
            vertices[count++] = v;
        }
    }
    time_set(run, report, system, bench_patch_of(system, vertices, count), "bands");
    free(level);
    free(vertices);
}

static void time_random(bench_run *run, bench_report *report, const bench_system *system) {
    sl_int *vertices = bench_alloc((size_t)system->n, sizeof *vertices);
    static const sl_int one_of[] = {100, 10, 2};
    for (int k = 0; k < 3; k++) {
        uint64_t rng = 7;
        sl_int count = 0;
        for (sl_int v = 0; v < system->n; v++) {
            if (bench_random_below(&rng, one_of[k]) == 0) {
                vertices[count++] = v;
            }
        }
        time_set(run, report, system, bench_patch_of(system, vertices, count), "random");
    }
    free(vertices);
}

void bench_submatrix(bench_run *run) {
    static const double wanted[] = {1e4, 1e5, 1e6};
    const bench_system *systems[3];
    const int count = bench_systems(run, wanted, 3, systems);
    bench_report *report =
        bench_report_open(run, "submatrix", "the factor of a patch", "analyze and factor");
    for (int k = 0; k < count; k++) {
        time_discs(run, report, systems[k]);
        time_bands(run, report, systems[k]);
        time_random(run, report, systems[k]);
    }
    bench_report_note(report, "the submatrix is given, and for the baseline its order");
    bench_report_close(report);
}

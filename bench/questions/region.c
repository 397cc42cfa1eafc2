/* region.c: what does a region save in local solves, and what does it cost? */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "bench/lib/bench.h"

/* The same solves at 100 random places: b and x at one vertex, and b and x on a patch of 2000
 * vertices, each in a region of its own; and b and x at one vertex in the region of the patch
 * around it. Each is solved by the plan to the roots, which is the baseline, and by the plan in
 * the region. A run visits all places in turn, so that between two visits of a place the caches
 * have seen 99 others; the rows "again" stay at one place for several calls. The plans are timed
 * one after the other, because plans to the roots evict everything else from the caches. */
enum { PLACES = 100, MADE = 5, PATCH = 2000, AGAIN = 8, MAX_SYSTEMS = 3, CASES = 4 };

/* Vertices. On larger meshes, 100 regions by sweeps take minutes. */
static const double max_n_copied = 2e6;

typedef struct one_case {
    const char *name;
    int in_patch; /* the region is that of the patch */
    int one;      /* b and x at its first vertex alone */
    sl_int nrhs;
} one_case;

static const one_case cases[CASES] = {{"vertex", 0, 1, 1},
                                      {"patch 2000", 1, 0, 1},
                                      {"vertex in patch", 1, 1, 1},
                                      {"patch 2000", 1, 0, 8}};

/* Regions at all places, and the queries of the current case. */
typedef struct places {
    const bench_system *system;
    sl_region *regions[PLACES];
    sl_int vertices[PLACES];
    sl_int *sets[PLACES];
    sl_int sizes[PLACES];
    bench_queries *plain, *inside; /* the same queries to the roots and in the regions */
    int calls, next;
    double bytes, boundary; /* means over the regions */
    double entries;         /* mean doubles of the inverse that a query reads */
} places;

static places *places_create(const bench_system *system, sl_int size) {
    places *t = bench_alloc(1, sizeof *t);
    uint64_t rng = 2026;
    memset(t, 0, sizeof *t);
    t->system = system;
    for (int k = 0; k < PLACES; k++) {
        sl_stats stats;
        t->vertices[k] = bench_random_below(&rng, system->n);
        t->sets[k] = bench_alloc((size_t)size, sizeof(sl_int));
        t->sizes[k] = adjacency_bfs(t->sets[k], size, &system->graph, t->vertices[k], system->seen);
        bench_must(sl_region_create(&t->regions[k], system->F, t->sets[k], t->sizes[k], NULL, NULL,
                                    &stats),
                   "region");
        t->bytes += (double)stats.region.bytes / PLACES;
        t->boundary += (double)stats.region.boundary / PLACES;
    }
    return t;
}

/* Adds a query whose plan ends at the boundary of a region. */
static const bench_query *add_inside(bench_queries *q, const sl_region *R, const sl_int *set,
                                     sl_int size) {
    sl_options options;
    memset(&options, 0, sizeof options);
    options.region = R;
    bench_queries_add(q, set, size, set, size);
    bench_query *one = &q->all[q->count - 1];
    sl_plan_free(one->plan);
    bench_must(
        sl_plan_create(&one->plan, q->system->S, set, size, set, size, &options, &one->reach),
        "plan in a region");
    bench_must(one->reach.plan.in_region ? SL_OK : SL_ERR_MISMATCH, "a plan inside its region");
    return one;
}

static void places_add_queries(places *t, const one_case *c) {
    t->plain = bench_queries_create(t->system, PLACES, c->nrhs);
    t->inside = bench_queries_create(t->system, PLACES, c->nrhs);
    t->entries = 0;
    for (int k = 0; k < PLACES; k++) {
        const sl_int *set = c->one ? &t->vertices[k] : t->sets[k], size = c->one ? 1 : t->sizes[k];
        bench_queries_add(t->plain, set, size, set, size);
        t->entries +=
            (double)add_inside(t->inside, t->regions[k], set, size)->reach.plan.region_entries /
            PLACES;
    }
}

static void places_free_queries(places *t) {
    bench_queries_free(t->inside);
    bench_queries_free(t->plain);
}

static void places_free(places *t) {
    for (int k = 0; k < PLACES; k++) {
        sl_region_free(t->regions[k]);
        free(t->sets[k]);
    }
    free(t);
}

/* Runs the same query for AGAIN calls, then the next one. */
static void again(places *t, bench_queries *q) {
    q->next = t->calls++ / AGAIN % q->count;
    bench_call_plan_solve(q);
}

static void call_plain_again(void *state) {
    again(state, ((places *)state)->plain);
}

static void call_inside_again(void *state) {
    again(state, ((places *)state)->inside);
}

static void call_create(void *state) {
    places *t = state;
    sl_region *R;
    bench_must(
        sl_region_create(&R, t->system->F, t->sets[t->next], t->sizes[t->next], NULL, NULL, NULL),
        "region");
    sl_region_free(R);
    t->next = (t->next + 1) % PLACES;
}

static void call_region_refactor(void *state) {
    places *t = state;
    bench_must(sl_region_refactor(t->regions[t->next], t->system->F, NULL, t->inside->W),
               "region refactor");
    t->next = (t->next + 1) % PLACES;
}

/* Checks that all solutions in regions equal those of the plans to the roots, which have the
 * bits of full solves, to 1e-9 of the largest entry. */
static int check(bench_run *run, places *t, const char *what) {
    double worst = 0;
    if (!bench_queries_check(run, t->plain, 1)) {
        return 0;
    }
    for (int k = 0; k < PLACES; k++) {
        const bench_query *plain = &t->plain->all[k], *in = &t->inside->all[k];
        const size_t size = (size_t)in->nx * (size_t)t->inside->nrhs;
        double largest = 0, difference = 0;
        t->plain->next = t->inside->next = k;
        bench_call_plan_solve(t->plain);
        bench_call_plan_solve(t->inside);
        for (size_t i = 0; i < size; i++) {
            const double error = fabs(plain->X[i] - in->X[i]);
            largest = fmax(largest, fabs(plain->X[i]));
            difference = error <= difference ? difference : error; /* a NaN stays */
        }
        worst = difference / largest <= worst ? worst : difference / largest;
    }
    t->plain->next = t->inside->next = 0;
    return bench_expect(run, worst < 1e-9, "%s, %s: the solution in the region differs by %.2g",
                        t->system->name, what, worst);
}

typedef struct growth {
    double n[MAX_SYSTEMS], plain[CASES][MAX_SYSTEMS], inside[CASES][MAX_SYSTEMS];
    int count;
} growth;

enum { PLAIN, INSIDE, PLAIN_AGAIN, INSIDE_AGAIN, CREATE, REFACTOR, VARIANTS };

static void report_case(bench_report *report, const places *t, const one_case *c,
                        const bench_sample *samples, int variants) {
    static const char *const methods[VARIANTS] = {
        "plan to the roots",     "plan in region", "plan to the roots, again",
        "plan in region, again", "region create",  "region refactor"};
    const sl_stats plain = bench_queries_reach(t->plain), in = bench_queries_reach(t->inside);
    for (int k = 0; k < variants; k++) {
        bench_row row = {.what = c->name,
                         .method = methods[k],
                         .nrhs = k < CREATE ? c->nrhs : 0,
                         .time = samples[k],
                         .baseline = samples[k == INSIDE_AGAIN ? PLAIN_AGAIN : PLAIN].median};
        if (k < CREATE) {
            const int is_inside = k == INSIDE || k == INSIDE_AGAIN;
            bench_row_reach(&row, is_inside ? &in : &plain);
            row.entries +=
                is_inside ? 2 * t->entries : 0; /* both triangles of the boundary block */
        }
        bench_report_row(report, t->system, &row);
    }
    bench_report_note(
        report,
        "%-14s   boundary %.0f rows, %.1f kB per region; in it the plan is %.1f times as "
        "fast, again %.1f times",
        "", t->boundary, 1e-3 * t->bytes, samples[PLAIN].median / samples[INSIDE].median,
        samples[PLAIN_AGAIN].median / samples[INSIDE_AGAIN].median);
}

/* For the places whose region can be copied from a selected inverse: times creating the region
 * by copying and by sweeps, once each, and solving in both. */
static void time_copies(bench_run *run, bench_report *report, const places *t, const char *what) {
    enum { SWEPT, COPIED, IN_SWEPT, IN_COPIED, ROWS };
    static const char *const methods[ROWS] = {"region create", "region create, selected",
                                              "plan in region", "plan in region, selected"};
    bench_queries *q[2] = {bench_queries_create(t->system, PLACES, 1),
                           bench_queries_create(t->system, PLACES, 1)};
    sl_region *R[2][PLACES];
    double seconds[2][PLACES];
    sl_selected *Z;
    int count = 0;
    bench_must(sl_selected_create(&Z, t->system->F, NULL, SL_ALL, NULL, NULL), "selected inverse");
    for (int k = 0; k < PLACES; k++) {
        sl_stats stats;
        for (int copied = 1; copied >= 0; copied--) {
            const double start = bench_now();
            bench_must(sl_region_create(&R[copied][count], t->system->F, t->sets[k], t->sizes[k],
                                        copied ? Z : NULL, NULL, &stats),
                       "region");
            seconds[copied][count] = bench_now() - start;
            if (copied && !stats.region.is_copied) {
                sl_region_free(R[copied][count]);
                break;
            }
            add_inside(q[copied], R[copied][count], t->sets[k], t->sizes[k]);
            count += !copied;
        }
    }
    sl_selected_free(Z);
    bench_report_note(report,
                      "%-14s   %d of %d regions can be copied from the selected inverse:", "",
                      count, PLACES);
    if (count > 0) {
        const bench_contender solves[2] = {{bench_call_plan_solve, q[0], count, NULL},
                                           {bench_call_plan_solve, q[1], count, NULL}};
        bench_sample samples[ROWS] = {bench_sample_of(seconds[0], count),
                                      bench_sample_of(seconds[1], count)};
        bench_race(samples + IN_SWEPT, solves, 2, run->seconds / 8);
        for (int k = 0; k < ROWS; k++) {
            bench_row row = {.what = what,
                             .method = methods[k],
                             .nrhs = k / 2,
                             .time = samples[k],
                             .baseline = samples[k / 2 * 2].median};
            bench_report_row(report, t->system, &row);
        }
    }
    for (int k = 0; k < 2; k++) {
        bench_queries_free(q[k]);
        for (int r = 0; r < count; r++) {
            sl_region_free(R[k][r]);
        }
    }
}

static void time_case(bench_run *run, bench_report *report, places *t, int which, growth *g) {
    const one_case *c = &cases[which];
    places_add_queries(t, c);
    if (check(run, t, c->name)) {
        const bench_contender contenders[VARIANTS] = {
            {bench_call_plan_solve, t->plain, PLACES, NULL},
            {bench_call_plan_solve, t->inside, PLACES, NULL},
            {call_plain_again, t, AGAIN * PLACES, NULL},
            {call_inside_again, t, AGAIN * PLACES, NULL},
            {call_create, t, MADE, NULL},
            {call_region_refactor, t, MADE, NULL}};
        bench_sample samples[VARIANTS];
        const int variants = c->in_patch && (c->one || c->nrhs > 1) ? CREATE : VARIANTS;
        for (int k = 0; k < variants; k++) {
            t->calls = t->next = 0;
            bench_race(samples + k, contenders + k, 1, run->seconds / 8);
        }
        report_case(report, t, c, samples, variants);
        g->plain[which][g->count] = samples[PLAIN].median;
        g->inside[which][g->count] = samples[INSIDE].median;
        if (variants == VARIANTS && t->system->n <= max_n_copied) {
            time_copies(run, report, t, c->name);
        }
    }
    places_free_queries(t);
}

void bench_region(bench_run *run) {
    static const double wanted[] = {1e5, 1e6, 4e6};
    static growth g;
    const bench_system *systems[MAX_SYSTEMS];
    const int count = bench_systems(run, wanted, 3, systems);
    bench_report *report =
        bench_report_open(run, "region", "local solves whose sweeps end at a region's boundary",
                          "the plan to the roots");
    g.count = 0;
    for (int k = 0; k < count; k++) {
        places *vertices = places_create(systems[k], 1),
               *patches = places_create(systems[k], PATCH);
        for (int which = 0; which < CASES; which++) {
            time_case(run, report, cases[which].in_patch ? patches : vertices, which, &g);
        }
        places_free(vertices);
        places_free(patches);
        g.n[g.count++] = systems[k]->n;
    }
    printf("\n");
    for (int which = 0; which < CASES && g.count > 1; which++) {
        const int last = g.count - 1;
        bench_report_note(
            report,
            "%s, %d rhs: from n = %.3g to %.3g the plan to the roots takes %.1f times as "
            "long, that in a region %.2f times",
            cases[which].name, (int)cases[which].nrhs, g.n[0], g.n[last],
            g.plain[which][last] / g.plain[which][0], g.inside[which][last] / g.inside[which][0]);
    }
    bench_report_close(report);
}

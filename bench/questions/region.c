/* region.c: what does a region save local questions, what does it cost, and do they still grow with the mesh? */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "bench.h"

/* The same question at 100 random places: a vertex to itself, and b and x on a patch of 2000 vertices, each with its
 * own region; and a vertex inside the region of the patch around it. By the plan to the roots, which is the baseline,
 * and by the plan in the region. Each goes through all places in turn, so that at a patch the caches have seen 99
 * others since, and then several times at one place ("again"). The two are timed one after the other, as plans to the
 * roots push everything else out of the caches. */
enum { PLACES = 100, MADE = 5, PATCH = 2000, AGAIN = 8, MAX_SYSTEMS = 3, CASES = 4 };

static const double most_copied =
    2e6; /* vertices of a mesh: beyond it 100 regions by sweeps take minutes */

typedef struct one_case {
    const char *name;
    int in_patch; /* the region is that of the patch */
    int one;      /* the question is about its first vertex alone */
    sl_int nrhs;
} one_case;

static const one_case cases[CASES] = {{"vertex", 0, 1, 1},
                                      {"patch 2000", 1, 0, 1},
                                      {"vertex in patch", 1, 1, 1},
                                      {"patch 2000", 1, 0, 8}};

/* Regions at all places, and what is asked there. */
typedef struct scene {
    const bench_system *system;
    sl_region *regions[PLACES];
    sl_int vertices[PLACES];
    sl_int *sets[PLACES];
    sl_int sizes[PLACES];
    bench_queries *plain, *inside; /* the same questions to the roots and in the regions */
    int calls, next;
    double bytes, boundary; /* means over the regions */
    double entries;         /* mean doubles of the inverse that a question reads */
} scene;

static scene *scene_make(const bench_system *system, sl_int size) {
    scene *t = bench_alloc(1, sizeof *t);
    uint64_t chance = 2026;
    memset(t, 0, sizeof *t);
    t->system = system;
    for (int k = 0; k < PLACES; k++) {
        sl_stats stats;
        t->vertices[k] = bench_random_below(&chance, system->n);
        t->sets[k] = bench_alloc((size_t)size, sizeof(sl_int));
        t->sizes[k] = patch_bfs(t->sets[k], size, &system->graph, t->vertices[k], system->seen);
        bench_must(sl_region_create(&t->regions[k], system->F, t->sets[k], t->sizes[k], NULL, NULL,
                                    &stats),
                   "region");
        t->bytes += (double)stats.bytes_region / PLACES;
        t->boundary += (double)stats.region_boundary / PLACES;
    }
    return t;
}

/* A question whose plan ends in a region. */
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
    bench_must(one->reach.plan_in_region ? SL_OK : SL_ERR_STATE, "a plan inside its region");
    return one;
}

static void scene_ask(scene *t, const one_case *c) {
    t->plain = bench_queries_create(t->system, PLACES, c->nrhs);
    t->inside = bench_queries_create(t->system, PLACES, c->nrhs);
    t->entries = 0;
    for (int k = 0; k < PLACES; k++) {
        const sl_int *set = c->one ? &t->vertices[k] : t->sets[k], size = c->one ? 1 : t->sizes[k];
        bench_queries_add(t->plain, set, size, set, size);
        t->entries +=
            (double)add_inside(t->inside, t->regions[k], set, size)->reach.plan_region_entries /
            PLACES;
    }
}

static void scene_forget(scene *t) {
    bench_queries_free(t->inside);
    bench_queries_free(t->plain);
}

static void scene_free(scene *t) {
    for (int k = 0; k < PLACES; k++) {
        sl_region_free(t->regions[k]);
        free(t->sets[k]);
    }
    free(t);
}

/* Stays at a place for some calls. */
static void again(scene *t, bench_queries *q) {
    q->next = t->calls++ / AGAIN % q->count;
    bench_call_plan_solve(q);
}

static void call_plain_again(void *state) {
    again(state, ((scene *)state)->plain);
}

static void call_inside_again(void *state) {
    again(state, ((scene *)state)->inside);
}

static void call_create(void *state) {
    scene *t = state;
    sl_region *R;
    bench_must(
        sl_region_create(&R, t->system->F, t->sets[t->next], t->sizes[t->next], NULL, NULL, NULL),
        "region");
    sl_region_free(R);
    t->next = (t->next + 1) % PLACES;
}

static void call_refill(void *state) {
    scene *t = state;
    bench_must(sl_region_refill(t->regions[t->next], t->system->F, NULL, t->inside->W), "refill");
    t->next = (t->next + 1) % PLACES;
}

/* All answers in their regions are those of the plans to the roots, which have the bits of full solves, to 1e-9 of the
 * largest number. */
static int check(bench_run *run, scene *t, const char *what) {
    double worst = 0;
    if (!bench_queries_check(run, t->plain, 1)) {
        return 0;
    }
    for (int k = 0; k < PLACES; k++) {
        const bench_query *plain = &t->plain->all[k], *in = &t->inside->all[k];
        const size_t size = (size_t)in->nx * (size_t)t->inside->nrhs;
        double largest = 0, apart = 0;
        t->plain->next = t->inside->next = k;
        bench_call_plan_solve(t->plain);
        bench_call_plan_solve(t->inside);
        for (size_t i = 0; i < size; i++) {
            const double error = fabs(plain->X[i] - in->X[i]);
            largest = fmax(largest, fabs(plain->X[i]));
            apart = error <= apart ? apart : error; /* a NaN stays */
        }
        worst = apart / largest <= worst ? worst : apart / largest;
    }
    t->plain->next = t->inside->next = 0;
    return bench_expect(run, worst < 1e-9, "%s, %s: in its region %.2g away", t->system->name, what,
                        worst);
}

typedef struct growth {
    double n[MAX_SYSTEMS], plain[CASES][MAX_SYSTEMS], inside[CASES][MAX_SYSTEMS];
    int count;
} growth;

enum { PLAIN, INSIDE, PLAIN_AGAIN, INSIDE_AGAIN, CREATE, REFILL, WAYS };

static void report_case(bench_report *report, const scene *t, const one_case *c,
                        const bench_sample *samples, int ways) {
    static const char *const methods[WAYS] = {
        "plan to the roots",     "plan in region", "plan to the roots, again",
        "plan in region, again", "region create",  "region refill"};
    const sl_stats plain = bench_queries_reach(t->plain), in = bench_queries_reach(t->inside);
    for (int k = 0; k < ways; k++) {
        bench_row row = {.what = c->name,
                         .method = methods[k],
                         .nrhs = k < CREATE ? c->nrhs : 0,
                         .time = samples[k],
                         .baseline = samples[k == INSIDE_AGAIN ? PLAIN_AGAIN : PLAIN].median};
        if (k < CREATE) {
            const int is_inside = k == INSIDE || k == INSIDE_AGAIN;
            bench_row_reach(&row, is_inside ? &in : &plain);
            row.entries += is_inside ? 2 * t->entries : 0; /* each half of the square once */
        }
        bench_report_row(report, t->system, &row);
    }
    bench_report_note(
        report,
        "%-14s   boundary %.0f rows, %.1f kB a region; in it the plan is %.1f times as "
        "fast, again %.1f times",
        "", t->boundary, 1e-3 * t->bytes, samples[PLAIN].median / samples[INSIDE].median,
        samples[PLAIN_AGAIN].median / samples[INSIDE_AGAIN].median);
}

/* The places whose region comes out of a selected inverse, where there is one: making it so and by sweeps, each once,
 * and solving in both. */
static void time_copies(bench_run *run, bench_report *report, const scene *t, const char *what) {
    enum { SWEPT, COPIED, IN_SWEPT, IN_COPIED, ROWS };
    static const char *const methods[ROWS] = {"region create", "region create, selected",
                                              "plan in region", "plan in region, selected"};
    bench_queries *q[2] = {bench_queries_create(t->system, PLACES, 1),
                           bench_queries_create(t->system, PLACES, 1)};
    sl_region *R[2][PLACES];
    double seconds[2][PLACES];
    sl_selected *Z;
    int count = 0;
    bench_must(sl_selected_create(&Z, t->system->F, NULL, 0, NULL, NULL), "selected inverse");
    for (int k = 0; k < PLACES; k++) {
        sl_stats stats;
        for (int copied = 1; copied >= 0; copied--) {
            const double start = bench_now();
            bench_must(sl_region_create(&R[copied][count], t->system->F, t->sets[k], t->sizes[k],
                                        copied ? Z : NULL, NULL, &stats),
                       "region");
            seconds[copied][count] = bench_now() - start;
            if (copied && !stats.region_is_copied) {
                sl_region_free(R[copied][count]);
                break;
            }
            add_inside(q[copied], R[copied][count], t->sets[k], t->sizes[k]);
            count += !copied;
        }
    }
    sl_selected_free(Z);
    bench_report_note(report,
                      "%-14s   with a selected inverse, %d of %d regions come out of it:", "",
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

static void time_case(bench_run *run, bench_report *report, scene *t, int which, growth *g) {
    const one_case *c = &cases[which];
    scene_ask(t, c);
    if (check(run, t, c->name)) {
        const bench_contender contenders[WAYS] = {{bench_call_plan_solve, t->plain, PLACES, NULL},
                                                  {bench_call_plan_solve, t->inside, PLACES, NULL},
                                                  {call_plain_again, t, AGAIN * PLACES, NULL},
                                                  {call_inside_again, t, AGAIN * PLACES, NULL},
                                                  {call_create, t, MADE, NULL},
                                                  {call_refill, t, MADE, NULL}};
        bench_sample samples[WAYS];
        const int ways = c->in_patch && (c->one || c->nrhs > 1) ? CREATE : WAYS;
        for (int k = 0; k < ways; k++) {
            t->calls = t->next = 0;
            bench_race(samples + k, contenders + k, 1, run->seconds / 8);
        }
        report_case(report, t, c, samples, ways);
        g->plain[which][g->count] = samples[PLAIN].median;
        g->inside[which][g->count] = samples[INSIDE].median;
        if (ways == WAYS && t->system->n <= most_copied) {
            time_copies(run, report, t, c->name);
        }
    }
    scene_forget(t);
}

void bench_region(bench_run *run) {
    static const double wanted[] = {1e5, 1e6, 4e6};
    static growth g;
    const bench_system *systems[MAX_SYSTEMS];
    const int count = bench_systems(run, wanted, 3, systems);
    bench_report *report =
        bench_report_open(run, "region", "local questions whose sweeps end at a region's boundary",
                          "the plan to the roots");
    g.count = 0;
    for (int k = 0; k < count; k++) {
        scene *vertices = scene_make(systems[k], 1), *patches = scene_make(systems[k], PATCH);
        for (int which = 0; which < CASES; which++) {
            time_case(run, report, cases[which].in_patch ? patches : vertices, which, &g);
        }
        scene_free(vertices);
        scene_free(patches);
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

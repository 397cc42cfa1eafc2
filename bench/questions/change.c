/* change.c: what does it cost to follow a change of a few entries, or to pin a few rows? */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "bench/lib/bench.h"

/* The weight of one edge is changed by a rank-one update, by a refactorization of its reach, and by
 * a complete one. The baseline is the local solve with b and x at one end of the edge: a forward
 * and a backward sweep on about the same path. Each update is undone by a downdate that is not
 * timed, and the other way round. Eight vertices in one place change by one pass of rank 8. Pins
 * are added and released again, one alone and the hundredth in one place. Many pins in one place
 * are added in one call, and the same rows are fixed by sl_fixed_create. */
enum { EDGES = 16, RANK = 8, PINS = 100, MANY = 400 };

typedef struct change {
    const bench_system *system;
    sl_factor *F;
    sl_work *W;
    sl_plan *plan[EDGES];
    sl_int i[EDGES], j[EDGES], near[EDGES][RANK];
    int next, is_plus; /* the entries are those after an update */
    double w;
    sl_stats stats;
    sl_constraints *pins;
    sl_int n_pins;
    sl_int held[MANY];
    double values[PINS];
} change;

static void edge_change(change *c, double w) {
    const sl_int i = c->i[c->next], j = c->j[c->next];
    const sl_int rows[3] = {i, j, i}, columns[3] = {i, j, j};
    const double deltas[3] = {w, w, -w};
    bench_must(sl_factor_change_entries(c->F, NULL, rows, columns, deltas, 3, c->W, NULL),
               "change of an edge");
}

static void eight_change(change *c, double w) {
    double deltas[RANK];
    for (int k = 0; k < RANK; k++) {
        deltas[k] = w;
    }
    bench_must(sl_factor_change_entries(c->F, NULL, c->near[c->next], c->near[c->next], deltas,
                                        RANK, c->W, NULL),
               "change of eight vertices");
}

/* ---- contenders; state is a change * ---- */

static void call_solve(void *state) {
    change *c = state;
    const double b = 1.0;
    double x;
    bench_must(sl_plan_solve(c->plan[c->next], c->F, &x, 1, &b, 1, 1, c->W), "solve");
    c->next = (c->next + 1) % EDGES;
}

static void ready_plus(void *state) { /* for an update: the downdate of the call before */
    change *c = state;
    if (c->is_plus) {
        edge_change(c, -c->w);
        c->next = (c->next + 1) % EDGES;
    }
    c->is_plus = 1;
}

static void call_update(void *state) {
    edge_change(state, ((change *)state)->w);
}

static void ready_minus(void *state) {
    change *c = state;
    c->next = (c->next + 1) % EDGES;
    edge_change(c, c->w);
}

static void call_downdate(void *state) {
    edge_change(state, -((change *)state)->w);
}

static void ready_eight(void *state) {
    change *c = state;
    if (c->is_plus) {
        eight_change(c, -c->w);
        c->next = (c->next + 1) % EDGES;
    }
    c->is_plus = 1;
}

static void call_eight(void *state) {
    eight_change(state, ((change *)state)->w);
}

static void call_changed(void *state) {
    change *c = state;
    bench_must(
        sl_factor_change_entries(c->F, &c->system->A, NULL, &c->i[c->next], NULL, 1, NULL, NULL),
        "refactorization of a reach");
    c->next = (c->next + 1) % EDGES;
}

static void call_refactor(void *state) {
    change *c = state;
    bench_must(sl_factor_refactor(c->F, &c->system->A, NULL), "refactorization");
}

/* Adds a pin, solves with all of them, and releases it. */
static void call_pin(void *state) {
    change *c = state;
    const sl_int count = c->n_pins;
    const double b = 1.0;
    double x;
    bench_must(sl_constraints_add(c->pins, &c->held[count], NULL, 1, NULL), "pin");
    bench_must(
        sl_constraints_solve(c->pins, c->plan[c->next], &x, 1, &b, 1, c->values, PINS, 1, c->W),
        "solve with pins");
    bench_must(sl_constraints_release(c->pins, &count, 1, NULL), "release");
    c->next = (c->next + 1) % EDGES;
}

static void call_hundred(void *state) {
    change *c = state;
    for (; c->n_pins < PINS; c->n_pins++) {
        bench_must(sl_constraints_add(c->pins, &c->held[c->n_pins], NULL, 1, NULL), "pin");
    }
}

/* Releases the last pins, one by one, until `count` are left. */
static void release_to(change *c, sl_int count) {
    while (c->n_pins > count) {
        c->n_pins--;
        bench_must(sl_constraints_release(c->pins, &c->n_pins, 1, NULL), "release");
    }
}

static void ready_hundred(void *state) {
    release_to(state, 0);
}

static void call_many(void *state) {
    change *c = state;
    bench_must(sl_constraints_add(c->pins, c->held, NULL, MANY, &c->stats), "pins");
    c->n_pins = MANY;
}

static void call_fixed(void *state) {
    change *c = state;
    sl_fixed *D;
    bench_must(sl_fixed_create(&D, &c->system->A, c->held, MANY, NULL, NULL), "rows");
    sl_fixed_free(D);
}

static void ready_many(void *state) {
    change *c = state;
    sl_int indices[MANY];
    for (sl_int k = 0; k < MANY; k++) {
        indices[k] = k;
    }
    bench_must(sl_constraints_release(c->pins, indices, c->n_pins, NULL), "release");
    c->n_pins = 0;
}

/* ---- one system ---- */

static change *change_create(const bench_system *system) {
    change *c = bench_alloc(1, sizeof *c);
    uint64_t rng = 14;
    memset(c, 0, sizeof *c);
    c->system = system;
    bench_must(sl_factor_create(&c->F, system->S, &system->A, NULL, NULL), "factor");
    bench_must(sl_work_create(&c->W, NULL), "workspace");
    bench_must(sl_constraints_create(&c->pins, c->F, NULL), "pins");
    for (int k = 0; k < EDGES; k++) {
        bench_patch p = bench_patch_create(system, bench_random_below(&rng, system->n), RANK);
        c->i[k] = p.vertices[0]; /* the seed, and a neighbor */
        c->j[k] = p.vertices[1];
        memcpy(c->near[k], p.vertices, sizeof c->near[k]);
        bench_must(sl_plan_create(&c->plan[k], system->S, &c->i[k], 1, &c->i[k], 1, NULL, NULL),
                   "plan");
        bench_patch_free(&p);
    }
    bench_patch p = bench_patch_create(system, c->i[0], MANY);
    memcpy(c->held, p.vertices, sizeof c->held);
    bench_patch_free(&p);
    for (sl_int k = 0; k < system->A.p[1]; k++) {
        c->w = fmax(c->w, 0.1 * fabs(system->A.x[k]));
    }
    return c;
}

static void change_free(change *c) {
    for (int k = 0; k < EDGES; k++) {
        sl_plan_free(c->plan[k]);
    }
    sl_constraints_free(c->pins);
    sl_factor_free(c->F);
    sl_work_free(c->W);
    free(c);
}

/* F := the factor of A again. */
static void restore(change *c) {
    bench_must(sl_factor_refactor(c->F, &c->system->A, NULL), "refactorization");
    bench_must(sl_constraints_refactor(c->pins, NULL), "pins");
}

/* An update and its downdate leave a factor of A. */
static int change_check(bench_run *run, change *c) {
    size_t n = (size_t)c->system->n;
    double *b = bench_alloc(n, sizeof *b), *x = bench_alloc(n, sizeof *x);
    uint64_t rng = 41;
    bench_random_fill(&rng, b, n);
    edge_change(c, c->w);
    edge_change(c, -c->w);
    eight_change(c, c->w);
    eight_change(c, -c->w);
    bench_must(sl_factor_solve(c->F, x, n, b, n, 1, NULL), "solve");
    int held = bench_check_residual(run, c->system, x, b, 1, "update and downdate");
    restore(c);
    free(x);
    free(b);
    return held;
}

static double race(bench_run *run, bench_report *report, change *c, const char *method,
                   bench_contender contender, double baseline) {
    bench_sample sample;
    c->next = 0;
    c->is_plus = 0;
    contender.state = c;
    bench_race(&sample, &contender, 1, run->seconds);
    bench_row row = {.what = "one place", .method = method, .nrhs = 1};
    row.time = sample;
    row.baseline = baseline > 0 ? baseline : sample.median;
    bench_report_row(report, c->system, &row);
    return sample.median;
}

static void time_system(bench_run *run, bench_report *report, const bench_system *system) {
    change *c = change_create(system);
    if (change_check(run, c)) {
        double one = race(run, report, c, "local solve", (bench_contender){.call = call_solve}, 0);
        race(run, report, c, "edge, update",
             (bench_contender){.call = call_update, .ready = ready_plus}, one);
        race(run, report, c, "edge, downdate",
             (bench_contender){.call = call_downdate, .ready = ready_minus}, one);
        race(run, report, c, "8 vertices, update",
             (bench_contender){.call = call_eight, .ready = ready_eight}, one);
        race(run, report, c, "refactor changed", (bench_contender){.call = call_changed}, one);
        race(run, report, c, "refactor", (bench_contender){.call = call_refactor}, one);
        restore(c);
        race(run, report, c, "pin, solve, release", (bench_contender){.call = call_pin}, one);
        race(run, report, c, "100 pins",
             (bench_contender){.call = call_hundred, .ready = ready_hundred}, one);
        release_to(c, PINS - 1);
        race(run, report, c, "pin 100, solve, rel.", (bench_contender){.call = call_pin}, one);
        const bench_contender many = {.call = call_many, .ready = ready_many};
        ready_hundred(c);
        race(run, report, c, "400 pins", many, one);
        race(run, report, c, "400 fixed rows", (bench_contender){.call = call_fixed}, one);
    }
    change_free(c);
}

void bench_change(bench_run *run) {
    static const double wanted[] = {1e4, 1e5, 5e5, 1e6};
    const bench_system *systems[4];
    const int count = bench_systems(run, wanted, 4, systems);
    bench_report *report =
        bench_report_open(run, "change", "a change of a few entries, or pins", "local solve");
    for (int k = 0; k < count; k++) {
        time_system(run, report, systems[k]);
    }
    bench_report_note(report, "a local solve is a forward and a backward sweep of one path");
    bench_report_close(report);
}

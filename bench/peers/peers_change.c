/* peers_change.c: changes of a factor, and pins, against CHOLMOD's updown and rowadd/rowdel */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "peers_steps.h"

/* Both sides change factors of their own. CHOLMOD's changes are permuted beforehand. Each update
 * is undone by a downdate that is not timed, and the other way round; a rank-8 update adds to the
 * diagonal of eight neighbors. A pin of ours is added to a factor that stays as it is, then one
 * vertex is solved for, and the pin is released; CHOLMOD deletes the row, solves, and adds it. */
enum { PLACES = 16, RANK = 8, PREPARED = 2 * PLACES };

static const double largest_n = 2e6; /* two more factors would be too much memory */

typedef struct changes {
    comparison *cmp;
    peer_change *peer;
    sl_factor *F;
    sl_constraints *pins;
    sl_plan *plan[PLACES];
    sl_int near[PLACES][RANK]; /* a vertex and its neighbors */
    double w;
} changes;

/* A contender. */
typedef struct place {
    changes *c;
    int is_peer;
    int which;   /* 0: an edge, 1: eight vertices */
    int next;    /* where the next change is */
    int is_plus; /* the factor is that after an update */
} place;

static void ours(const changes *c, int at, int which, double w) {
    const sl_int *v = c->near[at];
    const sl_int rows[3] = {v[0], v[1], v[0]}, columns[3] = {v[0], v[1], v[1]};
    double deltas[RANK] = {w, w, -w};
    for (int r = 0; r < RANK && which == 1; r++) {
        deltas[r] = w;
    }
    bench_must(which == 0
                   ? sl_factor_change_entries(c->F, NULL, rows, columns, deltas, 3, c->cmp->W, NULL)
                   : sl_factor_change_entries(c->F, NULL, v, v, deltas, RANK, c->cmp->W, NULL),
               "update");
}

static void theirs(const changes *c, int at, int which, int is_update) {
    peer_change_update(c->peer, which * PLACES + at, is_update);
}

static void change(const place *p, int is_update) {
    if (p->is_peer) {
        theirs(p->c, p->next, p->which, is_update);
    } else {
        ours(p->c, p->next, p->which, is_update ? p->c->w : -p->c->w);
    }
}

/* Before a timed update: the last one is undone. */
static void ready_up(void *state) {
    place *p = state;
    if (p->is_plus) {
        change(p, 0);
        p->next = (p->next + 1) % PLACES;
    }
    p->is_plus = 1;
}

static void call_up(void *state) {
    change(state, 1);
}

/* Before a timed downdate: an update. */
static void ready_down(void *state) {
    place *p = state;
    p->next = (p->next + 1) % PLACES;
    change(p, 1);
}

static void call_down(void *state) {
    change(state, 0);
}

/* The diagonal entry of the inverse at a vertex while its neighbor is held at 0. */
static double our_pinned(const changes *c, int at) {
    const double one = 1, zero = 0;
    const sl_int first = 0;
    double x;
    bench_must(sl_constraints_add(c->pins, &c->near[at][1], NULL, 1, NULL), "pin");
    bench_must(sl_constraints_solve(c->pins, c->plan[at], &x, 1, &one, 1, &zero, 1, 1, c->cmp->W),
               "solve with a pin");
    bench_must(sl_constraints_release(c->pins, &first, 1, NULL), "release");
    return x;
}

static double their_pinned(const changes *c, int at) {
    peer_change_delete_row(c->peer, at);
    const double x = peer_change_local(c->peer, c->near[at][0]);
    peer_change_add_row(c->peer, at);
    return x;
}

static void call_our_pin(void *state) {
    place *p = state;
    (void)our_pinned(p->c, p->next);
    p->next = (p->next + 1) % PLACES;
}

static void call_their_pin(void *state) {
    place *p = state;
    (void)their_pinned(p->c, p->next);
    p->next = (p->next + 1) % PLACES;
}

static void call_cholmod_refactor(void *state) {
    peer_cholmod_factor(((const comparison *)state)->cholmod);
}

static void call_eigen_refactor(void *state) {
    peer_eigen_factor(((const comparison *)state)->eigen);
}

/* ---- one system ---- */

static changes *changes_create(comparison *cmp) {
    const bench_system *system = cmp->system;
    changes *c = bench_alloc(1, sizeof *c);
    uint64_t rng = 77;
    memset(c, 0, sizeof *c);
    c->cmp = cmp;
    for (sl_int p = 0; p < system->A.p[1]; p++) {
        c->w = fmax(c->w, 0.1 * fabs(system->A.x[p]));
    }
    c->peer = peer_change_create(cmp->cholmod, &system->A, PREPARED);
    bench_must(sl_factor_create(&c->F, system->S, &system->A, NULL, NULL), "factor");
    bench_must(sl_constraints_create(&c->pins, c->F, NULL), "pins");
    for (int k = 0; k < PLACES; k++) {
        bench_patch near = bench_patch_create(system, bench_random_below(&rng, system->n), RANK);
        memcpy(c->near[k], near.vertices, sizeof c->near[k]);
        bench_patch_free(&near);
        peer_change_prepare(c->peer, k, c->near[k], c->near[k] + 1, 1, c->w);
        peer_change_prepare(c->peer, PLACES + k, c->near[k], NULL, RANK, c->w);
        peer_change_prepare_row(c->peer, k, c->near[k][1]);
        bench_must(sl_plan_create(&c->plan[k], system->S, c->near[k], 1, c->near[k], 1, NULL, NULL),
                   "plan");
    }
    return c;
}

static void changes_free(changes *c) {
    for (int k = 0; k < PLACES; k++) {
        sl_plan_free(c->plan[k]);
    }
    sl_constraints_free(c->pins);
    sl_factor_free(c->F);
    peer_change_free(c->peer);
    free(c);
}

/* Largest difference of the solutions of both sides, relative to the largest value. */
static double difference(const changes *c) {
    const size_t n = (size_t)c->cmp->system->n;
    double *x = c->cmp->X, *b = c->cmp->B, largest = 0, apart = 0;
    uint64_t rng = 99;
    bench_random_fill(&rng, b, n);
    bench_must(sl_factor_solve(c->F, x, n, b, n, 1, c->cmp->W), "solve");
    const double *y = peer_change_solve(c->peer, b);
    for (size_t k = 0; k < n; k++) {
        largest = fmax(largest, fabs(y[k]));
        apart = fmax(apart, fabs(x[k] - y[k]));
    }
    return largest > 0 ? apart / largest : apart;
}

/* After the same changes both sides have the same factor, and update and downdate cancel. */
static int check(bench_run *run, const changes *c) {
    double apart = 0, pinned = 0, values[2];
    for (int which = 0; which < 2; which++) {
        for (int k = 0; k < 2; k++) {
            ours(c, k, which, c->w);
            theirs(c, k, which, 1);
        }
        apart = fmax(apart, difference(c));
        for (int k = 0; k < 2; k++) {
            ours(c, k, which, -c->w);
            theirs(c, k, which, 0);
        }
        apart = fmax(apart, difference(c));
    }
    bench_must(sl_constraints_refactor(c->pins, NULL), "pins");
    for (int k = 0; k < PLACES; k++) {
        values[0] = our_pinned(c, k);
        values[1] = their_pinned(c, k);
        pinned = fmax(pinned, fabs(values[0] - values[1]) / fabs(values[1]));
    }
    return bench_expect(run, apart < 1e-9 && pinned < 1e-9 && difference(c) < 1e-9,
                        "%s: changed factors differ by %.2g, pinned solutions by %.2g",
                        c->cmp->system->name, apart, pinned);
}

/* Times our change and CHOLMOD's, and prints the further rows, which were timed before. */
static void step(bench_run *run, bench_report *report, changes *c, const char *what, int which,
                 int is_up, const timed_row *further, int n_further) {
    place places[2] = {{c, 0, which, 0, 0}, {c, 1, which, 0, 0}};
    timed_row rows[4] = {{.method = "ours"}, {.method = "CHOLMOD updown", .is_peer = 1}};
    for (int k = 0; k < 2; k++) {
        rows[k].call = is_up ? call_up : call_down;
        rows[k].ready = is_up ? ready_up : ready_down;
        rows[k].state = &places[k];
    }
    for (int k = 0; k < n_further; k++) {
        rows[2 + k] = further[k];
    }
    peers_race(run->seconds / 2, report, c->cmp, what, 0, rows, 2 + n_further, NULL, 0);
    for (int k = 0; k < 2; k++) { /* as before */
        if (places[k].is_plus) {
            change(&places[k], 0);
        }
    }
}

static void pin_step(bench_run *run, bench_report *report, changes *c) {
    place places[2] = {{c, 0, 0, 0, 0}, {c, 1, 0, 0, 0}};
    timed_row rows[2] = {{.method = "ours", .call = call_our_pin},
                         {.method = "CHOLMOD rowdel/rowadd", .call = call_their_pin, .is_peer = 1}};
    rows[0].state = &places[0];
    rows[1].state = &places[1];
    bench_must(sl_constraints_refactor(c->pins, NULL), "pins");
    peers_race(run->seconds / 2, report, c->cmp, "pin, solve, release", 0, rows, 2, NULL, 0);
}

void peers_change(bench_run *run, bench_report *report, comparison *cmp) {
    if (cmp->system->n > largest_n) {
        return;
    }
    changes *c = changes_create(cmp);
    if (check(run, c)) {
        timed_row refactor[2] = {{.method = "CHOLMOD supernodal, once", .is_peer = 1},
                                 {.method = "Eigen simplicial, once", .is_peer = 1}};
        refactor[0].sample = peers_time_once(call_cholmod_refactor, cmp);
        if (cmp->eigen) {
            refactor[1].sample = peers_time_once(call_eigen_refactor, cmp);
        }
        step(run, report, c, "edge update", 0, 1, refactor, cmp->eigen ? 2 : 1);
        step(run, report, c, "edge downdate", 0, 0, NULL, 0);
        step(run, report, c, "rank-8 update", 1, 1, NULL, 0);
        pin_step(run, report, c);
    }
    changes_free(c);
}

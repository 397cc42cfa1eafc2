/* peers_multifrontal.c: how do MUMPS's factor, solves and entries, and Scotch's orders compare? */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "peers_mumps.h"
#include "peers_steps.h"

/* MUMPS factors definite matrices as L D L' without pivoting, in the order that our analysis ended
 * with. For one vertex it gets a sparse right-hand side, which spares the forward sweep the columns
 * off the path; x is computed everywhere. Entries of the inverse are of its ICNTL(30), in the
 * fastest of three block sizes. */
enum { ENTRIES = 1000, MAX_SYSTEMS = 3 };

static const sl_int blocks[] = {16, 64, 256};
enum { BLOCKS = sizeof blocks / sizeof *blocks };

typedef struct mumps_comparison {
    comparison cmp; /* the fields that peers_race reads */
    sl_factor *F;
    peer_mumps *mumps;
    sl_plan *plan;
    sl_int vertex, nrhs, block;
    sl_int rows[ENTRIES];
    double ours[ENTRIES], theirs[ENTRIES];
} mumps_comparison;

static void refactor_call(void *state) {
    mumps_comparison *c = state;
    bench_must(sl_factor_refactor(c->F, &c->cmp.system->A, NULL), "refactor");
}

static void refactor_mumps_call(void *state) {
    peer_mumps_factor(((mumps_comparison *)state)->mumps);
}

static void solve_call(void *state) {
    mumps_comparison *c = state;
    const size_t n = (size_t)c->cmp.system->n;
    bench_must(sl_factor_solve(c->F, c->cmp.X, n, c->cmp.B, n, c->nrhs, c->cmp.W), "solve");
}

/* MUMPS solves in place: the copy is not timed. */
static void solve_mumps_ready(void *state) {
    mumps_comparison *c = state;
    memcpy(c->cmp.X, c->cmp.B, (size_t)c->cmp.system->n * (size_t)c->nrhs * sizeof *c->cmp.X);
}

static void solve_mumps_call(void *state) {
    mumps_comparison *c = state;
    peer_mumps_solve(c->mumps, c->cmp.X, c->nrhs);
}

static void vertex_call(void *state) {
    mumps_comparison *c = state;
    static const double one = 1;
    bench_must(sl_plan_solve(c->plan, c->F, c->ours, 1, &one, 1, 1, c->cmp.W), "local solve");
}

static void vertex_mumps_call(void *state) {
    mumps_comparison *c = state;
    peer_mumps_column(c->mumps, c->cmp.X, c->vertex);
}

static void entries_call(void *state) {
    mumps_comparison *c = state;
    bench_must(sl_inverse_pairs(c->F, c->ours, c->rows, c->rows, ENTRIES, c->cmp.W, NULL),
               "entries");
}

static void entries_mumps_call(void *state) {
    mumps_comparison *c = state;
    peer_mumps_diagonal(c->mumps, c->theirs, c->rows, ENTRIES, c->block);
}

static void race(bench_run *run, bench_report *report, mumps_comparison *c, const char *what,
                 void (*ours)(void *), timed_row theirs) {
    timed_row rows[2];
    memset(rows, 0, sizeof rows);
    rows[0].method = "ours";
    rows[0].call = ours;
    rows[0].state = c;
    rows[1] = theirs;
    rows[1].state = c;
    rows[1].is_peer = 1;
    (void)peers_race(run->seconds, report, &c->cmp, what, c->nrhs, rows, 2, NULL, 0);
}

/* Solves by both libraries. */
static int check_solves(bench_run *run, mumps_comparison *c) {
    solve_call(c);
    int passed = bench_check_residual(run, c->cmp.system, c->cmp.X, c->cmp.B, c->nrhs, "ours");
    solve_mumps_ready(c);
    solve_mumps_call(c);
    return passed & bench_check_residual(run, c->cmp.system, c->cmp.X, c->cmp.B, c->nrhs, "MUMPS");
}

static int check_entries(bench_run *run, mumps_comparison *c) {
    double largest = 0, difference = 0;
    entries_call(c);
    c->block = blocks[0];
    entries_mumps_call(c);
    for (int k = 0; k < ENTRIES; k++) {
        largest = fmax(largest, fabs(c->ours[k]));
        difference = fmax(difference, fabs(c->ours[k] - c->theirs[k]));
    }
    vertex_call(c);
    vertex_mumps_call(c);
    difference = fmax(difference, fabs(c->cmp.X[c->vertex] - c->ours[0]));
    return bench_expect(run, difference <= 1e-9 * largest, "%s: MUMPS's entries differ by %.2g",
                        c->cmp.system->name, difference / largest);
}

static void time_mumps(bench_run *run, bench_report *report, mumps_comparison *c) {
    static const sl_int counts[] = {1, 8, 64};
    const timed_row factor = {.method = "MUMPS", .call = refactor_mumps_call};
    const timed_row solve = {
        .method = "MUMPS", .call = solve_mumps_call, .ready = solve_mumps_ready};
    const timed_row vertex = {.method = "MUMPS, sparse b", .call = vertex_mumps_call};
    timed_row entries = {.call = entries_mumps_call};
    bench_sample best = {0, 0, 0, 0};
    race(run, report, c, "refactor", refactor_call, factor);
    for (int k = 0; k < 3; k++) {
        c->nrhs = counts[k];
        if (check_solves(run, c)) {
            race(run, report, c, "full solve", solve_call, solve);
        }
    }
    c->nrhs = 1;
    if (!check_entries(run, c)) {
        return;
    }
    race(run, report, c, "one vertex", vertex_call, vertex);
    for (int k = 0; k < BLOCKS; k++) {
        c->block = blocks[k];
        const bench_sample once = peers_time_once(entries_mumps_call, c);
        if (k == 0 || once.median < best.median) {
            best = once;
            entries.method = k == 0   ? "MUMPS, blocks of 16"
                             : k == 1 ? "MUMPS, blocks of 64"
                                      : "MUMPS, blocks of 256";
        }
    }
    entries.sample = best;
    race(run, report, c, "1000 entries", entries_call, entries);
}

/* ---- orders ---- */

static void scotch_row(bench_run *run, bench_report *report, const bench_system *system) {
    sl_int *perm = bench_alloc((size_t)system->n, sizeof *perm);
    sl_options opt;
    sl_symbolic *S[2];
    sl_stats stats[2];
    memset(&opt, 0, sizeof opt);
    bench_must(sl_symbolic_create(&S[0], &system->A, &opt, &stats[0]), "analysis");
    const double begin = bench_processor_seconds();
    peer_scotch_order(&system->A, perm);
    const double seconds = bench_processor_seconds() - begin;
    opt.ordering = SL_ORDERING_GIVEN;
    opt.perm = perm;
    bench_must(sl_symbolic_create(&S[1], &system->A, &opt, &stats[1]), "analysis");
    const timed_row rows[2] = {
        {.method = "ours", .sample = peers_one_sample(stats[0].symbolic.seconds_order)},
        {.method = "Scotch", .sample = peers_one_sample(seconds), .is_peer = 1}};
    comparison cmp;
    memset(&cmp, 0, sizeof cmp);
    cmp.system = system;
    (void)peers_report(report, &cmp, "order", 0, rows, 2, NULL, 0);
    bench_report_note(report, "%-14s   ours / Scotch: nnz(L) %.3f, mean path weight %.3f", "",
                      (double)stats[0].symbolic.nnz_l / (double)stats[1].symbolic.nnz_l,
                      bench_path_weight(S[0], NULL) / bench_path_weight(S[1], NULL));
    bench_expect(run, stats[1].symbolic.nnz_l > 0, "%s: Scotch's order is empty", system->name);
    sl_symbolic_free(S[0]);
    sl_symbolic_free(S[1]);
    free(perm);
}

static void one_system(bench_run *run, bench_report *report, const bench_system *system) {
    const size_t n = (size_t)system->n;
    mumps_comparison *c = bench_alloc(1, sizeof *c);
    uint64_t rng = 5;
    memset(c, 0, sizeof *c);
    c->cmp.system = system;
    c->F = system->F;
    c->cmp.B = bench_alloc(64 * n, sizeof *c->cmp.B);
    c->cmp.X = bench_alloc(64 * n, sizeof *c->cmp.X);
    bench_random_fill(&rng, c->cmp.B, 64 * n);
    for (sl_int k = 0; k < ENTRIES; k++) { /* different ones, ascending */
        c->rows[k] = (sl_int)((double)k / ENTRIES * system->n);
    }
    c->vertex = system->n / 2;
    bench_must(sl_work_create(&c->cmp.W, NULL), "workspace");
    bench_must(sl_plan_create(&c->plan, system->S, &c->vertex, 1, &c->vertex, 1, NULL, NULL),
               "plan");
    scotch_row(run, report, system);
    c->mumps = peer_mumps_create(&system->A, sl_symbolic_view(system->S).iperm);
    peer_mumps_factor(c->mumps);
    time_mumps(run, report, c);
    peer_mumps_free(c->mumps);
    sl_plan_free(c->plan);
    sl_work_free(c->cmp.W);
    free(c->cmp.B);
    free(c->cmp.X);
    free(c);
}

void bench_peers_multifrontal(bench_run *run) {
    static const double wanted[] = {1e4, 1e5};
    const bench_system *systems[MAX_SYSTEMS];
    int count = bench_systems(run, wanted, run->size == BENCH_QUICK ? 1 : 2, systems);
    bench_report *report =
        bench_report_open(run, "peers_multifrontal",
                          "MUMPS in our order: factor, solves, entries; orders of Scotch", "ours");
    peer_cholmod_threads(1); /* of OpenBLAS, which MUMPS calls, too */
    if (!run->mesh_path) {
        systems[count++] = bench_volume(run->size == BENCH_QUICK ? 20 : 40);
    }
    for (int k = 0; k < count; k++) {
        one_system(run, report, systems[k]);
    }
    bench_report_close(report);
}

/* several.c: what do M + t L cost for eight t at once: factors, one plan on all of them, a signature of 1000 vertices? */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "family.h"

/* The baseline of the factors is eight refactorizations of matrices that were summed beforehand, for which nobody counted
 * the time; whoever sums by hand pays that too, and who has one call that analyses and factors pays the ordering eight
 * times. Plans and signatures have single calls as their baseline. Times are those of all eight. */
enum { VERTICES = 1000, PATCH = 1000, THREADS = 2, ASKED = 32, MOST_WAYS = 8 };

typedef struct questions {
    family f;
    sl_factor *made[FAMILY_TIMES]; /* with memory of their own, in every call */
    double *spread;
    sl_plan *plan; /* from the boundary of a patch to all of it */
    double *B, *X, *wanted;
    sl_request requests[FAMILY_TIMES];
    sl_int rows[VERTICES];
    double *diagonals, *again; /* VERTICES x FAMILY_TIMES */
    sl_work *works[THREADS];
} questions;

/* ---- contenders; state is the questions ---- */

static void call_summed_before(void *state) {
    family_call_summed_before(&((questions *)state)->f);
}

static void call_summed_by_hand(void *state) {
    family_call_summed_by_hand(&((questions *)state)->f);
}

static void call_one_by_one(void *state) {
    family_call_one_by_one(&((questions *)state)->f);
}

static void call_batch(void *state) {
    family_call_batch(&((questions *)state)->f);
}

static void made_free(void *state) {
    questions *q = state;
    for (int k = 0; k < FAMILY_TIMES; k++) {
        sl_factor_free(q->made[k]);
        q->made[k] = NULL;
    }
}

static void call_batch_made(void *state) {
    questions *q = state;
    sl_options options;
    memset(&options, 0, sizeof options);
    options.threads = q->f.threads;
    bench_must(sl_batch_factor(q->made, FAMILY_TIMES, q->f.system->S, q->f.c, family_values(&q->f),
                               FAMILY_TERMS, &options, NULL, NULL),
               "factor a batch");
}

static void call_each_anew(void *state) {
    questions *q = state;
    sl_csc A = q->f.system->A;
    for (int k = 0; k < FAMILY_TIMES; k++) {
        sl_symbolic *S = NULL;
        sl_factor *F = NULL;
        A.x = q->f.sums[k];
        bench_must(sl_symbolic_create(&S, &A, NULL, NULL), "analysis");
        bench_must(sl_factor_create(&F, S, &A, NULL, NULL), "factor");
        sl_factor_free(F);
        sl_symbolic_free(S);
    }
}

static void call_spread(void *state) {
    questions *q = state;
    bench_must(sl_symbolic_spread(q->f.system->S, q->spread, &q->f.M, NULL), "spread");
    bench_must(sl_symbolic_spread(q->f.system->S, q->spread, &q->f.L, NULL), "spread");
}

static void call_plan_each(void *state) {
    questions *q = state;
    for (int k = 0; k < FAMILY_TIMES; k++) {
        const sl_request *r = &q->requests[k];
        bench_must(
            sl_plan_solve(q->plan, r->factor, r->X, r->ldx, r->B, r->ldb, r->nrhs, q->works[0]),
            "plan solve");
    }
}

static void call_plan_batch(void *state) {
    questions *q = state;
    bench_must(sl_batch_solve(NULL, q->requests, FAMILY_TIMES, &q->f.threads, q->works, NULL),
               "batch");
}

static void call_diagonal_each(void *state) {
    questions *q = state;
    for (int k = 0; k < FAMILY_TIMES; k++) {
        bench_must(sl_inverse_diagonal(q->f.F[k], q->diagonals + VERTICES * k, q->rows, VERTICES,
                                       q->works[0], NULL),
                   "diagonal");
    }
}

static void call_diagonal_batch(void *state) {
    questions *q = state;
    bench_must(sl_batch_diagonal(family_factors(&q->f), FAMILY_TIMES, q->diagonals, VERTICES,
                                 q->rows, VERTICES, &q->f.threads, q->works, NULL, NULL),
               "diagonals");
}

/* ---- what is asked ---- */

static void questions_make(questions *q, const bench_system *system, const bench_patch *patch) {
    const size_t nb = (size_t)patch->n_boundary, nx = (size_t)patch->size;
    uint64_t chance = 31;
    memset(q, 0, sizeof *q);
    family_make(&q->f, system);
    q->spread = bench_alloc((size_t)sl_symbolic_entries(system->S), sizeof(double));
    bench_must(sl_plan_create(&q->plan, system->S, patch->boundary, patch->n_boundary,
                              patch->vertices, patch->size, NULL, NULL),
               "plan");
    q->B = bench_alloc(nb, sizeof *q->B);
    q->X = bench_alloc(nx * FAMILY_TIMES, sizeof *q->X);
    q->wanted = bench_alloc(nx * FAMILY_TIMES, sizeof *q->wanted);
    bench_random_fill(&chance, q->B, nb);
    for (int k = 0; k < FAMILY_TIMES; k++) {
        sl_request *r = &q->requests[k];
        r->plan = q->plan;
        r->factor = q->f.F[k];
        r->X = q->X + nx * (size_t)k;
        r->ldx = nx;
        r->B = q->B;
        r->ldb = nb;
        r->nrhs = 1;
    }
    for (int k = 0; k < VERTICES; k++) {
        q->rows[k] = bench_random_below(&chance, system->n);
    }
    q->diagonals = bench_alloc((size_t)VERTICES * FAMILY_TIMES, sizeof(double));
    q->again = bench_alloc((size_t)VERTICES * FAMILY_TIMES, sizeof(double));
    for (int k = 0; k < THREADS; k++) {
        bench_must(sl_work_create(&q->works[k], NULL), "workspace");
    }
}

static void questions_free(questions *q) {
    made_free(q);
    for (int k = 0; k < THREADS; k++) {
        sl_work_free(q->works[k]);
    }
    sl_plan_free(q->plan);
    free(q->spread);
    free(q->B);
    free(q->X);
    free(q->wanted);
    free(q->diagonals);
    free(q->again);
    family_free(&q->f);
}

/* Batches give the bits of single calls; the signatures are what local solves give, to 1e-9 of themselves. */
static int check_answers(bench_run *run, questions *q, sl_int patch) {
    const size_t size = (size_t)patch * FAMILY_TIMES, all = (size_t)VERTICES * FAMILY_TIMES;
    const char *name = q->f.system->name;
    int good = 1;
    call_plan_each(q);
    memcpy(q->wanted, q->X, size * sizeof *q->X);
    memset(q->X, 0, size * sizeof *q->X);
    call_plan_batch(q);
    good &= bench_expect(run, memcmp(q->wanted, q->X, size * sizeof *q->X) == 0,
                         "%s: plans in a batch differ from plans alone", name);
    call_diagonal_each(q);
    memcpy(q->again, q->diagonals, all * sizeof *q->again);
    memset(q->diagonals, 0, all * sizeof *q->diagonals);
    call_diagonal_batch(q);
    good &= bench_expect(run, memcmp(q->again, q->diagonals, all * sizeof *q->again) == 0,
                         "%s: diagonals in a batch differ from diagonals alone", name);
    for (int k = 0; k < ASKED; k++) {
        const int t = k % FAMILY_TIMES;
        const sl_int *row = &q->rows[k];
        const double one = 1, got = q->diagonals[VERTICES * t + k];
        double x;
        bench_must(sl_local_solve(q->f.F[t], &x, 1, row, 1, &one, 1, row, 1, 1, NULL, NULL),
                   "local solve");
        good &= bench_expect(run, fabs(got - x) <= 1e-9 * fabs(x),
                             "%s: entry %d of the signature is %.17g instead of %.17g", name,
                             (int)*row, got, x);
    }
    return good;
}

/* ---- rows ---- */

/* A way, and the threads it has while it is timed. */
typedef struct way {
    const char *method;
    void (*call)(void *state);
    void (*ready)(void *state);
    questions *q;
    sl_int threads;
} way;

static void way_call(void *state) {
    way *w = state;
    w->q->f.threads = bench_threads(w->threads);
    w->call(w->q);
}

static void way_ready(void *state) {
    way *w = state;
    if (w->ready) {
        w->ready(w->q);
    }
}

/* Races them, with a row each. Those with threads race among themselves: what OpenMP's threads do between two calls would
 * meet the others. flops: of one factorization, or 0. Returns the baseline, by default the first one's median. */
static double race(bench_report *report, questions *q, const char *what, const way *ways, int count,
                   sl_int threads, double flops, double seconds, double baseline) {
    bench_contender contenders[MOST_WAYS];
    bench_sample samples[MOST_WAYS];
    way now[MOST_WAYS];
    for (int k = 0; k < count; k++) {
        now[k] = ways[k];
        now[k].q = q;
        now[k].threads = threads;
        contenders[k] = (bench_contender){way_call, &now[k], 1, way_ready};
    }
    bench_race(samples, contenders, count, seconds);
    baseline = baseline > 0 ? baseline : samples[0].median;
    for (int k = 0; k < count; k++) {
        bench_row row = {.what = what,
                         .method = ways[k].method,
                         .threads = threads,
                         .flops = FAMILY_TIMES * flops,
                         .time = samples[k],
                         .baseline = baseline};
        bench_report_row(report, q->f.system, &row);
    }
    return baseline;
}

/* Once: it takes seconds. */
static void time_each_anew(bench_report *report, questions *q, double baseline) {
    const double start = bench_now();
    call_each_anew(q);
    const double seconds = bench_now() - start;
    bench_row row = {.what = "8 factors",
                     .method = "analyse, factor each; once",
                     .time = {1, seconds, seconds, seconds},
                     .baseline = baseline};
    bench_report_row(report, q->f.system, &row);
}

static void one_system(bench_run *run, bench_report *report, const bench_system *system) {
    static const way factors[] = {
        {"refactor, summed before", call_summed_before, NULL, NULL, 1},
        {"refactor, summed by hand", call_summed_by_hand, NULL, NULL, 1},
        {"combination, one by one", call_one_by_one, NULL, NULL, 1},
        {"batch refactor", call_batch, NULL, NULL, 1},
        {"batch factor, its memory", call_batch_made, made_free, NULL, 1}};
    static const way spread[] = {{"spread M and L", call_spread, NULL, NULL, 1}};
    static const way plans[] = {{"plan solves", call_plan_each, NULL, NULL, 1},
                                {"batch", call_plan_batch, NULL, NULL, 1}};
    static const way signatures[] = {{"diagonals, one by one", call_diagonal_each, NULL, NULL, 1},
                                     {"batch", call_diagonal_batch, NULL, NULL, 1}};
    bench_patch patch = bench_patch_create(system, system->n / 2, PATCH);
    questions *q = bench_alloc(1, sizeof *q);
    const double flops = system->stats.flops, seconds = run->seconds;
    questions_make(q, system, &patch);
    if (family_check(run, &q->f) && check_answers(run, q, patch.size)) {
        double baseline = race(report, q, "8 factors", factors, 5, 1, flops, 4 * seconds, 0);
        race(report, q, "8 factors", factors + 3, 2, THREADS, flops, 2 * seconds, baseline);
        made_free(q);
        race(report, q, "8 factors", spread, 1, 1, 0, seconds / 4, baseline);
        time_each_anew(report, q, baseline);
        baseline = race(report, q, "one plan on 8", plans, 2, 1, 0, seconds, 0);
        race(report, q, "one plan on 8", plans + 1, 1, THREADS, 0, seconds, baseline);
        baseline = race(report, q, "signatures", signatures, 2, 1, 0, seconds, 0);
        race(report, q, "signatures", signatures + 1, 1, THREADS, 0, seconds, baseline);
    }
    questions_free(q);
    free(q);
    bench_patch_free(&patch);
}

void bench_several(bench_run *run) {
    static const double wanted[] = {1e4, 1e5, 2e5};
    const bench_system *systems[4];
    int count = bench_systems(run, wanted, run->size == BENCH_FULL ? 3 : 2, systems);
    bench_report *report = bench_report_open(
        run, "several",
        "M + t L for eight t: factors, one plan on all, signatures of 1000 vertices",
        "8 refactorizations; else the first row of the case");
    for (int k = 0; k < count; k++) {
        one_system(run, report, systems[k]);
    }
    if (!run->mesh_path) {
        one_system(run, report, bench_volume(run->size == BENCH_QUICK ? 20 : 30));
    }
    bench_report_close(report);
}

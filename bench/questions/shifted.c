/* shifted.c: what do factors, plans and signatures of M + t L cost for eight t at once? */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "bench/lib/shifted_systems.h"

/* The baseline of the factors is eight refactorizations of matrices summed beforehand, whose
 * summation is not counted. Summing by hand adds that time; analyzing and factoring each matrix
 * from scratch pays for the ordering eight times. Plans have single calls as their
 * baseline. Times are those of all eight. */
enum { VERTICES = 1000, PATCH = 1000, THREADS = 2, CHECKED = 32, MAX_VARIANTS = 8 };

typedef struct workload {
    shifted_systems f;
    sl_factor *made[SHIFTED_COUNT]; /* allocated in every call */
    double *scatter;
    sl_plan *plan; /* b on the boundary of a patch, x on the whole patch */
    double *B, *X, *wanted;
    sl_request requests[SHIFTED_COUNT];
    sl_int rows[VERTICES];
    double *diagonals; /* VERTICES x SHIFTED_COUNT */
    sl_work *works[THREADS];
} workload;

/* ---- contenders; state is a workload * ---- */

static void call_presummed(void *state) {
    shifted_call_presummed(&((workload *)state)->f);
}

static void call_summed_by_hand(void *state) {
    shifted_call_summed_by_hand(&((workload *)state)->f);
}

static void call_one_by_one(void *state) {
    shifted_call_one_by_one(&((workload *)state)->f);
}

static void call_batch(void *state) {
    shifted_call_batch(&((workload *)state)->f);
}

static void made_free(void *state) {
    workload *q = state;
    for (int k = 0; k < SHIFTED_COUNT; k++) {
        sl_factor_free(q->made[k]);
        q->made[k] = NULL;
    }
}

static void call_batch_made(void *state) {
    workload *q = state;
    sl_options options;
    memset(&options, 0, sizeof options);
    options.threads = q->f.threads;
    bench_must(sl_factor_create_sums(q->made, SHIFTED_COUNT, q->f.system->S, q->f.c,
                                     shifted_systems_values(&q->f), SHIFTED_TERMS, &options, NULL,
                                     NULL),
               "factor a batch");
}

static void call_each_from_scratch(void *state) {
    workload *q = state;
    sl_csc A = q->f.system->A;
    for (int k = 0; k < SHIFTED_COUNT; k++) {
        sl_symbolic *S = NULL;
        sl_factor *F = NULL;
        A.x = q->f.sums[k];
        bench_must(sl_symbolic_create(&S, &A, NULL, NULL), "analysis");
        bench_must(sl_factor_create(&F, S, &A, NULL, NULL), "factor");
        sl_factor_free(F);
        sl_symbolic_free(S);
    }
}

static void call_scatter(void *state) {
    workload *q = state;
    bench_must(sl_symbolic_scatter(q->f.system->S, q->scatter, &q->f.M, NULL), "scatter");
    bench_must(sl_symbolic_scatter(q->f.system->S, q->scatter, &q->f.L, NULL), "scatter");
}

static void call_plan_each(void *state) {
    workload *q = state;
    for (int k = 0; k < SHIFTED_COUNT; k++) {
        const sl_request *r = &q->requests[k];
        bench_must(
            sl_plan_solve(q->plan, r->factor, r->X, r->ldx, r->B, r->ldb, r->nrhs, q->works[0]),
            "plan solve");
    }
}

static void call_plan_batch(void *state) {
    workload *q = state;
    sl_options options = {.threads = q->f.threads};
    bench_must(sl_batch_solve(NULL, q->requests, SHIFTED_COUNT, &options, q->works, NULL), "batch");
}

static void call_diagonal_each(void *state) {
    workload *q = state;
    for (int k = 0; k < SHIFTED_COUNT; k++) {
        bench_must(sl_inverse_diagonal(q->f.F[k], q->diagonals + VERTICES * k, q->rows, VERTICES,
                                       q->works[0], NULL),
                   "diagonal");
    }
}

/* ---- sets, values and checks ---- */

static void workload_create(workload *q, const bench_system *system, const bench_patch *patch) {
    const size_t nb = (size_t)patch->n_boundary, nx = (size_t)patch->size;
    uint64_t rng = 31;
    memset(q, 0, sizeof *q);
    shifted_systems_make(&q->f, system);
    q->scatter = bench_alloc((size_t)system->stats.symbolic.nnz_a, sizeof(double));
    bench_must(sl_plan_create(&q->plan, system->S, patch->boundary, patch->n_boundary,
                              patch->vertices, patch->size, NULL, NULL),
               "plan");
    q->B = bench_alloc(nb, sizeof *q->B);
    q->X = bench_alloc(nx * SHIFTED_COUNT, sizeof *q->X);
    q->wanted = bench_alloc(nx * SHIFTED_COUNT, sizeof *q->wanted);
    bench_random_fill(&rng, q->B, nb);
    for (int k = 0; k < SHIFTED_COUNT; k++) {
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
        q->rows[k] = bench_random_below(&rng, system->n);
    }
    q->diagonals = bench_alloc((size_t)VERTICES * SHIFTED_COUNT, sizeof(double));
    for (int k = 0; k < THREADS; k++) {
        bench_must(sl_work_create(&q->works[k], NULL), "workspace");
    }
}

static void workload_free(workload *q) {
    made_free(q);
    for (int k = 0; k < THREADS; k++) {
        sl_work_free(q->works[k]);
    }
    sl_plan_free(q->plan);
    free(q->scatter);
    free(q->B);
    free(q->X);
    free(q->wanted);
    free(q->diagonals);
    shifted_systems_free(&q->f);
}

/* Checks that batches equal single calls bit for bit, and that the signatures equal local
 * solves, with relative error 1e-9. */
static int check_answers(bench_run *run, workload *q, sl_int patch) {
    const size_t size = (size_t)patch * SHIFTED_COUNT;
    const char *name = q->f.system->name;
    int passed = 1;
    call_plan_each(q);
    memcpy(q->wanted, q->X, size * sizeof *q->X);
    memset(q->X, 0, size * sizeof *q->X);
    call_plan_batch(q);
    passed &= bench_expect(run, memcmp(q->wanted, q->X, size * sizeof *q->X) == 0,
                           "%s: plan solves in a batch differ from single calls", name);
    call_diagonal_each(q);
    for (int k = 0; k < CHECKED; k++) {
        const int t = k % SHIFTED_COUNT;
        const sl_int *row = &q->rows[k];
        const double one = 1, got = q->diagonals[VERTICES * t + k];
        double x;
        bench_must(sl_local_solve(q->f.F[t], row, 1, row, 1, &x, 1, &one, 1, 1, NULL, NULL),
                   "local solve");
        passed &= bench_expect(run, fabs(got - x) <= 1e-9 * fabs(x),
                               "%s: entry %d of the signature is %.17g instead of %.17g", name,
                               (int)*row, got, x);
    }
    return passed;
}

/* ---- rows ---- */

/* A variant, and the threads it uses while it is timed. */
typedef struct variant {
    const char *method;
    void (*call)(void *state);
    void (*ready)(void *state);
    workload *q;
    sl_int threads;
} variant;

static void variant_call(void *state) {
    variant *w = state;
    w->q->f.threads = bench_threads(w->threads);
    w->call(w->q);
}

static void variant_ready(void *state) {
    variant *w = state;
    if (w->ready) {
        w->ready(w->q);
    }
}

/* Times the variants and prints a row for each. Variants with threads are timed among
 * themselves, because the waiting threads of OpenMP would disturb the others. flops: of one
 * factorization, or 0. Returns the baseline; 0 means the median of the first variant. */
static double race(bench_report *report, workload *q, const char *what, const variant *variants,
                   int count, sl_int threads, double flops, double seconds, double baseline) {
    bench_contender contenders[MAX_VARIANTS] = {{NULL, NULL, 0, NULL}};
    bench_sample samples[MAX_VARIANTS];
    variant now[MAX_VARIANTS];
    for (int k = 0; k < count; k++) {
        now[k] = variants[k];
        now[k].q = q;
        now[k].threads = threads;
        contenders[k] = (bench_contender){variant_call, &now[k], 1, variant_ready};
    }
    bench_race(samples, contenders, count, seconds);
    baseline = baseline > 0 ? baseline : samples[0].median;
    for (int k = 0; k < count; k++) {
        bench_row row = {.what = what,
                         .method = variants[k].method,
                         .threads = threads,
                         .flops = SHIFTED_COUNT * flops,
                         .time = samples[k],
                         .baseline = baseline};
        bench_report_row(report, q->f.system, &row);
    }
    return baseline;
}

/* Timed once: it takes seconds. */
static void time_each_from_scratch(bench_report *report, workload *q, double baseline) {
    const double start = bench_now();
    call_each_from_scratch(q);
    const double seconds = bench_now() - start;
    bench_row row = {.what = "8 factors",
                     .method = "analyze, factor each; once",
                     .time = {1, seconds, seconds, seconds},
                     .baseline = baseline};
    bench_report_row(report, q->f.system, &row);
}

static void one_system(bench_run *run, bench_report *report, const bench_system *system) {
    static const variant factors[] = {
        {"refactor, presummed", call_presummed, NULL, NULL, 1},
        {"refactor, summed by hand", call_summed_by_hand, NULL, NULL, 1},
        {"combination, one by one", call_one_by_one, NULL, NULL, 1},
        {"batch refactor", call_batch, NULL, NULL, 1},
        {"batch factor, allocating", call_batch_made, made_free, NULL, 1}};
    static const variant scatter[] = {{"scatter M and L", call_scatter, NULL, NULL, 1}};
    static const variant plans[] = {{"plan solves", call_plan_each, NULL, NULL, 1},
                                    {"batch", call_plan_batch, NULL, NULL, 1}};
    static const variant signatures[] = {
        {"diagonals, one by one", call_diagonal_each, NULL, NULL, 1}};
    bench_patch patch = bench_patch_create(system, system->n / 2, PATCH);
    workload *q = bench_alloc(1, sizeof *q);
    const double flops = system->stats.symbolic.flops, seconds = run->seconds;
    workload_create(q, system, &patch);
    if (shifted_systems_check(run, &q->f) && check_answers(run, q, patch.size)) {
        double baseline = race(report, q, "8 factors", factors, 5, 1, flops, 4 * seconds, 0);
        race(report, q, "8 factors", factors + 3, 2, THREADS, flops, 2 * seconds, baseline);
        made_free(q);
        race(report, q, "8 factors", scatter, 1, 1, 0, seconds / 4, baseline);
        time_each_from_scratch(report, q, baseline);
        baseline = race(report, q, "one plan on 8", plans, 2, 1, 0, seconds, 0);
        race(report, q, "one plan on 8", plans + 1, 1, THREADS, 0, seconds, baseline);
        race(report, q, "signatures", signatures, 1, 1, 0, seconds, 0);
    }
    workload_free(q);
    free(q);
    bench_patch_free(&patch);
}

void bench_shifted(bench_run *run) {
    static const double wanted[] = {1e4, 1e5, 2e5};
    const bench_system *systems[4];
    int count = bench_systems(run, wanted, run->size == BENCH_FULL ? 3 : 2, systems);
    bench_report *report = bench_report_open(
        run, "shifted",
        "M + t L for eight t: factors, one plan on all, signatures of 1000 vertices",
        "8 refactorizations, else the first row of the case");
    for (int k = 0; k < count; k++) {
        one_system(run, report, systems[k]);
    }
    if (!run->mesh_path) {
        one_system(run, report, bench_volume(run->size == BENCH_QUICK ? 20 : 30));
    }
    bench_report_close(report);
}

/* inverse_entries.c: do forward sweeps compute entries of the inverse faster than solves? */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "bench/lib/bench.h"

/* Random pairs as in [HDA17] section 5, random diagonal entries, and a dense block on random
 * vertices and on those of a patch. Times are per entry, for a block those of the whole block.
 * Local solves find their reach in every call, except for the diagonal, where plans made
 * beforehand compete. A list of entries is computed by forward sweeps that share columns, or on
 * a small mesh by selected inversion. */
enum { METHODS = 4, CHECKED = 8, BLOCK = 128 };

typedef struct entries {
    const bench_system *system;
    sl_work *W;
    int count, is_block;
    sl_int *rows, *columns; /* the same array for the diagonal or a symmetric block */
    double *out;            /* count, or count x count */
    double *unit;           /* for a block: count x count, the identity */
    sl_plan **plans;        /* for the diagonal */
    sl_stats stats;
    double read; /* entries of L read by all sweeps of the last call */
} entries;

static void joint_reach(void *state) {
    entries *e = state;
    const double b[2] = {1, 0};
    double x[2];
    e->read = 0;
    for (int k = 0; k < e->count; k++) {
        const sl_int set[2] = {e->rows[k], e->columns[k]};
        const sl_int size = set[0] == set[1] ? 1 : 2;
        bench_must(
            sl_local_solve(e->system->F, set, size, set, size, x, 2, b, 2, 1, e->W, &e->stats),
            "joint reach");
        e->out[k] = x[size - 1];
        e->read += (double)e->stats.plan.b_entries + (double)e->stats.plan.x_entries;
    }
}

static void separate_reaches(void *state) {
    entries *e = state;
    const double b = 1;
    e->read = 0;
    for (int k = 0; k < e->count; k++) {
        bench_must(sl_local_solve(e->system->F, e->rows + k, 1, e->columns + k, 1, e->out + k, 1,
                                  &b, 1, 1, e->W, &e->stats),
                   "separate reaches");
        e->read += (double)e->stats.plan.b_entries + (double)e->stats.plan.x_entries;
    }
}

static void planned(void *state) {
    entries *e = state;
    const double b = 1;
    e->read = 0;
    for (int k = 0; k < e->count; k++) {
        bench_must(sl_plan_solve(e->plans[k], e->system->F, e->out + k, 1, &b, 1, 1, e->W), "plan");
        sl_plan_stats(e->plans[k], &e->stats);
        e->read += (double)e->stats.plan.b_entries + (double)e->stats.plan.x_entries;
    }
}

static void forward_one_by_one(void *state) {
    entries *e = state;
    e->read = 0;
    for (int k = 0; k < e->count; k++) {
        bench_must(sl_inverse_pairs(e->system->F, e->out + k, e->rows + k, e->columns + k, 1, e->W,
                                    &e->stats),
                   "one pair");
        e->read += (double)e->stats.inverse.entries;
    }
}

static void forward_list(void *state) {
    entries *e = state;
    bench_must(
        sl_inverse_pairs(e->system->F, e->out, e->rows, e->columns, e->count, e->W, &e->stats),
        "pairs");
    e->read = (double)e->stats.inverse.entries;
}

static void block_solve(void *state) {
    entries *e = state;
    const size_t ld = (size_t)e->count;
    bench_must(sl_local_solve(e->system->F, e->columns, e->count, e->rows, e->count, e->out, ld,
                              e->unit, ld, e->count, e->W, &e->stats),
               "block");
    e->read =
        ((double)e->stats.plan.b_entries + (double)e->stats.plan.x_entries) * ((e->count + 7) / 8);
}

static void block_forward(void *state) {
    entries *e = state;
    bench_must(sl_inverse_block(e->system->F, e->out, (size_t)e->count, e->rows, e->count,
                                e->columns, e->count, e->W, &e->stats),
               "block");
    e->read = (double)e->stats.inverse.entries;
}

/* Checks the first few entries against full solves, to 1e-12 of the column's largest entry. */
static int check(bench_run *run, entries *e, const bench_contender *c, const char *method) {
    const size_t n = (size_t)e->system->n, size = (size_t)e->count;
    double *b = bench_alloc(n, sizeof *b), *x = bench_alloc(n, sizeof *x);
    int passed = 1;
    memset(e->out, 0, (e->is_block ? size * size : size) * sizeof *e->out);
    c->call(e);
    for (int k = 0; k < CHECKED && k < e->count && passed; k++) {
        double largest = 0, error = 0;
        memset(b, 0, n * sizeof *b);
        b[e->columns[k]] = 1;
        bench_must(sl_factor_solve(e->system->F, x, n, b, n, 1, NULL), "full solve");
        passed &= bench_check_residual(run, e->system, x, b, 1, "full solve");
        for (size_t i = 0; i < n; i++) {
            largest = fmax(largest, fabs(x[i]));
        }
        for (int i = e->is_block ? 0 : k; i < (e->is_block ? e->count : k + 1); i++) {
            const double value = e->is_block ? e->out[(size_t)k * size + (size_t)i] : e->out[i];
            error = fmax(error, fabs(value - x[e->rows[i]]));
        }
        passed &= bench_expect(run, error <= 1e-12 * largest, "%s, %s: error %.2g, largest %.2g",
                               e->system->name, method, error, largest);
    }
    free(x);
    free(b);
    return passed;
}

/* Checks and times the methods; the last one is the baseline. */
static void race(bench_run *run, bench_report *report, entries *e, const char *what,
                 void (*const *calls)(void *), const char *const *names, int count) {
    bench_contender contenders[METHODS] = {{NULL, NULL, 0, NULL}};
    bench_sample samples[METHODS];
    double read[METHODS];
    const double each = e->is_block ? 1 : e->count;
    for (int c = 0; c < count; c++) {
        contenders[c] = (bench_contender){calls[c], e, 1, NULL};
        if (!check(run, e, &contenders[c], names[c])) {
            return;
        }
        read[c] = e->read;
    }
    bench_race(samples, contenders, count, run->seconds);
    for (int c = count - 1; c >= 0; c--) {
        bench_row row = {.what = what, .method = names[c], .nrhs = 1, .time = samples[c]};
        row.time.min /= each;
        row.time.median /= each;
        row.time.max /= each;
        row.entries = read[c] / each;
        row.baseline = samples[count - 1].median / each;
        bench_report_row(report, e->system, &row);
    }
}

static entries entries_create(const bench_system *system, int count, int is_block) {
    entries e;
    const size_t size = (size_t)count;
    memset(&e, 0, sizeof e);
    e.system = system;
    e.count = count;
    e.is_block = is_block;
    e.rows = bench_alloc(size, sizeof *e.rows);
    e.columns = e.rows;
    e.out = bench_alloc(is_block ? size * size : size, sizeof *e.out);
    bench_must(sl_work_create(&e.W, NULL), "workspace");
    return e;
}

static void draw(sl_int *rows, int count, sl_int n, uint64_t *rng) {
    for (int k = 0; k < count; k++) {
        rows[k] = bench_random_below(rng, n);
    }
}

static void entries_free(entries *e) {
    for (int k = 0; e->plans && k < e->count; k++) {
        sl_plan_free(e->plans[k]);
    }
    if (e->columns != e->rows) {
        free(e->columns);
    }
    sl_work_free(e->W);
    free(e->plans);
    free(e->unit);
    free(e->out);
    free(e->rows);
}

static void pairs(bench_run *run, bench_report *report, const bench_system *system) {
    static void (*const calls[])(void *) = {joint_reach, separate_reaches, forward_one_by_one,
                                            forward_list};
    static const char *const names[] = {"joint reach", "separate reaches", "forward, one by one",
                                        "one list"};
    entries e = entries_create(system, run->size == BENCH_QUICK ? 1000 : 10000, 0);
    uint64_t rng = 2017;
    e.columns = bench_alloc((size_t)e.count, sizeof *e.columns);
    draw(e.rows, e.count, system->n, &rng);
    draw(e.columns, e.count, system->n, &rng);
    race(run, report, &e, "random pairs", calls, names, 4);
    entries_free(&e);
}

static void diagonal(bench_run *run, bench_report *report, const bench_system *system) {
    static void (*const calls[])(void *) = {joint_reach, planned, forward_one_by_one, forward_list};
    static const char *const names[] = {"one shot", "plan solve", "forward, one by one",
                                        "one list"};
    entries e = entries_create(system, run->size == BENCH_QUICK ? 200 : 1000, 0);
    uint64_t rng = 4711;
    draw(e.rows, e.count, system->n, &rng);
    e.plans = bench_alloc((size_t)e.count, sizeof *e.plans);
    for (int k = 0; k < e.count; k++) {
        bench_must(sl_plan_create(&e.plans[k], system->S, e.rows + k, 1, e.rows + k, 1, NULL, NULL),
                   "plan");
    }
    race(run, report, &e, "diagonal", calls, names, 4);
    entries_free(&e);
}

static void block(bench_run *run, bench_report *report, const bench_system *system,
                  const bench_patch *patch) {
    static void (*const calls[])(void *) = {block_solve, block_forward};
    static const char *const names[] = {"local solve", "forward"};
    entries e = entries_create(system, BLOCK, 1);
    uint64_t rng = 31;
    e.unit = bench_alloc(BLOCK * BLOCK, sizeof *e.unit);
    memset(e.unit, 0, BLOCK * BLOCK * sizeof *e.unit);
    char *drawn = bench_alloc((size_t)system->n, 1);
    memset(drawn, 0, (size_t)system->n);
    for (int k = 0; k < BLOCK; k++) {
        e.unit[k * (BLOCK + 1)] = 1;
        do { /* a set without duplicates */
            e.rows[k] = patch ? patch->vertices[k] : bench_random_below(&rng, system->n);
        } while (drawn[e.rows[k]]);
        drawn[e.rows[k]] = 1;
    }
    free(drawn);
    race(run, report, &e, patch ? "patch 128^2" : "random 128^2", calls, names, 2);
    entries_free(&e);
}

void bench_inverse_entries(bench_run *run) {
    static const double default_n = 2e5, quick_n = 5e4;
    const bench_system *system;
    if (bench_systems(run, run->size == BENCH_QUICK ? &quick_n : &default_n, 1, &system) == 1) {
        bench_report *report = bench_report_open(
            run, "inverse_entries", "entries of the inverse by forward sweeps alone", "one list");
        bench_patch patch;
        diagonal(run, report, system);
        pairs(run, report, system);
        if (system->n > 2 * BLOCK) {
            block(run, report, system, NULL);
        }
        if (bench_patch_pick(&patch, 1, system, BLOCK) == 1) {
            block(run, report, system, &patch);
            bench_patch_free(&patch);
        }
        bench_report_close(report);
    }
}

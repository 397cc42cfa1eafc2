/* queries.c: local solves on a plan, with plan creation, in one call, and as full solves */
#include <stdlib.h>
#include <string.h>

#include "bench.h"

bench_queries *bench_queries_create(const bench_system *system, int room, sl_int nrhs) {
    bench_queries *q = bench_alloc(1, sizeof *q);
    memset(q, 0, sizeof *q);
    q->system = system;
    q->nrhs = nrhs;
    q->room = room;
    q->all = bench_alloc((size_t)room, sizeof *q->all);
    size_t full = (size_t)system->n * (size_t)nrhs;
    q->B_full = bench_alloc(full, sizeof *q->B_full);
    q->X_full = bench_alloc(full, sizeof *q->X_full);
    memset(q->B_full, 0, full * sizeof *q->B_full);
    memset(q->X_full, 0, full * sizeof *q->X_full);
    bench_must(sl_work_create(&q->W, NULL), "workspace");
    return q;
}

static sl_int *copy_set(const sl_int *set, sl_int count) {
    sl_int *copy = bench_alloc((size_t)count, sizeof *copy);
    memcpy(copy, set, (size_t)count * sizeof *copy);
    return copy;
}

/* Writes the values of B of one query into the full right-hand side, or zeros in their places. */
static void scatter_values(bench_queries *q, const bench_query *one, int values) {
    size_t n = (size_t)q->system->n;
    for (sl_int r = 0; r < q->nrhs; r++) {
        for (sl_int k = 0; k < one->nb; k++) {
            q->B_full[(size_t)r * n + (size_t)one->bset[k]] =
                values ? one->B[(size_t)r * (size_t)one->nb + (size_t)k] : 0;
        }
    }
}

void bench_queries_add(bench_queries *q, const sl_int *bset, sl_int nb, const sl_int *xset,
                       sl_int nx) {
    if (q->count == q->room) {
        bench_must(SL_ERR_TOO_LARGE, "adding a query");
    }
    bench_query *one = &q->all[q->count];
    uint64_t rng = 1000003u + (uint64_t)q->count;
    memset(one, 0, sizeof *one);
    one->nb = nb;
    one->nx = nx;
    one->bset = copy_set(bset, nb);
    one->xset = copy_set(xset, nx);
    one->B = bench_alloc((size_t)nb * (size_t)q->nrhs, sizeof *one->B);
    one->X = bench_alloc((size_t)nx * (size_t)q->nrhs, sizeof *one->X);
    bench_random_fill(&rng, one->B, (size_t)nb * (size_t)q->nrhs);
    bench_must(sl_plan_create(&one->plan, q->system->S, bset, nb, xset, nx, NULL, &one->reach),
               "plan");
    if (q->count++ == 0) {
        scatter_values(q, one, 1);
    }
}

bench_queries *bench_queries_vertices(const bench_system *system, int room, sl_int nrhs) {
    bench_queries *q = bench_queries_create(system, room, nrhs);
    uint64_t rng = 4711;
    for (int k = 0; k < room; k++) {
        sl_int v = bench_random_below(&rng, system->n);
        bench_queries_add(q, &v, 1, &v, 1);
    }
    return q;
}

void bench_queries_free(bench_queries *q) {
    for (int k = 0; k < q->count; k++) {
        sl_plan_free(q->all[k].plan);
        free(q->all[k].X);
        free(q->all[k].B);
        free(q->all[k].xset);
        free(q->all[k].bset);
    }
    sl_work_free(q->W);
    free(q->X_full);
    free(q->B_full);
    free(q->all);
    free(q);
}

static void clear_x(const bench_queries *q, const bench_query *one) {
    memset(one->X, 0, (size_t)one->nx * (size_t)q->nrhs * sizeof *one->X);
}

int bench_queries_check(bench_run *run, bench_queries *q, int few) {
    int passed = 1;
    scatter_values(q, &q->all[0], 0);
    for (int k = 0; k < few && k < q->count && passed; k++) {
        bench_query *one = &q->all[k];
        scatter_values(q, one, 1);
        bench_call_full(q);
        passed &= bench_check_residual(run, q->system, q->X_full, q->B_full, q->nrhs, "full solve");
        clear_x(q, one);
        q->next = k;
        bench_call_plan_solve(q);
        passed &= bench_check_bits(run, q->system, one->X, one->xset, one->nx, q->X_full, q->nrhs,
                                   "plan solve");
        clear_x(q, one);
        q->next = k;
        bench_call_plan_and_solve(q);
        passed &= bench_check_bits(run, q->system, one->X, one->xset, one->nx, q->X_full, q->nrhs,
                                   "plan + solve");
        clear_x(q, one);
        q->next = k;
        bench_call_one_shot(q);
        passed &= bench_check_bits(run, q->system, one->X, one->xset, one->nx, q->X_full, q->nrhs,
                                   "one shot");
        scatter_values(q, one, 0);
    }
    scatter_values(q, &q->all[0], 1);
    q->next = 0;
    return passed;
}

sl_stats bench_queries_reach(const bench_queries *q) {
    sl_stats mean = q->all[0].reach;
    double sums[6] = {0};
    for (int k = 0; k < q->count; k++) {
        const sl_stats *s = &q->all[k].reach;
        double terms[6] = {s->plan.b_supernodes, s->plan.b_columns, (double)s->plan.b_entries,
                           s->plan.x_supernodes, s->plan.x_columns, (double)s->plan.x_entries};
        for (int c = 0; c < 6; c++) {
            sums[c] += terms[c] / q->count;
        }
    }
    mean.plan.b_supernodes = (sl_int)sums[0];
    mean.plan.b_columns = (sl_int)sums[1];
    mean.plan.b_entries = (sl_off)sums[2];
    mean.plan.x_supernodes = (sl_int)sums[3];
    mean.plan.x_columns = (sl_int)sums[4];
    mean.plan.x_entries = (sl_off)sums[5];
    return mean;
}

static bench_query *next_query(bench_queries *q) {
    bench_query *one = &q->all[q->next];
    q->next = q->next + 1 < q->count ? q->next + 1 : 0;
    return one;
}

static sl_plan *plan_of(const bench_queries *q, const bench_query *one) {
    sl_plan *plan;
    bench_must(
        sl_plan_create(&plan, q->system->S, one->bset, one->nb, one->xset, one->nx, NULL, NULL),
        "plan");
    return plan;
}

static void solve_on(const sl_plan *plan, const bench_queries *q, const bench_query *one) {
    bench_must(sl_plan_solve(plan, q->system->F, one->X, (size_t)one->nx, one->B, (size_t)one->nb,
                             q->nrhs, q->W),
               "plan solve");
}

void bench_call_plan_create(void *state) {
    bench_queries *q = state;
    sl_plan_free(plan_of(q, next_query(q)));
}

void bench_call_plan_solve(void *state) {
    bench_queries *q = state;
    const bench_query *one = next_query(q);
    solve_on(one->plan, q, one);
}

void bench_call_plan_and_solve(void *state) {
    bench_queries *q = state;
    const bench_query *one = next_query(q);
    sl_plan *plan = plan_of(q, one);
    solve_on(plan, q, one);
    sl_plan_free(plan);
}

void bench_call_plan_solve_one_by_one(void *state) {
    bench_queries *q = state;
    const bench_query *one = next_query(q);
    size_t nb = (size_t)one->nb, nx = (size_t)one->nx;
    for (size_t r = 0; r < (size_t)q->nrhs; r++) {
        bench_must(sl_plan_solve(one->plan, q->system->F, one->X + r * nx, nx, one->B + r * nb, nb,
                                 1, q->W),
                   "plan solve");
    }
}

void bench_call_one_shot(void *state) {
    bench_queries *q = state;
    const bench_query *one = next_query(q);
    bench_must(sl_local_solve(q->system->F, one->bset, one->nb, one->xset, one->nx, one->X,
                              (size_t)one->nx, one->B, (size_t)one->nb, q->nrhs, q->W, NULL),
               "local solve");
}

void bench_call_full(void *state) {
    bench_queries *q = state;
    size_t n = (size_t)q->system->n;
    bench_must(sl_factor_solve(q->system->F, q->X_full, n, q->B_full, n, q->nrhs, q->W),
               "full solve");
}

void bench_call_full_interleaved(void *state) {
    bench_queries *q = state;
    size_t ld = (size_t)q->nrhs;
    bench_must(sl_factor_solve(q->system->F, q->X_full, SL_ROWS(ld), q->B_full, SL_ROWS(ld),
                               q->nrhs, q->W),
               "full solve, interleaved");
}

void bench_call_full_one_by_one(void *state) {
    bench_queries *q = state;
    size_t n = (size_t)q->system->n;
    for (size_t r = 0; r < (size_t)q->nrhs; r++) {
        bench_must(
            sl_factor_solve(q->system->F, q->X_full + r * n, n, q->B_full + r * n, n, 1, q->W),
            "full solve");
    }
}

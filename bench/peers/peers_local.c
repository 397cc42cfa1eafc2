/* peers_local.c: local solves, with and without plan creation, against CHOLMOD's solve2 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "peers_steps.h"

/* cholmod_solve2 finds its reach in every call; "plan + solve" and "one shot" do the same.
 * "solve on a plan" is the cost when the plan is used again. cholmod_solve2 computes x only on
 * the reach of Bset, so its Bset is the wanted set, which contains that of b. It takes one
 * right-hand side; more are solved one after the other. Where a full solve is faster for
 * CHOLMOD, the row "CHOLMOD full solve" shows it, with the time of the full-solve step. */
enum { VERTICES = 128, VERTICES_BRIEF = 32, PATCHES = 5, LARGEST_REGION = 10000 };

typedef struct local_comparison {
    comparison *cmp;
    bench_queries *q;
    bench_queries inside; /* the same queries, each in a region for its xset; count 0: none */
    sl_region **regions;  /* count */
    double entries;       /* mean doubles read of L and of the inverse */
    int next;
    double **b; /* for each query and right-hand side nx values on xset, a superset of bset */
} local_comparison;

static void cholmod_local_call(void *state) {
    local_comparison *l = state;
    const bench_query *one = &l->q->all[l->next];
    for (sl_int r = 0; r < l->q->nrhs; r++) {
        l->cmp->answer = peer_cholmod_local(l->cmp->cholmod, one->xset, one->nx,
                                            l->b[l->next] + (size_t)r * (size_t)one->nx);
    }
    l->next = l->next + 1 < l->q->count ? l->next + 1 : 0;
}

/* Largest difference of two vectors, relative to the largest value. */
static double difference(const double *x, const double *y, size_t count) {
    double largest = 0, largest_difference = 0;
    for (size_t k = 0; k < count; k++) {
        largest = fmax(largest, fabs(x[k]));
        largest_difference = fmax(largest_difference, fabs(x[k] - y[k]));
    }
    return largest > 0 ? largest_difference / largest : largest_difference;
}

/* Copies b of a query to its xset, with zeros outside bset, for each right-hand side. */
static double *values_on_xset(const bench_query *one, size_t nrhs, sl_int *local_index) {
    size_t nx = (size_t)one->nx, nb = (size_t)one->nb;
    double *b = bench_alloc(nx * nrhs, sizeof *b);
    memset(b, 0, nx * nrhs * sizeof *b);
    for (sl_int p = 0; p < one->nx; p++) {
        local_index[one->xset[p]] = p;
    }
    for (size_t p = 0; p < nb; p++) {
        for (size_t r = 0; r < nrhs; r++) {
            b[r * nx + (size_t)local_index[one->bset[p]]] = one->B[r * nb + p];
        }
    }
    for (sl_int p = 0; p < one->nx; p++) {
        local_index[one->xset[p]] = -1;
    }
    return b;
}

/* Creates plans in regions, for sets of sizes that a region is meant for. */
static void create_regions(local_comparison *l) {
    const bench_queries *q = l->q;
    sl_options options;
    memset(&options, 0, sizeof options);
    l->inside = *q;
    l->inside.count = q->all[0].nx <= LARGEST_REGION ? q->count : 0;
    l->inside.all = bench_alloc((size_t)q->count, sizeof *l->inside.all);
    l->regions = bench_alloc((size_t)q->count, sizeof(sl_region *));
    for (int k = 0; k < l->inside.count; k++) {
        bench_query *one = &l->inside.all[k];
        *one = q->all[k];
        bench_must(
            sl_region_create(&l->regions[k], q->system->F, one->xset, one->nx, NULL, NULL, NULL),
            "region");
        options.region = l->regions[k];
        bench_must(sl_plan_create(&one->plan, q->system->S, one->bset, one->nb, one->xset, one->nx,
                                  &options, &one->reach),
                   "plan in a region");
        l->entries += ((double)one->reach.plan.b_entries + (double)one->reach.plan.x_entries +
                       2 * (double)one->reach.plan.region_entries) /
                      q->count;
    }
}

static void free_regions(local_comparison *l) {
    for (int k = 0; k < l->inside.count; k++) {
        sl_plan_free(l->inside.all[k].plan);
        sl_region_free(l->regions[k]);
    }
    free(l->inside.all);
    free(l->regions);
}

/* Compares our solutions on a plan with full solves, bit for bit, also with AVX2; and CHOLMOD's
 * last right-hand side of the first few queries with ours, on plans to the roots and in regions. */
static int check_local(bench_run *run, local_comparison *l, bench_queries *avx2, const char *what) {
    bench_queries *q = l->q;
    double worst = 0;
    if (!bench_queries_check(run, q, 1) || (avx2 && !bench_queries_check(run, avx2, 1))) {
        return 0;
    }
    for (int k = 0; k < q->count && k < 8; k++) {
        const bench_query *one = &q->all[k];
        size_t nx = (size_t)one->nx;
        double *theirs = bench_alloc(nx, sizeof *theirs);
        cholmod_local_call(l);
        bench_call_plan_solve(q);
        for (size_t p = 0; p < nx; p++) {
            theirs[p] = l->cmp->answer[one->xset[p]];
        }
        worst = fmax(worst, difference(theirs, one->X + ((size_t)q->nrhs - 1) * nx, nx));
        if (l->inside.count > 0) { /* the plan in the region writes to the same X */
            bench_call_plan_solve(&l->inside);
            worst = fmax(worst, difference(theirs, one->X + ((size_t)q->nrhs - 1) * nx, nx));
        }
        free(theirs);
    }
    l->next = q->next = l->inside.next = 0;
    return bench_expect(run, worst < 1e-9, "%s, %s: CHOLMOD's result differs by %.2g",
                        q->system->name, what, worst);
}

static void local_step(bench_run *run, bench_report *report, comparison *cmp, bench_queries *q,
                       const char *what) {
    local_comparison l = {.cmp = cmp, .q = q, .b = bench_alloc((size_t)q->count, sizeof *l.b)};
    bench_queries avx2 = *q; /* the same plans, another factor */
    avx2.system = &cmp->avx2;
    for (int k = 0; k < q->count; k++) {
        l.b[k] = values_on_xset(&q->all[k], (size_t)q->nrhs, cmp->system->local_index);
    }
    create_regions(&l);
    if (check_local(run, &l, cmp->avx2.F ? &avx2 : NULL, what)) {
        const sl_stats reach = bench_queries_reach(q);
        const bench_sample full = cmp->best_full[q->nrhs];
        timed_row rows[7] = {
            {.method = "ours, solve on a plan", .call = bench_call_plan_solve, .state = q},
            {.method = "ours, plan + solve", .call = bench_call_plan_and_solve, .state = q},
            {.method = "ours, one shot", .call = bench_call_one_shot, .state = q}};
        int ours = 3, count;
        if (cmp->avx2.F) {
            rows[ours++] = (timed_row){.method = "ours, AVX2 forced",
                                       .call = bench_call_plan_solve,
                                       .state = &avx2,
                                       .isa = SL_ISA_AVX2};
        }
        if (l.inside.count > 0) {
            rows[ours++] = (timed_row){
                .method = "ours, in region", .call = bench_call_plan_solve, .state = &l.inside};
        }
        rows[ours] = (timed_row){
            .method = "CHOLMOD solve2 Bset", .call = cholmod_local_call, .state = &l, .is_peer = 1};
        count = ours + 1;
        if (full.count > 0) {
            rows[count++] =
                (timed_row){.method = "CHOLMOD full solve", .sample = full, .is_peer = 1};
        }
        for (int c = 0; c < count; c++) {
            rows[c].batch = q->count < 8 ? 8 : q->count;
            rows[c].entries =
                c < ours ? (double)reach.plan.b_entries + (double)reach.plan.x_entries : 0;
        }
        if (l.inside.count > 0) {
            rows[ours - 1].entries = l.entries;
        }
        peers_race(run->seconds / 2, report, cmp, what, q->nrhs, rows, count, &reach, 0);
    }
    free_regions(&l);
    for (int k = 0; k < q->count; k++) {
        free(l.b[k]);
    }
    free(l.b);
}

static void patch_step(bench_run *run, bench_report *report, comparison *cmp, sl_int size) {
    bench_patch patches[PATCHES];
    char what[32];
    const int count = bench_patch_pick(patches, PATCHES, cmp->system, size);
    bench_queries *q = bench_queries_create(cmp->system, PATCHES, 2);
    for (int k = 0; k < count; k++) {
        bench_queries_add(q, patches[k].boundary, patches[k].n_boundary, patches[k].vertices,
                          patches[k].size);
    }
    snprintf(what, sizeof what, "patch %d", (int)size);
    if (count > 0) {
        local_step(run, report, cmp, q, what);
    }
    bench_queries_free(q);
    for (int k = 0; k < count; k++) {
        bench_patch_free(&patches[k]);
    }
}

void peers_local(bench_run *run, bench_report *report, comparison *cmp) {
    static const sl_int sizes[] = {100, 1000, 10000, 50000};
    const int vertices = cmp->is_brief ? VERTICES_BRIEF : VERTICES;
    bench_queries *q = bench_queries_vertices(cmp->system, vertices, 1);
    uint64_t rng = 2718;
    local_step(run, report, cmp, q, "vertex");
    bench_queries_free(q);
    q = bench_queries_create(cmp->system, vertices, 1);
    for (int k = 0; k < vertices && cmp->system->n > 1; k++) {
        sl_int pair[2] = {bench_random_below(&rng, cmp->system->n), 0};
        pair[1] = bench_random_below(&rng, cmp->system->n - 1);
        pair[1] += pair[1] >= pair[0];
        bench_queries_add(q, pair, 2, pair, 2);
    }
    if (q->count > 0) {
        local_step(run, report, cmp, q, "pair");
    }
    bench_queries_free(q);
    for (int s = cmp->is_brief; s < 4 && 2 * sizes[s] <= cmp->system->n; s++) {
        patch_step(run, report, cmp, sizes[s]);
    }
}

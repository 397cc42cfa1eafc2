/* peers_local.c: local solves beside CHOLMOD's solve2 with Bset */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "peers_steps.h"

/* cholmod_solve2 gives x on the reach of Bset alone, so its Bset is the wanted set, which holds b's; it takes one
 * right-hand side, so several go one after the other. Where a full solve is quicker for CHOLMOD, the row of that name
 * says so: its time is that of the step before. */
enum { VERTICES = 128, VERTICES_BRIEF = 32, PATCHES = 5, LARGEST_REGION = 10000 };

typedef struct local_match {
    match *m;
    bench_queries *q;
    bench_queries inside; /* the same questions, each in a region for its xset; count 0: none */
    sl_region **regions;  /* count */
    double entries;       /* mean doubles of L and of the inverse read there */
    int next;
    double **b; /* of each query: for each right-hand side nx values on xset, which holds bset */
} local_match;

static void cholmod_local_call(void *state) {
    local_match *l = state;
    const bench_query *one = &l->q->all[l->next];
    for (sl_int r = 0; r < l->q->nrhs; r++) {
        l->m->answer = peer_cholmod_local(l->m->cholmod, one->xset, one->nx,
                                          l->b[l->next] + (size_t)r * (size_t)one->nx);
    }
    l->next = l->next + 1 < l->q->count ? l->next + 1 : 0;
}

/* Largest difference of two answers, as a share of the largest value. */
static double difference(const double *x, const double *y, size_t count) {
    double most = 0, apart = 0;
    for (size_t k = 0; k < count; k++) {
        most = fmax(most, fabs(x[k]));
        apart = fmax(apart, fabs(x[k] - y[k]));
    }
    return most > 0 ? apart / most : apart;
}

/* b of a query on its xset, zero where bset does not reach, for each right-hand side. */
static double *widened(const bench_query *one, size_t nrhs, sl_int *place) {
    size_t nx = (size_t)one->nx, nb = (size_t)one->nb;
    double *b = bench_alloc(nx * nrhs, sizeof *b);
    memset(b, 0, nx * nrhs * sizeof *b);
    for (sl_int p = 0; p < one->nx; p++) {
        place[one->xset[p]] = p;
    }
    for (size_t p = 0; p < nb; p++) {
        for (size_t r = 0; r < nrhs; r++) {
            b[r * nx + (size_t)place[one->bset[p]]] = one->B[r * nb + p];
        }
    }
    for (sl_int p = 0; p < one->nx; p++) {
        place[one->xset[p]] = -1;
    }
    return b;
}

/* Plans in regions beside those to the roots, where the sets are not larger than what one makes a region for. */
static void enclose(local_match *l) {
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
        l->entries += ((double)one->reach.b_entries + (double)one->reach.x_entries +
                       2 * (double)one->reach.plan_region_entries) /
                      q->count;
    }
}

static void leave_regions(local_match *l) {
    for (int k = 0; k < l->inside.count; k++) {
        sl_plan_free(l->inside.all[k].plan);
        sl_region_free(l->regions[k]);
    }
    free(l->inside.all);
    free(l->regions);
}

/* CHOLMOD's last right-hand side of the first few queries against ours, which has the bits of a full solve; and ours
 * with AVX2, whose own full solve it must equal. The same with plans in regions. */
static int check_local(bench_run *run, local_match *l, bench_queries *narrow, const char *what) {
    bench_queries *q = l->q;
    double worst = 0;
    if (!bench_queries_check(run, q, 1) || (narrow && !bench_queries_check(run, narrow, 1))) {
        return 0;
    }
    for (int k = 0; k < q->count && k < 8; k++) {
        const bench_query *one = &q->all[k];
        size_t nx = (size_t)one->nx;
        double *theirs = bench_alloc(nx, sizeof *theirs);
        cholmod_local_call(l);
        bench_call_plan_solve(q);
        for (size_t p = 0; p < nx; p++) {
            theirs[p] = l->m->answer[one->xset[p]];
        }
        worst = fmax(worst, difference(theirs, one->X + ((size_t)q->nrhs - 1) * nx, nx));
        if (l->inside.count > 0) { /* answers stand where those of the other plan stood */
            bench_call_plan_solve(&l->inside);
            worst = fmax(worst, difference(theirs, one->X + ((size_t)q->nrhs - 1) * nx, nx));
        }
        free(theirs);
    }
    l->next = q->next = l->inside.next = 0;
    return bench_expect(run, worst < 1e-9, "%s, %s: CHOLMOD's answer is %.2g away", q->system->name,
                        what, worst);
}

static void local_step(bench_run *run, bench_report *report, match *m, bench_queries *q,
                       const char *what) {
    local_match l = {.m = m, .q = q, .b = bench_alloc((size_t)q->count, sizeof *l.b)};
    bench_queries narrow = *q; /* the same plans, another factor */
    narrow.system = &m->narrow;
    for (int k = 0; k < q->count; k++) {
        l.b[k] = widened(&q->all[k], (size_t)q->nrhs, m->system->place);
    }
    enclose(&l);
    if (check_local(run, &l, m->narrow.F ? &narrow : NULL, what)) {
        const sl_stats reach = bench_queries_reach(q);
        const bench_sample full = m->best_full[q->nrhs];
        entry entries[6] = {{.method = "ours", .call = bench_call_plan_solve, .state = q},
                            {.method = "ours, one shot", .call = bench_call_one_shot, .state = q}};
        int ours = 2, count;
        if (m->narrow.F) {
            entries[ours++] = (entry){.method = "ours, AVX2 forced",
                                      .call = bench_call_plan_solve,
                                      .state = &narrow,
                                      .isa = SL_ISA_AVX2};
        }
        if (l.inside.count > 0) {
            entries[ours++] = (entry){
                .method = "ours, in region", .call = bench_call_plan_solve, .state = &l.inside};
        }
        entries[ours] = (entry){
            .method = "CHOLMOD solve2 Bset", .call = cholmod_local_call, .state = &l, .foreign = 1};
        count = ours + 1;
        if (full.count > 0) {
            entries[count++] =
                (entry){.method = "CHOLMOD full solve", .sample = full, .foreign = 1};
        }
        for (int c = 0; c < count; c++) {
            entries[c].batch = q->count < 8 ? 8 : q->count;
            entries[c].entries = c < ours ? (double)reach.b_entries + (double)reach.x_entries : 0;
        }
        if (l.inside.count > 0) {
            entries[ours - 1].entries = l.entries;
        }
        peers_race(run->seconds / 2, report, m, what, q->nrhs, entries, count, &reach, 0);
    }
    leave_regions(&l);
    for (int k = 0; k < q->count; k++) {
        free(l.b[k]);
    }
    free(l.b);
}

static void patch_step(bench_run *run, bench_report *report, match *m, sl_int size) {
    bench_patch patches[PATCHES];
    char what[32];
    const int count = bench_patch_pick(patches, PATCHES, m->system, size);
    bench_queries *q = bench_queries_create(m->system, PATCHES, 2);
    for (int k = 0; k < count; k++) {
        bench_queries_add(q, patches[k].boundary, patches[k].n_boundary, patches[k].vertices,
                          patches[k].size);
    }
    snprintf(what, sizeof what, "patch %d", (int)size);
    if (count > 0) {
        local_step(run, report, m, q, what);
    }
    bench_queries_free(q);
    for (int k = 0; k < count; k++) {
        bench_patch_free(&patches[k]);
    }
}

void peers_local(bench_run *run, bench_report *report, match *m) {
    static const sl_int sizes[] = {100, 1000, 10000, 50000};
    const int vertices = m->is_brief ? VERTICES_BRIEF : VERTICES;
    bench_queries *q = bench_queries_vertices(m->system, vertices, 1);
    uint64_t chance = 2718;
    local_step(run, report, m, q, "vertex");
    bench_queries_free(q);
    q = bench_queries_create(m->system, vertices, 1);
    for (int k = 0; k < vertices && m->system->n > 1; k++) {
        sl_int pair[2] = {bench_random_below(&chance, m->system->n), 0};
        pair[1] = bench_random_below(&chance, m->system->n - 1);
        pair[1] += pair[1] >= pair[0];
        bench_queries_add(q, pair, 2, pair, 2);
    }
    if (q->count > 0) {
        local_step(run, report, m, q, "pair");
    }
    bench_queries_free(q);
    for (int s = m->is_brief; s < 4 && 2 * sizes[s] <= m->system->n; s++) {
        patch_step(run, report, m, sizes[s]);
    }
}

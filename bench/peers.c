/* peers.c: how does each step compare with CHOLMOD and Eigen, over the same permutation and on one thread? */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "bench.h"
#include "peers.h"

/* Repetitions of a step go round ours and theirs in turn. The permutation is the one that our analysis ended with.
 * Eigen is given the permuted matrix and permuted vectors, so that it permutes nothing; where few_flops are exceeded,
 * its factorization is timed only once. */
enum { VERTICES = 256, PATCHES = 5, MAX_SYSTEMS = 8 };

static const double few_flops = 5e9;

typedef struct match {
    const bench_system *system;
    sl_symbolic_view_t view;
    sl_options given; /* the same permutation */
    sl_factor *F;     /* for refactorizations */
    peer_cholmod *cholmod;
    peer_eigen *eigen;
    sl_matrix *permuted;
    sl_int nrhs;
    double *B, *X; /* n x 8 */
    sl_work *W;
    const double *answer; /* CHOLMOD's last */
} match;

/* ---- contenders ---- */

static void ours_analyse(void *state) {
    match *m = state;
    sl_symbolic *S;
    bench_must(sl_symbolic_create(&S, &m->system->A, &m->given, NULL), "analysis");
    sl_symbolic_free(S);
}

static void ours_factor(void *state) {
    match *m = state;
    bench_must(sl_factor_refactor(m->F, &m->system->A, NULL), "refactor");
}

static void ours_solve(void *state) {
    match *m = state;
    size_t n = (size_t)m->system->n;
    bench_must(sl_factor_solve(m->system->F, m->X, n, m->B, n, m->nrhs, m->W), "full solve");
}

static void cholmod_analyse_call(void *state) {
    peer_cholmod_analyse(((match *)state)->cholmod);
}

static void cholmod_factor_call(void *state) {
    peer_cholmod_factor(((match *)state)->cholmod);
}

static void cholmod_solve_call(void *state) {
    match *m = state;
    m->answer = peer_cholmod_solve(m->cholmod, m->B, m->nrhs);
}

static void eigen_analyse_call(void *state) {
    peer_eigen_analyse(((match *)state)->eigen);
}

static void eigen_factor_call(void *state) {
    peer_eigen_factor(((match *)state)->eigen);
}

static void eigen_solve_call(void *state) {
    match *m = state;
    peer_eigen_solve(m->eigen, m->X, m->B, m->nrhs);
}

typedef struct local_match {
    match *m;
    bench_queries *q;
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

/* ---- steps ---- */

typedef struct entry {
    const char *method;
    void (*call)(void *);
    void *state;
    int batch;
    double entries, flops;
    int passes;
} entry;

/* Races the entries and prints a row for each; entry 0 is the baseline, whose median is returned. */
static double race(const bench_run *run, bench_report *report, const match *m, const char *what,
                   sl_int nrhs, const entry *entries, int count, const sl_stats *reach) {
    bench_contender contenders[4];
    bench_sample samples[4];
    for (int c = 0; c < count; c++) {
        contenders[c].call = entries[c].call;
        contenders[c].state = entries[c].state;
        contenders[c].batch = entries[c].batch;
    }
    bench_race(samples, contenders, count, run->seconds);
    for (int c = 0; c < count; c++) {
        bench_row row = {.what = what, .method = entries[c].method, .nrhs = nrhs};
        if (reach) {
            row.reach = *reach;
        }
        row.entries = entries[c].entries;
        row.flops = entries[c].flops;
        row.passes = entries[c].passes;
        row.time = samples[c];
        row.baseline = samples[0].median;
        bench_report_row(report, m->system, &row);
    }
    return samples[0].median;
}

static void prepare_steps(const bench_run *run, bench_report *report, match *m) {
    double flops = m->system->stats.flops;
    entry analyse[3] = {{"ours, given order", ours_analyse, m, 1, 0, 0, 0},
                        {"CHOLMOD supernodal", cholmod_analyse_call, m, 1, 0, 0, 0},
                        {"Eigen simplicial", eigen_analyse_call, m, 1, 0, 0, 0}};
    entry factor[3] = {{"ours, refactor", ours_factor, m, 1, 0, flops, 0},
                       {"CHOLMOD supernodal", cholmod_factor_call, m, 1, 0, flops, 0},
                       {"Eigen simplicial", eigen_factor_call, m, 1, 0, flops, 0}};
    bench_run patient = *run;
    race(run, report, m, "analyse", 0, analyse, 3, NULL);
    bench_report_note(report, "%-14s   our first analysis: METIS %.3f s, all else %.3f s", "",
                      m->system->stats.seconds_order, m->system->stats.seconds_analyse);
    double start = bench_now();
    peer_eigen_factor(m->eigen);
    double first = bench_now() - start;
    patient.seconds *= 3;
    double ours = race(&patient, report, m, "factor", 0, factor, flops < few_flops ? 3 : 2, NULL);
    if (flops >= few_flops) {
        bench_row row = {.what = "factor", .method = "Eigen simplicial, once", .flops = flops};
        row.time = bench_sample_of(&first, 1);
        row.baseline = ours;
        bench_report_row(report, m->system, &row);
    }
}

/* Largest difference of two answers, as a share of the largest value. */
static double difference(const double *x, const double *y, size_t count) {
    double most = 0, apart = 0;
    for (size_t k = 0; k < count; k++) {
        most = fabs(x[k]) > most ? fabs(x[k]) : most;
        apart = fabs(x[k] - y[k]) > apart ? fabs(x[k] - y[k]) : apart;
    }
    return most > 0 ? apart / most : apart;
}

static void full_steps(bench_run *run, bench_report *report, match *m) {
    static const sl_int counts[] = {1, 8};
    size_t n = (size_t)m->system->n;
    uint64_t chance = 99;
    for (int k = 0; k < 2; k++) {
        m->nrhs = counts[k];
        bench_random_fill(&chance, m->B, n * (size_t)m->nrhs);
        ours_solve(m);
        cholmod_solve_call(m);
        bench_check_residual(run, m->system, m->X, m->B, m->nrhs, "full solve");
        bench_check_residual(run, m->system, m->answer, m->B, m->nrhs, "CHOLMOD");
        double ours = 2 * (double)m->system->stats.nnz_panels,
               theirs = 2 * peer_cholmod_nnz(m->cholmod);
        entry solve[3] = {{"ours", ours_solve, m, 1, ours, 0, 0},
                          {"CHOLMOD supernodal", cholmod_solve_call, m, 1, theirs, 0, 0},
                          {"Eigen simplicial", eigen_solve_call, m, 1, theirs, 0, 0}};
        if (m->nrhs > 1) {
            solve[2].entries *= m->nrhs; /* one after the other */
            solve[2].passes = m->nrhs;
        }
        race(run, report, m, "full solve", m->nrhs, solve, 3, NULL);
    }
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

/* CHOLMOD's last right-hand side of the first few queries against ours, which has the bits of a full solve. */
static int check_local(bench_run *run, local_match *l, const char *what) {
    bench_queries *q = l->q;
    double worst = 0;
    if (!bench_queries_check(run, q, 2)) {
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
        double apart = difference(theirs, one->X + ((size_t)q->nrhs - 1) * nx, nx);
        worst = apart > worst ? apart : worst;
        free(theirs);
    }
    l->next = q->next = 0;
    return bench_expect(run, worst < 1e-9, "%s, %s: CHOLMOD's answer is %.2g away", q->system->name,
                        what, worst);
}

static void local_step(bench_run *run, bench_report *report, match *m, bench_queries *q,
                       const char *what) {
    local_match l = {m, q, 0, bench_alloc((size_t)q->count, sizeof *l.b)};
    for (int k = 0; k < q->count; k++) {
        l.b[k] = widened(&q->all[k], (size_t)q->nrhs, m->system->place);
    }
    if (check_local(run, &l, what)) {
        sl_stats reach = bench_queries_reach(q);
        double ours = (double)reach.b_entries + (double)reach.x_entries;
        int batch = q->count < 8 ? 8 * q->count : q->count;
        entry local[3] = {{"ours, plan solve", bench_call_plan_solve, q, batch, ours, 0, 0},
                          {"ours, one shot", bench_call_one_shot, q, batch, ours, 0, 0},
                          {"CHOLMOD solve2 Bset", cholmod_local_call, &l, batch, 0, 0, 0}};
        race(run, report, m, what, q->nrhs, local, 3, &reach);
    }
    for (int k = 0; k < q->count; k++) {
        free(l.b[k]);
    }
    free(l.b);
}

static void local_steps(bench_run *run, bench_report *report, match *m) {
    static const sl_int sizes[] = {2000, 10000, 50000};
    bench_queries *q = bench_queries_vertices(m->system, VERTICES, 1);
    local_step(run, report, m, q, "vertex");
    bench_queries_free(q);
    for (int s = 0; s < 3 && 2 * sizes[s] <= m->system->n; s++) {
        bench_patch patches[PATCHES];
        char what[32];
        int count = bench_patch_pick(patches, PATCHES, m->system, sizes[s]);
        q = bench_queries_create(m->system, PATCHES, 2);
        for (int k = 0; k < count; k++) {
            bench_queries_add(q, patches[k].boundary, patches[k].n_boundary, patches[k].vertices,
                              patches[k].size);
        }
        snprintf(what, sizeof what, "patch %d", (int)sizes[s]);
        if (count > 0) {
            local_step(run, report, m, q, what);
        }
        bench_queries_free(q);
        for (int k = 0; k < count; k++) {
            bench_patch_free(&patches[k]);
        }
    }
}

/* ---- all steps on one system ---- */

static void one_system(bench_run *run, bench_report *report, const bench_system *system) {
    match m;
    memset(&m, 0, sizeof m);
    m.system = system;
    m.view = sl_symbolic_view(system->S);
    m.given.ordering = SL_ORDERING_GIVEN;
    m.given.perm = m.view.perm;
    m.cholmod = peer_cholmod_create(&system->A, m.view.perm);
    bench_must(sl_matrix_permute(&m.permuted, &system->A, m.view.perm, NULL),
               "permuting for Eigen");
    sl_csc C = sl_matrix_view(m.permuted);
    m.eigen = peer_eigen_create(&C);
    bench_must(sl_factor_create(&m.F, system->S, &system->A, NULL, NULL), "factor");
    bench_must(sl_work_create(&m.W, NULL), "workspace");
    m.B = bench_alloc((size_t)system->n * 8, sizeof *m.B);
    m.X = bench_alloc((size_t)system->n * 8, sizeof *m.X);
    prepare_steps(run, report, &m);
    full_steps(run, report, &m);
    local_steps(run, report, &m);
    free(m.X);
    free(m.B);
    sl_work_free(m.W);
    sl_factor_free(m.F);
    peer_eigen_free(m.eigen);
    sl_matrix_free(m.permuted);
    peer_cholmod_free(m.cholmod);
}

void bench_peers(bench_run *run) {
    static const double wanted[] = {330.0 * 330.0, 1e6}, quick[] = {1e4};
    const bench_system *systems[MAX_SYSTEMS];
    const char *data = getenv("SL_DATA");
    int count = 0;
    if (!run->mesh_path && data && data[0]) {
        char path[512];
        snprintf(path, sizeof path, "%s/meshes/bunny.off.gz", data);
        systems[count] = bench_mesh(path);
        count += systems[count] != NULL;
    }
    if (run->size == BENCH_QUICK) {
        count += bench_systems(run, quick, 1, systems + count);
    } else {
        count += bench_systems(run, wanted, 2, systems + count);
        if (!run->mesh_path) {
            systems[count++] = bench_volume(40);
        }
    }
    bench_report *report =
        bench_report_open(run, "peers", "CHOLMOD and Eigen, same permutation, one thread", "ours");
    printf("   OpenBLAS kernels for CHOLMOD: %s\n", peer_cholmod_kernels());
    for (int k = 0; k < count; k++) {
        one_system(run, report, systems[k]);
    }
    bench_report_close(report);
}

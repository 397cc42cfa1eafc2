/* peers_complex.c: how does a connection Laplacian compare with CHOLMOD's and Eigen's complex? */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "bench/lib/bench.h"
#include "peers.h"
#include "tools/geometry/connection.h"
#include "tools/geometry/laplacian.h"
#include "tools/mesh/grid.h"

/* M + t C of a mesh, complex, and M + t L, real, with t = (mean edge length)^2. CHOLMOD has our
 * permutation; Eigen has AMD. A ratio is to our real solve or factorization of the same mesh. */
typedef struct complex_case {
    bench_system real, twice; /* twice: the real matrix of twice the size */
    bench_system halved;      /* the same analysis, with SL_STORAGE_COMPLEX */
    sl_int *p, *i;            /* the complex matrix, lower triangle */
    double *x;
    sl_hermitian H;
    peer_cholmod *cholmod;
    peer_eigen_complex *eigen; /* NULL if its factorization would take minutes */
    sl_int *rows;              /* ROWS_LOCAL vertices for local solves */
    sl_plan *real_plan, *complex_plan;
    double *b, *X; /* 2 n */
    const double *answer;
    sl_work *W;
} complex_case;

enum { ROWS_LOCAL = 100 };

static void factor_system(bench_system *s, const char *name, sl_int n, sl_int block) {
    sl_options opt;
    sl_options_init(&opt, sizeof opt);
    opt.block_size = block;
    (void)snprintf(s->name, sizeof s->name, "%s", name);
    s->n = n;
    s->A = sl_matrix_view(s->matrix);
    bench_must(sl_symbolic_create(&s->S, &s->A, &opt, &s->stats), "analysis");
    bench_must(sl_factor_create(&s->F, s->S, &s->A, NULL, &s->stats), "factorization");
}

/* The complex matrix: the first columns of the blocks, [a; b] of [a -b; b a]. */
static void take_blocks(complex_case *c) {
    const sl_csc *A = &c->twice.A;
    const sl_int n = A->n_cols / 2;
    c->p = bench_alloc((size_t)n + 1, sizeof *c->p);
    c->i = bench_alloc((size_t)A->p[2 * n], sizeof *c->i);
    c->x = bench_alloc(2 * (size_t)A->p[2 * n], sizeof *c->x);
    sl_int at = 0;
    for (sl_int j = 0; j < n; j++) {
        c->p[j] = at;
        for (sl_int k = A->p[2 * j]; k < A->p[2 * j + 1]; k++) {
            const sl_int row = A->i[k] / 2;
            if (at == c->p[j] || c->i[at - 1] != row) {
                c->i[at] = row;
                c->x[2 * at] = c->x[2 * at + 1] = 0;
                at++;
            }
            c->x[2 * (at - 1) + A->i[k] % 2] = A->x[k];
        }
    }
    c->p[n] = at;
    const sl_hermitian H = {n, c->p, c->i, c->x, NULL};
    c->H = H;
}

static complex_case *create(const bench_run *run, const mesh *m, const char *name) {
    complex_case *c = bench_alloc(1, sizeof *c);
    memset(c, 0, sizeof *c);
    connection frames;
    const double edge = mesh_mean_edge_length(m), t = edge * edge;
    const sl_int n = m->n_vertices;
    if (!laplacian_system(&c->real.matrix, m, t) || !connection_create(&frames, m)) {
        bench_must(SL_ERR_MEMORY, "Laplacian");
    }
    bench_must(connection_system(&c->twice.matrix, &frames, t), "connection Laplacian");
    connection_free(&frames);
    factor_system(&c->real, name, n, 0);
    factor_system(&c->twice, name, 2 * n, 2);
    c->halved = c->twice;
    c->halved.F = NULL;
    sl_options opt;
    sl_options_init(&opt, sizeof opt);
    opt.storage = SL_STORAGE_COMPLEX;
    bench_must(sl_factor_create(&c->halved.F, c->twice.S, &c->twice.A, &opt, NULL),
               "factorization");
    take_blocks(c);
    const sl_symbolic_arrays view = sl_symbolic_view(c->twice.S);
    sl_int *perm = bench_alloc((size_t)n, sizeof *perm);
    for (sl_int k = 0; k < n; k++) {
        perm[k] = view.perm[2 * k] / 2;
    }
    c->cholmod = peer_cholmod_create_complex(&c->H, perm);
    free(perm);
    c->eigen = run->size == BENCH_FULL || n < 200000 ? peer_eigen_complex_create(&c->H) : NULL;
    c->b = bench_alloc(2 * (size_t)n, sizeof *c->b);
    c->X = bench_alloc(2 * (size_t)n, sizeof *c->X);
    c->rows = bench_alloc(ROWS_LOCAL, sizeof *c->rows);
    uint64_t rng = 17;
    bench_random_fill(&rng, c->b, 2 * (size_t)n);
    const sl_int first = bench_random_below(&rng, n - ROWS_LOCAL);
    for (sl_int k = 0; k < ROWS_LOCAL; k++) {
        c->rows[k] = first + k;
    }
    bench_must(sl_plan_create(&c->real_plan, c->real.S, c->rows, ROWS_LOCAL, c->rows, ROWS_LOCAL,
                              NULL, NULL),
               "plan");
    bench_must(sl_complex_plan_create(&c->complex_plan, c->twice.S, c->rows, ROWS_LOCAL, c->rows,
                                      ROWS_LOCAL, NULL, NULL),
               "plan");
    bench_must(sl_work_create(&c->W, NULL), "workspace");
    return c;
}

static void release_system(bench_system *s) {
    sl_factor_free(s->F);
    sl_symbolic_free(s->S);
    sl_matrix_free(s->matrix);
}

static void release(complex_case *c) {
    peer_cholmod_free(c->cholmod);
    if (c->eigen) {
        peer_eigen_complex_free(c->eigen);
    }
    sl_plan_free(c->real_plan);
    sl_plan_free(c->complex_plan);
    sl_work_free(c->W);
    sl_factor_free(c->halved.F);
    release_system(&c->real);
    release_system(&c->twice);
    free(c->p);
    free(c->i);
    free(c->x);
    free(c->rows);
    free(c->b);
    free(c->X);
    free(c);
}

static void solve(complex_case *c, const bench_system *s) {
    const size_t n = (size_t)s->n;
    bench_must(sl_factor_solve(s->F, c->X, n, c->b, n, 1, c->W), "full solve");
    c->answer = c->X;
}

static void solve_real(void *state) {
    solve(state, &((complex_case *)state)->real);
}

static void solve_ours(void *state) {
    solve(state, &((complex_case *)state)->twice);
}

static void solve_supernodal(void *state) {
    complex_case *c = state;
    c->answer = peer_cholmod_solve(c->cholmod, c->b, 1);
}

static void solve_simplicial(void *state) {
    complex_case *c = state;
    c->answer = peer_cholmod_solve_simplicial(c->cholmod, c->b, 1);
}

static void solve_eigen(void *state) {
    complex_case *c = state;
    peer_eigen_complex_solve(c->eigen, c->X, c->b);
    c->answer = c->X;
}

static void solve_halved(void *state) {
    solve(state, &((complex_case *)state)->halved);
}

static void factor_halved(void *state) {
    complex_case *c = state;
    bench_must(sl_factor_refactor(c->halved.F, &c->twice.A, NULL), "refactorization");
}

static void factor_real(void *state) {
    complex_case *c = state;
    bench_must(sl_factor_refactor(c->real.F, &c->real.A, NULL), "refactorization");
}

static void factor_ours(void *state) {
    complex_case *c = state;
    bench_must(sl_factor_refactor(c->twice.F, &c->twice.A, NULL), "refactorization");
}

static void factor_supernodal(void *state) {
    peer_cholmod_factor(((complex_case *)state)->cholmod);
}

static void factor_simplicial(void *state) {
    peer_cholmod_factor_simplicial(((complex_case *)state)->cholmod);
}

static void factor_eigen(void *state) {
    peer_eigen_complex_factor(((complex_case *)state)->eigen);
}

static void local_real(void *state) {
    complex_case *c = state;
    bench_must(sl_plan_solve(c->real_plan, c->real.F, c->X, ROWS_LOCAL, c->b, ROWS_LOCAL, 1, c->W),
               "local solve");
}

static void local_complex(complex_case *c, const sl_factor *F) {
    const size_t n = 2 * (size_t)ROWS_LOCAL;
    bench_must(sl_plan_solve(c->complex_plan, F, c->X, n, c->b, n, 1, c->W), "local solve");
}

static void local_ours(void *state) {
    local_complex(state, ((complex_case *)state)->twice.F);
}

static void local_halved(void *state) {
    local_complex(state, ((complex_case *)state)->halved.F);
}

typedef struct contender_row {
    const char *method;
    void (*call)(void *);
    int is_peer;
} contender_row;

static void race(const bench_run *run, bench_report *report, complex_case *c, const char *what,
                 const contender_row *rows, int count) {
    bench_contender contenders[8];
    bench_sample samples[8];
    memset(contenders, 0, sizeof contenders);
    for (int k = 0; k < count; k++) {
        contenders[k].call = rows[k].call;
        contenders[k].state = c;
    }
    bench_race(samples, contenders, count, run->seconds);
    for (int k = 0; k < count; k++) {
        const bench_row row = {.what = what,
                               .method = rows[k].method,
                               .is_peer = rows[k].is_peer,
                               .nrhs = what[0] == 'r' ? 0 : 1,
                               .time = samples[k],
                               .baseline = samples[0].median};
        bench_report_row(report, &c->real, &row);
    }
}

static void one_case(bench_run *run, bench_report *report, const mesh *m, const char *name) {
    complex_case *c = create(run, m, name);
    const int count = c->eigen ? 6 : 5;
    const contender_row solves[] = {{"ours, real", solve_real, 0},
                                    {"ours, complex in double", solve_ours, 0},
                                    {"ours, complex", solve_halved, 0},
                                    {"CHOLMOD supernodal", solve_supernodal, 1},
                                    {"CHOLMOD simplicial", solve_simplicial, 1},
                                    {"Eigen defaults", solve_eigen, 1}};
    const contender_row factors[] = {{"ours, real", factor_real, 0},
                                     {"ours, complex in double", factor_ours, 0},
                                     {"ours, complex", factor_halved, 0},
                                     {"CHOLMOD supernodal", factor_supernodal, 1},
                                     {"CHOLMOD simplicial", factor_simplicial, 1},
                                     {"Eigen defaults", factor_eigen, 1}};
    const contender_row locals[] = {{"ours, real", local_real, 0},
                                    {"ours, complex in double", local_ours, 0},
                                    {"ours, complex", local_halved, 0}};
    int passed = 1;
    for (int k = 1; k < count; k++) {
        solves[k].call(c);
        passed &= bench_check_residual(run, &c->twice, c->answer, c->b, 1, solves[k].method);
    }
    if (passed) {
        bench_report_note(report, "complex: entries of the real L of %d rows %.4g, panels %.4g",
                          (int)c->twice.n, (double)c->twice.stats.symbolic.nnz_l,
                          (double)c->twice.stats.symbolic.nnz_panels);
        race(run, report, c, "refactor", factors, count);
        race(run, report, c, "full solve", solves, count);
        race(run, report, c, "local solve, 100 vertices", locals, 3);
    }
    release(c);
}

void bench_peers_complex(bench_run *run) {
    static const sl_int sides[] = {100, 316, 1000};
    const char *data = getenv("SL_DATA");
    const int count = run->size == BENCH_QUICK ? 1 : run->size == BENCH_FULL ? 3 : 2;
    mesh m;
    char path[512], name[40];
    bench_report *report =
        bench_report_open(run, "peers_complex", "a connection Laplacian against CHOLMOD and Eigen",
                          "our real matrix of the mesh");
    if (run->mesh_path || (data && data[0])) {
        (void)snprintf(path, sizeof path, "%s%s", run->mesh_path ? run->mesh_path : data,
                       run->mesh_path ? "" : "/meshes/bunny.off.gz");
        if (mesh_read(&m, path, NULL, 0)) {
            one_case(run, report, &m, run->mesh_path ? "MESH" : "bunny");
            mesh_free(&m);
        }
    }
    for (int k = 0; k < count && !run->mesh_path; k++) {
        if (!mesh_torus(&m, sides[k], sides[k], 0.2, 7)) {
            bench_must(SL_ERR_MEMORY, "torus");
        }
        (void)snprintf(name, sizeof name, "torus %dx%d", (int)sides[k], (int)sides[k]);
        one_case(run, report, &m, name);
        mesh_free(&m);
    }
    bench_report_close(report);
}

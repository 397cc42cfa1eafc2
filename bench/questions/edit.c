/* edit.c: does an analysis follow a remeshed patch for less than a new order and analysis? */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "bench/lib/bench.h"
#include "tools/geometry/laplacian.h"
#include "tools/mesh/grid.h"
#include "tools/mesh/remesh.h"

/* Edges of 0.1 % of the vertices, around a random one, are split, collapsed and flipped; each
 * edit starts from the analysis of the edit before. The baseline orders and analyzes every mesh
 * anew. Times are those of single calls, as no edit comes twice. At the end a factor over the last
 * analysis is checked. */
enum { EDITS = 10 };

typedef struct edited {
    remesh mesh;
    bench_system *system; /* what the rows of the table are of: the last matrix, without factor */
    double t;
    uint64_t random;
    double anew[EDITS], follow[EDITS];
    int count, is_anew, is_due;
    double growth; /* entries of L relative to those of the new analysis: the largest */
} edited;

static sl_matrix *matrix_of(const edited *e) {
    sl_matrix *A = NULL;
    if (!laplacian_system(&A, &e->mesh.faces.m, e->t)) {
        bench_must(SL_ERR_MEMORY, "assembling the matrix of a mesh");
    }
    return A;
}

/* Remeshes a patch. Returns the new number of each vertex before. */
static sl_int *remesh_somewhere(edited *e) {
    const sl_int n = e->mesh.faces.m.n_vertices;
    sl_int *patch = bench_alloc((size_t)n, sizeof *patch);
    unsigned char *seen = bench_alloc((size_t)n, 1);
    memset(seen, 0, (size_t)n);
    const sl_int size =
        remesh_patch(&e->mesh, bench_random_below(&e->random, n), n / 1000 + 1, patch, seen);
    (void)remesh_vertices(&e->mesh, patch, size, &e->random);
    free(patch);
    free(seen);
    sl_int *new_of = bench_alloc((size_t)e->mesh.faces.m.n_vertices, sizeof *new_of);
    remesh_compact(&e->mesh, new_of);
    return new_of;
}

/* One edit: the analysis *S of *A becomes that of the next matrix. */
static void edit_once(edited *e, sl_symbolic **S, sl_matrix **A) {
    sl_int *new_of = remesh_somewhere(e);
    sl_matrix *B = matrix_of(e);
    const sl_csc a = sl_matrix_view(*A), b = sl_matrix_view(B);
    sl_symbolic *fresh = NULL, *T = NULL;
    sl_stats stats;
    double begin = bench_now();
    bench_must(sl_symbolic_create(&fresh, &b, NULL, &e->system->stats), "analysis");
    e->anew[e->count] = bench_now() - begin;
    begin = bench_now();
    bench_must(sl_symbolic_edit(&T, *S, &a, &b, new_of, NULL, &stats), "edit");
    e->follow[e->count++] = bench_now() - begin;
    e->growth =
        fmax(e->growth, (double)stats.symbolic.nnz_l / (double)e->system->stats.symbolic.nnz_l);
    e->is_anew += stats.edit.is_anew;
    e->is_due += stats.edit.is_due;
    e->system->n = b.n_rows;
    sl_symbolic_free(fresh);
    sl_symbolic_free(*S);
    sl_matrix_free(*A);
    free(new_of);
    *S = T;
    *A = B;
}

/* A solution by a factor over the last analysis has a small residual. */
static int check(bench_run *run, const edited *e, const sl_symbolic *S, const sl_matrix *matrix) {
    const sl_csc A = sl_matrix_view(matrix);
    const size_t n = (size_t)A.n_rows;
    double *b = bench_alloc(n, sizeof *b), *x = bench_alloc(n, sizeof *x);
    double *r = bench_alloc(n, sizeof *r), error = 0;
    uint64_t random = 5;
    sl_factor *F = NULL;
    bench_random_fill(&random, b, n);
    bench_must(sl_factor_create(&F, S, &A, NULL, &e->system->stats), "factor");
    bench_must(sl_factor_solve(F, x, n, b, n, 1, NULL), "solve");
    bench_must(sl_csc_residual(&A, r, n, &error, x, n, b, n, 1), "residual");
    sl_factor_free(F);
    free(b);
    free(x);
    free(r);
    return bench_expect(run, error < 1e-14 * (double)n, "%s, edited: backward error %g",
                        e->system->name, error);
}

static void time_edits(bench_run *run, bench_report *report, bench_system *system, sl_int side) {
    mesh m;
    edited e;
    memset(&e, 0, sizeof e);
    memset(system, 0, sizeof *system);
    snprintf(system->name, sizeof system->name, "grid %dx%d, edited", (int)side, (int)side);
    e.system = system;
    e.random = 9;
    if (!mesh_grid(&m, side, side, 0.2, 1) || !remesh_create(&e.mesh, &m)) {
        bench_must(SL_ERR_MEMORY, "creating a grid");
    }
    e.t = mesh_mean_edge_length(&m) * mesh_mean_edge_length(&m);
    mesh_free(&m);
    sl_matrix *A = matrix_of(&e);
    const sl_csc a = sl_matrix_view(A);
    sl_symbolic *S = NULL;
    bench_must(sl_symbolic_create(&S, &a, NULL, NULL), "analysis");
    while (e.count < EDITS) {
        edit_once(&e, &S, &A);
    }
    if (check(run, &e, S, A)) {
        bench_row row = {.what = "0.1 % remeshed", .nrhs = 1};
        row.method = "order and analyze anew";
        row.time = bench_sample_of(e.anew, EDITS);
        row.baseline = row.time.median;
        bench_report_row(report, system, &row);
        row.method = "edit";
        row.time = bench_sample_of(e.follow, EDITS);
        bench_report_row(report, system, &row);
        bench_report_note(report,
                          "entries of L: at most %.3f of a new order's; %d of %d edits "
                          "were ordered anew, after %d a new order was due",
                          e.growth, e.is_anew, EDITS, e.is_due);
    }
    sl_symbolic_free(S);
    sl_matrix_free(A);
    remesh_free(&e.mesh);
}

void bench_edit(bench_run *run) {
    static const sl_int sides[] = {100, 316, 1000};
    static bench_system systems[3]; /* the report remembers the last one */
    bench_report *report =
        bench_report_open(run, "edit", "a mesh that is remeshed in places", "a new analysis");
    for (int k = 0; k < (run->size == BENCH_QUICK ? 2 : 3); k++) {
        time_edits(run, report, &systems[k], sides[k]);
    }
    bench_report_note(report, "each edit follows the one before");
    bench_report_close(report);
}

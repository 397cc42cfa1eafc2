/* edit.c: do analysis and factor follow a remeshed patch for less than new ones? */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "bench/lib/bench.h"
#include "tools/geometry/laplacian.h"
#include "tools/mesh/grid.h"
#include "tools/mesh/remesh.h"

/* Edges of 0.1 % of the vertices, around a random one, are split, collapsed and flipped; each
 * edit starts from the analysis of the edit before. The baseline orders and analyzes every mesh
 * anew. Times are those of single calls, as no edit comes twice. The factor follows, too: it is
 * compared with new ones over the new analysis and over the one that followed. Every factor that
 * followed is checked. */
enum { EDITS = 10 };

/* Ways to the factor of an edited matrix. */
enum { FACTOR_ANEW, FACTOR_OVER, FACTOR_EDIT, FACTOR_WAYS };

typedef struct edited {
    remesh mesh;
    bench_system *system; /* what the rows of the table are of: the last matrix, without factor */
    double t;
    uint64_t random;
    sl_factor *F;
    double anew[EDITS], follow[EDITS], factor[FACTOR_WAYS][EDITS];
    int count, is_anew, is_due, factored_anew;
    double kept;   /* columns of L, as a share: the smallest */
    double error;  /* backward error: the largest */
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

/* The backward error of a solution by the factor that followed. */
static double backward_error(const edited *e, const sl_csc *A) {
    const size_t n = (size_t)A->n_rows;
    double *b = bench_alloc(n, sizeof *b), *x = bench_alloc(n, sizeof *x);
    double *r = bench_alloc(n, sizeof *r), error = 0;
    uint64_t random = 5;
    bench_random_fill(&random, b, n);
    bench_must(sl_factor_solve(e->F, x, n, b, n, 1, NULL), "solve");
    bench_must(sl_csc_residual(A, r, n, &error, x, n, b, n, 1), "residual");
    free(b);
    free(x);
    free(r);
    return error;
}

/* The factor follows to the analysis T of B. fresh: another analysis. */
static void factor_once(edited *e, const sl_symbolic *fresh, const sl_symbolic *T, const sl_csc *B,
                        const sl_int *new_of) {
    sl_factor *F[FACTOR_WAYS] = {NULL, NULL, NULL};
    sl_stats stats;
    for (int way = 0; way < FACTOR_WAYS; way++) {
        const double begin = bench_now();
        bench_must(way == FACTOR_EDIT
                       ? sl_factor_edit(&F[way], e->F, T, B, new_of, NULL, &stats)
                       : sl_factor_create(&F[way], way == FACTOR_ANEW ? fresh : T, B, NULL, NULL),
                   "factor");
        e->factor[way][e->count] = bench_now() - begin;
        if (way != FACTOR_EDIT) {
            sl_factor_free(F[way]);
        }
    }
    sl_factor_free(e->F);
    e->F = F[FACTOR_EDIT];
    e->factored_anew += stats.reuse.is_anew;
    e->kept = fmin(e->kept, (double)stats.reuse.kept / B->n_rows);
    e->error = fmax(e->error, backward_error(e, B) / B->n_rows);
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
    e->follow[e->count] = bench_now() - begin;
    e->growth =
        fmax(e->growth, (double)stats.symbolic.nnz_l / (double)e->system->stats.symbolic.nnz_l);
    e->is_anew += stats.edit.is_anew;
    e->is_due += stats.edit.is_due;
    e->system->n = b.n_rows;
    factor_once(e, fresh, T, &b, new_of);
    e->count++;
    sl_symbolic_free(fresh);
    sl_symbolic_free(*S);
    sl_matrix_free(*A);
    free(new_of);
    *S = T;
    *A = B;
}

static void report_edits(bench_report *report, const bench_system *system, edited *e) {
    static const char *const methods[FACTOR_WAYS] = {"factor anew", "over the edited analysis",
                                                     "sl_factor_edit"};
    bench_row row = {.what = "0.1 % remeshed", .nrhs = 1};
    row.method = "order and analyze anew";
    row.time = bench_sample_of(e->anew, EDITS);
    row.baseline = row.time.median;
    bench_report_row(report, system, &row);
    row.method = "edit";
    row.time = bench_sample_of(e->follow, EDITS);
    bench_report_row(report, system, &row);
    for (int way = 0; way < FACTOR_WAYS; way++) {
        row.what = "factor after the edit";
        row.method = methods[way];
        row.time = bench_sample_of(e->factor[way], EDITS);
        row.baseline = way == FACTOR_ANEW ? row.time.median : row.baseline;
        bench_report_row(report, system, &row);
    }
    bench_report_note(report,
                      "entries of L: at most %.3f of a new order's; %d of %d edits "
                      "were ordered anew, after %d a new order was due; at least %.2f of the "
                      "columns of L were kept, %d of %d factors were computed anew",
                      e->growth, e->is_anew, EDITS, e->is_due, e->kept, e->factored_anew, EDITS);
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
    bench_must(sl_factor_create(&e.F, S, &a, NULL, NULL), "factor");
    e.kept = 1;
    while (e.count < EDITS) {
        edit_once(&e, &S, &A);
    }
    if (bench_expect(run, e.error < 1e-14, "%s: backward error %g n", system->name, e.error)) {
        report_edits(report, system, &e);
    }
    sl_factor_free(e.F);
    sl_symbolic_free(S);
    sl_matrix_free(A);
    remesh_free(&e.mesh);
}

void bench_edit(bench_run *run) {
    static const sl_int sides[] = {100, 316, 1000};
    static bench_system systems[3]; /* the report remembers the last one */
    bench_report *report =
        bench_report_open(run, "edit", "a mesh that is remeshed in places", "a new one");
    for (int k = 0; k < (run->size == BENCH_QUICK ? 2 : 3); k++) {
        time_edits(run, report, &systems[k], sides[k]);
    }
    bench_report_note(report, "each edit follows the one before");
    bench_report_close(report);
}

/* command_param.c: sparse-local param: a patch laid out in the plane by a local solve on the whole mesh's factor */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cg.h"
#include "command.h"
#include "harmonic_map.h"
#include "layout_job.h"
#include "product.h"

static const char text[] =
    "Lays a patch of the mesh out in the plane by harmonic coordinates [HDA17, section 4]. The "
    "boundary is laid "
    "out first; the flux that this layout has there (Neumann data, equation 3) is the right-hand "
    "side, nonzero "
    "on the boundary alone, and the Laplacian of the WHOLE mesh is solved for the patch alone, on "
    "a factor made "
    "once: exactly the patch's rows of a full solve. In this problem the mesh beyond the patch "
    "goes on, harmonic, "
    "and takes about half of the flux; --system patch asks for the patch by itself instead, its "
    "boundary free: "
    "another problem, whose solution some ten local solves on the same factor give to 10 digits. "
    "--dirichlet "
    "keeps the boundary where it was laid, the classic harmonic map: that needs a factor of the "
    "patch's inside.\n"
    "Printed figures, of the layout scaled to the area of the patch: conformal energy over area "
    "(0: all angles "
    "kept), mean ratio of the two stretches of a face (1: angles kept), mean squared error of "
    "lengths (0: lengths "
    "kept), spread of the logarithm of areas (0: areas in proportion), faces turned over.";

/* The best of a few repetitions, in seconds. */
enum { REPETITIONS = 5 };

typedef struct job {
    layout_job j;
    sl_int n;
    double *boundary; /* the boundary in the plane */
    double *flux;     /* n x 2: right-hand side */
    double *X;        /* n x 2 */
    double seconds;
    int solves;
} job;

enum { MOST_SOLVES = 60 };

static void solve_mesh(job *q) {
    app_must(patch_solver_mesh(&q->j.s, q->X, q->flux, 2), "solve on the patch", NULL);
    q->solves = 1;
}

static void solve_patch(job *q) {
    q->solves = MOST_SOLVES;
    app_must(patch_solver_part(&q->j.s, q->X, q->flux, 2, 1e-10, &q->solves), "solve on the patch",
             NULL);
}

static void solve_refactor(job *q) {
    const sl_csc N = sl_matrix_view(q->j.s.N);
    app_must(refactor_solve(q->X, &N, q->flux, 2), "factor of the patch", NULL);
    q->solves = 0;
}

static void solve_dirichlet(job *q) {
    app_must(harmonic_dirichlet(q->X, &q->j.d, q->boundary), "factor of the patch's inside", NULL);
    q->solves = 0;
}

static void solve_cg(job *q) {
    const sl_csc N = sl_matrix_view(q->j.s.N);
    sl_matrix *both;
    double *work = app_alloc(4 * (size_t)q->n, sizeof *work);
    if (!csc_both_triangles(&both, &N)) {
        app_die("out of memory");
    }
    const sl_csc A = sl_matrix_view(both);
    q->solves = 0;
    for (size_t c = 0; c < 2; c++) {
        q->solves += cg_jacobi(&A, q->X + c * (size_t)q->n, q->flux + c * (size_t)q->n, 1e-10,
                               1000000, work);
    }
    sl_matrix_free(both);
    free(work);
}

/* The full solve, of all of the mesh. */
static void solve_full(job *q) {
    size_t all = (size_t)q->j.m.n_vertices, n = (size_t)q->n;
    double *B = app_alloc(2 * all, sizeof *B);
    for (size_t k = 0; k < 2 * n; k++) {
        B[k / n * all + (size_t)q->j.d.p.vertices[k % n]] = q->flux[k];
    }
    app_must(sl_factor_solve(q->j.F, B, all, B, all, 2, NULL), "full solve", NULL);
    for (size_t k = 0; k < 2 * n; k++) {
        q->X[k] = B[k / n * all + (size_t)q->j.d.p.vertices[k % n]];
    }
    free(B);
}

static void timed(job *q, void (*solve)(job *)) {
    q->seconds = INFINITY;
    for (int k = 0; k < REPETITIONS; k++) {
        double began = app_now();
        solve(q);
        q->seconds = fmin(q->seconds, app_now() - began);
    }
}

/* Milliseconds of one way. */
static double best(job *q, void (*solve)(job *)) {
    timed(q, solve);
    return 1e3 * q->seconds;
}

/* Largest difference of two layouts but for a shift, against the size of the second. */
static double difference(const double *X, const double *Y, sl_int n) {
    double worst = 0, size = 0;
    for (sl_int c = 0; c < 2; c++) {
        double shift = 0;
        for (sl_int k = c * n; k < (c + 1) * n; k++) {
            shift += (X[k] - Y[k]) / n;
        }
        for (sl_int k = c * n; k < (c + 1) * n; k++) {
            worst = fmax(worst, fabs(X[k] - Y[k] - shift));
            size = fmax(size, fabs(Y[k] - Y[c * n]));
        }
    }
    return size > 0 ? worst / size : worst;
}

/* Milliseconds of the same solves by plans to the roots. */
static double best_to_the_roots(job *q, void (*solve)(job *)) {
    patch_solver inside = q->j.s;
    app_must(patch_solver_create(&q->j.s, q->j.S, q->j.F, &q->j.d.p), "plan of the patch", NULL);
    double milliseconds = best(q, solve);
    patch_solver_free(&q->j.s);
    q->j.s = inside;
    return milliseconds;
}

/* What the region saves each solve, against what it took. */
static void compare_region(job *q) {
    double mesh_roots = best_to_the_roots(q, solve_mesh), mesh_inside = best(q, solve_mesh);
    double part_roots = best_to_the_roots(q, solve_patch), part_inside = best(q, solve_patch);
    double saved = mesh_roots - mesh_inside;
    printf("in the region, and to the roots\n");
    printf("%-52s %10.3f  %.3f to the roots\n", "  local solve of the mesh's problem", mesh_inside,
           mesh_roots);
    printf("  local solves of the patch's own: %4d%*s %10.3f  %.3f to the roots\n", q->solves, 15,
           "", part_inside, part_roots);
    if (saved > 0) {
        printf("  the region has paid after %.0f local solves\n",
               ceil(1e3 * q->j.seconds_region / saved));
    }
}

/* False: the local solve is not the full one, to the bit or, in a region, to rounding, or the ways to the patch's own
 * solution differ. */
static bool compare(job *q) {
    double local, by_mesh;
    size_t bytes = 2 * (size_t)q->n * sizeof *q->X;
    double *kept = app_alloc(1, bytes), *reference = app_alloc(1, bytes);
    memcpy(kept, q->X, bytes);
    printf("\n%-52s %10s  %s\n", "best of 5, two right-hand sides", "ms", "difference");
    printf("the mesh's problem, L x = b\n");
    timed(q, solve_full);
    memcpy(reference, q->X, bytes);
    printf("%-52s %10.3f\n", "  full solve of the whole mesh", 1e3 * q->seconds);
    timed(q, solve_mesh);
    local = difference(q->X, reference, q->n);
    printf("%-52s %10.3f  %.2g from the full solve\n", "  local solve (its plan is made)",
           1e3 * q->seconds, local);
    printf("the patch's own problem, N x = b\n");
    timed(q, solve_refactor);
    memcpy(reference, q->X, bytes);
    printf("%-52s %10.3f\n", "  refactorize the patch and solve", 1e3 * q->seconds);
    timed(q, solve_cg);
    printf(
        "  conjugate gradients, Jacobi: %6d iterations in all%*s %9.3f  %.2g from refactorizing\n",
        q->solves, 7, "", 1e3 * q->seconds, difference(q->X, reference, q->n));
    timed(q, solve_patch);
    by_mesh = difference(q->X, reference, q->n);
    printf("  the mesh's factor: %4d local solves%*s %10.3f  %.2g from refactorizing\n", q->solves,
           16, "", 1e3 * q->seconds, by_mesh);
    if (q->j.region) {
        compare_region(q);
    }
    printf("boundary kept\n");
    timed(q, solve_dirichlet);
    printf("%-52s %10.3f\n", "  refactorize the patch's inside and solve", 1e3 * q->seconds);
    memcpy(q->X, kept, bytes);
    free(reference);
    free(kept);
    return local <= (q->j.region ? 1e-8 : 0) && by_mesh <= 1e-5;
}

/* Right-hand side, boundary and room for the patch that the job has now. */
static void begin_patch(job *q) {
    q->n = q->j.d.p.m.n_vertices;
    q->boundary = layout_job_boundary(&q->j);
    q->flux = layout_job_flux(&q->j, q->boundary);
    q->X = app_alloc(2 * (size_t)q->n, sizeof *q->X);
}

static void end_patch(job *q) {
    free(q->X);
    free(q->flux);
    free(q->boundary);
}

/* The times of the paper's Figures 4 and 5 on this mesh: patches of several sizes. */
static void sweep(job *q, const char *text_of_sizes) {
    sl_int count;
    sl_int *sizes = app_vertices("sweep", text_of_sizes, q->j.m.n_vertices + 1, 1, &count);
    printf(
        "\nmilliseconds, two right-hand sides. first: the plans, the patch's own Laplacian, and a "
        "solve;\nthen the best of %d\n"
        "%8s %8s %10s %10s %10s %12s %12s\n",
        REPETITIONS, "patch", "boundary", "first", "local", "full", "refactorize", "conj. grad.");
    for (sl_int k = 0; k < count; k++) {
        app_progress("patches", (double)k / (double)count);
        layout_job_regrow(&q->j, sizes[k]);
        begin_patch(q);
        double began = app_now();
        solve_mesh(q);
        double first = 1e3 * (q->j.seconds_plan + q->j.seconds_region + app_now() - began),
               local = best(q, solve_mesh);
        double full = best(q, solve_full), refactor = best(q, solve_refactor);
        double gradients = best(q, solve_cg);
        app_progress_end();
        printf("%8d %8d %10.3f %10.3f %10.3f %12.3f %12.3f\n", (int)q->n, (int)q->j.d.n_boundary,
               first, local, full, refactor, gradients);
        end_patch(q);
    }
    free(sizes);
}

int command_param(int argc, char **argv) {
    job q;
    bool with_compare = false, dirichlet = false;
    const char *system = "mesh", *sizes = NULL, *operand = NULL;
    memset(&q, 0, sizeof q);
    layout_job_defaults(&q.j);
    const option options[] = {
        LAYOUT_JOB_OPTIONS(&q.j),
        {OPTION_TEXT, "system", &system, "mesh|patch",
         "whose problem is solved: the whole mesh's, as the paper does, or the patch's own (mesh)"},
        {OPTION_FLAG, "dirichlet", &dirichlet, NULL,
         "keep the boundary where it is laid: the classic harmonic map"},
        {OPTION_FLAG, "compare", &with_compare, NULL,
         "time it beside a full solve, refactorizing the patch, and conjugate gradients"},
        {OPTION_TEXT, "sweep", &sizes, "SIZES",
         "then time patches of these sizes, 2000,10000,30000,50000 say, in all ways"},
        {OPTION_END, NULL, NULL, NULL, NULL}};
    const options_usage usage = {"param", "MESH", 1, 1, text};
    options_read(&usage, options, argc, argv, &operand);
    if (strcmp(system, "mesh") != 0 && strcmp(system, "patch") != 0) {
        app_die_usage("--system %s: not mesh or patch", system);
    }
    layout_job_open(&q.j, operand);
    begin_patch(&q);
    double began = app_now();
    if (dirichlet) {
        solve_dirichlet(&q);
        printf("solve      inside of the patch factored and solved: %.3f ms\n",
               1e3 * (app_now() - began));
    } else if (strcmp(system, "mesh") == 0) {
        solve_mesh(&q);
        printf("solve      the mesh's problem, 1 local solve: %.3f ms\n",
               1e3 * (app_now() - began));
    } else {
        solve_patch(&q);
        printf("solve      the patch's own problem, %d local solves: %.3f ms\n", q.solves,
               1e3 * (app_now() - began));
    }
    layout_job_report_head();
    (void)layout_job_report(&q.j, dirichlet ? "Dirichlet" : "Neumann", q.X);
    bool agree = !with_compare || compare(&q);
    if (!agree) {
        printf("the ways differ by more than rounding\n");
    }
    layout_job_write(&q.j, q.X);
    end_patch(&q);
    if (sizes != NULL) {
        sweep(&q, sizes);
    }
    layout_job_close(&q.j);
    return agree ? 0 : 1;
}

/* command_param.c: harmonic layout of a patch by a local solve with the factor of the whole mesh */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "tools/matrix/cg.h"
#include "command.h"
#include "tools/geometry/harmonic_map.h"
#include "layout_command.h"
#include "layout_solve.h"
#include "tools/matrix/sparse_product.h"

static const options_usage usage = {"param", "MESH", 1, 1,
                                    "Computes a planar layout of a patch by harmonic coordinates."};

static const options_manual manual = {
    "The method of [HDA17], section 4. The boundary is laid out first. The normal derivative of "
    "that "
    "layout along the boundary (Neumann data, equation 3) is the right-hand side, which is nonzero "
    "only at the boundary. The Laplacian of the whole mesh is solved on the patch alone with a "
    "factor that is computed once; the result equals the patch's rows of a full solve. In this "
    "problem the solution continues harmonically outside the patch, which takes about half of the "
    "flux. --system patch solves the Laplacian of the patch alone with a free boundary, a "
    "different "
    "problem; 10 to 30 local solves with the same factor give its solution to 10 digits, and where "
    "they do not, a factor of the patch does. By default the system of the mesh is solved, but "
    "that "
    "of the patch if the patch has a seam or if fewer faces are flipped. "
    "--dirichlet fixes the boundary where it was laid out, the classical harmonic map; this "
    "factors "
    "the interior of the patch.",
    LAYOUT_OUTPUT
    " Exit status 1: the system was not solved, or methods of --compare differ."
    "\n--compare: milliseconds of each method, best of up to 5, and the difference of its result. "
    "Conjugate gradients stop after 1000 + 4 n iterations.\n"
    "--sweep: the same for patches of several sizes, as in Figures 4 and 5 of the paper.",
    "star:6 --center 100 --patch 2000 --png mesh.png --layout layout.png\n"
    "bunny.obj --patch 2000 --compare --sweep 500,1000,5000"};

/* Times are the best of this many repetitions, fewer if these take more than a second. */
enum { REPETITIONS = 5 };

/* Relative differences of solutions above this are reported. */
#define AGREEMENT 1e-7

typedef struct param_command {
    layout_command layout;
    sl_int n;         /* vertices of the patch */
    double *boundary; /* layout of the boundary */
    double *flux;     /* n x 2, column-major: right-hand side */
    double *X;        /* n x 2, column-major: layout */
    int solves;       /* local solves or iterations of the last solve */
    patch_report how; /* of the last solve_patch */
    bool cg_stopped;  /* conjugate gradients have reached their limit */
} param_command;

static void solve_mesh(param_command *cmd) {
    app_must(patch_solver_solve_mesh(&cmd->layout.s, cmd->X, cmd->flux, 2), "solve on the patch",
             NULL);
    cmd->solves = 1;
}

static void solve_patch(param_command *cmd) {
    app_must(patch_solver_solve_exact(&cmd->layout.s, cmd->X, cmd->flux, 2, &cmd->how),
             "solve on the patch", NULL);
    cmd->solves = cmd->how.solves;
}

static void solve_refactor(param_command *cmd) {
    const sl_csc N = sl_matrix_view(cmd->layout.s.N);
    app_must(factor_and_solve(cmd->X, &N, cmd->flux, 2), "factor of the patch", NULL);
    cmd->solves = 0;
}

static void solve_dirichlet(param_command *cmd) {
    app_must(harmonic_dirichlet(cmd->X, &cmd->layout.d, cmd->boundary),
             "factor of the interior of the patch", NULL);
    cmd->solves = 0;
}

static void solve_cg(param_command *cmd) {
    const sl_csc N = sl_matrix_view(cmd->layout.s.N);
    sl_matrix *both;
    double *work = app_alloc(4 * (size_t)cmd->n, sizeof *work);
    if (!csc_expand_symmetric(&both, &N)) {
        app_die("out of memory");
    }
    const sl_csc A = sl_matrix_view(both);
    const int limit = cmd->n < INT32_MAX / 8 ? 1000 + 4 * (int)cmd->n : INT32_MAX / 2;
    cmd->solves = 0;
    cmd->cg_stopped = false;
    for (size_t c = 0; c < 2; c++) {
        int steps = cg_jacobi(&A, cmd->X + c * (size_t)cmd->n, cmd->flux + c * (size_t)cmd->n,
                              1e-10, limit, work);
        cmd->cg_stopped = cmd->cg_stopped || steps == limit;
        cmd->solves += steps;
    }
    sl_matrix_free(both);
    free(work);
}

/* A full solve on the whole mesh. */
static void solve_full(param_command *cmd) {
    size_t all = (size_t)cmd->layout.m.n_vertices, n = (size_t)cmd->n;
    double *B = app_alloc(2 * all, sizeof *B);
    for (size_t k = 0; k < 2 * n; k++) {
        B[k / n * all + (size_t)cmd->layout.d.p.vertices[k % n]] = cmd->flux[k];
    }
    app_must(sl_factor_solve(cmd->layout.F, B, all, B, all, 2, NULL), "full solve", NULL);
    for (size_t k = 0; k < 2 * n; k++) {
        cmd->X[k] = B[k / n * all + (size_t)cmd->layout.d.p.vertices[k % n]];
    }
    free(B);
}

/* Milliseconds of a method, best of REPETITIONS. */
static double best_ms(param_command *cmd, void (*solve)(param_command *)) {
    double seconds = INFINITY, first = app_now();
    for (int k = 0; k < REPETITIONS && (k == 0 || app_now() - first < 1); k++) {
        double began = app_now();
        solve(cmd);
        seconds = fmin(seconds, app_now() - began);
    }
    return 1e3 * seconds;
}

/* Largest difference between two layouts up to a translation, relative to the size of the
 * second. */
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

/* Milliseconds of a method by plans without a region, best of REPETITIONS. */
static double best_ms_without_region(param_command *cmd, void (*solve)(param_command *)) {
    patch_solver in_region = cmd->layout.s;
    app_must(patch_solver_create(&cmd->layout.s, cmd->layout.S, cmd->layout.F, &cmd->layout.d.p),
             "plan of the patch", NULL);
    double milliseconds = best_ms(cmd, solve);
    patch_solver_free(&cmd->layout.s);
    cmd->layout.s = in_region;
    return milliseconds;
}

/* Prints a method, with a count of its units where unit is not NULL, and its time. */
static void print_time(const char *method, int count, const char *unit, double milliseconds) {
    char text[64];
    if (unit != NULL) {
        (void)snprintf(text, sizeof text, "%s: %d %s", method, count, unit);
        method = text;
    }
    printf("  %-50s %10.3f", method, milliseconds);
}

/* Compares what the region saves per solve with the time it took to create. */
static void compare_region(param_command *cmd) {
    double mesh_without = best_ms_without_region(cmd, solve_mesh);
    double mesh_region = best_ms(cmd, solve_mesh);
    double patch_without = best_ms_without_region(cmd, solve_patch);
    double patch_region = best_ms(cmd, solve_patch);
    double saved = mesh_without - mesh_region;
    printf("in the region, and without it\n");
    print_time("system of the mesh: one local solve", 0, NULL, mesh_region);
    printf("  %.3f without\n", mesh_without);
    print_time("system of the patch", cmd->solves, "local solves", patch_region);
    printf("  %.3f without\n", patch_without);
    if (saved > 0) {
        printf("  the region pays for itself after %.0f local solves\n",
               ceil(1e3 * cmd->layout.seconds_region / saved));
    }
}

/* Times all methods. False: the local solve differs from the full one (bitwise, or in a region by
 * more than rounding), or the methods for the system of the patch disagree. */
static bool compare(param_command *cmd) {
    size_t bytes = 2 * (size_t)cmd->n * sizeof *cmd->X;
    double *kept = app_alloc(1, bytes), *reference = app_alloc(1, bytes);
    memcpy(kept, cmd->X, bytes);
    printf("\n%-52s %10s  %s\n", "best of 5, two right-hand sides", "ms", "difference");
    app_stage("comparing");
    printf("system of the mesh, L x = b\n");
    print_time("full solve of the whole mesh", 0, NULL, best_ms(cmd, solve_full));
    memcpy(reference, cmd->X, bytes);
    printf("\n");
    print_time("local solve on an existing plan", 0, NULL, best_ms(cmd, solve_mesh));
    double local = difference(cmd->X, reference, cmd->n);
    printf("  %.2g from the full solve\n", local);
    printf("system of the patch, N x = b\n");
    print_time("refactorize the patch and solve", 0, NULL, best_ms(cmd, solve_refactor));
    memcpy(reference, cmd->X, bytes);
    printf("\n");
    double milliseconds = best_ms(cmd, solve_cg);
    print_time("conjugate gradients, Jacobi", cmd->solves, "iterations", milliseconds);
    printf("  %.2g from refactorizing%s\n", difference(cmd->X, reference, cmd->n),
           cmd->cg_stopped ? ", not converged" : "");
    milliseconds = best_ms(cmd, solve_patch);
    double by_mesh_factor = difference(cmd->X, reference, cmd->n);
    print_time(cmd->how.own_factor ? "factor of the mesh, then of the patch" : "factor of the mesh",
               cmd->solves, "local solves", milliseconds);
    printf("  %.2g from refactorizing\n", by_mesh_factor);
    if (cmd->layout.region) {
        compare_region(cmd);
    }
    printf("fixed boundary\n");
    print_time("refactorize the interior and solve", 0, NULL, best_ms(cmd, solve_dirichlet));
    printf("\n");
    memcpy(cmd->X, kept, bytes);
    free(reference);
    free(kept);
    if (cmd->cg_stopped) {
        app_warn("conjugate gradients did not reach a residual of 1e-10 in 1000 + 4 n iterations");
    }
    if (!(local <= (cmd->layout.region ? AGREEMENT : 0))) {
        app_warn("the local solve differs from the full solve by %.2g of the layout", local);
    }
    if (!(by_mesh_factor <= AGREEMENT)) {
        app_warn("the factors of the mesh and of the patch give layouts that differ by %.2g of "
                 "their size; residual %.1e, backward error %.1e: the system is ill-conditioned",
                 by_mesh_factor, cmd->how.residual, cmd->how.backward_error);
    }
    return local <= (cmd->layout.region ? AGREEMENT : 0) && by_mesh_factor <= AGREEMENT;
}

/* Computes the boundary layout and right-hand side of the current patch and allocates X. */
static void begin_patch(param_command *cmd) {
    cmd->n = cmd->layout.d.p.m.n_vertices;
    cmd->boundary = layout_command_boundary(&cmd->layout);
    cmd->flux = layout_command_flux(&cmd->layout, cmd->boundary);
    cmd->X = app_alloc(2 * (size_t)cmd->n, sizeof *cmd->X);
}

static void end_patch(param_command *cmd) {
    free(cmd->X);
    free(cmd->flux);
    free(cmd->boundary);
}

/* Times of patches of several sizes, as in Figures 4 and 5 of the paper. */
static void sweep(param_command *cmd, const char *text_of_sizes) {
    sl_int count;
    sl_int *sizes = app_vertices("sweep", text_of_sizes, cmd->layout.m.n_vertices + 1, 1, &count);
    printf(
        "\nmilliseconds, two right-hand sides, best of %d; first: plans, Laplacian of the patch, "
        "and one solve\n"
        "%8s %8s %10s %10s %10s %12s %12s\n",
        REPETITIONS, "patch", "boundary", "first", "local", "full", "refactorize", "conj. grad.");
    for (sl_int k = 0; k < count; k++) {
        app_progress("patches", (double)k / (double)count);
        layout_command_regrow(&cmd->layout, sizes[k]);
        begin_patch(cmd);
        double began = app_now();
        solve_mesh(cmd);
        double first = 1e3 *
                       (cmd->layout.seconds_plan + cmd->layout.seconds_region + app_now() - began),
               local = best_ms(cmd, solve_mesh);
        double full = best_ms(cmd, solve_full), refactor = best_ms(cmd, solve_refactor);
        double gradients = best_ms(cmd, solve_cg);
        app_progress_end();
        printf("%8d %8d %10.3f %10.3f %10.3f %12.3f %12.3f\n", (int)cmd->n,
               (int)cmd->layout.d.n_boundary, first, local, full, refactor, gradients);
        end_patch(cmd);
    }
    free(sizes);
}

static bool solve(param_command *cmd, layout_system wanted) {
    layout_solution how = layout_solve(&cmd->layout, cmd->X, cmd->flux, wanted);
    return layout_print_solution(&cmd->layout, &how);
}

/* The residual is that of N x = 0 at the vertices inside, relative to |N| |x|. */
static bool fix_boundary(param_command *cmd) {
    size_t n = (size_t)cmd->n;
    double *Y = app_alloc(2 * n, sizeof *Y), began = app_now();
    patch_report how;
    solve_dirichlet(cmd);
    printf("solve      fixed boundary, interior factored and solved: %.3f ms\n",
           1e3 * (app_now() - began));
    /* N x is the right-hand side that a free boundary would need; it vanishes inside */
    app_must(patch_solver_apply(&cmd->layout.s, Y, cmd->X, 2), "residual", NULL);
    double *boundary = app_alloc(2 * (size_t)cmd->layout.d.n_boundary, sizeof *boundary);
    for (sl_int k = 0; k < cmd->layout.d.n_boundary; k++) {
        boundary[k] = Y[cmd->layout.d.boundary[k]];
        boundary[cmd->layout.d.n_boundary + k] = Y[n + (size_t)cmd->layout.d.boundary[k]];
    }
    boundary_scatter(Y, boundary, &cmd->layout.d);
    app_must(patch_solver_measure(&cmd->layout.s, &how, cmd->X, Y, 2), "residual", NULL);
    bool solved = how.residual <= 1e-10 || how.backward_error <= 1e-10;
    printf("residual   %.1e inside the patch, relative to the flux at the boundary; backward error "
           "%.1e\n",
           how.residual, how.backward_error);
    if (!solved) {
        app_warn("the layout is not harmonic inside the patch: residual %.1e, backward error %.1e",
                 how.residual, how.backward_error);
    }
    free(boundary);
    free(Y);
    return solved;
}

int command_param(int argc, char **argv) {
    param_command cmd;
    bool with_compare = false, dirichlet = false;
    const char *system = "auto", *sizes = NULL, *operand = NULL;
    memset(&cmd, 0, sizeof cmd);
    layout_command_defaults(&cmd.layout);
    const option options[] = {
        LAYOUT_OPTIONS(&cmd.layout),
        {OPTION_TEXT, "system", &system, "auto|mesh|patch",
         "the system to solve: the Laplacian of the whole mesh, as in the paper, or of the patch "
         "(auto)"},
        {OPTION_FLAG, "dirichlet", &dirichlet, NULL,
         "fix the boundary at its initial layout: the classical harmonic map"},
        {OPTION_FLAG, "compare", &with_compare, NULL,
         "also time a full solve, refactorizing the patch, and conjugate gradients"},
        {OPTION_TEXT, "sweep", &sizes, "SIZES",
         "also time all methods on patches of these sizes, such as 2000,10000,30000"},
        APP_WELD_OPTION,
        {OPTION_END, NULL, NULL, NULL, NULL}};
    options_read(&usage, &manual, options, argc, argv, &operand);
    const layout_system wanted = layout_system_named(system);
    layout_command_open(&cmd.layout, operand);
    begin_patch(&cmd);
    bool solved = dirichlet ? fix_boundary(&cmd) : solve(&cmd, wanted);
    layout_command_report_head();
    distortion q = layout_command_report(&cmd.layout, dirichlet ? "Dirichlet" : "Neumann", cmd.X);
    layout_warn(&cmd.layout, cmd.X, &q);
    bool agree = !with_compare || compare(&cmd);
    layout_command_write(&cmd.layout, cmd.X);
    end_patch(&cmd);
    if (sizes != NULL) {
        sweep(&cmd, sizes);
    }
    layout_command_close(&cmd.layout);
    return solved && agree ? 0 : 1;
}

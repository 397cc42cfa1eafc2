/* command_arap.c: as-rigid-as-possible layout of a patch, with the factor of the whole mesh */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "tools/geometry/arap.h"
#include "command.h"
#include "layout_command.h"
#include "layout_solve.h"

static const options_usage usage = {
    "arap", "MESH", 1, 1,
    "Computes a planar layout of a patch that preserves lengths as well as possible."};

static const options_manual manual = {
    "Starts from the harmonic layout and alternates between rotations of the faces and a Poisson "
    "problem for the vertices (Liu et al. 2008); the matrix is the same in all iterations. It is "
    "the Laplacian N of the patch alone, with a free boundary. The Laplacian L of the whole mesh "
    "is a different matrix: a solve with L would also penalize distortion of the mesh outside the "
    "patch. The factor of L therefore serves as a preconditioner: each iteration makes --solves "
    "local solves, after which N x = b holds except for a residual on the boundary. With 1 solve "
    "the energy never increases; with 2 an iteration is nearly as effective as an exact one. "
    "--own-factor factors N and makes exact steps; so does the command where a step with the "
    "factor of the mesh does not halve the residual. All converge to layouts with the same energy, "
    "as far as the energy has one minimum near the start. If faces are flipped at the end and none "
    "was at the start, all is repeated with steps that are shortened so that none is flipped "
    "(Smith and Schaefer 2015).",
    LAYOUT_OUTPUT
    "\nenergy: mean over the patch of (a - 1)^2 + (b - 1)^2, a and b the singular values of the "
    "map of a face, after 1, 2, 5, 10, ... iterations. residual: gradient of the energy relative "
    "to "
    "the forces b, ||b - N x|| / ||b||. Exit status 1: not converged within --iterations.",
    "torus:120x40 --center 100 --patch 800 --png mesh.png --layout layout.png\n"
    "bunny.obj --patch 2000 --boundary unrolled --out patch.obj"};

typedef struct arap_command {
    layout_command layout;
    sl_int iterations, solves;
    double tolerance;
    bool own_factor; /* steps are exact, with the patch's own factor */
    bool keep;       /* shorten steps, so that no face is turned over */
} arap_command;

static void factor_patch(arap_command *cmd) {
    double began = app_now();
    app_must(patch_solver_factor_patch(&cmd->layout.s), "factor of the patch", NULL);
    printf("factor     of the patch alone: %.2f ms\n", 1e3 * (app_now() - began));
}

static void global_step(arap_command *cmd, arap *a, double *X, sl_work *work) {
    app_must(cmd->own_factor ? arap_global_step_exact(a, X, cmd->layout.s.own_F, work)
                             : arap_global_step(a, X, &cmd->layout.s, (int)cmd->solves),
             "global step", NULL);
}

/* Whether a step with the factor of the mesh does not come near an exact one: the gradient for
 * fixed rotations is not halved. */
static bool step_is_poor(arap *a, const double *X, const patch_solver *s, double before) {
    double after = arap_residual(a, X, s);
    return !(after <= 0.5 * before) && after > 1e-12;
}

/* Changes from the factor of the mesh to the patch's own, which makes exact steps. */
static void change_factor(arap_command *cmd, sl_int iteration) {
    printf("           iteration %d: the factor of the mesh converges too slowly on this patch\n",
           (int)iteration);
    cmd->own_factor = true;
    factor_patch(cmd);
}

/* Every 1, 2, 5, 10, 20, 50, ... iterations. */
static bool is_printed(sl_int k) {
    while (k % 10 == 0) {
        k /= 10;
    }
    return k == 1 || k == 2 || k == 5;
}

/* Iterates until a step lowers the energy by at most --tolerance of itself. False: the iterations
 * were used up before that. */
static bool iterate(arap_command *cmd, double *X) {
    arap a;
    sl_work *work = NULL;
    const patch_solver *s = &cmd->layout.s;
    if (!arap_create(&a, &cmd->layout.d.p)) {
        app_die("out of memory");
    }
    app_must(sl_work_create(&work, NULL), "workspace", NULL);
    double energy = arap_local_step(&a, X), lowered = INFINITY, began = app_now();
    double residual = arap_residual(&a, X, s);
    const size_t room = 2 * (size_t)cmd->layout.d.p.m.n_vertices;
    double *before = cmd->keep ? app_alloc(room, sizeof *before) : NULL;
    sl_int shortened = 0;
    bool done = residual <= 1e-14;
    sl_int k = 0;
    printf("energy     %.6g initially, residual %.1e\n", energy, residual);
    while (!done && k < cmd->iterations) {
        k++;
        if (cmd->keep) {
            memcpy(before, X, room * sizeof *X);
        }
        global_step(cmd, &a, X, work);
        bool poor = !cmd->own_factor && step_is_poor(&a, X, s, residual);
        shortened += cmd->keep && arap_shorten_step(&a, X, before) < 1;
        double next = arap_local_step(&a, X);
        residual = arap_residual(&a, X, s);
        lowered = energy > 0 ? (energy - next) / energy : 0;
        done = !(lowered > cmd->tolerance) || residual <= 1e-14;
        energy = next;
        if (poor && residual > 1e-14) {
            change_factor(cmd, k);
            done = false;
        }
        if (is_printed(k) || done || k == cmd->iterations) {
            printf("           %.6g after %d, residual %.1e\n", energy, (int)k, residual);
        }
        app_progress("iterations", (double)k / (double)cmd->iterations);
    }
    app_progress_end();
    printf("time       %.3f ms for all iterations\n", 1e3 * (app_now() - began));
    if (shortened > 0) {
        printf("steps      %d were shortened so that no face is turned over\n", (int)shortened);
    }
    free(before);
    if (!done || !isfinite(energy)) {
        app_warn("arap has not converged after %d iterations: the last one lowered the energy by "
                 "%.1e of itself, the residual is %.1e; raise --iterations",
                 (int)k, lowered, residual);
    }
    sl_work_free(work);
    arap_free(&a);
    return done && isfinite(energy);
}

int command_arap(int argc, char **argv) {
    arap_command cmd;
    const char *operand = NULL;
    memset(&cmd, 0, sizeof cmd);
    cmd.iterations = 2000;
    cmd.solves = 2;
    cmd.tolerance = 1e-6;
    layout_command_defaults(&cmd.layout);
    const option options[] = {
        LAYOUT_OPTIONS(&cmd.layout),
        {OPTION_COUNT, "iterations", &cmd.iterations, "N", "maximum number of iterations (2000)"},
        {OPTION_REAL, "tolerance", &cmd.tolerance, "E",
         "converged when an iteration lowers the energy by at most E of itself (1e-6)"},
        {OPTION_COUNT, "solves", &cmd.solves, "N",
         "local solves with the factor of the mesh per iteration (2)"},
        {OPTION_FLAG, "own-factor", &cmd.own_factor, NULL,
         "factor the Laplacian of the patch and solve every global step exactly"},
        APP_WELD_OPTION,
        {OPTION_END, NULL, NULL, NULL, NULL}};
    options_read(&usage, &manual, options, argc, argv, &operand);
    if (!(cmd.tolerance >= 0)) {
        app_die_usage("--tolerance: expected 0 or more");
    }
    if (cmd.solves < 1 || cmd.solves > 1000) {
        app_die_usage("--solves: expected 1 to 1000");
    }
    layout_command_open(&cmd.layout, operand);
    double *X = layout_start(&cmd.layout);
    if (cmd.own_factor) {
        factor_patch(&cmd);
    }
    layout_command_report_head();
    const bool may_keep = layout_command_report(&cmd.layout, "harmonic", X).flipped == 0;
    const size_t room = 2 * (size_t)cmd.layout.d.p.m.n_vertices;
    double *start = app_alloc(room, sizeof *start);
    memcpy(start, X, room * sizeof *X);
    bool converged = iterate(&cmd, X);
    layout_command_report_head();
    distortion q = layout_command_report(&cmd.layout, "as rigid as possible", X);
    if (q.flipped > 0 && may_keep) {
        printf("again      from the harmonic layout, which flips none, with shorter steps\n");
        memcpy(X, start, room * sizeof *X);
        cmd.keep = true;
        converged = iterate(&cmd, X);
        layout_command_report_head();
        q = layout_command_report(&cmd.layout, "as rigid as possible", X);
    }
    free(start);
    layout_warn(&cmd.layout, X, &q);
    layout_command_write(&cmd.layout, X);
    free(X);
    layout_command_close(&cmd.layout);
    return converged ? 0 : 1;
}

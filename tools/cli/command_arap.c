/* command_arap.c: as-rigid-as-possible layout of a patch, with the factor of the whole mesh */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "tools/geometry/arap.h"
#include "command.h"
#include "layout_command.h"

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
    "the energy never increases; with 2 an iteration is nearly as effective as an exact one. Both "
    "converge to the same layouts. --own-factor factors N and makes exact steps.",
    LAYOUT_OUTPUT
    "\nenergy: mean over the patch of (a - 1)^2 + (b - 1)^2, a and b the singular values of the "
    "map of a face, after each iteration.",
    "torus:120x40 --center 100 --patch 800 --png mesh.png --layout layout.png\n"
    "bunny.obj --patch 2000 --iterations 30 --out patch.obj"};

typedef struct arap_command {
    layout_command layout;
    sl_int iterations, solves;
    bool own_factor;
    sl_symbolic *S; /* analysis of N, with --own-factor */
    sl_factor *F;   /* factor of N, with --own-factor */
} arap_command;

static void factor_patch(arap_command *cmd) {
    const sl_csc N = sl_matrix_view(cmd->layout.s.N);
    sl_options opt;
    memset(&opt, 0, sizeof opt);
    opt.null_pivots = SL_NULL_PIVOT_SKIP;
    double began = app_now();
    app_must(sl_symbolic_create(&cmd->S, &N, NULL, NULL), "analysis of the patch", NULL);
    app_must(sl_factor_create(&cmd->F, cmd->S, &N, &opt, NULL), "factor of the patch", NULL);
    printf("factor     of the patch alone: %.2f ms\n", 1e3 * (app_now() - began));
}

/* Iterates until the energy decreases by 1e-6 of itself or less, at most --iterations times. */
static void iterate(arap_command *cmd, double *X) {
    arap a;
    sl_work *work = NULL;
    if (!arap_create(&a, &cmd->layout.d.p)) {
        app_die("out of memory");
    }
    app_must(sl_work_create(&work, NULL), "workspace", NULL);
    double energy = arap_local_step(&a, X), seconds = 0;
    printf("energy     %.6g initially\n", energy);
    for (sl_int k = 1; k <= cmd->iterations; k++) {
        double began = app_now();
        app_must(cmd->own_factor ? arap_global_step_exact(&a, X, cmd->F, work)
                                 : arap_global_step(&a, X, &cmd->layout.s, (int)cmd->solves),
                 "global step", NULL);
        double next = arap_local_step(&a, X);
        seconds += app_now() - began;
        printf("           %.6g after %d\n", next, (int)k);
        app_progress("iterations", (double)k / (double)cmd->iterations);
        if (!(energy - next > 1e-6 * energy)) {
            break;
        }
        energy = next;
    }
    app_progress_end();
    printf("time       %.3f ms for all iterations\n", 1e3 * seconds);
    sl_work_free(work);
    arap_free(&a);
}

int command_arap(int argc, char **argv) {
    arap_command cmd;
    const char *operand = NULL;
    memset(&cmd, 0, sizeof cmd);
    cmd.iterations = 10;
    cmd.solves = 2;
    layout_command_defaults(&cmd.layout);
    const option options[] = {
        LAYOUT_OPTIONS(&cmd.layout),
        {OPTION_COUNT, "iterations", &cmd.iterations, "N", "maximum number of iterations (10)"},
        {OPTION_COUNT, "solves", &cmd.solves, "N",
         "local solves with the factor of the mesh per iteration (2)"},
        {OPTION_FLAG, "own-factor", &cmd.own_factor, NULL,
         "factor the Laplacian of the patch and solve every global step exactly"},
        {OPTION_END, NULL, NULL, NULL, NULL}};
    options_read(&usage, &manual, options, argc, argv, &operand);
    if (cmd.solves < 1 || cmd.solves > 1000) {
        app_die_usage("--solves: expected 1 to 1000");
    }
    layout_command_open(&cmd.layout, operand);
    double *X = layout_command_harmonic(&cmd.layout);
    if (cmd.own_factor) {
        factor_patch(&cmd);
    }
    layout_command_report_head();
    (void)layout_command_report(&cmd.layout, "harmonic", X);
    iterate(&cmd, X);
    layout_command_report_head();
    (void)layout_command_report(&cmd.layout, "as rigid as possible", X);
    layout_command_write(&cmd.layout, X);
    free(X);
    sl_factor_free(cmd.F);
    sl_symbolic_free(cmd.S);
    layout_command_close(&cmd.layout);
    return 0;
}

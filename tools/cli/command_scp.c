/* command_scp.c: spectral conformal layout of a patch */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "command.h"
#include "tools/geometry/conformal.h"
#include "layout_command.h"

static const options_usage usage = {
    "scp", "MESH", 1, 1,
    "Computes a planar layout of a patch that preserves angles as well as possible."};

static const options_manual manual = {
    "The boundary is free. The layout is the eigenvector of the conformal energy with the smallest "
    "eigenvalue above those of the constants (Mullen et al. 2008), by inverse iteration from the "
    "harmonic layout; 2 to 5 iterations suffice. The harmonic layout uses the factor of the whole "
    "mesh. Inverse iteration needs a factor of the patch: the conformal energy is the Dirichlet "
    "energy minus the area. The area terms couple the two coordinates along the boundary of the "
    "patch and cancel the Laplacian on all conformal maps, so that a few solves with the Laplacian "
    "of the mesh cannot replace it. --descend N decreases the same energy in N steps with the "
    "factor of the mesh, one local solve each. The result is a conformal layout near the harmonic "
    "one, not the eigenvector.",
    LAYOUT_OUTPUT
    "\nlambda: conformal energy divided by the sum of squares at the boundary, after each "
    "iteration.",
    "torus:120x40 --center 100 --patch 800 --png mesh.png --layout layout.png\n"
    "bunny.obj --patch 2000 --descend 4 --csv layout.csv"};

typedef struct scp_command {
    layout_command layout;
    sl_int iterations, descend;
} scp_command;

static void spectral(scp_command *cmd, double *X) {
    conformal c;
    double began = app_now(), lambda = 0, before = INFINITY;
    app_must(conformal_create(&c, &cmd->layout.d, cmd->layout.s.N),
             "factor of the patch's conformal energy", NULL);
    printf("factor     of the conformal energy of the patch: %.2f ms\n", 1e3 * (app_now() - began));
    for (sl_int k = 1; k <= cmd->iterations; k++) {
        began = app_now();
        app_must(conformal_iterate(&c, X, &lambda), "inverse iteration", NULL);
        printf("lambda     %.9g after %d (%.3f ms)\n", lambda, (int)k, 1e3 * (app_now() - began));
        app_progress("iterations", (double)k / (double)cmd->iterations);
        if (fabs(before - lambda) <= 1e-6 * fabs(lambda) + 1e-15) {
            break;
        }
        before = lambda;
    }
    app_progress_end();
    conformal_free(&c);
}

static void descend(scp_command *cmd, double *X) {
    double *work = app_alloc(8 * (size_t)cmd->layout.d.p.m.n_vertices, sizeof *work),
           began = app_now();
    for (sl_int k = 0; k < cmd->descend; k++) {
        app_must(conformal_descent_step(&cmd->layout.s, &cmd->layout.d, X, work), "local solve",
                 NULL);
    }
    printf("descent    %d local solves with the factor of the mesh: %.3f ms\n", (int)cmd->descend,
           1e3 * (app_now() - began));
    free(work);
}

int command_scp(int argc, char **argv) {
    scp_command cmd;
    const char *operand = NULL;
    memset(&cmd, 0, sizeof cmd);
    cmd.iterations = 5;
    layout_command_defaults(&cmd.layout);
    const option options[] = {
        LAYOUT_OPTIONS(&cmd.layout),
        {OPTION_COUNT, "iterations", &cmd.iterations, "N",
         "maximum number of inverse iterations (5)"},
        {OPTION_COUNT, "descend", &cmd.descend, "N",
         "take N descent steps with the factor of the mesh in place of inverse iteration"},
        {OPTION_END, NULL, NULL, NULL, NULL}};
    options_read(&usage, &manual, options, argc, argv, &operand);
    layout_command_open(&cmd.layout, operand);
    double *X = layout_command_harmonic(&cmd.layout);
    layout_command_report_head();
    (void)layout_command_report(&cmd.layout, "harmonic", X);
    if (cmd.descend > 0) {
        descend(&cmd, X);
    } else {
        spectral(&cmd, X);
    }
    layout_command_report_head();
    (void)layout_command_report(
        &cmd.layout, cmd.descend > 0 ? "conformal, by descent" : "spectral conformal", X);
    layout_command_write(&cmd.layout, X);
    free(X);
    layout_command_close(&cmd.layout);
    return 0;
}

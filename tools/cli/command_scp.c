/* command_scp.c: spectral conformal layout of a patch */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "command.h"
#include "tools/geometry/conformal.h"
#include "layout_command.h"
#include "layout_solve.h"

static const options_usage usage = {
    "scp", "MESH", 1, 1,
    "Computes a planar layout of a patch that preserves angles as well as possible."};

static const options_manual manual = {
    "The boundary is free. The layout is the eigenvector of the conformal energy with the smallest "
    "eigenvalue above those of the constants (Mullen et al. 2008), by inverse iteration from the "
    "harmonic layout; it ends when an iteration turns the layout by at most 1e-7. The harmonic "
    "layout uses the factor of the whole "
    "mesh. Inverse iteration needs a factor of the patch: the conformal energy is the Dirichlet "
    "energy minus the area. The area terms couple the two coordinates along the boundary of the "
    "patch and cancel the Laplacian on all conformal maps, so that a few solves with the Laplacian "
    "of the mesh cannot replace it. --descend N decreases the same energy in N steps with the "
    "factor of the mesh, one local solve each. The result is a conformal layout near the harmonic "
    "one, not the eigenvector.",
    LAYOUT_OUTPUT
    "\nlambda: conformal energy divided by the sum of squares at the boundary, after each "
    "iteration; residual: that of the eigenvector. Exit status 1: not converged within "
    "--iterations, or "
    "a residual above 1e-4 lambda.",
    "torus:120x40 --center 100 --patch 800 --png mesh.png --layout layout.png\n"
    "bunny.obj --patch 2000 --descend 4 --csv layout.csv"};

typedef struct scp_command {
    layout_command layout;
    sl_int iterations, descend;
} scp_command;

/* The eigenvector is accepted if its residual is at most this times lambda, or at most ZERO: the
 * energy of patches that can be flattened is 0 up to rounding. */
#define ACCEPTED 1e-4
#define ZERO 1e-11

static bool spectral(scp_command *cmd, double *X) {
    conformal c;
    double began = app_now(), lambda = 0;
    double *work = app_alloc(2 * (size_t)cmd->layout.d.p.m.n_vertices, sizeof *work);
    bool done = false;
    sl_int k = 0;
    app_must(conformal_create(&c, &cmd->layout.d, cmd->layout.s.N),
             "factor of the patch's conformal energy", NULL);
    printf("factor     of the conformal energy of the patch: %.2f ms\n", 1e3 * (app_now() - began));
    while (!done && k < cmd->iterations) {
        k++;
        began = app_now();
        app_must(conformal_iterate(&c, X, &lambda), "inverse iteration", NULL);
        done = c.change <= 1e-7;
        if (k <= 5 || k % 10 == 0 || done || k == cmd->iterations) {
            printf("lambda     %.9g after %d, changed by %.1e (%.3f ms)\n", lambda, (int)k,
                   c.change, 1e3 * (app_now() - began));
        }
        app_progress("iterations", (double)k / (double)cmd->iterations);
    }
    app_progress_end();
    double residual = conformal_residual(&cmd->layout.s, &cmd->layout.d, X, lambda, work);
    bool solved = residual <= fmax(ZERO, ACCEPTED * lambda) && c.negative == 0;
    printf("residual   ||C x - lambda B x|| / ||B x|| = %.1e\n", residual);
    if (!done) {
        app_warn("inverse iteration has not converged after %d iterations: the last one turned the "
                 "layout by %.1e; raise --iterations",
                 (int)k, c.change);
    } else if (!solved) {
        app_warn("the eigenvector is inaccurate: residual %.1e, eigenvalue %.1e, %d negative "
                 "pivots; the angles of the patch are too small for its conformal energy",
                 residual, lambda, (int)c.negative);
    }
    conformal_free(&c);
    free(work);
    return done && solved;
}

static void descend(scp_command *cmd, double *X) {
    size_t n = (size_t)cmd->layout.d.p.m.n_vertices;
    double *work = app_alloc(8 * n, sizeof *work), began = app_now();
    double before = conformal_residual(&cmd->layout.s, &cmd->layout.d, X, 0, work);
    for (sl_int k = 0; k < cmd->descend; k++) {
        app_must(conformal_descent_step(&cmd->layout.s, &cmd->layout.d, X, work), "local solve",
                 NULL);
        app_progress("steps", (double)(k + 1) / (double)cmd->descend);
    }
    app_progress_end();
    printf("descent    %d local solves with the factor of the mesh: %.3f ms\n", (int)cmd->descend,
           1e3 * (app_now() - began));
    printf("residual   gradient of the energy ||C x|| / ||B x|| = %.1e, before %.1e\n",
           conformal_residual(&cmd->layout.s, &cmd->layout.d, X, 0, work), before);
    free(work);
}

int command_scp(int argc, char **argv) {
    scp_command cmd;
    const char *operand = NULL;
    memset(&cmd, 0, sizeof cmd);
    cmd.iterations = 200;
    layout_command_defaults(&cmd.layout);
    const option options[] = {
        LAYOUT_OPTIONS(&cmd.layout),
        {OPTION_COUNT, "iterations", &cmd.iterations, "N",
         "maximum number of inverse iterations (200)"},
        {OPTION_COUNT, "descend", &cmd.descend, "N",
         "take N descent steps with the factor of the mesh in place of inverse iteration"},
        APP_WELD_OPTION,
        {OPTION_END, NULL, NULL, NULL, NULL}};
    options_read(&usage, &manual, options, argc, argv, &operand);
    layout_command_open(&cmd.layout, operand);
    double *X = layout_start(&cmd.layout);
    layout_command_report_head();
    (void)layout_command_report(&cmd.layout, "harmonic", X);
    bool solved = true;
    if (cmd.descend > 0) {
        descend(&cmd, X);
    } else {
        solved = spectral(&cmd, X);
    }
    layout_command_report_head();
    distortion q = layout_command_report(
        &cmd.layout, cmd.descend > 0 ? "conformal, by descent" : "spectral conformal", X);
    layout_warn(&cmd.layout, X, &q);
    layout_command_write(&cmd.layout, X);
    free(X);
    layout_command_close(&cmd.layout);
    return solved ? 0 : 1;
}

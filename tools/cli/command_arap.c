/* command_arap.c: sparse-local arap: as-rigid-as-possible layouts of a patch, on the whole mesh's factor */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "arap.h"
#include "command.h"
#include "layout_job.h"

static const char text[] = "Lays a patch out in the plane with its lengths kept as well as can be: "
                           "from the harmonic layout, turns of the "
                           "faces and a Poisson problem for the vertices, in turn (Liu et al. "
                           "2008), the same matrix each time. That matrix "
                           "is the Laplacian N of the patch by itself, its boundary free. The "
                           "whole mesh's L is another: solved with L the "
                           "energy would also ask the mesh beyond the patch not to stretch at all, "
                           "and hold the patch back. So the factor of "
                           "L serves for corrections: --solves local solves of it in each "
                           "iteration, after which the rows of N hold but for "
                           "a rest on the boundary; with 1 the energy never rises, with 2 an "
                           "iteration is worth nearly as much as an exact "
                           "one, and it comes to rest at the same layouts. --own-factor factors "
                           "the patch itself and makes exact steps.\n"
                           "The energy printed is the mean over the patch of (a - 1)^2 + (b - "
                           "1)^2, a and b the stretches of a face.";

typedef struct job {
    layout_job j;
    sl_int iterations, solves;
    bool own_factor;
    sl_symbolic *S; /* of the patch, with --own-factor */
    sl_factor *F;
} job;

static void factor_patch(job *q) {
    const sl_csc N = sl_matrix_view(q->j.s.N);
    sl_options opt;
    memset(&opt, 0, sizeof opt);
    opt.definiteness = SL_SEMIDEFINITE;
    double began = app_now();
    app_must(sl_symbolic_create(&q->S, &N, NULL, NULL), "analysis of the patch", NULL);
    app_must(sl_factor_create(&q->F, q->S, &N, &opt, NULL), "factor of the patch", NULL);
    printf("own factor of the patch: %.2f ms\n", 1e3 * (app_now() - began));
}

/* Up to so many iterations, or until the energy stands still. */
static void iterate(job *q, double *X) {
    arap a;
    sl_work *work = NULL;
    if (!arap_create(&a, &q->j.d.p)) {
        app_die("out of memory");
    }
    app_must(sl_work_create(&work, NULL), "workspace", NULL);
    double energy = arap_turn(&a, X), seconds = 0;
    printf("energy     %.6g at the start\n", energy);
    for (sl_int k = 1; k <= q->iterations; k++) {
        double began = app_now();
        app_must(q->own_factor ? arap_move_own(&a, X, q->F, work)
                               : arap_move(&a, X, &q->j.s, (int)q->solves),
                 "global step", NULL);
        double next = arap_turn(&a, X);
        seconds += app_now() - began;
        printf("           %.6g after %d\n", next, (int)k);
        app_progress("iterations", (double)k / (double)q->iterations);
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
    job q;
    const char *operand = NULL;
    memset(&q, 0, sizeof q);
    q.iterations = 10;
    q.solves = 2;
    layout_job_defaults(&q.j);
    const option options[] = {
        LAYOUT_JOB_OPTIONS(&q.j),
        {OPTION_COUNT, "iterations", &q.iterations, "N", "at most so many (10)"},
        {OPTION_COUNT, "solves", &q.solves, "N",
         "local solves on the mesh's factor in each iteration (2)"},
        {OPTION_FLAG, "own-factor", &q.own_factor, NULL, "factor the patch itself; exact steps"},
        {OPTION_END, NULL, NULL, NULL, NULL}};
    const options_usage usage = {"arap", "MESH", 1, 1, text};
    options_read(&usage, options, argc, argv, &operand);
    if (q.solves < 1 || q.solves > 1000) {
        app_die_usage("--solves: 1 to 1000 are possible");
    }
    layout_job_open(&q.j, operand);
    double *X = layout_job_harmonic(&q.j);
    if (q.own_factor) {
        factor_patch(&q);
    }
    layout_job_report_head();
    (void)layout_job_report(&q.j, "harmonic", X);
    iterate(&q, X);
    layout_job_report_head();
    (void)layout_job_report(&q.j, "as rigid as possible", X);
    layout_job_write(&q.j, X);
    free(X);
    sl_factor_free(q.F);
    sl_symbolic_free(q.S);
    layout_job_close(&q.j);
    return 0;
}

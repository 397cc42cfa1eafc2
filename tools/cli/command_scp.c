/* command_scp.c: sparse-local scp: spectral-conformal layouts of a patch, and a descent on the whole mesh's factor */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "command.h"
#include "conformal.h"
#include "layout_job.h"

static const char text[] = "Lays a patch out in the plane with its angles kept as well as can be, "
                           "without a boundary laid first: the "
                           "eigenvector of the conformal energy behind the constants (Mullen et "
                           "al. 2008), by inverse iteration from the "
                           "harmonic layout; 2 to 5 iterations are enough. The harmonic layout "
                           "comes from the whole mesh's factor. The inverse "
                           "iteration needs the patch's own: the conformal energy is the Dirichlet "
                           "energy less the area, whose terms at the "
                           "patch's boundary tie the two coordinates together and cancel the "
                           "Laplacian on everything that keeps angles; no "
                           "few solves with L make up for that. --descend N makes N steps down the "
                           "same energy on the whole mesh's factor "
                           "instead, one local solve each: a conformal layout near the harmonic "
                           "one, not the eigenvector.\n"
                           "lambda is the energy against the sum of squares at the boundary.";

typedef struct job {
    layout_job j;
    sl_int iterations, descend;
} job;

static void spectral(job *q, double *X) {
    conformal c;
    double began = app_now(), lambda = 0, before = INFINITY;
    app_must(conformal_create(&c, &q->j.d, q->j.s.N), "factor of the patch's conformal energy",
             NULL);
    printf("own factor of the patch's conformal energy: %.2f ms\n", 1e3 * (app_now() - began));
    for (sl_int k = 1; k <= q->iterations; k++) {
        began = app_now();
        app_must(conformal_iterate(&c, X, &lambda), "inverse iteration", NULL);
        printf("lambda     %.9g after %d (%.3f ms)\n", lambda, (int)k, 1e3 * (app_now() - began));
        app_progress("iterations", (double)k / (double)q->iterations);
        if (fabs(before - lambda) <= 1e-6 * fabs(lambda) + 1e-15) {
            break;
        }
        before = lambda;
    }
    app_progress_end();
    conformal_free(&c);
}

static void descend(job *q, double *X) {
    double *work = app_alloc(8 * (size_t)q->j.d.p.m.n_vertices, sizeof *work), began = app_now();
    for (sl_int k = 0; k < q->descend; k++) {
        app_must(conformal_descend(&q->j.s, &q->j.d, X, work), "local solve", NULL);
    }
    printf("descent    %d local solves on the mesh's factor: %.3f ms\n", (int)q->descend,
           1e3 * (app_now() - began));
    free(work);
}

int command_scp(int argc, char **argv) {
    job q;
    const char *operand = NULL;
    memset(&q, 0, sizeof q);
    q.iterations = 5;
    layout_job_defaults(&q.j);
    const option options[] = {
        LAYOUT_JOB_OPTIONS(&q.j),
        {OPTION_COUNT, "iterations", &q.iterations, "N", "inverse iterations, at most so many (5)"},
        {OPTION_COUNT, "descend", &q.descend, "N",
         "instead: so many steps on the whole mesh's factor"},
        {OPTION_END, NULL, NULL, NULL, NULL}};
    const options_usage usage = {"scp", "MESH", 1, 1, text};
    options_read(&usage, options, argc, argv, &operand);
    layout_job_open(&q.j, operand);
    double *X = layout_job_harmonic(&q.j);
    layout_job_report_head();
    (void)layout_job_report(&q.j, "harmonic", X);
    if (q.descend > 0) {
        descend(&q, X);
    } else {
        spectral(&q, X);
    }
    layout_job_report_head();
    (void)layout_job_report(&q.j, q.descend > 0 ? "conformal, by descent" : "spectral conformal",
                            X);
    layout_job_write(&q.j, X);
    free(X);
    layout_job_close(&q.j);
    return 0;
}

/* arpack_pairs.c: eigenpairs of a Laplacian by ARPACK, with our factor as its solver */
#include "arpack_pairs.h"

#include <arpack/arpack.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "bench/lib/bench.h"

static void must(int info, const char *call) {
    if (info != 0) {
        fflush(stdout);
        fprintf(stderr, "bench: ARPACK's %s returned %d\n", call, info);
        exit(2);
    }
}

/* y = M x */
static void weigh(double *y, const double *mass, const double *x, sl_int n) {
    for (sl_int i = 0; i < n; i++) {
        y[i] = mass[i] * x[i];
    }
}

/* x = (L + M / shift)^-1 b = shift (M + shift L)^-1 b */
static void solve(double *x, const eigen_problem *p, const double *b, sl_int n, sl_work *W) {
    bench_must(sl_factor_solve(p->F, x, (size_t)n, b, (size_t)n, 1, W), "solve");
    for (sl_int i = 0; i < n; i++) {
        x[i] *= p->shift;
    }
}

/* The memory of ARPACK's reverse communication. */
typedef struct workspace {
    int basis, length;
    double *residual, *vectors, *work, *small, *weighed;
    int parameters[11], pointers[14];
} workspace;

static workspace workspace_create(sl_int n, sl_int count) {
    workspace w;
    memset(&w, 0, sizeof w);
    w.basis = 2 * count < n ? 2 * count : n;
    w.basis = w.basis > 20 || w.basis == n ? w.basis : n < 20 ? n : 20;
    w.length = w.basis * (w.basis + 8);
    w.residual = bench_alloc((size_t)n, sizeof *w.residual);
    w.vectors = bench_alloc((size_t)n * (size_t)w.basis, sizeof *w.vectors);
    w.work = bench_alloc(3 * (size_t)n, sizeof *w.work);
    w.small = bench_alloc((size_t)w.length, sizeof *w.small);
    w.weighed = bench_alloc((size_t)n, sizeof *w.weighed);
    memset(w.work, 0, 3 * (size_t)n * sizeof *w.work);
    w.parameters[0] = 1;   /* shifts are chosen by ARPACK */
    w.parameters[2] = 300; /* most restarts */
    w.parameters[6] = 3;   /* shift and invert */
    return w;
}

/* Leaves w->vectors to the caller. */
static void workspace_free(workspace *w) {
    free(w->weighed);
    free(w->small);
    free(w->work);
    free(w->residual);
}

/* Runs the iterations: ARPACK asks for products and solves until its basis has converged. */
static void iterate(workspace *w, const eigen_problem *p, eigen_pairs *pairs) {
    const sl_int n = pairs->n;
    int action = 0, info = 1; /* 1: w->residual is the first vector */
    uint64_t random = 1;
    sl_work *W;
    bench_must(sl_work_create(&W, NULL), "workspace");
    bench_random_fill(&random, w->residual, (size_t)n);
    for (;;) {
        dsaupd_c(&action, "G", n, "LM", pairs->count, p->tolerance, w->residual, w->basis,
                 w->vectors, n, w->parameters, w->pointers, w->work, w->small, w->length, &info);
        double *x = w->work + w->pointers[0] - 1, *y = w->work + w->pointers[1] - 1;
        if (action == -1) {
            weigh(w->weighed, p->mass, x, n);
            solve(y, p, w->weighed, n, W);
        } else if (action == 1) {
            solve(y, p, w->work + w->pointers[2] - 1, n, W); /* M x, which ARPACK has kept */
        } else if (action == 2) {
            weigh(y, p->mass, x, n);
        } else {
            break;
        }
        pairs->solves += action != 2;
    }
    must(info, "dsaupd");
    pairs->restarts = w->parameters[2];
    sl_work_free(W);
}

eigen_pairs eigen_pairs_create(const eigen_problem *problem, sl_int count) {
    eigen_pairs pairs;
    memset(&pairs, 0, sizeof pairs);
    pairs.n = problem->L.n_rows;
    pairs.count = count;
    pairs.values = bench_alloc((size_t)count, sizeof *pairs.values);
    workspace w = workspace_create(pairs.n, count);
    int *select = bench_alloc((size_t)w.basis, sizeof *select), info = 0;
    iterate(&w, problem, &pairs);
    memset(select, 0, (size_t)w.basis * sizeof *select);
    dseupd_c(1, "A", select, pairs.values, w.vectors, pairs.n, /* eigenvectors replace the basis */
             -1 / problem->shift, "G", pairs.n, "LM", count, problem->tolerance, w.residual,
             w.basis, w.vectors, pairs.n, w.parameters, w.pointers, w.work, w.small, w.length,
             &info);
    must(info, "dseupd");
    if (w.parameters[4] < count) {
        fprintf(stderr, "bench: ARPACK found %d of %d eigenpairs\n", w.parameters[4], (int)count);
        exit(2);
    }
    free(select);
    pairs.vectors = w.vectors;
    workspace_free(&w);
    return pairs;
}

void eigen_pairs_free(eigen_pairs *pairs) {
    free(pairs->values);
    free(pairs->vectors);
    memset(pairs, 0, sizeof *pairs);
}

void eigen_pairs_errors(double *residual, double *orthogonality, const eigen_problem *problem,
                        const eigen_pairs *pairs) {
    const size_t n = (size_t)pairs->n;
    double *y = bench_alloc(n, sizeof *y);
    *residual = *orthogonality = 0;
    for (sl_int k = 0; k < pairs->count; k++) {
        const double *x = pairs->vectors + n * (size_t)k, lambda = pairs->values[k];
        double square = 0;
        bench_must(sl_csc_multiply(&problem->L, SL_AS_SYMMETRIC, y, n, x, n, 1), "product");
        for (size_t i = 0; i < n; i++) {
            const double r = y[i] - lambda * problem->mass[i] * x[i];
            square += r * r / problem->mass[i];
        }
        *residual = fmax(*residual, sqrt(square) / (fabs(lambda) + 1 / problem->shift));
        weigh(y, problem->mass, x, pairs->n);
        for (sl_int j = 0; j <= k; j++) {
            const double *other = pairs->vectors + n * (size_t)j;
            double product = j == k ? -1 : 0;
            for (size_t i = 0; i < n; i++) {
                product += y[i] * other[i];
            }
            *orthogonality = fmax(*orthogonality, fabs(product));
        }
    }
    free(y);
}

void eigen_pairs_diagonal(double *out, const eigen_pairs *pairs, sl_int count, double t) {
    const size_t n = (size_t)pairs->n;
    memset(out, 0, n * sizeof *out);
    for (sl_int k = 0; k < count; k++) {
        const double *x = pairs->vectors + n * (size_t)k;
        const double weight = 1 / (1 + t * pairs->values[k]);
        for (size_t i = 0; i < n; i++) {
            out[i] += weight * x[i] * x[i];
        }
    }
}

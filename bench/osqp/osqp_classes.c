/* osqp_classes.c: whole runs of OSQP 1.0 on its seven classes of programs (make bench-osqp) */
#define _POSIX_C_SOURCE 200112L
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "osqp.h"
#include "osqp_triplets.h"

/* ---- the classes ---- */

static uint64_t rng;

static double uniform(double a, double b) {
    rng = rng * 6364136223846793005u + 1442695040888963407u;
    return a + (b - a) * (double)(rng >> 11) / 9007199254740992.0;
}

static double normal(void) {
    return sqrt(-2.0 * log(1.0 - uniform(0, 1))) * cos(6.283185307179586 * uniform(0, 1));
}

static int happens(double probability) {
    return uniform(0, 1) < probability;
}

/* min x'P x / 2 + q'x with l <= A x <= u */
typedef struct program {
    OSQPInt n, m;
    triplets P, A;
    OSQPFloat *q, *l, *u;
} program;

static void room(program *w, OSQPInt n, OSQPInt m) {
    memset(w, 0, sizeof *w);
    w->n = n;
    w->m = m;
    w->q = calloc((size_t)n + 1, sizeof *w->q);
    w->l = calloc((size_t)m + 1, sizeof *w->l);
    w->u = calloc((size_t)m + 1, sizeof *w->u);
}

static void bounds(program *w, OSQPInt row, double l, double u) {
    w->l[row] = (OSQPFloat)l;
    w->u[row] = (OSQPFloat)u;
}

static const double none = OSQP_INFTY;

/* P = M M' + 0.01 I, M and A with 15 % of entries. */
static void dense(program *w, OSQPInt n, OSQPInt m, int are_equal) {
    double *M = grown(NULL, (size_t)(n * n) * sizeof *M);
    room(w, n, m);
    for (OSQPInt k = 0; k < n * n; k++) {
        M[k] = happens(0.15) ? normal() : 0.0;
    }
    for (OSQPInt j = 0; j < n; j++) {
        w->q[j] = (OSQPFloat)normal();
        for (OSQPInt i = 0; i <= j; i++) {
            double sum = i == j ? 0.01 : 0.0;
            for (OSQPInt k = 0; k < n; k++) {
                sum += M[i * n + k] * M[j * n + k];
            }
            if (sum != 0.0) {
                add(&w->P, i, j, sum);
            }
        }
    }
    for (OSQPInt i = 0; i < m; i++) {
        const double b = normal();
        bounds(w, i, are_equal ? b : -uniform(0, 1), are_equal ? b : uniform(0, 1));
        for (OSQPInt j = 0; j < n; j++) {
            if (happens(0.15)) {
                add(&w->A, i, j, normal());
            }
        }
    }
    free(M);
}

static void random_program(program *w, OSQPInt n) {
    dense(w, n, 10 * n, 0);
}

static void equality(program *w, OSQPInt n) {
    dense(w, n, n / 2, 1);
}

/* min x'D x + y'y - mu'x: y = F'x, sum x = 1, x >= 0. */
static void portfolio(program *w, OSQPInt k) {
    const OSQPInt n = 100 * k;
    room(w, n + k, k + 1 + n);
    for (OSQPInt i = 0; i < n; i++) {
        add(&w->P, i, i, 2.0 * uniform(0, sqrt((double)k)));
        w->q[i] = (OSQPFloat)-normal();
        add(&w->A, k, i, 1.0);
        add(&w->A, k + 1 + i, i, 1.0);
        bounds(w, k + 1 + i, 0, none);
        for (OSQPInt f = 0; f < k; f++) {
            if (happens(0.5)) {
                add(&w->A, f, i, normal());
            }
        }
    }
    for (OSQPInt f = 0; f < k; f++) {
        add(&w->P, n + f, n + f, 2.0);
        add(&w->A, f, n + f, -1.0);
    }
    bounds(w, k, 1, 1);
}

/* Data D of 100 points for each feature, 15 % of it, as rows `first` .. of A; b = D v + noise. */
static double *data(program *w, OSQPInt first, OSQPInt features, int is_huber) {
    const OSQPInt points = 100 * features;
    double *b = grown(NULL, (size_t)points * sizeof *b),
           *v = grown(NULL, (size_t)features * sizeof *v);
    for (OSQPInt j = 0; j < features; j++) {
        v[j] = is_huber || happens(0.5) ? normal() / sqrt((double)features) : 0.0;
    }
    for (OSQPInt i = 0; i < points; i++) {
        b[i] = !is_huber ? normal() : happens(0.95) ? normal() / 4 : uniform(0, 10);
        for (OSQPInt j = 0; j < features; j++) {
            if (happens(0.15)) {
                const double x = normal();
                add(&w->A, first + i, j, x);
                b[i] += x * v[j];
            }
        }
        bounds(w, first + i, b[i], b[i]);
    }
    free(v);
    return b;
}

/* min y'y + lambda sum t: y = D x - b, -t <= x <= t. */
static void lasso(program *w, OSQPInt n) {
    const OSQPInt m = 100 * n, t = n + m;
    double *b, largest = 0, *Db = calloc((size_t)n, sizeof *Db);
    room(w, 2 * n + m, m + 2 * n);
    b = data(w, 0, n, 0);
    for (OSQPInt k = 0; k < w->A.count; k++) {
        Db[w->A.column[k]] += (double)w->A.x[k] * b[w->A.row[k]];
    }
    for (OSQPInt j = 0; j < n; j++) {
        largest = fmax(largest, fabs(Db[j]));
    }
    for (OSQPInt i = 0; i < m; i++) {
        add(&w->P, n + i, n + i, 2.0);
        add(&w->A, i, n + i, -1.0);
    }
    for (OSQPInt j = 0; j < n; j++) {
        w->q[t + j] = (OSQPFloat)(largest / 5);
        add(&w->A, m + j, j, 1.0);
        add(&w->A, m + j, t + j, -1.0);
        bounds(w, m + j, -none, 0);
        add(&w->A, m + n + j, j, 1.0);
        add(&w->A, m + n + j, t + j, 1.0);
        bounds(w, m + n + j, 0, none);
    }
    free(Db);
    free(b);
}

/* min x'x + sum t / 2: t >= diag(b) D x + 1, t >= 0. */
static void support_vectors(program *w, OSQPInt n) {
    const OSQPInt m = 100 * n;
    room(w, n + m, 2 * m);
    for (OSQPInt j = 0; j < n; j++) {
        add(&w->P, j, j, 2.0);
    }
    for (OSQPInt i = 0; i < m; i++) {
        const double sign = i < m / 2 ? 1.0 : -1.0;
        for (OSQPInt j = 0; j < n; j++) {
            if (happens(0.15)) {
                add(&w->A, i, j, sign * (normal() / sqrt((double)n) + sign / (double)n));
            }
        }
        w->q[n + i] = 0.5;
        add(&w->A, i, n + i, -1.0);
        bounds(w, i, -none, -1);
        add(&w->A, m + i, n + i, 1.0);
        bounds(w, m + i, 0, none);
    }
}

/* min u'u + 2 sum (r + s): D x - b - u = r - s, r >= 0, s >= 0. */
static void huber(program *w, OSQPInt n) {
    const OSQPInt m = 100 * n, u = n, r = u + m, s = r + m;
    room(w, s + m, 3 * m);
    free(data(w, 0, n, 1));
    for (OSQPInt i = 0; i < m; i++) {
        add(&w->P, u + i, u + i, 2.0);
        w->q[r + i] = w->q[s + i] = 2.0;
        add(&w->A, i, u + i, -1.0);
        add(&w->A, i, r + i, -1.0);
        add(&w->A, i, s + i, 1.0);
        add(&w->A, m + i, r + i, 1.0);
        add(&w->A, 2 * m + i, s + i, 1.0);
        bounds(w, m + i, 0, none);
        bounds(w, 2 * m + i, 0, none);
    }
}

/* 10 steps of x' = F x + G u with half as many inputs as states, bounds on all. */
static void control(program *w, OSQPInt states) {
    enum { STEPS = 10 };
    const OSQPInt inputs = states / 2, u = states * (STEPS + 1), n = u + inputs * STEPS;
    double *F = grown(NULL, (size_t)(states * states) * sizeof *F);
    double *G = grown(NULL, (size_t)(states * inputs) * sizeof *G);
    double *Q = grown(NULL, (size_t)states * sizeof *Q),
           *limit = grown(NULL, (size_t)n * sizeof *limit);
    room(w, n, u + n);
    for (OSQPInt k = 0; k < states * states; k++) {
        F[k] = 0.1 * normal() / sqrt((double)states) + (k % (states + 1) == 0 ? 0.95 : 0.0);
    }
    for (OSQPInt k = 0; k < states * inputs; k++) {
        G[k] = normal();
    }
    for (OSQPInt i = 0; i < states; i++) {
        Q[i] = happens(0.7) ? uniform(0, 10) : 0.0;
        limit[i] = uniform(1, 2);
    }
    for (OSQPInt i = 0; i < inputs; i++) {
        limit[u + i] = uniform(0, 0.1);
    }
    for (OSQPInt k = 0; k < n; k++) { /* the same in every step */
        const double of_k = k < u ? limit[k % states] : limit[u + (k - u) % inputs];
        const double cost = k < u ? Q[k % states] : 0.1;
        if (cost != 0) {
            add(&w->P, k, k, k >= u - states && k < u ? 3 * cost : cost);
        }
        add(&w->A, u + k, k, 1.0);
        bounds(w, u + k, -of_k, of_k);
    }
    for (OSQPInt k = 0; k < u; k++) {
        const OSQPInt step = k / states - 1, i = k % states;
        const double first = step < 0 ? -0.5 * limit[i] * uniform(-1, 1) : 0.0;
        add(&w->A, k, k, -1.0);
        bounds(w, k, first, first);
        for (OSQPInt j = 0; j < states && step >= 0; j++) {
            add(&w->A, k, step * states + j, F[i * states + j]);
        }
        for (OSQPInt j = 0; j < inputs && step >= 0; j++) {
            add(&w->A, k, u + step * inputs + j, G[i * inputs + j]);
        }
    }
    free(F);
    free(G);
    free(Q);
    free(limit);
}

static const struct {
    const char *name;
    void (*make)(program *, OSQPInt size);
    OSQPInt size[2];
} classes[] = {{"random QP", random_program, {30, 150}},
               {"equality QP", equality, {100, 500}},
               {"portfolio", portfolio, {10, 50}},
               {"lasso", lasso, {10, 60}},
               {"SVM", support_vectors, {10, 60}},
               {"Huber", huber, {10, 60}},
               {"control", control, {10, 40}}};

/* ---- timing ---- */

/* Other programs on the machine disturb processor seconds little. */
static double seconds(void) {
    struct timespec t;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

/* Prints class, size, rows of the KKT matrix, status, iterations, changes of rho, the least seconds
 * of setup and solve in several runs, and the objective. */
static void run(const char *name, OSQPInt size, program *w, const OSQPSettings *settings) {
    OSQPCscMatrix *P = compressed(&w->P, w->n, w->n), *A = compressed(&w->A, w->m, w->n);
    double setup = 1e30, solve = 1e30, spent = 0;
    OSQPInt iterations = 0, updates = 0, status = 0;
    double objective = 0;
    for (int k = 0; k < 100 && (k < 3 || spent < 1.0); k++) {
        OSQPSolver *solver = NULL;
        double before = seconds(), between, after;
        if (osqp_setup(&solver, P, w->q, A, w->l, w->u, w->m, w->n, settings) != 0) {
            printf("%s: setup failed\n", name);
            exit(1);
        }
        between = seconds();
        osqp_solve(solver);
        after = seconds();
        setup = fmin(setup, between - before);
        solve = fmin(solve, after - between);
        spent += after - before;
        iterations = solver->info->iter;
        updates = solver->info->rho_updates;
        status = solver->info->status_val;
        objective = (double)solver->info->obj_val;
        osqp_cleanup(solver);
    }
    printf("%s,%d,%d,%d,%d,%d,%.9g,%.9g,%.9g\n", name, (int)size, (int)(w->n + w->m), (int)status,
           (int)iterations, (int)updates, setup, solve, objective);
    fflush(stdout);
    OSQPCscMatrix *both[] = {P, A};
    for (int k = 0; k < 2; k++) {
        free(both[k]->x);
        free(both[k]->i);
        free(both[k]->p);
        free(both[k]);
    }
    free(w->q);
    free(w->l);
    free(w->u);
}

int main(int argc, char **argv) {
    OSQPSettings settings;
    osqp_set_default_settings(&settings);
    settings.verbose = 0;
    settings.max_iter = 20000;
    settings.eps_abs = settings.eps_rel = (OSQPFloat)(argc > 1 ? atof(argv[1]) : 1e-3);
    settings.polishing = argc > 2;
    for (size_t c = 0; c < sizeof classes / sizeof *classes; c++) {
        for (int size = 0; size < 2; size++) {
            program w;
            rng = 7 + c;
            classes[c].make(&w, classes[c].size[size]);
            run(classes[c].name, classes[c].size[size], &w, &settings);
        }
    }
    return 0;
}

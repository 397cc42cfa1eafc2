/* peers_small.c: from the matrix to a factor on systems of 1 to 10,000 rows, against the peers */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "bench/lib/bench.h"
#include "peers.h"

/* Patches of a triangulated plane in random order: ordering, analysis and factorization of a matrix
 * that is new to every library, as in peers_kinds. A call takes microseconds, so that many calls in
 * a row are timed. What they allocate is released within that time, as a program that solves many
 * such systems does. A local solve at a row shows what the shorter paths of the default save. */
enum { OURS, OURS_ONE, CHOLMOD, EIGEN, CONTENDERS, ROUNDS = 200 };

static const sl_int sizes[] = {1, 10, 30, 100, 300, 1000, 2500, 10000};
static const double batch_seconds = 5e-4;

typedef struct job {
    bench_system system; /* without a factor and a graph */
    sl_symbolic *S;      /* the last analysis and factor of ours */
    sl_factor *F;
    peer_eigen_amd *eigen;
    double least[CONTENDERS]; /* seconds */
} job;

/* The first n vertices of a square grid, each with a neighbor to the right, below and diagonally
 * below. */
static sl_matrix *patch(sl_int n) {
    const sl_int side = (sl_int)ceil(sqrt((double)n)), step[3] = {1, side, side + 1};
    sl_int *name = bench_alloc((size_t)n, sizeof *name), count = 0;
    sl_int *row = bench_alloc(4 * (size_t)n, sizeof *row);
    sl_int *column = bench_alloc(4 * (size_t)n, sizeof *column);
    double *x = bench_alloc(4 * (size_t)n, sizeof *x);
    uint64_t rng = 9;
    sl_matrix *M;
    for (sl_int v = 0; v < n; v++) {
        const sl_int other = bench_random_below(&rng, v + 1);
        name[v] = name[other];
        name[other] = v;
    }
    for (sl_int v = 0; v < n; v++) {
        row[count] = column[count] = name[v];
        x[count++] = 6.1;
        for (int k = 0; k < 3; k++) {
            const sl_int u = v + step[k];
            if (u < n && (k == 1 || v % side + 1 < side)) {
                row[count] = name[u] > name[v] ? name[u] : name[v];
                column[count] = name[u] > name[v] ? name[v] : name[u];
                x[count++] = -1.0;
            }
        }
    }
    bench_must(sl_matrix_from_triplets(&M, n, n, count, row, column, x, NULL, NULL), "matrix");
    free(name);
    free(row);
    free(column);
    free(x);
    return M;
}

static void release(job *j) {
    sl_factor_free(j->F);
    sl_symbolic_free(j->S);
    j->F = NULL;
    j->S = NULL;
}

static void call(job *j, int c) {
    sl_options opt;
    if (c == CHOLMOD) {
        peer_cholmod_own_free(peer_cholmod_own_create(&j->system.A, PEER_CHOLMOD_DEFAULTS));
    } else if (c == EIGEN) {
        peer_eigen_amd_compute(j->eigen);
    } else {
        memset(&opt, 0, sizeof opt);
        opt.purpose = c == OURS ? SL_PURPOSE_MANY_SOLVES : SL_PURPOSE_ONE_FACTOR;
        release(j);
        bench_must(sl_symbolic_create(&j->S, &j->system.A, &opt, NULL), "analysis");
        bench_must(sl_factor_create(&j->F, j->S, &j->system.A, NULL, NULL), "factor");
    }
}

/* The seconds of a call, of so many in a row. */
static double time_calls(job *j, int c, int calls) {
    const double start = bench_processor_seconds();
    for (int k = 0; k < calls; k++) {
        call(j, c);
    }
    return (bench_processor_seconds() - start) / calls;
}

/* The mean seconds of a local solve at a row, over 64 rows. */
static double time_vertex(job *j) {
    enum { ROWS = 64, SOLVES = 20 };
    double spent = 0, b = 1, x;
    sl_work *W;
    sl_plan *P;
    bench_must(sl_work_create(&W, NULL), "workspace");
    for (sl_int k = 0; k < ROWS; k++) {
        const sl_int v = (sl_int)((int64_t)k * j->system.n / ROWS);
        bench_must(sl_plan_create(&P, j->S, &v, 1, &v, 1, NULL, NULL), "plan");
        bench_must(sl_plan_solve(P, j->F, &x, 1, &b, 1, 1, W), "solve");
        const double start = bench_now();
        for (int s = 0; s < SOLVES; s++) {
            bench_must(sl_plan_solve(P, j->F, &x, 1, &b, 1, 1, W), "solve");
        }
        spent += bench_now() - start;
        sl_plan_free(P);
    }
    sl_work_free(W);
    return spent / (ROWS * SOLVES);
}

/* Checks the last factor of ours, and times local solves with it. */
static double check(bench_run *run, job *j, int c) {
    const size_t n = (size_t)j->system.n;
    double *b = bench_alloc(n, sizeof *b), *x = bench_alloc(n, sizeof *x), vertex = INFINITY;
    uint64_t rng = 21;
    bench_random_fill(&rng, b, n);
    call(j, c);
    bench_must(sl_factor_solve(j->F, x, n, b, n, 1, NULL), "solve");
    bench_check_residual(run, &j->system, x, b, 1, c == OURS ? "ours" : "ours, one factor");
    for (int k = 0; k < 5; k++) {
        vertex = fmin(vertex, time_vertex(j));
    }
    free(b);
    free(x);
    return vertex;
}

static void one_size(bench_run *run, FILE *csv, sl_int n) {
    int calls[CONTENDERS];
    double vertex[2];
    job j;
    memset(&j, 0, sizeof j);
    j.system.matrix = patch(n);
    j.system.A = sl_matrix_view(j.system.matrix);
    j.system.n = n;
    j.eigen = peer_eigen_amd_create(&j.system.A);
    for (int c = 0; c < CONTENDERS; c++) {
        j.least[c] = time_calls(&j, c, 3);
        calls[c] = (int)fmax(1.0, batch_seconds / fmax(j.least[c], 1e-7));
    }
    const double start = bench_now();
    for (int round = 0; round < ROUNDS && bench_now() - start < 6 * run->seconds; round++) {
        for (int c = 0; c < CONTENDERS; c++) {
            j.least[c] = fmin(j.least[c], time_calls(&j, c, calls[c]));
        }
    }
    for (int c = OURS; c <= OURS_ONE; c++) {
        vertex[c] = check(run, &j, c);
    }
    const double peer = fmin(j.least[CHOLMOD], j.least[EIGEN]);
    printf("  %7d | %9.2f %9.2f | %9.2f %9.2f | %6.2f %6.2f | %8.3f %8.3f\n", (int)n,
           1e6 * j.least[OURS], 1e6 * j.least[OURS_ONE], 1e6 * j.least[CHOLMOD],
           1e6 * j.least[EIGEN], peer / j.least[OURS], peer / j.least[OURS_ONE], 1e6 * vertex[OURS],
           1e6 * vertex[OURS_ONE]);
    fflush(stdout);
    fprintf(csv, "peers_small,%d,%.6g,%.6g,%.6g,%.6g,%.4g,%.4g,%.6g,%.6g\n", (int)n, j.least[OURS],
            j.least[OURS_ONE], j.least[CHOLMOD], j.least[EIGEN], peer / j.least[OURS],
            peer / j.least[OURS_ONE], vertex[OURS], vertex[OURS_ONE]);
    release(&j);
    peer_eigen_amd_free(j.eigen);
    sl_matrix_free(j.system.matrix);
}

void bench_peers_small(bench_run *run) {
    char path[512];
    snprintf(path, sizeof path, "%s/peers_small.csv", run->out_dir);
    FILE *csv = bench_create(path);
    fprintf(csv, "question,n,ours_s,one_s,cholmod_s,eigen_s,ratio,ratio_one,vertex_s,"
                 "vertex_one_s\n");
    printf("\n== peers_small: from the matrix to a factor on patches of a triangulated plane\n"
           "   least processor times in us; peer: time of the faster of CHOLMOD with nothing set "
           "and Eigen with AMD / ours\n"
           "   vertex: a local solve at a row, us\n\n"
           "  %7s | %9s %9s | %9s %9s | %6s %6s | %8s %8s\n",
           "n", "ours", "one", "CHOLMOD", "Eigen", "peer", "one", "vertex", "one");
    bench_machine_write(run, "peers_small");
    for (size_t k = 0; k < sizeof sizes / sizeof *sizes; k++) {
        one_size(run, csv, sizes[k]);
    }
    bench_close(csv);
}

/* peers_mumps.c: MUMPS, sequential, and Scotch, behind a few calls */
#include "peers_mumps.h"

#include <dmumps_c.h>
#include <scotch.h>
#include <stdlib.h>
#include <string.h>

#include "bench/lib/bench.h"

/* The parameters as MUMPS's manual numbers them. */
#define ICNTL(k) icntl[(k)-1]

struct peer_mumps {
    DMUMPS_STRUC_C id;
    sl_int n;
    MUMPS_INT *row, *column, *position;
    MUMPS_INT *begin, *wanted; /* of a sparse right-hand side, of entries of the inverse */
    double *values;
};

static void must(int held, const char *doing) {
    bench_must(held ? SL_OK : SL_ERR_PIVOT, doing);
}

static void run(peer_mumps *peer, MUMPS_INT job, const char *doing) {
    peer->id.job = job;
    dmumps_c(&peer->id);
    must(peer->id.infog[0] >= 0, doing);
}

peer_mumps *peer_mumps_create(const sl_csc *A, const sl_int *iperm) {
    const size_t n = (size_t)A->n_cols, nnz = (size_t)A->p[A->n_cols];
    peer_mumps *peer = bench_alloc(1, sizeof *peer);
    memset(peer, 0, sizeof *peer);
    peer->n = A->n_cols;
    peer->row = bench_alloc(nnz, sizeof *peer->row);
    peer->column = bench_alloc(nnz, sizeof *peer->column);
    peer->position = bench_alloc(n, sizeof *peer->position);
    peer->begin = bench_alloc(n + 1, sizeof *peer->begin);
    peer->wanted = bench_alloc(n, sizeof *peer->wanted);
    peer->values = bench_alloc(n, sizeof *peer->values);
    for (sl_int j = 0; j < A->n_cols; j++) {
        peer->position[j] = iperm[j] + 1;
        for (sl_int q = A->p[j]; q < A->p[j + 1]; q++) {
            peer->row[q] = A->i[q] + 1;
            peer->column[q] = j + 1;
        }
    }
    peer->id.sym = 1; /* positive definite */
    peer->id.par = 1;
    peer->id.comm_fortran = -987654; /* the communicator of all processes */
    run(peer, -1, "MUMPS: starting");
    memset(peer->id.icntl, 0, 4 * sizeof *peer->id.icntl); /* no messages */
    peer->id.ICNTL(7) = 1;                                 /* the order is given */
    peer->id.n = A->n_cols;
    peer->id.nnz = (MUMPS_INT8)nnz;
    peer->id.irn = peer->row;
    peer->id.jcn = peer->column;
    peer->id.a = (double *)(uintptr_t)A->x; /* is only read */
    peer->id.perm_in = peer->position;
    run(peer, 1, "MUMPS: analysis");
    return peer;
}

void peer_mumps_free(peer_mumps *peer) {
    if (peer) {
        run(peer, -2, "MUMPS: ending");
        free(peer->row);
        free(peer->column);
        free(peer->position);
        free(peer->begin);
        free(peer->wanted);
        free(peer->values);
        free(peer);
    }
}

void peer_mumps_factor(peer_mumps *peer) {
    run(peer, 2, "MUMPS: factorization");
}

void peer_mumps_solve(peer_mumps *peer, double *X, sl_int nrhs) {
    peer->id.ICNTL(20) = peer->id.ICNTL(30) = 0;
    peer->id.ICNTL(27) = nrhs;
    peer->id.rhs = X;
    peer->id.nrhs = nrhs;
    peer->id.lrhs = peer->n;
    run(peer, 3, "MUMPS: solve");
}

/* Sets right-hand sides with one entry each: a one in rows[k] of column k, or the k-th wanted
 * entry of the inverse. */
static void set_sparse(peer_mumps *peer, const sl_int *rows, sl_int count) {
    for (sl_int k = 0; k < count; k++) {
        peer->begin[k] = k + 1;
        peer->wanted[k] = rows[k] + 1;
        peer->values[k] = 1;
    }
    peer->begin[count] = count + 1;
    peer->id.irhs_ptr = peer->begin;
    peer->id.irhs_sparse = peer->wanted;
    peer->id.rhs_sparse = peer->values;
    peer->id.nz_rhs = count;
}

void peer_mumps_column(peer_mumps *peer, double *x, sl_int row) {
    set_sparse(peer, &row, 1);
    peer->id.ICNTL(20) = 1; /* sparse, and MUMPS decides whether to use that */
    peer->id.ICNTL(30) = 0;
    peer->id.ICNTL(27) = 1;
    peer->id.rhs = x;
    peer->id.nrhs = 1;
    peer->id.lrhs = peer->n;
    run(peer, 3, "MUMPS: solve with a sparse right-hand side");
}

void peer_mumps_diagonal(peer_mumps *peer, double *out, const sl_int *rows, sl_int count,
                         sl_int block) {
    /* column j of the inverse has the wanted entries irhs_ptr[j] .. irhs_ptr[j + 1] */
    set_sparse(peer, rows, count);
    for (sl_int j = 0, k = 0; j <= peer->n; j++) {
        while (k < count && rows[k] < j) {
            k++;
        }
        peer->begin[j] = k + 1;
    }
    peer->id.ICNTL(20) = 0;
    peer->id.ICNTL(30) = 1;
    peer->id.ICNTL(27) = block;
    peer->id.nrhs = peer->n;
    run(peer, 3, "MUMPS: entries of the inverse");
    memcpy(out, peer->values, (size_t)count * sizeof *out);
}

void peer_scotch_order(const sl_csc *A, sl_int *perm) {
    const sl_int n = A->n_cols;
    SCOTCH_Num *begin = bench_alloc((size_t)n + 1, sizeof *begin), *next, *edges, *order;
    SCOTCH_Graph graph;
    SCOTCH_Strat strategy;
    next = bench_alloc((size_t)n + 1, sizeof *next);
    memset(begin, 0, ((size_t)n + 1) * sizeof *begin);
    for (sl_int j = 0; j < n; j++) { /* both triangles, without the diagonal */
        for (sl_int q = A->p[j]; q < A->p[j + 1]; q++) {
            if (A->i[q] != j) {
                begin[j + 1]++;
                begin[A->i[q] + 1]++;
            }
        }
    }
    for (sl_int j = 0; j < n; j++) {
        begin[j + 1] += begin[j];
        next[j] = begin[j];
    }
    edges = bench_alloc((size_t)begin[n] + 1, sizeof *edges);
    order = bench_alloc((size_t)n + 1, sizeof *order);
    for (sl_int j = 0; j < n; j++) {
        for (sl_int q = A->p[j]; q < A->p[j + 1]; q++) {
            if (A->i[q] != j) {
                edges[next[j]++] = A->i[q];
                edges[next[A->i[q]]++] = j;
            }
        }
    }
    must(SCOTCH_graphInit(&graph) == 0 && SCOTCH_stratInit(&strategy) == 0 &&
             SCOTCH_graphBuild(&graph, 0, n, begin, NULL, NULL, NULL, begin[n], edges, NULL) == 0 &&
             SCOTCH_graphOrder(&graph, &strategy, NULL, order, NULL, NULL, NULL) == 0,
         "Scotch");
    for (sl_int k = 0; k < n; k++) {
        perm[k] = (sl_int)order[k];
    }
    SCOTCH_stratExit(&strategy);
    SCOTCH_graphExit(&graph);
    free(order);
    free(edges);
    free(next);
    free(begin);
}

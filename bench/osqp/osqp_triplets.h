/* osqp_triplets.h: matrices of OSQP, compressed by columns, from triplets */
#ifndef BENCH_OSQP_TRIPLETS_H
#define BENCH_OSQP_TRIPLETS_H

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "osqp.h"

typedef struct triplets {
    OSQPInt count, room, *row, *column;
    OSQPFloat *x;
} triplets;

static void *grown(void *block, size_t bytes) {
    void *larger = realloc(block, bytes);
    if (larger == NULL) {
        puts("out of memory");
        exit(1);
    }
    return larger;
}

static void add(triplets *t, OSQPInt i, OSQPInt j, double x) {
    if (t->count == t->room) {
        const size_t room = (size_t)(t->room = 2 * t->room + 1000);
        t->row = grown(t->row, room * sizeof *t->row);
        t->column = grown(t->column, room * sizeof *t->column);
        t->x = grown(t->x, room * sizeof *t->x);
    }
    t->row[t->count] = i;
    t->column[t->count] = j;
    t->x[t->count++] = (OSQPFloat)x;
}

/* Compressed columns of the transpose of t, rows of a column in the order of t. */
static triplets transposed(const triplets *t, OSQPInt rows, OSQPInt *p) {
    triplets u = {0, 0, NULL, NULL, NULL};
    OSQPInt *next = grown(NULL, ((size_t)rows + 1) * sizeof *next);
    memset(p, 0, ((size_t)rows + 1) * sizeof *p);
    for (OSQPInt k = 0; k < t->count; k++) {
        add(&u, 0, 0, 0);
        p[t->row[k] + 1]++;
    }
    for (OSQPInt k = 0; k < rows; k++) {
        p[k + 1] += p[k];
    }
    memcpy(next, p, ((size_t)rows + 1) * sizeof *p);
    for (OSQPInt k = 0; k < t->count; k++) {
        const OSQPInt at = next[t->row[k]]++;
        u.row[at] = t->column[k];
        u.column[at] = t->row[k];
        u.x[at] = t->x[k];
    }
    free(next);
    return u;
}

static void triplets_free(triplets *t) {
    free(t->row);
    free(t->column);
    free(t->x);
    memset(t, 0, sizeof *t);
}

/* Compressed columns with ascending rows: sorted by rows, then by columns. */
static OSQPCscMatrix *compressed(triplets *t, OSQPInt rows, OSQPInt columns) {
    OSQPCscMatrix *M = grown(NULL, sizeof *M);
    OSQPInt *by_row = grown(NULL, ((size_t)rows + 1) * sizeof *by_row);
    OSQPInt *p = grown(NULL, ((size_t)columns + 1) * sizeof *p);
    triplets u = transposed(t, rows, by_row), v = transposed(&u, columns, p);
    OSQPCscMatrix_set_data(M, rows, columns, v.count, v.x, v.row, p);
    free(v.column);
    free(by_row);
    triplets_free(&u);
    triplets_free(t);
    return M;
}

#endif

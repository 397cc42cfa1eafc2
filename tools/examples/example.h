/* example.h: what the examples share: the Laplacian of a grid, and an end at errors */
#ifndef SL_EXAMPLE_H
#define SL_EXAMPLE_H

#include "sparse_local.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

enum { SIDE = 40, N = SIDE * SIDE };

/* Ends the program with a message if a call fails. */
static inline void ok(sl_status status) {
    if (status != SL_OK) {
        char text[300];
        sl_error_text(text, sizeof text, status, NULL);
        fprintf(stderr, "%s\n", text);
        exit(1);
    }
}

/* The lower triangle of the Laplacian of a grid of SIDE x SIDE vertices, shift on the diagonal;
 * released by sl_matrix_free. */
static inline sl_matrix *grid_laplacian(double shift) {
    static sl_int i[3 * N], j[3 * N];
    static double x[3 * N];
    sl_matrix *M = NULL;
    sl_int v, count = 0;
    for (v = 0; v < N; v++) {
        const int right = (v + 1) % SIDE != 0, below = v + SIDE < N;
        i[count] = j[count] = v;
        x[count++] = right + below + (v % SIDE != 0) + (v >= SIDE) + shift;
        if (right) {
            i[count] = v + 1;
            j[count] = v;
            x[count++] = -1.0;
        }
        if (below) {
            i[count] = v + SIDE;
            j[count] = v;
            x[count++] = -1.0;
        }
    }
    ok(sl_matrix_from_triplets(&M, N, N, count, i, j, x, NULL, NULL));
    return M;
}

#endif

/* pinned_poisson.c: Poisson problems on a patch with the solution 0 at some vertices */
#include "pinned_poisson.h"

#include <math.h>
#include <stdlib.h>

#include "tools/matrix/triplets.h"
#include "tools/mesh/adjacency.h"

enum { PINNED = -1, NOT_REACHED = -2 };

/* Numbers the rows that N connects to a pin: number[v] is 0, 1, ..., PINNED or NOT_REACHED.
 * Returns how many there are; -1: out of memory. */
static sl_int number_rows(sl_int *number, const sl_csc *N, const sl_int *pins, sl_int count) {
    adjacency graph;
    sl_int n_rows = 0, waiting = 0;
    sl_int *stack = (sl_int *)malloc(((size_t)N->n_cols + 1) * sizeof *stack);
    if (stack == NULL || !adjacency_from_matrix(&graph, N)) {
        free(stack);
        return -1;
    }
    for (sl_int v = 0; v < N->n_cols; v++) {
        number[v] = NOT_REACHED;
    }
    for (sl_int k = 0; k < count; k++) {
        number[pins[k]] = PINNED;
        stack[waiting++] = pins[k];
    }
    while (waiting > 0) {
        const sl_int v = stack[--waiting];
        for (sl_off p = graph.begin[v]; p < graph.begin[v + 1]; p++) {
            const sl_int w = graph.neighbor[p];
            if (number[w] == NOT_REACHED) {
                number[w] = 0;
                stack[waiting++] = w;
            }
        }
    }
    for (sl_int v = 0; v < N->n_cols; v++) { /* in the order of N */
        number[v] = number[v] == 0 ? n_rows++ : number[v];
    }
    adjacency_free(&graph);
    free(stack);
    return n_rows;
}

/* The numbered rows and columns of N; NULL: out of memory. */
static sl_matrix *part_of(const sl_csc *N, const sl_int *number, sl_int n_rows) {
    triplets list = {0, 0, NULL, NULL, NULL};
    sl_matrix *out = NULL;
    bool ok = true;
    for (sl_int j = 0; j < N->n_cols && ok; j++) {
        for (sl_int p = N->p[j]; p < N->p[j + 1] && ok && number[j] >= 0; p++) {
            const sl_int i = number[N->i[p]];
            ok = i < 0 || triplets_add(&list, i, number[j], N->x[p]);
        }
    }
    if (!ok || triplets_finish(&out, n_rows, n_rows, &list, true) != SL_OK) {
        triplets_free(&list);
        return NULL;
    }
    return out;
}

/* Solves A y = y. */
static sl_status solve(const sl_matrix *A, double *y, size_t n) {
    sl_symbolic *S = NULL;
    sl_factor *F = NULL;
    sl_stats stats;
    const sl_csc view = sl_matrix_view(A);
    sl_status status = sl_symbolic_create(&S, &view, NULL, NULL);
    status = status == SL_OK ? sl_factor_create(&F, S, &view, NULL, &stats) : status;
    if (status == SL_OK && stats.factor.negative > 0) {
        status = SL_ERR_PIVOT;
    }
    status = status == SL_OK ? sl_factor_solve(F, y, n, y, n, 1, NULL) : status;
    sl_factor_free(F);
    sl_symbolic_free(S);
    return status;
}

sl_status pinned_poisson_solve(const sl_csc *N, double *x, const double *b, const sl_int *pins,
                               sl_int count) {
    const size_t n = (size_t)N->n_cols;
    sl_int *number = (sl_int *)malloc((n + 1) * sizeof *number);
    double *y = (double *)malloc((n + 1) * sizeof *y);
    const sl_int n_rows = number != NULL && y != NULL ? number_rows(number, N, pins, count) : -1;
    sl_matrix *A = n_rows >= 0 ? part_of(N, number, n_rows) : NULL;
    for (size_t v = 0; v < n && A != NULL; v++) {
        if (number[v] >= 0) {
            y[number[v]] = b[v];
        }
    }
    const sl_status status = A != NULL ? solve(A, y, (size_t)n_rows) : SL_ERR_MEMORY;
    for (size_t v = 0; v < n && status == SL_OK; v++) {
        x[v] = number[v] >= 0 ? y[number[v]] : number[v] == PINNED ? 0 : NAN;
    }
    sl_matrix_free(A);
    free(y);
    free(number);
    return status;
}

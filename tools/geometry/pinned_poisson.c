/* pinned_poisson.c: Poisson problems on a patch with the solution 0 at some vertices */
#include "pinned_poisson.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

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

static sl_status factor(pinned_poisson *p, const sl_matrix *A) {
    sl_stats stats;
    const sl_csc view = sl_matrix_view(A);
    sl_status status = sl_symbolic_create(&p->S, &view, NULL, NULL);
    status = status == SL_OK ? sl_factor_create(&p->F, p->S, &view, NULL, &stats) : status;
    return status == SL_OK && stats.factor.negative > 0 ? SL_ERR_PIVOT : status;
}

sl_status pinned_poisson_create(pinned_poisson *out, const sl_csc *N, const sl_int *pins,
                                sl_int count) {
    const size_t n = (size_t)N->n_cols;
    memset(out, 0, sizeof *out);
    out->n = N->n_cols;
    out->number = (sl_int *)malloc((n + 1) * sizeof *out->number);
    out->y = (double *)malloc((n + 1) * sizeof *out->y);
    out->n_rows =
        out->number != NULL && out->y != NULL ? number_rows(out->number, N, pins, count) : -1;
    sl_matrix *A = out->n_rows >= 0 ? part_of(N, out->number, out->n_rows) : NULL;
    const sl_status status = A != NULL ? factor(out, A) : SL_ERR_MEMORY;
    sl_matrix_free(A);
    if (status != SL_OK) {
        pinned_poisson_free(out);
    }
    return status;
}

sl_status pinned_poisson_solve(pinned_poisson *p, double *x, const double *b) {
    const size_t rows = (size_t)p->n_rows;
    for (sl_int v = 0; v < p->n; v++) {
        if (p->number[v] >= 0) {
            p->y[p->number[v]] = b[v];
        }
    }
    const sl_status status = sl_factor_solve(p->F, p->y, rows, p->y, rows, 1, NULL);
    for (sl_int v = 0; v < p->n && status == SL_OK; v++) {
        const sl_int row = p->number[v];
        x[v] = row >= 0 ? p->y[row] : row == PINNED ? 0 : NAN;
    }
    return status;
}

void pinned_poisson_free(pinned_poisson *p) {
    sl_factor_free(p->F);
    sl_symbolic_free(p->S);
    free(p->y);
    free(p->number);
    memset(p, 0, sizeof *p);
}

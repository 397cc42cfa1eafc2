/* deformer_anew.c: positions by a new factor without the rows that are held: a check of pins, and
 * what takes their place where they are refused */
#include "deformer_anew.h"

#include <math.h>
#include <stdlib.h>
#include <time.h>

#include "tools/matrix/triplets.h"

/* The part of K in the rows that are not held: row v has the number number[v], or -1. */
typedef struct free_system {
    sl_int n_free, *number;
    sl_symbolic *S;
    sl_factor *F;
    double *B; /* n_free x 3 */
} free_system;

static void release(free_system *f) {
    sl_factor_free(f->F);
    sl_symbolic_free(f->S);
    free(f->number);
    free(f->B);
}

/* Numbers the rows in components that handles hold somewhere. */
static bool number_rows(free_system *f, const deformer *d) {
    f->number = (sl_int *)malloc(((size_t)d->n + 1) * sizeof *f->number);
    for (sl_int v = 0; v < d->n && f->number != NULL; v++) {
        const bool is_free = !d->is_held[v] && d->n_held[d->component[v]] > 0;
        f->number[v] = is_free ? f->n_free++ : -1;
    }
    f->B = (double *)malloc((3 * (size_t)f->n_free + 1) * sizeof *f->B);
    return f->number != NULL && f->B != NULL;
}

/* The matrix; NULL: out of memory. f->B becomes the right-hand side. */
static sl_matrix *matrix_of(free_system *f, const deformer *d) {
    triplets list = {0, 0, NULL, NULL, NULL};
    sl_matrix *out = NULL;
    const sl_int *number = f->number;
    const size_t n = (size_t)d->n, nf = (size_t)f->n_free;
    const sl_csc K = sl_matrix_view(d->K);
    bool ok = true;
    for (size_t v = 0; v < n; v++) {
        for (size_t c = 0; c < 3 && number[v] >= 0; c++) {
            f->B[c * nf + (size_t)number[v]] = d->B[c * n + v];
        }
    }
    for (sl_int j = 0; j < d->n && ok; j++) {
        for (sl_int p = K.p[j]; p < K.p[j + 1] && ok; p++) {
            const sl_int i = K.i[p];
            if (number[i] >= 0 && number[j] >= 0) {
                const sl_int a = number[i], b = number[j];
                ok = triplets_add(&list, a > b ? a : b, a > b ? b : a, K.x[p]);
            } else if (number[i] >= 0 || number[j] >= 0) {
                const size_t to = (size_t)(number[i] >= 0 ? number[i] : number[j]);
                const size_t from = (size_t)(number[i] >= 0 ? j : i);
                for (size_t c = 0; c < 3 && d->is_held[from]; c++) {
                    const double g = d->target[3 * from + c] - d->rest[c * n + from];
                    f->B[c * nf + to] -= K.x[p] * g;
                }
            }
        }
    }
    if (!ok || triplets_finish(&out, f->n_free, f->n_free, &list, true) != SL_OK) {
        triplets_free(&list);
        return NULL;
    }
    return out;
}

/* Analyzes, factors and solves: f->B becomes the displacements. */
static sl_status solve(free_system *f, deformer *d, const sl_matrix *A) {
    const sl_csc view = sl_matrix_view(A);
    const size_t nf = (size_t)f->n_free;
    sl_options opt = {0};
    opt.null_pivots = SL_NULL_PIVOT_SKIP;
    opt.consistency_tolerance = -1;
    sl_status status = sl_symbolic_create(&f->S, &view, NULL, NULL);
    if (status == SL_OK) {
        status = sl_factor_create(&f->F, f->S, &view, &opt, &d->stats);
    }
    return status == SL_OK ? sl_factor_solve(f->F, f->B, nf, f->B, nf, 3, d->W) : status;
}

/* All of it; release f in any case. */
static sl_status compute(free_system *f, deformer *d, double *seconds) {
    sl_matrix *A = number_rows(f, d) ? matrix_of(f, d) : NULL;
    const clock_t began = clock();
    const sl_status status = A != NULL ? solve(f, d, A) : SL_ERR_MEMORY;
    *seconds = (double)(clock() - began) / CLOCKS_PER_SEC;
    sl_matrix_free(A);
    return status;
}

sl_status deformer_solve_anew(deformer *d) {
    const size_t n = (size_t)d->n;
    double seconds;
    free_system f = {0, NULL, NULL, NULL, NULL};
    const sl_status status = compute(&f, d, &seconds);
    for (size_t k = 0; k < 3 * n && status == SL_OK; k++) {
        const size_t v = k % n, c = k / n;
        if (d->is_held[v]) {
            d->U[k] = d->target[3 * v + c] - d->rest[k];
        } else if (d->n_held[d->component[v]] == 0) {
            d->U[k] = d->method == DEFORM_ARAP ? d->Y[k] - d->rest[k] : 0;
        } else {
            d->U[k] = f.B[c * (size_t)f.n_free + (size_t)f.number[v]];
        }
    }
    release(&f);
    return status;
}

sl_status deformer_compare(deformer *d, double *difference, double *seconds) {
    const size_t n = (size_t)d->n;
    free_system f = {0, NULL, NULL, NULL, NULL};
    *difference = *seconds = 0;
    const sl_status status = compute(&f, d, seconds);
    for (size_t v = 0; v < n && status == SL_OK; v++) {
        double distance = 0;
        for (size_t c = 0; c < 3 && f.number[v] >= 0; c++) {
            const size_t at = c * (size_t)f.n_free + (size_t)f.number[v];
            distance = hypot(distance, f.B[at] - d->U[c * n + v]);
        }
        /* written so that a NaN counts */
        *difference = distance / d->diameter <= *difference ? *difference : distance / d->diameter;
    }
    release(&f);
    return status;
}

/* deformer_anew.c: positions by a factor of K without the rows that are held: a check of pins, and
 * what takes their place where they are many or refused */
#include "deformer_anew.h"
#include "deformer_mixed.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

/* Lists the vertices that are held, and those of components without handles. */
static sl_int list_fixed(const deformer *d, sl_int *rows) {
    sl_int count = 0;
    for (sl_int v = 0; v < d->n; v++) {
        if (d->is_held[v] || d->n_held[d->component[v]] == 0) {
            rows[count++] = v;
        }
    }
    return count;
}

/* Rows that are close to null may be regular by rounding: they are skipped where that is needed. */
static sl_status create(sl_fixed **out, deformer *d, const sl_int *rows, sl_int count) {
    const sl_csc K = sl_matrix_view(d->K);
    sl_options opt;
    memset(&opt, 0, sizeof opt);
    opt.pivots = SL_PIVOTS_SKIP_NULL;
    opt.consistency_tolerance = -1;
    return sl_fixed_create(out, &K, rows, count, &opt, &d->stats);
}

/* U becomes the displacements. G: 3 n of 0, scratch; it stays 0 if at_rest. */
static sl_status solve(const deformer *d, const sl_fixed *D, const sl_int *rows, sl_int count,
                       double *G, double *U, bool at_rest) {
    const size_t n = (size_t)d->n, m = (size_t)count;
    for (size_t k = 0; k < 3 * m && !at_rest; k++) {
        const size_t v = (size_t)rows[k % m], at = k / m * n + v;
        G[k] = d->is_held[v]              ? d->target[3 * v + k / m] - d->rest[at]
               : d->method == DEFORM_ARAP ? d->Y[at] - d->rest[at]
                                          : 0;
    }
    return sl_fixed_solve(D, U, n, d->B, n, G, m, 3, d->W);
}

sl_status deformer_solve_anew(deformer *d, bool at_rest) {
    const size_t n = (size_t)d->n;
    double *G = (double *)calloc(3 * n + 1, sizeof *G);
    sl_int *rows = (sl_int *)malloc((n + 1) * sizeof *rows);
    sl_status status = G != NULL && rows != NULL ? SL_OK : SL_ERR_MEMORY;
    if (status == SL_OK) {
        const sl_int count = list_fixed(d, rows);
        if (d->fixed == NULL) {
            status = create(&d->fixed, d, rows, count);
        }
        status = status == SL_OK ? solve(d, d->fixed, rows, count, G, d->U, at_rest) : status;
    }
    free(G);
    free(rows);
    return status;
}

/* A new factor of K, for corrections of what it gives. */
typedef struct fresh {
    const sl_fixed *D;
    const sl_int *rows;
    sl_int count;
    double *G; /* 3 n of 0 */
} fresh;

static sl_status step_fresh(void *context, deformer *d, double *X) {
    const fresh *f = (const fresh *)context;
    return solve(d, f->D, f->rows, f->count, f->G, X, true);
}

/* Biharmonic displacements U without what the last solve has used. d->U is scratch. */
static sl_status solve_fresh(deformer *d, const fresh *f, double *U, sl_status status) {
    bool good = false;
    double first;
    memset(f->G, 0, 3 * (size_t)d->n * sizeof *f->G);
    memcpy(d->U, U, 3 * (size_t)d->n * sizeof *U);
    if (status == SL_OK && d->squared) {
        status = deformer_correct(d, step_fresh, (void *)f, &first, &good);
    }
    if (deformer_is_refusal(status) || (status == SL_OK && !good)) {
        status = deformer_solve_mixed(d, true);
    }
    memcpy(U, d->U, 3 * (size_t)d->n * sizeof *U);
    return status;
}

sl_status deformer_compare(deformer *d, double *difference, double *seconds) {
    const size_t n = (size_t)d->n;
    double *G = (double *)calloc(9 * n + 1, sizeof *G), *U = G + 3 * n, *kept = G + 6 * n;
    sl_int *rows = (sl_int *)malloc((n + 1) * sizeof *rows), count = 0;
    sl_fixed *D = NULL;
    sl_status status = G != NULL && rows != NULL ? SL_OK : SL_ERR_MEMORY;
    *difference = *seconds = 0;
    if (status == SL_OK) {
        count = list_fixed(d, rows);
        const clock_t began = clock();
        status = d->method == DEFORM_BIHARMONIC && !d->squared ? SL_ERR_PIVOT
                                                               : create(&D, d, rows, count);
        status = status == SL_OK ? solve(d, D, rows, count, G, U, false) : status;
        if (d->method == DEFORM_BIHARMONIC) {
            const fresh f = {D, rows, count, G};
            memcpy(kept, d->U, 3 * n * sizeof *kept);
            status = solve_fresh(d, &f, U, status);
            memcpy(d->U, kept, 3 * n * sizeof *kept);
        }
        *seconds = (double)(clock() - began) / CLOCKS_PER_SEC;
    }
    for (size_t v = 0; v < n && status == SL_OK; v++) {
        double distance = 0;
        for (size_t c = 0; c < 3 && !d->is_held[v] && d->n_held[d->component[v]] > 0; c++) {
            distance = hypot(distance, U[c * n + v] - d->U[c * n + v]);
        }
        /* written so that a NaN counts */
        *difference = distance / d->diameter <= *difference ? *difference : distance / d->diameter;
    }
    sl_fixed_free(D);
    free(G);
    free(rows);
    return status;
}

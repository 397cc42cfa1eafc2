/* deformer_mixed.c: biharmonic displacements by the system that does not square the Laplacian */
#include "deformer_mixed.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "tools/matrix/triplets.h"

bool deformer_is_refusal(sl_status status) {
    return status == SL_ERR_PIVOT || status == SL_ERR_INACCURATE || status == SL_ERR_NOT_FINITE ||
           status == SL_ERR_INCONSISTENT;
}

/* Whether vertex v has an unknown displacement. */
static bool is_free(const deformer *d, size_t v) {
    return !d->is_held[v] && d->n_held[d->component[v]] > 0;
}

static double largest_of(const double *x, size_t count) {
    double largest = 0;
    for (size_t k = 0; k < count; k++) { /* a NaN becomes infinite */
        largest = fabs(x[k]) <= largest ? largest : isnan(x[k]) ? INFINITY : fabs(x[k]);
    }
    return largest;
}

/* ---- corrections by solves with K ---- */

/* One correction of u and w = M^-1 L u; work: 2 x 3 n. Returns the largest change of u. */
static sl_status correct_once(deformer *d, deformer_step *step, void *context, double *u, double *w,
                              double *work, double *moved) {
    const size_t n = (size_t)d->n, n3 = 3 * n;
    const sl_csc L = sl_matrix_view(d->L);
    double *r = work, *other = work + n3;
    /* r = M w - L u, and B = -L w + L M^-1 r in the free rows */
    sl_status status = sl_csc_multiply(&L, SL_AS_SYMMETRIC, r, n, u, n, 3);
    for (size_t k = 0; k < n3; k++) {
        r[k] = d->mass[k % n] * w[k] - r[k];
        other[k] = r[k] / d->mass[k % n] - w[k];
    }
    status = status == SL_OK ? sl_csc_multiply(&L, SL_AS_SYMMETRIC, d->B, n, other, n, 3) : status;
    for (size_t k = 0; k < n3; k++) {
        d->B[k] = is_free(d, k % n) ? d->B[k] : 0;
    }
    status = status == SL_OK ? step(context, d, other) : status;
    for (size_t k = 0; k < n3 && status == SL_OK; k++) {
        other[k] = is_free(d, k % n) ? other[k] : 0;
        u[k] += other[k];
    }
    if (status == SL_OK) { /* w += M^-1 (L du - r) */
        *moved = largest_of(other, n3);
        status = sl_csc_multiply(&L, SL_AS_SYMMETRIC, d->B, n, other, n, 3);
    }
    for (size_t k = 0; k < n3 && status == SL_OK; k++) {
        w[k] += (d->B[k] - r[k]) / d->mass[k % n];
    }
    memset(d->B, 0, n3 * sizeof *d->B);
    return status;
}

sl_status deformer_correct(deformer *d, deformer_step *step, void *context, double *first,
                           bool *good) {
    enum { MOST = 10 };
    const double enough = 1e-9;
    const size_t n = (size_t)d->n, n3 = 3 * n;
    const sl_csc L = sl_matrix_view(d->L);
    double *u = (double *)malloc((4 * n3 + 1) * sizeof *u), *w = u + n3;
    *good = false;
    *first = INFINITY;
    if (u == NULL) {
        return SL_ERR_MEMORY;
    }
    memcpy(u, d->U, n3 * sizeof *u);
    const double size = largest_of(u, n3);
    sl_status status = sl_csc_multiply(&L, SL_AS_SYMMETRIC, w, n, u, n, 3);
    for (size_t k = 0; k < n3; k++) {
        w[k] /= d->mass[k % n];
    }
    double moved = isfinite(size) ? size : 0;
    for (int k = 0; k < MOST && status == SL_OK && isfinite(size) && !*good; k++) {
        const double before = moved;
        status = correct_once(d, step, context, u, w, w + n3, &moved);
        *good = status == SL_OK && moved <= enough * size;
        *first = k > 0 ? *first : size > 0 ? moved / size : 0;
        if (!*good && !(moved < 0.5 * before)) {
            break;
        }
    }
    if (*good) {
        memcpy(d->U, u, n3 * sizeof *u);
    }
    free(u);
    return deformer_is_refusal(status) ? SL_OK : status;
}

/* ---- the factor of the mixed system ---- */

struct deformer_mixed {
    sl_int n;            /* unknowns */
    sl_int *w_of, *u_of; /* by vertex: its unknowns; -1: none */
    double *scale;       /* n: of rows and columns */
    double *X, *B;       /* n x 3 */
    sl_matrix *A;        /* lower triangle, scaled */
    sl_symbolic *S;
    sl_factor *F;
};

void deformer_mixed_free(struct deformer_mixed *x) {
    if (x != NULL) {
        sl_factor_free(x->F);
        sl_symbolic_free(x->S);
        sl_matrix_free(x->A);
        free(x->w_of);
        free(x->u_of);
        free(x->scale);
        free(x->X);
        free(x->B);
        free(x);
    }
}

/* Numbers the unknowns: w of all vertices of components with handles, u of those that are not held.
 * Scales so that the diagonal of L becomes 1 and, in the mean, that of M: a system of equal
 * entries. */
static bool number(struct deformer_mixed *x, const deformer *d) {
    const size_t n = (size_t)d->n;
    const sl_csc L = sl_matrix_view(d->L);
    double ratio = 0, count = 0;
    x->w_of = (sl_int *)malloc((n + 1) * sizeof *x->w_of);
    x->u_of = (sl_int *)malloc((n + 1) * sizeof *x->u_of);
    x->scale = (double *)malloc((2 * n + 1) * sizeof *x->scale);
    if (x->w_of == NULL || x->u_of == NULL || x->scale == NULL) {
        return false;
    }
    for (size_t v = 0; v < n; v++) {
        const double diagonal = L.x[L.p[v]];
        ratio += diagonal > 0 ? log(d->mass[v] / diagonal) : 0;
        count += diagonal > 0;
    }
    const double of_w = exp(-ratio / fmax(1, count) / 2);
    for (size_t v = 0; v < n; v++) {
        const double diagonal = L.x[L.p[v]];
        const double root = diagonal > 0 ? sqrt(diagonal) : 1;
        const bool is_in = d->n_held[d->component[v]] > 0 && d->sizes[d->component[v]] > 1;
        x->w_of[v] = is_in ? x->n++ : -1;
        x->u_of[v] = is_in && !d->is_held[v] ? x->n++ : -1;
        if (is_in) {
            x->scale[x->w_of[v]] = of_w / root;
        }
        if (x->u_of[v] >= 0) {
            x->scale[x->u_of[v]] = 1 / (of_w * root);
        }
    }
    return true;
}

static bool add(triplets *list, const struct deformer_mixed *x, sl_int i, sl_int j, double value) {
    return i < 0 || j < 0 ||
           triplets_add(list, i > j ? i : j, i > j ? j : i, value * x->scale[i] * x->scale[j]);
}

static sl_status assemble(struct deformer_mixed *x, const deformer *d) {
    triplets list = {0, 0, NULL, NULL, NULL};
    const sl_csc L = sl_matrix_view(d->L);
    bool ok = true;
    for (sl_int j = 0; j < d->n && ok; j++) {
        ok = add(&list, x, x->w_of[j], x->w_of[j], -d->mass[j]) &&
             (x->u_of[j] < 0 || triplets_add(&list, x->u_of[j], x->u_of[j], 0));
        for (sl_int p = L.p[j]; p < L.p[j + 1] && ok; p++) {
            const sl_int i = L.i[p];
            ok = add(&list, x, x->w_of[i], x->u_of[j], L.x[p]) &&
                 (i == j || add(&list, x, x->w_of[j], x->u_of[i], L.x[p]));
        }
    }
    if (!ok) {
        triplets_free(&list);
        return SL_ERR_MEMORY;
    }
    return triplets_finish(&x->A, x->n, x->n, &list, true);
}

static sl_status create(struct deformer_mixed **out, deformer *d) {
    struct deformer_mixed *x = (struct deformer_mixed *)calloc(1, sizeof *x);
    *out = x;
    sl_status status = x != NULL && d->n < INT32_MAX / 2 && number(x, d) ? SL_OK : SL_ERR_MEMORY;
    if (status == SL_OK) {
        x->X = (double *)malloc((3 * (size_t)x->n + 1) * sizeof *x->X);
        x->B = (double *)malloc((3 * (size_t)x->n + 1) * sizeof *x->B);
        status = x->X != NULL && x->B != NULL ? assemble(x, d) : SL_ERR_MEMORY;
    }
    const sl_csc A = sl_matrix_view(x != NULL ? x->A : NULL);
    status = status == SL_OK ? sl_symbolic_create_pivoted(&x->S, &A, NULL, NULL) : status;
    status = status == SL_OK ? sl_factor_create(&x->F, x->S, &A, NULL, NULL) : status;
    if (status != SL_OK) {
        deformer_mixed_free(x);
        *out = NULL;
    }
    return status;
}

/* B = -L g in the rows of the first equation, for the displacements g of held vertices, which d->U
 * becomes for now. */
static sl_status set_right_side(struct deformer_mixed *x, deformer *d) {
    const size_t n = (size_t)d->n, rows = (size_t)x->n;
    const sl_csc L = sl_matrix_view(d->L);
    for (size_t k = 0; k < 3 * n; k++) {
        const size_t v = k % n, at = 3 * v + k / n;
        d->U[k] = d->is_held[v] ? d->target[at] - d->rest[k] : 0;
    }
    const sl_status status = sl_csc_multiply(&L, SL_AS_SYMMETRIC, d->B, n, d->U, n, 3);
    memset(x->B, 0, 3 * rows * sizeof *x->B);
    for (size_t k = 0; k < 3 * n; k++) {
        const sl_int row = x->w_of[k % n];
        if (row >= 0) {
            x->B[k / n * rows + (size_t)row] = -d->B[k] * x->scale[row];
        }
    }
    memset(d->B, 0, 3 * n * sizeof *d->B);
    return status;
}

sl_status deformer_solve_mixed(deformer *d, bool anew) {
    enum { STEPS = 10 };
    const size_t n = (size_t)d->n;
    struct deformer_mixed *x = anew ? NULL : d->mixed;
    sl_status status = x != NULL ? SL_OK : create(&x, d);
    if (status == SL_OK) {
        const sl_csc A = sl_matrix_view(x->A);
        const size_t rows = (size_t)x->n;
        status = set_right_side(x, d);
        if (status == SL_OK) {
            status = sl_factor_solve(x->F, x->X, rows, x->B, rows, 3, d->W);
        }
        if (status == SL_OK) {
            status = sl_factor_refine(x->F, &A, x->X, rows, x->B, rows, 3, STEPS, d->W, NULL);
        }
        for (size_t k = 0; k < 3 * n && status == SL_OK; k++) {
            const sl_int row = x->u_of[k % n];
            d->U[k] = row >= 0 ? x->X[k / n * rows + (size_t)row] * x->scale[row] : d->U[k];
        }
    }
    if (anew) {
        deformer_mixed_free(x);
    } else {
        d->mixed = x;
    }
    return status;
}

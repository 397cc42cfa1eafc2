/* arap_hessian.c: the Hessian of as-rigid-as-possible deformations, with rotations that follow */
#include "arap_hessian.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "tools/matrix/sparse_product.h"

/* The entries of a face: 9 between positions, then for each corner 6 of its rotation alone and 6
 * with the position of each corner. */
enum { POSITIONS = 18, OF_CORNER = 24, PER_FACE = POSITIONS + 3 * OF_CORNER };

/* Of each rotation's diagonal, so that rotations about one or two held vertices have a pivot. */
#define DAMPING 1e-7

void arap_hessian_free(arap_hessian *h) {
    sl_matrix_free(h->pattern);
    sl_fixed_free(h->factor);
    sl_work_free(h->work);
    free(h->values);
    free(h->at);
    free(h->fixed);
    free(h->x);
    memset(h, 0, sizeof *h);
}

/* ---- the pattern ---- */

/* An entry below the diagonal. */
static void put(sl_int *rows, sl_int *cols, int *k, sl_int row, sl_int col) {
    rows[*k] = row > col ? row : col;
    cols[*k] = row > col ? col : row;
    ++*k;
}

static void entries_of_face(sl_int rows[PER_FACE], sl_int cols[PER_FACE], const sl_int *face) {
    int k = 0;
    for (int c = 0; c < 3; c++) {
        for (sl_int e = 0; e < 3; e++) {
            put(rows, cols, &k, 6 * face[c] + e, 6 * face[c] + e);
            put(rows, cols, &k, 6 * face[(c + 1) % 3] + e, 6 * face[(c + 2) % 3] + e);
        }
    }
    for (int c = 0; c < 3; c++) {
        const sl_int turn = 6 * face[c] + 3;
        for (sl_int e = 0; e < 3; e++) {
            put(rows, cols, &k, turn + e, turn + e);
            put(rows, cols, &k, turn + (e + 1) % 3, turn + e);
        }
        for (int other = 0; other < 3; other++) {
            for (sl_int e = 0; e < 3; e++) {
                put(rows, cols, &k, turn + (e + 1) % 3, 6 * face[other] + e);
                put(rows, cols, &k, turn + e, 6 * face[other] + (e + 1) % 3);
            }
        }
    }
}

static sl_status make_pattern(arap_hessian *h) {
    const mesh *m = h->a->m;
    const size_t count = PER_FACE * (size_t)m->n_faces;
    sl_int *rows = (sl_int *)malloc((count + 1) * sizeof *rows);
    sl_int *cols = (sl_int *)malloc((count + 1) * sizeof *cols);
    sl_status status = rows != NULL && cols != NULL ? SL_OK : SL_ERR_MEMORY;
    for (size_t f = 0; f < (size_t)m->n_faces && status == SL_OK; f++) {
        entries_of_face(rows + PER_FACE * f, cols + PER_FACE * f, m->faces + 3 * f);
    }
    if (status == SL_OK) {
        status = sl_matrix_from_triplets(&h->pattern, 6 * m->n_vertices, 6 * m->n_vertices,
                                         (sl_off)count, rows, cols, NULL, NULL, NULL);
    }
    if (status == SL_OK) {
        const sl_csc A = sl_matrix_view(h->pattern);
        h->values = (double *)malloc(((size_t)A.p[A.n_cols] + 1) * sizeof *h->values);
        status = h->values != NULL ? SL_OK : SL_ERR_MEMORY;
        for (size_t k = 0; k < count && status == SL_OK; k++) {
            h->at[k] = csc_position(&A, rows[k], cols[k]);
        }
    }
    free(rows);
    free(cols);
    return status;
}

sl_status arap_hessian_create(arap_hessian *out, const arap_surface *a,
                              const unsigned char *is_fixed) {
    const size_t n = (size_t)a->m->n_vertices, nf = (size_t)a->m->n_faces;
    memset(out, 0, sizeof *out);
    if (n > INT32_MAX / 6 - 8 || nf > INT32_MAX / PER_FACE) {
        return SL_ERR_TOO_LARGE;
    }
    out->a = a;
    out->at = (sl_int *)malloc((PER_FACE * nf + 1) * sizeof *out->at);
    out->fixed = (sl_int *)malloc((6 * n + 1) * sizeof *out->fixed);
    out->x = (double *)malloc((6 * n + 1) * sizeof *out->x);
    sl_status status = out->at != NULL && out->fixed != NULL && out->x != NULL
                           ? sl_work_create(&out->work, NULL)
                           : SL_ERR_MEMORY;
    for (sl_int row = 0; status == SL_OK && row < 6 * a->m->n_vertices; row++) {
        if (is_fixed[row / 6] > (row % 6 < 3 ? 0 : 1)) {
            out->fixed[out->n_fixed++] = row;
        }
    }
    status = status == SL_OK ? make_pattern(out) : status;
    if (status != SL_OK) {
        arap_hessian_free(out);
    }
    return status;
}

/* ---- the numbers ---- */

/* The edges of a face: edge k is opposite to corner k and runs from corner k + 1 to k + 2. */
typedef struct face_edges {
    double x[3][3], y[3][3]; /* at rest and now */
    double p[3][3];          /* x, turned by the rotation of a corner */
    double w[3];             /* a third of the weights */
} face_edges;

/* Adds the terms of the rotation at one corner of a face. */
static void add_corner(double *values, const sl_int *at, const face_edges *f, double soft) {
    for (int e = 0; e < 3; e++) { /* y . p minus the symmetric part of y p' */
        const int next = (e + 1) % 3, last = (e + 2) % 3;
        for (int k = 0; k < 3; k++) {
            const double *p = f->p[k];
            double y[3];
            for (int j = 0; j < 3; j++) {
                y[j] = f->y[k][j] + soft * (p[j] - f->y[k][j]);
            }
            values[at[0]] += f->w[k] * (p[next] * y[next] + p[last] * y[last]);
            values[at[1]] -= f->w[k] * 0.5 * (p[next] * y[e] + p[e] * y[next]);
        }
        at += 2;
    }
    for (int other = 0; other < 3; other++) {
        const int out = (other + 2) % 3, in = (other + 1) % 3; /* begins and ends at `other` */
        double sum[3];
        for (int e = 0; e < 3; e++) {
            sum[e] = f->w[out] * f->p[out][e] - f->w[in] * f->p[in][e];
        }
        for (int e = 0; e < 3; e++) { /* -[sum]x: rows of the rotation, columns of the position */
            values[at[0]] -= sum[(e + 2) % 3];
            values[at[1]] += sum[(e + 2) % 3];
            at += 2;
        }
    }
}

static void add_face(const arap_hessian *h, size_t f, const double *Y) {
    const arap_surface *a = h->a;
    const sl_int *at = h->at + PER_FACE * f;
    double *values = h->values;
    const size_t n = (size_t)a->m->n_vertices;
    const sl_int *v = a->m->faces + 3 * f;
    const double *w = a->weights + 3 * f;
    face_edges edges;
    for (size_t k = 0; k < 9; k++) {
        const size_t from = (size_t)v[(k / 3 + 1) % 3], to = (size_t)v[(k / 3 + 2) % 3];
        edges.x[k / 3][k % 3] = a->m->xyz[3 * from + k % 3] - a->m->xyz[3 * to + k % 3];
        edges.y[k / 3][k % 3] = Y[k % 3 * n + from] - Y[k % 3 * n + to];
        edges.w[k / 3] = w[k / 3] / 3;
    }
    for (int c = 0; c < 3; c++) {
        for (int e = 0; e < 3; e++) {
            values[*at++] += w[(c + 1) % 3] + w[(c + 2) % 3];
            values[*at++] -= w[c];
        }
    }
    for (int c = 0; c < 3; c++, at += OF_CORNER) {
        const double *R = a->rotations + 9 * (size_t)v[c];
        for (int k = 0; k < 9; k++) {
            const double *x = edges.x[k / 3];
            edges.p[k / 3][k % 3] = R[k % 3] * x[0] + R[3 + k % 3] * x[1] + R[6 + k % 3] * x[2];
        }
        add_corner(values, at, &edges, h->soft);
    }
}

static sl_status factor(arap_hessian *h, const double *Y, sl_stats *stats) {
    sl_csc A = sl_matrix_view(h->pattern);
    sl_options opt;
    double sum = 0;
    memset(&opt, 0, sizeof opt);
    memset(h->values, 0, (size_t)A.p[A.n_cols] * sizeof *h->values);
    for (size_t f = 0; f < (size_t)h->a->m->n_faces; f++) {
        add_face(h, f, Y);
    }
    for (int turn = 0; turn < 2; turn++) { /* first their mean */
        for (sl_int j = 0; j < A.n_cols; j++) {
            if (j % 6 >= 3 && A.p[j] < A.p[j + 1]) {
                double *diagonal = h->values + A.p[j]; /* rows ascend */
                sum += turn == 0 ? *diagonal / (double)A.n_cols : 0;
                *diagonal += turn == 1 ? DAMPING * (*diagonal + sum) : 0;
            }
        }
    }
    A.x = h->values;
    return h->factor != NULL ? sl_fixed_refactor(h->factor, &A, stats)
                             : sl_fixed_create(&h->factor, &A, h->fixed, h->n_fixed, &opt, stats);
}

sl_status arap_hessian_factor(arap_hessian *h, const double *Y) {
    sl_stats stats;
    sl_status status = factor(h, Y, &stats);
    if (status == SL_OK && stats.factor.negative > 0 && h->soft < 1) {
        h->soft = 1;
        status = factor(h, Y, &stats);
    }
    return status;
}

sl_status arap_hessian_solve(arap_hessian *h, double *X, const double *B) {
    const size_t n = (size_t)h->a->m->n_vertices, m = (size_t)h->n_fixed;
    double *given = (double *)malloc((m + 1) * sizeof *given);
    if (given == NULL) {
        return SL_ERR_MEMORY;
    }
    for (size_t k = 0; k < m; k++) {
        const size_t row = (size_t)h->fixed[k];
        given[k] = row % 6 < 3 ? X[row % 6 * n + row / 6] : 0;
    }
    for (size_t k = 0; k < 6 * n; k++) {
        h->x[k] = B != NULL && k % 6 < 3 ? B[k % 6 * n + k / 6] : 0;
    }
    const sl_status status =
        sl_fixed_solve(h->factor, h->x, 6 * n, h->x, 6 * n, given, m, 1, h->work);
    for (size_t k = 0; k < 3 * n && status == SL_OK; k++) {
        X[k] = h->x[6 * (k % n) + k / n];
    }
    free(given);
    return status;
}

/* sequence_model.h: the dense model of fuzz_sequence.c, and values and sets from its input */
#ifndef SL_FUZZ_SEQUENCE_MODEL_H
#define SL_FUZZ_SEQUENCE_MODEL_H

#include "sequence_pool.h"

static sl_int order_of(const factor_t *f) {
    return analyses[f->analysis].n;
}

static sl_csc view(const analysis_t *s, const double *x) {
    sl_csc A = {s->n, s->n, s->p, s->i, x};
    return A;
}

/* Relative error of a solution. */
static double tolerance(const factor_t *f) {
    return f->is_float ? 1e-4 : 1e-11;
}

static int is_singular(kind_t kind) {
    return kind == LAPLACIAN || kind == RIGID;
}

static void set_dense(const analysis_t *s, values_t *v) {
    memset(v->a, 0, sizeof v->a);
    for (sl_int j = 0; j < s->n; j++) {
        for (sl_int q = s->p[j]; q < s->p[j + 1]; q++) {
            v->a[s->i[q] + MOST * j] = v->x[q];
            v->a[j + MOST * s->i[q]] = v->x[q];
        }
    }
}

/* x = A^-1 b by elimination with partial pivoting. Returns det A. */
static double dense_solve(const double *a, sl_int n, const double *b, double *x) {
    double m[MOST][MOST + 1], det = 1.0;
    for (sl_int i = 0; i < n; i++) {
        for (sl_int j = 0; j < n; j++) {
            m[i][j] = a[i + MOST * j];
        }
        m[i][n] = b[i];
    }
    for (sl_int k = 0; k < n; k++) {
        sl_int best = k;
        for (sl_int i = k + 1; i < n; i++) {
            best = fabs(m[i][k]) > fabs(m[best][k]) ? i : best;
        }
        for (sl_int j = 0; j <= n; j++) {
            const double keep = m[k][j];
            m[k][j] = m[best][j];
            m[best][j] = keep;
        }
        det *= best == k ? m[k][k] : -m[k][k];
        for (sl_int i = k + 1; i < n; i++) {
            const double l = m[i][k] / m[k][k];
            for (sl_int j = k; j <= n; j++) {
                m[i][j] -= l * m[k][j];
            }
        }
    }
    for (sl_int k = n - 1; k >= 0; k--) {
        x[k] = m[k][n];
        for (sl_int j = k + 1; j < n; j++) {
            x[k] -= m[k][j] * x[j];
        }
        x[k] /= m[k][k];
    }
    return det;
}

static double largest(const double *x, sl_int n) {
    double most = 0.0;
    for (sl_int k = 0; k < n; k++) {
        most = fmax(most, fabs(x[k]));
    }
    return most;
}

/* component[i] = the smallest row connected to i by nonzero entries */
static void find_components(const double *a, sl_int n, sl_int *component) {
    for (sl_int i = 0; i < n; i++) {
        component[i] = i;
    }
    for (sl_int round = 0; round < n; round++) {
        for (sl_int i = 0; i < n; i++) {
            for (sl_int j = 0; j < n; j++) {
                if (a[i + MOST * j] != 0.0 && component[j] < component[i]) {
                    component[i] = component[j];
                }
            }
        }
    }
}

/* Products of b with the null vectors of the components, at their smallest rows. The values are
 * eighths: sums are exact. */
static int is_consistent(const factor_t *f, const double *b) {
    const sl_int n = order_of(f);
    sl_int component[MOST];
    double sum[MOST] = {0.0}, moment[MOST] = {0.0};
    find_components(f->v.a, n, component);
    for (sl_int i = 0; i < n; i++) {
        sum[component[i]] += b[i];
        moment[component[i]] += f->v.kind == RIGID ? i * b[i] : 0.0;
    }
    return largest(sum, n) == 0.0 && largest(moment, n) == 0.0;
}

/* The null vectors of a LAPLACIAN or RIGID matrix: one or two for each component. */
static sl_int nullity_of(const values_t *v, sl_int n) {
    sl_int component[MOST], count = 0;
    find_components(v->a, n, component);
    for (sl_int k = 0; k < n; k++) {
        sl_int rows = 0;
        for (sl_int i = 0; i < n; i++) {
            rows += component[i] == k;
        }
        count += rows == 0 ? 0 : rows > 2 && v->kind == RIGID ? 2 : 1;
    }
    return count;
}

/* Checks A x = b, or for a Laplacian with mass m: A x = b - c m with sum m x = 0 per component. A
 * component of a RIGID matrix has A x = b - (c + d i) m, and sum i m x = 0, too. */
static void check_laplacian(const factor_t *f, const double *x, const double *b, double bound) {
    const sl_int n = order_of(f);
    const int is_rigid = f->v.kind == RIGID;
    sl_int component[MOST], rows[MOST] = {0};
    /* of each component: sums of b, i b, m, i m, i^2 m, m x, i m x */
    double sum[MOST][7] = {{0.0}}, size = largest(b, n);
    find_components(f->v.a, n, component);
    for (sl_int i = 0; i < n; i++) {
        const double terms[7] = {b[i],
                                 i * b[i],
                                 f->mass[i],
                                 i * f->mass[i],
                                 i * i * f->mass[i],
                                 f->mass[i] * x[i],
                                 i * f->mass[i] * x[i]};
        rows[component[i]]++;
        for (int k = 0; k < 7; k++) {
            sum[component[i]][k] += terms[k];
        }
        for (sl_int j = 0; j < n; j++) {
            size = fmax(size, fabs(f->v.a[i + MOST * j] * x[j]));
        }
    }
    for (sl_int i = 0; i < n; i++) {
        const double *s = sum[component[i]];
        const int has_two = is_rigid && rows[component[i]] > 2;
        const double d = has_two ? (s[1] * s[2] - s[0] * s[3]) / (s[4] * s[2] - s[3] * s[3]) : 0.0;
        const double c = (s[0] - d * s[3]) / s[2];
        double residual = b[i] - (f->has_mass ? (c + d * i) * f->mass[i] : 0.0);
        for (sl_int j = 0; j < n; j++) {
            residual -= f->v.a[i + MOST * j] * x[j];
        }
        PROMISE(fabs(residual) <= bound * size);
        PROMISE(!f->has_mass || fabs(s[5]) <= bound * size * MOST);
        PROMISE(!f->has_mass || !has_two || fabs(s[6]) <= bound * size * MOST * MOST);
    }
}

static void check_solution(const factor_t *f, const double *x, const double *b, double bound) {
    const sl_int n = order_of(f);
    double y[MOST];
    if (is_singular(f->v.kind)) {
        check_laplacian(f, x, b, bound);
    } else if (f->v.kind == DOMINANT) {
        (void)dense_solve(f->v.a, n, b, y);
        for (sl_int i = 0; i < n; i++) {
            PROMISE(fabs(x[i] - y[i]) <= bound * largest(y, n));
        }
    }
}

static void check_same(double x, double y) {
    PROMISE(x == y || (isnan(x) && isnan(y)));
}

/* ---- values from the input ---- */

static double take_eighths(input_t *in) {
    return (take(in) - 128) / 8.0;
}

static double take_wild(input_t *in) {
    static const double odd[8] = {1e300, -1e300, NAN, 0.0, 1.0 / 3.0, 5e-324, INFINITY, 1e16};
    const int byte = take(in);
    return byte >= 248 ? odd[byte - 248] : (byte - 124) / 8.0;
}

/* The number of zero pivots, with complete pivoting; a is destroyed. */
static sl_int dense_nullity(double *a, sl_int n) {
    const double least = 1e-9 * largest(a, ENTRIES);
    sl_int rank = 0;
    for (; rank < n; rank++) {
        sl_int row = rank, column = rank;
        for (sl_int i = rank; i < n; i++) {
            for (sl_int j = rank; j < n; j++) {
                if (fabs(a[i + MOST * j]) > fabs(a[row + MOST * column])) {
                    row = i;
                    column = j;
                }
            }
        }
        if (!(fabs(a[row + MOST * column]) > least)) {
            break;
        }
        for (sl_int k = 0; k < n; k++) {
            const double keep = a[rank + MOST * k];
            a[rank + MOST * k] = a[row + MOST * k];
            a[row + MOST * k] = keep;
        }
        for (sl_int k = 0; k < n; k++) {
            const double keep = a[k + MOST * rank];
            a[k + MOST * rank] = a[k + MOST * column];
            a[k + MOST * column] = keep;
        }
        for (sl_int i = rank + 1; i < n; i++) {
            const double l = a[i + MOST * rank] / a[rank + MOST * rank];
            for (sl_int j = rank; j < n; j++) {
                a[i + MOST * j] -= l * a[rank + MOST * j];
            }
        }
    }
    return n - rank;
}

/* Adds w c c' for each triangle i, j, k of the pattern; c is orthogonal to 1 and to (i, j, k).
 * Returns whether the null vectors are those of a RIGID matrix: where triangles share a row only,
 * there are more. */
static int take_rigid(input_t *in, const analysis_t *s, values_t *v) {
    int is_stored[ENTRIES] = {0};
    double a[ENTRIES] = {0.0};
    for (sl_int j = 0; j < s->n; j++) {
        for (sl_int q = s->p[j]; q < s->p[j + 1]; q++) {
            is_stored[s->i[q] + MOST * j] = is_stored[j + MOST * s->i[q]] = 1;
        }
    }
    for (sl_int i = 0; i < s->n; i++) {
        for (sl_int j = i + 1; j < s->n; j++) {
            for (sl_int k = j + 1; k < s->n && is_stored[i + MOST * j]; k++) {
                if (is_stored[i + MOST * k] && is_stored[j + MOST * k]) {
                    const sl_int rows[3] = {i, j, k};
                    const double c[3] = {k - j, i - k, j - i}, w = 1.0 + take(in) % 16 / 8.0;
                    for (int e = 0; e < 9; e++) {
                        a[rows[e / 3] + MOST * rows[e % 3]] += w * c[e / 3] * c[e % 3];
                    }
                }
            }
        }
    }
    for (sl_int j = 0; j < s->n; j++) {
        for (sl_int q = s->p[j]; q < s->p[j + 1]; q++) {
            v->x[q] = a[s->i[q] + MOST * j];
        }
    }
    v->kind = RIGID;
    set_dense(s, v);
    return dense_nullity(a, s->n) == nullity_of(v, s->n);
}

static void take_values(input_t *in, const analysis_t *s, kind_t kind, values_t *v) {
    double sum[MOST] = {0.0};
    memset(v->x, 0, sizeof v->x);
    if (kind == RIGID && take_rigid(in, s, v)) {
        return;
    }
    kind = kind == RIGID ? LAPLACIAN : kind;
    v->kind = kind;
    for (sl_int j = 0; j < s->n; j++) {
        for (sl_int q = s->p[j]; q < s->p[j + 1]; q++) {
            const sl_int i = s->i[q];
            if (kind == WILD) {
                v->x[q] = take_wild(in);
            } else if (i != j) {
                v->x[q] = kind == LAPLACIAN ? -1.0 - take(in) % 16 / 8.0 : take_eighths(in);
                sum[i] += fabs(v->x[q]);
                sum[j] += fabs(v->x[q]);
            }
        }
    }
    for (sl_int j = 0; j < s->n && kind != WILD; j++) {
        for (sl_int q = s->p[j]; q < s->p[j + 1]; q++) {
            if (s->i[q] == j) {
                v->x[q] = kind == LAPLACIAN ? sum[j] : 1.25 * sum[j] + 1.0;
                v->x[q] *= kind == DOMINANT && take(in) % 4 == 0 ? -1.0 : 1.0;
            }
        }
    }
    set_dense(s, v);
}

/* Any rows, some of them twice. */
static void take_set(input_t *in, sl_int n, set_t *set) {
    const int form = take(in);
    set->is_all = form >= 240;
    set->count = set->is_all ? n : n > 0 ? form % (SET + 1) : 0;
    for (sl_int k = 0; k < set->count; k++) {
        set->rows[k] = set->is_all ? k : take(in) % n;
    }
}

static const sl_int *rows_of(const set_t *set) {
    return set->is_all ? NULL : set->rows;
}

#endif

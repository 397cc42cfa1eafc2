/* connection.h: a complex connection Laplacian of a grid, in every form, with its factor */
#ifndef SL_TEST_CONNECTION_H
#define SL_TEST_CONNECTION_H

#include "gen_matrices.h"
#include "test.h"

enum { SIDE = 9, N = SIDE * SIDE, EDGES = 2 * SIDE * (SIDE - 1), ENTRIES = N + EDGES };

/* A connection Laplacian of a grid plus a shift, by its lower triangle. */
typedef struct connection_t {
    sl_int p[N + 1], i[ENTRIES];
    double x[2 * ENTRIES], re[ENTRIES], im[ENTRIES];
    sl_hermitian H;
} connection_t;

static inline void connection_fill(connection_t *c, double shift, uint64_t seed) {
    sl_int at = 0;
    double diagonal[N];
    for (sl_int k = 0; k < N; k++) {
        diagonal[k] = shift;
    }
    for (sl_int k = 0; k < N; k++) {
        const sl_int begin = at++;
        c->p[k] = begin;
        c->i[begin] = k;
        for (int down = 0; down < 2; down++) {
            const sl_int other = k + (down ? SIDE : 1);
            if (down ? other < N : k % SIDE < SIDE - 1) {
                const double weight = 1.5 + gen_real(&seed), angle = 3.0 * gen_real(&seed);
                diagonal[k] += weight;
                diagonal[other] += weight;
                c->i[at] = other;
                c->re[at] = -weight * cos(angle);
                c->im[at++] = -weight * sin(angle);
            }
        }
        c->re[begin] = diagonal[k]; /* edges to lower rows have been added */
        c->im[begin] = 0.0;
    }
    c->p[N] = at;
    for (sl_int k = 0; k < at; k++) {
        c->x[2 * k] = c->re[k];
        c->x[2 * k + 1] = c->im[k];
    }
    c->H.n = N;
    c->H.p = c->p;
    c->H.i = c->i;
    c->H.x = c->x;
    c->H.im = NULL;
}

static inline connection_t *connection_make(double shift, uint64_t seed) {
    connection_t *c = (connection_t *)test_array(1, sizeof *c);
    connection_fill(c, shift, seed);
    return c;
}

/* The largest part of a component of H x - b, in complex arithmetic. */
static inline double residual(const connection_t *c, const double *x, const double *b) {
    double r[2 * N], worst = 0.0;
    for (sl_int k = 0; k < 2 * N; k++) {
        r[k] = -b[k];
    }
    for (sl_int j = 0; j < N; j++) {
        for (sl_int p = c->p[j]; p < c->p[j + 1]; p++) {
            const sl_int i = c->i[p];
            const double re = c->re[p], im = c->im[p];
            r[2 * i] += re * x[2 * j] - im * x[2 * j + 1];
            r[2 * i + 1] += re * x[2 * j + 1] + im * x[2 * j];
            if (i != j) { /* the conjugate entry */
                r[2 * j] += re * x[2 * i] + im * x[2 * i + 1];
                r[2 * j + 1] += re * x[2 * i + 1] - im * x[2 * i];
            }
        }
    }
    for (sl_int k = 0; k < 2 * N; k++) {
        worst = fmax(worst, fabs(r[k]));
    }
    return worst;
}

typedef struct system_t {
    sl_matrix *M;
    sl_csc A;
    sl_symbolic *S;
    sl_factor *F;
} system_t;

static inline system_t system_make(const sl_hermitian *H) {
    system_t y;
    sl_options opt = options_none();
    opt.block_size = 2;
    SL_CHECK(sl_matrix_from_hermitian(&y.M, H, NULL, NULL));
    y.A = sl_matrix_view(y.M);
    SL_CHECK(sl_csc_check(&y.A, NULL));
    SL_CHECK(sl_symbolic_create(&y.S, &y.A, &opt, NULL));
    SL_CHECK(sl_factor_create(&y.F, y.S, &y.A, NULL, NULL));
    return y;
}

static inline void system_free(system_t *y) {
    sl_factor_free(y->F);
    sl_symbolic_free(y->S);
    sl_matrix_free(y->M);
}

/* The other forms of c->H: split values, the upper triangle, both triangles. x and im have room for
 * 2 ENTRIES. */
static inline sl_hermitian other_form(const connection_t *c, int is_upper, int is_both, sl_int *p,
                                      sl_int *i, double *x, double *im) {
    sl_hermitian H = {N, p, i, x, im};
    sl_int at = 0;
    for (sl_int column = 0; column < N; column++) {
        p[column] = at;
        for (sl_int j = 0; j < N && (is_upper || is_both); j++) {
            for (sl_int q = c->p[j]; q < c->p[j + 1]; q++) {
                if (c->i[q] == column && (j != column || !is_both)) {
                    i[at] = j;
                    x[at] = c->re[q];
                    im[at++] = j == column ? 0.0 : -c->im[q];
                }
            }
        }
        for (sl_int q = c->p[column]; q < c->p[column + 1] && !is_upper; q++) {
            i[at] = c->i[q];
            x[at] = c->re[q];
            im[at++] = c->im[q];
        }
    }
    p[N] = at;
    return H;
}

#endif

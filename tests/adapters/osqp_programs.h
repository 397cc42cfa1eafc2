/* osqp_programs.h: vectors and matrices in the place of those of OSQP, and random programs */
#ifndef SL_TESTS_ADAPTERS_OSQP_PROGRAMS_H
#define SL_TESTS_ADAPTERS_OSQP_PROGRAMS_H

#include "tests/lib/gen_graphs.h"

#include "osqp_interface.h"

/* ---- vectors and matrices ---- */

struct OSQPVectorf {
    OSQPFloat *x;
};

struct OSQPMatrix {
    OSQPInt m, n, *p, *i;
    OSQPFloat *x;
};

OSQPFloat *OSQPVectorf_data(const OSQPVectorf *v) {
    return v->x;
}

OSQPInt OSQPMatrix_get_m(const OSQPMatrix *M) {
    return M->m;
}

OSQPInt OSQPMatrix_get_n(const OSQPMatrix *M) {
    return M->n;
}

OSQPInt *OSQPMatrix_get_p(const OSQPMatrix *M) {
    return M->p;
}

OSQPInt *OSQPMatrix_get_i(const OSQPMatrix *M) {
    return M->i;
}

OSQPFloat *OSQPMatrix_get_x(const OSQPMatrix *M) {
    return M->x;
}

/* ---- programs ---- */

/* P = the upper triangle of a definite matrix without some diagonal entries, A, and 1/rho. */
typedef struct program_t {
    sl_int n, m;
    OSQPMatrix P, A;
    OSQPVectorf rho;
    OSQPSettings settings;
} program_t;

static OSQPFloat *floats(size_t count) {
    return (OSQPFloat *)test_array(count, sizeof(OSQPFloat));
}

/* Entries of a matrix with some probability: above the diagonal, on it, or all. */
static OSQPMatrix matrix_make(sl_int rows, sl_int columns, int is_upper, uint64_t *state) {
    const size_t room = (size_t)rows * (size_t)columns;
    OSQPMatrix M;
    OSQPInt count = 0;
    M.m = rows;
    M.n = columns;
    M.p = (OSQPInt *)test_array((size_t)columns + 1, sizeof(OSQPInt));
    M.i = (OSQPInt *)test_array(room, sizeof(OSQPInt));
    M.x = floats(room);
    for (sl_int j = 0; j < columns; j++) {
        for (sl_int i = 0; i < (is_upper ? j + 1 : rows); i++) {
            const int is_diagonal = is_upper && i == j;
            if (gen_below(state, is_diagonal ? 4 : 3) >= (is_diagonal ? 1 : 2)) {
                M.i[count] = i;
                M.x[count++] = (OSQPFloat)(is_diagonal ? columns + gen_real(state)
                                           : is_upper  ? 0.5 * gen_real(state)
                                                       : gen_real(state));
            }
        }
        M.p[j + 1] = count;
    }
    return M;
}

static void matrix_free(OSQPMatrix *M) {
    free(M->p);
    free(M->i);
    free(M->x);
}

static void new_rho(program_t *w, uint64_t *state) {
    for (sl_int k = 0; k < w->m; k++) {
        w->rho.x[k] = (OSQPFloat)(0.125 + fabs(gen_real(state)));
    }
}

static program_t program_make(sl_int n, sl_int m, uint64_t seed) {
    program_t w;
    uint64_t state = seed;
    w.n = n;
    w.m = m;
    w.P = matrix_make(n, n, 1, &state);
    /* rows without a diagonal entry must have no other one: P stays semidefinite */
    for (sl_int j = 0; j < n; j++) {
        const int is_full = w.P.p[j + 1] > w.P.p[j] && w.P.i[w.P.p[j + 1] - 1] == j;
        for (OSQPInt p = 0; p < w.P.p[n] && !is_full; p++) {
            if (w.P.i[p] == j || (p >= w.P.p[j] && p < w.P.p[j + 1])) {
                w.P.x[p] = 0;
            }
        }
    }
    w.A = matrix_make(m, n, 0, &state);
    w.rho.x = floats((size_t)m);
    new_rho(&w, &state);
    w.settings.rho = (OSQPFloat)0.5;
    w.settings.sigma = (OSQPFloat)0.25;
    return w;
}

static void program_free(program_t *w) {
    matrix_free(&w->P);
    matrix_free(&w->A);
    free(w->rho.x);
}

#endif

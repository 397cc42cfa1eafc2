/* random_systems.h: families of random symmetric systems, from definite ones to hopeless ones */
#ifndef SL_TEST_RANDOM_SYSTEMS_H
#define SL_TEST_RANDOM_SYSTEMS_H

#include "gen_matrices.h"

enum { SYSTEM_FAMILIES = 24 };

/* A x = b, and the options that its factorization needs. */
typedef struct random_system_t {
    gen_matrix_t M;
    sl_int n;
    double *b;
    double regularization;
    sl_int *signs;
    int is_definite;
} random_system_t;

static inline const char *system_name(int family) {
    static const char *const names[SYSTEM_FAMILIES] = {
        "dominant",       "grid with mass",  "scaled definite", "Hilbert",         "weights",
        "weak grid",      "Gauss",           "Gauss, diagonal", "eps blocks",      "blocks, scaled",
        "KKT zero",       "KKT tiny",        "KKT regularized", "KKT indefinite",  "KKT scaled",
        "interior point", "least squares",   "arrow",           "tridiagonal",     "graph - shift",
        "grid - shift",   "scaled Gauss",    "zero diagonal",   "lost Schur"};
    return names[family];
}

/* Entry (i, j) of the lower triangle of a square array. */
#define LOWER(M, n, i, j) (M)[(size_t)(i) * (size_t)(n) + (size_t)(j)]

/* 10^u, u uniform in low .. high */
static inline double system_scale(uint64_t *state, double low, double high) {
    return pow(10.0, low + (high - low) * (0.5 + 0.5 * gen_real(state)));
}

/* Standard normal. */
static inline double system_normal(uint64_t *state) {
    const double u = fabs(gen_real(state)), v = gen_real(state);
    return sqrt(-2.0 * log(u)) * cos(3.14159265358979323846 * v);
}

/* Adds a spring of weight w between i and j. */
static inline void system_spring(double *M, sl_int n, sl_int i, sl_int j, double w) {
    LOWER(M, n, i > j ? i : j, i > j ? j : i) -= w;
    LOWER(M, n, i, i) += w;
    LOWER(M, n, j, j) += w;
}

/* A grid of springs whose weights spread over 10^-spread .. 1; n is a square. */
static inline void system_grid(double *M, sl_int n, double spread, uint64_t *state) {
    sl_int side = (sl_int)sqrt((double)n + 0.5);
    for (sl_int k = 0; k < side * side; k++) {
        if (k % side > 0) {
            system_spring(M, n, k, k - 1, system_scale(state, -spread, 0.0));
        }
        if (k >= side) {
            system_spring(M, n, k, k - side, system_scale(state, -spread, 0.0));
        }
    }
}

/* M(i, j) *= s(i) s(j) for random scales s = 10^-range .. 10^range. */
static inline void system_rescale(double *M, sl_int n, double range, uint64_t *state) {
    double *s = test_reals((size_t)n);
    for (sl_int i = 0; i < n; i++) {
        s[i] = system_scale(state, -range, range);
        for (sl_int j = 0; j <= i; j++) {
            LOWER(M, n, i, j) *= s[i] * s[j];
        }
    }
    free(s);
}

/* [H B'; B -C]: H of n - n / 3 rows is diagonally dominant, or indefinite; B has 3 entries a row; C
 * is diagonal and empty here. */
static inline void system_kkt(double *M, sl_int n, int is_definite, uint64_t *state) {
    const sl_int m = n - n / 3;
    for (sl_int i = 0; i < m; i++) {
        LOWER(M, n, i, i) = is_definite ? 3.0 + fabs(gen_real(state)) : gen_real(state);
        for (sl_int j = i > 3 ? i - 3 : 0; j < i; j++) {
            LOWER(M, n, i, j) = gen_below(state, 3) == 0 ? 0.4 * gen_real(state) : 0.0;
        }
    }
    for (sl_int i = m; i < n; i++) {
        for (int k = 0; k < 3; k++) {
            LOWER(M, n, i, gen_below(state, m)) = gen_real(state);
        }
    }
}

static inline void system_gauss(double *M, sl_int n, double diagonal, uint64_t *state) {
    for (sl_int i = 0; i < n; i++) {
        for (sl_int j = 0; j <= i; j++) {
            LOWER(M, n, i, j) = (i == j ? diagonal : 1.0) * system_normal(state);
        }
    }
}

/* Blocks [e 1; 1 1], coupled by entries of size coupling, in random order. */
static inline void system_blocks(double *M, sl_int n, double coupling, uint64_t *state) {
    sl_int *order = test_ints((size_t)n);
    gen_permutation(order, n, gen_bits(state));
    for (sl_int k = 0; k < n; k++) {
        const sl_int i = order[k];
        LOWER(M, n, i, i) = k % 2 == 0 ? system_scale(state, -20.0, 0.0) : 1.0;
        for (sl_int t = 1; t <= 2 && t <= k; t++) {
            const sl_int j = order[k - t], low = i < j ? i : j, high = i < j ? j : i;
            LOWER(M, n, high, low) = t == 1 && k % 2 == 1 ? 1.0 : coupling * gen_real(state);
        }
    }
    free(order);
}

static inline void system_fill_definite(random_system_t *y, double *M, int family,
                                        uint64_t *state) {
    const sl_int n = y->n;
    y->is_definite = 1;
    switch (family) {
    case 0:
        for (sl_int i = 0; i < n; i++) {
            LOWER(M, n, i, i) += 0.1;
            for (sl_int j = 0; j < i; j++) {
                double w = gen_below(state, n) < 3 ? gen_real(state) : 0.0;
                system_spring(M, n, i, j, fabs(w));
                LOWER(M, n, i, j) = w;
            }
        }
        break;
    case 1:
        system_grid(M, n, 0.0, state);
        for (sl_int i = 0; i < n; i++) {
            LOWER(M, n, i, i) += system_scale(state, -6.0, 0.0);
        }
        break;
    case 2:
        system_grid(M, n, 2.0, state);
        for (sl_int i = 0; i < n; i++) {
            LOWER(M, n, i, i) += 0.1;
        }
        system_rescale(M, n, 1.0 + 40.0 * fabs(gen_real(state)), state);
        break;
    case 3:
        for (sl_int i = 0; i < n; i++) {
            for (sl_int j = 0; j <= i; j++) {
                LOWER(M, n, i, j) = 1.0 / (double)(i + j + 1) + (i == j ? 1e-13 : 0.0);
            }
        }
        break;
    case 4:
        system_grid(M, n, 12.0, state);
        for (sl_int i = 0; i < n; i++) {
            LOWER(M, n, i, i) += system_scale(state, -12.0, 0.0);
        }
        break;
    default:
        system_grid(M, n, 1.0, state);
        LOWER(M, n, 0, 0) += system_scale(state, -12.0, 0.0);
    }
}

static inline void system_fill_kkt(random_system_t *y, double *M, int family, uint64_t *state) {
    const sl_int n = y->n, m = n - n / 3;
    system_kkt(M, n, family != 13, state);
    if (family == 11 || family == 14 || family == 13) {
        const double c = family == 13 ? 1.0 : system_scale(state, -14.0, 0.0);
        for (sl_int i = m; i < n; i++) {
            LOWER(M, n, i, i) = -c * (0.5 + fabs(gen_real(state)));
        }
    }
    if (family == 12) {
        y->regularization = system_scale(state, -12.0, -5.0);
        y->signs = test_ints((size_t)n);
        for (sl_int i = 0; i < n; i++) {
            y->signs[i] = i < m ? 1 : -1;
        }
    }
    if (family == 14) {
        system_rescale(M, n, 6.0, state);
    }
    if (family == 15) {
        for (sl_int i = 0; i < n; i++) {
            LOWER(M, n, i, i) += i < m ? system_scale(state, -8.0, 8.0) : -1e-8;
        }
    }
    if (family == 16) {
        const double alpha = system_scale(state, -8.0, 0.0);
        for (sl_int i = 0; i < m; i++) {
            for (sl_int j = 0; j <= i; j++) {
                LOWER(M, n, i, j) = i == j ? alpha : 0.0;
            }
        }
    }
}

static inline void system_fill_rest(random_system_t *y, double *M, int family, uint64_t *state) {
    const sl_int n = y->n;
    switch (family) {
    case 6:
        system_gauss(M, n, 1.0, state);
        break;
    case 7:
        system_gauss(M, n, pow(10.0, -(double)gen_below(state, 17)), state);
        break;
    case 8:
        system_blocks(M, n, gen_below(state, 2) ? 0.1 : 0.0, state);
        break;
    case 9:
        system_blocks(M, n, 0.0, state);
        system_rescale(M, n, 5.0, state);
        break;
    case 17:
        for (sl_int i = 0; i < n; i++) {
            LOWER(M, n, i, i) = gen_real(state) * system_scale(state, -12.0, 0.0);
            LOWER(M, n, n - 1, i) = gen_real(state);
        }
        break;
    case 18:
        for (sl_int i = 0; i < n; i++) {
            LOWER(M, n, i, i) = gen_real(state) * system_scale(state, -8.0, 0.0);
            if (i > 0) {
                LOWER(M, n, i, i - 1) = gen_real(state);
            }
        }
        break;
    case 19:
        for (sl_int i = 1; i < n; i++) {
            for (int k = 0; k < 2; k++) {
                system_spring(M, n, i, gen_below(state, i), 1.0);
            }
        }
        break;
    case 20:
        system_grid(M, n, 0.0, state);
        break;
    case 21:
        system_gauss(M, n, pow(10.0, -(double)gen_below(state, 8)), state);
        system_rescale(M, n, 5.0, state);
        break;
    case 22:
        for (sl_int i = 0; i < n; i++) {
            for (sl_int j = 0; j < i; j++) {
                LOWER(M, n, i, j) = gen_below(state, n) < 3 ? gen_real(state) : 0.0;
            }
            LOWER(M, n, i, i) = gen_below(state, 4) == 0 ? gen_real(state) : 0.0;
        }
        break;
    default: /* [H B'; B B H^-1 B' + e], H diagonal: the Schur complement is e and rounding */
        for (sl_int i = 0; i < n / 2; i++) {
            LOWER(M, n, i, i) = (i % 2 == 0 ? 1.0 : -1.0) * (1.0 + fabs(gen_real(state)));
            for (int k = 0; k < 2; k++) {
                LOWER(M, n, n / 2 + gen_below(state, n - n / 2), i) = gen_real(state);
            }
        }
        for (sl_int i = n / 2; i < n; i++) {
            for (sl_int j = n / 2; j <= i; j++) {
                for (sl_int k = 0; k < n / 2; k++) {
                    LOWER(M, n, i, j) += LOWER(M, n, i, k) * LOWER(M, n, j, k) / LOWER(M, n, k, k);
                }
            }
            LOWER(M, n, i, i) += gen_real(state) * system_scale(state, -16.0, 0.0);
            for (sl_int j = n / 2; j < i; j++) {
                LOWER(M, n, i, j) += gen_below(state, 3) == 0 ? gen_real(state) : 0.0;
            }
        }
    }
    if (family == 19 || family == 20) {
        const double shift = gen_below(state, 3) == 0 ? 4.0 : 8.0 * fabs(gen_real(state));
        for (sl_int i = 0; i < n; i++) {
            LOWER(M, n, i, i) -= shift;
        }
    }
}

static inline random_system_t random_system(int family, uint64_t seed) {
    uint64_t state = seed * 1000 + (uint64_t)family;
    random_system_t y;
    memset(&y, 0, sizeof y);
    y.n = family == 3 ? 2 + gen_below(&state, 11) : 2 + gen_below(&state, 40);
    if (seed % 16 == 0 && family != 3) {
        y.n = 100 + gen_below(&state, 60);
    }
    if (family == 5) { /* all rows are in the grid: the one spring to the ground is what is weak */
        sl_int side = (sl_int)sqrt((double)y.n + 0.5);
        y.n = side * side;
    }
    const size_t n = (size_t)y.n;
    double *M = test_reals(n * n);
    gen_list_t t = gen_list(y.n);
    if (family < 6) {
        system_fill_definite(&y, M, family, &state);
    } else if (family >= 10 && family <= 16) {
        system_fill_kkt(&y, M, family, &state);
    } else {
        system_fill_rest(&y, M, family, &state);
    }
    for (sl_int i = 0; i < y.n; i++) {
        for (sl_int j = 0; j <= i; j++) {
            if (LOWER(M, n, i, j) != 0.0 || i == j) {
                gen_add(&t, i, j, LOWER(M, n, i, j));
            }
        }
    }
    y.M = gen_store(&t, gen_style((int)gen_below(&state, 3)), seed);
    gen_list_free(&t);
    free(M);
    y.b = test_reals(n);
    gen_reals(y.b, n, gen_bits(&state));
    return y;
}

static inline void random_system_free(random_system_t *y) {
    gen_matrix_free(&y->M);
    free(y->b);
    free(y->signs);
}

#undef LOWER

#endif

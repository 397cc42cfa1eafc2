/* pivoted.h: indefinite systems that need 2x2 pivots, and checks of their factors and solves */
#ifndef SL_TEST_PIVOTED_H
#define SL_TEST_PIVOTED_H

#include "dense_eigen.h"
#include "dense_reference.h"
#include "factored.h"
#include "local_solve.h"

typedef enum system_kind_t {
    SYSTEM_RANDOM,     /* random entries, diagonal included */
    SYSTEM_TINY,       /* the same with a diagonal of size 1e-12 */
    SYSTEM_HOLLOW,     /* no diagonal entry at all */
    SYSTEM_KKT,        /* [H B'; B 0] with an indefinite H */
    SYSTEM_KKT_HOLLOW, /* the same, and every other diagonal entry of H is 0 */
    SYSTEM_SHIFTED,    /* the Laplacian of a grid minus a shift inside its spectrum */
    SYSTEM_KINDS
} system_kind_t;

/* The Laplacian of a grid of m rows, minus a shift. */
static inline void system_shifted_grid(gen_list_t *t, sl_int m, double shift, uint64_t *state) {
    sl_int width = 1;
    while ((width + 1) * (width + 1) <= m) {
        width++;
    }
    for (sl_int k = 0; k < m; k++) {
        gen_add(t, k, k, 4.0 - shift + 0.125 * gen_real(state));
        if (k % width > 0) {
            gen_add(t, k, k - 1, -1.0);
        }
        if (k >= width) {
            gen_add(t, k, k - width, -1.0);
        }
    }
}

static inline gen_list_t system_list(system_kind_t kind, sl_int n, uint64_t seed) {
    gen_list_t t = gen_list(n);
    const int is_kkt = kind == SYSTEM_KKT || kind == SYSTEM_KKT_HOLLOW;
    const sl_int m = is_kkt ? n - n / 3 : n;
    if (kind == SYSTEM_SHIFTED) {
        system_shifted_grid(&t, n, 2.7, &seed);
        return t;
    }
    for (sl_int k = 0; k < m; k++) { /* a ring keeps the structure regular */
        double d = kind == SYSTEM_TINY ? 1e-12 * gen_real(&seed) : gen_real(&seed);
        if (kind != SYSTEM_HOLLOW && !(kind == SYSTEM_KKT_HOLLOW && k % 2)) {
            gen_add(&t, k, k, d);
        }
        if (k > 0) {
            gen_add(&t, k, k - 1, 1.0 + gen_real(&seed));
        }
        if (k > 3) {
            gen_add(&t, k, gen_below(&seed, k - 2), gen_real(&seed));
        }
    }
    for (sl_int k = m; k < n; k++) { /* each constraint has a row of its own */
        gen_add(&t, k, 2 * (k - m), 1.0 + 0.5 * gen_real(&seed));
        gen_add(&t, k, 2 * (k - m) + 1, gen_real(&seed));
    }
    return t;
}

static inline gen_matrix_t system_make(system_kind_t kind, sl_int n, int style, uint64_t seed) {
    gen_list_t t = system_list(kind, n, seed);
    gen_matrix_t M = gen_store(&t, gen_style(style), seed);
    gen_list_free(&t);
    return M;
}

/* The block diagonal matrix D, dense. */
static inline double *dense_d(const sl_factor *F) {
    sl_factor_arrays f = sl_factor_view(F);
    sl_symbolic_arrays v = sl_symbolic_view(f.symbolic);
    sl_int n = v.n;
    double *D = test_reals((size_t)n * (size_t)n);
    for (sl_int k = 0; k < n; k++) {
        AT(D, k, k) = f.D[k];
        if (f.E && v.pairs[k] == 1) {
            AT(D, k, k + 1) = AT(D, k + 1, k) = f.E[k];
        }
    }
    return D;
}

/* NULL, or what is wrong with the pairs of an analysis: each is in one supernode and one tile. */
static const char *check_pairs(const sl_symbolic *S, sl_int wanted) {
    sl_symbolic_arrays v = sl_symbolic_view(S);
    sl_int count = 0;
    for (sl_int k = 0; v.pairs && k < v.n; k++) {
        sl_int local = k - v.super_first[v.super_of[k]];
        if (v.pairs[k] == 1) {
            count++;
            if (k + 1 == v.n || v.pairs[k + 1] != 2 || v.super_of[k + 1] != v.super_of[k]) {
                return "a pair is in two supernodes";
            }
            if (local % 8 == 7) {
                return "a pair is in two tiles";
            }
        } else if (v.pairs[k] == 2 && (k == 0 || v.pairs[k - 1] != 1)) {
            return "the second of a pair without the first";
        }
    }
    return count != wanted ? "the number of pairs is wrong" : check_supernodes(&v);
}

/* NULL, or a message if |P A P' - L D L'| > c n eps |L| |D| |L'| in some entry, or an entry of L
 * exceeds the bound of the threshold. */
static const char *check_blocks(const sl_factor *F, const sl_csc *A) {
    sl_symbolic_arrays v = sl_symbolic_view(sl_factor_view(F).symbolic);
    sl_int n = v.n;
    const char *wrong = NULL;
    double *M = ref_dense(A), *C = ref_permute(n, M, v.perm), *L = check_expand(F, &wrong);
    double *D = dense_d(F);
    for (sl_int j = 0; j < n && !wrong; j++) {
        for (sl_int i = j; i < n && !wrong; i++) {
            double sum = 0.0, size = 0.0;
            for (sl_int k = 0; k <= j; k++) {
                for (sl_int m = k > 0 ? k - 1 : 0; m <= k + 1 && m < n; m++) {
                    double term = AT(L, i, m) * AT(D, m, k) * AT(L, j, k);
                    sum += term;
                    size += fabs(term);
                }
            }
            if (!(fabs(AT(C, i, j) - sum) <= 8.0 * (double)n * DBL_EPSILON * size)) {
                wrong = "L D L' is not P A P'";
            }
            if (!(fabs(AT(L, i, j)) <= 101.0)) {
                wrong = "an entry of L is too large";
            }
        }
    }
    free(M);
    free(C);
    free(L);
    free(D);
    return wrong;
}

/* After at most two corrections the backward error is that of a stable solver. */
static inline void check_solves(const sl_factor *F, const sl_csc *A) {
    size_t n = (size_t)A->n_cols;
    enum { NRHS = 9 };
    double *B = test_reals(n * NRHS), *X = test_reals(n * NRHS);
    sl_stats stats;
    gen_reals(B, n * NRHS, 7);
    SL_CHECK(sl_factor_solve(F, X, n, B, n, NRHS, NULL));
    SL_CHECK(sl_factor_refine(F, A, X, n, B, n, NRHS, 2, NULL, &stats));
    if (!(stats.refine.backward_error <= 4.0 * DBL_EPSILON)) {
        print_error("backward error %g after %d corrections\n", stats.refine.backward_error,
                    (int)stats.refine.steps);
        fail();
    }
    free(B);
    free(X);
}

static inline void check_local(const sl_symbolic *S, const sl_factor *F, sl_int n) {
    static const sl_int counts[5][2] = {{1, 1}, {2, 3}, {3, -1}, {-1, 2}, {-1, -1}};
    static const sl_int nrhs[4] = {1, 2, 4, 13};
    for (int c = 0; c < 5; c++) {
        for (int r = 0; r < 4; r++) {
            local_solve_t q = local_solve_random(F, n, counts[c][0], counts[c][1], nrhs[r],
                                                 (uint64_t)(10 * c + r));
            local_solve_check(S, F, &q, NULL);
            local_solve_free(&q);
        }
    }
}

#endif

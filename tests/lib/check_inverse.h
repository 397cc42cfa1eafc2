/* check_inverse.h: the dense inverse, rounding bounds, and a check of a selected inverse */
#ifndef SL_TEST_CHECK_INVERSE_H
#define SL_TEST_CHECK_INVERSE_H

#include "factored.h"

/* Rounding bound on entry (i, j) of the inverse: BOUND_C n eps (|Z| |L| |D| |L'| |Z|)_ij, from
 * [Higham, Accuracy and Stability, 10 and 14] for an inverse computed from a factorization. It is
 * invariant under row scaling. c = 4 as in check_product; it includes the errors of the dense
 * reference. */
#define BOUND_C 4.0

/* C = A B, all n x n. */
static inline double *dense_product(sl_int n, const double *A, const double *B) {
    double *C = test_reals((size_t)n * (size_t)n);
    for (sl_int j = 0; j < n; j++) {
        for (sl_int k = 0; k < n; k++) {
            for (sl_int i = 0; i < n; i++) {
                AT(C, i, j) += AT(A, i, k) * AT(B, k, j);
            }
        }
    }
    return C;
}

/* In pivot order: the inverse, and the rounding bound of each of its entries. */
typedef struct reference_t {
    double *Z, *bound;
} reference_t;

static inline reference_t reference_make(const sl_csc *A, const sl_factor *F) {
    sl_factor_arrays f = sl_factor_view(F);
    sl_symbolic_arrays v = sl_symbolic_view(f.symbolic);
    const char *wrong = NULL;
    sl_int n = v.n;
    size_t size = (size_t)n * (size_t)n;
    double *M = ref_dense(A), *C = ref_permute(n, M, v.perm), *L = check_expand(F, &wrong);
    double *R = test_reals(size), *S = test_reals(size);
    reference_t r = {ref_scaled_inverse(n, C), NULL};
    NOTHING_WRONG(wrong);
    for (sl_int j = 0; j < n; j++) {
        for (sl_int i = 0; i < n; i++) { /* R = |L| |D|^(1/2), S = |Z| */
            AT(R, i, j) = fabs(AT(L, i, j)) * sqrt(fabs(f.D[j]));
            AT(S, i, j) = fabs(AT(r.Z, i, j));
        }
    }
    double *T = dense_product(n, S, R), *U = test_reals(size);
    for (sl_int j = 0; j < n; j++) {
        for (sl_int i = 0; i < n; i++) {
            AT(U, i, j) = AT(T, j, i);
        }
    }
    r.bound = dense_product(n, T, U);
    for (size_t k = 0; k < size; k++) {
        r.bound[k] *= BOUND_C * (double)n * DBL_EPSILON;
    }
    free(M);
    free(C);
    free(L);
    free(R);
    free(S);
    free(T);
    free(U);
    return r;
}

static inline void reference_free(reference_t *r) {
    free(r->Z);
    free(r->bound);
}

/* NULL, or what is wrong with the values of Z; reads every entry of every panel. */
static inline const char *check_selected(const sl_selected *Z, const reference_t *r) {
    sl_selected_arrays z = sl_selected_view(Z);
    sl_symbolic_arrays v = sl_symbolic_view(z.symbolic);
    sl_int n = v.n;
    for (sl_int k = 0; k < z.count; k++) {
        sl_int s = z.supers[k], width = ref_width(&v, s), height = ref_height(&v, s);
        const sl_off size = ref_panel_size(width, height), room = z.begin[k + 1] - z.begin[k];
        if (room < size || room >= size + 8 || (width > 1 && room != size)) {
            return "wrong panel size";
        }
        for (sl_off at = size; at < room; at++) {
            if (z.Z[z.begin[k] + at] != 0.0) {
                return "a number between two panels is not 0";
            }
        }
        for (sl_int c = 0; c < width; c++) {
            for (sl_int q = c; q < (width == 1 ? height : (height + 7) / 8 * 8); q++) {
                double value = z.Z[z.begin[k] + ref_position(width, q, c)];
                if (q >= height) {
                    if (value != 0.0) {
                        return "padding is not 0";
                    }
                    continue;
                }
                sl_int i = ref_row(&v, s, q), j = v.super_first[s] + c;
                if (!(fabs(value - AT(r->Z, i, j)) <= AT(r->bound, i, j))) {
                    return i == j ? "a diagonal entry is off" : "an entry is off";
                }
            }
        }
    }
    return NULL;
}

static inline void random_rows(sl_int *rows, sl_int count, sl_int n, uint64_t *seed) {
    for (sl_int k = 0; k < count; k++) {
        rows[k] = gen_below(seed, n);
    }
}

#endif

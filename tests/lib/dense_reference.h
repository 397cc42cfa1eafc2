/* dense_reference.h: dense LDL', solve, inverse, tree, fill and reach, written to be obvious */
#ifndef SL_TEST_DENSE_REFERENCE_H
#define SL_TEST_DENSE_REFERENCE_H

#include "test.h"

/* Dense matrices are n x n, column-major, leading dimension n. */
#define AT(M, i, j) ((M)[(size_t)(i) + (size_t)n * (size_t)(j)])

/* The full symmetric matrix that A represents: duplicates are summed; if there is an entry below
 * the diagonal, those above it are not read. */
static inline double *ref_dense(const sl_csc *A) {
    sl_int n = A->n_rows;
    double *M = test_reals((size_t)n * (size_t)n);
    int lower = 0;
    for (sl_int j = 0; j < n; j++) {
        for (sl_int p = A->p[j]; p < A->p[j + 1]; p++) {
            lower = lower || A->i[p] > j;
        }
    }
    for (sl_int j = 0; j < n; j++) {
        for (sl_int p = A->p[j]; p < A->p[j + 1]; p++) {
            sl_int i = A->i[p];
            if (i == j) {
                AT(M, i, j) += A->x[p];
            } else if (lower ? i > j : i < j) {
                AT(M, i, j) += A->x[p];
                AT(M, j, i) += A->x[p];
            }
        }
    }
    return M;
}

/* The symmetric pattern of A: 1 where an entry is stored and on the diagonal. */
static inline char *ref_pattern(const sl_csc *A) {
    sl_int n = A->n_rows;
    char *M = (char *)test_array((size_t)n * (size_t)n, 1);
    for (sl_int j = 0; j < n; j++) {
        AT(M, j, j) = 1;
        for (sl_int p = A->p[j]; p < A->p[j + 1]; p++) {
            AT(M, A->i[p], j) = AT(M, j, A->i[p]) = 1;
        }
    }
    return M;
}

/* C(k, l) = M(perm[k], perm[l]) */
static inline double *ref_permute(sl_int n, const double *M, const sl_int *perm) {
    double *C = test_reals((size_t)n * (size_t)n);
    for (sl_int l = 0; l < n; l++) {
        for (sl_int k = 0; k < n; k++) {
            AT(C, k, l) = AT(M, perm[k], perm[l]);
        }
    }
    return C;
}

static inline char *ref_permute_pattern(sl_int n, const char *M, const sl_int *perm) {
    char *C = (char *)test_array((size_t)n * (size_t)n, 1);
    for (sl_int l = 0; l < n; l++) {
        for (sl_int k = 0; k < n; k++) {
            AT(C, k, l) = AT(M, perm[k], perm[l]);
        }
    }
    return C;
}

/* M = L D L' by the definition, column by column, without pivoting. L is unit lower triangular; D
 * has n entries. */
static inline void ref_ldl(sl_int n, const double *M, double *L, double *D) {
    for (sl_int j = 0; j < n; j++) {
        D[j] = AT(M, j, j);
        for (sl_int k = 0; k < j; k++) {
            D[j] -= AT(L, j, k) * D[k] * AT(L, j, k);
        }
        AT(L, j, j) = 1.0;
        for (sl_int i = j + 1; i < n; i++) {
            double sum = AT(M, i, j);
            for (sl_int k = 0; k < j; k++) {
                sum -= AT(L, i, k) * D[k] * AT(L, j, k);
            }
            AT(L, i, j) = sum / D[j];
        }
    }
}

/* B := M^-1 B, nrhs columns, by Gaussian elimination with partial pivoting; shares nothing with
 * LDL'. */
static inline void ref_solve(sl_int n, const double *M, double *B, sl_int nrhs) {
    double *U = test_reals((size_t)n * (size_t)n);
    memcpy(U, M, (size_t)n * (size_t)n * sizeof *U);
    for (sl_int k = 0; k < n; k++) {
        sl_int best = k;
        for (sl_int i = k + 1; i < n; i++) {
            best = fabs(AT(U, i, k)) > fabs(AT(U, best, k)) ? i : best;
        }
        for (sl_int j = 0; j < n; j++) {
            double keep = AT(U, k, j);
            AT(U, k, j) = AT(U, best, j);
            AT(U, best, j) = keep;
        }
        for (sl_int r = 0; r < nrhs; r++) {
            double keep = AT(B, k, r);
            AT(B, k, r) = AT(B, best, r);
            AT(B, best, r) = keep;
        }
        for (sl_int i = k + 1; i < n; i++) {
            double f = AT(U, i, k) / AT(U, k, k);
            for (sl_int j = k; j < n; j++) {
                AT(U, i, j) -= f * AT(U, k, j);
            }
            for (sl_int r = 0; r < nrhs; r++) {
                AT(B, i, r) -= f * AT(B, k, r);
            }
        }
    }
    for (sl_int r = 0; r < nrhs; r++) {
        for (sl_int k = n; k-- > 0;) {
            for (sl_int j = k + 1; j < n; j++) {
                AT(B, k, r) -= AT(U, k, j) * AT(B, j, r);
            }
            AT(B, k, r) /= AT(U, k, k);
        }
    }
    free(U);
}

static inline double *ref_inverse(sl_int n, const double *M) {
    double *Z = test_reals((size_t)n * (size_t)n);
    for (sl_int k = 0; k < n; k++) {
        AT(Z, k, k) = 1.0;
    }
    ref_solve(n, M, Z, n);
    return Z;
}

/* The inverse of M, computed with rows and columns scaled by powers of 2 that bring the diagonal
 * near 1. Without scaling, the reference itself would be inaccurate for a badly scaled matrix. */
static inline double *ref_scaled_inverse(sl_int n, const double *M) {
    double *C = test_reals((size_t)n * (size_t)n), *Z;
    int *power = (int *)test_array((size_t)n, sizeof(int));
    for (sl_int k = 0; k < n; k++) {
        (void)frexp(AT(M, k, k), &power[k]);
        power[k] = -power[k] / 2;
    }
    for (sl_int k = 0; k < n * n; k++) {
        C[k] = ldexp(M[k], power[k % n] + power[k / n]);
    }
    Z = ref_inverse(n, C);
    for (sl_int k = 0; k < n * n; k++) {
        Z[k] = ldexp(Z[k], power[k % n] + power[k / n]);
    }
    free(power);
    free(C);
    return Z;
}

/* ||M|| ||M^-1|| in the 1-norm. */
static inline double ref_condition(sl_int n, const double *M) {
    double *Z = ref_inverse(n, M), norm = 0.0, inverse = 0.0;
    for (sl_int j = 0; j < n; j++) {
        double a = 0.0, z = 0.0;
        for (sl_int i = 0; i < n; i++) {
            a += fabs(AT(M, i, j));
            z += fabs(AT(Z, i, j));
        }
        norm = fmax(norm, a);
        inverse = fmax(inverse, z);
    }
    free(Z);
    return norm * inverse;
}

/* Replaces a symmetric pattern by the pattern of L + L', by elimination. */
static inline void ref_fill(sl_int n, char *M) {
    for (sl_int k = 0; k < n; k++) {
        for (sl_int j = k + 1; j < n; j++) {
            for (sl_int i = j; i < n; i++) {
                if (AT(M, i, k) && AT(M, j, k)) {
                    AT(M, i, j) = AT(M, j, i) = 1;
                }
            }
        }
    }
}

/* parent[k]: the first row below the diagonal in column k of the filled pattern, -1 if there is
 * none */
static inline void ref_etree(sl_int n, const char *fill, sl_int *parent) {
    for (sl_int k = 0; k < n; k++) {
        parent[k] = -1;
        for (sl_int i = n; i-- > k + 1;) {
            parent[k] = AT(fill, i, k) ? i : parent[k];
        }
    }
}

static inline void ref_counts(sl_int n, const char *fill, sl_int *counts) {
    for (sl_int k = 0; k < n; k++) {
        counts[k] = 0;
        for (sl_int i = k; i < n; i++) {
            counts[k] += AT(fill, i, k) ? 1 : 0;
        }
    }
}

/* Marks the columns that can be reached from column k along entries of L: seen[k] = 1. This is the
 * definition of Gilbert and Peierls; it does not use the elimination tree. */
static inline void ref_reach_from(sl_int n, const char *fill, sl_int k, char *seen) {
    if (seen[k]) {
        return;
    }
    seen[k] = 1;
    for (sl_int i = k + 1; i < n; i++) {
        if (AT(fill, i, k)) {
            ref_reach_from(n, fill, i, seen);
        }
    }
}

/* ---- the library's storage of L ---- */

static inline sl_int ref_width(const sl_symbolic_arrays *v, sl_int s) {
    return v->super_first[s + 1] - v->super_first[s];
}

static inline sl_int ref_height(const sl_symbolic_arrays *v, sl_int s) {
    return ref_width(v, s) + (sl_int)(v->rows_begin[s + 1] - v->rows_begin[s]);
}

/* Row of L that is local row r of supernode s. */
static inline sl_int ref_row(const sl_symbolic_arrays *v, sl_int s, sl_int r) {
    sl_int width = ref_width(v, s);
    return r < width ? v->super_first[s] + r : v->rows[v->rows_begin[s] + (r - width)];
}

/* Doubles of a panel: tiles of 8 rows; tile t has the columns 0 .. min(width, 8(t+1)) - 1. One
 * column has no padding. */
static inline sl_off ref_panel_size(sl_int width, sl_int height) {
    sl_off size = 0;
    if (width == 1) {
        return height;
    }
    for (sl_int t = 0; 8 * t < height; t++) {
        size += 8 * (sl_off)(width < 8 * (t + 1) ? width : 8 * (t + 1));
    }
    return size;
}

/* Where a panel begins after others that end at `end`. */
static inline sl_off ref_panel_start(sl_int width, sl_off end) {
    return width == 1 ? end : (end + 7) / 8 * 8;
}

/* Position of local row r, local column c in a panel, or -1 if the trapezoid does not store it. */
static inline sl_off ref_position(sl_int width, sl_int r, sl_int c) {
    sl_int columns = width < 8 * (r / 8 + 1) ? width : 8 * (r / 8 + 1);
    return c < columns ? ref_panel_size(width, r / 8 * 8) + 8 * (sl_off)c + r % 8 : -1;
}

#endif

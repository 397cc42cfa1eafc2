/* kkt.h: saddle-point systems with linearly dependent constraints */
#ifndef SL_TEST_KKT_H
#define SL_TEST_KKT_H

#include "check_factor.h"

/* A = [H B'; B 0] with its analysis. */
typedef struct kkt_t {
    gen_matrix_t M;
    sl_int n, primal;
    sl_int *signs; /* n: 1 for primal rows, -1 for constraints */
    sl_symbolic *S;
} kkt_t;

/* H is definite, on two thirds of the rows. Each constraint has three entries and a zero diagonal.
 * The last `twice` constraints repeat the first ones, so that A has rank n - twice. */
static inline kkt_t kkt_make(sl_int n, sl_int twice, sl_ordering ordering) {
    kkt_t y;
    uint64_t seed = 77;
    gen_list_t t = gen_list(n), H = gen_list(n - n / 3);
    sl_options opt = options_none();
    memset(&y, 0, sizeof y);
    y.n = n;
    y.primal = H.n;
    y.signs = test_ints((size_t)n);
    gen_edges_random(&H, 3000 / H.n, &seed);
    gen_dominate(&H, 1, &seed);
    for (size_t k = 0; k < H.count; k++) {
        gen_add(&t, H.row[k], H.col[k], H.x[k]);
    }
    gen_list_free(&H);
    for (sl_int k = 0; k < n; k++) {
        y.signs[k] = k < y.primal ? 1 : -1;
    }
    for (sl_int k = y.primal; k < n; k++) {
        /* the constraint that this one repeats, or itself */
        sl_int like = k < n - twice ? k : k - (n - twice) + y.primal;
        uint64_t own = 1000u + (uint64_t)like;
        for (sl_int step = 0, j = gen_below(&own, y.primal / 3); step < 3; step++) {
            gen_add(&t, k, j, 0.5 + gen_real(&own) / 3.0);
            j += 1 + gen_below(&own, y.primal / 4);
        }
        gen_add(&t, k, k, 0.0);
    }
    y.M = gen_store(&t, gen_style(0), 1);
    gen_list_free(&t);
    opt.ordering = ordering;
    SL_CHECK(sl_symbolic_create(&y.S, &y.M.view, &opt, NULL));
    return y;
}

static inline void kkt_free(kkt_t *y) {
    sl_symbolic_free(y->S);
    gen_matrix_free(&y->M);
    free(y->signs);
}

/* B := A Z for random Z: right-hand sides that are consistent whatever the rank. */
static inline void kkt_consistent(const kkt_t *y, double *B, sl_int nrhs, uint64_t seed) {
    size_t n = (size_t)y->n;
    double *Z = test_reals(n * (size_t)nrhs);
    gen_reals(Z, n * (size_t)nrhs, seed);
    SL_CHECK(sl_csc_multiply(&y->M.view, SL_AS_SYMMETRIC, B, n, Z, n, nrhs));
    free(Z);
}

/* NULL, or a message if L D L' differs in some entry from P (A + E) P', where E is the diagonal
 * shift that the factor reports. */
static inline const char *check_regularized(const sl_factor *F, const sl_csc *A) {
    sl_factor_arrays f = sl_factor_view(F);
    sl_symbolic_arrays v = sl_symbolic_view(f.symbolic);
    sl_int n = v.n, count = 0, *rows = test_ints((size_t)n);
    double *shifts = test_reals((size_t)n), *M = ref_dense(A), *size = test_reals((size_t)n);
    const char *wrong = NULL;
    SL_CHECK(sl_factor_pivot_rows(F, SL_PIVOT_REGULARIZED, rows, shifts, n, &count));
    for (sl_int k = 0; k < count; k++) {
        size[rows[k]] = fabs(AT(M, rows[k], rows[k])) + fabs(shifts[k]);
    }
    /* The diagonal is checked here, with A and E kept apart because they may cancel; check_product
     * checks the entries off the diagonal. */
    double *C = ref_permute(n, M, v.perm), *L = check_expand(F, &wrong);
    for (sl_int j = 0, at = 0; j < n && !wrong; j++) {
        double sum = 0.0, total = size[v.perm[j]], shift = 0.0;
        if (at < count && rows[at] == v.perm[j]) {
            shift = shifts[at++];
            wrong = shift == 0.0 ? "a regularized row without a shift" : wrong;
        }
        for (sl_int k = 0; k <= j; k++) {
            double term = AT(L, j, k) * f.D[k] * AT(L, j, k);
            sum += term;
            total += fabs(term);
        }
        if (!(fabs(AT(C, j, j) + shift - sum) <= 4.0 * (double)n * DBL_EPSILON * total)) {
            wrong = "L D L' is not A + E on the diagonal";
        }
        AT(C, j, j) = sum;
    }
    wrong = wrong ? wrong : check_product(n, C, L, f.D);
    free(rows);
    free(shifts);
    free(size);
    free(M);
    free(C);
    free(L);
    return wrong;
}

#endif

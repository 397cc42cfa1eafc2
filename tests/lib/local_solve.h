/* local_solve.h: random local solves, compared bit for bit with the full solve */
#ifndef SL_TEST_LOCAL_SOLVE_H
#define SL_TEST_LOCAL_SOLVE_H

#include "gen_matrices.h"

/* A local solve: its sets (NULL: all rows), right-hand sides, and the rows of the full solution. */
typedef struct local_solve_t {
    sl_int nb, nx, nrhs;
    sl_int *bset, *xset;
    double *B;      /* nb x nrhs, leading dimension nb + 2 */
    double *wanted; /* nx x nrhs, leading dimension nx */
} local_solve_t;

static inline sl_int *question_set(const sl_int *set, sl_int count) {
    sl_int *copy = set ? test_ints((size_t)count) : NULL;
    if (set && count > 0) {
        memcpy(copy, set, (size_t)count * sizeof *copy);
    }
    return copy;
}

/* A random B on bset, the solution wanted on xset; NULL means all rows. */
static inline local_solve_t local_solve_make(const sl_factor *F, const sl_int *bset, sl_int nb,
                                             const sl_int *xset, sl_int nx, sl_int nrhs,
                                             uint64_t seed) {
    sl_int n = sl_symbolic_view(sl_factor_view(F).symbolic).n;
    local_solve_t q = {bset ? nb : n, xset ? nx : n, nrhs, NULL, NULL, NULL, NULL};
    size_t cols = (size_t)nrhs, rows = (size_t)n, ldb = (size_t)q.nb + 2;
    double *full = test_reals(rows * cols);
    q.bset = question_set(bset, nb);
    q.xset = question_set(xset, nx);
    q.B = test_reals(ldb * cols);
    q.wanted = test_reals((size_t)q.nx * cols);
    gen_reals(q.B, ldb * cols, seed);
    for (size_t r = 0; r < cols; r++) {
        for (sl_int k = 0; k < q.nb; k++) {
            full[(size_t)(bset ? bset[k] : k) + r * rows] = q.B[(size_t)k + r * ldb];
        }
    }
    SL_CHECK(sl_factor_solve(F, full, rows ? rows : 1, full, rows ? rows : 1, nrhs, NULL));
    for (size_t r = 0; r < cols; r++) {
        for (sl_int k = 0; k < q.nx; k++) {
            q.wanted[(size_t)k + r * (size_t)q.nx] = full[(size_t)(xset ? xset[k] : k) + r * rows];
        }
    }
    free(full);
    return q;
}

/* The same for random sets of nb and nx of the n rows; -1: all rows. */
static inline local_solve_t local_solve_random(const sl_factor *F, sl_int n, sl_int nb, sl_int nx,
                                               sl_int nrhs, uint64_t seed) {
    sl_int *bset = nb < 0 ? NULL : test_ints((size_t)n);
    sl_int *xset = nx < 0 ? NULL : test_ints((size_t)n);
    if (bset) {
        gen_set(bset, nb, n, seed + 1);
    }
    if (xset) {
        gen_set(xset, nx, n, seed + 2);
    }
    local_solve_t q = local_solve_make(F, bset, nb, xset, nx, nrhs, seed);
    free(bset);
    free(xset);
    return q;
}

static inline void local_solve_free(local_solve_t *q) {
    free(q->bset);
    free(q->xset);
    free(q->B);
    free(q->wanted);
}

/* Solves with a plan and with sl_local_solve. Both give the bits of the full solve, write nothing
 * beside X, and report the same reach. */
static inline void local_solve_check(const sl_symbolic *S, const sl_factor *F,
                                     const local_solve_t *q, sl_work *W) {
    size_t ldx = (size_t)q->nx + 3, ldb = (size_t)q->nb + 2, total = ldx * (size_t)(q->nrhs + 1);
    double *X = test_reals(total);
    sl_plan *P = NULL;
    sl_stats planned, shot;
    memset(&planned, 0, sizeof planned);
    memset(&shot, 0, sizeof shot);
    SL_CHECK(sl_plan_create(&P, S, q->bset, q->nb, q->xset, q->nx, NULL, &planned));
    for (int one_call = 0; one_call < 2; one_call++) {
        for (size_t k = 0; k < total; k++) {
            X[k] = 4321.5;
        }
        if (!one_call) {
            SL_CHECK(sl_plan_solve(P, F, X, ldx, q->B, ldb, q->nrhs, W));
        } else {
            SL_CHECK(sl_local_solve(F, q->bset, q->nb, q->xset, q->nx, X, ldx, q->B, ldb, q->nrhs,
                                    W, &shot));
        }
        for (size_t r = 0; r < (size_t)q->nrhs; r++) {
            SAME_VALUES(X + r * ldx, q->wanted + r * (size_t)q->nx, (size_t)q->nx);
        }
        for (size_t k = 0; k < total; k++) {
            if (k / ldx >= (size_t)q->nrhs || k % ldx >= (size_t)q->nx) {
                assert_true(X[k] == 4321.5);
            }
        }
    }
    assert_int_equal(planned.plan.b_supernodes, shot.plan.b_supernodes);
    assert_int_equal(planned.plan.b_columns, shot.plan.b_columns);
    assert_int_equal(planned.plan.b_entries, shot.plan.b_entries);
    assert_int_equal(planned.plan.x_supernodes, shot.plan.x_supernodes);
    assert_int_equal(planned.plan.x_columns, shot.plan.x_columns);
    assert_int_equal(planned.plan.x_entries, shot.plan.x_entries);
    sl_plan_free(P);
    free(X);
}

#endif

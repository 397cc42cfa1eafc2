/* check_region.h: checks of the rows and invariants of a region, and of solves in it */
#ifndef SL_TEST_CHECK_REGION_H
#define SL_TEST_CHECK_REGION_H

#include "factored.h"

/* For each column of L: 1 in a subtree, 2 in the boundary; the sum where they overlap. */
static inline char *region_marks(const sl_region *R) {
    sl_region_arrays r = sl_region_view(R);
    sl_symbolic_arrays v = sl_symbolic_view(r.symbolic);
    char *mark = (char *)test_array((size_t)v.n, 1);
    /* top-down from each root */
    for (sl_int k = 0; k < r.n_roots; k++) {
        char *in = (char *)test_array((size_t)v.n_supers, 1);
        in[r.roots[k]] = 1;
        for (sl_int s = r.roots[k]; s >= 0; s--) {
            in[s] = (char)(in[s] || (v.super_parent[s] != -1 && v.super_parent[s] <= r.roots[k] &&
                                     in[v.super_parent[s]]));
            for (sl_int c = v.super_first[s]; in[s] && c < v.super_first[s + 1]; c++) {
                mark[c] = (char)(mark[c] + 1);
            }
        }
        free(in);
    }
    for (sl_int k = 0; k < r.n_boundary; k++) {
        mark[v.iperm[r.boundary[k]]] = (char)(mark[v.iperm[r.boundary[k]]] + 2);
    }
    return mark;
}

/* NULL, or the invariant of a region for a set that does not hold. */
static inline const char *check_region(const sl_region *R, const sl_int *set, sl_int count) {
    sl_region_arrays r = sl_region_view(R);
    sl_symbolic_arrays v = sl_symbolic_view(r.symbolic);
    char *mark = region_marks(R);
    const char *wrong = NULL;
    for (sl_int k = 0; k < v.n && !wrong; k++) {
        wrong = mark[k] > 2 ? "subtrees and boundary overlap" : NULL;
    }
    for (sl_int k = 0; k < count && !wrong; k++) {
        wrong = !mark[v.iperm[set[k]]] ? "a row of the set is outside" : NULL;
    }
    for (sl_int k = 1; k < r.n_roots && !wrong; k++) {
        wrong = r.roots[k] <= r.roots[k - 1] ? "roots do not ascend" : NULL;
    }
    for (sl_int s = 0; s < v.n_supers && !wrong; s++) {
        for (sl_off q = v.rows_begin[s]; q < v.rows_begin[s + 1] && !wrong; q++) {
            wrong = mark[v.super_first[s]] == 1 && !mark[v.rows[q]]
                        ? "a row below a subtree is not in the boundary"
                        : NULL;
        }
    }
    free(mark);
    return wrong;
}

/* Collects the rows of A inside the region; returns how many. */
static inline sl_int region_rows(const sl_region *R, sl_int *rows) {
    sl_symbolic_arrays v = sl_symbolic_view(sl_region_view(R).symbolic);
    char *mark = region_marks(R);
    sl_int count = 0;
    for (sl_int k = v.n; k-- > 0;) {
        if (mark[k]) {
            rows[count++] = v.perm[k];
        }
    }
    free(mark);
    return count;
}

/* Error bound of an entry x(i) for each |b(j)|: c n eps times a norm of the inverse around (i, j).
 * For a definite matrix this is sqrt(|Z(i,i) Z(j,j)|), which bounds the terms that the sweeps add;
 * otherwise it is the largest entry. c = 100: PASS_C as for a solve, times 10 for the condition of
 * the generated matrices. */
static inline double region_allowed(sl_int n, const double *Z, sl_int i, sl_int j, double largest) {
    return 10 * pass_figure(n) *
           (largest > 0 ? largest : sqrt(fabs(AT(Z, i, i)) * fabs(AT(Z, j, j))));
}

static inline double region_largest(sl_int n, const double *Z) {
    double largest = 0;
    for (sl_int k = 0; k < n * n; k++) {
        largest = fabs(Z[k]) > largest ? fabs(Z[k]) : largest;
    }
    return largest;
}

/* Solves random right-hand sides on bset in a region, in both layouts, and compares with the dense
 * inverse Z. largest: the largest entry of Z, or 0 if the matrix is definite. The plan must end at
 * the boundary of the region. */
static inline void assert_region_solves(const sl_region *R, const sl_factor *F, sl_int n,
                                        const double *Z, double largest, const sl_int *bset,
                                        sl_int nb, const sl_int *xset, sl_int nx, sl_int nrhs,
                                        uint64_t seed, sl_work *W) {
    const sl_symbolic *S = sl_factor_view(F).symbolic;
    size_t ldb = (size_t)nb + 1, ldx = (size_t)nx + 2, columns = (size_t)nrhs;
    double *B = test_reals(ldb * columns), *X = test_reals(ldx * columns + 1);
    double *across = test_reals((size_t)nb * columns), *out = test_reals((size_t)nx * columns);
    sl_options opt = options_none();
    sl_plan *P = NULL;
    sl_stats stats;
    memset(&stats, 0, sizeof stats);
    opt.region = R;
    gen_reals(B, ldb * columns, seed);
    X[ldx * columns] = 4321.5;
    SL_CHECK(sl_plan_create(&P, S, bset, nb, xset, nx, &opt, &stats));
    assert_int_equal(stats.plan.in_region, 1);
    SL_CHECK(sl_plan_solve(P, F, X, ldx, B, ldb, nrhs, W));
    for (size_t r = 0; r < columns; r++) {
        for (sl_int i = 0; i < nx; i++) {
            double sum = 0, bound = 0;
            for (sl_int j = 0; j < nb; j++) {
                const double b = B[(size_t)j + r * ldb];
                sum += AT(Z, xset[i], bset[j]) * b;
                bound += fabs(b) * region_allowed(n, Z, xset[i], bset[j], largest);
            }
            const double error = fabs(X[(size_t)i + r * ldx] - sum);
            if (!(error <= bound)) {
                print_error("x(%ld) of %ld rows, boundary %ld: error %.3g, allowed %.3g\n",
                            (long)xset[i], (long)n, (long)sl_region_view(R).n_boundary, error,
                            bound);
                fail();
            }
        }
        for (sl_int j = 0; j < nb; j++) {
            across[(size_t)j * columns + r] = B[(size_t)j + r * ldb];
        }
    }
    assert_true(X[ldx * columns] == 4321.5);
    SL_CHECK(sl_plan_solve(P, F, out, SL_ROWS(columns), across, SL_ROWS(columns), nrhs, W));
    for (size_t r = 0; r < columns; r++) {
        for (sl_int i = 0; i < nx; i++) {
            assert_true(out[(size_t)i * columns + r] == X[(size_t)i + r * ldx]);
        }
    }
    sl_plan_free(P);
    free(B);
    free(X);
    free(across);
    free(out);
}

#endif

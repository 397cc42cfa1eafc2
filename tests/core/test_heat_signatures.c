/* test_heat_signatures.c: diagonals of the inverses of M + t L: heat-kernel signatures */
#include "tests/lib/factor_array.h"

#include "tools/mesh/grid.h"
#include "tools/geometry/laplacian.h"

/* Heat-kernel signatures of a mesh by the recipe of the header: M is diagonal, L is stored without
 * its diagonal, several t. */
static void heat_kernel_signatures_conserve_heat(void **state) {
    (void)state;
    enum { TIMES = 4 };
    const double t[TIMES] = {1e-3, 1e-2, 0.1, 1};
    mesh grid;
    assert_true(mesh_grid(&grid, 9, 8, 0.2, 5));
    sl_int n = grid.n_vertices, *p = test_ints((size_t)n + 1), *i = test_ints((size_t)n);
    double *mass = test_reals((size_t)n), *h = test_reals((size_t)n * TIMES), *v[TERMS];
    double c[TERMS * TIMES], before = INFINITY;
    sl_matrix *L = NULL, *U = NULL;
    sl_symbolic *S = NULL;
    sl_factor *F[TIMES];
    laplacian_mass(mass, &grid);
    for (sl_int k = 0; k < n; k++) {
        i[k] = k;
        p[k + 1] = k + 1;
    }
    assert_true(laplacian_cotangent(&L, &grid));
    const sl_csc terms[TERMS] = {{n, n, p, i, mass}, sl_matrix_view(L)};
    SL_CHECK(sl_matrix_sum(&U, NULL, terms, TERMS, NULL, NULL));
    const sl_csc A = sl_matrix_view(U);
    SL_CHECK(sl_symbolic_create(&S, &A, NULL, NULL));
    for (int k = 0; k < TERMS; k++) {
        v[k] = test_reals((size_t)scatter_length(S));
        SL_CHECK(sl_symbolic_scatter(S, v[k], &terms[k], NULL));
    }
    for (int k = 0; k < TIMES; k++) {
        c[TERMS * k] = 1;
        c[TERMS * k + 1] = t[k];
    }
    SL_CHECK(
        sl_factor_create_sums(F, TIMES, S, c, (const double *const *)v, TERMS, NULL, NULL, NULL));
    for (int k = 0; k < TIMES; k++) {
        SL_CHECK(sl_inverse_diagonal(F[k], h + k * n, NULL, SL_ALL, NULL, NULL));
        sl_matrix *system = NULL;
        assert_true(laplacian_system(&system, &grid, t[k]));
        sl_csc view = sl_matrix_view(system);
        double *M = ref_dense(&view), *Z = ref_inverse(n, M), trace = 0;
        for (sl_int row = 0; row < n; row++) {
            double got = h[(size_t)row + (size_t)k * (size_t)n], heat = 0;
            assert_true(fabs(got - AT(Z, row, row)) <= 10 * pass_figure(n) * got);
            for (sl_int other = 0; other < n; other++) { /* heat is conserved */
                heat += AT(Z, row, other) * mass[other];
            }
            assert_true(fabs(heat - 1) <= 100 * pass_figure(n));
            trace += got * mass[row];
        }
        /* sum of 1 / (1 + t lambda) over the eigenvalues; lambda = 0 contributes 1 */
        assert_true(trace > 1 && trace < before);
        before = trace;
        free(M);
        free(Z);
        sl_matrix_free(system);
    }
    free_all(F, TIMES);
    for (int k = 0; k < TERMS; k++) {
        free(v[k]);
    }
    sl_symbolic_free(S);
    sl_matrix_free(U);
    sl_matrix_free(L);
    mesh_free(&grid);
    free(p);
    free(i);
    free(mass);
    free(h);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(heat_kernel_signatures_conserve_heat),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

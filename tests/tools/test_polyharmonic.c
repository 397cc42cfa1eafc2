/* test_polyharmonic.c: sparse products, and k-harmonic systems made of them, against dense ones */
#include "tests/lib/test.h"

#include "tools/mesh/grid.h"
#include "tools/geometry/polyharmonic.h"
#include "tools/geometry/laplacian.h"
#include "tools/matrix/sparse_product.h"
#include "tools/matrix/triplets.h"
#include "tests/lib/dense_reference.h"
#include "tests/lib/transposed.h"

/* The entries as stored: n_rows x n_cols, column-major. */
static double *dense_as_stored(const sl_csc *A) {
    double *M = test_reals((size_t)A->n_rows * (size_t)A->n_cols);
    for (sl_int j = 0; j < A->n_cols; j++) {
        for (sl_int p = A->p[j]; p < A->p[j + 1]; p++) {
            M[(size_t)A->i[p] + (size_t)A->n_rows * (size_t)j] += A->x[p];
        }
    }
    return M;
}

/* C (a x c) = A (a x b) B (b x c), column-major. */
static double *dense_product(const double *A, const double *B, size_t a, size_t b, size_t c) {
    double *C = test_reals(a * c);
    for (size_t j = 0; j < c; j++) {
        for (size_t k = 0; k < b; k++) {
            for (size_t i = 0; i < a; i++) {
                C[i + a * j] += A[i + a * k] * B[k + b * j];
            }
        }
    }
    return C;
}

static sl_matrix *random_matrix(sl_int rows, sl_int cols, int entries, uint64_t seed) {
    triplets list = {0, 0, NULL, NULL, NULL};
    sl_matrix *M = NULL;
    for (int k = 0; k < entries; k++) {
        seed = seed * 6364136223846793005u + 1442695040888963407u;
        const sl_int i = (sl_int)((seed >> 40) % (uint64_t)rows);
        const sl_int j = (sl_int)((seed >> 16) % (uint64_t)cols);
        assert_true(triplets_add(&list, i, j, (double)(seed >> 33) * 0x1p-30 - 1));
    }
    SL_CHECK(triplets_finish(&M, rows, cols, &list, true));
    return M;
}

static void products_match_dense_products(void **state) {
    (void)state;
    static const sl_int sizes[][3] = {{1, 1, 1}, {7, 5, 9}, {20, 30, 10}, {3, 40, 3}, {12, 1, 12}};
    for (size_t s = 0; s < sizeof sizes / sizeof *sizes; s++) {
        const sl_int a = sizes[s][0], b = sizes[s][1], c = sizes[s][2];
        for (int fill = 0; fill < 4; fill++) {
            sl_matrix *MA = random_matrix(a, b, fill * (a + b), s + 1), *MC = NULL;
            sl_matrix *MB = random_matrix(b, c, fill * (b + c), s + 77);
            const sl_csc A = sl_matrix_view(MA), B = sl_matrix_view(MB);
            assert_true(csc_product(&MC, &A, &B));
            const sl_csc C = sl_matrix_view(MC);
            SL_CHECK(sl_csc_check(&C, NULL));
            assert_int_equal(C.n_rows, a);
            assert_int_equal(C.n_cols, c);
            double *DA = dense_as_stored(&A), *DB = dense_as_stored(&B), *DC = dense_as_stored(&C);
            double *wanted = dense_product(DA, DB, (size_t)a, (size_t)b, (size_t)c);
            for (size_t k = 0; k < (size_t)a * (size_t)c; k++) {
                assert_true(fabs(DC[k] - wanted[k]) <= 40 * DBL_EPSILON * (b + 1));
            }
            free(wanted);
            free(DC);
            free(DB);
            free(DA);
            sl_matrix_free(MC);
            sl_matrix_free(MB);
            sl_matrix_free(MA);
        }
    }
}

static void symmetrizing_recovers_the_triangle(void **state) {
    (void)state;
    sl_matrix *lower = NULL, *upper = NULL, *both = NULL, *again = NULL;
    assert_true(grid_laplacian_3d(&lower, 3, 4, 5, 0.5));
    sl_csc A = sl_matrix_view(lower);
    upper = transposed(&A);
    for (int k = 0; k < 3; k++) {
        const sl_csc from = sl_matrix_view(k == 0 ? lower : k == 1 ? upper : both);
        sl_matrix *full = NULL;
        assert_true(csc_expand_symmetric(&full, &from));
        const sl_csc F = sl_matrix_view(full);
        assert_int_equal(F.p[60], 2 * A.p[60] - 60);
        assert_true(csc_symmetric_part(&again, &F));
        const sl_csc B = sl_matrix_view(again);
        assert_memory_equal(A.p, B.p, 61 * sizeof *A.p);
        assert_memory_equal(A.i, B.i, (size_t)A.p[60] * sizeof *A.i);
        SAME_VALUES(A.x, B.x, (size_t)A.p[60]);
        sl_matrix_free(again);
        sl_matrix_free(both);
        both = full;
    }
    sl_matrix_free(both);
    sl_matrix_free(upper);
    sl_matrix_free(lower);
}

/* M + t (L M^-1)^(k-1) L computed densely. The caller frees it. */
static double *dense_harmonic(const mesh *m, int k, double t) {
    const sl_int n = m->n_vertices;
    sl_matrix *M = NULL;
    assert_true(laplacian_cotangent(&M, m));
    const sl_csc view = sl_matrix_view(M);
    double *L = ref_dense(&view), *all = ref_dense(&view), *mass = test_reals((size_t)n);
    laplacian_mass(mass, m);
    for (int step = 1; step < k; step++) {
        for (sl_int j = 0; j < n; j++) {
            for (sl_int i = 0; i < n; i++) {
                AT(all, i, j) /= mass[j]; /* all M^-1 */
            }
        }
        double *next = dense_product(all, L, (size_t)n, (size_t)n, (size_t)n);
        free(all);
        all = next;
    }
    for (sl_int j = 0; j < n; j++) {
        for (sl_int i = 0; i < n; i++) {
            AT(all, i, j) = t * AT(all, i, j) + (i == j ? mass[j] : 0);
        }
    }
    free(mass);
    free(L);
    sl_matrix_free(M);
    return all;
}

static void systems_match_dense_systems(void **state) {
    (void)state;
    mesh m;
    assert_true(mesh_grid(&m, 9, 7, 0.2, 5));
    const sl_int n = m.n_vertices;
    const double steps[] = {0, 1e-4, 1};
    for (int k = 1; k <= POLYHARMONIC_MAX_ORDER; k++) {
        for (int s = 0; s < 3; s++) {
            sl_matrix *H = NULL;
            assert_true(polyharmonic_system(&H, &m, k, steps[s]));
            const sl_csc A = sl_matrix_view(H);
            SL_CHECK(sl_csc_check(&A, NULL));
            double *got = ref_dense(&A), *wanted = dense_harmonic(&m, k, steps[s]), largest = 0;
            for (sl_int j = 0; j < n; j++) {
                assert_int_equal(A.i[A.p[j]], j); /* lower triangle, diagonal first */
                largest = fmax(largest, fabs(AT(wanted, j, j)));
            }
            for (sl_int j = 0; j < n; j++) {
                for (sl_int i = 0; i < n; i++) {
                    assert_true(fabs(AT(got, i, j) - AT(wanted, i, j)) <=
                                64 * DBL_EPSILON * largest);
                }
            }
            free(wanted);
            free(got);
            sl_matrix_free(H);
        }
    }
    mesh_free(&m);
}

/* Constants are in the kernel of L, so A 1 = M 1. All pivots are positive. */
static void systems_map_constants_to_masses_and_are_definite(void **state) {
    (void)state;
    mesh m;
    assert_true(mesh_grid(&m, 20, 20, 0.2, 9));
    const size_t n = (size_t)m.n_vertices;
    double *ones = test_reals(n), *y = test_reals(n), *mass = test_reals(n);
    laplacian_mass(mass, &m);
    for (size_t i = 0; i < n; i++) {
        ones[i] = 1;
    }
    for (int k = 1; k <= POLYHARMONIC_MAX_ORDER; k++) {
        sl_matrix *H = NULL, *E = NULL;
        sl_symbolic *S = NULL;
        sl_factor *F = NULL;
        sl_stats stats;
        memset(&stats, 0, sizeof stats);
        const double t = pow(0.1, 2 * k);
        assert_true(polyharmonic_system(&H, &m, k, t));
        const sl_csc A = sl_matrix_view(H);
        SL_CHECK(sl_csc_multiply(&A, SL_AS_SYMMETRIC, y, n, ones, n, 1));
        for (size_t i = 0; i < n; i++) {
            const double size = A.x[A.p[i]]; /* the diagonal, the largest entry of its row */
            assert_true(fabs(y[i] - mass[i]) <= 400 * DBL_EPSILON * size);
        }
        SL_CHECK(sl_symbolic_create(&S, &A, NULL, &stats));
        SL_CHECK(sl_factor_create(&F, S, &A, NULL, &stats));
        assert_int_equal(stats.factor.positive, m.n_vertices);
        sl_factor_free(F);
        sl_symbolic_free(S);
        assert_true(polyharmonic_energy(&E, &m, k)); /* the rest of the system, without masses */
        const sl_csc B = sl_matrix_view(E);
        assert_int_equal(B.p[B.n_cols], A.p[A.n_cols]);
        for (sl_int j = 0; j < A.n_cols; j++) {
            for (sl_int p = A.p[j]; p < A.p[j + 1]; p++) {
                const double want = A.x[p] - (A.i[p] == j ? mass[j] : 0);
                const double size = A.x[A.p[j]]; /* the diagonal */
                assert_true(B.i[p] == A.i[p] && fabs(t * B.x[p] - want) <= 8 * DBL_EPSILON * size);
            }
        }
        sl_matrix_free(E);
        sl_matrix_free(H);
    }
    free(mass);
    free(y);
    free(ones);
    mesh_free(&m);
}

static void wrong_arguments_are_refused_and_empty_meshes_work(void **state) {
    (void)state;
    double xyz[9] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
    sl_int face[3] = {0, 1, 2}, beyond[3] = {0, 1, 3};
    mesh m = {3, 1, xyz, face};
    sl_matrix *M = (sl_matrix *)(void *)&m;
    assert_false(polyharmonic_system(&M, &m, 0, 1));
    assert_false(polyharmonic_energy(&M, &m, 0));
    assert_false(polyharmonic_energy(&M, &m, POLYHARMONIC_MAX_ORDER + 1));
    assert_null(M);
    assert_false(polyharmonic_system(&M, &m, POLYHARMONIC_MAX_ORDER + 1, 1));
    assert_false(polyharmonic_system(&M, &m, 2, -1));
    assert_false(polyharmonic_system(&M, &m, 2, strtod("nan", NULL)));
    m.faces = beyond;
    assert_false(polyharmonic_system(&M, &m, 2, 1));
    m.n_vertices = m.n_faces = 0;
    for (int k = 1; k <= POLYHARMONIC_MAX_ORDER; k++) {
        assert_true(polyharmonic_system(&M, &m, k, 1));
        assert_int_equal(sl_matrix_view(M).n_cols, 0);
        sl_matrix_free(M);
    }
    const sl_int p[] = {0, 1, 1}, i[] = {0};
    const double x[] = {2};
    const sl_csc square = {2, 2, p, i, x}, pattern = {2, 2, p, i, NULL}, wide = {1, 2, p, i, x};
    assert_false(csc_product(&M, &square, &wide));
    assert_false(csc_product(&M, &square, &pattern));
    assert_false(csc_expand_symmetric(&M, &wide));
    assert_false(csc_symmetric_part(&M, &wide));
    assert_false(csc_symmetric_part(&M, &pattern));
    assert_null(M);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(products_match_dense_products),
        cmocka_unit_test(symmetrizing_recovers_the_triangle),
        cmocka_unit_test(systems_match_dense_systems),
        cmocka_unit_test(systems_map_constants_to_masses_and_are_definite),
        cmocka_unit_test(wrong_arguments_are_refused_and_empty_meshes_work),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

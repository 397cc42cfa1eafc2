/* test_laplacian.c: cotangent and graph Laplacians, masses and systems M + t L */
#define _POSIX_C_SOURCE 200809L
#include "tests/lib/check_laplacian.h"

#include "tools/io/dataset.h"
#include "tools/mesh/grid.h"

static void triangles_have_the_known_laplacian(void **state) {
    (void)state;
    /* A right angle at 0, 45 degrees at 1 and 2: cotangents 0, 1, 1. */
    mesh m = mesh_of(known_triangle_xyz, 3, one_face, 1);
    sl_matrix *L = NULL;
    assert_true(laplacian_cotangent(&L, &m));
    static const double right[9] = {1, -0.5, -0.5, -0.5, 0.5, 0, -0.5, 0, 0.5};
    double *full = dense_of(L);
    SAME_VALUES(full, right, 9);
    free(full);
    sl_matrix_free(L);

    /* An equilateral triangle in space of side sqrt(2): each cotangent is 1 / sqrt(3), the area
     * sqrt(3) / 2. */
    double xyz[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1};
    m = mesh_of(xyz, 3, one_face, 1);
    assert_true(laplacian_cotangent(&L, &m));
    full = dense_of(L);
    for (int k = 0; k < 9; k++) {
        assert_true(near(full[k], k % 4 == 0 ? 1 / sqrt(3.0) : -0.5 / sqrt(3.0), 1));
    }
    free(full);
    sl_matrix_free(L);
    double mass[3];
    laplacian_mass(mass, &m);
    assert_true(near(mass[0], sqrt(3.0) / 6, 1) && near(mass[2], sqrt(3.0) / 6, 1));
    assert_true(near(mesh_mean_edge_length(&m), sqrt(2.0), 1));

    /* 120 degrees at 0: a negative weight on the opposite edge. */
    double obtuse[9] = {0, 0, 0, 1, 0, 0, -0.5, sqrt(3.0) / 2, 0};
    m = mesh_of(obtuse, 3, one_face, 1);
    assert_true(laplacian_cotangent(&L, &m));
    full = dense_of(L);
    assert_true(near(full[5], 0.5 / sqrt(3.0), 1));
    assert_true(near(full[1], -0.5 * sqrt(3.0), 1));
    free(full);
    sl_matrix_free(L);
}

static void a_regular_grid_gives_the_5_point_laplacian(void **state) {
    (void)state;
    const sl_int nx = 7, ny = 5;
    mesh m;
    sl_matrix *L = NULL, *G = NULL;
    assert_true(mesh_grid(&m, nx, ny, 0, 1));
    assert_true(laplacian_cotangent(&L, &m));
    assert_true(grid_laplacian_2d(&G, nx, ny, 0));
    double *l = dense_of(L), *g = dense_of(G);
    for (sl_int j = 0; j < nx * ny; j++) {
        bool inside = j % nx > 0 && j % nx < nx - 1 && j / nx > 0 && j / nx < ny - 1;
        for (sl_int i = 0; i < nx * ny && inside; i++) {
            size_t at = (size_t)(i + nx * ny * j);
            assert_true(near(l[at], g[at], 1));
        }
    }
    free(l);
    free(g);
    sl_matrix_free(L);
    sl_matrix_free(G);
    mesh_free(&m);
}

static void linear_functions_are_harmonic_on_planar_meshes(void **state) {
    (void)state;
    for (uint64_t seed = 0; seed < 5; seed++) {
        const sl_int nx = 20, ny = 20, n = nx * ny;
        mesh m;
        sl_matrix *L = NULL;
        assert_true(mesh_grid(&m, nx, ny, 0.24, seed));
        assert_true(laplacian_cotangent(&L, &m));
        sl_csc A = sl_matrix_view(L);
        assert_rows_sum_to(&A, 0);
        double *f = test_reals((size_t)n), *y = test_reals((size_t)n),
               *mass = test_reals((size_t)n);
        for (sl_int v = 0; v < n; v++) {
            f[v] = 3 * m.xyz[3 * v] - 2 * m.xyz[3 * v + 1] + 1;
        }
        /* A linear function is harmonic. Its Dirichlet energy is its squared slope times the area,
         * here 1. */
        SL_CHECK(sl_csc_multiply(&A, SL_AS_SYMMETRIC, y, (size_t)n, f, (size_t)n, 1));
        for (sl_int v = 0; v < n; v++) {
            bool inside = v % nx > 0 && v % nx < nx - 1 && v / nx > 0 && v / nx < ny - 1;
            assert_true(!inside || fabs(y[v]) <= 1e-13 * 4 * 10);
        }
        assert_true(fabs(quadratic_form(&A, f) - 13) <= 1e-11);
        laplacian_mass(mass, &m);
        double area = 0;
        for (sl_int v = 0; v < n; v++) {
            assert_true(mass[v] > 0);
            area += mass[v];
        }
        assert_true(fabs(area - 1) <= 1e-13);
        free(f);
        free(y);
        free(mass);
        sl_matrix_free(L);
        mesh_free(&m);
    }
}

/* Three triangles at one edge: the Laplacian is the sum of the three. */
static void faces_of_an_edge_are_summed(void **state) {
    (void)state;
    double xyz[15] = {0, 0, -3.6, 0, -2, 1.5, 3, 0, 0, 0, 2, 1.5, -3, 0, 0};
    sl_int faces[9] = {0, 2, 4, 3, 2, 4, 2, 4, 1};
    mesh m = mesh_of(xyz, 5, faces, 3);
    sl_matrix *L = NULL;
    assert_true(laplacian_cotangent(&L, &m));
    double *all = dense_of(L);
    sl_matrix_free(L);
    for (sl_int f = 0; f < 3; f++) {
        mesh one = mesh_of(xyz, 5, faces + 3 * f, 1);
        assert_true(laplacian_cotangent(&L, &one));
        double *one_face_alone = dense_of(L);
        for (int k = 0; k < 25; k++) {
            all[k] -= one_face_alone[k];
        }
        free(one_face_alone);
        sl_matrix_free(L);
    }
    for (int k = 0; k < 25; k++) {
        assert_true(fabs(all[k]) <= 1e-14);
    }
    free(all);
}

static void systems_share_one_pattern(void **state) {
    (void)state;
    mesh a, b;
    assert_true(mesh_grid(&a, 6, 9, 0, 0));
    assert_true(mesh_grid(&b, 6, 9, 0.2, 3));
    sl_matrix *M[4];
    assert_true(laplacian_system(&M[0], &a, 0));
    assert_true(laplacian_system(&M[1], &b, 0.25));
    assert_true(laplacian_cotangent(&M[2], &b));
    assert_true(laplacian_uniform(&M[3], &a, 0.5));
    sl_csc A = sl_matrix_view(M[0]);
    for (int k = 0; k < 4; k++) {
        sl_csc B = sl_matrix_view(M[k]);
        assert_int_equal(B.p[54], A.p[54]);
        assert_memory_equal(A.p, B.p, 55 * sizeof *A.p);
        assert_memory_equal(A.i, B.i, (size_t)A.p[54] * sizeof *A.i);
    }
    /* M + t L, entry by entry. */
    sl_csc S = sl_matrix_view(M[1]), L = sl_matrix_view(M[2]), U = sl_matrix_view(M[3]);
    double *mass = test_reals(54);
    laplacian_mass(mass, &b);
    for (sl_int j = 0; j < 54; j++) {
        for (sl_int p = S.p[j]; p < S.p[j + 1]; p++) {
            double wanted = 0.25 * L.x[p] + (S.i[p] == j ? mass[j] : 0);
            assert_true(near(S.x[p], wanted, 4));
            assert_true(S.i[p] == j || U.x[p] == -1);
        }
    }
    assert_rows_sum_to(&U, 0.5);
    free(mass);
    for (int k = 0; k < 4; k++) {
        sl_matrix_free(M[k]);
    }
    mesh_free(&a);
    mesh_free(&b);
}

/* The system with t = h^2 is valid, the Laplacian is semidefinite on a random vector, and, where
 * that is quick to check, all pivots are positive. */
static void check_mesh(const char *path) {
    mesh m;
    sl_matrix *M = NULL;
    char message[300];
    if (!mesh_read(&m, path, message, sizeof message)) {
        print_error("%s\n", message);
        fail();
    }
    assert_true(laplacian_cotangent(&M, &m));
    sl_csc A = sl_matrix_view(M);
    assert_rows_sum_to(&A, 0);
    double *x = test_reals((size_t)m.n_vertices);
    uint64_t seed = 7;
    for (sl_int v = 0; v < m.n_vertices; v++) {
        seed = seed * 6364136223846793005u + 1442695040888963407u;
        x[v] = (double)(seed >> 33) * 0x1p-30 - 1;
    }
    assert_true(quadratic_form(&A, x) > 0);
    free(x);
    sl_matrix_free(M);
    double h = mesh_mean_edge_length(&m);
    assert_true(h > 0 && isfinite(h));
    assert_true(laplacian_system(&M, &m, h * h));
    A = sl_matrix_view(M);
    assert_is_valid_system(&A);
    if (m.n_vertices <= 12000) {
        sl_symbolic *S = NULL;
        sl_factor *F = NULL;
        sl_stats stats;
        memset(&stats, 0, sizeof stats);
        SL_CHECK(sl_symbolic_create(&S, &A, NULL, &stats));
        SL_CHECK(sl_factor_create(&F, S, &A, NULL, &stats));
        assert_int_equal(stats.factor.positive, m.n_vertices);
        sl_factor_free(F);
        sl_symbolic_free(S);
    }
    sl_matrix_free(M);
    mesh_free(&m);
}

static void real_laplacians_are_semidefinite(void **state) {
    (void)state;
    dataset d;
    if (!dataset_list(&d, NULL, "meshes")) {
        TEST_SKIP("SL_DATA names no folder with meshes: no real Laplacians are made");
    }
    for (size_t k = 0; k < d.count; k++) {
        check_mesh(d.paths[k]);
    }
    print_message("%lu real meshes\n", (unsigned long)d.count);
    dataset_free(&d);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(triangles_have_the_known_laplacian),
        cmocka_unit_test(a_regular_grid_gives_the_5_point_laplacian),
        cmocka_unit_test(linear_functions_are_harmonic_on_planar_meshes),
        cmocka_unit_test(faces_of_an_edge_are_summed),
        cmocka_unit_test(systems_share_one_pattern),
        cmocka_unit_test(real_laplacians_are_semidefinite),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

/* test_patch.c: grids, neighbours, breadth-first patches, components */
#define _POSIX_C_SOURCE 200809L
#include "test.h"

#include "../tools/dataset.h"
#include "../tools/grid.h"
#include "../tools/patch.h"

static bool has_neighbour(const adjacency *a, sl_int v, sl_int w) {
    for (sl_off p = a->begin[v]; p < a->begin[v + 1]; p++) {
        if (a->neighbour[p] == w) {
            return true;
        }
    }
    return false;
}

/* Ascending, none twice, never itself, and every edge at both ends. */
static void is_sound(const adjacency *a) {
    assert_true(a->begin[0] == 0);
    for (sl_int v = 0; v < a->n; v++) {
        for (sl_off p = a->begin[v]; p < a->begin[v + 1]; p++) {
            assert_true(a->neighbour[p] != v && a->neighbour[p] >= 0 && a->neighbour[p] < a->n);
            assert_true(p == a->begin[v] || a->neighbour[p - 1] < a->neighbour[p]);
        }
    }
    if (a->n <= 1000) {
        for (sl_int v = 0; v < a->n; v++) {
            for (sl_off p = a->begin[v]; p < a->begin[v + 1]; p++) {
                assert_true(has_neighbour(a, a->neighbour[p], v));
            }
        }
    }
}

static void grids_are_what_they_say(void **state) {
    (void)state;
    mesh m, same, other;
    assert_true(mesh_grid(&m, 5, 3, 0, 9));
    assert_int_equal(m.n_vertices, 15);
    assert_int_equal(m.n_faces, 16);
    assert_true(m.xyz[3 * 7] == 0.5 && m.xyz[3 * 7 + 1] == 0.25 && m.xyz[3 * 7 + 2] == 0);
    assert_true(m.xyz[3 * 14] == 1 && m.xyz[3 * 14 + 1] == 0.5);
    mesh_free(&m);
    assert_true(mesh_grid(&m, 30, 20, 0.24, 9));
    assert_true(mesh_grid(&same, 30, 20, 0.24, 9));
    assert_true(mesh_grid(&other, 30, 20, 0.24, 10));
    SAME_VALUES(m.xyz, same.xyz, 3 * 600);
    assert_true(first_difference(m.xyz, other.xyz, 3 * 600) >= 0);
    for (sl_int v = 0; v < 600; v++) {
        double dx = m.xyz[3 * v] * 29 - v % 30, dy = m.xyz[3 * v + 1] * 29 - v / 30;
        bool border = v % 30 == 0 || v % 30 == 29 || v / 30 == 0 || v / 30 == 19;
        assert_true(fabs(dx) <= (border ? 1e-14 : 0.24) * 29 &&
                    fabs(dy) <= (border ? 1e-14 : 0.24) * 29);
    }
    for (sl_int f = 0; f < m.n_faces; f++) {
        const double *a = m.xyz + 3 * m.faces[3 * f], *b = m.xyz + 3 * m.faces[3 * f + 1],
                     *c = m.xyz + 3 * m.faces[3 * f + 2];
        assert_true((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]) > 0);
    }
    mesh_free(&m);
    mesh_free(&same);
    mesh_free(&other);
    assert_true(mesh_grid(&m, 1, 1, 0.1, 0));
    assert_int_equal(m.n_vertices, 1);
    assert_int_equal(m.n_faces, 0);
    mesh_free(&m);
    assert_false(mesh_grid(&m, 0, 3, 0, 0));
    assert_false(mesh_grid(&m, 3, 3, -0.1, 0));
    assert_false(mesh_grid(&m, 3, 3, HUGE_VAL, 0));
    assert_false(mesh_grid(&m, 65536, 65536, 0, 0));
    assert_null(m.xyz);
}

/* Closed and oriented: each directed edge is there once, and its reverse too; the faces look outwards. */
static void a_torus(void **state) {
    (void)state;
    const sl_int nu = 9, nv = 5, n = nu * nv;
    mesh m, same;
    char *edge = (char *)test_array((size_t)(n * n), 1);
    double volume = 0;
    assert_true(mesh_torus(&m, nu, nv, 0.2, 4));
    assert_true(mesh_torus(&same, nu, nv, 0.2, 4));
    assert_int_equal(m.n_vertices, n);
    assert_int_equal(m.n_faces, 2 * n);
    assert_memory_equal(m.xyz, same.xyz, 3 * (size_t)n * sizeof *m.xyz);
    for (sl_int f = 0; f < m.n_faces; f++) {
        const sl_int *c = m.faces + 3 * f;
        const double *p = m.xyz + 3 * c[0], *q = m.xyz + 3 * c[1], *r = m.xyz + 3 * c[2];
        for (int k = 0; k < 3; k++) {
            char *here = &edge[c[k] + n * c[(k + 1) % 3]];
            assert_int_equal(*here, 0);
            *here = 1;
        }
        volume += p[0] * (q[1] * r[2] - q[2] * r[1]) + p[1] * (q[2] * r[0] - q[0] * r[2]) +
                  p[2] * (q[0] * r[1] - q[1] * r[0]);
    }
    for (sl_int i = 0; i < n; i++) {
        for (sl_int j = 0; j < n; j++) {
            assert_int_equal(edge[i + n * j], edge[j + n * i]);
        }
    }
    assert_true(volume > 0);
    free(edge);
    mesh_free(&m);
    mesh_free(&same);
    assert_false(mesh_torus(&m, 2, 3, 0, 0));
    assert_false(mesh_torus(&m, 3, 2, 0, 0));
    assert_false(mesh_torus(&m, 3, 3, -0.1, 0));
    assert_false(mesh_torus(&m, 3, 3, HUGE_VAL, 0));
    assert_false(mesh_torus(&m, 65536, 65536, 0, 0));
    assert_null(m.xyz);
}

static void grid_laplacians(void **state) {
    (void)state;
    const sl_int nx = 4, ny = 3, nz = 5;
    sl_matrix *M = NULL;
    assert_true(grid_laplacian_3d(&M, nx, ny, nz, 0.25));
    sl_csc A = sl_matrix_view(M);
    assert_int_equal(A.n_cols, nx * ny * nz);
    /* diagonal, then the edges along each direction */
    assert_int_equal(A.p[A.n_cols], 60 + 3 * 3 * 5 + 4 * 2 * 5 + 4 * 3 * 4);
    double *ones = test_reals(60), *y = test_reals(60);
    for (int k = 0; k < 60; k++) {
        ones[k] = 1;
    }
    SL_CHECK(sl_csc_multiply(&A, SL_AS_SYMMETRIC, y, 60, ones, 60, 1));
    for (sl_int j = 0; j < 60; j++) {
        assert_true(y[j] == 0.25);
        for (sl_int p = A.p[j]; p < A.p[j + 1]; p++) {
            sl_int i = A.i[p];
            sl_int steps = abs(i % nx - j % nx) + abs(i / nx % ny - j / nx % ny) +
                           abs(i / nx / ny - j / nx / ny);
            assert_true(i == j || (i > j && steps == 1 && A.x[p] == -1));
        }
    }
    sl_matrix_free(M);
    free(ones);
    free(y);
    assert_true(grid_laplacian_2d(&M, 100, 100, 0));
    assert_int_equal(sl_matrix_view(M).p[10000], 29800);
    sl_matrix_free(M);
    assert_false(grid_laplacian_3d(&M, 2000, 2000, 2000, 0));
    assert_null(M);
    assert_false(grid_laplacian_2d(&M, 0, 1, 0));
    assert_true(grid_laplacian_2d(&M, 1, 1, 3));
    assert_true(sl_matrix_view(M).x[0] == 3);
    sl_matrix_free(M);
}

static void neighbours(void **state) {
    (void)state;
    double xyz[18] = {0};
    sl_int faces[15] = {0, 1, 2, 2, 1, 3, 0, 1, 2, 3, 3, 1, 4, 4, 4};
    mesh m = {6, 5, xyz, faces};
    adjacency a;
    assert_true(adjacency_from_mesh(&a, &m));
    is_sound(&a);
    static const sl_off begin[7] = {0, 2, 5, 8, 10, 10, 10};
    static const sl_int neighbour[10] = {1, 2, 0, 2, 3, 0, 1, 3, 1, 2};
    assert_memory_equal(a.begin, begin, sizeof begin);
    assert_memory_equal(a.neighbour, neighbour, sizeof neighbour);
    adjacency_free(&a);
    adjacency_free(&a);
    faces[0] = 6;
    assert_false(adjacency_from_mesh(&a, &m));
    assert_null(a.begin);

    /* the same graph from a matrix that stores either triangle, both, and twice over */
    const sl_int i[8] = {1, 0, 2, 2, 1, 3, 4, 2}, j[8] = {0, 2, 1, 3, 3, 1, 4, 3};
    sl_matrix *M = NULL;
    SL_CHECK(sl_matrix_from_triplets(&M, 6, 6, 8, i, j, NULL, NULL, NULL));
    sl_csc A = sl_matrix_view(M);
    assert_true(adjacency_from_matrix(&a, &A));
    is_sound(&a);
    assert_memory_equal(a.begin, begin, sizeof begin);
    assert_memory_equal(a.neighbour, neighbour, sizeof neighbour);
    adjacency_free(&a);
    A.n_rows = 7;
    assert_false(adjacency_from_matrix(&a, &A));
    sl_matrix_free(M);
}

static void patches_grow_in_rings(void **state) {
    (void)state;
    const sl_int nx = 12, n = 144;
    sl_matrix *M = NULL;
    adjacency a;
    assert_true(grid_laplacian_2d(&M, nx, nx, 1));
    sl_csc A = sl_matrix_view(M);
    assert_true(adjacency_from_matrix(&a, &A));
    is_sound(&a);
    sl_int *patch = test_ints((size_t)n), *whole = test_ints((size_t)n);
    unsigned char *seen = (unsigned char *)test_array((size_t)n, 1);
    const sl_int start = 5 + nx * 4;
    assert_int_equal(patch_bfs(whole, n, &a, start, seen), n);
    assert_int_equal(whole[0], start);
    sl_int before = 0;
    for (sl_int k = 0; k < n; k++) {
        sl_int distance = abs(whole[k] % nx - start % nx) + abs(whole[k] / nx - start / nx);
        assert_true(distance == before || distance == before + 1);
        before = distance;
    }
    for (sl_int count = 0; count <= n; count++) {
        assert_int_equal(patch_bfs(patch, count, &a, start, seen), count);
        assert_memory_equal(patch, whole, (size_t)count * sizeof *patch);
    }
    for (sl_int v = 0; v < n; v++) {
        assert_int_equal(seen[v], 0);
    }
    assert_int_equal(patch_bfs(patch, 3, &a, n, seen), 0);
    assert_int_equal(patch_bfs(patch, 3, &a, -1, seen), 0);
    free(patch);
    free(whole);
    free(seen);
    adjacency_free(&a);
    sl_matrix_free(M);
}

static void components(void **state) {
    (void)state;
    const sl_int i[4] = {4, 3, 6, 6}, j[4] = {1, 0, 2, 3};
    sl_matrix *M = NULL;
    SL_CHECK(sl_matrix_from_triplets(&M, 7, 7, 4, i, j, NULL, NULL, NULL));
    sl_csc A = sl_matrix_view(M);
    adjacency a;
    assert_true(adjacency_from_matrix(&a, &A));
    sl_int component[7], sizes[7];
    static const sl_int wanted[7] = {0, 1, 0, 0, 1, 2, 0};
    assert_int_equal(patch_components(component, sizes, &a), 3);
    assert_memory_equal(component, wanted, sizeof wanted);
    assert_true(sizes[0] == 4 && sizes[1] == 2 && sizes[2] == 1);
    assert_int_equal(patch_components(component, NULL, &a), 3);
    sl_int patch[7];
    unsigned char seen[7] = {0};
    assert_int_equal(patch_bfs(patch, 7, &a, 6, seen), 4);
    adjacency_free(&a);
    sl_matrix_free(M);
    mesh none = {0, 0, NULL, NULL};
    assert_true(adjacency_from_mesh(&a, &none));
    assert_int_equal(patch_components(component, sizes, &a), 0);
    adjacency_free(&a);
}

/* Components over the vertices that have a neighbour, as counted by others. */
static void real_components(void **state) {
    (void)state;
    static const struct {
        const char *name;
        sl_int components;
        sl_int lone;
    } known[] = {{"stratocaster.ply.gz", 94, 0},
                 {"human_neutral.obj.gz", 3, 0},
                 {"dragon_vrip_res2.ply.gz", 7, 43},
                 {"sliver_tet.ply.gz", 1, 5005},
                 {"hourglass_ico.obj", 1, 0},
                 {"hole_capsule.off", 1, 0},
                 {"colin.cerebral.L.flat.164k_fs_LR.ply.gz", 1, 14840}};
    dataset d;
    if (!dataset_list(&d, NULL, "meshes")) {
        print_message("SL_DATA names no folder with meshes: no real components are counted\n");
        skip();
    }
    for (size_t k = 0; k < d.count; k++) {
        for (size_t t = 0; t < sizeof known / sizeof known[0]; t++) {
            if (strcmp(dataset_basename(d.paths[k]), known[t].name) != 0) {
                continue;
            }
            mesh m;
            adjacency a;
            assert_true(mesh_read(&m, d.paths[k], NULL, 0));
            assert_true(adjacency_from_mesh(&a, &m));
            is_sound(&a);
            sl_int *component = test_ints((size_t)m.n_vertices), lone = 0;
            for (sl_int v = 0; v < a.n; v++) {
                lone += a.begin[v] == a.begin[v + 1];
            }
            assert_int_equal(lone, known[t].lone);
            assert_int_equal(patch_components(component, NULL, &a) - lone, known[t].components);
            free(component);
            adjacency_free(&a);
            mesh_free(&m);
        }
    }
    dataset_free(&d);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(grids_are_what_they_say), cmocka_unit_test(a_torus),
        cmocka_unit_test(grid_laplacians),         cmocka_unit_test(neighbours),
        cmocka_unit_test(patches_grow_in_rings),   cmocka_unit_test(components),
        cmocka_unit_test(real_components),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

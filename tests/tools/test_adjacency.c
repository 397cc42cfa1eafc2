/* test_adjacency.c: vertex adjacency of meshes and matrices, breadth-first patches, components */
#define _POSIX_C_SOURCE 200809L
#include "tests/lib/test.h"

#include "tools/io/dataset.h"
#include "tools/mesh/grid.h"
#include "tools/mesh/adjacency.h"

static bool has_neighbor(const adjacency *a, sl_int v, sl_int w) {
    for (sl_off p = a->begin[v]; p < a->begin[v + 1]; p++) {
        if (a->neighbor[p] == w) {
            return true;
        }
    }
    return false;
}

/* Neighbors ascend without duplicates or loops, and every edge is stored at both ends. */
static void assert_valid(const adjacency *a) {
    assert_true(a->begin[0] == 0);
    for (sl_int v = 0; v < a->n; v++) {
        for (sl_off p = a->begin[v]; p < a->begin[v + 1]; p++) {
            assert_true(a->neighbor[p] != v && a->neighbor[p] >= 0 && a->neighbor[p] < a->n);
            assert_true(p == a->begin[v] || a->neighbor[p - 1] < a->neighbor[p]);
        }
    }
    if (a->n <= 1000) {
        for (sl_int v = 0; v < a->n; v++) {
            for (sl_off p = a->begin[v]; p < a->begin[v + 1]; p++) {
                assert_true(has_neighbor(a, a->neighbor[p], v));
            }
        }
    }
}

static void adjacency_matches_the_mesh_and_the_matrix(void **state) {
    (void)state;
    double xyz[18] = {0};
    sl_int faces[15] = {0, 1, 2, 2, 1, 3, 0, 1, 2, 3, 3, 1, 4, 4, 4};
    mesh m = {6, 5, xyz, faces};
    adjacency a;
    assert_true(adjacency_from_mesh(&a, &m));
    assert_valid(&a);
    static const sl_off begin[7] = {0, 2, 5, 8, 10, 10, 10};
    static const sl_int neighbor[10] = {1, 2, 0, 2, 3, 0, 1, 3, 1, 2};
    assert_memory_equal(a.begin, begin, sizeof begin);
    assert_memory_equal(a.neighbor, neighbor, sizeof neighbor);
    adjacency_free(&a);
    adjacency_free(&a);
    faces[0] = 6;
    assert_false(adjacency_from_mesh(&a, &m));
    assert_null(a.begin);

    /* The same graph from a matrix that stores entries of both triangles, some of them twice. */
    const sl_int i[8] = {1, 0, 2, 2, 1, 3, 4, 2}, j[8] = {0, 2, 1, 3, 3, 1, 4, 3};
    sl_matrix *M = NULL;
    SL_CHECK(sl_matrix_from_triplets(&M, 6, 6, 8, i, j, NULL, NULL, NULL));
    sl_csc A = sl_matrix_view(M);
    assert_true(adjacency_from_matrix(&a, &A));
    assert_valid(&a);
    assert_memory_equal(a.begin, begin, sizeof begin);
    assert_memory_equal(a.neighbor, neighbor, sizeof neighbor);
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
    assert_valid(&a);
    sl_int *patch = test_ints((size_t)n), *whole = test_ints((size_t)n);
    unsigned char *seen = (unsigned char *)test_array((size_t)n, 1);
    const sl_int start = 5 + nx * 4;
    assert_int_equal(adjacency_bfs(whole, n, &a, start, seen), n);
    assert_int_equal(whole[0], start);
    sl_int before = 0;
    for (sl_int k = 0; k < n; k++) {
        sl_int distance = abs(whole[k] % nx - start % nx) + abs(whole[k] / nx - start / nx);
        assert_true(distance == before || distance == before + 1);
        before = distance;
    }
    for (sl_int count = 0; count <= n; count++) {
        assert_int_equal(adjacency_bfs(patch, count, &a, start, seen), count);
        assert_memory_equal(patch, whole, (size_t)count * sizeof *patch);
    }
    for (sl_int v = 0; v < n; v++) {
        assert_int_equal(seen[v], 0);
    }
    assert_int_equal(adjacency_bfs(patch, 3, &a, n, seen), 0);
    assert_int_equal(adjacency_bfs(patch, 3, &a, -1, seen), 0);
    free(patch);
    free(whole);
    free(seen);
    adjacency_free(&a);
    sl_matrix_free(M);
}

static void components_are_counted(void **state) {
    (void)state;
    const sl_int i[4] = {4, 3, 6, 6}, j[4] = {1, 0, 2, 3};
    sl_matrix *M = NULL;
    SL_CHECK(sl_matrix_from_triplets(&M, 7, 7, 4, i, j, NULL, NULL, NULL));
    sl_csc A = sl_matrix_view(M);
    adjacency a;
    assert_true(adjacency_from_matrix(&a, &A));
    sl_int component[7], sizes[7];
    static const sl_int wanted[7] = {0, 1, 0, 0, 1, 2, 0};
    assert_int_equal(adjacency_components(component, sizes, &a), 3);
    assert_memory_equal(component, wanted, sizeof wanted);
    assert_true(sizes[0] == 4 && sizes[1] == 2 && sizes[2] == 1);
    assert_int_equal(adjacency_components(component, NULL, &a), 3);
    sl_int patch[7];
    unsigned char seen[7] = {0};
    assert_int_equal(adjacency_bfs(patch, 7, &a, 6, seen), 4);
    adjacency_free(&a);
    sl_matrix_free(M);
    mesh none = {0, 0, NULL, NULL};
    assert_true(adjacency_from_mesh(&a, &none));
    assert_int_equal(adjacency_components(component, sizes, &a), 0);
    adjacency_free(&a);
}

/* Components of the vertices that have a neighbor, against known counts. */
static void real_meshes_have_the_known_components(void **state) {
    (void)state;
    static const struct {
        const char *name;
        sl_int components;
        sl_int isolated;
    } known[] = {{"stratocaster.ply.gz", 94, 0},
                 {"human_neutral.obj.gz", 3, 0},
                 {"dragon_vrip_res2.ply.gz", 7, 43},
                 {"sliver_tet.ply.gz", 1, 5005},
                 {"hourglass_ico.obj", 1, 0},
                 {"hole_capsule.off", 1, 0},
                 {"colin.cerebral.L.flat.164k_fs_LR.ply.gz", 1, 14840}};
    dataset d;
    if (!dataset_list(&d, NULL, "meshes")) {
        TEST_SKIP("SL_DATA names no folder with meshes: no real components are counted");
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
            assert_valid(&a);
            sl_int *component = test_ints((size_t)m.n_vertices), isolated = 0;
            for (sl_int v = 0; v < a.n; v++) {
                isolated += a.begin[v] == a.begin[v + 1];
            }
            assert_int_equal(isolated, known[t].isolated);
            assert_int_equal(adjacency_components(component, NULL, &a) - isolated,
                             known[t].components);
            free(component);
            adjacency_free(&a);
            mesh_free(&m);
        }
    }
    dataset_free(&d);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(adjacency_matches_the_mesh_and_the_matrix),
        cmocka_unit_test(patches_grow_in_rings),
        cmocka_unit_test(components_are_counted),
        cmocka_unit_test(real_meshes_have_the_known_components),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

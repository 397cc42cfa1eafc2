/* test_remesh.c: splits, collapses and flips keep a manifold; compaction, and an analysis that
 * follows */
#include "tests/lib/test.h"

#include "tools/geometry/laplacian.h"
#include "tools/mesh/edge_sides.h"
#include "tools/mesh/grid.h"
#include "tools/mesh/remesh.h"

/* Twins are mutual and opposite, valences count edges, sides begin at their vertices. Returns
 * V - E + F. */
static sl_int assert_is_manifold(const remesh *r) {
    const mesh *m = &r->faces.m;
    sl_int *valence = test_ints((size_t)m->n_vertices), edges = 0, faces = 0, vertices = 0;
    for (sl_int s = 0; s < 3 * m->n_faces; s++) {
        const sl_int t = r->faces.twin[s];
        if (m->faces[s] < 0) {
            assert_int_equal(t, -1);
            continue;
        }
        const sl_int u = m->faces[side_after(s)], v = m->faces[side_after(side_after(s))];
        assert_true(u != v && r->side[u] >= 0);
        if (t >= 0) {
            assert_true(t != s && r->faces.twin[t] == s && m->faces[side_after(t)] == v);
        }
        faces++;
        edges += t < 0 || s < t;
        valence[u]++;
        valence[v] += t < 0;
    }
    for (sl_int v = 0; v < m->n_vertices; v++) {
        assert_int_equal(valence[v], r->valence[v]);
        assert_true(r->side[v] < 0 || m->faces[side_after(r->side[v])] == v);
        vertices += valence[v] > 0;
    }
    free(valence);
    return vertices - edges + faces / 3;
}

static sl_matrix *system_of(const remesh *r) {
    sl_matrix *L = NULL;
    assert_true(laplacian_system(&L, &r->faces.m, 1.0));
    return L;
}

/* Remeshes patches of a torus 20 times; the analysis follows. */
static void a_remeshed_torus_stays_a_torus(void **state) {
    (void)state;
    mesh torus;
    remesh r;
    uint64_t random = 11;
    sl_int anew = 0;
    assert_true(mesh_torus(&torus, 60, 30, 0.2, 3));
    assert_true(remesh_create(&r, &torus));
    assert_int_equal(assert_is_manifold(&r), 0);
    sl_matrix *A = system_of(&r);
    sl_csc a = sl_matrix_view(A);
    sl_symbolic *S = NULL;
    SL_CHECK(sl_symbolic_create(&S, &a, NULL, NULL));
    for (int k = 0; k < 20; k++) {
        const sl_int n = r.faces.m.n_vertices;
        sl_int *patch = test_ints(40), *new_of = test_ints(2 * (size_t)n), kept = 0;
        unsigned char *seen = (unsigned char *)test_array((size_t)n, 1);
        const sl_int count = remesh_patch(&r, (97 * k) % n, 40, patch, seen);
        assert_int_equal(count, 40);
        assert_in_range(remesh_vertices(&r, patch, count, &random), 5, 200);
        assert_int_equal(assert_is_manifold(&r), 0);
        remesh_compact(&r, new_of);
        assert_int_equal(assert_is_manifold(&r), 0);
        for (sl_int v = 0; v < n; v++) {
            kept += new_of[v] >= 0;
        }
        assert_in_range(kept, n - 40, n - 1);
        sl_matrix *B = system_of(&r);
        sl_csc b = sl_matrix_view(B);
        sl_symbolic *T = NULL;
        sl_stats stats;
        SL_CHECK(sl_symbolic_edit(&T, S, &a, &b, new_of, NULL, &stats));
        assert_int_equal(stats.symbolic.n, r.faces.m.n_vertices);
        anew += stats.edit.is_anew;
        sl_matrix_free(A);
        sl_symbolic_free(S);
        A = B;
        a = b;
        S = T;
        free(patch);
        free(new_of);
        free(seen);
    }
    assert_int_equal(anew, 0);
    /* after all edits L has few more entries than with a new order */
    sl_symbolic *fresh = NULL;
    sl_stats now, then;
    SL_CHECK(sl_symbolic_create(&fresh, &a, NULL, &then));
    now.symbolic = sl_symbolic_view(S).info;
    assert_true((double)now.symbolic.nnz_l < 1.15 * (double)then.symbolic.nnz_l);
    sl_symbolic_free(fresh);
    sl_symbolic_free(S);
    sl_matrix_free(A);
    remesh_free(&r);
    mesh_free(&torus);
}

static void borders_stay(void **state) {
    (void)state;
    mesh grid;
    remesh r;
    assert_true(mesh_grid(&grid, 12, 9, 0.1, 5));
    assert_true(remesh_create(&r, &grid));
    for (sl_int s = 0; s < 3 * grid.n_faces; s++) {
        if (r.faces.twin[s] < 0) {
            assert_false(remesh_split(&r, s) || remesh_collapse(&r, s) || remesh_flip(&r, s));
        }
    }
    sl_int done = 0;
    for (sl_int s = 0; s < 3 * grid.n_faces; s++) {
        done += s % 3 == 0 ? remesh_split(&r, s) : s % 3 == 1 ? remesh_collapse(&r, s) : 0;
        done += remesh_flip(&r, s);
    }
    assert_true(done > 50);
    assert_int_equal(assert_is_manifold(&r), 1);
    remesh_free(&r);
    mesh_free(&grid);
}

/* Two surfaces glued together at single vertices, and a face on an edge that has two: whatever is
 * edited, no face keeps a vertex that is gone. */
static void pinched_vertices_stay(void **state) {
    (void)state;
    mesh a, m = {0, 0, NULL, NULL};
    remesh r;
    uint64_t random = 9;
    assert_true(mesh_torus(&a, 20, 10, 0.2, 3));
    const sl_int n = a.n_vertices, f = a.n_faces;
    m.n_vertices = 2 * n;
    m.n_faces = 2 * f + 1;
    m.xyz = test_reals(6 * (size_t)n);
    m.faces = test_ints(3 * (size_t)m.n_faces);
    for (sl_int k = 0; k < 3 * n; k++) {
        m.xyz[k] = a.xyz[k];
        m.xyz[3 * n + k] = a.xyz[k] + (k % 3 == 0 ? 0.01 : 0);
    }
    for (sl_int k = 0; k < 3 * f; k++) { /* every 11th vertex is that of the first surface */
        m.faces[k] = a.faces[k];
        m.faces[3 * f + k] = a.faces[k] % 11 == 0 ? a.faces[k] : n + a.faces[k];
    }
    m.faces[6 * f] = a.faces[0];
    m.faces[6 * f + 1] = a.faces[1];
    m.faces[6 * f + 2] = n + 1;
    assert_true(remesh_create(&r, &m));
    for (int round = 0; round < 60; round++) {
        sl_int *patch = test_ints((size_t)r.faces.m.n_vertices);
        sl_int *new_of = test_ints(2 * (size_t)r.faces.m.n_vertices + 100);
        unsigned char *seen = (unsigned char *)test_array((size_t)r.faces.m.n_vertices, 1);
        memset(seen, 0, (size_t)r.faces.m.n_vertices);
        const sl_int count = remesh_patch(&r, round * 7 % r.faces.m.n_vertices, 30, patch, seen);
        assert_true(remesh_vertices(&r, patch, count, &random) >= 0);
        remesh_compact(&r, new_of);
        assert_true(mesh_faces_are_in_range(&r.faces.m));
        free(seen);
        free(new_of);
        free(patch);
    }
    assert_true(r.faces.m.n_faces > f);
    remesh_free(&r);
    mesh_free(&m);
    mesh_free(&a);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_remeshed_torus_stays_a_torus),
        cmocka_unit_test(borders_stay),
        cmocka_unit_test(pinched_vertices_stay),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

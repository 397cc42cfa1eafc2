/* test_param.c: boundaries mapped to the plane, Neumann data, harmonic layouts */
#include "tests/lib/gen_matrices.h"

#include "tests/lib/surfaces.h"
#include "tests/lib/mesh_patch.h"

#include "tools/geometry/distortion.h"
#include "tools/geometry/harmonic_map.h"

/* The unrolled boundary of a flat patch keeps lengths and angles: all distances between its
 * vertices are the same. */
static void unrolled_flat_boundaries_keep_distances(void **state) {
    (void)state;
    for (sl_int count = 3; count < 900; count = 2 * count + 5) {
        mesh_factor_t w;
        mesh_factor_make(&w, flat_grid(30, 0.2));
        disk_patch d = grown_disk(&w, 14 * 30 + 14, count);
        double *uv = test_reals(2 * (size_t)d.n_boundary);
        boundary_unroll(uv, &d);
        for (sl_int j = 0; j < d.n_boundary; j++) {
            for (sl_int k = 0; k < j; k++) {
                const double *x = d.p.m.xyz + 3 * (size_t)d.boundary[j];
                const double *y = d.p.m.xyz + 3 * (size_t)d.boundary[k];
                double there = hypot(x[0] - y[0], x[1] - y[1]);
                double here = hypot(uv[2 * j] - uv[2 * k], uv[2 * j + 1] - uv[2 * k + 1]);
                assert_true(fabs(here - there) <= 1e-13 * d.n_boundary);
            }
        }
        free(uv);
        disk_patch_free(&d);
        mesh_factor_free(&w);
    }
}

static void circle_boundaries_keep_edge_lengths(void **state) {
    (void)state;
    mesh_factor_t w;
    mesh_factor_make(&w, sphere_grid(20, 1));
    disk_patch d = grown_disk(&w, 205, 150);
    double *uv = test_reals(2 * (size_t)d.n_boundary), inc = 0, *X = test_reals(300);
    boundary_to_circle(uv, &d);
    double radius = hypot(uv[0], uv[1]);
    for (sl_int k = 0; k < d.n_boundary; k++) {
        sl_int next = (k + 1) % d.n_boundary;
        const double *x = d.p.m.xyz + 3 * (size_t)d.boundary[k];
        const double *y = d.p.m.xyz + 3 * (size_t)d.boundary[next];
        double length = hypot(hypot(x[0] - y[0], x[1] - y[1]), x[2] - y[2]);
        double angle = atan2(uv[2 * k] * uv[2 * next + 1] - uv[2 * k + 1] * uv[2 * next],
                             uv[2 * k] * uv[2 * next] + uv[2 * k + 1] * uv[2 * next + 1]);
        assert_true(fabs(hypot(uv[2 * k], uv[2 * k + 1]) - radius) <= 1e-14);
        /* Angles are proportional to edge lengths. */
        assert_true(fabs(angle * radius - length) <= 1e-13);
        inc += angle;
    }
    assert_true(fabs(inc - 2 * 3.14159265358979) <= 1e-12);
    /* The classic harmonic map stays inside the circle and turns no face over. */
    SL_CHECK(harmonic_dirichlet(X, &d, uv));
    double *both = test_reals(300);
    layout_from_columns(both, X, 150);
    assert_int_equal(distortion_of(&d.p.m, both).flipped, 0);
    for (sl_int v = 0; v < 150; v++) {
        assert_true(hypot(both[2 * v], both[2 * v + 1]) <= radius * (1 + 1e-14));
    }
    for (sl_int k = 0; k < d.n_boundary; k++) {
        SAME_VALUES(both + 2 * d.boundary[k], uv + 2 * k, 2);
    }
    patch_solver s = patch_solver_of(&w, &d.p);
    SL_CHECK(patch_solver_apply(&s, both, X, 2));
    for (sl_int k = 0; k < d.n_boundary; k++) {
        both[d.boundary[k]] = both[150 + d.boundary[k]] = 0;
    }
    assert_true(largest(both, 300) <= 1e-13);
    patch_solver_free(&s);
    free(both);
    free(X);
    free(uv);
    disk_patch_free(&d);
    mesh_factor_free(&w);
}

/* Equation (3) summed over the faces, for any layout of the interior, depends on the boundary
 * only. */
static void neumann_data_are_sums_over_faces(void **state) {
    (void)state;
    mesh_factor_t w;
    mesh_factor_make(&w, torus_grid(20, 15));
    disk_patch d = grown_disk(&w, 7, 120);
    sl_int n = d.p.m.n_vertices, nb = d.n_boundary;
    double *uv = test_reals(2 * (size_t)n), *sums = test_reals(2 * (size_t)n);
    double *edge = test_reals(2 * (size_t)nb), *b = test_reals(2 * (size_t)nb);
    double *B = test_reals(2 * (size_t)n);
    gen_reals(uv, 2 * (size_t)n, 3);
    for (sl_int k = 0; k < nb; k++) {
        edge[2 * k] = uv[2 * d.boundary[k]];
        edge[2 * k + 1] = uv[2 * d.boundary[k] + 1];
    }
    for (sl_int f = 0; f < d.p.m.n_faces; f++) {
        for (int c = 0; c < 3; c++) {
            sl_int i = d.p.m.faces[3 * f + c], j = d.p.m.faces[3 * f + (c + 1) % 3];
            sl_int k = d.p.m.faces[3 * f + (c + 2) % 3];
            sums[i] -= 0.5 * (uv[2 * k + 1] - uv[2 * j + 1]);
            sums[n + i] += 0.5 * (uv[2 * k] - uv[2 * j]);
        }
    }
    boundary_neumann_rhs(b, edge, nb);
    boundary_scatter(B, b, &d);
    for (sl_int k = 0; k < 2 * n; k++) {
        assert_true(fabs(B[k] - sums[k]) <= 1e-14);
    }
    free(B);
    free(b);
    free(edge);
    free(sums);
    free(uv);
    disk_patch_free(&d);
    mesh_factor_free(&w);
}

/* A flat patch is reproduced from the Neumann data of its own coordinates, and from those of its
 * unrolled boundary. */
static void flat_patches_are_reproduced(void **state) {
    (void)state;
    mesh_factor_t w;
    mesh_factor_make(&w, flat_grid(40, 0.2));
    for (sl_int count = 3; count <= 1600; count = count == 3 ? 100 : 4 * count) {
        disk_patch d = grown_disk(&w, 20 * 40 + 19, count);
        sl_int n = d.p.m.n_vertices, nb = d.n_boundary;
        patch_solver s = patch_solver_of(&w, &d.p);
        double *edge = test_reals(2 * (size_t)nb), *b = test_reals(2 * (size_t)nb);
        double *B = test_reals(2 * (size_t)n), *X = test_reals(2 * (size_t)n);
        double *plane = test_reals(2 * (size_t)n), *uv = test_reals(2 * (size_t)n);
        const sl_csc N = sl_matrix_view(s.N);
        for (sl_int v = 0; v < n; v++) {
            plane[v] = d.p.m.xyz[3 * v];
            plane[n + v] = d.p.m.xyz[3 * v + 1];
        }
        for (sl_int k = 0; k < nb; k++) {
            edge[2 * k] = plane[d.boundary[k]];
            edge[2 * k + 1] = plane[n + d.boundary[k]];
        }
        int solves = 60;
        boundary_neumann_rhs(b, edge, nb);
        boundary_scatter(B, b, &d);
        SL_CHECK(patch_solver_solve_patch(&s, X, B, 2, 1e-13, &solves));
        assert_true(largest_difference(X, plane, n) <= 1e-11 &&
                    largest_difference(X + n, plane + n, n) <= 1e-11);
        assert_true(d.p.n_interface > 0 || solves == 1); /* for the whole mesh L is N */
        SL_CHECK(factor_and_solve(X, &N, B, 2));
        assert_true(largest_difference(X, plane, n) <= 1e-11 &&
                    largest_difference(X + n, plane + n, n) <= 1e-11);
        boundary_unroll(edge, &d);
        boundary_neumann_rhs(b, edge, nb);
        boundary_scatter(B, b, &d);
        solves = 60;
        SL_CHECK(patch_solver_solve_patch(&s, X, B, 2, 1e-13, &solves));
        layout_from_columns(uv, X, n);
        distortion q = distortion_of(&d.p.m, uv);
        assert_true(q.isometric <= 1e-20 && q.flipped == 0 && fabs(q.conformal) <= 1e-18);
        free(edge);
        free(b);
        free(B);
        free(X);
        free(plane);
        free(uv);
        patch_solver_free(&s);
        disk_patch_free(&d);
    }
    mesh_factor_free(&w);
}

/* In an infinite plane, with a disk as the patch and the Neumann data of its own coordinates, the
 * paper's problem has half of these coordinates as its solution, because half of the flux goes
 * inward. Here the plane is a finite square. */
static void a_patch_in_a_plane_comes_out_half_as_large(void **state) {
    (void)state;
    double before = INFINITY;
    for (sl_int side = 41; side <= 161; side = 2 * side - 1) {
        mesh_factor_t w;
        disk_patch d;
        sl_int count = 0, *list = test_ints((size_t)(side * side));
        mesh_factor_make(&w, flat_grid(side, 0.1));
        for (sl_int v = 0; v < w.m.n_vertices; v++) {
            double x = (double)(v % side) / (side - 1) - 0.5,
                   y = (double)(v / side) / (side - 1) - 0.5;
            if (hypot(x, y) <= 0.12) {
                list[count++] = v;
            }
        }
        assert_true(disk_patch_from_vertices(&d, &w.inc, list, count, NULL, 0));
        sl_int n = d.p.m.n_vertices;
        patch_solver s = patch_solver_of(&w, &d.p);
        double *edge = test_reals(2 * (size_t)d.n_boundary),
               *b = test_reals(2 * (size_t)d.n_boundary);
        double *X = test_reals(2 * (size_t)n), *uv = test_reals(2 * (size_t)n);
        boundary_unroll(edge, &d);
        boundary_neumann_rhs(b, edge, d.n_boundary);
        boundary_scatter(X, b, &d);
        SL_CHECK(patch_solver_solve_mesh(&s, X, X, 2));
        layout_from_columns(uv, X, n);
        distortion q = distortion_of(&d.p.m, uv);
        double scale = sqrt(q.area_flat / q.area);
        print_message("%d vertices: scaled by %.3f, conformal error %.1e\n", (int)n, scale,
                      q.conformal);
        assert_true(scale > 0.45 && scale < 0.6 && q.conformal < 0.8 * before && q.flipped == 0);
        before = q.conformal;
        free(uv);
        free(X);
        free(b);
        free(edge);
        free(list);
        patch_solver_free(&s);
        disk_patch_free(&d);
        mesh_factor_free(&w);
    }
}

/* The layout does not depend on vertex numbers or on the position of the mesh. */
static void layouts_do_not_depend_on_numbering_or_position(void **state) {
    (void)state;
    mesh_factor_t w, v;
    mesh m = sphere_grid(25, 1), moved = sphere_grid(25, 1);
    sl_int n = m.n_vertices, size = 200, *to = test_ints((size_t)n), *there = test_ints(200);
    /* A random permutation; then each vertex is rotated and moved in space. */
    gen_permutation(to, n, 4);
    for (sl_int k = 0; k < n; k++) {
        const double *x = m.xyz + 3 * (size_t)k;
        double *y = moved.xyz + 3 * (size_t)to[k];
        y[0] = 0.6 * x[0] - 0.8 * x[1] + 5;
        y[1] = 0.8 * x[0] + 0.6 * x[1] - 2;
        y[2] = x[2] + 1;
    }
    for (size_t k = 0; k < 3 * (size_t)m.n_faces; k++) {
        moved.faces[k] = to[m.faces[k]];
    }
    mesh_factor_make(&w, m);
    mesh_factor_make(&v, moved);
    disk_patch d = grown_disk(&w, 300, size), e;
    for (sl_int k = 0; k < size; k++) {
        there[k] = to[d.p.vertices[k]];
    }
    assert_true(disk_patch_from_vertices(&e, &v.inc, there, size, NULL, 0));
    assert_int_equal(d.p.m.n_faces, e.p.m.n_faces);
    double X[2][400];
    for (int side = 0; side < 2; side++) {
        const disk_patch *one = side ? &e : &d;
        patch_solver s = patch_solver_of(side ? &v : &w, &one->p);
        double *edge = test_reals(2 * (size_t)one->n_boundary);
        double *b = test_reals(2 * (size_t)one->n_boundary), *B = test_reals(400);
        /* The circle starts at the first boundary vertex, the same one in both meshes. */
        boundary_to_circle(edge, one);
        boundary_neumann_rhs(b, edge, one->n_boundary);
        boundary_scatter(B, b, one);
        assert_int_equal(one->boundary[0], d.boundary[0]);
        SL_CHECK(patch_solver_solve_mesh(&s, X[side], B, 2));
        free(B);
        free(b);
        free(edge);
        patch_solver_free(&s);
    }
    assert_true(largest_difference(X[0], X[1], size) <= 1e-12);
    assert_true(largest_difference(X[0] + size, X[1] + size, size) <= 1e-12);
    disk_patch_free(&d);
    disk_patch_free(&e);
    free(there);
    free(to);
    mesh_factor_free(&w);
    mesh_factor_free(&v);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(unrolled_flat_boundaries_keep_distances),
        cmocka_unit_test(circle_boundaries_keep_edge_lengths),
        cmocka_unit_test(neumann_data_are_sums_over_faces),
        cmocka_unit_test(flat_patches_are_reproduced),
        cmocka_unit_test(a_patch_in_a_plane_comes_out_half_as_large),
        cmocka_unit_test(layouts_do_not_depend_on_numbering_or_position),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

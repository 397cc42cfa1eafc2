/* test_geodesic.c: distances by the heat method, within a radius and global; nearest sites */
#include "tests/lib/gen_matrices.h"

#include "tests/lib/real_meshes.h"
#include "tests/lib/heat_mesh.h"

#include "tools/mesh/graph_ball.h"

/* Within a radius the heat has the bits of the full solve, and distances agree with the full method
 * except near the rim. */
static void local_distances_match_full_ones(void **state) {
    (void)state;
    heat_mesh_t y;
    sl_int source = 1000;
    const heat_options near = {1.0, 0, 0}, cut = {1.0, 0, 1}, everything = {100, 0, 3};
    heat_mesh_make(&y, torus_grid(80, 50), 4);
    heat_field full, local;
    SL_CHECK(heat_distance(&full, &y.s, &source, 1, NULL));
    SL_CHECK(heat_distance(&local, &y.s, &source, 1, &near));
    assert_int_equal(full.n, y.m.n_vertices);
    assert_true(local.n_patch < y.m.n_vertices / 2 && local.n < local.n_patch);
    assert_int_equal(full.faces_without_gradient, 0);
    double *by = test_reals((size_t)y.m.n_vertices), *heat = test_reals((size_t)y.m.n_vertices);
    for (sl_int k = 0; k < full.n; k++) {
        by[full.vertices[k]] = full.distance[k];
        heat[full.vertices[k]] = full.heat[k];
    }
    double worst = 0;
    for (sl_int k = 0; k < local.n; k++) {
        assert_true(local.heat[k] == heat[local.vertices[k]]);
        assert_true(local.distance[k] <= 1.0);
        worst = fmax(worst, fabs(local.distance[k] - by[local.vertices[k]]));
    }
    assert_true(worst <= 0.02);
    heat_field_free(&local);
    /* Cutting X at the rim is less accurate than a rim without flux. */
    SL_CHECK(heat_distance(&local, &y.s, &source, 1, &cut));
    double cut_worst = 0;
    assert_int_equal(local.solves, 1);
    for (sl_int k = 0; k < local.n; k++) {
        cut_worst = fmax(cut_worst, fabs(local.distance[k] - by[local.vertices[k]]));
    }
    assert_true(cut_worst > worst);
    heat_field_free(&local);
    /* With a radius that covers the mesh this is the full method. */
    SL_CHECK(heat_distance(&local, &y.s, &source, 1, &everything));
    assert_int_equal(local.n, full.n);
    for (sl_int k = 0; k < local.n; k++) {
        assert_true(local.distance[k] == by[local.vertices[k]]);
    }
    heat_field_free(&local);
    heat_field_free(&full);
    free(heat);
    free(by);
    heat_mesh_free(&y);
}

/* What a radius of a given number of edges touches does not depend on the size of the mesh. */
static void local_cost_does_not_depend_on_the_mesh(void **state) {
    (void)state;
    sl_int ball_before = 0;
    for (sl_int side = 60; side <= 240; side *= 2) {
        heat_mesh_t y;
        heat_field f;
        sl_int source = side * (side / 2) + side / 2;
        const heat_options near = {8.1 / (side - 1), 0, 0};
        sl_stats all;
        heat_mesh_make(&y, flat_grid(side, 0), 1);
        SL_CHECK(heat_distance(&f, &y.s, &source, 1, &near));
        all.symbolic = sl_symbolic_view(y.s.S).info;
        assert_true(ball_before == 0 || f.n_patch == ball_before);
        assert_true(f.heat_stats.plan.x_entries < all.symbolic.nnz_panels / 2);
        assert_true(f.heat_stats.plan.b_entries <= f.heat_stats.plan.x_entries);
        ball_before = f.n_patch;
        heat_field_free(&f);
        heat_mesh_free(&y);
    }
}

/* Distances along edges, compared with a relaxation that runs until nothing changes. */
static void balls_hold_the_vertices_within_a_radius(void **state) {
    (void)state;
    heat_mesh_t y;
    const sl_int sources[3] = {5, 300, 5};
    heat_mesh_make(&y, sphere_grid(20, 1), 1);
    sl_int n = y.m.n_vertices;
    double *d = test_reals((size_t)n);
    for (sl_int v = 0; v < n; v++) {
        d[v] = v == 5 || v == 300 ? 0 : INFINITY;
    }
    for (bool changed = true; changed;) {
        changed = false;
        for (size_t k = 0; k < 3 * (size_t)y.m.n_faces; k++) {
            sl_int u = y.m.faces[k], v = y.m.faces[k / 3 * 3 + (k + 1) % 3];
            double length = euclidean_distance(y.m.xyz + 3 * (size_t)u, y.m.xyz + 3 * (size_t)v);
            if (d[u] + length < d[v] - 1e-14) {
                d[v] = d[u] + length;
                changed = true;
            }
            if (d[v] + length < d[u] - 1e-14) {
                d[u] = d[v] + length;
                changed = true;
            }
        }
    }
    static const double radii[] = {-1, 0, 0.1, 0.5, INFINITY};
    for (size_t k = 0; k < sizeof radii / sizeof *radii; k++) {
        graph_ball b;
        sl_int wanted = 0;
        assert_true(graph_ball_create(&b, &y.s.inc, sources, 3, radii[k]));
        for (sl_int v = 0; v < n; v++) {
            wanted += d[v] <= radii[k];
        }
        assert_int_equal(b.n, wanted);
        for (sl_int j = 0; j < b.n; j++) {
            assert_true(fabs(b.path_length[j] - d[b.vertices[j]]) <= 1e-13);
            assert_true(j == 0 || b.path_length[j] >= b.path_length[j - 1]);
        }
        graph_ball_free(&b);
    }
    free(d);
    heat_mesh_free(&y);
}

/* Two squares side by side and an isolated vertex: only vertices connected to a source have a
 * distance. */
static void only_connected_vertices_have_distances(void **state) {
    (void)state;
    heat_mesh_t y;
    mesh one = flat_grid(15, 0.1), m = {2 * 225 + 1, 2 * one.n_faces, NULL, NULL};
    m.xyz = test_reals(3 * (size_t)m.n_vertices);
    m.faces = test_ints(3 * (size_t)m.n_faces);
    memcpy(m.xyz, one.xyz, 3 * 225 * sizeof(double));
    for (sl_int k = 0; k < 3 * 225; k++) {
        m.xyz[3 * 225 + k] = one.xyz[k] + 3;
    }
    for (sl_int k = 0; k < 3 * one.n_faces; k++) {
        m.faces[k] = one.faces[k];
        m.faces[3 * one.n_faces + k] = one.faces[k] + 225;
    }
    mesh_free(&one);
    heat_mesh_make(&y, m, 4);
    const sl_int left[2] = {0, 224}, both[3] = {0, 224, 225 + 112}, lone[2] = {450, 7};
    double *d = distance_by_vertex(&y, left, 2, NULL),
           *first = distance_by_vertex(&y, left, 1, NULL);
    double *second = distance_by_vertex(&y, left + 1, 1, NULL),
           *e = distance_by_vertex(&y, both, 3, NULL);
    double *alone = distance_by_vertex(&y, lone, 2, NULL);
    for (sl_int v = 0; v < 451; v++) {
        assert_int_equal(isnan(d[v]), v >= 225);
        assert_int_equal(isnan(e[v]), v == 450);
        assert_int_equal(isnan(alone[v]), v >= 225 && v != 450);
        /* Within two edges, because the method rounds off the ridge where distances from two
         * sources meet. */
        if (v < 225) {
            assert_true(fabs(d[v] - fmin(first[v], second[v])) <= 2.0 / 14);
            assert_true(fabs(d[v] - e[v]) <= 1e-9);
        }
    }
    assert_true(d[0] <= 0.02 && d[224] <= 0.02 && e[225 + 112] == 0 && alone[450] == 0);
    free(d);
    free(e);
    free(first);
    free(second);
    free(alone);
    heat_mesh_free(&y);
}

/* Distances do not depend on vertex numbers or position, and scale with the mesh. */
static void distances_are_invariant(void **state) {
    (void)state;
    heat_mesh_t y, z;
    mesh m = sphere_grid(24, 1), moved = sphere_grid(24, 1);
    sl_int n = m.n_vertices, *to = test_ints((size_t)n), source = 200;
    gen_permutation(to, n, 11);
    for (sl_int k = 0; k < n; k++) {
        const double *x = m.xyz + 3 * (size_t)k;
        double *u = moved.xyz + 3 * (size_t)to[k];
        u[0] = 10 * (0.6 * x[0] - 0.8 * x[2]) + 4;
        u[1] = 10 * x[1];
        u[2] = 10 * (0.8 * x[0] + 0.6 * x[2]) - 7;
    }
    for (size_t k = 0; k < 3 * (size_t)m.n_faces; k++) {
        moved.faces[k] = to[m.faces[k]];
    }
    heat_mesh_make(&y, m, 1);
    heat_mesh_make(&z, moved, 1);
    sl_int there = to[source];
    const heat_options near = {0.4, 0, 0}, ten_times = {4, 0, 0};
    double *d = distance_by_vertex(&y, &source, 1, NULL),
           *e = distance_by_vertex(&z, &there, 1, NULL);
    for (sl_int v = 0; v < n; v++) {
        assert_true(fabs(10 * d[v] - e[to[v]]) <= 1e-8);
    }
    free(d);
    free(e);
    d = distance_by_vertex(&y, &source, 1, &near);
    e = distance_by_vertex(&z, &there, 1, &ten_times);
    for (sl_int v = 0; v < n; v++) {
        bool near_the_rim = fabs(d[v] - 0.4) < 1e-6 || fabs(e[to[v]] - 4) < 1e-5;
        assert_true(near_the_rim || isnan(d[v]) == isnan(e[to[v]]));
        assert_true(isnan(d[v]) || isnan(e[to[v]]) || fabs(10 * d[v] - e[to[v]]) <= 1e-8);
    }
    free(d);
    free(e);
    free(to);
    heat_mesh_free(&y);
    heat_mesh_free(&z);
}

/* A vertex that is clearly nearest to one site is in its cell. Local cells equal the full ones
 * within their radius. */
static void cells_belong_to_the_nearest_site(void **state) {
    (void)state;
    heat_mesh_t y;
    sl_int sites[21], wrong = 0, clear = 0;
    heat_mesh_make(&y, flat_grid(80, 0.2), 1);
    sl_int n = y.m.n_vertices, *cell = test_ints((size_t)n), *near = test_ints((size_t)n);
    double *most = test_reals((size_t)n);
    uint64_t chance = 3;
    for (int k = 0; k < 21; k++) {
        sites[k] = 300 * k + gen_below(&chance, 290);
    }
    sl_off touched;
    SL_CHECK(heat_cells(cell, most, &y.s, sites, 21, 0, &touched, NULL));
    assert_true(touched == 21 * (sl_off)n);
    for (sl_int v = 0; v < n; v++) {
        double best = INFINITY, next = INFINITY;
        int which = -1;
        for (int k = 0; k < 21; k++) {
            double d = euclidean_distance(y.m.xyz + 3 * (size_t)v, y.m.xyz + 3 * (size_t)sites[k]);
            if (d < best) {
                next = best;
                best = d;
                which = k;
            } else if (d < next) {
                next = d;
            }
        }
        /* The edges of a grid favor some directions by about a tenth. */
        if (next > 1.15 * best) {
            clear++;
            wrong += cell[v] != which;
        }
    }
    assert_true(clear > n / 2);
    assert_int_equal(wrong, 0);
    for (int k = 0; k < 21; k++) {
        assert_int_equal(cell[sites[k]], k);
    }
    SL_CHECK(heat_cells(near, most, &y.s, sites, 21, 2, NULL, NULL));
    for (sl_int v = 0; v < n; v++) {
        assert_int_equal(near[v], cell[v]);
    }
    SL_CHECK(heat_cells(near, most, &y.s, sites, 21, 0.1, &touched, NULL));
    assert_true(touched < 21 * (sl_off)n / 20);
    for (sl_int v = 0; v < n; v++) {
        double d = INFINITY;
        for (int k = 0; k < 21; k++) {
            d = fmin(d,
                     euclidean_distance(y.m.xyz + 3 * (size_t)v, y.m.xyz + 3 * (size_t)sites[k]));
        }
        assert_true(d <= 0.1 || near[v] == -1);
        assert_true(d > 0.06 || near[v] == cell[v]);
    }
    SL_CHECK(heat_cells(near, most, &y.s, sites, 0, 0, NULL, NULL));
    assert_int_equal(near[0], -1);
    free(most);
    free(near);
    free(cell);
    heat_mesh_free(&y);
}

/* Distances are finite, 0 at the source and bounded by the radius, on non-manifold meshes too. */
static void check_mesh(const char *name, mesh m) {
    heat_mesh_t y;
    heat_field f;
    (void)name;
    heat_mesh_make(&y, m, 4);
    double h = mesh_mean_edge_length(&y.m);
    sl_int source = y.m.faces[0];
    const heat_options near = {10 * h, 0, 0};
    SL_CHECK(heat_distance(&f, &y.s, &source, 1, &near));
    assert_true(f.n >= 1 && f.vertices[0] == source && f.distance[0] == 0);
    for (sl_int j = 0; j < f.n; j++) {
        assert_true(f.distance[j] >= 0 && f.distance[j] <= 10 * h);
    }
    heat_field_free(&f);
    SL_CHECK(heat_distance(&f, &y.s, &source, 1, NULL));
    for (sl_int j = 0; j < f.n; j++) {
        assert_true(isfinite(f.distance[j]) && f.path[j] >= 0);
    }
    heat_field_free(&f);
    heat_mesh_free(&y);
}

static void real_meshes_have_finite_distances(void **state) {
    (void)state;
    each_mesh(NULL, 0, 60000, check_mesh);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(local_distances_match_full_ones),
        cmocka_unit_test(local_cost_does_not_depend_on_the_mesh),
        cmocka_unit_test(balls_hold_the_vertices_within_a_radius),
        cmocka_unit_test(only_connected_vertices_have_distances),
        cmocka_unit_test(distances_are_invariant),
        cmocka_unit_test(cells_belong_to_the_nearest_site),
        cmocka_unit_test(real_meshes_have_finite_distances),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

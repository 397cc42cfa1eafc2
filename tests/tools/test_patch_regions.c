/* test_patch_regions.c: problems on patches solved in regions: same solutions, local cost */
#include "tests/lib/heat_mesh.h"
#include "tests/lib/mesh_patch.h"

#include "tools/geometry/heat_patch.h"

/* Both columns agree up to a constant, within 1e-10 of their size: 1e4 eps, for condition numbers
 * up to about 1e4 on these meshes. */
static void assert_same_layout(const double *X, const double *Y, sl_int n) {
    for (sl_int c = 0; c < 2; c++) {
        assert_true(largest_difference(X + c * n, Y + c * n, n) <=
                    1e-10 * largest(Y + c * n, (size_t)n));
    }
}

/* The problems of the mesh and of the patch, in a region and by plans to the roots. Confining a
 * solver twice changes nothing. */
static void region_solves_match_plans_to_the_roots(void **state) {
    (void)state;
    for (int which = 0; which < 3; which++) {
        mesh_factor_t w;
        mesh_factor_make(&w, which == 0   ? flat_grid(70, 0.2)
                             : which == 1 ? torus_grid(60, 40)
                                          : sphere_grid(50, 2));
        for (sl_int count = 4; count < w.m.n_vertices; count *= 5) {
            submesh p = grown_patch(&w, w.m.n_vertices / 2 + 25, count);
            sl_int n = p.m.n_vertices;
            patch_solver roots = patch_solver_of(&w, &p), inside = patch_solver_of(&w, &p);
            double *B = interface_flux(&p, 2), *X = test_reals(2 * (size_t)n);
            double *Y = test_reals(2 * (size_t)n);
            int in_roots = 60, in_region = 60;
            SL_CHECK(patch_solver_use_region(&inside, w.S));
            const sl_region *made = inside.region;
            SL_CHECK(patch_solver_use_region(&inside, w.S));
            assert_ptr_equal(inside.region, made);
            assert_true(inside.stats.plan.in_region || inside.stats.region.boundary == 0);
            SL_CHECK(patch_solver_solve_mesh(&roots, Y, B, 2));
            SL_CHECK(patch_solver_solve_mesh(&inside, X, B, 2));
            assert_same_layout(X, Y, n);
            SL_CHECK(patch_solver_solve_patch(&roots, Y, B, 2, 1e-12, &in_roots));
            SL_CHECK(patch_solver_solve_patch(&inside, X, B, 2, 1e-12, &in_region));
            assert_true(in_roots < 60 && in_region <= in_roots + 1);
            for (sl_int c = 0; c < 2; c++) {
                assert_true(largest_difference(X + c * n, Y + c * n, n) <=
                            1e-8 * largest(Y + c * n, (size_t)n));
            }
            free(Y);
            free(X);
            free(B);
            patch_solver_free(&inside);
            patch_solver_free(&roots);
            submesh_free(&p);
        }
        mesh_factor_free(&w);
    }
}

static double entries_read(const sl_stats *s) {
    return (double)s->plan.b_entries + (double)s->plan.x_entries +
           2 * (double)s->plan.region_entries;
}

/* A patch of one size in meshes of 60^2, 120^2 and 240^2 vertices: by plans to the roots a solve
 * reads more each time, in a region it reads the same. */
static void patch_cost_does_not_depend_on_the_mesh(void **state) {
    (void)state;
    double roots[3], inside[3];
    for (int k = 0; k < 3; k++) {
        sl_int side = 60 << k;
        mesh_factor_t w;
        mesh_factor_make(&w, flat_grid(side, 0));
        submesh p = grown_patch(&w, (side / 2) * side + side / 2, 300);
        patch_solver s = patch_solver_of(&w, &p);
        assert_true(p.m.n_vertices > 280 && p.m.n_vertices <= 300);
        roots[k] = entries_read(&s.stats);
        assert_int_equal(s.stats.plan.in_region, 0);
        SL_CHECK(patch_solver_use_region(&s, w.S));
        inside[k] = entries_read(&s.stats);
        assert_int_equal(s.stats.plan.in_region, 1);
        print_message("%d^2: %.0f to the roots, %.0f in the region, boundary %d\n", (int)side,
                      roots[k], inside[k], (int)s.stats.region.boundary);
        patch_solver_free(&s);
        submesh_free(&p);
        mesh_factor_free(&w);
    }
    for (int k = 1; k < 3; k++) {
        assert_true(roots[k] > 1.3 * roots[k - 1]);
        assert_true(inside[k] < 1.3 * inside[0] && inside[k] < 0.5 * roots[k]);
    }
}

/* Distances within 8 edges agree on meshes of any size, and a region reads the same number of
 * entries. */
static void distance_cost_does_not_depend_on_the_mesh(void **state) {
    (void)state;
    double heat[3], poisson[3], roots[3];
    for (int k = 0; k < 3; k++) {
        sl_int side = 60 << k, source = side * (side / 2) + side / 2;
        heat_mesh_t y;
        heat_field f, g;
        heat_patch place;
        double edge = 1.0 / (side - 1), worst = 0;
        const heat_options near = {8.1 * edge, 0, 0};
        heat_mesh_make(&y, flat_grid(side, 0), 4);
        SL_CHECK(heat_distance(&f, &y.s, &source, 1, &near));
        SL_CHECK(
            heat_patch_create(&place, &y.s, &source, 1, heat_options_patch_radius(&near), true));
        SL_CHECK(heat_patch_distance(&g, &place, &source, 1, near.radius, HEAT_SOLVES));
        assert_true(g.n == f.n && g.n_patch == f.n_patch && g.heat_stats.plan.in_region);
        for (sl_int i = 0; i < f.n; i++) {
            assert_int_equal(f.vertices[i], g.vertices[i]);
            assert_true(f.path[i] == g.path[i]);
            worst = fmax(worst, fabs(f.distance[i] - g.distance[i]));
        }
        assert_true(worst <= 1e-10 * near.radius);
        roots[k] = entries_read(&f.poisson_stats);
        heat[k] = entries_read(&g.heat_stats);
        poisson[k] = entries_read(&g.poisson_stats);
        print_message("%d^2: %.0f to the roots, %.0f and %.0f in the region, difference %.1e\n",
                      (int)side, roots[k], heat[k], poisson[k], worst / near.radius);
        heat_field_free(&g);
        heat_field_free(&f);
        heat_patch_free(&place);
        heat_mesh_free(&y);
    }
    for (int k = 1; k < 3; k++) {
        assert_true(roots[k] > 1.3 * roots[k - 1]);
        assert_true(heat[k] < 1.6 * heat[0] && poisson[k] < 1.6 * poisson[0]);
    }
}

/* Any vertices of the ball may be the sources; distances agree with plans to the roots. */
static void any_sources_in_the_ball_work(void **state) {
    (void)state;
    heat_mesh_t y;
    heat_patch roots, inside;
    sl_int center = 1000;
    heat_mesh_make(&y, torus_grid(80, 50), 4);
    SL_CHECK(heat_patch_create(&roots, &y.s, &center, 1, 1.0, false));
    SL_CHECK(heat_patch_create(&inside, &y.s, &center, 1, 1.0, true));
    sl_int n = inside.b.n;
    assert_true(n > 50 && n < y.m.n_vertices / 2);
    for (sl_int k = 0; k < n; k += n / 7) {
        heat_field f, g;
        const sl_int sources[2] = {inside.b.vertices[k], inside.b.vertices[(k + n / 2) % n]};
        SL_CHECK(heat_patch_distance(&f, &roots, sources, 1 + k % 2, 0, 60));
        SL_CHECK(heat_patch_distance(&g, &inside, sources, 1 + k % 2, 0, 60));
        assert_true(f.n == n && g.n == n);
        for (sl_int i = 0; i < n; i++) {
            assert_true(fabs(f.distance[i] - g.distance[i]) <= 1e-8);
            assert_true(isinf(g.path[i]) != (sources[0] == center && k % 2 == 0));
            assert_true(g.vertices[i] != sources[0] || g.distance[i] <= 0.2);
        }
        heat_field_free(&g);
        heat_field_free(&f);
    }
    heat_patch_free(&inside);
    heat_patch_free(&roots);
    heat_mesh_free(&y);
}

static void wrong_arguments_are_refused(void **state) {
    (void)state;
    heat_mesh_t y;
    heat_patch place;
    heat_field f;
    const sl_int twice[2] = {150, 150}, beyond = 400, low = -1, center = 150, far_off = 399;
    heat_mesh_make(&y, flat_grid(20, 0), 4);
    SL_EXPECT(SL_ERR_ARGUMENT, heat_patch_create(&place, &y.s, twice, 2, 0.2, true));
    SL_EXPECT(SL_ERR_ARGUMENT, heat_patch_create(&place, &y.s, &beyond, 1, 0.2, true));
    SL_EXPECT(SL_ERR_ARGUMENT, heat_patch_create(&place, &y.s, &low, 1, 0.2, true));
    SL_EXPECT(SL_ERR_ARGUMENT, heat_patch_create(&place, &y.s, &center, 0, 0.2, true));
    SL_EXPECT(SL_ERR_ARGUMENT, heat_patch_create(&place, &y.s, &center, 1, NAN, true));
    assert_null(place.sources);
    SL_CHECK(heat_patch_create(&place, &y.s, &center, 1, 0.2, true));
    SL_EXPECT(SL_ERR_ARGUMENT, heat_patch_distance(&f, &place, twice, 2, 0, 3));
    SL_EXPECT(SL_ERR_ARGUMENT, heat_patch_distance(&f, &place, &far_off, 1, 0, 3));
    SL_EXPECT(SL_ERR_ARGUMENT, heat_patch_distance(&f, &place, &beyond, 1, 0, 3));
    SL_EXPECT(SL_ERR_ARGUMENT, heat_patch_distance(&f, &place, &low, 1, 0, 3));
    SL_EXPECT(SL_ERR_ARGUMENT, heat_patch_distance(&f, &place, &center, 0, 0, 3));
    SL_EXPECT(SL_ERR_ARGUMENT, heat_patch_distance(&f, &place, &center, 1, -1, 3));
    SL_EXPECT(SL_ERR_ARGUMENT, heat_patch_distance(&f, &place, &center, 1, 0, 0));
    assert_null(f.vertices);
    SL_CHECK(heat_patch_distance(&f, &place, &center, 1, 0, 3));
    heat_field_free(&f);
    /* The region still has the old values. */
    SL_CHECK(heat_solver_set_time(&y.s, 2 * y.s.t));
    SL_EXPECT(SL_ERR_STALE, heat_patch_distance(&f, &place, &center, 1, 0, 3));
    heat_patch_free(&place);
    heat_mesh_free(&y);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(region_solves_match_plans_to_the_roots),
        cmocka_unit_test(patch_cost_does_not_depend_on_the_mesh),
        cmocka_unit_test(distance_cost_does_not_depend_on_the_mesh),
        cmocka_unit_test(any_sources_in_the_ball_work),
        cmocka_unit_test(wrong_arguments_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

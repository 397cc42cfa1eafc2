/* test_tools_regions.c: patches and balls solved in regions: the same answers, at a cost that does not grow with the mesh */
#include "gen.h"

#include "heat_subject.h"
#include "patch_checks.h"

#include "../tools/harmonic_map.h"
#include "../tools/heat_place.h"

/* The flux of the boundary laid on a circle: n x 2. */
static double *circle_flux(const disk *d) {
    size_t nb = (size_t)d->n_boundary;
    double *edge = test_reals(2 * nb), *b = test_reals(2 * nb);
    double *B = test_reals(2 * (size_t)d->p.m.n_vertices);
    boundary_on_circle(edge, d);
    boundary_neumann(b, edge, d->n_boundary);
    boundary_spread(B, b, d);
    free(b);
    free(edge);
    return B;
}

/* Both columns but for their means, within 1e-10 of the second's size: 1e4 epsilon times the size of the numbers, for
 * conditions to some 1e4 on these meshes. */
static void same_layout(const double *X, const double *Y, sl_int n) {
    for (sl_int c = 0; c < 2; c++) {
        assert_true(apart(X + c * n, Y + c * n, n) <= 1e-10 * largest(Y + c * n, (size_t)n));
    }
}

/* Both problems, in a region and to the roots; a second confinement changes nothing. */
static void a_confined_patch(void **state) {
    (void)state;
    for (int which = 0; which < 3; which++) {
        whole_t w;
        whole_make(&w, which == 0   ? flat_grid(70, 0.2)
                       : which == 1 ? torus_grid(60, 40)
                                    : sphere_grid(50, 2));
        for (sl_int count = 4; count < w.m.n_vertices; count *= 5) {
            disk d = grown_disk(&w, w.m.n_vertices / 2 + 25, count);
            sl_int n = d.p.m.n_vertices;
            patch_solver roots = solver_of(&w, &d.p), inside = solver_of(&w, &d.p);
            double *B = circle_flux(&d), *X = test_reals(2 * (size_t)n);
            double *Y = test_reals(2 * (size_t)n);
            int in_roots = 60, in_region = 60;
            SL_CHECK(patch_solver_confine(&inside, w.S));
            const sl_region *made = inside.region;
            SL_CHECK(patch_solver_confine(&inside, w.S));
            assert_ptr_equal(inside.region, made);
            assert_true(inside.stats.plan_in_region || inside.stats.region_boundary == 0);
            SL_CHECK(patch_solver_mesh(&roots, Y, B, 2));
            SL_CHECK(patch_solver_mesh(&inside, X, B, 2));
            same_layout(X, Y, n);
            SL_CHECK(patch_solver_part(&roots, Y, B, 2, 1e-12, &in_roots));
            SL_CHECK(patch_solver_part(&inside, X, B, 2, 1e-12, &in_region));
            assert_true(in_roots < 60 && in_region <= in_roots + 1);
            for (sl_int c = 0; c < 2; c++) {
                assert_true(apart(X + c * n, Y + c * n, n) <= 1e-8 * largest(Y + c * n, (size_t)n));
            }
            free(Y);
            free(X);
            free(B);
            patch_solver_free(&inside);
            patch_solver_free(&roots);
            disk_free(&d);
        }
        whole_free(&w);
    }
}

static double reads(const sl_stats *s) {
    return (double)s->b_entries + (double)s->x_entries + 2 * (double)s->plan_region_entries;
}

/* One patch amid a mesh of 60^2, 120^2 and 240^2: to the roots a solve reads more each time, in a region as much. */
static void a_patch_reads_as_much_in_any_mesh(void **state) {
    (void)state;
    double roots[3], inside[3];
    for (int k = 0; k < 3; k++) {
        sl_int side = 60 << k;
        whole_t w;
        whole_make(&w, flat_grid(side, 0));
        disk d = grown_disk(&w, (side / 2) * side + side / 2, 300);
        patch_solver s = solver_of(&w, &d.p);
        assert_int_equal(d.p.m.n_vertices, 300);
        roots[k] = reads(&s.stats);
        assert_int_equal(s.stats.plan_in_region, 0);
        SL_CHECK(patch_solver_confine(&s, w.S));
        inside[k] = reads(&s.stats);
        assert_int_equal(s.stats.plan_in_region, 1);
        print_message("%d^2: %.0f to the roots, %.0f in the region, boundary %d\n", (int)side,
                      roots[k], inside[k], (int)s.stats.region_boundary);
        patch_solver_free(&s);
        disk_free(&d);
        whole_free(&w);
    }
    for (int k = 1; k < 3; k++) {
        assert_true(roots[k] > 1.3 * roots[k - 1]);
        assert_true(inside[k] < 1.3 * inside[0] && inside[k] < 0.5 * roots[k]);
    }
}

/* Distances within 8 edges: the same, for meshes of any size, at the same count of what is read. */
static void a_ball_reads_as_much_in_any_mesh(void **state) {
    (void)state;
    double heat[3], poisson[3], roots[3];
    for (int k = 0; k < 3; k++) {
        sl_int side = 60 << k, source = side * (side / 2) + side / 2;
        subject_t y;
        heat_field f, g;
        heat_place place;
        double edge = 1.0 / (side - 1), worst = 0;
        const heat_reach near = {8.1 * edge, 0, 0};
        subject_make(&y, flat_grid(side, 0), 4);
        SL_CHECK(heat_distance(&f, &y.s, &source, 1, &near));
        SL_CHECK(heat_place_create(&place, &y.s, &source, 1, heat_reach_width(&near), true));
        SL_CHECK(heat_place_distance(&g, &place, &source, 1, near.radius, HEAT_SOLVES));
        assert_true(g.n == f.n && g.n_ball == f.n_ball && g.heat_stats.plan_in_region);
        for (sl_int i = 0; i < f.n; i++) {
            assert_int_equal(f.vertices[i], g.vertices[i]);
            assert_true(f.path[i] == g.path[i]);
            worst = fmax(worst, fabs(f.distance[i] - g.distance[i]));
        }
        assert_true(worst <= 1e-10 * near.radius);
        roots[k] = reads(&f.poisson_stats);
        heat[k] = reads(&g.heat_stats);
        poisson[k] = reads(&g.poisson_stats);
        print_message("%d^2: %.0f to the roots, %.0f in the region, apart %.1e\n", (int)side,
                      roots[k], poisson[k], worst / near.radius);
        heat_field_free(&g);
        heat_field_free(&f);
        heat_place_free(&place);
        subject_free(&y);
    }
    for (int k = 1; k < 3; k++) {
        assert_true(roots[k] > 1.3 * roots[k - 1]);
        assert_true(heat[k] < 1.3 * heat[0] && poisson[k] < 1.3 * poisson[0]);
    }
}

/* Whatever vertices of the place are the sources: as by plans to the roots. */
static void other_sources_of_a_place(void **state) {
    (void)state;
    subject_t y;
    heat_place roots, inside;
    sl_int centre = 1000;
    subject_make(&y, torus_grid(80, 50), 4);
    SL_CHECK(heat_place_create(&roots, &y.s, &centre, 1, 1.0, false));
    SL_CHECK(heat_place_create(&inside, &y.s, &centre, 1, 1.0, true));
    sl_int n = inside.b.n;
    assert_true(n > 50 && n < y.m.n_vertices / 2);
    for (sl_int k = 0; k < n; k += n / 7) {
        heat_field f, g;
        const sl_int sources[2] = {inside.b.vertices[k], inside.b.vertices[(k + n / 2) % n]};
        SL_CHECK(heat_place_distance(&f, &roots, sources, 1 + k % 2, 0, 60));
        SL_CHECK(heat_place_distance(&g, &inside, sources, 1 + k % 2, 0, 60));
        assert_true(f.n == n && g.n == n);
        for (sl_int i = 0; i < n; i++) {
            assert_true(fabs(f.distance[i] - g.distance[i]) <= 1e-8);
            assert_true(isinf(g.path[i]) != (sources[0] == centre && k % 2 == 0));
            assert_true(g.vertices[i] != sources[0] || g.distance[i] <= 0.2);
        }
        heat_field_free(&g);
        heat_field_free(&f);
    }
    heat_place_free(&inside);
    heat_place_free(&roots);
    subject_free(&y);
}

static void refusals(void **state) {
    (void)state;
    subject_t y;
    heat_place place;
    heat_field f;
    const sl_int twice[2] = {150, 150}, beyond = 400, low = -1, centre = 150, far_off = 399;
    subject_make(&y, flat_grid(20, 0), 4);
    SL_EXPECT(SL_ERR_ARGUMENT, heat_place_create(&place, &y.s, twice, 2, 0.2, true));
    SL_EXPECT(SL_ERR_ARGUMENT, heat_place_create(&place, &y.s, &beyond, 1, 0.2, true));
    SL_EXPECT(SL_ERR_ARGUMENT, heat_place_create(&place, &y.s, &low, 1, 0.2, true));
    SL_EXPECT(SL_ERR_ARGUMENT, heat_place_create(&place, &y.s, &centre, 0, 0.2, true));
    SL_EXPECT(SL_ERR_ARGUMENT, heat_place_create(&place, &y.s, &centre, 1, NAN, true));
    assert_null(place.sources);
    SL_CHECK(heat_place_create(&place, &y.s, &centre, 1, 0.2, true));
    SL_EXPECT(SL_ERR_ARGUMENT, heat_place_distance(&f, &place, twice, 2, 0, 3));
    SL_EXPECT(SL_ERR_ARGUMENT, heat_place_distance(&f, &place, &far_off, 1, 0, 3));
    SL_EXPECT(SL_ERR_ARGUMENT, heat_place_distance(&f, &place, &beyond, 1, 0, 3));
    SL_EXPECT(SL_ERR_ARGUMENT, heat_place_distance(&f, &place, &low, 1, 0, 3));
    SL_EXPECT(SL_ERR_ARGUMENT, heat_place_distance(&f, &place, &centre, 0, 0, 3));
    SL_EXPECT(SL_ERR_ARGUMENT, heat_place_distance(&f, &place, &centre, 1, -1, 3));
    SL_EXPECT(SL_ERR_ARGUMENT, heat_place_distance(&f, &place, &centre, 1, 0, 0));
    assert_null(f.vertices);
    SL_CHECK(heat_place_distance(&f, &place, &centre, 1, 0, 3));
    heat_field_free(&f);
    SL_CHECK(heat_solver_set_time(&y.s, 2 * y.s.t)); /* the region is of the numbers before */
    SL_EXPECT(SL_ERR_STATE, heat_place_distance(&f, &place, &centre, 1, 0, 3));
    heat_place_free(&place);
    subject_free(&y);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_confined_patch),
        cmocka_unit_test(a_patch_reads_as_much_in_any_mesh),
        cmocka_unit_test(a_ball_reads_as_much_in_any_mesh),
        cmocka_unit_test(other_sources_of_a_place),
        cmocka_unit_test(refusals),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

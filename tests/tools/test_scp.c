/* test_scp.c: spectral conformal layouts: exact on flat patches, convergent on spheres */
#include "tests/lib/gen_matrices.h"

#include "tests/lib/surfaces.h"
#include "tests/lib/real_meshes.h"

#include "tools/geometry/conformal.h"
#include "tools/geometry/distortion.h"
#include "tools/geometry/harmonic_map.h"

typedef struct layout_t {
    mesh_factor_t w;
    disk_patch d;
    patch_solver s;
    sl_int n;
    double *X, *Y, *uv, *work;
} layout_t;

/* A disk with its harmonic layout in X, computed with the factor of the mesh. */
static void layout_make(layout_t *y, mesh m, sl_int start, sl_int count) {
    mesh_factor_make(&y->w, m);
    y->d = grown_disk(&y->w, start, count);
    y->n = y->d.p.m.n_vertices;
    y->X = test_reals(2 * (size_t)y->n);
    y->Y = test_reals(2 * (size_t)y->n);
    y->uv = test_reals(2 * (size_t)y->n);
    y->work = test_reals(8 * (size_t)y->n);
    SL_CHECK(patch_solver_create(&y->s, y->w.S, y->w.F, &y->d.p));
    double *edge = test_reals(2 * (size_t)y->d.n_boundary);
    double *b = test_reals(2 * (size_t)y->d.n_boundary);
    boundary_to_circle(edge, &y->d);
    boundary_neumann_rhs(b, edge, y->d.n_boundary);
    boundary_scatter(y->X, b, &y->d);
    SL_CHECK(patch_solver_solve_mesh(&y->s, y->X, y->X, 2));
    free(b);
    free(edge);
}

static void layout_free(layout_t *y) {
    patch_solver_free(&y->s);
    free(y->X);
    free(y->Y);
    free(y->uv);
    free(y->work);
    disk_patch_free(&y->d);
    mesh_factor_free(&y->w);
}

static distortion current_distortion(layout_t *y) {
    layout_from_columns(y->uv, y->X, y->n);
    return distortion_of(&y->d.p.m, y->uv);
}

/* Runs inverse iterations on X and returns the last eigenvalue. */
static double iterate(layout_t *y, int count) {
    conformal c;
    double lambda = -1, before = INFINITY;
    SL_CHECK(conformal_create(&c, &y->d, y->s.N));
    for (int k = 0; k < count; k++) {
        SL_CHECK(conformal_iterate(&c, y->X, &lambda));
        assert_true(lambda <= before + 1e-13);
        before = lambda;
    }
    conformal_free(&c);
    return lambda;
}

static void flat_patches_are_conformal(void **state) {
    (void)state;
    layout_t y;
    layout_make(&y, flat_grid(40, 0.2), 20 * 40 + 20, 500);
    assert_true(current_distortion(&y).conformal > 1e-3); /* the start is not conformal */
    double lambda = iterate(&y, 3);
    distortion q = current_distortion(&y);
    assert_true(fabs(lambda) <= 1e-12 && fabs(q.conformal) <= 1e-10 && q.flipped == 0);
    assert_true(q.angle_ratio_max <= 1 + 1e-4 && q.area_flat > 0);
    layout_free(&y);
}

/* 1/2 X' C X is the Dirichlet energy minus the area, as computed from the singular values of the
 * faces. C is symmetric. */
static void the_energy_matches_singular_values(void **state) {
    (void)state;
    layout_t y;
    layout_make(&y, sphere_grid(25, 1), 312, 250);
    double *Z = test_reals(2 * (size_t)y.n);
    for (uint64_t seed = 1; seed < 4; seed++) {
        gen_reals(y.X, 2 * (size_t)y.n, seed);
        gen_reals(Z, 2 * (size_t)y.n, seed + 10);
        distortion q = current_distortion(&y);
        double energy = 0, one = 0, other = 0;
        SL_CHECK(conformal_apply(&y.s, &y.d, y.Y, y.X));
        for (sl_int k = 0; k < 2 * y.n; k++) {
            energy += 0.5 * y.Y[k] * y.X[k];
            one += y.Y[k] * Z[k];
        }
        assert_true(fabs(energy - q.conformal * q.area_flat) <= 1e-11 * energy);
        SL_CHECK(conformal_apply(&y.s, &y.d, y.Y, Z));
        for (sl_int k = 0; k < 2 * y.n; k++) {
            other += y.Y[k] * y.X[k];
        }
        assert_true(fabs(one - other) <= 1e-11 * energy);
    }
    free(Z);
    layout_free(&y);
}

/* C x = lambda B x holds after 5 iterations from the harmonic map. */
static void iterations_converge_to_an_eigenvector(void **state) {
    (void)state;
    for (int which = 0; which < 2; which++) {
        layout_t y;
        layout_make(&y, which ? torus_grid(60, 40) : sphere_grid(40, 1), which ? 100 : 820, 400);
        double lambda = iterate(&y, 5), worst = 0, size = 0;
        SL_CHECK(conformal_apply(&y.s, &y.d, y.Y, y.X));
        for (sl_int k = 0; k < y.d.n_boundary; k++) {
            y.Y[y.d.boundary[k]] -= lambda * y.X[y.d.boundary[k]];
            y.Y[y.n + y.d.boundary[k]] -= lambda * y.X[y.n + y.d.boundary[k]];
            size += y.X[y.d.boundary[k]] * y.X[y.d.boundary[k]] +
                    y.X[y.n + y.d.boundary[k]] * y.X[y.n + y.d.boundary[k]];
        }
        for (sl_int k = 0; k < 2 * y.n; k++) {
            worst = fmax(worst, fabs(y.Y[k]));
        }
        assert_true(lambda > 0 && fabs(size - 1) <= 1e-12);
        assert_true(worst <= 1e-3 * lambda); /* relative to B x, whose entries are about 0.1 */
        double more = iterate(&y, 10);
        assert_true(fabs(more - lambda) <= 1e-4 * lambda);
        layout_free(&y);
    }
}

/* The same cap of the sphere on finer meshes: the conformal error falls like the square of the edge
 * length. */
static void errors_fall_with_refinement(void **state) {
    (void)state;
    double before = INFINITY;
    for (sl_int side = 11; side <= 81; side = 2 * side - 1) {
        layout_t y;
        layout_make(&y, sphere_grid(side, 0.7), side * side / 2, side * side);
        (void)iterate(&y, 5);
        distortion q = current_distortion(&y);
        print_message("%d vertices: conformal error %.2e, worst angle ratio %.3f\n", (int)y.n,
                      q.conformal, q.angle_ratio_max);
        assert_int_equal(q.flipped, 0);
        assert_true(q.conformal < 0.35 * before);
        before = q.conformal;
        layout_free(&y);
    }
}

/* Descent on the factor of the mesh: every step lowers the energy, and a few steps remove most of
 * it. */
static void descent_lowers_the_energy(void **state) {
    (void)state;
    for (int which = 0; which < 2; which++) {
        layout_t y;
        layout_make(&y, which ? torus_grid(60, 40) : sphere_grid(40, 1), which ? 100 : 820, 400);
        double first = current_distortion(&y).conformal, energy = INFINITY;
        for (int k = 0; k < 5; k++) {
            distortion q = current_distortion(&y);
            assert_true(q.conformal * q.area_flat < energy);
            energy = q.conformal * q.area_flat;
            SL_CHECK(conformal_descent_step(&y.s, &y.d, y.X, y.work));
        }
        assert_true(current_distortion(&y).conformal <= 0.1 * first);
        layout_free(&y);
    }
}

static void constant_and_nan_layouts_are_refused(void **state) {
    (void)state;
    layout_t y;
    conformal c;
    double lambda;
    layout_make(&y, flat_grid(9, 0.1), 40, 20);
    for (sl_int k = 0; k < 2 * y.n; k++) {
        y.X[k] = 3;
    }
    SL_CHECK(conformal_create(&c, &y.d, y.s.N));
    SL_EXPECT(SL_ERR_NOT_FINITE, conformal_iterate(&c, y.X, &lambda));
    y.X[y.d.boundary[0]] = NAN;
    SL_EXPECT(SL_ERR_NOT_FINITE, conformal_iterate(&c, y.X, &lambda));
    conformal_free(&c);
    layout_free(&y);
}

static void check_mesh(const char *name, mesh m) {
    layout_t y;
    layout_make(&y, m, m.n_vertices / 3, 500);
    double start = current_distortion(&y).conformal, lambda = iterate(&y, 5);
    distortion q = current_distortion(&y);
    print_message("%s: lambda %.2e, conformal error %.2e, at the start %.2e\n", name, lambda,
                  q.conformal, start);
    assert_true(q.conformal < start && q.area_flat > 0);
    layout_free(&y);
}

static void real_meshes_become_more_conformal(void **state) {
    (void)state;
    static const char *const names[] = {"bunny.off.gz", "kitten.obj.gz", "mountain.obj.gz"};
    each_mesh(names, 3, INT32_MAX, check_mesh);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(flat_patches_are_conformal),
        cmocka_unit_test(the_energy_matches_singular_values),
        cmocka_unit_test(iterations_converge_to_an_eigenvector),
        cmocka_unit_test(errors_fall_with_refinement),
        cmocka_unit_test(descent_lowers_the_energy),
        cmocka_unit_test(constant_and_nan_layouts_are_refused),
        cmocka_unit_test(real_meshes_become_more_conformal),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

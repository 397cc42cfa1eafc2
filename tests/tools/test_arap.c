/* test_arap.c: as-rigid-as-possible layouts: energy never rises, developable patches flatten */
#include "tests/lib/gen_matrices.h"

#include "tests/lib/surfaces.h"
#include "tests/lib/real_meshes.h"

#include "tools/geometry/arap.h"
#include "tools/geometry/distortion.h"
#include "tools/geometry/harmonic_map.h"

enum { PATCH_FACTOR = 0 }; /* in place of a number of local solves: use the patch's own factor */

/* The start: a harmonic layout by the system of the whole mesh, with the boundary on a circle,
 * scaled to the area of the patch. */
static double *harmonic_start(const mesh_factor_t *w, const disk_patch *d) {
    sl_int n = d->p.m.n_vertices, nb = d->n_boundary;
    double *edge = test_reals(2 * (size_t)nb), *b = test_reals(2 * (size_t)nb);
    double *X = test_reals(2 * (size_t)n), *uv = test_reals(2 * (size_t)n);
    patch_solver s;
    SL_CHECK(patch_solver_create(&s, w->S, w->F, &d->p));
    boundary_to_circle(edge, d);
    boundary_neumann_rhs(b, edge, nb);
    boundary_scatter(X, b, d);
    SL_CHECK(patch_solver_solve_mesh(&s, X, X, 2));
    layout_from_columns(uv, X, n);
    distortion_normalize(&d->p.m, uv);
    layout_to_columns(X, uv, n);
    patch_solver_free(&s);
    free(uv);
    free(b);
    free(edge);
    return X;
}

/* Iterates on X and returns the last energy. Fails if the energy rises. */
static double iterate(const mesh_factor_t *w, const disk_patch *d, double *X, int solves,
                      int count) {
    patch_solver s;
    arap a;
    sl_symbolic *S = NULL;
    sl_factor *F = NULL;
    sl_options opt = options_none();
    opt.pivots = SL_PIVOTS_SKIP_NULL;
    SL_CHECK(patch_solver_create(&s, w->S, w->F, &d->p));
    assert_true(arap_create(&a, &d->p));
    const sl_csc N = sl_matrix_view(s.N);
    SL_CHECK(sl_symbolic_create(&S, &N, NULL, NULL));
    SL_CHECK(sl_factor_create(&F, S, &N, &opt, NULL));
    double energy = arap_local_step(&a, X), size = energy + 1;
    for (int k = 0; k < count; k++) {
        if (solves == PATCH_FACTOR) {
            SL_CHECK(arap_global_step_exact(&a, X, F, NULL));
        } else {
            SL_CHECK(arap_global_step(&a, X, &s, solves));
        }
        double next = arap_local_step(&a, X);
        assert_true(next <= energy + 1e-12 * size);
        energy = next;
    }
    arap_free(&a);
    patch_solver_free(&s);
    sl_factor_free(F);
    sl_symbolic_free(S);
    return energy;
}

static double energy_from_start(const mesh_factor_t *w, const disk_patch *d, int solves,
                                int count) {
    double *X = harmonic_start(w, d);
    double energy = iterate(w, d, X, solves, count);
    free(X);
    return energy;
}

/* A few local solves with the factor of the mesh do what the factor of the patch does. */
static void the_mesh_factor_matches_the_patch_factor(void **state) {
    (void)state;
    for (int which = 0; which < 3; which++) {
        mesh_factor_t w;
        mesh_factor_make(&w, which == 0   ? sphere_grid(40, 1)
                             : which == 1 ? torus_grid(50, 30)
                                          : rolled_grid(40));
        disk_patch d = grown_disk(&w, w.m.n_vertices / 2 + 20, 400);
        double own = energy_from_start(&w, &d, PATCH_FACTOR, 10);
        double one = energy_from_start(&w, &d, 1, 10), two = energy_from_start(&w, &d, 2, 10);
        double eight = energy_from_start(&w, &d, 8, 10);
        assert_true(fabs(eight - own) <= 1e-6 + 0.01 * own);
        assert_true(two <= 1e-4 + 1.1 * own && own > -1e-12);
        assert_true(one <= 0.05);
        /* All of them converge to the same energy. */
        own = energy_from_start(&w, &d, PATCH_FACTOR, 300);
        assert_true(fabs(energy_from_start(&w, &d, 1, 300) - own) <= 1e-6 + 0.01 * own);
        disk_patch_free(&d);
        mesh_factor_free(&w);
    }
}

/* A piece of a cylinder is flat at once from its unrolled boundary, and after some iterations from
 * the circle. */
static void developable_patches_become_flat(void **state) {
    (void)state;
    mesh_factor_t w;
    mesh_factor_make(&w, rolled_grid(41));
    disk_patch d = grown_disk(&w, 20 * 41 + 20, 500);
    sl_int n = d.p.m.n_vertices;
    double *edge = test_reals(2 * (size_t)d.n_boundary), *X = test_reals(2 * (size_t)n);
    double *b = test_reals(2 * (size_t)d.n_boundary), *B = test_reals(2 * (size_t)n);
    patch_solver s;
    int solves = 60;
    SL_CHECK(patch_solver_create(&s, w.S, w.F, &d.p));
    boundary_unroll(edge, &d);
    boundary_neumann_rhs(b, edge, d.n_boundary);
    boundary_scatter(B, b, &d);
    SL_CHECK(patch_solver_solve_patch(&s, X, B, 2, 1e-15, &solves));
    assert_true(iterate(&w, &d, X, 1, 0) <= 1e-18);
    /* An isometry is a fixed point, with the factor of the mesh too, for one solve or many. */
    memcpy(B, X, 2 * (size_t)n * sizeof *B);
    assert_true(iterate(&w, &d, X, 1, 3) <= 1e-18);
    assert_true(largest_difference(X, B, n) <= 1e-9 && largest_difference(X + n, B + n, n) <= 1e-9);
    assert_true(energy_from_start(&w, &d, 2, 60) <= 1e-6);
    assert_true(energy_from_start(&w, &d, PATCH_FACTOR, 60) <= 1e-6);
    patch_solver_free(&s);
    free(B);
    free(b);
    free(X);
    free(edge);
    disk_patch_free(&d);
    mesh_factor_free(&w);
}

/* The energy equals the one computed from the singular values of the faces' maps. */
static void the_energy_matches_singular_values(void **state) {
    (void)state;
    mesh_factor_t w;
    mesh_factor_make(&w, sphere_grid(25, 1));
    disk_patch d = grown_disk(&w, 300, 200);
    double *X = test_reals(400), *uv = test_reals(400);
    /* Random layouts also turn faces over. */
    for (uint64_t seed = 1; seed < 5; seed++) {
        gen_reals(X, 400, seed);
        layout_from_columns(uv, X, 200);
        distortion q = distortion_of(&d.p.m, uv);
        double energy = iterate(&w, &d, X, 1, 0);
        assert_true(q.flipped > 0);
        assert_true(fabs(q.isometric - energy) <= 1e-11 * energy);
    }
    free(uv);
    free(X);
    disk_patch_free(&d);
    mesh_factor_free(&w);
}

/* The singular values, and the measures computed from them, for linear maps of a flat patch. */
static void linear_maps_have_the_known_distortion(void **state) {
    (void)state;
    /* 2 x 2 matrices, row by row */
    static const double maps[4][4] = {{1, 0, 0, 1}, {0, -3, 3, 0}, {2, 0, 0, 0.5}, {1, 0, 0, -1}};
    static const double large[4] = {1, 3, 2, 1}, small[4] = {1, 3, 0.5, -1};
    mesh m = flat_grid(8, 0.2);
    double *uv = test_reals(128);
    for (int k = 0; k < 4; k++) {
        double a = large[k], b = small[k];
        for (sl_int v = 0; v < 64; v++) {
            const double *x = m.xyz + 3 * v;
            uv[2 * v] = maps[k][0] * x[0] + maps[k][1] * x[1] + 7;
            uv[2 * v + 1] = maps[k][2] * x[0] + maps[k][3] * x[1];
        }
        distortion q = distortion_of(&m, uv);
        assert_true(fabs(q.area - 1) <= 1e-13 && fabs(q.area_flat - a * b) <= 1e-12);
        assert_true(fabs(q.conformal * q.area_flat - 0.5 * (a - b) * (a - b)) <= 1e-12);
        assert_true(fabs(q.isometric - (a - 1) * (a - 1) - (b - 1) * (b - 1)) <= 1e-12);
        assert_int_equal(q.flipped, b < 0 ? m.n_faces : 0);
        assert_int_equal(q.degenerate, 0);
        if (b > 0) {
            assert_true(fabs(q.angle - a / b) <= 1e-11 && fabs(q.angle_ratio_max - a / b) <= 1e-11);
            assert_true(q.area_spread <= 1e-6);
            distortion_normalize(&m, uv);
            assert_true(fabs(distortion_of(&m, uv).area_flat - 1) <= 1e-12);
        }
    }
    free(uv);
    mesh_free(&m);
}

static void check_mesh(const char *name, mesh m) {
    mesh_factor_t w;
    mesh_factor_make(&w, m);
    disk_patch d = grown_disk(&w, w.m.n_vertices / 3, 500);
    double own = energy_from_start(&w, &d, PATCH_FACTOR, 10),
           two = energy_from_start(&w, &d, 2, 10);
    print_message("%s: %.5f, by the patch's own factor %.5f\n", name, two, own);
    assert_true(two <= 1.2 * own + 1e-4);
    disk_patch_free(&d);
    mesh_factor_free(&w);
}

static void real_meshes_reach_the_same_energy(void **state) {
    (void)state;
    static const char *const names[] = {"bunny.off.gz", "spot.ply.gz", "mountain.obj.gz",
                                        "hammer.obj.gz"};
    each_mesh(names, 4, INT32_MAX, check_mesh);
}

/* Steps end at 0.9 of the way to the first face that would be turned over; others stay whole. */
static void steps_turn_no_face_over(void **state) {
    (void)state;
    /* two faces at the edge from 0 to 2: the first, 0 1 2, loses its area when vertex 1 has moved
     * by 1 in the first coordinate; the second, 0 2 3, when vertex 3 has */
    const sl_int faces[6] = {0, 1, 2, 0, 2, 3};
    const double from[8] = {0, 1, 0, -1, 0, 1, 2, 1}; /* columns: x, then y */
    sl_int corners[6];
    submesh p;
    arap a;
    memset(&p, 0, sizeof p);
    memset(&a, 0, sizeof a);
    memcpy(corners, faces, sizeof faces);
    p.m.n_vertices = 4;
    p.m.n_faces = 2;
    p.m.faces = corners;
    a.p = &p;
    const struct {
        double by[2], part; /* what vertices 1 and 3 move by along x; the part of it that is left */
    } cases[] = {{{0, 0}, 1},      {{-0.5, 0.5}, 1}, {{-2, 0}, 0.45},
                 {{-2, 4}, 0.225}, {{5, -5}, 1},     {{-1, 0}, 1}};
    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
        double X[8];
        memcpy(X, from, sizeof X);
        X[1] += cases[k].by[0];
        X[3] += cases[k].by[1];
        const double part = arap_shorten_step(&a, X, from);
        assert_true(fabs(part - cases[k].part) < 1e-15);
        assert_true(fabs(X[1] - 1 - part * cases[k].by[0]) < 1e-15);
        assert_true(fabs(X[3] + 1 - part * cases[k].by[1]) < 1e-15);
    }
    /* a face that shrinks and grows again without losing its area; and one that is turned over at
     * the begin */
    double X[8] = {0, -1, 0, -1, 0, 1, -2, 1};
    assert_true(arap_shorten_step(&a, X, from) < 0.5);
    const double over[8] = {0, -1, 0, -1, 0, 1, 2, 1};
    memcpy(X, from, sizeof X);
    assert_true(arap_shorten_step(&a, X, over) == 1);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_mesh_factor_matches_the_patch_factor),
        cmocka_unit_test(developable_patches_become_flat),
        cmocka_unit_test(the_energy_matches_singular_values),
        cmocka_unit_test(linear_maps_have_the_known_distortion),
        cmocka_unit_test(real_meshes_reach_the_same_energy),
        cmocka_unit_test(steps_turn_no_face_over),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

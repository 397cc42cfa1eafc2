/* test_layout.c: layouts of surfaces: right values, energies that fall, no face flipped by slim */
#include "tests/lib/gen_matrices.h"

#include "tests/lib/surfaces.h"

#include "tools/geometry/distortion.h"
#include "tools/geometry/layout_conformal.h"
#include "tools/geometry/layout_descent.h"
#include "tools/mesh/sheet_cut.h"
#include "tools/mesh/surface_generator.h"

/* A surface that is cut open, its boundary, and its layout on a circle. */
typedef struct scene {
    mesh m;
    sheet s;
    layout_boundary b;
    layout l;
    double *uv;
} scene;

static void scene_make(scene *c, mesh m, const unsigned char *taken, layout_weights weights) {
    sl_int edges;
    c->m = m;
    assert_true(sheet_create(&c->s, &c->m, taken) && sheet_open(&c->s, &edges));
    assert_int_equal(c->s.n_parts, 1);
    assert_true(layout_boundary_find(&c->b, &c->s));
    SL_CHECK(layout_create(&c->l, &c->s.m));
    c->uv = test_reals(2 * (size_t)c->s.m.n_vertices);
    SL_CHECK(layout_on_circle(c->uv, &c->s, &c->b, weights));
    layout_normalize(&c->l, c->uv);
}

static void scene_free(scene *c) {
    layout_free(&c->l);
    layout_boundary_free(&c->b);
    sheet_free(&c->s);
    mesh_free(&c->m);
    free(c->uv);
}

static mesh surface(const char *name) {
    mesh m;
    assert_true(surface_generate(&m, name, NULL, 0));
    return m;
}

/* a^2 + b^2 + 1/a^2 + 1/b^2 of singular values from lengths: of a face with edges p, q in space and
 * P, Q in the plane, the eigenvalues of the pencil of their Gram matrices. */
static double energy_from_gram(const scene *c) {
    double sum = 0, whole = 0;
    for (sl_int f = 0; f < c->s.m.n_faces; f++) {
        const sl_int *v = c->s.m.faces + 3 * f;
        double g[3] = {0, 0, 0}, G[3] = {0, 0, 0}; /* pp pq qq */
        for (int k = 0; k < 3; k++) {
            const double o = c->s.m.xyz[3 * v[0] + k];
            const double p = c->s.m.xyz[3 * v[1] + k] - o, q = c->s.m.xyz[3 * v[2] + k] - o;
            g[0] += p * p, g[1] += p * q, g[2] += q * q;
        }
        for (int k = 0; k < 2; k++) {
            const double o = c->uv[2 * v[0] + k];
            const double p = c->uv[2 * v[1] + k] - o, q = c->uv[2 * v[2] + k] - o;
            G[0] += p * p, G[1] += p * q, G[2] += q * q;
        }
        const double det = g[0] * g[2] - g[1] * g[1], flat = G[0] * G[2] - G[1] * G[1];
        const double trace = (g[2] * G[0] - 2 * g[1] * G[1] + g[0] * G[2]) / det;
        sum += 0.5 * sqrt(det) * (trace + trace * det / flat);
        whole += 0.5 * sqrt(det);
    }
    return sum / whole;
}

static double last_energy;
static int rises;

static void watch(const void *context, const layout_descent *now) {
    (void)context;
    rises += now->last > last_energy;
    last_energy = now->last;
}

static layout_descent descent(layout_energy energy, double tolerance) {
    layout_descent d;
    memset(&d, 0, sizeof d);
    d.energy = energy;
    d.limit = 1000;
    d.tolerance = tolerance;
    d.each = watch;
    last_energy = INFINITY;
    rises = 0;
    return d;
}

/* From a layout on a circle, with and without holes, on closed surfaces and disks: no face is
 * flipped at any time, the energy falls in each step, and it is that of the singular values. At the
 * end no direction leads down; without Newton's steps it takes 27 to 662 iterations. With the
 * tolerance of the command the energy is that to a thousandth. */
static void slim_flips_nothing_and_falls(void **state) {
    (void)state;
    static const char *const names[] = {"sphere:3", "torus:24x12", "hills:20x20", "star:3"};
    for (int k = 0; k < 4; k++) {
        for (int holes = 0; holes < 2; holes++) {
            scene c;
            mesh m = surface(names[k]);
            unsigned char *taken = calloc((size_t)m.n_faces, 1);
            memset(taken, 1, (size_t)m.n_faces);
            taken[m.n_faces / 2] = taken[m.n_faces / 3] = !holes;
            scene_make(&c, m, taken, WEIGHTS_POSITIVE);
            assert_int_equal(layout_flipped(&c.l, c.uv), 0);
            layout_descent d = descent(LAYOUT_SLIM, 1e-9);
            layout_descent rough = descent(LAYOUT_SLIM, 1e-5);
            double *start = test_reals(2 * (size_t)c.s.m.n_vertices);
            memcpy(start, c.uv, 2 * (size_t)c.s.m.n_vertices * sizeof *start);
            SL_CHECK(layout_descend(&c.l, start, &rough));
            free(start);
            d = descent(LAYOUT_SLIM, 1e-9);
            SL_CHECK(layout_descend(&c.l, c.uv, &d));
            assert_true(rough.last <= 1.001 * d.last && rough.last >= d.last * (1 - 1e-9));
            print_message("%s: %d iterations, %.6f\n", names[k], d.iterations, d.last);
            assert_true(d.iterations <= 80 && (k != 1 || d.iterations <= 20));
            assert_true(d.converged && rises == 0 && d.last < d.first && d.last >= 4);
            assert_int_equal(layout_flipped(&c.l, c.uv), 0);
            assert_true(fabs(d.last - energy_from_gram(&c)) <= 1e-9 * d.last);
            const distortion q = distortion_of(&c.s.m, c.uv);
            assert_true(q.flipped == 0 && (holes > 0 || q.angle_ratio_max < 40));
            for (uint64_t seed = 1; seed < 6; seed++) {
                const size_t n = 2 * (size_t)c.s.m.n_vertices;
                double *step = test_reals(n);
                gen_reals(step, n, seed);
                for (size_t j = 0; j < n; j++) {
                    step[j] = c.uv[j] + 1e-3 * step[j];
                }
                assert_true(layout_energy_of(&c.l, step, LAYOUT_SLIM) > d.last);
                free(step);
            }
            scene_free(&c);
            free(taken);
        }
    }
}

/* A piece of a cylinder is laid out without distortion by both energies, and by the conformal
 * methods up to its scale. */
static void developable_surfaces_become_flat(void **state) {
    (void)state;
    for (int method = 0; method < 4; method++) {
        scene c;
        scene_make(&c, rolled_grid(21), NULL, WEIGHTS_POSITIVE);
        if (method < 2) {
            layout_descent d = descent(method == 0 ? LAYOUT_SLIM : LAYOUT_ARAP, 1e-12);
            SL_CHECK(layout_descend(&c.l, c.uv, &d));
            assert_true(fabs(d.last - (method == 0 ? 4 : 0)) <= 1e-6 && rises == 0);
        } else if (method == 2) {
            layout_spectrum how;
            SL_CHECK(layout_spectral(&c.l, c.uv, &c.b, 100, &how));
            assert_true(how.change <= 1e-7 && how.residual <= 1e-8 && fabs(how.lambda) <= 1e-8);
        } else {
            const sl_int ends[2] = {c.b.vertex[0], c.b.vertex[40]};
            for (int k = 0; k < 2; k++) {
                c.l.fixed[ends[k]] = 1;
                c.uv[2 * ends[k]] = k;
                c.uv[2 * ends[k] + 1] = 0;
            }
            SL_CHECK(layout_lscm(&c.l, c.uv));
            assert_true(c.uv[2 * ends[1]] == 1 && c.uv[2 * ends[0]] == 0); /* exactly */
        }
        layout_normalize(&c.l, c.uv);
        const distortion q = distortion_of(&c.s.m, c.uv);
        assert_true(q.flipped == 0 && q.angle_ratio_max <= 1 + 2e-2 && q.isometric <= 1e-4);
        scene_free(&c);
    }
}

/* Pins draw vertices to their places, without flips. */
static void pins_are_reached(void **state) {
    (void)state;
    scene c;
    scene_make(&c, flat_grid(12, 0.2), NULL, WEIGHTS_POSITIVE);
    const sl_int vertex[3] = {0, 11, 143};
    const double place[6] = {0, 0, 1.5, 0, 1.5, 1};
    sl_int here[3] = {-1, -1, -1};
    const layout_pins pins = {3, here, place};
    layout_descent d = descent(LAYOUT_SLIM, 1e-6);
    for (sl_int v = 0; v < c.s.m.n_vertices; v++) {
        for (int k = 0; k < 3; k++) {
            here[k] = c.s.vertex[v] == vertex[k] ? v : here[k];
        }
    }
    d.pins = &pins;
    SL_CHECK(layout_descend(&c.l, c.uv, &d));
    assert_true(d.converged && rises == 0 && layout_flipped(&c.l, c.uv) == 0);
    for (int k = 0; k < 6; k++) {
        assert_true(fabs(c.uv[2 * here[k / 2] + k % 2] - place[k]) < 5e-3);
    }
    scene_free(&c);
}

/* Steps end at 0.9 of the way to the first face that loses its area; others stay whole. */
static void steps_end_before_faces_flip(void **state) {
    (void)state;
    double xyz[12] = {0, 0, 0, 1, 0, 0, 0, 1, 0, -1, 1, 0};
    sl_int faces[6] = {0, 1, 2, 0, 2, 3};
    mesh m = {4, 2, xyz, faces};
    layout l;
    SL_CHECK(layout_create(&l, &m));
    const double uv[8] = {0, 0, 1, 0, 0, 1, -1, 1};
    static const struct {
        double by[2], part; /* what vertices 1 and 3 move by along u; the part that is left */
    } cases[] = {{{0, 0}, 1}, {{-0.5, 0.5}, 1}, {{-2, 0}, 0.45}, {{-2, 4}, 0.225}, {{5, -5}, 1}};
    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
        const double step[8] = {0, 0, cases[k].by[0], 0, 0, 0, cases[k].by[1], 0};
        assert_true(fabs(layout_longest_step(&l, uv, step) - cases[k].part) < 1e-12);
    }
    const double over[8] = {0, 0, 1, 0, 0, 1, 1, 1}; /* the second face is flipped */
    assert_int_equal(layout_flipped(&l, over), 1);
    layout_descent d = descent(LAYOUT_SLIM, 1e-6);
    double start[8];
    memcpy(start, over, sizeof start);
    SL_EXPECT(SL_ERR_NOT_FINITE, layout_descend(&l, start, &d));
    layout_free(&l);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(slim_flips_nothing_and_falls),
        cmocka_unit_test(developable_surfaces_become_flat),
        cmocka_unit_test(pins_are_reached),
        cmocka_unit_test(steps_end_before_faces_flip),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

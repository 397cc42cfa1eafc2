/* test_vector_heat.c: connection Laplacians, parallel transport and logarithms: exact on planes and
 * on what can be unrolled to one, near the great circles of a sphere */
#include "tests/lib/surfaces.h"

#include "tools/geometry/vector_heat.h"
#include "tools/mesh/surface_generator.h"

/* A mesh, which it owns, and its solver for a time of `times` squared mean edge lengths. */
typedef struct fixture {
    mesh m;
    vector_heat s;
} fixture;

static void make(fixture *y, mesh m, double times) {
    y->m = m;
    const double h = mesh_mean_edge_length(&y->m);
    SL_CHECK(vector_heat_create(&y->s, &y->m, times * h * h));
}

static void release(fixture *y) {
    assert_scratch_is_clean(&y->s.inc);
    vector_heat_free(&y->s);
    mesh_free(&y->m);
}

static double dot(const double *a, const double *b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static double distance(const double *a, const double *b) {
    const double d[3] = {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
    return sqrt(dot(d, d));
}

/* The largest difference of a field, as vectors in space at `base` or, if that is -1, at each
 * vertex, from what is expected for vertex v of the mesh. */
static double worst_error(const fixture *y, const vector_field *f, sl_int base,
                          void (*expected)(double *, const mesh *, sl_int, const double *),
                          const double *data) {
    double worst = 0;
    for (sl_int k = 0; k < f->n; k++) {
        double found[3], exact[3];
        connection_to_space(found, &y->s.frames, base >= 0 ? base : f->vertices[k], f->z + 2 * k);
        expected(exact, &y->m, f->vertices[k], data);
        worst = fmax(worst, distance(found, exact));
        assert_true(isfinite(found[0]));
    }
    return worst;
}

static void same_vector(double *out, const mesh *m, sl_int v, const double *data) {
    (void)m;
    (void)v;
    memcpy(out, data, 3 * sizeof *out);
}

static void difference(double *out, const mesh *m, sl_int v, const double *from) {
    for (int d = 0; d < 3; d++) {
        out[d] = m->xyz[3 * (size_t)v + (size_t)d] - from[d];
    }
}

/* On a jittered plane, turned in space, a vector stays the same and the logarithm of x is x - x0,
 * for short times and long ones, on the mesh and within a radius. */
static void planes_are_exact(void **state) {
    (void)state;
    const double turn[3][3] = {{0.36, 0.48, -0.8}, {-0.8, 0.6, 0}, {0.48, 0.64, 0.6}};
    for (int times = 1; times <= 100; times *= 10) {
        fixture y;
        mesh m = flat_grid(31, 0.2);
        for (sl_int v = 0; v < m.n_vertices; v++) {
            double *x = m.xyz + 3 * (size_t)v;
            const double flat[3] = {x[0], x[1], x[2]};
            for (int d = 0; d < 3; d++) {
                x[d] = dot(turn[d], flat);
            }
        }
        make(&y, m, times);
        assert_int_equal(y.s.frames.irregular, 0);
        for (int is_local = 0; is_local < 2; is_local++) {
            const double radius = is_local ? 0.2 : 0, planar[3] = {0.3, -1.7, 0};
            const sl_int source = 31 * 15 + 14, corner = 0;
            vector_field f;
            double z[2], vector[3];
            for (int d = 0; d < 3; d++) {
                vector[d] = dot(turn[d], planar);
            }
            connection_from_space(z, &y.s.frames, source, vector);
            assert_true(fabs(hypot(z[0], z[1]) - hypot(0.3, 1.7)) < 1e-14);
            SL_CHECK(vector_heat_transport(&f, &y.s, &source, z, 1, radius));
            assert_true(is_local ? f.n > 30 && f.n < y.m.n_vertices / 4 : f.n == y.m.n_vertices);
            assert_true(worst_error(&y, &f, -1, same_vector, vector) < 1e-11);
            vector_field_free(&f);
            for (int at = 0; at < 2; at++) {
                const sl_int from = at == 0 ? source : corner;
                SL_CHECK(vector_heat_logarithm(&f, &y.s, from, radius));
                assert_int_equal(f.unreached, 0);
                assert_true(worst_error(&y, &f, from, difference, y.m.xyz + 3 * (size_t)from) <
                            1e-11);
                vector_field_free(&f);
            }
        }
        release(&y);
    }
}

/* A rolled plane is a plane to those who live on it: logarithms have the lengths and the angles of
 * the unrolled one. */
static void rolled_planes_are_exact(void **state) {
    (void)state;
    const sl_int side = 25, source = side * 12 + 9;
    const double chord = 2 * sin(0.5 * 3.0 / (double)(side - 1)), step = 1.0 / (double)(side - 1);
    fixture y;
    vector_field f;
    make(&y, rolled_grid(side), 1);
    SL_CHECK(vector_heat_logarithm(&f, &y.s, source, 0));
    assert_int_equal(f.n, y.m.n_vertices);
    double first[2] = {0, 0}, exact_first[2] = {0, 0};
    for (sl_int k = 0; k < f.n; k++) {
        const double *z = f.z + 2 * k;
        const double u = chord * (double)(f.vertices[k] % side - source % side),
                     w = step * (double)(f.vertices[k] / side - source / side);
        assert_true(fabs(hypot(z[0], z[1]) - hypot(u, w)) < 1e-11);
        if (k == 1) { /* all angles are measured from this one */
            first[0] = z[0];
            first[1] = z[1];
            exact_first[0] = u;
            exact_first[1] = w;
        }
        assert_true(fabs((first[0] * z[1] - first[1] * z[0]) -
                         (exact_first[0] * w - exact_first[1] * u)) < 1e-12);
    }
    vector_field_free(&f);
    release(&y);
}

/* Vectors at the pole, data[0..2], moved along great circles. */
static void along_circle(double *out, const mesh *m, sl_int v, const double *data) {
    const double *x = m->xyz + 3 * (size_t)v, *pole = data + 3;
    /* the rotation that takes the pole to x */
    const double axis[3] = {pole[1] * x[2] - pole[2] * x[1], pole[2] * x[0] - pole[0] * x[2],
                            pole[0] * x[1] - pole[1] * x[0]};
    const double c = dot(pole, x), along = dot(axis, data) / (1 + c);
    for (int d = 0; d < 3; d++) {
        const int e = (d + 1) % 3, g = (d + 2) % 3;
        out[d] = c * data[d] + axis[e] * data[g] - axis[g] * data[e] + along * axis[d];
    }
}

/* The logarithm on the sphere. */
static void toward(double *out, const mesh *m, sl_int v, const double *pole) {
    const double *x = m->xyz + 3 * (size_t)v;
    double c = dot(pole, x), flat[3];
    for (int d = 0; d < 3; d++) {
        flat[d] = x[d] - c * pole[d];
    }
    const double length = sqrt(dot(flat, flat));
    for (int d = 0; d < 3; d++) {
        out[d] = length > 0 ? atan2(length, c) / length * flat[d] : 0;
    }
}

/* On a sphere, within 1.2 of the source, errors are small and fall with refinement; the solves
 * within a radius have the bits of those on the mesh. */
static void spheres_are_approximate(void **state) {
    (void)state;
    double before[2] = {INFINITY, INFINITY};
    for (int level = 3; level <= 5; level++) {
        fixture y;
        mesh m;
        char name[32];
        vector_field local, f;
        const sl_int source = 17;
        (void)snprintf(name, sizeof name, "sphere:%d", level);
        assert_true(surface_generate(&m, name, NULL, 0));
        make(&y, m, 1);
        double data[6], errors[2];
        const double z[2] = {0.6, 0.8};
        connection_to_space(data, &y.s.frames, source, z);
        memcpy(data + 3, y.m.xyz + 3 * (size_t)source, 3 * sizeof *data);
        SL_CHECK(vector_heat_transport(&local, &y.s, &source, z, 1, 1.2));
        SL_CHECK(vector_heat_transport(&f, &y.s, &source, z, 1, 0));
        for (sl_int k = 0, at = 0; k < local.n; k++, at = 0) {
            while (f.vertices[at] != local.vertices[k]) {
                at++;
            }
            assert_memory_equal(f.z + 2 * at, local.z + 2 * k, 2 * sizeof *f.z);
        }
        errors[0] = worst_error(&y, &local, -1, along_circle, data);
        vector_field_free(&f);
        vector_field_free(&local);
        SL_CHECK(vector_heat_logarithm(&local, &y.s, source, 1.2));
        errors[1] = worst_error(&y, &local, source, toward, data + 3);
        vector_field_free(&local);
        print_message("sphere, %d vertices: errors of transport %.5f, of logarithms %.5f\n",
                      (int)y.m.n_vertices, errors[0], errors[1]);
        for (int k = 0; k < 2; k++) {
            assert_true(errors[k] < 0.7 * before[k]);
            before[k] = errors[k];
        }
        release(&y);
    }
    assert_true(before[0] < 0.02 && before[1] < 0.02);
}

/* Half way between two sources lies the end of the realm of each. */
static void the_nearest_source_counts(void **state) {
    (void)state;
    const sl_int side = 41, sources[2] = {side * 20 + 5, side * 20 + 35};
    const double vectors[4] = {1, 0, 0, 3};
    fixture y;
    vector_field f;
    double space[2][3];
    make(&y, flat_grid(side, 0.2), 1);
    SL_CHECK(vector_heat_transport(&f, &y.s, sources, vectors, 2, 0));
    for (int k = 0; k < 2; k++) {
        connection_to_space(space[k], &y.s.frames, sources[k], vectors + 2 * k);
    }
    for (sl_int k = 0; k < f.n; k++) {
        const sl_int column = f.vertices[k] % side;
        double found[3];
        connection_to_space(found, &y.s.frames, f.vertices[k], f.z + 2 * k);
        if (column < 15 || column > 25) {
            assert_true(distance(found, space[column > 20]) < 0.01);
        }
    }
    vector_field_free(&f);
    release(&y);
}

/* H of a mesh of any kind is definite with a mass: no pivot is negative. Borders of more than two
 * faces, faces of unlike orientation and without area, and repeated vertices are of no harm. */
static void defects_are_borders(void **state) {
    (void)state;
    double xyz[] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, -1, 0, 0.5, 0.5, 1, 2, 2, 2, 3, 3, 3, 4, 4, 4};
    sl_int faces[] = {0, 1, 2, 1, 0, 3, 0, 1, 4, /* three faces at one edge */
                      2, 1, 0,                   /* the first one from behind */
                      2, 1, 4, 5, 6, 7,          /* a needle */
                      3, 3, 4};
    mesh m = {8, 7, xyz, faces};
    connection c;
    sl_matrix *A = NULL;
    sl_symbolic *S = NULL;
    sl_factor *F = NULL;
    sl_stats stats = {0};
    assert_true(connection_create(&c, &m));
    assert_true(c.irregular >= 3);
    SL_CHECK(connection_system(&A, &c, 0.5));
    const sl_csc view = sl_matrix_view(A);
    SL_CHECK(sl_symbolic_create(&S, &view, NULL, NULL));
    SL_CHECK(sl_factor_create(&F, S, &view, NULL, &stats));
    assert_int_equal(stats.factor.positive, 16);
    sl_factor_free(F);
    sl_symbolic_free(S);
    sl_matrix_free(A);
    assert_int_equal(connection_system(&A, &c, -1), SL_ERR_ARGUMENT);
    assert_int_equal(connection_system(&A, &c, NAN), SL_ERR_ARGUMENT);
    connection_free(&c);
    faces[4] = 8;
    assert_false(connection_create(&c, &m));
    assert_null(c.axes);
    vector_heat s;
    assert_int_equal(vector_heat_create(&s, &m, 1), SL_ERR_ARGUMENT);
}

static void wrong_sources_are_refused(void **state) {
    (void)state;
    const double z[4] = {1, 0, 0, 1}, infinite[2] = {INFINITY, 0};
    const sl_int none = -1, twice[2] = {3, 3}, good = 3;
    fixture y;
    vector_field f;
    vector_heat s;
    make(&y, flat_grid(5, 0), 1);
    assert_int_equal(vector_heat_transport(&f, &y.s, &none, z, 1, 0), SL_ERR_ARGUMENT);
    assert_int_equal(vector_heat_transport(&f, &y.s, twice, z, 2, 0), SL_ERR_ARGUMENT);
    assert_int_equal(vector_heat_transport(&f, &y.s, &good, z, 0, 0), SL_ERR_ARGUMENT);
    assert_int_equal(vector_heat_transport(&f, &y.s, &good, z, 1, NAN), SL_ERR_ARGUMENT);
    assert_int_equal(vector_heat_transport(&f, &y.s, &good, infinite, 1, 0), SL_ERR_ARGUMENT);
    assert_int_equal(vector_heat_logarithm(&f, &y.s, 25, 0), SL_ERR_ARGUMENT);
    assert_int_equal(vector_heat_logarithm(&f, &y.s, 3, -1), SL_ERR_ARGUMENT);
    assert_null(f.vertices);
    assert_int_equal(vector_heat_create(&s, &y.m, 0), SL_ERR_ARGUMENT);
    assert_int_equal(vector_heat_create(&s, &y.m, NAN), SL_ERR_ARGUMENT);
    release(&y);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(planes_are_exact),        cmocka_unit_test(rolled_planes_are_exact),
        cmocka_unit_test(spheres_are_approximate), cmocka_unit_test(the_nearest_source_counts),
        cmocka_unit_test(defects_are_borders),     cmocka_unit_test(wrong_sources_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

/* test_tools_geodesic_exact.c: the heat method against exact distances on planes and spheres, and against paths on
 * other surfaces */
#include "heat_subject.h"

#include "../tools/ball.h"
#include "../tools/patch.h"

typedef double (*exact_distance)(const double *a, const double *b);

static double on_unit_sphere(const double *a, const double *b) {
    return 2 * asin(fmin(1, 0.5 * in_space(a, b)));
}

static double mean_error(const subject_t *y, const double *d, sl_int source, double radius,
                         exact_distance exact) {
    double sum = 0;
    sl_int count = 0;
    for (sl_int v = 0; v < y->m.n_vertices; v++) {
        double x = exact(y->m.xyz + 3 * (size_t)source, y->m.xyz + 3 * (size_t)v);
        if (x <= radius && !isnan(d[v])) {
            sum += fabs(d[v] - x);
            count++;
        }
    }
    assert_true(count > 50);
    return sum / count;
}

/* On a plane and on a sphere errors fall with refinement, in full and within a radius. */
static void errors_fall(void **state) {
    (void)state;
    for (int sphere = 0; sphere < 2; sphere++) {
        double before[2] = {INFINITY, INFINITY};
        for (sl_int side = 41; side <= 161; side = 2 * side - 1) {
            subject_t y;
            sl_int source = side * (side / 2) + side / 2;
            const heat_reach near = {0.3, 0, 0};
            subject_make(&y, sphere ? sphere_grid(side, 1) : flat_grid(side, 0.2), 8);
            exact_distance exact = sphere ? on_unit_sphere : in_space;
            double *full = by_vertex(&y, &source, 1, NULL);
            double *local = by_vertex(&y, &source, 1, &near);
            double errors[2] = {mean_error(&y, full, source, 0.28, exact),
                                mean_error(&y, local, source, 0.28, exact)};
            print_message("%s, %d vertices: mean error in full %.5f, within 0.3 %.5f\n",
                          sphere ? "sphere" : "plane", (int)y.m.n_vertices, errors[0], errors[1]);
            for (int k = 0; k < 2; k++) {
                assert_true(errors[k] < 0.8 * before[k]);
                before[k] = errors[k];
            }
            free(local);
            free(full);
            subject_free(&y);
        }
        assert_true(before[0] < 0.003 && before[1] < 0.003);
    }
}

/* The number of the i-th of the points that cut the edge from u to v into `parts`. */
static sl_int point_on_edge(const adjacency *edges, sl_int u, sl_int v, sl_int i, sl_int parts) {
    sl_int low = u < v ? u : v, high = u < v ? v : u;
    sl_off p = edges->begin[low];
    while (edges->neighbour[p] != high) {
        p++;
    }
    return edges->n + (sl_int)p * (parts - 1) + (u < v ? i : parts - i) - 1;
}

/* A mesh whose edges are all the segments between points of the same face of m, each edge of m cut into `parts`: its
 * shortest paths are next to those on the surface of m. The vertices of m come first. */
static mesh path_mesh(const mesh *m, sl_int parts) {
    adjacency edges;
    assert_true(adjacency_from_mesh(&edges, m));
    sl_int around = 3 * parts, points[64], *out;
    mesh fine = {m->n_vertices + (sl_int)edges.begin[m->n_vertices] * (parts - 1),
                 m->n_faces * (around * (around - 1) / 2), NULL, NULL};
    assert_true(around <= 64);
    fine.xyz = test_reals(3 * (size_t)fine.n_vertices);
    fine.faces = out = test_ints(3 * (size_t)fine.n_faces);
    memcpy(fine.xyz, m->xyz, 3 * (size_t)m->n_vertices * sizeof(double));
    for (sl_int f = 0; f < m->n_faces; f++) {
        const sl_int *face = m->faces + 3 * (size_t)f;
        for (sl_int k = 0; k < around; k++) {
            sl_int u = face[k / parts], v = face[(k / parts + 1) % 3], i = k % parts;
            points[k] = i == 0 ? u : point_on_edge(&edges, u, v, i, parts);
            for (int c = 0; c < 3; c++) {
                double t = (double)i / parts;
                fine.xyz[3 * points[k] + c] = (1 - t) * m->xyz[3 * u + c] + t * m->xyz[3 * v + c];
            }
        }
        for (sl_int j = 0; j < around; j++) { /* each pair, as two corners of a face */
            for (sl_int k = j + 1; k < around; k++) {
                *out++ = points[j];
                *out++ = points[k];
                *out++ = points[k + 1 < around ? k + 1 : j > 0 ? 0 : 1];
            }
        }
    }
    adjacency_free(&edges);
    return fine;
}

/* Mean difference on a torus of 2 side x side squares, against the farthest distance. */
static double error_on_a_torus(sl_int side) {
    subject_t y;
    sl_int source = 7, count = 0;
    double sum = 0, farthest = 0;
    incidence around;
    ball b;
    subject_make(&y, torus_grid(2 * side, side), 4);
    mesh fine = path_mesh(&y.m, 3);
    assert_true(incidence_create(&around, &fine));
    assert_true(ball_find(&b, &around, &source, 1, INFINITY));
    double *d = by_vertex(&y, &source, 1, NULL);
    for (sl_int k = 0; k < b.n; k++) {
        if (b.vertices[k] < y.m.n_vertices) {
            sum += fabs(d[b.vertices[k]] - b.along_edges[k]);
            farthest = fmax(farthest, b.along_edges[k]);
            count++;
        }
    }
    assert_int_equal(count, y.m.n_vertices);
    free(d);
    ball_free(&b);
    incidence_free(&around);
    mesh_free(&fine);
    subject_free(&y);
    print_message("torus, %d vertices: mean error %.4f, of distances up to %.3f\n", (int)count,
                  sum / count, farthest);
    return sum / count / farthest;
}

/* A torus has no closed form here, and a long line where distances from two sides meet, which the method rounds off:
 * against paths that are found in an independent way. */
static void paths_on_a_torus(void **state) {
    (void)state;
    double coarse = error_on_a_torus(25), fine = error_on_a_torus(50);
    assert_true(fine < 0.6 * coarse && fine < 0.02);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(errors_fall),
        cmocka_unit_test(paths_on_a_torus),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

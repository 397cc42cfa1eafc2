/* test_geodesic_exact.c: the heat method against exact distances and shortest paths */
#include "tests/lib/heat_mesh.h"

#include "tools/mesh/graph_ball.h"
#include "tools/mesh/adjacency.h"
#include "tools/geometry/straight_lines.h"

typedef double (*exact_distance)(const double *a, const double *b);

static double on_unit_sphere(const double *a, const double *b) {
    return 2 * asin(fmin(1, 0.5 * euclidean_distance(a, b)));
}

static double mean_error(const heat_mesh_t *y, const double *d, sl_int source, double radius,
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

/* On a plane and on a sphere the errors fall with refinement, on the whole mesh and within a
 * radius. */
static void errors_fall_with_refinement(void **state) {
    (void)state;
    for (int sphere = 0; sphere < 2; sphere++) {
        double before[2] = {INFINITY, INFINITY};
        for (sl_int side = 41; side <= 161; side = 2 * side - 1) {
            heat_mesh_t y;
            sl_int source = side * (side / 2) + side / 2;
            const heat_options near = {0.3, 0, 0};
            heat_mesh_make(&y, sphere ? sphere_grid(side, 1) : flat_grid(side, 0.2), 8);
            exact_distance exact = sphere ? on_unit_sphere : euclidean_distance;
            double *full = distance_by_vertex(&y, &source, 1, NULL);
            double *local = distance_by_vertex(&y, &source, 1, &near);
            double errors[2] = {mean_error(&y, full, source, 0.28, exact),
                                mean_error(&y, local, source, 0.28, exact)};
            print_message("%s, %d vertices: mean error on the whole mesh %.5f, within 0.3 %.5f\n",
                          sphere ? "sphere" : "plane", (int)y.m.n_vertices, errors[0], errors[1]);
            for (int k = 0; k < 2; k++) {
                assert_true(errors[k] < 0.8 * before[k]);
                before[k] = errors[k];
            }
            free(local);
            free(full);
            heat_mesh_free(&y);
        }
        assert_true(before[0] < 0.003 && before[1] < 0.003);
    }
}

/* Number of the i-th of the points that divide the edge from u to v into `parts`. */
static sl_int point_on_edge(const adjacency *edges, sl_int u, sl_int v, sl_int i, sl_int parts) {
    sl_int low = u < v ? u : v, high = u < v ? v : u;
    sl_off p = edges->begin[low];
    while (edges->neighbor[p] != high) {
        p++;
    }
    return edges->n + (sl_int)p * (parts - 1) + (u < v ? i : parts - i) - 1;
}

/* A mesh with all segments between points of the same face of m as edges, where each edge of m is
 * divided into `parts`. Its shortest paths are close to those on the surface of m. The vertices of
 * m come first. */
static mesh path_mesh(const mesh *m, sl_int parts) {
    adjacency edges;
    assert_true(adjacency_from_mesh(&edges, m));
    sl_int inc = 3 * parts, points[64], *out;
    mesh fine = {m->n_vertices + (sl_int)edges.begin[m->n_vertices] * (parts - 1),
                 m->n_faces * (inc * (inc - 1) / 2), NULL, NULL};
    assert_true(inc <= 64);
    fine.xyz = test_reals(3 * (size_t)fine.n_vertices);
    fine.faces = out = test_ints(3 * (size_t)fine.n_faces);
    memcpy(fine.xyz, m->xyz, 3 * (size_t)m->n_vertices * sizeof(double));
    for (sl_int f = 0; f < m->n_faces; f++) {
        const sl_int *face = m->faces + 3 * (size_t)f;
        for (sl_int k = 0; k < inc; k++) {
            sl_int u = face[k / parts], v = face[(k / parts + 1) % 3], i = k % parts;
            points[k] = i == 0 ? u : point_on_edge(&edges, u, v, i, parts);
            for (int c = 0; c < 3; c++) {
                double t = (double)i / parts;
                fine.xyz[3 * points[k] + c] = (1 - t) * m->xyz[3 * u + c] + t * m->xyz[3 * v + c];
            }
        }
        /* Each pair of points is an edge of some face. */
        for (sl_int j = 0; j < inc; j++) {
            for (sl_int k = j + 1; k < inc; k++) {
                *out++ = points[j];
                *out++ = points[k];
                *out++ = points[k + 1 < inc ? k + 1 : j > 0 ? 0 : 1];
            }
        }
    }
    adjacency_free(&edges);
    return fine;
}

/* Mean difference on a torus of 2 side x side squares, relative to the largest distance. */
static double error_on_a_torus(sl_int side) {
    heat_mesh_t y;
    sl_int source = 7, count = 0;
    double sum = 0, farthest = 0;
    incidence inc;
    graph_ball b;
    heat_mesh_make(&y, torus_grid(2 * side, side), 4);
    mesh fine = path_mesh(&y.m, 3);
    assert_true(incidence_create(&inc, &fine));
    assert_true(graph_ball_create(&b, &inc, &source, 1, INFINITY));
    double *d = distance_by_vertex(&y, &source, 1, NULL);
    for (sl_int k = 0; k < b.n; k++) {
        if (b.vertices[k] < y.m.n_vertices) {
            sum += fabs(d[b.vertices[k]] - b.path_length[k]);
            farthest = fmax(farthest, b.path_length[k]);
            count++;
        }
    }
    assert_int_equal(count, y.m.n_vertices);
    free(d);
    graph_ball_free(&b);
    incidence_free(&inc);
    mesh_free(&fine);
    heat_mesh_free(&y);
    print_message("torus, %d vertices: mean error %.4f, of distances up to %.3f\n", (int)count,
                  sum / count, farthest);
    return sum / count / farthest;
}

/* A torus has no closed form here, and a long ridge where distances from two sides meet, which the
 * method rounds off. Its distances are compared with shortest paths found independently. */
static void torus_distances_match_shortest_paths(void **state) {
    (void)state;
    double coarse = error_on_a_torus(25), fine = error_on_a_torus(50);
    assert_true(fine < 0.6 * coarse && fine < 0.02);
}

/* Of many sources, which cover parts of a plane, all are at 0, and the distances of the heat method
 * alone are near the exact ones. Straight lines only raise them, to no more than the exact ones. */
static void many_sources_are_all_at_zero(void **state) {
    (void)state;
    heat_mesh_t y;
    enum { SIDE = 41 };
    sl_int sources[2 * SIDE], count = 0;
    heat_mesh_make(&y, flat_grid(SIDE, 0.2), 4);
    for (sl_int k = 0; k < SIDE; k++) { /* one side, and every fourth vertex of the other */
        sources[count++] = k;
        if (k % 4 == 0) {
            sources[count++] = SIDE * (SIDE - 1) + k;
        }
    }
    heat_field f;
    double largest = 0, worst[2] = {0, 0};
    SL_CHECK(heat_distance(&f, &y.s, sources, count, NULL));
    assert_true(f.pinned);
    for (int pass = 0; pass < 2; pass++) {
        for (sl_int k = 0; k < f.n; k++) {
            double exact = INFINITY;
            for (sl_int i = 0; i < count; i++) {
                exact = fmin(exact, euclidean_distance(y.m.xyz + 3 * (size_t)f.vertices[k],
                                                       y.m.xyz + 3 * (size_t)sources[i]));
            }
            assert_true(exact > 0 || f.distance[k] == 0);
            assert_true(pass == 0 || f.distance[k] >= exact * (1 - 2e-12));
            worst[pass] = fmax(worst[pass], fabs(f.distance[k] - exact));
        }
        const sl_int raised = straight_lines_raise(f.distance, &y.m, f.vertices, f.n, sources,
                                                   count, NULL, 0, &largest);
        assert_true(pass == 0 ? raised > 0 : raised == 0);
    }
    print_message("%d sources: largest error %.4f, with straight lines %.4f\n", (int)count,
                  worst[0], worst[1]);
    assert_true(worst[0] < 2.0 / SIDE && worst[1] <= worst[0] && largest <= worst[0]);
    heat_field_free(&f);
    /* with one local solve, and from one source, nothing is held */
    const heat_options cut = {0, 0, 1};
    SL_CHECK(heat_distance(&f, &y.s, sources, count, &cut));
    assert_false(f.pinned);
    heat_field_free(&f);
    SL_CHECK(heat_distance(&f, &y.s, sources, 1, NULL));
    assert_false(f.pinned);
    f.distance[0] = NAN;
    assert_true(
        straight_lines_raise(f.distance, &y.m, f.vertices, 1, sources, 1, NULL, 0, &largest) == 0);
    heat_field_free(&f);
    heat_mesh_free(&y);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(errors_fall_with_refinement),
        cmocka_unit_test(torus_distances_match_shortest_paths),
        cmocka_unit_test(many_sources_are_all_at_zero),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

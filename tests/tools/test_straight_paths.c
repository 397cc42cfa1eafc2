/* test_straight_paths.c: straightened paths over faces against exact distances */
#define _POSIX_C_SOURCE 200809L
#include "tests/lib/heat_mesh.h"

#include "tools/geometry/edge_curve.h"
#include "tools/geometry/laplacian.h"
#include "tools/geometry/straight_lines.h"
#include "tools/geometry/surface_paths.h"
#include "tools/mesh/surface_generator.h"

/* Searches with 3 points of each edge and with 15 from some sources; straightens the former. */
typedef struct searches {
    incidence inc;
    surface_search *three, *fifteen;
    sl_int *all;
    const double *straight;
} searches;

static void search(searches *s, const mesh *m, const sl_int *sources, sl_int count) {
    assert_true(incidence_create(&s->inc, m));
    assert_true(surface_search_create(&s->three, &s->inc, 3));
    assert_true(surface_search_create(&s->fifteen, &s->inc, 15));
    assert_true(surface_search_run(s->three, sources, count, INFINITY));
    assert_true(surface_search_run(s->fifteen, sources, count, INFINITY));
    s->all = test_ints((size_t)m->n_vertices);
    for (sl_int v = 0; v < m->n_vertices; v++) {
        s->all[v] = v;
    }
    s->straight = surface_search_straighten(s->three, s->all, m->n_vertices);
    assert_non_null(s->straight);
}

static void end_search(searches *s) {
    free(s->all);
    surface_search_free(s->fifteen);
    surface_search_free(s->three);
    incidence_free(&s->inc);
}

/* On meshes with a plane, hills, spikes and a hole, from a vertex and from a curve of vertices:
 * straightened paths are no longer than those through 3 points, and exceed the shortest ones known,
 * which are 15 points of each edge or straightened as well, by less than 0.1 edges on average. */
static void paths_are_nearly_the_shortest(void **state) {
    (void)state;
    static const char *const names[] = {"grid:40x40", "hills:40x40", "star:4", "torus:60x24"};
    for (size_t k = 0; k < sizeof names / sizeof *names; k++) {
        for (sl_int count = 1; count <= 30; count += 29) {
            mesh m;
            searches s;
            sl_int sources[30];
            double over = 0, through = 0;
            assert_true(surface_generate(&m, names[k], NULL, 0));
            for (sl_int i = 0; i < count; i++) {
                sources[i] = 100 + i; /* a row of the grids */
            }
            search(&s, &m, sources, count);
            const double *u3 = surface_search_lengths(s.three);
            const double *u15 = surface_search_lengths(s.fifteen);
            for (sl_int v = 0; v < m.n_vertices; v++) {
                const double best = fmin(s.straight[v], u15[v]);
                assert_true(s.straight[v] <= u3[v]);
                assert_true((s.straight[v] == 0) == (u3[v] == 0));
                over += s.straight[v] - best;
                through += u3[v] - best;
            }
            const double edges = mesh_mean_edge_length(&m) * (double)m.n_vertices;
            print_message("%s, %d sources: too long by %.4f edges, before by %.4f\n", names[k],
                          (int)count, over / edges, through / edges);
            assert_true(over / edges < 0.02 && over < 0.2 * through);
            end_search(&s);
            mesh_free(&m);
        }
    }
}

/* In a plane, also with triangles of all shapes and around a hole, no path is shorter than the
 * straight line, and where that stays in the plane it is the path to within 0.1 edges. */
static void paths_in_a_plane_are_straight(void **state) {
    (void)state;
    for (int which = 0; which < 3; which++) {
        mesh m = flat_grid(31, which == 0 ? 0 : 0.3);
        searches s;
        const sl_int source = 31 * 15 + 5;
        double worst = 0, around = 0;
        sl_int kept = 0;
        for (sl_int f = 0; f < m.n_faces && which == 2; f++) { /* cut a hole of radius 0.2 */
            double x = 0, y = 0;
            for (int c = 0; c < 3; c++) {
                x += m.xyz[3 * m.faces[3 * f + c]] / 3 - 0.5 / 3;
                y += m.xyz[3 * m.faces[3 * f + c] + 1] / 3 - 0.5 / 3;
            }
            if (hypot(x, y) > 0.2) {
                memmove(m.faces + 3 * kept++, m.faces + 3 * f, 3 * sizeof *m.faces);
            }
        }
        m.n_faces = which == 2 ? kept : m.n_faces;
        search(&s, &m, &source, 1);
        for (sl_int v = 0; v < m.n_vertices; v++) {
            const double *x = m.xyz + 3 * v, *y = m.xyz + 3 * source;
            const double line = hypot(x[0] - y[0], x[1] - y[1]);
            const bool is_seen = which < 2 || x[0] < 0.25;
            if (isfinite(s.straight[v])) {
                assert_true(s.straight[v] >= line * (1 - 1e-12));
                worst = is_seen ? fmax(worst, s.straight[v] - line) : worst;
                around = fmax(around, s.straight[v] - line);
            }
        }
        print_message("plane %d: too long by %.4f, around the hole by %.4f\n", which, worst,
                      around);
        assert_true(worst < 0.1 * mesh_mean_edge_length(&m));
        assert_true(which < 2 || around > 0.02);
        end_search(&s);
        mesh_free(&m);
    }
}

static double to_segment(const double *p, const double *a, const double *b) {
    const double x = b[0] - a[0], y = b[1] - a[1];
    const double along = ((p[0] - a[0]) * x + (p[1] - a[1]) * y) / (x * x + y * y);
    const double share = fmin(1, fmax(0, along));
    return hypot(p[0] - a[0] - share * x, p[1] - a[1] - share * y);
}

/* In a plane of uneven triangles, paths from a curve start anywhere on its edges: they are the line
 * to the nearest point of it, which vertices alone miss by ten times as much near it. The lines of
 * straight_lines_raise are those. The curve goes around two corners, and between given vertices
 * along shortest paths; none leads to another part. */
static void curves_are_sources_everywhere(void **state) {
    (void)state;
    enum { SIDE = 31 };
    mesh m = flat_grid(SIDE, 0.3);
    edge_curve curve = {{NULL, 0, 0}, {NULL, 0, 0}};
    const sl_int through[4] = {5 * SIDE + 5, 5 * SIDE + 20, 20 * SIDE + 20, 20 * SIDE + 21};
    const sl_int nowhere[2] = {5 * SIDE + 5, m.n_vertices - 1};
    sl_int gap = 0;
    assert_true(edge_curve_add(&curve, &m, through, 4, &gap) && gap == -1);
    assert_true(edge_curve_add(&curve, &m, through, 1, &gap)); /* adds nothing new */
    const sl_int n_edges = (sl_int)(curve.ends.count / 2), n = m.n_vertices;
    assert_true(n_edges >= 31 && curve.vertices.count == (size_t)n_edges + 1);
    double *lines = test_reals((size_t)n), largest = 0, worst = 0, mean = 0, vertices = 0;
    const double edge = mesh_mean_edge_length(&m);
    searches s;
    assert_true(incidence_create(&s.inc, &m) && surface_search_create(&s.three, &s.inc, 3));
    assert_true(surface_search_set_curve(s.three, curve.ends.at, n_edges));
    assert_false(surface_search_set_curve(s.three, nowhere, 1)); /* no edge */
    assert_true(surface_search_set_curve(s.three, curve.ends.at, n_edges));
    assert_true(surface_search_run(s.three, curve.vertices.at, n_edges + 1, INFINITY));
    s.all = test_ints((size_t)n);
    for (sl_int v = 0; v < n; v++) {
        s.all[v] = v;
        lines[v] = 0;
    }
    s.straight = surface_search_straighten(s.three, s.all, n);
    assert_true(straight_lines_raise(lines, &m, s.all, n, curve.vertices.at, n_edges + 1,
                                     curve.ends.at, n_edges, &largest) == n - n_edges - 1);
    for (sl_int v = 0; v < n; v++) {
        double best = INFINITY, near = INFINITY;
        for (sl_int k = 0; k < 2 * n_edges; k += 2) {
            const double *a = m.xyz + 3 * curve.ends.at[k], *b = m.xyz + 3 * curve.ends.at[k + 1];
            best = fmin(best, to_segment(m.xyz + 3 * v, a, b));
            near = fmin(near, hypot(m.xyz[3 * v] - a[0], m.xyz[3 * v + 1] - a[1]));
            near = fmin(near, hypot(m.xyz[3 * v] - b[0], m.xyz[3 * v + 1] - b[1]));
        }
        assert_true(fabs(lines[v] - best) <= 1e-14 && s.straight[v] >= best - 1e-12);
        worst = fmax(worst, s.straight[v] - best);
        mean += best < 1.5 * edge ? s.straight[v] - best : 0;
        vertices += best < 1.5 * edge ? near - best : 0;
    }
    print_message("from a curve: off by %.4f edges; those of its vertices near it %.0f times\n",
                  worst / edge, vertices / mean);
    assert_true(worst < 0.1 * edge && mean < 0.1 * vertices);
    mesh two = m; /* without the faces at the last vertex */
    for (sl_int f = two.n_faces = 0; f < m.n_faces; f++) {
        const sl_int *c = m.faces + 3 * f;
        if (c[0] != n - 1 && c[1] != n - 1 && c[2] != n - 1) {
            memmove(two.faces + 3 * two.n_faces++, c, 3 * sizeof *c);
        }
    }
    assert_true(!edge_curve_add(&curve, &two, nowhere, 2, &gap) && gap == 0);
    edge_curve_free(&curve);
    free(lines);
    free(s.all);
    surface_search_free(s.three);
    incidence_free(&s.inc);
    mesh_free(&m);
}

/* What no path reaches has no length, and faces that are not a surface end no program: repeated
 * vertices, three faces at an edge, no area, all of it upside down. */
static void bad_meshes_have_lengths(void **state) {
    (void)state;
    double xyz[21] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, -1, 0, 0, 0, 1, 2, 0, 0, 9, 9, 9};
    sl_int faces[18] = {0, 1, 2, 1, 0, 3, 0, 1, 4, 0, 0, 1, 0, 1, 5, 2, 2, 2};
    const mesh m = {7, 6, xyz, faces};
    const sl_int source = 2;
    searches s;
    search(&s, &m, &source, 1);
    for (sl_int v = 0; v < 7; v++) {
        const double length = surface_search_lengths(s.three)[v];
        assert_true(v == 6 ? s.straight[v] == INFINITY && length == INFINITY
                           : s.straight[v] <= length);
    }
    assert_true(fabs(s.straight[4] - 2) < 1e-12 || s.straight[4] > 1.5);
    end_search(&s);
}

/* Distances between the path less the slack and the path stay; others become the path. */
static void distances_are_corrected(void **state) {
    (void)state;
    double d[6] = {0.95, 0.8, 3, NAN, 7, -1};
    const sl_int at[6] = {0, 1, 2, 3, 4, 5};
    const double straight[6] = {1, 1, 1, 1, INFINITY, 0.05};
    const surface_correction c = surface_paths_correct(d, at, 6, straight, 0.1);
    assert_true(c.kept == 1 && c.raised == 2 && c.lowered == 1 && c.largest == 2);
    assert_true(d[0] == 0.95 && d[1] == 1 && d[2] == 1 && isnan(d[3]) && d[4] == 7 && d[5] == 0.05);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(paths_are_nearly_the_shortest),
        cmocka_unit_test(paths_in_a_plane_are_straight),
        cmocka_unit_test(curves_are_sources_everywhere),
        cmocka_unit_test(bad_meshes_have_lengths),
        cmocka_unit_test(distances_are_corrected),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

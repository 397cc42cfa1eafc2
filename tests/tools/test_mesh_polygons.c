/* test_mesh_polygons.c: polygons that are not convex are divided by ears */
#define _POSIX_C_SOURCE 200809L
#include "tests/lib/temporary_files.h"

#include "tools/mesh/mesh.h"
#include "tools/mesh/polygon_ears.h"

/* Writes a polygon in the plane as an OBJ file, turned by a quarter about `axis` (0: not), and
 * pushed away from the origin, from its corner `first` on. */
static const char *put_polygon(double (*at)[2], int corners, int axis, int first) {
    static char text[200000];
    size_t used = 0;
    for (int k = 0; k < corners; k++) {
        const double x = at[k][0] + 100, y = at[k][1];
        used += (size_t)(axis == 1   ? sprintf(text + used, "v %.17g 5 %.17g\n", x, -y)
                         : axis == 2 ? sprintf(text + used, "v -7 %.17g %.17g\n", x, y)
                                     : sprintf(text + used, "v %.17g %.17g 3\n", x, y));
    }
    text[used++] = 'f';
    for (int k = 0; k < corners; k++) {
        used += (size_t)sprintf(text + used, " %d", 1 + (first + k) % corners);
    }
    text[used++] = '\n';
    text[used] = '\0';
    return files_put_text("polygon.obj", text);
}

/* The sum of the areas of the faces, and of the faces with their signs along the normal of all. */
static void areas_of(const mesh *m, double *sum, double *net) {
    double total[3] = {0, 0, 0};
    *sum = 0;
    for (sl_int f = 0; f < m->n_faces; f++) {
        const double *a = m->xyz + 3 * m->faces[3 * f], *b = m->xyz + 3 * m->faces[3 * f + 1],
                     *c = m->xyz + 3 * m->faces[3 * f + 2];
        double n[3];
        for (int d = 0; d < 3; d++) {
            const int e = (d + 1) % 3, g = (d + 2) % 3;
            n[d] = 0.5 * ((b[e] - a[e]) * (c[g] - a[g]) - (b[g] - a[g]) * (c[e] - a[e]));
            total[d] += n[d];
        }
        *sum += sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
    }
    *net = sqrt(total[0] * total[0] + total[1] * total[1] + total[2] * total[2]);
}

/* Reads the polygon from each corner on, in three planes: k - 2 triangles whose areas add up to
 * `area`, none of them turned over. */
static void assert_area(double (*at)[2], int corners, double area) {
    for (int k = 0; k<3 * corners; k += corners> 50 ? corners / 5 : 1) {
        mesh m;
        char message[300], note[300];
        double sum, net;
        assert_true(mesh_read_noting(&m, put_polygon(at, corners, k % 3, k / 3), message,
                                     sizeof message, note, sizeof note));
        assert_string_equal(note, "");
        assert_int_equal(m.n_vertices, corners);
        assert_int_equal(m.n_faces, corners - 2);
        areas_of(&m, &sum, &net);
        assert_true(fabs(sum - area) < 1e-10 * area && fabs(net - area) < 1e-10 * area);
        mesh_free(&m);
    }
}

static void reflex_corners_are_respected(void **state) {
    (void)state;
    double arrow[4][2] = {{0, 0}, {4, 2}, {0, 4}, {1, 2}};
    double step[6][2] = {{0, 0}, {4, 0}, {4, 1}, {1, 1}, {1, 4}, {0, 4}};
    double comb[11][2] = {{0, 0}, {6, 0}, {6, 3}, {5, 3}, {5, 1}, {4, 1},
                          {4, 3}, {2, 3}, {2, 1}, {1, 1}, {1, 3}};
    double straight[7][2] = {{0, 0}, {2, 0}, {4, 0}, {4, 1}, {4, 2}, {2, 1}, {0, 2}};
    assert_area(arrow, 4, 6);
    assert_area(step, 6, 7);
    assert_area(comb, 11, 12.5);
    assert_area(straight, 7, 6);
    /* a square with a square hole, joined by a bridge that is run along twice */
    double keyhole[10][2] = {{0, 0}, {4, 0}, {4, 4}, {0, 4}, {0, 0},
                             {1, 1}, {1, 3}, {3, 3}, {3, 1}, {1, 1}};
    assert_area(keyhole, 10, 12);
}

static void long_spirals_are_divided(void **state) {
    (void)state;
    enum { TURN = 100 };
    double spiral[2 * TURN][2], area = 0;
    for (int k = 0; k < TURN; k++) {
        const double angle = 0.2 * k, r = 1 + 0.1 * k;
        for (int side = 0; side < 2; side++) {
            double *at = spiral[side == 0 ? k : 2 * TURN - 1 - k];
            at[0] = (r + (side == 0 ? 0.4 : 0)) * cos(angle);
            at[1] = (r + (side == 0 ? 0.4 : 0)) * sin(angle);
        }
    }
    for (int k = 0; k < 2 * TURN; k++) {
        const double *p = spiral[k], *q = spiral[(k + 1) % (2 * TURN)];
        area += 0.5 * (p[0] * q[1] - p[1] * q[0]);
    }
    assert_area(spiral, 2 * TURN, fabs(area));
}

/* A fan that turns nothing over remains, also where the polygon is not flat, as does the fan of a
 * polygon that crosses itself or has no area. */
static void other_polygons_remain_fans(void **state) {
    (void)state;
    static const struct {
        const char *text, *note;
    } cases[] = {
        {"v 0 0 0\nv 1 0 0\nv 1 1 1\nv 0 1 0\nf 1 2 3 4\n", ""},
        {"v 1 2 0\nv 0 0 0\nv 4 2 0\nv 0 4 0\nf 1 2 3 4\n", ""}, /* around the reflex corner */
        {"v 0 0 0\nv 1 0 0\nv 2 0 0\nv 3 0 0\nf 1 2 3 4\n", ""},
        {"v 0 0 0\nv 3 0 0\nv 0 2 0\nv 1 3 0\nf 1 2 3 4\n", "1 polygons cross themselves"}};
    static const sl_int fan[6] = {0, 1, 2, 0, 2, 3};
    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
        mesh m;
        char message[300], note[300];
        const char *path = files_put_text("p.obj", cases[k].text);
        assert_true(mesh_read_noting(&m, path, message, sizeof message, note, sizeof note));
        assert_true(cases[k].note[0] == '\0' ? note[0] == '\0'
                                             : strstr(note, cases[k].note) != NULL);
        assert_memory_equal(m.faces, fan, sizeof fan);
        mesh_free(&m);
    }
}

/* A polygon with too many corners for ears is refused, also as a file. */
static void large_polygons_are_refused(void **state) {
    (void)state;
    enum { N = EARS_CORNERS_MAX + 1 };
    double *xyz = test_reals(3 * (size_t)N);
    sl_int *faces = (sl_int *)test_array(3 * (size_t)N, sizeof *faces);
    for (int k = 0; k < N; k++) { /* a saw: every second corner is reflex */
        xyz[3 * k] = k == 0 ? N / 2 : N - k;
        xyz[3 * k + 1] = k < 2 ? -1 : k % 2;
        xyz[3 * k + 2] = 0;
    }
    for (int k = 2; k < N; k++) {
        faces[3 * (k - 2)] = 0;
        faces[3 * (k - 2) + 1] = k - 1;
        faces[3 * (k - 2) + 2] = k;
    }
    assert_int_equal(ears_instead_of_fan(faces, N, xyz), EARS_TOO_LARGE);
    assert_int_equal(faces[3 * (N - 3) + 1], N - 2);
    assert_int_equal(ears_instead_of_fan(faces, 4001, xyz), EARS_CUT);
    FILE *file = fopen(files_path("saw.obj"), "w");
    assert_non_null(file);
    for (int k = 0; k < N; k++) {
        (void)fprintf(file, "v %g %g 0\n", xyz[3 * k], xyz[3 * k + 1]);
    }
    for (int k = 0; k < N; k++) {
        (void)fprintf(file, k == 0 ? "f %d" : " %d", k + 1);
    }
    assert_int_equal(fclose(file), 0);
    mesh m;
    char message[400];
    assert_false(mesh_read(&m, files_path("saw.obj"), message, sizeof message));
    assert_non_null(strstr(message, "polygons of 8193 corners that are not convex"));
    free(faces);
    free(xyz);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(reflex_corners_are_respected),
        cmocka_unit_test(long_spirals_are_divided),
        cmocka_unit_test(other_polygons_remain_fans),
        cmocka_unit_test(large_polygons_are_refused),
    };
    return cmocka_run_group_tests(tests, files_set_up, files_tear_down);
}

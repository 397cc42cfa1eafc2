/* test_path_checks.c: distances and cells of geodesic, checked against paths, on good and bad
 * meshes; searches with a limit */
#define _POSIX_C_SOURCE 200809L
#include "tests/lib/run_command.h"

#include "tests/lib/bad_meshes.h"
#include "tests/lib/surfaces.h"

#include "tools/geometry/cell_paths.h"
#include "tools/geometry/laplacian.h"
#include "tools/io/field_table.h"
#include "tools/mesh/mesh_write.h"

enum { MESHES = 3, SITES = 4 };

/* A flat grid whose squares become 1e4 times narrower toward two sides: the heat method fails. */
static mesh graded_grid(void) {
    mesh m = flat_grid(40, 0);
    for (sl_int k = 0; k < 3 * m.n_vertices; k++) {
        m.xyz[k] = k % 3 < 2 ? pow(1e4, m.xyz[k] - 1) : 0;
    }
    return m;
}

static mesh mesh_of(int which) {
    return which == 0   ? graded_grid()
           : which == 1 ? extruded_outline(200, 10, 1)
                        : torus_grid(40, 24);
}

static sl_int site_of(const mesh *m, sl_int k) {
    return (k * 7 + 3) * (m->n_vertices / 31);
}

/* The lengths of paths from each site through 8 points of each edge: SITES times n_vertices. */
static double *long_searches(const mesh *m) {
    double *u = test_reals((size_t)SITES * (size_t)m->n_vertices);
    incidence inc;
    surface_search *s;
    assert_true(incidence_create(&inc, m) && surface_search_create(&s, &inc, 8));
    for (sl_int k = 0; k < SITES; k++) {
        const sl_int site = site_of(m, k);
        assert_true(surface_search_run(s, &site, 1, INFINITY));
        memcpy(u + k * m->n_vertices, surface_search_lengths(s), (size_t)m->n_vertices * sizeof *u);
    }
    surface_search_free(s);
    incidence_free(&inc);
    return u;
}

/* Runs "geodesic MESH" with all sites and these options. Returns what it printed. */
static char *run_geodesic(const mesh *m, const char *options) {
    char line[1700], file[FILE_PATH_SIZE + 100], message[300];
    int status;
    (void)snprintf(file, sizeof file, "%s", files_path("m.obj"));
    assert_true(mesh_write(file, m, NULL, message, sizeof message));
    (void)snprintf(line, sizeof line, "geodesic %s --from %d,%d,%d,%d %s --csv %s", file,
                   (int)site_of(m, 0), (int)site_of(m, 1), (int)site_of(m, 2), (int)site_of(m, 3),
                   options, files_path("t.csv"));
    char *output = run_command(command_geodesic, line, &status);
    assert_int_equal(status, 0);
    return output;
}

/* The mean error of --each in mean edges; count: the number of its rows. */
static double error_of_each(const mesh *m, const double *u, const char *options, double radius,
                            sl_int *count) {
    size_t length;
    char *output = run_geodesic(m, options), *text = files_get(files_path("t.csv"), &length);
    double sum = 0;
    *count = 0;
    text[length] = '\0';
    for (char *line = strchr(text, '\n') + 1; *line != '\0'; line = strchr(line, '\n') + 1) {
        int source, vertex, k = 0;
        double d;
        assert_int_equal(sscanf(line, "%d,%d,%lf", &source, &vertex, &d), 3);
        while (site_of(m, k) != source) {
            k++;
        }
        assert_true(k < SITES && d <= radius);
        sum += fabs(d - u[k * m->n_vertices + vertex]);
        (*count)++;
    }
    free(text);
    free(output);
    return sum / *count / mesh_mean_edge_length(m);
}

/* Each distance is near the shortest path, on bad meshes too; raw ones are not. */
static void distances_of_each_are_near_paths(void **state) {
    (void)state;
    for (int which = 0; which < MESHES; which++) {
        mesh m = mesh_of(which);
        double *u = long_searches(&m);
        sl_int count = 0;
        double error = error_of_each(&m, u, "--each", INFINITY, &count);
        assert_int_equal(count, SITES * m.n_vertices);
        double raw = error_of_each(&m, u, "--each --raw", INFINITY, &count);
        double near = error_of_each(&m, u, "--each --radius 0.3", 0.3, &count);
        sl_int least = 0, most = 0;
        for (sl_int k = 0; k < SITES * m.n_vertices; k++) {
            least += u[k] <= 0.3 - mesh_mean_edge_length(&m);
            most += u[k] <= 0.3 + mesh_mean_edge_length(&m);
        }
        print_message("mesh %d: mean error %.3f, raw %.3f, in a radius %.3f edges; %d to %d: %d\n",
                      which, error, raw, near, (int)least, (int)most, (int)count);
        assert_true(error <= 0.5 && near <= 0.5 && count >= least && count <= most);
        assert_true(which > 0 || raw > 2 * error);
        free(u);
        mesh_free(&m);
    }
}

/* The largest and the mean excess, in mean edges, of the distance to the site of a vertex over that
 * to the nearest one. */
static double excess_of_cells(const mesh *m, const double *u, const char *options, double *mean) {
    char message[300], *output = run_geodesic(m, options);
    field_table t;
    double worst = 0, edge = mesh_mean_edge_length(m);
    assert_true(field_table_read(&t, files_path("t.csv"), m->n_vertices, message, sizeof message));
    *mean = 0;
    for (sl_int v = 0; v < m->n_vertices; v++) {
        double nearest = INFINITY, own = INFINITY;
        for (sl_int k = 0; k < SITES; k++) {
            const double length = u[k * m->n_vertices + v];
            nearest = fmin(nearest, length);
            own = site_of(m, k) == (sl_int)t.values[0][v] ? length : own;
        }
        worst = fmax(worst, (own - nearest) / edge);
        *mean += (own - nearest) / edge / m->n_vertices;
    }
    field_table_free(&t);
    free(output);
    return worst;
}

static void cells_are_those_of_the_nearest_site(void **state) {
    (void)state;
    for (int which = 0; which < MESHES; which++) {
        mesh m = mesh_of(which);
        double *u = long_searches(&m), mean, mean_raw;
        double worst = excess_of_cells(&m, u, "--voronoi", &mean);
        double raw = excess_of_cells(&m, u, "--voronoi --raw", &mean_raw);
        print_message("mesh %d: farther by up to %.3f edges, %.4f on average; raw %.3f, %.4f\n",
                      which, worst, mean, raw, mean_raw);
        assert_true(worst <= 1.5 && mean <= 0.1);
        assert_true(which > 0 || (raw > worst && mean_raw > 1.5 * mean));
        free(u);
        mesh_free(&m);
    }
}

/* A search with a limit finds the same paths up to it, and forgets those before; vertices without a
 * site get one unless a radius was asked for. */
static void searches_end_at_their_limit(void **state) {
    (void)state;
    mesh m = flat_grid(21, 0.3);
    const sl_int sites[2] = {0, 440};
    incidence inc;
    surface_search *one = NULL, *three = NULL;
    cell_correction c;
    double *all = test_reals((size_t)m.n_vertices);
    sl_int *cell = test_array((size_t)m.n_vertices, sizeof *cell), near = 0;
    assert_true(incidence_create(&inc, &m));
    assert_true(surface_search_create(&one, &inc, 1) && surface_search_create(&three, &inc, 3));
    const double *u = surface_search_lengths(three);
    assert_true(surface_search_run(three, sites, 2, INFINITY));
    memcpy(all, u, (size_t)m.n_vertices * sizeof *all);
    assert_true(surface_search_run(three, sites, 2, 0.3));
    for (sl_int v = 0; v < m.n_vertices; v++) {
        assert_true(u[v] == (all[v] <= 0.3 ? all[v] : INFINITY));
        near += isfinite(u[v]);
    }
    assert_true(near > 20 && near < m.n_vertices / 2);
    for (int with_radius = 0; with_radius < 2; with_radius++) {
        memset(cell, -1, (size_t)m.n_vertices * sizeof *cell);
        assert_true(cell_paths_correct(&c, cell, one, three, m.n_vertices, sites, 2,
                                       with_radius ? 0.3 : 0, 0.01, NULL));
        assert_true(c.moved == 0 && c.given == (with_radius ? 0 : m.n_vertices));
    }
    for (sl_int v = 0; v < m.n_vertices; v++) { /* all to one site: half of them move */
        cell[v] = 0;
    }
    assert_true(cell_paths_correct(&c, cell, one, three, m.n_vertices, sites, 2, 0, 0.01, NULL));
    assert_true(c.moved > m.n_vertices / 3 && cell[440] == 1 && cell[0] == 0 && c.farther > 1);
    free(cell);
    free(all);
    surface_search_free(three);
    surface_search_free(one);
    incidence_free(&inc);
    mesh_free(&m);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(distances_of_each_are_near_paths),
        cmocka_unit_test(cells_are_those_of_the_nearest_site),
        cmocka_unit_test(searches_end_at_their_limit),
    };
    return cmocka_run_group_tests(tests, files_set_up, files_tear_down);
}

/* test_commands.c: commands of sparse-local run as functions: values against sums over all
 * eigenvectors, invariance under renumbering and motion of the mesh, pictures */
#define _POSIX_C_SOURCE 200809L
#include "tests/lib/heat_spectrum.h"
#include "tests/lib/temporary_files.h"

#include <fcntl.h>

#include "tools/cli/command.h"
#include "tools/draw/dissection.h"
#include "tools/geometry/laplacian.h"
#include "tools/mesh/mesh_write.h"
#include "tools/draw/picture.h"
#include "tools/mesh/surface_generator.h"

static int pictures_written, picture_colors;

/* Replaces the program's own function (png_write.c), which needs libpng. Counts the colors of the
 * picture. */
bool picture_write_png(const picture *p, const char *path, char *message, size_t message_size) {
    static unsigned char seen[1 << 15]; /* five bits of each color */
    (void)path;
    (void)message;
    (void)message_size;
    memset(seen, 0, sizeof seen);
    picture_colors = 0;
    for (int k = 0; k < p->width * p->height; k++) {
        int color = (p->at[k].r >> 3) << 10 | (p->at[k].g >> 3) << 5 | p->at[k].b >> 3;
        picture_colors += !seen[color];
        seen[color] = 1;
    }
    pictures_written++;
    return true;
}

/* Runs a command, its words separated by spaces, with standard output discarded. */
static void run(int (*command)(int, char **), const char *format, ...) {
    char line[2048], *argv[40];
    int argc = 0;
    va_list list;
    va_start(list, format);
    assert_true(vsnprintf(line, sizeof line, format, list) < (int)sizeof line);
    va_end(list);
    for (char *word = strtok(line, " "); word != NULL; word = strtok(NULL, " ")) {
        argv[argc++] = word;
    }
    argv[argc] = NULL;
    (void)fflush(stdout);
    int saved = dup(1), null_device = open("/dev/null", O_WRONLY);
    assert_true(saved >= 0 && null_device >= 0 && dup2(null_device, 1) == 1);
    int status = command(argc, argv);
    (void)fflush(stdout);
    assert_true(dup2(saved, 1) == 1);
    (void)close(saved);
    (void)close(null_device);
    assert_int_equal(status, 0);
}

/* Reads a table of numbers below a line of column names. Returns the number of rows. */
static int read_csv(const char *path, double *values, int columns, int max_rows) {
    size_t length = 0;
    char *text = files_get(path, &length), *at = strchr(text, '\n');
    int rows = 0;
    assert_non_null(at);
    for (at++; *at != '\0' && rows < max_rows; rows++) {
        for (int c = 0; c < columns; c++) {
            char *after = at;
            values[rows * columns + c] = strtod(at, &after);
            assert_true(after > at && *after == (c + 1 < columns ? ',' : '\n'));
            at = after + 1;
        }
    }
    assert_true(*at == '\0');
    free(text);
    return rows;
}

#define NEAR(a, b, size, tolerance) assert_true(fabs((a) - (b)) <= (tolerance) * (size))

static const char *const small[] = {"sphere:2", "blob:2", "hills:13x12", "torus:16x9"};

static void heat_matches_sums_over_eigenvectors(void **state) {
    (void)state;
    char csv[FILE_PATH_SIZE + 100];
    (void)snprintf(csv, sizeof csv, "%s", files_path("numbers.csv"));
    for (size_t k = 0; k < sizeof small / sizeof *small; k++) {
        spectrum s = spectrum_of(small[k]);
        double *values = test_reals(20 * (size_t)s.n);
        for (double t = 1e-3; t < 1e4; t *= 31) {
            run(command_adf, "adf %s --laplacian cotangent --time %.17g --csv %s", small[k], t,
                csv);
            assert_int_equal(read_csv(csv, values, 2, s.n), s.n);
            for (int v = 0; v < s.n; v++) {
                double want = heat_by_sum(&s, v, v, t);
                assert_true(values[2 * v] == v);
                NEAR(values[2 * v + 1], want, want, tolerance_of(&s, t));
            }
            run(command_adf, "adf %s --laplacian cotangent --time %.17g --csv %s --at 7,7,3,9-11",
                small[k], t, csv);
            assert_int_equal(read_csv(csv, values, 2, s.n), 6);
            NEAR(values[1], heat_by_sum(&s, 7, 7, t), values[1], tolerance_of(&s, t));
            NEAR(values[11], heat_by_sum(&s, 11, 11, t), values[11], tolerance_of(&s, t));
            run(command_heat,
                "heat %s --laplacian cotangent --time %.17g --csv %s --from 5,60 --at 0,5,33",
                small[k], t, csv);
            assert_int_equal(read_csv(csv, values, 2, s.n), 3);
            for (int row = 0; row < 3; row++) {
                int v = (int)values[2 * row];
                NEAR(values[2 * row + 1], heat_by_sum(&s, v, 5, t) + heat_by_sum(&s, v, 60, t),
                     heat_by_sum(&s, 5, 5, t), tolerance_of(&s, t));
            }
            run(command_pairs, "pairs %s --laplacian cotangent --time %.17g --csv %s --count 40",
                small[k], t, csv);
            assert_int_equal(read_csv(csv, values, 5, s.n), 40);
            for (int row = 0; row < 40; row++) {
                int from = (int)values[5 * row], to = (int)values[5 * row + 1];
                NEAR(values[5 * row + 2], heat_by_sum(&s, to, from, t), heat_by_sum(&s, to, to, t),
                     tolerance_of(&s, t));
            }
        }
        run(command_hks,
            "hks %s --laplacian cotangent --times 6 --csv %s --first 0.01 --last 100 --at all",
            small[k], csv);
        assert_int_equal(read_csv(csv, values, 7, s.n), s.n);
        for (int v = 0; v < s.n; v++) {
            for (int i = 0; i < 6; i++) {
                double t = 0.01 * pow(1e4, i / 5.0), want = heat_by_sum(&s, v, v, t);
                NEAR(values[7 * v + 1 + i], want, want, tolerance_of(&s, t));
            }
        }
        free(values);
        spectrum_free(&s);
    }
}

/* Heat is conserved: the sum of mass times x is that of the sources. With a radius, exactly the
 * vertices within it are written. */
static void heat_is_conserved(void **state) {
    (void)state;
    char csv[FILE_PATH_SIZE + 100];
    (void)snprintf(csv, sizeof csv, "%s", files_path("heat.csv"));
    mesh m;
    assert_true(surface_generate(&m, "hills:40x30", NULL, 0));
    double mass[1200], all[2400], near[2400];
    laplacian_mass(mass, &m);
    run(command_heat,
        "heat hills:40x30 --laplacian cotangent --scaled-time 50 --from 600,3 --csv %s", csv);
    assert_int_equal(read_csv(csv, all, 2, 1200), 1200);
    double sum = 0;
    for (int v = 0; v < 1200; v++) {
        sum += mass[v] * all[2 * v + 1];
    }
    assert_true(fabs(sum - 2) < 1e-12);
    run(command_heat,
        "heat hills:40x30 --laplacian cotangent --scaled-time 50 --from 600,3 --radius 0.2 --csv "
        "%s",
        csv);
    int rows = read_csv(csv, near, 2, 1200), inside = 0;
    for (int v = 0; v < 1200; v++) {
        const double *x = m.xyz + 3 * v, *a = m.xyz + 3 * 600, *b = m.xyz + 3 * 3;
        inside += hypot(hypot(x[0] - a[0], x[1] - a[1]), x[2] - a[2]) <= 0.2 ||
                  hypot(hypot(x[0] - b[0], x[1] - b[1]), x[2] - b[2]) <= 0.2;
    }
    assert_int_equal(rows, inside);
    /* Local solves give the bits of the full solve. */
    for (int k = 0; k < rows; k++) {
        assert_true(near[2 * k + 1] == all[2 * (int)near[2 * k] + 1]);
    }
    mesh_free(&m);
}

/* On the unit sphere the eigenvalues are l (l + 1), and the heat at angle a is the sum over l of
 * (2 l + 1) / (4 pi) P_l(cos a) / (1 + t l (l + 1)). A mesh with edges of 0.075 is within 1 %. */
static void heat_on_a_sphere_matches_the_closed_form(void **state) {
    (void)state;
    char csv[FILE_PATH_SIZE + 100];
    mesh m;
    (void)snprintf(csv, sizeof csv, "%s", files_path("sphere.csv"));
    assert_true(surface_generate(&m, "sphere:4", NULL, 0));
    double *x = test_reals(2 * (size_t)m.n_vertices), t = 0.3;
    run(command_heat, "heat sphere:4 --from 0 --time %.17g --csv %s", t, csv);
    assert_int_equal(read_csv(csv, x, 2, m.n_vertices), m.n_vertices);
    for (int v = 0; v < m.n_vertices; v += 7) {
        double c =
            m.xyz[0] * m.xyz[3 * v] + m.xyz[1] * m.xyz[3 * v + 1] + m.xyz[2] * m.xyz[3 * v + 2];
        double before = 1, at = c, sum = 1 + 3 * c / (1 + 2 * t);
        if (c > 0.9) {
            /* The sum diverges at the source and converges slowly near it. */
            continue;
        }
        for (int l = 2; l < 3000; l++) { /* Bonnet's recursion */
            double next = ((2 * l - 1) * c * at - (l - 1) * before) / l;
            before = at;
            at = next;
            sum += (2 * l + 1) * at / (1 + t * l * (l + 1.0));
        }
        sum /= 4 * 3.14159265358979323846;
        assert_true(fabs(x[2 * v + 1] - sum) < 0.01 * sum);
    }
    free(x);
    mesh_free(&m);
}

/* With the vertices renumbered and the surface rotated and moved, every vertex keeps its value. */
static void an_isometry_changes_nothing(void **state) {
    (void)state;
    mesh m, other;
    char csv[FILE_PATH_SIZE + 100], path[FILE_PATH_SIZE + 100];
    (void)snprintf(csv, sizeof csv, "%s", files_path("iso.csv"));
    (void)snprintf(path, sizeof path, "%s", files_path("iso.ply"));
    assert_true(surface_generate(&m, "star:3", NULL, 0));
    int n = m.n_vertices;
    other = m;
    other.xyz = test_reals(3 * (size_t)n);
    other.faces = test_ints(3 * (size_t)m.n_faces);
    /* Vertex v becomes 7 v + 3 modulo n = 642, which 7 does not divide. */
    for (int v = 0; v < n; v++) {
        const double *x = m.xyz + 3 * v;
        double *y = other.xyz + 3 * ((7 * v + 3) % n);
        double c = cos(0.7), s = sin(0.7);
        y[0] = c * x[0] - s * x[1] + 5;
        y[1] = c * x[2] + s * (s * x[0] + c * x[1]) - 2;
        y[2] = s * x[2] - c * (s * x[0] + c * x[1]) + 1;
    }
    /* Faces in reverse order, each starting at another corner. */
    for (int k = 0; k < 3 * m.n_faces; k++) {
        other.faces[3 * (m.n_faces - 1 - k / 3) + (k % 3 + 1) % 3] = (7 * m.faces[k] + 3) % n;
    }
    assert_true(mesh_write(path, &other, NULL, NULL, 0));
    double *a = test_reals(2 * (size_t)n), *b = test_reals(2 * (size_t)n);
    run(command_adf, "adf star:3 --time 0.3 --csv %s", csv);
    assert_int_equal(read_csv(csv, a, 2, n), n);
    run(command_adf, "adf %s --time 0.3 --csv %s", path, csv);
    assert_int_equal(read_csv(csv, b, 2, n), n);
    for (int v = 0; v < n; v++) {
        NEAR(b[2 * ((7 * v + 3) % n) + 1], a[2 * v + 1], a[2 * v + 1], 1e-11);
    }
    free(a);
    free(b);
    free(other.xyz);
    free(other.faces);
    mesh_free(&m);
}

/* The columns visited are the ancestors of the patch. No other part of the mesh changes them. */
static void visited_columns_are_ancestors_of_the_patch(void **state) {
    (void)state;
    char csv[FILE_PATH_SIZE + 100];
    (void)snprintf(csv, sizeof csv, "%s", files_path("reach.csv"));
    double *rows = test_reals(7 * 1200);
    run(command_reach, "reach hills:40x30 --center 615 --patch 50 --csv %s", csv);
    assert_int_equal(read_csv(csv, rows, 7, 1200), 1200);
    int in_patch = 0;
    for (int v = 0; v < 1200; v++) {
        const double *r = rows + 7 * v;
        int parent = (int)r[2];
        in_patch += r[5] == 1;
        assert_true(r[0] == v && r[5] <= r[6]);
        assert_true(parent < 0 || rows[7 * parent + 1] > r[1]);  /* parents have higher numbers */
        assert_true(parent < 0 || r[6] <= rows[7 * parent + 6]); /* and are visited too */
    }
    assert_int_equal(in_patch, 50);
    /* A visited column outside the patch has a visited child. */
    for (int v = 0; v < 1200; v++) {
        if (rows[7 * v + 6] == 1 && rows[7 * v + 5] == 0) {
            int children = 0;
            for (int w = 0; w < 1200; w++) {
                children += rows[7 * w + 2] == v && rows[7 * w + 6] == 1;
            }
            assert_true(children > 0);
        }
    }
    free(rows);
}

static sl_int largest_component_without(const mesh *m, const sl_int *level_of, sl_int below,
                                        sl_int *mark) {
    sl_int largest = 0;
    for (sl_int v = 0; v < m->n_vertices; v++) {
        mark[v] = level_of[v] >= 0 && level_of[v] < below ? -1 : v;
    }
    /* The smallest number in a component wins. */
    for (bool changed = true; changed;) {
        changed = false;
        for (sl_int k = 0; k < 3 * m->n_faces; k++) {
            sl_int a = m->faces[k], b = m->faces[k % 3 == 2 ? k - 2 : k + 1];
            if (mark[a] >= 0 && mark[b] >= 0 && mark[a] != mark[b]) {
                mark[a] = mark[b] = mark[a] < mark[b] ? mark[a] : mark[b];
                changed = true;
            }
        }
    }
    for (sl_int v = 0; v < m->n_vertices; v++) {
        sl_int count = 0;
        for (sl_int w = 0; mark[v] == v && w < m->n_vertices; w++) {
            count += mark[w] == v;
        }
        largest = count > largest ? count : largest;
    }
    return largest;
}

/* Removing the separators of one more level leaves no component larger than three quarters of the
 * largest before. */
static void separators_divide_the_mesh(void **state) {
    (void)state;
    mesh m;
    sl_matrix *L = NULL;
    sl_symbolic *S = NULL;
    sl_options opt = options_none();
    opt.relaxation = SL_RELAXATION_NONE;
    assert_true(surface_generate(&m, "sphere:4", NULL, 0));
    assert_true(laplacian_cotangent(&L, &m));
    sl_csc A = sl_matrix_view(L);
    SL_CHECK(sl_symbolic_create(&S, &A, &opt, NULL));
    sl_symbolic_arrays view = sl_symbolic_view(S);
    sl_int *level = test_ints((size_t)view.n), *of = test_ints((size_t)view.n);
    sl_int *mark = test_ints((size_t)view.n);
    assert_int_equal(dissection_levels(level, &view, 4), 4);
    for (sl_int k = 0; k < view.n; k++) {
        of[view.perm[k]] = level[k];
        assert_true(view.parent[k] < 0 || level[k] < 0 || level[view.parent[k]] >= 0);
    }
    sl_int whole = view.n;
    for (sl_int below = 1; below <= 4; below++) {
        sl_int component = largest_component_without(&m, of, below, mark);
        assert_true(component < 3 * whole / 4);
        whole = component;
    }
    free(mark);
    free(of);
    free(level);
    sl_symbolic_free(S);
    sl_matrix_free(L);
    mesh_free(&m);
    const sl_symbolic_arrays none = {0};
    sl_int nothing;
    assert_int_equal(dissection_levels(&nothing, &none, 3), 0);
}

static void pictures_are_drawn(void **state) {
    (void)state;
    char folder[FILE_PATH_SIZE + 100];
    (void)snprintf(folder, sizeof folder, "%s", files_path(""));
    pictures_written = 0;
    run(command_heat, "heat star:3 --png p --size 200x150");
    assert_true(pictures_written == 1 && picture_colors > 100);
    run(command_adf, "adf star:3 --png p --size 200x150 --view 10,80 --up z");
    assert_true(pictures_written == 2 && picture_colors > 100);
    run(command_hks, "hks star:3 --png p --size 200x150 --times 3 --like 5 --out %s/hks.ply",
        folder);
    assert_true(pictures_written == 3 && picture_colors > 100);
    run(command_reach,
        "reach star:3 --png p --separators q --pattern r --tree %s/t.svg --size 200x150", folder);
    assert_int_equal(pictures_written, 6);
    run(command_pairs, "pairs star:2 --count 50 --svg %s/pairs.svg", folder);
    run(command_info, "info star:2");
    static const char *const files[] = {"t.svg", "pairs.svg"};
    for (int k = 0; k < 2; k++) {
        size_t length = 0;
        char *svg = files_get(files_path(files[k]), &length);
        assert_true(strncmp(svg, "<svg", 4) == 0 && strstr(svg, "</svg>\n") != NULL);
        assert_true(strstr(svg, "nan") == NULL && strstr(svg, "inf") == NULL);
        free(svg);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(heat_matches_sums_over_eigenvectors),
        cmocka_unit_test(heat_is_conserved),
        cmocka_unit_test(heat_on_a_sphere_matches_the_closed_form),
        cmocka_unit_test(an_isometry_changes_nothing),
        cmocka_unit_test(visited_columns_are_ancestors_of_the_patch),
        cmocka_unit_test(separators_divide_the_mesh),
        cmocka_unit_test(pictures_are_drawn),
    };
    return cmocka_run_group_tests(tests, files_set_up, files_tear_down);
}

/* test_render_thin.c: pictures of faces thinner than a pixel, or in the same place */
#include "tests/lib/bad_meshes.h"
#include "tests/lib/gen_graphs.h"

#include "tools/draw/picture.h"
#include "tools/draw/render.h"
#include "tools/draw/render_cover.h"
#include "tools/mesh/surface_generator.h"

enum { WIDTH = 110, HEIGHT = 80 };

static const rgb red = {200, 0, 0}, blue = {0, 0, 200};

/* Sums over the parts of one triangle. */
typedef struct cover_sum {
    double area, w[3];
    int parts, samples;
    double lowest, highest; /* depth */
} cover_sum;

static void add_part(void *context, const cover_part *part) {
    cover_sum *sum = (cover_sum *)context;
    assert_true(part->x >= 0 && part->x < 100 && part->y >= 0 && part->y < 80);
    assert_true(part->area > 0 && part->area <= 1);
    sum->area += part->area;
    sum->parts++;
    for (int k = 0; k < 3; k++) {
        assert_true(part->w[k] >= 0 && part->w[k] <= 1);
        sum->w[k] += part->area * part->w[k];
    }
    for (unsigned mask = part->mask; mask != 0; mask &= mask - 1) {
        sum->samples++;
    }
    sum->lowest = fmin(sum->lowest, part->depth);
    sum->highest = fmax(sum->highest, part->depth);
}

static cover_sum cover(const double a[3], const double b[3], const double c[3]) {
    const double *const corner[3] = {a, b, c};
    cover_sum sum = {0, {0, 0, 0}, 0, 0, HUGE_VAL, -HUGE_VAL};
    cover_triangle(corner, 0, 100, 0, 80, add_part, &sum);
    return sum;
}

/* The parts of a triangle have its area and its center of mass, from wide ones to needles of a
 * billionth of a cell. */
static void parts_have_the_area_of_the_triangle(void **state) {
    (void)state;
    uint64_t random = 11;
    for (int k = 0; k < 2000; k++) {
        double x[3][3], width = pow(10, -9 * fabs(gen_real(&random))),
                        angle = 6.3 * fabs(gen_real(&random));
        for (int d = 0; d < 3; d++) {
            x[0][d] = 10 + 60 * fabs(gen_real(&random));
            x[1][d] = 10 + 60 * fabs(gen_real(&random));
            x[2][d] = k % 2 ? 10 + 60 * fabs(gen_real(&random)) : 0.5 * (x[0][d] + x[1][d]);
        }
        if (k % 2 == 0) {
            x[2][0] += width * cos(angle);
            x[2][1] += width * sin(angle);
        }
        double area = 0.5 * fabs((x[1][0] - x[0][0]) * (x[2][1] - x[0][1]) -
                                 (x[1][1] - x[0][1]) * (x[2][0] - x[0][0]));
        cover_sum sum = cover(x[0], x[1], x[2]);
        assert_true(fabs(sum.area - area) <= 1e-12 * 100 + 1e-9 * area);
        if (area > 1e-6) {
            for (int c = 0; c < 3; c++) {
                assert_true(fabs(sum.w[c] / sum.area - 1.0 / 3) < 1e-4);
            }
        }
        if (k % 2) {
            assert_true(fabs(sum.samples / 16.0 - area) < 0.1 * area + 3);
        }
    }
}

/* What is outside the raster has no parts; a triangle over all of it has every cell, whose depths
 * are those of its plane. */
static void parts_end_at_the_raster(void **state) {
    (void)state;
    const double a[3] = {-1000, -1000, 0}, b[3] = {2000, -1000, 300}, c[3] = {-1000, 2000, 600};
    const double d[3] = {-5, -5, 0}, e[3] = {-5, 300, 0}, f[3] = {-1, 30, 0};
    cover_sum sum = cover(a, b, c);
    assert_true(sum.parts == 8000 && sum.samples == 16 * 8000 && fabs(sum.area - 8000) < 1e-9);
    /* depth = 0.1 (x + 1000) + 0.2 (y + 1000) */
    assert_true(fabs(sum.lowest - 300.15) < 1e-9 &&
                fabs(sum.highest - (300.15 + 9.9 + 15.8)) < 1e-9);
    assert_int_equal(cover(d, e, f).parts, 0);
    assert_int_equal(cover(a, a, c).parts, 0);
    assert_int_equal(cover(d, e, a).parts, 0);
}

/* A rectangle of n + 1 points below and n above, 200 long and 100 high: a strip of needles. The
 * points of the first row are at 0, 1, ..., n, those of the second between them. */
static mesh strip(sl_int n) {
    mesh m = bad_mesh_allocate(2 * n + 1, 2 * n - 1);
    for (sl_int k = 0; k <= 2 * n; k++) {
        m.xyz[3 * k] = k <= n ? 200.0 * k / n : 200.0 * (k - n - 0.5) / n;
        m.xyz[3 * k + 1] = k <= n ? 0 : 100;
    }
    for (sl_int k = 0; k < n; k++) {
        bad_mesh_face(&m, 2 * k, k, k + 1, n + 1 + k);
        if (k + 1 < n) {
            bad_mesh_face(&m, 2 * k + 1, k + 1, n + 2 + k, n + 1 + k);
        }
    }
    return m;
}

static int difference(rgb a, rgb b) {
    int r = abs(a.r - b.r), g = abs(a.g - b.g), c = abs(a.b - b.b);
    return r > g ? (r > c ? r : c) : g > c ? g : c;
}

/* The largest difference from the colors of the rows, in the middle of the picture. */
static int largest_difference(const picture *p, const rgb *wanted) {
    int largest = 0;
    for (int y = HEIGHT / 2 - 10; y < HEIGHT / 2 + 10; y++) {
        for (int x = 30; x < WIDTH - 30; x++) {
            int now = difference(p->at[y * p->width + x], wanted[y]);
            largest = now > largest ? now : largest;
        }
    }
    return largest;
}

/* In all rows the same color. */
static void fill(rgb wanted[HEIGHT], rgb color) {
    for (int y = 0; y < HEIGHT; y++) {
        wanted[y] = color;
    }
}

/* The mean color of a strip whose points have the values 0, 1, 0, 1, ...: at a fraction t of its
 * height, needles that begin below have 1 - t of the width and values around (1 - t) / 2 + t v, v
 * being the value of their tip; those that begin above have the rest. */
static void fill_alternating(rgb wanted[HEIGHT], double azimuth) {
    const double pi = 3.14159265358979323846;
    const double scale = fmin(0.92 * WIDTH / (200 * cos(azimuth * pi / 180)), 0.92 * HEIGHT / 100);
    for (int y = 0; y < HEIGHT; y++) {
        double t = fmax(0, fmin(1, 0.5 - (y + 0.5 - 0.5 * HEIGHT) / scale / 100));
        rgb below = color_mix(color_map(0.5 * (1 - t)), color_map(0.5 * (1 - t) + t), 0.5);
        rgb above = color_mix(color_map(0.5 * t), color_map(0.5 * t + 1 - t), 0.5);
        wanted[y] = color_mix(below, above, t);
    }
}

static picture draw(const mesh *m, const render_style *style, double azimuth) {
    render_view view = render_view_default();
    picture p;
    view.width = WIDTH;
    view.height = HEIGHT;
    view.automatic = false;
    view.azimuth = azimuth;
    view.elevation = 0;
    assert_true(render_mesh(&p, m, &view, style));
    return p;
}

/* Needles of a thousandth of a pixel, with other colors or values from one to the next: each pixel
 * shows the mean of what is in it, also with isolines and edges, and from the side. */
static void needles_show_their_mean_color(void **state) {
    (void)state;
    const rgb mean = {100, 0, 100};
    mesh m = strip(4000);
    rgb *color = (rgb *)test_array((size_t)m.n_faces, sizeof *color);
    double *value = test_reals((size_t)m.n_vertices);
    for (sl_int f = 0; f < m.n_faces; f++) {
        color[f] = f / 2 % 2 ? red : blue;
    }
    for (sl_int v = 0; v < m.n_vertices; v++) {
        value[v] = (v <= m.n_vertices / 2 ? v : v - m.n_vertices / 2) % 2;
    }
    for (int azimuth = 0; azimuth <= 60; azimuth += 60) {
        render_style style;
        rgb wanted[HEIGHT];
        memset(&style, 0, sizeof style);
        style.unlit = true;
        style.face_color = color;
        style.edges = 0.3;
        picture p = draw(&m, &style, azimuth);
        fill(wanted, mean);
        assert_true(largest_difference(&p, wanted) <= 8);
        picture_free(&p);
        style.edges = 0;
        style.scalar = value;
        style.isolines = 5;
        p = draw(&m, &style, azimuth);
        fill_alternating(wanted, azimuth);
        assert_true(largest_difference(&p, wanted) <= 8);
        picture_free(&p);
    }
    free(value);
    free(color);
    mesh_free(&m);
}

/* Nothing of a face behind them is seen between needles, and nothing of needles behind a face. */
static void needles_hide_what_is_behind(void **state) {
    (void)state;
    mesh needles = strip(1500);
    for (int behind = 0; behind < 2; behind++) {
        mesh m = bad_mesh_allocate(needles.n_vertices + 4, needles.n_faces + 2);
        rgb *color = (rgb *)test_array((size_t)m.n_faces, sizeof *color);
        const sl_int n = needles.n_vertices;
        memcpy(m.xyz, needles.xyz, 3 * (size_t)n * sizeof(double));
        memcpy(m.faces, needles.faces, 3 * (size_t)needles.n_faces * sizeof(sl_int));
        for (sl_int k = 0; k < 4; k++) {
            m.xyz[3 * (n + k)] = k % 2 ? 200 : 0;
            m.xyz[3 * (n + k) + 1] = k / 2 ? 100 : 0;
            m.xyz[3 * (n + k) + 2] = behind ? -1 : 1;
        }
        bad_mesh_face(&m, needles.n_faces, n, n + 1, n + 2);
        bad_mesh_face(&m, needles.n_faces + 1, n + 1, n + 3, n + 2);
        for (sl_int f = 0; f < m.n_faces; f++) {
            color[f] = f < needles.n_faces ? red : blue;
        }
        for (int azimuth = 0; azimuth <= 60; azimuth += 30) {
            render_style style;
            memset(&style, 0, sizeof style);
            style.unlit = true;
            style.face_color = color;
            picture p = draw(&m, &style, azimuth);
            rgb wanted[HEIGHT];
            fill(wanted, behind ? red : blue);
            assert_true(largest_difference(&p, wanted) <= 1);
            picture_free(&p);
        }
        free(color);
        mesh_free(&m);
    }
    mesh_free(&needles);
}

/* A lone needle darkens the picture by its area. */
static void lone_needles_have_their_area(void **state) {
    (void)state;
    for (double width = 0.2; width < 1; width *= 2) {
        double xyz[18] = {0, 0, 0, 200, 0, 0, 0, 100, 0, 30, 20, 0, 150, 90, 0, 30, 20 + width, 0};
        sl_int faces[12] = {3, 4, 5, 0, 0, 1, 1, 1, 2, 2, 2, 0};
        const mesh m = {6, 4, xyz, faces};
        const rgb black = {0, 0, 0}, four[4] = {black, black, black, black};
        render_style style;
        double sum = 0;
        memset(&style, 0, sizeof style);
        style.unlit = true;
        style.face_color = four;
        picture p = draw(&m, &style, 0);
        for (int k = 0; k < p.width * p.height; k++) {
            sum += 1 - p.at[k].g / 255.0;
        }
        picture_free(&p);
        double scale = 0.92 * WIDTH / 200, area = 0.5 * width * 120 * scale * scale;
        assert_true(fabs(sum - area) < 0.03 * area); /* what is missing are cells below 1 / 510 */
    }
}

/* Edges and isolines darken the picture by their width times their length, whatever their slope. */
static void lines_have_their_width(void **state) {
    (void)state;
    for (int k = 0; k < 8;
         k++) { /* a square with its diagonal, turned a little further each time */
        const double c = 70 * cos(0.1 * k), s = 70 * sin(0.1 * k);
        double xyz[12] = {-c, -s, 0, s, -c, 0, c, s, 0, -s, c, 0}, value[4] = {0, 0, 1, 1};
        sl_int faces[6] = {0, 1, 2, 0, 2, 3};
        const mesh m = {4, 2, xyz, faces};
        const rgb black = {0, 0, 0}, plain[2] = {{250, 250, 250}, {250, 250, 250}};
        render_style style;
        memset(&style, 0, sizeof style);
        style.unlit = true;
        style.face_color = plain;
        style.edge_color = black;
        double dark[2] = {0, 0};
        picture p[2];
        p[0] = draw(&m, &style, 0);
        style.edges = 0.7;
        p[1] = draw(&m, &style, 0);
        for (int i = 0; i < WIDTH * HEIGHT; i++) {
            dark[0] += p[0].at[i].g / 250.0 - p[1].at[i].g / 250.0;
        }
        picture_free(&p[0]);
        picture_free(&p[1]);
        style.edges = 0;
        style.face_color = NULL;
        style.scalar = value;
        style.low = -1e9; /* one color everywhere */
        style.high = 1e9 + 1;
        p[0] = draw(&m, &style, 0);
        style.isolines = 1; /* at 0.5, from the middle of one side to that of the opposite one */
        p[1] = draw(&m, &style, 0);
        for (int i = 0; i < WIDTH * HEIGHT; i++) {
            const rgb base = p[0].at[i], line = {0x20, 0x20, 0x20};
            dark[1] += base.g - p[1].at[i].g > 0 && base.g > line.g + 50
                           ? (base.g - p[1].at[i].g) / (double)(base.g - line.g)
                           : 0;
        }
        picture_free(&p[0]);
        picture_free(&p[1]);
        const double scale = fmin(0.92 * WIDTH, 0.92 * HEIGHT) / (2 * (c > s ? c : s));
        const double side = 70 * sqrt(2) * scale, want = 0.7 * (140 * scale + 0.5 * 4 * side);
        assert_true(fabs(dark[0] - want) < 0.08 * want);
        assert_true(fabs(dark[1] - side) < 0.08 * side);
    }
}

/* A sphere whose faces all lie on opposed copies looks as it does without them, whether they share
 * their vertices or not; copies of another color give the mean color, everywhere. */
static void opposed_faces_are_drawn_without_speckles(void **state) {
    (void)state;
    mesh m;
    assert_true(surface_generate(&m, "sphere:4", NULL, 0));
    const sl_int n = m.n_vertices;
    mesh shared = bad_mesh_allocate(n, 2 * m.n_faces),
         apart = bad_mesh_allocate(2 * n, 2 * m.n_faces);
    rgb *color = (rgb *)test_array((size_t)shared.n_faces, sizeof *color);
    memcpy(shared.xyz, m.xyz, 3 * (size_t)n * sizeof(double));
    memcpy(apart.xyz, m.xyz, 3 * (size_t)n * sizeof(double));
    memcpy(apart.xyz + 3 * n, m.xyz, 3 * (size_t)n * sizeof(double));
    for (sl_int f = 0; f < m.n_faces; f++) {
        const sl_int *v = m.faces + 3 * f;
        bad_mesh_face(&shared, 2 * f, v[0], v[1], v[2]);
        bad_mesh_face(&shared, 2 * f + 1, v[1], v[0], v[2]);
        bad_mesh_face(&apart, f, v[0], v[1], v[2]);
        bad_mesh_face(&apart, m.n_faces + f, n + v[2], n + v[1], n + v[0]);
        color[f] = red;
        color[m.n_faces + f] = blue;
    }
    for (int azimuth = 0; azimuth < 90; azimuth += 17) {
        render_style style;
        memset(&style, 0, sizeof style);
        picture want = draw(&m, &style, azimuth), got[2];
        got[0] = draw(&shared, &style, azimuth);
        got[1] = draw(&apart, &style, azimuth);
        style.unlit = true;
        style.face_color = color;
        picture mixed = draw(&apart, &style, azimuth);
        for (int y = 0; y < HEIGHT; y++) {
            for (int x = 0; x < WIDTH; x++) {
                const rgb mean = {100, 0, 100};
                bool inside = hypot(x + 0.5 - WIDTH / 2, y + 0.5 - HEIGHT / 2) < 0.45 * HEIGHT;
                const int k = y * WIDTH + x;
                assert_true(!inside || difference(mixed.at[k], mean) <= 1);
                assert_true(!inside || difference(want.at[k], got[0].at[k]) <= 2);
                assert_true(!inside || difference(want.at[k], got[1].at[k]) <= 2);
            }
        }
        picture_free(&mixed);
        picture_free(&got[1]);
        picture_free(&got[0]);
        picture_free(&want);
    }
    free(color);
    mesh_free(&apart);
    mesh_free(&shared);
    mesh_free(&m);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(parts_have_the_area_of_the_triangle),
        cmocka_unit_test(parts_end_at_the_raster),
        cmocka_unit_test(needles_show_their_mean_color),
        cmocka_unit_test(needles_hide_what_is_behind),
        cmocka_unit_test(lone_needles_have_their_area),
        cmocka_unit_test(lines_have_their_width),
        cmocka_unit_test(opposed_faces_are_drawn_without_speckles),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

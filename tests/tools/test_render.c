/* test_render.c: pixels of known triangles: position, visibility, color, isolines, marks */
#include "tests/lib/test.h"

#include "tools/draw/picture.h"
#include "tools/draw/render.h"
#include "tools/mesh/surface_generator.h"

static const rgb white = {255, 255, 255}, red = {200, 0, 0}, blue = {0, 0, 200};

static bool is_color(rgb a, rgb b) {
    return a.r == b.r && a.g == b.g && a.b == b.b;
}

static rgb pixel(const picture *p, int x, int y) {
    assert_true(x >= 0 && y >= 0 && x < p->width && y < p->height);
    return p->at[y * p->width + x];
}

static render_view view_with_size(int width, int height) {
    render_view view = render_view_default();
    view.width = width;
    view.height = height;
    return view;
}

static int count_color(const picture *p, rgb color) {
    int count = 0;
    for (int k = 0; k < p->width * p->height; k++) {
        count += is_color(p->at[k], color);
    }
    return count;
}

/* A right triangle in the plane seen from above fills the picture except for a margin of 4 %. */
static void a_triangle_fills_the_expected_pixels(void **state) {
    (void)state;
    double xyz[9] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
    sl_int faces[3] = {0, 1, 2};
    const mesh m = {3, 1, xyz, faces};
    render_view view = view_with_size(100, 100);
    render_style style;
    picture p;
    memset(&style, 0, sizeof style);
    style.face_color = &red;
    style.unlit = true;
    assert_true(render_mesh(&p, &m, &view, &style));
    assert_true(p.width == 100 && p.height == 100);
    for (int y = 0; y < 100; y++) {
        /* Inside: x >= 4, y <= 96, x - 4 <= y - 4. */
        for (int x = 0; x < 100; x++) {
            bool inside = x >= 4 && y < 96 && x < y - 1, outside = x < 4 || y >= 96 || x > y + 1;
            rgb got = pixel(&p, x, y);
            assert_true(!inside || is_color(got, red));
            assert_true(!outside || is_color(got, white));
        }
    }
    picture_free(&p);
    view.zoom = 0.5; /* half as large around the center */
    assert_true(render_mesh(&p, &m, &view, &style));
    int half = count_color(&p, red);
    assert_true(abs(half - 46 * 46 / 2) < 60);
    picture_free(&p);
    view.zoom = 1;
    const double box[6] = {0, -1, 0, 2, 1, 0}; /* with room for it: in the upper left quarter */
    style.box = box;
    for (int turn = 0; turn < 2; turn++) { /* also with perspective, which changes nothing here */
        view.perspective = 3 * turn;
        assert_true(render_mesh(&p, &m, &view, &style));
        half = count_color(&p, red);
        assert_true(abs(half - 46 * 46 / 2) < 60);
        assert_true(is_color(pixel(&p, 10, 45), red) && is_color(pixel(&p, 10, 55), white));
        picture_free(&p);
    }
    const double far[6] = {0, 0, 0, 1e200, 1, 1}; /* cannot be drawn, and is left out */
    style.box = far;
    assert_true(render_mesh(&p, &m, &view, &style));
    assert_true(abs(count_color(&p, red) - 92 * 92 / 2) < 120);
    picture_free(&p);
    style.box = NULL;
    view.perspective = 0;
    faces[1] = 2, faces[2] = 1; /* it looks the same from behind */
    assert_true(render_mesh(&p, &m, &view, &style));
    assert_true(is_color(pixel(&p, 20, 80), red));
    picture_free(&p);
}

/* Two squares, one behind the other: the nearer one hides the other, whatever their order and the
 * camera. */
static void nearer_faces_hide_farther_ones(void **state) {
    (void)state;
    double xyz[24] = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 0, 0, 1, 1, 0, 1, 1, 1, 1, 0, 1, 1};
    sl_int faces[12] = {0, 1, 2, 0, 2, 3, 4, 5, 6, 4, 6, 7};
    const rgb color[4] = {red, red, blue, blue};
    const mesh m = {8, 4, xyz, faces};
    render_style style;
    memset(&style, 0, sizeof style);
    style.face_color = color;
    style.unlit = true;
    for (int perspective = 0; perspective <= 3; perspective += 3) {
        /* Around y, then along z from above and below. */
        for (int side = 0; side < 6; side++) {
            render_view view = view_with_size(60, 60);
            picture p;
            view.azimuth = side < 4 ? 90 * side : 0;
            view.elevation = 0;
            view.perspective = perspective;
            view.up = side < 4 ? CAMERA_UP_Y : CAMERA_UP_Z;
            view.elevation = side == 4 ? 90 : side == 5 ? -90 : 0;
            assert_true(render_mesh(&p, &m, &view, &style));
            if (side == 0 || side == 4) { /* from +z */
                assert_true(is_color(pixel(&p, 30, 30), blue) && count_color(&p, red) == 0);
            } else if (side == 2 || side == 5) {
                assert_true(is_color(pixel(&p, 30, 30), red) && count_color(&p, blue) == 0);
            }
            picture_free(&p);
        }
    }
}

/* The same picture with more pixels: lines, marks and edges are as wide as before. */
static void larger_scales_show_the_same(void **state) {
    (void)state;
    mesh m;
    assert_true(surface_generate(&m, "sphere:1", NULL, 0));
    double *height = test_reals((size_t)m.n_vertices);
    for (int v = 0; v < m.n_vertices; v++) {
        height[v] = m.xyz[3 * v + 1];
    }
    const render_mark mark = {4, 9, {200, 0, 0}};
    const render_segment line = {0, 4, 3, {0, 0, 200}};
    render_style style;
    memset(&style, 0, sizeof style);
    style.scalar = height;
    style.isolines = 5;
    style.edges = 1;
    style.marks = &mark;
    style.n_marks = 1;
    style.segments = &line;
    style.n_segments = 1;
    picture one, p;
    render_view view = view_with_size(200, 150);
    assert_true(render_mesh(&one, &m, &view, &style));
    for (view.scale = 2; view.scale <= 4; view.scale += 2) {
        double difference = 0;
        assert_true(render_mesh(&p, &m, &view, &style));
        assert_true(p.width == 200 * view.scale && p.height == 150 * view.scale);
        picture_shrink(&p, view.scale);
        for (int k = 0; k < 200 * 150; k++) {
            difference += abs(p.at[k].r - one.at[k].r) + abs(p.at[k].b - one.at[k].b);
        }
        assert_true(difference < 4 * 200 * 150);
        picture_free(&p);
    }
    view.scale = 0;
    assert_false(render_mesh(&p, &m, &view, &style));
    view.scale = 41; /* 8200 pixels */
    assert_false(render_mesh(&p, &m, &view, &style));
    picture_free(&one);
    free(height);
    mesh_free(&m);
}

/* The axes of the view are right-handed for every direction: a face seen from its front is never
 * mirrored. */
static void views_are_not_mirrored(void **state) {
    (void)state;
    static const camera_up ups[3] = {CAMERA_UP_X, CAMERA_UP_Y, CAMERA_UP_Z};
    double xyz[12] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1};
    sl_int faces[12] = {0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3};
    const mesh m = {4, 4, xyz, faces}; /* a corner whose faces look outward */
    const rgb color[4] = {{1, 0, 0}, {2, 0, 0}, {3, 0, 0}, {4, 0, 0}};
    for (int u = 0; u < 3; u++) {
        for (int azimuth = -170; azimuth < 190; azimuth += 23) {
            render_view view = view_with_size(80, 80);
            render_style style;
            render_mark marks[3];
            picture p;
            double x[3], y[3], weight[3];
            memset(&style, 0, sizeof style);
            style.face_color = color;
            style.unlit = true;
            view.up = ups[u];
            view.azimuth = azimuth;
            view.elevation = 25;
            style.marks = marks;
            style.n_marks = 3;
            for (int k = 0; k < 3; k++) {
                const rgb own = {0, (unsigned char)(100 + 50 * k), 0};
                marks[k].vertex = 1 + k;
                marks[k].radius = 3;
                marks[k].color = own;
                x[k] = y[k] = weight[k] = 0;
            }
            assert_true(render_mesh(&p, &m, &view, &style));
            for (int k = 0; k < 80 * 80; k++) {
                for (int c = 0; c < 3; c++) {
                    if (is_color(p.at[k], marks[c].color)) {
                        x[c] += k % 80;
                        y[c] += k / 80;
                        weight[c]++;
                    }
                }
            }
            if (weight[0] > 10 && weight[1] > 10 && weight[2] > 10) {
                for (int c = 0; c < 3; c++) {
                    x[c] /= weight[c];
                    y[c] /= weight[c];
                }
                /* The face 1 2 3 looks toward (1, 1, 1). On the screen it is counterclockwise
                 * exactly if it is visible. */
                double turn = (x[1] - x[0]) * (y[2] - y[0]) - (y[1] - y[0]) * (x[2] - x[0]);
                bool seen = count_color(&p, color[3]) > 0;
                assert_true(fabs(turn) < 40 || (turn < 0) == seen);
            }
            picture_free(&p);
        }
    }
}

/* A scalar equal to x: the colors of the map from end to end, isolines at the levels. */
static void scalars_and_isolines_have_the_expected_colors(void **state) {
    (void)state;
    mesh m;
    assert_true(surface_generate(&m, "grid:21x21", NULL, 0));
    double *x = test_reals(441);
    for (int v = 0; v < 441; v++) {
        x[v] = m.xyz[3 * v];
    }
    render_view view = view_with_size(200, 200);
    render_style style;
    picture p;
    memset(&style, 0, sizeof style);
    style.scalar = x;
    style.unlit = true;
    assert_true(render_mesh(&p, &m, &view, &style));
    for (int k = 0; k < 20; k++) {
        int column = 10 + 9 * k;
        double t = (column + 0.5 - 8) / 184;
        rgb want = color_map(t), got = pixel(&p, column, 20 + 8 * k);
        assert_true(abs(want.r - got.r) + abs(want.g - got.g) + abs(want.b - got.b) < 12);
    }
    picture_free(&p);
    style.isolines = 3;
    assert_true(render_mesh(&p, &m, &view, &style));
    for (int column = 9; column < 191; column++) {
        double t = (column + 0.5 - 8) / 184;
        rgb got = pixel(&p, column, 100), want = color_map(t);
        bool plain = abs(want.r - got.r) + abs(want.g - got.g) + abs(want.b - got.b) < 12;
        /* Distance to the nearest level in pixels. */
        double off = fabs(t * 4 - floor(t * 4 + 0.5)) * 184 / 4;
        bool level = floor(t * 4 + 0.5) >= 1 && floor(t * 4 + 0.5) <= 3;
        assert_true(off < 2 || plain);
        assert_true(!(level && off < 0.5) || !plain);
    }
    picture_free(&p);
    for (int v = 0; v < 441; v++) {
        x[v] = NAN;
    }
    assert_true(render_mesh(&p, &m, &view, &style));
    assert_true(is_color(pixel(&p, 100, 100), color_map(NAN)));
    picture_free(&p);
    free(x);
    mesh_free(&m);
}

static void layouts_draw_a_checkerboard(void **state) {
    (void)state;
    double xyz[12] = {0, 0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1}; /* seen from z, on edge */
    double uv[8] = {0, 0, 2, 0, 2, 2, 0, 2};
    sl_int faces[6] = {0, 1, 2, 0, 2, 3};
    const mesh m = {4, 2, xyz, faces};
    render_view view = view_with_size(100, 100);
    render_style style;
    picture p;
    memset(&style, 0, sizeof style);
    style.uv = uv;
    style.checks = 1;
    assert_true(render_layout(&p, &m, uv, &view, &style));
    /* A square of 2 x 2 fields with equal colors along a diagonal. */
    rgb a = pixel(&p, 27, 73), b = pixel(&p, 73, 73), c = pixel(&p, 27, 27), d = pixel(&p, 73, 27);
    assert_true(is_color(a, d) && is_color(b, c) && !is_color(a, b));
    picture_free(&p);
    uv[4] = NAN; /* Both faces have that corner, so nothing is drawn. */
    assert_true(render_layout(&p, &m, uv, &view, &style));
    assert_true(count_color(&p, white) == 10000);
    picture_free(&p);
}

static void degenerate_meshes_are_drawn(void **state) {
    (void)state;
    double xyz[12] = {0, 0, 0, 1e300, 0, 0, 0, 1, 0, 1, 1, 0};
    sl_int faces[9] = {0, 0, 0, 0, 1, 2, 2, 3, 0};
    mesh m = {4, 3, xyz, faces};
    render_view view = view_with_size(50, 40);
    render_style style;
    picture p;
    memset(&style, 0, sizeof style);
    assert_true(render_mesh(&p, &m, &view, &style)); /* the face with 1e300 is left out */
    assert_true(count_color(&p, white) < 50 * 40);
    picture_free(&p);
    m.n_faces = 1;
    assert_true(render_mesh(&p, &m, &view, &style));
    assert_true(count_color(&p, white) == 50 * 40);
    picture_free(&p);
    m.n_faces = m.n_vertices = 0;
    assert_true(render_mesh(&p, &m, &view, &style));
    picture_free(&p);
    view.width = 0;
    assert_false(render_mesh(&p, &m, &view, &style));
    assert_null(p.at);
    view.width = 100000;
    assert_false(render_mesh(&p, &m, &view, &style));
}

static void lines_disks_and_boxes_cover_the_expected_pixels(void **state) {
    (void)state;
    picture p, q;
    assert_true(picture_create(&p, 40, 30, white));
    picture_disk(&p, 20, 15, 10, red);
    assert_true(abs(count_color(&p, red) - 314) < 8);
    picture_box(&p, -5, -5, 2, 3, blue);
    assert_int_equal(count_color(&p, blue), 6);
    picture_line(&p, 0.5, 29.5, 39.5, 29.5, 1, blue);
    assert_int_equal(count_color(&p, blue), 46);
    picture_line(&p, -1e9, 5, 1e300, 5, 1, blue); /* too long to be drawn */
    picture_disk(&p, NAN, 3, 4, blue);
    assert_int_equal(count_color(&p, blue), 46);
    assert_true(picture_create(&q, 10, 10, red));
    picture_paste(&p, &q, 35, -5);
    assert_true(is_color(pixel(&p, 39, 4), red) && is_color(pixel(&p, 39, 5), white));
    picture_shrink(&q, 3);
    assert_true(q.width == 3 && is_color(q.at[8], red));
    picture_free(&q);
    picture_free(&p);
    assert_false(picture_create(&p, 0, 5, white));
    assert_false(picture_create(&p, 5, 20000, white));
    rgb low = {0x44, 0x01, 0x54}, high = {0xfd, 0xe7, 0x25};
    assert_true(is_color(color_map(-1), low) && is_color(color_map(2), high));
    /* Lightness rises monotonically. */
    for (double t = 0, before = -1; t <= 1; t += 0.01) {
        rgb c = color_map(t);
        double light = 0.2126 * c.r + 0.7152 * c.g + 0.0722 * c.b;
        assert_true(light >= before - 1);
        before = light;
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_triangle_fills_the_expected_pixels),
        cmocka_unit_test(nearer_faces_hide_farther_ones),
        cmocka_unit_test(larger_scales_show_the_same),
        cmocka_unit_test(views_are_not_mirrored),
        cmocka_unit_test(scalars_and_isolines_have_the_expected_colors),
        cmocka_unit_test(layouts_draw_a_checkerboard),
        cmocka_unit_test(degenerate_meshes_are_drawn),
        cmocka_unit_test(lines_disks_and_boxes_cover_the_expected_pixels),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

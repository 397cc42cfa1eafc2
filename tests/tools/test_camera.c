/* test_camera.c: the camera for each upward axis: right-handed, faces not mirrored; --up auto */
#include "tests/lib/test.h"

#include "tools/draw/camera.h"
#include "tools/draw/picture.h"
#include "tools/draw/render.h"
#include "tools/draw/thin_view.h"
#include "tools/draw/upward.h"

static const camera_up ups[3] = {CAMERA_UP_X, CAMERA_UP_Y, CAMERA_UP_Z};
static const int up_axis[3] = {0, 1, 2};

static void cross(double out[3], const double a[3], const double b[3]) {
    for (int d = 0; d < 3; d++) {
        out[d] = a[(d + 1) % 3] * b[(d + 2) % 3] - a[(d + 2) % 3] * b[(d + 1) % 3];
    }
}

/* right x up = toward the camera, all of length 1, and camera_angles inverts camera_axes. */
static void axes_are_right_handed(void **state) {
    (void)state;
    for (int u = 0; u < 3; u++) {
        for (int azimuth = -170; azimuth < 180; azimuth += 35) {
            for (int elevation = -80; elevation <= 80; elevation += 20) {
                double axes[3][3], product[3], a = NAN, e = NAN;
                camera_axes(axes, ups[u], azimuth, elevation);
                cross(product, axes[0], axes[1]);
                for (int d = 0; d < 3; d++) {
                    assert_true(fabs(product[d] - axes[2][d]) < 1e-14);
                }
                assert_true(fabs(axes[0][up_axis[u]]) < 1e-14); /* the horizon is level */
                assert_true(axes[1][up_axis[u]] > 0);
                camera_angles(&a, &e, ups[u], axes[2]);
                assert_true(fabs(a - azimuth) < 1e-10 && fabs(e - elevation) < 1e-10);
            }
        }
    }
}

static void bad_directions_change_nothing(void **state) {
    (void)state;
    const double bad[3][3] = {{0, 0, 0}, {NAN, 1, 0}, {0, INFINITY, 0}};
    for (int k = 0; k < 3; k++) {
        double azimuth = 12, elevation = 34;
        camera_angles(&azimuth, &elevation, CAMERA_UP_Z, bad[k]);
        assert_true(azimuth == 12 && elevation == 34);
    }
}

/* Mean position of the pixels of one color; returns how many there are. */
static int find_color(double at[2], const picture *p, rgb color) {
    int count = 0;
    at[0] = at[1] = 0;
    for (int k = 0; k < p->width * p->height; k++) {
        const rgb *c = &p->at[k];
        if (c->r == color.r && c->g == color.g && c->b == color.b) {
            at[0] += k % p->width;
            at[1] += k / p->width;
            count++;
        }
    }
    at[0] /= count;
    at[1] /= count;
    return count;
}

/* A triangle with marked corners, and one behind it as seen against its normal. A camera turned to
 * the normal sees the first one, its corners counterclockwise and in their true shape. */
static void a_face_seen_from_its_front(void **state) {
    (void)state;
    static const double normals[8][3] = {{1, 0, 0},  {0, 1, 0},    {0, 0, 1},      {-1, 0, 0},
                                         {0, 0, -1}, {1, 2, -0.5}, {-2, 0.3, 0.7}, {0.4, -1, -1}};
    const rgb front = {200, 0, 0}, back = {0, 0, 200};
    for (int k = 0; k < 24; k++) {
        const double *n = normals[k / 3];
        const double some[3] = {0.3, -0.5, 0.8};
        double xyz[18], a[3], b[3], at[3][2];
        cross(a, n, some);
        cross(b, n, a); /* a, b, n: right-handed, at right angles */
        double la = sqrt(a[0] * a[0] + a[1] * a[1] + a[2] * a[2]);
        double lb = sqrt(b[0] * b[0] + b[1] * b[1] + b[2] * b[2]);
        double ln = sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
        for (int d = 0; d < 3; d++) {
            double p = a[d] / la, q = b[d] / lb, depth = n[d] / ln;
            xyz[d] = 0;
            xyz[3 + d] = 2 * p; /* sides 2 and 1 */
            xyz[6 + d] = q;
            xyz[9 + d] = 0.1 * p + 0.1 * q - depth;
            xyz[12 + d] = 0.8 * p + 0.1 * q - depth;
            xyz[15 + d] = 0.1 * p + 0.5 * q - depth;
        }
        sl_int faces[6] = {0, 1, 2, 3, 4, 5};
        const mesh m = {6, 2, xyz, faces};
        const rgb colors[2] = {front, back};
        render_mark marks[3];
        render_style style;
        render_view view = render_view_default();
        picture p;
        for (int c = 0; c < 3; c++) {
            const rgb own = {0, (unsigned char)(100 + 50 * c), 0};
            marks[c].vertex = c;
            marks[c].radius = 3;
            marks[c].color = own;
        }
        memset(&style, 0, sizeof style);
        style.face_color = colors;
        style.unlit = true;
        style.marks = marks;
        style.n_marks = 3;
        view.width = view.height = 200;
        view.automatic = false;
        view.up = ups[k % 3];
        render_look_from(&view, n);
        assert_true(render_mesh(&p, &m, &view, &style));
        double none[2];
        assert_true(find_color(none, &p, front) > 1000);
        assert_int_equal(find_color(none, &p, back), 0);
        for (int c = 0; c < 3; c++) {
            assert_true(find_color(at[c], &p, marks[c].color) > 10);
        }
        double u[2] = {at[1][0] - at[0][0], at[0][1] - at[1][1]}; /* screen y points down */
        double v[2] = {at[2][0] - at[0][0], at[0][1] - at[2][1]};
        assert_true(u[0] * v[1] - u[1] * v[0] > 0);
        assert_true(fabs(u[0] * v[0] + u[1] * v[1]) < 0.02 * hypot(u[0], u[1]) * hypot(v[0], v[1]));
        assert_true(fabs(hypot(u[0], u[1]) - 2 * hypot(v[0], v[1])) < 4);
        picture_free(&p);
    }
}

/* Guesses for two opposite sides of a box at `from`, or for a square with one corner raised. */
static camera_up guess(const double from[3], const double size[3], bool relief) {
    double xyz[24];
    sl_int faces[12] = {0, 1, 2, 1, 3, 2, 4, 6, 5, 5, 6, 7};
    const char *reason;
    for (int k = 0; k < 8; k++) {
        for (int d = 0; d < 3; d++) {
            xyz[3 * k + d] = from[d] + (k >> d & 1) * size[d];
        }
    }
    if (relief) {
        xyz[2] = from[2] + size[2];
    }
    const mesh m = {8, relief ? 2 : 4, xyz, faces};
    const camera_up up = upward_of(&m, &reason);
    assert_true((up == CAMERA_UP_Z) == (reason != NULL));
    return up;
}

static void upward_axes_are_guessed(void **state) {
    (void)state;
    static const struct {
        double from[3], size[3];
        bool relief;
        camera_up up;
    } cases[] = {{{-1, -1, 0}, {2, 2, 2}, false, CAMERA_UP_Z},    /* on z = 0 */
                 {{-1, -1, 1e-4}, {2, 2, 2}, false, CAMERA_UP_Z}, /* nearly */
                 {{-1, -1, 0.1}, {2, 2, 2}, false, CAMERA_UP_Y},  /* not on z = 0 */
                 {{-1, 0, -1}, {2, 2, 2}, false, CAMERA_UP_Y},    /* on y = 0 */
                 {{0, 0, 0}, {2, 2, 2}, false, CAMERA_UP_Y},      /* moved to the positive octant */
                 {{-1, -1, -2}, {2, 2, 4}, false, CAMERA_UP_Z},   /* a column along z */
                 {{-1, 0, -2}, {2, 2, 4}, false, CAMERA_UP_Y},    /* a car along z, on y = 0 */
                 {{-1, -1, -1}, {2, 2, 2.9}, false, CAMERA_UP_Y}, /* not long enough */
                 {{-1, -2, -1}, {2, 4, 2}, false, CAMERA_UP_Y},   /* a column along y */
                 {{3, 3, 7}, {2, 2, 0.5}, true, CAMERA_UP_Z},     /* a hill */
                 {{3, 3, 7}, {2, 2, 0.5}, false, CAMERA_UP_Y},    /* a flat box */
                 {{3, 3, 7}, {2, 2, 1}, true, CAMERA_UP_Y},       /* too high for a relief */
                 {{-1, -1, 0}, {2, 2, 0}, false, CAMERA_UP_Y},    /* flat */
                 {{-1e300, -1, 0}, {2, 2, NAN}, false, CAMERA_UP_Y}};
    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
        assert_int_equal(guess(cases[k].from, cases[k].size, cases[k].relief), cases[k].up);
    }
    const mesh none = {0, 0, NULL, NULL};
    const char *reason;
    assert_int_equal(upward_of(&none, &reason), CAMERA_UP_Y);
}

/* A strip of `count` squares in some direction, with a wide side 4 and a narrow side 0.1. */
static mesh strip_along(const double along[3], const double wide[3], sl_int count) {
    mesh m = {2 * count + 2, 2 * count, test_reals(6 * (size_t)count + 6),
              test_ints(6 * (size_t)count)};
    for (sl_int k = 0; k <= count; k++) {
        for (int d = 0; d < 3; d++) {
            m.xyz[6 * k + d] = 7 + k * along[d];
            m.xyz[6 * k + 3 + d] = 7 + k * along[d] + wide[d];
        }
    }
    for (sl_int k = 0; k < count; k++) {
        const sl_int corners[6] = {2 * k, 2 * k + 2, 2 * k + 1, 2 * k + 1, 2 * k + 2, 2 * k + 3};
        memcpy(m.faces + 6 * k, corners, sizeof corners);
    }
    return m;
}

/* A long strip lies along the diagonal of the picture, its normal toward the camera, the camera on
 * the side where it was; a short one changes nothing. */
static void thin_meshes_lie_along_the_diagonal(void **state) {
    (void)state;
    static const double along[4][3] = {{1, 0, 0}, {0, 1, 0}, {0.6, 0, 0.8}, {-0.48, 0.6, 0.64}};
    static const double wide[4][3] = {{0, 0, 4}, {3, 0, 0}, {0, 2, 0}, {0.8, 0, 0.6}};
    for (int k = 0; k < 4; k++) {
        double axes[3][3], before[3][3], normal[3], product[3];
        camera_axes(before, CAMERA_UP_Y, 30, 20);
        memcpy(axes, before, sizeof axes);
        mesh m = strip_along(along[k], wide[k], 200);
        assert_true(thin_view_turn(axes, &m, 0.75));
        cross(product, axes[0], axes[1]);
        cross(normal, along[k], wide[k]);
        const double size =
            sqrt(normal[0] * normal[0] + normal[1] * normal[1] + normal[2] * normal[2]);
        double x = 0, y = 0, toward = 0, side = 0;
        for (int d = 0; d < 3; d++) {
            assert_true(fabs(product[d] - axes[2][d]) < 1e-12);
            x += axes[0][d] * along[k][d];
            y += axes[1][d] * along[k][d];
            toward += axes[2][d] * normal[d] / size;
            side += axes[2][d] * before[2][d];
        }
        assert_true(fabs(atan2(fabs(y), fabs(x)) - 0.9 * atan(0.75)) < 0.02);
        assert_true(fabs(toward) > 0.999 && side >= 0);
        mesh_free(&m);
        m = strip_along(along[k], wide[k], 8);
        memcpy(axes, before, sizeof axes);
        assert_false(thin_view_turn(axes, &m, 0.75));
        assert_memory_equal(axes, before, sizeof axes);
        m.xyz[0] = INFINITY;
        assert_false(thin_view_turn(axes, &m, 0.75));
        m.n_faces = 0;
        assert_false(thin_view_turn(axes, &m, 0.75));
        mesh_free(&m);
    }
}

/* A picture of a strip of 1000 to 4: it reaches over most of the height. */
static void thin_meshes_fill_the_picture(void **state) {
    (void)state;
    const double along[3] = {1, 0, 0}, wide[3] = {0, 0, 4};
    mesh m = strip_along(along, wide, 1000);
    const render_view view = render_view_default();
    const render_style style = {.unlit = true};
    picture p;
    int top = -1, bottom = -1;
    assert_true(render_mesh(&p, &m, &view, &style));
    for (int k = 0; k < p.width * p.height; k++) {
        if (p.at[k].r != 255 || p.at[k].g != 255 || p.at[k].b != 255) {
            top = top < 0 ? k / p.width : top;
            bottom = k / p.width;
        }
    }
    assert_true(bottom - top > p.height / 2);
    picture_free(&p);
    mesh_free(&m);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(axes_are_right_handed),
        cmocka_unit_test(bad_directions_change_nothing),
        cmocka_unit_test(a_face_seen_from_its_front),
        cmocka_unit_test(upward_axes_are_guessed),
        cmocka_unit_test(thin_meshes_lie_along_the_diagonal),
        cmocka_unit_test(thin_meshes_fill_the_picture),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

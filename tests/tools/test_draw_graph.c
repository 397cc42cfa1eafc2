/* test_draw_graph.c: draw_graph projects a flat mesh along the axis in which it is flat */
#define _POSIX_C_SOURCE 200809L
#include "tests/lib/temporary_files.h"

#include "tools/draw/draw_graph.h"

/* A right triangle in each coordinate plane: three distinct corners, not on one line, fill the
 * picture. */
static void the_flat_axis_is_projected_away(void **state) {
    (void)state;
    for (int flat = 0; flat < 3; flat++) {
        double xyz[9] = {0}, x[3], y[3];
        sl_int faces[3] = {0, 1, 2};
        const mesh m = {3, 1, xyz, faces};
        size_t length = 0;
        xyz[3 + (flat + 1) % 3] = 1;
        xyz[6 + (flat + 2) % 3] = 1;
        const char *path = files_path("graph.svg");
        assert_true(draw_graph(path, &m, NULL, NULL, 0));
        char *svg = files_get(path, &length);
        const char *at = svg;
        for (int k = 0; k < 3; k++) {
            at = strstr(at, "<circle ");
            assert_non_null(at);
            assert_int_equal(sscanf(at, "<circle cx=\"%lf\" cy=\"%lf\"", &x[k], &y[k]), 2);
            at++;
        }
        double area = (x[1] - x[0]) * (y[2] - y[0]) - (y[1] - y[0]) * (x[2] - x[0]);
        assert_true(fabs(area) > 300 * 300);
        free(svg);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_flat_axis_is_projected_away),
    };
    return cmocka_run_group_tests(tests, files_set_up, files_tear_down);
}

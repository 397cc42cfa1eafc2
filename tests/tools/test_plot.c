/* test_plot.c: plots written as SVG: positions of points, ticks, legends, omitted points */
#define _POSIX_C_SOURCE 200809L
#include "tests/lib/temporary_files.h"

#include "tools/draw/plot.h"

static char *write_and_read(const plot *p) {
    char message[300] = "";
    size_t length = 0;
    assert_true(plot_write(p, files_path("p.svg"), message, sizeof message));
    return files_get(files_path("p.svg"), &length);
}

static int occurrences(const char *text, const char *word) {
    int count = 0;
    for (const char *at = strstr(text, word); at != NULL; at = strstr(at + 1, word)) {
        count++;
    }
    return count;
}

static void points_have_the_expected_positions(void **state) {
    (void)state;
    plot *p = plot_create("a < b & c", "x", "y", false, false);
    assert_non_null(p);
    assert_true(plot_add(p, "one", PLOT_LINES, 0, 0) && plot_add(p, "one", PLOT_LINES, 10, 5) &&
                plot_add(p, "one", PLOT_LINES, 5, 2.5));
    assert_true(plot_add(p, "two", PLOT_POINTS, NAN, 1) &&
                plot_add(p, "two", PLOT_POINTS, 1, HUGE_VAL));
    char *svg = write_and_read(p);
    double x[3], y[3];
    const char *line = strstr(svg, "points=\"");
    assert_non_null(line);
    assert_int_equal(
        sscanf(line, "points=\"%lf,%lf %lf,%lf %lf,%lf", &x[0], &y[0], &x[1], &y[1], &x[2], &y[2]),
        6);
    /* y points down */
    assert_true(x[0] < x[2] && x[2] < x[1] && y[0] > y[2] && y[2] > y[1]);
    assert_true(fabs(x[2] - (x[0] + x[1]) / 2) < 0.02 && fabs(y[2] - (y[0] + y[1]) / 2) < 0.02);
    assert_true(occurrences(svg, "<circle") == 3 && occurrences(svg, "a &lt; b &amp; c") == 1);
    /* One series has no legend. */
    assert_true(strstr(svg, ">10</text>") != NULL && strstr(svg, ">one<") == NULL);
    assert_true(strstr(svg, "nan") == NULL && strstr(svg, "inf") == NULL);
    free(svg);
    /* The legend has a line and a dot. */
    assert_true(plot_add(p, "two", PLOT_POINTS, 1, 1));
    svg = write_and_read(p);
    assert_true(strstr(svg, ">one<") != NULL && strstr(svg, ">two<") != NULL);
    assert_true(occurrences(svg, "h24\"") == 1 && occurrences(svg, "h0\"") == 1);
    free(svg);
    plot_free(p);
}

static void logarithmic_axes_space_powers_evenly(void **state) {
    (void)state;
    plot *p = plot_create("t", "x", "y", true, true);
    for (int k = 0; k < 5; k++) {
        assert_true(plot_add(p, "plain", PLOT_LINES, pow(10, k), pow(100, k)));
        assert_true(plot_add(p, "dashed", PLOT_DASHES, pow(10, k), 1 + k));
    }
    plot_color(p, "plain", 2);
    plot_color(p, "none of that name", 3);
    assert_true(plot_add(p, "plain", PLOT_LINES, -1, 5) && plot_add(p, "plain", PLOT_LINES, 5, 0));
    char *svg = write_and_read(p);
    double x[5], y[5];
    const char *line = strstr(svg, "points=\"");
    assert_int_equal(sscanf(line, "points=\"%lf,%lf %lf,%lf %lf,%lf %lf,%lf %lf,%lf", &x[0], &y[0],
                            &x[1], &y[1], &x[2], &y[2], &x[3], &y[3], &x[4], &y[4]),
                     10);
    /* Powers are evenly spaced. */
    for (int k = 1; k < 5; k++) {
        assert_true(fabs(x[k] - x[k - 1] - (x[1] - x[0])) < 0.03);
        assert_true(fabs(y[k] - y[k - 1] - (y[1] - y[0])) < 0.03);
    }
    assert_true(occurrences(svg, "<circle") == 10 && occurrences(svg, "dasharray") == 2);
    assert_true(strstr(svg, ">dashed</text>") != NULL && strstr(svg, "#009e73") != NULL);
    free(svg);
    plot_free(p);
}

static void bars_and_empty_plots_are_drawn(void **state) {
    (void)state;
    plot *p = plot_create("t", "x", "y", false, false);
    char *svg = write_and_read(p);
    assert_non_null(strstr(svg, "</svg>"));
    free(svg);
    assert_true(plot_add(p, "b", PLOT_BARS, 1, 4) && plot_add(p, "b", PLOT_BARS, 3, 2));
    svg = write_and_read(p);
    double from[2], top[2], to[2], foot[2];
    const char *bar = strstr(svg, "<g fill");
    for (int k = 0; k < 2; k++) {
        bar = strstr(bar, "<path d=\"M");
        assert_int_equal(
            sscanf(bar, "<path d=\"M%lf %lfV%lfH%lfV", &from[k], &foot[k], &top[k], &to[k]), 4);
        bar++;
    }
    /* Bars start at 0 and do not touch. */
    assert_true(to[0] < from[1] && foot[0] == foot[1]);
    assert_true(fabs((foot[0] - top[0]) - 2 * (foot[1] - top[1])) < 0.05);
    free(svg);
    /* Beyond the maximum, further series are refused. */
    for (int k = 0; k < 100; k++) {
        char name[200];
        (void)snprintf(name, sizeof name, "%03d%0150d", k, 0);
        assert_true(plot_add(p, name, PLOT_LINES, k, k) == (k < 31));
    }
    char message[300] = "";
    assert_false(plot_write(p, files_path("no/p.svg"), message, sizeof message));
    assert_non_null(strstr(message, "cannot be written"));
    plot_free(p);
    plot_free(NULL);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(points_have_the_expected_positions),
        cmocka_unit_test(logarithmic_axes_space_powers_evenly),
        cmocka_unit_test(bars_and_empty_plots_are_drawn),
    };
    return cmocka_run_group_tests(tests, files_set_up, files_tear_down);
}

/* test_plot.c: plots as SVG: where points fall, ticks, what is left out; options of commands: what is read, what refused */
#define _POSIX_C_SOURCE 200809L
#include "files.h"

#include "../tools/options.h"
#include "../tools/plot.h"

static char *drawn(const plot *p) {
    char message[300] = "";
    size_t length = 0;
    assert_true(plot_write(p, files_path("p.svg"), message, sizeof message));
    return files_get(files_path("p.svg"), &length);
}

static int count_of(const char *text, const char *word) {
    int count = 0;
    for (const char *at = strstr(text, word); at != NULL; at = strstr(at + 1, word)) {
        count++;
    }
    return count;
}

static void points_fall_where_they_belong(void **state) {
    (void)state;
    plot *p = plot_create("a < b & c", "x", "y", false, false);
    assert_non_null(p);
    assert_true(plot_add(p, "one", PLOT_LINES, 0, 0) && plot_add(p, "one", PLOT_LINES, 10, 5) &&
                plot_add(p, "one", PLOT_LINES, 5, 2.5));
    assert_true(plot_add(p, "two", PLOT_POINTS, NAN, 1) &&
                plot_add(p, "two", PLOT_POINTS, 1, HUGE_VAL));
    char *svg = drawn(p);
    double x[3], y[3];
    const char *line = strstr(svg, "points=\"");
    assert_non_null(line);
    assert_int_equal(
        sscanf(line, "points=\"%lf,%lf %lf,%lf %lf,%lf", &x[0], &y[0], &x[1], &y[1], &x[2], &y[2]),
        6);
    assert_true(x[0] < x[2] && x[2] < x[1] && y[0] > y[2] && y[2] > y[1]); /* up is less */
    assert_true(fabs(x[2] - (x[0] + x[1]) / 2) < 0.02 && fabs(y[2] - (y[0] + y[1]) / 2) < 0.02);
    assert_true(count_of(svg, "<circle") == 3 && count_of(svg, "a &lt; b &amp; c") == 1);
    assert_true(strstr(svg, ">10</text>") != NULL &&
                strstr(svg, ">one<") == NULL); /* one: no legend */
    assert_true(strstr(svg, "nan") == NULL && strstr(svg, "inf") == NULL);
    free(svg);
    plot_free(p);
}

static void logarithmic_axes(void **state) {
    (void)state;
    plot *p = plot_create("t", "x", "y", true, true);
    for (int k = 0; k < 5; k++) {
        assert_true(plot_add(p, "plain", PLOT_LINES, pow(10, k), pow(100, k)));
        assert_true(plot_add(p, "dashed", PLOT_DASHES, pow(10, k), 1 + k));
    }
    plot_color(p, "plain", 2);
    plot_color(p, "none of that name", 3);
    assert_true(plot_add(p, "plain", PLOT_LINES, -1, 5) && plot_add(p, "plain", PLOT_LINES, 5, 0));
    char *svg = drawn(p);
    double x[5], y[5];
    const char *line = strstr(svg, "points=\"");
    assert_int_equal(sscanf(line, "points=\"%lf,%lf %lf,%lf %lf,%lf %lf,%lf %lf,%lf", &x[0], &y[0],
                            &x[1], &y[1], &x[2], &y[2], &x[3], &y[3], &x[4], &y[4]),
                     10);
    for (int k = 1; k < 5; k++) { /* powers are evenly spaced */
        assert_true(fabs(x[k] - x[k - 1] - (x[1] - x[0])) < 0.03);
        assert_true(fabs(y[k] - y[k - 1] - (y[1] - y[0])) < 0.03);
    }
    assert_true(count_of(svg, "<circle") == 10 && count_of(svg, "dasharray") == 2);
    assert_true(strstr(svg, ">dashed</text>") != NULL && strstr(svg, "#009e73") != NULL);
    free(svg);
    plot_free(p);
}

static void bars_and_nothing(void **state) {
    (void)state;
    plot *p = plot_create("t", "x", "y", false, false);
    char *svg = drawn(p);
    assert_non_null(strstr(svg, "</svg>"));
    free(svg);
    assert_true(plot_add(p, "b", PLOT_BARS, 1, 4) && plot_add(p, "b", PLOT_BARS, 3, 2));
    svg = drawn(p);
    double from[2], top[2], to[2], foot[2];
    const char *bar = strstr(svg, "<g fill");
    for (int k = 0; k < 2; k++) {
        bar = strstr(bar, "<path d=\"M");
        assert_int_equal(
            sscanf(bar, "<path d=\"M%lf %lfV%lfH%lfV", &from[k], &foot[k], &top[k], &to[k]), 4);
        bar++;
    }
    assert_true(to[0] < from[1] && foot[0] == foot[1]); /* bars begin at 0, and do not touch */
    assert_true(fabs((foot[0] - top[0]) - 2 * (foot[1] - top[1])) < 0.05);
    free(svg);
    for (int k = 0; k < 100; k++) { /* too many names are refused, not written beyond */
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

/* ---- options ---- */

typedef struct read_t {
    bool flag;
    sl_int count;
    double real;
    const char *text, *operands[2];
    char message[200];
} read_t;

static options_result parse(read_t *r, int argc, ...) {
    static char words[12][64];
    char *argv[14] = {NULL};
    const options_usage usage = {"cmd", "ONE [TWO]", 1, 2, "text"};
    memset(r, 0, sizeof *r);
    const option table[] = {{OPTION_FLAG, "flag", &r->flag, NULL, ""},
                            {OPTION_COUNT, "count", &r->count, "K", ""},
                            {OPTION_REAL, "real", &r->real, "X", ""},
                            {OPTION_TEXT, "text", &r->text, "T", ""},
                            {OPTION_END, NULL, NULL, NULL, NULL}};
    va_list list;
    va_start(list, argc);
    (void)snprintf(words[0], sizeof words[0], "cmd");
    argv[0] = words[0];
    for (int k = 1; k <= argc; k++) {
        (void)snprintf(words[k], sizeof words[k], "%s", va_arg(list, const char *));
        argv[k] = words[k];
    }
    va_end(list);
    return options_parse(&usage, table, argc + 1, argv, r->operands, r->message, sizeof r->message);
}

static void options_are_read(void **state) {
    (void)state;
    read_t r;
    assert_true(parse(&r, 8, "a", "--flag", "--count", "7", "--real=-1e3", "--text", "--x", "b") ==
                OPTIONS_READ);
    assert_true(r.flag && r.count == 7 && r.real == -1000);
    assert_string_equal(r.text, "--x");
    assert_string_equal(r.operands[0], "a");
    assert_string_equal(r.operands[1], "b");
    assert_true(parse(&r, 2, "--", "--flag") == OPTIONS_READ && !r.flag);
    assert_string_equal(r.operands[0], "--flag");
    assert_null(r.operands[1]);
    assert_true(parse(&r, 1, "-") == OPTIONS_READ); /* a lone dash is an operand */
    assert_true(parse(&r, 3, "--nonsense", "-h", "x") == OPTIONS_HELP);
    assert_true(parse(&r, 2, "a", "--text=") == OPTIONS_READ && r.text[0] == '\0');
}

static void options_are_refused(void **state) {
    (void)state;
    static const char *const bad[][2] = {{"--cou", "there is no option --cou"},
                                         {"-f", "there is no option -f"},
                                         {"--flag=1", "--flag takes no argument"},
                                         {"--count=-1", "not a whole number"},
                                         {"--count=1.5", "not a whole number"},
                                         {"--count=2147483648", "not a whole number"},
                                         {"--count=99999999999999999999", "not a whole number"},
                                         {"--count=", "not a whole number"},
                                         {"--real=1e999", "not a finite number"},
                                         {"--real=nan", "not a finite number"},
                                         {"--real=1x", "not a finite number"},
                                         {"--text", "--text needs T"}};
    read_t r;
    for (size_t k = 0; k < sizeof bad / sizeof *bad; k++) {
        assert_true(parse(&r, 2, "a", bad[k][0]) == OPTIONS_BAD);
        if (strstr(r.message, bad[k][1]) == NULL) {
            print_error("%s: %s\n", bad[k][0], r.message);
            fail();
        }
    }
    assert_true(parse(&r, 3, "a", "b", "c") == OPTIONS_BAD &&
                strstr(r.message, "c is one word too many"));
    assert_true(parse(&r, 1, "--flag") == OPTIONS_BAD && strstr(r.message, "needs ONE"));
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(points_fall_where_they_belong),
        cmocka_unit_test(logarithmic_axes),
        cmocka_unit_test(bars_and_nothing),
        cmocka_unit_test(options_are_read),
        cmocka_unit_test(options_are_refused),
    };
    return cmocka_run_group_tests(tests, files_set_up, files_tear_down);
}

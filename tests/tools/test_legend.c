/* test_legend.c: legends of pictures: colors of the bar, text that stays inside, small pictures */
#define _POSIX_C_SOURCE 200809L
#include "tests/lib/run_command.h"

#include "tools/draw/legend.h"

static const rgb white = {255, 255, 255};

static bool equal(rgb a, rgb b) {
    return a.r == b.r && a.g == b.g && a.b == b.b;
}

static size_t drawn(const picture *p, int first_column, int end) {
    size_t count = 0;
    for (int k = 0; k < p->width * p->height; k++) {
        count += k % p->width >= first_column && k % p->width < end && !equal(p->at[k], white);
    }
    return count;
}

/* The bar runs from the color of the lowest value, below, to that of the highest, and nothing is
 * drawn beside the legend. */
static void bars_show_the_color_map(void **state) {
    (void)state;
    const int sizes[3][2] = {{800, 600}, {320, 200}, {3200, 2400}};
    for (int k = 0; k < 3; k++) {
        picture p;
        int width = legend_width(sizes[k][0], sizes[k][1]), highest = -1, lowest = -1;
        assert_true(width > 0 && 4 * width < 3 * sizes[k][0]);
        assert_true(picture_create(&p, sizes[k][0], sizes[k][1], white));
        legend_draw(&p, 1, "a title beyond the width\nt = 1", -1.25e-10, 3.5e100, 0);
        int x = p.width - width + 1;
        assert_true(drawn(&p, 0, p.width - width) == 0 && drawn(&p, p.width - width, p.width) > 0);
        for (int y = 0; y < p.height; y++) {
            highest = highest < 0 && equal(p.at[y * p.width + x], color_map(1)) ? y : highest;
            lowest = equal(p.at[y * p.width + x], color_map(0)) ? y : lowest;
        }
        assert_true(highest > 0 && lowest > highest + p.height / 2 && lowest < p.height);
        picture_free(&p);
    }
    assert_true(legend_width(319, 600) == 0 && legend_width(800, 199) == 0);
}

static size_t of_color(const picture *p, rgb color) {
    size_t count = 0;
    for (int k = 0; k < p->width * p->height; k++) {
        count += equal(p->at[k], color);
    }
    return count;
}

/* Each key is a box of its color with its text, in the order of the keys, as long as there is room;
 * nothing is drawn beside the legend. */
static void keys_show_their_colors(void **state) {
    (void)state;
    legend_key keys[30];
    for (int k = 0; k < 30; k++) {
        keys[k].color = color_map(k / 29.0);
        (void)snprintf(keys[k].text, sizeof keys->text, "a key\n%d", k);
    }
    for (int scale = 1; scale <= 4; scale *= 2) {
        picture p, bare;
        const int left = scale * (400 - legend_width(400, 300));
        assert_true(picture_create(&p, 400 * scale, 300 * scale, white));
        assert_true(picture_create(&bare, 400 * scale, 300 * scale, white));
        legend_draw_keys(&bare, scale, "vertices\nheld", keys, 0);
        legend_draw_keys(&p, scale, "vertices\nheld", keys, 30);
        assert_true(drawn(&p, 0, left) == 0 && drawn(&bare, 0, left) == 0);
        assert_true(drawn(&bare, left, p.width) > 0);
        int shown = 0;
        while (shown < 30 && of_color(&p, keys[shown].color) > 0) {
            assert_int_equal(of_color(&p, keys[shown].color), 42 * scale * scale);
            shown++;
        }
        assert_true(shown == 10); /* of 25 rows each, below the title */
        for (int k = shown; k < 30; k++) {
            assert_int_equal(of_color(&p, keys[k].color), 0);
        }
        picture_free(&bare);
        picture_free(&p);
    }
}

/* All characters differ, unknown ones are blank, and text at the edges is clipped. */
static void text_is_drawn(void **state) {
    (void)state;
    const char *all = "0123456789abcdefghijklmnopqrstuvwxyz.-+=,()";
    picture p, q;
    assert_true(picture_create(&p, 6, 8, white) && picture_create(&q, 6, 8, white));
    for (const char *a = all; *a != '\0'; a++) {
        const char one[2] = {*a, '\0'};
        for (const char *b = all; b < a; b++) {
            const char other[2] = {*b, '\0'};
            memset(p.at, 255, 48 * sizeof *p.at);
            memset(q.at, 255, 48 * sizeof *q.at);
            legend_text(&p, 0, 0, 1, one);
            legend_text(&q, 0, 0, 1, other);
            assert_true(drawn(&p, 0, 6) > 0 && memcmp(p.at, q.at, 48 * sizeof *p.at) != 0);
        }
    }
    memset(p.at, 255, 48 * sizeof *p.at);
    legend_text(&p, 0, 0, 1, "\x01 \xff#");
    assert_true(drawn(&p, 0, 6) == 0);
    legend_text(&p, -3, -3, 2, "888888");
    legend_text(&p, 4, 5, 3, "W");
    picture_free(&q);
    picture_free(&p);
}

/* At twice and four times the scale, text, bar and ticks are where they were and as large. */
static void legends_keep_their_proportions(void **state) {
    (void)state;
    const int width = 700, height = 500; /* at no scale a multiple of 800 x 600 */
    picture one;
    assert_true(picture_create(&one, width, height, white));
    legend_draw(&one, 1, "heat\nt = 0.25", -3, 12, 9);
    for (int scale = 2; scale <= 4; scale += 2) {
        picture p;
        double difference = 0;
        assert_true(picture_create(&p, scale * width, scale * height, white));
        legend_draw(&p, scale, "heat\nt = 0.25", -3, 12, 9);
        assert_true(drawn(&p, 0, p.width - scale * legend_width(width, height)) == 0);
        picture_shrink(&p, scale);
        for (int k = 0; k < width * height; k++) {
            difference += abs(p.at[k].g - one.at[k].g);
        }
        assert_true(difference < 0.25 * 255 * (double)drawn(&one, 0, width));
        picture_free(&p);
    }
    picture_free(&one);
}

/* Pictures of numbers have the size that was asked for, times the scale. */
static void pictures_keep_their_size(void **state) {
    (void)state;
    char reach[700], deform[700];
    files_put_text("bend.txt", "grab 0\ngrab 9\nmove 1 1 0 0\nframe\n");
    (void)snprintf(deform, sizeof deform, "deform sphere:2 --script %s", files_path("bend.txt"));
    (void)snprintf(reach, sizeof reach, "reach sphere:2 --separators %s", files_path("b.png"));
    const char *const commands[] = {"adf sphere:2",
                                    "heat sphere:2 --from 3,4",
                                    "hks sphere:2 --times 2",
                                    "geodesic sphere:2",
                                    reach,
                                    deform};
    int (*const run[])(int, char **) = {command_adf,      command_heat,  command_hks,
                                        command_geodesic, command_reach, command_deform};
    for (int k = 0; k < 6; k++) {
        char words[1600];
        int width = 0, height = 0, status;
        size_t length;
        for (int scale = 1; scale <= 4; scale++) {
            (void)snprintf(words, sizeof words, "%s --size 640x360 --scale %d --png %s",
                           commands[k], scale, files_path("a.png"));
            free(run_command(run[k], words, &status));
            assert_int_equal(status, 0);
            char *text = files_get(files_path("a.png"), &length);
            assert_int_equal(sscanf(text, "%d %d", &width, &height), 2);
            assert_true(width == 640 * scale && height == 360 * scale);
            free(text);
        }
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(bars_show_the_color_map),
        cmocka_unit_test(keys_show_their_colors),
        cmocka_unit_test(text_is_drawn),
        cmocka_unit_test(legends_keep_their_proportions),
        cmocka_unit_test(pictures_keep_their_size),
    };
    return cmocka_run_group_tests(tests, files_set_up, files_tear_down);
}

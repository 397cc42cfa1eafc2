/* test_locale.c: Matrix Market files have the same numbers in every locale */
#include "tests/lib/check_factor.h"

#include <locale.h>

/* Decimal commas, and decimal points of two bytes; any that is not installed is left out. */
static const char *const locales[] = {
    "de_DE.UTF-8", "de_DE.utf8",  "de_DE",       "fr_FR.UTF-8", "fr_FR.utf8",  "fr_FR",
    "es_ES.UTF-8", "it_IT.UTF-8", "nl_NL.UTF-8", "pl_PL.UTF-8", "pt_BR.UTF-8", "ru_RU.UTF-8",
    "sv_SE.UTF-8", "cs_CZ.UTF-8", "da_DK.UTF-8", "fi_FI.UTF-8", "tr_TR.UTF-8", "ps_AF.UTF-8",
    "ps_AF.utf8",  "ps_AF",       "fa_IR.UTF-8", "fa_IR",       "de-DE",       "German_Germany"};

enum { LOCALES = sizeof locales / sizeof locales[0] };

/* Calls body in every installed locale whose decimal point is not a point; returns their number. */
static int in_each_locale(void (*body)(const char *point)) {
    int used = 0;
    for (int k = 0; k < LOCALES; k++) {
        if (setlocale(LC_ALL, locales[k]) != NULL) {
            char point[32];
            (void)snprintf(point, sizeof point, "%s", localeconv()->decimal_point);
            if (strcmp(point, ".") != 0) {
                used++;
                body(point);
            }
        }
    }
    assert_non_null(setlocale(LC_ALL, "C"));
    return used;
}

static void in_each_locale_or_skip(void (*body)(const char *point)) {
    if (in_each_locale(body) == 0) {
        TEST_SKIP("no locale with a decimal comma is installed");
    }
}

#define HEAD(count) "%%MatrixMarket matrix coordinate real general\n5 1 " count "\n"

static const char text[] =
    HEAD("5") "1 1 0.1\n2 1 -2.5e-300\n3 1 +.75\n4 1 7\n5 1 1.7976931348623157e308\n";

static sl_status parse(sl_matrix **M, const char *what, sl_stats *stats) {
    return sl_matrix_parse(M, what, strlen(what), NULL, stats);
}

static void reads_points(const char *point) {
    const double values[5] = {1.0 / 10, -2.5e-300, 0.75, 7, DBL_MAX};
    sl_matrix *M = NULL;
    (void)point;
    SL_CHECK(parse(&M, text, NULL));
    SAME_VALUES(sl_matrix_view(M).x, values, 5);
    sl_matrix_free(M);
}

static void points_are_read(void **state) {
    (void)state;
    reads_points(".");
    in_each_locale_or_skip(reads_points);
}

/* What only the locale takes for a number is refused, as in the C locale. */
static void refuses(const char *point) {
    static const char *const numbers[] = {"2%s5", "%s5", "2%s", "1.2%s5", "2%s5e3", "1%s000.5"};
    for (size_t k = 0; k < sizeof numbers / sizeof numbers[0]; k++) {
        char number[64], line[256];
        sl_matrix *M = NULL;
        sl_stats stats;
        (void)snprintf(number, sizeof number, numbers[k], point);
        (void)snprintf(line, sizeof line, "%s1 1 1.5\n2 1 %s\n", HEAD("2"), number);
        SL_EXPECT(SL_ERR_IO, parse(&M, line, &stats));
        assert_null(M);
        assert_int_equal(stats.error.line, 4);
    }
}

static void points_of_the_locale_are_refused(void **state) {
    (void)state;
    refuses(",");
    refuses("\xd9\xab");
    in_each_locale_or_skip(refuses);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(points_are_read),
        cmocka_unit_test(points_of_the_locale_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

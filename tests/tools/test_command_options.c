/* test_command_options.c: parsing the options and operands of a command, refusing bad ones */
#define _POSIX_C_SOURCE 200809L
#include "tests/lib/test.h"

#include "tools/cli/app.h"
#include "tools/cli/options.h"

typedef struct read_t {
    bool flag;
    sl_int count;
    double real, above, optional;
    const char *text, *operands[2];
    char message[200];
} read_t;

static options_result parse(read_t *r, int argc, ...) {
    static char words[12][64];
    char *argv[14] = {NULL};
    const options_usage usage = {"cmd", "ONE [TWO]", 1, 2, "text"};
    memset(r, 0, sizeof *r);
    r->optional = -1;
    const option table[] = {{OPTION_FLAG, "flag", &r->flag, NULL, ""},
                            {OPTION_COUNT, "count", &r->count, "K", ""},
                            {OPTION_REAL, "real", &r->real, "X", ""},
                            {OPTION_ABOVE_0, "above", &r->above, "Y", ""},
                            {OPTION_OPTIONAL, "optional", &r->optional, "Z", ""},
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
    /* A lone dash is an operand. */
    assert_true(parse(&r, 1, "-") == OPTIONS_READ);
    assert_true(parse(&r, 3, "--nonsense", "-h", "x") == OPTIONS_HELP);
    assert_true(parse(&r, 2, "a", "--above=1e-300") == OPTIONS_READ && r.above == 1e-300);
    assert_true(parse(&r, 1, "a") == OPTIONS_READ && r.optional == -1);
    assert_true(parse(&r, 2, "--optional", "a") == OPTIONS_READ && r.optional == 0);
    assert_string_equal(r.operands[0], "a");
    assert_true(parse(&r, 2, "--optional=1e-6", "a") == OPTIONS_READ && r.optional == 1e-6);
    assert_true(parse(&r, 2, "a", "--text=") == OPTIONS_READ && r.text[0] == '\0');
}

static void bad_options_are_refused(void **state) {
    (void)state;
    static const char *const bad[][2] = {{"--cou", "unknown option --cou"},
                                         {"-f", "unknown option -f"},
                                         {"--flag=1", "--flag takes no argument"},
                                         {"--count=-1", "not an integer"},
                                         {"--count=1.5", "not an integer"},
                                         {"--count=2147483648", "not an integer"},
                                         {"--count=99999999999999999999", "not an integer"},
                                         {"--count=", "not an integer"},
                                         {"--real=1e999", "not a finite number"},
                                         {"--real=nan", "not a finite number"},
                                         {"--real=1x", "not a finite number"},
                                         {"--above=0", "not a finite number above 0"},
                                         {"--above=-1", "not a finite number above 0"},
                                         {"--above=inf", "not a finite number above 0"},
                                         {"--optional=", "not a finite number of 0 or more"},
                                         {"--optional=-1e-9", "not a finite number of 0 or more"},
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
                strstr(r.message, "unexpected operand c"));
    assert_true(parse(&r, 1, "--flag") == OPTIONS_BAD && strstr(r.message, "needs ONE"));
}

/* Reasons end before the advice to a C program, and keep what comes before it. */
static void errors_name_nothing_of_the_header(void **state) {
    (void)state;
    static const char *const whats[] = {
        NULL,
        "the rows sum to 0: x is unique up to a constant. Set options.pivots = SL_PIVOTS_SKIP_NULL",
        "the free rows are singular: fix a row, or see sl_symbolic_create_pivoted"};
    for (int k = 0; k < 3; k++) {
        for (int status = SL_OK + 1; status <= SL_ERR_READ_ONLY; status++) {
            sl_stats stats;
            memset(&stats, 0, sizeof stats);
            stats.error.row = 17;
            stats.error.what = whats[k];
            const char *text = app_error_text((sl_status)status, k == 0 ? NULL : &stats);
            assert_true(strlen(text) > 5);
            assert_true(strstr(text, "sl_") == NULL && strstr(text, "SL_") == NULL);
            assert_true(strstr(text, "options.") == NULL);
            if (k > 0 && status == SL_ERR_PIVOT) {
                assert_non_null(strstr(text, k == 1 ? "unique up to a constant" : "fix a row"));
                assert_non_null(strstr(text, " (vertex 17)"));
            }
        }
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(options_are_read),
        cmocka_unit_test(bad_options_are_refused),
        cmocka_unit_test(errors_name_nothing_of_the_header),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

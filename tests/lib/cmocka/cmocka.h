/* cmocka.h: the part of cmocka that the tests use, for systems that have no cmocka */
#ifndef SL_CMOCKA_H
#define SL_CMOCKA_H

/* Found before the real <cmocka.h> only where a target adds this folder to the include path: under
 * the memory sanitizer, which must see all code compiled with it, and for Windows and WebAssembly.
 * The lines that it prints are those of cmocka that tests/lib/run.sh reads.
 *
 * A test that fails or is skipped is left by longjmp. WASI has none: tests/lib/wasi/run.mjs starts
 * a new instance of the program for each test, with the number of the test in SL_ONE_TEST, and the
 * instance ends. */

#include <inttypes.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#if !defined(__wasi__)
#include <setjmp.h>
#endif

struct CMUnitTest {
    const char *name;
    void (*run)(void **state);
};

#define cmocka_unit_test(function) {#function, function}

enum { CMOCKA_PASSED, CMOCKA_FAILED, CMOCKA_SKIPPED };

#if defined(__wasi__)
static inline _Noreturn void cmocka_leave(int result) {
    printf("[  %s ] 1 test(s).\n", result == CMOCKA_FAILED ? "FAILED " : "SKIPPED");
    exit(result == CMOCKA_FAILED);
}
#else
/* Where the running test returns to, with its result; NULL outside of tests. */
static jmp_buf *cmocka_return = NULL;
static int cmocka_result = CMOCKA_PASSED;

static inline void cmocka_leave(int result) {
    if (cmocka_return == NULL) {
        exit(1);
    }
    cmocka_result = result;
    longjmp(*cmocka_return, 1);
}
#endif

#if defined(__GNUC__)
__attribute__((format(printf, 1, 2)))
#endif
static inline void print_message(const char *format, ...) {
    va_list list;
    va_start(list, format);
    vprintf(format, list);
    va_end(list);
    fflush(stdout);
}

#define print_error print_message

static inline void _fail(const char *file, int line) {
    print_error("[  ERROR   ] --- %s:%d: error: failure\n", file, line);
    cmocka_leave(CMOCKA_FAILED);
}

/* Fails unless a comparison holds: prints what was compared. */
static inline void cmocka_check(int holds, const char *what, const char *file, int line) {
    if (!holds) {
        print_error("[  ERROR   ] --- %s\n", what);
        _fail(file, line);
    }
}

static inline void cmocka_compare(uintmax_t a, uintmax_t b, int equal, const char *what,
                                  const char *file, int line) {
    if ((a == b) != equal) {
        print_error("[  ERROR   ] --- %" PRIdMAX " and %" PRIdMAX "\n", (intmax_t)a, (intmax_t)b);
    }
    cmocka_check((a == b) == equal, what, file, line);
}

#define fail() _fail(__FILE__, __LINE__)
/* ... format, and its arguments */
#define fail_msg(...) (print_error(__VA_ARGS__), print_error("\n"), fail())
#define skip() cmocka_leave(CMOCKA_SKIPPED)
#define assert_true(a) cmocka_check(!!(a), #a, __FILE__, __LINE__)
#define assert_false(a) cmocka_check(!(a), "not " #a, __FILE__, __LINE__)
#define assert_null(a) cmocka_check((a) == NULL, #a " is NULL", __FILE__, __LINE__)
#define assert_non_null(a) cmocka_check((a) != NULL, #a " is not NULL", __FILE__, __LINE__)
#define assert_ptr_equal(a, b) \
    cmocka_check((const void *)(a) == (const void *)(b), #a " is " #b, __FILE__, __LINE__)
#define assert_int_equal(a, b) \
    cmocka_compare((uintmax_t)(a), (uintmax_t)(b), 1, #a " == " #b, __FILE__, __LINE__)
#define assert_int_not_equal(a, b) \
    cmocka_compare((uintmax_t)(a), (uintmax_t)(b), 0, #a " != " #b, __FILE__, __LINE__)
#define assert_string_equal(a, b) \
    cmocka_check(strcmp((a), (b)) == 0, #a " is the text of " #b, __FILE__, __LINE__)
#define assert_string_not_equal(a, b) \
    cmocka_check(strcmp((a), (b)) != 0, #a " is not the text of " #b, __FILE__, __LINE__)
#define assert_memory_equal(a, b, size) \
    cmocka_check(memcmp((a), (b), (size)) == 0, #a " has the bytes of " #b, __FILE__, __LINE__)
#define assert_memory_not_equal(a, b, size) \
    cmocka_check(memcmp((a), (b), (size)) != 0, #a " has not the bytes of " #b, __FILE__, __LINE__)

static inline void cmocka_in_range(uintmax_t a, uintmax_t low, uintmax_t high, const char *what,
                                   const char *file, int line) {
    cmocka_check(a >= low && a <= high, what, file, line);
}

#define assert_in_range(a, low, high) \
    cmocka_in_range((uintmax_t)(a), (uintmax_t)(low), (uintmax_t)(high), \
                    #a " is in " #low " .. " #high, __FILE__, __LINE__)

/* Runs one test; returns its result. */
static inline int cmocka_run(const struct CMUnitTest *test, void **state) {
#if defined(__wasi__)
    test->run(state);
    return CMOCKA_PASSED;
#else
    jmp_buf here;
    cmocka_return = &here;
    cmocka_result = CMOCKA_PASSED;
    if (setjmp(here) == 0) {
        test->run(state);
    }
    cmocka_return = NULL;
    return cmocka_result;
#endif
}

/* Returns the number of failed tests. */
static inline int cmocka_run_all(const struct CMUnitTest *tests, int count,
                                 int (*set_up)(void **state), int (*tear_down)(void **state)) {
    static const char *const words[] = {"      OK", " FAILED ", "SKIPPED "};
    const char *only = getenv("SL_ONE_TEST"); /* -1: only their number is wanted */
    void *state = NULL;
    int results[3] = {0, 0, 0}, k;
    printf("[==========] Running %d test(s).\n", count);
    if (only != NULL && atoi(only) < 0) {
        return count;
    }
    if (set_up != NULL && set_up(&state) != 0) {
        printf("the set-up failed\n");
        return count;
    }
    for (k = 0; k < count; k++) {
        if (only == NULL || atoi(only) == k) {
            int result;
            print_message("[ RUN      ] %s\n", tests[k].name);
            result = cmocka_run(&tests[k], &state);
            results[result]++;
            print_message("[ %s ] %s\n", words[result], tests[k].name);
        }
    }
    if (tear_down != NULL && tear_down(&state) != 0) {
        printf("the tear-down failed\n");
        results[CMOCKA_FAILED]++;
    }
    printf("[  PASSED  ] %d test(s).\n[  SKIPPED ] %d test(s).\n[  FAILED  ] %d test(s).\n",
           results[CMOCKA_PASSED], results[CMOCKA_SKIPPED], results[CMOCKA_FAILED]);
    fflush(stdout);
    return results[CMOCKA_FAILED];
}

#define cmocka_run_group_tests(tests, set_up, tear_down) \
    cmocka_run_all((tests), (int)(sizeof(tests) / sizeof *(tests)), (set_up), (tear_down))

#endif

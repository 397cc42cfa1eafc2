/* test_options.c: options that are malformed: sizes, reserved fields, allocators, enum values */
#include "tests/lib/option_calls.h"

static void assert_refused_by_every_call(option_fixture_t *f, const sl_options *opt) {
    for (int k = 0; k < OPTION_CALLS; k++) {
        assert_option_call(f, k, opt, SL_ERR_ARGUMENT);
    }
}

static void assert_accepted_by_every_call(option_fixture_t *f, const sl_options *opt) {
    for (int k = 0; k < OPTION_CALLS; k++) {
        assert_option_call(f, k, opt, SL_OK);
    }
}

static void default_options_are_accepted_by_every_call(void **state) {
    (void)state;
    option_fixture_t *f = option_fixture_make();
    sl_options opt = options_none();
    assert_accepted_by_every_call(f, NULL);
    assert_accepted_by_every_call(f, &opt);
    sl_options_init(&opt, sizeof opt);
    assert_int_equal(opt.size, sizeof opt);
    assert_accepted_by_every_call(f, &opt);
    option_fixture_free(f);
}

static void another_size_is_refused_by_every_call(void **state) {
    (void)state;
    option_fixture_t *f = option_fixture_make();
    const size_t sizes[5] = {1, sizeof(sl_options) - 1, sizeof(sl_options) + 1,
                             sizeof(sl_options) + sizeof(void *), SIZE_MAX};
    for (int k = 0; k < 5; k++) {
        sl_options opt = options_none();
        opt.size = sizes[k];
        assert_refused_by_every_call(f, &opt);
    }
    option_fixture_free(f);
}

static void a_reserved_field_is_refused_by_every_call(void **state) {
    (void)state;
    option_fixture_t *f = option_fixture_make();
    for (size_t k = 0; k < sizeof((sl_options *)0)->reserved / sizeof(sl_off); k++) {
        sl_options opt;
        sl_options_init(&opt, sizeof opt);
        opt.reserved[k] = k % 2 == 0 ? 1 : -1;
        assert_refused_by_every_call(f, &opt);
    }
    option_fixture_free(f);
}

static void a_negative_number_of_threads_is_refused_by_every_call(void **state) {
    (void)state;
    option_fixture_t *f = option_fixture_make();
    sl_options opt = options_none();
    opt.threads.count = -1;
    assert_refused_by_every_call(f, &opt);
    option_fixture_free(f);
}

/* Threads without a pool, in a build that has none of its own. */
static void threads_that_are_not_compiled_in_are_refused_by_every_call(void **state) {
    (void)state;
    option_fixture_t *f = option_fixture_make();
    sl_options opt = options_none();
    char text[200];
    opt.threads.count = 2;
    for (int call = 0; call < OPTION_CALLS; call++) {
        const sl_status status = option_calls[call].call(f, &opt);
        if (WITHOUT_POOL == SL_OK) {
            SL_CHECK(status);
            continue;
        }
        sl_error_text(text, sizeof text, WITHOUT_POOL, NULL);
        if (strstr(text, "SL_PTHREADS or OpenMP") == NULL) {
            fail_msg("%s: %s", option_calls[call].name, text);
        }
    }
    option_fixture_free(f);
}

static void half_an_allocator_is_refused_by_every_call(void **state) {
    (void)state;
    option_fixture_t *f = option_fixture_make();
    counter_t counter = counter_make();
    sl_options opt = options_counted(&counter);
    opt.allocator.allocate = NULL;
    assert_refused_by_every_call(f, &opt);
    opt = options_counted(&counter);
    opt.allocator.release = NULL;
    assert_refused_by_every_call(f, &opt);
    assert_int_equal(counter.calls, 0);
    option_fixture_free(f);
}

/* A binding that was compiled for another sl_options: init clears exactly its bytes. */
static void init_clears_the_size_that_the_caller_has(void **state) {
    (void)state;
    const size_t sizes[4] = {sizeof(size_t), sizeof(sl_options) - 16, sizeof(sl_options),
                             sizeof(sl_options) + 64};
    union {
        sl_options opt;
        unsigned char bytes[sizeof(sl_options) + 128];
    } u;
    for (int k = 0; k < 4; k++) {
        memset(u.bytes, 0xA5, sizeof u.bytes);
        sl_options_init(&u.opt, sizes[k]);
        assert_int_equal(u.opt.size, sizes[k]);
        for (size_t q = sizeof(size_t); q < sizeof u.bytes; q++) {
            assert_int_equal(u.bytes[q], q < sizes[k] ? 0 : 0xA5);
        }
    }
    memset(u.bytes, 0xA5, sizeof u.bytes);
    sl_options_init(&u.opt, sizeof(size_t) - 1);
    for (size_t q = 0; q < sizeof u.bytes; q++) {
        assert_int_equal(u.bytes[q], 0xA5);
    }
    sl_options_init(NULL, sizeof(sl_options));
}

static void the_library_reports_its_version_and_sizes(void **state) {
    (void)state;
    assert_int_equal(sl_version(), SL_VERSION);
    assert_int_equal(sl_version(),
                     10000 * SL_VERSION_MAJOR + 100 * SL_VERSION_MINOR + SL_VERSION_PATCH);
    assert_int_equal(sl_stats_size(), sizeof(sl_stats));
}

/* The k-th value that is none of an enum whose last value is `last`. */
static int unknown(int k, int last) {
    return k == 0 ? -1 : k == 1 ? last + 1 : 1000;
}

static void unknown_enum_values_are_refused(void **state) {
    (void)state;
    option_fixture_t *f = option_fixture_make();
    double X[25] = {1}, Y[25] = {7};
    assert_int_equal(f->pair.n, 25);
    for (int k = 0; k < 4; k++) {
        const sl_reading reading = (sl_reading)unknown(k, SL_AS_STORED);
        sl_options opt = options_none();
        opt.perm = f->perm;
        opt.ordering = (sl_ordering)(k == 3 ? 2 : unknown(k, ORDERING_LAST));
        SL_EXPECT(SL_ERR_ARGUMENT, option_symbolic(f, &opt));
        opt = options_none();
        opt.purpose = (sl_purpose)unknown(k, SL_PURPOSE_ONE_FACTOR);
        SL_EXPECT(SL_ERR_ARGUMENT, option_symbolic(f, &opt));
        opt = options_none();
        opt.relaxation = (sl_relaxation)unknown(k, SL_RELAXATION_NONE);
        SL_EXPECT(SL_ERR_ARGUMENT, option_symbolic(f, &opt));
        opt = options_none();
        opt.triangle = (sl_triangle)unknown(k, SL_TRIANGLE_BOTH);
        SL_EXPECT(SL_ERR_ARGUMENT, option_symbolic(f, &opt));
        SL_EXPECT(SL_ERR_ARGUMENT, option_triangle(f, &opt));
        SL_EXPECT(SL_ERR_ARGUMENT, option_sum(f, &opt));
        opt = options_none();
        opt.method = (sl_method)unknown(k, SL_METHOD_SUPERNODAL);
        SL_EXPECT(SL_ERR_ARGUMENT, option_factor(f, &opt));
        SL_EXPECT(SL_ERR_ARGUMENT, option_batch_factor(f, &opt));
        opt = options_none();
        opt.storage = (sl_storage)unknown(k, STORAGE_LAST);
        SL_EXPECT(SL_ERR_ARGUMENT, option_factor(f, &opt));
        SL_EXPECT(SL_ERR_ARGUMENT, option_batch_factor(f, &opt));
        opt = options_none();
        opt.pivots = (sl_pivots)unknown(k, SL_PIVOTS_SKIP_NULL);
        SL_EXPECT(SL_ERR_ARGUMENT, option_factor(f, &opt));
        SL_EXPECT(SL_ERR_ARGUMENT, option_batch_factor(f, &opt));
        opt = options_none();
        opt.isa = (sl_isa)unknown(k, ISAS_ASKED); /* like one that this processor does not have */
        SL_EXPECT(SL_ERR_UNSUPPORTED, option_factor(f, &opt));
        SL_EXPECT(SL_ERR_UNSUPPORTED, option_batch_factor(f, &opt));
        SL_EXPECT(SL_ERR_ARGUMENT, sl_csc_multiply(&f->U, reading, Y, 25, X, 25, 1));
        assert_true(Y[0] == 7);
    }
    option_fixture_free(f);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(default_options_are_accepted_by_every_call),
        cmocka_unit_test(another_size_is_refused_by_every_call),
        cmocka_unit_test(a_reserved_field_is_refused_by_every_call),
        cmocka_unit_test(a_negative_number_of_threads_is_refused_by_every_call),
        cmocka_unit_test(threads_that_are_not_compiled_in_are_refused_by_every_call),
        cmocka_unit_test(half_an_allocator_is_refused_by_every_call),
        cmocka_unit_test(init_clears_the_size_that_the_caller_has),
        cmocka_unit_test(the_library_reports_its_version_and_sizes),
        cmocka_unit_test(unknown_enum_values_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

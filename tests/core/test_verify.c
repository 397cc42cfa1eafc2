/* test_verify.c: under SL_VERIFY a call refuses an option that is set and that it does not read */
#if !defined(SL_VERIFY)
#define SL_VERIFY
#endif
#include "tests/lib/no_kernels.h"
#define SPARSE_LOCAL_IMPLEMENTATION
#include "tests/lib/option_calls.h"
#include "tests/lib/parallel_for.h"

typedef struct option_t {
    const char *name;
    int group;
} option_t;

static const option_t options[] = {
    {"ordering", READS_ANALYSIS},
    {"relaxation", READS_ANALYSIS},
    {"perm", READS_ANALYSIS},
    {"block_size", READS_ANALYSIS},
    {"purpose", READS_ANALYSIS},
    {"triangle", READS_TRIANGLE},
    {"isa", READS_ISA},
    {"method", READS_FACTOR},
    {"pivots", READS_FACTOR},
    {"null_tolerance", READS_FACTOR},
    {"mass", READS_FACTOR},
    {"consistency_tolerance", READS_FACTOR},
    {"regularization", READS_FACTOR},
    {"signs", READS_FACTOR},
    {"growth_limit", READS_FACTOR},
    {"error_limit", READS_FACTOR},
    {"null_vector", READS_FACTOR},
    {"null_vector_count", READS_FACTOR},
    {"storage", READS_FACTOR},
    {"region", READS_REGION},
    {"region_bytes", READS_REGION_BYTES},
};

enum { OPTIONS = sizeof options / sizeof options[0], N = 25 };

/* Sets option k to a value that is valid where it is read. */
static sl_options with_option(const option_fixture_t *f, int k) {
    static double mass[N];
    static sl_int signs[N];
    sl_options opt = options_none();
    for (int q = 0; q < N; q++) {
        mass[q] = 1;
        signs[q] = 1;
    }
    switch (k) {
    case 0:
        opt.ordering = SL_ORDERING_NATURAL;
        break;
    case 1:
        opt.relaxation = SL_RELAXATION_NONE;
        break;
    case 2:
        opt.perm = f->perm;
        break;
    case 3:
        opt.block_size = 5;
        break;
    case 4:
        opt.purpose = SL_PURPOSE_ONE_FACTOR;
        break;
    case 5:
        opt.triangle = SL_TRIANGLE_LOWER;
        break;
    case 6:
        opt.isa = SL_ISA_SCALAR;
        break;
    case 7:
        opt.method = SL_METHOD_SUPERNODAL;
        break;
    case 8:
        opt.pivots = SL_PIVOTS_SKIP_NULL;
        break;
    case 9:
        opt.null_tolerance = 1e-12;
        break;
    case 10:
        opt.mass = mass;
        break;
    case 11:
        opt.consistency_tolerance = 1e-5;
        break;
    case 12:
        opt.regularization = 1e-8;
        break;
    case 13:
        opt.signs = signs;
        break;
    case 14:
        opt.growth_limit = 1e12;
        break;
    case 15:
        opt.error_limit = 1e-6;
        break;
    case 16:
        opt.null_vector = mass;
        break;
    case 17:
        opt.null_vector_count = 1;
        break;
    case 18:
        opt.storage = SL_STORAGE_FLOAT;
        break;
    case 19:
        opt.region = f->region;
        break;
    default:
        opt.region_bytes = (size_t)1 << 20;
        break;
    }
    return opt;
}

static void an_option_that_is_not_read_is_refused(void **state) {
    (void)state;
    option_fixture_t *f = option_fixture_make();
    assert_int_equal(f->pair.n, N);
    for (int k = 0; k < OPTIONS; k++) {
        const sl_options opt = with_option(f, k);
        for (int call = 0; call < OPTION_CALLS; call++) {
            const int is_read = (options[k].group & option_calls[call].reads) != 0;
            const sl_status status = option_calls[call].call(f, &opt);
            if (status != (is_read ? SL_OK : SL_ERR_ARGUMENT)) {
                print_error("%s with options.%s: %s\n", option_calls[call].name, options[k].name,
                            sl_status_string(status));
                fail();
            }
        }
    }
    option_fixture_free(f);
}

static void options_that_every_call_reads_are_accepted(void **state) {
    (void)state;
    option_fixture_t *f = option_fixture_make();
    counter_t counter = counter_make();
    sl_options opt;
    int runs = 0;
    sl_options_init(&opt, sizeof opt);
    opt.allocator = options_counted(&counter).allocator;
    opt.threads.count = 2;
    opt.threads.run = run_backwards;
    opt.threads.context = &runs;
    for (int call = 0; call < OPTION_CALLS; call++) {
        assert_option_call(f, call, &opt, SL_OK);
    }
    option_fixture_free(f);
    COUNTER_CLEAN(&counter);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(an_option_that_is_not_read_is_refused),
        cmocka_unit_test(options_that_every_call_reads_are_accepted),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

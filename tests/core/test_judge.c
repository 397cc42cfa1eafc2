/* test_judge.c: random systems of 45 families, each with a random way to an answer: no answer with
 * SL_OK and a backward error above 1e-8 comes without a signal. `make judge` runs more of them */
#include "tests/lib/judge_constraints.h"
#include "tests/lib/judge_bounds.h"
#include "tests/lib/judge_ways.h"

typedef struct way_t {
    const char *name;
    void (*run)(judge_t *t);
} way_t;

static const way_t ways[] = {{"solve", judge_way_solve},        {"refine", judge_way_refine},
                             {"local", judge_way_local},        {"change", judge_way_change},
                             {"restrict", judge_way_submatrix}, {"edit", judge_way_edit},
                             {"pins", judge_way_constraints},   {"inverse", judge_way_inverse},
                             {"bounds", judge_way_bounds}};

enum { WAYS = sizeof ways / sizeof *ways };

static unsigned long long number(const char *name, unsigned long long otherwise) {
    const char *text = getenv(name);
    return text != NULL ? strtoull(text, NULL, 10) : otherwise;
}

/* The options of a system, with any method, kernels and storage. */
static void choose_options(judge_t *t, const variant_list_t *variants) {
    const judge_system_t *y = t->y;
    sl_options *opt = &t->opt;
    options_set_variant(opt, variants, (int)gen_below(&t->state, variants->count));
    opt->pivots = y->skips ? SL_PIVOTS_SKIP_NULL : SL_PIVOTS_NONZERO;
    opt->mass = y->mass;
    opt->null_vector = y->Z;
    opt->null_vector_count = y->vectors;
    opt->regularization = y->regularization;
    opt->signs = y->signs;
    if (gen_below(&t->state, 4) == 0) {
        opt->storage = SL_STORAGE_FLOAT;
        opt->method = SL_METHOD_AUTO;
    }
    if (y->is_complex && gen_below(&t->state, 2)) {
        opt->storage = SL_STORAGE_COMPLEX;
        opt->method = SL_METHOD_AUTO;
    }
}

static void judge_one(uint64_t seed, int family, const variant_list_t *variants,
                      judge_tally_t *tally) {
    judge_system_t y = judge_system(family, seed);
    sl_options blocks = options_none();
    judge_t t;
    memset(&t, 0, sizeof t);
    t.y = &y;
    t.n = (size_t)y.n;
    t.family = family;
    t.seed = seed;
    t.tally = tally;
    t.state = seed * 77 + (uint64_t)family;
    t.way = (int)number("JUDGE_WAY", (unsigned long long)gen_below(&t.state, WAYS));
    choose_options(&t, variants);
    const int is_pivoted = !y.skips && !y.is_complex && gen_below(&t.state, 4) == 0;
    blocks.block_size = y.is_complex ? 2 : 0;
    SL_CHECK(is_pivoted ? sl_symbolic_create_pivoted(&t.S, &y.M.view, NULL, NULL)
                        : sl_symbolic_create(&t.S, &y.M.view, &blocks, NULL));
    const sl_status status = sl_factor_create(&t.F, t.S, &y.M.view, &t.opt, &t.stats);
    if (judge_succeeded(&t, status, "create")) {
        ways[t.way].run(&t);
    }
    sl_factor_free(t.F);
    sl_symbolic_free(t.S);
    judge_system_free(&y);
}

static void no_wrong_answer_comes_without_a_signal(void **state) {
    (void)state;
    const variant_list_t variants = variants_present();
    const unsigned long long count = number("JUDGE_COUNT", 3000), first = number("JUDGE_SEED", 1);
    judge_tally_t tally;
    sl_off silent = 0;
    memset(&tally, 0, sizeof tally);
    for (unsigned long long k = 0; k < count; k++) {
        const unsigned long long seed = first + k;
        judge_one(seed, (int)(seed % JUDGE_FAMILIES), &variants, &tally);
    }
    print_message("%-10s %9s %9s %9s %9s %9s %7s  worst\n", "way", "good", "refused", "unsupp.",
                  "flagged", "not fin.", "silent");
    for (int w = 0; w < WAYS; w++) {
        const sl_off *v = tally.verdicts[w];
        print_message("%-10s %9ld %9ld %9ld %9ld %9ld %7ld  %.2g\n", ways[w].name,
                      (long)v[JUDGE_GOOD], (long)v[JUDGE_REFUSED], (long)v[JUDGE_UNSUPPORTED],
                      (long)v[JUDGE_FLAGGED], (long)v[JUDGE_NOT_FINITE], (long)v[JUDGE_SILENT],
                      tally.worst[w]);
        silent += v[JUDGE_SILENT];
    }
    print_message("%ld errors were compared with their bounds\n", (long)tally.bounds);
    print_message("growth     entries  sweeps beside solves\n");
    for (int k = 0; k < JUDGE_DECADES; k++) {
        print_message("1e%-2d       %7.1g  %7.1g\n", k, tally.entries[k], tally.sweeps[k]);
    }
    assert_int_equal(silent, 0);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(no_wrong_answer_comes_without_a_signal),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

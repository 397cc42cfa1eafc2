/* test_save.c: saved factors, loaded and mapped, answer with the bits of the original */
#include "tests/lib/saved.h"

static void assert_same_factor_stats(const sl_factor *F, const sl_factor *G) {
    sl_stats a, b;
    memset(&a, 0, sizeof a);
    memset(&b, 0, sizeof b);
    a.factor = sl_factor_view(F).info;
    b.factor = sl_factor_view(G).info;
    assert_true(b.factor.bytes > 0);
    a.factor.seconds = a.factor.seconds_setup = 0;
    b.factor.seconds = b.factor.seconds_setup = 0;
    a.factor.bytes = b.factor.bytes;
    assert_memory_equal(&a.factor, &b.factor, sizeof a.factor);
}

/* Saves, loads with `call`, and compares everything. */
static void round_trip(const saved_case_t *c, saved_call_t call, unsigned checks, const saved_t *m,
                       const sl_options *opt) {
    sl_symbolic *S = NULL;
    sl_factor *F = NULL;
    SL_CHECK(call(&S, &F, m->bytes, m->size, checks, opt));
    assert_non_null(F);
    assert_ptr_equal(sl_factor_view(F).symbolic, S);
    assert_same_analysis(c->y.S, S);
    assert_same_factor_stats(c->y.F, F);
    assert_same_answers(c->y.F, F);
    saved_t again = saved_make(S, F);
    assert_int_equal(again.size, m->size);
    assert_memory_equal(again.bytes, m->bytes, m->size);
    saved_free(&again);
    sl_status status = sl_factor_refactor(F, &c->y.M.view, NULL);
    if (call == pair_map_memory) {
        assert_int_equal(status, SL_ERR_READ_ONLY);
    } else {
        assert_int_equal(status, SL_OK);
        again = saved_make(S, F);
        assert_memory_equal(again.bytes, m->bytes, m->size);
        saved_free(&again);
    }
    assert_same_answers(c->y.F, F);
    sl_factor_free(F);
    sl_symbolic_free(S);
}

static void way_for_all_matrices(int way, const sl_options *from) {
    for (gen_kind_t kind = GEN_NONE; kind < GEN_REGULAR; kind = (gen_kind_t)(kind + 1)) {
        saved_case_t c = saved_case_make(way, kind, 70, (int)kind % 3, from);
        sl_options opt = options_none();
        opt.isa = from->isa;
        saved_t m = saved_make(c.y.S, c.y.F), again = saved_make(c.y.S, c.y.F);
        assert_memory_equal(m.bytes, again.bytes, m.size);
        for (int checks = SL_LOAD_CHECKED; checks <= SL_LOAD_VERIFIED; checks++) {
            round_trip(&c, pair_load_memory, (unsigned)checks, &m, &opt);
            round_trip(&c, pair_map_memory, (unsigned)checks, &m, &opt);
        }
        assert_memory_equal(m.bytes, again.bytes, m.size); /* nobody wrote to it */
        saved_free(&m);
        saved_free(&again);
        saved_case_free(&c);
    }
}

static void every_variant_answers_with_the_same_bits(void **state) {
    (void)state;
    variant_list_t variants = variants_present();
    for (int k = 0; k < variants.count; k++) {
        for (int way = 0; way < SAVED_WAYS; way++) {
            sl_options from = options_none();
            options_set_variant(&from, &variants, k);
            way_for_all_matrices(way, &from);
        }
    }
}

static void every_ordering_and_relaxation_is_kept(void **state) {
    (void)state;
    for (int ordering = SL_ORDERING_ND; ordering <= SL_ORDERING_NATURAL; ordering++) {
        for (int relaxation = 0; relaxation < 2; relaxation++) {
            sl_options from = options_none();
            from.ordering = (sl_ordering)ordering;
            from.relaxation = (sl_relaxation)relaxation;
            if (ordering_is_present(from.ordering) && ordering != SL_ORDERING_GIVEN) {
                way_for_all_matrices(SAVED_DEFINITE, &from);
                way_for_all_matrices(SAVED_WEIGHTED, &from);
            }
        }
    }
}

/* The bytes of these cases have 2x2 pivots, null vectors and regularized pivots at all. */
static void every_way_has_what_it_stands_for(void **state) {
    (void)state;
    for (int way = 0; way < SAVED_WAYS; way++) {
        saved_case_t c = saved_case_make(way, GEN_GRID2, 144, 0, NULL);
        sl_stats stats;
        stats.symbolic = sl_symbolic_view(c.y.S).info;
        stats.factor = sl_factor_view(c.y.F).info;
        const int is_pivoted = way == SAVED_PIVOTED || way == SAVED_PIVOTED_REGULARIZED;
        const int skips = way == SAVED_SKIPPED || way == SAVED_WEIGHTED || way == SAVED_VECTORS;
        assert_true((stats.symbolic.pairs > 10) == is_pivoted);
        assert_true(stats.factor.negative > 10 || !is_pivoted);
        assert_true((stats.factor.null > 0) == skips);
        assert_true(stats.factor.growth >= 1.0 && stats.factor.entry_max > 0.0);
        saved_case_free(&c);
    }
}

/* The same matrix gives the same bytes in another process, too: neither times nor addresses. */
static void the_same_matrix_gives_the_same_bytes(void **state) {
    (void)state;
    for (int way = 0; way < SAVED_WAYS; way++) {
        counter_t counter = counter_make(); /* other addresses, other garbage in new blocks */
        sl_options counted = options_counted(&counter);
        saved_case_t a = saved_case_make(way, GEN_COMPONENTS, 200, 0, NULL);
        saved_case_t b = saved_case_make(way, GEN_COMPONENTS, 200, 0, &counted);
        saved_t m = saved_make(a.y.S, a.y.F), k = saved_make(b.y.S, b.y.F);
        assert_int_equal(m.size, k.size);
        assert_memory_equal(m.bytes, k.bytes, m.size);
        saved_free(&m);
        saved_free(&k);
        saved_case_free(&a);
        saved_case_free(&b);
        COUNTER_CLEAN(&counter);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_variant_answers_with_the_same_bits),
        cmocka_unit_test(every_ordering_and_relaxation_is_kept),
        cmocka_unit_test(every_way_has_what_it_stands_for),
        cmocka_unit_test(the_same_matrix_gives_the_same_bytes),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

/* test_saved_set.c: selected inverses and regions, saved with their factor, loaded and mapped */
#define _XOPEN_SOURCE 700
#include "tests/lib/temporary_files.h"

#include "tests/lib/parallel_for.h"
#include "tests/lib/saved_format.h"
#include "tests/lib/saved_set.h"

/* ---- the same answers ---- */

/* The objects of a set follow refactorizations if they are copies, and refuse them if mapped. */
static void refactor(const set_case_t *q, const sl_saved_set *got, const saved_t *m,
                     int is_mapped) {
    const sl_status expected = is_mapped ? SL_ERR_READ_ONLY : SL_OK;
    sl_factor *F = got->factor;
    SL_EXPECT(expected, sl_factor_refactor(F, &q->c.y.M.view, NULL));
    if (got->selected != NULL) {
        sl_work *W = NULL;
        SL_CHECK(sl_work_create(&W, NULL));
        SL_EXPECT(expected, sl_selected_refactor(got->selected, F, W));
        sl_work_free(W);
    }
    for (sl_int k = 0; k < got->n_regions; k++) {
        const sl_selected *Z = k == 2 ? got->selected : NULL; /* as it was made */
        if (!is_mapped) { /* the factor has other numbers now, if the same ones */
            size_t bytes = 0;
            SL_EXPECT(SL_ERR_STALE, sl_save(NULL, NULL, &bytes, got, NULL));
        }
        SL_EXPECT(expected, sl_region_refactor(got->regions[k], F, Z, NULL));
    }
    saved_t again = set_save(got);
    assert_int_equal(again.size, m->size);
    assert_memory_equal(again.bytes, m->bytes, m->size);
    saved_free(&again);
}

static void round_trip(set_case_t *q, const saved_t *m, int call, unsigned checks,
                       const sl_options *opt) {
    sl_saved_set got = {0};
    memset(&got, 0xA5, sizeof got);
    got.wanted = SL_SAVED_ALL;
    memset(got.reserved, 0, sizeof got.reserved);
    SL_CHECK(set_calls[call](&got, m->bytes, m->size, checks, opt));
    assert_ptr_equal(sl_factor_view(got.factor).symbolic, got.symbolic);
    assert_same_set(set_of(q), &got);
    saved_t again = set_save(&got);
    assert_int_equal(again.size, m->size);
    assert_memory_equal(again.bytes, m->bytes, m->size);
    saved_free(&again);
    refactor(q, &got, m, call == 1);
    assert_same_set(set_of(q), &got);
    sl_saved_set_free(&got);
    assert_true(got.symbolic == NULL && got.factor == NULL && got.n_regions == 0);
}

/* Loads that want less leave out the rest, and what they give is saved as if there were no more. */
static void read_as_pair(const set_case_t *q, const saved_t *m) {
    saved_t plain = saved_make(q->c.y.S, q->c.y.F);
    saved_call_t pair[2] = {pair_load_memory, pair_map_memory};
    for (int k = 0; k < 2; k++) {
        sl_saved_set got = {0};
        sl_symbolic *S = NULL;
        sl_factor *F = NULL;
        SL_CHECK(pair[k](&S, &F, m->bytes, m->size, SL_LOAD_VERIFIED, NULL));
        saved_t again = saved_make(S, F);
        assert_int_equal(again.size, plain.size);
        assert_memory_equal(again.bytes, plain.bytes, plain.size);
        saved_free(&again);
        got.wanted = SL_SAVED_ANALYSIS;
        SL_CHECK(set_calls[k](&got, m->bytes, m->size, SL_LOAD_VERIFIED, NULL));
        assert_int_equal(got.wanted, SL_SAVED_ANALYSIS);
        assert_true(got.factor == NULL && got.selected == NULL && got.regions == NULL);
        assert_same_analysis(S, got.symbolic);
        sl_saved_set_free(&got);
        assert_int_equal(got.wanted, SL_SAVED_ALL);
        SL_EXPECT(k == 0 ? SL_OK : SL_ERR_READ_ONLY, sl_factor_refactor(F, &q->c.y.M.view, NULL));
        sl_factor_free(F);
        sl_symbolic_free(S);
        SL_CHECK(set_calls[k](&got, plain.bytes, plain.size, SL_LOAD_CHECKED, NULL));
        assert_true(got.selected == NULL && got.regions == NULL && got.n_regions == 0);
        again = set_save(&got);
        assert_memory_equal(again.bytes, plain.bytes, plain.size);
        saved_free(&again);
        sl_saved_set_free(&got);
    }
    saved_free(&plain);
}

static void a_set_answers_with_the_same_bits(void **state) {
    (void)state;
    variant_list_t variants = variants_present();
    sl_int with_subtrees = 0, copied = 0;
    for (int v = 0; v < variants.count; v++) {
        for (int way = 0; way < SAVED_WAYS; way++) {
            for (gen_kind_t kind = GEN_NONE; kind < GEN_REGULAR; kind = (gen_kind_t)(kind + 1)) {
                int runs = 0;
                sl_options from = options_none(), opt = options_none();
                options_set_variant(&from, &variants, v);
                opt.isa = from.isa;
                opt.threads.count = (int)kind % 3;
                opt.threads.run = run_backwards;
                opt.threads.context = &runs;
                set_case_t q = set_case_make(way, kind, 100, 0, (int)kind % 2, &from);
                saved_t m = set_save(set_of(&q));
                for (sl_int k = 0; k < q.set.n_regions; k++) {
                    sl_stats stats;
                    stats.region = sl_region_view(q.regions[k]).info;
                    with_subtrees += stats.region.subtrees > 0 && stats.region.boundary > 0;
                    copied += stats.region.is_copied && stats.region.boundary > 0;
                }
                for (int checks = SL_LOAD_CHECKED; checks <= SL_LOAD_VERIFIED; checks++) {
                    round_trip(&q, &m, 0, (unsigned)checks, &opt);
                    round_trip(&q, &m, 1, (unsigned)checks, &opt);
                }
                read_as_pair(&q, &m);
                saved_free(&m);
                set_case_free(&q);
            }
        }
    }
    print_message("%d regions with subtrees and a boundary, %d copied\n", (int)with_subtrees,
                  (int)copied);
    assert_true(with_subtrees > 10 && copied > 10);
}

static void a_selected_inverse_is_saved_without_its_factor(void **state) {
    (void)state;
    for (int is_whole = 0; is_whole < 2; is_whole++) {
        sl_options from = options_none();
        set_case_t q = set_case_make(SAVED_DEFINITE, GEN_GRID2, 144, 0, is_whole, &from);
        sl_saved_set alone = q.set;
        alone.factor = NULL;
        alone.regions = NULL;
        alone.n_regions = 0;
        saved_t m = set_save(&alone);
        for (int k = 0; k < 2; k++) {
            sl_saved_set got = {0};
            sl_factor *F = NULL;
            sl_region *R = NULL;
            const sl_int row = 3;
            SL_CHECK(set_calls[k](&got, m.bytes, m.size, SL_LOAD_VERIFIED, NULL));
            assert_same_set(&alone, &got);
            saved_t again = set_save(&got);
            assert_memory_equal(again.bytes, m.bytes, m.size);
            saved_free(&again);
            SL_CHECK(sl_factor_create(&F, got.symbolic, &q.c.y.M.view, &q.c.opt, NULL));
            SL_EXPECT(SL_ERR_STALE, sl_region_create(&R, F, &row, 1, got.selected, NULL, NULL));
            SL_EXPECT(k == 0 ? SL_OK : SL_ERR_READ_ONLY,
                      sl_selected_refactor(got.selected, F, NULL));
            assert_same_selected(q.set.selected, got.selected);
            SL_EXPECT(k == 0 ? SL_OK : SL_ERR_STALE,
                      sl_region_create(&R, F, &row, 1, got.selected, NULL, NULL));
            sl_region_free(R);
            sl_factor_free(F);
            sl_saved_set_free(&got);
        }
        saved_free(&m);
        set_case_free(&q);
    }
}

/* Neither addresses nor what was in the memory before show in the bytes. */
static void the_same_objects_give_the_same_bytes(void **state) {
    (void)state;
    for (int way = 0; way < SAVED_PIVOTED; way++) {
        for (int is_whole = 0; is_whole < 2; is_whole++) {
            counter_t counter = counter_make();
            sl_options none = options_none(), counted = options_counted(&counter);
            set_case_t a = set_case_make(way, GEN_GRID2, 196, 0, is_whole, &none),
                       b = set_case_make(way, GEN_GRID2, 196, 0, is_whole, &counted);
            saved_t m = set_save(set_of(&a)), k = set_save(set_of(&b));
            assert_int_equal(m.size, k.size);
            assert_memory_equal(m.bytes, k.bytes, m.size);
            saved_free(&m);
            saved_free(&k);
            set_case_free(&a);
            set_case_free(&b);
            COUNTER_CLEAN(&counter);
        }
    }
}

static void the_other_byte_order_is_loaded(void **state) {
    (void)state;
    sl_options from = options_none();
    set_case_t q = set_case_make(SAVED_SKIPPED, GEN_GRID2, 144, 0, 0, &from);
    saved_t m = set_save(set_of(&q));
    saved_change_order(m.bytes);
    for (int checks = 0; checks < 3; checks++) {
        sl_saved_set got = {0};
        SL_CHECK(sl_load(&got, NULL, m.bytes, m.size, (unsigned)checks, NULL));
        assert_same_set(set_of(&q), &got);
        sl_saved_set_free(&got);
        SL_EXPECT(SL_ERR_UNSUPPORTED,
                  sl_load(&got, NULL, m.bytes, m.size, ((unsigned)checks) | SL_LOAD_MAPPED, NULL));
    }
    saved_free(&m);
    set_case_free(&q);
}

/* ---- files ---- */

static void a_set_is_saved_in_a_file(void **state) {
    (void)state;
    sl_options from = options_none();
    set_case_t q = set_case_make(SAVED_DEFINITE, GEN_GRID2, 400, 1, 1, &from);
    const char *path = files_path("set.slf");
    saved_t m = set_save(set_of(&q));
    sl_saved_set got = {0};
    size_t length = 0;
    errno = 77;
    SL_CHECK(sl_save(path, NULL, NULL, set_of(&q), NULL));
    char *bytes = files_get(path, &length);
    assert_int_equal(length, m.size);
    assert_memory_equal(bytes, m.bytes, m.size);
    free(bytes);
    for (int checks = 0; checks < 3; checks++) {
        SL_CHECK(sl_load(&got, path, NULL, 0, (unsigned)checks, NULL));
        assert_same_set(set_of(&q), &got);
        refactor(&q, &got, &m, 0);
        sl_saved_set_free(&got);
        SL_CHECK(sl_load(&got, path, NULL, 0, ((unsigned)checks) | SL_LOAD_MAPPED, NULL));
        assert_same_set(set_of(&q), &got);
        refactor(&q, &got, &m, 1);
        SL_CHECK(sl_save(path, NULL, NULL, &got, NULL)); /* over the file that is mapped */
        assert_same_set(set_of(&q), &got);
        sl_saved_set_free(&got);
    }
    assert_int_equal(errno, 77);
    (void)files_put("set.slf", m.bytes, m.size - 64);
    SL_EXPECT(SL_ERR_IO, sl_load(&got, path, NULL, 0, SL_LOAD_TRUSTED, NULL));
    assert_null(got.symbolic);
    SL_EXPECT(SL_ERR_IO, sl_load(&got, path, NULL, 0, SL_LOAD_TRUSTED | SL_LOAD_MAPPED, NULL));
    SL_EXPECT(SL_ERR_IO, sl_load(&got, files_path("none"), NULL, 0, SL_LOAD_CHECKED, NULL));
    SL_EXPECT(SL_ERR_IO, sl_save(files_path("no/such/folder"), NULL, NULL, set_of(&q), NULL));
    saved_free(&m);
    set_case_free(&q);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_set_answers_with_the_same_bits),
        cmocka_unit_test(a_selected_inverse_is_saved_without_its_factor),
        cmocka_unit_test(the_same_objects_give_the_same_bytes),
        cmocka_unit_test(the_other_byte_order_is_loaded),
        cmocka_unit_test(a_set_is_saved_in_a_file),
    };
    return cmocka_run_group_tests(tests, files_set_up, files_tear_down);
}

/* test_saved_set_use.c: sets of saved objects: what is refused, sizes of memory, failing loads */
#include "tests/lib/parallel_for.h"
#include "tests/lib/saved_format.h"
#include "tests/lib/saved_set.h"

/* ---- arguments ---- */

static void assert_filled(const unsigned char *bytes, size_t count) {
    for (size_t k = 0; k < count; k++) {
        assert_int_equal(bytes[k], 0x5A);
    }
}

/* Memory may be larger than the set and of any alignment. If it is too small, nothing is written
 * but the size that is needed. */
static void memory_of_any_size(void **state) {
    (void)state;
    sl_options from = options_none();
    set_case_t q = set_case_make(SAVED_DEFINITE, GEN_GRID2, 100, 0, 0, &from);
    saved_t m = set_save(set_of(&q)), other = saved_of_size(m.size + 70);
    const size_t small[4] = {0, 1, 64, m.size - 1}, enough[3] = {m.size, m.size + 1, SIZE_MAX};
    for (int k = 0; k < 4; k++) {
        size_t size = small[k];
        memset(other.bytes, 0x5A, other.size);
        SL_EXPECT(SL_ERR_ARGUMENT, sl_save(NULL, other.bytes, &size, set_of(&q), NULL));
        assert_true(size == m.size);
        assert_filled(other.bytes, other.size);
        size = small[k];
        SL_CHECK(sl_save(NULL, NULL, &size, set_of(&q), NULL));
        assert_true(size == m.size);
    }
    for (int k = 0; k < 3; k++) {
        size_t size = enough[k];
        memset(other.bytes, 0x5A, other.size);
        SL_CHECK(sl_save(NULL, other.bytes + k, &size, set_of(&q), NULL));
        assert_true(size == m.size);
        assert_filled(other.bytes, (size_t)k);
        assert_memory_equal(other.bytes + k, m.bytes, m.size);
        assert_filled(other.bytes + k + m.size, other.size - m.size - (size_t)k);
    }
    saved_free(&other);
    saved_free(&m);
    set_case_free(&q);
}

static void what_does_not_belong_together_is_refused(void **state) {
    (void)state;
    sl_options from = options_none();
    set_case_t q = set_case_make(SAVED_DEFINITE, GEN_GRID2, 100, 0, 1, &from),
               z = set_case_make(SAVED_DEFINITE, GEN_GRID2, 100, 0, 1, &from);
    sl_saved_set set = *set_of(&q), got = {0};
    saved_t m = set_save(&set);
    sl_region *mixed[2] = {q.regions[0], NULL};
    size_t size = 7, kept = m.size;
#define REFUSED(status, what) \
    SL_EXPECT(status, sl_save(NULL, NULL, &size, what, NULL)); \
    SL_EXPECT(status, sl_save(NULL, m.bytes, &kept, what, NULL)); \
    SL_EXPECT(status, sl_save(NOWHERE, NULL, NULL, what, NULL))
    REFUSED(SL_ERR_ARGUMENT, NULL);
    set.symbolic = NULL;
    REFUSED(SL_ERR_ARGUMENT, &set);
    set = q.set;
    set.factor = NULL; /* with regions */
    REFUSED(SL_ERR_ARGUMENT, &set);
    set = q.set;
    set.n_regions = -1;
    REFUSED(SL_ERR_ARGUMENT, &set);
    set = q.set;
    set.regions = NULL;
    REFUSED(SL_ERR_ARGUMENT, &set);
    set.regions = mixed;
    set.n_regions = 2;
    REFUSED(SL_ERR_ARGUMENT, &set); /* a region that is NULL */
    mixed[1] = z.regions[0];        /* and one of the same numbers, but of another analysis */
    REFUSED(SL_ERR_MISMATCH, &set);
    set = q.set;
    set.selected = z.set.selected;
    REFUSED(SL_ERR_MISMATCH, &set);
    set.factor = NULL;
    set.n_regions = 0;
    REFUSED(SL_ERR_MISMATCH, &set);
    set = q.set;
    set.factor = z.set.factor;
    REFUSED(SL_ERR_MISMATCH, &set);
    assert_int_equal(size, 7); /* as before */
    assert_true(kept == m.size);
    set = *set_of(&q);
    set.reserved[5] = &set;
    REFUSED(SL_ERR_ARGUMENT, &set);
    /* the numbers of the factor change, those of the others do not */
    SL_CHECK(sl_factor_refactor(q.c.y.F, &q.c.y.M.view, NULL));
    REFUSED(SL_ERR_STALE, set_of(&q));
    for (int k = 0; k < 2; k++) {
        SL_EXPECT(SL_ERR_ARGUMENT, set_calls[k](NULL, m.bytes, m.size, SL_LOAD_CHECKED, NULL));
        memset(&got, 0xA5, sizeof got); /* a reserved field is set */
        got.wanted = SL_SAVED_FACTOR;
        SL_EXPECT(SL_ERR_ARGUMENT, set_calls[k](&got, m.bytes, m.size, SL_LOAD_CHECKED, NULL));
        assert_true(got.symbolic == NULL && got.reserved[0] == NULL);
        SL_EXPECT(SL_ERR_ARGUMENT, set_calls[k](&got, NULL, m.size, SL_LOAD_CHECKED, NULL));
        assert_true(got.symbolic == NULL && got.regions == NULL && got.n_regions == 0);
        SL_EXPECT(SL_ERR_IO, set_calls[k](&got, m.bytes, m.size - 64, SL_LOAD_CHECKED, NULL));
        assert_int_equal(got.wanted, SL_SAVED_FACTOR);
        got.wanted = (sl_saved_content)3;
        SL_EXPECT(SL_ERR_ARGUMENT, set_calls[k](&got, m.bytes, m.size, SL_LOAD_CHECKED, NULL));
        got.wanted = (sl_saved_content)-1;
        SL_EXPECT(SL_ERR_ARGUMENT, set_calls[k](&got, m.bytes, m.size, SL_LOAD_CHECKED, NULL));
        got.wanted = SL_SAVED_ALL;
    }
    sl_saved_set_free(NULL);
    saved_free(&m);
    set_case_free(&q);
    set_case_free(&z);
}

/* The last call was refused for this reason. With tcc the header keeps no last error. */
static void expect_reason(const char *reason) {
    char text[300];
    sl_error_text(text, sizeof text, SL_ERR_ARGUMENT, NULL);
#if !defined(__TINYC__)
    assert_non_null(strstr(text, reason));
#else
    (void)reason;
    assert_true(text[0] != '\0');
#endif
}

/* A path or memory, exactly one, and flags that exist and agree. */
static void places_and_flags_are_checked(void **state) {
    (void)state;
    sl_options from = options_none();
    set_case_t q = set_case_make(SAVED_DEFINITE, GEN_GRID2, 100, 0, 1, &from);
    saved_t m = set_save(set_of(&q));
    const struct {
        unsigned flags;
        const char *path;
        const void *memory;
        const char *reason;
    } loads[] = {
        {8, NULL, m.bytes, "bit"},
        {1u << 31 | SL_LOAD_MAPPED, NOWHERE, NULL, "bit"},
        {~0u, NULL, m.bytes, "bit"},
        {SL_LOAD_TRUSTED | SL_LOAD_VERIFIED, NULL, m.bytes, "excludes"},
        {SL_LOAD_TRUSTED | SL_LOAD_VERIFIED | SL_LOAD_MAPPED, NOWHERE, NULL, "excludes"},
        {SL_LOAD_CHECKED, NULL, NULL, "both NULL"},
        {SL_LOAD_MAPPED, NULL, NULL, "both NULL"},
        {SL_LOAD_CHECKED, NOWHERE, m.bytes, "both given"},
        {SL_LOAD_MAPPED, NOWHERE, m.bytes, "both given"},
        {SL_LOAD_MAPPED, NULL, m.bytes + 8, "aligned"},
    };
    sl_saved_set got = {0};
    for (size_t k = 0; k < sizeof loads / sizeof loads[0]; k++) {
        got.n_regions = 3; /* of a set that was used before */
        SL_EXPECT(SL_ERR_ARGUMENT,
                  sl_load(&got, loads[k].path, loads[k].memory, m.size, loads[k].flags, NULL));
        expect_reason(loads[k].reason);
        assert_true(got.symbolic == NULL && got.n_regions == 0);
        SL_EXPECT(SL_ERR_ARGUMENT,
                  sl_load(NULL, loads[k].path, loads[k].memory, m.size, loads[k].flags, NULL));
    }
    unsigned char *copy = (unsigned char *)test_array(m.size, 1);
    size_t size = m.size;
    const struct {
        const char *path;
        void *memory;
        size_t *bytes;
        const char *reason;
    } saves[] = {
        {NOWHERE, copy, &size, "both given"},
        {NOWHERE, copy, NULL, "both given"},
        {NULL, copy, NULL, "bytes are NULL"},
        {NULL, NULL, NULL, "bytes are NULL"},
    };
    for (size_t k = 0; k < sizeof saves / sizeof saves[0]; k++) {
        SL_EXPECT(SL_ERR_ARGUMENT,
                  sl_save(saves[k].path, saves[k].memory, saves[k].bytes, set_of(&q), NULL));
        expect_reason(saves[k].reason);
        assert_true(size == m.size && copy[0] == 0);
    }
    size = 1; /* with a path bytes is the size that was written, whatever it was */
    SL_CHECK(sl_save(NOWHERE, NULL, &size, set_of(&q), NULL));
    assert_true(size == m.size);
    free(copy);
    saved_free(&m);
    set_case_free(&q);
}

/* A set that was filled in by hand, and in part. */
static void a_set_without_a_list_is_released(void **state) {
    (void)state;
    sl_saved_set set;
    memset(&set, 0, sizeof set);
    set.n_regions = 3;
    sl_saved_set_free(&set);
    assert_true(set.n_regions == 0 && set.regions == NULL);
}

/* A file whose regions or selected inverse name another factor than the one that is in it. */
static void parts_of_another_factor_are_refused(void **state) {
    (void)state;
    sl_options from = options_none();
    set_case_t q = set_case_make(SAVED_DEFINITE, GEN_GRID2, 100, 0, 1, &from);
    saved_t m = set_save(set_of(&q));
    int found = 0;
    for (uint32_t s = 0; s < saved_u32(m.bytes + SAVED_SECTIONS); s++) {
        const uint32_t id = saved_u32(saved_entry(m.bytes, s) + SAVED_ID);
        if (id != SAVED_REGIONS && id != SAVED_SELECTED) {
            continue;
        }
        unsigned char *identity = m.bytes + saved_u64(saved_entry(m.bytes, s) + SAVED_OFFSET) + 8;
        identity[found] ^= 1;
        saved_repair(m.bytes, m.size);
        for (int k = 0; k < 2; k++) {
            sl_saved_set got = {0};
            SL_EXPECT(SL_ERR_IO, set_calls[k](&got, m.bytes, m.size, SL_LOAD_TRUSTED, NULL));
        }
        identity[found++] ^= 1;
    }
    assert_int_equal(found, 2);
    saved_free(&m);
    set_case_free(&q);
}

/* ---- memory ---- */

static void every_allocation_of_a_load_may_fail(void **state) {
    (void)state;
    sl_options from = options_none();
    for (int is_whole = 0; is_whole < 2; is_whole++) {
        set_case_t q = set_case_make(SAVED_DEFINITE, GEN_GRID2, 144, 0, is_whole, &from);
        saved_t m = set_save(set_of(&q));
        for (int call = 0; call < 2; call++) {
            int done = 0, runs = 0;
            for (int64_t at = 0; !done; at++) {
                counter_t counter = counter_make();
                sl_options opt = options_counted(&counter);
                sl_saved_set got = {0};
                counter.fail_at = at;
                opt.threads.count = 2;
                opt.threads.run = run_backwards;
                opt.threads.context = &runs;
                const sl_status status =
                    set_calls[call](&got, m.bytes, m.size, SL_LOAD_CHECKED, &opt);
                done = status == SL_OK;
                assert_true(done || (status == SL_ERR_MEMORY && got.symbolic == NULL &&
                                     got.regions == NULL));
                counter.fail_at = -1;
                if (done) {
                    assert_true(at >= 3 + SETS_REGIONS); /* every object, and the array */
                    assert_same_set(set_of(&q), &got);
                }
                sl_saved_set_free(&got);
                COUNTER_CLEAN(&counter);
            }
        }
        saved_free(&m);
        set_case_free(&q);
    }
}

/* What a mapped set keeps does not grow with the matrix. */
static void a_mapped_set_keeps_little(void **state) {
    (void)state;
    sl_options from = options_none();
    for (sl_int n = 400; n <= 10000; n *= 5) {
        counter_t counter = counter_make();
        sl_options opt = options_counted(&counter);
        set_case_t q = set_case_make(SAVED_DEFINITE, GEN_GRID2, n, 0, 1, &from);
        saved_t m = set_save(set_of(&q));
        sl_saved_set got = {0};
        size_t rows = 0;
        SL_CHECK(sl_load(&got, NULL, m.bytes, m.size, SL_LOAD_MAPPED, &opt));
        for (sl_int k = 0; k < got.n_regions; k++) {
            const sl_region_arrays r = sl_region_view(got.regions[k]);
            rows += (size_t)(r.n_roots + r.n_boundary);
        }
        assert_true(counter.live_bytes < 4096 + 500 * SETS_REGIONS + 16 * rows);
        sl_saved_set_free(&got);
        COUNTER_CLEAN(&counter);
        saved_free(&m);
        set_case_free(&q);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(memory_of_any_size),
        cmocka_unit_test(places_and_flags_are_checked),
        cmocka_unit_test(what_does_not_belong_together_is_refused),
        cmocka_unit_test(a_set_without_a_list_is_released),
        cmocka_unit_test(parts_of_another_factor_are_refused),
        cmocka_unit_test(every_allocation_of_a_load_may_fail),
        cmocka_unit_test(a_mapped_set_keeps_little),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

/* test_save_damage.c: damaged, forged, truncated and foreign bytes are refused or harmless */
#include "tests/lib/saved.h"
#include "tests/lib/saved_format.h"

/* Runs every kind of query; what they answer does not matter. */
static void use(const sl_symbolic *S, sl_factor *F, const sl_csc *A) {
    const sl_int n = sl_symbolic_view(S).n;
    const sl_int set[3] = {0, n / 2, n - 1};
    double *b = test_reals(9 * (size_t)n), *x = test_reals(9 * (size_t)n);
    sl_plan *P = NULL;
    sl_selected *Z = NULL;
    sl_region *R = NULL;
    sl_factor *G = NULL;
    gen_reals(b, 9 * (size_t)n, 1);
    (void)(sl_factor_solve(F, x, (size_t)n, b, (size_t)n, 9, NULL) == SL_OK);
    (void)(sl_plan_create(&P, S, set, 3, set, 3, NULL, NULL) == SL_OK);
    if (P != NULL) {
        (void)(sl_plan_solve(P, F, x, 3, b, 3, 2, NULL) == SL_OK);
        (void)(sl_plan_solve_regularized(P, F, x, 3, b, 3, 1, 1, NULL, NULL) == SL_OK);
    }
    (void)(sl_inverse_diagonal(F, x, NULL, SL_ALL, NULL, NULL) == SL_OK);
    (void)(sl_selected_create(&Z, F, NULL, SL_ALL, NULL, NULL) == SL_OK);
    (void)(sl_region_create(&R, F, set, 3, NULL, NULL, NULL) == SL_OK);
    (void)(sl_factor_create(&G, S, A, NULL, NULL) == SL_OK);
    (void)(sl_factor_refactor(F, A, NULL) == SL_OK);
    sl_factor_free(G);
    sl_region_free(R);
    sl_selected_free(Z);
    sl_plan_free(P);
    free(b);
    free(x);
}

/* Loads or maps bytes; uses what comes out. Returns the status. */
static sl_status attempt(saved_call_t call, const saved_t *m, size_t size, unsigned checks,
                         const sl_csc *A) {
    counter_t counter = counter_make();
    sl_options opt = options_counted(&counter);
    sl_symbolic *S = NULL;
    sl_factor *F = NULL;
    const sl_status status = call(&S, &F, m->bytes, size, checks, &opt);
    assert_true((S != NULL) == (status == SL_OK) && (S != NULL || F == NULL));
    assert_true(counter.total_bytes < size + 8192);
    if (F != NULL && checks != SL_LOAD_TRUSTED) {
        use(S, F, A);
    }
    sl_factor_free(F);
    sl_symbolic_free(S);
    COUNTER_CLEAN(&counter);
    return status;
}

static void every_truncation_is_refused(void **state) {
    (void)state;
    saved_case_t c = saved_case_make(SAVED_WEIGHTED, GEN_GRID2, 16, 0, NULL);
    saved_t m = saved_make(c.y.S, c.y.F);
    for (size_t size = 0; size < m.size; size++) {
        saved_t cut = saved_of_size(size); /* so that a read past the end is noticed */
        memcpy(cut.bytes, m.bytes, size);
        for (int checks = 0; checks < 3; checks++) {
            assert_int_equal(attempt(pair_load_memory, &cut, size, (unsigned)checks, NULL),
                             SL_ERR_IO);
            assert_int_equal(attempt(pair_map_memory, &cut, size, (unsigned)checks, NULL),
                             SL_ERR_IO);
        }
        /* also with a header that agrees with the size */
        if (size >= SAVED_HEADER) {
            saved_put64(cut.bytes + SAVED_BYTES, size);
            saved_repair(cut.bytes, size);
            assert_int_equal(attempt(pair_load_memory, &cut, size, SL_LOAD_TRUSTED, NULL),
                             SL_ERR_IO);
        }
        saved_free(&cut);
    }
    saved_free(&m);
    saved_case_free(&c);
}

/* Flips every bit, or every fifth one. Verification notices all of them. The header, the table and
 * the numbers are always verified. With checksums that agree, the structure is checked, and what
 * passes is safe to use. */
static void every_flipped_bit_is_noticed_or_harmless(void **state) {
    (void)state;
    for (int way = 0; way < SAVED_WAYS; way++) {
        saved_case_t c = saved_case_make(way, GEN_GRID2, 9, 0, NULL);
        saved_t m = saved_make(c.y.S, c.y.F), k = saved_of_size(m.size);
        const size_t arrays = (size_t)saved_round(SAVED_HEADER + SAVED_KNOWN * SAVED_ENTRY) +
                              SAVED_ANALYSIS_BYTES + SAVED_FACTOR_BYTES;
        int accepted = 0, refused = 0;
        for (size_t bit = 0; bit < 8 * m.size; bit += way == SAVED_WEIGHTED ? 1 : 5) {
            memcpy(k.bytes, m.bytes, m.size);
            k.bytes[bit / 8] ^= (unsigned char)(1u << bit % 8);
            assert_true(attempt(pair_load_memory, &k, m.size, SL_LOAD_VERIFIED, NULL) != SL_OK);
            if (bit % 4 == 0) {
                assert_true(attempt(pair_map_memory, &k, m.size, SL_LOAD_VERIFIED, NULL) != SL_OK);
            }
            if (bit / 8 < arrays) {
                assert_true(attempt(pair_map_memory, &k, m.size, SL_LOAD_TRUSTED, NULL) != SL_OK);
            }
            saved_repair(k.bytes, m.size);
            const int is_ok = attempt(bit % 2 ? pair_load_memory : pair_map_memory, &k, m.size,
                                      SL_LOAD_VERIFIED, &c.y.M.view) == SL_OK;
            accepted += is_ok;
            refused += !is_ok;
        }
        assert_true(accepted > 0 && refused > 0);
        saved_free(&m);
        saved_free(&k);
        saved_case_free(&c);
    }
}

/* Loads or maps k, a copy of m with `size` other bytes at `at` and checksums that agree. */
static sl_status attempt_with(saved_t *k, const saved_t *m, size_t at, const void *bytes,
                              size_t size, int is_loaded, const sl_csc *A) {
    memcpy(k->bytes, m->bytes, m->size);
    memcpy(k->bytes + at, bytes, size);
    saved_repair(k->bytes, m->size);
    return attempt(is_loaded ? pair_load_memory : pair_map_memory, k, m->size, SL_LOAD_CHECKED, A);
}

/* Replaces every 32-bit word, or every third one, by values that overflow or point elsewhere. */
static void every_replaced_word_is_noticed_or_harmless(void **state) {
    (void)state;
    static const uint32_t values[] = {
        0, 1, 2, 8, 0x7fffffffu, 0x80000000u, 0xffffffffu, 0x01000000u, 0x7ffffff8u};
    for (int way = 0; way < SAVED_WAYS; way++) {
        saved_case_t c = saved_case_make(way, GEN_COMPONENTS, 12, 0, NULL);
        saved_t m = saved_make(c.y.S, c.y.F), k = saved_of_size(m.size);
        for (size_t at = 8; at < m.size; at += way == SAVED_WEIGHTED ? 4 : 12) {
            for (size_t v = 0; v < sizeof values / sizeof *values; v++) {
                (void)attempt_with(&k, &m, at, &values[v], 4, v % 2, &c.y.M.view);
            }
        }
        saved_free(&m);
        saved_free(&k);
        saved_case_free(&c);
    }
}

/* Replaces every 64-bit word, or every third one, by numbers at the ends of their range. The
 * undefined-behavior sanitizer notices a difference of numbers that are not checked. */
static void every_extreme_word_is_noticed_or_harmless(void **state) {
    (void)state;
    sl_options from = options_none();
    from.relaxation = SL_RELAXATION_NONE; /* so that supernodes have rows below */
    for (int way = 0; way < SAVED_WAYS; way++) {
        saved_case_t c = saved_case_make(way, GEN_GRID2, 16, 0, &from);
        saved_t m = saved_make(c.y.S, c.y.F), k = saved_of_size(m.size);
        for (size_t at = 8; at < m.size; at += way == SAVED_DEFINITE ? 8 : 24) {
            for (int v = 0; v < SAVED_EXTREMES; v++) {
                const uint64_t word = saved_extreme(v, 16);
                (void)attempt_with(&k, &m, at, &word, 8, v % 2, &c.y.M.view);
            }
        }
        saved_free(&m);
        saved_free(&k);
        saved_case_free(&c);
    }
}

/* Replaces every 64-bit word of the sections with numbers by reals that no object has. */
static void every_replaced_real_is_noticed_or_harmless(void **state) {
    (void)state;
    const double values[] = {NAN, INFINITY, -INFINITY, -1.0, 0.5};
    const size_t prefix = (size_t)saved_round(SAVED_HEADER + SAVED_KNOWN * SAVED_ENTRY);
    for (int way = 0; way < SAVED_WAYS; way++) {
        saved_case_t c = saved_case_make(way, GEN_GRID2, 16, 0, NULL);
        saved_t m = saved_make(c.y.S, c.y.F), k = saved_of_size(m.size);
        int refused = 0;
        for (size_t at = prefix; at < m.size; at += 8) {
            for (size_t v = 0; v < sizeof values / sizeof *values; v++) {
                refused += attempt_with(&k, &m, at, &values[v], 8, v % 2, &c.y.M.view) != SL_OK;
            }
        }
        assert_true(refused > 0);
        saved_free(&m);
        saved_free(&k);
        saved_case_free(&c);
    }
}

/* ---- the table ---- */

/* The last section is missing, in the table and in the header. */
static void a_missing_section_is_refused(void **state) {
    (void)state;
    factored_t y = factored_make(GEN_GRID2, 25, 1, 0, NULL);
    saved_t m = saved_make(y.S, y.F), k = saved_of_size(m.size);
    const size_t old_prefix = (size_t)saved_round(SAVED_HEADER + SAVED_KNOWN * SAVED_ENTRY),
                 prefix = (size_t)saved_round(SAVED_HEADER + (SAVED_KNOWN - 1) * SAVED_ENTRY),
                 moved = old_prefix - prefix;
    const size_t end = (size_t)saved_u64(saved_entry(m.bytes, SAVED_KNOWN - 1) + SAVED_OFFSET);
    memcpy(k.bytes, m.bytes, prefix);
    memcpy(k.bytes + prefix, m.bytes + old_prefix, end - old_prefix);
    for (uint32_t s = 0; s + 1 < SAVED_KNOWN; s++) {
        unsigned char *at = saved_entry(k.bytes, s) + SAVED_OFFSET;
        saved_put64(at, saved_u64(at) - moved);
    }
    saved_put32(k.bytes + SAVED_SECTIONS, SAVED_KNOWN - 1);
    saved_put64(k.bytes + SAVED_BYTES, end - moved);
    saved_repair(k.bytes, end - moved);
    assert_int_equal(attempt(pair_load_memory, &k, end - moved, SL_LOAD_CHECKED, NULL), SL_ERR_IO);
    assert_int_equal(attempt(pair_map_memory, &k, end - moved, SL_LOAD_TRUSTED, NULL), SL_ERR_IO);
    saved_free(&m);
    saved_free(&k);
    factored_free(&y);
}

static void sections_must_follow_each_other(void **state) {
    (void)state;
    factored_t y = factored_make(GEN_GRID2, 25, 1, 0, NULL);
    saved_t m = saved_make(y.S, y.F), k = saved_of_size(m.size);
    static const int64_t moves[] = {-64, 64, -8, 8, -1, 1, INT64_MIN, INT64_MAX - 63, -4096};
    for (uint32_t s = 0; s < SAVED_KNOWN; s++) {
        for (size_t v = 0; v < sizeof moves / sizeof *moves; v++) {
            for (int field = SAVED_OFFSET; field <= SAVED_LENGTH; field += 8) {
                memcpy(k.bytes, m.bytes, m.size);
                unsigned char *entry = saved_entry(k.bytes, s);
                saved_put64(entry + field, saved_u64(entry + field) + (uint64_t)moves[v]);
                saved_repair(k.bytes, m.size);
                assert_int_equal(attempt(pair_load_memory, &k, m.size, SL_LOAD_TRUSTED, NULL),
                                 SL_ERR_IO);
            }
        }
        /* overlapping: two sections in one place */
        if (s > 1 && saved_u64(saved_entry(m.bytes, s) + SAVED_LENGTH) > 0) {
            memcpy(k.bytes, m.bytes, m.size);
            memcpy(saved_entry(k.bytes, s) + SAVED_OFFSET,
                   saved_entry(m.bytes, s - 2) + SAVED_OFFSET, 16);
            saved_repair(k.bytes, m.size);
            assert_int_equal(attempt(pair_map_memory, &k, m.size, SL_LOAD_TRUSTED, NULL),
                             SL_ERR_IO);
        }
    }
    for (uint32_t count = 0; count < 70; count++) {
        memcpy(k.bytes, m.bytes, m.size);
        saved_put32(k.bytes + SAVED_SECTIONS, count);
        saved_repair(k.bytes, m.size);
        assert_int_equal(attempt(pair_map_memory, &k, m.size, SL_LOAD_TRUSTED, NULL),
                         count == SAVED_KNOWN ? SL_OK : SL_ERR_IO);
    }
    saved_free(&m);
    saved_free(&k);
    factored_free(&y);
}

/* ---- versions and byte order ---- */

/* A file of a later version that older ones may read: an unknown section at its end. */
static saved_t later_file(const saved_t *m) {
    const size_t old_prefix = (size_t)saved_round(SAVED_HEADER + SAVED_KNOWN * SAVED_ENTRY);
    const size_t prefix = (size_t)saved_round(SAVED_HEADER + (SAVED_KNOWN + 1) * SAVED_ENTRY),
                 moved = prefix - old_prefix;
    saved_t k = saved_of_size(m->size + moved + 128);
    memcpy(k.bytes, m->bytes, old_prefix);
    memcpy(k.bytes + prefix, m->bytes + old_prefix, m->size - old_prefix);
    for (uint32_t s = 0; s < SAVED_KNOWN; s++) {
        unsigned char *at = saved_entry(k.bytes, s) + SAVED_OFFSET;
        saved_put64(at, saved_u64(at) + moved);
    }
    unsigned char *entry = saved_entry(k.bytes, SAVED_KNOWN);
    saved_put32(entry + SAVED_ID, 1000);
    saved_put32(entry + SAVED_WORD, 1);
    saved_put64(entry + SAVED_OFFSET, m->size + moved);
    saved_put64(entry + SAVED_LENGTH, 100);
    saved_put32(k.bytes + SAVED_WRITE, SAVED_LATER);
    saved_put32(k.bytes + SAVED_SECTIONS, SAVED_KNOWN + 1);
    saved_put64(k.bytes + SAVED_BYTES, k.size);
    saved_repair(k.bytes, k.size);
    return k;
}

static void later_versions_are_read_only_or_refused(void **state) {
    (void)state;
    factored_t y = factored_make(GEN_GRID2, 25, 1, 0, NULL);
    saved_t m = saved_make(y.S, y.F), k = later_file(&m);
    saved_call_t calls[2] = {pair_load_memory, pair_map_memory};
    for (int call = 0; call < 2; call++) {
        sl_symbolic *S = NULL;
        sl_factor *F = NULL;
        size_t size = 0;
        SL_CHECK(calls[call](&S, &F, k.bytes, k.size, SL_LOAD_VERIFIED, NULL));
        assert_same_answers(y.F, F);
        SL_EXPECT(SL_ERR_READ_ONLY, sl_factor_refactor(F, &y.M.view, NULL));
        SL_EXPECT(SL_ERR_MISMATCH,
                  pair_save_memory(NULL, &size, S, F)); /* it would lose the unknown section */
        sl_factor_free(F);
        sl_symbolic_free(S);
    }
    for (uint32_t version = 0; version < SAVED_LATER; version++) { /* have no such section */
        saved_put32(k.bytes + SAVED_WRITE, version);
        saved_repair(k.bytes, k.size);
        assert_int_equal(attempt(pair_load_memory, &k, k.size, SL_LOAD_CHECKED, NULL), SL_ERR_IO);
    }
    for (uint32_t version = 0; version < 4; version++) {
        saved_put32(m.bytes + SAVED_READ, version);
        saved_repair(m.bytes, m.size);
        assert_int_equal(attempt(pair_load_memory, &m, m.size, SL_LOAD_CHECKED, &y.M.view),
                         version == 1   ? SL_OK
                         : version == 2 ? SL_ERR_IO /* would have L in float */
                                        : SL_ERR_UNSUPPORTED);
    }
    m.bytes[1] ^= 1; /* the magic number */
    assert_int_equal(attempt(pair_load_memory, &m, m.size, SL_LOAD_CHECKED, NULL),
                     SL_ERR_UNSUPPORTED);
    saved_free(&m);
    saved_free(&k);
    factored_free(&y);
}

static void the_other_byte_order_is_loaded_and_not_mapped(void **state) {
    (void)state;
    for (int way = 0; way < SAVED_WAYS; way++) {
        saved_case_t c = saved_case_make(way, GEN_GRID2, 100, 1, NULL);
        saved_t m = saved_make(c.y.S, c.y.F), k = saved_of_size(m.size);
        sl_symbolic *S = NULL;
        sl_factor *F = NULL;
        memcpy(k.bytes, m.bytes, m.size);
        saved_change_order(k.bytes);
        assert_memory_not_equal(k.bytes, m.bytes, m.size);
        for (int checks = 0; checks < 3; checks++) {
            SL_EXPECT(SL_ERR_UNSUPPORTED,
                      pair_map_memory(&S, &F, k.bytes, k.size, (unsigned)checks, NULL));
            SL_CHECK(pair_load_memory(&S, &F, k.bytes, k.size, (unsigned)checks, NULL));
            assert_same_answers(c.y.F, F);
            SL_CHECK(sl_factor_refactor(F, &c.y.M.view, NULL)); /* the pattern is recognized */
            saved_t again = saved_make(S, F);
            assert_memory_equal(again.bytes, m.bytes, m.size);
            saved_free(&again);
            sl_factor_free(F);
            sl_symbolic_free(S);
        }
        k.bytes[k.size - 1000] ^= 1;
        SL_EXPECT(SL_ERR_IO, pair_load_memory(&S, &F, k.bytes, k.size, SL_LOAD_VERIFIED, NULL));
        saved_free(&m);
        saved_free(&k);
        saved_case_free(&c);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_truncation_is_refused),
        cmocka_unit_test(every_flipped_bit_is_noticed_or_harmless),
        cmocka_unit_test(every_replaced_word_is_noticed_or_harmless),
        cmocka_unit_test(every_extreme_word_is_noticed_or_harmless),
        cmocka_unit_test(every_replaced_real_is_noticed_or_harmless),
        cmocka_unit_test(a_missing_section_is_refused),
        cmocka_unit_test(sections_must_follow_each_other),
        cmocka_unit_test(later_versions_are_read_only_or_refused),
        cmocka_unit_test(the_other_byte_order_is_loaded_and_not_mapped),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

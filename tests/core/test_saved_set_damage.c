/* test_saved_set_damage.c: damaged, forged and truncated regions and selected inverses */
#include "tests/lib/saved_format.h"
#include "tests/lib/saved_set.h"

/* test_save_damage.c has the same for an analysis and a factor. Here the damage is mainly in what
 * write version 2 adds: the end of the table and the last sections. */

/* ---- use ---- */

/* Solves in a region, with b and x on its boundary and in its subtrees. */
static void use_region(const sl_saved_set *set, sl_region *R) {
    const sl_int n = sl_symbolic_view(set->symbolic).n;
    const size_t ld = (size_t)n + 1;
    sl_int *rows = test_ints((size_t)n);
    const sl_int count = region_rows(R, rows);
    double *b = test_reals(9 * ld), *x = test_reals(9 * ld);
    sl_options opt = options_none();
    sl_plan *P = NULL;
    sl_stats stats;
    gen_reals(b, 9 * ld, 1);
    assert_true(count >= 0 && count <= n);
    opt.region = R;
    if (sl_plan_create(&P, set->symbolic, rows, count, rows, count, &opt, &stats) == SL_OK) {
        assert_true(stats.plan.in_region);
        (void)(sl_plan_solve(P, set->factor, x, ld, b, ld, 1, NULL) == SL_OK);
        (void)(sl_plan_solve(P, set->factor, x, ld, b, ld, 9, NULL) == SL_OK);
    }
    sl_plan_free(P);
    free(rows);
    free(b);
    free(x);
}

/* Every kind of call; what they answer does not matter. */
static void use(const sl_saved_set *set, const sl_csc *A) {
    const sl_int n = sl_symbolic_view(set->symbolic).n, row = n / 2;
    double *x = test_reals((size_t)n + 1);
    sl_region *R = NULL;
    size_t size = 0;
    const sl_status status = sl_save(NULL, NULL, &size, set, NULL);
    assert_true(status == SL_OK || status == SL_ERR_MISMATCH); /* as if of a later version */
    saved_t again = saved_of_size(size);
    SL_EXPECT(status, sl_save(NULL, again.bytes, &size, set, NULL));
    saved_free(&again);
    for (sl_int k = 0; k < set->n_regions; k++) {
        (void)sl_region_view(set->regions[k]);
        use_region(set, set->regions[k]);
    }
    if (set->factor != NULL) {
        (void)(sl_region_create(&R, set->factor, &row, 1, set->selected, NULL, NULL) == SL_OK);
        (void)(sl_factor_refactor(set->factor, A, NULL) == SL_OK);
    }
    if (set->selected != NULL) {
        (void)sl_selected_view(set->selected);
        for (sl_int k = 0; k < n; k++) {
            (void)(sl_selected_entries(set->selected, x, &k, NULL, 1, NULL) == SL_OK);
            (void)(sl_selected_entries(set->selected, x, &k, &row, 1, NULL) == SL_OK);
        }
        (void)(sl_selected_entries(set->selected, x, NULL, NULL, SL_ALL, NULL) == SL_OK);
        if (set->factor != NULL) {
            (void)(sl_selected_refactor(set->selected, set->factor, NULL) == SL_OK);
        }
    }
    for (sl_int k = 0; k < set->n_regions; k++) {
        (void)(sl_region_refactor(set->regions[k], set->factor, set->selected, NULL) == SL_OK);
        use_region(set, set->regions[k]);
    }
    sl_region_free(R);
    free(x);
}

/* Loads or maps bytes; uses what comes out. Returns the status. */
static sl_status attempt(set_call_t call, const saved_t *m, size_t size, unsigned checks,
                         const sl_csc *A) {
    counter_t counter = counter_make();
    sl_options opt = options_counted(&counter);
    sl_saved_set set = {0};
    const sl_status status = call(&set, m->bytes, size, checks, &opt);
    assert_true((set.symbolic != NULL) == (status == SL_OK));
    assert_true(counter.total_bytes < 8 * size + 8192);
    if (status == SL_OK && checks != SL_LOAD_TRUSTED && A != NULL) {
        use(&set, A);
    }
    sl_saved_set_free(&set);
    COUNTER_CLEAN(&counter);
    return status;
}

/* ---- damage ---- */

/* A file with several subtrees, and where what write version 2 adds begins in it. */
typedef struct target_t {
    set_case_t q;
    saved_t m, k; /* the file, and room for a damaged one */
    size_t table, sections;
    const sl_csc *A;
} target_t;

/* The first region of consecutive pivots that has both subtrees and several boundary rows. */
static sl_region *region_with_subtrees(const sl_factor *F) {
    const sl_symbolic_arrays v = sl_symbolic_view(sl_factor_view(F).symbolic);
    for (sl_int count = 2; count < v.n; count++) {
        for (sl_int k = 0; k + count <= v.n; k++) {
            sl_region *R = NULL;
            SL_CHECK(sl_region_create(&R, F, v.perm + k, count, NULL, NULL, NULL));
            const sl_region_arrays r = sl_region_view(R);
            if (r.n_roots > 0 && r.n_boundary > 1) {
                return R;
            }
            sl_region_free(R);
        }
    }
    fail();
    return NULL;
}

static void target_make(target_t *t, int is_whole, int has_factor) {
    sl_options from = options_none();
    from.relaxation = SL_RELAXATION_NONE;
    t->q = set_case_make(SAVED_DEFINITE, GEN_GRID2, 25, 0, is_whole, &from);
    sl_region_free(t->q.regions[0]);
    t->q.regions[0] = region_with_subtrees(t->q.c.y.F);
    sl_saved_set set = *set_of(&t->q);
    if (!has_factor) {
        set.factor = NULL;
        set.n_regions = 0;
    }
    t->m = set_save(&set);
    t->k = saved_of_size(t->m.size);
    t->A = &t->q.c.y.M.view;
    t->table = (size_t)(saved_entry(t->m.bytes, SAVED_KNOWN) - t->m.bytes);
    t->sections = (size_t)saved_u64(saved_entry(t->m.bytes, SAVED_KNOWN) + SAVED_OFFSET);
}

static void target_free(target_t *t) {
    saved_free(&t->m);
    saved_free(&t->k);
    set_case_free(&t->q);
}

/* Is this byte one of what write version 2 adds? */
static int is_added(const target_t *t, size_t byte) {
    return byte >= t->sections || (byte >= t->table && byte < t->table + 10 * SAVED_ENTRY);
}

static void every_truncation_is_refused(void **state) {
    (void)state;
    target_t t;
    target_make(&t, 0, 1);
    for (size_t size = 0; size < t.m.size; size += size < t.sections ? 7 : 1) {
        saved_t cut = saved_of_size(size); /* so that a read past the end is noticed */
        memcpy(cut.bytes, t.m.bytes, size);
        for (int again = 0; again < 2; again++) {
            assert_int_equal(attempt(set_load, &cut, size, SL_LOAD_TRUSTED, NULL), SL_ERR_IO);
            assert_int_equal(attempt(set_map, &cut, size, SL_LOAD_VERIFIED, NULL), SL_ERR_IO);
            if (size >= SAVED_HEADER) { /* a header that agrees with the size */
                saved_put64(cut.bytes + SAVED_BYTES, size);
                saved_repair(cut.bytes, size);
            }
        }
        saved_free(&cut);
    }
    target_free(&t);
}

/* Flips every bit of what version 2 adds, and some others. Verification notices all of them. With
 * checksums that agree, what is accepted is safe to use. */
static void every_flipped_bit_is_noticed_or_harmless(void **state) {
    (void)state;
    for (int way = 0; way < 4; way++) {
        target_t t;
        int accepted = 0, refused = 0;
        target_make(&t, way % 2, way / 2);
        for (size_t bit = 0; bit < 8 * t.m.size; bit += is_added(&t, bit / 8) ? 1 : 37) {
            memcpy(t.k.bytes, t.m.bytes, t.m.size);
            t.k.bytes[bit / 8] ^= (unsigned char)(1u << bit % 8);
            assert_true(attempt(set_load, &t.k, t.m.size, SL_LOAD_VERIFIED, t.A) != SL_OK);
            if (bit % 4 == 0) {
                assert_true(attempt(set_map, &t.k, t.m.size, SL_LOAD_VERIFIED, t.A) != SL_OK);
            }
            saved_repair(t.k.bytes, t.m.size);
            const int is_ok = attempt(bit % 2 ? set_load : set_map, &t.k, t.m.size,
                                      SL_LOAD_VERIFIED, t.A) == SL_OK;
            accepted += is_ok;
            refused += !is_ok;
        }
        assert_true(accepted > 0 && refused > 0);
        target_free(&t);
    }
}

/* Replaces every 32-bit word of what version 2 adds by values that overflow or point elsewhere. */
static void every_replaced_word_is_noticed_or_harmless(void **state) {
    (void)state;
    static const uint32_t values[] = {
        0, 1, 2, 3, 8, 15, 16, 0x7fffffffu, 0x80000000u, 0xffffffffu, 0x01000000u, 0x7ffffff8u};
    for (int way = 0; way < 4; way++) {
        target_t t;
        target_make(&t, way % 2, way / 2);
        for (size_t at = 8; at < t.m.size; at += 4) {
            for (size_t v = 0; v < sizeof values / sizeof *values && is_added(&t, at); v++) {
                memcpy(t.k.bytes, t.m.bytes, t.m.size);
                saved_put32(t.k.bytes + at, values[v]);
                saved_repair(t.k.bytes, t.m.size);
                (void)attempt(v % 2 ? set_load : set_map, &t.k, t.m.size, SL_LOAD_CHECKED, t.A);
            }
        }
        target_free(&t);
    }
}

/* Replaces every 64-bit word of what version 2 adds by numbers at the ends of their range. */
static void every_extreme_word_is_noticed_or_harmless(void **state) {
    (void)state;
    for (int way = 0; way < 4; way++) {
        target_t t;
        target_make(&t, way % 2, way / 2);
        for (size_t at = 8; at < t.m.size; at += 8) {
            for (int v = 0; v < SAVED_EXTREMES && is_added(&t, at); v++) {
                memcpy(t.k.bytes, t.m.bytes, t.m.size);
                saved_put64(t.k.bytes + at, saved_extreme(v, 25));
                saved_repair(t.k.bytes, t.m.size);
                (void)attempt(v % 2 ? set_load : set_map, &t.k, t.m.size, SL_LOAD_CHECKED, t.A);
            }
        }
        target_free(&t);
    }
}

/* ---- single lies ---- */

/* Where the lower half of an integer of a section begins. */
static size_t lower_half(uint32_t id) {
    const uint16_t one = 1;
    const int is_little = *(const unsigned char *)&one == 1;
    return is_little || id == 98 || id == 99 || id == 105 ? 0 : 4;
}

/* A file is refused after the lower 32 bits of an integer at `at` of a section are replaced;
 * accepted as it was. */
static void refuse(const target_t *t, uint32_t id, size_t at, uint32_t value) {
    uint64_t bytes = 0;
    memcpy(t->k.bytes, t->m.bytes, t->m.size);
    at += lower_half(id);
    unsigned char *word = saved_section(t->k.bytes, id, &bytes) + at;
    assert_true(at + 4 <= bytes && saved_u32(word) != value);
    saved_put32(word, value);
    saved_repair(t->k.bytes, t->m.size);
    assert_int_equal(attempt(set_load, &t->k, t->m.size, SL_LOAD_CHECKED, t->A), SL_ERR_IO);
    assert_int_equal(attempt(set_map, &t->k, t->m.size, SL_LOAD_CHECKED, t->A), SL_ERR_IO);
}

static void lists_must_be_those_of_regions(void **state) {
    (void)state;
    target_t t;
    target_make(&t, 0, 1);
    const sl_region_arrays r = sl_region_view(t.q.regions[0]);
    const sl_symbolic_arrays v = sl_symbolic_view(r.symbolic);
    assert_true(r.n_roots > 0 && r.n_boundary > 1);
    assert_int_equal(attempt(set_load, &t.m, t.m.size, SL_LOAD_VERIFIED, t.A), SL_OK);
    refuse(&t, 96, 0, 0);                        /* no regions */
    refuse(&t, 96, 0, SETS_REGIONS + 1);         /* more than there are records */
    refuse(&t, 97, 0, (uint32_t)r.n_roots + 17); /* more roots than are listed */
    refuse(&t, 97, 8, (uint32_t)r.n_boundary + 1);
    refuse(&t, 97, 16, 2);
    refuse(&t, 98, 0, (uint32_t)v.n_supers);
    refuse(&t, 98, 0, UINT32_MAX);
    refuse(&t, 99, 0, UINT32_MAX);
    refuse(&t, 99, 0, (uint32_t)v.iperm[r.boundary[1]]);    /* a row twice */
    refuse(&t, 99, 0, (uint32_t)v.super_first[r.roots[0]]); /* a row of a subtree */
    int tried = 0; /* other roots, whose rows below are not in the boundary */
    for (sl_int s = 0; s < v.n_supers && r.n_roots == 1; s++) {
        int missing = 0;
        for (sl_off k = v.rows_begin[s]; k < v.rows_begin[s + 1]; k++) {
            int found = 0;
            for (sl_int i = 0; i < r.n_boundary; i++) {
                found |= v.iperm[r.boundary[i]] == v.rows[k];
            }
            missing |= !found;
        }
        if (missing) {
            refuse(&t, 98, 0, (uint32_t)s);
            tried++;
        }
    }
    assert_true(tried > 3);
    target_free(&t);
}

static void lists_must_be_those_of_a_selected_inverse(void **state) {
    (void)state;
    target_t t;
    target_make(&t, 0, 1);
    const sl_selected_arrays z = sl_selected_view(t.q.set.selected);
    const sl_symbolic_arrays v = sl_symbolic_view(z.symbolic);
    assert_true(z.count > 2 && z.count < v.n_supers);
    refuse(&t, 104, 0, (uint32_t)z.count - 1);
    refuse(&t, 104, 0, (uint32_t)v.n_supers + 1);
    refuse(&t, 105, 0, UINT32_MAX);
    refuse(&t, 105, 0, (uint32_t)z.supers[1]);                        /* twice */
    refuse(&t, 105, 4 * (size_t)(z.count - 1), (uint32_t)v.n_supers); /* out of range */
    refuse(&t, 105, 4 * (size_t)(z.count - 1), (uint32_t)z.supers[z.count - 1] - 1); /* no root */
    refuse(&t, 106, 0, 8);
    refuse(&t, 106, 8, (uint32_t)z.begin[1] + 8);
    refuse(&t, 106, 8 * (size_t)z.count, (uint32_t)z.begin[z.count] + 8);
    target_free(&t);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_truncation_is_refused),
        cmocka_unit_test(every_flipped_bit_is_noticed_or_harmless),
        cmocka_unit_test(every_replaced_word_is_noticed_or_harmless),
        cmocka_unit_test(every_extreme_word_is_noticed_or_harmless),
        cmocka_unit_test(lists_must_be_those_of_regions),
        cmocka_unit_test(lists_must_be_those_of_a_selected_inverse),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

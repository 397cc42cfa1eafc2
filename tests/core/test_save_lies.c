/* test_save_lies.c: files that say one wrong thing and have the checksums of it are refused */
#include "tests/lib/saved_format.h"
#include "tests/lib/saved_set.h"

/* test_save_damage.c and test_saved_set_damage.c damage anything. Here a file is changed in several
 * places that agree with each other, so that one condition alone refuses it. */

enum { PARENT = 18, SUPER_PARENT = 22, ROWS = 24, STEPS = 26, FIRST_DESCENDANT = 27, PAIRS = 28 };
enum { NODE_OF = 33, NODE_PARENT, NODE_LEVEL };
enum { D = 64, SHIFTS = 69, NULLS = 71, ANCHORS = 75 };
enum { STEP_BYTES = 32, STEP_UP = 28 };

/* The array of a section. */
static void *array(const saved_t *m, uint32_t id) {
    uint64_t bytes = 0;
    unsigned char *data = saved_section(m->bytes, id, &bytes);
    assert_non_null(data);
    assert_true(bytes > 0);
    return data;
}

static saved_t copy_of(const saved_t *m) {
    saved_t k = saved_of_size(m->size);
    memcpy(k.bytes, m->bytes, m->size);
    return k;
}

static sl_status status_of(const saved_t *m, int is_mapped) {
    sl_saved_set set = {0};
    const sl_status status = is_mapped
                                 ? sl_load(&set, NULL, m->bytes, m->size, SL_LOAD_MAPPED, NULL)
                                 : sl_load(&set, NULL, m->bytes, m->size, SL_LOAD_CHECKED, NULL);
    assert_true((set.symbolic != NULL) == (status == SL_OK));
    sl_saved_set_free(&set);
    return status;
}

static void assert_status(sl_status expected, const saved_t *m) {
    assert_int_equal(status_of(m, 0), expected);
    assert_int_equal(status_of(m, 1), expected);
}

/* Completes a lie, which is refused, and frees it. */
static void refuse(saved_t *k) {
    saved_repair(k->bytes, k->size);
    assert_status(SL_ERR_IO, k);
    saved_free(k);
}

/* Supernodes of their own, so that there are many. */
static saved_case_t case_of(int way, gen_kind_t kind, sl_int size) {
    sl_options opt = options_none();
    opt.relaxation = SL_RELAXATION_NONE;
    return saved_case_make(way, kind, size, 0, &opt);
}

static void subtrees_must_be_those_of_the_tree(void **state) {
    (void)state;
    saved_case_t c = case_of(SAVED_DEFINITE, GEN_GRID2, 25);
    const sl_symbolic_arrays v = sl_symbolic_view(c.y.S);
    saved_t m = saved_make(c.y.S, c.y.F), k = copy_of(&m);
    assert_status(SL_OK, &m);
    sl_int *first = (sl_int *)array(&k, FIRST_DESCENDANT), s = 1;
    while (s < v.n_supers && !(first[s] < first[s - 1] && first[s - 1] < s - 1)) {
        s++;
    }
    assert_true(s < v.n_supers);
    first[s] = first[s - 1] + 1; /* its last child has one descendant more than that */
    refuse(&k);
    /* the first leaf as a tree of its own, in all that is said of trees */
    k = copy_of(&m);
    first = (sl_int *)array(&k, FIRST_DESCENDANT);
    for (s = ((sl_int *)array(&k, SUPER_PARENT))[0]; s != -1; s = v.super_parent[s]) {
        assert_int_equal(first[s], 0);
        first[s] = 1;
    }
    const sl_int none = -1;
    memcpy(array(&k, SUPER_PARENT), &none, sizeof none);
    memcpy((unsigned char *)array(&k, STEPS) + STEP_UP, &none, sizeof none);
    refuse(&k);
    saved_free(&m);
    saved_case_free(&c);
}

/* The first row below a supernode is a column of its parent. */
static void rows_must_begin_in_the_parent(void **state) {
    (void)state;
    saved_case_t c = case_of(SAVED_DEFINITE, GEN_GRID2, 25);
    const sl_symbolic_arrays v = sl_symbolic_view(c.y.S);
    saved_t m = saved_make(c.y.S, c.y.F);
    int tried = 0;
    for (sl_int s = 0; s < v.n_supers; s++) {
        const sl_off at = v.rows_begin[s];
        const sl_int up = v.super_parent[s];
        const sl_int end = up == -1 ? 0 : v.rows_begin[s + 1] - at > 1 ? v.rows[at + 1] : v.n;
        if (up != -1 && v.super_first[up + 1] < end) {
            saved_t k = copy_of(&m);
            ((sl_int *)array(&k, ROWS))[at] = end - 1;
            refuse(&k);
            tried++;
        }
    }
    assert_true(tried > 0);
    saved_free(&m);
    saved_case_free(&c);
}

static void pairs_must_be_in_a_tile_of_a_supernodal_factor(void **state) {
    (void)state;
    saved_case_t c = saved_case_make(SAVED_PIVOTED, GEN_DENSE, 21, 0, NULL);
    saved_t m = saved_make(c.y.S, c.y.F), k = copy_of(&m);
    unsigned char *pairs = (unsigned char *)array(&k, PAIRS);
    assert_status(SL_OK, &m);
    assert_int_equal(sl_symbolic_view(c.y.S).n_supers, 1);
    pairs[6] = pairs[6] == 1 ? 0 : pairs[6];
    pairs[7] = 1; /* the last column of a tile */
    pairs[8] = 2;
    refuse(&k);
    k = copy_of(&m);
    saved_put64((unsigned char *)array(&k, 2), SL_METHOD_UP_LOOKING);
    refuse(&k);
    saved_free(&m);
    saved_case_free(&c);
}

/* The separator tree: a row of no node, a separator that is not above its parts, another level. */
static void separators_must_be_a_tree(void **state) {
    (void)state;
    saved_case_t c = saved_case_make(SAVED_DEFINITE, GEN_GRID2, 900, 0, NULL);
    saved_t m = saved_make(c.y.S, c.y.F);
    const sl_int nodes = sl_symbolic_view(c.y.S).n_nodes;
    assert_true(nodes > 2);
    assert_status(SL_OK, &m);
    const struct {
        uint32_t id;
        sl_int at, value;
    } lies[] = {{NODE_OF, 5, -1},          {NODE_OF, 5, nodes},  {NODE_PARENT, 0, 0},
                {NODE_PARENT, 0, nodes},   {NODE_PARENT, 0, -1}, {NODE_LEVEL, 0, 0},
                {NODE_LEVEL, nodes - 1, 1}};
    for (size_t k = 0; k < sizeof lies / sizeof *lies; k++) {
        saved_t lie = copy_of(&m);
        sl_int *word = (sl_int *)array(&lie, lies[k].id) + lies[k].at;
        assert_int_not_equal(*word, lies[k].value);
        *word = lies[k].value;
        refuse(&lie);
    }
    saved_free(&m);
    saved_case_free(&c);
}

/* Each count alone is in its range. */
static void sizes_must_not_overflow(void **state) {
    (void)state;
    saved_case_t c = case_of(SAVED_DEFINITE, GEN_GRID2, 25);
    saved_t m = saved_make(c.y.S, c.y.F), k = copy_of(&m);
    uint64_t *numbers = (uint64_t *)array(&k, 1);
    numbers[4] = numbers[6] = UINT64_C(1) << 58; /* rows, panels */
    refuse(&k);
    saved_free(&m);
    saved_case_free(&c);
}

static void a_tree_must_have_one_anchor(void **state) {
    (void)state;
    saved_case_t c = case_of(SAVED_WEIGHTED, GEN_COMPONENTS, 30);
    saved_t m = saved_make(c.y.S, c.y.F), k = copy_of(&m);
    const sl_int *parent = (const sl_int *)array(&k, PARENT);
    sl_int *anchors = (sl_int *)array(&k, ANCHORS), root, tree = 0;
    assert_status(SL_OK, &m);
    do {                          /* a tree whose anchor is not its first column */
        assert_true(++tree < 10); /* trees */
        for (root = anchors[tree] - 1; parent[root] != -1; root--) {
            assert_true(root > anchors[tree - 1]);
        }
    } while (root + 1 == anchors[tree]);
    anchors[tree - 1] = root + 1; /* in the tree of the next one */
    refuse(&k);
    saved_free(&m);
    saved_case_free(&c);
}

static void null_pivots_must_be_those_that_are_listed(void **state) {
    (void)state;
    saved_case_t c = case_of(SAVED_SKIPPED, GEN_GRID2, 25);
    saved_t m = saved_make(c.y.S, c.y.F), k = copy_of(&m);
    const sl_int null = *(sl_int *)array(&k, NULLS);
    double *d = (double *)array(&k, D);
    assert_status(SL_OK, &m);
    assert_true(null > 1 && d[null] == DBL_MAX);
    d[null] = 1.0; /* one less */
    refuse(&k);
    k = copy_of(&m);
    ((double *)array(&k, D))[null - 1] = DBL_MAX; /* one more, which is listed instead */
    *(sl_int *)array(&k, NULLS) = null - 1;
    refuse(&k);
    saved_free(&m);
    saved_case_free(&c);
}

/* A pivot that is listed as changed but was not. */
static void changed_pivots_must_be_changed(void **state) {
    (void)state;
    saved_case_t c = saved_case_make(SAVED_SIGNED, GEN_GRID2, 25, 0, NULL);
    saved_t m = saved_make(c.y.S, c.y.F), k = copy_of(&m);
    double *shifts = (double *)array(&k, SHIFTS);
    sl_int at = 24;
    assert_status(SL_OK, &m);
    while (at >= 0 && shifts[at] == 0.0) { /* the last one */
        at--;
    }
    assert_true(at >= 0);
    shifts[at] = 0.0;
    refuse(&k);
    saved_free(&m);
    saved_case_free(&c);
}

/* ---- regions and selected inverses ---- */

/* The file `base`, followed by the sections of another file with ids from `first` to `last`. */
static saved_t joined(const saved_t *base, const saved_t *from, uint32_t first, uint32_t last) {
    const uint32_t sections = saved_u32(base->bytes + SAVED_SECTIONS);
    const size_t old_prefix = (size_t)saved_round(SAVED_HEADER + SAVED_ENTRY * (uint64_t)sections);
    uint32_t count = sections;
    saved_t k = saved_of_size(base->size + from->size);
    for (uint32_t s = 0; s < saved_u32(from->bytes + SAVED_SECTIONS); s++) {
        const unsigned char *entry = saved_entry(from->bytes, s);
        if (saved_u32(entry + SAVED_ID) >= first && saved_u32(entry + SAVED_ID) <= last) {
            memcpy(saved_entry(k.bytes, count++), entry, SAVED_ENTRY);
        }
    }
    const size_t prefix = (size_t)saved_round(SAVED_HEADER + SAVED_ENTRY * (uint64_t)count);
    size_t at = base->size + prefix - old_prefix;
    memcpy(k.bytes, base->bytes, SAVED_HEADER + SAVED_ENTRY * (size_t)sections);
    memcpy(k.bytes + prefix, base->bytes + old_prefix, base->size - old_prefix);
    for (uint32_t s = 0; s < count; s++) {
        unsigned char *entry = saved_entry(k.bytes, s);
        const uint64_t offset = saved_u64(entry + SAVED_OFFSET),
                       bytes = saved_round(saved_u64(entry + SAVED_LENGTH));
        saved_put64(entry + SAVED_OFFSET, s < sections ? offset + prefix - old_prefix : at);
        if (s >= sections) {
            memcpy(k.bytes + at, from->bytes + offset, (size_t)bytes);
            at += (size_t)bytes;
        }
    }
    k.size = at;
    saved_put32(k.bytes + SAVED_WRITE, 2);
    saved_put32(k.bytes + SAVED_SECTIONS, count);
    saved_put64(k.bytes + SAVED_BYTES, k.size);
    saved_repair(k.bytes, k.size);
    return k;
}

/* Regions and selected inverses are refused after objects that have none, and only there. */
static void objects_must_be_able_to_have_them(void **state) {
    (void)state;
    set_case_t q = set_case_make(SAVED_DEFINITE, GEN_GRID2, 25, 0, 0, NULL);
    saved_case_t centered = saved_case_make(SAVED_WEIGHTED, GEN_GRID2, 25, 0, NULL),
                 pivoted = saved_case_make(SAVED_PIVOTED, GEN_GRID2, 25, 0, NULL);
    saved_t set = set_save(set_of(&q)), alone = saved_make(q.c.y.S, q.c.y.F);
    saved_t analysis = saved_make(q.c.y.S, NULL);
    saved_t weights = saved_make(centered.y.S, centered.y.F);
    saved_t pairs = saved_make(pivoted.y.S, pivoted.y.F);
    assert_true(sl_symbolic_view(pivoted.y.S).pairs != NULL);
    struct {
        const saved_t *base;
        uint32_t first, last;
        sl_status status;
    } tries[] = {
        {&alone, 96, 107, SL_OK},        {&alone, 96, 100, SL_OK},
        {&alone, 104, 107, SL_OK},       {&analysis, 104, 107, SL_OK},
        {&analysis, 96, 100, SL_ERR_IO}, {&weights, 96, 100, SL_ERR_IO},
        {&pairs, 96, 100, SL_ERR_IO},    {&pairs, 104, 107, SL_ERR_IO},
    };
    for (size_t t = 0; t < sizeof tries / sizeof *tries; t++) {
        saved_t k = joined(tries[t].base, &set, tries[t].first, tries[t].last);
        assert_status(tries[t].status, &k);
        if (t == 0) {
            assert_int_equal(k.size, set.size);
            assert_memory_equal(k.bytes, set.bytes, set.size);
        }
        saved_free(&k);
    }
    saved_free(&set);
    saved_free(&alone);
    saved_free(&analysis);
    saved_free(&weights);
    saved_free(&pairs);
    saved_case_free(&centered);
    saved_case_free(&pivoted);
    set_case_free(&q);
}

/* A selected inverse whose list does not end in a root, and one with half a number. */
static void a_selected_inverse_must_end_in_a_root(void **state) {
    (void)state;
    saved_case_t c = case_of(SAVED_DEFINITE, GEN_GRID2, 100);
    const sl_symbolic_arrays v = sl_symbolic_view(c.y.S);
    sl_saved_set set = {0};
    set.symbolic = c.y.S;
    set.factor = c.y.F;
    SL_CHECK(sl_selected_create(&set.selected, c.y.F, v.perm, 1, NULL, NULL));
    const sl_selected_arrays z = sl_selected_view(set.selected);
    const sl_int last = v.n_supers - 1;
    assert_true(z.count > 1 && z.supers[z.count - 1] == last && z.supers[z.count - 2] < last - 1);
    saved_t m = set_save(&set), k = copy_of(&m);
    assert_status(SL_OK, &m);
    ((sl_int *)array(&k, SAVED_SELECTED + 1))[z.count - 1] = last - 1;
    refuse(&k);
    k = copy_of(&m);
    unsigned char *length =
        saved_entry(k.bytes, saved_u32(k.bytes + SAVED_SECTIONS) - 1) + SAVED_LENGTH;
    saved_put64(length, saved_u64(length) - 4);
    refuse(&k);
    saved_free(&m);
    sl_selected_free(set.selected);
    saved_case_free(&c);
}

/* What a later version of the library wrote can be used but not changed. */
static void sets_of_later_versions_are_read_only(void **state) {
    (void)state;
    set_case_t q = set_case_make(SAVED_DEFINITE, GEN_GRID2, 100, 0, 0, NULL);
    saved_t m = set_save(set_of(&q));
    sl_saved_set set = {0};
    saved_put32(m.bytes + SAVED_WRITE, SAVED_LATER);
    saved_repair(m.bytes, m.size);
    SL_CHECK(sl_load(&set, NULL, m.bytes, m.size, SL_LOAD_VERIFIED, NULL));
    assert_same_set(&q.set, &set);
    SL_EXPECT(SL_ERR_READ_ONLY, sl_selected_refactor(set.selected, set.factor, NULL));
    SL_EXPECT(SL_ERR_READ_ONLY, sl_region_refactor(set.regions[0], set.factor, NULL, NULL));
    sl_saved_set_free(&set);
    saved_free(&m);
    set_case_free(&q);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(subtrees_must_be_those_of_the_tree),
        cmocka_unit_test(rows_must_begin_in_the_parent),
        cmocka_unit_test(pairs_must_be_in_a_tile_of_a_supernodal_factor),
        cmocka_unit_test(separators_must_be_a_tree),
        cmocka_unit_test(sizes_must_not_overflow),
        cmocka_unit_test(a_tree_must_have_one_anchor),
        cmocka_unit_test(null_pivots_must_be_those_that_are_listed),
        cmocka_unit_test(changed_pivots_must_be_changed),
        cmocka_unit_test(objects_must_be_able_to_have_them),
        cmocka_unit_test(a_selected_inverse_must_end_in_a_root),
        cmocka_unit_test(sets_of_later_versions_are_read_only),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

/* test_order_hashes.c: every platform and compiler finds the same order and the same supernodes */
#include "tests/lib/order_patterns.h"

/* ---- a hash without regard to the order of bytes: FNV-1a over 8 bytes a number, low first ---- */

static uint64_t hash_number(uint64_t h, int64_t number) {
    for (int shift = 0; shift < 64; shift += 8) {
        h = (h ^ (((uint64_t)number >> shift & 255u))) * 0x100000001b3u;
    }
    return h;
}

static uint64_t hash_of(const sl_csc *A, const sl_options *opt) {
    uint64_t h = 0xcbf29ce484222325u;
    sl_symbolic *S = NULL;
    SL_CHECK(sl_symbolic_create(&S, A, opt, NULL));
    const sl_symbolic_arrays v = sl_symbolic_view(S);
    for (sl_int k = 0; k < v.n; k++) {
        h = hash_number(h, v.perm[k]);
    }
    for (sl_int s = 0; s <= v.n_supers; s++) {
        h = hash_number(hash_number(h, v.super_first[s]), v.panel_begin[s]);
    }
    sl_symbolic_free(S);
    return h;
}

/* ---- the hashes, found on x86-64 ---- */

/* Prints both, so that a deliberate change of the order can be taken over here. */
static int differs(const char *what, int kind, uint64_t found, uint64_t expected) {
    if (found == expected) {
        return 0;
    }
    print_error("%s %d: 0x%08lx%08lx, expected 0x%08lx%08lx\n", what, kind,
                (unsigned long)(found >> 32), (unsigned long)(found & 0xffffffffu),
                (unsigned long)(expected >> 32), (unsigned long)(expected & 0xffffffffu));
    return 1;
}

static void patterns_have_one_order(void **state) {
    (void)state;
    static const uint64_t expected[ORDER_KINDS] = {
        0xbe83de22f7a63927u, 0xc1b1f4d265fdab6eu, 0x915e32c108ebf82fu, 0x0cfe3a9fd8947d53u,
        0x4c85b3d7f50377e2u, 0x68b423cdef7047ddu, 0x614797e153fdd6a7u, 0xbb0528b341735586u,
        0xc4c40ac0e2af41e1u, 0xad2de8c7aef859dbu, 0x32f3c34d2e8bafb5u, 0xb34750e774348122u};
    int wrong = 0;
    for (int kind = 0; kind < ORDER_KINDS; kind++) {
        gen_list_t t = pattern(kind);
        gen_matrix_t M = gen_store(&t, gen_style(0), 1);
        wrong += differs("pattern", kind, hash_of(&M.view, NULL), expected[kind]);
        gen_matrix_free(&M);
        gen_list_free(&t);
    }
    assert_int_equal(wrong, 0);
}

/* Merging of supernodes, without an ordering that decides before. */
static void supernodes_merge_alike(void **state) {
    (void)state;
    static const uint64_t expected[ORDER_KINDS] = {
        0xae75f227239bfd47u, 0x98320e799c7a8fbau, 0x50364d666f2b6653u, 0xf513c2d215e99609u,
        0x70f50bee38c1015bu, 0xaad9ad7b2565d7f1u, 0x47d3e18ba729aa7du, 0xafe81187501aa080u,
        0x9b5f8d43cd61984du, 0x89b7bf654cfc724bu, 0x724ff3414badf6d5u, 0x6cdf58c04a3571c1u};
    int wrong = 0;
    for (int kind = 0; kind < ORDER_KINDS; kind++) {
        sl_options opt = options_none();
        gen_list_t t = pattern(kind);
        gen_matrix_t M = gen_store(&t, gen_style(0), 1);
        sl_int *perm = test_ints((size_t)t.n);
        gen_permutation(perm, t.n, 8);
        opt.ordering = kind == ORDER_GRID ? SL_ORDERING_NATURAL : SL_ORDERING_GIVEN;
        opt.perm = kind == ORDER_GRID ? NULL : perm;
        wrong += differs("given order", kind, hash_of(&M.view, &opt), expected[kind]);
        free(perm);
        gen_matrix_free(&M);
        gen_list_free(&t);
    }
    assert_int_equal(wrong, 0);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(patterns_have_one_order),
        cmocka_unit_test(supernodes_merge_alike),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

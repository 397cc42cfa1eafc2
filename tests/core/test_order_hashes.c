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
        0x4035d4567a22f408u, 0xcc109cf9fb3ca7eeu, 0x685748ab606c2388u, 0x0cfe3a9fd8947d53u,
        0x4c85b3d7f50377e2u, 0x87aa46376ac22c36u, 0x614797e153fdd6a7u, 0xbb0528b341735586u,
        0xc4c40ac0e2af41e1u, 0xe7c6abf44e7c61edu, 0xe82aec00002b29f7u, 0xb34750e774348122u,
        0xbe7dfcc44a75160eu};
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
        0x36b11a895d45e647u, 0x8e4c1fc09de9778bu, 0xaeb9db1896d2cb15u, 0xc482cb0fa06db42fu,
        0x70f50bee38c1015bu, 0x3c3fd7ef3a302431u, 0x47d3e18ba729aa7du, 0xa30368e394f2698du,
        0x7505d325720be2cfu, 0x6d3478c9736f7064u, 0x4968518d1eb52765u, 0xf9e5b6879196299du,
        0xe015872e41ed043bu};
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

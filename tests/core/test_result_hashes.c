/* test_result_hashes.c: every platform and compiler finds the same bits by each instruction set */
#include "tests/lib/order_patterns.h"

/* ---- a hash of bits: FNV-1a over 8 bytes a number, low first ---- */

static uint64_t hash_numbers(uint64_t h, const double *x, size_t count) {
    for (size_t k = 0; k < count; k++) {
        uint64_t bits;
        memcpy(&bits, &x[k], sizeof bits);
        for (int shift = 0; shift < 64; shift += 8) {
            h = (h ^ (bits >> shift & 255u)) * 0x100000001b3u;
        }
    }
    return h;
}

/* ---- a matrix whose entries are whole numbers: no rounding before the library's ---- */

static gen_matrix_t matrix_of(int kind) {
    gen_list_t t = pattern(kind);
    uint64_t state = 3;
    for (size_t k = 0; k < t.count; k++) {
        const int is_diagonal = t.row[k] == t.col[k];
        t.x[k] = is_diagonal ? 0.0 : -1.0 - (double)((3 * t.row[k] + 5 * t.col[k]) % 7);
    }
    gen_dominate(&t, 1, &state);
    const gen_matrix_t M = gen_store(&t, gen_style(0), 1);
    gen_list_free(&t);
    return M;
}

/* Does plain C round each product and each sum to double? Pivots and solutions of 2 x 2 matrices
 * show it: not where the compiler contracts a * b + c, nor with the excess precision of x87. */
static int rounds_each_operation(void) {
    int different = 0;
    for (int k = 1; k <= 50; k++) {
        const sl_int p[] = {0, 2, 3}, i[] = {0, 1, 1};
        const double x[] = {3.0, 1.0 / (double)k, 2.0}, b[] = {0.7, 1.1};
        const sl_csc A = {2, 2, p, i, x};
        double solution[2];
        sl_options opt = options_none();
        sl_symbolic *S = analyze_natural(&A, SL_RELAXATION_DEFAULT);
        sl_factor *F = NULL;
        opt.isa = SL_ISA_SCALAR;
        SL_CHECK(sl_factor_create(&F, S, &A, FOR_FACTOR(&opt), NULL));
        SL_CHECK(sl_factor_solve(F, solution, 2, b, 2, 1, NULL));
        const volatile double l = x[1] / x[0], lx = l * x[1], d = x[2] - lx;
        const volatile double lb = l * b[0], y = b[1] - lb, last = y / d;
        const volatile double first = b[0] / x[0], product = l * last, difference = first - product;
        different +=
            sl_factor_view(F).D[1] != d || solution[1] != last || solution[0] != difference;
        sl_factor_free(F);
        sl_symbolic_free(S);
    }
    return different == 0;
}

/* ---- what is computed ---- */

enum { SIDES = 11, ROWS = 20 };

/* The hash of pivots, full and local solves, entries of the inverse, and of a changed factor. */
static uint64_t hash_of(const sl_csc *A, sl_isa isa) {
    uint64_t h = 0xcbf29ce484222325u;
    const size_t n = (size_t)A->n_cols;
    sl_int rows[ROWS];
    double local[ROWS], delta = 0.5, *b = test_reals(n * SIDES), *x = test_reals(n * SIDES);
    sl_options opt = options_none();
    sl_symbolic *S = NULL;
    sl_factor *F = NULL;
    opt.isa = isa;
    for (size_t k = 0; k < n * SIDES; k++) {
        b[k] = (double)(k % 17 * (k % 17) % 17) - 8.0;
    }
    for (sl_int k = 0; k < ROWS; k++) {
        rows[k] = k * (A->n_cols / ROWS);
    }
    SL_CHECK(sl_symbolic_create(&S, A, NULL, NULL));
    SL_CHECK(sl_factor_create(&F, S, A, FOR_FACTOR(&opt), NULL));
    h = hash_numbers(h, sl_factor_view(F).D, n);
    SL_CHECK(sl_factor_solve(F, x, n, b, n, 1, NULL));
    h = hash_numbers(h, x, n);
    SL_CHECK(sl_factor_solve(F, x, n, b, n, SIDES, NULL));
    h = hash_numbers(h, x, n * SIDES);
    SL_CHECK(sl_local_solve(F, rows, ROWS, rows, ROWS, local, ROWS, b, ROWS, 1, NULL, NULL));
    h = hash_numbers(h, local, ROWS);
    SL_CHECK(sl_inverse_diagonal(F, local, rows, ROWS, NULL, NULL));
    h = hash_numbers(h, local, ROWS);
    SL_CHECK(sl_factor_change_entries(F, NULL, rows + 3, rows + 3, &delta, 1, NULL, NULL));
    h = hash_numbers(h, sl_factor_view(F).D, n);
    sl_factor_free(F);
    sl_symbolic_free(S);
    free(b);
    free(x);
    return h;
}

/* ---- the hashes, found on x86-64 ---- */

enum { KINDS = 5 };
static const int kinds[KINDS] = {ORDER_GRID, ORDER_STRIP, ORDER_RANDOM, ORDER_CLIQUES, ORDER_WIDE};

/* Compares; prints both, so that a deliberate change of the arithmetic can be taken over here. */
static void same_bits(sl_isa isa, const uint64_t *expected) {
    int wrong = 0;
    if (!isa_is_present(isa)) {
        print_message("skipped: this instruction set is not here\n");
        skip();
    }
    if (!rounds_each_operation()) { /* beside vectors there is plain C */
        print_message("skipped: the compiler contracts products and sums, or x87 is used\n");
        skip();
    }
    for (int k = 0; k < KINDS; k++) {
        gen_matrix_t M = matrix_of(kinds[k]);
        const uint64_t found = hash_of(&M.view, isa);
        if (found != expected[k]) {
            print_error("matrix %d, isa %d: 0x%08lx%08lxu, expected 0x%08lx%08lxu\n", k, (int)isa,
                        (unsigned long)(found >> 32), (unsigned long)(found & 0xffffffffu),
                        (unsigned long)(expected[k] >> 32),
                        (unsigned long)(expected[k] & 0xffffffffu));
            wrong++;
        }
        gen_matrix_free(&M);
    }
    assert_int_equal(wrong, 0);
}

static void plain_c_has_the_same_bits(void **state) {
    static const uint64_t expected[KINDS] = {0x9b9775db337d11d4u, 0xd0347f8ab645293au,
                                             0x9b98e7a1823ee6c8u, 0xa812157bd89717acu,
                                             0xac37e37bee2cc165u};
    (void)state;
    same_bits(SL_ISA_SCALAR, expected);
}

static void avx2_has_the_same_bits(void **state) {
    static const uint64_t expected[KINDS] = {0x3c560f34ba7d1cc7u, 0x38ca3a34ff29fe14u,
                                             0x3f3c2215c343e502u, 0xc7bd93db274c4f2au,
                                             0x84a658975c3361e1u};
    (void)state;
    same_bits(SL_ISA_AVX2, expected);
}

static void avx512_has_the_same_bits(void **state) {
    static const uint64_t expected[KINDS] = {0x8f27dd1c6a79bf5fu, 0x38ca3a34ff29fe14u,
                                             0x0d022bddcbb8e74eu, 0x064a203d3edc7521u,
                                             0xac7b1562446892cau};
    (void)state;
    same_bits(SL_ISA_AVX512, expected);
}

static void neon_has_the_same_bits(void **state) {
    static const uint64_t expected[KINDS] = {0xc161728a5891b5eeu, 0x064ef5fd854ba28au,
                                             0x8a74e0dddc83a9ceu, 0x48d76d4b8166596du,
                                             0x3d7a9f0a1cf5215fu};
    (void)state;
    same_bits(SL_ISA_NEON, expected);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(plain_c_has_the_same_bits),
        cmocka_unit_test(avx2_has_the_same_bits),
        cmocka_unit_test(avx512_has_the_same_bits),
        cmocka_unit_test(neon_has_the_same_bits),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

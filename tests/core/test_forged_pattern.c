/* test_forged_pattern.c: rows out of range are refused, even with the right hash of the pattern */
#include "tests/lib/no_kernels.h"
#define SPARSE_LOCAL_IMPLEMENTATION
#define SL_STATIC
#include "sparse_local.h"

#include "tests/lib/test.h"

enum { N = 60, NNZ = 2 * N - 1, STRIPE = 64 };

/* Two constants of the hash. If they change there, the forgery below fails and the test with it. */
static const uint64_t first = 0xa0761d6478bd642fu, second = 0xe7037ed1a0b428dbu;

/* Replaces rows of a pattern by others, so that the hash stays: the first word makes the state of a
 * chain 0, and the last word sets it to what it was. */
static void forge(const sl_csc *A, sl_int *i) {
    const uint64_t blind = first, one = first ^ 1;
    sli_hash h;
    h.a = (uint64_t)A->n_rows;
    h.b = (uint64_t)A->n_cols;
    h = sli_hash_ints(h, A->p, (sl_off)A->n_cols + 1);
    uint64_t chain[4] = {h.a ^ second, 0, 0, 0};
    (void)sli_hash_stripe(chain, (const unsigned char *)A->i, SLI_HASH_INTS, 0);
    (void)sli_hash_stripe(chain, (const unsigned char *)A->i + STRIPE, SLI_HASH_INTS, 0);
    memcpy(i, A->i, NNZ * sizeof *i);
    memcpy(i, &blind, sizeof blind);
    i[2] = 100000000; /* far out of range, and without influence on the hash */
    memcpy(i + STRIPE / sizeof *i, &one, sizeof one);
    memcpy(i + STRIPE / sizeof *i + 2, &chain[0], sizeof chain[0]);
}

static void a_forged_pattern_is_refused(void **state) {
    (void)state;
    sl_int p[N + 1], i[NNZ], bad[NNZ], column = 0, t = 0;
    double x[NNZ], b[N], y[N], rcond;
    for (sl_int j = 0; j < N; j++) {
        p[j] = t;
        b[j] = 1;
        for (sl_int k = 0; k < 2 && j + k < N; k++) {
            i[t] = j + k;
            x[t++] = k == 0 ? 3 : -1;
        }
    }
    p[N] = t;
    sl_csc A = {N, N, p, i, x}, B = {N, N, p, bad, x};
    sl_symbolic *S = NULL;
    sl_factor *F = NULL, *G = NULL;
    sl_stats stats;
    sli_hash hash, forged;
    SL_CHECK(sl_symbolic_create(&S, &A, NULL, NULL));
    SL_CHECK(sl_factor_create(&F, S, &A, NULL, NULL));
    SL_CHECK(sl_factor_solve(F, y, N, b, N, 1, NULL));
    forge(&A, bad);
    assert_true(sli_pattern_hash(&A, &hash));
    assert_false(sli_pattern_hash(&B, &forged));
    assert_true(sli_hash_equals(hash, forged)); /* it is a forgery */
    SL_EXPECT(SL_ERR_MALFORMED, sl_factor_create(&G, S, &B, NULL, &stats));
    SL_EXPECT(SL_ERR_MALFORMED, sl_factor_refactor(F, &B, &stats));
    SL_EXPECT(SL_ERR_MALFORMED,
              sl_factor_change_entries(F, &B, NULL, &column, NULL, 1, NULL, &stats));
    SL_EXPECT(SL_ERR_MALFORMED, sl_factor_refine(F, &B, y, N, b, N, 1, 2, NULL, &stats));
    SL_EXPECT(SL_ERR_MALFORMED, sl_factor_rcond(F, &B, &rcond, NULL));
    SL_CHECK(sl_factor_solve(F, y, N, b, N, 1, NULL));
    sl_factor_free(F);
    sl_symbolic_free(S);
}

/* One index out of range at every position, and every limit of the range. */
static void indices_out_of_range_are_found_anywhere(void **state) {
    (void)state;
    static const sl_int limits[] = {1, 2, 7, 1 << 30, INT32_MAX - 7};
    sl_int i[50];
    sli_hash h = {0, 0};
    for (size_t which = 0; which < sizeof limits / sizeof limits[0]; which++) {
        const sl_int n = limits[which];
        const sl_int bad[5] = {n, -1, INT32_MIN, INT32_MAX, n < INT32_MAX ? n + 1 : n};
        for (sl_int k = 0; k < 50; k++) {
            i[k] = k % 2 ? n - 1 : 0;
        }
        for (sl_int count = 0; count <= 50; count++) {
            assert_true(sli_hash_indices(&h, i, count, n));
        }
        for (int k = 0; k < 50; k++) {
            for (int m = 0; m < 5; m++) {
                const sl_int kept = i[k];
                i[k] = bad[m];
                assert_false(sli_hash_indices(&h, i, 50, n));
                i[k] = kept;
            }
        }
    }
    assert_true(sli_hash_indices(&h, i, 0, 0));
}

/* Positions that descend, are negative, or do not begin at 0. */
static void positions_that_do_not_ascend(void **state) {
    (void)state;
    const sl_int i[4] = {0, 1, 2, 3};
    const sl_int wrong[][5] = {{1, 1, 2, 3, 4},  {-4, 1, 2, 3, 4},        {0, 2, 1, 3, 4},
                               {0, 1, -2, 3, 4}, {0, 1, INT32_MIN, 3, 4}, {0, INT32_MAX, 2, 3, 4},
                               {0, 5, 5, 5, 4}};
    const sl_int right[5] = {0, 1, 2, 3, 4};
    sli_hash h;
    sl_csc A = {4, 4, right, i, NULL};
    assert_true(sli_pattern_hash(&A, &h));
    for (size_t k = 0; k < sizeof wrong / sizeof wrong[0]; k++) {
        A.p = wrong[k];
        assert_false(sli_pattern_hash(&A, &h));
    }
}

/* Any single change of an array changes the hash, and so does its length. */
static void every_change_changes_the_hash(void **state) {
    (void)state;
    double a[40] = {0};
    const sli_hash seed = {1, 2};
    for (int count = 0; count < 40; count++) {
        const sli_hash h = sli_hash_words(seed, a, count);
        assert_false(sli_hash_equals(h, sli_hash_words(seed, a, count + 1)));
        for (int k = 0; k < count; k++) {
            a[k] = -0.0;
            assert_false(sli_hash_equals(h, sli_hash_words(seed, a, count)));
            a[k] = 1.0;
            const sli_hash one = sli_hash_words(seed, a, count);
            assert_false(sli_hash_equals(h, one));
            for (int m = 0; m < k; m++) { /* and so does its place */
                a[k] = 0.0;
                a[m] = 1.0;
                assert_false(sli_hash_equals(one, sli_hash_words(seed, a, count)));
                a[m] = 0.0;
            }
            a[k] = 0.0;
        }
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_forged_pattern_is_refused),
        cmocka_unit_test(indices_out_of_range_are_found_anywhere),
        cmocka_unit_test(positions_that_do_not_ascend),
        cmocka_unit_test(every_change_changes_the_hash),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

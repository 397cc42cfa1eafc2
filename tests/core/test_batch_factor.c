/* test_batch_factor.c: sl_factor_create_sums and sl_factor_refactor_sums: bits, threads, errors,
 * memory */
#include "tests/lib/factor_array.h"
#include "tests/lib/saved_pair.h"

static void assert_factors(const matrix_pair_t *y, sl_factor *const *F, const double *c, int count,
                           sl_options opt) {
    opt.threads.count = 0;
    for (int k = 0; k < count; k++) {
        sl_factor *single = NULL;
        SL_CHECK(sl_factor_create_sums(&single, 1, y->S, c + TERMS * k, matrix_pair_values(y),
                                       TERMS, &opt, NULL, NULL));
        assert_same_bits(F[k], single);
        sl_factor_free(single);
    }
}

static void a_batch_gives_the_bits_of_single_factors(void **state) {
    (void)state;
    static const gen_kind_t kinds[5] = {GEN_GRID2, GEN_KKT, GEN_COMPONENTS, GEN_ONE, GEN_NONE};
    variant_list_t variants = variants_present();
    double c[TERMS * MOST], other[TERMS * MOST];
    coefficients_of(c, MOST, 0.01);
    coefficients_of(other, MOST, 3);
    for (int kind = 0; kind < 5; kind++) {
        matrix_pair_t y = matrix_pair_make(kinds[kind], 200, 0, 1, NULL);
        for (int variant = 0; variant < variants.count; variant++) {
            for (int threads = 0; threads <= 4; threads++) {
                for (int count = 0; count <= MOST; count = count * 2 + (count < 3)) {
                    counter_t counter = counter_make();
                    sl_options opt = options_counted(&counter);
                    sl_factor *F[MOST] = {NULL};
                    sl_int failed = 7;
                    int calls = 0;
                    options_set_variant(&opt, &variants, variant);
                    opt.threads = threads_of(threads, &calls);
                    SL_CHECK(sl_factor_create_sums(F, count, y.S, c, matrix_pair_values(&y), TERMS,
                                                   &opt, &failed, NULL));
                    assert_int_equal(failed, -1);
                    assert_true(calls == 0 || (threads > 1 && count > 0));
                    assert_factors(&y, F, c, count, opt);
                    size_t requests = counter.calls;
                    for (int again = 0; again <= 4; again++) {
                        const sl_threads others = threads_of(again, &calls);
                        const double *now = again % 2 ? c : other;
                        SL_CHECK(sl_factor_refactor_sums(F, count, now, matrix_pair_values(&y),
                                                         TERMS, again ? THREADS(others) : NULL,
                                                         &failed, NULL));
                        assert_int_equal(failed, -1);
                        assert_int_equal(counter.calls, requests); /* allocates nothing */
                        if (again == 0 || again == 3) {
                            assert_factors(&y, F, now, count, opt);
                            requests = counter.calls;
                        }
                    }
                    free_all(F, count);
                    COUNTER_CLEAN(&counter);
                }
            }
        }
        matrix_pair_free(&y);
    }
}

/* Each thread takes whole factors as long as there is one for every thread; all threads together
 * compute the remaining ones. */
static void threads_take_whole_factors_and_share_the_rest(void **state) {
    (void)state;
    matrix_pair_t y = matrix_pair_make(GEN_GRID3, 20 * 20 * 20, 0, 1, NULL);
    double c[TERMS * MOST];
    coefficients_of(c, MOST, 0.5);
    for (int count = 1; count <= 5; count++) {
        sl_options opt = options_none();
        sl_factor *F[MOST] = {NULL};
        int calls = 0;
        sl_stats stats, single;
        memset(&stats, 0, sizeof stats);
        memset(&single, 0, sizeof single);
        opt.method = SL_METHOD_SUPERNODAL;
        opt.threads = threads_of(3, &calls);
        SL_CHECK(sl_factor_create_sums(F, count, y.S, c, matrix_pair_values(&y), TERMS, &opt, NULL,
                                       &stats));
        /* one loop over three factors, then one over the tasks of each other factor */
        assert_int_equal(calls, count / 3 + count % 3);
        assert_int_equal(stats.factor.positive, y.n);
        size_t bytes = 0;
        for (int k = 0; k < count; k++) {
            single.factor = sl_factor_view(F[k]).info;
            bytes += single.factor.bytes;
        }
        assert_int_equal(stats.factor.bytes, bytes);
        assert_factors(&y, F, c, count, opt);
        free_all(F, count);
    }
    matrix_pair_free(&y);
}

/* The first failure is reported; the other factors are computed. */
static void the_first_failure_is_reported_and_the_others_succeed(void **state) {
    (void)state;
    static const double nothing[TERMS] = {0, 0}, wrong[TERMS] = {1, NAN};
    matrix_pair_t y = matrix_pair_make(GEN_GRID2, 100, 0, 1, NULL);
    double c[TERMS * MOST], good[TERMS * MOST];
    for (int threads = 0; threads <= 4; threads++) {
        for (int at = 0; at < MOST; at++) {
            sl_factor *F[MOST] = {NULL};
            sl_options opt = options_none();
            sl_stats stats, own;
            sl_int failed = 99, row = 3;
            int calls = 0, later = (at + 3) % MOST, first = at < later ? at : later;
            double x;
            coefficients_of(c, MOST, 1);
            coefficients_of(good, MOST, 1);
            memcpy(c + TERMS * at, nothing, sizeof nothing); /* the zero matrix */
            memcpy(c + TERMS * later, wrong, sizeof wrong);  /* a coefficient that is not finite */
            memset(&stats, 0, sizeof stats);
            memset(&own, 0, sizeof own);
            opt.threads = threads_of(threads, &calls);
            sl_status status = first == at ? SL_ERR_PIVOT : SL_ERR_NOT_FINITE;
            SL_EXPECT(status, sl_factor_create_sums(F, MOST, y.S, c, matrix_pair_values(&y), TERMS,
                                                    &opt, &failed, &stats));
            assert_int_equal(failed, first);
            assert_int_equal(stats.error.row, first == at ? sl_symbolic_view(y.S).perm[0] : -1);
            assert_int_equal(stats.factor.positive, 0);
            for (int k = 0; k < MOST; k++) {
                assert_true((F[k] == NULL) == (k == at || k == later));
                if (F[k]) {
                    SL_CHECK(sl_inverse_diagonal(F[k], &x, &row, 1, NULL, NULL));
                }
            }
            free_all(F, MOST);
            SL_CHECK(sl_factor_create_sums(F, MOST, y.S, good, matrix_pair_values(&y), TERMS, &opt,
                                           NULL, &own));
            assert_int_equal(own.error.row, -1);
            SL_EXPECT(status, sl_factor_refactor_sums(F, MOST, c, matrix_pair_values(&y), TERMS,
                                                      &opt, &failed, &stats));
            assert_int_equal(failed, first);
            assert_int_equal(stats.error.row, first == at ? sl_symbolic_view(y.S).perm[0] : -1);
            for (int k = 0; k < MOST; k++) {
                SL_EXPECT(k == at || k == later ? SL_ERR_STALE : SL_OK,
                          sl_inverse_diagonal(F[k], &x, &row, 1, NULL, NULL));
            }
            SL_CHECK(sl_factor_refactor_sums(F, MOST, good, matrix_pair_values(&y), TERMS, &opt,
                                             &failed, NULL));
            assert_int_equal(failed, -1);
            free_all(F, MOST);
        }
    }
    matrix_pair_free(&y);
}

static void invalid_arguments_are_refused(void **state) {
    (void)state;
    matrix_pair_t y = matrix_pair_make(GEN_GRID2, 25, 0, 1, NULL),
                  z = matrix_pair_make(GEN_PATH, 25, 0, 1, NULL);
    double c[TERMS * MOST];
    const double *const *v = matrix_pair_values(&y);
    sl_factor *F[3], *G[3];
    sl_int failed = 9;
    sl_options opt = options_none();
    sl_threads threads = {-1, NULL, NULL};
    coefficients_of(c, MOST, 1);
    memset(F, 0x5a, sizeof F);
    SL_EXPECT(SL_ERR_ARGUMENT, sl_factor_create_sums(F, 3, NULL, c, v, TERMS, NULL, &failed, NULL));
    assert_true(F[0] == NULL && F[1] == NULL && F[2] == NULL && failed == -1);
    SL_EXPECT(SL_ERR_ARGUMENT,
              sl_factor_create_sums(NULL, 3, y.S, c, v, TERMS, NULL, &failed, NULL));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_factor_create_sums(F, -1, y.S, c, v, TERMS, NULL, &failed, NULL));
    SL_EXPECT(SL_ERR_ARGUMENT,
              sl_factor_create_sums(F, 3, y.S, NULL, v, TERMS, NULL, &failed, NULL));
    SL_EXPECT(SL_ERR_ARGUMENT,
              sl_factor_create_sums(F, 3, y.S, c, NULL, TERMS, NULL, &failed, NULL));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_factor_create_sums(F, 3, y.S, c, v, -1, NULL, &failed, NULL));
    opt.threads = threads;
    SL_EXPECT(SL_ERR_ARGUMENT, sl_factor_create_sums(F, 3, y.S, c, v, TERMS, &opt, &failed, NULL));
    opt = options_none();
    opt.isa = (sl_isa)17;
    SL_EXPECT(SL_ERR_UNSUPPORTED,
              sl_factor_create_sums(F, 3, y.S, c, v, TERMS, &opt, &failed, NULL));
    assert_true(F[0] == NULL && F[1] == NULL && F[2] == NULL && failed == 0);
    SL_CHECK(sl_factor_create_sums(NULL, 0, y.S, NULL, NULL, 0, NULL, &failed, NULL));
    SL_CHECK(sl_factor_create_sums(F, 3, y.S, c, v, TERMS, NULL, &failed, NULL));
    SL_CHECK(sl_factor_create_sums(G, 3, z.S, c, matrix_pair_values(&z), TERMS, NULL, NULL, NULL));
    sl_factor *mixed[3] = {F[0], F[1], G[0]}, *twice[3] = {F[0], F[1], F[0]},
              *bare[3] = {F[0], NULL, F[1]};
    SL_EXPECT(SL_ERR_MISMATCH, sl_factor_refactor_sums(mixed, 3, c, v, TERMS, NULL, &failed, NULL));
    assert_int_equal(failed, 2);
    SL_EXPECT(SL_ERR_ARGUMENT, sl_factor_refactor_sums(twice, 3, c, v, TERMS, NULL, &failed, NULL));
    assert_int_equal(failed, 2);
    SL_EXPECT(SL_ERR_ARGUMENT, sl_factor_refactor_sums(bare, 3, c, v, TERMS, NULL, &failed, NULL));
    assert_int_equal(failed, 1);
    SL_EXPECT(SL_ERR_ARGUMENT, sl_factor_refactor_sums(NULL, 3, c, v, TERMS, NULL, &failed, NULL));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_factor_refactor_sums(F, -1, c, v, TERMS, NULL, &failed, NULL));
    SL_EXPECT(SL_ERR_ARGUMENT,
              sl_factor_refactor_sums(F, 3, c, v, TERMS, THREADS(threads), &failed, NULL));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_factor_refactor_sums(F, 3, c, NULL, TERMS, NULL, &failed, NULL));
    assert_int_equal(failed, -1);
    SL_CHECK(sl_factor_refactor_sums(NULL, 0, NULL, NULL, 0, NULL, &failed, NULL));
    free_all(F, 3);
    free_all(G, 3);
    matrix_pair_free(&y);
    matrix_pair_free(&z);
}

/* The factor whose allocation fails is NULL; the others are computed. */
static void a_failed_allocation_leaves_the_other_factors(void **state) {
    (void)state;
    matrix_pair_t y = matrix_pair_make(GEN_GRID2, 100, 0, 2, NULL);
    double c[TERMS * 4];
    sl_status status = SL_ERR_MEMORY;
    coefficients_of(c, 4, 1);
    for (int64_t k = 0; status != SL_OK; k++) {
        counter_t counter = counter_make();
        sl_options opt = options_counted(&counter);
        sl_factor *F[4];
        sl_int failed = 9, missing = 0;
        int calls = 0;
        opt.threads = threads_of(3, &calls);
        memset(F, 0x5a, sizeof F);
        counter.fail_at = k;
        status =
            sl_factor_create_sums(F, 4, y.S, c, matrix_pair_values(&y), TERMS, &opt, &failed, NULL);
        assert_true(status == SL_OK || status == SL_ERR_MEMORY);
        assert_int_equal(status == SL_ERR_MEMORY, counter.calls > (size_t)k);
        for (int j = 0; j < 4; j++) {
            missing += F[j] == NULL;
            assert_true((F[j] == NULL) == (failed == j));
        }
        assert_int_equal(missing, status != SL_OK);
        free_all(F, 4);
        COUNTER_CLEAN(&counter);
    }
    matrix_pair_free(&y);
}

/* The first matrix has null pivots, and an allocation for a later one fails. */
static void a_failed_matrix_and_a_failed_allocation(void **state) {
    (void)state;
    matrix_pair_t y = matrix_pair_make(GEN_GRID2, 100, 0, 2, NULL);
    double c[TERMS * 3];
    size_t calls = 1;
    int both = 0;
    coefficients_of(c, 3, 1);
    memset(c, 0, TERMS * sizeof *c);
    for (size_t k = 0; k < calls; k++) {
        counter_t counter = counter_make();
        sl_options opt = options_counted(&counter);
        sl_factor *F[3];
        sl_int failed = 9;
        sl_stats stats;
        counter.fail_at = (int64_t)k;
        const sl_status status = sl_factor_create_sums(F, 3, y.S, c, matrix_pair_values(&y), TERMS,
                                                       &opt, &failed, &stats);
        assert_true(status == SL_ERR_PIVOT || status == SL_ERR_MEMORY);
        assert_int_equal(failed, 0);
        assert_null(F[0]);
        both += status == SL_ERR_PIVOT && (F[1] == NULL || F[2] == NULL);
        calls = counter.calls > k ? k + 2 : 0;
        free_all(F, 3);
        COUNTER_CLEAN(&counter);
    }
    assert_true(both > 0);
    matrix_pair_free(&y);
}

/* A loaded factor gets what a refactorization needs with the first one. If there is no memory for
 * it, the factor and its bytes stay as they were. */
static void loaded_factors_allocate_when_they_are_refactored(void **state) {
    (void)state;
    matrix_pair_t y = matrix_pair_make(GEN_GRID2, 100, 0, 2, NULL);
    double c[TERMS];
    size_t size, bytes = 0;
    coefficients_of(c, 1, 1);
    sl_factor *made = matrix_pair_factor(&y, c, NULL);
    SL_CHECK(pair_save_memory(NULL, &size, y.S, made));
    unsigned char *memory = (unsigned char *)test_array(size, 1);
    SL_CHECK(pair_save_memory(memory, &size, y.S, made));
    for (int turn = 0; turn < 2; turn++) {
        counter_t counter = counter_make();
        sl_options opt = options_counted(&counter);
        sl_symbolic *S;
        sl_factor *F[2]; /* loaded, and made over the loaded analysis */
        sl_stats stats;
        sl_int failed = 9;
        int failures = 0;
        double twice[2 * TERMS];
        sl_status status = SL_ERR_MEMORY;
        memcpy(twice, c, sizeof c);
        memcpy(twice + TERMS, c, sizeof c);
        SL_CHECK(pair_load_memory(&S, &F[0], memory, size, SL_LOAD_CHECKED, &opt));
        SL_CHECK(
            sl_factor_create_sums(&F[1], 1, S, c, matrix_pair_values(&y), TERMS, NULL, NULL, NULL));
        for (int k = 0; status != SL_OK; k++) {
            counter.fail_at = turn == 0 ? -1 : (int64_t)counter.calls + k;
            status = sl_factor_refactor_sums(F, 2, twice, matrix_pair_values(&y), TERMS, NULL,
                                             &failed, &stats);
            assert_int_equal(failed, status == SL_OK ? -1 : 0);
            assert_true(status == SL_OK || status == SL_ERR_MEMORY);
            failures += status != SL_OK;
        }
        assert_true((failures > 0) == turn);
        assert_same_bits(made, F[0]);
        assert_true(turn == 0 || stats.factor.bytes == bytes);
        bytes = stats.factor.bytes;
        SL_CHECK(sl_factor_refactor_sums(NULL, 0, NULL, NULL, 0, NULL, NULL, &stats));
        sl_factor_free(F[0]);
        sl_factor_free(F[1]);
        sl_symbolic_free(S);
        COUNTER_CLEAN(&counter);
    }
    free(memory);
    sl_factor_free(made);
    matrix_pair_free(&y);
}

/* A sum of no terms is the zero matrix: all of its pivots are null. */
static void batches_of_no_terms_are_zero_matrices(void **state) {
    (void)state;
    matrix_pair_t y = matrix_pair_make(GEN_GRID2, 36, 0, 0, NULL);
    sl_options opt = options_none();
    sl_factor *F[2];
    sl_int failed = -2, count = -1;
    SL_EXPECT(SL_ERR_PIVOT, sl_factor_create_sums(F, 2, y.S, NULL, NULL, 0, &opt, &failed, NULL));
    assert_true(F[0] == NULL && F[1] == NULL && failed == 0);
    opt.pivots = SL_PIVOTS_SKIP_NULL;
    SL_CHECK(sl_factor_create_sums(F, 2, y.S, NULL, NULL, 0, &opt, &failed, NULL));
    SL_CHECK(sl_factor_refactor_sums(F, 2, NULL, NULL, 0, NULL, &failed, NULL));
    for (int k = 0; k < 2; k++) {
        SL_CHECK(sl_factor_pivot_rows(F[k], SL_PIVOT_NULL, NULL, NULL, 0, &count));
        assert_int_equal(count, y.n);
        sl_factor_free(F[k]);
    }
    matrix_pair_free(&y);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_batch_gives_the_bits_of_single_factors),
        cmocka_unit_test(threads_take_whole_factors_and_share_the_rest),
        cmocka_unit_test(the_first_failure_is_reported_and_the_others_succeed),
        cmocka_unit_test(invalid_arguments_are_refused),
        cmocka_unit_test(a_failed_allocation_leaves_the_other_factors),
        cmocka_unit_test(a_failed_matrix_and_a_failed_allocation),
        cmocka_unit_test(loaded_factors_allocate_when_they_are_refactored),
        cmocka_unit_test(batches_of_no_terms_are_zero_matrices),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

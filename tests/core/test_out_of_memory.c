/* test_out_of_memory.c: each allocation of every function fails in turn */
#include "tests/lib/allocating_calls.h"

/* Fails each allocation in turn; returns how many there are. */
static int64_t run(fixture_t *f, scenario_t scenario) {
    int64_t k = 0;
    sl_status status = SL_ERR_MEMORY;
    for (; status != SL_OK; k++) {
        counter_t counter = counter_make();
        sl_options opt = options_counted(&counter);
        counter.fail_at = k;
        status = scenario(f, &opt);
        assert_true(status == SL_OK || status == SL_ERR_MEMORY);
        assert_int_equal(status == SL_ERR_MEMORY,
                         counter.calls > (size_t)k); /* no failure is ignored */
        COUNTER_CLEAN(&counter);
        assert_in_range(k, 0, 10000);
    }
    return k - 1;
}

static void every_allocation_may_fail(void **state) {
    (void)state;
    static const struct {
        const char *name;
        scenario_t scenario;
    } all[] = {
        {"sl_matrix_from_triplets", from_triplets},
        {"sl_matrix_submatrix", submatrix},
        {"sl_csc_triangle", triangle},
        {"sl_symbolic_create, default", symbolic_default},
        {"sl_symbolic_create, METIS", symbolic_metis},
        {"sl_symbolic_create, natural", symbolic_natural},
        {"sl_symbolic_create, given", symbolic_given},
        {"sl_factor_create", factor},
        {"sl_factor_create, L in float", factor_float},
        {"sl_factor_lower", lower},
        {"sl_factor_submatrix", restrict_half},
        {"sl_factor_submatrix, few rows", restrict_few},
        {"sl_fixed_*", fixed},
        {"sl_symbolic_edit", edit},
        {"sl_factor_edit", edit_factor},
        {"sl_constraints_*", pins_few},
        {"sl_constraints_*, half of the rows", pins_half},
        {"sl_plan_create", plan},
        {"sl_work_create", work},
        {"sl_work_reserve", reserve},
        {"sl_factor_solve", full_solve},
        {"sl_plan_solve", plan_solve},
        {"sl_local_solve", local_solve},
        {"a workspace that grows", growing},
        {"solves without a workspace", solve_without_work},
    };
    static const int styles[3] = {0, 1, 11}; /* lower; upper; both, unsorted, with duplicates */
    for (int s = 0; s < 3; s++) {
        fixture_t *f = (fixture_t *)test_array(1, sizeof *f);
        fixture_make(f, styles[s]);
        sl_csc *A = &f->y.M.view;
        sl_int nnz = A->p[A->n_cols];
        sl_int *p = test_ints((size_t)A->n_cols + 1), *i = test_ints((size_t)nnz);
        double *x = test_reals((size_t)nnz);
        memcpy(p, A->p, ((size_t)A->n_cols + 1) * sizeof *p);
        memcpy(i, A->i, (size_t)nnz * sizeof *i);
        memcpy(x, A->x, (size_t)nnz * sizeof *x);
        for (size_t k = 0; k < sizeof all / sizeof *all; k++) {
            int64_t count = run(f, all[k].scenario);
            if (s == 0) {
                print_message("%-30s %ld allocations\n", all[k].name, (long)count);
            }
            assert_true(count > 0 || all[k].scenario == triangle);
        }
        /* the inputs are unchanged */
        assert_memory_equal(p, A->p, ((size_t)A->n_cols + 1) * sizeof *p);
        assert_memory_equal(i, A->i, (size_t)nnz * sizeof *i);
        assert_memory_equal(x, A->x, (size_t)nnz * sizeof *x);
        free(p);
        free(i);
        free(x);
        fixture_free(f);
        free(f);
    }
}

static void every_allocation_of_the_reader_may_fail(void **state) {
    (void)state;
    static const char *const texts[2] = {
        "%%MatrixMarket matrix coordinate real symmetric\n3 3 4\n1 1 1\n2 2 3\n3 1 -1\n3 3 4\n",
        "%%MatrixMarket matrix coordinate pattern general\n3 3 4\n1 1\n2 2\n3 1\n3 3\n"};
    fixture_t *f = (fixture_t *)test_array(1, sizeof *f);
    for (int k = 0; k < 2; k++) {
        f->length = strlen(texts[k]);
        memcpy(f->text, texts[k], f->length);
        assert_true(run(f, parse) > 0);
    }
    const char *folder = getenv("TMPDIR");
    snprintf(f->text, sizeof f->text, "%s/sparse_local_out_of_memory.mtx",
             folder && *folder ? folder : ".");
    FILE *file = fopen(f->text, "wb");
    assert_non_null(file);
    fputs(texts[0], file);
    for (int k = 0; k < 3000; k++) { /* longer than one read: the text has to move */
        fputs("% a comment of some length, one of many that follow each other here\n", file);
    }
    fclose(file);
    assert_true(run(f, read_file) > 0);
    remove(f->text);
    free(f);
}

/* Objects made before an allocator fails are released properly. */
static void objects_outlive_a_failing_allocator(void **state) {
    (void)state;
    counter_t counter = counter_make();
    sl_options opt = options_counted(&counter);
    factored_t y = factored_make(GEN_GRID2, 100, 1, 0, &opt);
    sl_int row = 5;
    sl_plan *P = NULL, *Q = NULL;
    double one = 1;
    SL_CHECK(sl_plan_create(&P, y.S, &row, 1, &row, 1, &opt, NULL));
    counter.fail_at = (int64_t)counter.calls;
    SL_EXPECT(SL_ERR_MEMORY, sl_plan_create(&Q, y.S, &row, 1, &row, 1, &opt, NULL));
    SL_CHECK(sl_factor_refactor(y.F, &y.M.view, NULL)); /* needs no memory */
    counter.fail_at = (int64_t)counter.calls;
    SL_EXPECT(SL_ERR_MEMORY, sl_plan_solve(P, y.F, &one, 1, &one, 1, 1, NULL));
    assert_true(one == 1);
    SL_CHECK(sl_plan_solve(P, y.F, &one, 1, &one, 1, 1, NULL)); /* the next call succeeds */
    assert_true(one != 1);
    sl_plan_free(P);
    factored_free(&y);
    COUNTER_CLEAN(&counter);
}

/* Refuses large blocks and remembers the largest request. */
static void *allocate_little(void *context, size_t bytes) {
    size_t *refused = (size_t *)context;
    if (bytes < (size_t)1 << 28) {
        return malloc(bytes);
    }
    *refused = bytes;
    return NULL;
}

static void release_little(void *context, void *block) {
    (void)context;
    free(block);
}

/* A star eliminated from its center: L is dense, and its number of doubles, 2^32 + 194624, is
 * 194624 modulo 2^32. Where size_t has 32 bits, the factor must be refused instead of allocated at
 * that size. */
static void a_size_beyond_32_bits_is_not_truncated(void **state) {
    (void)state;
    size_t refused = 0;
    sl_options opt = options_none();
    gen_list_t t = gen_make(GEN_STAR, 92680, 1, 1);
    gen_matrix_t M = gen_store(&t, gen_style(1), 1); /* the upper triangle: short columns */
    sl_symbolic *S = NULL;
    sl_factor *F = NULL;
    sl_stats stats;
    memset(&stats, 0, sizeof stats);
    opt.ordering = SL_ORDERING_NATURAL;
    opt.allocator.allocate = allocate_little;
    opt.allocator.release = release_little;
    opt.allocator.context = &refused;
    SL_CHECK(sl_symbolic_create(&S, &M.view, &opt, &stats));
    assert_int_equal(refused, 0);
    assert_true(stats.symbolic.nnz_panels == ((sl_off)1 << 32) + 194624);
#if SIZE_MAX > 0xFFFFFFFFu
    SL_EXPECT(SL_ERR_MEMORY, sl_factor_create(&F, S, &M.view, FOR_FACTOR(&opt), NULL));
    assert_true(refused / sizeof(double) >= (size_t)stats.symbolic.nnz_panels);
#else
    SL_EXPECT(SL_ERR_TOO_LARGE, sl_factor_create(&F, S, &M.view, FOR_FACTOR(&opt), NULL));
    assert_int_equal(refused, 0);
#endif
    assert_null(F);
    sl_symbolic_free(S);
    gen_matrix_free(&M);
    gen_list_free(&t);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_allocation_may_fail),
        cmocka_unit_test(every_allocation_of_the_reader_may_fail),
        cmocka_unit_test(objects_outlive_a_failing_allocator),
        cmocka_unit_test(a_size_beyond_32_bits_is_not_truncated),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

/* test_ordering_threads.c: analyses by several threads: the same order, errors and memory */
#define _POSIX_C_SOURCE 200112L /* nanosleep */
#include "tests/lib/no_kernels.h"
#define SPARSE_LOCAL_IMPLEMENTATION
#define SLI_SMALL_TASKS 1 /* small graphs are ordered by several workers, too */
#include "tests/lib/kkt.h"
#include "tests/lib/pools.h"
#include "tests/lib/order_patterns.h"
#include "tests/lib/ordering_meshes.h"

static void assert_same_order(const sl_symbolic *S, const sl_symbolic *T) {
    const sl_symbolic_arrays v = sl_symbolic_view(S), w = sl_symbolic_view(T);
    const size_t n = (size_t)v.n * sizeof(sl_int);
    assert_int_equal(v.n_supers, w.n_supers);
    assert_int_equal(v.n_nodes, w.n_nodes);
    assert_memory_equal(v.perm, w.perm, n);
    assert_memory_equal(v.parent, w.parent, n);
    assert_memory_equal(v.rows, w.rows, (size_t)v.rows_begin[v.n_supers] * sizeof(sl_int));
    assert_memory_equal(S->relative, T->relative,
                        (size_t)v.rows_begin[v.n_supers] * sizeof(sl_int));
    const size_t entries = (size_t)S->scatter_begin[v.n_supers];
    assert_int_equal(entries, T->scatter_begin[v.n_supers]);
    assert_memory_equal(S->scatter_from, T->scatter_from, entries * sizeof(sl_int));
    assert_memory_equal(S->scatter_to, T->scatter_to, entries * sizeof(sl_off));
    if (v.n_nodes > 0) {
        assert_memory_equal(v.node_of, w.node_of, n);
    }
}

/* Analyzes by 2, 3 and 8 workers, in each of the pools. */
static void assert_same_order_for_any_thread_count(const sl_csc *A, const sl_options *from) {
    sl_symbolic *one = NULL;
    SL_CHECK(sl_symbolic_create(&one, A, from, NULL));
    for (int run = 0; run < RUNS; run++) {
        for (sl_int count = 2; count <= 8; count = count == 3 ? 8 : count + 1) {
            int calls = 0;
            sl_options opt = *from;
            sl_symbolic *S = NULL;
            opt.threads.count = count;
            opt.threads.run = runs[run];
            opt.threads.context = &calls;
            SL_CHECK(sl_symbolic_create(&S, A, &opt, NULL));
            assert_same_order(S, one);
            assert_int_equal(calls, A->p[A->n_cols] > 0); /* one parallel call */
            sl_symbolic_free(S);
        }
    }
    sl_symbolic_free(one);
}

static gen_matrix_t pattern_matrix(int kind) {
    gen_list_t t = pattern(kind);
    gen_matrix_t M = gen_store(&t, gen_style(0), 1);
    gen_list_free(&t);
    return M;
}

static void patterns_have_the_same_order(void **state) {
    (void)state;
    for (int kind = 0; kind < ORDER_KINDS; kind++) {
        gen_matrix_t M = pattern_matrix(kind);
        sl_options opt = options_none();
        assert_same_order_for_any_thread_count(&M.view, &opt);
        gen_matrix_free(&M);
    }
}

static void small_matrices_have_the_same_order(void **state) {
    (void)state;
    for (int kind = GEN_ONE; kind < GEN_KINDS; kind++) {
        gen_list_t t = gen_make((gen_kind_t)kind, 100, 0, 7);
        gen_matrix_t M = gen_store(&t, gen_style(0), 1);
        sl_options opt = options_none();
        opt.purpose = kind % 2 == 0 ? SL_PURPOSE_MANY_SOLVES : SL_PURPOSE_ONE_FACTOR;
        assert_same_order_for_any_thread_count(&M.view, &opt);
        gen_matrix_free(&M);
        gen_list_free(&t);
    }
}

static void meshes_and_blocks_have_the_same_order(void **state) {
    (void)state;
    for (int kind = MESH_JITTERED; kind <= MESH_SCROLL; kind++) {
        double *xyz = NULL;
        gen_matrix_t M = mesh_pattern((ordering_mesh)kind, 40, &xyz);
        sl_options opt = options_none();
        assert_same_order_for_any_thread_count(&M.view, &opt);
        free(xyz);
        gen_matrix_free(&M);
    }
    gen_matrix_t M = pattern_matrix(ORDER_CLIQUES);
    sl_options opt = options_none();
    opt.block_size = 3;
    assert_same_order_for_any_thread_count(&M.view, &opt);
    gen_matrix_free(&M);
}

/* Orderings without shared parts share the rest of the analysis, except for METIS, which is run by
 * the caller's thread. */
static void other_orderings_give_the_same_analysis(void **state) {
    (void)state;
    for (int kind = 0; kind < ORDER_KINDS; kind++) {
        gen_matrix_t M = pattern_matrix(kind);
        sl_options opt = options_none();
        sl_int *perm = test_ints((size_t)M.view.n_cols);
        gen_permutation(perm, M.view.n_cols, 5);
        opt.perm = perm;
        for (int k = 0; k < 3; k++) {
            opt.ordering = k == 0   ? SL_ORDERING_NATURAL
                           : k == 1 ? SL_ORDERING_GIVEN
                                    : SL_ORDERING_MINDEG;
            opt.relaxation = kind % 2 ? SL_RELAXATION_NONE : SL_RELAXATION_DEFAULT;
            assert_same_order_for_any_thread_count(&M.view, &opt);
        }
        free(perm);
        gen_matrix_free(&M);
    }
}

static void metis_is_run_by_the_caller(void **state) {
    (void)state;
    if (!ordering_is_present(SL_ORDERING_METIS)) {
        TEST_SKIP("built without METIS");
    }
    gen_matrix_t M = pattern_matrix(ORDER_FOREST);
    int calls = 0;
    sl_options opt = options_none();
    sl_symbolic *S = NULL;
    opt.ordering = SL_ORDERING_METIS;
    opt.threads.count = 4;
    opt.threads.run = run_threads;
    opt.threads.context = &calls;
    SL_CHECK(sl_symbolic_create(&S, &M.view, &opt, NULL));
    assert_int_equal(calls, 0);
    sl_symbolic_free(S);
    gen_matrix_free(&M);
}

/* Supernodes that are split for 2x2 pivots have rows of other parts. */
static void pivoted_analyses_are_the_same(void **state) {
    (void)state;
    kkt_t y = kkt_make(400, 0, SL_ORDERING_ND);
    sl_symbolic *one = NULL;
    SL_CHECK(sl_symbolic_create_pivoted(&one, &y.M.view, NULL, NULL));
    assert_true(one->n_pairs > 0);
    for (sl_int count = 2; count <= 8; count *= 2) {
        int calls = 0;
        sl_options opt = options_none();
        sl_symbolic *S = NULL;
        opt.threads.count = count;
        opt.threads.run = run_threads;
        opt.threads.context = &calls;
        SL_CHECK(sl_symbolic_create_pivoted(&S, &y.M.view, &opt, NULL));
        assert_same_order(S, one);
        assert_int_equal(calls, 2);
        sl_symbolic_free(S);
    }
    sl_symbolic_free(one);
    kkt_free(&y);
}

/* Whichever worker is out of memory, the status is that of one thread, and nothing is lost. */
static void every_allocation_may_fail(void **state) {
    (void)state;
    gen_matrix_t M = pattern_matrix(ORDER_WIDE);
    for (int run = 0; run < RUNS; run++) {
        sl_status status = SL_ERR_MEMORY;
        for (int64_t k = 0; status != SL_OK; k++) {
            counter_t counter = counter_make();
            int calls = 0;
            sl_options opt = options_counted(&counter);
            sl_symbolic *S = NULL;
            opt.threads.count = 3;
            opt.threads.run = runs[run];
            opt.threads.context = &calls;
            counter.fail_at = k;
            status = sl_symbolic_create(&S, &M.view, &opt, NULL);
            assert_int_equal(status == SL_ERR_MEMORY, counter.calls > (size_t)k);
            assert_int_equal(S == NULL, status != SL_OK);
            sl_symbolic_free(S);
            COUNTER_CLEAN(&counter);
        }
    }
    gen_matrix_free(&M);
}

/* A pool that promises more threads than there are tasks, and none at all: OpenMP or one thread. */
static void unusual_thread_counts_are_handled(void **state) {
    (void)state;
    gen_matrix_t M = pattern_matrix(ORDER_COMPONENTS);
    int calls = 0;
    sl_options opt = options_none();
    sl_symbolic *one = NULL, *S = NULL;
    SL_CHECK(sl_symbolic_create(&one, &M.view, NULL, NULL));
    opt.threads.count = INT32_MAX;
    opt.threads.run = run_backwards;
    opt.threads.context = &calls;
    SL_CHECK(sl_symbolic_create(&S, &M.view, &opt, NULL));
    assert_same_order(S, one);
    sl_symbolic_free(S);
    opt.threads.count = 2;
    opt.threads.run = NULL;
    SL_EXPECT(WITHOUT_POOL, sl_symbolic_create(&S, &M.view, &opt, NULL));
    if (S != NULL) {
        assert_same_order(S, one);
    }
    sl_symbolic_free(S);
    sl_symbolic_free(one);
    gen_matrix_free(&M);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(patterns_have_the_same_order),
        cmocka_unit_test(small_matrices_have_the_same_order),
        cmocka_unit_test(meshes_and_blocks_have_the_same_order),
        cmocka_unit_test(other_orderings_give_the_same_analysis),
        cmocka_unit_test(metis_is_run_by_the_caller),
        cmocka_unit_test(pivoted_analyses_are_the_same),
        cmocka_unit_test(every_allocation_may_fail),
        cmocka_unit_test(unusual_thread_counts_are_handled),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

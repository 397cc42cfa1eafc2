/* test_batch.c: many solves by one call: the bits of single solves for any number of threads, wrong requests */
#include "parallel_for.h"
#include "problem.h"

enum { REQUESTS = 9 };

/* Requests of every kind over one factor, and what single solves answer. */
typedef struct batch_t {
    problem_t y;
    sl_plan *plan[REQUESTS]; /* the last has none: a full solve */
    sl_request request[REQUESTS];
    double *X[REQUESTS], *B[REQUESTS], *wanted[REQUESTS];
    size_t size[REQUESTS]; /* of X */
} batch_t;

/* What a single call answers to request k. */
static void solve_alone(batch_t *t, int k) {
    const sl_request *r = &t->request[k];
    if (!r->plan) {
        SL_CHECK((r->is_interleaved ? sl_factor_solve_interleaved : sl_factor_solve)(
            t->y.F, t->wanted[k], r->ldx, r->B, r->ldb, r->nrhs, NULL));
    } else {
        SL_CHECK((r->is_interleaved ? sl_plan_solve_interleaved : sl_plan_solve)(
            r->plan, t->y.F, t->wanted[k], r->ldx, r->B, r->ldb, r->nrhs, NULL));
    }
}

static batch_t batch_make(gen_kind_t kind, sl_int size, sl_isa isa) {
    static const sl_int columns[REQUESTS] = {1, 3, 8, 0, 40, 17, 2, 9, 21};
    sl_options opt = options_none();
    batch_t t;
    uint64_t seed = 5;
    memset(&t, 0, sizeof t);
    opt.isa = isa;
    t.y = problem_make(kind, size, 0, 0, &opt);
    sl_int n = t.y.M.view.n_cols;
    for (int k = 0; k < REQUESTS; k++) {
        int is_full = k == REQUESTS - 1;
        sl_int nb = is_full ? n : gen_below(&seed, n + 1),
               nx = is_full ? n : gen_below(&seed, n + 1);
        sl_int *bset = test_ints((size_t)n), *xset = test_ints((size_t)n);
        gen_set(bset, nb, n, gen_bits(&seed));
        gen_set(xset, nx, n, gen_bits(&seed));
        if (!is_full) {
            SL_CHECK(sl_plan_create(&t.plan[k], t.y.S, bset, nb, xset, nx, NULL, NULL));
        }
        sl_request *r = &t.request[k];
        r->plan = t.plan[k];
        r->nrhs = columns[k];
        r->is_interleaved = k % 3 == 1 || k == REQUESTS - 1;
        size_t across = (size_t)columns[k];
        r->ldb = r->is_interleaved ? across + 3 : (size_t)nb + 2;
        r->ldx = r->is_interleaved ? across + 1 : (size_t)nx + 1;
        t.size[k] = r->ldx * (r->is_interleaved ? (size_t)nx : across);
        t.X[k] = r->X = test_reals(t.size[k]);
        size_t size_b = r->ldb * (r->is_interleaved ? (size_t)nb : across);
        t.B[k] = test_reals(size_b);
        t.wanted[k] = test_reals(t.size[k]);
        gen_reals(t.B[k], size_b, gen_bits(&seed));
        r->B = t.B[k];
        solve_alone(&t, k);
        free(bset);
        free(xset);
    }
    return t;
}

static void batch_free(batch_t *t) {
    for (int k = 0; k < REQUESTS; k++) {
        sl_plan_free(t->plan[k]);
        free(t->X[k]);
        free(t->B[k]);
        free(t->wanted[k]);
    }
    problem_free(&t->y);
}

static void batch_check(batch_t *t) {
    for (int k = 0; k < REQUESTS; k++) {
        SAME_VALUES(t->X[k], t->wanted[k], t->size[k]);
        memset(t->X[k], 0, t->size[k] * sizeof(double));
    }
}

static void the_bits_of_single_solves(void **state) {
    (void)state;
    static const gen_kind_t kinds[4] = {GEN_GRID2, GEN_COMPONENTS, GEN_PATH, GEN_ONE};
    isa_list_t isas = isas_present();
    for (int kind = 0; kind < 4; kind++) {
        for (int isa = 0; isa < isas.count; isa++) {
            batch_t t = batch_make(kinds[kind], 200, isas.isa[isa]);
            sl_work *works[40];
            for (int k = 0; k < 40; k++) {
                SL_CHECK(sl_work_create(&works[k], NULL));
            }
            for (sl_int count = 0; count <= 40; count = count < 4 ? count + 1 : count * 3) {
                int calls = 0;
                sl_int failed = 7;
                sl_threads threads = {count, count % 2 ? run_threads : run_backwards, &calls};
                SL_CHECK(sl_batch_solve(t.y.F, t.request, REQUESTS, &threads, NULL, &failed));
                assert_int_equal(failed, -1);
                assert_int_equal(calls, count > 1);
                batch_check(&t);
                SL_CHECK(sl_batch_solve(t.y.F, t.request, REQUESTS, &threads, works, NULL));
                batch_check(&t);
                threads.run = NULL; /* OpenMP, or one after the other */
                SL_CHECK(sl_batch_solve(t.y.F, t.request, REQUESTS, &threads, works, NULL));
                batch_check(&t);
            }
            SL_CHECK(sl_batch_solve(t.y.F, t.request, REQUESTS, NULL, NULL, NULL));
            batch_check(&t);
            SL_CHECK(sl_batch_solve(t.y.F, NULL, 0, NULL, NULL, NULL));
            for (int k = 0; k < 40; k++) {
                sl_work_free(works[k]);
            }
            batch_free(&t);
        }
    }
}

/* Every worker has something to do where there is enough: nobody does it all. */
static void the_work_is_shared(void **state) {
    (void)state;
    batch_t t = batch_make(GEN_GRID2, 400, SL_ISA_AUTO);
    int calls = 0;
    sl_work *works[4];
    for (int k = 0; k < 4; k++) {
        SL_CHECK(sl_work_create(&works[k], NULL));
    }
    sl_threads threads = {4, run_threads, &calls};
    SL_CHECK(sl_batch_solve(t.y.F, t.request, REQUESTS, &threads, works, NULL));
    assert_int_equal(calls, 1);
    batch_check(&t);
    size_t bytes = sl_work_bytes(works[0]);
    assert_true(bytes > 0);
    for (int k = 0; k < 4; k++) {
        assert_int_equal(sl_work_bytes(works[k]), bytes);
        sl_work_free(works[k]);
    }
    batch_free(&t);
}

static void wrong_requests_touch_nothing(void **state) {
    (void)state;
    batch_t t = batch_make(GEN_GRID2, 100, SL_ISA_AUTO),
            other = batch_make(GEN_PATH, 100, SL_ISA_AUTO);
    sl_request keep = t.request[5]; /* column-major, 17 right-hand sides */
    sl_int failed = 7;
    int calls = 0;
    sl_threads threads = {2, run_backwards, &calls};
    sl_work *works[2] = {NULL, NULL};
    memset(t.X[0], 0, t.size[0] * sizeof(double));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_batch_solve(NULL, t.request, REQUESTS, NULL, NULL, &failed));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_batch_solve(t.y.F, NULL, 1, NULL, NULL, &failed));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_batch_solve(t.y.F, t.request, -1, NULL, NULL, &failed));
    assert_int_equal(failed, -1);
    for (int wrong = 0; wrong < 5; wrong++) {
        sl_request *r = &t.request[5];
        switch (wrong) {
        case 0:
            r->X = NULL;
            break;
        case 1:
            r->ldx -= 2;
            break;
        case 2:
            r->nrhs = -1;
            break;
        case 3:
            r->X = (double *)(uintptr_t)r->B;
            break; /* in place with two strides */
        case 4:
            r->plan = other.plan[0];
            r->ldx = r->ldb = 1000;
            r->nrhs = 1;
            break;
        }
        SL_EXPECT(wrong == 4 ? SL_ERR_STATE : SL_ERR_ARGUMENT,
                  sl_batch_solve(t.y.F, t.request, REQUESTS, &threads, NULL, &failed));
        assert_int_equal(failed, 5);
        *r = keep;
    }
    SL_EXPECT(SL_ERR_ARGUMENT,
              sl_batch_solve(t.y.F, t.request, REQUESTS, &threads, works, &failed));
    SL_CHECK(sl_work_create(&works[0], NULL));
    works[1] = works[0];
    SL_EXPECT(SL_ERR_ARGUMENT,
              sl_batch_solve(t.y.F, t.request, REQUESTS, &threads, works, &failed));
    sl_work_free(works[0]);
    threads.count = INT32_MAX; /* no more workers than blocks of right-hand sides */
    SL_CHECK(sl_batch_solve(t.y.F, t.request, REQUESTS, &threads, NULL, NULL));
    memset(t.X[0], 0, t.size[0] * sizeof(double));
    calls = 0;
    threads.count = -1;
    SL_EXPECT(SL_ERR_ARGUMENT, sl_batch_solve(t.y.F, t.request, REQUESTS, &threads, NULL, &failed));
    assert_int_equal(calls, 0);
    for (size_t k = 0; k < t.size[0]; k++) {
        assert_true(t.X[0][k] == 0.0);
    }
    batch_free(&t);
    batch_free(&other);
}

static void memory_may_fail(void **state) {
    (void)state;
    counter_t counter = counter_make();
    batch_t t = batch_make(GEN_GRID2, 100, SL_ISA_AUTO);
    sl_options opt = options_counted(&counter);
    sl_factor *F = NULL;
    int calls = 0;
    sl_threads threads = {3, run_backwards, &calls};
    SL_CHECK(sl_factor_create(&F, t.y.S, &t.y.M.view, &opt, NULL));
    counter.fail_at = (int64_t)counter.calls;
    SL_EXPECT(SL_ERR_MEMORY, sl_batch_solve(F, t.request, REQUESTS, &threads, NULL, NULL));
    counter.fail_at = -1;
    SL_CHECK(sl_batch_solve(F, t.request, REQUESTS, &threads, NULL, NULL));
    batch_check(&t);
    sl_factor_free(F);
    batch_free(&t);
    COUNTER_CLEAN(&counter);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_bits_of_single_solves),
        cmocka_unit_test(the_work_is_shared),
        cmocka_unit_test(wrong_requests_touch_nothing),
        cmocka_unit_test(memory_may_fail),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

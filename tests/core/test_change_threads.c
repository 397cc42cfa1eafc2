/* test_change_threads.c: solves by threads between edits, and edits of several factors at once */
#include "tests/lib/parallel_for.h"
#include "tests/lib/factored.h"
#include "tests/lib/constraint_calls.h"

enum { TASKS = 8, ROUNDS = 6, PINS = 3, NEAR = 5 };

/* What the tasks of one test share. Each writes only what has its number. */
typedef struct shared_t {
    factored_t y;
    sl_int n;
    sl_plan *plan; /* b and x in NEAR rows */
    sl_constraints *pins;
    double *B, G[PINS];
    double *X[TASKS];
    sl_status status[TASKS];
    sl_factor *F[TASKS];
    sl_work *W[TASKS];
} shared_t;

static const sl_int near_rows[NEAR] = {3, 4, 77, 200, 5}, pinned[PINS] = {11, 300, 78};

static shared_t shared_make(void) {
    shared_t s;
    memset(&s, 0, sizeof s);
    s.y = factored_make(GEN_GRID2, 400, 1, 0, NULL);
    s.n = s.y.M.view.n_cols;
    s.B = test_reals((size_t)s.n);
    gen_reals(s.B, (size_t)s.n, 7);
    gen_reals(s.G, PINS, 8);
    SL_CHECK(sl_plan_create(&s.plan, s.y.S, near_rows, NEAR, near_rows, NEAR, NULL, NULL));
    SL_CHECK(sl_constraints_create(&s.pins, s.y.F, NULL));
    for (int k = 0; k < PINS; k++) {
        SL_CHECK(pin_row(s.pins, pinned[k], NULL));
    }
    for (int k = 0; k < TASKS; k++) {
        s.X[k] = test_reals((size_t)s.n);
        SL_CHECK(sl_work_create(&s.W[k], NULL));
        SL_CHECK(sl_factor_create(&s.F[k], s.y.S, &s.y.M.view, NULL, NULL));
    }
    return s;
}

static void shared_free(shared_t *s) {
    for (int k = 0; k < TASKS; k++) {
        free(s->X[k]);
        sl_work_free(s->W[k]);
        sl_factor_free(s->F[k]);
    }
    free(s->B);
    sl_plan_free(s->plan);
    sl_constraints_free(s->pins);
    factored_free(&s->y);
}

/* Runs a task for all k by threads, and again one after the other: the same bits. */
static void assert_threads_change_nothing(shared_t *s, void (*task)(void *shared, sl_int k)) {
    const size_t n = (size_t)s->n;
    double *together = test_reals(TASKS * n);
    int calls = 0;
    run_threads(&calls, TASKS, task, s);
    for (int k = 0; k < TASKS; k++) {
        SL_CHECK(s->status[k]);
        memcpy(together + (size_t)k * n, s->X[k], n * sizeof(double));
        memset(s->X[k], 0, n * sizeof(double));
    }
    for (int k = 0; k < TASKS; k++) {
        task(s, k);
        SL_CHECK(s->status[k]);
        assert_memory_equal(together + (size_t)k * n, s->X[k], n * sizeof(double));
    }
    free(together);
}

/* Every kind of solve with the factor that all threads share. */
static void solve_task(void *shared, sl_int k) {
    shared_t *s = (shared_t *)shared;
    const size_t n = (size_t)s->n;
    double *x = s->X[k];
    switch (k % 4) {
    case 0:
        s->status[k] = sl_factor_solve(s->y.F, x, n, s->B, n, 1, s->W[k]);
        break;
    case 1:
        s->status[k] = sl_plan_solve(s->plan, s->y.F, x, NEAR, s->B, NEAR, 1, s->W[k]);
        break;
    case 2:
        s->status[k] = sl_constraints_solve(s->pins, NULL, x, n, s->B, n, s->G, PINS, 1, s->W[k]);
        break;
    default:
        s->status[k] =
            sl_constraints_solve(s->pins, s->plan, x, NEAR, s->B, NEAR, s->G, PINS, 1, s->W[k]);
        break;
    }
}

/* Changes an entry of the diagonal in the factor and, for sl_factor_change_entries, in the matrix.
 * */
static void edit(shared_t *s, int round) {
    const sl_int row = (sl_int)(round * 61 % s->n);
    const double delta = round % 2 ? -0.25 : 0.5;
    if (round % 3 < 2) {
        SL_CHECK(sl_factor_change_entries(s->y.F, NULL, &row, &row, &delta, 1, s->W[0], NULL));
    }
    for (sl_int p = s->y.M.p[row]; p < s->y.M.p[row + 1]; p++) {
        if (s->y.M.i[p] == row) {
            s->y.M.x[p] += delta;
            break;
        }
    }
    if (round % 3 == 2) {
        SL_CHECK(
            sl_factor_change_entries(s->y.F, &s->y.M.view, &row, &row, &delta, 1, s->W[0], NULL));
    }
    SL_CHECK(sl_constraints_refactor(s->pins, NULL));
}

static void solves_between_edits_share_a_factor(void **state) {
    (void)state;
    shared_t s = shared_make();
    for (int round = 0; round < ROUNDS; round++) {
        assert_threads_change_nothing(&s, solve_task);
        edit(&s, round);
        SL_CHECK(sl_factor_solve(s.y.F, s.X[0], (size_t)s.n, s.B, (size_t)s.n, 1, NULL));
        BACKWARD_PASSES(&s.y.M.view, s.X[0], (size_t)s.n, s.B, (size_t)s.n, 1);
    }
    shared_free(&s);
}

/* Batches that the library divides among threads, between edits. */
static void batches_between_edits_give_the_same_bits(void **state) {
    (void)state;
    shared_t s = shared_make();
    const size_t n = (size_t)s.n;
    for (int round = 0; round < ROUNDS; round++) {
        sl_request requests[TASKS];
        int calls = 0;
        const sl_threads threads = {3, run_threads, &calls};
        memset(requests, 0, sizeof requests);
        for (int k = 0; k < TASKS; k++) {
            const size_t size = k % 2 ? NEAR : n;
            requests[k].plan = k % 2 ? s.plan : NULL;
            requests[k].X = s.X[k];
            requests[k].B = s.B;
            requests[k].ldx = requests[k].ldb = size;
            requests[k].nrhs = 1;
        }
        SL_CHECK(sl_batch_solve(s.y.F, requests, TASKS, THREADS(threads), NULL, NULL));
        assert_true(calls > 0);
        for (int k = 0; k < TASKS; k++) {
            double *alone = test_reals(n);
            SL_CHECK(k % 2 ? sl_plan_solve(s.plan, s.y.F, alone, NEAR, s.B, NEAR, 1, NULL)
                           : sl_factor_solve(s.y.F, alone, n, s.B, n, 1, NULL));
            assert_memory_equal(alone, s.X[k], (k % 2 ? NEAR : n) * sizeof(double));
            free(alone);
        }
        edit(&s, round);
    }
    shared_free(&s);
}

/* Each task edits a factor of its own; all share the analysis. The factor is that of A again at the
 * end, to rounding, so that the second run starts from other bits: it is refactored first. */
static void edit_task(void *shared, sl_int k) {
    shared_t *s = (shared_t *)shared;
    const sl_int row = 37 * k % s->n;
    const double up = 0.5 + 0.1 * (double)k, down = -up;
    s->status[k] = sl_factor_refactor(s->F[k], &s->y.M.view, NULL);
    for (int turn = 0; turn < 3 && s->status[k] == SL_OK; turn++) {
        s->status[k] = sl_factor_change_entries(s->F[k], NULL, &row, &row, &up, 1, s->W[k], NULL);
        if (s->status[k] == SL_OK && turn < 2) {
            s->status[k] =
                sl_factor_change_entries(s->F[k], NULL, &row, &row, &down, 1, s->W[k], NULL);
        }
    }
    if (s->status[k] == SL_OK) {
        s->status[k] =
            sl_factor_solve(s->F[k], s->X[k], (size_t)s->n, s->B, (size_t)s->n, 1, s->W[k]);
    }
}

static void factors_of_one_analysis_are_edited_at_once(void **state) {
    (void)state;
    shared_t s = shared_make();
    for (int round = 0; round < ROUNDS; round++) {
        assert_threads_change_nothing(&s, edit_task);
    }
    shared_free(&s);
}

/* Each task has its own pins on the factor that all share. */
static void pin_task(void *shared, sl_int k) {
    shared_t *s = (shared_t *)shared;
    sl_constraints *pins = NULL;
    s->status[k] = sl_constraints_create(&pins, s->y.F, NULL);
    for (sl_int p = 0; p < PINS + 1 && s->status[k] == SL_OK; p++) {
        s->status[k] = pin_row(pins, (17 * k + 41 * p) % s->n, NULL);
    }
    if (s->status[k] == SL_OK) {
        s->status[k] = unpin(pins, k % PINS);
    }
    if (s->status[k] == SL_OK) {
        s->status[k] = sl_constraints_solve(pins, NULL, s->X[k], (size_t)s->n, s->B, (size_t)s->n,
                                            s->G, PINS, 1, s->W[k]);
    }
    sl_constraints_free(pins);
}

static void pins_are_made_at_once_on_one_factor(void **state) {
    (void)state;
    shared_t s = shared_make();
    for (int round = 0; round < ROUNDS; round++) {
        assert_threads_change_nothing(&s, pin_task);
        edit(&s, round);
    }
    shared_free(&s);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(solves_between_edits_share_a_factor),
        cmocka_unit_test(batches_between_edits_give_the_same_bits),
        cmocka_unit_test(factors_of_one_analysis_are_edited_at_once),
        cmocka_unit_test(pins_are_made_at_once_on_one_factor),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

/* test_reserve_inverse.c: inverse, selected, region calls in what the same call took */
#include "tests/lib/check_inverse.h"
#include "tests/lib/parallel_for.h"
#include "tests/lib/reserved.h"

/* ---- sets of rows ---- */

enum { SETS = 4 };

/* Rows side by side, as far apart as they can be, at random, and one row over and over. */
static void make_rows(sl_int *rows, sl_int count, sl_int n, int set, uint64_t *seed) {
    const sl_int start = n / 3;
    for (sl_int k = 0; k < count; k++) {
        rows[k] = set == 0 ? (start + k) % n : set == 1 ? (sl_int)((int64_t)k * n / count) : start;
    }
    if (set == 2) {
        random_rows(rows, count, n, seed);
    }
}

/* The other row of each pair: entries in the pattern of A, so that a traversal is possible. */
static void make_columns(sl_int *columns, const sl_int *rows, sl_int count, const sl_csc *A) {
    for (sl_int k = 0; k < count; k++) {
        const sl_int j = rows[k], first = A->p[j], last = A->p[j + 1];
        columns[k] = last > first ? A->i[first + k % (last - first)] : j;
    }
}

/* ---- factors ---- */

static const struct problem {
    gen_kind_t kind;
    sl_int size;
} problems[] = {{GEN_NONE, 0},     {GEN_ONE, 1},       {GEN_DIAGONAL, 300}, {GEN_PATH, 3000},
                {GEN_STAR, 300},   {GEN_ARROW, 300},   {GEN_GRID2, 4900},   {GEN_GRID3, 1000},
                {GEN_FOREST, 500}, {GEN_DENSE, 50},    {GEN_RANDOM, 400},   {GEN_COMPONENTS, 400},
                {GEN_KKT, 300},    {GEN_SINGULAR, 400}};

enum { PROBLEMS = sizeof problems / sizeof problems[0], THREAD_CASES = 2 };

static const int thread_counts[THREAD_CASES] = {1, 6};

/* A problem whose memory, threads and instruction set are the test's. */
static factored_t make_problem(int which, int threads, sl_isa isa, counter_t *counter, int *calls) {
    gen_list_t t = gen_make(problems[which].kind, problems[which].size, 1, 42);
    factored_t y = {gen_store(&t, gen_style(0), 1), NULL, NULL};
    sl_options opt = options_counted(counter);
    SL_CHECK(sl_symbolic_create(&y.S, &y.M.view, &opt, NULL));
    opt.isa = isa;
    opt.pivots = problems[which].kind == GEN_KKT ? SL_PIVOTS_NONZERO : SL_PIVOTS_SKIP_NULL;
    opt.threads.count = threads;
    opt.threads.run = run_backwards;
    opt.threads.context = calls;
    SL_CHECK(sl_factor_create(&y.F, y.S, &y.M.view, &opt, NULL));
    gen_list_free(&t);
    return y;
}

static sl_work *make_work(counter_t *counter) {
    const sl_options opt = options_counted(counter);
    sl_work *W = NULL;
    SL_CHECK(sl_work_create(&W, &opt));
    return W;
}

typedef void (*body_t)(const factored_t *y, int threads, counter_t *counter);

static void for_each_subject(body_t body) {
    const isa_list_t isas = isas_present();
    for (int k = 0; k < isas.count; k++) {
        for (int which = 0; which < PROBLEMS; which++) {
            for (int t = 0; t < THREAD_CASES; t++) {
                counter_t counter = counter_make();
                int calls = 0;
                factored_t y = make_problem(which, thread_counts[t], isas.isa[k], &counter, &calls);
                body(&y, thread_counts[t], &counter);
                factored_free(&y);
                COUNTER_CLEAN(&counter);
            }
        }
    }
}

/* ---- the calls ---- */

static sl_int smaller(sl_int a, sl_int b) {
    return a < b ? a : b;
}

/* All calls for entries of the set in `rows` and in the pairs of it with `columns`. */
static void entries_of(const factored_t *y, const sl_int *rows, const sl_int *columns, sl_int count,
                       double *out, sl_work *W) {
    SL_CHECK(sl_inverse_diagonal(y->F, out, rows, count, W, NULL));
    SL_CHECK(sl_inverse_pairs(y->F, out, rows, columns, count, W, NULL));
    if (count == y->M.view.n_cols) {
        SL_CHECK(sl_inverse_diagonal(y->F, out, NULL, SL_ALL, W, NULL));
    }
}

static void entries(const factored_t *y, int threads, counter_t *counter) {
    static const sl_int counts[] = {1, 2, 3, 7, 40, 300, INT32_MAX};
    const sl_int n = y->M.view.n_cols;
    sl_int *rows = test_ints((size_t)n), *columns = test_ints((size_t)n);
    double *out = test_reals((size_t)n);
    uint64_t seed = 5;
    (void)threads;
    for (size_t c = 0; c < sizeof counts / sizeof counts[0] && n > 0; c++) {
        const sl_int count = smaller(counts[c], n);
        for (int set = 0; set < 2 * SETS; set++) {
            sl_work *W = make_work(counter), *trial = make_work(counter);
            make_rows(rows, count, n, set / 2, &seed);
            if (set % 2 == 0) {
                make_columns(columns, rows, count, &y->M.view);
            } else {
                random_rows(columns, count, n, &seed);
            }
            entries_of(y, rows, columns, count, out, trial);
            SL_CHECK(sl_work_reserve(W, sl_work_bytes(trial)));
            const size_t calls = counter->calls;
            entries_of(y, rows, columns, count, out, W);
            entries_of(y, rows, columns, count, out, trial);
            assert_int_equal(counter->calls, calls);
            sl_work_free(W);
            sl_work_free(trial);
        }
    }
    free(rows);
    free(columns);
    free(out);
}

static void inverse_calls_allocate_nothing(void **state) {
    (void)state;
    for_each_subject(entries);
}

static void blocks(const factored_t *y, int threads, counter_t *counter) {
    static const sl_int sizes[][2] = {{1, 1}, {1, 9}, {3, 2}, {8, 8}, {20, 130}, {150, 140}};
    const sl_int n = y->M.view.n_cols;
    sl_int *rows = test_ints(150), *columns = test_ints(150);
    double *Z = test_reals(150 * 150);
    uint64_t seed = 6;
    for (size_t c = 0; c < sizeof sizes / sizeof sizes[0] && n > 0 && threads == 1; c++) {
        const sl_int n_rows = sizes[c][0], n_columns = sizes[c][1];
        const sl_int both = smaller(n_rows, n_columns);
        for (int set = 0; set < SETS; set++) {
            sl_work *W = make_work(counter);
            make_rows(rows, n_rows, n, set, &seed);
            make_rows(columns, n_columns, n, 2, &seed);
            RESERVE_FOR(
                W, NULL,
                sl_inverse_block(y->F, Z, 150, rows, n_rows, columns, n_columns, trial, NULL));
            RESERVE_FOR(W, NULL,
                        sl_inverse_block(y->F, Z, 150, rows, both, rows, both, trial, NULL));
            const size_t calls = counter->calls;
            SL_CHECK(sl_inverse_block(y->F, Z, 150, rows, n_rows, columns, n_columns, W, NULL));
            SL_CHECK(sl_inverse_block(y->F, Z, 150, rows, both, rows, both, W, NULL));
            assert_int_equal(counter->calls, calls);
            sl_work_free(W);
        }
    }
    free(rows);
    free(columns);
    free(Z);
}

static void blocks_allocate_nothing(void **state) {
    (void)state;
    for_each_subject(blocks);
}

static void selected(const factored_t *y, int threads, counter_t *counter) {
    const sl_int n = y->M.view.n_cols, count = smaller(n, 30);
    sl_int *rows = test_ints(30);
    sl_options opt = options_counted(counter);
    uint64_t seed = 8;
    (void)threads;
    for (int set = -1; set < (n > 0 ? SETS : 0); set++) {
        sl_selected *Z = NULL;
        sl_work *W = make_work(counter);
        if (set >= 0) {
            make_rows(rows, count, n, set, &seed);
        }
        SL_CHECK(sl_selected_create(&Z, y->F, set < 0 ? NULL : rows, set < 0 ? SL_ALL : count, &opt,
                                    NULL));
        RESERVE_FOR(W, NULL, sl_selected_refactor(Z, y->F, trial));
        const size_t calls = counter->calls;
        SL_CHECK(sl_selected_refactor(Z, y->F, W));
        assert_int_equal(counter->calls, calls);
        sl_work_free(W);
        sl_selected_free(Z);
    }
    free(rows);
}

static void selected_inverses_allocate_nothing(void **state) {
    (void)state;
    for_each_subject(selected);
}

static void regions(const factored_t *y, int threads, counter_t *counter) {
    const sl_int n = y->M.view.n_cols, count = smaller(n, 30);
    sl_int *rows = test_ints(30);
    sl_options opt = options_counted(counter);
    sl_selected *Z = NULL;
    uint64_t seed = 9;
    (void)threads;
    SL_CHECK(sl_selected_create(&Z, y->F, NULL, SL_ALL, &opt, NULL));
    for (int set = 0; set < SETS && n > 0; set++) {
        for (int copies = 0; copies < 2; copies++) {
            sl_region *R = NULL;
            sl_work *W = make_work(counter);
            make_rows(rows, count, n, set, &seed);
            SL_CHECK(sl_region_create(&R, y->F, rows, count, copies ? Z : NULL, &opt, NULL));
            RESERVE_FOR(W, NULL, sl_region_refactor(R, y->F, NULL, trial));
            const size_t calls = counter->calls;
            SL_CHECK(sl_region_refactor(R, y->F, NULL, W));
            SL_CHECK(sl_region_refactor(R, y->F, Z, W));
            assert_int_equal(counter->calls, calls);
            sl_work_free(W);
            sl_region_free(R);
        }
    }
    sl_selected_free(Z);
    free(rows);
}

static void regions_allocate_nothing(void **state) {
    (void)state;
    for_each_subject(regions);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(inverse_calls_allocate_nothing),
        cmocka_unit_test(blocks_allocate_nothing),
        cmocka_unit_test(selected_inverses_allocate_nothing),
        cmocka_unit_test(regions_allocate_nothing),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

/* test_change_refused.c: a refused change of a factor, after any history, leaves it as before */
#include "tests/lib/changed.h"
#include "tests/lib/saved_pair.h"

enum { N = 60, MOST = 9 };

/* What has happened to a factor before. */
enum { FRESH, CHANGED, LOADED, MAPPED, HISTORIES };

typedef struct subject_t {
    factored_t y;
    sl_symbolic *S;
    sl_factor *F; /* the factor that is changed */
    double *memory;
    sl_factor *owned; /* of a load */
} subject_t;

/* A path whose first row gets a heavy entry and loses it, and a factor that has followed. */
static subject_t subject_make(int history, double growth_limit) {
    subject_t s;
    sl_options opt = options_none();
    const sl_int row = 0;
    const double up = 1e6, down = -1e6;
    memset(&s, 0, sizeof s);
    opt.growth_limit = growth_limit;
    s.y = factored_make(GEN_PATH, N, 1, 0, &opt);
    s.S = s.y.S;
    s.F = s.y.F;
    if (history != FRESH) {
        SL_CHECK(sl_factor_change_entries(s.F, NULL, &row, &row, &up, 1, NULL, NULL));
        SL_CHECK(sl_factor_change_entries(s.F, NULL, &row, &row, &down, 1, NULL, NULL));
    }
    if (history == LOADED || history == MAPPED) {
        size_t bytes;
        SL_CHECK(pair_save_memory(NULL, &bytes, s.S, s.F));
        s.memory = test_reals(bytes / 8 + 8);
        void *at = (char *)s.memory + (64 - (uintptr_t)s.memory % 64) % 64;
        SL_CHECK(pair_save_memory(at, &bytes, s.S, s.F));
        SL_CHECK(history == LOADED
                     ? pair_load_memory(&s.S, &s.owned, at, bytes, SL_LOAD_VERIFIED, NULL)
                     : pair_map_memory(&s.S, &s.owned, at, bytes, SL_LOAD_VERIFIED, NULL));
        s.F = s.owned;
    }
    return s;
}

static void subject_free(subject_t *s) {
    if (s->owned != NULL) {
        sl_factor_free(s->owned);
        sl_symbolic_free(s->S);
    }
    factored_free(&s->y);
    free(s->memory);
}

/* Everything that is saved of a factor, and a solution. */
typedef struct image_t {
    double *bytes, x[N];
    size_t size;
} image_t;

static image_t image_make(const subject_t *s) {
    image_t m;
    double b[N];
    gen_reals(b, N, 7);
    SL_CHECK(pair_save_memory(NULL, &m.size, s->S, s->F));
    m.bytes = test_reals(m.size / 8 + 1);
    SL_CHECK(pair_save_memory(m.bytes, &m.size, s->S, s->F));
    SL_CHECK(sl_factor_solve(s->F, m.x, N, b, N, 1, NULL));
    return m;
}

/* Makes refused call number k. Returns SL_OK after the last one. */
static sl_status refused_call(const subject_t *s, int k) {
    static const sl_int far[2] = {0, N - 1};
    const sl_csc *A = &s->y.M.view;
    const sl_int first = 0, beyond = N;
    const double huge = 1e300, nan = NAN, delta = 1e3, less = -1e9, one[2] = {1.0, 1.0};
    sl_int q[MOST + 1], rows[MOST];
    double x[MOST], sigma[MOST];
    const sl_int pair[2] = {0, 2};
    const sl_csc V = {N, k % 3 == 0 ? 1 : k % 3 == 1 ? 3 : MOST, q, rows, x};
    const sl_csc W = {N, 1, pair, far, one}, small = {N - 1, N - 1, A->p, A->i, A->x};
    sl_csc other = *A;
    for (sl_int v = 0; v < MOST; v++) {
        q[v] = rows[v] = v;
        x[v] = k < 9 && k >= 6 ? 1e200 : 1.0;
        sigma[v] = v == (k + 1) % V.n_cols ? -1e9 : 1.0; /* not definite */
        sigma[v] = k >= 3 ? 1.0 : sigma[v];
        sigma[v] = k >= 3 && k < 6 && v == 0 ? NAN : sigma[v];
    }
    q[MOST] = MOST;
    if (k < 9) { /* downdates, weights that are not finite, overflows */
        return sl_factor_rank_update(s->F, &V, sigma, NULL, NULL);
    }
    switch (k) {
    case 9:
        return sl_factor_rank_update(s->F, &W, NULL, NULL, NULL); /* outside of L */
    case 10:
        return sl_factor_change_entries(s->F, NULL, &beyond, &first, &delta, 1, NULL, NULL);
    case 11:
        return sl_factor_change_entries(s->F, NULL, &first, &first, &nan, 1, NULL, NULL);
    case 12:
        return sl_factor_change_entries(s->F, NULL, &first, &first, &less, 1, NULL, NULL);
    case 13:
        return sl_factor_change_entries(s->F, NULL, far, far + 1, &huge, 1, NULL, NULL);
    case 14:
        return sl_factor_change_entries(s->F, &small, &first, &first, &delta, 1, NULL, NULL);
    case 15:
        return sl_factor_change_entries(s->F, A, &first, &first, &nan, 1, NULL, NULL);
    case 16:
        return sl_factor_change_entries(s->F, A, NULL, &beyond, NULL, 1, NULL, NULL);
    case 17:
        return sl_factor_change_entries(s->F, &small, NULL, &first, NULL, 1, NULL, NULL);
    case 18:
        other.i = test_ints((size_t)A->p[N]);
        memset((sl_int *)(uintptr_t)other.i, 0, (size_t)A->p[N] * sizeof *other.i);
        {
            const sl_status status = sl_factor_refactor(s->F, &other, NULL);
            free((sl_int *)(uintptr_t)other.i);
            return status;
        }
    default:
        return SL_OK;
    }
}

static void refused_calls_change_nothing(void **state) {
    (void)state;
    for (int history = FRESH; history < HISTORIES; history++) {
        subject_t s = subject_make(history, history % 2 ? 1e12 : 0.0);
        image_t before = image_make(&s);
        for (int k = 0; k < 19; k++) {
            assert_int_not_equal(refused_call(&s, k), SL_OK);
            image_t after = image_make(&s);
            assert_memory_equal(before.bytes, after.bytes, before.size);
            assert_memory_equal(before.x, after.x, sizeof before.x);
            free(after.bytes);
        }
        free(before.bytes);
        subject_free(&s);
    }
}

/* The drift of a saved factor is growth once it is loaded. Where that is above the limit, no change
 * is made, and sl_factor_change_entries refactors. */
static void the_drift_of_a_loaded_factor_is_refused(void **state) {
    (void)state;
    const double up = 1e6;
    const sl_int row = 0;
    sl_stats stats;
    subject_t s = subject_make(LOADED, 1e4);
    image_t before = image_make(&s);
    SL_EXPECT(SL_ERR_INACCURATE,
              sl_factor_change_entries(s.F, NULL, &row, &row, &up, 1, NULL, &stats));
    assert_int_equal(stats.error.row, 0);
    image_t after = image_make(&s);
    assert_memory_equal(before.bytes, after.bytes, before.size);
    SL_CHECK(sl_factor_change_entries(s.F, &s.y.M.view, &row, &row, &up, 1, NULL, &stats));
    assert_int_equal(stats.change.method, SL_CHANGE_REFACTOR);
    free(before.bytes);
    free(after.bytes);
    subject_free(&s);
}

/* Where a change has lost too much and the matrix cannot replace it, the factor has no numbers. */
static void a_lost_matrix_is_not_solved(void **state) {
    (void)state;
    const sl_int rows[1] = {0};
    const double up = 1e7, down = -1e7;
    double b[N] = {1.0}, x[N];
    subject_t s = subject_make(FRESH, 0.0);
    sl_csc other = s.y.M.view;
    sl_int *i = test_ints((size_t)other.p[N]);
    other.i = i;
    SL_CHECK(sl_factor_change_entries(s.F, &other, rows, rows, &up, 1, NULL, NULL));
    SL_EXPECT(SL_ERR_OTHER_PATTERN,
              sl_factor_change_entries(s.F, &other, rows, rows, &down, 1, NULL, NULL));
    SL_EXPECT(SL_ERR_STALE, sl_factor_solve(s.F, x, N, b, N, 1, NULL));
    SL_CHECK(sl_factor_refactor(s.F, &s.y.M.view, NULL));
    free(i);
    subject_free(&s);
}

enum { SIDE = 300, MANY = SIDE * SIDE, COUNT = 8 };

/* A grid whose L has more entries on the paths of eight vectors than a log of one pass may have:
 * they are tried before. The first vector is at `row`, the others change next to nothing. */
typedef struct large_t {
    factored_t y;
    sl_int p[COUNT + 1], rows[COUNT];
    double x[COUNT], sigma[COUNT], *D; /* the pivots before */
    sl_csc V;
} large_t;

static void large_make(large_t *t) {
    t->y = factored_make(GEN_GRID2, MANY, 1, 0, NULL);
    t->D = test_reals(MANY);
    memcpy(t->D, sl_factor_view(t->y.F).D, MANY * sizeof *t->D);
    for (sl_int k = 0; k < COUNT; k++) {
        t->p[k] = k;
        t->rows[k] = k * (MANY / COUNT) + 77;
        t->x[k] = 1.0;
        t->sigma[k] = -1e-9;
    }
    t->p[COUNT] = COUNT;
    const sl_csc V = {MANY, COUNT, t->p, t->rows, t->x};
    t->V = V;
}

static void large_free(large_t *t) {
    factored_free(&t->y);
    free(t->D);
}

/* The change with allocation k failing; *count := the allocations. On failure no pivot changes. */
static sl_status large_change(large_t *t, int64_t k, size_t *count, sl_stats *stats) {
    counter_t counter = counter_make();
    sl_work *W = work_failing(&counter, k);
    const size_t before = counter.calls;
    const sl_status status = sl_factor_rank_update(t->y.F, &t->V, t->sigma, W, stats);
    *count = counter.calls - before;
    sl_work_free(W);
    COUNTER_CLEAN(&counter);
    if (status != SL_OK) {
        assert_memory_equal(sl_factor_view(t->y.F).D, t->D, MANY * sizeof *t->D);
    }
    return status;
}

/* A trial has the rounding of the pass: where it takes the last pivot to 1e-5 of it, the change
 * needs no more memory than elsewhere. */
static void a_close_trial_is_enough(void **state) {
    (void)state;
    large_t t;
    sl_stats stats;
    large_make(&t);
    const sl_int last = sl_symbolic_view(t.y.S).perm[MANY - 1];
    double *b = test_reals(MANY), *z = test_reals(MANY);
    size_t allocations[2] = {0, 0};
    t.rows[0] = last;
    b[last] = 1.0;
    SL_CHECK(sl_factor_solve(t.y.F, z, MANY, b, MANY, 1, NULL));
    for (int close = 0; close < 2; close++) {
        t.sigma[0] = -(close ? 1.0 - 1e-5 : 0.5) / z[last];
        for (int64_t k = 0; k < (int64_t)allocations[0]; k++) {
            size_t count = 0;
            SL_EXPECT(SL_ERR_MEMORY, large_change(&t, k, &count, NULL));
        }
        SL_CHECK(large_change(&t, -1, &allocations[close], &stats));
        assert_true(stats.change.entries > 1 << 19);
        SL_CHECK(sl_factor_solve(t.y.F, b, MANY, b, MANY, 1, NULL));
        const double wanted = z[last] / (close ? 1e-5 : 0.5);
        assert_true(fabs(b[last] - wanted) <= 1e-4 * wanted);
        SL_CHECK(sl_factor_refactor(t.y.F, &t.y.M.view, NULL));
        memset(b, 0, MANY * sizeof *b);
        b[last] = 1.0;
    }
    assert_int_equal(allocations[1], allocations[0]);
    free(b);
    free(z);
    large_free(&t);
}

/* A trial that ends in the first tile of a wide supernode. */
static void a_trial_may_fail(void **state) {
    (void)state;
    large_t t;
    sl_stats stats;
    large_make(&t);
    const sl_symbolic_arrays v = sl_symbolic_view(t.y.S);
    const sl_int first = v.super_first[v.n_supers - 1];
    size_t count = 0;
    assert_true(v.super_first[v.n_supers] - first > 16);
    t.rows[0] = v.perm[first];
    t.sigma[0] = -1.5 * t.D[first];
    SL_EXPECT(SL_ERR_PIVOT, large_change(&t, -1, &count, &stats));
    assert_int_equal(stats.error.row, v.perm[first]);
    t.sigma[0] = -0.5 * t.D[first];
    SL_CHECK(large_change(&t, -1, &count, &stats));
    assert_true(fabs(sl_factor_view(t.y.F).D[first] - 0.5 * t.D[first]) <= 1e-6 * t.D[first]);
    large_free(&t);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(refused_calls_change_nothing),
        cmocka_unit_test(the_drift_of_a_loaded_factor_is_refused),
        cmocka_unit_test(a_lost_matrix_is_not_solved),
        cmocka_unit_test(a_close_trial_is_enough),
        cmocka_unit_test(a_trial_may_fail),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

/* test_change_use.c: sl_factor_rank_update, sl_factor_change_entries: what is refused and leaves F
 * as it was */
#include "tests/lib/changed.h"
#include "tests/lib/saved_pair.h"

typedef struct kept_t {
    double *L, *D;
    size_t size, n;
} kept_t;

static kept_t keep(const sl_factor *F) {
    sl_factor_arrays v = sl_factor_view(F);
    kept_t k = {NULL, NULL, (size_t)panel_doubles(F), (size_t)sl_symbolic_view(v.symbolic).n};
    k.L = test_reals(k.size);
    k.D = test_reals(k.n);
    memcpy(k.L, v.L, k.size * sizeof(double));
    memcpy(k.D, v.D, k.n * sizeof(double));
    return k;
}

static void assert_kept(kept_t *k, const sl_factor *F) {
    assert_memory_equal(k->L, sl_factor_view(F).L, k->size * sizeof(double));
    assert_memory_equal(k->D, sl_factor_view(F).D, k->n * sizeof(double));
    free(k->L);
    free(k->D);
}

static void a_lost_definiteness_is_refused_and_undone(void **state) {
    (void)state;
    isa_list_t isas = isas_present();
    for (int sign = -1; sign <= 1; sign += 2) {
        for (int k = 0; k < 2 * isas.count; k++) {
            sl_options opt = options_none();
            opt.isa = isas.isa[k / 2];
            changed_t c = changed_make(GEN_GRID2, 200, sign, &opt);
            sl_int n = c.y.M.view.n_cols, rows[16], columns[16];
            double deltas[16];
            sl_stats stats, before;
            before.factor = sl_factor_view(c.y.F).info;
            kept_t kept = keep(c.y.F);
            sl_int many = k % 2 ? 16 : 1; /* one pass that fails, or a second one */
            for (sl_int m = 0; m < many; m++) {
                rows[m] = columns[m] = 11 * m;
                deltas[m] = m + 1 < many ? -0.01 * sign : -1000.0 * sign;
            }
            SL_EXPECT(SL_ERR_PIVOT, sl_factor_change_entries(c.y.F, NULL, rows, columns, deltas,
                                                             many, NULL, &stats));
            assert_true(stats.error.row >= 0 && stats.error.row < n);
            assert_true(stats.error.value * sign < 0.0);
            assert_kept(&kept, c.y.F);
            stats.factor = sl_factor_view(c.y.F).info;
            assert_memory_equal(&stats.factor, &before.factor, sizeof stats.factor);
            changed_free(&c);
        }
    }
}

/* A Laplacian with one spring to the ground becomes singular without it. */
static void a_factor_that_becomes_singular_is_refused(void **state) {
    (void)state;
    for (sl_int side = 3; side < 30; side += 4) {
        gen_list_t t = gen_list(side * side);
        uint64_t seed = 7;
        gen_edges_grid(&t, side, side, 1, &seed);
        gen_laplacian(&t);
        sl_int anchor = side + 1;
        gen_add(&t, anchor, anchor, 1.0);
        gen_matrix_t M = gen_store(&t, gen_style(0), 1);
        sl_symbolic *S = NULL;
        sl_factor *F = NULL;
        SL_CHECK(sl_symbolic_create(&S, &M.view, NULL, NULL));
        SL_CHECK(sl_factor_create(&F, S, &M.view, NULL, NULL));
        double minus = -1.0;
        kept_t kept = keep(F);
        SL_EXPECT(SL_ERR_PIVOT,
                  sl_factor_change_entries(F, NULL, &anchor, &anchor, &minus, 1, NULL, NULL));
        assert_kept(&kept, F);
        sl_factor_free(F);
        sl_symbolic_free(S);
        gen_matrix_free(&M);
        gen_list_free(&t);
    }
}

/* A downdate is tried first, by 1 to 8 vectors in a pass. What is tried and refused leaves F; what
 * is tried and taken is undone by an update. */
static void a_downdate_is_tried_first(void **state) {
    (void)state;
    enum { N = 210, MOST = 8 };
    isa_list_t isas = isas_present();
    for (int k = 0; k < MOST * isas.count; k++) {
        const sl_int count = k % MOST + 1;
        sl_int rows[MOST];
        double up[MOST], down[MOST], away[MOST];
        sl_options opt = options_none();
        opt.isa = isas.isa[k / MOST];
        changed_t c = changed_make(GEN_DENSE, N, 1, &opt);
        const double *D = sl_factor_view(c.y.F).D;
        double before[N];
        memcpy(before, D, sizeof before);
        for (sl_int m = 0; m < count; m++) {
            rows[m] = 26 * m + 5;
            up[m] = 0.25 * c.dense[rows[m] * (N + 1)];
            down[m] = -up[m];
            away[m] = m + 1 < count ? -up[m] : -8.0 * up[m];
        }
        sl_stats stats;
        kept_t kept = keep(c.y.F);
        SL_EXPECT(SL_ERR_PIVOT,
                  sl_factor_change_entries(c.y.F, NULL, rows, rows, away, count, NULL, &stats));
        assert_true(stats.error.row >= 0 && stats.error.value < 0.0);
        assert_kept(&kept, c.y.F);
        SL_CHECK(sl_factor_change_entries(c.y.F, NULL, rows, rows, down, count, NULL, NULL));
        assert_true(D[N - 1] < before[N - 1]);
        SL_CHECK(sl_factor_change_entries(c.y.F, NULL, rows, rows, up, count, NULL, NULL));
        for (sl_int m = 0; m < N; m++) {
            assert_true(fabs(D[m] - before[m]) <= 1e-12 * before[m]);
        }
        changed_free(&c);
    }
}

static void invalid_changes_are_refused(void **state) {
    (void)state;
    changed_t c = changed_make(GEN_PATH, 50, 1, NULL);
    sl_factor *F = c.y.F;
    sl_stats stats;
    kept_t kept = keep(F);
    sl_int i[2] = {3, 40}, j[2] = {3, 3}, below = -1, above = 50;
    double d[2] = {1.0, 1.0}, nan = NAN, one = 1.0;
    SL_EXPECT(SL_ERR_ARGUMENT, sl_factor_change_entries(NULL, NULL, i, j, d, 1, NULL, NULL));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_factor_change_entries(F, NULL, NULL, j, d, 1, NULL, NULL));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_factor_change_entries(F, NULL, i, NULL, d, 1, NULL, NULL));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_factor_change_entries(F, NULL, i, j, NULL, 1, NULL, NULL));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_factor_change_entries(F, NULL, i, j, d, -1, NULL, NULL));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_factor_change_entries(F, NULL, &below, j, d, 1, NULL, &stats));
    assert_int_equal(stats.error.row, -1);
    SL_EXPECT(SL_ERR_ARGUMENT, sl_factor_change_entries(F, NULL, i, &above, d, 1, NULL, &stats));
    assert_int_equal(stats.error.column, 50);
    SL_EXPECT(SL_ERR_NOT_FINITE, sl_factor_change_entries(F, NULL, i, j, &nan, 1, NULL, &stats));
    assert_int_equal(stats.error.row, 3);
    SL_EXPECT(SL_ERR_OTHER_PATTERN, sl_factor_change_entries(F, NULL, i, j, d, 2, NULL, &stats));
    assert_true((stats.error.row == 3 && stats.error.column == 40) ||
                (stats.error.row == 40 && stats.error.column == 3));
    sl_int p[2] = {0, 1}, row = 3, bad[2] = {0, -1};
    sl_csc V = {50, 1, p, &row, &one}, W = V;
    SL_EXPECT(SL_ERR_ARGUMENT, sl_factor_rank_update(F, NULL, NULL, NULL, NULL));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_factor_rank_update(NULL, &V, NULL, NULL, NULL));
    SL_EXPECT(SL_ERR_NOT_FINITE, sl_factor_rank_update(F, &V, &nan, NULL, NULL));
    W.x = &nan;
    SL_EXPECT(SL_ERR_NOT_FINITE, sl_factor_rank_update(F, &W, NULL, NULL, &stats));
    assert_int_equal(stats.error.row, 3);
    W.x = NULL;
    SL_EXPECT(SL_ERR_ARGUMENT, sl_factor_rank_update(F, &W, NULL, NULL, NULL));
    W = V;
    W.n_rows = 51;
    SL_EXPECT(SL_ERR_ARGUMENT, sl_factor_rank_update(F, &W, NULL, NULL, NULL));
    W = V;
    W.p = bad;
    SL_EXPECT(SL_ERR_MALFORMED, sl_factor_rank_update(F, &W, NULL, NULL, NULL));
    W = V;
    W.i = &above;
    SL_EXPECT(SL_ERR_MALFORMED, sl_factor_rank_update(F, &W, NULL, NULL, NULL));
    assert_kept(&kept, F);
    kept = keep(F);
    double large = 1e300;
    SL_EXPECT(SL_ERR_NOT_FINITE,
              sl_factor_rank_update(F, ((W = V), (W.x = &large), &W), NULL, NULL, NULL));
    assert_kept(&kept, F);
    SL_CHECK(sl_factor_rank_update(F, &V, NULL, NULL, NULL));
    changed_free(&c);
}

static void null_pivots_are_unsupported(void **state) {
    (void)state;
    sl_options opt = options_none();
    opt.pivots = SL_PIVOTS_SKIP_NULL;
    gen_list_t t = gen_list(25);
    uint64_t seed = 7;
    gen_edges_grid(&t, 5, 5, 1, &seed);
    gen_laplacian(&t);
    gen_matrix_t M = gen_store(&t, gen_style(0), 1);
    sl_symbolic *S = NULL;
    sl_factor *F = NULL;
    SL_CHECK(sl_symbolic_create(&S, &M.view, NULL, NULL));
    SL_CHECK(sl_factor_create(&F, S, &M.view, &opt, NULL));
    sl_int i = 3;
    double d = 1.0;
    SL_EXPECT(SL_ERR_UNSUPPORTED, sl_factor_change_entries(F, NULL, &i, &i, &d, 1, NULL, NULL));
    sl_factor_free(F);
    sl_symbolic_free(S);
    gen_matrix_free(&M);
    gen_list_free(&t);
}

/* A region of the old numbers is refused, a plan without one is not. */
static void regions_of_the_old_numbers_are_refused(void **state) {
    (void)state;
    changed_t c = changed_make(GEN_GRID2, 400, 1, NULL);
    sl_region *R = NULL;
    sl_plan *inside = NULL, *whole = NULL;
    sl_int set[3] = {0, 1, 2}, i = 3;
    double b[3] = {1.0, 2.0, 3.0}, x[3], wanted[400], full[400], d = 2.0;
    sl_options opt = options_none();
    SL_CHECK(sl_region_create(&R, c.y.F, set, 3, NULL, NULL, NULL));
    opt.region = R;
    SL_CHECK(sl_plan_create(&inside, c.y.S, set, 3, set, 3, &opt, NULL));
    SL_CHECK(sl_plan_create(&whole, c.y.S, set, 3, set, 3, NULL, NULL));
    SL_CHECK(sl_plan_solve(inside, c.y.F, x, 3, b, 3, 1, NULL));
    SL_CHECK(sl_factor_change_entries(c.y.F, NULL, &i, &i, &d, 1, NULL, NULL));
    SL_EXPECT(SL_ERR_STALE, sl_plan_solve(inside, c.y.F, x, 3, b, 3, 1, NULL));
    SL_CHECK(sl_plan_solve(whole, c.y.F, x, 3, b, 3, 1, NULL));
    memset(full, 0, sizeof full);
    memcpy(full, b, sizeof b);
    SL_CHECK(sl_factor_solve(c.y.F, wanted, 400, full, 400, 1, NULL));
    assert_memory_equal(x, wanted, sizeof x);
    SL_CHECK(sl_region_refactor(R, c.y.F, NULL, NULL));
    SL_CHECK(sl_plan_solve(inside, c.y.F, x, 3, b, 3, 1, NULL));
    sl_plan_free(inside);
    sl_plan_free(whole);
    sl_region_free(R);
    changed_free(&c);
}

/* A mapped factor is refused; a loaded one changes as the one that was saved. */
static void mapped_factors_are_refused(void **state) {
    (void)state;
    changed_t c = changed_make(GEN_GRID2, 100, 1, NULL);
    size_t bytes = 0;
    sl_symbolic *S = NULL;
    sl_factor *F = NULL;
    sl_int i = 3;
    double d = 1.0;
    SL_CHECK(sl_factor_change_entries(c.y.F, NULL, &i, &i, &d, 1, NULL, NULL));
    SL_CHECK(pair_save_memory(NULL, &bytes, c.y.S, c.y.F));
    double *memory = test_reals(bytes / sizeof(double) + 16);
    unsigned char *block = (unsigned char *)memory;
    block += (64 - (uintptr_t)block % 64) % 64;
    SL_CHECK(pair_save_memory(block, &bytes, c.y.S, c.y.F));
    SL_CHECK(pair_map_memory(&S, &F, block, bytes, SL_LOAD_VERIFIED, NULL));
    SL_EXPECT(SL_ERR_READ_ONLY, sl_factor_change_entries(F, NULL, &i, &i, &d, 1, NULL, NULL));
    sl_factor_free(F);
    sl_symbolic_free(S);
    SL_CHECK(pair_load_memory(&S, &F, block, bytes, SL_LOAD_VERIFIED, NULL));
    SL_CHECK(sl_factor_change_entries(F, NULL, &i, &i, &d, 1, NULL, NULL));
    SL_CHECK(sl_factor_change_entries(c.y.F, NULL, &i, &i, &d, 1, NULL, NULL));
    assert_same_bits(F, c.y.F);
    sl_factor_free(F);
    sl_symbolic_free(S);
    free(memory);
    changed_free(&c);
}

/* Allocations fail one after the other: F is as before, and the next call succeeds. */
static void failing_allocations_leave_the_factor(void **state) {
    (void)state;
    counter_t counter = counter_make();
    sl_options opt = options_counted(&counter);
    changed_t c = changed_make(GEN_GRID2, 100, 1, &opt);
    sl_int i[2] = {3, 40};
    double d[2] = {-0.01, 1.0};
    sl_status status = SL_ERR_MEMORY;
    for (int k = 0; status != SL_OK; k++) {
        kept_t kept = keep(c.y.F);
        counter.fail_at = (int64_t)counter.calls + k;
        status = sl_factor_change_entries(c.y.F, NULL, i, i, d, 2, NULL, NULL);
        counter.fail_at = -1;
        if (status != SL_OK) {
            assert_int_equal(status, SL_ERR_MEMORY);
            assert_kept(&kept, c.y.F);
        } else {
            assert_true(k > 1);
            free(kept.L);
            free(kept.D);
        }
    }
    changed_add(&c, 3, 3, d[0]);
    changed_add(&c, 40, 40, d[1]);
    assert_true(changed_error(&c) <= 1e-14);
    changed_free(&c);
    COUNTER_CLEAN(&counter);
}

/* With a workspace that has grown, a change allocates nothing. */
static void a_grown_workspace_is_enough(void **state) {
    (void)state;
    counter_t counter = counter_make();
    sl_options opt = options_counted(&counter);
    changed_t c = changed_make(GEN_GRID2, 400, 1, &opt);
    sl_work *W = NULL;
    SL_CHECK(sl_work_create(&W, &opt));
    sl_int i = 3;
    double d[2] = {1.0, -1.0};
    SL_CHECK(sl_factor_change_entries(c.y.F, NULL, &i, &i, d, 1, W, NULL));
    SL_CHECK(sl_factor_change_entries(c.y.F, NULL, &i, &i, d + 1, 1, W, NULL));
    size_t calls = counter.calls;
    SL_CHECK(sl_factor_change_entries(c.y.F, NULL, &i, &i, d, 1, W, NULL));
    SL_CHECK(sl_factor_change_entries(c.y.F, NULL, &i, &i, d + 1, 1, W, NULL));
    assert_int_equal(counter.calls, calls);
    sl_work_free(W);
    changed_free(&c);
    COUNTER_CLEAN(&counter);
}
int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_lost_definiteness_is_refused_and_undone),
        cmocka_unit_test(a_factor_that_becomes_singular_is_refused),
        cmocka_unit_test(a_downdate_is_tried_first),
        cmocka_unit_test(invalid_changes_are_refused),
        cmocka_unit_test(null_pivots_are_unsupported),
        cmocka_unit_test(regions_of_the_old_numbers_are_refused),
        cmocka_unit_test(mapped_factors_are_refused),
        cmocka_unit_test(failing_allocations_leave_the_factor),
        cmocka_unit_test(a_grown_workspace_is_enough),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

/* test_change_scaled.c: changes of definite matrices whose rows have very different scales */
#include "tests/lib/test.h"

enum { N = 60 };

/* A band of 3, D B D with D = 1, s, 1. */
typedef struct band_t {
    sl_int p[N + 1], i[3 * N];
    double a[3 * N];
    sl_csc view;
    sl_symbolic *S;
    sl_factor *F;
} band_t;

static double scale_of(sl_int j, double s) {
    return j % 3 == 1 ? s : 1.0;
}

static void band_make(band_t *y, double s) {
    sl_int k = 0;
    for (sl_int j = 0; j < N; j++) {
        y->p[j] = k;
        for (sl_int t = 0; t < 3 && j + t < N; t++) {
            y->i[k] = j + t;
            y->a[k++] = (t == 0 ? 5.0 : -1.0) * scale_of(j, s) * scale_of(j + t, s);
        }
    }
    y->p[N] = k;
    y->view.n_rows = y->view.n_cols = N;
    y->view.p = y->p;
    y->view.i = y->i;
    y->view.x = y->a;
    SL_CHECK(sl_symbolic_create(&y->S, &y->view, NULL, NULL));
    SL_CHECK(sl_factor_create(&y->F, y->S, &y->view, NULL, NULL));
}

static void band_free(band_t *y) {
    sl_factor_free(y->F);
    sl_symbolic_free(y->S);
}

/* The largest error of x for b = A (D^-1 1), each relative to its own size: diagonal scaling does
 * not change it. */
static double error_of(const band_t *y, double s) {
    double x[N], b[N], found[N], worst = 0.0;
    for (sl_int j = 0; j < N; j++) {
        x[j] = 1.0 / scale_of(j, s);
    }
    SL_CHECK(sl_csc_multiply(&y->view, SL_AS_SYMMETRIC, b, N, x, N, 1));
    SL_CHECK(sl_factor_solve(y->F, found, N, b, N, 1, NULL));
    for (sl_int j = 0; j < N; j++) {
        worst = fmax(worst, fabs(found[j] / x[j] - 1.0));
    }
    return worst;
}

/* Entries beside the diagonal change by 10 %: rows keep their digits at any scale. */
static void entries_change_by_the_scales_of_their_rows(void **state) {
    (void)state;
    for (int e = 0; e <= 14; e++) {
        for (int both = 0; both < 2; both++) {
            const double s = pow(10.0, -e);
            band_t y;
            sl_int rows[N], columns[N], count = 0;
            double deltas[N];
            sl_stats stats;
            band_make(&y, s);
            for (sl_int j = 0; j + 1 < N && count < 12; j += 2) {
                const sl_int low = both ? j + 1 : j, high = both ? j : j + 1;
                double *a = &y.a[y.p[j] + 1];
                rows[count] = low;
                columns[count] = high;
                deltas[count++] = 0.1 * *a;
                *a += deltas[count - 1];
            }
            SL_CHECK(
                sl_factor_change_entries(y.F, NULL, rows, columns, deltas, count, NULL, &stats));
            assert_true(error_of(&y, s) <= 64.0 * DBL_EPSILON);
            assert_true(stats.change.drift <= 64.0 * DBL_EPSILON);
            band_free(&y);
        }
    }
}

/* Where vectors of the caller add a weight to a small row and subtract it, drift says what is lost,
 * in one call and in two, with one vector and with several. */
static void lost_digits_of_small_rows_are_drift(void **state) {
    (void)state;
    for (int way = 0; way < 4; way++) {
        const double s = 1e-6, one[4] = {1.0, 1.0, 1.0, 1.0};
        const double weights[4] = {1.0, way % 2 ? 1e-9 : 0.0, -1.0, way % 2 ? 1e-9 : 0.0};
        const sl_int p[5] = {0, 1, 2, 3, 4}, rows[4] = {1, 30, 1, 30};
        band_t y;
        sl_stats stats;
        band_make(&y, s);
        if (way < 2) {
            const sl_csc V = {N, 4, p, rows, one};
            SL_CHECK(sl_factor_rank_update(y.F, &V, weights, NULL, &stats));
        } else {
            const sl_csc V = {N, way % 2 ? 2 : 1, p, rows, one};
            SL_CHECK(sl_factor_rank_update(y.F, &V, weights, NULL, NULL));
            SL_CHECK(sl_factor_rank_update(y.F, &V, weights + 2, NULL, &stats));
        }
        const double lost = error_of(&y, s);
        print_message("way %d: error %.1e, drift %.1e\n", way, lost, stats.change.drift);
        assert_true(stats.change.drift >= 0.1 * lost);
        assert_true(stats.change.drift <= 1e-2);
        band_free(&y);
    }
}

/* A weight of 1e10 that falls by steps to nothing: the errors made beside it are drift, and the
 * matrix is factored again. */
static void a_weight_that_rises_and_falls_leaves_no_error(void **state) {
    (void)state;
    const sl_int row = N / 2;
    int refactored = 0;
    sl_stats stats;
    band_t y;
    band_make(&y, 1.0);
    double *a = &y.a[y.p[row]], base = *a;
    for (double weight = 1e10; weight > 0.0; weight = weight < 1.0 ? 0.0 : weight / 2) {
        const double delta = base + weight - *a;
        *a += delta;
        SL_CHECK(sl_factor_change_entries(y.F, &y.view, &row, &row, &delta, 1, NULL, &stats));
        refactored += stats.change.method == SL_CHANGE_REFACTOR;
    }
    const double delta = base - *a;
    *a = base;
    SL_CHECK(sl_factor_change_entries(y.F, &y.view, &row, &row, &delta, 1, NULL, &stats));
    assert_true(refactored > 0);
    assert_true(error_of(&y, 1.0) < 1e-10);
    band_free(&y);
}

/* Changes row `row` of y by delta: by its entry, by one vector, or by one of several. */
static void row_change(band_t *y, int way, sl_int row, double delta, sl_stats *stats) {
    const sl_int p[4] = {0, 1, 2, 3}, rows[3] = {3, row, 50};
    const double ones[3] = {1.0, 1.0, 1.0}, sigma[3] = {1e-9, delta, 1e-9};
    const sl_csc one = {N, 1, p, rows + 1, ones}, three = {N, 3, p, rows, ones};
    y->a[y->p[row]] += delta;
    if (way == 0) {
        SL_CHECK(sl_factor_change_entries(y->F, NULL, &row, &row, &delta, 1, NULL, stats));
    } else if (way == 1) {
        SL_CHECK(sl_factor_rank_update(y->F, &one, sigma + 1, NULL, stats));
    } else {
        SL_CHECK(sl_factor_rank_update(y->F, &three, sigma, NULL, stats));
        y->a[y->p[3]] += 1e-9;
        y->a[y->p[50]] += 1e-9;
    }
}

/* A row of 5 rises to 1e10 and falls by halves beside a row that is always larger: drift is what
 * that row has lost, and what others lose later does not hide it. */
static void each_row_has_its_own_drift(void **state) {
    (void)state;
    const sl_int row = N / 2;
    for (int way = 0; way < 3; way++) {
        sl_stats stats;
        band_t y;
        band_make(&y, 1.0);
        const double base = y.a[y.p[row]];
        y.a[y.p[N - 1]] = 1e11;
        SL_CHECK(sl_factor_refactor(y.F, &y.view, NULL));
        row_change(&y, way, row, 1e10, &stats);
        assert_true(stats.change.drift <= 1e-10);
        for (double *a = &y.a[y.p[row]]; *a > 2.0 * base;) {
            row_change(&y, way, row, -0.5 * (*a - base), &stats);
        }
        const double lost = error_of(&y, 1.0);
        print_message("way %d: error %.1e, drift %.1e\n", way, lost, stats.change.drift);
        assert_true(lost > 1e-9 && stats.change.drift >= 0.1 * lost && stats.change.drift <= 1e-4);
        row_change(&y, way, 3, 1.0, &stats);
        assert_true(stats.change.drift >= 0.1 * lost && stats.change.drift <= 1e-4);
        SL_CHECK(sl_factor_refactor(y.F, &y.view, NULL));
        row_change(&y, way, row, 1.0, &stats);
        assert_true(stats.change.drift <= 1e-14);
        band_free(&y);
    }
}

/* The heavy edge of two rows goes, at once or by halves, while one of them stays heavy or becomes
 * it: the pivot of the other one was never as large as its entry. */
static void a_row_loses_more_than_its_pivot(void **state) {
    (void)state;
    const sl_int p[3] = {0, 2, 3};
    for (int way = 0; way < 6; way++) {
        const sl_int low = N / 2, high = N / 2 + 1, heavy = way % 2 ? low : high;
        const sl_int rows[3] = {low, high, heavy};
        const double values[3] = {1.0, -1.0, 1.0};
        double sigma[2] = {1e10, 1e8}, left = 0.0;
        const int is_late = way / 2 == 2;
        sl_stats stats;
        band_t y;
        band_make(&y, 1.0);
        sl_csc V = {N, is_late ? 1 : 2, p, rows, values};
        SL_CHECK(sl_factor_rank_update(y.F, &V, sigma, NULL, NULL));
        for (left = sigma[0]; left > 0.0; left += sigma[0]) {
            sigma[0] = way / 2 == 1 && left > 1.0 ? -0.5 * left : -left;
            V.n_cols = is_late ? 2 : 1;
            SL_CHECK(sl_factor_rank_update(y.F, &V, sigma, NULL, &stats));
        }
        y.a[y.p[heavy]] += sigma[1];
        const double lost = error_of(&y, 1.0);
        print_message("way %d: error %.1e, drift %.1e\n", way, lost, stats.change.drift);
        assert_true(stats.change.drift >= 0.1 * lost && stats.change.drift <= 1e-4);
        assert_true(stats.change.drift >= 1e-8);
        band_free(&y);
    }
}

/* Rows whose columns are computed again have lost nothing. */
static void what_is_computed_again_is_not_lost(void **state) {
    (void)state;
    const sl_int row = N / 2;
    sl_stats stats;
    band_t y;
    band_make(&y, 1.0);
    row_change(&y, 0, row, 1e10, &stats);
    y.a[y.p[row]] -= 1e10;
    SL_CHECK(sl_factor_change_entries(y.F, &y.view, NULL, &row, NULL, 1, NULL, &stats));
    for (int k = 0; k < 2; k++) {
        row_change(&y, k, row, 1.0, &stats);
        row_change(&y, 2, N - 1, 1.0, &stats);
    }
    assert_true(stats.change.drift <= 1e-13);
    assert_true(error_of(&y, 1.0) <= 1e-14);
    band_free(&y);
}

/* A change of many vectors that is refused leaves no loss behind. */
static void a_refused_change_loses_nothing(void **state) {
    (void)state;
    enum { MANY = 17 };
    sl_int p[MANY + 1], rows[MANY];
    double ones[MANY], sigma[MANY];
    const sl_csc V = {N, MANY, p, rows, ones};
    sl_stats stats;
    band_t y;
    band_make(&y, 1.0);
    for (sl_int k = 0; k < MANY; k++) {
        p[k] = k;
        rows[k] = k;
        ones[k] = 1.0;
        sigma[k] = k == MANY - 1 ? -1e14 : 1e12;
    }
    p[MANY] = MANY;
    SL_EXPECT(SL_ERR_PIVOT, sl_factor_rank_update(y.F, &V, sigma, NULL, NULL));
    for (sl_int k = 0; k < MANY; k++) {
        row_change(&y, 0, k, 1.0, &stats);
    }
    assert_true(stats.change.drift <= 1e-13);
    assert_true(error_of(&y, 1.0) <= 1e-14);
    band_free(&y);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(entries_change_by_the_scales_of_their_rows),
        cmocka_unit_test(lost_digits_of_small_rows_are_drift),
        cmocka_unit_test(a_weight_that_rises_and_falls_leaves_no_error),
        cmocka_unit_test(each_row_has_its_own_drift),
        cmocka_unit_test(a_row_loses_more_than_its_pivot),
        cmocka_unit_test(what_is_computed_again_is_not_lost),
        cmocka_unit_test(a_refused_change_loses_nothing),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

/* test_inverse_growth.c: entries and regions of indefinite factors whose L has grown: what selected
 * inversion would lose is computed by sweeps, or refused */
#include "tests/lib/grid_constraints.h"
#include "tests/lib/parallel_for.h"

static const sl_int n = GRID_ALL;

/* All columns of the inverse by full solves; *most: the largest entry. */
static double *solved_inverse(const sl_factor *F, double *most) {
    const size_t size = GRID_ALL;
    double *X = test_reals(size * size);
    *most = 0.0;
    for (size_t j = 0; j < size; j++) {
        X[j + j * size] = 1.0;
        SL_CHECK(sl_factor_solve(F, X + j * size, size, X + j * size, size, 1, NULL));
    }
    for (size_t k = 0; k < size * size; k++) {
        *most = fmax(*most, fabs(X[k]));
    }
    return X;
}

/* The requests: the pattern of A, then all rows of the diagonal. */
typedef struct requests_t {
    sl_int *rows, *columns, *all, count;
    double *z;
} requests_t;

static requests_t requests_make(const gen_matrix_t *M) {
    const sl_int count = M->p[n];
    requests_t r = {test_ints((size_t)count), test_ints((size_t)count), test_ints((size_t)n), count,
                    test_reals((size_t)(count + n))};
    for (sl_int j = 0; j < n; j++) {
        r.all[j] = j;
        for (sl_int p = M->p[j]; p < M->p[j + 1]; p++) {
            r.rows[p] = M->i[p];
            r.columns[p] = j;
        }
    }
    return r;
}

static void requests_free(requests_t *r) {
    free(r->rows);
    free(r->columns);
    free(r->all);
    free(r->z);
}

static void assert_close(const double *X, const double *z, const sl_int *rows,
                         const sl_int *columns, sl_int count, double allowed) {
    for (sl_int k = 0; k < count; k++) {
        if (!(fabs(z[k] - AT(X, rows[k], columns[k])) <= allowed)) {
            print_error("(%d, %d): %.17g, should be %.17g within %.2g\n", (int)rows[k],
                        (int)columns[k], z[k], AT(X, rows[k], columns[k]), allowed);
            fail();
        }
    }
}

/* Every way to an entry, of which few sweep by themselves. is_lossy: the selected inverse is solved
 * for, column by column. */
static void check_all_ways(const factored_t *y, const double *X, double allowed, int is_lossy) {
    requests_t r = requests_make(&y->M);
    const sl_int count = r.count;
    sl_selected *Z = NULL;
    sl_stats stats;
    SL_CHECK(sl_inverse_diagonal(y->F, r.z, NULL, SL_ALL, NULL, &stats));
    assert_close(X, r.z, r.all, r.all, n, allowed);
    assert_int_equal(stats.inverse.method, is_lossy ? SL_INVERSE_FORWARD : SL_INVERSE_SELECTED);
    SL_CHECK(sl_inverse_diagonal(y->F, r.z, r.all, n, NULL, NULL));
    assert_close(X, r.z, r.all, r.all, n, allowed);
    SL_CHECK(sl_inverse_pairs(y->F, r.z, r.rows, r.columns, count, NULL, NULL));
    assert_close(X, r.z, r.rows, r.columns, count, allowed);
    for (sl_int set = 0; set < n; set += 40) {
        SL_CHECK(sl_selected_create(&Z, y->F, &set, set == 0 ? 0 : 1, NULL, NULL));
        sl_selected_free(Z);
        SL_CHECK(sl_selected_create(&Z, y->F, set == 0 ? NULL : &set, set == 0 ? SL_ALL : 1, NULL,
                                    NULL));
        SL_CHECK(sl_selected_entries(Z, r.z, &set, NULL, 1, NULL));
        assert_close(X, r.z, &set, &set, 1, allowed);
        if (set == 0) {
            SL_CHECK(sl_selected_entries(Z, r.z, r.rows, r.columns, count, NULL));
            assert_close(X, r.z, r.rows, r.columns, count, allowed);
        }
        sl_selected_free(Z);
    }
    requests_free(&r);
}

/* Shifts of 1 to 1e-10 give growths of 2 to 1e10, or small ones beside a large entry, with the same
 * loss. */
static void every_way_to_an_entry_equals_full_solves(void **state) {
    (void)state;
    variant_list_t variants = variants_present();
    for (int k = 0; k < variants.count; k++) {
        for (int kind = 0; kind < GRID_SHIFTS; kind++) {
            for (int digits = 0; digits <= 10; digits += 2) {
                const double shift = pow(10.0, -digits);
                sl_options opt = options_none();
                sl_stats stats;
                double most;
                options_set_variant(&opt, &variants, k);
                factored_t y = grid_factored(shift, (grid_shift_t)kind, opt, &stats);
                double *X = solved_inverse(y.F, &most);
                assert_true(kind != SHIFT_LARGE || stats.factor.growth < 2.0);
                check_all_ways(&y, X, (1e-10 + 100.0 * DBL_EPSILON / shift) * most, digits > 2);
                free(X);
                factored_free(&y);
            }
        }
    }
}

/* ---- regions ---- */

/* Sets of neighbors in the elimination order. */
static void solves_in_regions_are_right_or_refused(void **state) {
    (void)state;
    for (int kind = 0; kind < GRID_SHIFTS; kind++) {
        for (int digits = 0; digits <= 10; digits += 2) {
            sl_stats stats;
            const double shift = pow(10.0, -digits), slack = 1e-8 + 100.0 * DBL_EPSILON / shift;
            factored_t y = grid_factored(shift, (grid_shift_t)kind, options_none(), &stats);
            const sl_int *perm = sl_symbolic_view(y.S).perm;
            double *x = test_reals((size_t)n), *X = test_reals((size_t)n), most;
            double *Z = solved_inverse(y.F, &most);
            sl_selected *selected = NULL;
            int refused = 0;
            SL_CHECK(sl_selected_create(&selected, y.F, NULL, SL_ALL, NULL, NULL));
            for (sl_int count = 5; count < n; count += 9) {
                const sl_int *set = perm + (7 * count) % (n - count);
                sl_options opt = options_none();
                sl_region *R = NULL;
                sl_plan *P = NULL;
                const sl_status status =
                    sl_region_create(&R, y.F, set, count, count % 2 ? selected : NULL, NULL, NULL);
                refused += status == SL_ERR_INACCURATE;
                assert_true(status == SL_OK || (status == SL_ERR_INACCURATE && R == NULL));
                if (status != SL_OK) {
                    continue;
                }
                opt.region = R;
                SL_CHECK(sl_plan_create(&P, y.S, set, count, set, count, &opt, NULL));
                memset(x, 0, (size_t)n * sizeof *x);
                memset(X, 0, (size_t)n * sizeof *X);
                x[0] = X[set[0]] = 1.0;
                SL_CHECK(sl_plan_solve(P, y.F, x, (size_t)n, x, (size_t)n, 1, NULL));
                SL_CHECK(sl_factor_solve(y.F, X, (size_t)n, X, (size_t)n, 1, NULL));
                for (sl_int k = 0; k < count; k++) {
                    assert_true(fabs(x[k] - X[set[k]]) <= slack * most);
                }
                sl_plan_free(P);
                sl_region_free(R);
            }
            assert_true((digits <= 2) == (refused == 0));
            sl_selected_free(selected);
            factored_free(&y);
            free(x);
            free(X);
            free(Z);
        }
    }
}

/* A refused region has no numbers: its plans wait for ones that are good enough. */
static void a_refused_region_takes_other_numbers_later(void **state) {
    (void)state;
    sl_stats stats;
    factored_t good = grid_factored(1.0, SHIFT_DIAGONAL, options_none(), &stats);
    gen_matrix_t M = grid_constraints(1e-9, SHIFT_DIAGONAL);
    const sl_int count = 60, *set = sl_symbolic_view(good.S).perm;
    double b[60] = {1.0}, before[60], after[60];
    sl_options opt = options_none();
    sl_factor *bad = NULL;
    sl_region *R = NULL;
    sl_plan *P = NULL;
    sl_saved_set set_of;
    size_t bytes = 0;
    memset(&set_of, 0, sizeof set_of);
    SL_CHECK(sl_factor_create(&bad, good.S, &M.view, NULL, NULL));
    for (sl_int k = 0;
         k < n - count && sl_region_create(&R, bad, set, count, NULL, NULL, NULL) == SL_OK;
         k++, set++) {
        sl_region_free(R);
    }
    SL_EXPECT(SL_ERR_INACCURATE, sl_region_create(&R, bad, set, count, NULL, NULL, NULL));
    assert_null(R);
    SL_CHECK(sl_region_create(&R, good.F, set, count, NULL, NULL, NULL));
    opt.region = R;
    SL_CHECK(sl_plan_create(&P, good.S, set, count, set, count, &opt, NULL));
    SL_CHECK(sl_plan_solve(P, good.F, before, (size_t)count, b, (size_t)count, 1, NULL));
    SL_EXPECT(SL_ERR_INACCURATE, sl_region_refactor(R, bad, NULL, NULL));
    set_of.symbolic = good.S;
    set_of.factor = good.F;
    set_of.regions = &R;
    set_of.n_regions = 1;
    SL_EXPECT(SL_ERR_STALE, sl_save(NULL, NULL, &bytes, &set_of, NULL));
    SL_EXPECT(SL_ERR_STALE, sl_plan_solve(P, bad, after, (size_t)count, b, (size_t)count, 1, NULL));
    SL_EXPECT(SL_ERR_STALE,
              sl_plan_solve(P, good.F, after, (size_t)count, b, (size_t)count, 1, NULL));
    SL_CHECK(sl_region_refactor(R, good.F, NULL, NULL));
    SL_CHECK(sl_plan_solve(P, good.F, after, (size_t)count, b, (size_t)count, 1, NULL));
    assert_memory_equal(before, after, sizeof before);
    sl_plan_free(P);
    sl_region_free(R);
    sl_factor_free(bad);
    gen_matrix_free(&M);
    factored_free(&good);
}

/* ---- memory ---- */

static sl_status call(int which, const factored_t *y, const requests_t *r, sl_selected *Z,
                      sl_region *R, sl_work *W) {
    switch (which) {
    case 0:
        return sl_inverse_diagonal(y->F, r->z, NULL, SL_ALL, W, NULL);
    case 1:
        return sl_inverse_pairs(y->F, r->z, r->rows, r->columns, r->count, W, NULL);
    case 2:
        return sl_selected_refactor(Z, y->F, W);
    default:
        return sl_region_refactor(R, y->F, NULL, W);
    }
}

/* Each allocation fails once; a workspace that has grown is large enough. */
static void every_allocation_may_fail(void **state) {
    (void)state;
    for (int digits = 0; digits <= 8; digits += 8) {
        counter_t counter = counter_make();
        sl_options opt = options_counted(&counter);
        const sl_options kept = opt;
        sl_stats stats;
        factored_t y = grid_factored(pow(10.0, -digits), SHIFT_DIAGONAL, opt, &stats);
        requests_t r = requests_make(&y.M);
        sl_selected *Z = NULL;
        sl_region *R = NULL;
        /* beside no pivot that is small */
        const sl_int last = sl_symbolic_view(y.S).perm[n - 30];
        SL_CHECK(sl_selected_create(&Z, y.F, NULL, SL_ALL, &kept, NULL));
        SL_CHECK(sl_region_create(&R, y.F, &last, 1, NULL, &kept, NULL));
        for (int which = 0; which < 8; which++) {
            sl_status status = SL_ERR_MEMORY;
            sl_work *W = NULL;
            for (int64_t k = 0; status != SL_OK; k++) {
                sl_work_free(W);
                W = which % 2 ? NULL : work_failing(&counter, k);
                counter.fail_at = (int64_t)counter.calls + k;
                status = call(which / 2, &y, &r, Z, R, W);
                counter.fail_at = -1;
                assert_true(status == SL_OK || status == SL_ERR_MEMORY);
            }
            const size_t grown = counter.calls;
            if (W != NULL) {
                SL_CHECK(call(which / 2, &y, &r, Z, R, W));
                assert_int_equal(counter.calls, grown);
            }
            sl_work_free(W);
        }
        sl_region_free(R);
        sl_selected_free(Z);
        requests_free(&r);
        factored_free(&y);
        COUNTER_CLEAN(&counter);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_way_to_an_entry_equals_full_solves),
        cmocka_unit_test(solves_in_regions_are_right_or_refused),
        cmocka_unit_test(a_refused_region_takes_other_numbers_later),
        cmocka_unit_test(every_allocation_may_fail),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

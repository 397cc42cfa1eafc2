/* test_constraints_sets.c: sets of pins that change, of many pins, for new numbers */
#include "tests/lib/constrained.h"

enum { STEPS = 40 };

/* How many pins and equalities have this row; a pin counts 1000. */
static int uses(const pinned_t *p, sl_int row) {
    int sum = 0;
    for (sl_int k = 0; k < p->count; k++) {
        const double c = p->C[(size_t)p->n * (size_t)k + (size_t)row];
        sum += c == 1.0 ? 1000 : c != 0.0;
    }
    return sum;
}

/* Rows without a pin and outside of equalities, at most `most` of them. */
static sl_int free_rows(const pinned_t *p, sl_int *rows, sl_int most, uint64_t *seed) {
    sl_int count = 0, first = gen_below(seed, p->n), step = 1 + 2 * gen_below(seed, 3);
    for (sl_int k = 0; k < p->n && count < most; k++) {
        const sl_int row = (first + k * step) % p->n;
        int is_new = uses(p, row) == 0;
        for (sl_int m = 0; m < count; m++) {
            is_new = is_new && rows[m] != row;
        }
        if (is_new) {
            rows[count++] = row;
        }
    }
    return count;
}

/* Releases `count` of the pins from number `least` on. */
static void release_rows(pinned_t *p, sl_int least, sl_int count, uint64_t *seed, sl_stats *stats) {
    const size_t n = (size_t)p->n;
    sl_int *set = test_ints((size_t)p->count + 1), kept = 0;
    gen_set(set, count, p->count - least, gen_bits(seed));
    for (sl_int k = 0; k < count; k++) {
        set[k] += least;
    }
    SL_CHECK(sl_constraints_release(p->P, set, count, stats));
    for (sl_int k = 0; k < p->count; k++) {
        int is_gone = 0;
        for (sl_int m = 0; m < count; m++) {
            is_gone |= set[m] == k;
        }
        if (!is_gone) {
            memmove(p->C + n * (size_t)kept++, p->C + n * (size_t)k, n * sizeof(double));
        }
    }
    memset(p->C + n * (size_t)kept, 0, n * (size_t)(p->count - kept) * sizeof(double));
    p->count = kept;
    assert_int_equal(pins_count(p->P), kept);
    free(set);
}

static void add_equality(pinned_t *p, uint64_t *seed) {
    const sl_int first = gen_below(seed, p->n);
    const sl_int rows[3] = {first, (first + 4) % p->n, (first + 9) % p->n};
    double values[3];
    for (int k = 0; k < 3; k++) {
        values[k] = 2.0 + 0.5 * gen_real(seed);
    }
    int is_dependent = 1, is_free = 0; /* neither: other equalities may determine its rows */
    for (int k = 0; k < 3; k++) {
        is_dependent &= uses(p, rows[k]) >= 1000;
        is_free |= uses(p, rows[k]) == 0;
    }
    const sl_status status = sl_constraints_add(p->P, rows, values, 3, NULL);
    if (is_free) {
        SL_CHECK(status);
    } else if (is_dependent || status != SL_OK) {
        SL_EXPECT(SL_ERR_PIVOT, status);
        return;
    }
    for (int k = 0; k < 3; k++) {
        p->C[(size_t)p->n * (size_t)p->count + (size_t)rows[k]] += values[k];
    }
    p->count++;
}

/* Random changes of a set that keep the first `least` pins: a singular matrix needs one. */
static void change(pinned_t *p, sl_int least, uint64_t *seed) {
    sl_int *rows = test_ints((size_t)p->n);
    sl_stats stats;
    for (int step = 0; step < STEPS; step++) {
        const int kind = (int)gen_below(seed, 8);
        if (kind < 3 && p->count < p->n / 2) {
            const sl_int most = kind == 0 ? 1 : 1 + gen_below(seed, 1 + p->n / 4);
            pin_rows(p, rows, free_rows(p, rows, most, seed), &stats);
        } else if (kind == 3 && p->count > least) {
            release(p, least + gen_below(seed, p->count - least));
            continue;
        } else if (kind < 6) {
            release_rows(p, least, gen_below(seed, p->count - least + 1), seed, &stats);
        } else if (p->count < p->n / 2 && p->count > 2) {
            add_equality(p, seed);
            assert_pinned(p, gen_bits(seed));
            continue;
        } else {
            continue;
        }
        assert_int_equal(stats.constraints.count, p->count);
        assert_true(stats.constraints.seconds >= 0.0);
        assert_pinned(p, gen_bits(seed));
    }
    free(rows);
}

static void sets_that_change_hold(void **state) {
    (void)state;
    static const gen_kind_t kinds[6] = {GEN_PATH,  GEN_STAR,       GEN_GRID2,
                                        GEN_GRID3, GEN_COMPONENTS, GEN_SINGULAR};
    variant_list_t variants = variants_present();
    uint64_t seed = 5;
    for (int k = 0; k < 6 * variants.count; k++) {
        for (int sign = -1; sign <= 1; sign += 2) {
            sl_options opt = options_none();
            opt.isa = variants.variant[k / 6].isa;
            opt.method = variants.variant[k / 6].method;
            opt.pivots = kinds[k % 6] == GEN_SINGULAR ? SL_PIVOTS_SKIP_NULL : SL_PIVOTS_NONZERO;
            pinned_t p = pinned_make(kinds[k % 6], 90, sign, &opt);
            const sl_int least = kinds[k % 6] == GEN_SINGULAR;
            if (least > 0) {
                pin(&p, 7);
            }
            change(&p, least, &seed);
            pinned_free(&p);
        }
    }
}

/* Each allocation of a change fails once: the pins stay as they were. */
static void failing_allocations_leave_the_pins(void **state) {
    (void)state;
    counter_t counter = counter_make();
    sl_options opt = options_counted(&counter);
    pinned_t p = pinned_make(GEN_GRID2, 100, 1, NULL);
    sl_int rows[50], some[10];
    sl_stats stats;
    sl_constraints_free(p.P);
    SL_CHECK(sl_constraints_create(&p.P, p.y.F, &opt));
    for (sl_int k = 0; k < 50; k++) {
        rows[k] = 2 * k + 1;
        some[k % 10] = 3 * (k % 10);
    }
    for (int step = 1; step < 6; step++) {
        sl_status status = SL_ERR_MEMORY;
        for (int m = 0; status != SL_OK; m++) {
            counter.fail_at = (int64_t)counter.calls + m;
            status = step == 1   ? sl_constraints_add(p.P, rows, NULL, 47, &stats)
                     : step == 2 ? sl_constraints_add(p.P, rows + 47, NULL, 2, &stats)
                     : step == 3 ? pin_row(p.P, rows[49], &stats)
                     : step == 4 ? sl_constraints_release(p.P, some, 10, &stats)
                                 : unpin(p.P, 0);
            assert_true(status == SL_OK || status == SL_ERR_MEMORY);
            counter.fail_at = -1;
            if (status == SL_OK && step >= 1 && step <= 3) {
                const sl_int first = step == 1 ? 0 : step == 2 ? 47 : 49;
                for (sl_int k = first; k < (step == 1 ? 47 : step == 2 ? 49 : 50); k++) {
                    p.C[(size_t)p.n * (size_t)p.count++ + (size_t)rows[k]] = 1.0;
                }
            } else if (status == SL_OK && step >= 4) {
                const size_t n = (size_t)p.n;
                sl_int kept = 0;
                for (sl_int k = 0; k < p.count; k++) {
                    if (step == 4 ? k % 3 != 0 || k >= 30 : k > 0) {
                        memmove(p.C + n * (size_t)kept++, p.C + n * (size_t)k, n * sizeof(double));
                    }
                }
                memset(p.C + n * (size_t)kept, 0, n * (size_t)(p.count - kept) * sizeof(double));
                p.count = kept;
            }
            assert_int_equal(pins_count(p.P), p.count);
            assert_pinned(&p, (uint64_t)m);
        }
    }
    pinned_free(&p);
    COUNTER_CLEAN(&counter);
}

/* New numbers are refused until sl_constraints_refactor takes them; a set may lose pins before. */
static void new_numbers_are_taken(void **state) {
    (void)state;
    pinned_t p = pinned_make(GEN_GRID2, 100, 1, NULL);
    const size_t n = (size_t)p.n;
    sl_csc *A = &p.y.M.view;
    double *x = test_reals(n * 60), *values = test_reals((size_t)A->p[n]);
    sl_int rows[48];
    uint64_t seed = 6;
    sl_stats stats;
    for (sl_int k = 0; k < 48; k++) {
        rows[k] = 2 * k;
    }
    pin_rows(&p, rows, 20, &stats);
    add_equality(&p, &seed);
    pin_rows(&p, rows + 20, 28, &stats);
    const sl_int one_row = 97;
    const double one = 1.0, two = 2.0;
    SL_CHECK(sl_constraints_add(p.P, &one_row, &two, 1, NULL));
    SL_EXPECT(SL_ERR_PIVOT, sl_constraints_add(p.P, &one_row, &one, 1, NULL));
    p.C[n * (size_t)p.count++ + (size_t)one_row] = two;
    SL_EXPECT(SL_ERR_PIVOT, pin_row(p.P, 4, &stats));
    assert_int_equal(stats.error.row, 4);
    memcpy(values, A->x, (size_t)A->p[n] * sizeof(double));
    A->x = values;
    for (sl_int k = 0; k < A->p[n]; k++) {
        values[k] *= 1.5;
    }
    for (size_t k = 0; k < n * n; k++) {
        p.dense[k] *= 1.5;
    }
    SL_CHECK(sl_factor_refactor(p.y.F, A, NULL));
    SL_EXPECT(SL_ERR_STALE, sl_constraints_solve(p.P, NULL, x, n, x, n, x, n, 1, NULL));
    SL_EXPECT(SL_ERR_STALE, pin_row(p.P, 99, NULL));
    release_rows(&p, 0, 3, &(uint64_t){7}, &stats);
    SL_CHECK(sl_constraints_refactor(p.P, &stats));
    assert_int_equal(stats.constraints.count, p.count);
    assert_pinned(&p, 4);
    SL_CHECK(sl_factor_refactor(p.y.F, A, NULL));
    SL_CHECK(sl_constraints_refactor(p.P, NULL));
    release_rows(&p, 0, 3, &(uint64_t){7}, &stats);
    assert_pinned(&p, 6);
    const sl_int twice[2] = {3, 3}, outside[2] = {3, p.n};
    SL_EXPECT(SL_ERR_PIVOT, sl_constraints_add(p.P, twice, NULL, 2, &stats));
    assert_int_equal(stats.error.row, 3);
    SL_EXPECT(SL_ERR_ARGUMENT, sl_constraints_add(p.P, outside, NULL, 2, &stats));
    assert_int_equal(stats.error.row, p.n);
    SL_EXPECT(SL_ERR_ARGUMENT, sl_constraints_add(p.P, NULL, NULL, 1, NULL));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_constraints_add(p.P, twice, NULL, -1, NULL));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_constraints_add(NULL, twice, NULL, 1, NULL));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_constraints_release(p.P, twice, 2, NULL));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_constraints_release(p.P, outside, 2, NULL));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_constraints_release(NULL, twice, 1, NULL));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_constraints_release(p.P, NULL, 1, NULL));
    SL_EXPECT(SL_ERR_TOO_LARGE, sl_constraints_add(p.P, twice, NULL, INT32_MAX, NULL));
    assert_pinned(&p, 7);
    SL_CHECK(sl_constraints_add(p.P, NULL, NULL, 0, NULL));
    A->x = x; /* zeros */
    SL_EXPECT(SL_ERR_PIVOT, sl_factor_refactor(p.y.F, A, NULL));
    SL_EXPECT(SL_ERR_STALE, sl_constraints_refactor(p.P, &stats));
    SL_CHECK(unpin(p.P, p.count - 1));
    assert_int_equal(pins_count(p.P), p.count - 1);
    A->x = p.y.M.x;
    free(values);
    free(x);
    pinned_free(&p);
}

/* Hundreds of pins on a path, whose columns of L all lead to the last row: pins keep their values,
 * and the equations of the other rows hold. */
static void many_pins_with_long_paths_hold(void **state) {
    (void)state;
    enum { N = 1600, PINS = 500 };
    gen_list_t t = gen_list(N);
    sl_int rows[PINS];
    double *b = test_reals(N), *x = test_reals(N), *g = test_reals(PINS), *r = test_reals(N);
    for (sl_int k = 0; k < N; k++) {
        gen_add(&t, k, k, 3.0);
        if (k > 0) {
            gen_add(&t, k, k - 1, -1.0);
        }
    }
    for (sl_int k = 0; k < PINS; k++) {
        rows[k] = 2 * k;
    }
    gen_reals(b, N, 7);
    gen_reals(g, PINS, 8);
    gen_matrix_t M = gen_store(&t, gen_style(0), 1);
    factored_t y = {M, analyze_natural(&M.view, SL_RELAXATION_DEFAULT), NULL};
    SL_CHECK(sl_factor_create(&y.F, y.S, &M.view, NULL, NULL));
    sl_constraints *P = NULL;
    SL_CHECK(sl_constraints_create(&P, y.F, NULL));
    SL_CHECK(sl_constraints_add(P, rows, NULL, PINS, NULL));
    SL_CHECK(sl_constraints_solve(P, NULL, x, N, b, N, g, PINS, 1, NULL));
    SL_CHECK(sl_csc_residual(&M.view, r, N, NULL, x, N, b, N, 1));
    for (sl_int k = 0; k < N; k++) {
        const int is_pin = k < 2 * PINS && k % 2 == 0;
        assert_true(fabs(is_pin ? x[k] - g[k / 2] : r[k]) <= 1e-12);
    }
    sl_constraints_free(P);
    gen_list_free(&t);
    factored_free(&y);
    free(b);
    free(x);
    free(g);
    free(r);
}

/* Local solves with any number of right-hand sides where fronts are large. */
static void large_fronts_have_room(void **state) {
    (void)state;
    enum { SET = 5, MOST = 9 };
    counter_t counter = counter_make();
    const sl_options opt = options_counted(&counter);
    factored_t y = factored_make(GEN_GRID3, 1728, 1, 0, &opt);
    const size_t n = (size_t)y.M.view.n_cols;
    const sl_int set[SET] = {1, 50, 777, 1234, 1700};
    sl_int *rows = test_ints(n), count = 0;
    double *B = test_reals(n * MOST), *X = test_reals(n * MOST), *G = test_reals(n * MOST);
    double b[SET * MOST], x[SET * MOST];
    sl_constraints *P = NULL;
    sl_plan *plan = NULL;
    for (sl_int i = 0; i < (sl_int)n; i += 5) {
        rows[count++] = i;
    }
    gen_reals(G, n * MOST, 1);
    gen_reals(b, SET * MOST, 2);
    SL_CHECK(sl_constraints_create(&P, y.F, &opt));
    SL_CHECK(sl_constraints_add(P, rows, NULL, count, NULL));
    SL_CHECK(sl_plan_create(&plan, y.S, set, SET, set, SET, NULL, NULL));
    for (sl_int nrhs = 1; nrhs <= MOST; nrhs++) {
        for (size_t k = 0; k < SET * (size_t)nrhs; k++) {
            B[(size_t)set[k % SET] + n * (k / SET)] = b[k];
        }
        SL_CHECK(sl_constraints_solve(P, NULL, X, n, B, n, G, n, nrhs, NULL));
        SL_CHECK(sl_constraints_solve(P, plan, x, SET, b, SET, G, n, nrhs, NULL));
        assert_int_equal(counter.damaged, 0);
        for (size_t k = 0; k < SET * (size_t)nrhs; k++) {
            assert_true(fabs(x[k] - X[(size_t)set[k % SET] + n * (k / SET)]) <= 1e-11);
        }
    }
    sl_plan_free(plan);
    sl_constraints_free(P);
    factored_free(&y);
    COUNTER_CLEAN(&counter);
    free(rows);
    free(B);
    free(X);
    free(G);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(sets_that_change_hold),
        cmocka_unit_test(many_pins_with_long_paths_hold),
        cmocka_unit_test(failing_allocations_leave_the_pins),
        cmocka_unit_test(new_numbers_are_taken),
        cmocka_unit_test(large_fronts_have_room),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

/* test_selected.c: the selected inverse: against dense inverses and full solves, parts of it, its memory, wrong use */
#include "problem.h"

/* What rounding may do to entry (i, j) of the inverse: BOUND_C n eps (|Z| |L| |D| |L'| |Z|)_ij, the bound of [Higham,
 * Accuracy and Stability, 10 and 14] for an inverse by way of a factorization; it does not change with the scale of
 * rows. c = 4 as in check_product; what the reference loses by itself is inside. */
#define BOUND_C 4.0

/* C = A B, all n x n. */
static double *product(sl_int n, const double *A, const double *B) {
    double *C = test_reals((size_t)n * (size_t)n);
    for (sl_int j = 0; j < n; j++) {
        for (sl_int k = 0; k < n; k++) {
            for (sl_int i = 0; i < n; i++) {
                AT(C, i, j) += AT(A, i, k) * AT(B, k, j);
            }
        }
    }
    return C;
}

/* Pivot order: the inverse, and what rounding may do to each of its entries. */
typedef struct reference_t {
    double *Z, *bound;
} reference_t;

/* The dense inverse of C, its rows and columns scaled by powers of 2 to a diagonal near 1 meanwhile: row exchanges go
 * wrong by the scale of rows, LDL' does not. C is changed. */
static double *scaled_inverse(sl_int n, double *C) {
    double *scale = test_reals((size_t)n);
    for (sl_int k = 0; k < n; k++) {
        int power = 0;
        (void)frexp(AT(C, k, k), &power);
        scale[k] = ldexp(1.0, -power / 2);
    }
    for (sl_int k = 0; k < n * n; k++) {
        C[k] *= scale[k % n] * scale[k / n];
    }
    double *Z = ref_inverse(n, C);
    for (sl_int k = 0; k < n * n; k++) {
        Z[k] *= scale[k % n] * scale[k / n];
    }
    free(scale);
    return Z;
}

static reference_t reference_make(const sl_csc *A, const sl_factor *F) {
    sl_factor_view_t f = sl_factor_view(F);
    sl_symbolic_view_t v = sl_symbolic_view(f.symbolic);
    const char *wrong = NULL;
    sl_int n = v.n;
    size_t size = (size_t)n * (size_t)n;
    double *M = ref_dense(A), *C = ref_permute(n, M, v.perm), *L = check_expand(F, &wrong);
    double *R = test_reals(size), *S = test_reals(size);
    reference_t r = {scaled_inverse(n, C), NULL};
    NOTHING_WRONG(wrong);
    for (sl_int j = 0; j < n; j++) {
        for (sl_int i = 0; i < n; i++) { /* R = |L| |D|^(1/2), S = |Z| */
            AT(R, i, j) = fabs(AT(L, i, j)) * sqrt(fabs(f.D[j]));
            AT(S, i, j) = fabs(AT(r.Z, i, j));
        }
    }
    double *T = product(n, S, R), *U = test_reals(size);
    for (sl_int j = 0; j < n; j++) {
        for (sl_int i = 0; i < n; i++) {
            AT(U, i, j) = AT(T, j, i);
        }
    }
    r.bound = product(n, T, U);
    for (size_t k = 0; k < size; k++) {
        r.bound[k] *= BOUND_C * (double)n * DBL_EPSILON;
    }
    free(M);
    free(C);
    free(L);
    free(R);
    free(S);
    free(T);
    free(U);
    return r;
}

static void reference_free(reference_t *r) {
    free(r->Z);
    free(r->bound);
}

/* NULL, or what is wrong with the numbers of Z: every place of every panel. */
static const char *check_selected(const sl_selected *Z, const reference_t *r) {
    sl_selected_view_t z = sl_selected_view(Z);
    sl_symbolic_view_t v = sl_symbolic_view(z.symbolic);
    sl_int n = v.n;
    for (sl_int k = 0; k < z.count; k++) {
        sl_int s = z.supers[k], width = ref_width(&v, s), height = ref_height(&v, s);
        if (z.begin[k + 1] - z.begin[k] != ref_panel_size(width, height)) {
            return "panel size";
        }
        for (sl_int c = 0; c < width; c++) {
            for (sl_int q = c; q < (height + 7) / 8 * 8; q++) {
                double value = z.Z[z.begin[k] + ref_place(width, q, c)];
                if (q >= height) {
                    if (value != 0.0) {
                        return "padding is not 0";
                    }
                    continue;
                }
                sl_int i = ref_row(&v, s, q), j = v.super_first[s] + c;
                if (!(fabs(value - AT(r->Z, i, j)) <= AT(r->bound, i, j))) {
                    return i == j ? "a diagonal entry is off" : "an entry is off";
                }
            }
        }
    }
    return NULL;
}

/* The answers through the public calls are the numbers of the panels. */
static void check_answers(const sl_selected *Z) {
    sl_selected_view_t z = sl_selected_view(Z);
    sl_symbolic_view_t v = sl_symbolic_view(z.symbolic);
    for (sl_int k = 0; k < z.count; k++) {
        sl_int s = z.supers[k], width = ref_width(&v, s), height = ref_height(&v, s);
        for (sl_int c = 0; c < width; c++) {
            for (sl_int q = c; q < height; q++) {
                double value = z.Z[z.begin[k] + ref_place(width, q, c)], got[2];
                sl_int i = v.perm[ref_row(&v, s, q)], j = v.perm[v.super_first[s] + c];
                sl_int rows[2] = {i, j}, columns[2] = {j, i};
                SL_CHECK(sl_selected_entries(Z, got, rows, columns, 2, NULL));
                assert_true(got[0] == value && got[1] == value);
                if (i == j) {
                    SL_CHECK(sl_selected_diagonal(Z, got, rows, 2, NULL));
                    assert_true(got[0] == value && got[1] == value);
                }
            }
        }
    }
}

static void equals_the_dense_inverse(void **state) {
    (void)state;
    static const sl_int sizes[5] = {2, 9, 30, 77, 150};
    way_list_t ways = ways_present();
    for (int kind = 0; kind < GEN_REGULAR; kind++) {
        for (int size = 0; size < 5; size++) {
            for (int k = 0; k < ways.count; k++) {
                sl_options opt = options_none();
                way_take(&opt, &ways, k);
                opt.relaxation =
                    (kind + size + k) % 3 == 0 ? SL_RELAXATION_NONE : SL_RELAXATION_DEFAULT;
                opt.ordering = (size + k) % 4 == 1 ? SL_ORDERING_NATURAL : SL_ORDERING_DEFAULT;
                problem_t y = problem_make((gen_kind_t)kind, sizes[size], (size + k) % 3 - 1,
                                           (size + k) % GEN_STYLES, &opt);
                reference_t r = reference_make(&y.M.view, y.F);
                sl_selected *Z = NULL;
                sl_stats stats;
                memset(&stats, 0, sizeof stats);
                SL_CHECK(sl_selected_create(&Z, y.F, NULL, 0, NULL, &stats));
                const char *wrong = check_selected(Z, &r);
                if (wrong) {
                    print_error("%s, n = %d, %s: %s\n", gen_name((gen_kind_t)kind),
                                (int)y.M.view.n_cols, isa_name(opt.isa), wrong);
                    fail();
                }
                assert_int_equal(stats.z_columns, y.M.view.n_cols);
                assert_int_equal(stats.z_supernodes, sl_symbolic_view(y.S).n_supers);
                assert_true(stats.z_entries == panel_doubles(y.F));
                if (sizes[size] == 30) {
                    check_answers(Z);
                }
                sl_selected_free(Z);
                reference_free(&r);
                problem_free(&y);
            }
        }
    }
}

/* Wide supernodes: several groups of columns, the last one of any width; several chunks of rows below. */
static void wide_supernodes(void **state) {
    (void)state;
    isa_list_t isas = isas_present();
    for (sl_int n = 120; n < 330; n += 23) {
        for (int k = 0; k < isas.count; k++) {
            sl_options opt = options_none();
            opt.isa = isas.isa[k];
            opt.ordering = SL_ORDERING_NATURAL;
            problem_t y = problem_make(n % 2 ? GEN_DENSE : GEN_GRID3, n, 1, 0, &opt);
            reference_t r = reference_make(&y.M.view, y.F);
            sl_selected *Z = NULL;
            SL_CHECK(sl_selected_create(&Z, y.F, NULL, 0, &opt, NULL));
            NOTHING_WRONG(check_selected(Z, &r));
            sl_selected_free(Z);
            reference_free(&r);
            problem_free(&y);
        }
    }
}

/* On a grid that no dense matrix holds: columns of the inverse by full solves, where the pattern has a place. */
static void equals_full_solves(void **state) {
    (void)state;
    isa_list_t isas = isas_present();
    for (int k = 0; k < isas.count; k++) {
        sl_options opt = options_none();
        opt.isa = isas.isa[k];
        problem_t y = problem_make(GEN_GRID2, 10000, 1, 0, &opt);
        sl_int n = y.M.view.n_cols;
        double *b = test_reals((size_t)n), *x = test_reals((size_t)n),
               *diagonal = test_reals((size_t)n);
        sl_selected *Z = NULL;
        uint64_t seed = 5;
        SL_CHECK(sl_selected_create(&Z, y.F, NULL, 0, NULL, NULL));
        SL_CHECK(sl_selected_diagonal(Z, diagonal, NULL, 0, NULL));
        for (int times = 0; times < 60; times++) {
            sl_int j = gen_below(&seed, n);
            double largest = 0.0;
            b[j] = 1.0;
            SL_CHECK(sl_factor_solve(y.F, x, (size_t)n, b, (size_t)n, 1, NULL));
            b[j] = 0.0;
            for (sl_int i = 0; i < n; i++) {
                largest = fmax(largest, fabs(x[i]));
            }
            double allowed =
                64.0 * (double)n * DBL_EPSILON * largest; /* the diagonal dominates: no condition */
            assert_true(fabs(diagonal[j] - x[j]) <= allowed);
            for (sl_int p = y.M.p[j]; p < y.M.p[j + 1]; p++) { /* A's own pattern is in that of L */
                double z;
                SL_CHECK(sl_selected_entries(Z, &z, &y.M.i[p], &j, 1, NULL));
                assert_true(fabs(z - x[y.M.i[p]]) <= allowed);
            }
        }
        sl_selected_free(Z);
        free(b);
        free(x);
        free(diagonal);
        problem_free(&y);
    }
}

static void a_set_gives_the_same_bits(void **state) {
    (void)state;
    static const sl_int sizes[3] = {12, 100, 700};
    isa_list_t isas = isas_present();
    uint64_t seed = 3;
    for (int kind = 0; kind < GEN_REGULAR; kind++) {
        for (int size = 0; size < 3; size++) {
            sl_options opt = options_none();
            opt.isa = isas.isa[(kind + size) % isas.count];
            problem_t y = problem_make((gen_kind_t)kind, sizes[size], 1, 0, &opt);
            sl_symbolic_view_t v = sl_symbolic_view(y.S);
            sl_int n = v.n, *set = test_ints((size_t)n + 2);
            sl_selected *all = NULL;
            SL_CHECK(sl_selected_create(&all, y.F, NULL, 0, NULL, NULL));
            for (sl_int count = 0; count <= n; count = 3 * count + 1) {
                char *mark = (char *)test_array((size_t)v.n_supers, 1);
                sl_selected *some = (sl_selected *)(void *)&seed;
                sl_stats stats;
                sl_int reached = 0, columns = 0;
                memset(&stats, 0, sizeof stats);
                gen_set(set, count, n, gen_bits(&seed));
                for (sl_int k = 0; k < count; k++) {
                    for (sl_int s = v.super_of[v.iperm[set[k]]]; s != -1; s = v.super_parent[s]) {
                        mark[s] = 1;
                    }
                }
                sl_int twice = count > 0 ? count + 1 : 0; /* a row may be there twice */
                set[count] = set[0];
                SL_CHECK(sl_selected_create(&some, y.F, set, twice, NULL, &stats));
                sl_selected_view_t z = sl_selected_view(some), whole = sl_selected_view(all);
                for (sl_int s = 0; s < v.n_supers; s++) {
                    if (mark[s]) {
                        assert_true(reached < z.count && z.supers[reached] == s);
                        size_t bytes =
                            (size_t)(z.begin[reached + 1] - z.begin[reached]) * sizeof(double);
                        assert_memory_equal(z.Z + z.begin[reached], whole.Z + whole.begin[s],
                                            bytes);
                        reached++;
                        columns += ref_width(&v, s);
                    }
                }
                assert_int_equal(z.count, reached);
                assert_int_equal(stats.z_supernodes, reached);
                assert_int_equal(stats.z_columns, columns);
                for (sl_int i = 0; i < n; i++) {
                    double d = 7.0, e;
                    sl_status wanted = mark[v.super_of[v.iperm[i]]] ? SL_OK : SL_ERR_PATTERN;
                    SL_EXPECT(wanted, sl_selected_diagonal(some, &d, &i, 1, &stats));
                    SL_CHECK(sl_selected_diagonal(all, &e, &i, 1, NULL));
                    assert_int_equal(stats.error_row, wanted == SL_OK ? -1 : i);
                    assert_true(d == (wanted == SL_OK ? e : 7.0));
                }
                sl_selected_free(some);
                free(mark);
            }
            sl_selected_free(all);
            free(set);
            problem_free(&y);
        }
    }
}

/* The object keeps its numbers when the factor gets others, fails, or goes. */
static void outlives_a_refactorization(void **state) {
    (void)state;
    problem_t y = problem_make(GEN_GRID2, 225, 1, 0, NULL);
    double before[225], after[225], again[225];
    sl_selected *Z = NULL, *none = (sl_selected *)(void *)before;
    SL_CHECK(sl_selected_create(&Z, y.F, NULL, 0, NULL, NULL));
    SL_CHECK(sl_selected_diagonal(Z, before, NULL, 0, NULL));
    for (sl_int p = 0; p < y.M.p[225]; p++) {
        y.M.x[p] *= 4.0;
    }
    SL_CHECK(sl_factor_refactor(y.F, &y.M.view, NULL));
    SL_CHECK(sl_selected_diagonal(Z, after, NULL, 0, NULL));
    SAME_VALUES(before, after, 225);
    SL_CHECK(sl_selected_refill(Z, y.F, NULL));
    SL_CHECK(sl_selected_diagonal(Z, again, NULL, 0, NULL));
    sl_selected_free(Z);
    SL_CHECK(sl_selected_create(&Z, y.F, NULL, 0, NULL, NULL));
    SL_CHECK(sl_selected_diagonal(Z, after, NULL, 0, NULL));
    SAME_VALUES(again, after, 225);
    for (int k = 0; k < 225; k++) { /* a power of 2 is exact */
        assert_true(again[k] == before[k] / 4.0);
    }
    y.M.x[3] = NAN;
    SL_EXPECT(SL_ERR_NOT_FINITE, sl_factor_refactor(y.F, &y.M.view, NULL));
    SL_EXPECT(SL_ERR_STATE, sl_selected_create(&none, y.F, NULL, 0, NULL, NULL));
    assert_null(none);
    SL_EXPECT(SL_ERR_STATE, sl_selected_refill(Z, y.F, NULL));
    sl_factor_free(y.F);
    y.F = NULL;
    SL_CHECK(sl_selected_diagonal(Z, after, NULL, 0, NULL));
    SAME_VALUES(again, after, 225);
    sl_selected_free(Z);
    problem_free(&y);
}

static void nothing_to_do(void **state) {
    (void)state;
    const sl_int no_rows[1] = {0};
    for (int kind = GEN_NONE; kind <= GEN_ONE; kind++) {
        problem_t y = problem_make((gen_kind_t)kind, 1, 1, 0, NULL);
        for (int whole = 0; whole < 2; whole++) {
            sl_selected *Z = NULL;
            sl_stats stats;
            double out[1] = {5.0};
            memset(&stats, 0, sizeof stats);
            SL_CHECK(sl_selected_create(&Z, y.F, whole ? NULL : no_rows, 0, NULL, &stats));
            assert_int_equal(stats.z_columns, whole ? kind : 0);
            SL_CHECK(sl_selected_diagonal(Z, NULL, no_rows, 0, NULL));
            SL_CHECK(sl_selected_entries(Z, NULL, NULL, NULL, 0, NULL));
            if (kind == GEN_NONE) {
                SL_CHECK(sl_selected_diagonal(Z, NULL, NULL, 0, NULL));
                assert_int_equal(sl_selected_view(Z).count, 0);
            } else {
                SL_EXPECT(whole ? SL_OK : SL_ERR_PATTERN,
                          sl_selected_diagonal(Z, out, NULL, 0, &stats));
                assert_true(out[0] == (whole ? 1.0 / sl_factor_view(y.F).D[0] : 5.0));
            }
            sl_selected_free(Z);
        }
        problem_free(&y);
    }
}

static void wrong_use(void **state) {
    (void)state;
    problem_t y = problem_make(GEN_PATH, 20, 1, 0, NULL),
              other = problem_make(GEN_PATH, 20, 1, 0, NULL);
    const sl_int below[3] = {7, -1, 4}, above[3] = {7, 8, 20}, fine[3] = {7, 8, 7},
                 far[3] = {7, 8, 19};
    sl_options half = options_none();
    double out[20];
    sl_selected *Z = NULL, *none = (sl_selected *)(void *)out;
    sl_stats stats;
    memset(&stats, 0, sizeof stats);
    half.allocator.release = counter_release;
    out[0] = 5.0;
    SL_EXPECT(SL_ERR_ARGUMENT, sl_selected_create(NULL, y.F, NULL, 0, NULL, NULL));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_selected_create(&none, NULL, NULL, 0, NULL, NULL));
    assert_null(none);
    none = (sl_selected *)(void *)out;
    SL_EXPECT(SL_ERR_ARGUMENT, sl_selected_create(&none, y.F, fine, -1, NULL, NULL));
    assert_null(none);
    SL_EXPECT(SL_ERR_ARGUMENT, sl_selected_create(&none, y.F, NULL, 0, &half, NULL));
    none = (sl_selected *)(void *)out;
    SL_EXPECT(SL_ERR_ARGUMENT, sl_selected_create(&none, y.F, below, 3, NULL, &stats));
    assert_null(none);
    assert_int_equal(stats.error_row, -1);
    SL_EXPECT(SL_ERR_ARGUMENT, sl_selected_create(&none, y.F, above, 3, NULL, &stats));
    assert_int_equal(stats.error_row, 20);
    SL_CHECK(sl_selected_create(&Z, y.F, NULL, -1, NULL, &stats)); /* count is not read */
    SL_EXPECT(SL_ERR_ARGUMENT, sl_selected_diagonal(NULL, out, fine, 3, NULL));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_selected_diagonal(Z, NULL, fine, 3, NULL));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_selected_diagonal(Z, NULL, NULL, 0, NULL));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_selected_diagonal(Z, out, fine, -1, NULL));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_selected_diagonal(Z, out, above, 3, &stats));
    assert_int_equal(stats.error_row, 20);
    SL_EXPECT(SL_ERR_ARGUMENT, sl_selected_entries(NULL, out, fine, fine, 3, NULL));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_selected_entries(Z, NULL, fine, fine, 3, NULL));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_selected_entries(Z, out, NULL, fine, 3, NULL));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_selected_entries(Z, out, fine, NULL, 3, NULL));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_selected_entries(Z, out, fine, fine, -1, NULL));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_selected_entries(Z, out, fine, above, 3, &stats));
    assert_int_equal(stats.error_row, 7);
    assert_int_equal(stats.error_column, 20);
    SL_EXPECT(SL_ERR_ARGUMENT, sl_selected_entries(Z, out, below, fine, 3, &stats));
    assert_int_equal(stats.error_row, -1);
    SL_EXPECT(SL_ERR_PATTERN,
              sl_selected_entries(Z, out, fine, far, 3, &stats)); /* a path has no fill that far */
    assert_int_equal(stats.error_row, 7);
    assert_int_equal(stats.error_column, 19);
    assert_true(out[0] == 5.0);
    SL_CHECK(sl_selected_entries(Z, out, fine, fine, 3, &stats));
    assert_int_equal(stats.error_row, -1);
    assert_null(sl_selected_view(NULL).Z);
    SL_EXPECT(SL_ERR_ARGUMENT, sl_selected_refill(NULL, y.F, NULL));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_selected_refill(Z, NULL, NULL));
    SL_EXPECT(
        SL_ERR_STATE,
        sl_selected_refill(Z, other.F, NULL)); /* another analysis, though of the same pattern */
    problem_free(&other);
    sl_selected_free(Z);
    sl_selected_free(NULL);
    problem_free(&y);
}

static void every_allocation_may_fail(void **state) {
    (void)state;
    problem_t y = problem_make(GEN_GRID2, 400, 1, 0, NULL);
    const sl_int set[3] = {17, 380, 200};
    for (int whole = 0; whole < 2; whole++) {
        sl_status status = SL_ERR_MEMORY;
        for (int64_t k = 0; status != SL_OK; k++) {
            counter_t counter = counter_make();
            sl_options opt = options_counted(&counter);
            sl_selected *Z = (sl_selected *)(void *)&counter;
            counter.fail_at = k;
            status = sl_selected_create(&Z, y.F, whole ? NULL : set, 3, &opt, NULL);
            assert_true(status == SL_OK || status == SL_ERR_MEMORY);
            assert_int_equal(status == SL_ERR_MEMORY, counter.calls > (size_t)k);
            assert_true((Z != NULL) == (status == SL_OK));
            if (Z) {
                sl_work *W = NULL;
                counter.fail_at = (int64_t)counter.calls;
                SL_EXPECT(SL_ERR_MEMORY,
                          sl_selected_refill(Z, y.F, NULL)); /* Z is as it was: see below */
                SL_CHECK(sl_work_create(&W, &opt));
                counter.fail_at = (int64_t)counter.calls;
                SL_EXPECT(SL_ERR_MEMORY, sl_selected_refill(Z, y.F, W));
                SL_CHECK(sl_selected_refill(Z, y.F, W));
                size_t grown = counter.calls;
                SL_CHECK(sl_selected_refill(Z, y.F, W));
                assert_int_equal(counter.calls, grown);
                sl_work_free(W);
            }
            if (Z) { /* memory that was never written shows as NaN */
                double d[3];
                size_t calls = counter.calls;
                SL_CHECK(sl_selected_diagonal(Z, d, set, 3, NULL));
                assert_true(d[0] > 0.0 && d[1] > 0.0 && d[2] > 0.0);
                assert_int_equal(counter.calls, calls);
            }
            sl_selected_free(Z);
            COUNTER_CLEAN(&counter);
            assert_in_range(k, 0, 100);
        }
    }
    problem_free(&y);
}

/* The test of the test: one wrong bit in the middle of the mantissa is noticed, anywhere. */
static void a_broken_entry_is_noticed(void **state) {
    (void)state;
    problem_t y = problem_make(GEN_GRID2, 49, 1, 0, NULL);
    reference_t r = reference_make(&y.M.view, y.F);
    sl_selected *Z = NULL;
    SL_CHECK(sl_selected_create(&Z, y.F, NULL, 0, NULL, NULL));
    sl_selected_view_t z = sl_selected_view(Z);
    sl_symbolic_view_t v = sl_symbolic_view(y.S);
    double *numbers = (double *)(uintptr_t)z.Z;
    NOTHING_WRONG(check_selected(Z, &r));
    for (sl_int s = 0; s < v.n_supers; s++) {
        sl_int width = ref_width(&v, s);
        for (sl_int c = 0; c < width; c++) {
            for (sl_int q = c; q < (ref_height(&v, s) + 7) / 8 * 8; q++) {
                double *at = numbers + z.begin[s] + ref_place(width, q, c), keep = *at;
                *at += 1e-10 * (1.0 + fabs(keep));
                assert_non_null(check_selected(Z, &r));
                *at = keep;
            }
        }
    }
    sl_selected_free(Z);
    reference_free(&r);
    problem_free(&y);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(equals_the_dense_inverse),
        cmocka_unit_test(wide_supernodes),
        cmocka_unit_test(equals_full_solves),
        cmocka_unit_test(a_set_gives_the_same_bits),
        cmocka_unit_test(outlives_a_refactorization),
        cmocka_unit_test(nothing_to_do),
        cmocka_unit_test(wrong_use),
        cmocka_unit_test(every_allocation_may_fail),
        cmocka_unit_test(a_broken_entry_is_noticed),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

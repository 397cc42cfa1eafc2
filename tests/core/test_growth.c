/* test_growth.c: pivot growth: its value for every method and way to analyze, and its limit */
#include "tests/lib/factored.h"
#include "tests/lib/parallel_for.h"
#include "tests/lib/analyzed_system.h"

/* ---- growth against L and D ---- */

/* |D| of a 2x2 pivot by its eigenvalues: size[0], size[2] its diagonal, size[1] the other entry. */
static void absolute_pair(double a, double b, double e, double *size) {
    const double angle = 0.5 * atan2(2.0 * e, a - b), c = cos(angle), s = sin(angle);
    const double first = fabs(a * c * c + 2.0 * e * c * s + b * s * s);
    const double second = fabs(a * s * s - 2.0 * e * c * s + b * c * c);
    size[0] = first * c * c + second * s * s;
    size[1] = (first - second) * c * s;
    size[2] = first * s * s + second * c * c;
}

/* Adds what the pair of columns j, j+1 of L contributes to the sums of the rows below; least(j),
 * least(j+1) := the entry off the diagonal of D. */
static void add_pair(const sl_factor_arrays *f, const sl_csc *L, sl_int j, double *sum,
                     double *least) {
    double size[3], *m = test_reals((size_t)L->n_cols), *l = test_reals((size_t)L->n_cols);
    absolute_pair(f->D[j], f->D[j + 1], f->E[j], size);
    for (sl_int c = j; c < j + 2; c++) {
        for (sl_int p = L->p[c]; p < L->p[c + 1]; p++) {
            (c == j ? l : m)[L->i[p]] = L->x[p];
        }
        least[c] = fabs(f->E[j]);
    }
    for (sl_int k = j + 2; k < L->n_cols; k++) {
        sum[k] += l[k] * l[k] * size[0] + 2.0 * fabs(l[k] * m[k] * size[1]) + m[k] * m[k] * size[2];
    }
    free(l);
    free(m);
}

/* max_k (|a_kk| + sum_j |l_kj d_j l_kj|) / max |a|, the maximum over the trees, from
 * sl_factor_lower. A 2x2 pivot D contributes l |D| l'; its entry off the diagonal counts in its own
 * rows. *entry: the largest entry. */
static double reference_growth(const sl_factor *F, const sl_csc *A, double *entry) {
    const sl_factor_arrays f = sl_factor_view(F);
    const sl_symbolic_arrays v = sl_symbolic_view(f.symbolic);
    double *sum = test_reals((size_t)v.n), *most = test_reals((size_t)v.n), growth = 0.0;
    double *least = test_reals((size_t)v.n);
    sl_matrix *M = NULL;
    SL_CHECK(sl_factor_lower(&M, F, NULL));
    const sl_csc L = sl_matrix_view(M);
    *entry = 0.0;
    for (sl_int j = 0; j < v.n; j++) {
        for (sl_int p = A->p[j]; p < A->p[j + 1]; p++) {
            const sl_int k = v.iperm[A->i[p]], last = k > v.iperm[j] ? k : v.iperm[j];
            most[last] = fmax(most[last], fabs(A->x[p]));
            *entry = fmax(*entry, fabs(A->x[p]));
            sum[k] += A->i[p] == j ? fabs(A->x[p]) : 0.0;
        }
        for (sl_int p = L.p[j]; p < L.p[j + 1]; p++) {
            const int is_single = v.pairs == NULL || v.pairs[j] == 0;
            sum[L.i[p]] += L.i[p] == j || !is_single ? 0.0 : fabs(L.x[p] * f.D[j] * L.x[p]);
        }
        if (v.pairs != NULL && v.pairs[j] == 1) {
            add_pair(&f, &L, j, sum, least);
        }
    }
    for (sl_int k = 0; k < v.n; k++) {
        sum[k] = fmax(sum[k], least[k]);
        if (v.parent[k] == -1) {
            growth = fmax(growth, most[k] > 0.0 ? sum[k] / most[k] : 0.0);
        } else {
            const sl_int up = v.parent[k];
            most[up] = fmax(most[up], most[k]);
            sum[up] = fmax(sum[up], sum[k]);
        }
    }
    free(sum);
    free(most);
    free(least);
    sl_matrix_free(M);
    return growth;
}

static void assert_growth(const sl_factor *F, const sl_csc *A, const sl_stats *stats) {
    double entry, growth = reference_growth(F, A, &entry);
    assert_true(stats->factor.entry_max == entry);
    /* |D| of a 2x2 pivot is accurate to its condition; its eigenvalues may be twice its entries */
    const int has_pairs = sl_factor_view(F).E != NULL;
    const double least = has_pairs ? 0.5 : 1.0 - 1e-12;
    assert_true(fabs(stats->factor.growth - growth) <= (has_pairs ? 1e-4 : 1e-12) * growth);
    assert_true(stats->factor.growth * entry >= least * stats->factor.pivot_max ||
                sl_symbolic_view(sl_factor_view(F).symbolic).n == 0);
}

static void growth_is_that_of_the_factors(void **state) {
    (void)state;
    variant_list_t variants = variants_present();
    for (int k = 0; k < variants.count * WAYS; k++) {
        for (int family = 0; family < SYSTEM_FAMILIES; family++) {
            for (uint64_t seed = 1; seed <= 4; seed++) {
                random_system_t y = random_system(family, 4 * seed);
                sl_options opt = options_none();
                sl_symbolic *S = analyze(&y, k / variants.count, seed);
                sl_factor *F = NULL;
                sl_stats stats;
                options_set_variant(&opt, &variants, k % variants.count);
                opt.growth_limit = -1.0;
                const sl_status status = sl_factor_create(&F, S, &y.M.view, &opt, &stats);
                if (status == SL_OK) {
                    assert_growth(F, &y.M.view, &stats);
                } else {
                    SL_EXPECT(SL_ERR_PIVOT, status);
                    assert_true(stats.factor.growth == 0.0);
                }
                sl_factor_free(F);
                sl_symbolic_free(S);
                random_system_free(&y);
            }
        }
    }
}

/* A bad block beside a component that is 1e30 times larger. */
static void growth_is_measured_in_each_component(void **state) {
    (void)state;
    static const sl_int p[5] = {0, 2, 3, 5, 6}, i[6] = {0, 1, 1, 2, 3, 3};
    static const double x[6] = {2e30, 1e30, 2e30, 1e-12, 1.0, 1.0};
    const sl_csc A = {4, 4, p, i, x};
    variant_list_t variants = variants_present();
    sl_symbolic *S = analyze_natural(&A, SL_RELAXATION_DEFAULT);
    for (int k = 0; k < variants.count; k++) {
        sl_options opt = options_none();
        sl_factor *F = NULL;
        sl_stats stats;
        options_set_variant(&opt, &variants, k);
        SL_CHECK(sl_factor_create(&F, S, &A, &opt, &stats));
        assert_true(fabs(stats.factor.growth - 1e12) < 1e3);
        assert_true(stats.factor.entry_max == 2e30);
        sl_factor_free(F);
    }
    sl_symbolic_free(S);
}

static void definite_matrices_do_not_grow(void **state) {
    (void)state;
    variant_list_t variants = variants_present();
    for (int k = 0; k < variants.count; k++) {
        for (int family = 0; family < 6; family++) {
            for (uint64_t seed = 1; seed <= 20; seed++) {
                random_system_t y = random_system(family, seed);
                sl_options opt = options_none();
                sl_symbolic *S = NULL;
                sl_factor *F = NULL;
                sl_stats stats;
                options_set_variant(&opt, &variants, k);
                opt.growth_limit = 2.0 + 1e-12;
                assert_true(y.is_definite);
                SL_CHECK(sl_symbolic_create(&S, &y.M.view, NULL, NULL));
                const sl_status status = sl_factor_create(&F, S, &y.M.view, &opt, &stats);
                assert_true(status == SL_OK || (status == SL_ERR_PIVOT && family == 5));
                sl_factor_free(F);
                sl_symbolic_free(S);
                random_system_free(&y);
            }
        }
        /* the sum of the magnitudes overflows, the pivot does not; definite, then indefinite */
        static const sl_int p[3] = {0, 2, 3}, i[3] = {0, 1, 1};
        double x[3] = {1.5e308, 1.49e308, 1.5e308};
        const sl_csc A = {2, 2, p, i, x};
        sl_options opt = options_none();
        sl_symbolic *S = NULL;
        sl_factor *F = NULL;
        sl_stats stats;
        options_set_variant(&opt, &variants, k);
        SL_CHECK(sl_symbolic_create(&S, &A, NULL, NULL));
        SL_CHECK(sl_factor_create(&F, S, &A, &opt, &stats));
        assert_true(stats.factor.growth >= 1.0 && stats.factor.growth <= 2.0);
        x[2] = 1.48e308;
        SL_CHECK(sl_factor_refactor(F, &A, &stats));
        assert_true(stats.factor.growth >= 1.0 && stats.factor.growth <= 2.0);
        sl_factor_free(F);
        sl_symbolic_free(S);
    }
}

static void growth_does_not_depend_on_threads_or_on_what_changed(void **state) {
    (void)state;
    gen_list_t t = gen_make(GEN_GRID3, 15 * 15 * 15, 1, 42);
    for (size_t k = 0; k < t.count; k++) {
        t.x[k] -= t.row[k] == t.col[k] ? 3.0 : 0.0;
    }
    gen_matrix_t M = gen_store(&t, gen_style(0), 1);
    gen_list_free(&t);
    sl_symbolic *S = NULL;
    SL_CHECK(sl_symbolic_create(&S, &M.view, NULL, NULL));
    double first = 0.0;
    for (sl_int count = 1; count <= 4; count++) {
        int calls = 0;
        sl_options opt = options_none();
        sl_factor *F = NULL;
        sl_stats stats, changed;
        opt.growth_limit = -1.0;
        opt.method = SL_METHOD_SUPERNODAL;
        opt.threads.count = count;
        opt.threads.run = run_threads;
        opt.threads.context = &calls;
        SL_CHECK(sl_factor_create(&F, S, &M.view, &opt, &stats));
        first = count == 1 ? stats.factor.growth : first;
        assert_true(stats.factor.growth == first && first > 2.0);
        /* a tiny pivot in one column, then the values as they were */
        const sl_int column = 700;
        const double keep = M.x[M.p[column]];
        assert_int_equal(M.i[M.p[column]], column);
        M.x[M.p[column]] = 1e9;
        SL_CHECK(sl_factor_change_entries(F, &M.view, NULL, &column, NULL, 1, NULL, &changed));
        assert_growth(F, &M.view, &changed);
        assert_true(changed.factor.entry_max == 1e9);
        M.x[M.p[column]] = keep;
        SL_CHECK(sl_factor_change_entries(F, &M.view, NULL, &column, NULL, 1, NULL, &changed));
        assert_growth(F, &M.view, &changed);
        assert_true(changed.factor.entry_max == stats.factor.entry_max);
        assert_true(fabs(changed.factor.growth - first) <= 1e-6 * first);
        sl_factor_free(F);
    }
    sl_symbolic_free(S);
    gen_matrix_free(&M);
}

/* ---- the limit ---- */

/* A path with the diagonal entry e in row `at` and 4 in others. Row `at` is coupled to the next one
 * by 1 and to none before it; other couplings are 0.1. */
static gen_matrix_t weak_pivot(sl_int n, sl_int at, double e) {
    gen_list_t t = gen_list(n);
    for (sl_int k = 0; k < n; k++) {
        gen_add(&t, k, k, k == at ? e : 4.0);
        if (k > 0) {
            gen_add(&t, k, k - 1, k == at + 1 ? 1.0 : k == at ? 0.0 : 0.1);
        }
    }
    gen_matrix_t M = gen_store(&t, gen_style(0), 1);
    gen_list_free(&t);
    return M;
}

static void assert_refused(sl_status status, const sl_stats *stats, sl_int row, double e) {
    SL_EXPECT(SL_ERR_INACCURATE, status);
    assert_int_equal(stats->error.row, row);
    assert_int_equal(stats->error.column, -1);
    assert_true(stats->error.value == e);
    assert_true(stats->factor.growth > 1e16);
    assert_int_equal(stats->factor.positive + stats->factor.negative, 60);
    assert_int_equal(stats->factor.null, 0);
}

static void growth_beyond_the_limit_is_refused_with_its_pivot(void **state) {
    (void)state;
    static const double off[2] = {-1.0, (double)INFINITY};
    enum { N = 60 };
    variant_list_t variants = variants_present();
    gen_matrix_t good = weak_pivot(N, 20, 4.0);
    sl_symbolic *S = analyze_natural(&good.view, SL_RELAXATION_DEFAULT);
    for (int k = 0; k < variants.count; k++) {
        for (sl_int at = 0; at < N - 1; at += 7) {
            const sl_int column = at;
            gen_matrix_t bad = weak_pivot(N, at, -1e-20);
            gen_matrix_t fine = weak_pivot(N, at, -4.0);
            const double one = 1.0, *values;
            double x[N] = {1.0}, rcond = NAN;
            sl_options opt = options_none();
            sl_factor *F = NULL;
            sl_stats stats;
            options_set_variant(&opt, &variants, k);
            assert_refused(sl_factor_create(&F, S, &bad.view, &opt, &stats), &stats, at, -1e-20);
            assert_null(F);
            SL_CHECK(sl_factor_create(&F, S, &fine.view, &opt, &stats));
            assert_refused(
                sl_factor_change_entries(F, &bad.view, NULL, &column, NULL, 1, NULL, &stats),
                &stats, at, -1e-20);
            SL_EXPECT(SL_ERR_STALE, sl_factor_solve(F, x, N, x, N, 1, NULL));
            assert_refused(sl_factor_refactor(F, &bad.view, &stats), &stats, at, -1e-20);
            stats.factor = sl_factor_view(F).info;
            assert_true(stats.factor.growth > 1e16);
            SL_CHECK(sl_factor_refactor(F, &fine.view, &stats));
            assert_true(stats.factor.growth < 4.0);
            SL_CHECK(sl_factor_solve(F, x, N, x, N, 1, NULL));
            /* sums */
            double *scattered = test_reals((size_t)bad.p[N]);
            SL_CHECK(sl_symbolic_scatter(S, scattered, &bad.view, NULL));
            values = scattered;
            assert_refused(sl_factor_refactor_sums(&F, 1, &one, &values, 1, NULL, NULL, &stats),
                           &stats, at, -1e-20);
            sl_int failed = -1;
            sl_factor *batch = NULL;
            assert_refused(
                sl_factor_create_sums(&batch, 1, S, &one, &values, 1, &opt, &failed, &stats),
                &stats, at, -1e-20);
            assert_int_equal(failed, 0);
            assert_null(batch);
            free(scattered);
            sl_factor_free(F);
            for (int m = 0; m < 2; m++) {
                opt.growth_limit = off[m];
                SL_CHECK(sl_factor_create(&F, S, &bad.view, &opt, &stats));
                assert_true(stats.factor.growth > 1e16);
                SL_CHECK(sl_factor_rcond(F, &bad.view, &rcond, NULL));
                assert_true(rcond <= 4.0 * DBL_EPSILON); /* A itself is well conditioned */
                sl_factor_free(F);
            }
            opt.growth_limit = 0.5; /* refuses everything: the growth is 1 at least */
            SL_EXPECT(SL_ERR_INACCURATE, sl_factor_create(&F, S, &fine.view, &opt, &stats));
            opt.growth_limit = NAN;
            SL_EXPECT(SL_ERR_ARGUMENT, sl_factor_create(&F, S, &fine.view, &opt, &stats));
            opt.growth_limit = 0.0;
            opt.error_limit = NAN;
            SL_EXPECT(SL_ERR_ARGUMENT, sl_factor_create(&F, S, &fine.view, &opt, &stats));
            gen_matrix_free(&bad);
            gen_matrix_free(&fine);
        }
    }
    sl_symbolic_free(S);
    gen_matrix_free(&good);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(growth_is_that_of_the_factors),
        cmocka_unit_test(growth_is_measured_in_each_component),
        cmocka_unit_test(definite_matrices_do_not_grow),
        cmocka_unit_test(growth_does_not_depend_on_threads_or_on_what_changed),
        cmocka_unit_test(growth_beyond_the_limit_is_refused_with_its_pivot),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

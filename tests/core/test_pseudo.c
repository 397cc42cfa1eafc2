/* test_pseudo.c: the pseudo-inverse from entries of a factor with skipped null pivots */
#include "tests/lib/judge_systems.h"

/* A system with its factor, and the pseudo-inverse by all entries and the correction. */
typedef struct pseudo_t {
    judge_system_t y;
    sl_options opt;
    sl_symbolic *S;
    sl_factor *F;
    sl_stats stats;
    sl_pseudo_inverse P;
    double *X; /* n x n */
} pseudo_t;

static sl_pseudo_inverse pseudo_room(sl_int n, sl_int columns) {
    const size_t size = (size_t)n * (size_t)columns;
    sl_pseudo_inverse P = {columns, test_ints((size_t)n), test_reals(size), test_reals(size), 7.0};
    return P;
}

static void pseudo_room_free(sl_pseudo_inverse *P) {
    free(P->component);
    free(P->Q);
    free(P->K);
}

static pseudo_t pseudo_make(int own, uint64_t seed, const variant_list_t *variants) {
    pseudo_t t;
    memset(&t, 0, sizeof t);
    t.y = judge_system(SYSTEM_FAMILIES + own, seed);
    const sl_int n = t.y.n;
    sl_options blocks = options_none();
    sl_int *all = test_ints((size_t)n);
    options_set_variant(&t.opt, variants, (int)(seed % (uint64_t)variants->count));
    t.opt.pivots = t.y.skips ? SL_PIVOTS_SKIP_NULL : SL_PIVOTS_NONZERO;
    t.opt.mass = seed % 2 ? t.y.mass : NULL;
    t.opt.null_vector = t.y.Z;
    t.opt.null_vector_count = t.y.vectors;
    blocks.block_size = t.y.is_complex ? 2 : 0;
    SL_CHECK(sl_symbolic_create(&t.S, &t.y.M.view, &blocks, NULL));
    if (sl_factor_create(&t.F, t.S, &t.y.M.view, &t.opt, &t.stats) == SL_OK) {
        sl_pseudo_inverse none = {0, NULL, NULL, NULL, 0.0};
        SL_CHECK(sl_factor_pseudo_inverse(t.F, &none, NULL));
        t.P = pseudo_room(n, none.columns + 1);
        SL_CHECK(sl_factor_pseudo_inverse(t.F, &t.P, NULL));
        assert_int_equal(t.P.columns, none.columns);
        t.X = test_reals((size_t)n * (size_t)n);
        for (sl_int i = 0; i < n; i++) {
            all[i] = i;
        }
        SL_CHECK(sl_inverse_block(t.F, t.X, (size_t)n, all, n, all, n, NULL, NULL));
        for (sl_int j = 0; j < n; j++) {
            for (sl_int i = 0; i < n && t.P.component[j] != -1; i++) {
                for (sl_int c = 0; c < t.P.columns && t.P.component[i] == t.P.component[j]; c++) {
                    AT(t.X, i, j) -=
                        AT(t.P.Q, i, c) * AT(t.P.K, j, c) + AT(t.P.K, i, c) * AT(t.P.Q, j, c);
                }
            }
        }
    }
    free(all);
    return t;
}

static void pseudo_free(pseudo_t *t) {
    pseudo_room_free(&t->P);
    free(t->X);
    sl_factor_free(t->F);
    sl_symbolic_free(t->S);
    judge_system_free(&t->y);
}

/* The entry of Q Q'. */
static double projector(const sl_pseudo_inverse *P, sl_int n, sl_int i, sl_int j) {
    double sum = 0.0;
    for (sl_int c = 0; c < P->columns && P->component[i] == P->component[j]; c++) {
        sum += AT(P->Q, i, c) * AT(P->Q, j, c);
    }
    return sum;
}

static double largest(const double *M, size_t count) {
    double most = 0.0;
    for (size_t k = 0; k < count; k++) {
        most = fmax(most, fabs(M[k]));
    }
    return most;
}

/* A X = I - Q Q' and X Q = 0, with as many vectors as null pivots, give X = A^+. */
static void check_pseudo(const pseudo_t *t) {
    const sl_int n = t->y.n;
    double *A = ref_dense(&t->y.M.view), trace = 0.0;
    const double a = largest(A, (size_t)n * (size_t)n), x = largest(t->X, (size_t)n * (size_t)n);
    const double allowed = 1e3 * (double)n * DBL_EPSILON * (a * x + 1.0);
    for (sl_int j = 0; j < n; j++) {
        trace += projector(&t->P, n, j, j);
        for (sl_int i = 0; i < n; i++) {
            long double product = 0.0L, zero = 0.0L;
            for (sl_int k = 0; k < n; k++) {
                product += (long double)AT(A, i, k) * AT(t->X, k, j);
                zero += (long double)AT(t->X, i, k) * projector(&t->P, n, k, j);
            }
            const double own = (double)(i == j) - projector(&t->P, n, i, j);
            assert_true(fabs((double)product - own) <= allowed);
            assert_true(fabs((double)zero) <= allowed * (x + 1.0));
        }
    }
    assert_true(fabs(trace - t->stats.factor.null) <= 1e-9);
    free(A);
}

/* Laplacians, elastic bodies, Gram matrices, connections and signed graphs, whose null vectors are
 * known or not; regular ones among them. */
static void entries_are_those_of_the_pseudo_inverse(void **state) {
    (void)state;
    static const int families[8] = {0, 9, 12, 13, 15, 16, 17, 18};
    variant_list_t variants = variants_present();
    sl_int singular = 0, several = 0;
    for (uint64_t seed = 1; seed <= 400; seed++) {
        pseudo_t t = pseudo_make(families[seed % 8], seed, &variants);
        if (t.F != NULL && t.y.n <= 60) {
            check_pseudo(&t);
            singular += t.P.columns > 0;
            several += t.P.columns > 1;
            for (sl_int i = 0; i < t.y.n; i++) {
                assert_true(t.P.component[i] != -1 || t.stats.factor.null < t.y.n);
            }
        }
        pseudo_free(&t);
    }
    assert_true(singular > 100 && several > 20);
}

/* Samples without their part in the null space have the covariance A^+; the determinant is that of
 * A + Q Q', in which the null space has the eigenvalue 1. */
static void samples_and_determinant_are_those_of_the_pseudo_inverse(void **state) {
    (void)state;
    static const int families[4] = {0, 9, 12, 16};
    variant_list_t variants = variants_present();
    for (uint64_t seed = 1; seed <= 80; seed++) {
        pseudo_t t = pseudo_make(families[seed % 4], seed, &variants);
        const sl_int n = t.y.n;
        if (t.F != NULL && n <= 60) {
            double *I = test_reals((size_t)n * (size_t)n), *C = test_reals((size_t)n * (size_t)n);
            double *B = ref_dense(&t.y.M.view), log_det, sign, sum = 0.0;
            const double x = largest(t.X, (size_t)n * (size_t)n);
            for (sl_int i = 0; i < n; i++) {
                AT(I, i, i) = 1.0;
            }
            SL_CHECK(sl_factor_solve_part(t.F, NULL, SL_PART_SQRT_D | SL_PART_LT | SL_PART_PT, I,
                                          (size_t)n, I, (size_t)n, n, NULL));
            for (sl_int j = 0; j < n; j++) {
                for (sl_int i = 0; i < n; i++) {
                    AT(C, i, j) = AT(I, i, j);
                    for (sl_int k = 0; k < n; k++) {
                        AT(C, i, j) -= projector(&t.P, n, i, k) * AT(I, k, j);
                    }
                    AT(B, i, j) += projector(&t.P, n, i, j);
                }
            }
            for (sl_int j = 0; j < n; j++) {
                for (sl_int i = 0; i < n; i++) {
                    double covariance = 0.0;
                    for (sl_int k = 0; k < n; k++) {
                        covariance += AT(C, i, k) * AT(C, j, k);
                    }
                    assert_true(fabs(covariance - AT(t.X, i, j)) <= 1e-9 * x);
                }
            }
            for (sl_int k = 0; k < n; k++) { /* elimination in natural order: B is definite */
                sum += log(AT(B, k, k));
                for (sl_int i = k + 1; i < n; i++) {
                    const double l = AT(B, i, k) / AT(B, k, k);
                    for (sl_int j = k; j < n; j++) {
                        AT(B, i, j) -= l * AT(B, k, j);
                    }
                }
            }
            SL_CHECK(sl_factor_logdet(t.F, &log_det, &sign));
            assert_true(fabs(log_det + t.P.log_det - sum) <= 1e-6 * (1.0 + fabs(sum)));
            free(I);
            free(C);
            free(B);
        }
        pseudo_free(&t);
    }
}

static void wrong_arguments_are_refused(void **state) {
    (void)state;
    variant_list_t variants = variants_present();
    pseudo_t t = pseudo_make(0, 2, &variants);
    const sl_pseudo_inverse good = t.P;
    assert_true(good.columns > 0);
    for (int k = 0; k < 4; k++) {
        sl_pseudo_inverse P = good;
        P.component = k == 0 ? NULL : P.component;
        P.Q = k == 1 ? NULL : P.Q;
        P.K = k == 2 ? NULL : P.K;
        P.columns -= k == 3;
        SL_EXPECT(SL_ERR_ARGUMENT, sl_factor_pseudo_inverse(t.F, &P, NULL));
        assert_true(k < 3 || P.columns == good.columns);
    }
    SL_EXPECT(SL_ERR_ARGUMENT, sl_factor_pseudo_inverse(t.F, NULL, NULL));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_factor_pseudo_inverse(NULL, &t.P, NULL));
    t.y.M.x[0] = NAN;
    SL_EXPECT(SL_ERR_NOT_FINITE, sl_factor_refactor(t.F, &t.y.M.view, NULL));
    SL_EXPECT(SL_ERR_STALE, sl_factor_pseudo_inverse(t.F, &t.P, NULL));
    pseudo_free(&t);
}

/* 2x2 pivots have no entries; a regular matrix needs no correction. */
static void other_factors_need_none(void **state) {
    (void)state;
    const sl_int rows[2] = {1, 1}, p[3] = {0, 1, 2};
    const double x[2] = {1.0, 0.0};
    const sl_csc A = {2, 2, p, rows, x};
    sl_pseudo_inverse P = pseudo_room(2, 1);
    for (int is_pivoted = 0; is_pivoted < 2; is_pivoted++) {
        sl_symbolic *S = NULL;
        sl_factor *F = NULL;
        if (is_pivoted) {
            SL_CHECK(sl_symbolic_create_pivoted(&S, &A, NULL, NULL));
            SL_CHECK(sl_factor_create(&F, S, &A, NULL, NULL));
            SL_EXPECT(SL_ERR_UNSUPPORTED, sl_factor_pseudo_inverse(F, &P, NULL));
        } else {
            sl_options opt = options_none();
            opt.regularization = 1e-8;
            SL_CHECK(sl_symbolic_create(&S, &A, NULL, NULL));
            SL_CHECK(sl_factor_create(&F, S, &A, &opt, NULL));
            SL_CHECK(sl_factor_pseudo_inverse(F, &P, NULL));
            assert_true(P.columns == 0 && P.log_det == 0.0 && P.component[0] == -1);
        }
        sl_factor_free(F);
        sl_symbolic_free(S);
    }
    pseudo_room_free(&P);
}

static void every_allocation_may_fail(void **state) {
    (void)state;
    counter_t counter = counter_make();
    sl_options opt = options_counted(&counter);
    judge_system_t y = judge_system(SYSTEM_FAMILIES, 2);
    sl_pseudo_inverse P = pseudo_room(y.n, 1);
    sl_symbolic *S = NULL;
    sl_factor *F = NULL;
    const sl_options for_analysis = opt;
    opt.pivots = SL_PIVOTS_SKIP_NULL;
    SL_CHECK(sl_symbolic_create(&S, &y.M.view, &for_analysis, NULL));
    SL_CHECK(sl_factor_create(&F, S, &y.M.view, &opt, NULL));
    for (int own = 0; own < 2; own++) {
        sl_status status = SL_ERR_MEMORY;
        for (int64_t k = 0; status != SL_OK; k++) {
            sl_work *W = own ? NULL : work_failing(&counter, k);
            counter.fail_at = (int64_t)counter.calls + k;
            P.columns = 1;
            status = sl_factor_pseudo_inverse(F, &P, W);
            counter.fail_at = -1;
            assert_true(status == SL_OK || status == SL_ERR_MEMORY);
            if (W != NULL && status == SL_OK) { /* which has grown enough */
                const size_t calls = counter.calls;
                SL_CHECK(sl_factor_pseudo_inverse(F, &P, W));
                assert_int_equal(counter.calls, calls);
            }
            sl_work_free(W);
        }
    }
    sl_factor_free(F);
    sl_symbolic_free(S);
    COUNTER_CLEAN(&counter);
    pseudo_room_free(&P);
    judge_system_free(&y);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(entries_are_those_of_the_pseudo_inverse),
        cmocka_unit_test(samples_and_determinant_are_those_of_the_pseudo_inverse),
        cmocka_unit_test(wrong_arguments_are_refused),
        cmocka_unit_test(other_factors_need_none),
        cmocka_unit_test(every_allocation_may_fail),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

/* test_factor.c: P A P' = L D L' entrywise, inertia, determinant, refactor, equal bits */
#include <errno.h>

#include "tests/lib/factored.h"

static void ldl_reproduces_a_for_every_method_style_and_sign(void **state) {
    (void)state;
    static const sl_int sizes[4] = {5, 9, 33, 90};
    variant_list_t variants = variants_present();
    for (int kind = 0; kind < GEN_REGULAR; kind++) {
        for (int size = 0; size < 4; size++) {
            for (int which = size; which < GEN_STYLES; which += 4) {
                for (int k = 0; k < variants.count; k++) {
                    sl_options opt = options_none();
                    options_set_variant(&opt, &variants, k);
                    opt.relaxation = (sl_relaxation)(which / 2 % 2);
                    opt.ordering = which % 3 ? SL_ORDERING_ND : SL_ORDERING_NATURAL;
                    factored_t y =
                        factored_make((gen_kind_t)kind, sizes[size], which % 3 - 1, which, &opt);
                    NOTHING_WRONG(check_factor(y.F, &y.M.view));
                    sl_stats stats;
                    memset(&stats, 0, sizeof stats);
                    stats.factor = sl_factor_view(y.F).info;
                    assert_int_equal(stats.factor.isa, variants.variant[k].isa);
                    assert_int_equal(stats.factor.method, variants.variant[k].method);
                    factored_free(&y);
                }
            }
        }
    }
}

/* Dense and arrow matrices of each size: supernode widths and panel heights around every multiple
 * of 8. */
static void every_small_supernode_is_factored(void **state) {
    (void)state;
    variant_list_t variants = variants_present();
    for (int k = 0; k < variants.count; k++) {
        sl_options opt = options_none();
        options_set_variant(&opt, &variants, k);
        opt.ordering = SL_ORDERING_NATURAL;
        for (sl_int n = 1; n <= 42; n++) {
            static const gen_kind_t kinds[4] = {GEN_DENSE, GEN_ARROW, GEN_STAR, GEN_KKT};
            for (int which = 0; which < 4; which++) {
                factored_t y = factored_make(kinds[which], n, 0, 0, &opt);
                NOTHING_WRONG(check_factor(y.F, &y.M.view));
                factored_free(&y);
            }
        }
    }
}

/* Two supernodes: width w over height h, then a dense rest, for all small w and h. */
static void every_small_pair_of_supernodes_is_factored(void **state) {
    (void)state;
    variant_list_t variants = variants_present();
    uint64_t seed = 8;
    for (sl_int w = 1; w <= 20; w++) {
        for (sl_int h = 1; h <= 20; h++) {
            gen_list_t t = gen_list(w + h + 3);
            for (sl_int j = 0; j < w; j++) {
                for (sl_int i = j + 1; i < w + h; i++) {
                    gen_add(&t, i < w ? i : i + 3 * (i % 2), j,
                            gen_real(&seed)); /* with gaps between the rows */
                }
            }
            gen_list_t clean = gen_list(t.n); /* i + 3 (i % 2) may repeat a row */
            char *seen = (char *)test_array((size_t)t.n * (size_t)t.n, 1);
            for (sl_int j = w; j < t.n; j++) {
                for (sl_int i = j + 1; i < t.n; i++) {
                    gen_add(&t, i, j, gen_real(&seed));
                }
            }
            for (size_t k = 0; k < t.count; k++) {
                if (t.row[k] < t.n && !seen[t.row[k] + t.n * t.col[k]]++) {
                    gen_add(&clean, t.row[k], t.col[k], t.x[k]);
                }
            }
            gen_dominate(&clean, 0, &seed);
            gen_matrix_t M = gen_store(&clean, gen_style(0), 1);
            for (int k = 0; k < variants.count; k++) {
                sl_options opt = options_none();
                options_set_variant(&opt, &variants, k);
                opt.ordering = SL_ORDERING_NATURAL;
                opt.relaxation = SL_RELAXATION_NONE;
                sl_symbolic *S = NULL;
                sl_factor *F = NULL;
                SL_CHECK(sl_symbolic_create(&S, &M.view, FOR_ANALYSIS(&opt), NULL));
                SL_CHECK(sl_factor_create(&F, S, &M.view, FOR_FACTOR(&opt), NULL));
                NOTHING_WRONG(check_factor(F, &M.view));
                sl_factor_free(F);
                sl_symbolic_free(S);
            }
            gen_matrix_free(&M);
            gen_list_free(&t);
            gen_list_free(&clean);
            free(seen);
        }
    }
}

/* |L - L_ref| is small if the matrix is well conditioned. */
static void the_factor_equals_the_dense_reference(void **state) {
    (void)state;
    variant_list_t variants = variants_present();
    for (int kind = 0; kind < GEN_REGULAR; kind++) {
        if (kind == GEN_SCALED || kind == GEN_KKT) {
            continue; /* entries of L vary too much for an absolute bound */
        }
        for (int k = 0; k < variants.count; k++) {
            sl_options opt = options_none();
            options_set_variant(&opt, &variants, k);
            factored_t y = factored_make((gen_kind_t)kind, 50, 0, 0, &opt);
            sl_factor_arrays f = sl_factor_view(y.F);
            sl_symbolic_arrays v = sl_symbolic_view(f.symbolic);
            sl_int n = v.n;
            const char *wrong = NULL;
            double *M = ref_dense(&y.M.view), *C = ref_permute(n, M, v.perm),
                   *L = check_expand(y.F, &wrong);
            double *Lr = test_reals((size_t)n * (size_t)n), *Dr = test_reals((size_t)n);
            assert_null(wrong);
            ref_ldl(n, C, Lr, Dr);
            /* rows are dominant, so entries of L are below 1 and the pivot growth is at most 2: c n
             * eps, c = 16 */
            for (sl_int j = 0; j < n; j++) {
                assert_true(fabs(f.D[j] - Dr[j]) <= 16.0 * (double)n * DBL_EPSILON * fabs(Dr[j]));
                for (sl_int i = j; i < n; i++) {
                    assert_true(fabs(AT(L, i, j) - AT(Lr, i, j)) <= 16.0 * (double)n * DBL_EPSILON);
                }
            }
            free(M);
            free(C);
            free(L);
            free(Lr);
            free(Dr);
            factored_free(&y);
        }
    }
}

static void sl_factor_lower_returns_l(void **state) {
    (void)state;
    for (int kind = 0; kind < GEN_REGULAR; kind++) {
        for (int relaxation = 0; relaxation < 2; relaxation++) {
            sl_options opt = options_none();
            opt.relaxation = (sl_relaxation)relaxation;
            factored_t y = factored_make((gen_kind_t)kind, 40, 0, 2, &opt);
            sl_matrix *lower = NULL;
            const char *wrong = NULL;
            double *L = check_expand(y.F, &wrong);
            assert_null(wrong);
            SL_CHECK(sl_factor_lower(&lower, y.F, NULL));
            sl_csc C = sl_matrix_view(lower);
            sl_int n = y.M.view.n_cols;
            SL_CHECK(sl_csc_check(&C, NULL));
            assert_int_equal(C.n_rows, n);
            assert_int_equal(C.n_cols, n);
            for (sl_int j = 0; j < n; j++) {
                assert_true(C.p[j] < C.p[j + 1] && C.i[C.p[j]] == j && C.x[C.p[j]] == 1.0);
                for (sl_int p = C.p[j]; p < C.p[j + 1]; p++) {
                    assert_true(p == C.p[j] || C.i[p] > C.i[p - 1]);
                    assert_true(C.x[p] == AT(L, C.i[p], j) && C.x[p] != 0.0);
                    AT(L, C.i[p], j) = 0.0;
                }
            }
            for (size_t k = 0; k < (size_t)n * (size_t)n; k++) {
                assert_true(L[k] == 0.0); /* every entry was returned */
            }
            free(L);
            sl_matrix_free(lower);
            factored_free(&y);
        }
    }
}

static void inertia_and_determinant_are_known(void **state) {
    (void)state;
    for (int kind = 0; kind < GEN_REGULAR; kind++) {
        for (int sign = -1; sign <= 1; sign++) {
            factored_t y = factored_make((gen_kind_t)kind, 36, sign, 0, NULL);
            sl_int n = y.M.view.n_cols, negative = 0;
            sl_stats stats;
            double log_det = -1, det_sign = 0, wanted_log = 0, wanted_sign = 1, least = INFINITY,
                   most = 0;
            memset(&stats, 0, sizeof stats);
            stats.factor = sl_factor_view(y.F).info;
            SL_CHECK(sl_factor_logdet(y.F, &log_det, &det_sign));
            for (sl_int k = 0; k < n; k++) {
                double d = sl_factor_view(y.F).D[k];
                negative += d < 0;
                wanted_log += log(fabs(d));
                wanted_sign = d < 0 ? -wanted_sign : wanted_sign;
                least = fabs(d) < least ? fabs(d) : least;
                most = fabs(d) > most ? fabs(d) : most;
            }
            assert_int_equal(stats.factor.negative, negative);
            assert_int_equal(stats.factor.positive, n - negative);
            assert_int_equal(stats.factor.null, 0);
            if (n > 0) {
                assert_true(stats.factor.pivot_min == least && stats.factor.pivot_max == most);
            }
            if (kind == GEN_KKT) {
                /* Sylvester: as many negative pivots as C has rows, in any order */
                assert_int_equal(negative, n / 3);
            } else if (sign) {
                assert_int_equal(negative, sign < 0 ? n : 0);
            }
            assert_true(fabs(log_det - wanted_log) <= 1e-12 * (1.0 + fabs(wanted_log)));
            assert_true(det_sign == wanted_sign);
            factored_free(&y);
        }
    }
    /* 3 x 3 by hand: [2 1 0; 1 -3 1; 0 1 4], det = 2 (-12 - 1) - 1 (4) = -30 */
    const sl_int p[4] = {0, 2, 4, 5}, i[5] = {0, 1, 1, 2, 2};
    const double x[5] = {2, 1, -3, 1, 4};
    sl_csc A = {3, 3, p, i, x};
    sl_symbolic *S = NULL;
    sl_factor *F = NULL;
    double log_det, det_sign;
    SL_CHECK(sl_symbolic_create(&S, &A, NULL, NULL));
    SL_CHECK(sl_factor_create(&F, S, &A, NULL, NULL));
    SL_CHECK(sl_factor_logdet(F, &log_det, &det_sign));
    assert_true(fabs(log_det - log(30.0)) < 1e-14 && det_sign == -1.0);
    SL_EXPECT(SL_ERR_ARGUMENT, sl_factor_logdet(NULL, &log_det, &det_sign));
    sl_factor_free(F);
    sl_symbolic_free(S);
}

/* a determinant far outside the range of double */
static void the_logarithm_of_a_determinant_does_not_overflow(void **state) {
    (void)state;
    enum { N = 600 };
    sl_int p[N + 1], i[N];
    double x[N];
    for (sl_int k = 0; k < N; k++) {
        p[k] = i[k] = k;
        x[k] = -1e300;
    }
    p[N] = N;
    sl_csc A = {N, N, p, i, x};
    sl_symbolic *S = NULL;
    sl_factor *F = NULL;
    double log_det, det_sign;
    SL_CHECK(sl_symbolic_create(&S, &A, NULL, NULL));
    SL_CHECK(sl_factor_create(&F, S, &A, NULL, NULL));
    SL_CHECK(sl_factor_logdet(F, &log_det, &det_sign));
    assert_true(fabs(log_det - N * log(1e300)) < 1e-9 * log_det && det_sign == 1.0);
    sl_factor_free(F);
    sl_symbolic_free(S);
}

static void refactor_equals_create(void **state) {
    (void)state;
    variant_list_t variants = variants_present();
    for (int kind = 0; kind < GEN_REGULAR; kind++) {
        for (int k = 0; k < variants.count; k++) {
            counter_t counter = counter_make();
            sl_options opt = options_counted(&counter);
            options_set_variant(&opt, &variants, k);
            factored_t y = factored_make((gen_kind_t)kind, 60, 0, kind, &opt);
            sl_int nnz = y.M.p[y.M.view.n_cols];
            sl_factor *G = NULL, *H = NULL;
            sl_stats stats;
            memset(&stats, 0, sizeof stats);
            /* other values of the same pattern, then the first ones again */
            double *other = test_reals((size_t)nnz);
            for (sl_int q = 0; q < nnz; q++) {
                other[q] = 3.0 * y.M.x[q];
            }
            sl_csc B = y.M.view;
            B.x = other;
            SL_CHECK(sl_factor_create(&G, y.S, &y.M.view, &opt, NULL));
            SL_CHECK(sl_factor_create(&H, y.S, &B, &opt, NULL));
            size_t calls = counter.calls;
            SL_CHECK(sl_factor_refactor(G, &B, &stats));
            assert_same_bits(G, H);
            SL_CHECK(sl_factor_refactor(G, &y.M.view, &stats));
            assert_same_bits(G, y.F);
            assert_int_equal(counter.calls, calls); /* nothing was allocated */
            free(other);
            sl_factor_free(G);
            sl_factor_free(H);
            factored_free(&y);
            COUNTER_CLEAN(&counter);
        }
    }
}

/* The storage style of A does not affect the bits. */
static void every_style_gives_the_same_bits(void **state) {
    (void)state;
    for (int kind = 0; kind < GEN_REGULAR; kind++) {
        factored_t first = factored_make((gen_kind_t)kind, 40, 0, 0, NULL);
        for (int which = 1; which < GEN_STYLES; which++) {
            factored_t y = factored_make((gen_kind_t)kind, 40, 0, which, NULL);
            assert_same_bits(first.F, y.F);
            factored_free(&y);
        }
        factored_free(&first);
    }
}

static void instruction_sets_agree_to_rounding(void **state) {
    (void)state;
    isa_list_t isas = isas_present();
    for (int kind = 0; kind < GEN_REGULAR; kind++) {
        sl_options opt = options_none();
        opt.isa = SL_ISA_SCALAR;
        factored_t scalar = factored_make((gen_kind_t)kind, 400, 1, 0, &opt);
        for (int k = 1; k < isas.count; k++) {
            opt.isa = isas.isa[k];
            factored_t y = factored_make((gen_kind_t)kind, 400, 1, 0, &opt);
            sl_int n = y.M.view.n_cols;
            double worst = 0;
            for (sl_int j = 0; j < n; j++) {
                double a = sl_factor_view(scalar.F).D[j], b = sl_factor_view(y.F).D[j];
                worst = fabs(a - b) > worst * fabs(a) ? fabs(a - b) / fabs(a) : worst;
            }
            assert_true(worst <= 16.0 * (double)(n + 1) * DBL_EPSILON);
            factored_free(&y);
        }
        factored_free(&scalar);
    }
}

/* The default is the best one present, the last of the list. */
static void the_default_instruction_set_is_the_best(void **state) {
    (void)state;
    isa_list_t isas = isas_present();
    assert_true(isas.count >= 1 && isas.isa[0] == SL_ISA_SCALAR);
    factored_t y = factored_make(GEN_GRID2, 49, 1, 0, NULL);
    sl_stats stats;
    memset(&stats, 0, sizeof stats);
    stats.factor = sl_factor_view(y.F).info;
    assert_int_equal(stats.factor.isa, isas.isa[isas.count - 1]);
    print_message("instruction sets:");
    for (int k = 0; k < isas.count; k++) {
        print_message(" %d", (int)isas.isa[k]);
    }
    print_message("\n");
    factored_free(&y);
}

/* Blocks of some 100 kB to 4 MB that the system has just given, and of 4 MB and more. */
static void memory_of_all_sizes_leaves_errno_alone(void **state) {
    (void)state;
    static const sl_int sides[4] = {30, 50, 80, 120};
    for (int k = 0; k < 4; k++) {
        factored_t y = factored_make(GEN_GRID2, sides[k] * sides[k], 1, 0, NULL);
        sl_factor *again = NULL;
        errno = 77;
        SL_CHECK(sl_factor_create(&again, y.S, &y.M.view, NULL, NULL));
        assert_int_equal(errno, 77);
        sl_factor_free(again);
        factored_free(&y);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(memory_of_all_sizes_leaves_errno_alone), /* first: memory is fresh */
        cmocka_unit_test(ldl_reproduces_a_for_every_method_style_and_sign),
        cmocka_unit_test(every_small_supernode_is_factored),
        cmocka_unit_test(every_small_pair_of_supernodes_is_factored),
        cmocka_unit_test(the_factor_equals_the_dense_reference),
        cmocka_unit_test(sl_factor_lower_returns_l),
        cmocka_unit_test(inertia_and_determinant_are_known),
        cmocka_unit_test(the_logarithm_of_a_determinant_does_not_overflow),
        cmocka_unit_test(refactor_equals_create),
        cmocka_unit_test(every_style_gives_the_same_bits),
        cmocka_unit_test(instruction_sets_agree_to_rounding),
        cmocka_unit_test(the_default_instruction_set_is_the_best),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

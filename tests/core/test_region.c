/* test_region.c: solves in regions against dense inverses and full solves */
#include "tests/lib/check_region.h"

enum { MOST = 5 };

/* Bytes of a region of `boundary` rows. As options.region_bytes they limit boundaries to about that
 * many rows. */
static size_t bytes_for_boundary(const sl_factor *F, sl_int boundary) {
    const sl_symbolic *S = sl_factor_view(F).symbolic;
    sl_int n = sl_symbolic_view(S).n, *rows = test_ints((size_t)n);
    sl_region *R = NULL;
    sl_stats stats;
    memset(&stats, 0, sizeof stats);
    for (sl_int k = 0; k < n; k++) {
        rows[k] = k;
    }
    SL_CHECK(sl_region_create(&R, F, rows, boundary, NULL, NULL, &stats));
    sl_region_free(R);
    free(rows);
    return stats.region.bytes;
}

/* Every pattern of up to 5 rows without relaxation, every set, every byte limit that gives another
 * boundary. Each region solves on all rows inside; for n <= 3 also on every b-set and x-set of
 * them. */
static void every_small_pattern_matches_the_dense_inverse(void **state) {
    (void)state;
    isa_list_t isas = isas_present();
    long with_both = 0, regions = 0;
    for (sl_int n = 1; n <= MOST; n++) {
        for (unsigned edges = 0; edges < 1u << (n * (n - 1) / 2); edges++) {
            gen_matrix_t M = gen_pattern(n, edges, edges + 7);
            sl_options opt = options_none();
            sl_factor *F = NULL;
            sl_work *W = NULL;
            opt.isa = isas.isa[edges % (unsigned)isas.count];
            sl_symbolic *S = analyze_natural(&M.view, SL_RELAXATION_NONE);
            SL_CHECK(sl_factor_create(&F, S, &M.view, FOR_FACTOR(&opt), NULL));
            SL_CHECK(sl_work_create(&W, NULL));
            double *A = ref_dense(&M.view), *Z = ref_inverse(n, A), largest = region_largest(n, Z);
            for (unsigned members = 0; members < 1u << n; members++) {
                sl_int set[MOST], count = 0, before = -1;
                for (sl_int k = 0; k < n; k++) {
                    if (members >> k & 1u) {
                        set[count++] = k;
                    }
                }
                for (sl_int most = 0; most <= count; most++) {
                    sl_region *R = NULL;
                    sl_int inside[MOST];
                    opt.region_bytes = most == 0 ? 1 : bytes_for_boundary(F, most);
                    SL_CHECK(sl_region_create(&R, F, set, count, NULL, FOR_REGION(&opt), NULL));
                    NOTHING_WRONG(check_region(R, set, count));
                    sl_region_arrays r = sl_region_view(R);
                    if (r.n_boundary == before) {
                        sl_region_free(R);
                        continue;
                    }
                    before = r.n_boundary;
                    regions++;
                    with_both += r.n_roots > 0 && r.n_boundary > 0;
                    const sl_int all = region_rows(R, inside);
                    assert_region_solves(R, F, n, Z, largest, inside, all, inside, all, 1, edges,
                                         W);
                    for (unsigned q = 0; n <= 3 && q < 1u << (2 * all); q++) {
                        sl_int b[MOST], x[MOST], nb = 0, nx = 0;
                        for (sl_int k = 0; k < all; k++) {
                            if (q >> k & 1u) {
                                b[nb++] = inside[k];
                            }
                            if (q >> (all + k) & 1u) {
                                x[nx++] = inside[k];
                            }
                        }
                        assert_region_solves(R, F, n, Z, largest, b, nb, x, nx, 1 + (sl_int)(q % 3),
                                             q, W);
                    }
                    sl_region_free(R);
                }
            }
            free(A);
            free(Z);
            sl_work_free(W);
            sl_factor_free(F);
            sl_symbolic_free(S);
            gen_matrix_free(&M);
        }
    }
    print_message("%ld regions, %ld with subtrees and a boundary\n", regions, with_both);
    assert_true(with_both > 1000);
}

/* Collects the rows within `steps` edges of row `seed` into set. Returns their number. */
static sl_int neighborhood(sl_int n, const double *M, sl_int seed, int steps, sl_int *set) {
    char *in = (char *)test_array((size_t)n, 1);
    sl_int count = 1, done = 0;
    set[0] = seed;
    in[seed] = 1;
    for (; steps > 0; steps--) {
        for (sl_int end = count; done < end; done++) {
            for (sl_int i = 0; i < n; i++) {
                if (!in[i] && AT(M, i, set[done]) != 0.0) {
                    in[i] = 1;
                    set[count++] = i;
                }
            }
        }
    }
    free(in);
    return count;
}

/* Neighborhoods, random rows, all rows, no rows; with and without a byte limit; every number of
 * right-hand sides with a kernel of its own. b and x are on random subsets of the rows inside. */
static void every_matrix_kind_matches_the_dense_inverse(void **state) {
    (void)state;
    isa_list_t isas = isas_present();
    uint64_t seed = 3;
    long with_both = 0;
    for (int kind = GEN_NONE; kind < GEN_REGULAR; kind++) {
        for (int which = 0; which < isas.count; which++) {
            sl_options opt = options_none();
            sl_work *W = NULL;
            opt.isa = isas.isa[which];
            opt.relaxation = which % 2 ? SL_RELAXATION_DEFAULT : SL_RELAXATION_NONE;
            factored_t y = factored_make((gen_kind_t)kind, 120, which % 2 ? -1 : 1, 0, &opt);
            sl_int n = y.M.view.n_cols, *set = test_ints((size_t)n + 1),
                   *inside = test_ints((size_t)n + 1), *subset = test_ints((size_t)n + 1);
            double *M = ref_dense(&y.M.view), *Z = ref_scaled_inverse(n, M);
            double largest = kind == GEN_KKT ? region_largest(n, Z) : 0;
            SL_CHECK(sl_work_create(&W, NULL));
            for (int shape = 0; shape < 16; shape++) {
                sl_int count = n == 0       ? 0
                               : shape == 0 ? 0
                               : shape == 1 ? n
                               : shape < 10
                                   ? neighborhood(n, M, gen_below(&seed, n), shape / 2, set)
                                   : 1 + gen_below(&seed, n);
                if (shape == 1 || shape >= 10) {
                    gen_set(set, count, n, gen_bits(&seed));
                }
                for (int bound = 0; bound < 3; bound++) {
                    sl_region *R = NULL;
                    sl_stats stats;
                    memset(&stats, 0, sizeof stats);
                    opt.region_bytes = bound == 0   ? 0
                                       : bound == 1 ? 600 + (size_t)gen_below(&seed, 8000)
                                                    : 1;
                    SL_CHECK(sl_region_create(&R, y.F, set, count, NULL, FOR_REGION(&opt), &stats));
                    NOTHING_WRONG(check_region(R, set, count));
                    assert_true(opt.region_bytes == 0 || stats.region.boundary == 0 ||
                                stats.region.bytes <= opt.region_bytes);
                    with_both += stats.region.boundary > 0 && stats.region.subtrees > 0;
                    const sl_int all = region_rows(R, inside);
                    assert_int_equal(all, stats.region.rows);
                    static const sl_int nrhs[] = {1, 2, 3, 5, 8, 11, 0};
                    for (int q = 0; q < 7; q++) {
                        const sl_int nb = all == 0 ? 0 : gen_below(&seed, all + 1),
                                     nx = q == 1     ? nb
                                          : all == 0 ? 0
                                                     : gen_below(&seed, all + 1);
                        sl_int *order = test_ints((size_t)all + 1);
                        gen_permutation(order, all, gen_bits(&seed));
                        for (sl_int k = 0; k < all; k++) {
                            subset[k] = inside[order[k]];
                        }
                        assert_region_solves(R, y.F, n, Z, largest, subset, nb,
                                             q == 1 ? subset : subset + all - nx, nx, nrhs[q],
                                             gen_bits(&seed), q % 3 ? W : NULL);
                        free(order);
                    }
                    sl_region_free(R);
                }
            }
            sl_work_free(W);
            free(set);
            free(inside);
            free(subset);
            free(M);
            free(Z);
            factored_free(&y);
        }
    }
    print_message("%ld regions with subtrees and a boundary\n", with_both);
    assert_true(with_both > 20 * isas.count);
}

/* A grid large enough for paths of many supernodes. Squares at random positions and across the
 * first separator are solved by plans in regions and compared with full solves. What such a plan
 * reads does not reach the root. */
static void squares_of_a_grid_match_full_solves(void **state) {
    (void)state;
    enum { SIDE = 150, N = SIDE * SIDE, SMALL = 24, COUNT = SMALL * SMALL, PLACES = 24 };
    isa_list_t isas = isas_present();
    uint64_t seed = 12;
    int copied = 0;
    for (int which = 0; which < isas.count; which++) {
        sl_options opt = options_none();
        opt.isa = isas.isa[which];
        factored_t y = factored_make(GEN_GRID2, N, 1, 0, &opt);
        sl_selected *all = NULL;
        assert_int_equal(y.M.view.n_cols, N);
        SL_CHECK(sl_selected_create(&all, y.F, NULL, SL_ALL, NULL, NULL));
        for (int place = 0; place < PLACES / isas.count; place++) {
            const sl_int top = place == 0 ? (SIDE - SMALL) / 2 : gen_below(&seed, SIDE - SMALL),
                         left = place == 0 ? top : gen_below(&seed, SIDE - SMALL);
            sl_int set[COUNT];
            double *full = test_reals(3 * N), *B = test_reals(3 * COUNT),
                   *X = test_reals(3 * COUNT), *Y = test_reals(3 * COUNT), largest = 0;
            sl_region *R = NULL;
            sl_plan *P = NULL;
            sl_stats stats;
            memset(&stats, 0, sizeof stats);
            for (sl_int k = 0; k < COUNT; k++) {
                set[k] = (top + k / SMALL) * SIDE + left + k % SMALL;
            }
            gen_reals(B, 3 * COUNT, gen_bits(&seed));
            for (sl_int k = 0; k < 3 * COUNT; k++) {
                full[N * (k / COUNT) + set[k % COUNT]] = B[k];
            }
            SL_CHECK(sl_factor_solve(y.F, full, N, full, N, 3, NULL));
            for (sl_int k = 0; k < 3 * N; k++) {
                largest = fabs(full[k]) > largest ? fabs(full[k]) : largest;
            }
            SL_CHECK(sl_plan_create(&P, y.S, set, COUNT, set, COUNT, NULL, &stats));
            sl_plan_free(P);
            const sl_off without = stats.plan.b_entries;
            SL_CHECK(sl_region_create(&R, y.F, set, COUNT, NULL, NULL, &stats));
            assert_int_equal(stats.region.is_copied, 0);
            NOTHING_WRONG(check_region(R, set, COUNT));
            opt.region = R;
            SL_CHECK(sl_plan_create(&P, y.S, set, COUNT, set, COUNT, FOR_PLAN(&opt), &stats));
            assert_int_equal(stats.plan.in_region, 1);
            assert_int_equal(stats.plan.region_entries, stats.region.entries);
            assert_true(stats.plan.b_entries + stats.plan.x_entries + stats.plan.region_entries <
                        without);
            SL_CHECK(sl_plan_solve(P, y.F, X, COUNT, B, COUNT, 3, NULL));
            /* The bound is the height of the tree times a small factor. */
            for (sl_int k = 0; k < 3 * COUNT; k++) {
                assert_true(fabs(X[k] - full[N * (k / COUNT) + set[k % COUNT]]) <=
                            1000 * DBL_EPSILON * largest);
            }
            /* The same with values copied from a selected inverse where it holds them all, and
             * computed where it does not. */
            for (int how = 0; how < 2; how++) {
                if (how == 0) {
                    SL_CHECK(sl_region_refactor(R, y.F, all, NULL));
                } else {
                    sl_plan_free(P);
                    sl_region_free(R);
                    SL_CHECK(sl_region_create(&R, y.F, set, COUNT, all, NULL, &stats));
                    NOTHING_WRONG(check_region(R, set, COUNT));
                    copied += stats.region.is_copied && stats.region.boundary > 0;
                    opt.region = R;
                    SL_CHECK(sl_plan_create(&P, y.S, set, COUNT, set, COUNT, FOR_PLAN(&opt), NULL));
                }
                SL_CHECK(sl_plan_solve(P, y.F, Y, COUNT, B, COUNT, 3, NULL));
                for (sl_int k = 0; k < 3 * COUNT; k++) {
                    assert_true(fabs(X[k] - Y[k]) <= 1000 * DBL_EPSILON * largest);
                }
            }
            sl_plan_free(P);
            sl_region_free(R);
            SL_CHECK(sl_region_create(&R, y.F, set, 1, all, NULL, &stats)); /* one vertex */
            assert_int_equal(stats.region.boundary, 1);
            assert_int_equal(stats.region.is_copied, 1);
            opt.region = R;
            SL_CHECK(sl_plan_create(&P, y.S, set, 1, set, 1, FOR_PLAN(&opt), NULL));
            SL_CHECK(sl_plan_solve(P, y.F, X, 1, B, 1, 1, NULL));
            SL_CHECK(sl_selected_entries(all, Y, set, NULL, 1, NULL));
            assert_true(fabs(X[0] - B[0] * Y[0]) <= 4 * DBL_EPSILON * fabs(X[0]));
            sl_plan_free(P);
            sl_region_free(R);
            SL_CHECK(sl_region_create(&R, y.F, set, 2, all, NULL, &stats)); /* and its neighbor */
            NOTHING_WRONG(check_region(R, set, 2));
            assert_in_range(stats.region.boundary, 2, 100); /* the subtree to the root costs more */
            sl_region_free(R);
            free(full);
            free(B);
            free(X);
            free(Y);
        }
        sl_selected_free(all);
        factored_free(&y);
    }
    print_message("%d squares copied from the selected inverse\n", copied);
    assert_true(copied > 0);
}

/* With a selected inverse: neighbors, for which a subtree may hold all entries, and sets in several
 * subtrees, for which only large ones do. */
static void neighbors_and_spread_sets_match_the_dense_inverse(void **state) {
    (void)state;
    enum { REGIONS = 40 };
    factored_t y = factored_make(GEN_GRID2, 400, 1, 0, NULL);
    sl_int n = y.M.view.n_cols, *set = test_ints((size_t)n);
    double *M = ref_dense(&y.M.view), *Z = ref_scaled_inverse(n, M);
    sl_selected *all = NULL;
    uint64_t seed = 5;
    int copied = 0;
    SL_CHECK(sl_selected_create(&all, y.F, NULL, SL_ALL, NULL, NULL));
    for (int k = 0; k < REGIONS; k++) {
        const sl_int count = 2 + k % 3, first = gen_below(&seed, n - count);
        sl_region *R = NULL;
        sl_stats stats;
        gen_set(set, count, n, gen_bits(&seed));
        for (sl_int q = 0; q < count && k % 2 == 0; q++) {
            set[q] = first + q;
        }
        SL_CHECK(sl_region_create(&R, y.F, set, count, all, NULL, &stats));
        NOTHING_WRONG(check_region(R, set, count));
        copied += stats.region.is_copied;
        assert_region_solves(R, y.F, n, Z, 0, set, count, set, count, 2, gen_bits(&seed), NULL);
        sl_region_free(R);
    }
    assert_in_range(copied, 1, REGIONS - 1);
    sl_selected_free(all);
    free(set);
    free(M);
    free(Z);
    factored_free(&y);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_small_pattern_matches_the_dense_inverse),
        cmocka_unit_test(every_matrix_kind_matches_the_dense_inverse),
        cmocka_unit_test(squares_of_a_grid_match_full_solves),
        cmocka_unit_test(neighbors_and_spread_sets_match_the_dense_inverse),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

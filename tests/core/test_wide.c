/* test_wide.c: blocks of 16, 32 and 64 right-hand sides have the bits of blocks of 8 */
#include "tests/lib/factored.h"
#include "tests/lib/reserved.h"

enum { MOST = 75, PAD = 3 };

/* Solves 8 columns at a time; the last block has the rest. */
static void solve_by_eight(const sl_plan *P, const sl_factor *F, double *X, size_t ldx,
                           const double *B, size_t ldb, sl_int nrhs) {
    for (sl_int r = 0; r < nrhs; r += 8) {
        const sl_int block = nrhs - r < 8 ? nrhs - r : 8;
        double *x = X + ldx * (size_t)r;
        const double *b = B + ldb * (size_t)r;
        SL_CHECK(P ? sl_plan_solve(P, F, x, ldx, b, ldb, block, NULL)
                   : sl_factor_solve(F, x, ldx, b, ldb, block, NULL));
    }
}

/* The other layout: count x nrhs values with leading dimension ld to rows of ldr elements. */
static void interleave(double *R, size_t ldr, const double *M, size_t ld, size_t count,
                       size_t nrhs) {
    for (size_t q = 0; q < count * nrhs; q++) {
        R[q / nrhs * ldr + q % nrhs] = M[q % nrhs * ld + q / nrhs];
    }
}

/* One query, full if P is NULL: both layouts, in a workspace that was reserved for it. */
static void check_query(const sl_plan *P, const sl_factor *F, sl_int nb, sl_int nx, sl_int nrhs,
                        uint64_t seed) {
    const size_t cols = (size_t)nrhs, ldb = (size_t)nb + PAD, ldx = (size_t)nx + PAD;
    double *B = test_reals(ldb * cols), *X = test_reals(ldx * cols), *Y = test_reals(ldx * cols);
    double *Bi = test_reals((size_t)nb * (cols + 1)), *Xi = test_reals((size_t)nx * cols),
           *Yi = test_reals((size_t)nx * cols);
    sl_work *W = NULL;
    gen_reals(B, ldb * cols, seed);
    for (size_t q = 0; q < ldx * cols; q++) {
        X[q] = Y[q] = 1234.5; /* the padding is not written */
    }
    solve_by_eight(P, F, Y, ldx, B, ldb, nrhs);
    SL_CHECK(sl_work_create(&W, NULL));
    RESERVE_FOR(W, NULL,
                P ? sl_plan_solve(P, F, X, ldx, B, ldb, nrhs, trial)
                  : sl_factor_solve(F, X, ldx, B, ldb, nrhs, trial));
    const size_t bytes = sl_work_bytes(W);
    SL_CHECK(P ? sl_plan_solve(P, F, X, ldx, B, ldb, nrhs, W)
               : sl_factor_solve(F, X, ldx, B, ldb, nrhs, W));
    SAME_VALUES(X, Y, ldx * cols);
    interleave(Bi, cols + 1, B, ldb, (size_t)nb, cols);
    interleave(Yi, cols, Y, ldx, (size_t)nx, cols);
    SL_CHECK(P ? sl_plan_solve(P, F, Xi, SL_ROWS(cols), Bi, SL_ROWS(cols + 1), nrhs, W)
               : sl_factor_solve(F, Xi, SL_ROWS(cols), Bi, SL_ROWS(cols + 1), nrhs, W));
    SAME_VALUES(Xi, Yi, (size_t)nx * cols);
    assert_int_equal(bytes, sl_work_bytes(W));
    sl_work_free(W);
    free(B);
    free(X);
    free(Y);
    free(Bi);
    free(Xi);
    free(Yi);
}

/* Full solves and plans with random sets, of every instruction set, both types of L and both forms
 * of D. The volume has supernodes wider than two row tiles. */
static void bits_are_those_of_blocks_of_eight(void **state) {
    (void)state;
    static const struct {
        gen_kind_t kind;
        sl_int size;
    } cases[] = {{GEN_GRID3, 700}, {GEN_GRID2, 300}, {GEN_DENSE, 45}, {GEN_FOREST, 90},
                 {GEN_KKT, 130},   {GEN_ONE, 1},     {GEN_STAR, 30}};
    static const sl_int counts[] = {15, 16, 17, 24, 31, 32, 40, 48, 59, 64, MOST};
    isa_list_t isas = isas_present();
    uint64_t seed = 21;
    for (int k = 0; k < isas.count; k++) {
        for (size_t c = 0; c < sizeof cases / sizeof *cases; c++) {
            for (int is_float = 0; is_float < 2; is_float++) {
                sl_options opt = options_none();
                opt.isa = isas.isa[k];
                opt.storage = is_float ? SL_STORAGE_FLOAT : SL_STORAGE_DOUBLE;
                factored_t y = factored_make(cases[c].kind, cases[c].size, 0, 0, &opt);
                const sl_int n = y.M.view.n_cols;
                for (size_t q = 0; q < sizeof counts / sizeof *counts; q++) {
                    const sl_int nb = 1 + gen_below(&seed, n), nx = 1 + gen_below(&seed, n);
                    sl_int *bset = test_ints((size_t)n), *xset = test_ints((size_t)n);
                    sl_plan *P = NULL;
                    gen_set(bset, nb, n, gen_bits(&seed));
                    gen_set(xset, nx, n, gen_bits(&seed));
                    SL_CHECK(sl_plan_create(&P, y.S, bset, nb, xset, nx, NULL, NULL));
                    check_query(NULL, y.F, n, n, counts[q], gen_bits(&seed));
                    check_query(P, y.F, nb, nx, counts[q], gen_bits(&seed));
                    sl_plan_free(P);
                    free(bset);
                    free(xset);
                }
                factored_free(&y);
            }
        }
    }
}

/* Plans that end at the boundary of a region. */
static void regions_take_wide_blocks(void **state) {
    (void)state;
    isa_list_t isas = isas_present();
    for (int k = 0; k < isas.count; k++) {
        sl_options opt = options_none();
        opt.isa = isas.isa[k];
        factored_t y = factored_make(GEN_GRID2, 900, 0, 0, &opt);
        sl_int set[40];
        sl_region *R = NULL;
        sl_plan *P = NULL;
        sl_stats stats;
        for (sl_int q = 0; q < 40; q++) {
            set[q] = q;
        }
        SL_CHECK(sl_region_create(&R, y.F, set, 40, NULL, NULL, &stats));
        assert_true(stats.region.boundary > 0);
        opt = options_none();
        opt.region = R;
        SL_CHECK(sl_plan_create(&P, y.S, set, 40, set + 5, 20, &opt, &stats));
        assert_true(stats.plan.region_entries > 0);
        check_query(P, y.F, 40, 20, MOST, 4);
        sl_plan_free(P);
        sl_region_free(R);
        factored_free(&y);
    }
}

/* Vectors beyond the caches, whose rows are prefetched: full solves and plans. */
static void large_vectors_have_the_same_bits(void **state) {
    (void)state;
    isa_list_t isas = isas_present();
    for (int k = 0; k < isas.count; k++) {
        for (int is_float = 0; is_float < 2; is_float++) {
            sl_options opt = options_none();
            opt.isa = isas.isa[k];
            opt.storage = is_float ? SL_STORAGE_FLOAT : SL_STORAGE_DOUBLE;
            factored_t y = factored_make(GEN_GRID2, 17000, 0, 0, &opt);
            const sl_int n = y.M.view.n_cols;
            sl_int *set = test_ints((size_t)n);
            sl_plan *P = NULL;
            assert_true(n * 32.0 * sizeof(double) > 4.2e6);
            gen_set(set, n - 50, n, 8);
            SL_CHECK(sl_plan_create(&P, y.S, set, n - 50, set, 100, NULL, NULL));
            check_query(NULL, y.F, n, n, 32, 6);
            check_query(P, y.F, n - 50, 100, 33, 7);
            sl_plan_free(P);
            free(set);
            factored_free(&y);
        }
    }
}

/* X may be B, whose blocks are read before they are written. */
static void solves_in_place(void **state) {
    (void)state;
    factored_t y = factored_make(GEN_GRID2, 250, 0, 0, NULL);
    const size_t n = (size_t)y.M.view.n_cols;
    double *B = test_reals(n * MOST), *X = test_reals(n * MOST);
    gen_reals(B, n * MOST, 9);
    solve_by_eight(NULL, y.F, X, n, B, n, MOST);
    SL_CHECK(sl_factor_solve(y.F, B, n, B, n, MOST, NULL));
    SAME_VALUES(X, B, n * MOST);
    free(B);
    free(X);
    factored_free(&y);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(bits_are_those_of_blocks_of_eight),
        cmocka_unit_test(regions_take_wide_blocks),
        cmocka_unit_test(large_vectors_have_the_same_bits),
        cmocka_unit_test(solves_in_place),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

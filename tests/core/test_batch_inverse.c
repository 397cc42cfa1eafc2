/* test_batch_inverse.c: sl_batch_diagonal: the bits of single calls, heat kernels, errors */
#include "tests/lib/factor_array.h"

#include "tools/mesh/grid.h"
#include "tools/geometry/laplacian.h"

/* The bits of sl_inverse_diagonal, and the diagonals of dense inverses: c n eps relative to the
 * entry, c = 100, as for definite matrices in test_inverse. */
static void diagonals_equal_those_of_single_calls(void **state) {
    (void)state;
    isa_list_t isas = isas_present();
    double c[TERMS * MOST];
    coefficients_of(c, MOST, 0.01);
    for (int isa = 0; isa < isas.count; isa++) {
        matrix_pair_t y = matrix_pair_make(GEN_GRID2, 150, 2, 3, NULL);
        size_t n = (size_t)y.n, ld = n + 3;
        sl_options opt = options_none();
        sl_factor *F[MOST] = {NULL};
        sl_work *works[4];
        sl_int rows[50];
        uint64_t seed = 8;
        double *out = test_reals(ld * MOST), *one = test_reals(n);
        opt.isa = isas.isa[isa];
        SL_CHECK(sl_factor_create_sums(F, MOST, y.S, c, matrix_pair_values(&y), TERMS, &opt, NULL,
                                       NULL));
        for (int k = 0; k < 50; k++) {
            rows[k] = gen_below(&seed, y.n); /* with repetitions */
        }
        for (int k = 0; k < 4; k++) {
            SL_CHECK(sl_work_create(&works[k], NULL));
        }
        for (int threads = 0; threads <= 4; threads++) {
            for (int all = 0; all < 2; all++) {
                for (int own = 0; own < 2; own++) {
                    size_t count = all ? n : 50;
                    int calls = 0;
                    const sl_threads t = threads_of(threads, &calls);
                    for (size_t k = 0; k < ld * MOST; k++) {
                        out[k] = 4321.5;
                    }
                    SL_CHECK(sl_batch_diagonal(F, MOST, out, ld, all ? NULL : rows, 50,
                                               threads ? THREADS(t) : NULL, own ? NULL : works,
                                               NULL, NULL));
                    assert_int_equal(calls, threads > 1);
                    for (size_t k = 0; k < MOST; k++) {
                        SL_CHECK(sl_inverse_diagonal(F[k], one, all ? NULL : rows,
                                                     all ? SL_ALL : 50, NULL, NULL));
                        SAME_VALUES(out + k * ld, one, count);
                        for (size_t i = count; i < ld; i++) {
                            assert_true(out[i + k * ld] == 4321.5);
                        }
                    }
                }
            }
        }
        for (int k = 0; k < MOST; k++) {
            sl_matrix *A = matrix_pair_sum(&y, c + TERMS * k);
            sl_csc view = sl_matrix_view(A);
            double *M = ref_dense(&view), *Z = ref_inverse(y.n, M);
            for (size_t i = 0; i < n; i++) {
                const double z = Z[i + i * n];
                assert_true(fabs(out[i + (size_t)k * ld] - z) <= 10 * pass_figure(y.n) * fabs(z));
            }
            free(M);
            free(Z);
            sl_matrix_free(A);
        }
        for (int k = 0; k < 4; k++) {
            sl_work_free(works[k]);
        }
        free_all(F, MOST);
        free(out);
        free(one);
        matrix_pair_free(&y);
    }
}

/* Heat-kernel signatures of a mesh by the recipe of the header: M is diagonal, L is stored without
 * its diagonal, several t. */
static void heat_kernel_signatures_conserve_heat(void **state) {
    (void)state;
    enum { TIMES = 4 };
    const double t[TIMES] = {1e-3, 1e-2, 0.1, 1};
    mesh grid;
    assert_true(mesh_grid(&grid, 9, 8, 0.2, 5));
    sl_int n = grid.n_vertices, *p = test_ints((size_t)n + 1), *i = test_ints((size_t)n);
    double *mass = test_reals((size_t)n), *h = test_reals((size_t)n * TIMES), *v[TERMS];
    double c[TERMS * TIMES], before = INFINITY;
    sl_matrix *L = NULL, *U = NULL;
    sl_symbolic *S = NULL;
    sl_factor *F[TIMES];
    laplacian_mass(mass, &grid);
    for (sl_int k = 0; k < n; k++) {
        i[k] = k;
        p[k + 1] = k + 1;
    }
    assert_true(laplacian_cotangent(&L, &grid));
    const sl_csc terms[TERMS] = {{n, n, p, i, mass}, sl_matrix_view(L)};
    SL_CHECK(sl_matrix_sum(&U, NULL, terms, TERMS, NULL, NULL));
    const sl_csc A = sl_matrix_view(U);
    SL_CHECK(sl_symbolic_create(&S, &A, NULL, NULL));
    for (int k = 0; k < TERMS; k++) {
        v[k] = test_reals((size_t)scatter_length(S));
        SL_CHECK(sl_symbolic_scatter(S, v[k], &terms[k], NULL));
    }
    for (int k = 0; k < TIMES; k++) {
        c[TERMS * k] = 1;
        c[TERMS * k + 1] = t[k];
    }
    SL_CHECK(
        sl_factor_create_sums(F, TIMES, S, c, (const double *const *)v, TERMS, NULL, NULL, NULL));
    SL_CHECK(sl_batch_diagonal(F, TIMES, h, (size_t)n, NULL, 0, NULL, NULL, NULL, NULL));
    for (int k = 0; k < TIMES; k++) {
        sl_matrix *system = NULL;
        assert_true(laplacian_system(&system, &grid, t[k]));
        sl_csc view = sl_matrix_view(system);
        double *M = ref_dense(&view), *Z = ref_inverse(n, M), trace = 0;
        for (sl_int row = 0; row < n; row++) {
            double got = h[(size_t)row + (size_t)k * (size_t)n], heat = 0;
            assert_true(fabs(got - AT(Z, row, row)) <= 10 * pass_figure(n) * got);
            for (sl_int other = 0; other < n; other++) { /* heat is conserved */
                heat += AT(Z, row, other) * mass[other];
            }
            assert_true(fabs(heat - 1) <= 100 * pass_figure(n));
            trace += got * mass[row];
        }
        /* sum of 1 / (1 + t lambda) over the eigenvalues; lambda = 0 contributes 1 */
        assert_true(trace > 1 && trace < before);
        before = trace;
        free(M);
        free(Z);
        sl_matrix_free(system);
    }
    free_all(F, TIMES);
    for (int k = 0; k < TERMS; k++) {
        free(v[k]);
    }
    sl_symbolic_free(S);
    sl_matrix_free(U);
    sl_matrix_free(L);
    mesh_free(&grid);
    free(p);
    free(i);
    free(mass);
    free(h);
}

/* A parallel-for whose bodies may not allocate. */
static void run_without_memory(void *context, sl_int count, void (*body)(void *data, sl_int k),
                               void *data) {
    counter_t *counter = (counter_t *)context;
    counter->fail_at = (int64_t)counter->calls;
    for (sl_int k = count - 1; k >= 0; k--) {
        body(data, k);
    }
    assert_int_equal(counter->fail_at, counter->calls);
    counter->fail_at = -1;
}

/* Factors of several instruction sets, whose sweeps need different amounts of scratch, in one call:
 * the maximum is reserved in advance. */
static void factors_of_several_instruction_sets_share_a_call(void **state) {
    (void)state;
    isa_list_t isas = isas_present();
    matrix_pair_t y = matrix_pair_make(GEN_GRID2, 400, 0, 0, NULL);
    const double c[TERMS] = {1, 1};
    sl_factor *F[4] = {NULL};
    counter_t counter = counter_make();
    sl_options opt = options_counted(&counter);
    double *out = test_reals((size_t)y.n * 4), *one = test_reals((size_t)y.n);
    const sl_threads threads = {3, run_without_memory, &counter};
    for (int k = 0; k < isas.count; k++) {
        opt.isa = isas.isa[k];
        SL_CHECK(sl_factor_create_sums(&F[k], 1, y.S, c, matrix_pair_values(&y), TERMS, &opt, NULL,
                                       NULL));
    }
    SL_CHECK(sl_batch_diagonal(F, isas.count, out, (size_t)y.n, NULL, 0, THREADS(threads), NULL,
                               NULL, NULL));
    for (int k = 0; k < isas.count; k++) {
        SL_CHECK(sl_inverse_diagonal(F[k], one, NULL, SL_ALL, NULL, NULL));
        SAME_VALUES(out + (size_t)k * (size_t)y.n, one, (size_t)y.n);
    }
    free_all(F, 4);
    free(out);
    free(one);
    matrix_pair_free(&y);
    COUNTER_CLEAN(&counter);
}

static void invalid_arguments_of_diagonals_are_refused(void **state) {
    (void)state;
    matrix_pair_t y = matrix_pair_make(GEN_GRID2, 25, 0, 1, NULL),
                  z = matrix_pair_make(GEN_PATH, 25, 0, 1, NULL);
    double c[TERMS * MOST], before[TERMS * MOST];
    sl_factor *F[3], *G[1];
    sl_int failed = 9;
    sl_threads threads = {-1, NULL, NULL};
    coefficients_of(c, MOST, 1);
    memcpy(before, c, sizeof c);
    SL_CHECK(sl_factor_create_sums(F, 3, y.S, c, matrix_pair_values(&y), TERMS, NULL, NULL, NULL));
    SL_CHECK(sl_factor_create_sums(G, 1, z.S, c, matrix_pair_values(&z), TERMS, NULL, NULL, NULL));
    sl_factor *mixed[3] = {F[0], F[1], G[0]}, *bare[3] = {F[0], NULL, F[1]};
    sl_int rows[2] = {3, 25};
    sl_stats stats;
    SL_EXPECT(SL_ERR_ARGUMENT, sl_batch_diagonal(F, 3, c, 2, rows, 2, NULL, NULL, &failed, &stats));
    assert_true(failed == -1 && stats.error.row == 25);
    SL_EXPECT(SL_ERR_ARGUMENT, sl_batch_diagonal(F, 3, c, 1, rows, -1, NULL, NULL, &failed, NULL));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_batch_diagonal(F, 3, NULL, 1, rows, 1, NULL, NULL, NULL, NULL));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_batch_diagonal(F, 3, c, 0, rows, 1, NULL, NULL, NULL, NULL));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_batch_diagonal(F, 3, c, 24, NULL, 0, NULL, NULL, NULL, NULL));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_batch_diagonal(NULL, 3, c, 1, rows, 1, NULL, NULL, NULL, NULL));
    SL_EXPECT(SL_ERR_ARGUMENT, sl_batch_diagonal(F, -1, c, 1, rows, 1, NULL, NULL, NULL, NULL));
    SL_EXPECT(SL_ERR_ARGUMENT,
              sl_batch_diagonal(F, 3, c, 1, rows, 1, THREADS(threads), NULL, NULL, NULL));
    SL_EXPECT(SL_ERR_MISMATCH,
              sl_batch_diagonal(mixed, 3, c, 1, rows, 1, NULL, NULL, &failed, NULL));
    assert_int_equal(failed, 2);
    SL_EXPECT(SL_ERR_ARGUMENT,
              sl_batch_diagonal(bare, 3, c, 1, rows, 1, NULL, NULL, &failed, NULL));
    assert_int_equal(failed, 1);
    sl_work *works[2] = {NULL, NULL};
    int calls = 0;
    threads = threads_of(2, &calls);
    SL_EXPECT(SL_ERR_ARGUMENT,
              sl_batch_diagonal(F, 3, c, 1, rows, 1, THREADS(threads), works, NULL, NULL));
    SL_CHECK(sl_work_create(&works[0], NULL));
    works[1] = works[0];
    SL_EXPECT(SL_ERR_ARGUMENT,
              sl_batch_diagonal(F, 3, c, 1, rows, 1, THREADS(threads), works, NULL, NULL));
    sl_work_free(works[0]);
    assert_true(calls == 0 && memcmp(c, before, sizeof c) == 0);
    SL_CHECK(sl_batch_diagonal(F, 3, NULL, 0, rows, 0, THREADS(threads), NULL, &failed, &stats));
    SL_CHECK(sl_batch_diagonal(NULL, 0, NULL, 0, NULL, 0, THREADS(threads), NULL, NULL, NULL));
    free_all(F, 3);
    free_all(G, 1);
    matrix_pair_free(&y);
    matrix_pair_free(&z);
}

/* A factor whose allocation fails leaves its output unchanged; workspaces that have grown allocate
 * nothing. */
static void a_failed_allocation_leaves_the_output(void **state) {
    (void)state;
    matrix_pair_t y = matrix_pair_make(GEN_GRID2, 100, 0, 2, NULL);
    double c[TERMS * 4], out[16];
    const sl_int rows[4] = {1, 50, 50, 7};
    counter_t counter = counter_make();
    sl_options opt = options_counted(&counter);
    sl_factor *F[4];
    int calls = 0;
    const sl_threads threads = threads_of(3, &calls);
    coefficients_of(c, 4, 1);
    SL_CHECK(sl_factor_create_sums(F, 4, y.S, c, matrix_pair_values(&y), TERMS, FOR_FACTOR(&opt),
                                   NULL, NULL));
    for (int own = 0; own < 2; own++) {
        sl_status status = SL_ERR_MEMORY;
        for (int64_t k = 0; status != SL_OK; k++) {
            sl_work *works[3] = {NULL, NULL, NULL};
            size_t live = counter.live_blocks, requests;
            for (int j = 0; j < 3; j++) {
                SL_CHECK(sl_work_create(&works[j], &opt));
            }
            requests = counter.calls;
            counter.fail_at = (int64_t)requests + k;
            out[0] = 4321;
            status = sl_batch_diagonal(F, 4, out, 4, rows, 4, THREADS(threads), own ? NULL : works,
                                       NULL, NULL);
            assert_true(status == SL_OK || status == SL_ERR_MEMORY);
            assert_true((status == SL_OK) == (out[0] != 4321));
            assert_int_equal(status == SL_ERR_MEMORY, counter.calls > requests + (size_t)k);
            counter.fail_at = -1;
            if (status == SL_OK && !own) {
                requests = counter.calls;
                SL_CHECK(
                    sl_batch_diagonal(F, 4, out, 4, rows, 4, THREADS(threads), works, NULL, NULL));
                assert_int_equal(counter.calls, requests);
            }
            for (int j = 0; j < 3; j++) {
                sl_work_free(works[j]);
            }
            assert_int_equal(counter.live_blocks, live);
        }
    }
    free_all(F, 4);
    matrix_pair_free(&y);
    COUNTER_CLEAN(&counter);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(diagonals_equal_those_of_single_calls),
        cmocka_unit_test(heat_kernel_signatures_conserve_heat),
        cmocka_unit_test(factors_of_several_instruction_sets_share_a_call),
        cmocka_unit_test(invalid_arguments_of_diagonals_are_refused),
        cmocka_unit_test(a_failed_allocation_leaves_the_output),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

/* test_inverse_nulls.c: entries of the inverse where null pivots were skipped: exact zeros */
#include "tests/lib/matrix_pair.h"
#include "tests/lib/parallel_for.h"

enum { SIDE = 7, GRID = SIDE * SIDE, ROWS = GRID + 7 };

/* A grid Laplacian, a row of zeros, a path of springs of negative weight, and a regular row: three
 * null pivots, and pivots of both signs. With is_pair each row is two, as those of a complex
 * matrix. */
static gen_matrix_t several_components(int is_pair) {
    const sl_int times = is_pair ? 2 : 1;
    gen_list_t t = gen_list(times * ROWS);
    double diagonal[ROWS] = {0.0};
    for (sl_int j = 0; j < ROWS - 2; j++) {
        for (int e = 0; e < 2; e++) {
            const sl_int i = e == 0 ? j + 1 : j + SIDE;
            const double w = j < GRID ? 1.0 : -2.0;
            if (j == GRID || (j < GRID && (e == 0 ? i % SIDE == 0 : i >= GRID)) ||
                (j > GRID && e == 1)) {
                continue;
            }
            diagonal[i] += w;
            diagonal[j] += w;
            for (sl_int k = 0; k < times * times; k++) {
                gen_add(&t, times * i + k / times, times * j + k % times,
                        k / times == k % times ? -w : 0.0);
            }
        }
    }
    diagonal[ROWS - 1] = 3.0;
    for (sl_int j = 0; j < ROWS; j++) {
        gen_add(&t, times * j, times * j, diagonal[j]);
        if (is_pair) {
            gen_add(&t, 2 * j + 1, 2 * j, 0.0);
            gen_add(&t, 2 * j + 1, 2 * j + 1, diagonal[j]);
        }
    }
    const gen_matrix_t M = gen_store(&t, gen_style(0), 1);
    gen_list_free(&t);
    return M;
}

/* Every way to an entry of a null row or column gives 0, not a number divided by a huge one. */
static void check_zeros(sl_factor *F, const sl_symbolic *S, sl_int nulls) {
    const sl_int n = sl_symbolic_view(S).n;
    const size_t size = (size_t)n;
    sl_int *null_rows = test_ints(size), *all = test_ints(size), *same = test_ints(size), count = 0;
    double *d = test_reals(size), *B = test_reals(size * size);
    sl_selected *Z = NULL;
    for (sl_int i = 0; i < n; i++) {
        all[i] = i;
    }
    SL_CHECK(sl_factor_pivot_rows(F, SL_PIVOT_NULL, null_rows, NULL, n, &count));
    assert_int_equal(count, nulls);
    SL_CHECK(sl_selected_create(&Z, F, NULL, SL_ALL, NULL, NULL));
    SL_CHECK(sl_inverse_block(F, B, size, all, n, all, n, NULL, NULL));
    for (int way = 0; way < 3; way++) {
        if (way == 0) {
            SL_CHECK(sl_inverse_diagonal(F, d, NULL, SL_ALL, NULL, NULL));
        } else if (way == 1) {
            SL_CHECK(sl_inverse_diagonal(F, d, all, n, NULL, NULL));
        } else {
            SL_CHECK(sl_selected_entries(Z, d, NULL, NULL, SL_ALL, NULL));
        }
        for (sl_int k = 0; k < count; k++) {
            assert_true(d[null_rows[k]] == 0.0);
        }
        for (sl_int i = 0, zeros = 0; i < n; i++) {
            zeros += d[i] == 0.0;
            assert_true(i < n - 1 || zeros == nulls);
        }
    }
    for (sl_int k = 0; k < count; k++) {
        const sl_int row = null_rows[k];
        for (sl_int i = 0; i < n; i++) {
            same[i] = row;
            double z = 0.0;
            assert_true(AT(B, i, row) == 0.0 && AT(B, row, i) == 0.0);
            SL_CHECK(sl_inverse_pairs(F, &z, &i, &row, 1, NULL, NULL));
            assert_true(z == 0.0);
            if (sl_selected_entries(Z, &z, &i, &row, 1, NULL) == SL_OK) {
                assert_true(z == 0.0);
            }
        }
        SL_CHECK(sl_inverse_pairs(F, d, all, same, n, NULL, NULL));
        for (sl_int i = 0; i < n; i++) {
            assert_true(d[i] == 0.0);
        }
    }
    sl_selected_free(Z);
    free(null_rows);
    free(all);
    free(same);
    free(d);
    free(B);
}

static void entries_of_null_rows_are_exactly_zero(void **state) {
    (void)state;
    static const sl_storage storages[3] = {SL_STORAGE_DOUBLE, SL_STORAGE_FLOAT, SL_STORAGE_DOUBLE};
    isa_list_t isas = isas_present();
    for (int k = 0; k < 3 * isas.count; k++) {
        const int is_pair = k % 3 == 2;
        const gen_matrix_t M = several_components(is_pair);
        sl_options opt = options_none();
        sl_int signs[2 * ROWS];
        sl_symbolic *S = NULL;
        sl_factor *F = NULL;
        for (sl_int i = 0; i < 2 * ROWS; i++) {
            const sl_int row = is_pair ? i / 2 : i;
            signs[i] = row > GRID && row < ROWS - 1 ? -1 : 1;
        }
        opt.block_size = is_pair ? 2 : 0;
        opt.isa = isas.isa[k / 3];
        opt.storage = storages[k % 3];
        opt.pivots = SL_PIVOTS_SKIP_NULL;
        opt.signs = signs;
        SL_CHECK(sl_symbolic_create(&S, &M.view, FOR_ANALYSIS(&opt), NULL));
        SL_CHECK(sl_factor_create(&F, S, &M.view, FOR_FACTOR(&opt), NULL));
        check_zeros(F, S, is_pair ? 6 : 3);
        sl_factor_free(F);
        sl_symbolic_free(S);
        gen_matrix_t own = M;
        gen_matrix_free(&own);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(entries_of_null_rows_are_exactly_zero),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

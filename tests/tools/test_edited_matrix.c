/* test_edited_matrix.c: matrices edited in and outside of their pattern, against dense ones */
#include "tests/lib/test.h"

#include "tools/matrix/edited_matrix.h"
#include "tools/mesh/grid.h"

enum { SIDE = 6, N = SIDE * SIDE };

static void assert_equals(const edited_matrix *m, double dense[N][N]) {
    sl_matrix *whole = NULL;
    int entries = 0;
    for (sl_int i = 0; i < N; i++) {
        triplets row = {0, 0, NULL, NULL, NULL};
        int in_row = 0;
        for (sl_int j = 0; j < N; j++) {
            assert_true(edited_matrix_get(m, i, j) == dense[i][j]);
            in_row += i != j && dense[i][j] != 0;
            entries += i > j ? dense[i][j] != 0 : i == j;
        }
        assert_true(edited_matrix_row(m, i, &row));
        assert_int_equal(row.count, in_row);
        for (size_t k = 0; k < row.count; k++) {
            assert_true(row.i[k] == i && row.j[k] != i && row.x[k] == dense[i][row.j[k]]);
        }
        triplets_free(&row);
    }
    assert_true(edited_matrix_whole(&whole, m, NULL));
    const sl_csc A = sl_matrix_view(whole);
    SL_CHECK(sl_csc_check(&A, NULL));
    assert_int_equal(A.p[N], entries);
    for (sl_int j = 0; j < N; j++) {
        for (sl_int k = A.p[j]; k < A.p[j + 1]; k++) {
            assert_true(A.i[k] >= j && A.x[k] == dense[A.i[k]][j]);
        }
    }
    sl_matrix_free(whole);
}

static void edits_match_dense_ones(void **state) {
    (void)state;
    static double dense[N][N];
    sl_matrix *M = NULL;
    edited_matrix m;
    uint64_t seed = 11;
    assert_true(grid_laplacian_2d(&M, SIDE, SIDE, 1));
    const sl_csc A = sl_matrix_view(M);
    assert_true(edited_matrix_create(&m, &A));
    for (sl_int j = 0; j < N; j++) {
        for (sl_int k = A.p[j]; k < A.p[j + 1]; k++) {
            dense[A.i[k]][j] = dense[j][A.i[k]] = A.x[k];
        }
    }
    assert_equals(&m, dense);
    for (int turn = 0; turn < 60; turn++) {
        entry_changes changes = {0, 0, NULL, NULL, NULL};
        for (int k = 0; k < 5; k++) {
            seed = seed * 6364136223846793005u + 1442695040888963407u;
            const sl_int i = (sl_int)((seed >> 33) % N), j = (sl_int)((seed >> 20) % N);
            const double delta = turn % 3 == 0 ? -dense[i][j] : (double)((int)(seed >> 50) - 8000);
            dense[i][j] += delta;
            dense[j][i] = dense[i][j];
            assert_true(triplets_add(&changes, i, j, delta));
        }
        assert_true(edited_matrix_apply(&m, &changes));
        triplets_free(&changes);
        assert_equals(&m, dense);
        assert_int_equal(edited_matrix_view(&m).p[N], A.p[N]); /* the pattern stays */
        if (turn % 20 == 19) {                                 /* what came later joins it */
            sl_matrix *whole = NULL;
            edited_matrix next;
            assert_true(m.more.count > 0 && edited_matrix_whole(&whole, &m, NULL));
            const sl_csc B = sl_matrix_view(whole);
            assert_true(edited_matrix_create(&next, &B) && next.more.count == 0);
            assert_equals(&next, dense);
            edited_matrix_free(&next);
            sl_matrix_free(whole);
        }
    }
    edited_matrix_free(&m);
    sl_matrix_free(M);
}

/* Zeros stay in the rows and columns that are to be kept. */
static void zeros_are_kept_where_wanted(void **state) {
    (void)state;
    const sl_int p[4] = {0, 3, 5, 6}, i[6] = {0, 1, 2, 1, 2, 2};
    const double x[6] = {1, 0, 0, 1, 0, 0};
    const sl_csc A = {3, 3, p, i, x};
    static const sl_int entries[4] = {3, 5, 5, 5}; /* of the lower triangle */
    for (int k = 0; k < 4; k++) {
        const unsigned char keep[3] = {k == 1, k == 2, k == 3};
        edited_matrix m;
        sl_matrix *whole = NULL;
        assert_true(edited_matrix_create(&m, &A) && edited_matrix_whole(&whole, &m, keep));
        assert_int_equal(sl_matrix_view(whole).p[3], entries[k]);
        sl_matrix_free(whole);
        edited_matrix_free(&m);
    }
}

static void malformed_matrices_are_refused(void **state) {
    (void)state;
    const sl_int p[3] = {0, 2, 3};
    sl_int i[3] = {0, 1, 1};
    const double x[3] = {1, 1, 1};
    const sl_csc A = {2, 2, p, i, x};
    edited_matrix m;
    assert_true(edited_matrix_create(&m, &A));
    edited_matrix_free(&m);
    static const sl_int bad[4][3] = {{1, 0, 1}, {0, 0, 1}, {0, 2, 1}, {0, 1, 0}};
    for (int k = 0; k < 4; k++) {
        memcpy(i, bad[k], sizeof i);
        assert_false(edited_matrix_create(&m, &A));
        assert_null(m.p);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(edits_match_dense_ones),
        cmocka_unit_test(zeros_are_kept_where_wanted),
        cmocka_unit_test(malformed_matrices_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

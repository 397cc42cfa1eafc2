/* test_saved_releases.c: what each release has saved answers today */
#include "tests/lib/saved_set.h"
#include "tools/io/dataset.h"

/* FOLDER has a file for each way to make a factor, release_VERSION_WAY.slf; that of a definite
 * matrix has a selected inverse and regions. The matrices are made again here, and answers are
 * judged by their residuals: a later version may choose another order. With SL_RECORD_SAVED set,
 * the files of this version are written first, at a release (make abi-record). */
#define FOLDER "tests/fuzz/corpus/saved"

static set_case_t case_of(int way) {
    return set_case_make(way, GEN_GRID2, 25, 0, 0, NULL);
}

static void record(void) {
    for (int way = 0; way < SAVED_WAYS; way++) {
        char path[200];
        snprintf(path, sizeof path, FOLDER "/release_%d.%d.%d_%d.slf", SL_VERSION_MAJOR,
                 SL_VERSION_MINOR, SL_VERSION_PATCH, way);
        set_case_t q = case_of(way);
        const sl_saved_set pair = pair_set(q.c.y.S, q.c.y.F);
        SL_CHECK(sl_save(path, NULL, NULL, way == SAVED_DEFINITE ? set_of(&q) : &pair, NULL));
        set_case_free(&q);
    }
}

/* Of the solution for b = A y with a random y: b is consistent, also if A is singular. */
static double backward_error(const sl_factor *F, const sl_csc *A) {
    const size_t n = (size_t)A->n_cols;
    double *y = test_reals(n), *b = test_reals(n), *x = test_reals(n), *r = test_reals(n), error;
    gen_reals(y, n, 12);
    SL_CHECK(sl_csc_multiply(A, SL_AS_SYMMETRIC, b, n, y, n, 1));
    SL_CHECK(sl_factor_solve(F, x, n, b, n, 1, NULL));
    SL_CHECK(sl_csc_residual(A, r, n, &error, x, n, b, n, 1));
    free(y);
    free(b);
    free(x);
    free(r);
    return error;
}

/* The diagonal of the inverse in the set's rows: from the selected inverse that was saved, by
 * solves in each region that holds the row, and from a factor of today. */
static void check_inverses(const sl_saved_set *set, const factored_t *today) {
    const sl_int n = today->M.view.n_cols;
    sl_int *rows = test_ints((size_t)n), solved = 0;
    double wanted[SETS_ROWS], got[SETS_ROWS];
    gen_set(rows, SETS_ROWS, n, 8);
    SL_CHECK(sl_inverse_diagonal(today->F, wanted, rows, SETS_ROWS, NULL, NULL));
    SL_CHECK(sl_selected_entries(set->selected, got, rows, NULL, SETS_ROWS, NULL));
    for (int k = 0; k < SETS_ROWS; k++) {
        assert_true(fabs(got[k] - wanted[k]) <= 1e-13 * fabs(wanted[k]));
        for (sl_int m = 0; m < set->n_regions; m++) {
            const double one = 1;
            double x;
            sl_plan *P = NULL;
            sl_options opt = options_none();
            opt.region = set->regions[m];
            if (sl_plan_create(&P, set->symbolic, &rows[k], 1, &rows[k], 1, &opt, NULL) == SL_OK) {
                SL_CHECK(sl_plan_solve(P, set->factor, &x, 1, &one, 1, 1, NULL));
                assert_true(fabs(x - wanted[k]) <= 1e-13 * fabs(wanted[k]));
                solved++;
            }
            sl_plan_free(P);
        }
    }
    assert_true(solved >= 2 * SETS_ROWS);
    free(rows);
}

/* The backward error that a factor allows. Wrong signs make one of another matrix. */
static double allowed_error(int way) {
    switch (way) {
    case SAVED_FLOAT: return 1e-5;
    case SAVED_REGULARIZED:
    case SAVED_PIVOTED_REGULARIZED:
        return 1e-7;
    case SAVED_SIGNED:
        return 1;
    default:
        return 1e-13;
    }
}

/* Loaded and mapped. */
static void check_file(const char *path, int way) {
    const double allowed = allowed_error(way);
    set_case_t today = case_of(way);
    for (int is_mapped = 0; is_mapped < 2; is_mapped++) {
        sl_saved_set set = {0};
        SL_CHECK(is_mapped ? sl_load(&set, path, NULL, 0, SL_LOAD_MAPPED, NULL)
                           : sl_load(&set, path, NULL, 0, SL_LOAD_VERIFIED, NULL));
        assert_true(backward_error(set.factor, &today.c.y.M.view) <= allowed);
        assert_int_equal(set.selected != NULL, way == SAVED_DEFINITE);
        assert_int_equal(set.n_regions, way == SAVED_DEFINITE ? SETS_REGIONS : 0);
        if (set.selected != NULL) {
            check_inverses(&set, &today.c.y);
        }
        if (!is_mapped) {
            SL_CHECK(sl_factor_refactor(set.factor, &today.c.y.M.view, NULL));
            assert_true(backward_error(set.factor, &today.c.y.M.view) <= allowed);
        }
        sl_saved_set_free(&set);
    }
    set_case_free(&today);
}

static void files_of_releases_answer(void **state) {
    (void)state;
    dataset all;
    int count = 0;
    if (getenv("SL_RECORD_SAVED")) {
        record();
    }
    if (!dataset_list(&all, FOLDER, NULL)) {
        TEST_SKIP("there is no folder " FOLDER);
    }
    for (size_t k = 0; k < all.count; k++) {
        int way = -1;
        if (sscanf(dataset_basename(all.paths[k]), "release_%*d.%*d.%*d_%d.slf", &way) == 1) {
            assert_in_range(way, 0, SAVED_WAYS - 1);
            check_file(all.paths[k], way);
            count++;
        }
    }
    dataset_free(&all);
    assert_true(count >= SAVED_WAYS);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(files_of_releases_answer),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

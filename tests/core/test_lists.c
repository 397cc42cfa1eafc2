/* test_lists.c: a list of rows that is NULL is all rows or none, by its count, or refused */
#include "tests/lib/factored.h"

enum { N = 64 };

/* What the calls need, and room for N numbers behind the 3 that a careless caller has. */
typedef struct lists_t {
    factored_t y;
    sl_selected *Z;
    double out[N], b[N];
    sl_stats stats;
} lists_t;

static sl_status with_plan(lists_t *f, const sl_int *list, sl_int count, int is_x) {
    static const sl_int row = 4;
    sl_plan *P = NULL;
    const sl_status status = sl_plan_create(&P, f->y.S, is_x ? &row : list, is_x ? 1 : count,
                                            is_x ? list : &row, is_x ? count : 1, NULL, &f->stats);
    sl_plan_free(P);
    return status;
}

static sl_status with_bset(lists_t *f, const sl_int *list, sl_int count) {
    return with_plan(f, list, count, 0);
}

static sl_status with_xset(lists_t *f, const sl_int *list, sl_int count) {
    return with_plan(f, list, count, 1);
}

static sl_status with_complex_bset(lists_t *f, const sl_int *list, sl_int count) {
    static const sl_int row = 4;
    const sl_int half = count == N ? N / 2 : count; /* of complex rows */
    sl_plan *P = NULL;
    const sl_status status =
        sl_complex_plan_create(&P, f->y.S, list, half, &row, 1, NULL, &f->stats);
    sl_plan_free(P);
    return status;
}

static sl_status with_complex_xset(lists_t *f, const sl_int *list, sl_int count) {
    static const sl_int row = 4;
    const sl_int half = count == N ? N / 2 : count;
    sl_plan *P = NULL;
    const sl_status status =
        sl_complex_plan_create(&P, f->y.S, &row, 1, list, half, NULL, &f->stats);
    sl_plan_free(P);
    return status;
}

static sl_status with_local_bset(lists_t *f, const sl_int *list, sl_int count) {
    static const sl_int row = 4;
    double x;
    return sl_local_solve(f->y.F, list, count, &row, 1, &x, 1, f->b, N, 1, NULL, &f->stats);
}

static sl_status with_local_xset(lists_t *f, const sl_int *list, sl_int count) {
    static const sl_int row = 4;
    return sl_local_solve(f->y.F, &row, 1, list, count, f->out, N, f->b, N, 1, NULL, &f->stats);
}

static sl_status with_diagonal(lists_t *f, const sl_int *list, sl_int count) {
    return sl_inverse_diagonal(f->y.F, f->out, list, count, NULL, &f->stats);
}

static sl_status with_selected(lists_t *f, const sl_int *list, sl_int count) {
    sl_selected *Z = NULL;
    const sl_status status = sl_selected_create(&Z, f->y.F, list, count, NULL, &f->stats);
    sl_selected_free(Z);
    return status;
}

static sl_status with_entries(lists_t *f, const sl_int *list, sl_int count) {
    return sl_selected_entries(f->Z, f->out, list, NULL, count, &f->stats);
}

static sl_status with_region(lists_t *f, const sl_int *list, sl_int count) {
    sl_region *R = NULL;
    const sl_status status = sl_region_create(&R, f->y.F, list, count, NULL, NULL, &f->stats);
    sl_region_free(R);
    return status;
}

static const struct {
    const char *name;
    sl_status (*call)(lists_t *f, const sl_int *list, sl_int count);
    int writes; /* out has one number for each row of the list */
} calls[] = {
    {"bset of a plan", with_bset, 0},
    {"xset of a plan", with_xset, 0},
    {"bset of a complex plan", with_complex_bset, 0},
    {"xset of a complex plan", with_complex_xset, 0},
    {"bset of a local solve", with_local_bset, 0},
    {"xset of a local solve", with_local_xset, 1},
    {"diagonal", with_diagonal, 1},
    {"selected inverse", with_selected, 0},
    {"selected entries", with_entries, 1},
    {"region", with_region, 0},
};

static const struct {
    int has_list;
    sl_int count, rows; /* rows: how many are meant, or -1: refused */
    const char *what;
} cases[] = {
    {0, SL_ALL, N, NULL},
    {0, N, N, NULL},
    {0, 0, 0, NULL},
    {1, 3, 3, NULL},
    {1, 0, 0, NULL},
    {0, 3, -1, "the list is NULL: its count must be SL_ALL, n, or 0"},
    {0, -2, -1, "the list is NULL: its count must be SL_ALL, n, or 0"},
    {0, N + 1, -1, "the list is NULL: its count must be SL_ALL, n, or 0"},
    {1, SL_ALL, -1, "the count of a list is below 0; SL_ALL goes with NULL"},
    {1, -2, -1, "the count of a list is below 0; SL_ALL goes with NULL"},
};

static void the_count_says_what_null_means(void **state) {
    (void)state;
    static const sl_int list[3] = {2, 7, 11};
    lists_t f;
    memset(&f, 0, sizeof f);
    f.y = factored_make(GEN_GRID2, N, 1, 0, NULL);
    assert_int_equal(f.y.M.view.n_cols, N);
    SL_CHECK(sl_selected_create(&f.Z, f.y.F, NULL, SL_ALL, NULL, NULL));
    for (size_t k = 0; k < sizeof calls / sizeof *calls; k++) {
        for (size_t c = 0; c < sizeof cases / sizeof *cases; c++) {
            sl_int written = 0;
            for (int i = 0; i < N; i++) {
                f.out[i] = 0.0;
                f.b[i] = 1.0;
            }
            const sl_status status =
                calls[k].call(&f, cases[c].has_list ? list : NULL, cases[c].count);
            const sl_status wanted = cases[c].rows < 0 ? SL_ERR_ARGUMENT : SL_OK;
            if (status != wanted) {
                fail_msg("%s, case %d: %s", calls[k].name, (int)c, sl_status_string(status));
            }
            for (int i = 0; i < N; i++) {
                written += f.out[i] != 0.0;
            }
            assert_int_equal(written, calls[k].writes && cases[c].rows > 0 ? cases[c].rows : 0);
            if (cases[c].what) {
                assert_string_equal(f.stats.error.what, cases[c].what);
            }
        }
    }
    sl_selected_free(f.Z);
    factored_free(&f.y);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(the_count_says_what_null_means)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}

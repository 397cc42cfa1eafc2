/* test_advice_saved.c: whoever does what a text of files and sets says saves or loads a factor */
#include "tests/lib/saved_format.h" /* before x and b are names of arrays */
#include "tests/lib/advised_calls.h"

/* Each call below is refused with its text, and with `heeds` does what the text says. */

/* The set of the grid and its factor, in aligned memory, and a solve with what is loaded. */
static sl_saved_set all_of_grid(void) {
    sl_saved_set set;
    memset(&set, 0, sizeof set);
    set.symbolic = grid.S;
    set.factor = grid.F;
    return set;
}

static unsigned char *saved_grid(unsigned char **memory, size_t *bytes) {
    const sl_saved_set set = all_of_grid();
    SL_CHECK(sl_save(NULL, NULL, bytes, &set, NULL));
    unsigned char *room = (unsigned char *)test_array(*bytes + 64, 1);
    *memory = room + (64 - (uintptr_t)room % 64);
    SL_CHECK(sl_save(NULL, *memory, bytes, &set, NULL));
    return room;
}

static sl_status loaded(const unsigned char *memory, size_t bytes, unsigned flags, int refactors,
                        sl_saved_content wanted) {
    sl_saved_set got;
    memset(&got, 0, sizeof got);
    got.wanted = wanted;
    sl_status status = sl_load(&got, NULL, memory, bytes, flags, NULL);
    if (status == SL_OK && refactors) {
        status = sl_factor_refactor(got.factor, &grid.M.view, NULL);
    }
    status = status == SL_OK ? sl_factor_solve(got.factor, x, N, b, N, 1, NULL) : status;
    sl_saved_set_free(&got);
    return judged(&grid.M.view, -1, status);
}

static sl_status load_again(unsigned flags, int refactors, sl_saved_content wanted,
                            int other_order) {
    unsigned char *memory, *room;
    size_t bytes;
    room = saved_grid(&memory, &bytes);
    if (other_order) {
        saved_change_order(memory);
    }
    const sl_status status = loaded(memory, bytes, flags, refactors, wanted);
    free(room);
    return status;
}

static sl_status mapped_factor(int heeds) {
    return load_again(heeds ? SL_LOAD_CHECKED : SL_LOAD_MAPPED, 1, SL_SAVED_ALL, 0);
}

static sl_status other_order(int heeds) {
    return load_again(heeds ? SL_LOAD_CHECKED : SL_LOAD_MAPPED, 0, SL_SAVED_ALL, 1);
}

static sl_status trusted_and_verified(int heeds) {
    const unsigned both = SL_LOAD_TRUSTED | SL_LOAD_VERIFIED;
    return load_again(heeds ? SL_LOAD_VERIFIED : both, 0, SL_SAVED_ALL, 0);
}

static sl_status unknown_flag(int heeds) {
    return load_again(heeds ? SL_LOAD_TRUSTED : 64u, 0, SL_SAVED_ALL, 0);
}

static sl_status unknown_content(int heeds) {
    return load_again(0, 0, heeds ? SL_SAVED_FACTOR : (sl_saved_content)9, 0);
}

/* ---- sets ---- */

static sl_status counted(const sl_saved_set *set) {
    size_t bytes = 0;
    const sl_status status = sl_save(NULL, NULL, &bytes, set, NULL);
    assert_true(status != SL_OK || bytes > 0);
    return status;
}

static sl_status no_symbolic(int heeds) {
    sl_saved_set set = all_of_grid();
    set.symbolic = heeds ? grid.S : NULL;
    return counted(&set);
}

static sl_status negative_regions(int heeds) {
    sl_saved_set set = all_of_grid();
    set.n_regions = heeds ? 0 : -1;
    return counted(&set);
}

static sl_status no_regions(int heeds) {
    sl_saved_set set = all_of_grid();
    set.n_regions = !heeds;
    return counted(&set);
}

static sl_status regions_alone(int heeds) {
    static const sl_int rows[] = {0, 1};
    sl_saved_set set = all_of_grid();
    sl_region *R = NULL;
    SL_CHECK(sl_region_create(&R, grid.F, rows, 2, NULL, NULL, NULL));
    set.regions = &R;
    set.n_regions = 1;
    set.factor = heeds ? grid.F : NULL;
    const sl_status status = counted(&set);
    sl_region_free(R);
    return status;
}

static const sl_int two_rows[] = {0, N - 1};

static sl_status submatrix_saved(int heeds) {
    sl_saved_set set;
    size_t bytes = 0;
    memset(&set, 0, sizeof set);
    SL_CHECK(sl_factor_submatrix(&set.symbolic, &set.factor, grid.F, &grid.M.view, two_rows, 2,
                                 NULL, NULL));
    sl_symbolic *S = set.symbolic;
    sl_factor *G = set.factor;
    set.symbolic = heeds ? grid.S : S;
    set.factor = heeds ? grid.F : G;
    const sl_status status = sl_save(NULL, NULL, &bytes, &set, NULL);
    sl_factor_free(G);
    sl_symbolic_free(S);
    return status;
}

static sl_status complex_saved(int heeds) {
    static const sl_int p[] = {0, 2, 3}, i[] = {0, 1, 1};
    static const double values[] = {4, 0, 1, 1, 3, 0};
    const sl_hermitian H = {2, p, i, values, NULL};
    sl_options blocks = options_none(), half = options_none();
    sl_saved_set set;
    sl_matrix *M = NULL;
    size_t bytes = 0;
    memset(&set, 0, sizeof set);
    SL_CHECK(sl_matrix_from_hermitian(&M, &H, NULL, NULL));
    const sl_csc A = sl_matrix_view(M);
    blocks.block_size = 2;
    SL_CHECK(sl_symbolic_create(&set.symbolic, &A, &blocks, NULL));
    half.storage = heeds ? SL_STORAGE_DOUBLE : SL_STORAGE_COMPLEX;
    set.factor = factor_of(set.symbolic, &A, &half);
    const sl_status status = sl_save(NULL, NULL, &bytes, &set, NULL);
    sl_factor_free(set.factor);
    sl_symbolic_free(set.symbolic);
    sl_matrix_free(M);
    return status;
}

static const advice_t advices[] = {
    {"it is mapped (sl_load copies without SL_LOAD_MAPPED), of sl_factor_submatrix, or saved by a "
     "newer version",
     mapped_factor},
    {"the byte order is not that of this processor: load without SL_LOAD_MAPPED", other_order},
    {"SL_LOAD_TRUSTED excludes SL_LOAD_VERIFIED", trusted_and_verified},
    {"flags has a bit that is not of sl_load_flag", unknown_flag},
    {"set.wanted is not a value of sl_saved_content: is the set initialized?", unknown_content},
    {"set.symbolic is NULL", no_symbolic},
    {"set.n_regions is below 0", negative_regions},
    {"set.regions is NULL", no_regions},
    {"regions without set.factor", regions_alone},
    {"an analysis of sl_factor_submatrix, or from a file of a newer version", submatrix_saved},
    {"SL_STORAGE_COMPLEX is not saved", complex_saved},
};

static void advice_of_files_is_right(void **state) {
    (void)state;
    follow_all(advices, sizeof advices / sizeof *advices);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(advice_of_files_is_right),
    };
    return cmocka_run_group_tests(tests, advice_set_up, advice_tear_down);
}

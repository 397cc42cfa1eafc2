/* test_metis.c: METIS options are passed on or refused, and METIS prints nothing */
#define _POSIX_C_SOURCE 200809L
#include "tests/lib/temporary_files.h"

#include "tests/lib/check_factor.h"

#if !defined(SL_METIS) || defined(SL_NO_METIS)

static void metis_is_unsupported(void **state) {
    (void)state;
    gen_matrix_t M = gen_matrix(GEN_GRID2, 900, 1, 2);
    sl_options opt = options_none();
    sl_symbolic *S = (sl_symbolic *)(void *)&M;
    opt.ordering = SL_ORDERING_METIS;
    SL_EXPECT(SL_ERR_UNSUPPORTED, sl_symbolic_create(&S, &M.view, &opt, NULL));
    assert_null(S);
    gen_matrix_free(&M);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(metis_is_unsupported)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}

#else

#include <metis.h>

static void all_default(sl_int *metis) {
    for (int k = 0; k < METIS_NOPTIONS; k++) {
        metis[k] = -1;
    }
}

static void metis_options_are_handed_on(void **state) {
    (void)state;
    gen_matrix_t M = gen_matrix(GEN_GRID2, 900, 1, 2);
    sl_options opt = options_none();
    opt.ordering = SL_ORDERING_METIS;
    sl_stats stats;
    memset(&stats, 0, sizeof stats);
    sl_symbolic *S = NULL;
    SL_CHECK(sl_symbolic_create(&S, &M.view, &opt, &stats));
    /* METIS must beat the natural order, in which L of a 30 x 30 grid has about 30 n entries. METIS
     * 5.1.0 gives 12.8 n; any other has a margin of half as many. */
    assert_true(stats.symbolic.nnz_l < 20 * (sl_off)stats.symbolic.n);
    sl_int metis[METIS_NOPTIONS];
    all_default(metis); /* the same as no options */
    opt.metis_options = metis;
    sl_symbolic *T = NULL;
    SL_CHECK(sl_symbolic_create(&T, &M.view, &opt, NULL));
    sl_symbolic_arrays v = sl_symbolic_view(S), w = sl_symbolic_view(T);
    assert_memory_equal(v.perm, w.perm, (size_t)v.n * sizeof(sl_int));
    sl_symbolic_free(T);
    /* Another seed gives another valid order. */
    metis[METIS_OPTION_SEED] = 4711;
    SL_CHECK(sl_symbolic_create(&T, &M.view, &opt, NULL));
    w = sl_symbolic_view(T);
    NOTHING_WRONG(check_permutation(w.n, w.perm, w.iperm));
    assert_int_not_equal(memcmp(v.perm, w.perm, (size_t)v.n * sizeof(sl_int)), 0);
    sl_symbolic_free(T);
    sl_symbolic_free(S);
    gen_matrix_free(&M);
}

/* Analyzes a grid, expects a status, and returns how many bytes were printed to stdout and
 * stderr. */
static long bytes_printed(const sl_int *metis, sl_status wanted) {
    gen_matrix_t M = gen_matrix(GEN_GRID2, 900, 1, 2);
    sl_options opt = options_none();
    sl_symbolic *S = NULL;
    opt.ordering = SL_ORDERING_METIS;
    opt.metis_options = metis;
    fflush(stdout);
    fflush(stderr);
    int keep[2] = {dup(1), dup(2)};
    FILE *file = fopen(files_path("printed"), "wb");
    assert_non_null(file);
    assert_true(keep[0] >= 0 && keep[1] >= 0 && dup2(fileno(file), 1) == 1 &&
                dup2(fileno(file), 2) == 2);
    sl_status status = sl_symbolic_create(&S, &M.view, &opt, NULL);
    fflush(stdout);
    fflush(stderr);
    assert_true(dup2(keep[0], 1) == 1 && dup2(keep[1], 2) == 2);
    close(keep[0]);
    close(keep[1]);
    assert_int_equal(fseek(file, 0, SEEK_END), 0);
    long size = ftell(file);
    fclose(file);
    SL_EXPECT(wanted, status);
    assert_true((S != NULL) == (status == SL_OK));
    sl_symbolic_free(S);
    gen_matrix_free(&M);
    return size;
}

static void nothing_is_printed(void **state) {
    (void)state;
    sl_int metis[METIS_NOPTIONS];
    all_default(metis);
    assert_int_equal(bytes_printed(metis, SL_OK), 0);
    metis[METIS_OPTION_DBGLVL] = 0x7FF;
    assert_int_equal(bytes_printed(metis, SL_OK), 0);
    metis[METIS_OPTION_NUMBERING] = 1; /* METIS would read one entry beyond each array */
    assert_int_equal(bytes_printed(metis, SL_OK), 0);
}

static void options_out_of_range_are_refused(void **state) {
    (void)state;
    static const struct {
        int option;
        sl_int low, high; /* the range in METIS's manual, for METIS_NodeND */
    } ranges[] = {
        {METIS_OPTION_OBJTYPE, METIS_OBJTYPE_NODE, METIS_OBJTYPE_NODE},
        {METIS_OPTION_CTYPE, METIS_CTYPE_RM, METIS_CTYPE_SHEM},
        {METIS_OPTION_IPTYPE, METIS_IPTYPE_EDGE, METIS_IPTYPE_NODE},
        {METIS_OPTION_RTYPE, METIS_RTYPE_SEP2SIDED, METIS_RTYPE_SEP1SIDED},
        {METIS_OPTION_NITER, 1, 100},
        {METIS_OPTION_COMPRESS, 0, 1},
        {METIS_OPTION_CCORDER, 0, 1},
        {METIS_OPTION_PFACTOR, 0, 200},
        {METIS_OPTION_NSEPS, 1, 10},
        {METIS_OPTION_UFACTOR, 1, 999},
    };
    for (size_t k = 0; k < sizeof ranges / sizeof *ranges; k++) {
        const int option = ranges[k].option;
        sl_int metis[METIS_NOPTIONS];
        all_default(metis);
        metis[option] = ranges[k].low;
        assert_int_equal(bytes_printed(metis, SL_OK), 0);
        metis[option] = ranges[k].high;
        assert_int_equal(bytes_printed(metis, SL_OK), 0);
        metis[option] = ranges[k].low == 0 ? -2 : ranges[k].low - 1;
        assert_int_equal(bytes_printed(metis, SL_ERR_ARGUMENT), 0);
        metis[option] = INT32_MIN;
        assert_int_equal(bytes_printed(metis, SL_ERR_ARGUMENT), 0);
        if (option != METIS_OPTION_NITER && option != METIS_OPTION_NSEPS &&
            option != METIS_OPTION_PFACTOR) {
            metis[option] = ranges[k].high + 1;
            assert_int_equal(bytes_printed(metis, SL_ERR_ARGUMENT), 0);
        }
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(metis_options_are_handed_on),
        cmocka_unit_test(nothing_is_printed),
        cmocka_unit_test(options_out_of_range_are_refused),
    };
    return cmocka_run_group_tests(tests, files_set_up, files_tear_down);
}

#endif

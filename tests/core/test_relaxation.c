/* test_relaxation.c: relaxed supernodes: small ones are merged where that pays, few zeros stored */
#include "tests/lib/check_factor.h"

static void relaxation_merges_and_stays_small(void **state) {
    (void)state;
    static const gen_kind_t kinds[3] = {GEN_GRID2, GEN_GRID3, GEN_PATH};
    for (int k = 0; k < 3; k++) {
        gen_matrix_t M = gen_matrix(kinds[k], 2500, 1, 9);
        sl_options opt = options_none();
        sl_stats relaxed, exact;
        memset(&relaxed, 0, sizeof relaxed);
        memset(&exact, 0, sizeof exact);
        sl_symbolic *S = NULL, *T = NULL;
        SL_CHECK(sl_symbolic_create(&S, &M.view, &opt, &relaxed));
        opt.relaxation = SL_RELAXATION_NONE;
        SL_CHECK(sl_symbolic_create(&T, &M.view, &opt, &exact));
        assert_true(relaxed.symbolic.supernodes < exact.symbolic.supernodes / 2);
        assert_int_equal(relaxed.symbolic.supernodes_fundamental, exact.symbolic.supernodes);
        assert_int_equal(relaxed.symbolic.nnz_l, exact.symbolic.nnz_l);
        assert_true(exact.symbolic.nnz_panels >= exact.symbolic.nnz_l - exact.symbolic.n);
        sl_symbolic_arrays v = sl_symbolic_view(S), w = sl_symbolic_view(T);
        NOTHING_WRONG(check_supernodes(&v));
        NOTHING_WRONG(check_supernodes(&w));
        NOTHING_WRONG(check_postorder(v.n_supers, v.super_parent));
        NOTHING_WRONG(check_postorder(w.n_supers, w.super_parent));
        sl_symbolic_free(S);
        sl_symbolic_free(T);
        gen_matrix_free(&M);
    }
}

/* Entries that the panels store for their supernodes, the diagonal included, padding excluded. */
static sl_off stored_entries(const sl_symbolic_arrays *v) {
    sl_off sum = 0;
    for (sl_int s = 0; s < v->n_supers; s++) {
        sl_off width = ref_width(v, s), height = ref_height(v, s);
        sum += width * (width + 1) / 2 + width * (height - width);
    }
    return sum;
}

/* In natural order: groups of `leaves` short columns, each group below a column adjacent to a
 * clique of `tall` rows. A short column that is merged grows to the height of the tall one. */
static gen_list_t leaves_on_tall_columns(sl_int groups, sl_int leaves, sl_int tall) {
    gen_list_t t = gen_list(groups * (leaves + 1) + tall);
    const sl_int clique = t.n - tall;
    for (sl_int g = 0; g < groups; g++) {
        const sl_int column = (g + 1) * (leaves + 1) - 1;
        for (sl_int k = 1; k <= leaves; k++) {
            gen_add(&t, column, column - k, 1.0);
        }
        for (sl_int k = clique; k < t.n; k++) {
            gen_add(&t, k, column, 1.0);
        }
    }
    for (sl_int k = clique; k < t.n; k++) {
        for (sl_int i = k + 1; i < t.n; i++) {
            gen_add(&t, i, k, 1.0);
        }
    }
    return t;
}

/* A path of cliques of `size` rows, joined by single edges. */
static gen_list_t path_of_cliques(sl_int cliques, sl_int size) {
    gen_list_t t = gen_list(cliques * size);
    for (sl_int k = 0; k < t.n; k++) {
        for (sl_int i = k + 1; i < (k / size + 1) * size; i++) {
            gen_add(&t, i, k, 1.0);
        }
        if (k % size == size - 1 && k + 1 < t.n) {
            gen_add(&t, k + 1, k, 1.0);
        }
    }
    return t;
}

/* The panels store at most 1 / (1 - 0.70) times the entries of L, as supernodes.h promises. */
static void few_zeros(const char *name, gen_list_t *t, sl_ordering ordering) {
    uint64_t seed = 1;
    gen_dominate(t, 1, &seed);
    gen_matrix_t M = gen_store(t, gen_style(0), 1);
    sl_options opt = options_none();
    sl_symbolic *S = NULL;
    sl_stats stats;
    memset(&stats, 0, sizeof stats);
    opt.ordering = ordering;
    SL_CHECK(sl_symbolic_create(&S, &M.view, &opt, &stats));
    sl_symbolic_arrays v = sl_symbolic_view(S);
    double stored = (double)stored_entries(&v) / (double)stats.symbolic.nnz_l,
           held = (double)stats.symbolic.nnz_panels / (double)stats.symbolic.nnz_l;
    print_message("%-28s stored %.2f, panels %.2f times the entries of L\n", name, stored, held);
    assert_true(stored <= 1 / (1 - 0.70));
    /* Tiles of 8 rows pad w columns of height h to less than w (h + 8) doubles: to 8 per entry on a
     * path. */
    assert_true(held <= 8.1);
    sl_symbolic_free(S);
    gen_matrix_free(&M);
    gen_list_free(t);
}

static void hostile_patterns_store_few_zeros(void **state) {
    (void)state;
    gen_list_t t = gen_list(5000);
    uint64_t seed = 1;
    gen_edges_star(&t, 4999, &seed);
    few_zeros("arrow", &t, SL_ORDERING_NATURAL);
    t = gen_list(5000);
    gen_edges_star(&t, 0, &seed);
    few_zeros("star", &t, SL_ORDERING_ND);
    t = gen_list(5000);
    gen_edges_path(&t, &seed);
    few_zeros("path", &t, SL_ORDERING_NATURAL);
    t = gen_list(5000);
    gen_edges_ring(&t, 5000, &seed);
    few_zeros("ring", &t, SL_ORDERING_NATURAL);
    t = gen_list(5000);
    gen_edges_forest(&t, &seed);
    few_zeros("forest", &t, SL_ORDERING_NATURAL);
    for (sl_int leaves = 1; leaves <= 15; leaves += 2) {
        t = leaves_on_tall_columns(400, leaves, 100);
        few_zeros("leaves on tall columns", &t, SL_ORDERING_NATURAL);
    }
    for (sl_int size = 2; size <= 64; size *= 2) {
        t = path_of_cliques(4000 / size, size);
        few_zeros("path of cliques", &t, SL_ORDERING_NATURAL);
        t = path_of_cliques(4000 / size, size);
        few_zeros("path of cliques, reordered", &t, SL_ORDERING_ND);
    }
}

/* A quadratic program whose constraints have 3 variables anywhere: most of L is one dense block,
 * above which short columns have long chains of parents. Without regard to what solves read, the
 * panels store twice the entries of L. */
static void tall_columns_stay_short(void **state) {
    (void)state;
    enum { VARIABLES = 1500, CONSTRAINTS = 3000, ALL = VARIABLES + CONSTRAINTS };
    gen_list_t t = gen_list(ALL);
    uint64_t seed = 4;
    for (sl_int k = 0; k < ALL; k++) {
        gen_add(&t, k, k, k < VARIABLES ? 1.0 : -1.0);
        for (sl_int q = 0; k >= VARIABLES && q < 3; q++) {
            gen_add(&t, k, gen_below(&seed, VARIABLES), 0.5);
        }
    }
    gen_matrix_t M = gen_store(&t, gen_style(0), 1);
    sl_options opt = options_none();
    sl_symbolic *S = NULL;
    sl_stats stats;
    memset(&stats, 0, sizeof stats);
    SL_CHECK(sl_symbolic_create(&S, &M.view, &opt, &stats));
    const double held = (double)stats.symbolic.nnz_panels / (double)stats.symbolic.nnz_l;
    print_message("panels %.2f times the entries of L\n", held);
    assert_true(held < 1.4);
    sl_symbolic_free(S);
    gen_matrix_free(&M);
    gen_list_free(&t);
}

/* For one factor, a path of small cliques has fewer supernodes. */
static void the_purpose_decides(void **state) {
    (void)state;
    gen_list_t t = path_of_cliques(1000, 4);
    uint64_t seed = 1;
    gen_dominate(&t, 1, &seed);
    gen_matrix_t M = gen_store(&t, gen_style(0), 1);
    sl_options opt = options_none();
    sl_stats stats[2];
    for (int k = 0; k < 2; k++) {
        sl_symbolic *S = NULL;
        memset(&stats[k], 0, sizeof stats[k]);
        opt.ordering = SL_ORDERING_NATURAL;
        opt.purpose = k == 0 ? SL_PURPOSE_MANY_SOLVES : SL_PURPOSE_ONE_FACTOR;
        SL_CHECK(sl_symbolic_create(&S, &M.view, &opt, &stats[k]));
        sl_symbolic_free(S);
    }
    assert_true(stats[1].symbolic.supernodes < stats[0].symbolic.supernodes);
    gen_matrix_free(&M);
    gen_list_free(&t);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(relaxation_merges_and_stays_small),
        cmocka_unit_test(hostile_patterns_store_few_zeros),
        cmocka_unit_test(tall_columns_stay_short),
        cmocka_unit_test(the_purpose_decides),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

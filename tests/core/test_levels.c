/* test_levels.c: for one factor, thin graphs are ordered by levels: fill, branches, wide graphs */
#include "tests/lib/ordering_meshes.h"

typedef enum shape_t { STRIP, RING, BAR, COMB, LADDER, PIECES, SHAPES } shape_t;

/* A strip and a ring of triangles, 12 across; a bar of 3 x 4 x 150 vertices; a strip with ten
 * branches; the same where the ends of branches meet the strip, in ten cycles; strips apart, with
 * single rows. */
static gen_list_t shape(shape_t kind) {
    const sl_int across = kind == COMB || kind == LADDER ? 4 : 12, length = kind == BAR ? 150 : 200;
    gen_list_t t = gen_list(across * length);
    uint64_t seed = 3;
    if (kind == BAR) {
        gen_edges_grid(&t, 3, 4, length, &seed);
        return t;
    }
    for (sl_int v = 0; v < t.n; v++) {
        const sl_int x = v % across, y = v / across;
        const int is_cut = kind == PIECES && y % 50 == 0;
        if (kind == PIECES && y % 50 == 49) {
            continue; /* no edges */
        }
        if (x > 0) {
            gen_add(&t, v, v - 1, 1.0);
        }
        if (y > 0 && !is_cut) {
            gen_add(&t, v, v - across, 1.0);
        }
        if (x > 0 && y > 0 && !is_cut) {
            gen_add(&t, v, v - across - 1, 1.0);
        }
    }
    for (sl_int x = 0; x < across && kind == RING; x++) {
        gen_add(&t, t.n - across + x, x, 1.0);
    }
    for (sl_int branch = 0; branch < 10 && (kind == COMB || kind == LADDER); branch++) {
        sl_int last = 20 * branch * across, before = last + 1;
        for (sl_int k = 0; k < 60; k++) { /* a chain of triangles, two rows across */
            gen_add(&t, t.n, last, 1.0);
            gen_add(&t, t.n, before, 1.0);
            before = last;
            last = t.n++;
        }
        if (kind == LADDER && branch > 0) {
            gen_add(&t, last, 20 * (branch - 1) * across + 2, 1.0);
        }
    }
    return t;
}

static sl_options of_purpose(sl_purpose purpose) {
    sl_options opt = options_none();
    opt.purpose = purpose;
    return opt;
}

/* The fill is 1.61 times that of minimum degree on the ring, and less elsewhere. There are no
 * nodes, as nothing is dissected. The order of a thin graph does not depend on how it is stored. */
static void thin_graphs_have_little_fill(void **state) {
    (void)state;
    for (int kind = 0; kind < SHAPES; kind++) {
        gen_list_t t = shape((shape_t)kind);
        uint64_t seed = 5;
        gen_dominate(&t, 1, &seed);
        sl_int *perm = test_ints((size_t)t.n);
        for (int style = 0; style < GEN_STYLES; style++) {
            gen_matrix_t M = gen_store(&t, gen_style(style), 1);
            sl_options opt = of_purpose(SL_PURPOSE_ONE_FACTOR);
            sl_symbolic *S = NULL;
            SL_CHECK(sl_symbolic_create(&S, &M.view, &opt, NULL));
            const sl_symbolic_arrays v = sl_symbolic_view(S);
            NOTHING_WRONG(check_permutation(v.n, v.perm, v.iperm));
            assert_int_equal(v.n_nodes, 0);
            if (style == 0) {
                memcpy(perm, v.perm, (size_t)v.n * sizeof *perm);
            }
            assert_memory_equal(perm, v.perm, (size_t)v.n * sizeof *perm);
            sl_symbolic_free(S);
            const double fill = order_quality_of(&M.view, &opt).fill;
            opt.ordering = SL_ORDERING_MINDEG;
            assert_true(fill <= 1.62 * order_quality_of(&M.view, &opt).fill);
            gen_matrix_free(&M);
        }
        free(perm);
        gen_list_free(&t);
    }
}

/* The order is that of the levels, which minimum degree does not find: a strip of 12 rows across
 * has the fill of its natural order, a row more or less. */
static void a_strip_is_a_band(void **state) {
    (void)state;
    gen_list_t t = shape(STRIP);
    uint64_t seed = 5;
    gen_dominate(&t, 1, &seed);
    gen_matrix_t M = gen_store(&t, gen_style(0), 1);
    sl_options opt = of_purpose(SL_PURPOSE_ONE_FACTOR);
    const order_quality levels = order_quality_of(&M.view, &opt);
    opt.ordering = SL_ORDERING_NATURAL;
    const order_quality band = order_quality_of(&M.view, &opt);
    assert_true(fabs(levels.fill - band.fill) <= t.n);
    opt.ordering = SL_ORDERING_MINDEG;
    assert_true(levels.path > 1.2 * order_quality_of(&M.view, &opt).path);
    gen_matrix_free(&M);
    gen_list_free(&t);
}

/* A row next to all others, or wide levels: minimum degree. */
static void other_graphs_are_left_to_minimum_degree(void **state) {
    (void)state;
    for (int has_hub = 0; has_hub < 2; has_hub++) {
        gen_list_t t = has_hub ? shape(STRIP) : gen_list(90 * 90);
        uint64_t seed = 6;
        for (sl_int k = 1; k < t.n && has_hub; k++) {
            gen_add(&t, k, 0, 1.0);
        }
        if (!has_hub) {
            gen_edges_grid(&t, 90, 90, 1, &seed);
        }
        gen_dominate(&t, 1, &seed);
        gen_matrix_t M = gen_store(&t, gen_style(0), 1);
        sl_options opt = of_purpose(SL_PURPOSE_ONE_FACTOR);
        const double fill = order_quality_of(&M.view, &opt).fill;
        opt.ordering = SL_ORDERING_MINDEG;
        assert_true(fill == order_quality_of(&M.view, &opt).fill);
        gen_matrix_free(&M);
        gen_list_free(&t);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(thin_graphs_have_little_fill),
        cmocka_unit_test(a_strip_is_a_band),
        cmocka_unit_test(other_graphs_are_left_to_minimum_degree),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

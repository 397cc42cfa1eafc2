/* test_thin.c: dissection along levels: trees, fill, and the graphs that are left alone */
#include "tests/lib/no_kernels.h"
#define SPARSE_LOCAL_IMPLEMENTATION
#include "tests/lib/ordering_meshes.h"

typedef struct shape_t {
    const char *name;
    sl_int across, length;
    int is_tube, is_bar; /* a bar is `across` by `across` */
    double fill, path;   /* most per row: entries of L, path weight */
} shape_t;

static const shape_t shapes[] = {
    {"strip 4", 4, 2000, 0, 0, 8.8, 385.0},    {"strip 12", 12, 1000, 0, 0, 16.3, 2350.0},
    {"strip 20", 20, 600, 0, 0, 23.6, 5800.0}, {"tube 12", 12, 1000, 1, 0, 20.2, 2590.0},
    {"bar 4", 4, 200, 0, 1, 18.1, 2665.0},
};
enum { SHAPES = sizeof shapes / sizeof *shapes };

/* Adds a strip or a tube of triangles, or a bar, whose rows follow those that are there. */
static void add_shape(gen_list_t *t, const shape_t *s) {
    const sl_int a = s->across, n = a * s->length, first = t->n;
    uint64_t seed = 3;
    if (s->is_bar) {
        t->n = a * n;
        gen_edges_grid(t, a, a, s->length, &seed);
        return;
    }
    t->n += n;
    for (sl_int k = 0; k < n; k++) {
        const sl_int v = first + k, before = k % a > 0 ? v - 1 : v - 1 + a;
        const int has_before = k % a > 0 || s->is_tube;
        if (has_before) {
            gen_add(t, v > before ? v : before, v > before ? before : v, 1.0);
        }
        if (k >= a) {
            gen_add(t, v, v - a, 1.0);
        }
        if (k >= a && has_before) {
            gen_add(t, v, before - a, 1.0);
        }
    }
}

static gen_matrix_t shape_matrix(const shape_t *s, uint64_t name) {
    gen_list_t t = gen_list(0);
    add_shape(&t, s);
    return gen_store_dominant(&t, name);
}

/* Is the graph dissected along its levels? Graphs with weights are not, and weights of 1 change
 * nothing else. Checks the order and its separator tree. */
static int is_thin(const sl_csc *A) {
    const size_t n = (size_t)A->n_cols, entries = 2 * (size_t)A->p[n];
    sl_off *begin = (sl_off *)test_array(n + 2, sizeof *begin);
    sl_int *to = test_ints(entries), *perm = test_ints(2 * n), *weight = test_ints(n);
    sl_int *tree = test_ints(2 * n);
    const sl_allocator a = sli_allocator(NULL);
    const sl_options opt = options_none();
    sl_symbolic *S = NULL;
    for (int pass = 0; pass < 2; pass++) { /* counts the neighbors of each row, then fills them */
        for (sl_int j = 0; j < A->n_cols; j++) {
            weight[j] = 1;
            for (sl_int p = A->p[j]; p < A->p[j + 1]; p++) {
                const sl_int i = A->i[p];
                if (i != j && pass == 0) {
                    begin[i + 2]++;
                    begin[j + 2]++;
                } else if (i != j) {
                    to[begin[i + 1]++] = j;
                    to[begin[j + 1]++] = i;
                }
            }
        }
        for (size_t k = 2; k < n + 2 && pass == 0; k++) {
            begin[k] += begin[k - 1];
        }
    }
    for (int weighed = 0; weighed < 2; weighed++) {
        sli_graph G = {A->n_cols, begin, to};
        sli_team alone = sli_team_of(1);
        sli_septree septree = {0, tree, tree + n};
        sli_order_job job;
        memset(&job, 0, sizeof job);
        job.G = &G;
        job.weight = weighed ? weight : NULL;
        job.perm = perm + (size_t)weighed * n;
        job.septree = &septree;
        job.team = &alone;
        job.a = &a;
        SL_CHECK(sli_order_nd(&job));
    }
    const int thin = memcmp(perm, perm + n, n * sizeof *perm) != 0;
    SL_CHECK(sl_symbolic_create(&S, A, &opt, NULL));
    const sl_symbolic_arrays v = sl_symbolic_view(S);
    NOTHING_WRONG(check_permutation(v.n, v.perm, v.iperm));
    NOTHING_WRONG(check_septree(&v, A));
    assert_true(v.n_nodes > 1);
    sl_symbolic_free(S);
    free(begin);
    free(to);
    free(perm);
    free(weight);
    free(tree);
    return thin;
}

/* Within 4 percent of what was measured, which is within 6 percent of multilevel dissection, on
 * strips and tubes of up to 20 rows across. */
static void thin_graphs_have_little_fill(void **state) {
    (void)state;
    int failures = 0;
    for (int k = 0; k < SHAPES; k++) {
        for (uint64_t name = 0; name < 3; name++) {
            gen_matrix_t M = shape_matrix(&shapes[k], name);
            sl_options opt = options_none();
            const order_quality q = order_quality_of(&M.view, &opt);
            const double fill = q.fill / M.view.n_cols;
            const int worse = fill > shapes[k].fill || q.path > shapes[k].path;
            print_message("%-8s %8.2f entries a row, path weight %8.0f%s\n", shapes[k].name, fill,
                          q.path, worse ? ": too much" : "");
            failures += worse || !is_thin(&M.view);
            gen_matrix_free(&M);
        }
    }
    assert_int_equal(failures, 0);
}

/* Several components, one of them small, and rows by themselves. */
static void components_are_dissected_one_by_one(void **state) {
    (void)state;
    gen_list_t t = gen_list(1);
    add_shape(&t, &shapes[0]);
    t.n += 2;
    add_shape(&t, &shapes[3]);
    t.n++;
    gen_matrix_t M = gen_store_dominant(&t, 4);
    assert_true(is_thin(&M.view));
    gen_matrix_free(&M);
}

/* A strip with a fan of so many rows next to two of its rows: one level. */
static int is_thin_with_fan(sl_int rows) {
    const shape_t strip = {"strip", 4, 8000, 0, 0, 0.0, 0.0};
    gen_list_t t = gen_list(0);
    add_shape(&t, &strip);
    const sl_int hub = t.n / 2;
    for (sl_int k = 0; k < rows; k++, t.n++) {
        gen_add(&t, t.n, hub + 1, 1.0);
        gen_add(&t, t.n, hub + 2, 1.0);
    }
    gen_matrix_t M = gen_store_dominant(&t, 0);
    const int thin = is_thin(&M.view);
    gen_matrix_free(&M);
    return thin;
}

/* A level that is larger than a leaf is one; there is nothing to cut. */
static void one_level_may_be_large(void **state) {
    (void)state;
    assert_true(is_thin_with_fan(75));
    assert_false(is_thin_with_fan(95));
}

/* A strip with a wide part at its end. */
static gen_matrix_t strip_with_part(const shape_t *strip, const shape_t *part) {
    gen_list_t t = gen_list(0);
    add_shape(&t, strip);
    const sl_int end = t.n - 1;
    add_shape(&t, part);
    gen_add(&t, end + 1, end, 1.0);
    return gen_store_dominant(&t, 0);
}

/* Graphs that are too wide, and a strip with a wide part: its levels are not even. */
static void other_graphs_are_left_to_multilevel_dissection(void **state) {
    (void)state;
    const shape_t wide[] = {{"tube", 30, 300, 1, 0, 0.0, 0.0},
                            {"strip", 30, 300, 0, 0, 0.0, 0.0},
                            {"bar", 6, 100, 0, 1, 0.0, 0.0}};
    const shape_t square = {"part", 40, 40, 0, 0, 0.0, 0.0};
    for (int k = 0; k < 3; k++) {
        gen_matrix_t M = shape_matrix(&wide[k], 0);
        assert_false(is_thin(&M.view));
        gen_matrix_free(&M);
    }
    gen_matrix_t M = strip_with_part(&shapes[0], &square);
    assert_false(is_thin(&M.view));
    gen_matrix_free(&M);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(thin_graphs_have_little_fill),
        cmocka_unit_test(components_are_dissected_one_by_one),
        cmocka_unit_test(one_level_may_be_large),
        cmocka_unit_test(other_graphs_are_left_to_multilevel_dissection),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

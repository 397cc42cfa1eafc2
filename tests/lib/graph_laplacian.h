/* graph_laplacian.h: Laplacians of generated graphs, with one null pivot for each component */
#ifndef SL_TEST_GRAPH_LAPLACIAN_H
#define SL_TEST_GRAPH_LAPLACIAN_H

#include "gen_matrices.h"

/* Connected and disconnected graphs of every shape. */
enum { LAPLACIAN_KINDS = 9 };
static const gen_kind_t laplacian_kinds[LAPLACIAN_KINDS] = {
    GEN_ONE,   GEN_DIAGONAL, GEN_PATH,   GEN_STAR,      GEN_GRID2,
    GEN_GRID3, GEN_FOREST,   GEN_RANDOM, GEN_COMPONENTS};

/* The Laplacian of a generated graph with inexact weights; each component has one null pivot. of:
 * n, the first row of each row's component; may be NULL. */
static inline gen_matrix_t laplacian_of(gen_kind_t kind, sl_int size, int style, sl_int *components,
                                        sl_int *of) {
    gen_list_t t = gen_make(kind, size, 1, 17);
    gen_list_t clean = gen_list(t.n);
    sl_int *group = test_ints((size_t)t.n);
    double *diagonal = test_reals((size_t)t.n);
    for (sl_int k = 0; k < t.n; k++) {
        group[k] = k;
    }
    for (size_t k = 0; k < t.count; k++) {
        sl_int i = t.row[k], j = t.col[k];
        if (i != j) {
            double w = 0.1 + fabs(t.x[k]) / 3.0;
            gen_add(&clean, i, j, -w);
            diagonal[i] += w;
            diagonal[j] += w;
            while (group[i] != i) {
                i = group[i];
            }
            while (group[j] != j) {
                j = group[j];
            }
            group[i > j ? i : j] = i > j ? j : i;
        }
    }
    *components = 0;
    for (sl_int k = 0; k < t.n; k++) {
        *components += group[k] == k;
        gen_add(&clean, k, k, diagonal[k]); /* 0 for an isolated row */
        group[k] = group[group[k]];         /* ascending: the group of a smaller row is final */
    }
    gen_matrix_t M = gen_store(&clean, gen_style(style), 1);
    if (of && t.n > 0) {
        memcpy(of, group, (size_t)t.n * sizeof *of);
    }
    gen_list_free(&t);
    gen_list_free(&clean);
    free(group);
    free(diagonal);
    return M;
}

static inline gen_matrix_t laplacian(gen_kind_t kind, sl_int size, int style, sl_int *components) {
    return laplacian_of(kind, size, style, components, NULL);
}

static inline sl_options options_skip_null(const variant_list_t *variants, int k) {
    sl_options opt = options_none();
    options_set_variant(&opt, variants, k);
    opt.pivots = SL_PIVOTS_SKIP_NULL;
    return opt;
}

#endif

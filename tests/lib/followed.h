/* followed.h: a matrix whose factor follows edits of its pattern, and checks of that factor */
#ifndef SL_TEST_FOLLOWED_H
#define SL_TEST_FOLLOWED_H

#include "edited.h"

/* A matrix, its list, analysis and factor. */
typedef struct followed_t {
    gen_list_t t;
    gen_matrix_t A;
    sl_symbolic *S;
    sl_factor *F;
} followed_t;

/* t is moved to the result. */
static inline followed_t followed_make(gen_list_t t, int style, const sl_options *opt) {
    followed_t y = {t, gen_store(&t, gen_style(style), 1), NULL, NULL};
    SL_CHECK(sl_symbolic_create(&y.S, &y.A.view, NULL, NULL));
    SL_CHECK(sl_factor_create(&y.F, y.S, &y.A.view, opt, NULL));
    return y;
}

static inline void followed_free(followed_t *y) {
    gen_list_free(&y->t);
    gen_matrix_free(&y->A);
    sl_factor_free(y->F);
    sl_symbolic_free(y->S);
}

static inline sl_int *identity(sl_int n) {
    sl_int *map = test_ints((size_t)n + 1);
    for (sl_int k = 0; k < n; k++) {
        map[k] = k;
    }
    return map;
}

/* F is a factor of A: entry by entry, or by a solution where that takes long. */
static inline void check_right(const sl_factor *F, const sl_csc *A) {
    const size_t n = (size_t)A->n_cols;
    if (n <= 400) {
        NOTHING_WRONG(check_factor(F, A));
        return;
    }
    double *b = test_reals(n), *x = test_reals(n);
    gen_reals(b, n, 3);
    SL_CHECK(sl_factor_solve(F, x, n, b, n, 1, NULL));
    BACKWARD_PASSES(A, x, n, b, n, 1);
    free(b);
    free(x);
}

/* Copied columns have the pivots of F, bit by bit. */
static inline void check_pivots(const followed_t *y, const sl_factor *G, const sl_int *new_of,
                                const sl_stats *stats) {
    const sl_symbolic_arrays a = sl_symbolic_view(y->S),
                             b = sl_symbolic_view(sl_factor_view(G).symbolic);
    sl_int same = 0;
    for (sl_int k = 0; k < a.n; k++) {
        const sl_int row = new_of[a.perm[k]];
        same += row != -1 && sl_factor_view(y->F).D[k] == sl_factor_view(G).D[b.iperm[row]];
    }
    assert_in_range(stats->reuse.kept, 0, same);
    assert_int_equal(stats->reuse.kept + stats->reuse.computed, b.n);
}

#endif

/* saved.h: saved factors in aligned memory, and whether two factors answer with the same bits */
#ifndef SL_TEST_SAVED_H
#define SL_TEST_SAVED_H

#include "factored.h"
#include "graph_laplacian.h"
#include "saved_pair.h"

typedef struct saved_t {
    void *block;          /* to be freed */
    unsigned char *bytes; /* aligned to 64 bytes */
    size_t size;
} saved_t;

static inline saved_t saved_of_size(size_t size) {
    saved_t m = {test_array(size + 64, 1), NULL, size};
    m.bytes = (unsigned char *)m.block;
    m.bytes += (64 - (uintptr_t)m.bytes % 64) % 64;
    return m;
}

static inline saved_t saved_make(const sl_symbolic *S, const sl_factor *F) {
    size_t size = 1;
    SL_CHECK(pair_save_memory(NULL, &size, S, F));
    assert_int_equal(size % 64, 0);
    saved_t m = saved_of_size(size);
    memset(m.bytes, 0xA5, size);
    SL_CHECK(pair_save_memory(m.bytes, &size, S, F));
    return m;
}

static inline void saved_free(saved_t *m) {
    free(m->block);
}

/* A way to create objects from saved bytes. */
typedef sl_status (*saved_call_t)(sl_symbolic **S, sl_factor **F, const void *memory, size_t bytes,
                                  unsigned checks, const sl_options *opt);

/* The ways in which a factor may treat null pivots, each with a matrix that shows it; and 2x2
 * pivots. */
enum {
    SAVED_DEFINITE,
    SAVED_SKIPPED,
    SAVED_WEIGHTED,
    SAVED_REGULARIZED,
    SAVED_SIGNED,
    SAVED_PIVOTED,
    SAVED_PIVOTED_REGULARIZED,
    SAVED_VECTORS, /* skipped, and several null vectors are given */
    SAVED_FLOAT,   /* L in float */
    SAVED_WAYS
};

typedef struct saved_case_t {
    factored_t y;
    double *mass, *vectors;
    sl_int *signs;
    sl_options opt; /* of the factor */
} saved_case_t;

/* Makes most diagonal entries small or negative, so that there are 2x2 pivots. */
static inline void saved_make_indefinite(gen_list_t *t) {
    for (size_t k = 0; k < t->count; k++) {
        if (t->row[k] == t->col[k]) {
            t->x[k] *= t->row[k] % 3 == 0 ? 1e-3 : -0.125;
        }
    }
}

static inline saved_case_t saved_case_make(int way, gen_kind_t kind, sl_int size, int style,
                                           const sl_options *from) {
    saved_case_t c;
    sl_int components;
    memset(&c, 0, sizeof c);
    c.opt = options_for_factor(from);
    const int is_pivoted = way == SAVED_PIVOTED || way == SAVED_PIVOTED_REGULARIZED;
    const int skips = way == SAVED_SKIPPED || way == SAVED_WEIGHTED || way == SAVED_VECTORS;
    if (skips) {
        c.y.M = laplacian(kind, size, style, &components);
    } else {
        gen_list_t t = gen_make(kind, size, 1, 42);
        if (is_pivoted) {
            saved_make_indefinite(&t);
        }
        c.y.M = gen_store(&t, gen_style(style), 1);
        gen_list_free(&t);
    }
    sl_int n = c.y.M.view.n_rows;
    c.mass = test_reals((size_t)n);
    c.vectors = test_reals(3 * (size_t)n); /* the second and the third one make a constant */
    c.signs = test_ints((size_t)n);
    for (sl_int k = 0; k < n; k++) {
        c.mass[k] = 1 + k % 7;
        c.vectors[n + k] = 2.0 - k % 7;
        c.vectors[2 * n + k] = k % 7;
        c.signs[k] = k % 5 == 0 ? -1 : k % 3 == 0 ? 0 : 1;
    }
    if (skips) {
        c.opt.pivots = SL_PIVOTS_SKIP_NULL;
        c.opt.mass = way == SAVED_WEIGHTED ? c.mass : NULL;
        c.opt.null_vector = way == SAVED_VECTORS ? c.vectors : NULL;
        c.opt.null_vector_count = way == SAVED_VECTORS ? 3 : 0;
        c.opt.consistency_tolerance = -1;
    } else if (way == SAVED_PIVOTED || way >= SAVED_FLOAT) {
        c.opt.storage = way == SAVED_FLOAT ? SL_STORAGE_FLOAT : SL_STORAGE_DOUBLE;
        c.opt.growth_limit = 1e15;
        c.opt.error_limit = -1.0;
    } else if (way != SAVED_DEFINITE) {
        c.opt.regularization = 1e-8;
        c.opt.signs = way == SAVED_SIGNED ? c.signs : NULL;
    }
    SL_CHECK(is_pivoted ? sl_symbolic_create_pivoted(&c.y.S, &c.y.M.view, FOR_ANALYSIS(from), NULL)
                        : sl_symbolic_create(&c.y.S, &c.y.M.view, FOR_ANALYSIS(from), NULL));
    SL_CHECK(sl_factor_create(&c.y.F, c.y.S, &c.y.M.view, &c.opt, NULL));
    return c;
}

static inline void saved_case_free(saved_case_t *c) {
    factored_free(&c->y);
    free(c->mass);
    free(c->vectors);
    free(c->signs);
}

/* Every kind of query gives the same bits with both factors. */
static inline void assert_same_answers(const sl_factor *F, const sl_factor *G) {
    const sl_symbolic *S = sl_factor_view(F).symbolic, *T = sl_factor_view(G).symbolic;
    const sl_int n = sl_symbolic_view(S).n, nb = n < 9 ? n : 9, nx = n < 7 ? n : 7;
    const size_t ld = n > 0 ? (size_t)n : 1;
    double *B = test_reals(9 * ld), *X = test_reals(9 * ld), *Y = test_reals(9 * ld);
    sl_int *bset = test_ints((size_t)n), *xset = test_ints((size_t)n);
    sl_plan *P = NULL, *Q = NULL;
    sl_region *R = NULL;
    sl_factor_arrays f = sl_factor_view(F), g = sl_factor_view(G);
    gen_reals(B, 9 * ld, 5);
    gen_set(bset, nb, n, 3);
    gen_set(xset, nx, n, 4);
    assert_same_bits(F, G);
    assert_true((f.E == NULL) == (g.E == NULL));
    if (f.E != NULL) {
        assert_memory_equal(f.E, g.E, ld * sizeof *f.E);
    }
    assert_true((uintptr_t)g.L % 64 == 0 && (uintptr_t)g.L_float % 64 == 0);
    assert_true((uintptr_t)g.D % 64 == 0);
    SL_CHECK(sl_factor_solve(F, X, ld, B, ld, 9, NULL));
    SL_CHECK(sl_factor_solve(G, Y, ld, B, ld, 9, NULL));
    assert_memory_equal(X, Y, 9 * ld * sizeof *X);
    for (sl_int nrhs = 1; nrhs <= 3; nrhs++) {
        SL_CHECK(sl_plan_create(&P, S, bset, nb, xset, nx, NULL, NULL));
        SL_CHECK(sl_plan_create(&Q, T, bset, nb, xset, nx, NULL, NULL));
        SL_CHECK(sl_plan_solve(P, F, X, ld, B, ld, nrhs, NULL));
        SL_CHECK(sl_plan_solve(Q, G, Y, ld, B, ld, nrhs, NULL));
        assert_memory_equal(X, Y, 9 * ld * sizeof *X);
#ifdef SL_WITH_ACCURACY
        sl_status refined = sl_plan_solve_regularized(P, F, X, ld, B, ld, nrhs, 2, NULL, NULL);
        assert_true(refined == SL_OK || refined == SL_ERR_INACCURATE ||
                    refined == SL_ERR_ARGUMENT); /* not all rows in the sets */
        SL_EXPECT(refined, sl_plan_solve_regularized(Q, G, Y, ld, B, ld, nrhs, 2, NULL, NULL));
        assert_memory_equal(X, Y, 9 * ld * sizeof *X);
#endif
        if (S != T) {
            SL_EXPECT(SL_ERR_MISMATCH, sl_plan_solve(P, G, Y, ld, B, ld, nrhs, NULL));
        }
        sl_plan_free(P);
        sl_plan_free(Q);
    }
    const sl_status inverse = f.E == NULL ? SL_OK : SL_ERR_UNSUPPORTED;
    SL_EXPECT(inverse, sl_inverse_diagonal(F, X, NULL, SL_ALL, NULL, NULL));
    SL_EXPECT(inverse, sl_inverse_diagonal(G, Y, NULL, SL_ALL, NULL, NULL));
    assert_memory_equal(X, Y, 9 * ld * sizeof *X);
    sl_status status = sl_region_create(&R, G, bset, nb, NULL, NULL, NULL);
    assert_true(status == SL_OK || status == SL_ERR_UNSUPPORTED);
    if (R != NULL) {
        sl_options opt = options_none();
        opt.region = R;
        SL_CHECK(sl_plan_create(&Q, T, bset, nb, bset, nb, &opt, NULL));
        SL_CHECK(sl_plan_solve(Q, G, Y, ld, B, ld, 1, NULL));
        sl_plan_free(Q);
        sl_region_free(R);
    }
    free(B);
    free(X);
    free(Y);
    free(bset);
    free(xset);
}

/* A loaded analysis T has the arrays and counts of S. */
static inline void assert_same_analysis(const sl_symbolic *S, const sl_symbolic *T) {
    sl_stats a, b;
    a.symbolic = sl_symbolic_view(S).info;
    b.symbolic = sl_symbolic_view(T).info;
    assert_same_arrays(S, T);
    a.symbolic.seconds_order = a.symbolic.seconds_analyze = a.symbolic.seconds_tree =
        a.symbolic.seconds_structure = 0; /* are not saved */
    a.symbolic.bytes = b.symbolic.bytes;
    assert_memory_equal(&a.symbolic, &b.symbolic, sizeof a.symbolic);
}

#endif

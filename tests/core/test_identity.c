/* test_identity.c: a factor or an analysis that was released, and created again */
#include "tests/lib/factored.h"

enum { N = 400, BLOCKS = 64 };

/* ---- an allocator that hands out released blocks again ---- */

typedef struct pool_t {
    void *block[BLOCKS];
    size_t bytes[BLOCKS];
    int is_live[BLOCKS], count;
} pool_t;

static void *pool_allocate(void *context, size_t bytes) {
    pool_t *pool = (pool_t *)context;
    size_t size = 1;
    while (size < bytes) { /* so that objects of similar size get the same block */
        size *= 2;
    }
    int k = 0;
    while (k < pool->count && (pool->is_live[k] || pool->bytes[k] != size)) {
        k++;
    }
    if (k == pool->count) {
        assert_true(k < BLOCKS);
        pool->block[k] = test_array(size, 1);
        pool->bytes[k] = size;
        pool->count++;
    }
    pool->is_live[k] = 1;
    return pool->block[k];
}

static void pool_release(void *context, void *block) {
    pool_t *pool = (pool_t *)context;
    int k = 0;
    while (pool->block[k] != block) {
        k++;
    }
    pool->is_live[k] = 0;
}

static sl_options pool_options(pool_t *pool) {
    sl_options opt = options_none();
    memset(pool, 0, sizeof *pool);
    opt.allocator.allocate = pool_allocate;
    opt.allocator.release = pool_release;
    opt.allocator.context = pool;
    return opt;
}

static void pool_free(pool_t *pool) {
    for (int k = 0; k < pool->count; k++) {
        assert_false(pool->is_live[k]);
        free(pool->block[k]);
    }
}

/* ---- other numbers ---- */

/* Ways to change a matrix whose numbers must not be taken for the old ones. With negated
 * off-diagonals D stays as it was, and only signs of L change. */
enum { CHANGES = 4 };

static void change_values(int way, const sl_csc *A, double *x) {
    memcpy(x, A->x, (size_t)A->p[A->n_cols] * sizeof *x);
    for (sl_int j = 0; j < A->n_cols; j++) {
        for (sl_int p = A->p[j]; p < A->p[j + 1]; p++) {
            const int is_diagonal = A->i[p] == j;
            x[p] *= way == 0 && is_diagonal ? 2.0 : way == 1 && !is_diagonal ? -1.0 : 1.0;
        }
    }
    x[A->p[A->n_cols] / 2] *= way == 2 ? 1.0 + DBL_EPSILON : 1.0;
    x[0] *= way == 3 ? 1.0 + DBL_EPSILON : 1.0;
}

static const sl_int set[6] = {105, 106, 125, 126, 145, 146};

/* A selected inverse may outlive its factor: it must not pass for that of the next one. */
static void a_selected_inverse_of_a_released_factor(void **state) {
    (void)state;
    gen_matrix_t M = gen_matrix(GEN_GRID2, N, 1, 1);
    double *x = test_reals((size_t)M.p[N]);
    for (int way = 0; way < CHANGES; way++) {
        pool_t pool;
        sl_options opt = pool_options(&pool);
        sl_csc B = M.view;
        sl_symbolic *S = NULL;
        sl_factor *F = NULL, *G = NULL;
        sl_selected *Z = NULL;
        sl_region *R = NULL;
        SL_CHECK(sl_symbolic_create(&S, &M.view, &opt, NULL));
        SL_CHECK(sl_factor_create(&F, S, &M.view, &opt, NULL));
        SL_CHECK(sl_selected_create(&Z, F, NULL, SL_ALL, &opt, NULL));
        const uintptr_t old = (uintptr_t)F;
        sl_factor_free(F);
        change_values(way, &M.view, x);
        B.x = x;
        SL_CHECK(sl_factor_create(&G, S, &B, &opt, NULL));
        assert_true((uintptr_t)G == old);
        SL_EXPECT(SL_ERR_STALE, sl_region_create(&R, G, set, 6, Z, &opt, NULL));
        assert_null(R);
        SL_CHECK(sl_region_create(&R, G, set, 6, NULL, &opt, NULL));
        SL_EXPECT(SL_ERR_STALE, sl_region_refactor(R, G, Z, NULL));
        SL_CHECK(sl_selected_refactor(Z, G, NULL));
        SL_CHECK(sl_region_refactor(R, G, Z, NULL));
        sl_region_free(R);
        sl_selected_free(Z);
        sl_factor_free(G);
        sl_symbolic_free(S);
        pool_free(&pool);
    }
    free(x);
    gen_matrix_free(&M);
}

/* A plan in a region whose factor was released and created again. */
static void a_region_of_a_released_factor(void **state) {
    (void)state;
    gen_matrix_t M = gen_matrix(GEN_GRID2, N, 1, 1);
    double *values = test_reals((size_t)M.p[N]), b[6] = {1, 2, 3, 4, 5, 6}, x[6], y[6];
    for (int way = 0; way <= CHANGES; way++) { /* the last way changes nothing */
        pool_t pool;
        sl_options opt = pool_options(&pool);
        sl_csc B = M.view;
        sl_symbolic *S = NULL;
        sl_factor *F = NULL;
        sl_region *R = NULL;
        sl_plan *P = NULL;
        const sl_status expected = way < CHANGES ? SL_ERR_STALE : SL_OK;
        SL_CHECK(sl_symbolic_create(&S, &M.view, &opt, NULL));
        SL_CHECK(sl_factor_create(&F, S, &M.view, &opt, NULL));
        SL_CHECK(sl_region_create(&R, F, set, 6, NULL, &opt, NULL));
        opt.region = R;
        SL_CHECK(sl_plan_create(&P, S, set, 6, set, 6, &opt, NULL));
        opt.region = NULL;
        const uintptr_t old = (uintptr_t)F;
        sl_factor_free(F);
        change_values(way, &M.view, values);
        B.x = values;
        SL_CHECK(sl_factor_create(&F, S, &B, &opt, NULL));
        assert_true((uintptr_t)F == old);
        SL_EXPECT(expected, sl_plan_solve(P, F, x, 6, b, 6, 1, NULL));
        SL_CHECK(sl_region_refactor(R, F, NULL, NULL));
        SL_CHECK(sl_plan_solve(P, F, x, 6, b, 6, 1, NULL));
        SL_CHECK(sl_local_solve(F, set, 6, set, 6, y, 6, b, 6, 1, NULL, NULL));
        for (int k = 0; k < 6; k++) {
            assert_true(fabs(x[k] - y[k]) <= 1e-12 * fabs(y[k]));
        }
        sl_region_free(R); /* the plan keeps it: another one is elsewhere */
        const uintptr_t region = (uintptr_t)R;
        SL_CHECK(sl_region_create(&R, F, set, 6, NULL, &opt, NULL));
        assert_true((uintptr_t)R != region);
        memset(x, 0, sizeof x);
        SL_CHECK(sl_plan_solve(P, F, x, 6, b, 6, 1, NULL));
        for (int k = 0; k < 6; k++) {
            assert_true(fabs(x[k] - y[k]) <= 1e-12 * fabs(y[k]));
        }
        sl_plan_free(P);
        sl_region_free(R);
        sl_factor_free(F);
        sl_symbolic_free(S);
        pool_free(&pool);
    }
    free(values);
    gen_matrix_free(&M);
}

/* The status of saving these objects together. */
static void assert_saving(sl_status expected, sl_symbolic *S, sl_factor *F, sl_selected *Z,
                          sl_region *R) {
    sl_region *regions[1] = {R};
    sl_saved_set all;
    size_t bytes;
    memset(&all, 0, sizeof all);
    all.symbolic = S;
    all.factor = F;
    all.selected = Z;
    all.regions = regions;
    all.n_regions = R != NULL;
    SL_EXPECT(expected, sl_save(NULL, NULL, &bytes, &all, NULL));
}

/* A plan, a factor and a region keep an analysis that was released. They do not belong to one that
 * is created again, of the same order or of another. */
static void an_analysis_created_again(void **state) {
    (void)state;
    gen_matrix_t M = gen_matrix(GEN_PATH, N, 1, 1);
    double b[6] = {1, 2, 3, 4, 5, 6}, x[6], full[N], rhs[N] = {1};
    for (int other = 0; other < 2; other++) {
        pool_t pool;
        sl_options opt = pool_options(&pool), rest = opt;
        sl_symbolic *S = NULL;
        sl_factor *F = NULL, *G = NULL;
        sl_plan *P = NULL, *inside = NULL;
        sl_region *R = NULL;
        sl_selected *Z = NULL;
        SL_CHECK(sl_symbolic_create(&S, &M.view, &opt, NULL));
        SL_CHECK(sl_factor_create(&F, S, &M.view, &rest, NULL));
        SL_CHECK(sl_plan_create(&P, S, set, 6, set, 6, &rest, NULL));
        SL_CHECK(sl_region_create(&R, F, set, 6, NULL, &rest, NULL));
        SL_CHECK(sl_selected_create(&Z, F, NULL, SL_ALL, &rest, NULL));
        const uintptr_t old = (uintptr_t)S;
        sl_symbolic_free(S);
        opt.ordering = other ? SL_ORDERING_NATURAL : SL_ORDERING_ND;
        SL_CHECK(sl_symbolic_create(&S, &M.view, &opt, NULL));
        assert_true((uintptr_t)S != old);
        SL_CHECK(sl_factor_create(&G, S, &M.view, &rest, NULL));
        SL_EXPECT(SL_ERR_MISMATCH, sl_plan_solve(P, G, x, 6, b, 6, 1, NULL));
        SL_CHECK(sl_plan_solve(P, F, x, 6, b, 6, 1, NULL));
        SL_CHECK(sl_factor_solve(F, full, N, rhs, N, 1, NULL));
        SL_CHECK(sl_factor_refine(F, &M.view, full, N, rhs, N, 1, 1, NULL, NULL));
        SL_CHECK(sl_factor_refactor(F, &M.view, NULL));
        SL_EXPECT(SL_ERR_MISMATCH, sl_selected_refactor(Z, G, NULL));
        rest.region = R;
        SL_EXPECT(SL_ERR_MISMATCH, sl_plan_create(&inside, S, set, 6, set, 6, &rest, NULL));
        SL_EXPECT(SL_ERR_MISMATCH, sl_region_refactor(R, G, NULL, NULL));
        SL_CHECK(sl_region_refactor(R, F, NULL, NULL));
        assert_saving(SL_ERR_MISMATCH, S, F, NULL, NULL);
        assert_saving(SL_ERR_MISMATCH, S, G, Z, NULL);
        assert_saving(SL_ERR_MISMATCH, S, G, NULL, R);
        sl_selected_free(Z);
        sl_region_free(R);
        sl_plan_free(P);
        sl_factor_free(F);
        sl_factor_free(G);
        sl_symbolic_free(S);
        pool_free(&pool);
    }
    gen_matrix_free(&M);
}

/* Sums with other coefficients, and changed columns, are other numbers too. */
static void sums_and_changed_columns(void **state) {
    (void)state;
    gen_matrix_t M = gen_matrix(GEN_GRID2, N, 1, 1);
    double *x = test_reals((size_t)M.p[N]);
    for (int way = 0; way < 2; way++) {
        pool_t pool;
        sl_options opt = pool_options(&pool);
        sl_symbolic *S = NULL;
        sl_factor *F = NULL;
        sl_selected *Z = NULL;
        sl_region *R = NULL;
        sl_csc B = M.view;
        SL_CHECK(sl_symbolic_create(&S, &M.view, &opt, NULL));
        double *v = test_reals((size_t)scatter_length(S));
        const double *const values[1] = {v};
        SL_CHECK(sl_symbolic_scatter(S, v, &M.view, NULL));
        for (int turn = 0; turn < 2; turn++) {
            const double c = 1.0 + turn * DBL_EPSILON;
            const sl_int column = 7;
            if (way == 0) {
                SL_CHECK(sl_factor_create_sums(&F, 1, S, &c, values, 1, &opt, NULL, NULL));
            } else {
                SL_CHECK(sl_factor_create(&F, S, &M.view, &opt, NULL));
                memcpy(x, M.x, (size_t)M.p[N] * sizeof *x);
                x[M.p[column]] *= c;
                B.x = x;
                SL_CHECK(sl_factor_change_entries(F, &B, NULL, &column, NULL, 1, NULL, NULL));
            }
            if (turn == 0) {
                SL_CHECK(sl_selected_create(&Z, F, NULL, SL_ALL, &opt, NULL));
            } else {
                SL_EXPECT(SL_ERR_STALE, sl_region_create(&R, F, set, 6, Z, &opt, NULL));
            }
            sl_factor_free(F);
        }
        free(v);
        sl_selected_free(Z);
        sl_symbolic_free(S);
        pool_free(&pool);
    }
    free(x);
    gen_matrix_free(&M);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_selected_inverse_of_a_released_factor),
        cmocka_unit_test(a_region_of_a_released_factor),
        cmocka_unit_test(an_analysis_created_again),
        cmocka_unit_test(sums_and_changed_columns),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

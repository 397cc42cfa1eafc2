/* allocating_calls.h: calls that allocate, each by one signature, and what they work on */
#ifndef SL_TEST_ALLOCATING_CALLS_H
#define SL_TEST_ALLOCATING_CALLS_H

#include "factored.h"
#include "constraint_calls.h"

typedef struct fixture_t {
    factored_t y; /* a grid, allocated by malloc */
    sl_plan *P;
    sl_int bset[225], xset[225], perm[225];
    double B[225 * 3], X[225 * 3], before[225 * 3];
    char text[4096];
    size_t length;
    int is_upper; /* y stores the upper triangle only */
} fixture_t;

/* Runs one function with the allocator of opt. Checks that the object is NULL after an error, and
 * frees what it created. */
typedef sl_status (*scenario_t)(fixture_t *f, const sl_options *opt);

#define MADE_OR_NULL(status, object) assert_true(((object) != NULL) == ((status) == SL_OK))

/* Takes the address of M because the call that sets M is the other argument. */
static sl_status end_matrix(sl_status status, sl_matrix **M) {
    MADE_OR_NULL(status, *M);
    sl_matrix_free(*M);
    return status;
}

/* a pointer that is not NULL, to see that the call sets it to NULL */
#define GARBAGE(type) ((type *)(void *)f)

static sl_status from_triplets(fixture_t *f, const sl_options *opt) {
    const sl_int i[4] = {0, 2, 1, 2}, j[4] = {0, 0, 1, 0};
    const double x[4] = {1, 2, 3, 4};
    sl_matrix *M = GARBAGE(sl_matrix);
    return end_matrix(sl_matrix_from_triplets(&M, 3, 2, 4, i, j, x, opt, NULL), &M);
}

static sl_status parse(fixture_t *f, const sl_options *opt) {
    sl_matrix *M = GARBAGE(sl_matrix);
    return end_matrix(sl_matrix_parse(&M, f->text, f->length, opt, NULL), &M);
}

static sl_status read_file(fixture_t *f, const sl_options *opt) {
    sl_matrix *M = GARBAGE(sl_matrix);
    return end_matrix(sl_matrix_read(&M, f->text, opt, NULL), &M);
}

static sl_status submatrix(fixture_t *f, const sl_options *opt) {
    sl_matrix *M = GARBAGE(sl_matrix);
    return end_matrix(sl_matrix_submatrix(&M, &f->y.M.view, f->perm, 100, opt, NULL), &M);
}

static sl_status triangle(fixture_t *f, const sl_options *opt) {
    const sl_triangle none = SL_TRIANGLE_NONE; /* a grid has edges */
    sl_triangle found = none;
    sl_status status = sl_csc_triangle(&f->y.M.view, &found, opt, NULL);
    assert_true((found != none) == (status == SL_OK));
    return status;
}

static sl_status symbolic_with(fixture_t *f, const sl_options *opt, sl_ordering ordering) {
    sl_options wanted = *opt;
    sl_symbolic *S = GARBAGE(sl_symbolic);
    wanted.ordering = ordering;
    wanted.perm = f->perm;
    sl_status status = sl_symbolic_create(&S, &f->y.M.view, &wanted, NULL);
    MADE_OR_NULL(status, S);
    sl_symbolic_free(S);
    return status;
}

static sl_status symbolic_default(fixture_t *f, const sl_options *opt) {
    return symbolic_with(f, opt, SL_ORDERING_ND);
}

static sl_status symbolic_metis(fixture_t *f, const sl_options *opt) {
    return symbolic_with(
        f, opt, ordering_is_present(SL_ORDERING_METIS) ? SL_ORDERING_METIS : SL_ORDERING_NATURAL);
}

static sl_status symbolic_natural(fixture_t *f, const sl_options *opt) {
    return symbolic_with(f, opt, SL_ORDERING_NATURAL);
}

static sl_status symbolic_given(fixture_t *f, const sl_options *opt) {
    return symbolic_with(f, opt, SL_ORDERING_GIVEN);
}

static sl_status factor(fixture_t *f, const sl_options *opt) {
    sl_factor *F = GARBAGE(sl_factor);
    sl_status status = sl_factor_create(&F, f->y.S, &f->y.M.view, opt, NULL);
    MADE_OR_NULL(status, F);
    sl_factor_free(F);
    return status;
}

static sl_status factor_float(fixture_t *f, const sl_options *opt) {
    sl_options single = *opt;
    single.storage = SL_STORAGE_FLOAT;
    return factor(f, &single);
}

static sl_status lower(fixture_t *f, const sl_options *opt) {
    sl_matrix *M = GARBAGE(sl_matrix);
    return end_matrix(sl_factor_lower(&M, f->y.F, opt), &M);
}

static sl_status plan(fixture_t *f, const sl_options *opt) {
    sl_plan *P = GARBAGE(sl_plan);
    sl_status status = sl_plan_create(&P, f->y.S, f->bset, 20, f->xset, 30, opt, NULL);
    MADE_OR_NULL(status, P);
    sl_plan_free(P);
    return status;
}

static sl_status work(fixture_t *f, const sl_options *opt) {
    sl_work *W = GARBAGE(sl_work);
    sl_status status = sl_work_create(&W, opt);
    MADE_OR_NULL(status, W);
    sl_work_free(W);
    return status;
}

/* A workspace that failed to grow stays usable: all calls of a scenario use the same one. */
typedef sl_status (*use_t)(fixture_t *f, sl_work *W);

static sl_status in_work(fixture_t *f, const sl_options *opt, use_t use) {
    counter_t *counter = (counter_t *)opt->allocator.context;
    sl_work *W = NULL;
    sl_status status = sl_work_create(&W, opt);
    if (status != SL_OK) {
        assert_null(W);
        return status;
    }
    memcpy(f->X, f->before, sizeof f->X);
    status = use(f, W);
    if (status != SL_OK) {
        assert_memory_equal(f->X, f->before, sizeof f->X); /* unchanged on error */
        int64_t keep = counter->fail_at;
        counter->fail_at = -1;
        SL_CHECK(use(f, W));
        counter->fail_at = keep;
    }
    sl_work_free(W);
    return status;
}

static sl_status use_full(fixture_t *f, sl_work *W) {
    return sl_factor_solve(f->y.F, f->X, 225, f->B, 225, 3, W);
}

static sl_status use_plan(fixture_t *f, sl_work *W) {
    return sl_plan_solve(f->P, f->y.F, f->X, 30, f->B, 20, 3, W);
}

static sl_status use_local(fixture_t *f, sl_work *W) {
    return sl_local_solve(f->y.F, f->bset, 20, f->xset, 30, f->X, 30, f->B, 20, 3, W, NULL);
}

static sl_status use_reserve(fixture_t *f, sl_work *W) {
    (void)f;
    return sl_work_reserve(W, 4096);
}

/* A small solve first, then a larger one that has to grow the workspace. */
static sl_status use_growing(fixture_t *f, sl_work *W) {
    double one[1];
    sl_status status = sl_local_solve(f->y.F, f->bset, 1, f->xset, 1, one, 1, f->B, 1, 1, W, NULL);
    return status != SL_OK ? status : use_full(f, W);
}

#define IN_WORK(name, use) \
    static sl_status name(fixture_t *f, const sl_options *opt) { \
        return in_work(f, opt, use); \
    }

IN_WORK(full_solve, use_full)
IN_WORK(plan_solve, use_plan)
IN_WORK(local_solve, use_local)
IN_WORK(reserve, use_reserve)
IN_WORK(growing, use_growing)

/* W == NULL: the scratch of one call comes from the allocator of the factor. */
static sl_status solve_without_work(fixture_t *f, const sl_options *opt) {
    sl_factor *F = NULL;
    sl_status status = sl_factor_create(&F, f->y.S, &f->y.M.view, opt, NULL);
    if (status == SL_OK) {
        memcpy(f->X, f->before, sizeof f->X);
        status = sl_factor_solve(F, f->X, 225, f->B, 225, 3, NULL);
        status = status != SL_OK ? status : sl_plan_solve(f->P, F, f->X, 30, f->B, 20, 3, NULL);
        status = status != SL_OK ? status
                                 : sl_local_solve(F, f->bset, 20, f->xset, 30, f->X, 30, f->B, 20,
                                                  3, NULL, NULL);
    }
    sl_factor_free(F);
    return status;
}

/* The solution is untouched without memory. */
static sl_status fixed(fixture_t *f, const sl_options *opt) {
    sl_fixed *D = GARBAGE(sl_fixed);
    sl_options given = *opt;
    given.ordering = SL_ORDERING_GIVEN;
    given.perm = f->perm;
    sl_status status = sl_fixed_create(&D, &f->y.M.view, f->bset, 20, &given, NULL);
    MADE_OR_NULL(status, D);
    if (status == SL_OK) {
        memcpy(f->X, f->before, sizeof f->X);
        status = sl_fixed_solve(D, f->X, 225, f->X, 225, f->B, 20, 3, NULL);
        assert_true((memcmp(f->X, f->before, sizeof f->X) != 0) == (status == SL_OK));
    }
    sl_fixed_free(D);
    return status;
}

/* rows of bset: too few to keep columns; rows 0 .. 99: some are kept */
static sl_status restriction(fixture_t *f, const sl_int *rows, sl_int count,
                             const sl_options *opt) {
    sl_symbolic *S = GARBAGE(sl_symbolic);
    sl_factor *G = GARBAGE(sl_factor);
    const sl_status status =
        sl_factor_submatrix(&S, &G, f->y.F, &f->y.M.view, rows, count, opt, NULL);
    MADE_OR_NULL(status, S);
    MADE_OR_NULL(status, G);
    sl_factor_free(G);
    sl_symbolic_free(S);
    return status;
}

static sl_status restrict_half(fixture_t *f, const sl_options *opt) {
    sl_int rows[100];
    for (sl_int k = 0; k < 100; k++) {
        rows[k] = k;
    }
    return restriction(f, rows, 100, opt);
}

static sl_status restrict_few(fixture_t *f, const sl_options *opt) {
    return restriction(f, f->bset, 20, opt);
}

/* Three rows in the middle of the grid are joined with rows below them, row 7 is gone, and two rows
 * are new. */
static sl_status edit(fixture_t *f, const sl_options *opt) {
    const sl_csc *A = &f->y.M.view;
    gen_list_t t = gen_list(A->n_cols);
    sl_int new_of[225];
    sl_symbolic *T = GARBAGE(sl_symbolic);
    for (sl_int j = 0; j < A->n_cols; j++) {
        new_of[j] = j < 7 ? j : j == 7 ? -1 : j - 1;
    }
    t.n++;
    for (sl_int j = 0; j < A->n_cols; j++) {
        for (sl_int p = A->p[j]; p < A->p[j + 1]; p++) {
            if (A->i[p] >= j && A->i[p] != 7 && j != 7) {
                gen_add(&t, new_of[A->i[p]], new_of[j], 1.0);
            } else if (A->i[p] < j && A->i[p] != 7 && j != 7 && f->is_upper) {
                gen_add(&t, new_of[j], new_of[A->i[p]], 1.0);
            }
        }
    }
    for (sl_int k = 110; k < 113; k++) {
        gen_add(&t, k + 31, k, 1.0);
    }
    gen_add(&t, 225, 224, 1.0);
    gen_matrix_t B = gen_store(&t, gen_style(0), 1);
    const sl_status status = sl_symbolic_edit(&T, f->y.S, A, &B.view, new_of, opt, NULL);
    MADE_OR_NULL(status, T);
    sl_symbolic_free(T);
    gen_matrix_free(&B);
    gen_list_free(&t);
    return status;
}

/* The last entry that is read of column 148 has another value; F keeps its own. */
static sl_status edit_factor(fixture_t *f, const sl_options *opt) {
    sl_int rows[225];
    sl_factor *G = GARBAGE(sl_factor);
    sl_stats stats;
    for (sl_int j = 0; j < 225; j++) {
        rows[j] = j;
    }
    double *x = &f->y.M.x[f->y.M.view.p[149] - 1];
    const double before = *x;
    *x += 0.5;
    const sl_status status = sl_factor_edit(&G, f->y.F, f->y.S, &f->y.M.view, rows, opt, &stats);
    *x = before;
    MADE_OR_NULL(status, G);
    assert_true(status != SL_OK || !stats.reuse.is_anew);
    sl_factor_free(G);
    return status;
}

/* A set of pins is as before after each call that fails. */
static sl_status pins(fixture_t *f, const sl_int *rows, sl_int count, const sl_options *opt) {
    static const sl_int gone[3] = {7, 0, 12};
    sl_constraints *P = GARBAGE(sl_constraints);
    sl_status status = sl_constraints_create(&P, f->y.F, opt);
    MADE_OR_NULL(status, P);
    if (status == SL_OK) {
        status = sl_constraints_add(P, rows, NULL, count, NULL);
        assert_int_equal(pins_count(P), status == SL_OK ? count : 0);
    }
    if (status == SL_OK) {
        status = sl_constraints_release(P, gone, 3, NULL);
        assert_int_equal(pins_count(P), status == SL_OK ? count - 3 : count);
    }
    if (status == SL_OK) {
        memcpy(f->X, f->before, sizeof f->X);
        status = sl_constraints_solve(P, NULL, f->X, 225, f->B, 225, f->B, 225, 3, NULL);
        assert_true((memcmp(f->X, f->before, sizeof f->X) != 0) == (status == SL_OK));
    }
    sl_constraints_free(P);
    return status;
}

static sl_status pins_few(fixture_t *f, const sl_options *opt) {
    return pins(f, f->bset, 20, opt);
}

static sl_status pins_half(fixture_t *f, const sl_options *opt) {
    return pins(f, f->perm, 112, opt);
}

static void fixture_make(fixture_t *f, int style) {
    uint64_t seed = 2;
    f->y = factored_make(GEN_GRID2, 225, 1, style, NULL);
    f->is_upper = gen_style(style).triangle == SL_TRIANGLE_UPPER;
    gen_set(f->bset, 20, 225, gen_bits(&seed));
    gen_set(f->xset, 30, 225, gen_bits(&seed));
    gen_permutation(f->perm, 225, gen_bits(&seed));
    gen_reals(f->B, 225 * 3, gen_bits(&seed));
    gen_reals(f->before, 225 * 3, gen_bits(&seed));
    SL_CHECK(sl_plan_create(&f->P, f->y.S, f->bset, 20, f->xset, 30, NULL, NULL));
}

static void fixture_free(fixture_t *f) {
    sl_plan_free(f->P);
    factored_free(&f->y);
}

#endif

/* test_complex_storage.c: L as complex: every other column of L in double, in every call */
#include "tests/lib/factored.h"
#include "tests/lib/local_solve.h"
#include "tests/lib/parallel_for.h"

/* A Hermitian matrix, U' A U with A of a generator and a diagonal U of complex numbers of length 1,
 * analyzed and factored in both storages. */
typedef struct pair_t {
    gen_matrix_t G;
    double *values;
    sl_matrix *M;
    sl_csc A;
    sl_symbolic *S;
    sl_factor *F[2]; /* L in double and as complex */
    sl_int n;        /* real rows */
} pair_t;

static sl_options options_complex(sl_isa isa) {
    sl_options opt = options_none();
    opt.isa = isa;
    opt.storage = SL_STORAGE_COMPLEX;
    return opt;
}

static pair_t pair_make(gen_kind_t kind, sl_int size, int style, sl_isa isa) {
    gen_list_t t = gen_make(kind, size, kind == GEN_KKT ? -1 : 1, 3);
    pair_t y = {gen_store(&t, gen_style(style), 5),
                NULL,
                NULL,
                {0, 0, NULL, NULL, NULL},
                NULL,
                {NULL, NULL},
                0};
    sl_options opt = options_none();
    const sl_csc *B = &y.G.view;
    gen_list_free(&t);
    y.values = test_reals(2 * (size_t)B->p[B->n_cols]);
    for (sl_int j = 0; j < B->n_cols; j++) {
        for (sl_int p = B->p[j]; p < B->p[j + 1]; p++) {
            const double angle = 1.3 * B->i[p] * B->i[p] - 1.3 * j * j;
            y.values[2 * p] = B->x[p] * cos(angle);
            y.values[2 * p + 1] = B->x[p] * sin(angle);
        }
    }
    const sl_hermitian H = {B->n_cols, B->p, B->i, y.values, NULL};
    SL_CHECK(sl_matrix_from_hermitian(&y.M, &H, NULL, NULL));
    y.A = sl_matrix_view(y.M);
    y.n = y.A.n_cols;
    opt.block_size = 2;
    opt.relaxation = style % 2 == 1 ? SL_RELAXATION_NONE : SL_RELAXATION_DEFAULT;
    SL_CHECK(sl_symbolic_create(&y.S, &y.A, &opt, NULL));
    opt = options_none();
    opt.isa = isa;
    opt.method = SL_METHOD_SUPERNODAL;
    SL_CHECK(sl_factor_create(&y.F[0], y.S, &y.A, &opt, NULL));
    opt = options_complex(isa);
    SL_CHECK(sl_factor_create(&y.F[1], y.S, &y.A, &opt, NULL));
    return y;
}

static void pair_free(pair_t *y) {
    sl_factor_free(y->F[0]);
    sl_factor_free(y->F[1]);
    sl_symbolic_free(y->S);
    sl_matrix_free(y->M);
    gen_matrix_free(&y->G);
    free(y->values);
}

/* Calls a test for each kind of matrix, and small dense ones, with each instruction set. */
static void for_each(void (*test)(const pair_t *y, sl_isa isa)) {
    const isa_list_t isas = isas_present();
    for (int kind = GEN_NONE; kind < GEN_REGULAR + 5; kind++) {
        for (int k = 0; k < isas.count; k++) {
            pair_t y = kind < GEN_REGULAR
                           ? pair_make((gen_kind_t)kind, 90, kind % GEN_STYLES, isas.isa[k])
                           : pair_make(GEN_DENSE, 1 + kind - GEN_REGULAR, 0, isas.isa[k]);
            test(&y, isas.isa[k]);
            pair_free(&y);
        }
    }
}

/* L, dense. */
static double *lower_of(const sl_factor *F, sl_int n) {
    sl_matrix *L = NULL;
    double *dense = test_reals((size_t)n * (size_t)n);
    SL_CHECK(sl_factor_lower(&L, F, NULL));
    const sl_csc v = sl_matrix_view(L);
    for (sl_int j = 0; j < n; j++) {
        for (sl_int p = v.p[j]; p < v.p[j + 1]; p++) {
            dense[(size_t)v.i[p] + (size_t)j * (size_t)n] = v.x[p];
        }
    }
    sl_matrix_free(L);
    return dense;
}

/* L and D are a factorization. They consist of blocks [a -b; b a] and [d 0; 0 d], to the last bit,
 * and any number of threads gives the same. */
static void check_half(const pair_t *y, sl_isa isa) {
    sl_options opt = options_complex(isa);
    sl_factor *G = NULL;
    int calls = 0;
    opt.threads.count = 3;
    opt.threads.run = run_backwards;
    opt.threads.context = &calls;
    SL_CHECK(sl_factor_create(&G, y->S, &y->A, &opt, NULL));
    SL_CHECK(sl_factor_refactor(G, &y->A, NULL));
    const size_t n = (size_t)y->n;
    const double *D = sl_factor_view(y->F[1]).D;
    double *L = lower_of(y->F[1], y->n), *other = lower_of(G, y->n);
    SAME_VALUES(D, sl_factor_view(G).D, n);
    SAME_VALUES(L, other, n * n);
    assert_null(sl_factor_view(G).L);
    assert_null(sl_factor_view(G).L_float);
    for (size_t j = 0; j < n; j++) {
        const double *first = L + (j - j % 2) * n;
        assert_true(D[j] == D[j - j % 2]);
        for (size_t i = j; i < n; i++) {
            assert_true(i / 2 == j / 2 ? L[i + j * n] == (i == j ? 1.0 : 0.0)
                        : j % 2 == 0   ? 1
                        : i % 2 == 0   ? L[i + j * n] == -first[i + 1]
                                       : L[i + j * n] == first[i - 1]);
        }
    }
    double *A = ref_dense(&y->A), *C = ref_permute(y->n, A, sl_symbolic_view(y->S).perm);
    NOTHING_WRONG(check_product(y->n, C, L, D));
    free(A);
    free(C);
    free(L);
    free(other);
    sl_factor_free(G);
}

static void l_is_a_factor_of_blocks(void **state) {
    (void)state;
    for_each(check_half);
    /* a front of several chunks and pieces */
    pair_t y = pair_make(GEN_DENSE, 270, 0, SL_ISA_AUTO);
    check_half(&y, SL_ISA_AUTO);
    pair_free(&y);
}

/* Any number of right-hand sides solve to rounding; local solves have the bits of full ones, also
 * of sets that divide pairs. */
static void check_solves(const pair_t *y, sl_isa isa) {
    static const sl_int counts[] = {1, 2, 3, 4, 5, 8, 11, 61};
    const size_t n = (size_t)y->n;
    double *B = test_reals(61 * n), *X = test_reals(61 * n);
    sl_work *W = NULL;
    (void)isa;
    SL_CHECK(sl_work_create(&W, NULL));
    gen_reals(B, 61 * n, 7);
    for (size_t k = 0; k < sizeof counts / sizeof counts[0]; k++) {
        SL_CHECK(sl_factor_solve(y->F[1], X, n ? n : 1, B, n ? n : 1, counts[k], W));
        BACKWARD_PASSES(&y->A, X, n ? n : 1, B, n ? n : 1, counts[k]);
        for (sl_int some = 0; some < 4; some++) {
            const sl_int nb = some == 3 ? -1 : some < y->n ? some : y->n;
            const sl_int nx = some == 0 ? -1 : 3 * some < y->n ? 3 * some : y->n;
            local_solve_t q =
                local_solve_random(y->F[1], y->n, nb, nx, counts[k], 31 + (uint64_t)some);
            local_solve_check(y->S, y->F[1], &q, W);
            local_solve_free(&q);
        }
    }
    sl_work_free(W);
    free(B);
    free(X);
}

static void solves_are_exact_and_local(void **state) {
    (void)state;
    for_each(check_solves);
}

/* What reads L in other ways agrees with L in double. */
static void check_other_calls(const pair_t *y, sl_isa isa) {
    const size_t n = (size_t)y->n;
    double *B = test_reals(2 * n), *X[2], *diagonal[2], logdet[2], sign[2], block[2][8], rcond[2];
    double pairs[2][4];
    const sl_int rows[2] = {0, y->n / 2 - 1}, columns[2] = {y->n / 2 - 1, 0};
    sl_stats stats[2];
    memset(stats, 0, sizeof stats);
    (void)isa;
    gen_reals(B, 2 * n, 9);
    for (int k = 0; k < 2 && n > 0; k++) {
        sl_selected *Z = NULL;
        X[k] = test_reals(6 * n);
        diagonal[k] = test_reals(n);
        SL_CHECK(sl_factor_solve_part(y->F[k], SL_PART_L, X[k], n, B, n, 2, NULL));
        SL_CHECK(sl_factor_solve_part(y->F[k], SL_PART_LT, X[k] + 2 * n, n, B, n, 2, NULL));
        SL_CHECK(sl_factor_multiply_part(y->F[k], SL_PART_L | SL_PART_LT, X[k] + 4 * n, n, B, n, 2,
                                         NULL));
        SL_CHECK(sl_complex_logdet(y->F[k], &logdet[k], &sign[k]));
        SL_CHECK(sl_complex_inverse_block(y->F[k], block[k], 2, rows, 2, rows, 2, NULL, NULL));
        SL_CHECK(sl_complex_inverse_pairs(y->F[k], pairs[k], rows, columns, 2, NULL, NULL));
        sl_factor_stats(y->F[k], &stats[k]);
        SL_CHECK(sl_selected_create(&Z, y->F[k], NULL, 0, NULL, NULL));
        SL_CHECK(sl_selected_diagonal(Z, diagonal[k], NULL, y->n, NULL));
        SL_CHECK(sl_factor_rcond(y->F[k], &y->A, &rcond[k], NULL));
        sl_selected_free(Z);
    }
    if (n > 0) {
        double most = 0.0, largest = 0.0, entry = 0.0;
        for (size_t i = 0; i < 6 * n; i++) {
            largest = fmax(largest, fabs(X[0][i]));
            most = fmax(most, fabs(X[0][i] - X[1][i]));
        }
        assert_true(most <= 1e-12 * largest);
        for (size_t i = 0; i < n; i++) {
            entry = fmax(entry, fabs(diagonal[0][i]));
        }
        for (size_t i = 0; i < n; i++) {
            assert_true(fabs(diagonal[0][i] - diagonal[1][i]) <= 1e-11 * entry);
        }
        for (int i = 0; i < 8; i++) {
            assert_true(fabs(block[0][i] - block[1][i]) <= 1e-11 * entry);
            assert_true(fabs(pairs[0][i % 4] - pairs[1][i % 4]) <= 1e-11 * entry);
        }
        assert_true(fabs(logdet[0] - logdet[1]) <= 1e-12 * (double)n && sign[0] == sign[1]);
        assert_int_equal(stats[0].factor.positive, stats[1].factor.positive);
        assert_int_equal(stats[0].factor.negative, stats[1].factor.negative);
        assert_true(stats[1].factor.positive + stats[1].factor.negative == y->n);
        assert_true(fabs(rcond[0] - rcond[1]) <= 0.1 * rcond[0]); /* ties of the estimator */
        for (int k = 0; k < 2; k++) {
            free(X[k]);
            free(diagonal[k]);
        }
    }
    free(B);
}

static void other_calls_agree(void **state) {
    (void)state;
    for_each(check_other_calls);
}

/* Half of the bytes of L. */
static void memory_is_halved(void **state) {
    (void)state;
    pair_t y = pair_make(GEN_DENSE, 200, 0, SL_ISA_AUTO);
    sl_stats full, half;
    sl_symbolic_stats(y.S, &full);
    half = full;
    sl_factor_stats(y.F[0], &full);
    sl_factor_stats(y.F[1], &half);
    /* dense: the one panel is needed in double as well while it is factored */
    assert_true((double)half.factor.bytes <
                (double)full.factor.bytes + 4.1 * (double)full.symbolic.nnz_panels + 4096);
    pair_free(&y);
    y = pair_make(GEN_GRID2, 3000, 0, SL_ISA_AUTO);
    sl_symbolic_stats(y.S, &full);
    half = full;
    sl_factor_stats(y.F[0], &full);
    sl_factor_stats(y.F[1], &half);
    assert_true((double)half.factor.bytes <
                (double)full.factor.bytes - 3.0 * (double)full.symbolic.nnz_panels);
    pair_free(&y);
}

static sl_status create(const sl_symbolic *S, const sl_csc *A, sl_options opt) {
    sl_factor *F = NULL;
    opt.storage = SL_STORAGE_COMPLEX;
    const sl_status status = sl_factor_create(&F, S, A, &opt, NULL);
    assert_int_equal(status == SL_OK, F != NULL);
    sl_factor_free(F);
    return status;
}

/* The same with 2x2 pivots. */
static sl_status create_pivoted(const sl_csc *A) {
    sl_symbolic *S = NULL;
    SL_CHECK(sl_symbolic_create_pivoted(&S, A, NULL, NULL));
    const sl_status status = create(S, A, options_none());
    sl_symbolic_free(S);
    return status;
}

/* Real matrices, null pivots that are replaced, sums, changes and files are refused. */
static void what_is_not_complex_is_refused(void **state) {
    (void)state;
    pair_t y = pair_make(GEN_GRID2, 49, 0, SL_ISA_AUTO);
    const size_t entries = (size_t)y.A.p[y.n];
    double *x = test_reals(entries);
    sl_csc A = y.A;
    sl_options opt = options_none();
    size_t bytes;
    A.x = x;
    for (size_t k = 0; k < entries; k++) { /* each entry once */
        memcpy(x, y.A.x, entries * sizeof *x);
        x[k] += 0.5;
        assert_int_equal(create(y.S, &A, opt), SL_ERR_UNSUPPORTED);
    }
    assert_int_equal(sl_factor_refactor(y.F[1], &A, NULL), SL_ERR_UNSUPPORTED);
    assert_int_equal(sl_factor_solve(y.F[1], x, (size_t)y.n, x, (size_t)y.n, 1, NULL),
                     SL_ERR_STATE);
    SL_CHECK(sl_factor_refactor(y.F[1], &y.A, NULL));
    opt.null_pivots = SL_NULL_PIVOT_SKIP;
    assert_int_equal(create(y.S, &y.A, opt), SL_ERR_UNSUPPORTED);
    opt = options_none();
    opt.regularization = 1e-3;
    assert_int_equal(create(y.S, &y.A, opt), SL_ERR_UNSUPPORTED);
    assert_int_equal(sl_save_bytes(&bytes, y.S, y.F[1]), SL_ERR_UNSUPPORTED);
    const sl_int p[2] = {0, 1}, row = 3;
    const double one = 1.0;
    const sl_csc V = {y.n, 1, p, &row, &one};
    assert_int_equal(sl_factor_update(y.F[1], &V, &one, NULL, NULL), SL_ERR_UNSUPPORTED);
    opt = options_complex(SL_ISA_AUTO);
    double *terms = test_reals((size_t)sl_symbolic_entries(y.S));
    const double *const term[1] = {terms};
    sl_factor *G = NULL;
    SL_CHECK(sl_symbolic_scatter(y.S, terms, &y.A, NULL));
    assert_int_equal(sl_factor_create_combination(&G, y.S, &one, term, 1, &opt, NULL),
                     SL_ERR_UNSUPPORTED);
    assert_int_equal(create_pivoted(&y.A), SL_ERR_UNSUPPORTED);
    free(terms);
    free(x);
    pair_free(&y);
    /* rows that are not in pairs: an odd number of them, and pairs that the order divides */
    for (sl_int n = 8; n <= 9; n++) {
        factored_t f = factored_make(GEN_PATH, n, 1, 0, NULL);
        assert_int_equal(create(f.S, &f.M.view, options_none()), SL_ERR_UNSUPPORTED);
        factored_free(&f);
    }
}

/* Neither is a matrix in which an entry of a block is not stored, unless it is the 0 beside a
 * diagonal entry, nor is a random one of real numbers. */
static void blocks_must_be_complete(void **state) {
    (void)state;
    pair_t y = pair_make(GEN_GRID2, 16, 0, SL_ISA_AUTO);
    const sl_int entries = y.A.p[y.n];
    sl_int *p = test_ints((size_t)y.n + 1), *i = test_ints((size_t)entries), refused = 0;
    double *x = test_reals((size_t)entries);
    sl_options opt = options_none();
    opt.block_size = 2;
    for (sl_int k = 0; k < entries; k++) {
        sl_int to = 0;
        for (sl_int j = 0; j < y.n; j++) {
            p[j] = to;
            for (sl_int q = y.A.p[j]; q < y.A.p[j + 1]; q++) {
                i[to] = y.A.i[q];
                x[to] = y.A.x[q];
                to += q != k;
            }
        }
        p[y.n] = to;
        const sl_csc A = {y.n, y.n, p, i, x};
        sl_symbolic *S = NULL;
        if (sl_symbolic_create(&S, &A, &opt, NULL) == SL_OK) {
            const sl_status status = create(S, &A, options_none());
            assert_true(status == SL_ERR_UNSUPPORTED || (status == SL_OK && y.A.x[k] == 0.0));
            refused += status != SL_OK;
        }
        sl_symbolic_free(S);
    }
    assert_true(refused > entries / 2);
    free(p);
    free(i);
    free(x);
    pair_free(&y);
    for (sl_int k = 0; k < 400; k++) {
        gen_list_t t = gen_make(GEN_RANDOM, 4 + k % 10, 1, (uint64_t)k);
        gen_matrix_t M = gen_store(&t, gen_style(0), 1);
        sl_symbolic *S;
        opt = options_none();
        opt.ordering = SL_ORDERING_NATURAL;
        opt.relaxation = SL_RELAXATION_NONE;
        SL_CHECK(sl_symbolic_create(&S, &M.view, &opt, NULL));
        assert_int_equal(create(S, &M.view, options_none()), SL_ERR_UNSUPPORTED);
        sl_symbolic_free(S);
        gen_matrix_free(&M);
        gen_list_free(&t);
    }
}

/* A block of which one column is empty, or has only the 0 beside its diagonal entry. */
static void a_column_without_a_diagonal_is_refused(void **state) {
    (void)state;
    static const struct {
        sl_int p[3], i[2];
    } blocks[] = {{{0, 0, 2}, {0, 1}}, {{0, 2, 2}, {0, 1}}, {{0, 1, 2}, {0, 0}}};
    sl_options opt = options_none();
    opt.block_size = 2;
    for (size_t k = 0; k < 2 * sizeof blocks / sizeof *blocks; k++) {
        const double x[2] = {2.0, k % 2 == 0 ? 0.0 : 2.0};
        const sl_csc A = {2, 2, blocks[k / 2].p, blocks[k / 2].i, x};
        sl_symbolic *S = NULL;
        SL_CHECK(sl_symbolic_create(&S, &A, &opt, NULL));
        assert_int_equal(sl_symbolic_view(S).n_supers, 1);
        assert_int_equal(create(S, &A, options_none()), SL_ERR_UNSUPPORTED);
        sl_symbolic_free(S);
    }
}

static void an_infinite_entry_is_refused(void **state) {
    (void)state;
    static const sl_int p[3] = {0, 2, 3}, i[3] = {0, 1, 1};
    static const double x[3] = {INFINITY, 0.0, INFINITY};
    const sl_csc A = {2, 2, p, i, x};
    sl_options opt = options_none();
    sl_symbolic *S = NULL;
    opt.block_size = 2;
    SL_CHECK(sl_symbolic_create(&S, &A, &opt, NULL));
    assert_int_equal(create(S, &A, options_none()), SL_ERR_NOT_FINITE);
    sl_symbolic_free(S);
}

static void failing_allocations(void **state) {
    (void)state;
    pair_t y = pair_make(GEN_GRID2, 49, 0, SL_ISA_AUTO);
    sl_status status = SL_ERR_MEMORY;
    for (int64_t k = 0; status != SL_OK; k++) {
        counter_t counter = counter_make();
        sl_options opt = options_counted(&counter);
        sl_factor *F = NULL;
        opt.storage = SL_STORAGE_COMPLEX;
        counter.fail_at = k;
        status = sl_factor_create(&F, y.S, &y.A, &opt, NULL);
        assert_true(status == SL_OK || status == SL_ERR_MEMORY);
        assert_true(k > 0 || status == SL_ERR_MEMORY);
        sl_factor_free(F);
        COUNTER_CLEAN(&counter);
    }
    pair_free(&y);
}

enum { FORWARD, REVERSED, HALVES, WAYS_TO_RESTRICT };

/* Restricted to two of three blocks, in two orders, and to halves of neighbors: where a block is
 * split, L is in double. */
static void check_restricted(const pair_t *y, sl_isa isa) {
    (void)isa;
    for (int way = 0; way < WAYS_TO_RESTRICT; way++) {
        sl_int *rows = test_ints((size_t)y->n), count = 0;
        for (sl_int k = 0; k < y->n; k++) {
            rows[count] = way == REVERSED ? y->n - 1 - k : k;
            count += way == HALVES ? k > 0 && k + 1 < y->n : rows[count] / 2 % 3 > 0;
        }
        const size_t n = (size_t)count, ld = n > 0 ? n : 1;
        double *b = test_reals(n), *x[2] = {test_reals(n), test_reals(n)}, most = 0.0;
        gen_reals(b, n, 3);
        for (int k = 0; k < 2; k++) {
            sl_symbolic *S = NULL;
            sl_factor *G = NULL;
            sl_stats stats;
            SL_CHECK(sl_factor_restrict(&S, &G, y->F[k], &y->A, rows, count, NULL, &stats));
            assert_true(k == 0 || stats.restriction.kept == 0);
            assert_int_equal(stats.storage, k == 1 && (way == FORWARD || n == 0)
                                                ? SL_STORAGE_COMPLEX
                                                : SL_STORAGE_DOUBLE);
            SL_CHECK(sl_factor_solve(G, x[k], ld, b, ld, 1, NULL));
            sl_factor_free(G);
            sl_symbolic_free(S);
        }
        for (size_t k = 0; k < n; k++) {
            most = fmax(most, fabs(x[0][k]));
        }
        for (size_t k = 0; k < n; k++) {
            assert_true(fabs(x[0][k] - x[1][k]) <= 1e-10 * most);
        }
        free(rows);
        free(b);
        free(x[0]);
        free(x[1]);
    }
}

static void restrictions_are_complex(void **state) {
    (void)state;
    for_each(check_restricted);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(l_is_a_factor_of_blocks),
        cmocka_unit_test(solves_are_exact_and_local),
        cmocka_unit_test(other_calls_agree),
        cmocka_unit_test(memory_is_halved),
        cmocka_unit_test(what_is_not_complex_is_refused),
        cmocka_unit_test(blocks_must_be_complete),
        cmocka_unit_test(a_column_without_a_diagonal_is_refused),
        cmocka_unit_test(an_infinite_entry_is_refused),
        cmocka_unit_test(restrictions_are_complex),
        cmocka_unit_test(failing_allocations),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

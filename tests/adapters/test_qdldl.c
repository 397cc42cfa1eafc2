/* test_qdldl.c: the names of QDLDL, by rows and by supernodes, against dense L D L' */
#include "tests/lib/dense_reference.h"
#include "tests/lib/gen_matrices.h"

/* Allocations of the adapter that fail. */
static int out_of_memory;
static void *allocate(size_t bytes) {
    return out_of_memory ? NULL : malloc(bytes);
}

#include "tools/adapters/sparse_local_qdldl.h"

static QDLDL_int largest_int = QDLDL_INT_MAX;
#undef QDLDL_INT_MAX
#define QDLDL_INT_MAX largest_int

static double long_columns; /* above: by supernodes */
#define SL_QDLDL_LONG_COLUMNS long_columns
#define malloc allocate
#define SPARSE_LOCAL_QDLDL_IMPLEMENTATION
#include "tools/adapters/sparse_local_qdldl.h"
#undef malloc

static const double by_rows = 1e30, by_supernodes = -1.0;

/* A with its upper triangle, the arrays of the calls, and dense M = L D L'. */
typedef struct system_t {
    QDLDL_int n, *Ap, *Ai, *work, *Lnz, *etree, *Lp, *Li, *iwork;
    QDLDL_float *Ax, *D, *Dinv, *Lx, *fwork;
    QDLDL_bool *bwork;
    double *M, *Lref, *Dref;
} system_t;

static QDLDL_int *ints(size_t count) {
    return (QDLDL_int *)test_array(count, sizeof(QDLDL_int));
}

static QDLDL_float *floats(size_t count) {
    return (QDLDL_float *)test_array(count, sizeof(QDLDL_float));
}

static system_t system_make(const sl_csc *A) {
    const size_t n = (size_t)A->n_rows, count = (size_t)A->p[n];
    system_t s;
    s.n = A->n_rows;
    s.Ap = ints(n + 1), s.Ai = ints(count), s.Ax = floats(count);
    s.work = ints(n), s.Lnz = ints(n), s.etree = ints(n);
    s.Lp = ints(n + 1), s.Li = NULL, s.Lx = NULL;
    s.D = floats(n), s.Dinv = floats(n);
    s.iwork = ints(3 * n), s.bwork = (QDLDL_bool *)test_array(n, 1), s.fwork = floats(n);
    memset(s.bwork, 7, n);
    for (size_t k = 0; k <= n; k++) {
        s.Ap[k] = A->p[k];
    }
    for (size_t k = 0; k < count; k++) {
        s.Ai[k] = A->i[k];
        s.Ax[k] = (QDLDL_float)A->x[k];
    }
    s.M = ref_dense(A);
    s.Lref = test_reals(n * n);
    s.Dref = test_reals(n);
    return s;
}

static void system_free(system_t *s) {
    void *blocks[] = {s->Ap,    s->Ai,    s->Ax, s->work, s->Lnz,  s->etree,
                      s->Lp,    s->Li,    s->Lx, s->D,    s->Dinv, s->iwork,
                      s->bwork, s->fwork, s->M,  s->Lref, s->Dref};
    for (size_t k = 0; k < sizeof blocks / sizeof *blocks; k++) {
        free(blocks[k]);
    }
}

static QDLDL_int system_tree(system_t *s) {
    const QDLDL_int count = QDLDL_etree(s->n, s->Ap, s->Ai, s->work, s->Lnz, s->etree);
    if (count >= 0) {
        free(s->Li);
        free(s->Lx);
        s->Li = ints((size_t)count);
        s->Lx = floats((size_t)count);
    }
    return count;
}

static QDLDL_int system_factor(system_t *s, double how) {
    long_columns = how;
    return QDLDL_factor(s->n, s->Ap, s->Ai, s->Ax, s->Lp, s->Li, s->Lx, s->D, s->Dinv, s->Lnz,
                        s->etree, s->bwork, s->iwork, s->fwork);
}

static const double epsilon = sizeof(QDLDL_float) == 4 ? FLT_EPSILON : DBL_EPSILON;

/* Tree and counts are those of the fill. */
static void tree_is_right(const system_t *s, const sl_csc *A, QDLDL_int count) {
    const sl_int n = A->n_rows;
    char *fill = ref_pattern(A);
    sl_int *parent = test_ints((size_t)n), *counts = test_ints((size_t)n);
    QDLDL_int sum = 0;
    ref_fill(n, fill);
    ref_etree(n, fill, parent);
    ref_counts(n, fill, counts);
    for (sl_int k = 0; k < n; k++) {
        assert_true(s->etree[k] == parent[k] && s->Lnz[k] == counts[k] - 1);
        sum += s->Lnz[k];
    }
    assert_true(sum == count);
    free(fill);
    free(parent);
    free(counts);
}

/* L has the pattern of the fill, ascending, and its values and D are those of the reference. */
static void factor_is_right(const system_t *s, double bound) {
    const sl_int n = (sl_int)s->n;
    for (sl_int j = 0; j < n; j++) {
        double worst = 0, largest = 1;
        assert_true(s->Lp[j + 1] - s->Lp[j] == s->Lnz[j]);
        for (QDLDL_int p = s->Lp[j]; p < s->Lp[j + 1]; p++) {
            const double wanted = AT(s->Lref, s->Li[p], j);
            assert_true(s->Li[p] > (p == s->Lp[j] ? j : s->Li[p - 1]) && s->Li[p] < n);
            worst = fmax(worst, fabs((double)s->Lx[p] - wanted));
            largest = fmax(largest, fabs(wanted));
            AT(s->Lref, s->Li[p], j) = 0; /* seen */
        }
        for (sl_int i = j + 1; i < n; i++) {
            assert_true(AT(s->Lref, i, j) == 0);
        }
        assert_true(worst <= bound * largest);
        assert_true(fabs((double)s->D[j] - s->Dref[j]) <= bound * fabs(s->Dref[j]));
        assert_true(fabs((double)s->D[j] * (double)s->Dinv[j] - 1) <= 2 * epsilon);
    }
}

/* max |M x - b| relative to |M| |x| + |b|, of x = M^-1 b by a whole solve and by its parts. */
static double solve_error(const system_t *s) {
    const sl_int n = (sl_int)s->n;
    QDLDL_float *x = floats((size_t)n), *y = floats((size_t)n);
    double worst = 0;
    for (sl_int k = 0; k < n; k++) {
        x[k] = y[k] = (QDLDL_float)(1 + k % 7);
    }
    QDLDL_solve(s->n, s->Lp, s->Li, s->Lx, s->Dinv, x);
    QDLDL_Lsolve(s->n, s->Lp, s->Li, s->Lx, y);
    for (sl_int k = 0; k < n; k++) {
        y[k] *= s->Dinv[k];
    }
    QDLDL_Ltsolve(s->n, s->Lp, s->Li, s->Lx, y);
    assert_memory_equal(x, y, (size_t)n * sizeof *x);
    for (sl_int i = 0; i < n; i++) {
        double r = -(1 + i % 7), scale = 1 + i % 7;
        for (sl_int j = 0; j < n; j++) {
            r += AT(s->M, i, j) * (double)x[j];
            scale += fabs(AT(s->M, i, j) * (double)x[j]);
        }
        worst = fmax(worst, fabs(r) / scale);
    }
    free(x);
    free(y);
    return worst;
}

static gen_matrix_t upper(gen_kind_t kind, sl_int size, uint64_t seed) {
    gen_list_t t = gen_make(kind, size, 1, seed);
    gen_matrix_t M = gen_store(&t, gen_style(1 + 3 * (int)(seed % 2)), seed);
    gen_list_free(&t);
    return M;
}

static void factors_are_right(void **state) {
    static const sl_int sizes[] = {1, 2, 9, 40};
    (void)state;
    for (int kind = 0; kind < GEN_REGULAR; kind++) {
        for (int k = 0; k < 4; k++) {
            gen_matrix_t M = upper((gen_kind_t)kind, sizes[k], (uint64_t)k);
            system_t s = system_make(&M.view);
            const QDLDL_int count = system_tree(&s);
            const double bound = 64 * epsilon * (double)(1 + s.n);
            assert_true(count >= 0);
            tree_is_right(&s, &M.view, count);
            for (int way = 0; way < 3; way++) { /* the last one: no memory, and the rows do it */
                QDLDL_int positive = 0;
                ref_ldl((sl_int)s.n, s.M, s.Lref, s.Dref);
                for (QDLDL_int j = 0; j < s.n; j++) {
                    positive += s.Dref[j] > 0;
                }
                out_of_memory = way == 2;
                assert_true(system_factor(&s, way == 0 ? by_rows : by_supernodes) == positive);
                out_of_memory = 0;
                /* values of the scaled kind span 24 digits: their solutions tell enough */
                if (kind != GEN_SCALED) {
                    factor_is_right(&s, bound);
                }
                assert_true(solve_error(&s) <= bound);
            }
            system_free(&s);
            gen_matrix_free(&M);
        }
    }
}

/* Columns of a dense matrix of 100 rows are long, those of a path are short. */
static void ways_are_chosen(void **state) {
    (void)state;
    for (int kind = 0; kind < 2; kind++) {
        gen_matrix_t M = upper(kind == 0 ? GEN_DENSE : GEN_PATH, 100, 1);
        system_t s = system_make(&M.view);
        QDLDL_float *rows;
        int same;
        const size_t count = (size_t)system_tree(&s);
        assert_true(system_factor(&s, by_rows) >= 0);
        rows = floats(count);
        memcpy(rows, s.Lx, count * sizeof *rows);
        assert_true(system_factor(&s, 50.0) >= 0);
        same = memcmp(rows, s.Lx, count * sizeof *rows) == 0;
        assert_true(same || kind == 0);
        free(rows);
        system_free(&s);
        gen_matrix_free(&M);
    }
}

static QDLDL_int factor_of(const sl_csc *A, double how, QDLDL_int *tree) {
    system_t s = system_make(A);
    QDLDL_int positive = 0;
    *tree = system_tree(&s);
    if (*tree >= 0) {
        positive = system_factor(&s, how);
    }
    system_free(&s);
    return positive;
}

static void wrong_matrices_are_refused(void **state) {
    static const sl_int p[] = {0, 1, 3}, below[] = {1, 0, 1}, both[] = {0, 0, 1};
    static const sl_int p_empty[] = {0, 1, 1}, p_late[] = {0, 0, 1};
    static const double ones[] = {1, 1, 1}, zeros[] = {0, 0, 0}, not_a_number[] = {1, NAN, 1};
    static const double below_float[] = {1, 1e-30, 0};
    const sl_csc is_below = {2, 2, p, below, ones}, empty = {2, 2, p_empty, both, ones};
    const sl_csc empty_first = {2, 2, p_late, both, ones};
    const sl_csc singular = {2, 2, p, both, ones}, null = {2, 2, p, both, zeros};
    const sl_csc nan_inside = {2, 2, p, both, not_a_number}, tiny = {2, 2, p, both, below_float};
    QDLDL_int tree;
    (void)state;
    (void)factor_of(&is_below, by_rows, &tree);
    assert_true(tree == -1);
    (void)factor_of(&empty, by_rows, &tree);
    assert_true(tree == -1);
    (void)factor_of(&empty_first, by_rows, &tree);
    assert_true(tree == -1);
    for (int way = 0; way < 2; way++) {
        const double how = way == 0 ? by_rows : by_supernodes;
        assert_true(factor_of(&singular, how, &tree) == -1 && tree == 1);
        assert_true(factor_of(&null, how, &tree) == -1 && tree == 1);
        assert_true(factor_of(&nan_inside, how, &tree) == 1 && tree == 1);
        assert_true(factor_of(&tiny, how, &tree) == (sizeof(QDLDL_float) == 4 ? -1 : 1));
    }
}

/* A diagonal entry that is not stored is 0, and a pivot all the same. */
static void diagonal_entries_may_be_missing(void **state) {
    static const sl_int p[] = {0, 1, 2, 5}, i[] = {0, 0, 0, 1, 2};
    static const double x[] = {4, 1, 2, 1, -3}, wanted[] = {17, -46, -8};
    const sl_csc A = {3, 3, p, i, x};
    (void)state;
    for (int way = 0; way < 2; way++) {
        system_t s = system_make(&A);
        QDLDL_float b[] = {6, 9, 12};
        assert_true(system_tree(&s) == 3);
        assert_true(system_factor(&s, way == 0 ? by_rows : by_supernodes) == 1);
        QDLDL_solve(3, s.Lp, s.Li, s.Lx, s.Dinv, b);
        for (int k = 0; k < 3; k++) {
            assert_true(fabs((double)b[k] - wanted[k]) <= 1e3 * epsilon);
        }
        system_free(&s);
    }
}

/* A random upper triangle whose entries are scaled by 1e200 or 1e-200: many pivots are no more than
 * rounding errors of far larger numbers. */
static sl_csc scaled_system(uint64_t *random, sl_int *p, sl_int *i, double *x) {
    const sl_int n = 2 + gen_below(random, 10);
    sl_int e = 0;
    for (sl_int j = 0; j < n; j++) {
        p[j] = e;
        for (sl_int row = 0; row <= j; row++) {
            if (row >= j - 1 || gen_below(random, 4) == 0) {
                const double scale = gen_below(random, 2) == 0 ? 1e200 : 1e-200;
                i[e] = row;
                x[e++] = scale * (row == j ? 4.0 + n : gen_real(random));
            }
        }
    }
    p[n] = e;
    const sl_csc A = {n, n, p, i, x};
    return A;
}

/* Where rounding decides about the sign of a pivot, both ways give that of the rows. */
static void scaled_systems_have_one_inertia(void **state) {
    (void)state;
    uint64_t random = 5;
    sl_int p[13], i[80], compared = 0;
    double x[80];
    for (int run = 0; run < 20000 && sizeof(QDLDL_float) == sizeof(double); run++) {
        const sl_csc A = scaled_system(&random, p, i, x);
        system_t s = system_make(&A);
        int finite = 1;
        (void)system_tree(&s);
        const QDLDL_int rows = system_factor(&s, by_rows);
        for (QDLDL_int k = 0; k < s.n; k++) {
            finite &= rows < 0 || isfinite(s.D[k]);
        }
        if (finite) {
            assert_true(system_factor(&s, by_supernodes) == rows);
            compared++;
        }
        system_free(&s);
    }
    assert_true(compared > 5000 || sizeof(QDLDL_float) != sizeof(double));
}

/* L of an arrow of 5 rows whose first row is full has 10 entries. */
static void counts_do_not_overflow(void **state) {
    static const sl_int p[] = {0, 1, 2, 3, 4, 5}, i[] = {0, 0, 0, 0, 0};
    static const double x[] = {1, 1, 1, 1, 1};
    const sl_csc A = {5, 5, p, i, x};
    const QDLDL_int limit = largest_int;
    QDLDL_int tree;
    (void)state;
    largest_int = 10;
    (void)factor_of(&A, by_rows, &tree);
    assert_true(tree == 10);
    largest_int = 9;
    (void)factor_of(&A, by_rows, &tree);
    assert_true(tree == -2);
    largest_int = limit;
}

/* The types of SCS, by its macros where it sets them. Its arrays go to the calls without a cast. */
#if defined(DLONG) || defined(QDLDL_LONG)
typedef long long scs_int;
#else
typedef int scs_int;
#endif
#if defined(SFLOAT) || defined(QDLDL_FLOAT)
typedef float scs_float;
#else
typedef double scs_float;
#endif

static void arrays_of_scs_are_taken(void **state) {
    const scs_int p[] = {0, 1, 3}, i[] = {0, 0, 1};
    const scs_float a[] = {2, 4, 3};
    scs_int work[2], counts[2], etree[2], Lp[3], Li[1], iwork[6];
    scs_float Lx[1], D[2], Dinv[2], fwork[2], x[] = {10, 11};
    QDLDL_bool bwork[2];
    (void)state;
    assert_true(QDLDL_etree(2, p, i, work, counts, etree) == 1);
    assert_true(QDLDL_factor(2, p, i, a, Lp, Li, Lx, D, Dinv, counts, etree, bwork, iwork,
                             fwork) == 1);
    QDLDL_solve(2, Lp, Li, Lx, Dinv, x);
    assert_true(fabs((double)x[0] - 1.4) <= 8 * epsilon);
    assert_true(fabs((double)x[1] - 1.8) <= 8 * epsilon);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(factors_are_right),
        cmocka_unit_test(ways_are_chosen),
        cmocka_unit_test(wrong_matrices_are_refused),
        cmocka_unit_test(diagonal_entries_may_be_missing),
        cmocka_unit_test(scaled_systems_have_one_inertia),
        cmocka_unit_test(counts_do_not_overflow),
        cmocka_unit_test(arrays_of_scs_are_taken),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

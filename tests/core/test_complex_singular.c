/* test_complex_singular.c: singular Hermitian systems: null vectors in both storages */
#include "tests/lib/test.h"

/* Grids that no entry joins, PARTS of them, with complex rows. */
enum { PARTS = 3, WIDE = 9, NODES = WIDE * WIDE, HALF = PARTS * NODES, N = 2 * HALF, LANES = 5 };

/* What is different from a connection Laplacian of trivial holonomy, to be combined. */
enum { IS_REAL = 1, HAS_MASS = 2, IS_UNEVEN = 4, IS_REGULAR = 8, KINDS = 16 };

typedef struct singular {
    int p[HALF + 1], i[3 * HALF];
    double x[6 * HALF], z[2 * N], mass[N], b[N * LANES];
    sl_matrix *M;
    sl_csc A;
    sl_symbolic *S;
    sl_factor *F[2]; /* L in double and as complex */
} singular;

/* Sets row k of the null vector z, and of i z, to size e^(i angle). */
static void null_set(singular *y, sl_int k, double size, double angle) {
    y->z[2 * k] = y->z[N + 2 * k + 1] = size * cos(angle);
    y->z[2 * k + 1] = size * sin(angle);
    y->z[N + 2 * k] = -size * sin(angle);
}

/* H with H z = 0: weights w between nodes, turned by the angles of z. */
static void singular_fill(singular *y, int kind) {
    double size[HALF], angle[HALF], diagonal[HALF];
    uint64_t random = 7;
    sl_int e = 0;
    for (sl_int k = 0; k < HALF; k++) {
        random = random * 6364136223846793005u + 1442695040888963407u;
        size[k] = kind & IS_UNEVEN ? 0.05 + (double)(random >> 40) / (1 << 24) : 1.0;
        angle[k] = kind & IS_REAL ? 0.0 : (double)(random >> 33);
        diagonal[k] = kind & IS_REGULAR && k == HALF - 5 ? 1.0 : 0.0;
        null_set(y, k, size[k], angle[k]);
        y->mass[2 * k] = y->mass[2 * k + 1] = 1.0 + k % 3;
    }
    for (sl_int j = 0; j < HALF; j++) {
        const sl_int at = y->p[j] = e, u = j % WIDE, v = j % NODES / WIDE;
        y->i[e++] = j;
        for (int k = 0; k < 2; k++) {
            const sl_int row = k == 0 ? j + 1 : j + WIDE;
            if (k == 0 ? u + 1 < WIDE : v + 1 < WIDE) {
                const double w = 1.0 + 0.5 * sin(3.0 * e);
                y->i[e] = row;
                y->x[2 * e] = -w * cos(angle[row] - angle[j]);
                y->x[2 * e + 1] = -w * sin(angle[row] - angle[j]);
                diagonal[row] += w * size[j] / size[row];
                diagonal[j] += w * size[row] / size[j];
                e++;
            }
        }
        y->x[2 * at] = diagonal[j]; /* all its neighbors have been seen */
        y->x[2 * at + 1] = 0.0;
    }
    y->p[HALF] = e;
}

/* Right-hand sides that are consistent, but for the last one. */
static void right_sides(singular *y) {
    for (sl_int k = 0; k < N * LANES; k++) {
        y->b[k] = sin(1.0 + k);
    }
    for (sl_int part = 0; part < (LANES - 1) * PARTS; part++) {
        double *b = y->b + part / PARTS * N;
        const sl_int first = part % PARTS * 2 * NODES, end = first + 2 * NODES;
        for (int c = 0; c < 2; c++) {
            const double *z = y->z + c * N;
            double dot = 0.0, square = 0.0;
            for (sl_int k = first; k < end; k++) {
                dot += z[k] * b[k];
                square += z[k] * z[k];
            }
            for (sl_int k = first; k < end; k++) {
                b[k] -= dot / square * z[k];
            }
        }
    }
}

static sl_options singular_options(const singular *y, int kind, sl_isa isa, sl_storage storage) {
    sl_options opt = options_none();
    opt.isa = isa;
    opt.storage = storage;
    opt.method = SL_METHOD_SUPERNODAL;
    opt.pivots = SL_PIVOTS_SKIP_NULL;
    opt.null_vector = y->z;
    opt.null_vector_count = 2;
    opt.mass = kind & HAS_MASS ? y->mass : NULL;
    return opt;
}

static void singular_make(singular *y, int kind, sl_isa isa) {
    sl_options opt = options_none();
    memset(y, 0, sizeof *y);
    singular_fill(y, kind);
    right_sides(y);
    const sl_hermitian H = {HALF, y->p, y->i, y->x, NULL};
    SL_CHECK(sl_matrix_from_hermitian(&y->M, &H, NULL, NULL));
    y->A = sl_matrix_view(y->M);
    opt.block_size = 2;
    SL_CHECK(sl_symbolic_create(&y->S, &y->A, &opt, NULL));
    for (int m = 0; m < 2; m++) {
        opt = singular_options(y, kind, isa, m == 0 ? SL_STORAGE_DOUBLE : SL_STORAGE_COMPLEX);
        SL_CHECK(sl_factor_create(&y->F[m], y->S, &y->A, &opt, NULL));
    }
}

static void singular_free(singular *y) {
    sl_factor_free(y->F[0]);
    sl_factor_free(y->F[1]);
    sl_symbolic_free(y->S);
    sl_matrix_free(y->M);
}

static void assert_near(const double *x, const double *y, sl_int count, double tolerance) {
    double most = 0.0, error = 0.0;
    for (sl_int k = 0; k < count; k++) {
        most = fmax(most, fabs(y[k]));
        error = fmax(error, fabs(x[k] - y[k]));
    }
    assert_true(most > 0.0 && error <= tolerance * most);
}

/* The same null rows, two for each component, and they are one complex row. */
static void check_null_rows(const singular *y, int kind) {
    sl_int rows[2][2 * PARTS], count[2];
    for (int m = 0; m < 2; m++) {
        SL_CHECK(sl_factor_pivot_rows(y->F[m], SL_PIVOT_NULL, rows[m], NULL, 2 * PARTS, &count[m]));
        assert_int_equal(count[m], kind & IS_REGULAR ? 2 * PARTS - 2 : 2 * PARTS);
        assert_int_equal(sl_factor_view(y->F[m]).info.regular, !(kind & IS_REGULAR) ? 0
                                                               : kind & IS_REAL     ? 2
                                                                                    : 1);
    }
    for (sl_int k = 0; k < count[1]; k += 2) {
        assert_int_equal(rows[1][k] / 2, rows[1][k + 1] / 2);
        assert_int_equal(rows[1][k], rows[0][k]);
    }
}

/* Solutions: of A x = b, with weighted means of 0 where there are weights; others are refused. */
static void check_solutions(const singular *y, int kind) {
    double x[2][N * LANES], r[N], backward;
    const sl_int nrhs = kind & HAS_MASS ? LANES : LANES - 1;
    for (int m = 0; m < 2; m++) {
        SL_CHECK(sl_factor_solve(y->F[m], x[m], N, y->b, N, nrhs, NULL));
        if (!(kind & HAS_MASS)) {
            SL_EXPECT(SL_ERR_INCONSISTENT,
                      sl_factor_solve(y->F[m], r, N, y->b + (LANES - 1) * N, N, 1, NULL));
        }
    }
    assert_near(x[1], x[0], N * nrhs, 1e-10);
    SL_CHECK(sl_csc_residual(&y->A, r, N, &backward, x[1], N, y->b, N, 1));
    assert_true(backward <= 64.0 * DBL_EPSILON);
    for (int c = 0; c < 2 && kind & HAS_MASS; c++) {
        double mean = 0.0, size = 0.0;
        for (sl_int k = 0; k < 2 * NODES; k++) {
            const double term = y->z[c * N + k] * y->mass[k] * x[1][(LANES - 1) * N + k];
            mean += term;
            size += fabs(term);
        }
        assert_true(fabs(mean) <= 1e-12 * size);
    }
}

/* Other calls on both factors. */
static void check_calls(const singular *y) {
    enum { ROWS = 6, ALL = 3 * N };
    const sl_int rows[ROWS] = {4, 5, 100, 101, 230, 401};
    static double out[2][ALL];
    sl_int component[N];
    double Q[2 * N], K[2 * N], b[ROWS] = {1.0, 0.0, 0.0, 0.0, 0.0, 0.0};
    memset(out, 0, sizeof out);
    for (int m = 0; m < 2; m++) {
        double *at = out[m];
        sl_pseudo_inverse P = {2, component, Q, K, 0.0};
        SL_CHECK(sl_factor_logdet(y->F[m], at, at + 1));
        SL_CHECK(sl_inverse_diagonal(y->F[m], at + 2, rows, ROWS, NULL, NULL));
        SL_CHECK(sl_factor_pseudo_inverse(y->F[m], &P, NULL));
        at[10] = P.log_det;
        for (sl_int k = 0; k < N; k++) { /* the diagonal of A^+ less that of G */
            at[20 + k] = Q[k] * K[k] + Q[N + k] * K[N + k];
        }
        SL_CHECK(sl_factor_defects(y->F[m], at + 30 + N, 2 * PARTS, y->b, N, 1, NULL));
        SL_CHECK(
            sl_factor_defects(y->F[m], at + 40 + N, 2 * PARTS, y->b + (LANES - 1) * N, N, 1, NULL));
        const sl_status s = sl_local_solve(y->F[m], rows, ROWS, rows, ROWS, at + 60 + N, ROWS, b,
                                           ROWS, 1, NULL, NULL);
        assert_true(s == SL_OK || s == SL_ERR_INCONSISTENT);
        at[80 + N] = s;
    }
    assert_near(out[1], out[0], 100 + N, 1e-10);
}

/* In both storages the same answers, by each instruction set. */
static void singular_systems_in_both_storages(void **state) {
    (void)state;
    const isa_list_t isas = isas_present();
    for (int kind = 0; kind < KINDS; kind++) {
        for (int k = 0; k < isas.count; k++) {
            singular y;
            singular_make(&y, kind, isas.isa[k]);
            check_null_rows(&y, kind);
            check_solutions(&y, kind);
            check_calls(&y);
            SL_CHECK(sl_factor_refactor(y.F[1], &y.A, NULL));
            check_solutions(&y, kind);
            singular_free(&y);
        }
    }
}

/* A null vector z without i z, or with another vector: only one of two rows would be null. */
static void null_vectors_come_in_pairs(void **state) {
    (void)state;
    singular y;
    sl_factor *F = NULL;
    sl_stats stats;
    singular_make(&y, 0, SL_ISA_AUTO);
    sl_options opt = singular_options(&y, 0, SL_ISA_AUTO, SL_STORAGE_COMPLEX);
    opt.null_vector_count = 1;
    SL_EXPECT(SL_ERR_UNSUPPORTED, sl_factor_create(&F, y.S, &y.A, &opt, &stats));
    assert_non_null(strstr(stats.error.what, "2 null vectors"));
    opt.null_vector_count = 2;
    for (sl_int k = 0; k < N; k++) {
        y.z[N + k] = 1.0 + k % 7;
    }
    const isa_list_t isas = isas_with_storages();
    for (int k = 0; k < isas.count; k++) {
        opt.isa = isas.isa[k];
        SL_EXPECT(SL_ERR_PIVOT, sl_factor_create(&F, y.S, &y.A, &opt, &stats));
        assert_true(stats.error.row >= 0);
        assert_non_null(strstr(stats.error.what, "options.null_vector"));
    }
    singular_free(&y);
}

/* As above, with a vector that is real where the order ends: the first row would be null. */
static void null_rows_come_in_pairs(void **state) {
    (void)state;
    singular y;
    sl_factor *F = NULL;
    sl_stats stats;
    singular_make(&y, 0, SL_ISA_AUTO);
    const sl_int *at = sl_symbolic_view(y.S).iperm;
    for (sl_int part = 0; part < PARTS; part++) {
        sl_int end = part * NODES;
        for (sl_int k = part * NODES; k < (part + 1) * NODES; k++) {
            end = at[2 * k] > at[2 * end] ? k : end;
        }
        const double a = y.z[2 * end], b = y.z[2 * end + 1];
        for (sl_int k = part * NODES; k < (part + 1) * NODES; k++) {
            const double u = y.z[2 * k], v = y.z[2 * k + 1];
            y.z[2 * k] = a * u + b * v;
            y.z[2 * k + 1] = a * v - b * u;
            y.z[N + 2 * k] = 1.0 + k % 7;
            y.z[N + 2 * k + 1] = 1.0 + k % 5;
        }
    }
    const isa_list_t isas = isas_with_storages();
    for (int k = 0; k < isas.count; k++) {
        const sl_options opt = singular_options(&y, 0, isas.isa[k], SL_STORAGE_COMPLEX);
        SL_EXPECT(SL_ERR_PIVOT, sl_factor_create(&F, y.S, &y.A, &opt, &stats));
        assert_non_null(strstr(stats.error.what, "options.null_vector"));
    }
    singular_free(&y);
}

/* A path of vectors of two rows, which the edges turn: 4 null vectors, real or complex ones. */
static void several_null_vectors_in_both_storages(void **state) {
    (void)state;
    enum { LENGTH = 12, ROWS = 2 * LENGTH, REAL = 2 * ROWS };
    for (int is_complex = 0; is_complex < 2; is_complex++) {
        sl_int p[ROWS + 1], e = 0;
        sl_int i[4 * ROWS];
        double x[8 * ROWS], z[4][REAL] = {{0.0}}, b[REAL], y[2][REAL], r[REAL], backward;
        for (sl_int k = 0; k < LENGTH; k++) { /* columns of rotations, times a phase */
            for (int c = 0; c < 2; c++) {
                for (int row = 0; row < 2; row++) {
                    const double size = c == row ? cos(2.0 * k) : c ? -sin(2.0 * k) : sin(2.0 * k);
                    const double phase = is_complex ? 0.7 * k : 0.0;
                    double *u = z[2 * c] + 4 * k + 2 * row, *v = z[2 * c + 1] + 4 * k + 2 * row;
                    u[0] = v[1] = size * cos(phase);
                    u[1] = size * sin(phase);
                    v[0] = -u[1];
                }
            }
        }
        for (sl_int j = 0; j < ROWS; j++) {
            const sl_int node = j / 2;
            p[j] = e;
            for (sl_int row = j; row < ROWS && row < 2 * node + 4; row++) {
                double sum[2] = {0.0, 0.0};
                for (int c = 0; c < 2 && row / 2 > node; c++) { /* z_row z_j' */
                    const double *u = z[2 * c] + 2 * row, *v = z[2 * c] + 2 * j;
                    sum[0] -= u[0] * v[0] + u[1] * v[1];
                    sum[1] -= u[1] * v[0] - u[0] * v[1];
                }
                i[e] = row;
                x[2 * e] = row == j ? (node > 0) + (node + 1 < LENGTH) : sum[0];
                x[2 * e + 1] = sum[1];
                e++;
            }
        }
        p[ROWS] = e;
        const sl_hermitian H = {ROWS, p, i, x, NULL};
        sl_matrix *M = NULL;
        sl_symbolic *S = NULL;
        sl_options opt = options_none();
        SL_CHECK(sl_matrix_from_hermitian(&M, &H, NULL, NULL));
        const sl_csc A = sl_matrix_view(M);
        opt.block_size = 2;
        SL_CHECK(sl_symbolic_create(&S, &A, &opt, NULL));
        for (sl_int k = 0; k < REAL; k++) {
            r[k] = sin(1.0 + k);
        }
        SL_CHECK(sl_csc_multiply(&A, SL_AS_SYMMETRIC, b, REAL, r, REAL, 1));
        for (int m = 0; m < 2; m++) {
            sl_factor *F = NULL;
            opt = options_none();
            opt.storage = m == 0 ? SL_STORAGE_DOUBLE : SL_STORAGE_COMPLEX;
            opt.pivots = SL_PIVOTS_SKIP_NULL;
            opt.null_vector = z[0];
            opt.null_vector_count = 4;
            SL_CHECK(sl_factor_create(&F, S, &A, &opt, NULL));
            assert_int_equal(sl_factor_view(F).info.null, 4);
            SL_CHECK(sl_factor_solve(F, y[m], REAL, b, REAL, 1, NULL));
            SL_CHECK(sl_csc_residual(&A, r, REAL, &backward, y[m], REAL, b, REAL, 1));
            assert_true(backward <= 64.0 * DBL_EPSILON);
            sl_factor_free(F);
        }
        assert_near(y[1], y[0], REAL, 1e-12);
        sl_symbolic_free(S);
        sl_matrix_free(M);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(singular_systems_in_both_storages),
        cmocka_unit_test(null_vectors_come_in_pairs),
        cmocka_unit_test(null_rows_come_in_pairs),
        cmocka_unit_test(several_null_vectors_in_both_storages),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

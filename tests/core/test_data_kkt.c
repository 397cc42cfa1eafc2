/* test_data_kkt.c: KKT systems of $SL_DATA: signs that are right change nothing, regularization and refinement solve what is not quasi-definite */
#include "data.h"

#include "../tools/matrix_file.h"

/* Quasi-definite as they stand: the rows of -1 or -1e-8 on the diagonal are constraints that an interior-point method
 * has regularized by itself. */
typedef struct known_t {
    const char *name;
    double own; /* negative entries of the diagonal up to this size are its regularization */
} known_t;

static const known_t known[] = {
    {"hs21_3x3_K_0.mtx", 1.0},        {"primalc1_3x3_K_0.mtx.gz", 1.0},
    {"cvxqp1_m_3x3_K_0.mtx.gz", 1.0}, {"cvxqp1_m_3x3_K_10.mtx.gz", 1e-6},
    {"stcqp1_2x2_K_0.mtx.gz", 0.0},
};

/* A lower triangle with values of its own, and the sign that each row's pivot should have: that of the diagonal, -1 for
 * 0. */
typedef struct subject_t {
    sl_matrix *M;
    sl_csc A;
    double *x;
    sl_int *signs;
    sl_symbolic *S;
} subject_t;

static subject_t subject_or_fail(const char *path) {
    subject_t y;
    char message[300];
    memset(&y, 0, sizeof y);
    if (!matrix_file_read(&y.M, path, message, sizeof message)) {
        print_error("%s\n", message);
        fail();
    }
    y.A = sl_matrix_view(y.M);
    y.x = test_reals((size_t)y.A.p[y.A.n_cols]);
    memcpy(y.x, y.A.x, (size_t)y.A.p[y.A.n_cols] * sizeof *y.x);
    y.A.x = y.x;
    y.signs = test_ints((size_t)y.A.n_cols);
    for (sl_int j = 0; j < y.A.n_cols; j++) {
        y.signs[j] = -1;
        for (sl_int p = y.A.p[j]; p < y.A.p[j + 1]; p++) {
            y.signs[j] = y.A.i[p] == j && y.x[p] > 0.0 ? 1 : y.signs[j];
        }
    }
    SL_CHECK(sl_symbolic_create(&y.S, &y.A, NULL, NULL));
    return y;
}

/* Solves with a factor of the matrix, its diagonal moved by shift in the direction of the signs, and refines; tells the
 * errors before and after. */
static sl_stats solve(const subject_t *y, sl_isa isa, double shift, double *plain) {
    size_t n = (size_t)y->A.n_cols;
    double *b = test_reals(n), *x = test_reals(n), *values = test_reals((size_t)y->A.p[n]);
    sl_csc moved = y->A;
    sl_options opt = options_none();
    sl_factor *F = NULL;
    sl_stats stats;
    memset(&stats, 0, sizeof stats);
    opt.isa = isa;
    opt.regularization = 1e-8;
    opt.signs = y->signs;
    moved.x = values;
    for (sl_int j = 0; j < y->A.n_cols; j++) {
        for (sl_int p = y->A.p[j]; p < y->A.p[j + 1]; p++) {
            values[p] = y->x[p] + (y->A.i[p] == j ? shift * y->signs[j] : 0.0);
        }
    }
    gen_reals(b, n, 4);
    SL_CHECK(sl_factor_create(&F, y->S, &moved, &opt, &stats));
    SL_CHECK(sl_factor_solve(F, x, n, b, n, 1, NULL));
    SL_CHECK(sl_factor_refine(F, &y->A, x, n, b, n, 1, 0, NULL, &stats));
    *plain = stats.backward_error;
    SL_CHECK(sl_factor_refine(F, &y->A, x, n, b, n, 1, 30, NULL, &stats));
    assert_true(stats.backward_error <= *plain);
    sl_factor_free(F);
    free(b);
    free(x);
    free(values);
    return stats;
}

/* The same bits as without regularization. */
static void assert_unchanged(const subject_t *y, sl_isa isa) {
    sl_options opt = options_none();
    sl_factor *F = NULL, *G = NULL;
    opt.isa = isa;
    SL_CHECK(sl_factor_create(&F, y->S, &y->A, &opt, NULL));
    opt.regularization = 1e-8;
    opt.signs = y->signs;
    SL_CHECK(sl_factor_create(&G, y->S, &y->A, &opt, NULL));
    assert_same_bits(F, G);
    sl_factor_free(F);
    sl_factor_free(G);
}

static void kkt_systems(void **state) {
    (void)state;
    dataset d = data_or_skip("matrices");
    isa_list_t isas = isas_present();
    for (size_t k = 0; k < sizeof known / sizeof known[0]; k++) {
        const char *path = data_find(&d, known[k].name);
        if (!path) {
            continue;
        }
        subject_t y = subject_or_fail(path);
        /* as it is; every diagonal entry moved, to be undone; without its own regularization */
        for (int which = 0; which < 3; which++) {
            static const char *const names[3] = {"as it is", "moved", "C = 0"};
            double plain = 0.0, most = 0.0, worst = 0.0;
            sl_stats stats;
            for (sl_int j = 0; which == 2 && j < y.A.n_cols; j++) {
                for (sl_int p = y.A.p[j]; p < y.A.p[j + 1]; p++) {
                    int is_own = y.A.i[p] == j && y.x[p] < 0.0 && -y.x[p] <= known[k].own;
                    y.x[p] = is_own ? 0.0 : y.x[p];
                }
            }
            memset(&stats, 0, sizeof stats);
            for (int i = 0; i < isas.count; i++) {
                stats = solve(&y, isas.isa[i], which == 1 ? 1e-8 : 0.0, &plain);
                most = fmax(most, plain);
                worst = fmax(worst, stats.backward_error);
                if (which == 0) {
                    assert_int_equal(stats.regularized, 0);
                    assert_unchanged(&y, isas.isa[i]);
                }
            }
            print_message(
                "%-24s %-8s %2d of %5d pivots changed, error %7.1e, after %d steps %3.1f eps\n",
                known[k].name, names[which], (int)stats.regularized, (int)y.A.n_cols, most,
                (int)stats.refine_steps, worst / DBL_EPSILON);
            assert_true(worst <= 4.0 * DBL_EPSILON);
        }
        sl_symbolic_free(y.S);
        sl_matrix_free(y.M);
        free(y.x);
        free(y.signs);
    }
    dataset_free(&d);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(kkt_systems),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

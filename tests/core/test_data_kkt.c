/* test_data_kkt.c: KKT systems of $SL_DATA: signs, regularization and refinement */
#include "tests/lib/real_data.h"

#include "tools/io/matrix_file.h"

/* Quasi-definite matrices. The rows with -1 or -1e-8 on the diagonal are constraints that an
 * interior-point method has regularized. */
typedef struct kkt_file_t {
    const char *name;
    double own_shift; /* negative diagonal entries up to this size are that regularization */
} kkt_file_t;

static const kkt_file_t known[] = {
    {"hs21_3x3_K_0.mtx", 1.0},        {"primalc1_3x3_K_0.mtx.gz", 1.0},
    {"cvxqp1_m_3x3_K_0.mtx.gz", 1.0}, {"cvxqp1_m_3x3_K_10.mtx.gz", 1e-6},
    {"stcqp1_2x2_K_0.mtx.gz", 0.0},
};

/* A lower triangle whose values can be changed, and the sign of each row's pivot: that of the
 * diagonal, -1 for 0. */
typedef struct system_t {
    sl_matrix *M;
    sl_csc A;
    double *x;
    sl_int *signs;
    sl_symbolic *S;
} system_t;

static system_t system_or_fail(const char *path) {
    system_t y;
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

/* Factors the matrix with its diagonal moved by shift in the direction of the signs, solves and
 * refines. *plain: the backward error before refinement; the stats have the one after it. */
static sl_stats solve(const system_t *y, sl_isa isa, double shift, double *plain) {
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
    *plain = stats.refine.backward_error;
    SL_CHECK(sl_factor_refine(F, &y->A, x, n, b, n, 1, 30, NULL, &stats));
    assert_true(stats.refine.backward_error <= *plain);
    sl_factor_free(F);
    free(b);
    free(x);
    free(values);
    return stats;
}

/* The factor has the same bits as without regularization. */
static void assert_unchanged(const system_t *y, sl_isa isa) {
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

static void refinement_solves_kkt_systems(void **state) {
    (void)state;
    dataset d = data_or_skip("matrices");
    isa_list_t isas = isas_present();
    for (size_t k = 0; k < sizeof known / sizeof known[0]; k++) {
        const char *path = data_find(&d, known[k].name);
        if (!path) {
            continue;
        }
        system_t y = system_or_fail(path);
        /* unchanged; with every diagonal entry moved; without its own regularization */
        for (int which = 0; which < 3; which++) {
            static const char *const names[3] = {"unchanged", "moved", "C = 0"};
            double plain = 0.0, most = 0.0, worst = 0.0;
            sl_stats stats;
            for (sl_int j = 0; which == 2 && j < y.A.n_cols; j++) {
                for (sl_int p = y.A.p[j]; p < y.A.p[j + 1]; p++) {
                    int is_own = y.A.i[p] == j && y.x[p] < 0.0 && -y.x[p] <= known[k].own_shift;
                    y.x[p] = is_own ? 0.0 : y.x[p];
                }
            }
            memset(&stats, 0, sizeof stats);
            for (int i = 0; i < isas.count; i++) {
                stats = solve(&y, isas.isa[i], which == 1 ? 1e-8 : 0.0, &plain);
                most = fmax(most, plain);
                worst = fmax(worst, stats.refine.backward_error);
                if (which == 0) {
                    assert_int_equal(stats.factor.regularized, 0);
                    assert_unchanged(&y, isas.isa[i]);
                }
            }
            print_message(
                "%-24s %-9s %2d of %5d pivots changed, error %7.1e, after %d steps %3.1f eps\n",
                known[k].name, names[which], (int)stats.factor.regularized, (int)y.A.n_cols, most,
                (int)stats.refine.steps, worst / DBL_EPSILON);
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
        cmocka_unit_test(refinement_solves_kkt_systems),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

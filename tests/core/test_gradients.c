/* test_gradients.c: derivatives of local answers and of log det A, against exact differences */
#include "tests/lib/exact_solve.h"
#include "tests/lib/factored.h"

enum { N = 144, NB = 3, NX = 4, NE = 5, NRHS = 3 };

typedef struct fixture_t {
    factored_t y;
    sl_int bset[N], xset[N];
    sl_int entry[NE], row[NE], column[NE]; /* entries of A, diagonal ones among them */
    double B[NB * NRHS], weights[NX * NRHS];
} fixture_t;

static fixture_t *fixture_make(const sl_options *opt) {
    fixture_t *f = (fixture_t *)test_array(1, sizeof *f);
    f->y = factored_make(GEN_GRID2, N, 1, 0, opt);
    gen_set(f->bset, NB, N, 1);
    gen_set(f->xset, NX, N, 2);
    gen_reals(f->B, NB * NRHS, 3);
    gen_reals(f->weights, NX * NRHS, 4);
    for (sl_int e = 0; e < NE; e++) {
        const sl_csc *A = &f->y.M.view;
        sl_int j = 0;
        f->entry[e] = (A->p[N] - 1) * (e + 1) / (NE + 1);
        while (A->p[j + 1] <= f->entry[e]) {
            j++;
        }
        f->entry[e] = e % 2 == 0 ? f->entry[e] : A->p[j];
        f->row[e] = A->i[f->entry[e]];
        f->column[e] = j;
    }
    return f;
}

static void fixture_free(fixture_t *f) {
    factored_free(&f->y);
    free(f);
}

/* The sum of weights x for right-hand side r, exactly: B changes by b_step in row b, and A by
 * a_step in entry e. */
static twice_t answer(const fixture_t *f, sl_int r, sl_int b, double b_step, sl_int e,
                      double a_step) {
    sl_csc A = f->y.M.view;
    double *right = test_reals(N), *values = test_reals((size_t)A.p[N]);
    twice_t *x = (twice_t *)test_array(N, sizeof *x), sum = {0.0, 0.0};
    memcpy(values, A.x, (size_t)A.p[N] * sizeof *values);
    values[f->entry[e]] += a_step;
    A.x = values;
    for (sl_int k = 0; k < NB; k++) {
        right[f->bset[k]] += f->B[k + NB * r] + (k == b ? b_step : 0.0);
    }
    exact_solve(f->y.F, &A, right, NULL, x);
    for (sl_int k = 0; k < NX; k++) {
        sum = twice_subtract_product(sum, -f->weights[k + NX * r], x[f->xset[k]]);
    }
    free(right);
    free(values);
    free(x);
    return sum;
}

static double difference(twice_t a, twice_t b, double step) {
    return ((a.high - b.high) + (a.low - b.low)) / (2.0 * step);
}

static void assert_derivative(double got, double wanted, double *worst) {
    const double error = fabs(got - wanted) / (fabs(wanted) + 1e-9);
    *worst = fmax(*worst, error);
    assert_true(error < 1e-6);
}

/* dl/db = lambda and dl/da_ij = -(lambda_i x_j + lambda_j x_i), lambda = A^-1 dl/dx: two local
 * solves for all right-hand sides, on the rows that the entries have. */
static void two_local_solves_give_the_derivatives(void **state) {
    (void)state;
    variant_list_t variants = variants_present();
    double worst = 0.0;
    for (int k = 0; k < variants.count; k++) {
        sl_options opt = options_none();
        options_set_variant(&opt, &variants, k);
        fixture_t *f = fixture_make(&opt);
        sl_int ends[2 * NE + NB];
        double x[2 * NE * NRHS], lambda[(2 * NE + NB) * NRHS];
        sl_plan *P = NULL, *adjoint = NULL;
        for (sl_int e = 0; e < NE; e++) {
            ends[2 * e] = f->row[e];
            ends[2 * e + 1] = f->column[e];
        }
        memcpy(ends + 2 * NE, f->bset, NB * sizeof *ends);
        SL_CHECK(sl_plan_create(&P, f->y.S, f->bset, NB, ends, 2 * NE, NULL, NULL));
        SL_CHECK(sl_plan_create(&adjoint, f->y.S, f->xset, NX, ends, 2 * NE + NB, NULL, NULL));
        SL_CHECK(sl_plan_solve(P, f->y.F, x, 2 * NE, f->B, NB, NRHS, NULL));
        SL_CHECK(sl_plan_solve(adjoint, f->y.F, lambda, 2 * NE + NB, f->weights, NX, NRHS, NULL));
        for (sl_int r = 0; r < NRHS; r++) {
            const double *l = lambda + (2 * NE + NB) * r, *at = x + 2 * NE * r, step = 1e-7;
            for (sl_int e = 0; e < NE; e++) {
                const double both = l[2 * e] * at[2 * e + 1] + l[2 * e + 1] * at[2 * e];
                const double got = f->row[e] == f->column[e] ? -both / 2.0 : -both;
                assert_derivative(got,
                                  difference(answer(f, r, -1, 0.0, e, step),
                                             answer(f, r, -1, 0.0, e, -step), step),
                                  &worst);
            }
            for (sl_int b = 0; b < NB; b++) {
                assert_derivative(
                    l[2 * NE + b],
                    difference(answer(f, r, b, step, 0, 0.0), answer(f, r, b, -step, 0, 0.0), step),
                    &worst);
            }
        }
        sl_plan_free(P);
        sl_plan_free(adjoint);
        fixture_free(f);
    }
    print_message("derivatives of answers: largest relative error %.1e\n", worst);
}

/* log det A by a dense factorization in long double. */
static long double dense_logdet(const sl_csc *A, sl_int entry, double step) {
    long double *M = (long double *)test_array(N * N, sizeof *M), sum = 0.0L;
    for (sl_int j = 0; j < N; j++) {
        for (sl_int q = A->p[j]; q < A->p[j + 1]; q++) {
            M[A->i[q] + N * j] += (long double)A->x[q] + (q == entry ? (long double)step : 0.0L);
        }
    }
    for (sl_int j = 0; j < N; j++) {
        const long double d = M[j + N * j];
        sum += logl(d);
        for (sl_int k = j + 1; k < N; k++) {
            const long double l = M[k + N * j] / d;
            for (sl_int i = k; i < N && l != 0.0L; i++) {
                M[i + N * k] -= l * M[i + N * j];
            }
        }
    }
    free(M);
    return sum;
}

/* d log det A / da_ij = 2 (A^-1)_ij, or (A^-1)_ii on the diagonal. */
static void entries_of_the_inverse_give_that_of_logdet(void **state) {
    (void)state;
    fixture_t *f = fixture_make(NULL);
    double got[NE], worst = 0.0;
    const double step = 1e-4;
    SL_CHECK(sl_inverse_pairs(f->y.F, got, f->row, f->column, NE, NULL, NULL));
    for (sl_int e = 0; e < NE; e++) {
        const long double up = dense_logdet(&f->y.M.view, f->entry[e], step);
        const long double down = dense_logdet(&f->y.M.view, f->entry[e], -step);
        assert_derivative(f->row[e] == f->column[e] ? got[e] : 2.0 * got[e],
                          (double)((up - down) / (2.0L * (long double)step)), &worst);
    }
    print_message("derivatives of log det: largest relative error %.1e\n", worst);
    fixture_free(f);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(two_local_solves_give_the_derivatives),
        cmocka_unit_test(entries_of_the_inverse_give_that_of_logdet),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

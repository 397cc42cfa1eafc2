/* test_constraints_rigid.c: pins on elastic bodies with several null vectors each, and on rows of
 * zeros */
#include "tests/lib/elasticity.h"
#include "tests/lib/constraint_calls.h"

enum { R = 3 };

typedef struct held_t {
    elastic_t y;
    sl_symbolic *S;
    sl_factor *F;
    sl_constraints *P;
    size_t n, count;
    unsigned char *is_held;
    sl_int *rows;
    double *B, *G, *X;
} held_t;

static held_t held_make(int dim, const variant_list_t *variants, int k, uint64_t *seed) {
    held_t h;
    memset(&h, 0, sizeof h);
    h.y = elastic_make(dim, dim == 2 ? 9 : 4, 1.0, 0.5, 1e-3, 1, seed);
    sl_options opt = options_rigid(&h.y, variants, k);
    SL_CHECK(sl_symbolic_create(&h.S, &h.y.A, NULL, NULL));
    SL_CHECK(sl_factor_create(&h.F, h.S, &h.y.A, &opt, NULL));
    SL_CHECK(sl_constraints_create(&h.P, h.F, NULL));
    h.n = (size_t)h.y.n;
    h.is_held = (unsigned char *)test_array(h.n, 1);
    h.rows = test_ints(h.n);
    h.B = test_reals(h.n * R);
    h.G = test_reals(h.n * R);
    h.X = test_reals(h.n * R);
    return h;
}

static void held_free(held_t *h) {
    sl_constraints_free(h->P);
    sl_factor_free(h->F);
    sl_symbolic_free(h->S);
    elastic_free(&h->y);
    free(h->is_held);
    free(h->rows);
    free(h->B);
    free(h->G);
    free(h->X);
}

static void hold(held_t *h, sl_int row) {
    SL_CHECK(pin_row(h->P, row, NULL));
    h->is_held[row] = 1;
    h->rows[h->count++] = row;
}

/* Right-hand sides in balance, and anything else in the rows of a body that is held. */
static void load(held_t *h, sl_int body, uint64_t *seed) {
    for (size_t r = 0; r < R; r++) {
        double *b = consistent(&h->y.A, gen_bits(seed));
        for (sl_int i = 0; i < h->y.n; i++) {
            const int is_free = body != -2 && (h->y.body[i] == body || h->is_held[i]);
            h->B[(size_t)i + r * h->n] = is_free ? gen_real(seed) : b[i];
        }
        free(b);
    }
    gen_reals(h->G, h->n * R, gen_bits(seed));
}

/* Pinned rows have their values, all others no residual; a plan gives the same. */
static void assert_held(held_t *h, uint64_t *seed) {
    const size_t n = h->n, k = h->count;
    double *residual = test_reals(n * R), largest = 0.0, most = 0.0;
    for (sl_int i = 0; i < h->y.A.p[n]; i++) {
        most = fmax(most, fabs(h->y.A.x[i]));
    }
    SL_CHECK(sl_constraints_solve(h->P, NULL, h->X, n, h->B, n, h->G, n, R, NULL));
    for (size_t i = 0; i < n * R; i++) {
        largest = fmax(largest, fabs(h->X[i]));
    }
    SL_CHECK(sl_csc_residual(&h->y.A, residual, n, NULL, h->X, n, h->B, n, R));
    for (size_t r = 0; r < R; r++) {
        for (size_t i = 0; i < n; i++) {
            assert_true(h->is_held[i] ||
                        fabs(residual[i + r * n]) <= 1e-11 * (most * largest + 1.0));
        }
        for (size_t p = 0; p < k; p++) {
            assert_true(fabs(h->X[(size_t)h->rows[p] + r * n] - h->G[p + r * n]) <=
                        1e-10 * (largest + 1.0));
        }
    }
    sl_int *xset = test_ints(n), nx = h->y.n / 2, *all = test_ints(n);
    double *x = test_reals(n * R);
    sl_plan *plan = NULL;
    gen_set(xset, nx, h->y.n, gen_bits(seed));
    for (sl_int i = 0; i < h->y.n; i++) {
        all[i] = i;
    }
    SL_CHECK(sl_plan_create(&plan, h->S, all, h->y.n, xset, nx, NULL, NULL));
    SL_CHECK(sl_constraints_solve(h->P, plan, x, n, h->B, n, h->G, n, R, NULL));
    for (size_t r = 0; r < R; r++) {
        for (sl_int i = 0; i < nx; i++) {
            assert_true(fabs(x[(size_t)i + r * n] - h->X[(size_t)xset[i] + r * n]) <=
                        1e-9 * (largest + 1.0));
        }
    }
    sl_plan_free(plan);
    free(x);
    free(xset);
    free(all);
    free(residual);
}

/* One body after the other: a point, about which it can still turn, then enough of them. */
static void pins_hold_bodies(void **state) {
    (void)state;
    variant_list_t variants = variants_present();
    uint64_t seed = 3;
    for (int k = 0; k < 8 * variants.count; k++) {
        const int dim = 2 + k % 2;
        held_t h = held_make(dim, &variants, k / 8, &seed);
        load(&h, -2, &seed);
        assert_held(&h, &seed);
        for (sl_int body = 0; body < h.y.bodies; body++) {
            sl_int points = 0, row = gen_below(&seed, dim);
            for (; row < h.y.n; row += dim) { /* one row of it */
                if (h.y.body[row] == body) {
                    hold(&h, row);
                    break;
                }
            }
            load(&h, -2, &seed);
            assert_held(&h, &seed);
            for (sl_int at = 0; at < h.y.n; at += dim) {
                if (h.y.body[at] != body || gen_below(&seed, 3) > 0) {
                    continue;
                }
                for (int c = 0; c < dim; c++) {
                    if (!h.is_held[at + c]) {
                        hold(&h, at + c);
                    }
                }
                if (++points == 1) {
                    load(&h, -2, &seed);
                    assert_held(&h, &seed);
                }
            }
            load(&h, points > 5 ? body : -2, &seed);
            assert_held(&h, &seed);
        }
        for (sl_int i = 0; i < h.y.n; i++) {
            if (h.y.body[i] == -1) {
                hold(&h, i); /* a row of zeros */
                break;
            }
        }
        assert_held(&h, &seed);
        while (h.count > 0) { /* the last half of them goes first */
            const size_t at = h.count / 2;
            SL_CHECK(unpin(h.P, (sl_int)at));
            h.is_held[h.rows[at]] = 0;
            memmove(h.rows + at, h.rows + at + 1, (--h.count - at) * sizeof *h.rows);
            load(&h, -2, &seed);
            if (h.count % 7 == 0) {
                assert_held(&h, &seed);
            }
        }
        held_free(&h);
    }
}

/* Forces out of balance on a body without pins, or on one that can still turn about its pin, are
 * refused. */
static void bodies_that_move_need_balance(void **state) {
    (void)state;
    variant_list_t variants = variants_present();
    uint64_t seed = 8;
    for (int k = 0; k < 8; k++) {
        const int dim = 2 + k % 2;
        held_t h = held_make(dim, &variants, k / 2 % variants.count, &seed);
        sl_int row = 0;
        while (h.y.body[row] == -1) {
            row += dim;
        }
        load(&h, -2, &seed);
        for (int c = 0; c <= dim; c++) { /* no pin, then one direction of a point after the other */
            assert_held(&h, &seed);
            for (sl_int at = row + dim; at < h.y.n; at += dim) {
                if (h.y.body[at] == h.y.body[row]) { /* a moment about the point, and a force */
                    double b = h.B[at], d = h.B[at + 1];
                    h.B[at] += h.y.at[row + 1] - h.y.at[at + 1];
                    h.B[at + 1] += h.y.at[at] - h.y.at[row];
                    SL_EXPECT(SL_ERR_INCONSISTENT, sl_constraints_solve(h.P, NULL, h.X, h.n, h.B,
                                                                        h.n, h.G, h.n, R, NULL));
                    h.B[at] = b;
                    h.B[at + 1] = d;
                }
            }
            if (c < dim) {
                hold(&h, row + c);
            }
        }
        held_free(&h);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(pins_hold_bodies),
        cmocka_unit_test(bodies_that_move_need_balance),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

/* rigid_mass.h: weights for solves with several null vectors, and a check of their solutions */
#ifndef SL_TEST_RIGID_MASS_H
#define SL_TEST_RIGID_MASS_H

#include "elasticity.h"

/* Weights of one kind: all 1; of rows, over some decades; of nodes; 0 at most nodes; 0 everywhere,
 * which counts as 1; a few negative ones. At least `dim` nodes of each body have one. */
enum { RIGID_MASSES = 6 };
static inline double *rigid_masses(const elastic_t *y, int kind, uint64_t *seed) {
    double *m = test_reals((size_t)y->n), node = 1.0;
    for (sl_int i = 0; i < y->n; i++) {
        node = i % y->dim == 0 ? pow(10.0, 8.0 * elastic_uniform(seed) - 4.0) : node;
        m[i] = kind == 0     ? 1.0
               : kind == 1   ? pow(10.0, 6.0 * elastic_uniform(seed) - 3.0)
               : kind == 2   ? node
               : kind == 3   ? (i / y->dim % 3 == 0 || i / y->dim % 5 < 2 ? node : 0.0)
               : kind == 4   ? 0.0
               : i % 11 == 5 ? -0.1
                             : 0.5 + elastic_uniform(seed);
    }
    return m;
}

/* C := Z in the rows of each body, orthonormal there in the product of the weights, which are
 * positive definite on Z. m: n; all 0: 1. */
static inline double *rigid_basis(const elastic_t *y, const double *Z, const double *m) {
    const size_t n = (size_t)y->n;
    double *C = test_reals(n * (size_t)y->rigid);
    for (size_t i = 0; i < n * (size_t)y->rigid; i++) {
        C[i] = y->body[i % n] == -1 ? 0.0 : Z[i];
    }
    for (sl_int body = 0; body < y->bodies; body++) {
        for (sl_int j = 0; j < y->rigid; j++) {
            double *c = C + (size_t)j * n;
            for (sl_int k = 0; k < 2 * j + 1; k++) { /* twice, then its length */
                const double *d = C + (size_t)(k == 2 * j ? j : k % j) * n;
                long double sum = 0.0L;
                for (size_t i = 0; i < n; i++) {
                    sum += y->body[i] == body ? (long double)m[i] * d[i] * c[i] : 0.0L;
                }
                for (size_t i = 0; i < n; i++) {
                    if (y->body[i] == body) {
                        c[i] =
                            k == 2 * j ? (double)(c[i] / sqrtl(sum)) : (double)(c[i] - sum * d[i]);
                    }
                }
            }
        }
    }
    return C;
}

/* Checks the equations that define the solution in every body: A x = b - M C C' b and C' M x = 0,
 * where rounding is relative to the largest x of the body; x = 0 in rows of zeros. accuracy: a
 * multiple of n epsilon. */
static inline void assert_rigid_mean(const elastic_t *y, const double *C, const double *m,
                                     const double *x, const double *b, double accuracy) {
    const size_t n = (size_t)y->n;
    double *rhs = test_reals(n), *none = test_reals(n), eta;
    double residual = 0.0, size = 0.0, entry = 0.0;
    for (size_t i = 0; i < n; i++) {
        rhs[i] = y->body[i] == -1 ? 0.0 : b[i];
        assert_true(y->body[i] != -1 || x[i] == 0.0);
    }
    for (sl_int body = 0; body < y->bodies; body++) {
        double most = 0.0;
        for (size_t i = 0; i < n; i++) {
            most = y->body[i] == body ? fmax(most, fabs(x[i])) : most;
        }
        for (sl_int j = 0; j < y->rigid; j++) {
            const double *c = C + (size_t)j * n;
            double force = 0.0, sum = 0.0, total = 0.0;
            for (size_t i = 0; i < n; i++) {
                if (y->body[i] == body) {
                    force += c[i] * b[i];
                    sum += c[i] * m[i] * x[i];
                    total += fabs(c[i] * m[i]);
                }
            }
            assert_true(fabs(sum) <= accuracy * pass_figure(y->n) * total * most);
            for (size_t i = 0; i < n; i++) {
                rhs[i] -= y->body[i] == body ? m[i] * c[i] * force : 0.0;
            }
        }
    }
    SL_CHECK(sl_csc_residual(&y->A, none, n, &eta, x, n, rhs, n, 1));
    for (size_t i = 0; i < n; i++) { /* where M is uneven, M C C' b is larger than b */
        residual = fmax(residual, fabs(none[i]));
        size = fmax(size, fabs(x[i]));
    }
    for (sl_int p = 0; p < y->A.p[y->n]; p++) {
        entry = fmax(entry, fabs(y->A.x[p]));
    }
    for (size_t i = 0; i < n; i++) {
        double part = fabs(b[i]);
        for (sl_int j = 0; j < y->rigid; j++) {
            double force = 0.0;
            for (size_t k = 0; k < n; k++) {
                force += y->body[k] == y->body[i] ? fabs(C[k + (size_t)j * n] * b[k]) : 0.0;
            }
            part += fabs(m[i] * C[i + (size_t)j * n]) * force;
        }
        size = fmax(size, part / entry);
    }
    assert_true(eta <= accuracy * pass_figure(y->n) ||
                residual <= accuracy * pass_figure(y->n) * entry * size);
    free(rhs);
    free(none);
}

/* Elastic bodies with weights, their factor, and any right-hand side. */
typedef struct weighed_t {
    elastic_t y;
    sl_options opt;
    sl_symbolic *S;
    sl_factor *F;
    double *m, *C, *b, *x; /* the weights, or 1 for those that are all 0 */
    size_t n;
} weighed_t;

static inline weighed_t weighed_make(int which, const variant_list_t *variants, int k,
                                     uint64_t *seed) {
    const int dim = 2 + which % 2, kind = which / 2 % RIGID_MASSES;
    weighed_t f;
    f.y = elastic_make(dim, dim == 2 ? 7 : 3, which % 5 == 0 ? 3.0 : 0.0, 0.7, 1e-2, which % 3 == 0,
                       seed);
    f.opt = options_rigid(&f.y, variants, k);
    f.n = (size_t)f.y.n;
    f.m = rigid_masses(&f.y, kind, seed);
    f.b = test_reals(f.n);
    f.x = test_reals(f.n);
    gen_reals(f.b, f.n, *seed);
    f.opt.mass = f.m;
    SL_CHECK(sl_symbolic_create(&f.S, &f.y.A, NULL, NULL));
    SL_CHECK(sl_factor_create(&f.F, f.S, &f.y.A, FOR_FACTOR(&f.opt), NULL));
    for (size_t i = 0; i < f.n && kind == 4; i++) {
        f.m[i] = 1.0;
    }
    f.C = rigid_basis(&f.y, f.y.Z, f.m);
    return f;
}

static inline void weighed_free(weighed_t *f) {
    sl_factor_free(f->F);
    sl_symbolic_free(f->S);
    elastic_free(&f->y);
    free(f->m);
    free(f->C);
    free(f->b);
    free(f->x);
}

static inline void assert_means(const weighed_t *f, const sl_factor *F) {
    SL_CHECK(sl_factor_solve(F, f->x, f->n, f->b, f->n, 1, NULL));
    assert_rigid_mean(&f->y, f->C, f->m, f->x, f->b, 1.0);
}

#endif

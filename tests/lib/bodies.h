/* bodies.h: elastic bodies with several null vectors each, factored, with right-hand sides */
#ifndef SL_TEST_BODIES_H
#define SL_TEST_BODIES_H

#include "elasticity.h"

enum { BODIES_RHS = 10 };

typedef struct bodies_t {
    elastic_t y;
    sl_options opt;
    sl_symbolic *S;
    sl_factor *F;
    sl_int *nulls; /* the null rows */
    double *B, *X; /* n x BODIES_RHS: right-hand sides with a solution, and the solutions */
    size_t n;
} bodies_t;

static inline bodies_t bodies_make(int dim, const variant_list_t *variants, int k) {
    uint64_t seed = 17;
    bodies_t f;
    sl_int count = 0;
    int is_wanted;
    do { /* until there are several bodies, and rows of zeros */
        f.y = elastic_make(dim, dim == 2 ? 9 : 4, 1.0, 0.5, 1e-3, 1, &seed);
        is_wanted = f.y.bodies > 1 && f.y.null > f.y.bodies * f.y.rigid;
        if (!is_wanted) {
            elastic_free(&f.y);
        }
    } while (!is_wanted);
    f.opt = options_rigid(&f.y, variants, k);
    f.n = (size_t)f.y.n;
    f.nulls = test_ints(f.n);
    f.B = test_reals(f.n * BODIES_RHS);
    f.X = test_reals(f.n * BODIES_RHS);
    for (size_t r = 0; r < BODIES_RHS; r++) {
        double *b = consistent(&f.y.A, r);
        memcpy(f.B + r * f.n, b, f.n * sizeof *b);
        free(b);
    }
    SL_CHECK(sl_symbolic_create(&f.S, &f.y.A, NULL, NULL));
    SL_CHECK(sl_factor_create(&f.F, f.S, &f.y.A, &f.opt, NULL));
    SL_CHECK(sl_factor_pivot_rows(f.F, SL_PIVOT_NULL, f.nulls, NULL, f.y.n, &count));
    assert_int_equal(count, f.y.null);
    SL_CHECK(sl_factor_solve(f.F, f.X, f.n, f.B, f.n, BODIES_RHS, NULL));
    return f;
}

static inline void bodies_free(bodies_t *f) {
    sl_factor_free(f->F);
    sl_symbolic_free(f->S);
    elastic_free(&f->y);
    free(f->nulls);
    free(f->B);
    free(f->X);
}

typedef void (*bodies_check_t)(bodies_t *f, const sl_options *opt);

/* Runs a check in 2D and in 3D with every instruction set and method. */
static inline void for_all(bodies_check_t check) {
    variant_list_t variants = variants_present();
    for (int k = 0; k < 2 * variants.count; k++) {
        bodies_t f = bodies_make(2 + k % 2, &variants, k / 2);
        check(&f, &f.opt);
        bodies_free(&f);
    }
}

#endif

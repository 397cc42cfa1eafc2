/* complex_pair.h: a Hermitian matrix with L in double and L as complex */
#ifndef SL_TEST_COMPLEX_PAIR_H
#define SL_TEST_COMPLEX_PAIR_H

#include "factored.h"

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

static inline sl_options options_complex(sl_isa isa) {
    sl_options opt = options_none();
    opt.isa = isa;
    opt.storage = SL_STORAGE_COMPLEX;
    return opt;
}

static inline pair_t pair_make(gen_kind_t kind, sl_int size, int style, sl_isa isa) {
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

static inline void pair_free(pair_t *y) {
    sl_factor_free(y->F[0]);
    sl_factor_free(y->F[1]);
    sl_symbolic_free(y->S);
    sl_matrix_free(y->M);
    gen_matrix_free(&y->G);
    free(y->values);
}

/* Calls a test for each kind of matrix, and small dense ones, with each instruction set. */
static inline void for_each(void (*test)(const pair_t *y, sl_isa isa)) {
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

#endif

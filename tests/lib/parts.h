/* parts.h: short names of the parts of half solves, matrices for them, a factor with 2x2 pivots */
#ifndef SL_TEST_PARTS_H
#define SL_TEST_PARTS_H

#include "factored.h"

enum { P = SL_PART_P, L = SL_PART_L, D = SL_PART_D, ROOT = SL_PART_SQRT_D, LT = SL_PART_LT };
enum { PT = SL_PART_PT, ALL = P | L | D | LT | PT, MOST = 11 };

static const gen_kind_t kinds[] = {GEN_NONE,  GEN_ONE,    GEN_DIAGONAL, GEN_PATH,
                                   GEN_STAR,  GEN_GRID2,  GEN_GRID3,    GEN_FOREST,
                                   GEN_DENSE, GEN_RANDOM, GEN_KKT,      GEN_COMPONENTS};
enum { KINDS = sizeof kinds / sizeof kinds[0] };

/* An indefinite system without a diagonal: it has 2x2 pivots. */
static inline factored_t hollow_make(sl_int n, sl_isa isa) {
    gen_list_t t = gen_list(n);
    sl_options opt = options_none();
    uint64_t seed = 5;
    factored_t y;
    for (sl_int k = 1; k < n; k++) {
        gen_add(&t, k, k - 1, 1.0 + gen_real(&seed));
        if (k > 9) {
            gen_add(&t, k, k - 9, gen_real(&seed));
        }
    }
    y.M = gen_store(&t, gen_style(0), 1);
    y.S = NULL;
    y.F = NULL;
    SL_CHECK(sl_symbolic_create_pivoted(&y.S, &y.M.view, NULL, NULL));
    opt.isa = isa;
    SL_CHECK(sl_factor_create(&y.F, y.S, &y.M.view, &opt, NULL));
    assert_non_null(sl_factor_view(y.F).E);
    gen_list_free(&t);
    return y;
}

#endif

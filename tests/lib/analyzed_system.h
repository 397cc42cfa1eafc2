/* analyzed_system.h: analyses of a random system, by its pattern, its values or other values */
#ifndef SL_TEST_ANALYZED_SYSTEM_H
#define SL_TEST_ANALYZED_SYSTEM_H

#include "test.h"
#include "random_systems.h"

/* How an analysis is made: from the pattern; from the values; from other values. */
enum { PLAIN = 0, PIVOTED, PIVOTED_ELSEWHERE, WAYS };

/* Changes the values so that a search for pivots finds others. */
static inline void change_values(random_system_t *y, uint64_t seed) {
    uint64_t state = seed;
    const sl_int kind = gen_below(&state, 4);
    for (sl_int p = 0; p < y->M.p[y->n]; p++) {
        double *x = &y->M.x[p];
        *x = kind == 0   ? gen_real(&state)
             : kind == 1 ? *x * (gen_below(&state, 3) ? 1.0 : -1.0)
             : kind == 2 ? *x * system_scale(&state, -12.0, 0.0)
                         : (gen_below(&state, 4) ? 1.0 : 0.0);
    }
}

static inline sl_symbolic *analyze(random_system_t *y, int way, uint64_t seed) {
    const size_t count = (size_t)y->M.p[y->n];
    double *keep = test_reals(count);
    sl_symbolic *S = NULL;
    memcpy(keep, y->M.x, count * sizeof(double));
    if (way == PIVOTED_ELSEWHERE) {
        change_values(y, seed);
    }
    SL_CHECK(way == PLAIN ? sl_symbolic_create(&S, &y->M.view, NULL, NULL)
                          : sl_symbolic_create_pivoted(&S, &y->M.view, NULL, NULL));
    memcpy(y->M.x, keep, count * sizeof(double));
    free(keep);
    return S;
}

#endif

/* factor_ways.h: combinations, batches and threads give the bits of a plain factorization */
#ifndef SL_TEST_FACTOR_WAYS_H
#define SL_TEST_FACTOR_WAYS_H

#include "factored.h"
#include "parallel_for.h"

/* A combination, a batch and threads give the bits of a plain factorization. */
static inline void assert_ways_agree(const sl_symbolic *S, const sl_csc *A, const sl_factor *F,
                                     const sl_options *plain) {
    const double one[2] = {1.0, 1.0};
    double *values = test_reals((size_t)scatter_length(S) + 1);
    const double *const terms[1] = {values};
    sl_options opt = *plain;
    sl_factor *G[2] = {NULL, NULL};
    int calls = 0;
    SL_CHECK(sl_symbolic_scatter(S, values, A, NULL));
    SL_CHECK(sl_factor_create_sums(&G[0], 1, S, one, terms, 1, FOR_FACTOR(&opt), NULL, NULL));
    assert_same_bits(F, G[0]);
    SL_CHECK(sl_factor_refactor_sums(&G[0], 1, one, terms, 1, NULL, NULL, NULL));
    assert_same_bits(F, G[0]);
    sl_factor_free(G[0]);
    opt.threads.count = 3;
    opt.threads.run = run_backwards;
    opt.threads.context = &calls;
    SL_CHECK(sl_factor_create_sums(G, 2, S, one, terms, 1, FOR_FACTOR(&opt), NULL, NULL));
    assert_same_bits(F, G[0]);
    assert_same_bits(F, G[1]);
    sl_factor_free(G[0]);
    sl_factor_free(G[1]);
    free(values);
}

#endif

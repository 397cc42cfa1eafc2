/* factor_array.h: what the tests of several factors share: coefficients, threads, release */
#ifndef SL_TEST_FACTOR_ARRAY_H
#define SL_TEST_FACTOR_ARRAY_H

#include "parallel_for.h"
#include "matrix_pair.h"

enum { MOST = 8 };

/* Coefficients 1 and t of each factor; t is first, 2 first, 4 first, ... */
static inline void coefficients_of(double *c, int count, double first) {
    for (int k = 0; k < count; k++) {
        c[TERMS * k] = 1;
        c[TERMS * k + 1] = ldexp(first, k);
    }
}

static inline sl_threads threads_of(int count, int *calls) {
    sl_threads threads = {count, count % 2 ? run_threads : run_backwards, calls};
    return threads;
}

static inline void free_all(sl_factor **F, int count) {
    for (int k = 0; k < count; k++) {
        sl_factor_free(F[k]);
        F[k] = NULL;
    }
}

#endif

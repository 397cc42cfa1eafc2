/* parallel.h: the same work for several workers at once: by the caller's pool, by OpenMP, or one after the other */
#ifndef SLI_PARALLEL_H
#define SLI_PARALLEL_H

#include "../public/types.h"
#include "base.h"

/* Workers that a wish for threads comes to. */
SLI_INLINE sl_int sli_workers(const sl_threads *t) {
#if !defined(_OPENMP)
    if (t->run == NULL) {
        return 1;
    }
#endif
    return sli_max(t->count, 1);
}

/* body(data, k) for k = 0 .. count-1. */
static void sli_parallel(const sl_threads *t, sl_int count, void (*body)(void *data, sl_int k),
                         void *data) {
    sl_int k;
    if (count > 1 && t->run != NULL) {
        t->run(t->context, count, body, data);
        return;
    }
#if defined(_OPENMP)
#pragma omp parallel for num_threads(count) schedule(static, 1) if (count > 1)
#endif
    for (k = 0; k < count; k++) {
        body(data, k);
    }
}

/* Where worker k's part of the row tiles first .. last-1 begins: parts are equal, or, where the rows grow
 * longer as in a triangle, of equal area. */
static sl_int sli_part(sl_int first, sl_int last, sl_int k, sl_int workers, int is_triangle) {
    const double share = (double)k / workers;
    return first + (sl_int)((last - first) * (is_triangle ? sqrt(share) : share));
}

#endif

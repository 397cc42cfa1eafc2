/* parallel.h: runs work items on the caller's thread pool, with OpenMP, or one after another */
#ifndef SLI_BASE_PARALLEL_H
#define SLI_BASE_PARALLEL_H

#include "../../public/options.h"
#include "base.h"

/* The number of workers for the options of threads: their count, or 1 where neither a pool nor
 * OpenMP is available. */
SLI_INLINE sl_int sli_workers(const sl_threads *t) {
#if !defined(_OPENMP)
    if (t->run == NULL) {
        return 1;
    }
#endif
    return sli_max(t->count, 1);
}

/* Calls body(data, k) for k = 0 .. count-1. */
static void sli_parallel(const sl_threads *t, sl_int count, void (*body)(void *data, sl_int k),
                         void *data) {
    sl_int k;
    if (t->run != NULL && count > 1) {
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

/* Where the range of worker k begins among the row tiles first .. last-1: the ranges have equal
 * length, or for a triangle, whose rows grow longer, equal area. */
static sl_int sli_tile_range_begin(sl_int first, sl_int last, sl_int k, sl_int workers,
                                   int is_triangle) {
    const double share = (double)k / workers;
    return first + (sl_int)((last - first) * (is_triangle ? sqrt(share) : share));
}

#endif

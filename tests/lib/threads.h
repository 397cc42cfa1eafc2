/* threads.h: options with threads, of factorizations and of workspaces */
#ifndef SL_TEST_THREADS_H
#define SL_TEST_THREADS_H

#include "pools.h"
#include "factored.h"

static inline sl_options options_with_threads(sl_parallel_for run, sl_int count, int *calls) {
    sl_options opt = options_none();
    opt.method = SL_METHOD_SUPERNODAL;
    opt.threads.count = count;
    opt.threads.run = run;
    opt.threads.context = calls;
    return opt;
}

/* The options of a workspace, which reads threads alone. */
static inline sl_options options_of_workers(sl_int count, int *calls) {
    sl_options opt = options_with_threads(run_backwards, count, calls);
    opt.method = SL_METHOD_AUTO;
    return opt;
}

#endif

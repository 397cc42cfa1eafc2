/* pools.h: pools of fewer threads than promised, in any order, or late (needs nanosleep) */
#ifndef SL_TEST_POOLS_H
#define SL_TEST_POOLS_H

#include "parallel_for.h"
#include <time.h>

/* One after the other: the first index does all work. */
static inline void run_in_order(void *context, sl_int count, void (*body)(void *data, sl_int k),
                                void *data) {
    ++*(int *)context;
    for (sl_int k = 0; k < count; k++) {
        body(data, k);
    }
}

typedef struct late_t {
    void (*body)(void *data, sl_int k);
    void *data;
} late_t;

static inline void late_body(void *data, sl_int k) {
    const late_t *late = (const late_t *)data;
    const struct timespec delay = {0, 100000 * (k % 4)};
    nanosleep(&delay, NULL);
    late->body(late->data, k);
}

/* Threads that begin one after the other, when others are done or amid their work. */
static inline void run_late(void *context, sl_int count, void (*body)(void *data, sl_int k),
                            void *data) {
    late_t late = {body, data};
    run_threads(context, count, late_body, &late);
}

enum { RUNS = 4 };
static const sl_parallel_for runs[RUNS] = {run_threads, run_backwards, run_in_order, run_late};

#endif

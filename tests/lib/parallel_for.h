/* parallel_for.h: parallel-for callbacks: one thread for each index, or serial in reverse order */
#ifndef SL_TEST_PARALLEL_FOR_H
#define SL_TEST_PARALLEL_FOR_H

#include "test.h"
#include <pthread.h>

typedef struct share_t {
    void (*body)(void *data, sl_int k);
    void *data;
    sl_int k;
} share_t;

static inline void *share_run(void *share) {
    share_t *s = (share_t *)share;
    s->body(s->data, s->k);
    return NULL;
}

/* Are threads of the header's own compiled in? */
#if defined(_OPENMP) || defined(SL_PTHREADS)
enum { HAS_THREADS = 1 };
#else
enum { HAS_THREADS = 0 };
#endif

/* Options that set nothing but threads. */
#define THREADS(t) (&(sl_options){.threads = (t)})

/* Starts one thread for each index. context: an int that counts the calls. */
static inline void run_threads(void *context, sl_int count, void (*body)(void *data, sl_int k),
                               void *data) {
    pthread_t *thread = (pthread_t *)test_array((size_t)count, sizeof *thread);
    share_t *share = (share_t *)test_array((size_t)count, sizeof *share);
    ++*(int *)context;
    for (sl_int k = 0; k < count; k++) {
        share[k].body = body;
        share[k].data = data;
        share[k].k = k;
        assert_int_equal(pthread_create(&thread[k], NULL, share_run, &share[k]), 0);
    }
    for (sl_int k = 0; k < count; k++) {
        assert_int_equal(pthread_join(thread[k], NULL), 0);
    }
    free(thread);
    free(share);
}

/* Runs the last index first, without threads: shows whether one index depends on an earlier one. */
static inline void run_backwards(void *context, sl_int count, void (*body)(void *data, sl_int k),
                                 void *data) {
    ++*(int *)context;
    for (sl_int k = count - 1; k >= 0; k--) {
        body(data, k);
    }
}

#endif

/* pthread.h: for WASI, which has no threads: a thread is run to its end when it is created */
#ifndef SL_TEST_WASI_PTHREAD_H
#define SL_TEST_WASI_PTHREAD_H

typedef int pthread_t;

static inline int pthread_create(pthread_t *thread, const void *attributes, void *(*run)(void *),
                                 void *data) {
    (void)attributes;
    *thread = 0;
    (void)run(data);
    return 0;
}

static inline int pthread_join(pthread_t thread, void **result) {
    (void)thread;
    (void)result;
    return 0;
}

#endif

/* threads.c: the threads for options.threads: those of OpenMP, or without it a pool of pthreads */
#define _POSIX_C_SOURCE 200112L
#include <stdlib.h>

#include "bench.h"

#if defined(_OPENMP)
sl_threads bench_threads(sl_int count) {
    sl_threads threads = {count, NULL, NULL};
    return threads;
}

void bench_threads_free(void) {
}
#else
#include <pthread.h>

/* Workers wait for a loop, take one iteration at a time, and wait again. The caller takes
 * iterations too. */
enum { MAX_THREADS = 64 };

typedef struct pool {
    pthread_mutex_t lock;
    pthread_cond_t begin, end;
    pthread_t workers[MAX_THREADS];
    sl_int n_workers;
    int busy, closing;
    unsigned long loop; /* number of the current loop */
    sl_int count, next, running;
    void (*body)(void *data, sl_int k);
    void *data;
} pool;

static pool the_pool = {.lock = PTHREAD_MUTEX_INITIALIZER,
                        .begin = PTHREAD_COND_INITIALIZER,
                        .end = PTHREAD_COND_INITIALIZER};

/* Runs iterations until none is left. The caller holds the lock, which is released around each
 * iteration. */
static void run_iterations(pool *p) {
    p->running++;
    while (p->next < p->count) {
        const sl_int k = p->next++;
        pthread_mutex_unlock(&p->lock);
        p->body(p->data, k);
        pthread_mutex_lock(&p->lock);
    }
    if (--p->running == 0) {
        pthread_cond_broadcast(&p->end);
    }
}

static void *worker(void *context) {
    pool *p = context;
    unsigned long done = 0;
    pthread_mutex_lock(&p->lock);
    for (;;) {
        while (!p->closing && (p->loop == done || !p->busy)) {
            pthread_cond_wait(&p->begin, &p->lock);
        }
        if (p->closing) {
            break;
        }
        done = p->loop;
        run_iterations(p);
    }
    pthread_mutex_unlock(&p->lock);
    return NULL;
}

/* A nested loop runs on the thread that starts it. */
static void parallel_for(void *context, sl_int count, void (*body)(void *data, sl_int k),
                         void *data) {
    pool *p = context;
    pthread_mutex_lock(&p->lock);
    if (p->busy || p->n_workers == 0) {
        pthread_mutex_unlock(&p->lock);
        for (sl_int k = 0; k < count; k++) {
            body(data, k);
        }
        return;
    }
    p->busy = 1;
    p->loop++;
    p->count = count;
    p->next = 0;
    p->body = body;
    p->data = data;
    pthread_cond_broadcast(&p->begin);
    run_iterations(p);
    while (p->running > 0) {
        pthread_cond_wait(&p->end, &p->lock);
    }
    p->busy = 0;
    pthread_mutex_unlock(&p->lock);
}

sl_threads bench_threads(sl_int count) {
    sl_threads threads = {count, parallel_for, &the_pool};
    if (count < 2) {
        threads.run = NULL;
        threads.context = NULL;
    }
    while (the_pool.n_workers < count - 1 && the_pool.n_workers < MAX_THREADS) {
        if (pthread_create(&the_pool.workers[the_pool.n_workers], NULL, worker, &the_pool) != 0) {
            bench_must(SL_ERR_UNSUPPORTED, "starting a thread");
        }
        the_pool.n_workers++;
    }
    return threads;
}

void bench_threads_free(void) {
    pthread_mutex_lock(&the_pool.lock);
    the_pool.closing = 1;
    pthread_cond_broadcast(&the_pool.begin);
    pthread_mutex_unlock(&the_pool.lock);
    while (the_pool.n_workers > 0) {
        pthread_join(the_pool.workers[--the_pool.n_workers], NULL);
    }
    the_pool.closing = 0;
}
#endif

/* threads.c: the parallel-for that options.threads is given: OpenMP where compiled with it, else a pool of pthreads */
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

/* Workers wait for a loop, take its turns one at a time, and wait again. The caller takes turns too. */
enum { MOST_THREADS = 64 };

typedef struct pool {
    pthread_mutex_t lock;
    pthread_cond_t begin, end;
    pthread_t workers[MOST_THREADS];
    sl_int n_workers;
    int busy, closing;
    unsigned long loop; /* number of the loop at hand */
    sl_int count, next, running;
    void (*body)(void *data, sl_int k);
    void *data;
} pool;

static pool one = {.lock = PTHREAD_MUTEX_INITIALIZER,
                   .begin = PTHREAD_COND_INITIALIZER,
                   .end = PTHREAD_COND_INITIALIZER};

/* Takes turns until none is left; the lock is held on entry and on return. */
static void take_turns(pool *p) {
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

static void *work(void *context) {
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
        take_turns(p);
    }
    pthread_mutex_unlock(&p->lock);
    return NULL;
}

/* A loop inside a loop is done by the thread that asks for it. */
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
    take_turns(p);
    while (p->running > 0) {
        pthread_cond_wait(&p->end, &p->lock);
    }
    p->busy = 0;
    pthread_mutex_unlock(&p->lock);
}

sl_threads bench_threads(sl_int count) {
    sl_threads threads = {count, parallel_for, &one};
    if (count < 2) {
        threads.run = NULL;
        threads.context = NULL;
    }
    while (one.n_workers < count - 1 && one.n_workers < MOST_THREADS) {
        if (pthread_create(&one.workers[one.n_workers], NULL, work, &one) != 0) {
            bench_must(SL_ERR_UNSUPPORTED, "starting a thread");
        }
        one.n_workers++;
    }
    return threads;
}

void bench_threads_free(void) {
    pthread_mutex_lock(&one.lock);
    one.closing = 1;
    pthread_cond_broadcast(&one.begin);
    pthread_mutex_unlock(&one.lock);
    while (one.n_workers > 0) {
        pthread_join(one.workers[--one.n_workers], NULL);
    }
    one.closing = 0;
}
#endif

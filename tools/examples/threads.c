/* threads.c: a thread pool of one's own for options.threads, with a factorization on it
 *
 * SL_PTHREADS, defined where the implementation is compiled, starts threads without a pool. */
#include <pthread.h>
#include <string.h>

#define SL_WITH_BATCH
#include "example.h"

enum { WORKERS = 3, RHS = 32 }; /* WORKERS: besides the calling thread */

/* Workers and the caller take the next index of the loop until none is left. The caller returns
 * when every index that was taken is done, whether all workers woke up or none. */
typedef struct pool {
    pthread_mutex_t lock;
    pthread_cond_t begin, end;
    sl_int next, count, running; /* of the current loop */
    int closing;
    void (*body)(void *data, sl_int k);
    void *data;
} pool;

/* Takes indices; the lock is held, except while an index runs. */
static void take(pool *p) {
    while (p->next < p->count) {
        const sl_int k = p->next++;
        p->running++;
        pthread_mutex_unlock(&p->lock);
        p->body(p->data, k);
        pthread_mutex_lock(&p->lock);
        p->running--;
    }
    if (p->running == 0) {
        pthread_cond_signal(&p->end);
    }
}

static void *worker(void *context) {
    pool *p = context;
    pthread_mutex_lock(&p->lock);
    while (!p->closing) {
        take(p);
        pthread_cond_wait(&p->begin, &p->lock);
    }
    pthread_mutex_unlock(&p->lock);
    return NULL;
}

/* ---- run ---- */
/* An sl_parallel_for. One loop at a time: calls on different factors at once need a pool each. */
static void run(void *context, sl_int count, void (*body)(void *data, sl_int k), void *data) {
    pool *p = context;
    pthread_mutex_lock(&p->lock);
    p->body = body;
    p->data = data;
    p->next = 0;
    p->count = count;
    pthread_cond_broadcast(&p->begin);
    take(p);
    while (p->running > 0) {
        pthread_cond_wait(&p->end, &p->lock);
    }
    p->count = 0;
    pthread_mutex_unlock(&p->lock);
}
/* ---- end ---- */

int main(void) {
    pool p = {.lock = PTHREAD_MUTEX_INITIALIZER,
              .begin = PTHREAD_COND_INITIALIZER,
              .end = PTHREAD_COND_INITIALIZER};
    pthread_t threads[WORKERS];
    sl_matrix *M = grid_laplacian(0.1);
    const sl_csc A = sl_matrix_view(M);
    sl_symbolic *S = NULL;
    sl_factor *F = NULL, *alone = NULL;
    sl_options options = {0};
    static double B[RHS * N], X[RHS * N], Y[RHS * N];
    int started = 0, k, same;
    while (started < WORKERS && pthread_create(&threads[started], NULL, worker, &p) == 0) {
        started++; /* fewer threads only take longer */
    }
    for (k = 0; k < RHS * N; k++) {
        B[k] = sin(k);
    }
    /* ---- options ---- */
    options.threads.count = WORKERS + 1; /* enough with SL_PTHREADS or OpenMP */
    options.threads.run = run;           /* a pool of your own */
    options.threads.context = &p;
    ok(sl_symbolic_create(&S, &A, &options, NULL));  /* the threads order the rows */
    ok(sl_factor_create(&F, S, &A, &options, NULL)); /* they factor, now and later */
    const sl_request solve = {NULL, X, N, B, N, RHS, NULL};
    ok(sl_batch_solve(F, &solve, 1, &options, NULL, NULL));
    /* ---- end ---- */
    ok(sl_factor_create(&alone, S, &A, NULL, NULL)); /* on the calling thread, for comparison */
    ok(sl_factor_solve(alone, Y, N, B, N, RHS, NULL));
    same = memcmp(X, Y, sizeof X) == 0;
    printf("%d threads: %s\n", started + 1, same ? "the same bits" : "different");
    pthread_mutex_lock(&p.lock);
    p.closing = 1;
    pthread_cond_broadcast(&p.begin);
    pthread_mutex_unlock(&p.lock);
    while (started > 0) {
        pthread_join(threads[--started], NULL);
    }
    sl_factor_free(F);
    sl_factor_free(alone);
    sl_symbolic_free(S);
    sl_matrix_free(M);
    return !same;
}

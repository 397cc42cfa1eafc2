/* parallel.h: runs work items on the caller's threads; a lock and a pause for those that share */
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

/* SL_VERIFY builds, and a test that defines it, exercise threads on small systems. */
#if defined(SL_VERIFY) && !defined(SLI_SMALL_TASKS)
#define SLI_SMALL_TASKS 1
#endif

/* Each worker has at least this much work, in flops, which take about half a ms. Starting a thread
 * and waiting for its end takes 5 to 50 us, and several ms where the processors are busy. */
#if defined(SLI_SMALL_TASKS)
#define SLI_WORKER_FLOPS 1.0
#else
#define SLI_WORKER_FLOPS 1.5e7
#endif

/* The number of workers that share so many flops as tasks. */
static sl_int sli_workers_for(const sl_threads *t, double flops) {
#if defined(SLI_ATOMIC)
    const sl_int most = sli_workers(t);
    return flops >= SLI_WORKER_FLOPS * most ? most : sli_max((sl_int)(flops / SLI_WORKER_FLOPS), 1);
#else
    (void)t;
    (void)flops;
    return 1;
#endif
}

/* Waits a moment, longer with each turn: most tasks take less than the 30 us of the first turns.
 * Then a thread lets others run on its processor, perhaps the one that it waits for, and sleeps
 * where that takes long. */
static void sli_pause(int turn) {
    if (turn < 1000) {
        SLI_SPIN();
        return;
    }
#if defined(SLI_WINDOWS)
    Sleep(turn < 1200 ? 0 : 1);
#elif defined(SLI_POSIX)
#if defined(SLI_USLEEP)
    if (turn >= 1200) {
        (void)sli_usleep(50);
        return;
    }
#endif
    (void)sched_yield();
#endif
}

/* A lock for a few hundred ns. */
static void sli_lock(sli_atomic *lock) {
    int turn;
    for (turn = 0; sli_atomic_exchange(lock, 1) != 0; turn++) {
        sli_pause(turn);
    }
}

SLI_INLINE void sli_unlock(sli_atomic *lock) {
    sli_atomic_write(lock, 0);
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

#define SLI_PHASES_MAX 3

/* Items that workers draw, phase after phase: a phase begins when all items of the one before are
 * done. */
typedef struct sli_phases {
    void (*run)(void *data, sl_int phase, sl_int item, sl_int worker);
    void *data;
    sl_int count[SLI_PHASES_MAX]; /* items of each phase; 0: there are no more phases */
    sli_atomic lock, changes;     /* lock: of what follows, and of changes, which counts items */
    sl_int phase, next, done;
} sli_phases;

static void sli_phases_body(void *data, sl_int worker) {
    sli_phases *p = (sli_phases *)data;
    for (;;) {
        sl_int phase, item = -1;
        sli_atomic seen;
        int turn;
        sli_lock(&p->lock);
        if (p->phase < SLI_PHASES_MAX && p->done == p->count[p->phase]) {
            p->phase++;
            p->next = p->done = 0;
        }
        phase = p->phase;
        if (phase < SLI_PHASES_MAX && p->next < p->count[phase]) {
            item = p->next++;
        }
        seen = p->changes;
        sli_unlock(&p->lock);
        if (phase == SLI_PHASES_MAX || p->count[phase] == 0) {
            return;
        }
        if (item >= 0) {
            p->run(p->data, phase, item, worker);
            sli_lock(&p->lock);
            p->done++;
            sli_atomic_write(&p->changes, p->changes + 1);
            sli_unlock(&p->lock);
            continue;
        }
        for (turn = 0; sli_atomic_read(&p->changes) == seen; turn++) {
            sli_pause(turn);
        }
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

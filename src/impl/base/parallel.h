/* parallel.h: runs work items on the caller's threads; a team of workers that share loops */
#ifndef SLI_BASE_PARALLEL_H
#define SLI_BASE_PARALLEL_H

#include "../../public/options.h"
#include "base.h"

/* The number of workers for the options of threads. */
SLI_INLINE sl_int sli_workers(const sl_threads *t) {
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

/* The number of workers that may wait for each other. */
SLI_NOINLINE static sl_int sli_team_workers(const sl_threads *t) {
#if defined(SLI_ATOMIC)
    return sli_workers(t);
#else
    (void)t;
    return 1;
#endif
}

/* The number of workers that share so many flops as tasks. */
SLI_NOINLINE static sl_int sli_workers_for(const sl_threads *t, double flops) {
    const sl_int most = sli_team_workers(t);
    return flops >= SLI_WORKER_FLOPS * most ? most : sli_max((sl_int)(flops / SLI_WORKER_FLOPS), 1);
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

#if defined(SL_PTHREADS)
#define SLI_SPAWNED_MAX 63

/* A thread that lives as long as one call. */
typedef struct sli_spawned {
    pthread_t thread;
    void (*body)(void *data, sl_int k);
    void *data;
    sl_int k;
} sli_spawned;

static void *sli_spawned_run(void *context) {
    const sli_spawned *s = (const sli_spawned *)context;
    s->body(s->data, s->k);
    return NULL;
}

/* Starts threads for k = 0, 1, ..., and does what is left, if some could not be started, too. */
static void sli_spawn(sl_int count, void (*body)(void *data, sl_int k), void *data) {
    sli_spawned spawned[SLI_SPAWNED_MAX];
    sl_int started, k;
    for (started = 0; started < sli_min(count - 1, SLI_SPAWNED_MAX); started++) {
        sli_spawned *s = &spawned[started];
        s->body = body;
        s->data = data;
        s->k = started;
        if (pthread_create(&s->thread, NULL, sli_spawned_run, s) != 0) {
            break;
        }
    }
    for (k = started; k < count; k++) {
        body(data, k);
    }
    for (k = 0; k < started; k++) {
        (void)pthread_join(spawned[k].thread, NULL);
    }
}
#endif

/* Calls body(data, k) for k = 0 .. count-1. */
SLI_NOINLINE static void sli_parallel(const sl_threads *t, sl_int count,
                                      void (*body)(void *data, sl_int k), void *data) {
    sl_int k;
    if (t->run != NULL && count > 1) {
        t->run(t->context, count, body, data);
        return;
    }
#if defined(SL_PTHREADS)
    if (count > 1) {
        sli_spawn(count, body, data);
        return;
    }
#elif defined(_OPENMP)
#pragma omp parallel for num_threads(count) schedule(static, 1) if (count > 1)
#endif
    for (k = 0; k < count; k++) {
        body(data, k);
    }
}

#define SLI_TEAM_MAX 16

/* Workers of one parallel call, at most SLI_TEAM_MAX where each has scratch. The first to begin
 * leads: it runs the whole computation, and the others help with its loops, of which they draw
 * items. So a worker alone does everything, whether the others begin late or never. Workers are
 * numbered as they begin, and the leader is 0. */
typedef struct sli_team {
    sl_int workers;
    void (*lead)(struct sli_team *team, void *data);
    void *lead_data;
    sli_atomic lock;    /* of what follows */
    sli_atomic changes; /* counts what the others may wait for */
    sl_int begun;       /* workers that have begun */
    int is_over;
    /* the loop under way */
    void (*run)(void *data, sl_int item, sl_int worker);
    void *data;
    sl_int *list; /* end: the items in the order in which they are drawn; NULL: 0 .. end-1 */
    sl_int next, end, done;
} sli_team;

/* Draws and runs items until the loop is done, or for those who help, the whole computation. */
static void sli_team_draw(sli_team *team, sl_int worker) {
    sl_int item, done = 0;
    for (;;) {
        void (*run)(void *data, sl_int item, sl_int worker);
        void *data;
        sli_atomic seen;
        int is_over, turn;
        sli_lock(&team->lock);
        if (done > 0) {
            team->done++;
            sli_atomic_write(&team->changes, team->changes + 1);
        }
        done = team->next < team->end;
        item = !done ? 0 : team->list != NULL ? team->list[team->next] : team->next;
        team->next += done;
        is_over = worker == 0 ? team->done == team->end : team->is_over;
        run = team->run;
        data = team->data;
        seen = team->changes;
        sli_unlock(&team->lock);
        if (done) {
            run(data, item, worker);
        } else if (is_over) {
            return;
        } else {
            for (turn = 0; sli_atomic_read(&team->changes) == seen; turn++) {
                sli_pause(turn);
            }
        }
    }
}

/* The leader runs a loop: run(data, item, worker) for `count` items, 0 .. count-1 or those of a
 * list, in any order and concurrently. */
static void sli_team_loop(sli_team *team, sl_int count, sl_int *list,
                          void (*run)(void *data, sl_int item, sl_int worker), void *data) {
    if (team->workers == 1) {
        sl_int k;
        team->list = list;
        team->end = count;
        for (k = 0; k < team->end; k++) {
            run(data, list != NULL ? list[k] : k, 0);
        }
        return;
    }
    sli_lock(&team->lock);
    team->run = run;
    team->data = data;
    team->list = list;
    team->next = team->done = 0;
    team->end = count;
    sli_atomic_write(&team->changes, team->changes + 1);
    sli_unlock(&team->lock);
    sli_team_draw(team, 0);
}

/* Adds an item to the list of the loop under way. */
static void sli_team_add(sli_team *team, sl_int item) {
    sli_lock(&team->lock);
    team->list[team->end++] = item;
    sli_atomic_write(&team->changes, team->changes + 1);
    sli_unlock(&team->lock);
}

static void sli_team_body(void *data, sl_int k) {
    sli_team *team = (sli_team *)data;
    sl_int worker;
    (void)k;
    sli_lock(&team->lock);
    worker = team->begun++;
    sli_unlock(&team->lock);
    if (worker > 0) {
        sli_team_draw(team, worker);
        return;
    }
    team->lead(team, team->lead_data);
    sli_lock(&team->lock);
    team->is_over = 1;
    sli_atomic_write(&team->changes, team->changes + 1);
    sli_unlock(&team->lock);
}

/* A team of so many workers, 1 if nobody calls sli_team_run. */
SLI_INLINE sli_team sli_team_of(sl_int workers) {
    sli_team team;
    memset(&team, 0, sizeof team);
    team.workers = workers;
    return team;
}

/* Runs lead(team, data) by so many workers. */
static void sli_team_run(const sl_threads *t, sl_int workers,
                         void (*lead)(sli_team *team, void *data), void *data) {
    sli_team team = sli_team_of(workers);
    if (workers == 1) {
        lead(&team, data);
        return;
    }
    team.lead = lead;
    team.lead_data = data;
    sli_parallel(t, workers, sli_team_body, &team);
}

#endif

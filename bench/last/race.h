/* race.h: the least processor times of calls that are made in turns */
#ifndef BENCH_LAST_RACE_H
#define BENCH_LAST_RACE_H

enum { RACE_MOST = 8 };

/* Something to time. run returns 0, or an error that ends the race. */
typedef struct race_call {
    int (*run)(const void *state);
    const void *state;
} race_call;

/** Times calls in turns for about the given number of seconds.
 *
 *  A turn of a call is some batches, the first of which fills the caches. A batch is of as many
 *  repetitions, the same for all calls, as take 50 microseconds. Every round begins with the next
 *  call.
 *
 *  least  [out]  count seconds of one repetition: the least of all batches.
 *  Returns  0, or what a call returned.
 */
int race(double *least, const race_call *calls, int count, double seconds);

#endif

/* race.c: batches of calls in turns, and the least processor time of each */
#include "race.h"

#include "bench/lib/bench.h"

static const double batch_seconds = 50e-6;
/* Above this time a call fills the caches itself, and a turn is one batch. */
static const double long_batch = 1e-3;
enum { BATCHES = 4, ROUNDS = 4, MOST_REPETITIONS = 1 << 16 };

static int batch(double *seconds, const race_call *call, int repetitions) {
    const double start = bench_processor_seconds();
    int error = 0;
    for (int k = 0; k < repetitions && !error; k++) {
        error = call->run(call->state);
    }
    *seconds = bench_processor_seconds() - start;
    return error;
}

/* Runs each call once, for memory that is touched for the first time, then doubles the
 * repetitions. */
static int calibrate(int *repetitions, double *seconds, const race_call *calls, int count) {
    int error = 0;
    for (int k = 0; k < count && !error; k++) {
        error = batch(seconds, &calls[k], 1);
    }
    *repetitions = 1;
    while (!error) {
        error = batch(seconds, &calls[0], *repetitions);
        if (*seconds >= batch_seconds || *repetitions >= MOST_REPETITIONS) {
            break;
        }
        *repetitions *= 2;
    }
    return error;
}

int race(double *least, const race_call *calls, int count, double seconds) {
    const double end = bench_processor_seconds() + seconds;
    double time;
    int repetitions, error = calibrate(&repetitions, &time, calls, count);
    const int batches = time > long_batch ? 1 : BATCHES;
    for (int k = 0; k < count; k++) {
        least[k] = -1;
    }
    for (int round = 0; !error && (round < ROUNDS || bench_processor_seconds() < end); round++) {
        for (int turn = 0; turn < count && !error; turn++) {
            const int k = (round + turn) % count;
            for (int b = 0; b < batches && !error; b++) {
                error = batch(&time, &calls[k], repetitions);
                if (least[k] < 0 || time < least[k]) {
                    least[k] = time;
                }
            }
        }
    }
    for (int k = 0; k < count; k++) {
        least[k] /= repetitions;
    }
    return error;
}

/* harness.c: clock, side-by-side repetitions, memory, failed checks and pseudo-random numbers */
#define _POSIX_C_SOURCE 200112L
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

#include "bench.h"
#include "tools/io/output_file.h"

enum { MAX_ROUNDS = 100000, MIN_ROUNDS = 3, ONE_ROUND_ABOVE = 4, WARM_UP_ONLY_ABOVE = 20 };

double bench_now(void) {
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

double bench_processor_seconds(void) {
    struct timespec t;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static int by_value(const void *a, const void *b) {
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

bench_sample bench_sample_of(double *times, int count) {
    bench_sample sample = {count, 0, 0, 0};
    if (count == 0) {
        return sample;
    }
    qsort(times, (size_t)count, sizeof *times, by_value);
    sample.min = times[0];
    sample.max = times[count - 1];
    sample.median = 0.5 * (times[(count - 1) / 2] + times[count / 2]);
    return sample;
}

typedef struct time_list {
    double *times;
    int count, room;
} time_list;

static void time_list_push(time_list *list, double seconds) {
    if (list->count == list->room) {
        list->room = list->room ? 2 * list->room : 64;
        list->times = realloc(list->times, (size_t)list->room * sizeof *list->times);
        if (!list->times) {
            bench_must(SL_ERR_MEMORY, "keeping times");
        }
    }
    list->times[list->count++] = seconds;
}

static void run_batch(const bench_contender *c, time_list *list) {
    for (int k = 0; k < (c->batch > 0 ? c->batch : 1); k++) {
        if (c->ready) {
            c->ready(c->state);
        }
        double start = bench_now();
        c->call(c->state);
        double end = bench_now();
        time_list_push(list, end - start);
    }
}

void bench_race(bench_sample *out, const bench_contender *contenders, int count, double seconds) {
    time_list *lists = bench_alloc((size_t)count, sizeof *lists);
    double start = bench_now();
    for (int c = 0; c < count; c++) {
        lists[c].times = NULL;
        lists[c].count = lists[c].room = 0;
        run_batch(&contenders[c], &lists[c]);
    }
    double warm_up = bench_now() - start;
    int min_rounds = warm_up > ONE_ROUND_ABOVE * seconds ? 1 : MIN_ROUNDS;
    for (int c = 0; c < count && warm_up <= WARM_UP_ONLY_ABOVE * seconds; c++) {
        lists[c].count = 0;
    }
    start = bench_now();
    for (int round = 0; round < MAX_ROUNDS && warm_up <= WARM_UP_ONLY_ABOVE * seconds; round++) {
        if (round >= min_rounds && bench_now() - start > seconds) {
            break;
        }
        for (int c = 0; c < count; c++) {
            run_batch(&contenders[c], &lists[c]);
        }
    }
    for (int c = 0; c < count; c++) {
        out[c] = bench_sample_of(lists[c].times, lists[c].count);
        free(lists[c].times);
    }
    free(lists);
}

void *bench_alloc(size_t count, size_t bytes_each) {
    void *block = malloc(count && bytes_each ? count * bytes_each : 1);
    if (!block) {
        bench_must(SL_ERR_MEMORY, "allocating");
    }
    return block;
}

void bench_must(sl_status status, const char *doing) {
    if (status != SL_OK) {
        char text[400];
        fflush(stdout);
        (void)sl_error_text(text, sizeof text, status, NULL);
        fprintf(stderr, "bench: %s: %s\n", doing, text);
        exit(2);
    }
}

static void end_unwritten(const char *message) {
    fflush(stdout);
    fprintf(stderr, "bench: %s\n", message);
    exit(2);
}

FILE *bench_create(const char *path) {
    char message[600];
    FILE *file = output_open(path, message, sizeof message);
    if (!file) {
        end_unwritten(message);
    }
    return file;
}

void bench_close(FILE *file) {
    char message[600];
    if (!output_close(file, message, sizeof message)) {
        end_unwritten(message);
    }
}

int bench_expect(bench_run *run, int held, const char *format, ...) {
    if (!held) {
        va_list arguments;
        va_start(arguments, format);
        printf("  CHECK FAILED: ");
        vprintf(format, arguments);
        printf("\n");
        va_end(arguments);
        run->failures++;
    }
    return held;
}

double bench_fit_exponent(const double *x, const double *y, int count) {
    double sx = 0, sy = 0, sxx = 0, sxy = 0;
    for (int k = 0; k < count; k++) {
        double u = log(x[k]), v = log(y[k]);
        sx += u;
        sy += v;
        sxx += u * u;
        sxy += u * v;
    }
    double variance = count * sxx - sx * sx;
    return variance > 0 ? (count * sxy - sx * sy) / variance : 0;
}

void bench_progress(const char *format, ...) {
    va_list arguments;
    va_start(arguments, format);
    fflush(stdout);
    vfprintf(stderr, format, arguments);
    fflush(stderr);
    va_end(arguments);
}

/* xorshift64*: three xor-shifts, then the high bits of a product */
uint64_t bench_random(uint64_t *state) {
    uint64_t s = *state;
    s ^= s >> 12;
    s ^= s << 25;
    s ^= s >> 27;
    *state = s;
    return s * UINT64_C(2685821657736338717);
}

sl_int bench_random_below(uint64_t *state, sl_int bound) {
    return (sl_int)((bench_random(state) >> 33) % (uint64_t)bound);
}

double bench_random_unit(uint64_t *state) {
    return ((double)(bench_random(state) >> 11) + 0.5) * 0x1p-52 - 1.0;
}

void bench_random_fill(uint64_t *state, double *x, size_t count) {
    for (size_t k = 0; k < count; k++) {
        x[k] = bench_random_unit(state);
    }
}

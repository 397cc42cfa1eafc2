/* app.c: errors, memory, time, progress and random numbers, shared by all commands */
#define _POSIX_C_SOURCE 200809L
#include "app.h"

#include <stdarg.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

static double work_began = -1;  /* app_now at the first app_progress of this work; -1: none */
static bool line_shown = false; /* the terminal shows a progress line */

static void print_error(const char *format, va_list list) {
    app_progress_end();
    (void)fprintf(stderr, "sparse-local: ");
    (void)vfprintf(stderr, format, list);
    (void)fprintf(stderr, "\n");
}

void app_warn(const char *format, ...) {
    char text[512];
    va_list list;
    (void)fflush(stdout); /* in order, if both go to the same file */
    va_start(list, format);
    (void)vsnprintf(text, sizeof text, format, list);
    va_end(list);
    app_progress_end();
    (void)fprintf(stderr, "sparse-local: warning: %s\n", text);
}

void app_die(const char *format, ...) {
    va_list list;
    va_start(list, format);
    print_error(format, list);
    va_end(list);
    exit(1);
}

void app_die_usage(const char *format, ...) {
    va_list list;
    va_start(list, format);
    print_error(format, list);
    va_end(list);
    exit(2);
}

/* Ends a text before the advice to a C program: at the end of the sentence, or of the part of one,
 * that comes before the first name of the header. */
static size_t without_names(char *text) {
    static const char *const names[] = {"sl_", "SL_", "options.", "stats."};
    size_t length = strlen(text);
    for (size_t k = 0; k < sizeof names / sizeof *names; k++) {
        const char *at = strstr(text, names[k]);
        length = at != NULL && (size_t)(at - text) < length ? (size_t)(at - text) : length;
    }
    while (text[length] != '\0' && length > 0 && strchr(".,;:", text[length]) == NULL) {
        length--;
    }
    text[length] = '\0';
    return length;
}

const char *app_error_text(sl_status status, const sl_stats *stats) {
    static char text[400];
    size_t length;
    sl_stats found;
    if (stats == NULL) {
        (void)sl_error_text(text, sizeof text, status, NULL);
        (void)without_names(text);
        return text;
    }
    found = *stats;
    found.error.row = -1; /* rows are vertices here */
    (void)sl_error_text(text, sizeof text, status, &found);
    length = without_names(text);
    if (stats->error.row >= 0 && status != SL_ERR_MEMORY && length < sizeof text) {
        (void)snprintf(text + length, sizeof text - length, " (vertex %d)", (int)stats->error.row);
    }
    return text;
}

void app_must(sl_status status, const char *what, const sl_stats *stats) {
    if (status == SL_OK) {
        return;
    }
    app_die("%s: %s", what, app_error_text(status, stats));
}

void app_detail(const char *format, ...) {
    va_list list;
    va_start(list, format);
    if (options_verbose) {
        (void)vprintf(format, list);
    }
    va_end(list);
}

void *app_alloc(size_t count, size_t size) {
    void *block = calloc(count > 0 ? count : 1, size > 0 ? size : 1);
    if (block == NULL) {
        app_die("out of memory: %zu elements of %zu bytes", count, size);
    }
    return block;
}

void app_print_reads(const char *name, const sl_stats *plan) {
    app_detail("%-10s forward %d rows, %lld entries of L; backward %d rows, %lld entries", name,
               (int)plan->plan.b_columns, (long long)plan->plan.b_entries,
               (int)plan->plan.x_columns, (long long)plan->plan.x_entries);
    if (plan->plan.in_region) {
        app_detail("; %lld of the region's inverse", (long long)plan->plan.region_entries);
    }
    app_detail("\n");
}

void app_print_region(const char *name, const sl_stats *region, double seconds) {
    app_detail("%-10s %d rows in %d subtrees, %d on its boundary; %.1f KB; created in %.2f ms\n",
               name, (int)region->region.rows, (int)region->region.subtrees,
               (int)region->region.boundary, 1e-3 * (double)region->region.bytes, 1e3 * seconds);
}

double app_now(void) {
    struct timespec t;
    (void)clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

double app_processor_ms(void) {
    return 1e3 * (double)clock() / CLOCKS_PER_SEC;
}

void app_progress(const char *what, double fraction) {
    static double shown_at, next_line;
    double now = app_now();
    if (work_began < 0) {
        work_began = now;
        shown_at = now;
        next_line = 10;
    }
    double spent = now - work_began, left = fraction > 0 ? spent / fraction - spent : 0;
    if (isatty(2) && spent >= 1 && now - shown_at >= 0.1) {
        (void)fprintf(stderr, "\r%s: %3.0f%%, about %.0f s left  ", what, 100 * fraction, left);
        shown_at = now;
        line_shown = true;
    } else if (!isatty(2) && spent >= next_line) {
        (void)fprintf(stderr, "%s: %.0f%% after %.0f s, about %.0f s left\n", what, 100 * fraction,
                      spent, left);
        next_line = 2 * spent;
    }
}

void app_stage(const char *what) {
    if (isatty(2)) {
        (void)fprintf(stderr, "\r%s ...", what);
        line_shown = true;
    }
}

void app_stage_factor(double flops) {
    const double flops_per_second = 4e9; /* of one thread; slower processors take longer */
    char text[80];
    double seconds = flops / flops_per_second;
    if (seconds >= 1) {
        (void)snprintf(text, sizeof text, "factoring, about %.0f s", seconds);
        app_stage(text);
    } else {
        app_stage("factoring");
    }
}

void app_progress_end(void) {
    if (line_shown) {
        (void)fprintf(stderr, "\r%60s\r", "");
    }
    line_shown = false;
    work_began = -1;
}

/* SplitMix64 [Steele, Lea, Flood: Fast splittable pseudorandom number generators, 2014] */
uint64_t app_random(uint64_t *state) {
    *state += 0x9e3779b97f4a7c15u;
    uint64_t z = *state;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return z ^ (z >> 31);
}

sl_int app_random_below(uint64_t *state, sl_int below) {
    return below > 0 ? (sl_int)(app_random(state) % (uint64_t)below) : 0;
}

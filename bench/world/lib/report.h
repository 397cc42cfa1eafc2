/* report.h: what the programs of the recipes print: the numbers of a feature, and processor time */
#ifndef WORLD_REPORT_H
#define WORLD_REPORT_H

#include <stdio.h>
#include <time.h>

/* A feature has one name and any number of numbers. */
static inline void report(const char *feature, double value) {
    printf("%s %.17g\n", feature, value);
}

static inline double seconds(void) {
    return (double)clock() / CLOCKS_PER_SEC;
}

static inline void report_time(double value) {
    printf("time %.6f\n", value);
}

#endif

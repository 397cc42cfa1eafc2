/* machine.c: writes what the bench ran on: date, processor, compiler, and the measured limits */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "bench.h"

#if defined(__GNUC__) && !defined(__clang__) /* __VERSION__ of clang includes its name */
#define COMPILER "gcc "
#else
#define COMPILER ""
#endif
#if defined(__VERSION__)
#define COMPILER_VERSION __VERSION__
#else
#define COMPILER_VERSION "unknown"
#endif

/* The first value of a key in /proc/cpuinfo, or "unknown". */
static const char *processor(const char *key, char *value, size_t size) {
    const size_t length = strlen(key);
    char line[256];
    FILE *f = fopen("/proc/cpuinfo", "r");
    snprintf(value, size, "unknown");
    while (f && fgets(line, (int)sizeof line, f)) {
        const char *colon = strchr(line, ':');
        if (colon && strncmp(line, key, length) == 0 && line[length] == '\t') {
            snprintf(value, size, "%s", colon + 2);
            value[strcspn(value, "\n")] = '\0';
            break;
        }
    }
    if (f) {
        fclose(f);
    }
    return value;
}

/* Programs that ran in the last minute, this one among them; "unknown" without /proc. */
static const char *load(char *value, size_t size) {
    FILE *f = fopen("/proc/loadavg", "r");
    snprintf(value, size, "unknown");
    if (f && fgets(value, (int)size, f)) {
        value[strcspn(value, " ")] = '\0';
    }
    if (f) {
        fclose(f);
    }
    return value;
}

void bench_machine_write(const bench_run *run, const char *name) {
    static const double sizes[] = {32e3, 512e3, 256e6};
    const char *commit = getenv("BENCH_COMMIT");
    char path[512], text[128], family[32], model[32], running[64], date[32];
    const time_t now = time(NULL);
    const struct tm *utc = gmtime(&now);
    snprintf(path, sizeof path, "%s/%s.machine.txt", run->out_dir, name);
    FILE *f = bench_create(path);
    strftime(date, sizeof date, "%Y-%m-%d", utc);
    fprintf(f, "date: %s\ncommit: %s\nmachine: %s\nfamily, model: %s, %s\n", date,
            commit && commit[0] ? commit : "unknown",
            processor("model name", text, sizeof text),
            processor("cpu family", family, sizeof family),
            processor("model", model, sizeof model));
    fprintf(f, "instruction set: %s\ncompiler: %s%s\n", bench_isa_name(bench_isa_best()),
            COMPILER, COMPILER_VERSION);
    fprintf(f, "load: %s\n", load(running, sizeof running));
    fprintf(f, "one core: %.0f GFlop/s", bench_peak(SL_ISA_AUTO) * 1e-9);
    if (bench_peak(SL_ISA_AVX512) > 0) {
        fprintf(f, " with AVX-512 and %.0f with AVX2", bench_peak(SL_ISA_AVX2) * 1e-9);
    }
    fprintf(f,
            "; it reads %.0f GB/s from the first-level cache, %.0f from the second-level cache, "
            "and %.0f from memory\n",
            bench_bandwidth(sizes[0]) * 1e-9, bench_bandwidth(sizes[1]) * 1e-9,
            bench_bandwidth(sizes[2]) * 1e-9);
    bench_close(f);
}

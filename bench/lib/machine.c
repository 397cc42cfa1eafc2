/* machine.c: writes what the bench ran on: date, processor, compiler, and the measured limits */
#include <stdio.h>
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

/* The first "model name" of /proc/cpuinfo, or "unknown". */
static void processor_name(char *name, size_t size) {
    char line[256];
    FILE *f = fopen("/proc/cpuinfo", "r");
    snprintf(name, size, "unknown");
    while (f && fgets(line, (int)sizeof line, f)) {
        const char *colon = strchr(line, ':');
        if (colon && strncmp(line, "model name", 10) == 0) {
            snprintf(name, size, "%s", colon + 2);
            name[strcspn(name, "\n")] = '\0';
            break;
        }
    }
    if (f) {
        fclose(f);
    }
}

void bench_machine_write(const bench_run *run, const char *name) {
    static const double sizes[] = {32e3, 512e3, 256e6};
    char path[512], processor[128], date[32];
    const time_t now = time(NULL);
    const struct tm *utc = gmtime(&now);
    snprintf(path, sizeof path, "%s/%s.machine.txt", run->out_dir, name);
    FILE *f = bench_create(path);
    processor_name(processor, sizeof processor);
    strftime(date, sizeof date, "%Y-%m-%d", utc);
    fprintf(f, "%s; %s; %s%s", date, processor, COMPILER, COMPILER_VERSION);
    fprintf(f, "; one core: %.0f GFlop/s", bench_peak(SL_ISA_AUTO) * 1e-9);
    if (bench_peak(SL_ISA_AVX512) > 0) {
        fprintf(f, " with AVX-512, %.0f with AVX2", bench_peak(SL_ISA_AVX2) * 1e-9);
    }
    fprintf(f,
            ", reads %.0f / %.0f / %.0f GB/s from the first-level cache / second-level cache / "
            "memory\n",
            bench_bandwidth(sizes[0]) * 1e-9, bench_bandwidth(sizes[1]) * 1e-9,
            bench_bandwidth(sizes[2]) * 1e-9);
    bench_close(f);
}

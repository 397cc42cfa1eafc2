/* bandwidth.c: measures the read bandwidth of one core by block size, the limit of solves */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "bench.h"

/* A solve that reads L once per sweep cannot be faster than this loop over the same number of
 * bytes: a sum with enough accumulators that only the loads take time. The blocks grow fourfold,
 * from the first cache to main memory. */
enum { STEPS = 8, LANES = 4, CHAINS = 8, FIRST_BYTES = 16 * 1024 };

static double rates[STEPS];

#if defined(__GNUC__)
typedef double lanes __attribute__((vector_size(8 * LANES)));
#define ADD(sum, at) \
    do { \
        lanes v; \
        memcpy(&v, (at), sizeof v); \
        (sum) += v; \
    } while (0)
#define SUM_BODY \
    lanes sum[CHAINS]; \
    memset(sum, 0, sizeof sum); \
    for (size_t k = 0; k < count; k += LANES * CHAINS) { \
        ADD(sum[0], x + k); \
        ADD(sum[1], x + k + LANES); \
        ADD(sum[2], x + k + 2 * LANES); \
        ADD(sum[3], x + k + 3 * LANES); \
        ADD(sum[4], x + k + 4 * LANES); \
        ADD(sum[5], x + k + 5 * LANES); \
        ADD(sum[6], x + k + 6 * LANES); \
        ADD(sum[7], x + k + 7 * LANES); \
    } \
    lanes all = ((sum[0] + sum[1]) + (sum[2] + sum[3])) + ((sum[4] + sum[5]) + (sum[6] + sum[7])); \
    return all[0] + all[1] + all[2] + all[3];
#else
#define SUM_BODY \
    double sum[LANES * CHAINS] = {0}, all = 0; \
    for (size_t k = 0; k < count; k += LANES * CHAINS) \
        for (int l = 0; l < LANES * CHAINS; l++) \
            sum[l] += x[k + (size_t)l]; \
    for (int l = 0; l < LANES * CHAINS; l++) \
        all += sum[l]; \
    return all;
#endif

static double sum_baseline(const double *x, size_t count) {
    SUM_BODY
}

#if defined(__GNUC__) && defined(__x86_64__)
__attribute__((target("avx2"))) static double sum_avx2(const double *x, size_t count) {
    SUM_BODY
}
#endif

typedef double (*sum_function)(const double *x, size_t count);

/* Chosen once: whether an instruction set is present takes longer to say than to read a small
 * block. */
static sum_function sum_of_blocks(void) {
#if defined(__GNUC__) && defined(__x86_64__)
    if (bench_isa_is_present(SL_ISA_AVX2)) {
        return sum_avx2;
    }
#endif
    return sum_baseline;
}

void bench_bandwidth_measure(bench_run *run) {
    size_t largest = (size_t)FIRST_BYTES << (2 * (STEPS - 1));
    const sum_function sum_block = sum_of_blocks();
    double *x = bench_alloc(largest, 1);
    double sum = 0;
    memset(x, 0, largest);
    printf("read bandwidth of one core by block size:");
    for (int step = 0; step < STEPS; step++) {
        size_t bytes = (size_t)FIRST_BYTES << (2 * step);
        int passes =
            (int)(largest / bytes / 8) + 1; /* the same number of bytes per sample in every step */
        double best = 0;
        for (int sample = 0; sample < 5; sample++) {
            double start = bench_now();
            for (int pass = 0; pass < passes; pass++) {
                sum += sum_block(x, bytes / sizeof *x);
                x[0] = sum; /* always 0, but unknown to the compiler: every pass must read again */
            }
            double rate = (double)bytes * passes / (bench_now() - start);
            best = rate > best ? rate : best;
        }
        rates[step] = best;
        if (bytes < (size_t)1 << 20) {
            printf(" %zu KiB %.0f", bytes >> 10, best * 1e-9);
        } else {
            printf(" %zu MiB %.0f", bytes >> 20, best * 1e-9);
        }
        printf(step + 1 < STEPS ? "," : " GB/s\n");
    }
    free(x);
    bench_expect(run, rates[0] >= rates[STEPS - 1],
                 "a block of %d bytes is read more slowly than memory", (int)FIRST_BYTES);
}

double bench_bandwidth(double bytes) {
    /* linear interpolation between the measured sizes, both axes logarithmic */
    double step = log2(bytes / FIRST_BYTES) / 2;
    int below = step < 0 ? 0 : step >= STEPS - 1 ? STEPS - 2 : (int)step;
    double t = step - below < 0 ? 0 : step - below > 1 ? 1 : step - below;
    return rates[below] * pow(rates[below + 1] / rates[below], t);
}

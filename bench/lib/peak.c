/* peak.c: how many floating-point operations a second one core can do here, by ISA, the limit of dense kernels */
#include <math.h>
#include <stdio.h>

#include "bench.h"

#if defined(__GNUC__) && defined(__x86_64__)
#include <immintrin.h>
#elif defined(__aarch64__)
#include <arm_neon.h>
#endif

/* x := x a + b on registers alone, in so many chains that neither latency nor a lack of registers is waited for.
 * Every chain starts elsewhere and all are stored, so none can be left out; the values are checked against the same
 * recurrence done one by one. A fused multiply-add counts as 2 operations, as does an entry's part in the flops of a
 * factorization: the sum over columns of (entries)^2 is twice the multiply-adds. */
enum { CHAINS = 12, MOST_LANES = 8, SAMPLES = 7, ROUNDS = 400000, CHECK_ROUNDS = 1000, ISAS = 5 };

static const double a_of_chains = 0.999755859375, b_of_chains = 0.0009765625; /* fixed point 4 */

/* A loop for one ISA: words of its own, lanes doubles in a register. x: CHAINS x lanes. */
#define PEAK_LOOP(name, attribute, type, lanes, load, store, broadcast, fma)                       \
    attribute static void name(double *x, long rounds) {                                           \
        const type a = broadcast(a_of_chains), b = broadcast(b_of_chains);                         \
        TWELVE_DECLARED(type, load, lanes)                                                         \
        for (long k = 0; k < rounds; k++) {                                                        \
            TWELVE_STEPS(fma)                                                                      \
        }                                                                                          \
        TWELVE_STORED(store, lanes)                                                                \
    }
#define TWELVE_DECLARED(type, load, lanes)                                                         \
    type c0 = load(x), c1 = load(x + (lanes)), c2 = load(x + 2 * (lanes)),                         \
         c3 = load(x + 3 * (lanes)), c4 = load(x + 4 * (lanes)), c5 = load(x + 5 * (lanes)),       \
         c6 = load(x + 6 * (lanes)), c7 = load(x + 7 * (lanes)), c8 = load(x + 8 * (lanes)),       \
         c9 = load(x + 9 * (lanes)), c10 = load(x + 10 * (lanes)), c11 = load(x + 11 * (lanes));
#define TWELVE_STEPS(fma)                                                                          \
    c0 = fma(c0, a, b);                                                                            \
    c1 = fma(c1, a, b);                                                                            \
    c2 = fma(c2, a, b);                                                                            \
    c3 = fma(c3, a, b);                                                                            \
    c4 = fma(c4, a, b);                                                                            \
    c5 = fma(c5, a, b);                                                                            \
    c6 = fma(c6, a, b);                                                                            \
    c7 = fma(c7, a, b);                                                                            \
    c8 = fma(c8, a, b);                                                                            \
    c9 = fma(c9, a, b);                                                                            \
    c10 = fma(c10, a, b);                                                                          \
    c11 = fma(c11, a, b);
#define TWELVE_STORED(store, lanes)                                                                \
    store(x, c0);                                                                                  \
    store(x + (lanes), c1);                                                                        \
    store(x + 2 * (lanes), c2);                                                                    \
    store(x + 3 * (lanes), c3);                                                                    \
    store(x + 4 * (lanes), c4);                                                                    \
    store(x + 5 * (lanes), c5);                                                                    \
    store(x + 6 * (lanes), c6);                                                                    \
    store(x + 7 * (lanes), c7);                                                                    \
    store(x + 8 * (lanes), c8);                                                                    \
    store(x + 9 * (lanes), c9);                                                                    \
    store(x + 10 * (lanes), c10);                                                                  \
    store(x + 11 * (lanes), c11);

#if defined(__GNUC__) && defined(__x86_64__)
#define APART(x, a, b) _mm_add_pd(_mm_mul_pd((x), (a)), (b)) /* what plain x86-64 has: two steps */
PEAK_LOOP(loop_scalar, , __m128d, 2, _mm_loadu_pd, _mm_storeu_pd, _mm_set1_pd, APART)
PEAK_LOOP(loop_avx2, __attribute__((target("avx2,fma"))), __m256d, 4, _mm256_loadu_pd,
          _mm256_storeu_pd, _mm256_set1_pd, _mm256_fmadd_pd)
PEAK_LOOP(loop_avx512, __attribute__((target("avx512f"))), __m512d, 8, _mm512_loadu_pd,
          _mm512_storeu_pd, _mm512_set1_pd, _mm512_fmadd_pd)
#else
#define ITSELF(x) (x)
#define FROM(p) (*(p))
#define INTO(p, x) (*(p) = (x))
#define APART(x, a, b) ((x) * (a) + (b))
PEAK_LOOP(loop_scalar, , double, 1, FROM, INTO, ITSELF, APART)
#if defined(__aarch64__)
#define FUSED(x, a, b) vfmaq_f64((b), (x), (a))
PEAK_LOOP(loop_neon, , float64x2_t, 2, vld1q_f64, vst1q_f64, vdupq_n_f64, FUSED)
#endif
#endif

static double peaks[ISAS];

static int has(sl_isa isa) {
#if defined(__GNUC__) && defined(__x86_64__)
    return isa == SL_ISA_SCALAR ||
           (isa == SL_ISA_AVX2 && __builtin_cpu_supports("avx2") &&
            __builtin_cpu_supports("fma")) ||
           (isa == SL_ISA_AVX512 && __builtin_cpu_supports("avx512f"));
#elif defined(__aarch64__)
    return isa == SL_ISA_SCALAR || isa == SL_ISA_NEON;
#else
    return isa == SL_ISA_SCALAR;
#endif
}

/* Returns the lanes of the ISA. */
static int run_loop(sl_isa isa, double *x, long rounds) {
#if defined(__GNUC__) && defined(__x86_64__)
    if (isa == SL_ISA_AVX512) {
        loop_avx512(x, rounds);
        return 8;
    }
    if (isa == SL_ISA_AVX2) {
        loop_avx2(x, rounds);
        return 4;
    }
    loop_scalar(x, rounds);
    return 2;
#else
#if defined(__aarch64__)
    if (isa == SL_ISA_NEON) {
        loop_neon(x, rounds);
        return 2;
    }
#endif
    (void)isa;
    loop_scalar(x, rounds);
    return 1;
#endif
}

static void start_values(double *x) {
    for (int k = 0; k < CHAINS * MOST_LANES; k++) {
        x[k] = 1.0 + 0.01 * k;
    }
}

/* Every chain came to what the recurrence gives, so all its steps were done. */
static void check_loop(bench_run *run, sl_isa isa) {
    double x[CHAINS * MOST_LANES], y[CHAINS * MOST_LANES], apart = 0;
    start_values(x);
    start_values(y);
    int count = CHAINS * run_loop(isa, x, CHECK_ROUNDS);
    for (int k = 0; k < count; k++) {
        for (int round = 0; round < CHECK_ROUNDS; round++) {
            y[k] = y[k] * a_of_chains + b_of_chains;
        }
        apart = fmax(apart, fabs(x[k] - y[k]));
    }
    bench_expect(run, apart < 1e-12 && fabs(x[count - 1] - 1.0 - 0.01 * (count - 1)) > 1e-3,
                 "peak of %s: off by %.2g", bench_isa_name(isa), apart);
}

void bench_peak_measure(bench_run *run) {
    static const sl_isa isas[] = {SL_ISA_SCALAR, SL_ISA_AVX2, SL_ISA_AVX512, SL_ISA_NEON};
    const char *separator = "";
    printf("one core multiplies and adds, registers only:");
    for (size_t c = 0; c < sizeof isas / sizeof *isas; c++) {
        double x[CHAINS * MOST_LANES], best = 0;
        if (!has(isas[c])) {
            continue;
        }
        check_loop(run, isas[c]);
        for (int sample = 0; sample < SAMPLES; sample++) {
            start_values(x);
            double start = bench_now();
            int lanes = run_loop(isas[c], x, ROUNDS);
            double rate = 2.0 * CHAINS * lanes * ROUNDS / (bench_now() - start);
            best = rate > best ? rate : best;
        }
        peaks[isas[c]] = best;
        printf("%s %s %.1f", separator, bench_isa_name(isas[c]), best * 1e-9);
        separator = ",";
    }
    printf(" GFlop/s\n");
}

double bench_peak(sl_isa isa) {
    double best = 0;
    if (isa > SL_ISA_AUTO && (size_t)isa < ISAS) {
        return peaks[isa];
    }
    for (int c = 0; c < ISAS; c++) {
        best = peaks[c] > best ? peaks[c] : best;
    }
    return best;
}

/* peak.c: instruction sets: their names, and the floating-point rate of one core with each */
#include <math.h>
#include <stdio.h>

#include "bench.h"

#if defined(__GNUC__) && defined(__x86_64__)
#include <immintrin.h>
#elif defined(__aarch64__)
#include <arm_neon.h>
#endif

/* x := x a + b on registers alone, in enough independent chains to hide the latency, few enough
 * to stay in registers. Every chain has its own start value and all are stored, so the compiler
 * can drop none; the results are compared with the same recurrence computed in scalar code. A
 * fused multiply-add counts as 2 operations. The flops of a factorization count alike: the sum
 * over columns of entries^2 is twice the number of multiply-adds. */
enum { CHAINS = 12, MAX_LANES = 8, SAMPLES = 7, ROUNDS = 400000, CHECK_ROUNDS = 1000 };

static const double a_of_chains = 0.999755859375,
                    b_of_chains = 0.0009765625; /* the fixed point is 4 */

/* Defines the loop for one instruction set, in terms of its intrinsics; lanes is the number of
 * doubles in a register. x: CHAINS x lanes. */
#define PEAK_LOOP(name, attribute, type, lanes, load, store, broadcast, fma) \
    attribute static void name(double *x, long rounds) { \
        const type a = broadcast(a_of_chains), b = broadcast(b_of_chains); \
        DECLARE_CHAINS(type, load, lanes) \
        for (long k = 0; k < rounds; k++) { \
            STEP_CHAINS(fma) \
        } \
        STORE_CHAINS(store, lanes) \
    }
#define DECLARE_CHAINS(type, load, lanes) \
    type c0 = load(x), c1 = load(x + (lanes)), c2 = load(x + 2 * (lanes)), \
         c3 = load(x + 3 * (lanes)), c4 = load(x + 4 * (lanes)), c5 = load(x + 5 * (lanes)), \
         c6 = load(x + 6 * (lanes)), c7 = load(x + 7 * (lanes)), c8 = load(x + 8 * (lanes)), \
         c9 = load(x + 9 * (lanes)), c10 = load(x + 10 * (lanes)), c11 = load(x + 11 * (lanes));
#define STEP_CHAINS(fma) \
    c0 = fma(c0, a, b); \
    c1 = fma(c1, a, b); \
    c2 = fma(c2, a, b); \
    c3 = fma(c3, a, b); \
    c4 = fma(c4, a, b); \
    c5 = fma(c5, a, b); \
    c6 = fma(c6, a, b); \
    c7 = fma(c7, a, b); \
    c8 = fma(c8, a, b); \
    c9 = fma(c9, a, b); \
    c10 = fma(c10, a, b); \
    c11 = fma(c11, a, b);
#define STORE_CHAINS(store, lanes) \
    store(x, c0); \
    store(x + (lanes), c1); \
    store(x + 2 * (lanes), c2); \
    store(x + 3 * (lanes), c3); \
    store(x + 4 * (lanes), c4); \
    store(x + 5 * (lanes), c5); \
    store(x + 6 * (lanes), c6); \
    store(x + 7 * (lanes), c7); \
    store(x + 8 * (lanes), c8); \
    store(x + 9 * (lanes), c9); \
    store(x + 10 * (lanes), c10); \
    store(x + 11 * (lanes), c11);

#if defined(__GNUC__) && defined(__x86_64__)
#define MUL_ADD(x, a, b) \
    _mm_add_pd(_mm_mul_pd((x), (a)), (b)) /* plain x86-64 has no fused multiply-add */
PEAK_LOOP(loop_scalar, , __m128d, 2, _mm_loadu_pd, _mm_storeu_pd, _mm_set1_pd, MUL_ADD)
PEAK_LOOP(loop_avx2, __attribute__((target("avx2,fma"))), __m256d, 4, _mm256_loadu_pd,
          _mm256_storeu_pd, _mm256_set1_pd, _mm256_fmadd_pd)
PEAK_LOOP(loop_avx512, __attribute__((target("avx512f"))), __m512d, 8, _mm512_loadu_pd,
          _mm512_storeu_pd, _mm512_set1_pd, _mm512_fmadd_pd)
#else
#define SET1(x) (x)
#define LOAD(p) (*(p))
#define STORE(p, x) (*(p) = (x))
#define MUL_ADD(x, a, b) ((x) * (a) + (b))
PEAK_LOOP(loop_scalar, , double, 1, LOAD, STORE, SET1, MUL_ADD)
#if defined(__aarch64__)
#define FMA(x, a, b) vfmaq_f64((b), (x), (a))
PEAK_LOOP(loop_neon, , float64x2_t, 2, vld1q_f64, vst1q_f64, vdupq_n_f64, FMA)
#endif
#endif

/* Instruction sets by their sl_isa. Those of other processors have no loop. */
static const struct {
    const char *name;
    void (*loop)(double *x, long rounds);
    int lanes; /* doubles in a register */
} isas[] = {
    [SL_ISA_AUTO] = {"auto", NULL, 0},
#if defined(__GNUC__) && defined(__x86_64__)
    [SL_ISA_SCALAR] = {"scalar", loop_scalar, 2},
    [SL_ISA_AVX2] = {"avx2", loop_avx2, 4},
    [SL_ISA_AVX512] = {"avx512", loop_avx512, 8},
#else
    [SL_ISA_SCALAR] = {"scalar", loop_scalar, 1},
    [SL_ISA_AVX2] = {"avx2", NULL, 0},
    [SL_ISA_AVX512] = {"avx512", NULL, 0},
#endif
#if defined(__aarch64__)
    [SL_ISA_NEON] = {"neon", loop_neon, 2},
#else
    [SL_ISA_NEON] = {"neon", NULL, 0},
#endif
};
enum { ISAS = sizeof isas / sizeof *isas };

static double peaks[ISAS];

const char *bench_isa_name(sl_isa isa) {
    return (size_t)isa < ISAS ? isas[isa].name : "?";
}

/* The instruction set of a factor that asks for `isa`; SL_ISA_AUTO: there is none. */
static sl_isa isa_of_factor(sl_isa isa) {
    static const sl_int p[2] = {0, 1}, i[1] = {0};
    static const double x[1] = {1.0};
    const sl_csc one = {1, 1, p, i, x};
    const sl_options options = {.isa = isa};
    sl_symbolic *S = NULL;
    sl_factor *F = NULL;
    sl_stats stats;
    bench_must(sl_symbolic_create(&S, &one, NULL, NULL), "analysis of one row");
    const sl_status status = sl_factor_create(&F, S, &one, &options, &stats);
    sl_factor_free(F);
    sl_symbolic_free(S);
    return status == SL_OK ? stats.factor.isa : SL_ISA_AUTO;
}

int bench_isa_is_present(sl_isa isa) {
    return isa_of_factor(isa) != SL_ISA_AUTO;
}

sl_isa bench_isa_best(void) {
    return isa_of_factor(SL_ISA_AUTO);
}

static void start_values(double *x) {
    for (int k = 0; k < CHAINS * MAX_LANES; k++) {
        x[k] = 1.0 + 0.01 * k;
    }
}

/* Every chain ends at the value of the recurrence, so the loop did all its steps. */
static void check_loop(bench_run *run, sl_isa isa) {
    double x[CHAINS * MAX_LANES], y[CHAINS * MAX_LANES], error = 0;
    start_values(x);
    start_values(y);
    const int count = CHAINS * isas[isa].lanes;
    isas[isa].loop(x, CHECK_ROUNDS);
    for (int k = 0; k < count; k++) {
        for (int round = 0; round < CHECK_ROUNDS; round++) {
            y[k] = y[k] * a_of_chains + b_of_chains;
        }
        error = fmax(error, fabs(x[k] - y[k]));
    }
    bench_expect(run, error < 1e-12 && fabs(x[count - 1] - 1.0 - 0.01 * (count - 1)) > 1e-3,
                 "peak loop, %s: error %.2g", bench_isa_name(isa), error);
}

void bench_peak_measure(bench_run *run) {
    const char *separator = "";
    printf("multiply-add rate of one core, registers only:");
    for (size_t isa = SL_ISA_SCALAR; isa < ISAS; isa++) {
        double x[CHAINS * MAX_LANES], best = 0;
        if (!isas[isa].loop || !bench_isa_is_present((sl_isa)isa)) {
            continue;
        }
        check_loop(run, (sl_isa)isa);
        for (int sample = 0; sample < SAMPLES; sample++) {
            start_values(x);
            double start = bench_now();
            isas[isa].loop(x, ROUNDS);
            double rate = 2.0 * CHAINS * isas[isa].lanes * ROUNDS / (bench_now() - start);
            best = rate > best ? rate : best;
        }
        peaks[isa] = best;
        printf("%s %s %.1f", separator, isas[isa].name, best * 1e-9);
        separator = ",";
    }
    printf(" GFlop/s\n");
}

double bench_peak(sl_isa isa) {
    double best = 0;
    if (isa > SL_ISA_AUTO) {
        return (size_t)isa < ISAS ? peaks[isa] : 0;
    }
    for (size_t c = 0; c < ISAS; c++) {
        best = peaks[c] > best ? peaks[c] : best;
    }
    return best;
}

/* base.h: the system headers, everything that depends on the compiler, and small integer helpers */
#ifndef SLI_BASE_H
#define SLI_BASE_H

#include "../public/config.h"

#if defined(__FAST_MATH__) || defined(_M_FP_FAST) ||                                               \
    (defined(__FINITE_MATH_ONLY__) && __FINITE_MATH_ONLY__ > 0)
#error "sparse_local.h: compile its bodies without -ffast-math, which takes the checks for NaN away"
#endif

#include <errno.h>
#include <float.h>
#include <locale.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

/* AVX tables need per-function targets and correctly aligned vector spills: MSVC has no attribute,
 * MinGW misaligns. */
#if (defined(__x86_64__) || defined(__i386__)) && defined(__GNUC__) && !defined(_WIN32)
#define SLI_X86 1
#include <cpuid.h>
#include <immintrin.h>
#endif
#if defined(__aarch64__) && defined(__ARM_NEON)
#define SLI_ARM 1
#include <arm_neon.h>
#endif

/* Linux's madvise under a name of our own, as -std=c99 hides its header's. */
#if defined(__linux__) && defined(__GNUC__)
#define SLI_HUGE_PAGES 14
extern int sli_madvise(void *block, size_t bytes, int advice) __asm__("madvise");
#endif

#if defined(__GNUC__)
#define SLI_INLINE __attribute__((unused)) static inline
/* for bodies that are worth it only with a constant argument folded into them */
#define SLI_ALWAYS_INLINE __attribute__((unused, always_inline)) static inline
#define SLI_APART __attribute__((unused, noinline)) /* what hot code must not carry along */
#define SLI_TARGET(list) __attribute__((target(list)))
#define SLI_ALIGNED(variable) variable __attribute__((aligned(64)))
/* the cache line some bytes from p, which need not exist: asking for it has no other effect */
#define SLI_PREFETCH(p, bytes)                                                                     \
    __builtin_prefetch((const void *)((uintptr_t)(p) + (uintptr_t)(bytes)))
#define SLI_UNROLL _Pragma("GCC unroll 8") /* of the loop that follows, which has at most 8 turns */
#else
#define SLI_INLINE static inline
#define SLI_ALWAYS_INLINE static inline
#define SLI_APART
#define SLI_TARGET(list)
#define SLI_ALIGNED(variable) variable
#define SLI_PREFETCH(p, bytes) ((void)0)
#define SLI_UNROLL
#endif

/* States a precondition; SL_VERIFY builds prove it. */
#if defined(SL_VERIFY)
#define SLI_ASSERT(condition) ((condition) ? (void)0 : abort())
#else
#define SLI_ASSERT(condition) ((void)0)
#endif

/* Most rows or columns of a matrix: rounded up to whole tiles of 8 they fit an sl_int, and so does
 * the n + 1 after a loop that includes n. */
#define SLI_ROWS_MAX (INT32_MAX - 7)

SLI_INLINE sl_int sli_min(sl_int a, sl_int b) {
    return a < b ? a : b;
}

SLI_INLINE sl_int sli_max(sl_int a, sl_int b) {
    return a > b ? a : b;
}

/* a clamped to 0..high */
SLI_INLINE sl_int sli_clamp(sl_int a, sl_int high) {
    return a < 0 ? 0 : a > high ? high : a;
}

SLI_INLINE int sli_is_finite(double a) {
    return a - a == 0.0;
}

/* Seconds of processor time since some moment: C99 has no other clock. */
SLI_INLINE double sli_seconds(void) {
    return (double)clock() / (double)CLOCKS_PER_SEC;
}

#endif

/* base.h: system headers, everything that depends on the compiler, small helpers for integers */
#ifndef SLI_BASE_BASE_H
#define SLI_BASE_BASE_H

#include "../../public/config.h"

#if defined(__FAST_MATH__) || defined(_M_FP_FAST) || \
    (defined(__FINITE_MATH_ONLY__) && __FINITE_MATH_ONLY__ > 0)
#error "sparse_local.h: compile the implementation without -ffast-math: it removes the NaN checks"
#endif

#include <errno.h>
#include <float.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#if !defined(SL_NO_CLOCK)
#include <time.h>
#endif
#if defined(SL_PTHREADS)
#include <pthread.h>
#endif

#if defined(SL_METIS) && !defined(SL_NO_METIS)
#define SLI_METIS 1
#endif

/* gcc and clang, which in the dialect of MSVC does not say __GNUC__: attributes and builtins. */
#if defined(__GNUC__) || defined(__clang__)
#define SLI_GNU 1
#endif

/* AVX kernels need correctly aligned spills of vectors, which gcc for Windows does not have (its
 * bug 54412), and attributes of functions that name the instruction set. MSVC compiles intrinsics
 * without the attribute; its version 19.38 is said to miscompile such code. */
#if defined(SL_NO_SIMD)
#elif defined(__clang__) || (defined(__GNUC__) && !defined(_WIN32))
#if defined(__x86_64__) || defined(__i386__)
#define SLI_X86 1
#include <immintrin.h>
#if defined(_MSC_VER) /* there immintrin.h includes only what the command line enables */
#include <smmintrin.h>
#include <avxintrin.h>
#include <avx2intrin.h>
#include <avx512fintrin.h>
#include <fmaintrin.h>
#endif
#elif defined(__aarch64__) && defined(__ARM_NEON)
#define SLI_ARM 1
#include <arm_neon.h>
#endif
#elif defined(_MSC_VER)
#if defined(_M_X64) && !defined(_M_ARM64EC) && _MSC_VER >= 1920 && _MSC_VER != 1938
#define SLI_X86 1
#include <immintrin.h>
#include <intrin.h>
#elif defined(_M_ARM64)
#define SLI_ARM 1
#include <arm_neon.h>
#endif
#endif

#if defined(SLI_X86) && !defined(SL_NO_AVX512)
#define SLI_AVX512 1
#endif

/* Are there kernels beside plain C? */
#if defined(SLI_X86) || defined(SLI_ARM)
#define SLI_SIMD 1
#endif

#if defined(__BYTE_ORDER__) && __BYTE_ORDER__ == __ORDER_BIG_ENDIAN__
#define SLI_BIG_ENDIAN 1
#endif

/* Functions of Linux under names of this library, because -std=c99 hides their declarations. */
#if defined(__linux__) && defined(__GNUC__)
#define SLI_HUGE_PAGES 14
#define SLI_POPULATE 23
extern int sli_madvise(void *block, size_t bytes, int advice) __asm__("madvise");
#define SLI_FSYNC 1
extern ptrdiff_t sli_readlink(const char *path, char *to, size_t size) __asm__("readlink");
extern int sli_fsync(int file) __asm__("fsync");
extern int sli_fileno(FILE *file) __asm__("fileno");
extern FILE *sli_fdopen(int file, const char *mode) __asm__("fdopen");
extern int sli_linkat(int from_folder, const char *from, int to_folder, const char *to,
                      int flags) __asm__("linkat");
#define SLI_USLEEP 1
extern int sli_usleep(unsigned microseconds) __asm__("usleep");
#endif

/* Storage of one thread. Without it, texts of errors reach the caller in stats only. */
#if defined(SL_NO_THREAD_LOCAL)
#elif defined(SLI_GNU)
#define SLI_THREAD_LOCAL __thread
#elif defined(_MSC_VER)
#define SLI_THREAD_LOCAL __declspec(thread)
#endif

/* POSIX systems: what a path is and who may read it. */
#if defined(__unix__) || defined(__APPLE__)
#define SLI_POSIX 1
#include <fcntl.h>
#include <sched.h>
#include <sys/stat.h>
#include <unistd.h>
#if !defined(SL_NO_MMAP)
#define SLI_MMAP 1
#include <sys/mman.h>
#endif
#endif

/* Functions of Windows, as <windows.h> declares them; that header defines too many macros. */
#if defined(_WIN32)
#define SLI_WINDOWS 1
#include <io.h>
#if defined(__cplusplus)
extern "C" {
#endif
__declspec(dllimport) int __stdcall MoveFileExA(const char *from, const char *to,
                                                unsigned long flags);
__declspec(dllimport) unsigned long __stdcall GetFileAttributesA(const char *path);
__declspec(dllimport) void __stdcall Sleep(unsigned long milliseconds);
#if !defined(SL_NO_MMAP)
#define SLI_MAP_VIEW 1
#if defined(_WIN64)
typedef unsigned long long sli_windows_size;
#else
typedef unsigned long sli_windows_size;
#endif
typedef struct _SECURITY_ATTRIBUTES *sli_windows_security;
typedef union _LARGE_INTEGER *sli_windows_number;
__declspec(dllimport) void *__stdcall CreateFileA(const char *path, unsigned long access,
                                                  unsigned long share, sli_windows_security s,
                                                  unsigned long disposition, unsigned long flags,
                                                  void *model);
__declspec(dllimport) int __stdcall GetFileSizeEx(void *file, sli_windows_number size);
__declspec(dllimport) void *__stdcall CreateFileMappingA(void *file, sli_windows_security s,
                                                         unsigned long protection,
                                                         unsigned long size_high,
                                                         unsigned long size_low, const char *name);
__declspec(dllimport) void *__stdcall MapViewOfFile(void *section, unsigned long access,
                                                    unsigned long offset_high,
                                                    unsigned long offset_low,
                                                    sli_windows_size bytes);
__declspec(dllimport) int __stdcall UnmapViewOfFile(const void *bytes);
__declspec(dllimport) int __stdcall CloseHandle(void *handle);
#endif
#if defined(__cplusplus)
}
#endif
#endif

#if defined(SLI_GNU)
#define SLI_INLINE __attribute__((unused)) static inline
/* for functions whose calls pass a constant that must be folded into the body */
#define SLI_ALWAYS_INLINE __attribute__((unused, always_inline)) static inline
/* for rare code in hot functions, and for what many functions call */
#define SLI_NOINLINE __attribute__((unused, noinline))
/* The same, compiled for few bytes: errors, and calls whose time is that of what they call. What
 * only such functions call is compiled like them, but for SLI_HOT. Other functions call them under
 * a condition, because compilers take the way to them for rare: no public call is cold, or its
 * callers' loops would be compiled for few bytes, too. */
#define SLI_COLD __attribute__((unused, noinline, cold))
#define SLI_HOT __attribute__((unused, noinline, hot)) /* loops that cold functions call */
#define SLI_TARGET(list) __attribute__((target(list)))
#define SLI_ALIGNED(variable) variable __attribute__((aligned(64)))
/* A function that begins at a cache line. Compilers align to 16 bytes: what is before a function
 * decides where its loops lie, which changed the time of a call by 5 to 35 percent. It costs 24
 * bytes on average; functions that win less than 3 percent have none. */
#define SLI_AT_LINE __attribute__((aligned(64)))
/* Prefetches the cache line `bytes` after p. The line need not exist: prefetching an invalid
 * address has no effect. */
#define SLI_PREFETCH(p, bytes) \
    __builtin_prefetch((const void *)((uintptr_t)(p) + (uintptr_t)(bytes)))
#define SLI_KEEP_CALL __asm__ __volatile__("")
/* Unrolls the loop that follows, of at most 8 iterations. clang does so by itself, where a constant
 * number is known; told to, it does so too late to keep arrays in registers. */
#if defined(__clang__)
#define SLI_UNROLL
#else
#define SLI_UNROLL _Pragma("GCC unroll 8")
#endif
#else
#define SLI_INLINE static inline
#define SLI_NOINLINE
#define SLI_COLD
#define SLI_HOT
#define SLI_AT_LINE
#define SLI_TARGET(list)
#if defined(_MSC_VER)
#define SLI_ALWAYS_INLINE static __forceinline
#define SLI_ALIGNED(variable) __declspec(align(64)) variable
#else
#define SLI_ALWAYS_INLINE static inline
#define SLI_ALIGNED(variable) variable
#endif
#if defined(_MSC_VER) && defined(SLI_X86)
#define SLI_PREFETCH(p, bytes) _mm_prefetch((const char *)(p) + (bytes), _MM_HINT_T0)
#else
#define SLI_PREFETCH(p, bytes) ((void)0)
#endif
#define SLI_UNROLL
#define SLI_KEEP_CALL ((void)0)
#endif
/* c - a b in one rounding, in a function compiled for that instruction */
#if defined(SLI_GNU)
#define SLI_FNMA1(a, b, c) __builtin_fma(-(a), b, c)
#elif defined(SLI_X86)
#define SLI_FNMA1(a, b, c) _mm_cvtsd_f64(_mm_fnmadd_sd(_mm_set_sd(a), _mm_set_sd(b), _mm_set_sd(c)))
#else
#define SLI_FNMA1(a, b, c) fma(-(a), b, c)
#endif
/* Keeps a vector in its register: without this, a value used several times is loaded each time. */
#if defined(SLI_GNU) && defined(SLI_X86)
#define SLI_PIN(a) __asm__("" : "+x"(a))
#define SLI_PIN_ANY(a) __asm__("" : "+v"(a)) /* also in registers 16 to 31 */
#else
#define SLI_PIN(a) ((void)0)
#define SLI_PIN_ANY(a) ((void)0)
#endif

/* Tells the processor that a loop waits for another thread. */
#if defined(SLI_GNU) && (defined(__x86_64__) || defined(__i386__))
#define SLI_SPIN() __builtin_ia32_pause()
#elif defined(SLI_GNU) && defined(__aarch64__)
#define SLI_SPIN() __asm__ __volatile__("yield")
#elif defined(_MSC_VER) && defined(SLI_X86)
#define SLI_SPIN() _mm_pause()
#else
#define SLI_SPIN() ((void)0)
#endif

/* Words that threads share. Without them, a call whose workers wait for each other has one. */
#if defined(SLI_GNU)
#define SLI_ATOMIC 1
typedef int sli_atomic;
SLI_INLINE sli_atomic sli_atomic_exchange(sli_atomic *word, sli_atomic value) {
    return __atomic_exchange_n(word, value, __ATOMIC_ACQ_REL);
}
SLI_INLINE sli_atomic sli_atomic_read(const sli_atomic *word) {
    return __atomic_load_n(word, __ATOMIC_ACQUIRE);
}
SLI_INLINE void sli_atomic_write(sli_atomic *word, sli_atomic value) {
    __atomic_store_n(word, value, __ATOMIC_RELEASE);
}
SLI_INLINE sli_atomic sli_atomic_add(sli_atomic *word, sli_atomic value) {
    return __atomic_fetch_add(word, value, __ATOMIC_ACQ_REL);
}
#elif defined(_MSC_VER)
#include <intrin.h>
#define SLI_ATOMIC 1
typedef long sli_atomic;
SLI_INLINE sli_atomic sli_atomic_exchange(sli_atomic *word, sli_atomic value) {
    return _InterlockedExchange((volatile long *)word, value);
}
SLI_INLINE sli_atomic sli_atomic_read(const sli_atomic *word) {
    return _InterlockedOr((volatile long *)word, 0);
}
SLI_INLINE void sli_atomic_write(sli_atomic *word, sli_atomic value) {
    (void)_InterlockedExchange((volatile long *)word, value);
}
SLI_INLINE sli_atomic sli_atomic_add(sli_atomic *word, sli_atomic value) {
    return _InterlockedExchangeAdd((volatile long *)word, value);
}
#else
typedef int sli_atomic;
SLI_INLINE sli_atomic sli_atomic_exchange(sli_atomic *word, sli_atomic value) {
    const sli_atomic old = *word;
    *word = value;
    return old;
}
SLI_INLINE sli_atomic sli_atomic_read(const sli_atomic *word) {
    return *word;
}
SLI_INLINE void sli_atomic_write(sli_atomic *word, sli_atomic value) {
    *word = value;
}
SLI_INLINE sli_atomic sli_atomic_add(sli_atomic *word, sli_atomic value) {
    const sli_atomic old = *word;
    *word = old + value;
    return old;
}
#endif

/* An object that others borrow counts them. It is released by the last call that frees it, its own
 * or that of a borrower, so that objects may be freed in any order. */
SLI_INLINE void sli_borrow(const sli_atomic *borrowers) {
    (void)sli_atomic_add((sli_atomic *)borrowers, 1);
}

/* Takes one of borrowers and owner away. Was it the last one? Nobody else counts then. */
SLI_INLINE int sli_is_last(sli_atomic *borrowers) {
    return sli_atomic_read(borrowers) == 0 || /* branches untested: another was last just now */
           sli_atomic_add(borrowers, -1) == 0; /* branches untested: the same */
}

/* Sets a struct to 0; sets elements of an array to 0, or to those of another one. */
#define SLI_CLEAR(object) memset(&(object), 0, sizeof(object))
#define SLI_NONE(to, count) memset(to, -1, (size_t)(count) * sizeof *(to)) /* -1 each */
#define SLI_ZERO(to, count) memset(to, 0, (size_t)(count) * sizeof *(to))
#define SLI_COPY(to, from, count) memcpy(to, from, (size_t)(count) * sizeof *(to))

/* memset and memcpy by calls: gcc makes instructions for strings of those of large structs, with
 * which an analysis and a factor of a few rows take up to 4 % longer. */
SLI_NOINLINE static void sli_clear(void *to, size_t bytes) {
    memset(to, 0, bytes);
}

SLI_NOINLINE static void sli_copy(void *to, const void *from, size_t bytes) {
    memcpy(to, from, bytes);
}

/* A number that one thread writes while another reads it, and that either value suits. */
SLI_INLINE sl_int sli_shared_read(const sl_int *a) {
#if defined(SLI_GNU)
    return __atomic_load_n(a, __ATOMIC_RELAXED);
#else
    return *(const volatile sl_int *)a;
#endif
}
SLI_INLINE void sli_shared_write(sl_int *a, sl_int value) {
#if defined(SLI_GNU)
    __atomic_store_n(a, value, __ATOMIC_RELAXED);
#else
    *(volatile sl_int *)a = value;
#endif
}

/* A precondition. SL_VERIFY builds check it. */
#if defined(SL_VERIFY)
#define SLI_ASSERT(condition) ((condition) ? (void)0 : abort())
#else
#define SLI_ASSERT(condition) ((void)0)
#endif

/* The most rows or columns of a matrix: rounded up to whole tiles of 8 it still fits an sl_int, and
 * so does the n + 1 after a loop that includes n. */
#define SLI_ROWS_MAX (INT32_MAX - 7)

SLI_INLINE sl_int sli_min(sl_int a, sl_int b) {
    return a < b ? a : b;
}

SLI_INLINE sl_int sli_max(sl_int a, sl_int b) {
    return a > b ? a : b;
}

/* a clamped */
SLI_INLINE sl_int sli_clamp(sl_int a, sl_int high) {
    return a < 0 ? 0 : a > high ? high : a;
}

SLI_INLINE int sli_is_finite(double a) {
    return a - a == 0.0;
}

/* A pseudo-random number from 0.5 to 1. */
SLI_INLINE double sli_random(uint64_t *state) {
    *state = *state * UINT64_C(6364136223846793005) + UINT64_C(1442695040888963407);
    return 0.5 + (double)(*state >> 40) / 33554432.0;
}

#if defined(__APPLE__)
#define SLI_FSYNC 1
SLI_INLINE int sli_fsync(int file) {
    return fsync(file);
}
SLI_INLINE int sli_fileno(FILE *file) {
    return fileno(file);
}
#endif

#if defined(SLI_POSIX) || defined(SLI_WINDOWS)
/* Whether path is a symbolic link. Not noticed where the headers hide lstat. */
SLI_INLINE int sli_is_link(const char *path) {
#if defined(SLI_WINDOWS)
    const unsigned long attributes = GetFileAttributesA(path); /* all ones: there is no such file */
    return attributes != 0xffffffffu && (attributes & 0x400u) != 0;
#elif defined(__linux__) && defined(__GNUC__)
    char to[1];
    return sli_readlink(path, to, sizeof to) >= 0;
#elif defined(S_IFLNK) && defined(S_ISLNK)
    struct stat found;
    return lstat(path, &found) == 0 && S_ISLNK(found.st_mode);
#else
    (void)path;
    return 0;
#endif
}
#endif

/* Seconds of processor time since an arbitrary moment. C99 has no other clock; on Windows it counts
 * all time. */
SLI_NOINLINE static double sli_seconds(void) {
#if defined(SL_NO_CLOCK)
    return 0.0;
#else
    return (double)clock() / (double)CLOCKS_PER_SEC;
#endif
}

/* The same, 0 for work on so few entries that the readings, calls of the system, would take a tenth
 * of its time: an analysis has five, a first factor four, of 0.4 us. */
#define SLI_CLOCK_ENTRIES 16000
SLI_INLINE double sli_seconds_for(int64_t entries) {
    return entries < SLI_CLOCK_ENTRIES ? 0.0 : sli_seconds();
}

#endif

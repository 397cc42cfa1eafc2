/* config.h: macros that a user may define before the include, the version, and the integer types */
#ifndef SL_PUBLIC_CONFIG_H
#define SL_PUBLIC_CONFIG_H

#include <stddef.h>
#include <stdint.h>

/* Macros that this header reads:
 *
 *  SPARSE_LOCAL_IMPLEMENTATION   define it in exactly one source file before the include, which
 *                                then compiles the library.
 *  SL_STATIC                     makes everything static: a private copy in one source file.
 *  SL_METIS                      adds SL_ORDERING_METIS: needs <metis.h> and -lmetis.
 *  SL_NO_METIS                   overrides SL_METIS.
 *  SL_NO_SIMD                    compiles only the kernels in plain C: smallest object, easiest to
 *                                debug, and with -O0 compiled in about a second.
 *  SL_NO_AVX512                  leaves out the AVX-512 kernels: AVX2 is then the best on x86.
 *  SL_NO_SINGULAR                leaves out null spaces, 26 kB: SL_PIVOTS_SKIP_NULL is refused.
 *  SL_PTHREADS                   threads of POSIX where options.threads.run is NULL; compile and
 *                                link with -pthread.
 *  SL_NO_CLOCK                   makes all times in the statistics 0, for systems without clock();
 *                                set automatically for WASI.
 *  SL_NO_THREAD_LOCAL            does not keep the last error of each thread (sl_error_text).
 *  SL_NO_MMAP                    leaves out mapped files (SL_LOAD_MAPPED), and with them the
 *                                headers of the system that map files.
 *  SL_API                        linkage of the public functions. By default, with gcc and clang on
 *                                ELF systems, they are hidden in the program or shared library that
 *                                has their bodies: copies in one process do not call each other.
 *                                To export them: __attribute__((visibility("default"))), or
 *                                __declspec(dllexport).
 *  SL_HEADER                     name of this header, default "sparse_local.h". The implementation
 *                                includes this header again for each instruction set. If you rename
 *                                the file: #define SL_HEADER "new_name.h", without its folder.
 *  SL_CONFIG_HEADER              name of a header of yours that this one includes first. It defines
 *                                such macros and those of packs.h: -DSL_CONFIG_HEADER='"mine.h"'
 *  SL_VERIFY                     checks internal invariants and unread options at run time: slow,
 *                                for debugging.
 *
 * Kernels: gcc and clang on x86, and on Windows clang, clang-cl and MSVC for x64, compile AVX2 and
 * AVX-512, one of which is selected at run time; 64-bit ARM has NEON. All others have plain C. So
 * does gcc for Windows (MinGW), which does not align vectors on the stack (gcc bug 54412): clang's
 * code factors in a third of its time. For WebAssembly, -msimd128 vectorizes plain C.
 *
 * The implementation must not be compiled with -ffast-math or -ffinite-math-only: they remove the
 * checks for NaN and infinity, so it stops with an #error. Files that only include the declarations
 * may use these flags.
 */
#if defined(__wasi__) && !defined(SL_NO_CLOCK)
#define SL_NO_CLOCK
#endif

#ifndef SL_HEADER
#define SL_HEADER "sparse_local.h"
#endif

#define SL_VERSION_MAJOR 1
#define SL_VERSION_MINOR 0
#define SL_VERSION_PATCH 0
#define SL_VERSION_SUFFIX "" /* empty in a release */
/* the version as one number, to compare: 10203 is 1.2.3 */
#define SL_VERSION (10000 * SL_VERSION_MAJOR + 100 * SL_VERSION_MINOR + SL_VERSION_PATCH)

#if defined(SL_API)
/* defined by the user */
#elif defined(SL_STATIC)
#if defined(__GNUC__)
#define SL_API __attribute__((unused)) static
#else
#define SL_API static
#endif
#else
#define SL_API extern
#define SL_API_DEFAULT
#endif

#if defined(__GNUC__)
#define SL_WARN_UNUSED __attribute__((warn_unused_result))
#else
#define SL_WARN_UNUSED
#endif

/** Rows, columns and positions in A. The int arrays of Eigen, SciPy and CHOLMOD are used in place.
 */
typedef int32_t sl_int;

/** Positions in the factor L, which exceed 32 bits long before those in A do. */
typedef int64_t sl_off;

#endif

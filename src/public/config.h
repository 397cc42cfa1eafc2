/* config.h: what a user may set before including the header, the version, and the integer types */
#ifndef SL_PUBLIC_CONFIG_H
#define SL_PUBLIC_CONFIG_H

#include <stddef.h>
#include <stdint.h>

/* Macros read by this header:
 *
 *  SPARSE_LOCAL_IMPLEMENTATION   define it in exactly one source file before the include: the bodies go there.
 *  SL_STATIC                     everything static: private copy of the library in one source file.
 *  SL_NO_METIS                   build without METIS: all but SL_ORDERING_METIS and _QUALITY.
 *  SL_VERIFY                     re-prove internal invariants at run time (slow; for debugging).
 *
 * The bodies are not to be compiled with -ffast-math or -ffinite-math-only, which take the checks for NaN and infinity
 * away: they refuse that with an #error. Files that only include the declarations may use what they like.
 */
#define SL_VERSION_MAJOR 0
#define SL_VERSION_MINOR 1
#define SL_VERSION_PATCH 0

#if defined(SL_STATIC)
#if defined(__GNUC__)
#define SL_API __attribute__((unused)) static
#else
#define SL_API static
#endif
#else
#define SL_API extern
#endif

#if defined(__GNUC__)
#define SL_WARN_UNUSED __attribute__((warn_unused_result))
#else
#define SL_WARN_UNUSED
#endif

/** Rows, columns and positions in a matrix A: the arrays of Eigen, SciPy and CHOLMOD (int) are used in place. */
typedef int32_t sl_int;

/** Positions in the factor L, which outgrows 32 bits long before A does. */
typedef int64_t sl_off;

#endif

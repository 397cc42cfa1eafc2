/* options.h: options of all calls, threads, and the allocator */
#ifndef SL_PUBLIC_OPTIONS_H
#define SL_PUBLIC_OPTIONS_H

#include "types.h"

/** Runs body(data, k) once for each k = 0 .. count-1, in any order and concurrently if it can, and
 *  returns when all are done. A body waits only for bodies that have begun. So any number of
 *  threads suffices; fewer take longer. tools/examples/threads.c is a pool of pthreads. */
typedef void (*sl_parallel_for)(void *context, sl_int count, void (*body)(void *data, sl_int k),
                                void *data);

/** Threads, opt-in: all zero means none. Results do not depend on the number of threads. */
typedef struct sl_threads {
    sl_int count; /* 0 or 1: the calling thread only */
    /* the caller's thread pool; NULL: SL_PTHREADS or OpenMP; compiled with neither, a count above 1
     * is SL_ERR_UNSUPPORTED */
    sl_parallel_for run;
    void *context; /* passed to run */
} sl_threads;

/** Memory of the objects. Set both functions or neither; only one is SL_ERR_ARGUMENT.
 *
 *  Neither: malloc and free; on Linux, blocks of 4 MB and more use huge pages. Every object keeps a
 *  copy of its allocator.
 */
typedef struct sl_allocator {
    void *(*allocate)(void *context, size_t bytes); /* NULL on failure; aligned as malloc does */
    void (*release)(void *context, void *block);    /* block came from allocate, never NULL */
    void *context;
} sl_allocator;

/** Options. A call reads the allocator, `size`, and the fields that its declaration lists under
 *  opt. All zero, or a NULL pointer, means defaults. With SL_VERIFY a call refuses a field that is
 *  set and that it does not read.
 */
typedef struct sl_options {
    /* sizeof(sl_options), set by sl_options_init; 0 means the same; else SL_ERR_ARGUMENT */
    size_t size;
    sl_allocator allocator;
    sl_threads threads;

    /* ---- analysis ---- */

    sl_ordering ordering;
    sl_relaxation relaxation;
    /* the triangle to read; SL_TRIANGLE_NONE: the pattern decides. LOWER or UPPER ignore the
     * entries on the other side of the diagonal, whatever their pattern */
    sl_triangle triangle;
    /* n: perm[k] = row of A that is pivot k; read with SL_ORDERING_GIVEN only */
    const sl_int *perm;
    /* rows k block_size .. (k+1) block_size - 1 stay together in the order, such as x, y, z of a
     * vertex; divides n; 0 or 1: no blocks */
    sl_int block_size;
    /* SL_PURPOSE_ONE_FACTOR: SL_ORDERING_ND orders by minimum degree where dissection would take
     * longer than it saves, and thin graphs by breadth-first search, with up to twice the
     * entries of L; relaxation merges more, for fewer fronts and slower solves */
    sl_purpose purpose;

    /* ---- factorization ---- */

    sl_isa isa;
    sl_method method;
    sl_storage storage;
    /* SL_PIVOTS_POSITIVE refuses a negative pivot, for example where the sign of t is wrong in M +
     * t L, and stats.factor counts the others. It is not saved in files */
    sl_pivots pivots;
    /* a pivot d is null if |d| <= null_tolerance * (sum of the magnitudes it was computed from);
     * not read where a known null vector decides (tools/docs/singular.md); 0: if it is within the
     * rounding error that L shows; where null pivots are skipped or replaced, (64 + k/8) epsilon
     * with the k rows of its subtree; negative: only an exact zero is null */
    double null_tolerance;
    /* with SL_PIVOTS_SKIP_NULL: n x null_vector_count numbers, copied. One column: a vector that is
     * a null vector of each connected component that has one; 0 in all rows of a component: its
     * null vectors are unknown; NULL: all 1 */
    const double *null_vector;
    /* the columns of null_vector, at most 32: the null vectors of each component are combinations
     * of them (tools/docs/singular.md). Column-major, leading dimension n; 0: 1 */
    sl_int null_vector_count;
    /* with SL_PIVOTS_SKIP_NULL: n weights m, copied. In each component with a null pivot the
     * solution has sum m x = 0, and b is made consistent by a multiple of m; with several null
     * vectors z it has sum m z x = 0 for each of them; NULL: x is 0 in the null rows */
    const double *mass;
    /* with SL_PIVOTS_SKIP_NULL and no mass: a solve refuses b if |z' b| > consistency_tolerance *
     * sum |b| for a null vector z scaled to 1 in its null row; 0: 1e-6, which accepts
     * single-precision errors; negative: nothing is refused */
    double consistency_tolerance;
    /* with SL_PIVOTS_NONZERO only: a null pivot, or one of the wrong sign, becomes sign * max(|d|,
     * regularization * (sum of the magnitudes it was computed from, 1 if that is 0)); 1e-8 suits
     * refinement. Then L D L' = P (A + E) P'; 0: no regularization */
    double regularization;
    /* n, copied: the sign that each row's pivot should have, 1 or -1, or 0 for either; NULL: all 1
     */
    const sl_int *signs;
    /* a factorization whose stats.factor.growth is larger is refused with SL_ERR_INACCURATE; 0:
     * 1 / epsilon = 4.5e15, or 8.4e6 if L is in float, beyond which L D L' may agree with A in
     * no digit; negative: no limit */
    double growth_limit;
    /* sl_factor_refine and sl_plan_solve_regularized return SL_ERR_INACCURATE if they end above
     * this backward error; 0: 1e-8; negative: never */
    double error_limit;

    /* ---- local solves ---- */

    /* where the sweeps of a plan may end; kept by the plan; NULL: at the roots only */
    const sl_region *region;
    /* upper bound on the bytes of a region that has a boundary; 0: no bound */
    size_t region_bytes;

    /* must be 0; new options take their place, so that the size of the struct never changes. An
     * older library, for which they are reserved, refuses them */
    sl_off reserved[16];
} sl_options;

/** Sets all options to their defaults. size is sizeof(sl_options) of the caller; opt may be NULL.
 *
 *  For bindings: a library with another sl_options refuses the struct with SL_ERR_ARGUMENT instead
 *  of misreading it. C programs may equally well zero the struct.
 */
SL_API void sl_options_init(sl_options *opt, size_t size);

#endif

/* sparse_local.h 0.1.0, generated: edit src/, run make header
 * FNV-1a of the lines after this comment, without the license: 91627cdc0ecd395d
 * The comments of the implementation are in src/impl.
 *
 * Contents
 * (what a user reads)
 *     86 intro.h      what the library does, a quick start, notation, conventions, threads, references
 *    155 config.h     macros that a user may define before the include, the version, and the integer types
 *    234 types.h      status codes, the view of a matrix, enumerations, and the names of the opaque objects
 *    386 options.h    options of all calls, threads, and the allocator
 *    525 stats.h      what calls report: the location of an error, counts, times and sizes, in groups
 *    693 csc.h        sparse matrices: creation, checks, products, residuals, Matrix Market files
 *    865 analyze.h    the analysis of a pattern: ordering, elimination tree, supernodes, storage of L
 *    995 factor.h     the numerical factorization P A P' = L D L'
 *   1244 solve.h      full solves, and the workspace of all solves
 *   1354 plan.h       local solves: b is known in a few rows, x is wanted in a few others
 *   1448 parts.h      L, D, L' and the permutation applied one by one: half solves, products, samples
 *   1561 accuracy.h   refinement of solutions, condition estimate, consistency of singular systems
 *   1674 inverse.h    entries, blocks and bilinear forms of the inverse, without a backward sweep
 *   1810 batch.h      many independent solves by one call, distributed over threads
 *   1860 several.h    several matrices of one pattern: weighted sums of value arrays over one analysis
 *   2038 selected.h   the selected inverse: entries of A^-1 on the pattern of L
 *   2157 region.h     regions, inside which the cost of local solves does not depend on the whole matrix
 *   2261 save.h       a factor in a file or in memory: saved, loaded, and mapped without a copy
 *   2400 saved_set.h  a factor with its selected inverse and regions in one file or block of memory
 *   2518 change.h     a factor that follows small changes of its matrix
 *   2605 pins.h       rows held at given values, on top of a factor that stays as it is
 *   2695 complex.h    complex Hermitian systems, solved as real ones of twice the size
 *   2822 restrict.h   the factor of a principal submatrix, from that of the whole matrix
 *   2871 edit.h       an analysis that follows edits of the pattern: rows and entries that come and go
 * (bodies, in one source file)
 * (base: the compiler, status, memory, sorting, threads)
 *   2923 base.h   3202 status.h   3263 options.h   3321 alloc.h   3431 hash.h   3561 file_map.h
 *   3657 sort.h   3721 parallel.h
 * (kernels: numerical kernels on raw arrays, once for each instruction set)
 *   3804 panel.h   3826 step.h   3867 pivot_rule.h   3934 front.h   3982 pairs.h
 *   4189 inverse_front.h   4261 table.h   4285 simd.h   4355 simd_scalar.h   4484 simd_avx2.h
 *   4685 simd_avx512.h   4794 simd_neon.h   4989 dispatch.h
 * (matrix: sparse matrices of the caller and of the library)
 *   5069 csc.h   5183 csc_build.h   5317 csc64.h   5388 csc_triangle.h   5454 csc_products.h
 *   5571 permute.h   5637 sum.h   5719 output_file.h   5928 matrix_market.h
 * (ordering: fill-reducing orderings of a graph)
 *   6374 graph.h   6523 coarsen.h   6835 labels.h   7029 subgraph.h   7224 heap.h   7284 bisect.h
 *   7514 separator.h   7776 mindeg.h   7959 dissect.h   8293 levelset.h   8413 geometric.h
 *   8588 cells.h   8768 septree.h   8828 metis.h   8977 metis_refined.h   9091 nd.h
 *   9283 compress.h   9404 quotient.h   9818 order.h
 * (analysis: elimination tree, supernodes, structure of L; never sees a value)
 *  10100 symbolic_types.h  10137 etree.h  10210 counts.h  10267 supernodes.h  10489 structure.h
 *  10610 schedule.h  10890 symbolic.h  11300 reach.h
 * (factor: the numbers of L and D)
 *  11571 factor_types.h  11898 storage.h  11969 pivot_search.h  12315 pivoted.h  12383 scatter.h
 *  12541 uplooking.h  12613 null_product.h  12817 null_dense.h  12894 null_basis.h
 *  13202 null_vectors.h  13346 multifrontal.h  13472 front_tasks.h  13802 nullspace.h
 *  14005 growth.h  14081 factor_setup.h  14380 factor.h  14586 leftlooking.h  14770 factor_query.h
 *  14905 combination.h
 * (solve: full and local solves)
 *  14966 region_types.h  15070 work.h  15167 query.h  15341 singular.h  15608 backward.h
 *  15638 sweep.h  15824 compile.h  16017 plan.h  16124 local.h  16274 parts.h  16561 refine.h
 *  16740 refine_local.h  16955 rcond.h  17112 defects.h
 * (inverse: entries of the inverse, regions)
 *  17189 traversal.h  17434 traversal_run.h  17617 row_sets.h  17644 unit_vectors.h
 *  17869 bilinear.h  18046 entries.h  18327 block.h  18567 reserve.h  18759 selected.h
 *  18969 selected_query.h  19071 region_choose.h  19298 region.h
 * (change: a factor that follows changes of its matrix)
 *  19546 update.h  19896 rank.h  20225 edges.h  20379 choose.h  20573 pins.h  21137 subset.h
 *  21244 restrict_analysis.h  21541 restrict_anew.h  21595 restrict_symbolic.h  21776 restrict.h
 *  22124 edit_match.h  22306 edit_place.h  22510 edit_order.h  22671 edit_graph.h
 *  22766 edit_join.h  23042 edit.h
 * (save: factors in files)
 *  23194 format.h  23490 decode.h  23636 check.h  23968 write.h  24271 load.h  24539 load_inverse.h
 *  24871 load_calls.h
 * (batch: many solves, factors and diagonals by one call)
 *  25070 batch_solve.h  25279 batch_factor.h  25480 batch_diagonal.h
 * (complex: complex Hermitian systems over real factors)
 *  25620 hermitian.h  25782 complex_rows.h
 * (last: undefine every internal macro)
 *  25950 undef.h
 * (templates: the header includes them from itself, once for each instruction set)
 *  26136 multi_rhs.inl.h  26519 sweeps.inl.h  26521 unit_triangle.inl.h  26558 two_rhs.inl.h
 *  26727 small_supernode.inl.h  26886 single_rhs.inl.h  27130 kernel_set.inl.h  27132 product.inl.h
 *  27260 front.inl.h  27474 inverse_front.inl.h  27759 row.inl.h  27789 change.inl.h
 */
/* ---- what a user reads ---- */
#ifndef SPARSE_LOCAL_H
#define SPARSE_LOCAL_H
/* src/public/intro.h: what the library does, a quick start, notation, conventions, threads, references */

/* sparse_local.h factors a sparse symmetric matrix once, P A P' = L D L', and then answers many
 * small questions from that factor: b is nonzero in a few rows, x is wanted in a few others. The
 * elimination tree determines which columns of L can matter. The answer is the same as that of a
 * full solve; its cost depends on the question and not on the size of the matrix [HDA17].
 *
 * Quick start (in one source file; link with -lm):
 *
 *     #define SPARSE_LOCAL_IMPLEMENTATION
 *     #include "sparse_local.h"
 *
 *     sl_csc A = {n, n, Ap, Ai, Ax};                     lower, upper or both triangles
 *     sl_symbolic *S;  sl_factor *F;  sl_plan *P;
 *     sl_symbolic_create(&S, &A, NULL, NULL);            once per pattern
 *     sl_factor_create(&F, S, &A, NULL, NULL);           once per matrix
 *     sl_factor_solve(F, x, n, b, n, 1, NULL);           full solve
 *     sl_plan_create(&P, S, bset, nb, xset, nx, NULL, NULL);
 *     sl_plan_solve(P, F, x, nx, b, nb, 1, NULL);        local solve, any number of times
 *     sl_plan_free(P);  sl_factor_free(F);  sl_symbolic_free(S);
 *
 * Notation     A is n x n. perm[k] is the row of A that is pivot k; iperm is the inverse of perm.
 *              parent is the elimination tree, -1 at a root. L is unit lower triangular and stored
 *              in supernodal panels; D is diagonal. A reach is a set of columns closed under
 *              parent. nnz counts stored entries.
 * Conventions  Every function that can fail returns sl_status. On error, outputs are NULL or
 *              untouched. Options and stats may be NULL. Dense arguments are column-major with a
 *              leading dimension in elements; the calls named interleaved take row-major ones. Row
 *              numbers are the caller's, also in errors. A b-set comes before an x-set, and a
 *              length follows its array. The library never prints or aborts and has no mutable
 *              globals; for METIS, an option, see sl_symbolic_create.
 * Threads      An analysis, a plan, a selected inverse and a region are immutable after their
 *              creation; a factor is const during solves. Any number of threads may solve with one
 *              factor, each with its own sl_work.
 *
 * References
 *  [HDA17]   Herholz, Davis, Alexa: Localized solutions of sparse linear systems for geometry
 *            processing, 2017.
 *  [Davis06] Davis: Direct Methods for Sparse Linear Systems, 2006.
 *  [LDL05]   Davis: Algorithm 849: a concise sparse Cholesky factorization package, 2005.
 *  [FF56]    Ford, Fulkerson: Maximal flow through a network, 1956.
 *  [George73] George: Nested dissection of a regular finite element mesh, 1973.
 *  [FM82]    Fiduccia, Mattheyses: A linear-time heuristic for improving network partitions, 1982.
 *  [Liu90]   Liu: The role of elimination trees in sparse factorization, 1990.
 *  [GNP94]   Gilbert, Ng, Peyton: An efficient algorithm to compute row and column counts, 1994.
 *  [NP93]    Ng, Peyton: Block sparse Cholesky algorithms on advanced uniprocessor computers, 1993.
 *  [DR83]    Duff, Reid: The multifrontal solution of indefinite sparse symmetric linear equations,
 *            1983.
 *  [Liu92]   Liu: The multifrontal method for sparse matrix solution: theory and practice, 1992.
 *  [ET75]    Erisman, Tinney: On computing certain elements of the inverse of a sparse matrix,
 *            1975.
 *  [SelInv]  Lin, Yang, Meza, Lu, Ying, E: SelInv: selected inversion of a sparse symmetric matrix,
 *            2011.
 *  [ADD96]   Amestoy, Davis, Duff: An approximate minimum degree ordering algorithm. SIAM J. Matrix
 *            Anal. Appl. 17(4), 1996
 *  [AG89]    Ashcraft, Grimes: The influence of relaxed supernode partitions on the multifrontal
 *            method, 1989.
 *  [DH01]    Davis, Hager: Multiple-rank modifications of a sparse Cholesky factorization, 2001.
 *  [HA18]    Herholz, Alexa: Factor once: reusing Cholesky factorizations on sub-meshes, 2018.
 *  [Bie76]   Bierman: Measurement updating using the U-D factorization, 1976.
 *  [Hager89] Hager: Updating the inverse of a matrix, 1989.
 *  [Hi88]    Higham: FORTRAN codes for estimating the one-norm of a real or complex matrix, 1988.
 *  [Hi02]    Higham: Accuracy and Stability of Numerical Algorithms, 2nd edition, 2002.
 *  [Sk80]    Skeel: Iterative refinement implies numerical stability for Gaussian elimination,
 *            1980.
 *  [KK98]    Karypis, Kumar: A fast and high quality multilevel scheme for partitioning irregular
 *            graphs, 1998.
 */

/* src/public/config.h: macros that a user may define before the include, the version, and the integer types */

#include <stddef.h>
#include <stdint.h>

/* Macros that this header reads:
 *
 *  SPARSE_LOCAL_IMPLEMENTATION   define it in exactly one source file before the include, which
 *                                then compiles the library.
 *  SL_STATIC                     makes everything static: a private copy in one source file.
 *  SL_METIS                      adds SL_ORDERING_METIS and SL_ORDERING_METIS_REFINED: needs
 *                                <metis.h> and -lmetis.
 *  SL_NO_METIS                   overrides SL_METIS.
 *  SL_NO_SIMD                    compiles only the kernels in plain C: smallest object, fastest
 *                                compilation, easiest to debug.
 *  SL_NO_AVX512                  leaves out the AVX-512 kernels: AVX2 is then the best on x86.
 *  SL_NO_CLOCK                   makes all times in the statistics 0, for systems without clock();
 *                                set automatically for WASI.
 *  SL_NO_MMAP                    leaves out sl_map_file, and with it the headers of the system that
 *                                map files.
 *  SL_API                        linkage of the public functions, for a shared library: for example
 *                                __declspec(dllexport), or __attribute__((visibility("default"))).
 *  SL_HEADER                     name of this header, default "sparse_local.h". The implementation
 *                                includes this header again for each instruction set. If you rename
 *                                the file: #define SL_HEADER "new_name.h", without its folder.
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

#define SL_VERSION_MAJOR 0
#define SL_VERSION_MINOR 1
#define SL_VERSION_PATCH 0
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

#ifdef __cplusplus
extern "C" {
#endif
/* src/public/types.h: status codes, the view of a matrix, enumerations, and the names of the opaque objects */

/** SL_VERSION of the compiled library; a binding compares it with that of its header. */
SL_API int sl_version(void);

/** Result of a call. Every function that can fail returns one; SL_OK is 0. */
typedef enum sl_status {
    SL_OK = 0,
    /* a NULL pointer, a negative size, a leading dimension too small, an index out of range */
    SL_ERR_ARGUMENT,
    /* the allocator returned NULL */
    SL_ERR_MEMORY,
    /* a malformed matrix, both triangles stored with different patterns, or not the analyzed
     * pattern */
    SL_ERR_PATTERN,
    /* a null pivot: the matrix is singular or needs pivoting; stats name the row */
    SL_ERR_PIVOT,
    /* a NaN or an infinity in the values or in a result; stats name the row */
    SL_ERR_NOT_FINITE,
    /* a count does not fit its type */
    SL_ERR_TOO_LARGE,
    /* not compiled in, not available on this processor, or an unknown file format */
    SL_ERR_UNSUPPORTED,
    /* a file cannot be opened, read, parsed or written; stats name the line */
    SL_ERR_IO,
    /* METIS failed */
    SL_ERR_ORDERING,
    /* a failed factor, a mapped one that would have to change, or objects that do not belong
     * together */
    SL_ERR_STATE,
    /* a singular system whose right-hand side has no solution */
    SL_ERR_INCONSISTENT,
    /* pivot growth beyond options.growth_limit (stats name a row), or a refinement that ended above
     * options.error_limit (its solution is written) */
    SL_ERR_INACCURATE
} sl_status;

/** A short description of a status; static storage. Any value is accepted. */
SL_API const char *sl_status_string(sl_status status);

/** View of a sparse matrix in compressed columns: column j has rows i[p[j]] .. i[p[j+1]-1].
 *
 *  The caller owns the arrays; no call keeps a pointer to them. The rows of a column may be in any
 *  order. Duplicates are summed. Explicit zeros are entries like any other. A symmetric matrix may
 *  store its lower triangle, its upper triangle or both; the pattern decides which. If it stores
 *  both, the pattern must be symmetric and the values of the lower triangle are read
 *  (options.triangle changes that).
 */
typedef struct sl_csc {
    sl_int n_rows;   /* 0 .. 2^31 - 8; a larger matrix is refused with SL_ERR_TOO_LARGE */
    sl_int n_cols;   /* the same range */
    const sl_int *p; /* n_cols + 1 positions, ascending, p[0] = 0 */
    const sl_int *i; /* p[n_cols] row indices in 0..n_rows-1 */
    const double *x; /* p[n_cols] values; NULL: pattern only (enough for sl_symbolic_create) */
} sl_csc;

/** The stored entries of a symmetric matrix. */
typedef enum sl_triangle {
    SL_TRIANGLE_NONE = 0, /* diagonal entries only; as an option: the pattern decides */
    SL_TRIANGLE_LOWER,
    SL_TRIANGLE_UPPER,
    SL_TRIANGLE_BOTH
} sl_triangle;

/** How to interpret the stored entries. */
typedef enum sl_reading {
    SL_AS_SYMMETRIC = 0, /* as the factorization does: one triangle defines the matrix */
    SL_AS_STORED         /* as a general matrix: every entry counts once, where it is */
} sl_reading;

/** Fill-reducing orderings. Rows with equal neighborhoods are ordered as one. */
typedef enum sl_ordering {
    SL_ORDERING_ND = 0,        /* nested dissection by this header; needs no library */
    SL_ORDERING_METIS,         /* METIS_NodeND on every connected component [KK98] */
    SL_ORDERING_METIS_REFINED, /* METIS's separators, improved: the best order, in twice its time */
    SL_ORDERING_GIVEN,         /* options.perm, or equivalent: see sl_symbolic_create */
    SL_ORDERING_NATURAL,       /* 0, 1, 2, ..., or equivalent: see sl_symbolic_create */
    SL_ORDERING_MINDEG         /* approximate minimum degree, soonest done [ADD96] */
} sl_ordering;

/** What the analysis is for. */
typedef enum sl_purpose {
    SL_PURPOSE_MANY_SOLVES = 0, /* few columns on the paths of local solves, and few entries of L */
    SL_PURPOSE_ONE_FACTOR       /* the first factor as early as possible */
} sl_purpose;

/** Amalgamation of small supernodes with their parents: faster solves for a few stored zeros. */
typedef enum sl_relaxation {
    SL_RELAXATION_DEFAULT = 0, /* merge over the whole assembly tree while zeros are few [AG89] */
    SL_RELAXATION_NONE         /* fundamental supernodes: no zero is stored */
} sl_relaxation;

/** Instruction set of the kernels. */
typedef enum sl_isa {
    SL_ISA_AUTO = 0, /* the best that the processor and the operating system support */
    SL_ISA_SCALAR,
    SL_ISA_AVX2, /* AVX2 and FMA */
    SL_ISA_AVX512,
    SL_ISA_NEON
} sl_isa;

/** Factorization methods. Both compute the same L up to rounding. */
typedef enum sl_method {
    SL_METHOD_AUTO = 0,   /* the faster one, judged by flops per supernode */
    SL_METHOD_UP_LOOKING, /* row by row, little memory beyond L: nearly diagonal patterns, stars */
    SL_METHOD_SUPERNODAL  /* multifrontal with dense fronts: everything else; uses threads */
} sl_method;

/** The type in which a factor keeps L. Arithmetic, D, B and X are double in any case. */
typedef enum sl_storage {
    SL_STORAGE_DOUBLE = 0,
    SL_STORAGE_FLOAT /* half the bytes of L, its accuracy until refined: sl_factor_create */
} sl_storage;

/** What to do with a null pivot. */
typedef enum sl_null_pivots {
    SL_NULL_PIVOT_REFUSE = 0, /* fail with SL_ERR_PIVOT; D may have any sign */
    SL_NULL_PIVOT_SKIP        /* skip and count it: semidefinite matrices, singular Laplacians */
} sl_null_pivots;

/** How entries of the inverse were computed. */
typedef enum sl_inverse_method {
    SL_INVERSE_NONE = 0, /* nothing was requested */
    SL_INVERSE_FORWARD,  /* forward sweeps of the requested rows */
    SL_INVERSE_SELECTED  /* selected inversion on their reach */
} sl_inverse_method;

/** How a change of a factor was computed. */
typedef enum sl_change_method {
    SL_CHANGE_NONE = 0, /* nothing changed */
    SL_CHANGE_UPDATE,   /* rank-one changes of the columns on their paths */
    SL_CHANGE_REACH,    /* sl_factor_refactor_changed */
    SL_CHANGE_REFACTOR  /* sl_factor_refactor */
} sl_change_method;

/** Why sl_factor_change took its way. */
typedef enum sl_change_reason {
    SL_CHANGE_CHEAPEST = 0, /* the fewest flops, weighted by what one costs in each way */
    SL_CHANGE_UNSUITED,     /* null pivots, 2x2 pivots, or F has no numbers */
    SL_CHANGE_DRIFT,        /* the errors of earlier changes have reached their limit */
    SL_CHANGE_REFUSED       /* rank-one changes met a pivot that they refuse */
} sl_change_reason;

typedef struct sl_matrix sl_matrix;     /* a CSC matrix that the library owns */
typedef struct sl_symbolic sl_symbolic; /* the analysis of one pattern; immutable */
typedef struct sl_factor sl_factor;     /* L and D over a symbolic analysis */
typedef struct sl_plan sl_plan;         /* the reaches of a b-set and an x-set; immutable */
typedef struct sl_work sl_work;         /* workspace of one thread */
typedef struct sl_selected sl_selected; /* entries of the inverse on the pattern of L; immutable */
typedef struct sl_pins sl_pins;         /* rows held at given values */
typedef struct sl_region sl_region;     /* a part of the matrix where local solves can stop early */

/* src/public/options.h: options of all calls, threads, and the allocator */

/** Runs body(data, k) once for each k = 0 .. count-1, in any order and concurrently if it can, and
 *  returns when all are done. A body may wait for others that have begun, never for one that has
 *  not: fewer threads, or one, only take longer. tools/examples/threads.c is a pool of pthreads. */
typedef void (*sl_parallel_for)(void *context, sl_int count, void (*body)(void *data, sl_int k),
                                void *data);

/** Threads, opt-in: all zero means none. Results do not depend on the number of threads. */
typedef struct sl_threads {
    sl_int count; /* 0 or 1: the calling thread only */
    /* the caller's thread pool; NULL: OpenMP if compiled with it, else serial execution */
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

/** Options. Every call takes this struct and reads the fields listed for it; all zero, or a NULL
 *  pointer, means defaults.
 *
 *  | call                                       | fields that it reads                     |
 *  |--------------------------------------------|------------------------------------------|
 *  | every call with an sl_options argument     | size, allocator                          |
 *  | sl_symbolic_create, _create_pivoted        | ordering .. purpose                      |
 *  | sl_csc_triangle, sl_matrix_sum             | triangle                                 |
 *  | sl_factor_create and _create_combination,  | threads, isa .. signs,                   |
 *  |   sl_batch_factor                          | null_vector .. storage                   |
 *  | sl_batch_solve, _refactor, _diagonal       | threads                                  |
 *  | sl_selected_create                         | threads                                  |
 *  | sl_load_memory, _file; sl_map_memory, _file | threads, isa                             |
 *  | sl_plan_create, sl_complex_plan_create     | region                                   |
 *  | sl_region_create                           | region_bytes                             |
 *
 *  With SL_VERIFY a call refuses a field that is set and that it does not read.
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
    /* 40 entries as in METIS's options array, -1 = METIS's default; NULL: all default. The
     * numbering and debug level are ignored */
    const sl_int *metis_options;
    /* n / block_size x dimensions, row-major: the position of each row in space, for
     * SL_ORDERING_ND, which halves space in flat grids with diagonals, in half the time, and in
     * volumes; other meshes are ordered as without; NULL: unknown */
    const double *coordinates;
    sl_int dimensions; /* of coordinates: 2 or 3 */
    /* rows k block_size .. (k+1) block_size - 1 stay together in the order, such as x, y, z of a
     * vertex; divides n; 0 or 1: no blocks */
    sl_int block_size;
    /* with SL_ORDERING_ND: SL_PURPOSE_ONE_FACTOR orders by minimum degree where dissection would
     * take longer than it saves */
    sl_purpose purpose;

    /* ---- factorization ---- */

    sl_isa isa;
    sl_method method;
    sl_null_pivots null_pivots;
    /* a pivot d is null if |d| <= null_tolerance * (sum of the magnitudes it was computed from);
     * not read where a known null vector decides (sl_factor_create); 0: (64 + n/8) epsilon;
     * negative: only an exact zero is null */
    double null_tolerance;
    /* with SL_NULL_PIVOT_SKIP: n weights m, copied. In each component with a null pivot the
     * solution has sum m x = 0, and b is made consistent by a multiple of m; NULL: x is 0 in the
     * null rows */
    const double *mass;
    /* with SL_NULL_PIVOT_SKIP and no mass: a solve refuses b if |z' b| > consistency_tolerance *
     * sum |b| for a null vector z scaled to 1 in its null row; 0: 1e-6, which accepts
     * single-precision errors; negative: nothing is refused */
    double consistency_tolerance;
    /* with SL_NULL_PIVOT_REFUSE: a null pivot, or one of the wrong sign, becomes sign * max(|d|,
     * regularization * (sum of the magnitudes it was computed from, 1 if that is 0)); 1e-8 suits
     * refinement; 0: no regularization */
    double regularization;
    /* n, copied: the sign that each row's pivot should have, 1 or -1, or 0 for either; NULL: all 1
     */
    const sl_int *signs;

    /* ---- local solves ---- */

    /* where the sweeps of a plan may end; borrowed, must outlive the plan; NULL: at the roots only
     */
    const sl_region *region;
    /* upper bound on the bytes of a region that has a boundary; 0: no bound */
    size_t region_bytes;

    /* with SL_NULL_PIVOT_SKIP: n x null_vector_count numbers, copied. One column: a vector that is
     * a null vector of each connected component that has one; 0 in all rows of a component: its
     * null vectors are unknown; NULL: all 1 */
    const double *null_vector;

    /* a factorization whose stats.factor.growth is larger is refused with SL_ERR_INACCURATE; 0:
     * 1 / epsilon = 4.5e15, or 8.4e6 with SL_STORAGE_FLOAT, beyond which L D L' may agree with A in
     * no digit; negative: no limit */
    double growth_limit;
    /* sl_factor_refine and sl_plan_solve_refined return SL_ERR_INACCURATE if they end above this
     * backward error; 0: 1e-8; negative: never */
    double error_limit;

    /* the columns of null_vector, at most 32: the null vectors of each component are combinations
     * of them (sl_factor_create). Column-major, leading dimension n; 0: 1 */
    size_t null_vector_count;
    /* SL_STORAGE_FLOAT keeps L in half the bytes; solutions have the accuracy of float until they
     * are refined (sl_factor_create) */
    sl_storage storage;

    /* must be NULL; new options take their place, so that the size of the struct never changes */
    const void *reserved[2];
} sl_options;

/** Sets all options to their defaults. size is sizeof(sl_options) of the caller; opt may be NULL.
 *
 *  For bindings: a library with another sl_options refuses the struct with SL_ERR_ARGUMENT instead
 *  of misreading it. C programs may equally well zero the struct.
 */
SL_API void sl_options_init(sl_options *opt, size_t size);

/* src/public/stats.h: what calls report: the location of an error, counts, times and sizes, in groups */

/** Where an error is. Every call resets it. Row and column numbers are the caller's. */
typedef struct sl_error {
    sl_int row;    /* -1: does not apply */
    sl_int column; /* -1: does not apply */
    sl_off line;   /* of a file, 1-based; -1: does not apply */
    double value;  /* the pivot or entry that was refused; 0 if none */
} sl_error;

/** An analysis: sl_symbolic_create, _create_pivoted, sl_symbolic_stats. */
typedef struct sl_symbolic_info {
    sl_int n;
    sl_triangle triangle;
    sl_off nnz_a;      /* entries of A that are read: one triangle with diagonal, with duplicates */
    sl_off nnz_l;      /* entries of L with its unit diagonal, without relaxation */
    sl_off nnz_panels; /* values stored for L, padding and relaxation included */
    double flops;      /* sum over columns of (entries)^2, without relaxation */
    sl_int supernodes;
    sl_int supernodes_fundamental; /* before relaxation */
    sl_int tree_height;            /* columns on the longest path of the elimination tree */
    sl_int components;             /* roots of the elimination tree */
    sl_int pairs;                  /* 2x2 pivots, of sl_symbolic_create_pivoted; else 0 */
    sl_int delayed;                /* times it moved a column to the parent's front; else 0 */
    double seconds_order;          /* processor seconds of the ordering */
    double seconds_analyze;        /* processor seconds of the rest of the analysis, of which: */
    double seconds_tree;           /* elimination tree, column counts and supernodes */
    double seconds_structure;      /* rows of L and the map of A into L */
    size_t bytes;
} sl_symbolic_info;

/** A factorization: sl_factor_create, sl_factor_refactor, their variants, sl_factor_stats. */
typedef struct sl_factor_info {
    sl_isa isa;
    sl_method method;   /* the method that was used */
    sl_int positive;    /* pivots (eigenvalues of 2x2 ones) by sign: the inertia of A */
    sl_int negative;    /* the same */
    sl_int null;        /* null pivots: the skipped ones, or the one that was refused */
    sl_int regularized; /* pivots that regularization changed; they count by their new sign */
    /* with SL_NULL_PIVOT_SKIP: kept pivots within rounding of 0. A component with a known null
     * vector has them where its parts are joined weakly, or if it has a second null vector */
    sl_int weak;
    /* with SL_NULL_PIVOT_SKIP: connected components without a null pivot. Their solutions are
     * unique, and options.mass does not apply to them */
    sl_int regular;
    double pivot_min; /* smallest |d|, or magnitude of an eigenvalue of a 2x2 pivot */
    double pivot_max; /* largest */
    double entry_max; /* largest |a| among the entries of A that were read */
    /* pivot growth, max_k (|L| |D| |L'|)_kk / max |a|, the maximum over the connected components
     * of the pattern: about 1 to 2 for definite matrices, whatever their scaling. The backward
     * error of a solve without refinement is at most about growth * epsilon (sl_factor_create) */
    double growth;
    double seconds_setup; /* processor seconds of schedule and memory in sl_factor_create */
    double seconds;       /* processor seconds of the numbers, summed over all threads */
    size_t bytes;
} sl_factor_info;

/** A local solve: sl_plan_create, sl_plan_stats, sl_local_solve. */
typedef struct sl_plan_info {
    sl_int b_supernodes;   /* supernodes that the forward sweep visits */
    sl_int b_columns;      /* their columns */
    sl_off b_entries;      /* doubles of L that the forward sweep reads */
    sl_int x_supernodes;   /* the same for the backward sweep */
    sl_int x_columns;      /* the same */
    sl_off x_entries;      /* the same */
    int in_region;         /* 1: sweeps end at the boundary of options.region; 0: at the roots */
    sl_off region_entries; /* doubles of the region's inverse that a solve reads */
    size_t bytes;
} sl_plan_info;

/** Entries of the inverse: sl_inverse_diagonal, _pairs, _block, _bilinear. */
typedef struct sl_inverse_info {
    sl_inverse_method method;
    /* SL_INVERSE_FORWARD: of the largest reach swept; SL_INVERSE_SELECTED: of the inverted part */
    sl_int supernodes;
    sl_int columns; /* the same */
    sl_off entries; /* SL_INVERSE_FORWARD: doubles of L that all sweeps together read; else 0 */
} sl_inverse_info;

/** A selected inverse: sl_selected_create, sl_selected_stats. */
typedef struct sl_selected_info {
    sl_int supernodes; /* supernodes whose part of the inverse is kept */
    sl_int columns;    /* their columns */
    sl_off entries;    /* doubles kept */
    double seconds;    /* processor seconds, summed over all threads */
    size_t bytes;
} sl_selected_info;

/** A region: sl_region_create, sl_region_refactor, sl_region_stats. */
typedef struct sl_region_info {
    sl_int rows;     /* rows of A that a plan in it may use, the boundary included */
    sl_int boundary; /* rows of the boundary */
    sl_int subtrees; /* subtrees of supernodes in its interior */
    sl_off entries;  /* doubles of the inverse that are kept */
    int is_copied;   /* 1: copied from a selected inverse; 0: computed by forward sweeps */
    double seconds;  /* processor seconds */
    size_t bytes;
} sl_region_info;

/** Refinement: sl_factor_refine, sl_plan_solve_refined. */
typedef struct sl_refine_info {
    sl_int steps;          /* corrections applied, the maximum over all right-hand sides */
    double backward_error; /* what remains, the maximum over all right-hand sides */
} sl_refine_info;

/** A change of a factor in place: sl_factor_update, _update_entries, _change. */
typedef struct sl_change_info {
    sl_change_method method; /* the way that was taken */
    sl_change_reason reason; /* why; of sl_factor_change */
    sl_int ranks;            /* rank-one changes that the change consists of */
    sl_int padding;          /* not written */
    sl_off entries;          /* doubles of L that rank-one changes read and write */
    sl_off updates;          /* rank-one changes since the last complete factorization */
    /* an estimate of the backward error that they have added: the sum over all passes of epsilon
     * times the largest number a pivot was computed from, relative to the largest |a| */
    double drift;
    double flops_update;   /* of the rank-one changes; 0 if F cannot be changed so */
    double flops_changed;  /* of sl_factor_refactor_changed; of sl_factor_change, else 0 */
    double flops_refactor; /* of sl_factor_refactor; of sl_factor_change, else 0 */
    double seconds;        /* processor seconds */
} sl_change_info;

/** The factor of a principal submatrix: sl_factor_restrict. */
typedef struct sl_restrict_info {
    sl_int kept;     /* columns of L that were copied */
    sl_int computed; /* the others */
    sl_off entries;  /* doubles of L that were copied */
    int is_anew;     /* 1: too few columns to copy: the submatrix was extracted and analyzed */
    int padding;     /* not written */
    double seconds;  /* processor seconds, analysis included */
} sl_restrict_info;

/** An analysis that follows an edit of the pattern: sl_symbolic_edit. */
typedef struct sl_edit_info {
    sl_int changed;   /* rows of B that are new or have other neighbors than before */
    sl_int moved;     /* rows that moved to another separator */
    sl_int reordered; /* rows of subtrees that were ordered anew; n if is_anew */
    sl_int computed;  /* columns of L whose structure was computed anew */
    int is_anew;      /* 1: the edit is not local: all rows were ordered anew */
    int is_due;       /* 1: a new order is due, as growth exceeds 1.1 */
    /* nnz_l relative to that of a new order, which is estimated: the entries of the last one, times
     * the growth of the entries of A since then. A loaded analysis counts as a new one */
    double growth;
    double seconds; /* processor seconds, all included */
} sl_edit_info;

/** What a call reports. Each call sets `error` and the groups listed at its declaration and leaves
 *  the others, so that one struct can collect the groups of many calls. It needs no initialization.
 */
typedef struct sl_stats {
    sl_error error;
    sl_symbolic_info symbolic;
    sl_factor_info factor;
    sl_plan_info plan;
    sl_inverse_info inverse;
    sl_selected_info selected;
    sl_region_info region;
    sl_refine_info refine;
    sl_change_info change;
    sl_restrict_info restriction;
    sl_edit_info edit;
    /* new fields take this space, so that the size of the struct never changes; not written */
    sl_off reserved[10];
} sl_stats;

/** sizeof(sl_stats) in the library: a binding compares it with its own before it passes one. */
SL_API size_t sl_stats_size(void);

/* src/public/csc.h: sparse matrices: creation, checks, products, residuals, Matrix Market files */

/** Creates a matrix from triplets: equal positions are summed, rows are ascending.
 *
 *  out    [out]  the matrix, or NULL on error; release with sl_matrix_free.
 *  count  [in]   number of triplets.
 *  i, j   [in]   count row indices in 0..n_rows-1 and column indices in 0..n_cols-1, any order.
 *  x      [in]   count values; NULL: a pattern without values.
 *  opt    [in]   allocator; may be NULL.
 *  stats  [out]  error.row, error.column: an index out of range; may be NULL.
 *  Returns  SL_OK; SL_ERR_ARGUMENT; SL_ERR_TOO_LARGE: more than 2^31 - 1 triplets, or more than
 *           2^31 - 8 rows or columns; SL_ERR_MEMORY.
 *  Cost     O(count + n_rows + n_cols).
 *  Threads  any number with different outputs.
 */
SL_API SL_WARN_UNUSED sl_status sl_matrix_from_triplets(sl_matrix **out, sl_int n_rows,
                                                        sl_int n_cols, sl_off count,
                                                        const sl_int *i, const sl_int *j,
                                                        const double *x, const sl_options *opt,
                                                        sl_stats *stats);

/** Reads a Matrix Market file: coordinate; real, integer or pattern; general or symmetric.
 *
 *  A symmetric file gives the lower triangle; entries above the diagonal are mirrored into it. A
 *  general file gives its entries as they are. Duplicates are summed. A pattern file gives a matrix
 *  with x = NULL.
 *
 *  out    [out]  the matrix, or NULL on error; release with sl_matrix_free.
 *  path   [in]   name of the file.
 *  opt    [in]   allocator; may be NULL.
 *  stats  [out]  error.line; may be NULL.
 *  Returns  SL_OK; SL_ERR_IO: no such file, or malformed at error.line, also by a line of 65536
 *           bytes or more that is not a comment; SL_ERR_UNSUPPORTED: complex, array, skew-symmetric
 *           or hermitian; SL_ERR_TOO_LARGE; SL_ERR_MEMORY. NaN and infinity are accepted here.
 *  Cost     O(file size + n_rows + n_cols). Memory grows with the entries read, so that a device
 *           without an end does not fill it.
 */
SL_API SL_WARN_UNUSED sl_status sl_matrix_read(sl_matrix **out, const char *path,
                                               const sl_options *opt, sl_stats *stats);

/** sl_matrix_read from memory: length bytes of text, which need no terminating zero. */
SL_API SL_WARN_UNUSED sl_status sl_matrix_parse(sl_matrix **out, const char *text, size_t length,
                                                const sl_options *opt, sl_stats *stats);

/** View of a sparse matrix with 64-bit indices, otherwise as sl_csc: the arrays of MATLAB, Julia,
 *  SuiteSparse's long interface and SciPy's int64. */
typedef struct sl_csc64 {
    int64_t n_rows, n_cols;
    const int64_t *p; /* n_cols + 1 */
    const int64_t *i; /* p[n_cols] */
    const double *x;  /* p[n_cols]; NULL: pattern only */
} sl_csc64;

/** Copies a matrix with 64-bit indices into one with 32-bit indices, entry by entry.
 *
 *  Convert once for each pattern. Entries keep their order, so new values need no conversion: set x
 *  of the view (sl_matrix_view) to the caller's values. With A->x = NULL only the indices are
 *  copied.
 *
 *  out    [out]  the matrix, or NULL on error; release with sl_matrix_free.
 *  opt    [in]   allocator; may be NULL.
 *  stats  [out]  error.column: positions that are not ascending; with error.row, if it fits its
 *                type, an index out of range; may be NULL.
 *  Returns  SL_OK; SL_ERR_ARGUMENT; SL_ERR_PATTERN; SL_ERR_TOO_LARGE: more than 2^31 - 8 rows or
 *           columns, or more than 2^31 - 1 entries; SL_ERR_MEMORY.
 *  Cost     O(n_cols + nnz).
 *  Threads  any number with different outputs.
 *  Example  tests/core/test_csc64.c
 */
SL_API SL_WARN_UNUSED sl_status sl_matrix_from_csc64(sl_matrix **out, const sl_csc64 *A,
                                                     const sl_options *opt, sl_stats *stats);

/** The transpose of a general matrix (as SL_AS_STORED). Rows are ascending; duplicates stay.
 *
 *  Returns  SL_OK; SL_ERR_ARGUMENT; SL_ERR_PATTERN; SL_ERR_TOO_LARGE; SL_ERR_MEMORY.
 *  Cost     O(n_rows + n_cols + nnz).
 */
SL_API SL_WARN_UNUSED sl_status sl_matrix_transpose(sl_matrix **out, const sl_csc *A,
                                                    const sl_options *opt);

/** The symmetric permutation C = P A P' of a square matrix: C(k, l) = A(perm[k], perm[l]).
 *
 *  If A stores one triangle, C has its lower triangle; if A stores both, so does C.
 *
 *  perm   [in]   n entries, a permutation of 0..n-1.
 *  Returns  SL_OK; SL_ERR_ARGUMENT: not square, not a permutation; SL_ERR_PATTERN;
 *           SL_ERR_TOO_LARGE; SL_ERR_MEMORY.
 *  Cost     O(n + nnz).
 */
SL_API SL_WARN_UNUSED sl_status sl_matrix_permute(sl_matrix **out, const sl_csc *A,
                                                  const sl_int *perm, const sl_options *opt);

/** The arrays of a matrix; valid as long as M. A NULL M gives a 0 x 0 view. */
SL_API sl_csc sl_matrix_view(const sl_matrix *M);

/** Releases a matrix; NULL is allowed. */
SL_API void sl_matrix_free(sl_matrix *M);

/** Checks a view: sizes, positions ascending from 0, indices in range.
 *
 *  stats  [out]  error.column and, for an index out of range, error.row; may be NULL.
 *  Returns  SL_OK; SL_ERR_ARGUMENT: A or one of its arrays is NULL; SL_ERR_PATTERN;
 *           SL_ERR_TOO_LARGE: more rows or columns than sl_csc allows.
 *  Cost     O(n_cols + nnz).
 */
SL_API SL_WARN_UNUSED sl_status sl_csc_check(const sl_csc *A, sl_stats *stats);

/** Determines the triangle of a square matrix that the factorization reads.
 *
 *  If A stores both triangles, checks that its pattern is symmetric.
 *
 *  out    [out]  the triangle; on error untouched.
 *  opt    [in]   allocator, triangle; may be NULL.
 *  stats  [out]  error.row, error.column: an entry without its mirror image; may be NULL.
 *  Returns  SL_OK; SL_ERR_ARGUMENT: not square; SL_ERR_PATTERN; SL_ERR_TOO_LARGE; SL_ERR_MEMORY.
 *  Cost     O(n + nnz).
 */
SL_API SL_WARN_UNUSED sl_status sl_csc_triangle(const sl_csc *A, sl_triangle *out,
                                                const sl_options *opt, sl_stats *stats);

/** Y = A X.
 *
 *  reading  [in]   SL_AS_SYMMETRIC: A is square, and one triangle defines it, the lower one if both
 *                  are stored; SL_AS_STORED: any shape.
 *  Y        [out]  n_rows x nrhs, column-major, leading dimension ldy elements; must not overlap X
 *                  (Y = X is refused).
 *  X        [in]   n_cols x nrhs, column-major, leading dimension ldx elements.
 *  Returns  SL_OK; SL_ERR_ARGUMENT. The pattern is not checked (sl_csc_check).
 *  Cost     O(nnz nrhs).
 */
SL_API SL_WARN_UNUSED sl_status sl_csc_multiply(const sl_csc *A, sl_reading reading, double *Y,
                                                size_t ldy, const double *X, size_t ldx,
                                                sl_int nrhs);

/** R = B - A X for a symmetric A, and the backward error of each column.
 *
 *  A               [in]   as SL_AS_SYMMETRIC in sl_csc_multiply.
 *  R               [out]  n x nrhs, column-major, leading dimension ldr elements. May be B itself
 *                         (then ldr = ldb) if backward_error is NULL; must not overlap X.
 *  X, B            [in]   n x nrhs, column-major, leading dimensions ldx and ldb elements.
 *  backward_error  [out]  nrhs numbers ||r|| / (||A|| ||x|| + ||b||) in the infinity norm; 0 if r =
 *                         0, NaN if r has a NaN or the denominator overflows; may be NULL.
 *  Returns  SL_OK; SL_ERR_ARGUMENT. The pattern is not checked.
 *  Cost     O(nnz nrhs).
 */
SL_API SL_WARN_UNUSED sl_status sl_csc_residual(const sl_csc *A, double *R, size_t ldr,
                                                double *backward_error, const double *X, size_t ldx,
                                                const double *B, size_t ldb, sl_int nrhs);

/** Writes a Matrix Market file that reads back to the same bits (%.17g).
 *
 *  An existing file is replaced only once the new one is complete. The lines go to a new file in
 *  the same folder, path.tmp00 to path.tmp99, which is renamed to path at the end. On error the old
 *  file is as it was and no temporary file is left; a kill may leave the temporary one. The new
 *  file has the permissions, owner and group of the old one. Written in place: what is not a
 *  regular file (a device, a pipe, a symbolic link); a mount point; a file in a folder where no
 *  file can be created; a file of another owner or group. Nothing waits for the disk: a crash of
 *  the system may lose both files.
 *
 *  Windows: the same, but the new file gets the permissions that new files in the folder get. Two
 *  processes must not write one path at the same time.
 *  Others without POSIX: where rename refuses an existing name, the old file is removed just before
 *  the renaming. If the renaming then fails, or a kill comes between the two, the complete file has
 *  its temporary name.
 *
 *  reading  [in]  SL_AS_STORED: a general file of all entries; SL_AS_SYMMETRIC: a symmetric file of
 *                 one triangle.
 *  Returns  SL_OK; SL_ERR_ARGUMENT; SL_ERR_PATTERN: malformed, or not symmetric with
 *           SL_AS_SYMMETRIC; SL_ERR_IO; SL_ERR_MEMORY; SL_ERR_TOO_LARGE.
 */
SL_API SL_WARN_UNUSED sl_status sl_csc_write(const sl_csc *A, sl_reading reading, const char *path);

/* src/public/analyze.h: the analysis of a pattern: ordering, elimination tree, supernodes, storage of L */

/** Analyses the pattern of a symmetric matrix, for any number of factorizations with that pattern.
 *
 *  Orders the rows; computes the elimination tree, its postorder, column counts, supernodes and
 *  their row structure; and maps each entry of A to its position in L.
 *
 *  SL_ORDERING_GIVEN and SL_ORDERING_NATURAL keep the caller's order if it is a postorder of the
 *  supernodes: the columns of each supernode are consecutive, and so are those of each subtree of
 *  supernodes. L is stored in this form, so that any other order is replaced by an equivalent one,
 *  with the same fill and the same elimination tree up to numbering: the columns of a supernode
 *  keep the caller's order, and sibling subtrees follow each other by their last columns. With
 *  SL_RELAXATION_NONE every postorder of the elimination tree is kept; the default relaxation may
 *  move a small supernode next to the parent it merges into. sl_symbolic_view's perm is the order
 *  used.
 *
 *  SL_ORDERING_ND is nested dissection. On graphs whose degrees vary, as those of networks and KKT
 *  systems, it also tries minimum degree, and takes that if L has fewer entries and the paths to
 *  the roots have fewer of them.
 *
 *  The other orderings treat a row that stores no diagonal entry and has 8 neighbors or more, and
 *  sqrt(n) or more, as a constraint, such as m in [L m; m' 0]: they never order it after all of its
 *  neighbors, so that no pivot of a singular Laplacian L is null. A corner that stores a zero hides
 *  this.
 *
 *  out    [out]  the analysis, or NULL on error; release with sl_symbolic_free.
 *  A      [in]   n x n, symmetric; values are not read (x may be NULL); not kept.
 *  opt    [in]   allocator, ordering, relaxation, triangle, perm, metis_options, coordinates,
 *                dimensions, block_size, purpose; may be NULL. coordinates and purpose are used by
 *                SL_ORDERING_ND only, and block_size by all but SL_ORDERING_GIVEN and
 *                SL_ORDERING_NATURAL; every ordering refuses invalid ones.
 *  stats  [out]  symbolic; may be NULL.
 *  Returns  SL_OK; SL_ERR_ARGUMENT: not square, perm is not a permutation (error.row is the first
 *           offending position), an unknown ordering, purpose, relaxation or triangle,
 *           metis_options that METIS would refuse, a block_size that does not divide n, dimensions
 *           other than 2 or 3;
 *           SL_ERR_NOT_FINITE: a coordinate (error.row is the first row of its block);
 *           SL_ERR_PATTERN; SL_ERR_UNSUPPORTED: METIS is not compiled in; SL_ERR_ORDERING;
 *           SL_ERR_TOO_LARGE; SL_ERR_MEMORY.
 *  Cost     the ordering, then nearly O(nnz(A) + rows of the supernodes).
 *  Threads  any number of calls at once, with the same result for the same pattern however it is
 *           stored, on every processor and with every compiler, except with METIS: METIS seeds and
 *           draws from rand() of the C library and prints a line if it runs out of memory. During
 *           SL_ORDERING_METIS it traps SIGABRT and SIGTERM of the whole process; during
 *           SL_ORDERING_METIS_REFINED it raises SIGABRT if it runs out of memory. Concurrent calls
 *           with METIS are safe only if rand() is, and may then order differently from run to run.
 *  Source   [George73] nested dissection; [KK98] multilevel graphs; [FM82] refinement of
 *           separators; [FF56] minimum vertex cuts; [ADD96] minimum degree; [Liu90] elimination
 *           tree; [GNP94] counts; [AG89] relaxed supernodes.
 *  Example  tests/core/test_symbolic.c
 */
SL_API SL_WARN_UNUSED sl_status sl_symbolic_create(sl_symbolic **out, const sl_csc *A,
                                                   const sl_options *opt, sl_stats *stats);

/** Analyses a symmetric indefinite matrix, with pivots that are chosen by its values.
 *
 *  For matrices that have no stable factorization with a diagonal D in the order of the pattern, as
 *  KKT systems with zeros on the diagonal or an indefinite H. A factorization selects 1x1 and 2x2
 *  pivots by threshold partial pivoting: with these values no entry of L exceeds 100. A column
 *  without an acceptable pivot in its front is delayed: it moves up to the parent's front. The
 *  result is analyzed in the order of the pivots, and D of its factors has 2x2 blocks.
 *
 *  The pivots are those of the values of A. Factors of other values keep them, and are then no more
 *  accurate than in any fixed order: check stats.factor.growth, as with any indefinite matrix
 *  (sl_factor_create), and analyze again if it is large. All calls work on these factors except the
 *  following.
 *  - If there are 2x2 pivots, factors use the supernodal method, whatever options.method, and
 *    entries of the inverse, selected inverses and regions give SL_ERR_UNSUPPORTED.
 *  - SL_NULL_PIVOT_SKIP gives SL_ERR_UNSUPPORTED.
 *  - With options.regularization and no signs, pivots of both signs are right, and only null ones
 *    are replaced. Signs do not apply to 2x2 pivots. A null one is shifted in both rows.
 *
 *  out    [out]  the analysis, or NULL on error; release with sl_symbolic_free. It has no separator
 *                tree.
 *  A      [in]   n x n, symmetric, with values; not kept.
 *  opt    [in]   as sl_symbolic_create; the ordering is the one to start from.
 *  stats  [out]  symbolic, pairs and delayed included; may be NULL.
 *  Returns  as sl_symbolic_create; SL_ERR_ARGUMENT: A has no values; SL_ERR_NOT_FINITE: an entry at
 *           error.row, error.column. A singular matrix is analyzed; its factorization is refused.
 *  Cost     two analyses, of which one orders, and a factorization in plain C on one thread, which
 *           keeps its update matrices in memory of their own.
 *  Threads  as sl_symbolic_create.
 *  Source   [DR83] multifrontal with 1x1 and 2x2 pivots.
 *  Example  tests/core/test_pivots.c
 */
SL_API SL_WARN_UNUSED sl_status sl_symbolic_create_pivoted(sl_symbolic **out, const sl_csc *A,
                                                           const sl_options *opt, sl_stats *stats);

/** Releases an analysis; NULL is allowed. Objects made from it must not be used afterwards. */
SL_API void sl_symbolic_free(sl_symbolic *S);

/** Fills the symbolic group of stats. */
SL_API void sl_symbolic_stats(const sl_symbolic *S, sl_stats *stats);

/** Arrays of an analysis; valid as long as the analysis.
 *
 *  Supernode s has columns super_first[s] .. super_first[s+1]-1 of L, stored as one dense panel:
 *  the rows of these columns, then rows rows[rows_begin[s]] .. rows[rows_begin[s+1]-1] below them,
 *  ascending. Supernodes are in postorder. The panel is stored in row tiles, [tile][column][8],
 *  from position panel_begin[s] of sl_factor_view's L: tile t has local rows 8t .. 8t+7 of columns
 *  0 .. min(width, 8(t+1))-1. The unit diagonal and the entries above it are stored as 0.
 *
 *  SL_ORDERING_ND and SL_ORDERING_METIS_REFINED keep their separator tree. With other orderings,
 *  with minimum degree, and if a constraint was moved, n_nodes = 0 and the arrays are NULL. A node
 *  is a separator, or a subgraph that was not divided further. An entry of A joins two nodes only
 *  if one is an ancestor of the other. Nodes are numbered in elimination order, so that a separator
 *  follows the subgraphs that it separates.
 */
typedef struct sl_symbolic_arrays {
    sl_int n;
    sl_int n_supers;
    const sl_int *perm;         /* n: perm[k] = row of A that is pivot k */
    const sl_int *iperm;        /* n: the inverse of perm */
    const sl_int *parent;       /* n: elimination tree of P A P', -1 at a root */
    const sl_int *counts;       /* n: entries of column k of L with diagonal, without relaxation */
    const sl_int *super_first;  /* n_supers + 1 */
    const sl_int *super_of;     /* n: supernode of column k */
    const sl_int *super_parent; /* n_supers: -1 at a root */
    const sl_off *rows_begin;   /* n_supers + 1 */
    const sl_int *rows;         /* rows_begin[n_supers] */
    const sl_off *panel_begin;  /* n_supers + 1, in doubles */
    const unsigned char *pairs; /* n: 1, 2 at the two columns of a 2x2 pivot, else 0; or NULL */
    sl_int n_nodes;             /* nodes of the separator tree */
    const sl_int *node_of;      /* n: node of column k */
    const sl_int *node_parent;  /* n_nodes: -1 at a root */
    const sl_int *node_level;   /* n_nodes: distance from the root */
} sl_symbolic_arrays;

SL_API sl_symbolic_arrays sl_symbolic_view(const sl_symbolic *S);

/* src/public/factor.h: the numerical factorization P A P' = L D L' */

/** Factors P A P' = L D L' in the order of S: L unit lower triangular, D diagonal and of any sign,
 *  or with the 2x2 blocks of sl_symbolic_create_pivoted.
 *
 *  Definite and quasi-definite matrices can be factored in any order. Other symmetric indefinite
 *  matrices can be factored if no pivot is null. A pivot d is null if
 *  |d| <= null_tolerance * (sum of the magnitudes it was computed from); it is refused, skipped or
 *  regularized, depending on the options. Rounding from heavier rows may hide a null pivot from
 *  this test. Where null pivots are refused and null_tolerance is not negative, the last pivot of a
 *  component is therefore also null if it is below 16 (64 + n/8) epsilon times the heaviest pivot
 *  and constants are a null vector of the component, as defined below.
 *
 *  Accuracy: without pivoting, a small pivot of an indefinite matrix makes L grow, and digits of A
 *  are lost without any pivot being null, as in [1e-20 1; 1 1]. stats.factor.growth measures this.
 *  - Definite matrices have a growth of at most 2, however badly they are scaled, and need no test.
 *  - The backward error of sl_factor_solve and of local solves, as sl_csc_residual computes it, is
 *    at most about epsilon * growth: use a solution as it is if this is small enough and
 *    stats.factor.regularized is 0. It is a bound on normwise errors; rows that are tiny against
 *    others of their component can be worse, which sl_factor_refine sees.
 *  - Otherwise call sl_factor_refine, and trust X if it returns SL_OK. It repairs most systems
 *    whose growth is below options.growth_limit.
 *  - A growth beyond options.growth_limit is refused with SL_ERR_INACCURATE.
 *
 *  Storage: with SL_STORAGE_FLOAT each front is factored in double, and its panel of L is rounded
 *  to float when it is done. D, null pivots, growth and log-determinant are those of double, and
 *  every solve computes in double. L D L' is P (A + E) P' with |E| <= 1.2e-7 |L| |D| |L'|:
 *  solutions and entries of the inverse have a backward error of about 6e-8 * growth. The pivots
 *  are not rounded, so a definite matrix stays definite.
 *  - Full solves: each step of sl_factor_refine multiplies the error of x, in the energy norm of a
 *    definite matrix, by about 1e-7 sqrt(condition): 2 to 5 steps up to a condition of 1e9, more up
 *    to about 1e11. Beyond that, as sl_factor_rcond shows, use double: refinement then returns
 *    SL_ERR_INACCURATE, and a solution without it has no digit. Measured on grids for M + t (L
 *    M^-1)^(k-1) L, smoothing over a tenth of the grid, backward error and largest error of x:
 *
 *    | k, rows          | condition | no step    | 1 step     | 2 steps    | L in double |
 *    |------------------|-----------|------------|------------|------------|-------------|
 *    | 1 harmonic, 1e4  | 3e3       | 5e-8, 4e-7 | 2e-14, 2e-14 | 2e-16, 6e-15 | 5e-16, 7e-15 |
 *    | 1 harmonic, 1e6  | 3e5       | 1e-7, 5e-6 | 6e-13, 4e-13 | 3e-16, 5e-14 | 2e-15, 1e-13 |
 *    | 2 biharmonic, 1e4  | 9e6     | 4e-8, 8e-4 | 3e-11, 3e-10 | 3e-16, 6e-12 | 7e-16, 8e-12 |
 *    | 2 biharmonic, 1e5  | 2e9     | 6e-8, 2e-2 | 1e-9, 5e-8 | 1e-15, 5e-10 | 2e-15, 4e-10 |
 *    | 3 triharmonic, 1e4 | 3e10    | 3e-8, 0.9  | 3e-8, 7e-6 | 2e-13, 3e-7 | 1e-15, 2e-8 |
 *    | 3 triharmonic, 1e5 | 6e13    | 4e-8, 300  | 4e-8, 300  | 4e-8, 300  | 2e-15, 6e-6 |
 *
 *  - Local solves cannot be refined, as the residual needs all of x.
 *  - The method is supernodal. sl_factor_update and _update_entries return SL_ERR_UNSUPPORTED: each
 *    change would round L again. sl_factor_change and sl_factor_refactor_changed refactor
 *    completely. Files of such factors are not supported.
 *  - An entry of L beyond the range of float is refused with SL_ERR_INACCURATE, as growth is; so is
 *    one that underflows where that loses more than rounding does. Scaling A to a unit diagonal
 *    avoids both.
 *
 *  Singular matrices: SL_NULL_PIVOT_SKIP factors positive or negative semidefinite matrices and
 *  skips null pivots; a Laplacian has one in each connected component, the last pivot of the
 *  component. Rounding cannot tell whether a pivot is null where weights differ by orders of
 *  magnitude, so the null vector decides. Let z be options.null_vector, or constant. Components are
 *  those of the graph of nonzero entries; duplicates that cancel are zeros.
 *  - Where |A z|_i <= 16 n_i epsilon (|A| |z|)_i in all rows i of a component, n_i the entries of
 *    row i, and z is not 0 in its last row, the last pivot is null, and no other one is. A pivot
 *    within rounding of 0, as where a weak spring joins two grids, is kept and counted in
 *    stats.factor.weak. If such a component has a second null vector that is not given, its
 *    solutions are arbitrary in that direction; set z = 0 there.
 *  - Components with several null vectors, as elastic bodies without supports, need all of them:
 *    options.null_vector is then a matrix of options.null_vector_count columns, such as the 3 rigid
 *    motions in 2D or the 6 in 3D. Each component keeps those combinations of the columns that
 *    A Z = 0 holds for, by the bound above: a body that hangs on one hinge keeps the rotation about
 *    it. As many of its pivots are skipped, in rows that are far from each other, and no other one
 *    is null. The directions of translations and the center of rotations may be any; a center far
 *    from a body costs digits. In each tree of the elimination forest, the null vectors of all
 *    components with more than one row must not be more than the columns.
 *  - In other components, and where z is 0, null_tolerance decides. It misses null pivots whose
 *    rounding errors come from rows much heavier than their own, and takes regular pivots for null
 *    that are smaller than it.
 *  - Components without a null pivot are counted in stats.factor.regular. Their solutions are
 *    unique; weights do not apply to them. If all components should be singular, check that it is
 *    0.
 *  - An indefinite matrix is refused: a diagonal entry or a pivot of the wrong sign beyond
 *    rounding, or a null pivot by the tolerance without a null vector.
 *  - With options.mass, weights m, and one null vector a component, every solve, full or local,
 *    computes in each component with a null pivot the x with sum m x = 0 that solves A x = b - c m.
 *    Here z is the null vector of the component, as above or computed from L, and c = z' b / z' m
 *    makes the right-hand side consistent. For a Laplacian z is constant, and x is the zero-mean
 *    solution of the Poisson problem. If all weights of a component are 0, as for a vertex without
 *    faces, all count as 1. A row of zeros is a component by itself, whatever the pattern; its x is
 *    0.
 *  - Without options.mass, x is 0 in the rows of sl_factor_null_rows, and a solve refuses an
 *    inconsistent right-hand side with SL_ERR_INCONSISTENT (options.consistency_tolerance;
 *    sl_factor_defects computes how inconsistent it is). If that check is switched off, the
 *    residual of such a system is nonzero in these rows only.
 *  - Entries of the inverse are those of the generalized inverse that makes x 0 in the null rows.
 *
 *  KKT systems: with options.regularization and the known signs of the pivots, L D L' = P (A + E)
 *  P' where the diagonal matrix E is nonzero in the rows of sl_factor_regularized_rows only.
 *  sl_factor_refine and sl_plan_solve_refined then solve A x = b. If many diagonal entries are 0,
 *  add a small multiple of the signs to the whole diagonal beforehand: A becomes quasi-definite,
 *  and refinement removes the perturbation. If the signs are not those of the blocks, as when H is
 *  indefinite, regularization does not replace pivoting; stats.refine.backward_error shows this.
 *  sl_symbolic_create_pivoted needs neither signs nor shifts.
 *
 *  out    [out]  the factor, or NULL on error; release with sl_factor_free.
 *  S      [in]   analysis of A's pattern; borrowed, must outlive the factor.
 *  A      [in]   n x n with values; the analyzed pattern with its entries in the same order.
 *  opt    [in]   allocator, threads, isa, method, null_pivots, null_tolerance, mass,
 *                consistency_tolerance, regularization, signs, null_vector, null_vector_count,
 *                growth_limit, error_limit, storage; may be NULL.
 *  stats  [out]  factor; may be NULL.
 *  Returns  SL_OK; SL_ERR_ARGUMENT: no values, an option out of range or NaN, a weight or an entry
 *           of null_vector that is not finite or a sign other than -1, 0, 1 (error.row);
 *           SL_ERR_PATTERN: not the analyzed pattern; SL_ERR_PIVOT: a null pivot at error.row; with
 *           SL_NULL_PIVOT_SKIP, the row that shows that A is indefinite; with mass, a second null
 *           pivot in its component, or one whose null vector z has z' m = 0; SL_ERR_NOT_FINITE: at
 *           error.row, and error.column if it is an entry of A; with mass, also a mean that
 *           overflows; SL_ERR_INACCURATE: growth above its limit, caused by the pivot error.value
 *           of error.row, or an entry of L in the column of that pivot that float cannot hold;
 *           SL_ERR_UNSUPPORTED: the isa, or SL_NULL_PIVOT_SKIP with a pivoted analysis, mass with
 *           several null vectors, or more of them in the tree of error.row than columns;
 *           SL_ERR_TOO_LARGE: L exceeds size_t; SL_ERR_MEMORY.
 *  Cost     O(sum over columns of entries^2) flops. Keeps nnz_panels doubles, or floats and the
 *           largest panel in double for each thread, and, with the
 *           supernodal method, the update stack: about 5 % more for 2D meshes and 30 % for 3D
 *           meshes, more with threads. SL_NULL_PIVOT_SKIP adds a product
 *           with A, 66 bytes per row, and a few operations per visited column in solves; mass adds
 *           a forward sweep, 24 bytes per row, and as many operations again. k > 1 null vectors
 *           take k + 1 products with A, O(n k^2) operations, 24 (k + 1)
 *           bytes per row, and 2 k operations per visited column in solves.
 *  Threads  any number of calls at once on one S. options.threads distributes one call, and every
 *           sl_factor_refactor of the factor, by one loop of the pool, whose bodies draw subtrees
 *           and pieces of large fronts until none is left. A thread that begins late, or never,
 *           leaves its share to the others. Small systems use fewer threads. L has the same bits
 *           for any number of threads. Only the supernodal method uses threads, where the compiler
 *           has atomic operations (gcc, clang, MSVC).
 *  Source   supernodal: multifrontal [DR83] [Liu92] on row tiles; up-looking: [LDL05], [Davis06]
 *           4.7; growth: [Hi02] 11.1.
 *  Example  tests/core/test_factor.c, test_growth.c
 */
SL_API SL_WARN_UNUSED sl_status sl_factor_create(sl_factor **out, const sl_symbolic *S,
                                                 const sl_csc *A, const sl_options *opt,
                                                 sl_stats *stats);

/** Factors a matrix of the same pattern with new values. Allocates nothing; same bits as
 *  sl_factor_create.
 *
 *  F      [in,out]  unchanged after SL_ERR_ARGUMENT and SL_ERR_PATTERN. After SL_ERR_PIVOT,
 *                   SL_ERR_NOT_FINITE and SL_ERR_INACCURATE it has no numbers, and every solve
 *                   refuses it until a refactor succeeds.
 *  A      [in]      the analyzed pattern, new values.
 *  stats  [out]     factor; may be NULL.
 *  Returns, Cost    as sl_factor_create, but never SL_ERR_UNSUPPORTED; SL_ERR_STATE: a mapped
 *                   factor (sl_map_file). SL_ERR_MEMORY and SL_ERR_TOO_LARGE only with the first
 *                   refactorization of a loaded factor (sl_load_file), which allocates its fronts.
 *  Threads          exclusive use of F.
 *  Example          tests/core/test_factor.c
 */
SL_API SL_WARN_UNUSED sl_status sl_factor_refactor(sl_factor *F, const sl_csc *A, sl_stats *stats);

/** Refactors after local changes: recomputes only the columns of L that the changes reach.
 *
 *  Meant for many changes in one place. Each recomputed supernode gathers from all its descendants,
 *  and the reach of a single vertex ends in the large top separators: on a 2D mesh that already
 *  costs about 30 % of a factorization. Results agree with sl_factor_refactor to rounding; the
 *  other columns of L keep their bits. An up-looking factor is recomputed completely.
 *
 *  F        [in,out]  the factor of a matrix that differs from A in the given columns only.
 *                     Unchanged after SL_ERR_ARGUMENT, _PATTERN, _STATE and _MEMORY; without
 *                     numbers after other errors.
 *  A        [in]      the analyzed pattern, new values.
 *  columns  [in]      count columns of A, in which A stores changed entries; any order, repetitions
 *                     allowed.
 *  stats    [out]     factor, of all of L and A: the growth is that of sl_factor_refactor, to
 *                     rounding; may be NULL.
 *  Returns  as sl_factor_create; SL_ERR_ARGUMENT: a column out of range (error.row); SL_ERR_STATE:
 *           F has no numbers, or is mapped.
 *  Cost     the update matrices of all descendants of the supernodes reached. Temporary memory: 16
 *           bytes per entry of the columns, 4 per row of A, of which only those reached are
 *           touched, and 4 per row of the largest front. With null pivots and
 *           mass, one complete sweep over L.
 *  Threads  exclusive use of F.
 *  Source   left-looking supernodal factorization [NP93] over the reach of the changes.
 *  Example  tests/core/test_refactor_changed.c
 */
SL_API SL_WARN_UNUSED sl_status sl_factor_refactor_changed(sl_factor *F, const sl_csc *A,
                                                           const sl_int *columns, sl_int count,
                                                           sl_stats *stats);

/** Releases a factor; NULL is allowed. */
SL_API void sl_factor_free(sl_factor *F);

/** Fills the factor group of stats. */
SL_API void sl_factor_stats(const sl_factor *F, sl_stats *stats);

/** The rows whose null pivots were skipped, in elimination order.
 *
 *  rows      [out]  the first min(capacity, *count) of them; may be NULL if capacity = 0.
 *  capacity  [in]   length of rows.
 *  count     [out]  how many there are; may exceed capacity.
 *  Returns  SL_OK; SL_ERR_ARGUMENT; SL_ERR_STATE: failed factor.  Cost  O(count).
 */
SL_API SL_WARN_UNUSED sl_status sl_factor_null_rows(const sl_factor *F, sl_int *rows,
                                                    sl_int capacity, sl_int *count);

/** The rows whose pivots regularization changed, in elimination order, and the diagonal matrix E.
 *
 *  rows      [out]  the first min(capacity, *count) of them; may be NULL if capacity = 0.
 *  shifts    [out]  the diagonal entries of E in these rows; may be NULL.
 *  capacity  [in]   length of rows and shifts.
 *  count     [out]  how many there are; may exceed capacity.
 *  Returns  SL_OK; SL_ERR_ARGUMENT; SL_ERR_STATE: failed factor.  Cost  O(count).
 */
SL_API SL_WARN_UNUSED sl_status sl_factor_regularized_rows(const sl_factor *F, sl_int *rows,
                                                           double *shifts, sl_int capacity,
                                                           sl_int *count);

/** log |det A| and the sign of det A (-1 or 1); the determinant of a 0 x 0 matrix is 1.
 *
 *  If null pivots were skipped: the determinant of A without their rows and columns. For a
 *  Laplacian this is, in each component, the product of its nonzero eigenvalues divided by its
 *  number of rows. If regularization changed pivots: the determinant of A + E. Computed as a sum of
 *  logarithms, which cannot overflow.
 *
 *  Returns  SL_OK; SL_ERR_ARGUMENT; SL_ERR_STATE: failed factor.  Cost  O(n).
 */
SL_API SL_WARN_UNUSED sl_status sl_factor_logdet(const sl_factor *F, double *log_abs_det,
                                                 double *sign);

/** L as a matrix in compressed columns, with its unit diagonal, rows ascending.
 *
 *  Contains the entries that are not exactly 0: zeros from relaxation and padding are left out, and
 *  so is an entry that became 0 by cancellation.
 *
 *  out    [out]  the matrix, or NULL on error; release with sl_matrix_free.
 *  opt    [in]   allocator; may be NULL.
 *  Returns  SL_OK; SL_ERR_ARGUMENT; SL_ERR_STATE: failed factor; SL_ERR_TOO_LARGE: 2^31 or more
 *           entries; SL_ERR_MEMORY.
 */
SL_API SL_WARN_UNUSED sl_status sl_factor_lower(sl_matrix **out, const sl_factor *F,
                                                const sl_options *opt);

/** Arrays of a factor; valid as long as the factor. */
typedef struct sl_factor_arrays {
    const sl_symbolic *symbolic;
    /* panels, in the layout described at sl_symbolic_arrays; NULL with SL_STORAGE_FLOAT */
    const double *L;
    const double *D; /* n pivots, in pivot order; DBL_MAX for a null pivot that was skipped */
    const double *E; /* n: D(k+1, k) at the first column k of a 2x2 pivot; NULL: there is none */
    const float *L_float; /* the same panels with SL_STORAGE_FLOAT; else NULL */
} sl_factor_arrays;

SL_API sl_factor_arrays sl_factor_view(const sl_factor *F);

/* src/public/solve.h: full solves, and the workspace of all solves */

/** Creates an empty workspace for one thread. It grows when a call needs more and never shrinks.
 *
 *  out  [out]  the workspace, or NULL on error; release with sl_work_free.
 *  opt  [in]   allocator; may be NULL.
 *  Returns  SL_OK; SL_ERR_ARGUMENT; SL_ERR_MEMORY.
 */
SL_API SL_WARN_UNUSED sl_status sl_work_create(sl_work **out, const sl_options *opt);

/** Releases a workspace; NULL is allowed. */
SL_API void sl_work_free(sl_work *W);

/** Bytes that a workspace holds now. */
SL_API size_t sl_work_bytes(const sl_work *W);

/** Grows W so that full solves with F and up to nrhs right-hand sides allocate nothing.
 *
 *  Returns  SL_OK; SL_ERR_ARGUMENT; SL_ERR_TOO_LARGE; SL_ERR_MEMORY.
 */
SL_API SL_WARN_UNUSED sl_status sl_work_reserve_factor(sl_work *W, const sl_factor *F, sl_int nrhs);

/** Grows W so that solves of plan P with up to nrhs right-hand sides allocate nothing.
 *
 *  Returns  SL_OK; SL_ERR_ARGUMENT; SL_ERR_TOO_LARGE; SL_ERR_MEMORY.
 */
SL_API SL_WARN_UNUSED sl_status sl_work_reserve_plan(sl_work *W, const sl_plan *P, sl_int nrhs);

/** Grows W so that sl_local_solve allocates nothing for b-sets of up to nb rows, x-sets of up to nx
 *  rows and up to nrhs right-hand sides. A set that is NULL has n rows.
 *
 *  The sets are not known yet, so the bound is nb and nx times the longest path of the elimination
 *  tree, and never more than the whole of it. It is generous: W keeps that many bytes, and a W that
 *  grows by itself in the first solves stays smaller.
 *
 *  Returns  SL_OK; SL_ERR_ARGUMENT; SL_ERR_TOO_LARGE; SL_ERR_MEMORY.
 *  Cost     O(supernodes) for the length of the longest path.
 *  Example  tests/core/test_reserve.c
 */
SL_API SL_WARN_UNUSED sl_status sl_work_reserve_local(sl_work *W, const sl_symbolic *S, sl_int nb,
                                                      sl_int nx, sl_int nrhs);

/** Grows W so that sl_factor_refine with up to nrhs right-hand sides allocates nothing.
 *
 *  Returns  SL_OK; SL_ERR_ARGUMENT; SL_ERR_TOO_LARGE; SL_ERR_MEMORY.
 */
SL_API SL_WARN_UNUSED sl_status sl_work_reserve_refine(sl_work *W, const sl_factor *F, sl_int nrhs);

/** Grows W so that sl_plan_solve_refined on plan P with up to nrhs right-hand sides allocates
 *  nothing, whatever factor it is called with.
 *
 *  Returns  SL_OK; SL_ERR_ARGUMENT; SL_ERR_TOO_LARGE; SL_ERR_MEMORY.
 */
SL_API SL_WARN_UNUSED sl_status sl_work_reserve_refined(sl_work *W, const sl_plan *P, sl_int nrhs);

/** Grows W so that sl_factor_rcond allocates nothing.
 *
 *  Returns  SL_OK; SL_ERR_ARGUMENT; SL_ERR_TOO_LARGE; SL_ERR_MEMORY.
 */
SL_API SL_WARN_UNUSED sl_status sl_work_reserve_rcond(sl_work *W, const sl_factor *F);

/** Grows W so that sl_factor_defects with up to nrhs right-hand sides allocates nothing.
 *
 *  Returns  SL_OK; SL_ERR_ARGUMENT; SL_ERR_TOO_LARGE; SL_ERR_MEMORY.
 */
SL_API SL_WARN_UNUSED sl_status sl_work_reserve_defects(sl_work *W, const sl_factor *F,
                                                        sl_int nrhs);

/** Solves A X = B. For a singular A, sl_factor_create describes which solution is computed.
 *
 *  F      [in]   factor of A, n x n.
 *  X      [out]  n x nrhs, column-major, leading dimension ldx elements, rows in the order of A.
 *                May be B itself (then ldx = ldb). On error untouched.
 *  B      [in]   n x nrhs, column-major, leading dimension ldb elements.
 *  nrhs   [in]   number of right-hand sides, 0 or more. They are solved in blocks of 8; a block
 *                takes as long as two to three single solves.
 *  W      [in,out]  workspace; NULL: allocated for this call.
 *  Returns  SL_OK; SL_ERR_ARGUMENT; SL_ERR_STATE: failed factor; SL_ERR_INCONSISTENT: a column of B
 *           has no solution (SL_NULL_PIVOT_SKIP without mass); SL_ERR_TOO_LARGE, SL_ERR_MEMORY: W
 *           could not grow.
 *  Cost     4 nnz_panels flops per right-hand side; each block reads L twice. W grows to O(n
 *           min(nrhs, 8)). If consistency is checked, right-hand sides beyond the eighth take an
 *           additional forward sweep.
 *  Threads  any number at once on one F, each with its own W.
 *  Example  tests/core/test_solve.c
 */
SL_API SL_WARN_UNUSED sl_status sl_factor_solve(const sl_factor *F, double *X, size_t ldx,
                                                const double *B, size_t ldb, sl_int nrhs,
                                                sl_work *W);

/** Solves A X = B with interleaved right-hand sides: the numbers of one row are contiguous.
 *
 *  The same bits as sl_factor_solve, and the fastest layout for several right-hand sides: to gather
 *  and scatter 8 separate columns takes about a fifth of a solve.
 *
 *  F      [in]   factor of A, n x n.
 *  X      [out]  n x nrhs, row-major, ldx >= nrhs elements from row to row. May be B itself (then
 *                ldx = ldb). On error untouched.
 *  B      [in]   n x nrhs, row-major, ldb >= nrhs elements from row to row.
 *  nrhs   [in]   as in sl_factor_solve.
 *  W      [in,out]  workspace; NULL: allocated for this call.
 *  Returns  as sl_factor_solve.
 *  Cost     as sl_factor_solve.
 *  Threads  any number at once on one F, each with its own W.
 *  Example  tests/core/test_interleaved.c
 */
SL_API SL_WARN_UNUSED sl_status sl_factor_solve_interleaved(const sl_factor *F, double *X,
                                                            size_t ldx, const double *B, size_t ldb,
                                                            sl_int nrhs, sl_work *W);

/* src/public/plan.h: local solves: b is known in a few rows, x is wanted in a few others */

/** Prepares solves of A x = b where b is nonzero only in bset and x is wanted only in xset.
 *
 *  With P A P' = L D L', the forward sweep needs the paths of the elimination tree from bset to the
 *  roots and the backward sweep those from xset. Each reach is found separately, in time
 *  proportional to its own size.
 *
 *  out    [out]  the plan, or NULL on error; release with sl_plan_free.
 *  S      [in]   analysis of A, n columns; borrowed, must outlive the plan.
 *  bset   [in]   nb rows of A in 0..n-1, any order; b is 0 in the others, and values of a row given
 *                twice add up. NULL (nb is ignored): all n.
 *  xset   [in]   nx rows of A in 0..n-1, any order; a row given twice is answered twice. NULL (nx
 *                is ignored): all n. For an empty set pass a pointer that is not NULL, and nb or nx
 *                = 0; it is not dereferenced.
 *  opt    [in]   allocator, region; may be NULL. If both sets are inside the region, the sweeps end
 *                at its boundary. If they are not, or if one is NULL, the region is not used.
 *  stats  [out]  plan; error.row: an index out of range; may be NULL.
 *  Returns  SL_OK; SL_ERR_ARGUMENT; SL_ERR_STATE: a region of another analysis; SL_ERR_TOO_LARGE;
 *           SL_ERR_MEMORY.
 *  Cost     O(nb + nx + rows of the supernodes reached), with a logarithmic factor for rows that
 *           skip many ancestors; nothing O(n). Keeps 4 bytes per row of a set, and 4 per row and 32
 *           per supernode reached.
 *  Threads  reads S; the plan is immutable and may be shared.
 *  Source   [Davis06] 3.2, 4.1; [HDA17] 3.
 *  Example  tests/core/test_plan.c
 */
SL_API SL_WARN_UNUSED sl_status sl_plan_create(sl_plan **out, const sl_symbolic *S,
                                               const sl_int *bset, sl_int nb, const sl_int *xset,
                                               sl_int nx, const sl_options *opt, sl_stats *stats);

/** Releases a plan; NULL is allowed. */
SL_API void sl_plan_free(sl_plan *P);

/** Fills the plan group of stats. */
SL_API void sl_plan_stats(const sl_plan *P, sl_stats *stats);

/** Solves A x = b on the sets of a plan: exactly what the full solve gives there.
 *
 *  For the same instruction set and nrhs the result equals that of sl_factor_solve bit for bit,
 *  except for the sign of zeros. In a region it agrees to rounding.
 *
 *  F      [in]   a factor over the plan's analysis.
 *  X      [out]  nx x nrhs, column-major, leading dimension ldx elements, rows in the order of
 *                xset. May be B itself (then ldx = ldb). On error untouched.
 *  B      [in]   nb x nrhs, column-major, leading dimension ldb elements, rows in the order of
 *                bset.
 *  nrhs   [in]   number of right-hand sides, 0 or more.
 *  W      [in,out]  workspace; NULL: allocated for this call.
 *  Returns  SL_OK; SL_ERR_ARGUMENT; SL_ERR_STATE: a failed factor, a factor of another analysis,
 *           or, in a region, a factor whose numbers are not those that the region was computed
 *           from; SL_ERR_INCONSISTENT: as in sl_factor_solve; SL_ERR_TOO_LARGE; SL_ERR_MEMORY.
 *  Cost     2 (b_entries + x_entries) + 4 region_entries flops per right-hand side; nothing O(n);
 *           no allocation once W has grown.
 *  Threads  any number at once on one P and one F, each with its own W.
 *  Example  tests/core/test_plan.c
 */
SL_API SL_WARN_UNUSED sl_status sl_plan_solve(const sl_plan *P, const sl_factor *F, double *X,
                                              size_t ldx, const double *B, size_t ldb, sl_int nrhs,
                                              sl_work *W);

/** sl_plan_solve with interleaved right-hand sides: the same bits.
 *
 *  F      [in]   a factor over the plan's analysis.
 *  X      [out]  nx x nrhs, row-major, ldx >= nrhs elements from row to row, rows in the order of
 *                xset. May be B itself (then ldx = ldb). On error untouched.
 *  B      [in]   nb x nrhs, row-major, ldb >= nrhs elements from row to row, rows in the order of
 *                bset.
 *  nrhs   [in]   number of right-hand sides, 0 or more.
 *  W      [in,out]  workspace; NULL: allocated for this call.
 *  Returns  as sl_plan_solve.
 *  Cost     as sl_plan_solve.
 *  Threads  any number at once on one P and one F, each with its own W.
 *  Example  tests/core/test_interleaved.c
 */
SL_API SL_WARN_UNUSED sl_status sl_plan_solve_interleaved(const sl_plan *P, const sl_factor *F,
                                                          double *X, size_t ldx, const double *B,
                                                          size_t ldb, sl_int nrhs, sl_work *W);

/** One local solve without a plan: sl_plan_create and sl_plan_solve in the caller's workspace.
 *
 *  F, bset, nb, xset, nx, X, ldx, B, ldb, nrhs, W as in these two calls; no region.
 *  stats  [out]  plan (bytes is 0); error.row: an index out of range; may be NULL.
 *  Returns  SL_OK; SL_ERR_ARGUMENT; SL_ERR_STATE: failed factor; SL_ERR_INCONSISTENT: as in
 *           sl_factor_solve; SL_ERR_TOO_LARGE; SL_ERR_MEMORY.
 *  Cost     the sum of both calls; no allocation once W has grown.
 *  Threads  any number at once on one F, each with its own W.
 *  Example  tests/core/test_plan.c
 */
SL_API SL_WARN_UNUSED sl_status sl_local_solve(const sl_factor *F, const sl_int *bset, sl_int nb,
                                               const sl_int *xset, sl_int nx, double *X, size_t ldx,
                                               const double *B, size_t ldb, sl_int nrhs, sl_work *W,
                                               sl_stats *stats);

/* src/public/parts.h: L, D, L' and the permutation applied one by one: half solves, products, samples */

/** The factors of P A P' = L D L', to be combined by |. */
typedef enum sl_part {
    SL_PART_P = 1,      /* from the order of A to that of the pivots: row k of P b is b(perm[k]) */
    SL_PART_L = 2,      /* unit lower triangular */
    SL_PART_D = 4,      /* diagonal, or with 2x2 blocks */
    SL_PART_SQRT_D = 8, /* D^(1/2), in place of D; of factors without negative pivots only */
    SL_PART_LT = 16,    /* L' */
    SL_PART_PT = 32     /* P', from the order of the pivots to that of A */
} sl_part;

/** X = P' L'^-1 D^-1 L^-1 P B with only those factors that are given; the others count as I.
 *
 *  | SL_PART_...                | X                                                              |
 *  |----------------------------|----------------------------------------------------------------|
 *  | P, L                       | the forward half of a solve                                    |
 *  | D, LT, PT, or only LT, PT  | the backward half                                              |
 *  | P, L, D, LT, PT            | the solution of A X = B                                        |
 *  | L, or D, or LT             | one of the three solves, in the order of the pivots            |
 *  | SQRT_D, LT, PT             | samples of covariance A^-1 if B is standard normal             |
 *  | P, L, SQRT_D               | whitened B: independent, of variance 1, if its covariance is A |
 *
 *  Parts applied one after the other give the bits of sl_factor_solve. Skipped null pivots count as
 *  0, and dividing by them gives 0: D^-1 is the pseudo-inverse. Consistency is not checked, and
 *  options.mass is not used, so that with null pivots all parts together need not give the solution
 *  of sl_factor_solve. With several null vectors a component (options.null_vector_count), null
 *  pivots are not the last ones, and P' L D L' P differs from A in their rows and columns.
 *
 *  F      [in]   factor of A, n x n.
 *  parts  [in]   any of sl_part, but not both SL_PART_D and SL_PART_SQRT_D; 0 copies B.
 *  X      [out]  n x nrhs, column-major, leading dimension ldx elements; in the order of A with
 *                SL_PART_PT, else of the pivots. May be B itself (then ldx = ldb). On error
 *                untouched.
 *  B      [in]   n x nrhs, column-major, leading dimension ldb elements; in the order of A with
 *                SL_PART_P, else of the pivots.
 *  nrhs   [in]   number of right-hand sides, 0 or more.
 *  W      [in,out]  workspace; NULL: allocated for this call.
 *  Returns  SL_OK; SL_ERR_ARGUMENT; SL_ERR_STATE: failed factor; SL_ERR_PIVOT: SL_PART_SQRT_D with
 *           a negative pivot; SL_ERR_UNSUPPORTED: SL_PART_SQRT_D with 2x2 pivots;
 *           SL_ERR_TOO_LARGE; SL_ERR_MEMORY.
 *  Cost     2 nnz_panels flops per right-hand side for each of L and L'; O(n) for the others.
 *  Threads  any number at once on one F, each with its own W.
 *  Example  tests/core/test_parts.c
 */
SL_API SL_WARN_UNUSED sl_status sl_factor_solve_part(const sl_factor *F, unsigned parts, double *X,
                                                     size_t ldx, const double *B, size_t ldb,
                                                     sl_int nrhs, sl_work *W);

/** X = P' L D L' P B with only those factors that are given; the others count as I.
 *
 *  L + PT undoes P + L of sl_factor_solve_part, and LT undoes LT. L + SQRT_D + PT makes samples of
 *  covariance A. All parts together give A B, or (A + E) B if regularization changed pivots.
 *
 *  Arguments, Returns, Threads  as sl_factor_solve_part.
 *  Cost     2 nnz_panels flops per right-hand side for each of L and L', in plain C: about 8 times
 *           as long as the solve.
 */
SL_API SL_WARN_UNUSED sl_status sl_factor_multiply_part(const sl_factor *F, unsigned parts,
                                                        double *X, size_t ldx, const double *B,
                                                        size_t ldb, sl_int nrhs, sl_work *W);

/** Half of a local solve: the forward half from the b-set, or the backward half to the x-set.
 *
 *  Forward: SL_PART_P, SL_PART_L and perhaps one of SL_PART_D and SL_PART_SQRT_D. B has the rows of
 *  the b-set; X has the b_columns rows that the sweep reaches (stats.plan), and all others are 0.
 *  The rows are those of sl_plan_columns. Backward: SL_PART_LT, SL_PART_PT and perhaps one of the
 *  two. B has the x_columns rows that the x-set depends on; X has the rows of the x-set.
 *
 *  With standard normal B, SL_PART_SQRT_D + LT + PT samples x on the x-set alone, with the
 *  covariance A^-1 has there. The results are the rows of sl_factor_solve_part, bit for bit.
 *
 *  P, F   [in]   a plan without a region, and a factor over its analysis.
 *  X      [out]  column-major, leading dimension ldx elements. May be B itself (then ldx = ldb). On
 *                error untouched.
 *  B      [in]   column-major, leading dimension ldb elements.
 *  nrhs, W       as in sl_plan_solve.
 *  Returns  as sl_factor_solve_part; SL_ERR_ARGUMENT: other parts; SL_ERR_STATE: a factor of
 *           another analysis; SL_ERR_UNSUPPORTED: a plan in a region.
 *  Cost     2 b_entries or 2 x_entries flops per right-hand side; nothing O(n).
 *  Threads  any number at once on one P and one F, each with its own W.
 *  Example  tests/core/test_parts.c
 */
SL_API SL_WARN_UNUSED sl_status sl_plan_solve_part(const sl_plan *P, const sl_factor *F,
                                                   unsigned parts, double *X, size_t ldx,
                                                   const double *B, size_t ldb, sl_int nrhs,
                                                   sl_work *W);

/** The columns of L that one sweep of a plan visits, ascending: the rows of half solves.
 *
 *  part      [in]   SL_PART_L: the forward sweep; SL_PART_LT: the backward sweep.
 *  columns   [out]  the first min(capacity, *count) of them; may be NULL if capacity = 0.
 *  capacity  [in]   length of columns.
 *  count     [out]  how many there are: b_columns or x_columns of stats.plan.
 *  Returns  SL_OK; SL_ERR_ARGUMENT; SL_ERR_UNSUPPORTED: a plan in a region.  Cost  O(count).
 */
SL_API SL_WARN_UNUSED sl_status sl_plan_columns(const sl_plan *P, sl_part part, sl_int *columns,
                                                sl_int capacity, sl_int *count);

/** Grows W so that sl_factor_solve_part and sl_factor_multiply_part with up to nrhs right-hand
 *  sides allocate nothing.
 *
 *  Returns  SL_OK; SL_ERR_ARGUMENT; SL_ERR_TOO_LARGE; SL_ERR_MEMORY.
 */
SL_API SL_WARN_UNUSED sl_status sl_work_reserve_part(sl_work *W, const sl_factor *F, sl_int nrhs);

/** The same for sl_plan_solve_part on plan P.
 *
 *  Returns  SL_OK; SL_ERR_ARGUMENT; SL_ERR_TOO_LARGE; SL_ERR_MEMORY.
 */
SL_API SL_WARN_UNUSED sl_status sl_work_reserve_plan_part(sl_work *W, const sl_plan *P,
                                                          sl_int nrhs);

/* src/public/accuracy.h: refinement of solutions, condition estimate, consistency of singular systems */

/** Iterative refinement of A X = B. Stops when the backward error no longer halves.
 *
 *  For each column: computes the residual, solves for a correction and adds it, until the
 *  componentwise backward error max_i |b - A x|_i / (|A| |x| + |b|)_i is at most epsilon, a
 *  correction does not halve it, or the steps are used up. A correction that increases it is
 *  discarded. With SL_STORAGE_FLOAT it takes two such corrections in a row, and the first is kept
 *  even if it doubles the error: x gains digits before the error shows it. With a regularized
 *  factor, of A + E, this turns the solution of (A + E) x = b into that of A x = b. If null pivots
 *  were skipped, B has to be consistent.
 *
 *  The call says whether the result is good: if the backward error that remains in some column is
 *  above options.error_limit of the factor, 1e-8 by default, it returns SL_ERR_INACCURATE. X then
 *  holds the best solutions that were found.
 *
 *  F      [in]      a factor of A, or of a matrix close to A.
 *  A      [in]      the matrix, with the analyzed pattern.
 *  X      [in,out]  n x nrhs, column-major, leading dimension ldx elements: solutions from
 *                   sl_factor_solve, or any other start; must not overlap B. On errors other than
 *                   SL_ERR_INACCURATE untouched.
 *  B      [in]      n x nrhs, column-major, leading dimension ldb elements.
 *  steps  [in]      maximum number of corrections per column, 0 or more; 0 only measures, and does
 *                   not return SL_ERR_INACCURATE.
 *  W      [in,out]  workspace; NULL: allocated for this call.
 *  stats  [out]     refine; may be NULL.
 *  Returns  SL_OK; SL_ERR_INACCURATE: see above; SL_ERR_ARGUMENT; SL_ERR_STATE: failed factor;
 *           SL_ERR_PATTERN: not the analyzed pattern; SL_ERR_TOO_LARGE, SL_ERR_MEMORY: W could not
 *           grow.
 *  Cost     one product with A, and another product and a solve per step; W grows to
 *           O(n min(nrhs, 8)).
 *  Threads  any number at once on one F, each with its own W.
 *  Source   [Sk80]: one step makes a solver stable row by row.
 *  Example  tests/core/test_refine.c
 */
SL_API SL_WARN_UNUSED sl_status sl_factor_refine(const sl_factor *F, const sl_csc *A, double *X,
                                                 size_t ldx, const double *B, size_t ldb,
                                                 sl_int nrhs, sl_int steps, sl_work *W,
                                                 sl_stats *stats);

/** sl_plan_solve with a regularized factor, L D L' = P (A + E) P', refined to solve A x = b.
 *
 *  Up to rounding, the residual of the solution x of (A + E) x = b is E x, and E is nonzero in the
 *  regularized rows only. The iteration x <- (A + E)^-1 (b + E x) therefore needs x in these rows
 *  and in the wanted ones only, and each step costs one local solve. It removes the error of
 *  regularization. Rounding errors remain as in sl_plan_solve; to reduce them takes all of x and
 *  sl_factor_refine. If nothing was regularized, this is sl_plan_solve.
 *
 *  P      [in]   a plan whose two reaches contain every regularized row of the components of b.
 *                This holds if these rows are in both sets.
 *  F, X, ldx, B, ldb, nrhs, W  as in sl_plan_solve.
 *  steps  [in]   maximum number of corrections per column, 0 or more; 0 only measures.
 *  stats  [out]  refine, with backward_error = max |E (x - previous x)| / max |b|; error.row with
 *                SL_ERR_ARGUMENT: a regularized row outside the reaches; may be NULL.
 *  Returns  as sl_plan_solve; SL_ERR_INACCURATE: this backward error is above options.error_limit
 *           of the factor after one or more steps, and X is written; SL_ERR_UNSUPPORTED: a plan in
 *           a region and a factor with regularized rows.
 *  Cost     1 + steps local solves; nothing O(n); no allocation once W has grown, by 16 numbers per
 *           row of the x-set.
 *  Threads  any number at once on one P and one F, each with its own W.
 *  Example  tests/core/test_refine_local.c
 */
SL_API SL_WARN_UNUSED sl_status sl_plan_solve_refined(const sl_plan *P, const sl_factor *F,
                                                      double *X, size_t ldx, const double *B,
                                                      size_t ldb, sl_int nrhs, sl_int steps,
                                                      sl_work *W, sl_stats *stats);

/** Estimates the reciprocal condition number 1 / (||A|| ||A^-1||) in the one-norm.
 *
 *  epsilon / rcond estimates the relative error of a solve without refinement; if it is near 1 or
 *  above, solutions are worthless. Up to rounding, the true value is never larger than the
 *  estimate, and rarely smaller than a third of it. L D L' is judged, too: the solves of the
 *  estimator are checked against A, and where their largest backward error w exceeds 64 epsilon,
 *  because L has grown, the estimate is multiplied by epsilon / w; with SL_STORAGE_FLOAT epsilon is
 *  that of float here, and rcond is that of A down to about 1e-13. 0 if null pivots were skipped; 1
 *  if n = 0. If regularization changed pivots, all this is about A + E.
 *
 *  A      [in]      the matrix that F is a factor of.
 *  rcond  [out]     the estimate.
 *  W      [in,out]  workspace; NULL: allocated for this call.
 *  Returns  SL_OK; SL_ERR_ARGUMENT; SL_ERR_STATE: failed factor; SL_ERR_PATTERN: not the analyzed
 *           pattern; SL_ERR_TOO_LARGE, SL_ERR_MEMORY: W could not grow.
 *  Cost     4 to 10 solves, each with a product with A.
 *  Threads  any number at once on one F, each with its own W.
 *  Source   [Hi88]
 *  Example  tests/core/test_condition.c
 */
SL_API SL_WARN_UNUSED sl_status sl_factor_rcond(const sl_factor *F, const sl_csc *A, double *rcond,
                                                sl_work *W);

/** How inconsistent right-hand sides of a singular A are: Y = Z' B for the null vectors Z of A.
 *
 *  Column k of Z belongs to row k of sl_factor_null_rows; it is 1 there and 0 in the other null
 *  rows. Known null vectors are used as they are, combinations of them where a component has
 *  several, and others are computed from L (sl_factor_create).
 *  After Y(k, r) is subtracted from B in that row, the system has a solution. For a
 *  Laplacian, Y contains the sums of B over the components.
 *
 *  F      [in]   a factor made with SL_NULL_PIVOT_SKIP; without null pivots Y has no rows.
 *  Y      [out]  null rows x nrhs, column-major, leading dimension ldy elements; must not overlap
 *                B.
 *  B      [in]   n x nrhs, column-major, leading dimension ldb elements.
 *  W      [in,out]  workspace; NULL: allocated for this call.
 *  Returns  SL_OK; SL_ERR_ARGUMENT; SL_ERR_STATE: failed factor; SL_ERR_TOO_LARGE, SL_ERR_MEMORY: W
 *           could not grow.
 *  Cost     the forward sweep of sl_factor_solve.
 *  Threads  any number at once on one F, each with its own W.
 *  Example  tests/core/test_consistency.c
 */
SL_API SL_WARN_UNUSED sl_status sl_factor_defects(const sl_factor *F, double *Y, size_t ldy,
                                                  const double *B, size_t ldb, sl_int nrhs,
                                                  sl_work *W);

/* src/public/inverse.h: entries, blocks and bilinear forms of the inverse, without a backward sweep */

/* With P A P' = L D L', y = L^-1 P b and z = L^-1 P c,
 *
 *     c' A^-1 b = sum over columns k of y(k) z(k) / d(k),
 *
 * where only the common ancestors of b and c in the elimination tree contribute: one forward sweep
 * for each and no backward sweep. Requests are sorted internally, and nearby ones share one sweep
 * of up to 8 SIMD lanes. Results are in the caller's order and equal those of full solves to
 * rounding. The last bits depend on the other requests of the same call, since these determine
 * which sweeps are shared.
 *
 * All calls below
 *  F      [in]      a factor of A, n x n.
 *  W      [in,out]  workspace; NULL: allocated for this call.
 *  stats  [out]     inverse; error.row, error.column: an index out of range. May be NULL.
 *  Returns  SL_OK; SL_ERR_ARGUMENT: a NULL, a negative count, an index out of range; SL_ERR_STATE:
 *           failed factor; SL_ERR_TOO_LARGE, SL_ERR_MEMORY: W could not grow. On error nothing is
 *           written.
 *  Cost     sweeps take 2 entries flops per lane, and 8 lanes take as long as two to three, so that
 *           many requests should share a call; a single pair of distant vertices costs as much as a
 *           local solve from one to the other. Nothing O(n), except for NULL sets; no allocation
 *           once W has grown to the largest reach and 16 bytes per request.
 *  Threads  any number at once on one F, each with its own W.
 *  Source   [HDA17] 5; [Davis06] 3.2, 4.1.
 *  Example  tests/core/test_inverse.c
 *
 * Selected inversion (selected.h) is cheaper for many entries. sl_inverse_diagonal and
 * sl_inverse_pairs count the operations of both methods and choose the cheaper one: selected
 * inversion from several hundred nearby vertices of a mesh, or several thousand distant ones;
 * always for the whole diagonal. stats.inverse.method names the choice. Selected inversion then
 * keeps only the active fronts, uses the threads that F was created with (one call of the caller's
 * pool per concurrent call) and gives the same bits for any number of threads. W grows to 8
 * height^2 bytes per active front, where height counts the columns of a supernode and the rows
 * below them. Active are the fronts on the path from the current supernode to its root that have
 * unvisited children; with several threads, those of every thread and the roots of the subtrees
 * distributed among them, a few dozen.
 *
 * If null pivots were skipped (SL_NULL_PIVOT_SKIP), the inverse is that of the matrix without their
 * rows and columns, and 0 in these: A Z A = A if A has no other null vectors.
 *
 * Factors with 2x2 pivots (sl_symbolic_create_pivoted) are refused with SL_ERR_UNSUPPORTED.
 */

/** Diagonal entries of the inverse: out[k] = (A^-1)(rows[k], rows[k]).
 *
 *  out    [out]  count values.
 *  rows   [in]   count rows of A in 0..n-1, any order, repetitions allowed; NULL (count is
 *                ignored): all n.
 *  Source   [HDA17] 5; [ET75], [SelInv].
 *  Example  tests/core/test_inverse_diagonal.c
 */
SL_API SL_WARN_UNUSED sl_status sl_inverse_diagonal(const sl_factor *F, double *out,
                                                    const sl_int *rows, sl_int count, sl_work *W,
                                                    sl_stats *stats);

/** Entries of the inverse: out[k] = (A^-1)(rows[k], columns[k]).
 *
 *  out    [out]  count values.
 *  rows, columns  [in]  count rows of A each, in 0..n-1, any order, repetitions allowed. Selected
 *                 inversion is possible only if all entries are in the pattern of L, as those of A
 *                 are.
 */
SL_API SL_WARN_UNUSED sl_status sl_inverse_pairs(const sl_factor *F, double *out,
                                                 const sl_int *rows, const sl_int *columns,
                                                 sl_int count, sl_work *W, sl_stats *stats);

/** A dense block of the inverse: Z(i, j) = (A^-1)(rows[i], columns[j]).
 *
 *  Z        [out]  n_rows x n_columns, column-major, leading dimension ldz >= n_rows elements.
 *  rows     [in]   n_rows rows of A in 0..n-1, any order, repetitions allowed.
 *  columns  [in]   n_columns rows of A, likewise. If it is the same array as rows, of the same
 *                  length, each sweep and each entry is computed once and the block is exactly
 *                  symmetric.
 *  Cost     the sweeps, and n_rows n_columns times the common columns. W holds 128 vectors of the
 *           shorter side at a time; the longer side is swept once for each 128 (not if both are one
 *           array).
 */
SL_API SL_WARN_UNUSED sl_status sl_inverse_block(const sl_factor *F, double *Z, size_t ldz,
                                                 const sl_int *rows, sl_int n_rows,
                                                 const sl_int *columns, sl_int n_columns,
                                                 sl_work *W, sl_stats *stats);

/** A bilinear form of the inverse: out = c' A^-1 b for sparse b and c.
 *
 *  out   [out]  one value.
 *  bset  [in]   nb rows of A in 0..n-1, any order; values of a row given twice add up; b is 0 in
 *               the other rows. NULL (nb is ignored): all n.
 *  b     [in]   nb values.
 *  cset  [in]   nc rows of A, likewise.
 *  c     [in]   nc values. If sets and values of b and c are the same arrays, b' A^-1 b takes half
 *               the operations. An index out of range is error.row for cset and error.column for
 *               bset.
 */
SL_API SL_WARN_UNUSED sl_status sl_inverse_bilinear(const sl_factor *F, double *out,
                                                    const sl_int *bset, const double *b, sl_int nb,
                                                    const sl_int *cset, const double *c, sl_int nc,
                                                    sl_work *W, sl_stats *stats);

/** Grows W so that calls of sl_inverse_diagonal, sl_inverse_pairs and sl_inverse_bilinear on F
 *  allocate nothing, for any rows.
 *
 *  W      [in,out]  the workspace.
 *  F      [in]      a factor. The bound holds for every factor of the same analysis that has no
 *                   more threads.
 *  count  [in]      the most entries that one call requests; n for the whole diagonal. Of a
 *                   bilinear form: the rows of both sets together, where a set that is NULL has n
 *                   rows.
 *  Returns  SL_OK; SL_ERR_ARGUMENT; SL_ERR_TOO_LARGE; SL_ERR_MEMORY.
 *  Cost     O(supernodes) and no numbers are read. The rows are not known here, so the bound is
 *           that of the worst ones: 8 sweeps to the roots that share nothing, and a selected
 *           inversion of everything, whose size is that of the whole diagonal. With T threads on F
 *           it has T + 1 times the fronts of one thread, and the fronts of up to count subtrees;
 *           the calls themselves mostly take much less. sl_work_bytes reports what was reserved.
 *           Each workspace of sl_batch_diagonal needs this for its n_rows.
 *  Example  tests/core/test_reserve_inverse.c
 */
SL_API SL_WARN_UNUSED sl_status sl_work_reserve_inverse(sl_work *W, const sl_factor *F,
                                                        sl_int count);

/** Grows W so that calls of sl_inverse_block on F for blocks of up to n_rows x n_columns allocate
 *  nothing, for any rows.
 *
 *  W        [in,out]   the workspace.
 *  F        [in]       a factor. The bound holds for every factor of the same analysis.
 *  n_rows, n_columns   [in]  the largest block. A block with fewer rows and fewer columns is
 *                            covered too.
 *  Returns  SL_OK; SL_ERR_ARGUMENT; SL_ERR_TOO_LARGE; SL_ERR_MEMORY.
 *  Cost     O(supernodes) and no numbers are read. The bound is that of the worst rows, as in
 *           sl_work_reserve_inverse: up to 18 sweeps of 8 vectors whose paths to the roots share
 *           nothing.
 *  Example  tests/core/test_reserve_inverse.c
 */
SL_API SL_WARN_UNUSED sl_status sl_work_reserve_block(sl_work *W, const sl_factor *F, sl_int n_rows,
                                                      sl_int n_columns);

/* src/public/batch.h: many independent solves by one call, distributed over threads */

/** One solve of a batch: a plan and its right-hand sides, or a full solve. */
typedef struct sl_request {
    const sl_plan *plan; /* NULL: a full solve, as sl_factor_solve */
    double *X;           /* nx x nrhs (full: n x nrhs), leading dimension ldx elements */
    size_t ldx;
    const double *B; /* nb x nrhs (full: n x nrhs), leading dimension ldb elements */
    size_t ldb;
    sl_int nrhs;             /* 0 or more; blocks of 8 are distributed like separate requests */
    const sl_factor *factor; /* NULL: the factor of the call */
} sl_request;

/** Solves all requests: the bits of sl_plan_solve and sl_factor_solve for any number of threads.
 *
 *  One plan on m factors of one analysis is m requests with that plan, each with its own factor and
 *  X, and with a common B or its own.
 *
 *  F         [in]      the factor of the requests that name none; NULL if all do. A plan needs a
 *                      factor of its analysis.
 *  requests  [in]      count requests, X and B column-major. Each X may be its own B (then ldx =
 *                      ldb) and overlaps nothing else of the batch.
 *  opt       [in]      threads; NULL: the calling thread only.
 *  works     [in,out]  one workspace per thread, max(opt->threads.count, 1) of them, or NULL:
 *                      allocated for this call.
 *  failed    [out]     the request that caused the error, or -1; may be NULL. On error no X has
 *                      been written.
 *  Returns   SL_OK; SL_ERR_ARGUMENT: also if a workspace is NULL or given twice; SL_ERR_STATE: a
 *            failed factor, or a plan that sl_plan_solve refuses; SL_ERR_INCONSISTENT: as in
 *            sl_factor_solve; SL_ERR_TOO_LARGE; SL_ERR_MEMORY.
 *  Cost      that of the solves, distributed by the entries of L that each reads; one workspace of
 *            the largest size per thread. If consistency is checked, one more forward sweep of all.
 *  Threads   as sl_plan_solve.
 *  Example   tests/core/test_batch.c
 */
SL_API SL_WARN_UNUSED sl_status sl_batch_solve(const sl_factor *F, const sl_request *requests,
                                               sl_int count, const sl_options *opt,
                                               sl_work *const *works, sl_int *failed);

/** sl_batch_solve with interleaved right-hand sides: X and B of every request are row-major.
 *
 *  Arguments, status, cost and threads as in sl_batch_solve, but ldx and ldb count elements from
 *  row to row and are at least nrhs.
 *  Example   tests/core/test_batch.c
 */
SL_API SL_WARN_UNUSED sl_status sl_batch_solve_interleaved(const sl_factor *F,
                                                           const sl_request *requests, sl_int count,
                                                           const sl_options *opt,
                                                           sl_work *const *works, sl_int *failed);

/* src/public/several.h: several matrices of one pattern: weighted sums of value arrays over one analysis */

/* The matrices M + t K for many t have one pattern, the union of both. Each term is scattered once
 * into an array in the order of the analysis, and a factorization adds the weighted arrays while it
 * reads them: nothing is permuted, sorted or searched again. For m values of t:
 *
 *     sl_csc terms[2] = {M, K};                                  any triangles, any two patterns
 *     sl_matrix_sum(&U, NULL, terms, 2, NULL, NULL);             their union
 *     A = sl_matrix_view(U);  sl_symbolic_create(&S, &A, NULL, NULL);
 *     v[0] = malloc(sl_symbolic_entries(S) * sizeof(double));    v[1] likewise
 *     sl_symbolic_scatter(S, v[0], &M, NULL);  sl_symbolic_scatter(S, v[1], &K, NULL);
 *     for k < m: c[2 k] = 1, c[2 k + 1] = t[k];
 *     sl_batch_factor(F, m, S, c, v, 2, &opt, NULL, NULL);       F: m factors, of M + t[k] K
 *     sl_batch_diagonal(F, m, h, n_rows, rows, n_rows, &opt, NULL, NULL, NULL);
 *
 * A plan belongs to the analysis. It serves all of these factors, one by one or in a batch whose
 * requests name their factors.
 *
 * Heat-kernel signatures: let M be the masses and K = L the positive semidefinite cotangent
 * Laplacian. One implicit step of length t is (M + t L) u(t) = M u(0). For unit heat in vertex i,
 * u(0) = e_i / M(i,i); the heat kernel is then approximated by h_t(i,j) = (A_t^-1)(i,j), and
 * h_t(i,i) is the signature of i at time t, the auto-diffusion of [HDA17] 5, which solves with
 * b = e_i. It is a density: the masses integrate h_t(i,j) to 1 over j. The share of the heat that
 * remains at i is h_t(i,i) M(i,i). To compare times, divide each column by the trace, the sum over
 * i of these shares.
 */

/** C = c_1 A_1 + .. + c_k A_k of symmetric matrices, as its lower triangle with ascending rows.
 *
 *  out           [out]  the matrix, n x n, or NULL on error; release with sl_matrix_free.
 *  coefficients  [in]   count numbers; NULL: the union of the patterns, without values.
 *  terms         [in]   count >= 1 square matrices of one size, each with any triangle, read as a
 *                       factorization reads them. Entries whose sum is 0 stay in the pattern.
 *  opt           [in]   allocator, triangle; may be NULL.
 *  stats         [out]  error.row, error.column: a malformed entry; may be NULL.
 *  Returns  SL_OK; SL_ERR_ARGUMENT: different sizes, no term, no values; SL_ERR_PATTERN;
 *           SL_ERR_TOO_LARGE: 2^31 or more entries in total; SL_ERR_MEMORY.
 *  Cost     O(n + entries of all terms).
 *  Threads  any number with different outputs.
 *  Example  tests/core/test_matrix_sum.c
 */
SL_API SL_WARN_UNUSED sl_status sl_matrix_sum(sl_matrix **out, const double *coefficients,
                                              const sl_csc *terms, sl_int count,
                                              const sl_options *opt, sl_stats *stats);

/** Length of an array of values in the order of the analysis: stats.symbolic.nnz_a. NULL has 0. */
SL_API sl_int sl_symbolic_entries(const sl_symbolic *S);

/** Scatters the values of a matrix into an array in the order of the analysis.
 *
 *  values  [out]  sl_symbolic_entries(S) doubles, valid for S only, 0 where K has no entry; those
 *                 of a supernode are contiguous. On error untouched.
 *  K       [in]   n x n with values, any triangle, read as a factorization reads it: rows in any
 *                 order, duplicates summed. Its pattern is a subset of the analyzed one; values may
 *                 be anything.
 *  stats   [out]  error.row, error.column: the first stored entry outside the analyzed pattern, or
 *                 a malformed one; may be NULL.
 *  Returns  SL_OK; SL_ERR_ARGUMENT: not square, no values; SL_ERR_PATTERN: another size, malformed,
 *           both triangles with an unsymmetric pattern, or an entry outside the analyzed pattern;
 *           SL_ERR_TOO_LARGE; SL_ERR_MEMORY.
 *  Cost     O(n + entries of S and of K); temporary memory from the allocator of S.
 *  Threads  reads S; any number with different arrays.
 *  Example  tests/core/test_matrix_sum.c
 */
SL_API SL_WARN_UNUSED sl_status sl_symbolic_scatter(const sl_symbolic *S, double *values,
                                                    const sl_csc *K, sl_stats *stats);

/** Factors A = coefficients[0] values[0] + .. + coefficients[terms-1] values[terms-1].
 *
 *  The same bits as sl_factor_create for a matrix without duplicates whose entries are these sums;
 *  each product is rounded, then added in this order, starting from 0. A compiler that contracts
 *  a * b + c (gcc without -std=c99, for processors with FMA) does not round the products.
 *
 *  out           [out]  the factor, or NULL on error; release with sl_factor_free.
 *  S             [in]   the analysis; borrowed, must outlive the factor.
 *  coefficients  [in]   terms finite numbers.
 *  values        [in]   terms arrays in the order of S (sl_symbolic_scatter); not kept.
 *  terms         [in]   0 or more; the sum of none is the zero matrix.
 *  opt, stats           as in sl_factor_create.
 *  Returns  as sl_factor_create, but never SL_ERR_PATTERN. SL_ERR_NOT_FINITE: a coefficient
 *           (error.value, no row) or a sum, at error.row >= error.column.
 *  Cost     as sl_factor_create; the terms are read once, in order.
 *  Threads  as sl_factor_create.
 *  Example  tests/core/test_combination.c
 */
SL_API SL_WARN_UNUSED sl_status sl_factor_create_combination(sl_factor **out, const sl_symbolic *S,
                                                             const double *coefficients,
                                                             const double *const *values,
                                                             sl_int terms, const sl_options *opt,
                                                             sl_stats *stats);

/** Refactors with other coefficients or values over the factor's analysis. Allocates nothing.
 *
 *  F        [in,out]  any factor, also one of sl_factor_create. After errors as in
 *                     sl_factor_refactor.
 *  Returns, Cost      as sl_factor_create_combination, but never SL_ERR_UNSUPPORTED; mapped and
 *                     loaded factors as in sl_factor_refactor.
 *  Threads            exclusive use of F.
 *  Example            tests/core/test_combination.c
 */
SL_API SL_WARN_UNUSED sl_status sl_factor_refactor_combination(sl_factor *F,
                                                               const double *coefficients,
                                                               const double *const *values,
                                                               sl_int terms, sl_stats *stats);

/** Factors several combinations of the same terms, distributed over threads; the bits of
 *  sl_factor_create_combination.
 *
 *  Each thread computes whole factors. If their number is not a multiple of the number of threads,
 *  all threads together compute the remaining ones, one after the other.
 *
 *  out           [out]  count factors. If one fails, it is NULL and the others are computed
 *                       nevertheless: release them. After SL_ERR_ARGUMENT with failed = -1 all are
 *                       NULL.
 *  coefficients  [in]   terms x count, column-major, leading dimension terms: one column per
 *                       factor.
 *  values, terms [in]   as in sl_factor_create_combination.
 *  opt           [in]   as in sl_factor_create; may be NULL.
 *  failed        [out]  the first factor that failed, or -1; may be NULL.
 *  stats         [out]  error and factor: those of the failed factor, else of the last one; seconds
 *                       and bytes are sums over all factors. May be NULL.
 *  Returns  SL_OK, or the status of the first factor that failed, as sl_factor_create_combination.
 *  Cost     that of the factors, distributed; each keeps what a factor keeps.
 *  Threads  as sl_factor_create; only the calling thread allocates.
 *  Example  tests/core/test_batch_factor.c
 */
SL_API SL_WARN_UNUSED sl_status sl_batch_factor(sl_factor **out, sl_int count, const sl_symbolic *S,
                                                const double *coefficients,
                                                const double *const *values, sl_int terms,
                                                const sl_options *opt, sl_int *failed,
                                                sl_stats *stats);

/** Refactors several factors of one analysis. Allocates nothing.
 *
 *  factors   [in,out]  count different factors. One that fails has no numbers afterwards; the
 *                      others are computed nevertheless.
 *  opt       [in]      threads; NULL: the calling thread only. Factors that have threads of their
 *                      own use these, one after the other.
 *  coefficients, values, terms, failed, stats  as in sl_batch_factor.
 *  Returns  SL_OK; SL_ERR_ARGUMENT: also if a factor is NULL or given twice; SL_ERR_STATE: factors
 *           of several analyses, or a mapped one; SL_ERR_MEMORY and SL_ERR_TOO_LARGE: only with
 *           the first refactorization of a loaded factor. After these no factor has changed. Else
 *           the status of the first factor that failed.
 *  Threads  exclusive use of the factors.
 *  Example  tests/core/test_batch_factor.c
 */
SL_API SL_WARN_UNUSED sl_status sl_batch_refactor(sl_factor *const *factors, sl_int count,
                                                  const double *coefficients,
                                                  const double *const *values, sl_int terms,
                                                  const sl_options *opt, sl_int *failed,
                                                  sl_stats *stats);

/** Diagonals of several inverses: out(i, k) = (A_k^-1)(rows[i], rows[i]); the bits of
 *  sl_inverse_diagonal.
 *
 *  factors  [in]      count factors of one analysis, repetitions allowed.
 *  out      [out]     n_rows x count, column-major, leading dimension ldo >= n_rows elements. On
 *                     error untouched.
 *  rows     [in]      n_rows rows of A, any order, repetitions allowed; NULL (n_rows is ignored):
 *                     all n.
 *  opt      [in]      threads; NULL: the calling thread only. Each thread takes whole factors.
 *  works    [in,out]  one workspace per thread, as in sl_batch_solve, or NULL: allocated for this
 *                     call.
 *  failed   [out]     the factor that caused the error, or -1; may be NULL.
 *  stats    [out]     error.row: an index out of range; may be NULL.
 *  Returns  SL_OK; SL_ERR_ARGUMENT: also a row out of range; SL_ERR_STATE: a failed factor, or
 *           factors of several analyses; SL_ERR_TOO_LARGE; SL_ERR_MEMORY.
 *  Cost     that of sl_inverse_diagonal for each factor, distributed.
 *  Threads  as sl_inverse_diagonal.
 *  Source   [HDA17] 5.
 *  Example  tests/core/test_batch_inverse.c
 */
SL_API SL_WARN_UNUSED sl_status sl_batch_diagonal(const sl_factor *const *factors, sl_int count,
                                                  double *out, size_t ldo, const sl_int *rows,
                                                  sl_int n_rows, const sl_options *opt,
                                                  sl_work *const *works, sl_int *failed,
                                                  sl_stats *stats);

/* src/public/selected.h: the selected inverse: entries of A^-1 on the pattern of L */

/** Computes entries of A^-1 on the pattern of L, which includes the diagonal and the pattern of A.
 *
 *  Works from the roots of the elimination tree to its leaves, supernode by supernode, with dense
 *  kernels. Z_kl of Z = P A^-1 P' is computed if the panel of a supernode has an entry L_kl,
 *  including the entries that relaxation adds. For a set of rows only the supernodes on the paths
 *  from the set to the roots are computed. All numbers have the same bits as in the complete
 *  selected inverse.
 *
 *  out    [out]  the selected inverse, or NULL on error; release with sl_selected_free. It does not
 *                change if F is refactored or released, until sl_selected_refactor.
 *  F      [in]   the factor; its analysis is borrowed and must outlive the object.
 *  set    [in]   count rows of A in 0..n-1, any order, repetitions allowed; NULL (count is
 *                ignored): all n. For an empty set pass a pointer that is not NULL and count = 0;
 *                it is not dereferenced.
 *  opt    [in]   allocator, threads; may be NULL. The object keeps the threads; without, those of
 *                F. The instruction set is that of F.
 *  stats  [out]  selected; error.row: a row out of range; may be NULL.
 *  Returns  SL_OK; SL_ERR_ARGUMENT; SL_ERR_STATE: failed factor; SL_ERR_UNSUPPORTED: 2x2 pivots;
 *           SL_ERR_TOO_LARGE; SL_ERR_MEMORY.
 *  Cost     about twice the flops of the factorization of the same supernodes. Keeps entries
 *           doubles (stats.selected) and 28 bytes per supernode, 44 with several threads. Temporary
 *           memory: 8 height^2 bytes per active front, where height counts the columns of a
 *           supernode and the rows below them. Active are the fronts on the path from the current
 *           supernode to its root that have unvisited children; with several threads, those of
 *           every thread and the roots of the subtrees distributed among them, a few dozen.
 *  Threads  reads F; the object is immutable and may be shared. The same bits for any number of
 *           threads.
 *  Source   [ET75]; supernodal: [SelInv].
 *  Example  tests/core/test_selected.c
 */
SL_API SL_WARN_UNUSED sl_status sl_selected_create(sl_selected **out, const sl_factor *F,
                                                   const sl_int *set, sl_int count,
                                                   const sl_options *opt, sl_stats *stats);

/** Computes the same entries from the present numbers of F, in the same memory.
 *
 *  Z      [in,out]  unchanged on error.
 *  F      [in]      a factor over the analysis that Z was made for.
 *  W      [in,out]  workspace; NULL: allocated for this call.
 *  Returns  SL_OK; SL_ERR_ARGUMENT; SL_ERR_STATE: failed factor, a factor of another analysis, or
 *           Z is mapped; SL_ERR_TOO_LARGE; SL_ERR_MEMORY.
 *  Cost     as sl_selected_create; no allocation once W has grown. Up to twice as fast, since the
 *           memory is mapped already.
 *  Threads  exclusive use of Z; runs on the threads that Z was made with.
 *  Example  tests/core/test_selected.c
 */
SL_API SL_WARN_UNUSED sl_status sl_selected_refactor(sl_selected *Z, const sl_factor *F,
                                                     sl_work *W);

/** Releases a selected inverse; NULL is allowed. */
SL_API void sl_selected_free(sl_selected *Z);

/** Diagonal entries of A^-1.
 *
 *  out    [out]  count entries in the order of rows. On error untouched.
 *  rows   [in]   count rows of A in 0..n-1, any order, repetitions allowed; NULL (count is
 *                ignored): all n.
 *  stats  [out]  error.row; may be NULL.
 *  Returns  SL_OK; SL_ERR_ARGUMENT: NULL, or a row out of range (error.row); SL_ERR_PATTERN: a row
 *           that the set of Z does not reach (error.row).
 *  Cost     O(count), with a logarithmic factor if Z was made for a set.
 *  Threads  any number at once.
 *  Example  tests/core/test_selected.c
 */
SL_API SL_WARN_UNUSED sl_status sl_selected_diagonal(const sl_selected *Z, double *out,
                                                     const sl_int *rows, sl_int count,
                                                     sl_stats *stats);

/** Entries (A^-1)_ij on the pattern of L.
 *
 *  out      [out]  count entries: out[k] is the entry of rows[k] and columns[k]. On error
 *                  untouched.
 *  rows     [in]   count rows of A in 0..n-1.
 *  columns  [in]   count columns of A in 0..n-1.
 *  stats    [out]  error.row, error.column; may be NULL.
 *  Returns  SL_OK; SL_ERR_ARGUMENT: NULL, or an index out of range; SL_ERR_PATTERN: an entry that
 *           is not in the pattern of L or that the set of Z does not reach. error.row and
 *           error.column name it.
 *  Cost     O(count) binary searches.
 *  Threads  any number at once.
 *  Example  tests/core/test_selected.c
 */
SL_API SL_WARN_UNUSED sl_status sl_selected_entries(const sl_selected *Z, double *out,
                                                    const sl_int *rows, const sl_int *columns,
                                                    sl_int count, sl_stats *stats);

/** Arrays of a selected inverse; valid as long as the object.
 *
 *  The panel of supernode supers[k] begins at Z[begin[k]] and has the layout of the panels of L,
 *  described at sl_symbolic_arrays. Unlike there, the diagonal is stored; entries above it within a
 *  tile are unspecified, and padding is 0.
 */
typedef struct sl_selected_arrays {
    const sl_symbolic *symbolic;
    sl_int count;         /* supernodes */
    const sl_int *supers; /* count, ascending */
    const sl_off *begin;  /* count + 1, in doubles */
    const double *Z;      /* begin[count] */
} sl_selected_arrays;

SL_API sl_selected_arrays sl_selected_view(const sl_selected *Z);

/** Fills the selected group of stats again; seconds are those of the last sl_selected_create or
 *  sl_selected_refactor. */
SL_API void sl_selected_stats(const sl_selected *Z, sl_stats *stats);

/** Grows W to what sl_selected_refactor(Z, F, W) takes, so that the call allocates nothing.
 *
 *  W      [in,out]  the workspace.
 *  Z      [in]      the selected inverse.
 *  Returns  SL_OK; SL_ERR_ARGUMENT; SL_ERR_TOO_LARGE; SL_ERR_MEMORY.
 *  Cost     O(1). The size is exact: the fronts under way and the scratch of each thread, as in
 *           sl_selected_create.
 *  Example  tests/core/test_reserve_inverse.c
 */
SL_API SL_WARN_UNUSED sl_status sl_work_reserve_selected(sl_work *W, const sl_selected *Z);

/* src/public/region.h: regions, inside which the cost of local solves does not depend on the whole matrix */

/* The path from a vertex to the root of the elimination tree grows with the mesh. A region cuts it
 * off. It consists of T, the columns of whole subtrees, and S, the boundary: every row outside T in
 * which a column of T has an entry of L. For b and x on T and S
 *
 *     y = L_TT^-1 b_T,  u = b_S - L_ST y,  x_S = (A^-1)_SS u,
 *
 * and the backward sweep continues in T. The region keeps (A^-1)_SS, so that a solve reads L in T
 * only and gives the answer of the full solve to rounding. If null pivots were skipped, A^-1 is the
 * generalized inverse that solves apply: 0 in the rows and columns of null pivots. Consistency of b
 * is then checked only for null rows inside the region, and where components have several null
 * vectors (options.null_vector_count), only if the region has no boundary.
 */

/** Creates the region of a set of rows: what solves with b and x in the set need of the inverse.
 *
 *  The subtrees are chosen so that a solve with b and x on the whole set reads as few numbers as
 *  possible. Few large subtrees have a short boundary and large panels; with no subtree at all, the
 *  set itself is the boundary. The other rows of the subtrees belong to the region too.
 *
 *  out    [out]  the region, or NULL on error; release with sl_region_free. For options.region of
 *                sl_plan_create.
 *  F      [in]   the factor; it and its analysis are borrowed and must outlive the object. When F
 *                is refactored, or a refactorization fails, plans in the region are refused until
 *                sl_region_refactor.
 *  set    [in]   count rows of A in 0..n-1, any order, repetitions allowed; NULL (count is
 *                ignored): all n. For an empty set pass a pointer that is not NULL and count = 0;
 *                it is not dereferenced.
 *  Z      [in]   a selected inverse of the present numbers of F, or NULL. It is used if it contains
 *                all entries needed, as for a single row or the subtree of one supernode; such a
 *                region is then preferred if it costs a solve at most twice as much. Otherwise
 *                forward sweeps compute the entries, as in sl_inverse_block.
 *  opt    [in]   allocator, region_bytes; may be NULL. Subtrees are chosen so that
 *                stats.region.bytes is at most region_bytes. If only a region without boundary
 *                fits, solves go to the roots of the tree.
 *  stats  [out]  region; error.row: a row out of range; may be NULL.
 *  Returns  SL_OK; SL_ERR_ARGUMENT; SL_ERR_STATE: failed factor, or Z is not of the present F;
 *           SL_ERR_UNSUPPORTED: a factor made with options.mass or with 2x2 pivots;
 *           SL_ERR_TOO_LARGE; SL_ERR_MEMORY.
 *  Cost     a plan for the set; for every 8 rows of the boundary one forward sweep of 8 lanes to
 *           the roots, and (boundary)^2 / 2 times the columns of such a path for the sums, or one
 *           binary search per entry of Z. Keeps 4 (boundary)^2 bytes and about 100 per row of the
 *           boundary.
 *  Threads  reads F and Z.
 *  Source   [HDA17] 3 for the sweeps. The part of the matrix outside T enters as a Schur
 *           complement, whose inverse is (A^-1)_SS.
 *  Example  tests/core/test_region.c
 */
SL_API SL_WARN_UNUSED sl_status sl_region_create(sl_region **out, const sl_factor *F,
                                                 const sl_int *set, sl_int count,
                                                 const sl_selected *Z, const sl_options *opt,
                                                 sl_stats *stats);

/** Recomputes a region from the present numbers of F, in the same memory; its plans stay valid.
 *
 *  R      [in,out]  unchanged on error.
 *  F      [in]      a factor over the analysis that R was made for; from now on the only one that R
 *                   accepts.
 *  Z      [in]      as in sl_region_create; may be NULL.
 *  W      [in,out]  workspace; NULL: allocated for this call.
 *  Returns  SL_OK; SL_ERR_ARGUMENT; SL_ERR_STATE: failed factor, a factor of another analysis, Z
 *           is not of the present F, or R is mapped; SL_ERR_UNSUPPORTED: as sl_region_create;
 *           SL_ERR_TOO_LARGE; SL_ERR_MEMORY.
 *  Cost     as sl_region_create without the plan; no allocation once W has grown.
 *  Threads  exclusive use of R and of its plans.
 *  Example  tests/core/test_region.c
 */
SL_API SL_WARN_UNUSED sl_status sl_region_refactor(sl_region *R, const sl_factor *F,
                                                   const sl_selected *Z, sl_work *W);

/** Releases a region; NULL is allowed. */
SL_API void sl_region_free(sl_region *R);

/** Fills the region group of stats. */
SL_API void sl_region_stats(const sl_region *R, sl_stats *stats);

/** Arrays of a region; valid as long as the object. */
typedef struct sl_region_arrays {
    const sl_symbolic *symbolic;
    sl_int n_roots;
    const sl_int *roots; /* n_roots supernodes, ascending: roots of the interior subtrees */
    sl_int n_boundary;
    const sl_int *boundary; /* n_boundary rows of A, in elimination order */
} sl_region_arrays;

SL_API sl_region_arrays sl_region_view(const sl_region *R);

/** Grows W to what sl_region_refactor(R, F, Z, W) takes, so that the call allocates nothing, with
 *  any Z or none.
 *
 *  W      [in,out]  the workspace.
 *  R      [in]      the region.
 *  F      [in]      a factor over the analysis of R. The size depends on its instruction set, not
 *                   on its numbers.
 *  Returns  SL_OK; SL_ERR_ARGUMENT; SL_ERR_STATE: F is of another analysis; SL_ERR_TOO_LARGE;
 *           SL_ERR_MEMORY.
 *  Cost     O(boundary) paths to the roots. The size is exact where the numbers come from forward
 *           sweeps; where they are copied from Z, no workspace is needed.
 *  Example  tests/core/test_reserve_inverse.c
 */
SL_API SL_WARN_UNUSED sl_status sl_work_reserve_region(sl_work *W, const sl_region *R,
                                                       const sl_factor *F);

/* src/public/save.h: a factor in a file or in memory: saved, loaded, and mapped without a copy */

/* A saved factor outlives its process, and any number of processes can map one file and share one
 * copy of it in memory. The format is that of the arrays in memory: src/FORMAT.md specifies it. It
 * is the same for every instruction set and for 32 and 64 bits. Files of processors of the other
 * byte order are loaded, but not mapped. The same analysis and factor give the same bytes; times
 * are not saved.
 *
 * A loaded or mapped factor solves like the saved one, with the same bits on the same instruction
 * set. It works with plans, regions and selected inverses that are made over the analysis that came
 * with it. A plan of another analysis is refused (SL_ERR_STATE), also if both were loaded from one
 * file.
 *
 * Calls of saved_set.h save selected inverses and regions too. The calls below read their files and
 * leave those out.
 *
 * A loaded factor can be refactored; the first refactorization allocates the memory of its fronts.
 * A mapped one is immutable, so that refactorizations give SL_ERR_STATE. */

/** How a saved factor is checked before it is used. The header and the table of sections are always
 *  checked, with their checksums. */
typedef enum sl_load_checks {
    /* every index is in range and every structure consistent: with any bytes whatsoever, later
     * calls stay inside the memory of the objects and terminate. Numbers may be wrong */
    SL_LOAD_CHECKED = 0,
    /* no more than loading itself needs: for files that nobody else can write. A forged or damaged
     * file may crash the call or later ones */
    SL_LOAD_TRUSTED,
    /* as SL_LOAD_CHECKED, and the checksums of everything that is loaded: no byte of it has changed
     * by accident */
    SL_LOAD_VERIFIED
} sl_load_checks;

/** The bytes that an analysis and a factor take when they are saved.
 *
 *  bytes  [out]  a multiple of 64.
 *  S      [in]   the analysis.
 *  F      [in]   a factor over S, or NULL: the analysis alone.
 *  Returns  SL_OK; SL_ERR_ARGUMENT; SL_ERR_STATE: a failed factor, one over another analysis, or
 *           objects from a file that a newer version has written and this one reads in part;
 *           SL_ERR_TOO_LARGE: more than size_t holds.
 *  Cost     O(1).
 *  Threads  reads S and F.
 */
SL_API SL_WARN_UNUSED sl_status sl_save_bytes(size_t *bytes, const sl_symbolic *S,
                                              const sl_factor *F);

/** Saves an analysis and a factor in the caller's memory.
 *
 *  memory  [out]  of `bytes` bytes, at least those of sl_save_bytes; the rest is not written. For
 *                 sl_map_memory it must be aligned to 64 bytes.
 *  bytes   [in]   the size of memory.
 *  S, F    [in]   as in sl_save_bytes.
 *  Returns  as sl_save_bytes; SL_ERR_ARGUMENT: also if memory is too small.
 *  Cost     reads S and F twice.
 *  Threads  reads S and F.
 *  Example  tests/core/test_save.c
 */
SL_API SL_WARN_UNUSED sl_status sl_save_memory(void *memory, size_t bytes, const sl_symbolic *S,
                                               const sl_factor *F);

/** Saves an analysis and a factor in a file.
 *
 *  The file gets its name only when it is complete and, on Linux, macOS and Windows, on its device.
 *  An error, a full disk or a crash leaves the old file as it was, and processes that have mapped
 *  the old file keep it. On Linux, a process that is killed leaves no temporary file on most file
 *  systems. A device or a symbolic link is written in place.
 *
 *  path  [in]  the name of the file.
 *  S, F  [in]  as in sl_save_bytes.
 *  opt   [in]  allocator; may be NULL.
 *  Returns  as sl_save_bytes; SL_ERR_IO; SL_ERR_MEMORY.
 *  Cost     reads S and F twice; waits until the file is on its device.
 *  Threads  reads S and F.
 *  Example  tests/core/test_save_file.c
 */
SL_API SL_WARN_UNUSED sl_status sl_save_file(const char *path, const sl_symbolic *S,
                                             const sl_factor *F, const sl_options *opt);

/** Creates the analysis and the factor that memory holds, as copies.
 *
 *  S       [out]  the analysis, or NULL on error; release with sl_symbolic_free, after the factor.
 *  F       [out]  the factor, NULL on error and if none was saved; release with sl_factor_free. If
 *                 F is NULL, the analysis alone is loaded.
 *  memory  [in]   what sl_save_memory or sl_save_file wrote, of any alignment.
 *  bytes   [in]   the size that was saved, exactly.
 *  checks  [in]   see sl_load_checks.
 *  opt     [in]   allocator, threads, isa; may be NULL. threads are those of refactorizations.
 *  Returns  SL_OK; SL_ERR_ARGUMENT; SL_ERR_UNSUPPORTED: not a saved factor, one that this version
 *           cannot read, or the isa; SL_ERR_IO: incomplete, damaged or inconsistent;
 *           SL_ERR_TOO_LARGE: sizes do not fit size_t; SL_ERR_MEMORY.
 *  Cost     the copy, and checks in O(n + rows of the supernodes + entries of A). Never allocates
 *           more than `bytes` and the size of the two objects, whatever the memory contains.
 *  Threads  any number of calls at once.
 *  Example  tests/core/test_save.c
 */
SL_API SL_WARN_UNUSED sl_status sl_load_memory(sl_symbolic **S, sl_factor **F, const void *memory,
                                               size_t bytes, sl_load_checks checks,
                                               const sl_options *opt);

/** sl_load_memory from a file, which is closed when the call returns.
 *
 *  path  [in]  the file.
 *  Arguments, status, cost and threads otherwise as in sl_load_memory; SL_ERR_IO: also if the file
 *  cannot be read.
 *  Example  tests/core/test_save_file.c
 */
SL_API SL_WARN_UNUSED sl_status sl_load_file(sl_symbolic **S, sl_factor **F, const char *path,
                                             sl_load_checks checks, const sl_options *opt);

/** Creates an analysis and a factor whose arrays are those in memory, without a copy.
 *
 *  memory  [in]  as in sl_load_memory, aligned to 64 bytes; borrowed, must outlive both objects and
 *                not change.
 *  S, F, bytes, checks, opt  as in sl_load_memory; isa only, threads are those of the inverse.
 *  Returns  as sl_load_memory; SL_ERR_ARGUMENT: also if memory is not aligned; SL_ERR_UNSUPPORTED:
 *           also if the byte order is not that of this processor.
 *  Cost     the checks; with SL_LOAD_TRUSTED O(1). Keeps less than 4 KB.
 *  Threads  any number of calls at once.
 *  Example  tests/core/test_save.c
 */
SL_API SL_WARN_UNUSED sl_status sl_map_memory(sl_symbolic **S, sl_factor **F, const void *memory,
                                              size_t bytes, sl_load_checks checks,
                                              const sl_options *opt);

/** sl_map_memory of a file that is mapped into memory, read-only and shared with other processes.
 *
 *  The file is unmapped by sl_symbolic_free. Replace it by sl_save_file or by renaming: the system
 *  stops a process that reads a part of a mapped file that was cut off, and changes show in the
 *  factor. Pages are read when they are first needed.
 *
 *  path  [in]  the file.
 *  Arguments, status, cost and threads otherwise as in sl_map_memory; SL_ERR_IO: the file cannot be
 *  read; SL_ERR_UNSUPPORTED: also with SL_NO_MMAP, and on systems other than POSIX and Windows.
 *  Example  tests/core/test_save_file.c
 */
SL_API SL_WARN_UNUSED sl_status sl_map_file(sl_symbolic **S, sl_factor **F, const char *path,
                                            sl_load_checks checks, const sl_options *opt);

/* src/public/saved_set.h: a factor with its selected inverse and regions in one file or block of memory */

/* Regions and selected inverses take longer to make than to read. The calls below save them
 * together with their factor. Without them, the file is the same as that of sl_save_file. */

/** What one file holds. The caller fills one in to save his objects; a load fills in new ones,
 *  which sl_saved_set_free releases. */
typedef struct sl_saved_set {
    sl_symbolic *symbolic;
    sl_factor *factor;     /* over symbolic; NULL: none */
    sl_selected *selected; /* of the present numbers of factor, or alone; NULL: none */
    sl_region **regions;   /* n_regions, of the present numbers of factor; NULL if n_regions is 0 */
    sl_int n_regions;
    sl_allocator allocator; /* of the array regions; set by loads, not read by saves */
} sl_saved_set;

/** The bytes that a set takes when it is saved.
 *
 *  bytes  [out]  a multiple of 64.
 *  set    [in]   a selected inverse may be saved without a factor; regions may not. The same region
 *                may be given more than once.
 *  Returns  SL_OK; SL_ERR_ARGUMENT: a NULL, n_regions below 0, or regions without a factor;
 *           SL_ERR_STATE: as sl_save_bytes, or a selected inverse or region that is of another
 *           analysis or not of the present numbers of factor; SL_ERR_TOO_LARGE.
 *  Cost     O(1 + n_regions).
 *  Threads  reads the objects.
 */
SL_API SL_WARN_UNUSED sl_status sl_save_set_bytes(size_t *bytes, const sl_saved_set *set);

/** Saves a set in the caller's memory. The same objects give the same bytes.
 *
 *  memory, bytes  [out]  as in sl_save_memory, at least what sl_save_set_bytes gives.
 *  set            [in]   as in sl_save_set_bytes.
 *  Returns  as sl_save_set_bytes; SL_ERR_ARGUMENT: also if memory is too small.
 *  Cost     reads the objects twice.
 *  Threads  reads the objects.
 *  Example  tests/core/test_saved_set.c
 */
SL_API SL_WARN_UNUSED sl_status sl_save_set_memory(void *memory, size_t bytes,
                                                   const sl_saved_set *set);

/** Saves a set in a file, which is replaced as by sl_save_file.
 *
 *  path  [in]  the name of the file.
 *  set   [in]  as in sl_save_set_bytes.
 *  opt   [in]  allocator; may be NULL.
 *  Returns  as sl_save_set_bytes; SL_ERR_IO; SL_ERR_MEMORY.
 *  Cost     reads the objects twice; waits until the file is on its device.
 *  Threads  reads the objects.
 *  Example  tests/core/test_saved_set.c
 */
SL_API SL_WARN_UNUSED sl_status sl_save_set_file(const char *path, const sl_saved_set *set,
                                                 const sl_options *opt);

/** Creates all objects that memory holds, as copies.
 *
 *  Selected inverse and regions are those of the loaded factor: they have the bits of the saved
 *  ones, and plans in the regions solve with it. They can be refactored with it. A selected inverse
 *  that was saved without a factor answers queries and can be refactored; sl_region_create refuses
 *  it.
 *
 *  set     [out]  the objects; all zero on error. Release with sl_saved_set_free.
 *  memory, bytes, checks  [in]  as in sl_load_memory.
 *  opt     [in]   allocator, threads, isa; may be NULL. threads are those of refactorizations.
 *  Returns  as sl_load_memory.
 *  Cost     the copy, and checks as in sl_load_memory, in O(supernodes) for the selected inverse
 *           and in O(roots and rows of the boundary, log n each, and rows below the roots) for the
 *           regions. Never allocates more than 8 times `bytes`, whatever the memory contains.
 *  Threads  any number of calls at once.
 *  Example  tests/core/test_saved_set.c
 */
SL_API SL_WARN_UNUSED sl_status sl_load_set_memory(sl_saved_set *set, const void *memory,
                                                   size_t bytes, sl_load_checks checks,
                                                   const sl_options *opt);

/** sl_load_set_memory from a file, which is closed when the call returns.
 *
 *  path  [in]  the file.
 *  Arguments, status, cost and threads otherwise as in sl_load_set_memory; SL_ERR_IO: also if the
 *  file cannot be read.
 *  Example  tests/core/test_saved_set.c
 */
SL_API SL_WARN_UNUSED sl_status sl_load_set_file(sl_saved_set *set, const char *path,
                                                 sl_load_checks checks, const sl_options *opt);

/** Creates objects whose numbers are those in memory, without a copy.
 *
 *  All of them are immutable: sl_selected_refactor and sl_region_refactor give SL_ERR_STATE, as
 *  refactorizations do.
 *
 *  memory  [in]  as in sl_map_memory: borrowed, aligned to 64 bytes.
 *  set, bytes, checks, opt  as in sl_load_set_memory; isa only, threads are those of the inverse.
 *  Returns  as sl_map_memory.
 *  Cost     the checks; with SL_LOAD_TRUSTED O(1) and O(rows of the boundary) for each region.
 *           Keeps less than 4 KB, and for each region less than 500 bytes and 16 for each row of
 *           the boundary and each subtree.
 *  Threads  any number of calls at once.
 *  Example  tests/core/test_saved_set.c
 */
SL_API SL_WARN_UNUSED sl_status sl_map_set_memory(sl_saved_set *set, const void *memory,
                                                  size_t bytes, sl_load_checks checks,
                                                  const sl_options *opt);

/** sl_map_set_memory of a file that is mapped into memory as by sl_map_file. The file is unmapped
 *  when the analysis is released.
 *
 *  path  [in]  the file.
 *  Arguments, status, cost and threads otherwise as in sl_map_set_memory; SL_ERR_IO and
 *  SL_ERR_UNSUPPORTED also as in sl_map_file.
 *  Example  tests/core/test_saved_set.c
 */
SL_API SL_WARN_UNUSED sl_status sl_map_set_file(sl_saved_set *set, const char *path,
                                                sl_load_checks checks, const sl_options *opt);

/** Releases the objects of a set that a load filled in, then sets it to all zero. Objects that the
 *  caller keeps he takes out before, by setting their pointers to NULL. NULL is allowed. */
SL_API void sl_saved_set_free(sl_saved_set *set);

/* src/public/change.h: a factor that follows small changes of its matrix */

/** Changes a factor of A into one of A + V diag(sigma) V'. Plans stay valid; regions and selected
 *  inverses of the old numbers are refused.
 *
 *  Only the columns of L on the paths from the rows of V to the roots change. Vectors are taken in
 *  passes of 8, neighbors together; a pass of 8 takes about as long as 2 to 4 of one vector.
 *
 *  A vector must not create entries outside of L: all its rows have to be in the column of L that
 *  belongs to the first of them. This holds for e_i and, for an entry (i, j) of A, for e_i - e_j.
 *
 *  If all pivots of F have one sign, they must keep it. Vectors of that sign are then applied
 *  first, and the others fail only if the changed matrix is not definite, to rounding. With pivots
 *  of both signs a change may also fail because it meets a null pivot on its way.
 *
 *  Errors add up: stats.change.drift estimates their backward error. In 10,000 random changes of a
 *  definite matrix it stayed above the measured one. If growth or drift are too large, refactor.
 *  For pivots of both signs stats.factor.growth becomes an upper bound, and pivot_min and pivot_max
 *  bounds, until the next refactorization. The effect of regularization (A + E) stays as it was.
 *
 *  F      [in,out]  the factor. On error it is as before, bit for bit, except after
 *                   SL_ERR_NOT_FINITE for an overflow, or where a pivot fails although a trial
 *                   found none that does, by rounding: then it has no numbers.
 *  V      [in]      n x k, any k, in the rows of A; duplicates are summed, zeros ignored.
 *  sigma  [in]      k weights of any sign; NULL: all 1.
 *  W      [in,out]  workspace; NULL: allocated for this call.
 *  stats  [out]     change, factor; may be NULL.
 *  Returns  SL_OK; SL_ERR_ARGUMENT: also if V has not n rows; SL_ERR_PATTERN: V is malformed, or
 *           its row error.row is not in the column of L of error.column; SL_ERR_PIVOT: a pivot
 *           would change its sign or vanish, at error.row; SL_ERR_NOT_FINITE: an entry of V at
 *           error.row, a weight (error.row = -1) or a pivot; SL_ERR_INACCURATE: growth beyond its
 *           limit; SL_ERR_STATE: F has no numbers or is mapped; SL_ERR_UNSUPPORTED: null pivots
 *           were skipped, there are 2x2 pivots, or L is in float; SL_ERR_TOO_LARGE; SL_ERR_MEMORY.
 *  Cost     4 flops per vector and entry of L in the columns on its path; each pass reads and
 *           writes these columns once. A pass that may fail takes another forward sweep; several
 *           such passes, and pivots of both signs, a copy of the columns.
 *  Threads  exclusive use of F.
 *  Source   [DH01], with the factorization of [Bie76] for several vectors.
 *  Example  tests/core/test_change.c
 */
SL_API SL_WARN_UNUSED sl_status sl_factor_update(sl_factor *F, const sl_csc *V, const double *sigma,
                                                 sl_work *W, sl_stats *stats);

/** Changes a factor by entries of A: a_ij and a_ji by delta.
 *
 *  The library finds rank-one changes: one for the weight of an edge of a graph, which changes a_ij
 *  by -w and a_ii and a_jj by w, one for an entry of the diagonal, and up to three for any other
 *  entry.
 *
 *  rows, columns  [in]  count entries (i, j) of either triangle, each pair i != j once for both
 *                       sides; repeated ones add up. L must have an entry there; all entries of A
 *                       do.
 *  deltas         [in]  count changes.
 *  F, W, stats, Returns, Cost, Threads  as in sl_factor_update; SL_ERR_ARGUMENT: also an index out
 *                       of range, at error.row and error.column.
 *  Example  tests/core/test_change.c
 */
SL_API SL_WARN_UNUSED sl_status sl_factor_update_entries(sl_factor *F, const sl_int *rows,
                                                         const sl_int *columns,
                                                         const double *deltas, sl_int count,
                                                         sl_work *W, sl_stats *stats);

/** Changes a factor by entries of A in the cheapest way: by rank-one changes, by recomputing the
 *  columns of L that the change reaches, or by a refactorization.
 *
 *  The ways are compared by their flops, each with what a flop costs in it. Rank-one changes are
 *  not taken if there are null or 2x2 pivots, if L is stored in float, and if stats.change.drift
 *  has reached 1e-11, which takes some 40,000 changes of moderate size. Where they are refused
 *  because a pivot changes its sign, a refactorization decides whether A can be factored.
 *
 *  F              [in,out]  the factor, or a failed one, which is refactored. On error as with
 *                           sl_factor_refactor.
 *  A              [in]      the changed matrix, in the analyzed pattern.
 *  rows, columns, deltas  [in]  how it differs from the matrix of F, as in
 *                           sl_factor_update_entries.
 *  W              [in,out]  workspace; NULL: allocated for this call.
 *  stats          [out]     change, factor; may be NULL.
 *  Returns  as sl_factor_refactor and sl_factor_update_entries.
 *  Cost     that of the way, O(nnz) to compare the pattern of A, and at most a few percent of a
 *           refactorization to count flops.
 *  Threads  exclusive use of F.
 *  Example  tests/core/test_change_choice.c
 */
SL_API SL_WARN_UNUSED sl_status sl_factor_change(sl_factor *F, const sl_csc *A, const sl_int *rows,
                                                 const sl_int *columns, const double *deltas,
                                                 sl_int count, sl_work *W, sl_stats *stats);

/* src/public/pins.h: rows held at given values, on top of a factor that stays as it is */

/** Creates an empty set of pins: rows, or linear combinations of rows, that solves hold at given
 *  values. For definite A this minimizes x' A x / 2 - b' x under these equalities. The factor does
 *  not change: a pin is one forward sweep, and solves take one forward and one backward sweep.
 *
 *  Singular matrices: with SL_NULL_PIVOT_SKIP and a known null vector (sl_factor_create), one pin
 *  makes a component regular, if the null vector is not 0 there. In components without pins x is 0
 *  in the null rows, and b has to be consistent, which is not checked. Weights (options.mass) are
 *  not used.
 *
 *  out  [out]  the set, or NULL on error; release with sl_pins_free.
 *  F    [in]   the factor; it and its analysis are borrowed and must outlive the object. When F
 *              changes, solves are refused until sl_pins_refactor.
 *  opt  [in]   allocator; may be NULL.
 *  Returns  SL_OK; SL_ERR_ARGUMENT; SL_ERR_STATE: failed factor; SL_ERR_UNSUPPORTED: pivots of both
 *           signs, or 2x2 pivots; SL_ERR_MEMORY; SL_ERR_TOO_LARGE.
 *  Cost     O(1); with SL_NULL_PIVOT_SKIP 8 bytes per row.
 *  Source   capacitance matrix of a change of low rank, as in [Hager89].
 *  Example  tests/core/test_pins.c
 */
SL_API SL_WARN_UNUSED sl_status sl_pins_create(sl_pins **out, const sl_factor *F,
                                               const sl_options *opt);

/** Releases a set of pins; NULL is allowed. */
SL_API void sl_pins_free(sl_pins *P);

/** Adds a pin: x is held at a value in one row of A. It becomes the last one of P.
 *
 *  row    [in]   in 0..n-1.
 *  stats  [out]  error.row; may be NULL.
 *  Returns  SL_OK; SL_ERR_ARGUMENT; SL_ERR_PIVOT: the row is held already, by this pin or a
 *           combination of the others, to rounding; SL_ERR_STATE: F has changed;
 *           SL_ERR_UNSUPPORTED: the null vector of the row's component is not known; SL_ERR_MEMORY;
 *           SL_ERR_TOO_LARGE. On error P is as before.
 *  Cost     a forward sweep, k products over shared columns and O(k^2); keeps 8 bytes per column of
 *           the path, and 4 per row below its supernodes.
 *  Threads  exclusive use of P; F is read.
 */
SL_API SL_WARN_UNUSED sl_status sl_pins_add(sl_pins *P, sl_int row, sl_stats *stats);

/** Adds an equality: the sum of values[k] x(rows[k]) is held. A pin is the case of one row and the
 *  value 1.
 *
 *  rows, values  [in]  count >= 1 entries, copied; a row given twice counts with the sum.
 *  Returns, Cost, Threads  as in sl_pins_add; SL_ERR_NOT_FINITE: a value (error.row);
 *                SL_ERR_UNSUPPORTED: null pivots, and rows of several trees of the factor.
 */
SL_API SL_WARN_UNUSED sl_status sl_pins_add_equality(sl_pins *P, const sl_int *rows,
                                                     const double *values, sl_int count,
                                                     sl_stats *stats);

/** Releases pin number `index`, 0-based. Those after it move down by one.
 *
 *  Returns  SL_OK; SL_ERR_ARGUMENT.  Cost  O(k^2).  Threads  exclusive use of P.
 */
SL_API SL_WARN_UNUSED sl_status sl_pins_release(sl_pins *P, sl_int index);

/** The number k of pins and equalities. */
SL_API sl_int sl_pins_count(const sl_pins *P);

/** Takes the present numbers of the factor, after it has changed.
 *
 *  Returns  as sl_pins_add. On error solves are refused until a later call succeeds.
 *  Cost     k forward sweeps and O(k^3).  Threads  exclusive use of P; F is read.
 */
SL_API SL_WARN_UNUSED sl_status sl_pins_refactor(sl_pins *P);

/** Solves A x = b + C f with C' x = g, where the columns of C are the equalities: for pins, x is g
 *  in their rows, and A x = b in all others.
 *
 *  plan   [in]   a local solve of the rows that the plan names; NULL: a full one. b is 0 outside of
 *                the b-set, the pins are not: they need not be in either set. A plan in a region is
 *                not supported.
 *  X      [out]  nx x nrhs (full: n x nrhs), column-major, leading dimension ldx elements. May be B
 *                itself (then ldx = ldb). On error untouched.
 *  B      [in]   nb x nrhs (full: n x nrhs), column-major, leading dimension ldb elements. Its
 *                values in rows that are pins are not used.
 *  G      [in]   k x nrhs, column-major, leading dimension ldg elements: the values, in the order
 *                of the pins.
 *  W      [in,out]  workspace; NULL: allocated for this call.
 *  Returns  SL_OK; SL_ERR_ARGUMENT; SL_ERR_STATE: F has changed, or the plan is of another
 *           analysis; SL_ERR_UNSUPPORTED: a plan in a region; SL_ERR_TOO_LARGE, SL_ERR_MEMORY.
 *  Cost     a solve, k products over shared columns, twice, and O(k^2), for each right-hand side.
 *  Threads  any number at once on one P, each with its own W.
 */
SL_API SL_WARN_UNUSED sl_status sl_pins_solve(const sl_pins *P, const sl_plan *plan, double *X,
                                              size_t ldx, const double *B, size_t ldb,
                                              const double *G, size_t ldg, sl_int nrhs, sl_work *W);

/* src/public/complex.h: complex Hermitian systems, solved as real ones of twice the size */

/* Connection Laplacians and the like: H x = b with a Hermitian H of n complex rows. Complex row k
 * becomes the real rows 2k (real part) and 2k + 1 (imaginary part), and an entry a + bi becomes the
 * block [a -b; b a]. The real matrix is symmetric, and definite if and only if H is.
 *
 * A complex vector in memory, real and imaginary parts in turn, IS the vector of the real system:
 * every call on factors and plans takes complex arrays as they are, with leading dimensions counted
 * in doubles, twice the complex ones. What differs is here: matrices, sets of rows, entries of the
 * inverse, the determinant. Of statistics, n and the counts of pivots (stats.factor.positive, ...)
 * are twice those of H; condition and backward errors are those of the real system.
 *
 *     sl_matrix_from_hermitian(&M, &H, NULL, NULL);
 *     A = sl_matrix_view(M);
 *     options.block_size = 2;                          orders a block as one row, which is quicker
 *     sl_symbolic_create(&S, &A, &options, NULL);
 *     sl_factor_create(&F, S, &A, NULL, NULL);
 *     sl_factor_solve(F, x, 2 * n, b, 2 * n, 1, W);    double x[2 n]
 *
 * L has four times the entries of that of a real matrix with the pattern of H.
 */

/** View of a complex Hermitian matrix in compressed columns: one triangle or both, entries and
 *  duplicates as in sl_csc. The imaginary parts of diagonal entries are 0. */
typedef struct sl_hermitian {
    sl_int n;
    const sl_int *p; /* n + 1 */
    const sl_int *i; /* p[n] */
    /* 2 p[n] with real and imaginary parts in turn; the real parts alone, p[n], if im is not NULL;
     * NULL: pattern only */
    const double *x;
    const double *im; /* p[n] imaginary parts, or NULL */
} sl_hermitian;

/** The real matrix of a Hermitian one. It stores the triangle or triangles that H stores, and zeros
 *  beside the diagonal: with options.block_size 2 the columns of a block then follow each other in
 *  one supernode.
 *
 *  out    [out]  2n x 2n, or NULL on error; release with sl_matrix_free.
 *  opt    [in]   allocator; may be NULL.
 *  stats  [out]  error.row, error.column, in complex rows; may be NULL.
 *  Returns  SL_OK; SL_ERR_ARGUMENT: also im without x, or a diagonal entry with an imaginary part
 *           that is not 0; SL_ERR_PATTERN; SL_ERR_TOO_LARGE: more than 2^30 - 4 rows, or more than
 *           2^31 - 1 entries, of which a complex one is 4; SL_ERR_MEMORY.
 *  Cost     O(n + nnz).
 *  Threads  any number with different outputs.
 *  Example  tests/core/test_complex.c
 */
SL_API SL_WARN_UNUSED sl_status sl_matrix_from_hermitian(sl_matrix **out, const sl_hermitian *H,
                                                         const sl_options *opt, sl_stats *stats);

/** Replaces the values of such a matrix by those of another H with the same pattern, for
 *  sl_factor_refactor.
 *
 *  M      [in,out]  of sl_matrix_from_hermitian, with values; on error untouched.
 *  stats  [out]     error.row, error.column, in complex rows; may be NULL.
 *  Returns  SL_OK; SL_ERR_ARGUMENT: also a pattern without values; SL_ERR_PATTERN: another pattern.
 *  Cost     O(n + nnz).
 *  Threads  exclusive use of M.
 *  Example  tests/core/test_complex.c
 */
SL_API SL_WARN_UNUSED sl_status sl_matrix_refill_hermitian(sl_matrix *M, const sl_hermitian *H,
                                                           sl_stats *stats);

/** A set of complex rows as real rows: out[2k] = 2 rows[k], out[2k + 1] = 2 rows[k] + 1. For calls
 *  that have no complex form: pins, regions, requests of a batch.
 *
 *  out    [out]  2 count rows; must not overlap rows.
 *  rows   [in]   count rows in 0..2^30-5.
 *  Returns  SL_OK; SL_ERR_ARGUMENT: also a row out of range.  Cost  O(count).
 */
SL_API SL_WARN_UNUSED sl_status sl_complex_rows(sl_int *out, const sl_int *rows, sl_int count);

/** sl_plan_create with sets of complex rows.
 *
 *  S      [in]   analysis of the real matrix, 2n columns; borrowed, must outlive the plan.
 *  bset, nb, xset, nx  [in]  as in sl_plan_create, in complex rows 0..n-1. B and X of
 *                sl_plan_solve then have 2 nb and 2 nx doubles for each right-hand side.
 *  stats  [out]  as in sl_plan_create; error.row is a complex row.
 *  Returns  as sl_plan_create; SL_ERR_ARGUMENT also if S has an odd number of columns.
 *  Cost     as sl_plan_create.
 *  Threads  as sl_plan_create.
 *  Example  tests/core/test_complex.c
 */
SL_API SL_WARN_UNUSED sl_status sl_complex_plan_create(sl_plan **out, const sl_symbolic *S,
                                                       const sl_int *bset, sl_int nb,
                                                       const sl_int *xset, sl_int nx,
                                                       const sl_options *opt, sl_stats *stats);

/** A dense block of the complex inverse: Z(i, j) = (H^-1)(rows[i], columns[j]).
 *
 *  Z        [out]  n_rows x n_columns complex numbers, real and imaginary parts in turn,
 *                  column-major, leading dimension ldz >= n_rows complex numbers.
 *  rows, columns  [in]  n_rows and n_columns complex rows, any order, repetitions allowed.
 *  W, stats  as in sl_inverse_block; error.row and error.column are complex rows.
 *  Returns  as sl_inverse_block; SL_ERR_ARGUMENT also if F has an odd number of rows.
 *  Cost     sl_inverse_block of 2 n_rows x n_columns entries; allocates the sets.
 *  Threads  as sl_inverse_block.
 *  Example  tests/core/test_complex.c
 */
SL_API SL_WARN_UNUSED sl_status sl_complex_inverse_block(const sl_factor *F, double *Z, size_t ldz,
                                                         const sl_int *rows, sl_int n_rows,
                                                         const sl_int *columns, sl_int n_columns,
                                                         sl_work *W, sl_stats *stats);

/** Entries of the complex inverse: out[2k] and out[2k + 1] are the real and the imaginary part of
 *  (H^-1)(rows[k], columns[k]).
 *
 *  rows, columns  [in]  count complex rows each, any order, repetitions allowed.
 *  W, stats  as in sl_inverse_pairs; error.row and error.column are complex rows.
 *  Returns  as sl_inverse_pairs; SL_ERR_ARGUMENT also if F has an odd number of rows.
 *  Cost     sl_inverse_pairs of 2 count entries; allocates the sets.
 *  Threads  as sl_inverse_pairs.
 *  Example  tests/core/test_complex.c
 */
SL_API SL_WARN_UNUSED sl_status sl_complex_inverse_pairs(const sl_factor *F, double *out,
                                                         const sl_int *rows, const sl_int *columns,
                                                         sl_int count, sl_work *W, sl_stats *stats);

/** log |det H| and the sign of det H, which is real: half the logarithm of the real determinant,
 *  and the parity of half the negative pivots.
 *
 *  Returns  as sl_factor_logdet.  Cost  O(n).
 */
SL_API SL_WARN_UNUSED sl_status sl_complex_logdet(const sl_factor *F, double *log_abs_det,
                                                  double *sign);

/* src/public/restrict.h: the factor of a principal submatrix, from that of the whole matrix */

/** Factors A[R, R], the matrix of the rows and columns R of A, from a factor of A.
 *
 *  This is the system of a part of a mesh with zero Dirichlet values around it. Columns of L are
 *  kept whose supernode and all its descendants are in R; they are copied without the rows that are
 *  not in R. The others are analyzed and computed anew, in the order of A. So there is no ordering.
 *  If only few columns can be kept, A[R, R] is extracted, analyzed and factored instead
 *  (stats.restriction.is_anew).
 *
 *  G and S do not depend on F, which may change or be released. Row k of them is rows[k] of A.
 *  Plans, full, half and local solves, pins, entries of the inverse, selected inverses and regions
 *  work as with any factor. The numbers stay as they are: refactorizations, changes and saving give
 *  SL_ERR_STATE. What compares a matrix with the analyzed pattern gives SL_ERR_PATTERN: refinement,
 *  sl_factor_rcond, another factor over S. Where a supernode lost rows, parent and counts of
 *  sl_symbolic_view are an ancestor of the parent and an upper bound.
 *
 *  G refuses null pivots, also if F skips them: a singular Laplacian is regular without one of the
 *  rows of each component. A component that is in R as a whole gives SL_ERR_PIVOT. Only
 *  null_tolerance decides which other pivots are null. The rest of F's options apply to G:
 *  instruction set, null_tolerance, regularization with its signs, growth_limit, error_limit.
 *
 *  S      [out]  the analysis, or NULL on error; release with sl_symbolic_free after G.
 *  G      [out]  the factor, or NULL on error; release with sl_factor_free.
 *  F      [in]   a factor of A.
 *  A      [in]   the matrix that F was computed from. Read only in the columns of R that are
 *                computed anew; its pattern is not compared with the analyzed one.
 *  rows   [in]   count rows of A in 0..n-1, any order, no duplicates.
 *  opt    [in]   allocator; may be NULL.
 *  stats  [out]  restriction, factor; errors are in rows of A; may be NULL.
 *  Returns  SL_OK; SL_ERR_ARGUMENT: also a row out of range or given twice (error.row);
 *           SL_ERR_PATTERN: A has not the size or the number of entries of the analyzed matrix, or
 *           error.column of it is malformed; SL_ERR_PIVOT, SL_ERR_NOT_FINITE, SL_ERR_INACCURATE: as
 *           sl_factor_create; SL_ERR_STATE: F has no numbers; SL_ERR_UNSUPPORTED: F has 2x2
 *           pivots, several null vectors or L in float, or is a restriction itself;
 *           SL_ERR_TOO_LARGE; SL_ERR_MEMORY.
 *  Cost     linear in the entries of A and the rows of supernodes in R, a copy of the kept entries
 *           of L, and the flops of the other columns. For a patch of a mesh a little more than half
 *           the time of analyzing and factoring A[R, R] in a given order. If nothing can be kept,
 *           the time of its extraction more than that.
 *  Threads  reads F; one thread.
 *  Source   [HA18]
 *  Example  tests/core/test_restrict.c
 */
SL_API SL_WARN_UNUSED sl_status sl_factor_restrict(sl_symbolic **S, sl_factor **G,
                                                   const sl_factor *F, const sl_csc *A,
                                                   const sl_int *rows, sl_int count,
                                                   const sl_options *opt, sl_stats *stats);

/* src/public/edit.h: an analysis that follows edits of the pattern: rows and entries that come and go */

/** Analyzes an edited matrix B from the analysis of the matrix A that it was before.
 *
 *  This is for meshes that are remeshed or cut in places: edges are flipped, split and collapsed,
 *  vertices doubled. The elimination tree of A stays where B has the same neighbors. A row that is
 *  new or has other neighbors goes to the lowest supernode from which they are all above or below;
 *  so an entry between two subtrees moves one of its rows into their separator. Small subtrees with
 *  many such rows are ordered anew.
 *
 *  The result is an analysis as any other. Its order is as good as the one before if edits are
 *  local, and slowly becomes worse than a new one: stats.edit compares the entries of L. If
 *  stats.edit.is_due, create a new analysis of the present matrix, when there is time for it. If a
 *  quarter of the rows has other neighbors, or the edits are no local ones, this call does that
 *  itself (stats.edit.is_anew).
 *
 *  out     [out]  the analysis of B, or NULL on error; release with sl_symbolic_free. It does not
 *                 depend on S. It has no separator tree, unless it is a new one.
 *  S       [in]   an analysis of A.
 *  A       [in]   the matrix that S was created from; values are not read.
 *  B       [in]   n x n, symmetric, any n; values are not read; not kept.
 *  new_of  [in]   rows of A: new_of[i] is the row of B that row i of A has become, or -1 if it is
 *                 gone. Rows of B that do not occur are new.
 *  opt     [in]   allocator, triangle, relaxation; with a new order all that sl_symbolic_create
 *                 reads; may be NULL.
 *  stats   [out]  symbolic, edit; may be NULL.
 *  Returns  SL_OK; SL_ERR_ARGUMENT: also a row of B out of range or twice in new_of (error.row is
 *           the row of A), and as sl_symbolic_create; SL_ERR_PATTERN: A has not the analyzed
 *           pattern, or B is malformed or not symmetric; SL_ERR_UNSUPPORTED: S was created with
 *           pivots or by sl_factor_restrict; SL_ERR_ORDERING; SL_ERR_TOO_LARGE; SL_ERR_MEMORY.
 *  Cost     O(n + nnz + rows of the supernodes) with small constants, to compare the patterns and to copy
 *           the analysis; besides, the order and analysis of the columns above the edit. With a
 *           mesh of 1e6 vertices, of which 0.1 % are remeshed, 1/12 to 1/18 of a new analysis.
 *  Threads  reads S; otherwise as sl_symbolic_create.
 *  Source   [Liu90] elimination trees; [George73] separators.
 *  Example  tests/core/test_edit.c
 */
SL_API SL_WARN_UNUSED sl_status sl_symbolic_edit(sl_symbolic **out, const sl_symbolic *S,
                                                 const sl_csc *A, const sl_csc *B,
                                                 const sl_int *new_of, const sl_options *opt,
                                                 sl_stats *stats);

#ifdef __cplusplus
}
#endif
#endif /* SPARSE_LOCAL_H */

/* ---- bodies, in one source file ---- */
#if (defined(SPARSE_LOCAL_IMPLEMENTATION) || defined(SL_STATIC)) && \
    !defined(SPARSE_LOCAL_IMPLEMENTED)
#define SPARSE_LOCAL_IMPLEMENTED
/* base: the compiler, status, memory, sorting, threads */
/* src/impl/base/base.h: system headers, everything that depends on the compiler, small helpers for integers */

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

#if defined(SL_METIS) && !defined(SL_NO_METIS)
#define SLI_METIS 1
#endif

#if defined(__GNUC__) || defined(__clang__)
#define SLI_GNU 1
#endif

#if defined(SL_NO_SIMD)
#elif defined(__clang__) || (defined(__GNUC__) && !defined(_WIN32))
#if defined(__x86_64__) || defined(__i386__)
#define SLI_X86 1
#include <immintrin.h>
#if defined(_MSC_VER)
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

#if defined(__BYTE_ORDER__) && __BYTE_ORDER__ == __ORDER_BIG_ENDIAN__
#define SLI_BIG_ENDIAN 1
#endif

#if defined(__linux__) && defined(__GNUC__)
#define SLI_HUGE_PAGES 14
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
#define SLI_ALWAYS_INLINE __attribute__((unused, always_inline)) static inline
#define SLI_NOINLINE __attribute__((unused, noinline))
#define SLI_TARGET(list) __attribute__((target(list)))
#define SLI_ALIGNED(variable) variable __attribute__((aligned(64)))
#define SLI_PREFETCH(p, bytes) \
  __builtin_prefetch((const void *)((uintptr_t)(p) + (uintptr_t)(bytes)))
#define SLI_UNROLL _Pragma("GCC unroll 8")
#else
#define SLI_INLINE static inline
#define SLI_NOINLINE
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
#endif
#if defined(SLI_GNU)
#define SLI_FNMA1(a, b, c) __builtin_fma(-(a), b, c)
#elif defined(SLI_X86)
#define SLI_FNMA1(a, b, c) \
  _mm_cvtsd_f64(_mm_fnmadd_sd(_mm_set_sd(a), _mm_set_sd(b), _mm_set_sd(c)))
#else
#define SLI_FNMA1(a, b, c) fma(-(a), b, c)
#endif
#if defined(SLI_GNU) && defined(SLI_X86)
#define SLI_PIN(a) __asm__("" : "+x"(a))
#define SLI_PIN_ANY(a) __asm__("" : "+v"(a))
#else
#define SLI_PIN(a) ((void)0)
#define SLI_PIN_ANY(a) ((void)0)
#endif

#if defined(SLI_GNU) && (defined(__x86_64__) || defined(__i386__))
#define SLI_SPIN() __builtin_ia32_pause()
#elif defined(SLI_GNU) && defined(__aarch64__)
#define SLI_SPIN() __asm__ __volatile__("yield")
#elif defined(_MSC_VER) && defined(SLI_X86)
#define SLI_SPIN() _mm_pause()
#else
#define SLI_SPIN() ((void)0)
#endif

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
#endif

#if defined(SL_VERIFY)
#define SLI_ASSERT(condition) ((condition) ? (void)0 : abort())
#else
#define SLI_ASSERT(condition) ((void)0)
#endif

#define SLI_ROWS_MAX (INT32_MAX - 7)

SLI_INLINE sl_int sli_min(sl_int a, sl_int b) {
  return a < b ? a : b;
}

SLI_INLINE sl_int sli_max(sl_int a, sl_int b) {
  return a > b ? a : b;
}

SLI_INLINE sl_int sli_clamp(sl_int a, sl_int high) {
  return a < 0 ? 0 : a > high ? high : a;
}

SLI_INLINE int sli_exceeds_sqrt(int64_t a, sl_int factor, sl_int n) {
  return (uint64_t)a * (uint64_t)a > (uint64_t)(factor * factor) * (uint64_t)n;
}

SLI_INLINE int sli_is_finite(double a) {
  return a - a == 0.0;
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
SLI_INLINE int sli_is_link(const char *path) {
#if defined(SLI_WINDOWS)
  const unsigned long attributes = GetFileAttributesA(path);
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

SLI_INLINE double sli_seconds(void) {
#if defined(SL_NO_CLOCK)
  return 0.0;
#else
  return (double)clock() / (double)CLOCKS_PER_SEC;
#endif
}

/* src/impl/base/status.h: status codes as text, and the error group of stats */

SL_API int sl_version(void) {
  return SL_VERSION;
}

SL_API const char *sl_status_string(sl_status status) {
  switch (status) {
  case SL_OK:
    return "ok";
  case SL_ERR_ARGUMENT:
    return "invalid argument";
  case SL_ERR_MEMORY:
    return "out of memory";
  case SL_ERR_PATTERN:
    return "malformed or unsymmetric pattern";
  case SL_ERR_PIVOT:
    return "null pivot: singular matrix, or one that needs pivoting";
  case SL_ERR_NOT_FINITE:
    return "not a finite number";
  case SL_ERR_TOO_LARGE:
    return "too large for the integer type";
  case SL_ERR_UNSUPPORTED:
    return "not supported";
  case SL_ERR_IO:
    return "file cannot be read, parsed or written";
  case SL_ERR_ORDERING:
    return "ordering failed";
  case SL_ERR_STATE:
    return "failed factor, or objects that do not belong together";
  case SL_ERR_INCONSISTENT:
    return "inconsistent right-hand side of a singular system";
  case SL_ERR_INACCURATE:
    return "inaccurate: pivot growth or backward error above its limit";
  }
  return "unknown status";
}

SL_API size_t sl_stats_size(void) {
  return sizeof(sl_stats);
}

SLI_INLINE void sli_stats_clear_error(sl_stats *stats) {
  if (stats != NULL) {
    stats->error.row = -1;
    stats->error.column = -1;
    stats->error.line = -1;
    stats->error.value = 0.0;
  }
}

SLI_INLINE sl_status sli_fail_at(sl_stats *stats, sl_status status, sl_int row, sl_int column,
                 double value) {
  if (stats != NULL) {
    stats->error.row = row;
    stats->error.column = column;
    stats->error.value = value;
  }
  return status;
}

/* src/impl/base/options.h: initializes options and checks them in every call */

enum {
  SLI_READS_NOTHING = 0,
  SLI_READS_TRIANGLE = 1,
  SLI_READS_ANALYSIS = 2,
  SLI_READS_FACTOR = 4,
  SLI_READS_REGION = 8,
  SLI_READS_REGION_BYTES = 16,
  SLI_READS_ISA = 32
};

SL_API void sl_options_init(sl_options *opt, size_t size) {
  if (opt != NULL && size >= sizeof opt->size) {
    memset(opt, 0, size);
    opt->size = size;
  }
}

#if defined(SL_VERIFY)
static int sli_options_set(const sl_options *opt) {
  const int analysis = opt->ordering != 0 || opt->relaxation != 0 || opt->perm != NULL ||
             opt->metis_options != NULL || opt->coordinates != NULL ||
             opt->dimensions != 0 || opt->block_size != 0 || opt->purpose != 0;
  const int factor = opt->method != 0 || opt->null_pivots != 0 || opt->null_tolerance != 0.0 ||
             opt->mass != NULL || opt->consistency_tolerance != 0.0 ||
             opt->regularization != 0.0 || opt->signs != NULL ||
             opt->null_vector != NULL || opt->growth_limit != 0.0 ||
             opt->error_limit != 0.0 || opt->null_vector_count != 0 ||
             opt->storage != 0;
  return (opt->isa != 0 ? SLI_READS_ISA : 0) | (opt->triangle != 0 ? SLI_READS_TRIANGLE : 0) |
       (analysis ? SLI_READS_ANALYSIS : 0) | (factor ? SLI_READS_FACTOR : 0) |
       (opt->region != NULL ? SLI_READS_REGION : 0) |
       (opt->region_bytes != 0 ? SLI_READS_REGION_BYTES : 0);
}
#endif

SLI_INLINE int sli_options_are_valid(const sl_options *opt, int reads) {
  size_t k;
  if (opt == NULL) {
    return 1;
  }
  for (k = 0; k < sizeof opt->reserved / sizeof opt->reserved[0]; k++) {
    if (opt->reserved[k] != NULL) {
      return 0;
    }
  }
#if defined(SL_VERIFY)
  if ((sli_options_set(opt) & ~reads) != 0) {
    return 0;
  }
#else
  (void)reads;
#endif
  return (opt->size == 0 || opt->size == sizeof *opt) && opt->threads.count >= 0 &&
       (opt->allocator.allocate == NULL) == (opt->allocator.release == NULL);
}

/* src/impl/base/alloc.h: the allocator: 64-byte aligned blocks, cut into arrays with overflow checks */

#define SLI_ALIGN ((size_t)64)

#define SLI_HUGE_BLOCK ((size_t)4 << 20)
#define SLI_PAGE ((size_t)65536)

SLI_INLINE void sli_advise_huge_pages(void *block, size_t bytes) {
#if defined(SLI_HUGE_PAGES)
  if (block != NULL && bytes >= SLI_HUGE_BLOCK) { /* untested: memory that ends */
    const size_t skipped = (SLI_PAGE - (uintptr_t)block % SLI_PAGE) % SLI_PAGE;
    const int keep = errno;
    (void)sli_madvise((char *)block + skipped, (bytes - skipped) / SLI_PAGE * SLI_PAGE,
              SLI_HUGE_PAGES);
    errno = keep;
  }
#else
  (void)block;
  (void)bytes;
#endif
}

SLI_INLINE void *sli_malloc_default(void *context, size_t bytes) {
  void *block = malloc(bytes);
  (void)context;
  sli_advise_huge_pages(block, bytes);
  return block;
}

SLI_INLINE void sli_free_default(void *context, void *block) {
  (void)context;
  free(block);
}

SLI_INLINE sl_allocator sli_allocator(const sl_options *opt) {
  sl_allocator a;
  if (opt != NULL && opt->allocator.allocate != NULL && opt->allocator.release != NULL) {
    return opt->allocator;
  }
  a.allocate = sli_malloc_default;
  a.release = sli_free_default;
  a.context = NULL;
  return a;
}

SLI_INLINE sl_options sli_options_with(const sl_allocator *a) {
  sl_options opt;
  memset(&opt, 0, sizeof opt);
  opt.allocator = *a;
  return opt;
}

SLI_INLINE void *sli_alloc(const sl_allocator *a, size_t bytes) {
  unsigned char *raw, *block;
  if (bytes > SIZE_MAX - SLI_ALIGN - sizeof(void *)) {
    return NULL;
  }
  raw = (unsigned char *)a->allocate(a->context, bytes + SLI_ALIGN + sizeof(void *));
  if (raw == NULL) {
    return NULL;
  }
  block = raw + sizeof(void *);
  block += (SLI_ALIGN - (size_t)((uintptr_t)block % SLI_ALIGN)) % SLI_ALIGN;
  memcpy(block - sizeof(void *), &raw, sizeof(void *));
  return block;
}

SLI_INLINE void sli_free(const sl_allocator *a, void *block) {
  void *raw;
  if (block != NULL) {
    memcpy(&raw, (unsigned char *)block - sizeof(void *), sizeof(void *));
    a->release(a->context, raw);
  }
}

typedef struct sli_block {
  unsigned char *base;
  size_t used;
  int overflow;
} sli_block;

SLI_INLINE void *sli_take(sli_block *b, uint64_t count, size_t size) {
  const size_t at = b->used;
  size_t bytes = SIZE_MAX;
  if (count <= (SIZE_MAX - SLI_ALIGN) / size) {
    bytes = ((size_t)count * size + SLI_ALIGN - 1) / SLI_ALIGN * SLI_ALIGN;
  }
  if (bytes > SIZE_MAX - at) {
    b->used = SIZE_MAX;
    b->overflow = 1;
    return NULL;
  }
  b->used += bytes;
  return b->base == NULL ? NULL : b->base + at;
}

SLI_INLINE sl_status sli_block_alloc(sli_block *b, const sl_allocator *a) {
  if (b->overflow) {
    return SL_ERR_TOO_LARGE;
  }
  b->base = (unsigned char *)sli_alloc(a, b->used > 0 ? b->used : 1);
  if (b->base == NULL) {
    return SL_ERR_MEMORY;
  }
  b->used = 0;
  return SL_OK;
}

#define SLI_TAKE(b, type, count) ((type *)sli_take((b), (uint64_t)(count), sizeof(type)))

/* src/impl/base/hash.h: 128-bit hashes of arrays, by which objects recognize the contents of others */

typedef struct sli_hash {
  uint64_t a, b;
} sli_hash;

#define SLI_HASH_STRIPE 64
#define SLI_HASH_1 0xa0761d6478bd642fu
#define SLI_HASH_2 0xe7037ed1a0b428dbu
#define SLI_HASH_3 0x8ebc6af09c88c6e3u
#define SLI_HASH_4 0x589965cc75374cc3u

SLI_INLINE int sli_hash_equals(sli_hash g, sli_hash h) {
  return ((g.a ^ h.a) | (g.b ^ h.b)) == 0;
}

SLI_INLINE uint64_t sli_fold(uint64_t x, uint64_t y) {
#if defined(__SIZEOF_INT128__)
  __extension__ typedef unsigned __int128 sli_wide;
  const sli_wide product = (sli_wide)x * y;
  return (uint64_t)product ^ (uint64_t)(product >> 64);
#else
  const uint64_t x0 = (uint32_t)x, x1 = x >> 32, y0 = (uint32_t)y, y1 = y >> 32;
  const uint64_t low = x0 * y0, middle = x1 * y0 + (low >> 32);
  const uint64_t other = x0 * y1 + (uint32_t)middle;
  return x * y ^ (x1 * y1 + (middle >> 32) + (other >> 32));
#endif
}

typedef enum sli_hashed { SLI_HASH_INTS, SLI_HASH_WORDS, SLI_HASH_BYTES } sli_hashed;

SLI_ALWAYS_INLINE uint64_t sli_word(const void *bytes, sli_hashed kind) {
  uint64_t word;
  memcpy(&word, bytes, sizeof word);
#if defined(SLI_BIG_ENDIAN)
  word = kind == SLI_HASH_WORDS  ? word
       : kind == SLI_HASH_INTS ? word << 32 | word >> 32
                   : __builtin_bswap64(word);
#else
  (void)kind;
#endif
  return word;
}

SLI_ALWAYS_INLINE uint64_t sli_hash_stripe(uint64_t *chain, const unsigned char *bytes,
                       sli_hashed kind, uint64_t room) {
  uint64_t beyond = 0;
  int c;
  SLI_UNROLL
  for (c = 0; c < 4; c++) {
    const uint64_t x = sli_word(bytes + 16 * c, kind), y = sli_word(bytes + 16 * c + 8, kind);
    chain[c] = sli_fold(x ^ SLI_HASH_1, y ^ chain[c]);
    beyond |= (x + room) | x | (y + room) | y;
  }
  return beyond;
}

SLI_INLINE void sli_hash_begin(sli_hash h, uint64_t *chain) {
  chain[0] = h.a ^ SLI_HASH_2;
  chain[1] = h.b ^ SLI_HASH_3;
  chain[2] = h.a + SLI_HASH_4;
  chain[3] = h.b + SLI_HASH_1;
}

SLI_INLINE sli_hash sli_hash_end(const uint64_t *chain, uint64_t bytes) {
  sli_hash h;
  h.a = sli_fold(chain[0] ^ bytes, chain[1] ^ SLI_HASH_2) ^
      sli_fold(chain[2] ^ SLI_HASH_3, chain[3] ^ SLI_HASH_4);
  h.b = sli_fold(chain[0] ^ SLI_HASH_4, chain[2] ^ SLI_HASH_1) +
      sli_fold(chain[1] ^ SLI_HASH_3, chain[3] ^ SLI_HASH_2);
  return h;
}

SLI_ALWAYS_INLINE uint64_t sli_hash_stripes(uint64_t *chain, const void *data, size_t bytes,
                      sli_hashed kind, uint64_t room) {
  uint64_t found = 0;
  const unsigned char *at = (const unsigned char *)data;
  size_t left = bytes;
  for (; left >= SLI_HASH_STRIPE; left -= SLI_HASH_STRIPE, at += SLI_HASH_STRIPE) {
    found |= sli_hash_stripe(chain, at, kind, room);
  }
  if (left > 0) {
    unsigned char last[SLI_HASH_STRIPE] = {0};
    memcpy(last, at, left);
    found |= sli_hash_stripe(chain, last, kind, room);
  }
  return found;
}

SLI_ALWAYS_INLINE sli_hash sli_hash_checked(sli_hash h, const void *data, size_t bytes,
                      sli_hashed kind, uint64_t room, uint64_t *beyond) {
  uint64_t chain[4];
  sli_hash_begin(h, chain);
  *beyond = sli_hash_stripes(chain, data, bytes, kind, room);
  return sli_hash_end(chain, bytes);
}

#if defined(SLI_BIG_ENDIAN)
static sli_hash sli_hash_ints(sli_hash h, const sl_int *a, sl_off count) {
  uint64_t unused;
  return sli_hash_checked(h, a, (size_t)count * sizeof *a, SLI_HASH_INTS, 0, &unused);
}

static sli_hash sli_hash_words(sli_hash h, const void *a, sl_off count) {
  uint64_t unused;
  return sli_hash_checked(h, a, (size_t)count * 8, SLI_HASH_WORDS, 0, &unused);
}
#else
static sli_hash sli_hash_bytes(sli_hash h, const void *data, size_t bytes) {
  uint64_t unused;
  return sli_hash_checked(h, data, bytes, SLI_HASH_BYTES, 0, &unused);
}

SLI_INLINE sli_hash sli_hash_ints(sli_hash h, const sl_int *a, sl_off count) {
  return sli_hash_bytes(h, a, (size_t)count * sizeof *a);
}

SLI_INLINE sli_hash sli_hash_words(sli_hash h, const void *a, sl_off count) {
  return sli_hash_bytes(h, a, (size_t)count * 8);
}
#endif

static int sli_hash_indices(sli_hash *h, const sl_int *a, sl_int count, sl_int n) {
  const uint64_t room = ((uint64_t)1 << 31) - (uint64_t)n;
  uint64_t beyond;
  *h = sli_hash_checked(*h, a, (size_t)count * sizeof *a, SLI_HASH_INTS, room << 32 | room,
              &beyond);
  return count == 0 || (beyond & 0x8000000080000000u) == 0;
}

/* src/impl/base/file_map.h: files mapped into memory, read-only, and the size of a file */

typedef struct sli_mapping {
  const void *bytes;
  size_t size;
} sli_mapping;

static sl_status sli_map(const char *path, sli_mapping *out) {
  sl_status status = SL_ERR_IO;
  out->bytes = NULL;
  out->size = 0;
#if defined(SLI_MMAP)
  {
    const int file = open(path, O_RDONLY);
    struct stat found;
    void *bytes;
    if (file < 0) {
      return SL_ERR_IO;
    }
    if (fstat(file, &found) == 0 && S_ISREG(found.st_mode) && found.st_size > 0) {
      status = (uint64_t)found.st_size > SIZE_MAX / 2 ? SL_ERR_TOO_LARGE : SL_OK;
    }
    if (status == SL_OK) {
      bytes = mmap(NULL, (size_t)found.st_size, PROT_READ, MAP_SHARED, file, 0);
      if (bytes == MAP_FAILED) {
        status = errno == ENOMEM ? SL_ERR_MEMORY : SL_ERR_IO;
      } else {
        out->bytes = bytes;
        out->size = (size_t)found.st_size;
      }
    }
    close(file);
  }
#elif defined(SLI_MAP_VIEW)
  {
    void *const file = CreateFileA(path, 0x80000000u, 1 | 4, NULL, 3, 0x80, NULL);
    void *section;
    int64_t size = 0;
    if ((intptr_t)file == -1) {
      return SL_ERR_IO;
    }
    if (GetFileSizeEx(file, (sli_windows_number)(void *)&size) && size > 0) {
      status = (uint64_t)size > SIZE_MAX / 2 ? SL_ERR_TOO_LARGE : SL_OK;
    }
    section = status != SL_OK ? NULL : CreateFileMappingA(file, NULL, 2, 0, 0, NULL);
    if (section != NULL) {
      out->bytes = MapViewOfFile(section, 4, 0, 0, 0);
      CloseHandle(section);
    }
    if (status == SL_OK && out->bytes == NULL) {
      status = SL_ERR_IO;
    } else if (status == SL_OK) {
      out->size = (size_t)size;
    }
    CloseHandle(file);
  }
#else
  (void)path;
  status = SL_ERR_UNSUPPORTED;
#endif
  return status;
}

static void sli_unmap(const sli_mapping *map) {
  if (map->bytes != NULL) {
#if defined(SLI_MMAP)
    munmap((void *)(uintptr_t)map->bytes, map->size);
#elif defined(SLI_MAP_VIEW)
    UnmapViewOfFile(map->bytes);
#endif
  }
}

static uint64_t sli_file_size(FILE *file) {
#if defined(_WIN32)
  const int64_t size = _fseeki64(file, 0, SEEK_END) == 0 ? _ftelli64(file) : 0;
#else
  const int64_t size = fseek(file, 0, SEEK_END) == 0 ? (int64_t)ftell(file) : 0;
#endif
  rewind(file);
  return size > 0 ? (uint64_t)size : 0;
}

static int sli_flush(FILE *file) {
  if (fflush(file) != 0) {
    return 0;
  }
#if defined(SLI_FSYNC)
  return sli_fsync(sli_fileno(file)) == 0 || errno == EINVAL || errno == EROFS;
#elif defined(_WIN32)
  return _commit(_fileno(file)) == 0 || _isatty(_fileno(file));
#else
  return 1;
#endif
}

/* src/impl/base/sort.h: sorts pairs (key, value): insertion sort for few, radix sort for many; binary search */

SLI_INLINE uint64_t sli_keyed(sl_int key, sl_int value) {
  return (uint64_t)(uint32_t)key << 32 | (uint32_t)value;
}

SLI_INLINE sl_int sli_key(uint64_t keyed) {
  return (sl_int)(keyed >> 32);
}

SLI_INLINE sl_int sli_value(uint64_t keyed) {
  return (sl_int)(uint32_t)(keyed & 0xffffffffu);
}

static sl_int sli_lower_bound(const sl_int *a, sl_int count, sl_int bound) {
  sl_int low = 0, high = count;
  while (low < high) {
    const sl_int middle = low + (high - low) / 2;
    if (a[middle] < bound) {
      low = middle + 1;
    } else {
      high = middle;
    }
  }
  return low;
}

#define SLI_SORT_SMALL 48

static void sli_sort(uint64_t *a, sl_int count, uint64_t *scratch) {
  sl_int i, k;
  sl_int largest = 0;
  int shift;
  if (count <= SLI_SORT_SMALL) {
    for (i = 1; i < count; i++) {
      const uint64_t here = a[i];
      for (k = i; k > 0 && a[k - 1] >> 32 > here >> 32; k--) {
        a[k] = a[k - 1];
      }
      a[k] = here;
    }
    return;
  }
  for (i = 0; i < count; i++) {
    largest = sli_max(largest, sli_key(a[i]));
  }
  for (shift = 32; shift < 64 && largest > 0; shift += 8, largest >>= 8) {
    sl_int start[256], total = 0;
    memset(start, 0, sizeof start);
    for (i = 0; i < count; i++) {
      start[(a[i] >> shift) & 255]++;
    }
    for (k = 0; k < 256; k++) {
      const sl_int here = start[k];
      start[k] = total;
      total += here;
    }
    for (i = 0; i < count; i++) {
      scratch[start[(a[i] >> shift) & 255]++] = a[i];
    }
    memcpy(a, scratch, (size_t)count * sizeof *a);
  }
}

/* src/impl/base/parallel.h: runs work items on the caller's threads; a lock and a pause for those that share */

SLI_INLINE sl_int sli_workers(const sl_threads *t) {
#if !defined(_OPENMP)
  if (t->run == NULL) {
    return 1;
  }
#endif
  return sli_max(t->count, 1);
}

#if defined(SL_VERIFY) && !defined(SLI_SMALL_TASKS)
#define SLI_SMALL_TASKS 1
#endif

#if defined(SLI_SMALL_TASKS)
#define SLI_WORKER_FLOPS 1.0
#else
#define SLI_WORKER_FLOPS 1.5e7
#endif

static sl_int sli_workers_for(const sl_threads *t, double flops) {
#if defined(SLI_ATOMIC)
  const sl_int most = sli_workers(t);
  return flops >= SLI_WORKER_FLOPS * most ? most : sli_max((sl_int)(flops / SLI_WORKER_FLOPS), 1);
#else
  (void)t;
  (void)flops;
  return 1;
#endif
}

static void sli_pause(int turn) {
  if (turn < 1000) {
    SLI_SPIN();
    return;
  }
#if defined(SLI_WINDOWS)
  Sleep(turn < 1200 ? 0 : 1);
#elif defined(SLI_POSIX)
#if defined(SLI_USLEEP)
  if (turn >= 1200) {
    (void)sli_usleep(50);
    return;
  }
#endif
  (void)sched_yield();
#endif
}

static void sli_lock(sli_atomic *lock) {
  int turn;
  for (turn = 0; sli_atomic_exchange(lock, 1) != 0; turn++) {
    sli_pause(turn);
  }
}

SLI_INLINE void sli_unlock(sli_atomic *lock) {
  sli_atomic_write(lock, 0);
}

static void sli_parallel(const sl_threads *t, sl_int count, void (*body)(void *data, sl_int k),
             void *data) {
  sl_int k;
  if (t->run != NULL && count > 1) {
    t->run(t->context, count, body, data);
    return;
  }
#if defined(_OPENMP)
#pragma omp parallel for num_threads(count) schedule(static, 1) if (count > 1)
#endif
  for (k = 0; k < count; k++) {
    body(data, k);
  }
}

static sl_int sli_tile_range_begin(sl_int first, sl_int last, sl_int k, sl_int workers,
                   int is_triangle) {
  const double share = (double)k / workers;
  return first + (sl_int)((last - first) * (is_triangle ? sqrt(share) : share));
}

/* kernels: numerical kernels on raw arrays, once for each instruction set */
/* src/impl/kernels/panel.h: how the columns of L of one supernode are stored: row tiles of 8 */

#define SLI_TILE 8

SLI_INLINE sl_off sli_tile_offset(sl_int w, sl_int t) {
  sl_off whole = w / SLI_TILE, tile = t;
  return tile <= whole ? 32 * tile * (tile + 1)
             : 32 * whole * (whole + 1) + (tile - whole) * SLI_TILE * w;
}

SLI_INLINE sl_int sli_tiles(sl_int rows) {
  return rows / SLI_TILE + (rows % SLI_TILE != 0);
}

SLI_INLINE sl_off sli_panel_size(sl_int w, sl_int u) {
  return sli_tile_offset(w, sli_tiles(w + u));
}

SLI_INLINE sl_off sli_panel_at(sl_int w, sl_int r, sl_int j) {
  return sli_tile_offset(w, r / SLI_TILE) + (sl_off)j * SLI_TILE + r % SLI_TILE;
}

/* src/impl/kernels/step.h: the steps of a sweep, one for each supernode, and the contract of sweep kernels */

typedef struct sli_step {
  sl_off panel;
  sl_int column;
  sl_int base;
  sl_int width;
  sl_int below;
  sl_int first_tile;
  sl_int up;
} sli_step;

SLI_INLINE sl_int sli_step_columns(const sli_step *s) {
  return s->width - SLI_TILE * s->first_tile;
}

enum { SLI_NRHS_1, SLI_NRHS_2, SLI_NRHS_4, SLI_NRHS_8, SLI_NRHS_KINDS };

typedef void (*sli_forward_kernel)(sl_int count, const sli_step *steps, const sl_int *rows,
                   const void *L, double *x, double *scratch);

typedef void (*sli_backward_kernel)(sl_int count, const sli_step *steps, const sl_int *rows_end,
                  const void *L, const double *D, double *x, double *scratch);

typedef struct sli_sweeps {
  sli_forward_kernel forward[SLI_NRHS_KINDS];
  sli_backward_kernel backward[SLI_NRHS_KINDS];
} sli_sweeps;

typedef void (*sli_row_kernel)(double *panel, sl_int width, sl_int q, const sl_int *rows,
                 const double *D, double *x_super, double *x, double *scratch,
                 double *pivot, double *magnitude);

SLI_INLINE size_t sli_sweep_scratch(sl_int height, sl_int width, sl_int nrhs) {
  const size_t tile = SLI_TILE;
  return nrhs > 2 ? tile * (size_t)nrhs
          : tile * ((size_t)sli_tiles(height) * (size_t)nrhs + (size_t)width);
}

#define SLI_PREFETCH_DISTANCE 4096

/* src/impl/kernels/pivot_rule.h: replacement of null pivots and of pivots of the wrong sign */

enum {
  SLI_PIVOT_UNKNOWN = 0,
  SLI_PIVOT_NULL,
  SLI_PIVOT_KEPT,
  SLI_PIVOT_WEAK
};

typedef struct sli_pivot_rule {
  double null_tolerance;
  int replaces;
  double regularization;
  signed char *signs;
  signed char *kinds;
  const double *rounding;
  double *shifts;
} sli_pivot_rule;

#define SLI_NULL_PIVOT DBL_MAX

SLI_INLINE int sli_is_null(double pivot, double magnitude, double tolerance) {
  const double size = fabs(pivot);
  return size == 0.0 || (sli_is_finite(magnitude) && size <= tolerance * magnitude);
}

SLI_INLINE double sli_pivot_skipped(const sli_pivot_rule *rule, sl_int k, double d,
                  double magnitude) {
  const int is_null = sli_is_null(d, magnitude, rule->null_tolerance);
  const double sign = rule->signs[k] < 0 ? -1.0 : 1.0, least = DBL_EPSILON * magnitude;
  const int is_wrong = d * sign < 0.0;
  if (!sli_is_finite(d)) {
    return d;
  }
  if (rule->kinds[k] == SLI_PIVOT_NULL) {
    return SLI_NULL_PIVOT;
  }
  if (rule->kinds[k] == SLI_PIVOT_UNKNOWN) {
    return is_null ? SLI_NULL_PIVOT : d;
  }
  rule->kinds[k] = is_null || is_wrong ? SLI_PIVOT_WEAK : SLI_PIVOT_KEPT;
  if (is_wrong && !(fabs(d) <= rule->rounding[k])) {
    return d;
  }
  return fabs(d) < least ? sign * least : sign * fabs(d);
}

SLI_NOINLINE static double sli_pivot_by_rule(const sli_pivot_rule *rule, sl_int k, double d,
                       double magnitude) {
  int is_null, sign;
  double least;
  if (rule->regularization == 0.0) {
    return sli_pivot_skipped(rule, k, d, magnitude);
  }
  is_null = sli_is_null(d, magnitude, rule->null_tolerance);
  sign = rule->signs == NULL ? 1 : rule->signs[k];
  rule->shifts[k] = 0.0;
  if (!is_null && !(d * sign < 0.0)) {
    return d;
  }
  sign = sign != 0 ? sign : d < 0.0 ? -1 : 1;
  least = rule->regularization * (magnitude > 0.0 ? magnitude : 1.0);
  least = sign * (fabs(d) > least ? fabs(d) : least);
  rule->shifts[k] = least - d;
  return least;
}

/* src/impl/kernels/front.h: a front of the factorization, and the contract of the kernels that work on it */

SLI_INLINE sl_off sli_triangle_offset(sl_int t) {
  return 32 * (sl_off)t * (t + 1);
}

SLI_INLINE sl_int sli_update_tiles(sl_int w, sl_int u) {
  return u == 0 ? 0 : sli_tiles(w % SLI_TILE + u);
}

#define SLI_GROUP_TILES 8
#define SLI_CHUNK_COLUMNS 256

SLI_INLINE sl_int sli_front_scratch(sl_int width) {
  return SLI_GROUP_TILES * SLI_TILE * sli_min(width, SLI_CHUNK_COLUMNS);
}

#define SLI_FRONT_RECIPROCALS (3 * SLI_GROUP_TILES * SLI_TILE)

SLI_INLINE sl_int sli_front_groups(sl_int width) {
  return (sli_tiles(width) + SLI_GROUP_TILES - 1) / SLI_GROUP_TILES;
}

typedef struct sli_front {
  double *panel;
  sl_int width, below;
  double *update;
  double *D;
  double *magnitude;
  const unsigned char *pairs;
  double *E;
  double *reciprocals;
  const sli_pivot_rule *rule;
  sl_int column;
} sli_front;

typedef void (*sli_pivots_kernel)(const sli_front *f, sl_int c0, double *scratch);

typedef void (*sli_rows_kernel)(const sli_front *f, sl_int c0, sl_int t0, sl_int t1,
                double *scratch);

typedef void (*sli_update_kernel)(const sli_front *f, sl_int c0, sl_int c1, sl_int t0, sl_int t1,
                  double *scratch);

typedef void (*sli_assemble_kernel)(const sli_front *f, const double *from, sl_int skipped,
                  const sl_int *relative, sl_int columns, sl_int first,
                  sl_int last);

/* src/impl/kernels/pairs.h: 2x2 pivots: the column tile that holds some, and the rows below it, in plain C */

enum { SLI_PAIR_NONE = 0, SLI_PAIR_FIRST, SLI_PAIR_SECOND };

SLI_INLINE int sli_tile_has_pairs(const sli_front *f, sl_int c) {
  sl_int k, any = 0;
  if (f->pairs != NULL) {
    for (k = SLI_TILE * c; k < sli_min(f->width, SLI_TILE * (c + 1)); k++) {
      any |= f->pairs[k];
    }
  }
  return any != 0;
}

typedef struct sli_pair_steps {
  int is_swapped;
  double factor;
  double coefficient;
  double l, m;
} sli_pair_steps;

SLI_INLINE sli_pair_steps sli_pair_eliminate(double a, double b, double e) {
  sli_pair_steps steps;
  steps.is_swapped = fabs(a / e * b) <= fabs(e);
  steps.factor = steps.is_swapped ? a / e : e / a;
  steps.coefficient = steps.is_swapped ? b : e;
  steps.l = 1.0 / (steps.is_swapped ? e : a);
  steps.m = 1.0 / ((steps.is_swapped ? e : b) - steps.factor * steps.coefficient);
  return steps;
}

SLI_INLINE void sli_pair_solve(const sli_pair_steps *steps, double x, double y, double *l,
                 double *m) {
  const double first = steps->is_swapped ? y : x, second = steps->is_swapped ? x : y;
  *m = (second - steps->factor * first) * steps->m;
  *l = (first - steps->coefficient * *m) * steps->l;
}

typedef struct sli_pair {
  double p, q, r;
} sli_pair;

SLI_INLINE sli_pair sli_pair_absolute(double a, double b, double e) {
  const double most = fabs(a) > fabs(b) ? fabs(a) : fabs(b),
         size = most > fabs(e) ? most : fabs(e);
  const double f = size > 0.0 ? a / size : 0.0, g = size > 0.0 ? b / size : 0.0;
  const double h = size > 0.0 ? e / size : 0.0, det = fabs(f * g - h * h);
  const double trace = sqrt(f * f + g * g + 2.0 * (h * h + det));
  const double scale = trace > 0.0 ? size / trace : 0.0;
  sli_pair D;
  D.p = scale * (f * f + h * h + det);
  D.q = scale * fabs(h * (f + g));
  D.r = scale * (g * g + h * h + det);
  return D;
}

SLI_INLINE double sli_pair_gain(const sli_pair *D, double l, double m) {
  return l * l * D->p + 2.0 * fabs(l * m) * D->q + m * m * D->r;
}

SLI_INLINE int sli_pair_is_null(double a, double b, double e, double m_a, double m_b,
                double tolerance) {
  const double f = a / m_a, g = b / m_b, h = e / (sqrt(m_a) * sqrt(m_b));
  const double most = fabs(f) > fabs(g) ? fabs(f) : fabs(g);
  if (e == 0.0) {
    return sli_is_null(a, m_a, tolerance) || sli_is_null(b, m_b, tolerance);
  }
  if (m_a == 0.0 || m_b == 0.0 || !sli_is_finite(m_a) || !sli_is_finite(m_b)) {
    return 0;
  }
  return !(fabs(f * g - h * h) > tolerance * (most > fabs(h) ? most : fabs(h)));
}

static void sli_pair_by_rule(const sli_pivot_rule *rule, sl_int k, double *a, double *b, double e,
               const double *magnitude) {
  const double sign = *a + *b < 0.0 ? -1.0 : 1.0, other = e != 0.0 ? fabs(e) : 1.0;
  const int is_null =
    sli_pair_is_null(*a, *b, e, magnitude[0], magnitude[1], rule->null_tolerance);
  double *const d[2] = {a, b};
  int m;
  for (m = 0; m < 2; m++) {
    const double size = magnitude[m] > 0.0 ? magnitude[m] : other, before = *d[m];
    *d[m] += is_null ? sign * rule->regularization * size : 0.0;
    rule->shifts[k + m] = *d[m] - before;
  }
}

SLI_INLINE void sli_pair_subtract(double *p, sl_int i, sl_int columns, const double *l,
                  const double *x) {
  sl_int r;
  for (; i < columns; i++) {
    for (r = i; r < SLI_TILE; r++) {
      p[SLI_TILE * i + r] -= l[r] * x[i];
    }
  }
}

static void sli_pair_tile_single(const sli_front *f, sl_int first, sl_int k, sl_int columns,
                 double *p, double *reciprocals) {
  double *magnitude = f->magnitude + first, d = p[SLI_TILE * k + k];
  double l[SLI_TILE], x[SLI_TILE];
  sl_int r;
  if (f->rule->replaces) {
    d = sli_pivot_by_rule(f->rule, f->column + first + k, d, magnitude[k]);
  }
  f->D[first + k] = d;
  f->E[first + k] = 0.0;
  reciprocals[k] = 1.0 / d;
  reciprocals[SLI_TILE + k] = d < 0.0 ? 1.0 : -1.0;
  reciprocals[2 * SLI_TILE + k] = d;
  for (r = 0; r < SLI_TILE; r++) {
    x[r] = p[SLI_TILE * k + r];
    l[r] = r > k ? x[r] / d : 0.0;
    magnitude[r] += r > k ? fabs(l[r] * x[r]) : 0.0;
    p[SLI_TILE * k + r] = l[r];
  }
  sli_pair_subtract(p, k + 1, columns, l, x);
}

static void sli_pair_tile_double(const sli_front *f, sl_int first, sl_int k, sl_int columns,
                 double *p, double *reciprocals) {
  double *magnitude = f->magnitude + first, *u = p + SLI_TILE * k, *v = u + SLI_TILE;
  double a = u[k], b = v[k + 1], x[2][SLI_TILE], l[2][SLI_TILE];
  const double e = u[k + 1];
  sli_pair_steps steps;
  sli_pair size;
  sl_int r;
  if (f->rule->replaces) {
    sli_pair_by_rule(f->rule, f->column + first + k, &a, &b, e, magnitude + k);
  }
  steps = sli_pair_eliminate(a, b, e);
  size = sli_pair_absolute(a, b, e);
  f->D[first + k] = a;
  f->D[first + k + 1] = b;
  f->E[first + k] = e;
  f->E[first + k + 1] = 0.0;
  for (r = k; r < k + 2; r++) {
    reciprocals[r] = reciprocals[2 * SLI_TILE + r] = 1.0;
    reciprocals[SLI_TILE + r] = 0.0;
  }
  for (r = 0; r < SLI_TILE; r++) {
    x[0][r] = u[r];
    x[1][r] = v[r];
    l[0][r] = l[1][r] = 0.0;
    if (r > k + 1) {
      sli_pair_solve(&steps, u[r], v[r], &l[0][r], &l[1][r]);
      magnitude[r] += sli_pair_gain(&size, l[0][r], l[1][r]);
    }
    u[r] = l[0][r];
    v[r] = l[1][r];
  }
  sli_pair_subtract(p, k + 2, columns, l[0], x[0]);
  sli_pair_subtract(p, k + 2, columns, l[1], x[1]);
}

static void sli_pair_tile(const sli_front *f, sl_int c, double *reciprocals) {
  const sl_int first = SLI_TILE * c, columns = sli_min(SLI_TILE, f->width - first);
  double *p = f->panel + sli_tile_offset(f->width, c) + SLI_TILE * (ptrdiff_t)first;
  int safe = 1;
  sl_int k;
  for (k = 0; k < columns; k++) {
    if (f->pairs[first + k] == SLI_PAIR_FIRST) {
      sli_pair_tile_double(f, first, k++, columns, p, reciprocals);
    } else {
      sli_pair_tile_single(f, first, k, columns, p, reciprocals);
      safe &= fabs(f->D[first + k]) > 1e-290 && fabs(f->D[first + k]) < 1e290;
    }
  }
  if (!safe) {
    reciprocals[0] = 0.0;
  }
}

static void sli_pair_rows(const sli_front *f, sl_int c, sl_int t0, sl_int t1) {
  sl_int k, t, r;
  for (k = SLI_TILE * c; k < sli_min(f->width, SLI_TILE * (c + 1)); k++) {
    sli_pair_steps steps;
    sli_pair size;
    if (f->pairs[k] != SLI_PAIR_FIRST) {
      continue;
    }
    steps = sli_pair_eliminate(f->D[k], f->D[k + 1], f->E[k]);
    size = sli_pair_absolute(f->D[k], f->D[k + 1], f->E[k]);
    for (t = t0; t < t1; t++) {
      double *u = f->panel + sli_tile_offset(f->width, t) + SLI_TILE * (ptrdiff_t)k;
      double *v = u + SLI_TILE, *magnitude = f->magnitude + SLI_TILE * (ptrdiff_t)t;
      for (r = 0; r < SLI_TILE; r++) {
        sli_pair_solve(&steps, u[r], v[r], &u[r], &v[r]);
        magnitude[r] += sli_pair_gain(&size, u[r], v[r]);
      }
    }
  }
}

static void sli_pair_pack(const double *l, const double *E, sl_int length, double *B) {
  sl_int j, r;
  for (j = 0; j < length; j++) {
    if (E[j] != 0.0) {
      const ptrdiff_t u = SLI_TILE * (ptrdiff_t)j, v = u + SLI_TILE;
      for (r = 0; r < SLI_TILE; r++) {
        B[u + r] += l[v + r] * E[j];
        B[v + r] += l[u + r] * E[j];
      }
    }
  }
}

/* src/impl/kernels/inverse_front.h: a front of the inverse, and the contract of the kernels that compute it */

typedef struct sli_inverse_front {
  const double *panel;
  const double *D;
  double *front;
  sl_int width, below;
  sl_int first;
} sli_inverse_front;

SLI_INLINE ptrdiff_t sli_square_offset(sl_int h, sl_int t) {
  return (ptrdiff_t)SLI_TILE * h * t;
}

#define SLI_INVERSE_GROUP 16
#define SLI_INVERSE_COLUMNS (SLI_INVERSE_GROUP * SLI_TILE)
#define SLI_INVERSE_ROW (SLI_INVERSE_COLUMNS * SLI_TILE)

SLI_INLINE sl_int sli_inverse_last_group(const sli_inverse_front *f) {
  return (f->width - 1) / SLI_INVERSE_COLUMNS * SLI_INVERSE_COLUMNS;
}

SLI_INLINE sl_int sli_inverse_group_columns(const sli_inverse_front *f, sl_int j0) {
  return sli_min(SLI_INVERSE_COLUMNS, f->width - j0);
}

SLI_INLINE double *sli_inverse_weights(double *scratch) {
  return scratch + 2 * SLI_INVERSE_GROUP * SLI_INVERSE_ROW;
}
SLI_INLINE ptrdiff_t sli_inverse_stride(const sli_inverse_front *f, sl_int j0) {
  const sl_int above = (j0 + sli_inverse_group_columns(f, j0)) / SLI_TILE;
  return SLI_TILE * SLI_TILE * (ptrdiff_t)(sli_tiles(f->width + f->below) - above);
}
SLI_INLINE sl_off sli_inverse_scratch(sl_int height, sl_int width) {
  return 2 * SLI_INVERSE_GROUP * SLI_INVERSE_ROW +
       (sl_off)SLI_TILE * SLI_TILE * sli_min(sli_tiles(width), SLI_INVERSE_GROUP) *
         sli_tiles(height);
}

typedef void (*sli_gather_kernel)(const sli_inverse_front *f, const double *from, sl_int height,
                  const sl_int *relative, sl_int t0, sl_int t1);

typedef void (*sli_takahashi_kernel)(const sli_inverse_front *f, double *scratch);

typedef enum sli_inverse_phase {
  SLI_INVERSE_TRIANGLE = 0,
  SLI_INVERSE_WEIGHTS,
  SLI_INVERSE_PRODUCT,
  SLI_INVERSE_MIRROR,
  SLI_INVERSE_SQUARE
} sli_inverse_phase;
#define SLI_INVERSE_PHASES 5

typedef struct sli_tile_range {
  sl_int first, last;
} sli_tile_range;

SLI_INLINE sli_tile_range sli_inverse_tiles(const sli_inverse_front *f, sl_int j0,
                      sli_inverse_phase phase) {
  const sl_int m = sli_inverse_group_columns(f, j0), h = f->width + f->below;
  sli_tile_range range = {0, sli_tiles(m)};
  if (phase != SLI_INVERSE_TRIANGLE && phase != SLI_INVERSE_SQUARE) {
    range.last = j0 + m < h ? sli_tiles(h) : 0;
    range.first = sli_min((j0 + m) / SLI_TILE, range.last);
  }
  return range;
}

typedef void (*sli_inverse_phase_kernel)(const sli_inverse_front *f, sl_int j0,
                     sli_inverse_phase phase, sl_int t0, sl_int t1,
                     double *scratch);

/* src/impl/kernels/table.h: the table of kernels, which every instruction set fills */

typedef void (*sli_products_kernel)(sl_int count, const double *y, const double *z, double *sums);

typedef void (*sli_change_kernel)(double *l, sl_int columns, const double *c, double *w);
typedef void (*sli_change_tiles_kernel)(double *const *tiles, sl_int columns, const double *c,
                    double *w);

typedef struct sli_kernels {
  sl_isa isa;
  sli_sweeps sweeps[2];
  sli_row_kernel row;
  sli_pivots_kernel pivots;
  sli_rows_kernel rows;
  sli_update_kernel update;
  sli_assemble_kernel assemble;
  sli_products_kernel products;
  sli_gather_kernel gather;
  sli_inverse_phase_kernel inverse_phase;
  sli_takahashi_kernel takahashi;
  sli_change_kernel change[SLI_NRHS_KINDS];
  sli_change_tiles_kernel change_tiles;
} sli_kernels;

/* src/impl/kernels/simd.h: the SIMD vocabulary of the kernel templates, and macros that repeat code */

#define SLI_EACH4(op, k) op(0, k) op(1, k) op(2, k) op(3, k)
#define SLI_EACH8(op, k) SLI_EACH4(op, k) op(4, k) op(5, k) op(6, k) op(7, k)
#define SLI_EACH4_AGAIN(op, k) op(0, k) op(1, k) op(2, k) op(3, k)
#define SLI_EACH8_AGAIN(op, k) SLI_EACH4_AGAIN(op, k) op(4, k) op(5, k) op(6, k) op(7, k)
#define SLI_HIGH4(op, k) op(3, k) op(2, k)
#define SLI_HIGH8(op, k) op(7, k) op(6, k) op(5, k) op(4, k)
#define SLI_LOW4(op, k) op(1, k) op(0, k)
#define SLI_LOW8(op, k) op(3, k) op(2, k) op(1, k) op(0, k)

#define SLI_CASE(k, call) \
  case k: \
    call(k); \
    break;
#define SLI_CASES(call) \
  switch (w) { \
    SLI_CASE(1, call) \
    SLI_CASE(2, call) \
    SLI_CASE(3, call) \
    SLI_CASE(4, call) \
    SLI_CASE(5, call) \
    SLI_CASE(6, call) \
    SLI_CASE(7, call) \
  default: \
    call(8); \
  }

#define SLI_EXPAND_PLAIN(mask, lanes, count) \
  const sl_int *lanes_ = (lanes), count_ = (count); \
  (void)(mask);
#define SLI_EXPAND_ADD_PLAIN(to, from) \
  { \
    double *to_ = (to); \
    const double *from_ = (from); \
    sl_int i_; \
    for (i_ = 0; i_ < count_; i_++) { \
      to_[lanes_[i_]] += from_[i_]; \
    } \
  }

#define SLV_SINGLE 0
#define SLI_PASTE(a, b) a##b
#define SLI_BY_TYPE(word, is_single) SLI_PASTE(word, is_single)
#define SLI_VALUE_0 double
#define SLI_VALUE_1 float
#define SLI_SWEEP_0(name, f) name(f)
#define SLI_SWEEP_1(name, f) name(single_##f)
#define SLI_WIDE_0(v, columns) const double *v;
#define SLI_WIDE_1(v, columns) SLI_ALIGNED(double v[SLI_TILE * (columns)]);
#define SLI_WIDEN_0(v, l, columns, rows) v = (l);
#define SLI_WIDEN_1(v, l, columns, rows) \
  { \
    sl_int c_; \
    for (c_ = 0; c_ < (columns); c_++) { \
      SLV_WIDEN_ROWS(v + SLI_TILE * c_, (l) + SLI_TILE * c_, rows) \
    } \
  }
#define SLV_VALUE SLI_BY_TYPE(SLI_VALUE_, SLV_SINGLE)
#define SLV_SWEEP(f) SLI_BY_TYPE(SLI_SWEEP_, SLV_SINGLE)(SLV_NAME, f)
#define SLW_SWEEP(f) SLI_BY_TYPE(SLI_SWEEP_, SLV_SINGLE)(SLW_NAME, f)
#define SLW_SWEEP_HALF(f) SLI_BY_TYPE(SLI_SWEEP_, SLV_SINGLE)(SLW_HALF, f)
#define SLV_READ(l) SLI_BY_TYPE(SLV_READ_, SLV_SINGLE)(l)
#define SLV_PREFETCH(l, column, bytes) \
  if (!SLV_SINGLE || (column) % 2 == 0) { \
    SLI_PREFETCH((l) + SLI_TILE * (column), bytes); \
  }
#define SLV_WIDE(v, columns) SLI_BY_TYPE(SLI_WIDE_, SLV_SINGLE)(v, columns)
#define SLV_WIDEN(v, l, columns, rows) SLI_BY_TYPE(SLI_WIDEN_, SLV_SINGLE)(v, l, columns, rows)

/* src/impl/kernels/simd_scalar.h: the kernels in plain C: a vector is an array */

#define SLI_LOOP(count, statement) \
  { \
    int i_; \
    for (i_ = 0; i_ < (count); i_++) { \
      statement; \
    } \
  }

#define SLV_NAME(f) sli_##f##_scalar
#define SLV_ISA SL_ISA_SCALAR
#define SLV_FUNCTION
#define SLV_FNMA1(a, b, c) ((c) - (a) * (b))
#define SLV_DECLARE(a) double a[SLI_TILE];
#define SLV_ZERO(a) SLI_LOOP(SLI_TILE, a[i_] = 0.0)
#define SLV_LOAD(a, p) memcpy(a, (p), sizeof a);
#define SLV_STORE(p, a) memcpy((p), a, sizeof a);
#define SLV_STORE_ANY(p, a) SLV_STORE(p, a)
#define SLV_WIDEN_ROWS(v, l, rows) SLI_LOOP(rows, (v)[i_] = (l)[i_])
#define SLV_ADD(a, b) SLI_LOOP(SLI_TILE, a[i_] += b[i_])
#define SLV_AXPY(a, l, p) \
  { \
    const double s_ = *(p); \
    SLI_LOOP(SLI_TILE, a[i_] -= (l)[i_] * s_) \
  }
#define SLV_DOT(a, l, v) SLI_LOOP(SLI_TILE, a[i_] -= (l)[i_] * v[i_])
#define SLV_LOAD_PART(a, p, count, rest) \
  { \
    double part_[SLI_TILE]; \
    sl_int i_; \
    for (i_ = 0; i_ < SLI_TILE; i_++) { \
      part_[i_] = i_ < (count) ? (p)[i_] : (rest); \
    } \
    memcpy(a, part_, sizeof part_); \
  }
#define SLV_FIRST(a, count) \
  { \
    double part_[SLI_TILE]; \
    sl_int i_; \
    memcpy(part_, a, sizeof part_); \
    for (i_ = (count); i_ < SLI_TILE; i_++) { \
      part_[i_] = 0.0; \
    } \
    memcpy(a, part_, sizeof part_); \
  }
#define SLV_LANE(b, a, k) SLI_LOOP(SLI_TILE, b[i_] = a[k])
#define SLV_GATHER(a, x, at) SLI_LOOP(SLI_TILE, a[i_] = (x)[at(i_)])
#define SLV_SUM_DECLARE(a) double a;
#define SLV_SUM_ZERO(a) a = 0.0;
#define SLV_SUM_LOAD(a, p) a = *(p);
#define SLV_SUM_STORE(p, a) *(p) = a;
#define SLV_SUM_DOT(a, l, v) \
  a -= ((l)[0] * v[0] + (l)[1] * v[1]) + ((l)[2] * v[2] + (l)[3] * v[3]) + \
     (((l)[4] * v[4] + (l)[5] * v[5]) + ((l)[6] * v[6] + (l)[7] * v[7]));
#define SLV_SUMS(r, a) \
  r[0] = a##0, r[1] = a##1, r[2] = a##2, r[3] = a##3; \
  r[4] = a##4, r[5] = a##5, r[6] = a##6, r[7] = a##7;
#define SLV_TRANSPOSE(to, from) \
  { \
    int i_, k_; \
    for (i_ = 0; i_ < SLI_TILE; i_++) { \
      for (k_ = 0; k_ < SLI_TILE; k_++) { \
        (to)[SLI_TILE * i_ + k_] = (from)[SLI_TILE * k_ + i_]; \
      } \
    } \
  }
#define SLV_TILES 1
#define SLV_COLUMNS 4
#define SLV_EACH_COLUMN SLI_EACH4
#define SLV_LOAD_PINNED(a, p) SLV_LOAD(a, p)
#define SLV_FNMA(a, b, c) SLI_LOOP(SLI_TILE, a[i_] -= b[i_] * c[i_])
#define SLV_BROADCAST(b, p) SLI_LOOP(SLI_TILE, b[i_] = *(p))
#define SLV_MULTIPLY(a, b, c) SLI_LOOP(SLI_TILE, a[i_] = b[i_] * c[i_])
#define SLV_DIVIDE(a, b, c) SLI_LOOP(SLI_TILE, a[i_] = b[i_] / c[i_])
#define SLV_BELOW(a, k) SLI_LOOP(SLI_TILE, a[i_] = i_ > (k) ? a[i_] : 0.0)
#define SLV_EXPAND SLI_EXPAND_PLAIN
#define SLV_EXPAND_ADD SLI_EXPAND_ADD_PLAIN
#define SLW_ROWS 4
#define SLW_DECLARE(a) double a[SLW_NRHS];
#define SLW_ZERO(a) memset(a, 0, sizeof a);
#define SLW_LOAD(a, p) memcpy(a, (p), sizeof a);
#define SLW_STORE(p, a) memcpy((p), a, sizeof a);
#define SLW_FNMA(a, s, b) \
  { \
    const double s_ = (s); \
    SLI_LOOP(SLW_NRHS, a[i_] -= s_ * b[i_]) \
  }
#define SLW_ADD(a, b) SLI_LOOP(SLW_NRHS, a[i_] += b[i_])
#define SLW_DIVIDE(a, s) SLI_LOOP(SLW_NRHS, a[i_] /= (s))

#define SLW_NAME(f) sli_##f##2_scalar
#define SLW_NRHS 2
/* The header includes itself from here on: its templates, at the end, are compiled once for
 * each instruction set. SL_HEADER is the name of this file. */
#if defined(__has_include)
#if !__has_include(SL_HEADER)
#error "sparse_local.h was renamed: define SL_HEADER as its new name, in quotes"
#endif
#endif
#define SLI_SECTION_MULTI_RHS
#include SL_HEADER /* not found: define SL_HEADER, see above */
#ifdef SLI_SECTION_MULTI_RHS
#error "sparse_local.h: SL_HEADER names another file, not this one"
#endif
#define SLI_SECTION_MULTI_RHS
#include SL_HEADER

#define SLW_NAME(f) sli_##f##4_scalar
#define SLW_NRHS 4
#define SLI_SECTION_MULTI_RHS
#include SL_HEADER
#define SLI_SECTION_MULTI_RHS
#include SL_HEADER

#define SLW_NAME(f) sli_##f##8_scalar
#define SLW_NRHS 8
#define SLI_SECTION_MULTI_RHS
#include SL_HEADER
#define SLI_SECTION_MULTI_RHS
#include SL_HEADER
#define SLI_SECTION_SWEEPS
#include SL_HEADER
#define SLI_SECTION_SWEEPS
#include SL_HEADER
#define SLI_SECTION_KERNEL_SET
#include SL_HEADER
#undef SLI_LOOP

/* src/impl/kernels/simd_avx2.h: the kernels in AVX2 and FMA: a vector of 8 doubles is two registers */

#if defined(SLI_X86)

#define SLV_NAME(f) sli_##f##_avx2
#define SLV_ISA SL_ISA_AVX2
#define SLV_FUNCTION SLI_TARGET("avx2,fma")
#define SLV_FNMA1(a, b, c) SLI_FNMA1(a, b, c)

SLV_FUNCTION SLI_INLINE __m256d sli_lanes_from(int k) {
  return _mm256_castsi256_pd(
    _mm256_cmpgt_epi64(_mm256_set_epi64x(3, 2, 1, 0), _mm256_set1_epi64x(k - 1)));
}

SLV_FUNCTION SLI_INLINE __m256d sli_load_part(const double *p, int count, double rest) {
  const __m256d others = sli_lanes_from(count);
  return _mm256_blendv_pd(
    _mm256_maskload_pd(p, _mm256_castpd_si256(_mm256_xor_pd(
                  others, _mm256_castsi256_pd(_mm256_set1_epi64x(-1))))),
    _mm256_set1_pd(rest), others);
}

SLI_INLINE int sli_count4(unsigned mask) {
  return (int)((mask & 1u) + (mask >> 1 & 1u) + (mask >> 2 & 1u) + (mask >> 3));
}

SLV_FUNCTION SLI_INLINE __m256i sli_expand_index(unsigned mask) {
  int at[8], k, from = 0;
  for (k = 0; k < 4; k++) {
    const int is_set = (mask >> k & 1u) != 0;
    at[2 * k] = is_set ? 2 * from : -1;
    at[2 * k + 1] = is_set ? 2 * from + 1 : -1;
    from += is_set;
  }
  return _mm256_loadu_si256((const __m256i *)(const void *)at);
}

SLV_FUNCTION SLI_INLINE __m256d sli_expand_keep(__m256i index) {
  return _mm256_castsi256_pd(_mm256_cmpgt_epi32(index, _mm256_set1_epi32(-1)));
}

SLV_FUNCTION SLI_INLINE __m256d sli_expand_4(__m256d a, __m256i index, __m256d keep) {
  return _mm256_and_pd(_mm256_castps_pd(_mm256_permutevar8x32_ps(_mm256_castpd_ps(a), index)),
             keep);
}

#define SLV_DECLARE(a) __m256d a##_0, a##_1;
#define SLV_ZERO(a) a##_0 = a##_1 = _mm256_setzero_pd();
#define SLV_LOAD(a, p) a##_0 = _mm256_load_pd(p), a##_1 = _mm256_load_pd((p) + 4);
#define SLV_STORE(p, a) _mm256_store_pd((p), a##_0), _mm256_store_pd((p) + 4, a##_1);
#define SLV_ADD(a, b) a##_0 = _mm256_add_pd(a##_0, b##_0), a##_1 = _mm256_add_pd(a##_1, b##_1);
#define SLV_READ_0(l) _mm256_load_pd(l)
#define SLV_READ_1(l) _mm256_cvtps_pd(_mm_load_ps(l))
#define SLV_WIDEN_ROWS(v, l, rows) \
  { \
    _mm256_store_pd((v), _mm256_cvtps_pd(_mm_load_ps(l))); \
    if ((rows) > 4) { \
      _mm256_store_pd((v) + 4, _mm256_cvtps_pd(_mm_load_ps((l) + 4))); \
    } \
  }
#define SLV_AXPY(a, l, p) \
  { \
    const __m256d s_ = _mm256_broadcast_sd(p); \
    a##_0 = _mm256_fnmadd_pd(SLV_READ(l), s_, a##_0); \
    a##_1 = _mm256_fnmadd_pd(SLV_READ((l) + 4), s_, a##_1); \
  }
#define SLV_DOT(a, l, v) \
  a##_0 = _mm256_fnmadd_pd(SLV_READ(l), v##_0, a##_0), \
  a##_1 = _mm256_fnmadd_pd(SLV_READ((l) + 4), v##_1, a##_1);
#define SLV_STORE_ANY(p, a) _mm256_storeu_pd((p), a##_0), _mm256_storeu_pd((p) + 4, a##_1);
#define SLV_FNMA(a, b, c) \
  a##_0 = _mm256_fnmadd_pd(b##_0, c##_0, a##_0), a##_1 = _mm256_fnmadd_pd(b##_1, c##_1, a##_1);
#define SLV_LOAD_PART(a, p, count, rest) \
  a##_0 = sli_load_part((p), (count), (rest)), a##_1 = sli_load_part((p) + 4, (count)-4, (rest));
#define SLV_FIRST(a, count) \
  a##_0 = _mm256_andnot_pd(sli_lanes_from(count), a##_0), \
  a##_1 = _mm256_andnot_pd(sli_lanes_from((count)-4), a##_1);
#define SLV_LANE(b, a, k) \
  b##_0 = b##_1 = _mm256_permute4x64_pd((k) < 4 ? a##_0 : a##_1, (k) % 4 * 0x55);
#define SLV_GATHER(a, x, at) \
  a##_0 = _mm256_set_pd((x)[at(3)], (x)[at(2)], (x)[at(1)], (x)[at(0)]), \
  a##_1 = _mm256_set_pd((x)[at(7)], (x)[at(6)], (x)[at(5)], (x)[at(4)]);
#define SLV_SUM_DECLARE(a) __m256d a;
#define SLV_SUM_ZERO(a) a = _mm256_setzero_pd();
#define SLV_SUM_LOAD(a, p) a = _mm256_load_pd(p);
#define SLV_SUM_STORE(p, a) _mm256_store_pd((p), a);
#define SLV_SUM_DOT(a, l, v) \
  a = _mm256_fnmadd_pd(SLV_READ(l), v##_0, a); \
  a = _mm256_fnmadd_pd(SLV_READ((l) + 4), v##_1, a);
#define SLV_SUM_4(a, b, c, d) \
  _mm256_add_pd(_mm256_permute2f128_pd(_mm256_hadd_pd(a, b), _mm256_hadd_pd(c, d), 0x20), \
          _mm256_permute2f128_pd(_mm256_hadd_pd(a, b), _mm256_hadd_pd(c, d), 0x31))
#define SLV_SUMS(r, a) \
  r##_0 = SLV_SUM_4(a##0, a##1, a##2, a##3), r##_1 = SLV_SUM_4(a##4, a##5, a##6, a##7);
#define SLV_TRANSPOSE_4(to, from) \
  { \
    const __m256d a_ = _mm256_load_pd(from), b_ = _mm256_load_pd((from) + 8); \
    const __m256d c_ = _mm256_load_pd((from) + 16), d_ = _mm256_load_pd((from) + 24); \
    const __m256d e_ = _mm256_unpacklo_pd(a_, b_), f_ = _mm256_unpackhi_pd(a_, b_); \
    const __m256d g_ = _mm256_unpacklo_pd(c_, d_), h_ = _mm256_unpackhi_pd(c_, d_); \
    _mm256_store_pd((to), _mm256_permute2f128_pd(e_, g_, 0x20)); \
    _mm256_store_pd((to) + 8, _mm256_permute2f128_pd(f_, h_, 0x20)); \
    _mm256_store_pd((to) + 16, _mm256_permute2f128_pd(e_, g_, 0x31)); \
    _mm256_store_pd((to) + 24, _mm256_permute2f128_pd(f_, h_, 0x31)); \
  }
#define SLV_TRANSPOSE(to, from) \
  SLV_TRANSPOSE_4(to, from) \
  SLV_TRANSPOSE_4((to) + 4, (from) + 32) \
  SLV_TRANSPOSE_4((to) + 32, (from) + 4) \
  SLV_TRANSPOSE_4((to) + 36, (from) + 36)
#define SLV_TILES 1
#define SLV_COLUMNS 4
#define SLV_EACH_COLUMN SLI_EACH4
#define SLV_LOAD_PINNED(a, p) \
  a##_0 = _mm256_load_pd(p); \
  a##_1 = _mm256_load_pd((p) + 4); \
  SLI_PIN(a##_0);  \
  SLI_PIN(a##_1);
#define SLV_BROADCAST(b, p) b##_0 = b##_1 = _mm256_broadcast_sd(p);
#define SLV_MULTIPLY(a, b, c) \
  a##_0 = _mm256_mul_pd(b##_0, c##_0), a##_1 = _mm256_mul_pd(b##_1, c##_1);
#define SLV_DIVIDE(a, b, c) \
  a##_0 = _mm256_div_pd(b##_0, c##_0), a##_1 = _mm256_div_pd(b##_1, c##_1);
#define SLV_BELOW(a, k) \
  a##_0 = _mm256_and_pd(a##_0, sli_lanes_from((k) + 1)), \
  a##_1 = _mm256_and_pd(a##_1, sli_lanes_from((k)-3));
#define SLV_EXPAND(mask, lanes, count) \
  const __m256i low_ = sli_expand_index((mask)&15u), high_ = sli_expand_index((mask) >> 4); \
  const __m256d keep_low_ = sli_expand_keep(low_), keep_high_ = sli_expand_keep(high_); \
  const ptrdiff_t second_ = sli_count4((mask)&15u); \
  (void)(lanes);
#define SLV_EXPAND_ADD(to, from) \
  _mm256_store_pd((to), _mm256_add_pd(_mm256_load_pd(to), \
                    sli_expand_4(_mm256_loadu_pd(from), low_, keep_low_))); \
  _mm256_store_pd((to) + 4, _mm256_add_pd(_mm256_load_pd((to) + 4), \
                      sli_expand_4(_mm256_loadu_pd((from) + second_), high_, \
                             keep_high_)));
#define SLV_DUP_AT(e, l) \
  { \
    const __m256d l_ = SLV_READ(l); \
    e##_0 = _mm256_permute4x64_pd(l_, 0x50); \
    e##_1 = _mm256_permute4x64_pd(l_, 0xfa); \
  }
#define SLV_DUP_LOW(e, l) SLV_DUP_AT(e, l)
#define SLV_DUP_HIGH(e, l) SLV_DUP_AT(e, (l) + 4)
#define SLV_PAIR(b, p) b##_0 = b##_1 = _mm256_broadcast_pd((const __m128d *)(const void *)(p));

#define SLW_NAME(f) sli_##f##4_avx2
#define SLW_NRHS 4
#define SLW_ROWS 8
#define SLW_DECLARE(a) __m256d a;
#define SLW_ZERO(a) a = _mm256_setzero_pd();
#define SLW_LOAD(a, p) a = _mm256_loadu_pd(p);
#define SLW_STORE(p, a) _mm256_storeu_pd((p), a);
#define SLW_FNMA(a, s, b) a = _mm256_fnmadd_pd(_mm256_broadcast_sd(&(s)), b, a);
#define SLW_ADD(a, b) a = _mm256_add_pd(a, b);
#define SLW_DIVIDE(a, s) a = _mm256_div_pd(a, _mm256_set1_pd(s));
#define SLI_SECTION_MULTI_RHS
#include SL_HEADER
#define SLI_SECTION_MULTI_RHS
#include SL_HEADER
#undef SLW_ROWS
#undef SLW_DECLARE
#undef SLW_ZERO
#undef SLW_LOAD
#undef SLW_STORE
#undef SLW_FNMA
#undef SLW_ADD
#undef SLW_DIVIDE

#define SLW_NAME(f) sli_##f##8_avx2
#define SLW_HALF(f) sli_##f##4_avx2
#define SLW_NRHS 8
#define SLW_ROWS 4
#define SLW_DECLARE(a) __m256d a##_0, a##_1;
#define SLW_ZERO(a) a##_0 = a##_1 = _mm256_setzero_pd();
#define SLW_LOAD(a, p) a##_0 = _mm256_loadu_pd(p), a##_1 = _mm256_loadu_pd((p) + 4);
#define SLW_STORE(p, a) _mm256_storeu_pd((p), a##_0), _mm256_storeu_pd((p) + 4, a##_1);
#define SLW_FNMA(a, s, b) \
  { \
    const __m256d s_ = _mm256_broadcast_sd(&(s)); \
    a##_0 = _mm256_fnmadd_pd(s_, b##_0, a##_0); \
    a##_1 = _mm256_fnmadd_pd(s_, b##_1, a##_1); \
  }
#define SLW_ADD(a, b) a##_0 = _mm256_add_pd(a##_0, b##_0), a##_1 = _mm256_add_pd(a##_1, b##_1);
#define SLW_DIVIDE(a, s) \
  a##_0 = _mm256_div_pd(a##_0, _mm256_set1_pd(s)), \
  a##_1 = _mm256_div_pd(a##_1, _mm256_set1_pd(s));
#define SLI_SECTION_MULTI_RHS
#include SL_HEADER
#define SLI_SECTION_MULTI_RHS
#include SL_HEADER
#define SLI_SECTION_SWEEPS
#include SL_HEADER
#define SLI_SECTION_SWEEPS
#include SL_HEADER
#define SLI_SECTION_KERNEL_SET
#include SL_HEADER

#endif

/* src/impl/kernels/simd_avx512.h: the kernels in AVX-512F: a vector of 8 doubles is one register */

#if defined(SLI_X86) && !defined(SL_NO_AVX512)
#define SLI_AVX512 1

#define SLV_NAME(f) sli_##f##_avx512
#define SLV_NAME_4(f) sli_##f##4_avx2
#define SLV_ISA SL_ISA_AVX512
#define SLV_FUNCTION SLI_TARGET("avx512f,avx2,fma")
#define SLV_FNMA1(a, b, c) SLI_FNMA1(a, b, c)
#define SLV_DECLARE(a) __m512d a;
#define SLV_ZERO(a) a = _mm512_setzero_pd();
#define SLV_LOAD(a, p) a = _mm512_load_pd(p);
#define SLV_STORE(p, a) _mm512_store_pd((p), a);
#define SLV_ADD(a, b) a = _mm512_add_pd(a, b);
#define SLV_READ_0(l) _mm512_load_pd(l)
#define SLV_READ_1(l) _mm512_maskz_cvtps_pd(0xff, _mm256_load_ps(l))
#define SLV_WIDEN_ROWS(v, l, rows) _mm512_store_pd((v), SLV_READ_1(l));
#define SLV_AXPY(a, l, p) a = _mm512_fnmadd_pd(SLV_READ(l), _mm512_set1_pd(*(p)), a);
#define SLV_DOT(a, l, v) a = _mm512_fnmadd_pd(SLV_READ(l), v, a);
#define SLV_STORE_ANY(p, a) _mm512_storeu_pd((p), a);
#define SLV_FNMA(a, b, c) a = _mm512_fnmadd_pd(b, c, a);
#define SLV_LOAD_PART(a, p, count, rest) \
  a = _mm512_mask_loadu_pd(_mm512_set1_pd(rest), (__mmask8)(0xff >> (8 - (count))), (p));
#define SLV_FIRST(a, count) a = _mm512_maskz_mov_pd((__mmask8)(0xff >> (8 - (count))), a);
#define SLV_LANE(b, a, k) b = _mm512_maskz_permutexvar_pd(0xff, _mm512_set1_epi64(k), a);
#define SLV_GATHER(a, x, at) \
  a = _mm512_set_pd((x)[at(7)], (x)[at(6)], (x)[at(5)], (x)[at(4)], (x)[at(3)], (x)[at(2)], \
            (x)[at(1)], (x)[at(0)]);
#define SLV_SUM_DECLARE(a) SLV_DECLARE(a)
#define SLV_SUM_ZERO(a) SLV_ZERO(a)
#define SLV_SUM_LOAD(a, p) SLV_LOAD(a, p)
#define SLV_SUM_STORE(p, a) SLV_STORE(p, a)
#define SLV_SUM_DOT(a, l, v) SLV_DOT(a, l, v)
#define SLV_SUM_2(a, b) \
  _mm512_add_pd(_mm512_maskz_unpacklo_pd(0xff, a, b), _mm512_maskz_unpackhi_pd(0xff, a, b))
#define SLV_SUM_4(a, b) \
  _mm512_add_pd(_mm512_maskz_shuffle_f64x2(0xff, a, b, 0x88), \
          _mm512_maskz_shuffle_f64x2(0xff, a, b, 0xdd))
#define SLV_SUMS(r, a) \
  r = SLV_SUM_4(SLV_SUM_4(SLV_SUM_2(a##0, a##1), SLV_SUM_2(a##2, a##3)), \
          SLV_SUM_4(SLV_SUM_2(a##4, a##5), SLV_SUM_2(a##6, a##7)));
#define SLV_BLOCKS_EVEN(a, b) _mm512_maskz_shuffle_f64x2(0xff, a, b, 0x88)
#define SLV_BLOCKS_ODD(a, b) _mm512_maskz_shuffle_f64x2(0xff, a, b, 0xdd)
#define SLV_TRANSPOSE_4(to, from, unpack) \
  { \
    const __m512d a_ = unpack(0xff, _mm512_load_pd(from), _mm512_load_pd((from) + 8)); \
    const __m512d b_ = unpack(0xff, _mm512_load_pd((from) + 16), _mm512_load_pd((from) + 24)); \
    const __m512d c_ = unpack(0xff, _mm512_load_pd((from) + 32), _mm512_load_pd((from) + 40)); \
    const __m512d d_ = unpack(0xff, _mm512_load_pd((from) + 48), _mm512_load_pd((from) + 56)); \
    const __m512d e_ = SLV_BLOCKS_EVEN(a_, b_), f_ = SLV_BLOCKS_EVEN(c_, d_); \
    const __m512d g_ = SLV_BLOCKS_ODD(a_, b_), h_ = SLV_BLOCKS_ODD(c_, d_); \
    _mm512_store_pd((to), SLV_BLOCKS_EVEN(e_, f_)); \
    _mm512_store_pd((to) + 16, SLV_BLOCKS_EVEN(g_, h_)); \
    _mm512_store_pd((to) + 32, SLV_BLOCKS_ODD(e_, f_)); \
    _mm512_store_pd((to) + 48, SLV_BLOCKS_ODD(g_, h_)); \
  }
#define SLV_TRANSPOSE(to, from) \
  SLV_TRANSPOSE_4(to, from, _mm512_maskz_unpacklo_pd) \
  SLV_TRANSPOSE_4((to) + 8, from, _mm512_maskz_unpackhi_pd)
#define SLV_TILES 2
#define SLV_COLUMNS 8
#define SLV_EACH_COLUMN SLI_EACH8
#define SLV_LOAD_PINNED(a, p) \
  a = _mm512_load_pd(p); \
  SLI_PIN_ANY(a);
#define SLV_BROADCAST(b, p) b = _mm512_set1_pd(*(p));
#define SLV_MULTIPLY(a, b, c) a = _mm512_mul_pd(b, c);
#define SLV_DIVIDE(a, b, c) a = _mm512_div_pd(b, c);
#define SLV_BELOW(a, k) a = _mm512_maskz_mov_pd((__mmask8)(0xfe << (k)), a);
#define SLV_EXPAND(mask, lanes, count) \
  const __mmask8 expand_ = (__mmask8)(mask); \
  const __m512i order_ = \
    _mm512_maskz_expand_epi64(expand_, _mm512_set_epi64(7, 6, 5, 4, 3, 2, 1, 0)); \
  (void)(lanes);
#define SLV_EXPAND_ADD(to, from) \
  _mm512_store_pd( \
    (to), _mm512_add_pd(_mm512_load_pd(to), \
              _mm512_maskz_permutexvar_pd(expand_, order_, _mm512_loadu_pd(from))));
#define SLV_DUP_LOW(e, l) \
  e = _mm512_maskz_permutexvar_pd(0xff, _mm512_set_epi64(3, 3, 2, 2, 1, 1, 0, 0), SLV_READ(l));
#define SLV_DUP_HIGH(e, l) \
  e = _mm512_maskz_permutexvar_pd(0xff, _mm512_set_epi64(7, 7, 6, 6, 5, 5, 4, 4), SLV_READ(l));
#define SLV_PAIR(b, p) \
  b = _mm512_castps_pd(_mm512_maskz_broadcast_f32x4(0xffff, _mm_castpd_ps(_mm_loadu_pd(p))));

#define SLW_NAME(f) sli_##f##8_avx512
#define SLW_NRHS 8
#define SLW_ROWS 8
#define SLW_DECLARE(a) __m512d a;
#define SLW_ZERO(a) a = _mm512_setzero_pd();
#define SLW_LOAD(a, p) a = _mm512_loadu_pd(p);
#define SLW_STORE(p, a) _mm512_storeu_pd((p), a);
#define SLW_FNMA(a, s, b) a = _mm512_fnmadd_pd(_mm512_set1_pd(s), b, a);
#define SLW_ADD(a, b) a = _mm512_add_pd(a, b);
#define SLW_DIVIDE(a, s) a = _mm512_div_pd(a, _mm512_set1_pd(s));
#define SLI_SECTION_MULTI_RHS
#include SL_HEADER
#define SLI_SECTION_MULTI_RHS
#include SL_HEADER
#define SLI_SECTION_SWEEPS
#include SL_HEADER
#define SLI_SECTION_SWEEPS
#include SL_HEADER
#define SLI_SECTION_KERNEL_SET
#include SL_HEADER

#endif

/* src/impl/kernels/simd_neon.h: the kernels in NEON: a vector of 8 doubles is four registers */

#if defined(SLI_ARM)

#define SLV_NAME(f) sli_##f##_neon
#define SLV_ISA SL_ISA_NEON
#define SLV_FUNCTION
#define SLV_FNMA1(a, b, c) SLI_FNMA1(a, b, c)
#define SLV_DECLARE(a) float64x2_t a##_0, a##_1, a##_2, a##_3;
#define SLV_ZERO(a) a##_0 = a##_1 = a##_2 = a##_3 = vdupq_n_f64(0.0);
#define SLV_LOAD(a, p) \
  a##_0 = vld1q_f64((p) + 0), a##_1 = vld1q_f64((p) + 2), a##_2 = vld1q_f64((p) + 4), \
  a##_3 = vld1q_f64((p) + 6);
#define SLV_STORE(p, a) \
  vst1q_f64((p) + 0, a##_0), vst1q_f64((p) + 2, a##_1), vst1q_f64((p) + 4, a##_2), \
    vst1q_f64((p) + 6, a##_3);
#define SLV_ADD(a, b) \
  a##_0 = vaddq_f64(a##_0, b##_0), a##_1 = vaddq_f64(a##_1, b##_1), \
  a##_2 = vaddq_f64(a##_2, b##_2), a##_3 = vaddq_f64(a##_3, b##_3);
#define SLV_READ_0(l) vld1q_f64(l)
#define SLV_READ_1(l) vcvt_f64_f32(vld1_f32(l))
#define SLV_WIDEN_ROWS(v, l, rows) \
  { \
    int i_; \
    for (i_ = 0; i_ < (rows); i_ += 2) { \
      vst1q_f64((v) + i_, vcvt_f64_f32(vld1_f32((l) + i_))); \
    } \
  }
#define SLV_AXPY(a, l, p) \
  { \
    const float64x2_t s_ = vld1q_dup_f64(p); \
    a##_0 = vfmsq_f64(a##_0, SLV_READ((l) + 0), s_); \
    a##_1 = vfmsq_f64(a##_1, SLV_READ((l) + 2), s_); \
    a##_2 = vfmsq_f64(a##_2, SLV_READ((l) + 4), s_); \
    a##_3 = vfmsq_f64(a##_3, SLV_READ((l) + 6), s_); \
  }
#define SLV_DOT(a, l, v) \
  a##_0 = vfmsq_f64(a##_0, SLV_READ((l) + 0), v##_0), \
  a##_1 = vfmsq_f64(a##_1, SLV_READ((l) + 2), v##_1), \
  a##_2 = vfmsq_f64(a##_2, SLV_READ((l) + 4), v##_2), \
  a##_3 = vfmsq_f64(a##_3, SLV_READ((l) + 6), v##_3);
#define SLV_STORE_ANY(p, a) SLV_STORE(p, a)
#define SLV_FNMA(a, b, c) \
  a##_0 = vfmsq_f64(a##_0, b##_0, c##_0), a##_1 = vfmsq_f64(a##_1, b##_1, c##_1), \
  a##_2 = vfmsq_f64(a##_2, b##_2, c##_2), a##_3 = vfmsq_f64(a##_3, b##_3, c##_3);
#define SLV_LOAD_PART(a, p, count, rest) \
  { \
    double part_[SLI_TILE]; \
    sl_int i_; \
    for (i_ = 0; i_ < SLI_TILE; i_++) { \
      part_[i_] = i_ < (count) ? (p)[i_] : (rest); \
    } \
    SLV_LOAD(a, part_) \
  }
#define SLV_FIRST(a, count) \
  { \
    double part_[SLI_TILE]; \
    sl_int i_; \
    SLV_STORE(part_, a) \
    for (i_ = (count); i_ < SLI_TILE; i_++) { \
      part_[i_] = 0.0; \
    } \
    SLV_LOAD(a, part_) \
  }
#define SLV_LANE(b, a, k) \
  b##_0 = b##_1 = b##_2 = b##_3 = vdupq_n_f64(vgetq_lane_f64((k) < 2   ? a##_0 \
                                 : (k) < 4 ? a##_1 \
                                 : (k) < 6 ? a##_2 \
                                     : a##_3, \
                                 (k) % 2));
#define SLV_GATHER_2(x, i, j) vcombine_f64(vld1_f64((x) + (i)), vld1_f64((x) + (j)))
#define SLV_GATHER(a, x, at) \
  a##_0 = SLV_GATHER_2(x, at(0), at(1)), a##_1 = SLV_GATHER_2(x, at(2), at(3)), \
  a##_2 = SLV_GATHER_2(x, at(4), at(5)), a##_3 = SLV_GATHER_2(x, at(6), at(7));
#define SLV_SUM_DECLARE(a) float64x2_t a;
#define SLV_SUM_ZERO(a) a = vdupq_n_f64(0.0);
#define SLV_SUM_LOAD(a, p) a = vld1q_f64(p);
#define SLV_SUM_STORE(p, a) vst1q_f64((p), a);
#define SLV_SUM_DOT(a, l, v) \
  a = vfmsq_f64(a, SLV_READ((l) + 0), v##_0); \
  a = vfmsq_f64(a, SLV_READ((l) + 2), v##_1); \
  a = vfmsq_f64(a, SLV_READ((l) + 4), v##_2); \
  a = vfmsq_f64(a, SLV_READ((l) + 6), v##_3);
#define SLV_SUMS(r, a) \
  r##_0 = vpaddq_f64(a##0, a##1), r##_1 = vpaddq_f64(a##2, a##3), \
  r##_2 = vpaddq_f64(a##4, a##5), r##_3 = vpaddq_f64(a##6, a##7);
#define SLV_TRANSPOSE(to, from) \
  { \
    int i_, k_; \
    for (i_ = 0; i_ < SLI_TILE; i_ += 2) { \
      for (k_ = 0; k_ < SLI_TILE; k_ += 2) { \
        const float64x2_t low_ = vld1q_f64((from) + SLI_TILE * k_ + i_); \
        const float64x2_t high_ = vld1q_f64((from) + SLI_TILE * (k_ + 1) + i_); \
        vst1q_f64((to) + SLI_TILE * i_ + k_, vtrn1q_f64(low_, high_)); \
        vst1q_f64((to) + SLI_TILE * (i_ + 1) + k_, vtrn2q_f64(low_, high_)); \
      } \
    } \
  }
#define SLV_TILES 1
#define SLV_COLUMNS 4
#define SLV_EACH_COLUMN SLI_EACH4
#define SLV_LOAD_PINNED(a, p) SLV_LOAD(a, p)
#define SLV_BROADCAST(b, p) b##_0 = b##_1 = b##_2 = b##_3 = vld1q_dup_f64(p);
#define SLV_MULTIPLY(a, b, c) \
  a##_0 = vmulq_f64(b##_0, c##_0), a##_1 = vmulq_f64(b##_1, c##_1), \
  a##_2 = vmulq_f64(b##_2, c##_2), a##_3 = vmulq_f64(b##_3, c##_3);
#define SLV_DIVIDE(a, b, c) \
  a##_0 = vdivq_f64(b##_0, c##_0), a##_1 = vdivq_f64(b##_1, c##_1), \
  a##_2 = vdivq_f64(b##_2, c##_2), a##_3 = vdivq_f64(b##_3, c##_3);
#define SLV_BELOW_2(a, k) \
  a = vreinterpretq_f64_u64(vandq_u64(vreinterpretq_u64_f64(a), \
                    vcombine_u64(vcreate_u64((k) < 0 ? ~(uint64_t)0 : 0), \
                           vcreate_u64((k) < 1 ? ~(uint64_t)0 : 0))));
#define SLV_BELOW(a, k) \
  SLV_BELOW_2(a##_0, k) \
  SLV_BELOW_2(a##_1, (k)-2) SLV_BELOW_2(a##_2, (k)-4) SLV_BELOW_2(a##_3, (k)-6)
#define SLV_EXPAND SLI_EXPAND_PLAIN
#define SLV_EXPAND_ADD SLI_EXPAND_ADD_PLAIN
#define SLV_DUP_LOW(e, l) \
  e##_0 = vdupq_n_f64((l)[0]), e##_1 = vdupq_n_f64((l)[1]), e##_2 = vdupq_n_f64((l)[2]), \
  e##_3 = vdupq_n_f64((l)[3]);
#define SLV_DUP_HIGH(e, l) SLV_DUP_LOW(e, (l) + 4)
#define SLV_PAIR(b, p) b##_0 = b##_1 = b##_2 = b##_3 = vld1q_f64(p);

#define SLW_NAME(f) sli_##f##4_neon
#define SLW_NRHS 4
#define SLW_ROWS 8
#define SLW_DECLARE(a) float64x2_t a##_0, a##_1;
#define SLW_ZERO(a) a##_0 = a##_1 = vdupq_n_f64(0.0);
#define SLW_LOAD(a, p) a##_0 = vld1q_f64((p) + 0), a##_1 = vld1q_f64((p) + 2);
#define SLW_STORE(p, a) vst1q_f64((p) + 0, a##_0), vst1q_f64((p) + 2, a##_1);
#define SLW_FNMA(a, s, b) \
  { \
    const float64x2_t s_ = vdupq_n_f64(s); \
    a##_0 = vfmsq_f64(a##_0, s_, b##_0); \
    a##_1 = vfmsq_f64(a##_1, s_, b##_1); \
  }
#define SLW_ADD(a, b) a##_0 = vaddq_f64(a##_0, b##_0), a##_1 = vaddq_f64(a##_1, b##_1);
#define SLW_DIVIDE(a, s) \
  { \
    const float64x2_t s_ = vdupq_n_f64(s); \
    a##_0 = vdivq_f64(a##_0, s_); \
    a##_1 = vdivq_f64(a##_1, s_); \
  }
#define SLI_SECTION_MULTI_RHS
#include SL_HEADER
#define SLI_SECTION_MULTI_RHS
#include SL_HEADER
#undef SLW_ROWS
#undef SLW_DECLARE
#undef SLW_ZERO
#undef SLW_LOAD
#undef SLW_STORE
#undef SLW_FNMA
#undef SLW_ADD
#undef SLW_DIVIDE

#define SLW_NAME(f) sli_##f##8_neon
#define SLW_HALF(f) sli_##f##4_neon
#define SLW_NRHS 8
#define SLW_ROWS 4
#define SLW_DECLARE(a) SLV_DECLARE(a)
#define SLW_ZERO(a) SLV_ZERO(a)
#define SLW_LOAD(a, p) SLV_LOAD(a, p)
#define SLW_STORE(p, a) SLV_STORE(p, a)
#define SLW_FNMA(a, s, b) \
  { \
    const float64x2_t s_ = vdupq_n_f64(s); \
    a##_0 = vfmsq_f64(a##_0, s_, b##_0); \
    a##_1 = vfmsq_f64(a##_1, s_, b##_1); \
    a##_2 = vfmsq_f64(a##_2, s_, b##_2); \
    a##_3 = vfmsq_f64(a##_3, s_, b##_3); \
  }
#define SLW_ADD(a, b) SLV_ADD(a, b)
#define SLW_DIVIDE(a, s) \
  { \
    const float64x2_t s_ = vdupq_n_f64(s); \
    a##_0 = vdivq_f64(a##_0, s_); \
    a##_1 = vdivq_f64(a##_1, s_); \
    a##_2 = vdivq_f64(a##_2, s_); \
    a##_3 = vdivq_f64(a##_3, s_); \
  }
#define SLI_SECTION_MULTI_RHS
#include SL_HEADER
#define SLI_SECTION_MULTI_RHS
#include SL_HEADER
#define SLI_SECTION_SWEEPS
#include SL_HEADER
#define SLI_SECTION_SWEEPS
#include SL_HEADER
#define SLI_SECTION_KERNEL_SET
#include SL_HEADER

#endif

/* src/impl/kernels/dispatch.h: detects the instruction sets of this processor and selects a kernel table */

#if defined(SLI_X86)
SLI_INLINE void sli_cpuid(unsigned leaf, unsigned *r) {
#if defined(SLI_GNU)
  __asm__ volatile("cpuid" : "=a"(r[0]), "=b"(r[1]), "=c"(r[2]), "=d"(r[3]) : "a"(leaf), "c"(0));
#else
  __cpuidex((int *)r, (int)leaf, 0);
#endif
}

SLI_INLINE unsigned sli_xcr0(void) {
#if defined(SLI_GNU)
  unsigned low, high;
  __asm__ volatile("xgetbv" : "=a"(low), "=d"(high) : "c"(0));
  return low;
#else
  return (unsigned)_xgetbv(0);
#endif
}
#endif

#if defined(SLI_X86)
#define SLI_OSXSAVE (1u << 27)

SLI_INLINE sl_isa sli_isa_of(unsigned leaves, unsigned ecx1, unsigned ebx7, unsigned xcr0) {
  const unsigned avx_fma = 1u << 28 | 1u << 12;
  if (leaves < 7 || (ecx1 & avx_fma) != avx_fma || (xcr0 & 0x6u) != 0x6u || !(ebx7 & 1u << 5)) {
    return SL_ISA_SCALAR;
  }
#if defined(SLI_AVX512)
  if ((xcr0 & 0xe0u) == 0xe0u && (ebx7 & 1u << 16)) {
    return SL_ISA_AVX512;
  }
#endif
  return SL_ISA_AVX2;
}
#endif

static sl_isa sli_cpu_best(void) {
#if defined(SLI_X86)
  unsigned first[4], one[4], seven[4], xcr0;
  sli_cpuid(0, first);
  sli_cpuid(1, one);
  sli_cpuid(7, seven);
  xcr0 = one[2] & SLI_OSXSAVE ? sli_xcr0() : 0; /* untested: every processor here has it */
  return sli_isa_of(first[0], one[2], seven[1], xcr0);
#elif defined(SLI_ARM)
  return SL_ISA_NEON;
#else
  return SL_ISA_SCALAR;
#endif
}

static const sli_kernels *sli_kernels_select(sl_isa isa) {
  const sl_isa best = isa == SL_ISA_SCALAR ? SL_ISA_SCALAR : sli_cpu_best();
  if (isa == SL_ISA_AUTO) {
    isa = best;
  }
  if (isa == SL_ISA_SCALAR) {
    return &sli_kernels_scalar;
  }
#if defined(SLI_AVX512)
  if (isa == SL_ISA_AVX512 && best == SL_ISA_AVX512) { /* untested: with AVX2 alone */
    return &sli_kernels_avx512;
  }
#endif
#if defined(SLI_X86)
  if (isa == SL_ISA_AVX2 && best != SL_ISA_SCALAR) { /* untested: without AVX2 */
    return &sli_kernels_avx2;
  }
#elif defined(SLI_ARM)
  if (isa == SL_ISA_NEON) {
    return &sli_kernels_neon;
  }
#endif
  return NULL;
}

/* matrix: sparse matrices of the caller and of the library */
/* src/impl/matrix/csc.h: matrices in compressed columns: check, stored triangle, matrices of the library */

struct sl_matrix {
  sl_allocator allocator;
  sl_int n_rows, n_cols;
  sl_int *p;
  sl_int *i;
  double *x;
};

SLI_INLINE sl_int sli_nnz(const sl_csc *A) {
  return A->n_cols > 0 ? A->p[A->n_cols] : 0;
}

static sl_status sli_csc_check_sizes(int64_t n_rows, int64_t n_cols, const void *p) {
  if (n_rows < 0 || n_cols < 0 || (n_cols > 0 && p == NULL)) {
    return SL_ERR_ARGUMENT;
  }
  return n_rows > SLI_ROWS_MAX || n_cols > SLI_ROWS_MAX ? SL_ERR_TOO_LARGE : SL_OK;
}

SL_API sl_status sl_csc_check(const sl_csc *A, sl_stats *stats) {
  sl_status status;
  sl_int j, p;
  sli_stats_clear_error(stats);
  status = A == NULL ? SL_ERR_ARGUMENT : sli_csc_check_sizes(A->n_rows, A->n_cols, A->p);
  if (status != SL_OK || A->n_cols == 0) {
    return status;
  }
  if (A->p[0] != 0) {
    return sli_fail_at(stats, SL_ERR_PATTERN, -1, 0, 0.0);
  }
  for (j = 0; j < A->n_cols; j++) {
    if (A->p[j + 1] < A->p[j]) {
      return sli_fail_at(stats, SL_ERR_PATTERN, -1, j, 0.0);
    }
  }
  if (sli_nnz(A) > 0 && A->i == NULL) {
    return SL_ERR_ARGUMENT;
  }
  for (j = 0; j < A->n_cols; j++) {
    for (p = A->p[j]; p < A->p[j + 1]; p++) {
      if (A->i[p] < 0 || A->i[p] >= A->n_rows) {
        return sli_fail_at(stats, SL_ERR_PATTERN, A->i[p], j, 0.0);
      }
    }
  }
  return SL_OK;
}

static sl_triangle sli_triangle_scan(const sl_csc *A) {
  sl_int j, p;
  int lower = 0, upper = 0;
  for (j = 0; j < A->n_cols && !(lower && upper); j++) {
    for (p = A->p[j]; p < A->p[j + 1]; p++) {
      lower |= A->i[p] > j;
      upper |= A->i[p] < j;
    }
  }
  return lower && upper ? SL_TRIANGLE_BOTH
       : lower        ? SL_TRIANGLE_LOWER
       : upper        ? SL_TRIANGLE_UPPER
              : SL_TRIANGLE_NONE;
}

SLI_INLINE int sli_is_read(sl_triangle triangle, sl_int row, sl_int column) {
  return triangle == SL_TRIANGLE_NONE ||
       (triangle == SL_TRIANGLE_UPPER ? row <= column : row >= column);
}

static void sli_matrix_layout(sl_matrix *M, sli_block *b, size_t nnz, int has_values) {
  (void)sli_take(b, 1, sizeof(sl_matrix));
  M->p = SLI_TAKE(b, sl_int, (size_t)M->n_cols + 1);
  M->i = SLI_TAKE(b, sl_int, nnz);
  M->x = has_values ? SLI_TAKE(b, double, nnz) : NULL;
}

static sl_status sli_matrix_new(sl_matrix **out, sl_int n_rows, sl_int n_cols, sl_int nnz,
                int has_values, const sl_allocator *a) {
  sl_matrix draft;
  sli_block b = {NULL, 0, 0};
  sl_status status;
  draft.allocator = *a;
  draft.n_rows = n_rows;
  draft.n_cols = n_cols;
  sli_matrix_layout(&draft, &b, (size_t)nnz, has_values);
  status = sli_block_alloc(&b, a);
  if (status == SL_OK) {
    sli_matrix_layout(&draft, &b, (size_t)nnz, has_values);
    *out = (sl_matrix *)(void *)b.base;
    **out = draft;
  }
  return status;
}

SL_API void sl_matrix_free(sl_matrix *M) {
  if (M != NULL) {
    const sl_allocator a = M->allocator;
    sli_free(&a, M);
  }
}

SL_API sl_csc sl_matrix_view(const sl_matrix *M) {
  sl_csc A = {0, 0, NULL, NULL, NULL};
  if (M != NULL) {
    A.n_rows = M->n_rows;
    A.n_cols = M->n_cols;
    A.p = M->p;
    A.i = M->i;
    A.x = M->x;
  }
  return A;
}

/* src/impl/matrix/csc_build.h: builds matrices from triplets and transposes, both by counting sorts */

static void sli_count_starts(sl_int *start, sl_int n, const sl_int *keys, sl_int count) {
  sl_int k, total = 0;
  memset(start, 0, ((size_t)n + 1) * sizeof(sl_int));
  for (k = 0; k < count; k++) {
    start[keys[k]]++;
  }
  for (k = 0; k <= n; k++) {
    const sl_int here = start[k];
    start[k] = total;
    total += here;
  }
}

static void sli_matrix_sum_duplicates(sl_matrix *M) {
  sl_int j, p, kept = 0, start = 0;
  for (j = 0; j < M->n_cols; j++) {
    const sl_int first = kept, end = M->p[j + 1];
    for (p = start; p < end; p++) {
      if (kept > first && M->i[kept - 1] == M->i[p]) {
        if (M->x != NULL) {
          M->x[kept - 1] += M->x[p];
        }
      } else {
        M->i[kept] = M->i[p];
        if (M->x != NULL) {
          M->x[kept] = M->x[p];
        }
        kept++;
      }
    }
    start = end;
    M->p[j + 1] = kept;
  }
}

static sl_status sli_from_triplets(sl_matrix **out, sl_int n_rows, sl_int n_cols, sl_int count,
                   const sl_int *i, const sl_int *j, const double *x,
                   const sl_allocator *a) {
  sl_matrix *M = NULL;
  sli_block b = {NULL, 0, 0};
  sl_int *start = NULL, *order = NULL, k;
  int pass;
  sl_status status = sli_matrix_new(&M, n_rows, n_cols, count, x != NULL, a);
  for (pass = 0; pass < 2 && status == SL_OK; pass++) {
    start = SLI_TAKE(&b, sl_int, (size_t)sli_max(n_rows, n_cols) + 1);
    order = SLI_TAKE(&b, sl_int, count);
    status = pass == 0 ? sli_block_alloc(&b, a) : SL_OK;
  }
  if (status != SL_OK) {
    sl_matrix_free(M);
    return status;
  }
  sli_count_starts(start, n_rows, i, count);
  for (k = 0; k < count; k++) {
    order[start[i[k]]++] = k;
  }
  sli_count_starts(start, n_cols, j, count);
  memcpy(M->p, start, ((size_t)n_cols + 1) * sizeof(sl_int));
  for (k = 0; k < count; k++) {
    const sl_int from = order[k], to = start[j[from]]++;
    M->i[to] = i[from];
    if (x != NULL) {
      M->x[to] = x[from];
    }
  }
  sli_free(a, b.base);
  sli_matrix_sum_duplicates(M);
  *out = M;
  return SL_OK;
}

SL_API sl_status sl_matrix_from_triplets(sl_matrix **out, sl_int n_rows, sl_int n_cols,
                     sl_off count, const sl_int *i, const sl_int *j,
                     const double *x, const sl_options *opt, sl_stats *stats) {
  const sl_allocator a = sli_allocator(opt);
  sl_off k;
  sli_stats_clear_error(stats);
  if (out == NULL) {
    return SL_ERR_ARGUMENT;
  }
  *out = NULL;
  if (n_rows < 0 || n_cols < 0 || count < 0 || (count > 0 && (i == NULL || j == NULL)) ||
    !sli_options_are_valid(opt, SLI_READS_NOTHING)) {
    return SL_ERR_ARGUMENT;
  }
  if (count > INT32_MAX || n_rows > SLI_ROWS_MAX || n_cols > SLI_ROWS_MAX) {
    return SL_ERR_TOO_LARGE;
  }
  for (k = 0; k < count; k++) {
    if (i[k] < 0 || i[k] >= n_rows || j[k] < 0 || j[k] >= n_cols) {
      return sli_fail_at(stats, SL_ERR_ARGUMENT, i[k], j[k], 0.0);
    }
  }
  return sli_from_triplets(out, n_rows, n_cols, (sl_int)count, i, j, x, &a);
}

SL_API sl_status sl_matrix_transpose(sl_matrix **out, const sl_csc *A, const sl_options *opt) {
  const sl_allocator a = sli_allocator(opt);
  sl_status status;
  sl_int j, p, k;
  sl_matrix *T;
  if (out == NULL) {
    return SL_ERR_ARGUMENT;
  }
  *out = NULL;
  status =
    sli_options_are_valid(opt, SLI_READS_NOTHING) ? sl_csc_check(A, NULL) : SL_ERR_ARGUMENT;
  if (status != SL_OK) {
    return status;
  }
  status = sli_matrix_new(&T, A->n_cols, A->n_rows, sli_nnz(A), A->x != NULL, &a);
  if (status != SL_OK) {
    return status;
  }
  sli_count_starts(T->p, A->n_rows, A->i, sli_nnz(A));
  for (j = 0; j < A->n_cols; j++) {
    for (p = A->p[j]; p < A->p[j + 1]; p++) {
      const sl_int to = T->p[A->i[p]]++;
      T->i[to] = j;
      if (A->x != NULL) {
        T->x[to] = A->x[p];
      }
    }
  }
  for (k = A->n_rows; k > 0; k--) {
    T->p[k] = T->p[k - 1];
  }
  T->p[0] = 0;
  *out = T;
  return SL_OK;
}

/* src/impl/matrix/csc64.h: matrices with 64-bit indices, converted to 32 bits */

static sl_status sli_csc64_check(const sl_csc64 *A, sl_stats *stats) {
  sl_status status;
  int64_t j;
  status = A == NULL ? SL_ERR_ARGUMENT : sli_csc_check_sizes(A->n_rows, A->n_cols, A->p);
  if (status != SL_OK || A->n_cols == 0) {
    return status;
  }
  if (A->p[0] != 0) {
    return sli_fail_at(stats, SL_ERR_PATTERN, -1, 0, 0.0);
  }
  for (j = 0; j < A->n_cols; j++) {
    if (A->p[j + 1] < A->p[j]) {
      return sli_fail_at(stats, SL_ERR_PATTERN, -1, (sl_int)j, 0.0);
    }
  }
  if (A->p[A->n_cols] > INT32_MAX) {
    return SL_ERR_TOO_LARGE;
  }
  return A->p[A->n_cols] > 0 && A->i == NULL ? SL_ERR_ARGUMENT : SL_OK;
}

static sl_status sli_csc64_copy(const sl_csc64 *A, sl_matrix *M, sl_stats *stats) {
  sl_int j, p;
  M->p[0] = 0;
  for (j = 0; j < M->n_cols; j++) {
    M->p[j + 1] = (sl_int)A->p[j + 1];
    for (p = M->p[j]; p < M->p[j + 1]; p++) {
      const int64_t i = A->i[p];
      if (i < 0 || i >= A->n_rows) {
        const sl_int row = i < INT32_MIN || i > INT32_MAX ? -1 : (sl_int)i;
        return sli_fail_at(stats, SL_ERR_PATTERN, row, j, 0.0);
      }
      M->i[p] = (sl_int)i;
    }
  }
  if (A->x != NULL && M->p[M->n_cols] > 0) {
    memcpy(M->x, A->x, (size_t)M->p[M->n_cols] * sizeof(double));
  }
  return SL_OK;
}

SL_API sl_status sl_matrix_from_csc64(sl_matrix **out, const sl_csc64 *A, const sl_options *opt,
                    sl_stats *stats) {
  const sl_allocator a = sli_allocator(opt);
  sl_matrix *M = NULL;
  sl_status status;
  sli_stats_clear_error(stats);
  if (out == NULL) {
    return SL_ERR_ARGUMENT;
  }
  *out = NULL;
  status =
    sli_options_are_valid(opt, SLI_READS_NOTHING) ? sli_csc64_check(A, stats) : SL_ERR_ARGUMENT;
  if (status == SL_OK) {
    const int64_t nnz = A->n_cols > 0 ? A->p[A->n_cols] : 0;
    status =
      sli_matrix_new(&M, (sl_int)A->n_rows, (sl_int)A->n_cols, (sl_int)nnz, A->x != NULL, &a);
  }
  if (status == SL_OK) {
    status = sli_csc64_copy(A, M, stats);
  }
  if (status != SL_OK) {
    sl_matrix_free(M);
    return status;
  }
  *out = M;
  return SL_OK;
}

/* src/impl/matrix/csc_triangle.h: the triangle that a factorization reads; checks that a pattern is symmetric */

static sl_status sli_csc_check_symmetry(const sl_csc *A, const sl_csc *T, sl_int *mark,
                    sl_stats *stats) {
  sl_int j, p;
  memset(mark, 0, (size_t)A->n_cols * sizeof(sl_int));
  for (j = 0; j < A->n_cols; j++) {
    for (p = A->p[j]; p < A->p[j + 1]; p++) {
      mark[A->i[p]] = j + 1;
    }
    for (p = T->p[j]; p < T->p[j + 1]; p++) {
      if (mark[T->i[p]] != j + 1) {
        return sli_fail_at(stats, SL_ERR_PATTERN, j, T->i[p], 0.0);
      }
    }
  }
  return SL_OK;
}

static sl_status sli_csc_triangle(const sl_csc *A, sl_triangle *out, const sl_options *opt,
                  sl_stats *stats) {
  const sl_allocator a = sli_allocator(opt);
  const sl_triangle wanted = opt == NULL ? SL_TRIANGLE_NONE : opt->triangle;
  const sl_triangle found = sli_triangle_scan(A);
  sl_csc pattern = *A, T;
  sl_matrix *transpose;
  sl_int *mark;
  sl_status status = SL_OK;
  if ((unsigned)wanted > (unsigned)SL_TRIANGLE_BOTH) {
    return SL_ERR_ARGUMENT;
  }
  if (wanted == SL_TRIANGLE_LOWER || wanted == SL_TRIANGLE_UPPER) {
    *out = wanted;
    return SL_OK;
  }
  if (found == SL_TRIANGLE_BOTH) {
    const sl_options only_memory = sli_options_with(&a);
    pattern.x = NULL;
    status = sl_matrix_transpose(&transpose, &pattern, &only_memory);
    if (status != SL_OK) {
      return status;
    }
    T = sl_matrix_view(transpose);
    mark = (sl_int *)sli_alloc(&a, (size_t)A->n_cols * sizeof(sl_int));
    status = mark == NULL ? SL_ERR_MEMORY : sli_csc_check_symmetry(A, &T, mark, stats);
    sli_free(&a, mark);
    sl_matrix_free(transpose);
  }
  if (status == SL_OK) {
    *out = found;
  }
  return status;
}

SL_API sl_status sl_csc_triangle(const sl_csc *A, sl_triangle *out, const sl_options *opt,
                 sl_stats *stats) {
  sl_status status = sl_csc_check(A, stats);
  if (status != SL_OK) {
    return status;
  }
  if (out == NULL || A->n_rows != A->n_cols || !sli_options_are_valid(opt, SLI_READS_TRIANGLE)) {
    return SL_ERR_ARGUMENT;
  }
  return sli_csc_triangle(A, out, opt, stats);
}

/* src/impl/matrix/csc_products.h: products with a matrix in compressed columns, its norm, residuals */

static void sli_add_product(const sl_csc *A, sl_triangle triangle, double sign, double *y,
              const double *x) {
  sl_int j, p;
  for (j = 0; j < A->n_cols; j++) {
    for (p = A->p[j]; p < A->p[j + 1]; p++) {
      const sl_int i = A->i[p];
      if (sli_is_read(triangle, i, j)) {
        y[i] += sign * A->x[p] * x[j];
        if (triangle != SL_TRIANGLE_NONE && i != j) {
          y[j] += sign * A->x[p] * x[i];
        }
      }
    }
  }
}

static int sli_csc_has_arrays(const sl_csc *A) {
  return A->n_rows >= 0 && A->n_cols >= 0 && (A->n_cols == 0 || A->p != NULL) &&
       (sli_nnz(A) <= 0 || (A->i != NULL && A->x != NULL));
}

SL_API sl_status sl_csc_multiply(const sl_csc *A, sl_reading reading, double *Y, size_t ldy,
                 const double *X, size_t ldx, sl_int nrhs) {
  sl_triangle triangle;
  sl_int r;
  if (A == NULL || nrhs < 0 || !sli_csc_has_arrays(A) ||
    (reading != SL_AS_SYMMETRIC && reading != SL_AS_STORED) ||
    (reading == SL_AS_SYMMETRIC && A->n_rows != A->n_cols)) {
    return SL_ERR_ARGUMENT;
  }
  if (nrhs == 0 || A->n_rows == 0) {
    return SL_OK;
  }
  if (Y == NULL || ldy < (size_t)A->n_rows || ldx < (size_t)A->n_cols ||
    (A->n_cols > 0 && (X == NULL || X == Y))) {
    return SL_ERR_ARGUMENT;
  }
  triangle = reading == SL_AS_SYMMETRIC ? sli_triangle_scan(A) : SL_TRIANGLE_NONE;
  for (r = 0; r < nrhs; r++) {
    memset(Y + (size_t)r * ldy, 0, (size_t)A->n_rows * sizeof(double));
    sli_add_product(A, triangle, 1.0, Y + (size_t)r * ldy, X + (size_t)r * ldx);
  }
  return SL_OK;
}

static double sli_largest(const double *x, sl_int n) {
  double largest = 0.0;
  sl_int i;
  for (i = 0; i < n; i++) {
    const double size = fabs(x[i]);
    largest = size <= largest || largest != largest ? largest : size;
  }
  return largest;
}

static double sli_csc_norm(const sl_csc *A, sl_triangle triangle, double *sums) {
  sl_int j, p;
  memset(sums, 0, (size_t)A->n_cols * sizeof(double));
  for (j = 0; j < A->n_cols; j++) {
    for (p = A->p[j]; p < A->p[j + 1]; p++) {
      if (sli_is_read(triangle, A->i[p], j)) {
        sums[j] += fabs(A->x[p]);
        sums[A->i[p]] += A->i[p] != j ? fabs(A->x[p]) : 0.0;
      }
    }
  }
  return sli_largest(sums, A->n_cols);
}

static double sli_backward_error(double r, double a, double x, double b) {
  const double size = a * x + b;
  return r == 0.0 ? 0.0 : sli_is_finite(size) ? r / size : (double)NAN;
}

SL_API sl_status sl_csc_residual(const sl_csc *A, double *R, size_t ldr, double *backward_error,
                 const double *X, size_t ldx, const double *B, size_t ldb,
                 sl_int nrhs) {
  double norm = 0.0;
  sl_int r, n;
  size_t rows;
  sl_triangle triangle;
  if (A == NULL || A->n_rows != A->n_cols || nrhs < 0 || !sli_csc_has_arrays(A)) {
    return SL_ERR_ARGUMENT;
  }
  n = A->n_cols;
  rows = (size_t)n;
  if (nrhs == 0 || n == 0) {
    for (r = 0; r < nrhs && backward_error != NULL; r++) {
      backward_error[r] = 0.0;
    }
    return SL_OK;
  }
  if (B == NULL || R == NULL || X == NULL || ldb < rows || ldr < rows || ldx < rows || R == X ||
    (R == B && (backward_error != NULL || ldr != ldb))) {
    return SL_ERR_ARGUMENT;
  }
  triangle = sli_triangle_scan(A);
  if (backward_error != NULL) {
    norm = sli_csc_norm(A, triangle, R);
  }
  for (r = 0; r < nrhs; r++) {
    const double *x = X + (size_t)r * ldx, *b = B + (size_t)r * ldb;
    double *res = R + (size_t)r * ldr;
    if (res != b) {
      memcpy(res, b, rows * sizeof(double));
    }
    sli_add_product(A, triangle, -1.0, res, x);
    if (backward_error != NULL) {
      backward_error[r] =
        sli_backward_error(sli_largest(res, n), norm, sli_largest(x, n), sli_largest(b, n));
    }
  }
  return SL_OK;
}

/* src/impl/matrix/permute.h: permutations: check, inverse, P A P' of a stored matrix */

static sl_int sli_perm_invert(const sl_int *perm, sl_int n, sl_int *iperm) {
  sl_int k;
  for (k = 0; k < n; k++) {
    iperm[k] = -1;
  }
  for (k = 0; k < n; k++) {
    if (perm[k] < 0 || perm[k] >= n || iperm[perm[k]] >= 0) {
      return k;
    }
    iperm[perm[k]] = k;
  }
  return -1;
}

static void sli_permute_entries(const sl_csc *A, const sl_int *iperm, sl_int *row, sl_int *column) {
  const int both = sli_triangle_scan(A) == SL_TRIANGLE_BOTH;
  sl_int j, p;
  for (j = 0; j < A->n_cols; j++) {
    for (p = A->p[j]; p < A->p[j + 1]; p++) {
      const sl_int k = iperm[A->i[p]], l = iperm[j];
      row[p] = both ? k : sli_max(k, l);
      column[p] = both ? l : sli_min(k, l);
    }
  }
}

SL_API sl_status sl_matrix_permute(sl_matrix **out, const sl_csc *A, const sl_int *perm,
                   const sl_options *opt) {
  const sl_allocator a = sli_allocator(opt);
  sli_block b = {NULL, 0, 0};
  sl_int *iperm = NULL, *row = NULL, *column = NULL;
  sl_status status;
  int pass;
  if (out == NULL) {
    return SL_ERR_ARGUMENT;
  }
  *out = NULL;
  status = sl_csc_check(A, NULL);
  if (status != SL_OK) {
    return status;
  }
  if (A->n_rows != A->n_cols || (A->n_cols > 0 && perm == NULL) ||
    !sli_options_are_valid(opt, SLI_READS_NOTHING)) {
    return SL_ERR_ARGUMENT;
  }
  for (pass = 0; pass < 2 && status == SL_OK; pass++) {
    iperm = SLI_TAKE(&b, sl_int, A->n_cols);
    row = SLI_TAKE(&b, sl_int, sli_nnz(A));
    column = SLI_TAKE(&b, sl_int, sli_nnz(A));
    status = pass == 0 ? sli_block_alloc(&b, &a) : SL_OK;
  }
  if (status == SL_OK) {
    if (sli_perm_invert(perm, A->n_cols, iperm) >= 0) {
      status = SL_ERR_ARGUMENT;
    } else {
      sli_permute_entries(A, iperm, row, column);
      status =
        sli_from_triplets(out, A->n_rows, A->n_cols, sli_nnz(A), row, column, A->x, &a);
    }
    sli_free(&a, b.base);
  }
  return status;
}

/* src/impl/matrix/sum.h: weighted sums of symmetric matrices with any stored triangles */

typedef struct sli_summands {
  sl_int count;
  sl_int *row, *column;
  double *x;
} sli_summands;

static sl_status sli_sum_check(const double *coefficients, const sl_csc *terms, sl_int count,
                 sl_off *entries, sl_stats *stats) {
  sl_int t;
  *entries = 0;
  for (t = 0; t < count; t++) {
    const sl_csc *A = &terms[t];
    const sl_status status = sl_csc_check(A, stats);
    if (status != SL_OK) {
      return status;
    }
    if (A->n_rows != A->n_cols || A->n_cols != terms[0].n_cols ||
      (coefficients != NULL && sli_nnz(A) > 0 && A->x == NULL)) {
      return SL_ERR_ARGUMENT;
    }
    *entries += sli_nnz(A);
  }
  return *entries > INT32_MAX ? SL_ERR_TOO_LARGE : SL_OK; /* untested: 2^31 entries */
}

static void sli_sum_append(sli_summands *all, const sl_csc *A, sl_triangle triangle, double c) {
  sl_int j, p;
  for (j = 0; j < A->n_cols; j++) {
    for (p = A->p[j]; p < A->p[j + 1]; p++) {
      if (sli_is_read(triangle, A->i[p], j)) {
        all->row[all->count] = sli_max(A->i[p], j);
        all->column[all->count] = sli_min(A->i[p], j);
        if (all->x != NULL) {
          all->x[all->count] = c * A->x[p];
        }
        all->count++;
      }
    }
  }
}

SL_API sl_status sl_matrix_sum(sl_matrix **out, const double *coefficients, const sl_csc *terms,
                 sl_int count, const sl_options *opt, sl_stats *stats) {
  const sl_allocator a = sli_allocator(opt);
  sli_block b = {NULL, 0, 0};
  sli_summands all = {0, NULL, NULL, NULL};
  sl_off entries;
  sl_status status;
  sl_int t;
  int pass;
  sli_stats_clear_error(stats);
  if (out == NULL) {
    return SL_ERR_ARGUMENT;
  }
  *out = NULL;
  if (terms == NULL || count < 1 || !sli_options_are_valid(opt, SLI_READS_TRIANGLE)) {
    return SL_ERR_ARGUMENT;
  }
  status = sli_sum_check(coefficients, terms, count, &entries, stats);
  for (pass = 0; pass < 2 && status == SL_OK; pass++) {
    all.row = SLI_TAKE(&b, sl_int, entries);
    all.column = SLI_TAKE(&b, sl_int, entries);
    all.x = coefficients != NULL ? SLI_TAKE(&b, double, entries) : NULL;
    status = pass == 0 ? sli_block_alloc(&b, &a) : SL_OK;
  }
  for (t = 0; t < count && status == SL_OK; t++) {
    sl_triangle triangle = SL_TRIANGLE_NONE;
    status = sli_csc_triangle(&terms[t], &triangle, opt, stats);
    if (status == SL_OK) {
      sli_sum_append(&all, &terms[t], triangle, coefficients != NULL ? coefficients[t] : 0.0);
    }
  }
  if (status == SL_OK) {
    const sl_int n = terms[0].n_cols;
    status = sli_from_triplets(out, n, n, all.count, all.row, all.column, all.x, &a);
  }
  sli_free(&a, b.base);
  return status;
}

/* src/impl/matrix/output_file.h: a file that takes the place of an old one only once it is complete */

#define SLI_TEMPORARY_NAMES 100
#define SLI_TEMPORARY_SUFFIX 16

#if defined(SLI_FSYNC) && defined(__linux__) && defined(__O_TMPFILE)
#define SLI_UNNAMED_FILES 1
#define SLI_FILE_NAME_MAX 32
#define SLI_HERE (-100)
#define SLI_FOLLOW 0x400
#endif

typedef struct sli_output {
  FILE *file;
  const char *path;
  char *temporary;
  int is_unnamed;
} sli_output;

#if defined(SLI_POSIX)
static int sli_is_replaceable(const char *path, int *exists) {
  struct stat found;
  FILE *probe;
  *exists = 0;
  if (sli_is_link(path) || strncmp(path, "/dev/", 5) == 0) {
    return 0;
  }
  if (stat(path, &found) != 0) {
    return errno == ENOENT;
  }
  if (!S_ISREG(found.st_mode)) {
    return 0;
  }
  *exists = 1;
  probe = fopen(path, "ab");
  if (probe != NULL) {
    fclose(probe);
  }
  return probe != NULL;
}

static int sli_take_attributes(const char *name, const char *old_name) {
  struct stat made, old;
  int can = stat(name, &made) == 0 && stat(old_name, &old) == 0; /* untested: one vanished */
  can = can && made.st_dev == old.st_dev;                        /* untested: a mount point */
  can = can && made.st_uid == old.st_uid && made.st_gid == old.st_gid; /* untested: a group */
  return can && ((made.st_mode & 0777) == (old.st_mode & 0777) ||
           chmod(name, old.st_mode & 0777) == 0); /* untested: an owner may */
}
#else
static int sli_is_replaceable(const char *path, int *exists) {
  FILE *probe;
  long length = 0;
  *exists = 0;
#if defined(SLI_WINDOWS)
  if (sli_is_link(path)) {
    return 0;
  }
#endif
  probe = fopen(path, "r+b");
  if (probe != NULL) {
    length = fseek(probe, 0, SEEK_END) == 0 ? ftell(probe) : 0;
    fclose(probe);
    return length != 0;
  }
  probe = fopen(path, "rb");
  if (probe != NULL) {
    fclose(probe);
  }
  return probe == NULL;
}
#endif

static FILE *sli_create_new(const char *name) {
#if defined(SLI_POSIX)
  return fopen(name, "wbx");
#else
  FILE *old = fopen(name, "rb");
  if (old != NULL) {
    fclose(old);
    return NULL;
  }
  return fopen(name, "wb");
#endif
}

#if defined(SLI_UNNAMED_FILES)
static int sli_create_unnamed(sli_output *o, int exists) {
  const char *slash = strrchr(o->path, '/');
  const size_t length = slash == NULL ? 0 : (size_t)(slash - o->path) + 1;
  char name[SLI_FILE_NAME_MAX];
  int file;
  memcpy(o->temporary, o->path, length);
  memcpy(o->temporary + length, ".", 2);
  file = open(o->temporary, __O_TMPFILE | O_WRONLY, 0666);
  if (file < 0) {
    return 0;
  }
  snprintf(name, sizeof name, "/proc/self/fd/%d", file);
  o->file = !exists || sli_take_attributes(name, o->path) ? sli_fdopen(file, "wb") : NULL;
  if (o->file == NULL) {
    close(file);
  }
  return o->file != NULL;
}

static int sli_name_unnamed(sli_output *o) {
  const size_t length = strlen(o->path);
  char name[SLI_FILE_NAME_MAX];
  int k, is_named = 0;
  snprintf(name, sizeof name, "/proc/self/fd/%d", sli_fileno(o->file));
  memcpy(o->temporary, o->path, length);
  for (k = 0; k < SLI_TEMPORARY_NAMES && !is_named; k++) {
    snprintf(o->temporary + length, SLI_TEMPORARY_SUFFIX, ".tmp%02d", k);
    is_named = sli_linkat(SLI_HERE, name, SLI_HERE, o->temporary, SLI_FOLLOW) == 0;
  }
  return is_named;
}
#endif

static int sli_create_beside(sli_output *o, int exists) {
  const size_t length = strlen(o->path);
  int k;
#if defined(SLI_UNNAMED_FILES)
  o->is_unnamed = sli_create_unnamed(o, exists);
#endif
  memcpy(o->temporary, o->path, length);
  for (k = 0; k < SLI_TEMPORARY_NAMES && o->file == NULL; k++) {
    snprintf(o->temporary + length, SLI_TEMPORARY_SUFFIX, ".tmp%02d", k);
    o->file = sli_create_new(o->temporary);
  }
  if (o->file == NULL) {
    return errno != EACCES && errno != EPERM && errno != EROFS && errno != ENAMETOOLONG;
  }
#if defined(SLI_POSIX)
  if (exists && !o->is_unnamed &&
    !sli_take_attributes(o->temporary, o->path)) { /* untested: a mount point */
    fclose(o->file);
    o->file = NULL;
    remove(o->temporary);
    return 0;
  }
#else
  (void)exists;
#endif
  return 1;
}

static sl_status sli_output_open(sli_output *o, const char *path, const sl_allocator *a) {
  int exists, could_replace;
  o->path = path;
  o->temporary = NULL;
  o->file = NULL;
  o->is_unnamed = 0;
  if (sli_is_replaceable(path, &exists)) {
    o->temporary = (char *)sli_alloc(a, strlen(path) + SLI_TEMPORARY_SUFFIX);
    if (o->temporary == NULL) {
      return SL_ERR_MEMORY;
    }
    could_replace = sli_create_beside(o, exists);
    if (o->file != NULL) {
      return SL_OK;
    }
    sli_free(a, o->temporary);
    o->temporary = NULL;
    if (could_replace) {
      return SL_ERR_IO;
    }
  }
  o->file = fopen(path, "wb");
  return o->file != NULL ? SL_OK : SL_ERR_IO;
}

static int sli_replace(const sli_output *o, int *is_only_copy) {
  *is_only_copy = 0;
#if defined(SLI_WINDOWS)
  if (MoveFileExA(o->temporary, o->path, 1) != 0) {
    return 1;
  }
#endif
  if (rename(o->temporary, o->path) == 0) {
    return 1;
  }
#if !defined(SLI_POSIX)
  *is_only_copy = remove(o->path) == 0;
  if (*is_only_copy && rename(o->temporary, o->path) == 0) {
    return 1;
  }
#endif
  return 0;
}

static int sli_output_close(sli_output *o, int complete, const sl_allocator *a) {
  int ok = fflush(o->file) == 0 && complete, has_name = 1, is_only_copy = 0;
#if defined(SLI_UNNAMED_FILES)
  has_name = !o->is_unnamed || (ok && sli_name_unnamed(o));
  ok = ok && has_name;
#endif
  ok = fclose(o->file) == 0 && ok; /* untested: it has been flushed */
  if (o->temporary != NULL) {
    ok = ok && sli_replace(o, &is_only_copy);
    if (!ok && has_name && !is_only_copy) { /* untested: without POSIX */
      remove(o->temporary);
    }
    sli_free(a, o->temporary);
  }
  return ok;
}

/* src/impl/matrix/matrix_market.h: reads and writes coordinate Matrix Market files, in any locale */

#define SLI_TOKEN_MAX 63
#define SLI_POINT_MAX 16
#define SLI_LINE_MAX 65536
#define SLI_ENTRIES_FIRST 65536

typedef struct sli_reader {
  const char *at, *end;
  FILE *file;
  char *buffer;
  int failed;
  sl_off line;
  char point[SLI_POINT_MAX + 1];
} sli_reader;

static int sli_reader_fill(sli_reader *r) {
  const size_t kept = (size_t)(r->end - r->at);
  size_t got;
  if (r->file == NULL || kept == SLI_LINE_MAX) {
    return 0;
  }
  if (kept > 0) {
    memmove(r->buffer, r->at, kept);
  }
  got = fread(r->buffer + kept, 1, SLI_LINE_MAX - kept, r->file);
  r->at = r->buffer;
  r->end = r->buffer + kept + got;
  if (got < SLI_LINE_MAX - kept) {
    r->failed |= ferror(r->file) != 0;
    r->file = NULL;
  }
  return got > 0;
}

static void sli_skip_line(sli_reader *r) {
  do {
    while (r->at < r->end && *r->at != '\n') {
      r->at++;
    }
  } while (r->at == r->end && sli_reader_fill(r));
  r->at += r->at < r->end;
}

static int sli_skip_blanks(sli_reader *r) {
  do {
    while (r->at < r->end && (*r->at == ' ' || *r->at == '\t' || *r->at == '\r')) {
      r->at++;
    }
  } while (r->at == r->end && sli_reader_fill(r));
  return r->at < r->end;
}

static int sli_next_line(sli_reader *r, const char **start, const char **stop, int comments) {
  while (r->at < r->end || sli_reader_fill(r)) {
    ptrdiff_t length = 0;
    r->line++;
    if (!sli_skip_blanks(r)) {
      break;
    }
    if (*r->at == '%' && !comments) {
      sli_skip_line(r);
      continue;
    }
    do {
      while (length < r->end - r->at && r->at[length] != '\n') {
        length++;
      }
    } while (length == r->end - r->at && sli_reader_fill(r));
    if (length >= SLI_LINE_MAX) {
      r->failed = 1;
      break;
    }
    *start = r->at;
    *stop = r->at + length;
    r->at += length + (length < r->end - r->at);
    if (length > 0) {
      return 1;
    }
  }
  return 0;
}

static int sli_token(const char **at, const char *stop, char *token) {
  const char *s = *at;
  int length = 0;
  while (s < stop && (*s == ' ' || *s == '\t' || *s == '\r')) {
    s++;
  }
  while (s < stop && *s != ' ' && *s != '\t' && *s != '\r') {
    if (length == SLI_TOKEN_MAX || *s == '\0') {
      return 0;
    }
    token[length++] = *s++;
  }
  token[length] = '\0';
  *at = s;
  return length > 0;
}

static int sli_token_int(const char **at, const char *stop, sl_off low, sl_off high, sl_off *out) {
  char token[SLI_TOKEN_MAX + 1];
  sl_off value = 0;
  int k = 0;
  if (!sli_token(at, stop, token)) {
    return 0;
  }
  k += token[0] == '+';
  if (token[k] == '\0') {
    return 0;
  }
  for (; token[k] != '\0'; k++) {
    if (token[k] < '0' || token[k] > '9' || value > (INT64_MAX - 9) / 10) {
      return 0;
    }
    value = 10 * value + (token[k] - '0');
  }
  *out = value;
  return value >= low && value <= high;
}

SLI_INLINE int sli_is_numeric(char c) {
  return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '+' ||
       c == '-' || c == '(' || c == ')' || c == '_';
}

static void sli_find_point(char *point) {
  char half[SLI_POINT_MAX + 3];
  const int length = snprintf(half, sizeof half, "%.1f", 0.5);
  if (length < 3 || length >= (int)sizeof half) { /* untested: no locale is like this */
    memcpy(half, "0.5", 4);                    /* untested: the same */
  }
  half[strlen(half) - 1] = '\0';
  memcpy(point, half + 1, strlen(half));
}

static int sli_token_double(const sli_reader *r, const char **at, const char *stop, double *out) {
  char token[SLI_TOKEN_MAX + 1], number[SLI_TOKEN_MAX + SLI_POINT_MAX + 1], *to = number, *rest;
  const char *c;
  int n_points = 0;
  if (!sli_token(at, stop, token)) {
    return 0;
  }
  for (c = token; *c != '\0'; c++) {
    if (*c == '.' && n_points++ == 0) {
      memcpy(to, r->point, strlen(r->point));
      to += strlen(r->point);
    } else if (sli_is_numeric(*c)) {
      *to++ = *c;
    } else {
      return 0;
    }
  }
  *to = '\0';
  *out = strtod(number, &rest);
  return rest != number && *rest == '\0';
}

static int sli_token_is(const char *token, const char *word) {
  for (; *token != '\0' && *word != '\0'; token++, word++) {
    const char c = *token >= 'A' && *token <= 'Z' ? (char)(*token - 'A' + 'a') : *token;
    if (c != *word) {
      return 0;
    }
  }
  return *token == *word;
}

static int sli_token_in(const char *token, const char *const *words) {
  while (*words != NULL && !sli_token_is(token, *words)) {
    words++;
  }
  return *words != NULL;
}

static sl_status sli_read_banner(sli_reader *r, int *has_values, int *symmetric) {
  static const char *const sli_formats[] = {"coordinate", "array", NULL};
  static const char *const sli_fields[] = {"real", "integer", "pattern", "complex", NULL};
  static const char *const sli_symmetries[] = {"general", "symmetric", "skew-symmetric",
                         "hermitian", NULL};
  char token[5][SLI_TOKEN_MAX + 1];
  const char *s, *e;
  int k;
  if (!sli_next_line(r, &s, &e, 1)) {
    return SL_ERR_IO;
  }
  for (k = 0; k < 5; k++) {
    if (!sli_token(&s, e, token[k])) {
      return SL_ERR_IO;
    }
  }
  if (!sli_token_is(token[0], "%%matrixmarket") || !sli_token_is(token[1], "matrix") ||
    !sli_token_in(token[2], sli_formats) || !sli_token_in(token[3], sli_fields) ||
    !sli_token_in(token[4], sli_symmetries)) {
    return SL_ERR_IO;
  }
  *has_values = !sli_token_is(token[3], "pattern");
  *symmetric = sli_token_is(token[4], "symmetric");
  return sli_token_is(token[2], "coordinate") && !sli_token_is(token[3], "complex") &&
           (*symmetric || sli_token_is(token[4], "general"))
         ? SL_OK
         : SL_ERR_UNSUPPORTED;
}

static int sli_line_ends(const char *s, const char *e) {
  while (s < e && (*s == ' ' || *s == '\t' || *s == '\r')) {
    s++;
  }
  return s == e;
}

typedef struct sli_triplets {
  void *block;
  sl_int *i, *j;
  double *x;
  sl_off count, room;
} sli_triplets;

static sl_status sli_triplets_grow(sli_triplets *t, sl_off room, int has_values,
                   const sl_allocator *a) {
  sli_block b = {NULL, 0, 0};
  sli_triplets larger = *t;
  sl_status status = SL_OK;
  int pass;
  larger.room = room;
  for (pass = 0; pass < 2 && status == SL_OK; pass++) {
    larger.i = SLI_TAKE(&b, sl_int, room);
    larger.j = SLI_TAKE(&b, sl_int, room);
    larger.x = has_values ? SLI_TAKE(&b, double, room) : NULL;
    status = pass == 0 ? sli_block_alloc(&b, a) : SL_OK;
  }
  if (status != SL_OK) {
    return status;
  }
  if (t->count > 0) {
    memcpy(larger.i, t->i, (size_t)t->count * sizeof *t->i);
    memcpy(larger.j, t->j, (size_t)t->count * sizeof *t->j);
    if (has_values) {
      memcpy(larger.x, t->x, (size_t)t->count * sizeof *t->x);
    }
  }
  sli_free(a, t->block);
  larger.block = b.base;
  *t = larger;
  return SL_OK;
}

static sl_status sli_read_entries(sli_reader *r, const sl_off *size, int has_values, int symmetric,
                  sli_triplets *t, const sl_allocator *a) {
  const char *s, *e;
  sl_off row, column;
  sl_status status;
  for (; t->count < size[2]; t->count++) {
    if (t->count == t->room) {
      const sl_off more = 2 * t->room < size[2] ? 2 * t->room : size[2];
      status = sli_triplets_grow(t, more, has_values, a);
      if (status != SL_OK) {
        return status;
      }
    }
    if (!sli_next_line(r, &s, &e, 0) || !sli_token_int(&s, e, 1, size[0], &row) ||
      !sli_token_int(&s, e, 1, size[1], &column) ||
      (has_values && !sli_token_double(r, &s, e, &t->x[t->count])) || !sli_line_ends(s, e)) {
      return SL_ERR_IO;
    }
    t->i[t->count] = (sl_int)(symmetric && row < column ? column : row) - 1;
    t->j[t->count] = (sl_int)(symmetric && row < column ? row : column) - 1;
  }
  return sli_next_line(r, &s, &e, 0) || r->failed ? SL_ERR_IO : SL_OK;
}

static sl_status sli_parse(sl_matrix **out, sli_reader *r, const sl_allocator *a) {
  const char *s, *e;
  sl_off size[3] = {0, 0, 0}, room;
  sli_triplets t;
  int has_values, symmetric, k;
  sl_status status = sli_read_banner(r, &has_values, &symmetric);
  if (status != SL_OK) {
    return status;
  }
  if (!sli_next_line(r, &s, &e, 0)) {
    return SL_ERR_IO;
  }
  for (k = 0; k < 3; k++) {
    if (!sli_token_int(&s, e, 0, INT64_MAX, &size[k])) {
      return SL_ERR_IO;
    }
    if (size[k] > SLI_ROWS_MAX) {
      return SL_ERR_TOO_LARGE;
    }
  }
  if (!sli_line_ends(s, e) || (symmetric && size[0] != size[1]) ||
    (r->buffer == NULL && size[2] > (r->end - r->at) / 4 + 1)) {
    return SL_ERR_IO;
  }
  memset(&t, 0, sizeof t);
  room = r->buffer == NULL || size[2] < SLI_ENTRIES_FIRST ? size[2] : SLI_ENTRIES_FIRST;
  status = sli_triplets_grow(&t, room, has_values, a);
  status = status == SL_OK ? sli_read_entries(r, size, has_values, symmetric, &t, a) : status;
  if (status == SL_OK) {
    status = sli_from_triplets(out, (sl_int)size[0], (sl_int)size[1], (sl_int)size[2], t.i, t.j,
                   t.x, a);
  }
  sli_free(a, t.block);
  return status;
}

static sl_status sli_read_matrix(sl_matrix **out, sli_reader *r, const sl_allocator *a,
                 sl_stats *stats) {
  const int saved = errno;
  sl_status status;
  sli_find_point(r->point);
  status = sli_parse(out, r, a);
  if (status != SL_OK && stats != NULL) {
    stats->error.line = r->line > 0 ? r->line : 1;
  }
  errno = saved;
  return status;
}

SL_API sl_status sl_matrix_parse(sl_matrix **out, const char *text, size_t length,
                 const sl_options *opt, sl_stats *stats) {
  const sl_allocator a = sli_allocator(opt);
  sli_reader r;
  sli_stats_clear_error(stats);
  if (out == NULL) {
    return SL_ERR_ARGUMENT;
  }
  *out = NULL;
  if (text == NULL || !sli_options_are_valid(opt, SLI_READS_NOTHING)) {
    return SL_ERR_ARGUMENT;
  }
  memset(&r, 0, sizeof r);
  r.at = text;
  r.end = text + length;
  return sli_read_matrix(out, &r, &a, stats);
}

SL_API sl_status sl_matrix_read(sl_matrix **out, const char *path, const sl_options *opt,
                sl_stats *stats) {
  const sl_allocator a = sli_allocator(opt);
  const int saved = errno;
  sli_reader r;
  FILE *file;
  sl_status status = SL_ERR_MEMORY;
  sli_stats_clear_error(stats);
  if (out == NULL) {
    return SL_ERR_ARGUMENT;
  }
  *out = NULL;
  if (path == NULL || !sli_options_are_valid(opt, SLI_READS_NOTHING)) {
    return SL_ERR_ARGUMENT;
  }
  file = fopen(path, "rb");
  if (file == NULL) {
    errno = saved;
    return SL_ERR_IO;
  }
  memset(&r, 0, sizeof r);
  r.file = file;
  r.buffer = (char *)sli_alloc(&a, SLI_LINE_MAX);
  if (r.buffer != NULL) {
    r.at = r.end = r.buffer;
    status = sli_read_matrix(out, &r, &a, stats);
  }
  sli_free(&a, r.buffer);
  fclose(file);
  errno = saved;
  return status;
}

static void sli_set_point(char *number) {
  const char *from = number;
  char *to = number;
  while (*from != '\0') {
    if (sli_is_numeric(*from)) {
      *to++ = *from++;
      continue;
    }
    *to++ = '.';
    while (*from != '\0' && !sli_is_numeric(*from)) {
      from++;
    }
  }
  *to = '\0';
}

static int sli_write_entry(FILE *file, sl_int row, sl_int column, const double *value) {
  char number[40];
  if (value == NULL) {
    return fprintf(file, "%ld %ld\n", (long)row + 1, (long)column + 1) > 0;
  }
  snprintf(number, sizeof number, "%.17g", *value);
  sli_set_point(number);
  return fprintf(file, "%ld %ld %s\n", (long)row + 1, (long)column + 1, number) > 0;
}

static int sli_write(FILE *file, const sl_csc *A, sl_reading reading, sl_triangle triangle) {
  sl_int j, p;
  sl_off count = 0;
  int ok;
  for (j = 0; j < A->n_cols; j++) {
    for (p = A->p[j]; p < A->p[j + 1]; p++) {
      count += sli_is_read(triangle, A->i[p], j);
    }
  }
  ok = fprintf(file, "%%%%MatrixMarket matrix coordinate %s %s\n%ld %ld %ld\n",
         A->x != NULL ? "real" : "pattern",
         reading == SL_AS_SYMMETRIC ? "symmetric" : "general", (long)A->n_rows,
         (long)A->n_cols, (long)count) > 0;
  for (j = 0; j < A->n_cols && ok; j++) {
    for (p = A->p[j]; p < A->p[j + 1] && ok; p++) {
      const sl_int i = A->i[p];
      if (sli_is_read(triangle, i, j)) {
        const int flip = reading == SL_AS_SYMMETRIC && i < j;
        ok = sli_write_entry(file, flip ? j : i, flip ? i : j,
                   A->x != NULL ? A->x + p : NULL);
      }
    }
  }
  return ok;
}

SL_API sl_status sl_csc_write(const sl_csc *A, sl_reading reading, const char *path) {
  const int saved = errno;
  sl_triangle triangle = SL_TRIANGLE_NONE;
  sl_status status = reading == SL_AS_SYMMETRIC ? sl_csc_triangle(A, &triangle, NULL, NULL)
                          : sl_csc_check(A, NULL);
  const sl_allocator a = sli_allocator(NULL);
  sli_output output;
  if (status != SL_OK) {
    return status;
  }
  if (path == NULL || (reading != SL_AS_SYMMETRIC && reading != SL_AS_STORED)) {
    return SL_ERR_ARGUMENT;
  }
  status = sli_output_open(&output, path, &a);
  if (status == SL_OK) {
    const int complete = sli_write(output.file, A, reading, triangle);
    status = sli_output_close(&output, complete, &a) ? SL_OK : SL_ERR_IO;
  }
  errno = saved;
  return status;
}

/* ordering: fill-reducing orderings of a graph */
/* src/impl/ordering/graph.h: adjacency graph, permuted triangles and hash of a symmetric pattern */

typedef struct sli_pattern {
  sl_int *begin;
  sl_int *to;
  sl_int *from;
} sli_pattern;

typedef struct sli_graph {
  sl_int n;
  sl_off *begin;
  sl_int *to;
} sli_graph;

SLI_INLINE void sli_graph_fill(sli_graph *G, const sl_csc *A, sl_triangle triangle, sl_int block) {
  const sl_int columns = A->n_cols;
  sl_int j, p;
  sl_off total = 0;
  memset(G->begin, 0, ((size_t)G->n + 1) * sizeof(sl_off));
  for (j = 0; j < columns; j++) {
    const sl_int v = block == 1 ? j : j / block;
    for (p = A->p[j]; p < A->p[j + 1]; p++) {
      const sl_int u = block == 1 ? A->i[p] : A->i[p] / block;
      const int is_edge = u != v && sli_is_read(triangle, A->i[p], j);
      G->begin[u] += is_edge;
      G->begin[v] += is_edge;
    }
  }
  for (j = 0; j <= G->n; j++) {
    const sl_off here = G->begin[j];
    G->begin[j] = total;
    total += here;
  }
  for (j = 0; j < columns; j++) {
    const sl_int v = block == 1 ? j : j / block;
    for (p = A->p[j]; p < A->p[j + 1]; p++) {
      const sl_int u = block == 1 ? A->i[p] : A->i[p] / block;
      if (u != v && sli_is_read(triangle, A->i[p], j)) {
        G->to[G->begin[v]++] = u;
        G->to[G->begin[u]++] = v;
      }
    }
  }
  if (G->n > 0) {
    memmove(G->begin + 1, G->begin, (size_t)G->n * sizeof(sl_off));
  }
  G->begin[0] = 0;
}

SLI_INLINE int sli_graph_is_sorted(const sli_graph *G) {
  sl_int v;
  sl_off e;
  for (v = 0; v < G->n; v++) {
    for (e = G->begin[v] + 1; e < G->begin[v + 1]; e++) {
      if (G->to[e - 1] >= G->to[e]) {
        return 0;
      }
    }
  }
  return 1;
}

SLI_INLINE void sli_graph_sort(const sli_graph *G, sl_int *to, sl_off *at) {
  sl_int v;
  sl_off e;
  memcpy(at, G->begin, (size_t)G->n * sizeof(sl_off));
  for (v = 0; v < G->n; v++) {
    for (e = G->begin[v]; e < G->begin[v + 1]; e++) {
      to[at[G->to[e]]++] = v;
    }
  }
}

SLI_INLINE void sli_graph_deduplicate(sli_graph *G) {
  sl_int v;
  sl_off e, count = 0, first = 0;
  for (v = 0; v < G->n; v++) {
    const sl_off end = G->begin[v + 1];
    const sl_off kept = count;
    for (e = first; e < end; e++) {
      if (count == kept || G->to[count - 1] != G->to[e]) {
        G->to[count++] = G->to[e];
      }
    }
    first = end;
    G->begin[v] = kept;
  }
  G->begin[G->n] = count;
}

static void sli_pattern_starts(sli_pattern *h, sl_int n) {
  sl_int k, total = 0;
  for (k = 0; k <= n; k++) {
    const sl_int here = h->begin[k];
    h->begin[k] = total;
    total += here;
  }
}

static void sli_pattern_fill(const sl_csc *A, sl_triangle triangle, const sl_int *iperm,
               sli_pattern *rows, sli_pattern *columns) {
  const sl_int n = A->n_cols;
  sl_int j, p;
  memset(rows->begin, 0, ((size_t)n + 1) * sizeof(sl_int));
  memset(columns->begin, 0, ((size_t)n + 1) * sizeof(sl_int));
  for (j = 0; j < n; j++) {
    for (p = A->p[j]; p < A->p[j + 1]; p++) {
      if (sli_is_read(triangle, A->i[p], j)) {
        rows->begin[sli_max(iperm[A->i[p]], iperm[j])]++;
        columns->begin[sli_min(iperm[A->i[p]], iperm[j])]++;
      }
    }
  }
  sli_pattern_starts(rows, n);
  sli_pattern_starts(columns, n);
  for (j = 0; j < n; j++) {
    for (p = A->p[j]; p < A->p[j + 1]; p++) {
      if (sli_is_read(triangle, A->i[p], j)) {
        const sl_int k = sli_max(iperm[A->i[p]], iperm[j]),
               i = sli_min(iperm[A->i[p]], iperm[j]);
        const sl_int at = rows->begin[k]++;
        rows->to[at] = i;
        rows->from[at] = p;
        columns->to[columns->begin[i]++] = k;
      }
    }
  }
  memmove(rows->begin + 1, rows->begin, (size_t)n * sizeof(sl_int));
  memmove(columns->begin + 1, columns->begin, (size_t)n * sizeof(sl_int));
  rows->begin[0] = columns->begin[0] = 0;
}

static int sli_pattern_hash(const sl_csc *A, sli_hash *out) {
  const sl_int n = A->n_cols, nnz = sli_nnz(A);
  uint32_t descends = n > 0 ? (uint32_t)A->p[0] : 0;
  sl_int j;
  for (j = 0; j < n; j++) {
    const uint32_t next = (uint32_t)A->p[j + 1];
    descends |= next | (next - (uint32_t)A->p[j]);
  }
  out->a = (uint64_t)A->n_rows;
  out->b = (uint64_t)n;
  if (n > 0 && (A->p[0] != 0 || descends >> 31 != 0)) {
    return 0;
  }
  *out = sli_hash_ints(*out, A->p, n > 0 ? (sl_off)n + 1 : 0);
  return sli_hash_indices(out, A->i, nnz, A->n_rows);
}

/* src/impl/ordering/coarsen.h: multilevel coarsening: each graph is contracted along a matching of its vertices */

typedef struct sli_level {
  sl_int n;
  sl_off *begin;
  sl_int *to;
  sl_int *edge;
  sl_int *weight;
  sl_int *coarse;
  void *block;
} sli_level;

typedef struct sli_clusters {
  sl_int *member;
  sl_int *start;
} sli_clusters;

#define SLI_COARSEN_STALL 0.95
#define SLI_LEVELS_MAX 64

SLI_INLINE sl_int sli_level_weight(const sli_level *g, sl_int v) {
  return g->weight == NULL ? 1 : g->weight[v];
}

SLI_INLINE sl_int sli_level_edge(const sli_level *g, sl_off e) {
  return g->edge == NULL ? 1 : g->edge[e];
}

SLI_INLINE uint32_t sli_hash32(uint32_t v) {
  v ^= v >> 16;
  v *= 0x7feb352du;
  v ^= v >> 15;
  v *= 0x846ca68bu;
  return v ^ v >> 16;
}

static sl_int sli_match_best(const sli_level *g, sl_int v, sl_int heaviest, const sl_int *mate) {
  const sl_off first = g->begin[v], degree = g->begin[v + 1] - first;
  const sl_int own = sli_level_weight(g, v);
  sl_int best = -1, best_edge = 0, best_weight = 1;
  sl_off k, e;
  SLI_ASSERT(degree > 0);
  e = first + (sl_off)(sli_hash32((uint32_t)v) % (uint64_t)degree);
  for (k = 0; k < degree; k++, e = e + 1 == first + degree ? first : e + 1) {
    const sl_int u = g->to[e], weight = sli_level_weight(g, u), edge = sli_level_edge(g, e);
    if (mate[u] == -1 && weight <= heaviest - own &&
      (int64_t)edge * best_weight > (int64_t)best_edge * weight) {
      best = u;
      best_edge = edge;
      best_weight = weight;
    }
  }
  return best;
}

static sl_int sli_match(const sli_level *g, sl_int heaviest, sl_int *mate) {
  const sl_int window = 512;
  sl_off first;
  sl_int k, v, pairs = 0;
  for (v = 0; v < g->n; v++) {
    mate[v] = -1;
  }
  for (first = 0; first < g->n; first += window) {
    const uint32_t turn = sli_hash32((uint32_t)first);
    for (k = 0; k < window; k++) {
      const sl_off at =
        first + (sl_off)(((uint32_t)k * 197u + turn) & (uint32_t)(window - 1));
      sl_int u;
      if (at >= g->n || mate[at] != -1) {
        continue;
      }
      v = (sl_int)at;
      u = sli_match_best(g, v, heaviest, mate);
      if (u != -1) {
        mate[v] = u;
        mate[u] = v;
        pairs++;
      }
    }
  }
  return pairs;
}

static sl_int sli_match_two_hop(const sli_level *g, sl_int heaviest, sl_int *mate) {
  sl_int v, pairs = 0;
  for (v = 0; v < g->n; v++) {
    sl_int unmatched = -1;
    sl_off e;
    for (e = g->begin[v]; e < g->begin[v + 1]; e++) {
      const sl_int u = g->to[e];
      if (mate[u] != -1) {
        continue;
      }
      if (unmatched != -1 &&
        sli_level_weight(g, u) <= heaviest - sli_level_weight(g, unmatched)) {
        mate[u] = unmatched;
        mate[unmatched] = u;
        unmatched = -1;
        pairs++;
      } else {
        unmatched = u;
      }
    }
  }
  return pairs;
}

static sl_int sli_number_pairs(const sli_level *g, const sl_int *mate, sli_clusters *clusters) {
  sl_int v, count = 0, members = 0;
  for (v = 0; v < g->n; v++) {
    const sl_int u = mate[v];
    if (u != -1 && u < v) {
      continue;
    }
    g->coarse[v] = count;
    clusters->start[count++] = members;
    clusters->member[members++] = v;
    if (u > v) {
      g->coarse[u] = g->coarse[v];
      clusters->member[members++] = u;
    }
  }
  clusters->start[count] = members;
  return count;
}

static void sli_contract(const sli_level *g, const sli_clusters *clusters, sli_level *c,
             sl_off *at) {
  sl_int k, m;
  sl_off e, count = 0;
  for (k = 0; k < c->n; k++) {
    at[k] = -1;
  }
  for (k = 0; k < c->n; k++) {
    const sl_off first = count;
    c->begin[k] = first;
    c->weight[k] = 0;
    for (m = clusters->start[k]; m < clusters->start[k + 1]; m++) {
      const sl_int v = clusters->member[m];
      c->weight[k] += sli_level_weight(g, v);
      for (e = g->begin[v]; e < g->begin[v + 1]; e++) {
        const sl_int u = g->coarse[g->to[e]];
        if (u == k) {
          continue;
        }
        if (at[u] < first) {
          at[u] = count;
          c->to[count] = u;
          c->edge[count++] = sli_level_edge(g, e);
        } else {
          c->edge[at[u]] += sli_level_edge(g, e);
        }
      }
    }
  }
  c->begin[k] = count;
}

static sl_status sli_coarsen_clusters(const sli_level *g, sl_int n, const sli_clusters *clusters,
                    sli_level *c, sl_off *at, const sl_allocator *a) {
  sli_block b = {NULL, 0, 0};
  sl_status status = SL_OK;
  int pass;
  c->n = n;
  for (pass = 0; pass < 2 && status == SL_OK; pass++) {
    c->begin = SLI_TAKE(&b, sl_off, (size_t)n + 1);
    c->weight = SLI_TAKE(&b, sl_int, n);
    c->coarse = SLI_TAKE(&b, sl_int, n);
    c->to = SLI_TAKE(&b, sl_int, g->begin[g->n]);
    c->edge = SLI_TAKE(&b, sl_int, g->begin[g->n]);
    status = pass == 0 ? sli_block_alloc(&b, a) : SL_OK;
  }
  c->block = b.base;
  if (status == SL_OK) {
    sli_contract(g, clusters, c, at);
  }
  return status;
}

#define SLI_WIDE_DEGREE 16
#define SLI_NEIGHBORHOOD_PAIRS 8
#define SLI_NEIGHBORHOOD_SHRINK 4

SLI_INLINE int sli_level_is_wide(const sli_level *g) {
  return g->begin[g->n] >= SLI_WIDE_DEGREE * (sl_off)g->n;
}

static sl_int sli_cluster_neighborhoods(const sli_level *g, sl_int heaviest,
                    sli_clusters *clusters) {
  sl_int v, count = 0, members = 0;
  sl_off e;
  for (v = 0; v < g->n; v++) {
    g->coarse[v] = -1;
  }
  for (v = 0; v < g->n; v++) {
    int64_t weight = sli_level_weight(g, v);
    if (g->coarse[v] != -1) {
      continue;
    }
    clusters->start[count] = members;
    clusters->member[members++] = v;
    g->coarse[v] = count;
    for (e = g->begin[v]; e < g->begin[v + 1]; e++) {
      const sl_int u = g->to[e];
      if (g->coarse[u] == -1 && weight + sli_level_weight(g, u) <= heaviest) {
        weight += sli_level_weight(g, u);
        clusters->member[members++] = u;
        g->coarse[u] = count;
      }
    }
    count++;
  }
  clusters->start[count] = members;
  return count;
}

static sl_status sli_coarsen(const sli_level *g, sl_int heaviest, sli_level *c, sl_int *mate,
               sli_clusters *clusters, sl_off *at, int *shrunk,
               const sl_allocator *a) {
  sl_int pairs, count = g->n;
  memset(c, 0, sizeof *c);
  *shrunk = 1;
  if (g->edge == NULL && sli_level_is_wide(g)) {
    count = sli_cluster_neighborhoods(
      g, sli_min(heaviest, INT32_MAX / SLI_NEIGHBORHOOD_PAIRS) * SLI_NEIGHBORHOOD_PAIRS,
      clusters);
  }
  if (count > g->n / SLI_NEIGHBORHOOD_SHRINK) {
    pairs = sli_match(g, heaviest, mate);
    if (pairs < g->n / 4) {
      pairs += sli_match_two_hop(g, heaviest, mate);
    }
    *shrunk = (double)(g->n - pairs) < SLI_COARSEN_STALL * (double)g->n;
    if (!*shrunk) {
      return SL_OK;
    }
    count = sli_number_pairs(g, mate, clusters);
  }
  return sli_coarsen_clusters(g, count, clusters, c, at, a);
}

typedef struct sli_edge_weights {
  sl_int *cluster, *member, *start, *seen, *to, *count;
  sl_off *at;
} sli_edge_weights;

static void sli_cluster_members(const sli_level *levels, int l, sli_edge_weights *w) {
  const sl_int n = levels[0].n, clusters = levels[l].n;
  sl_int v, k;
  int m;
  memset(w->start, 0, ((size_t)clusters + 1) * sizeof(sl_int));
  for (v = 0; v < n; v++) {
    sl_int c = v;
    for (m = 0; m < l; m++) {
      c = levels[m].coarse[c];
    }
    w->cluster[v] = c;
    w->start[c + 1]++;
  }
  for (k = 0; k < clusters; k++) {
    w->start[k + 1] += w->start[k];
  }
  for (v = 0; v < n; v++) {
    w->member[w->start[w->cluster[v]]++] = v;
  }
  memmove(w->start + 1, w->start, (size_t)clusters * sizeof(sl_int));
  w->start[0] = 0;
}

static void sli_weigh_edges(sli_level *levels, int l, sli_edge_weights *w) {
  const sli_level *finest = &levels[0];
  sli_level *g = &levels[l];
  sl_int k, i;
  sl_off e;
  sli_cluster_members(levels, l, w);
  for (k = 0; k < g->n; k++) {
    w->seen[k] = -1;
  }
  for (k = 0; k < g->n; k++) {
    for (e = g->begin[k]; e < g->begin[k + 1]; e++) {
      w->at[g->to[e]] = e;
      g->edge[e] = 0;
    }
    for (i = w->start[k]; i < w->start[k + 1]; i++) {
      const sl_int v = w->member[i];
      for (e = finest->begin[v]; e < finest->begin[v + 1]; e++) {
        const sl_int c = w->cluster[finest->to[e]];
        if (c != k && w->seen[c] != v) {
          w->seen[c] = v;
          g->edge[w->at[c]]++;
        }
      }
    }
  }
  memcpy(w->at, g->begin, (size_t)g->n * sizeof(sl_off));
  for (k = 0; k < g->n; k++) {
    for (e = g->begin[k]; e < g->begin[k + 1]; e++) {
      const sl_off there = w->at[g->to[e]]++;
      w->to[there] = k;
      w->count[there] = g->edge[e];
    }
  }
  for (k = 0; k < g->n; k++) {
    for (e = g->begin[k]; e < g->begin[k + 1]; e++) {
      w->at[g->to[e]] = e;
    }
    for (e = g->begin[k]; e < g->begin[k + 1]; e++) {
      g->edge[w->at[w->to[e]]] += w->count[e];
    }
  }
}

/* src/impl/ordering/labels.h: the separator tree during dissection: a label for each vertex, and border lists */

typedef struct sli_label_tree {
  sl_int count, room;
  sl_int root;
  sl_int *parent;
  sl_int *left, *right;
  sl_int *low, *high;
  sl_int *weight;
  sl_int *scratch;
} sli_label_tree;

static void sli_label_tree_layout(sli_label_tree *t, sli_block *b, sl_int room) {
  t->room = room;
  t->parent = SLI_TAKE(b, sl_int, room);
  t->left = SLI_TAKE(b, sl_int, room);
  t->right = SLI_TAKE(b, sl_int, room);
  t->low = SLI_TAKE(b, sl_int, room);
  t->high = SLI_TAKE(b, sl_int, room);
  t->weight = SLI_TAKE(b, sl_int, room);
  t->scratch = SLI_TAKE(b, sl_int, 2 * (size_t)room);
}

static sl_int sli_label_tree_add(sli_label_tree *t, sl_int parent) {
  const sl_int node = t->count++;
  t->parent[node] = parent;
  t->left[node] = t->right[node] = -1;
  t->weight[node] = 0;
  return node;
}

static void sli_label_tree_split(sli_label_tree *t, sl_int leaf) {
  t->left[leaf] = sli_label_tree_add(t, leaf);
  t->right[leaf] = sli_label_tree_add(t, leaf);
}

SLI_INLINE int sli_label_tree_is_leaf(const sli_label_tree *t, sl_int node) {
  return t->left[node] == -1;
}

SLI_INLINE int sli_label_tree_is_below(const sli_label_tree *t, sl_int node, sl_int label) {
  return t->low[node] <= label && label <= t->high[node];
}

SLI_INLINE sl_int sli_label_tree_lca(const sli_label_tree *t, sl_int a, sl_int b) {
  while (!sli_label_tree_is_below(t, a, b)) {
    a = t->parent[a];
  }
  return a;
}

SLI_INLINE sl_int sli_label_tree_next(const sli_label_tree *t, sl_int node) {
  const sl_int up = t->parent[node];
  if (up == -1 || t->right[up] == node) {
    return up;
  }
  node = t->right[up];
  while (t->left[node] != -1) {
    node = t->left[node];
  }
  return node;
}

SLI_INLINE sl_int sli_label_tree_first(const sli_label_tree *t) {
  sl_int node = t->root;
  while (t->left[node] != -1) {
    node = t->left[node];
  }
  return node;
}

static void sli_label_tree_renumber(sl_int *a, const sl_int *number, sl_int count, int values,
                  sl_int *scratch) {
  sl_int k;
  memcpy(scratch, a, (size_t)count * sizeof(sl_int));
  for (k = 0; k < count; k++) {
    a[number[k]] = values && scratch[k] != -1 ? number[scratch[k]] : scratch[k];
  }
}

static void sli_label_tree_number(sli_label_tree *t, sl_int n, sl_int *label) {
  sl_int *number = t->scratch, *keep = t->scratch + t->room, node, k, next = 0;
  for (node = sli_label_tree_first(t); node != -1; node = sli_label_tree_next(t, node)) {
    const sl_int up = t->parent[node];
    if (t->left[node] == -1) {
      number[node] = next++;
    }
    if (up != -1 && t->left[up] == node) {
      number[up] = next++;
    }
  }
  t->root = number[t->root];
  sli_label_tree_renumber(t->parent, number, t->count, 1, keep);
  sli_label_tree_renumber(t->left, number, t->count, 1, keep);
  sli_label_tree_renumber(t->right, number, t->count, 1, keep);
  sli_label_tree_renumber(t->weight, number, t->count, 0, keep);
  for (k = 0; k < n; k++) {
    label[k] = number[label[k]];
  }
  for (node = sli_label_tree_first(t); node != -1; node = sli_label_tree_next(t, node)) {
    t->low[node] = t->left[node] == -1 ? node : t->low[t->left[node]];
    t->high[node] = t->left[node] == -1 ? node : t->high[t->right[node]];
  }
}

static void sli_label_tree_breadth_first(const sli_label_tree *t, sl_int *order) {
  sl_int head, tail = 0;
  order[tail++] = t->root;
  for (head = 0; head < tail; head++) {
    if (!sli_label_tree_is_leaf(t, order[head])) {
      order[tail++] = t->left[order[head]];
      order[tail++] = t->right[order[head]];
    }
  }
}

typedef struct sli_borders {
  sl_int *head;
  sl_int count, room;
  sl_int *vertex, *next;
  void *block;
  int failed;
  const sl_allocator *a;
} sli_borders;

SLI_INLINE void sli_borders_init(sli_borders *l, const sl_allocator *a) {
  l->count = l->room = 0;
  l->vertex = l->next = NULL;
  l->block = NULL;
  l->failed = 0;
  l->a = a;
}

static void sli_borders_grow(sli_borders *l) {
  sli_block b = {NULL, 0, 0};
  sl_int *vertex = NULL, *next = NULL;
  const sl_int room =
    l->room < INT32_MAX / 2 ? sli_max(2 * l->room, 1024) : INT32_MAX; /* untested: 2^30 */
  int pass;
  for (pass = 0; pass < 2 && !l->failed; pass++) {
    vertex = SLI_TAKE(&b, sl_int, room);
    next = SLI_TAKE(&b, sl_int, room);
    l->failed = pass == 0 && (room == l->room || sli_block_alloc(&b, l->a) != SL_OK);
  }
  if (!l->failed) {
    if (l->count > 0) {
      memcpy(vertex, l->vertex, (size_t)l->count * sizeof(sl_int));
      memcpy(next, l->next, (size_t)l->count * sizeof(sl_int));
    }
    sli_free(l->a, l->block);
    l->vertex = vertex;
    l->next = next;
    l->room = room;
    l->block = b.base;
  }
}

static void sli_borders_add(sli_borders *l, sl_int node, sl_int v) {
  if (l->count == l->room) {
    sli_borders_grow(l);
    if (l->failed) {
      return;
    }
  }
  l->vertex[l->count] = v;
  l->next[l->count] = l->head[node];
  l->head[node] = l->count++;
}

static void sli_borders_fill(sli_borders *l, const sli_label_tree *t, const sli_level *g,
               const sl_int *label) {
  sl_int v, k;
  sl_off e;
  for (k = 0; k < t->count; k++) {
    l->head[k] = -1;
  }
  l->count = 0;
  for (v = 0; v < g->n; v++) {
    const sl_int own = label[v];
    sl_int last = own, listed = -1;
    for (e = g->begin[v]; e < g->begin[v + 1]; e++) {
      const sl_int other = label[g->to[e]];
      if (other != own && other != last) {
        const sl_int node = sli_label_tree_lca(t, own, other);
        last = other;
        if (node != listed && node != own && node != other) {
          listed = node;
          sli_borders_add(l, node, v);
        }
      }
    }
  }
}

/* src/impl/ordering/subgraph.h: a leaf, or a band along the border of a node, as a graph in its own numbering */

typedef struct sli_subgraph {
  sl_int n;
  sl_int *vertex;
  sl_off *begin;
  sl_int *to, *edge;
  sl_int *weight;
  sl_int *external;
  unsigned char *side;
  unsigned char *home;
  unsigned char *layer;
  int64_t total[2];
  sl_int *local;
  unsigned char *locked, *best;
  sl_int *scratch;
} sli_subgraph;

static void sli_subgraph_layout(sli_subgraph *sub, sli_block *b, sl_int n, sl_off edges) {
  sub->vertex = SLI_TAKE(b, sl_int, n);
  sub->begin = SLI_TAKE(b, sl_off, (size_t)n + 1);
  sub->to = SLI_TAKE(b, sl_int, edges);
  sub->edge = SLI_TAKE(b, sl_int, edges);
  sub->weight = SLI_TAKE(b, sl_int, n);
  sub->external = SLI_TAKE(b, sl_int, n);
  sub->side = SLI_TAKE(b, unsigned char, n);
  sub->home = SLI_TAKE(b, unsigned char, n);
  sub->layer = SLI_TAKE(b, unsigned char, n);
  sub->local = SLI_TAKE(b, sl_int, n);
  sub->locked = SLI_TAKE(b, unsigned char, n);
  sub->best = SLI_TAKE(b, unsigned char, n);
  sub->scratch = SLI_TAKE(b, sl_int, 6 * (uint64_t)n);
}

SLI_INLINE void sli_subgraph_add(sli_subgraph *sub, sl_int v, int layer) {
  sub->local[v] = sub->n;
  sub->layer[sub->n] = (unsigned char)layer;
  sub->vertex[sub->n++] = v;
}

static void sli_subgraph_clear(sli_subgraph *sub) {
  sl_int k;
  for (k = 0; k < sub->n; k++) {
    sub->local[sub->vertex[k]] = -1;
  }
  sub->n = 0;
}

static void sli_subgraph_edges(sli_subgraph *sub, const sli_level *g, const sli_label_tree *t,
                 sl_int node, const sl_int *label) {
  sl_int k;
  sl_off e, count = 0;
  for (k = 0; k < sub->n; k++) {
    const sl_int v = sub->vertex[k];
    sub->begin[k] = count;
    sub->weight[k] = sli_level_weight(g, v);
    sub->external[k] = 0;
    sub->side[k] = sub->home[k] = label[v] > node;
    for (e = g->begin[v]; e < g->begin[v + 1]; e++) {
      const sl_int u = g->to[e];
      if (sub->local[u] != -1) {
        sub->to[count] = sub->local[u];
        sub->edge[count++] = sli_level_edge(g, e);
      } else if (sli_label_tree_is_below(t, node, label[u])) {
        sub->external[k] += sli_level_edge(g, e);
      }
    }
  }
  sub->begin[sub->n] = count;
}

static void sli_subgraph_leaf(sli_subgraph *sub, const sli_level *g, const sli_label_tree *t,
                sl_int node, const sl_int *label, const sl_int *vertices,
                sl_int count) {
  sl_int k;
  sub->n = 0;
  for (k = 0; k < count; k++) {
    sli_subgraph_add(sub, vertices[k], 0);
  }
  sli_subgraph_edges(sub, g, t, node, label);
  sub->total[0] = t->weight[node];
  sub->total[1] = 0;
}

#define SLI_BAND_SHARE 30

static void sli_subgraph_band(sli_subgraph *sub, const sli_level *g, const sli_label_tree *t,
                sl_int node, const sl_int *label, const sli_borders *l, int layers) {
  const sl_int most = (sl_int)((int64_t)t->weight[node] * SLI_BAND_SHARE / 100);
  sl_int entry, head = 0;
  sl_off e;
  int layer;
  sub->n = 0;
  for (entry = l->head[node]; entry != -1; entry = l->next[entry]) {
    const sl_int v = l->vertex[entry];
    const int side = label[v] > node;
    int crosses = 0;
    if (sub->local[v] != -1 || label[v] == node ||
      !sli_label_tree_is_below(t, node, label[v])) {
      continue;
    }
    for (e = g->begin[v]; e < g->begin[v + 1] && !crosses; e++) {
      const sl_int other = label[g->to[e]];
      crosses =
        other != node && sli_label_tree_is_below(t, node, other) && (other > node) != side;
    }
    if (crosses) {
      sli_subgraph_add(sub, v, 0);
    }
  }
  for (layer = 1; layer <= layers && (layer == 1 || sub->n < most); layer++) {
    const sl_int end = sub->n;
    for (; head < end; head++) {
      for (e = g->begin[sub->vertex[head]]; e < g->begin[sub->vertex[head] + 1]; e++) {
        const sl_int u = g->to[e];
        if (sub->local[u] == -1 && sli_label_tree_is_below(t, node, label[u])) {
          sli_subgraph_add(sub, u, layer);
        }
      }
    }
  }
  sli_subgraph_edges(sub, g, t, node, label);
  sub->total[0] = t->weight[t->left[node]];
  sub->total[1] = t->weight[t->right[node]];
}

static void sli_relabel_vertex(sl_int v, sl_int to, sl_int node, const sli_level *g,
                 sli_label_tree *t, sl_int *label, sli_borders *l) {
  const sl_int from = label[v], weight = sli_level_weight(g, v);
  sl_int up, last = to;
  sl_off e;
  for (up = from; up != node; up = t->parent[up]) {
    t->weight[up] -= weight;
  }
  for (up = to; up != node; up = t->parent[up]) {
    t->weight[up] += weight;
  }
  label[v] = to;
  if (to == node) {
    return;
  }
  for (e = g->begin[v]; e < g->begin[v + 1]; e++) {
    const sl_int other = label[g->to[e]];
    if (other != to && other != last && other != node && (other > node) == (to > node) &&
      sli_label_tree_is_below(t, node, other)) {
      const sl_int border = sli_label_tree_lca(t, to, other);
      sli_borders_add(l, border, v);
      sli_borders_add(l, border, g->to[e]);
    }
  }
}

static sl_int sli_subgraph_adjacent_leaf(const sli_level *g, const sli_label_tree *t, sl_int node,
                     sl_int v, int side, const sl_int *label) {
  sl_int best = -1, most = 0;
  sl_off e;
  for (e = g->begin[v]; e < g->begin[v + 1]; e++) {
    const sl_int other = label[g->to[e]];
    if (other != node && sli_label_tree_is_below(t, node, other) && (other > node) == side &&
      sli_level_edge(g, e) > most) {
      most = sli_level_edge(g, e);
      best = other;
    }
  }
  return best;
}

static void sli_subgraph_apply(sli_subgraph *sub, const sli_level *g, sli_label_tree *t,
                 sl_int node, sl_int *label, sli_borders *l) {
  sl_int *moved = sub->scratch, count = 0, k, left;
  for (k = 0; k < sub->n; k++) {
    if (sub->side[k] == 2) {
      sli_relabel_vertex(sub->vertex[k], node, node, g, t, label, l);
    } else if (sub->side[k] != sub->home[k]) {
      moved[count++] = k;
    }
  }
  do {
    left = 0;
    for (k = 0; k < count; k++) {
      const sl_int m = moved[k], v = sub->vertex[m];
      const sl_int leaf = sli_subgraph_adjacent_leaf(g, t, node, v, sub->side[m], label);
      if (leaf != -1) {
        sli_relabel_vertex(v, leaf, node, g, t, label, l);
      } else {
        moved[left++] = m;
      }
    }
    if (left == count) {
      break;
    }
    count = left;
  } while (count > 0);
}

/* src/impl/ordering/heap.h: a priority queue of vertices by gain, the largest gain first */

typedef struct sli_heap {
  sl_int count;
  sl_int *item;
  sl_int *position;
  sl_int *key;
} sli_heap;

SLI_INLINE void sli_heap_up(sli_heap *h, sl_int k, sl_int v) {
  while (k > 0 && h->key[h->item[(k - 1) / 2]] < h->key[v]) {
    h->item[k] = h->item[(k - 1) / 2];
    h->position[h->item[k]] = k;
    k = (k - 1) / 2;
  }
  h->item[k] = v;
  h->position[v] = k;
}

SLI_INLINE void sli_heap_down(sli_heap *h, sl_int k, sl_int v) {
  for (;;) {
    sl_int c = 2 * k + 1;
    if (c >= h->count) {
      break;
    }
    c += c + 1 < h->count && h->key[h->item[c + 1]] > h->key[h->item[c]];
    if (h->key[h->item[c]] <= h->key[v]) {
      break;
    }
    h->item[k] = h->item[c];
    h->position[h->item[k]] = k;
    k = c;
  }
  h->item[k] = v;
  h->position[v] = k;
}

SLI_INLINE void sli_heap_add(sli_heap *h, sl_int v) {
  sli_heap_up(h, h->count++, v);
}

SLI_INLINE void sli_heap_update(sli_heap *h, sl_int v) {
  const sl_int k = h->position[v];
  if (k > 0 && h->key[h->item[(k - 1) / 2]] < h->key[v]) {
    sli_heap_up(h, k, v);
  } else {
    sli_heap_down(h, k, v);
  }
}

SLI_INLINE void sli_heap_remove(sli_heap *h, sl_int v) {
  const sl_int k = h->position[v], last = h->item[--h->count];
  h->position[v] = -1;
  if (last != v) {
    h->position[last] = k;
    h->item[k] = last;
    sli_heap_update(h, last);
  }
}

/* src/impl/ordering/bisect.h: graph bisection: greedy graph growing, and Fiduccia-Mattheyses refinement of a cut */

#define SLI_BISECT_BALANCE 60

SLI_INLINE int64_t sli_cut_cost(int64_t cut, const int64_t *total) {
  return cut * (total[0] > total[1] ? total[0] : total[1]);
}

static sl_int sli_subgraph_gain(const sli_subgraph *sub, sl_int v, int *on_border) {
  const int side = sub->side[v];
  sl_int across = side != sub->home[v] ? sub->external[v] : 0;
  sl_int within = sub->external[v] - across;
  sl_off e;
  for (e = sub->begin[v]; e < sub->begin[v + 1]; e++) {
    if (sub->side[sub->to[e]] != side) {
      across += sub->edge[e];
    } else {
      within += sub->edge[e];
    }
  }
  *on_border = across > 0;
  return across - within;
}

static int64_t sli_subgraph_cut_weight(const sli_subgraph *sub) {
  int64_t twice = 0;
  sl_int v;
  sl_off e;
  for (v = 0; v < sub->n; v++) {
    for (e = sub->begin[v]; e < sub->begin[v + 1]; e++) {
      twice += sub->side[sub->to[e]] != sub->side[v] ? sub->edge[e] : 0;
    }
    twice += sub->side[v] != sub->home[v] ? 2 * (int64_t)sub->external[v] : 0;
  }
  return twice / 2;
}

typedef struct sli_fm {
  sli_subgraph *sub;
  sli_heap heap[2];
  unsigned char *locked;
  sl_int *moves;
  int64_t most;
} sli_fm;

SLI_INLINE int sli_fm_may_move(const sli_fm *m, sl_int v) {
  const sli_subgraph *sub = m->sub;
  const int from = sub->side[v];
  const int64_t after = sub->total[1 - from] + sub->weight[v];
  return after <= m->most || after <= sub->total[from];
}

static int sli_fm_choose(const sli_fm *m) {
  int side, best = -1;
  for (side = 0; side < 2; side++) {
    const sli_heap *h = &m->heap[side];
    if (h->count > 0 && sli_fm_may_move(m, h->item[0])) {
      if (best == -1 || h->key[h->item[0]] > h->key[m->heap[best].item[0]] ||
        (h->key[h->item[0]] == h->key[m->heap[best].item[0]] &&
         m->sub->total[side] > m->sub->total[best])) {
        best = side;
      }
    }
  }
  return best;
}

static void sli_fm_flip(sli_fm *m, sl_int v) {
  sli_subgraph *sub = m->sub;
  const int from = sub->side[v];
  sub->side[v] = (unsigned char)(1 - from);
  sub->total[from] -= sub->weight[v];
  sub->total[1 - from] += sub->weight[v];
}

static void sli_fm_update(sli_fm *m, sl_int v) {
  sli_subgraph *sub = m->sub;
  sl_off e;
  for (e = sub->begin[v]; e < sub->begin[v + 1]; e++) {
    const sl_int u = sub->to[e];
    sli_heap *h = &m->heap[sub->side[u]];
    if (m->locked[u]) {
      continue;
    }
    if (h->position[u] == -1) {
      int on_border;
      h->key[u] = sli_subgraph_gain(sub, u, &on_border);
      if (on_border) {
        sli_heap_add(h, u);
      }
    } else {
      h->key[u] += sub->side[u] == sub->side[v] ? -2 * sub->edge[e] : 2 * sub->edge[e];
      sli_heap_update(h, u);
    }
  }
}

static int sli_fm_pass(sli_fm *m, int64_t *cut) {
  sli_subgraph *sub = m->sub;
  const sl_int patience = 20 + sub->n / 20 < 100 ? 20 + sub->n / 20 : 100;
  int64_t here = *cut, cost = sli_cut_cost(here, sub->total), best_cost = cost;
  sl_int v, made = 0, best = 0;
  int side;
  m->heap[0].count = m->heap[1].count = 0;
  for (v = 0; v < sub->n; v++) {
    int on_border;
    m->locked[v] = 0;
    m->heap[0].position[v] = -1;
    m->heap[0].key[v] = sli_subgraph_gain(sub, v, &on_border);
    if (on_border) {
      sli_heap_add(&m->heap[sub->side[v]], v);
    }
  }
  while (made - best < patience && (side = sli_fm_choose(m)) != -1) {
    v = m->heap[side].item[0];
    sli_heap_remove(&m->heap[side], v);
    m->locked[v] = 1;
    here -= m->heap[side].key[v];
    sli_fm_flip(m, v);
    sli_fm_update(m, v);
    m->moves[made++] = v;
    cost = sli_cut_cost(here, sub->total);
    if (cost < best_cost) {
      best_cost = cost;
      best = made;
      *cut = here;
    }
  }
  while (made > best) {
    sli_fm_flip(m, m->moves[--made]);
  }
  return best > 0;
}

static sli_fm sli_fm_of(sli_subgraph *sub) {
  sli_fm m;
  m.sub = sub;
  m.heap[0].position = m.heap[1].position = sub->scratch;
  m.heap[0].key = m.heap[1].key = sub->scratch + sub->n;
  m.heap[0].item = sub->scratch + 2 * (size_t)sub->n;
  m.heap[1].item = sub->scratch + 3 * (size_t)sub->n;
  m.moves = sub->scratch + 4 * (size_t)sub->n;
  m.locked = sub->locked;
  m.heap[0].count = m.heap[1].count = 0;
  m.most = (sub->total[0] + sub->total[1]) * SLI_BISECT_BALANCE / 100;
  return m;
}

static int64_t sli_subgraph_refine(sli_subgraph *sub, int rounds) {
  sli_fm m = sli_fm_of(sub);
  int64_t cut = sli_subgraph_cut_weight(sub);
  while (rounds-- > 0 && sli_fm_pass(&m, &cut)) {
  }
  return sli_cut_cost(cut, sub->total);
}

static sl_int sli_subgraph_farthest(const sli_subgraph *sub, sl_int v, sl_int *queue,
                  unsigned char *seen) {
  sl_int head, tail = 0;
  sl_off e;
  memset(seen, 0, (size_t)sub->n);
  queue[tail++] = v;
  seen[v] = 1;
  for (head = 0; head < tail; head++) {
    for (e = sub->begin[queue[head]]; e < sub->begin[queue[head] + 1]; e++) {
      if (!seen[sub->to[e]]) {
        seen[sub->to[e]] = 1;
        queue[tail++] = sub->to[e];
      }
    }
  }
  return queue[tail - 1];
}

static void sli_subgraph_grow(sli_subgraph *sub, sl_int seed) {
  sli_fm m = sli_fm_of(sub);
  sl_int v, unseen = 0;
  sub->total[1] += sub->total[0];
  sub->total[0] = 0;
  memset(sub->side, 1, (size_t)sub->n);
  memset(m.locked, 0, (size_t)sub->n);
  for (v = 0; v < sub->n; v++) {
    m.heap[0].position[v] = -1;
  }
  v = seed;
  for (;;) {
    m.locked[v] = 1;
    sli_fm_flip(&m, v);
    if (sub->total[0] >= sub->total[1]) {
      break;
    }
    sli_fm_update(&m, v);
    if (m.heap[1].count > 0) {
      v = m.heap[1].item[0];
      sli_heap_remove(&m.heap[1], v);
    } else {
      while (unseen < sub->n && m.locked[unseen]) {
        unseen++;
      }
      if (unseen == sub->n) {
        break;
      }
      v = unseen;
    }
  }
}

static void sli_subgraph_bisect(sli_subgraph *sub, int tries, int rounds) {
  int64_t best = 0, total[2] = {0, 0};
  int k;
  for (k = 0; k < tries; k++) {
    sl_int seed = (sl_int)(sli_hash32((uint32_t)k + 77u) % (uint32_t)sub->n);
    int64_t cost;
    if (k % 2 == 0) {
      seed = sli_subgraph_farthest(sub, seed, sub->scratch, sub->locked);
    }
    sli_subgraph_grow(sub, seed);
    cost = sli_subgraph_refine(sub, rounds);
    if (k == 0 || cost < best) {
      best = cost;
      memcpy(sub->best, sub->side, (size_t)sub->n);
      total[0] = sub->total[0];
      total[1] = sub->total[1];
    }
  }
  memcpy(sub->side, sub->best, (size_t)sub->n);
  sub->total[0] = total[0];
  sub->total[1] = total[1];
}

/* src/impl/ordering/separator.h: a minimum vertex separator in a band, by maximum flow */

typedef struct sli_flow {
  sli_subgraph *sub;
  sl_int *before, *after;
  sl_int *seen;
  sl_int *path;
  sl_off *next;
  unsigned char *terminal;
} sli_flow;

#define SLI_FLOW_NONE (-1)
#define SLI_FLOW_END (-2)
#if !defined(SLI_FLOW_ROUNDS)
#define SLI_FLOW_ROUNDS 60
#endif

static void sli_flow_terminals(sli_flow *f) {
  const sli_subgraph *sub = f->sub;
  int last[2] = {-1, -1}, touches_outside[2] = {0, 0};
  sl_int v;
  for (v = 0; v < sub->n; v++) {
    const int s = sub->side[v];
    touches_outside[s] |= sub->external[v] > 0;
    last[s] = sub->layer[v] > last[s] ? sub->layer[v] : last[s];
  }
  for (v = 0; v < sub->n; v++) {
    const int s = sub->side[v];
    const int is_end = touches_outside[s] ? sub->external[v] > 0 : sub->layer[v] == last[s];
    f->terminal[v] = (unsigned char)(is_end ? 1 + s : 0);
  }
}

static void sli_flow_sort_edges(sli_flow *f) {
  sli_subgraph *sub = f->sub;
  sl_int v;
  for (v = 0; v < sub->n; v++) {
    const int here = sub->side[v] == 0 ? -1 - sub->layer[v] : sub->layer[v];
    sl_off e, front = sub->begin[v], back = sub->begin[v + 1];
    for (e = front; e < back;) {
      const sl_int u = sub->to[e];
      const int other = sub->side[u] == 0 ? -1 - sub->layer[u] : sub->layer[u];
      if (other > here) {
        sub->to[e++] = sub->to[front];
        sub->to[front++] = u;
      } else if (other < here) {
        sub->to[e] = sub->to[--back];
        sub->to[back] = u;
      } else {
        e++;
      }
    }
  }
}

static sl_int sli_flow_next_state(sli_flow *f, sl_int v, sl_int round) {
  const sli_subgraph *sub = f->sub;
  for (; f->next[v] < sub->begin[v + 1]; f->next[v]++) {
    const sl_int u = sub->to[f->next[v]];
    if (f->seen[2 * u] != round) {
      return 2 * u;
    }
  }
  return f->before[v] != SLI_FLOW_NONE && f->seen[2 * v] != round ? 2 * v : -1;
}

static sl_int sli_flow_find_path(sli_flow *f, sl_int v, sl_int round) {
  sl_int length = 0, state = 2 * v;
  f->path[length++] = state;
  f->seen[state] = round;
  while (length > 0) {
    sl_int next_state = -1;
    state = f->path[length - 1];
    v = state / 2;
    if (state % 2 == 1) {
      if (f->terminal[v] == 2) {
        break;
      }
      next_state = sli_flow_next_state(f, v, round);
    } else if (f->before[v] == SLI_FLOW_NONE) {
      next_state = 2 * v + 1;
    } else if (f->before[v] >= 0) {
      next_state = 2 * f->before[v] + 1;
    }
    if (next_state == -1 || f->seen[next_state] == round) {
      length--;
      continue;
    }
    f->seen[next_state] = round;
    f->path[length++] = next_state;
    if (next_state % 2 == 1) {
      f->next[next_state / 2] = f->sub->begin[next_state / 2];
    }
  }
  return length;
}

static void sli_flow_augment(sli_flow *f, sl_int length) {
  sl_int k;
  f->before[f->path[0] / 2] = SLI_FLOW_END;
  for (k = 0; k < length; k++) {
    const sl_int state = f->path[k], v = state / 2;
    if (state % 2 == 0) {
      continue;
    }
    if (k + 1 == length) {
      f->after[v] = SLI_FLOW_END;
    } else if (f->path[k + 1] == 2 * v) {
      f->before[v] = f->after[v] = SLI_FLOW_NONE;
    } else {
      f->after[v] = f->path[k + 1] / 2;
      f->before[f->after[v]] = v;
    }
  }
}

static int sli_flow_maximize(sli_flow *f, sl_int *last) {
  const sl_int n = f->sub->n;
  sl_int v, round, found = 1;
  for (v = 0; v < n; v++) {
    f->before[v] = f->after[v] = SLI_FLOW_NONE;
    f->seen[2 * v] = f->seen[2 * v + 1] = 0;
  }
  for (round = 1; found && round <= SLI_FLOW_ROUNDS; round++) {
    found = 0;
    for (v = 0; v < n; v++) {
      if (f->terminal[v] == 1 && f->seen[2 * v] != round) {
        const sl_int length = sli_flow_find_path(f, v, round);
        if (length > 0) {
          sli_flow_augment(f, length);
          found = 1;
        }
      }
    }
    *last = round;
  }
  return !found;
}

SLI_INLINE sl_int sli_flow_mark(sli_flow *f, sl_int state, sl_int tail) {
  if (f->seen[state] != -1) {
    f->seen[state] = -1;
    f->path[tail++] = state;
  }
  return tail;
}

static void sli_flow_mark_sink_side(sli_flow *f) {
  const sli_subgraph *sub = f->sub;
  sl_int v, head, tail = 0;
  sl_off e;
  for (v = 0; v < sub->n; v++) {
    if (f->terminal[v] == 2) {
      tail = sli_flow_mark(f, 2 * v + 1, tail);
    }
  }
  for (head = 0; head < tail; head++) {
    v = f->path[head] / 2;
    if (f->path[head] % 2 == 1) {
      if (f->before[v] == SLI_FLOW_NONE) {
        tail = sli_flow_mark(f, 2 * v, tail);
      } else if (f->after[v] >= 0) {
        tail = sli_flow_mark(f, 2 * f->after[v], tail);
      }
    } else {
      if (f->before[v] != SLI_FLOW_NONE) {
        tail = sli_flow_mark(f, 2 * v + 1, tail);
      }
      for (e = sub->begin[v]; e < sub->begin[v + 1]; e++) {
        tail = sli_flow_mark(f, 2 * sub->to[e] + 1, tail);
      }
    }
  }
}

static int64_t sli_flow_extend_source_side(sli_flow *f, sl_int v, sl_int mark) {
  const sli_subgraph *sub = f->sub;
  sl_int head, tail = 0, next_state;
  int64_t gained = 0;
  sl_off e;
  f->seen[2 * v + 1] = mark;
  f->path[tail++] = 2 * v + 1;
  for (head = 0; head < tail; head++) {
    v = f->path[head] / 2;
    if (f->path[head] % 2 == 0) {
      next_state = f->before[v] == SLI_FLOW_NONE ? 2 * v + 1 : 2 * f->before[v] + 1;
      if (f->seen[next_state] != mark) {
        f->seen[next_state] = mark;
        f->path[tail++] = next_state;
      }
      continue;
    }
    gained += sub->weight[v];
    if (f->before[v] != SLI_FLOW_NONE && f->seen[2 * v] != mark) {
      f->seen[2 * v] = mark;
      f->path[tail++] = 2 * v;
    }
    for (e = sub->begin[v]; e < sub->begin[v + 1]; e++) {
      next_state = 2 * sub->to[e];
      if (f->seen[next_state] != mark) {
        f->seen[next_state] = mark;
        f->path[tail++] = next_state;
      }
    }
  }
  return gained;
}

static void sli_flow_balance(sli_flow *f, sl_int mark) {
  const sli_subgraph *sub = f->sub;
  int64_t left = sub->total[0], half = sub->total[0] + sub->total[1];
  sl_int v, k;
  for (v = 0; v < sub->n; v++) {
    const int in = f->seen[2 * v] == mark, out = f->seen[2 * v + 1] == mark;
    left += (sub->side[v] == 1 && out ? sub->weight[v] : 0) -
        (sub->side[v] == 0 && !out ? sub->weight[v] : 0);
    half -= in && !out ? sub->weight[v] : 0;
  }
  half /= 2;
  for (k = 0; k < 2 * sub->n && left < half; k++) {
    v = k < sub->n ? sub->n - 1 - k : k - sub->n;
    if (sub->side[v] == (k >= sub->n) && f->seen[2 * v + 1] != mark &&
      f->seen[2 * v + 1] != -1) {
      left += sli_flow_extend_source_side(f, v, mark);
    }
  }
}

static void sli_separator_from_border(sli_subgraph *sub) {
  const int side = sub->total[0] > sub->total[1];
  sl_int v;
  for (v = 0; v < sub->n; v++) {
    sub->side[v] = sub->side[v] == side && sub->layer[v] == 0 ? 2 : sub->side[v];
  }
}

static void sli_subgraph_separate(sli_subgraph *sub, unsigned char *terminal, sl_int *scratch,
                  sl_off *next) {
  const size_t n = (size_t)sub->n;
  sl_int v, last = 0;
  sli_flow f;
  f.sub = sub;
  f.before = scratch;
  f.after = scratch + n;
  f.seen = scratch + 2 * n;
  f.path = scratch + 4 * n;
  f.next = next;
  f.terminal = terminal;
  sli_flow_terminals(&f);
  sli_flow_sort_edges(&f);
  if (sub->n > INT32_MAX / 2 || !sli_flow_maximize(&f, &last)) { /* untested: 2^30 vertices */
    sli_separator_from_border(sub);
    return;
  }
  sli_flow_mark_sink_side(&f);
  sli_flow_balance(&f, last);
  for (v = 0; v < sub->n; v++) {
    const int in = f.seen[2 * v] == last, out = f.seen[2 * v + 1] == last;
    sub->side[v] = (unsigned char)(out ? 0 : in ? 2 : 1);
  }
}

/* src/impl/ordering/mindeg.h: minimum degree ordering of leaf subgraphs, with the graph as a bit matrix */

#define SLI_MINDEG_MAX 1024
#define SLI_MINDEG_ELIMINATED UINT32_MAX

typedef struct sli_mindeg {
  sl_int n;
  size_t words;
  uint64_t *rows;
  uint32_t *key;
  size_t room;
  uint64_t alive[SLI_MINDEG_MAX / 64];
  int has_popcnt;
} sli_mindeg;

SLI_ALWAYS_INLINE uint32_t sli_popcount(uint64_t w) {
#if defined(SLI_GNU)
  return (uint32_t)__builtin_popcountll(w);
#else
  w -= w >> 1 & 0x5555555555555555u;
  w = (w & 0x3333333333333333u) + (w >> 2 & 0x3333333333333333u);
  w = (w + (w >> 4)) & 0x0f0f0f0f0f0f0f0fu;
  return (uint32_t)(w * 0x0101010101010101u >> 56);
#endif
}

SLI_ALWAYS_INLINE sl_int sli_lowest_bit(uint64_t w) {
#if defined(SLI_GNU)
  return (sl_int)__builtin_ctzll(w);
#else
  return (sl_int)sli_popcount((w & (0 - w)) - 1);
#endif
}

SLI_ALWAYS_INLINE uint32_t sli_mindeg_join(uint64_t *other, const uint64_t *row, size_t words,
                       sl_int v) {
  uint32_t degree = 0;
  size_t k;
  other[v / 64] &= ~((uint64_t)1 << (v % 64));
  for (k = 0; k < words; k++) {
    other[k] |= row[k];
    degree += sli_popcount(other[k]);
  }
  return degree - 1;
}

SLI_ALWAYS_INLINE sl_int sli_mindeg_eliminate(sli_mindeg *m, sl_int v, sl_int *order, sl_int at) {
  const uint32_t degree = m->key[v] / SLI_MINDEG_MAX;
  const size_t leaf_words = ((size_t)m->n + 63) / 64;
  uint64_t *row = m->rows + (size_t)v * m->words, eliminated[SLI_MINDEG_MAX / 64];
  const sl_int first = at;
  size_t k, w;
  memset(eliminated, 0, leaf_words * sizeof(uint64_t));
  row[v / 64] &= ~((uint64_t)1 << (v % 64));
  m->key[v] = SLI_MINDEG_ELIMINATED;
  order[at++] = v;
  for (k = 0; k < leaf_words; k++) {
    uint64_t bits = row[k] & m->alive[k];
    for (; bits != 0; bits &= bits - 1) {
      const sl_int u = (sl_int)(64 * k) + sli_lowest_bit(bits);
      const uint32_t now = sli_mindeg_join(m->rows + (size_t)u * m->words, row, m->words, v);
      m->key[u] = now * SLI_MINDEG_MAX + (uint32_t)u;
      if (now + 1 == degree) {
        m->key[u] = SLI_MINDEG_ELIMINATED;
        eliminated[k] |= (uint64_t)1 << (u % 64);
        order[at++] = u;
      }
    }
  }
  m->alive[v / 64] &= ~((uint64_t)1 << (v % 64));
  for (k = 0; k < leaf_words && at > first + 1; k++) {
    uint64_t bits = row[k] & m->alive[k] & ~eliminated[k];
    for (; bits != 0; bits &= bits - 1) {
      const sl_int u = (sl_int)(64 * k) + sli_lowest_bit(bits);
      uint64_t *other = m->rows + (size_t)u * m->words;
      for (w = 0; w < leaf_words; w++) {
        other[w] &= ~eliminated[w];
      }
      m->key[u] -= (uint32_t)(at - first - 1) * SLI_MINDEG_MAX;
    }
  }
  for (k = 0; k < leaf_words; k++) {
    m->alive[k] &= ~eliminated[k];
  }
  return at;
}

SLI_INLINE sl_int sli_mindeg_best(const sli_mindeg *m) {
  uint32_t least[4] = {SLI_MINDEG_ELIMINATED, SLI_MINDEG_ELIMINATED, SLI_MINDEG_ELIMINATED,
             SLI_MINDEG_ELIMINATED};
  sl_int v = 0, k;
  for (; v <= m->n - 4; v += 4) {
    for (k = 0; k < 4; k++) {
      least[k] = m->key[v + k] < least[k] ? m->key[v + k] : least[k];
    }
  }
  for (; v < m->n; v++) {
    least[0] = m->key[v] < least[0] ? m->key[v] : least[0];
  }
  for (k = 1; k < 4; k++) {
    least[0] = least[k] < least[0] ? least[k] : least[0];
  }
  return (sl_int)(least[0] % SLI_MINDEG_MAX);
}

SLI_ALWAYS_INLINE void sli_mindeg_run_body(sli_mindeg *m, sl_int *order) {
  sl_int at = 0;
  while (at < m->n) {
    at = sli_mindeg_eliminate(m, sli_mindeg_best(m), order, at);
  }
}

static void sli_mindeg_run(sli_mindeg *m, sl_int *order) {
  sli_mindeg_run_body(m, order);
}

#if defined(SLI_X86) && defined(SLI_GNU)
SLI_TARGET("popcnt") static void sli_mindeg_run_popcnt(sli_mindeg *m, sl_int *order) {
  sli_mindeg_run_body(m, order);
}
#endif

static int sli_mindeg_fill(sli_mindeg *m, const sli_level *g, const sl_int *vertices, sl_int count,
               sl_int *local) {
  sl_int k, bits = count;
  sl_off e;
  int fits;
  for (k = 0; k < count; k++) {
    local[vertices[k]] = k;
  }
  for (k = 0; k < count; k++) {
    for (e = g->begin[vertices[k]]; e < g->begin[vertices[k] + 1]; e++) {
      if (local[g->to[e]] == -1) {
        local[g->to[e]] = bits++;
      }
    }
  }
  m->n = count;
  m->words = ((size_t)bits + 63) / 64;
  fits = count <= SLI_MINDEG_MAX && m->words * (size_t)count <= m->room;
  if (fits) {
    memset(m->alive, 0, sizeof m->alive);
    memset(m->rows, 0, m->words * (size_t)count * sizeof(uint64_t));
  }
  for (k = 0; k < count && fits; k++) {
    uint64_t *row = m->rows + (size_t)k * m->words;
    for (e = g->begin[vertices[k]]; e < g->begin[vertices[k] + 1]; e++) {
      const sl_int b = local[g->to[e]];
      row[b / 64] |= (uint64_t)1 << (b % 64);
    }
    m->key[k] = (sli_mindeg_join(row, row, m->words, k) + 1) * SLI_MINDEG_MAX + (uint32_t)k;
    row[k / 64] |= (uint64_t)1 << (k % 64);
    m->alive[k / 64] |= (uint64_t)1 << (k % 64);
  }
  for (k = 0; k < count; k++) {
    for (e = g->begin[vertices[k]]; e < g->begin[vertices[k] + 1]; e++) {
      local[g->to[e]] = -1;
    }
    local[vertices[k]] = -1;
  }
  return fits;
}

static void sli_mindeg_order(sli_mindeg *m, const sli_level *g, sl_int *vertices, sl_int count,
               sl_int *local, sl_int *order) {
  sl_int k;
  if (!sli_mindeg_fill(m, g, vertices, count, local)) {
    return;
  }
#if defined(SLI_X86) && defined(SLI_GNU)
  if (m->has_popcnt) {
    sli_mindeg_run_popcnt(m, order);
  } else
#endif
  {
    sli_mindeg_run(m, order);
  }
  for (k = 0; k < count; k++) {
    order[k] = vertices[order[k]];
  }
  memcpy(vertices, order, (size_t)count * sizeof(sl_int));
}

/* src/impl/ordering/dissect.h: multilevel nested dissection of a connected graph, and the estimated cost of a tree */

#define SLI_DISSECT_LEAF 200
#define SLI_DISSECT_LEAF_REFINED 140
#define SLI_DISSECT_BISECT_MIN 100
#define SLI_DISSECT_SHRINK 7
#define SLI_DISSECT_FIRST 64
#define SLI_DISSECT_TRIES_FIRST 8
#define SLI_DISSECT_TRIES 2
#define SLI_DISSECT_LAYERS 3
#define SLI_DISSECT_BAND 2
#define SLI_DISSECT_BAND_FROM 1000
#define SLI_DISSECT_BAND_WIDE 1
#define SLI_SEPARATOR_BALANCE 70

typedef struct sli_dissection {
  const sl_allocator *a;
  sli_level levels[SLI_LEVELS_MAX];
  int n_levels, level;
  sl_int total;
  sl_int leaf_size;
  int band;
  int band_growth;
  sli_label_tree tree;
  sli_borders borders;
  sli_subgraph subgraph;
  sli_mindeg mindeg;
  sl_int *label, *other;
  sl_int *begin;
  sl_int *order;
  sl_int *nodes;
  sl_off *next;
} sli_dissection;

static void sli_dissection_layout(sli_dissection *d, sli_block *b, sl_int n, sl_off edges) {
  const sl_int room = n + 1;
  d->levels[0].coarse = SLI_TAKE(b, sl_int, n);
  sli_label_tree_layout(&d->tree, b, room);
  d->borders.head = SLI_TAKE(b, sl_int, room);
  sli_subgraph_layout(&d->subgraph, b, n, edges);
  d->label = SLI_TAKE(b, sl_int, n);
  d->other = SLI_TAKE(b, sl_int, n);
  d->begin = SLI_TAKE(b, sl_int, (size_t)room + 1);
  d->order = SLI_TAKE(b, sl_int, n);
  d->nodes = SLI_TAKE(b, sl_int, room);
  d->next = SLI_TAKE(b, sl_off, n);
  d->mindeg.key = SLI_TAKE(b, uint32_t, SLI_MINDEG_MAX);
  d->mindeg.room = (size_t)SLI_MINDEG_MAX * SLI_MINDEG_MAX / 32;
  d->mindeg.rows = SLI_TAKE(b, uint64_t, d->mindeg.room);
}

static void sli_dissect_sort(sli_dissection *d) {
  const sli_level *g = &d->levels[d->level];
  sl_int v, k, total = 0;
  memset(d->begin, 0, ((size_t)d->tree.count + 1) * sizeof(sl_int));
  for (v = 0; v < g->n; v++) {
    d->begin[d->label[v]]++;
  }
  for (k = 0; k <= d->tree.count; k++) {
    const sl_int here = d->begin[k];
    d->begin[k] = total;
    total += here;
  }
  for (v = 0; v < g->n; v++) {
    d->order[d->begin[d->label[v]]++] = v;
  }
  memmove(d->begin + 1, d->begin, (size_t)d->tree.count * sizeof(sl_int));
  d->begin[0] = 0;
}

static void sli_dissect_start(sli_dissection *d) {
  const sl_int n = d->levels[d->level].n;
  d->tree.count = 0;
  d->tree.root = sli_label_tree_add(&d->tree, -1);
  d->tree.weight[d->tree.root] = d->total;
  memset(d->label, 0, (size_t)n * sizeof(sl_int));
  sli_label_tree_number(&d->tree, n, d->label);
}

static void sli_dissect_assign(sli_dissection *d, sl_int node) {
  const sli_subgraph *sub = &d->subgraph;
  sl_int k, weight[2] = {0, 0};
  sli_label_tree_split(&d->tree, node);
  for (k = 0; k < sub->n; k++) {
    const int side = sub->side[k];
    d->label[sub->vertex[k]] = side == 0 ? d->tree.left[node] : d->tree.right[node];
    weight[side] += sub->weight[k];
  }
  d->tree.weight[d->tree.left[node]] = weight[0];
  d->tree.weight[d->tree.right[node]] = weight[1];
}

static sl_int sli_dissect_split(sli_dissection *d, sl_int most) {
  const sli_level *g = &d->levels[d->level];
  const sl_int nodes = d->tree.count;
  sl_int node, split = 0;
  sli_dissect_sort(d);
  for (node = 0; node < nodes; node++) {
    const sl_int count = d->begin[node + 1] - d->begin[node];
    if (sli_label_tree_is_leaf(&d->tree, node) && count > most &&
      d->tree.weight[node] > d->leaf_size && d->tree.count < d->tree.room - 1) {
      const int few =
        d->tree.count < SLI_DISSECT_FIRST && count <= 2 * SLI_DISSECT_BISECT_MIN;
      sli_subgraph_leaf(&d->subgraph, g, &d->tree, node, d->label, d->order + d->begin[node],
                count);
      sli_subgraph_bisect(&d->subgraph,
                few          ? SLI_DISSECT_TRIES_FIRST
                : count > 50 ? SLI_DISSECT_TRIES
                       : 1,
                2);
      sli_dissect_assign(d, node);
      sli_subgraph_clear(&d->subgraph);
      split++;
    }
  }
  if (split > 0) {
    sli_label_tree_number(&d->tree, g->n, d->label);
  }
  return split;
}

static void sli_dissect_refine(sli_dissection *d) {
  const sli_level *g = &d->levels[d->level];
  sl_int k;
  sli_borders_fill(&d->borders, &d->tree, g, d->label);
  sli_label_tree_breadth_first(&d->tree, d->nodes);
  for (k = 0; k < d->tree.count; k++) {
    const sl_int node = d->nodes[k];
    if (!sli_label_tree_is_leaf(&d->tree, node) && d->borders.head[node] != -1) {
      sli_subgraph_band(&d->subgraph, g, &d->tree, node, d->label, &d->borders,
                SLI_DISSECT_LAYERS);
      sli_subgraph_refine(&d->subgraph, 2);
      sli_subgraph_apply(&d->subgraph, g, &d->tree, node, d->label, &d->borders);
      sli_subgraph_clear(&d->subgraph);
    }
  }
}

static int sli_dissect_is_balanced(const sli_dissection *d) {
  const sli_subgraph *sub = &d->subgraph;
  int64_t total[2], sum, before = sub->total[0] > sub->total[1] ? sub->total[0] : sub->total[1];
  sl_int v;
  total[0] = sub->total[0];
  total[1] = sub->total[1];
  for (v = 0; v < sub->n; v++) {
    total[sub->home[v]] -= sub->weight[v];
    if (sub->side[v] != 2) {
      total[sub->side[v]] += sub->weight[v];
    }
  }
  sum = total[0] + total[1];
  total[0] = total[0] > total[1] ? total[0] : total[1];
  return 100 * total[0] <= SLI_SEPARATOR_BALANCE * sum || total[0] <= before;
}

static void sli_dissect_set_bands(sli_dissection *d, int growth) {
  const int is_wide = sli_level_is_wide(&d->levels[0]);
  d->band = is_wide ? SLI_DISSECT_BAND_WIDE : SLI_DISSECT_BAND;
  d->band_growth = is_wide ? 0 : growth;
}

static void sli_dissect_separate(sli_dissection *d) {
  const sli_level *g = &d->levels[0];
  sl_int k;
  sli_borders_fill(&d->borders, &d->tree, g, d->label);
  sli_label_tree_breadth_first(&d->tree, d->nodes);
  for (k = 0; k < d->tree.count; k++) {
    const sl_int node = d->nodes[k];
    sl_int weight = d->tree.weight[node];
    int layers = d->band;
    if (sli_label_tree_is_leaf(&d->tree, node) || d->borders.head[node] == -1) {
      continue;
    }
    for (; weight > SLI_DISSECT_BAND_FROM; weight /= 4) {
      layers +=
        weight > 4 * SLI_DISSECT_BAND_FROM ? d->band_growth : sli_min(d->band_growth, 1);
    }
    for (;; layers /= 2) {
      sli_subgraph_band(&d->subgraph, g, &d->tree, node, d->label, &d->borders, layers);
      sli_subgraph_separate(&d->subgraph, d->subgraph.locked, d->subgraph.scratch, d->next);
      if (layers == 0 || sli_dissect_is_balanced(d)) {
        break;
      }
      sli_subgraph_clear(&d->subgraph);
    }
    sli_subgraph_apply(&d->subgraph, g, &d->tree, node, d->label, &d->borders);
    sli_subgraph_clear(&d->subgraph);
  }
}

static void sli_dissect_project(sli_dissection *d) {
  const sli_level *g = &d->levels[--d->level];
  sl_int v, *coarser = d->label;
  for (v = 0; v < g->n; v++) {
    d->other[v] = coarser[g->coarse[v]];
  }
  d->label = d->other;
  d->other = coarser;
}

static void sli_dissect_weigh(sli_dissection *d, int l) {
  sli_edge_weights w;
  w.cluster = d->label;
  w.member = d->order;
  w.start = d->nodes;
  w.seen = d->begin;
  w.to = d->subgraph.to;
  w.count = d->subgraph.edge;
  w.at = d->next;
  sli_weigh_edges(d->levels, l, &w);
}

static sl_status sli_dissect_coarsen(sli_dissection *d, int weigh, int *working) {
  const sl_int n = d->levels[0].n,
         enough = sli_min(SLI_DISSECT_BISECT_MIN, n / SLI_DISSECT_SHRINK);
  int shrunk = 1;
  sl_status status = SL_OK;
  sli_clusters clusters;
  clusters.member = d->other;
  clusters.start = d->begin;
  *working = -1;
  for (;;) {
    const int last = d->n_levels - 1;
    const sli_level *g = &d->levels[last];
    const sl_int heaviest = (sl_int)(3 * (int64_t)d->total / g->n) + 1;
    if (*working == -1 && last > 0 && g->n <= n / SLI_DISSECT_SHRINK) {
      *working = last;
      if (weigh) {
        sli_dissect_weigh(d, last);
      }
    }
    if (g->n <= enough || d->n_levels == SLI_LEVELS_MAX) {
      break;
    }
    status = sli_coarsen(g, heaviest, &d->levels[d->n_levels], d->order, &clusters, d->next,
               &shrunk, d->a);
    if (status != SL_OK || !shrunk) {
      break;
    }
    d->n_levels++;
  }
  *working = *working == -1 ? d->n_levels - 1 : *working;
  return status;
}

static void sli_dissect_free_levels(sli_dissection *d) {
  int k;
  for (k = 1; k < d->n_levels; k++) {
    sli_free(d->a, d->levels[k].block);
  }
  d->n_levels = 1;
}

static sl_status sli_dissect_levels(sli_dissection *d, int weigh) {
  int working;
  const sl_status status = sli_dissect_coarsen(d, weigh, &working);
  if (status != SL_OK) {
    return status;
  }
  d->level = d->n_levels - 1;
  sli_dissect_start(d);
  for (;;) {
    while (sli_dissect_split(d, d->level == working ? 1 : SLI_DISSECT_BISECT_MIN) > 0) {
    }
    if (d->level == working) {
      break;
    }
    sli_dissect_project(d);
    sli_dissect_refine(d);
  }
  return d->borders.failed ? SL_ERR_MEMORY : SL_OK;
}

static sl_status sli_dissect_multilevel(sli_dissection *d) {
  sl_status status;
  d->n_levels = 1;
  status = sli_dissect_levels(d, 1);
  while (status == SL_OK && d->level > 0) {
    sli_dissect_project(d);
  }
  sli_dissect_free_levels(d);
  return status;
}

typedef struct sli_tree_cost {
  uint64_t high, low;
} sli_tree_cost;

SLI_INLINE void sli_tree_cost_add(sli_tree_cost *c, uint64_t a, uint64_t b) {
  c->low += (a & 0xffffffffu) * b;
  c->high += (a >> 32) * b + (c->low >> 32);
  c->low &= 0xffffffffu;
}

SLI_INLINE sli_tree_cost sli_tree_cost_times(sli_tree_cost c, uint64_t factor) {
  c.low *= factor;
  c.high = c.high * factor + (c.low >> 32);
  c.low &= 0xffffffffu;
  return c;
}

SLI_INLINE int sli_tree_cost_is_less(sli_tree_cost a, sli_tree_cost b) {
  return a.high < b.high || (a.high == b.high && a.low < b.low);
}

static sli_tree_cost sli_dissect_cost(sli_dissection *d, sli_tree_cost *flat) {
  const sli_level *g = &d->levels[0];
  sl_int *border = d->nodes, v, k;
  sl_off e;
  sli_tree_cost cost = {0, 0};
  memset(border, 0, (size_t)d->tree.count * sizeof(sl_int));
  for (v = 0; v < g->n; v++) {
    const sl_int own = d->label[v];
    sl_int last = -1;
    for (e = g->begin[v]; e < g->begin[v + 1]; e++) {
      const sl_int other = d->label[g->to[e]];
      if (own < other && other != last) {
        const sl_int node = sli_label_tree_lca(&d->tree, own, other);
        border[node] += last == -1 || node != sli_label_tree_lca(&d->tree, own, last);
        last = other;
      }
    }
  }
  *flat = cost;
  for (k = 0; k < d->tree.count; k++) {
    const uint64_t weight = (uint64_t)d->tree.weight[k], across = (uint64_t)border[k];
    if (!sli_label_tree_is_leaf(&d->tree, k)) {
      sli_tree_cost_add(&cost, weight * across, across);
      sli_tree_cost_add(flat, weight, weight);
    }
  }
  return cost;
}

/* src/impl/ordering/levelset.h: bisection between level sets of a breadth-first search, cheaper in regular volumes */

#define SLI_LEVELSET_SHARE 35

static sl_int sli_levelset_search(const sli_subgraph *sub, sl_int from, sl_int *order,
                  sl_int *distance) {
  sl_int v, head = 0, tail = 0, unseen = 0;
  sl_off e;
  for (v = 0; v < sub->n; v++) {
    distance[v] = -1;
  }
  distance[from] = 0;
  order[tail++] = from;
  for (;;) {
    for (; head < tail; head++) {
      for (e = sub->begin[order[head]]; e < sub->begin[order[head] + 1]; e++) {
        if (distance[sub->to[e]] == -1) {
          distance[sub->to[e]] = distance[order[head]] + 1;
          order[tail++] = sub->to[e];
        }
      }
    }
    if (tail == sub->n) {
      return distance[order[tail - 1]] + 1;
    }
    while (distance[unseen] != -1) {
      unseen++;
    }
    distance[unseen] = distance[order[tail - 1]] + 2;
    order[tail++] = unseen;
  }
}

static void sli_levelset_bisect(sli_subgraph *sub) {
  const sl_int n = sub->n;
  sl_int *order = sub->scratch, *distance = sub->scratch + (size_t)n,
       *size = sub->scratch + 2 * (size_t)n;
  const sl_int low = (sl_int)((int64_t)n * SLI_LEVELSET_SHARE / 100), high = n - low;
  sl_int k, n_sets, before = 0, best = -1;
  int64_t cost = 0;
  const sl_int end = sli_subgraph_farthest(sub, 0, order, sub->locked);
  n_sets = sli_levelset_search(sub, sli_subgraph_farthest(sub, end, order, sub->locked), order,
                 distance);
  memset(size, 0, (size_t)n_sets * sizeof(sl_int));
  for (k = 0; k < n; k++) {
    size[distance[k]]++;
  }
  for (k = 0; k < n_sets; before += size[k++]) {
    const int64_t skew = n - size[k] - 2 * (int64_t)before;
    const int64_t here = (n + (skew < 0 ? -skew : skew)) * size[k];
    if (before >= low && before + size[k] <= high && (best == -1 || here < cost)) {
      best = k;
      cost = here;
    }
  }
  for (k = 0; k < n; k++) {
    sub->side[order[k]] = (unsigned char)(best == -1 ? k >= n / 2 : distance[order[k]] >= best);
  }
}

static void sli_dissect_levelset(sli_dissection *d) {
  const sli_level *g = &d->levels[0];
  sl_int node, nodes;
  d->level = 0;
  sli_dissect_start(d);
  do {
    nodes = d->tree.count;
    sli_dissect_sort(d);
    for (node = 0; node < nodes && d->tree.count < d->tree.room - 1; node++) {
      const sl_int count = d->begin[node + 1] - d->begin[node];
      if (count > d->leaf_size) {
        sli_subgraph_leaf(&d->subgraph, g, &d->tree, node, d->label,
                  d->order + d->begin[node], count);
        sli_levelset_bisect(&d->subgraph);
        sli_dissect_assign(d, node);
        sli_subgraph_clear(&d->subgraph);
      }
    }
    sli_label_tree_number(&d->tree, g->n, d->label);
  } while (d->tree.count > nodes);
}

static sl_int sli_dissect_root_border(const sli_dissection *d) {
  const sli_level *g = &d->levels[0];
  const sl_int root = d->tree.root;
  sl_int v, count = 0;
  sl_off e;
  for (v = 0; v < g->n; v++) {
    int crosses = 0;
    for (e = g->begin[v]; e < g->begin[v + 1] && d->label[v] < root; e++) {
      crosses |= d->label[g->to[e]] > root;
    }
    count += crosses;
  }
  return count;
}

#define SLI_VOLUME_BORDER 5

static int sli_dissect_may_be_volume(const sli_dissection *d) {
  const sli_level *g = &d->levels[0];
  return sli_exceeds_sqrt(2 * (int64_t)sli_dissect_root_border(d), SLI_VOLUME_BORDER,
              sli_level_is_wide(g) ? (sl_int)(g->begin[g->n] / 4) : g->n);
}

static sl_status sli_dissect_graph(sli_dissection *d) {
  sli_tree_cost multilevel, flat;
  sl_status status = sli_dissect_multilevel(d);
  if (status != SL_OK || !sli_dissect_may_be_volume(d)) {
    return status;
  }
  multilevel = sli_dissect_cost(d, &flat);
  sli_dissect_levelset(d);
  if (sli_tree_cost_is_less(sli_dissect_cost(d, &flat), multilevel)) {
    d->band_growth = 0;
    return SL_OK;
  }
  return sli_dissect_multilevel(d);
}

/* src/impl/ordering/geometric.h: nested dissection by coordinates, used where its estimated cost is lower */

typedef struct sli_points {
  const double *xyz;
  sl_int dimensions;
  const sl_int *row;
  double unit;
} sli_points;

SLI_INLINE double sli_points_unit(const double *xyz, size_t count) {
  double largest = 0.0;
  int exponent;
  size_t k;
  for (k = 0; k < count; k++) {
    largest = fabs(xyz[k]) > largest ? fabs(xyz[k]) : largest;
  }
  (void)frexp(largest, &exponent);
  return ldexp(1.0, exponent > 60 - DBL_MAX_EXP ? 60 - exponent : DBL_MAX_EXP - 1);
}

static const signed char sli_directions[9][3] = {{1, 0, 0},  {0, 1, 0}, {1, 1, 0},
                         {1, -1, 0}, {0, 0, 1}, {1, 0, 1},
                         {1, 0, -1}, {0, 1, 1}, {0, 1, -1}};

#define SLI_POINTS_MANY 16384
#define SLI_POINTS_TRIED 512
#define SLI_POINTS_FEW 128

SLI_INLINE int64_t sli_point_along(const sli_points *p, sl_int v, int direction) {
  const double *x = p->xyz + (size_t)p->row[v] * (size_t)p->dimensions;
  const signed char *along = sli_directions[direction];
  return along[0] * (int64_t)(x[0] * p->unit) + along[1] * (int64_t)(x[1] * p->unit) +
       (p->dimensions == 3 ? along[2] * (int64_t)(x[2] * p->unit) : 0);
}

static int sli_points_axis(const sli_points *p, const sl_int *vertices, sl_int count,
               int64_t *spread) {
  static const int sli_axes[3] = {0, 1, 4};
  const sl_int step = count / SLI_POINTS_FEW + 1;
  sl_int axis, k;
  int best = 0;
  *spread = -1;
  for (axis = 0; axis < p->dimensions; axis++) {
    int64_t low = sli_point_along(p, vertices[0], sli_axes[axis]), high = low;
    for (k = step; k < count; k = k < count - step ? k + step : count) {
      const int64_t x = sli_point_along(p, vertices[k], sli_axes[axis]);
      low = x < low ? x : low;
      high = x > high ? x : high;
    }
    if (high - low > *spread) {
      *spread = high - low;
      best = sli_axes[axis];
    }
  }
  return best;
}

typedef struct sli_projection {
  int64_t x;
  sl_int v;
} sli_projection;

SLI_INLINE int sli_projection_is_less(const sli_projection *a, const sli_projection *b) {
  return a->x < b->x || (a->x == b->x && a->v < b->v);
}

static void sli_projection_halve(sli_projection *a, sl_int count) {
  sl_int low = 0, high = count - 1;
  const sl_int half = count / 2;
  uint32_t turn = 1;
  while (low < high) {
    const uint32_t span = (uint32_t)(high - low) + 1u;
    const sli_projection pivot = a[low + (sl_int)(sli_hash32(turn++) % span)];
    sl_int i = low, j = high;
    while (i <= j) {
      while (sli_projection_is_less(&a[i], &pivot)) {
        i++;
      }
      while (sli_projection_is_less(&pivot, &a[j])) {
        j--;
      }
      if (i <= j) {
        const sli_projection keep = a[i];
        a[i++] = a[j];
        a[j--] = keep;
      }
    }
    if (half <= j) {
      high = j;
    } else if (half >= i) {
      low = i;
    } else {
      break;
    }
  }
}

static int sli_points_direction(const sli_points *p, const sl_int *vertices, sl_int count,
                sli_projection *projections) {
  int64_t spread;
  const int axis = sli_points_axis(p, vertices, count, &spread);
  int direction, best = axis;
  const int directions = p->dimensions == 3 ? 9 : 4;
  sl_int fewest = INT32_MAX, k;
  if (count < SLI_POINTS_MANY) {
    return best;
  }
  for (direction = 0; direction < directions; direction++) {
    const int is_diagonal = direction == 2 || direction == 3 || direction > 4;
    const int64_t close = spread / 1000 * (is_diagonal ? 141 : 100);
    int64_t middle;
    sl_int n_close = 0;
    for (k = 0; k < SLI_POINTS_TRIED; k++) {
      const sl_int v = vertices[(int64_t)k * count / SLI_POINTS_TRIED];
      projections[k].x = sli_point_along(p, v, direction);
      projections[k].v = v;
    }
    sli_projection_halve(projections, SLI_POINTS_TRIED);
    middle = projections[SLI_POINTS_TRIED / 2].x;
    for (k = 0; k < SLI_POINTS_TRIED; k++) {
      const int64_t away = projections[k].x - middle;
      n_close += (away < 0 ? -away : away) < close;
    }
    n_close += direction == axis ? 0 : n_close / 3;
    if (n_close < fewest) {
      fewest = n_close;
      best = direction;
    }
  }
  return best;
}

static void sli_points_sort(const sli_points *points, sl_int *vertices, sl_int count, sl_int small,
              sli_projection *projections) {
  while (count > small) {
    const int direction = sli_points_direction(points, vertices, count, projections);
    sl_int k;
    for (k = 0; k < count; k++) {
      projections[k].x = sli_point_along(points, vertices[k], direction);
      projections[k].v = vertices[k];
    }
    sli_projection_halve(projections, count);
    for (k = 0; k < count; k++) {
      vertices[k] = projections[k].v;
    }
    sli_points_sort(points, vertices, count / 2, small, projections);
    vertices += count / 2;
    count -= count / 2;
  }
}

static void sli_dissect_points(sli_dissection *d, const sl_int *sorted, sl_int leaf) {
  const sl_int n = d->levels[0].n;
  sl_int *begin = d->begin, *end = d->nodes, node, k;
  d->level = 0;
  sli_dissect_start(d);
  begin[0] = 0;
  end[0] = n;
  for (node = 0; node < d->tree.count; node++) {
    const sl_int first = begin[node], count = end[node] - first;
    d->tree.weight[node] = count;
    if (count <= leaf || d->tree.count >= d->tree.room - 1) {
      for (k = first; k < end[node]; k++) {
        d->label[sorted[k]] = node;
      }
      continue;
    }
    sli_label_tree_split(&d->tree, node);
    begin[d->tree.left[node]] = first;
    end[d->tree.left[node]] = begin[d->tree.right[node]] = first + count / 2;
    end[d->tree.right[node]] = first + count;
  }
  sli_label_tree_number(&d->tree, n, d->label);
}

/* src/impl/ordering/cells.h: are halves of space as good subgraphs as any? decided in a coarse graph of cells */

#define SLI_CELLS 1024
#define SLI_CELL_LEAST 64
#define SLI_CELLS_DEPTH 3

#define SLI_CELLS_SHARE 4

#define SLI_CELLS_AS_GOOD 105

#define SLI_CELLS_FLAT 110

#define SLI_LATTICE_SHARE 75
#define SLI_LATTICE_DEGREE 6
#define SLI_LATTICE_DEGREES 32

static int sli_is_lattice(const sli_level *g) {
  sl_int count[SLI_LATTICE_DEGREES] = {0}, v, most = 0;
  for (v = 0; v < g->n; v++) {
    const sl_off degree = g->begin[v + 1] - g->begin[v];
    if (degree >= SLI_LATTICE_DEGREE && degree < SLI_LATTICE_DEGREES) {
      count[degree]++;
      most = sli_max(most, count[degree]);
    }
  }
  return 100 * (int64_t)most >= SLI_LATTICE_SHARE * (int64_t)g->n;
}

static sl_int sli_cells_find(const sli_level *g, const sl_int *sorted, sl_int most, sl_int *cell,
               sli_clusters *parts) {
  sl_int end[SLI_LEVELS_MAX], depth = 1, first = 0, k, count = 0, head = 0, tail = 0;
  sl_off e;
  end[0] = g->n;
  while (depth > 0) {
    const sl_int size = end[depth - 1] - first;
    if (size > most) {
      end[depth++] = first + size / 2;
      continue;
    }
    for (k = first; k < first + size; k++) {
      cell[sorted[k]] = first;
      g->coarse[sorted[k]] = -1;
    }
    first = end[--depth];
  }
  for (k = 0; k < g->n; k++) {
    if (g->coarse[sorted[k]] != -1) {
      continue;
    }
    parts->start[count] = tail;
    g->coarse[sorted[k]] = count;
    parts->member[tail++] = sorted[k];
    for (; head < tail; head++) {
      const sl_int v = parts->member[head];
      for (e = g->begin[v]; e < g->begin[v + 1]; e++) {
        const sl_int u = g->to[e];
        if (g->coarse[u] == -1 && cell[u] == cell[v]) {
          g->coarse[u] = count;
          parts->member[tail++] = u;
        }
      }
    }
    count++;
  }
  parts->start[count] = tail;
  return count;
}

static sli_tree_cost sli_cells_cost(sli_dissection *d, const sl_int *label, sli_tree_cost *flat) {
  const sli_level *g = &d->levels[1];
  const sl_int n = d->levels[0].n;
  const sl_off edges = d->levels[0].begin[n] / 2;
  const uint64_t across = (uint64_t)(edges - n > n / 2 ? edges - n : n / 2);
  sli_tree_cost cost = {0, 0};
  sl_int *cut = d->nodes, k;
  sl_off e;
  memset(cut, 0, (size_t)d->tree.count * sizeof(sl_int));
  for (k = 0; k < g->n; k++) {
    for (e = g->begin[k]; e < g->begin[k + 1]; e++) {
      if (label[k] < label[g->to[e]]) {
        cut[sli_label_tree_lca(&d->tree, label[k], label[g->to[e]])] += g->edge[e];
      }
    }
  }
  *flat = cost;
  for (k = 0; k < d->tree.count; k++) {
    const uint64_t weight = (uint64_t)d->tree.weight[k];
    const uint64_t border = (uint64_t)cut[k] * (uint64_t)n / across;
    if (!sli_label_tree_is_leaf(&d->tree, k)) {
      sli_tree_cost_add(&cost, weight * border, border);
      sli_tree_cost_add(flat, weight, weight);
    }
  }
  return cost;
}

static sl_status sli_cells_compare(sli_dissection *d, const sl_int *sorted, int *is_good) {
  const sl_int n = d->levels[0].n, leaf = d->leaf_size;
  sl_int k, top = n;
  sli_tree_cost halves, graph, flat;
  sl_status status;
  for (k = 0; k < SLI_CELLS_DEPTH && top > leaf; k++) {
    top = top / 2 + 1;
  }
  sli_dissect_points(d, sorted, top);
  for (k = 0; k < n; k++) {
    d->other[d->levels[0].coarse[k]] = d->label[k];
  }
  halves = sli_cells_cost(d, d->other, &flat);
  *is_good = !sli_tree_cost_is_less(sli_tree_cost_times(flat, SLI_CELLS_FLAT),
                    sli_tree_cost_times(halves, 100));
  if (!*is_good) {
    return SL_OK;
  }
  d->leaf_size = top;
  status = sli_dissect_levels(d, 0);
  d->leaf_size = leaf;
  if (status == SL_OK) {
    graph = sli_cells_cost(d, d->label, &flat);
    *is_good = !sli_tree_cost_is_less(sli_tree_cost_times(graph, SLI_CELLS_AS_GOOD),
                      sli_tree_cost_times(halves, 100));
  }
  return status;
}

static sl_status sli_dissect_try_points(sli_dissection *d, const sl_int *sorted, sl_int cell,
                    int *is_good) {
  const sli_level *g = &d->levels[0];
  sli_clusters parts;
  sl_int count;
  sl_status status;
  parts.member = d->other;
  parts.start = d->begin;
  *is_good = 0;
  count = sli_cells_find(g, sorted, cell, d->label, &parts);
  if (count > g->n / SLI_CELLS_SHARE) {
    return SL_OK;
  }
  status = sli_coarsen_clusters(g, count, &parts, &d->levels[1], d->next, d->a);
  if (status == SL_OK) {
    d->n_levels = 2;
    status = sli_cells_compare(d, sorted, is_good);
    sli_dissect_free_levels(d);
  }
  return status;
}

static sl_status sli_dissect_geometric(sli_dissection *d, const sli_points *points,
                     sli_projection *projections) {
  const sl_int n = d->levels[0].n, cell = sli_max(SLI_CELL_LEAST, n / SLI_CELLS);
  sl_int *sorted = (sl_int *)(void *)projections, k;
  sli_tree_cost graph, flat;
  sl_status status;
  int is_good;
  if (!sli_is_lattice(&d->levels[0])) {
    return sli_dissect_graph(d);
  }
  for (k = 0; k < n; k++) {
    d->order[k] = k;
  }
  sli_points_sort(points, d->order, n, sli_min(cell, d->leaf_size), projections);
  memcpy(sorted, d->order, (size_t)n * sizeof(sl_int));
  status = sli_dissect_try_points(d, sorted, cell, &is_good);
  if (status == SL_OK && !is_good) {
    status = sli_dissect_graph(d);
    if (status != SL_OK || !sli_dissect_may_be_volume(d)) {
      return status;
    }
    graph = sli_dissect_cost(d, &flat);
    sli_dissect_points(d, sorted, d->leaf_size);
    if (!sli_tree_cost_is_less(sli_dissect_cost(d, &flat), graph)) {
      return sli_dissect_graph(d);
    }
  } else if (status == SL_OK) {
    sli_dissect_points(d, sorted, d->leaf_size);
  }
  d->band_growth = 0;
  return status;
}

/* src/impl/ordering/septree.h: from labels to the elimination order and the separator tree of all rows */

typedef struct sli_septree {
  sl_int count;
  sl_int *node_of;
  sl_int *parent;
} sli_septree;

static void sli_septree_sort_separator(sli_dissection *d, sl_int node, sl_int *vertices,
                     sl_int count) {
  const sli_level *g = &d->levels[0];
  uint64_t *list = (uint64_t *)(void *)d->next, *scratch = (uint64_t *)(void *)d->subgraph.begin;
  sl_int k;
  sl_off e;
  for (k = 0; k < count; k++) {
    int64_t sum = 0, touched = 0;
    for (e = g->begin[vertices[k]]; e < g->begin[vertices[k] + 1]; e++) {
      const sl_int other = d->label[g->to[e]];
      if (other < node && sli_label_tree_is_below(&d->tree, node, other)) {
        sum += other;
        touched++;
      }
    }
    list[k] = sli_keyed(touched == 0 ? 0 : (sl_int)(sum / touched), vertices[k]);
  }
  sli_sort(list, count, scratch);
  for (k = 0; k < count; k++) {
    vertices[k] = sli_value(list[k]);
  }
}

static void sli_septree_append(sli_dissection *d, const sl_int *row, sl_int *perm, sl_int at,
                 sli_septree *septree) {
  const sli_label_tree *t = &d->tree;
  sl_int node, k, up, *number = d->nodes;
  sli_dissect_sort(d);
  for (node = sli_label_tree_first(t); node != -1; node = sli_label_tree_next(t, node)) {
    const sl_int count = d->begin[node + 1] - d->begin[node];
    sl_int *mine = d->order + d->begin[node];
    if (!sli_label_tree_is_leaf(t, node)) {
      sli_septree_sort_separator(d, node, mine, count);
    } else if (count > 1) {
      sli_mindeg_order(&d->mindeg, &d->levels[0], mine, count, d->subgraph.local, d->other);
    }
    number[node] = count > 0 ? septree->count++ : -1;
    for (k = 0; k < count; k++) {
      perm[at++] = row[mine[k]];
      septree->node_of[row[mine[k]]] = number[node];
    }
  }
  for (node = 0; node < t->count; node++) {
    if (number[node] != -1) {
      for (up = t->parent[node]; up != -1 && number[up] == -1;) {
        up = t->parent[up];
      }
      septree->parent[number[node]] = up == -1 ? -1 : number[up];
    }
  }
}

/* src/impl/ordering/metis.h: the calls to METIS: the order of a connected component, and nested separators */

#if defined(SLI_METIS)

#include <metis.h>

static int sli_metis_options_are_valid(const sl_int *options) {
  static const struct {
    int option, low, high;
  } sli_ranges[] = {
    {METIS_OPTION_OBJTYPE, METIS_OBJTYPE_NODE, METIS_OBJTYPE_NODE},
    {METIS_OPTION_CTYPE, METIS_CTYPE_RM, METIS_CTYPE_SHEM},
    {METIS_OPTION_IPTYPE, METIS_IPTYPE_EDGE, METIS_IPTYPE_NODE},
    {METIS_OPTION_RTYPE, METIS_RTYPE_SEP2SIDED, METIS_RTYPE_SEP1SIDED},
    {METIS_OPTION_NITER, 1, INT32_MAX},
    {METIS_OPTION_COMPRESS, 0, 1},
    {METIS_OPTION_CCORDER, 0, 1},
    {METIS_OPTION_PFACTOR, 0, INT32_MAX},
    {METIS_OPTION_NSEPS, 1, INT32_MAX},
    {METIS_OPTION_UFACTOR, 1, 999},
  };
  size_t k;
  for (k = 0; options != NULL && k < sizeof sli_ranges / sizeof *sli_ranges; k++) {
    const sl_int value = options[sli_ranges[k].option];
    if (value != -1 && (value < sli_ranges[k].low || value > sli_ranges[k].high)) {
      return 0;
    }
  }
  return 1;
}

static void sli_metis_graph(const sli_graph *G, const sl_int *vertices, sl_int count,
              const sl_int *local, idx_t *xadj, idx_t *adjncy) {
  sl_int k;
  idx_t edges = 0;
  for (k = 0; k < count; k++) {
    const sl_int v = vertices[k];
    sl_off e;
    xadj[k] = edges;
    for (e = G->begin[v]; e < G->begin[v + 1]; e++) {
      adjncy[edges++] = local[G->to[e]];
    }
  }
  xadj[count] = edges;
}

static sl_status sli_metis_order(const sli_graph *G, sl_int *vertices, sl_int count,
                 const sl_int *local, const sl_int *metis_options,
                 const sl_allocator *a) {
  idx_t options[METIS_NOPTIONS], nv = (idx_t)count, *xadj = NULL, *adjncy = NULL, *perm = NULL,
                   *iperm = NULL;
  sli_block b = {NULL, 0, 0};
  sl_off edges = 0;
  sl_status status = SL_OK;
  sl_int k;
  int pass, result;
  for (k = 0; k < count; k++) {
    edges += G->begin[vertices[k] + 1] - G->begin[vertices[k]];
  }
  if (sizeof(idx_t) < sizeof(sl_off) && edges > INT32_MAX) {
    return SL_ERR_TOO_LARGE;
  }
  for (pass = 0; pass < 2 && status == SL_OK; pass++) {
    xadj = SLI_TAKE(&b, idx_t, (size_t)count + 1);
    adjncy = SLI_TAKE(&b, idx_t, edges);
    perm = SLI_TAKE(&b, idx_t, count);
    iperm = SLI_TAKE(&b, idx_t, count);
    status = pass == 0 ? sli_block_alloc(&b, a) : SL_OK;
  }
  if (status != SL_OK) {
    return status;
  }
  sli_metis_graph(G, vertices, count, local, xadj, adjncy);
  METIS_SetDefaultOptions(options);
  for (k = 0; metis_options != NULL && k < METIS_NOPTIONS; k++) {
    options[k] = metis_options[k];
  }
  options[METIS_OPTION_NUMBERING] = 0;
  options[METIS_OPTION_DBGLVL] = 0;
  result = METIS_NodeND(&nv, xadj, adjncy, NULL, options, perm, iperm);
  if (result == METIS_OK) {
    for (k = 0; k < count; k++) {
      xadj[k] = vertices[k];
    }
    for (k = 0; k < count; k++) {
      vertices[k] = (sl_int)xadj[perm[k]];
    }
  }
  sli_free(a, b.base);
  return result == METIS_OK             ? SL_OK
       : result == METIS_ERROR_MEMORY ? SL_ERR_MEMORY
                      : SL_ERR_ORDERING;
}

static sl_status sli_metis_separators(const sli_level *g, sl_int n_leaves, sl_int *order,
                    sl_int *sizes, const sl_allocator *a) {
  const sl_off edges = g->begin[g->n];
  idx_t options[METIS_NOPTIONS], *xadj = NULL, *adjncy = NULL, *perm = NULL, *iperm = NULL,
                   *size = NULL, *weight = NULL;
  sli_block b = {NULL, 0, 0};
  sl_status status = SL_OK;
  sl_off e;
  sl_int k;
  int pass, result;
  if (sizeof(idx_t) < sizeof(sl_off) && edges > INT32_MAX) {
    return SL_ERR_TOO_LARGE;
  }
  for (pass = 0; pass < 2 && status == SL_OK; pass++) {
    xadj = SLI_TAKE(&b, idx_t, (size_t)g->n + 1);
    adjncy = SLI_TAKE(&b, idx_t, edges);
    perm = SLI_TAKE(&b, idx_t, g->n);
    iperm = SLI_TAKE(&b, idx_t, g->n);
    size = SLI_TAKE(&b, idx_t, 2 * (size_t)n_leaves);
    weight = SLI_TAKE(&b, idx_t, g->weight != NULL ? g->n : 0);
    status = pass == 0 ? sli_block_alloc(&b, a) : SL_OK;
  }
  if (status != SL_OK) {
    return status;
  }
  memset(size, 0, 2 * (size_t)n_leaves * sizeof(idx_t));
  for (k = 0; k <= g->n; k++) {
    xadj[k] = (idx_t)g->begin[k];
  }
  for (e = 0; e < edges; e++) {
    adjncy[e] = g->to[e];
  }
  for (k = 0; k < g->n && g->weight != NULL; k++) {
    weight[k] = g->weight[k];
  }
  METIS_SetDefaultOptions(options);
  options[METIS_OPTION_NSEPS] = 2;
  result = METIS_NodeNDP((idx_t)g->n, xadj, adjncy, g->weight != NULL ? weight : NULL,
               (idx_t)n_leaves, options, perm, iperm, size);
  if (result == METIS_OK) {
    for (k = 0; k < g->n; k++) {
      order[k] = (sl_int)perm[k];
    }
    for (k = 0; k < 2 * n_leaves - 1; k++) {
      sizes[k] = (sl_int)size[k];
    }
  }
  sli_free(a, b.base);
  return result == METIS_OK             ? SL_OK
       : result == METIS_ERROR_MEMORY ? SL_ERR_MEMORY
                      : SL_ERR_ORDERING;
}

#endif

/* src/impl/ordering/metis_refined.h: a separator tree from METIS_NodeNDP, whose separators are refined later */

#if defined(SLI_METIS)

static void sli_metis_refined_tree(sli_dissection *d, sl_int n_leaves) {
  sl_int node;
  for (node = 0; node < n_leaves - 1; node++) {
    sli_label_tree_split(&d->tree, node);
  }
}

static sl_int sli_metis_refined_adjacent_leaf(const sli_dissection *d, sl_int node, sl_int v) {
  const sli_level *g = &d->levels[0];
  sl_off e;
  for (e = g->begin[v]; e < g->begin[v + 1]; e++) {
    const sl_int other = d->label[g->to[e]];
    if (sli_label_tree_is_leaf(&d->tree, other) &&
      sli_label_tree_is_below(&d->tree, node, other)) {
      return other;
    }
  }
  return -1;
}

static void sli_metis_refined_dissolve(sli_dissection *d, sl_int node, sl_int *vertices,
                     sl_int count) {
  sl_int k, left;
  do {
    left = 0;
    for (k = 0; k < count; k++) {
      const sl_int v = vertices[k], leaf = sli_metis_refined_adjacent_leaf(d, node, v);
      if (leaf != -1) {
        d->label[v] = leaf;
      } else {
        vertices[left++] = v;
      }
    }
    if (left == count) {
      for (k = 0; k < count; k++) {
        d->label[vertices[k]] = d->tree.low[node];
      }
      return;
    }
    count = left;
  } while (count > 0);
}

static sl_status sli_dissect_metis(sli_dissection *d) {
  const sli_level *g = &d->levels[0];
  sl_int n_leaves = 1, v, node, k, *sizes = d->begin, *size = d->nodes;
  sl_status status;
  while (d->total / n_leaves > d->leaf_size && n_leaves < g->n / 8) {
    n_leaves *= 2;
  }
  d->level = 0;
  status = sli_metis_separators(g, n_leaves, d->order, sizes, d->a);
  if (status != SL_OK) {
    return status;
  }
  sli_dissect_start(d);
  sli_metis_refined_tree(d, n_leaves);
  for (k = n_leaves, v = 0; k > 0; v += k, k /= 2) {
    for (node = 0; node < k; node++) {
      size[k - 1 + node] = sizes[v + node];
    }
  }
  node = sli_label_tree_first(&d->tree);
  for (k = 0; k < g->n; k++) {
    while (size[node] <= 0 && node != d->tree.root) {
      node = sli_label_tree_next(&d->tree, node);
    }
    d->label[d->order[k]] = node;
    size[node] -= sli_level_weight(g, d->order[k]);
  }
  memset(d->tree.weight, 0, (size_t)d->tree.count * sizeof(sl_int));
  sli_label_tree_number(&d->tree, g->n, d->label);
  sli_dissect_sort(d);
  for (node = sli_label_tree_first(&d->tree); node != -1;
     node = sli_label_tree_next(&d->tree, node)) {
    if (!sli_label_tree_is_leaf(&d->tree, node)) {
      sli_metis_refined_dissolve(d, node, d->order + d->begin[node],
                     d->begin[node + 1] - d->begin[node]);
    }
  }
  for (v = 0; v < g->n; v++) {
    for (node = d->label[v]; node != -1; node = d->tree.parent[node]) {
      d->tree.weight[node] += sli_level_weight(g, v);
    }
  }
  return SL_OK;
}

#define SLI_METIS_REFINED_SHARE 80

static sl_status sli_dissect_metis_refined(sli_dissection *d) {
  sli_tree_cost own, flat;
  sl_status status = sli_dissect_graph(d);
  if (status != SL_OK) {
    return status;
  }
  own = sli_dissect_cost(d, &flat);
  sli_dissect_set_bands(d, 1);
  status = sli_dissect_metis(d);
  if (status == SL_OK && sli_tree_cost_is_less(sli_tree_cost_times(own, 100),
                         sli_tree_cost_times(sli_dissect_cost(d, &flat),
                                   SLI_METIS_REFINED_SHARE))) {
    sli_dissect_set_bands(d, 2);
    status = sli_dissect_graph(d);
  }
  return status;
}

#endif

/* src/impl/ordering/nd.h: nested dissection of any graph: component by component, dense rows last */

#define SLI_ND_DENSE_ROW 10

#define SLI_ND_RESPLITS 12

typedef struct sli_nd {
  const sli_graph *G;
  const sl_int *weight;
  sli_points points;
  int by_metis;
  sl_int *local;
  sl_int *row;
  sl_off *begin;
  sl_int *to;
  sl_int *weights;
  sli_projection *projections;
  sli_dissection d;
} sli_nd;

static void sli_nd_layout(sli_nd *w, sli_block *b) {
  const sl_int n = w->G->n;
  const sl_off edges = w->G->begin[n];
  w->local = SLI_TAKE(b, sl_int, n);
  w->row = SLI_TAKE(b, sl_int, n);
  w->begin = SLI_TAKE(b, sl_off, (size_t)n + 1);
  w->to = SLI_TAKE(b, sl_int, edges);
  w->weights = SLI_TAKE(b, sl_int, w->weight != NULL ? n : 0);
  w->projections = SLI_TAKE(b, sli_projection, w->points.xyz != NULL ? n : 0);
  sli_dissection_layout(&w->d, b, n, edges);
}

static sl_int sli_nd_component(sli_nd *w, sl_int root) {
  const sli_graph *G = w->G;
  sl_int head, tail = 0;
  sl_off e;
  w->local[root] = tail;
  w->row[tail++] = root;
  for (head = 0; head < tail; head++) {
    for (e = G->begin[w->row[head]]; e < G->begin[w->row[head] + 1]; e++) {
      if (w->local[G->to[e]] == -1) {
        w->local[G->to[e]] = tail;
        w->row[tail++] = G->to[e];
      }
    }
  }
  return tail;
}

static void sli_nd_graph(sli_nd *w, sl_int count) {
  const sli_graph *G = w->G;
  sl_off e, edges = 0;
  sl_int k;
  for (k = 0; k < count; k++) {
    w->begin[k] = edges;
    for (e = G->begin[w->row[k]]; e < G->begin[w->row[k] + 1]; e++) {
      if (w->local[G->to[e]] >= 0) {
        w->to[edges++] = w->local[G->to[e]];
      }
    }
  }
  w->begin[count] = edges;
  w->d.levels[0].n = count;
  w->d.levels[0].begin = w->begin;
  w->d.levels[0].to = w->to;
  w->d.levels[0].weight = w->weight != NULL ? w->weights : NULL;
  w->d.total = count;
  if (w->weight != NULL) {
    w->d.total = 0;
    for (k = 0; k < count; k++) {
      w->weights[k] = w->weight[w->row[k]];
      w->d.total += w->weights[k];
    }
  }
}

static sl_status sli_nd_label(sli_nd *w) {
  sli_dissection *d = &w->d;
  sli_dissect_set_bands(d, 2);
  if (w->by_metis) {
#if defined(SLI_METIS)
    return sli_dissect_metis_refined(d);
#else
    return SL_ERR_UNSUPPORTED;
#endif
  }
  if (w->points.xyz != NULL) {
    return sli_dissect_geometric(d, &w->points, w->projections);
  }
  return sli_dissect_graph(d);
}

static sl_status sli_nd_dissect(sli_nd *w) {
  sli_dissection *d = &w->d;
  int rounds = SLI_ND_RESPLITS;
  sl_status status;
  d->level = 0;
  if (d->levels[0].n <= d->leaf_size) {
    sli_dissect_start(d);
    return SL_OK;
  }
  status = sli_nd_label(w);
  if (status == SL_OK) {
    do {
      sli_dissect_separate(d);
    } while (rounds-- > 0 && sli_dissect_split(d, 2 * d->leaf_size) > 0);
    status = d->borders.failed ? SL_ERR_MEMORY : SL_OK;
  }
  return status;
}

static sl_int sli_nd_dense(sli_nd *w, sl_int *perm) {
  const sli_graph *G = w->G;
  sl_int v, count = 0;
  for (v = G->n - 1; v >= 0; v--) {
    w->local[v] = -1;
    if (sli_exceeds_sqrt(G->begin[v + 1] - G->begin[v], SLI_ND_DENSE_ROW, G->n)) {
      w->local[v] = -2;
      perm[G->n - ++count] = v;
    }
  }
  return count;
}

static sl_status sli_nd_run(sli_nd *w, sl_int *perm, sli_septree *septree) {
  const sl_int n = w->G->n, dense = sli_nd_dense(w, perm);
  sl_int v, k, at = 0;
  sl_status status = SL_OK;
  septree->count = 0;
  for (v = 0; v < n; v++) {
    w->d.subgraph.local[v] = -1;
  }
  for (v = 0; v < n && status == SL_OK; v++) {
    if (w->local[v] == -1) {
      const sl_int count = sli_nd_component(w, v);
      if (count == 1) {
        perm[at++] = v;
        septree->node_of[v] = septree->count;
        septree->parent[septree->count++] = -1;
        continue;
      }
      sli_nd_graph(w, count);
      status = sli_nd_dissect(w);
      if (status == SL_OK) {
        sli_septree_append(&w->d, w->row, perm, at, septree);
        at += count;
      }
    }
  }
  if (dense > 0 && status == SL_OK) {
    for (k = 0; k < septree->count; k++) {
      septree->parent[k] = septree->parent[k] == -1 ? septree->count : septree->parent[k];
    }
    for (k = n - dense; k < n; k++) {
      septree->node_of[perm[k]] = septree->count;
    }
    septree->parent[septree->count++] = -1;
  }
  return status;
}

static sl_status sli_order_nd(const sli_graph *G, const sl_int *weight, int by_metis,
                const double *xyz, sl_int dimensions, sl_int *perm,
                sli_septree *septree, const sl_allocator *a) {
  sli_nd w;
  sli_block b = {NULL, 0, 0};
  sl_status status = SL_OK;
  int pass;
  memset(&w, 0, sizeof w);
  w.G = G;
  w.weight = weight;
  w.points.xyz = xyz;
  w.points.dimensions = dimensions;
  w.points.unit = xyz != NULL ? sli_points_unit(xyz, (size_t)G->n * (size_t)dimensions) : 1.0;
  w.by_metis = by_metis;
  w.d.leaf_size = by_metis ? SLI_DISSECT_LEAF_REFINED : SLI_DISSECT_LEAF;
  w.d.a = a;
  w.d.mindeg.has_popcnt = G->n > 256 && sli_cpu_best() != SL_ISA_SCALAR;
  for (pass = 0; pass < 2 && status == SL_OK; pass++) {
    sli_nd_layout(&w, &b);
    status = pass == 0 ? sli_block_alloc(&b, a) : SL_OK;
  }
  w.points.row = w.row;
  if (status == SL_OK) {
    sli_borders_init(&w.d.borders, a);
    status = sli_nd_run(&w, perm, septree);
    sli_free(a, w.d.borders.block);
    sli_free(a, b.base);
  }
  return status;
}

/* src/impl/ordering/compress.h: graph compression: indistinguishable rows are ordered as one vertex */

#define SLI_COMPRESS_SHARE 80

typedef struct sli_compressed {
  sli_graph G;
  sl_int *weight;
  sl_int *first;
  sl_int *number;
  sl_int *perm;
} sli_compressed;

static int sli_compress_is_indistinguishable(const sli_graph *G, sl_int u, sl_int v) {
  sl_off a = G->begin[u], b = G->begin[v];
  for (;;) {
    a += a < G->begin[u + 1] && G->to[a] == v;
    b += b < G->begin[v + 1] && G->to[b] == u;
    if (a == G->begin[u + 1] || b == G->begin[v + 1]) {
      return a == G->begin[u + 1] && b == G->begin[v + 1];
    }
    if (G->to[a++] != G->to[b++]) {
      return 0;
    }
  }
}

static sl_int sli_compress_find(const sli_graph *G, sl_int *first, uint32_t *key) {
  sl_int v, count = 0;
  sl_off e;
  for (v = 0; v < G->n; v++) {
    key[v] = sli_hash32((uint32_t)v);
    for (e = G->begin[v]; e < G->begin[v + 1]; e++) {
      key[v] += sli_hash32((uint32_t)G->to[e]);
    }
  }
  for (v = 0; v < G->n; v++) {
    first[v] = v;
    for (e = G->begin[v]; e < G->begin[v + 1] && G->to[e] < v; e++) {
      const sl_int u = G->to[e];
      if (key[u] == key[v] && first[u] == u && sli_compress_is_indistinguishable(G, u, v)) {
        first[v] = u;
        break;
      }
    }
    count += first[v] == v;
  }
  return count;
}

static void sli_compress_fill(sli_compressed *c, const sli_graph *G) {
  sl_int v, k = 0;
  sl_off e, edges = 0;
  for (v = 0; v < G->n; v++) {
    if (c->first[v] == v) {
      c->weight[k] = 0;
      c->number[v] = k++;
    }
    c->weight[c->number[c->first[v]]]++;
  }
  for (v = 0; v < G->n; v++) {
    if (c->first[v] != v) {
      continue;
    }
    c->G.begin[c->number[v]] = edges;
    for (e = G->begin[v]; e < G->begin[v + 1]; e++) {
      if (c->first[G->to[e]] == G->to[e]) {
        c->G.to[edges++] = c->number[G->to[e]];
      }
    }
  }
  c->G.begin[c->G.n] = edges;
}

static void sli_compress_expand(const sli_compressed *c, sl_int rows, sl_int *perm,
                sli_septree *septree, sl_int *start) {
  sl_int k, v, at = 0;
  for (k = 0; k < c->G.n; k++) {
    start[c->perm[k]] = at;
    at += c->weight[c->perm[k]];
  }
  for (v = 0; v < rows; v++) {
    perm[start[c->number[c->first[v]]]++] = v;
  }
  for (v = rows - 1; v >= 0; v--) {
    septree->node_of[v] = septree->node_of[c->number[c->first[v]]];
  }
}

static sl_status sli_order_compressed(const sli_graph *G, int by_metis, sl_int *perm,
                    sl_int *scratch, sli_septree *septree,
                    const sl_allocator *a) {
  sli_compressed c;
  sli_block b = {NULL, 0, 0};
  sl_status status = SL_OK;
  int pass;
  memset(&c, 0, sizeof c);
  c.G.n = sli_compress_find(G, scratch, (uint32_t *)(void *)perm);
  if (100 * (int64_t)c.G.n > SLI_COMPRESS_SHARE * (int64_t)G->n) {
    return sli_order_nd(G, NULL, by_metis, NULL, 0, perm, septree, a);
  }
  c.first = scratch;
  for (pass = 0; pass < 2 && status == SL_OK; pass++) {
    c.G.begin = SLI_TAKE(&b, sl_off, (size_t)c.G.n + 1);
    c.G.to = SLI_TAKE(&b, sl_int, G->begin[G->n]);
    c.weight = SLI_TAKE(&b, sl_int, c.G.n);
    c.number = SLI_TAKE(&b, sl_int, G->n);
    c.perm = SLI_TAKE(&b, sl_int, c.G.n);
    status = pass == 0 ? sli_block_alloc(&b, a) : SL_OK;
  }
  if (status != SL_OK) {
    return status;
  }
  sli_compress_fill(&c, G);
  status = sli_order_nd(&c.G, c.weight, by_metis, NULL, 0, c.perm, septree, a);
  if (status == SL_OK) {
    sli_compress_expand(&c, G->n, perm, septree, (sl_int *)(void *)c.G.begin);
  }
  sli_free(a, b.base);
  return status;
}

/* src/impl/ordering/quotient.h: approximate minimum degree ordering of a whole graph, kept as a quotient graph */

#define SLI_QUOTIENT_DENSE_ROW 10

#if !defined(SLI_MARKS_BEGIN)
#define SLI_MARKS_BEGIN 2
#endif

enum { SLI_QUOTIENT_PIVOT = -1, SLI_QUOTIENT_MERGED = -2 };

typedef struct sli_quotient {
  sl_int n;
  sl_off end, room;
  sl_int *list;
  sl_off *begin;
  sl_int *length;
  sl_int *elements;
  sl_int *weight;
  sl_int *degree;
  sl_int *mark;
  sl_int *head;
  sl_int *next;
  sl_int *previous;
  sl_int *bucket;
  sl_int *into;
  sl_int *sequence;
  sl_int live;
  sl_int pivots, rows;
  double flops;
  sl_int least;
  sl_int widest;
  sl_int base;
} sli_quotient;

static void sli_quotient_layout(sli_quotient *q, sli_block *b, sl_int n, sl_off edges) {
  q->n = n;
  q->room = edges + edges / 4 + n;
  q->begin = SLI_TAKE(b, sl_off, n);
  q->list = SLI_TAKE(b, sl_int, q->room);
  q->length = SLI_TAKE(b, sl_int, n);
  q->elements = SLI_TAKE(b, sl_int, n);
  q->weight = SLI_TAKE(b, sl_int, n);
  q->degree = SLI_TAKE(b, sl_int, n);
  q->mark = SLI_TAKE(b, sl_int, n);
  q->head = SLI_TAKE(b, sl_int, n);
  q->next = SLI_TAKE(b, sl_int, n);
  q->previous = SLI_TAKE(b, sl_int, n);
  q->bucket = SLI_TAKE(b, sl_int, n);
  q->into = SLI_TAKE(b, sl_int, n);
  q->sequence = SLI_TAKE(b, sl_int, n);
}

SLI_INLINE void sli_quotient_enqueue(sli_quotient *q, sl_int v) {
  const sl_int degree = q->degree[v], first = q->head[degree];
  q->next[v] = first;
  q->previous[v] = -1;
  if (first != -1) {
    q->previous[first] = v;
  }
  q->head[degree] = v;
  q->least = degree < q->least ? degree : q->least;
}

SLI_INLINE void sli_quotient_dequeue(sli_quotient *q, sl_int v) {
  const sl_int before = q->previous[v], after = q->next[v];
  if (after != -1) {
    q->previous[after] = before;
  }
  if (before != -1) {
    q->next[before] = after;
  } else {
    q->head[q->degree[v]] = after;
  }
}

static void sli_quotient_start(sli_quotient *q, const sli_graph *G, sl_int *perm) {
  const sl_off limit = (sl_off)SLI_QUOTIENT_DENSE_ROW * SLI_QUOTIENT_DENSE_ROW * G->n;
  sl_int v;
  sl_off e;
  q->live = q->n;
  q->pivots = q->rows = q->least = q->widest = 0;
  q->end = 0;
  q->flops = 0.0;
  q->base = SLI_MARKS_BEGIN;
  for (v = 0; v < q->n; v++) {
    const sl_off degree = G->begin[v + 1] - G->begin[v];
    const int is_dense = degree > 16 && degree * degree > limit;
    q->weight[v] = !is_dense;
    q->elements[v] = is_dense ? SLI_QUOTIENT_MERGED : 0;
    q->mark[v] = 1;
    q->head[v] = q->bucket[v] = q->into[v] = -1;
    if (is_dense) {
      perm[--q->live] = v;
    }
  }
  for (v = 0; v < q->n; v++) {
    q->begin[v] = q->end;
    for (e = G->begin[v]; e < G->begin[v + 1] && q->weight[v] != 0; e++) {
      if (q->weight[G->to[e]] != 0) {
        q->list[q->end++] = G->to[e];
      }
    }
    q->length[v] = q->degree[v] = (sl_int)(q->end - q->begin[v]);
  }
  for (v = q->n - 1; v >= 0; v--) {
    if (q->weight[v] != 0) {
      sli_quotient_enqueue(q, v);
    }
  }
}

static void sli_quotient_collect(sli_quotient *q) {
  sl_off from = 0, to = 0;
  sl_int v, k;
  for (v = 0; v < q->n; v++) {
    if (q->length[v] > 0) {
      const sl_off at = q->begin[v];
      q->begin[v] = q->list[at];
      q->list[at] = ~v;
    }
  }
  while (from < q->end) {
    v = q->list[from++];
    if (v >= 0) {
      continue;
    }
    v = ~v;
    q->list[to] = (sl_int)q->begin[v];
    q->begin[v] = to++;
    for (k = 1; k < q->length[v]; k++) {
      q->list[to++] = q->list[from++];
    }
  }
  q->end = to;
}

SLI_INLINE sl_off sli_quotient_gather(sli_quotient *q, sl_off from, sl_int count, sl_off to,
                    sl_int *total) {
  for (; count > 0; count--) {
    const sl_int v = q->list[from++], weight = q->weight[v];
    if (weight > 0) {
      q->weight[v] = -weight;
      *total += weight;
      q->list[to++] = v;
      sli_quotient_dequeue(q, v);
    }
  }
  return to;
}

SLI_INLINE void sli_quotient_absorb(sli_quotient *q, sl_int element, sl_int pivot) {
  q->mark[element] = 0;
  q->length[element] = 0;
  q->into[element] = pivot;
}

static sl_int sli_quotient_form(sli_quotient *q, sl_int pivot) {
  const sl_int elements = q->elements[pivot];
  sl_int total = 0, k;
  sl_off at, begin, to;
  q->elements[pivot] = SLI_QUOTIENT_PIVOT;
  q->weight[pivot] = -q->weight[pivot];
  if (elements == 0) {
    begin = q->begin[pivot];
    to = sli_quotient_gather(q, begin, q->length[pivot], begin, &total);
  } else {
    if (q->room - q->end < q->live - q->rows) {
      sli_quotient_collect(q);
    }
    at = q->begin[pivot];
    begin = to = q->end;
    for (k = 0; k < elements; k++) {
      const sl_int e = q->list[at + k];
      if (q->mark[e] != 0) {
        to = sli_quotient_gather(q, q->begin[e], q->length[e], to, &total);
        sli_quotient_absorb(q, e, pivot);
      }
    }
    to = sli_quotient_gather(q, at + elements, q->length[pivot] - elements, to, &total);
    q->begin[pivot] = begin;
    q->end = to;
  }
  q->length[pivot] = (sl_int)(to - begin);
  return total;
}

static void sli_quotient_overlaps(sli_quotient *q, sl_int pivot) {
  const sl_int *front = q->list + q->begin[pivot];
  sl_int k, p, v;
  if (q->base > INT32_MAX - 3 * (sl_off)q->n - 3) {
    for (v = 0; v < q->n; v++) {
      q->mark[v] = q->mark[v] != 0;
    }
    q->base = 2;
  }
  for (k = 0; k < q->length[pivot]; k++) {
    const sl_int weight = -q->weight[front[k]];
    const sl_int *elements = q->list + q->begin[front[k]];
    for (p = 0; p < q->elements[front[k]]; p++) {
      const sl_int e = elements[p], mark = q->mark[e];
      if (mark >= q->base) {
        q->mark[e] = mark - weight;
      } else if (mark != 0) {
        q->mark[e] = q->degree[e] + q->base - weight;
      }
    }
  }
}

static int sli_quotient_rewrite(sli_quotient *q, sl_int v, sl_int pivot) {
  sl_int *list = q->list + q->begin[v];
  const sl_int elements = q->elements[v], length = q->length[v];
  sl_int k, to = 0, degree = 0, first_variable;
  uint32_t hash = 0;
  for (k = 0; k < elements; k++) {
    const sl_int e = list[k], outside = q->mark[e] - q->base;
    if (q->mark[e] == 0) {
      continue;
    }
    if (outside > 0) {
      degree += outside;
      hash += (uint32_t)e;
      list[to++] = e;
    } else {
      sli_quotient_absorb(q, e, pivot);
    }
  }
  first_variable = to;
  for (k = elements; k < length; k++) {
    const sl_int u = list[k];
    if (q->weight[u] > 0) {
      degree += q->weight[u];
      hash += (uint32_t)u;
      list[to++] = u;
    }
  }
  if (to == 0) {
    return 0;
  }
  list[to] = list[first_variable];
  list[first_variable] = list[0];
  list[0] = pivot;
  q->elements[v] = first_variable + 1;
  q->length[v] = to + 1;
  q->degree[v] = degree < q->degree[v] ? degree : q->degree[v];
  hash %= (uint32_t)q->n;
  q->previous[v] = (sl_int)hash;
  q->next[v] = q->bucket[hash];
  q->bucket[hash] = v;
  return 1;
}

SLI_INLINE void sli_quotient_merge(sli_quotient *q, sl_int v, sl_int root) {
  q->into[v] = root;
  q->weight[root] += q->weight[v];
  q->weight[v] = 0;
  q->length[v] = 0;
  q->elements[v] = SLI_QUOTIENT_MERGED;
}

SLI_INLINE int sli_quotient_is_indistinguishable(const sli_quotient *q, sl_int u, sl_int v) {
  const sl_int *list = q->list + q->begin[v];
  sl_int k = 1;
  if (q->length[u] != q->length[v] || q->elements[u] != q->elements[v]) {
    return 0;
  }
  while (k < q->length[v] && q->mark[list[k]] == q->base) {
    k++;
  }
  return k == q->length[v];
}

static void sli_quotient_merge_chain(sli_quotient *q, sl_int u) {
  for (; u != -1 && q->next[u] != -1; u = q->next[u], q->base++) {
    const sl_int *list = q->list + q->begin[u];
    sl_int k, before = u, v = q->next[u];
    for (k = 1; k < q->length[u]; k++) {
      q->mark[list[k]] = q->base;
    }
    while (v != -1) {
      const sl_int after = q->next[v];
      if (sli_quotient_is_indistinguishable(q, u, v)) {
        sli_quotient_merge(q, v, u);
        q->next[before] = after;
      } else {
        before = v;
      }
      v = after;
    }
  }
}

static void sli_quotient_eliminate(sli_quotient *q, sl_int pivot) {
  const sl_int total = sli_quotient_form(q, pivot), count = q->length[pivot];
  sl_int *front = q->list + q->begin[pivot];
  sl_int k, kept = 0, left = total;
  double height;
  q->rows -= q->weight[pivot];
  sli_quotient_overlaps(q, pivot);
  for (k = 0; k < count; k++) {
    const sl_int v = front[k];
    if (!sli_quotient_rewrite(q, v, pivot)) {
      left += q->weight[v];
      q->rows -= q->weight[v];
      sli_quotient_merge(q, v, pivot);
    }
  }
  q->widest = total > q->widest ? total : q->widest;
  q->base += q->widest + 1;
  for (k = 0; k < count; k++) {
    if (q->weight[front[k]] != 0) {
      const sl_int hash = q->previous[front[k]], first = q->bucket[hash];
      q->bucket[hash] = -1;
      sli_quotient_merge_chain(q, first);
    }
  }
  for (k = 0; k < count; k++) {
    const sl_int v = front[k], weight = -q->weight[v];
    if (weight != 0) {
      q->weight[v] = weight;
      q->degree[v] = sli_min(q->degree[v] + left - weight, q->live - q->rows - weight);
      sli_quotient_enqueue(q, v);
      front[kept++] = v;
    }
  }
  q->weight[pivot] = -q->weight[pivot];
  q->degree[pivot] = left;
  q->mark[pivot] = kept > 0;
  q->end -= q->end == q->begin[pivot] + count ? count - kept : 0;
  q->length[pivot] = kept;
  q->sequence[q->pivots++] = pivot;
  height = 2.0 * left + q->weight[pivot];
  q->flops += height * height * q->weight[pivot];
}

static void sli_quotient_postorder(const sli_quotient *q, sl_int *start, sl_int *child,
                   sl_int *sibling) {
  sl_int k, v, at = 0, roots = -1;
  for (k = 0; k < q->pivots; k++) {
    child[q->sequence[k]] = -1;
  }
  for (k = q->pivots - 1; k >= 0; k--) {
    sl_int *list;
    v = q->sequence[k];
    list = q->into[v] == -1 ? &roots : &child[q->into[v]];
    sibling[v] = *list;
    *list = v;
  }
  for (v = roots; v != -1;) {
    while (child[v] != -1) {
      const sl_int c = child[v];
      child[v] = -1;
      v = c;
    }
    start[v] = at;
    at += q->weight[v];
    v = sibling[v] != -1 ? sibling[v] : q->into[v];
  }
}

static void sli_quotient_write(sli_quotient *q, sl_int *perm) {
  sl_int *start = q->head;
  sl_int v, k;
  sli_quotient_postorder(q, start, q->next, q->previous);
  for (k = 0; k < q->pivots; k++) {
    perm[start[q->sequence[k]]++] = q->sequence[k];
  }
  for (v = 0; v < q->n; v++) {
    sl_int root = v;
    if (q->elements[v] == SLI_QUOTIENT_PIVOT || q->into[v] == -1) {
      continue;
    }
    while (q->elements[root] != SLI_QUOTIENT_PIVOT) {
      root = q->into[root];
    }
    for (k = v; k != root;) {
      const sl_int up = q->into[k];
      q->into[k] = root;
      k = up;
    }
    perm[start[root]++] = v;
  }
}

static sl_status sli_order_mindeg(const sli_graph *G, sl_int *perm, double *flops,
                  const sl_allocator *a) {
  sli_quotient q;
  sli_block b = {NULL, 0, 0};
  sl_status status = SL_OK;
  sl_int pivot;
  int pass;
  memset(&q, 0, sizeof q);
  for (pass = 0; pass < 2 && status == SL_OK; pass++) {
    sli_quotient_layout(&q, &b, G->n, G->begin[G->n]);
    status = pass == 0 ? sli_block_alloc(&b, a) : SL_OK;
  }
  if (status != SL_OK) {
    return status;
  }
  sli_quotient_start(&q, G, perm);
  while (q.rows < q.live) {
    while (q.head[q.least] == -1) {
      q.least++;
    }
    pivot = q.head[q.least];
    sli_quotient_dequeue(&q, pivot);
    sli_quotient_eliminate(&q, pivot);
  }
  sli_quotient_write(&q, perm);
  *flops = 0.25 * q.flops;
  sli_free(a, b.base);
  return SL_OK;
}

/* src/impl/ordering/order.h: the elimination order: natural, given, or fill-reducing */

static void sli_order_natural(sl_int n, sl_int *perm) {
  sl_int k;
  for (k = 0; k < n; k++) {
    perm[k] = k;
  }
}

static sl_status sli_order_given(const sl_int *given, sl_int n, sl_int *perm, sl_int *scratch,
                 sl_stats *stats) {
  sl_int bad;
  if (given == NULL && n > 0) {
    return SL_ERR_ARGUMENT;
  }
  bad = sli_perm_invert(given, n, scratch);
  if (bad >= 0) {
    return sli_fail_at(stats, SL_ERR_ARGUMENT, bad, -1, 0.0);
  }
  if (n > 0) {
    memcpy(perm, given, (size_t)n * sizeof(sl_int));
  }
  return SL_OK;
}

#if defined(SLI_METIS)
#define SLI_ORDER_TINY 4

static sl_status sli_order_metis(const sli_graph *G, const sl_int *metis_options, sl_int *perm,
                 sl_int *local, const sl_allocator *a) {
  sl_int root, head, tail = 0, start;
  sl_status status = SL_OK;
  for (root = 0; root < G->n; root++) {
    local[root] = -1;
  }
  for (root = 0; root < G->n && status == SL_OK; root++) {
    if (local[root] >= 0) {
      continue;
    }
    start = tail;
    local[root] = 0;
    perm[tail++] = root;
    for (head = start; head < tail; head++) {
      sl_off e;
      for (e = G->begin[perm[head]]; e < G->begin[perm[head] + 1]; e++) {
        const sl_int u = G->to[e];
        if (local[u] < 0) {
          local[u] = tail - start;
          perm[tail++] = u;
        }
      }
    }
    if (tail - start > SLI_ORDER_TINY) {
      status = sli_metis_order(G, perm + start, tail - start, local, metis_options, a);
    }
  }
  return status;
}

#endif

static sl_status sli_order_canonical(sli_graph *G, const sl_allocator *a) {
  const sl_off edges = G->begin[G->n];
  sli_block b = {NULL, 0, 0};
  sl_int *to = NULL;
  sl_off *at = NULL;
  sl_status status = SL_OK;
  int pass;
  if (sli_graph_is_sorted(G)) {
    return SL_OK;
  }
  for (pass = 0; pass < 2 && status == SL_OK; pass++) {
    to = SLI_TAKE(&b, sl_int, edges);
    at = SLI_TAKE(&b, sl_off, G->n);
    status = pass == 0 ? sli_block_alloc(&b, a) : SL_OK;
  }
  if (status == SL_OK) {
    sli_graph_sort(G, to, at);
    memcpy(G->to, to, (size_t)edges * sizeof(sl_int));
    sli_graph_deduplicate(G);
    sli_free(a, b.base);
  }
  return status;
}

static void sli_order_expand(sl_int blocks, sl_int block, sl_int *perm, sli_septree *septree) {
  sl_int k, c;
  for (k = blocks - 1; k >= 0; k--) {
    const sl_int v = perm[k], node = septree->count > 0 ? septree->node_of[k] : 0;
    for (c = block - 1; c >= 0; c--) {
      perm[k * block + c] = v * block + c;
      septree->node_of[k * block + c] = node;
    }
  }
}

#define SLI_ORDER_ND_FLOPS 5000.0

static sl_status sli_order_graph(const sli_graph *G, sl_ordering ordering, const sl_options *opt,
                 sl_int *perm, sl_int *scratch, sli_septree *septree,
                 const sl_allocator *a) {
  const double *xyz = ordering == SL_ORDERING_ND && opt != NULL ? opt->coordinates : NULL;
  const int is_hurried = ordering == SL_ORDERING_ND && opt != NULL && xyz == NULL &&
               opt->purpose == SL_PURPOSE_ONE_FACTOR;
#if defined(SLI_METIS)
  if (ordering == SL_ORDERING_METIS) {
    return sli_order_metis(G, opt->metis_options, perm, scratch, a);
  }
#endif
  if (ordering == SL_ORDERING_MINDEG || is_hurried) {
    double flops = 0.0;
    const sl_status status = sli_order_mindeg(G, perm, &flops, a);
    if (status != SL_OK || ordering == SL_ORDERING_MINDEG ||
      0.5 * flops <= SLI_ORDER_ND_FLOPS * (double)G->begin[G->n]) {
      return status;
    }
  }
  return xyz != NULL ? sli_order_nd(G, NULL, 0, xyz, opt->dimensions, perm, septree, a)
             : sli_order_compressed(G, ordering == SL_ORDERING_METIS_REFINED, perm,
                        scratch, septree, a);
}

static int sli_order_has_diagonal(const sl_csc *A, sl_int j) {
  sl_int p = A->p[j];
  while (p < A->p[j + 1] && A->i[p] != j) {
    p++;
  }
  return p < A->p[j + 1];
}

static void sli_order_border(const sl_csc *A, const sli_graph *G, sl_int *perm, sl_int *position,
               sli_septree *septree) {
  sl_int k, v, last;
  sl_off e;
  for (k = 0; k < G->n; k++) {
    position[perm[k]] = k;
  }
  for (k = 0; k < G->n; k++) {
    const sl_int row = perm[k];
    const sl_off degree = G->begin[row + 1] - G->begin[row];
    if (degree < 8 || degree * degree < G->n || sli_order_has_diagonal(A, row)) {
      continue;
    }
    last = -1;
    for (e = G->begin[row]; e < G->begin[row + 1]; e++) {
      last = sli_max(last, position[G->to[e]]);
    }
    if (last > k) {
      continue;
    }
    v = perm[last];
    for (; last < k; last++) {
      perm[last] = perm[last + 1];
      position[perm[last]] = last;
    }
    perm[k] = v;
    position[v] = k;
    septree->count = 0;
  }
}

typedef struct sli_order_choice {
  sl_int *other;
  int is_wanted, is_there;
} sli_order_choice;

static int sli_order_is_irregular(const sli_graph *G) {
  uint64_t squares = 0, mean;
  sl_int v;
  if (G->n == 0 || G->begin[G->n] / G->n >= 1024) {
    return 0;
  }
  for (v = 0; v < G->n; v++) {
    const uint64_t degree = (uint64_t)(G->begin[v + 1] - G->begin[v]);
    squares += degree < 1024 ? degree * degree : 1024 * 1024;
  }
  mean = 16 * (uint64_t)G->begin[G->n] / (uint64_t)G->n;
  return mean > 0 && 5 * 256 * squares >= 6 * mean * mean * (uint64_t)G->n;
}

static sl_status sli_order_by_graph(const sl_csc *A, sl_triangle triangle, sl_ordering ordering,
                  const sl_options *opt, sl_int *perm, sl_int *scratch,
                  sli_septree *septree, sli_order_choice *choice,
                  const sl_allocator *a) {
  const sl_int block = opt != NULL && opt->block_size > 1 ? opt->block_size : 1;
  sli_graph G;
  sli_block b = {NULL, 0, 0};
  sl_status status = SL_OK;
  int pass;
  memset(&G, 0, sizeof G);
  for (pass = 0; pass < 2 && status == SL_OK; pass++) {
    G.n = A->n_cols / block;
    G.begin = SLI_TAKE(&b, sl_off, (size_t)G.n + 1);
    G.to = SLI_TAKE(&b, sl_int, 2 * (size_t)sli_nnz(A));
    status = pass == 0 ? sli_block_alloc(&b, a) : SL_OK;
  }
  if (status != SL_OK) {
    return status;
  }
  sli_graph_fill(&G, A, triangle, block);
  status = sli_order_canonical(&G, a);
  if (status == SL_OK) {
    status = sli_order_graph(&G, ordering, opt, perm, scratch, septree, a);
  }
  if (status == SL_OK && block > 1) {
    sli_order_expand(G.n, block, perm, septree);
  } else if (status == SL_OK) {
    sli_order_border(A, &G, perm, scratch, septree);
  }
  if (status == SL_OK && choice->is_wanted && block == 1 && sli_order_is_irregular(&G)) {
    sli_septree none;
    double flops;
    status = sli_order_mindeg(&G, choice->other, &flops, a);
    if (status == SL_OK) {
      sli_order_border(A, &G, choice->other, scratch, &none);
      choice->is_there = 1;
    }
  }
  sli_free(a, b.base);
  return status;
}

static int sli_order_options_are_valid(const sl_options *opt, sl_int n, sl_int *bad) {
  sl_int v, k;
  *bad = -1;
  if (opt == NULL) {
    return 1;
  }
  if ((opt->purpose != SL_PURPOSE_MANY_SOLVES && opt->purpose != SL_PURPOSE_ONE_FACTOR) ||
    opt->block_size < 0 || (opt->block_size > 1 && n % opt->block_size != 0) ||
    (opt->coordinates != NULL && opt->dimensions != 2 && opt->dimensions != 3)) {
    return 0;
  }
  for (v = 0; opt->coordinates != NULL && v < n / sli_max(opt->block_size, 1); v++) {
    for (k = 0; k < opt->dimensions; k++) {
      if (!sli_is_finite(opt->coordinates[(size_t)v * (size_t)opt->dimensions + (size_t)k])) {
        *bad = v * sli_max(opt->block_size, 1);
        return 0;
      }
    }
  }
  return 1;
}

static sl_status sli_order(const sl_csc *A, sl_triangle triangle, const sl_options *opt,
               sl_int *perm, sl_int *scratch, sli_septree *septree,
               sli_order_choice *choice, const sl_allocator *a, sl_stats *stats) {
  const sl_ordering ordering = opt != NULL ? opt->ordering : SL_ORDERING_ND;
  sl_int bad;
  septree->count = 0;
  choice->is_there = 0;
  choice->is_wanted =
    ordering == SL_ORDERING_ND &&
    (opt == NULL || (opt->coordinates == NULL && opt->purpose == SL_PURPOSE_MANY_SOLVES));
  if (!sli_order_options_are_valid(opt, A->n_cols, &bad)) {
    return bad == -1 ? SL_ERR_ARGUMENT : sli_fail_at(stats, SL_ERR_NOT_FINITE, bad, -1, 0.0);
  }
  switch (ordering) {
  case SL_ORDERING_GIVEN:
    return sli_order_given(opt->perm, A->n_cols, perm, scratch, stats);
  case SL_ORDERING_NATURAL:
    sli_order_natural(A->n_cols, perm);
    return SL_OK;
  case SL_ORDERING_ND:
  case SL_ORDERING_MINDEG:
    return sli_order_by_graph(A, triangle, ordering, opt, perm, scratch, septree, choice, a);
  case SL_ORDERING_METIS:
  case SL_ORDERING_METIS_REFINED:
#if !defined(SLI_METIS)
    return SL_ERR_UNSUPPORTED;
#else
    return ordering == SL_ORDERING_METIS && !sli_metis_options_are_valid(opt->metis_options)
           ? SL_ERR_ARGUMENT
           : sli_order_by_graph(A, triangle, ordering, opt, perm, scratch, septree, choice,
                    a);
#endif
  default:
    return SL_ERR_ARGUMENT;
  }
}

/* analysis: elimination tree, supernodes, structure of L; never sees a value */
/* src/impl/analysis/symbolic_types.h: the analysis object, filled by this layer and read by all later ones */

struct sl_symbolic {
  sl_allocator allocator;
  sl_stats stats;
  sl_int n;
  sl_int n_supers;
  sl_int nnz_input;
  sli_hash pattern;
  sli_hash identity;
  sl_int tallest, widest;
  sl_int *perm, *iperm;
  sl_int *parent;
  int is_pivoted;
  sl_int n_pairs;
  unsigned char *pairs;
  sl_int *counts;
  sl_int *super_of;
  sl_int *super_first;
  sl_int *super_parent;
  sl_off *rows_begin;
  sl_int *rows;
  sl_off *panel_begin;
  sli_step *steps;
  sl_int *first_descendant;
  sl_int *relative;
  sl_off *scatter_begin;
  sl_int *scatter_from;
  sl_off *scatter_to;
  sl_int n_nodes;
  sl_int *node_of;
  sl_int *node_parent, *node_level;
  sli_mapping mapping;
  int is_partial;
  sl_off ordered_l, ordered_a;
};

/* src/impl/analysis/etree.h: elimination tree, postorder, and renumbering of the columns */

static void sli_etree(sl_int n, const sli_pattern *rows, sl_int *parent, sl_int *ancestor) {
  sl_int k, p;
  for (k = 0; k < n; k++) {
    parent[k] = -1;
    ancestor[k] = -1;
    for (p = rows->begin[k]; p < rows->begin[k + 1]; p++) {
      sl_int i = rows->to[p];
      while (i != -1 && i < k) {
        const sl_int next = ancestor[i];
        ancestor[i] = k;
        if (next == -1) {
          parent[i] = k;
        }
        i = next;
      }
    }
  }
}

static void sli_postorder(const sl_int *parent, sl_int n, sl_int *post, sl_int *child,
              sl_int *sibling) {
  sl_int j, k = 0, root;
  for (j = 0; j < n; j++) {
    child[j] = -1;
  }
  for (j = n - 1; j >= 0; j--) {
    if (parent[j] != -1) {
      sibling[j] = child[parent[j]];
      child[parent[j]] = j;
    }
  }
  for (root = 0; root < n; root++) {
    if (parent[root] != -1) {
      continue;
    }
    j = root;
    for (;;) {
      while (child[j] != -1) {
        const sl_int c = child[j];
        child[j] = sibling[c];
        j = c;
      }
      post[k++] = j;
      if (j == root) {
        break;
      }
      j = parent[j];
    }
  }
}

static void sli_relabel(const sl_int *order, sl_int n, sl_int *old_of, sl_int *new_of,
            sl_int *parent, sl_int *scratch) {
  sl_int *fresh = scratch, *number = scratch + n, k;
  for (k = 0; k < n; k++) {
    fresh[k] = old_of[order[k]];
    number[order[k]] = k;
  }
  if (n > 0) {
    memcpy(old_of, fresh, (size_t)n * sizeof(sl_int));
  }
  for (k = 0; k < n; k++) {
    const sl_int old = parent[order[k]];
    new_of[old_of[k]] = k;
    fresh[k] = old == -1 ? -1 : number[old];
  }
  if (n > 0) {
    memcpy(parent, fresh, (size_t)n * sizeof(sl_int));
  }
}

/* src/impl/analysis/counts.h: column counts of L in nearly O(nnz(A)), from the leaves of the row subtrees */

static void sli_counts(sl_int n, const sli_pattern *columns, const sl_int *old_of,
             const sl_int *new_of, const sl_int *parent, sl_int *counts,
             sl_int *scratch) {
  sl_int *first = scratch, *seen = scratch + n, *leaf = scratch + 2 * (size_t)n,
       *set = scratch + 3 * (size_t)n;
  sl_int i, j, p;
  for (j = 0; j < n; j++) {
    first[j] = j;
    seen[j] = -1;
    leaf[j] = -1;
    set[j] = j;
  }
  for (j = 0; j < n; j++) {
    counts[j] = first[j] == j;
    if (parent[j] != -1) {
      first[parent[j]] = sli_min(first[parent[j]], first[j]);
    }
  }
  for (j = 0; j < n; j++) {
    const sl_int end = columns->begin[old_of[j] + 1];
    if (parent[j] != -1) {
      counts[parent[j]]--;
    }
    for (p = columns->begin[old_of[j]]; p < end; p++) {
      i = new_of[columns->to[p]];
      if (i <= j || first[j] <= seen[i]) {
        continue;
      }
      counts[j]++;
      seen[i] = first[j];
      if (leaf[i] != -1) {
        sl_int root = leaf[i], q = leaf[i];
        while (root != set[root]) {
          root = set[root];
        }
        while (q != root) {
          const sl_int up = set[q];
          set[q] = root;
          q = up;
        }
        counts[root]--;
      }
      leaf[i] = j;
    }
    if (parent[j] != -1) {
      set[j] = parent[j];
    }
  }
  for (j = 0; j < n; j++) {
    if (parent[j] != -1) {
      counts[parent[j]] += counts[j];
    }
  }
}

/* src/impl/analysis/supernodes.h: fundamental supernodes, and relaxed amalgamation over the whole assembly tree */

typedef struct sli_amalgamation {
  sl_int count;
  sl_int *first;
  sl_int *parent;
  sl_int *width;
  sl_int *below;
  sl_off *zeros;
  sl_int *merged_into;
  unsigned char *is_tied;
  int relaxes;
} sli_amalgamation;

static void sli_fundamental(sl_int n, const sl_int *parent, const sl_int *counts, sl_int *children,
              sl_int *super_of, sli_amalgamation *g) {
  sl_int j, s = -1;
  memset(children, 0, (size_t)n * sizeof(sl_int));
  for (j = 0; j < n; j++) {
    if (parent[j] != -1) {
      children[parent[j]]++;
    }
  }
  for (j = 0; j < n; j++) {
    if (j == 0 || parent[j - 1] != j || children[j] != 1 || counts[j - 1] != counts[j] + 1) {
      g->first[++s] = j;
    }
    super_of[j] = s;
  }
  g->count = s + 1;
  g->first[g->count] = n;
  for (s = 0; s < g->count; s++) {
    const sl_int last = g->first[s + 1] - 1;
    g->width[s] = g->first[s + 1] - g->first[s];
    g->below[s] = counts[last] - 1;
    g->parent[s] = parent[last] == -1 ? -1 : super_of[parent[last]];
    g->zeros[s] = 0;
    g->merged_into[s] = s;
  }
}

#define SLI_ZEROS_SMALL 70

static int sli_may_merge(sl_int width, sl_off zeros, sl_off stored) {
  const sl_off percent = width <= 8 ? SLI_ZEROS_SMALL : width <= 16 ? 30 : width <= 48 ? 15 : 5;
  return zeros < stored / 100 * percent + (stored % 100 * percent + 99) / 100;
}

static sl_off sli_new_zeros(const sli_amalgamation *g, sl_int c, sl_int p) {
  return (sl_off)g->width[c] * (g->width[p] + g->below[p] - g->below[c]);
}

static void sli_amalgamate_children(sli_amalgamation *g, sl_int p, uint64_t *list, sl_int count,
                  uint64_t *scratch) {
  sl_int k;
  for (k = 0; k < count; k++) {
    const sl_int c = sli_value(list[k]);
    const sl_off cost = sli_new_zeros(g, c, p);
    list[k] = sli_keyed(cost < INT32_MAX ? (sl_int)cost : INT32_MAX, c); /* untested: 2^31 */
  }
  sli_sort(list, count, scratch);
  for (k = 0; k < count; k++) {
    const sl_int c = sli_value(list[k]), width = g->width[c] + g->width[p];
    const sl_off zeros = g->zeros[c] + g->zeros[p] + sli_new_zeros(g, c, p);
    const sl_off stored = (sl_off)width * (width + 1) / 2 + (sl_off)width * g->below[p];
    if ((g->is_tied != NULL && g->is_tied[c]) ||
      (g->relaxes && sli_may_merge(width, zeros, stored))) {
      g->width[p] = width;
      g->zeros[p] = zeros;
      g->merged_into[c] = p;
    }
  }
}

static void sli_amalgamate(sli_amalgamation *g, sl_int *child, sl_int *sibling, uint64_t *list,
               uint64_t *scratch) {
  sl_int s, c, count;
  for (s = 0; s < g->count; s++) {
    child[s] = -1;
  }
  for (s = 0; s < g->count; s++) {
    count = 0;
    for (c = child[s]; c != -1; c = sibling[c]) {
      list[count++] = sli_keyed(0, c);
    }
    if (count > 0) {
      sli_amalgamate_children(g, s, list, count, scratch);
    }
    if (g->parent[s] != -1) {
      sibling[s] = child[g->parent[s]];
      child[g->parent[s]] = s;
    }
  }
}

static sl_int sli_find_tops(sli_amalgamation *g, sl_int n, const sl_int *sequence,
              const sl_int *super_of, sl_int *top, sl_int *tree, sl_int *number) {
  sl_int s, k, count = 0;
  for (s = g->count - 1; s >= 0; s--) {
    g->merged_into[s] = g->merged_into[s] == s ? s : g->merged_into[g->merged_into[s]];
  }
  for (k = 0; k < n; k++) {
    const sl_int column = sequence == NULL ? k : sequence[k];
    s = super_of[column];
    if (g->merged_into[s] == s && column == g->first[s + 1] - 1) {
      number[s] = count;
      top[count++] = s;
    }
  }
  for (k = 0; k < count; k++) {
    const sl_int up = g->parent[top[k]];
    tree[k] = up == -1 ? -1 : number[g->merged_into[up]];
  }
  for (s = 0; s < g->count; s++) {
    g->merged_into[s] = number[g->merged_into[s]];
  }
  return count;
}

static void sli_number_supernodes(sli_amalgamation *g, sl_int n, const sl_int *sequence,
                  sl_int *order, sl_int *super_of, sl_int *scratch) {
  sl_int *top = scratch, *tree = scratch + n, *post = scratch + 2 * (size_t)n,
       *at = scratch + 3 * (size_t)n, *number = scratch + 4 * (size_t)n;
  const sl_int count = sli_find_tops(g, n, sequence, super_of, top, tree, at);
  sl_int k, c, column = 0;
  sli_postorder(tree, count, post, at, number);
  for (k = 0; k < count; k++) {
    number[post[k]] = k;
    at[post[k]] = column;
    column += g->width[top[post[k]]];
  }
  for (k = 0; k < n; k++) {
    const sl_int from = sequence == NULL ? k : sequence[k];
    order[at[g->merged_into[super_of[from]]]++] = from;
  }
  for (k = 0; k < count; k++) {
    at[k] = g->width[top[post[k]]];
    g->merged_into[k] = g->below[top[post[k]]];
  }
  column = 0;
  for (k = 0; k < count; k++) {
    g->first[k] = column;
    g->width[k] = at[k];
    g->below[k] = g->merged_into[k];
    g->parent[k] = tree[post[k]] == -1 ? -1 : number[tree[post[k]]];
    for (c = 0; c < at[k]; c++) {
      super_of[column++] = k;
    }
  }
  g->first[count] = n;
  g->count = count;
}

SLI_INLINE sl_int sli_part_end(const unsigned char *is_first, sl_int from, sl_int end) {
  sl_int k;
  for (k = from + SLI_TILE - 1; k < end && !is_first[k]; k += SLI_TILE) {
  }
  return sli_min(k, end);
}

static sl_int sli_find_parts(const sli_amalgamation *g, const unsigned char *is_first,
               sl_int *first, sl_int *below, sl_int *part) {
  sl_int s, k, count = 0;
  for (s = 0; s < g->count; s++) {
    for (k = g->first[s]; k < g->first[s + 1]; count++) {
      const sl_int end = sli_part_end(is_first, k, g->first[s + 1]);
      first[count] = k;
      below[count] = g->first[s + 1] - end + g->below[s];
      for (; k < end; k++) {
        part[k] = count;
      }
    }
  }
  return count;
}

static int sli_split_pairs(sli_amalgamation *g, sl_int n, const sl_int *parent,
               const unsigned char *is_first, sl_int *super_of, sl_int *earlier,
               sl_int *order, sl_int *scratch) {
  sl_int *tree = scratch, *post = tree + n, *number = post + n, *below = number + n;
  sl_int *first = g->merged_into;
  const sl_int count = sli_find_parts(g, is_first, first, below, order);
  sl_int s, k, c, column = 0;
  for (k = 0; k < n; k++) {
    earlier[k] = -1;
  }
  if (count == g->count) {
    return 0;
  }
  for (s = 0; s < count; s++) {
    const sl_int end = s + 1 < count ? first[s + 1] : n, up = parent[end - 1];
    const int continues = end < n && super_of[end] == super_of[end - 1];
    tree[s] = continues ? s + 1 : up == -1 ? -1 : order[up];
  }
  sli_postorder(tree, count, post, number, below + n);
  for (k = 0; k < count; k++) {
    number[post[k]] = k;
  }
  for (k = 0; k < count; k++) {
    const sl_int end = post[k] + 1 < count ? first[post[k] + 1] : n;
    s = post[k];
    if (end < n && super_of[end] == super_of[end - 1]) {
      earlier[number[s + 1]] = k;
    }
    g->first[k] = column;
    g->width[k] = end - first[s];
    g->below[k] = below[s];
    g->parent[k] = tree[s] == -1 ? -1 : number[tree[s]];
    for (c = first[s]; c < end; c++) {
      order[column++] = c;
    }
  }
  g->first[count] = n;
  g->count = count;
  for (k = 0; k < count; k++) {
    for (c = g->first[k]; c < g->first[k + 1]; c++) {
      super_of[c] = k;
    }
  }
  return 1;
}

/* src/impl/analysis/structure.h: rows of the supernodes, relative indices, and the scatter map of A into L */

static void sli_scatter_map_count(sl_symbolic *S, const sli_pattern *columns,
                  const sl_int *old_of) {
  sl_int s, k = 0;
  sl_off total = 0;
  for (s = 0; s < S->n_supers; s++) {
    S->scatter_begin[s] = total;
    for (; k < S->super_first[s + 1]; k++) {
      total += columns->begin[old_of[k] + 1] - columns->begin[old_of[k]];
    }
  }
  S->scatter_begin[S->n_supers] = total;
}

static void sli_fill_structure(sl_symbolic *S, const sli_pattern *rows, const sl_int *old_of,
                 const sl_int *new_of, const sl_int *earlier, sl_off *end,
                 sl_int *mark) {
  sl_int k, p, s, t;
  for (s = 0; s < S->n_supers; s++) {
    end[s] = S->rows_begin[s];
    mark[s] = -1;
  }
  for (k = 0; k < S->n; k++) {
    const sl_int own = S->super_of[k];
    for (t = earlier == NULL ? -1 : earlier[own]; t != -1; t = earlier[t]) {
      mark[t] = k;
      S->rows[end[t]++] = k;
    }
    for (p = rows->begin[old_of[k]]; p < rows->begin[old_of[k] + 1]; p++) {
      const sl_int i = new_of[rows->to[p]], home = S->super_of[i];
      const sl_int first = S->super_first[home], width = S->super_first[home + 1] - first;
      sl_int local;
      sl_off at;
      for (s = home; s != own && mark[s] != k; s = S->super_parent[s]) {
        for (t = s; t != -1 && mark[t] != k; t = earlier == NULL ? -1 : earlier[t]) {
          mark[t] = k;
          S->rows[end[t]++] = k;
        }
      }
      local = home == own ? k - first : width + (sl_int)(end[home] - S->rows_begin[home]) - 1;
      at = S->scatter_begin[home]++;
      S->scatter_from[at] = rows->from[p];
      S->scatter_to[at] = S->panel_begin[home] + sli_panel_at(width, local, i - first);
    }
  }
  for (s = 0; s < S->n_supers; s++) {
    SLI_ASSERT(end[s] == S->rows_begin[s + 1]);
  }
  memmove(S->scatter_begin + 1, S->scatter_begin, (size_t)S->n_supers * sizeof(sl_off));
  S->scatter_begin[0] = 0;
}

static void sli_fill_steps(sl_symbolic *S) {
  sl_int s;
  S->tallest = 0;
  S->widest = 0;
  for (s = 0; s < S->n_supers; s++) {
    sli_step *step = &S->steps[s];
    step->panel = S->panel_begin[s];
    step->column = S->super_first[s];
    step->base = S->super_first[s];
    step->width = S->super_first[s + 1] - S->super_first[s];
    step->below = (sl_int)(S->rows_begin[s + 1] - S->rows_begin[s]);
    step->first_tile = 0;
    step->up = S->super_parent[s];
    S->widest = sli_max(S->widest, step->width);
    S->tallest = sli_max(S->tallest, step->width + step->below);
  }
}

static void sli_fill_descendants(sl_symbolic *S) {
  sl_int s;
  for (s = 0; s < S->n_supers; s++) {
    S->first_descendant[s] = s;
  }
  for (s = 0; s < S->n_supers; s++) {
    const sl_int up = S->super_parent[s];
    if (up != -1) {
      S->first_descendant[up] = sli_min(S->first_descendant[up], S->first_descendant[s]);
    }
  }
}

static void sli_fill_relative(sl_symbolic *S, sl_int *local) {
  sl_int s, c;
  sl_off at;
  for (s = 0; s < S->n_supers; s++) {
    for (c = S->super_first[s]; c < S->super_first[s + 1]; c++) {
      local[c] = c - S->super_first[s];
    }
    for (at = S->rows_begin[s]; at < S->rows_begin[s + 1]; at++) {
      local[S->rows[at]] = S->steps[s].width + (sl_int)(at - S->rows_begin[s]);
    }
    for (c = s - 1; c >= S->first_descendant[s]; c = S->first_descendant[c] - 1) {
      for (at = S->rows_begin[c]; at < S->rows_begin[c + 1]; at++) {
        S->relative[at] = local[S->rows[at]];
      }
    }
  }
}

SLI_INLINE sl_int sli_last_tile(const sl_symbolic *S, sl_int s) {
  return sli_tiles(S->steps[s].width + S->steps[s].below) - 1;
}

static void sli_scatter_map_pivots(const sl_symbolic *S, sl_int s, sl_off m, sl_int *tile,
                   sl_int *k, sl_int *j) {
  const sl_int first = S->super_first[s], w = S->steps[s].width;
  sl_off in_tile = S->scatter_to[m] - S->panel_begin[s];
  sl_int local;
  while (sli_tile_offset(w, *tile) > in_tile) {
    --*tile;
  }
  in_tile -= sli_tile_offset(w, *tile);
  local = SLI_TILE * *tile + (sl_int)(in_tile % SLI_TILE);
  *j = first + (sl_int)(in_tile / SLI_TILE);
  *k = local < w ? first + local : S->rows[S->rows_begin[s] + local - w];
  SLI_ASSERT(S->panel_begin[s] + sli_panel_at(w, local, *j - first) == S->scatter_to[m]);
}

/* src/impl/analysis/schedule.h: tasks of the tree of fronts for parallel workers, and the layout of update stacks */

typedef struct sli_top {
  sl_int children, waiting;
  sl_int pieces;
  sl_int first_piece;
  sl_int piece_tiles;
  sl_int cleared, pivots, eliminated, updated;
  int is_begun, is_loading, is_loaded, is_finishing;
} sli_top;

typedef struct sli_schedule {
  sl_int workers;
  sl_int n_tasks, n_tops, n_bundles;
  sl_int *first, *last;
  sl_int *worker;
  sl_int *bundle_end;
  sl_int *top;
  sl_off *stack_begin;
  sli_top *tops;
  sl_int *ready;
  sl_int *steps;
  sl_off own;
  sl_off stack;
} sli_schedule;

typedef struct sli_forest {
  sl_int count;
  const sl_int *parent;
  const sl_int *low;
} sli_forest;

typedef struct sli_schedule_work {
  double *flops;
  double *path;
  double *load;
  sl_int *side;
  uint64_t *order;
  uint64_t *scratch;
} sli_schedule_work;

#define SLI_TASKS_PER_WORKER 8

#define SLI_FRONT_COST 4000.0

#if defined(SLI_SMALL_TASKS)
#define SLI_SHARED_FLOPS 2e4
#define SLI_BUNDLE_FLOPS 1e4
#define SLI_WORTHWHILE 0.0
#else
#define SLI_SHARED_FLOPS 4e6
#define SLI_BUNDLE_FLOPS 2e5
#define SLI_WORTHWHILE 1.25
#endif

SLI_INLINE sl_off sli_update_size(const sli_step *s) {
  const sl_int tiles = sli_update_tiles(s->width, s->below);
  return sli_triangle_offset(tiles) + SLI_TILE * (sl_off)tiles;
}

SLI_INLINE double sli_front_flops(const sli_step *s) {
  const double w = s->width, h = w + s->below;
  return w * (h * h - (w - 1.0) * h + (w - 1.0) * (2.0 * w - 1.0) / 6.0);
}

SLI_INLINE int sli_front_is_large(const sli_step *s) {
  return sli_front_flops(s) >= SLI_SHARED_FLOPS;
}

SLI_INLINE sl_off sli_large_scratch(const sli_step *s) {
  return SLI_TILE * (sl_off)sli_tiles(s->width + s->below) +
       SLI_FRONT_RECIPROCALS * (sl_off)sli_front_groups(s->width);
}

static sl_int sli_large_pieces(const sli_step *s, sl_int workers, sl_int *tiles) {
  const sl_int below = sli_tiles(s->width + s->below) - sli_tiles(s->width);
  *tiles = sli_max(SLI_GROUP_TILES, below / (4 * workers) + 1);
  return sli_front_groups(s->width) + (below + *tiles - 1) / *tiles;
}

typedef struct sli_stacks {
  sl_off top[2];
  sl_off most;
} sli_stacks;

static void sli_stacks_push(sli_stacks *k, const sl_symbolic *S, sl_int s, const sl_int *side,
              sl_off *begin) {
  const int own = side[s];
  const sl_off size = sli_update_size(&S->steps[s]);
  sl_int c;
  begin[s] = own == 0 ? k->top[0] : -(k->top[1] + size);
  k->top[own] += size;
  k->most = k->top[0] + k->top[1] > k->most ? k->top[0] + k->top[1] : k->most;
  for (c = s - 1; c >= S->first_descendant[s]; c = S->first_descendant[c] - 1) {
    k->top[1 - own] -= sli_update_size(&S->steps[c]);
  }
}

static void sli_plan_stacks(sli_schedule *p, const sl_symbolic *S, const sl_int *side) {
  sl_int m, s;
  p->own = 0;
  for (m = 0; m < p->n_tasks; m++) {
    sli_stacks k;
    memset(&k, 0, sizeof k);
    for (s = p->first[m]; s < p->last[m]; s++) {
      sli_stacks_push(&k, S, s, side, p->stack_begin);
    }
    for (s = p->first[m]; s < p->last[m]; s++) {
      p->stack_begin[s] += side[s] == 0 ? 0 : k.most;
    }
    p->own = k.most > p->own ? k.most : p->own;
  }
  p->stack = p->workers * p->own;
  for (m = 0; m < p->n_tasks; m++) {
    p->stack_begin[p->last[m]] = p->stack;
    p->stack += sli_update_size(&S->steps[p->last[m]]);
  }
  for (m = 0; m < p->n_tops; m++) {
    const sli_step *step = &S->steps[p->top[m]];
    p->stack_begin[p->top[m]] = p->stack;
    p->stack += sli_update_size(step);
    p->stack += sli_front_is_large(step) ? sli_large_scratch(step) : 0;
  }
}

static void sli_find_tasks(sli_schedule *p, const sli_forest *f, sli_schedule_work *w,
               double limit) {
  const double scale = 1e9 / limit;
  sl_int s;
  p->n_tasks = p->n_tops = 0;
  for (s = 0; s < f->count; s++) {
    const sl_int up = f->parent[s];
    if (w->flops[s] > limit) {
      p->top[p->n_tops++] = s;
    } else if (up == -1 || w->flops[up] > limit) {
      w->order[p->n_tasks++] = sli_keyed((sl_int)(w->flops[s] * scale), s);
    }
  }
  sli_sort(w->order, p->n_tasks, w->scratch);
}

static void sli_share_tasks(sli_schedule *p, const sli_forest *f, sli_schedule_work *w) {
  sl_int m, k;
  for (k = 0; k < p->workers; k++) {
    w->load[k] = 0.0;
  }
  for (m = 0; m < p->n_tasks; m++) {
    const sl_int root = sli_value(w->order[p->n_tasks - 1 - m]);
    sl_int least = 0;
    for (k = 1; k < p->workers; k++) {
      least = w->load[k] < w->load[least] ? k : least;
    }
    w->load[least] += w->flops[root];
    p->first[m] = f->low[root];
    p->last[m] = root;
    p->worker[m] = least;
  }
}

static void sli_plan_tasks(sli_schedule *p, const sli_forest *f, sli_schedule_work *w) {
  double total = 0.0;
  sl_int s;
  if (p->workers == 1) {
    p->n_tops = 0;
    p->n_tasks = f->count > 0;
    if (f->count > 0) {
      p->first[0] = p->worker[0] = 0;
      p->last[0] = f->count - 1;
    }
    return;
  }
  for (s = 0; s < f->count; s++) {
    if (f->parent[s] != -1) {
      w->flops[f->parent[s]] += w->flops[s];
    } else {
      total += w->flops[s];
    }
  }
  sli_find_tasks(p, f, w, total / ((double)p->workers * SLI_TASKS_PER_WORKER));
  sli_share_tasks(p, f, w);
}

static void sli_bundle_tasks(sli_schedule *p, const sli_schedule_work *w) {
  double flops = 0.0;
  sl_int m;
  p->n_bundles = 0;
  for (m = 0; m < p->n_tasks; m++) {
    flops += p->workers > 1 ? w->flops[p->last[m]] : 0.0;
    if (flops >= SLI_BUNDLE_FLOPS || m == p->n_tasks - 1) {
      p->bundle_end[p->n_bundles++] = m + 1;
      flops = 0.0;
    }
  }
}

SLI_INLINE double sli_schedule_flops(const sl_symbolic *S) {
  return S->stats.symbolic.flops + SLI_FRONT_COST * S->n_supers;
}

static double sli_schedule_gain(const sl_symbolic *S, const sli_schedule_work *w, sl_int workers) {
  double total = 0.0, longest = 0.0;
  sl_int s;
  memset(w->path, 0, (size_t)S->n_supers * sizeof(double));
  for (s = 0; s < S->n_supers; s++) {
    const sl_int up = S->super_parent[s];
    total += w->flops[s];
    w->path[s] += sli_front_is_large(&S->steps[s]) ? w->flops[s] / workers : w->flops[s];
    longest = w->path[s] > longest ? w->path[s] : longest;
    if (up != -1) {
      w->path[up] = w->path[s] > w->path[up] ? w->path[s] : w->path[up];
    }
  }
  return longest > 0.0 ? total / longest : 1.0;
}

static void sli_schedule_fill(sli_schedule *p, const sl_symbolic *S, sli_schedule_work *w) {
  const sli_forest f = {S->n_supers, S->super_parent, S->first_descendant};
  sl_int s;
  if (p->workers > 1) {
    for (s = 0; s < S->n_supers; s++) {
      w->flops[s] = sli_front_flops(&S->steps[s]) + SLI_FRONT_COST;
    }
    p->workers = sli_schedule_gain(S, w, p->workers) >= SLI_WORTHWHILE ? p->workers : 1;
  }
  sli_plan_tasks(p, &f, w);
  sli_bundle_tasks(p, w);
  for (s = S->n_supers - 1; s >= 0; s--) {
    w->side[s] = S->super_parent[s] == -1 ? 0 : 1 - w->side[S->super_parent[s]];
  }
  sli_plan_stacks(p, S, w->side);
}

static void sli_schedule_layout(sli_schedule *p, sli_block *b, sl_int count) {
  const uint64_t fronts = (uint64_t)count, tasks = p->workers == 1 ? 1 : fronts;
  p->first = SLI_TAKE(b, sl_int, tasks);
  p->last = SLI_TAKE(b, sl_int, tasks);
  p->worker = SLI_TAKE(b, sl_int, tasks);
  p->bundle_end = SLI_TAKE(b, sl_int, tasks);
  p->top = SLI_TAKE(b, sl_int, p->workers == 1 ? 0 : fronts);
  p->stack_begin = SLI_TAKE(b, sl_off, fronts);
}

static void sli_schedule_layout_tops(sli_schedule *p, const sl_symbolic *S, sli_block *b) {
  sl_int m, tiles, pieces = 0;
  for (m = 0; m < p->n_tops; m++) {
    const sli_step *step = &S->steps[p->top[m]];
    pieces += sli_front_is_large(step) ? sli_large_pieces(step, p->workers, &tiles) : 0;
  }
  p->tops = SLI_TAKE(b, sli_top, p->n_tops);
  p->ready = SLI_TAKE(b, sl_int, p->n_tops);
  p->steps = SLI_TAKE(b, sl_int, pieces);
}

static void sli_schedule_fill_tops(sli_schedule *p, const sl_symbolic *S) {
  sl_int m, c, pieces = 0;
  for (m = 0; m < p->n_tops; m++) {
    const sl_int s = p->top[m];
    sli_top *top = &p->tops[m];
    memset(top, 0, sizeof *top);
    for (c = s - 1; c >= S->first_descendant[s]; c = S->first_descendant[c] - 1) {
      top->children++;
    }
    if (sli_front_is_large(&S->steps[s])) {
      top->pieces = sli_large_pieces(&S->steps[s], p->workers, &top->piece_tiles);
    }
    top->first_piece = pieces;
    pieces += top->pieces;
  }
}

static void sli_schedule_work_layout(sli_schedule_work *w, sli_block *b, sl_int count,
                   sl_int workers) {
  w->flops = SLI_TAKE(b, double, count);
  w->path = SLI_TAKE(b, double, count);
  w->load = SLI_TAKE(b, double, workers);
  w->side = SLI_TAKE(b, sl_int, count);
  w->order = SLI_TAKE(b, uint64_t, count);
  w->scratch = SLI_TAKE(b, uint64_t, count);
}

/* src/impl/analysis/symbolic.h: the analysis: from the pattern of A to the supernodes and the storage of L */

typedef struct sli_analysis {
  sl_int n;
  sli_pattern rows, columns;
  sli_amalgamation amalgamation;
  sl_int *perm;
  sli_order_choice choice;
  sl_int *old_of, *new_of;
  sl_int *parent, *counts, *super_of;
  sl_int *scratch;
  uint64_t *list;
  const unsigned char *pairs;
  unsigned char *is_first;
  sl_int *earlier;
  sli_septree septree;
} sli_analysis;

static void sli_analysis_layout(sli_analysis *w, sli_block *b, sl_int rows, sl_int nnz) {
  const uint64_t n = (uint64_t)rows;
  w->n = rows;
  w->rows.begin = SLI_TAKE(b, sl_int, n + 1);
  w->rows.to = SLI_TAKE(b, sl_int, nnz);
  w->rows.from = SLI_TAKE(b, sl_int, nnz);
  w->columns.begin = SLI_TAKE(b, sl_int, n + 1);
  w->columns.to = SLI_TAKE(b, sl_int, nnz);
  w->perm = SLI_TAKE(b, sl_int, n);
  w->choice.other = SLI_TAKE(b, sl_int, n);
  w->old_of = SLI_TAKE(b, sl_int, n);
  w->new_of = SLI_TAKE(b, sl_int, n);
  w->parent = SLI_TAKE(b, sl_int, n);
  w->counts = SLI_TAKE(b, sl_int, n);
  w->super_of = SLI_TAKE(b, sl_int, n);
  w->scratch = SLI_TAKE(b, sl_int, 5 * n);
  w->amalgamation.first = SLI_TAKE(b, sl_int, n + 1);
  w->amalgamation.parent = SLI_TAKE(b, sl_int, n);
  w->amalgamation.width = SLI_TAKE(b, sl_int, n);
  w->amalgamation.below = SLI_TAKE(b, sl_int, n);
  w->amalgamation.zeros = SLI_TAKE(b, sl_off, n);
  w->amalgamation.merged_into = SLI_TAKE(b, sl_int, n);
  w->list = SLI_TAKE(b, uint64_t, 2 * n);
  if (w->pairs != NULL) {
    w->amalgamation.is_tied = SLI_TAKE(b, unsigned char, n);
    w->is_first = SLI_TAKE(b, unsigned char, n);
    w->earlier = SLI_TAKE(b, sl_int, n);
  }
  w->septree.node_of = SLI_TAKE(b, sl_int, n);
  w->septree.parent = SLI_TAKE(b, sl_int, n + 1);
}

static void sli_symbolic_layout(sl_symbolic *S, sli_block *b, sl_off rows, sl_off entries) {
  const size_t n = (size_t)S->n, supers = (size_t)S->n_supers;
  S->perm = SLI_TAKE(b, sl_int, n);
  S->iperm = SLI_TAKE(b, sl_int, n);
  S->parent = SLI_TAKE(b, sl_int, n);
  S->counts = SLI_TAKE(b, sl_int, n);
  S->super_of = SLI_TAKE(b, sl_int, n);
  S->super_first = SLI_TAKE(b, sl_int, supers + 1);
  S->super_parent = SLI_TAKE(b, sl_int, supers);
  S->rows_begin = SLI_TAKE(b, sl_off, supers + 1);
  S->rows = SLI_TAKE(b, sl_int, rows);
  S->panel_begin = SLI_TAKE(b, sl_off, supers + 1);
  S->steps = SLI_TAKE(b, sli_step, supers);
  S->first_descendant = SLI_TAKE(b, sl_int, supers);
  S->pairs = SLI_TAKE(b, unsigned char, S->n_pairs > 0 ? n : 0);
  S->relative = SLI_TAKE(b, sl_int, rows);
  S->scatter_begin = SLI_TAKE(b, sl_off, supers + 1);
  S->scatter_from = SLI_TAKE(b, sl_int, entries);
  S->scatter_to = SLI_TAKE(b, sl_off, entries);
  S->node_of = SLI_TAKE(b, sl_int, S->n_nodes > 0 ? n : 0);
  S->node_parent = SLI_TAKE(b, sl_int, S->n_nodes);
  S->node_level = SLI_TAKE(b, sl_int, S->n_nodes);
}

static void sli_analysis_reorder(sli_analysis *w, const sl_int *order) {
  sl_int k;
  for (k = 0; k < w->n; k++) {
    w->scratch[k] = w->counts[order[k]];
  }
  if (w->n > 0) {
    memcpy(w->counts, w->scratch, (size_t)w->n * sizeof(sl_int));
  }
  sli_relabel(order, w->n, w->old_of, w->new_of, w->parent, w->scratch);
}

static void sli_analysis_tie(sli_analysis *w) {
  sl_int s;
  for (s = 0; s < w->amalgamation.count; s++) {
    w->amalgamation.is_tied[s] = w->pairs[w->old_of[w->amalgamation.first[s + 1] - 1]];
  }
}

static void sli_analysis_split(sli_analysis *w, sl_int *order) {
  sl_int k;
  for (k = 0; k < w->n; k++) {
    w->is_first[k] = w->pairs[w->old_of[k]];
    SLI_ASSERT(!w->is_first[k] || w->old_of[k + 1] == w->old_of[k] + 1);
  }
  for (k = w->n - 1; k >= 0; k--) {
    w->counts[k] = w->is_first[k] ? w->counts[k + 1] + 1 : w->counts[k];
  }
  if (sli_split_pairs(&w->amalgamation, w->n, w->parent, w->is_first, w->super_of, w->earlier,
            order, w->scratch)) {
    sli_analysis_reorder(w, order);
    for (k = 0; k < w->n; k++) {
      w->is_first[k] = w->pairs[w->old_of[k]];
    }
  }
}

static void sli_analyze_tree(sli_analysis *w, const sl_options *opt, sl_stats *stats) {
  const sl_int n = w->n;
  const int keeps_order =
    opt != NULL && (opt->ordering == SL_ORDERING_GIVEN || opt->ordering == SL_ORDERING_NATURAL);
  sl_int *order = w->scratch, *more = w->scratch + n;
  sli_order_natural(n, w->old_of);
  sli_etree(n, &w->rows, w->parent, order);
  sli_postorder(w->parent, n, order, more, more + n);
  sli_relabel(order, n, w->old_of, w->new_of, w->parent, more);
  sli_counts(n, &w->columns, w->old_of, w->new_of, w->parent, w->counts, w->scratch);
  sli_fundamental(n, w->parent, w->counts, more, w->super_of, &w->amalgamation);
  stats->symbolic.supernodes_fundamental = w->amalgamation.count;
  w->amalgamation.relaxes = opt == NULL || opt->relaxation != SL_RELAXATION_NONE;
  if (w->pairs != NULL) {
    sli_analysis_tie(w);
  }
  if (w->amalgamation.relaxes || w->pairs != NULL) {
    sli_amalgamate(&w->amalgamation, order, more, w->list, w->list + n);
  }
  order = (sl_int *)(void *)w->list;
  sli_number_supernodes(&w->amalgamation, n, keeps_order ? w->new_of : NULL, order, w->super_of,
              w->scratch);
  sli_analysis_reorder(w, order);
  if (w->pairs != NULL) {
    sli_analysis_split(w, order);
  }
}

static void sli_analyze_order(sli_analysis *w, const sl_csc *A, const sl_options *opt,
                sl_stats *stats) {
  const double started = sli_seconds();
  sl_int k;
  for (k = 0; k < w->n; k++) {
    w->scratch[w->perm[k]] = k;
  }
  sli_pattern_fill(A, stats->symbolic.triangle, w->scratch, &w->rows, &w->columns);
  stats->symbolic.seconds_tree -= sli_seconds() - started;
  sli_analyze_tree(w, opt, stats);
  stats->symbolic.seconds_tree += sli_seconds() - started;
}

static void sli_analysis_costs(const sli_analysis *w, sl_int *size, double *entries,
                 double *paths) {
  sl_int k;
  *entries = *paths = 0.0;
  for (k = 0; k < w->n; k++) {
    size[k] = 1;
  }
  for (k = 0; k < w->n; k++) {
    *entries += w->counts[k];
    *paths += (double)w->counts[k] * size[k];
    if (w->parent[k] != -1) {
      size[w->parent[k]] += size[k];
    }
  }
}

static void sli_analyze_choice(sli_analysis *w, const sl_csc *A, const sl_options *opt,
                 sl_stats *stats) {
  double entries[2], paths[2];
  sl_int *first = w->perm;
  sli_analysis_costs(w, w->scratch, &entries[0], &paths[0]);
  w->perm = w->choice.other;
  sli_analyze_order(w, A, opt, stats);
  sli_analysis_costs(w, w->scratch, &entries[1], &paths[1]);
  if (entries[1] < entries[0] && paths[1] < paths[0]) {
    w->septree.count = 0;
  } else {
    w->perm = first;
    sli_analyze_order(w, A, opt, stats);
  }
}

static void sli_analyze_stats(const sl_symbolic *S, sl_int *depth, sl_stats *stats) {
  sl_int k;
  stats->symbolic.n = S->n;
  stats->symbolic.supernodes = S->n_supers;
  stats->symbolic.nnz_panels = S->panel_begin[S->n_supers];
  for (k = S->n - 1; k >= 0; k--) {
    const double count = S->counts[k];
    depth[k] = S->parent[k] == -1 ? 1 : depth[S->parent[k]] + 1;
    stats->symbolic.tree_height = sli_max(stats->symbolic.tree_height, depth[k]);
    stats->symbolic.components += S->parent[k] == -1;
    stats->symbolic.nnz_l += S->counts[k];
    stats->symbolic.flops += count * count;
  }
}

static void sli_fill_septree(sl_symbolic *S, const sli_septree *septree) {
  sl_int k;
  for (k = 0; k < S->n && S->n_nodes > 0; k++) {
    S->node_of[k] = septree->node_of[S->perm[k]];
  }
  for (k = S->n_nodes - 1; k >= 0; k--) {
    S->node_parent[k] = septree->parent[k];
    S->node_level[k] = septree->parent[k] == -1 ? 0 : S->node_level[septree->parent[k]] + 1;
  }
}

static void sli_fill_identity(sl_symbolic *S, sl_triangle triangle) {
  const sl_int kind = (sl_int)triangle;
  sl_int k;
  S->identity = sli_hash_ints(S->pattern, &kind, 1);
  S->identity = sli_hash_ints(S->identity, S->perm, S->n);
  S->identity = sli_hash_ints(S->identity, S->super_first, (sl_off)S->n_supers + 1);
  for (k = 0; k < S->n && S->n_pairs > 0; k++) {
    if (S->pairs[k] == SLI_PAIR_FIRST) {
      S->identity = sli_hash_ints(S->identity, &k, 1);
    }
  }
}

static void sli_symbolic_fill(sl_symbolic *S, const sli_analysis *w, sl_stats *stats) {
  const size_t bytes = (size_t)S->n * sizeof(sl_int);
  sl_int s, k;
  for (k = 0; k < S->n; k++) {
    S->perm[k] = w->perm[w->old_of[k]];
    S->iperm[S->perm[k]] = k;
  }
  memcpy(S->parent, w->parent, bytes);
  memcpy(S->counts, w->counts, bytes);
  memcpy(S->super_of, w->super_of, bytes);
  memcpy(S->super_first, w->amalgamation.first, ((size_t)S->n_supers + 1) * sizeof(sl_int));
  memcpy(S->super_parent, w->amalgamation.parent, (size_t)S->n_supers * sizeof(sl_int));
  S->rows_begin[0] = 0;
  S->panel_begin[0] = 0;
  for (s = 0; s < S->n_supers; s++) {
    S->rows_begin[s + 1] = S->rows_begin[s] + w->amalgamation.below[s];
    S->panel_begin[s + 1] =
      S->panel_begin[s] + sli_panel_size(w->amalgamation.width[s], w->amalgamation.below[s]);
  }
  for (k = 0; k < S->n && S->n_pairs > 0; k++) {
    S->pairs[k] = w->is_first[k]                ? SLI_PAIR_FIRST
            : k > 0 && w->is_first[k - 1] ? SLI_PAIR_SECOND
                          : SLI_PAIR_NONE;
  }
  sli_scatter_map_count(S, &w->columns, w->old_of);
  sli_fill_structure(S, &w->rows, w->old_of, w->new_of, w->earlier, (sl_off *)(void *)w->list,
             (sl_int *)(void *)(w->list + S->n));
  sli_fill_steps(S);
  sli_fill_descendants(S);
  sli_fill_relative(S, w->scratch);
  sli_fill_septree(S, &w->septree);
  sli_fill_identity(S, stats->symbolic.triangle);
  sli_analyze_stats(S, w->scratch, stats);
}

static sl_status sli_symbolic_make(sl_symbolic **out, const sl_csc *A, const sl_options *opt,
                   sli_analysis *w, const sl_allocator *a, sl_stats *stats) {
  double started;
  sl_symbolic draft;
  sli_block b = {NULL, 0, 0};
  sl_off rows = 0;
  sl_int s;
  int pass;
  sl_status status;
  started = sli_seconds();
  status = sli_order(A, stats->symbolic.triangle, opt, w->perm, w->scratch, &w->septree,
             &w->choice, a, stats);
  stats->symbolic.seconds_order = sli_seconds() - started;
  if (status != SL_OK) {
    return status;
  }
  started = sli_seconds();
  sli_analyze_order(w, A, opt, stats);
  stats->symbolic.nnz_a = w->rows.begin[w->n];
  if (w->choice.is_there) {
    sli_analyze_choice(w, A, opt, stats);
  }
  memset(&draft, 0, sizeof draft);
  draft.allocator = *a;
  draft.n = A->n_cols;
  draft.n_supers = w->amalgamation.count;
  draft.n_nodes = w->septree.count;
  for (s = 0; w->pairs != NULL && s < w->n; s++) {
    draft.n_pairs += w->pairs[s];
  }
  stats->symbolic.pairs = draft.n_pairs;
  draft.nnz_input = sli_nnz(A);
  (void)sli_pattern_hash(A, &draft.pattern);
  for (s = 0; s < w->amalgamation.count; s++) {
    rows += w->amalgamation.below[s];
  }
  for (pass = 0; pass < 2 && status == SL_OK; pass++) {
    (void)sli_take(&b, 1, sizeof(sl_symbolic));
    sli_symbolic_layout(&draft, &b, rows, stats->symbolic.nnz_a);
    stats->symbolic.bytes = b.used;
    status = pass == 0 ? sli_block_alloc(&b, a) : SL_OK;
  }
  if (status != SL_OK) {
    return status;
  }
  stats->symbolic.seconds_structure = -sli_seconds();
  sli_symbolic_fill(&draft, w, stats);
  stats->symbolic.seconds_structure += sli_seconds();
  stats->symbolic.seconds_analyze += sli_seconds() - started;
  draft.stats = *stats;
  *out = (sl_symbolic *)(void *)b.base;
  **out = draft;
  return SL_OK;
}

static void sli_symbolic_stats_copy(const sl_stats *from, sl_stats *to) {
  to->symbolic = from->symbolic;
}

static int sli_symbolic_options_are_valid(const sl_options *opt) {
  return sli_options_are_valid(opt, SLI_READS_ANALYSIS | SLI_READS_TRIANGLE) &&
       (opt == NULL || opt->relaxation == SL_RELAXATION_DEFAULT ||
      opt->relaxation == SL_RELAXATION_NONE);
}

static sl_status sli_symbolic_create(sl_symbolic **out, const sl_csc *A, const unsigned char *pairs,
                   const sl_options *opt, sl_stats *stats) {
  const sl_allocator a = sli_allocator(opt);
  const double started = sli_seconds();
  sli_analysis w;
  sli_block b = {NULL, 0, 0};
  sl_stats found;
  sl_status status;
  int pass;
  sli_stats_clear_error(stats);
  if (out == NULL) {
    return SL_ERR_ARGUMENT;
  }
  *out = NULL;
  status = sl_csc_check(A, stats);
  if (status != SL_OK) {
    return status;
  }
  if (A->n_rows != A->n_cols || !sli_symbolic_options_are_valid(opt)) {
    return SL_ERR_ARGUMENT;
  }
  memset(&w, 0, sizeof w);
  w.pairs = pairs;
  memset(&found, 0, sizeof found);
  sli_stats_clear_error(&found);
  status = sli_csc_triangle(A, &found.symbolic.triangle, opt, stats);
  for (pass = 0; pass < 2 && status == SL_OK; pass++) {
    sli_analysis_layout(&w, &b, A->n_cols, sli_nnz(A));
    status = pass == 0 ? sli_block_alloc(&b, &a) : SL_OK;
  }
  if (status == SL_OK) {
    found.symbolic.seconds_analyze = sli_seconds() - started;
    status = sli_symbolic_make(out, A, opt, &w, &a, &found);
    if (stats != NULL && status == SL_OK) {
      sli_symbolic_stats_copy(&found, stats);
    } else if (stats != NULL) {
      stats->error.row = found.error.row;
    }
    sli_free(&a, b.base);
  }
  return status;
}

SL_API sl_status sl_symbolic_create(sl_symbolic **out, const sl_csc *A, const sl_options *opt,
                  sl_stats *stats) {
  return sli_symbolic_create(out, A, NULL, opt, stats);
}

SL_API void sl_symbolic_free(sl_symbolic *S) {
  if (S != NULL) {
    const sl_allocator a = S->allocator;
    sli_unmap(&S->mapping);
    sli_free(&a, S);
  }
}

SL_API void sl_symbolic_stats(const sl_symbolic *S, sl_stats *stats) {
  sli_stats_clear_error(stats);
  if (S != NULL && stats != NULL) {
    sli_symbolic_stats_copy(&S->stats, stats);
  }
}

SL_API sl_symbolic_arrays sl_symbolic_view(const sl_symbolic *S) {
  sl_symbolic_arrays v;
  memset(&v, 0, sizeof v);
  if (S != NULL) {
    v.n = S->n;
    v.n_supers = S->n_supers;
    v.perm = S->perm;
    v.iperm = S->iperm;
    v.parent = S->parent;
    v.counts = S->counts;
    v.super_first = S->super_first;
    v.super_of = S->super_of;
    v.super_parent = S->super_parent;
    v.rows_begin = S->rows_begin;
    v.rows = S->rows;
    v.panel_begin = S->panel_begin;
    v.pairs = S->n_pairs > 0 ? S->pairs : NULL;
    v.n_nodes = S->n_nodes;
    v.node_of = S->n_nodes > 0 ? S->node_of : NULL;
    v.node_parent = S->n_nodes > 0 ? S->node_parent : NULL;
    v.node_level = S->n_nodes > 0 ? S->node_level : NULL;
  }
  return v;
}

/* src/impl/analysis/reach.h: the reach of a set of columns: their paths to the roots, compiled for the kernels */

typedef struct sli_reach {
  sl_int count;
  sl_int columns;
  sl_int tallest, widest;
  sl_off n_rows;
  sl_off entries;
  const sli_step *steps;
  const sl_int *rows;
} sli_reach;

static sli_reach sli_reach_all(const sl_symbolic *S) {
  sli_reach R;
  R.count = S->n_supers;
  R.columns = S->n;
  R.tallest = S->tallest;
  R.widest = S->widest;
  R.n_rows = S->rows_begin[S->n_supers];
  R.entries = S->panel_begin[S->n_supers];
  R.steps = S->steps;
  R.rows = S->rows;
  return R;
}

typedef struct sli_region_extent {
  sl_int n_roots;
  const sl_int *roots;
  sl_int n_rows;
  const sl_int *rows;
} sli_region_extent;

SLI_INLINE sl_int sli_extent_find(const sl_symbolic *S, const sli_region_extent *extent, sl_int s) {
  const sl_int at = sli_lower_bound(extent->roots, extent->n_roots, s);
  return at < extent->n_roots && S->first_descendant[extent->roots[at]] <= s ? at : -1;
}

SLI_INLINE sl_int sli_extent_boundary(const sli_region_extent *extent, sl_int column) {
  const sl_int at = sli_lower_bound(extent->rows, extent->n_rows, column);
  return at < extent->n_rows && extent->rows[at] == column ? at : -1;
}

SLI_INLINE sl_int sli_extent_end(const sl_symbolic *S, const sli_region_extent *extent, sl_int s) {
  return extent == NULL ? S->n_supers
              : extent->roots[sli_lower_bound(extent->roots, extent->n_roots, s)] + 1;
}

SLI_INLINE sl_int sli_next_seed(const sl_symbolic *S, const uint64_t *seeds, sl_int count,
                sl_int *k) {
  const sl_int here = S->super_of[sli_key(seeds[*k])];
  sl_int s = here;
  while (++*k < count && s == here) {
    s = S->super_of[sli_key(seeds[*k])];
    if (s != here) {
      return s;
    }
  }
  return S->n_supers;
}

SLI_INLINE sl_off sli_entries_from(sl_int width, sl_int below, sl_int first_tile) {
  return sli_panel_size(width, below) - sli_tile_offset(width, first_tile) -
       (sl_off)SLI_TILE * SLI_TILE * first_tile * (sli_tiles(width + below) - first_tile);
}

static void sli_reach_add_path(const sl_symbolic *S, sl_int k, sl_int low, sl_int high,
                 sli_reach *R) {
  sl_int s = S->super_of[k];
  while (s != -1 && s < high && S->first_descendant[s] > low) {
    const sl_int first = S->super_first[s], width = S->super_first[s + 1] - first;
    const sl_int below = (sl_int)(S->rows_begin[s + 1] - S->rows_begin[s]);
    R->count++;
    R->n_rows += below;
    R->columns += width;
    R->widest = sli_max(R->widest, width);
    R->tallest = sli_max(R->tallest, width + below);
    R->entries += sli_entries_from(width, below, (k - first) / SLI_TILE);
    k = below > 0 ? S->rows[S->rows_begin[s]] : k;
    s = S->super_parent[s];
  }
}

static void sli_reach_add(const sl_symbolic *S, sl_int k, sl_int before, sl_int behind,
              sli_reach *R) {
  sli_reach_add_path(S, k, before < 0 ? -1 : S->super_of[before],
             behind < 0 ? S->n_supers : S->super_of[behind], R);
}

static void sli_reach_measure_within(const sl_symbolic *S, const sli_region_extent *extent,
                   const uint64_t *seeds, sl_int count, sli_reach *R) {
  sl_int k, low = -1;
  memset(R, 0, sizeof *R);
  for (k = 0; k < count; k++) {
    const sl_int s = S->super_of[sli_key(seeds[k])];
    sli_reach_add_path(S, sli_key(seeds[k]), low, sli_extent_end(S, extent, s), R);
    low = s;
  }
  R->columns += extent == NULL ? 0 : extent->n_rows;
}

static void sli_reach_measure(const sl_symbolic *S, const uint64_t *seeds, sl_int count,
                sli_reach *R) {
  sli_reach_measure_within(S, NULL, seeds, count, R);
}

static void sli_reach_enter(const sl_symbolic *S, sli_step *steps, sl_int at, sl_int s, sl_int seed,
              sl_int end, sl_int *pending) {
  const sl_int first = S->super_first[s];
  sli_step *step = &steps[at];
  sl_int column = seed;
  while (*pending != -1 && S->super_parent[S->super_of[steps[*pending].column]] == s) {
    sli_step *child = &steps[*pending];
    const sl_int c = S->super_of[child->column];
    column = sli_min(column, S->rows[S->rows_begin[c]]);
    *pending = child->up;
    child->up = at;
  }
  step->panel = S->panel_begin[s];
  step->first_tile = (column - first) / SLI_TILE;
  step->column = first + SLI_TILE * step->first_tile;
  step->width = S->super_first[s + 1] - first;
  step->below = (sl_int)(S->rows_begin[s + 1] - S->rows_begin[s]);
  step->up = -1;
  if (S->super_parent[s] != -1 && S->super_parent[s] < end) {
    step->up = *pending;
    *pending = at;
  }
}

SLI_INLINE sl_int sli_reach_find(const sli_step *steps, sl_int low, sl_int high, sl_int row) {
  while (low < high) {
    const sl_int middle = low + (high - low + 1) / 2;
    if (steps[middle].column <= row) {
      low = middle;
    } else {
      high = middle - 1;
    }
  }
  return low;
}

#define SLI_REACH_WALK 8

static void sli_reach_map_rows(const sl_int *rows, sl_int inside, const sli_step *steps,
                 sl_int count, sl_int at, sl_int *indices) {
  sl_int i = 0;
  while (i < inside) {
    sl_int end, shift, walked = 0;
    do {
      at = walked++ < SLI_REACH_WALK ? steps[at].up
                       : sli_reach_find(steps, at + 1, count - 1, rows[i]);
      end = steps[at].column + sli_step_columns(&steps[at]);
    } while (rows[i] >= end);
    shift = steps[at].base - steps[at].column;
    for (; i < inside && rows[i] < end; i++) {
      indices[i] = rows[i] + shift;
    }
  }
}

static void sli_extent_map_rows(const sli_region_extent *extent, sl_int base, const sl_int *rows,
                sl_int count, sl_int *indices) {
  sl_int i, at = 0;
  for (i = 0; i < count; i++) {
    at += sli_lower_bound(extent->rows + at, extent->n_rows - at, rows[i]);
    indices[i] = base + at;
  }
}

static void sli_reach_fill_within(const sl_symbolic *S, const sli_region_extent *extent,
                  const uint64_t *seeds, sl_int count, sli_step *steps,
                  sl_int *rows, sli_reach *R) {
  sl_int k = 0, at = 0, pending = -1, s, next, end;
  memset(R, 0, sizeof *R);
  while (k < count) {
    sl_int seed = sli_key(seeds[k]);
    s = S->super_of[seed];
    end = sli_extent_end(S, extent, s);
    next = sli_min(sli_next_seed(S, seeds, count, &k), end);
    for (; s != -1 && s < next; s = S->super_parent[s]) {
      sli_reach_enter(S, steps, at++, s, seed, end, &pending);
      seed = INT32_MAX;
    }
  }
  R->count = at;
  for (at = 0; at < R->count; at++) {
    const sli_step *step = &steps[at];
    steps[at].base = R->columns;
    R->columns += sli_step_columns(step);
    R->widest = sli_max(R->widest, step->width);
    R->tallest = sli_max(R->tallest, step->width + step->below);
    R->entries += sli_entries_from(step->width, step->below, step->first_tile);
  }
  for (at = 0; at < R->count; at++) {
    const sl_int own = S->super_of[steps[at].column], below = steps[at].below;
    const sl_int *from = S->rows + S->rows_begin[own];
    sl_int inside = below;
    if (extent != NULL) {
      inside = sli_lower_bound(from, below, S->super_first[sli_extent_end(S, extent, own)]);
      sli_extent_map_rows(extent, R->columns, from + inside, below - inside,
                rows + R->n_rows + inside);
    }
    sli_reach_map_rows(from, inside, steps, R->count, at, rows + R->n_rows);
    R->n_rows += below;
  }
  R->columns += extent == NULL ? 0 : extent->n_rows;
  R->steps = steps;
  R->rows = rows;
}

static void sli_reach_fill(const sl_symbolic *S, const uint64_t *seeds, sl_int count,
               sli_step *steps, sl_int *rows, sli_reach *R) {
  sli_reach_fill_within(S, NULL, seeds, count, steps, rows, R);
}

SLI_INLINE sl_int sli_reach_index(const sli_reach *R, sl_int *at, sl_int column) {
  while (column >= R->steps[*at].column + sli_step_columns(&R->steps[*at])) {
    ++*at;
  }
  return column - R->steps[*at].column + R->steps[*at].base;
}

static sl_int sli_reach_index_of(const sli_reach *R, sl_int column) {
  const sli_step *step;
  if (R->count == 0) {
    return -1;
  }
  step = &R->steps[sli_reach_find(R->steps, 0, R->count - 1, column)];
  return column >= step->column && column < step->column + sli_step_columns(step)
         ? step->base + column - step->column
         : -1;
}

typedef struct sli_intersection {
  const sli_step *a, *a_end, *b, *b_end;
  sl_int count;
  sl_int column;
  sl_int in_a, in_b;
} sli_intersection;

SLI_INLINE sli_intersection sli_intersection_of(const sli_reach *a, const sli_reach *b) {
  sli_intersection m;
  memset(&m, 0, sizeof m);
  m.a = a->steps;
  m.a_end = a->steps + a->count;
  m.b = b->steps;
  m.b_end = b->steps + b->count;
  return m;
}

SLI_INLINE int sli_intersection_next(sli_intersection *m) {
  while (m->a < m->a_end && m->b < m->b_end) {
    if (m->a->panel == m->b->panel) {
      m->column = sli_max(m->a->column, m->b->column);
      m->count = m->a->column + sli_step_columns(m->a) - m->column;
      m->in_a = m->a->base + m->column - m->a->column;
      m->in_b = m->b->base + m->column - m->b->column;
      m->a++;
      m->b++;
      return 1;
    }
    if (m->a->panel < m->b->panel) {
      m->a++;
    } else {
      m->b++;
    }
  }
  return 0;
}

/* factor: the numbers of L and D */
/* src/impl/factor/factor_types.h: the factor object, and what both methods share: panel loading, pivot checks */

typedef struct sli_source {
  const sl_csc *A;
  const double *const *values;
  const double *coefficients;
  sl_int terms;
} sli_source;

typedef struct sli_failure {
  sl_status status;
  sl_int super;
  sl_int pivot;
  sl_off position;
  double value;
} sli_failure;

#define SLI_NULL_VECTORS_MAX 32

typedef struct sli_null_row {
  double z;
  double product;
  double size;
  sl_int entries;
  sl_int up;
} sli_null_row;

typedef struct sli_extent {
  double entry;
  double magnitude;
  sl_int pivot;
  sl_int zero;
} sli_extent;

struct sl_factor {
  sl_allocator allocator;
  sl_stats stats;
  const sl_symbolic *S;
  const sli_kernels *kernels;
  sli_pivot_rule rule;
  sl_null_pivots null_pivots;
  sl_method method;
  int is_valid;
  int is_immutable;
  void *scratch;
  sl_status status;
  sli_hash identity;
  uint64_t generation;
  sl_off updates;
  double drift;
  sli_hash analysis;
  sl_storage storage;
  void *values;
  double *panels;
  sl_off panel_room;
  double *D;
  double *E;
  sli_extent *extents;
  double growth_limit;
  double error_limit;
  sl_int *regularized;

  double consistency;
  int checks;
  int is_centered;
  sl_int n_nulls;
  sl_int *nulls;
  sl_int n_anchors;
  sl_int *anchors;
  double *mass;
  sl_int null_vectors;
  double *z;
  double *g;
  int has_duplicates;
  sli_null_row *rows;
  sl_int *last;
  double *rounding;
  sl_int *chain, *row_entries;
  double *products;
  double *center;
  double *squares;
  double *ratios;
  double *divisors;
  double *center_scratch;
  double *buffer;

  sl_threads threads;
  sli_schedule schedule;
  double *stack;
  double *magnitude;
  double *reciprocals;
  sli_failure *failures;

  double *x;
  sl_int *head;
  sl_int *next;
  sl_int *position;
  uint64_t *list;
  uint64_t *list_scratch;
};

typedef struct sli_numbers {
  const sl_factor *F;
  sli_hash identity;
  uint64_t generation;
} sli_numbers;

SLI_INLINE sli_numbers sli_numbers_of(const sl_factor *F) {
  sli_numbers numbers;
  numbers.F = F;
  numbers.identity = F->identity;
  numbers.generation = F->generation;
  return numbers;
}

SLI_INLINE int sli_numbers_are_of(const sli_numbers *numbers, const sl_factor *F) {
  return numbers->F == F && numbers->generation == F->generation &&
       sli_hash_equals(numbers->identity, F->identity);
}

SLI_INLINE int sli_factor_is_over(const sl_factor *F, const sl_symbolic *S, sli_hash identity) {
  return F->S == S && sli_hash_equals(F->analysis, S->identity) &&
       sli_hash_equals(identity, S->identity);
}

SLI_INLINE sl_status sli_inverse_check(const sl_factor *F) {
  return !F->is_valid ? SL_ERR_STATE : F->E != NULL ? SL_ERR_UNSUPPORTED : SL_OK;
}

SLI_INLINE int sli_factor_may_change(const sl_factor *F) {
  return !F->is_immutable && sli_factor_is_over(F, F->S, F->analysis);
}

SLI_INLINE sl_status sli_fail(sli_failure *f, sl_status status, sl_int super, sl_int pivot,
                sl_off position, double value) {
  f->status = status;
  f->super = super;
  f->pivot = pivot;
  f->position = position;
  f->value = value;
  return status;
}

SLI_INLINE void sli_keep_first_failure(sli_failure *f, const sli_failure *other) {
  if (other->status != SL_OK && (f->status == SL_OK || other->super < f->super)) {
    *f = *other;
  }
}

static sl_int sli_column_of(const sl_csc *A, sl_int p) {
  sl_int low = 0, high = A->n_cols - 1;
  while (low < high) {
    const sl_int middle = low + (high - low + 1) / 2;
    if (A->p[middle] <= p) {
      low = middle;
    } else {
      high = middle - 1;
    }
  }
  return low;
}

SLI_INLINE double *sli_front_panel(const sl_factor *F, sl_int s, sl_int worker) {
  return F->storage == SL_STORAGE_FLOAT ? F->panels + F->panel_room * worker
                      : (double *)F->values + F->S->steps[s].panel;
}

SLI_ALWAYS_INLINE sl_status sli_panel_load_entries(const sl_factor *F, sl_int s, double *panel,
                           sl_off first, sl_off last, const double *x,
                           const sl_int *scatter_from,
                           sli_failure *failure) {
  const sl_off *to = F->S->scatter_to, begin = F->S->steps[s].panel;
  double largest = F->extents[s].entry;
  sl_off m;
  for (m = first; m < last; m++) {
    const double a =
      scatter_from != NULL ? x[scatter_from[m]] : x[m - first]; /* untested: constant */
    const double size = fabs(a);
    if (!sli_is_finite(a)) {
      return sli_fail(failure, SL_ERR_NOT_FINITE, s, -1, m, a);
    }
    panel[to[m] - begin] += a;
    largest = size > largest ? size : largest;
  }
  F->extents[s].entry = largest;
  return SL_OK;
}

#define SLI_SUM_ENTRIES 64

static void sli_source_sum(const sli_source *from, sl_off first, sl_int count, double *sums) {
  sl_int k, t;
  memset(sums, 0, (size_t)count * sizeof(double));
  for (t = 0; t < from->terms; t++) {
    const double c = from->coefficients[t], *v = from->values[t] + first;
    for (k = 0; k < count; k++) {
      const double product = c * v[k];
      sums[k] += product;
    }
  }
}

static sl_status sli_panel_load(const sl_factor *F, const sli_source *from, sl_int s, double *panel,
                sli_failure *failure) {
  const sl_symbolic *S = F->S;
  const sl_off end = S->scatter_begin[s + 1];
  sl_off m = S->scatter_begin[s], last;
  double sums[SLI_SUM_ENTRIES];
  sl_status status = SL_OK;
  F->extents[s].entry = F->extents[s].magnitude = 0.0;
  F->extents[s].pivot = -1;
  F->extents[s].zero = 0;
  if (from->A != NULL) {
    return sli_panel_load_entries(F, s, panel, m, end, from->A->x, S->scatter_from, failure);
  }
  for (; m < end && status == SL_OK; m = last) {
    last = end - m < SLI_SUM_ENTRIES ? end : m + SLI_SUM_ENTRIES;
    sli_source_sum(from, m, (sl_int)(last - m), sums);
    status = sli_panel_load_entries(F, s, panel, m, last, sums, NULL, failure);
  }
  return status;
}

SLI_INLINE int sli_is_skipped(const sl_factor *F, sl_int k) {
  return F->null_pivots == SL_NULL_PIVOT_SKIP && F->D[k] == SLI_NULL_PIVOT;
}

SLI_INLINE int sli_is_regularized(const sl_factor *F, sl_int k) {
  return F->rule.shifts != NULL && F->rule.shifts[k] != 0.0;
}

SLI_INLINE void sli_record_magnitude(const sl_factor *F, sl_int s, sl_int k, double magnitude) {
  if (magnitude > F->extents[s].magnitude) {
    F->extents[s].magnitude = magnitude;
    F->extents[s].pivot = k;
  }
}

SLI_INLINE sl_status sli_check_pivot(const sl_factor *F, sl_int s, sl_int k, double pivot,
                   double magnitude, sli_failure *failure) {
  sli_record_magnitude(F, s, k, magnitude);
  if (!sli_is_finite(pivot)) {
    return sli_fail(failure, SL_ERR_NOT_FINITE, s, k, -1, pivot);
  }
  if (!F->rule.replaces && sli_is_null(pivot, magnitude, F->rule.null_tolerance)) {
    return sli_fail(failure, SL_ERR_PIVOT, s, k, -1, pivot);
  }
  if (F->null_pivots == SL_NULL_PIVOT_SKIP && !sli_is_skipped(F, k) &&
    !(pivot * F->rule.signs[k] > 0.0)) {
    return sli_fail(failure, SL_ERR_PIVOT, s, k, -1, pivot);
  }
  return SL_OK;
}

SLI_INLINE sl_status sli_check_pair(const sl_factor *F, sl_int s, sl_int k, const double *magnitude,
                  sli_failure *failure) {
  double a, b, e;
  sl_int r;
  if (F->S->pairs[k] == SLI_PAIR_SECOND) {
    return SL_OK;
  }
  a = F->D[k];
  b = F->D[k + 1];
  e = F->E[k];
  for (r = 0; r < 2; r++) {
    sli_record_magnitude(F, s, k + r, magnitude[r] > fabs(e) ? magnitude[r] : fabs(e));
  }
  if (!sli_is_finite(a) || !sli_is_finite(b) || !sli_is_finite(e)) {
    return sli_fail(failure, SL_ERR_NOT_FINITE, s, k, -1,
            !sli_is_finite(a)   ? a
            : !sli_is_finite(b) ? b
                      : e);
  }
  if (!F->rule.replaces &&
    sli_pair_is_null(a, b, e, magnitude[0], magnitude[1], F->rule.null_tolerance)) {
    return sli_fail(failure, SL_ERR_PIVOT, s, k, -1, a);
  }
  return SL_OK;
}

SLI_INLINE void sli_pair_eigenvalues(const sl_factor *F, sl_int k, double *values) {
  const double a = F->D[k], b = F->D[k + 1], e = F->E[k];
  const double middle = 0.5 * a + 0.5 * b, half = 0.5 * a - 0.5 * b;
  const double size = fabs(half) > fabs(e) ? fabs(half) : fabs(e);
  const double x = size > 0.0 ? half / size : 0.0, y = size > 0.0 ? e / size : 0.0;
  const double radius = size * sqrt(x * x + y * y);
  values[0] = middle < 0.0 ? middle - radius : middle + radius;
  values[1] = a * (b / values[0]) - e * (e / values[0]);
}

SLI_INLINE void sli_count_pivot(sl_factor_info *info, double d) {
  const double size = fabs(d);
  if (info->positive + info->negative == 0) {
    info->pivot_min = size;
  }
  info->positive += d > 0.0;
  info->negative += d < 0.0;
  info->pivot_min = size < info->pivot_min ? size : info->pivot_min;
  info->pivot_max = size > info->pivot_max ? size : info->pivot_max;
}

static void sli_count_pivots(sl_factor *F, sl_int count) {
  sl_stats *stats = &F->stats;
  sl_int k;
  stats->factor.positive = stats->factor.negative = stats->factor.null =
    stats->factor.regularized = stats->factor.weak = 0;
  stats->factor.pivot_min = stats->factor.pivot_max = 0.0;
  for (k = 0; k < count; k++) {
    if (sli_is_skipped(F, k)) {
      stats->factor.null++;
      continue;
    }
    stats->factor.weak += F->rule.kinds != NULL && F->rule.kinds[k] == SLI_PIVOT_WEAK;
    if (sli_is_regularized(F, k)) {
      F->regularized[stats->factor.regularized++] = k;
    }
    if (F->E == NULL || F->S->pairs[k] == SLI_PAIR_NONE) {
      sli_count_pivot(&stats->factor, F->D[k]);
    } else if (F->S->pairs[k] == SLI_PAIR_FIRST) {
      double values[2];
      sli_pair_eigenvalues(F, k, values);
      sli_count_pivot(&stats->factor, values[0]);
      sli_count_pivot(&stats->factor, values[1]);
    }
  }
}

/* src/impl/factor/storage.h: L in double or in float: sweeps over it, its entries, panels that are rounded */

SLI_INLINE void sli_forward_sweep(const sl_factor *F, int kind, sl_int count, const sli_step *steps,
                  const sl_int *rows, double *x, double *scratch) {
  F->kernels->sweeps[F->storage].forward[kind](count, steps, rows, F->values, x, scratch);
}
SLI_INLINE void sli_backward_sweep(const sl_factor *F, int kind, sl_int count,
                   const sli_step *steps, const sl_int *rows_end, const double *D,
                   double *x, double *scratch) {
  F->kernels->sweeps[F->storage].backward[kind](count, steps, rows_end, F->values, D, x, scratch);
}

SLI_INLINE double sli_entry(const sl_factor *F, sl_off at) {
  return F->storage == SL_STORAGE_FLOAT ? (double)((const float *)F->values)[at]
                      : ((const double *)F->values)[at];
}

SLI_INLINE void sli_entry_clear(sl_factor *F, sl_off at) {
  if (F->storage == SL_STORAGE_FLOAT) {
    ((float *)F->values)[at] = 0.0F;
  } else {
    ((double *)F->values)[at] = 0.0;
  }
}

SLI_INLINE int sli_rounding_harms(const sli_front *f, sl_int r, sl_int j, double l) {
  const double d =
    f->E != NULL && f->E[j] != 0.0 ? fmax(fabs(f->D[j]), fabs(f->E[j])) : fabs(f->D[j]);
  if (fabs(l) > (double)FLT_MAX || d == SLI_NULL_PIVOT) {
    return d != SLI_NULL_PIVOT;
  }
  return l != 0.0 && fabs(l) < (double)FLT_MIN && ldexp(d, -252) > f->magnitude[r];
}

static sl_status sli_panel_round(const sl_factor *F, const sli_front *f, sl_int s,
                 sli_failure *failure) {
  const sl_int w = f->width, tiles = sli_tiles(w + f->below);
  float *to = (float *)F->values + F->S->steps[s].panel;
  const double *from = f->panel;
  sl_int t, j, r;
  for (t = 0; t < tiles; t++) {
    const sl_int columns = sli_min(w, SLI_TILE * (t + 1));
    for (j = 0; j < columns; j++, from += SLI_TILE, to += SLI_TILE) {
      int odd = 0;
      for (r = 0; r < SLI_TILE; r++) {
        const double size = fabs(from[r]);
        odd |= (size > (double)FLT_MAX) | ((size < (double)FLT_MIN) & (size > 0.0));
      }
      for (r = 0; r < SLI_TILE && odd; r++) {
        if (sli_rounding_harms(f, SLI_TILE * t + r, j, from[r])) {
          return sli_fail(failure, SL_ERR_INACCURATE, s, F->S->steps[s].column + j, -1,
                  f->D[j]);
        }
      }
      for (r = 0; r < SLI_TILE; r++) {
        to[r] = (float)from[r];
      }
    }
  }
  return SL_OK;
}

static void sli_panel_widen(const sl_factor *F, sl_int s, double *to) {
  const sl_off first = F->S->panel_begin[s], size = F->S->panel_begin[s + 1] - first;
  const float *from = (const float *)F->values + first;
  sl_off k;
  for (k = 0; k < size; k++) {
    to[k] = from[k];
  }
}

/* src/impl/factor/pivot_search.h: a multifrontal factorization that only selects 1x1 and 2x2 pivots by values */

#define SLI_PIVOT_THRESHOLD 0.01

typedef struct sli_contribution {
  void *block;
  sl_int delayed;
  sl_int count;
  sl_int *index;
  double *values;
} sli_contribution;

typedef struct sli_dense_front {
  sl_int rows, columns;
  sl_int *index;
  double *values;
  double *D, *E;
} sli_dense_front;

typedef struct sli_pivot_search {
  const sl_symbolic *S;
  sl_allocator allocator;
  sli_contribution *contributions;
  sl_int *local;
  sl_int *order;
  unsigned char *is_first;
  sl_int selected;
  sl_int delayed;
  void *front_block;
  size_t front_size;
} sli_pivot_search;

SLI_INLINE double *sli_dense_column(const sli_dense_front *f, sl_int j) {
  return f->values + (size_t)f->rows * (size_t)j;
}

static double sli_column_max(const double *column, sl_int first, sl_int last, sl_int a, sl_int b,
               sl_int *row) {
  double most = 0.0;
  sl_int i;
  for (i = first; i < last; i++) {
    const double size = fabs(column[i]);
    if (size > most && i != a && i != b) {
      most = size;
      *row = i;
    }
  }
  return most;
}

static int sli_pivot_test(const sli_dense_front *f, sl_int k, sl_int c, sl_int *partner) {
  const double *column = sli_dense_column(f, c), *other;
  sl_int t = -1, row = -1;
  double e, most, rest, a, b, room, rest_t;
  e = sli_column_max(column, k, f->columns, c, c, &t);
  rest = sli_column_max(column, f->columns, f->rows, c, c, &row);
  most = e > rest ? e : rest;
  if (fabs(column[c]) >= SLI_PIVOT_THRESHOLD * most && (column[c] != 0.0 || most == 0.0)) {
    return 1;
  }
  if (t == -1) {
    return 0;
  }
  other = sli_dense_column(f, t);
  rest = sli_column_max(column, k, f->rows, c, t, &row);
  rest_t = sli_column_max(other, k, f->rows, c, t, &row);
  a = fabs(column[c] / e);
  b = fabs(other[t] / e);
  room = e * fabs(column[c] / e * (other[t] / e) - 1.0) / SLI_PIVOT_THRESHOLD;
  *partner = t;
  return b * rest + rest_t <= room && rest + a * rest_t <= room ? 2 : 0;
}

static void sli_dense_swap(sli_dense_front *f, sl_int i, sl_int j) {
  double *a = sli_dense_column(f, i), *b = sli_dense_column(f, j);
  const sl_int index = f->index[i];
  sl_int k;
  if (i == j) {
    return;
  }
  for (k = 0; k < f->rows; k++) {
    const double keep = a[k];
    a[k] = b[k];
    b[k] = keep;
  }
  for (k = 0; k < f->columns; k++) {
    double *column = sli_dense_column(f, k);
    const double keep = column[i];
    column[i] = column[j];
    column[j] = keep;
  }
  f->index[i] = f->index[j];
  f->index[j] = index;
}

static void sli_dense_eliminate(sli_dense_front *f, sl_int k, int size) {
  double *u = sli_dense_column(f, k), *v = u;
  const double inverse = u[k] == 0.0 ? 0.0 : 1.0 / u[k];
  sl_int i, j;
  sli_pair_steps steps;
  memset(&steps, 0, sizeof steps);
  f->D[k] = u[k];
  f->E[k] = 0.0;
  if (size == 2) {
    v = sli_dense_column(f, k + 1);
    f->E[k] = u[k + 1];
    f->D[k + 1] = v[k + 1];
    f->E[k + 1] = 0.0;
    steps = sli_pair_eliminate(u[k], v[k + 1], u[k + 1]);
  }
  for (j = k + size; j < f->columns; j++) {
    double *column = sli_dense_column(f, j);
    double x = inverse * u[j], y;
    if (size == 2) {
      sli_pair_solve(&steps, u[j], v[j], &x, &y);
      for (i = k + 2; i < f->rows; i++) {
        column[i] -= u[i] * x + v[i] * y;
      }
    } else if (x != 0.0) {
      for (i = k + 1; i < f->rows; i++) {
        column[i] -= u[i] * x;
      }
    }
  }
  for (i = k + size; i < f->rows; i++) {
    if (size == 2) {
      sli_pair_solve(&steps, u[i], v[i], &u[i], &v[i]);
    } else {
      u[i] *= inverse;
    }
  }
}

static sl_int sli_dense_factor(sli_pivot_search *p, sli_dense_front *f) {
  sl_int k = 0, c = 0, failures = 0;
  while (k < f->columns && failures < f->columns - k) {
    sl_int partner = -1;
    const int size = sli_pivot_test(f, k, c, &partner);
    failures = size == 0 ? failures + 1 : 0;
    if (size > 0) {
      sli_dense_swap(f, k, c);
      if (size == 2) {
        sli_dense_swap(f, k + 1, partner == k ? c : partner);
      }
      sli_dense_eliminate(f, k, size);
      p->is_first[p->selected] = (unsigned char)(size == 2);
      p->order[p->selected++] = f->index[k];
      if (size == 2) {
        p->is_first[p->selected] = 0;
        p->order[p->selected++] = f->index[k + 1];
      }
      k += size;
    }
    c = c + 1 < f->columns ? sli_max(c + 1, k) : k;
  }
  return k;
}

static void sli_dense_update(const sli_dense_front *f, sl_int pivots) {
  sl_int i, j, k, m;
  for (j = f->columns; j < f->rows; j++) {
    double *to = sli_dense_column(f, j);
    for (k = 0; k < pivots; k += 4) {
      const double *l[4];
      double x[4];
      for (m = 0; m < 4; m++) {
        const sl_int c = sli_min(k + m, pivots - 1);
        l[m] = sli_dense_column(f, c);
        x[m] = k + m < pivots ? f->D[c] * l[m][j] : 0.0;
        if (k + m < pivots && f->E[c] != 0.0) {
          x[m] += f->E[c] * sli_dense_column(f, c + 1)[j];
        } else if (k + m < pivots && c > 0 && f->E[c - 1] != 0.0) {
          x[m] += f->E[c - 1] * sli_dense_column(f, c - 1)[j];
        }
      }
      for (i = j; i < f->rows; i++) {
        to[i] -= l[0][i] * x[0] + l[1][i] * x[1] + (l[2][i] * x[2] + l[3][i] * x[3]);
      }
    }
  }
}

SLI_INLINE void sli_dense_add(const sli_dense_front *f, sl_int i, sl_int j, double value) {
  const sl_int low = sli_min(i, j), high = sli_max(i, j);
  sli_dense_column(f, low)[high] += value;
  if (high < f->columns && low != high) {
    sli_dense_column(f, high)[low] += value;
  }
}

static sl_status sli_search_load(const sli_pivot_search *p, const sl_csc *A, sl_int s,
                 const sli_dense_front *f, sl_stats *stats) {
  const sl_symbolic *S = p->S;
  sl_int tile = sli_last_tile(S, s), i, j;
  sl_off m;
  for (m = S->scatter_begin[s + 1] - 1; m >= S->scatter_begin[s]; m--) {
    const sl_int from = S->scatter_from[m];
    if (!sli_is_finite(A->x[from])) {
      return sli_fail_at(stats, SL_ERR_NOT_FINITE, A->i[from], sli_column_of(A, from),
                 A->x[from]);
    }
    sli_scatter_map_pivots(S, s, m, &tile, &i, &j);
    sli_dense_add(f, p->local[i], p->local[j], A->x[from]);
  }
  return SL_OK;
}

static void sli_search_assemble(const sli_pivot_search *p, const sli_contribution *c,
                const sli_dense_front *f) {
  sl_int i, j;
  for (j = 0; j < c->count; j++) {
    const double *column = c->values + (size_t)c->count * (size_t)j;
    const sl_int to = p->local[c->index[j]];
    for (i = j; i < c->count; i++) {
      sli_dense_add(f, p->local[c->index[i]], to, column[i]);
    }
  }
}

static sl_status sli_search_front(sli_pivot_search *p, sl_int s, sli_dense_front *f) {
  const sl_symbolic *S = p->S;
  sli_block b = {NULL, 0, 0};
  sl_int c, k, at = 0;
  int pass;
  f->columns = S->steps[s].width;
  for (c = s - 1; c >= S->first_descendant[s]; c = S->first_descendant[c] - 1) {
    f->columns += p->contributions[c].delayed;
  }
  f->rows = f->columns + S->steps[s].below;
  for (pass = 0; pass < 2; pass++) {
    f->index = SLI_TAKE(&b, sl_int, f->rows);
    f->D = SLI_TAKE(&b, double, f->columns);
    f->E = SLI_TAKE(&b, double, f->columns);
    f->values = SLI_TAKE(&b, double, (uint64_t)f->rows *(uint64_t)f->rows);
    if (b.overflow) {
      return SL_ERR_TOO_LARGE;
    }
    if (pass == 0 && b.used > p->front_size) {
      sli_free(&p->allocator, p->front_block);
      p->front_size = 0;
      p->front_block = sli_alloc(&p->allocator, b.used);
      if (p->front_block == NULL) {
        return SL_ERR_MEMORY;
      }
      p->front_size = b.used;
    }
    b.base = (unsigned char *)p->front_block;
    b.used = 0;
  }
  for (c = s - 1; c >= S->first_descendant[s]; c = S->first_descendant[c] - 1) {
    for (k = 0; k < p->contributions[c].delayed; k++) {
      f->index[at++] = p->contributions[c].index[k];
    }
  }
  for (k = 0; k < S->steps[s].width; k++) {
    f->index[at++] = S->super_first[s] + k;
  }
  for (k = 0; k < S->steps[s].below; k++) {
    f->index[at++] = S->rows[S->rows_begin[s] + k];
  }
  for (k = 0; k < f->rows; k++) {
    p->local[f->index[k]] = k;
  }
  memset(f->values, 0, (size_t)f->rows * (size_t)f->rows * sizeof(double));
  return SL_OK;
}

static sl_status sli_search_keep(sli_pivot_search *p, sl_int s, const sli_dense_front *f,
                 sl_int pivots) {
  sli_contribution *c = &p->contributions[s];
  sli_block b = {NULL, 0, 0};
  sl_status status = SL_OK;
  sl_int j;
  int pass;
  c->delayed = f->columns - pivots;
  c->count = f->rows - pivots;
  p->delayed += c->delayed;
  for (pass = 0; pass < 2 && status == SL_OK; pass++) {
    c->index = SLI_TAKE(&b, sl_int, c->count);
    c->values = SLI_TAKE(&b, double, (uint64_t)c->count *(uint64_t)c->count);
    status = pass == 0 ? sli_block_alloc(&b, &p->allocator) : SL_OK;
  }
  if (status != SL_OK) {
    return status;
  }
  c->block = b.base;
  memcpy(c->index, f->index + pivots, (size_t)c->count * sizeof(sl_int));
  for (j = 0; j < c->count; j++) {
    memcpy(c->values + (size_t)c->count * (size_t)j + j,
         sli_dense_column(f, pivots + j) + pivots + j,
         (size_t)(c->count - j) * sizeof(double));
  }
  return SL_OK;
}

static sl_status sli_search_supernode(sli_pivot_search *p, const sl_csc *A, sl_int s,
                    sl_stats *stats) {
  const sl_symbolic *S = p->S;
  sli_dense_front f;
  sl_status status = sli_search_front(p, s, &f);
  sl_int c, k;
  if (status == SL_OK) {
    status = sli_search_load(p, A, s, &f, stats);
  }
  if (status != SL_OK) {
    return status;
  }
  for (c = s - 1; c >= S->first_descendant[s]; c = S->first_descendant[c] - 1) {
    sli_search_assemble(p, &p->contributions[c], &f);
    sli_free(&p->allocator, p->contributions[c].block);
    p->contributions[c].block = NULL;
  }
  k = sli_dense_factor(p, &f);
  if (S->super_parent[s] != -1) {
    sli_dense_update(&f, k);
    return sli_search_keep(p, s, &f, k);
  }
  for (; k < f.columns; k++) {
    p->is_first[p->selected] = 0;
    p->order[p->selected++] = f.index[k];
  }
  return SL_OK;
}

static void sli_search_layout(sli_pivot_search *p, sli_block *b) {
  p->contributions = SLI_TAKE(b, sli_contribution, p->S->n_supers);
  p->local = SLI_TAKE(b, sl_int, p->S->n);
  p->order = SLI_TAKE(b, sl_int, p->S->n);
  p->is_first = SLI_TAKE(b, unsigned char, p->S->n);
}

static sl_status sli_search_run(sli_pivot_search *p, const sl_csc *A, sl_stats *stats) {
  sl_status status = SL_OK;
  sl_int s;
  memset(p->contributions, 0, (size_t)p->S->n_supers * sizeof(sli_contribution));
  for (s = 0; s < p->S->n_supers && status == SL_OK; s++) {
    status = sli_search_supernode(p, A, s, stats);
  }
  for (s = 0; s < p->S->n_supers; s++) {
    sli_free(&p->allocator, p->contributions[s].block);
  }
  sli_free(&p->allocator, p->front_block);
  SLI_ASSERT(status != SL_OK || p->selected == p->S->n);
  return status;
}

/* src/impl/factor/pivoted.h: sl_symbolic_create_pivoted: an analysis whose order follows the values of a matrix */

static sl_status sli_pivoted_analyze(sl_symbolic **out, const sli_pivot_search *p, const sl_csc *A,
                   const sl_options *opt, sl_stats *stats) {
  sl_options given = sli_options_with(&p->allocator);
  const sl_symbolic_info *first = &p->S->stats.symbolic;
  sl_int k, pairs = 0;
  sl_stats found;
  sl_status status;
  for (k = 0; k < p->S->n; k++) {
    p->local[k] = p->S->perm[p->order[k]];
    pairs += p->is_first[k];
  }
  given.ordering = SL_ORDERING_GIVEN;
  given.perm = p->local;
  given.relaxation = opt == NULL ? SL_RELAXATION_DEFAULT : opt->relaxation;
  given.triangle = opt == NULL ? SL_TRIANGLE_NONE : opt->triangle;
  status = sli_symbolic_create(out, A, pairs > 0 ? p->is_first : NULL, &given, &found);
  if (status == SL_OK) {
    sl_symbolic_info *info = &(*out)->stats.symbolic;
    (*out)->is_pivoted = 1;
    info->delayed = p->delayed;
    info->seconds_order = first->seconds_order;
    info->seconds_analyze += first->seconds_analyze;
    if (stats != NULL) {
      stats->symbolic = *info;
    }
  }
  return status;
}

SL_API sl_status sl_symbolic_create_pivoted(sl_symbolic **out, const sl_csc *A,
                      const sl_options *opt, sl_stats *stats) {
  double started;
  sli_pivot_search p;
  sl_symbolic *S = NULL;
  sl_stats found;
  sli_block b = {NULL, 0, 0};
  sl_status status;
  int pass;
  sli_stats_clear_error(stats);
  if (out == NULL) {
    return SL_ERR_ARGUMENT;
  }
  *out = NULL;
  status = sl_symbolic_create(&S, A, opt, &found);
  if (status != SL_OK) {
    return stats == NULL ? status
               : sli_fail_at(stats, status, found.error.row, found.error.column,
                       found.error.value);
  }
  memset(&p, 0, sizeof p);
  p.S = S;
  p.allocator = S->allocator;
  started = sli_seconds();
  status = A->x == NULL && sli_nnz(A) > 0 ? SL_ERR_ARGUMENT : SL_OK;
  for (pass = 0; pass < 2 && status == SL_OK; pass++) {
    sli_search_layout(&p, &b);
    status = pass == 0 ? sli_block_alloc(&b, &p.allocator) : SL_OK;
  }
  status = status == SL_OK ? sli_search_run(&p, A, stats) : status;
  S->stats.symbolic.seconds_analyze += sli_seconds() - started;
  status = status == SL_OK ? sli_pivoted_analyze(out, &p, A, opt, stats) : status;
  sli_free(&p.allocator, b.base);
  sl_symbolic_free(S);
  return status;
}

/* src/impl/factor/scatter.h: scatters a matrix into a value array in the order of the scatter map */

typedef struct sli_scatter_work {
  sl_int *begin;
  sl_int *from;
  sl_int *to;
  sl_int *index;
  sl_int *head;
  sl_int *next;
  sl_int *row;
} sli_scatter_work;

static void sli_scatter_layout(sli_scatter_work *w, sli_block *b, const sl_symbolic *S,
                 sl_int entries) {
  sl_off most = 0;
  sl_int s;
  for (s = 0; s < S->n_supers; s++) {
    const sl_off here = S->scatter_begin[s + 1] - S->scatter_begin[s];
    most = here > most ? here : most;
  }
  w->begin = SLI_TAKE(b, sl_int, (size_t)S->n + 1);
  w->from = SLI_TAKE(b, sl_int, entries);
  w->to = SLI_TAKE(b, sl_int, entries);
  w->index = SLI_TAKE(b, sl_int, S->n);
  w->head = SLI_TAKE(b, sl_int, S->widest);
  w->next = SLI_TAKE(b, sl_int, most);
  w->row = SLI_TAKE(b, sl_int, most);
}

static void sli_scatter_sort(const sl_symbolic *S, sli_scatter_work *w, const sl_csc *K,
               sl_triangle triangle) {
  const sl_int *iperm = S->iperm;
  sl_int j, p, total = 0;
  memset(w->begin, 0, ((size_t)S->n + 1) * sizeof(sl_int));
  for (j = 0; j < S->n; j++) {
    for (p = K->p[j]; p < K->p[j + 1]; p++) {
      w->begin[sli_min(iperm[K->i[p]], iperm[j])] += sli_is_read(triangle, K->i[p], j);
    }
  }
  for (j = 0; j <= S->n; j++) {
    const sl_int here = w->begin[j];
    w->begin[j] = total;
    total += here;
  }
  for (j = 0; j < S->n; j++) {
    for (p = K->p[j]; p < K->p[j + 1]; p++) {
      if (sli_is_read(triangle, K->i[p], j)) {
        const sl_int at = w->begin[sli_min(iperm[K->i[p]], iperm[j])]++;
        w->from[at] = p;
        w->to[at] = sli_max(iperm[K->i[p]], iperm[j]);
      }
    }
  }
  memmove(w->begin + 1, w->begin, (size_t)S->n * sizeof(sl_int));
  w->begin[0] = 0;
}

static void sli_scatter_list(const sl_symbolic *S, sli_scatter_work *w, sl_int s) {
  const sl_off start = S->scatter_begin[s];
  sl_int k, j, m, tile = sli_last_tile(S, s);
  for (j = 0; j < S->steps[s].width; j++) {
    w->head[j] = -1;
  }
  for (m = (sl_int)(S->scatter_begin[s + 1] - start) - 1; m >= 0; m--) {
    sli_scatter_map_pivots(S, s, start + m, &tile, &k, &j);
    j -= S->super_first[s];
    w->row[m] = k;
    w->next[m] = w->head[j];
    w->head[j] = m;
  }
}

static sl_int sli_scatter_find(sli_scatter_work *w, sl_int j, sl_int head, sl_int start,
                 sl_int missing) {
  sl_int m, q;
  for (m = head; m != -1; m = w->next[m]) {
    w->index[w->row[m]] = start + m;
  }
  for (q = w->begin[j]; q < w->begin[j + 1]; q++) {
    w->to[q] = w->index[w->to[q]];
    missing = w->to[q] == -1 ? sli_min(missing, w->from[q]) : missing;
  }
  for (m = head; m != -1; m = w->next[m]) {
    w->index[w->row[m]] = -1;
  }
  return missing;
}

static sl_int sli_scatter_find_all(const sl_symbolic *S, sli_scatter_work *w) {
  sl_int s, j, missing = INT32_MAX;
  for (j = 0; j < S->n; j++) {
    w->index[j] = -1;
  }
  for (s = 0; s < S->n_supers; s++) {
    const sl_int first = S->super_first[s], last = S->super_first[s + 1];
    if (w->begin[first] < w->begin[last]) {
      sli_scatter_list(S, w, s);
      for (j = first; j < last; j++) {
        if (w->begin[j] < w->begin[j + 1]) {
          missing = sli_scatter_find(w, j, w->head[j - first],
                         (sl_int)S->scatter_begin[s], missing);
        }
      }
    }
  }
  return missing;
}

SL_API sl_int sl_symbolic_entries(const sl_symbolic *S) {
  return S == NULL ? 0 : (sl_int)S->scatter_begin[S->n_supers];
}

SL_API sl_status sl_symbolic_scatter(const sl_symbolic *S, double *values, const sl_csc *K,
                   sl_stats *stats) {
  sl_options opt;
  sli_scatter_work w;
  sli_block b = {NULL, 0, 0};
  sl_triangle triangle = SL_TRIANGLE_NONE;
  sl_int q, missing;
  int pass;
  sl_status status = sl_csc_check(K, stats);
  if (S == NULL || status != SL_OK) {
    return S == NULL ? SL_ERR_ARGUMENT : status;
  }
  if (K->n_rows != K->n_cols || (sli_nnz(K) > 0 && K->x == NULL) ||
    (sl_symbolic_entries(S) > 0 && values == NULL)) {
    return SL_ERR_ARGUMENT;
  }
  if (K->n_cols != S->n) {
    return SL_ERR_PATTERN;
  }
  memset(&w, 0, sizeof w);
  opt = sli_options_with(&S->allocator);
  status = sli_csc_triangle(K, &triangle, &opt, stats);
  for (pass = 0; pass < 2 && status == SL_OK; pass++) {
    sli_scatter_layout(&w, &b, S, sli_nnz(K));
    status = pass == 0 ? sli_block_alloc(&b, &S->allocator) : SL_OK;
  }
  if (status != SL_OK) {
    return status;
  }
  sli_scatter_sort(S, &w, K, triangle);
  missing = sli_scatter_find_all(S, &w);
  if (missing == INT32_MAX) {
    for (q = 0; q < sl_symbolic_entries(S); q++) {
      values[q] = 0.0;
    }
    for (q = 0; q < w.begin[S->n]; q++) {
      values[w.to[q]] += K->x[w.from[q]];
    }
  } else {
    status = sli_fail_at(stats, SL_ERR_PATTERN, K->i[missing], sli_column_of(K, missing),
               K->x[missing]);
  }
  sli_free(&S->allocator, b.base);
  return status;
}

/* src/impl/factor/uplooking.h: up-looking factorization: row by row, each a sparse triangular solve */

static void sli_row_link(sl_factor *F, sl_int s) {
  const sl_off at = F->S->rows_begin[s] + F->position[s];
  if (at < F->S->rows_begin[s + 1]) {
    const sl_int k = F->S->rows[at];
    F->next[s] = F->head[k];
    F->head[k] = s;
  }
}

static void sli_row_solve(sl_factor *F, sl_int s, sl_int q, double *pivot, double *magnitude) {
  const sl_symbolic *S = F->S;
  const sl_int first = S->super_first[s];
  F->kernels->row(sli_front_panel(F, s, 0), S->steps[s].width, q, S->rows + S->rows_begin[s],
          F->D + first, F->x + first, F->x, F->buffer, pivot, magnitude);
}

static void sli_row_solve_all(sl_factor *F, sl_int k, double *pivot, double *magnitude) {
  const sl_symbolic *S = F->S;
  const sl_int own = S->super_of[k];
  sl_int s, m, count = 0;
  for (s = F->head[k]; s != -1; s = F->next[s]) {
    F->list[count++] = sli_keyed(s, 0);
  }
  sli_sort(F->list, count, F->list_scratch);
  for (m = 0; m < count; m++) {
    s = sli_key(F->list[m]);
    sli_row_solve(F, s, S->steps[s].width + F->position[s], pivot, magnitude);
    F->position[s]++;
    sli_row_link(F, s);
  }
  if (k > S->super_first[own]) {
    sli_row_solve(F, own, k - S->super_first[own], pivot, magnitude);
  }
}

static sl_status sli_uplooking(sl_factor *F, const sli_source *from, sli_failure *failure) {
  const sl_symbolic *S = F->S;
  sl_status status = SL_OK;
  sl_int k;
  for (k = 0; k < S->n; k++) {
    F->head[k] = -1;
    F->x[k] = 0.0;
  }
  for (k = 0; k < S->n && status == SL_OK; k++) {
    const sl_int s = S->super_of[k], q = k - S->super_first[s];
    double *panel = sli_front_panel(F, s, 0), *diagonal, pivot, magnitude;
    if (q == 0) {
      const sl_off size = S->panel_begin[s + 1] - S->panel_begin[s];
      memset(panel, 0, (size_t)size * sizeof(double));
      status = sli_panel_load(F, from, s, panel, failure);
      if (status != SL_OK) {
        break;
      }
    }
    diagonal = panel + sli_panel_at(S->steps[s].width, q, q);
    pivot = *diagonal;
    magnitude = fabs(pivot);
    *diagonal = 0.0;
    sli_row_solve_all(F, k, &pivot, &magnitude);
    pivot = F->rule.replaces ? sli_pivot_by_rule(&F->rule, k, pivot, magnitude) : pivot;
    F->D[k] = pivot;
    status = sli_check_pivot(F, s, k, pivot, magnitude, failure);
    if (q == S->steps[s].width - 1) {
      F->position[s] = 0;
      sli_row_link(F, s);
    }
  }
  return status;
}

/* src/impl/factor/null_product.h: A z for a candidate z of the null space of A, and the components of A */

typedef struct sli_null_walk {
  sli_null_row *rows;
  const sl_int *perm, *iperm;
  int is_joined;
} sli_null_walk;

SLI_INLINE sl_int sli_null_walk_row(const sli_null_walk *w, sl_int k) {
  return w->perm == NULL ? k : w->perm[k];
}

SLI_INLINE sl_int sli_null_walk_pivot(const sli_null_walk *w, sl_int row) {
  return w->iperm == NULL ? row : w->iperm[row];
}

SLI_INLINE sl_int sli_component_last(sli_null_row *rows, sl_int i) {
  while (rows[i].up != i) {
    rows[i].up = rows[rows[i].up].up;
    i = rows[i].up;
  }
  return i;
}

SLI_INLINE void sli_null_join(const sli_null_walk *w, sl_int i, sl_int j) {
  if (w->rows[i].up != w->rows[j].up) {
    const sl_int x = sli_component_last(w->rows, i), y = sli_component_last(w->rows, j);
    const int x_is_later = sli_null_walk_pivot(w, x) > sli_null_walk_pivot(w, y);
    w->rows[x_is_later ? y : x].up = x_is_later ? x : y;
  }
}

SLI_INLINE void sli_null_add(sli_null_row *rows, sl_int i, sl_int j, double a) {
  const double term = a * rows[j].z;
  rows[i].product += term;
  rows[i].size += fabs(term);
  rows[i].entries++;
}

static int sli_null_add_columns(sli_null_row *rows, const sl_csc *A, sl_triangle triangle,
                double *diagonal) {
  int has_zero = 0;
  sl_int j, p;
  for (j = 0; j < A->n_cols; j++) {
    double product = 0.0, size = 0.0;
    sl_int entries = 0;
    for (p = A->p[j]; p < A->p[j + 1]; p++) {
      const sl_int i = A->i[p];
      const double a = A->x[p], term = a * rows[i].z;
      if (!sli_is_read(triangle, i, j)) {
        continue;
      }
      product += term;
      size += fabs(term);
      entries++;
      if (i != j) {
        sli_null_add(rows, i, j, a);
        has_zero |= a == 0.0;
      } else if (diagonal != NULL) {
        diagonal[j] = a;
      }
    }
    rows[j].product += product;
    rows[j].size += size;
    rows[j].entries += entries;
  }
  return has_zero;
}

static void sli_null_join_columns(const sli_null_walk *w, const sl_csc *A, sl_triangle triangle) {
  sl_int j, p;
  for (j = 0; j < A->n_cols; j++) {
    for (p = A->p[j]; p < A->p[j + 1]; p++) {
      if (A->x[p] != 0.0 && sli_is_read(triangle, A->i[p], j)) {
        sli_null_join(w, A->i[p], j);
      }
    }
  }
}

typedef struct sli_null_map_state {
  double *diagonal;
  sl_off to;
  sl_int k, j;
  double value;
} sli_null_map_state;

SLI_INLINE void sli_null_map_join(const sli_null_walk *w, const sli_null_map_state *p) {
  if (p->to != -1 && p->k != p->j && p->value != 0.0) {
    sli_null_join(w, p->k, p->j);
  }
}

static void sli_null_add_entries(const sli_null_walk *w, const sl_symbolic *S, sl_int s,
                 sl_off first, sl_int count, const double *values,
                 const sl_int *scatter_from, sl_int *tile, sli_null_map_state *p) {
  sl_int m;
  for (m = count - 1; m >= 0; m--) {
    const double a = values[scatter_from != NULL ? scatter_from[first + m] : m];
    if (S->scatter_to[first + m] != p->to) {
      sli_null_map_join(w, p);
      sli_scatter_map_pivots(S, s, first + m, tile, &p->k, &p->j);
      p->to = S->scatter_to[first + m];
      p->value = 0.0;
    }
    p->value += a;
    sli_null_add(w->rows, p->k, p->j, a);
    if (p->k != p->j) {
      sli_null_add(w->rows, p->j, p->k, a);
    } else if (p->diagonal != NULL) {
      p->diagonal[p->k] += a;
    }
  }
}

static void sli_null_add_map(const sli_null_walk *w, const sl_symbolic *S, const sli_source *from,
               double *diagonal) {
  double sums[SLI_SUM_ENTRIES];
  sli_null_map_state p;
  sl_int s;
  memset(&p, 0, sizeof p);
  p.diagonal = diagonal;
  p.to = -1;
  for (s = S->n_supers - 1; s >= 0; s--) {
    const sl_off begin = S->scatter_begin[s];
    sl_off end = S->scatter_begin[s + 1];
    sl_int tile = sli_last_tile(S, s);
    while (end > begin) {
      const sl_int count =
        (sl_int)(end - begin < SLI_SUM_ENTRIES ? end - begin : SLI_SUM_ENTRIES);
      end -= count;
      if (from->A != NULL) {
        sli_null_add_entries(w, S, s, end, count, from->A->x, S->scatter_from, &tile, &p);
      } else {
        sli_source_sum(from, end, count, sums);
        sli_null_add_entries(w, S, s, end, count, sums, NULL, &tile, &p);
      }
    }
  }
  sli_null_map_join(w, &p);
}

static int sli_map_has_duplicates(const sl_symbolic *S) {
  sl_off m;
  for (m = 1; m < S->scatter_begin[S->n_supers]; m++) {
    if (S->scatter_to[m] == S->scatter_to[m - 1]) {
      return 1;
    }
  }
  return 0;
}

static sli_null_walk sli_null_product(const sl_symbolic *S, const sli_source *from,
                    int by_columns, sli_null_row *rows, const double *z,
                    double *diagonal) {
  sli_null_walk w;
  sl_int i;
  w.rows = rows;
  w.perm = by_columns ? S->perm : NULL;
  w.iperm = by_columns ? S->iperm : NULL;
  for (i = 0; i < S->n; i++) {
    rows[i].z = z == NULL ? 1.0 : z[sli_null_walk_pivot(&w, i)];
    rows[i].product = rows[i].size = 0.0;
    rows[i].entries = 0;
    rows[i].up = i;
    if (diagonal != NULL) {
      diagonal[i] = 0.0;
    }
  }
  w.is_joined = 1;
  if (!by_columns) {
    sli_null_add_map(&w, S, from, diagonal);
  } else if (sli_null_add_columns(rows, from->A, S->stats.symbolic.triangle, diagonal)) {
    sli_null_join_columns(&w, from->A, S->stats.symbolic.triangle);
  } else {
    w.is_joined = 0;
  }
  return w;
}

SLI_INLINE int sli_null_row_is_zero(const sli_null_row *row) {
  const double bound = 16.0 * DBL_EPSILON * row->entries * row->size;
  return fabs(row->product) <= bound && sli_is_finite(bound);
}

static void sli_null_components(const sli_null_walk *w, const sl_symbolic *S, const double *z,
                sl_int *last, double *most) {
  sl_int k, i;
  for (k = S->n - 1; k >= 0; k--) {
    sl_int up = S->parent[k];
    if (w->is_joined) {
      i = sli_null_walk_row(w, k);
      up = w->rows[i].up == i ? -1 : sli_null_walk_pivot(w, w->rows[i].up);
    }
    last[k] = up == -1 ? k : last[up];
    most[k] = up == -1 && z != NULL && z[k] == 0.0 ? (double)INFINITY : 0.0;
  }
  for (i = 0; i < S->n; i++) {
    if (!sli_null_row_is_zero(&w->rows[i])) {
      most[last[sli_null_walk_pivot(w, i)]] = (double)INFINITY;
    }
  }
}

/* src/impl/factor/null_dense.h: dense operations on as many numbers as there are null vectors */

static double sli_null_project(const double *q, sl_int vectors, sl_int count, double *x) {
  double sum = 0.0;
  sl_int v, j;
  int pass;
  for (pass = 0; pass < 2; pass++) {
    for (v = 0; v < vectors; v++) {
      double dot = 0.0;
      for (j = 0; j < count; j++) {
        dot += q[v * count + j] * x[j];
      }
      for (j = 0; j < count; j++) {
        x[j] -= dot * q[v * count + j];
      }
    }
  }
  for (j = 0; j < count; j++) {
    sum += x[j] * x[j];
  }
  return sqrt(sum);
}

static void sli_null_complement(const double *q, sl_int vectors, sl_int count, double *c) {
  double all[SLI_NULL_VECTORS_MAX * SLI_NULL_VECTORS_MAX], x[SLI_NULL_VECTORS_MAX];
  sl_int v, i, j;
  memcpy(all, q, (size_t)(vectors * count) * sizeof(double));
  for (v = vectors; v < count; v++) {
    double most = -1.0;
    for (i = 0; i < count; i++) {
      double norm;
      memset(x, 0, sizeof x);
      x[i] = 1.0;
      norm = sli_null_project(all, v, count, x);
      if (norm > most) {
        most = norm;
        for (j = 0; j < count; j++) {
          all[v * count + j] = x[j] / norm;
        }
      }
    }
  }
  memcpy(c, all + vectors * count, (size_t)((count - vectors) * count) * sizeof(double));
}

static void sli_null_invert(double *a, sl_int m) {
  double b[SLI_NULL_VECTORS_MAX * SLI_NULL_VECTORS_MAX];
  sl_int i, j, k;
  memset(b, 0, sizeof b);
  for (k = 0; k < m; k++) {
    b[k * m + k] = 1.0;
  }
  for (k = 0; k < m; k++) {
    sl_int at = k;
    double inverse;
    for (i = k + 1; i < m; i++) {
      at = fabs(a[i * m + k]) > fabs(a[at * m + k]) ? i : at;
    }
    inverse = 1.0 / a[at * m + k];
    for (j = 0; j < m; j++) {
      const double x = a[at * m + j] * inverse, y = b[at * m + j] * inverse;
      a[at * m + j] = a[k * m + j];
      b[at * m + j] = b[k * m + j];
      a[k * m + j] = x;
      b[k * m + j] = y;
    }
    for (i = 0; i < m; i++) {
      const double c = a[i * m + k];
      for (j = 0; j < m && i != k; j++) {
        a[i * m + j] -= c * a[k * m + j];
        b[i * m + j] -= c * b[k * m + j];
      }
    }
  }
  memcpy(a, b, (size_t)(m * m) * sizeof(double));
}

/* src/impl/factor/null_basis.h: several null vectors in each component: which of them hold, and their anchors */

#define SLI_NULL_DEPENDENT 1e-11
#define SLI_NULL_ANCHOR 0.3
enum { SLI_NULL_IS_ANCHOR = -2  };

typedef struct sli_null_part {
  sl_factor *F;
  double *z;
  size_t n;
  sl_int last, count;
  sl_int rank;
} sli_null_part;

SLI_INLINE sli_null_part sli_null_part_of(sl_factor *F, sl_int last) {
  sli_null_part p;
  p.F = F;
  p.z = F->g;
  p.n = (size_t)F->S->n;
  p.last = last;
  p.count = p.rank = F->null_vectors;
  return p;
}

static void sli_null_chain(sl_factor *F) {
  sli_null_row *tails = F->rows;
  sl_int k;
  for (k = 0; k < F->S->n; k++) {
    tails[k].up = -1;
  }
  for (k = 0; k < F->S->n; k++) {
    F->chain[k] = tails[F->last[k]].up;
    tails[F->last[k]].up = k;
  }
}

static double sli_null_largest(const sli_null_part *p, sl_int j) {
  const double *z = p->z + (size_t)j * p->n;
  double largest = 0.0;
  sl_int k;
  for (k = p->last; k != -1; k = p->F->chain[k]) {
    largest = fabs(z[k]) > largest ? fabs(z[k]) : largest;
  }
  return largest;
}

static void sli_null_scale(const sli_null_part *p, sl_int j) {
  double *z = p->z + (size_t)j * p->n;
  int exponent;
  sl_int k;
  (void)frexp(sli_null_largest(p, j), &exponent);
  for (k = p->last; k != -1; k = p->F->chain[k]) {
    z[k] = ldexp(z[k], -exponent);
  }
}

static double sli_null_violation(const sli_null_part *p, const double *q, sl_int vectors,
                 double *x) {
  const double *product = p->F->products, *sizes = product + (size_t)p->count * p->n;
  double most = 0.0, y[SLI_NULL_VECTORS_MAX];
  sl_int k, j;
  for (k = p->last; k != -1; k = p->F->chain[k]) {
    double norm, ratio;
    if (!sli_is_finite(sizes[k])) {
      return (double)INFINITY;
    }
    if (sizes[k] == 0.0) {
      continue;
    }
    for (j = 0; j < p->count; j++) {
      y[j] = product[(size_t)k + (size_t)j * p->n] / sizes[k];
    }
    norm = sli_null_project(q, vectors, p->count, y);
    ratio = norm / (16.0 * DBL_EPSILON * p->F->row_entries[k]);
    if (ratio > most) {
      most = ratio;
      for (j = 0; j < p->count; j++) {
        x[j] = y[j] / norm;
      }
    }
  }
  return most;
}

static void sli_null_combine(const sli_null_part *p, const double *c, sl_int columns) {
  double x[SLI_NULL_VECTORS_MAX];
  sl_int k, v, j;
  for (k = p->last; k != -1; k = p->F->chain[k]) {
    double *z = p->z + k;
    for (j = 0; j < p->count; j++) {
      x[j] = z[(size_t)j * p->n];
    }
    for (v = 0; v < p->count; v++) {
      double sum = 0.0;
      for (j = 0; j < p->count && v < columns; j++) {
        sum += c[v * p->count + j] * x[j];
      }
      z[(size_t)v * p->n] = sum;
    }
  }
}

static sl_int sli_null_restrict(const sli_null_part *p) {
  double q[SLI_NULL_VECTORS_MAX * SLI_NULL_VECTORS_MAX];
  double c[SLI_NULL_VECTORS_MAX * SLI_NULL_VECTORS_MAX];
  sl_int vectors = 0;
  memset(q, 0, sizeof q);
  while (vectors < p->count) {
    const double ratio = sli_null_violation(p, q, vectors, q + vectors * p->count);
    if (!sli_is_finite(ratio)) {
      vectors = p->count;
    } else if (ratio > 1.0) {
      vectors++;
    } else {
      break;
    }
  }
  if (vectors > 0) {
    sli_null_complement(q, vectors, p->count, c);
    sli_null_combine(p, c, p->count - vectors);
  }
  return vectors;
}

static double sli_null_scalar(const sli_null_part *p, const double *a, const double *b) {
  double sum = 0.0;
  sl_int k;
  for (k = p->last; k != -1; k = p->F->chain[k]) {
    sum += a[k] * b[k];
  }
  return sum;
}

static void sli_null_subtract(const sli_null_part *p, double *a, const double *b, double c) {
  sl_int k;
  for (k = p->last; k != -1; k = p->F->chain[k]) {
    a[k] -= c * b[k];
  }
}

static void sli_null_orthonormalize(sli_null_part *p) {
  sl_int v, j, k;
  for (v = 0; v < p->count; v++) {
    double *z = p->z + (size_t)v * p->n, most = -1.0;
    sl_int at = v;
    int pass;
    for (j = v; j < p->count; j++) {
      const double *other = p->z + (size_t)j * p->n;
      const double square = sli_null_scalar(p, other, other);
      at = square > most ? j : at;
      most = square > most ? square : most;
    }
    for (k = p->last; k != -1; k = p->F->chain[k]) {
      const double swapped = z[k];
      z[k] = p->z[(size_t)k + (size_t)at * p->n];
      p->z[(size_t)k + (size_t)at * p->n] = swapped;
    }
    for (pass = 0; pass < 2; pass++) {
      for (j = 0; j < v && sqrt(most) > SLI_NULL_DEPENDENT; j++) {
        const double *q = p->z + (size_t)j * p->n;
        sli_null_subtract(p, z, q, sli_null_scalar(p, z, q));
      }
      most = sli_null_scalar(p, z, z);
    }
    if (sqrt(most) <= SLI_NULL_DEPENDENT) {
      break;
    }
    for (k = p->last; k != -1; k = p->F->chain[k]) {
      z[k] /= sqrt(most);
    }
    for (j = v + 1; j < p->count; j++) {
      double *other = p->z + (size_t)j * p->n;
      sli_null_subtract(p, other, z, sli_null_scalar(p, other, z));
    }
  }
  p->rank = v;
  for (; v < p->count; v++) {
    for (k = p->last; k != -1; k = p->F->chain[k]) {
      p->z[(size_t)k + (size_t)v * p->n] = 0.0;
    }
  }
}

static double sli_null_distance(const sli_null_part *p, sl_int k, const double *q, sl_int vectors,
                double *x) {
  sl_int j;
  for (j = 0; j < p->rank; j++) {
    x[j] = p->z[(size_t)k + (size_t)j * p->n];
  }
  return sli_null_project(q, vectors, p->rank, x);
}

static void sli_null_anchors(const sli_null_part *p, sl_int *anchors) {
  double q[SLI_NULL_VECTORS_MAX * SLI_NULL_VECTORS_MAX];
  sl_int v, j, k;
  for (v = 0; v < p->rank; v++) {
    double *x = q + v * p->rank, most = 0.0, distance = 0.0;
    for (k = p->last; k != -1; k = p->F->chain[k]) {
      distance = sli_null_distance(p, k, q, v, x);
      most = distance > most ? distance : most;
    }
    k = p->last;
    while ((distance = sli_null_distance(p, k, q, v, x)) < SLI_NULL_ANCHOR * most) {
      k = p->F->chain[k];
    }
    anchors[v] = k;
    for (j = 0; j < p->rank; j++) {
      x[j] /= distance;
    }
  }
}

static void sli_null_normalize(const sli_null_part *p, const sl_int *anchors, sl_int first) {
  double a[SLI_NULL_VECTORS_MAX * SLI_NULL_VECTORS_MAX], x[SLI_NULL_VECTORS_MAX];
  sl_int i, j, k;
  for (i = 0; i < p->rank; i++) {
    for (j = 0; j < p->rank; j++) {
      a[i * p->rank + j] = p->z[(size_t)anchors[i] + (size_t)j * p->n];
    }
  }
  sli_null_invert(a, p->rank);
  for (k = p->last; k != -1; k = p->F->chain[k]) {
    double *z = p->z + k;
    for (j = 0; j < p->count; j++) {
      x[j] = z[(size_t)j * p->n];
      z[(size_t)j * p->n] = 0.0;
    }
    for (i = 0; i < p->rank; i++) {
      for (j = 0; j < p->rank; j++) {
        z[(size_t)(first + i) * p->n] += x[j] * a[j * p->rank + i];
      }
    }
  }
  for (i = 0; i < p->rank; i++) {
    for (j = 0; j < p->rank; j++) {
      p->z[(size_t)anchors[i] + (size_t)(first + j) * p->n] = i == j ? 1.0 : 0.0;
    }
  }
}

static void sli_null_products(sl_factor *F, const sli_source *from, int by_columns) {
  const size_t n = (size_t)F->S->n;
  double *product = F->products, *sizes = product + (size_t)F->null_vectors * n;
  sl_int j, k;
  memset(sizes, 0, n * sizeof(double));
  for (j = 0; j < F->null_vectors; j++) {
    const sli_null_walk w = sli_null_product(F->S, from, by_columns, F->rows,
                         F->g + (size_t)j * n, NULL);
    for (k = 0; k < F->S->n; k++) {
      const sli_null_row *row = &F->rows[sli_null_walk_row(&w, k)];
      product[(size_t)k + (size_t)j * n] = row->product;
      sizes[k] += row->size;
      F->row_entries[k] = row->entries;
    }
  }
}

static void sli_null_bases_test(sl_factor *F, const sli_source *from, int by_columns) {
  sl_int k;
  for (k = 0; k < F->S->n; k++) {
    sli_null_part p = sli_null_part_of(F, k);
    for (; F->last[k] == k && p.rank > 0; p.rank--) {
      sli_null_scale(&p, p.rank - 1);
    }
  }
  sli_null_products(F, from, by_columns);
  for (k = 0; k < F->S->n; k++) {
    if (F->last[k] == k) {
      const sli_null_part p = sli_null_part_of(F, k);
      F->rounding[k] = sli_null_restrict(&p) < p.count ? 0.0 : (double)INFINITY;
    }
  }
}

static sl_status sli_null_bases(sl_factor *F, const sli_source *from, int by_columns,
                sli_failure *failure) {
  const sl_symbolic *S = F->S;
  sl_int anchors[SLI_NULL_VECTORS_MAX], k, j, rank, used = 0;
  memcpy(F->g, F->z, (size_t)S->n * (size_t)F->null_vectors * sizeof(double));
  sli_null_chain(F);
  sli_null_bases_test(F, from, by_columns);
  for (k = 0; k < S->n; k++) {
    if (F->last[k] == k) {
      sli_null_part p = sli_null_part_of(F, k);
      const int is_single = F->chain[k] == -1;
      if (F->rounding[k] == 0.0) {
        sli_null_orthonormalize(&p);
      } else {
        p.rank = 0;
      }
      F->rounding[k] = p.rank == 0 ? (double)INFINITY : 0.0;
      if (!is_single && used + p.rank > p.count) {
        return sli_fail(failure, SL_ERR_UNSUPPORTED, S->super_of[k], k, -1, 0.0);
      }
      sli_null_anchors(&p, anchors);
      rank = p.rank;
      p.rank = is_single ? 0 : rank;
      sli_null_normalize(&p, anchors, used);
      used += p.rank;
      for (j = 0; j < rank; j++) {
        F->chain[anchors[j]] = SLI_NULL_IS_ANCHOR;
      }
    }
    used = S->parent[k] == -1 ? 0 : used;
  }
  return SL_OK;
}

/* src/impl/factor/null_vectors.h: before a factorization: components of A, and which of them have a null vector */

static void sli_null_kinds_fill(sl_factor *F, const sli_null_walk *w, const double *diagonal) {
  sl_int k;
  for (k = 0; k < F->S->n; k++) {
    const sl_int last = F->last[k];
    F->rounding[k] = F->rounding[last];
    F->rule.signs[k] = diagonal[sli_null_walk_row(w, last)] < 0.0 ? -1 : 1;
    if (!sli_is_finite(F->rounding[k])) {
      F->rule.kinds[k] = SLI_PIVOT_UNKNOWN;
    } else if (F->null_vectors > 1 ? F->chain[k] == SLI_NULL_IS_ANCHOR : k == last) {
      F->rule.kinds[k] = SLI_PIVOT_NULL;
    } else if (F->rule.kinds[k] != SLI_PIVOT_WEAK) {
      F->rule.kinds[k] = SLI_PIVOT_KEPT;
    }
  }
}

static void sli_null_vectors_load(sl_factor *F) {
  const sl_symbolic *S = F->S;
  sl_int k, first = 0, only = -1, count = 0;
  for (k = 0; k < S->n; k++) {
    const sl_int last = F->last[k];
    if (last != k && last != only && F->rule.kinds[last] == SLI_PIVOT_NULL) {
      only = last;
      count++;
    }
    if (S->parent[k] == -1) {
      for (; first <= k; first++) {
        F->g[first] = count == 1 && F->last[first] == only ? F->z[first] : 0.0;
      }
      count = 0;
      only = -1;
    }
  }
}

SLI_INLINE int sli_signs_agree(double a, double b) {
  return a != 0.0 && b != 0.0 && !(a < 0.0 && b > 0.0) && !(a > 0.0 && b < 0.0);
}

static double sli_null_rounding(sl_int n) {
  return 16.0 * (64.0 + n / 8) * DBL_EPSILON;
}

static sl_status sli_null_vectors_check(sl_factor *F, const sli_source *from,
                    sli_failure *failure) {
  const sl_symbolic *S = F->S;
  const int is_one = F->null_vectors == 1, by_columns = from->A != NULL && !F->has_duplicates;
  const double rounding = sli_null_rounding(S->n), *z = is_one ? F->z : NULL;
  double *diagonal =
    is_one ? F->g : F->products + ((size_t)F->null_vectors + 1) * (size_t)S->n;
  const sli_null_walk w = sli_null_product(S, from, by_columns, F->rows, z, diagonal);
  sl_int i, refused = S->n;
  F->stats.factor.regular = 0;
  sli_null_components(&w, S, z, F->last, F->rounding);
  if (!is_one && sli_null_bases(F, from, by_columns, failure) != SL_OK) {
    memset(F->D, 0, (size_t)S->n * sizeof(double));
    return failure->status;
  }
  for (i = 0; i < S->n; i++) {
    const sl_int k = sli_null_walk_pivot(&w, i), last = F->last[k];
    const double of_last = diagonal[sli_null_walk_row(&w, last)];
    const double here = rounding * fabs(diagonal[i]);
    if (last != k && !sli_signs_agree(diagonal[i], of_last)) {
      refused = sli_min(refused, of_last == 0.0 ? last : k);
    }
    F->rounding[last] = here > F->rounding[last] ? here : F->rounding[last];
  }
  if (refused < S->n) {
    memset(F->D, 0, (size_t)S->n * sizeof(double));
    return sli_fail(failure, SL_ERR_PIVOT, S->super_of[refused], refused, -1,
            diagonal[sli_null_walk_row(&w, refused)]);
  }
  F->rule.rounding = F->rounding;
  sli_null_kinds_fill(F, &w, diagonal);
  if (is_one) {
    sli_null_vectors_load(F);
  }
  return SL_OK;
}

static int sli_nulls_remain(const sl_factor *F) {
  sl_int m, k;
  for (k = 0; F->null_vectors > 1 && k < F->S->n; k++) {
    if (F->rule.kinds[k] == SLI_PIVOT_NULL && !sli_is_skipped(F, k)) {
      return 0;
    }
  }
  for (m = 0; F->null_pivots == SL_NULL_PIVOT_SKIP && m < F->n_nulls; m++) {
    if (F->rule.kinds[F->nulls[m]] >= SLI_PIVOT_KEPT) {
      return 0;
    }
  }
  return 1;
}

static int sli_null_is_suspected(const sl_factor *F) {
  const sl_symbolic *S = F->S;
  const double rounding = sli_null_rounding(S->n);
  double most = 0.0;
  sl_int k;
  for (k = 0; k < S->n && !F->rule.replaces && F->rule.null_tolerance >= 0.0; k++) {
    most = fabs(F->D[k]) > most ? fabs(F->D[k]) : most;
    if (S->parent[k] == -1) {
      if (fabs(F->D[k]) <= rounding * most) {
        return 1;
      }
      most = 0.0;
    }
  }
  return 0;
}

#define SLI_SUSPECT_ROW (sizeof(sli_null_row) + sizeof(double) + sizeof(sl_int))

static int sli_null_suspect_fits(const sl_factor *F) {
  const sl_off entries = F->S->panel_begin[F->S->n_supers];
  return F->storage == SL_STORAGE_DOUBLE ||
       (double)entries * sizeof(float) >= (double)F->S->n * SLI_SUSPECT_ROW;
}

static sl_status sli_null_suspect_check(sl_factor *F, const sli_source *from,
                    sli_failure *failure) {
  const sl_symbolic *S = F->S;
  const double rounding = sli_null_rounding(S->n);
  sli_null_row *rows =
    (sli_null_row *)(sli_null_suspect_fits(F) ? F->values : (void *)F->panels);
  double *most = (double *)(void *)(rows + S->n);
  sl_int *last = (sl_int *)(void *)(most + S->n), k;
  const sli_null_walk w = sli_null_product(S, from, 0, rows, NULL, NULL);
  sli_null_components(&w, S, NULL, last, most);
  for (k = 0; k < S->n; k++) {
    const double size = fabs(F->D[k]) > rows[k].size ? fabs(F->D[k]) : rows[k].size;
    most[last[k]] = size > most[last[k]] ? size : most[last[k]];
  }
  for (k = 0; k < S->n; k++) {
    if (last[k] == k && most[k] <= DBL_MAX && fabs(F->D[k]) <= rounding * most[k]) {
      return sli_fail(failure, SL_ERR_PIVOT, S->super_of[k], k, -1, F->D[k]);
    }
  }
  return SL_OK;
}

/* src/impl/factor/multifrontal.h: the fronts of the supernodal factorization: each passes its update matrix up */

SLI_INLINE double *sli_update_of(const sl_factor *F, sl_int s, sl_int worker) {
  const sl_off begin = F->schedule.stack_begin[s], own = F->schedule.own;
  return F->stack + (begin < own ? begin + worker * own : begin);
}

static sli_front sli_front_of(const sl_factor *F, sl_int s, sl_int worker) {
  const sli_step *step = &F->S->steps[s];
  const sl_int rows = SLI_TILE * sli_tiles(F->S->tallest);
  sli_front f;
  f.panel = sli_front_panel(F, s, worker);
  f.width = step->width;
  f.below = step->below;
  f.update = sli_update_of(F, s, worker);
  f.D = F->D + step->column;
  f.pairs = F->E == NULL ? NULL : F->S->pairs + step->column;
  f.E = F->E == NULL ? NULL : F->E + step->column;
  f.magnitude = F->magnitude + (ptrdiff_t)worker * rows;
  f.reciprocals = F->reciprocals + (ptrdiff_t)worker * SLI_FRONT_RECIPROCALS;
  f.rule = &F->rule;
  f.column = step->column;
  return f;
}

SLI_INLINE sl_int sli_front_tiles(const sli_front *f) {
  return sli_tiles(f->width + f->below);
}

static void sli_front_clear(const sli_front *f, sl_int t0, sl_int t1) {
  const sl_int w = f->width, whole = w / SLI_TILE, u0 = sli_max(t0 - whole, 0);
  const sl_off from = sli_tile_offset(w, t0), size = sli_tile_offset(w, t1) - from;
  memset(f->panel + from, 0, (size_t)size * sizeof(double));
  if (f->below > 0 && t1 > whole) {
    const sl_off at = sli_triangle_offset(u0), end = sli_triangle_offset(t1 - whole);
    memset(f->update + at, 0, (size_t)(end - at) * sizeof(double));
  }
}

static sl_status sli_front_load(sl_factor *F, const sli_source *from, const sli_front *f, sl_int s,
                sli_failure *failure) {
  const sl_status status = sli_panel_load(F, from, s, f->panel, failure);
  sl_int k;
  for (k = 0; k < f->width; k++) {
    f->magnitude[k] = fabs(f->panel[sli_panel_at(f->width, k, k)]);
  }
  for (; k < SLI_TILE * sli_front_tiles(f); k++) {
    f->magnitude[k] = 0.0;
  }
  return status;
}

static void sli_front_assemble(const sl_factor *F, const sli_front *f, sl_int s, sl_int worker,
                 sl_int t0, sl_int t1) {
  const sl_symbolic *S = F->S;
  sl_int c, k;
  for (c = s - 1; c >= S->first_descendant[s]; c = S->first_descendant[c] - 1) {
    const sli_step *child = &S->steps[c];
    const sl_int *relative = S->relative + S->rows_begin[c];
    const double *from = sli_update_of(F, c, worker);
    const double *magnitude = from + child->width % SLI_TILE +
                  sli_triangle_offset(sli_update_tiles(child->width, child->below));
    const sl_int first = sli_lower_bound(relative, child->below, SLI_TILE * t0);
    const sl_int last = sli_lower_bound(relative, child->below, SLI_TILE * t1);
    F->kernels->assemble(f, from, child->width % SLI_TILE, relative, child->below, first, last);
    for (k = first; k < last; k++) {
      f->magnitude[relative[k]] += magnitude[k];
    }
  }
}

static void sli_front_hand_over(const sli_front *f) {
  const sl_int tiles = sli_update_tiles(f->width, f->below);
  memcpy(f->update + sli_triangle_offset(tiles),
       f->magnitude + SLI_TILE * (ptrdiff_t)(f->width / SLI_TILE),
       SLI_TILE * (size_t)tiles * sizeof(double));
}

static sl_status sli_front_check(const sl_factor *F, const sli_front *f, sl_int s,
                 sli_failure *failure) {
  const sl_int first = F->S->steps[s].column;
  sl_status status = SL_OK;
  sl_int k;
  for (k = 0; k < f->width && status == SL_OK; k++) {
    status = f->pairs != NULL && f->pairs[k] != SLI_PAIR_NONE
           ? sli_check_pair(F, s, first + k, f->magnitude + k, failure)
           : sli_check_pivot(F, s, first + k, f->D[k], f->magnitude[k], failure);
  }
  return status == SL_OK && F->storage == SL_STORAGE_FLOAT ? sli_panel_round(F, f, s, failure)
                               : status;
}

static void sli_front_eliminate(const sli_kernels *kernels, const sli_front *f, double *scratch) {
  const sl_int tiles = sli_front_tiles(f), ends = sli_tiles(f->width);
  sl_int c0;
  for (c0 = 0; c0 < ends; c0 += SLI_GROUP_TILES) {
    kernels->pivots(f, c0, scratch);
    kernels->rows(f, c0, sli_min(c0 + SLI_GROUP_TILES, ends), tiles, scratch);
  }
}

static void sli_front_update(const sli_kernels *kernels, const sli_front *f, double *scratch) {
  const sl_int whole = f->width / SLI_TILE, tiles = sli_front_tiles(f);
  if (f->below > 0) {
    kernels->update(f, whole, tiles, whole, tiles, scratch);
  }
}

static sl_status sli_front_factor(sl_factor *F, const sli_source *from, sl_int s, sl_int worker,
                  sli_failure *failure) {
  const sli_front f = sli_front_of(F, s, worker);
  const sl_int tiles = sli_front_tiles(&f);
  double *scratch = F->buffer + (ptrdiff_t)worker * sli_front_scratch(F->S->widest);
  sl_status status;
  sli_front_clear(&f, 0, tiles);
  status = sli_front_load(F, from, &f, s, failure);
  if (status != SL_OK) {
    return status;
  }
  sli_front_assemble(F, &f, s, worker, 0, tiles);
  sli_front_eliminate(F->kernels, &f, scratch);
  sli_front_update(F->kernels, &f, scratch);
  sli_front_hand_over(&f);
  return sli_front_check(F, &f, s, failure);
}

/* src/impl/factor/front_tasks.h: the multifrontal factorization as a list of tasks from which workers draw */

typedef enum sli_task_kind {
  SLI_TASK_NONE,
  SLI_TASK_SUBTREES,
  SLI_TASK_FRONT,
  SLI_TASK_LOAD,
  SLI_TASK_PIECE,
  SLI_TASK_FINISH
} sli_task_kind;

typedef struct sli_task {
  sli_task_kind kind;
  sl_int at;
  sl_int piece, step;
} sli_task;

typedef struct sli_job {
  sl_factor *F;
  const sli_source *from;
  sli_atomic lock;
  sli_atomic changes;
  sl_int next;
  sl_int left;
  sl_int n_ready;
  sl_int failed;
  sl_int rounded;
} sli_job;

enum { SLI_STEP_CLEAR, SLI_STEP_ASSEMBLE, SLI_STEP_ROWS };

SLI_INLINE sl_int sli_piece_begin(const sli_step *s, const sli_top *top, sl_int piece) {
  const sl_int groups = sli_front_groups(s->width);
  return piece < groups
         ? SLI_GROUP_TILES * piece
         : sli_min(sli_tiles(s->width) + (piece - groups) * top->piece_tiles,
             sli_tiles(s->width + s->below));
}

SLI_INLINE sl_int sli_piece_last_step(const sli_step *s, sl_int piece) {
  const sl_int groups = sli_front_groups(s->width);
  return SLI_STEP_ROWS + (piece < groups ? piece : groups - 1);
}

SLI_INLINE int sli_piece_has_update(const sli_step *s, const sli_top *top, sl_int piece) {
  return s->below > 0 && sli_piece_begin(s, top, piece + 1) > s->width / SLI_TILE;
}

SLI_INLINE int sli_piece_is_ready(const sli_step *s, const sli_top *top, sl_int piece,
                  sl_int step) {
  const sl_int last = sli_piece_last_step(s, piece), group = step - SLI_STEP_ROWS;
  if (step <= SLI_STEP_ASSEMBLE) {
    return step == SLI_STEP_CLEAR || top->is_loaded;
  }
  return step > last ? top->eliminated == top->pieces : group == piece || group < top->pivots;
}

static void sli_job_pass(sli_job *job, sl_int s) {
  const sli_schedule *p = &job->F->schedule;
  const sl_int up = job->F->S->super_parent[s];
  if (up != -1) {
    const sl_int at = sli_lower_bound(p->top, p->n_tops, up);
    if (--p->tops[at].waiting == 0) {
      p->ready[job->n_ready++] = at;
    }
  }
}

static void sli_job_end_front(sli_job *job, sl_int at) {
  job->left--;
  sli_job_pass(job, job->F->schedule.top[at]);
}

static void sli_job_end_large_front(sli_job *job, sl_int at) {
  sl_int *ready = job->F->schedule.ready, k;
  for (k = 0; ready[k] != at; k++) {
  }
  ready[k] = ready[--job->n_ready];
  job->rounded = -1;
  sli_job_end_front(job, at);
}

static int sli_top_draw(sli_job *job, sl_int at, sli_task *task) {
  const sli_schedule *p = &job->F->schedule;
  const sli_step *s = &job->F->S->steps[p->top[at]];
  sli_top *top = &p->tops[at];
  sl_int k;
  task->at = at;
  task->kind = SLI_TASK_LOAD;
  if (top->cleared == top->pieces && !top->is_loading) {
    return top->is_loading = 1;
  }
  task->kind = SLI_TASK_FINISH;
  if (top->updated == top->pieces) {
    return !top->is_finishing && (top->is_finishing = 1);
  }
  task->kind = SLI_TASK_PIECE;
  for (k = 0; k < top->pieces; k++) {
    sl_int *step = &p->steps[top->first_piece + k];
    const sl_int end = sli_piece_last_step(s, k) + sli_piece_has_update(s, top, k);
    if (*step >= 0 && *step <= end && sli_piece_is_ready(s, top, k, *step)) {
      task->piece = k;
      task->step = *step;
      *step = -1;
      return 1;
    }
  }
  return 0;
}

static sli_task sli_job_draw(sli_job *job) {
  const sli_schedule *p = &job->F->schedule;
  sli_task task = {SLI_TASK_NONE, 0, 0, 0};
  sl_int k = 0;
  while (k < job->n_ready) {
    const sl_int at = p->ready[k];
    const sli_top *top = &p->tops[at];
    const int is_whole = top->pieces == 0, skip = !top->is_begun && p->top[at] > job->failed;
    if (is_whole || skip) {
      p->ready[k] = p->ready[--job->n_ready];
      if (skip) {
        sli_job_end_front(job, at);
        continue;
      }
      task.kind = SLI_TASK_FRONT;
      task.at = at;
      return task;
    }
    if ((job->F->storage == SL_STORAGE_DOUBLE || job->rounded == -1 || job->rounded == at) &&
      sli_top_draw(job, at, &task)) {
      job->rounded = at;
      p->tops[at].is_begun = 1;
      return task;
    }
    k++;
  }
  task.kind = job->next < p->n_bundles ? SLI_TASK_SUBTREES : SLI_TASK_NONE;
  task.at = job->next;
  job->next += task.kind == SLI_TASK_SUBTREES;
  return task;
}

static void sli_job_return_piece(sli_job *job, const sli_task *task) {
  const sli_schedule *p = &job->F->schedule;
  const sli_step *s = &job->F->S->steps[p->top[task->at]];
  sli_top *top = &p->tops[task->at];
  const sl_int last = sli_piece_last_step(s, task->piece);
  const int has_update = sli_piece_has_update(s, top, task->piece);
  p->steps[top->first_piece + task->piece] = task->step + 1;
  top->cleared += task->step == SLI_STEP_CLEAR;
  top->pivots += task->step == last && task->piece < sli_front_groups(s->width);
  top->eliminated += task->step == last;
  top->updated += task->step == last + has_update;
}

static void sli_job_return(sli_job *job, const sli_task *task, sl_status status) {
  const sli_schedule *p = &job->F->schedule;
  sl_int m;
  switch (task->kind) {
  case SLI_TASK_SUBTREES:
    job->left--;
    for (m = task->at > 0 ? p->bundle_end[task->at - 1] : 0; m < p->bundle_end[task->at]; m++) {
      sli_job_pass(job, p->last[m]);
    }
    break;
  case SLI_TASK_PIECE:
    sli_job_return_piece(job, task);
    break;
  case SLI_TASK_FRONT:
    sli_job_end_front(job, task->at);
    break;
  default:
    if (task->kind == SLI_TASK_LOAD && status == SL_OK) {
      p->tops[task->at].is_loaded = 1;
    } else {
      sli_job_end_large_front(job, task->at);
    }
    break;
  }
}

static sli_front sli_large_front(const sl_factor *F, sl_int s) {
  const sli_step *step = &F->S->steps[s];
  sli_front f = sli_front_of(F, s, 0);
  f.magnitude = f.update + sli_update_size(step);
  f.reciprocals = f.magnitude + SLI_TILE * (ptrdiff_t)sli_front_tiles(&f);
  f.panel = sli_front_panel(F, s, F->schedule.workers);
  return f;
}

static void sli_piece_run(sl_factor *F, const sli_task *task, sl_int worker) {
  const sl_int s = F->schedule.top[task->at], piece = task->piece;
  const sli_step *step = &F->S->steps[s];
  const sli_top *top = &F->schedule.tops[task->at];
  const sl_int t0 = sli_piece_begin(step, top, piece), t1 = sli_piece_begin(step, top, piece + 1);
  const sl_int group = task->step - SLI_STEP_ROWS, whole = step->width / SLI_TILE;
  double *scratch = F->buffer + (ptrdiff_t)worker * sli_front_scratch(F->S->widest);
  sli_front f = sli_large_front(F, s);
  if (task->step == SLI_STEP_CLEAR) {
    sli_front_clear(&f, t0, t1);
  } else if (task->step == SLI_STEP_ASSEMBLE) {
    sli_front_assemble(F, &f, s, worker, t0, t1);
  } else if (task->step > sli_piece_last_step(step, piece)) {
    F->kernels->update(&f, whole, sli_front_tiles(&f), sli_max(t0, whole), t1, scratch);
  } else {
    f.reciprocals += SLI_FRONT_RECIPROCALS * (ptrdiff_t)group;
    if (group == piece) {
      F->kernels->pivots(&f, SLI_GROUP_TILES * group, scratch);
    } else {
      F->kernels->rows(&f, SLI_GROUP_TILES * group, t0, t1, scratch);
    }
  }
}

static void sli_subtrees_run(sl_factor *F, const sli_source *from, sl_int bundle, sl_int worker) {
  const sli_schedule *p = &F->schedule;
  sl_int m = bundle > 0 ? p->bundle_end[bundle - 1] : 0, s;
  for (; m < p->bundle_end[bundle]; m++) {
    sli_failure failure;
    sl_status status = SL_OK;
    for (s = p->first[m]; s <= p->last[m] && status == SL_OK; s++) {
      status = sli_front_factor(F, from, s, worker, &failure);
      if (status != SL_OK) {
        sli_keep_first_failure(&F->failures[worker], &failure);
      }
    }
  }
}

static sl_status sli_task_run(sl_factor *F, const sli_source *from, const sli_task *task,
                sl_int worker) {
  const sl_int s = task->kind == SLI_TASK_SUBTREES ? 0 : F->schedule.top[task->at];
  sli_failure failure;
  sli_front f;
  failure.status = SL_OK;
  switch (task->kind) {
  case SLI_TASK_SUBTREES:
    sli_subtrees_run(F, from, task->at, worker);
    break;
  case SLI_TASK_FRONT:
    (void)sli_front_factor(F, from, s, worker, &failure);
    break;
  case SLI_TASK_LOAD:
    f = sli_large_front(F, s);
    (void)sli_front_load(F, from, &f, s, &failure);
    break;
  case SLI_TASK_FINISH:
    f = sli_large_front(F, s);
    sli_front_hand_over(&f);
    (void)sli_front_check(F, &f, s, &failure);
    break;
  default:
    sli_piece_run(F, task, worker);
    break;
  }
  sli_keep_first_failure(&F->failures[worker], &failure);
  return failure.status;
}

static void sli_worker_run(void *data, sl_int worker) {
  sli_job *job = (sli_job *)data;
  const sli_failure *failure = &job->F->failures[worker];
  sli_task task = {SLI_TASK_NONE, 0, 0, 0};
  sl_status status = SL_OK;
  sli_atomic seen;
  sl_int left;
  int turn;
  for (;;) {
    sli_lock(&job->lock);
    if (failure->status != SL_OK) {
      job->failed = sli_min(job->failed, failure->super);
    }
    if (task.kind != SLI_TASK_NONE) {
      sli_job_return(job, &task, status);
      sli_atomic_write(&job->changes, job->changes + 1);
    }
    task = sli_job_draw(job);
    left = job->left;
    seen = job->changes;
    sli_unlock(&job->lock);
    if (task.kind != SLI_TASK_NONE) {
      status = sli_task_run(job->F, job->from, &task, worker);
    } else if (left == 0) {
      return;
    }
    if (task.kind == SLI_TASK_NONE) {
      for (turn = 0; sli_atomic_read(&job->changes) == seen; turn++) {
        sli_pause(turn);
      }
    }
  }
}

static void sli_job_begin(sli_job *job, sl_factor *F, const sli_source *from) {
  const sli_schedule *p = &F->schedule;
  sl_int m, k;
  memset(job, 0, sizeof *job);
  job->F = F;
  job->from = from;
  job->left = p->n_bundles + p->n_tops;
  job->failed = F->S->n_supers;
  job->rounded = -1;
  for (m = 0; m < p->n_tops; m++) {
    sli_top *top = &p->tops[m];
    top->waiting = top->children;
    top->cleared = top->pivots = top->eliminated = top->updated = 0;
    top->is_begun = top->is_loading = top->is_loaded = top->is_finishing = 0;
    for (k = 0; k < top->pieces; k++) {
      p->steps[top->first_piece + k] = SLI_STEP_CLEAR;
    }
    if (top->waiting == 0) {
      p->ready[job->n_ready++] = m;
    }
  }
  for (k = 0; k < p->workers; k++) {
    F->failures[k].status = SL_OK;
  }
}

static sl_status sli_multifrontal(sl_factor *F, const sli_source *from, sli_failure *failure) {
  sli_job job;
  sl_int k;
  sli_job_begin(&job, F, from);
  sli_parallel(&F->threads, F->schedule.workers, sli_worker_run, &job);
  for (k = 0; k < F->schedule.workers; k++) {
    sli_keep_first_failure(failure, &F->failures[k]);
  }
  return failure->status;
}

/* src/impl/factor/nullspace.h: after a factorization: the null pivots, and constants for centered solves */

static sl_status sli_mass_fill(sl_factor *F, const double *mass, sl_stats *stats) {
  const sl_symbolic *S = F->S;
  sl_int k, first = 0, any = 0;
  for (k = 0; k < S->n; k++) {
    const double m = mass[S->perm[k]];
    if (!sli_is_finite(m)) {
      return sli_fail_at(stats, SL_ERR_ARGUMENT, S->perm[k], -1, m);
    }
    F->mass[k] = m;
    any |= m != 0.0;
    if (S->parent[k] == -1) {
      for (; first <= k; first++) {
        F->mass[first] = any ? F->mass[first] : 1.0;
      }
      any = 0;
    }
  }
  return SL_OK;
}

static void sli_rows_nonzero(const sl_factor *F, double *flags) {
  const sl_symbolic *S = F->S;
  sl_int s, r, j;
  memset(flags, 0, (size_t)S->n * sizeof(double));
  for (s = 0; s < S->n_supers; s++) {
    const sli_step *step = &S->steps[s];
    for (r = 1; r < step->width + step->below; r++) {
      const sl_int row =
        r < step->width ? step->column + r : S->rows[S->rows_begin[s] + r - step->width];
      for (j = 0; j < sli_min(r, step->width); j++) {
        const double l = sli_entry(F, step->panel + sli_panel_at(step->width, r, j));
        flags[row] = l != 0.0 ? 1.0 : flags[row];
      }
    }
  }
}

static sl_status sli_anchors_find(sl_factor *F, sli_failure *failure) {
  const sl_symbolic *S = F->S;
  double *used = F->divisors;
  int has_used = 0;
  sl_int k, m = 0, first;
  F->n_anchors = 0;
  for (k = 0; k < S->n && m < F->n_nulls; k++) {
    sl_int anchor = -1;
    if (S->parent[k] != -1) {
      continue;
    }
    for (first = m; m < F->n_nulls && F->nulls[m] <= k; m++) {
    }
    if (m - first == 1) {
      anchor = F->nulls[first++];
    } else if (m - first > 1 && !has_used) {
      sli_rows_nonzero(F, used);
      has_used = 1;
    }
    for (; first < m; first++) {
      const sl_int null = F->nulls[first];
      if (used[null] != 0.0 && anchor != -1) {
        return sli_fail(failure, SL_ERR_PIVOT, S->super_of[null], null, -1, 0.0);
      }
      anchor = used[null] != 0.0 ? null : anchor;
    }
    if (anchor != -1) {
      F->anchors[F->n_anchors++] = anchor;
    }
  }
  return SL_OK;
}

static sl_status sli_center_tree(sl_factor *F, sl_int first, sl_int root, double total, sl_int m,
                 sli_failure *failure) {
  const sl_int anchor = m < F->n_anchors ? F->anchors[m] : F->S->n;
  double *v = F->center, a, sum = 0.0, z_m = 0.0, size = 0.0;
  sl_int k;
  if (anchor > root) {
    memset(v + first, 0, ((size_t)(root - first) + 1) * sizeof(double));
    return SL_OK;
  }
  a = v[anchor];
  if (!sli_is_finite(a) || !(fabs(a) > F->S->n * DBL_EPSILON * total)) {
    return sli_fail(failure, SL_ERR_PIVOT, F->S->super_of[anchor], anchor, -1, a);
  }
  F->ratios[m] = 1.0;
  if (F->g[anchor] != 0.0) {
    for (k = first; k <= root; k++) {
      const double term = F->last[k] == anchor ? F->z[k] / F->z[anchor] * F->mass[k] : 0.0;
      z_m += term;
      size += fabs(term);
    }
    if (!sli_is_finite(z_m) || !(fabs(z_m) > F->S->n * DBL_EPSILON * size)) {
      return sli_fail(failure, SL_ERR_PIVOT, F->S->super_of[anchor], anchor, -1, z_m);
    }
    F->ratios[m] = a / z_m;
  }
  for (k = first; k <= root; k++) {
    const double w = v[k] / a;
    v[k] = sli_is_skipped(F, k) ? 0.0 : w / F->D[k];
    sum += w * v[k];
  }
  F->divisors[anchor] = 1.0;
  F->squares[m] = sum;
  if (!sli_is_finite(sum) || !sli_is_finite(F->ratios[m])) {
    return sli_fail(failure, SL_ERR_NOT_FINITE, F->S->super_of[anchor], anchor, -1, sum);
  }
  return SL_OK;
}

static sl_status sli_center_compute(sl_factor *F, sli_failure *failure) {
  const sl_symbolic *S = F->S;
  const sli_reach all = sli_reach_all(S);
  sl_status status = sli_anchors_find(F, failure);
  double total = 0.0;
  sl_int k, first = 0, m = 0;
  memcpy(F->divisors, F->D, (size_t)S->n * sizeof(double));
  memcpy(F->center, F->mass, (size_t)S->n * sizeof(double));
  sli_forward_sweep(F, SLI_NRHS_1, all.count, all.steps, all.rows, F->center, F->center_scratch);
  for (k = 0; k < S->n && status == SL_OK; k++) {
    total += fabs(F->mass[k]);
    if (S->parent[k] == -1) {
      status = sli_center_tree(F, first, k, total, m, failure);
      m += m < F->n_anchors && F->anchors[m] <= k;
      total = 0.0;
      first = k + 1;
    }
  }
  return status;
}

static sl_status sli_null_pivots_verify(sl_factor *F, const sli_source *from,
                    sli_failure *failure) {
  const sl_symbolic *S = F->S;
  const sli_reach all = sli_reach_all(S);
  double *z = F->null_vectors == 1 ? F->g : F->products;
  uint64_t random = 1;
  sli_null_walk w;
  sl_status status = SL_OK;
  sl_int k, m, first = -1;
  for (m = F->n_nulls - 1; m >= 0; m--) {
    first = F->rule.kinds[F->nulls[m]] == SLI_PIVOT_UNKNOWN ? F->nulls[m] : first;
  }
  if (first == -1) {
    return SL_OK;
  }
  memset(z, 0, (size_t)S->n * sizeof(double));
  for (m = 0; m < F->n_nulls; m++) {
    k = F->nulls[m];
    if (F->rule.kinds[k] == SLI_PIVOT_UNKNOWN) {
      random = random * UINT64_C(6364136223846793005) + UINT64_C(1442695040888963407);
      z[k] = SLI_NULL_PIVOT * (0.5 + (double)(random >> 40) / 33554432.0);
    }
  }
  sli_backward_sweep(F, SLI_NRHS_1, all.count, all.steps, all.rows + all.n_rows, F->D, z,
             F->center_scratch);
  w = sli_null_product(S, from, from->A != NULL && !F->has_duplicates, F->rows, z, NULL);
  for (k = 0; k < S->n && status == SL_OK; k++) {
    if (!(fabs(w.rows[k].product) <= 1e-4 * w.rows[k].size)) {
      status = sli_fail(failure, SL_ERR_PIVOT, S->super_of[first], first, -1, 0.0);
    }
  }
  if (F->null_vectors == 1) {
    sli_null_vectors_load(F);
  }
  return status;
}

static void sli_anchor_columns_clear(sl_factor *F) {
  const sl_symbolic *S = F->S;
  sl_int m, r;
  for (m = 0; m < F->n_nulls && F->null_vectors > 1; m++) {
    const sl_int k = F->nulls[m];
    const sli_step *step = &S->steps[S->super_of[k]];
    for (r = k - step->column + 1; r < step->width + step->below; r++) {
      sli_entry_clear(F, step->panel + sli_panel_at(step->width, r, k - step->column));
    }
  }
}

static sl_status sli_nulls_find(sl_factor *F, const sli_source *from, sli_failure *failure) {
  sl_status status;
  sl_int k, m, regular = 0;
  F->n_nulls = 0;
  for (k = 0; k < F->S->n; k++) {
    regular += F->last[k] == k;
    if (sli_is_skipped(F, k)) {
      F->nulls[F->n_nulls++] = k;
    }
  }
  for (m = 0; m < F->n_nulls; m++) {
    double *mark = &F->rounding[F->last[F->nulls[m]]];
    regular -= *mark >= 0.0;
    *mark = -1.0;
  }
  F->stats.factor.regular = regular;
  F->is_centered = F->mass != NULL && F->n_nulls > 0;
  F->checks = F->mass == NULL && F->n_nulls > 0 && F->consistency >= 0.0;
  sli_anchor_columns_clear(F);
  status = sli_null_pivots_verify(F, from, failure);
  return status == SL_OK && F->is_centered ? sli_center_compute(F, failure) : status;
}

/* src/impl/factor/growth.h: after a factorization: its pivot growth, and the pivot that causes it */

#define SLI_GROWTH_LIMIT (1.0 / DBL_EPSILON)
#define SLI_GROWTH_LIMIT_FLOAT (1.0 / (double)FLT_EPSILON)

static sl_int sli_growth_cause(const sl_factor *F, sl_int k) {
  const sl_symbolic *S = F->S;
  const sl_int own = S->super_of[k];
  double most = 0.0;
  sl_int s, j, cause = -1;
  for (s = S->first_descendant[own]; s <= own; s++) {
    const sli_step *step = &S->steps[s];
    const sl_int *rows = S->rows + S->rows_begin[s];
    const sl_int at = s == own ? -1 : sli_lower_bound(rows, step->below, k);
    const sl_int r = s == own ? k - step->column : step->width + at;
    if (s != own && (at == step->below || rows[at] != k)) {
      continue;
    }
    for (j = 0; j < sli_min(r, step->width); j++) {
      const sl_off entry = step->panel + sli_panel_at(step->width, r, j);
      const sl_int c = step->column + j;
      const double l = sli_entry(F, entry);
      double size = fabs(l * F->D[c] * l);
      if (F->E != NULL && S->pairs[c] == SLI_PAIR_FIRST && j + 1 < r) {
        size += 2.0 * fabs(l * F->E[c] * sli_entry(F, entry + SLI_TILE));
      }
      if (size > most) {
        most = size;
        cause = step->column + j;
      }
    }
  }
  return cause;
}

SLI_INLINE double sli_growth(double magnitude, double entry) {
  return magnitude > 0.0 ? fmin(magnitude, DBL_MAX) / entry : 0.0;
}

static sl_status sli_growth_refuse(const sl_factor *F, sl_int first, sl_int last, double entry,
                   sli_failure *failure) {
  const double bound = F->growth_limit * entry;
  sl_int s = first, k, cause;
  while (s < last && !(sli_growth(F->extents[s].magnitude, entry) > F->growth_limit)) {
    s++;
  }
  k = F->extents[s].pivot;
  do {
    cause = sli_growth_cause(F, k);
    k = cause == -1 ? k : cause;
  } while (cause != -1 && fabs(F->D[k]) > bound);
  return sli_fail(failure, SL_ERR_INACCURATE, F->S->super_of[k], k, -1, F->D[k]);
}

static sl_status sli_growth_check(sl_factor *F, sli_failure *failure) {
  const sl_symbolic *S = F->S;
  sl_factor_info *info = &F->stats.factor;
  double entry = 0.0, magnitude = 0.0, growth;
  sl_int s, first = 0;
  for (s = 0; s < S->n_supers; s++) {
    entry = fmax(entry, F->extents[s].entry);
    magnitude = fmax(magnitude, F->extents[s].magnitude);
    if (S->super_parent[s] == -1) {
      growth = sli_growth(magnitude, entry);
      info->growth = fmax(info->growth, growth);
      info->entry_max = fmax(info->entry_max, entry);
      if (growth > F->growth_limit && failure->status == SL_OK) {
        (void)sli_growth_refuse(F, first, s, entry, failure);
      }
      entry = magnitude = 0.0;
      first = s + 1;
    }
  }
  return failure->status;
}

/* src/impl/factor/factor_setup.h: allocates a factor without numbers from the options, and releases it */

static void sli_factor_layout(sl_factor *F, sli_block *b, int has_mass) {
  const sl_symbolic *S = F->S;
  const size_t n = (size_t)S->n;
  F->D = SLI_TAKE(b, double, n);
  if (S->n_pairs > 0) {
    F->E = SLI_TAKE(b, double, n);
  }
  if (S->n_pairs > 0 || has_mass) {
    F->divisors = SLI_TAKE(b, double, n);
  }
  F->extents = SLI_TAKE(b, sli_extent, S->n_supers);
  if (F->rule.regularization != 0.0) {
    F->rule.signs = SLI_TAKE(b, signed char, n);
    F->rule.shifts = SLI_TAKE(b, double, n);
    F->regularized = SLI_TAKE(b, sl_int, n);
  }
  if (F->null_pivots == SL_NULL_PIVOT_SKIP) {
    F->nulls = SLI_TAKE(b, sl_int, n);
    F->rule.kinds = SLI_TAKE(b, signed char, n);
    F->z = SLI_TAKE(b, double, n *(uint64_t)F->null_vectors);
    F->g = SLI_TAKE(b, double, n *(uint64_t)F->null_vectors);
  }
  if (has_mass) {
    F->anchors = SLI_TAKE(b, sl_int, S->stats.symbolic.components);
    F->squares = SLI_TAKE(b, double, S->stats.symbolic.components);
    F->mass = SLI_TAKE(b, double, n);
    F->center = SLI_TAKE(b, double, n);
    F->ratios = SLI_TAKE(b, double, S->stats.symbolic.components);
  }
  F->values = F->storage == SL_STORAGE_FLOAT
          ? (void *)SLI_TAKE(b, float, S->panel_begin[S->n_supers])
          : (void *)SLI_TAKE(b, double, S->panel_begin[S->n_supers]);
}

static void sli_factor_layout_panels(sl_factor *F, sli_block *b) {
  const sl_symbolic *S = F->S;
  const uint64_t workers = (uint64_t)F->schedule.workers + (F->schedule.workers > 1);
  const uint64_t suspects =
    sli_null_suspect_fits(F) ? 0 : (uint64_t)S->n * SLI_SUSPECT_ROW / sizeof(double) + 1;
  sl_int s;
  for (s = 0; s < S->n_supers; s++) {
    const sl_off size = S->panel_begin[s + 1] - S->panel_begin[s];
    F->panel_room = size > F->panel_room ? size : F->panel_room;
  }
  F->panels = SLI_TAKE(b, double,
             workers *(uint64_t)F->panel_room > suspects
               ? workers *(uint64_t)F->panel_room
               : suspects);
}

static void sli_factor_layout_scratch(sl_factor *F, sli_block *b) {
  const sl_symbolic *S = F->S;
  const size_t n = (size_t)S->n, supers = (size_t)S->n_supers;
  const uint64_t workers = (uint64_t)F->schedule.workers;
  if (F->null_pivots == SL_NULL_PIVOT_SKIP) {
    F->rule.signs = SLI_TAKE(b, signed char, n);
    F->rows = SLI_TAKE(b, sli_null_row, n);
    F->last = SLI_TAKE(b, sl_int, n);
    F->rounding = SLI_TAKE(b, double, n);
    F->center_scratch = SLI_TAKE(b, double, sli_sweep_scratch(S->tallest, S->widest, 1));
    if (F->null_vectors > 1) {
      F->chain = SLI_TAKE(b, sl_int, n);
      F->row_entries = SLI_TAKE(b, sl_int, n);
      F->products = SLI_TAKE(b, double, n *((uint64_t)F->null_vectors + 2));
    }
  }
  if (F->method == SL_METHOD_SUPERNODAL) {
    const uint64_t rows = SLI_TILE * (uint64_t)sli_tiles(S->tallest);
    F->buffer = SLI_TAKE(b, double, workers *(uint64_t)sli_front_scratch(S->widest));
    F->magnitude = SLI_TAKE(b, double, workers *rows);
    F->reciprocals = SLI_TAKE(b, double, workers *SLI_FRONT_RECIPROCALS);
    F->failures = SLI_TAKE(b, sli_failure, workers);
    sli_schedule_layout(&F->schedule, b, S->n_supers);
    if (F->storage == SL_STORAGE_FLOAT) {
      sli_factor_layout_panels(F, b);
    }
  } else {
    F->buffer = SLI_TAKE(b, double, sli_sweep_scratch(S->tallest, 0, 1));
    F->x = SLI_TAKE(b, double, n);
    F->head = SLI_TAKE(b, sl_int, n);
    F->next = SLI_TAKE(b, sl_int, supers);
    F->position = SLI_TAKE(b, sl_int, supers);
    F->list = SLI_TAKE(b, uint64_t, supers);
    F->list_scratch = SLI_TAKE(b, uint64_t, supers);
  }
}

static sl_status sli_factor_schedule(sl_factor *F) {
  const sl_symbolic *S = F->S;
  sli_block b = {NULL, 0, 0};
  sli_schedule_work w;
  sl_status status = SL_OK;
  int pass;
  for (pass = 0; pass < 2 && status == SL_OK; pass++) {
    sli_schedule_work_layout(&w, &b, S->n_supers, F->schedule.workers);
    status = pass == 0 ? sli_block_alloc(&b, &F->allocator) : SL_OK;
  }
  if (status == SL_OK) {
    sli_schedule_fill(&F->schedule, S, &w);
    sli_free(&F->allocator, b.base);
    b.base = NULL;
    b.used = 0;
    for (pass = 0; pass < 2 && status == SL_OK; pass++) {
      F->stack = SLI_TAKE(&b, double, F->schedule.stack);
      sli_schedule_layout_tops(&F->schedule, S, &b);
      F->stats.factor.bytes += pass == 0 ? b.used : 0;
      status = pass == 0 ? sli_block_alloc(&b, &F->allocator) : SL_OK;
    }
    if (status == SL_OK) {
      sli_schedule_fill_tops(&F->schedule, S);
    }
  }
  return status;
}

static sl_status sli_factor_prepare(sl_factor *F) {
  const size_t bytes = F->stats.factor.bytes;
  sli_block b = {NULL, 0, 0};
  sl_status status = SL_OK;
  int pass;
  if (F->scratch != NULL) {
    return SL_OK;
  }
  for (pass = 0; pass < 2 && status == SL_OK; pass++) {
    sli_factor_layout_scratch(F, &b);
    F->stats.factor.bytes += pass == 0 ? b.used : 0;
    status = pass == 0 ? sli_block_alloc(&b, &F->allocator) : SL_OK;
  }
  if (status == SL_OK) {
    F->scratch = b.base;
    F->has_duplicates =
      F->null_pivots == SL_NULL_PIVOT_SKIP && sli_map_has_duplicates(F->S);
    status = F->method == SL_METHOD_SUPERNODAL ? sli_factor_schedule(F) : SL_OK;
  }
  if (status != SL_OK) {
    sli_free(&F->allocator, F->scratch);
    F->scratch = NULL;
    F->stats.factor.bytes = bytes;
  }
  return status;
}

static double sli_null_tolerance(sl_int n) {
  return (64.0 + n / 8) * DBL_EPSILON;
}

static int sli_factor_choices_are_valid(const sl_options *opt) {
  return opt == NULL ||
       ((unsigned)opt->method <= (unsigned)SL_METHOD_SUPERNODAL &&
      (unsigned)opt->storage <= (unsigned)SL_STORAGE_FLOAT &&
      (unsigned)opt->null_pivots <= (unsigned)SL_NULL_PIVOT_SKIP &&
      opt->null_tolerance == opt->null_tolerance &&
      opt->consistency_tolerance == opt->consistency_tolerance &&
      opt->growth_limit == opt->growth_limit && opt->error_limit == opt->error_limit &&
      opt->regularization >= 0.0 && sli_is_finite(opt->regularization) &&
      (opt->regularization == 0.0 || opt->null_pivots == SL_NULL_PIVOT_REFUSE) &&
      opt->null_vector_count <= SLI_NULL_VECTORS_MAX &&
      (opt->null_vector_count <= 1 || opt->null_vector != NULL));
}

static int sli_factor_options_are_valid(const sl_options *opt) {
  return sli_options_are_valid(opt, SLI_READS_FACTOR | SLI_READS_ISA) &&
       sli_factor_choices_are_valid(opt);
}

SLI_INLINE double sli_limit(double option, double limit) {
  return option == 0.0 ? limit : option < 0.0 ? (double)INFINITY : option;
}

static void sli_factor_rules(sl_factor *F, const sl_options *opt) {
  const double null = opt == NULL ? 0.0 : opt->null_tolerance;
  const double consistency = opt == NULL ? 0.0 : opt->consistency_tolerance;
  F->null_pivots = opt == NULL ? SL_NULL_PIVOT_REFUSE : opt->null_pivots;
  F->rule.null_tolerance = null == 0.0 ? sli_null_tolerance(F->S->n) : null;
  F->rule.regularization = opt == NULL ? 0.0 : opt->regularization;
  F->rule.replaces = F->null_pivots == SL_NULL_PIVOT_SKIP || F->rule.regularization != 0.0;
  F->null_vectors = opt == NULL || opt->null_vector_count == 0 ? 1
                                 : (sl_int)opt->null_vector_count;
  F->consistency = consistency == 0.0 ? 1e-6 : consistency;
  F->is_centered = F->null_pivots == SL_NULL_PIVOT_SKIP && opt->mass != NULL;
  F->growth_limit = sli_limit(opt == NULL ? 0.0 : opt->growth_limit,
                F->storage == SL_STORAGE_FLOAT ? SLI_GROWTH_LIMIT_FLOAT
                                 : SLI_GROWTH_LIMIT);
  F->error_limit = sli_limit(opt == NULL ? 0.0 : opt->error_limit, 1e-8);
}

static sl_status sli_factor_rules_fill(sl_factor *F, const sl_options *opt, sl_stats *stats) {
  const sl_symbolic *S = F->S;
  sl_int i, j;
  if (F->rule.regularization != 0.0 && opt->signs == NULL && S->is_pivoted) {
    memset(F->rule.signs, 0, (size_t)S->n);
  } else if (F->rule.regularization != 0.0 && opt->signs == NULL) {
    F->rule.signs = NULL;
  } else if (F->rule.regularization != 0.0) {
    for (i = 0; i < S->n; i++) {
      if (opt->signs[i] < -1 || opt->signs[i] > 1) {
        return sli_fail_at(stats, SL_ERR_ARGUMENT, i, -1, (double)opt->signs[i]);
      }
      F->rule.signs[S->iperm[i]] = (signed char)opt->signs[i];
    }
  }
  if (F->null_pivots == SL_NULL_PIVOT_SKIP) {
    memset(F->rule.kinds, 0, (size_t)S->n);
    for (j = 0; j < F->null_vectors; j++) {
      const size_t column = (size_t)j * (size_t)S->n;
      for (i = 0; i < S->n; i++) {
        const double z =
          opt->null_vector == NULL ? 1.0 : opt->null_vector[column + (size_t)i];
        if (!sli_is_finite(z)) {
          return sli_fail_at(stats, SL_ERR_ARGUMENT, i, -1, z);
        }
        F->z[column + (size_t)S->iperm[i]] = z;
      }
    }
  }
  return F->mass != NULL ? sli_mass_fill(F, opt->mass, stats) : SL_OK;
}

static sl_method sli_method(const sl_symbolic *S, const sl_options *opt) {
  if (S->n_pairs > 0 || (opt != NULL && opt->storage == SL_STORAGE_FLOAT)) {
    return SL_METHOD_SUPERNODAL;
  }
  if (opt != NULL && opt->method != SL_METHOD_AUTO) {
    return opt->method;
  }
  return S->stats.symbolic.flops < 8.0 * S->n_supers ? SL_METHOD_UP_LOOKING
                             : SL_METHOD_SUPERNODAL;
}

SL_API void sl_factor_free(sl_factor *F) {
  if (F != NULL) {
    const sl_allocator a = F->allocator;
    sli_free(&a, F->stack);
    sli_free(&a, F->scratch);
    sli_free(&a, F);
  }
}

static sl_status sli_factor_use(sl_factor *F, const sl_options *opt) {
  F->schedule.workers = 1;
  if (opt != NULL && F->method == SL_METHOD_SUPERNODAL) {
    F->threads = opt->threads;
    F->schedule.workers = sli_min(
      sli_workers_for(&opt->threads, sli_schedule_flops(F->S)), sli_max(F->S->n_supers, 1));
  }
  F->kernels = sli_kernels_select(opt == NULL ? SL_ISA_AUTO : opt->isa);
  if (F->kernels == NULL) {
    return SL_ERR_UNSUPPORTED;
  }
  F->stats.factor.isa = F->kernels->isa;
  F->stats.factor.method = F->method;
  return SL_OK;
}

static sl_status sli_factor_new(sl_factor **out, const sl_symbolic *S, const sl_options *opt,
                sl_stats *stats) {
  const double started = sli_seconds();
  const sl_allocator a = sli_allocator(opt);
  sl_factor draft;
  sli_block b = {NULL, 0, 0};
  sl_status status = SL_OK;
  int pass;
  memset(&draft, 0, sizeof draft);
  draft.allocator = a;
  draft.S = S;
  draft.analysis = S->identity;
  draft.storage = opt == NULL ? SL_STORAGE_DOUBLE : opt->storage;
  sli_factor_rules(&draft, opt);
  draft.method = sli_method(S, opt);
  status = (S->is_pivoted && draft.null_pivots == SL_NULL_PIVOT_SKIP) ||
           (draft.is_centered && draft.null_vectors > 1)
         ? SL_ERR_UNSUPPORTED
         : sli_factor_use(&draft, opt);
  for (pass = 0; pass < 2 && status == SL_OK; pass++) {
    (void)sli_take(&b, 1, sizeof(sl_factor));
    sli_factor_layout(&draft, &b, draft.is_centered);
    draft.stats.factor.bytes = b.used;
    status = pass == 0 ? sli_block_alloc(&b, &a) : SL_OK;
  }
  if (status == SL_OK) {
    sl_factor *F = (sl_factor *)(void *)b.base;
    *F = draft;
    if (F->E != NULL) {
      memset(F->E, 0, (size_t)S->n * sizeof(double));
    }
    status = sli_factor_prepare(F);
    status = status == SL_OK ? sli_factor_rules_fill(F, opt, stats) : status;
    F->stats.factor.seconds_setup = sli_seconds() - started;
    if (status == SL_OK) {
      *out = F;
    } else {
      sl_factor_free(F);
    }
  }
  return status;
}

/* src/impl/factor/factor.h: creates a factor, and refactors it with new values of the same pattern */

static sl_status sli_factor_check(const sl_symbolic *S, const sl_csc *A) {
  sli_hash pattern;
  if (A == NULL || (A->n_cols > 0 && A->p == NULL)) {
    return SL_ERR_ARGUMENT;
  }
  if (A->n_rows != S->n || A->n_cols != S->n || sli_nnz(A) != S->nnz_input) {
    return SL_ERR_PATTERN;
  }
  if (S->nnz_input > 0 && (A->i == NULL || A->x == NULL)) {
    return SL_ERR_ARGUMENT;
  }
  return sli_pattern_hash(A, &pattern) && sli_hash_equals(pattern, S->pattern) ? SL_OK
                                         : SL_ERR_PATTERN;
}

static sl_status sli_factor_fits(const sl_factor *F, const sl_csc *A) {
  return F->is_valid && sli_factor_is_over(F, F->S, F->analysis) ? sli_factor_check(F->S, A)
                                   : SL_ERR_STATE;
}

static void sli_factor_report_entry(sl_factor *F, const sl_csc *A, const sli_failure *f) {
  const sl_symbolic *S = F->S;
  sl_int row = -1, column = -1;
  if (f->position < 0) {
  } else if (A != NULL) {
    const sl_int p = S->scatter_from[f->position];
    row = A->i[p];
    column = sli_column_of(A, p);
  } else {
    sl_int k, j, tile = sli_last_tile(S, f->super);
    sli_scatter_map_pivots(S, f->super, f->position, &tile, &k, &j);
    row = sli_max(S->perm[k], S->perm[j]);
    column = sli_min(S->perm[k], S->perm[j]);
  }
  sli_fail_at(&F->stats, f->status, row, column, f->value);
}

static void sli_factor_report(sl_factor *F, const sl_csc *A, const sli_failure *f, int has_pivots) {
  sl_int n_done = F->S->n;
  if (f->status != SL_OK && f->pivot >= 0) {
    n_done = has_pivots ? n_done : f->pivot;
    sli_fail_at(&F->stats, f->status, F->S->perm[f->pivot], -1, f->value);
  } else if (f->status != SL_OK) {
    n_done = F->S->super_first[f->super];
    sli_factor_report_entry(F, A, f);
  }
  sli_count_pivots(F, n_done);
  F->stats.factor.null += f->status == SL_ERR_PIVOT;
}

static void sli_factor_stats_copy(const sl_stats *from, sl_stats *to) {
  to->factor = from->factor;
}

static void sli_factor_stats_report(const sl_factor *F, sl_stats *stats) {
  sli_factor_stats_copy(&F->stats, stats);
  stats->error.row = F->stats.error.row;
  stats->error.column = F->stats.error.column;
  stats->error.value = F->stats.error.value;
}

static void sli_pairs_done(sl_factor *F) {
  sl_int k;
  F->identity = sli_hash_words(F->identity, F->E, F->S->n);
  for (k = 0; k < F->S->n; k++) {
    F->divisors[k] = F->S->pairs[k] == SLI_PAIR_NONE ? F->D[k] : 1.0;
  }
}

static sl_status sli_factor_done(sl_factor *F, const sli_source *from, sli_failure *failure,
                 double started, sl_stats *stats) {
  int has_pivots;
  sli_stats_clear_error(&F->stats);
  if (failure->status == SL_OK && F->null_pivots == SL_NULL_PIVOT_SKIP) {
    (void)sli_nulls_find(F, from, failure);
  }
  F->stats.factor.growth = F->stats.factor.entry_max = 0.0;
  has_pivots = failure->status == SL_OK;
  if (has_pivots) {
    (void)sli_growth_check(F, failure);
  }
  sli_factor_report(F, from->A, failure, has_pivots);
  F->stats.factor.seconds = sli_seconds() - started;
  F->is_valid = failure->status == SL_OK;
  if (F->is_valid) {
    const sl_int storage = (sl_int)F->storage;
    if (F->storage != SL_STORAGE_DOUBLE) {
      F->identity = sli_hash_ints(F->identity, &storage, 1);
    }
    F->identity = sli_hash_words(F->identity, F->D, F->S->n);
    if (F->E != NULL) {
      sli_pairs_done(F);
    }
  }
  F->status = failure->status;
  if (stats != NULL) {
    sli_factor_stats_report(F, stats);
  }
  return failure->status;
}

static sli_source sli_source_matrix(const sl_csc *A) {
  sli_source from = {NULL, NULL, NULL, 0};
  from.A = A;
  return from;
}

static void sli_factor_identify(sl_factor *F, const sli_source *from) {
  const sl_symbolic *S = F->S;
  sl_int t;
  F->identity = S->identity;
  if (from->A != NULL) {
    F->identity = sli_hash_words(F->identity, from->A->x, sli_nnz(from->A));
    return;
  }
  F->identity = sli_hash_words(F->identity, from->coefficients, from->terms);
  for (t = 0; t < from->terms; t++) {
    F->identity = sli_hash_words(F->identity, from->values[t], S->scatter_begin[S->n_supers]);
  }
}

static void sli_factor_begin(sl_factor *F) {
  F->is_valid = 0;
  F->generation++;
}

static sl_status sli_factor_eliminate(sl_factor *F, const sli_source *from, sli_failure *failure) {
  return F->method == SL_METHOD_SUPERNODAL ? sli_multifrontal(F, from, failure)
                       : sli_uplooking(F, from, failure);
}

static sl_status sli_factor_numbers(sl_factor *F, const sli_source *from, double started,
                  sl_stats *stats) {
  sli_failure failure;
  sl_int t;
  memset(&failure, 0, sizeof failure);
  F->updates = 0;
  F->drift = 0.0;
  sli_factor_identify(F, from);
  for (t = 0; t < from->terms && failure.status == SL_OK; t++) {
    if (!sli_is_finite(from->coefficients[t])) {
      (void)sli_fail(&failure, SL_ERR_NOT_FINITE, 0, -1, -1, from->coefficients[t]);
    }
  }
  if (failure.status == SL_OK && F->null_pivots == SL_NULL_PIVOT_SKIP) {
    (void)sli_null_vectors_check(F, from, &failure);
  }
  if (failure.status == SL_OK && sli_factor_eliminate(F, from, &failure) == SL_OK &&
    sli_null_is_suspected(F) && sli_null_suspect_check(F, from, &failure) == SL_OK) {
    (void)sli_factor_eliminate(F, from, &failure);
  }
  return sli_factor_done(F, from, &failure, started, stats);
}

SL_API sl_status sl_factor_refactor(sl_factor *F, const sl_csc *A, sl_stats *stats) {
  const double started = sli_seconds();
  const sli_source from = sli_source_matrix(A);
  sl_status status;
  sli_stats_clear_error(stats);
  if (F == NULL) {
    return SL_ERR_ARGUMENT;
  }
  status = sli_factor_may_change(F) ? sli_factor_check(F->S, A) : SL_ERR_STATE;
  status = status == SL_OK ? sli_factor_prepare(F) : status;
  if (status != SL_OK) {
    return status;
  }
  sli_factor_begin(F);
  return sli_factor_numbers(F, &from, started, stats);
}

static sl_status sli_factor_create_from(sl_factor **out, const sl_symbolic *S,
                    const sli_source *from, const sl_options *opt,
                    sl_stats *stats) {
  sl_factor *F = NULL;
  sl_status status = sli_factor_new(&F, S, opt, stats);
  if (status == SL_OK) {
    sli_factor_begin(F);
    status = sli_factor_numbers(F, from, sli_seconds(), stats);
  }
  if (status == SL_OK) {
    *out = F;
  } else {
    sl_factor_free(F);
  }
  return status;
}

SL_API sl_status sl_factor_create(sl_factor **out, const sl_symbolic *S, const sl_csc *A,
                  const sl_options *opt, sl_stats *stats) {
  const sli_source from = sli_source_matrix(A);
  sl_status status;
  sli_stats_clear_error(stats);
  if (out == NULL) {
    return SL_ERR_ARGUMENT;
  }
  *out = NULL;
  if (S == NULL || !sli_factor_options_are_valid(opt)) {
    return SL_ERR_ARGUMENT;
  }
  status = sli_factor_check(S, A);
  return status == SL_OK ? sli_factor_create_from(out, S, &from, opt, stats) : status;
}

/* src/impl/factor/leftlooking.h: refactors after local changes, left-looking over the supernodes they reach */

typedef struct sli_left_work {
  sl_int *local;
  sl_int *relative;
} sli_left_work;

static void sli_left_work_layout(sli_left_work *p, sli_block *b, const sl_symbolic *S) {
  p->local = SLI_TAKE(b, sl_int, S->n);
  p->relative = SLI_TAKE(b, sl_int, S->tallest);
}

static void sli_left_update(const sl_factor *F, const sli_left_work *p, const sli_front *f,
              sl_int d, sl_int first, sl_int last, double *update) {
  const sl_symbolic *S = F->S;
  const sl_int *rows = S->rows + S->rows_begin[d];
  sli_front from = sli_front_of(F, d, 0);
  const sl_int w = from.width, tiles = sli_front_tiles(&from);
  const sl_int c0 = (w + first) / SLI_TILE, c1 = sli_tiles(w + last);
  sl_int t, r;
  from.update = update;
  for (t = c0; t < tiles; t++) {
    memset(from.update + sli_triangle_offset(t - c0), 0,
         (size_t)sli_min(t + 1 - c0, c1 - c0) * SLI_TILE * SLI_TILE * sizeof(double));
  }
  F->kernels->update(&from, c0, c1, c0, tiles, F->buffer);
  for (r = first; r < from.below; r++) {
    p->relative[r - first] = p->local[rows[r]];
  }
  F->kernels->assemble(f, from.update, (w + first) % SLI_TILE, p->relative, last - first, 0,
             from.below - first);
}

static void sli_left_magnitudes(const sl_factor *F, const sli_left_work *p, const sli_front *f,
                sl_int d, sl_int first, sl_int last) {
  const sli_front from = sli_front_of(F, d, 0);
  const sl_int w = from.width;
  sl_int r, j;
  for (r = first; r < last; r++) {
    const double *l = from.panel + sli_panel_at(w, w + r, 0);
    double *magnitude = f->magnitude + p->relative[r - first];
    for (j = 0; j < w; j++, l += SLI_TILE) {
      if (from.pairs != NULL && from.pairs[j] == SLI_PAIR_FIRST) {
        const sli_pair size = sli_pair_absolute(from.D[j], from.D[j + 1], from.E[j]);
        *magnitude += sli_pair_gain(&size, l[0], l[SLI_TILE]);
      } else if (from.pairs == NULL || from.pairs[j] == SLI_PAIR_NONE) {
        *magnitude += fabs(*l * *l * from.D[j]);
      }
    }
  }
}

static sl_status sli_left_factor(sl_factor *F, const sli_left_work *p, const sli_source *from,
                 sl_int s, sli_failure *failure) {
  const sl_symbolic *S = F->S;
  sli_front f = sli_front_of(F, s, 0);
  const sl_int *rows = S->rows + S->rows_begin[s];
  const sl_int start = S->super_first[s], end = S->super_first[s + 1];
  sl_int k, d;
  sl_status status;
  for (k = 0; k < f.width; k++) {
    p->local[start + k] = k;
  }
  for (k = 0; k < f.below; k++) {
    p->local[rows[k]] = f.width + k;
  }
  memset(f.panel, 0, (size_t)sli_panel_size(f.width, f.below) * sizeof(double));
  status = sli_front_load(F, from, &f, s, failure);
  if (status != SL_OK) {
    return status;
  }
  for (d = s - 1; d >= S->first_descendant[s];) {
    const sl_int *of = S->rows + S->rows_begin[d], below = S->steps[d].below;
    const sl_int first = sli_lower_bound(of, below, start);
    const sl_int last = first + sli_lower_bound(of + first, below - first, end);
    if (first < last) {
      sli_left_update(F, p, &f, d, first, last, F->stack);
      sli_left_magnitudes(F, p, &f, d, first, last);
      d--;
    } else {
      d = S->first_descendant[d] - 1;
    }
  }
  sli_front_eliminate(F->kernels, &f, F->buffer);
  return sli_front_check(F, &f, s, failure);
}

static sl_status sli_left_factor_all(sl_factor *F, const sli_left_work *p, const sli_source *from,
                   const uint64_t *seeds, sl_int count, sli_failure *failure) {
  const sl_symbolic *S = F->S;
  sl_status status = SL_OK;
  sl_int k = 0, s, next;
  while (k < count && status == SL_OK) {
    s = S->super_of[sli_key(seeds[k])];
    next = sli_next_seed(S, seeds, count, &k);
    for (; s != -1 && s < next && status == SL_OK; s = S->super_parent[s]) {
      status = sli_left_factor(F, p, from, s, failure);
    }
  }
  return status;
}

static sl_int sli_changed_seeds(const sl_symbolic *S, const sl_csc *A, const sl_int *columns,
                sl_int count, uint64_t *seeds, uint64_t *scratch) {
  sl_int k, p, total = 0;
  for (k = 0; k < count; k++) {
    const sl_int j = S->iperm[columns[k]];
    sl_int last = INT32_MAX;
    for (p = A->p[columns[k]]; p < A->p[columns[k] + 1]; p++) {
      const sl_int seed = sli_min(j, S->iperm[A->i[p]]);
      if (seed != last) {
        seeds[total++] = sli_keyed(seed, 0);
        last = seed;
      }
    }
  }
  sli_sort(seeds, total, scratch);
  return total;
}

SL_API sl_status sl_factor_refactor_changed(sl_factor *F, const sl_csc *A, const sl_int *columns,
                      sl_int count, sl_stats *stats) {
  const double started = sli_seconds();
  const sli_source from = sli_source_matrix(A);
  sli_left_work work;
  sli_block b = {NULL, 0, 0};
  uint64_t *seeds = NULL, *scratch = NULL, entries = 0;
  sli_failure failure;
  sl_status status;
  sl_int k;
  int pass;
  sli_stats_clear_error(stats);
  if (F == NULL || count < 0 || (count > 0 && columns == NULL)) {
    return SL_ERR_ARGUMENT;
  }
  status = F->is_immutable ? SL_ERR_STATE : sli_factor_fits(F, A);
  if (status != SL_OK) {
    return status;
  }
  for (k = 0; k < count; k++) {
    if (columns[k] < 0 || columns[k] >= F->S->n) {
      return sli_fail_at(stats, SL_ERR_ARGUMENT, columns[k], -1, 0.0);
    }
    entries += (uint64_t)(A->p[columns[k] + 1] - A->p[columns[k]]);
  }
  if (F->method != SL_METHOD_SUPERNODAL || F->storage == SL_STORAGE_FLOAT ||
    entries >= (uint64_t)sli_nnz(A)) {
    return sl_factor_refactor(F, A, stats);
  }
  status = sli_factor_prepare(F);
  for (pass = 0; pass < 2 && status == SL_OK; pass++) {
    seeds = SLI_TAKE(&b, uint64_t, entries);
    scratch = SLI_TAKE(&b, uint64_t, entries);
    sli_left_work_layout(&work, &b, F->S);
    status = pass == 0 ? sli_block_alloc(&b, &F->allocator) : SL_OK;
  }
  if (status != SL_OK) {
    return status;
  }
  memset(&failure, 0, sizeof failure);
  sli_factor_begin(F);
  for (k = 0; k < count; k++) {
    const sl_int p = A->p[columns[k]], q = A->p[columns[k] + 1];
    F->identity = sli_hash_ints(F->identity, &columns[k], 1);
    F->identity = sli_hash_words(F->identity, A->x + p, q - p);
  }
  count = sli_changed_seeds(F->S, A, columns, count, seeds, scratch);
  if (F->null_pivots == SL_NULL_PIVOT_SKIP) {
    (void)sli_null_vectors_check(F, &from, &failure);
  }
  if (failure.status == SL_OK && !sli_nulls_remain(F)) {
    sli_free(&F->allocator, b.base);
    return sli_factor_numbers(F, &from, started, stats);
  }
  if (failure.status == SL_OK) {
    (void)sli_left_factor_all(F, &work, &from, seeds, count, &failure);
  }
  sli_free(&F->allocator, b.base);
  if (failure.status == SL_OK && sli_null_is_suspected(F)) {
    return sli_factor_numbers(F, &from, started, stats);
  }
  return sli_factor_done(F, &from, &failure, started, stats);
}

/* src/impl/factor/factor_query.h: read access to a factor: statistics, null rows, determinant, L as a matrix */

SL_API void sl_factor_stats(const sl_factor *F, sl_stats *stats) {
  sli_stats_clear_error(stats);
  if (F != NULL && stats != NULL) {
    sli_factor_stats_copy(&F->stats, stats);
  }
}

SL_API sl_status sl_factor_logdet(const sl_factor *F, double *log_abs_det, double *sign) {
  double sum = 0.0;
  sl_int k;
  if (F == NULL || log_abs_det == NULL || sign == NULL) {
    return SL_ERR_ARGUMENT;
  }
  if (!F->is_valid) {
    return SL_ERR_STATE;
  }
  for (k = 0; k < F->S->n; k++) {
    if (F->E != NULL && F->S->pairs[k] == SLI_PAIR_FIRST) {
      double values[2];
      sli_pair_eigenvalues(F, k++, values);
      sum += log(fabs(values[0])) + log(fabs(values[1]));
    } else {
      sum += sli_is_skipped(F, k) ? 0.0 : log(fabs(F->D[k]));
    }
  }
  *log_abs_det = sum;
  *sign = F->stats.factor.negative % 2 == 0 ? 1.0 : -1.0;
  return SL_OK;
}

static sl_status sli_check_list(const sl_factor *F, const sl_int *rows, sl_int most,
                const sl_int *count) {
  if (F == NULL || count == NULL || most < 0 || (most > 0 && rows == NULL)) {
    return SL_ERR_ARGUMENT;
  }
  return F->is_valid ? SL_OK : SL_ERR_STATE;
}

SL_API sl_status sl_factor_null_rows(const sl_factor *F, sl_int *rows, sl_int most, sl_int *count) {
  const sl_status status = sli_check_list(F, rows, most, count);
  sl_int m;
  if (status != SL_OK) {
    return status;
  }
  *count = F->n_nulls;
  for (m = 0; m < sli_min(most, *count); m++) {
    rows[m] = F->S->perm[F->nulls[m]];
  }
  return SL_OK;
}

SL_API sl_status sl_factor_regularized_rows(const sl_factor *F, sl_int *rows, double *shifts,
                      sl_int most, sl_int *count) {
  const sl_status status = sli_check_list(F, rows, most, count);
  sl_int m;
  if (status != SL_OK) {
    return status;
  }
  *count = F->stats.factor.regularized;
  for (m = 0; m < sli_min(most, *count); m++) {
    rows[m] = F->S->perm[F->regularized[m]];
    if (shifts != NULL) {
      shifts[m] = F->rule.shifts[F->regularized[m]];
    }
  }
  return SL_OK;
}

static sl_off sli_factor_entries(const sl_factor *F, sl_matrix *M) {
  const sl_symbolic *S = F->S;
  sl_int s, j, r;
  sl_off count = 0;
  for (s = 0; s < S->n_supers; s++) {
    const sl_int first = S->super_first[s], width = S->steps[s].width,
           height = width + S->steps[s].below;
    for (j = 0; j < width; j++) {
      for (r = j; r < height; r++) {
        const double l =
          r == j ? 1.0 : sli_entry(F, S->panel_begin[s] + sli_panel_at(width, r, j));
        if (l != 0.0) {
          if (M != NULL) {
            M->i[count] = r < width ? first + r : S->rows[S->rows_begin[s] + r - width];
            M->x[count] = l;
          }
          count++;
        }
      }
      if (M != NULL) {
        M->p[first + j + 1] = (sl_int)count;
      }
    }
  }
  return count;
}

SL_API sl_status sl_factor_lower(sl_matrix **out, const sl_factor *F, const sl_options *opt) {
  const sl_allocator a = sli_allocator(opt);
  sl_off count;
  sl_status status;
  if (out == NULL) {
    return SL_ERR_ARGUMENT;
  }
  *out = NULL;
  if (F == NULL || !sli_options_are_valid(opt, SLI_READS_NOTHING)) {
    return SL_ERR_ARGUMENT;
  }
  if (!F->is_valid) {
    return SL_ERR_STATE;
  }
  count = sli_factor_entries(F, NULL);
  if (count > INT32_MAX) {      /* untested: 2^31 entries */
    return SL_ERR_TOO_LARGE; /* untested: the same */
  }
  status = sli_matrix_new(out, F->S->n, F->S->n, (sl_int)count, 1, &a);
  if (status == SL_OK) {
    (*out)->p[0] = 0;
    (void)sli_factor_entries(F, *out);
  }
  return status;
}

SL_API sl_factor_arrays sl_factor_view(const sl_factor *F) {
  sl_factor_arrays v = {NULL, NULL, NULL, NULL, NULL};
  if (F != NULL) {
    v.symbolic = F->S;
    v.L = F->storage == SL_STORAGE_DOUBLE ? (const double *)F->values : NULL;
    v.L_float = F->storage == SL_STORAGE_FLOAT ? (const float *)F->values : NULL;
    v.D = F->D;
    v.E = F->E;
  }
  return v;
}

/* src/impl/factor/combination.h: factorization of a weighted sum of value arrays in the order of the scatter map */

static sl_status sli_source_of_sum(const sl_symbolic *S, const double *coefficients,
                   const double *const *values, sl_int terms, sli_source *from) {
  sl_int t;
  if (terms < 0 || (terms > 0 && (coefficients == NULL || values == NULL))) {
    return SL_ERR_ARGUMENT;
  }
  for (t = 0; t < terms; t++) {
    if (values[t] == NULL && S->scatter_begin[S->n_supers] > 0) {
      return SL_ERR_ARGUMENT;
    }
  }
  from->A = NULL;
  from->values = values;
  from->coefficients = coefficients;
  from->terms = terms;
  return SL_OK;
}

SL_API sl_status sl_factor_create_combination(sl_factor **out, const sl_symbolic *S,
                        const double *coefficients,
                        const double *const *values, sl_int terms,
                        const sl_options *opt, sl_stats *stats) {
  sli_source from;
  sl_status status;
  sli_stats_clear_error(stats);
  if (out == NULL) {
    return SL_ERR_ARGUMENT;
  }
  *out = NULL;
  if (S == NULL || !sli_factor_options_are_valid(opt)) {
    return SL_ERR_ARGUMENT;
  }
  status = sli_source_of_sum(S, coefficients, values, terms, &from);
  return status == SL_OK ? sli_factor_create_from(out, S, &from, opt, stats) : status;
}

SL_API sl_status sl_factor_refactor_combination(sl_factor *F, const double *coefficients,
                        const double *const *values, sl_int terms,
                        sl_stats *stats) {
  const double started = sli_seconds();
  sli_source from;
  sl_status status;
  sli_stats_clear_error(stats);
  if (F == NULL) {
    return SL_ERR_ARGUMENT;
  }
  if (!sli_factor_may_change(F)) {
    return SL_ERR_STATE;
  }
  status = sli_source_of_sum(F->S, coefficients, values, terms, &from);
  status = status == SL_OK ? sli_factor_prepare(F) : status;
  if (status != SL_OK) {
    return status;
  }
  sli_factor_begin(F);
  return sli_factor_numbers(F, &from, started, stats);
}

/* solve: full and local solves */
/* src/impl/solve/region_types.h: the region object, and the product with its cached inverse */

struct sl_region {
  sl_allocator allocator;
  const sl_symbolic *S;
  sli_hash analysis;
  sli_hash identity;
  sli_numbers numbers;
  sli_region_extent extent;
  sl_int *roots, *rows;
  sl_int *requested;
  sl_int *relative;
  sl_off *begin;
  double *Z;
  int is_copied;
  int is_mapped;
  int is_immutable;
  double seconds;
  size_t bytes;
};

#define SLI_REGION_COLUMNS 8

SLI_INLINE sl_int sli_region_chunks(sl_int rows) {
  return rows / SLI_REGION_COLUMNS + (rows % SLI_REGION_COLUMNS != 0);
}

SLI_INLINE sli_step sli_region_step(const sl_region *R, sl_int first) {
  sli_step step;
  step.panel = R->begin[first / SLI_REGION_COLUMNS];
  step.column = 0;
  step.base = first;
  step.width = sli_min(SLI_REGION_COLUMNS, R->extent.n_rows - first);
  step.below = R->extent.n_rows - first;
  step.first_tile = 0;
  step.up = -1;
  return step;
}

static sl_off sli_region_entries(sl_int rows) {
  sl_off size = 0;
  sl_int first;
  for (first = 0; first < rows; first += SLI_REGION_COLUMNS) {
    size += sli_panel_size(sli_min(SLI_REGION_COLUMNS, rows - first), rows - first);
  }
  return size;
}

static void sli_region_layout(sl_region *R, sli_block *b) {
  const sl_int rows = R->extent.n_rows;
  (void)sli_take(b, 1, sizeof(sl_region));
  R->roots = SLI_TAKE(b, sl_int, R->extent.n_roots);
  R->rows = SLI_TAKE(b, sl_int, rows);
  R->requested = SLI_TAKE(b, sl_int, rows);
  R->relative = SLI_TAKE(b, sl_int, rows);
  R->begin = SLI_TAKE(b, sl_off, (uint64_t)sli_region_chunks(rows) + 1);
  R->Z = R->is_mapped ? R->Z : SLI_TAKE(b, double, sli_region_entries(rows));
  R->bytes = b->used;
}

SLI_INLINE int sli_region_fits(const sl_region *R, const sl_factor *F) {
  return sli_numbers_are_of(&R->numbers, F);
}

SLI_INLINE uint64_t sli_region_vectors(const sl_region *R, sl_int lanes) {
  return 3 * (uint64_t)R->extent.n_rows * (uint64_t)lanes;
}

SLI_INLINE size_t sli_region_scratch(const sl_region *R, sl_int lanes) {
  return sli_sweep_scratch(SLI_REGION_COLUMNS + R->extent.n_rows, SLI_REGION_COLUMNS, lanes);
}

typedef struct sli_boundary_use {
  const unsigned char *b, *x;
  sl_off entries;
} sli_boundary_use;

static void sli_region_apply(const sl_region *R, const sli_boundary_use *boundary,
               const sli_kernels *kernels, int kind, const double *u, double *x,
               double *vectors, double *scratch) {
  static const double sli_ones[SLI_REGION_COLUMNS] = {1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0};
  const sli_sweeps *sweeps = &kernels->sweeps[SL_STORAGE_DOUBLE];
  const sl_int n = R->extent.n_rows;
  const size_t size = (size_t)n << kind;
  sl_int first;
  if (n == 0) {
    return;
  }
  memcpy(vectors, u, size * sizeof(double));
  memset(vectors + size, 0, size * sizeof(double));
  memcpy(vectors + 2 * size, u, size * sizeof(double));
  for (first = 0; first < n; first += SLI_REGION_COLUMNS) {
    const sli_step step = sli_region_step(R, first);
    if (boundary->b[first / SLI_REGION_COLUMNS]) {
      sweeps->forward[kind](1, &step, R->relative + first, R->Z, vectors, scratch);
    }
    if (boundary->x[first / SLI_REGION_COLUMNS]) {
      sweeps->backward[kind](1, &step, R->relative + n, R->Z, sli_ones, vectors + size,
                   scratch);
    }
  }
  memcpy(x, vectors + size, size * sizeof(double));
}

/* src/impl/solve/work.h: the workspace: one block of scratch memory that only grows */

struct sl_work {
  sl_allocator allocator;
  void *block;
  size_t size;
};

static sl_status sli_work_grow(sl_work *W, size_t bytes) {
  void *block;
  if (bytes <= W->size) {
    return SL_OK;
  }
  block = sli_alloc(&W->allocator, bytes);
  if (block == NULL) {
    return bytes == SIZE_MAX ? SL_ERR_TOO_LARGE : SL_ERR_MEMORY;
  }
  sli_free(&W->allocator, W->block);
  W->block = block;
  W->size = bytes;
  return SL_OK;
}

static sl_work sli_work_own(const sl_allocator *a) {
  sl_work own;
  own.allocator = *a;
  own.block = NULL;
  own.size = 0;
  return own;
}

static sl_status sli_work_block(sl_work *W, sli_block *b) {
  const sl_status status = sli_work_grow(W, b->used);
  b->base = (unsigned char *)W->block;
  b->used = 0;
  return status;
}

typedef struct sli_stage {
  void (*layout)(void *q, sli_block *b);
  void (*fill)(void *q);
} sli_stage;

static sl_status sli_work_stages(sl_work *W, const sli_stage *stages, int count, void *q) {
  sli_block b = {(unsigned char *)W->block, 0, 0};
  int k = 0;
  while (k < count) {
    sli_block trial = {NULL, b.used, 0};
    stages[k].layout(q, &trial);
    if (trial.used > W->size) {
      const sl_status status = sli_work_grow(W, trial.used);
      if (status != SL_OK) {
        return status;
      }
      b.base = (unsigned char *)W->block;
      b.used = 0;
      k = 0;
      continue;
    }
    stages[k].layout(q, &b);
    if (stages[k].fill != NULL) {
      stages[k].fill(q);
    }
    k++;
  }
  return SL_OK;
}

SL_API sl_status sl_work_create(sl_work **out, const sl_options *opt) {
  const sl_allocator a = sli_allocator(opt);
  if (out == NULL) {
    return SL_ERR_ARGUMENT;
  }
  *out = NULL;
  if (!sli_options_are_valid(opt, SLI_READS_NOTHING)) {
    return SL_ERR_ARGUMENT;
  }
  *out = (sl_work *)sli_alloc(&a, sizeof(sl_work));
  if (*out == NULL) {
    return SL_ERR_MEMORY;
  }
  **out = sli_work_own(&a);
  return SL_OK;
}

SL_API void sl_work_free(sl_work *W) {
  if (W != NULL) {
    const sl_allocator a = W->allocator;
    sli_free(&a, W->block);
    sli_free(&a, W);
  }
}

SL_API size_t sl_work_bytes(const sl_work *W) {
  return W == NULL ? 0 : W->size;
}

/* src/impl/solve/query.h: the query, a compiled solve, and moving right-hand sides in and out of it */

typedef struct sli_query {
  const sl_symbolic *S;
  sli_hash analysis, extent;
  sl_int nb, nx;
  int is_shared;
  int b_repeats;
  sli_reach forward, backward;
  const sl_int *b_index;
  const sl_int *x_index;
  sli_boundary_use boundary;
  const sl_region *region;
} sli_query;

static sli_query sli_query_all(const sl_symbolic *S) {
  sli_query q;
  q.S = S;
  q.analysis = S->identity;
  q.nb = q.nx = S->n;
  q.is_shared = 1;
  q.b_repeats = 0;
  q.forward = q.backward = sli_reach_all(S);
  q.b_index = q.x_index = S->iperm;
  q.region = NULL;
  q.boundary.entries = 0;
  return q;
}

SLI_INLINE int sli_query_fits(const sli_query *q, const sl_factor *F) {
  return F->is_valid && sli_factor_is_over(F, q->S, q->analysis) &&
       (q->region == NULL || (sli_hash_equals(q->extent, q->region->identity) &&
                  sli_region_fits(q->region, F)));
}

SLI_INLINE int sli_lanes_kind(sl_int nrhs) {
  return nrhs <= 1   ? SLI_NRHS_1
       : nrhs == 2 ? SLI_NRHS_2
       : nrhs <= 4 ? SLI_NRHS_4
             : SLI_NRHS_8;
}

typedef struct sli_vectors {
  double *y, *x, *product, *scratch;
} sli_vectors;

static void sli_vectors_layout(sli_vectors *v, sli_block *b, const sli_query *q, sl_int nrhs) {
  const sl_int lanes = (sl_int)1 << sli_lanes_kind(nrhs);
  const size_t forward = sli_sweep_scratch(q->forward.tallest, q->forward.widest, lanes);
  const size_t backward = sli_sweep_scratch(q->backward.tallest, q->backward.widest, lanes);
  const size_t across = q->region == NULL ? 0 : sli_region_scratch(q->region, lanes);
  const size_t most = forward > backward ? forward : backward;
  v->y = SLI_TAKE(b, double, (uint64_t)q->forward.columns *(uint64_t)lanes);
  v->x =
    q->is_shared ? v->y : SLI_TAKE(b, double, (uint64_t)q->backward.columns *(uint64_t)lanes);
  v->product = SLI_TAKE(b, double, q->region == NULL ? 0 : sli_region_vectors(q->region, lanes));
  v->scratch = SLI_TAKE(b, double, most > across ? most : across);
}

static size_t sli_vectors_bytes(const sli_query *q, sl_int nrhs) {
  sli_block few = {NULL, 0, 0}, many = {NULL, 0, 0};
  sli_vectors v;
  sli_vectors_layout(&v, &few, q, sli_min(nrhs, 2));
  sli_vectors_layout(&v, &many, q, sli_min(nrhs, 8));
  return few.used > many.used ? few.used : many.used;
}

static sli_vectors sli_vectors_of(const sli_query *q, sl_int nrhs, void *memory) {
  sli_block b = {NULL, 0, 0};
  sli_vectors v;
  b.base = (unsigned char *)memory;
  sli_vectors_layout(&v, &b, q, nrhs);
  return v;
}

typedef enum sli_layout { SLI_COLUMN_MAJOR, SLI_INTERLEAVED } sli_layout;

typedef struct sli_dense {
  size_t row, column;
} sli_dense;

SLI_INLINE sli_dense sli_dense_of(sli_layout layout, size_t ld) {
  sli_dense at;
  at.row = layout == SLI_INTERLEAVED ? ld : 1;
  at.column = layout == SLI_INTERLEAVED ? 1 : ld;
  return at;
}

static sl_status sli_check_dense(const double *X, size_t ldx, sl_int nx, const double *B,
                 size_t ldb, sl_int nb, sli_layout layout, sl_int nrhs) {
  const int by_rows = layout == SLI_INTERLEAVED;
  const int bad_x = nx > 0 && (X == NULL || ldx < (size_t)(by_rows ? nrhs : nx));
  const int bad_b = nb > 0 && (B == NULL || ldb < (size_t)(by_rows ? nrhs : nb));
  const int is_misaligned = X == B && ldx != ldb && nx > 0 && nb > 0;
  return nrhs < 0 || (nrhs > 0 && (bad_x || bad_b || is_misaligned)) ? SL_ERR_ARGUMENT : SL_OK;
}

#define SLI_ROWS_AHEAD 32

SLI_ALWAYS_INLINE void sli_pack_rows(double *v, sl_int lanes, const sl_int *index, sl_int count,
                   const double *M, sli_dense at, sl_int columns) {
  sl_int k, r;
  for (k = 0; k < count; k++) {
    if (lanes >= 4) {
      SLI_PREFETCH(v + (ptrdiff_t)index[sli_min(k + SLI_ROWS_AHEAD, count - 1)] * lanes, 0);
    }
    SLI_UNROLL
    for (r = 0; r < columns; r++) {
      v[(ptrdiff_t)index[k] * lanes + r] = M[(size_t)k * at.row + (size_t)r * at.column];
    }
  }
}

static void sli_pack_sums(double *v, sl_int lanes, const sl_int *index, sl_int count,
              const double *M, sli_dense at, sl_int columns) {
  sl_int k, r;
  for (k = 0; k < count; k++) {
    for (r = 0; r < columns; r++) {
      v[(ptrdiff_t)index[k] * lanes + r] += M[(size_t)k * at.row + (size_t)r * at.column];
    }
  }
}

SLI_ALWAYS_INLINE void sli_unpack_rows(double *M, sli_dense at, const double *v, sl_int lanes,
                     const sl_int *index, sl_int count, sl_int columns) {
  sl_int k, r;
  for (k = 0; k < count; k++) {
    if (lanes >= 4) {
      SLI_PREFETCH(v + (ptrdiff_t)index[sli_min(k + SLI_ROWS_AHEAD, count - 1)] * lanes, 0);
    }
    SLI_UNROLL
    for (r = 0; r < columns; r++) {
      M[(size_t)k * at.row + (size_t)r * at.column] = v[(ptrdiff_t)index[k] * lanes + r];
    }
  }
}

static void sli_pack(const sli_query *q, double *y, const double *B, sli_dense at, sl_int lanes,
           sl_int nrhs) {
  const sl_int *index = q->b_index, count = q->nb;
  if (q->b_repeats || q->nb < q->forward.columns || nrhs < lanes) {
    memset(y, 0, (size_t)q->forward.columns * (size_t)lanes * sizeof(double));
  }
  if (q->b_repeats) {
    sli_pack_sums(y, lanes, index, count, B, at, nrhs);
  } else if (nrhs == 8 && at.row == 1) {
    sli_pack_rows(y, 8, index, count, B, sli_dense_of(SLI_COLUMN_MAJOR, at.column), 8);
  } else if (nrhs == 8) {
    sli_pack_rows(y, 8, index, count, B, sli_dense_of(SLI_INTERLEAVED, at.row), 8);
  } else if (nrhs == 3) {
    sli_pack_rows(y, 4, index, count, B, at, 3);
  } else if (nrhs == 1) {
    sli_pack_rows(y, 1, index, count, B, at, 1);
  } else {
    sli_pack_rows(y, lanes, index, count, B, at, nrhs);
  }
}

static void sli_unpack(const sli_query *q, double *X, sli_dense at, const double *x, sl_int lanes,
             sl_int nrhs) {
  const sl_int *index = q->x_index, count = q->nx;
  if (nrhs == 8 && at.row == 1) {
    sli_unpack_rows(X, sli_dense_of(SLI_COLUMN_MAJOR, at.column), x, 8, index, count, 8);
  } else if (nrhs == 8) {
    sli_unpack_rows(X, sli_dense_of(SLI_INTERLEAVED, at.row), x, 8, index, count, 8);
  } else if (nrhs == 3) {
    sli_unpack_rows(X, at, x, 4, index, count, 3);
  } else if (nrhs == 1) {
    sli_unpack_rows(X, at, x, 1, index, count, 1);
  } else {
    sli_unpack_rows(X, at, x, lanes, index, count, nrhs);
  }
}

/* src/impl/solve/singular.h: solves with null pivots: the consistency check, and centering */

SLI_ALWAYS_INLINE void sli_chains_norm(double *chains, const double *row, sl_int columns,
                     sl_int lanes) {
  const ptrdiff_t count = (ptrdiff_t)columns * lanes;
  ptrdiff_t f = 0;
  sl_int q;
  for (; f + SLI_TILE <= count; f += SLI_TILE) {
    SLI_UNROLL
    for (q = 0; q < SLI_TILE; q++) {
      chains[q] += fabs(row[f + q]);
    }
  }
  for (q = 0; f < count; q++) {
    chains[q] += fabs(row[f++]);
  }
}

SLI_ALWAYS_INLINE void sli_chains_dot(double *chains, const double *v, const double *row,
                    sl_int columns, sl_int lanes) {
  const ptrdiff_t count = (ptrdiff_t)columns * lanes;
  ptrdiff_t f = 0;
  sl_int q;
  for (; f + SLI_TILE <= count; f += SLI_TILE, v += SLI_TILE / lanes) {
    SLI_UNROLL
    for (q = 0; q < SLI_TILE; q++) {
      chains[q] += v[q / lanes] * row[f + q];
    }
  }
  for (q = 0; f < count; q++) {
    chains[q] += v[q / lanes] * row[f++];
  }
}

static void sli_chains_sum(const double *chains, sl_int lanes, double *sums) {
  sl_int q;
  for (q = 0; q < lanes; q++) {
    sums[q] = chains[q];
  }
  for (; q < SLI_TILE; q++) {
    sums[q % lanes] += chains[q];
  }
}

#define SLI_FOR_LANES(lanes, call) \
  if ((lanes) == 1) { \
    call(1); \
  } else if ((lanes) == 2) { \
    call(2); \
  } else if ((lanes) == 4) { \
    call(4); \
  } else { \
    call(8); \
  }

static void sli_norms(const sli_reach *R, const double *b, sl_int lanes, double *norms) {
  double chains[SLI_TILE];
  sl_int s;
  memset(chains, 0, sizeof chains);
  for (s = 0; s < R->count; s++) {
    const sl_int columns = sli_step_columns(&R->steps[s]);
    const double *row = b + (ptrdiff_t)R->steps[s].base * lanes;
#define SLI_CALL(constant) sli_chains_norm(chains, row, columns, constant)
    SLI_FOR_LANES(lanes, SLI_CALL)
#undef SLI_CALL
  }
  sli_chains_sum(chains, lanes, norms);
}

typedef struct sli_tree_range {
  sl_int first, root;
} sli_tree_range;

SLI_INLINE sli_tree_range sli_tree_range_of(const sl_symbolic *S, const sli_step *root) {
  const sl_int super = S->super_of[root->column];
  sli_tree_range tree;
  tree.first = S->super_first[S->first_descendant[super]];
  tree.root = S->super_first[super + 1] - 1;
  return tree;
}

typedef struct sli_null_dot {
  sl_int null;
  sl_int number;
  double sums[SLI_TILE];
} sli_null_dot;

SLI_INLINE sl_int sli_null_column(const sl_factor *F, sl_int k) {
  sl_int j = 0;
  while (j < F->null_vectors && F->g[(size_t)k + (size_t)j * (size_t)F->S->n] == 0.0) {
    j++;
  }
  return j < F->null_vectors ? j : -1;
}

static int sli_null_dot_next(const sl_factor *F, const sli_reach *R, sl_int first, sl_int root,
               const double *b, sl_int lanes, sl_int *m, sli_null_dot *dot) {
  const sl_int last = sli_tree_range_of(F->S, &R->steps[root]).root;
  double chains[SLI_TILE];
  const double *z;
  sl_int column = -1, r;
  for (; *m < F->n_nulls && F->nulls[*m] <= last && column == -1; ++*m) {
    dot->number = *m;
    dot->null = F->nulls[*m];
    column = sli_null_column(F, dot->null);
  }
  if (column == -1) {
    return 0;
  }
  z = F->g + (size_t)column * (size_t)F->S->n;
  memset(chains, 0, sizeof chains);
  for (; first <= root; first++) {
    const sli_step *step = &R->steps[first];
    const double *v = z + step->column, *row = b + (ptrdiff_t)step->base * lanes;
    const sl_int columns = sli_step_columns(step);
#define SLI_CALL(constant) sli_chains_dot(chains, v, row, columns, constant)
    SLI_FOR_LANES(lanes, SLI_CALL)
#undef SLI_CALL
  }
  sli_chains_sum(chains, lanes, dot->sums);
  for (r = 0; r < lanes; r++) {
    dot->sums[r] /= z[dot->null];
  }
  return 1;
}

SLI_INLINE sl_int sli_null_first(const sl_factor *F, const sli_reach *R, sl_int root) {
  return sli_lower_bound(F->nulls, F->n_nulls, sli_tree_range_of(F->S, &R->steps[root]).first);
}

static int sli_null_dots_are_small(const sl_factor *F, const sli_reach *R, const double *b,
                   sl_int lanes, const double *norms) {
  sl_int first = 0, s, m, r;
  for (s = 0; s < R->count; s++) {
    sli_null_dot dot;
    if (R->steps[s].up != -1) {
      continue;
    }
    m = sli_null_first(F, R, s);
    while (sli_null_dot_next(F, R, first, s, b, lanes, &m, &dot)) {
      for (r = 0; r < lanes; r++) {
        if (fabs(dot.sums[r]) > F->consistency * norms[r]) {
          return 0;
        }
      }
    }
    first = s + 1;
  }
  return 1;
}

static void sli_anchors_clear(const sl_factor *F, const sli_reach *R, double *y, sl_int lanes) {
  sl_int s, m;
  for (s = 0; s < R->count; s++) {
    if (R->steps[s].up == -1) {
      const sl_int last = sli_tree_range_of(F->S, &R->steps[s]).root;
      for (m = sli_null_first(F, R, s); m < F->n_nulls && F->nulls[m] <= last; m++) {
        const sl_int at = sli_reach_index_of(R, F->nulls[m]);
        if (at != -1 && F->rule.kinds[F->nulls[m]] == SLI_PIVOT_NULL) {
          memset(y + (ptrdiff_t)at * lanes, 0, (size_t)lanes * sizeof(double));
        }
      }
    }
  }
}

static int sli_is_consistent(const sl_factor *F, const sli_reach *R, const double *y, sl_int lanes,
               const double *norms) {
  sl_int s, m, r;
  for (s = 0; s < R->count; s++) {
    sli_tree_range tree;
    if (R->steps[s].up != -1) {
      continue;
    }
    tree = sli_tree_range_of(F->S, &R->steps[s]);
    for (m = sli_lower_bound(F->nulls, F->n_nulls, tree.first);
       m < F->n_nulls && F->nulls[m] <= tree.root; m++) {
      const int is_judged = F->null_vectors > 1 && sli_null_column(F, F->nulls[m]) != -1;
      const sl_int at = is_judged ? -1 : sli_reach_index_of(R, F->nulls[m]);
      for (r = 0; at != -1 && r < lanes; r++) {
        if (fabs(y[(ptrdiff_t)at * lanes + r]) > F->consistency * norms[r]) {
          return 0;
        }
      }
    }
  }
  return 1;
}

typedef struct sli_center_terms {
  double c[SLI_TILE], t[SLI_TILE];
} sli_center_terms;

static sl_int sli_center_tree_terms(const sl_factor *F, const sli_reach *R, sl_int s,
                  const double *y, sl_int lanes, sl_int *m, sli_tree_range *tree,
                  sli_center_terms *terms) {
  double chains[SLI_TILE], sums[SLI_TILE];
  sl_int r, at, up = s;
  memset(terms, 0, sizeof *terms);
  memset(chains, 0, sizeof chains);
  while (up != -1) {
    const sli_step *step = &R->steps[s++];
    const double *v = F->center + step->column, *row = y + (ptrdiff_t)step->base * lanes;
    const sl_int columns = sli_step_columns(step);
#define SLI_CALL(constant) sli_chains_dot(chains, v, row, columns, constant)
    SLI_FOR_LANES(lanes, SLI_CALL)
#undef SLI_CALL
    up = step->up;
  }
  *tree = sli_tree_range_of(F->S, &R->steps[s - 1]);
  *m = sli_lower_bound(F->anchors, F->n_anchors, tree->first);
  if (*m == F->n_anchors || F->anchors[*m] > tree->root) {
    *m = -1;
    return s;
  }
  at = sli_reach_index_of(R, F->anchors[*m]);
  if (at != -1) {
    memcpy(terms->c, y + (ptrdiff_t)at * lanes, (size_t)lanes * sizeof(double));
  }
  sli_chains_sum(chains, lanes, sums);
  for (r = 0; r < lanes; r++) {
    terms->c[r] *= F->ratios[*m];
    terms->t[r] = terms->c[r] * F->squares[*m] - sums[r];
  }
  return s;
}

SLI_ALWAYS_INLINE void sli_center_columns(double *row, const double *v, const double *D,
                      sl_int columns, const double *c, sl_int lanes) {
  sl_int k, r;
  for (k = 0; k < columns; k++, row += lanes) {
    const double w = v[k] * D[k];
    SLI_UNROLL
    for (r = 0; r < lanes; r++) {
      row[r] -= c[r] * w;
    }
  }
}

static void sli_center(const sl_factor *F, const sli_reach *from, const double *y,
             const sli_reach *to, double *x, sl_int lanes) {
  sl_int s = 0, at = 0, m;
  while (s < from->count && at < to->count) {
    sli_center_terms terms;
    sli_tree_range tree;
    sl_int index;
    s = sli_center_tree_terms(F, from, s, y, lanes, &m, &tree, &terms);
    for (; at < to->count && to->steps[at].column <= tree.root; at++) {
      const sli_step *step = &to->steps[at];
      const double *v = F->center + step->column, *D = F->D + step->column;
      double *row = x + (ptrdiff_t)step->base * lanes;
      const sl_int columns = sli_step_columns(step);
      if (m != -1 && step->column >= tree.first) {
#define SLI_CALL(constant) sli_center_columns(row, v, D, columns, terms.c, constant)
        SLI_FOR_LANES(lanes, SLI_CALL)
#undef SLI_CALL
      }
    }
    index = m != -1 ? sli_reach_index_of(to, F->anchors[m]) : -1;
    if (index != -1) {
      memcpy(x + (ptrdiff_t)index * lanes, terms.t, (size_t)lanes * sizeof(double));
    }
  }
}

#undef SLI_FOR_LANES

/* src/impl/solve/backward.h: the backward sweep of one block: 2x2 pivots first, then the kernel */

static void sli_pairs_apply(const sl_factor *F, const sli_reach *R, double *x, sl_int lanes) {
  sl_int s, k, r;
  for (s = 0; s < R->count; s++) {
    const sli_step *step = &R->steps[s];
    const sl_int first = step->column, columns = sli_step_columns(step);
    double *row = x + (ptrdiff_t)step->base * lanes;
    for (k = first; k < first + columns; k++, row += lanes) {
      sli_pair_steps steps;
      if (F->S->pairs[k] != SLI_PAIR_FIRST) {
        continue;
      }
      steps = sli_pair_eliminate(F->D[k], F->D[k + 1], F->E[k]);
      for (r = 0; r < lanes; r++) {
        sli_pair_solve(&steps, row[r], row[lanes + r], &row[r], &row[lanes + r]);
      }
    }
  }
}

static void sli_backward(const sl_factor *F, const sli_reach *R, int kind, double *x,
             double *scratch) {
  if (F->E != NULL) {
    sli_pairs_apply(F, R, x, (sl_int)1 << kind);
  }
  sli_backward_sweep(F, kind, R->count, R->steps, R->rows + R->n_rows,
             F->is_centered || F->E != NULL ? F->divisors : F->D, x, scratch);
}

/* src/impl/solve/sweep.h: full solves, and the sweeps of any query, in blocks of 8 right-hand sides */

static void sli_sweep_transfer(const sli_query *q, const double *y, double *x, sl_int lanes) {
  sli_intersection m = sli_intersection_of(&q->forward, &q->backward);
  memset(x, 0, (size_t)q->backward.columns * (size_t)lanes * sizeof(double));
  while (sli_intersection_next(&m)) {
    memcpy(x + (ptrdiff_t)m.in_b * lanes, y + (ptrdiff_t)m.in_a * lanes,
         (size_t)m.count * (size_t)lanes * sizeof(double));
  }
}

static void sli_sweep_region(const sl_factor *F, const sli_query *q, int kind,
               const sli_vectors *v) {
  const ptrdiff_t n = q->region->extent.n_rows;
  sli_region_apply(q->region, &q->boundary, F->kernels, kind,
           v->y + ((q->forward.columns - n) << kind),
           v->x + ((q->backward.columns - n) << kind), v->product, v->scratch);
}

static void sli_sweep_forward(const sl_factor *F, const sli_query *q, const sli_vectors *v,
                sl_int nrhs) {
  const int kind = sli_lanes_kind(nrhs);
  const sli_reach *R = &q->forward;
  const sl_int *rows = R->rows;
  sl_int first = 0, s;
  if (F->n_nulls == 0 || F->null_vectors > 1) {
    sli_forward_sweep(F, kind, R->count, R->steps, rows, v->y, v->scratch);
    return;
  }
  for (s = 0; s < R->count; s++) {
    sli_null_dot dot;
    sl_int m, at = -1;
    if (R->steps[s].up != -1) {
      continue;
    }
    m = sli_null_first(F, R, s);
    if (sli_null_dot_next(F, R, first, s, v->y, (sl_int)1 << kind, &m, &dot)) {
      at = sli_reach_index_of(R, dot.null);
    }
    sli_forward_sweep(F, kind, s + 1 - first, R->steps + first, rows, v->y, v->scratch);
    if (at != -1) {
      memcpy(v->y + ((ptrdiff_t)at << kind), dot.sums, sizeof(double) << kind);
    }
    for (; first <= s; first++) {
      rows += R->steps[first].below;
    }
  }
}

static int sli_sweep_load(const sl_factor *F, const sli_query *q, const sli_vectors *v,
              const double *B, sli_dense at, sl_int nrhs) {
  const sl_int lanes = (sl_int)1 << sli_lanes_kind(nrhs);
  double norms[SLI_TILE];
  sli_pack(q, v->y, B, at, lanes, nrhs);
  if (F->checks) {
    sli_norms(&q->forward, v->y, lanes, norms);
    if (F->null_vectors > 1 && (q->region == NULL || q->region->extent.n_rows == 0) &&
      !sli_null_dots_are_small(F, &q->forward, v->y, lanes, norms)) {
      return 0;
    }
  }
  sli_sweep_forward(F, q, v, nrhs);
  return !F->checks || sli_is_consistent(F, &q->forward, v->y, lanes, norms);
}

static void sli_sweep_backward(const sl_factor *F, const sli_query *q, const sli_vectors *v,
                 sl_int nrhs) {
  const int kind = sli_lanes_kind(nrhs);
  const sl_int lanes = (sl_int)1 << kind;
  if (F->null_vectors > 1) {
    sli_anchors_clear(F, &q->forward, v->y, lanes);
  }
  if (!q->is_shared) {
    sli_sweep_transfer(q, v->y, v->x, lanes);
  }
  if (q->region != NULL) {
    sli_sweep_region(F, q, kind, v);
  }
  if (F->is_centered) {
    sli_center(F, &q->forward, v->y, &q->backward, v->x, lanes);
  }
  sli_backward(F, &q->backward, kind, v->x, v->scratch);
}

static sl_status sli_sweep_check(const sl_factor *F, const sli_query *q, const double *B,
                 sli_dense b_at, sl_int nrhs, void *memory) {
  sl_int r;
  for (r = 0; r < nrhs; r += 8) {
    const sl_int block = sli_min(8, nrhs - r);
    const sli_vectors v = sli_vectors_of(q, block, memory);
    if (!sli_sweep_load(F, q, &v, B + (size_t)r * b_at.column, b_at, block)) {
      return SL_ERR_INCONSISTENT;
    }
  }
  return SL_OK;
}

static sl_status sli_sweep_blocks(const sl_factor *F, const sli_query *q, double *X, sli_dense x_at,
                  const double *B, sli_dense b_at, sl_int nrhs, void *memory) {
  sl_int r;
  for (r = 0; r < nrhs; r += 8) {
    const sl_int block = sli_min(8, nrhs - r);
    const sli_vectors v = sli_vectors_of(q, block, memory);
    if (!sli_sweep_load(F, q, &v, B + (size_t)r * b_at.column, b_at, block)) {
      return SL_ERR_INCONSISTENT;
    }
    sli_sweep_backward(F, q, &v, block);
    sli_unpack(q, X + (size_t)r * x_at.column, x_at, v.x, (sl_int)1 << sli_lanes_kind(block),
           block);
  }
  return SL_OK;
}

static sl_status sli_sweep(const sl_factor *F, const sli_query *q, double *X, sli_dense x_at,
               const double *B, sli_dense b_at, sl_int nrhs, void *memory) {
  sl_status status = SL_OK;
  if (F->checks && nrhs > 8 && q->nb > 0) {
    status = sli_sweep_check(F, q, B + 8 * b_at.column, b_at, nrhs - 8, memory);
  }
  return status == SL_OK ? sli_sweep_blocks(F, q, X, x_at, B, b_at, nrhs, memory) : status;
}

static sl_status sli_query_solve(const sl_factor *F, const sli_query *q, double *X, sli_dense x_at,
                 const double *B, sli_dense b_at, sl_int nrhs, sl_work *W) {
  sl_work own;
  sl_status status;
  if (nrhs == 0 || q->nx == 0) {
    return SL_OK;
  }
  own = sli_work_own(&F->allocator);
  W = W == NULL ? &own : W;
  status = sli_work_grow(W, sli_vectors_bytes(q, nrhs));
  if (status == SL_OK) {
    status = sli_sweep(F, q, X, x_at, B, b_at, nrhs, W->block);
  }
  sli_free(&own.allocator, own.block);
  return status;
}

static sl_status sli_solve(const sl_factor *F, const sli_query *q, double *X, size_t ldx,
               const double *B, size_t ldb, sli_layout layout, sl_int nrhs,
               sl_work *W) {
  const sl_status status = sli_check_dense(X, ldx, q->nx, B, ldb, q->nb, layout, nrhs);
  if (status != SL_OK) {
    return status;
  }
  if (!sli_query_fits(q, F)) {
    return SL_ERR_STATE;
  }
  return sli_query_solve(F, q, X, sli_dense_of(layout, ldx), B, sli_dense_of(layout, ldb), nrhs,
               W);
}

SL_API sl_status sl_factor_solve(const sl_factor *F, double *X, size_t ldx, const double *B,
                 size_t ldb, sl_int nrhs, sl_work *W) {
  sli_query q;
  if (F == NULL) {
    return SL_ERR_ARGUMENT;
  }
  q = sli_query_all(F->S);
  return sli_solve(F, &q, X, ldx, B, ldb, SLI_COLUMN_MAJOR, nrhs, W);
}

SL_API sl_status sl_factor_solve_interleaved(const sl_factor *F, double *X, size_t ldx,
                       const double *B, size_t ldb, sl_int nrhs, sl_work *W) {
  sli_query q;
  if (F == NULL) {
    return SL_ERR_ARGUMENT;
  }
  q = sli_query_all(F->S);
  return sli_solve(F, &q, X, ldx, B, ldb, SLI_INTERLEAVED, nrhs, W);
}

static sl_status sli_work_reserve(sl_work *W, const sli_query *q, sl_int nrhs) {
  return sli_work_grow(W, nrhs > 0 && q->nx > 0 ? sli_vectors_bytes(q, nrhs) : 0);
}

SL_API sl_status sl_work_reserve_factor(sl_work *W, const sl_factor *F, sl_int nrhs) {
  sli_query q;
  if (W == NULL || F == NULL || nrhs < 0) {
    return SL_ERR_ARGUMENT;
  }
  q = sli_query_all(F->S);
  return sli_work_reserve(W, &q, nrhs);
}

/* src/impl/solve/compile.h: compiles a b-set and an x-set into a query: sorting, reaches, row indices */

typedef struct sli_set {
  const sl_int *rows;
  sl_int count;
  int repeats;
  sl_int inside;
  const sli_region_extent *extent;
  uint64_t *seeds;
  uint64_t *scratch;
  sl_int *index;
  sli_step *steps;
  sl_int *row_index;
  unsigned char *boundary;
} sli_set;

static sli_set sli_set_of(const sl_symbolic *S, const sl_int *rows, sl_int count) {
  sli_set set;
  memset(&set, 0, sizeof set);
  set.rows = rows;
  set.count = rows == NULL ? S->n : count;
  return set;
}

static void sli_set_layout_seeds(sli_set *set, sli_block *b) {
  const size_t count = set->rows == NULL ? 0 : (size_t)set->count;
  set->seeds = SLI_TAKE(b, uint64_t, count);
  set->scratch = SLI_TAKE(b, uint64_t, count);
}

static void sli_set_layout_reach(sli_set *set, sli_block *b, const sli_reach *R) {
  if (set->rows != NULL) {
    set->index = SLI_TAKE(b, sl_int, set->count);
    set->steps = SLI_TAKE(b, sli_step, R->count);
    set->row_index = SLI_TAKE(b, sl_int, R->n_rows);
    set->boundary = SLI_TAKE(b, unsigned char,
                 set->extent == NULL ? 0 : sli_region_chunks(set->extent->n_rows));
  }
}

static sl_status sli_set_sort(const sl_symbolic *S, sli_set *set, sl_stats *stats) {
  sl_int k;
  set->inside = set->count;
  set->extent = NULL;
  set->repeats = 0;
  if (set->rows == NULL) {
    return SL_OK;
  }
  for (k = 0; k < set->count; k++) {
    const sl_int i = set->rows[k];
    if (i < 0 || i >= S->n) {
      return sli_fail_at(stats, SL_ERR_ARGUMENT, i, -1, 0.0);
    }
    set->seeds[k] = sli_keyed(S->iperm[i], k);
  }
  sli_sort(set->seeds, set->count, set->scratch);
  for (k = 1; k < set->count; k++) {
    set->repeats |= sli_key(set->seeds[k - 1]) == sli_key(set->seeds[k]);
  }
  return SL_OK;
}

static int sli_set_is_within(const sl_symbolic *S, const sli_set *set,
               const sli_region_extent *extent) {
  sl_int k;
  for (k = 0; set->rows != NULL && k < set->count; k++) {
    const sl_int column = sli_key(set->seeds[k]);
    if (sli_extent_find(S, extent, S->super_of[column]) == -1 &&
      sli_extent_boundary(extent, column) == -1) {
      return 0;
    }
  }
  return set->rows != NULL;
}

static void sli_set_partition(const sl_symbolic *S, sli_set *set, const sli_region_extent *extent) {
  sl_int k, inside = 0, rest = 0;
  for (k = 0; k < set->count; k++) {
    if (sli_extent_find(S, extent, S->super_of[sli_key(set->seeds[k])]) != -1) {
      set->seeds[inside++] = set->seeds[k];
    } else {
      set->scratch[rest++] = set->seeds[k];
    }
  }
  for (k = 0; k < rest; k++) {
    set->seeds[inside + k] = set->scratch[k];
  }
  set->inside = inside;
  set->extent = extent;
}

static void sli_set_measure(const sl_symbolic *S, const sli_set *set, sli_reach *R) {
  if (set->rows == NULL) {
    *R = sli_reach_all(S);
  } else {
    sli_reach_measure_within(S, set->extent, set->seeds, set->inside, R);
  }
}

static void sli_set_mark(sli_set *set, const sli_reach *R) {
  const sl_int n = set->extent->n_rows, base = R->columns - n;
  const sl_int *rows = R->rows;
  sl_int k, i;
  memset(set->boundary, 0, (size_t)sli_region_chunks(n));
  for (k = set->inside; k < set->count; k++) {
    set->boundary[(set->index[sli_value(set->seeds[k])] - base) / SLI_REGION_COLUMNS] = 1;
  }
  for (k = 0; k < R->count; k++) {
    for (i = 0; R->steps[k].up == -1 && i < R->steps[k].below; i++) {
      set->boundary[(rows[i] - base) / SLI_REGION_COLUMNS] = 1;
    }
    rows += R->steps[k].below;
  }
}

static sl_off sli_boundary_entries(const sl_region *R, const sli_set *b, const sli_set *x) {
  sl_off sum = 0;
  sl_int k;
  for (k = 0; k < sli_region_chunks(R->extent.n_rows); k++) {
    sum += b->boundary[k] || x->boundary[k] ? R->begin[k + 1] - R->begin[k] : 0;
  }
  return sum;
}

static void sli_set_fill(const sl_symbolic *S, sli_set *set, sli_reach *R, const sl_int **index) {
  sl_int k, at = 0;
  if (set->rows == NULL) {
    *index = S->iperm;
    return;
  }
  sli_reach_fill_within(S, set->extent, set->seeds, set->inside, set->steps, set->row_index, R);
  for (k = 0; k < set->inside; k++) {
    set->index[sli_value(set->seeds[k])] = sli_reach_index(R, &at, sli_key(set->seeds[k]));
  }
  for (; k < set->count; k++) {
    set->index[sli_value(set->seeds[k])] =
      R->columns - set->extent->n_rows +
      sli_extent_boundary(set->extent, sli_key(set->seeds[k]));
  }
  if (set->extent != NULL) {
    sli_set_mark(set, R);
  }
  *index = set->index;
}

static int sli_reach_equal(const sli_reach *a, const sli_reach *b) {
  sl_int k;
  if (a->count != b->count || a->columns != b->columns) {
    return 0;
  }
  for (k = 0; k < a->count && a->steps != b->steps; k++) {
    if (a->steps[k].column != b->steps[k].column) {
      return 0;
    }
  }
  return 1;
}

static void sli_query_fill(sli_query *q, const sl_symbolic *S, const sl_region *region, sli_set *b,
               sli_set *x) {
  q->S = S;
  q->analysis = S->identity;
  q->extent = region == NULL ? S->identity : region->identity;
  q->region = region;
  q->nb = b->count;
  q->nx = x->count;
  q->b_repeats = b->repeats;
  sli_set_fill(S, b, &q->forward, &q->b_index);
  sli_set_fill(S, x, &q->backward, &q->x_index);
  q->is_shared = sli_reach_equal(&q->forward, &q->backward);
  q->boundary.b = b->boundary;
  q->boundary.x = x->boundary;
  q->boundary.entries = region == NULL ? 0 : sli_boundary_entries(region, b, x);
}

static void sli_query_stats(const sli_query *q, sl_stats *stats) {
  const sl_int boundary = q->region == NULL ? 0 : q->region->extent.n_rows;
  stats->plan.b_supernodes = q->forward.count;
  stats->plan.b_columns = q->forward.columns - boundary;
  stats->plan.b_entries = q->forward.entries;
  stats->plan.x_supernodes = q->backward.count;
  stats->plan.x_columns = q->backward.columns - boundary;
  stats->plan.x_entries = q->backward.entries;
  stats->plan.in_region = q->region != NULL;
  stats->plan.region_entries = q->boundary.entries;
}

static sl_status sli_check_sets(const sl_symbolic *S, const sl_int *bset, sl_int nb,
                const sl_int *xset, sl_int nx) {
  return S == NULL || (bset != NULL && nb < 0) || (xset != NULL && nx < 0) ? SL_ERR_ARGUMENT
                                       : SL_OK;
}

/* src/impl/solve/plan.h: plan objects: queries compiled once and kept, and solves on them */

struct sl_plan {
  sl_allocator allocator;
  size_t bytes;
  sli_query query;
};

SL_API sl_status sl_plan_create(sl_plan **out, const sl_symbolic *S, const sl_int *bset, sl_int nb,
                const sl_int *xset, sl_int nx, const sl_options *opt,
                sl_stats *stats) {
  const sl_allocator a = sli_allocator(opt);
  sli_block seeds = {NULL, 0, 0}, kept = {NULL, 0, 0};
  sl_plan *P = NULL;
  sli_query query;
  const sl_region *region = opt == NULL ? NULL : opt->region;
  sli_set b, x;
  sl_status status;
  int pass;
  sli_stats_clear_error(stats);
  if (out == NULL) {
    return SL_ERR_ARGUMENT;
  }
  *out = NULL;
  status = sli_options_are_valid(opt, SLI_READS_REGION) ? sli_check_sets(S, bset, nb, xset, nx)
                              : SL_ERR_ARGUMENT;
  if (status == SL_OK && region != NULL &&
    (region->S != S || !sli_hash_equals(region->analysis, S->identity))) {
    status = SL_ERR_STATE;
  }
  if (status != SL_OK) {
    return status;
  }
  memset(&query, 0, sizeof query);
  b = sli_set_of(S, bset, nb);
  x = sli_set_of(S, xset, nx);
  for (pass = 0; pass < 2 && status == SL_OK; pass++) {
    sli_set_layout_seeds(&b, &seeds);
    sli_set_layout_seeds(&x, &seeds);
    status = pass == 0 ? sli_block_alloc(&seeds, &a) : SL_OK;
  }
  status = status == SL_OK ? sli_set_sort(S, &b, stats) : status;
  status = status == SL_OK ? sli_set_sort(S, &x, stats) : status;
  if (status == SL_OK && region != NULL && sli_set_is_within(S, &b, &region->extent) &&
    sli_set_is_within(S, &x, &region->extent)) {
    sli_set_partition(S, &b, &region->extent);
    sli_set_partition(S, &x, &region->extent);
  } else {
    region = NULL;
  }
  if (status == SL_OK) {
    sli_set_measure(S, &b, &query.forward);
    sli_set_measure(S, &x, &query.backward);
  }
  for (pass = 0; pass < 2 && status == SL_OK; pass++) {
    P = (sl_plan *)sli_take(&kept, 1, sizeof(sl_plan));
    sli_set_layout_reach(&b, &kept, &query.forward);
    sli_set_layout_reach(&x, &kept, &query.backward);
    status = pass == 0 ? sli_block_alloc(&kept, &a) : SL_OK;
  }
  if (status == SL_OK) {
    sli_query_fill(&query, S, region, &b, &x);
    P->allocator = a;
    P->bytes = kept.used;
    P->query = query;
    *out = P;
    sl_plan_stats(P, stats);
  }
  sli_free(&a, seeds.base);
  return status;
}

SL_API void sl_plan_free(sl_plan *P) {
  if (P != NULL) {
    const sl_allocator a = P->allocator;
    sli_free(&a, P);
  }
}

SL_API void sl_plan_stats(const sl_plan *P, sl_stats *stats) {
  sli_stats_clear_error(stats);
  if (P != NULL && stats != NULL) {
    sli_query_stats(&P->query, stats);
    stats->plan.bytes = P->bytes;
  }
}

SL_API sl_status sl_plan_solve(const sl_plan *P, const sl_factor *F, double *X, size_t ldx,
                 const double *B, size_t ldb, sl_int nrhs, sl_work *W) {
  return P == NULL || F == NULL
         ? SL_ERR_ARGUMENT
         : sli_solve(F, &P->query, X, ldx, B, ldb, SLI_COLUMN_MAJOR, nrhs, W);
}

SL_API sl_status sl_plan_solve_interleaved(const sl_plan *P, const sl_factor *F, double *X,
                       size_t ldx, const double *B, size_t ldb, sl_int nrhs,
                       sl_work *W) {
  return P == NULL || F == NULL
         ? SL_ERR_ARGUMENT
         : sli_solve(F, &P->query, X, ldx, B, ldb, SLI_INTERLEAVED, nrhs, W);
}

SL_API sl_status sl_work_reserve_plan(sl_work *W, const sl_plan *P, sl_int nrhs) {
  return W == NULL || P == NULL || nrhs < 0 ? SL_ERR_ARGUMENT
                        : sli_work_reserve(W, &P->query, nrhs);
}

/* src/impl/solve/local.h: sl_local_solve: one local solve without a plan, compiled in the workspace */

typedef struct sli_local {
  const sl_symbolic *S;
  sli_set b, x;
  sli_query query;
  sl_int nrhs;
  sl_stats *stats;
  sl_status status;
  unsigned char *memory;
} sli_local;

static void sli_local_layout_seeds(void *data, sli_block *b) {
  sli_local *l = (sli_local *)data;
  sli_set_layout_seeds(&l->b, b);
  sli_set_layout_seeds(&l->x, b);
}

static void sli_local_sort(void *data) {
  sli_local *l = (sli_local *)data;
  memset(&l->query, 0, sizeof l->query);
  l->status = sli_set_sort(l->S, &l->b, l->stats);
  if (l->status == SL_OK) {
    l->status = sli_set_sort(l->S, &l->x, l->stats);
  }
  if (l->status == SL_OK) {
    sli_set_measure(l->S, &l->b, &l->query.forward);
    sli_set_measure(l->S, &l->x, &l->query.backward);
  }
}

static void sli_local_layout_reaches(void *data, sli_block *b) {
  sli_local *l = (sli_local *)data;
  sli_set_layout_reach(&l->b, b, &l->query.forward);
  sli_set_layout_reach(&l->x, b, &l->query.backward);
}

static void sli_local_compile(void *data) {
  sli_local *l = (sli_local *)data;
  if (l->status == SL_OK) {
    sli_query_fill(&l->query, l->S, NULL, &l->b, &l->x);
  }
}

static void sli_local_layout_vectors(void *data, sli_block *b) {
  sli_local *l = (sli_local *)data;
  const size_t bytes =
    l->status == SL_OK && l->nrhs > 0 ? sli_vectors_bytes(&l->query, l->nrhs) : 0;
  l->memory = (unsigned char *)sli_take(b, bytes, 1);
}

static const sli_stage sli_local_stages[3] = {{sli_local_layout_seeds, sli_local_sort},
                        {sli_local_layout_reaches, sli_local_compile},
                        {sli_local_layout_vectors, NULL}};

SL_API sl_status sl_local_solve(const sl_factor *F, const sl_int *bset, sl_int nb,
                const sl_int *xset, sl_int nx, double *X, size_t ldx,
                const double *B, size_t ldb, sl_int nrhs, sl_work *W,
                sl_stats *stats) {
  sl_work own;
  sli_local l;
  sl_status status;
  sli_stats_clear_error(stats);
  if (F == NULL) {
    return SL_ERR_ARGUMENT;
  }
  status = sli_check_sets(F->S, bset, nb, xset, nx);
  if (status != SL_OK) {
    return status;
  }
  memset(&l, 0, sizeof l);
  l.S = F->S;
  l.b = sli_set_of(F->S, bset, nb);
  l.x = sli_set_of(F->S, xset, nx);
  l.nrhs = nrhs;
  l.stats = stats;
  status = sli_check_dense(X, ldx, l.x.count, B, ldb, l.b.count, SLI_COLUMN_MAJOR, nrhs);
  if (status != SL_OK) {
    return status;
  }
  if (!F->is_valid) {
    return SL_ERR_STATE;
  }
  own = sli_work_own(&F->allocator);
  W = W == NULL ? &own : W;
  status = sli_work_grow(W, 1);
  status = status == SL_OK ? sli_work_stages(W, sli_local_stages, 3, &l) : status;
  status = status == SL_OK ? l.status : status;
  if (status == SL_OK && stats != NULL) {
    sli_query_stats(&l.query, stats);
    stats->plan.bytes = 0;
  }
  if (status == SL_OK && nrhs > 0 && l.query.nx > 0) {
    status = sli_sweep(F, &l.query, X, sli_dense_of(SLI_COLUMN_MAJOR, ldx), B,
               sli_dense_of(SLI_COLUMN_MAJOR, ldb), nrhs, l.memory);
  }
  sli_free(&own.allocator, own.block);
  return status;
}

static sl_off sli_times_at_most(sl_off most, sl_int count, sl_off all) {
  return count > 0 && most > all / count ? all : most * count;
}

static sli_reach sli_reach_bound(const sl_symbolic *S, sl_int count) {
  sli_reach R = sli_reach_all(S);
  sl_off supers = 0, columns = 0, rows = 0, most_supers = 0, most_columns = 0, most_rows = 0;
  sl_int s, at = -1;
  for (s = S->n_supers - 1; s >= 0; s--) {
    for (; at != S->super_parent[s]; at = S->super_parent[at]) {
      supers--;
      columns -= S->steps[at].width;
      rows -= S->steps[at].below;
    }
    at = s;
    supers++;
    columns += S->steps[s].width;
    rows += S->steps[s].below;
    most_supers = supers > most_supers ? supers : most_supers;
    most_columns = columns > most_columns ? columns : most_columns;
    most_rows = rows > most_rows ? rows : most_rows;
  }
  R.count = (sl_int)sli_times_at_most(most_supers, count, R.count);
  R.columns = (sl_int)sli_times_at_most(most_columns, count, R.columns);
  R.n_rows = sli_times_at_most(most_rows, count, R.n_rows);
  return R;
}

SL_API sl_status sl_work_reserve_local(sl_work *W, const sl_symbolic *S, sl_int nb, sl_int nx,
                     sl_int nrhs) {
  static const sl_int some_rows = 0;
  sli_block b = {NULL, 0, 0};
  sli_local l;
  if (W == NULL || S == NULL || nb < 0 || nx < 0 || nrhs < 0) {
    return SL_ERR_ARGUMENT;
  }
  memset(&l, 0, sizeof l);
  l.S = S;
  l.b = sli_set_of(S, &some_rows, nb);
  l.x = sli_set_of(S, &some_rows, nx);
  l.nrhs = nrhs;
  l.query.forward = sli_reach_bound(S, nb);
  l.query.backward = sli_reach_bound(S, nx);
  sli_local_layout_seeds(&l, &b);
  sli_local_layout_reaches(&l, &b);
  sli_local_layout_vectors(&l, &b);
  b.used = b.used > 0 ? b.used : 1;
  return sli_work_block(W, &b);
}

/* src/impl/solve/parts.h: half solves: the factors of P A P' = L D L' applied one by one, full and local */

typedef struct sli_parts {
  const sl_factor *F;
  unsigned parts;
  int is_product;
  sli_query q;
  unsigned char *memory;
  sli_step *steps;
  double *ones;
  sl_int *identity;
} sli_parts;

static sli_query sli_parts_query(const sli_query *from, const sli_reach *R, int takes_bset,
                 int gives_xset) {
  sli_query q = *from;
  q.forward = q.backward = *R;
  q.is_shared = 1;
  q.b_repeats = takes_bset && from->b_repeats;
  q.nb = takes_bset ? from->nb : R->columns;
  q.nx = gives_xset ? from->nx : R->columns;
  q.b_index = takes_bset ? from->b_index : NULL;
  q.x_index = gives_xset ? from->x_index : NULL;
  return q;
}

static void sli_parts_layout(sli_parts *p, sli_block *b, sl_int nrhs) {
  p->memory = SLI_TAKE(b, unsigned char, sli_vectors_bytes(&p->q, nrhs));
  p->steps = SLI_TAKE(b, sli_step, p->q.backward.count);
  p->ones = SLI_TAKE(b, double, p->q.backward.widest);
  p->identity = SLI_TAKE(b, sl_int, p->q.forward.columns);
}

static void sli_parts_fill(sli_parts *p) {
  const sli_reach *R = &p->q.backward;
  sl_int k;
  for (k = 0; k < R->count; k++) {
    p->steps[k] = R->steps[k];
    p->steps[k].column = SLI_TILE * R->steps[k].first_tile;
  }
  for (k = 0; k < R->widest; k++) {
    p->ones[k] = 1.0;
  }
  for (k = 0; k < R->columns; k++) {
    p->identity[k] = k;
  }
  p->q.b_index = p->q.b_index == NULL ? p->identity : p->q.b_index;
  p->q.x_index = p->q.x_index == NULL ? p->identity : p->q.x_index;
}

static double sli_parts_pivot(const sli_parts *p, sl_int k) {
  return p->parts & SL_PART_SQRT_D ? sqrt(p->F->D[k]) : p->F->D[k];
}

static void sli_parts_scale_step(const sli_parts *p, const sli_step *step, double *row,
                 sl_int lanes) {
  const sl_factor *F = p->F;
  sl_int k, r;
  for (k = step->column; k < step->column + sli_step_columns(step); k++, row += lanes) {
    const int pair = F->E == NULL ? (int)SLI_PAIR_NONE : F->S->pairs[k];
    const double d = pair == SLI_PAIR_NONE ? sli_parts_pivot(p, k) : 1.0;
    const int is_null = sli_is_skipped(F, k);
    for (r = 0; r < lanes; r++) {
      if (is_null) {
        row[r] = 0.0;
      } else if (!p->is_product) {
        row[r] /= d;
      } else if (pair == SLI_PAIR_FIRST) {
        const double u = row[r], v = row[lanes + r];
        row[r] = F->D[k] * u + F->E[k] * v;
        row[lanes + r] = F->E[k] * u + F->D[k + 1] * v;
      } else {
        row[r] *= d;
      }
    }
  }
}

static void sli_parts_scale(const sli_parts *p, double *x, sl_int lanes) {
  const sli_reach *R = &p->q.backward;
  sl_int s;
  if (!p->is_product && p->F->E != NULL) {
    sli_pairs_apply(p->F, R, x, lanes);
  }
  for (s = 0; s < R->count; s++) {
    sli_parts_scale_step(p, &R->steps[s], x + (ptrdiff_t)R->steps[s].base * lanes, lanes);
  }
}

static void sli_column_multiply(const sl_factor *F, const sli_step *step, const sl_int *rows,
                sl_int j, int is_transposed, double *x, sl_int lanes) {
  double *xj = x + (ptrdiff_t)(step->base + j) * lanes;
  sl_int i, r;
  for (i = j + 1; i < step->width + step->below; i++) {
    const double l = sli_entry(F, step->panel + sli_panel_at(step->width, i, j));
    double *xi =
      x + (ptrdiff_t)(i < step->width ? step->base + i : rows[i - step->width]) * lanes;
    for (r = 0; r < lanes; r++) {
      if (is_transposed) {
        xj[r] += l * xi[r];
      } else {
        xi[r] += l * xj[r];
      }
    }
  }
}

static void sli_lower_multiply(const sl_factor *F, int is_transposed, double *x, sl_int lanes) {
  const sl_symbolic *S = F->S;
  sl_int at, s, k, j;
  for (at = 0; at < S->n_supers; at++) {
    s = is_transposed ? at : S->n_supers - 1 - at;
    for (k = 0; k < S->steps[s].width; k++) {
      j = is_transposed ? k : S->steps[s].width - 1 - k;
      sli_column_multiply(F, &S->steps[s], S->rows + S->rows_begin[s], j, is_transposed, x,
                lanes);
    }
  }
}

static void sli_parts_apply(const sli_parts *p, const sli_vectors *v, int kind) {
  const sl_factor *F = p->F;
  const sli_reach *R = &p->q.backward;
  const sl_int lanes = (sl_int)1 << kind;
  if (p->is_product && p->parts & SL_PART_LT) {
    sli_lower_multiply(F, 1, v->x, lanes);
  }
  if (!p->is_product && p->parts & SL_PART_L) {
    sli_forward_sweep(F, kind, R->count, R->steps, R->rows, v->x, v->scratch);
  }
  if (p->parts & (SL_PART_D | SL_PART_SQRT_D)) {
    sli_parts_scale(p, v->x, lanes);
  }
  if (p->is_product && p->parts & SL_PART_L) {
    sli_lower_multiply(F, 0, v->x, lanes);
  }
  if (!p->is_product && p->parts & SL_PART_LT) {
    sli_backward_sweep(F, kind, R->count, p->steps, R->rows + R->n_rows, p->ones, v->x,
               v->scratch);
  }
}

static sl_status sli_parts_check(const sl_factor *F, unsigned parts) {
  const unsigned both = SL_PART_D | SL_PART_SQRT_D;
  if (parts >= 2u * SL_PART_PT || (parts & both) == both) {
    return SL_ERR_ARGUMENT;
  }
  if (!F->is_valid || !sli_factor_is_over(F, F->S, F->analysis)) {
    return SL_ERR_STATE;
  }
  if (parts & SL_PART_SQRT_D && F->stats.factor.negative > 0) {
    return SL_ERR_PIVOT;
  }
  return parts & SL_PART_SQRT_D && F->E != NULL ? SL_ERR_UNSUPPORTED : SL_OK;
}

static sl_status sli_parts_run(sli_parts *p, double *X, size_t ldx, const double *B, size_t ldb,
                 sl_int nrhs, sl_work *W) {
  const sli_dense x_at = sli_dense_of(SLI_COLUMN_MAJOR, ldx);
  const sli_dense b_at = sli_dense_of(SLI_COLUMN_MAJOR, ldb);
  sl_status status = sli_check_dense(X, ldx, p->q.nx, B, ldb, p->q.nb, SLI_COLUMN_MAJOR, nrhs);
  sli_block b = {NULL, 0, 0};
  sl_work own;
  sl_int r;
  status = status == SL_OK ? sli_parts_check(p->F, p->parts) : status;
  if (status != SL_OK || nrhs == 0 || p->q.nx == 0) {
    return status;
  }
  own = sli_work_own(&p->F->allocator);
  W = W == NULL ? &own : W;
  sli_parts_layout(p, &b, nrhs);
  status = sli_work_block(W, &b);
  if (status == SL_OK) {
    sli_parts_layout(p, &b, nrhs);
    sli_parts_fill(p);
  }
  for (r = 0; r < nrhs && status == SL_OK; r += 8) {
    const sl_int block = sli_min(8, nrhs - r);
    const int kind = sli_lanes_kind(block);
    const sli_vectors v = sli_vectors_of(&p->q, block, p->memory);
    sli_pack(&p->q, v.y, B + (size_t)r * b_at.column, b_at, (sl_int)1 << kind, block);
    sli_parts_apply(p, &v, kind);
    sli_unpack(&p->q, X + (size_t)r * x_at.column, x_at, v.x, (sl_int)1 << kind, block);
  }
  sli_free(&own.allocator, own.block);
  return status;
}

static sl_status sli_factor_part(const sl_factor *F, unsigned parts, int is_product, double *X,
                 size_t ldx, const double *B, size_t ldb, sl_int nrhs, sl_work *W) {
  sli_query all;
  sli_parts p;
  if (F == NULL) {
    return SL_ERR_ARGUMENT;
  }
  memset(&p, 0, sizeof p);
  all = sli_query_all(F->S);
  p.F = F;
  p.parts = parts;
  p.is_product = is_product;
  p.q = sli_parts_query(&all, &all.forward, (parts & SL_PART_P) != 0, (parts & SL_PART_PT) != 0);
  return sli_parts_run(&p, X, ldx, B, ldb, nrhs, W);
}

SL_API sl_status sl_factor_solve_part(const sl_factor *F, unsigned parts, double *X, size_t ldx,
                    const double *B, size_t ldb, sl_int nrhs, sl_work *W) {
  return sli_factor_part(F, parts, 0, X, ldx, B, ldb, nrhs, W);
}

SL_API sl_status sl_factor_multiply_part(const sl_factor *F, unsigned parts, double *X, size_t ldx,
                     const double *B, size_t ldb, sl_int nrhs, sl_work *W) {
  return sli_factor_part(F, parts, 1, X, ldx, B, ldb, nrhs, W);
}

SL_API sl_status sl_plan_solve_part(const sl_plan *P, const sl_factor *F, unsigned parts, double *X,
                  size_t ldx, const double *B, size_t ldb, sl_int nrhs,
                  sl_work *W) {
  const unsigned ends = parts & ~(unsigned)(SL_PART_D | SL_PART_SQRT_D);
  const int is_forward = ends == (SL_PART_P | SL_PART_L);
  sli_parts p;
  if (P == NULL || F == NULL || (!is_forward && ends != (SL_PART_LT | SL_PART_PT))) {
    return SL_ERR_ARGUMENT;
  }
  if (!sli_factor_is_over(F, P->query.S, P->query.analysis)) {
    return SL_ERR_STATE;
  }
  if (P->query.region != NULL) {
    return SL_ERR_UNSUPPORTED;
  }
  memset(&p, 0, sizeof p);
  p.F = F;
  p.parts = parts;
  p.q = sli_parts_query(&P->query, is_forward ? &P->query.forward : &P->query.backward,
              is_forward, !is_forward);
  return sli_parts_run(&p, X, ldx, B, ldb, nrhs, W);
}

SL_API sl_status sl_plan_columns(const sl_plan *P, sl_part part, sl_int *columns, sl_int capacity,
                 sl_int *count) {
  const sli_reach *R;
  sl_int s, k, at = 0;
  if (P == NULL || count == NULL || capacity < 0 || (capacity > 0 && columns == NULL) ||
    (part != SL_PART_L && part != SL_PART_LT)) {
    return SL_ERR_ARGUMENT;
  }
  if (P->query.region != NULL) {
    return SL_ERR_UNSUPPORTED;
  }
  R = part == SL_PART_L ? &P->query.forward : &P->query.backward;
  for (s = 0; s < R->count; s++) {
    for (k = 0; k < sli_step_columns(&R->steps[s]) && at < capacity; k++) {
      columns[at++] = R->steps[s].column + k;
    }
  }
  *count = R->columns;
  return SL_OK;
}

static sl_status sli_parts_reserve(sl_work *W, const sli_query *q, sl_int nrhs) {
  const sli_reach *const reaches[2] = {&q->forward, &q->backward};
  sl_status status = SL_OK;
  int k;
  for (k = 0; k < 2 && nrhs > 0 && status == SL_OK; k++) {
    sli_block b = {NULL, 0, 0};
    sli_parts p;
    memset(&p, 0, sizeof p);
    p.q = sli_parts_query(q, reaches[k], 0, 0);
    sli_parts_layout(&p, &b, nrhs);
    status = sli_work_block(W, &b);
  }
  return status;
}

SL_API sl_status sl_work_reserve_part(sl_work *W, const sl_factor *F, sl_int nrhs) {
  sli_query q;
  if (W == NULL || F == NULL || nrhs < 0) {
    return SL_ERR_ARGUMENT;
  }
  q = sli_query_all(F->S);
  return sli_parts_reserve(W, &q, nrhs);
}

SL_API sl_status sl_work_reserve_plan_part(sl_work *W, const sl_plan *P, sl_int nrhs) {
  return W == NULL || P == NULL || nrhs < 0 ? SL_ERR_ARGUMENT
                        : sli_parts_reserve(W, &P->query, nrhs);
}

/* src/impl/solve/refine.h: sl_factor_refine: refinement by the componentwise backward error */

typedef struct sli_refinement {
  const sl_factor *F;
  const sl_csc *A;
  sl_triangle triangle;
  double *R, *T;
  double *size;
  unsigned char *memory;
  double error[SLI_TILE];
  int is_done[SLI_TILE];
  int is_slow[SLI_TILE];
  sl_int steps;
} sli_refinement;

static void sli_refinement_layout(sli_refinement *f, sli_block *b, sl_int columns) {
  const sli_query q = sli_query_all(f->F->S);
  const uint64_t n = (uint64_t)f->F->S->n;
  const size_t bytes = sli_vectors_bytes(&q, columns);
  f->R = SLI_TAKE(b, double, n *(uint64_t)columns);
  f->T = SLI_TAKE(b, double, n *(uint64_t)columns);
  f->size = SLI_TAKE(b, double, n);
  f->memory = (unsigned char *)sli_take(b, bytes, 1);
}

static double sli_row_error(const sli_refinement *f, double *r, const double *x, const double *b) {
  const sl_csc *A = f->A;
  double *size = f->size, worst = 0.0;
  sl_int i, j, p;
  for (i = 0; i < A->n_cols; i++) {
    r[i] = b[i];
    size[i] = fabs(b[i]);
  }
  for (j = 0; j < A->n_cols; j++) {
    for (p = A->p[j]; p < A->p[j + 1]; p++) {
      i = A->i[p];
      if (sli_is_read(f->triangle, i, j)) {
        r[i] -= A->x[p] * x[j];
        size[i] += fabs(A->x[p] * x[j]);
        if (i != j) {
          r[j] -= A->x[p] * x[i];
          size[j] += fabs(A->x[p] * x[i]);
        }
      }
    }
  }
  for (i = 0; i < A->n_cols; i++) {
    const double error = sli_backward_error(fabs(r[i]), 0.0, 0.0, size[i]);
    worst = error <= worst || worst != worst ? worst : error;
  }
  return worst;
}

static void sli_correct(const sli_refinement *f, sl_int columns) {
  const sli_query q = sli_query_all(f->F->S);
  const sli_dense at = sli_dense_of(SLI_COLUMN_MAJOR, (size_t)f->F->S->n);
  const sl_int lanes = (sl_int)1 << sli_lanes_kind(columns);
  const sli_vectors v = sli_vectors_of(&q, columns, f->memory);
  sli_pack(&q, v.y, f->R, at, lanes, columns);
  sli_sweep_forward(f->F, &q, &v, columns);
  sli_sweep_backward(f->F, &q, &v, columns);
  sli_unpack(&q, f->R, at, v.x, lanes, columns);
}

static int sli_refine_column(sli_refinement *f, sl_int c, double *x, const double *b) {
  const size_t n = (size_t)f->F->S->n;
  double *t = f->T + n * (size_t)c, *r = f->R + n * (size_t)c, error;
  const int may_wait = f->F->storage == SL_STORAGE_FLOAT && !f->is_slow[c];
  size_t i;
  int is_kept;
  for (i = 0; i < n; i++) {
    t[i] = x[i] + r[i];
  }
  error = sli_row_error(f, r, t, b);
  is_kept = error < f->error[c] || (may_wait && error <= 2.0 * f->error[c]);
  f->is_slow[c] = !(error <= 0.5 * f->error[c]);
  f->is_done[c] = error <= DBL_EPSILON || (f->is_slow[c] && !(may_wait && is_kept));
  if (is_kept) {
    memcpy(x, t, n * sizeof(double));
    f->error[c] = error;
  }
  return is_kept;
}

static void sli_refine_block(sli_refinement *f, double *X, size_t ldx, const double *B, size_t ldb,
               sl_int columns, sl_int steps) {
  const size_t n = (size_t)f->F->S->n;
  sl_int c, step, todo = 0;
  for (c = 0; c < columns; c++) {
    f->error[c] =
      sli_row_error(f, f->R + n * (size_t)c, X + ldx * (size_t)c, B + ldb * (size_t)c);
    f->is_done[c] = f->error[c] <= DBL_EPSILON;
    f->is_slow[c] = 0;
    todo += !f->is_done[c];
  }
  for (step = 1; step <= steps && todo > 0; step++) {
    sli_correct(f, columns);
    todo = 0;
    for (c = 0; c < columns; c++) {
      if (!f->is_done[c]) {
        if (sli_refine_column(f, c, X + ldx * (size_t)c, B + ldb * (size_t)c)) {
          f->steps = sli_max(f->steps, step);
        }
        todo += !f->is_done[c];
      }
    }
  }
}

SLI_INLINE double sli_max_error(double a, double b) {
  return a != a || a > b ? a : b;
}

static sl_status sli_refine_done(const sl_factor *F, sl_stats *stats, sl_int most, sl_int steps,
                 double error) {
  if (stats != NULL) {
    stats->refine.steps = steps;
    stats->refine.backward_error = error;
  }
  return most > 0 && !(error <= F->error_limit) && sli_is_finite(F->error_limit)
         ? SL_ERR_INACCURATE
         : SL_OK;
}

SL_API sl_status sl_work_reserve_refine(sl_work *W, const sl_factor *F, sl_int nrhs) {
  sli_block b = {NULL, 0, 0};
  sli_refinement f;
  if (W == NULL || F == NULL || nrhs < 0) {
    return SL_ERR_ARGUMENT;
  }
  memset(&f, 0, sizeof f);
  f.F = F;
  sli_refinement_layout(&f, &b, sli_min(nrhs, 8));
  return nrhs > 0 ? sli_work_block(W, &b) : SL_OK;
}

SL_API sl_status sl_factor_refine(const sl_factor *F, const sl_csc *A, double *X, size_t ldx,
                  const double *B, size_t ldb, sl_int nrhs, sl_int steps,
                  sl_work *W, sl_stats *stats) {
  sli_block b = {NULL, 0, 0};
  sli_refinement f;
  sl_work own;
  sl_status status;
  double worst = 0.0;
  sl_int r, c;
  sli_stats_clear_error(stats);
  if (F == NULL || steps < 0) {
    return SL_ERR_ARGUMENT;
  }
  status = sli_check_dense(X, ldx, F->S->n, B, ldb, F->S->n, SLI_COLUMN_MAJOR, nrhs);
  if (status != SL_OK || (X == B && nrhs > 0 && F->S->n > 0)) {
    return SL_ERR_ARGUMENT;
  }
  status = sli_factor_fits(F, A);
  if (status != SL_OK) {
    return status;
  }
  memset(&f, 0, sizeof f);
  f.F = F;
  f.A = A;
  f.triangle = F->S->stats.symbolic.triangle;
  own = sli_work_own(&F->allocator);
  W = W == NULL ? &own : W;
  sli_refinement_layout(&f, &b, sli_min(nrhs, 8));
  status = nrhs > 0 ? sli_work_block(W, &b) : SL_OK;
  if (status == SL_OK && nrhs > 0 && F->S->n > 0) {
    sli_refinement_layout(&f, &b, sli_min(nrhs, 8));
    for (r = 0; r < nrhs; r += 8) {
      sli_refine_block(&f, X + ldx * (size_t)r, ldx, B + ldb * (size_t)r, ldb,
               sli_min(8, nrhs - r), steps);
      for (c = 0; c < sli_min(8, nrhs - r); c++) {
        worst = sli_max_error(f.error[c], worst);
      }
    }
  }
  sli_free(&own.allocator, own.block);
  return status == SL_OK ? sli_refine_done(F, stats, steps, f.steps, worst) : status;
}

/* src/impl/solve/refine_local.h: sl_plan_solve_refined: local solves without the error of regularization */

typedef struct sli_local_refinement {
  const sl_factor *F;
  const sli_query *q;
  sl_int count, room;
  sl_int *row;
  sl_int *in_y;
  sl_int *in_x;
  double *previous;
  double *current;
  double *best;
  unsigned char *memory;
  double error[SLI_TILE];
  int is_done[SLI_TILE];
  sl_int steps;
} sli_local_refinement;

static void sli_local_refinement_layout(sli_local_refinement *f, sli_block *b, sl_int nrhs) {
  const size_t bytes = sli_vectors_bytes(f->q, nrhs);
  const uint64_t columns = (uint64_t)sli_min(nrhs, 8);
  f->row = SLI_TAKE(b, sl_int, f->room);
  f->in_y = SLI_TAKE(b, sl_int, f->room);
  f->in_x = SLI_TAKE(b, sl_int, f->room);
  f->previous = SLI_TAKE(b, double, (uint64_t)f->room *columns);
  f->current = SLI_TAKE(b, double, (uint64_t)f->q->nx *columns);
  f->best = SLI_TAKE(b, double, (uint64_t)f->q->nx *columns);
  f->memory = (unsigned char *)sli_take(b, bytes, 1);
}

static sl_int sli_local_refinement_find(sli_local_refinement *f) {
  const sl_factor *F = f->F;
  const sli_reach *R = &f->q->forward;
  sl_int s;
  f->count = 0;
  for (s = 0; s < R->count; s++) {
    sli_tree_range tree;
    sl_int m;
    if (R->steps[s].up != -1) {
      continue;
    }
    tree = sli_tree_range_of(F->S, &R->steps[s]);
    m = sli_lower_bound(F->regularized, F->stats.factor.regularized, tree.first);
    for (; m < F->stats.factor.regularized && F->regularized[m] <= tree.root; m++) {
      const sl_int k = F->regularized[m];
      const sl_int in_y = sli_reach_index_of(R, k),
             in_x = sli_reach_index_of(&f->q->backward, k);
      if (in_y == -1 || in_x == -1) {
        return k;
      }
      f->row[f->count] = k;
      f->in_y[f->count] = in_y;
      f->in_x[f->count++] = in_x;
    }
  }
  return -1;
}

static void sli_local_refinement_step(sli_local_refinement *f, const double *B, sli_dense at,
                    sl_int columns, const double *norms, sl_int step) {
  const sl_int lanes = (sl_int)1 << sli_lanes_kind(columns);
  const sli_vectors v = sli_vectors_of(f->q, columns, f->memory);
  const size_t nx = (size_t)f->q->nx;
  sl_int m, c;
  sli_pack(f->q, v.y, B, at, lanes, columns);
  for (m = 0; m < f->count; m++) {
    for (c = 0; c < columns; c++) {
      v.y[(ptrdiff_t)f->in_y[m] * lanes + c] +=
        f->F->rule.shifts[f->row[m]] * f->previous[(ptrdiff_t)m * columns + c];
    }
  }
  sli_sweep_forward(f->F, f->q, &v, columns);
  sli_sweep_backward(f->F, f->q, &v, columns);
  sli_unpack(f->q, f->current, sli_dense_of(SLI_COLUMN_MAJOR, nx), v.x, lanes, columns);
  for (c = 0; c < columns; c++) {
    double error = 0.0;
    for (m = 0; m < f->count; m++) {
      double *previous = &f->previous[(ptrdiff_t)m * columns + c];
      const double x = v.x[(ptrdiff_t)f->in_x[m] * lanes + c];
      error = sli_max_error(fabs(f->F->rule.shifts[f->row[m]] * (x - *previous)), error);
      *previous = x;
    }
    error = sli_backward_error(error, 0.0, 0.0, norms[c]);
    if (step == 0 || (!f->is_done[c] && error < f->error[c])) {
      f->is_done[c] = step > 0 && !(error <= 0.5 * f->error[c]);
      f->is_done[c] |= error <= DBL_EPSILON;
      f->error[c] = error;
      f->steps = sli_max(f->steps, step);
      memcpy(f->best + nx * (size_t)c, f->current + nx * (size_t)c, nx * sizeof(double));
    } else {
      f->is_done[c] = 1;
    }
  }
}

static void sli_local_refinement_norms(const sli_local_refinement *f, const double *B, size_t ldb,
                     sl_int columns, double *norms) {
  const sl_int lanes = (sl_int)1 << sli_lanes_kind(columns);
  const sli_vectors v = sli_vectors_of(f->q, columns, f->memory);
  sl_int k, c;
  if (!f->q->b_repeats) {
    for (c = 0; c < columns; c++) {
      norms[c] = sli_largest(f->q->nb > 0 ? B + ldb * (size_t)c : B, f->q->nb);
    }
    return;
  }
  sli_pack(f->q, v.y, B, sli_dense_of(SLI_COLUMN_MAJOR, ldb), lanes, columns);
  for (c = 0; c < columns; c++) {
    norms[c] = 0.0;
  }
  for (k = 0; k < f->q->forward.columns; k++) {
    for (c = 0; c < columns; c++) {
      norms[c] = sli_max_error(fabs(v.y[(ptrdiff_t)k * lanes + c]), norms[c]);
    }
  }
}

static void sli_local_refinement_block(sli_local_refinement *f, double *X, size_t ldx,
                     const double *B, size_t ldb, sl_int columns, sl_int steps) {
  const sli_dense at = sli_dense_of(SLI_COLUMN_MAJOR, ldb);
  const size_t nx = (size_t)f->q->nx;
  double norms[SLI_TILE];
  sl_int c, step, todo = columns;
  sli_local_refinement_norms(f, B, ldb, columns, norms);
  memset(f->previous, 0, (size_t)f->count * (size_t)columns * sizeof(double));
  for (step = 0; step <= steps && todo > 0; step++) {
    sli_local_refinement_step(f, B, at, columns, norms, step);
    for (c = 0, todo = 0; c < columns; c++) {
      todo += !f->is_done[c];
    }
  }
  for (c = 0; c < columns; c++) {
    memcpy(X + ldx * (size_t)c, f->best + nx * (size_t)c, nx * sizeof(double));
  }
}

static sl_status sli_local_refine(sli_local_refinement *f, double *X, size_t ldx, const double *B,
                  size_t ldb, sl_int nrhs, sl_int steps, sl_work *W,
                  sl_stats *stats) {
  sli_block b = {NULL, 0, 0};
  double worst = 0.0;
  sl_status status;
  sl_int r, c;
  sli_local_refinement_layout(f, &b, nrhs);
  status = sli_work_block(W, &b);
  if (status != SL_OK) {
    return status;
  }
  sli_local_refinement_layout(f, &b, nrhs);
  c = sli_local_refinement_find(f);
  if (c != -1) {
    return sli_fail_at(stats, SL_ERR_ARGUMENT, f->F->S->perm[c], -1, f->F->rule.shifts[c]);
  }
  for (r = 0; r < nrhs; r += 8) {
    const sl_int columns = sli_min(8, nrhs - r);
    sli_local_refinement_block(f, X + ldx * (size_t)r, ldx,
                   f->q->nb > 0 ? B + ldb * (size_t)r : B, ldb, columns, steps);
    for (c = 0; c < columns; c++) {
      worst = sli_max_error(f->error[c], worst);
    }
  }
  return sli_refine_done(f->F, stats, steps, f->steps, worst);
}

SL_API sl_status sl_work_reserve_refined(sl_work *W, const sl_plan *P, sl_int nrhs) {
  sli_block b = {NULL, 0, 0};
  sli_local_refinement f;
  if (W == NULL || P == NULL || nrhs < 0) {
    return SL_ERR_ARGUMENT;
  }
  if (nrhs == 0 || P->query.nx == 0) {
    return SL_OK;
  }
  memset(&f, 0, sizeof f);
  f.q = &P->query;
  f.room = sli_min(P->query.forward.columns, P->query.backward.columns);
  sli_local_refinement_layout(&f, &b, nrhs);
  return sli_work_block(W, &b);
}

SL_API sl_status sl_plan_solve_refined(const sl_plan *P, const sl_factor *F, double *X, size_t ldx,
                     const double *B, size_t ldb, sl_int nrhs, sl_int steps,
                     sl_work *W, sl_stats *stats) {
  sli_local_refinement f;
  sl_work own;
  sl_status status;
  sli_stats_clear_error(stats);
  if (P == NULL || F == NULL || steps < 0) {
    return SL_ERR_ARGUMENT;
  }
  if (F->stats.factor.regularized == 0 || nrhs == 0 || P->query.nx == 0) {
    status = sl_plan_solve(P, F, X, ldx, B, ldb, nrhs, W);
    return status == SL_OK ? sli_refine_done(F, stats, steps, 0, 0.0) : status;
  }
  status = sli_check_dense(X, ldx, P->query.nx, B, ldb, P->query.nb, SLI_COLUMN_MAJOR, nrhs);
  if (status != SL_OK) {
    return status;
  }
  if (!sli_query_fits(&P->query, F)) {
    return SL_ERR_STATE;
  }
  if (P->query.region != NULL) {
    return SL_ERR_UNSUPPORTED;
  }
  memset(&f, 0, sizeof f);
  f.F = F;
  f.q = &P->query;
  f.room = sli_min(F->stats.factor.regularized,
           sli_min(P->query.forward.columns, P->query.backward.columns));
  own = sli_work_own(&F->allocator);
  status = sli_local_refine(&f, X, ldx, B, ldb, nrhs, steps, W == NULL ? &own : W, stats);
  sli_free(&own.allocator, own.block);
  return status;
}

/* src/impl/solve/rcond.h: sl_factor_rcond: reciprocal condition number by the Hager-Higham estimator */

#define SLI_ROUNDING_ERROR 64.0

typedef struct sli_norm_estimate {
  const sl_factor *F;
  const sl_csc *A;
  double norm;
  double error;
  sli_reach all;
  double *v, *signs, *residual, *scratch;
} sli_norm_estimate;

static void sli_norm_estimate_layout(sli_norm_estimate *p, sli_block *b) {
  p->v = SLI_TAKE(b, double, p->all.columns);
  p->signs = SLI_TAKE(b, double, p->all.columns);
  p->residual = SLI_TAKE(b, double, p->all.columns);
  p->scratch = SLI_TAKE(b, double, sli_sweep_scratch(p->all.tallest, p->all.widest, 1));
}

static void sli_norm_estimate_residual(const sli_norm_estimate *p) {
  const sl_csc *A = p->A;
  const sl_int *iperm = p->F->S->iperm;
  const sl_triangle triangle = p->F->S->stats.symbolic.triangle;
  sl_int j, k, m, q;
  for (j = 0; j < A->n_cols; j++) {
    k = iperm[j];
    for (q = A->p[j]; q < A->p[j + 1]; q++) {
      m = iperm[A->i[q]];
      if (sli_is_read(triangle, A->i[q], j)) {
        p->residual[m] -= A->x[q] * p->v[k];
        p->residual[k] -= m != k ? A->x[q] * p->v[m] : 0.0;
      }
    }
    p->residual[k] -= p->F->rule.shifts != NULL ? p->F->rule.shifts[k] * p->v[k] : 0.0;
  }
}

static double sli_norm_estimate_solve(sli_norm_estimate *p) {
  const sl_factor *F = p->F;
  const sl_int n = p->all.columns;
  const double size = sli_largest(p->v, n);
  double sum = 0.0, error;
  sl_int k;
  memcpy(p->residual, p->v, (size_t)n * sizeof(double));
  sli_forward_sweep(F, SLI_NRHS_1, p->all.count, p->all.steps, p->all.rows, p->v, p->scratch);
  sli_backward(F, &p->all, SLI_NRHS_1, p->v, p->scratch);
  for (k = 0; k < n; k++) {
    sum += fabs(p->v[k]);
  }
  sli_norm_estimate_residual(p);
  error = sli_backward_error(sli_largest(p->residual, n), p->norm, sli_largest(p->v, n), size);
  p->error = error > p->error ? error : p->error;
  return sum;
}

static int sli_norm_estimate_signs(const sli_norm_estimate *p) {
  int same = 1;
  sl_int k;
  for (k = 0; k < p->all.columns; k++) {
    const double sign = p->v[k] < 0.0 ? -1.0 : 1.0;
    same &= sign == p->signs[k];
    p->signs[k] = sign;
  }
  return same;
}

static sl_int sli_norm_estimate_largest(const sli_norm_estimate *p) {
  sl_int k, best = 0;
  for (k = 1; k < p->all.columns; k++) {
    best = fabs(p->v[k]) > fabs(p->v[best]) ? k : best;
  }
  return best;
}

static double sli_inverse_norm(sli_norm_estimate *p) {
  const sl_int n = p->all.columns;
  double best, sum;
  sl_int k, j = -1, turn;
  for (k = 0; k < n; k++) {
    p->v[k] = 1.0 / n;
    p->signs[k] = 0.0;
  }
  best = sli_norm_estimate_solve(p);
  for (turn = 0; turn < 4 && !sli_norm_estimate_signs(p); turn++) {
    sl_int last = j;
    memcpy(p->v, p->signs, (size_t)n * sizeof(double));
    (void)sli_norm_estimate_solve(p);
    j = sli_norm_estimate_largest(p);
    if (last != -1 && fabs(p->v[j]) <= fabs(p->v[last])) {
      break;
    }
    memset(p->v, 0, (size_t)n * sizeof(double));
    p->v[j] = 1.0;
    sum = sli_norm_estimate_solve(p);
    if (!(sum > best)) {
      break;
    }
    best = sum;
  }
  for (k = 0; k < n; k++) {
    p->v[k] = (k % 2 == 0 ? 1.0 : -1.0) * (1.0 + (double)k / (n > 1 ? n - 1 : 1));
  }
  sum = 2.0 * sli_norm_estimate_solve(p) / (3.0 * n);
  return sum > best || sum != sum ? sum : best;
}

SL_API sl_status sl_work_reserve_rcond(sl_work *W, const sl_factor *F) {
  sli_block b = {NULL, 0, 0};
  sli_norm_estimate p;
  if (W == NULL || F == NULL) {
    return SL_ERR_ARGUMENT;
  }
  p.all = sli_reach_all(F->S);
  sli_norm_estimate_layout(&p, &b);
  return sli_work_block(W, &b);
}

SL_API sl_status sl_factor_rcond(const sl_factor *F, const sl_csc *A, double *rcond, sl_work *W) {
  sli_block b = {NULL, 0, 0};
  sl_work own;
  sli_norm_estimate p;
  sl_status status;
  if (F == NULL || rcond == NULL) {
    return SL_ERR_ARGUMENT;
  }
  status = sli_factor_fits(F, A);
  if (status != SL_OK) {
    return status;
  }
  if (F->S->n == 0 || F->n_nulls > 0) {
    *rcond = F->S->n == 0 ? 1.0 : 0.0;
    return SL_OK;
  }
  p.F = F;
  p.A = A;
  p.error = 0.0;
  p.all = sli_reach_all(F->S);
  own = sli_work_own(&F->allocator);
  W = W == NULL ? &own : W;
  sli_norm_estimate_layout(&p, &b);
  status = sli_work_block(W, &b);
  if (status == SL_OK) {
    double inverse, unit;
    sli_norm_estimate_layout(&p, &b);
    p.norm = sli_csc_norm(A, F->S->stats.symbolic.triangle, p.v);
    inverse = sli_inverse_norm(&p);
    *rcond = p.norm > 0.0 && inverse > 0.0
           ? 1.0 / fmax(p.norm, inverse) / fmin(p.norm, inverse)
           : 0.0;
    unit = F->storage == SL_STORAGE_FLOAT ? (double)FLT_EPSILON : DBL_EPSILON;
    *rcond *= p.error > SLI_ROUNDING_ERROR * unit ? unit / p.error : 1.0;
  }
  sli_free(&own.allocator, own.block);
  return status;
}

/* src/impl/solve/defects.h: sl_factor_defects: by how much right-hand sides are inconsistent */

static void sli_defects_known(const sl_factor *F, const sli_query *q, double *Y, size_t ldy,
                const double *b, sl_int lanes, sl_int nrhs) {
  const sli_reach *R = &q->forward;
  sl_int first = 0, s, m, r;
  for (s = 0; s < R->count; s++) {
    sli_null_dot dot;
    if (R->steps[s].up != -1) {
      continue;
    }
    m = sli_null_first(F, R, s);
    while (sli_null_dot_next(F, R, first, s, b, lanes, &m, &dot)) {
      for (r = 0; r < nrhs; r++) {
        Y[(size_t)dot.number + (size_t)r * ldy] = dot.sums[r];
      }
    }
    first = s + 1;
  }
}

static void sli_defects(const sl_factor *F, const sli_query *q, double *Y, size_t ldy,
            const double *B, size_t ldb, sl_int nrhs, void *memory) {
  sl_int c, r, m;
  for (c = 0; c < nrhs; c += 8) {
    const sl_int block = sli_min(8, nrhs - c), lanes = (sl_int)1 << sli_lanes_kind(block);
    const sli_vectors v = sli_vectors_of(q, block, memory);
    sli_pack(q, v.y, B + (size_t)c * ldb, sli_dense_of(SLI_COLUMN_MAJOR, ldb), lanes, block);
    if (F->null_vectors > 1) {
      sli_defects_known(F, q, Y + (size_t)c * ldy, ldy, v.y, lanes, block);
    }
    sli_sweep_forward(F, q, &v, block);
    for (m = 0; m < F->n_nulls; m++) {
      const int is_known = F->null_vectors > 1 && sli_null_column(F, F->nulls[m]) != -1;
      for (r = 0; r < block && !is_known; r++) {
        Y[(size_t)m + (size_t)(c + r) * ldy] = v.y[(ptrdiff_t)F->nulls[m] * lanes + r];
      }
    }
  }
}

SL_API sl_status sl_work_reserve_defects(sl_work *W, const sl_factor *F, sl_int nrhs) {
  return sl_work_reserve_factor(W, F, nrhs);
}

SL_API sl_status sl_factor_defects(const sl_factor *F, double *Y, size_t ldy, const double *B,
                   size_t ldb, sl_int nrhs, sl_work *W) {
  sli_block b = {NULL, 0, 0};
  sl_work own;
  sli_query q;
  sl_status status;
  if (F == NULL) {
    return SL_ERR_ARGUMENT;
  }
  if (!F->is_valid) {
    return SL_ERR_STATE;
  }
  status = sli_check_dense(Y, ldy, F->n_nulls, B, ldb, F->S->n, SLI_COLUMN_MAJOR, nrhs);
  if (status != SL_OK || (Y == B && Y != NULL)) {
    return SL_ERR_ARGUMENT;
  }
  if (nrhs == 0 || F->n_nulls == 0) {
    return SL_OK;
  }
  q = sli_query_all(F->S);
  own = sli_work_own(&F->allocator);
  W = W == NULL ? &own : W;
  b.used = sli_vectors_bytes(&q, nrhs);
  status = sli_work_block(W, &b);
  if (status == SL_OK) {
    sli_defects(F, &q, Y, ldy, B, ldb, nrhs, W->block);
  }
  sli_free(&own.allocator, own.block);
  return status;
}

/* inverse: entries of the inverse, regions */
/* src/impl/inverse/traversal.h: plan of a top-down traversal: its fronts, the tasks of workers, memory */

typedef struct sli_traversal {
  const sl_symbolic *S;
  sli_forest forest;
  sl_int *supers;
  sl_int *parent, *low;
  int is_partial;
  sl_int *first;
  sli_schedule schedule;
  sl_off scratch;
  sl_off panel;
  sli_schedule_work schedule_work;
} sli_traversal;

SLI_INLINE sl_off sli_traversal_front_size(const sli_traversal *t, sl_int k) {
  const sli_step *step = &t->S->steps[t->supers[k]];
  const sl_int h = step->width + step->below;
  return (sl_off)sli_square_offset(h, sli_tiles(h)) + SLI_TILE * SLI_TILE;
}

static sli_traversal sli_traversal_of(const sl_symbolic *S, sl_int count, sl_int workers) {
  sli_traversal t;
  memset(&t, 0, sizeof t);
  t.S = S;
  t.forest.count = count;
  t.schedule.workers = sli_min(workers, sli_max(count, 1));
  return t;
}

static void sli_traversal_layout(sli_traversal *t, sli_block *b) {
  const sl_int count = t->forest.count, some = count < t->S->n_supers ? count : 0;
  t->supers = SLI_TAKE(b, sl_int, count);
  t->parent = SLI_TAKE(b, sl_int, some);
  t->low = SLI_TAKE(b, sl_int, some);
  t->first = t->is_partial ? SLI_TAKE(b, sl_int, count) : NULL;
  sli_schedule_layout(&t->schedule, b, count);
}

static void sli_traversal_layout_work(sli_traversal *t, sli_block *b) {
  const sl_int workers = t->schedule.workers;
  if (workers > 1) {
    sli_schedule_work_layout(&t->schedule_work, b, t->forest.count, workers);
  }
}

static void sli_traversal_list_reach(sli_traversal *t, const uint64_t *seeds, sl_int n_seeds) {
  const sl_symbolic *S = t->S;
  sl_int k = 0, at = 0, s, next;
  while (k < n_seeds) {
    sl_int column = sli_key(seeds[k]);
    s = S->super_of[column];
    next = sli_next_seed(S, seeds, n_seeds, &k);
    for (; s != -1 && s < next; s = S->super_parent[s]) {
      if (t->first != NULL) {
        t->first[at] = sli_min(column - S->super_first[s], S->steps[s].width);
      }
      t->supers[at++] = s;
      column = INT32_MAX;
    }
  }
  SLI_ASSERT(at == t->forest.count);
}

static void sli_traversal_find_first(sli_traversal *t) {
  const sl_symbolic *S = t->S;
  sl_int k;
  for (k = 0; k < t->forest.count; k++) {
    const sl_int parent = t->forest.parent[k];
    if (parent != -1) {
      const sl_int row = S->relative[S->rows_begin[t->supers[k]]];
      t->first[parent] = sli_min(t->first[parent], row);
    }
  }
}

static void sli_traversal_link(sli_traversal *t) {
  const sl_symbolic *S = t->S;
  const sl_int count = t->forest.count;
  sl_int k, above = -1;
  t->forest.parent = S->super_parent;
  t->forest.low = S->first_descendant;
  if (count == S->n_supers) {
    return;
  }
  for (k = count - 1; k >= 0; k--) {
    const sl_int parent = S->super_parent[t->supers[k]];
    while (above != -1 && t->supers[above] != parent) {
      above = t->parent[above];
    }
    t->parent[k] = above;
    t->low[k] = k;
    above = k;
  }
  for (k = 0; k < count; k++) {
    if (t->parent[k] != -1) {
      t->low[t->parent[k]] = sli_min(t->low[t->parent[k]], t->low[k]);
    }
  }
  t->forest.parent = t->parent;
  t->forest.low = t->low;
}

static void sli_traversal_push(sli_traversal *t, sli_stacks *stacks, sl_int k, int is_root,
                 int is_last, int is_leaf) {
  const sl_int parent = t->forest.parent[k];
  sl_off *begin = t->schedule.stack_begin, *top = stacks->top;
  const int side = is_root ? 0 : begin[parent] >= 0;
  const sl_off size = sli_traversal_front_size(t, k);
  begin[k] = side == 0 ? top[0] : -(top[1] + size);
  top[side] += size;
  stacks->most = top[0] + top[1] > stacks->most ? top[0] + top[1] : stacks->most;
  if (is_last) {
    top[1 - side] -= sli_traversal_front_size(t, parent);
  }
  if (is_leaf) {
    top[side] -= size;
  }
}

SLI_INLINE void sli_traversal_settle(sli_traversal *t, const sli_stacks *stacks, sl_int k,
                   sl_off from) {
  sl_off *begin = &t->schedule.stack_begin[k];
  *begin += from + (*begin < 0 ? stacks->most : 0);
}

static sl_off sli_traversal_stack_task(sli_traversal *t, sl_int first, sl_int last, sl_off from) {
  const sl_int *parent = t->forest.parent, *low = t->forest.low;
  sli_stacks stacks;
  sl_int k;
  memset(&stacks, 0, sizeof stacks);
  for (k = last; k >= first; k--) {
    const int is_root = parent[k] == -1 || parent[k] > last;
    sli_traversal_push(t, &stacks, k, is_root, !is_root && low[parent[k]] == low[k],
               low[k] == k);
  }
  for (k = first; k <= last; k++) {
    sli_traversal_settle(t, &stacks, k, from);
  }
  return stacks.most;
}

static sl_off sli_traversal_stack_tops(sli_traversal *t, sl_off from) {
  const sli_schedule *p = &t->schedule;
  const sl_int *parent = t->forest.parent;
  sl_int *child = t->schedule_work.side;
  sli_stacks stacks;
  sl_int m;
  memset(&stacks, 0, sizeof stacks);
  for (m = p->n_tops - 1; m >= 0; m--) {
    const sl_int k = p->top[m];
    child[k] = -1;
    if (parent[k] != -1) {
      child[parent[k]] = k;
    }
  }
  for (m = p->n_tops - 1; m >= 0; m--) {
    const sl_int k = p->top[m];
    sli_traversal_push(t, &stacks, k, parent[k] == -1, parent[k] != -1 && child[parent[k]] == k,
               child[k] == -1);
  }
  for (m = 0; m < p->n_tops; m++) {
    sli_traversal_settle(t, &stacks, p->top[m], from);
  }
  return stacks.most;
}

static void sli_traversal_stack_all(sli_traversal *t) {
  sli_schedule *p = &t->schedule;
  const sl_int own_roots = p->workers > 1;
  sl_int k, m;
  p->stack = p->n_tops > 0 ? sli_traversal_stack_tops(t, 0) : 0;
  for (m = 0; m < p->n_tasks && own_roots; m++) {
    p->stack_begin[p->last[m]] = p->stack;
    p->stack += sli_traversal_front_size(t, p->last[m]);
  }
  for (k = 0; k < p->workers; k++) {
    sl_off most = 0;
    for (m = 0; m < p->n_tasks; m++) {
      if (p->worker[m] == k) {
        const sl_off size =
          sli_traversal_stack_task(t, p->first[m], p->last[m] - own_roots, p->stack);
        most = size > most ? size : most;
      }
    }
    p->stack += most;
  }
}

static void sli_traversal_measure(sli_traversal *t) {
  sl_int k, tallest = 0, widest = 0;
  for (k = 0; k < t->forest.count; k++) {
    const sli_step *step = &t->S->steps[t->supers[k]];
    const sl_off panel = sli_panel_size(step->width, step->below);
    t->panel = panel > t->panel ? panel : t->panel;
    tallest = sli_max(tallest, step->width + step->below);
    widest = sli_max(widest, step->width);
  }
  t->scratch = sli_inverse_scratch(tallest, widest);
}

static void sli_traversal_plan(sli_traversal *t, const uint64_t *seeds, sl_int n_seeds) {
  sli_schedule *p = &t->schedule;
  sl_int k;
  if (seeds != NULL) {
    sli_traversal_list_reach(t, seeds, n_seeds);
  }
  for (k = 0; k < t->forest.count && seeds == NULL; k++) {
    t->supers[k] = k;
  }
  sli_traversal_link(t);
  if (t->first != NULL) {
    sli_traversal_find_first(t);
  }
  for (k = 0; k < t->forest.count && p->workers > 1; k++) {
    t->schedule_work.flops[k] = sli_front_flops(&t->S->steps[t->supers[k]]);
  }
  sli_plan_tasks(p, &t->forest, &t->schedule_work);
  sli_traversal_measure(t);
  sli_traversal_stack_all(t);
}

static sl_int sli_front_row(const sl_symbolic *S, sl_int s, sl_int row) {
  const sl_int *rows = S->rows + S->rows_begin[s];
  const sl_int width = S->steps[s].width, below = S->steps[s].below, r = row - S->super_first[s];
  sl_int i;
  if (r < width) {
    return r;
  }
  i = sli_lower_bound(rows, below, row);
  return i < below && rows[i] == row ? width + i : -1;
}

SLI_INLINE sl_off sli_traversal_fronts_size(const sli_traversal *t) {
  return t->schedule.stack;
}

static sl_int sli_traversal_count_columns(const sli_traversal *t) {
  sl_int k, columns = 0;
  for (k = 0; k < t->forest.count; k++) {
    columns += t->S->steps[t->supers[k]].width;
  }
  return columns;
}

/* src/impl/inverse/traversal_run.h: runs a top-down traversal: computes front after front, calls a visitor */

typedef void (*sli_visitor)(void *context, sl_int k, const sli_inverse_front *f, sl_int t0,
              sl_int t1);

typedef struct sli_traversal_run {
  const sl_factor *F;
  const sli_traversal *traversal;
  const sl_threads *threads;
  sli_visitor visit;
  void *context;
  double *fronts, *scratch;
  sl_int at;
  sli_inverse_front front;
  sl_int group;
  sli_inverse_phase phase;
} sli_traversal_run;

SLI_INLINE sl_off sli_traverse_scratch(const sli_traversal *t, sl_storage storage) {
  return t->scratch + (storage == SL_STORAGE_FLOAT ? t->panel : 0);
}

static void sli_traversal_layout_run(sli_traversal_run *run, const sli_traversal *traversal,
                   sl_storage storage, sli_block *b) {
  run->fronts = SLI_TAKE(b, double, traversal->schedule.stack);
  run->scratch = SLI_TAKE(
    b, double,
    (uint64_t)traversal->schedule.workers *(uint64_t)sli_traverse_scratch(traversal, storage));
}

static sli_inverse_front sli_traverse_front(const sli_traversal_run *run, sl_int k) {
  const sli_step *step = &run->traversal->S->steps[run->traversal->supers[k]];
  sli_inverse_front f;
  f.panel =
    run->F->storage == SL_STORAGE_FLOAT ? NULL : (const double *)run->F->values + step->panel;
  f.D = run->F->D + step->column;
  f.front = run->fronts + run->traversal->schedule.stack_begin[k];
  f.width = step->width;
  f.below = step->below;
  f.first = run->traversal->first == NULL ? 0 : run->traversal->first[k];
  return f;
}

static void sli_traverse_gather(const sli_traversal_run *run, sl_int k, const sli_inverse_front *f,
                sl_int t0, sl_int t1) {
  const sli_traversal *traversal = run->traversal;
  const sl_int up = traversal->forest.parent[k];
  if (up != -1) {
    const sli_inverse_front parent = sli_traverse_front(run, up);
    run->F->kernels->gather(
      f, parent.front, parent.width + parent.below,
      traversal->S->relative + traversal->S->rows_begin[traversal->supers[k]], t0, t1);
  }
}

#define SLI_PANEL_AHEAD ((sl_off)1024)

static void sli_traverse_prefetch(const sl_factor *F, sl_int s) {
  const sl_symbolic *S = F->S;
  const sl_off first = S->panel_begin[s], size = S->panel_begin[s + 1] - first;
  const sl_off row = S->rows_begin[s], rows = S->rows_begin[s + 1] - row;
  const size_t entry = F->storage == SL_STORAGE_FLOAT ? sizeof(float) : sizeof(double);
  sl_off k;
  for (k = 0; k < rows && k < SLI_PANEL_AHEAD; k += (sl_off)(SLI_ALIGN / sizeof(sl_int))) {
    SLI_PREFETCH(S->relative + row + k, 0);
  }
  for (k = 0; k < size && k < SLI_PANEL_AHEAD; k += SLI_TILE) {
    SLI_PREFETCH((const char *)F->values + (size_t)(first + k) * entry, 0);
  }
}

static double *sli_traverse_begin(const sli_traversal_run *run, sl_int k, sli_inverse_front *f,
                  sl_int worker) {
  const sl_off room = sli_traverse_scratch(run->traversal, run->F->storage);
  double *scratch = run->scratch + (ptrdiff_t)(room * worker);
  if (run->F->storage == SL_STORAGE_FLOAT) {
    sli_panel_widen(run->F, run->traversal->supers[k], scratch + run->traversal->scratch);
    f->panel = scratch + run->traversal->scratch;
  }
  return scratch;
}

static void sli_traverse_complete(const sli_traversal_run *run, sl_int k, sli_inverse_front *f,
                  sl_int worker) {
  double *scratch = sli_traverse_begin(run, k, f, worker);
  if (k > 0) {
    sli_traverse_prefetch(run->F, run->traversal->supers[k - 1]);
  }
  run->F->kernels->takahashi(f, scratch);
  run->visit(run->context, k, f, 0, sli_tiles(f->width + f->below));
}

static void sli_traverse_tasks(void *data, sl_int k) {
  const sli_traversal_run *run = (const sli_traversal_run *)data;
  const sli_schedule *schedule = &run->traversal->schedule;
  sl_int m, s;
  for (m = 0; m < schedule->n_tasks; m++) {
    for (s = schedule->last[m]; s >= schedule->first[m] && schedule->worker[m] == k; s--) {
      sli_inverse_front f = sli_traverse_front(run, s);
      if (s < schedule->last[m]) {
        sli_traverse_gather(run, s, &f, 0, sli_tiles(f.width + f.below));
      }
      sli_traverse_complete(run, s, &f, k);
    }
  }
}

static void sli_traverse_gather_task_roots(const sli_traversal_run *run, sl_int k, sl_int workers) {
  const sli_schedule *schedule = &run->traversal->schedule;
  const sl_int *low = run->traversal->forest.low;
  sl_int c, top, count = 0;
  for (c = run->at - 1; c >= low[run->at]; c = low[c] - 1) {
    top = sli_lower_bound(schedule->top, schedule->n_tops, c);
    if (schedule->top[top] != c && count++ % workers == k) {
      const sli_inverse_front f = sli_traverse_front(run, c);
      sli_traverse_gather(run, c, &f, 0, sli_tiles(f.width + f.below));
    }
  }
}

static void sli_traverse_gather_range(void *data, sl_int k) {
  const sli_traversal_run *run = (const sli_traversal_run *)data;
  const sl_int workers = run->traversal->schedule.workers, first = run->front.width / SLI_TILE;
  const sl_int tiles = sli_tiles(run->front.width + run->front.below);
  sli_traverse_gather(run, run->at, &run->front,
            sli_tile_range_begin(first, tiles, k, workers, 0),
            sli_tile_range_begin(first, tiles, k + 1, workers, 0));
}

static void sli_traverse_phase_range(void *data, sl_int k) {
  const sli_traversal_run *run = (const sli_traversal_run *)data;
  const sl_int workers = run->traversal->schedule.workers,
         is_square = run->phase == SLI_INVERSE_SQUARE;
  const sli_tile_range all = sli_inverse_tiles(&run->front, run->group, run->phase);
  run->F->kernels->inverse_phase(
    &run->front, run->group, run->phase,
    sli_tile_range_begin(all.first, all.last, k, workers, is_square),
    sli_tile_range_begin(all.first, all.last, k + 1, workers, is_square), run->scratch);
}

static void sli_traverse_visit_range(void *data, sl_int k) {
  const sli_traversal_run *run = (const sli_traversal_run *)data;
  const sl_int workers = run->traversal->schedule.workers;
  const sl_int tiles = sli_tiles(run->front.width + run->front.below);
  run->visit(run->context, run->at, &run->front, sli_tile_range_begin(0, tiles, k, workers, 0),
         sli_tile_range_begin(0, tiles, k + 1, workers, 0));
  sli_traverse_gather_task_roots(run, k, workers);
}

static void sli_traverse_shared(sli_traversal_run *run) {
  const sl_int workers = run->traversal->schedule.workers;
  sl_int phase;
  run->front = sli_traverse_front(run, run->at);
  (void)sli_traverse_begin(run, run->at, &run->front, 0);
  sli_parallel(run->threads, workers, sli_traverse_gather_range, run);
  for (run->group = sli_inverse_last_group(&run->front);
     run->group + SLI_INVERSE_COLUMNS > run->front.first; run->group -= SLI_INVERSE_COLUMNS) {
    for (phase = 0; phase < SLI_INVERSE_PHASES; phase++) {
      run->phase = (sli_inverse_phase)phase;
      sli_parallel(run->threads, workers, sli_traverse_phase_range, run);
    }
  }
  sli_parallel(run->threads, workers, sli_traverse_visit_range, run);
}

static void sli_traverse(sli_traversal_run *run) {
  const sli_schedule *schedule = &run->traversal->schedule;
  sl_int m;
  for (m = schedule->n_tops - 1; m >= 0; m--) {
    run->at = schedule->top[m];
    if (2.0 * sli_front_flops(&run->traversal->S->steps[run->traversal->supers[run->at]]) >=
      SLI_SHARED_FLOPS) {
      sli_traverse_shared(run);
    } else {
      sli_inverse_front f = sli_traverse_front(run, run->at);
      sli_traverse_gather(run, run->at, &f, 0, sli_tiles(f.width + f.below));
      sli_traverse_complete(run, run->at, &f, 0);
      sli_traverse_gather_task_roots(run, 0, 1);
    }
  }
  sli_parallel(run->threads, schedule->workers, sli_traverse_tasks, run);
}

/* src/impl/inverse/row_sets.h: sets of rows of A: checks their range, sorts them by column of L */

static sl_status sli_check_rows(const sl_symbolic *S, const sl_int *rows, sl_int count,
                int is_column, sl_stats *stats) {
  sl_int k;
  for (k = 0; k < count && rows != NULL; k++) {
    if (rows[k] < 0 || rows[k] >= S->n) {
      return sli_fail_at(stats, SL_ERR_ARGUMENT, is_column ? -1 : rows[k],
                 is_column ? rows[k] : -1, 0.0);
    }
  }
  return SL_OK;
}

static sl_status sli_sort_rows(const sl_symbolic *S, const sl_int *rows, sl_int count,
                 uint64_t *seeds, uint64_t *scratch, sl_stats *stats) {
  const sl_status status = sli_check_rows(S, rows, count, 0, stats);
  sl_int k;
  for (k = 0; k < count && status == SL_OK; k++) {
    seeds[k] = sli_keyed(S->iperm[rows[k]], 0);
  }
  if (status == SL_OK) {
    sli_sort(seeds, count, scratch);
  }
  return status;
}

/* src/impl/inverse/unit_vectors.h: forward sweeps of unit vectors, in blocks of up to 8 of similar reach */

#define SLI_LANES_MAX 8
#define SLI_BLOCK_REQUESTS_MAX 64

static const double sli_lanes_cost[][SLI_NRHS_KINDS] = {{1.0, 1.3, 1.9, 3.3},
                             {1.0, 1.2, 3.8, 8.6},
                             {1.0, 1.3, 1.9, 3.3},
                             {1.0, 1.2, 1.9, 2.1}};

SLI_INLINE int sli_isa_row(sl_isa isa) {
  return isa == SL_ISA_SCALAR ? 1 : isa == SL_ISA_AVX2 ? 2 : isa == SL_ISA_AVX512 ? 3 : 0;
}

typedef struct sli_rhs_block {
  sl_int count;
  uint64_t seeds[SLI_LANES_MAX];
  sli_reach size;
} sli_rhs_block;

SLI_INLINE sl_int sli_rhs_block_lane(const sli_rhs_block *block, sl_int column) {
  sl_int at = 0;
  while (at < block->count && sli_key(block->seeds[at]) < column) {
    at++;
  }
  return at;
}

static int sli_rhs_block_add(sli_rhs_block *block, sl_int column, const sl_symbolic *S) {
  const sl_int at = sli_rhs_block_lane(block, column);
  sl_int k;
  if (at < block->count && sli_key(block->seeds[at]) == column) {
    return 1;
  }
  if (block->count == SLI_LANES_MAX) {
    return 0;
  }
  if (S != NULL) {
    sli_reach_add(S, column, at > 0 ? sli_key(block->seeds[at - 1]) : -1,
            at < block->count ? sli_key(block->seeds[at]) : -1, &block->size);
  }
  for (k = block->count++; k > at; k--) {
    block->seeds[k] = block->seeds[k - 1];
  }
  block->seeds[at] = sli_keyed(column, 0);
  return 1;
}

typedef struct sli_requests {
  const sl_symbolic *S;
  const double *lanes_cost;
  const sl_int *rows, *columns;
  sl_int count;
  sl_int n_blocks;
  uint64_t *order;
  uint64_t *block_size;
} sli_requests;

static sli_requests sli_requests_of(const sl_factor *F, const sl_int *rows, const sl_int *columns,
                  sl_int count) {
  sli_requests r;
  memset(&r, 0, sizeof r);
  r.S = F->S;
  r.lanes_cost = sli_lanes_cost[sli_isa_row(F->kernels->isa)];
  r.rows = rows;
  r.columns = columns;
  r.count = count;
  return r;
}

SLI_INLINE sl_int sli_request_row(const sli_requests *r, sl_int k) {
  return r->S->iperm[r->rows == NULL ? k : r->rows[k]];
}

SLI_INLINE sl_int sli_request_column(const sli_requests *r, sl_int k) {
  return r->S->iperm[r->columns == NULL ? k : r->columns[k]];
}

static void sli_requests_layout(sli_requests *r, sli_block *b) {
  r->order = SLI_TAKE(b, uint64_t, r->count);
  r->block_size = SLI_TAKE(b, uint64_t, r->count);
}

SLI_INLINE uint32_t sli_widen_bits(uint32_t a) {
  a = (a | a << 8) & 0x00ff00ffu;
  a = (a | a << 4) & 0x0f0f0f0fu;
  a = (a | a << 2) & 0x33333333u;
  return (a | a << 1) & 0x55555555u;
}

static void sli_requests_sort(sli_requests *r) {
  sl_int k;
  int shift = 0;
  while ((r->S->n - 1) >> shift >= 1 << 15) {
    shift++;
  }
  for (k = 0; k < r->count; k++) {
    const sl_int i = sli_request_row(r, k), j = sli_request_column(r, k);
    const uint32_t high = (uint32_t)(sli_max(i, j) >> shift);
    const uint32_t low = (uint32_t)(sli_min(i, j) >> shift);
    const sl_int key =
      r->rows == r->columns ? i : (sl_int)(sli_widen_bits(high) << 1 | sli_widen_bits(low));
    r->order[k] = sli_keyed(key, k);
  }
  sli_sort(r->order, r->count, r->block_size);
}

SLI_INLINE int sli_rhs_block_add_request(sli_rhs_block *block, const sli_requests *r, sl_int k,
                     const sl_symbolic *S) {
  const sl_int at = sli_value(r->order[k]);
  return sli_rhs_block_add(block, sli_request_row(r, at), S) &&
       sli_rhs_block_add(block, sli_request_column(r, at), S);
}

static sl_int sli_rhs_block_choose(const sli_requests *r, sl_int k, sli_rhs_block *best) {
  const sl_int from = k;
  double least = 0.0;
  sl_int block_size = 0;
  sli_rhs_block block;
  memset(&block, 0, sizeof block);
  *best = block;
  for (; k < r->count && k - from < SLI_BLOCK_REQUESTS_MAX &&
       sli_rhs_block_add_request(&block, r, k, r->S);
     k++) {
    const double time = r->lanes_cost[sli_lanes_kind(block.count)] *
              (double)block.size.entries / (double)(k - from + 1);
    if (block_size == 0 || time <= least) {
      least = time;
      block_size = k - from + 1;
      *best = block;
    }
  }
  return block_size;
}

static void sli_rhs_block_rebuild(const sli_requests *r, sl_int k, sl_int block_size,
                  sli_rhs_block *block) {
  memset(block, 0, sizeof *block);
  for (; block_size > 0; block_size--, k++) {
    (void)sli_rhs_block_add_request(block, r, k, NULL);
  }
}

typedef struct sli_capacity {
  uint64_t steps, rows, values, scratch;
} sli_capacity;

static void sli_capacity_add(sli_capacity *capacity, const sli_reach *R, sl_int lanes) {
  const uint64_t steps = (uint64_t)R->count, rows = (uint64_t)R->n_rows;
  const uint64_t values = (uint64_t)R->columns * (uint64_t)lanes;
  const uint64_t scratch = sli_sweep_scratch(R->tallest, R->widest, lanes);
  capacity->steps = steps > capacity->steps ? steps : capacity->steps;
  capacity->rows = rows > capacity->rows ? rows : capacity->rows;
  capacity->values = values > capacity->values ? values : capacity->values;
  capacity->scratch = scratch > capacity->scratch ? scratch : capacity->scratch;
}

static double sli_requests_partition_within(sli_requests *r, sli_capacity *capacity, double limit) {
  double time = 0.0;
  sl_int k = 0;
  sli_requests_sort(r);
  for (r->n_blocks = 0; k < r->count && time < limit; r->n_blocks++) {
    sli_rhs_block block;
    const sl_int block_size = sli_rhs_block_choose(r, k, &block);
    const int kind = sli_lanes_kind(block.count);
    sli_capacity_add(capacity, &block.size, (sl_int)1 << kind);
    time += r->lanes_cost[kind] * (double)block.size.entries;
    r->block_size[r->n_blocks] = (uint64_t)block_size;
    k += block_size;
  }
  return time;
}

static void sli_requests_partition(sli_requests *r, sli_capacity *capacity) {
  (void)sli_requests_partition_within(r, capacity, HUGE_VAL);
}

typedef struct sli_forward {
  sli_reach reach;
  int kind;
  sl_int lanes;
  sli_step *steps;
  double *y;
  sl_int *rows;
  double *scratch;
} sli_forward;

static void sli_forward_layout(sli_forward *f, sli_block *b, const sli_capacity *capacity) {
  f->steps = SLI_TAKE(b, sli_step, capacity->steps);
  f->y = SLI_TAKE(b, double, capacity->values);
}

static void sli_forward_layout_run(sli_forward *f, sli_block *b, const sli_capacity *capacity) {
  f->rows = SLI_TAKE(b, sl_int, capacity->rows);
  f->scratch = SLI_TAKE(b, double, capacity->scratch);
}

static void sli_forward_clear(sli_forward *f, sl_int vectors) {
  f->kind = sli_lanes_kind(vectors);
  f->lanes = (sl_int)1 << f->kind;
  memset(f->y, 0, (size_t)f->reach.columns * (size_t)f->lanes * sizeof(double));
}

static void sli_forward_run(sli_forward *f, const sl_factor *F, sl_stats *stats) {
  sli_forward_sweep(F, f->kind, f->reach.count, f->reach.steps, f->reach.rows, f->y, f->scratch);
  if (stats != NULL) {
    stats->inverse.method = SL_INVERSE_FORWARD;
    stats->inverse.supernodes = sli_max(stats->inverse.supernodes, f->reach.count);
    stats->inverse.columns = sli_max(stats->inverse.columns, f->reach.columns);
    stats->inverse.entries += f->reach.entries;
  }
}

static void sli_forward_unit_vectors(sli_forward *f, const sl_factor *F, const sli_rhs_block *block,
                   sl_stats *stats) {
  sl_int k, at = 0;
  sli_reach_fill(F->S, block->seeds, block->count, f->steps, f->rows, &f->reach);
  sli_forward_clear(f, block->count);
  for (k = 0; k < block->count; k++) {
    const sl_int row = sli_reach_index(&f->reach, &at, sli_key(block->seeds[k]));
    f->y[(ptrdiff_t)row * f->lanes + k] = 1.0;
  }
  sli_forward_run(f, F, stats);
}

/* src/impl/inverse/bilinear.h: bilinear forms c' A^-1 b: a forward sweep, then a sum over columns weighted by 1/D */

SLI_ALWAYS_INLINE void sli_divide_lanes(double *z, const double *y, double d, sl_int lanes) {
  const double inverse = 1.0 / d, size = fabs(inverse);
  sl_int k;
  if (size >= DBL_MIN && size <= DBL_MAX) {
    for (k = 0; k < lanes; k++) {
      z[k] = y[k] * inverse;
    }
  } else {
    for (k = 0; k < lanes; k++) {
      z[k] = y[k] / d;
    }
  }
}

static void sli_pair_sums(const sl_factor *F, const sli_forward *f, sl_int count,
              const sl_int *first, const sl_int *second, double *sums) {
  sl_int s, k, m;
  for (m = 0; m < count; m++) {
    sums[m] = 0.0;
  }
  for (s = 0; s < f->reach.count; s++) {
    const sli_step *step = &f->reach.steps[s];
    const double *d = F->D + step->column, *y = f->y + (ptrdiff_t)step->base * f->lanes;
    for (k = 0; k < sli_step_columns(step); k++, y += f->lanes) {
      double z[SLI_LANES_MAX];
      sli_divide_lanes(z, y, d[k], f->lanes);
      for (m = 0; m < count; m++) {
        sums[m] += z[first[m]] * y[second[m]];
      }
    }
  }
}

static void sli_inverse_clear_stats(sl_stats *stats) {
  if (stats != NULL) {
    memset(&stats->inverse, 0, sizeof stats->inverse);
  }
}

typedef struct sli_bilinear {
  const sl_factor *F;
  const sl_int *set[2];
  const double *values[2];
  sl_int count[2];
  sl_int vectors;
  uint64_t *seeds, *scratch;
  sli_forward forward;
} sli_bilinear;

SLI_INLINE int sli_bilinear_is_dense(const sli_bilinear *q) {
  return q->set[0] == NULL || q->set[1] == NULL;
}

static void sli_bilinear_layout_seeds(void *form, sli_block *b) {
  sli_bilinear *q = (sli_bilinear *)form;
  const uint64_t count =
    sli_bilinear_is_dense(q) ? 0 : (uint64_t)q->count[0] + (uint64_t)q->count[1];
  q->seeds = SLI_TAKE(b, uint64_t, count);
  q->scratch = SLI_TAKE(b, uint64_t, count);
}

static void sli_bilinear_measure(void *form) {
  sli_bilinear *q = (sli_bilinear *)form;
  const sl_symbolic *S = q->F->S;
  const sl_int nc = q->count[0], total = nc + (q->vectors == 2 ? q->count[1] : 0);
  sl_int k;
  if (sli_bilinear_is_dense(q)) {
    q->forward.reach = sli_reach_all(S);
    return;
  }
  for (k = 0; k < total; k++) {
    q->seeds[k] = sli_keyed(S->iperm[k < nc ? q->set[0][k] : q->set[1][k - nc]], k);
  }
  sli_sort(q->seeds, total, q->scratch);
  sli_reach_measure(S, q->seeds, total, &q->forward.reach);
}

static void sli_bilinear_layout_sweep(void *form, sli_block *b) {
  sli_bilinear *q = (sli_bilinear *)form;
  sli_capacity capacity = {0, 0, 0, 0};
  sli_capacity_add(&capacity, &q->forward.reach, q->vectors);
  if (sli_bilinear_is_dense(q)) {
    capacity.steps = capacity.rows = 0;
  }
  sli_forward_layout(&q->forward, b, &capacity);
  sli_forward_layout_run(&q->forward, b, &capacity);
}

static void sli_bilinear_pack(sli_bilinear *q) {
  const sl_symbolic *S = q->F->S;
  sli_forward *f = &q->forward;
  const sl_int nc = q->count[0], total = nc + (q->vectors == 2 ? q->count[1] : 0);
  sl_int k, lane, at = 0;
  if (!sli_bilinear_is_dense(q)) {
    sli_reach_fill(S, q->seeds, total, f->steps, f->rows, &f->reach);
    sli_forward_clear(f, q->vectors);
    for (k = 0; k < total; k++) {
      const sl_int row = sli_reach_index(&f->reach, &at, sli_key(q->seeds[k]));
      const sl_int from = sli_value(q->seeds[k]);
      lane = from >= nc;
      f->y[(ptrdiff_t)row * f->lanes + lane] += q->values[lane][from - lane * nc];
    }
    return;
  }
  f->reach = sli_reach_all(S);
  sli_forward_clear(f, q->vectors);
  for (lane = 0; lane < q->vectors; lane++) {
    for (k = 0; k < q->count[lane]; k++) {
      const sl_int row = q->set[lane] == NULL ? k : q->set[lane][k];
      f->y[(ptrdiff_t)S->iperm[row] * f->lanes + lane] += q->values[lane][k];
    }
  }
}

static const sli_stage sli_bilinear_stages[2] = {{sli_bilinear_layout_seeds, sli_bilinear_measure},
                         {sli_bilinear_layout_sweep, NULL}};

static sl_status sli_bilinear_run(sli_bilinear *q, double *out, sl_work *W, sl_stats *stats) {
  const sl_int first = 0, second = q->vectors - 1;
  const sl_status status = sli_work_stages(W, sli_bilinear_stages, 2, q);
  if (status == SL_OK) {
    sli_bilinear_pack(q);
    sli_forward_run(&q->forward, q->F, stats);
    sli_pair_sums(q->F, &q->forward, 1, &first, &second, out);
  }
  return status;
}

SL_API sl_status sl_inverse_bilinear(const sl_factor *F, double *out, const sl_int *bset,
                   const double *b, sl_int nb, const sl_int *cset,
                   const double *c, sl_int nc, sl_work *W, sl_stats *stats) {
  sl_work own;
  sli_bilinear q;
  sl_status status;
  sli_stats_clear_error(stats);
  if (F == NULL || out == NULL) {
    return SL_ERR_ARGUMENT;
  }
  nc = cset == NULL ? F->S->n : nc;
  nb = bset == NULL ? F->S->n : nb;
  if (nc < 0 || nb < 0 || (nc > 0 && c == NULL) || (nb > 0 && b == NULL)) {
    return SL_ERR_ARGUMENT;
  }
  status = sli_inverse_check(F);
  if (status != SL_OK) {
    return status;
  }
  if (cset != NULL && bset != NULL && nc > INT32_MAX - nb) {
    return SL_ERR_TOO_LARGE;
  }
  status = sli_check_rows(F->S, cset, nc, 0, stats);
  status = status == SL_OK ? sli_check_rows(F->S, bset, nb, 1, stats) : status;
  if (status != SL_OK) {
    return status;
  }
  sli_inverse_clear_stats(stats);
  if (nc == 0 || nb == 0) {
    *out = 0.0;
    return SL_OK;
  }
  memset(&q, 0, sizeof q);
  q.F = F;
  q.set[0] = cset;
  q.set[1] = bset;
  q.values[0] = c;
  q.values[1] = b;
  q.count[0] = nc;
  q.count[1] = nb;
  q.vectors = cset == bset && c == b && nc == nb ? 1 : 2;
  own = sli_work_own(&F->allocator);
  status = sli_bilinear_run(&q, out, W == NULL ? &own : W, stats);
  sli_free(&own.allocator, own.block);
  return status;
}

/* src/impl/inverse/entries.h: entries of A^-1: by forward sweeps or a top-down traversal, whichever is faster */

typedef struct sli_entries {
  const sl_factor *F;
  const sl_threads *threads;
  double *out;
  sli_requests requests;
  sl_inverse_method method;
  sli_capacity capacity;
  sli_forward forward;
  sli_traversal traversal;
  sli_traversal_run run;
  sl_int *first_request;
} sli_entries;

static const double sli_traversal_cost[][3] = {{2000.0, 4.0, 0.35},
                         {2000.0, 4.0, 2.2},
                         {2000.0, 4.0, 0.35},
                         {2000.0, 4.0, 0.2}};

SLI_INLINE int sli_entries_is_all(const sli_entries *q) {
  return q->requests.rows == NULL;
}

SLI_INLINE sl_int sli_entries_column(const sli_entries *q, sl_int k) {
  return sli_min(sli_request_row(&q->requests, k), sli_request_column(&q->requests, k));
}

SLI_INLINE sl_int sli_entries_row(const sli_entries *q, sl_int s, sl_int k) {
  const sl_int row =
    sli_max(sli_request_row(&q->requests, k), sli_request_column(&q->requests, k));
  return sli_front_row(q->F->S, s, row);
}

static void sli_entries_sort(sli_entries *q) {
  sli_requests *r = &q->requests;
  sl_int k;
  for (k = 0; k < r->count; k++) {
    r->order[k] = sli_keyed(sli_entries_column(q, k), k);
  }
  sli_sort(r->order, r->count, r->block_size);
}

static int sli_entries_are_in_pattern(const sli_entries *q) {
  const sli_requests *r = &q->requests;
  sl_int k, is_in = 1;
  for (k = 0; k < r->count && is_in && r->rows != r->columns; k++) {
    is_in = sli_entries_row(q, q->F->S->super_of[sli_entries_column(q, k)], k) != -1;
  }
  return is_in;
}

static double sli_traversal_time(const sli_entries *q, sl_int *supers) {
  const sl_symbolic *S = q->F->S;
  const sli_requests *r = &q->requests;
  const double *cost = sli_traversal_cost[sli_isa_row(q->F->kernels->isa)];
  double time = 0.0;
  sl_int k = 0, s, next;
  *supers = 0;
  while (k < r->count) {
    s = S->super_of[sli_key(r->order[k])];
    next = sli_next_seed(S, r->order, r->count, &k);
    for (; s != -1 && s < next; s = S->super_parent[s]) {
      const double h = S->steps[s].width + S->steps[s].below;
      time += cost[0] + cost[1] * h * h + cost[2] * sli_front_flops(&S->steps[s]);
      ++*supers;
    }
  }
  return time;
}

static void sli_entries_choose(void *call) {
  sli_entries *q = (sli_entries *)call;
  double limit = HUGE_VAL;
  sl_int supers = q->F->S->n_supers;
  memset(&q->capacity, 0, sizeof q->capacity);
  if (sli_entries_is_all(q)) {
    q->method = SL_INVERSE_SELECTED;
  } else {
    if (q->requests.count > 1 && sli_entries_are_in_pattern(q)) {
      sli_entries_sort(q);
      limit = sli_traversal_time(q, &supers);
    }
    q->method = sli_requests_partition_within(&q->requests, &q->capacity, limit) < limit
            ? SL_INVERSE_FORWARD
            : SL_INVERSE_SELECTED;
  }
  if (q->method == SL_INVERSE_SELECTED) {
    q->traversal = sli_traversal_of(q->F->S, supers, sli_workers(q->threads));
    q->traversal.is_partial = !sli_entries_is_all(q);
  }
}

static void sli_entries_layout_requests(void *call, sli_block *b) {
  sli_entries *q = (sli_entries *)call;
  if (!sli_entries_is_all(q)) {
    sli_requests_layout(&q->requests, b);
  }
}

static void sli_entries_layout_method(void *call, sli_block *b) {
  sli_entries *q = (sli_entries *)call;
  if (q->method == SL_INVERSE_FORWARD) {
    sli_forward_layout(&q->forward, b, &q->capacity);
    sli_forward_layout_run(&q->forward, b, &q->capacity);
  } else {
    sli_traversal_layout(&q->traversal, b);
    sli_traversal_layout_work(&q->traversal, b);
    q->first_request = SLI_TAKE(
      b, sl_int, sli_entries_is_all(q) ? 0 : (uint64_t)q->traversal.forest.count + 1);
  }
}

static void sli_entries_plan(void *call) {
  sli_entries *q = (sli_entries *)call;
  const sli_requests *r = &q->requests;
  const int is_all = sli_entries_is_all(q);
  sl_int k = 0, index;
  if (q->method != SL_INVERSE_SELECTED) {
    return;
  }
  if (!is_all) {
    sli_entries_sort(q);
  }
  sli_traversal_plan(&q->traversal, is_all ? NULL : r->order, r->count);
  for (index = 0; index < q->traversal.forest.count && !is_all; index++) {
    const sl_int end = q->F->S->super_first[q->traversal.supers[index] + 1];
    q->first_request[index] = k;
    while (k < r->count && sli_key(r->order[k]) < end) {
      k++;
    }
  }
  if (!is_all) {
    q->first_request[index] = k;
  }
}

static void sli_entries_layout_run(void *call, sli_block *b) {
  sli_entries *q = (sli_entries *)call;
  if (q->method == SL_INVERSE_SELECTED) {
    sli_traversal_layout_run(&q->run, &q->traversal, q->F->storage, b);
  }
}

static void sli_entries_visit(void *call, sl_int index, const sli_inverse_front *f, sl_int t0,
                sl_int t1) {
  const sli_entries *q = (const sli_entries *)call;
  const sl_symbolic *S = q->F->S;
  const sl_int s = q->traversal.supers[index], first = S->super_first[s], h = f->width + f->below;
  sl_int k, j;
  if (sli_entries_is_all(q)) {
    const sl_int *row = S->perm + first, last = sli_min(SLI_TILE * t1, f->width);
    for (j = SLI_TILE * t0; j < last; j++) {
      q->out[row[j]] = f->front[sli_square_offset(h, j / SLI_TILE) + SLI_TILE * (ptrdiff_t)j +
                    j % SLI_TILE];
    }
    return;
  }
  for (k = q->first_request[index]; k < q->first_request[index + 1]; k++) {
    const sl_int request = sli_value(q->requests.order[k]);
    const sl_int r = sli_entries_row(q, s, request), t = r / SLI_TILE;
    if (t >= t0 && t < t1) {
      j = sli_key(q->requests.order[k]) - first;
      q->out[request] =
        f->front[sli_square_offset(h, t) + SLI_TILE * (ptrdiff_t)j + r % SLI_TILE];
    }
  }
}

static void sli_entries_write(const sli_entries *q, const sli_rhs_block *block, sl_int k,
                sl_int block_size) {
  sl_int first[SLI_BLOCK_REQUESTS_MAX], second[SLI_BLOCK_REQUESTS_MAX], m;
  double sums[SLI_BLOCK_REQUESTS_MAX];
  for (m = 0; m < block_size; m++) {
    const sl_int index = sli_value(q->requests.order[k + m]);
    first[m] = sli_rhs_block_lane(block, sli_request_row(&q->requests, index));
    second[m] = sli_rhs_block_lane(block, sli_request_column(&q->requests, index));
  }
  sli_pair_sums(q->F, &q->forward, block_size, first, second, sums);
  for (m = 0; m < block_size; m++) {
    q->out[sli_value(q->requests.order[k + m])] = sums[m];
  }
}

static void sli_entries_forward(sli_entries *q, sl_stats *stats) {
  sl_int k = 0, m;
  for (m = 0; m < q->requests.n_blocks; m++) {
    const sl_int block_size = (sl_int)q->requests.block_size[m];
    sli_rhs_block block;
    sli_rhs_block_rebuild(&q->requests, k, block_size, &block);
    sli_forward_unit_vectors(&q->forward, q->F, &block, stats);
    sli_entries_write(q, &block, k, block_size);
    k += block_size;
  }
}

static sli_entries sli_entries_of(const sl_factor *F, double *out, const sl_int *rows,
                  const sl_int *columns, sl_int count) {
  sli_entries q;
  memset(&q, 0, sizeof q);
  q.F = F;
  q.threads = &F->threads;
  q.out = out;
  q.requests = sli_requests_of(F, rows, columns, count);
  return q;
}

static const sli_stage sli_entries_stages[3] = {{sli_entries_layout_requests, sli_entries_choose},
                        {sli_entries_layout_method, sli_entries_plan},
                        {sli_entries_layout_run, NULL}};

static sl_status sli_entries_prepare(sli_entries *q, sl_work *W) {
  return sli_work_stages(W, sli_entries_stages, 3, q);
}

static sl_status sli_entries_run(sli_entries *q, sl_work *W, sl_stats *stats) {
  const sl_status status = sli_entries_prepare(q, W);
  if (status != SL_OK) {
    return status;
  }
  if (q->method == SL_INVERSE_FORWARD) {
    sli_entries_forward(q, stats);
  } else {
    q->run.F = q->F;
    q->run.traversal = &q->traversal;
    q->run.threads = q->threads;
    q->run.visit = sli_entries_visit;
    q->run.context = q;
    sli_traverse(&q->run);
  }
  if (stats != NULL && q->method == SL_INVERSE_SELECTED) {
    stats->inverse.method = SL_INVERSE_SELECTED;
    stats->inverse.supernodes = q->traversal.forest.count;
    stats->inverse.columns = sli_traversal_count_columns(&q->traversal);
  }
  return SL_OK;
}

static sl_status sli_inverse_entries(const sl_factor *F, double *out, const sl_int *rows,
                   const sl_int *columns, sl_int count, sl_work *W,
                   sl_stats *stats) {
  sl_work own;
  sli_entries q;
  sl_status status;
  if (count < 0 || (count > 0 && out == NULL)) {
    return SL_ERR_ARGUMENT;
  }
  status = sli_inverse_check(F);
  if (status != SL_OK) {
    return status;
  }
  status = sli_check_rows(F->S, rows, count, 0, stats);
  status = status == SL_OK ? sli_check_rows(F->S, columns, count, 1, stats) : status;
  if (status != SL_OK) {
    return status;
  }
  sli_inverse_clear_stats(stats);
  q = sli_entries_of(F, out, rows, columns, count);
  own = sli_work_own(&F->allocator);
  status = count > 0 ? sli_entries_run(&q, W == NULL ? &own : W, stats) : SL_OK;
  sli_free(&own.allocator, own.block);
  return status;
}

SL_API sl_status sl_inverse_diagonal(const sl_factor *F, double *out, const sl_int *rows,
                   sl_int count, sl_work *W, sl_stats *stats) {
  sli_stats_clear_error(stats);
  return F == NULL
         ? SL_ERR_ARGUMENT
         : sli_inverse_entries(F, out, rows, rows, rows == NULL ? F->S->n : count, W, stats);
}

SL_API sl_status sl_inverse_pairs(const sl_factor *F, double *out, const sl_int *rows,
                  const sl_int *columns, sl_int count, sl_work *W,
                  sl_stats *stats) {
  sli_stats_clear_error(stats);
  return F == NULL || (count > 0 && (rows == NULL || columns == NULL))
         ? SL_ERR_ARGUMENT
         : sli_inverse_entries(F, out, rows, columns, count, W, stats);
}

/* src/impl/inverse/block.h: dense blocks of A^-1: forward sweeps of all rows and columns, sums between sweeps */

#define SLI_BLOCK_KEPT 16

static void sli_forward_divide(const sl_factor *F, const sli_forward *f, double *z) {
  sl_int s, k;
  for (s = 0; s < f->reach.count; s++) {
    const sli_step *step = &f->reach.steps[s];
    const double *d = F->D + step->column;
    for (k = 0; k < sli_step_columns(step); k++) {
      const ptrdiff_t at = (ptrdiff_t)(step->base + k) * f->lanes;
      sli_divide_lanes(z + at, f->y + at, d[k], f->lanes);
    }
  }
}

static void sli_cross_sums(const sl_factor *F, const sli_forward *f, const sli_forward *g,
               const double *z, double *sums) {
  sli_intersection m = sli_intersection_of(&f->reach, &g->reach);
  sl_int k, i, j;
  memset(sums, 0, SLI_LANES_MAX * SLI_LANES_MAX * sizeof(double));
  while (sli_intersection_next(&m)) {
    const double *y = f->y + (ptrdiff_t)m.in_a * f->lanes;
    const double *x = z + (ptrdiff_t)m.in_b * g->lanes;
    if (f->lanes == SLI_LANES_MAX && g->lanes == SLI_LANES_MAX) {
      F->kernels->products(m.count, y, x, sums);
      continue;
    }
    for (k = 0; k < m.count; k++, y += f->lanes, x += g->lanes) {
      for (i = 0; i < f->lanes; i++) {
        for (j = 0; j < g->lanes; j++) {
          sums[SLI_LANES_MAX * i + j] -= y[i] * x[j];
        }
      }
    }
  }
  for (k = 0; k < SLI_LANES_MAX * SLI_LANES_MAX; k++) {
    sums[k] = -sums[k];
  }
}

typedef struct sli_swept_block {
  sli_rhs_block block;
  sli_forward forward;
  sl_int first, block_size;
} sli_swept_block;

typedef struct sli_inverse_block {
  const sl_factor *F;
  double *Z;
  size_t kept_stride, streamed_stride;
  void (*write)(void *context, sl_int row, sl_int column, double z);
  void *context;
  int is_symmetric;
  sli_requests kept, streamed;
  sli_swept_block sweeps[SLI_BLOCK_KEPT], stream;
  double *divided;
  sli_capacity kept_capacity, streamed_capacity;
} sli_inverse_block;

static void sli_inverse_block_layout_requests(void *block, sli_block *b) {
  sli_inverse_block *q = (sli_inverse_block *)block;
  sli_requests_layout(&q->kept, b);
  if (!q->is_symmetric) {
    sli_requests_layout(&q->streamed, b);
  }
}

static void sli_inverse_block_partition(void *block) {
  sli_inverse_block *q = (sli_inverse_block *)block;
  memset(&q->kept_capacity, 0, sizeof q->kept_capacity);
  memset(&q->streamed_capacity, 0, sizeof q->streamed_capacity);
  sli_requests_partition(&q->kept, &q->kept_capacity);
  if (!q->is_symmetric) {
    sli_requests_partition(&q->streamed, &q->streamed_capacity);
  } else if (q->kept.n_blocks > SLI_BLOCK_KEPT) {
    q->streamed_capacity = q->kept_capacity;
  }
}

static void sli_inverse_block_layout_sweeps(void *block, sli_block *b) {
  sli_inverse_block *q = (sli_inverse_block *)block;
  const sli_capacity *kept = &q->kept_capacity, *streamed = &q->streamed_capacity;
  const sl_int count = sli_min(q->kept.n_blocks, SLI_BLOCK_KEPT);
  sli_capacity both = *kept;
  sl_int k;
  both.rows = streamed->rows > both.rows ? streamed->rows : both.rows;
  both.scratch = streamed->scratch > both.scratch ? streamed->scratch : both.scratch;
  q->divided =
    SLI_TAKE(b, double, streamed->values > kept->values ? streamed->values : kept->values);
  sli_forward_layout(&q->stream.forward, b, streamed);
  sli_forward_layout_run(&q->stream.forward, b, &both);
  for (k = 0; k < count; k++) {
    sli_forward_layout(&q->sweeps[k].forward, b, kept);
    q->sweeps[k].forward.rows = q->stream.forward.rows;
    q->sweeps[k].forward.scratch = q->stream.forward.scratch;
  }
}

static void sli_swept_block_make(sli_swept_block *s, const sl_factor *F, const sli_requests *r,
                 sl_int k, sl_int block_size, sl_stats *stats) {
  s->first = k;
  s->block_size = block_size;
  sli_rhs_block_rebuild(r, k, block_size, &s->block);
  sli_forward_unit_vectors(&s->forward, F, &s->block, stats);
}

static void sli_inverse_block_write(const sli_inverse_block *q, const sli_swept_block *a,
                  const sli_swept_block *b) {
  const sli_requests *streamed = q->is_symmetric ? &q->kept : &q->streamed;
  SLI_ALIGNED(double sums[SLI_LANES_MAX * SLI_LANES_MAX]);
  sl_int i, j;
  sli_cross_sums(q->F, &a->forward, &b->forward, q->divided, sums);
  for (i = 0; i < a->block_size; i++) {
    const sl_int from = sli_value(q->kept.order[a->first + i]);
    const sl_int lane = sli_rhs_block_lane(&a->block, sli_request_row(&q->kept, from));
    for (j = 0; j < b->block_size; j++) {
      const sl_int context = sli_value(streamed->order[b->first + j]);
      const sl_int other = sli_rhs_block_lane(&b->block, sli_request_row(streamed, context));
      const sl_int low = a == b ? sli_min(lane, other) : lane;
      const sl_int high = a == b ? sli_max(lane, other) : other;
      const double sum = sums[SLI_LANES_MAX * low + high];
      if (q->write != NULL) {
        q->write(q->context, from, context, sum);
        continue;
      }
      q->Z[(size_t)from * q->kept_stride + (size_t)context * q->streamed_stride] = sum;
      if (q->is_symmetric) {
        q->Z[(size_t)context * q->kept_stride + (size_t)from * q->streamed_stride] = sum;
      }
    }
  }
}

static void sli_inverse_block_fill(sli_inverse_block *q, sl_stats *stats) {
  const sli_requests *streamed = q->is_symmetric ? &q->kept : &q->streamed;
  sl_int chunk, first = 0, k, m;
  for (chunk = 0; chunk < q->kept.n_blocks; chunk += SLI_BLOCK_KEPT) {
    const sl_int count = sli_min(SLI_BLOCK_KEPT, q->kept.n_blocks - chunk);
    sl_int at = 0;
    for (k = 0; k < count; k++) {
      const sl_int block_size = (sl_int)q->kept.block_size[chunk + k];
      sli_swept_block_make(&q->sweeps[k], q->F, &q->kept, first, block_size, stats);
      first += block_size;
    }
    for (k = 0; q->is_symmetric && k < count; k++) {
      sli_forward_divide(q->F, &q->sweeps[k].forward, q->divided);
      for (m = 0; m <= k; m++) {
        sli_inverse_block_write(q, &q->sweeps[m], &q->sweeps[k]);
      }
    }
    at = q->is_symmetric ? first : 0;
    for (k = q->is_symmetric ? chunk + count : 0; k < streamed->n_blocks; k++) {
      const sl_int block_size = (sl_int)streamed->block_size[k];
      sli_swept_block_make(&q->stream, q->F, streamed, at, block_size, stats);
      sli_forward_divide(q->F, &q->stream.forward, q->divided);
      for (m = 0; m < count; m++) {
        sli_inverse_block_write(q, &q->sweeps[m], &q->stream);
      }
      at += block_size;
    }
  }
}

static const sli_stage sli_inverse_block_stages[2] = {
  {sli_inverse_block_layout_requests, sli_inverse_block_partition},
  {sli_inverse_block_layout_sweeps, NULL}};

static sl_status sli_inverse_block_run(sli_inverse_block *q, sl_work *W, sl_stats *stats) {
  const sl_status status = sli_work_stages(W, sli_inverse_block_stages, 2, q);
  if (status == SL_OK) {
    sli_inverse_block_fill(q, stats);
  }
  return status;
}

static sli_inverse_block sli_inverse_all_pairs_of(const sl_factor *F, const sl_int *rows,
                          sl_int count) {
  sli_inverse_block q;
  memset(&q, 0, sizeof q);
  q.F = F;
  q.is_symmetric = 1;
  q.kept = q.streamed = sli_requests_of(F, rows, rows, count);
  return q;
}

static sl_status sli_inverse_all_pairs(const sl_factor *F, const sl_int *rows, sl_int count,
                     void (*write)(void *context, sl_int row, sl_int column,
                           double z),
                     void *context, sl_work *W) {
  sli_inverse_block q = sli_inverse_all_pairs_of(F, rows, count);
  q.write = write;
  q.context = context;
  return count == 0 ? SL_OK : sli_inverse_block_run(&q, W, NULL);
}

static sl_status sli_inverse_all_pairs_prepare(const sl_factor *F, const sl_int *rows, sl_int count,
                         sl_work *W) {
  sli_inverse_block q = sli_inverse_all_pairs_of(F, rows, count);
  return count == 0 ? SL_OK : sli_work_stages(W, sli_inverse_block_stages, 2, &q);
}

SL_API sl_status sl_inverse_block(const sl_factor *F, double *Z, size_t ldz, const sl_int *rows,
                  sl_int n_rows, const sl_int *columns, sl_int n_columns,
                  sl_work *W, sl_stats *stats) {
  const int rows_are_streamed = n_rows > n_columns, is_empty = n_rows == 0 || n_columns == 0;
  sl_work own;
  sli_inverse_block q;
  sl_status status;
  sli_stats_clear_error(stats);
  if (F == NULL || n_rows < 0 || n_columns < 0 || (n_rows > 0 && rows == NULL) ||
    (n_columns > 0 && columns == NULL) || (!is_empty && (Z == NULL || ldz < (size_t)n_rows))) {
    return SL_ERR_ARGUMENT;
  }
  status = sli_inverse_check(F);
  if (status != SL_OK) {
    return status;
  }
  status = sli_check_rows(F->S, rows, n_rows, 0, stats);
  status = status == SL_OK ? sli_check_rows(F->S, columns, n_columns, 1, stats) : status;
  if (status != SL_OK) {
    return status;
  }
  sli_inverse_clear_stats(stats);
  memset(&q, 0, sizeof q);
  q.F = F;
  q.Z = Z;
  q.is_symmetric = rows == columns && n_rows == n_columns;
  q.kept = rows_are_streamed ? sli_requests_of(F, columns, columns, n_columns)
                 : sli_requests_of(F, rows, rows, n_rows);
  q.streamed = rows_are_streamed ? sli_requests_of(F, rows, rows, n_rows)
                   : sli_requests_of(F, columns, columns, n_columns);
  q.kept_stride = rows_are_streamed ? ldz : 1;
  q.streamed_stride = rows_are_streamed ? 1 : ldz;
  own = sli_work_own(&F->allocator);
  status = is_empty ? SL_OK : sli_inverse_block_run(&q, W == NULL ? &own : W, stats);
  sli_free(&own.allocator, own.block);
  return status;
}

/* src/impl/inverse/reserve.h: bounds on the workspace of the inverse calls, for any rows */

typedef struct sli_reserve {
  const sl_symbolic *S;
  sl_int workers;
  sl_storage storage;
  uint64_t steps, columns, rows;
  sl_off stack;
  sl_off roots;
  sl_off front;
  sl_off scratch;
  sli_traversal all;
  uint64_t *path_steps, *path_columns, *path_rows;
  sl_off *below;
} sli_reserve;

static void sli_reserve_layout(void *bounds, sli_block *b) {
  sli_reserve *r = (sli_reserve *)bounds;
  const sl_int count = r->S->n_supers;
  sli_traversal_layout(&r->all, b);
  r->path_steps = SLI_TAKE(b, uint64_t, count);
  r->path_columns = SLI_TAKE(b, uint64_t, count);
  r->path_rows = SLI_TAKE(b, uint64_t, count);
  r->below = SLI_TAKE(b, sl_off, count);
}

static void sli_reserve_measure_paths(sli_reserve *r) {
  const sl_symbolic *S = r->S;
  sl_int s;
  for (s = S->n_supers - 1; s >= 0; s--) {
    const sl_int up = S->super_parent[s];
    r->path_steps[s] = 1 + (up == -1 ? 0 : r->path_steps[up]);
    r->path_columns[s] = (uint64_t)S->steps[s].width + (up == -1 ? 0 : r->path_columns[up]);
    r->path_rows[s] = (uint64_t)S->steps[s].below + (up == -1 ? 0 : r->path_rows[up]);
    r->steps = r->path_steps[s] > r->steps ? r->path_steps[s] : r->steps;
    r->columns = r->path_columns[s] > r->columns ? r->path_columns[s] : r->columns;
    r->rows = r->path_rows[s] > r->rows ? r->path_rows[s] : r->rows;
  }
}

static void sli_reserve_measure_fronts(sli_reserve *r) {
  const sl_symbolic *S = r->S;
  sl_int s;
  sli_traversal_plan(&r->all, NULL, 0);
  r->stack = sli_traversal_fronts_size(&r->all);
  r->scratch = sli_traverse_scratch(&r->all, r->storage);
  for (s = 0; s < S->n_supers; s++) {
    r->below[s] = 0;
  }
  for (s = 0; s < S->n_supers; s++) {
    const sl_off own = sli_traversal_front_size(&r->all, s);
    const sl_off most = own > r->below[s] ? own : r->below[s];
    r->front = own > r->front ? own : r->front;
    *(S->super_parent[s] == -1 ? &r->roots : &r->below[S->super_parent[s]]) += most;
  }
}

static void sli_reserve_measure(void *bounds) {
  sli_reserve *r = (sli_reserve *)bounds;
  r->steps = r->columns = r->rows = 0;
  r->roots = r->front = 0;
  sli_reserve_measure_paths(r);
  sli_reserve_measure_fronts(r);
}

static sl_status sli_reserve_of(sli_reserve *r, const sl_factor *F, sl_work *W) {
  static const sli_stage stage = {sli_reserve_layout, sli_reserve_measure};
  memset(r, 0, sizeof *r);
  r->S = F->S;
  r->workers = sli_workers(&F->threads);
  r->storage = F->storage;
  r->all = sli_traversal_of(F->S, F->S->n_supers, 1);
  return sli_work_stages(W, &stage, 1, r);
}

SLI_INLINE uint64_t sli_reserve_product(uint64_t each, sl_int count, uint64_t total) {
  return each != 0 && (uint64_t)count > total / each ? total : each * (uint64_t)count;
}

static sli_capacity sli_reserve_sweep(const sli_reserve *r, sl_int count, sl_int lanes) {
  const sli_reach all = sli_reach_all(r->S);
  sli_capacity capacity = {0, 0, 0, 0};
  sl_int k;
  lanes = (sl_int)1 << sli_lanes_kind(lanes);
  for (k = 1; k <= lanes; k *= 2) {
    sli_capacity_add(&capacity, &all, k);
  }
  capacity.steps = sli_reserve_product(r->steps, count, capacity.steps);
  capacity.rows = sli_reserve_product(r->rows, count, capacity.rows);
  capacity.values = sli_reserve_product(r->columns * (uint64_t)lanes, count, capacity.values);
  return capacity;
}

static uint64_t sli_reserve_fronts(const sli_reserve *r, sl_int count) {
  const uint64_t roots = sli_reserve_product((uint64_t)r->front, count, (uint64_t)r->roots);
  return r->workers == 1 ? (uint64_t)r->stack
               : roots + (uint64_t)r->stack * ((uint64_t)r->workers + 1);
}

static size_t sli_reserve_forward_bytes(const sli_reserve *r, sl_int count) {
  const sl_int vectors = count > SLI_LANES_MAX / 2 ? SLI_LANES_MAX : 2 * count;
  const sli_capacity capacity = sli_reserve_sweep(r, vectors, vectors);
  sli_block b = {NULL, 0, 0};
  sli_requests requests;
  sli_forward forward;
  requests.count = count;
  sli_requests_layout(&requests, &b);
  sli_forward_layout(&forward, &b, &capacity);
  sli_forward_layout_run(&forward, &b, &capacity);
  return b.used;
}

static size_t sli_reserve_traversal_bytes(const sli_reserve *r, sl_int count) {
  const sl_symbolic *S = r->S;
  sli_traversal t = sli_traversal_of(S, S->n_supers, r->workers);
  sli_block b = {NULL, 0, 0};
  sli_requests requests;
  requests.count = count;
  t.is_partial = 1;
  sli_requests_layout(&requests, &b);
  sli_traversal_layout(&t, &b);
  (void)SLI_TAKE(&b, sl_int, S->n_supers);
  (void)SLI_TAKE(&b, sl_int, S->n_supers);
  sli_traversal_layout_work(&t, &b);
  (void)SLI_TAKE(&b, sl_int, (uint64_t)S->n_supers + 1);
  (void)SLI_TAKE(&b, double, sli_reserve_fronts(r, count));
  (void)SLI_TAKE(&b, double, (uint64_t)r->workers *(uint64_t)r->scratch);
  return b.used;
}

static size_t sli_reserve_bilinear_bytes(const sli_reserve *r, sl_int count) {
  const sli_capacity capacity = sli_reserve_sweep(r, count, 2);
  sli_block b = {NULL, 0, 0};
  sli_forward forward;
  (void)SLI_TAKE(&b, uint64_t, count);
  (void)SLI_TAKE(&b, uint64_t, count);
  sli_forward_layout(&forward, &b, &capacity);
  sli_forward_layout_run(&forward, &b, &capacity);
  return b.used;
}

static size_t sli_reserve_block_bytes(const sli_reserve *r, sl_int n_rows, sl_int n_columns) {
  sli_block b = {NULL, 0, 0};
  sli_inverse_block q;
  sl_int kept, streamed;
  memset(&q, 0, sizeof q);
  q.kept.count = q.kept.n_blocks = sli_min(n_rows, n_columns);
  q.streamed.count = sli_max(n_rows, n_columns);
  kept = sli_min(q.kept.count, SLI_LANES_MAX);
  streamed = sli_min(q.streamed.count, SLI_LANES_MAX);
  q.kept_capacity = sli_reserve_sweep(r, kept, kept);
  q.streamed_capacity = sli_reserve_sweep(r, streamed, streamed);
  sli_inverse_block_layout_requests(&q, &b);
  sli_inverse_block_layout_sweeps(&q, &b);
  return b.used;
}

SL_API sl_status sl_work_reserve_inverse(sl_work *W, const sl_factor *F, sl_int count) {
  sli_reserve r;
  sl_status status;
  if (W == NULL || F == NULL || count < 0) {
    return SL_ERR_ARGUMENT;
  }
  if (count == 0) {
    return SL_OK;
  }
  status = sli_reserve_of(&r, F, W);
  if (status == SL_OK) {
    const size_t forward = sli_reserve_forward_bytes(&r, count);
    const size_t traversal = sli_reserve_traversal_bytes(&r, count);
    const size_t bilinear = sli_reserve_bilinear_bytes(&r, count);
    const size_t most = forward > traversal ? forward : traversal;
    status = sli_work_grow(W, most > bilinear ? most : bilinear);
  }
  return status;
}

SL_API sl_status sl_work_reserve_block(sl_work *W, const sl_factor *F, sl_int n_rows,
                     sl_int n_columns) {
  sli_reserve r;
  sl_status status;
  if (W == NULL || F == NULL || n_rows < 0 || n_columns < 0) {
    return SL_ERR_ARGUMENT;
  }
  if (n_rows == 0 || n_columns == 0) {
    return SL_OK;
  }
  status = sli_reserve_of(&r, F, W);
  return status == SL_OK ? sli_work_grow(W, sli_reserve_block_bytes(&r, n_rows, n_columns))
               : status;
}

/* src/impl/inverse/selected.h: the selected inverse: a top-down traversal that keeps every panel */

struct sl_selected {
  sl_allocator allocator;
  sl_threads threads;
  sli_hash analysis;
  sli_numbers numbers;
  sl_storage storage;
  sli_traversal traversal;
  sl_off *begin;
  double *Z;
  int is_mapped;
  int is_immutable;
  double seconds;
  size_t bytes;
};

static void sli_selected_layout(sl_selected *Z, sli_block *b) {
  (void)sli_take(b, 1, sizeof(sl_selected));
  Z->begin = SLI_TAKE(b, sl_off, (uint64_t)Z->traversal.forest.count + 1);
  sli_traversal_layout(&Z->traversal, b);
  Z->bytes = b->used;
}

static sl_status sli_selected_plan(sl_selected **out, sl_selected *draft, const uint64_t *seeds,
                   sl_int n_seeds) {
  const sl_symbolic *S = draft->traversal.S;
  sli_block work = {NULL, 0, 0}, kept = {NULL, 0, 0};
  sl_status status = SL_OK;
  sl_int k;
  int pass;
  for (pass = 0; pass < 2 && status == SL_OK; pass++) {
    sli_selected_layout(draft, &kept);
    status = pass == 0 ? sli_block_alloc(&kept, &draft->allocator) : SL_OK;
  }
  for (pass = 0; pass < 2 && status == SL_OK; pass++) {
    sli_traversal_layout_work(&draft->traversal, &work);
    status = pass == 0 ? sli_block_alloc(&work, &draft->allocator) : SL_OK;
  }
  if (status == SL_OK) {
    sli_traversal_plan(&draft->traversal, seeds, n_seeds);
    draft->begin[0] = 0;
    for (k = 0; k < draft->traversal.forest.count; k++) {
      const sl_int s = draft->traversal.supers[k];
      draft->begin[k + 1] = draft->begin[k] + (S->panel_begin[s + 1] - S->panel_begin[s]);
    }
    *out = (sl_selected *)(void *)kept.base;
    **out = *draft;
  } else {
    sli_free(&draft->allocator, kept.base);
  }
  sli_free(&draft->allocator, work.base);
  return status;
}

static sl_status sli_selected_new(sl_selected **out, const sl_factor *F, const sl_int *set,
                  sl_int count, const sl_options *opt, sl_stats *stats) {
  const sl_symbolic *S = F->S;
  sli_block b = {NULL, 0, 0};
  uint64_t *seeds = NULL, *scratch = NULL;
  sl_selected draft;
  sl_status status = SL_OK;
  sl_int supers = S->n_supers;
  int pass;
  memset(&draft, 0, sizeof draft);
  draft.allocator = sli_allocator(opt);
  draft.analysis = S->identity;
  draft.storage = F->storage;
  draft.threads = opt == NULL || opt->threads.count == 0 ? F->threads : opt->threads;
  for (pass = 0; pass < 2 && status == SL_OK && set != NULL; pass++) {
    seeds = SLI_TAKE(&b, uint64_t, count);
    scratch = SLI_TAKE(&b, uint64_t, count);
    status = pass == 0 ? sli_block_alloc(&b, &draft.allocator) : SL_OK;
  }
  if (status == SL_OK && set != NULL) {
    status = sli_sort_rows(S, set, count, seeds, scratch, stats);
  }
  if (status == SL_OK) {
    if (set != NULL) {
      sli_reach R;
      sli_reach_measure(S, seeds, count, &R);
      supers = R.count;
    }
    draft.traversal = sli_traversal_of(S, supers, sli_workers(&draft.threads));
    status = sli_selected_plan(out, &draft, seeds, count);
  }
  sli_free(&draft.allocator, b.base);
  return status;
}

static void sli_selected_visit(void *context, sl_int k, const sli_inverse_front *f, sl_int t0,
                 sl_int t1) {
  const sl_selected *Z = (const sl_selected *)context;
  const sl_int w = f->width, h = w + f->below;
  double *panel = Z->Z + Z->begin[k];
  sl_int t, j;
  for (t = t0; t < t1; t++) {
    double *tile = panel + sli_tile_offset(w, t);
    const sl_int columns = sli_min(w, SLI_TILE * (t + 1)), rows = h - SLI_TILE * t;
    memcpy(tile, f->front + sli_square_offset(h, t), SLI_TILE * (size_t)columns * sizeof *tile);
    for (j = 0; j < columns && rows < SLI_TILE; j++) {
      memset(tile + SLI_TILE * (ptrdiff_t)j + rows, 0,
           (size_t)(SLI_TILE - rows) * sizeof *tile);
    }
  }
}

static void sli_selected_layout_run(void *context, sli_block *b) {
  sli_traversal_run *run = (sli_traversal_run *)context;
  sli_traversal_layout_run(run, run->traversal, run->F->storage, b);
}

static const sli_stage sli_selected_stage = {sli_selected_layout_run, NULL};

static sl_status sli_selected_fill(sl_selected *Z, const sl_factor *F, sl_work *W) {
  const double started = sli_seconds();
  sl_work own = sli_work_own(&Z->allocator);
  sli_traversal_run run;
  sl_status status;
  memset(&run, 0, sizeof run);
  run.F = F;
  run.traversal = &Z->traversal;
  run.threads = &Z->threads;
  run.visit = sli_selected_visit;
  run.context = Z;
  status = sli_work_stages(W == NULL ? &own : W, &sli_selected_stage, 1, &run);
  if (status == SL_OK) {
    sli_traverse(&run);
    Z->numbers = sli_numbers_of(F);
    Z->storage = F->storage;
    Z->seconds = sli_seconds() - started;
  }
  sli_free(&own.allocator, own.block);
  return status;
}

static sl_status sli_selected_alloc_values(sl_selected *Z) {
  sli_block b = {NULL, 0, 0};
  sl_status status = SL_OK;
  int pass;
  for (pass = 0; pass < 2 && status == SL_OK; pass++) {
    Z->Z = SLI_TAKE(&b, double, Z->begin[Z->traversal.forest.count]);
    Z->bytes += pass == 0 ? b.used : 0;
    status = pass == 0 ? sli_block_alloc(&b, &Z->allocator) : SL_OK;
  }
  return status;
}

SL_API sl_status sl_selected_create(sl_selected **out, const sl_factor *F, const sl_int *set,
                  sl_int count, const sl_options *opt, sl_stats *stats) {
  const double started = sli_seconds();
  sl_selected *Z = NULL;
  sl_status status;
  sli_stats_clear_error(stats);
  if (out == NULL) {
    return SL_ERR_ARGUMENT;
  }
  *out = NULL;
  if (F == NULL || (set != NULL && count < 0) || !sli_options_are_valid(opt, SLI_READS_NOTHING)) {
    return SL_ERR_ARGUMENT;
  }
  status = sli_inverse_check(F);
  if (status != SL_OK) {
    return status;
  }
  status = sli_selected_new(&Z, F, set, count, opt, stats);
  if (status == SL_OK) {
    status = sli_selected_alloc_values(Z);
  }
  if (status == SL_OK) {
    status = sli_selected_fill(Z, F, NULL);
  }
  if (status == SL_OK) {
    Z->seconds = sli_seconds() - started;
    sl_selected_stats(Z, stats);
    *out = Z;
  } else {
    sl_selected_free(Z);
  }
  return status;
}

SL_API sl_status sl_selected_refactor(sl_selected *Z, const sl_factor *F, sl_work *W) {
  if (Z == NULL || F == NULL) {
    return SL_ERR_ARGUMENT;
  }
  if (!F->is_valid || !sli_factor_is_over(F, Z->traversal.S, Z->analysis) || Z->is_immutable) {
    return SL_ERR_STATE;
  }
  return sli_selected_fill(Z, F, W);
}

SL_API sl_status sl_work_reserve_selected(sl_work *W, const sl_selected *Z) {
  sli_traversal_run run;
  sli_block b = {NULL, 0, 0};
  if (W == NULL || Z == NULL) {
    return SL_ERR_ARGUMENT;
  }
  sli_traversal_layout_run(&run, &Z->traversal, Z->storage, &b);
  return sli_work_grow(W, b.used);
}

SL_API void sl_selected_free(sl_selected *Z) {
  if (Z != NULL) {
    const sl_allocator a = Z->allocator;
    sli_free(&a, Z->is_mapped ? NULL : Z->Z);
    sli_free(&a, Z);
  }
}

/* src/impl/inverse/selected_query.h: reads a selected inverse: its diagonal, entries, statistics, arrays */

SLI_INLINE sl_int sli_selected_find(const sl_selected *Z, sl_int s) {
  sl_int at = s;
  if (Z->traversal.forest.count < Z->traversal.S->n_supers) {
    at = sli_lower_bound(Z->traversal.supers, Z->traversal.forest.count, s);
  }
  return at < Z->traversal.forest.count && Z->traversal.supers[at] == s ? at : -1;
}

static sl_off sli_selected_position(const sl_selected *Z, sl_int k, sl_int l) {
  const sl_symbolic *S = Z->traversal.S;
  const sl_int column = sli_min(k, l), s = S->super_of[column], at = sli_selected_find(Z, s);
  const sl_int r = at == -1 ? -1 : sli_front_row(S, s, sli_max(k, l));
  return r == -1 ? -1
           : Z->begin[at] + sli_panel_at(S->steps[s].width, r, column - S->super_first[s]);
}

static sl_status sli_selected_read(const sl_selected *Z, double *out, const sl_int *rows,
                   const sl_int *columns, sl_int count, sl_stats *stats) {
  const sl_symbolic *S = Z->traversal.S;
  sl_int k;
  int pass;
  for (pass = 0; pass < 2; pass++) {
    for (k = 0; k < count; k++) {
      const sl_int i = rows == NULL ? k : rows[k], j = columns == NULL ? i : columns[k];
      sl_off at;
      if (pass == 0 && (i < 0 || i >= S->n || j < 0 || j >= S->n)) {
        return sli_fail_at(stats, SL_ERR_ARGUMENT, i, columns == NULL ? -1 : j, 0.0);
      }
      at = sli_selected_position(Z, S->iperm[i], S->iperm[j]);
      if (at == -1) {
        return sli_fail_at(stats, SL_ERR_PATTERN, i, columns == NULL ? -1 : j, 0.0);
      }
      if (pass == 1) {
        out[k] = Z->Z[at];
      }
    }
  }
  return SL_OK;
}

static void sli_selected_read_diagonal(const sl_selected *Z, double *out) {
  const sl_symbolic *S = Z->traversal.S;
  sl_int s, j;
  for (s = 0; s < S->n_supers; s++) {
    const sl_int width = S->steps[s].width, *row = S->perm + S->super_first[s];
    for (j = 0; j < width; j++) {
      out[row[j]] = Z->Z[Z->begin[s] + sli_panel_at(width, j, j)];
    }
  }
}

SL_API sl_status sl_selected_diagonal(const sl_selected *Z, double *out, const sl_int *rows,
                    sl_int count, sl_stats *stats) {
  sli_stats_clear_error(stats);
  if (Z == NULL || (rows != NULL && count < 0)) {
    return SL_ERR_ARGUMENT;
  }
  count = rows == NULL ? Z->traversal.S->n : count;
  if (count > 0 && out == NULL) {
    return SL_ERR_ARGUMENT;
  }
  if (rows == NULL && Z->traversal.forest.count == Z->traversal.S->n_supers) {
    sli_selected_read_diagonal(Z, out);
    return SL_OK;
  }
  return sli_selected_read(Z, out, rows, NULL, count, stats);
}

SL_API sl_status sl_selected_entries(const sl_selected *Z, double *out, const sl_int *rows,
                   const sl_int *columns, sl_int count, sl_stats *stats) {
  sli_stats_clear_error(stats);
  if (Z == NULL || count < 0 || (count > 0 && (out == NULL || rows == NULL || columns == NULL))) {
    return SL_ERR_ARGUMENT;
  }
  return sli_selected_read(Z, out, rows, columns, count, stats);
}

SL_API void sl_selected_stats(const sl_selected *Z, sl_stats *stats) {
  sli_stats_clear_error(stats);
  if (Z != NULL && stats != NULL) {
    stats->selected.supernodes = Z->traversal.forest.count;
    stats->selected.columns = sli_traversal_count_columns(&Z->traversal);
    stats->selected.entries = Z->begin[Z->traversal.forest.count];
    stats->selected.seconds = Z->seconds;
    stats->selected.bytes = Z->bytes;
  }
}

SL_API sl_selected_arrays sl_selected_view(const sl_selected *Z) {
  sl_selected_arrays v = {NULL, 0, NULL, NULL, NULL};
  if (Z != NULL) {
    v.symbolic = Z->traversal.S;
    v.count = Z->traversal.forest.count;
    v.supers = Z->traversal.supers;
    v.begin = Z->begin;
    v.Z = Z->Z;
  }
  return v;
}

/* src/impl/inverse/region_choose.h: chooses the subtrees and the boundary of a region for the cheapest solves */

typedef struct sli_choice {
  const sl_symbolic *S;
  uint64_t *seeds, *scratch;
  sl_int count;
  size_t bytes_max;
  sli_reach reach;
  sli_step *steps;
  sl_int *rows;
  sl_off *rows_begin;
  uint64_t *order, *sorted;
  sl_int *n_children;
  sl_int *n_inside;
  unsigned char *is_inside;
  sl_int *needed;
  sl_int n_roots, boundary;
  double cost;
} sli_choice;

SLI_INLINE double sli_choice_step_cost(const sli_step *s) {
  return 2.0 * (double)sli_entries_from(s->width, s->below, s->first_tile);
}

SLI_INLINE double sli_choice_boundary_cost(sl_int boundary) {
  return (double)boundary * ((double)boundary + 2.0 * SLI_REGION_COLUMNS);
}

SLI_INLINE double sli_choice_cost(const sli_choice *c) {
  return c->cost + sli_choice_boundary_cost(c->boundary);
}

static int sli_region_bytes_fit(sl_int boundary, sl_int n_roots, size_t bytes_max) {
  sli_block b = {NULL, 0, 0};
  sl_region R;
  memset(&R, 0, sizeof R);
  if (boundary == 0 || bytes_max == 0) {
    return 1;
  }
  if ((double)boundary * (double)boundary * (0.5 * sizeof(double)) > (double)bytes_max) {
    return 0;
  }
  R.extent.n_rows = boundary;
  R.extent.n_roots = n_roots;
  sli_region_layout(&R, &b);
  return b.used <= bytes_max;
}

SLI_INLINE int sli_choice_fits(const sli_choice *c) {
  return sli_region_bytes_fit(c->boundary, c->n_roots, c->bytes_max);
}

static void sli_choice_add(sli_choice *c, sl_int k) {
  const sli_step *step = &c->steps[k];
  const sl_int *rows = c->rows + c->rows_begin[k];
  sl_int i;
  for (i = 0; i < sli_step_columns(step); i++) {
    c->boundary -= c->needed[step->base + i] > 0;
  }
  for (i = 0; i < step->below; i++) {
    c->boundary += c->needed[rows[i]]++ == 0;
  }
  c->n_roots += 1 - c->n_inside[k];
  c->is_inside[k] = 1;
  c->cost += sli_choice_step_cost(step);
  if (step->up != -1) {
    c->n_inside[step->up]++;
  }
}

static void sli_choice_remove(sli_choice *c, sl_int k) {
  const sli_step *step = &c->steps[k];
  const sl_int *rows = c->rows + c->rows_begin[k];
  sl_int i;
  if (step->up != -1) {
    c->n_inside[step->up]--;
  }
  c->cost -= sli_choice_step_cost(step);
  c->is_inside[k] = 0;
  c->n_roots -= 1 - c->n_inside[k];
  for (i = 0; i < step->below; i++) {
    c->boundary -= --c->needed[rows[i]] == 0;
  }
  for (i = 0; i < sli_step_columns(step); i++) {
    c->boundary += c->needed[step->base + i] > 0;
  }
}

static void sli_choice_sweep(sli_choice *c) {
  const sl_int count = c->reach.count;
  sl_int k, best = 0;
  double least = sli_choice_fits(c) ? sli_choice_cost(c) : HUGE_VAL;
  for (k = 0; k < count; k++) {
    double cost;
    sli_choice_add(c, sli_value(c->order[k]));
    cost = sli_choice_cost(c);
    if (cost < least && sli_choice_fits(c)) {
      least = cost;
      best = k + 1;
    }
  }
  if (least == HUGE_VAL) {
    best = count;
  }
  for (k = count; k > best; k--) {
    sli_choice_remove(c, sli_value(c->order[k - 1]));
  }
}

#define SLI_REGION_PASSES 8

static void sli_choice_improve(sli_choice *c) {
  sl_int pass, k;
  int is_better = 1;
  for (pass = 0; pass < SLI_REGION_PASSES && is_better; pass++) {
    is_better = 0;
    for (k = 0; k < c->reach.count; k++) {
      const sl_int up = c->steps[k].up;
      const double before = sli_choice_cost(c);
      if (!c->is_inside[k] && c->n_inside[k] == c->n_children[k]) {
        sli_choice_add(c, k);
        if (sli_choice_cost(c) < before && sli_choice_fits(c)) {
          is_better = 1;
        } else {
          sli_choice_remove(c, k);
        }
      } else if (c->is_inside[k] && (up == -1 || !c->is_inside[up])) {
        sli_choice_remove(c, k);
        if (sli_choice_cost(c) < before && sli_choice_fits(c)) {
          is_better = 1;
        } else {
          sli_choice_add(c, k);
        }
      }
    }
  }
}

#define SLI_REGION_DETOUR 2.0

static void sli_choice_single_subtree(sli_choice *c) {
  const sl_symbolic *S = c->S;
  double inside = 0.0, least = SLI_REGION_DETOUR * sli_choice_cost(c);
  sl_int k, first, last, best = -1;
  SLI_ASSERT(c->count > 0);
  first = S->super_of[sli_key(c->seeds[0])];
  last = S->super_of[sli_key(c->seeds[c->count - 1])];
  for (k = 0; k < c->reach.count; k++) {
    const sli_step *step = &c->steps[k];
    const sl_int s = S->super_of[step->column];
    inside += sli_choice_step_cost(step);
    if (s >= last && S->first_descendant[s] <= first &&
      inside + sli_choice_boundary_cost(step->below) <= least &&
      sli_region_bytes_fit(step->below, 1, c->bytes_max)) {
      least = inside + sli_choice_boundary_cost(step->below);
      best = k;
    }
  }
  for (k = c->reach.count - 1; k >= 0 && best >= 0; k--) {
    if (c->is_inside[k]) {
      sli_choice_remove(c, k);
    }
  }
  for (k = 0; k <= best; k++) {
    sli_choice_add(c, k);
  }
}

static void sli_choice_layout_reach(sli_choice *c, sli_block *b) {
  const uint64_t count = (uint64_t)c->reach.count;
  c->steps = SLI_TAKE(b, sli_step, count);
  c->rows = SLI_TAKE(b, sl_int, c->reach.n_rows);
  c->rows_begin = SLI_TAKE(b, sl_off, count + 1);
  c->order = SLI_TAKE(b, uint64_t, count);
  c->sorted = SLI_TAKE(b, uint64_t, count);
  c->n_children = SLI_TAKE(b, sl_int, count);
  c->n_inside = SLI_TAKE(b, sl_int, count);
  c->is_inside = SLI_TAKE(b, unsigned char, count);
  c->needed = SLI_TAKE(b, sl_int, c->reach.columns);
}

static void sli_choice_init(sli_choice *c) {
  const sl_symbolic *S = c->S;
  sl_int k, at = 0;
  sli_reach_fill(S, c->seeds, c->count, c->steps, c->rows, &c->reach);
  memset(c->n_children, 0, (size_t)c->reach.count * sizeof *c->n_children);
  memset(c->n_inside, 0, (size_t)c->reach.count * sizeof *c->n_inside);
  memset(c->is_inside, 0, (size_t)c->reach.count);
  memset(c->needed, 0, (size_t)c->reach.columns * sizeof *c->needed);
  c->rows_begin[0] = 0;
  for (k = 0; k < c->reach.count; k++) {
    const sl_int s = S->super_of[c->steps[k].column];
    c->rows_begin[k + 1] = c->rows_begin[k] + c->steps[k].below;
    c->order[k] = sli_keyed(S->super_first[s + 1] - S->super_first[S->first_descendant[s]], k);
    if (c->steps[k].up != -1) {
      c->n_children[c->steps[k].up]++;
    }
  }
  sli_sort(c->order, c->reach.count, c->sorted);
  c->n_roots = 0;
  c->boundary = c->count;
  c->cost = 0.0;
  for (k = 0; k < c->count; k++) {
    c->needed[sli_reach_index(&c->reach, &at, sli_key(c->seeds[k]))] = 1;
  }
}

static sl_status sli_choice_sort(sli_choice *c, const sl_int *set, sl_stats *stats) {
  const sl_symbolic *S = c->S;
  sl_int k, unique = 0;
  sl_status status = SL_OK;
  if (set == NULL) {
    for (k = 0; k < c->count; k++) {
      c->seeds[k] = sli_keyed(k, 0);
    }
    return SL_OK;
  }
  status = sli_sort_rows(S, set, c->count, c->seeds, c->scratch, stats);
  for (k = 0; k < c->count && status == SL_OK; k++) {
    if (k == 0 || c->seeds[k] != c->seeds[k - 1]) {
      c->seeds[unique++] = c->seeds[k];
    }
  }
  c->count = unique;
  return status;
}

/* src/impl/inverse/region.h: regions: creation, and their part of the inverse by sweeps or a selected inverse */

static void sli_region_index(sl_region *R) {
  const sl_symbolic *S = R->S;
  const sl_int n = R->extent.n_rows;
  sl_int k;
  R->extent.roots = R->roots;
  R->extent.rows = R->rows;
  R->analysis = S->identity;
  R->identity = sli_hash_ints(R->analysis, R->roots, R->extent.n_roots);
  R->identity = sli_hash_ints(R->identity, R->rows, n);
  R->begin[0] = 0;
  for (k = 0; k < n; k++) {
    R->requested[k] = S->perm[R->rows[k]];
    R->relative[k] = n + k;
  }
  for (k = 0; k < n; k += SLI_REGION_COLUMNS) {
    sl_off *begin = &R->begin[k / SLI_REGION_COLUMNS];
    const sl_int width = sli_min(SLI_REGION_COLUMNS, n - k);
    begin[1] = begin[0] + sli_panel_size(width, n - k);
  }
}

static void sli_region_from_choice(sl_region *R, const sli_choice *c) {
  const sl_symbolic *S = c->S;
  sl_int k, i, n_roots = 0, n_rows = 0;
  for (k = 0; k < c->reach.count; k++) {
    const sli_step *step = &c->steps[k];
    const sl_int s = S->super_of[step->column];
    if (c->is_inside[k]) {
      if (step->up == -1 || !c->is_inside[step->up]) {
        R->roots[n_roots++] = s;
      }
      continue;
    }
    for (i = 0; i < sli_step_columns(step); i++) {
      if (c->needed[step->base + i] > 0) {
        R->rows[n_rows++] = step->column + i;
      }
    }
  }
  SLI_ASSERT(n_roots == R->extent.n_roots && n_rows == R->extent.n_rows);
  sli_region_index(R);
  memset(R->Z, 0, (size_t)R->begin[sli_region_chunks(n_rows)] * sizeof *R->Z);
}

static sl_status sli_region_new(sl_region **out, const sl_symbolic *S, const sl_int *set,
                sl_int count, int may_copy, const sl_options *opt,
                const sl_allocator *a, sl_stats *stats) {
  sli_block seeds = {NULL, 0, 0}, rest = {NULL, 0, 0}, kept = {NULL, 0, 0};
  sli_choice c;
  sl_region draft;
  sl_status status = SL_OK;
  int pass;
  memset(&c, 0, sizeof c);
  memset(&draft, 0, sizeof draft);
  c.S = S;
  c.count = set == NULL ? S->n : count;
  c.bytes_max = opt == NULL ? 0 : opt->region_bytes;
  for (pass = 0; pass < 2 && status == SL_OK; pass++) {
    c.seeds = SLI_TAKE(&seeds, uint64_t, c.count);
    c.scratch = SLI_TAKE(&seeds, uint64_t, c.count);
    status = pass == 0 ? sli_block_alloc(&seeds, a) : SL_OK;
  }
  status = status == SL_OK ? sli_choice_sort(&c, set, stats) : status;
  if (status == SL_OK) {
    sli_reach_measure(S, c.seeds, c.count, &c.reach);
  }
  for (pass = 0; pass < 2 && status == SL_OK; pass++) {
    sli_choice_layout_reach(&c, &rest);
    status = pass == 0 ? sli_block_alloc(&rest, a) : SL_OK;
  }
  if (status == SL_OK) {
    sli_choice_init(&c);
    sli_choice_sweep(&c);
    sli_choice_improve(&c);
    if (may_copy && c.boundary > 1) {
      sli_choice_single_subtree(&c);
    }
    draft.allocator = *a;
    draft.S = S;
    draft.extent.n_roots = c.n_roots;
    draft.extent.n_rows = c.boundary;
  }
  for (pass = 0; pass < 2 && status == SL_OK; pass++) {
    sli_region_layout(&draft, &kept);
    status = pass == 0 ? sli_block_alloc(&kept, a) : SL_OK;
  }
  if (status == SL_OK) {
    sli_region_from_choice(&draft, &c);
    *out = (sl_region *)(void *)kept.base;
    **out = draft;
  }
  sli_free(a, rest.base);
  sli_free(a, seeds.base);
  return status;
}

static void sli_region_write(void *context, sl_int row, sl_int column, double z) {
  sl_region *R = (sl_region *)context;
  const sl_int low = sli_min(row, column), high = sli_max(row, column);
  const sl_int first = low - low % SLI_REGION_COLUMNS;
  const sl_int width = sli_min(SLI_REGION_COLUMNS, R->extent.n_rows - first);
  R->Z[R->begin[first / SLI_REGION_COLUMNS] +
     sli_panel_at(width, width + high - first, low - first)] = low == high ? -0.5 * z : -z;
}

static int sli_region_copy(sl_region *R, const sl_selected *Z) {
  const sl_int *rows = R->extent.rows;
  sl_int i, j;
  int pass;
  for (pass = 0; pass < 2; pass++) {
    for (j = 0; j < R->extent.n_rows; j++) {
      for (i = j; i < R->extent.n_rows; i++) {
        const sl_off at = sli_selected_position(Z, rows[i], rows[j]);
        if (at == -1) {
          return 0;
        }
        if (pass == 1) {
          sli_region_write(R, i, j, Z->Z[at]);
        }
      }
    }
  }
  return 1;
}

static sl_status sli_region_fill(sl_region *R, const sl_factor *F, const sl_selected *Z,
                 sl_work *W) {
  const double started = sli_seconds();
  sl_work own = sli_work_own(&R->allocator);
  sl_status status = SL_OK;
  const int is_copied = Z != NULL && sli_region_copy(R, Z);
  if (!is_copied) {
    status = sli_inverse_all_pairs(F, R->requested, R->extent.n_rows, sli_region_write, R,
                     W == NULL ? &own : W);
    sli_free(&own.allocator, own.block);
  }
  if (status == SL_OK) {
    R->numbers = sli_numbers_of(F);
    R->is_copied = is_copied;
    R->seconds = sli_seconds() - started;
  }
  return status;
}

static sl_status sli_region_check_factor(const sl_factor *F, const sl_selected *Z) {
  if (!F->is_valid || (Z != NULL && !sli_numbers_are_of(&Z->numbers, F))) {
    return SL_ERR_STATE;
  }
  return F->is_centered ? SL_ERR_UNSUPPORTED : sli_inverse_check(F);
}

SL_API sl_status sl_region_create(sl_region **out, const sl_factor *F, const sl_int *set,
                  sl_int count, const sl_selected *Z, const sl_options *opt,
                  sl_stats *stats) {
  const double started = sli_seconds();
  const sl_allocator a = sli_allocator(opt);
  sl_region *R = NULL;
  sl_status status;
  sli_stats_clear_error(stats);
  if (out == NULL) {
    return SL_ERR_ARGUMENT;
  }
  *out = NULL;
  if (F == NULL || (set != NULL && count < 0) ||
    !sli_options_are_valid(opt, SLI_READS_REGION_BYTES)) {
    return SL_ERR_ARGUMENT;
  }
  status = sli_region_check_factor(F, Z);
  status =
    status == SL_OK ? sli_region_new(&R, F->S, set, count, Z != NULL, opt, &a, stats) : status;
  if (status == SL_OK) {
    status = sli_region_fill(R, F, Z, NULL);
    R->seconds = sli_seconds() - started;
  }
  if (status == SL_OK) {
    sl_region_stats(R, stats);
    *out = R;
  } else {
    sl_region_free(R);
  }
  return status;
}

SL_API sl_status sl_region_refactor(sl_region *R, const sl_factor *F, const sl_selected *Z,
                  sl_work *W) {
  sl_status status;
  if (R == NULL || F == NULL) {
    return SL_ERR_ARGUMENT;
  }
  if (!sli_factor_is_over(F, R->S, R->analysis) || R->is_immutable) {
    return SL_ERR_STATE;
  }
  status = sli_region_check_factor(F, Z);
  if (status == SL_OK) {
    status = sli_region_fill(R, F, Z, W);
  }
  return status;
}

SL_API sl_status sl_work_reserve_region(sl_work *W, const sl_region *R, const sl_factor *F) {
  if (W == NULL || R == NULL || F == NULL) {
    return SL_ERR_ARGUMENT;
  }
  return sli_factor_is_over(F, R->S, R->analysis)
         ? sli_inverse_all_pairs_prepare(F, R->requested, R->extent.n_rows, W)
         : SL_ERR_STATE;
}

SL_API void sl_region_free(sl_region *R) {
  if (R != NULL) {
    const sl_allocator a = R->allocator;
    sli_free(&a, R);
  }
}

SL_API void sl_region_stats(const sl_region *R, sl_stats *stats) {
  sl_int k;
  sli_stats_clear_error(stats);
  if (R != NULL && stats != NULL) {
    stats->region.rows = R->extent.n_rows;
    for (k = 0; k < R->extent.n_roots; k++) {
      const sl_int s = R->roots[k], first = R->S->first_descendant[s];
      stats->region.rows += R->S->super_first[s + 1] - R->S->super_first[first];
    }
    stats->region.boundary = R->extent.n_rows;
    stats->region.subtrees = R->extent.n_roots;
    stats->region.entries = R->begin[sli_region_chunks(R->extent.n_rows)];
    stats->region.is_copied = R->is_copied;
    stats->region.seconds = R->seconds;
    stats->region.bytes = R->bytes;
  }
}

SL_API sl_region_arrays sl_region_view(const sl_region *R) {
  sl_region_arrays v = {NULL, 0, NULL, 0, NULL};
  if (R != NULL) {
    v.symbolic = R->S;
    v.n_roots = R->extent.n_roots;
    v.roots = R->extent.roots;
    v.n_boundary = R->extent.n_rows;
    v.boundary = R->requested;
  }
  return v;
}

/* change: a factor that follows changes of its matrix */
/* src/impl/change/update.h: one pass of a rank-k change: the columns on the paths of up to 8 vectors */

typedef struct sli_update {
  sl_factor *F;
  const sl_csc *V;
  const double *sigma;
  double sign;
  int keeps_signs;
  int is_trial;
  int is_tried;
  sl_int ranks, lanes;
  int kind;
  double U[SLI_TILE][SLI_TILE], alpha[SLI_TILE];
  double most;
  double entry;
  double growth;
  sli_reach R;
  sl_int pivot;
  double value;

  sli_step *steps;
  sl_int *rows;
  double *x;
  double *gain;
  double *local;
  double *c;
  double *trial, *scratch;
} sli_update;

static void sli_update_layout(sli_update *u, sli_block *b, const sli_reach *R, sl_int lanes,
                int has_trial) {
  const uint64_t many = (uint64_t)lanes;
  u->steps = SLI_TAKE(b, sli_step, R->count);
  u->rows = SLI_TAKE(b, sl_int, R->n_rows);
  u->x = SLI_TAKE(b, double, many *(uint64_t)R->columns);
  u->gain = SLI_TAKE(b, double, R->columns);
  u->local = SLI_TAKE(b, double, many *SLI_TILE *((uint64_t)sli_tiles(R->tallest) + 4));
  u->c = SLI_TAKE(b, double, 2 * many * (uint64_t)R->widest);
  u->trial = SLI_TAKE(b, double, has_trial ? many *(uint64_t)R->columns : 0);
  u->scratch =
    SLI_TAKE(b, double, has_trial ? sli_sweep_scratch(R->tallest, R->widest, lanes) : 0);
}

static double sli_update_magnitude(const sl_factor *F, sl_int k) {
  const sl_symbolic *S = F->S;
  const sl_int own = S->super_of[k];
  double sum = 0.0;
  sl_int d, j;
  for (d = own; d >= S->first_descendant[own];) {
    const sli_step *step = &S->steps[d];
    const sl_int *rows = S->rows + S->rows_begin[d];
    const sl_int at = d == own ? 0 : sli_lower_bound(rows, step->below, k);
    const sl_int r = d == own ? k - step->column : step->width + at;
    if (d != own && at == step->below) {
      d = S->first_descendant[d] - 1;
      continue;
    }
    for (j = 0; j < sli_min(r, step->width) && (d == own || rows[at] == k); j++) {
      const double l = sli_entry(F, step->panel + sli_panel_at(step->width, r, j));
      sum += fabs(l * F->D[step->column + j] * l);
    }
    d--;
  }
  return 2.0 * sum + fabs(F->D[k]);
}

static int sli_update_is_null(const sl_factor *F, sl_int k, double d, double magnitude) {
  const double tolerance = F->rule.null_tolerance;
  const double known = F->extents[F->S->super_of[k]].magnitude;
  if (sli_is_null(d, magnitude, tolerance)) {
    return 1;
  }
  return sli_is_null(d, magnitude + known, tolerance) &&
       sli_is_null(d, magnitude + sli_update_magnitude(F, k), tolerance);
}

SLI_INLINE void sli_update_count(sl_factor_info *info, double d, double e) {
  const double size = fabs(e);
  info->positive += (e > 0.0) - (d > 0.0);
  info->negative += (e < 0.0) - (d < 0.0);
  info->pivot_min = size < info->pivot_min ? size : info->pivot_min;
  info->pivot_max = size > info->pivot_max ? size : info->pivot_max;
}

static sl_status sli_update_take(sli_update *u, sl_int k, double e, double magnitude) {
  sl_factor *F = u->F;
  const double d = F->D[k];
  u->value = e;
  u->pivot = k;
  if (!sli_is_finite(e)) {
    return SL_ERR_NOT_FINITE;
  }
  if (fabs(e) < DBL_MIN || (u->keeps_signs && (e < 0.0) != (d < 0.0)) ||
    (fabs(e) < fabs(d) && !u->is_tried && sli_update_is_null(F, k, e, magnitude))) {
    return SL_ERR_PIVOT;
  }
  if (!u->is_trial) {
    u->most = magnitude > u->most ? magnitude : u->most;
    sli_update_count(&F->stats.factor, d, e);
    F->D[k] = e;
  }
  return SL_OK;
}

static sl_status sli_update_pivot(sli_update *u, sl_int k, const double *y, sl_int stride,
                  double *c) {
  const double d = u->F->D[k];
  double e = d, inverse = 1.0 / d, magnitude = fabs(d), b[SLI_TILE];
  sl_int i, r, any = 0;
  sl_status status;
  for (r = 0; r < u->lanes; r++) {
    c[r] = y[stride * r];
    c[u->lanes + r] = 0.0;
    any |= c[r] != 0.0;
  }
  if (!any) {
    return SL_OK;
  }
  for (r = 0; r < u->ranks; r++) {
    const double before = e;
    double f = c[r], p;
    for (i = 0; i < r; i++) {
      f += u->U[i][r] * c[i];
    }
    b[r] = u->alpha[r] * f;
    e += b[r] * f;
    magnitude += fabs(b[r] * f);
    if (!(fabs(e) > 0.0)) {
      return sli_update_take(u, k, e, magnitude);
    }
    p = -f * inverse;
    inverse = 1.0 / e;
    u->alpha[r] *= before * inverse;
    for (i = 0; i < r; i++) {
      const double t = u->U[i][r];
      u->U[i][r] = t + b[i] * p;
      b[i] += t * b[r];
    }
  }
  status = sli_update_take(u, k, e, magnitude);
  for (r = 0; r < u->ranks; r++) {
    c[u->lanes + r] = -b[r] * inverse;
  }
  return status;
}

static sl_status sli_update_tile(sli_update *u, const sli_step *step, sl_int c, double *w) {
  const sl_int first = SLI_TILE * c, columns = sli_min(SLI_TILE, step->width - first);
  double *l = (double *)u->F->values + step->panel + sli_panel_at(step->width, first, first);
  double *at = u->c + 2 * (ptrdiff_t)u->lanes * (first - SLI_TILE * step->first_tile);
  const sl_int start = step->column - SLI_TILE * step->first_tile;
  sl_int j, i;
  for (j = 0; j < columns; j++, l += SLI_TILE, at += 2 * (ptrdiff_t)u->lanes) {
    const sl_status status = sli_update_pivot(u, start + first + j, w + j, SLI_TILE, at);
    if (status != SL_OK) {
      return status;
    }
    if (u->kind == SLI_NRHS_1) {
      for (i = j + 1; i < SLI_TILE; i++) {
        w[i] -= l[i] * at[0];
        l[i] -= w[i] * at[1];
      }
      continue;
    }
    u->F->kernels->change[u->kind](l, 1, at, w);
    for (i = 0; i <= j; i++) {
      l[i] = 0.0;
    }
  }
  return SL_OK;
}

static void sli_update_rows(const sli_update *u, const sli_step *step, sl_int t0, sl_int t1,
              sl_int from, sl_int to) {
  const sl_int entered = step->first_tile;
  const double *c = u->c + 2 * (ptrdiff_t)u->lanes * (from - SLI_TILE * entered);
  double *w = u->local + SLI_TILE * (ptrdiff_t)u->lanes * (t0 - entered), *tiles[4];
  sl_int t;
  for (t = t0; t < t1; t++) {
    tiles[t - t0] =
      (double *)u->F->values + step->panel + sli_panel_at(step->width, SLI_TILE * t, from);
  }
  if (u->kind == SLI_NRHS_1 && t1 - t0 == 4) {
    u->F->kernels->change_tiles(tiles, to - from, c, w);
    return;
  }
  for (t = t0; t < t1; t++, w += SLI_TILE * (ptrdiff_t)u->lanes) {
    u->F->kernels->change[u->kind](tiles[t - t0], to - from, c, w);
  }
}

static void sli_update_gather(const sli_update *u, const sli_step *step, const sl_int *rows) {
  const sl_int lanes = u->lanes, own = sli_step_columns(step), all = own + step->below;
  sl_int i, r;
  for (i = 0; i < SLI_TILE * sli_tiles(all); i++) {
    const sl_int from = i < own ? step->base + i : i < all ? rows[i - own] : 0;
    const double *x = u->x + (ptrdiff_t)lanes * from;
    double *to = u->local + SLI_TILE * (ptrdiff_t)lanes * (i / SLI_TILE) + i % SLI_TILE;
    for (r = 0; r < lanes; r++) {
      to[SLI_TILE * r] = i < all ? x[r] : 0.0;
    }
  }
}

static void sli_update_scatter(const sli_update *u, const sli_step *step, const sl_int *rows) {
  const sl_int lanes = u->lanes, own = sli_step_columns(step), all = own + step->below;
  sl_int i, r;
  for (i = own; i < all; i++) {
    const double *from = u->local + SLI_TILE * (ptrdiff_t)lanes * (i / SLI_TILE) + i % SLI_TILE;
    for (r = 0; r < lanes; r++) {
      u->x[(ptrdiff_t)lanes * rows[i - own] + r] = from[SLI_TILE * r];
    }
  }
}

static void sli_update_gains(const sli_update *u, const sli_step *step, const sl_int *rows,
               double sign) {
  const sl_factor *F = u->F;
  const sl_int start = step->column - SLI_TILE * step->first_tile;
  sl_int r, j;
  for (r = SLI_TILE * step->first_tile; r < step->width + step->below; r++) {
    const double *l = (const double *)F->values + step->panel + sli_panel_at(step->width, r, 0);
    double *gain = &u->gain[r < step->width ? step->base + start + r - step->column
                        : rows[r - step->width]];
    double sum = r < step->width ? fabs(F->D[start + r]) : 0.0;
    for (j = SLI_TILE * step->first_tile; j < sli_min(r, step->width); j++) {
      sum += fabs(l[SLI_TILE * (ptrdiff_t)j] * F->D[start + j] * l[SLI_TILE * (ptrdiff_t)j]);
    }
    *gain += sign * sum;
  }
}

static void sli_update_extent(sli_update *u, const sli_step *step) {
  sli_extent *extent = &u->F->extents[u->F->S->super_of[step->column]];
  sl_int k, at = -1;
  double gain = 0.0;
  for (k = 0; k < sli_step_columns(step); k++) {
    if (u->gain[step->base + k] > gain) {
      gain = u->gain[step->base + k];
      at = step->column + k;
    }
  }
  if (at != -1) {
    extent->magnitude += gain;
    extent->entry += u->sign != 0.0 ? 0.5 * gain : 0.0;
    extent->pivot = at;
  }
  u->entry = fmax(u->entry, extent->entry);
  u->growth = fmax(u->growth, extent->magnitude);
}

static sl_status sli_update_step(sli_update *u, const sli_step *step, const sl_int *rows) {
  const sl_int entered = step->first_tile, wide = sli_tiles(step->width);
  const sl_int tiles = sli_tiles(step->width + step->below);
  sl_int t0, t1, t;
  sli_update_gather(u, step, rows);
  if (u->sign == 0.0) {
    sli_update_gains(u, step, rows, -1.0);
  }
  for (t0 = entered; t0 < tiles; t0 = t1) {
    t1 = sli_min(t0 + 4, tiles);
    if (t0 > entered) {
      sli_update_rows(u, step, t0, t1, SLI_TILE * entered,
              sli_min(SLI_TILE * t0, step->width));
    }
    for (t = t0; t < sli_min(t1, wide); t++) {
      const sl_status status = sli_update_tile(
        u, step, t, u->local + SLI_TILE * (ptrdiff_t)u->lanes * (t - entered));
      if (status != SL_OK) {
        return status;
      }
      if (t + 1 < t1) {
        sli_update_rows(u, step, t + 1, t1, SLI_TILE * t,
                sli_min(SLI_TILE * (t + 1), step->width));
      }
    }
  }
  sli_update_scatter(u, step, rows);
  if (u->sign == 0.0) {
    sli_update_gains(u, step, rows, 1.0);
  }
  sli_update_extent(u, step);
  return SL_OK;
}

static sl_int sli_update_first(const sl_symbolic *S, const sl_csc *V, sl_int v) {
  sl_int p, first = S->n;
  for (p = V->p[v]; p < V->p[v + 1]; p++) {
    first = V->x[p] != 0.0 ? sli_min(first, S->iperm[V->i[p]]) : first;
  }
  return first;
}

static void sli_update_load(sli_update *u, const sl_int *group, sl_int count) {
  const sl_symbolic *S = u->F->S;
  const sl_csc *V = u->V;
  sl_int r, p;
  u->ranks = count;
  u->kind = sli_lanes_kind(count);
  u->lanes = (sl_int)1 << u->kind;
  u->most = u->entry = u->growth = 0.0;
  memset(u->U, 0, sizeof u->U);
  memset(u->x, 0, (size_t)u->R.columns * (size_t)u->lanes * sizeof(double));
  memset(u->gain, 0, (size_t)u->R.columns * sizeof(double));
  for (r = 0; r < count; r++) {
    const sl_int v = group[r];
    u->alpha[r] = u->sigma == NULL ? 1.0 : u->sigma[v];
    for (p = V->p[v]; p < V->p[v + 1]; p++) {
      const sl_int at = V->x[p] == 0.0 ? -1 : sli_reach_index_of(&u->R, S->iperm[V->i[p]]);
      if (at != -1) {
        const double x = V->x[p];
        u->x[(ptrdiff_t)at * u->lanes + r] += x;
        u->gain[at] += u->sign == 0.0 ? fabs(u->alpha[r] * x * x)
                        : fmax(0.0, 2.0 * u->sign * u->alpha[r] * x * x);
      }
    }
  }
}

static sl_status sli_update_try(sli_update *u, const sl_int *group, sl_int count) {
  const sli_reach *R = &u->R;
  sl_status status = SL_OK;
  sl_int s, j;
  memcpy(u->trial, u->x, (size_t)R->columns * (size_t)u->lanes * sizeof(double));
  sli_forward_sweep(u->F, u->kind, R->count, R->steps, R->rows, u->trial, u->scratch);
  u->is_trial = 1;
  for (s = 0; s < R->count; s++) {
    const sli_step *step = &R->steps[s];
    for (j = 0; j < sli_step_columns(step) && status == SL_OK; j++) {
      status = sli_update_pivot(u, step->column + j,
                    u->trial + (ptrdiff_t)u->lanes * (step->base + j), 1, u->c);
    }
  }
  u->is_trial = 0;
  u->is_tried = status == SL_OK;
  sli_update_load(u, group, count);
  return status;
}

static sl_status sli_update_run(sli_update *u) {
  const sl_int *rows = u->R.rows;
  sl_status status = SL_OK;
  sl_int s;
  for (s = 0; s < u->R.count && status == SL_OK; s++) {
    status = sli_update_step(u, &u->R.steps[s], rows);
    rows += u->R.steps[s].below;
  }
  return status;
}

/* src/impl/change/rank.h: rank-k changes of a factor: the vectors, their passes, and the log that undoes them */

typedef struct sli_rank {
  sli_update u;
  const sl_int *entry_rows, *entry_columns;
  const double *deltas;
  sl_int n_entries;
  sl_stats *stats;
  sl_status status;
  sl_int count;
  sl_int updates;
  int has_trial;
  int has_log;
  sl_int logged;
  int is_changed;
  double flops;
  sl_off entries;
  sli_reach whole;
  uint64_t *seeds, *scratch, *whole_seeds;
  double *log, *log_D;
  sli_extent *log_extents;
  sli_step *log_steps;

  sl_csc V;
  sl_int *p, *i;
  double *x, *sigma, *diagonal;
  uint64_t *order, *order_scratch;
} sli_rank;

static int sli_rank_is_suited(const sl_factor *F) {
  return F->E == NULL && F->n_nulls == 0 && F->storage == SL_STORAGE_DOUBLE;
}

static sl_status sli_rank_check(const sl_factor *F) {
  if (!F->is_valid || !sli_factor_may_change(F)) {
    return SL_ERR_STATE;
  }
  return sli_rank_is_suited(F) ? SL_OK : SL_ERR_UNSUPPORTED;
}

static sl_status sli_rank_check_vector(const sli_rank *q, sl_int v, sl_int first) {
  const sl_symbolic *S = q->u.F->S;
  const sl_csc *V = q->u.V;
  const double sigma = q->u.sigma == NULL ? 1.0 : q->u.sigma[v];
  sl_int s, p, at;
  if (!sli_is_finite(sigma)) {
    return sli_fail_at(q->stats, SL_ERR_NOT_FINITE, -1, v, sigma);
  }
  s = first < S->n ? S->super_of[first] : -1;
  for (p = V->p[v]; p < V->p[v + 1]; p++) {
    const sl_int k = S->iperm[V->i[p]];
    const sl_int *rows = s == -1 ? NULL : S->rows + S->rows_begin[s];
    if (!sli_is_finite(V->x[p])) {
      return sli_fail_at(q->stats, SL_ERR_NOT_FINITE, V->i[p], v, V->x[p]);
    }
    if (V->x[p] == 0.0 || sigma == 0.0 || k < S->super_first[s + 1]) {
      continue;
    }
    at = sli_lower_bound(rows, S->steps[s].below, k);
    if (at == S->steps[s].below || rows[at] != k) {
      return sli_fail_at(q->stats, SL_ERR_PATTERN, V->i[p], S->perm[first], V->x[p]);
    }
  }
  return SL_OK;
}

static void sli_rank_layout_seeds(void *data, sli_block *b) {
  sli_rank *q = (sli_rank *)data;
  q->seeds = SLI_TAKE(b, uint64_t, q->u.V->n_cols);
  q->scratch = SLI_TAKE(b, uint64_t, q->u.V->n_cols);
  q->whole_seeds = SLI_TAKE(b, uint64_t, q->u.V->n_cols);
}

SLI_INLINE sl_int sli_rank_pass(const sli_rank *q, sl_int k) {
  return sli_min(k + SLI_TILE, q->count);
}

static void sli_rank_group(const sli_rank *q, sl_int first, sl_int last, sl_int *group,
               uint64_t *seeds) {
  uint64_t unused[SLI_TILE];
  sl_int k;
  for (k = first; k < last; k++) {
    group[k - first] = sli_value(q->seeds[k]);
    seeds[k - first] = q->seeds[k];
  }
  sli_sort(seeds, last - first, unused);
}

static void sli_rank_measure(sli_rank *q) {
  sl_int k, last, group[SLI_TILE];
  uint64_t seeds[SLI_TILE];
  q->flops = 0.0;
  q->entries = 0;
  for (k = 0; k < q->count; k = last) {
    sli_reach R;
    last = sli_rank_pass(q, k);
    sli_rank_group(q, k, last, group, seeds);
    sli_reach_measure(q->u.F->S, seeds, last - k, &R);
    q->flops += 4.0 * (double)R.entries * (double)((sl_int)1 << sli_lanes_kind(last - k));
    q->entries += R.entries;
  }
}

static void sli_rank_sort(void *data) {
  sli_rank *q = (sli_rank *)data;
  const sl_symbolic *S = q->u.F->S;
  const sl_csc *V = q->u.V;
  sl_int v, rest = 0;
  q->count = 0;
  for (v = 0; v < V->n_cols && q->status == SL_OK; v++) {
    const double sigma = q->u.sigma == NULL ? 1.0 : q->u.sigma[v];
    const sl_int first = sli_update_first(S, V, v);
    q->status = sli_rank_check_vector(q, v, first);
    if (first < S->n && sigma != 0.0) {
      if (sigma * (q->u.sign < 0.0 ? -1.0 : 1.0) > 0.0) {
        q->seeds[q->count++] = sli_keyed(first, v);
      } else {
        q->whole_seeds[rest++] = sli_keyed(first, v);
      }
    }
  }
  memset(&q->whole, 0, sizeof q->whole);
  if (q->status != SL_OK) {
    return;
  }
  q->updates = q->count;
  sli_sort(q->seeds, q->count, q->scratch);
  sli_sort(q->whole_seeds, rest, q->scratch);
  if (rest > 0) {
    memcpy(q->seeds + q->count, q->whole_seeds, (size_t)rest * sizeof *q->seeds);
  }
  q->count += rest;
  if (q->count > 0) {
    memcpy(q->whole_seeds, q->seeds, (size_t)q->count * sizeof *q->seeds);
  }
  sli_sort(q->whole_seeds, q->count, q->scratch);
  sli_reach_measure(S, q->whole_seeds, q->count, &q->whole);
  q->has_log = q->u.sign == 0.0 || (rest > 0 && q->count > SLI_TILE);
  q->has_trial = rest > 0 && !q->has_log;
  sli_rank_measure(q);
}

static uint64_t sli_rank_panels(const sl_symbolic *S, const uint64_t *seeds, sl_int count) {
  uint64_t size = 0;
  sl_int k = 0, s, next;
  while (k < count) {
    s = S->super_of[sli_key(seeds[k])];
    next = sli_next_seed(S, seeds, count, &k);
    for (; s != -1 && s < next; s = S->super_parent[s]) {
      size += (uint64_t)(S->panel_begin[s + 1] - S->panel_begin[s]);
    }
  }
  return size;
}

static void sli_rank_layout(void *data, sli_block *b) {
  sli_rank *q = (sli_rank *)data;
  const sl_symbolic *S = q->u.F->S;
  sli_update_layout(&q->u, b, &q->whole, (sl_int)1 << sli_lanes_kind(sli_min(q->count, 8)),
            q->has_trial);
  if (q->has_log) {
    q->log = SLI_TAKE(b, double, sli_rank_panels(S, q->whole_seeds, q->count));
    q->log_D = SLI_TAKE(b, double, q->whole.columns);
    q->log_extents = SLI_TAKE(b, sli_extent, q->whole.count);
    q->log_steps = SLI_TAKE(b, sli_step, q->whole.count);
  }
}

static void sli_rank_log(sli_rank *q, sl_int count, int restores) {
  sl_factor *F = q->u.F;
  double *log = q->log, *log_D = q->log_D;
  sl_int k;
  for (k = 0; k < count; k++) {
    const sli_step *step = &q->log_steps[k];
    const sl_int columns = sli_step_columns(step);
    const sl_off from = sli_tile_offset(step->width, step->first_tile);
    const size_t size = (size_t)(sli_panel_size(step->width, step->below) - from);
    double *L = (double *)F->values + step->panel + from;
    sli_extent *extent = &F->extents[F->S->super_of[step->column]];
    memcpy(restores ? L : log, restores ? log : L, size * sizeof(double));
    memcpy(restores ? F->D + step->column : log_D, restores ? log_D : F->D + step->column,
         (size_t)columns * sizeof(double));
    memcpy(restores ? extent : &q->log_extents[k], restores ? &q->log_extents[k] : extent,
         sizeof *extent);
    log += size;
    log_D += columns;
  }
}

static void sli_rank_identify(sli_rank *q) {
  sl_factor *F = q->u.F;
  const sl_csc *V = q->u.V;
  F->identity = sli_hash_ints(F->identity, V->p, (sl_off)V->n_cols + 1);
  F->identity = sli_hash_ints(F->identity, V->i, sli_nnz(V));
  F->identity = sli_hash_words(F->identity, V->x, sli_nnz(V));
  if (q->u.sigma != NULL) {
    F->identity = sli_hash_words(F->identity, q->u.sigma, V->n_cols);
  }
  F->generation++;
}

static sl_status sli_rank_passes(sli_rank *q) {
  sl_factor *F = q->u.F;
  sl_factor_info *info = &F->stats.factor;
  sl_status status = SL_OK;
  sl_int k, last, group[SLI_TILE];
  uint64_t seeds[SLI_TILE];
  for (k = 0; k < q->count && status == SL_OK; k = last) {
    last = sli_rank_pass(q, k);
    sli_rank_group(q, k, last, group, seeds);
    sli_reach_fill(F->S, seeds, last - k, q->u.steps, q->u.rows, &q->u.R);
    sli_update_load(&q->u, group, last - k);
    status = q->has_trial ? sli_update_try(&q->u, group, last - k) : SL_OK;
    q->is_changed |= status == SL_OK;
    status = status == SL_OK ? sli_update_run(&q->u) : status;
    if (status == SL_OK) {
      const double scale = fmax(info->entry_max, q->u.entry);
      const double growth = q->u.entry > 0.0 ? q->u.growth / q->u.entry : 0.0;
      info->growth = fmax(info->growth, q->u.sign != 0.0 ? fmin(growth, 2.0) : growth);
      F->drift += scale > 0.0 ? DBL_EPSILON * fmax(1.0, q->u.most / scale) : 0.0;
      if (info->growth > F->growth_limit) {
        q->u.pivot = F->extents[F->S->super_of[sli_key(seeds[0])]].pivot;
        q->u.pivot = q->u.pivot < 0 ? sli_key(seeds[0]) : q->u.pivot;
        q->u.value = F->D[q->u.pivot];
        status = SL_ERR_INACCURATE;
      }
    }
  }
  return status;
}

static sl_status sli_rank_run(sli_rank *q) {
  sl_factor *F = q->u.F;
  const sl_stats before = F->stats;
  const double drift = F->drift;
  sl_status status;
  if (q->count == 0) {
    return SL_OK;
  }
  if (q->has_log) {
    sli_reach R;
    sli_reach_fill(F->S, q->whole_seeds, q->count, q->log_steps, q->u.rows, &R);
    q->logged = R.count;
    sli_rank_log(q, q->logged, 0);
  }
  status = sli_rank_passes(q);
  if (status == SL_OK) {
    F->updates += q->count;
    sli_rank_identify(q);
    return SL_OK;
  }
  if (q->has_log) {
    sli_rank_log(q, q->logged, 1);
    F->stats = before;
    F->drift = drift;
  } else if (q->is_changed) {
    F->is_valid = 0;
    F->status = status;
    F->generation++;
  }
  return sli_fail_at(q->stats, status, F->S->perm[q->u.pivot], -1, q->u.value);
}

static void sli_rank_begin(sli_rank *q, sl_factor *F, sl_stats *stats) {
  const sl_factor_info *info = &F->stats.factor;
  memset(q, 0, sizeof *q);
  q->u.F = F;
  q->stats = stats;
  q->u.sign = info->positive == F->S->n ? 1.0 : info->negative == F->S->n ? -1.0 : 0.0;
  q->u.keeps_signs = q->u.sign != 0.0 || F->rule.regularization != 0.0;
}

static void sli_rank_report(const sli_rank *q, double started, sl_stats *stats) {
  if (stats != NULL) {
    const sl_factor *F = q->u.F;
    sli_factor_stats_copy(&F->stats, stats);
    memset(&stats->change, 0, sizeof stats->change);
    stats->change.method = q->count > 0 ? SL_CHANGE_UPDATE : SL_CHANGE_NONE;
    stats->change.ranks = q->count;
    stats->change.entries = q->entries;
    stats->change.flops_update = q->flops;
    stats->change.updates = F->updates;
    stats->change.drift = F->drift;
    stats->change.seconds = sli_seconds() - started;
  }
}

static const sli_stage sli_rank_stages[2] = {{sli_rank_layout_seeds, sli_rank_sort},
                       {sli_rank_layout, NULL}};

static sl_status sli_rank_apply(sli_rank *q, const sli_stage *stages, int count, sl_work *W) {
  sl_work own = sli_work_own(&q->u.F->allocator);
  sl_status status;
  W = W == NULL ? &own : W;
  status = sli_work_grow(W, 1);
  status = status == SL_OK ? sli_work_stages(W, stages, count, q) : status;
  status = status == SL_OK ? q->status : status;
  status = status == SL_OK ? sli_rank_run(q) : status;
  sli_free(&own.allocator, own.block);
  return status;
}

SL_API sl_status sl_factor_update(sl_factor *F, const sl_csc *V, const double *sigma, sl_work *W,
                  sl_stats *stats) {
  const double started = sli_seconds();
  sli_rank q;
  sl_status status;
  sli_stats_clear_error(stats);
  if (F == NULL || V == NULL) {
    return SL_ERR_ARGUMENT;
  }
  status = sli_rank_check(F);
  status = status == SL_OK ? sl_csc_check(V, stats) : status;
  if (status != SL_OK) {
    return status;
  }
  if (V->n_rows != F->S->n || (sli_nnz(V) > 0 && V->x == NULL)) {
    return SL_ERR_ARGUMENT;
  }
  sli_rank_begin(&q, F, stats);
  q.u.V = V;
  q.u.sigma = sigma;
  status = sli_rank_apply(&q, sli_rank_stages, 2, W);
  if (status == SL_OK) {
    sli_rank_report(&q, started, stats);
  }
  return status;
}

/* src/impl/change/edges.h: changes given by entries of A, as rank-one changes */

static void sli_edges_layout(void *data, sli_block *b) {
  sli_rank *q = (sli_rank *)data;
  const uint64_t count = (uint64_t)q->n_entries;
  q->p = SLI_TAKE(b, sl_int, 3 * count + 1);
  q->i = SLI_TAKE(b, sl_int, 4 * count);
  q->x = SLI_TAKE(b, double, 4 * count);
  q->sigma = SLI_TAKE(b, double, 3 * count);
  q->order = SLI_TAKE(b, uint64_t, 2 * count);
  q->order_scratch = SLI_TAKE(b, uint64_t, 2 * count);
  q->diagonal = SLI_TAKE(b, double, 2 * count);
}

static void sli_edges_add(sli_rank *q, sl_int i, sl_int j, double sigma) {
  sl_int *end = &q->p[q->V.n_cols + 1];
  *end = q->p[q->V.n_cols];
  q->i[*end] = i;
  q->x[(*end)++] = 1.0;
  if (j != -1) {
    q->i[*end] = j;
    q->x[(*end)++] = -1.0;
  }
  q->sigma[q->V.n_cols++] = sigma;
}

static void sli_edges_sort(sli_rank *q) {
  const sl_int *iperm = q->u.F->S->iperm;
  sl_int k, pass;
  for (pass = 0; pass < 2; pass++) {
    for (k = 0; k < q->n_entries; k++) {
      const sl_int e = pass == 0 ? k : sli_value(q->order[k]);
      const sl_int a = iperm[q->entry_rows[e]], b = iperm[q->entry_columns[e]];
      q->order[k] = sli_keyed(pass == 0 ? sli_max(a, b) : sli_min(a, b), e);
    }
    sli_sort(q->order, q->n_entries, q->order_scratch);
  }
}

static sl_int sli_edges_add_all(sli_rank *q) {
  const sl_int *iperm = q->u.F->S->iperm;
  uint64_t *rows = q->order_scratch;
  sl_int k, terms = 0;
  for (k = 0; k < q->n_entries;) {
    const sl_int e = sli_value(q->order[k]);
    const sl_int i = q->entry_rows[e], j = q->entry_columns[e];
    const sl_int low = sli_min(iperm[i], iperm[j]), high = sli_max(iperm[i], iperm[j]);
    double sum = 0.0;
    for (; k < q->n_entries; k++) {
      const sl_int f = sli_value(q->order[k]);
      const sl_int a = iperm[q->entry_rows[f]], b = iperm[q->entry_columns[f]];
      if (sli_min(a, b) != low || sli_max(a, b) != high) {
        break;
      }
      sum += q->deltas[f];
    }
    if (i != j && sum != 0.0) {
      sli_edges_add(q, i, j, -sum);
    }
    rows[terms] = sli_keyed(low, terms);
    q->diagonal[terms++] = sum;
    if (i != j) {
      rows[terms] = sli_keyed(high, terms);
      q->diagonal[terms++] = sum;
    }
  }
  return terms;
}

static void sli_edges_diagonal(sli_rank *q, sl_int terms) {
  uint64_t *rows = q->order_scratch;
  sl_int k;
  sli_sort(rows, terms, q->order);
  for (k = 0; k < terms;) {
    const sl_int row = sli_key(rows[k]);
    double sum = 0.0, size = 0.0;
    for (; k < terms && sli_key(rows[k]) == row; k++) {
      sum += q->diagonal[sli_value(rows[k])];
      size += fabs(q->diagonal[sli_value(rows[k])]);
    }
    if (fabs(sum) > 8.0 * DBL_EPSILON * size) {
      sli_edges_add(q, q->u.F->S->perm[row], -1, sum);
    }
  }
}

static void sli_edges_fill(void *data) {
  sli_rank *q = (sli_rank *)data;
  q->V.n_rows = q->u.F->S->n;
  q->V.n_cols = 0;
  q->V.p = q->p;
  q->V.i = q->i;
  q->V.x = q->x;
  q->p[0] = 0;
  sli_edges_sort(q);
  sli_edges_diagonal(q, sli_edges_add_all(q));
  q->u.V = &q->V;
  q->u.sigma = q->sigma;
}

static const sli_stage sli_edges_stages[3] = {{sli_edges_layout, sli_edges_fill},
                        {sli_rank_layout_seeds, sli_rank_sort},
                        {sli_rank_layout, NULL}};

static sl_status sli_edges_check(const sl_factor *F, const sl_int *rows, const sl_int *columns,
                 const double *deltas, sl_int count, sl_stats *stats) {
  sl_int k;
  if (F == NULL || count < 0 ||
    (count > 0 && (rows == NULL || columns == NULL || deltas == NULL))) {
    return SL_ERR_ARGUMENT;
  }
  if (count > INT32_MAX / 4) {
    return SL_ERR_TOO_LARGE;
  }
  for (k = 0; k < count; k++) {
    if (rows[k] < 0 || rows[k] >= F->S->n || columns[k] < 0 || columns[k] >= F->S->n) {
      return sli_fail_at(stats, SL_ERR_ARGUMENT, rows[k], columns[k], deltas[k]);
    }
    if (!sli_is_finite(deltas[k])) {
      return sli_fail_at(stats, SL_ERR_NOT_FINITE, rows[k], columns[k], deltas[k]);
    }
  }
  return SL_OK;
}

static void sli_edges_begin(sli_rank *q, sl_factor *F, const sl_int *rows, const sl_int *columns,
              const double *deltas, sl_int count, sl_stats *stats) {
  sli_rank_begin(q, F, stats);
  q->entry_rows = rows;
  q->entry_columns = columns;
  q->deltas = deltas;
  q->n_entries = count;
}

SL_API sl_status sl_factor_update_entries(sl_factor *F, const sl_int *rows, const sl_int *columns,
                      const double *deltas, sl_int count, sl_work *W,
                      sl_stats *stats) {
  const double started = sli_seconds();
  sli_rank q;
  sl_status status;
  sli_stats_clear_error(stats);
  status = sli_edges_check(F, rows, columns, deltas, count, stats);
  status = status == SL_OK ? sli_rank_check(F) : status;
  if (status != SL_OK) {
    return status;
  }
  sli_edges_begin(&q, F, rows, columns, deltas, count, stats);
  status = sli_rank_apply(&q, sli_edges_stages, 3, W);
  if (status == SL_OK) {
    sli_rank_report(&q, started, stats);
  }
  return status;
}

/* src/impl/change/choose.h: sl_factor_change: rank-one changes, the reach of the change, or all of L */

#define SLI_CHANGE_ENTRY 0.9e-9
#define SLI_CHANGE_FLOP 0.04e-9
#define SLI_CHANGE_FRONT_FLOP 0.1e-9
#define SLI_CHANGE_FRONT 400e-9
#define SLI_CHANGE_DRIFT 1e-11

typedef struct sli_way {
  sl_int *columns;
  sl_int n_columns;
  uint64_t *seeds, *scratch;
  uint64_t *keys;
  sl_int n_seeds;
  double flops_update, flops_changed, flops_refactor;
  double update, changed, refactor;
  sl_change_reason reason;
} sli_way;

static double sli_way_front(const sl_symbolic *S, sl_int s) {
  const double w = S->steps[s].width, h = w + S->steps[s].below;
  return w * (h * h - h * w + w * w / 3.0);
}

static double sli_way_gather(const sl_symbolic *S, sl_int s) {
  const sl_int start = S->super_first[s], end = S->super_first[s + 1];
  double flops = 0.0;
  sl_int d;
  for (d = s - 1; d >= S->first_descendant[s];) {
    const sl_int *of = S->rows + S->rows_begin[d], below = S->steps[d].below;
    const sl_int first = sli_lower_bound(of, below, start);
    const sl_int m = sli_lower_bound(of + first, below - first, end);
    if (m > 0) {
      flops += (double)S->steps[d].width * m * (2.0 * (below - first) - m);
      d--;
    } else {
      d = S->first_descendant[d] - 1;
    }
  }
  return flops;
}

static void sli_way_measure(sli_way *c, const sl_symbolic *S, int gathers) {
  sl_int k = 0, s, next, fronts = 0;
  double flops = 0.0;
  while (k < c->n_seeds) {
    s = S->super_of[sli_key(c->seeds[k])];
    next = sli_next_seed(S, c->seeds, c->n_seeds, &k);
    for (; s != -1 && s < next; s = S->super_parent[s]) {
      fronts++;
      flops += sli_way_front(S, s) + (gathers ? sli_way_gather(S, s) : 0.0);
    }
  }
  c->flops_changed = flops;
  c->changed = SLI_CHANGE_FRONT_FLOP * flops + SLI_CHANGE_FRONT * fronts;
}

static sl_change_method sli_way_make(sli_way *c, const sl_factor *F, int can_update) {
  const sl_symbolic *S = F->S;
  const int can_reach = F->is_valid && F->method == SL_METHOD_SUPERNODAL &&
              F->storage == SL_STORAGE_DOUBLE;
  c->flops_refactor = S->stats.symbolic.flops;
  c->refactor = SLI_CHANGE_FRONT_FLOP * c->flops_refactor + SLI_CHANGE_FRONT * S->n_supers;
  c->reason = can_update ? SL_CHANGE_CHEAPEST : SL_CHANGE_UNSUITED;
  if (!F->is_valid) {
    return SL_CHANGE_REFACTOR;
  }
  if (F->drift > SLI_CHANGE_DRIFT) {
    c->reason = SL_CHANGE_DRIFT;
    return SL_CHANGE_REFACTOR;
  }
  if (can_reach) {
    sli_way_measure(c, S, 0);
    if (!can_update || c->update > c->changed) {
      sli_way_measure(c, S, 1);
    }
  }
  if (can_update && c->update <= c->refactor && (!can_reach || c->update <= c->changed)) {
    return SL_CHANGE_UPDATE;
  }
  return can_reach && c->changed <= c->refactor ? SL_CHANGE_REACH : SL_CHANGE_REFACTOR;
}

static void sli_way_columns(sli_way *c, const sli_rank *q) {
  const int is_upper = q->u.F->S->stats.symbolic.triangle == SL_TRIANGLE_UPPER;
  sl_int k;
  for (k = 0; k < q->n_entries; k++) {
    const sl_int i = q->entry_rows[k], j = q->entry_columns[k];
    c->keys[k] = sli_keyed(is_upper ? sli_max(i, j) : sli_min(i, j), 0);
  }
  sli_sort(c->keys, q->n_entries, c->keys + q->n_entries);
  c->n_columns = 0;
  for (k = 0; k < q->n_entries; k++) {
    const sl_int column = sli_key(c->keys[k]);
    if (c->n_columns == 0 || c->columns[c->n_columns - 1] != column) {
      c->columns[c->n_columns++] = column;
    }
  }
}

static sl_status sli_way_count(sli_way *c, sli_rank *q, sl_work *W) {
  sl_status status = sli_work_stages(W, sli_edges_stages, 2, q);
  status = status == SL_OK ? q->status : status;
  c->flops_update = q->flops;
  c->update = SLI_CHANGE_ENTRY * (double)q->entries + SLI_CHANGE_FLOP * q->flops;
  c->update *= q->has_trial || q->has_log ? 1.5 : 1.0;
  return status;
}

static sl_status sli_way_run(sli_way *c, sli_rank *q, const sl_csc *A, sl_work *W,
               sl_change_method *method) {
  sl_factor *F = q->u.F;
  const int can_update = sli_rank_is_suited(F) && F->is_valid;
  sl_status status = can_update ? sli_way_count(c, q, W) : SL_OK;
  if (status != SL_OK) {
    return status;
  }
  c->n_seeds = sli_changed_seeds(F->S, A, c->columns, c->n_columns, c->seeds, c->scratch);
  *method = q->n_entries == 0 && F->is_valid ? SL_CHANGE_NONE : sli_way_make(c, F, can_update);
  if (*method == SL_CHANGE_UPDATE) {
    q->status = SL_OK;
    status = sli_rank_apply(q, sli_edges_stages, 3, W);
    if (status == SL_ERR_PIVOT || status == SL_ERR_INACCURATE || status == SL_ERR_NOT_FINITE) {
      c->reason = SL_CHANGE_REFUSED;
      *method = SL_CHANGE_REFACTOR;
    }
  }
  if (*method == SL_CHANGE_REACH) {
    status = sl_factor_refactor_changed(F, A, c->columns, c->n_columns, q->stats);
  } else if (*method == SL_CHANGE_REFACTOR) {
    status = sl_factor_refactor(F, A, q->stats);
  }
  return status;
}

SL_API sl_status sl_factor_change(sl_factor *F, const sl_csc *A, const sl_int *rows,
                  const sl_int *columns, const double *deltas, sl_int count,
                  sl_work *W, sl_stats *stats) {
  const double started = sli_seconds();
  sl_change_method method = SL_CHANGE_NONE;
  sli_block b = {NULL, 0, 0}, seeds = {NULL, 0, 0};
  sli_way c;
  sli_rank q;
  sl_work own;
  uint64_t entries = 0;
  sl_status status;
  sl_int k;
  int pass;
  sli_stats_clear_error(stats);
  status = sli_edges_check(F, rows, columns, deltas, count, stats);
  status = status == SL_OK && !sli_factor_may_change(F) ? SL_ERR_STATE : status;
  status = status == SL_OK ? sli_factor_check(F->S, A) : status;
  if (status != SL_OK) {
    return status;
  }
  memset(&c, 0, sizeof c);
  sli_edges_begin(&q, F, rows, columns, deltas, count, stats);
  for (pass = 0; pass < 2 && status == SL_OK; pass++) {
    c.columns = SLI_TAKE(&b, sl_int, count);
    c.keys = SLI_TAKE(&b, uint64_t, 2 * (uint64_t)count);
    status = pass == 0 ? sli_block_alloc(&b, &F->allocator) : SL_OK;
  }
  if (status != SL_OK) {
    return status;
  }
  sli_way_columns(&c, &q);
  for (k = 0; k < c.n_columns; k++) {
    entries += (uint64_t)(A->p[c.columns[k] + 1] - A->p[c.columns[k]]);
  }
  own = sli_work_own(&F->allocator);
  W = W == NULL ? &own : W;
  for (pass = 0; pass < 2 && status == SL_OK; pass++) {
    c.seeds = SLI_TAKE(&seeds, uint64_t, entries);
    c.scratch = SLI_TAKE(&seeds, uint64_t, entries);
    status = pass == 0 ? sli_block_alloc(&seeds, &F->allocator) : SL_OK;
  }
  status = status == SL_OK ? sli_work_grow(W, 1) : status;
  status = status == SL_OK ? sli_way_run(&c, &q, A, W, &method) : status;
  sli_free(&F->allocator, seeds.base);
  sli_free(&F->allocator, b.base);
  sli_free(&own.allocator, own.block);
  if (status == SL_OK) {
    sli_rank_report(&q, started, stats);
  }
  if (status == SL_OK && stats != NULL) {
    stats->change.method = method;
    stats->change.reason = c.reason;
    stats->change.flops_update = c.flops_update;
    stats->change.flops_changed = c.flops_changed;
    stats->change.flops_refactor = c.flops_refactor;
  }
  return status;
}

/* src/impl/change/pins.h: rows held at given values, and other equalities, without a change of the factor */

typedef struct sli_pin {
  sl_int null;
  double z;
  sl_int count;
  sl_int *rows;
  double *values;
  sli_reach R;
  double *y;
} sli_pin;

struct sl_pins {
  sl_allocator allocator;
  const sl_factor *F;
  sli_numbers numbers;
  double sign;
  double delta;
  double *divisors;
  sl_int count, capacity;
  sli_pin **pins;
  double *K;
  double *scratch;
};

SLI_INLINE double sli_pins_inverse(const sl_pins *P, sl_int column) {
  const double d = P->F->D[column];
  return 1.0 / (P->divisors != NULL && d == SLI_NULL_PIVOT ? P->delta : d);
}

static sl_status sli_pin_null(const sl_factor *F, const sli_reach *R, sl_int *null) {
  const sl_int last = R->count - 1;
  sl_int s, first, count;
  *null = -1;
  if (F->n_nulls == 0) {
    return SL_OK;
  }
  for (s = 0; s < last; s++) {
    if (R->steps[s].up == -1) {
      return SL_ERR_UNSUPPORTED;
    }
  }
  s = F->S->super_of[R->steps[last].column];
  first = sli_lower_bound(F->nulls, F->n_nulls, F->S->super_first[F->S->first_descendant[s]]);
  count = sli_lower_bound(F->nulls, F->n_nulls, F->S->super_first[s + 1]) - first;
  if (count == 0) {
    return SL_OK;
  }
  *null = F->nulls[first];
  return count > 1 || F->null_vectors > 1 || F->g[*null] == 0.0 ? SL_ERR_UNSUPPORTED : SL_OK;
}

static sl_status sli_pin_sweep(const sl_pins *P, sli_pin *pin, double *scratch) {
  const sl_factor *F = P->F;
  const sl_symbolic *S = F->S;
  sl_status status;
  sl_int k;
  memset(pin->y, 0, (size_t)pin->R.columns * sizeof(double));
  for (k = 0; k < pin->count; k++) {
    pin->y[sli_reach_index_of(&pin->R, S->iperm[pin->rows[k]])] += pin->values[k];
  }
  sli_forward_sweep(F, SLI_NRHS_1, pin->R.count, pin->R.steps, pin->R.rows, pin->y, scratch);
  pin->z = 0.0;
  status = sli_pin_null(F, &pin->R, &pin->null);
  if (status == SL_OK && pin->null != -1) {
    for (k = 0; k < pin->count; k++) {
      pin->z += pin->values[k] * F->z[S->iperm[pin->rows[k]]];
    }
    pin->z /= F->z[pin->null];
    pin->y[sli_reach_index_of(&pin->R, pin->null)] = pin->z;
  }
  return status;
}

static sl_status sli_pin_create(sli_pin **out, const sl_pins *P, const sl_int *rows,
                const double *values, sl_int count, sl_stats *stats) {
  const sl_symbolic *S = P->F->S;
  sli_block seeds = {NULL, 0, 0}, kept = {NULL, 0, 0};
  sli_set set = sli_set_of(S, rows, count);
  sli_reach R;
  sli_pin *pin = NULL;
  double *scratch = NULL;
  const sl_int *unused;
  sl_status status = SL_OK;
  int pass;
  for (pass = 0; pass < 2 && status == SL_OK; pass++) {
    sli_set_layout_seeds(&set, &seeds);
    scratch = SLI_TAKE(&seeds, double, sli_sweep_scratch(S->tallest, S->widest, 1));
    status = pass == 0 ? sli_block_alloc(&seeds, &P->allocator) : SL_OK;
  }
  status = status == SL_OK ? sli_set_sort(S, &set, stats) : status;
  if (status == SL_OK) {
    sli_set_measure(S, &set, &R);
  }
  for (pass = 0; pass < 2 && status == SL_OK; pass++) {
    pin = (sli_pin *)sli_take(&kept, 1, sizeof *pin);
    sli_set_layout_reach(&set, &kept, &R);
    if (pass == 1) {
      memset(pin, 0, sizeof *pin);
    }
    {
      sl_int *copy = SLI_TAKE(&kept, sl_int, count);
      double *x = SLI_TAKE(&kept, double, count);
      double *y = SLI_TAKE(&kept, double, R.columns);
      if (pass == 1) {
        pin->rows = copy;
        pin->values = x;
        pin->y = y;
      }
    }
    status = pass == 0 ? sli_block_alloc(&kept, &P->allocator) : SL_OK;
  }
  if (status == SL_OK) {
    pin->count = count;
    memcpy(pin->rows, rows, (size_t)count * sizeof *rows);
    memcpy(pin->values, values, (size_t)count * sizeof *values);
    sli_set_fill(S, &set, &pin->R, &unused);
    status = sli_pin_sweep(P, pin, scratch);
    *out = pin;
  }
  if (status != SL_OK) {
    sli_free(&P->allocator, kept.base);
    *out = NULL;
  }
  sli_free(&P->allocator, seeds.base);
  return status;
}

static void sli_pin_dot(const sl_pins *P, const sli_pin *pin, const sli_reach *R, const double *x,
            sl_int lanes, double *sums) {
  sli_intersection m = sli_intersection_of(&pin->R, R);
  sl_int k, r;
  while (sli_intersection_next(&m)) {
    for (k = 0; k < m.count; k++) {
      const double a = pin->y[m.in_a + k] * sli_pins_inverse(P, m.column + k);
      const double *row = x + (ptrdiff_t)lanes * (m.in_b + k);
      for (r = 0; r < lanes; r++) {
        sums[r] += a * row[r];
      }
    }
  }
}

static void sli_pin_add(const sli_pin *pin, const sli_reach *R, double *x, sl_int lanes,
            const double *f) {
  sli_intersection m = sli_intersection_of(&pin->R, R);
  sl_int k, r;
  while (sli_intersection_next(&m)) {
    for (k = 0; k < m.count; k++) {
      double *row = x + (ptrdiff_t)lanes * (m.in_b + k);
      for (r = 0; r < lanes; r++) {
        row[r] += pin->y[m.in_a + k] * f[r];
      }
    }
  }
}

static sl_status sli_pins_append(sl_pins *P, const sli_pin *pin) {
  const sl_int k = P->count;
  const size_t ld = (size_t)P->capacity;
  double *row = P->K + (size_t)k * ld, own = 0.0, d;
  sl_int i, j;
  sli_pin_dot(P, pin, &pin->R, pin->y, 1, &own);
  d = own;
  for (i = 0; i < k; i++) {
    row[i] = 0.0;
    sli_pin_dot(P, P->pins[i], &pin->R, pin->y, 1, &row[i]);
    for (j = 0; j < i; j++) {
      row[i] -= P->K[(size_t)i * ld + (size_t)j] * row[j];
    }
  }
  for (i = 0; i < k; i++) {
    const double x = row[i];
    row[i] = x / P->K[(size_t)i * ld + (size_t)i];
    d -= x * row[i];
  }
  row[k] = d;
  if (!sli_is_finite(d)) {
    return SL_ERR_NOT_FINITE;
  }
  return d * P->sign > (64.0 + k) * 8.0 * DBL_EPSILON * fabs(own) ? SL_OK : SL_ERR_PIVOT;
}

static void sli_pins_remove(sl_pins *P, sl_int p) {
  const size_t ld = (size_t)P->capacity;
  double *w = P->scratch, alpha = P->K[(size_t)p * ld + (size_t)p];
  sl_int i, j;
  for (i = p + 1; i < P->count; i++) {
    w[i] = P->K[(size_t)i * ld + (size_t)p];
  }
  for (j = p + 1; j < P->count; j++) {
    double *at = &P->K[(size_t)j * ld + (size_t)j];
    const double y = w[j], d = *at, e = d + alpha * y * y, b = alpha * y / e;
    alpha *= d / e;
    *at = e;
    for (i = j + 1; i < P->count; i++) {
      double *l = &P->K[(size_t)i * ld + (size_t)j];
      w[i] -= y * *l;
      *l += b * w[i];
    }
  }
  for (i = p; i + 1 < P->count; i++) {
    double *to = P->K + (size_t)i * ld;
    const double *from = to + ld;
    memmove(to, from, (size_t)p * sizeof *to);
    memmove(to + p, from + p + 1, (size_t)(i + 1 - p) * sizeof *to);
    P->pins[i] = P->pins[i + 1];
  }
  P->count--;
}

static sl_status sli_pins_grow(sl_pins *P) {
  const sl_int capacity = P->capacity < 4 ? 8 : 2 * P->capacity;
  sli_block b = {NULL, 0, 0};
  sli_pin **pins = NULL;
  double *K = NULL, *scratch = NULL;
  sl_status status = SL_OK;
  sl_int i;
  int pass;
  if (P->count < P->capacity) {
    return SL_OK;
  }
  SLI_ASSERT(P->capacity <= INT32_MAX / 4);
  for (pass = 0; pass < 2 && status == SL_OK; pass++) {
    pins = SLI_TAKE(&b, sli_pin *, capacity);
    K = SLI_TAKE(&b, double, (uint64_t)capacity *(uint64_t)capacity);
    scratch = SLI_TAKE(&b, double, 2 * (uint64_t)capacity);
    status = pass == 0 ? sli_block_alloc(&b, &P->allocator) : SL_OK;
  }
  if (status != SL_OK) {
    return status;
  }
  for (i = 0; i < P->count; i++) {
    pins[i] = P->pins[i];
    memcpy(K + (size_t)i * (size_t)capacity, P->K + (size_t)i * (size_t)P->capacity,
         ((size_t)i + 1) * sizeof *K);
  }
  sli_free(&P->allocator, P->pins);
  P->pins = pins;
  P->K = K;
  P->scratch = scratch;
  P->capacity = capacity;
  return SL_OK;
}

static sl_status sli_pins_take(sl_pins *P) {
  const sl_factor *F = P->F;
  const sl_factor_info *info = &F->stats.factor;
  sl_int k;
  if (!F->is_valid) {
    return SL_ERR_STATE;
  }
  if (F->E != NULL || (info->positive > 0 && info->negative > 0)) {
    return SL_ERR_UNSUPPORTED;
  }
  P->sign = info->negative > 0 ? -1.0 : 1.0;
  P->delta = P->sign * (info->pivot_max > 0.0 ? info->pivot_max : 1.0);
  P->numbers = sli_numbers_of(F);
  for (k = 0; P->divisors != NULL && k < F->S->n; k++) {
    P->divisors[k] = F->D[k] == SLI_NULL_PIVOT ? 1.0 : F->D[k];
  }
  return SL_OK;
}

SL_API sl_status sl_pins_create(sl_pins **out, const sl_factor *F, const sl_options *opt) {
  const sl_allocator a = sli_allocator(opt);
  sli_block b = {NULL, 0, 0};
  sl_pins *P = NULL;
  double *divisors = NULL;
  sl_status status = SL_OK;
  int pass;
  if (out == NULL) {
    return SL_ERR_ARGUMENT;
  }
  *out = NULL;
  if (F == NULL || !sli_options_are_valid(opt, SLI_READS_NOTHING)) {
    return SL_ERR_ARGUMENT;
  }
  for (pass = 0; pass < 2 && status == SL_OK; pass++) {
    P = (sl_pins *)sli_take(&b, 1, sizeof *P);
    divisors = F->null_pivots == SL_NULL_PIVOT_SKIP ? SLI_TAKE(&b, double, F->S->n) : NULL;
    status = pass == 0 ? sli_block_alloc(&b, &a) : SL_OK;
  }
  if (status == SL_OK) {
    memset(P, 0, sizeof *P);
    P->allocator = a;
    P->F = F;
    P->divisors = divisors;
    status = sli_pins_take(P);
    if (status == SL_OK) {
      *out = P;
    } else {
      sl_pins_free(P);
    }
  }
  return status;
}

SL_API void sl_pins_free(sl_pins *P) {
  if (P != NULL) {
    const sl_allocator a = P->allocator;
    sl_int k;
    for (k = 0; k < P->count; k++) {
      sli_free(&a, P->pins[k]);
    }
    sli_free(&a, P->pins);
    sli_free(&a, P);
  }
}

SL_API sl_status sl_pins_add_equality(sl_pins *P, const sl_int *rows, const double *values,
                    sl_int count, sl_stats *stats) {
  sli_pin *pin = NULL;
  sl_status status;
  sl_int k;
  sli_stats_clear_error(stats);
  if (P == NULL || count < 1 || rows == NULL || values == NULL) {
    return SL_ERR_ARGUMENT;
  }
  if (!P->F->is_valid || !sli_numbers_are_of(&P->numbers, P->F)) {
    return SL_ERR_STATE;
  }
  for (k = 0; k < count; k++) {
    if (!sli_is_finite(values[k])) {
      return sli_fail_at(stats, SL_ERR_NOT_FINITE, rows[k], -1, values[k]);
    }
  }
  status = sli_pins_grow(P);
  status = status == SL_OK ? sli_pin_create(&pin, P, rows, values, count, stats) : status;
  if (status != SL_OK) {
    return status;
  }
  status = sli_pins_append(P, pin);
  if (status != SL_OK) {
    sli_free(&P->allocator, pin);
    return sli_fail_at(stats, status, rows[0], -1, 0.0);
  }
  P->pins[P->count++] = pin;
  return SL_OK;
}

SL_API sl_status sl_pins_add(sl_pins *P, sl_int row, sl_stats *stats) {
  const double one = 1.0;
  return sl_pins_add_equality(P, &row, &one, 1, stats);
}

SL_API sl_status sl_pins_release(sl_pins *P, sl_int index) {
  sli_pin *pin;
  if (P == NULL || index < 0 || index >= P->count) {
    return SL_ERR_ARGUMENT;
  }
  pin = P->pins[index];
  sli_pins_remove(P, index);
  sli_free(&P->allocator, pin);
  return SL_OK;
}

SL_API sl_int sl_pins_count(const sl_pins *P) {
  return P == NULL ? 0 : P->count;
}

SL_API sl_status sl_pins_refactor(sl_pins *P) {
  sli_block b = {NULL, 0, 0};
  double *scratch = NULL;
  sl_status status;
  sl_int count, k;
  int pass;
  if (P == NULL) {
    return SL_ERR_ARGUMENT;
  }
  status = sli_pins_take(P);
  P->numbers.generation = 0;
  for (pass = 0; pass < 2 && status == SL_OK; pass++) {
    scratch = SLI_TAKE(&b, double, sli_sweep_scratch(P->F->S->tallest, P->F->S->widest, 1));
    status = pass == 0 ? sli_block_alloc(&b, &P->allocator) : SL_OK;
  }
  count = P->count;
  P->count = 0;
  for (k = 0; k < count && status == SL_OK; k++) {
    status = sli_pin_sweep(P, P->pins[k], scratch);
    status = status == SL_OK ? sli_pins_append(P, P->pins[k]) : status;
    P->count++;
  }
  P->count = count;
  P->numbers.generation = status == SL_OK ? P->F->generation : 0;
  sli_free(&P->allocator, b.base);
  return status;
}

typedef struct sli_pins_work {
  unsigned char *memory;
  double *f;
  double *v;
  double *h, *z;
} sli_pins_work;

static void sli_pins_layout(sli_pins_work *w, sli_block *b, const sl_pins *P, const sli_query *q,
              sl_int nrhs) {
  w->memory = (unsigned char *)sli_take(b, sli_vectors_bytes(q, nrhs), 1);
  w->f = SLI_TAKE(b, double, SLI_TILE *(uint64_t)P->count);
  w->v = SLI_TAKE(b, double, SLI_TILE *(uint64_t)P->count);
  w->h = SLI_TAKE(b, double, P->count);
  w->z = SLI_TAKE(b, double, P->count);
}

static void sli_pins_apply(const sl_pins *P, double *f, sl_int lanes) {
  const size_t ld = (size_t)P->capacity;
  sl_int i, j, r;
  for (i = 0; i < P->count; i++) {
    for (j = 0; j < i; j++) {
      for (r = 0; r < lanes; r++) {
        f[i * lanes + r] -= P->K[(size_t)i * ld + (size_t)j] * f[j * lanes + r];
      }
    }
  }
  for (i = P->count - 1; i >= 0; i--) {
    for (r = 0; r < lanes; r++) {
      f[i * lanes + r] /= P->K[(size_t)i * ld + (size_t)i];
    }
    for (j = i + 1; j < P->count; j++) {
      for (r = 0; r < lanes; r++) {
        f[i * lanes + r] -= P->K[(size_t)j * ld + (size_t)i] * f[j * lanes + r];
      }
    }
  }
}

static void sli_pins_balance(const sl_pins *P, const sli_query *q, const sli_pins_work *w, sl_int p,
               const double *y, sl_int lanes) {
  const sl_int null = P->pins[p]->null, at = sli_reach_index_of(&q->forward, null);
  double *v = w->v + p * lanes;
  double s = 0.0;
  sl_int k, r;
  for (k = 0; k < P->count; k++) {
    w->z[k] = w->h[k] = P->pins[k]->null == null ? P->pins[k]->z : 0.0;
  }
  sli_pins_apply(P, w->h, 1);
  for (r = 0; r < lanes; r++) {
    v[r] = at == -1 ? 0.0 : y[(ptrdiff_t)at * lanes + r];
  }
  for (k = 0; k < P->count; k++) {
    s += w->z[k] * w->h[k];
    for (r = 0; r < lanes; r++) {
      v[r] += w->z[k] * w->f[k * lanes + r];
    }
  }
  for (r = 0; r < lanes; r++) {
    v[r] = s != 0.0 ? v[r] / s : 0.0;
  }
  for (k = 0; k < P->count; k++) {
    for (r = 0; r < lanes; r++) {
      w->f[k * lanes + r] -= w->h[k] * v[r];
    }
  }
}

static int sli_pins_is_first(const sl_pins *P, sl_int p) {
  sl_int k = 0;
  while (P->pins[k]->null != P->pins[p]->null) {
    k++;
  }
  return k == p && P->pins[p]->null != -1;
}

static void sli_pins_shift(const sl_pins *P, const sli_query *q, const sli_pins_work *w, double *x,
               sl_int lanes) {
  sl_int m, p, at;
  for (m = 0; m < P->F->n_nulls; m++) {
    at = sli_reach_index_of(&q->backward, P->F->nulls[m]);
    if (at != -1) {
      memset(x + (ptrdiff_t)at * lanes, 0, (size_t)lanes * sizeof(double));
    }
  }
  for (p = 0; p < P->count; p++) {
    if (sli_pins_is_first(P, p)) {
      at = sli_reach_index_of(&q->backward, P->pins[p]->null);
      if (at != -1) {
        memcpy(x + (ptrdiff_t)at * lanes, w->v + p * lanes, (size_t)lanes * sizeof(double));
      }
    }
  }
}

static void sli_pins_block(const sl_pins *P, const sli_query *q, const sli_pins_work *w, double *X,
               sli_dense x_at, const double *B, sli_dense b_at, const double *G,
               size_t ldg, sl_int nrhs) {
  const sl_factor *F = P->F;
  const sli_vectors v = sli_vectors_of(q, nrhs, w->memory);
  const int kind = sli_lanes_kind(nrhs);
  const sl_int lanes = (sl_int)1 << kind;
  sl_int p, r;
  sli_pack(q, v.y, B, b_at, lanes, nrhs);
  sli_sweep_forward(F, q, &v, nrhs);
  for (p = 0; p < P->count; p++) {
    double sums[SLI_TILE] = {0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0};
    sli_pin_dot(P, P->pins[p], &q->forward, v.y, lanes, sums);
    for (r = 0; r < lanes; r++) {
      w->f[p * lanes + r] = r < nrhs ? G[(size_t)p + ldg * (size_t)r] - sums[r] : 0.0;
    }
  }
  sli_pins_apply(P, w->f, lanes);
  for (p = 0; p < P->count; p++) {
    if (sli_pins_is_first(P, p)) {
      sli_pins_balance(P, q, w, p, v.y, lanes);
    }
  }
  if (!q->is_shared) {
    sli_sweep_transfer(q, v.y, v.x, lanes);
  }
  for (p = 0; p < P->count; p++) {
    sli_pin_add(P->pins[p], &q->backward, v.x, lanes, w->f + p * lanes);
  }
  sli_pins_shift(P, q, w, v.x, lanes);
  sli_backward_sweep(F, kind, q->backward.count, q->backward.steps,
             q->backward.rows + q->backward.n_rows,
             P->divisors != NULL ? P->divisors : F->D, v.x, v.scratch);
  sli_unpack(q, X, x_at, v.x, lanes, nrhs);
}

SL_API sl_status sl_pins_solve(const sl_pins *P, const sl_plan *plan, double *X, size_t ldx,
                 const double *B, size_t ldb, const double *G, size_t ldg,
                 sl_int nrhs, sl_work *W) {
  sli_block counted = {NULL, 0, 0};
  sli_pins_work w;
  sli_query all;
  const sli_query *q = plan == NULL ? &all : &plan->query;
  sl_work own;
  sl_status status;
  sl_int r;
  if (P == NULL) {
    return SL_ERR_ARGUMENT;
  }
  all = sli_query_all(P->F->S);
  status = sli_check_dense(X, ldx, q->nx, B, ldb, q->nb, SLI_COLUMN_MAJOR, nrhs);
  if (status != SL_OK || (nrhs > 0 && P->count > 0 && (G == NULL || ldg < (size_t)P->count))) {
    return SL_ERR_ARGUMENT;
  }
  if (!sli_numbers_are_of(&P->numbers, P->F) || !sli_query_fits(q, P->F)) {
    return SL_ERR_STATE;
  }
  if (q->region != NULL) {
    return SL_ERR_UNSUPPORTED;
  }
  if (nrhs == 0 || q->nx == 0) {
    return SL_OK;
  }
  own = sli_work_own(&P->allocator);
  W = W == NULL ? &own : W;
  sli_pins_layout(&w, &counted, P, q, nrhs);
  status = sli_work_block(W, &counted);
  if (status == SL_OK) {
    sli_pins_layout(&w, &counted, P, q, nrhs);
    for (r = 0; r < nrhs; r += 8) {
      const sl_int block = sli_min(8, nrhs - r);
      sli_pins_block(P, q, &w, X + (size_t)r * ldx, sli_dense_of(SLI_COLUMN_MAJOR, ldx),
               q->nb == 0 ? B : B + (size_t)r * ldb,
               sli_dense_of(SLI_COLUMN_MAJOR, ldb),
               P->count == 0 ? G : G + (size_t)r * ldg, ldg, block);
    }
  }
  sli_free(&own.allocator, own.block);
  return status;
}

/* src/impl/change/subset.h: a set of rows of A as a sorted list of columns of L, and a map from columns to ranks */

#define SLI_PAGE_BITS 4
#define SLI_PAGE_COLUMNS (1 << SLI_PAGE_BITS)
#define SLI_PAGES_PER_COLUMN 8

typedef struct sli_subset {
  sl_int count;
  sl_int *columns;
  sl_int *row_of;
  sl_int n_pages, most_pages;
  int is_hashed;
  int shift;
  uint32_t mask;
  sl_int *slots;
  sl_int *numbers;
  sl_int *ranks;
} sli_subset;

static void sli_subset_layout(sli_subset *R, sli_block *b, sl_int n) {
  const sl_int pages = n / SLI_PAGE_COLUMNS + 1;
  const sl_off count = R->count;
  int bits = 1;
  R->most_pages = sli_min(R->count, pages);
  R->is_hashed = pages > SLI_PAGES_PER_COLUMN * count;
  while (((sl_off)1 << bits) < (R->is_hashed ? 2 * count : pages)) {
    bits++;
  }
  R->mask = ((uint32_t)1 << bits) - 1;
  R->shift = 32 - bits;
  R->columns = SLI_TAKE(b, sl_int, R->count);
  R->row_of = SLI_TAKE(b, sl_int, R->count);
  R->slots = SLI_TAKE(b, sl_int, R->is_hashed ? (uint64_t)R->mask + 1 : (uint64_t)pages);
  R->numbers = SLI_TAKE(b, sl_int, R->most_pages);
  R->ranks = SLI_TAKE(b, sl_int, (uint64_t)R->most_pages * SLI_PAGE_COLUMNS);
}

SLI_INLINE sl_int *sli_subset_slot(const sli_subset *R, sl_int page) {
  uint32_t k;
  if (!R->is_hashed) {
    return &R->slots[page];
  }
  k = ((uint32_t)page * 2654435769u) >> R->shift;
  while (R->slots[k] != -1 && R->numbers[R->slots[k]] != page) {
    k = (k + 1) & R->mask;
  }
  return &R->slots[k];
}

SLI_INLINE sl_int sli_subset_find(const sli_subset *R, sl_int column) {
  const sl_int at = *sli_subset_slot(R, column >> SLI_PAGE_BITS);
  return at == -1 ? -1 : R->ranks[(ptrdiff_t)at * SLI_PAGE_COLUMNS + column % SLI_PAGE_COLUMNS];
}

static sl_int *sli_subset_place(sli_subset *R, sl_int column) {
  sl_int *slot = sli_subset_slot(R, column >> SLI_PAGE_BITS);
  if (*slot == -1) {
    sl_int *page = R->ranks + (ptrdiff_t)R->n_pages * SLI_PAGE_COLUMNS;
    sl_int m;
    *slot = R->n_pages;
    R->numbers[R->n_pages++] = column >> SLI_PAGE_BITS;
    for (m = 0; m < SLI_PAGE_COLUMNS; m++) {
      page[m] = -1;
    }
  }
  return &R->ranks[(ptrdiff_t)*slot * SLI_PAGE_COLUMNS + column % SLI_PAGE_COLUMNS];
}

SLI_INLINE void sli_subset_append(sli_subset *R, sl_int rank, sl_int column, sl_int *place) {
  R->columns[rank] = column;
  R->row_of[rank] = *place;
  *place = rank;
}

static sl_status sli_subset_fill(sli_subset *R, const sl_symbolic *S, const sl_int *rows,
                 uint64_t *list, uint64_t *scratch, sl_stats *stats) {
  const sl_int pages = S->n / SLI_PAGE_COLUMNS + 1;
  sl_int k, m, rank = 0;
  R->n_pages = 0;
  memset(R->slots, 0xff,
       (R->is_hashed ? (size_t)R->mask + 1 : (size_t)pages) * sizeof(sl_int));
  for (k = 0; k < R->count; k++) {
    const sl_int row = rows[k];
    sl_int *place = row < 0 || row >= S->n ? NULL : sli_subset_place(R, S->iperm[row]);
    if (place == NULL || *place != -1) {
      return sli_fail_at(stats, SL_ERR_ARGUMENT, row, -1, 0.0);
    }
    *place = k;
    list[k] = sli_keyed(S->iperm[row], k);
  }
  if (R->is_hashed) {
    sli_sort(list, R->count, scratch);
  }
  for (k = 0; k < R->count && R->is_hashed; k++) {
    sli_subset_append(R, rank++, sli_key(list[k]), sli_subset_place(R, sli_key(list[k])));
  }
  for (k = 0; k < pages && !R->is_hashed; k++) {
    for (m = 0; m < SLI_PAGE_COLUMNS && R->slots[k] != -1; m++) {
      sl_int *place = R->ranks + (ptrdiff_t)R->slots[k] * SLI_PAGE_COLUMNS + m;
      if (*place != -1) {
        sli_subset_append(R, rank++, k * SLI_PAGE_COLUMNS + m, place);
      }
    }
  }
  return SL_OK;
}

/* src/impl/change/restrict_analysis.h: the analysis of A[R, R] from that of A: new for columns with a removed */

typedef struct sli_restriction {
  const sl_symbolic *S;
  const sl_csc *A;
  const sl_int *rows;
  sli_subset R;
  uint64_t *list, *scratch;

  sl_int n_kept;
  sl_int *kept;
  sl_int *first_rank;
  sl_int *kept_new;
  sl_int *next;
  sl_int n_fresh;
  sl_int *fresh;
  sl_int *fresh_of;
  sl_int *number_of;

  sl_off *below_begin;
  sl_int *below;
  sl_relaxation relaxation;
  sl_int n_entries;
  sl_int *entry_row, *entry_column;
  sl_int *entry_from;

  sli_analysis w;
  sl_symbolic T;
  sl_int *T_new, *head;
  sl_int *column_of;
  sl_off copied;
  void *blocks[4];
} sli_restriction;

static void sli_restriction_free(sli_restriction *r, const sl_allocator *a) {
  int k;
  for (k = 0; k < 4; k++) {
    sli_free(a, r->blocks[k]);
  }
}

SLI_INLINE sl_int sli_restriction_size(const sli_restriction *r, sl_int root) {
  return r->kept[root] - r->S->first_descendant[r->kept[root]] + 1;
}

SLI_INLINE int sli_restriction_is_root(const sli_restriction *r, sl_int q) {
  const sl_int up = r->S->super_parent[r->kept[q]];
  const sl_int rank = up == -1 ? -1 : sli_subset_find(&r->R, r->S->super_first[up]);
  return rank == -1 || r->fresh_of[rank] != -1;
}

static void sli_restriction_split(sli_restriction *r) {
  const sl_symbolic *S = r->S;
  const sl_int *columns = r->R.columns;
  sl_int k = 0;
  while (k < r->R.count) {
    const sl_int s = S->super_of[columns[k]], end = S->super_first[s + 1];
    const sl_int low = S->super_first[S->first_descendant[s]];
    const sl_int last = sli_min(k + (end - S->super_first[s]), r->R.count) - 1;
    const sl_int first = last + 1 - (end - low);
    if (columns[last] == end - 1 && first >= 0 && columns[first] == low) {
      r->kept[r->n_kept] = s;
      r->first_rank[r->n_kept++] = k;
      for (; k <= last; k++) {
        r->fresh_of[k] = -1;
      }
    } else {
      for (; k < r->R.count && columns[k] < end; k++) {
        r->fresh_of[k] = r->n_fresh;
        r->fresh[r->n_fresh++] = k;
      }
    }
  }
}

static void sli_restriction_filter(sli_restriction *r) {
  const sl_symbolic *S = r->S;
  sl_off at = 0, p;
  sl_int q;
  for (q = 0; q < r->n_kept; q++) {
    r->below_begin[q] = at;
    for (p = S->rows_begin[r->kept[q]]; p < S->rows_begin[r->kept[q] + 1]; p++) {
      const sl_int rank = sli_subset_find(&r->R, S->rows[p]);
      if (rank != -1) {
        r->below[at++] = rank;
      }
    }
  }
  r->below_begin[q] = at;
}

SLI_INLINE void sli_restriction_enter(sli_restriction *r, sl_int a, sl_int b, sl_int from) {
  r->entry_row[r->n_entries] = sli_max(a, b);
  r->entry_column[r->n_entries] = sli_min(a, b);
  r->entry_from[r->n_entries++] = from;
}

static void sli_restriction_graph(sli_restriction *r) {
  const sl_csc *A = r->A;
  const sl_triangle triangle = r->S->stats.symbolic.triangle;
  sl_int q, k, p;
  sl_off at;
  for (q = 0; q < r->n_kept; q++) {
    if (sli_restriction_is_root(r, q)) {
      for (at = r->below_begin[q] + 1; at < r->below_begin[q + 1]; at++) {
        sli_restriction_enter(r, r->fresh_of[r->below[at]],
                    r->fresh_of[r->below[r->below_begin[q]]], -1);
      }
    }
  }
  for (k = 0; k < r->R.count; k++) {
    const sl_int j = r->rows[k], own = r->number_of[k];
    for (p = own == -1 ? A->p[j + 1] : A->p[j]; p < A->p[j + 1]; p++) {
      const sl_int i = A->i[p];
      const sl_int rank =
        sli_is_read(triangle, i, j) ? sli_subset_find(&r->R, r->S->iperm[i]) : -1;
      if (rank != -1 && r->fresh_of[rank] != -1) {
        sli_restriction_enter(r, r->fresh_of[rank], own, p);
      }
    }
  }
}

static sl_status sli_restriction_column(const sl_csc *A, sl_int j, sl_stats *stats) {
  const sl_int end = A->p[j + 1];
  sl_int p = A->p[j];
  if (p < 0 || end < p || end > sli_nnz(A)) {
    return sli_fail_at(stats, SL_ERR_PATTERN, -1, j, 0.0);
  }
  for (; p < end; p++) {
    if (A->i[p] < 0 || A->i[p] >= A->n_rows) {
      return sli_fail_at(stats, SL_ERR_PATTERN, A->i[p], j, 0.0);
    }
  }
  return SL_OK;
}

static sl_status sli_restriction_room(sli_restriction *r, const sl_allocator *a, sl_stats *stats) {
  const sl_symbolic *S = r->S;
  uint64_t rows = 0, entries = 0;
  sli_block b = {NULL, 0, 0};
  sl_status status = SL_OK;
  sl_int q, k;
  int pass;
  for (q = 0; q < r->n_kept; q++) {
    const sl_off here = S->rows_begin[r->kept[q] + 1] - S->rows_begin[r->kept[q]];
    rows += (uint64_t)here;
    entries += sli_restriction_is_root(r, q) ? (uint64_t)here : 0;
  }
  for (k = 0; k < r->R.count; k++) {
    r->number_of[r->R.row_of[k]] = r->fresh_of[k];
  }
  for (k = 0; k < r->R.count; k++) {
    const sl_int j = r->rows[k];
    if (r->number_of[k] != -1) {
      status = sli_restriction_column(r->A, j, stats);
      if (status != SL_OK) {
        return status;
      }
      entries += (uint64_t)(r->A->p[j + 1] - r->A->p[j]);
    }
  }
  if (entries > INT32_MAX) {
    return SL_ERR_TOO_LARGE;
  }
  for (pass = 0; pass < 2 && status == SL_OK; pass++) {
    r->below_begin = SLI_TAKE(&b, sl_off, (uint64_t)r->n_kept + 1);
    r->below = SLI_TAKE(&b, sl_int, rows);
    r->entry_row = SLI_TAKE(&b, sl_int, entries);
    r->entry_column = SLI_TAKE(&b, sl_int, entries);
    r->entry_from = SLI_TAKE(&b, sl_int, entries);
    status = pass == 0 ? sli_block_alloc(&b, a) : SL_OK;
  }
  r->blocks[1] = b.base;
  return status;
}

static void sli_restriction_sort(sli_restriction *r) {
  sli_pattern *rows = &r->w.rows, *columns = &r->w.columns;
  const size_t bytes = ((size_t)r->n_fresh + 1) * sizeof(sl_int);
  sl_int e;
  memset(rows->begin, 0, bytes);
  memset(columns->begin, 0, bytes);
  for (e = 0; e < r->n_entries; e++) {
    rows->begin[r->entry_row[e]]++;
    columns->begin[r->entry_column[e]]++;
  }
  sli_pattern_starts(rows, r->n_fresh);
  sli_pattern_starts(columns, r->n_fresh);
  for (e = 0; e < r->n_entries; e++) {
    const sl_int at = rows->begin[r->entry_row[e]]++;
    rows->to[at] = r->entry_column[e];
    rows->from[at] = r->entry_from[e];
    columns->to[columns->begin[r->entry_column[e]]++] = r->entry_row[e];
  }
  memmove(rows->begin + 1, rows->begin, bytes - sizeof(sl_int));
  memmove(columns->begin + 1, columns->begin, bytes - sizeof(sl_int));
  rows->begin[0] = columns->begin[0] = 0;
}

static sl_status sli_restriction_analyze(sli_restriction *r, const sl_allocator *a,
                     sl_stats *stats) {
  sli_analysis *w = &r->w;
  sl_symbolic *T = &r->T;
  sl_options given = sli_options_with(a);
  sli_block b = {NULL, 0, 0};
  sl_status status = SL_OK;
  uint64_t rows = 0;
  sl_int t;
  int pass;
  for (pass = 0; pass < 2 && status == SL_OK; pass++) {
    sli_analysis_layout(w, &b, r->n_fresh, r->n_entries);
    status = pass == 0 ? sli_block_alloc(&b, a) : SL_OK;
  }
  r->blocks[2] = b.base;
  if (status != SL_OK) {
    return status;
  }
  sli_restriction_sort(r);
  given.ordering = SL_ORDERING_GIVEN;
  given.relaxation = r->relaxation;
  sli_analyze_tree(w, &given, stats);
  T->n = r->n_fresh;
  T->n_supers = w->amalgamation.count;
  T->super_of = w->super_of;
  T->super_first = w->amalgamation.first;
  T->super_parent = w->amalgamation.parent;
  for (t = 0; t < T->n_supers; t++) {
    rows += (uint64_t)w->amalgamation.below[t];
  }
  memset(&b, 0, sizeof b);
  for (pass = 0; pass < 2 && status == SL_OK; pass++) {
    T->rows_begin = SLI_TAKE(&b, sl_off, (uint64_t)T->n_supers + 1);
    T->rows = SLI_TAKE(&b, sl_int, rows);
    T->panel_begin = SLI_TAKE(&b, sl_off, (uint64_t)T->n_supers + 1);
    T->scatter_begin = SLI_TAKE(&b, sl_off, (uint64_t)T->n_supers + 1);
    T->scatter_from = SLI_TAKE(&b, sl_int, r->n_entries);
    T->scatter_to = SLI_TAKE(&b, sl_off, r->n_entries);
    r->T_new = SLI_TAKE(&b, sl_int, T->n_supers);
    r->head = SLI_TAKE(&b, sl_int, (uint64_t)T->n_supers + 1);
    status = pass == 0 ? sli_block_alloc(&b, a) : SL_OK;
  }
  r->blocks[3] = b.base;
  if (status != SL_OK) {
    return status;
  }
  T->rows_begin[0] = T->panel_begin[0] = 0;
  for (t = 0; t < T->n_supers; t++) {
    const sl_int below = w->amalgamation.below[t];
    T->rows_begin[t + 1] = T->rows_begin[t] + below;
    T->panel_begin[t + 1] = T->panel_begin[t] + sli_panel_size(w->amalgamation.width[t], below);
  }
  sli_scatter_map_count(T, &w->columns, w->old_of);
  sli_fill_structure(T, &w->rows, w->old_of, w->new_of, NULL, (sl_off *)(void *)w->list,
             (sl_int *)(void *)(w->list + T->n));
  return SL_OK;
}

static sl_status sli_restriction_begin(sli_restriction *r, const sl_allocator *a, sl_stats *stats) {
  const uint64_t count = (uint64_t)r->R.count;
  sli_block b = {NULL, 0, 0};
  sl_status status = SL_OK;
  int pass;
  for (pass = 0; pass < 2 && status == SL_OK; pass++) {
    sli_subset_layout(&r->R, &b, r->S->n);
    r->list = SLI_TAKE(&b, uint64_t, count);
    r->scratch = SLI_TAKE(&b, uint64_t, count);
    r->kept = SLI_TAKE(&b, sl_int, count);
    r->first_rank = SLI_TAKE(&b, sl_int, count);
    r->kept_new = SLI_TAKE(&b, sl_int, count);
    r->next = SLI_TAKE(&b, sl_int, count);
    r->fresh = SLI_TAKE(&b, sl_int, count);
    r->fresh_of = SLI_TAKE(&b, sl_int, count);
    r->number_of = SLI_TAKE(&b, sl_int, count);
    r->column_of = SLI_TAKE(&b, sl_int, count);
    status = pass == 0 ? sli_block_alloc(&b, a) : SL_OK;
  }
  r->blocks[0] = b.base;
  status = status == SL_OK ? sli_subset_fill(&r->R, r->S, r->rows, r->list, r->scratch, stats)
               : status;
  if (status == SL_OK) {
    sli_restriction_split(r);
  }
  return status;
}

static sl_status sli_restriction_run(sli_restriction *r, const sl_allocator *a, sl_stats *found,
                   sl_stats *stats) {
  const sl_status status = sli_restriction_room(r, a, stats);
  if (status != SL_OK) {
    return status;
  }
  sli_restriction_filter(r);
  sli_restriction_graph(r);
  return sli_restriction_analyze(r, a, found);
}

/* src/impl/change/restrict_anew.h: the factor of A[R, R] where too little of L can be kept: extracts it first */

static sl_status sli_restrict_matrix(sl_matrix **M, sli_restriction *r, const sl_allocator *a,
                   sl_stats *stats) {
  sl_int k, e, *begin;
  sl_status status;
  r->n_kept = 0;
  r->n_fresh = r->R.count;
  for (k = 0; k < r->R.count; k++) {
    r->fresh_of[k] = r->R.row_of[k];
  }
  status = sli_restriction_room(r, a, stats);
  if (status != SL_OK) {
    return status;
  }
  sli_restriction_graph(r);
  status = sli_matrix_new(M, r->R.count, r->R.count, r->n_entries, 1, a);
  if (status != SL_OK) {
    return status;
  }
  begin = (*M)->p;
  memset(begin, 0, ((size_t)r->R.count + 1) * sizeof(sl_int));
  for (e = 0; e < r->n_entries; e++) {
    begin[r->entry_column[e] + 1]++;
  }
  for (k = 0; k < r->R.count; k++) {
    begin[k + 1] += begin[k];
    r->next[k] = begin[k];
  }
  for (e = 0; e < r->n_entries; e++) {
    const sl_int at = r->next[r->entry_column[e]]++;
    (*M)->i[at] = r->entry_row[e];
    (*M)->x[at] = r->A->x[r->entry_from[e]];
  }
  return SL_OK;
}

static sl_status sli_restrict_anew(sl_symbolic **S, sl_factor **G, sli_restriction *r,
                   const sl_options *rules, sl_stats *stats) {
  sl_options given = sli_options_with(&rules->allocator);
  sl_matrix *M = NULL;
  sl_csc B;
  sl_status status = sli_restrict_matrix(&M, r, &rules->allocator, stats);
  if (status == SL_OK) {
    B = sl_matrix_view(M);
    given.ordering = SL_ORDERING_GIVEN;
    given.perm = r->R.row_of;
    status = sl_symbolic_create(S, &B, &given, NULL);
    status = status == SL_OK ? sl_factor_create(G, *S, &B, rules, stats) : status;
    sl_matrix_free(M);
  }
  return status;
}

/* src/impl/change/restrict_symbolic.h: joins kept subtrees and new supernodes to the analysis of A[R, R] */

typedef struct sli_joint {
  sl_symbolic *S;
  sl_int super, column;
  sl_off rows, panel;
} sli_joint;

static void sli_joint_add(sli_joint *j, sl_int width, sl_off below) {
  sl_symbolic *S = j->S;
  sl_int k;
  S->super_first[j->super] = j->column;
  S->rows_begin[j->super] = j->rows;
  S->panel_begin[j->super] = j->panel;
  for (k = 0; k < width; k++) {
    S->super_of[j->column++] = j->super;
  }
  j->rows += below;
  j->panel += sli_panel_size(width, (sl_int)below);
  j->super++;
}

static void sli_joint_add_kept(sli_joint *j, sli_restriction *r, sl_int root) {
  for (; root != -1; root = r->next[root]) {
    sl_int q, k;
    for (q = root + 1 - sli_restriction_size(r, root); q <= root; q++) {
      const sl_int s = r->kept[q], width = r->S->super_first[s + 1] - r->S->super_first[s];
      for (k = 0; k < width; k++) {
        r->column_of[r->first_rank[q] + k] = j->column + k;
      }
      r->kept_new[q] = j->super;
      sli_joint_add(j, width, r->below_begin[q + 1] - r->below_begin[q]);
    }
  }
}

static void sli_joint_number(sli_joint *j, sli_restriction *r) {
  const sl_symbolic *T = &r->T;
  sl_int q, t, k;
  for (t = 0; t <= T->n_supers; t++) {
    r->head[t] = -1;
  }
  for (q = r->n_kept - 1; q >= 0; q--) {
    if (sli_restriction_is_root(r, q)) {
      t = T->n_supers;
      if (r->below_begin[q] < r->below_begin[q + 1]) {
        t = T->super_of[r->w.new_of[r->fresh_of[r->below[r->below_begin[q]]]]];
      }
      r->next[q] = r->head[t];
      r->head[t] = q;
    }
  }
  sli_joint_add_kept(j, r, r->head[T->n_supers]);
  for (t = 0; t < T->n_supers; t++) {
    const sl_int first = T->super_first[t], width = T->super_first[t + 1] - first;
    sli_joint_add_kept(j, r, r->head[t]);
    for (k = 0; k < width; k++) {
      r->column_of[r->fresh[r->w.old_of[first + k]]] = j->column + k;
    }
    r->T_new[t] = j->super;
    sli_joint_add(j, width, T->rows_begin[t + 1] - T->rows_begin[t]);
  }
  j->S->super_first[j->super] = j->column;
  j->S->rows_begin[j->super] = j->rows;
  j->S->panel_begin[j->super] = j->panel;
}

static void sli_joint_fill_kept(sl_symbolic *S, const sli_restriction *r, sl_int q) {
  const sl_symbolic *from = r->S;
  const sl_int s = r->kept[q], to = r->kept_new[q], up = from->super_parent[s];
  const sl_int first = from->super_first[s], end = from->super_first[s + 1];
  const sl_int base = S->super_first[to] - first;
  const sl_off begin = S->rows_begin[to];
  const sl_int below = (sl_int)(S->rows_begin[to + 1] - begin);
  sl_int k;
  for (k = 0; k < below; k++) {
    S->rows[begin + k] = r->column_of[r->below[r->below_begin[q] + k]];
  }
  S->super_parent[to] = below == 0 ? -1 : S->super_of[S->rows[begin]];
  SLI_ASSERT(up == -1 || sli_restriction_is_root(r, q) || S->super_parent[to] == to + up - s);
  for (k = first; k < end; k++) {
    const sl_int parent = from->parent[k];
    const sl_int rank = parent < end ? -1 : sli_subset_find(&r->R, parent);
    S->parent[k + base] = parent != -1 && parent < end ? parent + base
                : rank != -1                 ? r->column_of[rank]
                : below > 0                  ? S->rows[begin]
                               : -1;
    S->counts[k + base] = sli_min(from->counts[k], end - k + below);
  }
  (void)up;
}

static void sli_joint_fill_fresh(sl_symbolic *S, const sli_restriction *r, sl_int t, sl_off *at) {
  const sl_symbolic *T = &r->T;
  const sl_int to = r->T_new[t], base = S->super_first[to] - T->super_first[t];
  const sl_int *old_of = r->w.old_of;
  sl_off p;
  sl_int k;
  for (p = 0; p < T->rows_begin[t + 1] - T->rows_begin[t]; p++) {
    S->rows[S->rows_begin[to] + p] =
      r->column_of[r->fresh[old_of[T->rows[T->rows_begin[t] + p]]]];
  }
  S->super_parent[to] = T->super_parent[t] == -1 ? -1 : r->T_new[T->super_parent[t]];
  for (k = T->super_first[t]; k < T->super_first[t + 1]; k++) {
    const sl_int parent = r->w.parent[k];
    S->parent[k + base] = parent == -1 ? -1 : r->column_of[r->fresh[old_of[parent]]];
    S->counts[k + base] = r->w.counts[k];
  }
  for (p = T->scatter_begin[t]; p < T->scatter_begin[t + 1]; p++) {
    if (T->scatter_from[p] != -1) {
      S->scatter_from[*at] = T->scatter_from[p];
      S->scatter_to[(*at)++] = T->scatter_to[p] - T->panel_begin[t] + S->panel_begin[to];
    }
  }
}

static void sli_joint_fill(sl_symbolic *S, sli_restriction *r, sl_stats *stats) {
  sl_int *scratch = (sl_int *)(void *)r->list;
  sl_int s, q, k;
  sl_off at = 0;
  for (k = 0; k < S->n; k++) {
    S->perm[r->column_of[k]] = r->R.row_of[k];
  }
  for (k = 0; k < S->n; k++) {
    S->iperm[S->perm[k]] = k;
  }
  for (q = 0; q < r->n_kept; q++) {
    sli_joint_fill_kept(S, r, q);
  }
  memset(S->scatter_begin, 0, ((size_t)S->n_supers + 1) * sizeof(sl_off));
  for (q = 0; q < r->T.n_supers; q++) {
    const sl_off before = at;
    sli_joint_fill_fresh(S, r, q, &at);
    S->scatter_begin[r->T_new[q] + 1] = at - before;
  }
  for (s = 0; s < S->n_supers; s++) {
    S->scatter_begin[s + 1] += S->scatter_begin[s];
  }
  sli_fill_steps(S);
  sli_fill_descendants(S);
  sli_fill_relative(S, scratch);
  sli_fill_identity(S, stats->symbolic.triangle);
  stats->symbolic.nnz_a = at;
  sli_analyze_stats(S, scratch, stats);
}

static sl_status sli_joint_make(sl_symbolic **out, sli_restriction *r, const sl_allocator *a,
                sl_stats *stats) {
  sl_symbolic draft;
  sli_block b = {NULL, 0, 0};
  sli_joint j;
  sl_status status = SL_OK;
  int pass;
  memset(&draft, 0, sizeof draft);
  draft.allocator = *a;
  draft.n = r->R.count;
  draft.n_supers = r->n_kept + r->T.n_supers;
  draft.nnz_input = -1;
  draft.pattern = sli_hash_ints(r->S->identity, r->rows, r->R.count);
  draft.is_pivoted = r->S->is_pivoted;
  draft.is_partial = 1;
  for (pass = 0; pass < 2 && status == SL_OK; pass++) {
    (void)sli_take(&b, 1, sizeof(sl_symbolic));
    sli_symbolic_layout(&draft, &b, r->below_begin[r->n_kept] + r->T.rows_begin[r->T.n_supers],
              r->n_entries);
    stats->symbolic.bytes = b.used;
    status = pass == 0 ? sli_block_alloc(&b, a) : SL_OK;
  }
  if (status != SL_OK) {
    return status;
  }
  memset(&j, 0, sizeof j);
  j.S = &draft;
  sli_joint_number(&j, r);
  sli_joint_fill(&draft, r, stats);
  draft.stats = *stats;
  *out = (sl_symbolic *)(void *)b.base;
  **out = draft;
  return SL_OK;
}

/* src/impl/change/restrict.h: sl_factor_restrict: the factor of A[R, R] from that of A */

static void sli_restrict_rows(double *to, const double *from, sl_int w, const sl_int *keep,
                sl_int count) {
  const sl_int tiles = sli_tiles(w + count);
  sl_int t, j, r;
  for (t = w / SLI_TILE; t < tiles; t++) {
    const double *at[SLI_TILE];
    double *tile = to + sli_tile_offset(w, t);
    for (r = 0; r < SLI_TILE; r++) {
      const sl_int local = SLI_TILE * t + r, row = local < w           ? local
                             : local < w + count ? keep[local - w]
                                       : -1;
      at[r] = row == -1 ? NULL : from + sli_panel_at(w, row, 0);
    }
    for (j = 0; j < w; j++) {
      for (r = 0; r < SLI_TILE; r++) {
        tile[j * SLI_TILE + r] = at[r] == NULL ? 0.0 : at[r][j * SLI_TILE];
      }
    }
  }
}

static void sli_restrict_copy(sl_factor *G, const sl_factor *F, sli_restriction *r, sl_int q,
                sl_int *keep) {
  const sl_symbolic *S = F->S, *T = G->S;
  const sl_int s = r->kept[q], to = r->kept_new[q];
  const sli_step *step = &S->steps[s], *own = &T->steps[to];
  const sl_int w = step->width;
  const double *from = (const double *)F->values + step->panel;
  double *panel = (double *)G->values + own->panel;
  sl_int k, m;
  if (own->below == step->below) {
    memcpy(panel, from, (size_t)sli_panel_size(w, own->below) * sizeof(double));
  } else {
    for (k = 0, m = 0; k < own->below; k++, m++) {
      const sl_int rank = r->below[r->below_begin[q] + k];
      while (S->rows[S->rows_begin[s] + m] != r->R.columns[rank]) {
        m++;
      }
      keep[k] = w + m;
    }
    memcpy(panel, from, (size_t)sli_tile_offset(w, w / SLI_TILE) * sizeof(double));
    sli_restrict_rows(panel, from, w, keep, own->below);
  }
  r->copied += sli_panel_size(w, own->below);
  memcpy(G->D + own->column, F->D + step->column, (size_t)w * sizeof(double));
  if (F->rule.shifts != NULL) {
    memcpy(G->rule.shifts + own->column, F->rule.shifts + step->column,
         (size_t)w * sizeof(double));
  }
  G->extents[to] = F->extents[s];
  if (G->extents[to].pivot != -1) {
    G->extents[to].pivot += own->column - step->column;
  }
}

static void sli_restrict_update_own(const sl_factor *G, const sli_left_work *p, const sli_front *f,
                  sl_int s, int has_one_sign) {
  sl_int k;
  sli_front_update(G->kernels, f, G->buffer);
  for (k = 0; k < f->below && !has_one_sign; k++) {
    p->relative[k] = f->width + k;
  }
  if (!has_one_sign) {
    sli_left_magnitudes(G, p, f, s, 0, f->below);
  }
}

static void sli_restrict_update(const sl_factor *G, const sli_left_work *p, sl_int s,
                int has_one_sign, double *update) {
  const sl_symbolic *S = G->S;
  const sli_front f = sli_front_of(G, s, 0);
  const sl_int *rows = S->rows + S->rows_begin[s];
  const sl_int whole = f.width / SLI_TILE, tiles = sli_front_tiles(&f);
  sl_int k, d;
  for (k = 0; k < f.below; k++) {
    p->local[rows[k]] = f.width + k;
  }
  for (k = 0; k < SLI_TILE * tiles; k++) {
    f.magnitude[k] = 0.0;
  }
  memset(f.update, 0,
       (size_t)sli_triangle_offset(sli_update_tiles(f.width, f.below)) * sizeof(double));
  sli_restrict_update_own(G, p, &f, s, has_one_sign);
  for (d = s - 1; d >= S->first_descendant[s];) {
    const sl_int below = S->steps[d].below;
    const sl_int first =
      sli_lower_bound(S->rows + S->rows_begin[d], below, S->super_first[s + 1]);
    if (first < below) {
      sli_left_update(G, p, &f, d, first, below, update);
      if (!has_one_sign) {
        sli_left_magnitudes(G, p, &f, d, first, below);
      }
      d--;
    } else {
      d = S->first_descendant[d] - 1;
    }
  }
  for (k = f.width; k < f.width + f.below && has_one_sign; k++) {
    const sl_int tile = k / SLI_TILE - whole, column = k - SLI_TILE * whole;
    f.magnitude[k] =
      fabs(f.update[sli_triangle_offset(tile) + (sl_off)column * SLI_TILE + k % SLI_TILE]);
  }
  sli_front_hand_over(&f);
}

typedef struct sli_restrict_work {
  sli_left_work left;
  double *update;
  unsigned char *is_kept;
} sli_restrict_work;

static sl_status sli_restrict_work_make(sli_restrict_work *w, sli_block *b, const sl_symbolic *S,
                    const sli_restriction *r, const sl_allocator *a) {
  sl_status status = SL_OK;
  sl_off most = 0;
  sl_int q;
  int pass;
  for (q = 0; q < r->n_kept; q++) {
    const sli_step *step = &S->steps[r->kept_new[q]];
    const sl_off size = sli_triangle_offset(sli_update_tiles(step->width, step->below));
    most = size > most ? size : most;
  }
  for (pass = 0; pass < 2 && status == SL_OK; pass++) {
    sli_left_work_layout(&w->left, b, S);
    w->update = SLI_TAKE(b, double, most);
    w->is_kept = SLI_TAKE(b, unsigned char, S->n_supers);
    status = pass == 0 ? sli_block_alloc(b, a) : SL_OK;
  }
  return status;
}

static sl_status sli_restrict_eliminate(sl_factor *G, const sli_restrict_work *w, int has_one_sign,
                    const sli_source *from, sli_failure *failure) {
  const sl_symbolic *S = G->S;
  sl_status status = SL_OK;
  sl_int s;
  for (s = 0; s < S->n_supers && status == SL_OK; s++) {
    if (!w->is_kept[s]) {
      status = sli_front_factor(G, from, s, 0, failure);
    } else if (S->super_parent[s] != -1 && !w->is_kept[S->super_parent[s]]) {
      sli_restrict_update(G, &w->left, s, has_one_sign, w->update);
    }
  }
  return status;
}

static sl_status sli_restrict_check(const sl_factor *F, const sli_restriction *r,
                  sli_failure *failure) {
  sl_int q, k;
  for (q = 0; q < r->n_kept && F->n_nulls > 0; q++) {
    const sl_int s = r->kept[q];
    for (k = F->S->super_first[s]; k < F->S->super_first[s + 1]; k++) {
      if (sli_is_skipped(F, k)) {
        return sli_fail(failure, SL_ERR_PIVOT, r->kept_new[q],
                r->column_of[r->first_rank[q] + k - F->S->super_first[s]], -1, 0.0);
      }
    }
  }
  return SL_OK;
}

static sl_status sli_restrict_numbers(sl_factor *G, const sl_factor *F, sli_restriction *r,
                    sl_stats *stats) {
  const double started = sli_seconds();
  const sli_source from = sli_source_matrix(r->A);
  sli_restrict_work w;
  sli_failure failure;
  sli_block b = {NULL, 0, 0};
  sl_int q;
  sl_status status = sli_restrict_work_make(&w, &b, G->S, r, &G->allocator);
  if (status != SL_OK) {
    return status;
  }
  memset(&failure, 0, sizeof failure);
  memset(w.is_kept, 0, (size_t)G->S->n_supers);
  sli_factor_begin(G);
  G->identity = sli_hash_words(F->identity, &G->S->identity, 2);
  status = sli_restrict_check(F, r, &failure);
  for (q = 0; q < r->n_kept && status == SL_OK; q++) {
    w.is_kept[r->kept_new[q]] = 1;
    sli_restrict_copy(G, F, r, q, w.left.relative);
  }
  if (status == SL_OK) {
    const sl_factor_info *info = &F->stats.factor;
    (void)sli_restrict_eliminate(G, &w, info->positive == 0 || info->negative == 0, &from,
                   &failure);
  }
  sli_free(&G->allocator, b.base);
  return sli_factor_done(G, &from, &failure, started, stats);
}

static sl_options sli_restrict_options(const sl_factor *F, const sli_restriction *r,
                     const sl_allocator *a, sl_int *signs) {
  sl_options opt = sli_options_with(a);
  sl_int k;
  opt.isa = F->kernels->isa;
  opt.null_tolerance = F->rule.null_tolerance;
  opt.regularization = F->rule.regularization;
  opt.growth_limit = sli_is_finite(F->growth_limit) ? F->growth_limit : -1.0;
  opt.error_limit = sli_is_finite(F->error_limit) ? F->error_limit : -1.0;
  if (opt.regularization != 0.0 && F->rule.signs != NULL) {
    for (k = 0; k < r->R.count; k++) {
      signs[r->R.row_of[k]] = F->rule.signs[r->R.columns[k]];
    }
    opt.signs = signs;
  }
  return opt;
}

static sl_status sli_restrict_factor(sl_factor **out, const sl_symbolic *S, const sl_factor *F,
                   sli_restriction *r, const sl_options *rules, sl_stats *stats) {
  sl_options opt = *rules;
  sl_factor *G = NULL;
  sl_status status;
  opt.method = SL_METHOD_SUPERNODAL;
  status = sli_factor_new(&G, S, &opt, stats);
  status = status == SL_OK ? sli_restrict_numbers(G, F, r, stats) : status;
  if (status == SL_OK) {
    *out = G;
  } else {
    sl_factor_free(G);
  }
  return status;
}

static void sli_restrict_done(sl_symbolic *S, sl_factor *G) {
  sl_factor counted = *G;
  sli_block b = {NULL, 0, 0};
  sli_free(&G->allocator, G->stack);
  sli_free(&G->allocator, G->scratch);
  G->stack = NULL;
  G->scratch = NULL;
  (void)sli_take(&b, 1, sizeof(sl_factor));
  sli_factor_layout(&counted, &b, 0);
  G->stats.factor.bytes = b.used;
  G->is_immutable = 1;
  S->is_partial = 1;
  S->nnz_input = -1;
  memset(S->scatter_begin, 0, ((size_t)S->n_supers + 1) * sizeof(sl_off));
}

static void sli_restrict_report(const sli_restriction *r, sl_status status, int is_anew,
                sl_stats *stats) {
  const int is_entry = status == SL_ERR_NOT_FINITE && stats->error.column != -1;
  if (status == SL_ERR_PIVOT || status == SL_ERR_INACCURATE ||
    (status == SL_ERR_NOT_FINITE && (is_anew || !is_entry))) {
    stats->error.row = r->rows[stats->error.row];
    stats->error.column = stats->error.column == -1 ? -1 : r->rows[stats->error.column];
  }
}

#define SLI_RESTRICT_KEPT 0.25

static sl_status sli_restrict_run(sl_symbolic **S, sl_factor **G, const sl_factor *F,
                  sli_restriction *r, int is_anew, const sl_allocator *a,
                  sl_stats *stats) {
  const double started = sli_seconds();
  const sl_options rules = sli_restrict_options(F, r, a, (sl_int *)(void *)r->scratch);
  sl_stats found;
  sl_status status;
  if (is_anew) {
    return sli_restrict_anew(S, G, r, &rules, stats);
  }
  memset(&found, 0, sizeof found);
  found.symbolic.triangle = F->S->stats.symbolic.triangle;
  status = sli_restriction_run(r, a, &found, stats);
  status = status == SL_OK ? sli_joint_make(S, r, a, &found) : status;
  if (status == SL_OK) {
    (*S)->stats.symbolic.seconds_analyze = sli_seconds() - started;
    status = sli_restrict_factor(G, *S, F, r, &rules, stats);
  }
  return status;
}

static sl_status sli_restrict_arguments(const sl_factor *F, const sl_csc *A, const sl_int *rows,
                    sl_int count, const sl_options *opt) {
  if (F == NULL || A == NULL || count < 0 || (count > 0 && rows == NULL) ||
    !sli_options_are_valid(opt, SLI_READS_NOTHING)) {
    return SL_ERR_ARGUMENT;
  }
  if (!F->is_valid || !sli_factor_is_over(F, F->S, F->analysis)) {
    return SL_ERR_STATE;
  }
  if (F->E != NULL || F->S->nnz_input < 0 || F->storage != SL_STORAGE_DOUBLE ||
    F->null_vectors > 1) {
    return SL_ERR_UNSUPPORTED;
  }
  if (A->n_cols > 0 && A->p == NULL) {
    return SL_ERR_ARGUMENT;
  }
  if (A->n_rows != F->S->n || A->n_cols != F->S->n || sli_nnz(A) != F->S->nnz_input) {
    return SL_ERR_PATTERN;
  }
  return sli_nnz(A) > 0 && (A->i == NULL || A->x == NULL) ? SL_ERR_ARGUMENT : SL_OK;
}

SL_API sl_status sl_factor_restrict(sl_symbolic **S, sl_factor **G, const sl_factor *F,
                  const sl_csc *A, const sl_int *rows, sl_int count,
                  const sl_options *opt, sl_stats *stats) {
  const sl_allocator a = sli_allocator(opt);
  const double started = sli_seconds();
  sli_restriction r;
  sl_status status;
  int is_anew;
  sli_stats_clear_error(stats);
  if (S == NULL || G == NULL) {
    return SL_ERR_ARGUMENT;
  }
  *S = NULL;
  *G = NULL;
  status = sli_restrict_arguments(F, A, rows, count, opt);
  if (status != SL_OK) {
    return status;
  }
  memset(&r, 0, sizeof r);
  r.S = F->S;
  r.A = A;
  r.rows = rows;
  r.R.count = count;
  status = sli_restriction_begin(&r, &a, stats);
  is_anew = count - r.n_fresh < SLI_RESTRICT_KEPT * count;
  if (status == SL_OK) {
    status = sli_restrict_run(S, G, F, &r, is_anew, &a, stats);
    if (stats != NULL) {
      sli_restrict_report(&r, status, is_anew, stats);
    }
  }
  if (status == SL_OK) {
    sli_restrict_done(*S, *G);
  } else {
    sl_symbolic_free(*S);
    *S = NULL;
  }
  if (status == SL_OK && stats != NULL) {
    sl_restrict_info *info = &stats->restriction;
    stats->factor.bytes = (*G)->stats.factor.bytes;
    info->is_anew = is_anew;
    info->kept = count - r.n_fresh;
    info->computed = count - info->kept;
    info->entries = r.copied;
    info->seconds = sli_seconds() - started;
  }
  sli_restriction_free(&r, &a);
  return status;
}

/* src/impl/change/edit_match.h: which rows of an edited matrix have other neighbors than before */

typedef struct sli_edit {
  const sl_symbolic *S;
  const sl_csc *A, *B;
  const sl_int *new_of;
  sl_triangle triangle;
  sl_int n;
  sl_int *column_of;
  sl_int *node;
  sl_int *number;
  unsigned char *is_active;
  unsigned char *is_matched;
  sl_int *position;
  sl_int *cursor, *waiting;

  sl_int n_active;
  sl_int *active;
  sl_off *begin;
  sl_int *to;
  uint64_t *list, *scratch;
  sl_off steps;

  unsigned char *mark;
  sl_int *weight;
  sl_int *head, *next;
  sl_int n_grouped;
  sl_int n_fresh;
  sl_int *fresh;
  sl_int moved;
  void *blocks[3];
} sli_edit;

enum { SLI_NODE_KEPT = 0, SLI_NODE_FRESH, SLI_NODE_GROUPED };

static void sli_edit_layout(sli_edit *e, sli_block *b) {
  const uint64_t n = (uint64_t)e->n, supers = (uint64_t)e->S->n_supers;
  e->column_of = SLI_TAKE(b, sl_int, n);
  e->node = SLI_TAKE(b, sl_int, n);
  e->number = SLI_TAKE(b, sl_int, n);
  e->is_active = SLI_TAKE(b, unsigned char, n);
  e->is_matched = SLI_TAKE(b, unsigned char, sli_nnz(e->B));
  e->position = SLI_TAKE(b, sl_int, sli_nnz(e->A));
  e->cursor = SLI_TAKE(b, sl_int, n);
  e->waiting = SLI_TAKE(b, sl_int, n);
  e->mark = SLI_TAKE(b, unsigned char, supers + 1);
  e->weight = SLI_TAKE(b, sl_int, supers + 1);
  e->head = SLI_TAKE(b, sl_int, supers + 1);
  e->next = SLI_TAKE(b, sl_int, n);
  e->active = SLI_TAKE(b, sl_int, n);
  e->fresh = SLI_TAKE(b, sl_int, n);
}

static sl_status sli_edit_rows(sli_edit *e, sl_stats *stats) {
  const sl_symbolic *S = e->S;
  sl_int j;
  memset(e->mark, SLI_NODE_KEPT, (size_t)S->n_supers + 1);
  for (j = 0; j < e->n; j++) {
    e->column_of[j] = -1;
  }
  for (j = 0; j < S->n; j++) {
    const sl_int row = e->new_of[j];
    if (row < -1 || row >= e->n || (row >= 0 && e->column_of[row] != -1)) {
      return sli_fail_at(stats, SL_ERR_ARGUMENT, j, -1, (double)row);
    }
    if (row >= 0) {
      e->column_of[row] = S->iperm[j];
    } else {
      e->mark[S->super_of[S->iperm[j]]] = SLI_NODE_FRESH;
    }
  }
  for (j = 0; j < e->n; j++) {
    e->node[j] = e->column_of[j] == -1 ? -1 : S->super_of[e->column_of[j]];
    e->is_active[j] = e->column_of[j] == -1;
  }
  return SL_OK;
}

#define SLI_EDIT_AHEAD 12

#define SLI_EDIT_LAST INT32_MIN

SLI_INLINE sl_int sli_edit_link(sl_int p) {
  return -1 - p;
}

SLI_INLINE int sli_edit_place(const sli_edit *e, sl_int i, sl_int j, sl_int *row, sl_int *column) {
  const int is_upper = e->triangle == SL_TRIANGLE_UPPER;
  *row = is_upper ? sli_min(i, j) : sli_max(i, j);
  *column = is_upper ? sli_max(i, j) : sli_min(i, j);
  return i == j || e->triangle != SL_TRIANGLE_NONE;
}

SLI_INLINE void sli_edit_activate(sli_edit *e, sl_int row) {
  if (row != -1) {
    e->is_active[row] = 1;
  }
}

static void sli_edit_match_ahead(sli_edit *e, sl_int j) {
  const sl_csc *A = e->A, *B = e->B;
  const sl_triangle triangle = e->S->stats.symbolic.triangle;
  const sl_int own = e->new_of[j];
  sl_int p, row, column;
  for (p = A->p[j]; p < A->p[j + 1]; p++) {
    const sl_int other = e->new_of[A->i[p]];
    e->position[p] = -1;
    if (!sli_is_read(triangle, A->i[p], j)) {
      continue;
    }
    if (own != -1 && other != -1 && sli_edit_place(e, own, other, &row, &column)) {
      sl_int q = e->cursor[column];
      const sl_int end = sli_min(q + SLI_EDIT_AHEAD, B->p[column + 1]);
      while (q < end && B->i[q] != row) {
        q++;
      }
      if (q < end) {
        e->position[p] = q;
        e->is_matched[q] = 1;
        e->cursor[column] = q + 1;
      } else {
        e->position[p] = e->waiting[column];
        e->waiting[column] = sli_edit_link(p);
      }
    } else {
      sli_edit_activate(e, own);
      sli_edit_activate(e, other);
    }
  }
}

static void sli_edit_match_waiting(sli_edit *e, sl_int column, sl_int *where) {
  const sl_csc *B = e->B;
  sl_int q, link = e->waiting[column];
  for (q = B->p[column + 1] - 1; q >= B->p[column]; q--) {
    where[B->i[q]] = e->is_matched[q] ? where[B->i[q]] : q + 1;
  }
  while (link != SLI_EDIT_LAST) {
    const sl_int p = sli_edit_link(link), next = e->position[p];
    const sl_int i = e->new_of[e->A->i[p]];
    const sl_int row = i != column ? i : e->new_of[sli_column_of(e->A, p)];
    e->position[p] = where[row] - 1;
    if (where[row] != 0) {
      e->is_matched[where[row] - 1] = 1;
      where[row] = 0;
    } else {
      sli_edit_activate(e, row);
      sli_edit_activate(e, column);
    }
    link = next;
  }
  for (q = B->p[column]; q < B->p[column + 1]; q++) {
    where[B->i[q]] = 0;
  }
}

static void sli_edit_match(sli_edit *e) {
  const sl_csc *A = e->A, *B = e->B;
  sl_int j, q, *where = e->number;
  for (j = 0; j < e->n; j++) {
    e->cursor[j] = B->p[j];
    e->waiting[j] = SLI_EDIT_LAST;
    where[j] = 0;
  }
  memset(e->is_matched, 0, (size_t)sli_nnz(B));
  for (j = 0; j < A->n_cols; j++) {
    sli_edit_match_ahead(e, j);
  }
  for (j = 0; j < e->n; j++) {
    if (e->waiting[j] != SLI_EDIT_LAST) {
      sli_edit_match_waiting(e, j, where);
    }
  }
  for (j = 0; j < e->n; j++) {
    for (q = B->p[j]; q < B->p[j + 1]; q++) {
      if (!e->is_matched[q] && sli_is_read(e->triangle, B->i[q], j)) {
        e->is_active[B->i[q]] = e->is_active[j] = 1;
      }
    }
  }
}

/* src/impl/change/edit_place.h: places new rows in the tree of supernodes, and moves rows until every entry of the */

static void sli_edit_list(sli_edit *e) {
  sl_int j;
  e->n_active = 0;
  for (j = 0; j < e->n; j++) {
    e->number[j] = -1;
    if (e->is_active[j]) {
      e->number[j] = e->n_active;
      e->active[e->n_active++] = j;
    }
  }
}

SLI_INLINE void sli_edit_enter(sli_edit *e, sl_int i, sl_int j) {
  const sl_int k = e->number[i];
  if (k != -1 && e->to == NULL) {
    e->begin[k]++;
  } else if (k != -1) {
    e->to[e->begin[k]++] = j;
  }
}

static void sli_edit_scan(sli_edit *e) {
  const sl_csc *B = e->B;
  sl_int j, k, p;
  for (k = 0; k < e->n_active && e->triangle == SL_TRIANGLE_BOTH; k++) {
    j = e->active[k];
    for (p = B->p[j]; p < B->p[j + 1]; p++) {
      if (B->i[p] != j) {
        sli_edit_enter(e, j, B->i[p]);
      }
    }
  }
  for (j = 0; j < e->n && e->triangle != SL_TRIANGLE_BOTH; j++) {
    const int is_active = e->is_active[j];
    for (p = B->p[j]; p < B->p[j + 1]; p++) {
      if ((is_active || e->is_active[B->i[p]]) && B->i[p] != j &&
        sli_is_read(e->triangle, B->i[p], j)) {
        sli_edit_enter(e, j, B->i[p]);
        sli_edit_enter(e, B->i[p], j);
      }
    }
  }
}

static sl_status sli_edit_neighbors(sli_edit *e, const sl_allocator *a) {
  sli_block b = {NULL, 0, 0};
  sl_off total = 0;
  sl_int k, pass;
  sl_status status = SL_OK;
  for (pass = 0; pass < 2 && status == SL_OK; pass++) {
    e->begin = SLI_TAKE(&b, sl_off, (uint64_t)e->n_active + 1);
    e->list = SLI_TAKE(&b, uint64_t, e->n_active);
    e->scratch = SLI_TAKE(&b, uint64_t, e->n_active);
    status = pass == 0 ? sli_block_alloc(&b, a) : SL_OK;
  }
  e->blocks[1] = b.base;
  if (status != SL_OK) {
    return status;
  }
  memset(e->begin, 0, ((size_t)e->n_active + 1) * sizeof(sl_off));
  e->to = NULL;
  sli_edit_scan(e);
  for (k = 0; k <= e->n_active; k++) {
    const sl_off here = e->begin[k];
    e->begin[k] = total;
    total += here;
  }
  memset(&b, 0, sizeof b);
  for (pass = 0; pass < 2 && status == SL_OK; pass++) {
    e->to = SLI_TAKE(&b, sl_int, total);
    status = pass == 0 ? sli_block_alloc(&b, a) : SL_OK;
  }
  e->blocks[2] = b.base;
  if (status != SL_OK) {
    return status;
  }
  sli_edit_scan(e);
  memmove(e->begin + 1, e->begin, (size_t)e->n_active * sizeof(sl_off));
  e->begin[0] = 0;
  return SL_OK;
}

SLI_INLINE int sli_edit_is_above(const sli_edit *e, sl_int a, sl_int b) {
  return a == e->S->n_supers || (e->S->first_descendant[a] <= b && b <= a);
}

static sl_int sli_edit_meet(sli_edit *e, sl_int a, sl_int b) {
  while (!sli_edit_is_above(e, a, b) && e->steps > 0) {
    a = e->S->super_parent[a];
    a = a == -1 ? e->S->n_supers : a;
    e->steps--;
  }
  return a;
}

static sl_int sli_edit_lowest(sli_edit *e, sl_int row, sl_int *conflicts) {
  const sl_int own = e->node[row], k = e->number[row];
  sl_int lowest = -1;
  int is_join = 0;
  sl_off at;
  *conflicts = 0;
  for (at = e->begin[k]; at < e->begin[k + 1]; at++) {
    const sl_int node = e->node[e->to[at]];
    if (node == -1) {
      continue;
    }
    *conflicts +=
      own != -1 && !sli_edit_is_above(e, own, node) && !sli_edit_is_above(e, node, own);
    if (lowest == -1) {
      lowest = node;
    } else if (sli_edit_is_above(e, lowest, node)) {
      lowest = is_join ? lowest : node;
    } else if (!sli_edit_is_above(e, node, lowest)) {
      lowest = sli_edit_meet(e, lowest, node);
      is_join = 1;
    }
  }
  return lowest;
}

static void sli_edit_move(sli_edit *e, sl_int row, sl_int node) {
  if (e->node[row] != -1) {
    e->mark[e->node[row]] = SLI_NODE_FRESH;
    e->moved++;
  }
  e->mark[node] = SLI_NODE_FRESH;
  e->node[row] = node;
}

static void sli_edit_resolve(sli_edit *e) {
  sl_int k, count = 0, conflicts;
  for (k = 0; k < e->n_active && e->steps > 0; k++) {
    const sl_int row = e->active[k];
    if (e->node[row] != -1) {
      (void)sli_edit_lowest(e, row, &conflicts);
      if (conflicts > 0) {
        e->list[count++] = sli_keyed(INT32_MAX - conflicts, row);
      }
    }
  }
  sli_sort(e->list, count, e->scratch);
  for (k = 0; k < count && e->steps > 0; k++) {
    const sl_int row = sli_value(e->list[k]);
    const sl_int node = sli_edit_lowest(e, row, &conflicts);
    if (conflicts > 0) {
      sli_edit_move(e, row, node);
    }
  }
}

static void sli_edit_place_new(sli_edit *e) {
  sl_int *queue = e->next, head, tail = 0, k, conflicts;
  sl_off at;
  for (k = 0; k < e->n_active; k++) {
    const sl_int row = e->active[k];
    for (at = e->begin[k]; e->node[row] == -1 && at < e->begin[k + 1]; at++) {
      if (e->node[e->to[at]] != -1) {
        e->cursor[row] = 1;
        queue[tail++] = row;
        break;
      }
    }
  }
  for (head = 0; head < tail && e->steps > 0; head++) {
    const sl_int row = queue[head];
    sli_edit_move(e, row, sli_edit_lowest(e, row, &conflicts));
    k = e->number[row];
    for (at = e->begin[k]; at < e->begin[k + 1]; at++) {
      if (e->node[e->to[at]] == -1 && e->cursor[e->to[at]] == 0) {
        e->cursor[e->to[at]] = 1;
        queue[tail++] = e->to[at];
      }
    }
  }
}

static void sli_edit_lower(sli_edit *e) {
  sl_int k, conflicts;
  for (k = 0; k < e->n_active && e->steps > 0; k++) {
    const sl_int row = e->active[k], own = e->node[row];
    const sl_int lowest = own == -1 ? -1 : sli_edit_lowest(e, row, &conflicts);
    if (lowest != -1 && lowest != own && sli_edit_is_above(e, own, lowest)) {
      sli_edit_move(e, row, lowest);
    }
  }
}

static int sli_edit_place_all(sli_edit *e) {
  sl_int k;
  for (k = 0; k < e->n_active; k++) {
    e->cursor[e->active[k]] = 0;
    if (e->node[e->active[k]] != -1) {
      e->mark[e->node[e->active[k]]] = SLI_NODE_FRESH;
    }
  }
  e->steps = 4 * ((sl_off)e->n + e->S->n_supers) + 1000;
  sli_edit_resolve(e);
  sli_edit_place_new(e);
  sli_edit_lower(e);
  return e->steps > 0;
}

/* src/impl/change/edit_order.h: the order of an edited matrix: small subtrees with active rows are ordered anew */

#define SLI_EDIT_SHARE 8

static void sli_edit_mark(sli_edit *e) {
  const sl_symbolic *S = e->S;
  sl_int s, k;
  memset(e->weight, 0, ((size_t)S->n_supers + 1) * sizeof(sl_int));
  for (k = 0; k < e->n_active; k++) {
    if (e->node[e->active[k]] != -1) {
      e->weight[e->node[e->active[k]]]++;
    }
  }
  for (s = 0; s < S->n_supers; s++) {
    const sl_int up = S->super_parent[s];
    if (up != -1) {
      e->weight[up] += e->weight[s];
      e->mark[up] = e->mark[s] == SLI_NODE_KEPT ? e->mark[up] : e->mark[s];
    }
  }
  for (s = S->n_supers - 1; s >= 0; s--) {
    const sl_int low = S->first_descendant[s];
    const sl_off size = S->super_first[s + 1] - S->super_first[low];
    if (e->weight[s] > 0 && size <= (sl_off)SLI_EDIT_SHARE * e->weight[s]) {
      memset(e->mark + low, SLI_NODE_GROUPED, (size_t)(s - low + 1));
      s = low;
    }
  }
}

SLI_INLINE int sli_edit_stays(const sli_edit *e, sl_int row, sl_int s) {
  return row != -1 && e->node[row] == s;
}

static void sli_edit_append(sli_edit *e, sl_int s) {
  const sl_symbolic *S = e->S;
  sl_int k, row;
  for (row = e->head[s]; row != -1; row = e->next[row]) {
    e->fresh[e->n_fresh++] = row;
  }
  for (k = s < S->n_supers ? S->super_first[s] : 0; s < S->n_supers && k < S->super_first[s + 1];
     k++) {
    row = e->new_of[S->perm[k]];
    if (sli_edit_stays(e, row, s)) {
      e->fresh[e->n_fresh++] = row;
    }
  }
}

static void sli_edit_collect(sli_edit *e) {
  const sl_symbolic *S = e->S;
  sl_int s, k;
  for (s = 0; s <= S->n_supers; s++) {
    e->head[s] = -1;
  }
  e->n_fresh = 0;
  for (k = e->n_active - 1; k >= 0; k--) {
    const sl_int row = e->active[k], node = e->node[row];
    if (node == -1) {
      e->fresh[e->n_fresh++] = row;
    } else if (e->column_of[row] == -1 || S->super_of[e->column_of[row]] != node) {
      e->next[row] = e->head[node];
      e->head[node] = row;
    }
  }
  for (s = 0; s < S->n_supers; s++) {
    if (e->mark[s] == SLI_NODE_GROUPED) {
      sli_edit_append(e, s);
    }
  }
  e->n_grouped = e->n_fresh;
  for (s = 0; s <= S->n_supers; s++) {
    if (e->mark[s] == SLI_NODE_FRESH) {
      sli_edit_append(e, s);
    }
  }
}

static void sli_edit_graph(const sli_edit *e, sli_graph *G) {
  const sl_csc *B = e->B;
  sl_int k, p;
  for (k = 0; k < e->n_grouped; k++) {
    const sl_int j = e->fresh[k];
    for (p = B->p[j]; p < B->p[j + 1]; p++) {
      const sl_int i = e->number[B->i[p]];
      if (i != -1 && i != k && sli_is_read(e->triangle, B->i[p], j) && G->to == NULL) {
        G->begin[i]++;
        G->begin[k]++;
      } else if (i != -1 && i != k && sli_is_read(e->triangle, B->i[p], j)) {
        G->to[G->begin[i]++] = k;
        G->to[G->begin[k]++] = i;
      }
    }
  }
}

static sl_status sli_edit_order(sli_edit *e, const sl_allocator *a) {
  const sl_int count = e->n_grouped;
  sli_graph G;
  sli_block b = {NULL, 0, 0}, edges = {NULL, 0, 0};
  sli_septree septree;
  sl_int *perm = NULL, *scratch = NULL, k, pass;
  sl_off total = 0;
  double flops;
  sl_status status = SL_OK;
  memset(&G, 0, sizeof G);
  memset(&septree, 0, sizeof septree);
  if (count == 0) {
    return SL_OK;
  }
  G.n = count;
  for (pass = 0; pass < 2 && status == SL_OK; pass++) {
    G.begin = SLI_TAKE(&b, sl_off, (uint64_t)count + 1);
    perm = SLI_TAKE(&b, sl_int, count);
    scratch = SLI_TAKE(&b, sl_int, count);
    septree.node_of = SLI_TAKE(&b, sl_int, count);
    septree.parent = SLI_TAKE(&b, sl_int, (uint64_t)count + 1);
    status = pass == 0 ? sli_block_alloc(&b, a) : SL_OK;
  }
  if (status != SL_OK) {
    return status;
  }
  for (k = 0; k < e->n; k++) {
    e->number[k] = -1;
  }
  for (k = 0; k < count; k++) {
    e->number[e->fresh[k]] = k;
  }
  memset(G.begin, 0, ((size_t)count + 1) * sizeof(sl_off));
  sli_edit_graph(e, &G);
  for (k = 0; k <= count; k++) {
    const sl_off here = G.begin[k];
    G.begin[k] = total;
    total += here;
  }
  for (pass = 0; pass < 2 && status == SL_OK; pass++) {
    G.to = SLI_TAKE(&edges, sl_int, total);
    status = pass == 0 ? sli_block_alloc(&edges, a) : SL_OK;
  }
  if (status == SL_OK) {
    sli_edit_graph(e, &G);
    memmove(G.begin + 1, G.begin, (size_t)count * sizeof(sl_off));
    G.begin[0] = 0;
    status = sli_order_canonical(&G, a);
  }
  if (status == SL_OK) {
    status = sli_order_is_irregular(&G)
           ? sli_order_mindeg(&G, perm, &flops, a)
           : sli_order_compressed(&G, 0, perm, scratch, &septree, a);
  }
  if (status == SL_OK) {
    for (k = 0; k < count; k++) {
      scratch[k] = e->fresh[perm[k]];
    }
    memcpy(e->fresh, scratch, (size_t)count * sizeof(sl_int));
  }
  sli_free(a, edges.base);
  sli_free(a, b.base);
  return status;
}

/* src/impl/change/edit_graph.h: the graph of the columns that an edit analyzes anew, and their supernodes */

SLI_INLINE int sli_edit_is_root(const sli_edit *e, sl_int s) {
  const sl_int up = e->S->super_parent[s];
  return e->mark[s] == SLI_NODE_KEPT && (up == -1 || e->mark[up] != SLI_NODE_KEPT);
}

SLI_INLINE sl_int sli_edit_number(const sli_edit *e, sl_int column) {
  return e->number[e->new_of[e->S->perm[column]]];
}

static sl_int sli_edit_first_below(const sli_edit *e, sl_int s) {
  const sl_symbolic *S = e->S;
  sl_int first = INT32_MAX;
  sl_off p;
  for (p = S->rows_begin[s]; p < S->rows_begin[s + 1]; p++) {
    first = sli_min(first, sli_edit_number(e, S->rows[p]));
  }
  return first;
}

static sl_status sli_edit_graph_room(const sli_edit *e, sli_restriction *r, const sl_allocator *a) {
  const sl_symbolic *S = e->S;
  uint64_t entries = 0;
  sli_block b = {NULL, 0, 0};
  sl_status status = SL_OK;
  sl_int s, k;
  int pass;
  for (s = 0; s < S->n_supers; s++) {
    entries += sli_edit_is_root(e, s) ? (uint64_t)(S->rows_begin[s + 1] - S->rows_begin[s]) : 0;
  }
  for (k = 0; k < e->n_fresh; k++) {
    entries += (uint64_t)(e->B->p[e->fresh[k] + 1] - e->B->p[e->fresh[k]]);
  }
  if (entries > INT32_MAX) {
    return SL_ERR_TOO_LARGE;
  }
  for (pass = 0; pass < 2 && status == SL_OK; pass++) {
    r->entry_row = SLI_TAKE(&b, sl_int, entries);
    r->entry_column = SLI_TAKE(&b, sl_int, entries);
    r->entry_from = SLI_TAKE(&b, sl_int, entries);
    status = pass == 0 ? sli_block_alloc(&b, a) : SL_OK;
  }
  r->blocks[1] = b.base;
  return status;
}

static void sli_edit_list_graph(const sli_edit *e, sli_restriction *r) {
  const sl_symbolic *S = e->S;
  const sl_csc *B = e->B;
  sl_int s, k, p;
  sl_off at;
  for (s = 0; s < S->n_supers; s++) {
    if (sli_edit_is_root(e, s)) {
      const sl_int first = sli_edit_first_below(e, s);
      for (at = S->rows_begin[s]; at < S->rows_begin[s + 1]; at++) {
        const sl_int number = sli_edit_number(e, S->rows[at]);
        if (number != first) {
          sli_restriction_enter(r, number, first, -1);
        }
      }
    }
  }
  for (k = 0; k < e->n_fresh; k++) {
    for (p = B->p[e->fresh[k]]; p < B->p[e->fresh[k] + 1]; p++) {
      const sl_int other = e->number[B->i[p]];
      if (other != -1 && sli_is_read(e->triangle, B->i[p], e->fresh[k])) {
        sli_restriction_enter(r, other, k, p);
      }
    }
  }
}

static sl_status sli_edit_analyze_fresh(sli_edit *e, sli_restriction *r, sl_relaxation relaxation,
                    const sl_allocator *a, sl_stats *stats) {
  sl_status status;
  sl_int k;
  for (k = 0; k < e->n; k++) {
    e->number[k] = -1;
  }
  for (k = 0; k < e->n_fresh; k++) {
    e->number[e->fresh[k]] = k;
  }
  r->S = e->S;
  r->n_fresh = e->n_fresh;
  r->fresh = e->fresh;
  r->relaxation = relaxation;
  status = sli_edit_graph_room(e, r, a);
  if (status != SL_OK) {
    return status;
  }
  sli_edit_list_graph(e, r);
  return sli_restriction_analyze(r, a, stats);
}

/* src/impl/change/edit_join.h: joins kept subtrees and fresh supernodes to the analysis of an edited matrix */

typedef struct sli_edit_join {
  sli_edit *e;
  sli_restriction r;
  sl_symbolic *T;
  sl_int *super_new;
  sl_int *column_new;
  sl_int *next;
  uint64_t *list, *scratch;
  sl_int most;
  void *block;
} sli_edit_join;

static sl_status sli_edit_join_room(sli_edit_join *j, const sl_allocator *a) {
  const sl_symbolic *S = j->e->S;
  sli_block b = {NULL, 0, 0};
  sl_status status = SL_OK;
  sl_int s;
  int pass;
  j->most = S->tallest;
  for (s = 0; s < S->n_supers; s++) {
    j->most = sli_max(j->most, (sl_int)(S->scatter_begin[s + 1] - S->scatter_begin[s]));
  }
  for (pass = 0; pass < 2 && status == SL_OK; pass++) {
    j->super_new = SLI_TAKE(&b, sl_int, S->n_supers);
    j->next = SLI_TAKE(&b, sl_int, S->n_supers);
    j->column_new = SLI_TAKE(&b, sl_int, S->n);
    j->list = SLI_TAKE(&b, uint64_t, j->most);
    j->scratch = SLI_TAKE(&b, uint64_t, j->most);
    status = pass == 0 ? sli_block_alloc(&b, a) : SL_OK;
  }
  j->block = b.base;
  return status;
}

static void sli_edit_join_kept(sli_edit_join *j, sli_joint *at, sl_int s) {
  const sl_symbolic *S = j->e->S;
  sl_int k;
  j->super_new[s] = at->super;
  for (k = S->super_first[s]; k < S->super_first[s + 1]; k++) {
    const sl_int column = at->column + k - S->super_first[s];
    j->column_new[k] = column;
    j->T->perm[column] = j->e->new_of[S->perm[k]];
    j->T->counts[column] = S->counts[k];
  }
  sli_joint_add(at, S->super_first[s + 1] - S->super_first[s],
          S->rows_begin[s + 1] - S->rows_begin[s]);
}

static void sli_edit_join_number(sli_edit_join *j) {
  const sl_symbolic *S = j->e->S, *fresh = &j->r.T;
  sli_joint at;
  sl_int s, t, k, root;
  memset(&at, 0, sizeof at);
  at.S = j->T;
  for (t = 0; t <= fresh->n_supers; t++) {
    j->r.head[t] = -1;
  }
  for (s = S->n_supers - 1; s >= 0; s--) {
    if (sli_edit_is_root(j->e, s)) {
      t = S->super_parent[s] == -1
          ? fresh->n_supers
          : fresh->super_of[j->r.w.new_of[sli_edit_first_below(j->e, s)]];
      j->next[s] = j->r.head[t];
      j->r.head[t] = s;
    }
  }
  for (t = -1; t < fresh->n_supers; t++) {
    for (root = j->r.head[t == -1 ? fresh->n_supers : t]; root != -1; root = j->next[root]) {
      for (s = S->first_descendant[root]; s <= root; s++) {
        sli_edit_join_kept(j, &at, s);
      }
    }
    if (t != -1) {
      const sl_int first = fresh->super_first[t], width = fresh->super_first[t + 1] - first;
      for (k = 0; k < width; k++) {
        j->T->perm[at.column + k] = j->e->fresh[j->r.w.old_of[first + k]];
      }
      j->r.T_new[t] = at.super;
      sli_joint_add(&at, width, fresh->rows_begin[t + 1] - fresh->rows_begin[t]);
    }
  }
  j->T->super_first[at.super] = at.column;
  j->T->rows_begin[at.super] = at.rows;
  j->T->panel_begin[at.super] = at.panel;
}

static void sli_edit_join_maps(sli_edit_join *j) {
  const sl_symbolic *S = j->e->S;
  sl_int s, k;
  for (k = 0; k < j->T->n; k++) {
    j->T->iperm[j->T->perm[k]] = k;
  }
  for (s = 0; s < S->n_supers; s++) {
    for (k = S->super_first[s]; j->e->mark[s] != SLI_NODE_KEPT && k < S->super_first[s + 1];
       k++) {
      const sl_int row = j->e->new_of[S->perm[k]];
      j->column_new[k] = row == -1 ? -1 : j->T->iperm[row];
    }
  }
  j->r.column_of = j->T->iperm;
}

static int sli_edit_join_rows(sli_edit_join *j, sl_int s) {
  const sl_symbolic *S = j->e->S;
  sl_symbolic *T = j->T;
  const sl_int to = j->super_new[s], below = S->steps[s].below;
  const sl_int *from = S->rows + S->rows_begin[s];
  sl_int *rows = T->rows + T->rows_begin[to];
  const sl_int first = S->super_first[s], shift = T->super_first[to] - first;
  sl_int k, last = -1;
  int is_moved = 0;
  for (k = 0; k < below; k++) {
    rows[k] = j->column_new[from[k]];
    is_moved |= rows[k] <= last;
    last = rows[k];
  }
  if (is_moved) {
    for (k = 0; k < below; k++) {
      j->list[k] = sli_keyed(rows[k], 0);
    }
    sli_sort(j->list, below, j->scratch);
    for (k = 0; k < below; k++) {
      rows[k] = sli_key(j->list[k]);
    }
  }
  for (k = first; k < S->super_first[s + 1] - 1; k++) {
    T->parent[k + shift] = S->parent[k] + shift;
  }
  T->parent[k + shift] = below > 0 ? rows[0] : -1;
  T->super_parent[to] = below > 0 ? T->super_of[rows[0]] : -1;
  return is_moved;
}

static void sli_edit_join_map(sli_edit_join *j, sl_int s, int is_moved) {
  const sl_symbolic *S = j->e->S;
  sl_symbolic *T = j->T;
  const sl_int to = j->super_new[s], width = S->steps[s].width, below = S->steps[s].below;
  const sl_off begin = S->scatter_begin[s], base = T->scatter_begin[to],
         shift = T->panel_begin[to] - S->panel_begin[s];
  const sl_int count = (sl_int)(S->scatter_begin[s + 1] - begin);
  sl_int m, tile = sli_last_tile(S, s);
  for (m = 0; m < count && !is_moved; m++) {
    T->scatter_from[base + m] = j->e->position[S->scatter_from[begin + m]];
    T->scatter_to[base + m] = S->scatter_to[begin + m] + shift;
  }
  for (m = count - 1; m >= 0 && is_moved; m--) {
    sl_int k, column;
    sli_scatter_map_pivots(S, s, begin + m, &tile, &k, &column);
    j->list[m] = sli_keyed(j->column_new[k], m);
  }
  if (!is_moved) {
    return;
  }
  sli_sort(j->list, count, j->scratch);
  for (m = 0; m < count; m++) {
    const sl_off from = begin + sli_value(j->list[m]);
    const sl_int row = sli_key(j->list[m]) - T->super_first[to];
    sl_int k, column, last = sli_last_tile(S, s);
    const sl_int local = row < width ? row
                     : width + sli_lower_bound(T->rows + T->rows_begin[to],
                                   below, sli_key(j->list[m]));
    sli_scatter_map_pivots(S, s, from, &last, &k, &column);
    T->scatter_from[base + m] = j->e->position[S->scatter_from[from]];
    T->scatter_to[base + m] =
      T->panel_begin[to] + sli_panel_at(width, local, column - S->super_first[s]);
  }
}

static void sli_edit_join_count(sli_edit_join *j) {
  const sl_symbolic *S = j->e->S, *fresh = &j->r.T;
  sl_symbolic *T = j->T;
  sl_off m, total = 0;
  sl_int s, t;
  memset(T->scatter_begin, 0, ((size_t)T->n_supers + 1) * sizeof(sl_off));
  for (s = 0; s < S->n_supers; s++) {
    if (j->e->mark[s] == SLI_NODE_KEPT) {
      T->scatter_begin[j->super_new[s]] = S->scatter_begin[s + 1] - S->scatter_begin[s];
    }
  }
  for (t = 0; t < fresh->n_supers; t++) {
    for (m = fresh->scatter_begin[t]; m < fresh->scatter_begin[t + 1]; m++) {
      T->scatter_begin[j->r.T_new[t]] += fresh->scatter_from[m] != -1;
    }
  }
  for (s = 0; s <= T->n_supers; s++) {
    const sl_off here = T->scatter_begin[s];
    T->scatter_begin[s] = total;
    total += here;
  }
}

static sl_int sli_edit_join_fundamental(const sl_symbolic *T, sl_int *children) {
  sl_int k, count = T->n;
  memset(children, 0, (size_t)T->n * sizeof(sl_int));
  for (k = 0; k < T->n; k++) {
    if (T->parent[k] != -1) {
      children[T->parent[k]] += T->counts[k] == T->counts[T->parent[k]] + 1 ? 1 : 2;
    }
  }
  for (k = 0; k < T->n; k++) {
    count -= children[k] == 1;
  }
  return count;
}

static void sli_edit_join_fill(sli_edit_join *j, sl_stats *stats) {
  const sl_symbolic *S = j->e->S;
  sl_symbolic *T = j->T;
  sl_int s, t;
  sli_edit_join_number(j);
  sli_edit_join_maps(j);
  sli_edit_join_count(j);
  for (s = 0; s < S->n_supers; s++) {
    if (j->e->mark[s] == SLI_NODE_KEPT) {
      const int is_moved = sli_edit_join_rows(j, s);
      sli_edit_join_map(j, s, is_moved);
    }
  }
  for (t = 0; t < j->r.T.n_supers; t++) {
    sl_off at = T->scatter_begin[j->r.T_new[t]];
    sli_joint_fill_fresh(T, &j->r, t, &at);
  }
  sli_fill_steps(T);
  sli_fill_descendants(T);
  sli_fill_relative(T, j->e->cursor);
  sli_fill_identity(T, stats->symbolic.triangle);
  stats->symbolic.nnz_a = T->scatter_begin[T->n_supers];
  sli_analyze_stats(T, j->e->cursor, stats);
  stats->symbolic.supernodes_fundamental = sli_edit_join_fundamental(T, j->e->cursor);
}

static sl_status sli_edit_join_make(sl_symbolic **out, sli_edit_join *j, const sl_allocator *a,
                  sl_stats *stats) {
  const sl_symbolic *S = j->e->S;
  sl_symbolic draft;
  sli_block b = {NULL, 0, 0};
  sl_off rows, entries = 0;
  sl_int s, k;
  int pass;
  sl_status status = sli_edit_join_room(j, a);
  memset(&draft, 0, sizeof draft);
  draft.allocator = *a;
  draft.n = j->e->n;
  draft.nnz_input = sli_nnz(j->e->B);
  (void)sli_pattern_hash(j->e->B, &draft.pattern);
  draft.n_supers = j->r.T.n_supers;
  rows = j->r.T.rows_begin[j->r.T.n_supers];
  for (s = 0; s < S->n_supers; s++) {
    if (j->e->mark[s] == SLI_NODE_KEPT) {
      draft.n_supers++;
      rows += S->rows_begin[s + 1] - S->rows_begin[s];
      entries += S->scatter_begin[s + 1] - S->scatter_begin[s];
    }
  }
  for (k = 0; k < j->r.n_entries; k++) {
    entries += j->r.entry_from[k] != -1;
  }
  for (pass = 0; pass < 2 && status == SL_OK; pass++) {
    (void)sli_take(&b, 1, sizeof(sl_symbolic));
    sli_symbolic_layout(&draft, &b, rows, entries);
    stats->symbolic.bytes = b.used;
    status = pass == 0 ? sli_block_alloc(&b, a) : SL_OK;
  }
  if (status != SL_OK) {
    return status;
  }
  j->T = &draft;
  sli_edit_join_fill(j, stats);
  draft.stats = *stats;
  *out = (sl_symbolic *)(void *)b.base;
  **out = draft;
  return SL_OK;
}

/* src/impl/change/edit.h: sl_symbolic_edit: the analysis of an edited matrix from that of the matrix before */

#define SLI_EDIT_MOST_ACTIVE 0.25

#define SLI_EDIT_DUE 1.1

static sl_status sli_edit_arguments(const sl_symbolic *S, const sl_csc *A, const sl_csc *B,
                  const sl_int *new_of, const sl_options *opt) {
  sli_hash pattern;
  if (S == NULL || A == NULL || B == NULL || (S->n > 0 && new_of == NULL) ||
    !sli_symbolic_options_are_valid(opt) || (A->n_cols > 0 && A->p == NULL)) {
    return SL_ERR_ARGUMENT;
  }
  if (S->is_pivoted || S->nnz_input < 0) {
    return SL_ERR_UNSUPPORTED;
  }
  if (A->n_rows != S->n || A->n_cols != S->n || sli_nnz(A) != S->nnz_input) {
    return SL_ERR_PATTERN;
  }
  if (sli_nnz(A) > 0 && A->i == NULL) {
    return SL_ERR_ARGUMENT;
  }
  return sli_pattern_hash(A, &pattern) && sli_hash_equals(pattern, S->pattern) ? SL_OK
                                         : SL_ERR_PATTERN;
}

static sl_status sli_edit_find(sli_edit *e, int *is_local, const sl_allocator *a, sl_stats *stats) {
  sli_block b = {NULL, 0, 0};
  sl_status status = SL_OK;
  int pass;
  *is_local = 0;
  for (pass = 0; pass < 2 && status == SL_OK; pass++) {
    sli_edit_layout(e, &b);
    status = pass == 0 ? sli_block_alloc(&b, a) : SL_OK;
  }
  e->blocks[0] = b.base;
  status = status == SL_OK ? sli_edit_rows(e, stats) : status;
  if (status != SL_OK) {
    return status;
  }
  sli_edit_match(e);
  sli_edit_list(e);
  if (e->n_active > SLI_EDIT_MOST_ACTIVE * e->n) {
    return SL_OK;
  }
  status = sli_edit_neighbors(e, a);
  if (status != SL_OK || !sli_edit_place_all(e)) {
    return status;
  }
  sli_edit_mark(e);
  sli_edit_collect(e);
  *is_local = 1;
  return sli_edit_order(e, a);
}

static sl_status sli_edit_analyze(sl_symbolic **out, sli_edit *e, const sl_options *opt,
                  const sl_allocator *a, double started, sl_stats *stats) {
  const double ordered = sli_seconds();
  sli_edit_join j;
  sl_stats found;
  sl_status status;
  memset(&j, 0, sizeof j);
  memset(&found, 0, sizeof found);
  j.e = e;
  found.symbolic.triangle = e->triangle;
  status = sli_edit_analyze_fresh(e, &j.r, opt == NULL ? SL_RELAXATION_DEFAULT : opt->relaxation,
                  a, &found);
  found.symbolic.seconds_tree = sli_seconds() - ordered;
  if (status == SL_OK) {
    status = sli_edit_join_make(out, &j, a, &found);
  }
  if (status == SL_OK) {
    sl_symbolic_info *info = &(*out)->stats.symbolic;
    info->seconds_order = ordered - started;
    info->seconds_analyze = sli_seconds() - ordered;
    info->seconds_structure = info->seconds_analyze - info->seconds_tree;
    sl_symbolic_stats(*out, stats);
  }
  sli_restriction_free(&j.r, a);
  sli_free(a, j.block);
  return status;
}

static void sli_edit_count(sl_symbolic *T, const sli_edit *e, int is_anew, double started,
               sl_edit_info *info) {
  const sl_symbolic *S = e->S;
  const sl_symbolic_info *now = &T->stats.symbolic, *before = &S->stats.symbolic;
  memset(info, 0, sizeof *info);
  info->is_anew = is_anew;
  info->changed = e->n_active;
  info->moved = is_anew ? 0 : e->moved;
  info->reordered = is_anew ? e->n : e->n_grouped;
  info->computed = is_anew ? e->n : e->n_fresh;
  info->growth = 1.0;
  if (!is_anew) {
    T->ordered_l = S->ordered_l > 0 ? S->ordered_l : before->nnz_l;
    T->ordered_a = S->ordered_a > 0 ? S->ordered_a : before->nnz_a;
  }
  if (!is_anew && T->ordered_a > 0 && T->ordered_l > 0 && now->nnz_a > 0) {
    info->growth = ((double)now->nnz_l / (double)T->ordered_l) /
             ((double)now->nnz_a / (double)T->ordered_a);
  }
  info->is_due = info->growth > SLI_EDIT_DUE;
  info->seconds = sli_seconds() - started;
}

SL_API sl_status sl_symbolic_edit(sl_symbolic **out, const sl_symbolic *S, const sl_csc *A,
                  const sl_csc *B, const sl_int *new_of, const sl_options *opt,
                  sl_stats *stats) {
  const double started = sli_seconds();
  const sl_allocator a = sli_allocator(opt);
  sli_edit e;
  sl_edit_info info;
  sl_status status;
  int is_local = 0, k;
  sli_stats_clear_error(stats);
  if (out == NULL) {
    return SL_ERR_ARGUMENT;
  }
  *out = NULL;
  status = sli_edit_arguments(S, A, B, new_of, opt);
  status = status == SL_OK ? sl_csc_check(B, stats) : status;
  if (status == SL_OK && B->n_rows != B->n_cols) {
    status = SL_ERR_ARGUMENT;
  }
  memset(&e, 0, sizeof e);
  if (status == SL_OK) {
    e.S = S;
    e.A = A;
    e.B = B;
    e.new_of = new_of;
    e.n = B->n_cols;
    status = sli_csc_triangle(B, &e.triangle, opt, stats);
  }
  status = status == SL_OK ? sli_edit_find(&e, &is_local, &a, stats) : status;
  if (status == SL_OK) {
    status = is_local ? sli_edit_analyze(out, &e, opt, &a, started, stats)
              : sl_symbolic_create(out, B, opt, stats);
  }
  if (status == SL_OK) {
    sli_edit_count(*out, &e, !is_local, started, &info);
    if (stats != NULL) {
      stats->edit = info;
    }
  }
  for (k = 0; k < 3; k++) {
    sli_free(&a, e.blocks[k]);
  }
  return status;
}

/* save: factors in files */
/* src/impl/save/format.h: saved factors: header, table of sections, and which sections objects have */

#define SLI_READ_VERSION 2
#define SLI_READ_VERSION_DOUBLE 1
#define SLI_WRITE_VERSION 2
#define SLI_WRITE_VERSION_PLAIN 1
#define SLI_ORDER_MARK 0x01020304u
#define SLI_ORDER_MARK_SWAPPED 0x04030201u
#define SLI_SECTIONS_MAX 64

typedef struct sli_saved_header {
  unsigned char magic[8];
  uint32_t order_mark, read_version, write_version, sections;
  uint64_t bytes;
  uint64_t checksum;
  uint64_t reserved[3];
} sli_saved_header;

typedef struct sli_section {
  uint32_t id;
  uint32_t word;
  uint64_t offset, bytes;
  uint64_t checksum;
} sli_section;

enum {
  SLI_SECTION_ANALYSIS = 1,
  SLI_SECTION_FACTOR = 2,
  SLI_SECTION_PERM = 16,
  SLI_SECTION_D = 64,
  SLI_FACTOR_SECTIONS = 17,
  SLI_SECTION_REGIONS = 96,
  SLI_SECTION_REGION_LIST,
  SLI_SECTION_REGION_ROOTS,
  SLI_SECTION_REGION_ROWS,
  SLI_SECTION_REGION_Z,
  SLI_REGION_SECTIONS = 5,
  SLI_SECTION_SELECTED = 104,
  SLI_SELECTED_SECTIONS = 4
};

static const uint32_t sli_region_words[SLI_REGION_SECTIONS] = {8, 8, 4, 4, 8};
static const uint32_t sli_selected_words[SLI_SELECTED_SECTIONS] = {8, 4, 8, 8};

typedef struct sli_saved_analysis {
  int64_t n, supers, nodes, nnz_input, rows, entries, panels;
  int64_t tallest, widest, triangle, nnz_l, fundamental, tree_height, components;
  int64_t is_pivoted, pairs, delayed;
  uint64_t pattern[2], identity[2];
  double flops;
  uint64_t reserved[2];
} sli_saved_analysis;

typedef struct sli_saved_factor {
  int64_t method, null_pivots, has_mass, has_signs, checks, is_centered, nulls, anchors;
  int64_t positive, negative, null, regularized, weak, regular;
  double pivot_min, pivot_max, entry_max, growth;
  double null_tolerance, regularization, consistency, growth_limit, error_limit;
  uint64_t identity[2];
  int64_t null_vectors;
  int64_t storage;
  uint64_t reserved[5];
} sli_saved_factor;

typedef struct sli_saved_part {
  int64_t count;
  uint64_t identity[2];
  int64_t reserved[5];
} sli_saved_part;

typedef struct sli_saved_region {
  int64_t roots, rows, is_copied;
  int64_t reserved[5];
} sli_saved_region;

typedef struct sli_saved {
  sli_saved_header header;
  sli_section table[SLI_SECTIONS_MAX];
  sli_saved_analysis analysis;
  sli_saved_factor factor;
  sli_saved_part regions, selected;
  const sl_saved_set *set;
  const void *data[SLI_SECTIONS_MAX];
  uint64_t used[SLI_SECTIONS_MAX];
  sl_int first_array;
  sl_int first_number;
} sli_saved;

static const unsigned char sli_saved_magic[8] = {0x89, 'S', 'L', 'F', 13, 10, 26, 10};

SLI_INLINE uint64_t sli_round_up(uint64_t bytes) {
  return (bytes + SLI_ALIGN - 1) / SLI_ALIGN * SLI_ALIGN;
}

SLI_INLINE uint64_t sli_saved_prefix(const sli_saved *f) {
  return sli_round_up(sizeof f->header + f->header.sections * sizeof(sli_section));
}

static void sli_saved_add(sli_saved *f, uint32_t id, uint32_t word, const void *data,
              uint64_t count, uint64_t used) {
  const uint32_t k = f->header.sections++;
  f->table[k].id = id;
  f->table[k].word = word;
  f->table[k].bytes = count * word;
  f->data[k] = data;
  f->used[k] = used * word;
}

static void sli_saved_add_analysis(sli_saved *f, const sl_symbolic *S) {
  const sli_saved_analysis *a = &f->analysis;
  const uint64_t n = (uint64_t)a->n, supers = (uint64_t)a->supers, rows = (uint64_t)a->rows,
           entries = (uint64_t)a->entries, nodes = (uint64_t)a->nodes;
  uint32_t id = SLI_SECTION_PERM;
#define SLI_ADD(word, array, count) sli_saved_add(f, id++, word, S->array, count, count)
  f->first_array = (sl_int)f->header.sections;
  SLI_ADD(4, perm, n);
  SLI_ADD(4, iperm, n);
  SLI_ADD(4, parent, n);
  SLI_ADD(4, counts, n);
  SLI_ADD(4, super_of, n);
  SLI_ADD(4, super_first, supers + 1);
  SLI_ADD(4, super_parent, supers);
  SLI_ADD(8, rows_begin, supers + 1);
  SLI_ADD(4, rows, rows);
  SLI_ADD(8, panel_begin, supers + 1);
  SLI_ADD(32, steps, supers);
  SLI_ADD(4, first_descendant, supers);
  SLI_ADD(1, pairs, a->pairs > 0 ? n : 0);
  SLI_ADD(4, relative, rows);
  SLI_ADD(8, scatter_begin, supers + 1);
  SLI_ADD(4, scatter_from, entries);
  SLI_ADD(8, scatter_to, entries);
  SLI_ADD(4, node_of, nodes > 0 ? n : 0);
  SLI_ADD(4, node_parent, nodes);
  SLI_ADD(4, node_level, nodes);
#undef SLI_ADD
}

static void sli_saved_add_factor(sli_saved *f, const sl_factor *F, int has_factor) {
  const sli_saved_factor *g = &f->factor;
  const uint64_t n = has_factor ? (uint64_t)f->analysis.n : 0;
  const uint64_t regularized = g->regularization != 0.0 ? n : 0;
  const uint64_t skipped = g->null_pivots == SL_NULL_PIVOT_SKIP ? n : 0;
  const uint64_t vectors = g->null_vectors > 1 ? skipped * (uint64_t)g->null_vectors : skipped;
  const uint64_t weighted = g->has_mass ? n : 0;
  const uint64_t trees = g->has_mass ? (uint64_t)f->analysis.components : 0;
  const uint64_t anchors = g->is_centered ? (uint64_t)g->anchors : 0;
  const uint64_t panels = has_factor ? (uint64_t)f->analysis.panels : 0;
  const uint64_t supers = has_factor ? (uint64_t)f->analysis.supers : 0;
  const uint64_t paired = f->analysis.pairs > 0 ? n : 0;
  const uint64_t divisors = paired > 0 ? n : weighted;
  uint32_t id = SLI_SECTION_D;
#define SLI_ADD(word, array, count, used) sli_saved_add(f, id++, word, F->array, count, used)
  f->first_number = (sl_int)f->header.sections;
  SLI_ADD(8, D, n, n);
  SLI_ADD(8, E, paired, paired);
  SLI_ADD(8, divisors, divisors, paired > 0 || g->is_centered ? divisors : 0);
  SLI_ADD(24, extents, supers, supers);
  SLI_ADD(1, rule.signs, regularized, g->has_signs ? n : 0);
  SLI_ADD(8, rule.shifts, regularized, regularized);
  SLI_ADD(4, regularized, regularized, (uint64_t)g->regularized);
  SLI_ADD(4, nulls, skipped, (uint64_t)g->nulls);
  SLI_ADD(1, rule.kinds, skipped, skipped);
  SLI_ADD(8, z, vectors, vectors);
  SLI_ADD(8, g, vectors, g->nulls > 0 ? vectors : 0);
  SLI_ADD(4, anchors, trees, anchors);
  SLI_ADD(8, squares, trees, anchors);
  SLI_ADD(8, mass, weighted, weighted);
  SLI_ADD(8, center, weighted, g->is_centered ? weighted : 0);
  SLI_ADD(8, ratios, trees, anchors);
  if (g->storage == SL_STORAGE_FLOAT) {
    SLI_ADD(8, values, 0, 0);
    SLI_ADD(4, values, panels, panels);
  } else {
    SLI_ADD(8, values, panels, panels);
  }
#undef SLI_ADD
}

static void sli_saved_region_bytes(const sli_saved_region *record, uint64_t *bytes) {
  bytes[0] = sizeof *record;
  bytes[1] = sli_round_up(4 * (uint64_t)record->roots);
  bytes[2] = sli_round_up(4 * (uint64_t)record->rows);
  bytes[3] = 8 * (uint64_t)sli_region_entries((sl_int)record->rows);
}

static sli_saved_region sli_saved_region_of(const sl_region *R) {
  sli_saved_region record;
  memset(&record, 0, sizeof record);
  record.roots = R->extent.n_roots;
  record.rows = R->extent.n_rows;
  record.is_copied = R->is_copied;
  return record;
}

static int sli_saved_add_regions(sli_saved *f, const sl_saved_set *set) {
  const uint32_t first = f->header.sections + 1;
  sl_int k;
  int m;
  f->regions.count = set->n_regions;
  f->set = set;
  for (m = 0; m < SLI_REGION_SECTIONS; m++) {
    sli_saved_add(f, (uint32_t)SLI_SECTION_REGIONS + (uint32_t)m, sli_region_words[m],
            m == 0 ? &f->regions : NULL, m == 0 ? sizeof f->regions / 8 : 0,
            m == 0 ? sizeof f->regions / 8 : 0);
  }
  for (k = 0; k < set->n_regions; k++) {
    const sli_saved_region record = sli_saved_region_of(set->regions[k]);
    uint64_t bytes[SLI_REGION_SECTIONS - 1];
    sli_saved_region_bytes(&record, bytes);
    for (m = 0; m < SLI_REGION_SECTIONS - 1; m++) {
      f->table[first + (uint32_t)m].bytes += bytes[m];
    }
    if (f->table[first + 3].bytes >> 62 != 0) {
      return 0;
    }
  }
  return 1;
}

static void sli_saved_add_selected(sli_saved *f, const sl_selected *Z) {
  const uint64_t count = (uint64_t)Z->traversal.forest.count, entries = (uint64_t)Z->begin[count];
  const uint64_t counts[SLI_SELECTED_SECTIONS] = {sizeof f->selected / 8, count, count + 1,
                          entries};
  const void *data[SLI_SELECTED_SECTIONS];
  int m;
  f->selected.count = (int64_t)count;
  data[0] = &f->selected;
  data[1] = Z->traversal.supers;
  data[2] = Z->begin;
  data[3] = Z->Z;
  for (m = 0; m < SLI_SELECTED_SECTIONS; m++) {
    sli_saved_add(f, (uint32_t)SLI_SECTION_SELECTED + (uint32_t)m, sli_selected_words[m],
            data[m], counts[m], counts[m]);
  }
}

static void sli_saved_add_base(sli_saved *f, const sl_symbolic *S, const sl_factor *F,
                 int has_factor) {
  f->header.sections = 0;
  sli_saved_add(f, SLI_SECTION_ANALYSIS, 8, &f->analysis, sizeof f->analysis / 8,
          sizeof f->analysis / 8);
  sli_saved_add(f, SLI_SECTION_FACTOR, 8, &f->factor, has_factor ? sizeof f->factor / 8 : 0,
          has_factor ? sizeof f->factor / 8 : 0);
  sli_saved_add_analysis(f, S);
  sli_saved_add_factor(f, F, has_factor);
}

static int sli_saved_place(sli_saved *f) {
  const uint64_t limit = UINT64_C(1) << 62;
  uint64_t at = sli_saved_prefix(f);
  uint32_t k;
  for (k = 0; k < f->header.sections; k++) {
    f->table[k].offset = at;
    at += sli_round_up(f->table[k].bytes);
    if (at >= limit) {
      return 0;
    }
  }
  f->header.bytes = at;
  return 1;
}

typedef struct sli_checksum {
  uint64_t chain[4];
  uint64_t bytes;
} sli_checksum;

static sli_checksum sli_checksum_begin(void) {
  const sli_hash none = {0, 0};
  sli_checksum c;
  sli_hash_begin(none, c.chain);
  c.bytes = 0;
  return c;
}

static void sli_checksum_add(sli_checksum *c, const void *data, size_t bytes) {
  (void)sli_hash_stripes(c->chain, data, bytes, SLI_HASH_BYTES, 0);
  c->bytes += sli_round_up(bytes);
}

static uint64_t sli_checksum_end(const sli_checksum *c) {
  const sli_hash h = sli_hash_end(c->chain, c->bytes);
  return h.a ^ h.b;
}

static uint64_t sli_prefix_checksum(const unsigned char *prefix, size_t bytes) {
  sli_checksum c = sli_checksum_begin();
  sli_saved_header header;
  memcpy(&header, prefix, sizeof header);
  header.checksum = 0;
  sli_checksum_add(&c, &header, sizeof header);
  sli_checksum_add(&c, prefix + sizeof header, bytes - sizeof header);
  return sli_checksum_end(&c);
}

/* src/impl/save/decode.h: from the bytes of a header, a table and numbers to what they mean; byte order */

SLI_INLINE void sli_swap(unsigned char *at, int bytes) {
  int k;
  for (k = 0; k < bytes / 2; k++) {
    const unsigned char keep = at[k];
    at[k] = at[bytes - 1 - k];
    at[bytes - 1 - k] = keep;
  }
}

static void sli_swap_words(void *data, uint32_t word, uint64_t bytes) {
  unsigned char *at = (unsigned char *)data, *end = at + bytes;
  for (; word > 1 && at < end; at += word) {
    uint32_t k = word == 4 ? 0 : 8;
    sli_swap(at, word == 4 ? 4 : 8);
    if (word == 24) {
      sli_swap(at + k, 8);
      k += 8;
    }
    for (; word > 8 && k < word; k += 4) {
      sli_swap(at + k, 4);
    }
  }
}

static sl_status sli_decode_header(sli_saved_header *h, int *swapped) {
  if (memcmp(h->magic, sli_saved_magic, sizeof sli_saved_magic) != 0 ||
    (h->order_mark != SLI_ORDER_MARK && h->order_mark != SLI_ORDER_MARK_SWAPPED)) {
    return SL_ERR_UNSUPPORTED;
  }
  *swapped = h->order_mark != SLI_ORDER_MARK;
  if (*swapped) {
    sli_swap_words(&h->order_mark, 4, 16);
    sli_swap_words(&h->bytes, 8, 16);
  }
  if (h->read_version < 1 || h->read_version > SLI_READ_VERSION) {
    return SL_ERR_UNSUPPORTED;
  }
  return h->sections <= SLI_SECTIONS_MAX ? SL_OK : SL_ERR_IO;
}

SLI_INLINE int sli_count_is_valid(int64_t count, int64_t most) {
  return count >= 0 && count <= most;
}

static int sli_decode_analysis(const sli_saved_analysis *a, sl_symbolic *S) {
  const int64_t many = INT64_C(1) << 58;
  sl_symbolic_info *info = &S->stats.symbolic;
  if (!sli_count_is_valid(a->n, SLI_ROWS_MAX) || !sli_count_is_valid(a->supers, a->n) ||
    (a->n > 0) != (a->supers > 0) || !sli_count_is_valid(a->nodes, a->n + 1) ||
    !sli_count_is_valid(a->nnz_input, INT32_MAX) || !sli_count_is_valid(a->rows, many) ||
    !sli_count_is_valid(a->entries, a->nnz_input) || !sli_count_is_valid(a->panels, many) ||
    !sli_count_is_valid(a->tallest, a->n) || !sli_count_is_valid(a->widest, a->n) ||
    !sli_count_is_valid(a->triangle, SL_TRIANGLE_BOTH) || !sli_count_is_valid(a->nnz_l, many) ||
    !sli_count_is_valid(a->fundamental, a->n) || !sli_count_is_valid(a->tree_height, a->n) ||
    !sli_count_is_valid(a->components, a->n) || !sli_count_is_valid(a->is_pivoted, 1) ||
    !sli_count_is_valid(a->pairs, a->is_pivoted ? a->n / 2 : 0) ||
    !sli_count_is_valid(a->delayed, a->is_pivoted ? INT32_MAX : 0) || !(a->flops >= 0.0) ||
    !sli_is_finite(a->flops)) {
    return 0;
  }
  S->n = (sl_int)a->n;
  S->n_supers = (sl_int)a->supers;
  S->n_nodes = (sl_int)a->nodes;
  S->nnz_input = (sl_int)a->nnz_input;
  S->is_pivoted = (int)a->is_pivoted;
  S->n_pairs = (sl_int)a->pairs;
  S->tallest = (sl_int)a->tallest;
  S->widest = (sl_int)a->widest;
  S->pattern.a = a->pattern[0];
  S->pattern.b = a->pattern[1];
  S->identity.a = a->identity[0];
  S->identity.b = a->identity[1];
  info->n = S->n;
  info->triangle = (sl_triangle)a->triangle;
  info->nnz_a = a->entries;
  info->nnz_l = a->nnz_l;
  info->nnz_panels = a->panels;
  info->flops = a->flops;
  info->supernodes = S->n_supers;
  info->supernodes_fundamental = (sl_int)a->fundamental;
  info->tree_height = (sl_int)a->tree_height;
  info->components = (sl_int)a->components;
  info->pairs = S->n_pairs;
  info->delayed = (sl_int)a->delayed;
  return 1;
}

static int sli_decode_factor(const sli_saved_factor *g, const sl_symbolic *S, sl_factor *F) {
  const int skips = g->null_pivots == SL_NULL_PIVOT_SKIP;
  const int64_t n = S->n;
  sl_factor_info *info = &F->stats.factor;
  if ((g->method != SL_METHOD_UP_LOOKING && g->method != SL_METHOD_SUPERNODAL) ||
    !sli_count_is_valid(g->null_pivots, SL_NULL_PIVOT_SKIP) ||
    !sli_count_is_valid(g->has_mass, skips) || !sli_count_is_valid(g->checks, skips) ||
    !sli_count_is_valid(g->nulls, skips ? n : 0) || g->null != g->nulls ||
    !sli_count_is_valid(g->is_centered, g->nulls > 0 && g->has_mass) ||
    !sli_count_is_valid(g->anchors, g->is_centered ? S->stats.symbolic.components : 0) ||
    !(g->regularization >= 0.0) || !sli_is_finite(g->regularization) ||
    (skips && (g->regularization != 0.0 || S->is_pivoted)) ||
    (S->n_pairs > 0 && g->method != SL_METHOD_SUPERNODAL) || !(g->growth_limit > 0.0) ||
    !(g->error_limit > 0.0) || !(g->growth >= 0.0) || !(g->entry_max >= 0.0) ||
    !sli_count_is_valid(g->has_signs, g->regularization != 0.0) ||
    !sli_count_is_valid(g->regularized, g->regularization != 0.0 ? n : 0) ||
    !sli_count_is_valid(g->positive, n) || !sli_count_is_valid(g->negative, n) ||
    !sli_count_is_valid(g->weak, n) || !sli_count_is_valid(g->regular, n) ||
    !sli_count_is_valid(g->null_vectors, skips && !g->has_mass ? SLI_NULL_VECTORS_MAX : 1) ||
    !sli_count_is_valid(g->storage, g->method == SL_METHOD_SUPERNODAL ? SL_STORAGE_FLOAT : 0) ||
    g->null_tolerance != g->null_tolerance || g->consistency != g->consistency) {
    return 0;
  }
  F->S = S;
  F->analysis = S->identity;
  F->method = (sl_method)g->method;
  F->storage = (sl_storage)g->storage;
  F->null_pivots = (sl_null_pivots)g->null_pivots;
  F->checks = (int)g->checks;
  F->is_centered = (int)g->is_centered;
  F->n_nulls = (sl_int)g->nulls;
  F->null_vectors = sli_max((sl_int)g->null_vectors, 1);
  F->n_anchors = (sl_int)g->anchors;
  F->consistency = g->consistency;
  F->growth_limit = g->growth_limit;
  F->error_limit = g->error_limit;
  F->rule.null_tolerance = g->null_tolerance;
  F->rule.regularization = g->regularization;
  F->rule.replaces = skips || g->regularization != 0.0;
  F->identity.a = g->identity[0];
  F->identity.b = g->identity[1];
  F->generation = 1;
  F->is_valid = 1;
  F->status = SL_OK;
  info->positive = (sl_int)g->positive;
  info->negative = (sl_int)g->negative;
  info->null = (sl_int)g->null;
  info->regularized = (sl_int)g->regularized;
  info->weak = (sl_int)g->weak;
  info->regular = (sl_int)g->regular;
  info->pivot_min = g->pivot_min;
  info->pivot_max = g->pivot_max;
  info->entry_max = g->entry_max;
  info->growth = g->growth;
  return 1;
}

/* src/impl/save/check.h: is a loaded analysis or factor one that this library could have made? */

static int sli_check_perm(const sl_symbolic *S) {
  sl_int k;
  for (k = 0; k < S->n; k++) {
    const sl_int i = S->perm[k];
    if (i < 0 || i >= S->n || S->iperm[i] != k) {
      return 0;
    }
  }
  return 1;
}

static int sli_check_supers(const sl_symbolic *S) {
  sl_int s, c, k = 0, children = 0, visited = 0;
  if (S->super_first[0] != 0 || S->super_first[S->n_supers] != S->n) {
    return 0;
  }
  for (s = 0; s < S->n_supers; s++) {
    const sl_int up = S->super_parent[s], first = S->first_descendant[s];
    if (S->super_first[s + 1] <= k || S->super_first[s + 1] > S->n ||
      (up != -1 && (up <= s || up >= S->n_supers)) || first < 0 || first > s) {
      return 0;
    }
    for (; k < S->super_first[s + 1]; k++) {
      if (S->super_of[k] != s) {
        return 0;
      }
    }
    children += up != -1;
    for (c = s - 1; c >= first; c = S->first_descendant[c] - 1) {
      if (S->super_parent[c] != s) {
        return 0;
      }
      visited++;
    }
    if (c != first - 1) {
      return 0;
    }
  }
  return visited == children;
}

static int sli_check_parent(const sl_symbolic *S, sl_int k, sl_int up) {
  const sl_int s = S->super_of[k], end = S->super_first[s + 1];
  if (S->n_pairs > 0) {
    return up == -1 || (up > k && up < S->n);
  }
  if (k + 1 < end) {
    return up > k && up < end;
  }
  return up == (S->steps[s].below > 0 ? S->rows[S->rows_begin[s]] : -1);
}

static int sli_check_tree(const sl_symbolic *S, const sli_saved_analysis *a) {
  sl_off nnz_l = 0;
  sl_int k, roots = 0;
  for (k = 0; k < S->n; k++) {
    const sl_int s = S->super_of[k], end = S->super_first[s + 1];
    if (!sli_check_parent(S, k, S->parent[k]) || S->counts[k] < 1 ||
      S->counts[k] > end - k + S->steps[s].below) {
      return 0;
    }
    roots += S->parent[k] == -1;
    nnz_l += S->counts[k];
  }
  return roots == a->components && nnz_l == a->nnz_l;
}

static int sli_check_relative(const sl_symbolic *S, sl_int up, const sl_int *rows,
                const sl_int *local, sl_int count) {
  const sl_int first = S->super_first[up], width = S->super_first[up + 1] - first;
  const sl_int *below = S->rows + S->rows_begin[up];
  const uint32_t n_below = (uint32_t)(S->rows_begin[up + 1] - S->rows_begin[up]);
  sl_int k;
  for (k = 0; k < count && local[k] < width; k++) {
    if (local[k] < 0 || rows[k] != first + local[k]) {
      return 0;
    }
  }
  for (; k < count; k++) {
    const uint32_t at = (uint32_t)local[k] - (uint32_t)width;
    if (at >= n_below || rows[k] != below[at]) {
      return 0;
    }
  }
  return 1;
}

static int sli_check_front(const sl_symbolic *S, sl_int s) {
  const sl_int first = S->super_first[s], end = S->super_first[s + 1], up = S->super_parent[s];
  const sl_int *rows = S->rows + S->rows_begin[s];
  const sli_step *step = &S->steps[s];
  sl_int k, last = end - 1, ascend = 1;
  if (step->panel != S->panel_begin[s] || step->column != first || step->base != first ||
    step->width != end - first || step->first_tile != 0 || step->up != up ||
    step->below != S->rows_begin[s + 1] - S->rows_begin[s] ||
    (step->below == 0) != (up == -1)) {
    return 0;
  }
  if (up == -1) {
    return 1;
  }
  for (k = 0; k < step->below; k++) {
    ascend &= rows[k] > last;
    last = rows[k];
  }
  return ascend && last < S->n && S->super_of[rows[0]] == up &&
       sli_check_relative(S, up, rows, S->relative + S->rows_begin[s], step->below);
}

static int sli_check_structure(const sl_symbolic *S) {
  sl_int s, tallest = 0, widest = 0;
  if (S->rows_begin[0] != 0 || S->panel_begin[0] != 0) {
    return 0;
  }
  for (s = 0; s < S->n_supers; s++) {
    const sl_int width = S->super_first[s + 1] - S->super_first[s];
    const sl_off below = S->rows_begin[s + 1] - S->rows_begin[s];
    if (S->rows_begin[s + 1] < S->rows_begin[s] || below > S->n - S->super_first[s + 1] ||
      S->panel_begin[s + 1] != S->panel_begin[s] + sli_panel_size(width, (sl_int)below)) {
      return 0;
    }
    widest = sli_max(widest, width);
    tallest = sli_max(tallest, width + (sl_int)below);
  }
  for (s = 0; s < S->n_supers; s++) {
    if (!sli_check_front(S, s)) {
      return 0;
    }
  }
  return tallest == S->tallest && widest == S->widest;
}

static int sli_check_scatter_panel(const sl_symbolic *S, sl_int s, sl_int width, sl_int height) {
  const uint64_t size = (uint64_t)(S->panel_begin[s + 1] - S->panel_begin[s]);
  const uint32_t n_from = (uint32_t)S->nnz_input;
  uint64_t begin = 0, end = (uint64_t)sli_tile_offset(width, 1);
  uint32_t tile = 0, last = 0;
  int wrong = 0;
  sl_off m;
  for (m = S->scatter_begin[s]; m < S->scatter_begin[s + 1]; m++) {
    const uint64_t at = (uint64_t)S->scatter_to[m] - (uint64_t)S->panel_begin[s];
    uint32_t row, column;
    if (at >= size) {
      return 0;
    }
    while (at >= end) {
      tile++;
      begin = end;
      end = (uint64_t)sli_tile_offset(width, (sl_int)tile + 1);
    }
    row = SLI_TILE * tile + (uint32_t)(at % SLI_TILE);
    column = (uint32_t)((at - begin) / SLI_TILE);
    wrong |= (int)((uint32_t)S->scatter_from[m] >= n_from) | (int)(at < begin) |
         (int)(row < last) | (int)(row >= (uint32_t)height) | (int)(row < column);
    last = row;
  }
  return !wrong;
}

static int sli_check_scatter(const sl_symbolic *S) {
  sl_int s;
  if (S->scatter_begin[0] != 0) {
    return 0;
  }
  for (s = 0; s < S->n_supers; s++) {
    if (S->scatter_begin[s + 1] < S->scatter_begin[s] ||
      S->scatter_begin[s + 1] > S->scatter_begin[S->n_supers] ||
      !sli_check_scatter_panel(S, s, S->steps[s].width,
                   S->steps[s].width + S->steps[s].below)) {
      return 0;
    }
  }
  return 1;
}

static int sli_check_nodes(const sl_symbolic *S) {
  sl_int k;
  for (k = 0; k < S->n && S->n_nodes > 0; k++) {
    if (S->node_of[k] < 0 || S->node_of[k] >= S->n_nodes) {
      return 0;
    }
  }
  for (k = S->n_nodes - 1; k >= 0; k--) {
    const sl_int up = S->node_parent[k];
    if (up != -1 && (up <= k || up >= S->n_nodes)) {
      return 0;
    }
    if (S->node_level[k] != (up == -1 ? 0 : S->node_level[up] + 1)) {
      return 0;
    }
  }
  return 1;
}

static int sli_check_pairs(const sl_symbolic *S) {
  sl_int k, count = 0;
  for (k = 0; k < S->n && S->n_pairs > 0; k++) {
    const sl_int s = S->super_of[k];
    if (S->pairs[k] == SLI_PAIR_NONE) {
      continue;
    }
    if (S->pairs[k] != SLI_PAIR_FIRST || (k - S->super_first[s]) % SLI_TILE == SLI_TILE - 1 ||
      k + 1 == S->super_first[s + 1] || S->pairs[k + 1] != SLI_PAIR_SECOND) {
      return 0;
    }
    count++;
    k++;
  }
  return count == S->n_pairs;
}

static int sli_check_analysis(const sl_symbolic *S, const sli_saved_analysis *a) {
  sl_symbolic same;
  if (!sli_check_perm(S) || !sli_check_supers(S) || !sli_check_structure(S) ||
    !sli_check_tree(S, a) || !sli_check_scatter(S) || !sli_check_pairs(S) ||
    !sli_check_nodes(S)) {
    return 0;
  }
  same = *S;
  sli_fill_identity(&same, S->stats.symbolic.triangle);
  return sli_hash_equals(same.identity, S->identity);
}

static int sli_check_columns(const sl_int *columns, sl_off count, sl_int n) {
  sl_off k;
  for (k = 0; k < count; k++) {
    if (columns[k] < (k > 0 ? columns[k - 1] + 1 : 0) || columns[k] >= n) {
      return 0;
    }
  }
  return 1;
}

static int sli_check_anchors(const sl_factor *F) {
  const sl_symbolic *S = F->S;
  sl_int k, m = 0, root = -1;
  if (!sli_check_columns(F->anchors, F->n_anchors, S->n)) {
    return 0;
  }
  for (k = 0; k < S->n && m < F->n_anchors; k++) {
    if (S->parent[k] == -1) {
      const sl_int anchor = F->anchors[m];
      m += anchor > root && anchor <= k;
      root = k;
      if (m < F->n_anchors && F->anchors[m] <= k) {
        return 0;
      }
    }
  }
  for (m = 0; m < F->n_anchors; m++) {
    const sl_int at = sli_lower_bound(F->nulls, F->n_nulls, F->anchors[m]);
    if (at == F->n_nulls || F->nulls[at] != F->anchors[m]) {
      return 0;
    }
  }
  return 1;
}

static int sli_check_extents(const sl_factor *F) {
  const sl_symbolic *S = F->S;
  sl_int s;
  for (s = 0; s < S->n_supers; s++) {
    const sli_extent *e = &F->extents[s];
    const sl_int least = e->magnitude > 0.0 ? S->super_first[s] : -1,
           most = e->magnitude > 0.0 ? S->super_first[s + 1] - 1 : -1;
    if (!(e->entry >= 0.0) || !sli_is_finite(e->entry) || !(e->magnitude >= 0.0) ||
      e->pivot < least || e->pivot > most || e->zero != 0) {
      return 0;
    }
  }
  return 1;
}

static int sli_check_blocks(const sl_factor *F) {
  sl_int k;
  for (k = 0; k < F->S->n && F->E != NULL; k++) {
    if (F->S->pairs[k] == SLI_PAIR_FIRST ? !sli_is_finite(F->E[k]) : F->E[k] != 0.0) {
      return 0;
    }
  }
  return 1;
}

static int sli_check_factor(const sl_factor *F) {
  const sl_factor_info *info = &F->stats.factor;
  const sl_int n = F->S->n;
  sl_int k, positive = 0, negative = 0, nulls = 0, shifted = 0, blocks = 0;
  if (!sli_check_columns(F->nulls, F->n_nulls, n) ||
    !sli_check_columns(F->regularized, info->regularized, n) ||
    (F->is_centered && !sli_check_anchors(F)) || !sli_check_extents(F) ||
    !sli_check_blocks(F)) {
    return 0;
  }
  for (k = 0; k < n; k++) {
    const double d = F->D[k];
    if (!sli_is_finite(d)) {
      return 0;
    }
    if (F->null_pivots == SL_NULL_PIVOT_SKIP &&
      (F->rule.kinds[k] < SLI_PIVOT_UNKNOWN || F->rule.kinds[k] > SLI_PIVOT_WEAK ||
       (F->null_vectors == 1 && F->g[k] != 0.0 && F->g[k] != F->z[k]))) {
      return 0;
    }
    if (sli_is_skipped(F, k)) {
      if (nulls == F->n_nulls || F->nulls[nulls++] != k) {
        return 0;
      }
      continue;
    }
    if (sli_is_regularized(F, k) &&
      (shifted == info->regularized || F->regularized[shifted++] != k)) {
      return 0;
    }
    if (F->E != NULL && F->S->pairs[k] != SLI_PAIR_NONE) {
      blocks++;
    } else {
      positive += d > 0.0;
      negative += d < 0.0;
    }
  }
  for (k = 0; k < n && F->rule.regularization != 0.0 && F->rule.signs != NULL; k++) {
    if (F->rule.signs[k] < -1 || F->rule.signs[k] > 1) {
      return 0;
    }
  }
  return nulls == F->n_nulls && shifted == info->regularized && info->positive >= positive &&
       info->negative >= negative &&
       info->positive - positive + (info->negative - negative) <= blocks;
}

/* src/impl/save/write.h: saves objects in memory or in a file */

static sli_saved_analysis sli_saved_analysis_of(const sl_symbolic *S) {
  const sl_symbolic_info *info = &S->stats.symbolic;
  sli_saved_analysis a;
  memset(&a, 0, sizeof a);
  a.n = S->n;
  a.supers = S->n_supers;
  a.nodes = S->n_nodes;
  a.nnz_input = S->nnz_input;
  a.rows = S->rows_begin[S->n_supers];
  a.entries = S->scatter_begin[S->n_supers];
  a.panels = S->panel_begin[S->n_supers];
  a.tallest = S->tallest;
  a.widest = S->widest;
  a.triangle = info->triangle;
  a.nnz_l = info->nnz_l;
  a.fundamental = info->supernodes_fundamental;
  a.tree_height = info->tree_height;
  a.components = info->components;
  a.is_pivoted = S->is_pivoted;
  a.pairs = S->n_pairs;
  a.delayed = info->delayed;
  a.pattern[0] = S->pattern.a;
  a.pattern[1] = S->pattern.b;
  a.identity[0] = S->identity.a;
  a.identity[1] = S->identity.b;
  a.flops = info->flops;
  return a;
}

static sli_saved_factor sli_saved_factor_of(const sl_factor *F) {
  const sl_factor_info *info = &F->stats.factor;
  sli_saved_factor g;
  memset(&g, 0, sizeof g);
  g.method = F->method;
  g.null_pivots = F->null_pivots;
  g.has_mass = F->mass != NULL;
  g.has_signs = F->rule.regularization != 0.0 && F->rule.signs != NULL;
  g.checks = F->checks;
  g.is_centered = F->n_nulls > 0 && F->is_centered;
  g.nulls = F->n_nulls;
  g.anchors = g.is_centered ? F->n_anchors : 0;
  g.positive = info->positive;
  g.negative = info->negative;
  g.null = info->null;
  g.regularized = info->regularized;
  g.weak = info->weak;
  g.regular = info->regular;
  g.pivot_min = info->pivot_min;
  g.pivot_max = info->pivot_max;
  g.entry_max = info->entry_max;
  g.growth = info->growth;
  g.null_tolerance = F->rule.null_tolerance;
  g.regularization = F->rule.regularization;
  g.consistency = F->consistency;
  g.growth_limit = F->growth_limit;
  g.error_limit = F->error_limit;
  g.identity[0] = F->identity.a;
  g.identity[1] = F->identity.b;
  g.null_vectors = F->null_vectors > 1 ? F->null_vectors : 0;
  g.storage = F->storage;
  return g;
}

typedef struct sli_sink {
  unsigned char *memory;
  FILE *file;
  int has_failed;
} sli_sink;

static void sli_put(sli_sink *to, const void *data, size_t bytes) {
  if (bytes == 0 || to->has_failed) {
    return;
  }
  if (to->file != NULL) {
    to->has_failed = fwrite(data, 1, bytes, to->file) != bytes;
  } else {
    memcpy(to->memory, data, bytes);
    to->memory += bytes;
  }
}

static void sli_put_filled(sli_sink *to, sli_checksum *sum, const void *data, uint64_t used,
               uint64_t bytes) {
  static const unsigned char zeros[1024] = {0};
  uint64_t left = bytes - used;
  if (to == NULL) {
    sli_checksum_add(sum, data, (size_t)used);
    left = bytes - sum->bytes;
  } else {
    sli_put(to, data, (size_t)used);
  }
  while (left > 0) {
    const size_t piece = left < sizeof zeros ? (size_t)left : sizeof zeros;
    if (to == NULL) {
      sli_checksum_add(sum, zeros, piece);
    } else {
      sli_put(to, zeros, piece);
    }
    left -= piece;
  }
}

static void sli_put_piece(sli_sink *to, sli_checksum *sum, const void *data, uint64_t bytes) {
  if (to == NULL) {
    sli_checksum_add(sum, data, (size_t)bytes);
  } else {
    sli_put_filled(to, NULL, data, bytes, sli_round_up(bytes));
  }
}

static void sli_put_regions(const sli_saved *f, uint32_t id, sli_sink *to, sli_checksum *sum) {
  sl_int k;
  for (k = 0; k < f->set->n_regions; k++) {
    const sl_region *R = f->set->regions[k];
    const sli_saved_region record = sli_saved_region_of(R);
    if (id == SLI_SECTION_REGION_LIST) {
      sli_put_piece(to, sum, &record, sizeof record);
    } else if (id == SLI_SECTION_REGION_Z) {
      sli_put_piece(to, sum, R->Z, 8 * (uint64_t)sli_region_entries(R->extent.n_rows));
    } else {
      const int is_roots = id == SLI_SECTION_REGION_ROOTS;
      sli_put_piece(to, sum, is_roots ? R->extent.roots : R->extent.rows,
              4 * (uint64_t)(is_roots ? R->extent.n_roots : R->extent.n_rows));
    }
  }
}

static void sli_put_section(const sli_saved *f, uint32_t k, sli_sink *to, sli_checksum *sum) {
  const uint32_t id = f->table[k].id;
  if (id > SLI_SECTION_REGIONS && id < SLI_SECTION_SELECTED) {
    sli_put_regions(f, id, to, sum);
  } else {
    sli_put_filled(to, sum, f->data[k], f->used[k], sli_round_up(f->table[k].bytes));
  }
}

static sl_status sli_save_check(const sl_saved_set *set) {
  const sl_symbolic *S = set->symbolic;
  const sl_factor *F = set->factor;
  const sl_selected *Z = set->selected;
  sl_int k;
  if (S == NULL || set->n_regions < 0 ||
    (set->n_regions > 0 && (F == NULL || set->regions == NULL))) {
    return SL_ERR_ARGUMENT;
  }
  for (k = 0; k < set->n_regions; k++) {
    if (set->regions[k] == NULL) {
      return SL_ERR_ARGUMENT;
    }
  }
  if (S->is_partial || (F != NULL && (!F->is_valid || !sli_factor_is_over(F, S, S->identity))) ||
    (Z != NULL && (Z->traversal.S != S || !sli_hash_equals(Z->analysis, S->identity) ||
             (F != NULL && !sli_numbers_are_of(&Z->numbers, F))))) {
    return SL_ERR_STATE;
  }
  for (k = 0; k < set->n_regions; k++) {
    const sl_region *R = set->regions[k];
    if (R->S != S || !sli_hash_equals(R->analysis, S->identity) || !sli_region_fits(R, F)) {
      return SL_ERR_STATE;
    }
  }
  return SL_OK;
}

static sl_status sli_save_prepare(sli_saved *f, const sl_saved_set *set) {
  const sl_factor *F = set->factor;
  const sl_status status = sli_save_check(set);
  sl_factor none;
  int fits = 1;
  memset(f, 0, sizeof *f);
  memset(&none, 0, sizeof none);
  if (status != SL_OK) {
    return status;
  }
  memcpy(f->header.magic, sli_saved_magic, sizeof sli_saved_magic);
  f->header.order_mark = SLI_ORDER_MARK;
  f->header.read_version = SLI_READ_VERSION_DOUBLE;
  f->header.write_version = SLI_WRITE_VERSION_PLAIN;
  if (F != NULL && F->storage == SL_STORAGE_FLOAT) {
    f->header.read_version = SLI_READ_VERSION;
    f->header.write_version = SLI_WRITE_VERSION;
  }
  f->analysis = sli_saved_analysis_of(set->symbolic);
  if (F != NULL) {
    f->factor = sli_saved_factor_of(F);
  }
  sli_saved_add_base(f, set->symbolic, F != NULL ? F : &none, F != NULL);
  if (set->n_regions > 0) {
    f->header.write_version = SLI_WRITE_VERSION;
    memcpy(f->regions.identity, f->factor.identity, sizeof f->regions.identity);
    fits = sli_saved_add_regions(f, set);
  }
  if (set->selected != NULL) {
    f->header.write_version = SLI_WRITE_VERSION;
    f->selected.identity[0] = set->selected->numbers.identity.a;
    f->selected.identity[1] = set->selected->numbers.identity.b;
    sli_saved_add_selected(f, set->selected);
  }
  return fits && sli_saved_place(f) && f->header.bytes <= SIZE_MAX ? SL_OK : SL_ERR_TOO_LARGE;
}

static void sli_save_write(sli_saved *f, sli_sink *to) {
  unsigned char prefix[sizeof(sli_saved_header) + SLI_SECTIONS_MAX * sizeof(sli_section)];
  const size_t size = (size_t)sli_saved_prefix(f);
  uint32_t k;
  for (k = 0; k < f->header.sections; k++) {
    sli_checksum sum = sli_checksum_begin();
    sli_put_section(f, k, NULL, &sum);
    f->table[k].checksum = sli_checksum_end(&sum);
  }
  memset(prefix, 0, sizeof prefix);
  memcpy(prefix, &f->header, sizeof f->header);
  memcpy(prefix + sizeof f->header, f->table, f->header.sections * sizeof(sli_section));
  f->header.checksum = sli_prefix_checksum(prefix, size);
  memcpy(prefix, &f->header, sizeof f->header);
  sli_put(to, prefix, size);
  for (k = 0; k < f->header.sections; k++) {
    sli_put_section(f, k, to, NULL);
  }
}

SL_API sl_status sl_save_set_bytes(size_t *bytes, const sl_saved_set *set) {
  sli_saved f;
  sl_status status;
  if (bytes == NULL || set == NULL) {
    return SL_ERR_ARGUMENT;
  }
  status = sli_save_prepare(&f, set);
  if (status == SL_OK) {
    *bytes = (size_t)f.header.bytes;
  }
  return status;
}

SL_API sl_status sl_save_set_memory(void *memory, size_t bytes, const sl_saved_set *set) {
  sli_saved f;
  sli_sink to;
  sl_status status = set == NULL ? SL_ERR_ARGUMENT : sli_save_prepare(&f, set);
  if (status == SL_OK && (memory == NULL || bytes < f.header.bytes)) {
    status = SL_ERR_ARGUMENT;
  }
  if (status == SL_OK) {
    to.memory = (unsigned char *)memory;
    to.file = NULL;
    to.has_failed = 0;
    sli_save_write(&f, &to);
  }
  return status;
}

SL_API sl_status sl_save_set_file(const char *path, const sl_saved_set *set,
                  const sl_options *opt) {
  const int saved = errno;
  const sl_allocator a = sli_allocator(opt);
  sli_output output;
  sli_saved f;
  sli_sink to;
  sl_status status;
  if (path == NULL || set == NULL || !sli_options_are_valid(opt, SLI_READS_NOTHING)) {
    return SL_ERR_ARGUMENT;
  }
  status = sli_save_prepare(&f, set);
  status = status == SL_OK ? sli_output_open(&output, path, &a) : status;
  if (status == SL_OK) {
    int complete;
    to.memory = NULL;
    to.file = output.file;
    to.has_failed = 0;
    sli_save_write(&f, &to);
    complete = !to.has_failed && sli_flush(output.file);
    status = sli_output_close(&output, complete, &a) ? SL_OK : SL_ERR_IO;
  }
  errno = saved;
  return status;
}

static sl_saved_set sli_saved_pair(const sl_symbolic *S, const sl_factor *F) {
  sl_saved_set set;
  memset(&set, 0, sizeof set);
  set.symbolic = (sl_symbolic *)(uintptr_t)S;
  set.factor = (sl_factor *)(uintptr_t)F;
  return set;
}

SL_API sl_status sl_save_bytes(size_t *bytes, const sl_symbolic *S, const sl_factor *F) {
  const sl_saved_set set = sli_saved_pair(S, F);
  return sl_save_set_bytes(bytes, &set);
}

SL_API sl_status sl_save_memory(void *memory, size_t bytes, const sl_symbolic *S,
                const sl_factor *F) {
  const sl_saved_set set = sli_saved_pair(S, F);
  return sl_save_set_memory(memory, bytes, &set);
}

SL_API sl_status sl_save_file(const char *path, const sl_symbolic *S, const sl_factor *F,
                const sl_options *opt) {
  const sl_saved_set set = sli_saved_pair(S, F);
  return sl_save_set_file(path, &set, opt);
}

/* src/impl/save/load.h: reads the table, an analysis and a factor from saved bytes, as copies or in place */

typedef struct sli_reading {
  const unsigned char *memory;
  FILE *file;
  uint64_t size, at;
  int is_mapped;
  int swapped;
  sl_load_checks checks;
  const sl_options *opt;
  sl_allocator allocator;
  sli_saved saved;
  sl_symbolic S;
  sl_factor F;
  int has_factor;
  uint32_t first_region, first_selected;
} sli_reading;

static sl_status sli_get(sli_reading *r, void *to, uint64_t bytes) {
  if (bytes > r->size - r->at) {
    return SL_ERR_IO;
  }
  if (r->memory != NULL) {
    memcpy(to, r->memory + r->at, (size_t)bytes);
  } else if (fread(to, 1, (size_t)bytes, r->file) != (size_t)bytes) {
    return SL_ERR_IO;
  }
  r->at += bytes;
  return SL_OK;
}

static sl_status sli_read_table(sli_reading *r) {
  unsigned char prefix[sizeof(sli_saved_header) + SLI_SECTIONS_MAX * sizeof(sli_section)];
  sli_saved_header *h = &r->saved.header;
  sl_status status = sli_get(r, prefix, sizeof *h);
  size_t size;
  uint32_t k;
  if (status != SL_OK) {
    return status;
  }
  memcpy(h, prefix, sizeof *h);
  status = sli_decode_header(h, &r->swapped);
  if (status != SL_OK) {
    return status;
  }
  size = (size_t)sli_saved_prefix(&r->saved);
  status = h->bytes == r->size ? sli_get(r, prefix + sizeof *h, size - sizeof *h) : SL_ERR_IO;
  if (status != SL_OK || sli_prefix_checksum(prefix, size) != h->checksum) {
    return SL_ERR_IO;
  }
  memcpy(r->saved.table, prefix + sizeof *h, h->sections * sizeof(sli_section));
  for (k = 0; k < h->sections && r->swapped; k++) {
    sli_swap_words(&r->saved.table[k].id, 4, 8);
    sli_swap_words(&r->saved.table[k].offset, 8, 24);
  }
  return SL_OK;
}

static int sli_sections_are(const sli_saved *f, uint32_t k, uint32_t id, const uint32_t *words,
              uint32_t count) {
  uint32_t m;
  if (f->header.sections - k < count) {
    return 0;
  }
  for (m = 0; m < count; m++) {
    if (f->table[k + m].id != id + m || f->table[k + m].word != words[m]) {
      return 0;
    }
  }
  return 1;
}

static int sli_table_is_expected(const sli_saved *f, const sli_saved *expected,
                 uint32_t *first_region, uint32_t *first_selected) {
  uint32_t k, known = expected->header.sections;
  uint64_t at = sli_saved_prefix(f);
  *first_region = *first_selected = 0;
  if (f->header.sections < known) {
    return 0;
  }
  for (k = 0; k < f->header.sections; k++) {
    const sli_section *s = &f->table[k], *e = &expected->table[k];
    if (s->offset != at || s->bytes > f->header.bytes - at ||
      (k < known && (s->id != e->id || s->word != e->word || s->bytes != e->bytes))) {
      return 0;
    }
    at += sli_round_up(s->bytes);
    if (at > f->header.bytes) {
      return 0;
    }
  }
  if (f->header.write_version > SLI_WRITE_VERSION_PLAIN) {
    if (sli_sections_are(f, known, SLI_SECTION_REGIONS, sli_region_words,
               SLI_REGION_SECTIONS)) {
      *first_region = known;
      known += SLI_REGION_SECTIONS;
    }
    if (sli_sections_are(f, known, SLI_SECTION_SELECTED, sli_selected_words,
               SLI_SELECTED_SECTIONS)) {
      *first_selected = known;
      known += SLI_SELECTED_SECTIONS;
    }
  }
  return at == f->header.bytes &&
       (f->header.sections == known || f->header.write_version > SLI_WRITE_VERSION);
}

static int sli_section_accept(const sli_reading *r, sl_int k, void *data, int always) {
  const sli_section *section = &r->saved.table[k];
  if (always || r->checks == SL_LOAD_VERIFIED) {
    sli_checksum sum = sli_checksum_begin();
    sli_checksum_add(&sum, data, (size_t)sli_round_up(section->bytes));
    if (sli_checksum_end(&sum) != section->checksum) {
      return 0;
    }
  }
  if (r->swapped) {
    sli_swap_words(data, section->word, section->bytes);
  }
  return 1;
}

static sl_status sli_read_numbers(sli_reading *r, sl_int k, void *numbers, size_t bytes) {
  const sli_section *section = &r->saved.table[k];
  sl_status status = SL_ERR_IO;
  if (section->bytes == bytes && section->offset == r->at && section->word == 8) {
    status = sli_get(r, numbers, bytes);
  }
  return status == SL_OK && !sli_section_accept(r, k, numbers, 1) ? SL_ERR_IO : status;
}

static sl_status sli_read_front(sli_reading *r) {
  sli_saved expected, *f = &r->saved;
  sl_status status = sli_read_table(r);
  if (status == SL_OK && f->header.sections < 2) {
    return SL_ERR_IO;
  }
  status = status == SL_OK ? sli_read_numbers(r, 0, &f->analysis, sizeof f->analysis) : status;
  if (status != SL_OK || !sli_decode_analysis(&f->analysis, &r->S)) {
    return status != SL_OK ? status : SL_ERR_IO;
  }
  r->has_factor = f->table[1].bytes > 0;
  if (r->has_factor) {
    status = sli_read_numbers(r, 1, &f->factor, sizeof f->factor);
    if (status != SL_OK || !sli_decode_factor(&f->factor, &r->S, &r->F)) {
      return status != SL_OK ? status : SL_ERR_IO;
    }
  }
  if ((r->F.storage == SL_STORAGE_FLOAT) != (f->header.read_version > SLI_READ_VERSION_DOUBLE)) {
    return SL_ERR_IO;
  }
  memset(&expected, 0, sizeof expected);
  expected.analysis = f->analysis;
  expected.factor = f->factor;
  sli_saved_add_base(&expected, &r->S, &r->F, r->has_factor);
  if (!sli_saved_place(&expected) ||
    !sli_table_is_expected(f, &expected, &r->first_region, &r->first_selected)) {
    return SL_ERR_IO;
  }
  f->first_array = expected.first_array;
  f->first_number = expected.first_number;
  return SL_OK;
}

typedef struct sli_image {
  sl_int first, last;
  size_t head, bytes;
  unsigned char *block;
  unsigned char *arrays;
} sli_image;

static sl_status sli_read_image(sli_reading *r, sli_image *m) {
  sl_status status = SL_OK;
  sl_int k;
  m->head = (size_t)sli_round_up(m->head);
  m->block = (unsigned char *)sli_alloc(&r->allocator, m->head + (r->is_mapped ? 0 : m->bytes));
  if (m->block == NULL) {
    return SL_ERR_MEMORY;
  }
  m->arrays = m->block + m->head;
  if (r->is_mapped) {
    m->arrays = (unsigned char *)(uintptr_t)(r->memory + r->at);
    r->at += m->bytes;
  } else {
    status = sli_get(r, m->arrays, m->bytes);
  }
  for (k = m->first; k < m->last && status == SL_OK; k++) {
    unsigned char *data =
      m->arrays + (r->saved.table[k].offset - r->saved.table[m->first].offset);
    status = sli_section_accept(r, k, data, 0) ? SL_OK : SL_ERR_IO;
  }
  if (status != SL_OK) {
    sli_free(&r->allocator, m->block);
  }
  return status;
}

static sl_status sli_read_analysis(sli_reading *r, sl_symbolic **out) {
  const sli_saved_analysis *a = &r->saved.analysis;
  sl_symbolic *S = &r->S;
  sli_block b = {NULL, 0, 0};
  sli_image m;
  sl_status status;
  sli_symbolic_layout(S, &b, a->rows, a->entries);
  m.first = r->saved.first_array;
  m.last = r->saved.first_number;
  m.head = sizeof *S;
  m.bytes = b.used;
  if (b.overflow || b.used > SIZE_MAX - 2 * sizeof *S) {
    return SL_ERR_TOO_LARGE;
  }
  status = sli_read_image(r, &m);
  if (status != SL_OK) {
    return status;
  }
  b.base = m.arrays;
  b.used = 0;
  sli_symbolic_layout(S, &b, a->rows, a->entries);
  S->allocator = r->allocator;
  S->stats.symbolic.bytes = m.head + m.bytes;
  S->is_partial = r->saved.header.write_version > SLI_WRITE_VERSION;
  if (S->rows_begin[S->n_supers] != a->rows || S->panel_begin[S->n_supers] != a->panels ||
    S->scatter_begin[S->n_supers] != a->entries ||
    (r->checks != SL_LOAD_TRUSTED && !sli_check_analysis(S, a))) {
    sli_free(&r->allocator, m.block);
    return SL_ERR_IO;
  }
  *out = (sl_symbolic *)(void *)m.block;
  **out = *S;
  return SL_OK;
}

static sl_status sli_read_factor(sli_reading *r, const sl_symbolic *S, sl_factor **out) {
  const sli_saved_factor *g = &r->saved.factor;
  sl_factor *F = &r->F;
  sli_block b = {NULL, 0, 0};
  sli_image m;
  sl_status status;
  F->S = S;
  F->allocator = r->allocator;
  F->is_immutable = r->is_mapped || S->is_partial;
  status = sli_factor_use(F, r->opt);
  sli_factor_layout(F, &b, (int)g->has_mass);
  m.first = r->saved.first_number;
  m.last = m.first + SLI_FACTOR_SECTIONS + (F->storage == SL_STORAGE_FLOAT);
  m.head = sizeof *F;
  m.bytes = b.used;
  if (status == SL_OK && (b.overflow || b.used > SIZE_MAX - 2 * sizeof *F)) {
    status = SL_ERR_TOO_LARGE;
  }
  status = status == SL_OK ? sli_read_image(r, &m) : status;
  if (status != SL_OK) {
    return status;
  }
  b.base = m.arrays;
  b.used = 0;
  sli_factor_layout(F, &b, (int)g->has_mass);
  F->rule.signs = g->has_signs ? F->rule.signs : NULL;
  F->stats.factor.bytes = m.head + m.bytes;
  if (r->checks != SL_LOAD_TRUSTED && !sli_check_factor(F)) {
    sli_free(&r->allocator, m.block);
    return SL_ERR_IO;
  }
  *out = (sl_factor *)(void *)m.block;
  **out = *F;
  return SL_OK;
}

/* src/impl/save/load_inverse.h: reads and checks a saved selected inverse and saved regions */

static sl_status sli_read_section(sli_reading *r, uint32_t k, void **data) {
  const uint64_t bytes = sli_round_up(r->saved.table[k].bytes);
  sl_status status = SL_OK;
  SLI_ASSERT(r->at == r->saved.table[k].offset);
  if (r->is_mapped) {
    *data = (void *)(uintptr_t)(r->memory + r->at);
    r->at += bytes;
  } else if (bytes > 0) {
    status = sli_get(r, *data, bytes);
  }
  return status == SL_OK && !sli_section_accept(r, (sl_int)k, *data, 0) ? SL_ERR_IO : status;
}

static sl_status sli_read_part(sli_reading *r, uint32_t k, const sl_symbolic *S, const sl_factor *F,
                 int64_t most, sli_saved_part *part) {
  const sl_status status = sli_read_numbers(r, (sl_int)k, part, sizeof *part);
  if (status != SL_OK) {
    return status;
  }
  return S->n_pairs == 0 && sli_count_is_valid(part->count, most) &&
           (F == NULL ||
          (part->identity[0] == F->identity.a && part->identity[1] == F->identity.b))
         ? SL_OK
         : SL_ERR_IO;
}

static int sli_check_selected(const sl_symbolic *S, const sl_int *supers, const sl_off *begin,
                sl_int count) {
  sl_int k;
  if (!sli_check_columns(supers, count, S->n_supers) || begin[0] != 0) {
    return 0;
  }
  for (k = 0; k < count; k++) {
    const sl_int s = supers[k], up = S->super_parent[s];
    const sl_int at = up == -1 ? k : sli_lower_bound(supers, count, up);
    if (at == count || (up != -1 && supers[at] != up) ||
      begin[k + 1] - begin[k] != S->panel_begin[s + 1] - S->panel_begin[s]) {
      return 0;
    }
  }
  return 1;
}

static sl_status sli_selected_of_list(sl_selected **out, sl_selected *draft, const sl_int *supers,
                    uint64_t *seeds) {
  const sl_symbolic *S = draft->traversal.S;
  const sl_int count = draft->traversal.forest.count;
  sl_status status;
  sl_int k;
  for (k = 0; k < count; k++) {
    seeds[k] = sli_keyed(S->super_first[supers[k]], 0);
  }
  status = sli_selected_plan(out, draft, count < S->n_supers ? seeds : NULL, count);
  if (status == SL_OK) {
    status = sli_selected_alloc_values(*out);
  }
  return status;
}

static sl_status sli_selected_of_memory(sl_selected **out, sl_selected *draft, sl_int *supers,
                    sl_off *begin) {
  draft->traversal.supers = supers;
  draft->begin = begin;
  draft->is_mapped = 1;
  draft->bytes = sizeof *draft + sizeof(double) * (size_t)begin[draft->traversal.forest.count];
  *out = (sl_selected *)sli_alloc(&draft->allocator, sizeof *draft);
  if (*out == NULL) {
    return SL_ERR_MEMORY;
  }
  **out = *draft;
  return SL_OK;
}

static sl_status sli_read_selected_arrays(sli_reading *r, sl_selected **out, sl_selected *draft,
                      sli_block *lists) {
  const uint32_t k = r->first_selected;
  const sl_int count = draft->traversal.forest.count;
  const uint64_t bytes = r->saved.table[k + 3].bytes;
  void *supers = lists == NULL ? NULL : SLI_TAKE(lists, sl_int, count);
  void *begin = lists == NULL ? NULL : SLI_TAKE(lists, sl_off, (uint64_t)count + 1);
  uint64_t *seeds = lists == NULL ? NULL : SLI_TAKE(lists, uint64_t, count);
  const sl_off *ends;
  void *values = NULL;
  sl_status status = sli_read_section(r, k + 1, &supers);
  status = status == SL_OK ? sli_read_section(r, k + 2, &begin) : status;
  if (status != SL_OK) {
    return status;
  }
  ends = (const sl_off *)begin;
  if (bytes % sizeof(double) != 0 || (uint64_t)ends[count] != bytes / sizeof(double) ||
    ((r->checks != SL_LOAD_TRUSTED || !r->is_mapped) &&
     !sli_check_selected(draft->traversal.S, (const sl_int *)supers, ends, count))) {
    return SL_ERR_IO;
  }
  status = r->is_mapped ? sli_selected_of_memory(out, draft, (sl_int *)supers, (sl_off *)begin)
              : sli_selected_of_list(out, draft, (const sl_int *)supers, seeds);
  if (status == SL_OK) {
    values = (*out)->Z;
    status = sli_read_section(r, k + 3, &values);
    (*out)->Z = (double *)values;
  }
  return status;
}

static sl_status sli_read_selected(sli_reading *r, const sl_symbolic *S, const sl_factor *F,
                   sl_selected **out) {
  const sli_section *table = &r->saved.table[r->first_selected];
  sli_block lists = {NULL, 0, 0};
  sli_saved_part part;
  sl_selected draft;
  sl_status status = sli_read_part(r, r->first_selected, S, F, S->n_supers, &part);
  int pass;
  if (status != SL_OK || table[1].bytes != 4 * (uint64_t)part.count ||
    table[2].bytes != 8 * ((uint64_t)part.count + 1)) {
    return status != SL_OK ? status : SL_ERR_IO;
  }
  memset(&draft, 0, sizeof draft);
  draft.allocator = r->allocator;
  draft.analysis = S->identity;
  draft.is_immutable = r->is_mapped || S->is_partial;
  if (r->opt != NULL) {
    draft.threads = r->opt->threads;
  }
  if (F != NULL) {
    draft.numbers = sli_numbers_of(F);
  } else {
    draft.numbers.identity.a = part.identity[0];
    draft.numbers.identity.b = part.identity[1];
  }
  draft.traversal = sli_traversal_of(S, (sl_int)part.count, sli_workers(&draft.threads));
  if (r->is_mapped) {
    return sli_read_selected_arrays(r, out, &draft, NULL);
  }
  for (pass = 0; pass < 2 && status == SL_OK; pass++) {
    if (pass == 0) {
      (void)SLI_TAKE(&lists, sl_int, part.count);
      (void)SLI_TAKE(&lists, sl_off, (uint64_t)part.count + 1);
      (void)SLI_TAKE(&lists, uint64_t, part.count);
      status = sli_block_alloc(&lists, &r->allocator);
    } else {
      status = sli_read_selected_arrays(r, out, &draft, &lists);
    }
  }
  sli_free(&r->allocator, lists.base);
  return status;
}

typedef struct sli_saved_regions {
  sl_int count;
  void *list, *roots, *rows;
} sli_saved_regions;

static int sli_check_records(const sli_reading *r, const sl_symbolic *S,
               const sli_saved_regions *q) {
  const sli_section *table = &r->saved.table[r->first_region];
  const sli_saved_region *record = (const sli_saved_region *)q->list;
  uint64_t left[SLI_REGION_SECTIONS - 1], bytes[SLI_REGION_SECTIONS - 1];
  sl_int k;
  int m;
  for (m = 0; m < SLI_REGION_SECTIONS - 1; m++) {
    left[m] = table[m + 1].bytes;
  }
  for (k = 0; k < q->count; k++, record++) {
    if (!sli_count_is_valid(record->roots, S->n_supers) ||
      !sli_count_is_valid(record->rows, S->n) || !sli_count_is_valid(record->is_copied, 1) ||
      4 * (uint64_t)record->rows > left[2]) {
      return 0;
    }
    sli_saved_region_bytes(record, bytes);
    for (m = 0; m < SLI_REGION_SECTIONS - 1; m++) {
      if (bytes[m] > left[m]) {
        return 0;
      }
      left[m] -= bytes[m];
    }
  }
  return left[0] == 0 && left[1] == 0 && left[2] == 0 && left[3] == 0;
}

static int sli_check_extent(const sl_symbolic *S, const sli_region_extent *extent) {
  sl_int k, i;
  for (k = 0; k < extent->n_rows; k++) {
    if (sli_extent_find(S, extent, S->super_of[extent->rows[k]]) != -1) {
      return 0;
    }
  }
  for (k = 0; k < extent->n_roots; k++) {
    const sl_int s = extent->roots[k], *below = S->rows + S->rows_begin[s];
    if (k > 0 && S->first_descendant[s] <= extent->roots[k - 1]) {
      return 0;
    }
    for (i = 0; i < S->steps[s].below; i++) {
      if (sli_extent_boundary(extent, below[i]) == -1) {
        return 0;
      }
    }
  }
  return 1;
}

static sl_status sli_region_of_lists(const sli_reading *r, const sl_factor *F,
                   const sli_saved_region *record, const sl_int *roots,
                   const sl_int *rows, sl_region **out) {
  sli_block b = {NULL, 0, 0};
  sl_status status = SL_OK;
  sl_region draft;
  int pass;
  memset(&draft, 0, sizeof draft);
  draft.allocator = r->allocator;
  draft.S = F->S;
  draft.numbers = sli_numbers_of(F);
  draft.extent.n_roots = (sl_int)record->roots;
  draft.extent.n_rows = (sl_int)record->rows;
  draft.extent.roots = roots;
  draft.extent.rows = rows;
  draft.is_copied = (int)record->is_copied;
  draft.is_mapped = r->is_mapped;
  draft.is_immutable = r->is_mapped || F->S->is_partial;
  if (!sli_check_columns(roots, draft.extent.n_roots, F->S->n_supers) ||
    !sli_check_columns(rows, draft.extent.n_rows, F->S->n) ||
    (r->checks != SL_LOAD_TRUSTED && !sli_check_extent(F->S, &draft.extent))) {
    return SL_ERR_IO;
  }
  for (pass = 0; pass < 2 && status == SL_OK; pass++) {
    sli_region_layout(&draft, &b);
    status = pass == 0 ? sli_block_alloc(&b, &r->allocator) : SL_OK;
  }
  if (status == SL_OK) {
    memcpy(draft.roots, roots, (size_t)draft.extent.n_roots * sizeof *roots);
    memcpy(draft.rows, rows, (size_t)draft.extent.n_rows * sizeof *rows);
    sli_region_index(&draft);
    *out = (sl_region *)(void *)b.base;
    **out = draft;
  }
  return status;
}

static sl_status sli_read_regions_numbers(sli_reading *r, const sl_saved_set *set) {
  const uint32_t k = r->first_region + SLI_REGION_SECTIONS - 1;
  const sli_section *section = &r->saved.table[k];
  const int verifies = r->checks == SL_LOAD_VERIFIED;
  sli_checksum sum = sli_checksum_begin();
  sl_int m;
  for (m = 0; m < set->n_regions; m++) {
    sl_region *R = set->regions[m];
    const size_t bytes = sizeof(double) * (size_t)R->begin[sli_region_chunks(R->extent.n_rows)];
    if (r->is_mapped) {
      R->Z = (double *)(uintptr_t)(r->memory + r->at);
      R->bytes += bytes;
      r->at += bytes;
    } else if (bytes > 0) {
      const sl_status status = sli_get(r, R->Z, bytes);
      if (status != SL_OK) {
        return status;
      }
    }
    if (verifies) {
      sli_checksum_add(&sum, R->Z, bytes);
    }
    if (r->swapped) {
      sli_swap_words(R->Z, section->word, bytes);
    }
  }
  return verifies && sli_checksum_end(&sum) != section->checksum ? SL_ERR_IO : SL_OK;
}

static sl_status sli_read_regions_lists(sli_reading *r, const sl_factor *F, sli_saved_regions *q,
                    sl_saved_set *set) {
  const uint32_t first = r->first_region;
  const sli_saved_region *record;
  const sl_int *roots, *rows;
  sl_status status = sli_read_section(r, first + 1, &q->list);
  sl_int k;
  status = status == SL_OK ? sli_read_section(r, first + 2, &q->roots) : status;
  status = status == SL_OK ? sli_read_section(r, first + 3, &q->rows) : status;
  if (status != SL_OK || !sli_check_records(r, F->S, q)) {
    return status != SL_OK ? status : SL_ERR_IO;
  }
  set->regions = (sl_region **)sli_alloc(&r->allocator, (size_t)q->count * sizeof *set->regions);
  if (set->regions == NULL) {
    return SL_ERR_MEMORY;
  }
  set->allocator = r->allocator;
  record = (const sli_saved_region *)q->list;
  roots = (const sl_int *)q->roots;
  rows = (const sl_int *)q->rows;
  for (k = 0; k < q->count && status == SL_OK; k++, record++) {
    uint64_t bytes[SLI_REGION_SECTIONS - 1];
    sli_saved_region_bytes(record, bytes);
    status = sli_region_of_lists(r, F, record, roots, rows, &set->regions[k]);
    set->n_regions += status == SL_OK;
    roots += bytes[1] / sizeof *roots;
    rows += bytes[2] / sizeof *rows;
  }
  return status;
}

static sl_status sli_read_regions(sli_reading *r, const sl_factor *F, sl_saved_set *set) {
  const sli_section *table = &r->saved.table[r->first_region];
  sli_block lists = {NULL, 0, 0};
  sli_saved_regions q;
  sli_saved_part part;
  sl_status status;
  int pass;
  memset(&q, 0, sizeof q);
  if (F == NULL || F->is_centered) {
    return SL_ERR_IO;
  }
  status = sli_read_part(r, r->first_region, F->S, F, INT32_MAX, &part);
  if (status != SL_OK || part.count == 0 ||
    table[1].bytes != sizeof(sli_saved_region) * (uint64_t)part.count) {
    return status != SL_OK ? status : SL_ERR_IO;
  }
  q.count = (sl_int)part.count;
  for (pass = 0; pass < 2 && status == SL_OK && !r->is_mapped; pass++) {
    q.list = SLI_TAKE(&lists, unsigned char, table[1].bytes);
    q.roots = SLI_TAKE(&lists, unsigned char, table[2].bytes);
    q.rows = SLI_TAKE(&lists, unsigned char, table[3].bytes);
    status = pass == 0 ? sli_block_alloc(&lists, &r->allocator) : SL_OK;
  }
  if (status == SL_OK) {
    status = sli_read_regions_lists(r, F, &q, set);
  }
  if (status == SL_OK) {
    status = sli_read_regions_numbers(r, set);
  }
  sli_free(&r->allocator, lists.base);
  return status;
}

/* src/impl/save/load_calls.h: loads and maps from memory and files, a factor or a set; sl_saved_set_free */

typedef enum sli_wanted { SLI_WANTS_ANALYSIS, SLI_WANTS_FACTOR, SLI_WANTS_ALL } sli_wanted;

SL_API void sl_saved_set_free(sl_saved_set *set) {
  sl_int k;
  if (set == NULL) {
    return;
  }
  for (k = 0; k < set->n_regions && set->regions != NULL; k++) {
    sl_region_free(set->regions[k]);
  }
  if (set->regions != NULL) {
    sli_free(&set->allocator, set->regions);
  }
  sl_selected_free(set->selected);
  sl_factor_free(set->factor);
  sl_symbolic_free(set->symbolic);
  memset(set, 0, sizeof *set);
}

static sl_status sli_read(sli_reading *r, sl_saved_set *set, sli_wanted wanted) {
  sl_status status = sli_read_front(r);
  if (status == SL_OK && r->is_mapped && r->swapped) {
    return SL_ERR_UNSUPPORTED;
  }
  status = status == SL_OK ? sli_read_analysis(r, &set->symbolic) : status;
  if (status == SL_OK && wanted >= SLI_WANTS_FACTOR && r->has_factor) {
    status = sli_read_factor(r, set->symbolic, &set->factor);
  }
  if (status == SL_OK && wanted == SLI_WANTS_ALL && r->first_region > 0) {
    status = sli_read_regions(r, set->factor, set);
  }
  if (status == SL_OK && wanted == SLI_WANTS_ALL && r->first_selected > 0) {
    status = sli_read_selected(r, set->symbolic, set->factor, &set->selected);
  }
  if (status != SL_OK) {
    sl_saved_set_free(set);
  }
  return status;
}

typedef struct sli_origin {
  const void *memory;
  size_t bytes;
  const char *path;
  int is_mapped;
} sli_origin;

static sl_status sli_read_path(sli_reading *r, const char *path, sl_saved_set *set,
                 sli_wanted wanted) {
  sl_status status = SL_ERR_IO;
  r->file = fopen(path, "rb");
  if (r->file != NULL) {
    r->size = sli_file_size(r->file);
    status = sli_read(r, set, wanted);
    fclose(r->file);
  }
  return status;
}

static sl_status sli_read_memory(sli_reading *r, const void *memory, size_t bytes,
                 sl_saved_set *set, sli_wanted wanted) {
  r->memory = (const unsigned char *)memory;
  r->size = bytes;
  return sli_read(r, set, wanted);
}

static sl_status sli_map_path(sli_reading *r, const char *path, sl_saved_set *set,
                sli_wanted wanted) {
  sli_mapping map;
  sl_status status = sli_map(path, &map);
  if (status == SL_OK) {
    status = sli_read_memory(r, map.bytes, map.size, set, wanted);
    if (status == SL_OK) {
      set->symbolic->mapping = map;
    } else {
      sli_unmap(&map);
    }
  }
  return status;
}

static sl_status sli_read_from(const sli_origin *from, sl_saved_set *set, sli_wanted wanted,
                 sl_load_checks checks, const sl_options *opt) {
  const int saved = errno;
  const int is_file = from->path != NULL;
  sli_reading r;
  sl_status status;
  if ((unsigned)checks > (unsigned)SL_LOAD_VERIFIED ||
    !sli_options_are_valid(opt, SLI_READS_ISA) || (!is_file && from->memory == NULL) ||
    (!is_file && from->is_mapped && (uintptr_t)from->memory % SLI_ALIGN != 0)) {
    return SL_ERR_ARGUMENT;
  }
  memset(&r, 0, sizeof r);
  r.checks = checks;
  r.opt = opt;
  r.allocator = sli_allocator(opt);
  r.is_mapped = from->is_mapped;
  if (!is_file) {
    status = sli_read_memory(&r, from->memory, from->bytes, set, wanted);
  } else if (from->is_mapped) {
    status = sli_map_path(&r, from->path, set, wanted);
  } else {
    status = sli_read_path(&r, from->path, set, wanted);
  }
  errno = saved;
  return status;
}

static sli_origin sli_origin_in_memory(const void *memory, size_t bytes, int is_mapped) {
  sli_origin from;
  from.memory = memory;
  from.bytes = bytes;
  from.path = NULL;
  from.is_mapped = is_mapped;
  return from;
}

static sli_origin sli_origin_in_file(const char *path, int is_mapped) {
  sli_origin from = sli_origin_in_memory(NULL, 0, is_mapped);
  from.path = path;
  return from;
}

static sl_status sli_read_pair(const sli_origin *from, sl_symbolic **S, sl_factor **F,
                 sl_load_checks checks, const sl_options *opt) {
  const sli_wanted wanted = F != NULL ? SLI_WANTS_FACTOR : SLI_WANTS_ANALYSIS;
  sl_saved_set set;
  sl_status status = SL_ERR_ARGUMENT;
  memset(&set, 0, sizeof set);
  if (S != NULL) {
    status = sli_read_from(from, &set, wanted, checks, opt);
    *S = set.symbolic;
  }
  if (F != NULL) {
    *F = set.factor;
  }
  return status;
}

SL_API sl_status sl_load_memory(sl_symbolic **S, sl_factor **F, const void *memory, size_t bytes,
                sl_load_checks checks, const sl_options *opt) {
  const sli_origin from = sli_origin_in_memory(memory, bytes, 0);
  return sli_read_pair(&from, S, F, checks, opt);
}

SL_API sl_status sl_map_memory(sl_symbolic **S, sl_factor **F, const void *memory, size_t bytes,
                 sl_load_checks checks, const sl_options *opt) {
  const sli_origin from = sli_origin_in_memory(memory, bytes, 1);
  return sli_read_pair(&from, S, F, checks, opt);
}

SL_API sl_status sl_load_file(sl_symbolic **S, sl_factor **F, const char *path,
                sl_load_checks checks, const sl_options *opt) {
  const sli_origin from = sli_origin_in_file(path, 0);
  return sli_read_pair(&from, S, F, checks, opt);
}

SL_API sl_status sl_map_file(sl_symbolic **S, sl_factor **F, const char *path,
               sl_load_checks checks, const sl_options *opt) {
  const sli_origin from = sli_origin_in_file(path, 1);
  return sli_read_pair(&from, S, F, checks, opt);
}

static sl_status sli_read_set(const sli_origin *from, sl_saved_set *set, sl_load_checks checks,
                const sl_options *opt) {
  if (set == NULL) {
    return SL_ERR_ARGUMENT;
  }
  memset(set, 0, sizeof *set);
  return sli_read_from(from, set, SLI_WANTS_ALL, checks, opt);
}

SL_API sl_status sl_load_set_memory(sl_saved_set *set, const void *memory, size_t bytes,
                  sl_load_checks checks, const sl_options *opt) {
  const sli_origin from = sli_origin_in_memory(memory, bytes, 0);
  return sli_read_set(&from, set, checks, opt);
}

SL_API sl_status sl_map_set_memory(sl_saved_set *set, const void *memory, size_t bytes,
                   sl_load_checks checks, const sl_options *opt) {
  const sli_origin from = sli_origin_in_memory(memory, bytes, 1);
  return sli_read_set(&from, set, checks, opt);
}

SL_API sl_status sl_load_set_file(sl_saved_set *set, const char *path, sl_load_checks checks,
                  const sl_options *opt) {
  const sli_origin from = sli_origin_in_file(path, 0);
  return sli_read_set(&from, set, checks, opt);
}

SL_API sl_status sl_map_set_file(sl_saved_set *set, const char *path, sl_load_checks checks,
                 const sl_options *opt) {
  const sli_origin from = sli_origin_in_file(path, 1);
  return sli_read_set(&from, set, checks, opt);
}

/* batch: many solves, factors and diagonals by one call */
/* src/impl/batch/batch_solve.h: many independent solves, shared among workers by the entries of L they read */

typedef struct sli_solve_batch {
  const sl_factor *F;
  const sl_request *requests;
  sl_int count, workers;
  sli_layout layout;
  sl_off blocks;
  double total;
  sl_work *const *works;
  unsigned char *memory;
  size_t bytes;
  int checks;
  int only_checks;
} sli_solve_batch;

SLI_INLINE const sl_factor *sli_request_factor(const sli_solve_batch *b, const sl_request *r) {
  return r->factor != NULL ? r->factor : b->F;
}

static sli_query sli_request_query(const sl_factor *F, const sl_request *r) {
  return r->plan == NULL ? sli_query_all(F->S) : r->plan->query;
}

SLI_INLINE double sli_query_weight(const sli_query *q) {
  return 1.0 + (double)q->forward.entries + (double)q->backward.entries +
       (double)q->boundary.entries;
}

static sl_int sli_blocks_before(double point, double before, double weight, sl_int nrhs) {
  const double blocks = ceil((point - before) / weight);
  return blocks <= 0.0 ? 0 : blocks * 8.0 >= nrhs ? nrhs : (sl_int)blocks * 8;
}

static void *sli_solve_batch_memory(const sli_solve_batch *b, sl_int k) {
  return b->works != NULL ? b->works[k]->block : b->memory + (size_t)k * b->bytes;
}

static sl_status sli_solve_batch_columns(const sli_solve_batch *b, const sl_request *r,
                     const sli_query *q, sl_int first, sl_int last,
                     void *memory) {
  const sl_factor *F = sli_request_factor(b, r);
  const sli_dense x_at = sli_dense_of(b->layout, r->ldx), b_at = sli_dense_of(b->layout, r->ldb);
  const double *B = q->nb > 0 ? r->B + (size_t)first * b_at.column : r->B;
  if (b->only_checks) {
    return F->checks ? sli_sweep_check(F, q, B, b_at, last - first, memory) : SL_OK;
  }
  return sli_sweep_blocks(F, q, r->X + (size_t)first * x_at.column, x_at, B, b_at, last - first,
              memory);
}

static void sli_solve_batch_worker(void *data, sl_int k) {
  const sli_solve_batch *b = (const sli_solve_batch *)data;
  const double from = b->total * k / b->workers, to = b->total * (k + 1) / b->workers;
  void *memory = sli_solve_batch_memory(b, k);
  double before = 0.0;
  sl_int m, failed = -1;
  for (m = 0; m < b->count && before < to && failed == -1; m++) {
    const sl_request *r = &b->requests[m];
    const sl_factor *F = sli_request_factor(b, r);
    const sli_query q = sli_request_query(F, r);
    const double weight = sli_query_weight(&q);
    const sl_int first = sli_blocks_before(from, before, weight, r->nrhs);
    const sl_int last =
      k + 1 == b->workers ? r->nrhs : sli_blocks_before(to, before, weight, r->nrhs);
    if (first < last && q.nx > 0 &&
      sli_solve_batch_columns(b, r, &q, first, last, memory) != SL_OK) {
      failed = m;
    }
    before += weight * (sli_tiles(r->nrhs));
  }
  if (b->only_checks) {
    memcpy(memory, &failed, sizeof failed);
  }
}

static sl_status sli_solve_batch_consistent(sli_solve_batch *b, const sl_threads *threads,
                      sl_int *at) {
  sl_int k, failed;
  b->only_checks = 1;
  sli_parallel(threads, b->workers, sli_solve_batch_worker, b);
  b->only_checks = 0;
  for (k = 0; k < b->workers && *at == -1; k++) {
    memcpy(&failed, sli_solve_batch_memory(b, k), sizeof failed);
    *at = failed;
  }
  return *at == -1 ? SL_OK : SL_ERR_INCONSISTENT;
}

static sl_status sli_solve_batch_check(sli_solve_batch *b, sl_int *at) {
  for (*at = 0; *at < b->count; ++*at) {
    const sl_request *r = &b->requests[*at];
    const sl_factor *F = sli_request_factor(b, r);
    sli_query q;
    size_t bytes;
    sl_status status;
    if (F == NULL) {
      return SL_ERR_ARGUMENT;
    }
    q = sli_request_query(F, r);
    status = sli_check_dense(r->X, r->ldx, q.nx, r->B, r->ldb, q.nb, b->layout, r->nrhs);
    if (status != SL_OK) {
      return status;
    }
    if (!sli_query_fits(&q, F)) {
      return SL_ERR_STATE;
    }
    bytes = r->nrhs > 0 ? sli_vectors_bytes(&q, r->nrhs) : 0;
    b->bytes = bytes > b->bytes ? bytes : b->bytes;
    b->checks |= F->checks;
    b->blocks += sli_tiles(r->nrhs);
    b->total += sli_query_weight(&q) * (sli_tiles(r->nrhs));
  }
  *at = -1;
  b->bytes = b->bytes < SLI_ALIGN ? SLI_ALIGN : b->bytes;
  return SL_OK;
}

static sl_status sli_check_works(sl_work *const *works, sl_int workers) {
  sl_int k, other;
  for (k = 0; k < workers; k++) {
    if (works[k] == NULL) {
      return SL_ERR_ARGUMENT;
    }
    for (other = 0; other < k; other++) {
      if (works[k] == works[other]) {
        return SL_ERR_ARGUMENT;
      }
    }
  }
  return SL_OK;
}

static sl_status sli_solve_batch_reserve(sli_solve_batch *b, sl_work *const *works,
                     const sl_allocator *a) {
  sli_block block = {NULL, 0, 0};
  sl_status status = works == NULL ? SL_OK : sli_check_works(works, b->workers);
  sl_int k;
  int pass;
  for (k = 0; works != NULL && k < b->workers && status == SL_OK; k++) {
    status = sli_work_grow(works[k], b->bytes);
  }
  b->works = works;
  for (pass = 0; works == NULL && pass < 2 && status == SL_OK; pass++) {
    for (k = 0; k < b->workers; k++) {
      unsigned char *memory = (unsigned char *)sli_take(&block, b->bytes, 1);
      b->memory = k == 0 ? memory : b->memory;
    }
    status = pass == 0 ? sli_block_alloc(&block, a) : SL_OK;
  }
  return status;
}

static sl_status sli_solve_batch_run(const sl_factor *F, const sl_request *requests, sl_int count,
                   sli_layout layout, const sl_options *opt,
                   sl_work *const *works, sl_int *failed) {
  const sl_threads serial = {0, NULL, NULL};
  const sl_threads *threads = opt == NULL ? &serial : &opt->threads;
  sli_solve_batch b;
  sl_status status;
  sl_int at = -1;
  memset(&b, 0, sizeof b);
  if (failed != NULL) {
    *failed = -1;
  }
  if (count < 0 || (count > 0 && requests == NULL) ||
    !sli_options_are_valid(opt, SLI_READS_NOTHING)) {
    return SL_ERR_ARGUMENT;
  }
  if (F != NULL && !F->is_valid) {
    return SL_ERR_STATE;
  }
  b.F = F;
  b.requests = requests;
  b.count = count;
  b.layout = layout;
  status = sli_solve_batch_check(&b, &at);
  b.workers = sli_workers(threads);
  b.workers = b.blocks < b.workers ? (sl_int)b.blocks : b.workers;
  if (status == SL_OK && b.blocks > 0) {
    const sl_allocator *a = &sli_request_factor(&b, requests)->allocator;
    status = sli_solve_batch_reserve(&b, works, a);
    if (status == SL_OK && b.checks) {
      status = sli_solve_batch_consistent(&b, threads, &at);
    }
    if (status == SL_OK) {
      sli_parallel(threads, b.workers, sli_solve_batch_worker, &b);
    }
    if (works == NULL) {
      sli_free(a, b.memory);
    }
  }
  if (failed != NULL) {
    *failed = at;
  }
  return status;
}

SL_API sl_status sl_batch_solve(const sl_factor *F, const sl_request *requests, sl_int count,
                const sl_options *opt, sl_work *const *works, sl_int *failed) {
  return sli_solve_batch_run(F, requests, count, SLI_COLUMN_MAJOR, opt, works, failed);
}

SL_API sl_status sl_batch_solve_interleaved(const sl_factor *F, const sl_request *requests,
                      sl_int count, const sl_options *opt,
                      sl_work *const *works, sl_int *failed) {
  return sli_solve_batch_run(F, requests, count, SLI_INTERLEAVED, opt, works, failed);
}

/* src/impl/batch/batch_factor.h: factors several matrices of one analysis; a worker takes whole factors */

typedef struct sli_factor_batch {
  sl_factor *const *factors;
  sl_int count, workers;
  sli_source source;
} sli_factor_batch;

SLI_INLINE int sli_factor_batch_is_serial(const sli_factor_batch *f, sl_int k) {
  return f->factors[k] != NULL && f->factors[k]->schedule.workers == 1;
}

static void sli_factor_batch_compute(const sli_factor_batch *f, sl_int k) {
  sli_source source = f->source;
  if (source.terms > 0) {
    source.coefficients += (size_t)k * (size_t)source.terms;
  }
  sli_factor_begin(f->factors[k]);
  (void)sli_factor_numbers(f->factors[k], &source, sli_seconds(), NULL);
}

static void sli_factor_batch_worker(void *data, sl_int w) {
  const sli_factor_batch *f = (const sli_factor_batch *)data;
  sl_int k, turn = 0;
  for (k = 0; k < f->count; k++) {
    if (sli_factor_batch_is_serial(f, k) && turn++ % f->workers == w) {
      sli_factor_batch_compute(f, k);
    }
  }
}

static sl_int sli_factor_batch_run(sli_factor_batch *f, const sl_threads *threads) {
  sl_int k, n_serial = 0;
  for (k = 0; k < f->count; k++) {
    n_serial += sli_factor_batch_is_serial(f, k);
  }
  f->workers = sli_max(sli_min(sli_workers(threads), n_serial), 1);
  sli_parallel(threads, f->workers, sli_factor_batch_worker, f);
  for (k = 0; k < f->count; k++) {
    if (f->factors[k] != NULL && !sli_factor_batch_is_serial(f, k)) {
      sli_factor_batch_compute(f, k);
    }
  }
  for (k = 0; k < f->count && (f->factors[k] == NULL || f->factors[k]->is_valid); k++) {
  }
  return k;
}

static void sli_factor_batch_stats(const sli_factor_batch *f, sl_int at, double started,
                   sl_stats *stats) {
  const sl_factor *F = f->factors[sli_min(at, f->count - 1)];
  sl_int k;
  if (stats == NULL || F == NULL) {
    return;
  }
  sli_factor_stats_report(F, stats);
  stats->factor.seconds_setup = 0.0;
  stats->factor.seconds = sli_seconds() - started;
  stats->factor.bytes = 0;
  for (k = 0; k < f->count; k++) {
    if (f->factors[k] != NULL) {
      stats->factor.seconds_setup += f->factors[k]->stats.factor.seconds_setup;
      stats->factor.bytes += f->factors[k]->stats.factor.bytes;
    }
  }
}

static sl_int sli_factor_batch_create(sl_factor **out, sl_int count, const sl_symbolic *S,
                    const sl_options *opt, sl_status *status, sl_stats *stats) {
  const sl_threads no_threads = {0, NULL, NULL};
  const sl_int workers = opt == NULL ? 1 : sli_workers(&opt->threads);
  sl_options serial;
  sl_int k, at = count;
  memset(&serial, 0, sizeof serial);
  if (opt != NULL) {
    serial = *opt;
    serial.threads = no_threads;
  }
  for (k = 0; k < count; k++) {
    const sl_status here = sli_factor_new(
      &out[k], S, k < count / workers * workers ? &serial : opt, at == count ? stats : NULL);
    if (here != SL_OK && at == count) {
      at = k;
      *status = here;
    }
  }
  return at;
}

SL_API sl_status sl_batch_factor(sl_factor **out, sl_int count, const sl_symbolic *S,
                 const double *coefficients, const double *const *values,
                 sl_int terms, const sl_options *opt, sl_int *failed,
                 sl_stats *stats) {
  const sl_threads serial = {0, NULL, NULL};
  double started;
  sli_factor_batch f;
  sl_status status;
  sl_int k, n_created, at;
  sli_stats_clear_error(stats);
  if (failed != NULL) {
    *failed = -1;
  }
  for (k = 0; k < count && out != NULL; k++) {
    out[k] = NULL;
  }
  if (count < 0 || (count > 0 && out == NULL) || S == NULL ||
    !sli_factor_options_are_valid(opt)) {
    return SL_ERR_ARGUMENT;
  }
  f.factors = out;
  f.count = count;
  status = sli_source_of_sum(S, coefficients, values, terms, &f.source);
  if (status != SL_OK || count == 0) {
    return status;
  }
  n_created = sli_factor_batch_create(out, count, S, opt, &status, stats);
  started = sli_seconds();
  at = sli_factor_batch_run(&f, opt == NULL ? &serial : &opt->threads);
  status = at < n_created ? out[at]->status : status;
  sli_factor_batch_stats(&f, sli_min(at, n_created), started, stats);
  for (k = at; k < count; k++) {
    if (out[k] != NULL && !out[k]->is_valid) {
      sl_factor_free(out[k]);
      out[k] = NULL;
    }
  }
  at = sli_min(at, n_created);
  if (failed != NULL && at < count) {
    *failed = at;
  }
  return status;
}

static sl_status sli_factor_batch_check(sl_factor *const *factors, sl_int count, sl_int *at) {
  sl_int k, other;
  for (k = 0; k < count; k++) {
    *at = k;
    if (factors[k] == NULL) {
      return SL_ERR_ARGUMENT;
    }
    for (other = 0; other < k; other++) {
      if (factors[other] == factors[k]) {
        return SL_ERR_ARGUMENT;
      }
    }
    if (!sli_factor_is_over(factors[k], factors[0]->S, factors[0]->analysis) ||
      factors[k]->is_immutable) {
      return SL_ERR_STATE;
    }
  }
  *at = -1;
  return SL_OK;
}

static sl_status sli_factor_batch_prepare(sl_factor *const *factors, sl_int count, sl_int *at) {
  sl_status status = SL_OK;
  sl_int k;
  for (k = 0; k < count && status == SL_OK; k++) {
    status = sli_factor_prepare(factors[k]);
    *at = status == SL_OK ? -1 : k;
  }
  return status;
}

SL_API sl_status sl_batch_refactor(sl_factor *const *factors, sl_int count,
                   const double *coefficients, const double *const *values,
                   sl_int terms, const sl_options *opt, sl_int *failed,
                   sl_stats *stats) {
  const sl_threads serial = {0, NULL, NULL};
  const sl_threads *threads = opt == NULL ? &serial : &opt->threads;
  const double started = sli_seconds();
  sli_factor_batch f;
  sl_status status;
  sl_int k, at = -1;
  sli_stats_clear_error(stats);
  if (failed != NULL) {
    *failed = -1;
  }
  if (count < 0 || (count > 0 && factors == NULL) ||
    !sli_options_are_valid(opt, SLI_READS_NOTHING)) {
    return SL_ERR_ARGUMENT;
  }
  status = sli_factor_batch_check(factors, count, &at);
  if (status == SL_OK && count > 0) {
    status = sli_source_of_sum(factors[0]->S, coefficients, values, terms, &f.source);
  }
  status = status == SL_OK ? sli_factor_batch_prepare(factors, count, &at) : status;
  if (status == SL_OK && count > 0) {
    f.factors = factors;
    f.count = count;
    k = sli_factor_batch_run(&f, threads);
    sli_factor_batch_stats(&f, k, started, stats);
    at = k < count ? k : -1;
    status = k < count ? factors[k]->status : SL_OK;
  }
  if (failed != NULL) {
    *failed = at;
  }
  return status;
}

/* src/impl/batch/batch_diagonal.h: diagonals of the inverses of several factors; a worker takes whole factors */

typedef struct sli_diagonal_batch {
  const sl_factor *const *factors;
  sl_int count, workers;
  double *out;
  size_t ldo;
  const sl_int *rows;
  sl_int n_rows;
  sl_threads serial;
  sl_work *const *works;
} sli_diagonal_batch;

static sli_entries sli_diagonal_batch_entries(const sli_diagonal_batch *d, sl_int k) {
  sli_entries q =
    sli_entries_of(d->factors[k], d->out + (size_t)k * d->ldo, d->rows, d->rows, d->n_rows);
  q.threads = d->workers > 1 ? &d->serial : q.threads;
  return q;
}

static void sli_diagonal_batch_worker(void *data, sl_int w) {
  const sli_diagonal_batch *d = (const sli_diagonal_batch *)data;
  sl_int k;
  for (k = w; k < d->count; k += d->workers) {
    sli_entries q = sli_diagonal_batch_entries(d, k);
    const sl_status status = sli_entries_run(&q, d->works[w], NULL);
    SLI_ASSERT(status == SL_OK);
    (void)status;
  }
}

static sl_status sli_diagonal_batch_check(const sli_diagonal_batch *d, sl_int *at,
                      sl_stats *stats) {
  for (*at = 0; *at < d->count; ++*at) {
    const sl_factor *F = d->factors[*at];
    if (F == NULL) {
      return SL_ERR_ARGUMENT;
    }
    if (!F->is_valid || !sli_factor_is_over(F, d->factors[0]->S, d->factors[0]->analysis)) {
      return SL_ERR_STATE;
    }
    if (F->E != NULL) {
      return sli_inverse_check(F);
    }
  }
  *at = -1;
  return d->count == 0 ? SL_OK : sli_check_rows(d->factors[0]->S, d->rows, d->n_rows, 0, stats);
}

static sl_status sli_diagonal_batch_reserve(const sli_diagonal_batch *d) {
  sl_status status = SL_OK;
  sl_int k;
  for (k = 0; k < d->count && status == SL_OK; k++) {
    if (k == 0 || d->factors[k]->kernels != d->factors[k - 1]->kernels ||
      d->workers == 1) {
      sli_entries q = sli_diagonal_batch_entries(d, k);
      status = sli_entries_prepare(&q, d->works[0]);
    }
  }
  for (k = 1; k < d->workers && status == SL_OK; k++) {
    status = sli_work_grow(d->works[k], d->works[0]->size);
  }
  return status;
}

static sl_status sli_diagonal_batch_run(sli_diagonal_batch *d, const sl_threads *threads) {
  const sl_allocator *a = &d->factors[0]->allocator;
  sl_work *own = NULL, **works = NULL;
  sli_block b = {NULL, 0, 0};
  sl_status status = SL_OK;
  sl_int w;
  int pass;
  for (pass = 0; pass < 2 && d->works == NULL && status == SL_OK; pass++) {
    own = SLI_TAKE(&b, sl_work, d->workers);
    works = SLI_TAKE(&b, sl_work *, d->workers);
    status = pass == 0 ? sli_block_alloc(&b, a) : SL_OK;
  }
  if (status != SL_OK) {
    return status;
  }
  if (d->works == NULL) {
    for (w = 0; w < d->workers; w++) {
      own[w] = sli_work_own(&d->factors[0]->allocator);
      works[w] = &own[w];
    }
    d->works = works;
  }
  status = sli_diagonal_batch_reserve(d);
  if (status == SL_OK) {
    sli_parallel(threads, d->workers, sli_diagonal_batch_worker, d);
  }
  for (w = 0; w < d->workers && own != NULL; w++) {
    sli_free(a, own[w].block);
  }
  sli_free(a, b.base);
  return status;
}

SL_API sl_status sl_batch_diagonal(const sl_factor *const *factors, sl_int count, double *out,
                   size_t ldo, const sl_int *rows, sl_int n_rows,
                   const sl_options *opt, sl_work *const *works, sl_int *failed,
                   sl_stats *stats) {
  const sl_threads serial = {0, NULL, NULL};
  const sl_threads *threads = opt == NULL ? &serial : &opt->threads;
  sli_diagonal_batch d;
  sl_status status;
  sl_int at = -1;
  sli_stats_clear_error(stats);
  if (failed != NULL) {
    *failed = -1;
  }
  if (count < 0 || (count > 0 && factors == NULL) ||
    !sli_options_are_valid(opt, SLI_READS_NOTHING)) {
    return SL_ERR_ARGUMENT;
  }
  d.serial = serial;
  d.factors = factors;
  d.count = count;
  d.workers = sli_min(sli_workers(threads), count);
  d.out = out;
  d.ldo = ldo;
  d.rows = rows;
  d.n_rows = n_rows;
  d.works = works;
  status = sli_diagonal_batch_check(&d, &at, stats);
  if (failed != NULL) {
    *failed = at;
  }
  if (status != SL_OK || count == 0) {
    return status;
  }
  n_rows = d.n_rows = rows == NULL ? factors[0]->S->n : n_rows;
  if (n_rows < 0 || (n_rows > 0 && (out == NULL || ldo < (size_t)n_rows))) {
    return SL_ERR_ARGUMENT;
  }
  status = works == NULL ? SL_OK : sli_check_works(works, d.workers);
  return status == SL_OK && n_rows > 0 ? sli_diagonal_batch_run(&d, threads) : status;
}

/* complex: complex Hermitian systems over real factors */
/* src/impl/complex/hermitian.h: complex Hermitian matrices as real symmetric ones of twice the size */

static sl_status sli_hermitian_check(const sl_hermitian *H, sl_stats *stats) {
  sl_csc pattern = {0, 0, NULL, NULL, NULL};
  sl_status status;
  sl_int j, p;
  sli_stats_clear_error(stats);
  if (H == NULL || (H->x == NULL && H->im != NULL)) {
    return SL_ERR_ARGUMENT;
  }
  pattern.n_rows = pattern.n_cols = H->n;
  pattern.p = H->p;
  pattern.i = H->i;
  status = H->n > SLI_ROWS_MAX / 2 ? SL_ERR_TOO_LARGE : sl_csc_check(&pattern, stats);
  for (j = 0; status == SL_OK && H->x != NULL && j < H->n; j++) {
    for (p = H->p[j]; p < H->p[j + 1]; p++) {
      const double im = H->im != NULL ? H->im[p] : H->x[2 * (size_t)p + 1];
      if (H->i[p] == j && !(im == 0.0)) {
        return sli_fail_at(stats, SL_ERR_ARGUMENT, j, j, im);
      }
    }
  }
  return status;
}

typedef struct sli_hermitian_sides {
  int lower, upper;
} sli_hermitian_sides;

static sli_hermitian_sides sli_hermitian_sides_of(const sl_hermitian *H) {
  sli_hermitian_sides sides = {0, 0};
  sl_int j, p;
  for (j = 0; j < H->n; j++) {
    for (p = H->p[j]; p < H->p[j + 1]; p++) {
      sides.lower |= H->i[p] > j;
      sides.upper |= H->i[p] < j;
    }
  }
  sides.lower |= !sides.upper;
  return sides;
}

static sl_off sli_hermitian_entries(const sl_hermitian *H, sli_hermitian_sides sides) {
  sl_off count = 0;
  sl_int j, p;
  for (j = 0; j < H->n; j++) {
    for (p = H->p[j]; p < H->p[j + 1]; p++) {
      count += H->i[p] == j ? 2 + sides.lower + sides.upper : 4;
    }
  }
  return count;
}

typedef struct sli_hermitian_column {
  sl_int row, count;
  double x[2];
} sli_hermitian_column;

static sli_hermitian_column sli_hermitian_entry(const sl_hermitian *H, sli_hermitian_sides sides,
                        sl_int p, sl_int j, int second) {
  const double a = H->x == NULL ? 0.0 : H->im != NULL ? H->x[p] : H->x[2 * (size_t)p];
  const double b = H->x == NULL ? 0.0 : H->im != NULL ? H->im[p] : H->x[2 * (size_t)p + 1];
  sli_hermitian_column out;
  if (H->i[p] == j) {
    const int whole = second ? sides.upper : sides.lower;
    out.row = 2 * j + (second && !whole);
    out.count = 1 + whole;
    out.x[0] = second && whole ? 0.0 : a;
    out.x[1] = second && whole ? a : 0.0;
  } else {
    out.row = 2 * H->i[p];
    out.count = 2;
    out.x[0] = second ? -b : a;
    out.x[1] = second ? a : b;
  }
  return out;
}

static void sli_hermitian_fill(const sl_hermitian *H, sl_matrix *M) {
  const sli_hermitian_sides sides = sli_hermitian_sides_of(H);
  sl_int j, p, k, second, at = 0;
  M->p[0] = 0;
  for (j = 0; j < H->n; j++) {
    for (second = 0; second < 2; second++) {
      for (p = H->p[j]; p < H->p[j + 1]; p++) {
        const sli_hermitian_column e = sli_hermitian_entry(H, sides, p, j, second);
        for (k = 0; k < e.count; k++, at++) {
          M->i[at] = e.row + k;
          if (M->x != NULL) {
            M->x[at] = e.x[k];
          }
        }
      }
      M->p[2 * j + second + 1] = at;
    }
  }
}

static sl_status sli_hermitian_compare(const sl_hermitian *H, const sl_matrix *M, sl_stats *stats) {
  const sli_hermitian_sides sides = sli_hermitian_sides_of(H);
  sl_int j, p, k, second, at = 0;
  if (M->n_cols != 2 * H->n || M->n_rows != 2 * H->n) {
    return SL_ERR_PATTERN;
  }
  for (j = 0; j < H->n; j++) {
    for (second = 0; second < 2; second++) {
      const sl_int end = M->p[2 * j + second + 1];
      for (p = H->p[j]; p < H->p[j + 1]; p++) {
        const sli_hermitian_column e = sli_hermitian_entry(H, sides, p, j, second);
        for (k = 0; k < e.count; k++, at++) {
          if (at >= end || M->i[at] != e.row + k) {
            return sli_fail_at(stats, SL_ERR_PATTERN, H->i[p], j, 0.0);
          }
        }
      }
      if (at != end) {
        return sli_fail_at(stats, SL_ERR_PATTERN, -1, j, 0.0);
      }
    }
  }
  return SL_OK;
}

SL_API sl_status sl_matrix_from_hermitian(sl_matrix **out, const sl_hermitian *H,
                      const sl_options *opt, sl_stats *stats) {
  const sl_allocator a = sli_allocator(opt);
  sl_matrix *M;
  sl_status status;
  sl_off count;
  if (out == NULL) {
    return SL_ERR_ARGUMENT;
  }
  *out = NULL;
  status = sli_options_are_valid(opt, SLI_READS_NOTHING) ? sli_hermitian_check(H, stats)
                               : SL_ERR_ARGUMENT;
  if (status != SL_OK) {
    return status;
  }
  count = sli_hermitian_entries(H, sli_hermitian_sides_of(H));
  if (count > INT32_MAX) {     /* untested: 2^29 entries */
    return SL_ERR_TOO_LARGE; /* untested: the same */
  }
  status = sli_matrix_new(&M, 2 * H->n, 2 * H->n, (sl_int)count, H->x != NULL, &a);
  if (status == SL_OK) {
    sli_hermitian_fill(H, M);
    *out = M;
  }
  return status;
}

SL_API sl_status sl_matrix_refill_hermitian(sl_matrix *M, const sl_hermitian *H, sl_stats *stats) {
  sl_status status = sli_hermitian_check(H, stats);
  if (status == SL_OK && (M == NULL || M->x == NULL || H->x == NULL)) {
    status = SL_ERR_ARGUMENT;
  }
  status = status == SL_OK ? sli_hermitian_compare(H, M, stats) : status;
  if (status == SL_OK) {
    sli_hermitian_fill(H, M);
  }
  return status;
}

/* src/impl/complex/complex_rows.h: calls on a real factor whose sets count complex rows */

typedef struct sli_complex_set {
  const sl_int *rows;
  sl_int count;
  sl_int *real;
} sli_complex_set;

static sl_status sli_complex_check(sl_int n, const sli_complex_set *set) {
  return n % 2 != 0 || (set->rows != NULL && set->count < 0)  ? SL_ERR_ARGUMENT
       : set->rows != NULL && set->count > SLI_ROWS_MAX / 2 ? SL_ERR_TOO_LARGE
                                : SL_OK;
}

static void sli_complex_layout(sli_complex_set *set, sli_block *b) {
  set->real = SLI_TAKE(b, sl_int, set->rows == NULL ? 0 : 2 * (size_t)set->count);
}

static sl_int sli_complex_expand(const sl_int *rows, sl_int count, sl_int n, sl_int *real) {
  sl_int k;
  for (k = 0; k < count; k++) {
    if (rows[k] < 0 || rows[k] >= n) {
      return k;
    }
    real[2 * (size_t)k] = 2 * rows[k];
    real[2 * (size_t)k + 1] = 2 * rows[k] + 1;
  }
  return -1;
}

static sl_status sli_complex_sets(sl_int n, sli_complex_set *first, sli_complex_set *second,
                  int is_block, sli_block *b, const sl_allocator *a,
                  sl_stats *stats) {
  sl_status status = sli_complex_check(n, first);
  sl_int bad;
  int pass;
  status = status == SL_OK ? sli_complex_check(n, second) : status;
  for (pass = 0; pass < 2 && status == SL_OK; pass++) {
    sli_complex_layout(first, b);
    sli_complex_layout(second, b);
    status = pass == 0 ? sli_block_alloc(b, a) : SL_OK;
  }
  if (status != SL_OK) {
    return status;
  }
  bad = first->rows == NULL ? -1
                : sli_complex_expand(first->rows, first->count, n / 2, first->real);
  if (bad != -1) {
    status = sli_fail_at(stats, SL_ERR_ARGUMENT, first->rows[bad], -1, 0.0);
  } else {
    bad = second->rows == NULL
          ? -1
          : sli_complex_expand(second->rows, second->count, n / 2, second->real);
    if (bad != -1) {
      status = sli_fail_at(stats, SL_ERR_ARGUMENT, is_block ? -1 : second->rows[bad],
                 is_block ? second->rows[bad] : -1, 0.0);
    }
  }
  if (status != SL_OK) {
    sli_free(a, b->base);
  }
  return status;
}

static const sl_int *sli_complex_real(const sli_complex_set *set) {
  return set->rows == NULL || set->count == 0 ? set->rows : set->real;
}

SL_API sl_status sl_complex_rows(sl_int *out, const sl_int *rows, sl_int count) {
  if (count < 0 || count > SLI_ROWS_MAX / 2 || (count > 0 && (out == NULL || rows == NULL))) {
    return SL_ERR_ARGUMENT;
  }
  return sli_complex_expand(rows, count, SLI_ROWS_MAX / 2, out) == -1 ? SL_OK : SL_ERR_ARGUMENT;
}

SL_API sl_status sl_complex_plan_create(sl_plan **out, const sl_symbolic *S, const sl_int *bset,
                    sl_int nb, const sl_int *xset, sl_int nx,
                    const sl_options *opt, sl_stats *stats) {
  const sl_allocator a = sli_allocator(opt);
  sli_complex_set b, x;
  sli_block block = {NULL, 0, 0};
  sl_status status;
  sli_stats_clear_error(stats);
  if (out == NULL) {
    return SL_ERR_ARGUMENT;
  }
  *out = NULL;
  if (S == NULL || !sli_options_are_valid(opt, SLI_READS_REGION)) {
    return SL_ERR_ARGUMENT;
  }
  b.rows = bset;
  b.count = nb;
  x.rows = xset;
  x.count = nx;
  status = sli_complex_sets(S->n, &b, &x, 0, &block, &a, stats);
  if (status == SL_OK) {
    status = sl_plan_create(out, S, sli_complex_real(&b), bset == NULL ? 0 : 2 * nb,
                sli_complex_real(&x), xset == NULL ? 0 : 2 * nx, opt, stats);
    sli_free(&a, block.base);
  }
  return status;
}

SL_API sl_status sl_complex_inverse_block(const sl_factor *F, double *Z, size_t ldz,
                      const sl_int *rows, sl_int n_rows, const sl_int *columns,
                      sl_int n_columns, sl_work *W, sl_stats *stats) {
  sli_complex_set r, c;
  sli_block block = {NULL, 0, 0};
  sl_status status;
  sl_int k;
  sli_stats_clear_error(stats);
  if (F == NULL || ldz > SIZE_MAX / 2 || (rows == NULL && n_rows != 0) ||
    (columns == NULL && n_columns != 0)) {
    return SL_ERR_ARGUMENT;
  }
  r.rows = rows;
  r.count = n_rows;
  c.rows = columns;
  c.count = n_columns;
  status = sli_complex_sets(F->S->n, &r, &c, 1, &block, &F->allocator, stats);
  if (status == SL_OK) {
    for (k = 0; k < n_columns;
       k++) {
      c.real[k] = 2 * columns[k];
    }
    status = sl_inverse_block(F, Z, 2 * ldz, r.real, 2 * n_rows, c.real, n_columns, W, stats);
    sli_free(&F->allocator, block.base);
  }
  return status;
}

SL_API sl_status sl_complex_inverse_pairs(const sl_factor *F, double *out, const sl_int *rows,
                      const sl_int *columns, sl_int count, sl_work *W,
                      sl_stats *stats) {
  sli_complex_set r, c;
  sli_block block = {NULL, 0, 0};
  sl_status status;
  sl_int k;
  sli_stats_clear_error(stats);
  if (F == NULL || ((rows == NULL || columns == NULL) && count != 0)) {
    return SL_ERR_ARGUMENT;
  }
  r.rows = rows;
  c.rows = columns;
  r.count = c.count = count;
  status = sli_complex_sets(F->S->n, &r, &c, 1, &block, &F->allocator, stats);
  if (status == SL_OK) {
    for (k = 0; k < count;
       k++) {
      c.real[2 * (size_t)k + 1] = c.real[2 * (size_t)k];
    }
    status = sl_inverse_pairs(F, out, r.real, c.real, 2 * count, W, stats);
    sli_free(&F->allocator, block.base);
  }
  return status;
}

SL_API sl_status sl_complex_logdet(const sl_factor *F, double *log_abs_det, double *sign) {
  sl_status status =
    F != NULL && F->S->n % 2 != 0 ? SL_ERR_ARGUMENT : sl_factor_logdet(F, log_abs_det, sign);
  if (status == SL_OK) {
    *log_abs_det *= 0.5;
    *sign = F->stats.factor.negative / 2 % 2 == 0 ? 1.0 : -1.0;
  }
  return status;
}

/* last: undefine every internal macro */
/* src/impl/base/undef.h: undefines every internal macro */
#undef SLI_METIS
#undef SLI_GNU
#undef SLI_WINDOWS
#undef SLI_FNMA1
#undef SLI_PIN
#undef SLI_PIN_ANY
#undef SLI_X86
#undef SLI_OSXSAVE
#undef SLI_ARM
#undef SLI_AVX512
#undef SLI_INLINE
#undef SLI_ALWAYS_INLINE
#undef SLI_NOINLINE
#undef SLI_TARGET
#undef SLI_UNROLL
#undef SLI_ALIGNED
#undef SLI_PREFETCH
#undef SLI_SPIN
#undef SLI_ATOMIC
#undef SLI_USLEEP
#undef SLI_WORKER_FLOPS
#undef SLI_SMALL_TASKS
#undef SLI_ASSERT
#undef SLI_HASH_STRIPE
#undef SLI_HASH_1
#undef SLI_HASH_2
#undef SLI_HASH_3
#undef SLI_HASH_4
#undef SLI_ROWS_MAX
#undef SLI_ALIGN
#undef SLI_HUGE_PAGES
#undef SLI_POSIX
#undef SLI_BIG_ENDIAN
#undef SLI_MMAP
#undef SLI_MAP_VIEW
#undef SLI_FSYNC
#undef SLI_READ_VERSION
#undef SLI_WRITE_VERSION
#undef SLI_ORDER_MARK
#undef SLI_ORDER_MARK_SWAPPED
#undef SLI_SECTIONS_MAX
#undef SLI_HUGE_BLOCK
#undef SLI_PAGE
#undef SLI_TAKE
#undef SLI_SORT_SMALL
#undef SLI_TILE
#undef SLI_CASE
#undef SLI_CASES
#undef SLI_PREFETCH_DISTANCE
#undef SLI_EACH4
#undef SLI_EACH8
#undef SLI_EACH4_AGAIN
#undef SLI_EACH8_AGAIN
#undef SLI_HIGH4
#undef SLI_HIGH8
#undef SLI_LOW4
#undef SLI_LOW8
#undef SLI_PASTE
#undef SLI_BY_TYPE
#undef SLI_VALUE_0
#undef SLI_VALUE_1
#undef SLI_SWEEP_0
#undef SLI_SWEEP_1
#undef SLI_WIDE_0
#undef SLI_WIDE_1
#undef SLI_WIDEN_0
#undef SLI_WIDEN_1
#undef SLV_SINGLE
#undef SLV_VALUE
#undef SLV_SWEEP
#undef SLW_SWEEP
#undef SLW_SWEEP_HALF
#undef SLV_READ
#undef SLV_PREFETCH
#undef SLV_WIDE
#undef SLV_WIDEN
#undef SLI_EXPAND_PLAIN
#undef SLI_EXPAND_ADD_PLAIN
#undef SLI_GROUP_TILES
#undef SLI_CHUNK_COLUMNS
#undef SLI_FRONT_RECIPROCALS
#undef SLI_PIVOT_THRESHOLD
#undef SLI_QUOTIENT_DENSE_ROW
#undef SLI_ORDER_ND_FLOPS
#undef SLI_GROWTH_LIMIT
#undef SLI_GROWTH_LIMIT_FLOAT
#undef SLI_ROUNDING_ERROR
#undef SLI_NULL_PIVOT
#undef SLI_SUSPECT_ROW
#undef SLI_INVERSE_GROUP
#undef SLI_INVERSE_ROW
#undef SLI_INVERSE_COLUMNS
#undef SLI_INVERSE_PHASES
#undef SLI_PANEL_AHEAD
#undef SLI_TASKS_PER_WORKER
#undef SLI_SHARED_FLOPS
#undef SLI_FRONT_COST
#undef SLI_BUNDLE_FLOPS
#undef SLI_WORTHWHILE
#undef SLI_SUM_ENTRIES
#undef SLI_ROWS_AHEAD
#undef SLI_TEMPORARY_NAMES
#undef SLI_TEMPORARY_SUFFIX
#undef SLI_UNNAMED_FILES
#undef SLI_FILE_NAME_MAX
#undef SLI_HERE
#undef SLI_FOLLOW
#undef SLI_TOKEN_MAX
#undef SLI_LINE_MAX
#undef SLI_ENTRIES_FIRST
#undef SLI_POINT_MAX
#undef SLI_ORDER_TINY
#undef SLI_COARSEN_STALL
#undef SLI_LEVELS_MAX
#undef SLI_BAND_SHARE
#undef SLI_BISECT_BALANCE
#undef SLI_FLOW_NONE
#undef SLI_FLOW_END
#undef SLI_FLOW_ROUNDS
#undef SLI_MARKS_BEGIN
#undef SLI_MINDEG_MAX
#undef SLI_MINDEG_ELIMINATED
#undef SLI_DISSECT_LEAF
#undef SLI_DISSECT_LEAF_REFINED
#undef SLI_DISSECT_BISECT_MIN
#undef SLI_DISSECT_SHRINK
#undef SLI_DISSECT_FIRST
#undef SLI_DISSECT_TRIES_FIRST
#undef SLI_DISSECT_TRIES
#undef SLI_DISSECT_LAYERS
#undef SLI_DISSECT_BAND
#undef SLI_DISSECT_BAND_FROM
#undef SLI_FLAT_ENOUGH
#undef SLI_POINTS_MANY
#undef SLI_POINTS_TRIED
#undef SLI_ND_DENSE_ROW
#undef SLI_SEPARATOR_BALANCE
#undef SLI_ND_RESPLITS
#undef SLI_METIS_REFINED_SHARE
#undef SLI_COMPRESS_SHARE
#undef SLI_LEVELSET_SHARE
#undef SLI_VOLUME_BORDER
#undef SLI_REACH_WALK
#undef SLI_LANES_MAX
#undef SLI_BLOCK_REQUESTS_MAX
#undef SLI_BLOCK_KEPT
#undef SLI_REGION_COLUMNS
#undef SLI_REGION_PASSES
#undef SLI_REGION_DETOUR
#undef SLI_ZEROS_SMALL
#undef SLI_CHANGE_ENTRY
#undef SLI_CHANGE_FLOP
#undef SLI_CHANGE_FRONT_FLOP
#undef SLI_CHANGE_FRONT
#undef SLI_CHANGE_DRIFT
#undef SLI_CELLS
#undef SLI_CELLS_AS_GOOD
#undef SLI_CELLS_DEPTH
#undef SLI_CELLS_FLAT
#undef SLI_CELLS_SHARE
#undef SLI_CELL_LEAST
#undef SLI_LATTICE_DEGREE
#undef SLI_LATTICE_DEGREES
#undef SLI_LATTICE_SHARE
#undef SLI_NULL_ANCHOR
#undef SLI_NULL_DEPENDENT
#undef SLI_NULL_VECTORS_MAX
#undef SLI_PAGES_PER_COLUMN
#undef SLI_PAGE_BITS
#undef SLI_PAGE_COLUMNS
#undef SLI_POINTS_FEW
#undef SLI_READ_VERSION_DOUBLE
#undef SLI_RESTRICT_KEPT
#undef SLI_WRITE_VERSION_PLAIN
#endif

/* templates: the header includes them from itself, once for each instruction set */

#ifdef SLI_SECTION_MULTI_RHS
#undef SLI_SECTION_MULTI_RHS
#if SL_VERSION_MAJOR != 0 || \
     SL_VERSION_MINOR != 1 || \
     SL_VERSION_PATCH != 0
#error "sparse_local.h: SL_HEADER names another version of the header"
#endif
/* src/impl/kernels/multi_rhs.inl.h: sweeps for 2, 4 or 8 right-hand sides, vectorized over right-hand sides */

#if SLW_ROWS == 8
#define SLW_EACH SLI_EACH8
#define SLW_EACH_AGAIN SLI_EACH8_AGAIN
#define SLW_HIGH SLI_HIGH8
#define SLW_LOW SLI_LOW8
#else
#define SLW_EACH SLI_EACH4
#define SLW_EACH_AGAIN SLI_EACH4_AGAIN
#define SLW_HIGH SLI_HIGH4
#define SLW_LOW SLI_LOW4
#endif

#define SLI_DECLARE(r, k) SLW_DECLARE(a##r)
#define SLI_LOAD(r, p) SLW_LOAD(a##r, (p) + (r)*SLW_NRHS)
#define SLI_STORE(r, p) SLW_STORE((p) + (r)*SLW_NRHS, a##r)
#define SLI_APPLY(r, l) SLW_FNMA(a##r, (l)[r], b)
#define SLI_GATHER(r, l) SLW_FNMA(b, (l)[r], a##r)
#define SLI_GATHER2(r, l) SLW_FNMA(c, (l)[r], a##r)
#define SLI_DOWN(r, k) \
  if ((r) > (k)) { \
    SLW_FNMA(a##r, v[SLI_TILE * (k) + (r)], a##k) \
  }
#define SLI_UP(j, k) \
  if ((j) < (k) && (j) < inner) { \
    SLW_FNMA(a##j, v[SLI_TILE * (j) + (k)], a##k) \
  }
#define SLI_COLUMN(k, unused) \
  if ((k) < inner) { \
    SLW_EACH_AGAIN(SLI_DOWN, k) \
  }
#define SLI_ROW(k, unused) SLW_EACH_AGAIN(SLI_UP, k)

#if SLW_ROWS == 8
#define SLI_LOAD_OWN(k, p) \
  if ((k) < w) { \
    SLW_LOAD(a##k, (p) + (k)*stride) \
  }
#define SLI_STORE_OWN(k, p) \
  if ((k) < w) { \
    SLW_STORE((p) + (k)*stride, a##k) \
  }
#define SLI_ZERO_OWN(k, unused) SLW_ZERO(a##k)
#define SLI_PREFETCH_OWN(k, bytes) \
  if ((k) < w) { \
    SLV_PREFETCH(l, k, bytes) \
  }
#define SLI_DOWN_OWN(r, k) \
  if ((r) > (k) && (r) < w) { \
    SLW_FNMA(a##r, v[SLI_TILE * (k) + (r)], a##k) \
  }
#define SLI_COLUMN_OWN(k, unused) SLW_EACH_AGAIN(SLI_DOWN_OWN, k)
#define SLI_BELOW_OWN(k, unused) \
  if ((k) < w) { \
    SLW_FNMA(b, v[SLI_TILE * (k) + lane], a##k) \
  }

SLV_FUNCTION SLI_ALWAYS_INLINE void SLW_SWEEP(small_forward)(const sl_int w, sl_int stride,
                               sl_int below, const sl_int *rows,
                               const SLV_VALUE *l, double *xs,
                               double *x) {
  sl_int lane = w, i;
  SLW_EACH(SLI_DECLARE, 0)
  SLW_DECLARE(b)
  SLV_WIDE(v, SLI_TILE)
  SLV_WIDEN(v, l, w, SLI_TILE)
  SLW_EACH(SLI_PREFETCH_OWN, SLI_PREFETCH_DISTANCE)
  SLW_EACH(SLI_LOAD_OWN, xs)
  SLW_EACH(SLI_COLUMN_OWN, 0)
  SLW_EACH(SLI_STORE_OWN, xs)
  for (i = 0; i < below; lane++, i++) {
    double *to = x + (ptrdiff_t)rows[i] * stride;
    if (lane == SLI_TILE) {
      lane = 0;
      l += SLI_TILE * w;
      SLV_WIDEN(v, l, w, SLI_TILE)
      SLW_EACH(SLI_PREFETCH_OWN, SLI_PREFETCH_DISTANCE)
    }
    SLW_LOAD(b, to)
    SLW_EACH(SLI_BELOW_OWN, 0)
    SLW_STORE(to, b)
  }
}

#define SLI_UP_OWN(j, k) \
  if ((j) < (k) && (k) < w) { \
    SLW_FNMA(a##j, v[SLI_TILE * (j) + (k)], a##k) \
  }
#define SLI_ROW_OWN(k, unused) SLW_EACH_AGAIN(SLI_UP_OWN, k)
#define SLI_ABOVE_OWN(k, unused) \
  if ((k) < w) { \
    SLW_FNMA(a##k, v[SLI_TILE * (k) + lane], b) \
  }
#define SLI_DIVIDE_OWN(k, unused) \
  if ((k) < w) { \
    SLW_LOAD(b, xs + (k)*stride) \
    SLW_DIVIDE(b, d[k]) \
    SLW_ADD(a##k, b) \
  }

SLV_FUNCTION SLI_ALWAYS_INLINE void SLW_SWEEP(small_backward)(const sl_int w, sl_int stride,
                                sl_int below, const sl_int *rows,
                                const SLV_VALUE *l, const double *d,
                                double *xs, const double *x) {
  sl_int i = below - 1, lane = (w + i) % SLI_TILE;
  SLW_EACH(SLI_DECLARE, 0)
  SLW_DECLARE(b)
  SLV_WIDE(v, SLI_TILE)
  SLV_WIDEN(v, l, w, SLI_TILE)
  SLW_EACH(SLI_ZERO_OWN, 0)
  SLW_HIGH(SLI_PREFETCH_OWN, -SLI_PREFETCH_DISTANCE)
  SLW_LOW(SLI_PREFETCH_OWN, -SLI_PREFETCH_DISTANCE)
  for (; i >= 0; lane--, i--) {
    if (lane < 0) {
      lane = SLI_TILE - 1;
      l -= SLI_TILE * w;
      SLV_WIDEN(v, l, w, SLI_TILE)
      SLW_HIGH(SLI_PREFETCH_OWN, -SLI_PREFETCH_DISTANCE)
      SLW_LOW(SLI_PREFETCH_OWN, -SLI_PREFETCH_DISTANCE)
    }
    SLW_LOAD(b, x + (ptrdiff_t)rows[i] * stride)
    SLW_HIGH(SLI_ABOVE_OWN, 0)
    SLW_LOW(SLI_ABOVE_OWN, 0)
  }
  if (w == SLI_TILE && below > 0) {
    l -= SLI_TILE * w;
    SLV_WIDEN(v, l, w, SLI_TILE)
  }
  SLW_EACH(SLI_DIVIDE_OWN, 0)
  SLW_HIGH(SLI_ROW_OWN, 0)
  SLW_LOW(SLI_ROW_OWN, 0)
  SLW_EACH(SLI_STORE_OWN, xs)
}

#define SLI_FORWARD(k) SLW_SWEEP(small_forward)(k, stride, below, rows, l, xs, x)
#define SLI_BACKWARD(k) SLW_SWEEP(small_backward)(k, stride, below, rows, l, d, xs, x)

SLV_FUNCTION static void SLW_SWEEP(forward_small)(sl_int w, sl_int stride, sl_int below,
                          const sl_int *rows, const SLV_VALUE *l,
                          double *xs, double *x) {
  SLI_CASES(SLI_FORWARD);
}

SLV_FUNCTION static void SLW_SWEEP(backward_small)(sl_int w, sl_int stride, sl_int below,
                           const sl_int *rows, const SLV_VALUE *l,
                           const double *d, double *xs, const double *x) {
  SLI_CASES(SLI_BACKWARD);
}

#undef SLI_LOAD_OWN
#undef SLI_STORE_OWN
#undef SLI_ZERO_OWN
#undef SLI_PREFETCH_OWN
#undef SLI_DOWN_OWN
#undef SLI_COLUMN_OWN
#undef SLI_BELOW_OWN
#undef SLI_UP_OWN
#undef SLI_ROW_OWN
#undef SLI_ABOVE_OWN
#undef SLI_DIVIDE_OWN
#undef SLI_FORWARD
#undef SLI_BACKWARD
#elif defined(SLW_HALF)
SLV_FUNCTION SLI_INLINE void SLW_SWEEP(forward_small)(sl_int w, sl_int stride, sl_int below,
                            const sl_int *rows, const SLV_VALUE *l,
                            double *xs, double *x) {
  const sl_int half = SLW_NRHS / 2;
  SLW_SWEEP_HALF(forward_small)(w, stride, below, rows, l, xs, x);
  SLW_SWEEP_HALF(forward_small)(w, stride, below, rows, l, xs + half, x + half);
}

SLV_FUNCTION SLI_INLINE void SLW_SWEEP(backward_small)(sl_int w, sl_int stride, sl_int below,
                             const sl_int *rows, const SLV_VALUE *l,
                             const double *d, double *xs,
                             const double *x) {
  const sl_int half = SLW_NRHS / 2;
  SLW_SWEEP_HALF(backward_small)(w, stride, below, rows, l, d, xs, x);
  SLW_SWEEP_HALF(backward_small)(w, stride, below, rows, l, d, xs + half, x + half);
}
#endif

#if !SLV_SINGLE
SLV_FUNCTION SLI_INLINE void SLW_NAME(rows_in)(double *buf, sl_int inner, sl_int below,
                         const sl_int *rows, const double *own,
                         const double *x) {
  sl_int r;
  SLW_DECLARE(b)
  for (r = 0; r < SLW_ROWS; r++) {
    if (r < inner + below) {
      SLW_LOAD(b, r < inner ? own + (ptrdiff_t)r * SLW_NRHS
                  : x + (ptrdiff_t)rows[r - inner] * SLW_NRHS)
    } else {
      SLW_ZERO(b)
    }
    SLW_STORE(buf + (ptrdiff_t)r * SLW_NRHS, b)
  }
}

SLV_FUNCTION SLI_INLINE void SLW_NAME(rows_out)(const double *buf, sl_int inner, sl_int below,
                        const sl_int *rows, double *own, double *x) {
  sl_int r;
  SLW_DECLARE(b)
  for (r = 0; r < SLW_ROWS && r < inner + below; r++) {
    SLW_LOAD(b, buf + (ptrdiff_t)r * SLW_NRHS)
    SLW_STORE(r < inner ? own + (ptrdiff_t)r * SLW_NRHS
              : x + (ptrdiff_t)rows[r - inner] * SLW_NRHS,
          b)
  }
}

#endif

SLV_FUNCTION static void SLW_SWEEP(forward)(sl_int count, const sli_step *s, const sl_int *rows,
                      const void *values, double *x, double *buf) {
  const SLV_VALUE *L = (const SLV_VALUE *)values;
  SLV_WIDE(v, SLI_TILE)
  for (; count > 0; rows += s->below, count--, s++) {
    const sl_int w = s->width, height = w + s->below, first = SLI_TILE * s->first_tile;
    const SLV_VALUE *tile = L + s->panel + sli_tile_offset(w, s->first_tile);
    double *xs = x + ((ptrdiff_t)s->base - first) * SLW_NRHS;
    ptrdiff_t row;
    sl_int j;
#if SLW_ROWS == 8 || defined(SLW_HALF)
    if (w <= SLI_TILE) {
      SLW_SWEEP(forward_small)(w, SLW_NRHS, s->below, rows, tile, xs, x);
      continue;
    }
#endif
    for (row = first; row < height; row += SLW_ROWS) {
      const sl_int lane = (sl_int)(row % SLI_TILE), final = (sl_int)(row < w ? row : w);
      const sl_int inner = sli_clamp(w - (sl_int)row, SLW_ROWS);
      const sl_int *below_rows = rows + (row + inner - w);
      double *own = xs + row * SLW_NRHS, *p = inner == SLW_ROWS ? own : buf;
      const SLV_VALUE *l = tile + SLI_TILE * (ptrdiff_t)first + lane;
      SLW_EACH(SLI_DECLARE, 0)
      SLW_DECLARE(b)
      if (inner < SLW_ROWS) {
        SLW_NAME(rows_in)(buf, inner, height - (sl_int)row - inner, below_rows, own, x);
      }
      SLW_EACH(SLI_LOAD, p)
      for (j = first; j < final; j++, l += SLI_TILE) {
        SLI_PREFETCH(l, SLI_PREFETCH_DISTANCE);
        SLV_WIDEN(v, l, 1, SLW_ROWS)
        SLW_LOAD(b, xs + (ptrdiff_t)j * SLW_NRHS)
        SLW_EACH(SLI_APPLY, v)
      }
      if (inner > 0) {
        SLV_WIDEN(v, l, inner, SLW_ROWS)
        SLW_EACH(SLI_COLUMN, 0)
      }
      SLW_EACH(SLI_STORE, p)
      if (inner < SLW_ROWS) {
        SLW_NAME(rows_out)(buf, inner, height - (sl_int)row - inner, below_rows, own, x);
      }
      if (lane + SLW_ROWS == SLI_TILE) {
        tile += SLI_TILE * (ptrdiff_t)sli_min(w, (sl_int)row + SLW_ROWS);
      }
    }
  }
}

SLV_FUNCTION static void SLW_SWEEP(backward)(sl_int count, const sli_step *s,
                       const sl_int *rows_end, const void *values,
                       const double *D, double *x, double *buf) {
  const SLV_VALUE *L = (const SLV_VALUE *)values;
  SLV_WIDE(v, SLI_TILE)
  for (s += count; count > 0; count--) {
    const sl_int w = (--s)->width, height = w + s->below, first = SLI_TILE * s->first_tile;
    const sl_int padded = SLI_TILE * sli_tiles(height);
    const SLV_VALUE *tile = L + s->panel + sli_panel_size(w, s->below);
    const double *d = D + s->column - first;
    double *xs = x + ((ptrdiff_t)s->base - first) * SLW_NRHS;
    ptrdiff_t row;
    sl_int i, j;
    SLW_DECLARE(b)
    SLW_DECLARE(c)
    rows_end -= s->below;
#if SLW_ROWS == 8 || defined(SLW_HALF)
    if (w <= SLI_TILE) {
      SLW_SWEEP(backward_small)
      (w, SLW_NRHS, s->below, rows_end, tile - SLI_TILE * w, d, xs, x);
      continue;
    }
#endif
    for (i = first; i < w; i++) {
      SLW_LOAD(b, xs + (ptrdiff_t)i * SLW_NRHS)
      SLW_DIVIDE(b, d[i])
      SLW_STORE(xs + (ptrdiff_t)i * SLW_NRHS, b)
    }
    for (row = padded - SLW_ROWS; row >= first; row -= SLW_ROWS) {
      const sl_int lane = (sl_int)(row % SLI_TILE), final = (sl_int)(row < w ? row : w);
      const sl_int inner = sli_clamp(w - (sl_int)row, SLW_ROWS);
      double *own = xs + row * SLW_NRHS, *p = inner == SLW_ROWS ? own : buf;
      const SLV_VALUE *l;
      SLW_EACH(SLI_DECLARE, 0)
      if (lane + SLW_ROWS == SLI_TILE) {
        tile -= SLI_TILE * (ptrdiff_t)sli_min(w, (sl_int)row + SLW_ROWS);
      }
      if (inner < SLW_ROWS) {
        SLW_NAME(rows_in)
        (buf, inner, height - (sl_int)row - inner, rows_end + (row + inner - w), own, x);
      }
      SLW_EACH(SLI_LOAD, p)
      if (inner > 0) {
        l = tile + SLI_TILE * row + lane;
        SLV_WIDEN(v, l, inner, SLW_ROWS)
        SLW_HIGH(SLI_ROW, 0)
        SLW_LOW(SLI_ROW, 0)
        SLW_EACH(SLI_STORE, p)
        if (inner < SLW_ROWS) {
          SLW_NAME(rows_out)(buf, inner, 0, NULL, own, x);
        }
      }
      l = tile + SLI_TILE * (ptrdiff_t) final + lane;
      for (j = final - 1; j >= first; j--) {
        l -= SLI_TILE;
        SLI_PREFETCH(l, -SLI_PREFETCH_DISTANCE);
        SLV_WIDEN(v, l, 1, SLW_ROWS)
        SLW_LOAD(b, xs + (ptrdiff_t)j * SLW_NRHS)
        SLW_ZERO(c)
        SLW_HIGH(SLI_GATHER, v)
        SLW_LOW(SLI_GATHER2, v)
        SLW_ADD(b, c)
        SLW_STORE(xs + (ptrdiff_t)j * SLW_NRHS, b)
      }
    }
  }
}

#if SLW_NRHS == 8 && !SLV_SINGLE
SLV_FUNCTION static void SLW_NAME(products)(sl_int count, const double *y, const double *z,
                      double *sums) {
  sl_int row, k;
  for (row = 0; row < SLW_NRHS; row += SLW_ROWS) {
    const double *l = y + row, *p = z;
    double *s = sums + row * SLW_NRHS;
    SLW_EACH(SLI_DECLARE, 0)
    SLW_DECLARE(b)
    SLW_EACH(SLI_LOAD, s)
    for (k = 0; k < count; k++, l += SLW_NRHS, p += SLW_NRHS) {
      SLW_LOAD(b, p)
      SLW_EACH(SLI_APPLY, l)
    }
    SLW_EACH(SLI_STORE, s)
  }
}
#endif

#undef SLI_DECLARE
#undef SLI_LOAD
#undef SLI_STORE
#undef SLI_APPLY
#undef SLI_GATHER
#undef SLI_GATHER2
#undef SLI_DOWN
#undef SLI_UP
#undef SLI_COLUMN
#undef SLI_ROW
#undef SLW_EACH
#undef SLW_EACH_AGAIN
#undef SLW_HIGH
#undef SLW_LOW

#if SLV_SINGLE
#undef SLV_SINGLE
#define SLV_SINGLE 0
#undef SLW_NAME
#undef SLW_NRHS
#undef SLW_HALF
#else
#undef SLV_SINGLE
#define SLV_SINGLE 1
#endif
#endif

#ifdef SLI_SECTION_SWEEPS
#undef SLI_SECTION_SWEEPS
#if SL_VERSION_MAJOR != 0 || \
     SL_VERSION_MINOR != 1 || \
     SL_VERSION_PATCH != 0
#error "sparse_local.h: SL_HEADER names another version of the header"
#endif
/* src/impl/kernels/sweeps.inl.h: the sweeps for one and two right-hand sides, for one type of L */

/* src/impl/kernels/unit_triangle.inl.h: one right-hand side through the unit triangle of a diagonal tile */

#define SLI_X(k, j) r##k = SLV_FNMA1(v[SLI_TILE * j + k], r##j, r##k);
#define SLI_XT(j, k) r##j = SLV_FNMA1(v[SLI_TILE * j + k], r##k, r##j);

SLV_FUNCTION SLI_INLINE void SLV_SWEEP(tile_forward)(const SLV_VALUE *l, double *r) {
  SLV_WIDE(v, SLI_TILE)
  double r0 = r[0], r1 = r[1], r2 = r[2], r3 = r[3], r4 = r[4], r5 = r[5], r6 = r[6], r7 = r[7];
  SLV_WIDEN(v, l, SLI_TILE, SLI_TILE)
  SLI_X(1, 0) SLI_X(2, 0) SLI_X(3, 0) SLI_X(4, 0) SLI_X(5, 0) SLI_X(6, 0) SLI_X(7, 0)
  SLI_X(2, 1) SLI_X(3, 1) SLI_X(4, 1) SLI_X(5, 1) SLI_X(6, 1) SLI_X(7, 1)
  SLI_X(3, 2) SLI_X(4, 2) SLI_X(5, 2) SLI_X(6, 2) SLI_X(7, 2)
  SLI_X(4, 3) SLI_X(5, 3) SLI_X(6, 3) SLI_X(7, 3)
  SLI_X(5, 4) SLI_X(6, 4) SLI_X(7, 4)
  SLI_X(6, 5) SLI_X(7, 5)
  SLI_X(7, 6)
  r[1] = r1, r[2] = r2, r[3] = r3, r[4] = r4, r[5] = r5, r[6] = r6, r[7] = r7;
}

SLV_FUNCTION SLI_INLINE void SLV_SWEEP(tile_backward)(const SLV_VALUE *l, double *r) {
  SLV_WIDE(v, SLI_TILE)
  double r0 = r[0], r1 = r[1], r2 = r[2], r3 = r[3], r4 = r[4], r5 = r[5], r6 = r[6], r7 = r[7];
  SLV_WIDEN(v, l, SLI_TILE, SLI_TILE)
  SLI_XT(6, 7) SLI_XT(5, 7) SLI_XT(4, 7) SLI_XT(3, 7) SLI_XT(2, 7) SLI_XT(1, 7) SLI_XT(0, 7)
  SLI_XT(5, 6) SLI_XT(4, 6) SLI_XT(3, 6) SLI_XT(2, 6) SLI_XT(1, 6) SLI_XT(0, 6)
  SLI_XT(4, 5) SLI_XT(3, 5) SLI_XT(2, 5) SLI_XT(1, 5) SLI_XT(0, 5)
  SLI_XT(3, 4) SLI_XT(2, 4) SLI_XT(1, 4) SLI_XT(0, 4)
  SLI_XT(2, 3) SLI_XT(1, 3) SLI_XT(0, 3)
  SLI_XT(1, 2) SLI_XT(0, 2)
  SLI_XT(0, 1)
  r[0] = r0, r[1] = r1, r[2] = r2, r[3] = r3, r[4] = r4, r[5] = r5, r[6] = r6;
}

#undef SLI_X
#undef SLI_XT
/* end of unit_triangle.inl.h */
#if defined(SLV_PAIR)
/* src/impl/kernels/two_rhs.inl.h: sweeps for two right-hand sides, vectorized over the 8 rows of a tile */

#define SLI_PAIR_AXPY(e, l, p) \
  SLV_DUP_LOW(t0, l) \
  SLV_DUP_HIGH(t1, l) \
  SLV_PAIR(b, p) \
  SLV_FNMA(e##0, t0, b) \
  SLV_FNMA(e##1, t1, b)

#define SLI_PAIR_TILE(solve, l, p) \
  { \
    double r[2][SLI_TILE]; \
    for (k = 0; k < SLI_TILE; k++) { \
      r[0][k] = (p)[2 * k]; \
      r[1][k] = (p)[2 * k + 1]; \
    } \
    solve((l), r[0]); \
    solve((l), r[1]); \
    for (k = 0; k < SLI_TILE; k++) { \
      (p)[2 * k] = r[0][k]; \
      (p)[2 * k + 1] = r[1][k]; \
    } \
  }

SLV_FUNCTION static void SLV_SWEEP(forward2)(sl_int count, const sli_step *s, const sl_int *rows,
                       const void *values, double *x, double *buf) {
  const SLV_VALUE *L = (const SLV_VALUE *)values;
  for (; count > 0; count--, s++) {
    const sl_int w = s->width, height = w + s->below, first = SLI_TILE * s->first_tile;
    const size_t columns = 2 * (size_t)(w - first);
    const SLV_VALUE *tile = L + s->panel + sli_tile_offset(w, s->first_tile);
    double *xs = x + 2 * (ptrdiff_t)s->base;
    sl_int row, i, j, k;
    memcpy(buf + 2 * (ptrdiff_t)first, xs, columns * sizeof(double));
    memset(buf + 2 * (ptrdiff_t)w, 0,
         2 * (size_t)(SLI_TILE * sli_tiles(height) - w) * sizeof(double));
    for (row = first; row < height; row += SLI_TILE) {
      const sl_int final = sli_min(row, w), inner = sli_clamp(w - row, SLI_TILE);
      const SLV_VALUE *l = tile + SLI_TILE * (ptrdiff_t)first;
      double *p = buf + 2 * (ptrdiff_t)row;
      SLV_DECLARE(e0)
      SLV_DECLARE(e1)
      SLV_DECLARE(f0)
      SLV_DECLARE(f1)
      SLV_DECLARE(t0)
      SLV_DECLARE(t1)
      SLV_DECLARE(b)
      SLV_LOAD(e0, p)
      SLV_LOAD(e1, p + SLI_TILE)
      SLV_ZERO(f0)
      SLV_ZERO(f1)
      for (j = first; j + 2 <= final;
         j += 2, l += 2 * SLI_TILE) {
        SLI_PAIR_AXPY(e, l, buf + 2 * (ptrdiff_t)j)
        SLI_PAIR_AXPY(f, l + SLI_TILE, buf + 2 * (ptrdiff_t)j + 2)
      }
      if (j < final) {
        SLI_PAIR_AXPY(e, l, buf + 2 * (ptrdiff_t)j)
      }
      SLV_ADD(e0, f0)
      SLV_ADD(e1, f1)
      SLV_STORE(p, e0)
      SLV_STORE(p + SLI_TILE, e1)
      l = tile + SLI_TILE * (ptrdiff_t)row;
      if (inner == SLI_TILE) {
        SLI_PAIR_TILE(SLV_SWEEP(tile_forward), l, p)
      } else {
        for (k = 0; k < inner; k++, l += SLI_TILE) {
          SLI_PAIR_AXPY(e, l, p + 2 * k)
          SLV_STORE(p, e0)
          SLV_STORE(p + SLI_TILE, e1)
        }
      }
      tile += SLI_TILE * (ptrdiff_t)sli_min(w, row + SLI_TILE);
    }
    memcpy(xs, buf + 2 * (ptrdiff_t)first, columns * sizeof(double));
    for (i = 0; i < s->below; i++) {
      double *to = x + 2 * (ptrdiff_t)rows[i];
      to[0] += buf[2 * (ptrdiff_t)(w + i)];
      to[1] += buf[2 * (ptrdiff_t)(w + i) + 1];
    }
    rows += s->below;
  }
}

#define SLI_PAIR_DOT(a, l) \
  SLV_DUP_LOW(t0, l) \
  SLV_DUP_HIGH(t1, l) \
  SLV_FNMA(a, t0, v0) \
  SLV_FNMA(a, t1, v1)

SLV_FUNCTION static void SLV_SWEEP(backward2)(sl_int count, const sli_step *s,
                        const sl_int *rows_end, const void *values,
                        const double *D, double *x, double *buf) {
  const SLV_VALUE *L = (const SLV_VALUE *)values;
  for (s += count; count > 0; count--) {
    const sl_int w = (--s)->width, height = w + s->below, first = SLI_TILE * s->first_tile;
    const sl_int padded = SLI_TILE * sli_tiles(height);
    const SLV_VALUE *tile = L + s->panel + sli_panel_size(w, s->below);
    const double *d = D + s->column - first;
    double *xs = x + 2 * ((ptrdiff_t)s->base - first), *sums = buf + 2 * (ptrdiff_t)padded;
    sl_int row, i, j, k;
    SLV_DECLARE(a)
    SLV_DECLARE(v0)
    SLV_DECLARE(v1)
    SLV_DECLARE(t0)
    SLV_DECLARE(t1)
    SLV_ZERO(a)
    rows_end -= s->below;
    for (i = first; i < w; i++) {
      SLV_STORE(sums + SLI_TILE * (ptrdiff_t)i, a)
      buf[2 * i] = buf[2 * i + 1] = 0.0;
    }
    for (i = 0; i < s->below; i++) {
      buf[2 * (w + i)] = x[2 * (ptrdiff_t)rows_end[i]];
      buf[2 * (w + i) + 1] = x[2 * (ptrdiff_t)rows_end[i] + 1];
    }
    memset(buf + 2 * (ptrdiff_t)height, 0, 2 * (size_t)(padded - height) * sizeof(double));
    for (row = padded - SLI_TILE; row >= first; row -= SLI_TILE) {
      const sl_int inner = sli_clamp(w - row, SLI_TILE);
      double *p = buf + 2 * (ptrdiff_t)row;
      const SLV_VALUE *l;
      tile -= SLI_TILE * (ptrdiff_t)sli_min(w, row + SLI_TILE);
      l = tile + SLI_TILE * (ptrdiff_t)row;
      SLV_LOAD(v0, p)
      SLV_LOAD(v1, p + SLI_TILE)
      for (k = 0; k < inner; k++) {
        double part[SLI_TILE];
        SLV_LOAD(a, sums + SLI_TILE * (ptrdiff_t)(row + k))
        if (inner < SLI_TILE) {
          SLI_PAIR_DOT(a, l + SLI_TILE * k)
        }
        SLV_STORE_ANY(part, a)
        for (j = 0; j < 2; j++) {
          p[2 * k + j] = xs[2 * (ptrdiff_t)(row + k) + j] / d[row + k] +
                   ((part[j] + part[2 + j]) + (part[4 + j] + part[6 + j]));
        }
      }
      if (inner == SLI_TILE) {
        SLI_PAIR_TILE(SLV_SWEEP(tile_backward), l, p)
      } else {
        for (k = inner - 1; k > 0; k--) {
          for (j = 0; j < k; j++) {
            const double lkj = l[SLI_TILE * j + k];
            p[2 * j] = SLV_FNMA1(lkj, p[2 * k], p[2 * j]);
            p[2 * j + 1] = SLV_FNMA1(lkj, p[2 * k + 1], p[2 * j + 1]);
          }
        }
      }
      SLV_LOAD(v0, p)
      SLV_LOAD(v1, p + SLI_TILE)
      l = tile + SLI_TILE * (ptrdiff_t)sli_min(row, w);
      for (j = sli_min(row, w) - 1; j >= first; j--) {
        l -= SLI_TILE;
        SLV_LOAD(a, sums + SLI_TILE * (ptrdiff_t)j)
        SLI_PAIR_DOT(a, l)
        SLV_STORE(sums + SLI_TILE * (ptrdiff_t)j, a)
      }
    }
    memcpy(xs + 2 * (ptrdiff_t)first, buf + 2 * (ptrdiff_t)first,
         2 * (size_t)(w - first) * sizeof(double));
  }
}

#undef SLI_PAIR_AXPY
#undef SLI_PAIR_TILE
#undef SLI_PAIR_DOT
/* end of two_rhs.inl.h */
#endif
/* src/impl/kernels/small_supernode.inl.h: one right-hand side through a supernode of at most 8 columns */

#define SLI_DECLARE(k, y) SLV_DECLARE(y##k)
#define SLI_SUM_DECLARE(k, a) SLV_SUM_DECLARE(a##k)
#define SLI_SUM_ZERO(k, a) SLV_SUM_ZERO(a##k)

#define SLI_COLUMN(k, unused) \
  if ((k) < w) { \
    SLV_PREFETCH(l, k, SLI_PREFETCH_DISTANCE) \
    SLV_LANE(y##k, a, k) \
    SLV_DOT(a, l + SLI_TILE * (k), y##k) \
  }
#define SLI_EVEN_ODD(k, unused) \
  if ((k) < w) { \
    SLV_PREFETCH(l, k, SLI_PREFETCH_DISTANCE) \
    if ((k) % 2 == 0) { \
      SLV_DOT(a, l + SLI_TILE * (k), y##k) \
    } else { \
      SLV_DOT(b, l + SLI_TILE * (k), y##k) \
    } \
  }

SLV_FUNCTION SLI_ALWAYS_INLINE void SLV_SWEEP(small_forward)(const sl_int w, sl_int below,
                               const sl_int *rows, const SLV_VALUE *l,
                               double *xs, double *x, double *buf) {
  sl_int row, i;
  SLV_DECLARE(a)
  SLV_DECLARE(b)
  SLI_EACH8(SLI_DECLARE, y)
  SLV_LOAD_PART(a, xs, w, 0.0)
  SLI_EACH8(SLI_COLUMN, 0)
  SLV_STORE(buf, a)
  for (i = 0; i < w; i++) {
    xs[i] = buf[i];
  }
  for (row = SLI_TILE; row < w + below; row += SLI_TILE) {
    l += SLI_TILE * w;
    SLV_ZERO(a)
    SLV_ZERO(b)
    SLI_EACH8(SLI_EVEN_ODD, 0)
    SLV_ADD(a, b)
    SLV_STORE(buf + row, a)
  }
  buf += w;
  for (i = 0; i + 4 <= below; i += 4) {
    x[rows[i]] += buf[i];
    x[rows[i + 1]] += buf[i + 1];
    x[rows[i + 2]] += buf[i + 2];
    x[rows[i + 3]] += buf[i + 3];
  }
  for (; i < below; i++) {
    x[rows[i]] += buf[i];
  }
}

#define SLI_DOT(k) \
  if ((k) < w) { \
    SLV_PREFETCH(l, k, -SLI_PREFETCH_DISTANCE) \
    SLV_SUM_DOT(a##k, l + SLI_TILE * (k), v) \
  }
#define SLI_DOTS \
  SLI_DOT(7) SLI_DOT(6) SLI_DOT(5) SLI_DOT(4) SLI_DOT(3) SLI_DOT(2) SLI_DOT(1) SLI_DOT(0)
#define SLI_ROW_AT(k) rows[at + (k)]
#define SLI_ROW_AT_PART(k) rows[at + sli_min(k, count - 1)]
#define SLI_ROW_AT_OWN(k) rows[sli_clamp((k)-w, at - 1)]
#define SLI_SET(k, unused) double r##k = r[k];
#define SLI_GET(k, unused) \
  if ((k) < w) { \
    xs[k] = r##k; \
  }
#define SLI_XT(j, k) \
  if ((j) < (k) && (k) < w) {  \
    r##j = SLV_FNMA1(t[SLI_TILE * (j) + (k)], r##k, r##j); \
  }
#define SLI_ROW(k) \
  SLI_XT(6, k) SLI_XT(5, k) SLI_XT(4, k) SLI_XT(3, k) SLI_XT(2, k) SLI_XT(1, k) SLI_XT(0, k)

SLV_FUNCTION SLI_ALWAYS_INLINE void SLV_SWEEP(small_backward)(const sl_int w, sl_int below,
                                const sl_int *rows,
                                const SLV_VALUE *l, const double *d,
                                double *xs, const double *x) {
  const sl_int count = (w + below) % SLI_TILE;
  sl_int row = w + below - count, at = below;
  double r[SLI_TILE];
  SLV_WIDE(t, SLI_TILE)
  SLV_DECLARE(v)
  SLV_DECLARE(z)
  SLI_EACH8(SLI_SUM_DECLARE, a)
  SLI_EACH8(SLI_SUM_ZERO, a)
  if (row > 0 && count > 0) {
    at -= count;
    l -= SLI_TILE * w;
    SLV_GATHER(v, x, SLI_ROW_AT_PART)
    SLV_FIRST(v, count)
    SLI_DOTS
  }
  for (; row > SLI_TILE; row -= SLI_TILE) {
    at -= SLI_TILE;
    l -= SLI_TILE * w;
    SLV_GATHER(v, x, SLI_ROW_AT)
    SLI_DOTS
  }
  l -= SLI_TILE * w;
  if (w < SLI_TILE && at > 0) {
    SLV_GATHER(v, x, SLI_ROW_AT_OWN)
    SLV_FIRST(v, w + at)
    SLV_BELOW(v, w - 1)
    SLI_DOTS
  }
  SLV_WIDEN(t, l, w, SLI_TILE)
  SLV_LOAD_PART(z, xs, w, 0.0)
  SLV_LOAD_PART(v, d, w, 1.0)
  SLV_DIVIDE(z, z, v)
  SLV_SUMS(v, a)
  SLV_ADD(v, z)
  SLV_STORE_ANY(r, v)
  SLI_EACH8(SLI_SET, 0)
  SLI_ROW(7)
  SLI_ROW(6)
  SLI_ROW(5)
  SLI_ROW(4)
  SLI_ROW(3)
  SLI_ROW(2)
  SLI_ROW(1)
  SLI_EACH8(SLI_GET, 0)
}

#define SLI_FORWARD(k) SLV_SWEEP(small_forward)(k, below, rows, l, xs, x, buf)
#define SLI_BACKWARD(k) SLV_SWEEP(small_backward)(k, below, rows, l, d, xs, x)

SLV_FUNCTION SLI_INLINE void SLV_SWEEP(forward_small)(sl_int w, sl_int below, const sl_int *rows,
                            const SLV_VALUE *l, double *xs, double *x,
                            double *buf) {
  SLI_CASES(SLI_FORWARD);
}

SLV_FUNCTION SLI_INLINE void SLV_SWEEP(backward_small)(sl_int w, sl_int below, const sl_int *rows,
                             const SLV_VALUE *l, const double *d,
                             double *xs, const double *x) {
  SLI_CASES(SLI_BACKWARD);
}

#undef SLI_DECLARE
#undef SLI_SUM_DECLARE
#undef SLI_SUM_ZERO
#undef SLI_COLUMN
#undef SLI_EVEN_ODD
#undef SLI_DOT
#undef SLI_DOTS
#undef SLI_ROW_AT
#undef SLI_ROW_AT_PART
#undef SLI_ROW_AT_OWN
#undef SLI_SET
#undef SLI_GET
#undef SLI_XT
#undef SLI_ROW
#undef SLI_FORWARD
#undef SLI_BACKWARD
/* end of small_supernode.inl.h */
/* src/impl/kernels/single_rhs.inl.h: sweeps for one right-hand side, vectorized over the 8 rows of a tile */

SLV_FUNCTION SLI_INLINE void SLV_SWEEP(panel_forward)(const SLV_VALUE *tile, sl_int t0,
                            sl_int width, sl_int columns, sl_int rows,
                            double *buf) {
  const sl_int first = SLI_TILE * t0;
  sl_int t, j, k;
  for (t = t0; SLI_TILE * t < rows; t++) {
    const sl_int row = SLI_TILE * t, final = sli_min(row, columns);
    const sl_int inner = sli_clamp(columns - row, SLI_TILE);
    SLV_DECLARE(a0)
    SLV_DECLARE(a1)
    SLV_DECLARE(a2)
    SLV_DECLARE(a3)
    SLV_LOAD(a0, buf + row)
    SLV_ZERO(a1)
    SLV_ZERO(a2)
    SLV_ZERO(a3)
    for (j = first; j + 4 <= final; j += 4) {
      const SLV_VALUE *l = tile + SLI_TILE * j;
      SLV_AXPY(a0, l, buf + j)
      SLV_AXPY(a1, l + 8, buf + j + 1)
      SLV_AXPY(a2, l + 16, buf + j + 2)
      SLV_AXPY(a3, l + 24, buf + j + 3)
    }
    for (; j < final; j++) {
      SLV_AXPY(a0, tile + SLI_TILE * j, buf + j)
    }
    SLV_ADD(a0, a1)
    SLV_ADD(a2, a3)
    SLV_ADD(a0, a2)
    SLV_STORE(buf + row, a0)
    if (inner == SLI_TILE) {
      SLV_SWEEP(tile_forward)(tile + SLI_TILE * row, buf + row);
    } else {
      for (k = 0; k < inner; k++) {
        SLV_AXPY(a0, tile + SLI_TILE * (row + k), buf + row + k)
        SLV_STORE(buf + row, a0)
      }
    }
    tile += SLI_TILE * sli_min(width, row + SLI_TILE);
  }
}

SLV_FUNCTION static void SLV_SWEEP(forward)(sl_int count, const sli_step *s, const sl_int *rows,
                      const void *values, double *x, double *buf) {
  const SLV_VALUE *L = (const SLV_VALUE *)values;
  for (; count > 0; count--, s++) {
    const sl_int w = s->width, height = w + s->below, first = SLI_TILE * s->first_tile;
    const SLV_VALUE *tile = L + s->panel + sli_tile_offset(w, s->first_tile);
    double *xs = x + s->base;
    sl_int i;
    if (w <= SLI_TILE) {
      SLV_SWEEP(forward_small)(w, s->below, rows, tile, xs, x, buf);
      rows += s->below;
      continue;
    }
    memcpy(buf + first, xs, (size_t)(w - first) * sizeof(double));
    for (i = w; i < SLI_TILE * sli_tiles(height); i++) {
      buf[i] = 0.0;
    }
    SLV_SWEEP(panel_forward)(tile, s->first_tile, w, w, height, buf);
    memcpy(xs, buf + first, (size_t)(w - first) * sizeof(double));
    for (i = 0; i < s->below; i++) {
      x[rows[i]] += buf[w + i];
    }
    rows += s->below;
  }
}

#define SLI_DECLARE(k, a) SLV_DECLARE(a##k)
#define SLI_SUM_DECLARE(k, a) SLV_SUM_DECLARE(a##k)
#define SLI_ROW_AT(k) rows[at + (k)]
#define SLI_ROW_AT_PART(k) rows[at + sli_clamp((k)-inner, part - 1)]

SLV_FUNCTION SLI_INLINE void SLV_SWEEP(dots1)(const SLV_VALUE *l, const double *x, sl_int first,
                        sl_int final, double *sums) {
  ptrdiff_t j;
  SLV_DECLARE(v)
  SLV_SUM_DECLARE(a)
  SLV_LOAD(v, x)
  for (j = SLI_TILE * ((ptrdiff_t) final - 1); j >= SLI_TILE * (ptrdiff_t)first; j -= SLI_TILE) {
    SLI_PREFETCH(l + j, -SLI_PREFETCH_DISTANCE);
    SLV_SUM_LOAD(a, sums + j)
    SLV_SUM_DOT(a, l + j, v)
    SLV_SUM_STORE(sums + j, a)
  }
}

SLV_FUNCTION SLI_INLINE void SLV_SWEEP(dots2)(const SLV_VALUE *l0, const SLV_VALUE *l1,
                        const double *x, sl_int first, sl_int final,
                        double *sums) {
  ptrdiff_t j;
  SLV_DECLARE(v0)
  SLV_DECLARE(v1)
  SLV_SUM_DECLARE(a)
  SLV_LOAD(v0, x)
  SLV_LOAD(v1, x + SLI_TILE)
  for (j = SLI_TILE * ((ptrdiff_t) final - 1); j >= SLI_TILE * (ptrdiff_t)first; j -= SLI_TILE) {
    SLV_SUM_LOAD(a, sums + j)
    SLV_SUM_DOT(a, l1 + j, v1)
    SLV_SUM_DOT(a, l0 + j, v0)
    SLV_SUM_STORE(sums + j, a)
  }
}

#define SLI_TAKE_SUM(k, unused) \
  if ((k) < inner) { \
    SLV_SUM_LOAD(a##k, sums + SLI_TILE * (k)) \
    if (inner < SLI_TILE) { \
      SLV_SUM_DOT(a##k, l + SLI_TILE * (k), v) \
    } \
  } else { \
    SLV_SUM_ZERO(a##k) \
  }
SLV_FUNCTION SLI_INLINE void SLV_SWEEP(diagonal)(const SLV_VALUE *l, sl_int inner,
                         const double *sums, const double *d, double *xs,
                         double *buf) {
  double r[SLI_TILE];
  sl_int j, k;
  SLV_DECLARE(v)
  SLV_DECLARE(z)
  SLI_EACH8(SLI_SUM_DECLARE, a)
  SLV_ZERO(v)
  if (inner < SLI_TILE) {
    SLV_LOAD(v, buf)
  }
  SLI_EACH8(SLI_TAKE_SUM, 0)
  SLV_LOAD_PART(z, xs, inner, 0.0)
  SLV_LOAD_PART(v, d, inner, 1.0)
  SLV_DIVIDE(z, z, v)
  SLV_SUMS(v, a)
  SLV_ADD(v, z)
  SLV_STORE_ANY(r, v)
  if (inner == SLI_TILE) {
    SLV_SWEEP(tile_backward)(l, r);
  } else {
    for (k = inner - 1; k > 0; k--) {
      for (j = 0; j < k; j++) {
        r[j] = SLV_FNMA1(l[SLI_TILE * j + k], r[k], r[j]);
      }
    }
  }
  for (k = 0; k < inner; k++) {
    xs[k] = buf[k] = r[k];
  }
}

#define SLI_FEW_STEPS 4096

SLV_FUNCTION static void SLV_SWEEP(backward)(sl_int count, const sli_step *s,
                       const sl_int *rows_end, const void *values,
                       const double *D, double *x, double *buf) {
  const SLV_VALUE *L = (const SLV_VALUE *)values;
  const int by_two = count <= SLI_FEW_STEPS;
  for (s += count; count > 0; count--) {
    const sl_int w = (--s)->width, height = w + s->below, first = SLI_TILE * s->first_tile;
    const SLV_VALUE *tile = L + s->panel + sli_panel_size(w, s->below);
    const double *d = D + s->column - first;
    double *xs = x + s->base - first, *sums = buf + 2 * SLI_TILE;
    const sl_int *rows = rows_end -= s->below;
    sl_int row = SLI_TILE * (sli_tiles(height) - 1), j;
    SLV_DECLARE(v)
    SLV_SUM_DECLARE(a)
    if (w <= SLI_TILE) {
      SLV_SWEEP(backward_small)(w, s->below, rows, tile, d, xs, x);
      continue;
    }
    SLV_SUM_ZERO(a)
    for (j = first; j < w; j++) {
      SLV_SUM_STORE(sums + SLI_TILE * (ptrdiff_t)j, a)
    }
    for (; row >= first; row -= SLI_TILE) {
      const sl_int inner = sli_clamp(w - row, SLI_TILE), final = sli_min(row, w);
      const sl_int at = row + inner - w, part = sli_min(height - row, SLI_TILE) - inner;
      const SLV_VALUE *above;
      tile -= SLI_TILE * (ptrdiff_t)sli_min(w, row + SLI_TILE);
      above = tile - SLI_TILE * (ptrdiff_t) final;
      if (part == SLI_TILE) {
        SLV_GATHER(v, x, SLI_ROW_AT)
        SLV_STORE(buf + SLI_TILE, v)
      } else if (inner < SLI_TILE) {
        SLV_ZERO(v)
        if (part > 0) {
          SLV_GATHER(v, x, SLI_ROW_AT_PART)
          SLV_FIRST(v, inner + part)
        }
        SLV_STORE(buf + SLI_TILE, v)
        for (j = 0; j < inner; j++) {
          buf[SLI_TILE + j] = 0.0;
        }
      }
      if (inner > 0) {
        SLV_SWEEP(diagonal)
        (tile + SLI_TILE * (ptrdiff_t)row, inner, sums + SLI_TILE * (ptrdiff_t)row, d + row,
         xs + row, buf + SLI_TILE);
      }
      if (!by_two || row == first || (inner == 0 && row - SLI_TILE < w)) {
        SLV_SWEEP(dots1)(tile, buf + SLI_TILE, first, final, sums);
        continue;
      }
      row -= SLI_TILE;
      if (inner == 0) {
        rows -= SLI_TILE;
        SLV_GATHER(v, x, SLI_ROW_AT)
        rows += SLI_TILE;
        SLV_STORE(buf, v)
        SLV_SWEEP(dots2)(above, tile, buf, first, w, sums);
      } else {
        SLV_SWEEP(dots1)(tile, buf + SLI_TILE, row, final, sums);
        SLV_SWEEP(diagonal)
        (above + SLI_TILE * (ptrdiff_t)row, SLI_TILE, sums + SLI_TILE * (ptrdiff_t)row,
         d + row, xs + row, buf);
        SLV_SWEEP(dots2)(above, tile, buf, first, row, sums);
      }
      tile = above;
    }
  }
}

#undef SLI_DECLARE
#undef SLI_SUM_DECLARE
#undef SLI_ROW_AT
#undef SLI_ROW_AT_PART
#undef SLI_TAKE_SUM
#undef SLI_FEW_STEPS
/* end of single_rhs.inl.h */

#if SLV_SINGLE
#undef SLV_SINGLE
#define SLV_SINGLE 0
#else
#undef SLV_SINGLE
#define SLV_SINGLE 1
#endif
#endif

#ifdef SLI_SECTION_KERNEL_SET
#undef SLI_SECTION_KERNEL_SET
#if SL_VERSION_MAJOR != 0 || \
     SL_VERSION_MINOR != 1 || \
     SL_VERSION_PATCH != 0
#error "sparse_local.h: SL_HEADER names another version of the header"
#endif
/* src/impl/kernels/kernel_set.inl.h: all kernels of one instruction set except its sweeps, and their table */

/* src/impl/kernels/product.inl.h: C -= A D B' on tiles, the inner loop of the factorization */

#define SLI_DECLARE(k, t) SLV_DECLARE(c##t##k)
#define SLI_LOAD(k, t) \
  if ((k) < columns) { \
    SLV_LOAD(c##t##k, C##t + SLI_TILE * (k)) \
  } else { \
    SLV_ZERO(c##t##k) \
  }
#define SLI_STORE(k, t) \
  if ((k) < columns) { \
    SLV_STORE(C##t + SLI_TILE * (k), c##t##k) \
  }
#define SLI_UPDATE(k, unused)  \
  SLV_BROADCAST(b, B + (k)) \
  SLV_FNMA(c0##k, a0, b)
#define SLI_UPDATE2(k, unused) \
  SLI_UPDATE(k, unused) \
  SLV_FNMA(c1##k, a1, b)

SLV_FUNCTION SLI_INLINE void SLV_NAME(block1)(const double *A, const double *B, sl_int length,
                        double *C0, sl_int columns) {
  sl_int j;
  SLV_DECLARE(a0)
  SLV_DECLARE(b)
  SLV_EACH_COLUMN(SLI_DECLARE, 0)
  SLV_EACH_COLUMN(SLI_LOAD, 0)
  for (j = 0; j < length; j++, A += SLI_TILE, B += SLI_TILE) {
    SLV_LOAD_PINNED(a0, A)
    SLV_EACH_COLUMN(SLI_UPDATE, 0)
  }
  SLV_EACH_COLUMN(SLI_STORE, 0)
}

#if SLV_TILES == 2
SLV_FUNCTION SLI_INLINE void SLV_NAME(block2)(const double *A, const double *A1, const double *B,
                        sl_int length, double *C0, double *C1,
                        sl_int columns) {
  sl_int j;
  SLV_DECLARE(a0)
  SLV_DECLARE(a1)
  SLV_DECLARE(b)
  SLV_EACH_COLUMN(SLI_DECLARE, 0)
  SLV_EACH_COLUMN(SLI_DECLARE, 1)
  SLV_EACH_COLUMN(SLI_LOAD, 0)
  SLV_EACH_COLUMN(SLI_LOAD, 1)
  for (j = 0; j < length; j++, A += SLI_TILE, A1 += SLI_TILE, B += SLI_TILE) {
    SLV_LOAD_PINNED(a0, A)
    SLV_LOAD_PINNED(a1, A1)
    SLV_EACH_COLUMN(SLI_UPDATE2, 0)
  }
  SLV_EACH_COLUMN(SLI_STORE, 0)
  SLV_EACH_COLUMN(SLI_STORE, 1)
}
#endif

#undef SLI_DECLARE
#undef SLI_LOAD
#undef SLI_STORE
#undef SLI_UPDATE
#undef SLI_UPDATE2

SLV_FUNCTION SLI_INLINE void SLV_NAME(pack)(const double *l, const double *d, sl_int length,
                      double *B) {
  sl_int j;
  SLV_DECLARE(a)
  SLV_DECLARE(b)
  for (j = 0; j < length; j++) {
    SLV_LOAD(a, l + SLI_TILE * (ptrdiff_t)j)
    SLV_BROADCAST(b, d + j)
    SLV_MULTIPLY(a, a, b)
    SLV_STORE(B + SLI_TILE * (ptrdiff_t)j, a)
  }
}

SLV_FUNCTION static void SLV_NAME(product)(const double *panel, sl_int w, const double *D,
                       const double *E, sl_int t0, sl_int t1, sl_int c0,
                       sl_int c1, sl_int j0, sl_int j1, double *target,
                       sl_int target_width, sl_int target_first, double *B) {
  const sl_int tile_size = SLI_TILE * SLI_TILE;
  sl_int j, t, c, k;
  for (j = j0; j < j1; j += SLI_CHUNK_COLUMNS) {
    const sl_int length = sli_min(SLI_CHUNK_COLUMNS, j1 - j);
    for (c = c0; c < c1; c++) {
      SLV_NAME(pack)
      (panel + sli_tile_offset(w, c) + SLI_TILE * (ptrdiff_t)j, D + j, length,
       B + (ptrdiff_t)(c - c0) * SLI_TILE * length);
      if (E != NULL) {
        sli_pair_pack(panel + sli_tile_offset(w, c) + SLI_TILE * (ptrdiff_t)j, E + j,
                length, B + (ptrdiff_t)(c - c0) * SLI_TILE * length);
      }
    }
    for (t = t0; t < t1; t++) {
      const double *A = panel + sli_tile_offset(w, t) + SLI_TILE * (ptrdiff_t)j;
      double *C = target + sli_tile_offset(target_width, t - target_first);
#if SLV_TILES == 2
      const int is_pair = t + 1 < t1;
      const double *A1 =
        is_pair ? panel + sli_tile_offset(w, t + 1) + SLI_TILE * (ptrdiff_t)j : A;
      double *C1 = is_pair ? target + sli_tile_offset(target_width, t + 1 - target_first) : C;
#endif
      for (c = c0; c < c1 && c <= t; c++) {
        const ptrdiff_t at = (ptrdiff_t)tile_size * (c - target_first);
        const double *b = B + (ptrdiff_t)(c - c0) * SLI_TILE * length;
        const sl_int columns = target_width - SLI_TILE * (c - target_first);
#if SLV_TILES == 2
        if (is_pair) {
          SLV_NAME(block2)(A, A1, b, length, C + at, C1 + at, columns);
          continue;
        }
#endif
        for (k = 0; k < SLI_TILE && k < columns; k += SLV_COLUMNS) {
          SLV_NAME(block1)(A, b + k, length, C + at + SLI_TILE * k, columns - k);
        }
      }
#if SLV_TILES == 2
      t += is_pair;
      if (is_pair && c == t && c < c1) {
        const ptrdiff_t at = (ptrdiff_t)tile_size * (c - target_first);
        SLV_NAME(block1)
        (A1, B + (ptrdiff_t)(c - c0) * SLI_TILE * length, length, C1 + at,
         target_width - SLI_TILE * (c - target_first));
      }
#endif
    }
  }
}
/* end of product.inl.h */
/* src/impl/kernels/front.inl.h: factors the panel of a front, computes its update matrix, assembles a front */

#define SLI_SCALE(l, x, k) \
  if (by_reciprocal) { \
    SLV_BROADCAST(b, reciprocal + (k)) \
    SLV_MULTIPLY(l, x, b) \
  } else { \
    SLV_BROADCAST(b, D + (k)) \
    SLV_DIVIDE(l, x, b) \
  }

#define SLI_GAIN(l, x, k) \
  SLV_BROADCAST(b, minus_sign + (k)) \
  SLV_MULTIPLY(b, l, b) \
  SLV_FNMA(m, b, x)

#define SLI_DECLARE(k, unused) SLV_DECLARE(a##k)
#define SLI_LOAD(k, p) \
  if ((k) < columns) { \
    SLV_LOAD(a##k, (p) + SLI_TILE * (k)) \
  } else { \
    SLV_ZERO(a##k) \
  }

#define SLI_AFTER(i, k) \
  if ((i) > (k)) { \
    SLV_BROADCAST(b, x + SLI_TILE * (k) + (i)) \
    SLV_FNMA(a##i, l, b) \
  }
#define SLI_PIVOT(k, p) \
  if ((k) < columns) { \
    double d; \
    SLV_STORE(x + SLI_TILE * (k), a##k) \
    SLV_STORE(sums, m) \
    SLV_LANE(b, a##k, k) \
    d = x[SLI_TILE * (k) + (k)]; \
    if (rule != NULL) { \
      d = sli_pivot_by_rule(rule, column + (k), d, sums[k]); \
      SLV_BROADCAST(b, &d) \
    } \
    SLV_DIVIDE(l, a##k, b) \
    D[k] = d; \
    magnitude[k] = sums[k]; \
    minus_sign[k] = d < 0.0 ? 1.0 : -1.0; \
    reciprocal[k] = 1.0 / d; \
    safe &= fabs(d) > 1e-290 && fabs(d) < 1e290; \
    SLI_GAIN(l, a##k, k) \
    SLV_BELOW(l, k) \
    SLV_STORE((p) + SLI_TILE * (k), l) \
    SLI_EACH8_AGAIN(SLI_AFTER, k) \
  }

#define SLI_BEFORE(j, k) \
  if ((j) < (k)) { \
    SLV_BROADCAST(b, p + SLI_TILE * (j) + (k)) \
    SLV_FNMA(a##k, a##j, b) \
  }
#define SLI_SOLVE(k, q) \
  if ((k) < columns) { \
    SLI_EACH8_AGAIN(SLI_BEFORE, k) \
    SLI_SCALE(l, a##k, k) \
    SLI_GAIN(l, a##k, k) \
    SLV_STORE((q) + SLI_TILE * (k), l) \
  }

SLV_FUNCTION static void SLV_NAME(tile_pivots)(const sli_front *f, sl_int c, double *reciprocals) {
  const sl_int first = SLI_TILE * c, columns = sli_min(SLI_TILE, f->width - first);
  const sl_int column = f->column + first;
  const sli_pivot_rule *rule = f->rule->replaces ? f->rule : NULL;
  double *p = f->panel + sli_tile_offset(f->width, c) + SLI_TILE * (ptrdiff_t)first;
  double *D = f->D + first, *magnitude = f->magnitude + first;
  double *reciprocal = reciprocals, *minus_sign = reciprocals + SLI_TILE;
  SLI_ALIGNED(double x[SLI_TILE * SLI_TILE + SLI_TILE]);
  double *sums = x + SLI_TILE * SLI_TILE;
  int safe = 1;
  sl_int t;
  SLV_DECLARE(b)
  SLV_DECLARE(l)
  SLV_DECLARE(m)
  SLI_EACH8(SLI_DECLARE, 0)
  SLV_LOAD(m, magnitude)
  SLI_EACH8(SLI_LOAD, p)
  SLI_EACH8(SLI_PIVOT, p)
  SLV_STORE(sums, m)
  for (t = columns; t < SLI_TILE; t++) {
    magnitude[t] = sums[t];
  }
  if (!safe) {
    reciprocal[0] = 0.0;
  }
}

SLV_FUNCTION static void SLV_NAME(tile_rows)(const sli_front *f, sl_int c, sl_int t0, sl_int t1,
                       const double *reciprocals) {
  const sl_int w = f->width, first = SLI_TILE * c, columns = sli_min(SLI_TILE, w - first);
  const double *p = f->panel + sli_tile_offset(w, c) + SLI_TILE * (ptrdiff_t)first;
  const int has_pairs = sli_tile_has_pairs(f, c);
  const double *D = has_pairs ? reciprocals + 2 * SLI_TILE : f->D + first;
  const double *reciprocal = reciprocals, *minus_sign = reciprocals + SLI_TILE;
  const int by_reciprocal = reciprocal[0] != 0.0;
  sl_int t;
  for (t = t0; t < t1; t++) {
    double *q = f->panel + sli_tile_offset(w, t) + SLI_TILE * (ptrdiff_t)first;
    double *magnitude = f->magnitude + SLI_TILE * (ptrdiff_t)t;
    SLV_DECLARE(b)
    SLV_DECLARE(l)
    SLV_DECLARE(m)
    SLI_EACH8(SLI_DECLARE, 0)
    SLV_LOAD(m, magnitude)
    SLI_EACH8(SLI_LOAD, q)
    SLI_EACH8(SLI_SOLVE, q)
    SLV_STORE(magnitude, m)
  }
  if (has_pairs) {
    sli_pair_rows(f, c, t0, t1);
  }
}

#undef SLI_SCALE
#undef SLI_GAIN
#undef SLI_DECLARE
#undef SLI_LOAD
#undef SLI_AFTER
#undef SLI_PIVOT
#undef SLI_BEFORE
#undef SLI_SOLVE

SLV_FUNCTION SLI_INLINE void SLV_NAME(catch_up)(const sli_front *f, sl_int c0, sl_int c, sl_int t0,
                        sl_int t1, double *B) {
  if (c > c0) {
    SLV_NAME(product)
    (f->panel, f->width, f->D, f->E, t0, t1, c, c + 1, SLI_TILE * c0, SLI_TILE * c, f->panel,
     f->width, 0, B);
  }
}

SLV_FUNCTION static void SLV_NAME(pivots)(const sli_front *f, sl_int c0, double *B) {
  const sl_int c1 = sli_min(c0 + SLI_GROUP_TILES, sli_tiles(f->width));
  sl_int c;
  if (c0 > 0) {
    SLV_NAME(product)
    (f->panel, f->width, f->D, f->E, c0, c1, c0, c1, 0, SLI_TILE * c0, f->panel, f->width, 0,
     B);
  }
  for (c = c0; c < c1; c++) {
    double *reciprocals = f->reciprocals + 3 * SLI_TILE * (ptrdiff_t)(c - c0);
    SLV_NAME(catch_up)(f, c0, c, c, c1, B);
    if (sli_tile_has_pairs(f, c)) {
      sli_pair_tile(f, c, reciprocals);
    } else {
      SLV_NAME(tile_pivots)(f, c, reciprocals);
    }
    SLV_NAME(tile_rows)(f, c, c + 1, c1, reciprocals);
  }
}

SLV_FUNCTION static void SLV_NAME(rows)(const sli_front *f, sl_int c0, sl_int t0, sl_int t1,
                    double *B) {
  const sl_int c1 = sli_min(c0 + SLI_GROUP_TILES, sli_tiles(f->width));
  sl_int c;
  if (c0 > 0) {
    SLV_NAME(product)
    (f->panel, f->width, f->D, f->E, t0, t1, c0, c1, 0, SLI_TILE * c0, f->panel, f->width, 0,
     B);
  }
  for (c = c0; c < c1; c++) {
    SLV_NAME(catch_up)(f, c0, c, t0, t1, B);
    SLV_NAME(tile_rows)
    (f, c, t0, t1, f->reciprocals + 3 * SLI_TILE * (ptrdiff_t)(c - c0));
  }
}

SLV_FUNCTION static void SLV_NAME(update)(const sli_front *f, sl_int c0, sl_int c1, sl_int t0,
                      sl_int t1, double *B) {
  const sl_int w = f->width, last = sli_min(c1, t1);
  sl_int c;
  for (c = c0; c < last; c += SLI_GROUP_TILES) {
    SLV_NAME(product)
    (f->panel, w, f->D, f->E, sli_max(t0, c), t1, c, sli_min(c + SLI_GROUP_TILES, last), 0, w,
     f->update, SLI_TILE * (t1 - c0), c0, B);
  }
}

SLV_FUNCTION static void SLV_NAME(assemble)(const sli_front *f, const double *from, sl_int skipped,
                      const sl_int *relative, sl_int columns, sl_int first,
                      sl_int last) {
  const sl_int w = f->width, whole = w / SLI_TILE;
  sl_int row, end, i;
  for (row = first; row < last; row = end) {
    const sl_int lane = (skipped + row) % SLI_TILE, tile = relative[row] / SLI_TILE;
    const double *source = from + sli_triangle_offset((skipped + row) / SLI_TILE) +
                 SLI_TILE * (ptrdiff_t)skipped + lane;
    double *const to[2] = {f->panel, f->update};
    const ptrdiff_t at[2] = {(ptrdiff_t)sli_tile_offset(w, tile),
                 (ptrdiff_t)sli_triangle_offset(tile - whole) -
                   SLI_TILE * SLI_TILE * (ptrdiff_t)whole};
    sl_int lanes[SLI_TILE];
    unsigned mask = 0;
    for (end = row;
       end < last && end - row < SLI_TILE - lane && relative[end] / SLI_TILE == tile; end++) {
      lanes[end - row] = relative[end] % SLI_TILE;
      mask |= 1u << lanes[end - row];
    }
    {
      SLV_EXPAND(mask, lanes, end - row)
      for (i = 0; i < end && i < columns; i++) {
        const int is_below = relative[i] >= w;
        double *target = to[is_below] + (at[is_below] + SLI_TILE * (ptrdiff_t)relative[i]);
        SLV_EXPAND_ADD(target, source + SLI_TILE * (ptrdiff_t)i)
      }
    }
  }
}
/* end of front.inl.h */
/* src/impl/kernels/inverse_front.inl.h: gathers a front of the inverse from its parent and completes it */

SLV_FUNCTION SLI_INLINE void SLV_NAME(block)(const double *A, const double *B, sl_int length,
                       double *C, sl_int columns) {
  sl_int k;
  for (k = 0; k < columns; k += SLV_COLUMNS) {
    SLV_NAME(block1)(A, B + k, length, C + SLI_TILE * (ptrdiff_t)k, columns - k);
  }
}

#define SLI_STORE(k, p) \
  if ((k) < columns) { \
    SLV_STORE((p) + SLI_TILE * (k), a) \
  }

SLV_FUNCTION SLI_INLINE void SLV_NAME(clear)(double *x, sl_int columns) {
  SLV_DECLARE(a)
  SLV_ZERO(a)
  SLI_EACH8(SLI_STORE, x)
}

#undef SLI_STORE

#define SLI_OFFSET(k) offset[k]

SLV_FUNCTION static void SLV_NAME(gather)(const sli_inverse_front *f, const double *from,
                      sl_int height, const sl_int *relative, sl_int t0,
                      sl_int t1) {
  const sl_int w = f->width, u = f->below;
  sl_int t, i;
  for (t = sli_max(t0, w / SLI_TILE); t < t1 && u > 0; t++) {
    double *to = f->front + sli_square_offset(w + u, t) + SLI_TILE * (ptrdiff_t)w;
    ptrdiff_t offset[SLI_TILE];
    for (i = 0; i < SLI_TILE; i++) {
      const sl_int local = relative[sli_clamp(SLI_TILE * t + i - w, u - 1)];
      offset[i] = sli_square_offset(height, local / SLI_TILE) + local % SLI_TILE;
    }
    for (i = 0; i < u; i++) {
      const double *x = from + SLI_TILE * (ptrdiff_t)relative[i];
      SLV_DECLARE(a)
      SLV_GATHER(a, x, SLI_OFFSET)
      SLV_STORE(to + SLI_TILE * (ptrdiff_t)i, a)
    }
  }
}

#undef SLI_OFFSET

#define SLI_DECLARE(k, unused) SLV_DECLARE(a##k)
#define SLI_LOAD(k, p) SLV_LOAD(a##k, (p) + SLI_TILE * (k))
#define SLI_STORE(k, p) SLV_STORE((p) + SLI_TILE * (k), a##k)
#define SLI_BEFORE(j, k) \
  if ((j) < (k)) { \
    SLV_BROADCAST(b, l + SLI_TILE * (j) + (k)) \
    SLV_FNMA(a##k, a##j, b) \
  }
#define SLI_SOLVE(k, unused) \
  if ((k) < columns) { \
    SLI_EACH8_AGAIN(SLI_BEFORE, k) \
  }

SLV_FUNCTION SLI_INLINE void SLV_NAME(solve_triangle)(const double *l, double *x, sl_int columns) {
  SLV_DECLARE(b)
  SLI_EACH8(SLI_DECLARE, 0)
  SLI_EACH8(SLI_LOAD, x)
  SLI_EACH8(SLI_SOLVE, 0)
  SLI_EACH8(SLI_STORE, x)
}

#undef SLI_DECLARE
#undef SLI_LOAD
#undef SLI_STORE
#undef SLI_BEFORE
#undef SLI_SOLVE

SLV_FUNCTION SLI_INLINE void SLV_NAME(group_triangle)(const sli_inverse_front *f, sl_int j0,
                            sl_int c0, sl_int c1, double *scratch) {
  const sl_int m = sli_inverse_group_columns(f, j0), tiles = sli_tiles(m),
         tile_size = SLI_TILE * SLI_TILE;
  double *N = scratch + SLI_INVERSE_ROW * (ptrdiff_t)c0,
       *P = N + SLI_INVERSE_GROUP * SLI_INVERSE_ROW;
  sl_int c, t, k;
  for (c = c0; c < c1; c++, N += SLI_INVERSE_ROW, P += SLI_INVERSE_ROW) {
    for (t = c; t < tiles; t++) {
      const sl_int columns = sli_min(SLI_TILE, m - SLI_TILE * t);
      const double *l =
        f->panel + sli_tile_offset(f->width, j0 / SLI_TILE + t) + SLI_TILE * (ptrdiff_t)j0;
      double *x = N + tile_size * (ptrdiff_t)t;
      SLV_NAME(clear)(x, SLI_TILE);
      for (k = 0; k < columns && t == c; k++) {
        x[SLI_TILE * k + k] = -1.0;
      }
      if (t > c) {
        SLV_NAME(block)
        (N + tile_size * (ptrdiff_t)c, l + tile_size * (ptrdiff_t)c, SLI_TILE * (t - c), x,
         columns);
      }
      SLV_NAME(solve_triangle)(l + tile_size * (ptrdiff_t)t, x, columns);
    }
    for (k = SLI_TILE * c; k < m; k++) {
      const double minus = -f->D[j0 + k];
      SLV_DECLARE(a)
      SLV_DECLARE(b)
      SLV_LOAD(a, N + SLI_TILE * (ptrdiff_t)k)
      SLV_BROADCAST(b, &minus)
      SLV_DIVIDE(a, a, b)
      SLV_STORE(P + SLI_TILE * (ptrdiff_t)k, a)
    }
  }
}

SLV_FUNCTION SLI_INLINE void SLV_NAME(group_weights)(const sli_inverse_front *f, sl_int j0,
                           sl_int t0, sl_int t1, double *scratch) {
  const sl_int m = sli_inverse_group_columns(f, j0), tile_size = SLI_TILE * SLI_TILE;
  const ptrdiff_t stride = sli_inverse_stride(f, j0);
  const double *N = scratch;
  double *W = sli_inverse_weights(scratch) + tile_size * (ptrdiff_t)(t0 - (j0 + m) / SLI_TILE);
  sl_int c, t;
  for (c = 0; c < sli_tiles(m); c++, N += SLI_INVERSE_ROW, W += stride) {
    const ptrdiff_t first = SLI_TILE * (ptrdiff_t)(SLI_TILE * c);
    for (t = t0; t < t1; t++) {
      double *to = W + tile_size * (ptrdiff_t)(t - t0);
      SLV_NAME(clear)(to, SLI_TILE);
      SLV_NAME(block)
      (N + first, f->panel + sli_tile_offset(f->width, t) + SLI_TILE * (ptrdiff_t)j0 + first,
       m - SLI_TILE * c, to, SLI_TILE);
    }
  }
}

SLV_FUNCTION SLI_INLINE void SLV_NAME(group_product)(const sli_inverse_front *f, sl_int j0,
                           sl_int t0, sl_int t1, double *scratch) {
  const sl_int m = sli_inverse_group_columns(f, j0), h = f->width + f->below, first = j0 + m;
  const ptrdiff_t stride = sli_inverse_stride(f, j0), tile_size = SLI_TILE * SLI_TILE;
  const double *W = sli_inverse_weights(scratch) + SLI_TILE * (ptrdiff_t)(first % SLI_TILE);
  sl_int t, c, s;
  for (t = t0; t < t1; t++) {
    double *row = f->front + sli_square_offset(h, t) + SLI_TILE * (ptrdiff_t)j0;
    for (c = 0; c < sli_tiles(m); c++) {
      SLV_NAME(clear)(row + tile_size * c, m - SLI_TILE * c);
    }
  }
  for (s = first; s < h; s += SLI_CHUNK_COLUMNS) {
    const sl_int length = sli_min(SLI_CHUNK_COLUMNS, h - s);
    const double *B = W + SLI_TILE * (ptrdiff_t)(s - first);
    for (t = t0; t < t1; t++) {
      double *row = f->front + sli_square_offset(h, t);
      const double *A = row + SLI_TILE * (ptrdiff_t)s;
      double *C = row + SLI_TILE * (ptrdiff_t)j0;
#if SLV_TILES == 2
      if (t + 1 < t1) {
        const ptrdiff_t next = sli_square_offset(h, 1);
        for (c = 0; c < sli_tiles(m); c++) {
          const ptrdiff_t at = tile_size * c;
          SLV_NAME(block2)
          (A, A + next, B + c * stride, length, C + at, C + next + at, m - SLI_TILE * c);
        }
        t++;
        continue;
      }
#endif
      for (c = 0; c < sli_tiles(m); c++) {
        SLV_NAME(block)
        (A, B + c * stride, length, C + tile_size * c, sli_min(SLI_TILE, m - SLI_TILE * c));
      }
    }
  }
}

SLV_FUNCTION SLI_INLINE void SLV_NAME(merge)(double *to, const double *from, sl_int lanes,
                       sl_int first, sl_int last) {
  sl_int k, i;
  SLV_DECLARE(a)
  for (k = first; k < last; k++) {
    if (lanes == SLI_TILE) {
      SLV_LOAD(a, from + SLI_TILE * k)
      SLV_STORE(to + SLI_TILE * k, a)
      continue;
    }
    for (i = 0; i < lanes; i++) {
      to[SLI_TILE * k + i] = from[SLI_TILE * k + i];
    }
  }
}

SLV_FUNCTION SLI_INLINE void SLV_NAME(mirror)(const double *from, sl_int first, sl_int last,
                        double *to, sl_int columns) {
  if (columns == SLI_TILE && first == 0 && last == SLI_TILE) {
    SLV_TRANSPOSE(to, from)
  } else {
    SLI_ALIGNED(double x[SLI_TILE * SLI_TILE]);
    SLV_TRANSPOSE(x, from)
    SLV_NAME(merge)(to, x, columns, first, last);
  }
}

SLV_FUNCTION SLI_INLINE void SLV_NAME(group_mirror)(const sli_inverse_front *f, sl_int j0,
                          sl_int t0, sl_int t1) {
  const sl_int m = sli_inverse_group_columns(f, j0), h = f->width + f->below;
  const ptrdiff_t tile_size = SLI_TILE * SLI_TILE;
  sl_int t, c;
  for (c = 0; c < sli_tiles(m); c++) {
    const sl_int columns = sli_min(SLI_TILE, m - SLI_TILE * c);
    double *to = f->front + sli_square_offset(h, j0 / SLI_TILE + c);
    for (t = t0; t < t1; t++) {
      SLV_NAME(mirror)
      (f->front + sli_square_offset(h, t) + SLI_TILE * (ptrdiff_t)j0 + tile_size * c,
       sli_max(j0 + m - SLI_TILE * t, 0), sli_min(SLI_TILE, h - SLI_TILE * t),
       to + tile_size * t, columns);
    }
  }
}

SLV_FUNCTION SLI_INLINE void SLV_NAME(group_square)(const sli_inverse_front *f, sl_int j0,
                          sl_int t0, sl_int t1, double *scratch) {
  const sl_int m = sli_inverse_group_columns(f, j0), h = f->width + f->below, first = j0 + m;
  const sl_int tile_size = SLI_TILE * SLI_TILE;
  const ptrdiff_t stride = sli_inverse_stride(f, j0);
  const double *N = scratch, *P = N + SLI_INVERSE_GROUP * SLI_INVERSE_ROW,
         *W = sli_inverse_weights(scratch) + SLI_TILE * (ptrdiff_t)(first % SLI_TILE);
  SLI_ALIGNED(double x[SLI_TILE * SLI_TILE]);
  sl_int c, t;
  for (t = t0; t < t1; t++) {
    const sl_int rows = sli_min(SLI_TILE, m - SLI_TILE * t);
    double *row = f->front + sli_square_offset(h, j0 / SLI_TILE + t) + SLI_TILE * (ptrdiff_t)j0;
    for (c = 0; c <= t; c++) {
      const sl_int columns = sli_min(SLI_TILE, m - SLI_TILE * c);
      double *column = f->front + sli_square_offset(h, j0 / SLI_TILE + c);
      SLV_NAME(clear)(x, SLI_TILE);
      SLV_NAME(block)
      (N + SLI_INVERSE_ROW * (ptrdiff_t)t + tile_size * (ptrdiff_t)t,
       P + SLI_INVERSE_ROW * (ptrdiff_t)c + tile_size * (ptrdiff_t)t, m - SLI_TILE * t, x,
       columns);
      if (first < h) {
        SLV_NAME(block)
        (W + t * stride, column + SLI_TILE * (ptrdiff_t)first, h - first, x, columns);
      }
      SLV_NAME(merge)
      (row + tile_size * (ptrdiff_t)c, x, f->below == 0 ? SLI_TILE : rows, 0, columns);
      if (c < t) {
        SLV_NAME(mirror)
        (x, 0, rows, column + SLI_TILE * (ptrdiff_t)j0 + tile_size * (ptrdiff_t)t,
         SLI_TILE);
      }
    }
  }
}

SLV_FUNCTION static void SLV_NAME(inverse_phase)(const sli_inverse_front *f, sl_int j0,
                         sli_inverse_phase phase, sl_int t0, sl_int t1,
                         double *scratch) {
  switch (phase) {
  case SLI_INVERSE_TRIANGLE:
    SLV_NAME(group_triangle)(f, j0, t0, t1, scratch);
    break;
  case SLI_INVERSE_WEIGHTS:
    SLV_NAME(group_weights)(f, j0, t0, t1, scratch);
    break;
  case SLI_INVERSE_PRODUCT:
    SLV_NAME(group_product)(f, j0, t0, t1, scratch);
    break;
  case SLI_INVERSE_MIRROR:
    SLV_NAME(group_mirror)(f, j0, t0, t1);
    break;
  default:
    SLV_NAME(group_square)(f, j0, t0, t1, scratch);
  }
}

SLV_FUNCTION static void SLV_NAME(takahashi)(const sli_inverse_front *f, double *scratch) {
  sl_int j0;
  for (j0 = sli_inverse_last_group(f); j0 + SLI_INVERSE_COLUMNS > f->first;
     j0 -= SLI_INVERSE_COLUMNS) {
    const sli_tile_range group = sli_inverse_tiles(f, j0, SLI_INVERSE_TRIANGLE);
    const sli_tile_range below = sli_inverse_tiles(f, j0, SLI_INVERSE_WEIGHTS);
    SLV_NAME(group_triangle)(f, j0, group.first, group.last, scratch);
    if (below.first < below.last) {
      SLV_NAME(group_weights)(f, j0, below.first, below.last, scratch);
      SLV_NAME(group_product)(f, j0, below.first, below.last, scratch);
      SLV_NAME(group_mirror)(f, j0, below.first, below.last);
    }
    SLV_NAME(group_square)(f, j0, group.first, group.last, scratch);
  }
}
/* end of inverse_front.inl.h */
/* src/impl/kernels/row.inl.h: one row of L in the up-looking factorization */

SLV_FUNCTION static void SLV_NAME(row)(double *panel, sl_int w, sl_int q, const sl_int *rows,
                     const double *D, double *xs, double *x, double *buf,
                     double *pivot, double *magnitude) {
  const sl_int columns = sli_min(q, w);
  double *lq = panel + sli_panel_at(w, q, 0);
  double d = *pivot, size = *magnitude;
  sl_int i;
  for (i = 0; i < columns; i++) {
    buf[i] = lq[SLI_TILE * i] + xs[i];
    xs[i] = 0.0;
  }
  for (; i < SLI_TILE * sli_tiles(q); i++) {
    buf[i] = 0.0;
  }
  SLV_NAME(panel_forward)(panel, 0, w, columns, q, buf);
  for (i = w; i < q; i++) {
    x[rows[i - w]] += buf[i];
  }
  for (i = 0; i < columns; i++) {
    const double l = buf[i] / D[i];
    lq[SLI_TILE * i] = l;
    d = SLV_FNMA1(l, buf[i], d);
    size += fabs(l * buf[i]);
  }
  *pivot = d;
  *magnitude = size;
}
/* end of row.inl.h */
/* src/impl/kernels/change.inl.h: rank-k change of the rows of a panel, for 1, 2, 4 and 8 vectors */

#define SLI_DECLARE(r, unused) SLV_DECLARE(w##r)
#define SLI_LOAD(r, unused) SLV_LOAD(w##r, w + SLI_TILE * (r))
#define SLI_STORE(r, unused) SLV_STORE(w + SLI_TILE * (r), w##r)
#define SLI_CARRY(r, unused)  \
  SLV_BROADCAST(s, c + (r)) \
  SLV_FNMA(w##r, a, s)
#define SLI_CHANGE(r, ranks)  \
  SLV_BROADCAST(s, c + (ranks) + (r)) \
  SLV_FNMA(a, w##r, s)
#define SLI_CHANGE_KERNEL(name, ranks, each) \
  SLV_FUNCTION static void SLV_NAME(name)(double *l, sl_int columns, const double *c, \
                      double *w) { \
    sl_int j; \
    SLV_DECLARE(a) \
    SLV_DECLARE(s) \
    each(SLI_DECLARE, 0) each(SLI_LOAD, 0) \
    for (j = 0; j < columns; j++, l += SLI_TILE, c += 2 * (ranks)) { \
      SLV_LOAD_PINNED(a, l) \
      each(SLI_CARRY, 0) each(SLI_CHANGE, ranks) \
      SLV_STORE(l, a) \
    } \
    each(SLI_STORE, 0) \
  }
#define SLI_EACH1(op, k) op(0, k)
#define SLI_EACH2(op, k) op(0, k) op(1, k)

SLI_CHANGE_KERNEL(change1, 1, SLI_EACH1)
SLI_CHANGE_KERNEL(change2, 2, SLI_EACH2)
SLI_CHANGE_KERNEL(change4, 4, SLI_EACH4)
SLI_CHANGE_KERNEL(change8, 8, SLI_EACH8)
#undef SLI_CARRY
#undef SLI_CHANGE

#define SLI_CHANGE(t, unused) \
  SLV_LOAD_PINNED(a, l##t + at) \
  SLV_FNMA(w##t, a, y) \
  SLV_FNMA(a, w##t, b) \
  SLV_STORE(l##t + at, a)
SLV_FUNCTION static void SLV_NAME(change_tiles)(double *const *tiles, sl_int columns,
                        const double *c, double *w) {
  double *const l0 = tiles[0], *const l1 = tiles[1], *const l2 = tiles[2], *const l3 = tiles[3];
  ptrdiff_t at;
  SLV_DECLARE(a)
  SLV_DECLARE(y)
  SLV_DECLARE(b)
  SLI_EACH4(SLI_DECLARE, 0)
  SLI_EACH4(SLI_LOAD, 0)
  for (at = 0; at < SLI_TILE * (ptrdiff_t)columns; at += SLI_TILE, c += 2) {
    SLV_BROADCAST(y, c)
    SLV_BROADCAST(b, c + 1)
    SLI_EACH4(SLI_CHANGE, 0)
  }
  SLI_EACH4(SLI_STORE, 0)
}
#undef SLI_CHANGE
#undef SLI_CHANGE_KERNEL
#undef SLI_EACH1
#undef SLI_EACH2
#undef SLI_DECLARE
#undef SLI_LOAD
#undef SLI_STORE
/* end of change.inl.h */

#if !defined(SLV_NAME_4)
#define SLV_NAME_4(f) SLV_NAME(f##4)
#endif

static const sli_kernels SLV_NAME(kernels) = {
  SLV_ISA,
  {{{SLV_NAME(forward), SLV_NAME(forward2), SLV_NAME_4(forward), SLV_NAME(forward8)},
    {SLV_NAME(backward), SLV_NAME(backward2), SLV_NAME_4(backward), SLV_NAME(backward8)}},
   {{SLV_NAME(single_forward), SLV_NAME(single_forward2), SLV_NAME_4(single_forward),
     SLV_NAME(single_forward8)},
    {SLV_NAME(single_backward), SLV_NAME(single_backward2), SLV_NAME_4(single_backward),
     SLV_NAME(single_backward8)}}},
  SLV_NAME(row),
  SLV_NAME(pivots),
  SLV_NAME(rows),
  SLV_NAME(update),
  SLV_NAME(assemble),
  SLV_NAME(products8),
  SLV_NAME(gather),
  SLV_NAME(inverse_phase),
  SLV_NAME(takahashi),
  {SLV_NAME(change1), SLV_NAME(change2), SLV_NAME(change4), SLV_NAME(change8)},
  SLV_NAME(change_tiles)};

#undef SLV_NAME
#undef SLV_NAME_4
#undef SLV_ISA
#undef SLV_FUNCTION
#undef SLV_DECLARE
#undef SLV_ZERO
#undef SLV_LOAD
#undef SLV_STORE
#undef SLV_ADD
#undef SLV_READ_0
#undef SLV_READ_1
#undef SLV_WIDEN_ROWS
#undef SLV_AXPY
#undef SLV_DOT
#undef SLV_FNMA1
#undef SLV_STORE_ANY
#undef SLV_FNMA
#undef SLV_DUP_LOW
#undef SLV_DUP_HIGH
#undef SLV_DUP_AT
#undef SLV_PAIR
#undef SLV_TILES
#undef SLV_COLUMNS
#undef SLV_EACH_COLUMN
#undef SLV_LOAD_PINNED
#undef SLV_BROADCAST
#undef SLV_MULTIPLY
#undef SLV_DIVIDE
#undef SLV_BELOW
#undef SLV_BELOW_2
#undef SLV_EXPAND
#undef SLV_EXPAND_ADD
#undef SLV_LOAD_PART
#undef SLV_FIRST
#undef SLV_LANE
#undef SLV_GATHER
#undef SLV_TRANSPOSE
#undef SLV_TRANSPOSE_4
#undef SLV_BLOCKS_EVEN
#undef SLV_BLOCKS_ODD
#undef SLV_GATHER_2
#undef SLV_SUM_DECLARE
#undef SLV_SUM_ZERO
#undef SLV_SUM_DOT
#undef SLV_SUM_2
#undef SLV_SUM_4
#undef SLV_SUMS
#undef SLV_SUM_LOAD
#undef SLV_SUM_STORE
#undef SLW_ROWS
#undef SLW_DECLARE
#undef SLW_ZERO
#undef SLW_LOAD
#undef SLW_STORE
#undef SLW_FNMA
#undef SLW_ADD
#undef SLW_DIVIDE
#endif

/*
 * MIT License
 *
 * Copyright (c) 2026 the sparse_local.h authors
 *
 * Permission is hereby granted, free of charge, to any person obtaining a copy
 * of this software and associated documentation files (the "Software"), to deal
 * in the Software without restriction, including without limitation the rights
 * to use, copy, modify, merge, publish, distribute, sublicense, and/or sell
 * copies of the Software, and to permit persons to whom the Software is
 * furnished to do so, subject to the following conditions:
 *
 * The above copyright notice and this permission notice shall be included in all
 * copies or substantial portions of the Software.
 *
 * THE SOFTWARE IS PROVIDED "AS IS", WITHOUT WARRANTY OF ANY KIND, EXPRESS OR
 * IMPLIED, INCLUDING BUT NOT LIMITED TO THE WARRANTIES OF MERCHANTABILITY,
 * FITNESS FOR A PARTICULAR PURPOSE AND NONINFRINGEMENT. IN NO EVENT SHALL THE
 * AUTHORS OR COPYRIGHT HOLDERS BE LIABLE FOR ANY CLAIM, DAMAGES OR OTHER
 * LIABILITY, WHETHER IN AN ACTION OF CONTRACT, TORT OR OTHERWISE, ARISING FROM,
 * OUT OF OR IN CONNECTION WITH THE SOFTWARE OR THE USE OR OTHER DEALINGS IN THE
 * SOFTWARE.
 */

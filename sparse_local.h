/* sparse_local.h 0.1.0, generated: edit src/, run make header
 * FNV-1a of all that follows this comment, license aside: c2e93e9e624f66aa
 *
 * Contents
 *         (what a user reads)
 *    104  public/intro.h             what the library does, a quick start, notation, conventions, threads, references
 *    157  public/config.h            what a user may set before including the header, the version, and the integer types
 *    206  public/types.h             status codes, the matrix view, options, statistics, and the names of the opaque objects
 *    446  public/csc.h               matrices the library owns, checks, products, residuals, Matrix Market files
 *    566  public/analyse.h           the analysis of a pattern: ordering, elimination tree, supernodes, storage of L
 *    628  public/factor.h            the numbers: P A P' = L D L'
 *    766  public/solve.h             full solves, and the workspace that every solve writes to
 *    836  public/plan.h              local solves: b known on a few rows, x wanted on a few others
 *    927  public/accuracy.h          how good a solution is and how to better it: refinement, condition, what a right-hand side lacks
 *   1019  public/inverse.h           entries, blocks and bilinear forms of the inverse, without a backward sweep
 *   1113  public/batch.h             many independent solves, with one factor or with several, spread over threads by one call
 *   1157  public/several.h           several matrices of one pattern: weighted sums of value arrays over one analysis, factored and asked by one call
 *   1324  public/selected.h          the selected inverse: entries of A^-1 on the pattern of L, all of them or those that some rows reach
 *   1423  public/region.h            regions: parts of the matrix inside which local solves cost the same whatever surrounds them
 *         (bodies, in one source file)
 *         (L0 ground)
 *   1513  impl/base.h                the system headers, everything that depends on the compiler, and small integer helpers
 *   1606  impl/status.h              status codes in words, and the error fields of stats
 *   1664  impl/alloc.h               memory: 64-byte aligned blocks that cannot overflow, cut into arrays in one go
 *   1789  impl/sort.h                sorts keyed numbers: insertion for a few, radix for many
 *   1864  impl/cpu.h                 which instruction sets this processor and operating system run
 *   1901  impl/parallel.h            the same work for several workers at once: by the caller's pool, by OpenMP, or one after the other
 *         (L1 kernels: raw arrays only)
 *   1942  impl/kernels.h             the contract of the numerical kernels: panels, steps, sweeps, and the table that an ISA fills
 *   2288  impl/isa_scalar.h          the kernels in plain C: an octet is an array
 *   2426  impl/lanes_array.inl.h     a row of right-hand sides as an array, for plain C
 *   2456  impl/lanes.inl.h           2, 4 or 8 interleaved right-hand sides, SIMD along them; the words SLW_* are one row of SLW_LANES
 *   3627  impl/tile.inl.h            the 8 x 8 unit triangle of a diagonal tile, in scalars: 28 FMAs, a chain of 7
 *   3673  impl/product.inl.h         C -= A D B' on tiles, the loop that a factorization spends its time in; words SLV_*
 *   3810  impl/front.inl.h           a front of the multifrontal factorization: its panel factored, its update matrix made and handed on
 *   4027  impl/takahashi.inl.h       a front of the inverse: gathered from the parent's front, completed column group by column group
 *   4324  impl/narrow.inl.h          one right-hand side through a supernode of 1 to 8 columns, all of them in registers; words SLV_*
 *   4486  impl/body.inl.h            one right-hand side, SIMD along the 8 rows of a tile; the words SLV_* are one octet of doubles
 *   4759  impl/words_end.inl.h       takes the octet words back, for the next instruction set
 *   4810  impl/isa_avx2.h            the kernels in AVX2 and FMA: an octet is two registers
 *   4955  impl/lanes_ymm.inl.h       four right-hand sides in one 256-bit register, for AVX2 and AVX-512 alike
 *   5768  impl/pairs.inl.h           two interleaved right-hand sides, SIMD along the rows of a tile; words SLV_*, two octets a tile
 *   7081  impl/isa_avx512.h          the kernels in AVX-512: an octet is one register
 *   9288  impl/isa_neon.h            the kernels in NEON: an octet is four registers
 *  11552  impl/select.h              the kernel table for an instruction set
 *         (L2 storage)
 *  11585  impl/csc.h                 compressed columns: checks, owned matrices, triplets, transpose, which triangle is stored
 *  11896  impl/csc_products.h        what is computed with a matrix in compressed columns: products, norms, residuals
 *  12020  impl/permute.h             permutations: validity, inverse, and P A P' of a stored matrix
 *  12093  impl/sum.h                 weighted sums of symmetric matrices, whatever triangles they store
 *  12183  impl/io.h                  Matrix Market files, read and written: coordinate; real, integer, pattern; general, symmetric
 *         (L3 patterns: never see a value array)
 *  12537  impl/symbolic_types.h      the analysis object: what the pattern parts fill in and the number parts read
 *  12576  impl/graph.h               the pattern of a symmetric matrix, from whichever triangle is stored, as graph and as ordered halves
 *  12723  impl/order_metis.h         nested dissection of one connected component by METIS_NodeND
 *  12837  impl/order.h               the fill-reducing order of the rows: natural, given, or nested dissection by component
 *  12981  impl/etree.h               the elimination tree of an ordered graph, postorder, and relabelling along an order
 *  13066  impl/counts.h              entries of every column of L, in nearly O(nnz(A)), from the leaves of the row subtrees
 *  13139  impl/supernodes.h          fundamental supernodes, and their relaxed amalgamation over the whole assembly tree
 *  13305  impl/structure.h           the rows of every supernode, the places of the panels, and the map of A into L
 *  13381  impl/mapping.h             the map of A into L read backwards: the row and the column that a place stands for
 *  13411  impl/fronts.h              the tree of fronts: the children of each supernode, and where their rows stand in its front
 *  13452  impl/schedule.h            which worker factors which fronts, and where update matrices wait for the parent's front
 *  13663  impl/symbolic.h            the analysis, from the pattern of A to the places of L
 *  13949  impl/reach.h               the columns that a set of rows touches: the elimination tree's paths from them to the roots
 *         (L4 numbers)
 *  14259  impl/factor_parts.h        the factor object, and what both ways to factor share: loading a panel, taking a pivot
 *  14460  impl/spread.h              a matrix spread over the map of the analysis, entry by entry, once for any number of factorizations
 *  14629  impl/uplooking.h           the up-looking factorization: row k of L is a sparse triangular solve over the reach of row k of A
 *  14711  impl/multifrontal.h        the supernodal factorization: front by front, each handing its update matrix to its parent
 *  14959  impl/leftlooking.h         supernodes factored again by pulling from all their descendants: for changes that reach few of them
 *  15059  impl/nullspace.h           null pivots in solves: is a right-hand side consistent, and the solution that is centred by weights
 *  15401  impl/factor.h              the factor object: the method and the memory, factoring, factoring again, release
 *  15817  impl/factor_ask.h          what can be asked of a factor: statistics, the determinant, L as a matrix, a look inside
 *  15951  impl/region_parts.h        the region object, and what a sweep that ends there needs: the product with the cached inverse
 *  16072  impl/combination.h         factorizations of weighted sums of value arrays that stand in the order of the analysis
 *  16131  impl/work.h                the workspace: one block of a thread's scratch that only grows
 *  16243  impl/sweep.h               one block of right-hand sides through the forward reach, across to the backward reach, and out
 *  16562  impl/solve.h               full solves: the query in which everything is known and everything wanted
 *  16604  impl/plan.h                local solves: queries compiled from a b-set and an x-set, kept as a plan or made in the workspace
 *         (L5 on a factor)
 *  17006  impl/descent.h             the way of the inverse from the roots to the leaves, planned: which fronts, whose, and where they wait
 *  17270  impl/descent_run.h         the way of the inverse from the roots to the leaves, gone: front after front, each handed to a taker
 *  17442  impl/groups.h              unit vectors taken up to 8 at a time over one reach, as many as pay, and swept forward together
 *  17690  impl/inverse.h             bilinear forms of A^-1: forward sweeps, then sums over common columns weighted by 1/D
 *  17894  impl/inverse_entries.h     entries of A^-1 one by one: by forward sweeps, or by a descent that keeps nothing else
 *  18198  impl/inverse_block.h       dense blocks of A^-1: every row and column swept forward, then all sums between two sweeps
 *  18440  impl/refine.h              iterative refinement of full solutions, column by column, by the backward error of every row
 *  18617  impl/refine_local.h        local solves with a regularized factor: the residual E x of the rows that were regularized, solved for
 *  18807  impl/condition.h           the condition number by Hager and Higham's estimate, and what right-hand sides lack to be consistent
 *  18983  impl/batch.h               independent solves spread over workers by the entries of L that they read
 *  19200  impl/batch_factor.h        several factorizations over one analysis, whole factors shared out among workers
 *  19398  impl/batch_inverse.h       diagonals of several inverses over one analysis, whole factors shared out among workers
 *  19542  impl/selected.h            the selected inverse: the panels that a descent of a list of supernodes leaves
 *  19762  impl/selected_ask.h        what can be asked of a selected inverse: its diagonal, its entries, a look inside
 *  19862  impl/region_choose.h       which subtrees a region holds whole: those that leave the least to be read
 *  20112  impl/region.h              regions: the object, and its part of the inverse by forward sweeps or out of a selected inverse
 *         (last: takes every internal macro away again)
 *  20349  impl/leave.h               takes every internal macro away again
 */
/* ---- what a user reads ---- */
#ifndef SPARSE_LOCAL_H
#define SPARSE_LOCAL_H
/* begin src/public/intro.h */
/* intro.h: what the library does, a quick start, notation, conventions, threads, references */
#ifndef SL_PUBLIC_INTRO_H
#define SL_PUBLIC_INTRO_H

/* sparse_local.h factors a sparse symmetric matrix once, P A P' = L D L', and then answers many small questions from
 * that factor: b is nonzero at a few rows, x is wanted at a few others. The elimination tree tells which columns of L
 * can matter; the answer is the one a full solve gives, at a cost that depends on the question [HDA17].
 *
 * Quick start (in one source file; link with -lmetis -lm):
 *
 *     #define SPARSE_LOCAL_IMPLEMENTATION
 *     #include "sparse_local.h"
 *
 *     sl_csc A = {n, n, Ap, Ai, Ax};                     lower, upper or both triangles
 *     sl_symbolic *S;  sl_factor *F;  sl_plan *P;
 *     sl_symbolic_create(&S, &A, NULL, NULL);            once a pattern
 *     sl_factor_create(&F, S, &A, NULL, NULL);           once a matrix
 *     sl_factor_solve(F, x, n, b, n, 1, NULL);           full solve
 *     sl_plan_create(&P, S, bset, nb, xset, nx, NULL, NULL);
 *     sl_plan_solve(P, F, x, nx, b, nb, 1, NULL);        local solve, any number of times
 *     sl_plan_free(P);  sl_factor_free(F);  sl_symbolic_free(S);
 *
 * Notation     n rows of A; perm[k] is the row of A that is pivot k, iperm its inverse; parent is the elimination
 *              tree, -1 at a root; L is unit lower triangular in supernodal panels, D diagonal; a reach is
 *              a set of columns closed under parent.
 * Conventions  Everything that can fail returns sl_status; outputs are NULL, or untouched, on error. Options and
 *              stats may be NULL. Dense arguments are column-major with a leading dimension in elements, or row-major
 *              in the calls named interleaved. Row numbers, also those in errors, are the caller's. The library itself
 *              never prints, never aborts and has no mutable globals; what METIS does while it orders stands at
 *              sl_symbolic_create.
 * Threads      A symbolic and a plan are immutable; a factor is const while solved with. Any number of threads may
 *              solve on one factor, each with its own sl_work.
 *
 * References
 *  [HDA17]   Herholz, Davis, Alexa: Localized solutions of sparse linear systems for geometry processing, 2017.
 *  [Davis06] Davis: Direct Methods for Sparse Linear Systems, 2006.
 *  [LDL05]   Davis: Algorithm 849: a concise sparse Cholesky factorization package, 2005.
 *  [Liu90]   Liu: The role of elimination trees in sparse factorization, 1990.
 *  [GNP94]   Gilbert, Ng, Peyton: An efficient algorithm to compute row and column counts, 1994.
 *  [NP93]    Ng, Peyton: Block sparse Cholesky algorithms on advanced uniprocessor computers, 1993.
 *  [DR83]    Duff, Reid: The multifrontal solution of indefinite sparse symmetric linear equations, 1983.
 *  [Liu92]   Liu: The multifrontal method for sparse matrix solution: theory and practice, 1992.
 *  [ET75]    Erisman, Tinney: On computing certain elements of the inverse of a sparse matrix, 1975.
 *  [SelInv]  Lin, Yang, Meza, Lu, Ying, E: SelInv: selected inversion of a sparse symmetric matrix, 2011.
 *  [AG89]    Ashcraft, Grimes: The influence of relaxed supernode partitions on the multifrontal method, 1989.
 *  [Hi88]    Higham: FORTRAN codes for estimating the one-norm of a real or complex matrix, 1988.
 *  [Sk80]    Skeel: Iterative refinement implies numerical stability for Gaussian elimination, 1980.
 *  [KK98]    Karypis, Kumar: A fast and high quality multilevel scheme for partitioning irregular graphs, 1998.
 */

#endif
/* end src/public/intro.h */
/* begin src/public/config.h */
/* config.h: what a user may set before including the header, the version, and the integer types */
#ifndef SL_PUBLIC_CONFIG_H
#define SL_PUBLIC_CONFIG_H

#include <stddef.h>
#include <stdint.h>

/* Macros read by this header:
 *
 *  SPARSE_LOCAL_IMPLEMENTATION   define it in exactly one source file before the include: the bodies go there.
 *  SL_STATIC                     everything static: private copy of the library in one source file.
 *  SL_NO_METIS                   build without METIS: natural and given orderings only.
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
/* end src/public/config.h */
#ifdef __cplusplus
extern "C" {
#endif
/* begin src/public/types.h */
/* types.h: status codes, the matrix view, options, statistics, and the names of the opaque objects */
#ifndef SL_PUBLIC_TYPES_H
#define SL_PUBLIC_TYPES_H

/** What a call came to. Everything that can fail returns one; SL_OK is 0. */
typedef enum sl_status {
    SL_OK = 0,
    SL_ERR_ARGUMENT, /* NULL, negative size, leading dimension too small, index out of range or given twice */
    SL_ERR_MEMORY,  /* the allocator returned NULL */
    SL_ERR_PATTERN, /* the matrix is malformed, or both triangles are stored and differ in pattern */
    SL_ERR_PIVOT, /* a null pivot: the matrix is singular, or needs pivoting; stats name the row */
    SL_ERR_NOT_FINITE, /* a NaN or an infinity in the values, or one that arose; stats name the row */
    SL_ERR_TOO_LARGE, /* a count does not fit its type */
    SL_ERR_UNSUPPORTED, /* not compiled in, not on this processor, or a file format that is not read */
    SL_ERR_IO,       /* a file could not be opened, read, parsed or written; stats name the line */
    SL_ERR_ORDERING, /* the ordering library failed */
    SL_ERR_STATE,    /* a failed factor, or objects that do not belong together */
    SL_ERR_INCONSISTENT /* a singular system whose right-hand side has no solution */
} sl_status;

/** A name for a status, in words, static storage. Any value is accepted. */
SL_API const char *sl_status_string(sl_status status);

/** View of a sparse matrix in compressed columns: column j holds rows i[p[j]] .. i[p[j+1]-1]. Never owned or kept.
 *
 *  Rows of a column may stand in any order; duplicates are summed; explicit zeros are entries like others.
 *  A symmetric matrix may store its lower triangle, its upper triangle, or both: the pattern decides. Of a matrix
 *  that stores both, the pattern must be symmetric and the LOWER triangle's values are the ones read.
 */
typedef struct sl_csc {
    sl_int n_rows;   /* 0 .. 2^31 - 8: more is SL_ERR_TOO_LARGE wherever a matrix is checked */
    sl_int n_cols;   /* the same */
    const sl_int *p; /* n_cols + 1 positions, ascending, p[0] = 0 */
    const sl_int *i; /* p[n_cols] row indices in 0..n_rows-1 */
    const double *x; /* p[n_cols] values; NULL: pattern only (enough for sl_symbolic_create) */
} sl_csc;

/** Which entries of a symmetric matrix are stored. */
typedef enum sl_triangle {
    SL_TRIANGLE_NONE = 0, /* entries on the diagonal only, or none */
    SL_TRIANGLE_LOWER,
    SL_TRIANGLE_UPPER,
    SL_TRIANGLE_BOTH
} sl_triangle;

/** How the stored entries are meant. */
typedef enum sl_reading {
    SL_AS_SYMMETRIC = 0, /* as the factorization reads them: one triangle stands for both */
    SL_AS_STORED         /* a general matrix: every entry for itself */
} sl_reading;

typedef enum sl_ordering {
    SL_ORDERING_DEFAULT = 0, /* METIS where compiled in, else natural */
    SL_ORDERING_METIS,       /* METIS_NodeND on every connected component [KK98] */
    SL_ORDERING_GIVEN,       /* options.perm */
    SL_ORDERING_NATURAL      /* 0, 1, 2, ... */
} sl_ordering;

/** Merging of small supernodes into their parents: faster solves for a few stored zeros. */
typedef enum sl_relaxation {
    SL_RELAXATION_DEFAULT = 0, /* merge along the whole assembly tree while the zeros stay few */
    SL_RELAXATION_NONE         /* fundamental supernodes: no zero is stored */
} sl_relaxation;

/** Instruction set of the kernels. */
typedef enum sl_isa {
    SL_ISA_AUTO = 0, /* the best that this processor and operating system run */
    SL_ISA_SCALAR,
    SL_ISA_AVX2, /* AVX2 and FMA */
    SL_ISA_AVX512,
    SL_ISA_NEON
} sl_isa;

/** How to factor; both write the same L to rounding. */
typedef enum sl_method {
    SL_METHOD_AUTO = 0,   /* the faster one, by the flops per supernode */
    SL_METHOD_UP_LOOKING, /* row by row, little memory beyond L: nearly diagonal patterns, stars */
    SL_METHOD_SUPERNODAL  /* dense fronts, children before parents: everything else; threads */
} sl_method;

/** What a null pivot means. */
typedef enum sl_definiteness {
    SL_DEFINITE = 0, /* D of any sign; a null pivot is SL_ERR_PIVOT */
    SL_SEMIDEFINITE  /* a null pivot is skipped and counted, its row of x is 0: raw Laplacians */
} sl_definiteness;

/** How entries of the inverse were computed. */
typedef enum sl_inverse_method {
    SL_INVERSE_NONE = 0, /* nothing was asked for */
    SL_INVERSE_FORWARD,  /* forward sweeps of the rows asked for */
    SL_INVERSE_SELECTED  /* selected inversion on their reach */
} sl_inverse_method;

/** Runs body(data, k) for k = 0 .. count-1, at once or not, each once, and returns when all are done. */
typedef void (*sl_parallel_for)(void *context, sl_int count, void (*body)(void *data, sl_int k),
                                void *data);

/** Threads, opt-in: all zero = none. What a call computes does not depend on how many there are. */
typedef struct sl_threads {
    sl_int count; /* 0 or 1: the calling thread alone */
    sl_parallel_for
        run; /* the caller's pool; NULL: OpenMP where compiled with it, else one after the other */
    void *context; /* handed to run */
} sl_threads;

/** Memory for the objects. Both functions NULL: malloc and free, on Linux in huge pages where a block has 4 MB or more;
 *  one alone is SL_ERR_ARGUMENT. Every object keeps a copy. */
typedef struct sl_allocator {
    void *(*allocate)(void *context, size_t bytes); /* NULL on failure; aligned as malloc does */
    void (*release)(void *context, void *block);    /* block came from allocate, never NULL */
    void *context;
} sl_allocator;

/** Wishes, the same struct for every call. All zero (or a NULL pointer) = defaults. */
typedef struct sl_options {
    sl_ordering ordering;
    const sl_int
        *perm; /* n: perm[k] = row of A that is pivot k; read with SL_ORDERING_GIVEN only */
    const sl_int *
        metis_options; /* 40 entries as METIS's options array, -1 = METIS's default; NULL: all default;
                          its numbering and debug level are not read */
    sl_relaxation relaxation;
    sl_isa isa;
    sl_method method;
    sl_threads threads;
    sl_definiteness definiteness;
    double
        null_tolerance; /* a pivot d is null if |d| <= null_tolerance * (the sum of the magnitudes that made
                               it); 0: (64 + n/8) epsilon; negative: only an exact zero is null */
    sl_allocator allocator;
    const struct sl_region *
        region; /* of sl_plan_create: where its sweeps may end; borrowed, must outlive the plan; NULL: none */
    size_t
        region_bytes; /* of sl_region_create: most bytes that a region with a boundary may keep; 0: no bound */

    /* SL_SEMIDEFINITE, sl_factor_create: which of many solutions is meant, and when there is none */

    /* n weights m, copied: x has sum m x = 0 in each component with a null pivot, and b is made consistent by a
     * multiple of m; NULL: x is 0 in the null rows */
    const double *mass;
    /* without mass a solve refuses b where |z' b| > consistency_tolerance * (sum of |b|) for a null vector z that is
     * 1 in its null row; 0: 1e-6, which lets pass what single precision loses; negative: nothing is refused */
    double consistency_tolerance;

    /* SL_DEFINITE, sl_factor_create: signed regularization */

    /* a null pivot d, or one of the wrong sign, becomes sign * max(|d|, regularization * the sum of the magnitudes
     * that made it, 1 where that is 0); 1e-8 suits refinement; 0: none */
    double regularization;
    /* n: the sign that each row's pivot should have, 1 or -1, or 0: either will do; copied; NULL: all 1 */
    const sl_int *signs;
} sl_options;

/** What happened, in numbers. A call fills its own group and the error fields, and leaves the other groups, so
 *  that one struct may travel through all of them. Row and column numbers are the caller's own. */
typedef struct sl_stats {
    /* the error; -1 where it does not apply */
    sl_int error_row;
    sl_int error_column;
    sl_off error_line;  /* of a file, 1-based */
    double error_value; /* the pivot or entry that was refused; 0 where none */

    /* sl_symbolic_create */
    sl_int n;
    sl_triangle triangle;
    sl_off nnz_a; /* entries of A that are read (one triangle with diagonal, duplicates counted) */
    sl_off nnz_l; /* entries of L with its unit diagonal, without relaxation */
    sl_off nnz_panels; /* doubles stored for L, padding and relaxation included */
    double flops;      /* sum over columns of (entries)^2, without relaxation */
    sl_int supernodes;
    sl_int supernodes_fundamental; /* before relaxation */
    sl_int tree_height;            /* columns on the longest path of the elimination tree */
    sl_int components;             /* roots of the elimination tree */
    double seconds_order;          /* processor seconds in the ordering */
    double seconds_analyse;        /* processor seconds in everything else of the analysis: .. */
    double seconds_tree;           /* .. its part in tree, counts and supernodes, and .. */
    double seconds_structure;      /* .. its part in the rows of L and the map of A into L */
    size_t bytes_symbolic;

    /* sl_factor_create, sl_factor_refactor */
    sl_isa isa;
    sl_method method; /* the one that was used */
    sl_int positive;  /* pivots by sign: the inertia of A */
    sl_int negative;
    sl_int null;      /* null pivots: skipped (SL_SEMIDEFINITE), or the one that was refused */
    double pivot_min; /* smallest and largest |d| */
    double pivot_max;
    double seconds_setup; /* processor seconds in the schedule and the memory of sl_factor_create */
    double seconds_factor; /* processor seconds in the numbers, those of all threads summed up */
    size_t bytes_factor;
    sl_int regularized; /* pivots that regularization changed; they count by their new sign */

    /* sl_plan_create, sl_local_solve; sl_inverse_*, which have no backward sweep */
    sl_int b_supernodes; /* visited by the forward sweep */
    sl_int b_columns;
    sl_off b_entries;    /* doubles of L that the forward sweep reads */
    sl_int x_supernodes; /* the same for the backward sweep */
    sl_int x_columns;
    sl_off x_entries;
    size_t bytes_plan;

    /* sl_selected_create; the first three also sl_inverse_diagonal and sl_inverse_pairs, which keep none */
    sl_int z_supernodes; /* those whose part of the inverse was made */
    sl_int z_columns;
    sl_off z_entries;        /* doubles kept for them */
    double seconds_selected; /* processor seconds, those of all threads summed up */
    size_t bytes_selected;

    /* sl_region_create, sl_region_refill */
    sl_int region_rows;     /* rows of A that a plan may use, the boundary included */
    sl_int region_boundary; /* rows of the boundary */
    sl_int region_subtrees; /* subtrees of supernodes inside it */
    sl_off region_entries;  /* doubles kept of the inverse */
    int region_is_copied;   /* 1: out of a selected inverse; else by forward sweeps */
    double seconds_region;  /* processor seconds */
    size_t bytes_region;

    /* sl_plan_create */
    int plan_in_region; /* the sweeps end at the boundary of options.region; else at the roots */
    sl_off plan_region_entries; /* doubles of the region's inverse that a solve reads; 0 without */

    /* sl_inverse_diagonal, sl_inverse_pairs */
    sl_inverse_method inverse_method; /* the one that was used */

    /* sl_factor_refine, sl_plan_solve_refined */
    sl_int refine_steps;   /* corrections that were taken, the most of all right-hand sides */
    double backward_error; /* what is left, the largest of all right-hand sides */
} sl_stats;

typedef struct sl_matrix sl_matrix;     /* a CSC matrix that the library owns */
typedef struct sl_symbolic sl_symbolic; /* analysis of one pattern; immutable */
typedef struct sl_factor sl_factor;     /* numbers over a symbolic: L and D */
typedef struct sl_plan sl_plan;         /* reach of a b-set and of an x-set; immutable */
typedef struct sl_work sl_work;         /* scratch of one thread */
typedef struct sl_selected sl_selected; /* entries of the inverse on the pattern of L; immutable */
typedef struct sl_region sl_region;     /* where local solves may stop below the root of the tree */

#endif
/* end src/public/types.h */
/* begin src/public/csc.h */
/* csc.h: matrices the library owns, checks, products, residuals, Matrix Market files */
#ifndef SL_PUBLIC_CSC_H
#define SL_PUBLIC_CSC_H

/** Builds a matrix from triplets; entries with the same row and column are summed, rows come out ascending.
 *
 *  out    [out]  the matrix, or NULL on error; release with sl_matrix_free.
 *  count  [in]   number of triplets.
 *  i, j   [in]   count row indices in 0..n_rows-1 and column indices in 0..n_cols-1, any order.
 *  x      [in]   count values; NULL: a pattern without values.
 *  opt    [in]   allocator; may be NULL.
 *  stats  [out]  error_row, error_column of an index out of range; may be NULL.
 *  Returns  SL_OK; SL_ERR_ARGUMENT; SL_ERR_TOO_LARGE: more than 2^31-1 triplets, or than 2^31-8 rows or
 *           columns; SL_ERR_MEMORY.
 *  Cost     O(count + n_rows + n_cols).
 *  Threads  any number on distinct outputs.
 */
SL_API SL_WARN_UNUSED sl_status sl_matrix_from_triplets(sl_matrix **out, sl_int n_rows,
                                                        sl_int n_cols, sl_off count,
                                                        const sl_int *i, const sl_int *j,
                                                        const double *x, const sl_options *opt,
                                                        sl_stats *stats);

/** Reads a Matrix Market file: coordinate; real, integer or pattern; general or symmetric.
 *
 *  A symmetric file gives the lower triangle (entries above the diagonal are mirrored into it), a general file the
 *  entries as they stand, duplicates summed; a pattern file gives a matrix with x = NULL.
 *
 *  out    [out]  the matrix, or NULL on error; release with sl_matrix_free.
 *  stats  [out]  error_line; may be NULL.
 *  Returns  SL_OK; SL_ERR_IO: no such file, or malformed at error_line; SL_ERR_UNSUPPORTED: complex, array,
 *           skew-symmetric or hermitian; SL_ERR_NOT_FINITE is not raised here; SL_ERR_TOO_LARGE; SL_ERR_MEMORY.
 *  Cost     O(file size + n_rows + n_cols).
 */
SL_API SL_WARN_UNUSED sl_status sl_matrix_read(sl_matrix **out, const char *path,
                                               const sl_options *opt, sl_stats *stats);

/** The same from memory: length bytes of text, no terminating zero needed. */
SL_API SL_WARN_UNUSED sl_status sl_matrix_parse(sl_matrix **out, const char *text, size_t length,
                                                const sl_options *opt, sl_stats *stats);

/** The transpose of a stored matrix (SL_AS_STORED); rows come out ascending, duplicates stay.
 *
 *  Returns  SL_OK; SL_ERR_ARGUMENT; SL_ERR_PATTERN; SL_ERR_TOO_LARGE; SL_ERR_MEMORY.
 *  Cost     O(n_rows + n_cols + nnz).
 */
SL_API SL_WARN_UNUSED sl_status sl_matrix_transpose(sl_matrix **out, const sl_csc *A,
                                                    const sl_options *opt);

/** The symmetric permutation C = P A P' of a square matrix: C(k, l) = A(perm[k], perm[l]).
 *
 *  A matrix that stores one triangle gives the lower triangle of C; one that stores both gives both.
 *
 *  perm   [in]   n entries, a permutation of 0..n-1.
 *  Returns  SL_OK; SL_ERR_ARGUMENT: not square, not a permutation; SL_ERR_PATTERN; SL_ERR_TOO_LARGE; SL_ERR_MEMORY.
 *  Cost     O(n + nnz).
 */
SL_API SL_WARN_UNUSED sl_status sl_matrix_permute(sl_matrix **out, const sl_csc *A,
                                                  const sl_int *perm, const sl_options *opt);

/** The arrays of an owned matrix; valid as long as M lives. A NULL M gives a 0 x 0 view. */
SL_API sl_csc sl_matrix_view(const sl_matrix *M);

/** Releases a matrix; NULL is fine. */
SL_API void sl_matrix_free(sl_matrix *M);

/** Checks a view: sizes, positions ascending from 0, indices in range.
 *
 *  stats  [out]  error_column and, for an index out of range, error_row; may be NULL.
 *  Returns  SL_OK; SL_ERR_ARGUMENT: A or one of its arrays is NULL; SL_ERR_PATTERN; SL_ERR_TOO_LARGE: more rows or
 *           columns than sl_csc allows.
 *  Cost     O(n_cols + nnz).
 */
SL_API SL_WARN_UNUSED sl_status sl_csc_check(const sl_csc *A, sl_stats *stats);

/** Finds which triangle a square matrix stores, and that a matrix storing both has a symmetric pattern.
 *
 *  out    [out]  the triangle; on error untouched.
 *  stats  [out]  error_row, error_column of an entry without its mirror image; may be NULL.
 *  Returns  SL_OK; SL_ERR_ARGUMENT: not square; SL_ERR_PATTERN; SL_ERR_TOO_LARGE; SL_ERR_MEMORY.  Cost  O(n + nnz).
 */
SL_API SL_WARN_UNUSED sl_status sl_csc_triangle(const sl_csc *A, sl_triangle *out,
                                                const sl_options *opt, sl_stats *stats);

/** Y = A X.
 *
 *  reading  [in]   SL_AS_SYMMETRIC: A square, read as the factorization does; SL_AS_STORED: any shape.
 *  Y        [out]  n_rows x nrhs, column-major, leading dimension ldy elements; must not overlap X.
 *  X        [in]   n_cols x nrhs, column-major, leading dimension ldx elements.
 *  Returns  SL_OK; SL_ERR_ARGUMENT, an unknown reading too. The pattern is trusted (sl_csc_check).
 *  Cost     O(nnz nrhs).
 */
SL_API SL_WARN_UNUSED sl_status sl_csc_multiply(const sl_csc *A, sl_reading reading, double *Y,
                                                size_t ldy, const double *X, size_t ldx,
                                                sl_int nrhs);

/** R = B - A X for a symmetric A, and the backward error of each column.
 *
 *  R               [out]  n x nrhs, column-major, leading dimension ldr elements; it may be B itself (then
 *                         ldr = ldb) where backward_error is NULL; must not overlap X.
 *  X, B            [in]   n x nrhs, column-major, leading dimensions ldx and ldb elements.
 *  backward_error  [out]  nrhs numbers ||r|| / (||A|| ||x|| + ||b||) in the largest-entry and largest-row-sum norms,
 *                         0 where r = 0, NaN where r has one or the denominator overflows; may be NULL.
 *  Returns  SL_OK; SL_ERR_ARGUMENT. The pattern is trusted.  Cost  O(nnz nrhs).
 */
SL_API SL_WARN_UNUSED sl_status sl_csc_residual(const sl_csc *A, double *R, size_t ldr,
                                                double *backward_error, const double *X, size_t ldx,
                                                const double *B, size_t ldb, sl_int nrhs);

/** Writes a Matrix Market file that reads back to the same bits (%.17g).
 *
 *  reading  [in]  SL_AS_STORED: a general file of all entries; SL_AS_SYMMETRIC: a symmetric file of one triangle.
 *  Returns  SL_OK; SL_ERR_ARGUMENT: a NULL, an unknown reading; SL_ERR_PATTERN: malformed, or unsymmetric where
 *           symmetry is claimed; SL_ERR_IO; SL_ERR_MEMORY; SL_ERR_TOO_LARGE.
 */
SL_API SL_WARN_UNUSED sl_status sl_csc_write(const sl_csc *A, sl_reading reading, const char *path);

#endif
/* end src/public/csc.h */
/* begin src/public/analyse.h */
/* analyse.h: the analysis of a pattern: ordering, elimination tree, supernodes, storage of L */
#ifndef SL_PUBLIC_ANALYSE_H
#define SL_PUBLIC_ANALYSE_H

/** Analyses the pattern of a symmetric matrix once, for any number of factorizations with that pattern.
 *
 *  Orders the rows, builds the elimination tree, its postorder, column counts and supernodes, the rows of every
 *  supernode, and the map that carries each entry of A to its place in L.
 *
 *  out    [out]  the analysis, or NULL on error; release with sl_symbolic_free.
 *  A      [in]   n x n, symmetric; values are not read (x may be NULL); not kept.
 *  opt    [in]   ordering, perm, metis_options, relaxation, allocator; may be NULL.
 *  stats  [out]  the symbolic group; may be NULL.
 *  Returns  SL_OK; SL_ERR_ARGUMENT: not square, perm not a permutation (error_row is the first offending position),
 *           an unknown ordering or relaxation, metis_options that METIS would refuse; SL_ERR_PATTERN;
 *           SL_ERR_UNSUPPORTED: METIS asked for and not compiled in; SL_ERR_ORDERING; SL_ERR_TOO_LARGE; SL_ERR_MEMORY.
 *  Cost     the ordering, then nearly O(nnz(A) + rows of the supernodes).
 *  Threads  METIS is not as quiet as this library. While it runs (SL_ORDERING_METIS, or the default with it) it resets
 *           rand() of the C library by srand() and draws from it, traps SIGABRT and SIGTERM of the whole process, and
 *           prints a line if it runs out of memory. Calls in several threads at once are safe only if rand() is, and
 *           may then order differently from run to run. Other orderings do nothing of this and run in any number of
 *           threads.
 *  Source   [Liu90] elimination tree; [GNP94] counts; [AG89] relaxed supernodes; [KK98] METIS.
 *  Example  tests/test_symbolic.c
 */
SL_API SL_WARN_UNUSED sl_status sl_symbolic_create(sl_symbolic **out, const sl_csc *A,
                                                   const sl_options *opt, sl_stats *stats);

/** Releases an analysis; NULL is fine. Factors and plans over it must be gone or never used again. */
SL_API void sl_symbolic_free(sl_symbolic *S);

/** Fills the symbolic group of stats again. */
SL_API void sl_symbolic_stats(const sl_symbolic *S, sl_stats *stats);

/** A look inside: arrays that live as long as the analysis.
 *
 *  Supernode s owns columns super_first[s] .. super_first[s+1]-1 of L, a dense block: its own rows, then the rows
 *  rows[rows_begin[s]] .. rows[rows_begin[s+1]-1] below them, ascending. Supernodes are in postorder.
 *  The numbers of supernode s stand in a panel of row tiles, [tile][column][8], from position panel_begin[s] of
 *  sl_factor_view's L: tile t holds local rows 8t..8t+7 of the columns 0..min(width, 8(t+1))-1; the unit diagonal and
 *  what is above it are stored as 0.
 */
typedef struct sl_symbolic_view_t {
    sl_int n;
    sl_int n_supers;
    const sl_int *perm;   /* n: perm[k] = row of A that is pivot k */
    const sl_int *iperm;  /* n: its inverse */
    const sl_int *parent; /* n: elimination tree of P A P', -1 at a root */
    const sl_int *counts; /* n: entries of column k of L, diagonal included, without relaxation */
    const sl_int *super_first;  /* n_supers + 1 */
    const sl_int *super_of;     /* n: supernode of column k */
    const sl_int *super_parent; /* n_supers: -1 at a root */
    const sl_off *rows_begin;   /* n_supers + 1 */
    const sl_int *rows;         /* rows_begin[n_supers] */
    const sl_off *panel_begin;  /* n_supers + 1 */
} sl_symbolic_view_t;

SL_API sl_symbolic_view_t sl_symbolic_view(const sl_symbolic *S);

#endif
/* end src/public/analyse.h */
/* begin src/public/factor.h */
/* factor.h: the numbers: P A P' = L D L' */
#ifndef SL_PUBLIC_FACTOR_H
#define SL_PUBLIC_FACTOR_H

/** Factors P A P' = L D L' with unit lower triangular L and diagonal D of any sign, without pivoting.
 *
 *  Definite and quasi-definite matrices work in any order unless rounding loses a pivot: one that comes out below
 *  null_tolerance of what it was made of is refused. A symmetric indefinite matrix works if no pivot comes out null.
 *
 *  SL_SEMIDEFINITE skips null pivots instead: on a raw Laplacian one in each connected component, the last of it. With
 *  options.mass, weights m, every solve on the factor, full or local, then gives in each component with a null pivot the
 *  x with sum m x = 0 of A x = b - c m, where c = z' b / z' m makes the right-hand side consistent and z is the null
 *  vector: on a Laplacian, of constant z, the Poisson problem's zero-mean solution. A component whose weights are all
 *  0, as that of a vertex without faces may be, counts as weighted by 1; a row of zeros is a component by itself,
 *  whatever the pattern says, and its x is 0. Without mass solves give the solution that is 0 in the rows of
 *  sl_factor_null_rows, and refuse a right-hand side that is not consistent by SL_ERR_INCONSISTENT
 *  (options.consistency_tolerance; sl_factor_defects tells by how much). Where that is switched off, the residual of
 *  such a system is in those rows alone. Entries of the inverse are those of the inverse that makes x 0 there.
 *
 *  options.regularization is for KKT systems whose signs are known: L D L' is then P (A + E) P' with a diagonal E
 *  that is 0 but in the rows of sl_factor_regularized_rows. sl_factor_refine and sl_plan_solve_refined give the
 *  solution of A x = b out of it. Where many diagonal entries are 0, a small multiple of the signs added to the whole
 *  diagonal beforehand makes A quasi-definite, and refinement takes it away just so. Signs that are not those of
 *  the blocks, as where H is indefinite, are no substitute for pivoting: backward_error tells.
 *
 *  out    [out]  the factor, or NULL on error; release with sl_factor_free.
 *  S      [in]   analysis of A's pattern; borrowed, must outlive the factor.
 *  A      [in]   n x n with values; the pattern that S was made from, entry by entry in the same order.
 *  opt    [in]   isa, method, threads, definiteness, null_tolerance, mass, consistency_tolerance, regularization,
 *                signs, allocator; may be NULL.
 *  stats  [out]  the factor group; error_row, error_value; may be NULL.
 *  Returns  SL_OK; SL_ERR_ARGUMENT: no values, an option that is no number or out of range, a weight that is not finite
 *           or a sign that is none (error_row), z' m = 0 at null row error_row; SL_ERR_PATTERN: n or the number of entries differs from the analysed
 *           one; SL_ERR_PIVOT: null pivot at error_row, with mass a second one in its component; SL_ERR_NOT_FINITE: at error_row (and error_column where
 *           it stands in A); SL_ERR_UNSUPPORTED: the isa; SL_ERR_TOO_LARGE: L is beyond size_t; SL_ERR_MEMORY.
 *  Cost     O(sum over columns of entries^2); kept are nnz_panels doubles and, by the supernodal method, the update
 *           matrices that wait at once: some 5 % more on 2D meshes, some 30 % on 3D ones, twice that with threads. Mass
 *           adds a forward sweep, 24 bytes a row, and to a solve a few operations for each column that it visits.
 *  Threads  any number of calls at once on one S. options.threads shares one call out, here and in every
 *           sl_factor_refactor: subtrees first, then the rows of each large front. The bits of L do not depend on
 *           their number. The supernodal method alone uses them.
 *  Source   supernodal: multifrontal, [DR83] [Liu92], over tiles; up-looking: [LDL05], [Davis06] 4.7, row by row.
 *  Example  tests/test_factor.c
 */
SL_API SL_WARN_UNUSED sl_status sl_factor_create(sl_factor **out, const sl_symbolic *S,
                                                 const sl_csc *A, const sl_options *opt,
                                                 sl_stats *stats);

/** Factors again with new values of the same pattern. Allocates nothing; the same bits as sl_factor_create gives.
 *
 *  F      [in,out]  on error F holds no factor and every solve refuses it, until a refactor succeeds.
 *  Returns, Cost    as sl_factor_create, SL_ERR_MEMORY, SL_ERR_TOO_LARGE and SL_ERR_UNSUPPORTED aside.
 *  Threads          nobody else may use F meanwhile.
 */
SL_API SL_WARN_UNUSED sl_status sl_factor_refactor(sl_factor *F, const sl_csc *A, sl_stats *stats);

/** Factors again after local changes: only the columns of L that they reach, each from all its descendants.
 *
 *  For many changes in one place: the reach of a single vertex has the large separators at its end and costs some
 *  30 % of a whole factorization on a 2D mesh. Results agree with sl_factor_refactor to rounding; columns of L that
 *  no change reaches keep their bits. An up-looking factor is factored whole.
 *
 *  F        [in,out]  holds the factor of a matrix that differs from A in the given columns alone. On error F holds no
 *                     factor, unless the error is ARGUMENT, PATTERN, STATE or MEMORY: then it is as before.
 *  A        [in]      the pattern that was analysed, the new values.
 *  columns  [in]      count columns of A, as A stores its entries; any order, repetitions allowed.
 *  Returns  as sl_factor_create; SL_ERR_ARGUMENT: a column out of range (error_row); SL_ERR_STATE: F holds no factor.
 *  Cost     the update matrices of all descendants of the supernodes reached; while it runs 16 bytes an entry of the
 *           columns, 4 a row of A, of which it touches those reached, and 4 a row of the tallest supernode. With mass the
 *           forward sweep for the weights is a whole one.
 *  Threads  nobody else may use F meanwhile.
 *  Source   left-looking supernodes [NP93] over the reach of the changes.
 *  Example  tests/test_changed.c
 */
SL_API SL_WARN_UNUSED sl_status sl_factor_refactor_changed(sl_factor *F, const sl_csc *A,
                                                           const sl_int *columns, sl_int count,
                                                           sl_stats *stats);

/** Releases a factor; NULL is fine. */
SL_API void sl_factor_free(sl_factor *F);

/** Fills the factor group of stats again. */
SL_API void sl_factor_stats(const sl_factor *F, sl_stats *stats);

/** The rows whose null pivots were skipped, in the order of elimination.
 *
 *  rows   [out]  the first `most` of them; NULL where most = 0.
 *  count  [out]  how many there are, also above most.
 *  Returns  SL_OK; SL_ERR_ARGUMENT; SL_ERR_STATE: failed factor.  Cost  O(count).
 */
SL_API SL_WARN_UNUSED sl_status sl_factor_null_rows(const sl_factor *F, sl_int *rows, sl_int most,
                                                    sl_int *count);

/** The rows whose pivots regularization changed, in the order of elimination, and by how much: E of A + E = P' L D L' P.
 *
 *  rows    [out]  the first `most` of them; NULL where most = 0.
 *  shifts  [out]  the same number of diagonal entries of E; may be NULL.
 *  count   [out]  how many there are, also above most.
 *  Returns  SL_OK; SL_ERR_ARGUMENT; SL_ERR_STATE: failed factor.  Cost  O(count).
 */
SL_API SL_WARN_UNUSED sl_status sl_factor_regularized_rows(const sl_factor *F, sl_int *rows,
                                                           double *shifts, sl_int most,
                                                           sl_int *count);

/** log |det A| and the sign of det A (-1 or 1) from D; det of a 0 x 0 matrix is 1.
 *
 *  Where null pivots were skipped it is the determinant of A without their rows and columns: of a Laplacian, in each
 *  component the product of the eigenvalues that are not 0 over the number of rows.
 *
 *  Where regularization changed pivots it is that of A + E. A sum of logarithms: nothing overflows.
 *
 *  Returns  SL_OK; SL_ERR_ARGUMENT; SL_ERR_STATE: failed factor.  Cost  O(n).
 */
SL_API SL_WARN_UNUSED sl_status sl_factor_logdet(const sl_factor *F, double *log_abs_det,
                                                 double *sign);

/** L as a matrix in compressed columns, with its unit diagonal, rows ascending.
 *
 *  Its entries are the places of the panels that are not exactly zero: those that relaxation or padding fills with
 *  zeros are left out, and so is an entry of L that came out as zero by cancellation.
 *
 *  Returns  SL_OK; SL_ERR_ARGUMENT; SL_ERR_STATE; SL_ERR_TOO_LARGE: 2^31 or more entries; SL_ERR_MEMORY.
 */
SL_API SL_WARN_UNUSED sl_status sl_factor_lower(sl_matrix **out, const sl_factor *F,
                                                const sl_options *opt);

/** A look inside; the pointers live as long as F. */
typedef struct sl_factor_view_t {
    const sl_symbolic *symbolic;
    const double *L; /* panels, laid out as sl_symbolic_view_t tells */
    const double *D; /* n pivots, in pivot order; DBL_MAX where a null pivot was skipped */
} sl_factor_view_t;

SL_API sl_factor_view_t sl_factor_view(const sl_factor *F);

#endif
/* end src/public/factor.h */
/* begin src/public/solve.h */
/* solve.h: full solves, and the workspace that every solve writes to */
#ifndef SL_PUBLIC_SOLVE_H
#define SL_PUBLIC_SOLVE_H

/** Makes an empty workspace. It grows when a solve needs more, and keeps what it has: one a thread.
 *
 *  Returns  SL_OK; SL_ERR_ARGUMENT; SL_ERR_MEMORY.
 */
SL_API SL_WARN_UNUSED sl_status sl_work_create(sl_work **out, const sl_options *opt);

/** Releases a workspace; NULL is fine. */
SL_API void sl_work_free(sl_work *W);

/** Bytes that a workspace holds now. */
SL_API size_t sl_work_bytes(const sl_work *W);

/** Grows W so that full solves on F with up to nrhs right-hand sides allocate nothing.
 *
 *  Returns  SL_OK; SL_ERR_ARGUMENT; SL_ERR_TOO_LARGE; SL_ERR_MEMORY.
 */
SL_API SL_WARN_UNUSED sl_status sl_work_reserve_factor(sl_work *W, const sl_factor *F, sl_int nrhs);

/** Grows W so that solves of plan P with up to nrhs right-hand sides allocate nothing.
 *
 *  Returns  SL_OK; SL_ERR_ARGUMENT; SL_ERR_TOO_LARGE; SL_ERR_MEMORY.
 */
SL_API SL_WARN_UNUSED sl_status sl_work_reserve_plan(sl_work *W, const sl_plan *P, sl_int nrhs);

/** Solves A X = B. Of a singular A: the solution that sl_factor_create tells of.
 *
 *  F      [in]   factor of A, n x n.
 *  X      [out]  n x nrhs, column-major, leading dimension ldx elements, in the order of A's rows; may be B itself
 *                (then ldx = ldb). On error untouched.
 *  B      [in]   n x nrhs, column-major, leading dimension ldb elements.
 *  nrhs   [in]   number of right-hand sides, 0 or more; solved in blocks of 8, for the time of two to three alone.
 *  W      [in,out]  scratch; NULL: allocated for this call.
 *  Returns  SL_OK; SL_ERR_ARGUMENT; SL_ERR_STATE: failed factor; SL_ERR_INCONSISTENT: a column of B has no solution
 *           (SL_SEMIDEFINITE without mass); SL_ERR_TOO_LARGE, SL_ERR_MEMORY: W had to grow and could not.
 *  Cost     4 nnz_panels flops a right-hand side; reads L twice for each block; W grows to O(n min(nrhs, 8)). Where B
 *           has to be consistent, right-hand sides beyond the eighth are swept forward once more beforehand.
 *  Threads  any number at once on one F, each with its own W.
 *  Example  tests/test_solve.c
 */
SL_API SL_WARN_UNUSED sl_status sl_factor_solve(const sl_factor *F, double *X, size_t ldx,
                                                const double *B, size_t ldb, sl_int nrhs,
                                                sl_work *W);

/** Solves A X = B with the right-hand sides interleaved: the numbers of one row stand side by side.
 *
 *  The same bits as sl_factor_solve, and what several right-hand sides are fastest in: 8 columns that lie apart take
 *  about a fifth of a solve to bring together and to part again.
 *
 *  F      [in]   factor of A, n x n.
 *  X      [out]  n x nrhs, row-major, ldx >= nrhs elements from row to row; may be B itself (then ldx = ldb). On error
 *                untouched.
 *  B      [in]   n x nrhs, row-major, ldb >= nrhs elements from row to row.
 *  nrhs   [in]   as in sl_factor_solve.
 *  W      [in,out]  scratch; NULL: allocated for this call.
 *  Returns  as sl_factor_solve.
 *  Cost     as sl_factor_solve.
 *  Threads  any number at once on one F, each with its own W.
 *  Example  tests/test_interleaved.c
 */
SL_API SL_WARN_UNUSED sl_status sl_factor_solve_interleaved(const sl_factor *F, double *X,
                                                            size_t ldx, const double *B, size_t ldb,
                                                            sl_int nrhs, sl_work *W);

#endif
/* end src/public/solve.h */
/* begin src/public/plan.h */
/* plan.h: local solves: b known on a few rows, x wanted on a few others */
#ifndef SL_PUBLIC_PLAN_H
#define SL_PUBLIC_PLAN_H

/** Prepares solves of A x = b that know b only on bset and want x only on xset.
 *
 *  With P A P' = L D L' the forward sweep needs the elimination tree's paths from bset to the roots, the backward
 *  sweep those from xset: each is found by itself, in time proportional to its own size.
 *
 *  out    [out]  the plan, or NULL on error; release with sl_plan_free.
 *  S      [in]   analysis of A, n columns; borrowed, must outlive the plan.
 *  bset   [in]   nb rows of A in 0..n-1, any order, none twice; NULL (with nb ignored): all n. b is 0 elsewhere.
 *  xset   [in]   nx rows of A in 0..n-1, any order, none twice; NULL (with nx ignored): all n.
 *                An empty set is a pointer that is not NULL with nb or nx = 0; nothing is read there.
 *  opt    [in]   allocator, region; may be NULL. Where both sets are inside the region the sweeps end at its boundary,
 *                and nothing above it is looked at; where they are not, or one is NULL, the plan is the same as without.
 *  stats  [out]  the plan group, plan_in_region; error_row: an index out of range or given twice; may be NULL.
 *  Returns  SL_OK; SL_ERR_ARGUMENT; SL_ERR_STATE: a region of another analysis; SL_ERR_TOO_LARGE; SL_ERR_MEMORY.
 *  Cost     O(nb + nx + rows of the supernodes reached), with a logarithm for rows that skip many ancestors; nothing
 *           O(n); 4 bytes a row of a set, and 4 a row and 32 a supernode reached kept.
 *  Threads  reads S; the plan is immutable and may be shared.
 *  Source   [Davis06] 3.2, 4.1; [HDA17] 3.
 *  Example  tests/test_plan.c
 */
SL_API SL_WARN_UNUSED sl_status sl_plan_create(sl_plan **out, const sl_symbolic *S,
                                               const sl_int *bset, sl_int nb, const sl_int *xset,
                                               sl_int nx, const sl_options *opt, sl_stats *stats);

/** Releases a plan; NULL is fine. */
SL_API void sl_plan_free(sl_plan *P);

/** Fills the plan group of stats again. */
SL_API void sl_plan_stats(const sl_plan *P, sl_stats *stats);

/** Solves A x = b on the plan's sets: exactly what the full solve gives there.
 *
 *  For the same instruction set and nrhs the result equals sl_factor_solve's bit for bit (the sign of a zero aside);
 *  in a region, to rounding.
 *
 *  F      [in]   a factor over the plan's analysis.
 *  X      [out]  nx x nrhs, column-major, leading dimension ldx elements, rows in the order of xset; may be B itself
 *                (then ldx = ldb). On error untouched.
 *  B      [in]   nb x nrhs, column-major, leading dimension ldb elements, rows in the order of bset.
 *  nrhs   [in]   number of right-hand sides, 0 or more.
 *  W      [in,out]  scratch; NULL: allocated for this call.
 *  Returns  SL_OK; SL_ERR_ARGUMENT; SL_ERR_STATE: failed factor, one of another analysis, or, in a region, other
 *           numbers than those it was made or refilled of; SL_ERR_INCONSISTENT: as in sl_factor_solve; SL_ERR_TOO_LARGE;
 *           SL_ERR_MEMORY.
 *  Cost     2 (b_entries + x_entries) + 4 plan_region_entries flops a right-hand side; nothing O(n); no allocation once
 *           W has grown.
 *  Threads  any number at once on one P and one F, each with its own W.
 *  Example  tests/test_plan.c
 */
SL_API SL_WARN_UNUSED sl_status sl_plan_solve(const sl_plan *P, const sl_factor *F, double *X,
                                              size_t ldx, const double *B, size_t ldb, sl_int nrhs,
                                              sl_work *W);

/** sl_plan_solve with the right-hand sides interleaved, as in sl_factor_solve_interleaved: the same bits.
 *
 *  F      [in]   a factor over the plan's analysis.
 *  X      [out]  nx x nrhs, row-major, ldx >= nrhs elements from row to row, rows in the order of xset; may be B itself
 *                (then ldx = ldb). On error untouched.
 *  B      [in]   nb x nrhs, row-major, ldb >= nrhs elements from row to row, rows in the order of bset.
 *  nrhs   [in]   number of right-hand sides, 0 or more.
 *  W      [in,out]  scratch; NULL: allocated for this call.
 *  Returns  as sl_plan_solve.
 *  Cost     as sl_plan_solve.
 *  Threads  any number at once on one P and one F, each with its own W.
 *  Example  tests/test_interleaved.c
 */
SL_API SL_WARN_UNUSED sl_status sl_plan_solve_interleaved(const sl_plan *P, const sl_factor *F,
                                                          double *X, size_t ldx, const double *B,
                                                          size_t ldb, sl_int nrhs, sl_work *W);

/** One local solve without a plan object: sl_plan_create and sl_plan_solve in the caller's workspace.
 *
 *  X and B as in sl_plan_solve; bset and xset as in sl_plan_create; stats may be NULL.
 *  Returns  SL_OK; SL_ERR_ARGUMENT; SL_ERR_STATE: failed factor; SL_ERR_INCONSISTENT: as in sl_factor_solve;
 *           SL_ERR_TOO_LARGE; SL_ERR_MEMORY.
 *  Cost     the sum of both; no allocation once W has grown.
 *  Threads  any number at once on one F, each with its own W.
 *  Example  tests/test_plan.c
 */
SL_API SL_WARN_UNUSED sl_status sl_local_solve(const sl_factor *F, double *X, size_t ldx,
                                               const sl_int *xset, sl_int nx, const double *B,
                                               size_t ldb, const sl_int *bset, sl_int nb,
                                               sl_int nrhs, sl_work *W, sl_stats *stats);

#endif
/* end src/public/plan.h */
/* begin src/public/accuracy.h */
/* accuracy.h: how good a solution is and how to better it: refinement, condition, what a right-hand side lacks */
#ifndef SL_PUBLIC_ACCURACY_H
#define SL_PUBLIC_ACCURACY_H

/** Betters solutions of A X = B: residual, solve, add, for as long as that helps.
 *
 *  Each column goes on until its backward error max |b - A x| / (|A| |x| + |b|), row by row, is epsilon, a correction
 *  fails to halve it, or the steps are used up; a correction that makes it worse is not taken. With a regularized factor,
 *  of A + E, that turns the solution of the one system into that of the other. With null pivots B has to be consistent.
 *
 *  F      [in]      a factor of A, or of a matrix near A.
 *  A      [in]      the matrix; the pattern that was analysed.
 *  X      [in,out]  n x nrhs, column-major, leading dimension ldx elements: solutions as sl_factor_solve gives, or any other
 *                   start; must not overlap B. On error untouched.
 *  B      [in]      n x nrhs, column-major, leading dimension ldb elements.
 *  steps  [in]      the most corrections of a column, 0 or more; 0 only measures.
 *  W      [in,out]  scratch; NULL: allocated for this call.
 *  stats  [out]     refine_steps, backward_error; may be NULL.
 *  Returns  SL_OK; SL_ERR_ARGUMENT; SL_ERR_STATE: failed factor; SL_ERR_PATTERN: not the pattern that was analysed;
 *           SL_ERR_TOO_LARGE, SL_ERR_MEMORY: W had to grow and could not.
 *  Cost     a product with A, and for each step another and a solve; W grows to O(n min(nrhs, 8)).
 *  Threads  any number at once on one F, each with its own W.
 *  Source   [Sk80]: one step of it makes a solver stable row by row.
 *  Example  tests/test_refine.c
 */
SL_API SL_WARN_UNUSED sl_status sl_factor_refine(const sl_factor *F, const sl_csc *A, double *X,
                                                 size_t ldx, const double *B, size_t ldb,
                                                 sl_int nrhs, sl_int steps, sl_work *W,
                                                 sl_stats *stats);

/** Solves A x = b on a plan's sets with a regularized factor, L D L' = P (A + E) P': sl_plan_solve and refinement.
 *
 *  A residual is known where x is known around it. That of a solution x of (A + E) x = b is E x, rounding aside, and
 *  E is 0 but in the regularized rows: the sweeps x <- (A + E)^-1 (b + E x) need x in these and the wanted rows
 *  alone, and cost what a local solve costs. What they take away is the error of regularization; that of rounding
 *  is as in sl_plan_solve, and takes the whole of x and sl_factor_refine. Where nothing was regularized it is sl_plan_solve.
 *
 *  P      [in]   a plan whose two reaches hold every regularized row of the components that b is in: as they do where
 *                these rows are in both of its sets.
 *  X, B, ldx, ldb, nrhs, W  as in sl_plan_solve.
 *  steps  [in]   the most corrections of a column, 0 or more.
 *  stats  [out]  refine_steps; backward_error: max |E (x - the x before)| / max |b|; with SL_ERR_ARGUMENT error_row: a
 *                regularized row outside of the reaches; may be NULL.
 *  Returns  as sl_plan_solve; SL_ERR_UNSUPPORTED: a plan in a region, and a factor with regularized rows.
 *  Cost     1 + steps local solves; nothing O(n); no allocation once W has grown, by 16 numbers a row of the x-set.
 *  Threads  any number at once on one P and one F, each with its own W.
 *  Example  tests/test_refine_local.c
 */
SL_API SL_WARN_UNUSED sl_status sl_plan_solve_refined(const sl_plan *P, const sl_factor *F,
                                                      double *X, size_t ldx, const double *B,
                                                      size_t ldb, sl_int nrhs, sl_int steps,
                                                      sl_work *W, sl_stats *stats);

/** An estimate of 1 / (||A|| ||A^-1||), by largest column sums; 0 where null pivots were skipped, 1 where n = 0.
 *
 *  The true one is never above it but for rounding, and rarely below a third of it. Where regularization changed
 *  pivots, A^-1 is (A + E)^-1.
 *
 *  A      [in]      the matrix that F is a factor of.
 *  W      [in,out]  scratch; NULL: allocated for this call.
 *  Returns  SL_OK; SL_ERR_ARGUMENT; SL_ERR_STATE: failed factor; SL_ERR_PATTERN: not the pattern that was analysed;
 *           SL_ERR_TOO_LARGE, SL_ERR_MEMORY: W had to grow and could not.
 *  Cost     4 to 10 solves.
 *  Threads  any number at once on one F, each with its own W.
 *  Source   [Hi88]
 *  Example  tests/test_condition.c
 */
SL_API SL_WARN_UNUSED sl_status sl_factor_rcond(const sl_factor *F, const sl_csc *A, double *rcond,
                                                sl_work *W);

/** What right-hand sides lack to be consistent with a singular A: Z' B, for the null vectors z of A.
 *
 *  Vector k of Z belongs to row k of sl_factor_null_rows, and is 1 there and 0 in the other null rows: B with Y(k, r)
 *  taken off that row has a solution. On a Laplacian Y holds the sum of B over each component.
 *
 *  F      [in]   a factor made with SL_SEMIDEFINITE; one without null pivots has nothing to tell.
 *  Y      [out]  null rows x nrhs, column-major, leading dimension ldy elements; must not overlap B.
 *  B      [in]   n x nrhs, column-major, leading dimension ldb elements.
 *  W      [in,out]  scratch; NULL: allocated for this call.
 *  Returns  SL_OK; SL_ERR_ARGUMENT; SL_ERR_STATE: failed factor; SL_ERR_TOO_LARGE, SL_ERR_MEMORY: W had to grow and
 *           could not.
 *  Cost     the forward half of sl_factor_solve.
 *  Threads  any number at once on one F, each with its own W.
 *  Example  tests/test_consistent.c
 */
SL_API SL_WARN_UNUSED sl_status sl_factor_defects(const sl_factor *F, double *Y, size_t ldy,
                                                  const double *B, size_t ldb, sl_int nrhs,
                                                  sl_work *W);

#endif
/* end src/public/accuracy.h */
/* begin src/public/inverse.h */
/* inverse.h: entries, blocks and bilinear forms of the inverse, without a backward sweep */
#ifndef SL_PUBLIC_INVERSE_H
#define SL_PUBLIC_INVERSE_H

/* With P A P' = L D L', y = L^-1 P b and z = L^-1 P c,
 *
 *     c' A^-1 b = sum over columns k of y(k) z(k) / d(k),
 *
 * where only the common ancestors of b and c in the elimination tree count: a forward sweep for each and no backward
 * sweep. Requests are sorted inside, and near-by ones share one sweep of up to 8 lanes; results come in the caller's
 * order, and equal those of full solves to rounding. What they share depends on what else is asked for in the same call,
 * and so do the last bits.
 *
 * All calls below
 *  F      [in]      a factor of A, n x n.
 *  W      [in,out]  scratch; NULL: allocated for this call.
 *  stats  [out]     b_entries: doubles of L that all sweeps of the call read together; b_supernodes, b_columns: of the
 *                   largest of their reaches; the rest of the plan group is 0. error_row, error_column: an index out
 *                   of range. May be NULL.
 *  Returns  SL_OK; SL_ERR_ARGUMENT: a NULL, a negative count, an index out of range; SL_ERR_STATE: failed factor;
 *           SL_ERR_TOO_LARGE, SL_ERR_MEMORY: W had to grow and could not. On error nothing is written.
 *  Cost     of sweeps 2 b_entries flops a lane; 8 lanes take the time of two to three, which is why many requests in one call
 *           are worth it: a lone pair of far vertices costs what a local solve from one to the other does. Nothing
 *           O(n), but for NULL sets; no allocation once W has grown to the largest reach and 16 bytes a request.
 *  Threads  any number at once on one F, each with its own W.
 *  Source   [HDA17] 5; [Davis06] 3.2, 4.1.
 *  Example  tests/test_inverse.c
 *
 * Many entries are cheaper by selected inversion of the supernodes they reach (selected.h), of which only the fronts
 * under way are kept, and not Z. sl_inverse_diagonal and sl_inverse_pairs count the operations of both and take the shorter
 * way: selected inversion from some hundreds of near-by vertices of a mesh on, or some thousands far apart; for the
 * whole diagonal always. stats say which (inverse_method), with z_supernodes and z_columns in place of the sweeps' numbers
 * where it was that. It uses the threads that F was made with, a pool of the caller's then once for each call that runs
 * at the same time; the bits do not depend on their number. W grows to the fronts under way, 8 (height)^2 bytes each, where
 * height counts a supernode's columns and the rows below: those from the one at hand to its root that have children to
 * come; with several threads, for each of them, and the roots of the subtrees that are shared out, a few dozen.
 *
 * A factor with null pivots that were skipped (SL_SEMIDEFINITE) has the inverse of the matrix without their rows and
 * columns, and 0 in those: A Z A = A where A has no more null vectors than that.
 */

/** Diagonal entries of the inverse: out[k] = (A^-1)(rows[k], rows[k]).
 *
 *  out    [out]  count values.
 *  rows   [in]   count rows of A in 0..n-1, any order, repeated or not; NULL (with count ignored): all n.
 *  Source   [HDA17] 5; [ET75], [SelInv].
 *  Example  tests/test_diagonal.c
 */
SL_API SL_WARN_UNUSED sl_status sl_inverse_diagonal(const sl_factor *F, double *out,
                                                    const sl_int *rows, sl_int count, sl_work *W,
                                                    sl_stats *stats);

/** Entries of the inverse: out[k] = (A^-1)(rows[k], columns[k]).
 *
 *  out    [out]  count values.
 *  rows, columns  [in]  count rows of A each, in 0..n-1, any order, repeated or not. Selected inversion comes in
 *                 question only where all entries have a place in the pattern of L, as those of A have.
 */
SL_API SL_WARN_UNUSED sl_status sl_inverse_pairs(const sl_factor *F, double *out,
                                                 const sl_int *rows, const sl_int *columns,
                                                 sl_int count, sl_work *W, sl_stats *stats);

/** A dense block of the inverse: Z(i, j) = (A^-1)(rows[i], columns[j]).
 *
 *  Z        [out]  n_rows x n_columns, column-major, leading dimension ldz >= n_rows elements.
 *  rows     [in]   n_rows rows of A in 0..n-1, any order, repeated or not.
 *  columns  [in]   n_columns, the same. Where it is the same array as rows, of the same length, each sweep and each
 *                  entry is computed once and the block is exactly symmetric.
 *  Cost     beyond the sweeps n_rows n_columns times the common columns; W holds 128 vectors of the shorter side at
 *           a time, and the longer side is swept again for each further 128 (not where both are one array).
 */
SL_API SL_WARN_UNUSED sl_status sl_inverse_block(const sl_factor *F, double *Z, size_t ldz,
                                                 const sl_int *rows, sl_int n_rows,
                                                 const sl_int *columns, sl_int n_columns,
                                                 sl_work *W, sl_stats *stats);

/** A bilinear form of the inverse: out = c' A^-1 b for sparse b and c.
 *
 *  out   [out]  one value.
 *  cset  [in]   nc rows of A in 0..n-1, any order, those given twice summed; NULL (with nc ignored): all n. c is 0
 *               elsewhere.
 *  c     [in]   nc values.
 *  bset  [in]   nb rows of A, the same.
 *  b     [in]   nb values. Where both sets and both values are the same arrays, b' A^-1 b takes half the operations.
 *               An index out of range is error_row in cset, error_column in bset.
 */
SL_API SL_WARN_UNUSED sl_status sl_inverse_bilinear(const sl_factor *F, double *out,
                                                    const sl_int *cset, const double *c, sl_int nc,
                                                    const sl_int *bset, const double *b, sl_int nb,
                                                    sl_work *W, sl_stats *stats);

#endif
/* end src/public/inverse.h */
/* begin src/public/batch.h */
/* batch.h: many independent solves, with one factor or with several, spread over threads by one call */
#ifndef SL_PUBLIC_BATCH_H
#define SL_PUBLIC_BATCH_H

/** One solve of a batch: a plan and its right-hand sides, or a full solve. */
typedef struct sl_request {
    const sl_plan *plan; /* NULL: b known and x wanted everywhere, as in sl_factor_solve */
    double *X;           /* nx x nrhs (n x nrhs), leading dimension ldx elements */
    size_t ldx;
    const double *B; /* nb x nrhs (n x nrhs), leading dimension ldb elements */
    size_t ldb;
    int is_interleaved; /* 0: X and B column-major; else row-major, as in the calls named interleaved */
    sl_int
        nrhs; /* 0 or more; many right-hand sides are shared out in blocks of 8, like many requests */
    const sl_factor *factor; /* NULL: that of the call */
} sl_request;

/** Answers requests: the bits that sl_plan_solve and sl_factor_solve give, for any number of threads.
 *
 *  One plan on m factors of one analysis is m requests with that plan, each with its own factor and X, and with one B or
 *  each its own.
 *
 *  F         [in]      the factor of the requests that name none; NULL where all do. A plan belongs to the analysis of its
 *                      factor.
 *  requests  [in]      count of them; each X may be its own B (then ldx = ldb), and overlaps nothing else of the batch.
 *  threads   [in]      how many and whose; NULL: the calling thread alone.
 *  works     [in,out]  a workspace for each thread, threads->count of them (1 where that is 0), or NULL: allocated for
 *                      this call.
 *  failed    [out]     the request at fault, or -1; may be NULL. On error no X has been touched.
 *  Returns   SL_OK; SL_ERR_ARGUMENT, also for works that hold a NULL or one workspace twice; SL_ERR_STATE: failed
 *            factor, or a plan that sl_plan_solve refuses; SL_ERR_INCONSISTENT: as in sl_factor_solve; SL_ERR_TOO_LARGE;
 *            SL_ERR_MEMORY.
 *  Cost      that of the solves, shared out by the entries of L that each reads; threads times the largest workspace.
 *            Where right-hand sides have to be consistent, all of them are swept forward once more beforehand.
 *  Threads   as sl_plan_solve.
 *  Example   tests/test_batch.c
 */
SL_API SL_WARN_UNUSED sl_status sl_batch_solve(const sl_factor *F, const sl_request *requests,
                                               sl_int count, const sl_threads *threads,
                                               sl_work *const *works, sl_int *failed);

#endif
/* end src/public/batch.h */
/* begin src/public/several.h */
/* several.h: several matrices of one pattern: weighted sums of value arrays over one analysis, factored and asked by one call */
#ifndef SL_PUBLIC_SEVERAL_H
#define SL_PUBLIC_SEVERAL_H

/* M + t K for many t is one pattern, the union of both. Each term is spread once into an array in the order of the
 * analysis, and a factorization adds weighted arrays up while it reads them: nothing is permuted, sorted or searched for
 * a second time. For m values of t:
 *
 *     sl_csc terms[2] = {M, K};                                  any triangles, any two patterns
 *     sl_matrix_sum(&U, NULL, terms, 2, NULL, NULL);             their union
 *     A = sl_matrix_view(U);  sl_symbolic_create(&S, &A, NULL, NULL);
 *     v[0] = malloc(sl_symbolic_entries(S) * sizeof(double));    v[1] alike
 *     sl_symbolic_spread(S, v[0], &M, NULL);  sl_symbolic_spread(S, v[1], &K, NULL);
 *     for k < m: c[2 k] = 1, c[2 k + 1] = t[k];
 *     sl_batch_factor(F, m, S, c, v, 2, &opt, NULL, NULL);       F: m factors, of M + t[k] K
 *     sl_batch_diagonal(F, m, h, n_rows, rows, n_rows, &opt.threads, NULL, NULL, NULL);
 *
 * A plan belongs to the analysis: it serves all of them, one by one or in a batch whose requests name their factors.
 *
 * Heat-kernel signatures: with M the masses and K = L, the positive semi-definite cotangent Laplacian, one implicit step
 * of length t is (M + t L) u(t) = M u(0). Unit heat put into vertex i is u(0) = e_i / M(i,i), so that the heat kernel is
 * h_t(i,j) = (A_t^-1)(i,j), as near as one step comes, and h_t(i,i) the signature of i at time t: a density, which the
 * masses integrate to 1 over j. A unit temperature is u(0) = e_i, and what is left of it at i, the auto-diffusion of
 * [HDA17] 5, is (A_t^-1)(i,i) M(i,i). To compare times, divide each column by the trace, the sum over all i of
 * (A_t^-1)(i,i) M(i,i).
 */

/** C = c_1 A_1 + .. + c_k A_k of symmetric matrices, stored as its lower triangle, rows ascending.
 *
 *  out           [out]  the matrix, n x n, or NULL on error; release with sl_matrix_free.
 *  coefficients  [in]   count numbers; NULL: the union of the patterns, without values.
 *  terms         [in]   count >= 1 square matrices of one size, each storing any triangle, read as a factorization
 *                       reads it. An entry of the pattern stays, whatever it sums up to.
 *  opt           [in]   allocator; may be NULL.
 *  stats         [out]  error_row, error_column of what is malformed; may be NULL.
 *  Returns  SL_OK; SL_ERR_ARGUMENT: sizes that differ, no term, values missing; SL_ERR_PATTERN; SL_ERR_TOO_LARGE:
 *           2^31 or more entries in all; SL_ERR_MEMORY.
 *  Cost     O(n + entries of all terms).
 *  Threads  any number on distinct outputs.
 *  Example  tests/test_spread.c
 */
SL_API SL_WARN_UNUSED sl_status sl_matrix_sum(sl_matrix **out, const double *coefficients,
                                              const sl_csc *terms, sl_int count,
                                              const sl_options *opt, sl_stats *stats);

/** Length of an array of values in the order of the analysis: nnz_a of its statistics. A NULL S has 0. */
SL_API sl_int sl_symbolic_entries(const sl_symbolic *S);

/** Spreads a matrix over an array in the order of the analysis, zeros where it has no entry.
 *
 *  values  [out]  sl_symbolic_entries(S) doubles; on error untouched. Their order is the map's: a supernode's stand side
 *                 by side. Valid for S alone.
 *  K       [in]   n x n with values, any triangle, read as a factorization reads it: rows in any order, duplicates
 *                 summed. Its pattern is a part of the analysed one; values are not looked at.
 *  stats   [out]  error_row, error_column: an entry that the analysed pattern has not, the first as K stores them, or one
 *                 that is malformed; may be NULL.
 *  Returns  SL_OK; SL_ERR_ARGUMENT: not square, no values; SL_ERR_PATTERN: another size, malformed, both triangles and
 *           unsymmetric, or an entry off the pattern; SL_ERR_TOO_LARGE; SL_ERR_MEMORY.
 *  Cost     O(n + entries of S and of K); memory of the analysis's allocator while it runs.
 *  Threads  reads S; any number on distinct arrays.
 *  Example  tests/test_spread.c
 */
SL_API SL_WARN_UNUSED sl_status sl_symbolic_spread(const sl_symbolic *S, double *values,
                                                   const sl_csc *K, sl_stats *stats);

/** Factors A = coefficients[0] values[0] + .. + coefficients[terms-1] values[terms-1].
 *
 *  The same bits as sl_factor_create over an analysed matrix without duplicates whose entries are these sums, each product
 *  rounded, then added up in this order to a first 0.
 *
 *  out           [out]  the factor, or NULL on error; release with sl_factor_free. As any other.
 *  S             [in]   the analysis; borrowed, must outlive the factor.
 *  coefficients  [in]   terms finite numbers.
 *  values        [in]   terms arrays in the order of S (sl_symbolic_spread); not kept.
 *  terms         [in]   0 or more; a sum of none is the zero matrix.
 *  opt, stats           as in sl_factor_create.
 *  Returns  as sl_factor_create, SL_ERR_PATTERN aside. SL_ERR_NOT_FINITE: a coefficient (error_value, no row), or a sum:
 *           an infinity that meets another or a 0 is a NaN. Such an entry is told as one of the lower triangle:
 *           error_row >= error_column.
 *  Cost     as sl_factor_create; the terms are read once, in order.
 *  Threads  as sl_factor_create.
 *  Example  tests/test_combination.c
 */
SL_API SL_WARN_UNUSED sl_status sl_factor_create_combination(sl_factor **out, const sl_symbolic *S,
                                                             const double *coefficients,
                                                             const double *const *values,
                                                             sl_int terms, const sl_options *opt,
                                                             sl_stats *stats);

/** Factors again with other coefficients or values over the factor's analysis. Allocates nothing.
 *
 *  F        [in,out]  any factor, also one of sl_factor_create. On error it holds no factor, as in sl_factor_refactor.
 *  Returns, Cost      as sl_factor_create_combination, SL_ERR_MEMORY, SL_ERR_TOO_LARGE and SL_ERR_UNSUPPORTED aside.
 *  Threads            nobody else may use F meanwhile.
 */
SL_API SL_WARN_UNUSED sl_status sl_factor_refactor_combination(sl_factor *F,
                                                               const double *coefficients,
                                                               const double *const *values,
                                                               sl_int terms, sl_stats *stats);

/** Factors several combinations of the same terms, spread over threads: the bits of sl_factor_create_combination.
 *
 *  Each thread takes whole factors; those that are left over when every thread has had as many are made by all threads
 *  together, one after the other.
 *
 *  out           [out]  count factors. Where one fails, its out is NULL and the others are made all the same: release
 *                       those. On SL_ERR_ARGUMENT of the whole call (failed = -1) all are NULL.
 *  coefficients  [in]   terms x count, column-major, leading dimension terms: a column a factor.
 *  values, terms [in]   as in sl_factor_create_combination.
 *  opt           [in]   as in sl_factor_create; may be NULL.
 *  failed        [out]  the first that failed, or -1; may be NULL.
 *  stats         [out]  the factor group and the error of that one, or the group of the last; seconds and bytes of all
 *                       together (the seconds that a factor tells of itself count what other threads did meanwhile). May
 *                       be NULL.
 *  Returns  SL_OK; what the first that failed came to, as sl_factor_create_combination.
 *  Cost     that of the factors, shared out; each keeps what a factor keeps.
 *  Threads  as sl_factor_create; memory is asked for by the calling thread alone.
 *  Example  tests/test_batch_factor.c
 */
SL_API SL_WARN_UNUSED sl_status sl_batch_factor(sl_factor **out, sl_int count, const sl_symbolic *S,
                                                const double *coefficients,
                                                const double *const *values, sl_int terms,
                                                const sl_options *opt, sl_int *failed,
                                                sl_stats *stats);

/** Factors several factors of one analysis again. Allocates nothing.
 *
 *  factors   [in,out]  count factors, none twice. One that fails holds no factor; the others are made all the same.
 *  threads   [in]      how many and whose; NULL: the calling thread alone. Factors that have threads of their own are made
 *                      by these, one after the other.
 *  coefficients, values, terms, failed, stats  as in sl_batch_factor.
 *  Returns  SL_OK; SL_ERR_ARGUMENT: also a factor that is NULL or given twice; SL_ERR_STATE: factors of several
 *           analyses; then no factor has been touched. Else what the first that failed came to.
 *  Threads  nobody else may use the factors meanwhile.
 *  Example  tests/test_batch_factor.c
 */
SL_API SL_WARN_UNUSED sl_status sl_batch_refactor(sl_factor *const *factors, sl_int count,
                                                  const double *coefficients,
                                                  const double *const *values, sl_int terms,
                                                  const sl_threads *threads, sl_int *failed,
                                                  sl_stats *stats);

/** Diagonal entries of several inverses: out(i, k) = (A_k^-1)(rows[i], rows[i]), the bits of sl_inverse_diagonal.
 *
 *  factors  [in]      count factors of one analysis; one may be given twice.
 *  out      [out]     n_rows x count, column-major, leading dimension ldo >= n_rows elements. On error untouched.
 *  rows     [in]      n_rows rows of A, any order, repeated or not; NULL (with n_rows ignored): all n.
 *  threads  [in]      how many and whose; NULL: the calling thread alone. Each takes whole factors.
 *  works    [in,out]  a workspace for each thread, as in sl_batch_solve, or NULL: allocated for this call.
 *  failed   [out]     the factor at fault, or -1; may be NULL.
 *  stats    [out]     error_row: an index out of range; may be NULL.
 *  Returns  SL_OK; SL_ERR_ARGUMENT: also a row out of range; SL_ERR_STATE: a failed factor, or several analyses;
 *           SL_ERR_TOO_LARGE; SL_ERR_MEMORY.
 *  Cost     that of sl_inverse_diagonal for each, shared out.
 *  Threads  as sl_inverse_diagonal.
 *  Source   [HDA17] 5.
 *  Example  tests/test_batch_inverse.c
 */
SL_API SL_WARN_UNUSED sl_status sl_batch_diagonal(const sl_factor *const *factors, sl_int count,
                                                  double *out, size_t ldo, const sl_int *rows,
                                                  sl_int n_rows, const sl_threads *threads,
                                                  sl_work *const *works, sl_int *failed,
                                                  sl_stats *stats);

#endif
/* end src/public/several.h */
/* begin src/public/selected.h */
/* selected.h: the selected inverse: entries of A^-1 on the pattern of L, all of them or those that some rows reach */
#ifndef SL_PUBLIC_SELECTED_H
#define SL_PUBLIC_SELECTED_H

/** Computes entries of A^-1 on the pattern of L: the whole diagonal among them, and every entry of A's pattern.
 *
 *  From the roots of the elimination tree to its leaves, supernode by supernode, with dense kernels. Z_kl of
 *  Z = P A^-1 P' is there wherever a supernode's panel has a place for L_kl, relaxation included; for a set of rows
 *  those supernodes alone are computed that lie on the way from the set to the roots. All numbers have the bits that
 *  the whole gives.
 *
 *  out    [out]  the entries, or NULL on error; release with sl_selected_free. They stay what they are when F is
 *                factored again or released, until sl_selected_refill.
 *  F      [in]   the factor; its analysis is borrowed and must outlive the object.
 *  set    [in]   count rows of A in 0..n-1, any order, repetitions allowed; NULL (with count ignored): all n.
 *                An empty set is a pointer that is not NULL with count = 0; nothing is read there.
 *  opt    [in]   allocator, and threads, which the object keeps; no threads there, or NULL: those that F was made with. The
 *                instruction set is the factor's.
 *  stats  [out]  the selected group; error_row: a row out of range; may be NULL.
 *  Returns  SL_OK; SL_ERR_ARGUMENT; SL_ERR_STATE: failed factor; SL_ERR_TOO_LARGE; SL_ERR_MEMORY.
 *  Cost     about twice the flops of the factorization of the same supernodes; z_entries doubles and 28 bytes
 *           a supernode kept, 44 with several threads. While it runs, 8 (height)^2 bytes for each supernode from the one at
 *           hand to its root that has children to come, where height counts its columns and the rows below; with several
 *           threads, for each of them, and for the roots of the subtrees that are shared out, a few dozen.
 *  Threads  reads F; the object is immutable and may be shared. What is computed does not depend on their number.
 *  Source   [ET75]; by supernodes [SelInv].
 *  Example  tests/test_selected.c
 */
SL_API SL_WARN_UNUSED sl_status sl_selected_create(sl_selected **out, const sl_factor *F,
                                                   const sl_int *set, sl_int count,
                                                   const sl_options *opt, sl_stats *stats);

/** Computes the same entries again, of what F holds now, in the same memory.
 *
 *  Z      [in,out]  on error as before.
 *  F      [in]      a factor over the analysis that Z was made for.
 *  W      [in,out]  scratch; NULL: allocated for this call.
 *  Returns  SL_OK; SL_ERR_ARGUMENT; SL_ERR_STATE: failed factor, or one of another analysis; SL_ERR_TOO_LARGE;
 *           SL_ERR_MEMORY.
 *  Cost     as sl_selected_create; no allocation once W has grown. Where fresh memory is slow, twice as fast.
 *  Threads  nobody else may use Z meanwhile; runs on those that Z was made with.
 *  Example  tests/test_selected.c
 */
SL_API SL_WARN_UNUSED sl_status sl_selected_refill(sl_selected *Z, const sl_factor *F, sl_work *W);

/** Releases a selected inverse; NULL is fine. */
SL_API void sl_selected_free(sl_selected *Z);

/** Diagonal entries of A^-1.
 *
 *  Z      [in]
 *  out    [out]  count entries in the order of rows. On error untouched.
 *  rows   [in]   count rows of A in 0..n-1, any order, repetitions allowed; NULL (with count ignored): all n.
 *  stats  [out]  error_row; may be NULL.
 *  Returns  SL_OK; SL_ERR_ARGUMENT: NULL, or a row out of range (error_row); SL_ERR_PATTERN: a row that the object's set
 *           does not reach (error_row).
 *  Cost     O(count), with a logarithm for the object of a set.
 *  Threads  any number at once.
 *  Example  tests/test_selected.c
 */
SL_API SL_WARN_UNUSED sl_status sl_selected_diagonal(const sl_selected *Z, double *out,
                                                     const sl_int *rows, sl_int count,
                                                     sl_stats *stats);

/** Entries (A^-1)_ij on the pattern.
 *
 *  Z        [in]
 *  out      [out]  count entries: out[k] is row rows[k], column columns[k], or the other way round. On error untouched.
 *  rows     [in]   count rows of A in 0..n-1.
 *  columns  [in]   count columns of A in 0..n-1.
 *  stats    [out]  error_row and error_column; may be NULL.
 *  Returns  SL_OK; SL_ERR_ARGUMENT: NULL, or out of range; SL_ERR_PATTERN: an entry that is not there, for the pattern
 *           of L has no place for it or the object's set does not reach it. error_row and error_column name it.
 *  Cost     O(count) binary searches.
 *  Threads  any number at once.
 *  Example  tests/test_selected.c
 */
SL_API SL_WARN_UNUSED sl_status sl_selected_entries(const sl_selected *Z, double *out,
                                                    const sl_int *rows, const sl_int *columns,
                                                    sl_int count, sl_stats *stats);

/** A look inside: arrays that live as long as the object.
 *
 *  The panel of supernode supers[k] begins at Z[begin[k]] and is laid out as those of L, which sl_symbolic_view_t tells;
 *  the diagonal stands in its place, what is above it in a tile means nothing, and padding is 0.
 */
typedef struct sl_selected_view_t {
    const sl_symbolic *symbolic;
    sl_int count;         /* supernodes */
    const sl_int *supers; /* count, ascending */
    const sl_off *begin;  /* count + 1, in doubles */
    const double *Z;      /* begin[count] */
} sl_selected_view_t;

SL_API sl_selected_view_t sl_selected_view(const sl_selected *Z);

#endif
/* end src/public/selected.h */
/* begin src/public/region.h */
/* region.h: regions: parts of the matrix inside which local solves cost the same whatever surrounds them */
#ifndef SL_PUBLIC_REGION_H
#define SL_PUBLIC_REGION_H

/* The path from a vertex to the root of the elimination tree grows with the mesh. A region cuts it off: T, whole
 * subtrees of the tree, and S, the boundary, in which all rows of L below them are. For b and x on T and S
 *
 *     y = L_TT^-1 b_T,  u = b_S - L_ST y,  x_S = (A^-1)_SS u,
 *
 * and the backward sweep goes on inside T. With (A^-1)_SS kept, only L inside T is read, and the answer is that of the
 * full solve to rounding. Of an SL_SEMIDEFINITE factor A^-1 is the generalized inverse that its solves apply: 0 in the
 * rows and columns of null pivots; whether b is consistent is not looked at where null rows are outside of the region.
 */

/** Makes the region for a set of rows: what solves with b and x there need of the inverse.
 *
 *  The subtrees are chosen so that a solve with b and x on the whole set reads as little as it can: few large subtrees
 *  have a short boundary and a long way through L, no subtree at all makes the set itself the boundary. Other rows
 *  that happen to be in the subtrees are in the region too.
 *
 *  out    [out]  the region, or NULL on error; release with sl_region_free. For options.region of sl_plan_create.
 *  F      [in]   the factor; it and its analysis are borrowed and must outlive the object. Once it is factored again,
 *                or begun to be, plans in the region are refused until sl_region_refill.
 *  set    [in]   count rows of A in 0..n-1, any order, repetitions allowed; NULL (with count ignored): all n.
 *                An empty set is a pointer that is not NULL with count = 0; nothing is read there.
 *  Z      [in]   a selected inverse of what F holds now, or NULL. It is read where it has all that is needed, as for
 *                a single row or the subtree of one supernode, which then is taken if it costs a solve no more than
 *                twice as much. Otherwise the entries come from forward sweeps, as those of sl_inverse_block.
 *  opt    [in]   allocator, region_bytes; may be NULL. Subtrees are chosen so that bytes_region keeps within
 *                region_bytes; with no boundary at all, which always is possible, solves go to the roots of the tree.
 *  stats  [out]  the region group; error_row: a row out of range; may be NULL.
 *  Returns  SL_OK; SL_ERR_ARGUMENT; SL_ERR_STATE: failed factor, or Z is not of F as it is; SL_ERR_UNSUPPORTED: a factor
 *           whose solves are centred (options.mass); SL_ERR_TOO_LARGE; SL_ERR_MEMORY.
 *  Cost     a plan for the set; and a forward sweep of 8 lanes to the roots for every 8 rows of the boundary, with
 *           (boundary)^2 / 2 times the columns of such a path for the sums, or a binary search an entry of Z.
 *           4 (boundary)^2 bytes kept, and some 100 a row of the boundary.
 *  Threads  reads F and Z.
 *  Source   [HDA17] 3 for the sweeps; what is above T enters as a Schur complement, whose inverse is (A^-1)_SS.
 *  Example  tests/test_region.c
 */
SL_API SL_WARN_UNUSED sl_status sl_region_create(sl_region **out, const sl_factor *F,
                                                 const sl_int *set, sl_int count,
                                                 const sl_selected *Z, const sl_options *opt,
                                                 sl_stats *stats);

/** Computes the numbers of a region again, of what F holds now, in the same memory; its plans hold on.
 *
 *  R      [in,out]  on error as before.
 *  F      [in]      a factor over the analysis that R was made for: from now on the only one that fits.
 *  Z      [in]      as in sl_region_create; may be NULL.
 *  W      [in,out]  scratch; NULL: allocated for this call.
 *  Returns  SL_OK; SL_ERR_ARGUMENT; SL_ERR_STATE: failed factor, one of another analysis, or Z is not of F as it is;
 *           SL_ERR_UNSUPPORTED: as there; SL_ERR_TOO_LARGE; SL_ERR_MEMORY.
 *  Cost     as sl_region_create, less the plan; no allocation once W has grown.
 *  Threads  nobody else may use R, or a plan in it, meanwhile.
 *  Example  tests/test_region.c
 */
SL_API SL_WARN_UNUSED sl_status sl_region_refill(sl_region *R, const sl_factor *F,
                                                 const sl_selected *Z, sl_work *W);

/** Releases a region; NULL is fine. */
SL_API void sl_region_free(sl_region *R);

/** Fills the region group of stats again. */
SL_API void sl_region_stats(const sl_region *R, sl_stats *stats);

/** A look inside: arrays that live as long as the object. */
typedef struct sl_region_view_t {
    const sl_symbolic *symbolic;
    sl_int n_roots;
    const sl_int *roots; /* n_roots supernodes, ascending: the subtrees inside hang from them */
    sl_int n_boundary;
    const sl_int *boundary; /* n_boundary rows of A, in the order of elimination */
} sl_region_view_t;

SL_API sl_region_view_t sl_region_view(const sl_region *R);

#endif
/* end src/public/region.h */
#ifdef __cplusplus
}
#endif
#endif /* SPARSE_LOCAL_H */

/* ---- bodies, in one source file ---- */
#if (defined(SPARSE_LOCAL_IMPLEMENTATION) || defined(SL_STATIC)) &&                                \
    !defined(SPARSE_LOCAL_IMPLEMENTED)
#define SPARSE_LOCAL_IMPLEMENTED
/* L0 ground */
/* begin src/impl/base.h */
/* base.h: the system headers, everything that depends on the compiler, and small integer helpers */
#ifndef SLI_BASE_H
#define SLI_BASE_H

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
/* end src/impl/base.h */
/* begin src/impl/status.h */
/* status.h: status codes in words, and the error fields of stats */
#ifndef SLI_STATUS_H
#define SLI_STATUS_H

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
    }
    return "unknown status";
}

/* Every call that takes stats starts by forgetting the last error. */
SLI_INLINE void sli_stats_clear_error(sl_stats *stats) {
    if (stats != NULL) {
        stats->error_row = -1;
        stats->error_column = -1;
        stats->error_line = -1;
        stats->error_value = 0.0;
    }
}

/* Names the entry at fault and passes the status on. */
SLI_INLINE sl_status sli_fail_at(sl_stats *stats, sl_status status, sl_int row, sl_int column,
                                 double value) {
    if (stats != NULL) {
        stats->error_row = row;
        stats->error_column = column;
        stats->error_value = value;
    }
    return status;
}

#endif
/* end src/impl/status.h */
/* begin src/impl/alloc.h */
/* alloc.h: memory: 64-byte aligned blocks that cannot overflow, cut into arrays in one go */
#ifndef SLI_ALLOC_H
#define SLI_ALLOC_H

#define SLI_ALIGN ((size_t)64) /* a cache line, and the widest register */

/* Large blocks in huge pages, where the system gives them: on a factor of 34 to 410 MB full solves
 * took 20 to 23 % less time, refactorizations 3 %. */
#define SLI_HUGE_BLOCK ((size_t)4 << 20)
#define SLI_PAGE ((size_t)65536) /* a multiple of what systems have */

SLI_INLINE void sli_ask_huge_pages(void *block, size_t bytes) {
#if defined(SLI_HUGE_PAGES)
    if (block != NULL && bytes >= SLI_HUGE_BLOCK) {
        const size_t skipped = (SLI_PAGE - (uintptr_t)block % SLI_PAGE) % SLI_PAGE;
        const int keep = errno;
        (void)sli_madvise((char *)block + skipped, (bytes - skipped) / SLI_PAGE * SLI_PAGE,
                          SLI_HUGE_PAGES);
        errno = keep; /* a refusal changes nothing */
    }
#else
    (void)block;
    (void)bytes;
#endif
}

SLI_INLINE void *sli_malloc_default(void *context, size_t bytes) {
    void *block = malloc(bytes);
    (void)context;
    sli_ask_huge_pages(block, bytes);
    return block;
}

SLI_INLINE void sli_free_default(void *context, void *block) {
    (void)context;
    free(block);
}

/* Whether the caller gives both functions of an allocator, or none. */
SLI_INLINE int sli_allocator_is_whole(const sl_options *opt) {
    return opt == NULL || (opt->allocator.allocate == NULL) == (opt->allocator.release == NULL);
}

/* The caller's allocator, or malloc and free. */
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

/* bytes > 0 of aligned memory, or NULL. The pointer that the allocator gave stands just before the
 * block. */
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

/* A block to be cut into arrays. A layout function runs twice over it: with base NULL it only
 * counts, with the block allocated it hands out the pointers, so that sizes are written once. */
typedef struct sli_block {
    unsigned char *base;
    size_t used;
    int overflow;
} sli_block;

/* The next array of count elements of size bytes; NULL while counting. Counts come in 64 bits:
 * those of L may pass 2^32 where size_t has no more than that. */
SLI_INLINE void *sli_take(sli_block *b, uint64_t count, size_t size) {
    size_t at = b->used, bytes;
    if (size != 0 && count > (SIZE_MAX - SLI_ALIGN) / size) {
        b->overflow = 1;
        return NULL;
    }
    bytes = ((size_t)count * size + SLI_ALIGN - 1) / SLI_ALIGN * SLI_ALIGN;
    if (bytes > SIZE_MAX - b->used) {
        b->overflow = 1;
        return NULL;
    }
    b->used += bytes;
    return b->base == NULL ? NULL : b->base + at;
}

/* Allocates what was counted and rewinds for the second run; at least one byte, so that NULL means
 * failure. */
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

/* Arrays of the two index types and of doubles, cut from a block. */
#define SLI_TAKE(b, type, count) ((type *)sli_take((b), (uint64_t)(count), sizeof(type)))

#endif
/* end src/impl/alloc.h */
/* begin src/impl/sort.h */
/* sort.h: sorts keyed numbers: insertion for a few, radix for many */
#ifndef SLI_SORT_H
#define SLI_SORT_H

/* A row, column or supernode in the upper half, what belongs to it in the lower: one word to move.
 */
SLI_INLINE uint64_t sli_keyed(sl_int key, sl_int value) {
    return (uint64_t)(uint32_t)key << 32 | (uint32_t)value;
}

SLI_INLINE sl_int sli_key(uint64_t keyed) {
    return (sl_int)(keyed >> 32);
}

SLI_INLINE sl_int sli_value(uint64_t keyed) {
    return (sl_int)(uint32_t)(keyed & 0xffffffffu);
}

/* How many of count ascending numbers are below a bound. */
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

#define SLI_SORT_SMALL                                                                             \
    48 /* below this the 256 counters of a radix pass cost more than the moves of insertion */

/* Sorts by key, ascending, keys non-negative; equal keys stay in order. scratch holds count more.
 * O(count) a byte. */
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

#endif
/* end src/impl/sort.h */
/* begin src/impl/cpu.h */
/* cpu.h: which instruction sets this processor and operating system run */
#ifndef SLI_CPU_H
#define SLI_CPU_H

#if defined(SLI_X86)
/* The register states that the operating system saves: XCR0. */
SLI_INLINE unsigned sli_xcr0(void) {
    unsigned low, high;
    __asm__ volatile("xgetbv" : "=a"(low), "=d"(high) : "c"(0));
    return low;
}
#endif

/* The best instruction set here. CPUID traps under a hypervisor (microseconds), so this runs once a
 * factor. */
static sl_isa sli_cpu_best(void) {
#if defined(SLI_X86)
    unsigned a, b, c, d, xcr0;
    const unsigned osxsave_avx_fma = (1u << 27) | (1u << 28) | (1u << 12);
    if (!__get_cpuid(1, &a, &b, &c, &d) || (c & osxsave_avx_fma) != osxsave_avx_fma) {
        return SL_ISA_SCALAR;
    }
    xcr0 = sli_xcr0();
    if ((xcr0 & 0x6u) != 0x6u || !__get_cpuid_count(7, 0, &a, &b, &c, &d) || !(b & (1u << 5))) {
        return SL_ISA_SCALAR;
    }
    return (xcr0 & 0xe6u) == 0xe6u && (b & (1u << 16)) ? SL_ISA_AVX512 : SL_ISA_AVX2;
#elif defined(SLI_ARM)
    return SL_ISA_NEON;
#else
    return SL_ISA_SCALAR;
#endif
}

#endif
/* end src/impl/cpu.h */
/* begin src/impl/parallel.h */
/* parallel.h: the same work for several workers at once: by the caller's pool, by OpenMP, or one after the other */
#ifndef SLI_PARALLEL_H
#define SLI_PARALLEL_H

/* Workers that a wish for threads comes to. */
SLI_INLINE sl_int sli_workers(const sl_threads *t) {
#if !defined(_OPENMP)
    if (t->run == NULL) {
        return 1;
    }
#endif
    return sli_max(t->count, 1);
}

/* body(data, k) for k = 0 .. count-1. */
static void sli_parallel(const sl_threads *t, sl_int count, void (*body)(void *data, sl_int k),
                         void *data) {
    sl_int k;
    if (count > 1 && t->run != NULL) {
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

/* Where worker k's part of the row tiles first .. last-1 begins: parts are equal, or, where the rows grow
 * longer as in a triangle, of equal area. */
static sl_int sli_part(sl_int first, sl_int last, sl_int k, sl_int workers, int is_triangle) {
    const double share = (double)k / workers;
    return first + (sl_int)((last - first) * (is_triangle ? sqrt(share) : share));
}

#endif
/* end src/impl/parallel.h */
/* L1 kernels: raw arrays only */
/* begin src/impl/kernels.h */
/* kernels.h: the contract of the numerical kernels: panels, steps, sweeps, and the table that an ISA fills */
#ifndef SLI_KERNELS_H
#define SLI_KERNELS_H

/* Panels. Supernode s, w columns and u rows below them, is stored as row tiles of 8,
 * [tile][column][8], whatever the ISA: local row r of column j stands in tile r/8, lane r%8. Tiles
 * of the diagonal block keep only their first 8 (tile + 1) columns; the unit diagonal, what is
 * above it, and the padding of the last tile are 0. */
#define SLI_TILE 8

/* Bytes between what a solve reads of L and what it asks for ahead. Small supernodes are read too
 * slowly for the hardware to run ahead far enough, and at every page it starts anew. */
#define SLI_AHEAD 4096

/* A sweep of so few steps is taken for one that finds L in a cache. There two row tiles at a time are
 * faster; from main memory only the strict order of the panels keeps the hardware reading ahead. The
 * numbers are the same. */
#define SLI_FEW_STEPS 4096

/* Where tile t of a panel of w columns starts, in doubles: the trapezoid grows until it is w
 * columns wide. */
SLI_INLINE sl_off sli_tile_offset(sl_int w, sl_int t) {
    sl_off whole = w / SLI_TILE, tile = t;
    return tile <= whole ? 32 * tile * (tile + 1)
                         : 32 * whole * (whole + 1) + (tile - whole) * SLI_TILE * w;
}

/* Tiles that hold a number of rows. */
SLI_INLINE sl_int sli_tiles(sl_int rows) {
    return rows / SLI_TILE + (rows % SLI_TILE != 0);
}

/* Doubles of a panel of w columns and u rows below them. */
SLI_INLINE sl_off sli_panel_size(sl_int w, sl_int u) {
    return sli_tile_offset(w, sli_tiles(w + u));
}

/* Where local row r of column j stands in a panel of w columns. */
SLI_INLINE sl_off sli_panel_at(sl_int w, sl_int r, sl_int j) {
    return sli_tile_offset(w, r / SLI_TILE) + (sl_off)j * SLI_TILE + r % SLI_TILE;
}

/* One supernode of a reach. A sweep's vector x holds only the columns of its reach, closely packed;
 * a whole analysis is the reach in which base is the column itself. A supernode is entered at a
 * whole tile, so that a local sweep does the same operations in the same order as the full one,
 * which computes with zeros where the local one has nothing. */
typedef struct sli_step {
    sl_off panel;      /* position of the panel in L */
    sl_int column;     /* first column needed: 8 first_tile columns into the supernode */
    sl_int base;       /* where that column stands in x */
    sl_int width;      /* columns of the supernode */
    sl_int below;      /* rows below them; their places in x come with the sweep, step after step */
    sl_int first_tile; /* tiles and columns before it are not needed */
    sl_int up;         /* the step of the parent supernode, -1 at a root */
} sli_step;

/* Columns of x that a step owns. */
SLI_INLINE sl_int sli_step_columns(const sli_step *s) {
    return s->width - SLI_TILE * s->first_tile;
}

/* Right-hand sides are interleaved: row i of x is x[i lanes] .. x[i lanes + lanes - 1], lanes = 1,
 * 2, 4 or 8. */
enum { SLI_LANES_1, SLI_LANES_2, SLI_LANES_4, SLI_LANES_8, SLI_LANES_COUNT };

/* x := L^-1 x over the steps, ascending. rows: places of the rows below, in step order.
 * scratch: sli_scratch_size doubles for the tallest step, 64-byte aligned. */
typedef void (*sli_forward_kernel)(sl_int count, const sli_step *steps, const sl_int *rows,
                                   const double *L, double *x, double *scratch);

/* x := L'^-1 D^-1 x over the steps, descending. rows_end: one past the last place of the last step.
 */
typedef void (*sli_backward_kernel)(sl_int count, const sli_step *steps, const sl_int *rows_end,
                                    const double *L, const double *D, double *x, double *scratch);

/* Row q of a panel, up-looking: on entry the panel holds A there and x minus the updates so far;
 * turns the row into L, passes its updates on to the rows above q in x, clears x on the supernode's
 * columns. D: the supernode's pivots. *pivot loses the row's share l' D l of the pivot; *magnitude
 * gains its absolute value. */
typedef void (*sli_row_kernel)(double *panel, sl_int width, sl_int q, const sl_int *rows,
                               const double *D, double *x_super, double *x, double *scratch,
                               double *pivot, double *magnitude);

/* Doubles of scratch that a step of some height (width + below) and width needs: the rows in one or
 * two lanes, and for those 8 partial sums of every column; more lanes work upon x itself, and keep
 * only the rows of one tile. */
SLI_INLINE size_t sli_scratch_size(sl_int height, sl_int width, sl_int lanes) {
    const size_t tile = SLI_TILE;
    return lanes > 2 ? tile * (size_t)lanes
                     : tile * ((size_t)sli_tiles(height) * (size_t)lanes + (size_t)width);
}

/* The rows that a lanes kernel keeps in registers at once, 4 or 8: op(0, k) op(1, k) .., and halves
 * from the last down. */
#define SLI_EACH4(op, k) op(0, k) op(1, k) op(2, k) op(3, k)
#define SLI_EACH8(op, k) SLI_EACH4(op, k) op(4, k) op(5, k) op(6, k) op(7, k)
#define SLI_EACH4_AGAIN(op, k) op(0, k) op(1, k) op(2, k) op(3, k)
#define SLI_EACH8_AGAIN(op, k) SLI_EACH4_AGAIN(op, k) op(4, k) op(5, k) op(6, k) op(7, k)
#define SLI_HIGH4(op, k) op(3, k) op(2, k)
#define SLI_HIGH8(op, k) op(7, k) op(6, k) op(5, k) op(4, k)
#define SLI_LOW4(op, k) op(1, k) op(0, k)
#define SLI_LOW8(op, k) op(3, k) op(2, k) op(1, k) op(0, k)

/* Calls one of 8 copies of a body that is compiled for a constant number of columns, w = 1 .. 8. */
#define SLI_CASE(k, call)                                                                          \
    case k:                                                                                        \
        call(k);                                                                                   \
        break;
#define SLI_CASES(call)                                                                            \
    switch (w) {                                                                                   \
        SLI_CASE(1, call)                                                                          \
        SLI_CASE(2, call)                                                                          \
        SLI_CASE(3, call)                                                                          \
        SLI_CASE(4, call)                                                                          \
        SLI_CASE(5, call)                                                                          \
        SLI_CASE(6, call)                                                                          \
        SLI_CASE(7, call)                                                                          \
    default:                                                                                       \
        call(8);                                                                                   \
    }

/* Fronts. The front of a supernode of w columns and u rows below is its panel and its update
 * matrix: the lower triangle, by tiles as in a panel, over the same row tiles from tile w/8 on, so
 * that the rows below keep their lanes. What its first w % 8 rows and columns and the part above the
 * diagonal hold means nothing. */

/* Where row tile t of a triangle starts, in doubles. */
SLI_INLINE sl_off sli_triangle_offset(sl_int t) {
    return 32 * (sl_off)t * (t + 1);
}

/* Row tiles of the update matrix of w columns and u rows below. */
SLI_INLINE sl_int sli_update_tiles(sl_int w, sl_int u) {
    return u == 0 ? 0 : sli_tiles(w % SLI_TILE + u);
}

/* Column tiles that are updated together, and columns they are updated by at a time: what a row tile
 * needs of a chunk is 16 KB, what the group needs is 128 KB. */
#define SLI_GROUP 8
#define SLI_CHUNK 256

/* Doubles of scratch for fronts of some width. */
SLI_INLINE sl_int sli_front_scratch(sl_int width) {
    return SLI_GROUP * SLI_TILE * sli_min(width, SLI_CHUNK);
}

/* Doubles of a front's inverse. */
#define SLI_FRONT_INVERSE (2 * SLI_GROUP * SLI_TILE)

/* What becomes of a pivot that is null, or of the wrong sign. Its arrays go by the column of L. */
typedef struct sli_pivot_rule {
    double null_tolerance;
    int replaces;          /* anything at all; else null pivots are the caller's to find */
    double regularization; /* 0: a null pivot becomes SLI_NULL_PIVOT */
    signed char *signs;    /* n: 1, -1, or 0 where either will do; NULL: all 1 */
    double *shifts;        /* n: what regularization added to each pivot; NULL: there is none */
} sli_pivot_rule;

typedef struct sli_front {
    double *panel;
    sl_int width, below;
    double *update;
    double *D;         /* width pivots */
    double *magnitude; /* 8 a tile: what each diagonal entry was made of, in absolute value */
    double *inverse;   /* 16 a column tile: 1/d, or 0 first where they are out of range; -sign d */
    const sli_pivot_rule *rule;
    sl_int column; /* the first of the supernode */
} sli_front;

/* Stands for a null pivot that is skipped: so large that what is divided by it is nothing, and 0 times
 * it is still 0. */
#define SLI_NULL_PIVOT DBL_MAX

/* Is a pivot null against the magnitude of what it was made of? Terms that overflow in magnitude and
 * not in sum tell nothing about what was lost. */
SLI_INLINE int sli_is_null(double pivot, double magnitude, double tolerance) {
    const double size = fabs(pivot);
    return size == 0.0 || (sli_is_finite(magnitude) && size <= tolerance * magnitude);
}

/* The pivot of column k by a rule that replaces. A regularized one has the size of what it was made of, times a
 * factor: a scaling of A changes nothing. One whose wrong sign is no rounding error is only turned: made small
 * it would let L grow beyond all bounds. Never inlined: it would cost definite matrices up to 8 percent. */
SLI_APART static double sli_pivot_ruled(const sli_pivot_rule *rule, sl_int k, double d,
                                        double magnitude) {
    const int is_null = sli_is_null(d, magnitude, rule->null_tolerance);
    int sign = rule->signs == NULL ? 1 : rule->signs[k];
    double least;
    if (rule->regularization == 0.0) {
        return is_null ? SLI_NULL_PIVOT : d;
    }
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

/* The steps of a front, group after group of column tiles c0 .. c0 + SLI_GROUP - 1, then the rest. On
 * entry panel and update hold A and what the children hand over, magnitude their absolute values. At
 * the end the panel holds L, D the pivots, update has lost L D L'; magnitude is that of the pivot in
 * the rows of the panel and has gained |L D L'| in the others. Every row tile goes its own way, so
 * that row tiles may be shared out. Null pivots are the caller's to find. */

/* A group's row tiles of pivots. */
typedef void (*sli_pivots_kernel)(const sli_front *f, sl_int c0, double *scratch);

/* A group's row tiles t0 .. t1-1, all below its pivots. */
typedef void (*sli_rows_kernel)(const sli_front *f, sl_int c0, sl_int t0, sl_int t1,
                                double *scratch);

/* Row tiles t0 .. t1-1 and column tiles c0 .. c1-1 of the triangle that starts at tile c0, all in or
 * below the last tile of pivots: of the update matrix, or of a part of it. */
typedef void (*sli_update_kernel)(const sli_front *f, sl_int c0, sl_int c1, sl_int t0, sl_int t1,
                                  double *scratch);

/* Adds rows first .. last-1 of a descendant's update matrix, columns up to the row or to columns-1, to
 * a front; the first `skipped` rows and columns of the matrix mean nothing, and row 0 comes after
 * them. places: the local row in the front of each row, ascending. No two calls for one front may run
 * at once on rows of one tile. */
typedef void (*sli_assemble_kernel)(const sli_front *f, const double *from, sl_int skipped,
                                    const sl_int *places, sl_int columns, sl_int first,
                                    sl_int last);

/* sums(i, j) -= y(k, i) z(k, j) over `count` rows of 8 lanes each; sums is 8 x 8 by rows. All 64-byte
 * aligned. */
typedef void (*sli_products_kernel)(sl_int count, const double *y, const double *z, double *sums);

/* Fronts of the inverse Z of P A P'. That of a supernode holds Z of its columns and the rows below, h in
 * all, both triangles: row tiles [tile][h][8], numbered as in the panel. */
typedef struct sli_dual {
    const double *panel; /* L and .. */
    const double *D;     /* .. its pivots */
    double *front;
    sl_int width, below;
    sl_int first; /* groups of columns before this one are left out */
} sli_dual;

/* Where row tile t of a front of the inverse of h rows starts, in doubles. */
SLI_INLINE ptrdiff_t sli_square_offset(sl_int h, sl_int t) {
    return (ptrdiff_t)SLI_TILE * h * t;
}

/* Column tiles, and columns, that are completed together: a group; doubles of a row tile of their L'^-1. */
#define SLI_DUAL_GROUP 16
#define SLI_DUAL_COLUMNS (SLI_DUAL_GROUP * SLI_TILE)
#define SLI_DUAL_ROW (SLI_DUAL_COLUMNS * SLI_TILE)

/* The first column of the last group, columns of the group that starts at j0. */
SLI_INLINE sl_int sli_dual_last(const sli_dual *f) {
    return (f->width - 1) / SLI_DUAL_COLUMNS * SLI_DUAL_COLUMNS;
}
SLI_INLINE sl_int sli_dual_columns(const sli_dual *f, sl_int j0) {
    return sli_min(SLI_DUAL_COLUMNS, f->width - j0);
}

/* Scratch of a group: N and P, SLI_DUAL_GROUP rows each, then W: where it starts, doubles from a column tile to the
 * next, and doubles of all for supernodes of some height and width. */
SLI_INLINE double *sli_dual_weights(double *scratch) {
    return scratch + 2 * SLI_DUAL_GROUP * SLI_DUAL_ROW;
}
SLI_INLINE ptrdiff_t sli_dual_stride(const sli_dual *f, sl_int j0) {
    const sl_int above = (j0 + sli_dual_columns(f, j0)) / SLI_TILE;
    return SLI_TILE * SLI_TILE * (ptrdiff_t)(sli_tiles(f->width + f->below) - above);
}
SLI_INLINE sl_off sli_dual_scratch(sl_int height, sl_int width) {
    return 2 * SLI_DUAL_GROUP * SLI_DUAL_ROW + (sl_off)SLI_TILE * SLI_TILE *
                                                   sli_min(sli_tiles(width), SLI_DUAL_GROUP) *
                                                   sli_tiles(height);
}

/* Z of the rows below a supernode, row tiles t0 .. t1-1, out of the front of its parent of that height; places: their
 * rows there, ascending. */
typedef void (*sli_gather_kernel)(const sli_dual *f, const double *from, sl_int height,
                                  const sl_int *places, sl_int t0, sl_int t1);

/* The rest of the front, by Takahashi's equations, group after group of columns J, the last one first, with S all rows
 * after it. With N = -L_JJ'^-1, P = -N D^-1 and W = L_SJ L_JJ^-1: Z_SJ = -Z_SS W, Z_JJ = P N' - W' Z_SJ. */
typedef void (*sli_takahashi_kernel)(const sli_dual *f, double *scratch);

/* The parts of a group, one after the other, each of which may be shared out by row tiles. */
typedef enum sli_dual_part {
    SLI_DUAL_INVERSE = 0, /* N and P: tiles of the group */
    SLI_DUAL_WEIGHTS,     /* W: tiles of S */
    SLI_DUAL_PRODUCT,     /* Z_SJ: tiles of S */
    SLI_DUAL_MIRROR,      /* Z_JS: tiles of S */
    SLI_DUAL_SQUARE       /* Z_JJ: tiles of the group */
} sli_dual_part;
#define SLI_DUAL_PARTS 5

typedef struct sli_span {
    sl_int first, last;
} sli_span;

/* The row tiles of a part: first .. last-1. */
SLI_INLINE sli_span sli_dual_span(const sli_dual *f, sl_int j0, sli_dual_part part) {
    const sl_int m = sli_dual_columns(f, j0), h = f->width + f->below;
    sli_span span = {0, sli_tiles(m)};
    if (part != SLI_DUAL_INVERSE && part != SLI_DUAL_SQUARE) {
        span.last = j0 + m < h ? sli_tiles(h) : 0;
        span.first = sli_min((j0 + m) / SLI_TILE, span.last);
    }
    return span;
}

/* Row tiles t0 .. t1-1 of one part. */
typedef void (*sli_dual_kernel)(const sli_dual *f, sl_int j0, sli_dual_part part, sl_int t0,
                                sl_int t1, double *scratch);

/* Numbers that stand side by side, spread over the lanes of a tile one by one: where no instruction
 * does it. */
#define SLI_SPREAD_PLAIN(mask, lanes, count)                                                       \
    const sl_int *lanes_ = (lanes), count_ = (count);                                              \
    (void)(mask);
#define SLI_SPREAD_ADD_PLAIN(to, from)                                                             \
    {                                                                                              \
        double *to_ = (to);                                                                        \
        const double *from_ = (from);                                                              \
        sl_int i_;                                                                                 \
        for (i_ = 0; i_ < count_; i_++) {                                                          \
            to_[lanes_[i_]] += from_[i_];                                                          \
        }                                                                                          \
    }

typedef struct sli_kernels {
    sl_isa isa;
    sli_forward_kernel forward[SLI_LANES_COUNT];
    sli_backward_kernel backward[SLI_LANES_COUNT];
    sli_row_kernel row;
    sli_pivots_kernel pivots;
    sli_rows_kernel rows;
    sli_update_kernel update;
    sli_assemble_kernel assemble;
    sli_products_kernel products;
    sli_gather_kernel gather;
    sli_dual_kernel dual;
    sli_takahashi_kernel takahashi;
} sli_kernels;

#endif
/* end src/impl/kernels.h */
/* begin src/impl/isa_scalar.h */
/* isa_scalar.h: the kernels in plain C: an octet is an array */
#ifndef SLI_ISA_SCALAR_H
#define SLI_ISA_SCALAR_H

#define SLV_NAME(f) sli_##f##_scalar
#define SLV_ISA SL_ISA_SCALAR
#define SLV_FUNCTION
#define SLV_FNMA1(a, b, c) ((c) - (a) * (b)) /* c - a b */
#define SLV_DECLARE(a) double a[SLI_TILE];
#define SLV_ZERO(a)                                                                                \
    {                                                                                              \
        int i_;                                                                                    \
        for (i_ = 0; i_ < SLI_TILE; i_++) {                                                        \
            a[i_] = 0.0;                                                                           \
        }                                                                                          \
    }
#define SLV_LOAD(a, p) memcpy(a, (p), sizeof a);
#define SLV_STORE(p, a) memcpy((p), a, sizeof a);
#define SLV_STORE_ANY(p, a) SLV_STORE(p, a)
#define SLV_ADD(a, b)                                                                              \
    {                                                                                              \
        int i_;                                                                                    \
        for (i_ = 0; i_ < SLI_TILE; i_++) {                                                        \
            a[i_] += b[i_];                                                                        \
        }                                                                                          \
    }
#define SLV_AXPY(a, l, p)                                                                          \
    {                                                                                              \
        const double s_ = *(p);                                                                    \
        int i_;                                                                                    \
        for (i_ = 0; i_ < SLI_TILE; i_++) {                                                        \
            a[i_] -= (l)[i_] * s_;                                                                 \
        }                                                                                          \
    }
#define SLV_DOT(a, l, v)                                                                           \
    {                                                                                              \
        int i_;                                                                                    \
        for (i_ = 0; i_ < SLI_TILE; i_++) {                                                        \
            a[i_] -= (l)[i_] * v[i_];                                                              \
        }                                                                                          \
    }
#define SLV_LOAD_PART(a, p, count, rest)                                                           \
    {                                                                                              \
        double part_[SLI_TILE];                                                                    \
        sl_int i_;                                                                                 \
        for (i_ = 0; i_ < SLI_TILE; i_++) {                                                        \
            part_[i_] = i_ < (count) ? (p)[i_] : (rest);                                           \
        }                                                                                          \
        memcpy(a, part_, sizeof part_);                                                            \
    }
#define SLV_FIRST(a, count)                                                                        \
    {                                                                                              \
        double part_[SLI_TILE];                                                                    \
        sl_int i_;                                                                                 \
        memcpy(part_, a, sizeof part_);                                                            \
        for (i_ = (count); i_ < SLI_TILE; i_++) {                                                  \
            part_[i_] = 0.0;                                                                       \
        }                                                                                          \
        memcpy(a, part_, sizeof part_);                                                            \
    }
#define SLV_LANE(b, a, k)                                                                          \
    {                                                                                              \
        int i_;                                                                                    \
        for (i_ = 0; i_ < SLI_TILE; i_++) {                                                        \
            b[i_] = a[k];                                                                          \
        }                                                                                          \
    }
#define SLV_GATHER(a, x, at)                                                                       \
    {                                                                                              \
        int i_;                                                                                    \
        for (i_ = 0; i_ < SLI_TILE; i_++) {                                                        \
            a[i_] = (x)[at(i_)];                                                                   \
        }                                                                                          \
    }
#define SLV_SUM_DECLARE(a) double a;
#define SLV_SUM_ZERO(a) a = 0.0;
#define SLV_SUM_LOAD(a, p) a = *(p);
#define SLV_SUM_STORE(p, a) *(p) = a;
#define SLV_SUM_DOT(a, l, v)                                                                       \
    a -= ((l)[0] * v[0] + (l)[1] * v[1]) + ((l)[2] * v[2] + (l)[3] * v[3]) +                       \
         (((l)[4] * v[4] + (l)[5] * v[5]) + ((l)[6] * v[6] + (l)[7] * v[7]));
#define SLV_SUMS(r, a)                                                                             \
    r[0] = a##0, r[1] = a##1, r[2] = a##2, r[3] = a##3;                                            \
    r[4] = a##4, r[5] = a##5, r[6] = a##6, r[7] = a##7;
#define SLV_TRANSPOSE(to, from)                                                                    \
    {                                                                                              \
        int i_, k_;                                                                                \
        for (i_ = 0; i_ < SLI_TILE; i_++) {                                                        \
            for (k_ = 0; k_ < SLI_TILE; k_++) {                                                    \
                (to)[SLI_TILE * i_ + k_] = (from)[SLI_TILE * k_ + i_];                             \
            }                                                                                      \
        }                                                                                          \
    }
#define SLV_TILES 1
#define SLV_COLUMNS 4
#define SLV_EACH_COLUMN SLI_EACH4
#define SLV_LOAD_PINNED(a, p) SLV_LOAD(a, p)
#define SLV_FNMA(a, b, c)                                                                          \
    {                                                                                              \
        int i_;                                                                                    \
        for (i_ = 0; i_ < SLI_TILE; i_++) {                                                        \
            a[i_] -= b[i_] * c[i_];                                                                \
        }                                                                                          \
    }
#define SLV_BROADCAST(b, p)                                                                        \
    {                                                                                              \
        int i_;                                                                                    \
        for (i_ = 0; i_ < SLI_TILE; i_++) {                                                        \
            b[i_] = *(p);                                                                          \
        }                                                                                          \
    }
#define SLV_MULTIPLY(a, b, c)                                                                      \
    {                                                                                              \
        int i_;                                                                                    \
        for (i_ = 0; i_ < SLI_TILE; i_++) {                                                        \
            a[i_] = b[i_] * c[i_];                                                                 \
        }                                                                                          \
    }
#define SLV_DIVIDE(a, b, c)                                                                        \
    {                                                                                              \
        int i_;                                                                                    \
        for (i_ = 0; i_ < SLI_TILE; i_++) {                                                        \
            a[i_] = b[i_] / c[i_];                                                                 \
        }                                                                                          \
    }
#define SLV_BELOW(a, k)                                                                            \
    {                                                                                              \
        int i_;                                                                                    \
        for (i_ = 0; i_ < SLI_TILE; i_++) {                                                        \
            a[i_] = i_ > (k) ? a[i_] : 0.0;                                                        \
        }                                                                                          \
    }
#define SLV_SPREAD SLI_SPREAD_PLAIN
#define SLV_SPREAD_ADD SLI_SPREAD_ADD_PLAIN
/* arrays gain nothing from spreading L: two right-hand sides go the way of four */
#define SLW_NAME(f) sli_##f##2_scalar
#define SLW_LANES 2
/* begin src/impl/lanes_array.inl.h */
/* lanes_array.inl.h: a row of right-hand sides as an array, for plain C */

#define SLW_ROWS 4
#define SLW_DECLARE(a) double a[SLW_LANES];
#define SLW_ZERO(a) memset(a, 0, sizeof a);
#define SLW_LOAD(a, p) memcpy(a, (p), sizeof a);
#define SLW_STORE(p, a) memcpy((p), a, sizeof a);
#define SLW_FNMA(a, s, b)                                                                          \
    {                                                                                              \
        const double s_ = (s);                                                                     \
        int i_;                                                                                    \
        for (i_ = 0; i_ < SLW_LANES; i_++) {                                                       \
            a[i_] -= s_ * b[i_];                                                                   \
        }                                                                                          \
    }
#define SLW_ADD(a, b)                                                                              \
    {                                                                                              \
        int i_;                                                                                    \
        for (i_ = 0; i_ < SLW_LANES; i_++) {                                                       \
            a[i_] += b[i_];                                                                        \
        }                                                                                          \
    }
#define SLW_DIVIDE(a, s)                                                                           \
    {                                                                                              \
        int i_;                                                                                    \
        for (i_ = 0; i_ < SLW_LANES; i_++) {                                                       \
            a[i_] /= (s);                                                                          \
        }                                                                                          \
    }
/* begin src/impl/lanes.inl.h */
/* lanes.inl.h: 2, 4 or 8 interleaved right-hand sides, SIMD along them; the words SLW_* are one row of SLW_LANES */

/* SLW_EACH(op, k) is op(0, k) op(1, k) .. for the SLW_ROWS rows that are kept in registers at once,
 * SLW_HIGH and SLW_LOW are its halves from the last row down; a0, a1, .. are their accumulators, b
 * and c one row more each. SLW_EACH_AGAIN is SLW_EACH once more, as a macro does not expand inside
 * itself. */
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
#define SLI_LOAD(r, p) SLW_LOAD(a##r, (p) + (r)*SLW_LANES)
#define SLI_STORE(r, p) SLW_STORE((p) + (r)*SLW_LANES, a##r)
#define SLI_APPLY(r, l) SLW_FNMA(a##r, (l)[r], b)  /* a(r) -= L(r, j) x(j) */
#define SLI_GATHER(r, l) SLW_FNMA(b, (l)[r], a##r) /* x(j) -= L(r, j) x(r), in two chains */
#define SLI_GATHER2(r, l) SLW_FNMA(c, (l)[r], a##r)
/* inside the diagonal block: column k onto the rows below it, and row k onto the columns before it
 */
#define SLI_DOWN(r, k)                                                                             \
    if ((r) > (k)) {                                                                               \
        SLW_FNMA(a##r, l[SLI_TILE * (k) + (r)], a##k)                                              \
    }
#define SLI_UP(j, k)                                                                               \
    if ((j) < (k) && (j) < inner) {                                                                \
        SLW_FNMA(a##j, l[SLI_TILE * (j) + (k)], a##k)                                              \
    }
#define SLI_COLUMN(k, unused)                                                                      \
    if ((k) < inner) {                                                                             \
        SLW_EACH_AGAIN(SLI_DOWN, k)                                                                \
    }
#define SLI_ROW(k, unused) SLW_EACH_AGAIN(SLI_UP, k)

#if SLW_ROWS == 8
/* A supernode of 1 to 8 columns, the width folded in as in narrow.inl.h: the columns' rows stay in
 * registers, and the rows below pass by one after the other. Rows of x are `stride` apart. */
#define SLI_LOAD_OWN(k, p)                                                                         \
    if ((k) < w) {                                                                                 \
        SLW_LOAD(a##k, (p) + (k)*stride)                                                           \
    }
#define SLI_STORE_OWN(k, p)                                                                        \
    if ((k) < w) {                                                                                 \
        SLW_STORE((p) + (k)*stride, a##k)                                                          \
    }
#define SLI_ZERO_OWN(k, unused) SLW_ZERO(a##k)
#define SLI_AHEAD_OWN(k, bytes)                                                                    \
    if ((k) < w) {                                                                                 \
        SLI_PREFETCH(l + SLI_TILE * (k), bytes);                                                   \
    }
#define SLI_DOWN_OWN(r, k)                                                                         \
    if ((r) > (k) && (r) < w) {                                                                    \
        SLW_FNMA(a##r, l[SLI_TILE * (k) + (r)], a##k)                                              \
    }
#define SLI_COLUMN_OWN(k, unused) SLW_EACH_AGAIN(SLI_DOWN_OWN, k)
#define SLI_BELOW_OWN(k, unused)                                                                   \
    if ((k) < w) {                                                                                 \
        SLW_FNMA(b, l[SLI_TILE * (k) + lane], a##k)                                                \
    }

SLV_FUNCTION SLI_ALWAYS_INLINE void SLW_NAME(narrow_forward)(const sl_int w, sl_int stride,
                                                             sl_int below, const sl_int *rows,
                                                             const double *l, double *xs,
                                                             double *x) {
    sl_int lane = w, i;
    SLW_EACH(SLI_DECLARE, 0)
    SLW_DECLARE(b)
    SLW_EACH(SLI_AHEAD_OWN, SLI_AHEAD)
    SLW_EACH(SLI_LOAD_OWN, xs)
    SLW_EACH(SLI_COLUMN_OWN, 0)
    SLW_EACH(SLI_STORE_OWN, xs)
    for (i = 0; i < below; lane++, i++) { /* x(i) -= L(i, j) x(j) */
        double *to = x + (ptrdiff_t)rows[i] * stride;
        if (lane == SLI_TILE) {
            lane = 0;
            l += SLI_TILE * w;
            SLW_EACH(SLI_AHEAD_OWN, SLI_AHEAD)
        }
        SLW_LOAD(b, to)
        SLW_EACH(SLI_BELOW_OWN, 0)
        SLW_STORE(to, b)
    }
}

#define SLI_UP_OWN(j, k)                                                                           \
    if ((j) < (k) && (k) < w) {                                                                    \
        SLW_FNMA(a##j, l[SLI_TILE * (j) + (k)], a##k)                                              \
    }
#define SLI_ROW_OWN(k, unused) SLW_EACH_AGAIN(SLI_UP_OWN, k)
#define SLI_ABOVE_OWN(k, unused)                                                                   \
    if ((k) < w) {                                                                                 \
        SLW_FNMA(a##k, l[SLI_TILE * (k) + lane], b)                                                \
    }
#define SLI_DIVIDE_OWN(k, unused)                                                                  \
    if ((k) < w) {                                                                                 \
        SLW_LOAD(b, xs + (k)*stride)                                                               \
        SLW_DIVIDE(b, d[k])                                                                        \
        SLW_ADD(a##k, b)                                                                           \
    }

/* l points at the panel's last tile. */
SLV_FUNCTION SLI_ALWAYS_INLINE void SLW_NAME(narrow_backward)(const sl_int w, sl_int stride,
                                                              sl_int below, const sl_int *rows,
                                                              const double *l, const double *d,
                                                              double *xs, const double *x) {
    sl_int i = below - 1, lane = (w + i) % SLI_TILE;
    SLW_EACH(SLI_DECLARE, 0)
    SLW_DECLARE(b)
    SLW_EACH(SLI_ZERO_OWN, 0)
    SLW_HIGH(SLI_AHEAD_OWN, -SLI_AHEAD)
    SLW_LOW(SLI_AHEAD_OWN, -SLI_AHEAD)
    for (; i >= 0; lane--, i--) { /* x(j) -= L(i, j) x(i) */
        if (lane < 0) {
            lane = SLI_TILE - 1;
            l -= SLI_TILE * w;
            SLW_HIGH(SLI_AHEAD_OWN, -SLI_AHEAD)
            SLW_LOW(SLI_AHEAD_OWN, -SLI_AHEAD)
        }
        SLW_LOAD(b, x + (ptrdiff_t)rows[i] * stride)
        SLW_HIGH(SLI_ABOVE_OWN, 0)
        SLW_LOW(SLI_ABOVE_OWN, 0)
    }
    if (w == SLI_TILE && below > 0) {
        l -= SLI_TILE * w;
    }
    SLW_EACH(SLI_DIVIDE_OWN, 0)
    SLW_HIGH(SLI_ROW_OWN, 0)
    SLW_LOW(SLI_ROW_OWN, 0)
    SLW_EACH(SLI_STORE_OWN, xs)
}

#define SLI_FORWARD(k) SLW_NAME(narrow_forward)(k, stride, below, rows, l, xs, x)
#define SLI_BACKWARD(k) SLW_NAME(narrow_backward)(k, stride, below, rows, l, d, xs, x)

SLV_FUNCTION static void SLW_NAME(forward_narrow)(sl_int w, sl_int stride, sl_int below,
                                                  const sl_int *rows, const double *l, double *xs,
                                                  double *x){SLI_CASES(SLI_FORWARD)}

SLV_FUNCTION static void SLW_NAME(backward_narrow)(sl_int w, sl_int stride, sl_int below,
                                                   const sl_int *rows, const double *l,
                                                   const double *d, double *xs, const double *x) {
    SLI_CASES(SLI_BACKWARD)
}

#undef SLI_LOAD_OWN
#undef SLI_STORE_OWN
#undef SLI_ZERO_OWN
#undef SLI_AHEAD_OWN
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
/* Registers do not suffice for 8 such rows: half of the lanes, then the other half. */
SLV_FUNCTION SLI_INLINE void SLW_NAME(forward_narrow)(sl_int w, sl_int stride, sl_int below,
                                                      const sl_int *rows, const double *l,
                                                      double *xs, double *x) {
    const sl_int half = SLW_LANES / 2;
    SLW_HALF(forward_narrow)(w, stride, below, rows, l, xs, x);
    SLW_HALF(forward_narrow)(w, stride, below, rows, l, xs + half, x + half);
}

SLV_FUNCTION SLI_INLINE void SLW_NAME(backward_narrow)(sl_int w, sl_int stride, sl_int below,
                                                       const sl_int *rows, const double *l,
                                                       const double *d, double *xs,
                                                       const double *x) {
    const sl_int half = SLW_LANES / 2;
    SLW_HALF(backward_narrow)(w, stride, below, rows, l, d, xs, x);
    SLW_HALF(backward_narrow)(w, stride, below, rows, l, d, xs + half, x + half);
}
#endif

/* The rows of a tile that are not all columns of the supernode, side by side in buf: `inner` of its
 * own, then rows below, then zeros. */
SLV_FUNCTION SLI_INLINE void SLW_NAME(rows_in)(double *buf, sl_int inner, sl_int below,
                                               const sl_int *rows, const double *own,
                                               const double *x) {
    sl_int r;
    SLW_DECLARE(b)
    for (r = 0; r < SLW_ROWS; r++) {
        if (r < inner + below) {
            SLW_LOAD(b, r < inner ? own + (ptrdiff_t)r * SLW_LANES
                                  : x + (ptrdiff_t)rows[r - inner] * SLW_LANES)
        } else {
            SLW_ZERO(b)
        }
        SLW_STORE(buf + (ptrdiff_t)r * SLW_LANES, b)
    }
}

SLV_FUNCTION SLI_INLINE void SLW_NAME(rows_out)(const double *buf, sl_int inner, sl_int below,
                                                const sl_int *rows, double *own, double *x) {
    sl_int r;
    SLW_DECLARE(b)
    for (r = 0; r < SLW_ROWS && r < inner + below; r++) {
        SLW_LOAD(b, buf + (ptrdiff_t)r * SLW_LANES)
        SLW_STORE(r < inner ? own + (ptrdiff_t)r * SLW_LANES
                            : x + (ptrdiff_t)rows[r - inner] * SLW_LANES,
                  b)
    }
}

SLV_FUNCTION static void SLW_NAME(forward)(sl_int count, const sli_step *s, const sl_int *rows,
                                           const double *L, double *x, double *buf) {
    for (; count > 0; rows += s->below, count--, s++) {
        const sl_int w = s->width, height = w + s->below, first = SLI_TILE * s->first_tile;
        const double *tile = L + s->panel + sli_tile_offset(w, s->first_tile);
        double *xs = x + ((ptrdiff_t)s->base - first) * SLW_LANES;
        ptrdiff_t row;
        sl_int j;
#if SLW_ROWS == 8 || defined(SLW_HALF)
        if (w <= SLI_TILE) {
            SLW_NAME(forward_narrow)(w, SLW_LANES, s->below, rows, tile, xs, x);
            continue;
        }
#endif
        for (row = first; row < height; row += SLW_ROWS) {
            const sl_int lane = (sl_int)(row % SLI_TILE), final = (sl_int)(row < w ? row : w);
            const sl_int inner = sli_clamp(w - (sl_int)row, SLW_ROWS);
            const sl_int *places = rows + (row + inner - w);
            double *own = xs + row * SLW_LANES, *p = inner == SLW_ROWS ? own : buf;
            const double *l = tile + SLI_TILE * (ptrdiff_t)first + lane;
            SLW_EACH(SLI_DECLARE, 0)
            SLW_DECLARE(b)
            if (inner < SLW_ROWS) {
                SLW_NAME(rows_in)(buf, inner, height - (sl_int)row - inner, places, own, x);
            }
            SLW_EACH(SLI_LOAD, p)
            for (j = first; j < final; j++, l += SLI_TILE) {
                SLI_PREFETCH(l, SLI_AHEAD);
                SLW_LOAD(b, xs + (ptrdiff_t)j * SLW_LANES)
                SLW_EACH(SLI_APPLY, l)
            }
            if (inner > 0) {
                SLW_EACH(SLI_COLUMN, 0)
            }
            SLW_EACH(SLI_STORE, p)
            if (inner < SLW_ROWS) {
                SLW_NAME(rows_out)(buf, inner, height - (sl_int)row - inner, places, own, x);
            }
            if (lane + SLW_ROWS == SLI_TILE) {
                tile += SLI_TILE * (ptrdiff_t)sli_min(w, (sl_int)row + SLW_ROWS);
            }
        }
    }
}

SLV_FUNCTION static void SLW_NAME(backward)(sl_int count, const sli_step *s, const sl_int *rows_end,
                                            const double *L, const double *D, double *x,
                                            double *buf) {
    for (s += count; count > 0; count--) {
        const sl_int w = (--s)->width, height = w + s->below, first = SLI_TILE * s->first_tile;
        const sl_int padded = SLI_TILE * sli_tiles(height);
        const double *tile = L + s->panel + sli_panel_size(w, s->below), *d = D + s->column - first;
        double *xs = x + ((ptrdiff_t)s->base - first) * SLW_LANES;
        ptrdiff_t row;
        sl_int i, j;
        SLW_DECLARE(b)
        SLW_DECLARE(c)
        rows_end -= s->below;
#if SLW_ROWS == 8 || defined(SLW_HALF)
        if (w <= SLI_TILE) {
            SLW_NAME(backward_narrow)
            (w, SLW_LANES, s->below, rows_end, tile - SLI_TILE * w, d, xs, x);
            continue;
        }
#endif
        for (i = first; i < w; i++) {
            SLW_LOAD(b, xs + (ptrdiff_t)i * SLW_LANES)
            SLW_DIVIDE(b, d[i])
            SLW_STORE(xs + (ptrdiff_t)i * SLW_LANES, b)
        }
        for (row = padded - SLW_ROWS; row >= first; row -= SLW_ROWS) {
            const sl_int lane = (sl_int)(row % SLI_TILE), final = (sl_int)(row < w ? row : w);
            const sl_int inner = sli_clamp(w - (sl_int)row, SLW_ROWS);
            double *own = xs + row * SLW_LANES, *p = inner == SLW_ROWS ? own : buf;
            const double *l;
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
                SLI_PREFETCH(l, -SLI_AHEAD);
                SLW_LOAD(b, xs + (ptrdiff_t)j * SLW_LANES)
                SLW_ZERO(c)
                SLW_HIGH(SLI_GATHER, l)
                SLW_LOW(SLI_GATHER2, l)
                SLW_ADD(b, c)
                SLW_STORE(xs + (ptrdiff_t)j * SLW_LANES, b)
            }
        }
    }
}

#if SLW_LANES == 8
SLV_FUNCTION static void SLW_NAME(products)(sl_int count, const double *y, const double *z,
                                            double *sums) {
    sl_int row, k;
    for (row = 0; row < SLW_LANES; row += SLW_ROWS) {
        const double *l = y + row, *p = z;
        double *s = sums + row * SLW_LANES;
        SLW_EACH(SLI_DECLARE, 0)
        SLW_DECLARE(b)
        SLW_EACH(SLI_LOAD, s)
        for (k = 0; k < count; k++, l += SLW_LANES, p += SLW_LANES) {
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
#undef SLW_NAME
#undef SLW_LANES
#undef SLW_ROWS
#undef SLW_HALF
#undef SLW_EACH
#undef SLW_EACH_AGAIN
#undef SLW_HIGH
#undef SLW_LOW
#undef SLW_DECLARE
#undef SLW_ZERO
#undef SLW_LOAD
#undef SLW_STORE
#undef SLW_ADD
#undef SLW_FNMA
#undef SLW_DIVIDE
/* end src/impl/lanes.inl.h */
/* end src/impl/lanes_array.inl.h */

#define SLW_NAME(f) sli_##f##4_scalar
#define SLW_LANES 4
/* begin src/impl/lanes_array.inl.h */
/* lanes_array.inl.h: a row of right-hand sides as an array, for plain C */

#define SLW_ROWS 4
#define SLW_DECLARE(a) double a[SLW_LANES];
#define SLW_ZERO(a) memset(a, 0, sizeof a);
#define SLW_LOAD(a, p) memcpy(a, (p), sizeof a);
#define SLW_STORE(p, a) memcpy((p), a, sizeof a);
#define SLW_FNMA(a, s, b)                                                                          \
    {                                                                                              \
        const double s_ = (s);                                                                     \
        int i_;                                                                                    \
        for (i_ = 0; i_ < SLW_LANES; i_++) {                                                       \
            a[i_] -= s_ * b[i_];                                                                   \
        }                                                                                          \
    }
#define SLW_ADD(a, b)                                                                              \
    {                                                                                              \
        int i_;                                                                                    \
        for (i_ = 0; i_ < SLW_LANES; i_++) {                                                       \
            a[i_] += b[i_];                                                                        \
        }                                                                                          \
    }
#define SLW_DIVIDE(a, s)                                                                           \
    {                                                                                              \
        int i_;                                                                                    \
        for (i_ = 0; i_ < SLW_LANES; i_++) {                                                       \
            a[i_] /= (s);                                                                          \
        }                                                                                          \
    }
/* begin src/impl/lanes.inl.h */
/* lanes.inl.h: 2, 4 or 8 interleaved right-hand sides, SIMD along them; the words SLW_* are one row of SLW_LANES */

/* SLW_EACH(op, k) is op(0, k) op(1, k) .. for the SLW_ROWS rows that are kept in registers at once,
 * SLW_HIGH and SLW_LOW are its halves from the last row down; a0, a1, .. are their accumulators, b
 * and c one row more each. SLW_EACH_AGAIN is SLW_EACH once more, as a macro does not expand inside
 * itself. */
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
#define SLI_LOAD(r, p) SLW_LOAD(a##r, (p) + (r)*SLW_LANES)
#define SLI_STORE(r, p) SLW_STORE((p) + (r)*SLW_LANES, a##r)
#define SLI_APPLY(r, l) SLW_FNMA(a##r, (l)[r], b)  /* a(r) -= L(r, j) x(j) */
#define SLI_GATHER(r, l) SLW_FNMA(b, (l)[r], a##r) /* x(j) -= L(r, j) x(r), in two chains */
#define SLI_GATHER2(r, l) SLW_FNMA(c, (l)[r], a##r)
/* inside the diagonal block: column k onto the rows below it, and row k onto the columns before it
 */
#define SLI_DOWN(r, k)                                                                             \
    if ((r) > (k)) {                                                                               \
        SLW_FNMA(a##r, l[SLI_TILE * (k) + (r)], a##k)                                              \
    }
#define SLI_UP(j, k)                                                                               \
    if ((j) < (k) && (j) < inner) {                                                                \
        SLW_FNMA(a##j, l[SLI_TILE * (j) + (k)], a##k)                                              \
    }
#define SLI_COLUMN(k, unused)                                                                      \
    if ((k) < inner) {                                                                             \
        SLW_EACH_AGAIN(SLI_DOWN, k)                                                                \
    }
#define SLI_ROW(k, unused) SLW_EACH_AGAIN(SLI_UP, k)

#if SLW_ROWS == 8
/* A supernode of 1 to 8 columns, the width folded in as in narrow.inl.h: the columns' rows stay in
 * registers, and the rows below pass by one after the other. Rows of x are `stride` apart. */
#define SLI_LOAD_OWN(k, p)                                                                         \
    if ((k) < w) {                                                                                 \
        SLW_LOAD(a##k, (p) + (k)*stride)                                                           \
    }
#define SLI_STORE_OWN(k, p)                                                                        \
    if ((k) < w) {                                                                                 \
        SLW_STORE((p) + (k)*stride, a##k)                                                          \
    }
#define SLI_ZERO_OWN(k, unused) SLW_ZERO(a##k)
#define SLI_AHEAD_OWN(k, bytes)                                                                    \
    if ((k) < w) {                                                                                 \
        SLI_PREFETCH(l + SLI_TILE * (k), bytes);                                                   \
    }
#define SLI_DOWN_OWN(r, k)                                                                         \
    if ((r) > (k) && (r) < w) {                                                                    \
        SLW_FNMA(a##r, l[SLI_TILE * (k) + (r)], a##k)                                              \
    }
#define SLI_COLUMN_OWN(k, unused) SLW_EACH_AGAIN(SLI_DOWN_OWN, k)
#define SLI_BELOW_OWN(k, unused)                                                                   \
    if ((k) < w) {                                                                                 \
        SLW_FNMA(b, l[SLI_TILE * (k) + lane], a##k)                                                \
    }

SLV_FUNCTION SLI_ALWAYS_INLINE void SLW_NAME(narrow_forward)(const sl_int w, sl_int stride,
                                                             sl_int below, const sl_int *rows,
                                                             const double *l, double *xs,
                                                             double *x) {
    sl_int lane = w, i;
    SLW_EACH(SLI_DECLARE, 0)
    SLW_DECLARE(b)
    SLW_EACH(SLI_AHEAD_OWN, SLI_AHEAD)
    SLW_EACH(SLI_LOAD_OWN, xs)
    SLW_EACH(SLI_COLUMN_OWN, 0)
    SLW_EACH(SLI_STORE_OWN, xs)
    for (i = 0; i < below; lane++, i++) { /* x(i) -= L(i, j) x(j) */
        double *to = x + (ptrdiff_t)rows[i] * stride;
        if (lane == SLI_TILE) {
            lane = 0;
            l += SLI_TILE * w;
            SLW_EACH(SLI_AHEAD_OWN, SLI_AHEAD)
        }
        SLW_LOAD(b, to)
        SLW_EACH(SLI_BELOW_OWN, 0)
        SLW_STORE(to, b)
    }
}

#define SLI_UP_OWN(j, k)                                                                           \
    if ((j) < (k) && (k) < w) {                                                                    \
        SLW_FNMA(a##j, l[SLI_TILE * (j) + (k)], a##k)                                              \
    }
#define SLI_ROW_OWN(k, unused) SLW_EACH_AGAIN(SLI_UP_OWN, k)
#define SLI_ABOVE_OWN(k, unused)                                                                   \
    if ((k) < w) {                                                                                 \
        SLW_FNMA(a##k, l[SLI_TILE * (k) + lane], b)                                                \
    }
#define SLI_DIVIDE_OWN(k, unused)                                                                  \
    if ((k) < w) {                                                                                 \
        SLW_LOAD(b, xs + (k)*stride)                                                               \
        SLW_DIVIDE(b, d[k])                                                                        \
        SLW_ADD(a##k, b)                                                                           \
    }

/* l points at the panel's last tile. */
SLV_FUNCTION SLI_ALWAYS_INLINE void SLW_NAME(narrow_backward)(const sl_int w, sl_int stride,
                                                              sl_int below, const sl_int *rows,
                                                              const double *l, const double *d,
                                                              double *xs, const double *x) {
    sl_int i = below - 1, lane = (w + i) % SLI_TILE;
    SLW_EACH(SLI_DECLARE, 0)
    SLW_DECLARE(b)
    SLW_EACH(SLI_ZERO_OWN, 0)
    SLW_HIGH(SLI_AHEAD_OWN, -SLI_AHEAD)
    SLW_LOW(SLI_AHEAD_OWN, -SLI_AHEAD)
    for (; i >= 0; lane--, i--) { /* x(j) -= L(i, j) x(i) */
        if (lane < 0) {
            lane = SLI_TILE - 1;
            l -= SLI_TILE * w;
            SLW_HIGH(SLI_AHEAD_OWN, -SLI_AHEAD)
            SLW_LOW(SLI_AHEAD_OWN, -SLI_AHEAD)
        }
        SLW_LOAD(b, x + (ptrdiff_t)rows[i] * stride)
        SLW_HIGH(SLI_ABOVE_OWN, 0)
        SLW_LOW(SLI_ABOVE_OWN, 0)
    }
    if (w == SLI_TILE && below > 0) {
        l -= SLI_TILE * w;
    }
    SLW_EACH(SLI_DIVIDE_OWN, 0)
    SLW_HIGH(SLI_ROW_OWN, 0)
    SLW_LOW(SLI_ROW_OWN, 0)
    SLW_EACH(SLI_STORE_OWN, xs)
}

#define SLI_FORWARD(k) SLW_NAME(narrow_forward)(k, stride, below, rows, l, xs, x)
#define SLI_BACKWARD(k) SLW_NAME(narrow_backward)(k, stride, below, rows, l, d, xs, x)

SLV_FUNCTION static void SLW_NAME(forward_narrow)(sl_int w, sl_int stride, sl_int below,
                                                  const sl_int *rows, const double *l, double *xs,
                                                  double *x){SLI_CASES(SLI_FORWARD)}

SLV_FUNCTION static void SLW_NAME(backward_narrow)(sl_int w, sl_int stride, sl_int below,
                                                   const sl_int *rows, const double *l,
                                                   const double *d, double *xs, const double *x) {
    SLI_CASES(SLI_BACKWARD)
}

#undef SLI_LOAD_OWN
#undef SLI_STORE_OWN
#undef SLI_ZERO_OWN
#undef SLI_AHEAD_OWN
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
/* Registers do not suffice for 8 such rows: half of the lanes, then the other half. */
SLV_FUNCTION SLI_INLINE void SLW_NAME(forward_narrow)(sl_int w, sl_int stride, sl_int below,
                                                      const sl_int *rows, const double *l,
                                                      double *xs, double *x) {
    const sl_int half = SLW_LANES / 2;
    SLW_HALF(forward_narrow)(w, stride, below, rows, l, xs, x);
    SLW_HALF(forward_narrow)(w, stride, below, rows, l, xs + half, x + half);
}

SLV_FUNCTION SLI_INLINE void SLW_NAME(backward_narrow)(sl_int w, sl_int stride, sl_int below,
                                                       const sl_int *rows, const double *l,
                                                       const double *d, double *xs,
                                                       const double *x) {
    const sl_int half = SLW_LANES / 2;
    SLW_HALF(backward_narrow)(w, stride, below, rows, l, d, xs, x);
    SLW_HALF(backward_narrow)(w, stride, below, rows, l, d, xs + half, x + half);
}
#endif

/* The rows of a tile that are not all columns of the supernode, side by side in buf: `inner` of its
 * own, then rows below, then zeros. */
SLV_FUNCTION SLI_INLINE void SLW_NAME(rows_in)(double *buf, sl_int inner, sl_int below,
                                               const sl_int *rows, const double *own,
                                               const double *x) {
    sl_int r;
    SLW_DECLARE(b)
    for (r = 0; r < SLW_ROWS; r++) {
        if (r < inner + below) {
            SLW_LOAD(b, r < inner ? own + (ptrdiff_t)r * SLW_LANES
                                  : x + (ptrdiff_t)rows[r - inner] * SLW_LANES)
        } else {
            SLW_ZERO(b)
        }
        SLW_STORE(buf + (ptrdiff_t)r * SLW_LANES, b)
    }
}

SLV_FUNCTION SLI_INLINE void SLW_NAME(rows_out)(const double *buf, sl_int inner, sl_int below,
                                                const sl_int *rows, double *own, double *x) {
    sl_int r;
    SLW_DECLARE(b)
    for (r = 0; r < SLW_ROWS && r < inner + below; r++) {
        SLW_LOAD(b, buf + (ptrdiff_t)r * SLW_LANES)
        SLW_STORE(r < inner ? own + (ptrdiff_t)r * SLW_LANES
                            : x + (ptrdiff_t)rows[r - inner] * SLW_LANES,
                  b)
    }
}

SLV_FUNCTION static void SLW_NAME(forward)(sl_int count, const sli_step *s, const sl_int *rows,
                                           const double *L, double *x, double *buf) {
    for (; count > 0; rows += s->below, count--, s++) {
        const sl_int w = s->width, height = w + s->below, first = SLI_TILE * s->first_tile;
        const double *tile = L + s->panel + sli_tile_offset(w, s->first_tile);
        double *xs = x + ((ptrdiff_t)s->base - first) * SLW_LANES;
        ptrdiff_t row;
        sl_int j;
#if SLW_ROWS == 8 || defined(SLW_HALF)
        if (w <= SLI_TILE) {
            SLW_NAME(forward_narrow)(w, SLW_LANES, s->below, rows, tile, xs, x);
            continue;
        }
#endif
        for (row = first; row < height; row += SLW_ROWS) {
            const sl_int lane = (sl_int)(row % SLI_TILE), final = (sl_int)(row < w ? row : w);
            const sl_int inner = sli_clamp(w - (sl_int)row, SLW_ROWS);
            const sl_int *places = rows + (row + inner - w);
            double *own = xs + row * SLW_LANES, *p = inner == SLW_ROWS ? own : buf;
            const double *l = tile + SLI_TILE * (ptrdiff_t)first + lane;
            SLW_EACH(SLI_DECLARE, 0)
            SLW_DECLARE(b)
            if (inner < SLW_ROWS) {
                SLW_NAME(rows_in)(buf, inner, height - (sl_int)row - inner, places, own, x);
            }
            SLW_EACH(SLI_LOAD, p)
            for (j = first; j < final; j++, l += SLI_TILE) {
                SLI_PREFETCH(l, SLI_AHEAD);
                SLW_LOAD(b, xs + (ptrdiff_t)j * SLW_LANES)
                SLW_EACH(SLI_APPLY, l)
            }
            if (inner > 0) {
                SLW_EACH(SLI_COLUMN, 0)
            }
            SLW_EACH(SLI_STORE, p)
            if (inner < SLW_ROWS) {
                SLW_NAME(rows_out)(buf, inner, height - (sl_int)row - inner, places, own, x);
            }
            if (lane + SLW_ROWS == SLI_TILE) {
                tile += SLI_TILE * (ptrdiff_t)sli_min(w, (sl_int)row + SLW_ROWS);
            }
        }
    }
}

SLV_FUNCTION static void SLW_NAME(backward)(sl_int count, const sli_step *s, const sl_int *rows_end,
                                            const double *L, const double *D, double *x,
                                            double *buf) {
    for (s += count; count > 0; count--) {
        const sl_int w = (--s)->width, height = w + s->below, first = SLI_TILE * s->first_tile;
        const sl_int padded = SLI_TILE * sli_tiles(height);
        const double *tile = L + s->panel + sli_panel_size(w, s->below), *d = D + s->column - first;
        double *xs = x + ((ptrdiff_t)s->base - first) * SLW_LANES;
        ptrdiff_t row;
        sl_int i, j;
        SLW_DECLARE(b)
        SLW_DECLARE(c)
        rows_end -= s->below;
#if SLW_ROWS == 8 || defined(SLW_HALF)
        if (w <= SLI_TILE) {
            SLW_NAME(backward_narrow)
            (w, SLW_LANES, s->below, rows_end, tile - SLI_TILE * w, d, xs, x);
            continue;
        }
#endif
        for (i = first; i < w; i++) {
            SLW_LOAD(b, xs + (ptrdiff_t)i * SLW_LANES)
            SLW_DIVIDE(b, d[i])
            SLW_STORE(xs + (ptrdiff_t)i * SLW_LANES, b)
        }
        for (row = padded - SLW_ROWS; row >= first; row -= SLW_ROWS) {
            const sl_int lane = (sl_int)(row % SLI_TILE), final = (sl_int)(row < w ? row : w);
            const sl_int inner = sli_clamp(w - (sl_int)row, SLW_ROWS);
            double *own = xs + row * SLW_LANES, *p = inner == SLW_ROWS ? own : buf;
            const double *l;
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
                SLI_PREFETCH(l, -SLI_AHEAD);
                SLW_LOAD(b, xs + (ptrdiff_t)j * SLW_LANES)
                SLW_ZERO(c)
                SLW_HIGH(SLI_GATHER, l)
                SLW_LOW(SLI_GATHER2, l)
                SLW_ADD(b, c)
                SLW_STORE(xs + (ptrdiff_t)j * SLW_LANES, b)
            }
        }
    }
}

#if SLW_LANES == 8
SLV_FUNCTION static void SLW_NAME(products)(sl_int count, const double *y, const double *z,
                                            double *sums) {
    sl_int row, k;
    for (row = 0; row < SLW_LANES; row += SLW_ROWS) {
        const double *l = y + row, *p = z;
        double *s = sums + row * SLW_LANES;
        SLW_EACH(SLI_DECLARE, 0)
        SLW_DECLARE(b)
        SLW_EACH(SLI_LOAD, s)
        for (k = 0; k < count; k++, l += SLW_LANES, p += SLW_LANES) {
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
#undef SLW_NAME
#undef SLW_LANES
#undef SLW_ROWS
#undef SLW_HALF
#undef SLW_EACH
#undef SLW_EACH_AGAIN
#undef SLW_HIGH
#undef SLW_LOW
#undef SLW_DECLARE
#undef SLW_ZERO
#undef SLW_LOAD
#undef SLW_STORE
#undef SLW_ADD
#undef SLW_FNMA
#undef SLW_DIVIDE
/* end src/impl/lanes.inl.h */
/* end src/impl/lanes_array.inl.h */

#define SLW_NAME(f) sli_##f##8_scalar
#define SLW_LANES 8
/* begin src/impl/lanes_array.inl.h */
/* lanes_array.inl.h: a row of right-hand sides as an array, for plain C */

#define SLW_ROWS 4
#define SLW_DECLARE(a) double a[SLW_LANES];
#define SLW_ZERO(a) memset(a, 0, sizeof a);
#define SLW_LOAD(a, p) memcpy(a, (p), sizeof a);
#define SLW_STORE(p, a) memcpy((p), a, sizeof a);
#define SLW_FNMA(a, s, b)                                                                          \
    {                                                                                              \
        const double s_ = (s);                                                                     \
        int i_;                                                                                    \
        for (i_ = 0; i_ < SLW_LANES; i_++) {                                                       \
            a[i_] -= s_ * b[i_];                                                                   \
        }                                                                                          \
    }
#define SLW_ADD(a, b)                                                                              \
    {                                                                                              \
        int i_;                                                                                    \
        for (i_ = 0; i_ < SLW_LANES; i_++) {                                                       \
            a[i_] += b[i_];                                                                        \
        }                                                                                          \
    }
#define SLW_DIVIDE(a, s)                                                                           \
    {                                                                                              \
        int i_;                                                                                    \
        for (i_ = 0; i_ < SLW_LANES; i_++) {                                                       \
            a[i_] /= (s);                                                                          \
        }                                                                                          \
    }
/* begin src/impl/lanes.inl.h */
/* lanes.inl.h: 2, 4 or 8 interleaved right-hand sides, SIMD along them; the words SLW_* are one row of SLW_LANES */

/* SLW_EACH(op, k) is op(0, k) op(1, k) .. for the SLW_ROWS rows that are kept in registers at once,
 * SLW_HIGH and SLW_LOW are its halves from the last row down; a0, a1, .. are their accumulators, b
 * and c one row more each. SLW_EACH_AGAIN is SLW_EACH once more, as a macro does not expand inside
 * itself. */
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
#define SLI_LOAD(r, p) SLW_LOAD(a##r, (p) + (r)*SLW_LANES)
#define SLI_STORE(r, p) SLW_STORE((p) + (r)*SLW_LANES, a##r)
#define SLI_APPLY(r, l) SLW_FNMA(a##r, (l)[r], b)  /* a(r) -= L(r, j) x(j) */
#define SLI_GATHER(r, l) SLW_FNMA(b, (l)[r], a##r) /* x(j) -= L(r, j) x(r), in two chains */
#define SLI_GATHER2(r, l) SLW_FNMA(c, (l)[r], a##r)
/* inside the diagonal block: column k onto the rows below it, and row k onto the columns before it
 */
#define SLI_DOWN(r, k)                                                                             \
    if ((r) > (k)) {                                                                               \
        SLW_FNMA(a##r, l[SLI_TILE * (k) + (r)], a##k)                                              \
    }
#define SLI_UP(j, k)                                                                               \
    if ((j) < (k) && (j) < inner) {                                                                \
        SLW_FNMA(a##j, l[SLI_TILE * (j) + (k)], a##k)                                              \
    }
#define SLI_COLUMN(k, unused)                                                                      \
    if ((k) < inner) {                                                                             \
        SLW_EACH_AGAIN(SLI_DOWN, k)                                                                \
    }
#define SLI_ROW(k, unused) SLW_EACH_AGAIN(SLI_UP, k)

#if SLW_ROWS == 8
/* A supernode of 1 to 8 columns, the width folded in as in narrow.inl.h: the columns' rows stay in
 * registers, and the rows below pass by one after the other. Rows of x are `stride` apart. */
#define SLI_LOAD_OWN(k, p)                                                                         \
    if ((k) < w) {                                                                                 \
        SLW_LOAD(a##k, (p) + (k)*stride)                                                           \
    }
#define SLI_STORE_OWN(k, p)                                                                        \
    if ((k) < w) {                                                                                 \
        SLW_STORE((p) + (k)*stride, a##k)                                                          \
    }
#define SLI_ZERO_OWN(k, unused) SLW_ZERO(a##k)
#define SLI_AHEAD_OWN(k, bytes)                                                                    \
    if ((k) < w) {                                                                                 \
        SLI_PREFETCH(l + SLI_TILE * (k), bytes);                                                   \
    }
#define SLI_DOWN_OWN(r, k)                                                                         \
    if ((r) > (k) && (r) < w) {                                                                    \
        SLW_FNMA(a##r, l[SLI_TILE * (k) + (r)], a##k)                                              \
    }
#define SLI_COLUMN_OWN(k, unused) SLW_EACH_AGAIN(SLI_DOWN_OWN, k)
#define SLI_BELOW_OWN(k, unused)                                                                   \
    if ((k) < w) {                                                                                 \
        SLW_FNMA(b, l[SLI_TILE * (k) + lane], a##k)                                                \
    }

SLV_FUNCTION SLI_ALWAYS_INLINE void SLW_NAME(narrow_forward)(const sl_int w, sl_int stride,
                                                             sl_int below, const sl_int *rows,
                                                             const double *l, double *xs,
                                                             double *x) {
    sl_int lane = w, i;
    SLW_EACH(SLI_DECLARE, 0)
    SLW_DECLARE(b)
    SLW_EACH(SLI_AHEAD_OWN, SLI_AHEAD)
    SLW_EACH(SLI_LOAD_OWN, xs)
    SLW_EACH(SLI_COLUMN_OWN, 0)
    SLW_EACH(SLI_STORE_OWN, xs)
    for (i = 0; i < below; lane++, i++) { /* x(i) -= L(i, j) x(j) */
        double *to = x + (ptrdiff_t)rows[i] * stride;
        if (lane == SLI_TILE) {
            lane = 0;
            l += SLI_TILE * w;
            SLW_EACH(SLI_AHEAD_OWN, SLI_AHEAD)
        }
        SLW_LOAD(b, to)
        SLW_EACH(SLI_BELOW_OWN, 0)
        SLW_STORE(to, b)
    }
}

#define SLI_UP_OWN(j, k)                                                                           \
    if ((j) < (k) && (k) < w) {                                                                    \
        SLW_FNMA(a##j, l[SLI_TILE * (j) + (k)], a##k)                                              \
    }
#define SLI_ROW_OWN(k, unused) SLW_EACH_AGAIN(SLI_UP_OWN, k)
#define SLI_ABOVE_OWN(k, unused)                                                                   \
    if ((k) < w) {                                                                                 \
        SLW_FNMA(a##k, l[SLI_TILE * (k) + lane], b)                                                \
    }
#define SLI_DIVIDE_OWN(k, unused)                                                                  \
    if ((k) < w) {                                                                                 \
        SLW_LOAD(b, xs + (k)*stride)                                                               \
        SLW_DIVIDE(b, d[k])                                                                        \
        SLW_ADD(a##k, b)                                                                           \
    }

/* l points at the panel's last tile. */
SLV_FUNCTION SLI_ALWAYS_INLINE void SLW_NAME(narrow_backward)(const sl_int w, sl_int stride,
                                                              sl_int below, const sl_int *rows,
                                                              const double *l, const double *d,
                                                              double *xs, const double *x) {
    sl_int i = below - 1, lane = (w + i) % SLI_TILE;
    SLW_EACH(SLI_DECLARE, 0)
    SLW_DECLARE(b)
    SLW_EACH(SLI_ZERO_OWN, 0)
    SLW_HIGH(SLI_AHEAD_OWN, -SLI_AHEAD)
    SLW_LOW(SLI_AHEAD_OWN, -SLI_AHEAD)
    for (; i >= 0; lane--, i--) { /* x(j) -= L(i, j) x(i) */
        if (lane < 0) {
            lane = SLI_TILE - 1;
            l -= SLI_TILE * w;
            SLW_HIGH(SLI_AHEAD_OWN, -SLI_AHEAD)
            SLW_LOW(SLI_AHEAD_OWN, -SLI_AHEAD)
        }
        SLW_LOAD(b, x + (ptrdiff_t)rows[i] * stride)
        SLW_HIGH(SLI_ABOVE_OWN, 0)
        SLW_LOW(SLI_ABOVE_OWN, 0)
    }
    if (w == SLI_TILE && below > 0) {
        l -= SLI_TILE * w;
    }
    SLW_EACH(SLI_DIVIDE_OWN, 0)
    SLW_HIGH(SLI_ROW_OWN, 0)
    SLW_LOW(SLI_ROW_OWN, 0)
    SLW_EACH(SLI_STORE_OWN, xs)
}

#define SLI_FORWARD(k) SLW_NAME(narrow_forward)(k, stride, below, rows, l, xs, x)
#define SLI_BACKWARD(k) SLW_NAME(narrow_backward)(k, stride, below, rows, l, d, xs, x)

SLV_FUNCTION static void SLW_NAME(forward_narrow)(sl_int w, sl_int stride, sl_int below,
                                                  const sl_int *rows, const double *l, double *xs,
                                                  double *x){SLI_CASES(SLI_FORWARD)}

SLV_FUNCTION static void SLW_NAME(backward_narrow)(sl_int w, sl_int stride, sl_int below,
                                                   const sl_int *rows, const double *l,
                                                   const double *d, double *xs, const double *x) {
    SLI_CASES(SLI_BACKWARD)
}

#undef SLI_LOAD_OWN
#undef SLI_STORE_OWN
#undef SLI_ZERO_OWN
#undef SLI_AHEAD_OWN
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
/* Registers do not suffice for 8 such rows: half of the lanes, then the other half. */
SLV_FUNCTION SLI_INLINE void SLW_NAME(forward_narrow)(sl_int w, sl_int stride, sl_int below,
                                                      const sl_int *rows, const double *l,
                                                      double *xs, double *x) {
    const sl_int half = SLW_LANES / 2;
    SLW_HALF(forward_narrow)(w, stride, below, rows, l, xs, x);
    SLW_HALF(forward_narrow)(w, stride, below, rows, l, xs + half, x + half);
}

SLV_FUNCTION SLI_INLINE void SLW_NAME(backward_narrow)(sl_int w, sl_int stride, sl_int below,
                                                       const sl_int *rows, const double *l,
                                                       const double *d, double *xs,
                                                       const double *x) {
    const sl_int half = SLW_LANES / 2;
    SLW_HALF(backward_narrow)(w, stride, below, rows, l, d, xs, x);
    SLW_HALF(backward_narrow)(w, stride, below, rows, l, d, xs + half, x + half);
}
#endif

/* The rows of a tile that are not all columns of the supernode, side by side in buf: `inner` of its
 * own, then rows below, then zeros. */
SLV_FUNCTION SLI_INLINE void SLW_NAME(rows_in)(double *buf, sl_int inner, sl_int below,
                                               const sl_int *rows, const double *own,
                                               const double *x) {
    sl_int r;
    SLW_DECLARE(b)
    for (r = 0; r < SLW_ROWS; r++) {
        if (r < inner + below) {
            SLW_LOAD(b, r < inner ? own + (ptrdiff_t)r * SLW_LANES
                                  : x + (ptrdiff_t)rows[r - inner] * SLW_LANES)
        } else {
            SLW_ZERO(b)
        }
        SLW_STORE(buf + (ptrdiff_t)r * SLW_LANES, b)
    }
}

SLV_FUNCTION SLI_INLINE void SLW_NAME(rows_out)(const double *buf, sl_int inner, sl_int below,
                                                const sl_int *rows, double *own, double *x) {
    sl_int r;
    SLW_DECLARE(b)
    for (r = 0; r < SLW_ROWS && r < inner + below; r++) {
        SLW_LOAD(b, buf + (ptrdiff_t)r * SLW_LANES)
        SLW_STORE(r < inner ? own + (ptrdiff_t)r * SLW_LANES
                            : x + (ptrdiff_t)rows[r - inner] * SLW_LANES,
                  b)
    }
}

SLV_FUNCTION static void SLW_NAME(forward)(sl_int count, const sli_step *s, const sl_int *rows,
                                           const double *L, double *x, double *buf) {
    for (; count > 0; rows += s->below, count--, s++) {
        const sl_int w = s->width, height = w + s->below, first = SLI_TILE * s->first_tile;
        const double *tile = L + s->panel + sli_tile_offset(w, s->first_tile);
        double *xs = x + ((ptrdiff_t)s->base - first) * SLW_LANES;
        ptrdiff_t row;
        sl_int j;
#if SLW_ROWS == 8 || defined(SLW_HALF)
        if (w <= SLI_TILE) {
            SLW_NAME(forward_narrow)(w, SLW_LANES, s->below, rows, tile, xs, x);
            continue;
        }
#endif
        for (row = first; row < height; row += SLW_ROWS) {
            const sl_int lane = (sl_int)(row % SLI_TILE), final = (sl_int)(row < w ? row : w);
            const sl_int inner = sli_clamp(w - (sl_int)row, SLW_ROWS);
            const sl_int *places = rows + (row + inner - w);
            double *own = xs + row * SLW_LANES, *p = inner == SLW_ROWS ? own : buf;
            const double *l = tile + SLI_TILE * (ptrdiff_t)first + lane;
            SLW_EACH(SLI_DECLARE, 0)
            SLW_DECLARE(b)
            if (inner < SLW_ROWS) {
                SLW_NAME(rows_in)(buf, inner, height - (sl_int)row - inner, places, own, x);
            }
            SLW_EACH(SLI_LOAD, p)
            for (j = first; j < final; j++, l += SLI_TILE) {
                SLI_PREFETCH(l, SLI_AHEAD);
                SLW_LOAD(b, xs + (ptrdiff_t)j * SLW_LANES)
                SLW_EACH(SLI_APPLY, l)
            }
            if (inner > 0) {
                SLW_EACH(SLI_COLUMN, 0)
            }
            SLW_EACH(SLI_STORE, p)
            if (inner < SLW_ROWS) {
                SLW_NAME(rows_out)(buf, inner, height - (sl_int)row - inner, places, own, x);
            }
            if (lane + SLW_ROWS == SLI_TILE) {
                tile += SLI_TILE * (ptrdiff_t)sli_min(w, (sl_int)row + SLW_ROWS);
            }
        }
    }
}

SLV_FUNCTION static void SLW_NAME(backward)(sl_int count, const sli_step *s, const sl_int *rows_end,
                                            const double *L, const double *D, double *x,
                                            double *buf) {
    for (s += count; count > 0; count--) {
        const sl_int w = (--s)->width, height = w + s->below, first = SLI_TILE * s->first_tile;
        const sl_int padded = SLI_TILE * sli_tiles(height);
        const double *tile = L + s->panel + sli_panel_size(w, s->below), *d = D + s->column - first;
        double *xs = x + ((ptrdiff_t)s->base - first) * SLW_LANES;
        ptrdiff_t row;
        sl_int i, j;
        SLW_DECLARE(b)
        SLW_DECLARE(c)
        rows_end -= s->below;
#if SLW_ROWS == 8 || defined(SLW_HALF)
        if (w <= SLI_TILE) {
            SLW_NAME(backward_narrow)
            (w, SLW_LANES, s->below, rows_end, tile - SLI_TILE * w, d, xs, x);
            continue;
        }
#endif
        for (i = first; i < w; i++) {
            SLW_LOAD(b, xs + (ptrdiff_t)i * SLW_LANES)
            SLW_DIVIDE(b, d[i])
            SLW_STORE(xs + (ptrdiff_t)i * SLW_LANES, b)
        }
        for (row = padded - SLW_ROWS; row >= first; row -= SLW_ROWS) {
            const sl_int lane = (sl_int)(row % SLI_TILE), final = (sl_int)(row < w ? row : w);
            const sl_int inner = sli_clamp(w - (sl_int)row, SLW_ROWS);
            double *own = xs + row * SLW_LANES, *p = inner == SLW_ROWS ? own : buf;
            const double *l;
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
                SLI_PREFETCH(l, -SLI_AHEAD);
                SLW_LOAD(b, xs + (ptrdiff_t)j * SLW_LANES)
                SLW_ZERO(c)
                SLW_HIGH(SLI_GATHER, l)
                SLW_LOW(SLI_GATHER2, l)
                SLW_ADD(b, c)
                SLW_STORE(xs + (ptrdiff_t)j * SLW_LANES, b)
            }
        }
    }
}

#if SLW_LANES == 8
SLV_FUNCTION static void SLW_NAME(products)(sl_int count, const double *y, const double *z,
                                            double *sums) {
    sl_int row, k;
    for (row = 0; row < SLW_LANES; row += SLW_ROWS) {
        const double *l = y + row, *p = z;
        double *s = sums + row * SLW_LANES;
        SLW_EACH(SLI_DECLARE, 0)
        SLW_DECLARE(b)
        SLW_EACH(SLI_LOAD, s)
        for (k = 0; k < count; k++, l += SLW_LANES, p += SLW_LANES) {
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
#undef SLW_NAME
#undef SLW_LANES
#undef SLW_ROWS
#undef SLW_HALF
#undef SLW_EACH
#undef SLW_EACH_AGAIN
#undef SLW_HIGH
#undef SLW_LOW
#undef SLW_DECLARE
#undef SLW_ZERO
#undef SLW_LOAD
#undef SLW_STORE
#undef SLW_ADD
#undef SLW_FNMA
#undef SLW_DIVIDE
/* end src/impl/lanes.inl.h */
/* end src/impl/lanes_array.inl.h */

/* begin src/impl/tile.inl.h */
/* tile.inl.h: the 8 x 8 unit triangle of a diagonal tile, in scalars: 28 FMAs, a chain of 7 */

#define SLI_X(k, j) r##k = SLV_FNMA1(l[SLI_TILE * j + k], r##j, r##k);  /* r(k) -= L(k, j) r(j) */
#define SLI_XT(j, k) r##j = SLV_FNMA1(l[SLI_TILE * j + k], r##k, r##j); /* r(j) -= L(k, j) r(k) */

/* r := L^-1 r, l the tile's 8 x 8 diagonal part by columns */
SLV_FUNCTION SLI_INLINE void SLV_NAME(tile_forward)(const double *l, double *r) {
    double r0 = r[0], r1 = r[1], r2 = r[2], r3 = r[3], r4 = r[4], r5 = r[5], r6 = r[6], r7 = r[7];
    SLI_X(1, 0)
    SLI_X(2, 0)
    SLI_X(3, 0)
    SLI_X(4, 0) SLI_X(5, 0) SLI_X(6, 0) SLI_X(7, 0) SLI_X(2, 1) SLI_X(3, 1) SLI_X(4, 1) SLI_X(5, 1)
        SLI_X(6, 1) SLI_X(7, 1) SLI_X(3, 2) SLI_X(4, 2) SLI_X(5, 2) SLI_X(6, 2) SLI_X(7, 2)
            SLI_X(4, 3) SLI_X(5, 3) SLI_X(6, 3) SLI_X(7, 3) SLI_X(5, 4) SLI_X(6, 4) SLI_X(7, 4)
                SLI_X(6, 5) SLI_X(7, 5) SLI_X(7, 6) r[1] = r1;
    r[2] = r2;
    r[3] = r3;
    r[4] = r4;
    r[5] = r5;
    r[6] = r6;
    r[7] = r7;
}

/* r := L'^-1 r */
SLV_FUNCTION SLI_INLINE void SLV_NAME(tile_backward)(const double *l, double *r) {
    double r0 = r[0], r1 = r[1], r2 = r[2], r3 = r[3], r4 = r[4], r5 = r[5], r6 = r[6], r7 = r[7];
    SLI_XT(6, 7)
    SLI_XT(5, 7)
    SLI_XT(4, 7)
    SLI_XT(3, 7) SLI_XT(2, 7) SLI_XT(1, 7) SLI_XT(0, 7) SLI_XT(5, 6) SLI_XT(4, 6) SLI_XT(3, 6)
        SLI_XT(2, 6) SLI_XT(1, 6) SLI_XT(0, 6) SLI_XT(4, 5) SLI_XT(3, 5) SLI_XT(2, 5) SLI_XT(1, 5)
            SLI_XT(0, 5) SLI_XT(3, 4) SLI_XT(2, 4) SLI_XT(1, 4) SLI_XT(0, 4) SLI_XT(2, 3)
                SLI_XT(1, 3) SLI_XT(0, 3) SLI_XT(1, 2) SLI_XT(0, 2) SLI_XT(0, 1) r[0] = r0;
    r[1] = r1;
    r[2] = r2;
    r[3] = r3;
    r[4] = r4;
    r[5] = r5;
    r[6] = r6;
}

#undef SLI_X
#undef SLI_XT
/* end src/impl/tile.inl.h */

/* begin src/impl/product.inl.h */
/* product.inl.h: C -= A D B' on tiles, the loop that a factorization spends its time in; words SLV_* */

/* A block of registers holds SLV_COLUMNS columns of one row tile, or of two where an ISA has
 * registers enough: SLV_EACH_COLUMN(op, t) is op(0, t) op(1, t) .. over them. Columns past those of C
 * are computed and dropped: B has all 8 of a tile. */
#define SLI_DECLARE(k, t) SLV_DECLARE(c##t##k)
#define SLI_LOAD(k, t)                                                                             \
    if ((k) < columns) {                                                                           \
        SLV_LOAD(c##t##k, C##t + SLI_TILE * (k))                                                   \
    } else {                                                                                       \
        SLV_ZERO(c##t##k)                                                                          \
    }
#define SLI_STORE(k, t)                                                                            \
    if ((k) < columns) {                                                                           \
        SLV_STORE(C##t + SLI_TILE * (k), c##t##k)                                                  \
    }
#define SLI_UPDATE(k, unused) /* C(rows, k) -= A(rows, j) B(k, j) */                               \
    SLV_BROADCAST(b, B + (k))                                                                      \
    SLV_FNMA(c0##k, a0, b)
#define SLI_UPDATE2(k, unused)                                                                     \
    SLI_UPDATE(k, unused)                                                                          \
    SLV_FNMA(c1##k, a1, b)

/* One row tile. A: [length][8], B: [length][8] from the block's first column on, C: [columns][8]. */
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
/* Two row tiles. */
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

/* B(k, j) d(j) of column tile c's 8 rows, the columns j .. j + length - 1 of the panel. */
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

/* Tiles of the lower triangle, row tiles t0 .. t1-1 and column tiles c0 .. c1-1 (t0 >= c0), lose
 * L D L' over the panel's columns j0 .. j1-1. The target's tile (t, c) stands at tile_offset(target_width, t - target_first)
 * + 64 (c - target_first). Taken in chunks of columns j, so that
 * what a row tile needs stays in the first cache and what the group of column tiles needs in the
 * second. */
SLV_FUNCTION static void SLV_NAME(product)(const double *panel, sl_int w, const double *D,
                                           sl_int t0, sl_int t1, sl_int c0, sl_int c1, sl_int j0,
                                           sl_int j1, double *target, sl_int target_width,
                                           sl_int target_first, double *B) {
    const sl_int tile_size = SLI_TILE * SLI_TILE;
    sl_int j, t, c, k;
    for (j = j0; j < j1; j += SLI_CHUNK) {
        const sl_int length = sli_min(SLI_CHUNK, j1 - j);
        for (c = c0; c < c1; c++) {
            SLV_NAME(pack)
            (panel + sli_tile_offset(w, c) + SLI_TILE * (ptrdiff_t)j, D + j, length,
             B + (ptrdiff_t)(c - c0) * SLI_TILE * length);
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
            if (is_pair && c == t && c < c1) { /* the pair's second tile has a diagonal tile more */
                const ptrdiff_t at = (ptrdiff_t)tile_size * (c - target_first);
                SLV_NAME(block1)
                (A1, B + (ptrdiff_t)(c - c0) * SLI_TILE * length, length, C1 + at,
                 target_width - SLI_TILE * (c - target_first));
            }
#endif
        }
    }
}
/* end src/impl/product.inl.h */

/* begin src/impl/front.inl.h */
/* front.inl.h: a front of the multifrontal factorization: its panel factored, its update matrix made and handed on */

/* l(rows, k) = x(rows, k) / d(k), by the reciprocal where that loses nothing */
#define SLI_SCALE(l, x, k)                                                                         \
    if (by_reciprocal) {                                                                           \
        SLV_BROADCAST(b, reciprocal + (k))                                                         \
        SLV_MULTIPLY(l, x, b)                                                                      \
    } else {                                                                                       \
        SLV_BROADCAST(b, D + (k))                                                                  \
        SLV_DIVIDE(l, x, b)                                                                        \
    }

/* magnitude(rows) += |l d l|, with x = l d */
#define SLI_GAIN(l, x, k)                                                                          \
    SLV_BROADCAST(b, against + (k))                                                                \
    SLV_MULTIPLY(b, l, b)                                                                          \
    SLV_FNMA(m, b, x)

#define SLI_DECLARE(k, unused) SLV_DECLARE(a##k)
#define SLI_LOAD(k, p)                                                                             \
    if ((k) < columns) {                                                                           \
        SLV_LOAD(a##k, (p) + SLI_TILE * (k))                                                       \
    } else {                                                                                       \
        SLV_ZERO(a##k)                                                                             \
    }

/* The diagonal tile, column k: the pivot, then the columns after it lose l(rows) x(column). Here by
 * division, one step shorter than by the reciprocal: all wait for this chain. */
#define SLI_AFTER(i, k)                                                                            \
    if ((i) > (k)) {                                                                               \
        SLV_BROADCAST(b, x + SLI_TILE * (k) + (i))                                                 \
        SLV_FNMA(a##i, l, b)                                                                       \
    }
#define SLI_PIVOT(k, p)                                                                            \
    if ((k) < columns) {                                                                           \
        double d;                                                                                  \
        SLV_STORE(x + SLI_TILE * (k), a##k)                                                        \
        SLV_STORE(sums, m)                                                                         \
        SLV_LANE(b, a##k, k)                                                                       \
        d = x[SLI_TILE * (k) + (k)];                                                               \
        if (rule != NULL) {                                                                        \
            d = sli_pivot_ruled(rule, column + (k), d, sums[k]);                                   \
            SLV_BROADCAST(b, &d)                                                                   \
        }                                                                                          \
        SLV_DIVIDE(l, a##k, b)                                                                     \
        D[k] = d;                                                                                  \
        magnitude[k] = sums[k];                                                                    \
        against[k] = d < 0.0 ? 1.0 : -1.0;                                                         \
        reciprocal[k] = 1.0 / d;                                                                   \
        safe &= fabs(d) > 1e-290 && fabs(d) < 1e290;                                               \
        SLI_GAIN(l, a##k, k)                                                                       \
        SLV_BELOW(l, k)                                                                            \
        SLV_STORE((p) + SLI_TILE * (k), l)                                                         \
        SLI_EACH8_AGAIN(SLI_AFTER, k)                                                              \
    }

/* The tiles below: x(rows, k) -= x(rows, j) L(k, j) for j < k, then l. */
#define SLI_BEFORE(j, k)                                                                           \
    if ((j) < (k)) {                                                                               \
        SLV_BROADCAST(b, p + SLI_TILE * (j) + (k))                                                 \
        SLV_FNMA(a##k, a##j, b)                                                                    \
    }
#define SLI_SOLVE(k, q)                                                                            \
    if ((k) < columns) {                                                                           \
        SLI_EACH8_AGAIN(SLI_BEFORE, k)                                                             \
        SLI_SCALE(l, a##k, k)                                                                      \
        SLI_GAIN(l, a##k, k)                                                                       \
        SLV_STORE((q) + SLI_TILE * (k), l)                                                         \
    }

/* The pivots of column tile c, whose columns before it are done: 8, or fewer in the last one. */
SLV_FUNCTION static void SLV_NAME(pivots_of_tile)(const sli_front *f, sl_int c, double *inverse) {
    const sl_int first = SLI_TILE * c, columns = sli_min(SLI_TILE, f->width - first);
    const sl_int column = f->column + first;
    const sli_pivot_rule *rule = f->rule->replaces ? f->rule : NULL;
    double *p = f->panel + sli_tile_offset(f->width, c) + SLI_TILE * (ptrdiff_t)first;
    double *D = f->D + first, *magnitude = f->magnitude + first;
    double *reciprocal = inverse, *against = inverse + SLI_TILE;
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
    for (t = columns; t < SLI_TILE; t++) { /* rows below that share the last tile of pivots */
        magnitude[t] = sums[t];
    }
    if (!safe) {
        reciprocal[0] = 0.0;
    }
}

/* Column tile c of row tiles t0 .. t1-1, all below its pivots. */
SLV_FUNCTION static void SLV_NAME(rows_of_tile)(const sli_front *f, sl_int c, sl_int t0, sl_int t1,
                                                const double *inverse) {
    const sl_int w = f->width, first = SLI_TILE * c, columns = sli_min(SLI_TILE, w - first);
    const double *p = f->panel + sli_tile_offset(w, c) + SLI_TILE * (ptrdiff_t)first;
    const double *D = f->D + first, *reciprocal = inverse, *against = inverse + SLI_TILE;
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
}

#undef SLI_SCALE
#undef SLI_GAIN
#undef SLI_DECLARE
#undef SLI_LOAD
#undef SLI_AFTER
#undef SLI_PIVOT
#undef SLI_BEFORE
#undef SLI_SOLVE

/* Column tile c of row tiles t0 .. t1-1 before its pivots are applied: the group's columns before it. */
SLV_FUNCTION SLI_INLINE void SLV_NAME(catch_up)(const sli_front *f, sl_int c0, sl_int c, sl_int t0,
                                                sl_int t1, double *B) {
    if (c > c0) {
        SLV_NAME(product)
        (f->panel, f->width, f->D, t0, t1, c, c + 1, SLI_TILE * c0, SLI_TILE * c, f->panel,
         f->width, 0, B);
    }
}

SLV_FUNCTION static void SLV_NAME(pivots)(const sli_front *f, sl_int c0, double *B) {
    const sl_int c1 = sli_min(c0 + SLI_GROUP, sli_tiles(f->width));
    sl_int c;
    if (c0 > 0) {
        SLV_NAME(product)
        (f->panel, f->width, f->D, c0, c1, c0, c1, 0, SLI_TILE * c0, f->panel, f->width, 0, B);
    }
    for (c = c0; c < c1; c++) {
        double *inverse = f->inverse + 2 * SLI_TILE * (ptrdiff_t)(c - c0);
        SLV_NAME(catch_up)(f, c0, c, c, c1, B);
        SLV_NAME(pivots_of_tile)(f, c, inverse);
        SLV_NAME(rows_of_tile)(f, c, c + 1, c1, inverse);
    }
}

SLV_FUNCTION static void SLV_NAME(rows)(const sli_front *f, sl_int c0, sl_int t0, sl_int t1,
                                        double *B) {
    const sl_int c1 = sli_min(c0 + SLI_GROUP, sli_tiles(f->width));
    sl_int c;
    if (c0 > 0) {
        SLV_NAME(product)
        (f->panel, f->width, f->D, t0, t1, c0, c1, 0, SLI_TILE * c0, f->panel, f->width, 0, B);
    }
    for (c = c0; c < c1; c++) {
        SLV_NAME(catch_up)(f, c0, c, t0, t1, B);
        SLV_NAME(rows_of_tile)
        (f, c, t0, t1, f->inverse + 2 * SLI_TILE * (ptrdiff_t)(c - c0));
    }
}

SLV_FUNCTION static void SLV_NAME(update)(const sli_front *f, sl_int c0, sl_int c1, sl_int t0,
                                          sl_int t1, double *B) {
    const sl_int w = f->width, last = sli_min(c1, t1);
    sl_int c;
    for (c = c0; c < last; c += SLI_GROUP) {
        SLV_NAME(product)
        (f->panel, w, f->D, sli_max(t0, c), t1, c, sli_min(c + SLI_GROUP, last), 0, w, f->update,
         SLI_TILE * (t1 - c0), c0, B);
    }
}

/* What a child hands over, row by row of the parent's tiles: the run of the child's rows that fall
 * from one of its tiles into one of the parent's moves as a whole, spread by a mask of lanes, through
 * all columns. What stands above the diagonal moves along and is never read. */
SLV_FUNCTION static void SLV_NAME(assemble)(const sli_front *f, const double *from, sl_int skipped,
                                            const sl_int *places, sl_int columns, sl_int first,
                                            sl_int last) {
    const sl_int w = f->width, whole = w / SLI_TILE;
    sl_int row, end, i;
    for (row = first; row < last; row = end) {
        const sl_int lane = (skipped + row) % SLI_TILE, tile = places[row] / SLI_TILE;
        const double *source = from + sli_triangle_offset((skipped + row) / SLI_TILE) +
                               SLI_TILE * (ptrdiff_t)skipped + lane;
        double *const to[2] = {f->panel, f->update};
        const ptrdiff_t at[2] = {(ptrdiff_t)sli_tile_offset(w, tile),
                                 (ptrdiff_t)sli_triangle_offset(tile - whole) -
                                     SLI_TILE * SLI_TILE * (ptrdiff_t)whole};
        sl_int lanes[SLI_TILE];
        unsigned mask = 0;
        for (end = row; end < last && end - row < SLI_TILE - lane && places[end] / SLI_TILE == tile;
             end++) {
            lanes[end - row] = places[end] % SLI_TILE;
            mask |= 1u << lanes[end - row];
        }
        {
            SLV_SPREAD(mask, lanes, end - row)
            for (i = 0; i < end && i < columns; i++) {
                const int is_below =
                    places[i] >= w; /* the panel or the update matrix, not a branch */
                double *target = to[is_below] + (at[is_below] + SLI_TILE * (ptrdiff_t)places[i]);
                SLV_SPREAD_ADD(target, source + SLI_TILE * (ptrdiff_t)i)
            }
        }
    }
}
/* end src/impl/front.inl.h */

/* begin src/impl/takahashi.inl.h */
/* takahashi.inl.h: a front of the inverse: gathered from the parent's front, completed column group by column group */

/* C(rows, k) -= A(rows, j) B(k, j), one row tile; A and B: [length][8], C: [columns][8]. */
SLV_FUNCTION SLI_INLINE void SLV_NAME(block)(const double *A, const double *B, sl_int length,
                                             double *C, sl_int columns) {
    sl_int k;
    for (k = 0; k < columns; k += SLV_COLUMNS) {
        SLV_NAME(block1)(A, B + k, length, C + SLI_TILE * (ptrdiff_t)k, columns - k);
    }
}

#define SLI_STORE(k, p)                                                                            \
    if ((k) < columns) {                                                                           \
        SLV_STORE((p) + SLI_TILE * (k), a)                                                         \
    }

/* The first columns of a tile := 0. Not as a loop: compilers make rep stos of one, and what reads the tile next waits
 * for it. */
SLV_FUNCTION SLI_INLINE void SLV_NAME(clear)(double *x, sl_int columns) {
    SLV_DECLARE(a)
    SLV_ZERO(a)
    SLI_EACH8(SLI_STORE, x)
}

#undef SLI_STORE

#define SLI_OFFSET(k) offset[k]

/* Z of the rows below, row tiles t0 .. t1-1, out of the parent's front: row and column i of theirs is row and
 * column places[i] there. Lanes of other rows get the numbers of a neighbour, which nothing reads. */
SLV_FUNCTION static void SLV_NAME(gather)(const sli_dual *f, const double *from, sl_int height,
                                          const sl_int *places, sl_int t0, sl_int t1) {
    const sl_int w = f->width, u = f->below;
    sl_int t, i;
    for (t = sli_max(t0, w / SLI_TILE); t < t1 && u > 0; t++) {
        double *to = f->front + sli_square_offset(w + u, t) + SLI_TILE * (ptrdiff_t)w;
        ptrdiff_t offset[SLI_TILE];
        for (i = 0; i < SLI_TILE; i++) {
            const sl_int place = places[sli_clamp(SLI_TILE * t + i - w, u - 1)];
            offset[i] = sli_square_offset(height, place / SLI_TILE) + place % SLI_TILE;
        }
        for (i = 0; i < u; i++) {
            const double *x = from + SLI_TILE * (ptrdiff_t)places[i];
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
#define SLI_BEFORE(j, k)                                                                           \
    if ((j) < (k)) {                                                                               \
        SLV_BROADCAST(b, l + SLI_TILE * (j) + (k))                                                 \
        SLV_FNMA(a##k, a##j, b)                                                                    \
    }
#define SLI_SOLVE(k, unused)                                                                       \
    if ((k) < columns) {                                                                           \
        SLI_EACH8_AGAIN(SLI_BEFORE, k)                                                             \
    }

/* x(rows, k) -= x(rows, j) L(k, j) for j < k in the 8 x 8 unit triangle at l: x := x L'^-1. */
SLV_FUNCTION SLI_INLINE void SLV_NAME(after_triangle)(const double *l, double *x, sl_int columns) {
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

/* N = -L'^-1 of a group of m columns from j0 on, row tiles c0 .. c1-1, row tile c from column 8c on, 0 where it
 * has no row; and P = -N D^-1. */
SLV_FUNCTION SLI_INLINE void SLV_NAME(group_inverse)(const sli_dual *f, sl_int j0, sl_int c0,
                                                     sl_int c1, double *scratch) {
    const sl_int m = sli_dual_columns(f, j0), tiles = sli_tiles(m), tile_size = SLI_TILE * SLI_TILE;
    double *N = scratch + SLI_DUAL_ROW * (ptrdiff_t)c0, *P = N + SLI_DUAL_GROUP * SLI_DUAL_ROW;
    sl_int c, t, k;
    for (c = c0; c < c1; c++, N += SLI_DUAL_ROW, P += SLI_DUAL_ROW) {
        for (t = c; t < tiles; t++) {
            const sl_int columns = sli_min(SLI_TILE, m - SLI_TILE * t);
            const double *l =
                f->panel + sli_tile_offset(f->width, j0 / SLI_TILE + t) + SLI_TILE * (ptrdiff_t)j0;
            double *x = N + tile_size * (ptrdiff_t)t;
            SLV_NAME(clear)(x, SLI_TILE);
            for (k = 0; k < columns && t == c; k++) {
                x[SLI_TILE * k + k] = -1.0;
            }
            if (t > c) { /* N(c, t) -= N(c, c..t-1) L(t, c..t-1)' */
                SLV_NAME(block)
                (N + tile_size * (ptrdiff_t)c, l + tile_size * (ptrdiff_t)c, SLI_TILE * (t - c), x,
                 columns);
            }
            SLV_NAME(after_triangle)(l + tile_size * (ptrdiff_t)t, x, columns);
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

/* W' = (L_SJ L_JJ^-1)', row tiles t0 .. t1-1 of the panel: [column tile][row][8 columns]. */
SLV_FUNCTION SLI_INLINE void SLV_NAME(group_weights)(const sli_dual *f, sl_int j0, sl_int t0,
                                                     sl_int t1, double *scratch) {
    const sl_int m = sli_dual_columns(f, j0), tile_size = SLI_TILE * SLI_TILE;
    const ptrdiff_t stride = sli_dual_stride(f, j0);
    const double *N = scratch;
    double *W = sli_dual_weights(scratch) + tile_size * (ptrdiff_t)(t0 - (j0 + m) / SLI_TILE);
    sl_int c, t;
    for (c = 0; c < sli_tiles(m); c++, N += SLI_DUAL_ROW, W += stride) {
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

/* Z_SJ -= Z_SS W, row tiles t0 .. t1-1, in chunks as in a factorization. */
SLV_FUNCTION SLI_INLINE void SLV_NAME(group_product)(const sli_dual *f, sl_int j0, sl_int t0,
                                                     sl_int t1, double *scratch) {
    const sl_int m = sli_dual_columns(f, j0), h = f->width + f->below, first = j0 + m;
    const ptrdiff_t stride = sli_dual_stride(f, j0), tile_size = SLI_TILE * SLI_TILE;
    const double *W = sli_dual_weights(scratch) + SLI_TILE * (ptrdiff_t)(first % SLI_TILE);
    sl_int t, c, s;
    for (t = t0; t < t1; t++) {
        double *row = f->front + sli_square_offset(h, t) + SLI_TILE * (ptrdiff_t)j0;
        for (c = 0; c < sli_tiles(m); c++) {
            SLV_NAME(clear)(row + tile_size * c, m - SLI_TILE * c);
        }
    }
    for (s = first; s < h; s += SLI_CHUNK) {
        const sl_int length = sli_min(SLI_CHUNK, h - s);
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

/* The first lanes of some columns of a tile at to become those at from: rows below share the others. */
SLV_FUNCTION SLI_INLINE void SLV_NAME(merge)(double *to, const double *from, sl_int lanes,
                                             sl_int first, sl_int last) {
    sl_int k;
    SLV_DECLARE(a)
    SLV_DECLARE(b)
    for (k = first; k < last; k++) {
        SLV_LOAD(a, from + SLI_TILE * k)
        SLV_LOAD(b, to + SLI_TILE * k)
        SLV_FIRST(a, lanes)
        SLV_BELOW(b, lanes - 1)
        SLV_ADD(a, b)
        SLV_STORE(to + SLI_TILE * k, a)
    }
}

/* Lanes first .. last-1 of the first columns of a tile to the columns and lanes of another. */
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

/* Z_JS = Z_SJ', columns of the row tiles t0 .. t1-1. */
SLV_FUNCTION SLI_INLINE void SLV_NAME(group_mirror)(const sli_dual *f, sl_int j0, sl_int t0,
                                                    sl_int t1) {
    const sl_int m = sli_dual_columns(f, j0), h = f->width + f->below;
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

/* Z_JJ = L_JJ'^-1 D^-1 L_JJ^-1 - W' Z_SJ, the lower tiles of the group's row tiles t0 .. t1-1 and what mirrors
 * them. */
SLV_FUNCTION SLI_INLINE void SLV_NAME(group_square)(const sli_dual *f, sl_int j0, sl_int t0,
                                                    sl_int t1, double *scratch) {
    const sl_int m = sli_dual_columns(f, j0), h = f->width + f->below, first = j0 + m;
    const sl_int tile_size = SLI_TILE * SLI_TILE;
    const ptrdiff_t stride = sli_dual_stride(f, j0);
    const double *N = scratch, *P = N + SLI_DUAL_GROUP * SLI_DUAL_ROW,
                 *W = sli_dual_weights(scratch) + SLI_TILE * (ptrdiff_t)(first % SLI_TILE);
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
            (N + SLI_DUAL_ROW * (ptrdiff_t)t + tile_size * (ptrdiff_t)t,
             P + SLI_DUAL_ROW * (ptrdiff_t)c + tile_size * (ptrdiff_t)t, m - SLI_TILE * t, x,
             columns);
            if (first < h) {
                SLV_NAME(block)
                (W + t * stride, column + SLI_TILE * (ptrdiff_t)first, h - first, x, columns);
            }
            SLV_NAME(merge)(row + tile_size * (ptrdiff_t)c, x, rows, 0, columns);
            if (c < t) {
                SLV_NAME(mirror)
                (x, 0, rows, column + SLI_TILE * (ptrdiff_t)j0 + tile_size * (ptrdiff_t)t,
                 SLI_TILE);
            }
        }
    }
}

SLV_FUNCTION static void SLV_NAME(dual)(const sli_dual *f, sl_int j0, sli_dual_part part, sl_int t0,
                                        sl_int t1, double *scratch) {
    switch (part) {
    case SLI_DUAL_INVERSE:
        SLV_NAME(group_inverse)(f, j0, t0, t1, scratch);
        break;
    case SLI_DUAL_WEIGHTS:
        SLV_NAME(group_weights)(f, j0, t0, t1, scratch);
        break;
    case SLI_DUAL_PRODUCT:
        SLV_NAME(group_product)(f, j0, t0, t1, scratch);
        break;
    case SLI_DUAL_MIRROR:
        SLV_NAME(group_mirror)(f, j0, t0, t1);
        break;
    default:
        SLV_NAME(group_square)(f, j0, t0, t1, scratch);
    }
}

/* From the last group of columns to the first, each with the columns after it among its rows below:
 * what a group works upon stays in the caches, whatever the width. */
SLV_FUNCTION static void SLV_NAME(takahashi)(const sli_dual *f, double *scratch) {
    sl_int j0;
    for (j0 = sli_dual_last(f); j0 + SLI_DUAL_COLUMNS > f->first; j0 -= SLI_DUAL_COLUMNS) {
        const sli_span group = sli_dual_span(f, j0, SLI_DUAL_INVERSE);
        const sli_span below = sli_dual_span(f, j0, SLI_DUAL_WEIGHTS);
        SLV_NAME(group_inverse)(f, j0, group.first, group.last, scratch);
        if (below.first < below.last) {
            SLV_NAME(group_weights)(f, j0, below.first, below.last, scratch);
            SLV_NAME(group_product)(f, j0, below.first, below.last, scratch);
            SLV_NAME(group_mirror)(f, j0, below.first, below.last);
        }
        SLV_NAME(group_square)(f, j0, group.first, group.last, scratch);
    }
}
/* end src/impl/takahashi.inl.h */

/* begin src/impl/narrow.inl.h */
/* narrow.inl.h: one right-hand side through a supernode of 1 to 8 columns, all of them in registers; words SLV_* */

/* Most supernodes of a 2D mesh are as narrow as this, and what they cost is not the reading of L but
 * loops that end at once, calls, and vectors loaded where single numbers were just stored. Here the
 * width is a constant that is folded into each of 8 copies: the loops over columns are gone, y or
 * the sums of all columns stay in registers, and x is gathered straight into them. */
#define SLI_DECLARE(k, y) SLV_DECLARE(y##k)
#define SLI_SUM_DECLARE(k, a) SLV_SUM_DECLARE(a##k)
#define SLI_SUM_ZERO(k, a) SLV_SUM_ZERO(a##k)

/* the diagonal tile, column after column; L is 0 above its diagonal */
#define SLI_COLUMN(k, unused)                                                                      \
    if ((k) < w) {                                                                                 \
        SLI_PREFETCH(l + SLI_TILE * (k), SLI_AHEAD);                                               \
        SLV_LANE(y##k, a, k)                                                                       \
        SLV_DOT(a, l + SLI_TILE * (k), y##k)                                                       \
    }
/* a tile below: even columns into one sum, odd ones into another */
#define SLI_EVEN_ODD(k, unused)                                                                    \
    if ((k) < w) {                                                                                 \
        SLI_PREFETCH(l + SLI_TILE * (k), SLI_AHEAD);                                               \
        if ((k) % 2 == 0) {                                                                        \
            SLV_DOT(a, l + SLI_TILE * (k), y##k)                                                   \
        } else {                                                                                   \
            SLV_DOT(b, l + SLI_TILE * (k), y##k)                                                   \
        }                                                                                          \
    }

SLV_FUNCTION SLI_ALWAYS_INLINE void SLV_NAME(narrow_forward)(const sl_int w, sl_int below,
                                                             const sl_int *rows, const double *l,
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
    for (row = SLI_TILE; row < w + below; row += SLI_TILE) { /* y(rows) -= L(rows, j) y(j) */
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

/* x(j) -= L(rows, j)' x(rows), from the last column down as L is read backward in memory */
#define SLI_DOT(k)                                                                                 \
    if ((k) < w) {                                                                                 \
        SLI_PREFETCH(l + SLI_TILE * (k), -SLI_AHEAD);                                              \
        SLV_SUM_DOT(a##k, l + SLI_TILE * (k), v)                                                   \
    }
#define SLI_DOTS                                                                                   \
    SLI_DOT(7) SLI_DOT(6) SLI_DOT(5) SLI_DOT(4) SLI_DOT(3) SLI_DOT(2) SLI_DOT(1) SLI_DOT(0)
/* places of the 8 rows of a tile; of a tile of fewer rows, the last one again; of those that share
 * the tile of the columns, anything for the columns' lanes */
#define SLI_PLACE(k) rows[at + (k)]
#define SLI_PLACE_PART(k) rows[at + sli_min(k, count - 1)]
#define SLI_PLACE_OWN(k) rows[sli_clamp((k)-w, at - 1)]
#define SLI_SET(k, unused) double r##k = r[k];
#define SLI_GET(k, unused)                                                                         \
    if ((k) < w) {                                                                                 \
        xs[k] = r##k;                                                                              \
    }
#define SLI_XT(j, k)                                                                               \
    if ((j) < (k) && (k) < w) { /* r(j) -= L(k, j) r(k) */                                         \
        r##j = SLV_FNMA1(l[SLI_TILE * (j) + (k)], r##k, r##j);                                     \
    }
#define SLI_ROW(k)                                                                                 \
    SLI_XT(6, k) SLI_XT(5, k) SLI_XT(4, k) SLI_XT(3, k) SLI_XT(2, k) SLI_XT(1, k) SLI_XT(0, k)

/* l points at the panel's end. */
SLV_FUNCTION SLI_ALWAYS_INLINE void SLV_NAME(narrow_backward)(const sl_int w, sl_int below,
                                                              const sl_int *rows, const double *l,
                                                              const double *d, double *xs,
                                                              const double *x) {
    const sl_int count = (w + below) % SLI_TILE;
    sl_int row = w + below - count, at = below;
    double r[SLI_TILE];
    SLV_DECLARE(v)
    SLV_DECLARE(z)
    SLI_EACH8(SLI_SUM_DECLARE, a)
    SLI_EACH8(SLI_SUM_ZERO, a)
    if (row > 0 && count > 0) {
        at -= count;
        l -= SLI_TILE * w;
        SLV_GATHER(v, x, SLI_PLACE_PART)
        SLV_FIRST(v, count)
        SLI_DOTS
    }
    for (; row > SLI_TILE; row -= SLI_TILE) {
        at -= SLI_TILE;
        l -= SLI_TILE * w;
        SLV_GATHER(v, x, SLI_PLACE)
        SLI_DOTS
    }
    l -= SLI_TILE * w;
    if (w < SLI_TILE && at > 0) {
        SLV_GATHER(v, x, SLI_PLACE_OWN)
        SLV_FIRST(v, w + at)
        SLV_BELOW(v, w - 1)
        SLI_DOTS
    }
    SLV_LOAD_PART(z, xs, w, 0.0)
    SLV_LOAD_PART(v, d, w, 1.0)
    SLV_DIVIDE(z, z, v)
    SLV_SUMS(v, a)
    SLV_ADD(v, z)
    SLV_STORE_ANY(r, v) {
        SLI_EACH8(SLI_SET, 0)
        SLI_ROW(7)
        SLI_ROW(6) SLI_ROW(5) SLI_ROW(4) SLI_ROW(3) SLI_ROW(2) SLI_ROW(1) SLI_EACH8(SLI_GET, 0)
    }
}

#define SLI_FORWARD(k) SLV_NAME(narrow_forward)(k, below, rows, l, xs, x, buf)
#define SLI_BACKWARD(k) SLV_NAME(narrow_backward)(k, below, rows, l, d, xs, x)

SLV_FUNCTION SLI_INLINE void SLV_NAME(forward_narrow)(sl_int w, sl_int below, const sl_int *rows,
                                                      const double *l, double *xs, double *x,
                                                      double *buf){SLI_CASES(SLI_FORWARD)}

SLV_FUNCTION SLI_INLINE
    void SLV_NAME(backward_narrow)(sl_int w, sl_int below, const sl_int *rows, const double *l,
                                   const double *d, double *xs, const double *x) {
    SLI_CASES(SLI_BACKWARD)
}

#undef SLI_DECLARE
#undef SLI_SUM_DECLARE
#undef SLI_SUM_ZERO
#undef SLI_COLUMN
#undef SLI_EVEN_ODD
#undef SLI_DOT
#undef SLI_DOTS
#undef SLI_PLACE
#undef SLI_PLACE_PART
#undef SLI_PLACE_OWN
#undef SLI_SET
#undef SLI_GET
#undef SLI_XT
#undef SLI_ROW
#undef SLI_FORWARD
#undef SLI_BACKWARD
/* end src/impl/narrow.inl.h */

/* begin src/impl/body.inl.h */
/* body.inl.h: one right-hand side, SIMD along the 8 rows of a tile; the words SLV_* are one octet of doubles */

/* buf := L^-1 buf on the first `rows` local rows of a panel, its columns 8 t0 .. columns-1 applied
 * in ascending order. tile points at tile t0. Four partial sums hide the latency of the FMA; their
 * grouping depends on the column number alone, so that a sweep that starts later, over zeros, gives
 * the same bits. */
SLV_FUNCTION SLI_INLINE void SLV_NAME(panel_forward)(const double *tile, sl_int t0, sl_int width,
                                                     sl_int columns, sl_int rows, double *buf) {
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
        for (j = first; j + 4 <= final; j += 4) { /* y(rows) -= L(rows, j) y(j) */
            const double *l = tile + SLI_TILE * j;
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
            SLV_NAME(tile_forward)(tile + SLI_TILE * row, buf + row);
        } else {
            for (k = 0; k < inner; k++) { /* columns inside the tile, one after the other */
                SLV_AXPY(a0, tile + SLI_TILE * (row + k), buf + row + k)
                SLV_STORE(buf + row, a0)
            }
        }
        tile += SLI_TILE * sli_min(width, row + SLI_TILE);
    }
}

SLV_FUNCTION static void SLV_NAME(forward)(sl_int count, const sli_step *s, const sl_int *rows,
                                           const double *L, double *x, double *buf) {
    for (; count > 0; count--, s++) {
        const sl_int w = s->width, height = w + s->below, first = SLI_TILE * s->first_tile;
        const double *tile = L + s->panel + sli_tile_offset(w, s->first_tile);
        double *xs = x + s->base;
        sl_int i;
        if (w <= SLI_TILE) {
            SLV_NAME(forward_narrow)(w, s->below, rows, tile, xs, x, buf);
            rows += s->below;
            continue;
        }
        memcpy(buf + first, xs, (size_t)(w - first) * sizeof(double));
        for (i = w; i < SLI_TILE * sli_tiles(height); i++) {
            buf[i] = 0.0;
        }
        SLV_NAME(panel_forward)(tile, s->first_tile, w, w, height, buf);
        memcpy(xs, buf + first, (size_t)(w - first) * sizeof(double));
        for (i = 0; i < s->below; i++) {
            x[rows[i]] += buf[w + i];
        }
        rows += s->below;
    }
}

/* The backward pass leaves 8 partial sums a column, or fewer where an octet takes several registers:
 * sums(j) -= L(rows, j)' x(rows) over the columns first .. final-1 of one row tile, or of two at
 * once, which spares half of the loads and stores of the sums. */
#define SLI_DECLARE(k, a) SLV_DECLARE(a##k)
#define SLI_SUM_DECLARE(k, a) SLV_SUM_DECLARE(a##k)
#define SLI_PLACE(k) rows[at + (k)]
#define SLI_PLACE_PART(k) rows[at + sli_clamp((k)-inner, part - 1)]

SLV_FUNCTION SLI_INLINE void SLV_NAME(dots1)(const double *l, const double *x, sl_int first,
                                             sl_int final, double *sums) {
    ptrdiff_t j;
    SLV_DECLARE(v)
    SLV_SUM_DECLARE(a)
    SLV_LOAD(v, x)
    for (j = SLI_TILE * ((ptrdiff_t) final - 1); j >= SLI_TILE * (ptrdiff_t)first; j -= SLI_TILE) {
        SLI_PREFETCH(l + j, -SLI_AHEAD);
        SLV_SUM_LOAD(a, sums + j)
        SLV_SUM_DOT(a, l + j, v)
        SLV_SUM_STORE(sums + j, a)
    }
}

/* Two tiles: l0 and its 8 rows at x, l1 and the 8 rows after those. */
SLV_FUNCTION SLI_INLINE void SLV_NAME(dots2)(const double *l0, const double *l1, const double *x,
                                             sl_int first, sl_int final, double *sums) {
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

/* The diagonal tile of the columns row .. row+inner-1: what the rows below them left is summed, the
 * right side added, the triangle solved. l: the tile's diagonal part. */
#define SLI_TAKE_SUM(k, unused)                                                                    \
    if ((k) < inner) {                                                                             \
        SLV_SUM_LOAD(a##k, sums + SLI_TILE * (k))                                                  \
        if (inner < SLI_TILE) {                                                                    \
            SLV_SUM_DOT(a##k, l + SLI_TILE * (k), v)                                               \
        }                                                                                          \
    } else {                                                                                       \
        SLV_SUM_ZERO(a##k)                                                                         \
    }
SLV_FUNCTION SLI_INLINE void SLV_NAME(diagonal)(const double *l, sl_int inner, const double *sums,
                                                const double *d, double *xs, double *buf) {
    double r[SLI_TILE];
    sl_int j, k;
    SLV_DECLARE(v)
    SLV_DECLARE(z)
    SLI_EACH8(SLI_SUM_DECLARE, a)
    SLV_ZERO(v)
    if (inner < SLI_TILE) { /* buf is 0 on the columns: only rows below count here */
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
        SLV_NAME(tile_backward)(l, r);
    } else {
        for (k = inner - 1; k > 0; k--) { /* x(j) -= L(k, j) x(k) */
            for (j = 0; j < k; j++) {
                r[j] = SLV_FNMA1(l[SLI_TILE * j + k], r[k], r[j]);
            }
        }
    }
    for (k = 0; k < inner; k++) {
        xs[k] = buf[k] = r[k];
    }
}

/* buf: the rows of two tiles; behind them the sums. */
SLV_FUNCTION static void SLV_NAME(backward)(sl_int count, const sli_step *s, const sl_int *rows_end,
                                            const double *L, const double *D, double *x,
                                            double *buf) {
    const int by_two = count <= SLI_FEW_STEPS;
    for (s += count; count > 0; count--) {
        const sl_int w = (--s)->width, height = w + s->below, first = SLI_TILE * s->first_tile;
        const double *d = D + s->column - first, *tile = L + s->panel + sli_panel_size(w, s->below);
        double *xs = x + s->base - first, *sums = buf + 2 * SLI_TILE;
        const sl_int *rows = rows_end -= s->below;
        sl_int row = SLI_TILE * (sli_tiles(height) - 1), j;
        SLV_DECLARE(v)
        SLV_SUM_DECLARE(a)
        if (w <= SLI_TILE) {
            SLV_NAME(backward_narrow)(w, s->below, rows, tile, d, xs, x);
            continue;
        }
        SLV_SUM_ZERO(a)
        for (j = first; j < w; j++) {
            SLV_SUM_STORE(sums + SLI_TILE * (ptrdiff_t)j, a)
        }
        for (; row >= first; row -= SLI_TILE) {
            const sl_int inner = sli_clamp(w - row, SLI_TILE), final = sli_min(row, w);
            const sl_int at = row + inner - w, part = sli_min(height - row, SLI_TILE) - inner;
            const double *above;
            tile -= SLI_TILE * (ptrdiff_t)sli_min(w, row + SLI_TILE);
            above = tile - SLI_TILE * (ptrdiff_t) final;
            if (part == SLI_TILE) {
                SLV_GATHER(v, x, SLI_PLACE)
                SLV_STORE(buf + SLI_TILE, v)
            } else if (inner < SLI_TILE) { /* rows below, between zeros */
                SLV_ZERO(v)
                if (part > 0) {
                    SLV_GATHER(v, x, SLI_PLACE_PART)
                    SLV_FIRST(v, inner + part)
                }
                SLV_STORE(buf + SLI_TILE, v)
                for (j = 0; j < inner; j++) {
                    buf[SLI_TILE + j] = 0.0;
                }
            }
            if (inner > 0) {
                SLV_NAME(diagonal)
                (tile + SLI_TILE * (ptrdiff_t)row, inner, sums + SLI_TILE * (ptrdiff_t)row, d + row,
                 xs + row, buf + SLI_TILE);
            }
            if (!by_two || row == first || (inner == 0 && row - SLI_TILE < w)) {
                SLV_NAME(dots1)(tile, buf + SLI_TILE, first, final, sums);
                continue;
            }
            row -= SLI_TILE;
            if (inner == 0) {
                rows -= SLI_TILE;
                SLV_GATHER(v, x, SLI_PLACE)
                rows += SLI_TILE;
                SLV_STORE(buf, v)
                SLV_NAME(dots2)(above, tile, buf, first, w, sums);
            } else {
                SLV_NAME(dots1)(tile, buf + SLI_TILE, row, final, sums);
                SLV_NAME(diagonal)
                (above + SLI_TILE * (ptrdiff_t)row, SLI_TILE, sums + SLI_TILE * (ptrdiff_t)row,
                 d + row, xs + row, buf);
                SLV_NAME(dots2)(above, tile, buf, first, row, sums);
            }
            tile = above;
        }
    }
}

#undef SLI_DECLARE
#undef SLI_SUM_DECLARE
#undef SLI_PLACE
#undef SLI_PLACE_PART
#undef SLI_TAKE_SUM

SLV_FUNCTION static void SLV_NAME(row)(double *panel, sl_int w, sl_int q, const sl_int *rows,
                                       const double *D, double *xs, double *x, double *buf,
                                       double *pivot, double *magnitude) {
    const sl_int columns = sli_min(q, w);
    double *lq = panel + sli_panel_at(w, q, 0);
    double d = *pivot, size = *magnitude;
    sl_int i;
    for (i = 0; i < columns; i++) { /* y = row of A minus what the descendants sent */
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
    for (i = 0; i < columns; i++) { /* l(k, j) = y(j) / d(j), d(k) -= l(k, j) y(j) */
        const double l = buf[i] / D[i];
        lq[SLI_TILE * i] = l;
        d = SLV_FNMA1(l, buf[i], d);
        size += fabs(l * buf[i]);
    }
    *pivot = d;
    *magnitude = size;
}

static const sli_kernels SLV_NAME(kernels) = {
    SLV_ISA,
    {SLV_NAME(forward), SLV_NAME(forward2), SLV_NAME(forward4), SLV_NAME(forward8)},
    {SLV_NAME(backward), SLV_NAME(backward2), SLV_NAME(backward4), SLV_NAME(backward8)},
    SLV_NAME(row),
    SLV_NAME(pivots),
    SLV_NAME(rows),
    SLV_NAME(update),
    SLV_NAME(assemble),
    SLV_NAME(products8),
    SLV_NAME(gather),
    SLV_NAME(dual),
    SLV_NAME(takahashi)};
/* end src/impl/body.inl.h */

/* begin src/impl/words_end.inl.h */
/* words_end.inl.h: takes the octet words back, for the next instruction set */
#undef SLV_NAME
#undef SLV_ISA
#undef SLV_FUNCTION
#undef SLV_DECLARE
#undef SLV_ZERO
#undef SLV_LOAD
#undef SLV_STORE
#undef SLV_ADD
#undef SLV_AXPY
#undef SLV_DOT
#undef SLV_FNMA1
#undef SLV_STORE_ANY
#undef SLV_FNMA
#undef SLV_TWICE_LOW
#undef SLV_TWICE_HIGH
#undef SLV_TWICE_AT
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
#undef SLV_SPREAD
#undef SLV_SPREAD_ADD
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
/* end src/impl/words_end.inl.h */

#endif
/* end src/impl/isa_scalar.h */
/* begin src/impl/isa_avx2.h */
/* isa_avx2.h: the kernels in AVX2 and FMA: an octet is two registers */
#ifndef SLI_ISA_AVX2_H
#define SLI_ISA_AVX2_H

#if defined(SLI_X86)

#define SLV_NAME(f) sli_##f##_avx2
#define SLV_ISA SL_ISA_AVX2
#define SLV_FUNCTION SLI_TARGET("avx2,fma")
#define SLV_FNMA1(a, b, c) __builtin_fma(-(a), b, c) /* c - a b */

/* All bits in the lanes from k on, k = -3 .. 8. */
SLV_FUNCTION SLI_INLINE __m256d sli_lanes_from(int k) {
    return _mm256_castsi256_pd(
        _mm256_cmpgt_epi64(_mm256_set_epi64x(3, 2, 1, 0), _mm256_set1_epi64x(k - 1)));
}

/* The first count lanes from p, rest in the others: count = -3 .. 8. */
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

/* The first lanes of a quad to the lanes of a mask: pairs of 32-bit lanes, -1 where nothing goes. */
SLV_FUNCTION SLI_INLINE __m256i sli_spread(unsigned mask) {
    int index[8], k, from = 0;
    for (k = 0; k < 4; k++) {
        const int is_set = (mask >> k & 1u) != 0;
        index[2 * k] = is_set ? 2 * from : -1;
        index[2 * k + 1] = is_set ? 2 * from + 1 : -1;
        from += is_set;
    }
    return _mm256_loadu_si256((const __m256i *)(const void *)index);
}

SLV_FUNCTION SLI_INLINE __m256d sli_spread_keep(__m256i spread) {
    return _mm256_castsi256_pd(_mm256_cmpgt_epi32(spread, _mm256_set1_epi32(-1)));
}

SLV_FUNCTION SLI_INLINE __m256d sli_spread_4(__m256d a, __m256i spread, __m256d keep) {
    return _mm256_and_pd(_mm256_castps_pd(_mm256_permutevar8x32_ps(_mm256_castpd_ps(a), spread)),
                         keep);
}

#define SLV_DECLARE(a) __m256d a##_0, a##_1;
#define SLV_ZERO(a) a##_0 = a##_1 = _mm256_setzero_pd();
#define SLV_LOAD(a, p) a##_0 = _mm256_load_pd(p), a##_1 = _mm256_load_pd((p) + 4);
#define SLV_STORE(p, a) _mm256_store_pd((p), a##_0), _mm256_store_pd((p) + 4, a##_1);
#define SLV_ADD(a, b) a##_0 = _mm256_add_pd(a##_0, b##_0), a##_1 = _mm256_add_pd(a##_1, b##_1);
#define SLV_AXPY(a, l, p)                                                                          \
    {                                                                                              \
        const __m256d s_ = _mm256_broadcast_sd(p);                                                 \
        a##_0 = _mm256_fnmadd_pd(_mm256_load_pd(l), s_, a##_0);                                    \
        a##_1 = _mm256_fnmadd_pd(_mm256_load_pd((l) + 4), s_, a##_1);                              \
    }
#define SLV_DOT(a, l, v)                                                                           \
    a##_0 = _mm256_fnmadd_pd(_mm256_load_pd(l), v##_0, a##_0),                                     \
    a##_1 = _mm256_fnmadd_pd(_mm256_load_pd((l) + 4), v##_1, a##_1);
#define SLV_STORE_ANY(p, a) _mm256_storeu_pd((p), a##_0), _mm256_storeu_pd((p) + 4, a##_1);
#define SLV_FNMA(a, b, c)                                                                          \
    a##_0 = _mm256_fnmadd_pd(b##_0, c##_0, a##_0), a##_1 = _mm256_fnmadd_pd(b##_1, c##_1, a##_1);
#define SLV_LOAD_PART(a, p, count, rest)                                                           \
    a##_0 = sli_load_part((p), (count), (rest)), a##_1 = sli_load_part((p) + 4, (count)-4, (rest));
#define SLV_FIRST(a, count)                                                                        \
    a##_0 = _mm256_andnot_pd(sli_lanes_from(count), a##_0),                                        \
    a##_1 = _mm256_andnot_pd(sli_lanes_from((count)-4), a##_1);
#define SLV_LANE(b, a, k)                                                                          \
    b##_0 = b##_1 = _mm256_permute4x64_pd((k) < 4 ? a##_0 : a##_1, (k) % 4 * 0x55);
#define SLV_GATHER(a, x, at)                                                                       \
    a##_0 = _mm256_set_pd((x)[at(3)], (x)[at(2)], (x)[at(1)], (x)[at(0)]),                         \
    a##_1 = _mm256_set_pd((x)[at(7)], (x)[at(6)], (x)[at(5)], (x)[at(4)]);
/* one register a column: two would leave none for L */
#define SLV_SUM_DECLARE(a) __m256d a;
#define SLV_SUM_ZERO(a) a = _mm256_setzero_pd();
#define SLV_SUM_LOAD(a, p) a = _mm256_load_pd(p);
#define SLV_SUM_STORE(p, a) _mm256_store_pd((p), a);
#define SLV_SUM_DOT(a, l, v)                                                                       \
    a = _mm256_fnmadd_pd(_mm256_load_pd(l), v##_0, a);                                             \
    a = _mm256_fnmadd_pd(_mm256_load_pd((l) + 4), v##_1, a);
#define SLV_SUM_4(a, b, c, d)                                                                      \
    _mm256_add_pd(_mm256_permute2f128_pd(_mm256_hadd_pd(a, b), _mm256_hadd_pd(c, d), 0x20),        \
                  _mm256_permute2f128_pd(_mm256_hadd_pd(a, b), _mm256_hadd_pd(c, d), 0x31))
#define SLV_SUMS(r, a)                                                                             \
    r##_0 = SLV_SUM_4(a##0, a##1, a##2, a##3), r##_1 = SLV_SUM_4(a##4, a##5, a##6, a##7);
#define SLV_TRANSPOSE_4(to, from)                                                                  \
    {                                                                                              \
        const __m256d a_ = _mm256_load_pd(from), b_ = _mm256_load_pd((from) + 8);                  \
        const __m256d c_ = _mm256_load_pd((from) + 16), d_ = _mm256_load_pd((from) + 24);          \
        const __m256d e_ = _mm256_unpacklo_pd(a_, b_), f_ = _mm256_unpackhi_pd(a_, b_);            \
        const __m256d g_ = _mm256_unpacklo_pd(c_, d_), h_ = _mm256_unpackhi_pd(c_, d_);            \
        _mm256_store_pd((to), _mm256_permute2f128_pd(e_, g_, 0x20));                               \
        _mm256_store_pd((to) + 8, _mm256_permute2f128_pd(f_, h_, 0x20));                           \
        _mm256_store_pd((to) + 16, _mm256_permute2f128_pd(e_, g_, 0x31));                          \
        _mm256_store_pd((to) + 24, _mm256_permute2f128_pd(f_, h_, 0x31));                          \
    }
#define SLV_TRANSPOSE(to, from)                                                                    \
    SLV_TRANSPOSE_4(to, from)                                                                      \
    SLV_TRANSPOSE_4((to) + 4, (from) + 32)                                                         \
    SLV_TRANSPOSE_4((to) + 32, (from) + 4)                                                         \
    SLV_TRANSPOSE_4((to) + 36, (from) + 36)
#define SLV_TILES 1
#define SLV_COLUMNS 4
#define SLV_EACH_COLUMN SLI_EACH4
#define SLV_LOAD_PINNED(a, p)                                                                      \
    a##_0 = _mm256_load_pd(p);                                                                     \
    a##_1 = _mm256_load_pd((p) + 4);                                                               \
    __asm__("" : "+x"(a##_0), "+x"(a##_1)); /* used 4 times: not to be loaded 4 times */
#define SLV_BROADCAST(b, p) b##_0 = b##_1 = _mm256_broadcast_sd(p);
#define SLV_MULTIPLY(a, b, c)                                                                      \
    a##_0 = _mm256_mul_pd(b##_0, c##_0), a##_1 = _mm256_mul_pd(b##_1, c##_1);
#define SLV_DIVIDE(a, b, c)                                                                        \
    a##_0 = _mm256_div_pd(b##_0, c##_0), a##_1 = _mm256_div_pd(b##_1, c##_1);
#define SLV_BELOW(a, k)                                                                            \
    a##_0 = _mm256_and_pd(a##_0, sli_lanes_from((k) + 1)),                                         \
    a##_1 = _mm256_and_pd(a##_1, sli_lanes_from((k)-3));
#define SLV_SPREAD(mask, lanes, count)                                                             \
    const __m256i low_ = sli_spread((mask)&15u), high_ = sli_spread((mask) >> 4);                  \
    const __m256d keep_low_ = sli_spread_keep(low_), keep_high_ = sli_spread_keep(high_);          \
    const ptrdiff_t second_ = sli_count4((mask)&15u);                                              \
    (void)(lanes);
#define SLV_SPREAD_ADD(to, from)                                                                   \
    _mm256_store_pd((to), _mm256_add_pd(_mm256_load_pd(to),                                        \
                                        sli_spread_4(_mm256_loadu_pd(from), low_, keep_low_)));    \
    _mm256_store_pd((to) + 4, _mm256_add_pd(_mm256_load_pd((to) + 4),                              \
                                            sli_spread_4(_mm256_loadu_pd((from) + second_), high_, \
                                                         keep_high_)));
#define SLV_TWICE_AT(e, l)                                                                         \
    {                                                                                              \
        const __m256d l_ = _mm256_load_pd(l);                                                      \
        e##_0 = _mm256_permute4x64_pd(l_, 0x50);                                                   \
        e##_1 = _mm256_permute4x64_pd(l_, 0xfa);                                                   \
    }
#define SLV_TWICE_LOW(e, l) SLV_TWICE_AT(e, l)
#define SLV_TWICE_HIGH(e, l) SLV_TWICE_AT(e, (l) + 4)
#define SLV_PAIR(b, p) b##_0 = b##_1 = _mm256_broadcast_pd((const __m128d *)(const void *)(p));

#define SLW_NAME(f) sli_##f##4_avx2
/* begin src/impl/lanes_ymm.inl.h */
/* lanes_ymm.inl.h: four right-hand sides in one 256-bit register, for AVX2 and AVX-512 alike */

#define SLW_LANES 4
#define SLW_ROWS 8
#define SLW_DECLARE(a) __m256d a;
#define SLW_ZERO(a) a = _mm256_setzero_pd();
#define SLW_LOAD(a, p) a = _mm256_loadu_pd(p);
#define SLW_STORE(p, a) _mm256_storeu_pd((p), a);
#define SLW_FNMA(a, s, b) a = _mm256_fnmadd_pd(_mm256_broadcast_sd(&(s)), b, a);
#define SLW_ADD(a, b) a = _mm256_add_pd(a, b);
#define SLW_DIVIDE(a, s) a = _mm256_div_pd(a, _mm256_set1_pd(s));
/* begin src/impl/lanes.inl.h */
/* lanes.inl.h: 2, 4 or 8 interleaved right-hand sides, SIMD along them; the words SLW_* are one row of SLW_LANES */

/* SLW_EACH(op, k) is op(0, k) op(1, k) .. for the SLW_ROWS rows that are kept in registers at once,
 * SLW_HIGH and SLW_LOW are its halves from the last row down; a0, a1, .. are their accumulators, b
 * and c one row more each. SLW_EACH_AGAIN is SLW_EACH once more, as a macro does not expand inside
 * itself. */
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
#define SLI_LOAD(r, p) SLW_LOAD(a##r, (p) + (r)*SLW_LANES)
#define SLI_STORE(r, p) SLW_STORE((p) + (r)*SLW_LANES, a##r)
#define SLI_APPLY(r, l) SLW_FNMA(a##r, (l)[r], b)  /* a(r) -= L(r, j) x(j) */
#define SLI_GATHER(r, l) SLW_FNMA(b, (l)[r], a##r) /* x(j) -= L(r, j) x(r), in two chains */
#define SLI_GATHER2(r, l) SLW_FNMA(c, (l)[r], a##r)
/* inside the diagonal block: column k onto the rows below it, and row k onto the columns before it
 */
#define SLI_DOWN(r, k)                                                                             \
    if ((r) > (k)) {                                                                               \
        SLW_FNMA(a##r, l[SLI_TILE * (k) + (r)], a##k)                                              \
    }
#define SLI_UP(j, k)                                                                               \
    if ((j) < (k) && (j) < inner) {                                                                \
        SLW_FNMA(a##j, l[SLI_TILE * (j) + (k)], a##k)                                              \
    }
#define SLI_COLUMN(k, unused)                                                                      \
    if ((k) < inner) {                                                                             \
        SLW_EACH_AGAIN(SLI_DOWN, k)                                                                \
    }
#define SLI_ROW(k, unused) SLW_EACH_AGAIN(SLI_UP, k)

#if SLW_ROWS == 8
/* A supernode of 1 to 8 columns, the width folded in as in narrow.inl.h: the columns' rows stay in
 * registers, and the rows below pass by one after the other. Rows of x are `stride` apart. */
#define SLI_LOAD_OWN(k, p)                                                                         \
    if ((k) < w) {                                                                                 \
        SLW_LOAD(a##k, (p) + (k)*stride)                                                           \
    }
#define SLI_STORE_OWN(k, p)                                                                        \
    if ((k) < w) {                                                                                 \
        SLW_STORE((p) + (k)*stride, a##k)                                                          \
    }
#define SLI_ZERO_OWN(k, unused) SLW_ZERO(a##k)
#define SLI_AHEAD_OWN(k, bytes)                                                                    \
    if ((k) < w) {                                                                                 \
        SLI_PREFETCH(l + SLI_TILE * (k), bytes);                                                   \
    }
#define SLI_DOWN_OWN(r, k)                                                                         \
    if ((r) > (k) && (r) < w) {                                                                    \
        SLW_FNMA(a##r, l[SLI_TILE * (k) + (r)], a##k)                                              \
    }
#define SLI_COLUMN_OWN(k, unused) SLW_EACH_AGAIN(SLI_DOWN_OWN, k)
#define SLI_BELOW_OWN(k, unused)                                                                   \
    if ((k) < w) {                                                                                 \
        SLW_FNMA(b, l[SLI_TILE * (k) + lane], a##k)                                                \
    }

SLV_FUNCTION SLI_ALWAYS_INLINE void SLW_NAME(narrow_forward)(const sl_int w, sl_int stride,
                                                             sl_int below, const sl_int *rows,
                                                             const double *l, double *xs,
                                                             double *x) {
    sl_int lane = w, i;
    SLW_EACH(SLI_DECLARE, 0)
    SLW_DECLARE(b)
    SLW_EACH(SLI_AHEAD_OWN, SLI_AHEAD)
    SLW_EACH(SLI_LOAD_OWN, xs)
    SLW_EACH(SLI_COLUMN_OWN, 0)
    SLW_EACH(SLI_STORE_OWN, xs)
    for (i = 0; i < below; lane++, i++) { /* x(i) -= L(i, j) x(j) */
        double *to = x + (ptrdiff_t)rows[i] * stride;
        if (lane == SLI_TILE) {
            lane = 0;
            l += SLI_TILE * w;
            SLW_EACH(SLI_AHEAD_OWN, SLI_AHEAD)
        }
        SLW_LOAD(b, to)
        SLW_EACH(SLI_BELOW_OWN, 0)
        SLW_STORE(to, b)
    }
}

#define SLI_UP_OWN(j, k)                                                                           \
    if ((j) < (k) && (k) < w) {                                                                    \
        SLW_FNMA(a##j, l[SLI_TILE * (j) + (k)], a##k)                                              \
    }
#define SLI_ROW_OWN(k, unused) SLW_EACH_AGAIN(SLI_UP_OWN, k)
#define SLI_ABOVE_OWN(k, unused)                                                                   \
    if ((k) < w) {                                                                                 \
        SLW_FNMA(a##k, l[SLI_TILE * (k) + lane], b)                                                \
    }
#define SLI_DIVIDE_OWN(k, unused)                                                                  \
    if ((k) < w) {                                                                                 \
        SLW_LOAD(b, xs + (k)*stride)                                                               \
        SLW_DIVIDE(b, d[k])                                                                        \
        SLW_ADD(a##k, b)                                                                           \
    }

/* l points at the panel's last tile. */
SLV_FUNCTION SLI_ALWAYS_INLINE void SLW_NAME(narrow_backward)(const sl_int w, sl_int stride,
                                                              sl_int below, const sl_int *rows,
                                                              const double *l, const double *d,
                                                              double *xs, const double *x) {
    sl_int i = below - 1, lane = (w + i) % SLI_TILE;
    SLW_EACH(SLI_DECLARE, 0)
    SLW_DECLARE(b)
    SLW_EACH(SLI_ZERO_OWN, 0)
    SLW_HIGH(SLI_AHEAD_OWN, -SLI_AHEAD)
    SLW_LOW(SLI_AHEAD_OWN, -SLI_AHEAD)
    for (; i >= 0; lane--, i--) { /* x(j) -= L(i, j) x(i) */
        if (lane < 0) {
            lane = SLI_TILE - 1;
            l -= SLI_TILE * w;
            SLW_HIGH(SLI_AHEAD_OWN, -SLI_AHEAD)
            SLW_LOW(SLI_AHEAD_OWN, -SLI_AHEAD)
        }
        SLW_LOAD(b, x + (ptrdiff_t)rows[i] * stride)
        SLW_HIGH(SLI_ABOVE_OWN, 0)
        SLW_LOW(SLI_ABOVE_OWN, 0)
    }
    if (w == SLI_TILE && below > 0) {
        l -= SLI_TILE * w;
    }
    SLW_EACH(SLI_DIVIDE_OWN, 0)
    SLW_HIGH(SLI_ROW_OWN, 0)
    SLW_LOW(SLI_ROW_OWN, 0)
    SLW_EACH(SLI_STORE_OWN, xs)
}

#define SLI_FORWARD(k) SLW_NAME(narrow_forward)(k, stride, below, rows, l, xs, x)
#define SLI_BACKWARD(k) SLW_NAME(narrow_backward)(k, stride, below, rows, l, d, xs, x)

SLV_FUNCTION static void SLW_NAME(forward_narrow)(sl_int w, sl_int stride, sl_int below,
                                                  const sl_int *rows, const double *l, double *xs,
                                                  double *x){SLI_CASES(SLI_FORWARD)}

SLV_FUNCTION static void SLW_NAME(backward_narrow)(sl_int w, sl_int stride, sl_int below,
                                                   const sl_int *rows, const double *l,
                                                   const double *d, double *xs, const double *x) {
    SLI_CASES(SLI_BACKWARD)
}

#undef SLI_LOAD_OWN
#undef SLI_STORE_OWN
#undef SLI_ZERO_OWN
#undef SLI_AHEAD_OWN
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
/* Registers do not suffice for 8 such rows: half of the lanes, then the other half. */
SLV_FUNCTION SLI_INLINE void SLW_NAME(forward_narrow)(sl_int w, sl_int stride, sl_int below,
                                                      const sl_int *rows, const double *l,
                                                      double *xs, double *x) {
    const sl_int half = SLW_LANES / 2;
    SLW_HALF(forward_narrow)(w, stride, below, rows, l, xs, x);
    SLW_HALF(forward_narrow)(w, stride, below, rows, l, xs + half, x + half);
}

SLV_FUNCTION SLI_INLINE void SLW_NAME(backward_narrow)(sl_int w, sl_int stride, sl_int below,
                                                       const sl_int *rows, const double *l,
                                                       const double *d, double *xs,
                                                       const double *x) {
    const sl_int half = SLW_LANES / 2;
    SLW_HALF(backward_narrow)(w, stride, below, rows, l, d, xs, x);
    SLW_HALF(backward_narrow)(w, stride, below, rows, l, d, xs + half, x + half);
}
#endif

/* The rows of a tile that are not all columns of the supernode, side by side in buf: `inner` of its
 * own, then rows below, then zeros. */
SLV_FUNCTION SLI_INLINE void SLW_NAME(rows_in)(double *buf, sl_int inner, sl_int below,
                                               const sl_int *rows, const double *own,
                                               const double *x) {
    sl_int r;
    SLW_DECLARE(b)
    for (r = 0; r < SLW_ROWS; r++) {
        if (r < inner + below) {
            SLW_LOAD(b, r < inner ? own + (ptrdiff_t)r * SLW_LANES
                                  : x + (ptrdiff_t)rows[r - inner] * SLW_LANES)
        } else {
            SLW_ZERO(b)
        }
        SLW_STORE(buf + (ptrdiff_t)r * SLW_LANES, b)
    }
}

SLV_FUNCTION SLI_INLINE void SLW_NAME(rows_out)(const double *buf, sl_int inner, sl_int below,
                                                const sl_int *rows, double *own, double *x) {
    sl_int r;
    SLW_DECLARE(b)
    for (r = 0; r < SLW_ROWS && r < inner + below; r++) {
        SLW_LOAD(b, buf + (ptrdiff_t)r * SLW_LANES)
        SLW_STORE(r < inner ? own + (ptrdiff_t)r * SLW_LANES
                            : x + (ptrdiff_t)rows[r - inner] * SLW_LANES,
                  b)
    }
}

SLV_FUNCTION static void SLW_NAME(forward)(sl_int count, const sli_step *s, const sl_int *rows,
                                           const double *L, double *x, double *buf) {
    for (; count > 0; rows += s->below, count--, s++) {
        const sl_int w = s->width, height = w + s->below, first = SLI_TILE * s->first_tile;
        const double *tile = L + s->panel + sli_tile_offset(w, s->first_tile);
        double *xs = x + ((ptrdiff_t)s->base - first) * SLW_LANES;
        ptrdiff_t row;
        sl_int j;
#if SLW_ROWS == 8 || defined(SLW_HALF)
        if (w <= SLI_TILE) {
            SLW_NAME(forward_narrow)(w, SLW_LANES, s->below, rows, tile, xs, x);
            continue;
        }
#endif
        for (row = first; row < height; row += SLW_ROWS) {
            const sl_int lane = (sl_int)(row % SLI_TILE), final = (sl_int)(row < w ? row : w);
            const sl_int inner = sli_clamp(w - (sl_int)row, SLW_ROWS);
            const sl_int *places = rows + (row + inner - w);
            double *own = xs + row * SLW_LANES, *p = inner == SLW_ROWS ? own : buf;
            const double *l = tile + SLI_TILE * (ptrdiff_t)first + lane;
            SLW_EACH(SLI_DECLARE, 0)
            SLW_DECLARE(b)
            if (inner < SLW_ROWS) {
                SLW_NAME(rows_in)(buf, inner, height - (sl_int)row - inner, places, own, x);
            }
            SLW_EACH(SLI_LOAD, p)
            for (j = first; j < final; j++, l += SLI_TILE) {
                SLI_PREFETCH(l, SLI_AHEAD);
                SLW_LOAD(b, xs + (ptrdiff_t)j * SLW_LANES)
                SLW_EACH(SLI_APPLY, l)
            }
            if (inner > 0) {
                SLW_EACH(SLI_COLUMN, 0)
            }
            SLW_EACH(SLI_STORE, p)
            if (inner < SLW_ROWS) {
                SLW_NAME(rows_out)(buf, inner, height - (sl_int)row - inner, places, own, x);
            }
            if (lane + SLW_ROWS == SLI_TILE) {
                tile += SLI_TILE * (ptrdiff_t)sli_min(w, (sl_int)row + SLW_ROWS);
            }
        }
    }
}

SLV_FUNCTION static void SLW_NAME(backward)(sl_int count, const sli_step *s, const sl_int *rows_end,
                                            const double *L, const double *D, double *x,
                                            double *buf) {
    for (s += count; count > 0; count--) {
        const sl_int w = (--s)->width, height = w + s->below, first = SLI_TILE * s->first_tile;
        const sl_int padded = SLI_TILE * sli_tiles(height);
        const double *tile = L + s->panel + sli_panel_size(w, s->below), *d = D + s->column - first;
        double *xs = x + ((ptrdiff_t)s->base - first) * SLW_LANES;
        ptrdiff_t row;
        sl_int i, j;
        SLW_DECLARE(b)
        SLW_DECLARE(c)
        rows_end -= s->below;
#if SLW_ROWS == 8 || defined(SLW_HALF)
        if (w <= SLI_TILE) {
            SLW_NAME(backward_narrow)
            (w, SLW_LANES, s->below, rows_end, tile - SLI_TILE * w, d, xs, x);
            continue;
        }
#endif
        for (i = first; i < w; i++) {
            SLW_LOAD(b, xs + (ptrdiff_t)i * SLW_LANES)
            SLW_DIVIDE(b, d[i])
            SLW_STORE(xs + (ptrdiff_t)i * SLW_LANES, b)
        }
        for (row = padded - SLW_ROWS; row >= first; row -= SLW_ROWS) {
            const sl_int lane = (sl_int)(row % SLI_TILE), final = (sl_int)(row < w ? row : w);
            const sl_int inner = sli_clamp(w - (sl_int)row, SLW_ROWS);
            double *own = xs + row * SLW_LANES, *p = inner == SLW_ROWS ? own : buf;
            const double *l;
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
                SLI_PREFETCH(l, -SLI_AHEAD);
                SLW_LOAD(b, xs + (ptrdiff_t)j * SLW_LANES)
                SLW_ZERO(c)
                SLW_HIGH(SLI_GATHER, l)
                SLW_LOW(SLI_GATHER2, l)
                SLW_ADD(b, c)
                SLW_STORE(xs + (ptrdiff_t)j * SLW_LANES, b)
            }
        }
    }
}

#if SLW_LANES == 8
SLV_FUNCTION static void SLW_NAME(products)(sl_int count, const double *y, const double *z,
                                            double *sums) {
    sl_int row, k;
    for (row = 0; row < SLW_LANES; row += SLW_ROWS) {
        const double *l = y + row, *p = z;
        double *s = sums + row * SLW_LANES;
        SLW_EACH(SLI_DECLARE, 0)
        SLW_DECLARE(b)
        SLW_EACH(SLI_LOAD, s)
        for (k = 0; k < count; k++, l += SLW_LANES, p += SLW_LANES) {
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
#undef SLW_NAME
#undef SLW_LANES
#undef SLW_ROWS
#undef SLW_HALF
#undef SLW_EACH
#undef SLW_EACH_AGAIN
#undef SLW_HIGH
#undef SLW_LOW
#undef SLW_DECLARE
#undef SLW_ZERO
#undef SLW_LOAD
#undef SLW_STORE
#undef SLW_ADD
#undef SLW_FNMA
#undef SLW_DIVIDE
/* end src/impl/lanes.inl.h */
/* end src/impl/lanes_ymm.inl.h */

#define SLW_NAME(f) sli_##f##8_avx2
#define SLW_HALF(f) sli_##f##4_avx2
#define SLW_LANES 8
#define SLW_ROWS 4
#define SLW_DECLARE(a) __m256d a##_0, a##_1;
#define SLW_ZERO(a) a##_0 = a##_1 = _mm256_setzero_pd();
#define SLW_LOAD(a, p) a##_0 = _mm256_loadu_pd(p), a##_1 = _mm256_loadu_pd((p) + 4);
#define SLW_STORE(p, a) _mm256_storeu_pd((p), a##_0), _mm256_storeu_pd((p) + 4, a##_1);
#define SLW_FNMA(a, s, b)                                                                          \
    {                                                                                              \
        const __m256d s_ = _mm256_broadcast_sd(&(s));                                              \
        a##_0 = _mm256_fnmadd_pd(s_, b##_0, a##_0);                                                \
        a##_1 = _mm256_fnmadd_pd(s_, b##_1, a##_1);                                                \
    }
#define SLW_ADD(a, b) a##_0 = _mm256_add_pd(a##_0, b##_0), a##_1 = _mm256_add_pd(a##_1, b##_1);
#define SLW_DIVIDE(a, s)                                                                           \
    a##_0 = _mm256_div_pd(a##_0, _mm256_set1_pd(s)),                                               \
    a##_1 = _mm256_div_pd(a##_1, _mm256_set1_pd(s));
/* begin src/impl/lanes.inl.h */
/* lanes.inl.h: 2, 4 or 8 interleaved right-hand sides, SIMD along them; the words SLW_* are one row of SLW_LANES */

/* SLW_EACH(op, k) is op(0, k) op(1, k) .. for the SLW_ROWS rows that are kept in registers at once,
 * SLW_HIGH and SLW_LOW are its halves from the last row down; a0, a1, .. are their accumulators, b
 * and c one row more each. SLW_EACH_AGAIN is SLW_EACH once more, as a macro does not expand inside
 * itself. */
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
#define SLI_LOAD(r, p) SLW_LOAD(a##r, (p) + (r)*SLW_LANES)
#define SLI_STORE(r, p) SLW_STORE((p) + (r)*SLW_LANES, a##r)
#define SLI_APPLY(r, l) SLW_FNMA(a##r, (l)[r], b)  /* a(r) -= L(r, j) x(j) */
#define SLI_GATHER(r, l) SLW_FNMA(b, (l)[r], a##r) /* x(j) -= L(r, j) x(r), in two chains */
#define SLI_GATHER2(r, l) SLW_FNMA(c, (l)[r], a##r)
/* inside the diagonal block: column k onto the rows below it, and row k onto the columns before it
 */
#define SLI_DOWN(r, k)                                                                             \
    if ((r) > (k)) {                                                                               \
        SLW_FNMA(a##r, l[SLI_TILE * (k) + (r)], a##k)                                              \
    }
#define SLI_UP(j, k)                                                                               \
    if ((j) < (k) && (j) < inner) {                                                                \
        SLW_FNMA(a##j, l[SLI_TILE * (j) + (k)], a##k)                                              \
    }
#define SLI_COLUMN(k, unused)                                                                      \
    if ((k) < inner) {                                                                             \
        SLW_EACH_AGAIN(SLI_DOWN, k)                                                                \
    }
#define SLI_ROW(k, unused) SLW_EACH_AGAIN(SLI_UP, k)

#if SLW_ROWS == 8
/* A supernode of 1 to 8 columns, the width folded in as in narrow.inl.h: the columns' rows stay in
 * registers, and the rows below pass by one after the other. Rows of x are `stride` apart. */
#define SLI_LOAD_OWN(k, p)                                                                         \
    if ((k) < w) {                                                                                 \
        SLW_LOAD(a##k, (p) + (k)*stride)                                                           \
    }
#define SLI_STORE_OWN(k, p)                                                                        \
    if ((k) < w) {                                                                                 \
        SLW_STORE((p) + (k)*stride, a##k)                                                          \
    }
#define SLI_ZERO_OWN(k, unused) SLW_ZERO(a##k)
#define SLI_AHEAD_OWN(k, bytes)                                                                    \
    if ((k) < w) {                                                                                 \
        SLI_PREFETCH(l + SLI_TILE * (k), bytes);                                                   \
    }
#define SLI_DOWN_OWN(r, k)                                                                         \
    if ((r) > (k) && (r) < w) {                                                                    \
        SLW_FNMA(a##r, l[SLI_TILE * (k) + (r)], a##k)                                              \
    }
#define SLI_COLUMN_OWN(k, unused) SLW_EACH_AGAIN(SLI_DOWN_OWN, k)
#define SLI_BELOW_OWN(k, unused)                                                                   \
    if ((k) < w) {                                                                                 \
        SLW_FNMA(b, l[SLI_TILE * (k) + lane], a##k)                                                \
    }

SLV_FUNCTION SLI_ALWAYS_INLINE void SLW_NAME(narrow_forward)(const sl_int w, sl_int stride,
                                                             sl_int below, const sl_int *rows,
                                                             const double *l, double *xs,
                                                             double *x) {
    sl_int lane = w, i;
    SLW_EACH(SLI_DECLARE, 0)
    SLW_DECLARE(b)
    SLW_EACH(SLI_AHEAD_OWN, SLI_AHEAD)
    SLW_EACH(SLI_LOAD_OWN, xs)
    SLW_EACH(SLI_COLUMN_OWN, 0)
    SLW_EACH(SLI_STORE_OWN, xs)
    for (i = 0; i < below; lane++, i++) { /* x(i) -= L(i, j) x(j) */
        double *to = x + (ptrdiff_t)rows[i] * stride;
        if (lane == SLI_TILE) {
            lane = 0;
            l += SLI_TILE * w;
            SLW_EACH(SLI_AHEAD_OWN, SLI_AHEAD)
        }
        SLW_LOAD(b, to)
        SLW_EACH(SLI_BELOW_OWN, 0)
        SLW_STORE(to, b)
    }
}

#define SLI_UP_OWN(j, k)                                                                           \
    if ((j) < (k) && (k) < w) {                                                                    \
        SLW_FNMA(a##j, l[SLI_TILE * (j) + (k)], a##k)                                              \
    }
#define SLI_ROW_OWN(k, unused) SLW_EACH_AGAIN(SLI_UP_OWN, k)
#define SLI_ABOVE_OWN(k, unused)                                                                   \
    if ((k) < w) {                                                                                 \
        SLW_FNMA(a##k, l[SLI_TILE * (k) + lane], b)                                                \
    }
#define SLI_DIVIDE_OWN(k, unused)                                                                  \
    if ((k) < w) {                                                                                 \
        SLW_LOAD(b, xs + (k)*stride)                                                               \
        SLW_DIVIDE(b, d[k])                                                                        \
        SLW_ADD(a##k, b)                                                                           \
    }

/* l points at the panel's last tile. */
SLV_FUNCTION SLI_ALWAYS_INLINE void SLW_NAME(narrow_backward)(const sl_int w, sl_int stride,
                                                              sl_int below, const sl_int *rows,
                                                              const double *l, const double *d,
                                                              double *xs, const double *x) {
    sl_int i = below - 1, lane = (w + i) % SLI_TILE;
    SLW_EACH(SLI_DECLARE, 0)
    SLW_DECLARE(b)
    SLW_EACH(SLI_ZERO_OWN, 0)
    SLW_HIGH(SLI_AHEAD_OWN, -SLI_AHEAD)
    SLW_LOW(SLI_AHEAD_OWN, -SLI_AHEAD)
    for (; i >= 0; lane--, i--) { /* x(j) -= L(i, j) x(i) */
        if (lane < 0) {
            lane = SLI_TILE - 1;
            l -= SLI_TILE * w;
            SLW_HIGH(SLI_AHEAD_OWN, -SLI_AHEAD)
            SLW_LOW(SLI_AHEAD_OWN, -SLI_AHEAD)
        }
        SLW_LOAD(b, x + (ptrdiff_t)rows[i] * stride)
        SLW_HIGH(SLI_ABOVE_OWN, 0)
        SLW_LOW(SLI_ABOVE_OWN, 0)
    }
    if (w == SLI_TILE && below > 0) {
        l -= SLI_TILE * w;
    }
    SLW_EACH(SLI_DIVIDE_OWN, 0)
    SLW_HIGH(SLI_ROW_OWN, 0)
    SLW_LOW(SLI_ROW_OWN, 0)
    SLW_EACH(SLI_STORE_OWN, xs)
}

#define SLI_FORWARD(k) SLW_NAME(narrow_forward)(k, stride, below, rows, l, xs, x)
#define SLI_BACKWARD(k) SLW_NAME(narrow_backward)(k, stride, below, rows, l, d, xs, x)

SLV_FUNCTION static void SLW_NAME(forward_narrow)(sl_int w, sl_int stride, sl_int below,
                                                  const sl_int *rows, const double *l, double *xs,
                                                  double *x){SLI_CASES(SLI_FORWARD)}

SLV_FUNCTION static void SLW_NAME(backward_narrow)(sl_int w, sl_int stride, sl_int below,
                                                   const sl_int *rows, const double *l,
                                                   const double *d, double *xs, const double *x) {
    SLI_CASES(SLI_BACKWARD)
}

#undef SLI_LOAD_OWN
#undef SLI_STORE_OWN
#undef SLI_ZERO_OWN
#undef SLI_AHEAD_OWN
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
/* Registers do not suffice for 8 such rows: half of the lanes, then the other half. */
SLV_FUNCTION SLI_INLINE void SLW_NAME(forward_narrow)(sl_int w, sl_int stride, sl_int below,
                                                      const sl_int *rows, const double *l,
                                                      double *xs, double *x) {
    const sl_int half = SLW_LANES / 2;
    SLW_HALF(forward_narrow)(w, stride, below, rows, l, xs, x);
    SLW_HALF(forward_narrow)(w, stride, below, rows, l, xs + half, x + half);
}

SLV_FUNCTION SLI_INLINE void SLW_NAME(backward_narrow)(sl_int w, sl_int stride, sl_int below,
                                                       const sl_int *rows, const double *l,
                                                       const double *d, double *xs,
                                                       const double *x) {
    const sl_int half = SLW_LANES / 2;
    SLW_HALF(backward_narrow)(w, stride, below, rows, l, d, xs, x);
    SLW_HALF(backward_narrow)(w, stride, below, rows, l, d, xs + half, x + half);
}
#endif

/* The rows of a tile that are not all columns of the supernode, side by side in buf: `inner` of its
 * own, then rows below, then zeros. */
SLV_FUNCTION SLI_INLINE void SLW_NAME(rows_in)(double *buf, sl_int inner, sl_int below,
                                               const sl_int *rows, const double *own,
                                               const double *x) {
    sl_int r;
    SLW_DECLARE(b)
    for (r = 0; r < SLW_ROWS; r++) {
        if (r < inner + below) {
            SLW_LOAD(b, r < inner ? own + (ptrdiff_t)r * SLW_LANES
                                  : x + (ptrdiff_t)rows[r - inner] * SLW_LANES)
        } else {
            SLW_ZERO(b)
        }
        SLW_STORE(buf + (ptrdiff_t)r * SLW_LANES, b)
    }
}

SLV_FUNCTION SLI_INLINE void SLW_NAME(rows_out)(const double *buf, sl_int inner, sl_int below,
                                                const sl_int *rows, double *own, double *x) {
    sl_int r;
    SLW_DECLARE(b)
    for (r = 0; r < SLW_ROWS && r < inner + below; r++) {
        SLW_LOAD(b, buf + (ptrdiff_t)r * SLW_LANES)
        SLW_STORE(r < inner ? own + (ptrdiff_t)r * SLW_LANES
                            : x + (ptrdiff_t)rows[r - inner] * SLW_LANES,
                  b)
    }
}

SLV_FUNCTION static void SLW_NAME(forward)(sl_int count, const sli_step *s, const sl_int *rows,
                                           const double *L, double *x, double *buf) {
    for (; count > 0; rows += s->below, count--, s++) {
        const sl_int w = s->width, height = w + s->below, first = SLI_TILE * s->first_tile;
        const double *tile = L + s->panel + sli_tile_offset(w, s->first_tile);
        double *xs = x + ((ptrdiff_t)s->base - first) * SLW_LANES;
        ptrdiff_t row;
        sl_int j;
#if SLW_ROWS == 8 || defined(SLW_HALF)
        if (w <= SLI_TILE) {
            SLW_NAME(forward_narrow)(w, SLW_LANES, s->below, rows, tile, xs, x);
            continue;
        }
#endif
        for (row = first; row < height; row += SLW_ROWS) {
            const sl_int lane = (sl_int)(row % SLI_TILE), final = (sl_int)(row < w ? row : w);
            const sl_int inner = sli_clamp(w - (sl_int)row, SLW_ROWS);
            const sl_int *places = rows + (row + inner - w);
            double *own = xs + row * SLW_LANES, *p = inner == SLW_ROWS ? own : buf;
            const double *l = tile + SLI_TILE * (ptrdiff_t)first + lane;
            SLW_EACH(SLI_DECLARE, 0)
            SLW_DECLARE(b)
            if (inner < SLW_ROWS) {
                SLW_NAME(rows_in)(buf, inner, height - (sl_int)row - inner, places, own, x);
            }
            SLW_EACH(SLI_LOAD, p)
            for (j = first; j < final; j++, l += SLI_TILE) {
                SLI_PREFETCH(l, SLI_AHEAD);
                SLW_LOAD(b, xs + (ptrdiff_t)j * SLW_LANES)
                SLW_EACH(SLI_APPLY, l)
            }
            if (inner > 0) {
                SLW_EACH(SLI_COLUMN, 0)
            }
            SLW_EACH(SLI_STORE, p)
            if (inner < SLW_ROWS) {
                SLW_NAME(rows_out)(buf, inner, height - (sl_int)row - inner, places, own, x);
            }
            if (lane + SLW_ROWS == SLI_TILE) {
                tile += SLI_TILE * (ptrdiff_t)sli_min(w, (sl_int)row + SLW_ROWS);
            }
        }
    }
}

SLV_FUNCTION static void SLW_NAME(backward)(sl_int count, const sli_step *s, const sl_int *rows_end,
                                            const double *L, const double *D, double *x,
                                            double *buf) {
    for (s += count; count > 0; count--) {
        const sl_int w = (--s)->width, height = w + s->below, first = SLI_TILE * s->first_tile;
        const sl_int padded = SLI_TILE * sli_tiles(height);
        const double *tile = L + s->panel + sli_panel_size(w, s->below), *d = D + s->column - first;
        double *xs = x + ((ptrdiff_t)s->base - first) * SLW_LANES;
        ptrdiff_t row;
        sl_int i, j;
        SLW_DECLARE(b)
        SLW_DECLARE(c)
        rows_end -= s->below;
#if SLW_ROWS == 8 || defined(SLW_HALF)
        if (w <= SLI_TILE) {
            SLW_NAME(backward_narrow)
            (w, SLW_LANES, s->below, rows_end, tile - SLI_TILE * w, d, xs, x);
            continue;
        }
#endif
        for (i = first; i < w; i++) {
            SLW_LOAD(b, xs + (ptrdiff_t)i * SLW_LANES)
            SLW_DIVIDE(b, d[i])
            SLW_STORE(xs + (ptrdiff_t)i * SLW_LANES, b)
        }
        for (row = padded - SLW_ROWS; row >= first; row -= SLW_ROWS) {
            const sl_int lane = (sl_int)(row % SLI_TILE), final = (sl_int)(row < w ? row : w);
            const sl_int inner = sli_clamp(w - (sl_int)row, SLW_ROWS);
            double *own = xs + row * SLW_LANES, *p = inner == SLW_ROWS ? own : buf;
            const double *l;
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
                SLI_PREFETCH(l, -SLI_AHEAD);
                SLW_LOAD(b, xs + (ptrdiff_t)j * SLW_LANES)
                SLW_ZERO(c)
                SLW_HIGH(SLI_GATHER, l)
                SLW_LOW(SLI_GATHER2, l)
                SLW_ADD(b, c)
                SLW_STORE(xs + (ptrdiff_t)j * SLW_LANES, b)
            }
        }
    }
}

#if SLW_LANES == 8
SLV_FUNCTION static void SLW_NAME(products)(sl_int count, const double *y, const double *z,
                                            double *sums) {
    sl_int row, k;
    for (row = 0; row < SLW_LANES; row += SLW_ROWS) {
        const double *l = y + row, *p = z;
        double *s = sums + row * SLW_LANES;
        SLW_EACH(SLI_DECLARE, 0)
        SLW_DECLARE(b)
        SLW_EACH(SLI_LOAD, s)
        for (k = 0; k < count; k++, l += SLW_LANES, p += SLW_LANES) {
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
#undef SLW_NAME
#undef SLW_LANES
#undef SLW_ROWS
#undef SLW_HALF
#undef SLW_EACH
#undef SLW_EACH_AGAIN
#undef SLW_HIGH
#undef SLW_LOW
#undef SLW_DECLARE
#undef SLW_ZERO
#undef SLW_LOAD
#undef SLW_STORE
#undef SLW_ADD
#undef SLW_FNMA
#undef SLW_DIVIDE
/* end src/impl/lanes.inl.h */

/* begin src/impl/tile.inl.h */
/* tile.inl.h: the 8 x 8 unit triangle of a diagonal tile, in scalars: 28 FMAs, a chain of 7 */

#define SLI_X(k, j) r##k = SLV_FNMA1(l[SLI_TILE * j + k], r##j, r##k);  /* r(k) -= L(k, j) r(j) */
#define SLI_XT(j, k) r##j = SLV_FNMA1(l[SLI_TILE * j + k], r##k, r##j); /* r(j) -= L(k, j) r(k) */

/* r := L^-1 r, l the tile's 8 x 8 diagonal part by columns */
SLV_FUNCTION SLI_INLINE void SLV_NAME(tile_forward)(const double *l, double *r) {
    double r0 = r[0], r1 = r[1], r2 = r[2], r3 = r[3], r4 = r[4], r5 = r[5], r6 = r[6], r7 = r[7];
    SLI_X(1, 0)
    SLI_X(2, 0)
    SLI_X(3, 0)
    SLI_X(4, 0) SLI_X(5, 0) SLI_X(6, 0) SLI_X(7, 0) SLI_X(2, 1) SLI_X(3, 1) SLI_X(4, 1) SLI_X(5, 1)
        SLI_X(6, 1) SLI_X(7, 1) SLI_X(3, 2) SLI_X(4, 2) SLI_X(5, 2) SLI_X(6, 2) SLI_X(7, 2)
            SLI_X(4, 3) SLI_X(5, 3) SLI_X(6, 3) SLI_X(7, 3) SLI_X(5, 4) SLI_X(6, 4) SLI_X(7, 4)
                SLI_X(6, 5) SLI_X(7, 5) SLI_X(7, 6) r[1] = r1;
    r[2] = r2;
    r[3] = r3;
    r[4] = r4;
    r[5] = r5;
    r[6] = r6;
    r[7] = r7;
}

/* r := L'^-1 r */
SLV_FUNCTION SLI_INLINE void SLV_NAME(tile_backward)(const double *l, double *r) {
    double r0 = r[0], r1 = r[1], r2 = r[2], r3 = r[3], r4 = r[4], r5 = r[5], r6 = r[6], r7 = r[7];
    SLI_XT(6, 7)
    SLI_XT(5, 7)
    SLI_XT(4, 7)
    SLI_XT(3, 7) SLI_XT(2, 7) SLI_XT(1, 7) SLI_XT(0, 7) SLI_XT(5, 6) SLI_XT(4, 6) SLI_XT(3, 6)
        SLI_XT(2, 6) SLI_XT(1, 6) SLI_XT(0, 6) SLI_XT(4, 5) SLI_XT(3, 5) SLI_XT(2, 5) SLI_XT(1, 5)
            SLI_XT(0, 5) SLI_XT(3, 4) SLI_XT(2, 4) SLI_XT(1, 4) SLI_XT(0, 4) SLI_XT(2, 3)
                SLI_XT(1, 3) SLI_XT(0, 3) SLI_XT(1, 2) SLI_XT(0, 2) SLI_XT(0, 1) r[0] = r0;
    r[1] = r1;
    r[2] = r2;
    r[3] = r3;
    r[4] = r4;
    r[5] = r5;
    r[6] = r6;
}

#undef SLI_X
#undef SLI_XT
/* end src/impl/tile.inl.h */

/* begin src/impl/pairs.inl.h */
/* pairs.inl.h: two interleaved right-hand sides, SIMD along the rows of a tile; words SLV_*, two octets a tile */

/* The 8 rows of a tile column, each twice, times the pair x(j): two octets for one octet of L, so
 * that every number of L is loaded once. e0 and e1 are the pairs of rows 0-3 and 4-7. */
#define SLI_PAIR_AXPY(e, l, p)                                                                     \
    SLV_TWICE_LOW(t0, l)                                                                           \
    SLV_TWICE_HIGH(t1, l)                                                                          \
    SLV_PAIR(b, p)                                                                                 \
    SLV_FNMA(e##0, t0, b)                                                                          \
    SLV_FNMA(e##1, t1, b)

/* L^-1 or L'^-1 of a whole diagonal tile upon 8 pairs: each right-hand side by itself, as there is
 * one. */
#define SLI_PAIR_TILE(solve, l, p)                                                                 \
    {                                                                                              \
        double r[2][SLI_TILE];                                                                     \
        for (k = 0; k < SLI_TILE; k++) {                                                           \
            r[0][k] = (p)[2 * k];                                                                  \
            r[1][k] = (p)[2 * k + 1];                                                              \
        }                                                                                          \
        solve((l), r[0]);                                                                          \
        solve((l), r[1]);                                                                          \
        for (k = 0; k < SLI_TILE; k++) {                                                           \
            (p)[2 * k] = r[0][k];                                                                  \
            (p)[2 * k + 1] = r[1][k];                                                              \
        }                                                                                          \
    }

SLV_FUNCTION static void SLV_NAME(forward2)(sl_int count, const sli_step *s, const sl_int *rows,
                                            const double *L, double *x, double *buf) {
    for (; count > 0; count--, s++) {
        const sl_int w = s->width, height = w + s->below, first = SLI_TILE * s->first_tile;
        const size_t columns = 2 * (size_t)(w - first);
        const double *tile = L + s->panel + sli_tile_offset(w, s->first_tile);
        double *xs = x + 2 * (ptrdiff_t)s->base;
        sl_int row, i, j, k;
        memcpy(buf + 2 * (ptrdiff_t)first, xs, columns * sizeof(double));
        memset(buf + 2 * (ptrdiff_t)w, 0,
               2 * (size_t)(SLI_TILE * sli_tiles(height) - w) * sizeof(double));
        for (row = first; row < height; row += SLI_TILE) {
            const sl_int final = sli_min(row, w), inner = sli_clamp(w - row, SLI_TILE);
            const double *l = tile + SLI_TILE * (ptrdiff_t)first;
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
                 j += 2, l += 2 * SLI_TILE) { /* y(rows) -= L(rows, j) y(j) */
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
                SLI_PAIR_TILE(SLV_NAME(tile_forward), l, p)
            } else {
                for (k = 0; k < inner;
                     k++, l += SLI_TILE) { /* columns inside the tile, one by one */
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

/* Rows of a tile that are final leave their columns' sums: 4 partial sums for each of the pair, in
 * one octet. */
#define SLI_PAIR_DOT(a, l)                                                                         \
    SLV_TWICE_LOW(t0, l)                                                                           \
    SLV_TWICE_HIGH(t1, l)                                                                          \
    SLV_FNMA(a, t0, v0)                                                                            \
    SLV_FNMA(a, t1, v1)

SLV_FUNCTION static void SLV_NAME(backward2)(sl_int count, const sli_step *s,
                                             const sl_int *rows_end, const double *L,
                                             const double *D, double *x, double *buf) {
    for (s += count; count > 0; count--) {
        const sl_int w = (--s)->width, height = w + s->below, first = SLI_TILE * s->first_tile;
        const sl_int padded = SLI_TILE * sli_tiles(height);
        const double *tile = L + s->panel + sli_panel_size(w, s->below), *d = D + s->column - first;
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
            const double *l;
            tile -= SLI_TILE * (ptrdiff_t)sli_min(w, row + SLI_TILE);
            l = tile + SLI_TILE * (ptrdiff_t)row;
            SLV_LOAD(v0, p) /* 0 on the columns: only rows below count here */
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
                SLI_PAIR_TILE(SLV_NAME(tile_backward), l, p)
            } else {
                for (k = inner - 1; k > 0; k--) { /* x(j) -= L(k, j) x(k) */
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
            for (j = sli_min(row, w) - 1; j >= first; j--) { /* x(j) -= L(rows, j)' x(rows) */
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
/* end src/impl/pairs.inl.h */

/* begin src/impl/product.inl.h */
/* product.inl.h: C -= A D B' on tiles, the loop that a factorization spends its time in; words SLV_* */

/* A block of registers holds SLV_COLUMNS columns of one row tile, or of two where an ISA has
 * registers enough: SLV_EACH_COLUMN(op, t) is op(0, t) op(1, t) .. over them. Columns past those of C
 * are computed and dropped: B has all 8 of a tile. */
#define SLI_DECLARE(k, t) SLV_DECLARE(c##t##k)
#define SLI_LOAD(k, t)                                                                             \
    if ((k) < columns) {                                                                           \
        SLV_LOAD(c##t##k, C##t + SLI_TILE * (k))                                                   \
    } else {                                                                                       \
        SLV_ZERO(c##t##k)                                                                          \
    }
#define SLI_STORE(k, t)                                                                            \
    if ((k) < columns) {                                                                           \
        SLV_STORE(C##t + SLI_TILE * (k), c##t##k)                                                  \
    }
#define SLI_UPDATE(k, unused) /* C(rows, k) -= A(rows, j) B(k, j) */                               \
    SLV_BROADCAST(b, B + (k))                                                                      \
    SLV_FNMA(c0##k, a0, b)
#define SLI_UPDATE2(k, unused)                                                                     \
    SLI_UPDATE(k, unused)                                                                          \
    SLV_FNMA(c1##k, a1, b)

/* One row tile. A: [length][8], B: [length][8] from the block's first column on, C: [columns][8]. */
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
/* Two row tiles. */
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

/* B(k, j) d(j) of column tile c's 8 rows, the columns j .. j + length - 1 of the panel. */
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

/* Tiles of the lower triangle, row tiles t0 .. t1-1 and column tiles c0 .. c1-1 (t0 >= c0), lose
 * L D L' over the panel's columns j0 .. j1-1. The target's tile (t, c) stands at tile_offset(target_width, t - target_first)
 * + 64 (c - target_first). Taken in chunks of columns j, so that
 * what a row tile needs stays in the first cache and what the group of column tiles needs in the
 * second. */
SLV_FUNCTION static void SLV_NAME(product)(const double *panel, sl_int w, const double *D,
                                           sl_int t0, sl_int t1, sl_int c0, sl_int c1, sl_int j0,
                                           sl_int j1, double *target, sl_int target_width,
                                           sl_int target_first, double *B) {
    const sl_int tile_size = SLI_TILE * SLI_TILE;
    sl_int j, t, c, k;
    for (j = j0; j < j1; j += SLI_CHUNK) {
        const sl_int length = sli_min(SLI_CHUNK, j1 - j);
        for (c = c0; c < c1; c++) {
            SLV_NAME(pack)
            (panel + sli_tile_offset(w, c) + SLI_TILE * (ptrdiff_t)j, D + j, length,
             B + (ptrdiff_t)(c - c0) * SLI_TILE * length);
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
            if (is_pair && c == t && c < c1) { /* the pair's second tile has a diagonal tile more */
                const ptrdiff_t at = (ptrdiff_t)tile_size * (c - target_first);
                SLV_NAME(block1)
                (A1, B + (ptrdiff_t)(c - c0) * SLI_TILE * length, length, C1 + at,
                 target_width - SLI_TILE * (c - target_first));
            }
#endif
        }
    }
}
/* end src/impl/product.inl.h */

/* begin src/impl/front.inl.h */
/* front.inl.h: a front of the multifrontal factorization: its panel factored, its update matrix made and handed on */

/* l(rows, k) = x(rows, k) / d(k), by the reciprocal where that loses nothing */
#define SLI_SCALE(l, x, k)                                                                         \
    if (by_reciprocal) {                                                                           \
        SLV_BROADCAST(b, reciprocal + (k))                                                         \
        SLV_MULTIPLY(l, x, b)                                                                      \
    } else {                                                                                       \
        SLV_BROADCAST(b, D + (k))                                                                  \
        SLV_DIVIDE(l, x, b)                                                                        \
    }

/* magnitude(rows) += |l d l|, with x = l d */
#define SLI_GAIN(l, x, k)                                                                          \
    SLV_BROADCAST(b, against + (k))                                                                \
    SLV_MULTIPLY(b, l, b)                                                                          \
    SLV_FNMA(m, b, x)

#define SLI_DECLARE(k, unused) SLV_DECLARE(a##k)
#define SLI_LOAD(k, p)                                                                             \
    if ((k) < columns) {                                                                           \
        SLV_LOAD(a##k, (p) + SLI_TILE * (k))                                                       \
    } else {                                                                                       \
        SLV_ZERO(a##k)                                                                             \
    }

/* The diagonal tile, column k: the pivot, then the columns after it lose l(rows) x(column). Here by
 * division, one step shorter than by the reciprocal: all wait for this chain. */
#define SLI_AFTER(i, k)                                                                            \
    if ((i) > (k)) {                                                                               \
        SLV_BROADCAST(b, x + SLI_TILE * (k) + (i))                                                 \
        SLV_FNMA(a##i, l, b)                                                                       \
    }
#define SLI_PIVOT(k, p)                                                                            \
    if ((k) < columns) {                                                                           \
        double d;                                                                                  \
        SLV_STORE(x + SLI_TILE * (k), a##k)                                                        \
        SLV_STORE(sums, m)                                                                         \
        SLV_LANE(b, a##k, k)                                                                       \
        d = x[SLI_TILE * (k) + (k)];                                                               \
        if (rule != NULL) {                                                                        \
            d = sli_pivot_ruled(rule, column + (k), d, sums[k]);                                   \
            SLV_BROADCAST(b, &d)                                                                   \
        }                                                                                          \
        SLV_DIVIDE(l, a##k, b)                                                                     \
        D[k] = d;                                                                                  \
        magnitude[k] = sums[k];                                                                    \
        against[k] = d < 0.0 ? 1.0 : -1.0;                                                         \
        reciprocal[k] = 1.0 / d;                                                                   \
        safe &= fabs(d) > 1e-290 && fabs(d) < 1e290;                                               \
        SLI_GAIN(l, a##k, k)                                                                       \
        SLV_BELOW(l, k)                                                                            \
        SLV_STORE((p) + SLI_TILE * (k), l)                                                         \
        SLI_EACH8_AGAIN(SLI_AFTER, k)                                                              \
    }

/* The tiles below: x(rows, k) -= x(rows, j) L(k, j) for j < k, then l. */
#define SLI_BEFORE(j, k)                                                                           \
    if ((j) < (k)) {                                                                               \
        SLV_BROADCAST(b, p + SLI_TILE * (j) + (k))                                                 \
        SLV_FNMA(a##k, a##j, b)                                                                    \
    }
#define SLI_SOLVE(k, q)                                                                            \
    if ((k) < columns) {                                                                           \
        SLI_EACH8_AGAIN(SLI_BEFORE, k)                                                             \
        SLI_SCALE(l, a##k, k)                                                                      \
        SLI_GAIN(l, a##k, k)                                                                       \
        SLV_STORE((q) + SLI_TILE * (k), l)                                                         \
    }

/* The pivots of column tile c, whose columns before it are done: 8, or fewer in the last one. */
SLV_FUNCTION static void SLV_NAME(pivots_of_tile)(const sli_front *f, sl_int c, double *inverse) {
    const sl_int first = SLI_TILE * c, columns = sli_min(SLI_TILE, f->width - first);
    const sl_int column = f->column + first;
    const sli_pivot_rule *rule = f->rule->replaces ? f->rule : NULL;
    double *p = f->panel + sli_tile_offset(f->width, c) + SLI_TILE * (ptrdiff_t)first;
    double *D = f->D + first, *magnitude = f->magnitude + first;
    double *reciprocal = inverse, *against = inverse + SLI_TILE;
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
    for (t = columns; t < SLI_TILE; t++) { /* rows below that share the last tile of pivots */
        magnitude[t] = sums[t];
    }
    if (!safe) {
        reciprocal[0] = 0.0;
    }
}

/* Column tile c of row tiles t0 .. t1-1, all below its pivots. */
SLV_FUNCTION static void SLV_NAME(rows_of_tile)(const sli_front *f, sl_int c, sl_int t0, sl_int t1,
                                                const double *inverse) {
    const sl_int w = f->width, first = SLI_TILE * c, columns = sli_min(SLI_TILE, w - first);
    const double *p = f->panel + sli_tile_offset(w, c) + SLI_TILE * (ptrdiff_t)first;
    const double *D = f->D + first, *reciprocal = inverse, *against = inverse + SLI_TILE;
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
}

#undef SLI_SCALE
#undef SLI_GAIN
#undef SLI_DECLARE
#undef SLI_LOAD
#undef SLI_AFTER
#undef SLI_PIVOT
#undef SLI_BEFORE
#undef SLI_SOLVE

/* Column tile c of row tiles t0 .. t1-1 before its pivots are applied: the group's columns before it. */
SLV_FUNCTION SLI_INLINE void SLV_NAME(catch_up)(const sli_front *f, sl_int c0, sl_int c, sl_int t0,
                                                sl_int t1, double *B) {
    if (c > c0) {
        SLV_NAME(product)
        (f->panel, f->width, f->D, t0, t1, c, c + 1, SLI_TILE * c0, SLI_TILE * c, f->panel,
         f->width, 0, B);
    }
}

SLV_FUNCTION static void SLV_NAME(pivots)(const sli_front *f, sl_int c0, double *B) {
    const sl_int c1 = sli_min(c0 + SLI_GROUP, sli_tiles(f->width));
    sl_int c;
    if (c0 > 0) {
        SLV_NAME(product)
        (f->panel, f->width, f->D, c0, c1, c0, c1, 0, SLI_TILE * c0, f->panel, f->width, 0, B);
    }
    for (c = c0; c < c1; c++) {
        double *inverse = f->inverse + 2 * SLI_TILE * (ptrdiff_t)(c - c0);
        SLV_NAME(catch_up)(f, c0, c, c, c1, B);
        SLV_NAME(pivots_of_tile)(f, c, inverse);
        SLV_NAME(rows_of_tile)(f, c, c + 1, c1, inverse);
    }
}

SLV_FUNCTION static void SLV_NAME(rows)(const sli_front *f, sl_int c0, sl_int t0, sl_int t1,
                                        double *B) {
    const sl_int c1 = sli_min(c0 + SLI_GROUP, sli_tiles(f->width));
    sl_int c;
    if (c0 > 0) {
        SLV_NAME(product)
        (f->panel, f->width, f->D, t0, t1, c0, c1, 0, SLI_TILE * c0, f->panel, f->width, 0, B);
    }
    for (c = c0; c < c1; c++) {
        SLV_NAME(catch_up)(f, c0, c, t0, t1, B);
        SLV_NAME(rows_of_tile)
        (f, c, t0, t1, f->inverse + 2 * SLI_TILE * (ptrdiff_t)(c - c0));
    }
}

SLV_FUNCTION static void SLV_NAME(update)(const sli_front *f, sl_int c0, sl_int c1, sl_int t0,
                                          sl_int t1, double *B) {
    const sl_int w = f->width, last = sli_min(c1, t1);
    sl_int c;
    for (c = c0; c < last; c += SLI_GROUP) {
        SLV_NAME(product)
        (f->panel, w, f->D, sli_max(t0, c), t1, c, sli_min(c + SLI_GROUP, last), 0, w, f->update,
         SLI_TILE * (t1 - c0), c0, B);
    }
}

/* What a child hands over, row by row of the parent's tiles: the run of the child's rows that fall
 * from one of its tiles into one of the parent's moves as a whole, spread by a mask of lanes, through
 * all columns. What stands above the diagonal moves along and is never read. */
SLV_FUNCTION static void SLV_NAME(assemble)(const sli_front *f, const double *from, sl_int skipped,
                                            const sl_int *places, sl_int columns, sl_int first,
                                            sl_int last) {
    const sl_int w = f->width, whole = w / SLI_TILE;
    sl_int row, end, i;
    for (row = first; row < last; row = end) {
        const sl_int lane = (skipped + row) % SLI_TILE, tile = places[row] / SLI_TILE;
        const double *source = from + sli_triangle_offset((skipped + row) / SLI_TILE) +
                               SLI_TILE * (ptrdiff_t)skipped + lane;
        double *const to[2] = {f->panel, f->update};
        const ptrdiff_t at[2] = {(ptrdiff_t)sli_tile_offset(w, tile),
                                 (ptrdiff_t)sli_triangle_offset(tile - whole) -
                                     SLI_TILE * SLI_TILE * (ptrdiff_t)whole};
        sl_int lanes[SLI_TILE];
        unsigned mask = 0;
        for (end = row; end < last && end - row < SLI_TILE - lane && places[end] / SLI_TILE == tile;
             end++) {
            lanes[end - row] = places[end] % SLI_TILE;
            mask |= 1u << lanes[end - row];
        }
        {
            SLV_SPREAD(mask, lanes, end - row)
            for (i = 0; i < end && i < columns; i++) {
                const int is_below =
                    places[i] >= w; /* the panel or the update matrix, not a branch */
                double *target = to[is_below] + (at[is_below] + SLI_TILE * (ptrdiff_t)places[i]);
                SLV_SPREAD_ADD(target, source + SLI_TILE * (ptrdiff_t)i)
            }
        }
    }
}
/* end src/impl/front.inl.h */

/* begin src/impl/takahashi.inl.h */
/* takahashi.inl.h: a front of the inverse: gathered from the parent's front, completed column group by column group */

/* C(rows, k) -= A(rows, j) B(k, j), one row tile; A and B: [length][8], C: [columns][8]. */
SLV_FUNCTION SLI_INLINE void SLV_NAME(block)(const double *A, const double *B, sl_int length,
                                             double *C, sl_int columns) {
    sl_int k;
    for (k = 0; k < columns; k += SLV_COLUMNS) {
        SLV_NAME(block1)(A, B + k, length, C + SLI_TILE * (ptrdiff_t)k, columns - k);
    }
}

#define SLI_STORE(k, p)                                                                            \
    if ((k) < columns) {                                                                           \
        SLV_STORE((p) + SLI_TILE * (k), a)                                                         \
    }

/* The first columns of a tile := 0. Not as a loop: compilers make rep stos of one, and what reads the tile next waits
 * for it. */
SLV_FUNCTION SLI_INLINE void SLV_NAME(clear)(double *x, sl_int columns) {
    SLV_DECLARE(a)
    SLV_ZERO(a)
    SLI_EACH8(SLI_STORE, x)
}

#undef SLI_STORE

#define SLI_OFFSET(k) offset[k]

/* Z of the rows below, row tiles t0 .. t1-1, out of the parent's front: row and column i of theirs is row and
 * column places[i] there. Lanes of other rows get the numbers of a neighbour, which nothing reads. */
SLV_FUNCTION static void SLV_NAME(gather)(const sli_dual *f, const double *from, sl_int height,
                                          const sl_int *places, sl_int t0, sl_int t1) {
    const sl_int w = f->width, u = f->below;
    sl_int t, i;
    for (t = sli_max(t0, w / SLI_TILE); t < t1 && u > 0; t++) {
        double *to = f->front + sli_square_offset(w + u, t) + SLI_TILE * (ptrdiff_t)w;
        ptrdiff_t offset[SLI_TILE];
        for (i = 0; i < SLI_TILE; i++) {
            const sl_int place = places[sli_clamp(SLI_TILE * t + i - w, u - 1)];
            offset[i] = sli_square_offset(height, place / SLI_TILE) + place % SLI_TILE;
        }
        for (i = 0; i < u; i++) {
            const double *x = from + SLI_TILE * (ptrdiff_t)places[i];
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
#define SLI_BEFORE(j, k)                                                                           \
    if ((j) < (k)) {                                                                               \
        SLV_BROADCAST(b, l + SLI_TILE * (j) + (k))                                                 \
        SLV_FNMA(a##k, a##j, b)                                                                    \
    }
#define SLI_SOLVE(k, unused)                                                                       \
    if ((k) < columns) {                                                                           \
        SLI_EACH8_AGAIN(SLI_BEFORE, k)                                                             \
    }

/* x(rows, k) -= x(rows, j) L(k, j) for j < k in the 8 x 8 unit triangle at l: x := x L'^-1. */
SLV_FUNCTION SLI_INLINE void SLV_NAME(after_triangle)(const double *l, double *x, sl_int columns) {
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

/* N = -L'^-1 of a group of m columns from j0 on, row tiles c0 .. c1-1, row tile c from column 8c on, 0 where it
 * has no row; and P = -N D^-1. */
SLV_FUNCTION SLI_INLINE void SLV_NAME(group_inverse)(const sli_dual *f, sl_int j0, sl_int c0,
                                                     sl_int c1, double *scratch) {
    const sl_int m = sli_dual_columns(f, j0), tiles = sli_tiles(m), tile_size = SLI_TILE * SLI_TILE;
    double *N = scratch + SLI_DUAL_ROW * (ptrdiff_t)c0, *P = N + SLI_DUAL_GROUP * SLI_DUAL_ROW;
    sl_int c, t, k;
    for (c = c0; c < c1; c++, N += SLI_DUAL_ROW, P += SLI_DUAL_ROW) {
        for (t = c; t < tiles; t++) {
            const sl_int columns = sli_min(SLI_TILE, m - SLI_TILE * t);
            const double *l =
                f->panel + sli_tile_offset(f->width, j0 / SLI_TILE + t) + SLI_TILE * (ptrdiff_t)j0;
            double *x = N + tile_size * (ptrdiff_t)t;
            SLV_NAME(clear)(x, SLI_TILE);
            for (k = 0; k < columns && t == c; k++) {
                x[SLI_TILE * k + k] = -1.0;
            }
            if (t > c) { /* N(c, t) -= N(c, c..t-1) L(t, c..t-1)' */
                SLV_NAME(block)
                (N + tile_size * (ptrdiff_t)c, l + tile_size * (ptrdiff_t)c, SLI_TILE * (t - c), x,
                 columns);
            }
            SLV_NAME(after_triangle)(l + tile_size * (ptrdiff_t)t, x, columns);
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

/* W' = (L_SJ L_JJ^-1)', row tiles t0 .. t1-1 of the panel: [column tile][row][8 columns]. */
SLV_FUNCTION SLI_INLINE void SLV_NAME(group_weights)(const sli_dual *f, sl_int j0, sl_int t0,
                                                     sl_int t1, double *scratch) {
    const sl_int m = sli_dual_columns(f, j0), tile_size = SLI_TILE * SLI_TILE;
    const ptrdiff_t stride = sli_dual_stride(f, j0);
    const double *N = scratch;
    double *W = sli_dual_weights(scratch) + tile_size * (ptrdiff_t)(t0 - (j0 + m) / SLI_TILE);
    sl_int c, t;
    for (c = 0; c < sli_tiles(m); c++, N += SLI_DUAL_ROW, W += stride) {
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

/* Z_SJ -= Z_SS W, row tiles t0 .. t1-1, in chunks as in a factorization. */
SLV_FUNCTION SLI_INLINE void SLV_NAME(group_product)(const sli_dual *f, sl_int j0, sl_int t0,
                                                     sl_int t1, double *scratch) {
    const sl_int m = sli_dual_columns(f, j0), h = f->width + f->below, first = j0 + m;
    const ptrdiff_t stride = sli_dual_stride(f, j0), tile_size = SLI_TILE * SLI_TILE;
    const double *W = sli_dual_weights(scratch) + SLI_TILE * (ptrdiff_t)(first % SLI_TILE);
    sl_int t, c, s;
    for (t = t0; t < t1; t++) {
        double *row = f->front + sli_square_offset(h, t) + SLI_TILE * (ptrdiff_t)j0;
        for (c = 0; c < sli_tiles(m); c++) {
            SLV_NAME(clear)(row + tile_size * c, m - SLI_TILE * c);
        }
    }
    for (s = first; s < h; s += SLI_CHUNK) {
        const sl_int length = sli_min(SLI_CHUNK, h - s);
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

/* The first lanes of some columns of a tile at to become those at from: rows below share the others. */
SLV_FUNCTION SLI_INLINE void SLV_NAME(merge)(double *to, const double *from, sl_int lanes,
                                             sl_int first, sl_int last) {
    sl_int k;
    SLV_DECLARE(a)
    SLV_DECLARE(b)
    for (k = first; k < last; k++) {
        SLV_LOAD(a, from + SLI_TILE * k)
        SLV_LOAD(b, to + SLI_TILE * k)
        SLV_FIRST(a, lanes)
        SLV_BELOW(b, lanes - 1)
        SLV_ADD(a, b)
        SLV_STORE(to + SLI_TILE * k, a)
    }
}

/* Lanes first .. last-1 of the first columns of a tile to the columns and lanes of another. */
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

/* Z_JS = Z_SJ', columns of the row tiles t0 .. t1-1. */
SLV_FUNCTION SLI_INLINE void SLV_NAME(group_mirror)(const sli_dual *f, sl_int j0, sl_int t0,
                                                    sl_int t1) {
    const sl_int m = sli_dual_columns(f, j0), h = f->width + f->below;
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

/* Z_JJ = L_JJ'^-1 D^-1 L_JJ^-1 - W' Z_SJ, the lower tiles of the group's row tiles t0 .. t1-1 and what mirrors
 * them. */
SLV_FUNCTION SLI_INLINE void SLV_NAME(group_square)(const sli_dual *f, sl_int j0, sl_int t0,
                                                    sl_int t1, double *scratch) {
    const sl_int m = sli_dual_columns(f, j0), h = f->width + f->below, first = j0 + m;
    const sl_int tile_size = SLI_TILE * SLI_TILE;
    const ptrdiff_t stride = sli_dual_stride(f, j0);
    const double *N = scratch, *P = N + SLI_DUAL_GROUP * SLI_DUAL_ROW,
                 *W = sli_dual_weights(scratch) + SLI_TILE * (ptrdiff_t)(first % SLI_TILE);
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
            (N + SLI_DUAL_ROW * (ptrdiff_t)t + tile_size * (ptrdiff_t)t,
             P + SLI_DUAL_ROW * (ptrdiff_t)c + tile_size * (ptrdiff_t)t, m - SLI_TILE * t, x,
             columns);
            if (first < h) {
                SLV_NAME(block)
                (W + t * stride, column + SLI_TILE * (ptrdiff_t)first, h - first, x, columns);
            }
            SLV_NAME(merge)(row + tile_size * (ptrdiff_t)c, x, rows, 0, columns);
            if (c < t) {
                SLV_NAME(mirror)
                (x, 0, rows, column + SLI_TILE * (ptrdiff_t)j0 + tile_size * (ptrdiff_t)t,
                 SLI_TILE);
            }
        }
    }
}

SLV_FUNCTION static void SLV_NAME(dual)(const sli_dual *f, sl_int j0, sli_dual_part part, sl_int t0,
                                        sl_int t1, double *scratch) {
    switch (part) {
    case SLI_DUAL_INVERSE:
        SLV_NAME(group_inverse)(f, j0, t0, t1, scratch);
        break;
    case SLI_DUAL_WEIGHTS:
        SLV_NAME(group_weights)(f, j0, t0, t1, scratch);
        break;
    case SLI_DUAL_PRODUCT:
        SLV_NAME(group_product)(f, j0, t0, t1, scratch);
        break;
    case SLI_DUAL_MIRROR:
        SLV_NAME(group_mirror)(f, j0, t0, t1);
        break;
    default:
        SLV_NAME(group_square)(f, j0, t0, t1, scratch);
    }
}

/* From the last group of columns to the first, each with the columns after it among its rows below:
 * what a group works upon stays in the caches, whatever the width. */
SLV_FUNCTION static void SLV_NAME(takahashi)(const sli_dual *f, double *scratch) {
    sl_int j0;
    for (j0 = sli_dual_last(f); j0 + SLI_DUAL_COLUMNS > f->first; j0 -= SLI_DUAL_COLUMNS) {
        const sli_span group = sli_dual_span(f, j0, SLI_DUAL_INVERSE);
        const sli_span below = sli_dual_span(f, j0, SLI_DUAL_WEIGHTS);
        SLV_NAME(group_inverse)(f, j0, group.first, group.last, scratch);
        if (below.first < below.last) {
            SLV_NAME(group_weights)(f, j0, below.first, below.last, scratch);
            SLV_NAME(group_product)(f, j0, below.first, below.last, scratch);
            SLV_NAME(group_mirror)(f, j0, below.first, below.last);
        }
        SLV_NAME(group_square)(f, j0, group.first, group.last, scratch);
    }
}
/* end src/impl/takahashi.inl.h */

/* begin src/impl/narrow.inl.h */
/* narrow.inl.h: one right-hand side through a supernode of 1 to 8 columns, all of them in registers; words SLV_* */

/* Most supernodes of a 2D mesh are as narrow as this, and what they cost is not the reading of L but
 * loops that end at once, calls, and vectors loaded where single numbers were just stored. Here the
 * width is a constant that is folded into each of 8 copies: the loops over columns are gone, y or
 * the sums of all columns stay in registers, and x is gathered straight into them. */
#define SLI_DECLARE(k, y) SLV_DECLARE(y##k)
#define SLI_SUM_DECLARE(k, a) SLV_SUM_DECLARE(a##k)
#define SLI_SUM_ZERO(k, a) SLV_SUM_ZERO(a##k)

/* the diagonal tile, column after column; L is 0 above its diagonal */
#define SLI_COLUMN(k, unused)                                                                      \
    if ((k) < w) {                                                                                 \
        SLI_PREFETCH(l + SLI_TILE * (k), SLI_AHEAD);                                               \
        SLV_LANE(y##k, a, k)                                                                       \
        SLV_DOT(a, l + SLI_TILE * (k), y##k)                                                       \
    }
/* a tile below: even columns into one sum, odd ones into another */
#define SLI_EVEN_ODD(k, unused)                                                                    \
    if ((k) < w) {                                                                                 \
        SLI_PREFETCH(l + SLI_TILE * (k), SLI_AHEAD);                                               \
        if ((k) % 2 == 0) {                                                                        \
            SLV_DOT(a, l + SLI_TILE * (k), y##k)                                                   \
        } else {                                                                                   \
            SLV_DOT(b, l + SLI_TILE * (k), y##k)                                                   \
        }                                                                                          \
    }

SLV_FUNCTION SLI_ALWAYS_INLINE void SLV_NAME(narrow_forward)(const sl_int w, sl_int below,
                                                             const sl_int *rows, const double *l,
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
    for (row = SLI_TILE; row < w + below; row += SLI_TILE) { /* y(rows) -= L(rows, j) y(j) */
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

/* x(j) -= L(rows, j)' x(rows), from the last column down as L is read backward in memory */
#define SLI_DOT(k)                                                                                 \
    if ((k) < w) {                                                                                 \
        SLI_PREFETCH(l + SLI_TILE * (k), -SLI_AHEAD);                                              \
        SLV_SUM_DOT(a##k, l + SLI_TILE * (k), v)                                                   \
    }
#define SLI_DOTS                                                                                   \
    SLI_DOT(7) SLI_DOT(6) SLI_DOT(5) SLI_DOT(4) SLI_DOT(3) SLI_DOT(2) SLI_DOT(1) SLI_DOT(0)
/* places of the 8 rows of a tile; of a tile of fewer rows, the last one again; of those that share
 * the tile of the columns, anything for the columns' lanes */
#define SLI_PLACE(k) rows[at + (k)]
#define SLI_PLACE_PART(k) rows[at + sli_min(k, count - 1)]
#define SLI_PLACE_OWN(k) rows[sli_clamp((k)-w, at - 1)]
#define SLI_SET(k, unused) double r##k = r[k];
#define SLI_GET(k, unused)                                                                         \
    if ((k) < w) {                                                                                 \
        xs[k] = r##k;                                                                              \
    }
#define SLI_XT(j, k)                                                                               \
    if ((j) < (k) && (k) < w) { /* r(j) -= L(k, j) r(k) */                                         \
        r##j = SLV_FNMA1(l[SLI_TILE * (j) + (k)], r##k, r##j);                                     \
    }
#define SLI_ROW(k)                                                                                 \
    SLI_XT(6, k) SLI_XT(5, k) SLI_XT(4, k) SLI_XT(3, k) SLI_XT(2, k) SLI_XT(1, k) SLI_XT(0, k)

/* l points at the panel's end. */
SLV_FUNCTION SLI_ALWAYS_INLINE void SLV_NAME(narrow_backward)(const sl_int w, sl_int below,
                                                              const sl_int *rows, const double *l,
                                                              const double *d, double *xs,
                                                              const double *x) {
    const sl_int count = (w + below) % SLI_TILE;
    sl_int row = w + below - count, at = below;
    double r[SLI_TILE];
    SLV_DECLARE(v)
    SLV_DECLARE(z)
    SLI_EACH8(SLI_SUM_DECLARE, a)
    SLI_EACH8(SLI_SUM_ZERO, a)
    if (row > 0 && count > 0) {
        at -= count;
        l -= SLI_TILE * w;
        SLV_GATHER(v, x, SLI_PLACE_PART)
        SLV_FIRST(v, count)
        SLI_DOTS
    }
    for (; row > SLI_TILE; row -= SLI_TILE) {
        at -= SLI_TILE;
        l -= SLI_TILE * w;
        SLV_GATHER(v, x, SLI_PLACE)
        SLI_DOTS
    }
    l -= SLI_TILE * w;
    if (w < SLI_TILE && at > 0) {
        SLV_GATHER(v, x, SLI_PLACE_OWN)
        SLV_FIRST(v, w + at)
        SLV_BELOW(v, w - 1)
        SLI_DOTS
    }
    SLV_LOAD_PART(z, xs, w, 0.0)
    SLV_LOAD_PART(v, d, w, 1.0)
    SLV_DIVIDE(z, z, v)
    SLV_SUMS(v, a)
    SLV_ADD(v, z)
    SLV_STORE_ANY(r, v) {
        SLI_EACH8(SLI_SET, 0)
        SLI_ROW(7)
        SLI_ROW(6) SLI_ROW(5) SLI_ROW(4) SLI_ROW(3) SLI_ROW(2) SLI_ROW(1) SLI_EACH8(SLI_GET, 0)
    }
}

#define SLI_FORWARD(k) SLV_NAME(narrow_forward)(k, below, rows, l, xs, x, buf)
#define SLI_BACKWARD(k) SLV_NAME(narrow_backward)(k, below, rows, l, d, xs, x)

SLV_FUNCTION SLI_INLINE void SLV_NAME(forward_narrow)(sl_int w, sl_int below, const sl_int *rows,
                                                      const double *l, double *xs, double *x,
                                                      double *buf){SLI_CASES(SLI_FORWARD)}

SLV_FUNCTION SLI_INLINE
    void SLV_NAME(backward_narrow)(sl_int w, sl_int below, const sl_int *rows, const double *l,
                                   const double *d, double *xs, const double *x) {
    SLI_CASES(SLI_BACKWARD)
}

#undef SLI_DECLARE
#undef SLI_SUM_DECLARE
#undef SLI_SUM_ZERO
#undef SLI_COLUMN
#undef SLI_EVEN_ODD
#undef SLI_DOT
#undef SLI_DOTS
#undef SLI_PLACE
#undef SLI_PLACE_PART
#undef SLI_PLACE_OWN
#undef SLI_SET
#undef SLI_GET
#undef SLI_XT
#undef SLI_ROW
#undef SLI_FORWARD
#undef SLI_BACKWARD
/* end src/impl/narrow.inl.h */

/* begin src/impl/body.inl.h */
/* body.inl.h: one right-hand side, SIMD along the 8 rows of a tile; the words SLV_* are one octet of doubles */

/* buf := L^-1 buf on the first `rows` local rows of a panel, its columns 8 t0 .. columns-1 applied
 * in ascending order. tile points at tile t0. Four partial sums hide the latency of the FMA; their
 * grouping depends on the column number alone, so that a sweep that starts later, over zeros, gives
 * the same bits. */
SLV_FUNCTION SLI_INLINE void SLV_NAME(panel_forward)(const double *tile, sl_int t0, sl_int width,
                                                     sl_int columns, sl_int rows, double *buf) {
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
        for (j = first; j + 4 <= final; j += 4) { /* y(rows) -= L(rows, j) y(j) */
            const double *l = tile + SLI_TILE * j;
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
            SLV_NAME(tile_forward)(tile + SLI_TILE * row, buf + row);
        } else {
            for (k = 0; k < inner; k++) { /* columns inside the tile, one after the other */
                SLV_AXPY(a0, tile + SLI_TILE * (row + k), buf + row + k)
                SLV_STORE(buf + row, a0)
            }
        }
        tile += SLI_TILE * sli_min(width, row + SLI_TILE);
    }
}

SLV_FUNCTION static void SLV_NAME(forward)(sl_int count, const sli_step *s, const sl_int *rows,
                                           const double *L, double *x, double *buf) {
    for (; count > 0; count--, s++) {
        const sl_int w = s->width, height = w + s->below, first = SLI_TILE * s->first_tile;
        const double *tile = L + s->panel + sli_tile_offset(w, s->first_tile);
        double *xs = x + s->base;
        sl_int i;
        if (w <= SLI_TILE) {
            SLV_NAME(forward_narrow)(w, s->below, rows, tile, xs, x, buf);
            rows += s->below;
            continue;
        }
        memcpy(buf + first, xs, (size_t)(w - first) * sizeof(double));
        for (i = w; i < SLI_TILE * sli_tiles(height); i++) {
            buf[i] = 0.0;
        }
        SLV_NAME(panel_forward)(tile, s->first_tile, w, w, height, buf);
        memcpy(xs, buf + first, (size_t)(w - first) * sizeof(double));
        for (i = 0; i < s->below; i++) {
            x[rows[i]] += buf[w + i];
        }
        rows += s->below;
    }
}

/* The backward pass leaves 8 partial sums a column, or fewer where an octet takes several registers:
 * sums(j) -= L(rows, j)' x(rows) over the columns first .. final-1 of one row tile, or of two at
 * once, which spares half of the loads and stores of the sums. */
#define SLI_DECLARE(k, a) SLV_DECLARE(a##k)
#define SLI_SUM_DECLARE(k, a) SLV_SUM_DECLARE(a##k)
#define SLI_PLACE(k) rows[at + (k)]
#define SLI_PLACE_PART(k) rows[at + sli_clamp((k)-inner, part - 1)]

SLV_FUNCTION SLI_INLINE void SLV_NAME(dots1)(const double *l, const double *x, sl_int first,
                                             sl_int final, double *sums) {
    ptrdiff_t j;
    SLV_DECLARE(v)
    SLV_SUM_DECLARE(a)
    SLV_LOAD(v, x)
    for (j = SLI_TILE * ((ptrdiff_t) final - 1); j >= SLI_TILE * (ptrdiff_t)first; j -= SLI_TILE) {
        SLI_PREFETCH(l + j, -SLI_AHEAD);
        SLV_SUM_LOAD(a, sums + j)
        SLV_SUM_DOT(a, l + j, v)
        SLV_SUM_STORE(sums + j, a)
    }
}

/* Two tiles: l0 and its 8 rows at x, l1 and the 8 rows after those. */
SLV_FUNCTION SLI_INLINE void SLV_NAME(dots2)(const double *l0, const double *l1, const double *x,
                                             sl_int first, sl_int final, double *sums) {
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

/* The diagonal tile of the columns row .. row+inner-1: what the rows below them left is summed, the
 * right side added, the triangle solved. l: the tile's diagonal part. */
#define SLI_TAKE_SUM(k, unused)                                                                    \
    if ((k) < inner) {                                                                             \
        SLV_SUM_LOAD(a##k, sums + SLI_TILE * (k))                                                  \
        if (inner < SLI_TILE) {                                                                    \
            SLV_SUM_DOT(a##k, l + SLI_TILE * (k), v)                                               \
        }                                                                                          \
    } else {                                                                                       \
        SLV_SUM_ZERO(a##k)                                                                         \
    }
SLV_FUNCTION SLI_INLINE void SLV_NAME(diagonal)(const double *l, sl_int inner, const double *sums,
                                                const double *d, double *xs, double *buf) {
    double r[SLI_TILE];
    sl_int j, k;
    SLV_DECLARE(v)
    SLV_DECLARE(z)
    SLI_EACH8(SLI_SUM_DECLARE, a)
    SLV_ZERO(v)
    if (inner < SLI_TILE) { /* buf is 0 on the columns: only rows below count here */
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
        SLV_NAME(tile_backward)(l, r);
    } else {
        for (k = inner - 1; k > 0; k--) { /* x(j) -= L(k, j) x(k) */
            for (j = 0; j < k; j++) {
                r[j] = SLV_FNMA1(l[SLI_TILE * j + k], r[k], r[j]);
            }
        }
    }
    for (k = 0; k < inner; k++) {
        xs[k] = buf[k] = r[k];
    }
}

/* buf: the rows of two tiles; behind them the sums. */
SLV_FUNCTION static void SLV_NAME(backward)(sl_int count, const sli_step *s, const sl_int *rows_end,
                                            const double *L, const double *D, double *x,
                                            double *buf) {
    const int by_two = count <= SLI_FEW_STEPS;
    for (s += count; count > 0; count--) {
        const sl_int w = (--s)->width, height = w + s->below, first = SLI_TILE * s->first_tile;
        const double *d = D + s->column - first, *tile = L + s->panel + sli_panel_size(w, s->below);
        double *xs = x + s->base - first, *sums = buf + 2 * SLI_TILE;
        const sl_int *rows = rows_end -= s->below;
        sl_int row = SLI_TILE * (sli_tiles(height) - 1), j;
        SLV_DECLARE(v)
        SLV_SUM_DECLARE(a)
        if (w <= SLI_TILE) {
            SLV_NAME(backward_narrow)(w, s->below, rows, tile, d, xs, x);
            continue;
        }
        SLV_SUM_ZERO(a)
        for (j = first; j < w; j++) {
            SLV_SUM_STORE(sums + SLI_TILE * (ptrdiff_t)j, a)
        }
        for (; row >= first; row -= SLI_TILE) {
            const sl_int inner = sli_clamp(w - row, SLI_TILE), final = sli_min(row, w);
            const sl_int at = row + inner - w, part = sli_min(height - row, SLI_TILE) - inner;
            const double *above;
            tile -= SLI_TILE * (ptrdiff_t)sli_min(w, row + SLI_TILE);
            above = tile - SLI_TILE * (ptrdiff_t) final;
            if (part == SLI_TILE) {
                SLV_GATHER(v, x, SLI_PLACE)
                SLV_STORE(buf + SLI_TILE, v)
            } else if (inner < SLI_TILE) { /* rows below, between zeros */
                SLV_ZERO(v)
                if (part > 0) {
                    SLV_GATHER(v, x, SLI_PLACE_PART)
                    SLV_FIRST(v, inner + part)
                }
                SLV_STORE(buf + SLI_TILE, v)
                for (j = 0; j < inner; j++) {
                    buf[SLI_TILE + j] = 0.0;
                }
            }
            if (inner > 0) {
                SLV_NAME(diagonal)
                (tile + SLI_TILE * (ptrdiff_t)row, inner, sums + SLI_TILE * (ptrdiff_t)row, d + row,
                 xs + row, buf + SLI_TILE);
            }
            if (!by_two || row == first || (inner == 0 && row - SLI_TILE < w)) {
                SLV_NAME(dots1)(tile, buf + SLI_TILE, first, final, sums);
                continue;
            }
            row -= SLI_TILE;
            if (inner == 0) {
                rows -= SLI_TILE;
                SLV_GATHER(v, x, SLI_PLACE)
                rows += SLI_TILE;
                SLV_STORE(buf, v)
                SLV_NAME(dots2)(above, tile, buf, first, w, sums);
            } else {
                SLV_NAME(dots1)(tile, buf + SLI_TILE, row, final, sums);
                SLV_NAME(diagonal)
                (above + SLI_TILE * (ptrdiff_t)row, SLI_TILE, sums + SLI_TILE * (ptrdiff_t)row,
                 d + row, xs + row, buf);
                SLV_NAME(dots2)(above, tile, buf, first, row, sums);
            }
            tile = above;
        }
    }
}

#undef SLI_DECLARE
#undef SLI_SUM_DECLARE
#undef SLI_PLACE
#undef SLI_PLACE_PART
#undef SLI_TAKE_SUM

SLV_FUNCTION static void SLV_NAME(row)(double *panel, sl_int w, sl_int q, const sl_int *rows,
                                       const double *D, double *xs, double *x, double *buf,
                                       double *pivot, double *magnitude) {
    const sl_int columns = sli_min(q, w);
    double *lq = panel + sli_panel_at(w, q, 0);
    double d = *pivot, size = *magnitude;
    sl_int i;
    for (i = 0; i < columns; i++) { /* y = row of A minus what the descendants sent */
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
    for (i = 0; i < columns; i++) { /* l(k, j) = y(j) / d(j), d(k) -= l(k, j) y(j) */
        const double l = buf[i] / D[i];
        lq[SLI_TILE * i] = l;
        d = SLV_FNMA1(l, buf[i], d);
        size += fabs(l * buf[i]);
    }
    *pivot = d;
    *magnitude = size;
}

static const sli_kernels SLV_NAME(kernels) = {
    SLV_ISA,
    {SLV_NAME(forward), SLV_NAME(forward2), SLV_NAME(forward4), SLV_NAME(forward8)},
    {SLV_NAME(backward), SLV_NAME(backward2), SLV_NAME(backward4), SLV_NAME(backward8)},
    SLV_NAME(row),
    SLV_NAME(pivots),
    SLV_NAME(rows),
    SLV_NAME(update),
    SLV_NAME(assemble),
    SLV_NAME(products8),
    SLV_NAME(gather),
    SLV_NAME(dual),
    SLV_NAME(takahashi)};
/* end src/impl/body.inl.h */

/* begin src/impl/words_end.inl.h */
/* words_end.inl.h: takes the octet words back, for the next instruction set */
#undef SLV_NAME
#undef SLV_ISA
#undef SLV_FUNCTION
#undef SLV_DECLARE
#undef SLV_ZERO
#undef SLV_LOAD
#undef SLV_STORE
#undef SLV_ADD
#undef SLV_AXPY
#undef SLV_DOT
#undef SLV_FNMA1
#undef SLV_STORE_ANY
#undef SLV_FNMA
#undef SLV_TWICE_LOW
#undef SLV_TWICE_HIGH
#undef SLV_TWICE_AT
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
#undef SLV_SPREAD
#undef SLV_SPREAD_ADD
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
/* end src/impl/words_end.inl.h */

#endif

#endif
/* end src/impl/isa_avx2.h */
/* begin src/impl/isa_avx512.h */
/* isa_avx512.h: the kernels in AVX-512: an octet is one register */
#ifndef SLI_ISA_AVX512_H
#define SLI_ISA_AVX512_H

#if defined(SLI_X86)

#define SLV_NAME(f) sli_##f##_avx512
#define SLV_ISA SL_ISA_AVX512
#define SLV_FUNCTION SLI_TARGET("avx512f,avx2,fma")
#define SLV_FNMA1(a, b, c) __builtin_fma(-(a), b, c) /* c - a b */
#define SLV_DECLARE(a) __m512d a;
#define SLV_ZERO(a) a = _mm512_setzero_pd();
#define SLV_LOAD(a, p) a = _mm512_load_pd(p);
#define SLV_STORE(p, a) _mm512_store_pd((p), a);
#define SLV_ADD(a, b) a = _mm512_add_pd(a, b);
#define SLV_AXPY(a, l, p) a = _mm512_fnmadd_pd(_mm512_load_pd(l), _mm512_set1_pd(*(p)), a);
#define SLV_DOT(a, l, v) a = _mm512_fnmadd_pd(_mm512_load_pd(l), v, a);
#define SLV_STORE_ANY(p, a) _mm512_storeu_pd((p), a);
#define SLV_FNMA(a, b, c) a = _mm512_fnmadd_pd(b, c, a);
#define SLV_LOAD_PART(a, p, count, rest)                                                           \
    a = _mm512_mask_loadu_pd(_mm512_set1_pd(rest), (__mmask8)(0xff >> (8 - (count))), (p));
#define SLV_FIRST(a, count) a = _mm512_maskz_mov_pd((__mmask8)(0xff >> (8 - (count))), a);
#define SLV_LANE(b, a, k) b = _mm512_maskz_permutexvar_pd(0xff, _mm512_set1_epi64(k), a);
#define SLV_GATHER(a, x, at)                                                                       \
    a = _mm512_set_pd((x)[at(7)], (x)[at(6)], (x)[at(5)], (x)[at(4)], (x)[at(3)], (x)[at(2)],      \
                      (x)[at(1)], (x)[at(0)]);
#define SLV_SUM_DECLARE(a) SLV_DECLARE(a)
#define SLV_SUM_ZERO(a) SLV_ZERO(a)
#define SLV_SUM_LOAD(a, p) SLV_LOAD(a, p)
#define SLV_SUM_STORE(p, a) SLV_STORE(p, a)
#define SLV_SUM_DOT(a, l, v) SLV_DOT(a, l, v)
#define SLV_SUM_2(a, b)                                                                            \
    _mm512_add_pd(_mm512_maskz_unpacklo_pd(0xff, a, b), _mm512_maskz_unpackhi_pd(0xff, a, b))
#define SLV_SUM_4(a, b)                                                                            \
    _mm512_add_pd(_mm512_maskz_shuffle_f64x2(0xff, a, b, 0x88),                                    \
                  _mm512_maskz_shuffle_f64x2(0xff, a, b, 0xdd))
#define SLV_SUMS(r, a)                                                                             \
    r = SLV_SUM_4(SLV_SUM_4(SLV_SUM_2(a##0, a##1), SLV_SUM_2(a##2, a##3)),                         \
                  SLV_SUM_4(SLV_SUM_2(a##4, a##5), SLV_SUM_2(a##6, a##7)));
#define SLV_BLOCKS_EVEN(a, b) _mm512_maskz_shuffle_f64x2(0xff, a, b, 0x88)
#define SLV_BLOCKS_ODD(a, b) _mm512_maskz_shuffle_f64x2(0xff, a, b, 0xdd)
/* rows i, i + 2, i + 4, i + 6 from the pairs of columns: even rows are unpacked low, odd ones high */
#define SLV_TRANSPOSE_4(to, from, unpack)                                                          \
    {                                                                                              \
        const __m512d a_ = unpack(0xff, _mm512_load_pd(from), _mm512_load_pd((from) + 8));         \
        const __m512d b_ = unpack(0xff, _mm512_load_pd((from) + 16), _mm512_load_pd((from) + 24)); \
        const __m512d c_ = unpack(0xff, _mm512_load_pd((from) + 32), _mm512_load_pd((from) + 40)); \
        const __m512d d_ = unpack(0xff, _mm512_load_pd((from) + 48), _mm512_load_pd((from) + 56)); \
        const __m512d e_ = SLV_BLOCKS_EVEN(a_, b_), f_ = SLV_BLOCKS_EVEN(c_, d_);                  \
        const __m512d g_ = SLV_BLOCKS_ODD(a_, b_), h_ = SLV_BLOCKS_ODD(c_, d_);                    \
        _mm512_store_pd((to), SLV_BLOCKS_EVEN(e_, f_));                                            \
        _mm512_store_pd((to) + 16, SLV_BLOCKS_EVEN(g_, h_));                                       \
        _mm512_store_pd((to) + 32, SLV_BLOCKS_ODD(e_, f_));                                        \
        _mm512_store_pd((to) + 48, SLV_BLOCKS_ODD(g_, h_));                                        \
    }
#define SLV_TRANSPOSE(to, from)                                                                    \
    SLV_TRANSPOSE_4(to, from, _mm512_maskz_unpacklo_pd)                                            \
    SLV_TRANSPOSE_4((to) + 8, from, _mm512_maskz_unpackhi_pd)
#define SLV_TILES 2
#define SLV_COLUMNS 8
#define SLV_EACH_COLUMN SLI_EACH8
#define SLV_LOAD_PINNED(a, p)                                                                      \
    a = _mm512_load_pd(p);                                                                         \
    __asm__("" : "+v"(a)); /* used 8 times: not to be loaded 8 times */
#define SLV_BROADCAST(b, p) b = _mm512_set1_pd(*(p));
#define SLV_MULTIPLY(a, b, c) a = _mm512_mul_pd(b, c);
#define SLV_DIVIDE(a, b, c) a = _mm512_div_pd(b, c);
#define SLV_BELOW(a, k) a = _mm512_maskz_mov_pd((__mmask8)(0xfe << (k)), a);
/* a permutation made once: the expanding instruction takes twice as long */
#define SLV_SPREAD(mask, lanes, count)                                                             \
    const __mmask8 spread_ = (__mmask8)(mask);                                                     \
    const __m512i order_ =                                                                         \
        _mm512_maskz_expand_epi64(spread_, _mm512_set_epi64(7, 6, 5, 4, 3, 2, 1, 0));              \
    (void)(lanes);
#define SLV_SPREAD_ADD(to, from)                                                                   \
    _mm512_store_pd(                                                                               \
        (to), _mm512_add_pd(_mm512_load_pd(to),                                                    \
                            _mm512_maskz_permutexvar_pd(spread_, order_, _mm512_loadu_pd(from))));
#define SLV_TWICE_LOW(e, l)                                                                        \
    e = _mm512_maskz_permutexvar_pd(0xff, _mm512_set_epi64(3, 3, 2, 2, 1, 1, 0, 0),                \
                                    _mm512_load_pd(l));
#define SLV_TWICE_HIGH(e, l)                                                                       \
    e = _mm512_maskz_permutexvar_pd(0xff, _mm512_set_epi64(7, 7, 6, 6, 5, 5, 4, 4),                \
                                    _mm512_load_pd(l));
#define SLV_PAIR(b, p)                                                                             \
    b = _mm512_castps_pd(_mm512_maskz_broadcast_f32x4(0xffff, _mm_castpd_ps(_mm_loadu_pd(p))));

#define SLW_NAME(f) sli_##f##4_avx512
/* begin src/impl/lanes_ymm.inl.h */
/* lanes_ymm.inl.h: four right-hand sides in one 256-bit register, for AVX2 and AVX-512 alike */

#define SLW_LANES 4
#define SLW_ROWS 8
#define SLW_DECLARE(a) __m256d a;
#define SLW_ZERO(a) a = _mm256_setzero_pd();
#define SLW_LOAD(a, p) a = _mm256_loadu_pd(p);
#define SLW_STORE(p, a) _mm256_storeu_pd((p), a);
#define SLW_FNMA(a, s, b) a = _mm256_fnmadd_pd(_mm256_broadcast_sd(&(s)), b, a);
#define SLW_ADD(a, b) a = _mm256_add_pd(a, b);
#define SLW_DIVIDE(a, s) a = _mm256_div_pd(a, _mm256_set1_pd(s));
/* begin src/impl/lanes.inl.h */
/* lanes.inl.h: 2, 4 or 8 interleaved right-hand sides, SIMD along them; the words SLW_* are one row of SLW_LANES */

/* SLW_EACH(op, k) is op(0, k) op(1, k) .. for the SLW_ROWS rows that are kept in registers at once,
 * SLW_HIGH and SLW_LOW are its halves from the last row down; a0, a1, .. are their accumulators, b
 * and c one row more each. SLW_EACH_AGAIN is SLW_EACH once more, as a macro does not expand inside
 * itself. */
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
#define SLI_LOAD(r, p) SLW_LOAD(a##r, (p) + (r)*SLW_LANES)
#define SLI_STORE(r, p) SLW_STORE((p) + (r)*SLW_LANES, a##r)
#define SLI_APPLY(r, l) SLW_FNMA(a##r, (l)[r], b)  /* a(r) -= L(r, j) x(j) */
#define SLI_GATHER(r, l) SLW_FNMA(b, (l)[r], a##r) /* x(j) -= L(r, j) x(r), in two chains */
#define SLI_GATHER2(r, l) SLW_FNMA(c, (l)[r], a##r)
/* inside the diagonal block: column k onto the rows below it, and row k onto the columns before it
 */
#define SLI_DOWN(r, k)                                                                             \
    if ((r) > (k)) {                                                                               \
        SLW_FNMA(a##r, l[SLI_TILE * (k) + (r)], a##k)                                              \
    }
#define SLI_UP(j, k)                                                                               \
    if ((j) < (k) && (j) < inner) {                                                                \
        SLW_FNMA(a##j, l[SLI_TILE * (j) + (k)], a##k)                                              \
    }
#define SLI_COLUMN(k, unused)                                                                      \
    if ((k) < inner) {                                                                             \
        SLW_EACH_AGAIN(SLI_DOWN, k)                                                                \
    }
#define SLI_ROW(k, unused) SLW_EACH_AGAIN(SLI_UP, k)

#if SLW_ROWS == 8
/* A supernode of 1 to 8 columns, the width folded in as in narrow.inl.h: the columns' rows stay in
 * registers, and the rows below pass by one after the other. Rows of x are `stride` apart. */
#define SLI_LOAD_OWN(k, p)                                                                         \
    if ((k) < w) {                                                                                 \
        SLW_LOAD(a##k, (p) + (k)*stride)                                                           \
    }
#define SLI_STORE_OWN(k, p)                                                                        \
    if ((k) < w) {                                                                                 \
        SLW_STORE((p) + (k)*stride, a##k)                                                          \
    }
#define SLI_ZERO_OWN(k, unused) SLW_ZERO(a##k)
#define SLI_AHEAD_OWN(k, bytes)                                                                    \
    if ((k) < w) {                                                                                 \
        SLI_PREFETCH(l + SLI_TILE * (k), bytes);                                                   \
    }
#define SLI_DOWN_OWN(r, k)                                                                         \
    if ((r) > (k) && (r) < w) {                                                                    \
        SLW_FNMA(a##r, l[SLI_TILE * (k) + (r)], a##k)                                              \
    }
#define SLI_COLUMN_OWN(k, unused) SLW_EACH_AGAIN(SLI_DOWN_OWN, k)
#define SLI_BELOW_OWN(k, unused)                                                                   \
    if ((k) < w) {                                                                                 \
        SLW_FNMA(b, l[SLI_TILE * (k) + lane], a##k)                                                \
    }

SLV_FUNCTION SLI_ALWAYS_INLINE void SLW_NAME(narrow_forward)(const sl_int w, sl_int stride,
                                                             sl_int below, const sl_int *rows,
                                                             const double *l, double *xs,
                                                             double *x) {
    sl_int lane = w, i;
    SLW_EACH(SLI_DECLARE, 0)
    SLW_DECLARE(b)
    SLW_EACH(SLI_AHEAD_OWN, SLI_AHEAD)
    SLW_EACH(SLI_LOAD_OWN, xs)
    SLW_EACH(SLI_COLUMN_OWN, 0)
    SLW_EACH(SLI_STORE_OWN, xs)
    for (i = 0; i < below; lane++, i++) { /* x(i) -= L(i, j) x(j) */
        double *to = x + (ptrdiff_t)rows[i] * stride;
        if (lane == SLI_TILE) {
            lane = 0;
            l += SLI_TILE * w;
            SLW_EACH(SLI_AHEAD_OWN, SLI_AHEAD)
        }
        SLW_LOAD(b, to)
        SLW_EACH(SLI_BELOW_OWN, 0)
        SLW_STORE(to, b)
    }
}

#define SLI_UP_OWN(j, k)                                                                           \
    if ((j) < (k) && (k) < w) {                                                                    \
        SLW_FNMA(a##j, l[SLI_TILE * (j) + (k)], a##k)                                              \
    }
#define SLI_ROW_OWN(k, unused) SLW_EACH_AGAIN(SLI_UP_OWN, k)
#define SLI_ABOVE_OWN(k, unused)                                                                   \
    if ((k) < w) {                                                                                 \
        SLW_FNMA(a##k, l[SLI_TILE * (k) + lane], b)                                                \
    }
#define SLI_DIVIDE_OWN(k, unused)                                                                  \
    if ((k) < w) {                                                                                 \
        SLW_LOAD(b, xs + (k)*stride)                                                               \
        SLW_DIVIDE(b, d[k])                                                                        \
        SLW_ADD(a##k, b)                                                                           \
    }

/* l points at the panel's last tile. */
SLV_FUNCTION SLI_ALWAYS_INLINE void SLW_NAME(narrow_backward)(const sl_int w, sl_int stride,
                                                              sl_int below, const sl_int *rows,
                                                              const double *l, const double *d,
                                                              double *xs, const double *x) {
    sl_int i = below - 1, lane = (w + i) % SLI_TILE;
    SLW_EACH(SLI_DECLARE, 0)
    SLW_DECLARE(b)
    SLW_EACH(SLI_ZERO_OWN, 0)
    SLW_HIGH(SLI_AHEAD_OWN, -SLI_AHEAD)
    SLW_LOW(SLI_AHEAD_OWN, -SLI_AHEAD)
    for (; i >= 0; lane--, i--) { /* x(j) -= L(i, j) x(i) */
        if (lane < 0) {
            lane = SLI_TILE - 1;
            l -= SLI_TILE * w;
            SLW_HIGH(SLI_AHEAD_OWN, -SLI_AHEAD)
            SLW_LOW(SLI_AHEAD_OWN, -SLI_AHEAD)
        }
        SLW_LOAD(b, x + (ptrdiff_t)rows[i] * stride)
        SLW_HIGH(SLI_ABOVE_OWN, 0)
        SLW_LOW(SLI_ABOVE_OWN, 0)
    }
    if (w == SLI_TILE && below > 0) {
        l -= SLI_TILE * w;
    }
    SLW_EACH(SLI_DIVIDE_OWN, 0)
    SLW_HIGH(SLI_ROW_OWN, 0)
    SLW_LOW(SLI_ROW_OWN, 0)
    SLW_EACH(SLI_STORE_OWN, xs)
}

#define SLI_FORWARD(k) SLW_NAME(narrow_forward)(k, stride, below, rows, l, xs, x)
#define SLI_BACKWARD(k) SLW_NAME(narrow_backward)(k, stride, below, rows, l, d, xs, x)

SLV_FUNCTION static void SLW_NAME(forward_narrow)(sl_int w, sl_int stride, sl_int below,
                                                  const sl_int *rows, const double *l, double *xs,
                                                  double *x){SLI_CASES(SLI_FORWARD)}

SLV_FUNCTION static void SLW_NAME(backward_narrow)(sl_int w, sl_int stride, sl_int below,
                                                   const sl_int *rows, const double *l,
                                                   const double *d, double *xs, const double *x) {
    SLI_CASES(SLI_BACKWARD)
}

#undef SLI_LOAD_OWN
#undef SLI_STORE_OWN
#undef SLI_ZERO_OWN
#undef SLI_AHEAD_OWN
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
/* Registers do not suffice for 8 such rows: half of the lanes, then the other half. */
SLV_FUNCTION SLI_INLINE void SLW_NAME(forward_narrow)(sl_int w, sl_int stride, sl_int below,
                                                      const sl_int *rows, const double *l,
                                                      double *xs, double *x) {
    const sl_int half = SLW_LANES / 2;
    SLW_HALF(forward_narrow)(w, stride, below, rows, l, xs, x);
    SLW_HALF(forward_narrow)(w, stride, below, rows, l, xs + half, x + half);
}

SLV_FUNCTION SLI_INLINE void SLW_NAME(backward_narrow)(sl_int w, sl_int stride, sl_int below,
                                                       const sl_int *rows, const double *l,
                                                       const double *d, double *xs,
                                                       const double *x) {
    const sl_int half = SLW_LANES / 2;
    SLW_HALF(backward_narrow)(w, stride, below, rows, l, d, xs, x);
    SLW_HALF(backward_narrow)(w, stride, below, rows, l, d, xs + half, x + half);
}
#endif

/* The rows of a tile that are not all columns of the supernode, side by side in buf: `inner` of its
 * own, then rows below, then zeros. */
SLV_FUNCTION SLI_INLINE void SLW_NAME(rows_in)(double *buf, sl_int inner, sl_int below,
                                               const sl_int *rows, const double *own,
                                               const double *x) {
    sl_int r;
    SLW_DECLARE(b)
    for (r = 0; r < SLW_ROWS; r++) {
        if (r < inner + below) {
            SLW_LOAD(b, r < inner ? own + (ptrdiff_t)r * SLW_LANES
                                  : x + (ptrdiff_t)rows[r - inner] * SLW_LANES)
        } else {
            SLW_ZERO(b)
        }
        SLW_STORE(buf + (ptrdiff_t)r * SLW_LANES, b)
    }
}

SLV_FUNCTION SLI_INLINE void SLW_NAME(rows_out)(const double *buf, sl_int inner, sl_int below,
                                                const sl_int *rows, double *own, double *x) {
    sl_int r;
    SLW_DECLARE(b)
    for (r = 0; r < SLW_ROWS && r < inner + below; r++) {
        SLW_LOAD(b, buf + (ptrdiff_t)r * SLW_LANES)
        SLW_STORE(r < inner ? own + (ptrdiff_t)r * SLW_LANES
                            : x + (ptrdiff_t)rows[r - inner] * SLW_LANES,
                  b)
    }
}

SLV_FUNCTION static void SLW_NAME(forward)(sl_int count, const sli_step *s, const sl_int *rows,
                                           const double *L, double *x, double *buf) {
    for (; count > 0; rows += s->below, count--, s++) {
        const sl_int w = s->width, height = w + s->below, first = SLI_TILE * s->first_tile;
        const double *tile = L + s->panel + sli_tile_offset(w, s->first_tile);
        double *xs = x + ((ptrdiff_t)s->base - first) * SLW_LANES;
        ptrdiff_t row;
        sl_int j;
#if SLW_ROWS == 8 || defined(SLW_HALF)
        if (w <= SLI_TILE) {
            SLW_NAME(forward_narrow)(w, SLW_LANES, s->below, rows, tile, xs, x);
            continue;
        }
#endif
        for (row = first; row < height; row += SLW_ROWS) {
            const sl_int lane = (sl_int)(row % SLI_TILE), final = (sl_int)(row < w ? row : w);
            const sl_int inner = sli_clamp(w - (sl_int)row, SLW_ROWS);
            const sl_int *places = rows + (row + inner - w);
            double *own = xs + row * SLW_LANES, *p = inner == SLW_ROWS ? own : buf;
            const double *l = tile + SLI_TILE * (ptrdiff_t)first + lane;
            SLW_EACH(SLI_DECLARE, 0)
            SLW_DECLARE(b)
            if (inner < SLW_ROWS) {
                SLW_NAME(rows_in)(buf, inner, height - (sl_int)row - inner, places, own, x);
            }
            SLW_EACH(SLI_LOAD, p)
            for (j = first; j < final; j++, l += SLI_TILE) {
                SLI_PREFETCH(l, SLI_AHEAD);
                SLW_LOAD(b, xs + (ptrdiff_t)j * SLW_LANES)
                SLW_EACH(SLI_APPLY, l)
            }
            if (inner > 0) {
                SLW_EACH(SLI_COLUMN, 0)
            }
            SLW_EACH(SLI_STORE, p)
            if (inner < SLW_ROWS) {
                SLW_NAME(rows_out)(buf, inner, height - (sl_int)row - inner, places, own, x);
            }
            if (lane + SLW_ROWS == SLI_TILE) {
                tile += SLI_TILE * (ptrdiff_t)sli_min(w, (sl_int)row + SLW_ROWS);
            }
        }
    }
}

SLV_FUNCTION static void SLW_NAME(backward)(sl_int count, const sli_step *s, const sl_int *rows_end,
                                            const double *L, const double *D, double *x,
                                            double *buf) {
    for (s += count; count > 0; count--) {
        const sl_int w = (--s)->width, height = w + s->below, first = SLI_TILE * s->first_tile;
        const sl_int padded = SLI_TILE * sli_tiles(height);
        const double *tile = L + s->panel + sli_panel_size(w, s->below), *d = D + s->column - first;
        double *xs = x + ((ptrdiff_t)s->base - first) * SLW_LANES;
        ptrdiff_t row;
        sl_int i, j;
        SLW_DECLARE(b)
        SLW_DECLARE(c)
        rows_end -= s->below;
#if SLW_ROWS == 8 || defined(SLW_HALF)
        if (w <= SLI_TILE) {
            SLW_NAME(backward_narrow)
            (w, SLW_LANES, s->below, rows_end, tile - SLI_TILE * w, d, xs, x);
            continue;
        }
#endif
        for (i = first; i < w; i++) {
            SLW_LOAD(b, xs + (ptrdiff_t)i * SLW_LANES)
            SLW_DIVIDE(b, d[i])
            SLW_STORE(xs + (ptrdiff_t)i * SLW_LANES, b)
        }
        for (row = padded - SLW_ROWS; row >= first; row -= SLW_ROWS) {
            const sl_int lane = (sl_int)(row % SLI_TILE), final = (sl_int)(row < w ? row : w);
            const sl_int inner = sli_clamp(w - (sl_int)row, SLW_ROWS);
            double *own = xs + row * SLW_LANES, *p = inner == SLW_ROWS ? own : buf;
            const double *l;
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
                SLI_PREFETCH(l, -SLI_AHEAD);
                SLW_LOAD(b, xs + (ptrdiff_t)j * SLW_LANES)
                SLW_ZERO(c)
                SLW_HIGH(SLI_GATHER, l)
                SLW_LOW(SLI_GATHER2, l)
                SLW_ADD(b, c)
                SLW_STORE(xs + (ptrdiff_t)j * SLW_LANES, b)
            }
        }
    }
}

#if SLW_LANES == 8
SLV_FUNCTION static void SLW_NAME(products)(sl_int count, const double *y, const double *z,
                                            double *sums) {
    sl_int row, k;
    for (row = 0; row < SLW_LANES; row += SLW_ROWS) {
        const double *l = y + row, *p = z;
        double *s = sums + row * SLW_LANES;
        SLW_EACH(SLI_DECLARE, 0)
        SLW_DECLARE(b)
        SLW_EACH(SLI_LOAD, s)
        for (k = 0; k < count; k++, l += SLW_LANES, p += SLW_LANES) {
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
#undef SLW_NAME
#undef SLW_LANES
#undef SLW_ROWS
#undef SLW_HALF
#undef SLW_EACH
#undef SLW_EACH_AGAIN
#undef SLW_HIGH
#undef SLW_LOW
#undef SLW_DECLARE
#undef SLW_ZERO
#undef SLW_LOAD
#undef SLW_STORE
#undef SLW_ADD
#undef SLW_FNMA
#undef SLW_DIVIDE
/* end src/impl/lanes.inl.h */
/* end src/impl/lanes_ymm.inl.h */

#define SLW_NAME(f) sli_##f##8_avx512
#define SLW_LANES 8
#define SLW_ROWS 8
#define SLW_DECLARE(a) __m512d a;
#define SLW_ZERO(a) a = _mm512_setzero_pd();
#define SLW_LOAD(a, p) a = _mm512_loadu_pd(p);
#define SLW_STORE(p, a) _mm512_storeu_pd((p), a);
#define SLW_FNMA(a, s, b) a = _mm512_fnmadd_pd(_mm512_set1_pd(s), b, a);
#define SLW_ADD(a, b) a = _mm512_add_pd(a, b);
#define SLW_DIVIDE(a, s) a = _mm512_div_pd(a, _mm512_set1_pd(s));
/* begin src/impl/lanes.inl.h */
/* lanes.inl.h: 2, 4 or 8 interleaved right-hand sides, SIMD along them; the words SLW_* are one row of SLW_LANES */

/* SLW_EACH(op, k) is op(0, k) op(1, k) .. for the SLW_ROWS rows that are kept in registers at once,
 * SLW_HIGH and SLW_LOW are its halves from the last row down; a0, a1, .. are their accumulators, b
 * and c one row more each. SLW_EACH_AGAIN is SLW_EACH once more, as a macro does not expand inside
 * itself. */
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
#define SLI_LOAD(r, p) SLW_LOAD(a##r, (p) + (r)*SLW_LANES)
#define SLI_STORE(r, p) SLW_STORE((p) + (r)*SLW_LANES, a##r)
#define SLI_APPLY(r, l) SLW_FNMA(a##r, (l)[r], b)  /* a(r) -= L(r, j) x(j) */
#define SLI_GATHER(r, l) SLW_FNMA(b, (l)[r], a##r) /* x(j) -= L(r, j) x(r), in two chains */
#define SLI_GATHER2(r, l) SLW_FNMA(c, (l)[r], a##r)
/* inside the diagonal block: column k onto the rows below it, and row k onto the columns before it
 */
#define SLI_DOWN(r, k)                                                                             \
    if ((r) > (k)) {                                                                               \
        SLW_FNMA(a##r, l[SLI_TILE * (k) + (r)], a##k)                                              \
    }
#define SLI_UP(j, k)                                                                               \
    if ((j) < (k) && (j) < inner) {                                                                \
        SLW_FNMA(a##j, l[SLI_TILE * (j) + (k)], a##k)                                              \
    }
#define SLI_COLUMN(k, unused)                                                                      \
    if ((k) < inner) {                                                                             \
        SLW_EACH_AGAIN(SLI_DOWN, k)                                                                \
    }
#define SLI_ROW(k, unused) SLW_EACH_AGAIN(SLI_UP, k)

#if SLW_ROWS == 8
/* A supernode of 1 to 8 columns, the width folded in as in narrow.inl.h: the columns' rows stay in
 * registers, and the rows below pass by one after the other. Rows of x are `stride` apart. */
#define SLI_LOAD_OWN(k, p)                                                                         \
    if ((k) < w) {                                                                                 \
        SLW_LOAD(a##k, (p) + (k)*stride)                                                           \
    }
#define SLI_STORE_OWN(k, p)                                                                        \
    if ((k) < w) {                                                                                 \
        SLW_STORE((p) + (k)*stride, a##k)                                                          \
    }
#define SLI_ZERO_OWN(k, unused) SLW_ZERO(a##k)
#define SLI_AHEAD_OWN(k, bytes)                                                                    \
    if ((k) < w) {                                                                                 \
        SLI_PREFETCH(l + SLI_TILE * (k), bytes);                                                   \
    }
#define SLI_DOWN_OWN(r, k)                                                                         \
    if ((r) > (k) && (r) < w) {                                                                    \
        SLW_FNMA(a##r, l[SLI_TILE * (k) + (r)], a##k)                                              \
    }
#define SLI_COLUMN_OWN(k, unused) SLW_EACH_AGAIN(SLI_DOWN_OWN, k)
#define SLI_BELOW_OWN(k, unused)                                                                   \
    if ((k) < w) {                                                                                 \
        SLW_FNMA(b, l[SLI_TILE * (k) + lane], a##k)                                                \
    }

SLV_FUNCTION SLI_ALWAYS_INLINE void SLW_NAME(narrow_forward)(const sl_int w, sl_int stride,
                                                             sl_int below, const sl_int *rows,
                                                             const double *l, double *xs,
                                                             double *x) {
    sl_int lane = w, i;
    SLW_EACH(SLI_DECLARE, 0)
    SLW_DECLARE(b)
    SLW_EACH(SLI_AHEAD_OWN, SLI_AHEAD)
    SLW_EACH(SLI_LOAD_OWN, xs)
    SLW_EACH(SLI_COLUMN_OWN, 0)
    SLW_EACH(SLI_STORE_OWN, xs)
    for (i = 0; i < below; lane++, i++) { /* x(i) -= L(i, j) x(j) */
        double *to = x + (ptrdiff_t)rows[i] * stride;
        if (lane == SLI_TILE) {
            lane = 0;
            l += SLI_TILE * w;
            SLW_EACH(SLI_AHEAD_OWN, SLI_AHEAD)
        }
        SLW_LOAD(b, to)
        SLW_EACH(SLI_BELOW_OWN, 0)
        SLW_STORE(to, b)
    }
}

#define SLI_UP_OWN(j, k)                                                                           \
    if ((j) < (k) && (k) < w) {                                                                    \
        SLW_FNMA(a##j, l[SLI_TILE * (j) + (k)], a##k)                                              \
    }
#define SLI_ROW_OWN(k, unused) SLW_EACH_AGAIN(SLI_UP_OWN, k)
#define SLI_ABOVE_OWN(k, unused)                                                                   \
    if ((k) < w) {                                                                                 \
        SLW_FNMA(a##k, l[SLI_TILE * (k) + lane], b)                                                \
    }
#define SLI_DIVIDE_OWN(k, unused)                                                                  \
    if ((k) < w) {                                                                                 \
        SLW_LOAD(b, xs + (k)*stride)                                                               \
        SLW_DIVIDE(b, d[k])                                                                        \
        SLW_ADD(a##k, b)                                                                           \
    }

/* l points at the panel's last tile. */
SLV_FUNCTION SLI_ALWAYS_INLINE void SLW_NAME(narrow_backward)(const sl_int w, sl_int stride,
                                                              sl_int below, const sl_int *rows,
                                                              const double *l, const double *d,
                                                              double *xs, const double *x) {
    sl_int i = below - 1, lane = (w + i) % SLI_TILE;
    SLW_EACH(SLI_DECLARE, 0)
    SLW_DECLARE(b)
    SLW_EACH(SLI_ZERO_OWN, 0)
    SLW_HIGH(SLI_AHEAD_OWN, -SLI_AHEAD)
    SLW_LOW(SLI_AHEAD_OWN, -SLI_AHEAD)
    for (; i >= 0; lane--, i--) { /* x(j) -= L(i, j) x(i) */
        if (lane < 0) {
            lane = SLI_TILE - 1;
            l -= SLI_TILE * w;
            SLW_HIGH(SLI_AHEAD_OWN, -SLI_AHEAD)
            SLW_LOW(SLI_AHEAD_OWN, -SLI_AHEAD)
        }
        SLW_LOAD(b, x + (ptrdiff_t)rows[i] * stride)
        SLW_HIGH(SLI_ABOVE_OWN, 0)
        SLW_LOW(SLI_ABOVE_OWN, 0)
    }
    if (w == SLI_TILE && below > 0) {
        l -= SLI_TILE * w;
    }
    SLW_EACH(SLI_DIVIDE_OWN, 0)
    SLW_HIGH(SLI_ROW_OWN, 0)
    SLW_LOW(SLI_ROW_OWN, 0)
    SLW_EACH(SLI_STORE_OWN, xs)
}

#define SLI_FORWARD(k) SLW_NAME(narrow_forward)(k, stride, below, rows, l, xs, x)
#define SLI_BACKWARD(k) SLW_NAME(narrow_backward)(k, stride, below, rows, l, d, xs, x)

SLV_FUNCTION static void SLW_NAME(forward_narrow)(sl_int w, sl_int stride, sl_int below,
                                                  const sl_int *rows, const double *l, double *xs,
                                                  double *x){SLI_CASES(SLI_FORWARD)}

SLV_FUNCTION static void SLW_NAME(backward_narrow)(sl_int w, sl_int stride, sl_int below,
                                                   const sl_int *rows, const double *l,
                                                   const double *d, double *xs, const double *x) {
    SLI_CASES(SLI_BACKWARD)
}

#undef SLI_LOAD_OWN
#undef SLI_STORE_OWN
#undef SLI_ZERO_OWN
#undef SLI_AHEAD_OWN
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
/* Registers do not suffice for 8 such rows: half of the lanes, then the other half. */
SLV_FUNCTION SLI_INLINE void SLW_NAME(forward_narrow)(sl_int w, sl_int stride, sl_int below,
                                                      const sl_int *rows, const double *l,
                                                      double *xs, double *x) {
    const sl_int half = SLW_LANES / 2;
    SLW_HALF(forward_narrow)(w, stride, below, rows, l, xs, x);
    SLW_HALF(forward_narrow)(w, stride, below, rows, l, xs + half, x + half);
}

SLV_FUNCTION SLI_INLINE void SLW_NAME(backward_narrow)(sl_int w, sl_int stride, sl_int below,
                                                       const sl_int *rows, const double *l,
                                                       const double *d, double *xs,
                                                       const double *x) {
    const sl_int half = SLW_LANES / 2;
    SLW_HALF(backward_narrow)(w, stride, below, rows, l, d, xs, x);
    SLW_HALF(backward_narrow)(w, stride, below, rows, l, d, xs + half, x + half);
}
#endif

/* The rows of a tile that are not all columns of the supernode, side by side in buf: `inner` of its
 * own, then rows below, then zeros. */
SLV_FUNCTION SLI_INLINE void SLW_NAME(rows_in)(double *buf, sl_int inner, sl_int below,
                                               const sl_int *rows, const double *own,
                                               const double *x) {
    sl_int r;
    SLW_DECLARE(b)
    for (r = 0; r < SLW_ROWS; r++) {
        if (r < inner + below) {
            SLW_LOAD(b, r < inner ? own + (ptrdiff_t)r * SLW_LANES
                                  : x + (ptrdiff_t)rows[r - inner] * SLW_LANES)
        } else {
            SLW_ZERO(b)
        }
        SLW_STORE(buf + (ptrdiff_t)r * SLW_LANES, b)
    }
}

SLV_FUNCTION SLI_INLINE void SLW_NAME(rows_out)(const double *buf, sl_int inner, sl_int below,
                                                const sl_int *rows, double *own, double *x) {
    sl_int r;
    SLW_DECLARE(b)
    for (r = 0; r < SLW_ROWS && r < inner + below; r++) {
        SLW_LOAD(b, buf + (ptrdiff_t)r * SLW_LANES)
        SLW_STORE(r < inner ? own + (ptrdiff_t)r * SLW_LANES
                            : x + (ptrdiff_t)rows[r - inner] * SLW_LANES,
                  b)
    }
}

SLV_FUNCTION static void SLW_NAME(forward)(sl_int count, const sli_step *s, const sl_int *rows,
                                           const double *L, double *x, double *buf) {
    for (; count > 0; rows += s->below, count--, s++) {
        const sl_int w = s->width, height = w + s->below, first = SLI_TILE * s->first_tile;
        const double *tile = L + s->panel + sli_tile_offset(w, s->first_tile);
        double *xs = x + ((ptrdiff_t)s->base - first) * SLW_LANES;
        ptrdiff_t row;
        sl_int j;
#if SLW_ROWS == 8 || defined(SLW_HALF)
        if (w <= SLI_TILE) {
            SLW_NAME(forward_narrow)(w, SLW_LANES, s->below, rows, tile, xs, x);
            continue;
        }
#endif
        for (row = first; row < height; row += SLW_ROWS) {
            const sl_int lane = (sl_int)(row % SLI_TILE), final = (sl_int)(row < w ? row : w);
            const sl_int inner = sli_clamp(w - (sl_int)row, SLW_ROWS);
            const sl_int *places = rows + (row + inner - w);
            double *own = xs + row * SLW_LANES, *p = inner == SLW_ROWS ? own : buf;
            const double *l = tile + SLI_TILE * (ptrdiff_t)first + lane;
            SLW_EACH(SLI_DECLARE, 0)
            SLW_DECLARE(b)
            if (inner < SLW_ROWS) {
                SLW_NAME(rows_in)(buf, inner, height - (sl_int)row - inner, places, own, x);
            }
            SLW_EACH(SLI_LOAD, p)
            for (j = first; j < final; j++, l += SLI_TILE) {
                SLI_PREFETCH(l, SLI_AHEAD);
                SLW_LOAD(b, xs + (ptrdiff_t)j * SLW_LANES)
                SLW_EACH(SLI_APPLY, l)
            }
            if (inner > 0) {
                SLW_EACH(SLI_COLUMN, 0)
            }
            SLW_EACH(SLI_STORE, p)
            if (inner < SLW_ROWS) {
                SLW_NAME(rows_out)(buf, inner, height - (sl_int)row - inner, places, own, x);
            }
            if (lane + SLW_ROWS == SLI_TILE) {
                tile += SLI_TILE * (ptrdiff_t)sli_min(w, (sl_int)row + SLW_ROWS);
            }
        }
    }
}

SLV_FUNCTION static void SLW_NAME(backward)(sl_int count, const sli_step *s, const sl_int *rows_end,
                                            const double *L, const double *D, double *x,
                                            double *buf) {
    for (s += count; count > 0; count--) {
        const sl_int w = (--s)->width, height = w + s->below, first = SLI_TILE * s->first_tile;
        const sl_int padded = SLI_TILE * sli_tiles(height);
        const double *tile = L + s->panel + sli_panel_size(w, s->below), *d = D + s->column - first;
        double *xs = x + ((ptrdiff_t)s->base - first) * SLW_LANES;
        ptrdiff_t row;
        sl_int i, j;
        SLW_DECLARE(b)
        SLW_DECLARE(c)
        rows_end -= s->below;
#if SLW_ROWS == 8 || defined(SLW_HALF)
        if (w <= SLI_TILE) {
            SLW_NAME(backward_narrow)
            (w, SLW_LANES, s->below, rows_end, tile - SLI_TILE * w, d, xs, x);
            continue;
        }
#endif
        for (i = first; i < w; i++) {
            SLW_LOAD(b, xs + (ptrdiff_t)i * SLW_LANES)
            SLW_DIVIDE(b, d[i])
            SLW_STORE(xs + (ptrdiff_t)i * SLW_LANES, b)
        }
        for (row = padded - SLW_ROWS; row >= first; row -= SLW_ROWS) {
            const sl_int lane = (sl_int)(row % SLI_TILE), final = (sl_int)(row < w ? row : w);
            const sl_int inner = sli_clamp(w - (sl_int)row, SLW_ROWS);
            double *own = xs + row * SLW_LANES, *p = inner == SLW_ROWS ? own : buf;
            const double *l;
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
                SLI_PREFETCH(l, -SLI_AHEAD);
                SLW_LOAD(b, xs + (ptrdiff_t)j * SLW_LANES)
                SLW_ZERO(c)
                SLW_HIGH(SLI_GATHER, l)
                SLW_LOW(SLI_GATHER2, l)
                SLW_ADD(b, c)
                SLW_STORE(xs + (ptrdiff_t)j * SLW_LANES, b)
            }
        }
    }
}

#if SLW_LANES == 8
SLV_FUNCTION static void SLW_NAME(products)(sl_int count, const double *y, const double *z,
                                            double *sums) {
    sl_int row, k;
    for (row = 0; row < SLW_LANES; row += SLW_ROWS) {
        const double *l = y + row, *p = z;
        double *s = sums + row * SLW_LANES;
        SLW_EACH(SLI_DECLARE, 0)
        SLW_DECLARE(b)
        SLW_EACH(SLI_LOAD, s)
        for (k = 0; k < count; k++, l += SLW_LANES, p += SLW_LANES) {
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
#undef SLW_NAME
#undef SLW_LANES
#undef SLW_ROWS
#undef SLW_HALF
#undef SLW_EACH
#undef SLW_EACH_AGAIN
#undef SLW_HIGH
#undef SLW_LOW
#undef SLW_DECLARE
#undef SLW_ZERO
#undef SLW_LOAD
#undef SLW_STORE
#undef SLW_ADD
#undef SLW_FNMA
#undef SLW_DIVIDE
/* end src/impl/lanes.inl.h */

/* begin src/impl/tile.inl.h */
/* tile.inl.h: the 8 x 8 unit triangle of a diagonal tile, in scalars: 28 FMAs, a chain of 7 */

#define SLI_X(k, j) r##k = SLV_FNMA1(l[SLI_TILE * j + k], r##j, r##k);  /* r(k) -= L(k, j) r(j) */
#define SLI_XT(j, k) r##j = SLV_FNMA1(l[SLI_TILE * j + k], r##k, r##j); /* r(j) -= L(k, j) r(k) */

/* r := L^-1 r, l the tile's 8 x 8 diagonal part by columns */
SLV_FUNCTION SLI_INLINE void SLV_NAME(tile_forward)(const double *l, double *r) {
    double r0 = r[0], r1 = r[1], r2 = r[2], r3 = r[3], r4 = r[4], r5 = r[5], r6 = r[6], r7 = r[7];
    SLI_X(1, 0)
    SLI_X(2, 0)
    SLI_X(3, 0)
    SLI_X(4, 0) SLI_X(5, 0) SLI_X(6, 0) SLI_X(7, 0) SLI_X(2, 1) SLI_X(3, 1) SLI_X(4, 1) SLI_X(5, 1)
        SLI_X(6, 1) SLI_X(7, 1) SLI_X(3, 2) SLI_X(4, 2) SLI_X(5, 2) SLI_X(6, 2) SLI_X(7, 2)
            SLI_X(4, 3) SLI_X(5, 3) SLI_X(6, 3) SLI_X(7, 3) SLI_X(5, 4) SLI_X(6, 4) SLI_X(7, 4)
                SLI_X(6, 5) SLI_X(7, 5) SLI_X(7, 6) r[1] = r1;
    r[2] = r2;
    r[3] = r3;
    r[4] = r4;
    r[5] = r5;
    r[6] = r6;
    r[7] = r7;
}

/* r := L'^-1 r */
SLV_FUNCTION SLI_INLINE void SLV_NAME(tile_backward)(const double *l, double *r) {
    double r0 = r[0], r1 = r[1], r2 = r[2], r3 = r[3], r4 = r[4], r5 = r[5], r6 = r[6], r7 = r[7];
    SLI_XT(6, 7)
    SLI_XT(5, 7)
    SLI_XT(4, 7)
    SLI_XT(3, 7) SLI_XT(2, 7) SLI_XT(1, 7) SLI_XT(0, 7) SLI_XT(5, 6) SLI_XT(4, 6) SLI_XT(3, 6)
        SLI_XT(2, 6) SLI_XT(1, 6) SLI_XT(0, 6) SLI_XT(4, 5) SLI_XT(3, 5) SLI_XT(2, 5) SLI_XT(1, 5)
            SLI_XT(0, 5) SLI_XT(3, 4) SLI_XT(2, 4) SLI_XT(1, 4) SLI_XT(0, 4) SLI_XT(2, 3)
                SLI_XT(1, 3) SLI_XT(0, 3) SLI_XT(1, 2) SLI_XT(0, 2) SLI_XT(0, 1) r[0] = r0;
    r[1] = r1;
    r[2] = r2;
    r[3] = r3;
    r[4] = r4;
    r[5] = r5;
    r[6] = r6;
}

#undef SLI_X
#undef SLI_XT
/* end src/impl/tile.inl.h */

/* begin src/impl/pairs.inl.h */
/* pairs.inl.h: two interleaved right-hand sides, SIMD along the rows of a tile; words SLV_*, two octets a tile */

/* The 8 rows of a tile column, each twice, times the pair x(j): two octets for one octet of L, so
 * that every number of L is loaded once. e0 and e1 are the pairs of rows 0-3 and 4-7. */
#define SLI_PAIR_AXPY(e, l, p)                                                                     \
    SLV_TWICE_LOW(t0, l)                                                                           \
    SLV_TWICE_HIGH(t1, l)                                                                          \
    SLV_PAIR(b, p)                                                                                 \
    SLV_FNMA(e##0, t0, b)                                                                          \
    SLV_FNMA(e##1, t1, b)

/* L^-1 or L'^-1 of a whole diagonal tile upon 8 pairs: each right-hand side by itself, as there is
 * one. */
#define SLI_PAIR_TILE(solve, l, p)                                                                 \
    {                                                                                              \
        double r[2][SLI_TILE];                                                                     \
        for (k = 0; k < SLI_TILE; k++) {                                                           \
            r[0][k] = (p)[2 * k];                                                                  \
            r[1][k] = (p)[2 * k + 1];                                                              \
        }                                                                                          \
        solve((l), r[0]);                                                                          \
        solve((l), r[1]);                                                                          \
        for (k = 0; k < SLI_TILE; k++) {                                                           \
            (p)[2 * k] = r[0][k];                                                                  \
            (p)[2 * k + 1] = r[1][k];                                                              \
        }                                                                                          \
    }

SLV_FUNCTION static void SLV_NAME(forward2)(sl_int count, const sli_step *s, const sl_int *rows,
                                            const double *L, double *x, double *buf) {
    for (; count > 0; count--, s++) {
        const sl_int w = s->width, height = w + s->below, first = SLI_TILE * s->first_tile;
        const size_t columns = 2 * (size_t)(w - first);
        const double *tile = L + s->panel + sli_tile_offset(w, s->first_tile);
        double *xs = x + 2 * (ptrdiff_t)s->base;
        sl_int row, i, j, k;
        memcpy(buf + 2 * (ptrdiff_t)first, xs, columns * sizeof(double));
        memset(buf + 2 * (ptrdiff_t)w, 0,
               2 * (size_t)(SLI_TILE * sli_tiles(height) - w) * sizeof(double));
        for (row = first; row < height; row += SLI_TILE) {
            const sl_int final = sli_min(row, w), inner = sli_clamp(w - row, SLI_TILE);
            const double *l = tile + SLI_TILE * (ptrdiff_t)first;
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
                 j += 2, l += 2 * SLI_TILE) { /* y(rows) -= L(rows, j) y(j) */
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
                SLI_PAIR_TILE(SLV_NAME(tile_forward), l, p)
            } else {
                for (k = 0; k < inner;
                     k++, l += SLI_TILE) { /* columns inside the tile, one by one */
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

/* Rows of a tile that are final leave their columns' sums: 4 partial sums for each of the pair, in
 * one octet. */
#define SLI_PAIR_DOT(a, l)                                                                         \
    SLV_TWICE_LOW(t0, l)                                                                           \
    SLV_TWICE_HIGH(t1, l)                                                                          \
    SLV_FNMA(a, t0, v0)                                                                            \
    SLV_FNMA(a, t1, v1)

SLV_FUNCTION static void SLV_NAME(backward2)(sl_int count, const sli_step *s,
                                             const sl_int *rows_end, const double *L,
                                             const double *D, double *x, double *buf) {
    for (s += count; count > 0; count--) {
        const sl_int w = (--s)->width, height = w + s->below, first = SLI_TILE * s->first_tile;
        const sl_int padded = SLI_TILE * sli_tiles(height);
        const double *tile = L + s->panel + sli_panel_size(w, s->below), *d = D + s->column - first;
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
            const double *l;
            tile -= SLI_TILE * (ptrdiff_t)sli_min(w, row + SLI_TILE);
            l = tile + SLI_TILE * (ptrdiff_t)row;
            SLV_LOAD(v0, p) /* 0 on the columns: only rows below count here */
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
                SLI_PAIR_TILE(SLV_NAME(tile_backward), l, p)
            } else {
                for (k = inner - 1; k > 0; k--) { /* x(j) -= L(k, j) x(k) */
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
            for (j = sli_min(row, w) - 1; j >= first; j--) { /* x(j) -= L(rows, j)' x(rows) */
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
/* end src/impl/pairs.inl.h */

/* begin src/impl/product.inl.h */
/* product.inl.h: C -= A D B' on tiles, the loop that a factorization spends its time in; words SLV_* */

/* A block of registers holds SLV_COLUMNS columns of one row tile, or of two where an ISA has
 * registers enough: SLV_EACH_COLUMN(op, t) is op(0, t) op(1, t) .. over them. Columns past those of C
 * are computed and dropped: B has all 8 of a tile. */
#define SLI_DECLARE(k, t) SLV_DECLARE(c##t##k)
#define SLI_LOAD(k, t)                                                                             \
    if ((k) < columns) {                                                                           \
        SLV_LOAD(c##t##k, C##t + SLI_TILE * (k))                                                   \
    } else {                                                                                       \
        SLV_ZERO(c##t##k)                                                                          \
    }
#define SLI_STORE(k, t)                                                                            \
    if ((k) < columns) {                                                                           \
        SLV_STORE(C##t + SLI_TILE * (k), c##t##k)                                                  \
    }
#define SLI_UPDATE(k, unused) /* C(rows, k) -= A(rows, j) B(k, j) */                               \
    SLV_BROADCAST(b, B + (k))                                                                      \
    SLV_FNMA(c0##k, a0, b)
#define SLI_UPDATE2(k, unused)                                                                     \
    SLI_UPDATE(k, unused)                                                                          \
    SLV_FNMA(c1##k, a1, b)

/* One row tile. A: [length][8], B: [length][8] from the block's first column on, C: [columns][8]. */
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
/* Two row tiles. */
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

/* B(k, j) d(j) of column tile c's 8 rows, the columns j .. j + length - 1 of the panel. */
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

/* Tiles of the lower triangle, row tiles t0 .. t1-1 and column tiles c0 .. c1-1 (t0 >= c0), lose
 * L D L' over the panel's columns j0 .. j1-1. The target's tile (t, c) stands at tile_offset(target_width, t - target_first)
 * + 64 (c - target_first). Taken in chunks of columns j, so that
 * what a row tile needs stays in the first cache and what the group of column tiles needs in the
 * second. */
SLV_FUNCTION static void SLV_NAME(product)(const double *panel, sl_int w, const double *D,
                                           sl_int t0, sl_int t1, sl_int c0, sl_int c1, sl_int j0,
                                           sl_int j1, double *target, sl_int target_width,
                                           sl_int target_first, double *B) {
    const sl_int tile_size = SLI_TILE * SLI_TILE;
    sl_int j, t, c, k;
    for (j = j0; j < j1; j += SLI_CHUNK) {
        const sl_int length = sli_min(SLI_CHUNK, j1 - j);
        for (c = c0; c < c1; c++) {
            SLV_NAME(pack)
            (panel + sli_tile_offset(w, c) + SLI_TILE * (ptrdiff_t)j, D + j, length,
             B + (ptrdiff_t)(c - c0) * SLI_TILE * length);
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
            if (is_pair && c == t && c < c1) { /* the pair's second tile has a diagonal tile more */
                const ptrdiff_t at = (ptrdiff_t)tile_size * (c - target_first);
                SLV_NAME(block1)
                (A1, B + (ptrdiff_t)(c - c0) * SLI_TILE * length, length, C1 + at,
                 target_width - SLI_TILE * (c - target_first));
            }
#endif
        }
    }
}
/* end src/impl/product.inl.h */

/* begin src/impl/front.inl.h */
/* front.inl.h: a front of the multifrontal factorization: its panel factored, its update matrix made and handed on */

/* l(rows, k) = x(rows, k) / d(k), by the reciprocal where that loses nothing */
#define SLI_SCALE(l, x, k)                                                                         \
    if (by_reciprocal) {                                                                           \
        SLV_BROADCAST(b, reciprocal + (k))                                                         \
        SLV_MULTIPLY(l, x, b)                                                                      \
    } else {                                                                                       \
        SLV_BROADCAST(b, D + (k))                                                                  \
        SLV_DIVIDE(l, x, b)                                                                        \
    }

/* magnitude(rows) += |l d l|, with x = l d */
#define SLI_GAIN(l, x, k)                                                                          \
    SLV_BROADCAST(b, against + (k))                                                                \
    SLV_MULTIPLY(b, l, b)                                                                          \
    SLV_FNMA(m, b, x)

#define SLI_DECLARE(k, unused) SLV_DECLARE(a##k)
#define SLI_LOAD(k, p)                                                                             \
    if ((k) < columns) {                                                                           \
        SLV_LOAD(a##k, (p) + SLI_TILE * (k))                                                       \
    } else {                                                                                       \
        SLV_ZERO(a##k)                                                                             \
    }

/* The diagonal tile, column k: the pivot, then the columns after it lose l(rows) x(column). Here by
 * division, one step shorter than by the reciprocal: all wait for this chain. */
#define SLI_AFTER(i, k)                                                                            \
    if ((i) > (k)) {                                                                               \
        SLV_BROADCAST(b, x + SLI_TILE * (k) + (i))                                                 \
        SLV_FNMA(a##i, l, b)                                                                       \
    }
#define SLI_PIVOT(k, p)                                                                            \
    if ((k) < columns) {                                                                           \
        double d;                                                                                  \
        SLV_STORE(x + SLI_TILE * (k), a##k)                                                        \
        SLV_STORE(sums, m)                                                                         \
        SLV_LANE(b, a##k, k)                                                                       \
        d = x[SLI_TILE * (k) + (k)];                                                               \
        if (rule != NULL) {                                                                        \
            d = sli_pivot_ruled(rule, column + (k), d, sums[k]);                                   \
            SLV_BROADCAST(b, &d)                                                                   \
        }                                                                                          \
        SLV_DIVIDE(l, a##k, b)                                                                     \
        D[k] = d;                                                                                  \
        magnitude[k] = sums[k];                                                                    \
        against[k] = d < 0.0 ? 1.0 : -1.0;                                                         \
        reciprocal[k] = 1.0 / d;                                                                   \
        safe &= fabs(d) > 1e-290 && fabs(d) < 1e290;                                               \
        SLI_GAIN(l, a##k, k)                                                                       \
        SLV_BELOW(l, k)                                                                            \
        SLV_STORE((p) + SLI_TILE * (k), l)                                                         \
        SLI_EACH8_AGAIN(SLI_AFTER, k)                                                              \
    }

/* The tiles below: x(rows, k) -= x(rows, j) L(k, j) for j < k, then l. */
#define SLI_BEFORE(j, k)                                                                           \
    if ((j) < (k)) {                                                                               \
        SLV_BROADCAST(b, p + SLI_TILE * (j) + (k))                                                 \
        SLV_FNMA(a##k, a##j, b)                                                                    \
    }
#define SLI_SOLVE(k, q)                                                                            \
    if ((k) < columns) {                                                                           \
        SLI_EACH8_AGAIN(SLI_BEFORE, k)                                                             \
        SLI_SCALE(l, a##k, k)                                                                      \
        SLI_GAIN(l, a##k, k)                                                                       \
        SLV_STORE((q) + SLI_TILE * (k), l)                                                         \
    }

/* The pivots of column tile c, whose columns before it are done: 8, or fewer in the last one. */
SLV_FUNCTION static void SLV_NAME(pivots_of_tile)(const sli_front *f, sl_int c, double *inverse) {
    const sl_int first = SLI_TILE * c, columns = sli_min(SLI_TILE, f->width - first);
    const sl_int column = f->column + first;
    const sli_pivot_rule *rule = f->rule->replaces ? f->rule : NULL;
    double *p = f->panel + sli_tile_offset(f->width, c) + SLI_TILE * (ptrdiff_t)first;
    double *D = f->D + first, *magnitude = f->magnitude + first;
    double *reciprocal = inverse, *against = inverse + SLI_TILE;
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
    for (t = columns; t < SLI_TILE; t++) { /* rows below that share the last tile of pivots */
        magnitude[t] = sums[t];
    }
    if (!safe) {
        reciprocal[0] = 0.0;
    }
}

/* Column tile c of row tiles t0 .. t1-1, all below its pivots. */
SLV_FUNCTION static void SLV_NAME(rows_of_tile)(const sli_front *f, sl_int c, sl_int t0, sl_int t1,
                                                const double *inverse) {
    const sl_int w = f->width, first = SLI_TILE * c, columns = sli_min(SLI_TILE, w - first);
    const double *p = f->panel + sli_tile_offset(w, c) + SLI_TILE * (ptrdiff_t)first;
    const double *D = f->D + first, *reciprocal = inverse, *against = inverse + SLI_TILE;
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
}

#undef SLI_SCALE
#undef SLI_GAIN
#undef SLI_DECLARE
#undef SLI_LOAD
#undef SLI_AFTER
#undef SLI_PIVOT
#undef SLI_BEFORE
#undef SLI_SOLVE

/* Column tile c of row tiles t0 .. t1-1 before its pivots are applied: the group's columns before it. */
SLV_FUNCTION SLI_INLINE void SLV_NAME(catch_up)(const sli_front *f, sl_int c0, sl_int c, sl_int t0,
                                                sl_int t1, double *B) {
    if (c > c0) {
        SLV_NAME(product)
        (f->panel, f->width, f->D, t0, t1, c, c + 1, SLI_TILE * c0, SLI_TILE * c, f->panel,
         f->width, 0, B);
    }
}

SLV_FUNCTION static void SLV_NAME(pivots)(const sli_front *f, sl_int c0, double *B) {
    const sl_int c1 = sli_min(c0 + SLI_GROUP, sli_tiles(f->width));
    sl_int c;
    if (c0 > 0) {
        SLV_NAME(product)
        (f->panel, f->width, f->D, c0, c1, c0, c1, 0, SLI_TILE * c0, f->panel, f->width, 0, B);
    }
    for (c = c0; c < c1; c++) {
        double *inverse = f->inverse + 2 * SLI_TILE * (ptrdiff_t)(c - c0);
        SLV_NAME(catch_up)(f, c0, c, c, c1, B);
        SLV_NAME(pivots_of_tile)(f, c, inverse);
        SLV_NAME(rows_of_tile)(f, c, c + 1, c1, inverse);
    }
}

SLV_FUNCTION static void SLV_NAME(rows)(const sli_front *f, sl_int c0, sl_int t0, sl_int t1,
                                        double *B) {
    const sl_int c1 = sli_min(c0 + SLI_GROUP, sli_tiles(f->width));
    sl_int c;
    if (c0 > 0) {
        SLV_NAME(product)
        (f->panel, f->width, f->D, t0, t1, c0, c1, 0, SLI_TILE * c0, f->panel, f->width, 0, B);
    }
    for (c = c0; c < c1; c++) {
        SLV_NAME(catch_up)(f, c0, c, t0, t1, B);
        SLV_NAME(rows_of_tile)
        (f, c, t0, t1, f->inverse + 2 * SLI_TILE * (ptrdiff_t)(c - c0));
    }
}

SLV_FUNCTION static void SLV_NAME(update)(const sli_front *f, sl_int c0, sl_int c1, sl_int t0,
                                          sl_int t1, double *B) {
    const sl_int w = f->width, last = sli_min(c1, t1);
    sl_int c;
    for (c = c0; c < last; c += SLI_GROUP) {
        SLV_NAME(product)
        (f->panel, w, f->D, sli_max(t0, c), t1, c, sli_min(c + SLI_GROUP, last), 0, w, f->update,
         SLI_TILE * (t1 - c0), c0, B);
    }
}

/* What a child hands over, row by row of the parent's tiles: the run of the child's rows that fall
 * from one of its tiles into one of the parent's moves as a whole, spread by a mask of lanes, through
 * all columns. What stands above the diagonal moves along and is never read. */
SLV_FUNCTION static void SLV_NAME(assemble)(const sli_front *f, const double *from, sl_int skipped,
                                            const sl_int *places, sl_int columns, sl_int first,
                                            sl_int last) {
    const sl_int w = f->width, whole = w / SLI_TILE;
    sl_int row, end, i;
    for (row = first; row < last; row = end) {
        const sl_int lane = (skipped + row) % SLI_TILE, tile = places[row] / SLI_TILE;
        const double *source = from + sli_triangle_offset((skipped + row) / SLI_TILE) +
                               SLI_TILE * (ptrdiff_t)skipped + lane;
        double *const to[2] = {f->panel, f->update};
        const ptrdiff_t at[2] = {(ptrdiff_t)sli_tile_offset(w, tile),
                                 (ptrdiff_t)sli_triangle_offset(tile - whole) -
                                     SLI_TILE * SLI_TILE * (ptrdiff_t)whole};
        sl_int lanes[SLI_TILE];
        unsigned mask = 0;
        for (end = row; end < last && end - row < SLI_TILE - lane && places[end] / SLI_TILE == tile;
             end++) {
            lanes[end - row] = places[end] % SLI_TILE;
            mask |= 1u << lanes[end - row];
        }
        {
            SLV_SPREAD(mask, lanes, end - row)
            for (i = 0; i < end && i < columns; i++) {
                const int is_below =
                    places[i] >= w; /* the panel or the update matrix, not a branch */
                double *target = to[is_below] + (at[is_below] + SLI_TILE * (ptrdiff_t)places[i]);
                SLV_SPREAD_ADD(target, source + SLI_TILE * (ptrdiff_t)i)
            }
        }
    }
}
/* end src/impl/front.inl.h */

/* begin src/impl/takahashi.inl.h */
/* takahashi.inl.h: a front of the inverse: gathered from the parent's front, completed column group by column group */

/* C(rows, k) -= A(rows, j) B(k, j), one row tile; A and B: [length][8], C: [columns][8]. */
SLV_FUNCTION SLI_INLINE void SLV_NAME(block)(const double *A, const double *B, sl_int length,
                                             double *C, sl_int columns) {
    sl_int k;
    for (k = 0; k < columns; k += SLV_COLUMNS) {
        SLV_NAME(block1)(A, B + k, length, C + SLI_TILE * (ptrdiff_t)k, columns - k);
    }
}

#define SLI_STORE(k, p)                                                                            \
    if ((k) < columns) {                                                                           \
        SLV_STORE((p) + SLI_TILE * (k), a)                                                         \
    }

/* The first columns of a tile := 0. Not as a loop: compilers make rep stos of one, and what reads the tile next waits
 * for it. */
SLV_FUNCTION SLI_INLINE void SLV_NAME(clear)(double *x, sl_int columns) {
    SLV_DECLARE(a)
    SLV_ZERO(a)
    SLI_EACH8(SLI_STORE, x)
}

#undef SLI_STORE

#define SLI_OFFSET(k) offset[k]

/* Z of the rows below, row tiles t0 .. t1-1, out of the parent's front: row and column i of theirs is row and
 * column places[i] there. Lanes of other rows get the numbers of a neighbour, which nothing reads. */
SLV_FUNCTION static void SLV_NAME(gather)(const sli_dual *f, const double *from, sl_int height,
                                          const sl_int *places, sl_int t0, sl_int t1) {
    const sl_int w = f->width, u = f->below;
    sl_int t, i;
    for (t = sli_max(t0, w / SLI_TILE); t < t1 && u > 0; t++) {
        double *to = f->front + sli_square_offset(w + u, t) + SLI_TILE * (ptrdiff_t)w;
        ptrdiff_t offset[SLI_TILE];
        for (i = 0; i < SLI_TILE; i++) {
            const sl_int place = places[sli_clamp(SLI_TILE * t + i - w, u - 1)];
            offset[i] = sli_square_offset(height, place / SLI_TILE) + place % SLI_TILE;
        }
        for (i = 0; i < u; i++) {
            const double *x = from + SLI_TILE * (ptrdiff_t)places[i];
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
#define SLI_BEFORE(j, k)                                                                           \
    if ((j) < (k)) {                                                                               \
        SLV_BROADCAST(b, l + SLI_TILE * (j) + (k))                                                 \
        SLV_FNMA(a##k, a##j, b)                                                                    \
    }
#define SLI_SOLVE(k, unused)                                                                       \
    if ((k) < columns) {                                                                           \
        SLI_EACH8_AGAIN(SLI_BEFORE, k)                                                             \
    }

/* x(rows, k) -= x(rows, j) L(k, j) for j < k in the 8 x 8 unit triangle at l: x := x L'^-1. */
SLV_FUNCTION SLI_INLINE void SLV_NAME(after_triangle)(const double *l, double *x, sl_int columns) {
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

/* N = -L'^-1 of a group of m columns from j0 on, row tiles c0 .. c1-1, row tile c from column 8c on, 0 where it
 * has no row; and P = -N D^-1. */
SLV_FUNCTION SLI_INLINE void SLV_NAME(group_inverse)(const sli_dual *f, sl_int j0, sl_int c0,
                                                     sl_int c1, double *scratch) {
    const sl_int m = sli_dual_columns(f, j0), tiles = sli_tiles(m), tile_size = SLI_TILE * SLI_TILE;
    double *N = scratch + SLI_DUAL_ROW * (ptrdiff_t)c0, *P = N + SLI_DUAL_GROUP * SLI_DUAL_ROW;
    sl_int c, t, k;
    for (c = c0; c < c1; c++, N += SLI_DUAL_ROW, P += SLI_DUAL_ROW) {
        for (t = c; t < tiles; t++) {
            const sl_int columns = sli_min(SLI_TILE, m - SLI_TILE * t);
            const double *l =
                f->panel + sli_tile_offset(f->width, j0 / SLI_TILE + t) + SLI_TILE * (ptrdiff_t)j0;
            double *x = N + tile_size * (ptrdiff_t)t;
            SLV_NAME(clear)(x, SLI_TILE);
            for (k = 0; k < columns && t == c; k++) {
                x[SLI_TILE * k + k] = -1.0;
            }
            if (t > c) { /* N(c, t) -= N(c, c..t-1) L(t, c..t-1)' */
                SLV_NAME(block)
                (N + tile_size * (ptrdiff_t)c, l + tile_size * (ptrdiff_t)c, SLI_TILE * (t - c), x,
                 columns);
            }
            SLV_NAME(after_triangle)(l + tile_size * (ptrdiff_t)t, x, columns);
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

/* W' = (L_SJ L_JJ^-1)', row tiles t0 .. t1-1 of the panel: [column tile][row][8 columns]. */
SLV_FUNCTION SLI_INLINE void SLV_NAME(group_weights)(const sli_dual *f, sl_int j0, sl_int t0,
                                                     sl_int t1, double *scratch) {
    const sl_int m = sli_dual_columns(f, j0), tile_size = SLI_TILE * SLI_TILE;
    const ptrdiff_t stride = sli_dual_stride(f, j0);
    const double *N = scratch;
    double *W = sli_dual_weights(scratch) + tile_size * (ptrdiff_t)(t0 - (j0 + m) / SLI_TILE);
    sl_int c, t;
    for (c = 0; c < sli_tiles(m); c++, N += SLI_DUAL_ROW, W += stride) {
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

/* Z_SJ -= Z_SS W, row tiles t0 .. t1-1, in chunks as in a factorization. */
SLV_FUNCTION SLI_INLINE void SLV_NAME(group_product)(const sli_dual *f, sl_int j0, sl_int t0,
                                                     sl_int t1, double *scratch) {
    const sl_int m = sli_dual_columns(f, j0), h = f->width + f->below, first = j0 + m;
    const ptrdiff_t stride = sli_dual_stride(f, j0), tile_size = SLI_TILE * SLI_TILE;
    const double *W = sli_dual_weights(scratch) + SLI_TILE * (ptrdiff_t)(first % SLI_TILE);
    sl_int t, c, s;
    for (t = t0; t < t1; t++) {
        double *row = f->front + sli_square_offset(h, t) + SLI_TILE * (ptrdiff_t)j0;
        for (c = 0; c < sli_tiles(m); c++) {
            SLV_NAME(clear)(row + tile_size * c, m - SLI_TILE * c);
        }
    }
    for (s = first; s < h; s += SLI_CHUNK) {
        const sl_int length = sli_min(SLI_CHUNK, h - s);
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

/* The first lanes of some columns of a tile at to become those at from: rows below share the others. */
SLV_FUNCTION SLI_INLINE void SLV_NAME(merge)(double *to, const double *from, sl_int lanes,
                                             sl_int first, sl_int last) {
    sl_int k;
    SLV_DECLARE(a)
    SLV_DECLARE(b)
    for (k = first; k < last; k++) {
        SLV_LOAD(a, from + SLI_TILE * k)
        SLV_LOAD(b, to + SLI_TILE * k)
        SLV_FIRST(a, lanes)
        SLV_BELOW(b, lanes - 1)
        SLV_ADD(a, b)
        SLV_STORE(to + SLI_TILE * k, a)
    }
}

/* Lanes first .. last-1 of the first columns of a tile to the columns and lanes of another. */
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

/* Z_JS = Z_SJ', columns of the row tiles t0 .. t1-1. */
SLV_FUNCTION SLI_INLINE void SLV_NAME(group_mirror)(const sli_dual *f, sl_int j0, sl_int t0,
                                                    sl_int t1) {
    const sl_int m = sli_dual_columns(f, j0), h = f->width + f->below;
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

/* Z_JJ = L_JJ'^-1 D^-1 L_JJ^-1 - W' Z_SJ, the lower tiles of the group's row tiles t0 .. t1-1 and what mirrors
 * them. */
SLV_FUNCTION SLI_INLINE void SLV_NAME(group_square)(const sli_dual *f, sl_int j0, sl_int t0,
                                                    sl_int t1, double *scratch) {
    const sl_int m = sli_dual_columns(f, j0), h = f->width + f->below, first = j0 + m;
    const sl_int tile_size = SLI_TILE * SLI_TILE;
    const ptrdiff_t stride = sli_dual_stride(f, j0);
    const double *N = scratch, *P = N + SLI_DUAL_GROUP * SLI_DUAL_ROW,
                 *W = sli_dual_weights(scratch) + SLI_TILE * (ptrdiff_t)(first % SLI_TILE);
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
            (N + SLI_DUAL_ROW * (ptrdiff_t)t + tile_size * (ptrdiff_t)t,
             P + SLI_DUAL_ROW * (ptrdiff_t)c + tile_size * (ptrdiff_t)t, m - SLI_TILE * t, x,
             columns);
            if (first < h) {
                SLV_NAME(block)
                (W + t * stride, column + SLI_TILE * (ptrdiff_t)first, h - first, x, columns);
            }
            SLV_NAME(merge)(row + tile_size * (ptrdiff_t)c, x, rows, 0, columns);
            if (c < t) {
                SLV_NAME(mirror)
                (x, 0, rows, column + SLI_TILE * (ptrdiff_t)j0 + tile_size * (ptrdiff_t)t,
                 SLI_TILE);
            }
        }
    }
}

SLV_FUNCTION static void SLV_NAME(dual)(const sli_dual *f, sl_int j0, sli_dual_part part, sl_int t0,
                                        sl_int t1, double *scratch) {
    switch (part) {
    case SLI_DUAL_INVERSE:
        SLV_NAME(group_inverse)(f, j0, t0, t1, scratch);
        break;
    case SLI_DUAL_WEIGHTS:
        SLV_NAME(group_weights)(f, j0, t0, t1, scratch);
        break;
    case SLI_DUAL_PRODUCT:
        SLV_NAME(group_product)(f, j0, t0, t1, scratch);
        break;
    case SLI_DUAL_MIRROR:
        SLV_NAME(group_mirror)(f, j0, t0, t1);
        break;
    default:
        SLV_NAME(group_square)(f, j0, t0, t1, scratch);
    }
}

/* From the last group of columns to the first, each with the columns after it among its rows below:
 * what a group works upon stays in the caches, whatever the width. */
SLV_FUNCTION static void SLV_NAME(takahashi)(const sli_dual *f, double *scratch) {
    sl_int j0;
    for (j0 = sli_dual_last(f); j0 + SLI_DUAL_COLUMNS > f->first; j0 -= SLI_DUAL_COLUMNS) {
        const sli_span group = sli_dual_span(f, j0, SLI_DUAL_INVERSE);
        const sli_span below = sli_dual_span(f, j0, SLI_DUAL_WEIGHTS);
        SLV_NAME(group_inverse)(f, j0, group.first, group.last, scratch);
        if (below.first < below.last) {
            SLV_NAME(group_weights)(f, j0, below.first, below.last, scratch);
            SLV_NAME(group_product)(f, j0, below.first, below.last, scratch);
            SLV_NAME(group_mirror)(f, j0, below.first, below.last);
        }
        SLV_NAME(group_square)(f, j0, group.first, group.last, scratch);
    }
}
/* end src/impl/takahashi.inl.h */

/* begin src/impl/narrow.inl.h */
/* narrow.inl.h: one right-hand side through a supernode of 1 to 8 columns, all of them in registers; words SLV_* */

/* Most supernodes of a 2D mesh are as narrow as this, and what they cost is not the reading of L but
 * loops that end at once, calls, and vectors loaded where single numbers were just stored. Here the
 * width is a constant that is folded into each of 8 copies: the loops over columns are gone, y or
 * the sums of all columns stay in registers, and x is gathered straight into them. */
#define SLI_DECLARE(k, y) SLV_DECLARE(y##k)
#define SLI_SUM_DECLARE(k, a) SLV_SUM_DECLARE(a##k)
#define SLI_SUM_ZERO(k, a) SLV_SUM_ZERO(a##k)

/* the diagonal tile, column after column; L is 0 above its diagonal */
#define SLI_COLUMN(k, unused)                                                                      \
    if ((k) < w) {                                                                                 \
        SLI_PREFETCH(l + SLI_TILE * (k), SLI_AHEAD);                                               \
        SLV_LANE(y##k, a, k)                                                                       \
        SLV_DOT(a, l + SLI_TILE * (k), y##k)                                                       \
    }
/* a tile below: even columns into one sum, odd ones into another */
#define SLI_EVEN_ODD(k, unused)                                                                    \
    if ((k) < w) {                                                                                 \
        SLI_PREFETCH(l + SLI_TILE * (k), SLI_AHEAD);                                               \
        if ((k) % 2 == 0) {                                                                        \
            SLV_DOT(a, l + SLI_TILE * (k), y##k)                                                   \
        } else {                                                                                   \
            SLV_DOT(b, l + SLI_TILE * (k), y##k)                                                   \
        }                                                                                          \
    }

SLV_FUNCTION SLI_ALWAYS_INLINE void SLV_NAME(narrow_forward)(const sl_int w, sl_int below,
                                                             const sl_int *rows, const double *l,
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
    for (row = SLI_TILE; row < w + below; row += SLI_TILE) { /* y(rows) -= L(rows, j) y(j) */
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

/* x(j) -= L(rows, j)' x(rows), from the last column down as L is read backward in memory */
#define SLI_DOT(k)                                                                                 \
    if ((k) < w) {                                                                                 \
        SLI_PREFETCH(l + SLI_TILE * (k), -SLI_AHEAD);                                              \
        SLV_SUM_DOT(a##k, l + SLI_TILE * (k), v)                                                   \
    }
#define SLI_DOTS                                                                                   \
    SLI_DOT(7) SLI_DOT(6) SLI_DOT(5) SLI_DOT(4) SLI_DOT(3) SLI_DOT(2) SLI_DOT(1) SLI_DOT(0)
/* places of the 8 rows of a tile; of a tile of fewer rows, the last one again; of those that share
 * the tile of the columns, anything for the columns' lanes */
#define SLI_PLACE(k) rows[at + (k)]
#define SLI_PLACE_PART(k) rows[at + sli_min(k, count - 1)]
#define SLI_PLACE_OWN(k) rows[sli_clamp((k)-w, at - 1)]
#define SLI_SET(k, unused) double r##k = r[k];
#define SLI_GET(k, unused)                                                                         \
    if ((k) < w) {                                                                                 \
        xs[k] = r##k;                                                                              \
    }
#define SLI_XT(j, k)                                                                               \
    if ((j) < (k) && (k) < w) { /* r(j) -= L(k, j) r(k) */                                         \
        r##j = SLV_FNMA1(l[SLI_TILE * (j) + (k)], r##k, r##j);                                     \
    }
#define SLI_ROW(k)                                                                                 \
    SLI_XT(6, k) SLI_XT(5, k) SLI_XT(4, k) SLI_XT(3, k) SLI_XT(2, k) SLI_XT(1, k) SLI_XT(0, k)

/* l points at the panel's end. */
SLV_FUNCTION SLI_ALWAYS_INLINE void SLV_NAME(narrow_backward)(const sl_int w, sl_int below,
                                                              const sl_int *rows, const double *l,
                                                              const double *d, double *xs,
                                                              const double *x) {
    const sl_int count = (w + below) % SLI_TILE;
    sl_int row = w + below - count, at = below;
    double r[SLI_TILE];
    SLV_DECLARE(v)
    SLV_DECLARE(z)
    SLI_EACH8(SLI_SUM_DECLARE, a)
    SLI_EACH8(SLI_SUM_ZERO, a)
    if (row > 0 && count > 0) {
        at -= count;
        l -= SLI_TILE * w;
        SLV_GATHER(v, x, SLI_PLACE_PART)
        SLV_FIRST(v, count)
        SLI_DOTS
    }
    for (; row > SLI_TILE; row -= SLI_TILE) {
        at -= SLI_TILE;
        l -= SLI_TILE * w;
        SLV_GATHER(v, x, SLI_PLACE)
        SLI_DOTS
    }
    l -= SLI_TILE * w;
    if (w < SLI_TILE && at > 0) {
        SLV_GATHER(v, x, SLI_PLACE_OWN)
        SLV_FIRST(v, w + at)
        SLV_BELOW(v, w - 1)
        SLI_DOTS
    }
    SLV_LOAD_PART(z, xs, w, 0.0)
    SLV_LOAD_PART(v, d, w, 1.0)
    SLV_DIVIDE(z, z, v)
    SLV_SUMS(v, a)
    SLV_ADD(v, z)
    SLV_STORE_ANY(r, v) {
        SLI_EACH8(SLI_SET, 0)
        SLI_ROW(7)
        SLI_ROW(6) SLI_ROW(5) SLI_ROW(4) SLI_ROW(3) SLI_ROW(2) SLI_ROW(1) SLI_EACH8(SLI_GET, 0)
    }
}

#define SLI_FORWARD(k) SLV_NAME(narrow_forward)(k, below, rows, l, xs, x, buf)
#define SLI_BACKWARD(k) SLV_NAME(narrow_backward)(k, below, rows, l, d, xs, x)

SLV_FUNCTION SLI_INLINE void SLV_NAME(forward_narrow)(sl_int w, sl_int below, const sl_int *rows,
                                                      const double *l, double *xs, double *x,
                                                      double *buf){SLI_CASES(SLI_FORWARD)}

SLV_FUNCTION SLI_INLINE
    void SLV_NAME(backward_narrow)(sl_int w, sl_int below, const sl_int *rows, const double *l,
                                   const double *d, double *xs, const double *x) {
    SLI_CASES(SLI_BACKWARD)
}

#undef SLI_DECLARE
#undef SLI_SUM_DECLARE
#undef SLI_SUM_ZERO
#undef SLI_COLUMN
#undef SLI_EVEN_ODD
#undef SLI_DOT
#undef SLI_DOTS
#undef SLI_PLACE
#undef SLI_PLACE_PART
#undef SLI_PLACE_OWN
#undef SLI_SET
#undef SLI_GET
#undef SLI_XT
#undef SLI_ROW
#undef SLI_FORWARD
#undef SLI_BACKWARD
/* end src/impl/narrow.inl.h */

/* begin src/impl/body.inl.h */
/* body.inl.h: one right-hand side, SIMD along the 8 rows of a tile; the words SLV_* are one octet of doubles */

/* buf := L^-1 buf on the first `rows` local rows of a panel, its columns 8 t0 .. columns-1 applied
 * in ascending order. tile points at tile t0. Four partial sums hide the latency of the FMA; their
 * grouping depends on the column number alone, so that a sweep that starts later, over zeros, gives
 * the same bits. */
SLV_FUNCTION SLI_INLINE void SLV_NAME(panel_forward)(const double *tile, sl_int t0, sl_int width,
                                                     sl_int columns, sl_int rows, double *buf) {
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
        for (j = first; j + 4 <= final; j += 4) { /* y(rows) -= L(rows, j) y(j) */
            const double *l = tile + SLI_TILE * j;
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
            SLV_NAME(tile_forward)(tile + SLI_TILE * row, buf + row);
        } else {
            for (k = 0; k < inner; k++) { /* columns inside the tile, one after the other */
                SLV_AXPY(a0, tile + SLI_TILE * (row + k), buf + row + k)
                SLV_STORE(buf + row, a0)
            }
        }
        tile += SLI_TILE * sli_min(width, row + SLI_TILE);
    }
}

SLV_FUNCTION static void SLV_NAME(forward)(sl_int count, const sli_step *s, const sl_int *rows,
                                           const double *L, double *x, double *buf) {
    for (; count > 0; count--, s++) {
        const sl_int w = s->width, height = w + s->below, first = SLI_TILE * s->first_tile;
        const double *tile = L + s->panel + sli_tile_offset(w, s->first_tile);
        double *xs = x + s->base;
        sl_int i;
        if (w <= SLI_TILE) {
            SLV_NAME(forward_narrow)(w, s->below, rows, tile, xs, x, buf);
            rows += s->below;
            continue;
        }
        memcpy(buf + first, xs, (size_t)(w - first) * sizeof(double));
        for (i = w; i < SLI_TILE * sli_tiles(height); i++) {
            buf[i] = 0.0;
        }
        SLV_NAME(panel_forward)(tile, s->first_tile, w, w, height, buf);
        memcpy(xs, buf + first, (size_t)(w - first) * sizeof(double));
        for (i = 0; i < s->below; i++) {
            x[rows[i]] += buf[w + i];
        }
        rows += s->below;
    }
}

/* The backward pass leaves 8 partial sums a column, or fewer where an octet takes several registers:
 * sums(j) -= L(rows, j)' x(rows) over the columns first .. final-1 of one row tile, or of two at
 * once, which spares half of the loads and stores of the sums. */
#define SLI_DECLARE(k, a) SLV_DECLARE(a##k)
#define SLI_SUM_DECLARE(k, a) SLV_SUM_DECLARE(a##k)
#define SLI_PLACE(k) rows[at + (k)]
#define SLI_PLACE_PART(k) rows[at + sli_clamp((k)-inner, part - 1)]

SLV_FUNCTION SLI_INLINE void SLV_NAME(dots1)(const double *l, const double *x, sl_int first,
                                             sl_int final, double *sums) {
    ptrdiff_t j;
    SLV_DECLARE(v)
    SLV_SUM_DECLARE(a)
    SLV_LOAD(v, x)
    for (j = SLI_TILE * ((ptrdiff_t) final - 1); j >= SLI_TILE * (ptrdiff_t)first; j -= SLI_TILE) {
        SLI_PREFETCH(l + j, -SLI_AHEAD);
        SLV_SUM_LOAD(a, sums + j)
        SLV_SUM_DOT(a, l + j, v)
        SLV_SUM_STORE(sums + j, a)
    }
}

/* Two tiles: l0 and its 8 rows at x, l1 and the 8 rows after those. */
SLV_FUNCTION SLI_INLINE void SLV_NAME(dots2)(const double *l0, const double *l1, const double *x,
                                             sl_int first, sl_int final, double *sums) {
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

/* The diagonal tile of the columns row .. row+inner-1: what the rows below them left is summed, the
 * right side added, the triangle solved. l: the tile's diagonal part. */
#define SLI_TAKE_SUM(k, unused)                                                                    \
    if ((k) < inner) {                                                                             \
        SLV_SUM_LOAD(a##k, sums + SLI_TILE * (k))                                                  \
        if (inner < SLI_TILE) {                                                                    \
            SLV_SUM_DOT(a##k, l + SLI_TILE * (k), v)                                               \
        }                                                                                          \
    } else {                                                                                       \
        SLV_SUM_ZERO(a##k)                                                                         \
    }
SLV_FUNCTION SLI_INLINE void SLV_NAME(diagonal)(const double *l, sl_int inner, const double *sums,
                                                const double *d, double *xs, double *buf) {
    double r[SLI_TILE];
    sl_int j, k;
    SLV_DECLARE(v)
    SLV_DECLARE(z)
    SLI_EACH8(SLI_SUM_DECLARE, a)
    SLV_ZERO(v)
    if (inner < SLI_TILE) { /* buf is 0 on the columns: only rows below count here */
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
        SLV_NAME(tile_backward)(l, r);
    } else {
        for (k = inner - 1; k > 0; k--) { /* x(j) -= L(k, j) x(k) */
            for (j = 0; j < k; j++) {
                r[j] = SLV_FNMA1(l[SLI_TILE * j + k], r[k], r[j]);
            }
        }
    }
    for (k = 0; k < inner; k++) {
        xs[k] = buf[k] = r[k];
    }
}

/* buf: the rows of two tiles; behind them the sums. */
SLV_FUNCTION static void SLV_NAME(backward)(sl_int count, const sli_step *s, const sl_int *rows_end,
                                            const double *L, const double *D, double *x,
                                            double *buf) {
    const int by_two = count <= SLI_FEW_STEPS;
    for (s += count; count > 0; count--) {
        const sl_int w = (--s)->width, height = w + s->below, first = SLI_TILE * s->first_tile;
        const double *d = D + s->column - first, *tile = L + s->panel + sli_panel_size(w, s->below);
        double *xs = x + s->base - first, *sums = buf + 2 * SLI_TILE;
        const sl_int *rows = rows_end -= s->below;
        sl_int row = SLI_TILE * (sli_tiles(height) - 1), j;
        SLV_DECLARE(v)
        SLV_SUM_DECLARE(a)
        if (w <= SLI_TILE) {
            SLV_NAME(backward_narrow)(w, s->below, rows, tile, d, xs, x);
            continue;
        }
        SLV_SUM_ZERO(a)
        for (j = first; j < w; j++) {
            SLV_SUM_STORE(sums + SLI_TILE * (ptrdiff_t)j, a)
        }
        for (; row >= first; row -= SLI_TILE) {
            const sl_int inner = sli_clamp(w - row, SLI_TILE), final = sli_min(row, w);
            const sl_int at = row + inner - w, part = sli_min(height - row, SLI_TILE) - inner;
            const double *above;
            tile -= SLI_TILE * (ptrdiff_t)sli_min(w, row + SLI_TILE);
            above = tile - SLI_TILE * (ptrdiff_t) final;
            if (part == SLI_TILE) {
                SLV_GATHER(v, x, SLI_PLACE)
                SLV_STORE(buf + SLI_TILE, v)
            } else if (inner < SLI_TILE) { /* rows below, between zeros */
                SLV_ZERO(v)
                if (part > 0) {
                    SLV_GATHER(v, x, SLI_PLACE_PART)
                    SLV_FIRST(v, inner + part)
                }
                SLV_STORE(buf + SLI_TILE, v)
                for (j = 0; j < inner; j++) {
                    buf[SLI_TILE + j] = 0.0;
                }
            }
            if (inner > 0) {
                SLV_NAME(diagonal)
                (tile + SLI_TILE * (ptrdiff_t)row, inner, sums + SLI_TILE * (ptrdiff_t)row, d + row,
                 xs + row, buf + SLI_TILE);
            }
            if (!by_two || row == first || (inner == 0 && row - SLI_TILE < w)) {
                SLV_NAME(dots1)(tile, buf + SLI_TILE, first, final, sums);
                continue;
            }
            row -= SLI_TILE;
            if (inner == 0) {
                rows -= SLI_TILE;
                SLV_GATHER(v, x, SLI_PLACE)
                rows += SLI_TILE;
                SLV_STORE(buf, v)
                SLV_NAME(dots2)(above, tile, buf, first, w, sums);
            } else {
                SLV_NAME(dots1)(tile, buf + SLI_TILE, row, final, sums);
                SLV_NAME(diagonal)
                (above + SLI_TILE * (ptrdiff_t)row, SLI_TILE, sums + SLI_TILE * (ptrdiff_t)row,
                 d + row, xs + row, buf);
                SLV_NAME(dots2)(above, tile, buf, first, row, sums);
            }
            tile = above;
        }
    }
}

#undef SLI_DECLARE
#undef SLI_SUM_DECLARE
#undef SLI_PLACE
#undef SLI_PLACE_PART
#undef SLI_TAKE_SUM

SLV_FUNCTION static void SLV_NAME(row)(double *panel, sl_int w, sl_int q, const sl_int *rows,
                                       const double *D, double *xs, double *x, double *buf,
                                       double *pivot, double *magnitude) {
    const sl_int columns = sli_min(q, w);
    double *lq = panel + sli_panel_at(w, q, 0);
    double d = *pivot, size = *magnitude;
    sl_int i;
    for (i = 0; i < columns; i++) { /* y = row of A minus what the descendants sent */
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
    for (i = 0; i < columns; i++) { /* l(k, j) = y(j) / d(j), d(k) -= l(k, j) y(j) */
        const double l = buf[i] / D[i];
        lq[SLI_TILE * i] = l;
        d = SLV_FNMA1(l, buf[i], d);
        size += fabs(l * buf[i]);
    }
    *pivot = d;
    *magnitude = size;
}

static const sli_kernels SLV_NAME(kernels) = {
    SLV_ISA,
    {SLV_NAME(forward), SLV_NAME(forward2), SLV_NAME(forward4), SLV_NAME(forward8)},
    {SLV_NAME(backward), SLV_NAME(backward2), SLV_NAME(backward4), SLV_NAME(backward8)},
    SLV_NAME(row),
    SLV_NAME(pivots),
    SLV_NAME(rows),
    SLV_NAME(update),
    SLV_NAME(assemble),
    SLV_NAME(products8),
    SLV_NAME(gather),
    SLV_NAME(dual),
    SLV_NAME(takahashi)};
/* end src/impl/body.inl.h */

/* begin src/impl/words_end.inl.h */
/* words_end.inl.h: takes the octet words back, for the next instruction set */
#undef SLV_NAME
#undef SLV_ISA
#undef SLV_FUNCTION
#undef SLV_DECLARE
#undef SLV_ZERO
#undef SLV_LOAD
#undef SLV_STORE
#undef SLV_ADD
#undef SLV_AXPY
#undef SLV_DOT
#undef SLV_FNMA1
#undef SLV_STORE_ANY
#undef SLV_FNMA
#undef SLV_TWICE_LOW
#undef SLV_TWICE_HIGH
#undef SLV_TWICE_AT
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
#undef SLV_SPREAD
#undef SLV_SPREAD_ADD
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
/* end src/impl/words_end.inl.h */

#endif

#endif
/* end src/impl/isa_avx512.h */
/* begin src/impl/isa_neon.h */
/* isa_neon.h: the kernels in NEON: an octet is four registers */
#ifndef SLI_ISA_NEON_H
#define SLI_ISA_NEON_H

#if defined(SLI_ARM)

#define SLV_NAME(f) sli_##f##_neon
#define SLV_ISA SL_ISA_NEON
#define SLV_FUNCTION
#define SLV_FNMA1(a, b, c) __builtin_fma(-(a), b, c) /* c - a b */
#define SLV_DECLARE(a) float64x2_t a##_0, a##_1, a##_2, a##_3;
#define SLV_ZERO(a) a##_0 = a##_1 = a##_2 = a##_3 = vdupq_n_f64(0.0);
#define SLV_LOAD(a, p)                                                                             \
    a##_0 = vld1q_f64((p) + 0), a##_1 = vld1q_f64((p) + 2), a##_2 = vld1q_f64((p) + 4),            \
    a##_3 = vld1q_f64((p) + 6);
#define SLV_STORE(p, a)                                                                            \
    vst1q_f64((p) + 0, a##_0), vst1q_f64((p) + 2, a##_1), vst1q_f64((p) + 4, a##_2),               \
        vst1q_f64((p) + 6, a##_3);
#define SLV_ADD(a, b)                                                                              \
    a##_0 = vaddq_f64(a##_0, b##_0), a##_1 = vaddq_f64(a##_1, b##_1),                              \
    a##_2 = vaddq_f64(a##_2, b##_2), a##_3 = vaddq_f64(a##_3, b##_3);
#define SLV_AXPY(a, l, p)                                                                          \
    {                                                                                              \
        const float64x2_t s_ = vld1q_dup_f64(p);                                                   \
        a##_0 = vfmsq_f64(a##_0, vld1q_f64((l) + 0), s_);                                          \
        a##_1 = vfmsq_f64(a##_1, vld1q_f64((l) + 2), s_);                                          \
        a##_2 = vfmsq_f64(a##_2, vld1q_f64((l) + 4), s_);                                          \
        a##_3 = vfmsq_f64(a##_3, vld1q_f64((l) + 6), s_);                                          \
    }
#define SLV_DOT(a, l, v)                                                                           \
    a##_0 = vfmsq_f64(a##_0, vld1q_f64((l) + 0), v##_0),                                           \
    a##_1 = vfmsq_f64(a##_1, vld1q_f64((l) + 2), v##_1),                                           \
    a##_2 = vfmsq_f64(a##_2, vld1q_f64((l) + 4), v##_2),                                           \
    a##_3 = vfmsq_f64(a##_3, vld1q_f64((l) + 6), v##_3);
#define SLV_STORE_ANY(p, a) SLV_STORE(p, a)
#define SLV_FNMA(a, b, c)                                                                          \
    a##_0 = vfmsq_f64(a##_0, b##_0, c##_0), a##_1 = vfmsq_f64(a##_1, b##_1, c##_1),                \
    a##_2 = vfmsq_f64(a##_2, b##_2, c##_2), a##_3 = vfmsq_f64(a##_3, b##_3, c##_3);
#define SLV_LOAD_PART(a, p, count, rest)                                                           \
    {                                                                                              \
        double part_[SLI_TILE];                                                                    \
        sl_int i_;                                                                                 \
        for (i_ = 0; i_ < SLI_TILE; i_++) {                                                        \
            part_[i_] = i_ < (count) ? (p)[i_] : (rest);                                           \
        }                                                                                          \
        SLV_LOAD(a, part_)                                                                         \
    }
#define SLV_FIRST(a, count)                                                                        \
    {                                                                                              \
        double part_[SLI_TILE];                                                                    \
        sl_int i_;                                                                                 \
        SLV_STORE(part_, a)                                                                        \
        for (i_ = (count); i_ < SLI_TILE; i_++) {                                                  \
            part_[i_] = 0.0;                                                                       \
        }                                                                                          \
        SLV_LOAD(a, part_)                                                                         \
    }
#define SLV_LANE(b, a, k)                                                                          \
    b##_0 = b##_1 = b##_2 = b##_3 = vdupq_n_f64(vgetq_lane_f64((k) < 2   ? a##_0                   \
                                                               : (k) < 4 ? a##_1                   \
                                                               : (k) < 6 ? a##_2                   \
                                                                         : a##_3,                  \
                                                               (k) % 2));
#define SLV_GATHER_2(x, i, j) vcombine_f64(vld1_f64((x) + (i)), vld1_f64((x) + (j)))
#define SLV_GATHER(a, x, at)                                                                       \
    a##_0 = SLV_GATHER_2(x, at(0), at(1)), a##_1 = SLV_GATHER_2(x, at(2), at(3)),                  \
    a##_2 = SLV_GATHER_2(x, at(4), at(5)), a##_3 = SLV_GATHER_2(x, at(6), at(7));
#define SLV_SUM_DECLARE(a) float64x2_t a;
#define SLV_SUM_ZERO(a) a = vdupq_n_f64(0.0);
#define SLV_SUM_LOAD(a, p) a = vld1q_f64(p);
#define SLV_SUM_STORE(p, a) vst1q_f64((p), a);
#define SLV_SUM_DOT(a, l, v)                                                                       \
    a = vfmsq_f64(a, vld1q_f64((l) + 0), v##_0);                                                   \
    a = vfmsq_f64(a, vld1q_f64((l) + 2), v##_1);                                                   \
    a = vfmsq_f64(a, vld1q_f64((l) + 4), v##_2);                                                   \
    a = vfmsq_f64(a, vld1q_f64((l) + 6), v##_3);
#define SLV_SUMS(r, a)                                                                             \
    r##_0 = vpaddq_f64(a##0, a##1), r##_1 = vpaddq_f64(a##2, a##3),                                \
    r##_2 = vpaddq_f64(a##4, a##5), r##_3 = vpaddq_f64(a##6, a##7);
#define SLV_TRANSPOSE(to, from)                                                                    \
    {                                                                                              \
        int i_, k_;                                                                                \
        for (i_ = 0; i_ < SLI_TILE; i_ += 2) {                                                     \
            for (k_ = 0; k_ < SLI_TILE; k_ += 2) {                                                 \
                const float64x2_t low_ = vld1q_f64((from) + SLI_TILE * k_ + i_);                   \
                const float64x2_t high_ = vld1q_f64((from) + SLI_TILE * (k_ + 1) + i_);            \
                vst1q_f64((to) + SLI_TILE * i_ + k_, vtrn1q_f64(low_, high_));                     \
                vst1q_f64((to) + SLI_TILE * (i_ + 1) + k_, vtrn2q_f64(low_, high_));               \
            }                                                                                      \
        }                                                                                          \
    }
#define SLV_TILES 1
#define SLV_COLUMNS 4
#define SLV_EACH_COLUMN SLI_EACH4
#define SLV_LOAD_PINNED(a, p) SLV_LOAD(a, p)
#define SLV_BROADCAST(b, p) b##_0 = b##_1 = b##_2 = b##_3 = vld1q_dup_f64(p);
#define SLV_MULTIPLY(a, b, c)                                                                      \
    a##_0 = vmulq_f64(b##_0, c##_0), a##_1 = vmulq_f64(b##_1, c##_1),                              \
    a##_2 = vmulq_f64(b##_2, c##_2), a##_3 = vmulq_f64(b##_3, c##_3);
#define SLV_DIVIDE(a, b, c)                                                                        \
    a##_0 = vdivq_f64(b##_0, c##_0), a##_1 = vdivq_f64(b##_1, c##_1),                              \
    a##_2 = vdivq_f64(b##_2, c##_2), a##_3 = vdivq_f64(b##_3, c##_3);
#define SLV_BELOW_2(a, k)                                                                          \
    a = vreinterpretq_f64_u64(vandq_u64(vreinterpretq_u64_f64(a),                                  \
                                        vcombine_u64(vcreate_u64((k) < 0 ? ~(uint64_t)0 : 0),      \
                                                     vcreate_u64((k) < 1 ? ~(uint64_t)0 : 0))));
#define SLV_BELOW(a, k)                                                                            \
    SLV_BELOW_2(a##_0, k)                                                                          \
    SLV_BELOW_2(a##_1, (k)-2) SLV_BELOW_2(a##_2, (k)-4) SLV_BELOW_2(a##_3, (k)-6)
#define SLV_SPREAD SLI_SPREAD_PLAIN
#define SLV_SPREAD_ADD SLI_SPREAD_ADD_PLAIN
#define SLV_TWICE_LOW(e, l)                                                                        \
    e##_0 = vld1q_dup_f64((l) + 0), e##_1 = vld1q_dup_f64((l) + 1),                                \
    e##_2 = vld1q_dup_f64((l) + 2), e##_3 = vld1q_dup_f64((l) + 3);
#define SLV_TWICE_HIGH(e, l) SLV_TWICE_LOW(e, (l) + 4)
#define SLV_PAIR(b, p) b##_0 = b##_1 = b##_2 = b##_3 = vld1q_f64(p);

#define SLW_NAME(f) sli_##f##4_neon
#define SLW_LANES 4
#define SLW_ROWS 8
#define SLW_DECLARE(a) float64x2_t a##_0, a##_1;
#define SLW_ZERO(a) a##_0 = a##_1 = vdupq_n_f64(0.0);
#define SLW_LOAD(a, p) a##_0 = vld1q_f64((p) + 0), a##_1 = vld1q_f64((p) + 2);
#define SLW_STORE(p, a) vst1q_f64((p) + 0, a##_0), vst1q_f64((p) + 2, a##_1);
#define SLW_FNMA(a, s, b)                                                                          \
    {                                                                                              \
        const float64x2_t s_ = vdupq_n_f64(s);                                                     \
        a##_0 = vfmsq_f64(a##_0, s_, b##_0);                                                       \
        a##_1 = vfmsq_f64(a##_1, s_, b##_1);                                                       \
    }
#define SLW_ADD(a, b) a##_0 = vaddq_f64(a##_0, b##_0), a##_1 = vaddq_f64(a##_1, b##_1);
#define SLW_DIVIDE(a, s)                                                                           \
    {                                                                                              \
        const float64x2_t s_ = vdupq_n_f64(s);                                                     \
        a##_0 = vdivq_f64(a##_0, s_);                                                              \
        a##_1 = vdivq_f64(a##_1, s_);                                                              \
    }
/* begin src/impl/lanes.inl.h */
/* lanes.inl.h: 2, 4 or 8 interleaved right-hand sides, SIMD along them; the words SLW_* are one row of SLW_LANES */

/* SLW_EACH(op, k) is op(0, k) op(1, k) .. for the SLW_ROWS rows that are kept in registers at once,
 * SLW_HIGH and SLW_LOW are its halves from the last row down; a0, a1, .. are their accumulators, b
 * and c one row more each. SLW_EACH_AGAIN is SLW_EACH once more, as a macro does not expand inside
 * itself. */
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
#define SLI_LOAD(r, p) SLW_LOAD(a##r, (p) + (r)*SLW_LANES)
#define SLI_STORE(r, p) SLW_STORE((p) + (r)*SLW_LANES, a##r)
#define SLI_APPLY(r, l) SLW_FNMA(a##r, (l)[r], b)  /* a(r) -= L(r, j) x(j) */
#define SLI_GATHER(r, l) SLW_FNMA(b, (l)[r], a##r) /* x(j) -= L(r, j) x(r), in two chains */
#define SLI_GATHER2(r, l) SLW_FNMA(c, (l)[r], a##r)
/* inside the diagonal block: column k onto the rows below it, and row k onto the columns before it
 */
#define SLI_DOWN(r, k)                                                                             \
    if ((r) > (k)) {                                                                               \
        SLW_FNMA(a##r, l[SLI_TILE * (k) + (r)], a##k)                                              \
    }
#define SLI_UP(j, k)                                                                               \
    if ((j) < (k) && (j) < inner) {                                                                \
        SLW_FNMA(a##j, l[SLI_TILE * (j) + (k)], a##k)                                              \
    }
#define SLI_COLUMN(k, unused)                                                                      \
    if ((k) < inner) {                                                                             \
        SLW_EACH_AGAIN(SLI_DOWN, k)                                                                \
    }
#define SLI_ROW(k, unused) SLW_EACH_AGAIN(SLI_UP, k)

#if SLW_ROWS == 8
/* A supernode of 1 to 8 columns, the width folded in as in narrow.inl.h: the columns' rows stay in
 * registers, and the rows below pass by one after the other. Rows of x are `stride` apart. */
#define SLI_LOAD_OWN(k, p)                                                                         \
    if ((k) < w) {                                                                                 \
        SLW_LOAD(a##k, (p) + (k)*stride)                                                           \
    }
#define SLI_STORE_OWN(k, p)                                                                        \
    if ((k) < w) {                                                                                 \
        SLW_STORE((p) + (k)*stride, a##k)                                                          \
    }
#define SLI_ZERO_OWN(k, unused) SLW_ZERO(a##k)
#define SLI_AHEAD_OWN(k, bytes)                                                                    \
    if ((k) < w) {                                                                                 \
        SLI_PREFETCH(l + SLI_TILE * (k), bytes);                                                   \
    }
#define SLI_DOWN_OWN(r, k)                                                                         \
    if ((r) > (k) && (r) < w) {                                                                    \
        SLW_FNMA(a##r, l[SLI_TILE * (k) + (r)], a##k)                                              \
    }
#define SLI_COLUMN_OWN(k, unused) SLW_EACH_AGAIN(SLI_DOWN_OWN, k)
#define SLI_BELOW_OWN(k, unused)                                                                   \
    if ((k) < w) {                                                                                 \
        SLW_FNMA(b, l[SLI_TILE * (k) + lane], a##k)                                                \
    }

SLV_FUNCTION SLI_ALWAYS_INLINE void SLW_NAME(narrow_forward)(const sl_int w, sl_int stride,
                                                             sl_int below, const sl_int *rows,
                                                             const double *l, double *xs,
                                                             double *x) {
    sl_int lane = w, i;
    SLW_EACH(SLI_DECLARE, 0)
    SLW_DECLARE(b)
    SLW_EACH(SLI_AHEAD_OWN, SLI_AHEAD)
    SLW_EACH(SLI_LOAD_OWN, xs)
    SLW_EACH(SLI_COLUMN_OWN, 0)
    SLW_EACH(SLI_STORE_OWN, xs)
    for (i = 0; i < below; lane++, i++) { /* x(i) -= L(i, j) x(j) */
        double *to = x + (ptrdiff_t)rows[i] * stride;
        if (lane == SLI_TILE) {
            lane = 0;
            l += SLI_TILE * w;
            SLW_EACH(SLI_AHEAD_OWN, SLI_AHEAD)
        }
        SLW_LOAD(b, to)
        SLW_EACH(SLI_BELOW_OWN, 0)
        SLW_STORE(to, b)
    }
}

#define SLI_UP_OWN(j, k)                                                                           \
    if ((j) < (k) && (k) < w) {                                                                    \
        SLW_FNMA(a##j, l[SLI_TILE * (j) + (k)], a##k)                                              \
    }
#define SLI_ROW_OWN(k, unused) SLW_EACH_AGAIN(SLI_UP_OWN, k)
#define SLI_ABOVE_OWN(k, unused)                                                                   \
    if ((k) < w) {                                                                                 \
        SLW_FNMA(a##k, l[SLI_TILE * (k) + lane], b)                                                \
    }
#define SLI_DIVIDE_OWN(k, unused)                                                                  \
    if ((k) < w) {                                                                                 \
        SLW_LOAD(b, xs + (k)*stride)                                                               \
        SLW_DIVIDE(b, d[k])                                                                        \
        SLW_ADD(a##k, b)                                                                           \
    }

/* l points at the panel's last tile. */
SLV_FUNCTION SLI_ALWAYS_INLINE void SLW_NAME(narrow_backward)(const sl_int w, sl_int stride,
                                                              sl_int below, const sl_int *rows,
                                                              const double *l, const double *d,
                                                              double *xs, const double *x) {
    sl_int i = below - 1, lane = (w + i) % SLI_TILE;
    SLW_EACH(SLI_DECLARE, 0)
    SLW_DECLARE(b)
    SLW_EACH(SLI_ZERO_OWN, 0)
    SLW_HIGH(SLI_AHEAD_OWN, -SLI_AHEAD)
    SLW_LOW(SLI_AHEAD_OWN, -SLI_AHEAD)
    for (; i >= 0; lane--, i--) { /* x(j) -= L(i, j) x(i) */
        if (lane < 0) {
            lane = SLI_TILE - 1;
            l -= SLI_TILE * w;
            SLW_HIGH(SLI_AHEAD_OWN, -SLI_AHEAD)
            SLW_LOW(SLI_AHEAD_OWN, -SLI_AHEAD)
        }
        SLW_LOAD(b, x + (ptrdiff_t)rows[i] * stride)
        SLW_HIGH(SLI_ABOVE_OWN, 0)
        SLW_LOW(SLI_ABOVE_OWN, 0)
    }
    if (w == SLI_TILE && below > 0) {
        l -= SLI_TILE * w;
    }
    SLW_EACH(SLI_DIVIDE_OWN, 0)
    SLW_HIGH(SLI_ROW_OWN, 0)
    SLW_LOW(SLI_ROW_OWN, 0)
    SLW_EACH(SLI_STORE_OWN, xs)
}

#define SLI_FORWARD(k) SLW_NAME(narrow_forward)(k, stride, below, rows, l, xs, x)
#define SLI_BACKWARD(k) SLW_NAME(narrow_backward)(k, stride, below, rows, l, d, xs, x)

SLV_FUNCTION static void SLW_NAME(forward_narrow)(sl_int w, sl_int stride, sl_int below,
                                                  const sl_int *rows, const double *l, double *xs,
                                                  double *x){SLI_CASES(SLI_FORWARD)}

SLV_FUNCTION static void SLW_NAME(backward_narrow)(sl_int w, sl_int stride, sl_int below,
                                                   const sl_int *rows, const double *l,
                                                   const double *d, double *xs, const double *x) {
    SLI_CASES(SLI_BACKWARD)
}

#undef SLI_LOAD_OWN
#undef SLI_STORE_OWN
#undef SLI_ZERO_OWN
#undef SLI_AHEAD_OWN
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
/* Registers do not suffice for 8 such rows: half of the lanes, then the other half. */
SLV_FUNCTION SLI_INLINE void SLW_NAME(forward_narrow)(sl_int w, sl_int stride, sl_int below,
                                                      const sl_int *rows, const double *l,
                                                      double *xs, double *x) {
    const sl_int half = SLW_LANES / 2;
    SLW_HALF(forward_narrow)(w, stride, below, rows, l, xs, x);
    SLW_HALF(forward_narrow)(w, stride, below, rows, l, xs + half, x + half);
}

SLV_FUNCTION SLI_INLINE void SLW_NAME(backward_narrow)(sl_int w, sl_int stride, sl_int below,
                                                       const sl_int *rows, const double *l,
                                                       const double *d, double *xs,
                                                       const double *x) {
    const sl_int half = SLW_LANES / 2;
    SLW_HALF(backward_narrow)(w, stride, below, rows, l, d, xs, x);
    SLW_HALF(backward_narrow)(w, stride, below, rows, l, d, xs + half, x + half);
}
#endif

/* The rows of a tile that are not all columns of the supernode, side by side in buf: `inner` of its
 * own, then rows below, then zeros. */
SLV_FUNCTION SLI_INLINE void SLW_NAME(rows_in)(double *buf, sl_int inner, sl_int below,
                                               const sl_int *rows, const double *own,
                                               const double *x) {
    sl_int r;
    SLW_DECLARE(b)
    for (r = 0; r < SLW_ROWS; r++) {
        if (r < inner + below) {
            SLW_LOAD(b, r < inner ? own + (ptrdiff_t)r * SLW_LANES
                                  : x + (ptrdiff_t)rows[r - inner] * SLW_LANES)
        } else {
            SLW_ZERO(b)
        }
        SLW_STORE(buf + (ptrdiff_t)r * SLW_LANES, b)
    }
}

SLV_FUNCTION SLI_INLINE void SLW_NAME(rows_out)(const double *buf, sl_int inner, sl_int below,
                                                const sl_int *rows, double *own, double *x) {
    sl_int r;
    SLW_DECLARE(b)
    for (r = 0; r < SLW_ROWS && r < inner + below; r++) {
        SLW_LOAD(b, buf + (ptrdiff_t)r * SLW_LANES)
        SLW_STORE(r < inner ? own + (ptrdiff_t)r * SLW_LANES
                            : x + (ptrdiff_t)rows[r - inner] * SLW_LANES,
                  b)
    }
}

SLV_FUNCTION static void SLW_NAME(forward)(sl_int count, const sli_step *s, const sl_int *rows,
                                           const double *L, double *x, double *buf) {
    for (; count > 0; rows += s->below, count--, s++) {
        const sl_int w = s->width, height = w + s->below, first = SLI_TILE * s->first_tile;
        const double *tile = L + s->panel + sli_tile_offset(w, s->first_tile);
        double *xs = x + ((ptrdiff_t)s->base - first) * SLW_LANES;
        ptrdiff_t row;
        sl_int j;
#if SLW_ROWS == 8 || defined(SLW_HALF)
        if (w <= SLI_TILE) {
            SLW_NAME(forward_narrow)(w, SLW_LANES, s->below, rows, tile, xs, x);
            continue;
        }
#endif
        for (row = first; row < height; row += SLW_ROWS) {
            const sl_int lane = (sl_int)(row % SLI_TILE), final = (sl_int)(row < w ? row : w);
            const sl_int inner = sli_clamp(w - (sl_int)row, SLW_ROWS);
            const sl_int *places = rows + (row + inner - w);
            double *own = xs + row * SLW_LANES, *p = inner == SLW_ROWS ? own : buf;
            const double *l = tile + SLI_TILE * (ptrdiff_t)first + lane;
            SLW_EACH(SLI_DECLARE, 0)
            SLW_DECLARE(b)
            if (inner < SLW_ROWS) {
                SLW_NAME(rows_in)(buf, inner, height - (sl_int)row - inner, places, own, x);
            }
            SLW_EACH(SLI_LOAD, p)
            for (j = first; j < final; j++, l += SLI_TILE) {
                SLI_PREFETCH(l, SLI_AHEAD);
                SLW_LOAD(b, xs + (ptrdiff_t)j * SLW_LANES)
                SLW_EACH(SLI_APPLY, l)
            }
            if (inner > 0) {
                SLW_EACH(SLI_COLUMN, 0)
            }
            SLW_EACH(SLI_STORE, p)
            if (inner < SLW_ROWS) {
                SLW_NAME(rows_out)(buf, inner, height - (sl_int)row - inner, places, own, x);
            }
            if (lane + SLW_ROWS == SLI_TILE) {
                tile += SLI_TILE * (ptrdiff_t)sli_min(w, (sl_int)row + SLW_ROWS);
            }
        }
    }
}

SLV_FUNCTION static void SLW_NAME(backward)(sl_int count, const sli_step *s, const sl_int *rows_end,
                                            const double *L, const double *D, double *x,
                                            double *buf) {
    for (s += count; count > 0; count--) {
        const sl_int w = (--s)->width, height = w + s->below, first = SLI_TILE * s->first_tile;
        const sl_int padded = SLI_TILE * sli_tiles(height);
        const double *tile = L + s->panel + sli_panel_size(w, s->below), *d = D + s->column - first;
        double *xs = x + ((ptrdiff_t)s->base - first) * SLW_LANES;
        ptrdiff_t row;
        sl_int i, j;
        SLW_DECLARE(b)
        SLW_DECLARE(c)
        rows_end -= s->below;
#if SLW_ROWS == 8 || defined(SLW_HALF)
        if (w <= SLI_TILE) {
            SLW_NAME(backward_narrow)
            (w, SLW_LANES, s->below, rows_end, tile - SLI_TILE * w, d, xs, x);
            continue;
        }
#endif
        for (i = first; i < w; i++) {
            SLW_LOAD(b, xs + (ptrdiff_t)i * SLW_LANES)
            SLW_DIVIDE(b, d[i])
            SLW_STORE(xs + (ptrdiff_t)i * SLW_LANES, b)
        }
        for (row = padded - SLW_ROWS; row >= first; row -= SLW_ROWS) {
            const sl_int lane = (sl_int)(row % SLI_TILE), final = (sl_int)(row < w ? row : w);
            const sl_int inner = sli_clamp(w - (sl_int)row, SLW_ROWS);
            double *own = xs + row * SLW_LANES, *p = inner == SLW_ROWS ? own : buf;
            const double *l;
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
                SLI_PREFETCH(l, -SLI_AHEAD);
                SLW_LOAD(b, xs + (ptrdiff_t)j * SLW_LANES)
                SLW_ZERO(c)
                SLW_HIGH(SLI_GATHER, l)
                SLW_LOW(SLI_GATHER2, l)
                SLW_ADD(b, c)
                SLW_STORE(xs + (ptrdiff_t)j * SLW_LANES, b)
            }
        }
    }
}

#if SLW_LANES == 8
SLV_FUNCTION static void SLW_NAME(products)(sl_int count, const double *y, const double *z,
                                            double *sums) {
    sl_int row, k;
    for (row = 0; row < SLW_LANES; row += SLW_ROWS) {
        const double *l = y + row, *p = z;
        double *s = sums + row * SLW_LANES;
        SLW_EACH(SLI_DECLARE, 0)
        SLW_DECLARE(b)
        SLW_EACH(SLI_LOAD, s)
        for (k = 0; k < count; k++, l += SLW_LANES, p += SLW_LANES) {
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
#undef SLW_NAME
#undef SLW_LANES
#undef SLW_ROWS
#undef SLW_HALF
#undef SLW_EACH
#undef SLW_EACH_AGAIN
#undef SLW_HIGH
#undef SLW_LOW
#undef SLW_DECLARE
#undef SLW_ZERO
#undef SLW_LOAD
#undef SLW_STORE
#undef SLW_ADD
#undef SLW_FNMA
#undef SLW_DIVIDE
/* end src/impl/lanes.inl.h */

#define SLW_NAME(f) sli_##f##8_neon
#define SLW_HALF(f) sli_##f##4_neon
#define SLW_LANES 8
#define SLW_ROWS 4
#define SLW_DECLARE(a) float64x2_t a##_0, a##_1, a##_2, a##_3;
#define SLW_ZERO(a) a##_0 = a##_1 = a##_2 = a##_3 = vdupq_n_f64(0.0);
#define SLW_LOAD(a, p)                                                                             \
    a##_0 = vld1q_f64((p) + 0), a##_1 = vld1q_f64((p) + 2), a##_2 = vld1q_f64((p) + 4),            \
    a##_3 = vld1q_f64((p) + 6);
#define SLW_STORE(p, a)                                                                            \
    vst1q_f64((p) + 0, a##_0), vst1q_f64((p) + 2, a##_1), vst1q_f64((p) + 4, a##_2),               \
        vst1q_f64((p) + 6, a##_3);
#define SLW_FNMA(a, s, b)                                                                          \
    {                                                                                              \
        const float64x2_t s_ = vdupq_n_f64(s);                                                     \
        a##_0 = vfmsq_f64(a##_0, s_, b##_0);                                                       \
        a##_1 = vfmsq_f64(a##_1, s_, b##_1);                                                       \
        a##_2 = vfmsq_f64(a##_2, s_, b##_2);                                                       \
        a##_3 = vfmsq_f64(a##_3, s_, b##_3);                                                       \
    }
#define SLW_ADD(a, b)                                                                              \
    a##_0 = vaddq_f64(a##_0, b##_0), a##_1 = vaddq_f64(a##_1, b##_1),                              \
    a##_2 = vaddq_f64(a##_2, b##_2), a##_3 = vaddq_f64(a##_3, b##_3);
#define SLW_DIVIDE(a, s)                                                                           \
    {                                                                                              \
        const float64x2_t s_ = vdupq_n_f64(s);                                                     \
        a##_0 = vdivq_f64(a##_0, s_);                                                              \
        a##_1 = vdivq_f64(a##_1, s_);                                                              \
        a##_2 = vdivq_f64(a##_2, s_);                                                              \
        a##_3 = vdivq_f64(a##_3, s_);                                                              \
    }
/* begin src/impl/lanes.inl.h */
/* lanes.inl.h: 2, 4 or 8 interleaved right-hand sides, SIMD along them; the words SLW_* are one row of SLW_LANES */

/* SLW_EACH(op, k) is op(0, k) op(1, k) .. for the SLW_ROWS rows that are kept in registers at once,
 * SLW_HIGH and SLW_LOW are its halves from the last row down; a0, a1, .. are their accumulators, b
 * and c one row more each. SLW_EACH_AGAIN is SLW_EACH once more, as a macro does not expand inside
 * itself. */
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
#define SLI_LOAD(r, p) SLW_LOAD(a##r, (p) + (r)*SLW_LANES)
#define SLI_STORE(r, p) SLW_STORE((p) + (r)*SLW_LANES, a##r)
#define SLI_APPLY(r, l) SLW_FNMA(a##r, (l)[r], b)  /* a(r) -= L(r, j) x(j) */
#define SLI_GATHER(r, l) SLW_FNMA(b, (l)[r], a##r) /* x(j) -= L(r, j) x(r), in two chains */
#define SLI_GATHER2(r, l) SLW_FNMA(c, (l)[r], a##r)
/* inside the diagonal block: column k onto the rows below it, and row k onto the columns before it
 */
#define SLI_DOWN(r, k)                                                                             \
    if ((r) > (k)) {                                                                               \
        SLW_FNMA(a##r, l[SLI_TILE * (k) + (r)], a##k)                                              \
    }
#define SLI_UP(j, k)                                                                               \
    if ((j) < (k) && (j) < inner) {                                                                \
        SLW_FNMA(a##j, l[SLI_TILE * (j) + (k)], a##k)                                              \
    }
#define SLI_COLUMN(k, unused)                                                                      \
    if ((k) < inner) {                                                                             \
        SLW_EACH_AGAIN(SLI_DOWN, k)                                                                \
    }
#define SLI_ROW(k, unused) SLW_EACH_AGAIN(SLI_UP, k)

#if SLW_ROWS == 8
/* A supernode of 1 to 8 columns, the width folded in as in narrow.inl.h: the columns' rows stay in
 * registers, and the rows below pass by one after the other. Rows of x are `stride` apart. */
#define SLI_LOAD_OWN(k, p)                                                                         \
    if ((k) < w) {                                                                                 \
        SLW_LOAD(a##k, (p) + (k)*stride)                                                           \
    }
#define SLI_STORE_OWN(k, p)                                                                        \
    if ((k) < w) {                                                                                 \
        SLW_STORE((p) + (k)*stride, a##k)                                                          \
    }
#define SLI_ZERO_OWN(k, unused) SLW_ZERO(a##k)
#define SLI_AHEAD_OWN(k, bytes)                                                                    \
    if ((k) < w) {                                                                                 \
        SLI_PREFETCH(l + SLI_TILE * (k), bytes);                                                   \
    }
#define SLI_DOWN_OWN(r, k)                                                                         \
    if ((r) > (k) && (r) < w) {                                                                    \
        SLW_FNMA(a##r, l[SLI_TILE * (k) + (r)], a##k)                                              \
    }
#define SLI_COLUMN_OWN(k, unused) SLW_EACH_AGAIN(SLI_DOWN_OWN, k)
#define SLI_BELOW_OWN(k, unused)                                                                   \
    if ((k) < w) {                                                                                 \
        SLW_FNMA(b, l[SLI_TILE * (k) + lane], a##k)                                                \
    }

SLV_FUNCTION SLI_ALWAYS_INLINE void SLW_NAME(narrow_forward)(const sl_int w, sl_int stride,
                                                             sl_int below, const sl_int *rows,
                                                             const double *l, double *xs,
                                                             double *x) {
    sl_int lane = w, i;
    SLW_EACH(SLI_DECLARE, 0)
    SLW_DECLARE(b)
    SLW_EACH(SLI_AHEAD_OWN, SLI_AHEAD)
    SLW_EACH(SLI_LOAD_OWN, xs)
    SLW_EACH(SLI_COLUMN_OWN, 0)
    SLW_EACH(SLI_STORE_OWN, xs)
    for (i = 0; i < below; lane++, i++) { /* x(i) -= L(i, j) x(j) */
        double *to = x + (ptrdiff_t)rows[i] * stride;
        if (lane == SLI_TILE) {
            lane = 0;
            l += SLI_TILE * w;
            SLW_EACH(SLI_AHEAD_OWN, SLI_AHEAD)
        }
        SLW_LOAD(b, to)
        SLW_EACH(SLI_BELOW_OWN, 0)
        SLW_STORE(to, b)
    }
}

#define SLI_UP_OWN(j, k)                                                                           \
    if ((j) < (k) && (k) < w) {                                                                    \
        SLW_FNMA(a##j, l[SLI_TILE * (j) + (k)], a##k)                                              \
    }
#define SLI_ROW_OWN(k, unused) SLW_EACH_AGAIN(SLI_UP_OWN, k)
#define SLI_ABOVE_OWN(k, unused)                                                                   \
    if ((k) < w) {                                                                                 \
        SLW_FNMA(a##k, l[SLI_TILE * (k) + lane], b)                                                \
    }
#define SLI_DIVIDE_OWN(k, unused)                                                                  \
    if ((k) < w) {                                                                                 \
        SLW_LOAD(b, xs + (k)*stride)                                                               \
        SLW_DIVIDE(b, d[k])                                                                        \
        SLW_ADD(a##k, b)                                                                           \
    }

/* l points at the panel's last tile. */
SLV_FUNCTION SLI_ALWAYS_INLINE void SLW_NAME(narrow_backward)(const sl_int w, sl_int stride,
                                                              sl_int below, const sl_int *rows,
                                                              const double *l, const double *d,
                                                              double *xs, const double *x) {
    sl_int i = below - 1, lane = (w + i) % SLI_TILE;
    SLW_EACH(SLI_DECLARE, 0)
    SLW_DECLARE(b)
    SLW_EACH(SLI_ZERO_OWN, 0)
    SLW_HIGH(SLI_AHEAD_OWN, -SLI_AHEAD)
    SLW_LOW(SLI_AHEAD_OWN, -SLI_AHEAD)
    for (; i >= 0; lane--, i--) { /* x(j) -= L(i, j) x(i) */
        if (lane < 0) {
            lane = SLI_TILE - 1;
            l -= SLI_TILE * w;
            SLW_HIGH(SLI_AHEAD_OWN, -SLI_AHEAD)
            SLW_LOW(SLI_AHEAD_OWN, -SLI_AHEAD)
        }
        SLW_LOAD(b, x + (ptrdiff_t)rows[i] * stride)
        SLW_HIGH(SLI_ABOVE_OWN, 0)
        SLW_LOW(SLI_ABOVE_OWN, 0)
    }
    if (w == SLI_TILE && below > 0) {
        l -= SLI_TILE * w;
    }
    SLW_EACH(SLI_DIVIDE_OWN, 0)
    SLW_HIGH(SLI_ROW_OWN, 0)
    SLW_LOW(SLI_ROW_OWN, 0)
    SLW_EACH(SLI_STORE_OWN, xs)
}

#define SLI_FORWARD(k) SLW_NAME(narrow_forward)(k, stride, below, rows, l, xs, x)
#define SLI_BACKWARD(k) SLW_NAME(narrow_backward)(k, stride, below, rows, l, d, xs, x)

SLV_FUNCTION static void SLW_NAME(forward_narrow)(sl_int w, sl_int stride, sl_int below,
                                                  const sl_int *rows, const double *l, double *xs,
                                                  double *x){SLI_CASES(SLI_FORWARD)}

SLV_FUNCTION static void SLW_NAME(backward_narrow)(sl_int w, sl_int stride, sl_int below,
                                                   const sl_int *rows, const double *l,
                                                   const double *d, double *xs, const double *x) {
    SLI_CASES(SLI_BACKWARD)
}

#undef SLI_LOAD_OWN
#undef SLI_STORE_OWN
#undef SLI_ZERO_OWN
#undef SLI_AHEAD_OWN
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
/* Registers do not suffice for 8 such rows: half of the lanes, then the other half. */
SLV_FUNCTION SLI_INLINE void SLW_NAME(forward_narrow)(sl_int w, sl_int stride, sl_int below,
                                                      const sl_int *rows, const double *l,
                                                      double *xs, double *x) {
    const sl_int half = SLW_LANES / 2;
    SLW_HALF(forward_narrow)(w, stride, below, rows, l, xs, x);
    SLW_HALF(forward_narrow)(w, stride, below, rows, l, xs + half, x + half);
}

SLV_FUNCTION SLI_INLINE void SLW_NAME(backward_narrow)(sl_int w, sl_int stride, sl_int below,
                                                       const sl_int *rows, const double *l,
                                                       const double *d, double *xs,
                                                       const double *x) {
    const sl_int half = SLW_LANES / 2;
    SLW_HALF(backward_narrow)(w, stride, below, rows, l, d, xs, x);
    SLW_HALF(backward_narrow)(w, stride, below, rows, l, d, xs + half, x + half);
}
#endif

/* The rows of a tile that are not all columns of the supernode, side by side in buf: `inner` of its
 * own, then rows below, then zeros. */
SLV_FUNCTION SLI_INLINE void SLW_NAME(rows_in)(double *buf, sl_int inner, sl_int below,
                                               const sl_int *rows, const double *own,
                                               const double *x) {
    sl_int r;
    SLW_DECLARE(b)
    for (r = 0; r < SLW_ROWS; r++) {
        if (r < inner + below) {
            SLW_LOAD(b, r < inner ? own + (ptrdiff_t)r * SLW_LANES
                                  : x + (ptrdiff_t)rows[r - inner] * SLW_LANES)
        } else {
            SLW_ZERO(b)
        }
        SLW_STORE(buf + (ptrdiff_t)r * SLW_LANES, b)
    }
}

SLV_FUNCTION SLI_INLINE void SLW_NAME(rows_out)(const double *buf, sl_int inner, sl_int below,
                                                const sl_int *rows, double *own, double *x) {
    sl_int r;
    SLW_DECLARE(b)
    for (r = 0; r < SLW_ROWS && r < inner + below; r++) {
        SLW_LOAD(b, buf + (ptrdiff_t)r * SLW_LANES)
        SLW_STORE(r < inner ? own + (ptrdiff_t)r * SLW_LANES
                            : x + (ptrdiff_t)rows[r - inner] * SLW_LANES,
                  b)
    }
}

SLV_FUNCTION static void SLW_NAME(forward)(sl_int count, const sli_step *s, const sl_int *rows,
                                           const double *L, double *x, double *buf) {
    for (; count > 0; rows += s->below, count--, s++) {
        const sl_int w = s->width, height = w + s->below, first = SLI_TILE * s->first_tile;
        const double *tile = L + s->panel + sli_tile_offset(w, s->first_tile);
        double *xs = x + ((ptrdiff_t)s->base - first) * SLW_LANES;
        ptrdiff_t row;
        sl_int j;
#if SLW_ROWS == 8 || defined(SLW_HALF)
        if (w <= SLI_TILE) {
            SLW_NAME(forward_narrow)(w, SLW_LANES, s->below, rows, tile, xs, x);
            continue;
        }
#endif
        for (row = first; row < height; row += SLW_ROWS) {
            const sl_int lane = (sl_int)(row % SLI_TILE), final = (sl_int)(row < w ? row : w);
            const sl_int inner = sli_clamp(w - (sl_int)row, SLW_ROWS);
            const sl_int *places = rows + (row + inner - w);
            double *own = xs + row * SLW_LANES, *p = inner == SLW_ROWS ? own : buf;
            const double *l = tile + SLI_TILE * (ptrdiff_t)first + lane;
            SLW_EACH(SLI_DECLARE, 0)
            SLW_DECLARE(b)
            if (inner < SLW_ROWS) {
                SLW_NAME(rows_in)(buf, inner, height - (sl_int)row - inner, places, own, x);
            }
            SLW_EACH(SLI_LOAD, p)
            for (j = first; j < final; j++, l += SLI_TILE) {
                SLI_PREFETCH(l, SLI_AHEAD);
                SLW_LOAD(b, xs + (ptrdiff_t)j * SLW_LANES)
                SLW_EACH(SLI_APPLY, l)
            }
            if (inner > 0) {
                SLW_EACH(SLI_COLUMN, 0)
            }
            SLW_EACH(SLI_STORE, p)
            if (inner < SLW_ROWS) {
                SLW_NAME(rows_out)(buf, inner, height - (sl_int)row - inner, places, own, x);
            }
            if (lane + SLW_ROWS == SLI_TILE) {
                tile += SLI_TILE * (ptrdiff_t)sli_min(w, (sl_int)row + SLW_ROWS);
            }
        }
    }
}

SLV_FUNCTION static void SLW_NAME(backward)(sl_int count, const sli_step *s, const sl_int *rows_end,
                                            const double *L, const double *D, double *x,
                                            double *buf) {
    for (s += count; count > 0; count--) {
        const sl_int w = (--s)->width, height = w + s->below, first = SLI_TILE * s->first_tile;
        const sl_int padded = SLI_TILE * sli_tiles(height);
        const double *tile = L + s->panel + sli_panel_size(w, s->below), *d = D + s->column - first;
        double *xs = x + ((ptrdiff_t)s->base - first) * SLW_LANES;
        ptrdiff_t row;
        sl_int i, j;
        SLW_DECLARE(b)
        SLW_DECLARE(c)
        rows_end -= s->below;
#if SLW_ROWS == 8 || defined(SLW_HALF)
        if (w <= SLI_TILE) {
            SLW_NAME(backward_narrow)
            (w, SLW_LANES, s->below, rows_end, tile - SLI_TILE * w, d, xs, x);
            continue;
        }
#endif
        for (i = first; i < w; i++) {
            SLW_LOAD(b, xs + (ptrdiff_t)i * SLW_LANES)
            SLW_DIVIDE(b, d[i])
            SLW_STORE(xs + (ptrdiff_t)i * SLW_LANES, b)
        }
        for (row = padded - SLW_ROWS; row >= first; row -= SLW_ROWS) {
            const sl_int lane = (sl_int)(row % SLI_TILE), final = (sl_int)(row < w ? row : w);
            const sl_int inner = sli_clamp(w - (sl_int)row, SLW_ROWS);
            double *own = xs + row * SLW_LANES, *p = inner == SLW_ROWS ? own : buf;
            const double *l;
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
                SLI_PREFETCH(l, -SLI_AHEAD);
                SLW_LOAD(b, xs + (ptrdiff_t)j * SLW_LANES)
                SLW_ZERO(c)
                SLW_HIGH(SLI_GATHER, l)
                SLW_LOW(SLI_GATHER2, l)
                SLW_ADD(b, c)
                SLW_STORE(xs + (ptrdiff_t)j * SLW_LANES, b)
            }
        }
    }
}

#if SLW_LANES == 8
SLV_FUNCTION static void SLW_NAME(products)(sl_int count, const double *y, const double *z,
                                            double *sums) {
    sl_int row, k;
    for (row = 0; row < SLW_LANES; row += SLW_ROWS) {
        const double *l = y + row, *p = z;
        double *s = sums + row * SLW_LANES;
        SLW_EACH(SLI_DECLARE, 0)
        SLW_DECLARE(b)
        SLW_EACH(SLI_LOAD, s)
        for (k = 0; k < count; k++, l += SLW_LANES, p += SLW_LANES) {
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
#undef SLW_NAME
#undef SLW_LANES
#undef SLW_ROWS
#undef SLW_HALF
#undef SLW_EACH
#undef SLW_EACH_AGAIN
#undef SLW_HIGH
#undef SLW_LOW
#undef SLW_DECLARE
#undef SLW_ZERO
#undef SLW_LOAD
#undef SLW_STORE
#undef SLW_ADD
#undef SLW_FNMA
#undef SLW_DIVIDE
/* end src/impl/lanes.inl.h */

/* begin src/impl/tile.inl.h */
/* tile.inl.h: the 8 x 8 unit triangle of a diagonal tile, in scalars: 28 FMAs, a chain of 7 */

#define SLI_X(k, j) r##k = SLV_FNMA1(l[SLI_TILE * j + k], r##j, r##k);  /* r(k) -= L(k, j) r(j) */
#define SLI_XT(j, k) r##j = SLV_FNMA1(l[SLI_TILE * j + k], r##k, r##j); /* r(j) -= L(k, j) r(k) */

/* r := L^-1 r, l the tile's 8 x 8 diagonal part by columns */
SLV_FUNCTION SLI_INLINE void SLV_NAME(tile_forward)(const double *l, double *r) {
    double r0 = r[0], r1 = r[1], r2 = r[2], r3 = r[3], r4 = r[4], r5 = r[5], r6 = r[6], r7 = r[7];
    SLI_X(1, 0)
    SLI_X(2, 0)
    SLI_X(3, 0)
    SLI_X(4, 0) SLI_X(5, 0) SLI_X(6, 0) SLI_X(7, 0) SLI_X(2, 1) SLI_X(3, 1) SLI_X(4, 1) SLI_X(5, 1)
        SLI_X(6, 1) SLI_X(7, 1) SLI_X(3, 2) SLI_X(4, 2) SLI_X(5, 2) SLI_X(6, 2) SLI_X(7, 2)
            SLI_X(4, 3) SLI_X(5, 3) SLI_X(6, 3) SLI_X(7, 3) SLI_X(5, 4) SLI_X(6, 4) SLI_X(7, 4)
                SLI_X(6, 5) SLI_X(7, 5) SLI_X(7, 6) r[1] = r1;
    r[2] = r2;
    r[3] = r3;
    r[4] = r4;
    r[5] = r5;
    r[6] = r6;
    r[7] = r7;
}

/* r := L'^-1 r */
SLV_FUNCTION SLI_INLINE void SLV_NAME(tile_backward)(const double *l, double *r) {
    double r0 = r[0], r1 = r[1], r2 = r[2], r3 = r[3], r4 = r[4], r5 = r[5], r6 = r[6], r7 = r[7];
    SLI_XT(6, 7)
    SLI_XT(5, 7)
    SLI_XT(4, 7)
    SLI_XT(3, 7) SLI_XT(2, 7) SLI_XT(1, 7) SLI_XT(0, 7) SLI_XT(5, 6) SLI_XT(4, 6) SLI_XT(3, 6)
        SLI_XT(2, 6) SLI_XT(1, 6) SLI_XT(0, 6) SLI_XT(4, 5) SLI_XT(3, 5) SLI_XT(2, 5) SLI_XT(1, 5)
            SLI_XT(0, 5) SLI_XT(3, 4) SLI_XT(2, 4) SLI_XT(1, 4) SLI_XT(0, 4) SLI_XT(2, 3)
                SLI_XT(1, 3) SLI_XT(0, 3) SLI_XT(1, 2) SLI_XT(0, 2) SLI_XT(0, 1) r[0] = r0;
    r[1] = r1;
    r[2] = r2;
    r[3] = r3;
    r[4] = r4;
    r[5] = r5;
    r[6] = r6;
}

#undef SLI_X
#undef SLI_XT
/* end src/impl/tile.inl.h */

/* begin src/impl/pairs.inl.h */
/* pairs.inl.h: two interleaved right-hand sides, SIMD along the rows of a tile; words SLV_*, two octets a tile */

/* The 8 rows of a tile column, each twice, times the pair x(j): two octets for one octet of L, so
 * that every number of L is loaded once. e0 and e1 are the pairs of rows 0-3 and 4-7. */
#define SLI_PAIR_AXPY(e, l, p)                                                                     \
    SLV_TWICE_LOW(t0, l)                                                                           \
    SLV_TWICE_HIGH(t1, l)                                                                          \
    SLV_PAIR(b, p)                                                                                 \
    SLV_FNMA(e##0, t0, b)                                                                          \
    SLV_FNMA(e##1, t1, b)

/* L^-1 or L'^-1 of a whole diagonal tile upon 8 pairs: each right-hand side by itself, as there is
 * one. */
#define SLI_PAIR_TILE(solve, l, p)                                                                 \
    {                                                                                              \
        double r[2][SLI_TILE];                                                                     \
        for (k = 0; k < SLI_TILE; k++) {                                                           \
            r[0][k] = (p)[2 * k];                                                                  \
            r[1][k] = (p)[2 * k + 1];                                                              \
        }                                                                                          \
        solve((l), r[0]);                                                                          \
        solve((l), r[1]);                                                                          \
        for (k = 0; k < SLI_TILE; k++) {                                                           \
            (p)[2 * k] = r[0][k];                                                                  \
            (p)[2 * k + 1] = r[1][k];                                                              \
        }                                                                                          \
    }

SLV_FUNCTION static void SLV_NAME(forward2)(sl_int count, const sli_step *s, const sl_int *rows,
                                            const double *L, double *x, double *buf) {
    for (; count > 0; count--, s++) {
        const sl_int w = s->width, height = w + s->below, first = SLI_TILE * s->first_tile;
        const size_t columns = 2 * (size_t)(w - first);
        const double *tile = L + s->panel + sli_tile_offset(w, s->first_tile);
        double *xs = x + 2 * (ptrdiff_t)s->base;
        sl_int row, i, j, k;
        memcpy(buf + 2 * (ptrdiff_t)first, xs, columns * sizeof(double));
        memset(buf + 2 * (ptrdiff_t)w, 0,
               2 * (size_t)(SLI_TILE * sli_tiles(height) - w) * sizeof(double));
        for (row = first; row < height; row += SLI_TILE) {
            const sl_int final = sli_min(row, w), inner = sli_clamp(w - row, SLI_TILE);
            const double *l = tile + SLI_TILE * (ptrdiff_t)first;
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
                 j += 2, l += 2 * SLI_TILE) { /* y(rows) -= L(rows, j) y(j) */
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
                SLI_PAIR_TILE(SLV_NAME(tile_forward), l, p)
            } else {
                for (k = 0; k < inner;
                     k++, l += SLI_TILE) { /* columns inside the tile, one by one */
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

/* Rows of a tile that are final leave their columns' sums: 4 partial sums for each of the pair, in
 * one octet. */
#define SLI_PAIR_DOT(a, l)                                                                         \
    SLV_TWICE_LOW(t0, l)                                                                           \
    SLV_TWICE_HIGH(t1, l)                                                                          \
    SLV_FNMA(a, t0, v0)                                                                            \
    SLV_FNMA(a, t1, v1)

SLV_FUNCTION static void SLV_NAME(backward2)(sl_int count, const sli_step *s,
                                             const sl_int *rows_end, const double *L,
                                             const double *D, double *x, double *buf) {
    for (s += count; count > 0; count--) {
        const sl_int w = (--s)->width, height = w + s->below, first = SLI_TILE * s->first_tile;
        const sl_int padded = SLI_TILE * sli_tiles(height);
        const double *tile = L + s->panel + sli_panel_size(w, s->below), *d = D + s->column - first;
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
            const double *l;
            tile -= SLI_TILE * (ptrdiff_t)sli_min(w, row + SLI_TILE);
            l = tile + SLI_TILE * (ptrdiff_t)row;
            SLV_LOAD(v0, p) /* 0 on the columns: only rows below count here */
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
                SLI_PAIR_TILE(SLV_NAME(tile_backward), l, p)
            } else {
                for (k = inner - 1; k > 0; k--) { /* x(j) -= L(k, j) x(k) */
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
            for (j = sli_min(row, w) - 1; j >= first; j--) { /* x(j) -= L(rows, j)' x(rows) */
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
/* end src/impl/pairs.inl.h */

/* begin src/impl/product.inl.h */
/* product.inl.h: C -= A D B' on tiles, the loop that a factorization spends its time in; words SLV_* */

/* A block of registers holds SLV_COLUMNS columns of one row tile, or of two where an ISA has
 * registers enough: SLV_EACH_COLUMN(op, t) is op(0, t) op(1, t) .. over them. Columns past those of C
 * are computed and dropped: B has all 8 of a tile. */
#define SLI_DECLARE(k, t) SLV_DECLARE(c##t##k)
#define SLI_LOAD(k, t)                                                                             \
    if ((k) < columns) {                                                                           \
        SLV_LOAD(c##t##k, C##t + SLI_TILE * (k))                                                   \
    } else {                                                                                       \
        SLV_ZERO(c##t##k)                                                                          \
    }
#define SLI_STORE(k, t)                                                                            \
    if ((k) < columns) {                                                                           \
        SLV_STORE(C##t + SLI_TILE * (k), c##t##k)                                                  \
    }
#define SLI_UPDATE(k, unused) /* C(rows, k) -= A(rows, j) B(k, j) */                               \
    SLV_BROADCAST(b, B + (k))                                                                      \
    SLV_FNMA(c0##k, a0, b)
#define SLI_UPDATE2(k, unused)                                                                     \
    SLI_UPDATE(k, unused)                                                                          \
    SLV_FNMA(c1##k, a1, b)

/* One row tile. A: [length][8], B: [length][8] from the block's first column on, C: [columns][8]. */
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
/* Two row tiles. */
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

/* B(k, j) d(j) of column tile c's 8 rows, the columns j .. j + length - 1 of the panel. */
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

/* Tiles of the lower triangle, row tiles t0 .. t1-1 and column tiles c0 .. c1-1 (t0 >= c0), lose
 * L D L' over the panel's columns j0 .. j1-1. The target's tile (t, c) stands at tile_offset(target_width, t - target_first)
 * + 64 (c - target_first). Taken in chunks of columns j, so that
 * what a row tile needs stays in the first cache and what the group of column tiles needs in the
 * second. */
SLV_FUNCTION static void SLV_NAME(product)(const double *panel, sl_int w, const double *D,
                                           sl_int t0, sl_int t1, sl_int c0, sl_int c1, sl_int j0,
                                           sl_int j1, double *target, sl_int target_width,
                                           sl_int target_first, double *B) {
    const sl_int tile_size = SLI_TILE * SLI_TILE;
    sl_int j, t, c, k;
    for (j = j0; j < j1; j += SLI_CHUNK) {
        const sl_int length = sli_min(SLI_CHUNK, j1 - j);
        for (c = c0; c < c1; c++) {
            SLV_NAME(pack)
            (panel + sli_tile_offset(w, c) + SLI_TILE * (ptrdiff_t)j, D + j, length,
             B + (ptrdiff_t)(c - c0) * SLI_TILE * length);
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
            if (is_pair && c == t && c < c1) { /* the pair's second tile has a diagonal tile more */
                const ptrdiff_t at = (ptrdiff_t)tile_size * (c - target_first);
                SLV_NAME(block1)
                (A1, B + (ptrdiff_t)(c - c0) * SLI_TILE * length, length, C1 + at,
                 target_width - SLI_TILE * (c - target_first));
            }
#endif
        }
    }
}
/* end src/impl/product.inl.h */

/* begin src/impl/front.inl.h */
/* front.inl.h: a front of the multifrontal factorization: its panel factored, its update matrix made and handed on */

/* l(rows, k) = x(rows, k) / d(k), by the reciprocal where that loses nothing */
#define SLI_SCALE(l, x, k)                                                                         \
    if (by_reciprocal) {                                                                           \
        SLV_BROADCAST(b, reciprocal + (k))                                                         \
        SLV_MULTIPLY(l, x, b)                                                                      \
    } else {                                                                                       \
        SLV_BROADCAST(b, D + (k))                                                                  \
        SLV_DIVIDE(l, x, b)                                                                        \
    }

/* magnitude(rows) += |l d l|, with x = l d */
#define SLI_GAIN(l, x, k)                                                                          \
    SLV_BROADCAST(b, against + (k))                                                                \
    SLV_MULTIPLY(b, l, b)                                                                          \
    SLV_FNMA(m, b, x)

#define SLI_DECLARE(k, unused) SLV_DECLARE(a##k)
#define SLI_LOAD(k, p)                                                                             \
    if ((k) < columns) {                                                                           \
        SLV_LOAD(a##k, (p) + SLI_TILE * (k))                                                       \
    } else {                                                                                       \
        SLV_ZERO(a##k)                                                                             \
    }

/* The diagonal tile, column k: the pivot, then the columns after it lose l(rows) x(column). Here by
 * division, one step shorter than by the reciprocal: all wait for this chain. */
#define SLI_AFTER(i, k)                                                                            \
    if ((i) > (k)) {                                                                               \
        SLV_BROADCAST(b, x + SLI_TILE * (k) + (i))                                                 \
        SLV_FNMA(a##i, l, b)                                                                       \
    }
#define SLI_PIVOT(k, p)                                                                            \
    if ((k) < columns) {                                                                           \
        double d;                                                                                  \
        SLV_STORE(x + SLI_TILE * (k), a##k)                                                        \
        SLV_STORE(sums, m)                                                                         \
        SLV_LANE(b, a##k, k)                                                                       \
        d = x[SLI_TILE * (k) + (k)];                                                               \
        if (rule != NULL) {                                                                        \
            d = sli_pivot_ruled(rule, column + (k), d, sums[k]);                                   \
            SLV_BROADCAST(b, &d)                                                                   \
        }                                                                                          \
        SLV_DIVIDE(l, a##k, b)                                                                     \
        D[k] = d;                                                                                  \
        magnitude[k] = sums[k];                                                                    \
        against[k] = d < 0.0 ? 1.0 : -1.0;                                                         \
        reciprocal[k] = 1.0 / d;                                                                   \
        safe &= fabs(d) > 1e-290 && fabs(d) < 1e290;                                               \
        SLI_GAIN(l, a##k, k)                                                                       \
        SLV_BELOW(l, k)                                                                            \
        SLV_STORE((p) + SLI_TILE * (k), l)                                                         \
        SLI_EACH8_AGAIN(SLI_AFTER, k)                                                              \
    }

/* The tiles below: x(rows, k) -= x(rows, j) L(k, j) for j < k, then l. */
#define SLI_BEFORE(j, k)                                                                           \
    if ((j) < (k)) {                                                                               \
        SLV_BROADCAST(b, p + SLI_TILE * (j) + (k))                                                 \
        SLV_FNMA(a##k, a##j, b)                                                                    \
    }
#define SLI_SOLVE(k, q)                                                                            \
    if ((k) < columns) {                                                                           \
        SLI_EACH8_AGAIN(SLI_BEFORE, k)                                                             \
        SLI_SCALE(l, a##k, k)                                                                      \
        SLI_GAIN(l, a##k, k)                                                                       \
        SLV_STORE((q) + SLI_TILE * (k), l)                                                         \
    }

/* The pivots of column tile c, whose columns before it are done: 8, or fewer in the last one. */
SLV_FUNCTION static void SLV_NAME(pivots_of_tile)(const sli_front *f, sl_int c, double *inverse) {
    const sl_int first = SLI_TILE * c, columns = sli_min(SLI_TILE, f->width - first);
    const sl_int column = f->column + first;
    const sli_pivot_rule *rule = f->rule->replaces ? f->rule : NULL;
    double *p = f->panel + sli_tile_offset(f->width, c) + SLI_TILE * (ptrdiff_t)first;
    double *D = f->D + first, *magnitude = f->magnitude + first;
    double *reciprocal = inverse, *against = inverse + SLI_TILE;
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
    for (t = columns; t < SLI_TILE; t++) { /* rows below that share the last tile of pivots */
        magnitude[t] = sums[t];
    }
    if (!safe) {
        reciprocal[0] = 0.0;
    }
}

/* Column tile c of row tiles t0 .. t1-1, all below its pivots. */
SLV_FUNCTION static void SLV_NAME(rows_of_tile)(const sli_front *f, sl_int c, sl_int t0, sl_int t1,
                                                const double *inverse) {
    const sl_int w = f->width, first = SLI_TILE * c, columns = sli_min(SLI_TILE, w - first);
    const double *p = f->panel + sli_tile_offset(w, c) + SLI_TILE * (ptrdiff_t)first;
    const double *D = f->D + first, *reciprocal = inverse, *against = inverse + SLI_TILE;
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
}

#undef SLI_SCALE
#undef SLI_GAIN
#undef SLI_DECLARE
#undef SLI_LOAD
#undef SLI_AFTER
#undef SLI_PIVOT
#undef SLI_BEFORE
#undef SLI_SOLVE

/* Column tile c of row tiles t0 .. t1-1 before its pivots are applied: the group's columns before it. */
SLV_FUNCTION SLI_INLINE void SLV_NAME(catch_up)(const sli_front *f, sl_int c0, sl_int c, sl_int t0,
                                                sl_int t1, double *B) {
    if (c > c0) {
        SLV_NAME(product)
        (f->panel, f->width, f->D, t0, t1, c, c + 1, SLI_TILE * c0, SLI_TILE * c, f->panel,
         f->width, 0, B);
    }
}

SLV_FUNCTION static void SLV_NAME(pivots)(const sli_front *f, sl_int c0, double *B) {
    const sl_int c1 = sli_min(c0 + SLI_GROUP, sli_tiles(f->width));
    sl_int c;
    if (c0 > 0) {
        SLV_NAME(product)
        (f->panel, f->width, f->D, c0, c1, c0, c1, 0, SLI_TILE * c0, f->panel, f->width, 0, B);
    }
    for (c = c0; c < c1; c++) {
        double *inverse = f->inverse + 2 * SLI_TILE * (ptrdiff_t)(c - c0);
        SLV_NAME(catch_up)(f, c0, c, c, c1, B);
        SLV_NAME(pivots_of_tile)(f, c, inverse);
        SLV_NAME(rows_of_tile)(f, c, c + 1, c1, inverse);
    }
}

SLV_FUNCTION static void SLV_NAME(rows)(const sli_front *f, sl_int c0, sl_int t0, sl_int t1,
                                        double *B) {
    const sl_int c1 = sli_min(c0 + SLI_GROUP, sli_tiles(f->width));
    sl_int c;
    if (c0 > 0) {
        SLV_NAME(product)
        (f->panel, f->width, f->D, t0, t1, c0, c1, 0, SLI_TILE * c0, f->panel, f->width, 0, B);
    }
    for (c = c0; c < c1; c++) {
        SLV_NAME(catch_up)(f, c0, c, t0, t1, B);
        SLV_NAME(rows_of_tile)
        (f, c, t0, t1, f->inverse + 2 * SLI_TILE * (ptrdiff_t)(c - c0));
    }
}

SLV_FUNCTION static void SLV_NAME(update)(const sli_front *f, sl_int c0, sl_int c1, sl_int t0,
                                          sl_int t1, double *B) {
    const sl_int w = f->width, last = sli_min(c1, t1);
    sl_int c;
    for (c = c0; c < last; c += SLI_GROUP) {
        SLV_NAME(product)
        (f->panel, w, f->D, sli_max(t0, c), t1, c, sli_min(c + SLI_GROUP, last), 0, w, f->update,
         SLI_TILE * (t1 - c0), c0, B);
    }
}

/* What a child hands over, row by row of the parent's tiles: the run of the child's rows that fall
 * from one of its tiles into one of the parent's moves as a whole, spread by a mask of lanes, through
 * all columns. What stands above the diagonal moves along and is never read. */
SLV_FUNCTION static void SLV_NAME(assemble)(const sli_front *f, const double *from, sl_int skipped,
                                            const sl_int *places, sl_int columns, sl_int first,
                                            sl_int last) {
    const sl_int w = f->width, whole = w / SLI_TILE;
    sl_int row, end, i;
    for (row = first; row < last; row = end) {
        const sl_int lane = (skipped + row) % SLI_TILE, tile = places[row] / SLI_TILE;
        const double *source = from + sli_triangle_offset((skipped + row) / SLI_TILE) +
                               SLI_TILE * (ptrdiff_t)skipped + lane;
        double *const to[2] = {f->panel, f->update};
        const ptrdiff_t at[2] = {(ptrdiff_t)sli_tile_offset(w, tile),
                                 (ptrdiff_t)sli_triangle_offset(tile - whole) -
                                     SLI_TILE * SLI_TILE * (ptrdiff_t)whole};
        sl_int lanes[SLI_TILE];
        unsigned mask = 0;
        for (end = row; end < last && end - row < SLI_TILE - lane && places[end] / SLI_TILE == tile;
             end++) {
            lanes[end - row] = places[end] % SLI_TILE;
            mask |= 1u << lanes[end - row];
        }
        {
            SLV_SPREAD(mask, lanes, end - row)
            for (i = 0; i < end && i < columns; i++) {
                const int is_below =
                    places[i] >= w; /* the panel or the update matrix, not a branch */
                double *target = to[is_below] + (at[is_below] + SLI_TILE * (ptrdiff_t)places[i]);
                SLV_SPREAD_ADD(target, source + SLI_TILE * (ptrdiff_t)i)
            }
        }
    }
}
/* end src/impl/front.inl.h */

/* begin src/impl/takahashi.inl.h */
/* takahashi.inl.h: a front of the inverse: gathered from the parent's front, completed column group by column group */

/* C(rows, k) -= A(rows, j) B(k, j), one row tile; A and B: [length][8], C: [columns][8]. */
SLV_FUNCTION SLI_INLINE void SLV_NAME(block)(const double *A, const double *B, sl_int length,
                                             double *C, sl_int columns) {
    sl_int k;
    for (k = 0; k < columns; k += SLV_COLUMNS) {
        SLV_NAME(block1)(A, B + k, length, C + SLI_TILE * (ptrdiff_t)k, columns - k);
    }
}

#define SLI_STORE(k, p)                                                                            \
    if ((k) < columns) {                                                                           \
        SLV_STORE((p) + SLI_TILE * (k), a)                                                         \
    }

/* The first columns of a tile := 0. Not as a loop: compilers make rep stos of one, and what reads the tile next waits
 * for it. */
SLV_FUNCTION SLI_INLINE void SLV_NAME(clear)(double *x, sl_int columns) {
    SLV_DECLARE(a)
    SLV_ZERO(a)
    SLI_EACH8(SLI_STORE, x)
}

#undef SLI_STORE

#define SLI_OFFSET(k) offset[k]

/* Z of the rows below, row tiles t0 .. t1-1, out of the parent's front: row and column i of theirs is row and
 * column places[i] there. Lanes of other rows get the numbers of a neighbour, which nothing reads. */
SLV_FUNCTION static void SLV_NAME(gather)(const sli_dual *f, const double *from, sl_int height,
                                          const sl_int *places, sl_int t0, sl_int t1) {
    const sl_int w = f->width, u = f->below;
    sl_int t, i;
    for (t = sli_max(t0, w / SLI_TILE); t < t1 && u > 0; t++) {
        double *to = f->front + sli_square_offset(w + u, t) + SLI_TILE * (ptrdiff_t)w;
        ptrdiff_t offset[SLI_TILE];
        for (i = 0; i < SLI_TILE; i++) {
            const sl_int place = places[sli_clamp(SLI_TILE * t + i - w, u - 1)];
            offset[i] = sli_square_offset(height, place / SLI_TILE) + place % SLI_TILE;
        }
        for (i = 0; i < u; i++) {
            const double *x = from + SLI_TILE * (ptrdiff_t)places[i];
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
#define SLI_BEFORE(j, k)                                                                           \
    if ((j) < (k)) {                                                                               \
        SLV_BROADCAST(b, l + SLI_TILE * (j) + (k))                                                 \
        SLV_FNMA(a##k, a##j, b)                                                                    \
    }
#define SLI_SOLVE(k, unused)                                                                       \
    if ((k) < columns) {                                                                           \
        SLI_EACH8_AGAIN(SLI_BEFORE, k)                                                             \
    }

/* x(rows, k) -= x(rows, j) L(k, j) for j < k in the 8 x 8 unit triangle at l: x := x L'^-1. */
SLV_FUNCTION SLI_INLINE void SLV_NAME(after_triangle)(const double *l, double *x, sl_int columns) {
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

/* N = -L'^-1 of a group of m columns from j0 on, row tiles c0 .. c1-1, row tile c from column 8c on, 0 where it
 * has no row; and P = -N D^-1. */
SLV_FUNCTION SLI_INLINE void SLV_NAME(group_inverse)(const sli_dual *f, sl_int j0, sl_int c0,
                                                     sl_int c1, double *scratch) {
    const sl_int m = sli_dual_columns(f, j0), tiles = sli_tiles(m), tile_size = SLI_TILE * SLI_TILE;
    double *N = scratch + SLI_DUAL_ROW * (ptrdiff_t)c0, *P = N + SLI_DUAL_GROUP * SLI_DUAL_ROW;
    sl_int c, t, k;
    for (c = c0; c < c1; c++, N += SLI_DUAL_ROW, P += SLI_DUAL_ROW) {
        for (t = c; t < tiles; t++) {
            const sl_int columns = sli_min(SLI_TILE, m - SLI_TILE * t);
            const double *l =
                f->panel + sli_tile_offset(f->width, j0 / SLI_TILE + t) + SLI_TILE * (ptrdiff_t)j0;
            double *x = N + tile_size * (ptrdiff_t)t;
            SLV_NAME(clear)(x, SLI_TILE);
            for (k = 0; k < columns && t == c; k++) {
                x[SLI_TILE * k + k] = -1.0;
            }
            if (t > c) { /* N(c, t) -= N(c, c..t-1) L(t, c..t-1)' */
                SLV_NAME(block)
                (N + tile_size * (ptrdiff_t)c, l + tile_size * (ptrdiff_t)c, SLI_TILE * (t - c), x,
                 columns);
            }
            SLV_NAME(after_triangle)(l + tile_size * (ptrdiff_t)t, x, columns);
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

/* W' = (L_SJ L_JJ^-1)', row tiles t0 .. t1-1 of the panel: [column tile][row][8 columns]. */
SLV_FUNCTION SLI_INLINE void SLV_NAME(group_weights)(const sli_dual *f, sl_int j0, sl_int t0,
                                                     sl_int t1, double *scratch) {
    const sl_int m = sli_dual_columns(f, j0), tile_size = SLI_TILE * SLI_TILE;
    const ptrdiff_t stride = sli_dual_stride(f, j0);
    const double *N = scratch;
    double *W = sli_dual_weights(scratch) + tile_size * (ptrdiff_t)(t0 - (j0 + m) / SLI_TILE);
    sl_int c, t;
    for (c = 0; c < sli_tiles(m); c++, N += SLI_DUAL_ROW, W += stride) {
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

/* Z_SJ -= Z_SS W, row tiles t0 .. t1-1, in chunks as in a factorization. */
SLV_FUNCTION SLI_INLINE void SLV_NAME(group_product)(const sli_dual *f, sl_int j0, sl_int t0,
                                                     sl_int t1, double *scratch) {
    const sl_int m = sli_dual_columns(f, j0), h = f->width + f->below, first = j0 + m;
    const ptrdiff_t stride = sli_dual_stride(f, j0), tile_size = SLI_TILE * SLI_TILE;
    const double *W = sli_dual_weights(scratch) + SLI_TILE * (ptrdiff_t)(first % SLI_TILE);
    sl_int t, c, s;
    for (t = t0; t < t1; t++) {
        double *row = f->front + sli_square_offset(h, t) + SLI_TILE * (ptrdiff_t)j0;
        for (c = 0; c < sli_tiles(m); c++) {
            SLV_NAME(clear)(row + tile_size * c, m - SLI_TILE * c);
        }
    }
    for (s = first; s < h; s += SLI_CHUNK) {
        const sl_int length = sli_min(SLI_CHUNK, h - s);
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

/* The first lanes of some columns of a tile at to become those at from: rows below share the others. */
SLV_FUNCTION SLI_INLINE void SLV_NAME(merge)(double *to, const double *from, sl_int lanes,
                                             sl_int first, sl_int last) {
    sl_int k;
    SLV_DECLARE(a)
    SLV_DECLARE(b)
    for (k = first; k < last; k++) {
        SLV_LOAD(a, from + SLI_TILE * k)
        SLV_LOAD(b, to + SLI_TILE * k)
        SLV_FIRST(a, lanes)
        SLV_BELOW(b, lanes - 1)
        SLV_ADD(a, b)
        SLV_STORE(to + SLI_TILE * k, a)
    }
}

/* Lanes first .. last-1 of the first columns of a tile to the columns and lanes of another. */
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

/* Z_JS = Z_SJ', columns of the row tiles t0 .. t1-1. */
SLV_FUNCTION SLI_INLINE void SLV_NAME(group_mirror)(const sli_dual *f, sl_int j0, sl_int t0,
                                                    sl_int t1) {
    const sl_int m = sli_dual_columns(f, j0), h = f->width + f->below;
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

/* Z_JJ = L_JJ'^-1 D^-1 L_JJ^-1 - W' Z_SJ, the lower tiles of the group's row tiles t0 .. t1-1 and what mirrors
 * them. */
SLV_FUNCTION SLI_INLINE void SLV_NAME(group_square)(const sli_dual *f, sl_int j0, sl_int t0,
                                                    sl_int t1, double *scratch) {
    const sl_int m = sli_dual_columns(f, j0), h = f->width + f->below, first = j0 + m;
    const sl_int tile_size = SLI_TILE * SLI_TILE;
    const ptrdiff_t stride = sli_dual_stride(f, j0);
    const double *N = scratch, *P = N + SLI_DUAL_GROUP * SLI_DUAL_ROW,
                 *W = sli_dual_weights(scratch) + SLI_TILE * (ptrdiff_t)(first % SLI_TILE);
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
            (N + SLI_DUAL_ROW * (ptrdiff_t)t + tile_size * (ptrdiff_t)t,
             P + SLI_DUAL_ROW * (ptrdiff_t)c + tile_size * (ptrdiff_t)t, m - SLI_TILE * t, x,
             columns);
            if (first < h) {
                SLV_NAME(block)
                (W + t * stride, column + SLI_TILE * (ptrdiff_t)first, h - first, x, columns);
            }
            SLV_NAME(merge)(row + tile_size * (ptrdiff_t)c, x, rows, 0, columns);
            if (c < t) {
                SLV_NAME(mirror)
                (x, 0, rows, column + SLI_TILE * (ptrdiff_t)j0 + tile_size * (ptrdiff_t)t,
                 SLI_TILE);
            }
        }
    }
}

SLV_FUNCTION static void SLV_NAME(dual)(const sli_dual *f, sl_int j0, sli_dual_part part, sl_int t0,
                                        sl_int t1, double *scratch) {
    switch (part) {
    case SLI_DUAL_INVERSE:
        SLV_NAME(group_inverse)(f, j0, t0, t1, scratch);
        break;
    case SLI_DUAL_WEIGHTS:
        SLV_NAME(group_weights)(f, j0, t0, t1, scratch);
        break;
    case SLI_DUAL_PRODUCT:
        SLV_NAME(group_product)(f, j0, t0, t1, scratch);
        break;
    case SLI_DUAL_MIRROR:
        SLV_NAME(group_mirror)(f, j0, t0, t1);
        break;
    default:
        SLV_NAME(group_square)(f, j0, t0, t1, scratch);
    }
}

/* From the last group of columns to the first, each with the columns after it among its rows below:
 * what a group works upon stays in the caches, whatever the width. */
SLV_FUNCTION static void SLV_NAME(takahashi)(const sli_dual *f, double *scratch) {
    sl_int j0;
    for (j0 = sli_dual_last(f); j0 + SLI_DUAL_COLUMNS > f->first; j0 -= SLI_DUAL_COLUMNS) {
        const sli_span group = sli_dual_span(f, j0, SLI_DUAL_INVERSE);
        const sli_span below = sli_dual_span(f, j0, SLI_DUAL_WEIGHTS);
        SLV_NAME(group_inverse)(f, j0, group.first, group.last, scratch);
        if (below.first < below.last) {
            SLV_NAME(group_weights)(f, j0, below.first, below.last, scratch);
            SLV_NAME(group_product)(f, j0, below.first, below.last, scratch);
            SLV_NAME(group_mirror)(f, j0, below.first, below.last);
        }
        SLV_NAME(group_square)(f, j0, group.first, group.last, scratch);
    }
}
/* end src/impl/takahashi.inl.h */

/* begin src/impl/narrow.inl.h */
/* narrow.inl.h: one right-hand side through a supernode of 1 to 8 columns, all of them in registers; words SLV_* */

/* Most supernodes of a 2D mesh are as narrow as this, and what they cost is not the reading of L but
 * loops that end at once, calls, and vectors loaded where single numbers were just stored. Here the
 * width is a constant that is folded into each of 8 copies: the loops over columns are gone, y or
 * the sums of all columns stay in registers, and x is gathered straight into them. */
#define SLI_DECLARE(k, y) SLV_DECLARE(y##k)
#define SLI_SUM_DECLARE(k, a) SLV_SUM_DECLARE(a##k)
#define SLI_SUM_ZERO(k, a) SLV_SUM_ZERO(a##k)

/* the diagonal tile, column after column; L is 0 above its diagonal */
#define SLI_COLUMN(k, unused)                                                                      \
    if ((k) < w) {                                                                                 \
        SLI_PREFETCH(l + SLI_TILE * (k), SLI_AHEAD);                                               \
        SLV_LANE(y##k, a, k)                                                                       \
        SLV_DOT(a, l + SLI_TILE * (k), y##k)                                                       \
    }
/* a tile below: even columns into one sum, odd ones into another */
#define SLI_EVEN_ODD(k, unused)                                                                    \
    if ((k) < w) {                                                                                 \
        SLI_PREFETCH(l + SLI_TILE * (k), SLI_AHEAD);                                               \
        if ((k) % 2 == 0) {                                                                        \
            SLV_DOT(a, l + SLI_TILE * (k), y##k)                                                   \
        } else {                                                                                   \
            SLV_DOT(b, l + SLI_TILE * (k), y##k)                                                   \
        }                                                                                          \
    }

SLV_FUNCTION SLI_ALWAYS_INLINE void SLV_NAME(narrow_forward)(const sl_int w, sl_int below,
                                                             const sl_int *rows, const double *l,
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
    for (row = SLI_TILE; row < w + below; row += SLI_TILE) { /* y(rows) -= L(rows, j) y(j) */
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

/* x(j) -= L(rows, j)' x(rows), from the last column down as L is read backward in memory */
#define SLI_DOT(k)                                                                                 \
    if ((k) < w) {                                                                                 \
        SLI_PREFETCH(l + SLI_TILE * (k), -SLI_AHEAD);                                              \
        SLV_SUM_DOT(a##k, l + SLI_TILE * (k), v)                                                   \
    }
#define SLI_DOTS                                                                                   \
    SLI_DOT(7) SLI_DOT(6) SLI_DOT(5) SLI_DOT(4) SLI_DOT(3) SLI_DOT(2) SLI_DOT(1) SLI_DOT(0)
/* places of the 8 rows of a tile; of a tile of fewer rows, the last one again; of those that share
 * the tile of the columns, anything for the columns' lanes */
#define SLI_PLACE(k) rows[at + (k)]
#define SLI_PLACE_PART(k) rows[at + sli_min(k, count - 1)]
#define SLI_PLACE_OWN(k) rows[sli_clamp((k)-w, at - 1)]
#define SLI_SET(k, unused) double r##k = r[k];
#define SLI_GET(k, unused)                                                                         \
    if ((k) < w) {                                                                                 \
        xs[k] = r##k;                                                                              \
    }
#define SLI_XT(j, k)                                                                               \
    if ((j) < (k) && (k) < w) { /* r(j) -= L(k, j) r(k) */                                         \
        r##j = SLV_FNMA1(l[SLI_TILE * (j) + (k)], r##k, r##j);                                     \
    }
#define SLI_ROW(k)                                                                                 \
    SLI_XT(6, k) SLI_XT(5, k) SLI_XT(4, k) SLI_XT(3, k) SLI_XT(2, k) SLI_XT(1, k) SLI_XT(0, k)

/* l points at the panel's end. */
SLV_FUNCTION SLI_ALWAYS_INLINE void SLV_NAME(narrow_backward)(const sl_int w, sl_int below,
                                                              const sl_int *rows, const double *l,
                                                              const double *d, double *xs,
                                                              const double *x) {
    const sl_int count = (w + below) % SLI_TILE;
    sl_int row = w + below - count, at = below;
    double r[SLI_TILE];
    SLV_DECLARE(v)
    SLV_DECLARE(z)
    SLI_EACH8(SLI_SUM_DECLARE, a)
    SLI_EACH8(SLI_SUM_ZERO, a)
    if (row > 0 && count > 0) {
        at -= count;
        l -= SLI_TILE * w;
        SLV_GATHER(v, x, SLI_PLACE_PART)
        SLV_FIRST(v, count)
        SLI_DOTS
    }
    for (; row > SLI_TILE; row -= SLI_TILE) {
        at -= SLI_TILE;
        l -= SLI_TILE * w;
        SLV_GATHER(v, x, SLI_PLACE)
        SLI_DOTS
    }
    l -= SLI_TILE * w;
    if (w < SLI_TILE && at > 0) {
        SLV_GATHER(v, x, SLI_PLACE_OWN)
        SLV_FIRST(v, w + at)
        SLV_BELOW(v, w - 1)
        SLI_DOTS
    }
    SLV_LOAD_PART(z, xs, w, 0.0)
    SLV_LOAD_PART(v, d, w, 1.0)
    SLV_DIVIDE(z, z, v)
    SLV_SUMS(v, a)
    SLV_ADD(v, z)
    SLV_STORE_ANY(r, v) {
        SLI_EACH8(SLI_SET, 0)
        SLI_ROW(7)
        SLI_ROW(6) SLI_ROW(5) SLI_ROW(4) SLI_ROW(3) SLI_ROW(2) SLI_ROW(1) SLI_EACH8(SLI_GET, 0)
    }
}

#define SLI_FORWARD(k) SLV_NAME(narrow_forward)(k, below, rows, l, xs, x, buf)
#define SLI_BACKWARD(k) SLV_NAME(narrow_backward)(k, below, rows, l, d, xs, x)

SLV_FUNCTION SLI_INLINE void SLV_NAME(forward_narrow)(sl_int w, sl_int below, const sl_int *rows,
                                                      const double *l, double *xs, double *x,
                                                      double *buf){SLI_CASES(SLI_FORWARD)}

SLV_FUNCTION SLI_INLINE
    void SLV_NAME(backward_narrow)(sl_int w, sl_int below, const sl_int *rows, const double *l,
                                   const double *d, double *xs, const double *x) {
    SLI_CASES(SLI_BACKWARD)
}

#undef SLI_DECLARE
#undef SLI_SUM_DECLARE
#undef SLI_SUM_ZERO
#undef SLI_COLUMN
#undef SLI_EVEN_ODD
#undef SLI_DOT
#undef SLI_DOTS
#undef SLI_PLACE
#undef SLI_PLACE_PART
#undef SLI_PLACE_OWN
#undef SLI_SET
#undef SLI_GET
#undef SLI_XT
#undef SLI_ROW
#undef SLI_FORWARD
#undef SLI_BACKWARD
/* end src/impl/narrow.inl.h */

/* begin src/impl/body.inl.h */
/* body.inl.h: one right-hand side, SIMD along the 8 rows of a tile; the words SLV_* are one octet of doubles */

/* buf := L^-1 buf on the first `rows` local rows of a panel, its columns 8 t0 .. columns-1 applied
 * in ascending order. tile points at tile t0. Four partial sums hide the latency of the FMA; their
 * grouping depends on the column number alone, so that a sweep that starts later, over zeros, gives
 * the same bits. */
SLV_FUNCTION SLI_INLINE void SLV_NAME(panel_forward)(const double *tile, sl_int t0, sl_int width,
                                                     sl_int columns, sl_int rows, double *buf) {
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
        for (j = first; j + 4 <= final; j += 4) { /* y(rows) -= L(rows, j) y(j) */
            const double *l = tile + SLI_TILE * j;
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
            SLV_NAME(tile_forward)(tile + SLI_TILE * row, buf + row);
        } else {
            for (k = 0; k < inner; k++) { /* columns inside the tile, one after the other */
                SLV_AXPY(a0, tile + SLI_TILE * (row + k), buf + row + k)
                SLV_STORE(buf + row, a0)
            }
        }
        tile += SLI_TILE * sli_min(width, row + SLI_TILE);
    }
}

SLV_FUNCTION static void SLV_NAME(forward)(sl_int count, const sli_step *s, const sl_int *rows,
                                           const double *L, double *x, double *buf) {
    for (; count > 0; count--, s++) {
        const sl_int w = s->width, height = w + s->below, first = SLI_TILE * s->first_tile;
        const double *tile = L + s->panel + sli_tile_offset(w, s->first_tile);
        double *xs = x + s->base;
        sl_int i;
        if (w <= SLI_TILE) {
            SLV_NAME(forward_narrow)(w, s->below, rows, tile, xs, x, buf);
            rows += s->below;
            continue;
        }
        memcpy(buf + first, xs, (size_t)(w - first) * sizeof(double));
        for (i = w; i < SLI_TILE * sli_tiles(height); i++) {
            buf[i] = 0.0;
        }
        SLV_NAME(panel_forward)(tile, s->first_tile, w, w, height, buf);
        memcpy(xs, buf + first, (size_t)(w - first) * sizeof(double));
        for (i = 0; i < s->below; i++) {
            x[rows[i]] += buf[w + i];
        }
        rows += s->below;
    }
}

/* The backward pass leaves 8 partial sums a column, or fewer where an octet takes several registers:
 * sums(j) -= L(rows, j)' x(rows) over the columns first .. final-1 of one row tile, or of two at
 * once, which spares half of the loads and stores of the sums. */
#define SLI_DECLARE(k, a) SLV_DECLARE(a##k)
#define SLI_SUM_DECLARE(k, a) SLV_SUM_DECLARE(a##k)
#define SLI_PLACE(k) rows[at + (k)]
#define SLI_PLACE_PART(k) rows[at + sli_clamp((k)-inner, part - 1)]

SLV_FUNCTION SLI_INLINE void SLV_NAME(dots1)(const double *l, const double *x, sl_int first,
                                             sl_int final, double *sums) {
    ptrdiff_t j;
    SLV_DECLARE(v)
    SLV_SUM_DECLARE(a)
    SLV_LOAD(v, x)
    for (j = SLI_TILE * ((ptrdiff_t) final - 1); j >= SLI_TILE * (ptrdiff_t)first; j -= SLI_TILE) {
        SLI_PREFETCH(l + j, -SLI_AHEAD);
        SLV_SUM_LOAD(a, sums + j)
        SLV_SUM_DOT(a, l + j, v)
        SLV_SUM_STORE(sums + j, a)
    }
}

/* Two tiles: l0 and its 8 rows at x, l1 and the 8 rows after those. */
SLV_FUNCTION SLI_INLINE void SLV_NAME(dots2)(const double *l0, const double *l1, const double *x,
                                             sl_int first, sl_int final, double *sums) {
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

/* The diagonal tile of the columns row .. row+inner-1: what the rows below them left is summed, the
 * right side added, the triangle solved. l: the tile's diagonal part. */
#define SLI_TAKE_SUM(k, unused)                                                                    \
    if ((k) < inner) {                                                                             \
        SLV_SUM_LOAD(a##k, sums + SLI_TILE * (k))                                                  \
        if (inner < SLI_TILE) {                                                                    \
            SLV_SUM_DOT(a##k, l + SLI_TILE * (k), v)                                               \
        }                                                                                          \
    } else {                                                                                       \
        SLV_SUM_ZERO(a##k)                                                                         \
    }
SLV_FUNCTION SLI_INLINE void SLV_NAME(diagonal)(const double *l, sl_int inner, const double *sums,
                                                const double *d, double *xs, double *buf) {
    double r[SLI_TILE];
    sl_int j, k;
    SLV_DECLARE(v)
    SLV_DECLARE(z)
    SLI_EACH8(SLI_SUM_DECLARE, a)
    SLV_ZERO(v)
    if (inner < SLI_TILE) { /* buf is 0 on the columns: only rows below count here */
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
        SLV_NAME(tile_backward)(l, r);
    } else {
        for (k = inner - 1; k > 0; k--) { /* x(j) -= L(k, j) x(k) */
            for (j = 0; j < k; j++) {
                r[j] = SLV_FNMA1(l[SLI_TILE * j + k], r[k], r[j]);
            }
        }
    }
    for (k = 0; k < inner; k++) {
        xs[k] = buf[k] = r[k];
    }
}

/* buf: the rows of two tiles; behind them the sums. */
SLV_FUNCTION static void SLV_NAME(backward)(sl_int count, const sli_step *s, const sl_int *rows_end,
                                            const double *L, const double *D, double *x,
                                            double *buf) {
    const int by_two = count <= SLI_FEW_STEPS;
    for (s += count; count > 0; count--) {
        const sl_int w = (--s)->width, height = w + s->below, first = SLI_TILE * s->first_tile;
        const double *d = D + s->column - first, *tile = L + s->panel + sli_panel_size(w, s->below);
        double *xs = x + s->base - first, *sums = buf + 2 * SLI_TILE;
        const sl_int *rows = rows_end -= s->below;
        sl_int row = SLI_TILE * (sli_tiles(height) - 1), j;
        SLV_DECLARE(v)
        SLV_SUM_DECLARE(a)
        if (w <= SLI_TILE) {
            SLV_NAME(backward_narrow)(w, s->below, rows, tile, d, xs, x);
            continue;
        }
        SLV_SUM_ZERO(a)
        for (j = first; j < w; j++) {
            SLV_SUM_STORE(sums + SLI_TILE * (ptrdiff_t)j, a)
        }
        for (; row >= first; row -= SLI_TILE) {
            const sl_int inner = sli_clamp(w - row, SLI_TILE), final = sli_min(row, w);
            const sl_int at = row + inner - w, part = sli_min(height - row, SLI_TILE) - inner;
            const double *above;
            tile -= SLI_TILE * (ptrdiff_t)sli_min(w, row + SLI_TILE);
            above = tile - SLI_TILE * (ptrdiff_t) final;
            if (part == SLI_TILE) {
                SLV_GATHER(v, x, SLI_PLACE)
                SLV_STORE(buf + SLI_TILE, v)
            } else if (inner < SLI_TILE) { /* rows below, between zeros */
                SLV_ZERO(v)
                if (part > 0) {
                    SLV_GATHER(v, x, SLI_PLACE_PART)
                    SLV_FIRST(v, inner + part)
                }
                SLV_STORE(buf + SLI_TILE, v)
                for (j = 0; j < inner; j++) {
                    buf[SLI_TILE + j] = 0.0;
                }
            }
            if (inner > 0) {
                SLV_NAME(diagonal)
                (tile + SLI_TILE * (ptrdiff_t)row, inner, sums + SLI_TILE * (ptrdiff_t)row, d + row,
                 xs + row, buf + SLI_TILE);
            }
            if (!by_two || row == first || (inner == 0 && row - SLI_TILE < w)) {
                SLV_NAME(dots1)(tile, buf + SLI_TILE, first, final, sums);
                continue;
            }
            row -= SLI_TILE;
            if (inner == 0) {
                rows -= SLI_TILE;
                SLV_GATHER(v, x, SLI_PLACE)
                rows += SLI_TILE;
                SLV_STORE(buf, v)
                SLV_NAME(dots2)(above, tile, buf, first, w, sums);
            } else {
                SLV_NAME(dots1)(tile, buf + SLI_TILE, row, final, sums);
                SLV_NAME(diagonal)
                (above + SLI_TILE * (ptrdiff_t)row, SLI_TILE, sums + SLI_TILE * (ptrdiff_t)row,
                 d + row, xs + row, buf);
                SLV_NAME(dots2)(above, tile, buf, first, row, sums);
            }
            tile = above;
        }
    }
}

#undef SLI_DECLARE
#undef SLI_SUM_DECLARE
#undef SLI_PLACE
#undef SLI_PLACE_PART
#undef SLI_TAKE_SUM

SLV_FUNCTION static void SLV_NAME(row)(double *panel, sl_int w, sl_int q, const sl_int *rows,
                                       const double *D, double *xs, double *x, double *buf,
                                       double *pivot, double *magnitude) {
    const sl_int columns = sli_min(q, w);
    double *lq = panel + sli_panel_at(w, q, 0);
    double d = *pivot, size = *magnitude;
    sl_int i;
    for (i = 0; i < columns; i++) { /* y = row of A minus what the descendants sent */
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
    for (i = 0; i < columns; i++) { /* l(k, j) = y(j) / d(j), d(k) -= l(k, j) y(j) */
        const double l = buf[i] / D[i];
        lq[SLI_TILE * i] = l;
        d = SLV_FNMA1(l, buf[i], d);
        size += fabs(l * buf[i]);
    }
    *pivot = d;
    *magnitude = size;
}

static const sli_kernels SLV_NAME(kernels) = {
    SLV_ISA,
    {SLV_NAME(forward), SLV_NAME(forward2), SLV_NAME(forward4), SLV_NAME(forward8)},
    {SLV_NAME(backward), SLV_NAME(backward2), SLV_NAME(backward4), SLV_NAME(backward8)},
    SLV_NAME(row),
    SLV_NAME(pivots),
    SLV_NAME(rows),
    SLV_NAME(update),
    SLV_NAME(assemble),
    SLV_NAME(products8),
    SLV_NAME(gather),
    SLV_NAME(dual),
    SLV_NAME(takahashi)};
/* end src/impl/body.inl.h */

/* begin src/impl/words_end.inl.h */
/* words_end.inl.h: takes the octet words back, for the next instruction set */
#undef SLV_NAME
#undef SLV_ISA
#undef SLV_FUNCTION
#undef SLV_DECLARE
#undef SLV_ZERO
#undef SLV_LOAD
#undef SLV_STORE
#undef SLV_ADD
#undef SLV_AXPY
#undef SLV_DOT
#undef SLV_FNMA1
#undef SLV_STORE_ANY
#undef SLV_FNMA
#undef SLV_TWICE_LOW
#undef SLV_TWICE_HIGH
#undef SLV_TWICE_AT
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
#undef SLV_SPREAD
#undef SLV_SPREAD_ADD
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
/* end src/impl/words_end.inl.h */

#endif

#endif
/* end src/impl/isa_neon.h */
/* begin src/impl/select.h */
/* select.h: the kernel table for an instruction set */
#ifndef SLI_SELECT_H
#define SLI_SELECT_H

/* The table of an ISA, the best one for SL_ISA_AUTO; NULL where it is not compiled in or this
 * processor lacks it. */
static const sli_kernels *sli_kernels_select(sl_isa isa) {
    const sl_isa best = sli_cpu_best();
    if (isa == SL_ISA_AUTO) {
        isa = best;
    }
    if (isa == SL_ISA_SCALAR) {
        return &sli_kernels_scalar;
    }
#if defined(SLI_X86)
    if (isa == SL_ISA_AVX512 && best == SL_ISA_AVX512) {
        return &sli_kernels_avx512;
    }
    if (isa == SL_ISA_AVX2 && best != SL_ISA_SCALAR) {
        return &sli_kernels_avx2;
    }
#elif defined(SLI_ARM)
    if (isa == SL_ISA_NEON) {
        return &sli_kernels_neon;
    }
#endif
    return NULL;
}

#endif
/* end src/impl/select.h */
/* L2 storage */
/* begin src/impl/csc.h */
/* csc.h: compressed columns: checks, owned matrices, triplets, transpose, which triangle is stored */
#ifndef SLI_CSC_H
#define SLI_CSC_H

struct sl_matrix {
    sl_allocator allocator;
    sl_int n_rows, n_cols;
    sl_int *p; /* n_cols + 1 */
    sl_int *i; /* p[n_cols], perhaps a little longer where duplicates were summed */
    double *x; /* as i, or NULL: a pattern */
};

SLI_INLINE sl_int sli_nnz(const sl_csc *A) {
    return A->n_cols > 0 ? A->p[A->n_cols] : 0;
}

SL_API sl_status sl_csc_check(const sl_csc *A, sl_stats *stats) {
    sl_int j, p;
    sli_stats_clear_error(stats);
    if (A == NULL || A->n_rows < 0 || A->n_cols < 0 || (A->n_cols > 0 && A->p == NULL)) {
        return SL_ERR_ARGUMENT;
    }
    if (A->n_rows > SLI_ROWS_MAX || A->n_cols > SLI_ROWS_MAX) {
        return SL_ERR_TOO_LARGE;
    }
    if (A->n_cols == 0) {
        return SL_OK;
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

/* Which triangles have entries; the pattern is not compared. */
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

/* Whether an entry is one of those that stand for the symmetric matrix: of both triangles only the
 * lower is read. */
SLI_INLINE int sli_is_read(sl_triangle triangle, sl_int row, sl_int column) {
    return triangle != SL_TRIANGLE_BOTH || row >= column;
}

/* Arrays of a matrix with room for nnz entries. */
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

/* start[k] := number of keys before k, start[n] := all; then start[key]++ places entries one after
 * the other. */
static void sli_starts(sl_int *start, sl_int n, const sl_int *keys, sl_int count) {
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

/* Sums neighbours with equal rows in every column of M; rows ascend. */
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

/* Triplets in range into columns: sorted by row, then stably by column, so that rows ascend and
 * duplicates keep their order; both sorts are by counting. */
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
    sli_starts(start, n_rows, i, count);
    for (k = 0; k < count; k++) {
        order[start[i[k]]++] = k;
    }
    sli_starts(start, n_cols, j, count);
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
        !sli_allocator_is_whole(opt)) {
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
    status = sli_allocator_is_whole(opt) ? sl_csc_check(A, NULL) : SL_ERR_ARGUMENT;
    if (status != SL_OK) {
        return status;
    }
    status = sli_matrix_new(&T, A->n_cols, A->n_rows, sli_nnz(A), A->x != NULL, &a);
    if (status != SL_OK) {
        return status;
    }
    sli_starts(T->p, A->n_rows, A->i, sli_nnz(A));
    for (j = 0; j < A->n_cols; j++) {
        for (p = A->p[j]; p < A->p[j + 1]; p++) {
            const sl_int to = T->p[A->i[p]]++;
            T->i[to] = j;
            if (A->x != NULL) {
                T->x[to] = A->x[p];
            }
        }
    }
    for (k = A->n_rows; k > 0; k--) { /* placing moved every start to its end */
        T->p[k] = T->p[k - 1];
    }
    T->p[0] = 0;
    *out = T;
    return SL_OK;
}

/* With every column of A marked in turn, each entry of the same column of A' must be marked. */
static sl_status sli_csc_mirrored(const sl_csc *A, const sl_csc *T, sl_int *mark, sl_stats *stats) {
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

/* The triangle of a checked square matrix; *out is left alone on error. */
static sl_status sli_csc_triangle(const sl_csc *A, sl_triangle *out, const sl_options *opt,
                                  sl_stats *stats) {
    const sl_allocator a = sli_allocator(opt);
    const sl_triangle found = sli_triangle_scan(A);
    sl_csc pattern = *A, T;
    sl_matrix *transpose;
    sl_int *mark;
    sl_status status = SL_OK;
    if (found == SL_TRIANGLE_BOTH) {
        pattern.x = NULL;
        status = sl_matrix_transpose(&transpose, &pattern, opt);
        if (status != SL_OK) {
            return status;
        }
        T = sl_matrix_view(transpose);
        mark = (sl_int *)sli_alloc(&a, (size_t)A->n_cols * sizeof(sl_int)); /* A->p is longer */
        status = mark == NULL ? SL_ERR_MEMORY : sli_csc_mirrored(A, &T, mark, stats);
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
    if (out == NULL || A->n_rows != A->n_cols || !sli_allocator_is_whole(opt)) {
        return SL_ERR_ARGUMENT;
    }
    return sli_csc_triangle(A, out, opt, stats);
}

#endif
/* end src/impl/csc.h */
/* begin src/impl/csc_products.h */
/* csc_products.h: what is computed with a matrix in compressed columns: products, norms, residuals */
#ifndef SLI_CSC_PRODUCTS_H
#define SLI_CSC_PRODUCTS_H

/* y += sign A x; triangle SL_TRIANGLE_NONE: every entry for itself, which is also right for a
 * diagonal matrix. */
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

SL_API sl_status sl_csc_multiply(const sl_csc *A, sl_reading reading, double *Y, size_t ldy,
                                 const double *X, size_t ldx, sl_int nrhs) {
    sl_triangle triangle;
    sl_int r;
    if (A == NULL || nrhs < 0 || (reading != SL_AS_SYMMETRIC && reading != SL_AS_STORED) ||
        (reading == SL_AS_SYMMETRIC && A->n_rows != A->n_cols)) {
        return SL_ERR_ARGUMENT;
    }
    if (nrhs == 0 || A->n_rows == 0) {
        return SL_OK;
    }
    if (Y == NULL || ldy < (size_t)A->n_rows || ldx < (size_t)A->n_cols ||
        (A->n_cols > 0 && X == NULL) || (sli_nnz(A) > 0 && A->x == NULL)) {
        return SL_ERR_ARGUMENT;
    }
    triangle = reading == SL_AS_SYMMETRIC ? sli_triangle_scan(A) : SL_TRIANGLE_NONE;
    for (r = 0; r < nrhs; r++) {
        memset(Y + (size_t)r * ldy, 0, (size_t)A->n_rows * sizeof(double));
        sli_add_product(A, triangle, 1.0, Y + (size_t)r * ldy, X + (size_t)r * ldx);
    }
    return SL_OK;
}

/* The largest magnitude among n numbers, NaN if one is: fmax would pass over it. */
static double sli_largest(const double *x, sl_int n) {
    double largest = 0.0;
    sl_int i;
    for (i = 0; i < n; i++) {
        const double size = fabs(x[i]);
        largest = size <= largest || largest != largest ? largest : size;
    }
    return largest;
}

/* The largest row sum of |A|, A symmetric, NaN if A has one; sums: n numbers of scratch. */
static double sli_csc_norm(const sl_csc *A, double *sums) {
    const sl_triangle triangle = sli_triangle_scan(A);
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

/* ||r|| / (||A|| ||x|| + ||b||). An infinite denominator says nothing about r: NaN, and not the 0
 * that the quotient would be. */
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
    if (A == NULL || A->n_rows != A->n_cols || nrhs < 0) {
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
    if (B == NULL || R == NULL || X == NULL || ldb < rows || ldr < rows || ldx < rows ||
        (sli_nnz(A) > 0 && A->x == NULL) || R == X ||
        (R == B && (backward_error != NULL || ldr != ldb))) {
        return SL_ERR_ARGUMENT;
    }
    triangle = sli_triangle_scan(A);
    if (backward_error != NULL) {
        norm = sli_csc_norm(A, R);
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

#endif
/* end src/impl/csc_products.h */
/* begin src/impl/permute.h */
/* permute.h: permutations: validity, inverse, and P A P' of a stored matrix */
#ifndef SLI_PERMUTE_H
#define SLI_PERMUTE_H

/* iperm := the inverse of perm. Returns the first position that makes perm no permutation, or -1.
 */
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

/* The permuted entries of A as triplets; one triangle goes to the lower one. */
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
    if (A->n_rows != A->n_cols || (A->n_cols > 0 && perm == NULL) || !sli_allocator_is_whole(opt)) {
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

#endif
/* end src/impl/permute.h */
/* begin src/impl/sum.h */
/* sum.h: weighted sums of symmetric matrices, whatever triangles they store */
#ifndef SLI_SUM_H
#define SLI_SUM_H

/* The entries of all terms as triplets of the lower triangle. */
typedef struct sli_summands {
    sl_int count;
    sl_int *row, *column;
    double *x; /* NULL: patterns alone */
} sli_summands;

/* Whether the terms are matrices that can be added; their entries in all. */
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
    return *entries > INT32_MAX ? SL_ERR_TOO_LARGE : SL_OK;
}

/* Appends c A; c is not read where patterns alone are wanted. */
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
    if (terms == NULL || count < 1 || !sli_allocator_is_whole(opt)) {
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

#endif
/* end src/impl/sum.h */
/* begin src/impl/io.h */
/* io.h: Matrix Market files, read and written: coordinate; real, integer, pattern; general, symmetric */
#ifndef SLI_IO_H
#define SLI_IO_H

#define SLI_TOKEN_MAX 63 /* no number that a program prints is longer */

/* A place in the text, always at the start of a line that is not read yet. */
typedef struct sli_reader {
    const char *at, *end;
    sl_off line; /* lines taken so far */
} sli_reader;

/* Takes the next line that is neither blank nor a comment; *stop is its end. 0 at the end of the
 * text. */
static int sli_next_line(sli_reader *r, const char **start, const char **stop, int comments) {
    while (r->at < r->end) {
        const char *s = r->at, *e = s;
        while (e < r->end && *e != '\n') {
            e++;
        }
        r->at = e < r->end ? e + 1 : e;
        r->line++;
        while (s < e && (*s == ' ' || *s == '\t' || *s == '\r')) {
            s++;
        }
        if (s < e && (comments || *s != '%')) {
            *start = s;
            *stop = e;
            return 1;
        }
    }
    return 0;
}

/* Copies the next word of a line; 0 if there is none or it is too long. */
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

/* The next word as a whole number in low..high. */
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

/* The next word as a number; the C library wants the decimal point of the current locale. */
static int sli_token_double(const char **at, const char *stop, double *out) {
    char token[SLI_TOKEN_MAX + 1], *point, *rest;
    if (!sli_token(at, stop, token)) {
        return 0;
    }
    point = strchr(token, '.');
    if (point != NULL) {
        *point = *localeconv()->decimal_point;
    }
    *out = strtod(token, &rest);
    return rest != token && *rest == '\0';
}

/* Whether the next word is the given one, capitals or not. */
static int sli_token_is(const char *token, const char *word) {
    for (; *token != '\0' && *word != '\0'; token++, word++) {
        const char c = *token >= 'A' && *token <= 'Z' ? (char)(*token - 'A' + 'a') : *token;
        if (c != *word) {
            return 0;
        }
    }
    return *token == *word;
}

/* Whether the word is one of a list that ends in NULL. */
static int sli_token_in(const char *token, const char *const *words) {
    while (*words != NULL && !sli_token_is(token, *words)) {
        words++;
    }
    return *words != NULL;
}

/* "%%MatrixMarket matrix coordinate <field> <symmetry>"; what the format knows and this library
 * does not read is told apart from what is no such file. */
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

/* Whether nothing but blanks is left of a line. */
static int sli_line_ends(const char *s, const char *e) {
    while (s < e && (*s == ' ' || *s == '\t' || *s == '\r')) {
        s++;
    }
    return s == e;
}

/* count lines "row column [value]", 1-based; entries of a symmetric file go to the lower triangle.
 */
static sl_status sli_read_entries(sli_reader *r, const sl_off *size, int symmetric, sl_int *i,
                                  sl_int *j, double *x) {
    const char *s, *e;
    sl_off k, row, column;
    for (k = 0; k < size[2]; k++) {
        if (!sli_next_line(r, &s, &e, 0) || !sli_token_int(&s, e, 1, size[0], &row) ||
            !sli_token_int(&s, e, 1, size[1], &column) ||
            (x != NULL && !sli_token_double(&s, e, &x[k])) || !sli_line_ends(s, e)) {
            return SL_ERR_IO;
        }
        i[k] = (sl_int)(symmetric && row < column ? column : row) - 1;
        j[k] = (sl_int)(symmetric && row < column ? row : column) - 1;
    }
    return sli_next_line(r, &s, &e, 0) ? SL_ERR_IO : SL_OK;
}

static sl_status sli_parse(sl_matrix **out, sli_reader *r, const sl_allocator *a) {
    const char *s, *e;
    sl_off size[3] = {0, 0, 0};
    sli_block b = {NULL, 0, 0};
    sl_int *i = NULL, *j = NULL;
    double *x = NULL;
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
    /* an entry takes four bytes at least: a count that the file cannot hold is refused before
     * memory is asked for */
    if (!sli_line_ends(s, e) || (symmetric && size[0] != size[1]) ||
        size[2] > (r->end - r->at) / 4 + 1) {
        return SL_ERR_IO;
    }
    for (k = 0; k < 2 && status == SL_OK; k++) {
        i = SLI_TAKE(&b, sl_int, size[2]);
        j = SLI_TAKE(&b, sl_int, size[2]);
        x = has_values ? SLI_TAKE(&b, double, size[2]) : NULL;
        status = k == 0 ? sli_block_alloc(&b, a) : SL_OK;
    }
    if (status == SL_OK) {
        status = sli_read_entries(r, size, symmetric, i, j, x);
        if (status == SL_OK) {
            status = sli_from_triplets(out, (sl_int)size[0], (sl_int)size[1], (sl_int)size[2], i, j,
                                       x, a);
        }
        sli_free(a, b.base);
    }
    return status;
}

SL_API sl_status sl_matrix_parse(sl_matrix **out, const char *text, size_t length,
                                 const sl_options *opt, sl_stats *stats) {
    const sl_allocator a = sli_allocator(opt);
    const int saved = errno; /* strtod may set it */
    sli_reader r;
    sl_status status;
    sli_stats_clear_error(stats);
    if (out == NULL) {
        return SL_ERR_ARGUMENT;
    }
    *out = NULL;
    if (text == NULL || !sli_allocator_is_whole(opt)) {
        return SL_ERR_ARGUMENT;
    }
    r.at = text;
    r.end = text + length;
    r.line = 0;
    status = sli_parse(out, &r, &a);
    if (status != SL_OK && stats != NULL) {
        stats->error_line = r.line > 0 ? r.line : 1;
    }
    errno = saved;
    return status;
}

/* The whole file in memory; *text is allocated also on error, if at all. */
static sl_status sli_load(FILE *file, char **text, size_t *length, const sl_allocator *a) {
    size_t room = (size_t)1 << 16, got;
    *length = 0;
    *text = (char *)sli_alloc(a, room);
    while (*text != NULL) {
        got = fread(*text + *length, 1, room - *length, file);
        *length += got;
        if (*length < room) {
            return ferror(file) ? SL_ERR_IO : SL_OK;
        } else {
            char *larger = room > SIZE_MAX / 2 ? NULL : (char *)sli_alloc(a, 2 * room);
            if (larger != NULL) {
                memcpy(larger, *text, *length);
            }
            sli_free(a, *text);
            *text = larger;
            room *= 2;
        }
    }
    return SL_ERR_MEMORY;
}

SL_API sl_status sl_matrix_read(sl_matrix **out, const char *path, const sl_options *opt,
                                sl_stats *stats) {
    const sl_allocator a = sli_allocator(opt);
    const int saved = errno;
    char *text = NULL;
    size_t length = 0;
    FILE *file;
    sl_status status;
    sli_stats_clear_error(stats);
    if (out == NULL) {
        return SL_ERR_ARGUMENT;
    }
    *out = NULL;
    if (path == NULL || !sli_allocator_is_whole(opt)) {
        return SL_ERR_ARGUMENT;
    }
    file = fopen(path, "rb");
    if (file == NULL) {
        errno = saved;
        return SL_ERR_IO;
    }
    status = sli_load(file, &text, &length, &a);
    fclose(file);
    if (status == SL_OK) {
        status = sl_matrix_parse(out, text, length, opt, stats);
    }
    sli_free(&a, text);
    errno = saved;
    return status;
}

/* One entry, 1-based, with a decimal point whatever the locale. */
static int sli_write_entry(FILE *file, sl_int row, sl_int column, const double *value) {
    char number[40], *point;
    if (value == NULL) {
        return fprintf(file, "%ld %ld\n", (long)row + 1, (long)column + 1) > 0;
    }
    snprintf(number, sizeof number, "%.17g", *value);
    point = strchr(number, *localeconv()->decimal_point);
    if (point != NULL) {
        *point = '.';
    }
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
    FILE *file;
    int ok;
    if (status != SL_OK) {
        return status;
    }
    if (path == NULL || (reading != SL_AS_SYMMETRIC && reading != SL_AS_STORED)) {
        return SL_ERR_ARGUMENT;
    }
    file = fopen(path, "wb");
    ok = file != NULL && sli_write(file, A, reading, triangle);
    if (file != NULL) {
        ok = fclose(file) == 0 && ok;
    }
    errno = saved;
    return ok ? SL_OK : SL_ERR_IO;
}

#endif
/* end src/impl/io.h */
/* L3 patterns: never see a value array */
/* begin src/impl/symbolic_types.h */
/* symbolic_types.h: the analysis object: what the pattern parts fill in and the number parts read */
#ifndef SLI_SYMBOLIC_TYPES_H
#define SLI_SYMBOLIC_TYPES_H

struct sl_symbolic {
    sl_allocator allocator;
    sl_stats stats;         /* the symbolic group */
    sl_int n;               /* rows of A */
    sl_int n_supers;        /* supernodes, in postorder */
    sl_int nnz_input;       /* entries of A as handed in, read or not */
    uint64_t fingerprint;   /* of A's arrays p and i: a refactorization must bring the same */
    sl_int tallest, widest; /* largest height (columns + rows below) and width of a supernode */
    sl_int *perm, *iperm;   /* n */
    sl_int *parent;         /* n: elimination tree, -1 at a root */
    sl_int *counts;         /* n: entries of each column of L without relaxation */
    sl_int *super_of;       /* n */
    sl_int *super_first;    /* n_supers + 1 */
    sl_int *super_parent;   /* n_supers, -1 at a root */
    sl_off *rows_begin;     /* n_supers + 1 */
    sl_int *rows;           /* rows_begin[n_supers]: rows below each supernode, ascending */
    sl_off *panel_begin;    /* n_supers + 1, in doubles */
    sli_step *steps;        /* n_supers: the reach of everything */
    sl_int *descendant;     /* n_supers: the first supernode of each one's subtree */
    sl_int *places;    /* rows_begin[n_supers]: the local row of every row in the parent's front */
    sl_off *map_begin; /* n_supers + 1 */
    sl_int *map_from;  /* map_begin[n_supers]: positions in A, grouped by supernode */
    sl_off *map_to;    /* the same: positions in L; several may share one (duplicates) */
};

/* One triangle of an ordered matrix, entry by entry, duplicates kept. Elimination-order numbers. */
typedef struct sli_half {
    sl_int *begin; /* n + 1 */
    sl_int *to;    /* begin[n] */
    sl_int *from;  /* begin[n]: the entry of A; NULL where nobody asks */
} sli_half;

#endif
/* end src/impl/symbolic_types.h */
/* begin src/impl/graph.h */
/* graph.h: the pattern of a symmetric matrix, from whichever triangle is stored, as graph and as ordered halves */
#ifndef SLI_GRAPH_H
#define SLI_GRAPH_H

/* The full pattern without its diagonal; an entry given twice is an edge given twice. */
typedef struct sli_graph {
    sl_int n;
    sl_off *begin; /* n + 1 */
    sl_int *to;    /* begin[n] neighbours */
} sli_graph;

/* G has room for n + 1 positions and twice A's entries. */
SLI_INLINE void sli_graph_fill(sli_graph *G, const sl_csc *A, sl_triangle triangle) {
    sl_int j, p;
    sl_off total = 0;
    memset(G->begin, 0, ((size_t)G->n + 1) * sizeof(sl_off));
    for (j = 0; j < G->n; j++) {
        for (p = A->p[j]; p < A->p[j + 1]; p++) {
            const int is_edge = A->i[p] != j && sli_is_read(triangle, A->i[p], j);
            G->begin[A->i[p]] += is_edge;
            G->begin[j] += is_edge;
        }
    }
    for (j = 0; j <= G->n; j++) {
        const sl_off here = G->begin[j];
        G->begin[j] = total;
        total += here;
    }
    for (j = 0; j < G->n; j++) { /* every begin moves to its end, and back afterwards */
        for (p = A->p[j]; p < A->p[j + 1]; p++) {
            const sl_int i = A->i[p];
            if (i != j && sli_is_read(triangle, i, j)) {
                G->to[G->begin[j]++] = i;
                G->to[G->begin[i]++] = j;
            }
        }
    }
    memmove(G->begin + 1, G->begin, (size_t)G->n * sizeof(sl_off));
    G->begin[0] = 0;
}

/* Whether every list of neighbours ascends, as it does when the rows of A do. */
SLI_INLINE int sli_graph_is_sorted(const sli_graph *G) {
    sl_int v;
    sl_off e;
    for (v = 0; v < G->n; v++) {
        for (e = G->begin[v] + 1; e < G->begin[v + 1]; e++) {
            if (G->to[e - 1] > G->to[e]) {
                return 0;
            }
        }
    }
    return 1;
}

/* Sorts every list into `to`: a symmetric graph handed out vertex by vertex arrives sorted. at: n
 * of scratch. */
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

/* Counts to starting positions. */
static void sli_half_starts(sli_half *h, sl_int n) {
    sl_int k, total = 0;
    for (k = 0; k <= n; k++) {
        const sl_int here = h->begin[k];
        h->begin[k] = total;
        total += here;
    }
}

/* P A P' as rows (row k: the columns up to k, and where in A they stand) and as columns (column k:
 * the rows from k on). What follows walks them in elimination order, each pass only the half that
 * it needs. */
static void sli_halves_fill(const sl_csc *A, sl_triangle triangle, const sl_int *iperm,
                            sli_half *rows, sli_half *columns) {
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
    sli_half_starts(rows, n);
    sli_half_starts(columns, n);
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

SLI_INLINE uint64_t sli_stir(uint64_t h, uint64_t what) {
    h = (h ^ what) * 0xd6e8feb86659fd93u;
    return h ^ h >> 32;
}

/* Stirs count numbers in, two at once and in four chains: the multiplications of one chain wait for
 * each other, and every refactorization comes through here. */
static uint64_t sli_stir_all(uint64_t h, const sl_int *a, sl_int count) {
    uint64_t chain[4] = {h, h + 1, h + 2, h + 3};
    sl_int k = 0;
    int c;
    for (; k <= count - 8; k += 8) {
        for (c = 0; c < 4; c++) {
            chain[c] = sli_stir(chain[c], (uint64_t)(uint32_t)a[k + 2 * c] << 32 |
                                              (uint32_t)a[k + 2 * c + 1]);
        }
    }
    for (; k < count; k++) {
        chain[0] = sli_stir(chain[0], (uint32_t)a[k]);
    }
    return sli_stir(sli_stir(sli_stir(chain[0], chain[1]), chain[2]), chain[3]);
}

/* A number that two patterns share only by a 2^-64 accident. */
static uint64_t sli_fingerprint(const sl_csc *A) {
    const uint64_t h = sli_stir_all((uint64_t)(uint32_t)A->n_cols + 0x9e3779b97f4a7c15u,
                                    A->n_cols > 0 ? A->p + 1 : NULL, A->n_cols);
    return sli_stir_all(h, A->i, sli_nnz(A));
}

#endif
/* end src/impl/graph.h */
/* begin src/impl/order_metis.h */
/* order_metis.h: nested dissection of one connected component by METIS_NodeND */
#ifndef SLI_ORDER_METIS_H
#define SLI_ORDER_METIS_H

#if !defined(SL_NO_METIS)

#include <metis.h>

/* Whether METIS takes these options: it prints about others, or never ends. What the ordering does
 * not read may be anything. -1 is METIS's own choice. */
static int sli_metis_options_are_sound(const sl_int *wished) {
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
        {METIS_OPTION_UFACTOR, 1, 999}, /* from 1000 on one half may be empty, again and again */
    };
    size_t k;
    for (k = 0; wished != NULL && k < sizeof sli_ranges / sizeof *sli_ranges; k++) {
        const sl_int value = wished[sli_ranges[k].option];
        if (value != -1 && (value < sli_ranges[k].low || value > sli_ranges[k].high)) {
            return 0;
        }
    }
    return 1;
}

/* The component's graph as METIS wants it: its own numbering, no edge twice. */
static void sli_metis_graph(const sli_graph *G, const sl_int *vertices, sl_int count,
                            const sl_int *local, idx_t *xadj, idx_t *adjncy, idx_t *mark) {
    sl_int k;
    idx_t edges = 0;
    for (k = 0; k < count; k++) {
        mark[k] = -1;
    }
    for (k = 0; k < count; k++) {
        const sl_int v = vertices[k];
        sl_off e;
        xadj[k] = edges;
        for (e = G->begin[v]; e < G->begin[v + 1]; e++) {
            const sl_int u = local[G->to[e]];
            if (mark[u] != k) {
                mark[u] = k;
                adjncy[edges++] = u;
            }
        }
    }
    xadj[count] = edges;
}

/* Reorders vertices, a whole component of G, in place; local[v] is a vertex's place in it on entry.
 */
static sl_status sli_order_component(const sli_graph *G, sl_int *vertices, sl_int count,
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
    sli_metis_graph(G, vertices, count, local, xadj, adjncy, iperm);
    METIS_SetDefaultOptions(options);
    for (k = 0; metis_options != NULL && k < METIS_NOPTIONS; k++) {
        options[k] = metis_options[k];
    }
    options[METIS_OPTION_NUMBERING] = 0;
    options[METIS_OPTION_DBGLVL] = 0; /* anything else prints */
    result = METIS_NodeND(&nv, xadj, adjncy, NULL, options, perm, iperm);
    if (result == METIS_OK) {
        for (k = 0; k < count;
             k++) { /* xadj is done with: the old numbers of the component go there */
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

#endif

#endif
/* end src/impl/order_metis.h */
/* begin src/impl/order.h */
/* order.h: the fill-reducing order of the rows: natural, given, or nested dissection by component */
#ifndef SLI_ORDER_H
#define SLI_ORDER_H

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

#if !defined(SL_NO_METIS)
#define SLI_ORDER_TINY 4 /* a component this small has nothing to dissect */

/* One breadth-first search a component, the queue being perm itself; each component is then
 * dissected in its place. */
static sl_status sli_order_graph(const sli_graph *G, const sl_int *metis_options, sl_int *perm,
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
            status = sli_order_component(G, perm + start, tail - start, local, metis_options, a);
        }
    }
    return status;
}

/* Puts the lists of an unsorted graph in order, so that a matrix has one order however it is
 * stored. */
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
        sli_free(a, b.base);
    }
    return status;
}

static sl_status sli_order_dissection(const sl_csc *A, sl_triangle triangle, const sl_options *opt,
                                      sl_int *perm, sl_int *local, const sl_allocator *a) {
    sli_graph G;
    sli_block b = {NULL, 0, 0};
    sl_status status = SL_OK;
    int pass;
    if (!sli_metis_options_are_sound(opt != NULL ? opt->metis_options : NULL)) {
        return SL_ERR_ARGUMENT;
    }
    memset(&G, 0, sizeof G);
    for (pass = 0; pass < 2 && status == SL_OK; pass++) {
        G.n = A->n_cols;
        G.begin = SLI_TAKE(&b, sl_off, (size_t)G.n + 1);
        G.to = SLI_TAKE(&b, sl_int, 2 * (size_t)sli_nnz(A));
        status = pass == 0 ? sli_block_alloc(&b, a) : SL_OK;
    }
    if (status == SL_OK) {
        sli_graph_fill(&G, A, triangle);
        status = sli_order_canonical(&G, a);
        if (status == SL_OK) {
            status = sli_order_graph(&G, opt != NULL ? opt->metis_options : NULL, perm, local, a);
        }
        sli_free(a, b.base);
    }
    return status;
}
#endif

/* perm: n, the order of a checked symmetric pattern. scratch: n. */
static sl_status sli_order(const sl_csc *A, sl_triangle triangle, const sl_options *opt,
                           sl_int *perm, sl_int *scratch, const sl_allocator *a, sl_stats *stats) {
    sl_ordering ordering = opt != NULL ? opt->ordering : SL_ORDERING_DEFAULT;
#if defined(SL_NO_METIS)
    (void)a;
    (void)triangle;
    if (ordering == SL_ORDERING_DEFAULT) {
        ordering = SL_ORDERING_NATURAL;
    }
#else
    if (ordering == SL_ORDERING_DEFAULT || ordering == SL_ORDERING_METIS) {
        return sli_order_dissection(A, triangle, opt, perm, scratch, a);
    }
#endif
    if (ordering == SL_ORDERING_GIVEN) {
        return sli_order_given(opt->perm, A->n_cols, perm, scratch, stats);
    }
    if (ordering == SL_ORDERING_NATURAL) {
        sli_order_natural(A->n_cols, perm);
        return SL_OK;
    }
    return ordering == SL_ORDERING_METIS ? SL_ERR_UNSUPPORTED : SL_ERR_ARGUMENT;
}

#endif
/* end src/impl/order.h */
/* begin src/impl/etree.h */
/* etree.h: the elimination tree of an ordered graph, postorder, and relabelling along an order */
#ifndef SLI_ETREE_H
#define SLI_ETREE_H

/* parent[k] := the first row below the diagonal of column k of L, -1 if there is none. ancestor: n
 * of scratch, the paths to the roots found so far, compressed. [Liu90] */
static void sli_etree(sl_int n, const sli_half *rows, sl_int *parent, sl_int *ancestor) {
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

/* post[k] := the k-th node of a forest in postorder, children ascending; parent[j] > j is not
 * needed. child, sibling: n of scratch each. */
static void sli_postorder(const sl_int *parent, sl_int n, sl_int *post, sl_int *child,
                          sl_int *sibling) {
    sl_int j, k = 0, root;
    for (j = 0; j < n; j++) {
        child[j] = -1;
    }
    for (j = n - 1; j >= 0; j--) { /* the lists come out ascending */
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
            /* down to the first leaf; a visited child is taken off its list */
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

/* Renumbers along order (order[k] = the number until now of the new k): old_of, its inverse new_of,
 * and the tree. scratch: 2n. */
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

#endif
/* end src/impl/etree.h */
/* begin src/impl/counts.h */
/* counts.h: entries of every column of L, in nearly O(nnz(A)), from the leaves of the row subtrees */
#ifndef SLI_COUNTS_H
#define SLI_COUNTS_H

/* counts[j] := entries of column j of L, diagonal included; the order is a postorder of parent.
 * columns has the numbers before that order, old_of[j] being j's; scratch: 4n.
 *
 * Row i of L is the subtree of the elimination tree that hangs between i and the smallest columns
 * of row i of A. Column j counts one for each row subtree that it lies in: +1 at every leaf of a
 * row subtree, -1 at the lowest common ancestor of two leaves in a row, -1 at i's parent side for
 * the diagonal, summed up the tree. In a postorder j is a leaf of row i's subtree if no earlier
 * neighbour of i lies among j's descendants. [GNP94]
 */
static void sli_counts(sl_int n, const sli_half *columns, const sl_int *old_of,
                       const sl_int *new_of, const sl_int *parent, sl_int *counts,
                       sl_int *scratch) {
    sl_int *first = scratch, *seen = scratch + n, *leaf = scratch + 2 * (size_t)n,
           *set = scratch + 3 * (size_t)n;
    sl_int i, j, p;
    /* first: the first descendant; seen: the largest first of a leaf in row i; leaf: that leaf */
    for (j = 0; j < n; j++) {
        first[j] = j;
        seen[j] = -1;
        leaf[j] = -1;
        set[j] = j;
    }
    for (j = 0; j < n; j++) {
        counts[j] = first[j] == j; /* a leaf of the tree starts the subtree of its own row */
        if (parent[j] != -1) {
            first[parent[j]] = sli_min(first[parent[j]], first[j]);
        }
    }
    for (j = 0; j < n; j++) {
        const sl_int end = columns->begin[old_of[j] + 1];
        if (parent[j] != -1) {
            counts[parent[j]]--; /* row j ends here */
        }
        for (p = columns->begin[old_of[j]]; p < end; p++) {
            i = new_of[columns->to[p]];
            if (i <= j || first[j] <= seen[i]) {
                continue;
            }
            counts[j]++;
            seen[i] = first[j];
            /* the subtrees of two successive leaves meet at the root of the earlier one's set */
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

#endif
/* end src/impl/counts.h */
/* begin src/impl/supernodes.h */
/* supernodes.h: fundamental supernodes, and their relaxed amalgamation over the whole assembly tree */
#ifndef SLI_SUPERNODES_H
#define SLI_SUPERNODES_H

/* Supernodes under construction, all arrays of n. A group is named by its top fundamental
 * supernode. */
typedef struct sli_groups {
    sl_int count;   /* fundamental supernodes */
    sl_int *first;  /* n + 1: first column of each */
    sl_int *parent; /* parent supernode, -1 at a root */
    sl_int *width;  /* columns of the group so far */
    sl_int *below;  /* rows below it */
    double *zeros;  /* stored places of the group that L does not fill */
    sl_int *group;  /* the supernode it was merged into, itself while on top; at last the top */
} sli_groups;

/* Runs of columns with the same structure, each the only child of the next: count falls by one
 * along the run. */
static void sli_fundamental(sl_int n, const sl_int *parent, const sl_int *counts, sl_int *children,
                            sl_int *super_of, sli_groups *g) {
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
        g->zeros[s] = 0.0;
        g->group[s] = s;
    }
}

/* Most zeros of a group of up to 8 columns: on a path 28 of 44 places are, 0.64, and on 2D grids no
 * such group has more. Every group's places stay below 1 / (1 - 0.70) = 3.34 times its entries,
 * also where short columns hang on tall ones. */
#define SLI_ZEROS_SMALL 0.70

/* Whether a group of some width may hold a fraction z of zeros. Small panels cost their calls, not
 * their flops; the thresholds gave the fastest solves over 2D and 3D meshes at 2-3 % more flops. */
static int sli_may_merge(sl_int width, double z) {
    return (width <= 8 && z < SLI_ZEROS_SMALL) || (width <= 16 && z < 0.30) ||
           (width <= 48 && z < 0.15) || z < 0.05;
}

/* Zeros that joining child c to p adds: c's columns grow to p's rows. */
static double sli_new_zeros(const sli_groups *g, sl_int c, sl_int p) {
    return (double)g->width[c] * (double)(g->width[p] + g->below[p] - g->below[c]);
}

/* Joins the children of p, cheapest first, as long as the zeros allow. list: the children, keyed by
 * rank. */
static void sli_merge_children(sli_groups *g, sl_int p, uint64_t *list, sl_int count,
                               uint64_t *scratch) {
    sl_int k;
    for (k = 0; k < count; k++) {
        const sl_int c = sli_value(list[k]);
        const double cost = sli_new_zeros(g, c, p);
        list[k] = sli_keyed(cost < 2e9 ? (sl_int)cost : INT32_MAX, c);
    }
    sli_sort(list, count, scratch);
    for (k = 0; k < count; k++) {
        const sl_int c = sli_value(list[k]), width = g->width[c] + g->width[p];
        const double zeros = g->zeros[c] + g->zeros[p] + sli_new_zeros(g, c, p);
        const double places = (double)width * (0.5 * (width + 1.0) + g->below[p]);
        if (sli_may_merge(width, zeros / places)) {
            g->width[p] = width;
            g->zeros[p] = zeros;
            g->group[c] = p;
        }
    }
}

/* Every supernode in turn takes in its children, which come before it. child, sibling: lists of
 * children; list, scratch: room for all of them. */
static void sli_relax(sli_groups *g, sl_int *child, sl_int *sibling, uint64_t *list,
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
            sli_merge_children(g, s, list, count, scratch);
        }
        if (g->parent[s] != -1) {
            sibling[s] = child[g->parent[s]];
            child[g->parent[s]] = s;
        }
    }
}

/* Numbers the groups in a postorder of their tree and lays their columns side by side: order[k] =
 * old column of the new k. On return the arrays describe the groups in their new numbers, and count
 * is how many there are. scratch: 5n. */
static void sli_renumber_groups(sli_groups *g, sl_int n, sl_int *order, sl_int *super_of,
                                sl_int *scratch) {
    sl_int *top = scratch, *tree = scratch + n, *post = scratch + 2 * (size_t)n,
           *at = scratch + 3 * (size_t)n;
    sl_int *more = scratch + 4 * (size_t)n;
    sl_int s, k, groups = 0, column = 0;
    for (s = g->count - 1; s >= 0; s--) { /* parents come first, so that their group is final */
        g->group[s] = g->group[s] == s ? s : g->group[g->group[s]];
    }
    for (s = 0; s < g->count; s++) {
        if (g->group[s] == s) {
            at[s] = groups;
            top[groups++] = s;
        }
    }
    for (k = 0; k < groups; k++) {
        const sl_int up = g->parent[top[k]];
        tree[k] = up == -1 ? -1 : at[g->group[up]];
    }
    for (s = 0; s < g->count; s++) { /* from here on: the group's place in top */
        g->group[s] = at[g->group[s]];
    }
    sli_postorder(tree, groups, post, at, more);
    for (k = 0; k < groups; k++) {
        more[post[k]] = k;
        at[post[k]] = column; /* where the group's next column goes */
        column += g->width[top[post[k]]];
    }
    for (s = 0; s < g->count; s++) {
        sl_int *next = &at[g->group[s]];
        for (k = g->first[s]; k < g->first[s + 1]; k++) {
            super_of[*next] = more[g->group[s]];
            order[(*next)++] = k;
        }
    }
    for (k = 0; k < groups;
         k++) { /* group and at are done with: they carry the sizes to the new numbers */
        at[k] = g->width[top[post[k]]];
        g->group[k] = g->below[top[post[k]]];
    }
    column = 0;
    for (k = 0; k < groups; k++) {
        g->first[k] = column;
        g->width[k] = at[k];
        g->below[k] = g->group[k];
        g->parent[k] = tree[post[k]] == -1 ? -1 : more[tree[post[k]]];
        column += at[k];
    }
    g->first[groups] = n;
    g->count = groups;
}

#endif
/* end src/impl/supernodes.h */
/* begin src/impl/structure.h */
/* structure.h: the rows of every supernode, the places of the panels, and the map of A into L */
#ifndef SLI_STRUCTURE_H
#define SLI_STRUCTURE_H

/* Entries of A that a supernode's columns hold, summed up to the starts of its part of the map. */
static void sli_count_map(sl_symbolic *S, const sli_half *columns, const sl_int *old_of) {
    sl_int s, k = 0;
    sl_off total = 0;
    for (s = 0; s < S->n_supers; s++) {
        S->map_begin[s] = total;
        for (; k < S->super_first[s + 1]; k++) {
            total += columns->begin[old_of[k] + 1] - columns->begin[old_of[k]];
        }
    }
    S->map_begin[S->n_supers] = total;
}

/* The rows of every supernode, and the place in L of every entry of A, in one walk over the rows.
 *
 * Row k of L is the part of the supernode tree between row k's entries of A and k's own supernode:
 * k is appended to each of them, and as k ascends so do the lists; where it was appended is the
 * local row of k's entries. end: n_supers, how far each list has got; mark: n_supers.
 */
static void sli_fill_structure(sl_symbolic *S, const sli_half *rows, const sl_int *old_of,
                               const sl_int *new_of, sl_off *end, sl_int *mark) {
    sl_int k, p, s;
    for (s = 0; s < S->n_supers; s++) {
        end[s] = S->rows_begin[s];
        mark[s] = -1;
    }
    for (k = 0; k < S->n; k++) {
        const sl_int own = S->super_of[k];
        for (p = rows->begin[old_of[k]]; p < rows->begin[old_of[k] + 1]; p++) {
            const sl_int i = new_of[rows->to[p]], home = S->super_of[i];
            const sl_int first = S->super_first[home], width = S->super_first[home + 1] - first;
            sl_int local;
            sl_off at;
            for (s = home; s != own && mark[s] != k; s = S->super_parent[s]) {
                mark[s] = k;
                S->rows[end[s]++] = k;
            }
            local = home == own ? k - first : width + (sl_int)(end[home] - S->rows_begin[home]) - 1;
            at = S->map_begin[home]++; /* every start moves to its end, and back afterwards */
            S->map_from[at] = rows->from[p];
            S->map_to[at] = S->panel_begin[home] + sli_panel_at(width, local, i - first);
        }
    }
    for (s = 0; s < S->n_supers; s++) {
        SLI_ASSERT(end[s] == S->rows_begin[s + 1]);
    }
    memmove(S->map_begin + 1, S->map_begin, (size_t)S->n_supers * sizeof(sl_off));
    S->map_begin[0] = 0;
}

/* The step of every supernode: the reach of everything, in which a column's place is the column. */
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

#endif
/* end src/impl/structure.h */
/* begin src/impl/mapping.h */
/* mapping.h: the map of A into L read backwards: the row and the column that a place stands for */
#ifndef SLI_MAPPING_H
#define SLI_MAPPING_H

/* The last row tile of supernode s. */
SLI_INLINE sl_int sli_last_tile(const sl_symbolic *S, sl_int s) {
    return sli_tiles(S->steps[s].width + S->steps[s].below) - 1;
}

/* Pivots k >= j of the entry m of the map, which belongs to supernode s: it stands at L(k, j). tile: where
 * to look from, the row tile of m or a later one; then that of m. Rows ascend in a supernode's part of the
 * map: whoever goes backwards through it from the last tile looks at each tile once. */
static void sli_map_pivots(const sl_symbolic *S, sl_int s, sl_off m, sl_int *tile, sl_int *k,
                           sl_int *j) {
    const sl_int first = S->super_first[s], w = S->steps[s].width;
    sl_off in_tile = S->map_to[m] - S->panel_begin[s];
    sl_int local;
    while (sli_tile_offset(w, *tile) > in_tile) {
        --*tile;
    }
    in_tile -= sli_tile_offset(w, *tile);
    local = SLI_TILE * *tile + (sl_int)(in_tile % SLI_TILE);
    *j = first + (sl_int)(in_tile / SLI_TILE);
    *k = local < w ? first + local : S->rows[S->rows_begin[s] + local - w];
    SLI_ASSERT(S->panel_begin[s] + sli_panel_at(w, local, *j - first) == S->map_to[m]);
}

#endif
/* end src/impl/mapping.h */
/* begin src/impl/fronts.h */
/* fronts.h: the tree of fronts: the children of each supernode, and where their rows stand in its front */
#ifndef SLI_FRONTS_H
#define SLI_FRONTS_H

/* The children of s: s - 1, then the one before the first descendant of that, and so on down to s's
 * own first descendant, as supernodes are in postorder. */
static void sli_fill_descendants(sl_symbolic *S) {
    sl_int s;
    for (s = 0; s < S->n_supers; s++) {
        S->descendant[s] = s;
    }
    for (s = 0; s < S->n_supers; s++) {
        const sl_int up = S->super_parent[s];
        if (up != -1) {
            S->descendant[up] = sli_min(S->descendant[up], S->descendant[s]);
        }
    }
}

/* Local rows in the parent's front. local: n of scratch. */
static void sli_fill_places(sl_symbolic *S, sl_int *local) {
    sl_int s, c;
    sl_off at;
    for (s = 0; s < S->n_supers; s++) {
        for (c = S->super_first[s]; c < S->super_first[s + 1]; c++) {
            local[c] = c - S->super_first[s];
        }
        for (at = S->rows_begin[s]; at < S->rows_begin[s + 1]; at++) {
            local[S->rows[at]] = S->steps[s].width + (sl_int)(at - S->rows_begin[s]);
        }
        for (c = s - 1; c >= S->descendant[s]; c = S->descendant[c] - 1) {
            for (at = S->rows_begin[c]; at < S->rows_begin[c + 1]; at++) {
                S->places[at] = local[S->rows[at]];
            }
        }
    }
}

#endif
/* end src/impl/fronts.h */
/* begin src/impl/schedule.h */
/* schedule.h: which worker factors which fronts, and where update matrices wait for the parent's front */
#ifndef SLI_SCHEDULE_H
#define SLI_SCHEDULE_H

/* Tasks are subtrees, runs of supernodes of their own, each done by one worker; the fronts above them
 * come afterwards, one by one, with all workers in each. One worker has one task, everything. */
typedef struct sli_schedule {
    sl_int workers;
    sl_int n_tasks, n_tops;
    sl_int *first, *last;  /* n_tasks: supernodes of a task */
    sl_int *worker;        /* n_tasks: who does it */
    sl_int *top;           /* n_tops: the other supernodes, ascending */
    sl_off *waiting_begin; /* n_supers: where each one's update matrix waits, in doubles */
    sl_off waiting;        /* doubles for all of them */
} sli_schedule;

/* A forest of fronts, numbered in postorder: all supernodes of an analysis, or those of a reach. */
typedef struct sli_forest {
    sl_int count;
    const sl_int *parent; /* count: -1 at a root */
    const sl_int *low;    /* count: the first of the subtree */
} sli_forest;

/* What the planning needs only while it runs. */
typedef struct sli_planning {
    double *flops;   /* count: of the front, then of the subtree */
    double *load;    /* workers */
    sl_int *side;    /* count: the stack of a supernode, 2 more in a task */
    uint64_t *order; /* count: tasks, the largest last */
    uint64_t *scratch;
} sli_planning;

/* Tasks this much smaller than a worker's share even out what no estimate knows. */
#define SLI_TASKS_A_WORKER 8

/* A front of this many flops takes some 50 us, and is shared out at 1 or 2 us a step by OpenMP, at more by others. */
#define SLI_SHARED_FLOPS 4e6

/* Doubles that a supernode leaves to its parent: the update matrix and the magnitudes of its rows. */
SLI_INLINE sl_off sli_waiting_size(const sli_step *s) {
    const sl_int tiles = sli_update_tiles(s->width, s->below);
    return sli_triangle_offset(tiles) + SLI_TILE * (sl_off)tiles;
}

/* Flops of a front: sum over its columns of (entries)^2. */
SLI_INLINE double sli_front_flops(const sli_step *s) {
    const double w = s->width, h = w + s->below;
    return w * (h * h - (w - 1.0) * h + (w - 1.0) * (2.0 * w - 1.0) / 6.0);
}

/* Where the update matrices of some supernodes, handed over in ascending order, wait: supernodes of
 * even and of odd depth have a stack each, which grow towards each other. When a supernode is done,
 * its children are the top of the other stack, so that nothing ever moves. */
typedef struct sli_stacks {
    sl_off top[2];
    sl_off most;
} sli_stacks;

static void sli_stacks_push(sli_stacks *k, const sl_symbolic *S, sl_int s, const sl_int *side,
                            sl_off *begin) {
    const int own = side[s] & 1, in_task = side[s] & 2;
    const sl_off size = sli_waiting_size(&S->steps[s]);
    sl_int c;
    begin[s] = own == 0 ? k->top[0] : -(k->top[1] + size);
    k->top[own] += size;
    k->most = k->top[0] + k->top[1] > k->most ? k->top[0] + k->top[1] : k->most;
    for (c = s - 1; c >= S->descendant[s]; c = S->descendant[c] - 1) {
        if ((side[c] & 2) == in_task) {
            k->top[1 - own] -= sli_waiting_size(&S->steps[c]);
        }
    }
}

/* The second stack counts from the end, which is known now. */
SLI_INLINE void sli_stacks_settle(const sli_stacks *k, sl_int s, const sl_int *side, sl_off base,
                                  sl_off *begin) {
    begin[s] += base + ((side[s] & 1) == 0 ? 0 : k->most);
}

/* Inside their tasks the supernodes of a worker use the same two stacks, task after task; the roots
 * of tasks have to wait for the fronts above and have places of their own, as the fronts above have
 * their own stacks. */
static void sli_plan_waiting(sli_schedule *p, const sl_symbolic *S, const sl_int *side) {
    sli_stacks k;
    sl_int m, s, worker;
    p->waiting = 0;
    for (worker = 0; worker < p->workers; worker++) {
        memset(&k, 0, sizeof k);
        for (m = 0; m < p->n_tasks; m++) {
            k.top[0] = k.top[1] = 0;
            for (s = p->first[m]; s < p->last[m] && p->worker[m] == worker; s++) {
                sli_stacks_push(&k, S, s, side, p->waiting_begin);
            }
        }
        for (m = 0; m < p->n_tasks; m++) {
            for (s = p->first[m]; s < p->last[m] && p->worker[m] == worker; s++) {
                sli_stacks_settle(&k, s, side, p->waiting, p->waiting_begin);
            }
        }
        p->waiting += k.most;
    }
    for (m = 0; m < p->n_tasks; m++) {
        p->waiting_begin[p->last[m]] = p->waiting;
        p->waiting += sli_waiting_size(&S->steps[p->last[m]]);
    }
    memset(&k, 0, sizeof k);
    for (m = 0; m < p->n_tops; m++) {
        sli_stacks_push(&k, S, p->top[m], side, p->waiting_begin);
    }
    for (m = 0; m < p->n_tops; m++) {
        sli_stacks_settle(&k, p->top[m], side, p->waiting, p->waiting_begin);
    }
    p->waiting += k.most;
}

/* Subtrees of at most limit flops whose parent has more, in ascending order of flops. */
static void sli_find_tasks(sli_schedule *p, const sli_forest *f, sli_planning *w, double limit) {
    const double scale = limit > 0.0 ? 1e9 / limit : 0.0;
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

/* The largest tasks first, each to the worker who has least. */
static void sli_share_tasks(sli_schedule *p, const sli_forest *f, sli_planning *w) {
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

/* Tasks and tops for p->workers. w->flops: of the fronts, where there is more than one worker. */
static void sli_plan_tasks(sli_schedule *p, const sli_forest *f, sli_planning *w) {
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
    sli_find_tasks(p, f, w, total / ((double)p->workers * SLI_TASKS_A_WORKER));
    sli_share_tasks(p, f, w);
}

/* Plans for p->workers. The arrays of p and w have room. */
static void sli_schedule_fill(sli_schedule *p, const sl_symbolic *S, sli_planning *w) {
    const sli_forest f = {S->n_supers, S->super_parent, S->descendant};
    sl_int s, m;
    for (s = 0; s < S->n_supers; s++) {
        w->flops[s] = sli_front_flops(&S->steps[s]);
    }
    sli_plan_tasks(p, &f, w);
    for (s = S->n_supers - 1; s >= 0; s--) {
        w->side[s] = S->super_parent[s] == -1 ? 2 : 3 - (w->side[S->super_parent[s]] & 1);
    }
    for (m = 0; m < p->n_tops; m++) {
        w->side[p->top[m]] &= 1;
    }
    sli_plan_waiting(p, S, w->side);
}

static void sli_schedule_layout(sli_schedule *p, sli_block *b, sl_int count) {
    const uint64_t fronts = (uint64_t)count, tasks = p->workers == 1 ? 1 : fronts;
    p->first = SLI_TAKE(b, sl_int, tasks);
    p->last = SLI_TAKE(b, sl_int, tasks);
    p->worker = SLI_TAKE(b, sl_int, tasks);
    p->top = SLI_TAKE(b, sl_int, p->workers == 1 ? 0 : fronts);
    p->waiting_begin = SLI_TAKE(b, sl_off, fronts);
}

static void sli_planning_layout(sli_planning *w, sli_block *b, sl_int count, sl_int workers) {
    w->flops = SLI_TAKE(b, double, count);
    w->load = SLI_TAKE(b, double, workers);
    w->side = SLI_TAKE(b, sl_int, count);
    w->order = SLI_TAKE(b, uint64_t, count);
    w->scratch = SLI_TAKE(b, uint64_t, count);
}

#endif
/* end src/impl/schedule.h */
/* begin src/impl/symbolic.h */
/* symbolic.h: the analysis, from the pattern of A to the places of L */
#ifndef SLI_SYMBOLIC_H
#define SLI_SYMBOLIC_H

/* What the analysis needs only while it runs. Rows are numbered three times: as in A, in the order
 * that was asked for (rows, columns), and in the postorder of the supernodes that comes of it
 * (everything else). */
typedef struct sli_analysis {
    sl_int n;
    sli_half rows, columns;
    sli_groups groups;
    sl_int *perm;                       /* n: the order asked for */
    sl_int *old_of, *new_of;            /* n: from the last numbering to the one before, and back */
    sl_int *parent, *counts, *super_of; /* n each */
    sl_int *scratch;                    /* 5n */
    uint64_t *list;                     /* 2n */
} sli_analysis;

static void sli_analysis_layout(sli_analysis *w, sli_block *b, sl_int rows, sl_int nnz) {
    const uint64_t n = (uint64_t)rows; /* 5 n may pass 2^32 */
    w->n = rows;
    w->rows.begin = SLI_TAKE(b, sl_int, n + 1);
    w->rows.to = SLI_TAKE(b, sl_int, nnz);
    w->rows.from = SLI_TAKE(b, sl_int, nnz);
    w->columns.begin = SLI_TAKE(b, sl_int, n + 1);
    w->columns.to = SLI_TAKE(b, sl_int, nnz);
    w->perm = SLI_TAKE(b, sl_int, n);
    w->old_of = SLI_TAKE(b, sl_int, n);
    w->new_of = SLI_TAKE(b, sl_int, n);
    w->parent = SLI_TAKE(b, sl_int, n);
    w->counts = SLI_TAKE(b, sl_int, n);
    w->super_of = SLI_TAKE(b, sl_int, n);
    w->scratch = SLI_TAKE(b, sl_int, 5 * n);
    w->groups.first = SLI_TAKE(b, sl_int, n + 1);
    w->groups.parent = SLI_TAKE(b, sl_int, n);
    w->groups.width = SLI_TAKE(b, sl_int, n);
    w->groups.below = SLI_TAKE(b, sl_int, n);
    w->groups.zeros = SLI_TAKE(b, double, n);
    w->groups.group = SLI_TAKE(b, sl_int, n);
    w->list = SLI_TAKE(b, uint64_t, 2 * n);
}

static void sli_symbolic_layout(sl_symbolic *S, sli_block *b, sl_off rows, sl_off entries) {
    const size_t n = (size_t)S->n, supers = (size_t)S->n_supers;
    (void)sli_take(b, 1, sizeof(sl_symbolic));
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
    S->descendant = SLI_TAKE(b, sl_int, supers);
    S->places = SLI_TAKE(b, sl_int, rows);
    S->map_begin = SLI_TAKE(b, sl_off, supers + 1);
    S->map_from = SLI_TAKE(b, sl_int, entries);
    S->map_to = SLI_TAKE(b, sl_off, entries);
}

/* Tree, counts and supernodes in their final numbering. */
static void sli_analyse_tree(sli_analysis *w, const sl_options *opt, sl_stats *stats) {
    const sl_int n = w->n;
    sl_int *order = w->scratch, *more = w->scratch + n;
    sl_int k;
    sli_order_natural(n, w->old_of);
    sli_etree(n, &w->rows, w->parent, order);
    sli_postorder(w->parent, n, order, more, more + n);
    sli_relabel(order, n, w->old_of, w->new_of, w->parent, more);
    sli_counts(n, &w->columns, w->old_of, w->new_of, w->parent, w->counts, w->scratch);
    sli_fundamental(n, w->parent, w->counts, more, w->super_of, &w->groups);
    stats->supernodes_fundamental = w->groups.count;
    if (opt == NULL || opt->relaxation != SL_RELAXATION_NONE) {
        sli_relax(&w->groups, order, more, w->list, w->list + n);
    }
    order = (sl_int *)(void *)w->list; /* renumbering needs all of scratch */
    sli_renumber_groups(&w->groups, n, order, w->super_of, w->scratch);
    for (k = 0; k < n; k++) {
        w->scratch[k] = w->counts[order[k]];
    }
    if (n > 0) {
        memcpy(w->counts, w->scratch, (size_t)n * sizeof(sl_int));
    }
    sli_relabel(order, n, w->old_of, w->new_of, w->parent, w->scratch);
}

/* The figures that a user asks about. depth: n of scratch. */
static void sli_analyse_stats(const sl_symbolic *S, sl_int *depth, sl_stats *stats) {
    sl_int k;
    stats->n = S->n;
    stats->supernodes = S->n_supers;
    stats->nnz_panels = S->panel_begin[S->n_supers];
    for (k = S->n - 1; k >= 0; k--) {
        const double count = S->counts[k];
        depth[k] = S->parent[k] == -1 ? 1 : depth[S->parent[k]] + 1;
        stats->tree_height = sli_max(stats->tree_height, depth[k]);
        stats->components += S->parent[k] == -1;
        stats->nnz_l += S->counts[k];
        stats->flops += count * count;
    }
}

/* Copies the tree out of the workspace and fills everything that hangs on it. */
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
    memcpy(S->super_first, w->groups.first, ((size_t)S->n_supers + 1) * sizeof(sl_int));
    memcpy(S->super_parent, w->groups.parent, (size_t)S->n_supers * sizeof(sl_int));
    S->rows_begin[0] = 0;
    S->panel_begin[0] = 0;
    for (s = 0; s < S->n_supers; s++) {
        S->rows_begin[s + 1] = S->rows_begin[s] + w->groups.below[s];
        S->panel_begin[s + 1] =
            S->panel_begin[s] + sli_panel_size(w->groups.width[s], w->groups.below[s]);
    }
    /* list has 4n words of 4 bytes: the ends of the rows in one half, the marks in the other */
    sli_count_map(S, &w->columns, w->old_of);
    sli_fill_structure(S, &w->rows, w->old_of, w->new_of, (sl_off *)(void *)w->list,
                       (sl_int *)(void *)(w->list + S->n));
    sli_fill_steps(S);
    sli_fill_descendants(S);
    sli_fill_places(S, w->scratch);
    sli_analyse_stats(S, w->scratch, stats);
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
    status = sli_order(A, stats->triangle, opt, w->perm, w->scratch, a, stats);
    stats->seconds_order = sli_seconds() - started;
    if (status != SL_OK) {
        return status;
    }
    started = sli_seconds();
    for (s = 0; s < w->n; s++) {
        w->scratch[w->perm[s]] = s;
    }
    sli_halves_fill(A, stats->triangle, w->scratch, &w->rows, &w->columns);
    stats->nnz_a = w->rows.begin[w->n];
    stats->seconds_tree = -sli_seconds();
    sli_analyse_tree(w, opt, stats);
    stats->seconds_tree += sli_seconds();
    memset(&draft, 0, sizeof draft);
    draft.allocator = *a;
    draft.n = A->n_cols;
    draft.n_supers = w->groups.count;
    draft.nnz_input = sli_nnz(A);
    draft.fingerprint = sli_fingerprint(A);
    for (s = 0; s < w->groups.count; s++) {
        rows += w->groups.below[s];
    }
    for (pass = 0; pass < 2 && status == SL_OK; pass++) {
        sli_symbolic_layout(&draft, &b, rows, stats->nnz_a);
        stats->bytes_symbolic = b.used;
        status = pass == 0 ? sli_block_alloc(&b, a) : SL_OK;
    }
    if (status != SL_OK) {
        return status;
    }
    stats->seconds_structure = -sli_seconds();
    sli_symbolic_fill(&draft, w, stats);
    stats->seconds_structure += sli_seconds();
    stats->seconds_analyse += sli_seconds() - started;
    draft.stats = *stats;
    *out = (sl_symbolic *)(void *)b.base;
    **out = draft;
    return SL_OK;
}

/* Copies the symbolic group from one struct to the other. */
static void sli_symbolic_stats_copy(const sl_stats *from, sl_stats *to) {
    to->n = from->n;
    to->triangle = from->triangle;
    to->nnz_a = from->nnz_a;
    to->nnz_l = from->nnz_l;
    to->nnz_panels = from->nnz_panels;
    to->flops = from->flops;
    to->supernodes = from->supernodes;
    to->supernodes_fundamental = from->supernodes_fundamental;
    to->tree_height = from->tree_height;
    to->components = from->components;
    to->seconds_order = from->seconds_order;
    to->seconds_analyse = from->seconds_analyse;
    to->seconds_tree = from->seconds_tree;
    to->seconds_structure = from->seconds_structure;
    to->bytes_symbolic = from->bytes_symbolic;
}

SL_API sl_status sl_symbolic_create(sl_symbolic **out, const sl_csc *A, const sl_options *opt,
                                    sl_stats *stats) {
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
    if (A->n_rows != A->n_cols || !sli_allocator_is_whole(opt) ||
        (opt != NULL && opt->relaxation != SL_RELAXATION_DEFAULT &&
         opt->relaxation != SL_RELAXATION_NONE)) {
        return SL_ERR_ARGUMENT;
    }
    memset(&w, 0, sizeof w);
    memset(&found, 0, sizeof found);
    sli_stats_clear_error(&found);
    status = sli_csc_triangle(A, &found.triangle, opt, stats);
    for (pass = 0; pass < 2 && status == SL_OK; pass++) {
        sli_analysis_layout(&w, &b, A->n_cols, sli_nnz(A));
        status = pass == 0 ? sli_block_alloc(&b, &a) : SL_OK;
    }
    if (status == SL_OK) {
        found.seconds_analyse = sli_seconds() - started;
        status = sli_symbolic_make(out, A, opt, &w, &a, &found);
        if (stats != NULL && status == SL_OK) {
            sli_symbolic_stats_copy(&found, stats);
        } else if (stats != NULL) {
            stats->error_row = found.error_row;
        }
        sli_free(&a, b.base);
    }
    return status;
}

SL_API void sl_symbolic_free(sl_symbolic *S) {
    if (S != NULL) {
        const sl_allocator a = S->allocator;
        sli_free(&a, S);
    }
}

SL_API void sl_symbolic_stats(const sl_symbolic *S, sl_stats *stats) {
    sli_stats_clear_error(stats);
    if (S != NULL && stats != NULL) {
        sli_symbolic_stats_copy(&S->stats, stats);
    }
}

SL_API sl_symbolic_view_t sl_symbolic_view(const sl_symbolic *S) {
    sl_symbolic_view_t v;
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
    }
    return v;
}

#endif
/* end src/impl/symbolic.h */
/* begin src/impl/reach.h */
/* reach.h: the columns that a set of rows touches: the elimination tree's paths from them to the roots */
#ifndef SLI_REACH_H
#define SLI_REACH_H

/* A reach, compiled for the kernels: its supernodes ascending, each from the first column needed,
 * and the places of their rows in a vector that holds the reach's columns alone. */
typedef struct sli_reach {
    sl_int count;           /* supernodes */
    sl_int columns;         /* length of the vector */
    sl_int tallest, widest; /* largest height and width, for the scratch */
    sl_off n_rows;          /* length of rows */
    sl_off entries;         /* doubles of L that a sweep reads */
    const sli_step *steps;  /* count */
    const sl_int *rows;     /* n_rows, step after step */
} sli_reach;

/* The reach of everything: what the analysis holds already. */
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

/* Where paths end before the roots of the tree: a forest of whole subtrees, and a boundary that holds
 * at least all rows of L below it. Of a reach inside it the boundary is the end of the vector. */
typedef struct sli_fence {
    sl_int n_roots;
    const sl_int *roots; /* ascending: the supernodes that the subtrees hang from */
    sl_int n_rows;
    const sl_int *rows; /* ascending: the boundary, columns of L */
} sli_fence;

/* The subtree that holds supernode s, or -1. */
SLI_INLINE sl_int sli_fence_find(const sl_symbolic *S, const sli_fence *fence, sl_int s) {
    const sl_int at = sli_lower_bound(fence->roots, fence->n_roots, s);
    return at < fence->n_roots && S->descendant[fence->roots[at]] <= s ? at : -1;
}

/* The place of a column in the boundary, or -1. */
SLI_INLINE sl_int sli_fence_boundary(const sli_fence *fence, sl_int column) {
    const sl_int at = sli_lower_bound(fence->rows, fence->n_rows, column);
    return at < fence->n_rows && fence->rows[at] == column ? at : -1;
}

/* One past the last supernode of the paths from s on, which is inside; fence NULL: the whole tree. */
SLI_INLINE sl_int sli_fence_end(const sl_symbolic *S, const sli_fence *fence, sl_int s) {
    return fence == NULL ? S->n_supers
                         : fence->roots[sli_lower_bound(fence->roots, fence->n_roots, s)] + 1;
}

/* The supernode where the climb from the k-th seed must stop: the next one that holds a seed. In a
 * postorder the first ancestor at or after it is on the next seed's own path, so that paths join
 * without a mark on any column. */
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

/* Doubles of L that a sweep reads of a panel it enters at a tile. */
SLI_INLINE sl_off sli_entries_from(sl_int width, sl_int below, sl_int first_tile) {
    return sli_panel_size(width, below) - sli_tile_offset(width, first_tile) -
           (sl_off)SLI_TILE * SLI_TILE * first_tile * (sli_tiles(width + below) - first_tile);
}

/* Adds the supernodes of column k's path below supernode `high` that have no descendant at or before
 * `low`. */
static void sli_reach_climb(const sl_symbolic *S, sl_int k, sl_int low, sl_int high, sli_reach *R) {
    sl_int s = S->super_of[k];
    while (s != -1 && s < high && S->descendant[s] > low) {
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

/* Adds what column k brings to a reach: the supernodes of its path up to where it meets the path of
 * the nearest column of the reach before it or behind it; -1 for none. Exact are supernodes, rows,
 * height and width; columns are those of whole supernodes, and entries leave out that k may enter
 * what it shares at an earlier tile. O(supernodes added). */
static void sli_reach_add(const sl_symbolic *S, sl_int k, sl_int before, sl_int behind,
                          sli_reach *R) {
    sli_reach_climb(S, k, before < 0 ? -1 : S->super_of[before],
                    behind < 0 ? S->n_supers : S->super_of[behind], R);
}

/* Counts the supernodes and rows of the reach of seeds, columns of L, ascending, inside a fence or, where
 * that is NULL, to the roots. O(reach). */
static void sli_reach_measure_within(const sl_symbolic *S, const sli_fence *fence,
                                     const uint64_t *seeds, sl_int count, sli_reach *R) {
    sl_int k, low = -1;
    memset(R, 0, sizeof *R);
    for (k = 0; k < count; k++) {
        const sl_int s = S->super_of[sli_key(seeds[k])];
        sli_reach_climb(S, sli_key(seeds[k]), low, sli_fence_end(S, fence, s), R);
        low = s;
    }
    R->columns += fence == NULL ? 0 : fence->n_rows;
}

static void sli_reach_measure(const sl_symbolic *S, const uint64_t *seeds, sl_int count,
                              sli_reach *R) {
    sli_reach_measure_within(S, NULL, seeds, count, R);
}

/* Adds supernode s, which a seed or children on the waiting list enter; its parent is not in the reach
 * unless it is below supernode `end`. The list is threaded through `up` of the steps whose parent has
 * not come yet; its top waits for the smallest supernode. */
static void sli_reach_enter(const sl_symbolic *S, sli_step *steps, sl_int at, sl_int s, sl_int seed,
                            sl_int end, sl_int *waiting) {
    const sl_int first = S->super_first[s];
    sli_step *step = &steps[at];
    sl_int column = seed;
    while (*waiting != -1 && S->super_parent[S->super_of[steps[*waiting].column]] == s) {
        sli_step *child = &steps[*waiting];
        const sl_int c = S->super_of[child->column];
        column = sli_min(column, S->rows[S->rows_begin[c]]);
        *waiting = child->up;
        child->up = at;
    }
    step->panel = S->panel_begin[s];
    step->first_tile = (column - first) / SLI_TILE;
    step->column = first + SLI_TILE * step->first_tile;
    step->width = S->super_first[s + 1] - first;
    step->below = (sl_int)(S->rows_begin[s + 1] - S->rows_begin[s]);
    step->up = -1;
    if (S->super_parent[s] != -1 && S->super_parent[s] < end) {
        step->up = *waiting;
        *waiting = at;
    }
}

/* The last of the steps low..high that starts at or before a row; one does. Steps ascend. */
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

#define SLI_CLIMB 8 /* ancestors that cost about what a look-up among a few thousand steps costs */

/* The first `inside` rows of a step to places in the vector: the rows ascend, and so do the ancestors
 * that own them. The owner of the next row is mostly a few ancestors up; where it is not, climbing on
 * would make a tree of one long branch quadratic, so that it is looked up among all `count` steps. */
static void sli_reach_places(const sl_int *rows, sl_int inside, const sli_step *steps, sl_int count,
                             sl_int at, sl_int *places) {
    sl_int i = 0;
    while (i < inside) {
        sl_int end, shift, climbed = 0;
        do {
            at = climbed++ < SLI_CLIMB ? steps[at].up
                                       : sli_reach_find(steps, at + 1, count - 1, rows[i]);
            end = steps[at].column + sli_step_columns(&steps[at]);
        } while (rows[i] >= end);
        shift = steps[at].base - steps[at].column;
        for (; i < inside && rows[i] < end; i++) {
            places[i] = rows[i] + shift;
        }
    }
}

/* Rows of a boundary that begins at `base` to places in the vector: both ascend. */
static void sli_fence_places(const sli_fence *fence, sl_int base, const sl_int *rows, sl_int count,
                             sl_int *places) {
    sl_int i, at = 0;
    for (i = 0; i < count; i++) {
        at += sli_lower_bound(fence->rows + at, fence->n_rows - at, rows[i]);
        places[i] = base + at;
    }
}

/* Compiles the reach of seeds; sli_reach_measure_within tells the room it takes. O(reach), times a
 * logarithm where rows skip many ancestors and for rows in the boundary. */
static void sli_reach_fill_within(const sl_symbolic *S, const sli_fence *fence,
                                  const uint64_t *seeds, sl_int count, sli_step *steps,
                                  sl_int *rows, sli_reach *R) {
    sl_int k = 0, at = 0, waiting = -1, s, next, end;
    memset(R, 0, sizeof *R);
    while (k < count) {
        sl_int seed = sli_key(seeds[k]);
        s = S->super_of[seed];
        end = sli_fence_end(S, fence, s);
        next = sli_min(sli_next_seed(S, seeds, count, &k), end);
        for (; s != -1 && s < next; s = S->super_parent[s]) {
            sli_reach_enter(S, steps, at++, s, seed, end, &waiting);
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
        if (fence != NULL) {
            inside = sli_lower_bound(from, below, S->super_first[sli_fence_end(S, fence, own)]);
            sli_fence_places(fence, R->columns, from + inside, below - inside,
                             rows + R->n_rows + inside);
        }
        sli_reach_places(from, inside, steps, R->count, at, rows + R->n_rows);
        R->n_rows += below;
    }
    R->columns += fence == NULL ? 0 : fence->n_rows;
    R->steps = steps;
    R->rows = rows;
}

static void sli_reach_fill(const sl_symbolic *S, const uint64_t *seeds, sl_int count,
                           sli_step *steps, sl_int *rows, sli_reach *R) {
    sli_reach_fill_within(S, NULL, seeds, count, steps, rows, R);
}

/* The place of a column in the reach's vector. *at, 0 at first, remembers the step for the next
 * column, which is not smaller. */
SLI_INLINE sl_int sli_reach_place(const sli_reach *R, sl_int *at, sl_int column) {
    while (column >= R->steps[*at].column + sli_step_columns(&R->steps[*at])) {
        ++*at;
    }
    return column - R->steps[*at].column + R->steps[*at].base;
}

/* The place of any column in the reach's vector, -1 where it has none. */
static sl_int sli_reach_place_of(const sli_reach *R, sl_int column) {
    const sli_step *step;
    if (R->count == 0) {
        return -1;
    }
    step = &R->steps[sli_reach_find(R->steps, 0, R->count - 1, column)];
    return column >= step->column && column < step->column + sli_step_columns(step)
               ? step->base + column - step->column
               : -1;
}

/* A walk over the supernodes that two reaches share: set up by sli_meeting_of, then sli_meet until it
 * gives 0. */
typedef struct sli_meeting {
    const sli_step *a, *a_end, *b, *b_end;
    sl_int count;      /* columns shared of the supernode at hand */
    sl_int column;     /* the first of them, and */
    sl_int in_a, in_b; /* its places in the two vectors */
} sli_meeting;

SLI_INLINE sli_meeting sli_meeting_of(const sli_reach *a, const sli_reach *b) {
    sli_meeting m;
    memset(&m, 0, sizeof m);
    m.a = a->steps;
    m.a_end = a->steps + a->count;
    m.b = b->steps;
    m.b_end = b->steps + b->count;
    return m;
}

SLI_INLINE int sli_meet(sli_meeting *m) {
    while (m->a < m->a_end && m->b < m->b_end) {
        if (m->a->panel == m->b->panel) { /* a panel belongs to one supernode */
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

#endif
/* end src/impl/reach.h */
/* L4 numbers */
/* begin src/impl/factor_parts.h */
/* factor_parts.h: the factor object, and what both ways to factor share: loading a panel, taking a pivot */
#ifndef SLI_FACTOR_PARTS_H
#define SLI_FACTOR_PARTS_H

/* Where a factorization takes the entries of its matrix from: A, or a sum of arrays in the order of the
 * analysis's map. */
typedef struct sli_source {
    const sl_csc *A;             /* NULL: the sum over t of coefficients[t] values[t] */
    const double *const *values; /* terms arrays of map_begin[n_supers] */
    const double *coefficients;  /* terms */
    sl_int terms;
} sli_source;

/* The first thing that went wrong in a factorization. */
typedef struct sli_failure {
    sl_status status;
    sl_int super; /* the supernode it happened in */
    sl_int pivot; /* the pivot that is null or not finite, or -1 */
    sl_off
        position; /* the entry that is not finite, in the order of the map, or -1: a coefficient */
    double value;
} sli_failure;

struct sl_factor {
    sl_allocator allocator;
    sl_stats stats;       /* the factor group and the error fields */
    const sl_symbolic *S; /* borrowed */
    const sli_kernels *kernels;
    sli_pivot_rule rule;
    sl_definiteness definiteness;
    sl_method method;
    int is_good;         /* L and D hold a factor */
    sl_status status;    /* what the last factorization came to */
    uint64_t generation; /* of the numbers: how often they were begun anew */
    double *L;           /* the panels */
    double *D;           /* n pivots */
    sl_int *
        regularized; /* n: the pivots that regularization changed, ascending; NULL: there is none */
    /* null pivots */
    double consistency; /* what |z' b| may be against the sum of |b|; negative: not looked at */
    int checks;         /* there are null pivots, and solves look whether b is consistent */
    int is_centred;     /* there are null pivots, and solves are centred by mass: */
    sl_int n_nulls;
    sl_int *nulls; /* n: n_nulls null pivots, ascending */
    sl_int n_anchors;
    sl_int *anchors; /* a tree each: the null pivots that weights take care of, ascending */
    double *mass;    /* n, in pivot order; NULL: none */
    double *centre;  /* n: v = D^-1 L^-1 m / z' m */
    double *squares; /* a tree each: v' D v of the one of each anchor */
    double *divide;  /* n: D with 1 for null pivots: x is given there */
    double *centre_scratch;
    double *buffer; /* kernel scratch, for each worker */
    /* multifrontal; what a worker needs stands once for each */
    sl_threads threads;
    sli_schedule schedule;
    double *waiting;       /* schedule.waiting: update matrices on their way to the parents */
    double *magnitude;     /* rows of the tallest front: what its diagonal was made of */
    double *inverse;       /* SLI_FRONT_INVERSE */
    sli_failure *failures; /* one */
    /* up-looking */
    double *x;        /* n: updates on their way up row k; all 0 between rows */
    sl_int *head;     /* n: first supernode whose next row is k, -1 for none */
    sl_int *next;     /* n_supers: the others, as a list */
    sl_int *position; /* n_supers: how many rows below have been done */
    uint64_t *list;   /* n_supers: the reach of row k */
    uint64_t *list_scratch;
};

/* Fills a failure in and returns its status. */
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

/* The column of A that holds position p. */
static sl_int sli_column_of(const sl_csc *A, sl_int p) {
    sl_int low = 0, high = A->n_cols - 1;
    while (low < high) { /* the last column that starts at or before p */
        const sl_int middle = low + (high - low + 1) / 2;
        if (A->p[middle] <= p) {
            low = middle;
        } else {
            high = middle - 1;
        }
    }
    return low;
}

/* Adds the entries first .. last-1 of the map to supernode s's panel: each from its own place in x, or,
 * with map_from NULL, x holds them alone. */
SLI_ALWAYS_INLINE sl_status sli_panel_add_entries(const sl_factor *F, sl_int s, sl_off first,
                                                  sl_off last, const double *x,
                                                  const sl_int *map_from, sli_failure *failure) {
    const sl_off *to = F->S->map_to;
    sl_off m;
    for (m = first; m < last; m++) {
        const double a = map_from != NULL ? x[map_from[m]] : x[m - first];
        if (!sli_is_finite(a)) {
            return sli_fail(failure, SL_ERR_NOT_FINITE, s, -1, m, a);
        }
        F->L[to[m]] += a;
    }
    return SL_OK;
}

#define SLI_SUMMED 64 /* entries that are summed at a time: most supernodes have no more */

/* sums := the entries of the map from first on */
static void sli_source_sum(const sli_source *from, sl_off first, sl_int count, double *sums) {
    sl_int k, t;
    memset(sums, 0, (size_t)count * sizeof(double));
    for (t = 0; t < from->terms; t++) {
        const double c = from->coefficients[t], *v = from->values[t] + first;
        for (k = 0; k < count; k++) {
            const double product = c * v[k]; /* rounded, as in a sum that the caller makes */
            sums[k] += product;
        }
    }
}

/* Adds the matrix's entries to supernode s's panel. */
static sl_status sli_panel_add(const sl_factor *F, const sli_source *from, sl_int s,
                               sli_failure *failure) {
    const sl_symbolic *S = F->S;
    const sl_off end = S->map_begin[s + 1];
    sl_off m = S->map_begin[s], last;
    double sums[SLI_SUMMED];
    sl_status status = SL_OK;
    if (from->A != NULL) {
        return sli_panel_add_entries(F, s, m, end, from->A->x, S->map_from, failure);
    }
    for (; m < end && status == SL_OK; m = last) {
        last = end - m < SLI_SUMMED ? end : m + SLI_SUMMED;
        sli_source_sum(from, m, (sl_int)(last - m), sums);
        status = sli_panel_add_entries(F, s, m, last, sums, NULL, failure);
    }
    return status;
}

/* Refuses a pivot that is not a number or null against what it was made of. */
/* Was pivot k null and skipped? */
SLI_INLINE int sli_is_skipped(const sl_factor *F, sl_int k) {
    return F->definiteness == SL_SEMIDEFINITE && F->D[k] == SLI_NULL_PIVOT;
}

/* Was pivot k changed by regularization? */
SLI_INLINE int sli_is_regularized(const sl_factor *F, sl_int k) {
    return F->rule.shifts != NULL && F->rule.shifts[k] != 0.0;
}

/* Refuses a pivot that is not a number, or null against what it was made of and not replaced. */
SLI_INLINE sl_status sli_check_pivot(const sl_factor *F, sl_int k, double pivot, double magnitude,
                                     sli_failure *failure) {
    if (!sli_is_finite(pivot)) {
        return sli_fail(failure, SL_ERR_NOT_FINITE, F->S->super_of[k], k, -1, pivot);
    }
    if (!F->rule.replaces && sli_is_null(pivot, magnitude, F->rule.null_tolerance)) {
        return sli_fail(failure, SL_ERR_PIVOT, F->S->super_of[k], k, -1, pivot);
    }
    return SL_OK;
}

/* Counts and bounds of the first pivots. */
static void sli_count_pivots(sl_factor *F, sl_int count) {
    sl_stats *stats = &F->stats;
    sl_int k;
    stats->positive = stats->negative = stats->null = stats->regularized = 0;
    stats->pivot_min = stats->pivot_max = 0.0;
    for (k = 0; k < count; k++) {
        const double size = fabs(F->D[k]);
        if (sli_is_skipped(F, k)) {
            stats->null++;
            continue;
        }
        if (sli_is_regularized(F, k)) {
            F->regularized[stats->regularized++] = k;
        }
        if (stats->positive + stats->negative == 0) {
            stats->pivot_min = size;
        }
        stats->positive += F->D[k] > 0.0;
        stats->negative += F->D[k] < 0.0;
        stats->pivot_min = size < stats->pivot_min ? size : stats->pivot_min;
        stats->pivot_max = size > stats->pivot_max ? size : stats->pivot_max;
    }
}

#endif
/* end src/impl/factor_parts.h */
/* begin src/impl/spread.h */
/* spread.h: a matrix spread over the map of the analysis, entry by entry, once for any number of factorizations */
#ifndef SLI_SPREAD_H
#define SLI_SPREAD_H

/* What spreading a matrix K needs. Both sides of the search are sorted by column, the earlier pivot of an
 * entry: there the rows of the map are marked with their places, and those of K look them up. */
typedef struct sli_spreading {
    sl_int *begin; /* n + 1: where each column starts in .. */
    sl_int *from;  /* .. the entries of K that are read, and .. */
    sl_int *to;    /* .. their rows, and at last their places in the map, -1 for none */
    sl_int *place; /* n: where row k of the column at hand stands in the map, -1 between columns */
    sl_int *head;  /* the widest supernode: for each of its columns the first entry of the map .. */
    sl_int *next;  /* .. and the one after each, -1 at the end; the most that one supernode has */
    sl_int *row;   /* the same: its row */
} sli_spreading;

static void sli_spreading_layout(sli_spreading *w, sli_block *b, const sl_symbolic *S,
                                 sl_int entries) {
    sl_off most = 0;
    sl_int s;
    for (s = 0; s < S->n_supers; s++) {
        const sl_off here = S->map_begin[s + 1] - S->map_begin[s];
        most = here > most ? here : most;
    }
    w->begin = SLI_TAKE(b, sl_int, (size_t)S->n + 1);
    w->from = SLI_TAKE(b, sl_int, entries);
    w->to = SLI_TAKE(b, sl_int, entries);
    w->place = SLI_TAKE(b, sl_int, S->n);
    w->head = SLI_TAKE(b, sl_int, S->widest);
    w->next = SLI_TAKE(b, sl_int, most);
    w->row = SLI_TAKE(b, sl_int, most);
}

/* K's entries by columns, each column in the order of K, so that duplicates are summed in it. */
static void sli_spreading_sort(const sl_symbolic *S, sli_spreading *w, const sl_csc *K,
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
    for (j = 0; j < S->n; j++) { /* every begin moves to its end, and back afterwards */
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

/* A supernode's part of the map by columns, ascending in each. */
static void sli_spreading_list(const sl_symbolic *S, sli_spreading *w, sl_int s) {
    const sl_off start = S->map_begin[s];
    sl_int k, j, m, tile = sli_last_tile(S, s);
    for (j = 0; j < S->steps[s].width; j++) {
        w->head[j] = -1;
    }
    for (m = (sl_int)(S->map_begin[s + 1] - start) - 1; m >= 0; m--) {
        sli_map_pivots(S, s, start + m, &tile, &k, &j);
        j -= S->super_first[s];
        w->row[m] = k;
        w->next[m] = w->head[j];
        w->head[j] = m;
    }
}

/* The places of column j's entries of K. Returns the first entry of K so far that has none, or bad. */
static sl_int sli_spreading_find(sli_spreading *w, sl_int j, sl_int head, sl_int start,
                                 sl_int bad) {
    sl_int m, q;
    for (m = head; m != -1; m = w->next[m]) {
        w->place[w->row[m]] = start + m; /* of several for duplicates the last takes all */
    }
    for (q = w->begin[j]; q < w->begin[j + 1]; q++) {
        w->to[q] = w->place[w->to[q]];
        bad = w->to[q] == -1 ? sli_min(bad, w->from[q]) : bad;
    }
    for (m = head; m != -1; m = w->next[m]) {
        w->place[w->row[m]] = -1;
    }
    return bad;
}

/* Every entry's place. Returns the first entry of K that has none, or INT32_MAX. */
static sl_int sli_spreading_find_all(const sl_symbolic *S, sli_spreading *w) {
    sl_int s, j, bad = INT32_MAX;
    for (j = 0; j < S->n; j++) {
        w->place[j] = -1;
    }
    for (s = 0; s < S->n_supers; s++) {
        const sl_int first = S->super_first[s], last = S->super_first[s + 1];
        if (w->begin[first] < w->begin[last]) {
            sli_spreading_list(S, w, s);
            for (j = first; j < last; j++) {
                if (w->begin[j] < w->begin[j + 1]) {
                    bad =
                        sli_spreading_find(w, j, w->head[j - first], (sl_int)S->map_begin[s], bad);
                }
            }
        }
    }
    return bad;
}

SL_API sl_int sl_symbolic_entries(const sl_symbolic *S) {
    return S == NULL ? 0 : (sl_int)S->map_begin[S->n_supers]; /* no more than A has */
}

SL_API sl_status sl_symbolic_spread(const sl_symbolic *S, double *values, const sl_csc *K,
                                    sl_stats *stats) {
    sl_options opt;
    sli_spreading w;
    sli_block b = {NULL, 0, 0};
    sl_triangle triangle = SL_TRIANGLE_NONE;
    sl_int q, bad;
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
    memset(&opt, 0, sizeof opt);
    opt.allocator = S->allocator;
    status = sli_csc_triangle(K, &triangle, &opt, stats);
    for (pass = 0; pass < 2 && status == SL_OK; pass++) {
        sli_spreading_layout(&w, &b, S, sli_nnz(K));
        status = pass == 0 ? sli_block_alloc(&b, &S->allocator) : SL_OK;
    }
    if (status != SL_OK) {
        return status;
    }
    sli_spreading_sort(S, &w, K, triangle);
    bad = sli_spreading_find_all(S, &w);
    if (bad == INT32_MAX) {
        for (q = 0; q < sl_symbolic_entries(S); q++) {
            values[q] = 0.0;
        }
        for (q = 0; q < w.begin[S->n]; q++) {
            values[w.to[q]] += K->x[w.from[q]];
        }
    } else {
        status = sli_fail_at(stats, SL_ERR_PATTERN, K->i[bad], sli_column_of(K, bad), K->x[bad]);
    }
    sli_free(&S->allocator, b.base);
    return status;
}

#endif
/* end src/impl/spread.h */
/* begin src/impl/uplooking.h */
/* uplooking.h: the up-looking factorization: row k of L is a sparse triangular solve over the reach of row k of A */
#ifndef SLI_UPLOOKING_H
#define SLI_UPLOOKING_H

/* Hangs supernode s onto the list of its next row, if it has one. */
static void sli_wait_for_row(sl_factor *F, sl_int s) {
    const sl_off at = F->S->rows_begin[s] + F->position[s];
    if (at < F->S->rows_begin[s + 1]) {
        const sl_int k = F->S->rows[at];
        F->next[s] = F->head[k];
        F->head[k] = s;
    }
}

/* Row q of supernode s, local numbering; see sli_row_kernel. */
static void sli_do_row(sl_factor *F, sl_int s, sl_int q, double *pivot, double *magnitude) {
    const sl_symbolic *S = F->S;
    const sl_int first = S->super_first[s];
    F->kernels->row(F->L + S->panel_begin[s], S->steps[s].width, q, S->rows + S->rows_begin[s],
                    F->D + first, F->x + first, F->x, F->buffer, pivot, magnitude);
}

/* Row k: the supernodes that wait for it, in ascending order so that descendants come first, then
 * its own. */
static void sli_do_all_rows(sl_factor *F, sl_int k, double *pivot, double *magnitude) {
    const sl_symbolic *S = F->S;
    const sl_int own = S->super_of[k];
    sl_int s, m, count = 0;
    for (s = F->head[k]; s != -1; s = F->next[s]) {
        F->list[count++] = sli_keyed(s, 0);
    }
    sli_sort(F->list, count, F->list_scratch);
    for (m = 0; m < count; m++) {
        s = sli_key(F->list[m]);
        sli_do_row(F, s, S->steps[s].width + F->position[s], pivot, magnitude);
        F->position[s]++;
        sli_wait_for_row(F, s);
    }
    if (k > S->super_first[own]) {
        sli_do_row(F, own, k - S->super_first[own], pivot, magnitude);
    }
}

/* The whole factorization. The matrix fits the analysis. [LDL05], [Davis06] 4.7 */
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
        double *panel = F->L + S->panel_begin[s], *diagonal, pivot, magnitude;
        if (q == 0) {
            const sl_off size = S->panel_begin[s + 1] - S->panel_begin[s];
            memset(panel, 0, (size_t)size * sizeof(double));
            status = sli_panel_add(F, from, s, failure);
            if (status != SL_OK) {
                break;
            }
        }
        diagonal = panel + sli_panel_at(S->steps[s].width, q, q);
        pivot = *diagonal;
        magnitude = fabs(pivot);
        *diagonal = 0.0;
        sli_do_all_rows(F, k, &pivot, &magnitude);
        pivot = F->rule.replaces ? sli_pivot_ruled(&F->rule, k, pivot, magnitude) : pivot;
        F->D[k] = pivot;
        status = sli_check_pivot(F, k, pivot, magnitude, failure);
        if (q == S->steps[s].width - 1) {
            F->position[s] = 0;
            sli_wait_for_row(F, s);
        }
    }
    return status;
}

#endif
/* end src/impl/uplooking.h */
/* begin src/impl/multifrontal.h */
/* multifrontal.h: the supernodal factorization: front by front, each handing its update matrix to its parent */
#ifndef SLI_MULTIFRONTAL_H
#define SLI_MULTIFRONTAL_H

/* One call's worth of work for several workers: the subtrees that they do by themselves, then a front
 * above them in which each takes some row tiles. */
typedef struct sli_job {
    sl_factor *F;
    const sli_source *from;
    sl_int super, group; /* the front, and its group of column tiles */
    sli_front front;
} sli_job;

static sli_front sli_front_of(const sl_factor *F, sl_int s, sl_int worker) {
    const sli_step *step = &F->S->steps[s];
    const sl_int rows = SLI_TILE * sli_tiles(F->S->tallest);
    sli_front f;
    f.panel = F->L + step->panel;
    f.width = step->width;
    f.below = step->below;
    f.update = F->waiting + F->schedule.waiting_begin[s];
    f.D = F->D + step->column;
    f.magnitude = F->magnitude + (ptrdiff_t)worker * rows;
    f.inverse = F->inverse + (ptrdiff_t)worker * SLI_FRONT_INVERSE;
    f.rule = &F->rule;
    f.column = step->column;
    return f;
}

SLI_INLINE sl_int sli_front_tiles(const sli_front *f) {
    return sli_tiles(f->width + f->below);
}

/* Clears row tiles t0 .. t1-1 of a front. */
static void sli_front_clear(const sli_front *f, sl_int t0, sl_int t1) {
    const sl_int w = f->width, whole = w / SLI_TILE, u0 = sli_max(t0 - whole, 0);
    const sl_off from = sli_tile_offset(w, t0), size = sli_tile_offset(w, t1) - from;
    memset(f->panel + from, 0, (size_t)size * sizeof(double));
    if (f->below > 0 && t1 > whole) {
        const sl_off at = sli_triangle_offset(u0), end = sli_triangle_offset(t1 - whole);
        memset(f->update + at, 0, (size_t)(end - at) * sizeof(double));
    }
}

/* The matrix's entries onto the cleared panel, and what its diagonal is made of so far. */
static sl_status sli_front_load(sl_factor *F, const sli_source *from, const sli_front *f, sl_int s,
                                sli_failure *failure) {
    const sl_status status = sli_panel_add(F, from, s, failure);
    sl_int k;
    for (k = 0; k < f->width; k++) {
        f->magnitude[k] = fabs(f->panel[sli_panel_at(f->width, k, k)]);
    }
    for (; k < SLI_TILE * sli_front_tiles(f); k++) {
        f->magnitude[k] = 0.0;
    }
    return status;
}

/* What the children hand over to row tiles t0 .. t1-1, the last child first. */
static void sli_front_assemble(const sl_factor *F, const sli_front *f, sl_int s, sl_int t0,
                               sl_int t1) {
    const sl_symbolic *S = F->S;
    sl_int c, k;
    for (c = s - 1; c >= S->descendant[s]; c = S->descendant[c] - 1) {
        const sli_step *child = &S->steps[c];
        const sl_int *places = S->places + S->rows_begin[c];
        const double *from = F->waiting + F->schedule.waiting_begin[c];
        const double *magnitude = from + child->width % SLI_TILE +
                                  sli_triangle_offset(sli_update_tiles(child->width, child->below));
        const sl_int first = sli_lower_bound(places, child->below, SLI_TILE * t0);
        const sl_int last = sli_lower_bound(places, child->below, SLI_TILE * t1);
        F->kernels->assemble(f, from, child->width % SLI_TILE, places, child->below, first, last);
        for (k = first; k < last; k++) {
            f->magnitude[places[k]] += magnitude[k];
        }
    }
}

/* The magnitudes of the rows below go where the update matrix waits. */
static void sli_front_hand_over(const sli_front *f) {
    const sl_int tiles = sli_update_tiles(f->width, f->below);
    memcpy(f->update + sli_triangle_offset(tiles),
           f->magnitude + SLI_TILE * (ptrdiff_t)(f->width / SLI_TILE),
           SLI_TILE * (size_t)tiles * sizeof(double));
}

/* A null pivot that nothing was done about is a failure. */
static sl_status sli_front_check(const sl_factor *F, const sli_front *f, sl_int s,
                                 sli_failure *failure) {
    const sl_int first = F->S->steps[s].column;
    sl_status status = SL_OK;
    sl_int k;
    for (k = 0; k < f->width && status == SL_OK; k++) {
        status = sli_check_pivot(F, first + k, f->D[k], f->magnitude[k], failure);
    }
    return status;
}

/* The panel of a front, from A and all updates to L. */
static void sli_front_eliminate(const sli_kernels *kernels, const sli_front *f, double *scratch) {
    const sl_int tiles = sli_front_tiles(f), ends = sli_tiles(f->width);
    sl_int c0;
    for (c0 = 0; c0 < ends; c0 += SLI_GROUP) {
        kernels->pivots(f, c0, scratch);
        kernels->rows(f, c0, sli_min(c0 + SLI_GROUP, ends), tiles, scratch);
    }
}

/* The update matrix of a front, from what the children handed over to what the parent gets. */
static void sli_front_update(const sli_kernels *kernels, const sli_front *f, double *scratch) {
    const sl_int whole = f->width / SLI_TILE, tiles = sli_front_tiles(f);
    if (f->below > 0) {
        kernels->update(f, whole, tiles, whole, tiles, scratch);
    }
}

/* The whole of supernode s's front by one worker. */
static sl_status sli_front_alone(sl_factor *F, const sli_source *from, sl_int s, sl_int worker,
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
    sli_front_assemble(F, &f, s, 0, tiles);
    sli_front_eliminate(F->kernels, &f, scratch);
    sli_front_update(F->kernels, &f, scratch);
    sli_front_hand_over(&f);
    return sli_front_check(F, &f, s, failure);
}

/* Worker k's subtrees. A failure ends its subtree only: the first failure of all must be found. */
static void sli_do_tasks(void *data, sl_int k) {
    const sli_job *job = (const sli_job *)data;
    const sli_schedule *plan = &job->F->schedule;
    sl_int m, s;
    for (m = 0; m < plan->n_tasks; m++) {
        sli_failure failure;
        sl_status status = SL_OK;
        if (plan->worker[m] != k) {
            continue;
        }
        for (s = plan->first[m]; s <= plan->last[m] && status == SL_OK; s++) {
            status = sli_front_alone(job->F, job->from, s, k, &failure);
            if (status != SL_OK) {
                sli_keep_first_failure(&job->F->failures[k], &failure);
            }
        }
    }
}

static void sli_shared_clear(void *data, sl_int k) {
    const sli_job *job = (const sli_job *)data;
    const sl_int workers = job->F->schedule.workers, tiles = sli_front_tiles(&job->front);
    sli_front_clear(&job->front, sli_part(0, tiles, k, workers, 1),
                    sli_part(0, tiles, k + 1, workers, 1));
}

static void sli_shared_assemble(void *data, sl_int k) {
    const sli_job *job = (const sli_job *)data;
    const sl_int workers = job->F->schedule.workers, tiles = sli_front_tiles(&job->front);
    sli_front_assemble(job->F, &job->front, job->super, sli_part(0, tiles, k, workers, 1),
                       sli_part(0, tiles, k + 1, workers, 1));
}

static void sli_shared_rows(void *data, sl_int k) {
    const sli_job *job = (const sli_job *)data;
    const sl_factor *F = job->F;
    const sl_int workers = F->schedule.workers, tiles = sli_front_tiles(&job->front);
    const sl_int c1 = sli_min(job->group + SLI_GROUP, sli_tiles(job->front.width));
    F->kernels->rows(&job->front, job->group, sli_part(c1, tiles, k, workers, 0),
                     sli_part(c1, tiles, k + 1, workers, 0),
                     F->buffer + (ptrdiff_t)k * sli_front_scratch(F->S->widest));
}

static void sli_shared_update(void *data, sl_int k) {
    const sli_job *job = (const sli_job *)data;
    const sl_factor *F = job->F;
    const sl_int workers = F->schedule.workers, tiles = sli_front_tiles(&job->front);
    const sl_int whole = job->front.width / SLI_TILE;
    F->kernels->update(&job->front, whole, tiles, sli_part(whole, tiles, k, workers, 1),
                       sli_part(whole, tiles, k + 1, workers, 1),
                       F->buffer + (ptrdiff_t)k * sli_front_scratch(F->S->widest));
}

/* The whole of a front by all workers. */
static sl_status sli_front_shared(sli_job *job, sli_failure *failure) {
    sl_factor *F = job->F;
    const sl_threads *threads = &F->threads;
    const sl_int workers = F->schedule.workers;
    sl_status status;
    job->front = sli_front_of(F, job->super, 0);
    sli_parallel(threads, workers, sli_shared_clear, job);
    status = sli_front_load(F, job->from, &job->front, job->super, failure);
    if (status != SL_OK) {
        return status;
    }
    sli_parallel(threads, workers, sli_shared_assemble, job);
    for (job->group = 0; job->group < sli_tiles(job->front.width); job->group += SLI_GROUP) {
        F->kernels->pivots(&job->front, job->group, F->buffer);
        sli_parallel(threads, workers, sli_shared_rows, job);
    }
    if (job->front.below > 0) {
        sli_parallel(threads, workers, sli_shared_update, job);
    }
    sli_front_hand_over(&job->front);
    return sli_front_check(F, &job->front, job->super, failure);
}

/* The whole factorization. The matrix fits the analysis. [DR83], [Liu92] */
static sl_status sli_multifrontal(sl_factor *F, const sli_source *from, sli_failure *failure) {
    const sli_schedule *plan = &F->schedule;
    sli_job job;
    sl_int m, k;
    memset(&job, 0, sizeof job);
    job.F = F;
    job.from = from;
    for (k = 0; k < plan->workers; k++) {
        F->failures[k].status = SL_OK;
    }
    sli_parallel(&F->threads, plan->workers, sli_do_tasks, &job);
    for (k = 0; k < plan->workers; k++) {
        sli_keep_first_failure(failure, &F->failures[k]);
    }
    for (m = 0; m < plan->n_tops; m++) {
        sli_failure here;
        here.status = SL_OK;
        job.super = plan->top[m];
        if (failure->status != SL_OK && failure->super < job.super) {
            break; /* the fronts before a failure may fail before it */
        }
        if (sli_front_flops(&F->S->steps[job.super]) >= SLI_SHARED_FLOPS) {
            (void)sli_front_shared(&job, &here);
        } else {
            (void)sli_front_alone(F, from, job.super, 0, &here);
        }
        sli_keep_first_failure(failure, &here);
    }
    return failure->status;
}

#endif
/* end src/impl/multifrontal.h */
/* begin src/impl/leftlooking.h */
/* leftlooking.h: supernodes factored again by pulling from all their descendants: for changes that reach few of them */
#ifndef SLI_LEFTLOOKING_H
#define SLI_LEFTLOOKING_H

/* What pulling needs while it runs. */
typedef struct sli_pulling {
    sl_int *local;  /* n: local rows in the supernode at hand; elsewhere it means nothing */
    sl_int *places; /* rows of the tallest front: those of a descendant in it */
} sli_pulling;

static void sli_pulling_layout(sli_pulling *p, sli_block *b, const sl_symbolic *S) {
    p->local = SLI_TAKE(b, sl_int, S->n);
    p->places = SLI_TAKE(b, sl_int, S->tallest);
}

/* What descendant d takes from supernode s: its rows from number `first` on are rows of s, the ones
 * before `last` are columns of s. */
static void sli_pull(sl_factor *F, const sli_pulling *p, const sli_front *f, sl_int d, sl_int first,
                     sl_int last) {
    const sl_symbolic *S = F->S;
    const sl_int *rows = S->rows + S->rows_begin[d];
    sli_front from = sli_front_of(F, d, 0);
    const sl_int w = from.width, tiles = sli_front_tiles(&from);
    const sl_int c0 = (w + first) / SLI_TILE, c1 = sli_tiles(w + last);
    sl_int t, r, j;
    from.update = F->waiting; /* no other update matrix is under way */
    for (t = c0; t < tiles; t++) {
        memset(from.update + sli_triangle_offset(t - c0), 0,
               (size_t)sli_min(t + 1 - c0, c1 - c0) * SLI_TILE * SLI_TILE * sizeof(double));
    }
    F->kernels->update(&from, c0, c1, c0, tiles, F->buffer);
    for (r = first; r < from.below; r++) {
        p->places[r - first] = p->local[rows[r]];
    }
    F->kernels->assemble(f, from.update, (w + first) % SLI_TILE, p->places, last - first, 0,
                         from.below - first);
    for (r = first; r < last; r++) { /* |l d l| of the pivots to come */
        const double *l = from.panel + sli_panel_at(w, w + r, 0);
        for (j = 0; j < w; j++) {
            f->magnitude[p->places[r - first]] +=
                fabs(l[SLI_TILE * (ptrdiff_t)j] * l[SLI_TILE * (ptrdiff_t)j] * from.D[j]);
        }
    }
}

/* Supernode s from A and its descendants, parents before children: those that have no row among the
 * columns of s have no descendant with one. */
static sl_status sli_left_looking(sl_factor *F, const sli_pulling *p, const sli_source *from,
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
    for (d = s - 1; d >= S->descendant[s];) {
        const sl_int *of = S->rows + S->rows_begin[d], below = S->steps[d].below;
        const sl_int first = sli_lower_bound(of, below, start);
        const sl_int last = first + sli_lower_bound(of + first, below - first, end);
        if (first < last) {
            sli_pull(F, p, &f, d, first, last);
            d--;
        } else {
            d = S->descendant[d] - 1;
        }
    }
    sli_front_eliminate(F->kernels, &f, F->buffer);
    return sli_front_check(F, &f, s, failure);
}

/* Every supernode on the way from the seeds, columns of L in ascending order, to the roots. */
static sl_status sli_left_looking_all(sl_factor *F, const sli_pulling *p, const sli_source *from,
                                      const uint64_t *seeds, sl_int count, sli_failure *failure) {
    const sl_symbolic *S = F->S;
    sl_status status = SL_OK;
    sl_int k = 0, s, next;
    while (k < count && status == SL_OK) {
        s = S->super_of[sli_key(seeds[k])];
        next = sli_next_seed(S, seeds, count, &k);
        for (; s != -1 && s < next && status == SL_OK; s = S->super_parent[s]) {
            status = sli_left_looking(F, p, from, s, failure);
        }
    }
    return status;
}

#endif
/* end src/impl/leftlooking.h */
/* begin src/impl/nullspace.h */
/* nullspace.h: null pivots in solves: is a right-hand side consistent, and the solution that is centred by weights */
#ifndef SLI_NULLSPACE_H
#define SLI_NULLSPACE_H

/* A null pivot k, skipped, has the null vector z = P' L^-T e_k, 1 in its own row, and z' b = (L^-1 P b)(k): the
 * forward sweep tells by how much b fails to be consistent.
 *
 * Centred solves, in a component (a tree) with one null pivot and weights m: of A x = b - c m with c = z' b / z' m the x
 * with m' x = 0. With w = L^-1 P m / z' m and y = L^-1 P b that is P x = L^-T (D^+ (y - c' w) + t e_k), c' = y(k),
 * t = - w' D^+ (y - c' w): a dot product over the columns of the forward sweep, a difference over those of the
 * backward sweep, both in their vectors. Kept are v = D^+ w and, for each component, w' D^+ w. Columns that a local solve leaves out are exact zeros in the dot product of the full
 * one, so that both have the same bits. */

/* The weights in pivot order. A component without any, such as a vertex without a face, gets 1 for each row. */
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
        if (S->parent[k] == -1) { /* in a postorder a tree ends at its root */
            for (; first <= k; first++) {
                F->mass[first] = any ? F->mass[first] : 1.0;
            }
            any = 0;
        }
    }
    return SL_OK;
}

/* flags(k): 1 where row k of L has an entry that is not 0, else 0. */
static void sli_rows_used(const sl_factor *F, double *flags) {
    const sl_symbolic *S = F->S;
    sl_int s, r, j;
    memset(flags, 0, (size_t)S->n * sizeof(double));
    for (s = 0; s < S->n_supers; s++) {
        const sli_step *step = &S->steps[s];
        const double *panel = F->L + step->panel;
        for (r = 1; r < step->width + step->below; r++) {
            const sl_int row =
                r < step->width ? step->column + r : S->rows[S->rows_begin[s] + r - step->width];
            for (j = 0; j < sli_min(r, step->width); j++) {
                flags[row] = panel[sli_panel_at(step->width, r, j)] != 0.0 ? 1.0 : flags[row];
            }
        }
    }
}

/* The null pivot of each tree whose vector the weights tell apart. A row of zeros, as of a vertex whose faces are all
 * degenerate, is a component by itself: its row of L is empty, its x is 0. Besides those a tree may have one. */
static sl_status sli_anchors_make(sl_factor *F, sli_failure *failure) {
    const sl_symbolic *S = F->S;
    double *used = F->divide;
    int is_known = 0;
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
        } else if (m - first > 1 && !is_known) {
            sli_rows_used(F, used);
            is_known = 1;
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

/* v on the columns of one tree, first .. root, which hold w z'm; total: the sum of |m| there; m: the number of its anchor,
 * if it has one. */
static sl_status sli_centre_tree(sl_factor *F, sl_int first, sl_int root, double total, sl_int m,
                                 sli_failure *failure) {
    const sl_int anchor = m < F->n_anchors ? F->anchors[m] : F->S->n;
    double *v = F->centre, a, sum = 0.0;
    sl_int k;
    if (anchor > root) {
        memset(v + first, 0, ((size_t)(root - first) + 1) * sizeof(double));
        return SL_OK;
    }
    a = v[anchor];
    if (!sli_is_finite(a) || !(fabs(a) > F->S->n * DBL_EPSILON * total)) {
        return sli_fail(failure, SL_ERR_ARGUMENT, F->S->super_of[anchor], anchor, -1, a);
    }
    for (k = first; k <= root; k++) {
        const double w = v[k] / a;
        v[k] = sli_is_skipped(F, k) ? 0.0 : w / F->D[k];
        sum += w * v[k];
    }
    F->divide[anchor] = 1.0;
    F->squares[m] = sum;
    return SL_OK;
}

/* v and what else centring needs, by one forward sweep. */
static sl_status sli_centre_make(sl_factor *F, sli_failure *failure) {
    const sl_symbolic *S = F->S;
    const sli_reach all = sli_reach_all(S);
    sl_status status = sli_anchors_make(F, failure);
    double total = 0.0;
    sl_int k, first = 0, m = 0;
    memcpy(F->divide, F->D, (size_t)S->n * sizeof(double));
    memcpy(F->centre, F->mass, (size_t)S->n * sizeof(double));
    F->kernels->forward[SLI_LANES_1](all.count, all.steps, all.rows, F->L, F->centre,
                                     F->centre_scratch);
    for (k = 0; k < S->n && status == SL_OK; k++) {
        total += fabs(F->mass[k]);
        if (S->parent[k] == -1) {
            status = sli_centre_tree(F, first, k, total, m, failure);
            m += m < F->n_anchors && F->anchors[m] <= k;
            total = 0.0;
            first = k + 1;
        }
    }
    return status;
}

/* What solves need to know of null pivots, once a factor is made. */
static sl_status sli_nulls_make(sl_factor *F, sli_failure *failure) {
    sl_int k;
    F->n_nulls = 0;
    for (k = 0; k < F->S->n; k++) {
        if (sli_is_skipped(F, k)) {
            F->nulls[F->n_nulls++] = k;
        }
    }
    F->is_centred = F->mass != NULL && F->n_nulls > 0;
    F->checks = F->mass == NULL && F->n_nulls > 0 && F->consistency >= 0.0;
    return F->is_centred ? sli_centre_make(F, failure) : SL_OK;
}

/* Sums over the columns of a step, from a whole tile on, in 8 chains so that none waits for another: number f of the
 * step's doubles goes to chain f % 8, in a local sweep as in the full one. Called with constant lanes. */
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
        for (q = 0; q < SLI_TILE; q++) { /* sum(r) += v(k) y(k, r) */
            chains[q] += v[q / lanes] * row[f + q];
        }
    }
    for (q = 0; f < count; q++) {
        chains[q] += v[q / lanes] * row[f++];
    }
}

/* The chains of each lane, one after the other. */
static void sli_chains_sum(const double *chains, sl_int lanes, double *sums) {
    sl_int q;
    for (q = 0; q < lanes; q++) {
        sums[q] = chains[q];
    }
    for (; q < SLI_TILE; q++) {
        sums[q % lanes] += chains[q];
    }
}

/* Calls a body for a constant number of lanes. */
#define SLI_FOR_LANES(lanes, call)                                                                 \
    if ((lanes) == 1) {                                                                            \
        call(1);                                                                                   \
    } else if ((lanes) == 2) {                                                                     \
        call(2);                                                                                   \
    } else if ((lanes) == 4) {                                                                     \
        call(4);                                                                                   \
    } else {                                                                                       \
        call(8);                                                                                   \
    }

/* norms(r) = sum of |b| in a packed block of right-hand sides */
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

/* The columns of the tree whose root is step s of a reach. */
typedef struct sli_tree {
    sl_int first, root;
} sli_tree;

SLI_INLINE sli_tree sli_tree_of(const sl_symbolic *S, const sli_step *root) {
    const sl_int super = S->super_of[root->column];
    sli_tree tree;
    tree.first = S->super_first[S->descendant[super]];
    tree.root = S->super_first[super + 1] - 1;
    return tree;
}

/* After the forward sweep: is |z' b| small at every null pivot? A NaN passes, and so does what overflows: they show in
 * x. */
static int sli_is_consistent(const sl_factor *F, const sli_reach *R, const double *y, sl_int lanes,
                             const double *norms) {
    sl_int s, m, r;
    for (s = 0; s < R->count; s++) {
        sli_tree tree;
        if (R->steps[s].up != -1) {
            continue;
        }
        tree = sli_tree_of(F->S, &R->steps[s]);
        for (m = sli_lower_bound(F->nulls, F->n_nulls, tree.first);
             m < F->n_nulls && F->nulls[m] <= tree.root; m++) {
            const sl_int at = sli_reach_place_of(R, F->nulls[m]);
            for (r = 0; at != -1 && r < lanes; r++) {
                if (fabs(y[(ptrdiff_t)at * lanes + r]) > F->consistency * norms[r]) {
                    return 0;
                }
            }
        }
    }
    return 1;
}

/* What centring takes from one tree of the forward sweep. */
typedef struct sli_shares {
    double c[SLI_TILE], t[SLI_TILE];
} sli_shares;

/* The tree that begins at step s; returns the step after its root. m: the number of its anchor, or -1. */
static sl_int sli_centre_ask(const sl_factor *F, const sli_reach *R, sl_int s, const double *y,
                             sl_int lanes, sl_int *m, sli_tree *tree, sli_shares *share) {
    double chains[SLI_TILE], sums[SLI_TILE];
    sl_int r, at, up = s;
    memset(share, 0, sizeof *share);
    memset(chains, 0, sizeof chains);
    while (up != -1) {
        const sli_step *step = &R->steps[s++];
        const double *v = F->centre + step->column, *row = y + (ptrdiff_t)step->base * lanes;
        const sl_int columns = sli_step_columns(step);
#define SLI_CALL(constant) sli_chains_dot(chains, v, row, columns, constant)
        SLI_FOR_LANES(lanes, SLI_CALL)
#undef SLI_CALL
        up = step->up;
    }
    *tree = sli_tree_of(F->S, &R->steps[s - 1]);
    *m = sli_lower_bound(F->anchors, F->n_anchors, tree->first);
    if (*m == F->n_anchors || F->anchors[*m] > tree->root) {
        *m = -1;
        return s;
    }
    at = sli_reach_place_of(R, F->anchors[*m]);
    if (at != -1) {
        memcpy(share->c, y + (ptrdiff_t)at * lanes, (size_t)lanes * sizeof(double));
    }
    sli_chains_sum(chains, lanes, sums);
    for (r = 0; r < lanes; r++) {
        share->t[r] = share->c[r] * F->squares[*m] - sums[r];
    }
    return s;
}

/* y - c w on the columns of a step of the backward sweep. Called with constant lanes. */
SLI_ALWAYS_INLINE void sli_centre_give(double *row, const double *v, const double *D,
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

/* Between the sweeps: y in the columns of the one reach, x, which may be y, in those of the other. Trees ascend in both;
 * where b has no row there is nothing to do. */
static void sli_centre(const sl_factor *F, const sli_reach *from, const double *y,
                       const sli_reach *to, double *x, sl_int lanes) {
    sl_int s = 0, at = 0, m;
    while (s < from->count && at < to->count) {
        sli_shares share;
        sli_tree tree;
        sl_int place;
        s = sli_centre_ask(F, from, s, y, lanes, &m, &tree, &share);
        for (; at < to->count && to->steps[at].column <= tree.root; at++) {
            const sli_step *step = &to->steps[at];
            const double *v = F->centre + step->column, *D = F->D + step->column;
            double *row = x + (ptrdiff_t)step->base * lanes;
            const sl_int columns = sli_step_columns(step);
            if (m != -1 && step->column >= tree.first) {
#define SLI_CALL(constant) sli_centre_give(row, v, D, columns, share.c, constant)
                SLI_FOR_LANES(lanes, SLI_CALL)
#undef SLI_CALL
            }
        }
        place = m != -1 ? sli_reach_place_of(to, F->anchors[m]) : -1;
        if (place != -1) { /* x is given there */
            memcpy(x + (ptrdiff_t)place * lanes, share.t, (size_t)lanes * sizeof(double));
        }
    }
}

#undef SLI_FOR_LANES

#endif
/* end src/impl/nullspace.h */
/* begin src/impl/factor.h */
/* factor.h: the factor object: the method and the memory, factoring, factoring again, release */
#ifndef SLI_FACTOR_H
#define SLI_FACTOR_H

static void sli_factor_layout(sl_factor *F, sli_block *b) {
    const sl_symbolic *S = F->S;
    const size_t n = (size_t)S->n, supers = (size_t)S->n_supers;
    const uint64_t workers = (uint64_t)F->schedule.workers;
    (void)sli_take(b, 1, sizeof(sl_factor));
    F->D = SLI_TAKE(b, double, n);
    if (F->rule.regularization != 0.0) {
        F->rule.signs = SLI_TAKE(b, signed char, n);
        F->rule.shifts = SLI_TAKE(b, double, n);
        F->regularized = SLI_TAKE(b, sl_int, n);
    }
    if (F->definiteness == SL_SEMIDEFINITE) {
        F->nulls = SLI_TAKE(b, sl_int, n);
    }
    if (F->is_centred) {
        F->anchors = SLI_TAKE(b, sl_int, S->stats.components);
        F->squares = SLI_TAKE(b, double, S->stats.components);
        F->mass = SLI_TAKE(b, double, n);
        F->centre = SLI_TAKE(b, double, n);
        F->divide = SLI_TAKE(b, double, n);
        F->centre_scratch = SLI_TAKE(b, double, sli_scratch_size(S->tallest, S->widest, 1));
    }
    if (F->method == SL_METHOD_SUPERNODAL) {
        const uint64_t rows = SLI_TILE * (uint64_t)sli_tiles(S->tallest);
        F->buffer = SLI_TAKE(b, double, workers *(uint64_t)sli_front_scratch(S->widest));
        F->magnitude = SLI_TAKE(b, double, workers *rows);
        F->inverse = SLI_TAKE(b, double, workers *SLI_FRONT_INVERSE);
        F->failures = SLI_TAKE(b, sli_failure, workers);
        sli_schedule_layout(&F->schedule, b, S->n_supers);
    } else {
        F->buffer = SLI_TAKE(b, double, sli_scratch_size(S->tallest, 0, 1));
        F->x = SLI_TAKE(b, double, n);
        F->head = SLI_TAKE(b, sl_int, n);
        F->next = SLI_TAKE(b, sl_int, supers);
        F->position = SLI_TAKE(b, sl_int, supers);
        F->list = SLI_TAKE(b, uint64_t, supers);
        F->list_scratch = SLI_TAKE(b, uint64_t, supers);
    }
    F->L = SLI_TAKE(b, double, S->panel_begin[S->n_supers]);
}

/* Who does what, in a supernodal factorization, and the memory for what is under way. */
static sl_status sli_factor_schedule(sl_factor *F) {
    const sl_symbolic *S = F->S;
    sli_block b = {NULL, 0, 0};
    sli_planning w;
    sl_status status = SL_OK;
    int pass;
    for (pass = 0; pass < 2 && status == SL_OK; pass++) {
        sli_planning_layout(&w, &b, S->n_supers, F->schedule.workers);
        status = pass == 0 ? sli_block_alloc(&b, &F->allocator) : SL_OK;
    }
    if (status == SL_OK) {
        sli_schedule_fill(&F->schedule, S, &w);
        sli_free(&F->allocator, b.base);
        b.base = NULL;
        b.used = 0;
        for (pass = 0; pass < 2 && status == SL_OK; pass++) {
            F->waiting = SLI_TAKE(&b, double, F->schedule.waiting);
            F->stats.bytes_factor += pass == 0 ? b.used : 0;
            status = pass == 0 ? sli_block_alloc(&b, &F->allocator) : SL_OK;
        }
    }
    return status;
}

/* Whether A can be the matrix that S was made from. */
static sl_status sli_factor_check(const sl_symbolic *S, const sl_csc *A) {
    if (A == NULL || (A->n_cols > 0 && A->p == NULL)) {
        return SL_ERR_ARGUMENT;
    }
    if (A->n_rows != S->n || A->n_cols != S->n || sli_nnz(A) != S->nnz_input) {
        return SL_ERR_PATTERN;
    }
    if (S->nnz_input > 0 && (A->i == NULL || A->x == NULL)) {
        return SL_ERR_ARGUMENT;
    }
    return sli_fingerprint(A) == S->fingerprint ? SL_OK : SL_ERR_PATTERN;
}

static void sli_factor_stats_copy(const sl_stats *from, sl_stats *to) {
    to->isa = from->isa;
    to->method = from->method;
    to->positive = from->positive;
    to->negative = from->negative;
    to->null = from->null;
    to->pivot_min = from->pivot_min;
    to->pivot_max = from->pivot_max;
    to->seconds_setup = from->seconds_setup;
    to->seconds_factor = from->seconds_factor;
    to->bytes_factor = from->bytes_factor;
    to->regularized = from->regularized;
}

/* What is not finite: an entry, where it stands in A or in the lower triangle of a sum, or a coefficient. */
static void sli_factor_tell_entry(sl_factor *F, const sl_csc *A, const sli_failure *f) {
    const sl_symbolic *S = F->S;
    sl_int row = -1, column = -1;
    if (f->position < 0) { /* a coefficient: it has no place */
    } else if (A != NULL) {
        const sl_int p = S->map_from[f->position];
        row = A->i[p];
        column = sli_column_of(A, p);
    } else {
        sl_int k, j, tile = sli_last_tile(S, f->super);
        sli_map_pivots(S, f->super, f->position, &tile, &k, &j);
        row = sli_max(S->perm[k], S->perm[j]);
        column = sli_min(S->perm[k], S->perm[j]);
    }
    sli_fail_at(&F->stats, f->status, row, column, f->value);
}

/* Pivots in numbers, and a failure in the caller's rows. */
static void sli_factor_tell(sl_factor *F, const sl_csc *A, const sli_failure *f) {
    sl_int good = F->S->n; /* pivots before the failure */
    if (f->status != SL_OK && f->pivot >= 0) {
        good = f->pivot;
        sli_fail_at(&F->stats, f->status, F->S->perm[f->pivot], -1, f->value);
    } else if (f->status != SL_OK) {
        good = F->S->super_first[f->super];
        sli_factor_tell_entry(F, A, f);
    }
    sli_count_pivots(F, good);
    F->stats.null += f->status == SL_ERR_PIVOT;
}

static void sli_factor_stats_tell(const sl_factor *F, sl_stats *stats) {
    sli_factor_stats_copy(&F->stats, stats);
    stats->error_row = F->stats.error_row;
    stats->error_column = F->stats.error_column;
    stats->error_value = F->stats.error_value;
}

/* What a factorization came to, for the caller and for F itself. */
static sl_status sli_factor_done(sl_factor *F, const sl_csc *A, sli_failure *failure,
                                 double started, sl_stats *stats) {
    sli_stats_clear_error(&F->stats);
    if (failure->status == SL_OK && F->definiteness == SL_SEMIDEFINITE) {
        (void)sli_nulls_make(F, failure);
    }
    sli_factor_tell(F, A, failure);
    F->stats.seconds_factor = sli_seconds() - started;
    F->is_good = failure->status == SL_OK;
    F->status = failure->status;
    if (stats != NULL) {
        sli_factor_stats_tell(F, stats);
    }
    return failure->status;
}

/* The numbers of a matrix that fits the analysis. */
static sl_status sli_factor_numbers(sl_factor *F, const sli_source *from, double started,
                                    sl_stats *stats) {
    sli_failure failure;
    sl_int t;
    memset(&failure, 0, sizeof failure);
    for (t = 0; t < from->terms && failure.status == SL_OK; t++) {
        if (!sli_is_finite(from->coefficients[t])) {
            (void)sli_fail(&failure, SL_ERR_NOT_FINITE, 0, -1, -1, from->coefficients[t]);
        }
    }
    if (failure.status == SL_OK) {
        (void)(F->method == SL_METHOD_SUPERNODAL ? sli_multifrontal(F, from, &failure)
                                                 : sli_uplooking(F, from, &failure));
    }
    return sli_factor_done(F, from->A, &failure, started, stats);
}

static sli_source sli_source_matrix(const sl_csc *A) {
    sli_source from = {NULL, NULL, NULL, 0};
    from.A = A;
    return from;
}

/* Before the numbers change: whatever was made of them is out of date, even if this fails. */
static void sli_factor_begin(sl_factor *F) {
    F->is_good = 0;
    F->generation++;
}

SL_API sl_status sl_factor_refactor(sl_factor *F, const sl_csc *A, sl_stats *stats) {
    const double started = sli_seconds();
    const sli_source from = sli_source_matrix(A);
    sl_status status;
    sli_stats_clear_error(stats);
    if (F == NULL) {
        return SL_ERR_ARGUMENT;
    }
    sli_factor_begin(F);
    status = sli_factor_check(F->S, A);
    return status == SL_OK ? sli_factor_numbers(F, &from, started, stats) : status;
}

/* The columns of L in which the entries of some columns of A stand, sorted. Returns how many. */
static sl_int sli_changed_seeds(const sl_symbolic *S, const sl_csc *A, const sl_int *columns,
                                sl_int count, uint64_t *seeds, uint64_t *scratch) {
    sl_int k, p, total = 0;
    for (k = 0; k < count; k++) {
        const sl_int j = S->iperm[columns[k]];
        sl_int least = INT32_MAX;
        for (p = A->p[columns[k]]; p < A->p[columns[k] + 1]; p++) {
            const sl_int seed = sli_min(j, S->iperm[A->i[p]]);
            if (seed != least) { /* most entries of a column go where the one before went */
                seeds[total++] = sli_keyed(seed, 0);
                least = seed;
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
    sli_pulling pulling;
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
    if (!F->is_good) {
        return SL_ERR_STATE;
    }
    status = sli_factor_check(F->S, A);
    if (status != SL_OK) {
        return status;
    }
    for (k = 0; k < count; k++) {
        if (columns[k] < 0 || columns[k] >= F->S->n) {
            return sli_fail_at(stats, SL_ERR_ARGUMENT, columns[k], -1, 0.0);
        }
        entries += (uint64_t)(A->p[columns[k] + 1] - A->p[columns[k]]);
    }
    if (F->method != SL_METHOD_SUPERNODAL || entries >= (uint64_t)sli_nnz(A)) {
        return sl_factor_refactor(F, A, stats);
    }
    for (pass = 0; pass < 2 && status == SL_OK; pass++) {
        seeds = SLI_TAKE(&b, uint64_t, entries);
        scratch = SLI_TAKE(&b, uint64_t, entries);
        sli_pulling_layout(&pulling, &b, F->S);
        status = pass == 0 ? sli_block_alloc(&b, &F->allocator) : SL_OK;
    }
    if (status != SL_OK) {
        return status;
    }
    memset(&failure, 0, sizeof failure);
    sli_factor_begin(F);
    count = sli_changed_seeds(F->S, A, columns, count, seeds, scratch);
    (void)sli_left_looking_all(F, &pulling, &from, seeds, count, &failure);
    sli_free(&F->allocator, b.base);
    return sli_factor_done(F, A, &failure, started, stats);
}

/* The last pivot of a singular Laplacian is what rounding left of it: over meshes, grids and paths
 * of 1e2 to 1e6 rows it came to less than 60 + n/16 units of rounding, while no pivot of a regular
 * one fell below 1e9. */
static double sli_null_tolerance(sl_int n) {
    return (64.0 + n / 8) * DBL_EPSILON;
}

/* Are the method, the definiteness and the number of threads such as exist, the tolerances numbers? What is
 * null is either skipped or regularized. */
static int sli_way_is_known(const sl_options *opt) {
    return opt == NULL || ((unsigned)opt->method <= (unsigned)SL_METHOD_SUPERNODAL &&
                           (unsigned)opt->definiteness <= (unsigned)SL_SEMIDEFINITE &&
                           opt->threads.count >= 0 && opt->null_tolerance == opt->null_tolerance &&
                           opt->consistency_tolerance == opt->consistency_tolerance &&
                           opt->regularization >= 0.0 && sli_is_finite(opt->regularization) &&
                           (opt->regularization == 0.0 || opt->definiteness == SL_DEFINITE));
}

/* What the options say about null pivots, but for the arrays, which come later. */
static void sli_factor_rules(sl_factor *F, const sl_options *opt) {
    const double null = opt == NULL ? 0.0 : opt->null_tolerance;
    const double consistency = opt == NULL ? 0.0 : opt->consistency_tolerance;
    F->definiteness = opt == NULL ? SL_DEFINITE : opt->definiteness;
    F->rule.null_tolerance = null == 0.0 ? sli_null_tolerance(F->S->n) : null;
    F->rule.regularization = opt == NULL ? 0.0 : opt->regularization;
    F->rule.replaces = F->definiteness == SL_SEMIDEFINITE || F->rule.regularization != 0.0;
    F->consistency = consistency == 0.0 ? 1e-6 : consistency;
    F->is_centred = F->definiteness == SL_SEMIDEFINITE && opt->mass != NULL;
}

/* Copies the arrays that the rules refer to. */
static sl_status sli_factor_rules_fill(sl_factor *F, const sl_options *opt, sl_stats *stats) {
    const sl_symbolic *S = F->S;
    sl_int i;
    if (F->rule.regularization != 0.0 && opt->signs == NULL) {
        F->rule.signs = NULL;
    } else if (F->rule.regularization != 0.0) {
        for (i = 0; i < S->n; i++) {
            if (opt->signs[i] < -1 || opt->signs[i] > 1) {
                return sli_fail_at(stats, SL_ERR_ARGUMENT, i, -1, (double)opt->signs[i]);
            }
            F->rule.signs[S->iperm[i]] = (signed char)opt->signs[i];
        }
    }
    return F->mass != NULL ? sli_mass_fill(F, opt->mass, stats) : SL_OK;
}

/* A front costs some 50 ns whatever is in it: below this many flops each, as in diagonal matrices and
 * stars, rows are faster by up to 3.5 times; above it fronts are, by 1.1 to 6 times. */
static sl_method sli_method(const sl_symbolic *S, const sl_options *opt) {
    if (opt != NULL && opt->method != SL_METHOD_AUTO) {
        return opt->method;
    }
    return S->stats.flops < 8.0 * S->n_supers ? SL_METHOD_UP_LOOKING : SL_METHOD_SUPERNODAL;
}

/* Are the wishes for a factor such as can be followed? */
static int sli_factor_wishes_are_sound(const sl_options *opt) {
    return sli_allocator_is_whole(opt) && sli_way_is_known(opt);
}

/* A factor with its memory and its schedule, without numbers. */
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
    sli_factor_rules(&draft, opt);
    draft.method = sli_method(S, opt);
    draft.schedule.workers = 1;
    if (opt != NULL && draft.method == SL_METHOD_SUPERNODAL) {
        draft.threads = opt->threads;
        draft.schedule.workers = sli_min(sli_workers(&opt->threads), sli_max(S->n_supers, 1));
    }
    draft.kernels = sli_kernels_select(opt == NULL ? SL_ISA_AUTO : opt->isa);
    if (draft.kernels == NULL) {
        return SL_ERR_UNSUPPORTED;
    }
    for (pass = 0; pass < 2 && status == SL_OK; pass++) {
        sli_factor_layout(&draft, &b);
        draft.stats.bytes_factor = b.used;
        status = pass == 0 ? sli_block_alloc(&b, &a) : SL_OK;
    }
    if (status == SL_OK) {
        sl_factor *F = (sl_factor *)(void *)b.base;
        draft.stats.isa = draft.kernels->isa;
        draft.stats.method = draft.method;
        *F = draft;
        if (F->method == SL_METHOD_SUPERNODAL) {
            status = sli_factor_schedule(F);
        }
        status = status == SL_OK ? sli_factor_rules_fill(F, opt, stats) : status;
        F->stats.seconds_setup = sli_seconds() - started;
        if (status == SL_OK) {
            *out = F;
        } else {
            sl_factor_free(F);
        }
    }
    return status;
}

/* A factor of a matrix that fits the analysis. *out is NULL on entry. */
static sl_status sli_factor_make(sl_factor **out, const sl_symbolic *S, const sli_source *from,
                                 const sl_options *opt, sl_stats *stats) {
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
    if (S == NULL || !sli_factor_wishes_are_sound(opt)) {
        return SL_ERR_ARGUMENT;
    }
    status = sli_factor_check(S, A);
    return status == SL_OK ? sli_factor_make(out, S, &from, opt, stats) : status;
}

SL_API void sl_factor_free(sl_factor *F) {
    if (F != NULL) {
        const sl_allocator a = F->allocator;
        sli_free(&a, F->waiting);
        sli_free(&a, F);
    }
}

#endif
/* end src/impl/factor.h */
/* begin src/impl/factor_ask.h */
/* factor_ask.h: what can be asked of a factor: statistics, the determinant, L as a matrix, a look inside */
#ifndef SLI_FACTOR_ASK_H
#define SLI_FACTOR_ASK_H

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
    if (!F->is_good) {
        return SL_ERR_STATE;
    }
    for (k = 0; k < F->S->n; k++) {
        sum += sli_is_skipped(F, k) ? 0.0 : log(fabs(F->D[k]));
    }
    *log_abs_det = sum;
    *sign = F->stats.negative % 2 == 0 ? 1.0 : -1.0;
    return SL_OK;
}

/* Where rows can be listed. */
static sl_status sli_check_list(const sl_factor *F, const sl_int *rows, sl_int most,
                                const sl_int *count) {
    if (F == NULL || count == NULL || most < 0 || (most > 0 && rows == NULL)) {
        return SL_ERR_ARGUMENT;
    }
    return F->is_good ? SL_OK : SL_ERR_STATE;
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
    *count = F->stats.regularized;
    for (m = 0; m < sli_min(most, *count); m++) {
        rows[m] = F->S->perm[F->regularized[m]];
        if (shifts != NULL) {
            shifts[m] = F->rule.shifts[F->regularized[m]];
        }
    }
    return SL_OK;
}

/* Entries of L: the nonzero places of the panels and the unit diagonal. M NULL: only counts them.
 */
static sl_off sli_factor_entries(const sl_factor *F, sl_matrix *M) {
    const sl_symbolic *S = F->S;
    sl_int s, j, r;
    sl_off count = 0;
    for (s = 0; s < S->n_supers; s++) {
        const sl_int first = S->super_first[s], width = S->steps[s].width,
                     height = width + S->steps[s].below;
        for (j = 0; j < width; j++) {
            for (r = j; r < height; r++) {
                const double l = r == j ? 1.0 : F->L[S->panel_begin[s] + sli_panel_at(width, r, j)];
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
    if (F == NULL || !sli_allocator_is_whole(opt)) {
        return SL_ERR_ARGUMENT;
    }
    if (!F->is_good) {
        return SL_ERR_STATE;
    }
    count = sli_factor_entries(F, NULL);
    if (count > INT32_MAX) {
        return SL_ERR_TOO_LARGE;
    }
    status = sli_matrix_new(out, F->S->n, F->S->n, (sl_int)count, 1, &a);
    if (status == SL_OK) {
        (*out)->p[0] = 0;
        (void)sli_factor_entries(F, *out);
    }
    return status;
}

SL_API sl_factor_view_t sl_factor_view(const sl_factor *F) {
    sl_factor_view_t v = {NULL, NULL, NULL};
    if (F != NULL) {
        v.symbolic = F->S;
        v.L = F->L;
        v.D = F->D;
    }
    return v;
}

#endif
/* end src/impl/factor_ask.h */
/* begin src/impl/region_parts.h */
/* region_parts.h: the region object, and what a sweep that ends there needs: the product with the cached inverse */
#ifndef SLI_REGION_PARTS_H
#define SLI_REGION_PARTS_H

/* Let T be whole subtrees of the elimination tree and S, the boundary, contain the rows of L below them. For b
 * on T and S, y = L_TT^-1 b_T and u = b_S - L_ST y are what a forward sweep inside T leaves, and
 *
 *     x_S = Z_SS u, Z = A^-1,
 *
 * is where the backward sweep inside T starts: all that is above T is in Z_SS. It is kept as N with
 * Z_SS = N + N', N lower triangular with half of the diagonal, in chunks of columns, and -N stands in the
 * places below the diagonal block of a panel whose own columns are 0. What a step does to the rows below it on
 * the way forward is then a product with N, and what these do to it on the way back one with N': the panel is
 * read twice, the second time from the first cache. */
struct sl_region {
    sl_allocator allocator;
    const sl_symbolic *S; /* borrowed */
    const sl_factor *F;   /* Z is its inverse, and .. */
    uint64_t generation;  /* .. of these numbers of it; 0 for none */
    sli_fence fence;
    sl_int *roots, *rows; /* of the fence */
    sl_int *asked;        /* fence.n_rows: rows of A */
    sl_int inside;        /* rows of A in the subtrees */
    sl_int *places;       /* fence.n_rows: those of the boundary in the product's second vector */
    sl_off *begin;        /* chunks + 1: the panels, in doubles */
    double *Z;
    int is_copied; /* Z is out of a selected inverse */
    double seconds;
    size_t bytes;
};

/* Columns of a chunk: kernels keep all of so few in registers. */
#define SLI_REGION_COLUMNS 8

SLI_INLINE sl_int sli_region_chunks(sl_int rows) {
    return rows / SLI_REGION_COLUMNS + (rows % SLI_REGION_COLUMNS != 0);
}

/* The chunk that begins at column `first` of a boundary, as a step. */
SLI_INLINE sli_step sli_region_step(const sl_region *R, sl_int first) {
    sli_step step;
    step.panel = R->begin[first / SLI_REGION_COLUMNS];
    step.column = 0;
    step.base = first;
    step.width = sli_min(SLI_REGION_COLUMNS, R->fence.n_rows - first);
    step.below = R->fence.n_rows - first;
    step.first_tile = 0;
    step.up = -1;
    return step;
}

static void sli_region_layout(sl_region *R, sli_block *b) {
    const sl_int rows = R->fence.n_rows;
    sl_off size = 0;
    sl_int first;
    (void)sli_take(b, 1, sizeof(sl_region));
    R->roots = SLI_TAKE(b, sl_int, R->fence.n_roots);
    R->rows = SLI_TAKE(b, sl_int, rows);
    R->asked = SLI_TAKE(b, sl_int, rows);
    R->places = SLI_TAKE(b, sl_int, rows);
    R->begin = SLI_TAKE(b, sl_off, (uint64_t)sli_region_chunks(rows) + 1);
    for (first = 0; first < rows; first += SLI_REGION_COLUMNS) {
        size += sli_panel_size(sli_min(SLI_REGION_COLUMNS, rows - first), rows - first);
    }
    R->Z = SLI_TAKE(b, double, size);
    R->bytes = b->used;
}

/* Does Z belong to the numbers that F holds? */
SLI_INLINE int sli_region_fits(const sl_region *R, const sl_factor *F) {
    return R->F == F && R->generation == F->generation;
}

/* Doubles for a product: u, the result, and u again, then the scratch of the kernels. */
SLI_INLINE uint64_t sli_region_vectors(const sl_region *R, sl_int lanes) {
    return 3 * (uint64_t)R->fence.n_rows * (uint64_t)lanes;
}

SLI_INLINE size_t sli_region_scratch(const sl_region *R, sl_int lanes) {
    return sli_scratch_size(SLI_REGION_COLUMNS + R->fence.n_rows, SLI_REGION_COLUMNS, lanes);
}

/* What a plan has to do with a boundary: 1 for each chunk with a row that its forward sweep may leave a number in, or
 * that its backward sweep reads. */
typedef struct sli_shore {
    const unsigned char *b, *x; /* chunks each */
    sl_off entries;             /* doubles of the inverse in those of either kind */
} sli_shore;

/* x := Z_SS u, interleaved, where u and x matter; x may be u. On the way forward a chunk's columns are u and its
 * rows the result; on the way back, where the vector begins one boundary later, its columns are the result and its
 * rows u. */
static void sli_region_apply(const sl_region *R, const sli_shore *shore, const sli_kernels *kernels,
                             int kind, const double *u, double *x, double *vectors,
                             double *scratch) {
    static const double sli_ones[SLI_REGION_COLUMNS] = {1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0};
    const sl_int n = R->fence.n_rows;
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
        if (shore->b[first / SLI_REGION_COLUMNS]) {
            kernels->forward[kind](1, &step, R->places + first, R->Z, vectors, scratch);
        }
        if (shore->x[first / SLI_REGION_COLUMNS]) {
            kernels->backward[kind](1, &step, R->places + n, R->Z, sli_ones, vectors + size,
                                    scratch);
        }
    }
    memcpy(x, vectors + size, size * sizeof(double));
}

#endif
/* end src/impl/region_parts.h */
/* begin src/impl/combination.h */
/* combination.h: factorizations of weighted sums of value arrays that stand in the order of the analysis */
#ifndef SLI_COMBINATION_H
#define SLI_COMBINATION_H

/* A sum as the source of a factorization. */
static sl_status sli_source_of_sum(const sl_symbolic *S, const double *coefficients,
                                   const double *const *values, sl_int terms, sli_source *from) {
    sl_int t;
    if (terms < 0 || (terms > 0 && (coefficients == NULL || values == NULL))) {
        return SL_ERR_ARGUMENT;
    }
    for (t = 0; t < terms; t++) {
        if (values[t] == NULL && S->map_begin[S->n_supers] > 0) {
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
    if (S == NULL || !sli_factor_wishes_are_sound(opt)) {
        return SL_ERR_ARGUMENT;
    }
    status = sli_source_of_sum(S, coefficients, values, terms, &from);
    return status == SL_OK ? sli_factor_make(out, S, &from, opt, stats) : status;
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
    sli_factor_begin(F);
    status = sli_source_of_sum(F->S, coefficients, values, terms, &from);
    return status == SL_OK ? sli_factor_numbers(F, &from, started, stats) : status;
}

#endif
/* end src/impl/combination.h */
/* begin src/impl/work.h */
/* work.h: the workspace: one block of a thread's scratch that only grows */
#ifndef SLI_WORK_H
#define SLI_WORK_H

struct sl_work {
    sl_allocator allocator;
    void *block; /* size bytes, 64-byte aligned; contents live for one call */
    size_t size;
};

/* At least bytes of scratch; what was in it is lost. */
static sl_status sli_work_grow(sl_work *W, size_t bytes) {
    void *block;
    if (bytes <= W->size) {
        return SL_OK;
    }
    block = sli_alloc(&W->allocator, bytes);
    if (block == NULL) {
        return SL_ERR_MEMORY;
    }
    sli_free(&W->allocator, W->block);
    W->block = block;
    W->size = bytes;
    return SL_OK;
}

/* A workspace for one call: nothing yet, and its block to be released at the end. */
static sl_work sli_work_own(const sl_allocator *a) {
    sl_work own;
    own.allocator = *a;
    own.block = NULL;
    own.size = 0;
    return own;
}

/* The base of W, grown to what a layout has counted, for its second run. */
static sl_status sli_work_lay(sl_work *W, sli_block *b) {
    const sl_status status = b->overflow ? SL_ERR_TOO_LARGE : sli_work_grow(W, b->used);
    b->base = (unsigned char *)W->block;
    b->used = 0;
    return status;
}

/* A stage of a call on a workspace: lays its arrays out, then fills them; what q holds after the stages before it
 * tells how large they are. */
typedef struct sli_stage {
    void (*lay)(void *q, sli_block *b);
    void (*fill)(void *q); /* or NULL */
} sli_stage;

/* Runs stages. Where W is too small for one it grows, which loses what is in it, and they begin anew: none may write
 * to the caller's arrays. */
static sl_status sli_work_stages(sl_work *W, const sli_stage *stages, int count, void *q) {
    sli_block b = {(unsigned char *)W->block, 0, 0};
    int k = 0;
    while (k < count) {
        sli_block trial = {NULL, b.used, 0};
        stages[k].lay(q, &trial);
        if (trial.overflow) {
            return SL_ERR_TOO_LARGE;
        }
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
        stages[k].lay(q, &b);
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
    if (!sli_allocator_is_whole(opt)) {
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

#endif
/* end src/impl/work.h */
/* begin src/impl/sweep.h */
/* sweep.h: one block of right-hand sides through the forward reach, across to the backward reach, and out */
#ifndef SLI_SWEEP_H
#define SLI_SWEEP_H

/* A compiled question: the reach of b, the reach of x, and where the caller's rows stand in their
 * vectors. */
typedef struct sli_query {
    const sl_symbolic *S;
    sl_int nb, nx;
    int is_shared; /* one reach and one vector serve both sweeps */
    sli_reach forward, backward;
    const sl_int *b_place; /* nb */
    const sl_int *x_place; /* nx */
    sli_shore shore;       /* of the region */
    const sl_region
        *region; /* both reaches end there, and its boundary is the end of their vectors; or NULL */
} sli_query;

/* Everything known and everything wanted: the full solve. */
static sli_query sli_query_all(const sl_symbolic *S) {
    sli_query q;
    q.S = S;
    q.nb = q.nx = S->n;
    q.is_shared = 1;
    q.forward = q.backward = sli_reach_all(S);
    q.b_place = q.x_place = S->iperm;
    q.region = NULL;
    q.shore.entries = 0;
    return q;
}

/* Can the query be answered by what F holds? */
SLI_INLINE int sli_query_fits(const sli_query *q, const sl_factor *F) {
    return F->is_good && F->S == q->S && (q->region == NULL || sli_region_fits(q->region, F));
}

/* The kernel for the next block of nrhs right-hand sides, and how many lanes it has. */
SLI_INLINE int sli_lanes_kind(sl_int nrhs) {
    return nrhs <= 1   ? SLI_LANES_1
           : nrhs == 2 ? SLI_LANES_2
           : nrhs <= 4 ? SLI_LANES_4
                       : SLI_LANES_8;
}

/* The vectors and scratch of one block, cut from a workspace. */
typedef struct sli_vectors {
    double *y, *x, *product, *scratch;
} sli_vectors;

static void sli_vectors_layout(sli_vectors *v, sli_block *b, const sli_query *q, sl_int nrhs) {
    const sl_int lanes = (sl_int)1 << sli_lanes_kind(nrhs);
    const size_t forward = sli_scratch_size(q->forward.tallest, q->forward.widest, lanes);
    const size_t backward = sli_scratch_size(q->backward.tallest, q->backward.widest, lanes);
    const size_t across = q->region == NULL ? 0 : sli_region_scratch(q->region, lanes);
    const size_t most = forward > backward ? forward : backward;
    v->y = SLI_TAKE(b, double, (uint64_t)q->forward.columns *(uint64_t)lanes);
    v->x =
        q->is_shared ? v->y : SLI_TAKE(b, double, (uint64_t)q->backward.columns *(uint64_t)lanes);
    v->product = SLI_TAKE(b, double, q->region == NULL ? 0 : sli_region_vectors(q->region, lanes));
    v->scratch = SLI_TAKE(b, double, most > across ? most : across);
}

/* Bytes for any block of up to nrhs right-hand sides; SIZE_MAX if they cannot be counted. One and
 * two lanes keep partial sums that more lanes do not need, so both ends are looked at. */
static size_t sli_vectors_bytes(const sli_query *q, sl_int nrhs) {
    sli_block few = {NULL, 0, 0}, many = {NULL, 0, 0};
    sli_vectors v;
    sli_vectors_layout(&v, &few, q, sli_min(nrhs, 2));
    sli_vectors_layout(&v, &many, q, sli_min(nrhs, 8));
    return few.overflow || many.overflow ? SIZE_MAX : few.used > many.used ? few.used : many.used;
}

/* How a dense block of the caller's lies, and how far apart its rows and its columns stand. */
typedef enum sli_layout { SLI_COLUMN_MAJOR, SLI_INTERLEAVED } sli_layout;

typedef struct sli_dense {
    size_t row, column; /* one of them is 1 */
} sli_dense;

SLI_INLINE sli_dense sli_dense_of(sli_layout layout, size_t ld) {
    sli_dense at;
    at.row = layout == SLI_INTERLEAVED ? ld : 1;
    at.column = layout == SLI_INTERLEAVED ? 1 : ld;
    return at;
}

/* Rows of the vector that the loops below ask for ahead. The caller's order jumps about in it, which
 * only matters where a row fills a cache line: with 8 lanes this made packing at n = 1e6 2 times
 * faster, with one it costs 3 percent of a solve. */
#define SLI_ROWS_AHEAD 32

/* Rows of M to the interleaved rows place[k] of v. Called with constant numbers of columns, and one
 * of the two strides 1: moving rows in and out is a fifth of a full solve, and a counted inner loop
 * would double that. */
SLI_ALWAYS_INLINE void sli_pack_rows(double *v, sl_int lanes, const sl_int *place, sl_int count,
                                     const double *M, sli_dense at, sl_int columns) {
    sl_int k, r;
    for (k = 0; k < count; k++) {
        if (lanes >= 4) {
            SLI_PREFETCH(v + (ptrdiff_t)place[sli_min(k + SLI_ROWS_AHEAD, count - 1)] * lanes, 0);
        }
        SLI_UNROLL
        for (r = 0; r < columns; r++) {
            v[(ptrdiff_t)place[k] * lanes + r] = M[(size_t)k * at.row + (size_t)r * at.column];
        }
    }
}

/* The way back. */
SLI_ALWAYS_INLINE void sli_unpack_rows(double *M, sli_dense at, const double *v, sl_int lanes,
                                       const sl_int *place, sl_int count, sl_int columns) {
    sl_int k, r;
    for (k = 0; k < count; k++) {
        if (lanes >= 4) {
            SLI_PREFETCH(v + (ptrdiff_t)place[sli_min(k + SLI_ROWS_AHEAD, count - 1)] * lanes, 0);
        }
        SLI_UNROLL
        for (r = 0; r < columns; r++) {
            M[(size_t)k * at.row + (size_t)r * at.column] = v[(ptrdiff_t)place[k] * lanes + r];
        }
    }
}

/* b into the forward vector; unknown rows and idle lanes are 0. */
static void sli_pack(const sli_query *q, double *y, const double *B, sli_dense at, sl_int lanes,
                     sl_int nrhs) {
    const sl_int *place = q->b_place, count = q->nb;
    if (q->nb < q->forward.columns || nrhs < lanes) {
        memset(y, 0, (size_t)q->forward.columns * (size_t)lanes * sizeof(double));
    }
    if (nrhs == 8 && at.row == 1) {
        sli_pack_rows(y, 8, place, count, B, sli_dense_of(SLI_COLUMN_MAJOR, at.column), 8);
    } else if (nrhs == 8) {
        sli_pack_rows(y, 8, place, count, B, sli_dense_of(SLI_INTERLEAVED, at.row), 8);
    } else if (nrhs == 3) {
        sli_pack_rows(y, 4, place, count, B, at, 3);
    } else if (nrhs == 1) {
        sli_pack_rows(y, 1, place, count, B, at, 1);
    } else {
        sli_pack_rows(y, lanes, place, count, B, at, nrhs);
    }
}

/* The wanted rows out of the backward vector. */
static void sli_unpack(const sli_query *q, double *X, sli_dense at, const double *x, sl_int lanes,
                       sl_int nrhs) {
    const sl_int *place = q->x_place, count = q->nx;
    if (nrhs == 8 && at.row == 1) {
        sli_unpack_rows(X, sli_dense_of(SLI_COLUMN_MAJOR, at.column), x, 8, place, count, 8);
    } else if (nrhs == 8) {
        sli_unpack_rows(X, sli_dense_of(SLI_INTERLEAVED, at.row), x, 8, place, count, 8);
    } else if (nrhs == 3) {
        sli_unpack_rows(X, at, x, 4, place, count, 3);
    } else if (nrhs == 1) {
        sli_unpack_rows(X, at, x, 1, place, count, 1);
    } else {
        sli_unpack_rows(X, at, x, lanes, place, count, nrhs);
    }
}

/* y carried over to the columns that both reaches have; the rest of the backward vector starts from
 * 0. */
static void sli_cross(const sli_query *q, const double *y, double *x, sl_int lanes) {
    sli_meeting m = sli_meeting_of(&q->forward, &q->backward);
    memset(x, 0, (size_t)q->backward.columns * (size_t)lanes * sizeof(double));
    while (sli_meet(&m)) {
        memcpy(x + (ptrdiff_t)m.in_b * lanes, y + (ptrdiff_t)m.in_a * lanes,
               (size_t)m.count * (size_t)lanes * sizeof(double));
    }
}

/* The boundary of the query's region: u at the end of y, Z u at the end of x. */
static void sli_cross_region(const sl_factor *F, const sli_query *q, int kind,
                             const sli_vectors *v) {
    const ptrdiff_t n = q->region->fence.n_rows;
    sli_region_apply(q->region, &q->shore, F->kernels, kind,
                     v->y + ((q->forward.columns - n) << kind),
                     v->x + ((q->backward.columns - n) << kind), v->product, v->scratch);
}

/* The vectors of the next block of right-hand sides, in memory that has room. */
static sli_vectors sli_vectors_of(const sli_query *q, sl_int nrhs, void *memory) {
    sli_block b = {NULL, 0, 0};
    sli_vectors v;
    b.base = (unsigned char *)memory;
    sli_vectors_layout(&v, &b, q, nrhs);
    return v;
}

/* y := L^-1 y in the forward vector. */
static void sli_sweep_forward(const sl_factor *F, const sli_query *q, const sli_vectors *v,
                              sl_int nrhs) {
    F->kernels->forward[sli_lanes_kind(nrhs)](q->forward.count, q->forward.steps, q->forward.rows,
                                              F->L, v->y, v->scratch);
}

/* y = L^-1 P b for up to 8 right-hand sides. Returns whether there is a solution, where F asks. */
static int sli_sweep_in(const sl_factor *F, const sli_query *q, const sli_vectors *v,
                        const double *B, sli_dense at, sl_int nrhs) {
    const sl_int lanes = (sl_int)1 << sli_lanes_kind(nrhs);
    double norms[SLI_TILE];
    sli_pack(q, v->y, B, at, lanes, nrhs);
    if (F->checks) {
        sli_norms(&q->forward, v->y, lanes, norms);
    }
    sli_sweep_forward(F, q, v, nrhs);
    return !F->checks || sli_is_consistent(F, &q->forward, v->y, lanes, norms);
}

/* P x = L'^-1 D^-1 y in the backward vector. */
static void sli_sweep_backward(const sl_factor *F, const sli_query *q, const sli_vectors *v,
                               sl_int nrhs) {
    const int kind = sli_lanes_kind(nrhs);
    const sl_int lanes = (sl_int)1 << kind;
    if (!q->is_shared) {
        sli_cross(q, v->y, v->x, lanes);
    }
    if (q->region != NULL) {
        sli_cross_region(F, q, kind, v);
    }
    if (F->is_centred) {
        sli_centre(F, &q->forward, v->y, &q->backward, v->x, lanes);
    }
    F->kernels->backward[kind](q->backward.count, q->backward.steps,
                               q->backward.rows + q->backward.n_rows, F->L,
                               F->is_centred ? F->divide : F->D, v->x, v->scratch);
}

/* Only whether A x = b has solutions; nothing but memory is written. */
static sl_status sli_sweep_check(const sl_factor *F, const sli_query *q, const double *B,
                                 sli_dense b_at, sl_int nrhs, void *memory) {
    sl_int r;
    for (r = 0; r < nrhs; r += 8) {
        const sl_int block = sli_min(8, nrhs - r);
        const sli_vectors v = sli_vectors_of(q, block, memory);
        if (!sli_sweep_in(F, q, &v, B + (size_t)r * b_at.column, b_at, block)) {
            return SL_ERR_INCONSISTENT;
        }
    }
    return SL_OK;
}

/* A x = b for the rows of a query, block after block: y = L^-1 P b, z = D^-1 y, P x = L'^-1 z. Memory has room; F is
 * good. The first block that is not consistent is where it ends. */
static sl_status sli_sweep_blocks(const sl_factor *F, const sli_query *q, double *X, sli_dense x_at,
                                  const double *B, sli_dense b_at, sl_int nrhs, void *memory) {
    sl_int r;
    for (r = 0; r < nrhs; r += 8) {
        const sl_int block = sli_min(8, nrhs - r);
        const sli_vectors v = sli_vectors_of(q, block, memory);
        if (!sli_sweep_in(F, q, &v, B + (size_t)r * b_at.column, b_at, block)) {
            return SL_ERR_INCONSISTENT;
        }
        sli_sweep_backward(F, q, &v, block);
        sli_unpack(q, X + (size_t)r * x_at.column, x_at, v.x, (sl_int)1 << sli_lanes_kind(block),
                   block);
    }
    return SL_OK;
}

/* The same, where nothing of X may be written before all blocks are known to be consistent. */
static sl_status sli_sweep(const sl_factor *F, const sli_query *q, double *X, sli_dense x_at,
                           const double *B, sli_dense b_at, sl_int nrhs, void *memory) {
    sl_status status = SL_OK;
    if (F->checks && nrhs > 8 && q->nb > 0) {
        status = sli_sweep_check(F, q, B + 8 * b_at.column, b_at, nrhs - 8, memory);
    }
    return status == SL_OK ? sli_sweep_blocks(F, q, X, x_at, B, b_at, nrhs, memory) : status;
}

/* What every solve asks of its dense arguments: leading dimensions reach over the rows of a column,
 * or over the columns of a row. */
static sl_status sli_check_dense(const double *X, size_t ldx, sl_int nx, const double *B,
                                 size_t ldb, sl_int nb, sli_layout layout, sl_int nrhs) {
    const int by_rows = layout == SLI_INTERLEAVED;
    const int bad_x = nx > 0 && (X == NULL || ldx < (size_t)(by_rows ? nrhs : nx));
    const int bad_b = nb > 0 && (B == NULL || ldb < (size_t)(by_rows ? nrhs : nb));
    /* in place, yet one column or row upon another */
    const int torn = X == B && ldx != ldb && nx > 0 && nb > 0;
    return nrhs < 0 || (nrhs > 0 && (bad_x || bad_b || torn)) ? SL_ERR_ARGUMENT : SL_OK;
}

/* A query answered in the caller's workspace, or in one of this call's own. */
static sl_status sli_answer(const sl_factor *F, const sli_query *q, double *X, sli_dense x_at,
                            const double *B, sli_dense b_at, sl_int nrhs, sl_work *W) {
    sl_work own;
    sl_status status;
    size_t bytes;
    if (nrhs == 0 || q->nx == 0) {
        return SL_OK;
    }
    own = sli_work_own(&F->allocator);
    W = W == NULL ? &own : W;
    bytes = sli_vectors_bytes(q, nrhs);
    status = bytes == SIZE_MAX ? SL_ERR_TOO_LARGE : sli_work_grow(W, bytes);
    if (status == SL_OK) {
        status = sli_sweep(F, q, X, x_at, B, b_at, nrhs, W->block);
    }
    sli_free(&own.allocator, own.block);
    return status;
}

/* The same for arguments not looked at yet. */
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
    return sli_answer(F, q, X, sli_dense_of(layout, ldx), B, sli_dense_of(layout, ldb), nrhs, W);
}

#endif
/* end src/impl/sweep.h */
/* begin src/impl/solve.h */
/* solve.h: full solves: the query in which everything is known and everything wanted */
#ifndef SLI_SOLVE_H
#define SLI_SOLVE_H

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

/* Room for the blocks of a query. */
static sl_status sli_work_reserve(sl_work *W, const sli_query *q, sl_int nrhs) {
    const size_t bytes = nrhs > 0 && q->nx > 0 ? sli_vectors_bytes(q, nrhs) : 0;
    return bytes == SIZE_MAX ? SL_ERR_TOO_LARGE : sli_work_grow(W, bytes);
}

SL_API sl_status sl_work_reserve_factor(sl_work *W, const sl_factor *F, sl_int nrhs) {
    sli_query q;
    if (W == NULL || F == NULL || nrhs < 0) {
        return SL_ERR_ARGUMENT;
    }
    q = sli_query_all(F->S);
    return sli_work_reserve(W, &q, nrhs);
}

#endif
/* end src/impl/solve.h */
/* begin src/impl/plan.h */
/* plan.h: local solves: queries compiled from a b-set and an x-set, kept as a plan or made in the workspace */
#ifndef SLI_PLAN_H
#define SLI_PLAN_H

struct sl_plan {
    sl_allocator allocator;
    size_t bytes;
    sli_query query;
};

/* A set of rows while it is compiled. rows NULL: all of them. */
typedef struct sli_set {
    const sl_int *rows;
    sl_int count;
    sl_int
        inside; /* seeds that the reach starts from; those after them are in the fence's boundary */
    const sli_fence *fence; /* NULL: none */
    uint64_t
        *seeds; /* count: its columns of L ascending, each with its place in the caller's order */
    uint64_t *scratch; /* count */
    sl_int *place;     /* count */
    sli_step *steps;
    sl_int *compact;      /* the steps' rows */
    unsigned char *shore; /* chunks of the fence's boundary */
} sli_set;

static sli_set sli_set_of(const sl_symbolic *S, const sl_int *rows, sl_int count) {
    sli_set set;
    memset(&set, 0, sizeof set);
    set.rows = rows;
    set.count = rows == NULL ? S->n : count;
    return set;
}

/* What sorting a set needs, and what its compiled reach needs. */
static void sli_set_layout_seeds(sli_set *set, sli_block *b) {
    const size_t count = set->rows == NULL ? 0 : (size_t)set->count;
    set->seeds = SLI_TAKE(b, uint64_t, count);
    set->scratch = SLI_TAKE(b, uint64_t, count);
}

static void sli_set_layout_reach(sli_set *set, sli_block *b, const sli_reach *R) {
    if (set->rows != NULL) {
        set->place = SLI_TAKE(b, sl_int, set->count);
        set->steps = SLI_TAKE(b, sli_step, R->count);
        set->compact = SLI_TAKE(b, sl_int, R->n_rows);
        set->shore = SLI_TAKE(b, unsigned char,
                              set->fence == NULL ? 0 : sli_region_chunks(set->fence->n_rows));
    }
}

/* Sorts a set by column of L; refuses rows out of range or given twice. */
static sl_status sli_set_sort(const sl_symbolic *S, sli_set *set, sl_stats *stats) {
    sl_int k;
    set->inside = set->count;
    set->fence = NULL;
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
        if (sli_key(set->seeds[k - 1]) == sli_key(set->seeds[k])) {
            return sli_fail_at(stats, SL_ERR_ARGUMENT, S->perm[sli_key(set->seeds[k])], -1, 0.0);
        }
    }
    return SL_OK;
}

/* Is every row of a sorted set in a fence? Of all rows nobody asks. */
static int sli_set_is_within(const sl_symbolic *S, const sli_set *set, const sli_fence *fence) {
    sl_int k;
    for (k = 0; set->rows != NULL && k < set->count; k++) {
        const sl_int column = sli_key(set->seeds[k]);
        if (sli_fence_find(S, fence, S->super_of[column]) == -1 &&
            sli_fence_boundary(fence, column) == -1) {
            return 0;
        }
    }
    return set->rows != NULL;
}

/* Puts a set behind a fence that it is in: the seeds in its boundary behind the others, both ascending. */
static void sli_set_enclose(const sl_symbolic *S, sli_set *set, const sli_fence *fence) {
    sl_int k, inside = 0, rest = 0;
    for (k = 0; k < set->count; k++) {
        if (sli_fence_find(S, fence, S->super_of[sli_key(set->seeds[k])]) != -1) {
            set->seeds[inside++] = set->seeds[k];
        } else {
            set->scratch[rest++] = set->seeds[k];
        }
    }
    for (k = 0; k < rest; k++) {
        set->seeds[inside + k] = set->scratch[k];
    }
    set->inside = inside;
    set->fence = fence;
}

/* Counts the reach of a sorted set. */
static void sli_set_measure(const sl_symbolic *S, const sli_set *set, sli_reach *R) {
    if (set->rows == NULL) {
        *R = sli_reach_all(S);
    } else {
        sli_reach_measure_within(S, set->fence, set->seeds, set->inside, R);
    }
}

/* Marks the chunks of the boundary that a compiled set has to do with: those of its own rows, and of rows below its
 * subtrees, which are those below their roots. */
static void sli_set_mark(sli_set *set, const sli_reach *R) {
    const sl_int n = set->fence->n_rows, base = R->columns - n;
    const sl_int *rows = R->rows;
    sl_int k, i;
    memset(set->shore, 0, (size_t)sli_region_chunks(n));
    for (k = set->inside; k < set->count; k++) {
        set->shore[(set->place[sli_value(set->seeds[k])] - base) / SLI_REGION_COLUMNS] = 1;
    }
    for (k = 0; k < R->count; k++) {
        for (i = 0; R->steps[k].up == -1 && i < R->steps[k].below; i++) {
            set->shore[(rows[i] - base) / SLI_REGION_COLUMNS] = 1;
        }
        rows += R->steps[k].below;
    }
}

/* Doubles of the region's inverse in the chunks that either set marks. */
static sl_off sli_shore_entries(const sl_region *R, const sli_set *b, const sli_set *x) {
    sl_off sum = 0;
    sl_int k;
    for (k = 0; k < sli_region_chunks(R->fence.n_rows); k++) {
        sum += b->shore[k] || x->shore[k] ? R->begin[k + 1] - R->begin[k] : 0;
    }
    return sum;
}

/* Fills the reach and the place of each of the caller's rows in its vector. */
static void sli_set_fill(const sl_symbolic *S, sli_set *set, sli_reach *R, const sl_int **place) {
    sl_int k, at = 0;
    if (set->rows == NULL) {
        *place = S->iperm;
        return;
    }
    sli_reach_fill_within(S, set->fence, set->seeds, set->inside, set->steps, set->compact, R);
    for (k = 0; k < set->inside; k++) {
        set->place[sli_value(set->seeds[k])] = sli_reach_place(R, &at, sli_key(set->seeds[k]));
    }
    for (; k < set->count; k++) {
        set->place[sli_value(set->seeds[k])] =
            R->columns - set->fence->n_rows +
            sli_fence_boundary(set->fence, sli_key(set->seeds[k]));
    }
    if (set->fence != NULL) {
        sli_set_mark(set, R);
    }
    *place = set->place;
}

/* Whether two compiled reaches are the same columns. */
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

/* Compiles both sets, laid out and measured. Equal reaches share one vector, which spares the
 * crossing. */
static void sli_query_fill(sli_query *q, const sl_symbolic *S, const sl_region *region, sli_set *b,
                           sli_set *x) {
    q->S = S;
    q->region = region;
    q->nb = b->count;
    q->nx = x->count;
    sli_set_fill(S, b, &q->forward, &q->b_place);
    sli_set_fill(S, x, &q->backward, &q->x_place);
    q->is_shared = sli_reach_equal(&q->forward, &q->backward);
    q->shore.b = b->shore;
    q->shore.x = x->shore;
    q->shore.entries = region == NULL ? 0 : sli_shore_entries(region, b, x);
}

static void sli_query_stats(const sli_query *q, sl_stats *stats) {
    const sl_int boundary = q->region == NULL ? 0 : q->region->fence.n_rows;
    stats->b_supernodes = q->forward.count;
    stats->b_columns = q->forward.columns - boundary;
    stats->b_entries = q->forward.entries;
    stats->x_supernodes = q->backward.count;
    stats->x_columns = q->backward.columns - boundary;
    stats->x_entries = q->backward.entries;
    stats->plan_in_region = q->region != NULL;
    stats->plan_region_entries = q->shore.entries;
}

static sl_status sli_check_sets(const sl_symbolic *S, const sl_int *bset, sl_int nb,
                                const sl_int *xset, sl_int nx) {
    return S == NULL || (bset != NULL && nb < 0) || (xset != NULL && nx < 0) ? SL_ERR_ARGUMENT
                                                                             : SL_OK;
}

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
    status = sli_allocator_is_whole(opt) ? sli_check_sets(S, bset, nb, xset, nx) : SL_ERR_ARGUMENT;
    if (status == SL_OK && region != NULL && region->S != S) {
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
    if (status == SL_OK && region != NULL && sli_set_is_within(S, &b, &region->fence) &&
        sli_set_is_within(S, &x, &region->fence)) {
        sli_set_enclose(S, &b, &region->fence);
        sli_set_enclose(S, &x, &region->fence);
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
        stats->bytes_plan = P->bytes;
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

/* Seeds, reaches and vectors of one local solve, all in the workspace. How much the reaches take is
 * known only once the seeds are sorted: where W is too small for them it grows and the sorting is
 * done again. */
static sl_status sli_local(const sl_factor *F, double *X, size_t ldx, sli_set *bset, sli_set *xset,
                           const double *B, size_t ldb, sl_int nrhs, sl_work *W, sl_stats *stats) {
    const sl_symbolic *S = F->S;
    sli_query q;
    size_t bytes = 0, vectors;
    sl_status status;
    for (;;) {
        sli_block b = {NULL, 0, 0};
        sli_set_layout_seeds(bset, &b);
        sli_set_layout_seeds(xset, &b);
        status =
            b.overflow ? SL_ERR_TOO_LARGE : sli_work_grow(W, bytes > b.used ? bytes : b.used + 1);
        if (status != SL_OK) {
            return status;
        }
        b.base = (unsigned char *)W->block;
        b.used = 0;
        sli_set_layout_seeds(bset, &b);
        sli_set_layout_seeds(xset, &b);
        status = sli_set_sort(S, bset, stats);
        status = status == SL_OK ? sli_set_sort(S, xset, stats) : status;
        if (status != SL_OK) {
            return status;
        }
        sli_set_measure(S, bset, &q.forward);
        sli_set_measure(S, xset, &q.backward);
        sli_set_layout_reach(bset, &b, &q.forward);
        sli_set_layout_reach(xset, &b, &q.backward);
        bytes = b.used;
        if (b.overflow || bytes > W->size) {
            if (b.overflow) {
                return SL_ERR_TOO_LARGE;
            }
            continue; /* the reaches would run over the end: nothing is written yet */
        }
        sli_query_fill(&q, S, NULL, bset, xset);
        vectors = nrhs > 0 ? sli_vectors_bytes(&q, nrhs) : 0;
        if (vectors > SIZE_MAX - bytes) {
            return SL_ERR_TOO_LARGE;
        }
        if (bytes + vectors <= W->size) {
            break;
        }
        bytes += vectors;
    }
    if (stats != NULL) {
        sli_query_stats(&q, stats);
        stats->bytes_plan = 0;
    }
    if (nrhs > 0 && q.nx > 0) {
        return sli_sweep(F, &q, X, sli_dense_of(SLI_COLUMN_MAJOR, ldx), B,
                         sli_dense_of(SLI_COLUMN_MAJOR, ldb), nrhs,
                         (unsigned char *)W->block + bytes);
    }
    return SL_OK;
}

SL_API sl_status sl_local_solve(const sl_factor *F, double *X, size_t ldx, const sl_int *xset,
                                sl_int nx, const double *B, size_t ldb, const sl_int *bset,
                                sl_int nb, sl_int nrhs, sl_work *W, sl_stats *stats) {
    sl_work own;
    sli_set b, x;
    sl_status status;
    sli_stats_clear_error(stats);
    if (F == NULL) {
        return SL_ERR_ARGUMENT;
    }
    status = sli_check_sets(F->S, bset, nb, xset, nx);
    if (status != SL_OK) {
        return status;
    }
    b = sli_set_of(F->S, bset, nb);
    x = sli_set_of(F->S, xset, nx);
    status = sli_check_dense(X, ldx, x.count, B, ldb, b.count, SLI_COLUMN_MAJOR, nrhs);
    if (status != SL_OK) {
        return status;
    }
    if (!F->is_good) {
        return SL_ERR_STATE;
    }
    own = sli_work_own(&F->allocator);
    status = sli_local(F, X, ldx, &b, &x, B, ldb, nrhs, W == NULL ? &own : W, stats);
    sli_free(&own.allocator, own.block);
    return status;
}

#endif
/* end src/impl/plan.h */
/* L5 on a factor */
/* begin src/impl/descent.h */
/* descent.h: the way of the inverse from the roots to the leaves, planned: which fronts, whose, and where they wait */
#ifndef SLI_DESCENT_H
#define SLI_DESCENT_H

/* A front is made of its parent's, which therefore stays until the lowest of its children, the last, has taken its part.
 * Subtrees are tasks of one worker each, the fronts above them come first; one worker has one task, everything. In a task,
 * and above the tasks, the fronts of even and of odd depth have a stack each, which grow towards each other: when
 * a front is made, its parent's is the top of the other stack. The roots of tasks, which take their part as soon as the
 * front above is done, have places of their own. */
typedef struct sli_descent {
    const sl_symbolic *S;
    sli_forest forest;     /* of the supernodes of the list */
    sl_int *supers;        /* count: ascending */
    sl_int *up, *low;      /* count: the forest's own, unless it is that of the analysis */
    int is_partial;        /* groups of columns before the first that is needed are left out */
    sl_int *first;         /* count: that column, in the supernode; NULL: 0 */
    sli_schedule plan;     /* waiting: of the fronts */
    sl_off scratch;        /* doubles for the kernels, for each worker */
    sli_planning planning; /* of more than one worker */
} sli_descent;

/* Doubles of the front of the k-th supernode: whole row tiles of all its columns, and a tile, as columns that the last
 * one has not are read along with those it has. */
SLI_INLINE sl_off sli_descent_front(const sli_descent *d, sl_int k) {
    const sli_step *step = &d->S->steps[d->supers[k]];
    const sl_int h = step->width + step->below;
    return (sl_off)sli_square_offset(h, sli_tiles(h)) + SLI_TILE * SLI_TILE;
}

/* A list of count supernodes, n_supers being all, by so many workers at most. */
static sli_descent sli_descent_of(const sl_symbolic *S, sl_int count, sl_int workers) {
    sli_descent d;
    memset(&d, 0, sizeof d);
    d.S = S;
    d.forest.count = count;
    d.plan.workers = sli_min(workers, sli_max(count, 1));
    return d;
}

static void sli_descent_layout(sli_descent *d, sli_block *b) {
    const sl_int count = d->forest.count, some = count < d->S->n_supers ? count : 0;
    d->supers = SLI_TAKE(b, sl_int, count);
    d->up = SLI_TAKE(b, sl_int, some);
    d->low = SLI_TAKE(b, sl_int, some);
    d->first = d->is_partial ? SLI_TAKE(b, sl_int, count) : NULL;
    sli_schedule_layout(&d->plan, b, count);
}

/* What only the planning of several workers needs. */
static void sli_descent_layout_planning(sli_descent *d, sli_block *b) {
    const sl_int workers = d->plan.workers;
    if (workers > 1) {
        sli_planning_layout(&d->planning, b, d->forest.count, workers);
    }
}

/* The supernodes of the reach of seeds, columns of L in ascending order. */
static void sli_descent_reach(sli_descent *d, const uint64_t *seeds, sl_int n_seeds) {
    const sl_symbolic *S = d->S;
    sl_int k = 0, at = 0, s, next;
    while (k < n_seeds) {
        sl_int column = sli_key(seeds[k]);
        s = S->super_of[column];
        next = sli_next_seed(S, seeds, n_seeds, &k);
        for (; s != -1 && s < next; s = S->super_parent[s]) {
            if (d->first != NULL) {
                d->first[at] = sli_min(column - S->super_first[s], S->steps[s].width);
            }
            d->supers[at++] = s;
            column = INT32_MAX;
        }
    }
    SLI_ASSERT(at == d->forest.count);
}

/* Of a supernode those columns are needed that the set names, and the rows of children. */
static void sli_descent_columns(sli_descent *d) {
    const sl_symbolic *S = d->S;
    sl_int k;
    for (k = 0; k < d->forest.count; k++) {
        const sl_int up = d->forest.parent[k];
        if (up != -1) {
            d->first[up] = sli_min(d->first[up], S->places[S->rows_begin[d->supers[k]]]);
        }
    }
}

/* Parents and first descendants within a list. A supernode's parent is the next one of the chain of ancestors at hand
 * that is not below it, as the list is in postorder and closed under the parent relation. */
static void sli_descent_tree(sli_descent *d) {
    const sl_symbolic *S = d->S;
    const sl_int count = d->forest.count;
    sl_int k, up = -1;
    d->forest.parent = S->super_parent;
    d->forest.low = S->descendant;
    if (count == S->n_supers) {
        return;
    }
    for (k = count - 1; k >= 0; k--) {
        const sl_int parent = S->super_parent[d->supers[k]];
        while (up != -1 && d->supers[up] != parent) {
            up = d->up[up];
        }
        d->up[k] = up;
        d->low[k] = k;
        up = k;
    }
    for (k = 0; k < count; k++) {
        if (d->up[k] != -1) {
            d->low[d->up[k]] = sli_min(d->low[d->up[k]], d->low[k]);
        }
    }
    d->forest.parent = d->up;
    d->forest.low = d->low;
}

/* A front goes to the stack that its parent is not on, or to the first one. The second stack counts from its end, in
 * numbers below 0, until the size of both is known. is_last: nobody else needs the parent; is_leaf: nobody needs this. */
static void sli_descent_push(sli_descent *d, sli_stacks *stacks, sl_int k, int is_root, int is_last,
                             int is_leaf) {
    const sl_int up = d->forest.parent[k];
    sl_off *begin = d->plan.waiting_begin, *top = stacks->top;
    const int side = is_root ? 0 : begin[up] >= 0;
    const sl_off size = sli_descent_front(d, k);
    begin[k] = side == 0 ? top[0] : -(top[1] + size);
    top[side] += size;
    stacks->most = top[0] + top[1] > stacks->most ? top[0] + top[1] : stacks->most;
    if (is_last) {
        top[1 - side] -= sli_descent_front(d, up);
    }
    if (is_leaf) {
        top[side] -= size;
    }
}

SLI_INLINE void sli_descent_settle(sli_descent *d, const sli_stacks *stacks, sl_int k,
                                   sl_off from) {
    sl_off *begin = &d->plan.waiting_begin[k];
    *begin += from + (*begin < 0 ? stacks->most : 0);
}

/* Where the fronts first .. last of a task begin, from a place on; returns how many doubles they take. Their parents are
 * among them, or the task's root, or none. */
static sl_off sli_descent_stack_task(sli_descent *d, sl_int first, sl_int last, sl_off from) {
    const sl_int *up = d->forest.parent, *low = d->forest.low;
    sli_stacks stacks;
    sl_int k;
    memset(&stacks, 0, sizeof stacks);
    for (k = last; k >= first; k--) {
        const int is_root = up[k] == -1 || up[k] > last;
        sli_descent_push(d, &stacks, k, is_root, !is_root && low[up[k]] == low[k], low[k] == k);
    }
    for (k = first; k <= last; k++) {
        sli_descent_settle(d, &stacks, k, from);
    }
    return stacks.most;
}

/* The same of the fronts above all tasks. */
static sl_off sli_descent_stack_tops(sli_descent *d, sl_off from) {
    const sli_schedule *p = &d->plan;
    const sl_int *up = d->forest.parent;
    sl_int *child = d->planning.side; /* the lowest that is above all tasks, or -1 */
    sli_stacks stacks;
    sl_int m;
    memset(&stacks, 0, sizeof stacks);
    for (m = p->n_tops - 1; m >= 0; m--) {
        const sl_int k = p->top[m];
        child[k] = -1;
        if (up[k] != -1) {
            child[up[k]] = k;
        }
    }
    for (m = p->n_tops - 1; m >= 0; m--) {
        const sl_int k = p->top[m];
        sli_descent_push(d, &stacks, k, up[k] == -1, up[k] != -1 && child[up[k]] == k,
                         child[k] == -1);
    }
    for (m = 0; m < p->n_tops; m++) {
        sli_descent_settle(d, &stacks, p->top[m], from);
    }
    return stacks.most;
}

/* The same of everything. */
static void sli_descent_place(sli_descent *d) {
    sli_schedule *p = &d->plan;
    const sl_int own = p->workers > 1; /* a task's root has a place of its own */
    sl_int k, m;
    p->waiting = p->n_tops > 0 ? sli_descent_stack_tops(d, 0) : 0;
    for (m = 0; m < p->n_tasks && own; m++) {
        p->waiting_begin[p->last[m]] = p->waiting;
        p->waiting += sli_descent_front(d, p->last[m]);
    }
    for (k = 0; k < p->workers; k++) {
        sl_off most = 0;
        for (m = 0; m < p->n_tasks; m++) {
            if (p->worker[m] == k) {
                const sl_off size =
                    sli_descent_stack_task(d, p->first[m], p->last[m] - own, p->waiting);
                most = size > most ? size : most;
            }
        }
        p->waiting += most;
    }
}

/* Scratch for any front of the list. */
static sl_off sli_descent_scratch(const sli_descent *d) {
    sl_int k, tallest = 0, widest = 0;
    for (k = 0; k < d->forest.count; k++) {
        const sli_step *step = &d->S->steps[d->supers[k]];
        tallest = sli_max(tallest, step->width + step->below);
        widest = sli_max(widest, step->width);
    }
    return sli_dual_scratch(tallest, widest);
}

/* Plans for a list, or, seeds being NULL, for all. The arrays have room. */
static void sli_descent_plan(sli_descent *d, const uint64_t *seeds, sl_int n_seeds) {
    sli_schedule *p = &d->plan;
    sl_int k;
    if (seeds != NULL) {
        sli_descent_reach(d, seeds, n_seeds);
    }
    for (k = 0; k < d->forest.count && seeds == NULL; k++) {
        d->supers[k] = k;
    }
    sli_descent_tree(d);
    if (d->first != NULL) {
        sli_descent_columns(d);
    }
    for (k = 0; k < d->forest.count && p->workers > 1; k++) {
        d->planning.flops[k] = sli_front_flops(&d->S->steps[d->supers[k]]);
    }
    sli_plan_tasks(p, &d->forest, &d->planning);
    d->scratch = sli_descent_scratch(d);
    sli_descent_place(d);
}

/* Where row stands in supernode s, which begins at or before it, or -1. */
static sl_int sli_descent_row(const sl_symbolic *S, sl_int s, sl_int row) {
    const sl_int *rows = S->rows + S->rows_begin[s];
    const sl_int width = S->steps[s].width, below = S->steps[s].below, r = row - S->super_first[s];
    sl_int i;
    if (r < width) {
        return r;
    }
    i = sli_lower_bound(rows, below, row);
    return i < below && rows[i] == row ? width + i : -1;
}

static void sli_descent_stats(const sli_descent *d, sl_stats *stats) {
    sl_int k;
    stats->z_supernodes = d->forest.count;
    stats->z_columns = 0;
    for (k = 0; k < d->forest.count; k++) {
        stats->z_columns += d->S->steps[d->supers[k]].width;
    }
}

#endif
/* end src/impl/descent.h */
/* begin src/impl/descent_run.h */
/* descent_run.h: the way of the inverse from the roots to the leaves, gone: front after front, each handed to a taker */
#ifndef SLI_DESCENT_RUN_H
#define SLI_DESCENT_RUN_H

/* Takes what it wants of row tiles t0 .. t1-1 of the completed front of the k-th supernode of a list. Calls for other
 * tiles, or for other fronts, may run at once. */
typedef void (*sli_taker)(void *to, sl_int k, const sli_dual *f, sl_int t0, sl_int t1);

/* A run under way; the memory is that of sli_descent_layout_run. */
typedef struct sli_descending {
    const sl_factor *F;
    const sli_descent *d;
    const sl_threads *threads;
    sli_taker take;
    void *to;
    double *fronts, *scratch;
    /* the front that all workers share */
    sl_int at;
    sli_dual front;
    sl_int group;
    sli_dual_part part;
} sli_descending;

static void sli_descent_layout_run(sli_descending *run, const sli_descent *d, sli_block *b) {
    run->fronts = SLI_TAKE(b, double, d->plan.waiting);
    run->scratch = SLI_TAKE(b, double, (uint64_t)d->plan.workers *(uint64_t)d->scratch);
}

static sli_dual sli_dual_of(const sli_descending *run, sl_int k) {
    const sli_step *step = &run->d->S->steps[run->d->supers[k]];
    sli_dual f;
    f.panel = run->F->L + step->panel;
    f.D = run->F->D + step->column;
    f.front = run->fronts + run->d->plan.waiting_begin[k];
    f.width = step->width;
    f.below = step->below;
    f.first = run->d->first == NULL ? 0 : run->d->first[k];
    return f;
}

/* Row tiles t0 .. t1-1 of the rows below, out of the parent's front. */
static void sli_dual_gather(const sli_descending *run, sl_int k, const sli_dual *f, sl_int t0,
                            sl_int t1) {
    const sli_descent *d = run->d;
    const sl_int up = d->forest.parent[k];
    if (up != -1) {
        const sli_dual parent = sli_dual_of(run, up);
        run->F->kernels->gather(f, parent.front, parent.width + parent.below,
                                d->S->places + d->S->rows_begin[d->supers[k]], t0, t1);
    }
}

/* Most of a panel that is asked for before its turn: read from the last to the first they meet no hardware that runs
 * ahead of them, and waiting for L was a fifth of all time on 2D meshes; and so it is with the places of rows. */
#define SLI_PANEL_AHEAD ((sl_off)1024)

static void sli_dual_prefetch(const sl_factor *F, sl_int s) {
    const sl_symbolic *S = F->S;
    const sl_off first = S->panel_begin[s], size = S->panel_begin[s + 1] - first;
    const sl_off row = S->rows_begin[s], rows = S->rows_begin[s + 1] - row;
    sl_off k;
    for (k = 0; k < rows && k < SLI_PANEL_AHEAD; k += (sl_off)(SLI_ALIGN / sizeof(sl_int))) {
        SLI_PREFETCH(S->places + row + k, 0);
    }
    for (k = 0; k < size && k < SLI_PANEL_AHEAD; k += SLI_TILE) {
        SLI_PREFETCH(F->L + first + k, 0);
    }
}

/* A front whose rows below are there: the rest of it, and the taker. */
static void sli_dual_complete(const sli_descending *run, sl_int k, const sli_dual *f,
                              sl_int worker) {
    if (k > 0) {
        sli_dual_prefetch(run->F, run->d->supers[k - 1]);
    }
    run->F->kernels->takahashi(f, run->scratch + (ptrdiff_t)(run->d->scratch * worker));
    run->take(run->to, k, f, 0, sli_tiles(f->width + f->below));
}

/* Worker k's tasks, whose roots have taken their parts before. */
static void sli_descend_tasks(void *data, sl_int k) {
    const sli_descending *run = (const sli_descending *)data;
    const sli_schedule *plan = &run->d->plan;
    sl_int m, s;
    for (m = 0; m < plan->n_tasks; m++) {
        for (s = plan->last[m]; s >= plan->first[m] && plan->worker[m] == k; s--) {
            const sli_dual f = sli_dual_of(run, s);
            if (s < plan->last[m]) {
                sli_dual_gather(run, s, &f, 0, sli_tiles(f.width + f.below));
            }
            sli_dual_complete(run, s, &f, k);
        }
    }
}

/* The children of the front at hand that are roots of tasks take their parts: every `workers`-th one from k on. */
static void sli_descend_to_roots(const sli_descending *run, sl_int k, sl_int workers) {
    const sli_schedule *plan = &run->d->plan;
    const sl_int *low = run->d->forest.low;
    sl_int c, place, count = 0;
    for (c = run->at - 1; c >= low[run->at]; c = low[c] - 1) {
        place = sli_lower_bound(plan->top, plan->n_tops, c);
        if (plan->top[place] != c && count++ % workers == k) { /* run->at itself is a top */
            const sli_dual f = sli_dual_of(run, c);
            sli_dual_gather(run, c, &f, 0, sli_tiles(f.width + f.below));
        }
    }
}

static void sli_shared_gather(void *data, sl_int k) {
    const sli_descending *run = (const sli_descending *)data;
    const sl_int workers = run->d->plan.workers, first = run->front.width / SLI_TILE;
    const sl_int tiles = sli_tiles(run->front.width + run->front.below);
    sli_dual_gather(run, run->at, &run->front, sli_part(first, tiles, k, workers, 0),
                    sli_part(first, tiles, k + 1, workers, 0));
}

static void sli_shared_part(void *data, sl_int k) {
    const sli_descending *run = (const sli_descending *)data;
    const sl_int workers = run->d->plan.workers, is_square = run->part == SLI_DUAL_SQUARE;
    const sli_span all = sli_dual_span(&run->front, run->group, run->part);
    run->F->kernels->dual(&run->front, run->group, run->part,
                          sli_part(all.first, all.last, k, workers, is_square),
                          sli_part(all.first, all.last, k + 1, workers, is_square), run->scratch);
}

static void sli_shared_take(void *data, sl_int k) {
    const sli_descending *run = (const sli_descending *)data;
    const sl_int workers = run->d->plan.workers;
    const sl_int tiles = sli_tiles(run->front.width + run->front.below);
    run->take(run->to, run->at, &run->front, sli_part(0, tiles, k, workers, 0),
              sli_part(0, tiles, k + 1, workers, 0));
    sli_descend_to_roots(run, k, workers);
}

/* The whole of a front by all workers: each row tile goes its own way, so that the bits are the same. */
static void sli_dual_shared(sli_descending *run) {
    const sl_int workers = run->d->plan.workers;
    sl_int part;
    run->front = sli_dual_of(run, run->at);
    sli_parallel(run->threads, workers, sli_shared_gather, run);
    for (run->group = sli_dual_last(&run->front); run->group + SLI_DUAL_COLUMNS > run->front.first;
         run->group -= SLI_DUAL_COLUMNS) {
        for (part = 0; part < SLI_DUAL_PARTS; part++) {
            run->part = (sli_dual_part)part;
            sli_parallel(run->threads, workers, sli_shared_part, run);
        }
    }
    sli_parallel(run->threads, workers, sli_shared_take, run);
}

/* All fronts, parents before children. */
static void sli_descend(sli_descending *run) {
    const sli_schedule *plan = &run->d->plan;
    sl_int m;
    for (m = plan->n_tops - 1; m >= 0; m--) {
        run->at = plan->top[m];
        if (2.0 * sli_front_flops(&run->d->S->steps[run->d->supers[run->at]]) >= SLI_SHARED_FLOPS) {
            sli_dual_shared(run);
        } else {
            const sli_dual f = sli_dual_of(run, run->at);
            sli_dual_gather(run, run->at, &f, 0, sli_tiles(f.width + f.below));
            sli_dual_complete(run, run->at, &f, 0);
            sli_descend_to_roots(run, 0, 1);
        }
    }
    sli_parallel(run->threads, plan->workers, sli_descend_tasks, run);
}

#endif
/* end src/impl/descent_run.h */
/* begin src/impl/groups.h */
/* groups.h: unit vectors taken up to 8 at a time over one reach, as many as pay, and swept forward together */
#ifndef SLI_GROUPS_H
#define SLI_GROUPS_H

#define SLI_LANES_MAX 8
#define SLI_REQUESTS_MAX 64 /* of one group: 8 columns make 36 pairs; more are repetitions */

/* Time of a sweep of 1, 2, 4, 8 lanes over so many entries, its reach compiled before it, in that of
 * one lane: measured on grids of 1e4 to 1e6 vertices (Zen 4); NEON, which was not, as AVX2. */
static const double sli_lanes_cost[][SLI_LANES_COUNT] = {{1.0, 1.3, 1.9, 3.3},  /* of any other */
                                                         {1.0, 1.2, 3.8, 8.6},  /* plain C */
                                                         {1.0, 1.3, 1.9, 3.3},  /* AVX2 */
                                                         {1.0, 1.2, 1.9, 2.1}}; /* AVX-512 */

/* The row of an instruction set in tables of costs. */
SLI_INLINE int sli_isa_row(sl_isa isa) {
    return isa == SL_ISA_SCALAR ? 1 : isa == SL_ISA_AVX2 ? 2 : isa == SL_ISA_AVX512 ? 3 : 0;
}

/* Columns of L that share a reach, a lane each. */
typedef struct sli_group {
    sl_int count;
    uint64_t seeds[SLI_LANES_MAX]; /* the columns, ascending: the k-th has lane k */
    sli_reach size;                /* as sli_reach_add counts it; not compiled */
} sli_group;

/* The lane of a column, or the one it would take. */
SLI_INLINE sl_int sli_group_lane(const sli_group *g, sl_int column) {
    sl_int at = 0;
    while (at < g->count && sli_key(g->seeds[at]) < column) {
        at++;
    }
    return at;
}

/* Takes a column in; 0 where no lane is left. S NULL: its path is not counted. */
static int sli_group_add(sli_group *g, sl_int column, const sl_symbolic *S) {
    const sl_int at = sli_group_lane(g, column);
    sl_int k;
    if (at < g->count && sli_key(g->seeds[at]) == column) {
        return 1;
    }
    if (g->count == SLI_LANES_MAX) {
        return 0;
    }
    if (S != NULL) {
        sli_reach_add(S, column, at > 0 ? sli_key(g->seeds[at - 1]) : -1,
                      at < g->count ? sli_key(g->seeds[at]) : -1, &g->size);
    }
    for (k = g->count++; k > at; k--) {
        g->seeds[k] = g->seeds[k - 1];
    }
    g->seeds[at] = sli_keyed(column, 0);
    return 1;
}

/* Entries of the inverse that are asked for, near-by ones side by side. */
typedef struct sli_requests {
    const sl_symbolic *S;
    const double *lanes_cost;
    const sl_int *rows, *columns; /* count each; one array: columns of the inverse, or its diagonal.
                                     NULL: 0, 1, 2, ... */
    sl_int count;
    sl_int n_groups;
    uint64_t *order; /* count: a key, and the request's place in the caller's order */
    uint64_t *taken; /* count: scratch of the sort; then how many requests each group takes */
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
    r->taken = SLI_TAKE(b, uint64_t, r->count);
}

/* The lower 15 bits, with room for another bit before each. */
SLI_INLINE uint32_t sli_widen_bits(uint32_t a) {
    a = (a | a << 8) & 0x00ff00ffu;
    a = (a | a << 4) & 0x0f0f0f0fu;
    a = (a | a << 2) & 0x33333333u;
    return (a | a << 1) & 0x55555555u;
}

/* Sorts requests: single columns by themselves, as they are numbered in postorder. Pairs along a
 * Z-curve through (larger, smaller), so that near-by requests are near-by in both. */
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
    sli_sort(r->order, r->count, r->taken);
}

/* Adds both columns of the k-th of the sorted requests to a group; 0 where no lane is left. */
SLI_INLINE int sli_group_request(sli_group *g, const sli_requests *r, sl_int k,
                                 const sl_symbolic *S) {
    const sl_int at = sli_value(r->order[k]);
    return sli_group_add(g, sli_request_row(r, at), S) &&
           sli_group_add(g, sli_request_column(r, at), S);
}

/* The group that starts at the k-th of the sorted requests: as many as make the time of one least. */
static sl_int sli_group_choose(const sli_requests *r, sl_int k, sli_group *best) {
    const sl_int from = k;
    double least = 0.0;
    sl_int taken = 0;
    sli_group g;
    memset(&g, 0, sizeof g);
    *best = g;
    for (; k < r->count && k - from < SLI_REQUESTS_MAX && sli_group_request(&g, r, k, r->S); k++) {
        const double time = r->lanes_cost[sli_lanes_kind(g.count)] * (double)g.size.entries /
                            (double)(k - from + 1);
        if (taken == 0 || time <= least) {
            least = time;
            taken = k - from + 1;
            *best = g;
        }
    }
    return taken;
}

/* The same group again: `taken` requests. */
static void sli_group_again(const sli_requests *r, sl_int k, sl_int taken, sli_group *g) {
    memset(g, 0, sizeof *g);
    for (; taken > 0; taken--, k++) {
        (void)sli_group_request(g, r, k, NULL);
    }
}

/* Room for any of several sweeps. */
typedef struct sli_room {
    uint64_t steps, rows, values, scratch;
} sli_room;

static void sli_room_add(sli_room *room, const sli_reach *R, sl_int lanes) {
    const uint64_t steps = (uint64_t)R->count, rows = (uint64_t)R->n_rows;
    const uint64_t values = (uint64_t)R->columns * (uint64_t)lanes;
    const uint64_t scratch = sli_scratch_size(R->tallest, R->widest, lanes);
    room->steps = steps > room->steps ? steps : room->steps;
    room->rows = rows > room->rows ? rows : room->rows;
    room->values = values > room->values ? values : room->values;
    room->scratch = scratch > room->scratch ? scratch : room->scratch;
}

/* Sorts and groups requests, and finds the room their sweeps need. Returns their time, as the costs of lanes are; ends
 * where it passes a limit. */
static double sli_requests_group_within(sli_requests *r, sli_room *room, double limit) {
    double time = 0.0;
    sl_int k = 0;
    sli_requests_sort(r);
    for (r->n_groups = 0; k < r->count && time < limit; r->n_groups++) {
        sli_group g;
        const sl_int taken = sli_group_choose(r, k, &g);
        const int kind = sli_lanes_kind(g.count);
        sli_room_add(room, &g.size, (sl_int)1 << kind);
        time += r->lanes_cost[kind] * (double)g.size.entries;
        r->taken[r->n_groups] = (uint64_t)taken;
        k += taken;
    }
    return time;
}

static void sli_requests_group(sli_requests *r, sli_room *room) {
    (void)sli_requests_group_within(r, room, HUGE_VAL);
}

/* A forward sweep: its reach and vector stay, the rest serves while it runs. */
typedef struct sli_forward {
    sli_reach reach;
    int kind;
    sl_int lanes;
    sli_step *steps;
    double *y; /* reach.columns x lanes, interleaved */
    sl_int *rows;
    double *scratch;
} sli_forward;

static void sli_forward_layout(sli_forward *f, sli_block *b, const sli_room *room) {
    f->steps = SLI_TAKE(b, sli_step, room->steps);
    f->y = SLI_TAKE(b, double, room->values);
}

static void sli_forward_layout_run(sli_forward *f, sli_block *b, const sli_room *room) {
    f->rows = SLI_TAKE(b, sl_int, room->rows);
    f->scratch = SLI_TAKE(b, double, room->scratch);
}

/* The number of lanes for so many vectors, and those all 0 over a compiled reach. */
static void sli_forward_clear(sli_forward *f, sl_int vectors) {
    f->kind = sli_lanes_kind(vectors);
    f->lanes = (sl_int)1 << f->kind;
    memset(f->y, 0, (size_t)f->reach.columns * (size_t)f->lanes * sizeof(double));
}

/* y := L^-1 y; says in stats what was read. */
static void sli_forward_run(sli_forward *f, const sl_factor *F, sl_stats *stats) {
    F->kernels->forward[f->kind](f->reach.count, f->reach.steps, f->reach.rows, F->L, f->y,
                                 f->scratch);
    if (stats != NULL) {
        stats->b_supernodes = sli_max(stats->b_supernodes, f->reach.count);
        stats->b_columns = sli_max(stats->b_columns, f->reach.columns);
        stats->b_entries += f->reach.entries;
    }
}

/* L^-1 times the unit vectors of a group. */
static void sli_forward_group(sli_forward *f, const sl_factor *F, const sli_group *g,
                              sl_stats *stats) {
    sl_int k, at = 0;
    sli_reach_fill(F->S, g->seeds, g->count, f->steps, f->rows, &f->reach);
    sli_forward_clear(f, g->count);
    for (k = 0; k < g->count; k++) {
        const sl_int place = sli_reach_place(&f->reach, &at, sli_key(g->seeds[k]));
        f->y[(ptrdiff_t)place * f->lanes + k] = 1.0;
    }
    sli_forward_run(f, F, stats);
}

#endif
/* end src/impl/groups.h */
/* begin src/impl/inverse.h */
/* inverse.h: bilinear forms of A^-1: forward sweeps, then sums over common columns weighted by 1/D */
#ifndef SLI_INVERSE_H
#define SLI_INVERSE_H

/* z = y / d in every lane, by one division. Where 1/d is out of range or short of digits, each for
 * itself. */
SLI_ALWAYS_INLINE void sli_weigh(double *z, const double *y, double d, sl_int lanes) {
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

/* sums[m] = y_i' D^-1 y_j over one sweep, for the lanes i = first[m], j = second[m]. */
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
            sli_weigh(z, y, d[k], f->lanes);
            for (m = 0; m < count; m++) { /* sum(m) += y(k, i) / d(k) y(k, j) */
                sums[m] += z[first[m]] * y[second[m]];
            }
        }
    }
}

/* Clears what a call says of its sweeps. */
static void sli_inverse_stats(sl_stats *stats) {
    if (stats != NULL) {
        sli_query none;
        memset(&none, 0, sizeof none);
        sli_query_stats(&none, stats);
        stats->bytes_plan = 0;
    }
}

/* Refuses rows out of range. */
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

/* c' A^-1 b: two lanes over the reach of both sets, one where they are the same. */
typedef struct sli_bilinear {
    const sl_factor *F;
    const sl_int *set[2];
    const double *values[2];
    sl_int count[2];
    sl_int vectors;
    uint64_t *seeds, *scratch; /* count[0] + count[1] in all, unless a set is NULL */
    sli_forward forward;
} sli_bilinear;

SLI_INLINE int sli_bilinear_is_whole(const sli_bilinear *q) {
    return q->set[0] == NULL || q->set[1] == NULL;
}

static void sli_bilinear_lay_seeds(void *form, sli_block *b) {
    sli_bilinear *q = (sli_bilinear *)form;
    const uint64_t count =
        sli_bilinear_is_whole(q) ? 0 : (uint64_t)q->count[0] + (uint64_t)q->count[1];
    q->seeds = SLI_TAKE(b, uint64_t, count);
    q->scratch = SLI_TAKE(b, uint64_t, count);
}

/* The columns of both sets ascending, each with its place behind one another, and their reach. */
static void sli_bilinear_measure(void *form) {
    sli_bilinear *q = (sli_bilinear *)form;
    const sl_symbolic *S = q->F->S;
    const sl_int nc = q->count[0], total = nc + (q->vectors == 2 ? q->count[1] : 0);
    sl_int k;
    if (sli_bilinear_is_whole(q)) {
        q->forward.reach = sli_reach_all(S);
        return;
    }
    for (k = 0; k < total; k++) {
        q->seeds[k] = sli_keyed(S->iperm[k < nc ? q->set[0][k] : q->set[1][k - nc]], k);
    }
    sli_sort(q->seeds, total, q->scratch);
    sli_reach_measure(S, q->seeds, total, &q->forward.reach);
}

static void sli_bilinear_lay_sweep(void *form, sli_block *b) {
    sli_bilinear *q = (sli_bilinear *)form;
    sli_room room = {0, 0, 0, 0};
    sli_room_add(&room, &q->forward.reach, q->vectors);
    if (sli_bilinear_is_whole(q)) { /* the analysis has them */
        room.steps = room.rows = 0;
    }
    sli_forward_layout(&q->forward, b, &room);
    sli_forward_layout_run(&q->forward, b, &room);
}

/* Both vectors into the sweep. */
static void sli_bilinear_pack(sli_bilinear *q) {
    const sl_symbolic *S = q->F->S;
    sli_forward *f = &q->forward;
    const sl_int nc = q->count[0], total = nc + (q->vectors == 2 ? q->count[1] : 0);
    sl_int k, lane, at = 0;
    if (!sli_bilinear_is_whole(q)) {
        sli_reach_fill(S, q->seeds, total, f->steps, f->rows, &f->reach);
        sli_forward_clear(f, q->vectors);
        for (k = 0; k < total; k++) {
            const sl_int place = sli_reach_place(&f->reach, &at, sli_key(q->seeds[k]));
            const sl_int from = sli_value(q->seeds[k]);
            lane = from >= nc;
            f->y[(ptrdiff_t)place * f->lanes + lane] += q->values[lane][from - lane * nc];
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

static const sli_stage sli_bilinear_stages[2] = {{sli_bilinear_lay_seeds, sli_bilinear_measure},
                                                 {sli_bilinear_lay_sweep, NULL}};

static sl_status sli_inverse_form(sli_bilinear *q, double *out, sl_work *W, sl_stats *stats) {
    const sl_int first = 0, second = q->vectors - 1;
    const sl_status status = sli_work_stages(W, sli_bilinear_stages, 2, q);
    if (status == SL_OK) {
        sli_bilinear_pack(q);
        sli_forward_run(&q->forward, q->F, stats);
        sli_pair_sums(q->F, &q->forward, 1, &first, &second, out);
    }
    return status;
}

SL_API sl_status sl_inverse_bilinear(const sl_factor *F, double *out, const sl_int *cset,
                                     const double *c, sl_int nc, const sl_int *bset,
                                     const double *b, sl_int nb, sl_work *W, sl_stats *stats) {
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
    if (!F->is_good) {
        return SL_ERR_STATE;
    }
    if (cset != NULL && bset != NULL && nc > INT32_MAX - nb) {
        return SL_ERR_TOO_LARGE;
    }
    status = sli_check_rows(F->S, cset, nc, 0, stats);
    status = status == SL_OK ? sli_check_rows(F->S, bset, nb, 1, stats) : status;
    if (status != SL_OK) {
        return status;
    }
    sli_inverse_stats(stats);
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
    status = sli_inverse_form(&q, out, W == NULL ? &own : W, stats);
    sli_free(&own.allocator, own.block);
    return status;
}

#endif
/* end src/impl/inverse.h */
/* begin src/impl/inverse_entries.h */
/* inverse_entries.h: entries of A^-1 one by one: by forward sweeps, or by a descent that keeps nothing else */
#ifndef SLI_INVERSE_ENTRIES_H
#define SLI_INVERSE_ENTRIES_H

/* One call. The descent comes in question where every entry has a place in the pattern of L: it is met in the front of
 * its first column. */
typedef struct sli_entries {
    const sl_factor *F;
    const sl_threads *threads; /* of a descent */
    double *out;
    sli_requests requests;
    sl_inverse_method method;
    /* forward */
    sli_room room;
    sli_forward forward;
    /* descent */
    sli_descent descent;
    sli_descending run;
    sl_int *asked; /* supernodes + 1: the first of the sorted requests that each front answers */
} sli_entries;

/* Time of a front of the inverse in that of a forward sweep of one lane over one entry, as the costs of lanes are: of
 * itself, for each of the h^2 numbers that are moved, for each flop of the factorization's front, which is twice as
 * many here. Measured on grids of 1e4 to 1e6 vertices and of 25^3 (Zen 5); NEON, which was not, as AVX2. */
static const double sli_descent_cost[][3] = {{2000.0, 4.0, 0.35}, /* of any other */
                                             {2000.0, 4.0, 2.2},  /* plain C */
                                             {2000.0, 4.0, 0.35}, /* AVX2 */
                                             {2000.0, 4.0, 0.2}}; /* AVX-512 */

/* The whole diagonal needs no list of requests. */
SLI_INLINE int sli_entries_is_all(const sli_entries *q) {
    return q->requests.rows == NULL;
}

/* The first column of the k-th request: the front that has its entry is that column's. */
SLI_INLINE sl_int sli_entries_column(const sli_entries *q, sl_int k) {
    return sli_min(sli_request_row(&q->requests, k), sli_request_column(&q->requests, k));
}

/* Where the k-th request stands in supernode s, that of its first column, or -1: no place in the pattern. */
SLI_INLINE sl_int sli_entries_row(const sli_entries *q, sl_int s, sl_int k) {
    const sl_int row =
        sli_max(sli_request_row(&q->requests, k), sli_request_column(&q->requests, k));
    return sli_descent_row(q->F->S, s, row);
}

static void sli_entries_sort(sli_entries *q) {
    sli_requests *r = &q->requests;
    sl_int k;
    for (k = 0; k < r->count; k++) {
        r->order[k] = sli_keyed(sli_entries_column(q, k), k);
    }
    sli_sort(r->order, r->count, r->taken);
}

static int sli_entries_are_in_pattern(const sli_entries *q) {
    const sli_requests *r = &q->requests;
    sl_int k, is_in = 1;
    for (k = 0; k < r->count && is_in && r->rows != r->columns; k++) {
        is_in = sli_entries_row(q, q->F->S->super_of[sli_entries_column(q, k)], k) != -1;
    }
    return is_in;
}

/* Time of a descent of the reach of sorted requests, and its supernodes. */
static double sli_descent_time(const sli_entries *q, sl_int *supers) {
    const sl_symbolic *S = q->F->S;
    const sli_requests *r = &q->requests;
    const double *cost = sli_descent_cost[sli_isa_row(q->F->kernels->isa)];
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

/* Sorts requests, and finds which way is the shorter one: the count of forward sweeps ends where it has passed the
 * descent. */
static void sli_entries_choose(void *call) {
    sli_entries *q = (sli_entries *)call;
    double descent = HUGE_VAL;
    sl_int supers = q->F->S->n_supers;
    memset(&q->room, 0, sizeof q->room);
    if (sli_entries_is_all(q)) {
        q->method = SL_INVERSE_SELECTED;
    } else {
        if (q->requests.count > 1 && sli_entries_are_in_pattern(q)) {
            sli_entries_sort(q);
            descent = sli_descent_time(q, &supers);
        }
        q->method = sli_requests_group_within(&q->requests, &q->room, descent) < descent
                        ? SL_INVERSE_FORWARD
                        : SL_INVERSE_SELECTED;
    }
    if (q->method == SL_INVERSE_SELECTED) {
        q->descent = sli_descent_of(q->F->S, supers, sli_workers(q->threads));
        q->descent.is_partial = !sli_entries_is_all(q);
    }
}

static void sli_entries_lay_requests(void *call, sli_block *b) {
    sli_entries *q = (sli_entries *)call;
    if (!sli_entries_is_all(q)) {
        sli_requests_layout(&q->requests, b);
    }
}

static void sli_entries_lay_way(void *call, sli_block *b) {
    sli_entries *q = (sli_entries *)call;
    if (q->method == SL_INVERSE_FORWARD) {
        sli_forward_layout(&q->forward, b, &q->room);
        sli_forward_layout_run(&q->forward, b, &q->room);
    } else {
        sli_descent_layout(&q->descent, b);
        sli_descent_layout_planning(&q->descent, b);
        q->asked =
            SLI_TAKE(b, sl_int, sli_entries_is_all(q) ? 0 : (uint64_t)q->descent.forest.count + 1);
    }
}

/* The list of the descent, and the requests of each of its supernodes. */
static void sli_entries_plan(void *call) {
    sli_entries *q = (sli_entries *)call;
    const sli_requests *r = &q->requests;
    const int is_all = sli_entries_is_all(q);
    sl_int k = 0, at;
    if (q->method != SL_INVERSE_SELECTED) {
        return;
    }
    if (!is_all) {
        sli_entries_sort(q);
    }
    sli_descent_plan(&q->descent, is_all ? NULL : r->order, r->count);
    for (at = 0; at < q->descent.forest.count && !is_all; at++) {
        const sl_int end = q->F->S->super_first[q->descent.supers[at] + 1];
        q->asked[at] = k;
        while (k < r->count && sli_key(r->order[k]) < end) {
            k++;
        }
    }
    if (!is_all) {
        q->asked[at] = k;
    }
}

static void sli_entries_lay_run(void *call, sli_block *b) {
    sli_entries *q = (sli_entries *)call;
    if (q->method == SL_INVERSE_SELECTED) {
        sli_descent_layout_run(&q->run, &q->descent, b);
    }
}

/* What row tiles t0 .. t1-1 of a front answer. */
static void sli_entries_take(void *call, sl_int at, const sli_dual *f, sl_int t0, sl_int t1) {
    const sli_entries *q = (const sli_entries *)call;
    const sl_symbolic *S = q->F->S;
    const sl_int s = q->descent.supers[at], first = S->super_first[s], h = f->width + f->below;
    sl_int k, j;
    if (sli_entries_is_all(q)) {
        const sl_int *row = S->perm + first, last = sli_min(SLI_TILE * t1, f->width);
        for (j = SLI_TILE * t0; j < last; j++) {
            q->out[row[j]] = f->front[sli_square_offset(h, j / SLI_TILE) + SLI_TILE * (ptrdiff_t)j +
                                      j % SLI_TILE];
        }
        return;
    }
    for (k = q->asked[at]; k < q->asked[at + 1]; k++) {
        const sl_int request = sli_value(q->requests.order[k]);
        const sl_int r = sli_entries_row(q, s, request), t = r / SLI_TILE;
        if (t >= t0 && t < t1) {
            j = sli_key(q->requests.order[k]) - first;
            q->out[request] =
                f->front[sli_square_offset(h, t) + SLI_TILE * (ptrdiff_t)j + r % SLI_TILE];
        }
    }
}

/* The sums that the sorted requests k .. k+taken-1, one group, ask for. */
static void sli_entries_answer(const sli_entries *q, const sli_group *g, sl_int k, sl_int taken) {
    sl_int first[SLI_REQUESTS_MAX], second[SLI_REQUESTS_MAX], m;
    double sums[SLI_REQUESTS_MAX];
    for (m = 0; m < taken; m++) {
        const sl_int at = sli_value(q->requests.order[k + m]);
        first[m] = sli_group_lane(g, sli_request_row(&q->requests, at));
        second[m] = sli_group_lane(g, sli_request_column(&q->requests, at));
    }
    sli_pair_sums(q->F, &q->forward, taken, first, second, sums);
    for (m = 0; m < taken; m++) {
        q->out[sli_value(q->requests.order[k + m])] = sums[m];
    }
}

/* Group after group. */
static void sli_entries_forward(sli_entries *q, sl_stats *stats) {
    sl_int k = 0, m;
    for (m = 0; m < q->requests.n_groups; m++) {
        const sl_int taken = (sl_int)q->requests.taken[m];
        sli_group g;
        sli_group_again(&q->requests, k, taken, &g);
        sli_forward_group(&q->forward, q->F, &g, stats);
        sli_entries_answer(q, &g, k, taken);
        k += taken;
    }
}

/* A call for count entries, rows NULL for the whole diagonal. */
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

static const sli_stage sli_entries_stages[3] = {{sli_entries_lay_requests, sli_entries_choose},
                                                {sli_entries_lay_way, sli_entries_plan},
                                                {sli_entries_lay_run, NULL}};

/* Chooses the way and lays everything out; W may grow, nothing else is written. */
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
        q->run.d = &q->descent;
        q->run.threads = q->threads;
        q->run.take = sli_entries_take;
        q->run.to = q;
        sli_descend(&q->run);
    }
    if (stats != NULL) {
        stats->inverse_method = q->method;
        if (q->method == SL_INVERSE_SELECTED) {
            sli_descent_stats(&q->descent, stats);
            stats->z_entries = 0;
        }
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
    if (!F->is_good) {
        return SL_ERR_STATE;
    }
    status = sli_check_rows(F->S, rows, count, 0, stats);
    status = status == SL_OK ? sli_check_rows(F->S, columns, count, 1, stats) : status;
    if (status != SL_OK) {
        return status;
    }
    sli_inverse_stats(stats);
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

#endif
/* end src/impl/inverse_entries.h */
/* begin src/impl/inverse_block.h */
/* inverse_block.h: dense blocks of A^-1: every row and column swept forward, then all sums between two sweeps */
#ifndef SLI_INVERSE_BLOCK_H
#define SLI_INVERSE_BLOCK_H

/* Sweeps that are kept while the other side passes by: 128 vectors. One more pass then costs a tenth
 * or so of the sums between them. */
#define SLI_KEPT 16

/* z = D^-1 y over the whole reach of a sweep: once for all that it meets. */
static void sli_forward_weigh(const sl_factor *F, const sli_forward *f, double *z) {
    sl_int s, k;
    for (s = 0; s < f->reach.count; s++) {
        const sli_step *step = &f->reach.steps[s];
        const double *d = F->D + step->column;
        for (k = 0; k < sli_step_columns(step); k++) {
            const ptrdiff_t at = (ptrdiff_t)(step->base + k) * f->lanes;
            sli_weigh(z + at, f->y + at, d[k], f->lanes);
        }
    }
}

/* sums[8 i + j] = y_i' z_j over the columns that two sweeps share, lane i of f, and lane j of g, whose
 * weighed vectors are z. In plain C a block of 128 x 128 near-by vertices took 2.8 times as long. */
static void sli_cross_sums(const sl_factor *F, const sli_forward *f, const sli_forward *g,
                           const double *z, double *sums) {
    sli_meeting m = sli_meeting_of(&f->reach, &g->reach);
    sl_int k, i, j;
    memset(sums, 0, SLI_LANES_MAX * SLI_LANES_MAX * sizeof(double));
    while (sli_meet(&m)) {
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

/* A group with its sweep, and which of the sorted requests it answers. */
typedef struct sli_swept {
    sli_group group;
    sli_forward forward;
    sl_int first, taken;
} sli_swept;

/* One block: `kept` is the side with fewer requests. */
typedef struct sli_inverse_block {
    const sl_factor *F;
    double *Z;
    size_t kept_stride, passing_stride; /* of Z, from one request of a side to the next */
    void (*put)(void *to, sl_int row, sl_int column,
                double z); /* takes entries in place of Z; or NULL */
    void *to;
    int is_symmetric; /* both sides are one: kept serves as passing */
    sli_requests kept, passing;
    sli_swept sweeps[SLI_KEPT], pass;
    double *weighed; /* of the group that passes by */
    sli_room kept_room, passing_room;
} sli_inverse_block;

static void sli_block_lay_requests(void *block, sli_block *b) {
    sli_inverse_block *q = (sli_inverse_block *)block;
    sli_requests_layout(&q->kept, b);
    if (!q->is_symmetric) {
        sli_requests_layout(&q->passing, b);
    }
}

static void sli_block_group(void *block) {
    sli_inverse_block *q = (sli_inverse_block *)block;
    memset(&q->kept_room, 0, sizeof q->kept_room);
    memset(&q->passing_room, 0, sizeof q->passing_room);
    sli_requests_group(&q->kept, &q->kept_room);
    if (!q->is_symmetric) {
        sli_requests_group(&q->passing, &q->passing_room);
    } else if (q->kept.n_groups > SLI_KEPT) {
        q->passing_room = q->kept_room;
    }
}

static void sli_block_lay_sweeps(void *block, sli_block *b) {
    sli_inverse_block *q = (sli_inverse_block *)block;
    const sli_room *kept = &q->kept_room, *passing = &q->passing_room;
    const sl_int count = sli_min(q->kept.n_groups, SLI_KEPT);
    sli_room both = *kept;
    sl_int k;
    both.rows = passing->rows > both.rows ? passing->rows : both.rows;
    both.scratch = passing->scratch > both.scratch ? passing->scratch : both.scratch;
    q->weighed =
        SLI_TAKE(b, double, passing->values > kept->values ? passing->values : kept->values);
    sli_forward_layout(&q->pass.forward, b, passing);
    sli_forward_layout_run(&q->pass.forward, b, &both);
    for (k = 0; k < count; k++) {
        sli_forward_layout(&q->sweeps[k].forward, b, kept);
        q->sweeps[k].forward.rows = q->pass.forward.rows;
        q->sweeps[k].forward.scratch = q->pass.forward.scratch;
    }
}

/* Sweeps the group of `taken` requests that starts at the k-th. */
static void sli_swept_make(sli_swept *s, const sl_factor *F, const sli_requests *r, sl_int k,
                           sl_int taken, sl_stats *stats) {
    s->first = k;
    s->taken = taken;
    sli_group_again(r, k, taken, &s->group);
    sli_forward_group(&s->forward, F, &s->group, stats);
}

/* Every entry between two groups, the second one weighed. */
static void sli_block_write(const sli_inverse_block *q, const sli_swept *a, const sli_swept *b) {
    const sli_requests *passing = q->is_symmetric ? &q->kept : &q->passing;
    SLI_ALIGNED(double sums[SLI_LANES_MAX * SLI_LANES_MAX]);
    sl_int i, j;
    sli_cross_sums(q->F, &a->forward, &b->forward, q->weighed, sums);
    for (i = 0; i < a->taken; i++) {
        const sl_int from = sli_value(q->kept.order[a->first + i]);
        const sl_int lane = sli_group_lane(&a->group, sli_request_row(&q->kept, from));
        for (j = 0; j < b->taken; j++) {
            const sl_int to = sli_value(passing->order[b->first + j]);
            const sl_int other = sli_group_lane(&b->group, sli_request_row(passing, to));
            const sl_int low = a == b ? sli_min(lane, other) : lane;
            const sl_int high = a == b ? sli_max(lane, other) : other;
            const double sum = sums[SLI_LANES_MAX * low + high];
            if (q->put != NULL) {
                q->put(q->to, from, to, sum);
                continue;
            }
            q->Z[(size_t)from * q->kept_stride + (size_t)to * q->passing_stride] = sum;
            if (q->is_symmetric) {
                q->Z[(size_t)to * q->kept_stride + (size_t)from * q->passing_stride] = sum;
            }
        }
    }
}

/* Kept groups in chunks; for each chunk all of the other side passes by. Of a symmetric block, only
 * what comes at or after the chunk. */
static void sli_block_fill(sli_inverse_block *q, sl_stats *stats) {
    const sli_requests *passing = q->is_symmetric ? &q->kept : &q->passing;
    sl_int chunk, first = 0, k, m;
    for (chunk = 0; chunk < q->kept.n_groups; chunk += SLI_KEPT) {
        const sl_int count = sli_min(SLI_KEPT, q->kept.n_groups - chunk);
        sl_int at = 0;
        for (k = 0; k < count; k++) {
            const sl_int taken = (sl_int)q->kept.taken[chunk + k];
            sli_swept_make(&q->sweeps[k], q->F, &q->kept, first, taken, stats);
            first += taken;
        }
        for (k = 0; q->is_symmetric && k < count; k++) {
            sli_forward_weigh(q->F, &q->sweeps[k].forward, q->weighed);
            for (m = 0; m <= k; m++) {
                sli_block_write(q, &q->sweeps[m], &q->sweeps[k]);
            }
        }
        at = q->is_symmetric ? first : 0;
        for (k = q->is_symmetric ? chunk + count : 0; k < passing->n_groups; k++) {
            const sl_int taken = (sl_int)passing->taken[k];
            sli_swept_make(&q->pass, q->F, passing, at, taken, stats);
            sli_forward_weigh(q->F, &q->pass.forward, q->weighed);
            for (m = 0; m < count; m++) {
                sli_block_write(q, &q->sweeps[m], &q->pass);
            }
            at += taken;
        }
    }
}

static const sli_stage sli_block_stages[2] = {{sli_block_lay_requests, sli_block_group},
                                              {sli_block_lay_sweeps, NULL}};

static sl_status sli_block_answer(sli_inverse_block *q, sl_work *W, sl_stats *stats) {
    const sl_status status = sli_work_stages(W, sli_block_stages, 2, q);
    if (status == SL_OK) {
        sli_block_fill(q, stats);
    }
    return status;
}

/* Every entry between some rows, in range, handed over by their numbers; those of two groups once, in either order. */
static sl_status sli_inverse_among(const sl_factor *F, const sl_int *rows, sl_int count,
                                   void (*put)(void *to, sl_int row, sl_int column, double z),
                                   void *to, sl_work *W) {
    sli_inverse_block q;
    memset(&q, 0, sizeof q);
    q.F = F;
    q.put = put;
    q.to = to;
    q.is_symmetric = 1;
    q.kept = q.passing = sli_requests_of(F, rows, rows, count);
    return count == 0 ? SL_OK : sli_block_answer(&q, W, NULL);
}

SL_API sl_status sl_inverse_block(const sl_factor *F, double *Z, size_t ldz, const sl_int *rows,
                                  sl_int n_rows, const sl_int *columns, sl_int n_columns,
                                  sl_work *W, sl_stats *stats) {
    const int rows_pass = n_rows > n_columns, is_empty = n_rows == 0 || n_columns == 0;
    sl_work own;
    sli_inverse_block q;
    sl_status status;
    sli_stats_clear_error(stats);
    if (F == NULL || n_rows < 0 || n_columns < 0 || (n_rows > 0 && rows == NULL) ||
        (n_columns > 0 && columns == NULL) || (!is_empty && (Z == NULL || ldz < (size_t)n_rows))) {
        return SL_ERR_ARGUMENT;
    }
    if (!F->is_good) {
        return SL_ERR_STATE;
    }
    status = sli_check_rows(F->S, rows, n_rows, 0, stats);
    status = status == SL_OK ? sli_check_rows(F->S, columns, n_columns, 1, stats) : status;
    if (status != SL_OK) {
        return status;
    }
    sli_inverse_stats(stats);
    memset(&q, 0, sizeof q);
    q.F = F;
    q.Z = Z;
    q.is_symmetric = rows == columns && n_rows == n_columns;
    q.kept = rows_pass ? sli_requests_of(F, columns, columns, n_columns)
                       : sli_requests_of(F, rows, rows, n_rows);
    q.passing = rows_pass ? sli_requests_of(F, rows, rows, n_rows)
                          : sli_requests_of(F, columns, columns, n_columns);
    q.kept_stride = rows_pass ? ldz : 1;
    q.passing_stride = rows_pass ? 1 : ldz;
    own = sli_work_own(&F->allocator);
    status = is_empty ? SL_OK : sli_block_answer(&q, W == NULL ? &own : W, stats);
    sli_free(&own.allocator, own.block);
    return status;
}

#endif
/* end src/impl/inverse_block.h */
/* begin src/impl/refine.h */
/* refine.h: iterative refinement of full solutions, column by column, by the backward error of every row */
#ifndef SLI_REFINE_H
#define SLI_REFINE_H

/* Up to 8 right-hand sides on their way. */
typedef struct sli_refinement {
    const sl_factor *F;
    const sl_csc *A;
    sl_triangle triangle;
    double *R, *T;         /* n x columns: residuals, then corrections; what is tried */
    double *size;          /* n: |A| |x| + |b| */
    unsigned char *memory; /* for solves */
    double error[SLI_TILE];
    int is_done[SLI_TILE];
    sl_int steps; /* taken */
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

/* r = b - A x and the backward error of x: the least change of every entry of A and b, relative to it, that makes x a
 * solution. */
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

/* R := A^-1 R, as good as F knows it, consistent or not. */
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

/* One correction of column c, already solved for; done where it does not halve the error. Returns whether it was taken.
 */
static int sli_refine_column(sli_refinement *f, sl_int c, double *x, const double *b) {
    const size_t n = (size_t)f->F->S->n;
    double *t = f->T + n * (size_t)c, *r = f->R + n * (size_t)c, error;
    size_t i;
    int is_better;
    for (i = 0; i < n; i++) {
        t[i] = x[i] + r[i];
    }
    error = sli_row_error(f, r, t, b);
    is_better = error < f->error[c];
    f->is_done[c] = !(error <= 0.5 * f->error[c]) || error <= DBL_EPSILON;
    if (is_better) {
        memcpy(x, t, n * sizeof(double));
        f->error[c] = error;
    }
    return is_better;
}

static void sli_refine_block(sli_refinement *f, double *X, size_t ldx, const double *B, size_t ldb,
                             sl_int columns, sl_int steps) {
    const size_t n = (size_t)f->F->S->n;
    sl_int c, step, todo = 0;
    for (c = 0; c < columns; c++) {
        f->error[c] =
            sli_row_error(f, f->R + n * (size_t)c, X + ldx * (size_t)c, B + ldb * (size_t)c);
        f->is_done[c] = f->error[c] <= DBL_EPSILON;
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

/* The larger of two errors, NaN if one is. */
SLI_INLINE double sli_worse(double a, double b) {
    return a != a || a > b ? a : b;
}

static void sli_refine_stats(sl_stats *stats, sl_int steps, double error) {
    if (stats != NULL) {
        stats->refine_steps = steps;
        stats->backward_error = error;
    }
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
    if (!F->is_good) {
        return SL_ERR_STATE;
    }
    status = sli_factor_check(F->S, A);
    if (status != SL_OK) {
        return status;
    }
    memset(&f, 0, sizeof f);
    f.F = F;
    f.A = A;
    f.triangle = sli_triangle_scan(A);
    own = sli_work_own(&F->allocator);
    W = W == NULL ? &own : W;
    sli_refinement_layout(&f, &b, sli_min(nrhs, 8));
    status = nrhs > 0 ? sli_work_lay(W, &b) : SL_OK;
    if (status == SL_OK && nrhs > 0) {
        sli_refinement_layout(&f, &b, sli_min(nrhs, 8));
        for (r = 0; r < nrhs; r += 8) {
            sli_refine_block(&f, X + ldx * (size_t)r, ldx, B + ldb * (size_t)r, ldb,
                             sli_min(8, nrhs - r), steps);
            for (c = 0; c < sli_min(8, nrhs - r); c++) {
                worst = sli_worse(f.error[c], worst);
            }
        }
    }
    sli_free(&own.allocator, own.block);
    if (status == SL_OK) {
        sli_refine_stats(stats, f.steps, worst);
    }
    return status;
}

#endif
/* end src/impl/refine.h */
/* begin src/impl/refine_local.h */
/* refine_local.h: local solves with a regularized factor: the residual E x of the rows that were regularized, solved for */
#ifndef SLI_REFINE_LOCAL_H
#define SLI_REFINE_LOCAL_H

/* The regularized rows that a plan's right-hand sides can meet, and up to 8 right-hand sides on their way. */
typedef struct sli_mending {
    const sl_factor *F;
    const sli_query *q;
    sl_int count, room;
    sl_int *row;           /* room: pivots, ascending */
    sl_int *in_y;          /* room: their places in the forward vector .. */
    sl_int *in_x;          /* .. and in the backward vector */
    double *last;          /* room x 8: x there one step ago, 0 at first */
    double *now;           /* nx x 8, column-major: the last x, */
    double *kept;          /* the best */
    unsigned char *memory; /* for sweeps */
    double error[SLI_TILE];
    int is_done[SLI_TILE];
    sl_int steps;
} sli_mending;

static void sli_mending_layout(sli_mending *f, sli_block *b, sl_int nrhs) {
    const size_t bytes = sli_vectors_bytes(f->q, nrhs);
    const uint64_t columns = (uint64_t)sli_min(nrhs, 8);
    f->row = SLI_TAKE(b, sl_int, f->room);
    f->in_y = SLI_TAKE(b, sl_int, f->room);
    f->in_x = SLI_TAKE(b, sl_int, f->room);
    f->last = SLI_TAKE(b, double, (uint64_t)f->room *columns);
    f->now = SLI_TAKE(b, double, (uint64_t)f->q->nx *columns);
    f->kept = SLI_TAKE(b, double, (uint64_t)f->q->nx *columns);
    f->memory = (unsigned char *)sli_take(b, bytes, 1);
}

/* Finds the regularized rows of every tree that b is in. -1, or the pivot of one that the reaches do not hold. */
static sl_int sli_mending_find(sli_mending *f) {
    const sl_factor *F = f->F;
    const sli_reach *R = &f->q->forward;
    sl_int s;
    f->count = 0;
    for (s = 0; s < R->count; s++) {
        sli_tree tree;
        sl_int m;
        if (R->steps[s].up != -1) {
            continue;
        }
        tree = sli_tree_of(F->S, &R->steps[s]);
        m = sli_lower_bound(F->regularized, F->stats.regularized, tree.first);
        for (; m < F->stats.regularized && F->regularized[m] <= tree.root; m++) {
            const sl_int k = F->regularized[m];
            const sl_int in_y = sli_reach_place_of(R, k),
                         in_x = sli_reach_place_of(&f->q->backward, k);
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

/* Solves (A + E) x = b + E last, and takes x where its residual E (x - last) is the least so far. */
static void sli_mending_step(sli_mending *f, const double *B, sli_dense at, sl_int columns,
                             const double *norms, sl_int step) {
    const sl_int lanes = (sl_int)1 << sli_lanes_kind(columns);
    const sli_vectors v = sli_vectors_of(f->q, columns, f->memory);
    const size_t nx = (size_t)f->q->nx;
    sl_int m, c;
    sli_pack(f->q, v.y, B, at, lanes, columns);
    for (m = 0; m < f->count; m++) {
        for (c = 0; c < columns; c++) {
            v.y[(ptrdiff_t)f->in_y[m] * lanes + c] +=
                f->F->rule.shifts[f->row[m]] * f->last[(ptrdiff_t)m * columns + c];
        }
    }
    sli_sweep_forward(f->F, f->q, &v, columns);
    sli_sweep_backward(f->F, f->q, &v, columns);
    sli_unpack(f->q, f->now, sli_dense_of(SLI_COLUMN_MAJOR, nx), v.x, lanes, columns);
    for (c = 0; c < columns; c++) {
        double error = 0.0;
        for (m = 0; m < f->count; m++) {
            double *last = &f->last[(ptrdiff_t)m * columns + c];
            const double x = v.x[(ptrdiff_t)f->in_x[m] * lanes + c];
            error = sli_worse(fabs(f->F->rule.shifts[f->row[m]] * (x - *last)), error);
            *last = x;
        }
        error = sli_backward_error(error, 0.0, 0.0, norms[c]);
        if (step == 0 || (!f->is_done[c] && error < f->error[c])) {
            f->is_done[c] = step > 0 && !(error <= 0.5 * f->error[c]);
            f->is_done[c] |= error <= DBL_EPSILON;
            f->error[c] = error;
            f->steps = sli_max(f->steps, step);
            memcpy(f->kept + nx * (size_t)c, f->now + nx * (size_t)c, nx * sizeof(double));
        } else {
            f->is_done[c] = 1;
        }
    }
}

static void sli_mend_block(sli_mending *f, double *X, size_t ldx, const double *B, size_t ldb,
                           sl_int columns, sl_int steps) {
    const sli_dense at = sli_dense_of(SLI_COLUMN_MAJOR, ldb);
    const size_t nx = (size_t)f->q->nx;
    double norms[SLI_TILE];
    sl_int c, step, todo = columns;
    for (c = 0; c < columns; c++) {
        norms[c] = sli_largest(f->q->nb > 0 ? B + ldb * (size_t)c : B, f->q->nb);
    }
    memset(f->last, 0, (size_t)f->count * (size_t)columns * sizeof(double));
    for (step = 0; step <= steps && todo > 0; step++) {
        sli_mending_step(f, B, at, columns, norms, step);
        for (c = 0, todo = 0; c < columns; c++) {
            todo += !f->is_done[c];
        }
    }
    for (c = 0; c < columns; c++) {
        memcpy(X + ldx * (size_t)c, f->kept + nx * (size_t)c, nx * sizeof(double));
    }
}

/* Blocks of a plan's right-hand sides in a workspace. */
static sl_status sli_mend(sli_mending *f, double *X, size_t ldx, const double *B, size_t ldb,
                          sl_int nrhs, sl_int steps, sl_work *W, sl_stats *stats) {
    sli_block b = {NULL, 0, 0};
    double worst = 0.0;
    sl_status status;
    sl_int r, c;
    sli_mending_layout(f, &b, nrhs);
    status = sli_work_lay(W, &b);
    if (status != SL_OK) {
        return status;
    }
    sli_mending_layout(f, &b, nrhs);
    c = sli_mending_find(f);
    if (c != -1) {
        return sli_fail_at(stats, SL_ERR_ARGUMENT, f->F->S->perm[c], -1, f->F->rule.shifts[c]);
    }
    for (r = 0; r < nrhs; r += 8) {
        const sl_int columns = sli_min(8, nrhs - r);
        sli_mend_block(f, X + ldx * (size_t)r, ldx, f->q->nb > 0 ? B + ldb * (size_t)r : B, ldb,
                       columns, steps);
        for (c = 0; c < columns; c++) {
            worst = sli_worse(f->error[c], worst);
        }
    }
    sli_refine_stats(stats, f->steps, worst);
    return SL_OK;
}

SL_API sl_status sl_plan_solve_refined(const sl_plan *P, const sl_factor *F, double *X, size_t ldx,
                                       const double *B, size_t ldb, sl_int nrhs, sl_int steps,
                                       sl_work *W, sl_stats *stats) {
    sli_mending f;
    sl_work own;
    sl_status status;
    sli_stats_clear_error(stats);
    if (P == NULL || F == NULL || steps < 0) {
        return SL_ERR_ARGUMENT;
    }
    if (F->stats.regularized == 0 || nrhs == 0 || P->query.nx == 0) {
        status = sl_plan_solve(P, F, X, ldx, B, ldb, nrhs, W);
        if (status == SL_OK) {
            sli_refine_stats(stats, 0, 0.0);
        }
        return status;
    }
    status = sli_check_dense(X, ldx, P->query.nx, B, ldb, P->query.nb, SLI_COLUMN_MAJOR, nrhs);
    if (status != SL_OK) {
        return status;
    }
    if (!sli_query_fits(&P->query, F)) {
        return SL_ERR_STATE;
    }
    if (P->query.region != NULL) { /* E is not known to be 0 outside of it */
        return SL_ERR_UNSUPPORTED;
    }
    memset(&f, 0, sizeof f);
    f.F = F;
    f.q = &P->query;
    f.room = sli_min(F->stats.regularized, P->query.forward.columns);
    own = sli_work_own(&F->allocator);
    status = sli_mend(&f, X, ldx, B, ldb, nrhs, steps, W == NULL ? &own : W, stats);
    sli_free(&own.allocator, own.block);
    return status;
}

#endif
/* end src/impl/refine_local.h */
/* begin src/impl/condition.h */
/* condition.h: the condition number by Hager and Higham's estimate, and what right-hand sides lack to be consistent */
#ifndef SLI_CONDITION_H
#define SLI_CONDITION_H

/* A vector in pivot order that is solved for in place, and signs to go with it. */
typedef struct sli_probe {
    const sl_factor *F;
    sli_reach all;
    double *v, *signs, *scratch;
} sli_probe;

static void sli_probe_layout(sli_probe *p, sli_block *b) {
    p->v = SLI_TAKE(b, double, p->all.columns);
    p->signs = SLI_TAKE(b, double, p->all.columns);
    p->scratch = SLI_TAKE(b, double, sli_scratch_size(p->all.tallest, p->all.widest, 1));
}

/* v := (P A P')^-1 v; returns the sum of its magnitudes. */
static double sli_probe_solve(const sli_probe *p) {
    const sl_factor *F = p->F;
    double sum = 0.0;
    sl_int k;
    F->kernels->forward[SLI_LANES_1](p->all.count, p->all.steps, p->all.rows, F->L, p->v,
                                     p->scratch);
    F->kernels->backward[SLI_LANES_1](p->all.count, p->all.steps, p->all.rows + p->all.n_rows, F->L,
                                      F->D, p->v, p->scratch);
    for (k = 0; k < p->all.columns; k++) {
        sum += fabs(p->v[k]);
    }
    return sum;
}

/* The signs of v; returns whether they are what they were. */
static int sli_probe_signs(const sli_probe *p) {
    int same = 1;
    sl_int k;
    for (k = 0; k < p->all.columns; k++) {
        const double sign = p->v[k] < 0.0 ? -1.0 : 1.0;
        same &= sign == p->signs[k];
        p->signs[k] = sign;
    }
    return same;
}

/* The place of the largest magnitude in v. */
static sl_int sli_probe_largest(const sli_probe *p) {
    sl_int k, best = 0;
    for (k = 1; k < p->all.columns; k++) {
        best = fabs(p->v[k]) > fabs(p->v[best]) ? k : best;
    }
    return best;
}

/* The largest column sum of |A^-1|, from below: the convex function ||A^-1 x|| climbed over the unit ball's corners e_j,
 * of which the gradient A^-1 sign(A^-1 x) names the next one; then a vector that is hard to fool. A is
 * symmetric: one kind of solve does for both. n > 0. */
static double sli_inverse_norm(const sli_probe *p) {
    const sl_int n = p->all.columns;
    double best, sum;
    sl_int k, j = -1, turn;
    for (k = 0; k < n; k++) {
        p->v[k] = 1.0 / n;
        p->signs[k] = 0.0;
    }
    best = sli_probe_solve(p);
    for (turn = 0; turn < 4 && !sli_probe_signs(p); turn++) {
        sl_int last = j;
        memcpy(p->v, p->signs, (size_t)n * sizeof(double));
        (void)sli_probe_solve(p);
        j = sli_probe_largest(p);
        if (last != -1 && fabs(p->v[j]) <= fabs(p->v[last])) {
            break;
        }
        memset(p->v, 0, (size_t)n * sizeof(double));
        p->v[j] = 1.0;
        sum = sli_probe_solve(p);
        if (!(sum > best)) {
            break;
        }
        best = sum;
    }
    for (k = 0; k < n; k++) {
        p->v[k] = (k % 2 == 0 ? 1.0 : -1.0) * (1.0 + (double)k / (n > 1 ? n - 1 : 1));
    }
    sum = 2.0 * sli_probe_solve(p) / (3.0 * n);
    return sum > best || sum != sum ? sum : best;
}

SL_API sl_status sl_factor_rcond(const sl_factor *F, const sl_csc *A, double *rcond, sl_work *W) {
    sli_block b = {NULL, 0, 0};
    sl_work own;
    sli_probe p;
    sl_status status;
    if (F == NULL || rcond == NULL) {
        return SL_ERR_ARGUMENT;
    }
    if (!F->is_good) {
        return SL_ERR_STATE;
    }
    status = sli_factor_check(F->S, A);
    if (status != SL_OK) {
        return status;
    }
    if (F->S->n == 0 || F->n_nulls > 0) {
        *rcond = F->S->n == 0 ? 1.0 : 0.0;
        return SL_OK;
    }
    p.F = F;
    p.all = sli_reach_all(F->S);
    own = sli_work_own(&F->allocator);
    W = W == NULL ? &own : W;
    sli_probe_layout(&p, &b);
    status = sli_work_lay(W, &b);
    if (status == SL_OK) {
        double norm, inverse;
        sli_probe_layout(&p, &b);
        norm = sli_csc_norm(A, p.v);
        inverse = sli_inverse_norm(&p);
        *rcond = norm > 0.0 && inverse > 0.0 ? 1.0 / norm / inverse : 0.0;
    }
    sli_free(&own.allocator, own.block);
    return status;
}

/* The entries of y at the null pivots, block after block. */
static void sli_defects(const sl_factor *F, const sli_query *q, double *Y, size_t ldy,
                        const double *B, size_t ldb, sl_int nrhs, void *memory) {
    sl_int c, r, m;
    for (c = 0; c < nrhs; c += 8) {
        const sl_int block = sli_min(8, nrhs - c), lanes = (sl_int)1 << sli_lanes_kind(block);
        const sli_vectors v = sli_vectors_of(q, block, memory);
        sli_pack(q, v.y, B + (size_t)c * ldb, sli_dense_of(SLI_COLUMN_MAJOR, ldb), lanes, block);
        sli_sweep_forward(F, q, &v, block);
        for (m = 0; m < F->n_nulls; m++) {
            for (r = 0; r < block; r++) {
                Y[(size_t)m + (size_t)(c + r) * ldy] = v.y[(ptrdiff_t)F->nulls[m] * lanes + r];
            }
        }
    }
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
    if (!F->is_good) {
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
    b.overflow = b.used == SIZE_MAX;
    status = sli_work_lay(W, &b);
    if (status == SL_OK) {
        sli_defects(F, &q, Y, ldy, B, ldb, nrhs, W->block);
    }
    sli_free(&own.allocator, own.block);
    return status;
}

#endif
/* end src/impl/condition.h */
/* begin src/impl/batch.h */
/* batch.h: independent solves spread over workers by the entries of L that they read */
#ifndef SLI_BATCH_H
#define SLI_BATCH_H

typedef struct sli_batch {
    const sl_factor *F; /* of requests that name none */
    const sl_request *requests;
    sl_int count, workers;
    sl_off blocks;         /* of up to 8 right-hand sides */
    double total;          /* entries of L that all blocks read */
    sl_work *const *works; /* one a worker, or NULL */
    unsigned char *memory; /* then `bytes` a worker */
    size_t bytes;
    int checks;      /* some factor wants to know whether its right-hand sides are consistent: */
    int only_checks; /* looks for a right-hand side that is not consistent, and writes no X */
} sli_batch;

SLI_INLINE const sl_factor *sli_request_factor(const sli_batch *b, const sl_request *r) {
    return r->factor != NULL ? r->factor : b->F;
}

static sli_query sli_request_query(const sl_factor *F, const sl_request *r) {
    return r->plan == NULL ? sli_query_all(F->S) : r->plan->query;
}

SLI_INLINE sli_layout sli_request_layout(const sl_request *r) {
    return r->is_interleaved ? SLI_INTERLEAVED : SLI_COLUMN_MAJOR;
}

/* What one block of 8 right-hand sides reads, and one for the call itself. */
SLI_INLINE double sli_query_weight(const sli_query *q) {
    return 1.0 + (double)q->forward.entries + (double)q->backward.entries +
           (double)q->shore.entries;
}

/* Right-hand sides of a request that start before some share of the batch: whole blocks of 8, from
 * `before`, what the requests before it weigh. */
static sl_int sli_blocks_before(double share, double before, double weight, sl_int nrhs) {
    const double blocks = ceil((share - before) / weight);
    return blocks <= 0.0 ? 0 : blocks * 8.0 >= nrhs ? nrhs : (sl_int)blocks * 8;
}

/* Worker k's scratch. */
static void *sli_batch_memory(const sli_batch *b, sl_int k) {
    return b->works != NULL ? b->works[k]->block : b->memory + (size_t)k * b->bytes;
}

/* Right-hand sides first .. last-1 of a request. */
static sl_status sli_batch_part(const sli_batch *b, const sl_request *r, const sli_query *q,
                                sl_int first, sl_int last, void *memory) {
    const sl_factor *F = sli_request_factor(b, r);
    const sli_layout layout = sli_request_layout(r);
    const sli_dense x_at = sli_dense_of(layout, r->ldx), b_at = sli_dense_of(layout, r->ldb);
    const double *B = q->nb > 0 ? r->B + (size_t)first * b_at.column : r->B;
    if (b->only_checks) {
        return F->checks ? sli_sweep_check(F, q, B, b_at, last - first, memory) : SL_OK;
    }
    return sli_sweep_blocks(F, q, r->X + (size_t)first * x_at.column, x_at, B, b_at, last - first,
                            memory);
}

/* Worker k's share of the batch. Where it checks, it leaves the first request that failed, or -1, in its
 * memory. */
static void sli_batch_share(void *data, sl_int k) {
    const sli_batch *b = (const sli_batch *)data;
    const double from = b->total * k / b->workers, to = b->total * (k + 1) / b->workers;
    void *memory = sli_batch_memory(b, k);
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
        if (first < last && q.nx > 0 && sli_batch_part(b, r, &q, first, last, memory) != SL_OK) {
            failed = m;
        }
        before += weight * (sli_tiles(r->nrhs));
    }
    if (b->only_checks) {
        memcpy(memory, &failed, sizeof failed);
    }
}

/* Whether every right-hand side is consistent; *at: the first request with one that is not. */
static sl_status sli_batch_consistent(sli_batch *b, const sl_threads *threads, sl_int *at) {
    sl_int k, failed;
    b->only_checks = 1;
    sli_parallel(threads, b->workers, sli_batch_share, b);
    b->only_checks = 0;
    for (k = 0; k < b->workers && *at == -1; k++) { /* later workers have later requests */
        memcpy(&failed, sli_batch_memory(b, k), sizeof failed);
        *at = failed;
    }
    return *at == -1 ? SL_OK : SL_ERR_INCONSISTENT;
}

/* Checks every request; weighs them and finds the scratch that they need. */
static sl_status sli_batch_check(sli_batch *b, sl_int *at) {
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
        status =
            sli_check_dense(r->X, r->ldx, q.nx, r->B, r->ldb, q.nb, sli_request_layout(r), r->nrhs);
        if (status != SL_OK) {
            return status;
        }
        if (!sli_query_fits(&q, F)) {
            return SL_ERR_STATE;
        }
        bytes = r->nrhs > 0 ? sli_vectors_bytes(&q, r->nrhs) : 0;
        if (bytes == SIZE_MAX) {
            return SL_ERR_TOO_LARGE;
        }
        b->bytes = bytes > b->bytes ? bytes : b->bytes;
        b->checks |= F->checks;
        b->blocks += sli_tiles(r->nrhs);
        b->total += sli_query_weight(&q) * (sli_tiles(r->nrhs));
    }
    *at = -1;
    b->bytes = b->bytes < SLI_ALIGN ? SLI_ALIGN : b->bytes;
    return SL_OK;
}

/* Refuses workspaces that are not there, or given twice. */
static sl_status sli_works_check(sl_work *const *works, sl_int workers) {
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

/* Scratch for every worker: in the caller's workspaces, or in one block of a's to be freed. */
static sl_status sli_batch_reserve(sli_batch *b, sl_work *const *works, const sl_allocator *a) {
    sli_block block = {NULL, 0, 0};
    sl_status status = works == NULL ? SL_OK : sli_works_check(works, b->workers);
    sl_int k;
    int pass;
    for (k = 0; works != NULL && k < b->workers && status == SL_OK; k++) {
        status = sli_work_grow(works[k], b->bytes);
    }
    b->works = works;
    b->bytes = (b->bytes + SLI_ALIGN - 1) / SLI_ALIGN * SLI_ALIGN;
    for (pass = 0; works == NULL && pass < 2 && status == SL_OK; pass++) {
        for (k = 0; k < b->workers; k++) {
            unsigned char *memory = (unsigned char *)sli_take(&block, b->bytes, 1);
            b->memory = k == 0 ? memory : b->memory;
        }
        status = pass == 0 ? sli_block_alloc(&block, a) : SL_OK;
    }
    return status;
}

SL_API sl_status sl_batch_solve(const sl_factor *F, const sl_request *requests, sl_int count,
                                const sl_threads *threads, sl_work *const *works, sl_int *failed) {
    sl_threads none;
    sli_batch b;
    sl_status status;
    sl_int at = -1;
    memset(&none, 0, sizeof none);
    memset(&b, 0, sizeof b);
    threads = threads == NULL ? &none : threads;
    if (failed != NULL) {
        *failed = -1;
    }
    if (count < 0 || (count > 0 && requests == NULL) || threads->count < 0) {
        return SL_ERR_ARGUMENT;
    }
    if (F != NULL && !F->is_good) {
        return SL_ERR_STATE;
    }
    b.F = F;
    b.requests = requests;
    b.count = count;
    status = sli_batch_check(&b, &at);
    b.workers = sli_workers(threads);
    b.workers = b.blocks < b.workers ? (sl_int)b.blocks : b.workers;
    if (status == SL_OK && b.blocks > 0) {
        const sl_allocator *a = &sli_request_factor(&b, requests)->allocator;
        status = sli_batch_reserve(&b, works, a);
        if (status == SL_OK && b.checks) {
            status = sli_batch_consistent(&b, threads, &at);
        }
        if (status == SL_OK) {
            sli_parallel(threads, b.workers, sli_batch_share, &b);
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

#endif
/* end src/impl/batch.h */
/* begin src/impl/batch_factor.h */
/* batch_factor.h: several factorizations over one analysis, whole factors shared out among workers */
#ifndef SLI_BATCH_FACTOR_H
#define SLI_BATCH_FACTOR_H

typedef struct sli_family {
    sl_factor *const *factors; /* count; NULL: not there */
    sl_int count, workers;
    sli_source from; /* of the first: each has a column of coefficients */
} sli_family;

/* Has factor k no threads of its own? */
SLI_INLINE int sli_family_is_single(const sli_family *f, sl_int k) {
    return f->factors[k] != NULL && f->factors[k]->schedule.workers == 1;
}

static void sli_family_numbers(const sli_family *f, sl_int k) {
    sli_source from = f->from;
    if (from.terms > 0) {
        from.coefficients += (size_t)k * (size_t)from.terms;
    }
    sli_factor_begin(f->factors[k]);
    (void)sli_factor_numbers(f->factors[k], &from, sli_seconds(), NULL);
}

/* Worker w's turns among the factors without threads: they cost all alike. */
static void sli_family_share(void *data, sl_int w) {
    const sli_family *f = (const sli_family *)data;
    sl_int k, turn = 0;
    for (k = 0; k < f->count; k++) {
        if (sli_family_is_single(f, k) && turn++ % f->workers == w) {
            sli_family_numbers(f, k);
        }
    }
}

/* The numbers of all of them. Returns the first that failed, or count. */
static sl_int sli_family_run(sli_family *f, const sl_threads *threads) {
    sl_int k, singles = 0;
    for (k = 0; k < f->count; k++) {
        singles += sli_family_is_single(f, k);
    }
    f->workers = sli_max(sli_min(sli_workers(threads), singles), 1);
    sli_parallel(threads, f->workers, sli_family_share, f);
    for (k = 0; k < f->count; k++) {
        if (f->factors[k] != NULL && !sli_family_is_single(f, k)) {
            sli_family_numbers(f, k);
        }
    }
    for (k = 0; k < f->count && (f->factors[k] == NULL || f->factors[k]->is_good); k++) {
    }
    return k;
}

/* What the caller hears of them: of the first that failed, or of the last. */
static void sli_family_tell(const sli_family *f, sl_int at, double started, sl_stats *stats) {
    const sl_factor *F = f->count == 0 ? NULL : f->factors[sli_min(at, f->count - 1)];
    sl_int k;
    if (stats == NULL || F == NULL) {
        return;
    }
    sli_factor_stats_tell(F, stats);
    stats->seconds_setup = 0.0;
    stats->seconds_factor = sli_seconds() - started;
    stats->bytes_factor = 0;
    for (k = 0; k < f->count; k++) {
        if (f->factors[k] != NULL) {
            stats->seconds_setup += f->factors[k]->stats.seconds_setup;
            stats->bytes_factor += f->factors[k]->stats.bytes_factor;
        }
    }
}

/* Their memory, by this thread alone: whole rounds without threads, the rest with. Returns the first that
 * has none, or count. */
static sl_int sli_family_make(sl_factor **out, sl_int count, const sl_symbolic *S,
                              const sl_options *opt, sl_status *status, sl_stats *stats) {
    const sl_threads none = {0, NULL, NULL};
    const sl_int workers = opt == NULL ? 1 : sli_workers(&opt->threads);
    sl_options alone;
    sl_int k, at = count;
    memset(&alone, 0, sizeof alone);
    if (opt != NULL) {
        alone = *opt;
        alone.threads = none;
    }
    for (k = 0; k < count; k++) {
        const sl_status here = sli_factor_new(
            &out[k], S, k < count / workers * workers ? &alone : opt, at == count ? stats : NULL);
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
    const sl_threads none = {0, NULL, NULL};
    double started;
    sli_family f;
    sl_status status;
    sl_int k, bare, at;
    sli_stats_clear_error(stats);
    if (failed != NULL) {
        *failed = -1;
    }
    for (k = 0; k < count && out != NULL; k++) {
        out[k] = NULL;
    }
    if (count < 0 || (count > 0 && out == NULL) || S == NULL || !sli_factor_wishes_are_sound(opt)) {
        return SL_ERR_ARGUMENT;
    }
    f.factors = out;
    f.count = count;
    status = sli_source_of_sum(S, coefficients, values, terms, &f.from);
    if (status != SL_OK || count == 0) {
        return status;
    }
    bare = sli_family_make(out, count, S, opt, &status, stats);
    started = sli_seconds();
    at = sli_family_run(&f, opt == NULL ? &none : &opt->threads);
    status = at < bare ? out[at]->status : status;
    sli_family_tell(&f, sli_min(at, bare), started, stats);
    for (k = at; k < count; k++) {
        if (out[k] != NULL && !out[k]->is_good) {
            sl_factor_free(out[k]);
            out[k] = NULL;
        }
    }
    at = sli_min(at, bare);
    if (failed != NULL && at < count) {
        *failed = at;
    }
    return status;
}

/* Whether the factors can be made again together; *at: the one at fault, -1 for all or none. */
static sl_status sli_family_check(sl_factor *const *factors, sl_int count, sl_int *at) {
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
        if (factors[k]->S != factors[0]->S) {
            return SL_ERR_STATE;
        }
    }
    *at = -1;
    return SL_OK;
}

SL_API sl_status sl_batch_refactor(sl_factor *const *factors, sl_int count,
                                   const double *coefficients, const double *const *values,
                                   sl_int terms, const sl_threads *threads, sl_int *failed,
                                   sl_stats *stats) {
    const sl_threads none = {0, NULL, NULL};
    const double started = sli_seconds();
    sli_family f;
    sl_status status;
    sl_int k, at = -1;
    sli_stats_clear_error(stats);
    threads = threads == NULL ? &none : threads;
    if (failed != NULL) {
        *failed = -1;
    }
    if (count < 0 || (count > 0 && factors == NULL) || threads->count < 0) {
        return SL_ERR_ARGUMENT;
    }
    status = sli_family_check(factors, count, &at);
    if (status == SL_OK && count > 0) {
        status = sli_source_of_sum(factors[0]->S, coefficients, values, terms, &f.from);
    }
    if (status == SL_OK && count > 0) {
        f.factors = factors;
        f.count = count;
        k = sli_family_run(&f, threads);
        sli_family_tell(&f, k, started, stats);
        at = k < count ? k : -1;
        status = k < count ? factors[k]->status : SL_OK;
    }
    if (failed != NULL) {
        *failed = at;
    }
    return status;
}

#endif
/* end src/impl/batch_factor.h */
/* begin src/impl/batch_inverse.h */
/* batch_inverse.h: diagonals of several inverses over one analysis, whole factors shared out among workers */
#ifndef SLI_BATCH_INVERSE_H
#define SLI_BATCH_INVERSE_H

typedef struct sli_diagonals {
    const sl_factor *const *factors;
    sl_int count, workers;
    double *out; /* n_rows x count */
    size_t ldo;
    const sl_int *rows; /* NULL: all n_rows */
    sl_int n_rows;
    sl_threads none;
    sl_work *const *works; /* one a worker, with room for any of the factors */
} sli_diagonals;

/* One factor's. Inside a loop over several workers none of them begins another. */
static sli_entries sli_diagonals_entries(const sli_diagonals *d, sl_int k) {
    sli_entries q =
        sli_entries_of(d->factors[k], d->out + (size_t)k * d->ldo, d->rows, d->rows, d->n_rows);
    q.threads = d->workers > 1 ? &d->none : q.threads;
    return q;
}

/* Worker w's turns among the factors. */
static void sli_diagonals_share(void *data, sl_int w) {
    const sli_diagonals *d = (const sli_diagonals *)data;
    sl_int k;
    for (k = w; k < d->count; k += d->workers) {
        sli_entries q = sli_diagonals_entries(d, k);
        const sl_status status = sli_entries_run(&q, d->works[w], NULL);
        SLI_ASSERT(status == SL_OK); /* all that could go wrong was tried before */
        (void)status;
    }
}

/* Checks every factor; *at: the one at fault. */
static sl_status sli_diagonals_check(const sli_diagonals *d, sl_int *at, sl_stats *stats) {
    for (*at = 0; *at < d->count; ++*at) {
        const sl_factor *F = d->factors[*at];
        if (F == NULL) {
            return SL_ERR_ARGUMENT;
        }
        if (!F->is_good || F->S != d->factors[0]->S) {
            return SL_ERR_STATE;
        }
    }
    *at = -1;
    return d->count == 0 ? SL_OK : sli_check_rows(d->factors[0]->S, d->rows, d->n_rows, 0, stats);
}

/* Room in every workspace for any of the factors: it depends on the rows, and on the instruction set. */
static sl_status sli_diagonals_reserve(const sli_diagonals *d) {
    sl_status status = SL_OK;
    sl_int k;
    for (k = 0; k < d->count && status == SL_OK; k++) {
        if (k == 0 || d->factors[k]->kernels != d->factors[k - 1]->kernels ||
            d->workers == 1) { /* then threads of their own count */
            sli_entries q = sli_diagonals_entries(d, k);
            status = sli_entries_prepare(&q, d->works[0]);
        }
    }
    for (k = 1; k < d->workers && status == SL_OK; k++) {
        status = sli_work_grow(d->works[k], d->works[0]->size);
    }
    return status;
}

/* The same with workspaces of the call's own. */
static sl_status sli_diagonals_run(sli_diagonals *d, const sl_threads *threads) {
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
    status = sli_diagonals_reserve(d);
    if (status == SL_OK) {
        sli_parallel(threads, d->workers, sli_diagonals_share, d);
    }
    for (w = 0; w < d->workers && own != NULL; w++) {
        sli_free(a, own[w].block);
    }
    sli_free(a, b.base);
    return status;
}

SL_API sl_status sl_batch_diagonal(const sl_factor *const *factors, sl_int count, double *out,
                                   size_t ldo, const sl_int *rows, sl_int n_rows,
                                   const sl_threads *threads, sl_work *const *works, sl_int *failed,
                                   sl_stats *stats) {
    const sl_threads none = {0, NULL, NULL};
    sli_diagonals d;
    sl_status status;
    sl_int at = -1;
    sli_stats_clear_error(stats);
    threads = threads == NULL ? &none : threads;
    if (failed != NULL) {
        *failed = -1;
    }
    if (count < 0 || (count > 0 && factors == NULL) || threads->count < 0) {
        return SL_ERR_ARGUMENT;
    }
    d.none = none;
    d.factors = factors;
    d.count = count;
    d.workers = sli_min(sli_workers(threads), count);
    d.out = out;
    d.ldo = ldo;
    d.rows = rows;
    d.n_rows = n_rows;
    d.works = works;
    status = sli_diagonals_check(&d, &at, stats);
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
    status = works == NULL ? SL_OK : sli_works_check(works, d.workers);
    return status == SL_OK && n_rows > 0 ? sli_diagonals_run(&d, threads) : status;
}

#endif
/* end src/impl/batch_inverse.h */
/* begin src/impl/selected.h */
/* selected.h: the selected inverse: the panels that a descent of a list of supernodes leaves */
#ifndef SLI_SELECTED_H
#define SLI_SELECTED_H

struct sl_selected {
    sl_allocator allocator;
    sl_threads threads;
    const sl_factor *F;  /* Z is its inverse, and .. */
    uint64_t generation; /* .. of these numbers of it */
    sli_descent descent; /* its list, its analysis */
    sl_off *begin;       /* count + 1: the panels, in doubles */
    double *Z;
    size_t bytes;
};

static void sli_selected_layout(sl_selected *Z, sli_block *b) {
    (void)sli_take(b, 1, sizeof(sl_selected));
    Z->begin = SLI_TAKE(b, sl_off, (uint64_t)Z->descent.forest.count + 1);
    sli_descent_layout(&Z->descent, b);
    Z->bytes = b->used;
}

/* Rows of A as columns of L, ascending, for a reach. */
static sl_status sli_selected_sort(const sl_symbolic *S, const sl_int *set, sl_int count,
                                   uint64_t *seeds, uint64_t *scratch, sl_stats *stats) {
    sl_int k;
    for (k = 0; k < count; k++) {
        if (set[k] < 0 || set[k] >= S->n) {
            return sli_fail_at(stats, SL_ERR_ARGUMENT, set[k], -1, 0.0);
        }
        seeds[k] = sli_keyed(S->iperm[set[k]], 0);
    }
    sli_sort(seeds, count, scratch);
    return SL_OK;
}

/* Arrays of a draft's list, filled for its seeds, NULL for all. */
static sl_status sli_selected_plan(sl_selected **out, sl_selected *draft, const uint64_t *seeds,
                                   sl_int n_seeds) {
    const sl_symbolic *S = draft->descent.S;
    sli_block temporary = {NULL, 0, 0}, kept = {NULL, 0, 0};
    sl_status status = SL_OK;
    sl_int k;
    int pass;
    for (pass = 0; pass < 2 && status == SL_OK; pass++) {
        sli_selected_layout(draft, &kept);
        status = pass == 0 ? sli_block_alloc(&kept, &draft->allocator) : SL_OK;
    }
    for (pass = 0; pass < 2 && status == SL_OK; pass++) {
        sli_descent_layout_planning(&draft->descent, &temporary);
        status = pass == 0 ? sli_block_alloc(&temporary, &draft->allocator) : SL_OK;
    }
    if (status == SL_OK) {
        sli_descent_plan(&draft->descent, seeds, n_seeds);
        draft->begin[0] = 0;
        for (k = 0; k < draft->descent.forest.count; k++) {
            const sl_int s = draft->descent.supers[k];
            draft->begin[k + 1] = draft->begin[k] + (S->panel_begin[s + 1] - S->panel_begin[s]);
        }
        *out = (sl_selected *)(void *)kept.base;
        **out = *draft;
    } else {
        sli_free(&draft->allocator, kept.base);
    }
    sli_free(&draft->allocator, temporary.base);
    return status;
}

/* The object, all but its numbers. */
static sl_status sli_selected_list(sl_selected **out, const sl_factor *F, const sl_int *set,
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
    draft.threads = opt == NULL || opt->threads.count == 0 ? F->threads : opt->threads;
    for (pass = 0; pass < 2 && status == SL_OK && set != NULL; pass++) {
        seeds = SLI_TAKE(&b, uint64_t, count);
        scratch = SLI_TAKE(&b, uint64_t, count);
        status = pass == 0 ? sli_block_alloc(&b, &draft.allocator) : SL_OK;
    }
    if (status == SL_OK && set != NULL) {
        status = sli_selected_sort(S, set, count, seeds, scratch, stats);
    }
    if (status == SL_OK) {
        if (set != NULL) {
            sli_reach R;
            sli_reach_measure(S, seeds, count, &R);
            supers = R.count;
        }
        draft.descent = sli_descent_of(S, supers, sli_workers(&draft.threads));
        status = sli_selected_plan(out, &draft, seeds, count);
    }
    sli_free(&draft.allocator, b.base);
    return status;
}

/* Row tiles of a front to the panel. */
static void sli_selected_keep(void *to, sl_int k, const sli_dual *f, sl_int t0, sl_int t1) {
    const sl_selected *Z = (const sl_selected *)to;
    const sl_int w = f->width, h = w + f->below;
    double *panel = Z->Z + Z->begin[k];
    sl_int t, j;
    for (t = t0; t < t1; t++) {
        double *tile = panel + sli_tile_offset(w, t);
        const sl_int columns = sli_min(w, SLI_TILE * (t + 1)), rows = h - SLI_TILE * t;
        memcpy(tile, f->front + sli_square_offset(h, t), SLI_TILE * (size_t)columns * sizeof *tile);
        for (j = 0; j < columns && rows < SLI_TILE; j++) { /* padding */
            memset(tile + SLI_TILE * (ptrdiff_t)j + rows, 0,
                   (size_t)(SLI_TILE - rows) * sizeof *tile);
        }
    }
}

static void sli_selected_lay(void *q, sli_block *b) {
    sli_descending *run = (sli_descending *)q;
    sli_descent_layout_run(run, run->d, b);
}

static const sli_stage sli_selected_stage = {sli_selected_lay, NULL};

/* The numbers, in the caller's workspace or in one for this call. F fits. */
static sl_status sli_selected_fill(sl_selected *Z, const sl_factor *F, sl_work *W) {
    sl_work own = sli_work_own(&Z->allocator);
    sli_descending run;
    sl_status status;
    memset(&run, 0, sizeof run);
    run.F = F;
    run.d = &Z->descent;
    run.threads = &Z->threads;
    run.take = sli_selected_keep;
    run.to = Z;
    status = sli_work_stages(W == NULL ? &own : W, &sli_selected_stage, 1, &run);
    if (status == SL_OK) {
        sli_descend(&run);
        Z->F = F;
        Z->generation = F->generation;
    }
    sli_free(&own.allocator, own.block);
    return status;
}

/* Room for the numbers. */
static sl_status sli_selected_room(sl_selected *Z) {
    sli_block b = {NULL, 0, 0};
    sl_status status = SL_OK;
    int pass;
    for (pass = 0; pass < 2 && status == SL_OK; pass++) {
        Z->Z = SLI_TAKE(&b, double, Z->begin[Z->descent.forest.count]);
        Z->bytes += pass == 0 ? b.used : 0;
        status = pass == 0 ? sli_block_alloc(&b, &Z->allocator) : SL_OK;
    }
    return status;
}

static void sli_selected_stats(const sl_selected *Z, double started, sl_stats *stats) {
    if (stats != NULL) {
        sli_descent_stats(&Z->descent, stats);
        stats->z_entries = Z->begin[Z->descent.forest.count];
        stats->seconds_selected = sli_seconds() - started;
        stats->bytes_selected = Z->bytes;
    }
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
    if (F == NULL || (set != NULL && count < 0) || !sli_allocator_is_whole(opt) ||
        (opt != NULL && opt->threads.count < 0)) {
        return SL_ERR_ARGUMENT;
    }
    if (!F->is_good) {
        return SL_ERR_STATE;
    }
    status = sli_selected_list(&Z, F, set, count, opt, stats);
    if (status == SL_OK) {
        status = sli_selected_room(Z);
    }
    if (status == SL_OK) {
        status = sli_selected_fill(Z, F, NULL);
    }
    if (status == SL_OK) {
        sli_selected_stats(Z, started, stats);
        *out = Z;
    } else {
        sl_selected_free(Z);
    }
    return status;
}

SL_API sl_status sl_selected_refill(sl_selected *Z, const sl_factor *F, sl_work *W) {
    if (Z == NULL || F == NULL) {
        return SL_ERR_ARGUMENT;
    }
    return F->is_good && F->S == Z->descent.S ? sli_selected_fill(Z, F, W) : SL_ERR_STATE;
}

SL_API void sl_selected_free(sl_selected *Z) {
    if (Z != NULL) {
        const sl_allocator a = Z->allocator;
        sli_free(&a, Z->Z);
        sli_free(&a, Z);
    }
}

#endif
/* end src/impl/selected.h */
/* begin src/impl/selected_ask.h */
/* selected_ask.h: what can be asked of a selected inverse: its diagonal, its entries, a look inside */
#ifndef SLI_SELECTED_ASK_H
#define SLI_SELECTED_ASK_H

/* The place of supernode s in the list, or -1. */
SLI_INLINE sl_int sli_selected_find(const sl_selected *Z, sl_int s) {
    sl_int at = s;
    if (Z->descent.forest.count < Z->descent.S->n_supers) {
        at = sli_lower_bound(Z->descent.supers, Z->descent.forest.count, s);
    }
    return at < Z->descent.forest.count && Z->descent.supers[at] == s ? at : -1;
}

/* Where the entry of pivots k and l stands in Z, or -1. */
static sl_off sli_selected_at(const sl_selected *Z, sl_int k, sl_int l) {
    const sl_symbolic *S = Z->descent.S;
    const sl_int column = sli_min(k, l), s = S->super_of[column], at = sli_selected_find(Z, s);
    const sl_int r = at == -1 ? -1 : sli_descent_row(S, s, sli_max(k, l));
    return r == -1 ? -1
                   : Z->begin[at] + sli_panel_at(S->steps[s].width, r, column - S->super_first[s]);
}

/* All entries asked for are looked up before the first is written: out stays untouched on error. */
static sl_status sli_selected_ask(const sl_selected *Z, double *out, const sl_int *rows,
                                  const sl_int *columns, sl_int count, sl_stats *stats) {
    const sl_symbolic *S = Z->descent.S;
    sl_int k;
    int pass;
    for (pass = 0; pass < 2; pass++) {
        for (k = 0; k < count; k++) {
            const sl_int i = rows == NULL ? k : rows[k], j = columns == NULL ? i : columns[k];
            sl_off at;
            if (pass == 0 && (i < 0 || i >= S->n || j < 0 || j >= S->n)) {
                return sli_fail_at(stats, SL_ERR_ARGUMENT, i, columns == NULL ? -1 : j, 0.0);
            }
            at = sli_selected_at(Z, S->iperm[i], S->iperm[j]);
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

/* The diagonal in the order of the panels: looked up row by row it took a twelfth of the whole time. */
static void sli_selected_all(const sl_selected *Z, double *out) {
    const sl_symbolic *S = Z->descent.S;
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
    count = rows == NULL ? Z->descent.S->n : count;
    if (count > 0 && out == NULL) {
        return SL_ERR_ARGUMENT;
    }
    if (rows == NULL && Z->descent.forest.count == Z->descent.S->n_supers) {
        sli_selected_all(Z, out);
        return SL_OK;
    }
    return sli_selected_ask(Z, out, rows, NULL, count, stats);
}

SL_API sl_status sl_selected_entries(const sl_selected *Z, double *out, const sl_int *rows,
                                     const sl_int *columns, sl_int count, sl_stats *stats) {
    sli_stats_clear_error(stats);
    if (Z == NULL || count < 0 || (count > 0 && (out == NULL || rows == NULL || columns == NULL))) {
        return SL_ERR_ARGUMENT;
    }
    return sli_selected_ask(Z, out, rows, columns, count, stats);
}

SL_API sl_selected_view_t sl_selected_view(const sl_selected *Z) {
    sl_selected_view_t v = {NULL, 0, NULL, NULL, NULL};
    if (Z != NULL) {
        v.symbolic = Z->descent.S;
        v.count = Z->descent.forest.count;
        v.supers = Z->descent.supers;
        v.begin = Z->begin;
        v.Z = Z->Z;
    }
    return v;
}

#endif
/* end src/impl/selected_ask.h */
/* begin src/impl/region_choose.h */
/* region_choose.h: which subtrees a region holds whole: those that leave the least to be read */
#ifndef SLI_REGION_CHOOSE_H
#define SLI_REGION_CHOOSE_H

/* The supernodes inside and the boundary while they are chosen, over the compiled reach of the set. A row
 * is in the boundary if it is asked for, or below a supernode inside, and not inside itself. */
typedef struct sli_choice {
    const sl_symbolic *S;
    uint64_t *seeds, *scratch; /* count: columns of the set, ascending */
    sl_int count;
    size_t most; /* bytes that a region with a boundary may have */
    sli_reach reach;
    sli_step *steps;          /* of the reach */
    sl_int *rows;             /* reach.n_rows */
    sl_off *rows_begin;       /* reach.count + 1 */
    uint64_t *order, *sorted; /* reach.count: steps by the size of their subtrees; scratch */
    sl_int *children;         /* reach.count: of each step, in the reach */
    sl_int *inside;           /* the same, those of them that are inside; */
    unsigned char *is_inside; /* is the step itself? */
    sl_int *wanted;           /* reach.columns: how many want each row in the boundary */
    sl_int n_roots, boundary; /* as it stands */
    double cost;              /* of L inside */
} sli_choice;

/* What a solve takes, in doubles read of L: those inside twice, and for the boundary a square. Half of that is
 * stored and read once from afar; counted so, patches of 2000 vertices would be solved 4 percent faster with a fifth
 * more bytes. A cost for each supernode moves the choice by less than what can be measured. */
SLI_INLINE double sli_choice_step(const sli_step *s) {
    return 2.0 * (double)sli_entries_from(s->width, s->below, s->first_tile);
}

SLI_INLINE double sli_choice_boundary(sl_int boundary) {
    return (double)boundary * ((double)boundary + 2.0 * SLI_REGION_COLUMNS);
}

SLI_INLINE double sli_choice_cost(const sli_choice *c) {
    return c->cost + sli_choice_boundary(c->boundary);
}

/* Does a region of so many rows and subtrees keep within its bytes? */
static int sli_region_bytes_fit(sl_int boundary, sl_int n_roots, size_t most) {
    sli_block b = {NULL, 0, 0};
    sl_region R;
    if (boundary == 0 || most == 0) {
        return 1;
    }
    if ((double)boundary * (double)boundary * (0.5 * sizeof(double)) > (double)most) {
        return 0; /* the sum over its chunks would take long to say so */
    }
    R.fence.n_rows = boundary;
    R.fence.n_roots = n_roots;
    sli_region_layout(&R, &b);
    return !b.overflow && b.used <= most;
}

SLI_INLINE int sli_choice_fits(const sli_choice *c) {
    return sli_region_bytes_fit(c->boundary, c->n_roots, c->most);
}

/* A step whose children in the reach all are inside goes in. */
static void sli_choice_enter(sli_choice *c, sl_int k) {
    const sli_step *step = &c->steps[k];
    const sl_int *rows = c->rows + c->rows_begin[k];
    sl_int i;
    for (i = 0; i < sli_step_columns(step); i++) {
        c->boundary -= c->wanted[step->base + i] > 0;
    }
    for (i = 0; i < step->below; i++) {
        c->boundary += c->wanted[rows[i]]++ == 0;
    }
    c->n_roots += 1 - c->inside[k];
    c->is_inside[k] = 1;
    c->cost += sli_choice_step(step);
    if (step->up != -1) {
        c->inside[step->up]++;
    }
}

/* A step whose parent is outside comes out again. */
static void sli_choice_leave(sli_choice *c, sl_int k) {
    const sli_step *step = &c->steps[k];
    const sl_int *rows = c->rows + c->rows_begin[k];
    sl_int i;
    if (step->up != -1) {
        c->inside[step->up]--;
    }
    c->cost -= sli_choice_step(step);
    c->is_inside[k] = 0;
    c->n_roots -= 1 - c->inside[k];
    for (i = 0; i < step->below; i++) {
        c->boundary -= --c->wanted[rows[i]] == 0;
    }
    for (i = 0; i < sli_step_columns(step); i++) {
        c->boundary += c->wanted[step->base + i] > 0;
    }
}

/* All supernodes go in, those with small subtrees first, and come out again to where the cost was least. */
static void sli_choice_sweep(sli_choice *c) {
    const sl_int count = c->reach.count;
    sl_int k, best = 0;
    double least = sli_choice_fits(c) ? sli_choice_cost(c) : HUGE_VAL;
    for (k = 0; k < count; k++) {
        double cost;
        sli_choice_enter(c, sli_value(c->order[k]));
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
        sli_choice_leave(c, sli_value(c->order[k - 1]));
    }
}

/* Most times that the rim is looked over. */
#define SLI_REGION_PASSES 8

/* Single supernodes at the rim go in or out while that makes the cost less. */
static void sli_choice_improve(sli_choice *c) {
    sl_int pass, k;
    int is_better = 1;
    for (pass = 0; pass < SLI_REGION_PASSES && is_better; pass++) {
        is_better = 0;
        for (k = 0; k < c->reach.count; k++) {
            const sl_int up = c->steps[k].up;
            const double before = sli_choice_cost(c);
            if (!c->is_inside[k] && c->inside[k] == c->children[k]) {
                sli_choice_enter(c, k);
                if (sli_choice_cost(c) < before && sli_choice_fits(c)) {
                    is_better = 1;
                } else {
                    sli_choice_leave(c, k);
                }
            } else if (c->is_inside[k] && (up == -1 || !c->is_inside[up])) {
                sli_choice_leave(c, k);
                if (sli_choice_cost(c) < before && sli_choice_fits(c)) {
                    is_better = 1;
                } else {
                    sli_choice_enter(c, k);
                }
            }
        }
    }
}

/* How many times the cost may be if the inverse then can be read: on grids of 1e5 and 1e6 vertices 37 and 21 of 100
 * patches of 2000 take it, are solved in 1.3 times the time, and made in a third and a thirtieth (bench region). */
#define SLI_REGION_DETOUR 2.0

/* The subtree of one supernode that holds the whole set, where it costs little more than what is chosen: the rows
 * below it are among themselves on the pattern of L, so that a selected inverse has their part. */
static void sli_choice_one(sli_choice *c) {
    const sl_symbolic *S = c->S;
    double inside = 0.0, least = SLI_REGION_DETOUR * sli_choice_cost(c);
    sl_int k, first, last, best = -1;
    if (c->count == 0) {
        return;
    }
    first = S->super_of[sli_key(c->seeds[0])];
    last = S->super_of[sli_key(c->seeds[c->count - 1])];
    for (k = 0; k < c->reach.count; k++) {
        const sli_step *step = &c->steps[k];
        const sl_int s = S->super_of[step->column];
        inside += sli_choice_step(step);
        if (s >= last && S->descendant[s] <= first &&
            inside + sli_choice_boundary(step->below) <= least &&
            sli_region_bytes_fit(step->below, 1, c->most)) {
            least = inside + sli_choice_boundary(step->below);
            best = k;
        }
    }
    for (k = c->reach.count - 1; k >= 0 && best >= 0; k--) {
        if (c->is_inside[k]) {
            sli_choice_leave(c, k);
        }
    }
    for (k = 0; k <= best; k++) {
        sli_choice_enter(c, k);
    }
}

static void sli_choice_layout_reach(sli_choice *c, sli_block *b) {
    const uint64_t count = (uint64_t)c->reach.count;
    c->steps = SLI_TAKE(b, sli_step, count);
    c->rows = SLI_TAKE(b, sl_int, c->reach.n_rows);
    c->rows_begin = SLI_TAKE(b, sl_off, count + 1);
    c->order = SLI_TAKE(b, uint64_t, count);
    c->sorted = SLI_TAKE(b, uint64_t, count);
    c->children = SLI_TAKE(b, sl_int, count);
    c->inside = SLI_TAKE(b, sl_int, count);
    c->is_inside = SLI_TAKE(b, unsigned char, count);
    c->wanted = SLI_TAKE(b, sl_int, c->reach.columns);
}

/* Nothing inside: the set is the boundary. */
static void sli_choice_begin(sli_choice *c) {
    const sl_symbolic *S = c->S;
    sl_int k, at = 0;
    sli_reach_fill(S, c->seeds, c->count, c->steps, c->rows, &c->reach);
    memset(c->children, 0, (size_t)c->reach.count * sizeof *c->children);
    memset(c->inside, 0, (size_t)c->reach.count * sizeof *c->inside);
    memset(c->is_inside, 0, (size_t)c->reach.count);
    memset(c->wanted, 0, (size_t)c->reach.columns * sizeof *c->wanted);
    c->rows_begin[0] = 0;
    for (k = 0; k < c->reach.count; k++) {
        const sl_int s = S->super_of[c->steps[k].column];
        c->rows_begin[k + 1] = c->rows_begin[k] + c->steps[k].below;
        c->order[k] = sli_keyed(S->super_first[s + 1] - S->super_first[S->descendant[s]], k);
        if (c->steps[k].up != -1) {
            c->children[c->steps[k].up]++;
        }
    }
    sli_sort(c->order, c->reach.count, c->sorted);
    c->n_roots = 0;
    c->boundary = c->count;
    c->cost = 0.0;
    for (k = 0; k < c->count; k++) {
        c->wanted[sli_reach_place(&c->reach, &at, sli_key(c->seeds[k]))] = 1;
    }
}

/* Rows of A as columns of L, ascending, each once. NULL: all. */
static sl_status sli_choice_sort(sli_choice *c, const sl_int *set, sl_stats *stats) {
    const sl_symbolic *S = c->S;
    sl_int k, once = 0;
    sl_status status = SL_OK;
    if (set == NULL) {
        for (k = 0; k < c->count; k++) {
            c->seeds[k] = sli_keyed(k, 0);
        }
        return SL_OK;
    }
    status = sli_selected_sort(S, set, c->count, c->seeds, c->scratch, stats);
    for (k = 0; k < c->count && status == SL_OK; k++) {
        if (k == 0 || c->seeds[k] != c->seeds[k - 1]) {
            c->seeds[once++] = c->seeds[k];
        }
    }
    c->count = once;
    return status;
}

#endif
/* end src/impl/region_choose.h */
/* begin src/impl/region.h */
/* region.h: regions: the object, and its part of the inverse by forward sweeps or out of a selected inverse */
#ifndef SLI_REGION_H
#define SLI_REGION_H

/* The object, all but its numbers. */
static void sli_region_take(sl_region *R, const sli_choice *c) {
    const sl_symbolic *S = c->S;
    const sl_int n = R->fence.n_rows;
    sl_int k, i, n_roots = 0, n_rows = 0;
    R->inside = 0;
    for (k = 0; k < c->reach.count; k++) {
        const sli_step *step = &c->steps[k];
        const sl_int s = S->super_of[step->column];
        if (c->is_inside[k]) {
            if (step->up == -1 || !c->is_inside[step->up]) {
                R->roots[n_roots++] = s;
                R->inside += S->super_first[s + 1] - S->super_first[S->descendant[s]];
            }
            continue;
        }
        for (i = 0; i < sli_step_columns(step); i++) {
            if (c->wanted[step->base + i] > 0) {
                R->rows[n_rows++] = step->column + i;
            }
        }
    }
    SLI_ASSERT(n_roots == R->fence.n_roots && n_rows == n);
    R->fence.roots = R->roots;
    R->fence.rows = R->rows;
    R->begin[0] = 0;
    for (k = 0; k < n; k++) {
        R->asked[k] = S->perm[R->rows[k]];
        R->places[k] = n + k;
    }
    for (k = 0; k < n; k += SLI_REGION_COLUMNS) {
        sl_off *begin = &R->begin[k / SLI_REGION_COLUMNS];
        const sl_int width = sli_min(SLI_REGION_COLUMNS, n - k);
        begin[1] = begin[0] + sli_panel_size(width, n - k);
    }
    memset(R->Z, 0, (size_t)R->begin[sli_region_chunks(n)] * sizeof *R->Z);
}

static sl_status sli_region_choose(sl_region **out, const sl_symbolic *S, const sl_int *set,
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
    c.most = opt == NULL ? 0 : opt->region_bytes;
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
        sli_choice_begin(&c);
        sli_choice_sweep(&c);
        sli_choice_improve(&c);
        if (may_copy && c.boundary > 1) {
            sli_choice_one(&c);
        }
        draft.allocator = *a;
        draft.S = S;
        draft.fence.n_roots = c.n_roots;
        draft.fence.n_rows = c.boundary;
    }
    for (pass = 0; pass < 2 && status == SL_OK; pass++) {
        sli_region_layout(&draft, &kept);
        status = pass == 0 ? sli_block_alloc(&kept, a) : SL_OK;
    }
    if (status == SL_OK) {
        sli_region_take(&draft, &c);
        *out = (sl_region *)(void *)kept.base;
        **out = draft;
    }
    sli_free(a, rest.base);
    sli_free(a, seeds.base);
    return status;
}

/* Keeps the entry of two rows of the boundary, in its lower triangle. */
static void sli_region_put(void *to, sl_int row, sl_int column, double z) {
    sl_region *R = (sl_region *)to;
    const sl_int low = sli_min(row, column), high = sli_max(row, column);
    const sl_int first = low - low % SLI_REGION_COLUMNS;
    const sl_int width = sli_min(SLI_REGION_COLUMNS, R->fence.n_rows - first);
    R->Z[R->begin[first / SLI_REGION_COLUMNS] +
         sli_panel_at(width, width + high - first, low - first)] = low == high ? -0.5 * z : -z;
}

/* All entries out of a selected inverse; 0, and nothing done, where it has not got them. */
static int sli_region_copy(sl_region *R, const sl_selected *Z) {
    const sl_int *rows = R->fence.rows;
    sl_int i, j;
    int pass;
    for (pass = 0; pass < 2; pass++) {
        for (j = 0; j < R->fence.n_rows; j++) {
            for (i = j; i < R->fence.n_rows; i++) {
                const sl_off at = sli_selected_at(Z, rows[i], rows[j]);
                if (at == -1) {
                    return 0;
                }
                if (pass == 1) {
                    sli_region_put(R, i, j, Z->Z[at]);
                }
            }
        }
    }
    return 1;
}

/* The numbers. F and Z fit. */
static sl_status sli_region_fill(sl_region *R, const sl_factor *F, const sl_selected *Z,
                                 sl_work *W) {
    const double started = sli_seconds();
    sl_work own = sli_work_own(&R->allocator);
    sl_status status = SL_OK;
    const int is_copied = Z != NULL && sli_region_copy(R, Z);
    if (!is_copied) { /* fails before it writes anything, or not at all */
        status = sli_inverse_among(F, R->asked, R->fence.n_rows, sli_region_put, R,
                                   W == NULL ? &own : W);
        sli_free(&own.allocator, own.block);
    }
    if (status == SL_OK) {
        R->F = F;
        R->generation = F->generation;
        R->is_copied = is_copied;
        R->seconds = sli_seconds() - started;
    }
    return status;
}

/* Is Z, where there is one, of what F holds? What centring adds to b is not 0 outside of any region. */
static sl_status sli_region_check(const sl_factor *F, const sl_selected *Z) {
    if (!F->is_good || (Z != NULL && (Z->F != F || Z->generation != F->generation))) {
        return SL_ERR_STATE;
    }
    return F->is_centred ? SL_ERR_UNSUPPORTED : SL_OK;
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
    if (F == NULL || (set != NULL && count < 0) || !sli_allocator_is_whole(opt)) {
        return SL_ERR_ARGUMENT;
    }
    status = sli_region_check(F, Z);
    status = status == SL_OK ? sli_region_choose(&R, F->S, set, count, Z != NULL, opt, &a, stats)
                             : status;
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

SL_API sl_status sl_region_refill(sl_region *R, const sl_factor *F, const sl_selected *Z,
                                  sl_work *W) {
    sl_status status;
    if (R == NULL || F == NULL) {
        return SL_ERR_ARGUMENT;
    }
    if (F->S != R->S) {
        return SL_ERR_STATE;
    }
    status = sli_region_check(F, Z);
    if (status == SL_OK) {
        status = sli_region_fill(R, F, Z, W);
    }
    return status;
}

SL_API void sl_region_free(sl_region *R) {
    if (R != NULL) {
        const sl_allocator a = R->allocator;
        sli_free(&a, R);
    }
}

SL_API void sl_region_stats(const sl_region *R, sl_stats *stats) {
    sli_stats_clear_error(stats);
    if (R != NULL && stats != NULL) {
        stats->region_rows = R->inside + R->fence.n_rows;
        stats->region_boundary = R->fence.n_rows;
        stats->region_subtrees = R->fence.n_roots;
        stats->region_entries = R->begin[sli_region_chunks(R->fence.n_rows)];
        stats->region_is_copied = R->is_copied;
        stats->seconds_region = R->seconds;
        stats->bytes_region = R->bytes;
    }
}

SL_API sl_region_view_t sl_region_view(const sl_region *R) {
    sl_region_view_t v = {NULL, 0, NULL, 0, NULL};
    if (R != NULL) {
        v.symbolic = R->S;
        v.n_roots = R->fence.n_roots;
        v.roots = R->fence.roots;
        v.n_boundary = R->fence.n_rows;
        v.boundary = R->asked;
    }
    return v;
}

#endif
/* end src/impl/region.h */
/* last: takes every internal macro away again */
/* begin src/impl/leave.h */
/* leave.h: takes every internal macro away again */
#undef SLI_X86
#undef SLI_ARM
#undef SLI_INLINE
#undef SLI_ALWAYS_INLINE
#undef SLI_APART
#undef SLI_TARGET
#undef SLI_UNROLL
#undef SLI_ALIGNED
#undef SLI_PREFETCH
#undef SLI_ASSERT
#undef SLI_ROWS_MAX
#undef SLI_ALIGN
#undef SLI_HUGE_PAGES
#undef SLI_HUGE_BLOCK
#undef SLI_PAGE
#undef SLI_TAKE
#undef SLI_SORT_SMALL
#undef SLI_TILE
#undef SLI_FEW_STEPS
#undef SLI_CASE
#undef SLI_CASES
#undef SLI_AHEAD
#undef SLI_EACH4
#undef SLI_EACH8
#undef SLI_EACH4_AGAIN
#undef SLI_EACH8_AGAIN
#undef SLI_HIGH4
#undef SLI_HIGH8
#undef SLI_LOW4
#undef SLI_LOW8
#undef SLI_SPREAD_PLAIN
#undef SLI_SPREAD_ADD_PLAIN
#undef SLI_GROUP
#undef SLI_CHUNK
#undef SLI_FRONT_INVERSE
#undef SLI_NULL_PIVOT
#undef SLI_DUAL_GROUP
#undef SLI_DUAL_ROW
#undef SLI_DUAL_COLUMNS
#undef SLI_DUAL_PARTS
#undef SLI_PANEL_AHEAD
#undef SLI_TASKS_A_WORKER
#undef SLI_SHARED_FLOPS
#undef SLI_SUMMED
#undef SLI_ROWS_AHEAD
#undef SLI_TOKEN_MAX
#undef SLI_ORDER_TINY
#undef SLI_CLIMB
#undef SLI_LANES_MAX
#undef SLI_REQUESTS_MAX
#undef SLI_KEPT
#undef SLI_REGION_COLUMNS
#undef SLI_REGION_PASSES
#undef SLI_REGION_DETOUR
#undef SLI_ZEROS_SMALL
/* end src/impl/leave.h */
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

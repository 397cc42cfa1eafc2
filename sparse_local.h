/* sparse_local.h 0.1.0, generated: edit src/, run make header
 * FNV-1a of all that follows this comment, license aside: c2ca415203c659e8
 *
 * Contents
 *         (what a user reads)
 *     97  public/intro.h             what the library does, a quick start, notation, conventions, threads, references
 *    151  public/config.h            what a user may set before including the header, the version, and the integer types
 *    200  public/types.h             status codes, the matrix view, options, statistics, and the names of the opaque objects
 *    402  public/csc.h               matrices the library owns, checks, products, residuals, Matrix Market files
 *    522  public/analyse.h           the analysis of a pattern: ordering, elimination tree, supernodes, storage of L
 *    599  public/factor.h            the numbers: P A P' = L D L'
 *    705  public/solve.h             full solves, and the workspace that every solve writes to
 *    774  public/plan.h              local solves: b known on a few rows, x wanted on a few others
 *    860  public/inverse.h           entries, blocks and bilinear forms of the inverse, by forward sweeps alone
 *    939  public/batch.h             many independent solves with one factor, spread over threads by one call
 *    976  public/selected.h          the selected inverse: entries of A^-1 on the pattern of L, all of them or those that some rows reach
 *         (bodies, in one source file)
 *         (L0 ground)
 *   1083  impl/base.h                the system headers, everything that depends on the compiler, and small integer helpers
 *   1174  impl/status.h              status codes in words, and the error fields of stats
 *   1230  impl/alloc.h               memory: 64-byte aligned blocks that cannot overflow, cut into arrays in one go
 *   1355  impl/sort.h                sorts keyed numbers: insertion for a few, radix for many
 *   1430  impl/cpu.h                 which instruction sets this processor and operating system run
 *   1467  impl/parallel.h            the same work for several workers at once: by the caller's pool, by OpenMP, or one after the other
 *         (L1 kernels: raw arrays only)
 *   1501  impl/kernels.h             the contract of the numerical kernels: panels, steps, sweeps, and the table that an ISA fills
 *   1766  impl/isa_scalar.h          the kernels in plain C: an octet is an array
 *   1904  impl/lanes_array.inl.h     a row of right-hand sides as an array, for plain C
 *   1934  impl/lanes.inl.h           2, 4 or 8 interleaved right-hand sides, SIMD along them; the words SLW_* are one row of SLW_LANES
 *   3105  impl/tile.inl.h            the 8 x 8 unit triangle of a diagonal tile, in scalars: 28 FMAs, a chain of 7
 *   3151  impl/product.inl.h         C -= A D B' on tiles, the loop that a factorization spends its time in; words SLV_*
 *   3288  impl/front.inl.h           a front of the multifrontal factorization: its panel factored, its update matrix made and handed on
 *   3503  impl/takahashi.inl.h       a front of the inverse: gathered from the parent's front, completed column group by column group
 *   3769  impl/narrow.inl.h          one right-hand side through a supernode of 1 to 8 columns, all of them in registers; words SLV_*
 *   3931  impl/body.inl.h            one right-hand side, SIMD along the 8 rows of a tile; the words SLV_* are one octet of doubles
 *   4203  impl/words_end.inl.h       takes the octet words back, for the next instruction set
 *   4254  impl/isa_avx2.h            the kernels in AVX2 and FMA: an octet is two registers
 *   4399  impl/lanes_ymm.inl.h       four right-hand sides in one 256-bit register, for AVX2 and AVX-512 alike
 *   5212  impl/pairs.inl.h           two interleaved right-hand sides, SIMD along the rows of a tile; words SLV_*, two octets a tile
 *   6491  impl/isa_avx512.h          the kernels in AVX-512: an octet is one register
 *   8664  impl/isa_neon.h            the kernels in NEON: an octet is four registers
 *  10894  impl/select.h              the kernel table for an instruction set
 *         (L2 storage)
 *  10927  impl/csc.h                 compressed columns: checks, owned matrices, triplets, transpose, products, residuals
 *  11355  impl/permute.h             permutations: validity, inverse, and P A P' of a stored matrix
 *  11428  impl/io.h                  Matrix Market files, read and written: coordinate; real, integer, pattern; general, symmetric
 *         (L3 patterns: never see a value array)
 *  11782  impl/symbolic_types.h      the analysis object: what the pattern parts fill in and the number parts read
 *  11824  impl/graph.h               the pattern of a symmetric matrix, from whichever triangle is stored, as graph and as ordered halves
 *  11997  impl/order_coarsen.h       ever smaller graphs, each made of the one before by joining vertices two by two
 *  12267  impl/order_tree.h          the tree of separators over one graph: a label a vertex, and who stands at which border
 *  12477  impl/order_piece.h         a piece of a graph in a numbering of its own: a whole part, or a band along a border
 *  12685  impl/order_heap.h          a queue of vertices by gain, the largest first
 *  12752  impl/order_bisect.h        a part cut in two by growing one half, and a cut made lighter by moving vertices across
 *  13000  impl/order_cut.h           the smallest set of vertices in a band whose removal parts the two sides
 *  13288  impl/order_leaves.h        minimum degree in the parts that are too small to dissect, on rows of bits
 *  13487  impl/order_dissect.h       nested dissection of a connected graph: where to cut, found on a coarse level, refined on the finest
 *  13807  impl/order_layers.h        parts cut between the layers of a breadth-first search: what grids of three dimensions want
 *  13936  impl/order_geometric.h     nested dissection by coordinates: halves of space, and when they are the better parts
 *  14134  impl/order_nest.h          from labels to an order: parts before the separators round them, leaves by minimum degree
 *  14203  impl/order_metis.h         what METIS is asked: the order of a connected component, and its nested separators
 *  14372  impl/order_quality.h       parts from METIS's vertex separators of the whole graph
 *  14493  impl/order_own.h           nested dissection of any graph: dense rows last, components one by one
 *  14705  impl/order_compress.h      rows with the same neighbours ordered as one: unknowns of one vertex, cliques
 *  14837  impl/order.h               the fill-reducing order of the rows: natural, given, or nested dissection
 *  15042  impl/etree.h               the elimination tree of an ordered graph, postorder, and relabelling along an order
 *  15127  impl/counts.h              entries of every column of L, in nearly O(nnz(A)), from the leaves of the row subtrees
 *  15200  impl/supernodes.h          fundamental supernodes, and their relaxed amalgamation over the whole assembly tree
 *  15366  impl/structure.h           the rows of every supernode, the places of the panels, and the map of A into L
 *  15442  impl/fronts.h              the tree of fronts: the children of each supernode, and where their rows stand in its front
 *  15483  impl/schedule.h            which worker factors which fronts, and where update matrices wait for the parent's front
 *  15676  impl/symbolic.h            the analysis, from the pattern of A to the places of L
 *  15986  impl/reach.h               the columns that a set of rows touches: the elimination tree's paths from them to the roots
 *         (L4 numbers)
 *  16219  impl/factor_parts.h        the factor object, and what both ways to factor share: loading a panel, taking a pivot
 *  16351  impl/uplooking.h           the up-looking factorization: row k of L is a sparse triangular solve over the reach of row k of A
 *  16437  impl/multifrontal.h        the supernodal factorization: front by front, each handing its update matrix to its parent
 *  16697  impl/leftlooking.h         supernodes factored again by pulling from all their descendants: for changes that reach few of them
 *  16784  impl/factor.h              the factor object: the method and the memory, factoring, factoring again, release
 *  17078  impl/factor_ask.h          what can be asked of a factor: statistics, the determinant, L as a matrix, a look inside
 *  17193  impl/work.h                the workspace: one block of a thread's scratch that only grows
 *  17253  impl/sweep.h               one block of right-hand sides through the forward reach, across to the backward reach, and out
 *  17490  impl/solve.h               full solves: the query in which everything is known and everything wanted
 *  17532  impl/plan.h                local solves: queries compiled from a b-set and an x-set, kept as a plan or made in the workspace
 *         (L5 on a factor)
 *  17830  impl/groups.h              unit vectors taken up to 8 at a time over one reach, as many as pay, and swept forward together
 *  18070  impl/inverse.h             entries and bilinear forms of A^-1: forward sweeps, then sums over common columns weighted by 1/D
 *  18389  impl/inverse_block.h       dense blocks of A^-1: every row and column swept forward, then all sums between two sweeps
 *  18616  impl/batch.h               independent solves spread over workers by the entries of L that they read
 *  18770  impl/selected.h            the selected inverse: a sweep from the roots to the leaves, each front gathered from its parent's
 *         (last: takes every internal macro away again)
 *  19214  impl/leave.h               takes every internal macro away again
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
 *  [FF56]    Ford, Fulkerson: Maximal flow through a network, 1956.
 *  [George73] George: Nested dissection of a regular finite element mesh, 1973.
 *  [FM82]    Fiduccia, Mattheyses: A linear-time heuristic for improving network partitions, 1982.
 *  [Liu90]   Liu: The role of elimination trees in sparse factorization, 1990.
 *  [GNP94]   Gilbert, Ng, Peyton: An efficient algorithm to compute row and column counts, 1994.
 *  [NP93]    Ng, Peyton: Block sparse Cholesky algorithms on advanced uniprocessor computers, 1993.
 *  [DR83]    Duff, Reid: The multifrontal solution of indefinite sparse symmetric linear equations, 1983.
 *  [Liu92]   Liu: The multifrontal method for sparse matrix solution: theory and practice, 1992.
 *  [ET75]    Erisman, Tinney: On computing certain elements of the inverse of a sparse matrix, 1975.
 *  [SelInv]  Lin, Yang, Meza, Lu, Ying, E: SelInv: selected inversion of a sparse symmetric matrix, 2011.
 *  [AG89]    Ashcraft, Grimes: The influence of relaxed supernode partitions on the multifrontal method, 1989.
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
    SL_ERR_STATE     /* a failed factor, or objects that do not belong together */
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

/** Orders of elimination. BUILTIN cuts on a coarse graph of its own: METIS's cuts of that graph took longer and were
 *  worse, so that FAST has no use for them. Rows with the same neighbours are ordered as one. */
typedef enum sl_ordering {
    SL_ORDERING_DEFAULT = 0, /* SL_ORDERING_FAST */
    SL_ORDERING_METIS,       /* METIS_NodeND on every connected component [KK98] */
    SL_ORDERING_GIVEN,       /* options.perm */
    SL_ORDERING_NATURAL,     /* 0, 1, 2, ... */
    SL_ORDERING_FAST,        /* the quickest set-up: at present the same as SL_ORDERING_BUILTIN */
    SL_ORDERING_BUILTIN,     /* nested dissection of this header's own; needs no library */
    SL_ORDERING_QUALITY      /* METIS's separators, the better of two, improved: for very many local
                                solves, at twice METIS's time */
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
    /* where the rows lie, n / block_size x dimensions, point by point, for FAST and BUILTIN: parts are halves of
     * space where that is the better cut; NULL: not known */
    const double *coordinates;
    sl_int dimensions; /* of coordinates: 2 or 3 */
    /* rows that stay together in the order, such as x, y, z of a vertex: rows k block_size .. (k + 1) block_size - 1
     * each; divides n; 0 or 1: none */
    sl_int block_size;
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

    /* sl_plan_create, sl_local_solve; sl_inverse_*, which have no backward sweep */
    sl_int b_supernodes; /* visited by the forward sweep */
    sl_int b_columns;
    sl_off b_entries;    /* doubles of L that the forward sweep reads */
    sl_int x_supernodes; /* the same for the backward sweep */
    sl_int x_columns;
    sl_off x_entries;
    size_t bytes_plan;

    /* sl_selected_create */
    sl_int z_supernodes; /* those whose part of the inverse was made */
    sl_int z_columns;
    sl_off z_entries;        /* doubles kept for them */
    double seconds_selected; /* processor seconds, those of all threads summed up */
    size_t bytes_selected;
} sl_stats;

typedef struct sl_matrix sl_matrix;     /* a CSC matrix that the library owns */
typedef struct sl_symbolic sl_symbolic; /* analysis of one pattern; immutable */
typedef struct sl_factor sl_factor;     /* numbers over a symbolic: L and D */
typedef struct sl_plan sl_plan;         /* reach of a b-set and of an x-set; immutable */
typedef struct sl_work sl_work;         /* scratch of one thread */
typedef struct sl_selected sl_selected; /* entries of the inverse on the pattern of L; immutable */

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
 *  opt    [in]   ordering, perm, metis_options, coordinates, dimensions, block_size, relaxation, allocator; may be
 *                NULL. block_size and coordinates are not read with SL_ORDERING_GIVEN and _NATURAL, coordinates not
 *                with _METIS and _QUALITY either; but what is wrong in them is refused with any ordering.
 *  stats  [out]  the symbolic group; may be NULL.
 *  Returns  SL_OK; SL_ERR_ARGUMENT: not square, perm not a permutation (error_row is the first offending position),
 *           an unknown ordering or relaxation, metis_options that METIS would refuse, a block_size that does not
 *           divide n, coordinates of other than 2 or 3 dimensions; SL_ERR_NOT_FINITE: a coordinate, error_row is the
 *           first row of its block; SL_ERR_PATTERN; SL_ERR_UNSUPPORTED: METIS asked for and not compiled in;
 *           SL_ERR_ORDERING; SL_ERR_TOO_LARGE; SL_ERR_MEMORY.
 *  Cost     the ordering, then nearly O(nnz(A) + rows of the supernodes).
 *  Threads  METIS is not as quiet as this library. While it runs (SL_ORDERING_METIS and SL_ORDERING_QUALITY only) it
 *           resets rand() of the C library by srand() and draws from it, and prints a line if it runs out of memory.
 *           With SL_ORDERING_METIS it traps SIGABRT and SIGTERM of the whole process meanwhile; with
 *           SL_ORDERING_QUALITY it does not, and raises SIGABRT if it runs out of memory, which ends a process that
 *           has no handler. Calls in several threads at once are safe only if rand() is, and may then order
 *           differently from run to run. All other orderings do nothing of this, run in any number of
 *           threads, and give the same order for the same pattern however it is stored, with METIS compiled in or not.
 *  Source   [George73] nested dissection, [KK98] on levels of coarser graphs, [FM82] moving vertices across a cut, [FF56]
 *           smallest vertex cuts; [Liu90] elimination tree; [GNP94] counts; [AG89] relaxed supernodes.
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
 *
 *  SL_ORDERING_FAST, _BUILTIN and _QUALITY leave their tree of separators (others: n_parts = 0 and NULL): a node is a
 *  separator, or a part that was not cut further. No entry of A joins two nodes unless one of them is above the
 *  other; nodes are numbered in the order of elimination, so that a parent comes after all that it parts.
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
    sl_int n_parts;             /* nodes of the tree of separators */
    const sl_int *part_of;      /* n: the node of column k */
    const sl_int *part_parent;  /* n_parts: the separator round a node, -1 at a root */
    const sl_int *part_level;   /* n_parts: separators round it: 0 at a root */
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
 *  SL_SEMIDEFINITE skips null pivots instead: on a raw Laplacian one in each connected component, the last of it. Solves
 *  then give a solution of every consistent system, the one that is 0 in the rows of sl_factor_null_rows; of a system
 *  that is not consistent they leave a residual in those rows alone.
 *
 *  out    [out]  the factor, or NULL on error; release with sl_factor_free.
 *  S      [in]   analysis of A's pattern; borrowed, must outlive the factor.
 *  A      [in]   n x n with values; the pattern that S was made from, entry by entry in the same order.
 *  opt    [in]   isa, method, threads, definiteness, null_tolerance, allocator; may be NULL.
 *  stats  [out]  the factor group; error_row, error_value; may be NULL.
 *  Returns  SL_OK; SL_ERR_ARGUMENT: no values; SL_ERR_PATTERN: n or the number of entries differs from the analysed
 *           one; SL_ERR_PIVOT: null pivot at error_row; SL_ERR_NOT_FINITE: at error_row (and error_column where
 *           it stands in A); SL_ERR_UNSUPPORTED: the isa; SL_ERR_TOO_LARGE: L is beyond size_t; SL_ERR_MEMORY.
 *  Cost     O(sum over columns of entries^2); kept are nnz_panels doubles and, by the supernodal method, the update
 *           matrices that wait at once: some 5 % more on 2D meshes, some 30 % on 3D ones, twice that with threads.
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
 *  Cost     the update matrices of all descendants of the supernodes reached; 16 bytes an entry of the columns while
 *           it runs.
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
 *  Returns  SL_OK; SL_ERR_ARGUMENT; SL_ERR_STATE: failed factor.  Cost  O(n).
 */
SL_API SL_WARN_UNUSED sl_status sl_factor_null_rows(const sl_factor *F, sl_int *rows, sl_int most,
                                                    sl_int *count);

/** log |det A| and the sign of det A (-1 or 1) from D, skipped null pivots left out; det of a 0 x 0 matrix is 1.
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

/** Solves A X = B.
 *
 *  F      [in]   factor of A, n x n.
 *  X      [out]  n x nrhs, column-major, leading dimension ldx elements, in the order of A's rows; may be B itself
 *                (then ldx = ldb). On error untouched.
 *  B      [in]   n x nrhs, column-major, leading dimension ldb elements.
 *  nrhs   [in]   number of right-hand sides, 0 or more; solved in blocks of 8, for the time of two to three alone.
 *  W      [in,out]  scratch; NULL: allocated for this call.
 *  Returns  SL_OK; SL_ERR_ARGUMENT; SL_ERR_STATE: failed factor; SL_ERR_TOO_LARGE, SL_ERR_MEMORY: W had to grow and
 *           could not.
 *  Cost     4 nnz_panels flops a right-hand side; reads L twice for each block; W grows to O(n min(nrhs, 8)).
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
 *  opt    [in]   allocator; may be NULL.
 *  stats  [out]  the plan group; error_row: an index out of range or given twice; may be NULL.
 *  Returns  SL_OK; SL_ERR_ARGUMENT; SL_ERR_TOO_LARGE; SL_ERR_MEMORY.
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
 *  For the same instruction set and nrhs the result equals sl_factor_solve's bit for bit (the sign of a zero aside).
 *
 *  F      [in]   a factor over the plan's analysis.
 *  X      [out]  nx x nrhs, column-major, leading dimension ldx elements, rows in the order of xset; may be B itself
 *                (then ldx = ldb). On error untouched.
 *  B      [in]   nb x nrhs, column-major, leading dimension ldb elements, rows in the order of bset.
 *  nrhs   [in]   number of right-hand sides, 0 or more.
 *  W      [in,out]  scratch; NULL: allocated for this call.
 *  Returns  SL_OK; SL_ERR_ARGUMENT; SL_ERR_STATE: failed factor, or one of another analysis; SL_ERR_TOO_LARGE;
 *           SL_ERR_MEMORY.
 *  Cost     2 (b_entries + x_entries) flops a right-hand side; nothing O(n); no allocation once W has grown.
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
 *  Returns  SL_OK; SL_ERR_ARGUMENT; SL_ERR_STATE: failed factor; SL_ERR_TOO_LARGE; SL_ERR_MEMORY.
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
/* begin src/public/inverse.h */
/* inverse.h: entries, blocks and bilinear forms of the inverse, by forward sweeps alone */
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
 *  Cost     2 b_entries flops a lane; 8 lanes take the time of two to three, which is why many requests in one call
 *           are worth it: a lone pair of far vertices costs what a local solve from one to the other does. Nothing
 *           O(n), but for NULL sets; no allocation once W has grown to the largest reach and 16 bytes a request.
 *  Threads  any number at once on one F, each with its own W.
 *  Source   [HDA17] 5; [Davis06] 3.2, 4.1.
 *  Example  tests/test_inverse.c
 */

/** Diagonal entries of the inverse: out[k] = (A^-1)(rows[k], rows[k]).
 *
 *  out    [out]  count values.
 *  rows   [in]   count rows of A in 0..n-1, any order, repeated or not; NULL (with count ignored): all n.
 */
SL_API SL_WARN_UNUSED sl_status sl_inverse_diagonal(const sl_factor *F, double *out,
                                                    const sl_int *rows, sl_int count, sl_work *W,
                                                    sl_stats *stats);

/** Entries of the inverse: out[k] = (A^-1)(rows[k], columns[k]).
 *
 *  out    [out]  count values.
 *  rows, columns  [in]  count rows of A each, in 0..n-1, any order, repeated or not.
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
/* batch.h: many independent solves with one factor, spread over threads by one call */
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
} sl_request;

/** Answers requests with one factor: the bits that sl_plan_solve and sl_factor_solve give, for any number of threads.
 *
 *  F         [in]      the factor; every plan belongs to its analysis.
 *  requests  [in]      count of them; each X may be its own B (then ldx = ldb), and overlaps nothing else of the batch.
 *  threads   [in]      how many and whose; NULL: the calling thread alone.
 *  works     [in,out]  a workspace for each thread, threads->count of them (1 where that is 0), or NULL: allocated for
 *                      this call.
 *  failed    [out]     the request at fault, or -1; may be NULL. On error no X has been touched.
 *  Returns   SL_OK; SL_ERR_ARGUMENT, also for works that hold a NULL or one workspace twice; SL_ERR_STATE: failed
 *            factor, or a plan of another analysis; SL_ERR_TOO_LARGE; SL_ERR_MEMORY.
 *  Cost      that of the solves, shared out by the entries of L that each reads; threads times the largest workspace.
 *  Threads   as sl_plan_solve.
 *  Example   tests/test_batch.c
 */
SL_API SL_WARN_UNUSED sl_status sl_batch_solve(const sl_factor *F, const sl_request *requests,
                                               sl_int count, const sl_threads *threads,
                                               sl_work *const *works, sl_int *failed);

#endif
/* end src/public/batch.h */
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
 *  opt    [in]   allocator; may be NULL. The instruction set is the factor's.
 *  stats  [out]  the selected group; error_row: a row out of range; may be NULL.
 *  Returns  SL_OK; SL_ERR_ARGUMENT; SL_ERR_STATE: failed factor; SL_ERR_TOO_LARGE; SL_ERR_MEMORY.
 *  Cost     about twice the flops of the factorization of the same supernodes; z_entries doubles and 28
 *           bytes a supernode kept. While it runs, 8 (height)^2 bytes for each supernode from the one at hand to its root that
 *           has children to come, where height counts its columns and the rows below.
 *  Threads  reads F; the object is immutable and may be shared.
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
 *  Threads  nobody else may use Z meanwhile.
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
#define SLI_TARGET(list) __attribute__((target(list)))
#define SLI_ALIGNED(variable) variable __attribute__((aligned(64)))
/* the cache line some bytes from p, which need not exist: asking for it has no other effect */
#define SLI_PREFETCH(p, bytes)                                                                     \
    __builtin_prefetch((const void *)((uintptr_t)(p) + (uintptr_t)(bytes)))
#define SLI_UNROLL _Pragma("GCC unroll 8") /* of the loop that follows, which has at most 8 turns */
#else
#define SLI_INLINE static inline
#define SLI_ALWAYS_INLINE static inline
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

typedef struct sli_front {
    double *panel;
    sl_int width, below;
    double *update;
    double *D;         /* width pivots */
    double *magnitude; /* 8 a tile: what each diagonal entry was made of, in absolute value */
    double *inverse;   /* 16 a column tile: 1/d, or 0 first where they are out of range; -sign d */
    double null_tolerance;
    int skips_null; /* a null pivot becomes SLI_NULL_PIVOT */
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
} sli_dual;

/* Where row tile t of a front of the inverse of h rows starts, in doubles. */
SLI_INLINE ptrdiff_t sli_square_offset(sl_int h, sl_int t) {
    return (ptrdiff_t)SLI_TILE * h * t;
}

/* Column tiles that are completed together, doubles of a row tile of their L'^-1, and of scratch for
 * supernodes of some height and width. */
#define SLI_DUAL_GROUP 16
#define SLI_DUAL_ROW (SLI_DUAL_GROUP * SLI_TILE * SLI_TILE)
SLI_INLINE sl_off sli_dual_scratch(sl_int height, sl_int width) {
    return 2 * SLI_DUAL_GROUP * SLI_DUAL_ROW + (sl_off)SLI_TILE * SLI_TILE *
                                                   sli_min(sli_tiles(width), SLI_DUAL_GROUP) *
                                                   sli_tiles(height);
}

/* Z of the rows below a supernode, out of the front of its parent of that height; places: their rows
 * there, ascending. */
typedef void (*sli_gather_kernel)(const sli_dual *f, const double *from, sl_int height,
                                  const sl_int *places);

/* The rest of the front, by Takahashi's equations. With W = L_SJ L_JJ^-1:
 * Z_SJ = -Z_SS W, Z_JJ = (L_JJ D L_JJ')^-1 - W' Z_SJ. */
typedef void (*sli_takahashi_kernel)(const sli_dual *f, double *scratch);

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
        if (f->skips_null && sli_is_null(d, sums[k], f->null_tolerance)) {                         \
            d = SLI_NULL_PIVOT;                                                                    \
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

/* count columns of a tile := 0. */
SLV_FUNCTION SLI_INLINE void SLV_NAME(clear)(double *x, sl_int count) {
    sl_int k;
    SLV_DECLARE(a)
    SLV_ZERO(a)
    for (k = 0; k < count; k++) {
        SLV_STORE(x + SLI_TILE * (ptrdiff_t)k, a)
    }
}

#define SLI_OFFSET(k) offset[k]

/* Z of the rows below, out of the parent's front: row and column i of theirs is row and column
 * places[i] there. Lanes of other rows get the numbers of a neighbour, which nothing reads. */
SLV_FUNCTION static void SLV_NAME(gather)(const sli_dual *f, const double *from, sl_int height,
                                          const sl_int *places) {
    const sl_int w = f->width, u = f->below, tiles = sli_tiles(w + u);
    sl_int t, i;
    for (t = w / SLI_TILE; t < tiles && u > 0; t++) {
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

/* N = -L'^-1 of a group of m columns from j0 on, row tile c from column 8c on; 0 where it has no row. */
SLV_FUNCTION SLI_INLINE void SLV_NAME(group_inverse)(const sli_dual *f, sl_int j0, sl_int m,
                                                     double *N) {
    const sl_int tiles = sli_tiles(m), tile_size = SLI_TILE * SLI_TILE;
    sl_int c, t, k;
    for (c = 0; c < tiles; c++, N += SLI_DUAL_ROW) {
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
    }
}

/* W' = (L_SJ L_JJ^-1)', row tile by row tile of the panel: [column tile][row][8 columns]. */
SLV_FUNCTION SLI_INLINE void SLV_NAME(group_weights)(const sli_dual *f, sl_int j0, sl_int m,
                                                     const double *N, double *W) {
    const sl_int tiles = sli_tiles(f->width + f->below), tile_size = SLI_TILE * SLI_TILE;
    sl_int c, t;
    for (c = 0; c < sli_tiles(m); c++, N += SLI_DUAL_ROW) {
        const ptrdiff_t first = SLI_TILE * (ptrdiff_t)(SLI_TILE * c);
        for (t = (j0 + m) / SLI_TILE; t < tiles; t++, W += tile_size) {
            SLV_NAME(clear)(W, SLI_TILE);
            SLV_NAME(block)
            (N + first, f->panel + sli_tile_offset(f->width, t) + SLI_TILE * (ptrdiff_t)j0 + first,
             m - SLI_TILE * c, W, SLI_TILE);
        }
    }
}

/* Z_SJ -= Z_SS W, in chunks as in a factorization. W starts at the row tile of row j0 + m. */
SLV_FUNCTION SLI_INLINE void SLV_NAME(group_product)(const sli_dual *f, sl_int j0, sl_int m,
                                                     const double *W) {
    const sl_int h = f->width + f->below, tiles = sli_tiles(h), first = j0 + m;
    const ptrdiff_t stride = SLI_TILE * SLI_TILE * (ptrdiff_t)(tiles - first / SLI_TILE);
    sl_int t, c, s;
    for (t = first / SLI_TILE; t < tiles; t++) {
        SLV_NAME(clear)(f->front + sli_square_offset(h, t) + SLI_TILE * (ptrdiff_t)j0, m);
    }
    for (s = first; s < h; s += SLI_CHUNK) {
        const sl_int length = sli_min(SLI_CHUNK, h - s);
        const double *B = W + SLI_TILE * (ptrdiff_t)(s - first + first % SLI_TILE);
        for (t = first / SLI_TILE; t < tiles; t++) {
            double *row = f->front + sli_square_offset(h, t);
            const double *A = row + SLI_TILE * (ptrdiff_t)s;
            double *C = row + SLI_TILE * (ptrdiff_t)j0;
#if SLV_TILES == 2
            if (t + 1 < tiles) {
                const ptrdiff_t next = sli_square_offset(h, 1);
                for (c = 0; c < sli_tiles(m); c++) {
                    const ptrdiff_t at = SLI_TILE * SLI_TILE * (ptrdiff_t)c;
                    SLV_NAME(block2)
                    (A, A + next, B + c * stride, length, C + at, C + next + at, m - SLI_TILE * c);
                }
                t++;
                continue;
            }
#endif
            for (c = 0; c < sli_tiles(m); c++) {
                SLV_NAME(block)
                (A, B + c * stride, length, C + SLI_TILE * SLI_TILE * (ptrdiff_t)c,
                 sli_min(SLI_TILE, m - SLI_TILE * c));
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

/* Z_JS = Z_SJ' */
SLV_FUNCTION SLI_INLINE void SLV_NAME(group_mirror)(const sli_dual *f, sl_int j0, sl_int m) {
    const sl_int h = f->width + f->below, tiles = sli_tiles(h), first = j0 + m;
    const sl_int tile_size = SLI_TILE * SLI_TILE;
    sl_int t, c;
    for (c = 0; c < sli_tiles(m); c++) {
        const sl_int columns = sli_min(SLI_TILE, m - SLI_TILE * c);
        double *to = f->front + sli_square_offset(h, j0 / SLI_TILE + c);
        for (t = first / SLI_TILE; t < tiles; t++) {
            SLV_NAME(mirror)
            (f->front + sli_square_offset(h, t) + SLI_TILE * (ptrdiff_t)j0 +
                 tile_size * (ptrdiff_t)c,
             sli_max(first - SLI_TILE * t, 0), sli_min(SLI_TILE, h - SLI_TILE * t),
             to + tile_size * (ptrdiff_t)t, columns);
        }
    }
}

/* Z_JJ = L_JJ'^-1 D^-1 L_JJ^-1 - W' Z_SJ, the lower tiles and what mirrors them. P: room as for N. */
SLV_FUNCTION SLI_INLINE void SLV_NAME(group_square)(const sli_dual *f, sl_int j0, sl_int m,
                                                    const double *N, double *P, const double *W) {
    const sl_int h = f->width + f->below, first = j0 + m, tiles = sli_tiles(m);
    const sl_int tile_size = SLI_TILE * SLI_TILE;
    const ptrdiff_t stride = tile_size * (ptrdiff_t)(sli_tiles(h) - first / SLI_TILE);
    SLI_ALIGNED(double x[SLI_TILE * SLI_TILE]);
    sl_int c, t, j;
    for (c = 0; c < tiles; c++) {
        for (j = SLI_TILE * c; j < m; j++) {
            const double minus = -f->D[j0 + j];
            const ptrdiff_t at = SLI_DUAL_ROW * (ptrdiff_t)c + SLI_TILE * (ptrdiff_t)j;
            SLV_DECLARE(a)
            SLV_DECLARE(b)
            SLV_LOAD(a, N + at)
            SLV_BROADCAST(b, &minus)
            SLV_DIVIDE(a, a, b)
            SLV_STORE(P + at, a)
        }
    }
    for (t = 0; t < tiles; t++) {
        const sl_int rows = sli_min(SLI_TILE, m - SLI_TILE * t);
        double *row = f->front + sli_square_offset(h, j0 / SLI_TILE + t) + SLI_TILE * (ptrdiff_t)j0;
        for (c = 0; c <= t; c++) {
            const sl_int columns = sli_min(SLI_TILE, m - SLI_TILE * c);
            double *column = f->front + sli_square_offset(h, j0 / SLI_TILE + c);
            SLV_NAME(clear)(x, columns);
            SLV_NAME(block)
            (N + SLI_DUAL_ROW * (ptrdiff_t)t + tile_size * (ptrdiff_t)t,
             P + SLI_DUAL_ROW * (ptrdiff_t)c + tile_size * (ptrdiff_t)t, m - SLI_TILE * t, x,
             columns);
            if (first < h) {
                SLV_NAME(block)
                (W + t * stride + SLI_TILE * (ptrdiff_t)(first % SLI_TILE),
                 column + SLI_TILE * (ptrdiff_t)first, h - first, x, columns);
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

/* From the last group of columns to the first, each with the columns after it among its rows below:
 * what a group works upon stays in the caches, whatever the width. */
SLV_FUNCTION static void SLV_NAME(takahashi)(const sli_dual *f, double *scratch) {
    const sl_int w = f->width, h = w + f->below, most = SLI_DUAL_GROUP * SLI_TILE;
    double *N = scratch, *P = N + SLI_DUAL_GROUP * SLI_DUAL_ROW,
           *W = P + SLI_DUAL_GROUP * SLI_DUAL_ROW;
    sl_int j0;
    for (j0 = (w - 1) / most * most; j0 >= 0; j0 -= most) {
        const sl_int m = sli_min(most, w - j0);
        SLV_NAME(group_inverse)(f, j0, m, N);
        if (j0 + m < h) {
            SLV_NAME(group_weights)(f, j0, m, N, W);
            SLV_NAME(group_product)(f, j0, m, W);
            SLV_NAME(group_mirror)(f, j0, m);
        }
        SLV_NAME(group_square)(f, j0, m, N, P, W);
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
        if (f->skips_null && sli_is_null(d, sums[k], f->null_tolerance)) {                         \
            d = SLI_NULL_PIVOT;                                                                    \
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

/* count columns of a tile := 0. */
SLV_FUNCTION SLI_INLINE void SLV_NAME(clear)(double *x, sl_int count) {
    sl_int k;
    SLV_DECLARE(a)
    SLV_ZERO(a)
    for (k = 0; k < count; k++) {
        SLV_STORE(x + SLI_TILE * (ptrdiff_t)k, a)
    }
}

#define SLI_OFFSET(k) offset[k]

/* Z of the rows below, out of the parent's front: row and column i of theirs is row and column
 * places[i] there. Lanes of other rows get the numbers of a neighbour, which nothing reads. */
SLV_FUNCTION static void SLV_NAME(gather)(const sli_dual *f, const double *from, sl_int height,
                                          const sl_int *places) {
    const sl_int w = f->width, u = f->below, tiles = sli_tiles(w + u);
    sl_int t, i;
    for (t = w / SLI_TILE; t < tiles && u > 0; t++) {
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

/* N = -L'^-1 of a group of m columns from j0 on, row tile c from column 8c on; 0 where it has no row. */
SLV_FUNCTION SLI_INLINE void SLV_NAME(group_inverse)(const sli_dual *f, sl_int j0, sl_int m,
                                                     double *N) {
    const sl_int tiles = sli_tiles(m), tile_size = SLI_TILE * SLI_TILE;
    sl_int c, t, k;
    for (c = 0; c < tiles; c++, N += SLI_DUAL_ROW) {
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
    }
}

/* W' = (L_SJ L_JJ^-1)', row tile by row tile of the panel: [column tile][row][8 columns]. */
SLV_FUNCTION SLI_INLINE void SLV_NAME(group_weights)(const sli_dual *f, sl_int j0, sl_int m,
                                                     const double *N, double *W) {
    const sl_int tiles = sli_tiles(f->width + f->below), tile_size = SLI_TILE * SLI_TILE;
    sl_int c, t;
    for (c = 0; c < sli_tiles(m); c++, N += SLI_DUAL_ROW) {
        const ptrdiff_t first = SLI_TILE * (ptrdiff_t)(SLI_TILE * c);
        for (t = (j0 + m) / SLI_TILE; t < tiles; t++, W += tile_size) {
            SLV_NAME(clear)(W, SLI_TILE);
            SLV_NAME(block)
            (N + first, f->panel + sli_tile_offset(f->width, t) + SLI_TILE * (ptrdiff_t)j0 + first,
             m - SLI_TILE * c, W, SLI_TILE);
        }
    }
}

/* Z_SJ -= Z_SS W, in chunks as in a factorization. W starts at the row tile of row j0 + m. */
SLV_FUNCTION SLI_INLINE void SLV_NAME(group_product)(const sli_dual *f, sl_int j0, sl_int m,
                                                     const double *W) {
    const sl_int h = f->width + f->below, tiles = sli_tiles(h), first = j0 + m;
    const ptrdiff_t stride = SLI_TILE * SLI_TILE * (ptrdiff_t)(tiles - first / SLI_TILE);
    sl_int t, c, s;
    for (t = first / SLI_TILE; t < tiles; t++) {
        SLV_NAME(clear)(f->front + sli_square_offset(h, t) + SLI_TILE * (ptrdiff_t)j0, m);
    }
    for (s = first; s < h; s += SLI_CHUNK) {
        const sl_int length = sli_min(SLI_CHUNK, h - s);
        const double *B = W + SLI_TILE * (ptrdiff_t)(s - first + first % SLI_TILE);
        for (t = first / SLI_TILE; t < tiles; t++) {
            double *row = f->front + sli_square_offset(h, t);
            const double *A = row + SLI_TILE * (ptrdiff_t)s;
            double *C = row + SLI_TILE * (ptrdiff_t)j0;
#if SLV_TILES == 2
            if (t + 1 < tiles) {
                const ptrdiff_t next = sli_square_offset(h, 1);
                for (c = 0; c < sli_tiles(m); c++) {
                    const ptrdiff_t at = SLI_TILE * SLI_TILE * (ptrdiff_t)c;
                    SLV_NAME(block2)
                    (A, A + next, B + c * stride, length, C + at, C + next + at, m - SLI_TILE * c);
                }
                t++;
                continue;
            }
#endif
            for (c = 0; c < sli_tiles(m); c++) {
                SLV_NAME(block)
                (A, B + c * stride, length, C + SLI_TILE * SLI_TILE * (ptrdiff_t)c,
                 sli_min(SLI_TILE, m - SLI_TILE * c));
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

/* Z_JS = Z_SJ' */
SLV_FUNCTION SLI_INLINE void SLV_NAME(group_mirror)(const sli_dual *f, sl_int j0, sl_int m) {
    const sl_int h = f->width + f->below, tiles = sli_tiles(h), first = j0 + m;
    const sl_int tile_size = SLI_TILE * SLI_TILE;
    sl_int t, c;
    for (c = 0; c < sli_tiles(m); c++) {
        const sl_int columns = sli_min(SLI_TILE, m - SLI_TILE * c);
        double *to = f->front + sli_square_offset(h, j0 / SLI_TILE + c);
        for (t = first / SLI_TILE; t < tiles; t++) {
            SLV_NAME(mirror)
            (f->front + sli_square_offset(h, t) + SLI_TILE * (ptrdiff_t)j0 +
                 tile_size * (ptrdiff_t)c,
             sli_max(first - SLI_TILE * t, 0), sli_min(SLI_TILE, h - SLI_TILE * t),
             to + tile_size * (ptrdiff_t)t, columns);
        }
    }
}

/* Z_JJ = L_JJ'^-1 D^-1 L_JJ^-1 - W' Z_SJ, the lower tiles and what mirrors them. P: room as for N. */
SLV_FUNCTION SLI_INLINE void SLV_NAME(group_square)(const sli_dual *f, sl_int j0, sl_int m,
                                                    const double *N, double *P, const double *W) {
    const sl_int h = f->width + f->below, first = j0 + m, tiles = sli_tiles(m);
    const sl_int tile_size = SLI_TILE * SLI_TILE;
    const ptrdiff_t stride = tile_size * (ptrdiff_t)(sli_tiles(h) - first / SLI_TILE);
    SLI_ALIGNED(double x[SLI_TILE * SLI_TILE]);
    sl_int c, t, j;
    for (c = 0; c < tiles; c++) {
        for (j = SLI_TILE * c; j < m; j++) {
            const double minus = -f->D[j0 + j];
            const ptrdiff_t at = SLI_DUAL_ROW * (ptrdiff_t)c + SLI_TILE * (ptrdiff_t)j;
            SLV_DECLARE(a)
            SLV_DECLARE(b)
            SLV_LOAD(a, N + at)
            SLV_BROADCAST(b, &minus)
            SLV_DIVIDE(a, a, b)
            SLV_STORE(P + at, a)
        }
    }
    for (t = 0; t < tiles; t++) {
        const sl_int rows = sli_min(SLI_TILE, m - SLI_TILE * t);
        double *row = f->front + sli_square_offset(h, j0 / SLI_TILE + t) + SLI_TILE * (ptrdiff_t)j0;
        for (c = 0; c <= t; c++) {
            const sl_int columns = sli_min(SLI_TILE, m - SLI_TILE * c);
            double *column = f->front + sli_square_offset(h, j0 / SLI_TILE + c);
            SLV_NAME(clear)(x, columns);
            SLV_NAME(block)
            (N + SLI_DUAL_ROW * (ptrdiff_t)t + tile_size * (ptrdiff_t)t,
             P + SLI_DUAL_ROW * (ptrdiff_t)c + tile_size * (ptrdiff_t)t, m - SLI_TILE * t, x,
             columns);
            if (first < h) {
                SLV_NAME(block)
                (W + t * stride + SLI_TILE * (ptrdiff_t)(first % SLI_TILE),
                 column + SLI_TILE * (ptrdiff_t)first, h - first, x, columns);
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

/* From the last group of columns to the first, each with the columns after it among its rows below:
 * what a group works upon stays in the caches, whatever the width. */
SLV_FUNCTION static void SLV_NAME(takahashi)(const sli_dual *f, double *scratch) {
    const sl_int w = f->width, h = w + f->below, most = SLI_DUAL_GROUP * SLI_TILE;
    double *N = scratch, *P = N + SLI_DUAL_GROUP * SLI_DUAL_ROW,
           *W = P + SLI_DUAL_GROUP * SLI_DUAL_ROW;
    sl_int j0;
    for (j0 = (w - 1) / most * most; j0 >= 0; j0 -= most) {
        const sl_int m = sli_min(most, w - j0);
        SLV_NAME(group_inverse)(f, j0, m, N);
        if (j0 + m < h) {
            SLV_NAME(group_weights)(f, j0, m, N, W);
            SLV_NAME(group_product)(f, j0, m, W);
            SLV_NAME(group_mirror)(f, j0, m);
        }
        SLV_NAME(group_square)(f, j0, m, N, P, W);
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
        if (f->skips_null && sli_is_null(d, sums[k], f->null_tolerance)) {                         \
            d = SLI_NULL_PIVOT;                                                                    \
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

/* count columns of a tile := 0. */
SLV_FUNCTION SLI_INLINE void SLV_NAME(clear)(double *x, sl_int count) {
    sl_int k;
    SLV_DECLARE(a)
    SLV_ZERO(a)
    for (k = 0; k < count; k++) {
        SLV_STORE(x + SLI_TILE * (ptrdiff_t)k, a)
    }
}

#define SLI_OFFSET(k) offset[k]

/* Z of the rows below, out of the parent's front: row and column i of theirs is row and column
 * places[i] there. Lanes of other rows get the numbers of a neighbour, which nothing reads. */
SLV_FUNCTION static void SLV_NAME(gather)(const sli_dual *f, const double *from, sl_int height,
                                          const sl_int *places) {
    const sl_int w = f->width, u = f->below, tiles = sli_tiles(w + u);
    sl_int t, i;
    for (t = w / SLI_TILE; t < tiles && u > 0; t++) {
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

/* N = -L'^-1 of a group of m columns from j0 on, row tile c from column 8c on; 0 where it has no row. */
SLV_FUNCTION SLI_INLINE void SLV_NAME(group_inverse)(const sli_dual *f, sl_int j0, sl_int m,
                                                     double *N) {
    const sl_int tiles = sli_tiles(m), tile_size = SLI_TILE * SLI_TILE;
    sl_int c, t, k;
    for (c = 0; c < tiles; c++, N += SLI_DUAL_ROW) {
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
    }
}

/* W' = (L_SJ L_JJ^-1)', row tile by row tile of the panel: [column tile][row][8 columns]. */
SLV_FUNCTION SLI_INLINE void SLV_NAME(group_weights)(const sli_dual *f, sl_int j0, sl_int m,
                                                     const double *N, double *W) {
    const sl_int tiles = sli_tiles(f->width + f->below), tile_size = SLI_TILE * SLI_TILE;
    sl_int c, t;
    for (c = 0; c < sli_tiles(m); c++, N += SLI_DUAL_ROW) {
        const ptrdiff_t first = SLI_TILE * (ptrdiff_t)(SLI_TILE * c);
        for (t = (j0 + m) / SLI_TILE; t < tiles; t++, W += tile_size) {
            SLV_NAME(clear)(W, SLI_TILE);
            SLV_NAME(block)
            (N + first, f->panel + sli_tile_offset(f->width, t) + SLI_TILE * (ptrdiff_t)j0 + first,
             m - SLI_TILE * c, W, SLI_TILE);
        }
    }
}

/* Z_SJ -= Z_SS W, in chunks as in a factorization. W starts at the row tile of row j0 + m. */
SLV_FUNCTION SLI_INLINE void SLV_NAME(group_product)(const sli_dual *f, sl_int j0, sl_int m,
                                                     const double *W) {
    const sl_int h = f->width + f->below, tiles = sli_tiles(h), first = j0 + m;
    const ptrdiff_t stride = SLI_TILE * SLI_TILE * (ptrdiff_t)(tiles - first / SLI_TILE);
    sl_int t, c, s;
    for (t = first / SLI_TILE; t < tiles; t++) {
        SLV_NAME(clear)(f->front + sli_square_offset(h, t) + SLI_TILE * (ptrdiff_t)j0, m);
    }
    for (s = first; s < h; s += SLI_CHUNK) {
        const sl_int length = sli_min(SLI_CHUNK, h - s);
        const double *B = W + SLI_TILE * (ptrdiff_t)(s - first + first % SLI_TILE);
        for (t = first / SLI_TILE; t < tiles; t++) {
            double *row = f->front + sli_square_offset(h, t);
            const double *A = row + SLI_TILE * (ptrdiff_t)s;
            double *C = row + SLI_TILE * (ptrdiff_t)j0;
#if SLV_TILES == 2
            if (t + 1 < tiles) {
                const ptrdiff_t next = sli_square_offset(h, 1);
                for (c = 0; c < sli_tiles(m); c++) {
                    const ptrdiff_t at = SLI_TILE * SLI_TILE * (ptrdiff_t)c;
                    SLV_NAME(block2)
                    (A, A + next, B + c * stride, length, C + at, C + next + at, m - SLI_TILE * c);
                }
                t++;
                continue;
            }
#endif
            for (c = 0; c < sli_tiles(m); c++) {
                SLV_NAME(block)
                (A, B + c * stride, length, C + SLI_TILE * SLI_TILE * (ptrdiff_t)c,
                 sli_min(SLI_TILE, m - SLI_TILE * c));
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

/* Z_JS = Z_SJ' */
SLV_FUNCTION SLI_INLINE void SLV_NAME(group_mirror)(const sli_dual *f, sl_int j0, sl_int m) {
    const sl_int h = f->width + f->below, tiles = sli_tiles(h), first = j0 + m;
    const sl_int tile_size = SLI_TILE * SLI_TILE;
    sl_int t, c;
    for (c = 0; c < sli_tiles(m); c++) {
        const sl_int columns = sli_min(SLI_TILE, m - SLI_TILE * c);
        double *to = f->front + sli_square_offset(h, j0 / SLI_TILE + c);
        for (t = first / SLI_TILE; t < tiles; t++) {
            SLV_NAME(mirror)
            (f->front + sli_square_offset(h, t) + SLI_TILE * (ptrdiff_t)j0 +
                 tile_size * (ptrdiff_t)c,
             sli_max(first - SLI_TILE * t, 0), sli_min(SLI_TILE, h - SLI_TILE * t),
             to + tile_size * (ptrdiff_t)t, columns);
        }
    }
}

/* Z_JJ = L_JJ'^-1 D^-1 L_JJ^-1 - W' Z_SJ, the lower tiles and what mirrors them. P: room as for N. */
SLV_FUNCTION SLI_INLINE void SLV_NAME(group_square)(const sli_dual *f, sl_int j0, sl_int m,
                                                    const double *N, double *P, const double *W) {
    const sl_int h = f->width + f->below, first = j0 + m, tiles = sli_tiles(m);
    const sl_int tile_size = SLI_TILE * SLI_TILE;
    const ptrdiff_t stride = tile_size * (ptrdiff_t)(sli_tiles(h) - first / SLI_TILE);
    SLI_ALIGNED(double x[SLI_TILE * SLI_TILE]);
    sl_int c, t, j;
    for (c = 0; c < tiles; c++) {
        for (j = SLI_TILE * c; j < m; j++) {
            const double minus = -f->D[j0 + j];
            const ptrdiff_t at = SLI_DUAL_ROW * (ptrdiff_t)c + SLI_TILE * (ptrdiff_t)j;
            SLV_DECLARE(a)
            SLV_DECLARE(b)
            SLV_LOAD(a, N + at)
            SLV_BROADCAST(b, &minus)
            SLV_DIVIDE(a, a, b)
            SLV_STORE(P + at, a)
        }
    }
    for (t = 0; t < tiles; t++) {
        const sl_int rows = sli_min(SLI_TILE, m - SLI_TILE * t);
        double *row = f->front + sli_square_offset(h, j0 / SLI_TILE + t) + SLI_TILE * (ptrdiff_t)j0;
        for (c = 0; c <= t; c++) {
            const sl_int columns = sli_min(SLI_TILE, m - SLI_TILE * c);
            double *column = f->front + sli_square_offset(h, j0 / SLI_TILE + c);
            SLV_NAME(clear)(x, columns);
            SLV_NAME(block)
            (N + SLI_DUAL_ROW * (ptrdiff_t)t + tile_size * (ptrdiff_t)t,
             P + SLI_DUAL_ROW * (ptrdiff_t)c + tile_size * (ptrdiff_t)t, m - SLI_TILE * t, x,
             columns);
            if (first < h) {
                SLV_NAME(block)
                (W + t * stride + SLI_TILE * (ptrdiff_t)(first % SLI_TILE),
                 column + SLI_TILE * (ptrdiff_t)first, h - first, x, columns);
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

/* From the last group of columns to the first, each with the columns after it among its rows below:
 * what a group works upon stays in the caches, whatever the width. */
SLV_FUNCTION static void SLV_NAME(takahashi)(const sli_dual *f, double *scratch) {
    const sl_int w = f->width, h = w + f->below, most = SLI_DUAL_GROUP * SLI_TILE;
    double *N = scratch, *P = N + SLI_DUAL_GROUP * SLI_DUAL_ROW,
           *W = P + SLI_DUAL_GROUP * SLI_DUAL_ROW;
    sl_int j0;
    for (j0 = (w - 1) / most * most; j0 >= 0; j0 -= most) {
        const sl_int m = sli_min(most, w - j0);
        SLV_NAME(group_inverse)(f, j0, m, N);
        if (j0 + m < h) {
            SLV_NAME(group_weights)(f, j0, m, N, W);
            SLV_NAME(group_product)(f, j0, m, W);
            SLV_NAME(group_mirror)(f, j0, m);
        }
        SLV_NAME(group_square)(f, j0, m, N, P, W);
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
        if (f->skips_null && sli_is_null(d, sums[k], f->null_tolerance)) {                         \
            d = SLI_NULL_PIVOT;                                                                    \
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

/* count columns of a tile := 0. */
SLV_FUNCTION SLI_INLINE void SLV_NAME(clear)(double *x, sl_int count) {
    sl_int k;
    SLV_DECLARE(a)
    SLV_ZERO(a)
    for (k = 0; k < count; k++) {
        SLV_STORE(x + SLI_TILE * (ptrdiff_t)k, a)
    }
}

#define SLI_OFFSET(k) offset[k]

/* Z of the rows below, out of the parent's front: row and column i of theirs is row and column
 * places[i] there. Lanes of other rows get the numbers of a neighbour, which nothing reads. */
SLV_FUNCTION static void SLV_NAME(gather)(const sli_dual *f, const double *from, sl_int height,
                                          const sl_int *places) {
    const sl_int w = f->width, u = f->below, tiles = sli_tiles(w + u);
    sl_int t, i;
    for (t = w / SLI_TILE; t < tiles && u > 0; t++) {
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

/* N = -L'^-1 of a group of m columns from j0 on, row tile c from column 8c on; 0 where it has no row. */
SLV_FUNCTION SLI_INLINE void SLV_NAME(group_inverse)(const sli_dual *f, sl_int j0, sl_int m,
                                                     double *N) {
    const sl_int tiles = sli_tiles(m), tile_size = SLI_TILE * SLI_TILE;
    sl_int c, t, k;
    for (c = 0; c < tiles; c++, N += SLI_DUAL_ROW) {
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
    }
}

/* W' = (L_SJ L_JJ^-1)', row tile by row tile of the panel: [column tile][row][8 columns]. */
SLV_FUNCTION SLI_INLINE void SLV_NAME(group_weights)(const sli_dual *f, sl_int j0, sl_int m,
                                                     const double *N, double *W) {
    const sl_int tiles = sli_tiles(f->width + f->below), tile_size = SLI_TILE * SLI_TILE;
    sl_int c, t;
    for (c = 0; c < sli_tiles(m); c++, N += SLI_DUAL_ROW) {
        const ptrdiff_t first = SLI_TILE * (ptrdiff_t)(SLI_TILE * c);
        for (t = (j0 + m) / SLI_TILE; t < tiles; t++, W += tile_size) {
            SLV_NAME(clear)(W, SLI_TILE);
            SLV_NAME(block)
            (N + first, f->panel + sli_tile_offset(f->width, t) + SLI_TILE * (ptrdiff_t)j0 + first,
             m - SLI_TILE * c, W, SLI_TILE);
        }
    }
}

/* Z_SJ -= Z_SS W, in chunks as in a factorization. W starts at the row tile of row j0 + m. */
SLV_FUNCTION SLI_INLINE void SLV_NAME(group_product)(const sli_dual *f, sl_int j0, sl_int m,
                                                     const double *W) {
    const sl_int h = f->width + f->below, tiles = sli_tiles(h), first = j0 + m;
    const ptrdiff_t stride = SLI_TILE * SLI_TILE * (ptrdiff_t)(tiles - first / SLI_TILE);
    sl_int t, c, s;
    for (t = first / SLI_TILE; t < tiles; t++) {
        SLV_NAME(clear)(f->front + sli_square_offset(h, t) + SLI_TILE * (ptrdiff_t)j0, m);
    }
    for (s = first; s < h; s += SLI_CHUNK) {
        const sl_int length = sli_min(SLI_CHUNK, h - s);
        const double *B = W + SLI_TILE * (ptrdiff_t)(s - first + first % SLI_TILE);
        for (t = first / SLI_TILE; t < tiles; t++) {
            double *row = f->front + sli_square_offset(h, t);
            const double *A = row + SLI_TILE * (ptrdiff_t)s;
            double *C = row + SLI_TILE * (ptrdiff_t)j0;
#if SLV_TILES == 2
            if (t + 1 < tiles) {
                const ptrdiff_t next = sli_square_offset(h, 1);
                for (c = 0; c < sli_tiles(m); c++) {
                    const ptrdiff_t at = SLI_TILE * SLI_TILE * (ptrdiff_t)c;
                    SLV_NAME(block2)
                    (A, A + next, B + c * stride, length, C + at, C + next + at, m - SLI_TILE * c);
                }
                t++;
                continue;
            }
#endif
            for (c = 0; c < sli_tiles(m); c++) {
                SLV_NAME(block)
                (A, B + c * stride, length, C + SLI_TILE * SLI_TILE * (ptrdiff_t)c,
                 sli_min(SLI_TILE, m - SLI_TILE * c));
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

/* Z_JS = Z_SJ' */
SLV_FUNCTION SLI_INLINE void SLV_NAME(group_mirror)(const sli_dual *f, sl_int j0, sl_int m) {
    const sl_int h = f->width + f->below, tiles = sli_tiles(h), first = j0 + m;
    const sl_int tile_size = SLI_TILE * SLI_TILE;
    sl_int t, c;
    for (c = 0; c < sli_tiles(m); c++) {
        const sl_int columns = sli_min(SLI_TILE, m - SLI_TILE * c);
        double *to = f->front + sli_square_offset(h, j0 / SLI_TILE + c);
        for (t = first / SLI_TILE; t < tiles; t++) {
            SLV_NAME(mirror)
            (f->front + sli_square_offset(h, t) + SLI_TILE * (ptrdiff_t)j0 +
                 tile_size * (ptrdiff_t)c,
             sli_max(first - SLI_TILE * t, 0), sli_min(SLI_TILE, h - SLI_TILE * t),
             to + tile_size * (ptrdiff_t)t, columns);
        }
    }
}

/* Z_JJ = L_JJ'^-1 D^-1 L_JJ^-1 - W' Z_SJ, the lower tiles and what mirrors them. P: room as for N. */
SLV_FUNCTION SLI_INLINE void SLV_NAME(group_square)(const sli_dual *f, sl_int j0, sl_int m,
                                                    const double *N, double *P, const double *W) {
    const sl_int h = f->width + f->below, first = j0 + m, tiles = sli_tiles(m);
    const sl_int tile_size = SLI_TILE * SLI_TILE;
    const ptrdiff_t stride = tile_size * (ptrdiff_t)(sli_tiles(h) - first / SLI_TILE);
    SLI_ALIGNED(double x[SLI_TILE * SLI_TILE]);
    sl_int c, t, j;
    for (c = 0; c < tiles; c++) {
        for (j = SLI_TILE * c; j < m; j++) {
            const double minus = -f->D[j0 + j];
            const ptrdiff_t at = SLI_DUAL_ROW * (ptrdiff_t)c + SLI_TILE * (ptrdiff_t)j;
            SLV_DECLARE(a)
            SLV_DECLARE(b)
            SLV_LOAD(a, N + at)
            SLV_BROADCAST(b, &minus)
            SLV_DIVIDE(a, a, b)
            SLV_STORE(P + at, a)
        }
    }
    for (t = 0; t < tiles; t++) {
        const sl_int rows = sli_min(SLI_TILE, m - SLI_TILE * t);
        double *row = f->front + sli_square_offset(h, j0 / SLI_TILE + t) + SLI_TILE * (ptrdiff_t)j0;
        for (c = 0; c <= t; c++) {
            const sl_int columns = sli_min(SLI_TILE, m - SLI_TILE * c);
            double *column = f->front + sli_square_offset(h, j0 / SLI_TILE + c);
            SLV_NAME(clear)(x, columns);
            SLV_NAME(block)
            (N + SLI_DUAL_ROW * (ptrdiff_t)t + tile_size * (ptrdiff_t)t,
             P + SLI_DUAL_ROW * (ptrdiff_t)c + tile_size * (ptrdiff_t)t, m - SLI_TILE * t, x,
             columns);
            if (first < h) {
                SLV_NAME(block)
                (W + t * stride + SLI_TILE * (ptrdiff_t)(first % SLI_TILE),
                 column + SLI_TILE * (ptrdiff_t)first, h - first, x, columns);
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

/* From the last group of columns to the first, each with the columns after it among its rows below:
 * what a group works upon stays in the caches, whatever the width. */
SLV_FUNCTION static void SLV_NAME(takahashi)(const sli_dual *f, double *scratch) {
    const sl_int w = f->width, h = w + f->below, most = SLI_DUAL_GROUP * SLI_TILE;
    double *N = scratch, *P = N + SLI_DUAL_GROUP * SLI_DUAL_ROW,
           *W = P + SLI_DUAL_GROUP * SLI_DUAL_ROW;
    sl_int j0;
    for (j0 = (w - 1) / most * most; j0 >= 0; j0 -= most) {
        const sl_int m = sli_min(most, w - j0);
        SLV_NAME(group_inverse)(f, j0, m, N);
        if (j0 + m < h) {
            SLV_NAME(group_weights)(f, j0, m, N, W);
            SLV_NAME(group_product)(f, j0, m, W);
            SLV_NAME(group_mirror)(f, j0, m);
        }
        SLV_NAME(group_square)(f, j0, m, N, P, W);
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
/* csc.h: compressed columns: checks, owned matrices, triplets, transpose, products, residuals */
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
/* end src/impl/csc.h */
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
    sl_int n_parts;    /* nodes of the tree of separators; 0: the order has none */
    sl_int *part_of;   /* n: the node of each column */
    sl_int *part_parent, *part_level; /* n_parts */
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

/* G has room for n + 1 positions and twice A's entries; n is A's rows over block, as many of which
 * side by side are one vertex. */
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
    for (j = 0; j < columns; j++) { /* every begin moves to its end, and back afterwards */
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

/* Whether every list of neighbours ascends, as it does when the rows of A do and none is given
 * twice. */
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

/* Takes repeated edges out of sorted lists. */
SLI_INLINE void sli_graph_unite(sli_graph *G) {
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
/* begin src/impl/order_coarsen.h */
/* order_coarsen.h: ever smaller graphs, each made of the one before by joining vertices two by two */
#ifndef SLI_ORDER_COARSEN_H
#define SLI_ORDER_COARSEN_H

/* A graph without loops or repeated edges. A vertex of a coarser level stands for some of the
 * finest, an edge for the finest edges between two of them. */
typedef struct sli_level {
    sl_int n;
    sl_off *begin;  /* n + 1 */
    sl_int *to;     /* begin[n] */
    sl_int *edge;   /* begin[n]: finest edges; NULL: 1 each */
    sl_int *weight; /* n: finest vertices; NULL: 1 each */
    sl_int *coarse; /* n: vertex of the next coarser level */
    void *block;    /* that all this is cut from */
} sli_level;

/* A level that keeps more than this share of its vertices is not worth its pass. */
#define SLI_COARSEN_STALL 0.95
#define SLI_LEVELS_MAX 64

SLI_INLINE sl_int sli_level_weight(const sli_level *g, sl_int v) {
    return g->weight == NULL ? 1 : g->weight[v];
}

SLI_INLINE sl_int sli_level_edge(const sli_level *g, sl_off e) {
    return g->edge == NULL ? 1 : g->edge[e];
}

/* A number that looks random, the same for the same v. */
SLI_INLINE uint32_t sli_scatter(uint32_t v) {
    v ^= v >> 16;
    v *= 0x7feb352du;
    v ^= v >> 15;
    v *= 0x846ca68bu;
    return v ^ v >> 16;
}

/* The free neighbour of v with the most edges a vertex, or -1. The search starts anywhere in the
 * list, so that pairs do not all lie in one direction. */
static sl_int sli_match_best(const sli_level *g, sl_int v, sl_int heaviest, const sl_int *mate) {
    const sl_off first = g->begin[v], degree = g->begin[v + 1] - first;
    const sl_int own = sli_level_weight(g, v);
    sl_int best = -1, best_edge = 0, best_weight = 1;
    sl_off k, e = degree > 0 ? first + (sl_off)(sli_scatter((uint32_t)v) % (uint64_t)degree) : 0;
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

/* mate[v] := the vertex that v joins, v itself if none. Vertices are visited in a scattered order,
 * but only within windows, which keeps memory close. Returns the number of pairs. */
static sl_int sli_match(const sli_level *g, sl_int heaviest, sl_int *mate) {
    const sl_int window = 512;
    sl_int first, k, v, pairs = 0;
    for (v = 0; v < g->n; v++) {
        mate[v] = -1;
    }
    for (first = 0; first < g->n; first += window) {
        const uint32_t turn = sli_scatter((uint32_t)first);
        for (k = 0; k < window; k++) {
            sl_int u;
            v = first + (sl_int)(((uint32_t)k * 197u + turn) & (uint32_t)(window - 1));
            if (v >= g->n || mate[v] != -1) {
                continue;
            }
            u = sli_match_best(g, v, heaviest, mate);
            if (u != -1) {
                mate[v] = u;
                mate[u] = v;
                pairs++;
            }
        }
        if (first > INT32_MAX - window) {
            break;
        }
    }
    return pairs;
}

/* Joins what is still alone through a common neighbour: the leaves of a star. */
static sl_int sli_match_over(const sli_level *g, sl_int heaviest, sl_int *mate) {
    sl_int v, pairs = 0;
    for (v = 0; v < g->n; v++) {
        sl_int waiting = -1;
        sl_off e;
        for (e = g->begin[v]; e < g->begin[v + 1]; e++) {
            const sl_int u = g->to[e];
            if (mate[u] != -1) {
                continue;
            }
            if (waiting != -1 &&
                sli_level_weight(g, u) <= heaviest - sli_level_weight(g, waiting)) {
                mate[u] = waiting;
                mate[waiting] = u;
                waiting = -1;
                pairs++;
            } else {
                waiting = u;
            }
        }
    }
    return pairs;
}

/* Numbers the pairs in the order of their first members; returns how many there are. */
static sl_int sli_number_pairs(const sli_level *g, const sl_int *mate) {
    sl_int v, count = 0;
    for (v = 0; v < g->n; v++) {
        const sl_int u = mate[v];
        g->coarse[v] = u == -1 || v <= u ? count++ : g->coarse[u];
    }
    return count;
}

/* Fills c, which has room, with the graph of the pairs. at: c->n of scratch. */
static void sli_contract(const sli_level *g, const sl_int *mate, sli_level *c, sl_off *at) {
    sl_int v, k, member[2];
    sl_off e, count = 0;
    for (k = 0; k < c->n; k++) {
        at[k] = -1;
    }
    for (v = 0, k = 0; v < g->n; v++) {
        const sl_off first = count;
        int m;
        if (mate[v] != -1 && mate[v] < v) {
            continue;
        }
        member[0] = v;
        member[1] = mate[v];
        c->begin[k] = first;
        c->weight[k] = 0;
        for (m = 0; m < 2 && member[m] != -1; m++) {
            c->weight[k] += sli_level_weight(g, member[m]);
            for (e = g->begin[member[m]]; e < g->begin[member[m] + 1]; e++) {
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
        k++;
    }
    c->begin[k] = count;
}

/* Makes the next level. scratch: g->n. *shrunk: whether there is one worth having. */
static sl_status sli_coarsen(const sli_level *g, sl_int heaviest, sli_level *c, sl_int *mate,
                             sl_off *at, int *shrunk, const sl_allocator *a) {
    sli_block b = {NULL, 0, 0};
    sl_status status = SL_OK;
    int pass;
    sl_int pairs = sli_match(g, heaviest, mate);
    if (pairs < g->n / 4) {
        pairs += sli_match_over(g, heaviest, mate);
    }
    memset(c, 0, sizeof *c);
    *shrunk = (double)(g->n - pairs) < SLI_COARSEN_STALL * (double)g->n;
    if (!*shrunk) {
        return SL_OK;
    }
    c->n = sli_number_pairs(g, mate);
    for (pass = 0; pass < 2 && status == SL_OK; pass++) {
        c->begin = SLI_TAKE(&b, sl_off, (size_t)c->n + 1);
        c->weight = SLI_TAKE(&b, sl_int, c->n);
        c->coarse = SLI_TAKE(&b, sl_int, c->n);
        c->to = SLI_TAKE(&b, sl_int, g->begin[g->n]);
        c->edge = SLI_TAKE(&b, sl_int, g->begin[g->n]);
        status = pass == 0 ? sli_block_alloc(&b, a) : SL_OK;
    }
    c->block = b.base;
    if (status == SL_OK) {
        sli_contract(g, mate, c, at);
    }
    return status;
}

/* What weighing a level needs: to, count: room for the finest edges; the others: n. */
typedef struct sli_weighing {
    sl_int *cluster, *member, *start, *seen, *to, *count; /* start: n + 1 */
    sl_off *at;
} sli_weighing;

/* Finest vertices by the vertex of level l that they are in. */
static void sli_weigh_members(const sli_level *levels, int l, sli_weighing *w) {
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

/* Makes the weight of an edge of level l the number of finest vertices at that border, of both
 * sides: what a separator takes. Finest edges would count a slanting border in a square grid twice
 * and a straight one once. */
static void sli_weigh_level(sli_level *levels, int l, sli_weighing *w) {
    const sli_level *finest = &levels[0];
    sli_level *g = &levels[l];
    sl_int k, i;
    sl_off e;
    sli_weigh_members(levels, l, w);
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
    /* so far the vertices of one side; the other side's come from the transposed lists */
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

#endif
/* end src/impl/order_coarsen.h */
/* begin src/impl/order_tree.h */
/* order_tree.h: the tree of separators over one graph: a label a vertex, and who stands at which border */
#ifndef SLI_ORDER_TREE_H
#define SLI_ORDER_TREE_H

/* A node is a separator, a leaf a part without one. After sli_tree_number nodes are numbered from
 * left to right, so that a subtree is an interval: whether a vertex is below t, and on which side,
 * is seen from its label alone, in the one graph that all nodes share. */
typedef struct sli_tree {
    sl_int count, room;
    sl_int root;
    sl_int *parent;       /* -1 at the root */
    sl_int *left, *right; /* -1 at a leaf */
    sl_int *low, *high;   /* the subtree is low..high */
    sl_int *weight;       /* finest vertices in the subtree */
    sl_int *scratch;      /* 2 room */
} sli_tree;

static void sli_tree_layout(sli_tree *t, sli_block *b, sl_int room) {
    t->room = room;
    t->parent = SLI_TAKE(b, sl_int, room);
    t->left = SLI_TAKE(b, sl_int, room);
    t->right = SLI_TAKE(b, sl_int, room);
    t->low = SLI_TAKE(b, sl_int, room);
    t->high = SLI_TAKE(b, sl_int, room);
    t->weight = SLI_TAKE(b, sl_int, room);
    t->scratch = SLI_TAKE(b, sl_int, 2 * (size_t)room);
}

static sl_int sli_tree_add(sli_tree *t, sl_int parent) {
    const sl_int node = t->count++;
    t->parent[node] = parent;
    t->left[node] = t->right[node] = -1;
    t->weight[node] = 0;
    return node;
}

/* Splits a leaf in two. */
static void sli_tree_split(sli_tree *t, sl_int leaf) {
    t->left[leaf] = sli_tree_add(t, leaf);
    t->right[leaf] = sli_tree_add(t, leaf);
}

SLI_INLINE int sli_tree_is_leaf(const sli_tree *t, sl_int node) {
    return t->left[node] == -1;
}

SLI_INLINE int sli_tree_is_below(const sli_tree *t, sl_int node, sl_int label) {
    return t->low[node] <= label && label <= t->high[node];
}

/* The node that parts a from b, neither of which is above the other. */
SLI_INLINE sl_int sli_tree_meet(const sli_tree *t, sl_int a, sl_int b) {
    while (!sli_tree_is_below(t, a, b)) {
        a = t->parent[a];
    }
    return a;
}

/* The next node after one in postorder, whose subtree is done. */
SLI_INLINE sl_int sli_tree_next(const sli_tree *t, sl_int node) {
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

SLI_INLINE sl_int sli_tree_first(const sli_tree *t) {
    sl_int node = t->root;
    while (t->left[node] != -1) {
        node = t->left[node];
    }
    return node;
}

static void sli_tree_renumber(sl_int *a, const sl_int *number, sl_int count, int values,
                              sl_int *scratch) {
    sl_int k;
    memcpy(scratch, a, (size_t)count * sizeof(sl_int));
    for (k = 0; k < count; k++) {
        a[number[k]] = values && scratch[k] != -1 ? number[scratch[k]] : scratch[k];
    }
}

/* Numbers the nodes from left to right, and the labels of n vertices with them. */
static void sli_tree_number(sli_tree *t, sl_int n, sl_int *label) {
    sl_int *number = t->scratch, *keep = t->scratch + t->room, node, k, next = 0;
    /* in a postorder walk a node is numbered when its left subtree is done */
    for (node = sli_tree_first(t); node != -1; node = sli_tree_next(t, node)) {
        const sl_int up = t->parent[node];
        if (t->left[node] == -1) {
            number[node] = next++;
        }
        if (up != -1 && t->left[up] == node) {
            number[up] = next++;
        }
    }
    t->root = number[t->root];
    sli_tree_renumber(t->parent, number, t->count, 1, keep);
    sli_tree_renumber(t->left, number, t->count, 1, keep);
    sli_tree_renumber(t->right, number, t->count, 1, keep);
    sli_tree_renumber(t->weight, number, t->count, 0, keep);
    for (k = 0; k < n; k++) {
        label[k] = number[label[k]];
    }
    for (node = sli_tree_first(t); node != -1; node = sli_tree_next(t, node)) {
        t->low[node] = t->left[node] == -1 ? node : t->low[t->left[node]];
        t->high[node] = t->left[node] == -1 ? node : t->high[t->right[node]];
    }
}

/* order[k] := the nodes, parents first, level by level. */
static void sli_tree_levels(const sli_tree *t, sl_int *order) {
    sl_int head, tail = 0;
    order[tail++] = t->root;
    for (head = 0; head < tail; head++) {
        if (!sli_tree_is_leaf(t, order[head])) {
            order[tail++] = t->left[order[head]];
            order[tail++] = t->right[order[head]];
        }
    }
}

/* ---- borders: for each node a list of vertices that may have a neighbour across it ---- */

typedef struct sli_borders {
    sl_int *head; /* a node: the first entry, -1 if none */
    sl_int count, room;
    sl_int *vertex, *next; /* room */
    void *block;
    int failed; /* there was no memory for more */
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
    const sl_int room = l->room < INT32_MAX / 2 ? sli_max(2 * l->room, 1024) : INT32_MAX;
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

/* Lists every vertex of a level at the nodes that part it from a neighbour. */
static void sli_borders_fill(sli_borders *l, const sli_tree *t, const sli_level *g,
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
                const sl_int node = sli_tree_meet(t, own, other);
                last = other;
                if (node != listed && node != own && node != other) {
                    listed = node;
                    sli_borders_add(l, node, v);
                }
            }
        }
    }
}

#endif
/* end src/impl/order_tree.h */
/* begin src/impl/order_piece.h */
/* order_piece.h: a piece of a graph in a numbering of its own: a whole part, or a band along a border */
#ifndef SLI_ORDER_PIECE_H
#define SLI_ORDER_PIECE_H

/* Vertices of one side of a node, of both, or a few layers of each along the border between them.
 * Edges to what lies outside but on the same side are counted in anchor. */
typedef struct sli_piece {
    sl_int n;
    sl_int *vertex; /* n: number in the level */
    sl_off *begin;  /* n + 1 */
    sl_int *to, *edge;
    sl_int *weight;
    sl_int *anchor;               /* n */
    unsigned char *side;          /* n: 0 left, 1 right, 2 separator */
    unsigned char *home;          /* n: the side that anchor holds to */
    unsigned char *layer;         /* n: distance to the border */
    int64_t total[2];             /* weight of each side, with what lies outside */
    sl_int *place;                /* a vertex of the level: its number here, -1 if it is not here */
    unsigned char *locked, *best; /* n: of the search for a cut */
    sl_int *scratch;              /* 6 n */
} sli_piece;

static void sli_piece_layout(sli_piece *p, sli_block *b, sl_int n, sl_off edges) {
    p->vertex = SLI_TAKE(b, sl_int, n);
    p->begin = SLI_TAKE(b, sl_off, (size_t)n + 1);
    p->to = SLI_TAKE(b, sl_int, edges);
    p->edge = SLI_TAKE(b, sl_int, edges);
    p->weight = SLI_TAKE(b, sl_int, n);
    p->anchor = SLI_TAKE(b, sl_int, n);
    p->side = SLI_TAKE(b, unsigned char, n);
    p->home = SLI_TAKE(b, unsigned char, n);
    p->layer = SLI_TAKE(b, unsigned char, n);
    p->place = SLI_TAKE(b, sl_int, n);
    p->locked = SLI_TAKE(b, unsigned char, n);
    p->best = SLI_TAKE(b, unsigned char, n);
    p->scratch = SLI_TAKE(b, sl_int, 6 * (uint64_t)n);
}

SLI_INLINE void sli_piece_add(sli_piece *p, sl_int v, int layer) {
    p->place[v] = p->n;
    p->layer[p->n] = (unsigned char)layer;
    p->vertex[p->n++] = v;
}

static void sli_piece_clear(sli_piece *p) {
    sl_int k;
    for (k = 0; k < p->n; k++) {
        p->place[p->vertex[k]] = -1;
    }
    p->n = 0;
}

/* The edges between the vertices that were added; all of them below node. */
static void sli_piece_edges(sli_piece *p, const sli_level *g, const sli_tree *t, sl_int node,
                            const sl_int *label) {
    sl_int k;
    sl_off e, count = 0;
    for (k = 0; k < p->n; k++) {
        const sl_int v = p->vertex[k];
        p->begin[k] = count;
        p->weight[k] = sli_level_weight(g, v);
        p->anchor[k] = 0;
        p->side[k] = p->home[k] = label[v] > node;
        for (e = g->begin[v]; e < g->begin[v + 1]; e++) {
            const sl_int u = g->to[e];
            if (p->place[u] != -1) {
                p->to[count] = p->place[u];
                p->edge[count++] = sli_level_edge(g, e);
            } else if (sli_tree_is_below(t, node, label[u])) {
                p->anchor[k] += sli_level_edge(g, e);
            }
        }
    }
    p->begin[p->n] = count;
}

/* The vertices of a leaf. */
static void sli_piece_leaf(sli_piece *p, const sli_level *g, const sli_tree *t, sl_int node,
                           const sl_int *label, const sl_int *vertices, sl_int count) {
    sl_int k;
    p->n = 0;
    for (k = 0; k < count; k++) {
        sli_piece_add(p, vertices[k], 0);
    }
    sli_piece_edges(p, g, t, node, label);
    p->total[0] = t->weight[node];
    p->total[1] = 0;
}

/* Share of a part that its band may have before another layer is added, on the finest level. In a volume two or three
 * layers are most of a small part, and a cut anywhere in it would not balance. */
#define SLI_BAND_SHARE 0.3

/* The vertices at the border of a node, and up to so many layers on either side of them. */
static void sli_piece_band(sli_piece *p, const sli_level *g, const sli_tree *t, sl_int node,
                           const sl_int *label, const sli_borders *l, int layers) {
    const sl_int most = (sl_int)(SLI_BAND_SHARE * (double)t->weight[node]);
    sl_int entry, head = 0;
    sl_off e;
    int layer;
    p->n = 0;
    for (entry = l->head[node]; entry != -1; entry = l->next[entry]) {
        const sl_int v = l->vertex[entry];
        const int side = label[v] > node;
        int crosses = 0;
        if (p->place[v] != -1 || label[v] == node || !sli_tree_is_below(t, node, label[v])) {
            continue;
        }
        for (e = g->begin[v]; e < g->begin[v + 1] && !crosses; e++) {
            const sl_int other = label[g->to[e]];
            crosses = other != node && sli_tree_is_below(t, node, other) && (other > node) != side;
        }
        if (crosses) {
            sli_piece_add(p, v, 0);
        }
    }
    for (layer = 1; layer <= layers && (layer == 1 || p->n < most); layer++) {
        const sl_int end = p->n;
        for (; head < end; head++) {
            for (e = g->begin[p->vertex[head]]; e < g->begin[p->vertex[head] + 1]; e++) {
                const sl_int u = g->to[e];
                if (p->place[u] == -1 && sli_tree_is_below(t, node, label[u])) {
                    sli_piece_add(p, u, layer);
                }
            }
        }
    }
    sli_piece_edges(p, g, t, node, label);
    p->total[0] = t->weight[t->left[node]];
    p->total[1] = t->weight[t->right[node]];
}

/* Moves a vertex from one leaf to another below node, or (to == node) into the separator. */
static void sli_relabel_vertex(sl_int v, sl_int to, sl_int node, const sli_level *g, sli_tree *t,
                               sl_int *label, sli_borders *l) {
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
            sli_tree_is_below(t, node, other)) {
            const sl_int border = sli_tree_meet(t, to, other);
            sli_borders_add(l, border, v);
            sli_borders_add(l, border, g->to[e]);
        }
    }
}

/* The leaf on v's new side that has most edges to it, or -1. */
static sl_int sli_piece_leaf_near(const sli_level *g, const sli_tree *t, sl_int node, sl_int v,
                                  int side, const sl_int *label) {
    sl_int best = -1, most = 0;
    sl_off e;
    for (e = g->begin[v]; e < g->begin[v + 1]; e++) {
        const sl_int other = label[g->to[e]];
        if (other != node && sli_tree_is_below(t, node, other) && (other > node) == side &&
            sli_level_edge(g, e) > most) {
            most = sli_level_edge(g, e);
            best = other;
        }
    }
    return best;
}

/* Writes the sides of a band into the labels. A vertex that has no neighbour on its new side stays
 * where it was: it borders on nothing but the separator. */
static void sli_piece_apply(sli_piece *p, const sli_level *g, sli_tree *t, sl_int node,
                            sl_int *label, sli_borders *l) {
    sl_int *moved = p->scratch, count = 0, k, left;
    for (k = 0; k < p->n; k++) {
        if (p->side[k] == 2) {
            sli_relabel_vertex(p->vertex[k], node, node, g, t, label, l);
        } else if (p->side[k] != p->home[k]) {
            moved[count++] = k;
        }
    }
    do { /* in layers from the border, so that a round or two are enough */
        left = 0;
        for (k = 0; k < count; k++) {
            const sl_int m = moved[k], v = p->vertex[m];
            const sl_int leaf = sli_piece_leaf_near(g, t, node, v, p->side[m], label);
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

#endif
/* end src/impl/order_piece.h */
/* begin src/impl/order_heap.h */
/* order_heap.h: a queue of vertices by gain, the largest first */
#ifndef SLI_ORDER_HEAP_H
#define SLI_ORDER_HEAP_H

/* A binary heap over arrays that several heaps may share: a vertex is in one of them at most. */
typedef struct sli_heap {
    sl_int count;
    sl_int *item;  /* count, item[0] has the largest key */
    sl_int *place; /* a vertex: where it stands in item, -1 if nowhere */
    sl_int *key;   /* a vertex: its gain */
} sli_heap;

SLI_INLINE void sli_heap_up(sli_heap *h, sl_int k, sl_int v) {
    while (k > 0 && h->key[h->item[(k - 1) / 2]] < h->key[v]) {
        h->item[k] = h->item[(k - 1) / 2];
        h->place[h->item[k]] = k;
        k = (k - 1) / 2;
    }
    h->item[k] = v;
    h->place[v] = k;
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
        h->place[h->item[k]] = k;
        k = c;
    }
    h->item[k] = v;
    h->place[v] = k;
}

SLI_INLINE void sli_heap_add(sli_heap *h, sl_int v) {
    sli_heap_up(h, h->count++, v);
}

/* After key[v] has changed. */
SLI_INLINE void sli_heap_settle(sli_heap *h, sl_int v) {
    const sl_int k = h->place[v];
    if (k > 0 && h->key[h->item[(k - 1) / 2]] < h->key[v]) {
        sli_heap_up(h, k, v);
    } else {
        sli_heap_down(h, k, v);
    }
}

SLI_INLINE void sli_heap_remove(sli_heap *h, sl_int v) {
    const sl_int k = h->place[v], last = h->item[--h->count];
    h->place[v] = -1;
    if (last != v) {
        h->place[last] = k;
        h->item[k] = last;
        sli_heap_settle(h, last);
    }
}

#endif
/* end src/impl/order_heap.h */
/* begin src/impl/order_bisect.h */
/* order_bisect.h: a part cut in two by growing one half, and a cut made lighter by moving vertices across */
#ifndef SLI_ORDER_BISECT_H
#define SLI_ORDER_BISECT_H

#define SLI_BALANCE 0.6 /* most of the weight that one side may get */

/* What a cut costs: its edges, more where the sides differ. */
SLI_INLINE double sli_cut_cost(double cut, const int64_t *total) {
    const double sum = (double)(total[0] + total[1]);
    const double skew = sum > 0.0 ? fabs((double)(total[0] - total[1])) / sum : 0.0;
    return cut * (1.0 + skew);
}

/* Edges of v across the cut minus those on its own side: what the cut loses if v moves. */
static sl_int sli_piece_gain(const sli_piece *p, sl_int v, int *on_border) {
    const int side = p->side[v];
    sl_int across = side != p->home[v] ? p->anchor[v] : 0;
    sl_int own = p->anchor[v] - across;
    sl_off e;
    for (e = p->begin[v]; e < p->begin[v + 1]; e++) {
        if (p->side[p->to[e]] != side) {
            across += p->edge[e];
        } else {
            own += p->edge[e];
        }
    }
    *on_border = across > 0;
    return across - own;
}

static int64_t sli_piece_cut(const sli_piece *p) {
    int64_t twice = 0;
    sl_int v;
    sl_off e;
    for (v = 0; v < p->n; v++) {
        for (e = p->begin[v]; e < p->begin[v + 1]; e++) {
            twice += p->side[p->to[e]] != p->side[v] ? p->edge[e] : 0;
        }
        twice += p->side[v] != p->home[v] ? 2 * (int64_t)p->anchor[v] : 0;
    }
    return twice / 2;
}

typedef struct sli_mover {
    sli_piece *p;
    sli_heap heap[2]; /* by side */
    unsigned char *locked;
    sl_int *moves; /* in the order in which they were made */
    int64_t most;  /* weight of a side */
} sli_mover;

SLI_INLINE int sli_mover_may(const sli_mover *m, sl_int v) {
    const sli_piece *p = m->p;
    const int from = p->side[v];
    const int64_t after = p->total[1 - from] + p->weight[v];
    return after <= m->most || after <= p->total[from];
}

/* The side whose best vertex should move next, -1 if none may. */
static int sli_mover_choose(const sli_mover *m) {
    int side, best = -1;
    for (side = 0; side < 2; side++) {
        const sli_heap *h = &m->heap[side];
        if (h->count > 0 && sli_mover_may(m, h->item[0])) {
            if (best == -1 || h->key[h->item[0]] > h->key[m->heap[best].item[0]] ||
                (h->key[h->item[0]] == h->key[m->heap[best].item[0]] &&
                 m->p->total[side] > m->p->total[best])) {
                best = side;
            }
        }
    }
    return best;
}

static void sli_mover_flip(sli_mover *m, sl_int v) {
    sli_piece *p = m->p;
    const int from = p->side[v];
    p->side[v] = (unsigned char)(1 - from);
    p->total[from] -= p->weight[v];
    p->total[1 - from] += p->weight[v];
}

/* Neighbours of a vertex that has just moved. */
static void sli_mover_update(sli_mover *m, sl_int v) {
    sli_piece *p = m->p;
    sl_off e;
    for (e = p->begin[v]; e < p->begin[v + 1]; e++) {
        const sl_int u = p->to[e];
        sli_heap *h = &m->heap[p->side[u]];
        if (m->locked[u]) {
            continue;
        }
        if (h->place[u] == -1) {
            int on_border;
            h->key[u] = sli_piece_gain(p, u, &on_border);
            if (on_border) {
                sli_heap_add(h, u);
            }
        } else {
            h->key[u] += p->side[u] == p->side[v] ? -2 * p->edge[e] : 2 * p->edge[e];
            sli_heap_settle(h, u);
        }
    }
}

/* One round: moves the best vertex again and again, for better or worse, each vertex once, and goes
 * back to the best cut on the way. Returns whether that is better than where it started. */
static int sli_mover_round(sli_mover *m, double *cut) {
    sli_piece *p = m->p;
    const sl_int patience = 20 + p->n / 20 < 100 ? 20 + p->n / 20 : 100;
    double here = *cut, cost = sli_cut_cost(here, p->total), best_cost = cost;
    sl_int v, made = 0, best = 0;
    int side;
    m->heap[0].count = m->heap[1].count = 0;
    for (v = 0; v < p->n; v++) {
        int on_border;
        m->locked[v] = 0;
        m->heap[0].place[v] = -1;
        m->heap[0].key[v] = sli_piece_gain(p, v, &on_border);
        if (on_border) {
            sli_heap_add(&m->heap[p->side[v]], v);
        }
    }
    while (made - best < patience && (side = sli_mover_choose(m)) != -1) {
        v = m->heap[side].item[0];
        sli_heap_remove(&m->heap[side], v);
        m->locked[v] = 1;
        here -= m->heap[side].key[v];
        sli_mover_flip(m, v);
        sli_mover_update(m, v);
        m->moves[made++] = v;
        cost = sli_cut_cost(here, p->total);
        if (cost < best_cost) {
            best_cost = cost;
            best = made;
            *cut = here;
        }
    }
    while (made > best) {
        sli_mover_flip(m, m->moves[--made]);
    }
    return best > 0;
}

static sli_mover sli_mover_of(sli_piece *p) {
    sli_mover m;
    m.p = p;
    m.heap[0].place = m.heap[1].place = p->scratch;
    m.heap[0].key = m.heap[1].key = p->scratch + p->n;
    m.heap[0].item = p->scratch + 2 * (size_t)p->n;
    m.heap[1].item = p->scratch + 3 * (size_t)p->n;
    m.moves = p->scratch + 4 * (size_t)p->n;
    m.locked = p->locked;
    m.heap[0].count = m.heap[1].count = 0;
    m.most = (int64_t)(SLI_BALANCE * (double)(p->total[0] + p->total[1]));
    return m;
}

/* Makes the cut of a part lighter and returns what it costs. [FM82] */
static double sli_piece_improve(sli_piece *p, int rounds) {
    sli_mover m = sli_mover_of(p);
    double cut = (double)sli_piece_cut(p);
    while (rounds-- > 0 && sli_mover_round(&m, &cut)) {
    }
    return sli_cut_cost(cut, p->total);
}

/* A vertex of the part far from v. queue, seen: n of scratch. */
static sl_int sli_piece_far(const sli_piece *p, sl_int v, sl_int *queue, unsigned char *seen) {
    sl_int head, tail = 0;
    sl_off e;
    memset(seen, 0, (size_t)p->n);
    queue[tail++] = v;
    seen[v] = 1;
    for (head = 0; head < tail; head++) {
        for (e = p->begin[queue[head]]; e < p->begin[queue[head] + 1]; e++) {
            if (!seen[p->to[e]]) {
                seen[p->to[e]] = 1;
                queue[tail++] = p->to[e];
            }
        }
    }
    return queue[tail - 1];
}

/* Puts half of the weight on the left, starting with seed: always the vertex next that leaves the
 * lightest cut. */
static void sli_piece_grow(sli_piece *p, sl_int seed) {
    sli_mover m = sli_mover_of(p);
    sl_int v, unseen = 0;
    p->total[1] += p->total[0];
    p->total[0] = 0;
    memset(p->side, 1, (size_t)p->n);
    memset(m.locked, 0, (size_t)p->n);
    for (v = 0; v < p->n; v++) {
        m.heap[0].place[v] = -1;
    }
    v = seed;
    for (;;) {
        m.locked[v] = 1;
        sli_mover_flip(&m, v);
        if (p->total[0] >= p->total[1]) {
            break;
        }
        sli_mover_update(&m, v);
        if (m.heap[1].count > 0) {
            v = m.heap[1].item[0];
            sli_heap_remove(&m.heap[1], v);
        } else { /* the part is not connected */
            while (unseen < p->n && m.locked[unseen]) {
                unseen++;
            }
            if (unseen == p->n) {
                break;
            }
            v = unseen;
        }
    }
}

/* Cuts a part in two: the best of some tries. */
static void sli_piece_bisect(sli_piece *p, int tries, int rounds) {
    double best = -1.0;
    int64_t total[2] = {0, 0};
    int k;
    for (k = 0; k < tries; k++) {
        sl_int seed = (sl_int)(sli_scatter((uint32_t)k + 77u) % (uint32_t)p->n);
        double cost;
        if (k % 2 == 0) {
            seed = sli_piece_far(p, seed, p->scratch, p->locked);
        }
        sli_piece_grow(p, seed);
        cost = sli_piece_improve(p, rounds);
        if (k == 0 || cost < best) {
            best = cost;
            memcpy(p->best, p->side, (size_t)p->n);
            total[0] = p->total[0];
            total[1] = p->total[1];
        }
    }
    memcpy(p->side, p->best, (size_t)p->n);
    p->total[0] = total[0];
    p->total[1] = total[1];
}

#endif
/* end src/impl/order_bisect.h */
/* begin src/impl/order_cut.h */
/* order_cut.h: the smallest set of vertices in a band whose removal parts the two sides */
#ifndef SLI_ORDER_CUT_H
#define SLI_ORDER_CUT_H

/* A flow of vertex-disjoint paths from the left side to the right. A vertex is entered and left:
 * state 2 v is its entrance, 2 v + 1 its exit; between them one path fits. By Menger's theorem as
 * many paths as possible are as many as the smallest cut has vertices. A round looks for a way from
 * every start in turn and enters no state twice. [FF56] */
typedef struct sli_flow {
    sli_piece *p;
    sl_int *before, *after; /* n: the path's vertices round v; SLI_FLOW_NONE off every path */
    sl_int *seen;           /* 2 n: the last round that entered a state */
    sl_int *way;            /* 2 n: states of a way, from the left */
    sl_off *next;           /* n: the edge to try next */
    unsigned char *end;     /* n: 1 may start a path, 2 may end one */
} sli_flow;

#define SLI_FLOW_NONE (-1)
#define SLI_FLOW_END (-2)  /* the path begins or ends here */
#define SLI_FLOW_ROUNDS 60 /* no band met needed more than 20 */

/* Vertices that touch what lies outside are ends; a side that lies in the band as a whole ends in
 * its farthest layer. */
static void sli_flow_ends(sli_flow *f) {
    const sli_piece *p = f->p;
    int far[2] = {-1, -1}, anchored[2] = {0, 0};
    sl_int v;
    for (v = 0; v < p->n; v++) {
        const int s = p->side[v];
        anchored[s] |= p->anchor[v] > 0;
        far[s] = p->layer[v] > far[s] ? p->layer[v] : far[s];
    }
    for (v = 0; v < p->n; v++) {
        const int s = p->side[v];
        const int is_end = anchored[s] ? p->anchor[v] > 0 : p->layer[v] == far[s];
        f->end[v] = (unsigned char)(is_end ? 1 + s : 0);
    }
}

/* Puts the edges of every vertex that lead towards the right first, those towards the left last: a
 * way that goes straight on leaves most room for others. */
static void sli_flow_aim(sli_flow *f) {
    sli_piece *p = f->p;
    sl_int v;
    for (v = 0; v < p->n; v++) {
        const int own = p->side[v] == 0 ? -1 - p->layer[v] : p->layer[v];
        sl_off e, front = p->begin[v], back = p->begin[v + 1];
        for (e = front; e < back;) {
            const sl_int u = p->to[e];
            const int other = p->side[u] == 0 ? -1 - p->layer[u] : p->layer[u];
            if (other > own) {
                p->to[e++] = p->to[front];
                p->to[front++] = u;
            } else if (other < own) {
                p->to[e] = p->to[--back];
                p->to[back] = u;
            } else {
                e++;
            }
        }
    }
}

/* The state to go on to from an exit, -1 if none is left. */
static sl_int sli_flow_leave(sli_flow *f, sl_int v, sl_int round) {
    const sli_piece *p = f->p;
    for (; f->next[v] < p->begin[v + 1]; f->next[v]++) {
        const sl_int u = p->to[f->next[v]];
        if (f->seen[2 * u] != round) {
            return 2 * u;
        }
    }
    /* back through the vertex, where a path comes out of it */
    return f->before[v] != SLI_FLOW_NONE && f->seen[2 * v] != round ? 2 * v : -1;
}

/* A way from entrance v to the right; its length, 0 if there is none. */
static sl_int sli_flow_way(sli_flow *f, sl_int v, sl_int round) {
    sl_int length = 0, state = 2 * v;
    f->way[length++] = state;
    f->seen[state] = round;
    while (length > 0) {
        sl_int onward = -1;
        state = f->way[length - 1];
        v = state / 2;
        if (state % 2 == 1) {
            if (f->end[v] == 2 && f->after[v] != SLI_FLOW_END) {
                break;
            }
            onward = sli_flow_leave(f, v, round);
        } else if (f->before[v] == SLI_FLOW_NONE) {
            onward = 2 * v + 1;
        } else if (f->before[v] >= 0) { /* back along the path that comes in here */
            onward = 2 * f->before[v] + 1;
        }
        if (onward == -1 || f->seen[onward] == round) {
            length--;
            continue;
        }
        f->seen[onward] = round;
        f->way[length++] = onward;
        if (onward % 2 == 1) {
            f->next[onward / 2] = f->p->begin[onward / 2];
        }
    }
    return length;
}

/* Sends one path more along a way. */
static void sli_flow_send(sli_flow *f, sl_int length) {
    sl_int k;
    f->before[f->way[0] / 2] = SLI_FLOW_END;
    for (k = 0; k < length; k++) {
        const sl_int state = f->way[k], v = state / 2;
        if (state % 2 == 0) {
            continue; /* in and through, or in and back: what follows says */
        }
        if (k + 1 == length) {
            f->after[v] = SLI_FLOW_END;
        } else if (f->way[k + 1] == 2 * v) {
            f->before[v] = f->after[v] = SLI_FLOW_NONE;
        } else {
            f->after[v] = f->way[k + 1] / 2;
            f->before[f->after[v]] = v;
        }
    }
}

/* As many paths as there can be; whether the search came to its end. Then seen == *last marks what
 * the left can reach. */
static int sli_flow_run(sli_flow *f, sl_int *last) {
    const sl_int n = f->p->n;
    sl_int v, round, found = 1;
    for (v = 0; v < n; v++) {
        f->before[v] = f->after[v] = SLI_FLOW_NONE;
        f->seen[2 * v] = f->seen[2 * v + 1] = 0;
    }
    for (round = 1; found && round <= SLI_FLOW_ROUNDS; round++) {
        found = 0;
        for (v = 0; v < n; v++) {
            if (f->end[v] == 1 && f->seen[2 * v] != round) {
                /* where a path begins the way ends at once, and yet the entrance is reached */
                const sl_int length = sli_flow_way(f, v, round);
                if (length > 0) {
                    sli_flow_send(f, length);
                    found = 1;
                }
            }
        }
        *last = round;
    }
    return !found;
}

SLI_INLINE sl_int sli_flow_see(sli_flow *f, sl_int state, sl_int tail) {
    if (f->seen[state] != -1) {
        f->seen[state] = -1;
        f->way[tail++] = state;
    }
    return tail;
}

/* Marks by -1 the states from which the right can be reached. */
static void sli_flow_back(sli_flow *f) {
    const sli_piece *p = f->p;
    sl_int v, head, tail = 0;
    sl_off e;
    for (v = 0; v < p->n; v++) {
        if (f->end[v] == 2) {
            tail = sli_flow_see(f, 2 * v + 1, tail);
        }
    }
    for (head = 0; head < tail; head++) {
        v = f->way[head] / 2;
        if (f->way[head] % 2 == 1) {
            if (f->before[v] == SLI_FLOW_NONE) {
                tail = sli_flow_see(f, 2 * v, tail);
            } else if (f->after[v] >= 0) {
                tail = sli_flow_see(f, 2 * f->after[v], tail);
            }
        } else {
            if (f->before[v] != SLI_FLOW_NONE) {
                tail = sli_flow_see(f, 2 * v + 1, tail);
            }
            for (e = p->begin[v]; e < p->begin[v + 1]; e++) {
                tail = sli_flow_see(f, 2 * p->to[e] + 1, tail);
            }
        }
    }
}

/* Adds an exit and what can be reached from it to what is marked; none of it can reach the right.
 * Returns the weight of the vertices that the left gains. */
static int64_t sli_flow_extend(sli_flow *f, sl_int v, sl_int mark) {
    const sli_piece *p = f->p;
    sl_int head, tail = 0, onward;
    int64_t gained = 0;
    sl_off e;
    f->seen[2 * v + 1] = mark;
    f->way[tail++] = 2 * v + 1;
    for (head = 0; head < tail; head++) {
        v = f->way[head] / 2;
        if (f->way[head] % 2 == 0) {
            onward = f->before[v] == SLI_FLOW_NONE ? 2 * v + 1
                     : f->before[v] >= 0           ? 2 * f->before[v] + 1
                                                   : -1;
            if (onward != -1 && f->seen[onward] != mark) {
                f->seen[onward] = mark;
                f->way[tail++] = onward;
            }
            continue;
        }
        gained += p->weight[v];
        if (f->before[v] != SLI_FLOW_NONE && f->seen[2 * v] != mark) {
            f->seen[2 * v] = mark;
            f->way[tail++] = 2 * v;
        }
        for (e = p->begin[v]; e < p->begin[v + 1]; e++) {
            onward = 2 * p->to[e];
            if (f->seen[onward] != mark) {
                f->seen[onward] = mark;
                f->way[tail++] = onward;
            }
        }
    }
    return gained;
}

/* Of all smallest cuts takes one that balances: starting with the one nearest to the left, vertices
 * from which the right cannot be reached join the left until it has half. */
static void sli_flow_balance(sli_flow *f, sl_int mark) {
    const sli_piece *p = f->p;
    int64_t left = p->total[0], half = p->total[0] + p->total[1];
    sl_int v, k;
    for (v = 0; v < p->n; v++) {
        const int in = f->seen[2 * v] == mark, out = f->seen[2 * v + 1] == mark;
        left += (p->side[v] == 1 && out ? p->weight[v] : 0) -
                (p->side[v] == 0 && !out ? p->weight[v] : 0);
        half -= in && !out ? p->weight[v] : 0;
    }
    half /= 2;
    for (k = 0; k < 2 * p->n && left < half; k++) {
        v = k < p->n ? p->n - 1 - k : k - p->n; /* the left from far to near, then the right */
        if (p->side[v] == (k >= p->n) && f->seen[2 * v + 1] != mark && f->seen[2 * v + 1] != -1) {
            left += sli_flow_extend(f, v, mark);
        }
    }
}

/* The way out where a search takes too long: the border vertices of the lighter side. */
static void sli_cut_cover(sli_piece *p) {
    const int side = p->total[0] > p->total[1];
    sl_int v;
    for (v = 0; v < p->n; v++) {
        p->side[v] = p->side[v] == side && p->layer[v] == 0 ? 2 : p->side[v];
    }
}

/* Makes a smallest cut the separator of a band. end: n, scratch: 6 n, next: n of scratch. */
static void sli_piece_cut_vertices(sli_piece *p, unsigned char *end, sl_int *scratch,
                                   sl_off *next) {
    const size_t n = (size_t)p->n;
    sl_int v, last = 0;
    sli_flow f;
    f.p = p;
    f.before = scratch;
    f.after = scratch + n;
    f.seen = scratch + 2 * n;
    f.way = scratch + 4 * n;
    f.next = next;
    f.end = end;
    sli_flow_ends(&f);
    sli_flow_aim(&f);
    if (p->n > INT32_MAX / 2 || !sli_flow_run(&f, &last)) {
        sli_cut_cover(p);
        return;
    }
    sli_flow_back(&f);
    sli_flow_balance(&f, last);
    for (v = 0; v < p->n; v++) {
        const int in = f.seen[2 * v] == last, out = f.seen[2 * v + 1] == last;
        p->side[v] = (unsigned char)(out ? 0 : in ? 2 : 1);
    }
}

#endif
/* end src/impl/order_cut.h */
/* begin src/impl/order_leaves.h */
/* order_leaves.h: minimum degree in the parts that are too small to dissect, on rows of bits */
#ifndef SLI_ORDER_LEAVES_H
#define SLI_ORDER_LEAVES_H

#define SLI_LEAF_MAX 1024 /* vertices of a leaf that is ordered; larger ones keep their order */
#define SLI_LEAF_GONE UINT32_MAX

/* A leaf with its halo: the vertices of separators round it, which are eliminated later and so
 * count in every degree. */
typedef struct sli_leaf {
    sl_int n;                          /* own vertices: bits 0..n-1; halo bits follow */
    size_t words;                      /* 64-bit words a row */
    uint64_t *rows;                    /* n x words: the graph of what is left, with its diagonal */
    uint32_t *key;                     /* n: degree, then number; SLI_LEAF_GONE once eliminated */
    size_t room;                       /* words in rows */
    uint64_t alive[SLI_LEAF_MAX / 64]; /* own vertices that are not eliminated */
    int has_popcnt;                    /* any processor with AVX2 has that instruction */
} sli_leaf;

/* Bits of a word: one instruction in functions compiled for it, see below. */
SLI_ALWAYS_INLINE uint32_t sli_bits(uint64_t w) {
#if defined(__GNUC__)
    return (uint32_t)__builtin_popcountll(w);
#else
    w -= w >> 1 & 0x5555555555555555u;
    w = (w & 0x3333333333333333u) + (w >> 2 & 0x3333333333333333u);
    w = (w + (w >> 4)) & 0x0f0f0f0f0f0f0f0fu;
    return (uint32_t)(w * 0x0101010101010101u >> 56);
#endif
}

SLI_ALWAYS_INLINE sl_int sli_lowest_bit(uint64_t w) {
#if defined(__GNUC__)
    return (sl_int)__builtin_ctzll(w);
#else
    return (sl_int)sli_bits((w & (0 - w)) - 1);
#endif
}

/* other |= row without bit v; the degree, of which row v is part. */
SLI_ALWAYS_INLINE uint32_t sli_leaf_join(uint64_t *other, const uint64_t *row, size_t words,
                                         sl_int v) {
    uint32_t degree = 0;
    size_t k;
    other[v / 64] &= ~((uint64_t)1 << (v % 64));
    for (k = 0; k < words; k++) {
        other[k] |= row[k];
        degree += sli_bits(other[k]);
    }
    return degree - 1;
}

/* Takes v out, and with it all that have no other neighbours than v has: the neighbours of v become
 * neighbours of each other. Appends them to order[at] on; where that ends. */
SLI_ALWAYS_INLINE sl_int sli_leaf_eliminate(sli_leaf *l, sl_int v, sl_int *order, sl_int at) {
    const uint32_t degree = l->key[v] / SLI_LEAF_MAX;
    const size_t own = ((size_t)l->n + 63) / 64;
    uint64_t *row = l->rows + (size_t)v * l->words, gone[SLI_LEAF_MAX / 64];
    const sl_int first = at;
    size_t k, w;
    memset(gone, 0, own * sizeof(uint64_t));
    row[v / 64] &= ~((uint64_t)1 << (v % 64));
    l->key[v] = SLI_LEAF_GONE;
    order[at++] = v;
    for (k = 0; k < own; k++) {
        uint64_t bits = row[k] & l->alive[k];
        for (; bits != 0; bits &= bits - 1) {
            const sl_int u = (sl_int)(64 * k) + sli_lowest_bit(bits);
            const uint32_t now = sli_leaf_join(l->rows + (size_t)u * l->words, row, l->words, v);
            l->key[u] = now * SLI_LEAF_MAX + (uint32_t)u;
            if (now + 1 == degree) { /* the clique of v, and nothing else */
                l->key[u] = SLI_LEAF_GONE;
                gone[k] |= (uint64_t)1 << (u % 64);
                order[at++] = u;
            }
        }
    }
    l->alive[v / 64] &= ~((uint64_t)1 << (v % 64));
    for (k = 0; k < own && at > first + 1; k++) {
        uint64_t bits = row[k] & l->alive[k] & ~gone[k];
        for (; bits != 0; bits &= bits - 1) {
            const sl_int u = (sl_int)(64 * k) + sli_lowest_bit(bits);
            uint64_t *other = l->rows + (size_t)u * l->words;
            for (w = 0; w < own; w++) {
                other[w] &= ~gone[w];
            }
            l->key[u] -= (uint32_t)(at - first - 1) * SLI_LEAF_MAX;
        }
    }
    for (k = 0; k < own; k++) {
        l->alive[k] &= ~gone[k];
    }
    return at;
}

/* The first vertex of the fewest neighbours. */
SLI_INLINE sl_int sli_leaf_best(const sli_leaf *l) {
    uint32_t least[4] = {SLI_LEAF_GONE, SLI_LEAF_GONE, SLI_LEAF_GONE, SLI_LEAF_GONE};
    sl_int v = 0, k;
    for (; v <= l->n - 4; v += 4) {
        for (k = 0; k < 4; k++) {
            least[k] = l->key[v + k] < least[k] ? l->key[v + k] : least[k];
        }
    }
    for (; v < l->n; v++) {
        least[0] = l->key[v] < least[0] ? l->key[v] : least[0];
    }
    for (k = 1; k < 4; k++) {
        least[0] = least[k] < least[0] ? least[k] : least[0];
    }
    return (sl_int)(least[0] % SLI_LEAF_MAX);
}

/* order: the vertices in the order of elimination. */
SLI_ALWAYS_INLINE void sli_leaf_run_body(sli_leaf *l, sl_int *order) {
    sl_int at = 0;
    while (at < l->n) {
        at = sli_leaf_eliminate(l, sli_leaf_best(l), order, at);
    }
}

static void sli_leaf_run(sli_leaf *l, sl_int *order) {
    sli_leaf_run_body(l, order);
}

#if defined(SLI_X86)
SLI_TARGET("popcnt") static void sli_leaf_run_popcnt(sli_leaf *l, sl_int *order) {
    sli_leaf_run_body(l, order);
}
#endif

/* The graph of a leaf as rows of bits; whether there is room for it. place: for each vertex of g -1
 * on entry and on return. */
static int sli_leaf_fill(sli_leaf *l, const sli_level *g, const sl_int *vertices, sl_int count,
                         sl_int *place) {
    sl_int k, bits = count;
    sl_off e;
    int fits;
    for (k = 0; k < count; k++) {
        place[vertices[k]] = k;
    }
    for (k = 0; k < count; k++) {
        for (e = g->begin[vertices[k]]; e < g->begin[vertices[k] + 1]; e++) {
            if (place[g->to[e]] == -1) {
                place[g->to[e]] = bits++;
            }
        }
    }
    l->n = count;
    l->words = ((size_t)bits + 63) / 64;
    fits = count <= SLI_LEAF_MAX && l->words * (size_t)count <= l->room;
    if (fits) {
        memset(l->alive, 0, sizeof l->alive);
        memset(l->rows, 0, l->words * (size_t)count * sizeof(uint64_t));
    }
    for (k = 0; k < count && fits; k++) {
        uint64_t *row = l->rows + (size_t)k * l->words;
        for (e = g->begin[vertices[k]]; e < g->begin[vertices[k] + 1]; e++) {
            const sl_int b = place[g->to[e]];
            row[b / 64] |= (uint64_t)1 << (b % 64);
        }
        l->key[k] = (sli_leaf_join(row, row, l->words, k) + 1) * SLI_LEAF_MAX + (uint32_t)k;
        row[k / 64] |= (uint64_t)1 << (k % 64);
        l->alive[k / 64] |= (uint64_t)1 << (k % 64);
    }
    for (k = 0; k < count; k++) {
        for (e = g->begin[vertices[k]]; e < g->begin[vertices[k] + 1]; e++) {
            place[g->to[e]] = -1;
        }
        place[vertices[k]] = -1;
    }
    return fits;
}

/* Reorders vertices, all of one leaf, in place: always the one with the fewest neighbours next.
 * order: count of scratch. */
static void sli_leaf_order(sli_leaf *l, const sli_level *g, sl_int *vertices, sl_int count,
                           sl_int *place, sl_int *order) {
    sl_int k;
    if (!sli_leaf_fill(l, g, vertices, count, place)) {
        return;
    }
#if defined(SLI_X86)
    if (l->has_popcnt) {
        sli_leaf_run_popcnt(l, order);
    } else
#endif
    {
        sli_leaf_run(l, order);
    }
    for (k = 0; k < count; k++) {
        order[k] = vertices[order[k]];
    }
    memcpy(vertices, order, (size_t)count * sizeof(sl_int));
}

#endif
/* end src/impl/order_leaves.h */
/* begin src/impl/order_dissect.h */
/* order_dissect.h: nested dissection of a connected graph: where to cut, found on a coarse level, refined on the finest */
#ifndef SLI_ORDER_DISSECT_H
#define SLI_ORDER_DISSECT_H

/* Below this many vertices minimum degree is about as good as a further cut; on METIS's separators
 * smaller leaves save another half percent of fill. */
#define SLI_DISSECT_LEAF 200
#define SLI_DISSECT_LEAF_QUALITY 140
/* A part is cut on the coarsest level on which it has more vertices than this. */
#define SLI_DISSECT_PART 100
/* The finest level on which parts are cut has a vertex for at least so many of the graph. */
#define SLI_DISSECT_SHRINK 7
/* Growing tries for the first cuts, which decide most, and for all others. */
#define SLI_DISSECT_FIRST 64
#define SLI_DISSECT_TRIES_FIRST 8
#define SLI_DISSECT_TRIES 2
/* Layers on either side of a border that may change sides, on coarse levels and at last. */
#define SLI_DISSECT_LAYERS 3
#define SLI_DISSECT_BAND 2
#define SLI_DISSECT_BAND_FROM 1000
/* Most of the weight that one side of a separator may get: the last step may lose some balance. */
#define SLI_CUT_BALANCE 0.7

/* Everything that is needed while one graph after the other is dissected; all have room for the
 * largest. */
typedef struct sli_dissection {
    const sl_allocator *a;
    sli_level levels[SLI_LEVELS_MAX]; /* the finest first; it is not owned */
    int n_levels, l;                  /* l: the level that labels are of */
    sl_int total;                     /* weight of the finest level */
    sl_int most;                      /* vertices of a leaf, where it can be cut */
    int widening; /* layers more of a band for each four times of a part's size */
    sli_tree tree;
    sli_borders borders;
    sli_piece part;
    sli_leaf leaf;
    sl_int *label, *other; /* n: the node of each vertex; the other one is scratch */
    sl_int *begin;         /* room + 1: where the vertices of a node begin in order */
    sl_int *order;         /* n */
    sl_int *nodes;         /* room */
    sl_off *next;          /* n */
} sli_dissection;

static void sli_dissection_layout(sli_dissection *d, sli_block *b, sl_int n, sl_off edges) {
    const sl_int room = n + 1; /* more nodes than vertices are not made */
    d->levels[0].coarse = SLI_TAKE(b, sl_int, n);
    sli_tree_layout(&d->tree, b, room);
    d->borders.head = SLI_TAKE(b, sl_int, room);
    sli_piece_layout(&d->part, b, n, edges);
    d->label = SLI_TAKE(b, sl_int, n);
    d->other = SLI_TAKE(b, sl_int, n);
    d->begin = SLI_TAKE(b, sl_int, (size_t)room + 1);
    d->order = SLI_TAKE(b, sl_int, n);
    d->nodes = SLI_TAKE(b, sl_int, room);
    d->next = SLI_TAKE(b, sl_off, n);
    d->leaf.key = SLI_TAKE(b, uint32_t, SLI_LEAF_MAX);
    d->leaf.room = (size_t)SLI_LEAF_MAX * SLI_LEAF_MAX / 32;
    d->leaf.rows = SLI_TAKE(b, uint64_t, d->leaf.room);
}

/* The vertices of node t become order[begin[t]] .. order[begin[t + 1] - 1]. */
static void sli_dissect_sort(sli_dissection *d) {
    const sli_level *g = &d->levels[d->l];
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

/* One node, everything. */
static void sli_dissect_start(sli_dissection *d) {
    const sl_int n = d->levels[d->l].n;
    d->tree.count = 0;
    d->tree.root = sli_tree_add(&d->tree, -1);
    d->tree.weight[d->tree.root] = d->total;
    memset(d->label, 0, (size_t)n * sizeof(sl_int));
    sli_tree_number(&d->tree, n, d->label);
}

/* Hands the sides of the part to two new leaves below node. */
static void sli_dissect_divide(sli_dissection *d, sl_int node) {
    const sli_piece *p = &d->part;
    sl_int k, weight[2] = {0, 0};
    sli_tree_split(&d->tree, node);
    for (k = 0; k < p->n; k++) {
        const int side = p->side[k];
        d->label[p->vertex[k]] = side == 0 ? d->tree.left[node] : d->tree.right[node];
        weight[side] += p->weight[k];
    }
    d->tree.weight[d->tree.left[node]] = weight[0];
    d->tree.weight[d->tree.right[node]] = weight[1];
}

/* Cuts every leaf of more than so many vertices of this level, and of more than a leaf may have of
 * the finest. Returns how many there were. */
static sl_int sli_dissect_split(sli_dissection *d, sl_int most) {
    const sli_level *g = &d->levels[d->l];
    const sl_int nodes = d->tree.count;
    sl_int node, split = 0;
    sli_dissect_sort(d);
    for (node = 0; node < nodes; node++) {
        const sl_int count = d->begin[node + 1] - d->begin[node];
        if (sli_tree_is_leaf(&d->tree, node) && count > most && d->tree.weight[node] > d->most &&
            d->tree.count < d->tree.room - 1) {
            const int few = d->tree.count < SLI_DISSECT_FIRST && count <= 2 * SLI_DISSECT_PART;
            sli_piece_leaf(&d->part, g, &d->tree, node, d->label, d->order + d->begin[node], count);
            sli_piece_bisect(&d->part,
                             few          ? SLI_DISSECT_TRIES_FIRST
                             : count > 50 ? SLI_DISSECT_TRIES
                                          : 1,
                             2);
            sli_dissect_divide(d, node);
            sli_piece_clear(&d->part);
            split++;
        }
    }
    if (split > 0) {
        sli_tree_number(&d->tree, g->n, d->label);
    }
    return split;
}

/* Moves the borders of all nodes, the root's first, to where they cut less. */
static void sli_dissect_refine(sli_dissection *d) {
    const sli_level *g = &d->levels[d->l];
    sl_int k;
    sli_borders_fill(&d->borders, &d->tree, g, d->label);
    sli_tree_levels(&d->tree, d->nodes);
    for (k = 0; k < d->tree.count; k++) {
        const sl_int node = d->nodes[k];
        if (!sli_tree_is_leaf(&d->tree, node) && d->borders.head[node] != -1) {
            sli_piece_band(&d->part, g, &d->tree, node, d->label, &d->borders, SLI_DISSECT_LAYERS);
            sli_piece_improve(&d->part, 2);
            sli_piece_apply(&d->part, g, &d->tree, node, d->label, &d->borders);
            sli_piece_clear(&d->part);
        }
    }
}

/* Whether the sides of the piece, now with a separator, are balanced, or no less than before. */
static int sli_dissect_is_even(const sli_dissection *d) {
    const sli_piece *p = &d->part;
    int64_t total[2], sum, before = p->total[0] > p->total[1] ? p->total[0] : p->total[1];
    sl_int v;
    total[0] = p->total[0];
    total[1] = p->total[1];
    for (v = 0; v < p->n; v++) {
        total[p->home[v]] -= p->weight[v];
        if (p->side[v] != 2) {
            total[p->side[v]] += p->weight[v];
        }
    }
    sum = total[0] + total[1];
    total[0] = total[0] > total[1] ? total[0] : total[1];
    return (double)total[0] <= SLI_CUT_BALANCE * (double)sum || total[0] <= before;
}

/* Puts a smallest vertex cut of the band at each border into the separators, the root's first. The
 * larger a part, the wider its band: the first cuts decide most, and there are few of them. Where
 * the cut is out of balance a narrower band is taken, at last the border alone. */
static void sli_dissect_cut(sli_dissection *d) {
    const sli_level *g = &d->levels[0];
    sl_int k;
    sli_borders_fill(&d->borders, &d->tree, g, d->label);
    sli_tree_levels(&d->tree, d->nodes);
    for (k = 0; k < d->tree.count; k++) {
        const sl_int node = d->nodes[k];
        sl_int weight = d->tree.weight[node];
        int layers = SLI_DISSECT_BAND;
        if (sli_tree_is_leaf(&d->tree, node) || d->borders.head[node] == -1) {
            continue;
        }
        for (; weight > SLI_DISSECT_BAND_FROM; weight /= 4) {
            layers += weight > 4 * SLI_DISSECT_BAND_FROM ? d->widening : sli_min(d->widening, 1);
        }
        for (;; layers /= 2) {
            sli_piece_band(&d->part, g, &d->tree, node, d->label, &d->borders, layers);
            sli_piece_cut_vertices(&d->part, d->part.locked, d->part.scratch, d->next);
            if (layers == 0 || sli_dissect_is_even(d)) {
                break;
            }
            sli_piece_clear(&d->part);
        }
        sli_piece_apply(&d->part, g, &d->tree, node, d->label, &d->borders);
        sli_piece_clear(&d->part);
    }
}

/* Labels of a level to the next finer one. */
static void sli_dissect_project(sli_dissection *d) {
    const sli_level *g = &d->levels[--d->l];
    sl_int v, *coarser = d->label;
    for (v = 0; v < g->n; v++) {
        d->other[v] = coarser[g->coarse[v]];
    }
    d->label = d->other;
    d->other = coarser;
}

static void sli_dissect_weigh(sli_dissection *d, int l) {
    sli_weighing w;
    w.cluster = d->label;
    w.member = d->order;
    w.start = d->nodes;
    w.seen = d->begin;
    w.to = d->part.to;
    w.count = d->part.edge;
    w.at = d->next;
    sli_weigh_level(d->levels, l, &w);
}

/* Coarsens; *working: the level on which parts are cut. */
static sl_status sli_dissect_coarsen(sli_dissection *d, int *working) {
    const sl_int n = d->levels[0].n, enough = sli_min(SLI_DISSECT_PART, n / SLI_DISSECT_SHRINK);
    int shrunk = 1;
    sl_status status = SL_OK;
    *working = -1;
    d->n_levels = 1;
    for (;;) {
        const int last = d->n_levels - 1;
        const sli_level *g = &d->levels[last];
        /* three times the mean weight keeps a level even, which a cut by halves needs */
        const sl_int heaviest = (sl_int)(3.0 * (double)d->total / (double)g->n) + 1;
        if (*working == -1 && last > 0 && g->n <= n / SLI_DISSECT_SHRINK) {
            *working = last;
            sli_dissect_weigh(d, last);
        }
        if (g->n <= enough || d->n_levels == SLI_LEVELS_MAX) {
            break;
        }
        status =
            sli_coarsen(g, heaviest, &d->levels[d->n_levels], d->order, d->next, &shrunk, d->a);
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

/* The tree of parts: each is cut as soon as it is large enough on a level; its border then follows
 * from level to level. */
static sl_status sli_dissect_multilevel(sli_dissection *d) {
    int working;
    sl_status status = sli_dissect_coarsen(d, &working);
    if (status == SL_OK) {
        d->l = d->n_levels - 1;
        sli_dissect_start(d);
        for (;;) {
            while (sli_dissect_split(d, d->l == working ? 1 : SLI_DISSECT_PART) > 0) {
            }
            if (d->l == working) {
                break;
            }
            sli_dissect_project(d);
            sli_dissect_refine(d);
        }
        while (d->l > 0) {
            sli_dissect_project(d);
        }
    }
    sli_dissect_free_levels(d);
    return status != SL_OK ? status : d->borders.failed ? SL_ERR_MEMORY : SL_OK;
}

/* What a tree of parts will cost in path weight, in a measure of its own: half of a part's vertices
 * pass its separator, whose columns are about as many as they are long, so each node counts its
 * weight times the square of its border. *flat: the same for a flat square of as many vertices. */
static double sli_dissect_cost(sli_dissection *d, double *flat) {
    const sli_level *g = &d->levels[0];
    sl_int *border = d->nodes, v, k;
    sl_off e;
    double cost = 0.0;
    memset(border, 0, (size_t)d->tree.count * sizeof(sl_int));
    for (v = 0; v < g->n; v++) {
        const sl_int own = d->label[v];
        sl_int last = -1;
        for (e = g->begin[v]; e < g->begin[v + 1]; e++) {
            const sl_int other = d->label[g->to[e]];
            if (own < other && other != last) {
                const sl_int node = sli_tree_meet(&d->tree, own, other);
                border[node] += last == -1 || node != sli_tree_meet(&d->tree, own, last);
                last = other;
            }
        }
    }
    *flat = 0.0;
    for (k = 0; k < d->tree.count; k++) {
        const double weight = d->tree.weight[k];
        if (!sli_tree_is_leaf(&d->tree, k)) {
            cost += weight * (double)border[k] * (double)border[k];
            *flat += weight * weight;
        }
    }
    return cost;
}

#endif
/* end src/impl/order_dissect.h */
/* begin src/impl/order_layers.h */
/* order_layers.h: parts cut between the layers of a breadth-first search: what grids of three dimensions want */
#ifndef SLI_ORDER_LAYERS_H
#define SLI_ORDER_LAYERS_H

/* A cut is looked for where either side has at least this share. */
#define SLI_LAYERS_SHARE 0.35

/* Distances from a vertex, what it does not reach following at a distance; the vertices in that
 * order. Returns the number of distances, at most 2 n. */
static sl_int sli_layers_search(const sli_piece *p, sl_int from, sl_int *order, sl_int *distance) {
    sl_int v, head = 0, tail = 0, unseen = 0;
    sl_off e;
    for (v = 0; v < p->n; v++) {
        distance[v] = -1;
    }
    distance[from] = 0;
    order[tail++] = from;
    for (;;) {
        for (; head < tail; head++) {
            for (e = p->begin[order[head]]; e < p->begin[order[head] + 1]; e++) {
                if (distance[p->to[e]] == -1) {
                    distance[p->to[e]] = distance[order[head]] + 1;
                    order[tail++] = p->to[e];
                }
            }
        }
        if (tail == p->n) {
            return distance[order[tail - 1]] + 1;
        }
        while (distance[unseen] != -1) {
            unseen++;
        }
        distance[unseen] = distance[order[tail - 1]] + 2; /* nothing lies between */
        order[tail++] = unseen;
    }
}

/* Sides by layers from a vertex far from others: of the layers near the middle the smallest becomes
 * the border. */
static void sli_layers_bisect(sli_piece *p) {
    const sl_int n = p->n;
    sl_int *order = p->scratch, *distance = p->scratch + (size_t)n,
           *size = p->scratch + 2 * (size_t)n;
    const sl_int low = (sl_int)(SLI_LAYERS_SHARE * n), high = n - low;
    sl_int k, layers, before = 0, best = -1;
    double cost = 0.0;
    const sl_int far = sli_piece_far(p, 0, order, p->locked);
    layers = sli_layers_search(p, sli_piece_far(p, far, order, p->locked), order, distance);
    memset(size, 0, (size_t)layers * sizeof(sl_int));
    for (k = 0; k < n; k++) {
        size[distance[k]]++;
    }
    for (k = 0; k < layers; before += size[k++]) {
        const double skew = fabs((double)(n - size[k] - 2 * (int64_t)before)) / n;
        const double here = (1.0 + skew) * size[k];
        if (before >= low && before + size[k] <= high && (best == -1 || here < cost)) {
            best = k;
            cost = here;
        }
    }
    for (k = 0; k < n; k++) { /* where all is in a few layers, by halves of the search */
        p->side[order[k]] = (unsigned char)(best == -1 ? k >= n / 2 : distance[order[k]] >= best);
    }
}

static void sli_dissect_layers(sli_dissection *d) {
    const sli_level *g = &d->levels[0];
    sl_int node, nodes;
    d->l = 0;
    sli_dissect_start(d);
    do {
        nodes = d->tree.count;
        sli_dissect_sort(d);
        for (node = 0; node < nodes && d->tree.count < d->tree.room - 1; node++) {
            const sl_int count = d->begin[node + 1] - d->begin[node];
            if (count > d->most) {
                sli_piece_leaf(&d->part, g, &d->tree, node, d->label, d->order + d->begin[node],
                               count);
                sli_layers_bisect(&d->part);
                sli_dissect_divide(d, node);
                sli_piece_clear(&d->part);
            }
        }
        sli_tree_number(&d->tree, g->n, d->label);
    } while (d->tree.count > nodes);
}

/* Vertices at the left of the root's border. */
static sl_int sli_dissect_border(const sli_dissection *d) {
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

/* A border of so many times the root of the vertices is none of a surface. */
#define SLI_VOLUME_BORDER 2.5

/* Labels by levels of coarser graphs; of what may be a volume by layers, where those are estimated
 * to be the cheaper parts: in a grid of seven points they are diagonal planes of three quarters the
 * size of a straight one. */
static sl_status sli_dissect_graph(sli_dissection *d) {
    double levels, layers, flat;
    sl_status status = sli_dissect_multilevel(d);
    if (status != SL_OK ||
        (double)sli_dissect_border(d) < SLI_VOLUME_BORDER * sqrt((double)d->levels[0].n)) {
        return status;
    }
    levels = sli_dissect_cost(d, &flat);
    sli_dissect_layers(d);
    layers = sli_dissect_cost(d, &flat);
    if (layers < levels) {
        d->widening = 0;
        return SL_OK;
    }
    return sli_dissect_multilevel(d);
}

#endif
/* end src/impl/order_layers.h */
/* begin src/impl/order_geometric.h */
/* order_geometric.h: nested dissection by coordinates: halves of space, and when they are the better parts */
#ifndef SLI_ORDER_GEOMETRIC_H
#define SLI_ORDER_GEOMETRIC_H

/* Points of a graph's vertices: vertex v lies at xyz[dimensions row[v]] .. */
typedef struct sli_points {
    const double *xyz;
    sl_int dimensions;
    const sl_int *row;
} sli_points;

/* Directions to cut across: axes, then diagonals of two of them, as sums of coordinates. */
static const signed char sli_directions[9][3] = {{1, 0, 0},  {0, 1, 0}, {1, 1, 0},
                                                 {1, -1, 0}, {0, 0, 1}, {1, 0, 1},
                                                 {1, 0, -1}, {0, 1, 1}, {0, 1, -1}};

/* The larger parts look for their direction on so many of their points. */
#define SLI_POINTS_MANY 16384
#define SLI_POINTS_TRIED 512

/* How far v lies along a direction. */
SLI_INLINE double sli_point_along(const sli_points *p, sl_int v, int direction) {
    const double *x = p->xyz + (size_t)p->row[v] * (size_t)p->dimensions;
    const signed char *along = sli_directions[direction];
    /* coordinates may be as large as a double can be, and a sum of two must not be infinite */
    const double sum = along[0] * (0.5 * x[0]) + along[1] * (0.5 * x[1]) +
                       (p->dimensions == 3 ? along[2] * (0.5 * x[2]) : 0.0);
    return direction == 2 || direction == 3 || direction > 4 ? 0.70710678118654752 * sum : sum;
}

/* The axis along which some vertices spread most, and how far, by about SLI_POINTS_TRIED of them. */
static int sli_points_axis(const sli_points *p, const sl_int *vertices, sl_int count,
                           double *spread) {
    static const int sli_axes[3] = {0, 1, 4};
    const sl_int step = count / SLI_POINTS_TRIED + 1;
    sl_int axis, k;
    int best = 0;
    *spread = -1.0;
    for (axis = 0; axis < p->dimensions; axis++) {
        double low = sli_point_along(p, vertices[0], sli_axes[axis]), high = low;
        for (k = step; k < count; k = k < count - step ? k + step : count) {
            const double x = sli_point_along(p, vertices[k], sli_axes[axis]);
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

/* A pair of a place and a vertex, ordered by both, so that no two are equal. */
typedef struct sli_placed {
    double x;
    sl_int v;
} sli_placed;

SLI_INLINE int sli_placed_before(const sli_placed *a, const sli_placed *b) {
    return a->x < b->x || (a->x == b->x && a->v < b->v);
}

/* Reorders so that the first half are those before the median. Each round draws its pivot from the
 * middle of three; the ranges that are left halve on average, whatever the order of the input. */
static void sli_placed_halve(sli_placed *a, sl_int count) {
    sl_int low = 0, high = count - 1;
    const sl_int half = count / 2;
    uint32_t turn = 1;
    while (low < high) {
        const uint32_t span = (uint32_t)(high - low) + 1u;
        const sli_placed pivot = a[low + (sl_int)(sli_scatter(turn++) % span)];
        sl_int i = low, j = high;
        while (i <= j) {
            while (sli_placed_before(&a[i], &pivot)) {
                i++;
            }
            while (sli_placed_before(&pivot, &a[j])) {
                j--;
            }
            if (i <= j) {
                const sli_placed keep = a[i];
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

/* The direction in which fewest points lie close to the median: the narrowest place of a part. */
static int sli_points_narrow(const sli_points *p, const sl_int *vertices, sl_int count,
                             sli_placed *placed) {
    double spread;
    const int axis = sli_points_axis(p, vertices, count, &spread);
    int direction, best = axis;
    const int directions = p->dimensions == 3 ? 9 : 4;
    sl_int fewest = INT32_MAX, k;
    if (count < SLI_POINTS_MANY) {
        return best;
    }
    for (direction = 0; direction < directions; direction++) {
        sl_int near = 0;
        double middle;
        for (k = 0; k < SLI_POINTS_TRIED; k++) {
            const sl_int v = vertices[(int64_t)k * count / SLI_POINTS_TRIED];
            placed[k].x = sli_point_along(p, v, direction);
            placed[k].v = v;
        }
        sli_placed_halve(placed, SLI_POINTS_TRIED);
        middle = placed[SLI_POINTS_TRIED / 2].x;
        for (k = 0; k < SLI_POINTS_TRIED; k++) {
            near += fabs(placed[k].x - middle) < 0.1 * spread;
        }
        near += direction == axis ? 0 : near / 3; /* chance must not decide against an axis */
        if (near < fewest) {
            fewest = near;
            best = direction;
        }
    }
    return best;
}

/* Labels by halves of space, down to the size of leaves. order holds the vertices of a node side by
 * side; placed: n of scratch. */
static void sli_dissect_points(sli_dissection *d, const sli_points *points, sli_placed *placed) {
    const sl_int n = d->levels[0].n;
    sl_int *begin = d->begin, *end = d->nodes, node, k;
    d->l = 0;
    sli_dissect_start(d);
    for (k = 0; k < n; k++) {
        d->order[k] = k;
    }
    begin[0] = 0;
    end[0] = n;
    for (node = 0; node < d->tree.count; node++) { /* which grows */
        const sl_int first = begin[node], count = end[node] - first;
        sl_int *vertices = d->order + first;
        int direction;
        d->tree.weight[node] = count;
        if (count <= d->most || d->tree.count >= d->tree.room - 1) {
            for (k = 0; k < count; k++) {
                d->label[vertices[k]] = node;
            }
            continue;
        }
        direction = sli_points_narrow(points, vertices, count, placed);
        for (k = 0; k < count; k++) {
            placed[k].x = sli_point_along(points, vertices[k], direction);
            placed[k].v = vertices[k];
        }
        sli_placed_halve(placed, count);
        for (k = 0; k < count; k++) {
            vertices[k] = placed[k].v;
        }
        sli_tree_split(&d->tree, node);
        begin[d->tree.left[node]] = first;
        end[d->tree.left[node]] = begin[d->tree.right[node]] = first + count / 2;
        end[d->tree.right[node]] = first + count;
    }
    sli_tree_number(&d->tree, n, d->label);
}

/* A cost up to this many times that of a flat square needs no comparison: 0.9 to 1.06 are usual on
 * flat grids, 2 and more on surfaces, where a plane cuts several sheets. */
#define SLI_FLAT_ENOUGH 1.1

/* Parts by coordinates where their estimated cost is that of a flat mesh, or less than that of the
 * parts that the graph alone gives; else the latter. */
static sl_status sli_dissect_geometric(sli_dissection *d, const sli_points *points,
                                       sli_placed *placed) {
    double cost, other, flat;
    sl_status status;
    sli_dissect_points(d, points, placed);
    cost = sli_dissect_cost(d, &flat);
    if (cost <= SLI_FLAT_ENOUGH * flat) {
        d->widening = 0;
        return SL_OK;
    }
    status = sli_dissect_graph(d);
    if (status == SL_OK) {
        other = sli_dissect_cost(d, &flat);
        if (cost < other) {
            sli_dissect_points(d, points, placed);
        }
    }
    return status;
}

#endif
/* end src/impl/order_geometric.h */
/* begin src/impl/order_nest.h */
/* order_nest.h: from labels to an order: parts before the separators round them, leaves by minimum degree */
#ifndef SLI_ORDER_NEST_H
#define SLI_ORDER_NEST_H

/* The tree of separators over all rows: node by node in the order of elimination, none empty. */
typedef struct sli_nest {
    sl_int count; /* 0: the order has no such tree */
    sl_int *of;   /* a row: its node */
    sl_int *
        parent; /* a node: the separator round it, which has a higher number; -1 if there is none */
} sli_nest;

/* Puts the vertices of a separator in the order of what they touch on the left: rows of L that go
 * together in one supernode then lie together in the others, in longer runs. */
static void sli_nest_separator(sli_dissection *d, sl_int node, sl_int *vertices, sl_int count) {
    const sli_level *g = &d->levels[0];
    uint64_t *list = (uint64_t *)(void *)d->next, *scratch = (uint64_t *)(void *)d->part.begin;
    sl_int k;
    sl_off e;
    for (k = 0; k < count; k++) {
        int64_t sum = 0, touched = 0;
        for (e = g->begin[vertices[k]]; e < g->begin[vertices[k] + 1]; e++) {
            const sl_int other = d->label[g->to[e]];
            if (other < node && sli_tree_is_below(&d->tree, node, other)) {
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

/* Appends a dissected graph to an order, perm[at] on; row[v] is the row of its vertex v. */
static void sli_nest_append(sli_dissection *d, const sl_int *row, sl_int *perm, sl_int at,
                            sli_nest *nest) {
    const sli_tree *t = &d->tree;
    sl_int node, k, up, *number = d->nodes;
    sli_dissect_sort(d);
    for (node = sli_tree_first(t); node != -1; node = sli_tree_next(t, node)) {
        const sl_int count = d->begin[node + 1] - d->begin[node];
        sl_int *mine = d->order + d->begin[node];
        if (!sli_tree_is_leaf(t, node)) {
            sli_nest_separator(d, node, mine, count);
        } else if (count > 1) {
            sli_leaf_order(&d->leaf, &d->levels[0], mine, count, d->part.place, d->other);
        }
        number[node] = count > 0 ? nest->count++ : -1;
        for (k = 0; k < count; k++) {
            perm[at++] = row[mine[k]];
            nest->of[row[mine[k]]] = number[node];
        }
    }
    for (node = 0; node < t->count; node++) {
        if (number[node] != -1) {
            for (up = t->parent[node]; up != -1 && number[up] == -1;) {
                up = t->parent[up];
            }
            nest->parent[number[node]] = up == -1 ? -1 : number[up];
        }
    }
}

#endif
/* end src/impl/order_nest.h */
/* begin src/impl/order_metis.h */
/* order_metis.h: what METIS is asked: the order of a connected component, and its nested separators */
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

/* Separators of a graph, nested down to so many parts, a power of two. order: the vertices, parts
 * before the separators round them; sizes: 2 parts - 1, of the parts, then of the separators level
 * by level, the outermost last. */
static sl_status sli_metis_nested(const sli_level *g, sl_int parts, sl_int *order, sl_int *sizes,
                                  const sl_allocator *a) {
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
        size = SLI_TAKE(&b, idx_t, 2 * (size_t)parts);
        weight = SLI_TAKE(&b, idx_t, g->weight != NULL ? g->n : 0);
        status = pass == 0 ? sli_block_alloc(&b, a) : SL_OK;
    }
    if (status != SL_OK) {
        return status;
    }
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
    options[METIS_OPTION_NSEPS] = 2; /* of each separator the better of two tries */
    result = METIS_NodeNDP((idx_t)g->n, xadj, adjncy, g->weight != NULL ? weight : NULL,
                           (idx_t)parts, options, perm, iperm, size);
    if (result == METIS_OK) {
        for (k = 0; k < g->n; k++) {
            order[k] = (sl_int)perm[k];
        }
        for (k = 0; k < 2 * parts - 1; k++) {
            sizes[k] = (sl_int)size[k];
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
/* begin src/impl/order_quality.h */
/* order_quality.h: parts from METIS's vertex separators of the whole graph */
#ifndef SLI_ORDER_QUALITY_H
#define SLI_ORDER_QUALITY_H

#if !defined(SL_NO_METIS)

/* A full tree of so many leaves, level by level: the children of node k are 2 k + 1 and 2 k + 2. */
static void sli_quality_tree(sli_dissection *d, sl_int leaves) {
    sl_int node;
    for (node = 0; node < leaves - 1; node++) {
        sli_tree_split(&d->tree, node);
    }
}

/* The label of a leaf below node next to v, -1 if there is none. */
static sl_int sli_quality_near(const sli_dissection *d, sl_int node, sl_int v) {
    const sli_level *g = &d->levels[0];
    sl_off e;
    for (e = g->begin[v]; e < g->begin[v + 1]; e++) {
        const sl_int other = d->label[g->to[e]];
        if (sli_tree_is_leaf(&d->tree, other) && sli_tree_is_below(&d->tree, node, other)) {
            return other;
        }
    }
    return -1;
}

/* Hands the vertices of a separator to leaves beside it; those of deeper separators are already
 * there. The border between its sides then runs along it. */
static void sli_quality_dissolve(sli_dissection *d, sl_int node, sl_int *vertices, sl_int count) {
    sl_int k, left;
    do {
        left = 0;
        for (k = 0; k < count; k++) {
            const sl_int v = vertices[k], leaf = sli_quality_near(d, node, v);
            if (leaf != -1) {
                d->label[v] = leaf;
            } else {
                vertices[left++] = v;
            }
        }
        if (left == count) { /* what touches nothing may go anywhere */
            for (k = 0; k < count; k++) {
                d->label[vertices[k]] = d->tree.low[node];
            }
            return;
        }
        count = left;
    } while (count > 0);
}

/* Labels by METIS. */
static sl_status sli_dissect_metis(sli_dissection *d) {
    const sli_level *g = &d->levels[0];
    sl_int leaves = 1, v, node, k, at = 0, *sizes = d->begin, *size = d->nodes;
    sl_status status;
    while (d->total / leaves > d->most && leaves < g->n / 8) {
        leaves *= 2;
    }
    d->l = 0;
    status = sli_metis_nested(g, leaves, d->order, sizes, d->a);
    if (status != SL_OK) {
        return status;
    }
    sli_dissect_start(d);
    sli_quality_tree(d, leaves);
    /* METIS lists the sizes of the leaves, then of the separators of each level, the root's last */
    for (k = leaves, v = 0; k > 0; v += k, k /= 2) {
        for (node = 0; node < k; node++) {
            size[k - 1 + node] = sizes[v + node];
        }
    }
    for (node = sli_tree_first(&d->tree); node != -1; node = sli_tree_next(&d->tree, node)) {
        for (k = 0; k < size[node]; k++) {
            d->label[d->order[at++]] = node;
        }
    }
    memset(d->tree.weight, 0, (size_t)d->tree.count * sizeof(sl_int));
    sli_tree_number(&d->tree, g->n, d->label);
    sli_dissect_sort(d);
    for (node = sli_tree_first(&d->tree); node != -1; node = sli_tree_next(&d->tree, node)) {
        if (!sli_tree_is_leaf(&d->tree, node)) {
            sli_quality_dissolve(d, node, d->order + d->begin[node],
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

/* The borders that are left of METIS's separators are ragged, and so count for more than they will
 * cost: our own parts must be estimated at less than this share of theirs. */
#define SLI_QUALITY_OURS 0.8

/* Labels by METIS, or by our own levels where those are estimated to be cheaper, which they are now
 * and then: one of METIS's trees scatters as any other does. */
static sl_status sli_dissect_quality(sli_dissection *d) {
    double ours, flat;
    sl_status status = sli_dissect_graph(d);
    if (status != SL_OK) {
        return status;
    }
    ours = sli_dissect_cost(d, &flat);
    d->widening = 1;
    status = sli_dissect_metis(d);
    if (status == SL_OK && ours < SLI_QUALITY_OURS * sli_dissect_cost(d, &flat)) {
        d->widening = 2;
        status = sli_dissect_graph(d);
    }
    return status;
}

#endif

#endif
/* end src/impl/order_quality.h */
/* begin src/impl/order_own.h */
/* order_own.h: nested dissection of any graph: dense rows last, components one by one */
#ifndef SLI_ORDER_OWN_H
#define SLI_ORDER_OWN_H

/* A row with more neighbours than this many times sqrt(n) joins everything: it goes to the end. */
#define SLI_DENSE_ROW 10.0

/* A leaf that is twice as large as it should be, after its borders have moved, is cut again, and so
 * may its halves. */
#define SLI_REPAIRS 12

typedef struct sli_nesting {
    const sli_graph *G;
    const sl_int *weight; /* NULL: 1 each */
    const double *xyz;    /* NULL: none */
    sl_int dimensions;
    int by_metis;
    sl_int *local;      /* n: a row's number in its component, -1 not yet seen, -2 dense */
    sl_int *row;        /* n: the rows of the component */
    sl_off *begin;      /* n + 1: its graph */
    sl_int *to;         /* the edges of G */
    sl_int *weights;    /* n, where there are weights */
    sli_placed *placed; /* n, where there are coordinates */
    sli_dissection d;
} sli_nesting;

static void sli_nesting_layout(sli_nesting *w, sli_block *b) {
    const sl_int n = w->G->n;
    const sl_off edges = w->G->begin[n];
    w->local = SLI_TAKE(b, sl_int, n);
    w->row = SLI_TAKE(b, sl_int, n);
    w->begin = SLI_TAKE(b, sl_off, (size_t)n + 1);
    w->to = SLI_TAKE(b, sl_int, edges);
    w->weights = SLI_TAKE(b, sl_int, w->weight != NULL ? n : 0);
    w->placed = SLI_TAKE(b, sli_placed, w->xyz != NULL ? n : 0);
    sli_dissection_layout(&w->d, b, n, edges);
}

/* Rows reached from root, in breadth-first order, which is also what the component is numbered by:
 * neighbours then lie close in memory, however the caller numbers them. */
static sl_int sli_nesting_component(sli_nesting *w, sl_int root) {
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

static void sli_nesting_graph(sli_nesting *w, sl_int count) {
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

/* Labels of the component whose graph is there, by the cheaper of two trees where there are two. The
 * cruder the borders, the wider the bands in which they are refined. */
static sl_status sli_nesting_label(sli_nesting *w) {
    sli_dissection *d = &w->d;
    d->widening = 2;
    if (w->by_metis) {
#if !defined(SL_NO_METIS)
        return sli_dissect_quality(d);
#else
        return SL_ERR_UNSUPPORTED;
#endif
    }
    if (w->xyz != NULL) {
        sli_points points;
        points.xyz = w->xyz;
        points.dimensions = w->dimensions;
        points.row = w->row;
        return sli_dissect_geometric(d, &points, w->placed);
    }
    return sli_dissect_graph(d);
}

/* Labels and separators of that component. */
static sl_status sli_nesting_dissect(sli_nesting *w) {
    sli_dissection *d = &w->d;
    int rounds = SLI_REPAIRS;
    sl_status status;
    d->l = 0;
    if (d->levels[0].n <= d->most) {
        sli_dissect_start(d);
        return SL_OK;
    }
    status = sli_nesting_label(w);
    if (status == SL_OK) {
        do {
            sli_dissect_cut(d);
        } while (rounds-- > 0 && sli_dissect_split(d, 2 * d->most) > 0);
        status = d->borders.failed ? SL_ERR_MEMORY : SL_OK;
    }
    return status;
}

/* Marks dense rows and appends them to the order, from the end; how many there are. */
static sl_int sli_nesting_dense(sli_nesting *w, sl_int *perm) {
    const sli_graph *G = w->G;
    const double most = SLI_DENSE_ROW * sqrt((double)G->n);
    sl_int v, count = 0;
    for (v = G->n - 1; v >= 0; v--) {
        w->local[v] = -1;
        if ((double)(G->begin[v + 1] - G->begin[v]) > most) {
            w->local[v] = -2;
            perm[G->n - ++count] = v;
        }
    }
    return count;
}

static sl_status sli_nesting_run(sli_nesting *w, sl_int *perm, sli_nest *nest) {
    const sl_int n = w->G->n, dense = sli_nesting_dense(w, perm);
    sl_int v, k, at = 0;
    sl_status status = SL_OK;
    nest->count = 0;
    for (v = 0; v < n; v++) {
        w->d.part.place[v] = -1;
    }
    for (v = 0; v < n && status == SL_OK; v++) {
        if (w->local[v] == -1) {
            const sl_int count = sli_nesting_component(w, v);
            if (count == 1) { /* nothing to do, and there may be very many */
                perm[at++] = v;
                nest->of[v] = nest->count;
                nest->parent[nest->count++] = -1;
                continue;
            }
            sli_nesting_graph(w, count);
            status = sli_nesting_dissect(w);
            if (status == SL_OK) {
                sli_nest_append(&w->d, w->row, perm, at, nest);
                at += count;
            }
        }
    }
    if (dense > 0 && status == SL_OK) {
        for (k = 0; k < nest->count; k++) {
            nest->parent[k] = nest->parent[k] == -1 ? nest->count : nest->parent[k];
        }
        for (k = n - dense; k < n; k++) {
            nest->of[perm[k]] = nest->count;
        }
        nest->parent[nest->count++] = -1;
    }
    return status;
}

/* The order of a graph without repeated edges, and its tree. weight: what its vertices count for in
 * the balance; NULL: one each. */
static sl_status sli_order_own(const sli_graph *G, const sl_int *weight, int by_metis,
                               const double *xyz, sl_int dimensions, sl_int *perm, sli_nest *nest,
                               const sl_allocator *a) {
    sli_nesting w;
    sli_block b = {NULL, 0, 0};
    sl_status status = SL_OK;
    int pass;
    memset(&w, 0, sizeof w);
    w.G = G;
    w.weight = weight;
    w.xyz = xyz;
    w.dimensions = dimensions;
    w.by_metis = by_metis;
    w.d.most = by_metis ? SLI_DISSECT_LEAF_QUALITY : SLI_DISSECT_LEAF;
    w.d.a = a;
    w.d.leaf.has_popcnt = sli_cpu_best() != SL_ISA_SCALAR;
    for (pass = 0; pass < 2 && status == SL_OK; pass++) {
        sli_nesting_layout(&w, &b);
        status = pass == 0 ? sli_block_alloc(&b, a) : SL_OK;
    }
    if (status == SL_OK) {
        sli_borders_init(&w.d.borders, a);
        status = sli_nesting_run(&w, perm, nest);
        sli_free(a, w.d.borders.block);
        sli_free(a, b.base);
    }
    return status;
}

#endif
/* end src/impl/order_own.h */
/* begin src/impl/order_compress.h */
/* order_compress.h: rows with the same neighbours ordered as one: unknowns of one vertex, cliques */
#ifndef SLI_ORDER_COMPRESS_H
#define SLI_ORDER_COMPRESS_H

/* Fewer rows than this share of them must be left for a graph of their own to be worth making. */
#define SLI_COMPRESS_WORTH 0.8

typedef struct sli_compressed {
    sli_graph G;
    sl_int *weight; /* G.n: rows in each vertex */
    sl_int *first;  /* n: the first row with the neighbours of this one, and their edge */
    sl_int *number; /* n: a first row's vertex in G */
    sl_int *perm;   /* G.n */
} sli_compressed;

/* Whether u and v, which are neighbours, have the same neighbours otherwise. */
static int sli_compress_are_twins(const sli_graph *G, sl_int u, sl_int v) {
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

/* first of every row of a graph with sorted lists; how many different ones there are. key: n of
 * scratch. */
static sl_int sli_compress_find(const sli_graph *G, sl_int *first, uint32_t *key) {
    sl_int v, count = 0;
    sl_off e;
    for (v = 0; v < G->n; v++) {
        key[v] = sli_scatter((uint32_t)v);
        for (e = G->begin[v]; e < G->begin[v + 1]; e++) {
            key[v] += sli_scatter((uint32_t)G->to[e]);
        }
    }
    for (v = 0; v < G->n; v++) {
        first[v] = v;
        for (e = G->begin[v]; e < G->begin[v + 1] && G->to[e] < v; e++) {
            const sl_int u = G->to[e];
            if (key[u] == key[v] && first[u] == u && sli_compress_are_twins(G, u, v)) {
                first[v] = u;
                break;
            }
        }
        count += first[v] == v;
    }
    return count;
}

/* The graph of the first rows: a row that has others as neighbours has their first one too. */
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

/* From vertices back to rows. start: G.n + 1 of scratch. */
static void sli_compress_expand(const sli_compressed *c, sl_int rows, sl_int *perm, sli_nest *nest,
                                sl_int *start) {
    sl_int k, v, at = 0;
    for (k = 0; k < c->G.n; k++) {
        start[c->perm[k]] = at;
        at += c->weight[c->perm[k]];
    }
    for (v = 0; v < rows; v++) {
        perm[start[c->number[c->first[v]]]++] = v;
    }
    for (v = rows - 1; v >= 0; v--) { /* a vertex's number is no larger than its rows' */
        nest->of[v] = nest->of[c->number[c->first[v]]];
    }
}

/* The order of a graph whose rows may come in groups of twins. scratch: n. */
static sl_status sli_order_compressed(const sli_graph *G, int by_metis, sl_int *perm,
                                      sl_int *scratch, sli_nest *nest, const sl_allocator *a) {
    sli_compressed c;
    sli_block b = {NULL, 0, 0};
    sl_status status = SL_OK;
    int pass;
    memset(&c, 0, sizeof c);
    c.G.n = sli_compress_find(G, scratch, (uint32_t *)(void *)perm);
    if ((double)c.G.n > SLI_COMPRESS_WORTH * (double)G->n) {
        return sli_order_own(G, NULL, by_metis, NULL, 0, perm, nest, a);
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
    status = sli_order_own(&c.G, c.weight, by_metis, NULL, 0, c.perm, nest, a);
    if (status == SL_OK) {
        sli_compress_expand(&c, G->n, perm, nest, (sl_int *)(void *)c.G.begin);
    }
    sli_free(a, b.base);
    return status;
}

#endif
/* end src/impl/order_compress.h */
/* begin src/impl/order.h */
/* order.h: the fill-reducing order of the rows: natural, given, or nested dissection */
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

#endif

/* Puts the lists of an unsorted graph in order and takes repeated edges out, so that a matrix has one
 * order however it is stored. */
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
        sli_graph_unite(G);
        sli_free(a, b.base);
    }
    return status;
}

/* An order of blocks of rows to one of rows; the same for the tree. */
static void sli_order_expand(sl_int blocks, sl_int block, sl_int *perm, sli_nest *nest) {
    sl_int k, c;
    for (k = blocks - 1; k >= 0; k--) {
        const sl_int v = perm[k], node = nest->count > 0 ? nest->of[k] : 0;
        for (c = block - 1; c >= 0; c--) {
            perm[k * block + c] = v * block + c;
            nest->of[k * block + c] = node;
        }
    }
}

/* By the graph of A, whose rows come in blocks. */
static sl_status sli_order_by_graph(const sl_csc *A, sl_triangle triangle, sl_ordering ordering,
                                    const sl_options *opt, sl_int *perm, sl_int *scratch,
                                    sli_nest *nest, const sl_allocator *a) {
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
    if (status == SL_OK && ordering != SL_ORDERING_METIS) {
        const int by_metis = ordering == SL_ORDERING_QUALITY;
        if (opt != NULL && opt->coordinates != NULL && !by_metis) {
            status = sli_order_own(&G, NULL, 0, opt->coordinates, opt->dimensions, perm, nest, a);
        } else {
            status = sli_order_compressed(&G, by_metis, perm, scratch, nest, a);
        }
    }
#if !defined(SL_NO_METIS)
    if (status == SL_OK && ordering == SL_ORDERING_METIS) {
        status = sli_order_graph(&G, opt != NULL ? opt->metis_options : NULL, perm, scratch, a);
    }
#endif
    if (status == SL_OK && block > 1) {
        sli_order_expand(G.n, block, perm, nest);
    }
    sli_free(a, b.base);
    return status;
}

/* Whether blocks and points are what n rows can have; *bad: the row of a point that is not finite,
 * -1 otherwise. */
static int sli_order_wishes_are_sound(const sl_options *opt, sl_int n, sl_int *bad) {
    sl_int v, k;
    *bad = -1;
    if (opt == NULL) {
        return 1;
    }
    if (opt->block_size < 0 || (opt->block_size > 1 && n % opt->block_size != 0) ||
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

/* perm: n, the order of a checked symmetric pattern; nest: its tree, n each, where it has one.
 * scratch: n. */
static sl_status sli_order(const sl_csc *A, sl_triangle triangle, const sl_options *opt,
                           sl_int *perm, sl_int *scratch, sli_nest *nest, const sl_allocator *a,
                           sl_stats *stats) {
    const sl_ordering wished = opt != NULL ? opt->ordering : SL_ORDERING_DEFAULT;
    const sl_ordering ordering = wished == SL_ORDERING_DEFAULT ? SL_ORDERING_FAST : wished;
    sl_int bad;
    nest->count = 0;
    if (!sli_order_wishes_are_sound(opt, A->n_cols, &bad)) {
        return bad == -1 ? SL_ERR_ARGUMENT : sli_fail_at(stats, SL_ERR_NOT_FINITE, bad, -1, 0.0);
    }
    switch (ordering) {
    case SL_ORDERING_GIVEN:
        return sli_order_given(opt->perm, A->n_cols, perm, scratch, stats);
    case SL_ORDERING_NATURAL:
        sli_order_natural(A->n_cols, perm);
        return SL_OK;
    case SL_ORDERING_FAST:
    case SL_ORDERING_BUILTIN:
        return sli_order_by_graph(A, triangle, ordering, opt, perm, scratch, nest, a);
    case SL_ORDERING_METIS:
    case SL_ORDERING_QUALITY:
#if defined(SL_NO_METIS)
        return SL_ERR_UNSUPPORTED;
#else
        return ordering == SL_ORDERING_METIS && !sli_metis_options_are_sound(opt->metis_options)
                   ? SL_ERR_ARGUMENT
                   : sli_order_by_graph(A, triangle, ordering, opt, perm, scratch, nest, a);
#endif
    default:
        return SL_ERR_ARGUMENT;
    }
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

/* What the planning needs only while it runs. */
typedef struct sli_planning {
    double *flops;   /* n_supers: of the subtree */
    double *load;    /* workers */
    sl_int *side;    /* n_supers: the stack of a supernode, 2 more in a task */
    uint64_t *order; /* n_supers: tasks, the largest last */
    uint64_t *scratch;
} sli_planning;

/* Tasks this much smaller than a worker's share even out what no estimate knows. */
#define SLI_TASKS_A_WORKER 8

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
static void sli_find_tasks(sli_schedule *p, const sl_symbolic *S, sli_planning *w, double limit) {
    const double scale = limit > 0.0 ? 1e9 / limit : 0.0;
    sl_int s;
    p->n_tasks = p->n_tops = 0;
    for (s = 0; s < S->n_supers; s++) {
        const sl_int up = S->super_parent[s];
        if (w->flops[s] > limit) {
            p->top[p->n_tops++] = s;
        } else if (up == -1 || w->flops[up] > limit) {
            w->order[p->n_tasks++] = sli_keyed((sl_int)(w->flops[s] * scale), s);
        }
    }
    sli_sort(w->order, p->n_tasks, w->scratch);
}

/* The largest tasks first, each to the worker who has least. */
static void sli_share_tasks(sli_schedule *p, const sl_symbolic *S, sli_planning *w) {
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
        p->first[m] = S->descendant[root];
        p->last[m] = root;
        p->worker[m] = least;
    }
}

/* Plans for p->workers. The arrays of p and w have room. */
static void sli_schedule_fill(sli_schedule *p, const sl_symbolic *S, sli_planning *w) {
    double total = 0.0;
    sl_int s, m;
    for (s = 0; s < S->n_supers; s++) {
        w->flops[s] = 0.0;
    }
    for (s = 0; s < S->n_supers; s++) {
        w->flops[s] += sli_front_flops(&S->steps[s]);
        if (S->super_parent[s] != -1) {
            w->flops[S->super_parent[s]] += w->flops[s];
        } else {
            total += w->flops[s];
        }
    }
    if (p->workers == 1 && S->n_supers > 0) {
        p->n_tops = 0;
        p->n_tasks = 1;
        p->first[0] = p->worker[0] = 0;
        p->last[0] = S->n_supers - 1;
    } else {
        sli_find_tasks(p, S, w, total / ((double)p->workers * SLI_TASKS_A_WORKER));
        sli_share_tasks(p, S, w);
    }
    for (s = S->n_supers - 1; s >= 0; s--) {
        w->side[s] = S->super_parent[s] == -1 ? 2 : 3 - (w->side[S->super_parent[s]] & 1);
    }
    for (m = 0; m < p->n_tops; m++) {
        w->side[p->top[m]] &= 1;
    }
    sli_plan_waiting(p, S, w->side);
}

static void sli_schedule_layout(sli_schedule *p, sli_block *b, const sl_symbolic *S) {
    const size_t supers = (size_t)S->n_supers, tasks = p->workers == 1 ? 1 : supers;
    p->first = SLI_TAKE(b, sl_int, tasks);
    p->last = SLI_TAKE(b, sl_int, tasks);
    p->worker = SLI_TAKE(b, sl_int, tasks);
    p->top = SLI_TAKE(b, sl_int, p->workers == 1 ? 0 : supers);
    p->waiting_begin = SLI_TAKE(b, sl_off, supers);
}

static void sli_planning_layout(sli_planning *w, sli_block *b, sl_int supers, sl_int workers) {
    w->flops = SLI_TAKE(b, double, supers);
    w->load = SLI_TAKE(b, double, workers);
    w->side = SLI_TAKE(b, sl_int, supers);
    w->order = SLI_TAKE(b, uint64_t, supers);
    w->scratch = SLI_TAKE(b, uint64_t, supers);
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
    sli_nest nest;                      /* n each: the tree of separators, by rows of A */
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
    w->nest.of = SLI_TAKE(b, sl_int, n);
    w->nest.parent = SLI_TAKE(b, sl_int, n + 1);
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
    S->part_of = SLI_TAKE(b, sl_int, S->n_parts > 0 ? n : 0);
    S->part_parent = SLI_TAKE(b, sl_int, S->n_parts);
    S->part_level = SLI_TAKE(b, sl_int, S->n_parts);
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

/* The tree of separators, whose nodes stand below their parents, by columns of L. */
static void sli_fill_parts(sl_symbolic *S, const sli_nest *nest) {
    sl_int k;
    for (k = 0; k < S->n && S->n_parts > 0; k++) {
        S->part_of[k] = nest->of[S->perm[k]];
    }
    for (k = S->n_parts - 1; k >= 0; k--) {
        S->part_parent[k] = nest->parent[k];
        S->part_level[k] = nest->parent[k] == -1 ? 0 : S->part_level[nest->parent[k]] + 1;
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
    sli_fill_parts(S, &w->nest);
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
    status = sli_order(A, stats->triangle, opt, w->perm, w->scratch, &w->nest, a, stats);
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
    draft.n_parts = w->nest.count;
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
        v.n_parts = S->n_parts;
        v.part_of = S->n_parts > 0 ? S->part_of : NULL;
        v.part_parent = S->n_parts > 0 ? S->part_parent : NULL;
        v.part_level = S->n_parts > 0 ? S->part_level : NULL;
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

/* Adds what column k brings to a reach: the supernodes of its path up to where it meets the path of
 * the nearest column of the reach before it or behind it; -1 for none. Exact are supernodes, rows,
 * height and width; columns are those of whole supernodes, and entries leave out that k may enter
 * what it shares at an earlier tile. O(supernodes added). */
static void sli_reach_add(const sl_symbolic *S, sl_int k, sl_int before, sl_int behind,
                          sli_reach *R) {
    const sl_int low = before < 0 ? -1 : S->super_of[before];
    const sl_int high = behind < 0 ? S->n_supers : S->super_of[behind];
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

/* Counts the supernodes and rows of the reach of seeds, columns of L, ascending. O(reach). */
static void sli_reach_measure(const sl_symbolic *S, const uint64_t *seeds, sl_int count,
                              sli_reach *R) {
    sl_int k;
    memset(R, 0, sizeof *R);
    for (k = 0; k < count; k++) {
        sli_reach_add(S, sli_key(seeds[k]), k > 0 ? sli_key(seeds[k - 1]) : -1, -1, R);
    }
}

/* Adds supernode s, which a seed or children on the waiting list enter. The list is threaded
 * through `up` of the steps whose parent has not come yet; its top waits for the smallest
 * supernode. */
static void sli_reach_enter(const sl_symbolic *S, sli_step *steps, sl_int at, sl_int s, sl_int seed,
                            sl_int *waiting) {
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
    if (S->super_parent[s] != -1) {
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

/* Rows of a step to places in the vector: the rows ascend, and so do the ancestors that own them.
 * The owner of the next row is mostly a few ancestors up; where it is not, climbing on would make a
 * tree of one long branch quadratic, so that it is looked up among all `count` steps. */
static void sli_reach_places(const sl_symbolic *S, const sli_step *steps, sl_int count, sl_int at,
                             sl_int *places) {
    const sl_int *rows = S->rows + S->rows_begin[S->super_of[steps[at].column]];
    const sl_int below = steps[at].below;
    sl_int i = 0;
    while (i < below) {
        sl_int end, shift, climbed = 0;
        do {
            at = climbed++ < SLI_CLIMB ? steps[at].up
                                       : sli_reach_find(steps, at + 1, count - 1, rows[i]);
            end = steps[at].column + sli_step_columns(&steps[at]);
        } while (rows[i] >= end);
        shift = steps[at].base - steps[at].column;
        for (; i < below && rows[i] < end; i++) {
            places[i] = rows[i] + shift;
        }
    }
}

/* Compiles the reach of seeds; sli_reach_measure tells the room it takes. O(reach), times a
 * logarithm where rows skip many ancestors. */
static void sli_reach_fill(const sl_symbolic *S, const uint64_t *seeds, sl_int count,
                           sli_step *steps, sl_int *rows, sli_reach *R) {
    sl_int k = 0, at = 0, waiting = -1, s, next;
    memset(R, 0, sizeof *R);
    while (k < count) {
        sl_int seed = sli_key(seeds[k]);
        s = S->super_of[seed];
        next = sli_next_seed(S, seeds, count, &k);
        for (; s != -1 && s < next; s = S->super_parent[s]) {
            sli_reach_enter(S, steps, at++, s, seed, &waiting);
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
        sli_reach_places(S, steps, R->count, at, rows + R->n_rows);
        R->n_rows += steps[at].below;
    }
    R->steps = steps;
    R->rows = rows;
}

/* The place of a column in the reach's vector. *at, 0 at first, remembers the step for the next
 * column, which is not smaller. */
SLI_INLINE sl_int sli_reach_place(const sli_reach *R, sl_int *at, sl_int column) {
    while (column >= R->steps[*at].column + sli_step_columns(&R->steps[*at])) {
        ++*at;
    }
    return column - R->steps[*at].column + R->steps[*at].base;
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

/* The first thing that went wrong in a factorization. */
typedef struct sli_failure {
    sl_status status;
    sl_int super;    /* the supernode it happened in */
    sl_int pivot;    /* the pivot that is null or not finite, or -1 */
    sl_int position; /* the entry of A that is not finite, or -1 */
    double value;
} sli_failure;

struct sl_factor {
    sl_allocator allocator;
    sl_stats stats;       /* the factor group and the error fields */
    const sl_symbolic *S; /* borrowed */
    const sli_kernels *kernels;
    double null_tolerance;
    sl_definiteness definiteness;
    sl_method method;
    int is_good;    /* L and D hold a factor */
    double *L;      /* the panels */
    double *D;      /* n pivots */
    double *buffer; /* kernel scratch, for each worker */
    /* multifrontal; what a worker needs stands once for each */
    sl_threads threads;
    sli_schedule schedule;
    double *waiting;       /* schedule.waiting: update matrices on their way to the parents */
    double *magnitude;     /* rows of the tallest front: what its diagonal was made of */
    double *inverse;       /* SLI_FRONT_INVERSE */
    sli_failure *failures; /* one */
    /* left-looking */
    sl_int *local;  /* n: local rows in the supernode at hand */
    sl_int *places; /* rows of the tallest front: those of a descendant in it */
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
                              sl_int position, double value) {
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

/* Adds A's entries to supernode s's panel. */
static sl_status sli_panel_add(const sl_factor *F, const sl_csc *A, sl_int s,
                               sli_failure *failure) {
    const sl_symbolic *S = F->S;
    sl_off m;
    for (m = S->map_begin[s]; m < S->map_begin[s + 1]; m++) {
        const double a = A->x[S->map_from[m]];
        if (!sli_is_finite(a)) {
            return sli_fail(failure, SL_ERR_NOT_FINITE, s, -1, S->map_from[m], a);
        }
        F->L[S->map_to[m]] += a;
    }
    return SL_OK;
}

/* Refuses a pivot that is not a number or null against what it was made of. */
SLI_INLINE sl_status sli_check_pivot(const sl_factor *F, sl_int k, double pivot, double magnitude,
                                     sli_failure *failure) {
    if (!sli_is_finite(pivot)) {
        return sli_fail(failure, SL_ERR_NOT_FINITE, F->S->super_of[k], k, -1, pivot);
    }
    if (sli_is_null(pivot, magnitude, F->null_tolerance)) {
        return sli_fail(failure, SL_ERR_PIVOT, F->S->super_of[k], k, -1, pivot);
    }
    return SL_OK;
}

/* Was pivot k null and skipped? */
SLI_INLINE int sli_is_skipped(const sl_factor *F, sl_int k) {
    return F->definiteness == SL_SEMIDEFINITE && F->D[k] == SLI_NULL_PIVOT;
}

/* Counts and bounds of the first pivots. */
static void sli_count_pivots(sl_factor *F, sl_int count) {
    sl_stats *stats = &F->stats;
    sl_int k;
    stats->positive = stats->negative = stats->null = 0;
    stats->pivot_min = stats->pivot_max = 0.0;
    for (k = 0; k < count; k++) {
        const double size = fabs(F->D[k]);
        if (sli_is_skipped(F, k)) {
            stats->null++;
            continue;
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

/* The whole factorization. A fits the analysis. [LDL05], [Davis06] 4.7 */
static sl_status sli_uplooking(sl_factor *F, const sl_csc *A, sli_failure *failure) {
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
            status = sli_panel_add(F, A, s, failure);
            if (status != SL_OK) {
                break;
            }
        }
        diagonal = panel + sli_panel_at(S->steps[s].width, q, q);
        pivot = *diagonal;
        magnitude = fabs(pivot);
        *diagonal = 0.0;
        sli_do_all_rows(F, k, &pivot, &magnitude);
        F->D[k] = pivot;
        if (F->definiteness == SL_SEMIDEFINITE &&
            sli_is_null(pivot, magnitude, F->null_tolerance)) {
            F->D[k] = SLI_NULL_PIVOT;
        } else {
            status = sli_check_pivot(F, k, pivot, magnitude, failure);
        }
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
    const sl_csc *A;
    sl_int super, group; /* the front, and its group of column tiles */
    sli_front front;
} sli_job;

/* A front of this many flops takes some 50 us, and is shared out at 1 or 2 us a step by OpenMP, at more by others. */
#define SLI_SHARED_FLOPS 4e6

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
    f.null_tolerance = F->null_tolerance;
    f.skips_null = F->definiteness == SL_SEMIDEFINITE;
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

/* A's entries onto the cleared panel, and what its diagonal is made of so far. */
static sl_status sli_front_load(sl_factor *F, const sl_csc *A, const sli_front *f, sl_int s,
                                sli_failure *failure) {
    const sl_status status = sli_panel_add(F, A, s, failure);
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

/* A null pivot that was not skipped is a failure. */
static sl_status sli_front_check(const sl_factor *F, const sli_front *f, sl_int s,
                                 sli_failure *failure) {
    const sl_int first = F->S->steps[s].column;
    sl_status status = SL_OK;
    sl_int k;
    for (k = 0; k < f->width && status == SL_OK; k++) {
        if (!sli_is_skipped(F, first + k)) {
            status = sli_check_pivot(F, first + k, f->D[k], f->magnitude[k], failure);
        }
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
static sl_status sli_front_alone(sl_factor *F, const sl_csc *A, sl_int s, sl_int worker,
                                 sli_failure *failure) {
    const sli_front f = sli_front_of(F, s, worker);
    const sl_int tiles = sli_front_tiles(&f);
    double *scratch = F->buffer + (ptrdiff_t)worker * sli_front_scratch(F->S->widest);
    sl_status status;
    sli_front_clear(&f, 0, tiles);
    status = sli_front_load(F, A, &f, s, failure);
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
            status = sli_front_alone(job->F, job->A, s, k, &failure);
            if (status != SL_OK) {
                sli_keep_first_failure(&job->F->failures[k], &failure);
            }
        }
    }
}

/* Row tiles of worker k: of first .. last-1 in equal parts, or, where the rows grow longer as in a
 * triangle, in parts of equal area. */
static sl_int sli_part(sl_int first, sl_int last, sl_int k, sl_int workers, int is_triangle) {
    const double share = (double)k / workers;
    return first + (sl_int)((last - first) * (is_triangle ? sqrt(share) : share));
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
    status = sli_front_load(F, job->A, &job->front, job->super, failure);
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

/* The whole factorization. A fits the analysis. [DR83], [Liu92] */
static sl_status sli_multifrontal(sl_factor *F, const sl_csc *A, sli_failure *failure) {
    const sli_schedule *plan = &F->schedule;
    sli_job job;
    sl_int m, k;
    memset(&job, 0, sizeof job);
    job.F = F;
    job.A = A;
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
            (void)sli_front_alone(F, A, job.super, 0, &here);
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

/* What descendant d takes from supernode s: its rows from number `first` on are rows of s, the ones
 * before `last` are columns of s. */
static void sli_pull(sl_factor *F, const sli_front *f, sl_int d, sl_int first, sl_int last) {
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
        F->places[r - first] = F->local[rows[r]];
    }
    F->kernels->assemble(f, from.update, (w + first) % SLI_TILE, F->places, last - first, 0,
                         from.below - first);
    for (r = first; r < last; r++) { /* |l d l| of the pivots to come */
        const double *l = from.panel + sli_panel_at(w, w + r, 0);
        for (j = 0; j < w; j++) {
            f->magnitude[F->places[r - first]] +=
                fabs(l[SLI_TILE * (ptrdiff_t)j] * l[SLI_TILE * (ptrdiff_t)j] * from.D[j]);
        }
    }
}

/* Supernode s from A and its descendants, parents before children: those that have no row among the
 * columns of s have no descendant with one. */
static sl_status sli_left_looking(sl_factor *F, const sl_csc *A, sl_int s, sli_failure *failure) {
    const sl_symbolic *S = F->S;
    sli_front f = sli_front_of(F, s, 0);
    const sl_int *rows = S->rows + S->rows_begin[s];
    const sl_int start = S->super_first[s], end = S->super_first[s + 1];
    sl_int k, d;
    sl_status status;
    for (k = 0; k < f.width; k++) {
        F->local[start + k] = k;
    }
    for (k = 0; k < f.below; k++) {
        F->local[rows[k]] = f.width + k;
    }
    memset(f.panel, 0, (size_t)sli_panel_size(f.width, f.below) * sizeof(double));
    status = sli_front_load(F, A, &f, s, failure);
    if (status != SL_OK) {
        return status;
    }
    for (d = s - 1; d >= S->descendant[s];) {
        const sl_int *of = S->rows + S->rows_begin[d], below = S->steps[d].below;
        const sl_int first = sli_lower_bound(of, below, start);
        const sl_int last = first + sli_lower_bound(of + first, below - first, end);
        if (first < last) {
            sli_pull(F, &f, d, first, last);
            d--;
        } else {
            d = S->descendant[d] - 1;
        }
    }
    sli_front_eliminate(F->kernels, &f, F->buffer);
    return sli_front_check(F, &f, s, failure);
}

/* Every supernode on the way from the seeds, columns of L in ascending order, to the roots. */
static sl_status sli_left_looking_all(sl_factor *F, const sl_csc *A, const uint64_t *seeds,
                                      sl_int count, sli_failure *failure) {
    const sl_symbolic *S = F->S;
    sl_status status = SL_OK;
    sl_int k = 0, s, next;
    while (k < count && status == SL_OK) {
        s = S->super_of[sli_key(seeds[k])];
        next = sli_next_seed(S, seeds, count, &k);
        for (; s != -1 && s < next && status == SL_OK; s = S->super_parent[s]) {
            status = sli_left_looking(F, A, s, failure);
        }
    }
    return status;
}

#endif
/* end src/impl/leftlooking.h */
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
    if (F->method == SL_METHOD_SUPERNODAL) {
        const uint64_t rows = SLI_TILE * (uint64_t)sli_tiles(S->tallest);
        F->buffer = SLI_TAKE(b, double, workers *(uint64_t)sli_front_scratch(S->widest));
        F->magnitude = SLI_TAKE(b, double, workers *rows);
        F->inverse = SLI_TAKE(b, double, workers *SLI_FRONT_INVERSE);
        F->failures = SLI_TAKE(b, sli_failure, workers);
        F->local = SLI_TAKE(b, sl_int, n);
        F->places = SLI_TAKE(b, sl_int, S->tallest);
        sli_schedule_layout(&F->schedule, b, S);
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
}

/* Pivots in numbers, and a failure in the caller's rows. */
static void sli_factor_tell(sl_factor *F, const sl_csc *A, const sli_failure *f) {
    sl_int good = F->S->n; /* pivots before the failure */
    if (f->status != SL_OK && f->pivot >= 0) {
        good = f->pivot;
        sli_fail_at(&F->stats, f->status, F->S->perm[f->pivot], -1, f->value);
    } else if (f->status != SL_OK) {
        good = F->S->super_first[f->super];
        sli_fail_at(&F->stats, f->status, A->i[f->position], sli_column_of(A, f->position),
                    f->value);
    }
    sli_count_pivots(F, good);
    F->stats.null += f->status == SL_ERR_PIVOT;
}

/* What a factorization came to, for the caller and for F itself. */
static sl_status sli_factor_done(sl_factor *F, const sl_csc *A, const sli_failure *failure,
                                 double started, sl_stats *stats) {
    sli_stats_clear_error(&F->stats);
    sli_factor_tell(F, A, failure);
    F->stats.seconds_factor = sli_seconds() - started;
    F->is_good = failure->status == SL_OK;
    if (stats != NULL) {
        sli_factor_stats_copy(&F->stats, stats);
        stats->error_row = F->stats.error_row;
        stats->error_column = F->stats.error_column;
        stats->error_value = F->stats.error_value;
    }
    return failure->status;
}

SL_API sl_status sl_factor_refactor(sl_factor *F, const sl_csc *A, sl_stats *stats) {
    const double started = sli_seconds();
    sli_failure failure;
    sl_status status;
    sli_stats_clear_error(stats);
    if (F == NULL) {
        return SL_ERR_ARGUMENT;
    }
    F->is_good = 0;
    status = sli_factor_check(F->S, A);
    if (status != SL_OK) {
        return status;
    }
    memset(&failure, 0, sizeof failure);
    (void)(F->method == SL_METHOD_SUPERNODAL ? sli_multifrontal(F, A, &failure)
                                             : sli_uplooking(F, A, &failure));
    return sli_factor_done(F, A, &failure, started, stats);
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
        status = pass == 0 ? sli_block_alloc(&b, &F->allocator) : SL_OK;
    }
    if (status != SL_OK) {
        return status;
    }
    memset(&failure, 0, sizeof failure);
    F->is_good = 0;
    count = sli_changed_seeds(F->S, A, columns, count, seeds, scratch);
    (void)sli_left_looking_all(F, A, seeds, count, &failure);
    sli_free(&F->allocator, b.base);
    return sli_factor_done(F, A, &failure, started, stats);
}

/* The last pivot of a singular Laplacian is what rounding left of it: over meshes, grids and paths
 * of 1e2 to 1e6 rows it came to less than 60 + n/16 units of rounding, while no pivot of a regular
 * one fell below 1e9. */
static double sli_null_tolerance(sl_int n) {
    return (64.0 + n / 8) * DBL_EPSILON;
}

/* Are the method, the definiteness and the number of threads such as exist? */
static int sli_way_is_known(const sl_options *opt) {
    return opt == NULL ||
           ((unsigned)opt->method <= (unsigned)SL_METHOD_SUPERNODAL &&
            (unsigned)opt->definiteness <= (unsigned)SL_SEMIDEFINITE && opt->threads.count >= 0);
}

/* A front costs some 50 ns whatever is in it: below this many flops each, as in diagonal matrices and
 * stars, rows are faster by up to 3.5 times; above it fronts are, by 1.1 to 6 times. */
static sl_method sli_method(const sl_symbolic *S, const sl_options *opt) {
    if (opt != NULL && opt->method != SL_METHOD_AUTO) {
        return opt->method;
    }
    return S->stats.flops < 8.0 * S->n_supers ? SL_METHOD_UP_LOOKING : SL_METHOD_SUPERNODAL;
}

SL_API sl_status sl_factor_create(sl_factor **out, const sl_symbolic *S, const sl_csc *A,
                                  const sl_options *opt, sl_stats *stats) {
    const double started = sli_seconds();
    const sl_allocator a = sli_allocator(opt);
    sl_factor draft;
    sli_block b = {NULL, 0, 0};
    sl_status status;
    int pass;
    sli_stats_clear_error(stats);
    if (out == NULL) {
        return SL_ERR_ARGUMENT;
    }
    *out = NULL;
    if (S == NULL || (opt != NULL && opt->null_tolerance != opt->null_tolerance) ||
        !sli_allocator_is_whole(opt) || !sli_way_is_known(opt)) {
        return SL_ERR_ARGUMENT;
    }
    status = sli_factor_check(S, A);
    if (status != SL_OK) {
        return status;
    }
    memset(&draft, 0, sizeof draft);
    draft.allocator = a;
    draft.S = S;
    draft.null_tolerance =
        opt == NULL || opt->null_tolerance == 0.0 ? sli_null_tolerance(S->n) : opt->null_tolerance;
    draft.definiteness = opt == NULL ? SL_DEFINITE : opt->definiteness;
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
        F->stats.seconds_setup = sli_seconds() - started;
        if (status == SL_OK) {
            status = sl_factor_refactor(F, A, stats);
        }
        if (status == SL_OK) {
            *out = F;
        } else {
            sl_factor_free(F);
        }
    }
    return status;
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

SL_API sl_status sl_factor_null_rows(const sl_factor *F, sl_int *rows, sl_int most, sl_int *count) {
    sl_int k;
    if (F == NULL || count == NULL || most < 0 || (most > 0 && rows == NULL)) {
        return SL_ERR_ARGUMENT;
    }
    if (!F->is_good) {
        return SL_ERR_STATE;
    }
    *count = 0;
    for (k = 0; k < F->S->n; k++) {
        if (sli_is_skipped(F, k)) {
            if (*count < most) {
                rows[*count] = F->S->perm[k];
            }
            ++*count;
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
    (*out)->allocator = a;
    (*out)->block = NULL;
    (*out)->size = 0;
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
} sli_query;

/* Everything known and everything wanted: the full solve. */
static sli_query sli_query_all(const sl_symbolic *S) {
    sli_query q;
    q.S = S;
    q.nb = q.nx = S->n;
    q.is_shared = 1;
    q.forward = q.backward = sli_reach_all(S);
    q.b_place = q.x_place = S->iperm;
    return q;
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
    double *y, *x, *scratch;
} sli_vectors;

static void sli_vectors_layout(sli_vectors *v, sli_block *b, const sli_query *q, sl_int nrhs) {
    const sl_int lanes = (sl_int)1 << sli_lanes_kind(nrhs);
    const size_t forward = sli_scratch_size(q->forward.tallest, q->forward.widest, lanes);
    const size_t backward = sli_scratch_size(q->backward.tallest, q->backward.widest, lanes);
    v->y = SLI_TAKE(b, double, (uint64_t)q->forward.columns *(uint64_t)lanes);
    v->x =
        q->is_shared ? v->y : SLI_TAKE(b, double, (uint64_t)q->backward.columns *(uint64_t)lanes);
    v->scratch = SLI_TAKE(b, double, forward > backward ? forward : backward);
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

/* A x = b for the rows of a query: y = L^-1 P b, z = D^-1 y, P x = L'^-1 z. W has room; F is good.
 */
static void sli_sweep(const sl_factor *F, const sli_query *q, double *X, sli_dense x_at,
                      const double *B, sli_dense b_at, sl_int nrhs, void *memory) {
    sl_int r;
    for (r = 0; r < nrhs; r += 8) {
        const sl_int block = sli_min(8, nrhs - r);
        const int kind = sli_lanes_kind(block);
        const sl_int lanes = (sl_int)1 << kind;
        sli_block b;
        sli_vectors v;
        b.base = (unsigned char *)memory;
        b.used = 0;
        b.overflow = 0;
        sli_vectors_layout(&v, &b, q, block);
        sli_pack(q, v.y, B + (size_t)r * b_at.column, b_at, lanes, block);
        F->kernels->forward[kind](q->forward.count, q->forward.steps, q->forward.rows, F->L, v.y,
                                  v.scratch);
        if (!q->is_shared) {
            sli_cross(q, v.y, v.x, lanes);
        }
        F->kernels->backward[kind](q->backward.count, q->backward.steps,
                                   q->backward.rows + q->backward.n_rows, F->L, F->D, v.x,
                                   v.scratch);
        sli_unpack(q, X + (size_t)r * x_at.column, x_at, v.x, lanes, block);
    }
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
    own.allocator = F->allocator;
    own.block = NULL;
    own.size = 0;
    W = W == NULL ? &own : W;
    bytes = sli_vectors_bytes(q, nrhs);
    status = bytes == SIZE_MAX ? SL_ERR_TOO_LARGE : sli_work_grow(W, bytes);
    if (status == SL_OK) {
        sli_sweep(F, q, X, x_at, B, b_at, nrhs, W->block);
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
    if (!F->is_good || F->S != q->S) {
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
    uint64_t
        *seeds; /* count: its columns of L ascending, each with its place in the caller's order */
    uint64_t *scratch; /* count */
    sl_int *place;     /* count */
    sli_step *steps;
    sl_int *compact; /* the steps' rows */
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
    }
}

/* Sorts a set by column of L; refuses rows out of range or given twice. Then counts its reach. */
static sl_status sli_set_measure(const sl_symbolic *S, sli_set *set, sli_reach *R,
                                 sl_stats *stats) {
    sl_int k;
    if (set->rows == NULL) {
        *R = sli_reach_all(S);
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
    sli_reach_measure(S, set->seeds, set->count, R);
    return SL_OK;
}

/* Fills the reach and the place of each of the caller's rows in its vector. */
static void sli_set_fill(const sl_symbolic *S, sli_set *set, sli_reach *R, const sl_int **place) {
    sl_int k, at = 0;
    if (set->rows == NULL) {
        *place = S->iperm;
        return;
    }
    sli_reach_fill(S, set->seeds, set->count, set->steps, set->compact, R);
    for (k = 0; k < set->count; k++) {
        set->place[sli_value(set->seeds[k])] = sli_reach_place(R, &at, sli_key(set->seeds[k]));
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
static void sli_query_fill(sli_query *q, const sl_symbolic *S, sli_set *b, sli_set *x) {
    q->S = S;
    q->nb = b->count;
    q->nx = x->count;
    sli_set_fill(S, b, &q->forward, &q->b_place);
    sli_set_fill(S, x, &q->backward, &q->x_place);
    q->is_shared = sli_reach_equal(&q->forward, &q->backward);
}

static void sli_query_stats(const sli_query *q, sl_stats *stats) {
    stats->b_supernodes = q->forward.count;
    stats->b_columns = q->forward.columns;
    stats->b_entries = q->forward.entries;
    stats->x_supernodes = q->backward.count;
    stats->x_columns = q->backward.columns;
    stats->x_entries = q->backward.entries;
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
    sli_set b, x;
    sl_status status;
    int pass;
    sli_stats_clear_error(stats);
    if (out == NULL) {
        return SL_ERR_ARGUMENT;
    }
    *out = NULL;
    status = sli_allocator_is_whole(opt) ? sli_check_sets(S, bset, nb, xset, nx) : SL_ERR_ARGUMENT;
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
    status = status == SL_OK ? sli_set_measure(S, &b, &query.forward, stats) : status;
    status = status == SL_OK ? sli_set_measure(S, &x, &query.backward, stats) : status;
    for (pass = 0; pass < 2 && status == SL_OK; pass++) {
        P = (sl_plan *)sli_take(&kept, 1, sizeof(sl_plan));
        sli_set_layout_reach(&b, &kept, &query.forward);
        sli_set_layout_reach(&x, &kept, &query.backward);
        status = pass == 0 ? sli_block_alloc(&kept, &a) : SL_OK;
    }
    if (status == SL_OK) {
        sli_query_fill(&query, S, &b, &x);
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
        status = sli_set_measure(S, bset, &q.forward, stats);
        status = status == SL_OK ? sli_set_measure(S, xset, &q.backward, stats) : status;
        if (status != SL_OK) {
            return status;
        }
        sli_set_layout_reach(bset, &b, &q.forward);
        sli_set_layout_reach(xset, &b, &q.backward);
        bytes = b.used;
        if (b.overflow || bytes > W->size) {
            if (b.overflow) {
                return SL_ERR_TOO_LARGE;
            }
            continue; /* the reaches would run over the end: nothing is written yet */
        }
        sli_query_fill(&q, S, bset, xset);
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
        sli_sweep(F, &q, X, sli_dense_of(SLI_COLUMN_MAJOR, ldx), B,
                  sli_dense_of(SLI_COLUMN_MAJOR, ldb), nrhs, (unsigned char *)W->block + bytes);
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
    own.allocator = F->allocator;
    own.block = NULL;
    own.size = 0;
    status = sli_local(F, X, ldx, &b, &x, B, ldb, nrhs, W == NULL ? &own : W, stats);
    sli_free(&own.allocator, own.block);
    return status;
}

#endif
/* end src/impl/plan.h */
/* L5 on a factor */
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

SLI_INLINE const double *sli_lanes_cost_of(sl_isa isa) {
    return sli_lanes_cost[isa == SL_ISA_SCALAR   ? 1
                          : isa == SL_ISA_AVX2   ? 2
                          : isa == SL_ISA_AVX512 ? 3
                                                 : 0];
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
    r.lanes_cost = sli_lanes_cost_of(F->kernels->isa);
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

/* Sorts and groups requests, and finds the room their sweeps need. */
static void sli_requests_group(sli_requests *r, sli_room *room) {
    sl_int k = 0;
    sli_requests_sort(r);
    for (r->n_groups = 0; k < r->count; r->n_groups++) {
        sli_group g;
        const sl_int taken = sli_group_choose(r, k, &g);
        sli_room_add(room, &g.size, (sl_int)1 << sli_lanes_kind(g.count));
        r->taken[r->n_groups] = (uint64_t)taken;
        k += taken;
    }
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
/* inverse.h: entries and bilinear forms of A^-1: forward sweeps, then sums over common columns weighted by 1/D */
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

/* A workspace for one call, where the caller has none. */
static sl_work sli_work_own(const sl_factor *F) {
    sl_work own;
    own.allocator = F->allocator;
    own.block = NULL;
    own.size = 0;
    return own;
}

/* The base of W, grown to what a layout has counted, for its second run. */
static sl_status sli_work_lay(sl_work *W, sli_block *b, size_t at_least) {
    const sl_status status =
        b->overflow ? SL_ERR_TOO_LARGE
                    : sli_work_grow(W, b->used > at_least ? b->used : at_least + (at_least == 0));
    b->base = (unsigned char *)W->block;
    b->used = 0;
    return status;
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

/* The sums that the sorted requests k .. k+taken-1, one group, ask for. */
static void sli_pairs_answer(const sl_factor *F, const sli_requests *r, const sli_forward *f,
                             const sli_group *g, sl_int k, sl_int taken, double *out) {
    sl_int first[SLI_REQUESTS_MAX], second[SLI_REQUESTS_MAX], m;
    double sums[SLI_REQUESTS_MAX];
    for (m = 0; m < taken; m++) {
        const sl_int at = sli_value(r->order[k + m]);
        first[m] = sli_group_lane(g, sli_request_row(r, at));
        second[m] = sli_group_lane(g, sli_request_column(r, at));
    }
    sli_pair_sums(F, f, taken, first, second, sums);
    for (m = 0; m < taken; m++) {
        out[sli_value(r->order[k + m])] = sums[m];
    }
}

/* Entries one by one. The room is known only once the requests are sorted and grouped: where W is too
 * small for it, it grows and they are sorted again, before anything is written. */
static sl_status sli_inverse_entries(const sl_factor *F, double *out, sli_requests *r, sl_work *W,
                                     sl_stats *stats) {
    size_t bytes = 0;
    sli_forward f;
    sl_int k = 0, m;
    for (;;) {
        sli_block b = {NULL, 0, 0};
        sli_room room = {0, 0, 0, 0};
        sl_status status;
        sli_requests_layout(r, &b);
        status = sli_work_lay(W, &b, bytes);
        if (status != SL_OK) {
            return status;
        }
        sli_requests_layout(r, &b);
        sli_requests_group(r, &room);
        sli_forward_layout(&f, &b, &room);
        sli_forward_layout_run(&f, &b, &room);
        if (b.overflow) {
            return SL_ERR_TOO_LARGE;
        }
        if (b.used <= W->size) {
            break;
        }
        bytes = b.used;
    }
    for (m = 0; m < r->n_groups; m++) {
        const sl_int taken = (sl_int)r->taken[m];
        sli_group g;
        sli_group_again(r, k, taken, &g);
        sli_forward_group(&f, F, &g, stats);
        sli_pairs_answer(F, r, &f, &g, k, taken, out);
        k += taken;
    }
    return SL_OK;
}

static sl_status sli_inverse_pairs(const sl_factor *F, double *out, const sl_int *rows,
                                   const sl_int *columns, sl_int count, sl_work *W,
                                   sl_stats *stats) {
    sl_work own;
    sli_requests r;
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
    r = sli_requests_of(F, rows, columns, count);
    own = sli_work_own(F);
    status = count == 0 ? SL_OK : sli_inverse_entries(F, out, &r, W == NULL ? &own : W, stats);
    sli_free(&own.allocator, own.block);
    return status;
}

SL_API sl_status sl_inverse_diagonal(const sl_factor *F, double *out, const sl_int *rows,
                                     sl_int count, sl_work *W, sl_stats *stats) {
    sli_stats_clear_error(stats);
    return F == NULL
               ? SL_ERR_ARGUMENT
               : sli_inverse_pairs(F, out, rows, rows, rows == NULL ? F->S->n : count, W, stats);
}

SL_API sl_status sl_inverse_pairs(const sl_factor *F, double *out, const sl_int *rows,
                                  const sl_int *columns, sl_int count, sl_work *W,
                                  sl_stats *stats) {
    sli_stats_clear_error(stats);
    return F == NULL || (count > 0 && (rows == NULL || columns == NULL))
               ? SL_ERR_ARGUMENT
               : sli_inverse_pairs(F, out, rows, columns, count, W, stats);
}

/* c' A^-1 b: two lanes over the reach of both sets, one where they are the same. */
typedef struct sli_bilinear {
    const sl_int *set[2];
    const double *values[2];
    sl_int count[2];
    sl_int vectors;
    uint64_t *seeds, *scratch; /* count[0] + count[1] in all, unless a set is NULL */
} sli_bilinear;

static void sli_bilinear_layout(sli_bilinear *q, sli_block *b) {
    const int is_whole = q->set[0] == NULL || q->set[1] == NULL;
    const uint64_t count = is_whole ? 0 : (uint64_t)q->count[0] + (uint64_t)q->count[1];
    q->seeds = SLI_TAKE(b, uint64_t, count);
    q->scratch = SLI_TAKE(b, uint64_t, count);
}

/* The columns of both sets ascending, each with its place behind one another, and their reach. */
static void sli_bilinear_measure(const sl_symbolic *S, sli_bilinear *q, sli_reach *R) {
    const sl_int nc = q->count[0], total = nc + (q->vectors == 2 ? q->count[1] : 0);
    sl_int k;
    if (q->set[0] == NULL || q->set[1] == NULL) {
        *R = sli_reach_all(S);
        return;
    }
    for (k = 0; k < total; k++) {
        q->seeds[k] = sli_keyed(S->iperm[k < nc ? q->set[0][k] : q->set[1][k - nc]], k);
    }
    sli_sort(q->seeds, total, q->scratch);
    sli_reach_measure(S, q->seeds, total, R);
}

/* Both vectors into the sweep. */
static void sli_bilinear_pack(const sl_symbolic *S, const sli_bilinear *q, sli_forward *f) {
    const sl_int nc = q->count[0], total = nc + (q->vectors == 2 ? q->count[1] : 0);
    sl_int k, lane, at = 0;
    if (q->set[0] != NULL && q->set[1] != NULL) {
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

static sl_status sli_inverse_form(const sl_factor *F, double *out, sli_bilinear *q, sl_work *W,
                                  sl_stats *stats) {
    const int is_whole = q->set[0] == NULL || q->set[1] == NULL;
    const sl_int first = 0, second = q->vectors - 1;
    size_t bytes = 0;
    sli_forward f;
    for (;;) {
        sli_block b = {NULL, 0, 0};
        sli_room room = {0, 0, 0, 0};
        sl_status status;
        sli_bilinear_layout(q, &b);
        status = sli_work_lay(W, &b, bytes);
        if (status != SL_OK) {
            return status;
        }
        sli_bilinear_layout(q, &b);
        sli_bilinear_measure(F->S, q, &f.reach);
        sli_room_add(&room, &f.reach, q->vectors);
        room.steps = is_whole ? 0 : room.steps; /* the analysis has them */
        room.rows = is_whole ? 0 : room.rows;
        sli_forward_layout(&f, &b, &room);
        sli_forward_layout_run(&f, &b, &room);
        if (b.overflow) {
            return SL_ERR_TOO_LARGE;
        }
        if (b.used <= W->size) {
            break;
        }
        bytes = b.used;
    }
    sli_bilinear_pack(F->S, q, &f);
    sli_forward_run(&f, F, stats);
    sli_pair_sums(F, &f, 1, &first, &second, out);
    return SL_OK;
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
    q.set[0] = cset;
    q.set[1] = bset;
    q.values[0] = c;
    q.values[1] = b;
    q.count[0] = nc;
    q.count[1] = nb;
    q.vectors = cset == bset && c == b && nc == nb ? 1 : 2;
    own = sli_work_own(F);
    status = sli_inverse_form(F, out, &q, W == NULL ? &own : W, stats);
    sli_free(&own.allocator, own.block);
    return status;
}

#endif
/* end src/impl/inverse.h */
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
    int is_symmetric;                   /* both sides are one: kept serves as passing */
    sli_requests kept, passing;
    sli_swept sweeps[SLI_KEPT], pass;
    double *weighed; /* of the group that passes by */
} sli_inverse_block;

static void sli_block_layout_requests(sli_inverse_block *q, sli_block *b) {
    sli_requests_layout(&q->kept, b);
    if (!q->is_symmetric) {
        sli_requests_layout(&q->passing, b);
    }
}

static void sli_block_layout_sweeps(sli_inverse_block *q, sli_block *b, const sli_room *kept,
                                    const sli_room *passing) {
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

/* Room as in sli_inverse_entries, then the block. */
static sl_status sli_block_answer(sli_inverse_block *q, sl_work *W, sl_stats *stats) {
    size_t bytes = 0;
    for (;;) {
        sli_block b = {NULL, 0, 0};
        sli_room kept = {0, 0, 0, 0}, passing = {0, 0, 0, 0};
        sl_status status;
        sli_block_layout_requests(q, &b);
        status = sli_work_lay(W, &b, bytes);
        if (status != SL_OK) {
            return status;
        }
        sli_block_layout_requests(q, &b);
        sli_requests_group(&q->kept, &kept);
        if (!q->is_symmetric) {
            sli_requests_group(&q->passing, &passing);
        } else if (q->kept.n_groups > SLI_KEPT) {
            passing = kept;
        }
        sli_block_layout_sweeps(q, &b, &kept, &passing);
        if (b.overflow) {
            return SL_ERR_TOO_LARGE;
        }
        if (b.used <= W->size) {
            break;
        }
        bytes = b.used;
    }
    sli_block_fill(q, stats);
    return SL_OK;
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
    own = sli_work_own(F);
    status = is_empty ? SL_OK : sli_block_answer(&q, W == NULL ? &own : W, stats);
    sli_free(&own.allocator, own.block);
    return status;
}

#endif
/* end src/impl/inverse_block.h */
/* begin src/impl/batch.h */
/* batch.h: independent solves spread over workers by the entries of L that they read */
#ifndef SLI_BATCH_H
#define SLI_BATCH_H

typedef struct sli_batch {
    const sl_factor *F;
    const sl_request *requests;
    sl_int count, workers;
    sl_off blocks;         /* of up to 8 right-hand sides */
    double total;          /* entries of L that all blocks read */
    sl_work *const *works; /* one a worker, or NULL */
    unsigned char *memory; /* then `bytes` a worker */
    size_t bytes;
} sli_batch;

static sli_query sli_request_query(const sl_factor *F, const sl_request *r) {
    return r->plan == NULL ? sli_query_all(F->S) : r->plan->query;
}

SLI_INLINE sli_layout sli_request_layout(const sl_request *r) {
    return r->is_interleaved ? SLI_INTERLEAVED : SLI_COLUMN_MAJOR;
}

/* What one block of 8 right-hand sides reads, and one for the call itself. */
SLI_INLINE double sli_query_weight(const sli_query *q) {
    return 1.0 + (double)q->forward.entries + (double)q->backward.entries;
}

/* Right-hand sides of a request that start before some share of the batch: whole blocks of 8, from
 * `before`, what the requests before it weigh. */
static sl_int sli_blocks_before(double share, double before, double weight, sl_int nrhs) {
    const double blocks = ceil((share - before) / weight);
    return blocks <= 0.0 ? 0 : blocks * 8.0 >= nrhs ? nrhs : (sl_int)blocks * 8;
}

/* Worker k's share of the batch. */
static void sli_batch_share(void *data, sl_int k) {
    const sli_batch *b = (const sli_batch *)data;
    const double from = b->total * k / b->workers, to = b->total * (k + 1) / b->workers;
    void *memory = b->works != NULL ? b->works[k]->block : b->memory + (size_t)k * b->bytes;
    double before = 0.0;
    sl_int m;
    for (m = 0; m < b->count && before < to; m++) {
        const sl_request *r = &b->requests[m];
        const sli_query q = sli_request_query(b->F, r);
        const double weight = sli_query_weight(&q);
        const sl_int first = sli_blocks_before(from, before, weight, r->nrhs);
        const sl_int last =
            k + 1 == b->workers ? r->nrhs : sli_blocks_before(to, before, weight, r->nrhs);
        if (first < last && q.nx > 0) {
            const sli_layout layout = sli_request_layout(r);
            const sli_dense x_at = sli_dense_of(layout, r->ldx),
                            b_at = sli_dense_of(layout, r->ldb);
            sli_sweep(b->F, &q, r->X + (size_t)first * x_at.column, x_at,
                      q.nb > 0 ? r->B + (size_t)first * b_at.column : r->B, b_at, last - first,
                      memory);
        }
        before += weight * (sli_tiles(r->nrhs));
    }
}

/* Checks every request; weighs them and finds the scratch that they need. */
static sl_status sli_batch_check(sli_batch *b, sl_int *at) {
    for (*at = 0; *at < b->count; ++*at) {
        const sl_request *r = &b->requests[*at];
        const sli_query q = sli_request_query(b->F, r);
        size_t bytes;
        const sl_status status =
            sli_check_dense(r->X, r->ldx, q.nx, r->B, r->ldb, q.nb, sli_request_layout(r), r->nrhs);
        if (status != SL_OK) {
            return status;
        }
        if (q.S != b->F->S) {
            return SL_ERR_STATE;
        }
        bytes = r->nrhs > 0 ? sli_vectors_bytes(&q, r->nrhs) : 0;
        if (bytes == SIZE_MAX) {
            return SL_ERR_TOO_LARGE;
        }
        b->bytes = bytes > b->bytes ? bytes : b->bytes;
        b->blocks += sli_tiles(r->nrhs);
        b->total += sli_query_weight(&q) * (sli_tiles(r->nrhs));
    }
    *at = -1;
    return SL_OK;
}

/* Scratch for every worker: in the caller's workspaces, or in one block to be freed. */
static sl_status sli_batch_reserve(sli_batch *b, sl_work *const *works) {
    sli_block block = {NULL, 0, 0};
    sl_status status = SL_OK;
    sl_int k, other;
    int pass;
    for (k = 0; works != NULL && k < b->workers && status == SL_OK; k++) {
        for (other = 0; other < k; other++) {
            status = works[k] == works[other] ? SL_ERR_ARGUMENT : status;
        }
        status = works[k] == NULL ? SL_ERR_ARGUMENT : status;
        status = status == SL_OK ? sli_work_grow(works[k], b->bytes) : status;
    }
    b->works = works;
    b->bytes = (b->bytes + SLI_ALIGN - 1) / SLI_ALIGN * SLI_ALIGN;
    for (pass = 0; works == NULL && pass < 2 && status == SL_OK; pass++) {
        for (k = 0; k < b->workers; k++) {
            unsigned char *memory = (unsigned char *)sli_take(&block, b->bytes, 1);
            b->memory = k == 0 ? memory : b->memory;
        }
        status = pass == 0 ? sli_block_alloc(&block, &b->F->allocator) : SL_OK;
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
    if (F == NULL || count < 0 || (count > 0 && requests == NULL) || threads->count < 0) {
        return SL_ERR_ARGUMENT;
    }
    if (!F->is_good) {
        return SL_ERR_STATE;
    }
    b.F = F;
    b.requests = requests;
    b.count = count;
    status = sli_batch_check(&b, &at);
    b.workers = sli_workers(threads);
    b.workers = b.blocks < b.workers ? (sl_int)b.blocks : b.workers;
    if (failed != NULL) {
        *failed = at;
    }
    if (status == SL_OK && b.blocks > 0) {
        status = sli_batch_reserve(&b, works);
        if (status == SL_OK) {
            sli_parallel(threads, b.workers, sli_batch_share, &b);
        }
        if (works == NULL) {
            sli_free(&F->allocator, b.memory);
        }
    }
    return status;
}

#endif
/* end src/impl/batch.h */
/* begin src/impl/selected.h */
/* selected.h: the selected inverse: a sweep from the roots to the leaves, each front gathered from its parent's */
#ifndef SLI_SELECTED_H
#define SLI_SELECTED_H

/* The sweep, planned: a front must stay until the last of its children has taken its part, and children come
 * last to first. Fronts of even and of odd depth have a stack each, which grow towards each other: when
 * a front is made, its parent's is the top of the other stack. */
typedef struct sli_descent {
    sl_int *up;     /* count: the parent, as a number in the list of supernodes, -1 at a root */
    sl_int *last;   /* count: the child that comes last, -1 where there is none */
    sl_int *side;   /* count: depth % 2 */
    sl_off *front;  /* count: where the front begins, in doubles */
    sl_off fronts;  /* doubles for all of them */
    sl_off scratch; /* doubles for the kernels */
} sli_descent;

struct sl_selected {
    sl_allocator allocator;
    const sl_symbolic *S; /* borrowed */
    sl_int count;         /* supernodes */
    sl_int *supers;       /* count, ascending */
    sl_off *begin;        /* count + 1: the panels, in doubles */
    double *Z;
    sli_descent descent;
    size_t bytes;
};

/* The supernodes of the reach of seeds, columns of L in ascending order. */
static void sli_selected_reach(sl_selected *Z, const uint64_t *seeds, sl_int count) {
    const sl_symbolic *S = Z->S;
    sl_int k = 0, at = 0, s, next;
    while (k < count) {
        s = S->super_of[sli_key(seeds[k])];
        next = sli_next_seed(S, seeds, count, &k);
        for (; s != -1 && s < next; s = S->super_parent[s]) {
            Z->supers[at++] = s;
        }
    }
    SLI_ASSERT(at == Z->count);
}

static void sli_selected_layout(sl_selected *Z, sli_block *b) {
    (void)sli_take(b, 1, sizeof(sl_selected));
    Z->supers = SLI_TAKE(b, sl_int, Z->count);
    Z->begin = SLI_TAKE(b, sl_off, (uint64_t)Z->count + 1);
    Z->descent.up = SLI_TAKE(b, sl_int, Z->count);
    Z->descent.last = SLI_TAKE(b, sl_int, Z->count);
    Z->descent.side = SLI_TAKE(b, sl_int, Z->count);
    Z->descent.front = SLI_TAKE(b, sl_off, Z->count);
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

/* The object, all but its numbers. */
static sl_status sli_selected_list(sl_selected **out, const sl_symbolic *S, const sl_int *set,
                                   sl_int count, const sl_allocator *a, sl_stats *stats) {
    sli_block temporary = {NULL, 0, 0}, kept = {NULL, 0, 0};
    uint64_t *seeds = NULL, *scratch = NULL;
    sl_selected draft;
    sl_status status = SL_OK;
    sl_int k;
    int pass;
    memset(&draft, 0, sizeof draft);
    draft.allocator = *a;
    draft.S = S;
    draft.count = S->n_supers;
    if (set != NULL) {
        sli_reach R;
        for (pass = 0; pass < 2 && status == SL_OK; pass++) {
            seeds = SLI_TAKE(&temporary, uint64_t, count);
            scratch = SLI_TAKE(&temporary, uint64_t, count);
            status = pass == 0 ? sli_block_alloc(&temporary, a) : SL_OK;
        }
        if (status == SL_OK) {
            status = sli_selected_sort(S, set, count, seeds, scratch, stats);
        }
        if (status == SL_OK) {
            sli_reach_measure(S, seeds, count, &R);
            draft.count = R.count;
        }
    }
    for (pass = 0; pass < 2 && status == SL_OK; pass++) {
        sli_selected_layout(&draft, &kept);
        status = pass == 0 ? sli_block_alloc(&kept, a) : SL_OK;
    }
    if (status == SL_OK) {
        for (k = 0; k < draft.count && set == NULL; k++) {
            draft.supers[k] = k;
        }
        if (set != NULL) {
            sli_selected_reach(&draft, seeds, count);
        }
        draft.begin[0] = 0;
        for (k = 0; k < draft.count; k++) {
            const sl_int s = draft.supers[k];
            draft.begin[k + 1] = draft.begin[k] + (S->panel_begin[s + 1] - S->panel_begin[s]);
        }
        *out = (sl_selected *)(void *)kept.base;
        **out = draft;
    }
    sli_free(a, temporary.base);
    return status;
}

/* Doubles of a front: whole row tiles of all its columns. */
SLI_INLINE sl_off sli_square_size(const sli_step *s) {
    const sl_int h = s->width + s->below;
    return (sl_off)SLI_TILE * sli_tiles(h) * h;
}

/* Parents, and the child that comes last. A supernode's parent is the next one of the chain of ancestors at hand
 * that is not below it, as the list is in postorder and closed under the parent relation. */
static void sli_descent_tree(sli_descent *d, const sl_selected *Z) {
    const sl_symbolic *S = Z->S;
    sl_int k, up = -1;
    for (k = Z->count - 1; k >= 0; k--) {
        const sl_int parent = S->super_parent[Z->supers[k]];
        while (up != -1 && Z->supers[up] != parent) {
            up = d->up[up];
        }
        d->up[k] = up;
        d->last[k] = -1;
        d->side[k] = 0;
        if (up != -1) {
            d->last[up] = k;
            d->side[k] = 1 - d->side[up];
        }
        up = k;
    }
}

static void sli_descent_plan(sli_descent *d, const sl_selected *Z) {
    const sl_symbolic *S = Z->S;
    sl_off top[2] = {0, 0};
    sl_int k, tallest = 0, widest = 0;
    sli_descent_tree(d, Z);
    d->fronts = 0;
    for (k = Z->count - 1; k >= 0; k--) {
        const sli_step *step = &S->steps[Z->supers[k]];
        const sl_off size = sli_square_size(step);
        const sl_int side = d->side[k], up = d->up[k];
        d->front[k] = side == 0 ? top[0] : -(top[1] + size);
        top[side] += size;
        d->fronts = top[0] + top[1] > d->fronts ? top[0] + top[1] : d->fronts;
        if (up != -1 && d->last[up] == k) {
            top[1 - side] -= sli_square_size(&S->steps[Z->supers[up]]);
        }
        if (d->last[k] == -1) {
            top[side] -= size;
        }
        tallest = sli_max(tallest, step->width + step->below);
        widest = sli_max(widest, step->width);
    }
    for (k = 0; k < Z->count; k++) { /* the second stack counts from the end, which is known now */
        d->front[k] += d->side[k] == 0 ? 0 : d->fronts;
    }
    d->scratch = sli_dual_scratch(tallest, widest);
}

/* The columns of a front to the panel. */
static void sli_selected_keep(const sli_dual *f, double *panel) {
    const sl_int w = f->width, h = w + f->below, tiles = sli_tiles(h);
    sl_int t, j;
    for (t = 0; t < tiles; t++) {
        double *to = panel + sli_tile_offset(w, t);
        const sl_int columns = sli_min(w, SLI_TILE * (t + 1)), rows = h - SLI_TILE * t;
        memcpy(to, f->front + sli_square_offset(h, t), SLI_TILE * (size_t)columns * sizeof *to);
        for (j = 0; j < columns && rows < SLI_TILE; j++) { /* padding */
            memset(to + SLI_TILE * (ptrdiff_t)j + rows, 0, (size_t)(SLI_TILE - rows) * sizeof *to);
        }
    }
}

/* Most of a panel that is asked for before its turn: read from the last to the first they meet no hardware that runs
 * ahead of them, and waiting for L was a fifth of all time on 2D meshes. */
#define SLI_PANEL_AHEAD ((sl_off)1024)

static void sli_selected_prefetch(const double *panel, sl_off size) {
    sl_off k;
    for (k = 0; k < size && k < SLI_PANEL_AHEAD; k += SLI_TILE) {
        SLI_PREFETCH(panel + k, 0);
    }
}

/* All fronts, parents before children. */
static void sli_selected_sweep(sl_selected *Z, const sl_factor *F, const sli_descent *d,
                               double *fronts, double *scratch) {
    const sl_symbolic *S = Z->S;
    sl_int k;
    for (k = Z->count - 1; k >= 0; k--) {
        const sl_int s = Z->supers[k], up = d->up[k];
        const sli_step *step = &S->steps[s];
        sli_dual f;
        f.panel = F->L + step->panel;
        f.D = F->D + step->column;
        f.front = fronts + d->front[k];
        f.width = step->width;
        f.below = step->below;
        if (up != -1) {
            const sli_step *parent = &S->steps[Z->supers[up]];
            F->kernels->gather(&f, fronts + d->front[up], parent->width + parent->below,
                               S->places + S->rows_begin[s]);
        }
        if (k > 0) {
            const sl_int next = Z->supers[k - 1];
            sli_selected_prefetch(F->L + S->panel_begin[next],
                                  S->panel_begin[next + 1] - S->panel_begin[next]);
        }
        F->kernels->takahashi(&f, scratch);
        sli_selected_keep(&f, Z->Z + Z->begin[k]);
    }
}

/* The numbers, in a workspace. F fits. */
static sl_status sli_selected_fill(sl_selected *Z, const sl_factor *F, sl_work *W) {
    sli_block b = {NULL, 0, 0};
    double *fronts = NULL, *scratch = NULL;
    sl_status status = SL_OK;
    int pass;
    for (pass = 0; pass < 2 && status == SL_OK; pass++) {
        fronts = SLI_TAKE(&b, double, Z->descent.fronts);
        scratch = SLI_TAKE(&b, double, Z->descent.scratch);
        if (pass == 0) {
            status = b.overflow ? SL_ERR_TOO_LARGE : sli_work_grow(W, b.used);
            b.base = (unsigned char *)W->block;
            b.used = 0;
        }
    }
    if (status == SL_OK) {
        sli_selected_sweep(Z, F, &Z->descent, fronts, scratch);
    }
    return status;
}

/* The same in the caller's workspace, or in one for this call. */
static sl_status sli_selected_fill_in(sl_selected *Z, const sl_factor *F, sl_work *W) {
    sl_work own;
    sl_status status;
    own.allocator = Z->allocator;
    own.block = NULL;
    own.size = 0;
    status = sli_selected_fill(Z, F, W == NULL ? &own : W);
    sli_free(&own.allocator, own.block);
    return status;
}

/* Room for the numbers. */
static sl_status sli_selected_room(sl_selected *Z) {
    sli_block b = {NULL, 0, 0};
    sl_status status = SL_OK;
    int pass;
    for (pass = 0; pass < 2 && status == SL_OK; pass++) {
        Z->Z = SLI_TAKE(&b, double, Z->begin[Z->count]);
        Z->bytes += pass == 0 ? b.used : 0;
        status = pass == 0 ? sli_block_alloc(&b, &Z->allocator) : SL_OK;
    }
    return status;
}

static void sli_selected_stats(const sl_selected *Z, double started, sl_stats *stats) {
    sl_int k;
    if (stats != NULL) {
        stats->z_supernodes = Z->count;
        stats->z_columns = 0;
        for (k = 0; k < Z->count; k++) {
            stats->z_columns += Z->S->steps[Z->supers[k]].width;
        }
        stats->z_entries = Z->begin[Z->count];
        stats->seconds_selected = sli_seconds() - started;
        stats->bytes_selected = Z->bytes;
    }
}

SL_API sl_status sl_selected_create(sl_selected **out, const sl_factor *F, const sl_int *set,
                                    sl_int count, const sl_options *opt, sl_stats *stats) {
    const double started = sli_seconds();
    const sl_allocator a = sli_allocator(opt);
    sl_selected *Z = NULL;
    sl_status status;
    sli_stats_clear_error(stats);
    if (out == NULL) {
        return SL_ERR_ARGUMENT;
    }
    *out = NULL;
    if (F == NULL || (set != NULL && count < 0) || !sli_allocator_is_whole(opt)) {
        return SL_ERR_ARGUMENT;
    }
    if (!F->is_good) {
        return SL_ERR_STATE;
    }
    status = sli_selected_list(&Z, F->S, set, count, &a, stats);
    if (status == SL_OK) {
        sli_descent_plan(&Z->descent, Z);
        status = sli_selected_room(Z);
    }
    if (status == SL_OK) {
        status = sli_selected_fill_in(Z, F, NULL);
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
    return F->is_good && F->S == Z->S ? sli_selected_fill_in(Z, F, W) : SL_ERR_STATE;
}

SL_API void sl_selected_free(sl_selected *Z) {
    if (Z != NULL) {
        const sl_allocator a = Z->allocator;
        sli_free(&a, Z->Z);
        sli_free(&a, Z);
    }
}

/* The place of supernode s in the list, or -1. */
SLI_INLINE sl_int sli_selected_find(const sl_selected *Z, sl_int s) {
    sl_int at = s;
    if (Z->count < Z->S->n_supers) {
        at = sli_lower_bound(Z->supers, Z->count, s);
    }
    return at < Z->count && Z->supers[at] == s ? at : -1;
}

/* Where the entry of pivots k and l stands in Z, or -1. */
static sl_off sli_selected_at(const sl_selected *Z, sl_int k, sl_int l) {
    const sl_symbolic *S = Z->S;
    const sl_int column = sli_min(k, l), row = sli_max(k, l), s = S->super_of[column];
    const sl_int at = sli_selected_find(Z, s), first = S->super_first[s];
    const sl_int width = S->steps[s].width, below = S->steps[s].below;
    sl_int r = row - first;
    if (at == -1) {
        return -1;
    }
    if (r >= width) {
        const sl_int *rows = S->rows + S->rows_begin[s];
        const sl_int i = sli_lower_bound(rows, below, row);
        if (i == below || rows[i] != row) {
            return -1;
        }
        r = width + i;
    }
    return Z->begin[at] + sli_panel_at(width, r, column - first);
}

/* All entries asked for are looked up before the first is written: out stays untouched on error. */
static sl_status sli_selected_ask(const sl_selected *Z, double *out, const sl_int *rows,
                                  const sl_int *columns, sl_int count, sl_stats *stats) {
    const sl_symbolic *S = Z->S;
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
    const sl_symbolic *S = Z->S;
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
    count = rows == NULL ? Z->S->n : count;
    if (count > 0 && out == NULL) {
        return SL_ERR_ARGUMENT;
    }
    if (rows == NULL && Z->count == Z->S->n_supers) {
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
        v.symbolic = Z->S;
        v.count = Z->count;
        v.supers = Z->supers;
        v.begin = Z->begin;
        v.Z = Z->Z;
    }
    return v;
}

#endif
/* end src/impl/selected.h */
/* last: takes every internal macro away again */
/* begin src/impl/leave.h */
/* leave.h: takes every internal macro away again */
#undef SLI_X86
#undef SLI_ARM
#undef SLI_INLINE
#undef SLI_ALWAYS_INLINE
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
#undef SLI_PANEL_AHEAD
#undef SLI_TASKS_A_WORKER
#undef SLI_SHARED_FLOPS
#undef SLI_ROWS_AHEAD
#undef SLI_TOKEN_MAX
#undef SLI_ORDER_TINY
#undef SLI_COARSEN_STALL
#undef SLI_LEVELS_MAX
#undef SLI_BAND_SHARE
#undef SLI_BALANCE
#undef SLI_FLOW_NONE
#undef SLI_FLOW_END
#undef SLI_FLOW_ROUNDS
#undef SLI_LEAF_MAX
#undef SLI_LEAF_GONE
#undef SLI_DISSECT_LEAF
#undef SLI_DISSECT_LEAF_QUALITY
#undef SLI_DISSECT_PART
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
#undef SLI_DENSE_ROW
#undef SLI_CUT_BALANCE
#undef SLI_REPAIRS
#undef SLI_QUALITY_OURS
#undef SLI_COMPRESS_WORTH
#undef SLI_LAYERS_SHARE
#undef SLI_VOLUME_BORDER
#undef SLI_CLIMB
#undef SLI_LANES_MAX
#undef SLI_REQUESTS_MAX
#undef SLI_KEPT
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

/* types.h: status codes, the matrix view, options, statistics, and the names of the opaque objects */
#ifndef SL_PUBLIC_TYPES_H
#define SL_PUBLIC_TYPES_H

#include "config.h"

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
    /* sl_symbolic_create */

    sl_ordering ordering;
    /* n: perm[k] = row of A that is pivot k; read with SL_ORDERING_GIVEN only */
    const sl_int *perm;
    /* 40 entries as METIS's options array, -1 = METIS's default; NULL: all default; its numbering and debug level are not
     * read */
    const sl_int *metis_options;
    sl_relaxation relaxation;
    /* n / block_size x dimensions (2 or 3), row-major: where each row lies, for FAST and BUILTIN: parts are halves of space
     * where that is the better cut; NULL: not known */
    const double *coordinates;
    sl_int dimensions;
    /* rows that stay together in the order, such as x, y, z of a vertex: rows k block_size .. (k + 1) block_size - 1
     * each; divides n; 0 or 1: none */
    sl_int block_size;

    /* sl_factor_create */

    sl_isa isa;
    sl_method method;
    sl_threads threads; /* of whatever a factor, or a call, can share out */
    sl_definiteness definiteness;
    /* a pivot d is null if |d| <= null_tolerance * (the sum of the magnitudes that made it); 0: (64 + n/8) epsilon;
     * negative: only an exact zero is null */
    double null_tolerance;

    /* the same with SL_SEMIDEFINITE: which of many solutions is meant, and when there is none */

    /* n weights m, copied: x has sum m x = 0 in each component with a null pivot, and b is made consistent by a
     * multiple of m; NULL: x is 0 in the null rows */
    const double *mass;
    /* without mass a solve refuses b where |z' b| > consistency_tolerance * (sum of |b|) for a null vector z that is
     * 1 in its null row; 0: 1e-6, which lets pass what single precision loses; negative: nothing is refused */
    double consistency_tolerance;

    /* the same with SL_DEFINITE: signed regularization */

    /* a null pivot d, or one of the wrong sign, becomes sign * max(|d|, regularization * the sum of the magnitudes
     * that made it, 1 where that is 0); 1e-8 suits refinement; 0: none */
    double regularization;
    /* n: the sign that each row's pivot should have, 1 or -1, or 0: either will do; copied; NULL: all 1 */
    const sl_int *signs;

    /* sl_plan_create: where sweeps may end; borrowed, must outlive the plan; NULL: at the roots alone */
    const struct sl_region *region;
    /* sl_region_create: most bytes that a region with a boundary may keep; 0: no bound */
    size_t region_bytes;

    /* every call that makes an object */
    sl_allocator allocator;
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

/* types.h: status codes, the view of a matrix, enumerations, and the names of the opaque objects */
#ifndef SL_PUBLIC_TYPES_H
#define SL_PUBLIC_TYPES_H

#include "config.h"

/** SL_VERSION of the compiled library; a binding compares it with that of its header. */
SL_API int sl_version(void);

/** Result of a call. Every function that can fail returns one; SL_OK is 0. */
typedef enum sl_status {
    SL_OK = 0,
    /* a NULL pointer, a negative size, a leading dimension too small, an index out of range */
    SL_ERR_ARGUMENT,
    /* the allocator returned NULL */
    SL_ERR_MEMORY,
    /* a malformed matrix, or both triangles stored with different patterns or values */
    SL_ERR_MALFORMED,
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
    /* objects that do not belong together, such as a plan and a factor of different analyses */
    SL_ERR_MISMATCH,
    /* a singular system whose right-hand side has no solution */
    SL_ERR_INCONSISTENT,
    /* pivot growth beyond options.growth_limit (stats name a row), or a refinement that ended above
     * options.error_limit (its solution is written) */
    SL_ERR_INACCURATE,
    /* a matrix whose pattern is not the analyzed one: analyze it, or sl_symbolic_edit */
    SL_ERR_OTHER_PATTERN,
    /* a factor without numbers, as its last change failed; a selected inverse, a region or pins of
     * older numbers of the factor: refactor them */
    SL_ERR_STALE,
    /* a mapped object that would have to change: load it instead; or a factor of
     * sl_factor_submatrix */
    SL_ERR_READ_ONLY
} sl_status;

/** A short description of a status, static storage, for any value. sl_error_text says more. */
SL_API const char *sl_status_string(sl_status status);

/** The count of a list of rows that is NULL: all n rows. */
#define SL_ALL (-1)

/** View of a sparse matrix in compressed columns: column j has rows i[p[j]] .. i[p[j+1]-1].
 *
 *  The caller owns the arrays; no call keeps a pointer to them. The rows of a column may be in any
 *  order. Duplicates are summed. Explicit zeros are entries like any other. A symmetric matrix may
 *  store its lower triangle, its upper triangle or both; the pattern decides which. If it stores
 *  both, the pattern must be symmetric and the values of the lower triangle are read; if the others
 *  differ, sl_factor_create refuses the matrix. options.triangle chooses one triangle, and the
 *  other one may then hold anything.
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

/** Fill-reducing orderings. Rows with equal neighborhoods are ordered as one. 2 is no ordering: its
 *  number is not used again, so that programs compiled with an earlier header get an error. */
typedef enum sl_ordering {
    SL_ORDERING_ND = 0,      /* nested dissection by this header; needs no library */
    SL_ORDERING_METIS = 1,   /* METIS_NodeND on every connected component [KK98] */
    SL_ORDERING_GIVEN = 3,   /* options.perm, or equivalent: see sl_symbolic_create */
    SL_ORDERING_NATURAL = 4, /* 0, 1, 2, ..., or equivalent: see sl_symbolic_create */
    SL_ORDERING_MINDEG = 5   /* approximate minimum degree, the quickest [ADD96] */
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
    SL_METHOD_AUTO = 0,   /* the faster one, judged by flops and memory of fronts */
    SL_METHOD_UP_LOOKING, /* row by row, little memory beyond L: nearly diagonal patterns, stars */
    SL_METHOD_SUPERNODAL  /* multifrontal with dense fronts: everything else; uses threads */
} sl_method;

/** How a factor keeps L. B, X and the arithmetic of solves are double in any case. Accuracy and
 *  limits: tools/docs/float.md. If SIMD is compiled in, plain C (SL_ISA_SCALAR, processors without
 *  AVX2) has no kernels but those of double: L is then in double (stats.factor.storage). */
typedef enum sl_storage {
    SL_STORAGE_DOUBLE = 0,
    SL_STORAGE_FLOAT,  /* half the bytes of L, its accuracy until refined */
    SL_STORAGE_COMPLEX /* half the bytes of L in full accuracy, of complex Hermitian matrices only,
                          complex.h */
} sl_storage;

/** Which pivots are accepted. All others are refused with SL_ERR_PIVOT and their row. */
typedef enum sl_pivots {
    SL_PIVOTS_NONZERO = 0, /* all that are not null: D may have any sign */
    SL_PIVOTS_POSITIVE,    /* A is positive definite */
    SL_PIVOTS_SKIP_NULL    /* A is semidefinite, such as a singular Laplacian: null pivots are
                              skipped and counted */
} sl_pivots;

/** How entries of the inverse were computed. */
typedef enum sl_inverse_method {
    SL_INVERSE_NONE = 0, /* nothing was requested */
    SL_INVERSE_FORWARD,  /* forward sweeps of the requested rows */
    SL_INVERSE_SELECTED  /* selected inversion on their reach */
} sl_inverse_method;

/** What a bound of errors is worth. */
typedef enum sl_certainty {
    SL_UNCERTIFIED = 0,
    SL_ESTIMATED, /* from errors that were measured */
    SL_GUARANTEED /* proved */
} sl_certainty;

/** How a change of a factor was computed. */
typedef enum sl_change_method {
    SL_CHANGE_NONE = 0, /* nothing changed */
    SL_CHANGE_UPDATE,   /* rank-one changes of the columns on their paths */
    SL_CHANGE_REACH,    /* the columns of L that the change reaches were computed again */
    SL_CHANGE_REFACTOR  /* sl_factor_refactor */
} sl_change_method;

/** Why sl_factor_change_entries took its way. */
typedef enum sl_change_reason {
    SL_CHANGE_CHEAPEST = 0, /* the fewest flops, weighted by what one costs in each way */
    SL_CHANGE_UNSUITED,     /* null pivots, 2x2 pivots, or F has no numbers */
    SL_CHANGE_DRIFT,        /* the errors of earlier changes have reached their limit */
    SL_CHANGE_REFUSED,      /* rank-one changes met a pivot that they refuse */
    SL_CHANGE_COLUMNS       /* columns of A were given, and no entries */
} sl_change_reason;

typedef struct sl_matrix sl_matrix;     /* a CSC matrix that the library owns */
typedef struct sl_symbolic sl_symbolic; /* the analysis of one pattern; immutable */
typedef struct sl_factor sl_factor;     /* L and D over a symbolic analysis */
typedef struct sl_plan sl_plan;         /* the reaches of a b-set and an x-set; immutable */
typedef struct sl_work sl_work;         /* workspace of one thread */
typedef struct sl_selected sl_selected; /* entries of the inverse on the pattern of L; immutable */
typedef struct sl_constraints sl_constraints; /* rows held at given values */
typedef struct sl_region sl_region; /* a part of the matrix where local solves can stop early */
typedef struct sl_fixed sl_fixed;   /* a system with rows fixed at given values */

#endif

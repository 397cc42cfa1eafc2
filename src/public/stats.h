/* stats.h: what calls report: the location of an error, counts, times and sizes, in groups */
#ifndef SL_PUBLIC_STATS_H
#define SL_PUBLIC_STATS_H

#include "types.h"

/** Why a call has failed, and where. Every call resets it. Row and column numbers are the caller's.
 */
typedef struct sl_error {
    sl_int row;    /* -1: does not apply */
    sl_int column; /* -1: does not apply */
    sl_off line;   /* of a file, 1-based; of a leading dimension the least; -1: does not apply */
    double value;  /* what was refused: a pivot, an entry, also a negative row; of SL_ERR_IO errno;
                    * 0 if none */
    /* static text: the argument, the option or the reason, and what helps where a factorization was
     * refused; NULL: no error */
    const char *what;
} sl_error;

/** An analysis: sl_symbolic_create, _create_pivoted, sl_symbolic_view. */
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
    /* of the ordering; all are 0 below 4000 entries of A */
    double seconds_order;
    double seconds_analyze;   /* of the rest of the analysis, of which: */
    double seconds_tree;      /* P A P', elimination tree, column counts and supernodes */
    double seconds_structure; /* rows of L and the map of A into L */
    size_t bytes;
} sl_symbolic_info;

/** A factorization: sl_factor_create, sl_factor_refactor, their variants, sl_factor_view. */
typedef struct sl_factor_info {
    sl_int positive;    /* pivots (eigenvalues of 2x2 ones) by sign: the inertia of A */
    sl_int negative;    /* the same */
    sl_int null;        /* null pivots: the skipped ones, or the one that was refused */
    sl_int regularized; /* pivots that regularization changed; they count by their new sign */
    /* with SL_PIVOTS_SKIP_NULL: kept pivots within rounding of 0. A component with a known null
     * vector has them where its parts are joined weakly, or if it has a second null vector */
    sl_int weak;
    /* with SL_PIVOTS_SKIP_NULL: connected components without a null pivot. Their solutions are
     * unique, and options.mass does not apply to them */
    sl_int regular;
    sl_isa isa;
    sl_method method;   /* the method that was used */
    sl_storage storage; /* how L is kept */
    /* that a factorization is divided among; 1: the matrix is small, or the header was compiled
     * with neither SL_PTHREADS nor OpenMP and options.threads has no pool */
    sl_int threads;
    double pivot_min; /* smallest |d|, or magnitude of an eigenvalue of a 2x2 pivot */
    double pivot_max; /* largest */
    double entry_max; /* largest |a| among the entries of A that were read */
    /* pivot growth, max_k (|L| |D| |L'|)_kk / max |a|, the maximum over the connected components
     * of the pattern: about 1 to 2 for definite matrices, whatever their scaling. The backward
     * error of a solve without refinement is at most about growth * epsilon (sl_factor_create) */
    double growth;
    /* of a factorization that was refused with SL_ERR_PIVOT: a pivot (error.value) up to this size
     * is null; 0: not known */
    double null_bound;
    /* of schedule and memory in sl_factor_create; 0 below 16000 values of L */
    double seconds_setup;
    double seconds; /* of the numbers */
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

/** Entries of the inverse: sl_inverse_diagonal, _pairs, _block. */
typedef struct sl_inverse_info {
    sl_inverse_method method;
    /* SL_INVERSE_FORWARD: of the largest reach swept; SL_INVERSE_SELECTED: of the inverted part */
    sl_int supernodes;
    sl_int columns; /* the same */
    sl_off entries; /* SL_INVERSE_FORWARD: doubles of L that all sweeps together read; else 0 */
} sl_inverse_info;

/** A selected inverse: sl_selected_create, sl_selected_view. */
typedef struct sl_selected_info {
    sl_int supernodes; /* supernodes whose part of the inverse is kept */
    sl_int columns;    /* their columns */
    sl_off entries;    /* doubles kept */
    double seconds;
    size_t bytes;
} sl_selected_info;

/** A region: sl_region_create, sl_region_refactor, sl_region_view. */
typedef struct sl_region_info {
    sl_int rows;     /* rows of A that a plan in it may use, the boundary included */
    sl_int boundary; /* rows of the boundary */
    sl_int subtrees; /* subtrees of supernodes in its interior */
    sl_off entries;  /* doubles of the inverse that are kept */
    int is_copied;   /* 1: copied from a selected inverse; 0: computed by forward sweeps */
    double seconds;
    size_t bytes;
} sl_region_info;

/** Refinement: sl_factor_refine, sl_plan_solve_regularized. */
typedef struct sl_refine_info {
    sl_int steps;          /* corrections applied, the maximum over all right-hand sides */
    double backward_error; /* what remains, the maximum over all right-hand sides */
} sl_refine_info;

/** The errors of all solves with a factor: sl_factor_certify, sl_plan_solve_bounded. */
typedef struct sl_certificate_info {
    sl_certainty certainty;
    sl_int solves;         /* full solves that found eta; 0 if it was there */
    double eta;            /* the largest relative error in the energy norm */
    double eigenvalue_min; /* guaranteed: a lower bound, of A scaled to a unit diagonal; else 0 */
    double seconds;
} sl_certificate_info;

/** A change of a factor in place: sl_factor_rank_update, sl_factor_change_entries. */
typedef struct sl_change_info {
    sl_change_method method; /* the way that was taken */
    sl_change_reason reason; /* why; of sl_factor_change_entries */
    sl_int ranks;            /* rank-one changes that the change consists of; 0: not counted */
    sl_off entries;          /* doubles of L that rank-one changes read and write */
    sl_off updates;          /* rank-one changes since the last complete factorization */
    /* an estimate of the backward error that they have added: the sum over all passes of epsilon
     * times the largest number a pivot was computed from, relative to the largest |a|; more where
     * the rows or the vectors of a call have lost more (tools/docs/changes.md) */
    double drift;
    double flops_update; /* of the rank-one changes, about; 0 if F cannot be changed so */
    /* to compute what the change reaches, counted up to the cost of the cheapest way; of entries
     * given to sl_factor_change_entries, else 0 */
    double flops_changed;
    double flops_refactor; /* of sl_factor_refactor; as flops_changed */
    double seconds;
} sl_change_info;

/** The factor of a principal submatrix: sl_factor_submatrix. */
typedef struct sl_submatrix_info {
    sl_int kept;     /* columns of L that were copied */
    sl_int computed; /* the others */
    sl_off entries;  /* doubles of L that were copied */
    int is_anew;     /* 1: too few columns to copy: all were analyzed and computed */
    double seconds;  /* analysis included */
} sl_submatrix_info;

/** An analysis that follows an edit of the pattern: sl_symbolic_edit. */
typedef struct sl_edit_info {
    sl_int changed;   /* rows of B that are new or have other neighbors than before */
    sl_int moved;     /* rows that moved to another separator */
    sl_int reordered; /* rows of subtrees that were ordered again; n if is_anew */
    sl_int computed;  /* columns of L whose structure was computed again */
    int is_anew;      /* 1: the edit is not local: all rows were ordered again */
    int is_due;       /* 1: a new order is due, as growth exceeds 1.1 */
    /* nnz_l relative to that of a new order, which is estimated: the entries of the last one, times
     * the growth of the entries of A since then. A loaded analysis counts as a new one */
    double growth;
    double seconds; /* all included */
} sl_edit_info;

/** A factor that follows an edit of the pattern: sl_factor_edit. */
typedef struct sl_reuse_info {
    sl_int kept;             /* columns of L that were copied */
    sl_int computed;         /* the others */
    sl_off entries;          /* doubles of L that were copied */
    double flops;            /* of the columns to compute and of what they gather from kept ones */
    double flops_anew;       /* of all columns */
    int is_anew;             /* 1: a whole factorization */
    sl_change_reason reason; /* why: SL_CHANGE_CHEAPEST, _UNSUITED, _REFUSED */
    double seconds;
} sl_reuse_info;

/** Rows that are held: sl_constraints_add, _release, _refactor. */
typedef struct sl_constraints_info {
    sl_int count;   /* pins and equalities */
    double seconds; /* of the call */
} sl_constraints_info;

/** Rows fixed at given values: sl_fixed_create, sl_fixed_refactor. */
typedef struct sl_fixed_info {
    sl_int n_free;    /* rows that are not fixed */
    sl_off couplings; /* entries of A between free and fixed rows */
    double seconds;   /* of the call */
} sl_fixed_info;

/** What a call reports. Each call sets `error` and the groups listed at its declaration and leaves
 *  the others, so that one struct can collect the groups of many calls. It needs no initialization.
 *  Seconds are processor time of all threads.
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
    sl_submatrix_info submatrix;
    sl_edit_info edit;
    sl_reuse_info reuse;
    sl_constraints_info constraints;
    sl_certificate_info certificate;
    sl_fixed_info fixed;
    /* new fields take this space, so that the size of the struct never changes; not written */
    sl_off reserved[40];
} sl_stats;

/** Writes an error as one sentence: the status, error.what, and the row, column, line and value as
 *  far as they apply. "null pivot: the row is pinned twice (row 5)"
 *
 *  buffer  [out]  up to size bytes, with a terminating zero; NULL if size is 0.
 *  status  [in]   what a call has returned.
 *  stats   [in]   those of the call; NULL: its error is the last one of this thread. So also calls
 *                 without stats have a text, until the thread makes another call.
 *  Returns  the length of the whole sentence without its zero, as snprintf does.
 *  Threads  any number of calls at once. Without thread-local storage (SL_NO_THREAD_LOCAL, or a
 *           compiler other than gcc, clang and MSVC) only stats have texts.
 *  Manual   tools/docs/errors.md
 *  Example  tests/core/test_errors.c
 */
SL_API size_t sl_error_text(char *buffer, size_t size, sl_status status, const sl_stats *stats);

/** sizeof(sl_stats) in the library: a binding compares it with its own before it passes one. */
SL_API size_t sl_stats_size(void);

#endif

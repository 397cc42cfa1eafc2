/* factor_types.h: the factor object, what it says of itself, and the failures of a factorization */
#ifndef SLI_FACTOR_FACTOR_TYPES_H
#define SLI_FACTOR_FACTOR_TYPES_H

#include "../matrix/csc.h"
#include "../analysis/schedule_types.h"
#include "../kernels/dispatch.h"
#include "../base/status.h"
#include "null_space.h"

/* The source of a factorization's entries: a matrix A, or a weighted sum of value arrays in the
 * order of the scatter map. */
typedef struct sli_source {
    const sl_csc *A;             /* NULL: the sum over t of coefficients[t] values[t] */
    const double *const *values; /* terms arrays, scatter_begin[n_supers] values each */
    const double *coefficients;  /* terms */
    sl_int terms;
} sli_source;

/* The first failure of a factorization. */
typedef struct sli_failure {
    sl_status status;
    sl_int super; /* the supernode in which it occurred */
    sl_int pivot; /* the pivot that is null or not finite, or -1 */
    /* the entry that is not finite, as a position in the scatter map; -1: a coefficient */
    sl_off position;
    double value;
    double bound; /* a pivot up to this size is null; 0: not known */
} sli_failure;

/* What a supernode contributes to pivot growth (growth.h). */
typedef struct sli_extent {
    double entry;     /* the largest |a| in its columns */
    double magnitude; /* the largest sum of magnitudes that one of its pivots was computed from */
    sl_int pivot;     /* that pivot; -1: all magnitudes are 0 */
    /* 1 + a column in it: the first pivot that may be null (pivot_judge.h); or 0 */
    sl_int suspects;
} sli_extent;

typedef struct sli_storage_type sli_storage_type; /* storage_type.h */

/* Those of the kernels that suit how L is kept. */
typedef struct sli_own_kernels {
    const sli_sweeps *sweeps;       /* they read L */
    const sli_front_kernels *front; /* they compute fronts */
} sli_own_kernels;

/* What a user has asked to refuse or to report. */
typedef struct sli_limits {
    int is_definite; /* negative pivots are refused */
    double growth;   /* a larger growth is refused */
    double error;    /* a refinement that ends above it is reported */
} sli_limits;

/* Supernodes whose numbers are copied in a factorization: a pack's struct begins with this. */
typedef struct sli_copied {
    const sl_int *from; /* n_supers: where the numbers of a supernode are, or -1: it is computed */
    /* copies a supernode whose descendants are copied, and prepares what it passes up */
    void (*copy)(sl_factor *F, sl_int s, sl_int worker);
} sli_copied;

/* What has been done to the numbers since the last complete factorization. */
typedef struct sli_history {
    sl_off updates; /* rank-one changes */
    double drift;   /* the rounding errors that they have added, relative to the largest entry */
    double scale;   /* of the matrix as they have changed it: the largest entry, or less */
    double lowest;  /* the least that it has been */
    double high;    /* the largest entry, or more */
    double checked; /* `scale` when L D L' was last asked for it */
    double error;   /* the rounding errors that changes have added: epsilon times their scales */
    /* by rows, from the first change on where all pivots have one sign (change/update_loss.h): */
    double *loss;         /* n: the sum of all numbers that a pivot was computed from */
    unsigned char *known; /* n_supers: is it known of the rows of a supernode? */
    double base;          /* what the pivots had lost before, in units of epsilon; 0: not begun */
    size_t bytes;         /* of the two arrays, until a change succeeds and they count */
    /* n_supers: a hash of the entries of A that each supernode was computed from, but for runs of
     * plain columns; 0: not known */
    uint64_t *marks;
} sli_history;

/* What is proved of the errors of all solves: the largest relative one in the energy norm. */
typedef struct sli_certificate {
    double eta;
    sl_certainty certainty;
    uint64_t generation; /* of the numbers that it is about; of others it says nothing */
} sli_certificate;

/* The scratch of fronts: a piece for each worker. */
typedef struct sli_front_work {
    double *buffer; /* of kernels */
    void *stack;    /* the update stack: update matrices until their parents assemble them */
    /* rows of the tallest front: the sum of the magnitudes that went into each diagonal entry */
    double *magnitude;
    double *reciprocals;      /* SLI_FRONT_RECIPROCALS */
    double *panels;           /* panels that are not stored as they are computed */
    sl_off panel_room;        /* doubles of such a piece */
    sli_failure *failures;    /* the first failure of a worker */
    const sli_copied *copied; /* supernodes that are copied in this factorization, or NULL */
    int is_worker;            /* 1: on a thread that must not allocate; 2: it had to */
} sli_front_work;

/* The scratch of the up-looking factorization. */
typedef struct sli_row_work {
    double *x;        /* n: row k while it is computed; all 0 between rows */
    sl_int *head;     /* n: the first supernode whose next row is k, -1 for none */
    sl_int *next;     /* n_supers: the next supernode in the same list, -1 at the end */
    sl_int *position; /* n_supers: how many rows below each supernode are computed */
    uint64_t *list;   /* n_supers: the supernodes in the reach of row k */
    uint64_t *list_scratch;
} sli_row_work;

/* What a factor reports: these members of sl_stats. */
typedef struct sli_factor_stats {
    sl_error error;
    sl_factor_info factor;
} sli_factor_stats;

struct sl_factor {
    sl_allocator allocator;
    sli_atomic borrowers; /* sets of pins */
    sli_factor_stats stats;
    const sl_symbolic *S;
    const sli_kernels *kernels;
    const sli_storage_type *type; /* how L is kept */
    sli_own_kernels own;
    sl_method method;
    sl_threads threads;
    sli_schedule schedule;

    int is_valid;     /* L and D hold a factor */
    int is_immutable; /* L, D and the other arrays are those of a mapped file */
    sl_status status; /* of the last factorization */
    /* of L and D: the analysis, the values of A or of the sum, and the pivots; what depends on the
     * numbers keeps it */
    sli_hash identity;
    /* counts factorizations and changes, also those that give the same numbers again */
    uint64_t generation;
    sli_history history;
    sli_certificate certificate;

    void *values; /* L: the panels of all supernodes, as they are stored */
    double *D;    /* n pivots */
    double *E;    /* n: D(k+1, k) at the first column k of a 2x2 pivot; NULL: none */
    /* n: the divisors of the backward sweep: D, with 1 at the anchors, where it is given x itself,
     * and in 2x2 pivots, which are applied before it; read if null.is_centered or with pairs */
    double *divisors;
    sli_extent *extents; /* n_supers */
    sli_pivot_rule rule;
    sli_limits limits;
    sli_null_space null;

    void *scratch; /* the block of all scratch arrays; NULL: not allocated yet */
    sli_front_work work;
    sli_row_work row;
};

/* The numbers of a factor at one time. */
typedef struct sli_numbers {
    const sl_factor *F;
    sli_hash identity;
    uint64_t generation; /* 0: none */
} sli_numbers;

SLI_INLINE sli_numbers sli_numbers_of(const sl_factor *F) {
    sli_numbers numbers;
    numbers.F = F;
    numbers.identity = F->identity;
    numbers.generation = F->generation;
    return numbers;
}

/* Does F hold these numbers? Also false for another factor that was created at the same address. */
SLI_INLINE int sli_numbers_are_of(const sli_numbers *numbers, const sl_factor *F) {
    return numbers->F == F && numbers->generation == F->generation &&
           sli_hash_equals(numbers->identity, F->identity);
}

/* Refuses a factor whose last change has failed. */
SLI_INLINE sl_status sli_factor_has_numbers(const sl_factor *F) {
    return F->is_valid
               ? SL_OK
               : sli_refuse(SL_ERR_STALE, "F has no numbers: its last factorization has failed");
}

/* Entries of the inverse are computed with a diagonal D only. */
SLI_INLINE sl_status sli_inverse_check(const sl_factor *F) {
    const sl_status status = sli_factor_has_numbers(F);
    return status == SL_OK && F->E != NULL
               ? sli_refuse(SL_ERR_UNSUPPORTED, "entries of the inverse with 2x2 pivots")
               : status;
}

/* Refuses to change an object whose numbers are in mapped memory or whose analysis is not whole. */
SLI_COLD static sl_status sli_refuse_mapped(void) {
    return sli_refuse(SL_ERR_READ_ONLY, "it is mapped (sl_load copies without SL_LOAD_MAPPED), of "
                                        "sl_factor_submatrix, or saved by a newer version");
}

/* May the numbers of F change? */
SLI_INLINE sl_status sli_factor_may_change(const sl_factor *F) {
    return F->is_immutable ? sli_refuse_mapped() : SL_OK;
}

/* Fills in a failure and returns its status. */
SLI_INLINE sl_status sli_fail(sli_failure *f, sl_status status, sl_int super, sl_int pivot,
                              sl_off position, double value) {
    f->status = status;
    f->super = super;
    f->pivot = pivot;
    f->position = position;
    f->value = value;
    f->bound = 0.0;
    return status;
}

SLI_INLINE void sli_keep_first_failure(sli_failure *f, const sli_failure *other) {
    if (other->status != SL_OK && (f->status == SL_OK || other->super < f->super)) {
        *f = *other;
    }
}

/* Columns of F->center. */
SLI_INLINE sl_int sli_center_count(const sl_factor *F) {
    return F->null.vectors > 1 ? 2 * F->null.vectors : 1;
}

/* Are null pivots skipped? */
SLI_INLINE int sli_skips_nulls(const sl_factor *F) {
    return F->null.calls != NULL;
}

/* Was pivot k null and skipped? */
SLI_INLINE int sli_is_skipped(const sl_factor *F, sl_int k) {
    return sli_skips_nulls(F) && F->D[k] == SLI_NULL_PIVOT;
}

/* The column of g that holds the null vector of null pivot k; -1: it is not known, or k is a row of
 * zeros. */
SLI_INLINE sl_int sli_null_column(const sl_factor *F, sl_int k) {
    sl_int j = 0;
    while (j < F->null.vectors && F->null.g[(size_t)k + (size_t)j * (size_t)F->S->n] == 0.0) {
        j++;
    }
    return j < F->null.vectors ? j : -1;
}

/* Was pivot k changed by regularization? */
SLI_INLINE int sli_is_regularized(const sl_factor *F, sl_int k) {
    return F->rule.shifts != NULL && F->rule.shifts[k] != 0.0;
}

/* Beyond this drift F is refactored, after some 40,000 changes of moderate size, and a saved factor
 * has it as growth. */
#define SLI_CHANGE_DRIFT 1e-11

#endif

/* factor_types.h: the factor object, and what both methods share: panel loading, pivot checks */
#ifndef SLI_FACTOR_FACTOR_TYPES_H
#define SLI_FACTOR_FACTOR_TYPES_H

#include "../matrix/csc.h"
#include "../analysis/schedule.h"
#include "../kernels/dispatch.h"
#include "../base/status.h"

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
} sli_failure;

#define SLI_NULL_VECTORS_MAX 32

/* Row i of A z. A cache line holds two: the product may visit rows at random. */
typedef struct sli_null_row {
    double z;
    double product; /* (A z)(i) */
    double size;    /* (|A| |z|)(i) */
    sl_int entries; /* entries of the row */
    sl_int up;      /* a later pivot's row in the component; i itself: the last one */
} sli_null_row;

/* What a supernode contributes to pivot growth (growth.h). */
typedef struct sli_extent {
    double entry;     /* the largest |a| in its columns */
    double magnitude; /* the largest sum of magnitudes that one of its pivots was computed from */
    sl_int pivot;     /* that pivot; -1: all magnitudes are 0 */
    sl_int zero;      /* instead of padding: saved factors have no undefined bytes */
} sli_extent;

struct sl_factor {
    sl_allocator allocator;
    sl_stats stats;       /* the factor group and the error group */
    const sl_symbolic *S; /* borrowed */
    const sli_kernels *kernels;
    sli_pivot_rule rule;
    sl_null_pivots null_pivots;
    sl_method method;
    int is_valid;     /* L and D hold a factor */
    int is_immutable; /* L, D and the other arrays are those of a mapped file */
    void *scratch;    /* the block of all scratch arrays; NULL: not allocated yet */
    sl_status status; /* of the last factorization */
    /* of L and D: the analysis, the values of A or of the sum, and the pivots; what depends on the
     * numbers keeps it */
    sli_hash identity;
    /* counts factorizations and changes, also those that give the same numbers again */
    uint64_t generation;
    double clock; /* when its memory was there */
    sl_off updates; /* rank-one changes since the last complete factorization */
    double drift;   /* the rounding errors that they have added, relative to the largest entry */
    double scale;   /* of the matrix as they have changed it: the largest entry, or less */
    double lowest;  /* the least that it has been */
    sli_hash analysis;  /* the identity of S */
    sl_storage storage; /* of L */
    void *values;       /* L: the panels of all supernodes, as they are stored */
    double *panels;     /* scratch for panels that are not stored in double, one a worker */
    sl_off panel_room;   /* doubles of such a piece */
    double *D;           /* n pivots */
    double *E;           /* n: D(k+1, k) at the first column k of a 2x2 pivot; NULL: none */
    sli_extent *extents; /* n_supers */
    double growth_limit; /* a larger growth is refused */
    double error_limit;  /* a refinement that ends above it is reported */
    /* n: the pivots that regularization changed, ascending; NULL: no regularization */
    sl_int *regularized;

    /* null pivots */
    double consistency; /* the bound on |z' b| relative to the sum of |b|; negative: no check */
    int checks;         /* there are null pivots, and solves check that b is consistent */
    int is_centered;    /* there are null pivots, and solves center x by the weights in mass */
    sl_int n_nulls;
    sl_int *nulls; /* n: the n_nulls skipped pivots, ascending */
    sl_int n_anchors;
    /* components: null pivots whose null vectors the weights fix, ascending, at most one a tree */
    sl_int *anchors;
    double *mass;        /* n: the weights m in pivot order; NULL: none */
    sl_int null_vectors; /* columns of z and g */
    double *z;           /* n x null_vectors: the assumed null vectors of all components */
    /* n x null_vectors: one: z in trees with one component whose null vector is known, else 0;
     * several: the null vectors that are known, 1 in one anchor each and 0 in the others */
    double *g;
    int has_duplicates; /* of the pattern; known with the scratch arrays */
    sli_null_row *rows; /* n: scratch */
    sl_int *last;       /* n: scratch, the last pivot of each component */
    double *rounding;   /* n: scratch for the rule */
    /* scratch where there are several null vectors (null_basis.h): n: the pivot before in the
     * component, -1 at the first one; the entries of each row of A; n x (null_vectors + 2): A z,
     * |A| |z| and the diagonal of A */
    sl_int *chain, *row_entries;
    double *products;
    /* n: v = D^+ w, w = L^-1 P m / z' m, D^+ the pseudo-inverse of D (nullspace.h); where there are
     * several null vectors, n x 2 null_vectors: U and V (null_center.h) */
    double *center;
    double *squares; /* components: w' D^+ w of the tree of each anchor */
    double *ratios;  /* components: (e' L^-1 P m) / z' m for known z; 0: z is computed from L */
    /* n: the divisors of the backward sweep: D, with 1 at the anchors, where it is given x itself,
     * and in 2x2 pivots, which are applied before it; read if is_centered or with pairs */
    double *divisors;
    double *center_scratch;
    double *buffer; /* kernel scratch, one piece a worker */
    /* n_supers: a hash of the entries of A that each supernode was computed from; 0: not known */
    uint64_t *marks;
    const struct sli_kept *kept; /* supernodes that are copied in this factorization, or NULL */

    /* multifrontal; scratch arrays hold one piece a worker */
    sl_threads threads;
    sli_schedule schedule;
    double *stack; /* the update stack: update matrices until their parents assemble them */
    /* rows of the tallest front: the sum of the magnitudes that went into each diagonal entry */
    double *magnitude;
    double *reciprocals;   /* SLI_FRONT_RECIPROCALS */
    sli_failure *failures; /* the first failure of a worker */

    /* up-looking */
    double *x;        /* n: row k while it is computed; all 0 between rows */
    sl_int *head;     /* n: the first supernode whose next row is k, -1 for none */
    sl_int *next;     /* n_supers: the next supernode in the same list, -1 at the end */
    sl_int *position; /* n_supers: how many rows below each supernode are computed */
    uint64_t *list;   /* n_supers: the supernodes in the reach of row k */
    uint64_t *list_scratch;
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

/* Is F a factor over the analysis S, with this identity? Also false if the analysis of F was
 * released and another one created at its address. */
SLI_INLINE int sli_factor_is_over(const sl_factor *F, const sl_symbolic *S, sli_hash identity) {
    return F->S == S && sli_hash_equals(F->analysis, S->identity) &&
           sli_hash_equals(identity, S->identity);
}

/* Entries of the inverse are computed with a diagonal D only. */
SLI_INLINE sl_status sli_inverse_check(const sl_factor *F) {
    return !F->is_valid ? SL_ERR_STATE : F->E != NULL ? SL_ERR_UNSUPPORTED : SL_OK;
}

/* May the numbers of F change, and is its analysis still there? */
SLI_INLINE int sli_factor_may_change(const sl_factor *F) {
    return !F->is_immutable && sli_factor_is_over(F, F->S, F->analysis);
}

/* Fills in a failure and returns its status. */
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

/* Returns the column of A that holds position p. */
static sl_int sli_column_of(const sl_csc *A, sl_int p) {
    sl_int low = 0, high = A->n_cols - 1;
    while (low < high) { /* finds the last column that begins at or before p */
        const sl_int middle = low + (high - low + 1) / 2;
        if (A->p[middle] <= p) {
            low = middle;
        } else {
            high = middle - 1;
        }
    }
    return low;
}

/* The rounding unit of fronts. */
SLI_INLINE double sli_epsilon(sl_storage storage) {
    return storage == SL_STORAGE_FLOAT_FRONTS ? (double)FLT_EPSILON : DBL_EPSILON;
}

/* Are fronts computed in float? */
SLI_INLINE int sli_is_single(const sl_factor *F) {
    return F->storage == SL_STORAGE_FLOAT_FRONTS;
}

/* Is L kept in float? */
SLI_INLINE int sli_is_float(const sl_factor *F) {
    return F->storage == SL_STORAGE_FLOAT || sli_is_single(F);
}

/* Is only the first column of each pair computed and kept, as the second one is i times that? */
SLI_INLINE int sli_is_complex(const sl_factor *F) {
    return F->storage == SL_STORAGE_COMPLEX;
}

/* The panel of supernode s in double, while a worker factors it. */
SLI_INLINE double *sli_front_panel(const sl_factor *F, sl_int s, sl_int worker) {
    return sli_is_float(F) ? F->panels + F->panel_room * worker
                           : (double *)F->values + (F->S->steps[s].panel >> sli_is_complex(F));
}

/* The largest entry of A and sum of magnitudes, and the smallest sum, of fronts in float. Products
 * of pivots and entries of L then neither overflow nor lose more by underflow than by rounding. */
#define SLI_SINGLE_MOST (0.25 * (double)FLT_MAX)
#define SLI_SINGLE_LEAST 7.888609052210118e-31 /* 2^-100 */

/* An entry of A in float. None becomes 0, which would hide that its row is too small. */
SLI_INLINE float sli_single(double a) {
    const float x = (float)a;
    return x != 0.0F || a == 0.0 ? x : a < 0.0 ? -FLT_MIN : FLT_MIN;
}

/* A's entries are read in the order of the map, which processors do not foresee. */
#define SLI_ENTRIES_AHEAD 32

/* What entry a at this place of a panel adds to the mark of its supernode, which so does not depend
 * on the order of the entries. */
SLI_INLINE uint64_t sli_mark_entry(double a, sl_off place) {
    uint64_t bits;
    memcpy(&bits, &a, sizeof bits);
    return sli_fold(sli_fold(bits ^ SLI_HASH_1, (uint64_t)place + SLI_HASH_2), SLI_HASH_3);
}

/* The mark of a supernode without entries. */
#define SLI_MARK_BEGIN SLI_HASH_4

/* Adds the entries first .. last-1 of the scatter map to the panel of supernode s, in double or, if
 * that is NULL, in float, and records the largest magnitude, which may not exceed `most`. is_half:
 * the panel has the first columns of pairs only. marks: gets the mark of what is added, or NULL.
 * With scatter_from, x is the value array of A and scatter_from[m] the position of entry m;
 * without, x[0] is the value of entry `first`. */
SLI_ALWAYS_INLINE sl_status sli_panel_load_entries(const sl_factor *F, sl_int s, double *panel,
                                                   float *single, int is_half, double most,
                                                   uint64_t *marks, sl_off first, sl_off last,
                                                   const double *x, const sl_int *scatter_from,
                                                   sli_failure *failure) {
    const sl_off *to = F->S->scatter_to, begin = F->S->steps[s].panel;
    const sl_off ahead = F->S->scatter_begin[F->S->n_supers] - SLI_ENTRIES_AHEAD;
    double largest = F->extents[s].entry;
    uint64_t mark = 0;
    sl_off m;
    for (m = first; m < last; m++) {
        if (scatter_from != NULL && m < ahead) { /* untested: constant */
            SLI_PREFETCH(x + scatter_from[m + SLI_ENTRIES_AHEAD], 0);
        }
        const double a =
            scatter_from != NULL ? x[scatter_from[m]] : x[m - first]; /* untested: constant */
        const double size = fabs(a);
        if (!(size <= most)) {
            const sl_status status = /* untested: finite only in float */
                sli_is_finite(a) ? SL_ERR_INACCURATE : SL_ERR_NOT_FINITE; /* untested: the same */
            return sli_fail(failure, status, s, -1, m, a);
        }
        if (panel == NULL) { /* untested: constant */
            single[to[m] - begin] += sli_single(a);
        } else if (is_half) { /* untested: constant */
            if ((to[m] & SLI_TILE) == 0) { /* untested: constant where is_half is 0 */
                panel[sli_half_at(to[m] - begin)] += a;
            }
        } else {
            panel[to[m] - begin] += a;
        }
        if (marks != NULL) { /* untested: constant in float */
            mark += sli_mark_entry(a, to[m] - begin);
        }
        largest = size > largest ? size : largest;
    }
    F->extents[s].entry = largest;
    if (marks != NULL) { /* untested: the same */
        marks[s] += mark;
    }
    return SL_OK;
}

#define SLI_SUM_ENTRIES 64 /* entries that are summed at a time; most supernodes have no more */

/* sums := the weighted sums of the map's entries first .. first+count-1 */
static void sli_source_sum(const sli_source *from, sl_off first, sl_int count, double *sums) {
    sl_int k, t;
    memset(sums, 0, (size_t)count * sizeof(double));
    for (t = 0; t < from->terms; t++) {
        const double c = from->coefficients[t], *v = from->values[t] + first;
        for (k = 0; k < count; k++) {
            const double product = c * v[k]; /* rounded, as in a sum that the caller computes */
            sums[k] += product;
        }
    }
}

/* Adds the matrix's entries to the panel of supernode s, in double or, if NULL, in float. */
static sl_status sli_panel_load(const sl_factor *F, const sli_source *from, sl_int s, double *panel,
                                float *single, sli_failure *failure) {
    const sl_symbolic *S = F->S;
    const sl_off end = S->scatter_begin[s + 1];
    sl_off m = S->scatter_begin[s], last;
    double sums[SLI_SUM_ENTRIES];
    sl_status status = SL_OK;
    F->extents[s].entry = F->extents[s].magnitude = 0.0;
    F->extents[s].pivot = -1;
    F->extents[s].zero = 0;
    if (F->marks != NULL) {
        F->marks[s] = SLI_MARK_BEGIN;
    }
    if (from->A != NULL && panel == NULL) {
        return sli_panel_load_entries(F, s, NULL, single, 0, SLI_SINGLE_MOST, NULL, m, end,
                                      from->A->x, S->scatter_from, failure);
    }
    if (from->A != NULL && sli_is_complex(F)) {
        return sli_panel_load_entries(F, s, panel, NULL, 1, DBL_MAX, F->marks, m, end, from->A->x,
                                      S->scatter_from, failure);
    }
    if (from->A != NULL) {
        return sli_panel_load_entries(F, s, panel, NULL, 0, DBL_MAX, F->marks, m, end, from->A->x,
                                      S->scatter_from, failure);
    }
    for (; m < end && status == SL_OK; m = last) {
        last = end - m < SLI_SUM_ENTRIES ? end : m + SLI_SUM_ENTRIES;
        sli_source_sum(from, m, (sl_int)(last - m), sums);
        if (panel == NULL) {
            status = sli_panel_load_entries(F, s, NULL, single, 0, SLI_SINGLE_MOST, NULL, m, last,
                                            sums, NULL, failure);
        } else {
            status = sli_panel_load_entries(F, s, panel, NULL, 0, DBL_MAX, F->marks, m, last, sums,
                                            NULL, failure);
        }
    }
    return status;
}

/* Columns of F->center. */
SLI_INLINE sl_int sli_center_count(const sl_factor *F) {
    return F->null_vectors > 1 ? 2 * F->null_vectors : 1;
}

/* Was pivot k null and skipped? */
SLI_INLINE int sli_is_skipped(const sl_factor *F, sl_int k) {
    return F->null_pivots == SL_NULL_PIVOT_SKIP && F->D[k] == SLI_NULL_PIVOT;
}

/* Was pivot k changed by regularization? */
SLI_INLINE int sli_is_regularized(const sl_factor *F, sl_int k) {
    return F->rule.shifts != NULL && F->rule.shifts[k] != 0.0;
}

/* Keeps the largest sum of magnitudes that a pivot k of supernode s was computed from. */
SLI_INLINE void sli_record_magnitude(const sl_factor *F, sl_int s, sl_int k, double magnitude) {
    if (magnitude > F->extents[s].magnitude) {
        F->extents[s].magnitude = magnitude;
        F->extents[s].pivot = k;
    }
}

/* Records the magnitudes that pivot k of supernode s was computed from. Refuses a pivot that is not
 * finite, or one that is null against these magnitudes and was not replaced. */
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
        !(pivot * F->rule.signs[k] > 0.0)) { /* indefinite */
        return sli_fail(failure, SL_ERR_PIVOT, s, k, -1, pivot);
    }
    return SL_OK;
}

/* The same for a pivot of a front in float, and stores it. Refuses what float cannot tell from
 * rounding: a kept pivot of a semidefinite matrix, too, is regular in double but not here. */
SLI_INLINE sl_status sli_check_single(const sl_factor *F, sl_int s, sl_int k, float pivot,
                                      float magnitude, sli_failure *failure) {
    const int is_null = F->null_pivots == SL_NULL_PIVOT_SKIP && pivot == FLT_MAX;
    const double d = is_null ? SLI_NULL_PIVOT : (double)pivot, m = (double)magnitude;
    F->D[k] = d;
    if (!(m <= SLI_SINGLE_MOST) || (!is_null && m != 0.0 && m < SLI_SINGLE_LEAST)) {
        return sli_fail(failure, SL_ERR_INACCURATE, s, k, -1, d);
    }
    if (!is_null && F->rule.kinds != NULL && F->rule.kinds[k] == SLI_PIVOT_WEAK) {
        sli_record_magnitude(F, s, k, m);
        return sli_fail(failure, SL_ERR_PIVOT, s, k, -1, d);
    }
    return sli_check_pivot(F, s, k, d, m, failure);
}

/* At the first column k of a 2x2 pivot of supernode s: records the magnitudes that both columns
 * were computed from, and refuses a pivot that is not finite or null. */
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
    for (r = 0; r < 2; r++) { /* e does not show in the magnitudes */
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

/* The eigenvalues of the 2x2 pivot of columns k, k+1, the one of larger magnitude first. */
SLI_INLINE void sli_pair_eigenvalues(const sl_factor *F, sl_int k, double *values) {
    const double a = F->D[k], b = F->D[k + 1], e = F->E[k];
    const double middle = 0.5 * a + 0.5 * b, half = 0.5 * a - 0.5 * b;
    const double size = fabs(half) > fabs(e) ? fabs(half) : fabs(e);
    const double x = size > 0.0 ? half / size : 0.0, y = size > 0.0 ? e / size : 0.0;
    const double radius = size * sqrt(x * x + y * y);
    values[0] = middle < 0.0 ? middle - radius : middle + radius;
    /* the product of both is the determinant; their difference would cancel */
    values[1] = a * (b / values[0]) - e * (e / values[0]);
}

/* Counts one eigenvalue of D by its sign, and records its magnitude. */
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

/* Counts the first pivots by sign and records their least and largest magnitude. */
static void sli_count_pivots(sl_factor *F, sl_int count) {
    sl_factor_info info = F->stats.factor; /* in registers: 3 times as fast */
    sl_int k;
    info.positive = info.negative = info.null = info.regularized = info.weak = 0;
    info.pivot_min = info.pivot_max = 0.0;
    for (k = 0; k < count; k++) {
        double values[2] = {F->D[k], 0.0};
        int v, n_values = 1;
        if (sli_is_skipped(F, k)) {
            info.null++;
            continue;
        }
        info.weak += F->rule.kinds != NULL && F->rule.kinds[k] == SLI_PIVOT_WEAK;
        if (sli_is_regularized(F, k)) {
            F->regularized[info.regularized++] = k;
        }
        if (F->E != NULL && F->S->pairs[k] != SLI_PAIR_NONE) {
            n_values = F->S->pairs[k] == SLI_PAIR_FIRST ? 2 : 0;
            if (n_values > 0) {
                sli_pair_eigenvalues(F, k, values);
            }
        }
        for (v = 0; v < n_values; v++) {
            sli_count_pivot(&info, values[v]);
        }
    }
    F->stats.factor = info;
}

#endif

/* sparse_local_symmetric.h: solves any sparse symmetric system, definite, indefinite or singular
 *
 *     #define SL_WITH_PIVOTS
 *     #include "sparse_local.h"
 *     #include "sparse_local_symmetric.h"                C99 or C++, no other file
 *
 *     status = sl_symmetric_create(&S, &A, NULL, &stats);
 *     status = sl_symmetric_solve(S, x, n, b, n, 1, &stats);   SL_OK: its backward error is small
 *     status = sl_symmetric_inertia(S, &inertia, &stats);
 *
 * A is scaled by powers of two first. Then three ways are tried, each only where the one before it
 * has failed:
 *
 *     SL_SYMMETRIC_FIXED     L D L' with a diagonal D, in an order that is found from the pattern
 *     SL_SYMMETRIC_PIVOTED   1x1 and 2x2 pivots chosen by the values
 *     SL_SYMMETRIC_SINGULAR  the same of A + e I; refinement with A itself then finds a solution of
 *                            a consistent system
 *
 * A way has failed if a pivot is null, if pivot growth exceeds a limit, or if refinement does not
 * reach the backward error that SL_OK promises. What is done is kept: later solves begin there.
 *
 * [Ruiz01]: D. Ruiz, A scaling algorithm to equilibrate both rows and columns norms in matrices,
 * RAL-TR-2001-034.
 *
 * Temporary memory is from malloc. Errors have a text through stats only: sl_error_text(text,
 * sizeof text, status, &stats). */
#ifndef SPARSE_LOCAL_SYMMETRIC_H
#define SPARSE_LOCAL_SYMMETRIC_H

#include <float.h>
#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

/** SL_OK promises this backward error: componentwise, max_i |b - A x|_i / (|A| |x| + |b|)_i.
 *  Duplicates count one by one in |A|. Rows that scaling makes smaller than SL_SYMMETRIC_TINY times
 *  the largest one count as that: what they lack may be below the smallest double. */
#define SL_SYMMETRIC_ERROR 1e-12
/** The same of a singular A, relative to the largest row of the scaled system:
 *  max_i |b - A x|_i / max_i (|A| |x| + |b|)_i. */
#define SL_SYMMETRIC_SINGULAR_ERROR 1e-13
/** A fixed order whose growth is larger does not count eigenvalues. */
#define SL_SYMMETRIC_GROWTH 1e4

/** The three ways above. */
typedef enum sl_symmetric_way {
    SL_SYMMETRIC_FIXED,
    SL_SYMMETRIC_PIVOTED,
    SL_SYMMETRIC_SINGULAR
} sl_symmetric_way;

/** A matrix with what its solves have needed so far. */
typedef struct sl_symmetric {
    sl_symmetric_way way;
    sl_factor_info factor; /* of the last factorization: growth, seconds, bytes */
    /* what follows is private */
    sl_options opt; /* of the analysis */
    sl_isa isa;
    sl_csc A; /* scaled, in memory of this object */
    sl_triangle triangle;
    sl_csc shifted; /* the arrays of A + e I; NULL before they are needed */
    int *scale;     /* n: row and column k of the caller's A are multiplied by 2^scale[k] */
    sl_symbolic *S; /* of way FIXED; kept for new values */
    sl_factor *F;
    sl_work *W;
    sl_int *p, *i;
    double *x;
} sl_symmetric;

/** The eigenvalues of A by sign. Those of the scaled matrix up to `bound` count as zero; bound is 0
 *  where no pivot is small: the signs are then those of a matrix within rounding of A. */
typedef struct sl_inertia {
    sl_int positive, negative, zero;
    double bound;
} sl_inertia;

#define SL_SYMMETRIC_STEPS 20 /* of refinement: with A + e I it converges linearly */
#define SL_SYMMETRIC_BLOCK 8  /* right-hand sides that are refined together */
/* e, where the largest entry of each row is about 1 */
#define SL_SYMMETRIC_SHIFT 1e-11
/* |x| / |b|, both scaled: a singular system has such solutions, which satisfy it and say nothing;
 * those of A + e I are of an inconsistent b */
#define SL_SYMMETRIC_LARGEST 1e13
#define SL_SYMMETRIC_INCONSISTENT 1e8
#define SL_SYMMETRIC_TINY 1e-280

static inline sl_status sl_symmetric_refuse(sl_stats *stats, sl_status status, const char *what,
                                            sl_int row) {
    if (stats != NULL) {
        const sl_error error = {row, -1, -1, 0, what};
        stats->error = error;
    }
    return status;
}

static inline void *sl_symmetric_array(size_t count, size_t size) {
    return count < SIZE_MAX / size - 1 ? malloc((count + 1) * size) : NULL;
}

/* x 2^exponent, as ldexp, which is slow. */
static inline double sl_symmetric_times(double x, int exponent) {
    if (exponent < -1000 || exponent > 1000) {
        return ldexp(x, exponent);
    }
    const uint64_t bits = (uint64_t)(1023 + exponent) << 52;
    double power;
    memcpy(&power, &bits, sizeof power);
    return x * power;
}

/* |x| is 1/2 to 1 times 2^this; 0 for 0. As frexp. */
static inline int sl_symmetric_exponent(double x) {
    uint64_t bits;
    int exponent;
    memcpy(&bits, &x, sizeof bits);
    exponent = (int)(bits >> 52 & 2047) - 1022;
    if (exponent == -1022) {
        (void)frexp(x, &exponent);
    }
    return exponent;
}

static inline void sl_symmetric_free_shifted(sl_symmetric *M) {
    const sl_csc none = {0, 0, NULL, NULL, NULL};
    free((void *)(uintptr_t)M->shifted.p);
    free((void *)(uintptr_t)M->shifted.i);
    free((void *)(uintptr_t)M->shifted.x);
    M->shifted = none;
}

/** Releases it. */
static inline void sl_symmetric_free(sl_symmetric *M) {
    if (M != NULL) {
        sl_factor_free(M->F);
        sl_symbolic_free(M->S);
        sl_work_free(M->W);
        free(M->p);
        free(M->i);
        free(M->x);
        free(M->scale);
        sl_symmetric_free_shifted(M);
        free(M);
    }
}

/* Does the factorization read this entry? */
static inline int sl_symmetric_reads(const sl_symmetric *M, sl_int i, sl_int j) {
    return M->triangle == SL_TRIANGLE_UPPER ? i <= j : i >= j;
}

/* Takes the values of A, and scales them until the largest entry of each row is about 1 [Ruiz01].
 * Powers of two change no digit, and may exceed those of double. largest: n of scratch. */
static inline void sl_symmetric_scale(sl_symmetric *M, const double *x, double *largest) {
    const sl_int n = M->A.n_cols;
    int is_even = 0;
    memcpy(M->x, x, (size_t)M->p[n] * sizeof *x);
    memset(M->scale, 0, (size_t)n * sizeof *M->scale);
    for (int round = 0; round < 12 && !is_even; round++) {
        memset(largest, 0, (size_t)n * sizeof *largest);
        is_even = 1;
        for (sl_int j = 0; j < n; j++) {
            for (sl_int k = M->p[j]; k < M->p[j + 1]; k++) {
                if (sl_symmetric_reads(M, M->i[k], j)) {
                    const double size = fabs(M->x[k]);
                    largest[j] = fmax(largest[j], size);
                    largest[M->i[k]] = fmax(largest[M->i[k]], size);
                }
            }
        }
        for (sl_int k = 0; k < n; k++) {
            int exponent = sl_symmetric_exponent(largest[k]); /* a row of zeros stays as it is */
            exponent = exponent >= 0 ? -(exponent / 2) : (1 - exponent) / 2;
            is_even &= exponent == 0;
            M->scale[k] += exponent;
        }
        for (sl_int j = 0; j < n && !is_even; j++) {
            for (sl_int k = M->p[j]; k < M->p[j + 1]; k++) {
                M->x[k] = sl_symmetric_times(x[k], M->scale[j] + M->scale[M->i[k]]);
            }
        }
    }
}

/* The arrays of A, and room for one diagonal entry more in each column. */
static inline int sl_symmetric_make_shifted(sl_symmetric *M) {
    const sl_int n = M->A.n_cols;
    const size_t count = (size_t)M->p[n] + (size_t)n;
    sl_int *p = (sl_int *)sl_symmetric_array((size_t)n, sizeof *p);
    sl_int *i = (sl_int *)sl_symmetric_array(count, sizeof *i);
    double *x = (double *)sl_symmetric_array(count, sizeof *x);
    M->shifted = M->A;
    M->shifted.p = p;
    M->shifted.i = i;
    M->shifted.x = x;
    if (p == NULL || i == NULL || x == NULL || count > INT32_MAX) {
        sl_symmetric_free_shifted(M);
        return 0;
    }
    p[0] = 0;
    for (sl_int j = 0; j < n; j++) {
        const sl_int length = M->p[j + 1] - M->p[j];
        memcpy(i + p[j], M->i + M->p[j], (size_t)length * sizeof *i);
        i[p[j] + length] = j;
        p[j + 1] = p[j] + length + 1;
    }
    return 1;
}

/* Options of a factorization: with SL_VERIFY a call refuses those that it does not read. */
static inline sl_options sl_symmetric_numbers(const sl_symmetric *M) {
    sl_options opt = M->opt;
    opt.triangle = SL_TRIANGLE_NONE;
    opt.isa = M->isa;
    opt.growth_limit = 1e10;
    return opt;
}

/* Factors A + shift I by pivots chosen by its values. */
static inline sl_status sl_symmetric_factor_shifted(sl_symmetric *M, sl_factor **F, double shift,
                                                    sl_stats *stats) {
    const sl_int n = M->A.n_cols;
    sl_csc B = M->A;
    sl_symbolic *S = NULL;
    if (shift != 0) {
        if (M->shifted.p == NULL && !sl_symmetric_make_shifted(M)) {
            return sl_symmetric_refuse(stats, SL_ERR_MEMORY, NULL, -1);
        }
        B = M->shifted;
        double *x = (double *)(uintptr_t)B.x;
        for (sl_int j = 0; j < n; j++) {
            const sl_int length = M->p[j + 1] - M->p[j];
            memcpy(x + B.p[j], M->x + M->p[j], (size_t)length * sizeof *x);
            x[B.p[j] + length] = shift;
        }
    }
    sl_status status = sl_symbolic_create_pivoted(&S, &B, &M->opt, stats);
    if (status == SL_OK) {
        const sl_options opt = sl_symmetric_numbers(M);
        status = sl_factor_create(F, S, &B, &opt, stats);
    }
    sl_symbolic_free(S);
    return status;
}

/* Factors in the order of the pattern. */
static inline sl_status sl_symmetric_factor_fixed(sl_symmetric *M, sl_stats *stats) {
    sl_status status = SL_OK;
    if (M->F != NULL) {
        return sl_factor_refactor(M->F, &M->A, stats);
    }
    if (M->S == NULL) {
        status = sl_symbolic_create(&M->S, &M->A, &M->opt, stats);
    }
    const sl_options opt = sl_symmetric_numbers(M);
    return status == SL_OK ? sl_factor_create(&M->F, M->S, &M->A, &opt, stats) : status;
}

/* Factors in one way. A pivot within rounding of 0 counts as null. */
static inline sl_status sl_symmetric_factor(sl_symmetric *M, int way, sl_stats *stats) {
    sl_status status = SL_ERR_PIVOT;
    double rounding = 16 * DBL_EPSILON;
    if (way != SL_SYMMETRIC_FIXED || M->way != SL_SYMMETRIC_FIXED) {
        sl_factor_free(M->F);
        M->F = NULL;
    }
    M->way = (sl_symmetric_way)way;
    if (way == SL_SYMMETRIC_FIXED) {
        status = sl_symmetric_factor_fixed(M, stats);
    } else if (way == SL_SYMMETRIC_PIVOTED) {
        status = sl_symmetric_factor_shifted(M, &M->F, 0, stats);
    } else { /* an eigenvalue near -e needs another e */
        static const double shifts[4] = {SL_SYMMETRIC_SHIFT, -SL_SYMMETRIC_SHIFT,
                                         3 * SL_SYMMETRIC_SHIFT, -3 * SL_SYMMETRIC_SHIFT};
        int usable = -1;
        for (int k = 0; k < 5 && status == SL_ERR_PIVOT; k++) {
            const int e = k < 4 ? k : usable; /* at last one with a small pivot */
            if (e < 0) {
                break;
            }
            sl_factor_free(M->F);
            M->F = NULL;
            status = sl_symmetric_factor_shifted(M, &M->F, shifts[e], stats);
            if (status == SL_OK && k < 4 && stats->factor.pivot_min < 0.01 * fabs(shifts[e])) {
                status = SL_ERR_PIVOT;
                usable = usable < 0 ? e : usable;
            }
        }
    }
    if (status != SL_OK || way == SL_SYMMETRIC_SINGULAR) {
        return status;
    }
    rounding *= way == SL_SYMMETRIC_PIVOTED ? stats->factor.growth : 1;
    return stats->factor.pivot_min < rounding * stats->factor.entry_max ? SL_ERR_PIVOT : SL_OK;
}

/* Factors in the first way from `way` on that does not fail. */
static inline sl_status sl_symmetric_factor_from(sl_symmetric *M, int way, sl_stats *stats) {
    sl_status status = sl_symmetric_factor(M, way, stats);
    while ((status == SL_ERR_PIVOT || status == SL_ERR_INACCURATE || status == SL_ERR_NOT_FINITE) &&
           way < SL_SYMMETRIC_SINGULAR) { /* numbers of L may overflow where A is finite */
        status = sl_symmetric_factor(M, ++way, stats);
    }
    if (status == SL_OK) {
        M->factor = stats->factor;
    } else {
        sl_factor_free(M->F);
        M->F = NULL;
    }
    return status;
}

/** Takes new values of A, and begins with way FIXED again, in the same order.
 *
 *  M      [in,out]  unchanged after SL_ERR_OTHER_PATTERN, SL_ERR_NOT_FINITE and SL_ERR_ARGUMENT.
 *                   After another error it solves nothing until it has other values.
 *  A      [in]      the pattern of sl_symmetric_create, its entries in the same order.
 *  Returns  as sl_symmetric_create; SL_ERR_OTHER_PATTERN.
 *  Cost     of a factorization; with pivots chosen by the values, of an analysis, too.
 */
static inline sl_status sl_symmetric_refactor(sl_symmetric *M, const sl_csc *A, sl_stats *stats) {
    sl_stats own;
    stats = stats != NULL ? stats : &own;
    if (M == NULL || A == NULL) {
        return sl_symmetric_refuse(stats, SL_ERR_ARGUMENT, "M or A is NULL", -1);
    }
    const sl_int n = M->A.n_cols;
    if (A->n_cols != n || A->n_rows != n || A->p == NULL || A->x == NULL ||
        memcmp(A->p, M->p, ((size_t)n + 1) * sizeof *M->p) != 0 ||
        (M->p[n] > 0 && memcmp(A->i, M->i, (size_t)M->p[n] * sizeof *M->i) != 0)) {
        return sl_symmetric_refuse(stats, SL_ERR_OTHER_PATTERN, "A has another pattern", -1);
    }
    for (sl_int j = 0; j < n; j++) {
        for (sl_int k = M->p[j]; k < M->p[j + 1]; k++) {
            if (sl_symmetric_reads(M, M->i[k], j) && !(fabs(A->x[k]) <= DBL_MAX)) {
                return sl_symmetric_refuse(stats, SL_ERR_NOT_FINITE, "an entry of A", M->i[k]);
            }
        }
    }
    double *largest = (double *)sl_symmetric_array((size_t)n, sizeof *largest);
    if (largest == NULL) {
        sl_factor_free(M->F);
        M->F = NULL;
        return sl_symmetric_refuse(stats, SL_ERR_MEMORY, NULL, -1);
    }
    sl_symmetric_scale(M, A->x, largest);
    free(largest);
    return sl_symmetric_factor_from(M, SL_SYMMETRIC_FIXED, stats);
}

/** Scales and factors A.
 *
 *  out    [out]  the object; NULL on error.
 *  A      [in]   n x n, symmetric, one triangle or both, with values. It is copied.
 *  opt    [in]   allocator, threads, isa, triangle.
 *  stats  [out]  factor; the error.
 *  Returns  SL_OK, also for a singular A; SL_ERR_ARGUMENT: no values, not square;
 *           SL_ERR_NOT_FINITE: an entry; SL_ERR_MALFORMED; SL_ERR_TOO_LARGE; SL_ERR_MEMORY;
 *           SL_ERR_PIVOT: A + e I is singular, too, for each of four e.
 *  Cost     of one analysis and factorization for each way that is tried. Keeps a copy of A.
 *  Threads  exclusive use of the object in all calls.
 *  Source   scaling [Ruiz01]; pivots: sl_symbolic_create_pivoted
 */
static inline sl_status sl_symmetric_create(sl_symmetric **out, const sl_csc *A,
                                            const sl_options *opt, sl_stats *stats) {
    sl_stats own;
    sl_triangle triangle;
    stats = stats != NULL ? stats : &own;
    if (out == NULL) {
        return sl_symmetric_refuse(stats, SL_ERR_ARGUMENT, "out is NULL", -1);
    }
    *out = NULL;
    sl_options plain, reading;
    sl_options_init(&plain, sizeof plain);
    if (opt != NULL) {
        plain.allocator = opt->allocator;
        plain.threads = opt->threads;
    }
    reading = plain;
    reading.triangle = opt != NULL ? opt->triangle : SL_TRIANGLE_NONE;
    sl_status status = sl_csc_triangle(A, &triangle, &reading, stats);
    if (status == SL_OK && A->x == NULL) {
        status = sl_symmetric_refuse(stats, SL_ERR_ARGUMENT, "A has no values", -1);
    }
    if (status != SL_OK) {
        return status;
    }
    sl_symmetric *M = (sl_symmetric *)calloc(1, sizeof *M);
    if (M == NULL) {
        return sl_symmetric_refuse(stats, SL_ERR_MEMORY, NULL, -1);
    }
    const size_t n = (size_t)A->n_cols, count = (size_t)A->p[n];
    M->opt = reading;
    M->isa = opt != NULL ? opt->isa : SL_ISA_AUTO;
    M->triangle = triangle;
    M->p = (sl_int *)sl_symmetric_array(n, sizeof *M->p);
    M->i = (sl_int *)sl_symmetric_array(count, sizeof *M->i);
    M->x = (double *)sl_symmetric_array(count, sizeof *M->x);
    M->scale = (int *)sl_symmetric_array(n, sizeof *M->scale);
    status = M->p == NULL || M->i == NULL || M->x == NULL || M->scale == NULL
                 ? sl_symmetric_refuse(stats, SL_ERR_MEMORY, NULL, -1)
                 : sl_work_create(&M->W, &plain);
    if (status == SL_OK) {
        memcpy(M->p, A->p, (n + 1) * sizeof *M->p);
        if (count > 0) {
            memcpy(M->i, A->i, count * sizeof *M->i);
        }
        M->A.n_rows = M->A.n_cols = A->n_cols;
        M->A.p = M->p;
        M->A.i = M->i;
        M->A.x = M->x;
        status = sl_symmetric_refactor(M, A, stats);
    }
    if (status != SL_OK) {
        sl_symmetric_free(M);
        return status;
    }
    *out = M;
    return SL_OK;
}

static inline double sl_symmetric_limit(const sl_symmetric *M) {
    return M->way == SL_SYMMETRIC_SINGULAR ? SL_SYMMETRIC_SINGULAR_ERROR : SL_SYMMETRIC_ERROR;
}

/* r = b - A y. size: n of scratch. Returns the backward error: componentwise, or of a singular A
 * relative to the largest row, as rounding makes b inconsistent by that much. */
static inline double sl_symmetric_residual(const sl_symmetric *M, double *r, double *size,
                                           const double *y, const double *b) {
    const sl_int n = M->A.n_cols;
    double error = 0, largest = 0;
    for (sl_int k = 0; k < n; k++) {
        r[k] = b[k];
        size[k] = fabs(b[k]);
    }
    for (sl_int j = 0; j < n; j++) {
        for (sl_int k = M->p[j]; k < M->p[j + 1]; k++) {
            const sl_int i = M->i[k];
            if (!sl_symmetric_reads(M, i, j)) {
                continue;
            }
            r[i] -= M->x[k] * y[j];
            size[i] += fabs(M->x[k] * y[j]);
            if (i != j) {
                r[j] -= M->x[k] * y[i];
                size[j] += fabs(M->x[k] * y[i]);
            }
        }
    }
    for (sl_int k = 0; k < n; k++) {
        largest = fmax(largest, size[k]);
    }
    for (sl_int k = 0; k < n; k++) {
        const double of = M->way == SL_SYMMETRIC_SINGULAR
                              ? largest
                              : fmax(size[k], SL_SYMMETRIC_TINY * largest);
        const double e = r[k] == 0 ? 0 : fabs(r[k]) / of;
        error = fmax(error, e <= DBL_MAX ? e : INFINITY);
    }
    return error;
}

/* Solves for a block of columns, and refines them. All are scaled; work: four arrays of
 * Y's size, the first one B, and n more. worst: the largest backward error of a column. */
static inline sl_status sl_symmetric_refine(const sl_symmetric *M, double *work, sl_int columns,
                                            sl_int *steps, double *worst) {
    const size_t n = (size_t)M->A.n_cols, size = n * (size_t)columns;
    const double most =
        M->way == SL_SYMMETRIC_SINGULAR ? SL_SYMMETRIC_INCONSISTENT : SL_SYMMETRIC_LARGEST;
    double *B = work, *Y = B + size, *R = Y + size, *best = R + size, *sizes = best + size;
    double least[SL_SYMMETRIC_BLOCK], before[SL_SYMMETRIC_BLOCK];
    int step = 0, goes_on = 1;
    *worst = 0;
    sl_status status = sl_factor_solve(M->F, Y, n, B, n, columns, M->W);
    for (sl_int c = 0; c < columns; c++) {
        least[c] = before[c] = INFINITY;
    }
    while (status == SL_OK && goes_on) {
        goes_on = 0;
        for (sl_int c = 0; c < columns; c++) {
            const size_t at = n * (size_t)c;
            const double error = sl_symmetric_residual(M, R + at, sizes, Y + at, B + at);
            if (error < least[c]) {
                least[c] = error;
                memcpy(best + at, Y + at, n * sizeof *Y);
            }
            goes_on |= error > DBL_EPSILON && (step < 3 || error < 0.75 * before[c]);
            before[c] = error;
        }
        goes_on &= step++ < SL_SYMMETRIC_STEPS;
        if (status == SL_OK && goes_on) {
            status = sl_factor_solve(M->F, R, n, R, n, columns, M->W);
            for (size_t k = 0; k < size && status == SL_OK; k++) {
                Y[k] += R[k];
            }
        }
    }
    for (sl_int c = 0; c < columns; c++) {
        double b = 0, y = 0;
        for (size_t k = n * (size_t)c; k < n * (size_t)(c + 1) && least[c] <= DBL_MAX; k++) {
            Y[k] = best[k];
            b = fmax(b, fabs(B[k]));
            y = fmax(y, fabs(Y[k]));
        }
        least[c] = y > most * b ? INFINITY : least[c];
        *worst = least[c] < *worst ? *worst : least[c];
    }
    *steps = step > *steps ? step - 1 : *steps;
    return status;
}

/* Copies a block of right-hand sides, scaled: the largest number of column c is 2^top[c] times
 * 1/2 to 1. */
static inline sl_status sl_symmetric_take(const sl_symmetric *M, double *to, int *top,
                                          const double *B, size_t ldb, sl_int columns,
                                          sl_stats *stats) {
    const size_t n = (size_t)M->A.n_cols;
    for (sl_int c = 0; c < columns; c++) {
        const double *b = B + (size_t)c * ldb;
        int is_zero = 1;
        top[c] = 0;
        for (size_t k = 0; k < n; k++) {
            const int exponent = sl_symmetric_exponent(b[k]) + M->scale[k];
            if (!(fabs(b[k]) <= DBL_MAX)) {
                return sl_symmetric_refuse(stats, SL_ERR_NOT_FINITE, "an entry of B", (sl_int)k);
            }
            if (b[k] != 0 && (is_zero || exponent > top[c])) {
                top[c] = exponent;
                is_zero = 0;
            }
        }
        for (size_t k = 0; k < n; k++) {
            to[k + (size_t)c * n] = sl_symmetric_times(b[k], M->scale[k] - top[c]);
        }
    }
    return SL_OK;
}

/* Y as X holds it, where it underflows or overflows. Returns the larger one of worst and its
 * backward error. work: as that of sl_symmetric_refine. */
static inline double sl_symmetric_hold(const sl_symmetric *M, double *work, const int *top,
                                       sl_int columns, double worst) {
    const size_t n = (size_t)M->A.n_cols, size = n * (size_t)columns;
    for (sl_int c = 0; c < columns; c++) {
        double *b = work + n * (size_t)c, *y = b + size;
        int is_held = 1;
        for (size_t k = 0; k < n; k++) {
            const double value = sl_symmetric_times(y[k], M->scale[k] + top[c]);
            if (y[k] != 0 && !(fabs(value) >= DBL_MIN && fabs(value) <= DBL_MAX)) {
                const double held = sl_symmetric_times(value, -M->scale[k] - top[c]);
                is_held &= held == y[k];
                y[k] = held;
            }
        }
        if (!is_held) {
            const double error = sl_symmetric_residual(M, y + size, work + 4 * size, y, b);
            worst = error <= worst ? worst : error <= DBL_MAX ? error : INFINITY;
        }
    }
    return worst;
}

/** Solves A X = B by the first way that reaches SL_SYMMETRIC_ERROR. Of a singular A it finds a
 *  solution of each consistent system: about the shortest one of the scaled system.
 *
 *  X      [out]  n x nrhs by columns, leading dimension ldx >= n; may be B (then ldx = ldb).
 *                After SL_ERR_INACCURATE the best that was found.
 *  B      [in]   n x nrhs by columns, leading dimension ldb >= n.
 *  stats  [out]  refine: the largest backward error of a column.
 *  Returns  SL_OK; SL_ERR_INACCURATE: a column of B has no solution, or none that double holds;
 *           SL_ERR_NOT_FINITE: B at error.row; SL_ERR_ARGUMENT; SL_ERR_MEMORY;
 *           SL_ERR_STALE: sl_symmetric_refactor, or a way that a solve tried, has failed.
 *  Cost     of two to four solves with a factor; 20 where A is singular; and of the ways that are
 *           tried and not yet factored.
 */
static inline sl_status sl_symmetric_solve(sl_symmetric *M, double *X, size_t ldx, const double *B,
                                           size_t ldb, sl_int nrhs, sl_stats *stats) {
    sl_stats own;
    stats = stats != NULL ? stats : &own;
    if (M == NULL || nrhs < 0 || (nrhs > 0 && M->A.n_cols > 0 && (X == NULL || B == NULL)) ||
        (nrhs > 0 && ((ldx | ldb) & SL_ROW_MAJOR) != 0) ||
        (nrhs > 1 && (ldx < (size_t)M->A.n_cols || ldb < (size_t)M->A.n_cols ||
                      (X == B && ldx != ldb)))) {
        return sl_symmetric_refuse(stats, SL_ERR_ARGUMENT,
                                   "an array is NULL, nrhs negative, ldx or ldb below n or one of "
                                   "SL_ROWS, or X is B and ldx not ldb",
                                   -1);
    }
    if (M->F == NULL) {
        return sl_symmetric_refuse(stats, SL_ERR_STALE, "its last factorization has failed", -1);
    }
    const size_t n = (size_t)M->A.n_cols;
    const sl_int most = nrhs < SL_SYMMETRIC_BLOCK ? nrhs : SL_SYMMETRIC_BLOCK;
    double *work = (double *)sl_symmetric_array((4 * (size_t)most + 1) * n, sizeof *work),
           worst = 0;
    sl_status status = work == NULL ? SL_ERR_MEMORY : SL_OK;
    int top[SL_SYMMETRIC_BLOCK];
    sl_int steps = 0;
    (void)sl_symmetric_refuse(stats, status, NULL, -1);
    for (sl_int begin = 0; begin < nrhs && status == SL_OK; begin += most) {
        const sl_int columns = nrhs - begin < most ? nrhs - begin : most;
        status = sl_symmetric_take(M, work, top, B + (size_t)begin * ldb, ldb, columns, stats);
        double error = 0;
        int way = (int)M->way;
        if (status == SL_OK) {
            status = sl_symmetric_refine(M, work, columns, &steps, &error);
        }
        while (status == SL_OK && error > sl_symmetric_limit(M) && way < SL_SYMMETRIC_SINGULAR) {
            status = sl_symmetric_factor_from(M, way + 1, stats);
            way = (int)M->way;
            if (status == SL_OK) {
                status = sl_symmetric_refine(M, work, columns, &steps, &error);
            }
        }
        if (status == SL_OK) {
            error = sl_symmetric_hold(M, work, top, columns, error);
        }
        worst = error < worst ? worst : error;
        for (sl_int c = 0; c < columns && status == SL_OK; c++) {
            const double *y = work + n * (size_t)(columns + c);
            for (size_t k = 0; k < n; k++) {
                X[k + (size_t)(begin + c) * ldx] = sl_symmetric_times(y[k], M->scale[k] + top[c]);
            }
        }
    }
    free(work);
    stats->refine.steps = steps;
    stats->refine.backward_error = worst;
    return status != SL_OK || worst <= sl_symmetric_limit(M)
               ? status
               : sl_symmetric_refuse(stats, SL_ERR_INACCURATE,
                                     "B has no solution, or none that double holds", -1);
}

/** Counts the eigenvalues of A by sign (Sylvester: scaling changes no sign). Where a pivot is small
 *  they are those of A - e I and A + e I, e = bound.
 *
 *  out    [out]  their numbers.
 *  stats  [out]  the error.
 *  Returns  SL_OK; SL_ERR_ARGUMENT; SL_ERR_STALE as sl_symmetric_solve; SL_ERR_PIVOT: A is so close
 *           to singular for each e that no number is certain; SL_ERR_MEMORY.
 *  Cost     none where way FIXED has little growth and no small pivot; else of one to three
 *           analyses and factorizations.
 */
static inline sl_status sl_symmetric_inertia(sl_symmetric *M, sl_inertia *out, sl_stats *stats) {
    sl_stats own;
    sl_status status = SL_OK;
    stats = stats != NULL ? stats : &own;
    if (M == NULL || out == NULL) {
        return sl_symmetric_refuse(stats, SL_ERR_ARGUMENT, "M or out is NULL", -1);
    }
    if (M->F == NULL) {
        return sl_symmetric_refuse(stats, SL_ERR_STALE, "its last factorization has failed", -1);
    }
    if (M->way == SL_SYMMETRIC_FIXED && M->factor.growth > SL_SYMMETRIC_GROWTH) {
        status = sl_symmetric_factor_from(M, SL_SYMMETRIC_PIVOTED, stats);
    }
    if (status != SL_OK) {
        return status;
    }
    out->positive = M->factor.positive;
    out->negative = M->factor.negative;
    out->bound = 0;
    if (M->way == SL_SYMMETRIC_SINGULAR || M->factor.pivot_min < 1e-11 * M->factor.entry_max) {
        status = SL_ERR_PIVOT;
        for (double e = 1e-13; (status == SL_ERR_PIVOT || status == SL_ERR_INACCURATE) && e < 1e-9;
             e *= 8) {
            sl_factor *below = NULL, *above = NULL;
            status = sl_symmetric_factor_shifted(M, &below, -e, stats);
            out->positive = stats->factor.positive;
            if (status == SL_OK) {
                status = sl_symmetric_factor_shifted(M, &above, e, stats);
                out->negative = stats->factor.negative;
            }
            out->bound = e;
            sl_factor_free(below);
            sl_factor_free(above);
        }
    }
    out->zero = M->A.n_cols - out->positive - out->negative;
    return status;
}

#endif

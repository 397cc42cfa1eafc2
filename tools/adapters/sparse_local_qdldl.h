/* sparse_local_qdldl.h: the names of QDLDL 0.1: its calls, types and arrays, on sparse_local.h
 *
 *     echo '#include "sparse_local_qdldl.h"' >qdldl.h     and so qdldl_types.h, if it is included
 *
 *     #define SPARSE_LOCAL_QDLDL_IMPLEMENTATION           in one file
 *     #include "sparse_local_qdldl.h"
 *
 * Programs that include qdldl.h then compile without a changed line. They are linked with the
 * bodies of sparse_local.h, of which the core suffices. With QDLDL_LONG QDLDL_int is a long long,
 * with QDLDL_FLOAT QDLDL_float is a float, as in QDLDL; so they are with DLONG and with SFLOAT or
 * DFLOAT, by which SCS and older programs choose the types of their own arrays.
 *
 * A is given by its upper triangle in compressed columns, without duplicates. It is factored in its
 * own order: choose one of little fill. L, D and 1/D are written to arrays of the caller. L is
 * strictly lower triangular, its rows ascend, and solves read nothing else.
 *
 * Small systems are factored row by row and allocate nothing. Where columns of L are long, the
 * supernodal factorization of sparse_local.h is up to 25 times faster. It allocates; without memory
 * the factorization is by rows. To factor one pattern often, use sl_symbolic_create and
 * sl_factor_refactor instead, which keep the analysis and choose the order.
 *
 * Otherwise than with QDLDL, n = 0 is allowed. */
#ifndef SPARSE_LOCAL_QDLDL_H
#define SPARSE_LOCAL_QDLDL_H

#include <limits.h>

#if defined(QDLDL_LONG) || defined(DLONG)
typedef long long QDLDL_int;
#define QDLDL_INT_MAX LLONG_MAX
#else
typedef int QDLDL_int;
#define QDLDL_INT_MAX INT_MAX
#endif

#if defined(QDLDL_FLOAT) || defined(SFLOAT) || defined(DFLOAT)
typedef float QDLDL_float;
#else
typedef double QDLDL_float;
#endif

typedef unsigned char QDLDL_bool;

#define QDLDL_VERSION_MAJOR 0
#define QDLDL_VERSION_MINOR 1
#define QDLDL_VERSION_PATCH 8

#ifdef __cplusplus
extern "C" {
#endif

/** Elimination tree, and the number of entries of each column of L below the diagonal.
 *
 *  Ap, Ai  [in]   the upper triangle of A: n + 1 positions, Ap[n] rows. A diagonal entry may be
 *                 missing; an empty column may not.
 *  work    [out]  n, scratch.
 *  Lnz     [out]  n: entries of each column of L.
 *  etree   [out]  n: parents, -1 at a root.
 *  Returns  entries of L; -1: an empty column, or an entry below the diagonal; -2: more entries
 *           than QDLDL_int can count.
 */
QDLDL_int QDLDL_etree(QDLDL_int n, const QDLDL_int *Ap, const QDLDL_int *Ai, QDLDL_int *work,
                      QDLDL_int *Lnz, QDLDL_int *etree);

/** A = (L + I) diag(D) (L + I)'.
 *
 *  Ap, Ai, Ax  [in]   the upper triangle of A, with values.
 *  Lp          [out]  n + 1 positions.
 *  Li, Lx      [out]  rows and values, as many as QDLDL_etree has returned.
 *  D, Dinv     [out]  n pivots and their reciprocals.
 *  Lnz, etree  [in]   from QDLDL_etree.
 *  bwork, iwork, fwork  [out]  n, 3 n and n; scratch.
 *  Returns  the number of positive pivots; -1: a pivot is 0.
 */
QDLDL_int QDLDL_factor(QDLDL_int n, const QDLDL_int *Ap, const QDLDL_int *Ai, const QDLDL_float *Ax,
                       QDLDL_int *Lp, QDLDL_int *Li, QDLDL_float *Lx, QDLDL_float *D,
                       QDLDL_float *Dinv, const QDLDL_int *Lnz, const QDLDL_int *etree,
                       QDLDL_bool *bwork, QDLDL_int *iwork, QDLDL_float *fwork);

/** x = A^-1 x. */
void QDLDL_solve(QDLDL_int n, const QDLDL_int *Lp, const QDLDL_int *Li, const QDLDL_float *Lx,
                 const QDLDL_float *Dinv, QDLDL_float *x);

/** x = (L + I)^-1 x. */
void QDLDL_Lsolve(QDLDL_int n, const QDLDL_int *Lp, const QDLDL_int *Li, const QDLDL_float *Lx,
                  QDLDL_float *x);

/** x = (L + I)^-T x. */
void QDLDL_Ltsolve(QDLDL_int n, const QDLDL_int *Lp, const QDLDL_int *Li, const QDLDL_float *Lx,
                   QDLDL_float *x);

#ifdef __cplusplus
}
#endif

#endif /* SPARSE_LOCAL_QDLDL_H */

#ifdef SPARSE_LOCAL_QDLDL_IMPLEMENTATION
#ifndef SPARSE_LOCAL_QDLDL_IMPLEMENTED
#define SPARSE_LOCAL_QDLDL_IMPLEMENTED

#include "sparse_local.h"

#include <stdlib.h>

QDLDL_int QDLDL_etree(QDLDL_int n, const QDLDL_int *Ap, const QDLDL_int *Ai, QDLDL_int *work,
                      QDLDL_int *Lnz, QDLDL_int *etree) {
    QDLDL_int k, p, i, sum = 0;
    for (k = 0; k < n; k++) {
        if (Ap[k] == Ap[k + 1]) {
            return -1;
        }
        work[k] = k; /* the last row of L that has visited column k */
        Lnz[k] = 0;
        etree[k] = -1;
        for (p = Ap[k]; p < Ap[k + 1]; p++) {
            if (Ai[p] > k) {
                return -1;
            }
            for (i = Ai[p]; work[i] != k; i = etree[i]) { /* L(k,i) is not 0 */
                etree[i] = etree[i] < 0 ? k : etree[i];
                Lnz[i]++;
                work[i] = k;
            }
        }
    }
    for (k = 0; k < n; k++) {
        if (sum > QDLDL_INT_MAX - Lnz[k]) {
            return -2;
        }
        sum += Lnz[k];
    }
    return sum;
}

/* What a factorization reads and writes: the arguments of QDLDL_factor. */
typedef struct sl_qdldl_job {
    QDLDL_int n;
    const QDLDL_int *Ap, *Ai;
    const QDLDL_float *Ax;
    QDLDL_int *Lp, *Li;
    QDLDL_float *Lx, *D, *Dinv;
    const QDLDL_int *etree;
    QDLDL_bool *is_reached;  /* n, all 0 between rows */
    QDLDL_int *reach, *path; /* n */
    QDLDL_int *end;          /* n: where the next row of each column of L comes */
    QDLDL_float *y;          /* n: a row, or a column, of L */
} sl_qdldl_job;

/* The columns of row k of L: reach[top .. n-1], each one after its descendants in the tree. */
static QDLDL_int sl_qdldl_reach(const sl_qdldl_job *q, QDLDL_int k) {
    QDLDL_int top = q->n, p, i, length;
    for (p = q->Ap[k]; p < q->Ap[k + 1]; p++) {
        length = 0;
        for (i = q->Ai[p]; i >= 0 && i < k && !q->is_reached[i]; i = q->etree[i]) {
            q->is_reached[i] = 1;
            q->path[length++] = i;
        }
        while (length > 0) {
            q->reach[--top] = q->path[--length];
        }
    }
    return top;
}

/* Row by row: row k of L solves L(0:k-1,0:k-1) D l' = A(0:k-1,k). Returns the number of positive
 * pivots, or -1 at a pivot that is 0. */
static QDLDL_int sl_qdldl_by_rows(const sl_qdldl_job *q) {
    QDLDL_int k, p, at, j, positive = 0;
    for (k = 0; k < q->n; k++) {
        q->D[k] = 0;
        for (p = q->Ap[k]; p < q->Ap[k + 1]; p++) {
            *(q->Ai[p] == k ? &q->D[k] : &q->y[q->Ai[p]]) = q->Ax[p];
        }
        for (at = sl_qdldl_reach(q, k); at < q->n; at++) {
            QDLDL_float y;
            j = q->reach[at];
            y = q->y[j];
            for (p = q->Lp[j]; p < q->end[j]; p++) {
                q->y[q->Li[p]] -= q->Lx[p] * y; /* y(i) -= L(i,j) * y(j) */
            }
            q->Li[p] = k;
            q->Lx[p] = y * q->Dinv[j];
            q->D[k] -= y * q->Lx[p];
            q->end[j]++;
            q->y[j] = 0;
            q->is_reached[j] = 0;
        }
        if (q->D[k] == 0) {
            return -1;
        }
        q->Dinv[k] = 1 / q->D[k];
        positive += q->D[k] > 0;
    }
    return positive;
}

/* The rows of L, without values. */
static void sl_qdldl_pattern(const sl_qdldl_job *q) {
    QDLDL_int k, at;
    for (k = 0; k < q->n; k++) {
        for (at = sl_qdldl_reach(q, k); at < q->n; at++) {
            const QDLDL_int j = q->reach[at];
            q->Li[q->end[j]++] = k;
            q->is_reached[j] = 0;
        }
    }
}

/* Takes the values from the panels of F. Its order is a postorder of the tree, so that its L is the
 * caller's with rows and columns permuted. */
static void sl_qdldl_take(const sl_qdldl_job *q, const sl_factor *F) {
    const sl_factor_arrays f = sl_factor_view(F);
    const sl_symbolic_arrays s = sl_symbolic_view(f.symbolic);
    sl_int super, c, r, t;
    for (super = 0; super < s.n_supers; super++) {
        const sl_int first = s.super_first[super], w = s.super_first[super + 1] - first;
        const sl_int *below = s.rows + s.rows_begin[super];
        const sl_int rows = w + (sl_int)(s.rows_begin[super + 1] - s.rows_begin[super]);
        for (c = 0; c < w; c++) {
            const QDLDL_int j = s.perm[first + c];
            const double *tile = f.L + s.panel_begin[super];
            QDLDL_int p;
            for (t = 0; t < rows; t += 8) {
                const sl_int width = t + 8 < w ? t + 8 : w; /* columns of the tile */
                for (r = t; r < rows && r < t + 8 && c < width; r++) {
                    q->y[s.perm[r < w ? first + r : below[r - w]]] =
                        (QDLDL_float)tile[8 * c + r - t];
                }
                tile += 8 * (size_t)width;
            }
            for (p = q->Lp[j]; p < q->Lp[j + 1]; p++) {
                q->Lx[p] = q->y[q->Li[p]];
            }
            q->D[j] = (QDLDL_float)f.D[first + c];
            q->Dinv[j] = (QDLDL_float)(1 / f.D[first + c]);
        }
    }
}

/* A as sparse_local.h reads it, or p = NULL. */
static void sl_qdldl_copy(sl_csc *A, const sl_qdldl_job *q) {
    const size_t n = (size_t)q->n, count = (size_t)q->Ap[n];
    char *block =
        (char *)malloc(count * (sizeof(double) + sizeof(sl_int)) + (n + 1) * sizeof(sl_int));
    double *Ax = (double *)(void *)block;
    sl_int *Ap = (sl_int *)(void *)(block + count * sizeof(double)), *Ai = Ap + n + 1;
    size_t k;
    A->n_rows = A->n_cols = (sl_int)n;
    A->p = block == NULL ? NULL : Ap;
    A->i = Ai;
    A->x = Ax;
    for (k = 0; k <= n && block != NULL; k++) {
        Ap[k] = (sl_int)q->Ap[k];
    }
    for (k = 0; k < count && block != NULL; k++) {
        Ai[k] = (sl_int)q->Ai[k];
        Ax[k] = (double)q->Ax[k];
    }
}

/* By supernodes. Returns the number of positive pivots; -1: a pivot is 0 as a QDLDL_float; -2: it
 * cannot, or rounding decides about a pivot, and no array has changed. */
static QDLDL_int sl_qdldl_by_supernodes(const sl_qdldl_job *q) {
    QDLDL_int positive = -2, k;
    sl_options opt;
    sl_stats stats;
    sl_symbolic *S = NULL;
    sl_factor *F = NULL;
    sl_csc A;
    sl_qdldl_copy(&A, q);
    sl_options_init(&opt, sizeof opt);
    opt.ordering = SL_ORDERING_NATURAL;
    opt.triangle = SL_TRIANGLE_UPPER;
    /* A pivot that has cancelled to rounding errors, which earlier ones may have enlarged, has the
     * sign that the order of additions gives it: that of QDLDL, by rows. */
    opt.null_tolerance = 1e-10;
    opt.growth_limit = -1.0;
    if (A.p != NULL && sl_symbolic_create(&S, &A, &opt, NULL) == SL_OK &&
        sl_factor_create(&F, S, &A, &opt, &stats) == SL_OK) {
        positive = stats.factor.positive;
        sl_qdldl_pattern(q);
        sl_qdldl_take(q, F);
        for (k = 0; k < q->n; k++) {
            positive = q->D[k] == 0 ? -1 : positive;
        }
    }
    sl_factor_free(F);
    sl_symbolic_free(S);
    free((void *)A.x);
    return positive;
}

/* Supernodes gain where columns are long: their sum of squares is many times their sum. */
#ifndef SL_QDLDL_LONG_COLUMNS
#define SL_QDLDL_LONG_COLUMNS 50
#endif

QDLDL_int QDLDL_factor(QDLDL_int n, const QDLDL_int *Ap, const QDLDL_int *Ai, const QDLDL_float *Ax,
                       QDLDL_int *Lp, QDLDL_int *Li, QDLDL_float *Lx, QDLDL_float *D,
                       QDLDL_float *Dinv, const QDLDL_int *Lnz, const QDLDL_int *etree,
                       QDLDL_bool *bwork, QDLDL_int *iwork, QDLDL_float *fwork) {
    sl_qdldl_job q;
    double squares = 0;
    QDLDL_int k, positive = -2;
    q.n = n;
    q.Ap = Ap, q.Ai = Ai, q.Ax = Ax;
    q.Lp = Lp, q.Li = Li, q.Lx = Lx;
    q.D = D, q.Dinv = Dinv;
    q.etree = etree;
    q.is_reached = bwork, q.y = fwork;
    q.reach = iwork, q.path = iwork + n, q.end = iwork + 2 * n;
    Lp[0] = 0;
    for (k = 0; k < n; k++) {
        Lp[k + 1] = Lp[k] + Lnz[k];
        q.end[k] = Lp[k];
        bwork[k] = 0;
        fwork[k] = 0;
        squares += (double)Lnz[k] * (double)Lnz[k];
    }
    if (squares > SL_QDLDL_LONG_COLUMNS * (double)(Lp[n] + n) && Ap[n] <= INT32_MAX - 7) {
        positive = sl_qdldl_by_supernodes(&q);
    }
    return positive >= -1 ? positive : sl_qdldl_by_rows(&q);
}

void QDLDL_Lsolve(QDLDL_int n, const QDLDL_int *Lp, const QDLDL_int *Li, const QDLDL_float *Lx,
                  QDLDL_float *x) {
    QDLDL_int j, p;
    for (j = 0; j < n; j++) {
        for (p = Lp[j]; p < Lp[j + 1]; p++) {
            x[Li[p]] -= Lx[p] * x[j];
        }
    }
}

void QDLDL_Ltsolve(QDLDL_int n, const QDLDL_int *Lp, const QDLDL_int *Li, const QDLDL_float *Lx,
                   QDLDL_float *x) {
    QDLDL_int j, p;
    for (j = n - 1; j >= 0; j--) {
        QDLDL_float sum = x[j];
        for (p = Lp[j]; p < Lp[j + 1]; p++) {
            sum -= Lx[p] * x[Li[p]];
        }
        x[j] = sum;
    }
}

void QDLDL_solve(QDLDL_int n, const QDLDL_int *Lp, const QDLDL_int *Li, const QDLDL_float *Lx,
                 const QDLDL_float *Dinv, QDLDL_float *x) {
    QDLDL_int j;
    QDLDL_Lsolve(n, Lp, Li, Lx, x);
    for (j = 0; j < n; j++) {
        x[j] *= Dinv[j];
    }
    QDLDL_Ltsolve(n, Lp, Li, Lx, x);
}

#endif /* SPARSE_LOCAL_QDLDL_IMPLEMENTED */
#endif /* SPARSE_LOCAL_QDLDL_IMPLEMENTATION */

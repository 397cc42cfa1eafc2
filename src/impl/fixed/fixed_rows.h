/* fixed_rows.h: free and fixed rows, the entries of A between them, and what is copied of A */
#ifndef SLI_FIXED_ROWS_H
#define SLI_FIXED_ROWS_H

#include "../../public/fixed.h"
#include "../factor/factor.h"
#include "../matrix/csc_triangle.h"
#include "../matrix/submatrix.h"
#include "../solve/query.h"

struct sl_fixed {
    sl_allocator allocator;
    sl_options analysis, factorization; /* without arrays */
    sli_hash pattern;                   /* of A */
    sl_triangle triangle;               /* that is read of A */
    sl_int n, n_free, n_fixed, n_couplings;
    sl_int *free_rows;  /* n_free: ascending */
    sl_int *fixed_rows; /* n_fixed: in the order of the caller */
    /* n_couplings: entries of A between free and fixed rows: the numbers of both, the position in A
     * and the value */
    sl_int *coupling_free, *coupling_fixed, *coupling_from;
    double *couplings;
    sl_fixed_info info;

    sl_matrix *M; /* A[free, free] */
    sl_int *from; /* the positions of its entries in A */
    sl_symbolic *S;
    sl_factor *F;
    int is_stale; /* the last refactorization has refused its values */
};

/* Visits the entries of A between free and fixed rows. where: the number of a free row, or -1 minus
 * that of a fixed one. D NULL: only counts them. */
static sl_int sli_fixed_couple(sl_fixed *D, const sl_csc *A, sl_triangle triangle,
                               const sl_int *where) {
    sl_int j, p, count = 0;
    for (j = 0; j < A->n_cols; j++) {
        const sl_int c = where[j];
        for (p = A->p[j]; p < A->p[j + 1]; p++) {
            const sl_int r = where[A->i[p]];
            if ((r ^ c) >= 0 || !sli_is_read(triangle, A->i[p], j)) {
                continue;
            }
            if (D != NULL) {
                D->coupling_free[count] = sli_max(r, c);
                D->coupling_fixed[count] = -1 - sli_min(r, c);
                D->coupling_from[count] = p;
            }
            count++;
        }
    }
    return count;
}

/* Checks the values of the couplings. */
static sl_status sli_fixed_check_values(const sl_fixed *D, const sl_csc *A, sl_stats *stats) {
    sl_int k;
    for (k = 0; k < D->n_couplings; k++) {
        const sl_int p = D->coupling_from[k];
        if (!sli_is_finite(A->x[p])) {
            return sli_fail_at(stats, SL_ERR_NOT_FINITE, A->i[p], sli_column_of(A, p), A->x[p],
                               "an entry of A is not finite");
        }
    }
    return SL_OK;
}

static void sli_fixed_copy_values(sl_fixed *D, const sl_csc *A) {
    sl_int k;
    for (k = 0; k < D->n_couplings; k++) {
        D->couplings[k] = A->x[D->coupling_from[k]];
    }
    for (k = 0; D->M != NULL && k < D->M->p[D->n_free]; k++) {
        D->M->x[k] = A->x[D->from[k]];
    }
}

/* Reports an error of the system of free rows in rows of A. */
static sl_status sli_fixed_report(const sl_fixed *D, sl_status status, sl_stats *stats) {
    sl_error found;
    if (status == SL_OK) {
        return status;
    }
    found = sli_found(stats, status);
    if (status == SL_ERR_PIVOT && D->factorization.pivots != SL_PIVOTS_POSITIVE) {
        found.what = "the free rows are singular: fix a row of this component, or see "
                     "options.pivots and sl_symbolic_create_pivoted";
    }
    if (found.row >= 0) {
        found.row = D->free_rows[found.row];
    }
    if (found.column >= 0) {
        found.column = D->free_rows[found.column];
    }
    return sli_fail_as(stats, status, &found);
}

/* The arrays among the options, in free rows. */
typedef struct sli_fixed_arrays {
    sl_int *perm, *signs;
    double *mass, *null_vector;
} sli_fixed_arrays;

static void sli_fixed_arrays_layout(sli_fixed_arrays *r, sli_block *b, const sl_options *opt,
                                    sl_int n) {
    const uint64_t count = (uint64_t)n;
    r->perm =
        opt->ordering != SL_ORDERING_GIVEN || opt->perm == NULL ? NULL : SLI_TAKE(b, sl_int, count);
    r->signs = opt->signs == NULL ? NULL : SLI_TAKE(b, sl_int, count);
    r->mass = opt->mass == NULL ? NULL : SLI_TAKE(b, double, count);
    r->null_vector = opt->null_vector == NULL
                         ? NULL
                         : SLI_TAKE(b, double, count *(uint64_t)sli_max(opt->null_vector_count, 1));
}

/* Fills the arrays. scratch: n elements; where: as in sli_fixed_new. Refuses an order that
 * is not a permutation of all rows. */
static sl_status sli_fixed_arrays_fill(const sli_fixed_arrays *r, const sl_fixed *D,
                                       const sl_options *opt, const sl_int *where, sl_int *scratch,
                                       sl_stats *stats) {
    const sl_int m = D->n_free;
    const size_t vectors = (size_t)sli_max(opt->null_vector_count, 1);
    sl_int k, at = 0;
    size_t v;
    if (r->perm != NULL) {
        k = sli_rows_invert(opt->perm, D->n, D->n, scratch);
        if (k >= 0) {
            return sli_fail_at(stats, SL_ERR_ARGUMENT, k, -1, 0.0,
                               "options.perm has a row out of range or twice at this position");
        }
        for (k = 0; k < D->n; k++) {
            if (where[opt->perm[k]] >= 0) {
                r->perm[at++] = where[opt->perm[k]];
            }
        }
    }
    for (k = 0; k < m; k++) {
        const sl_int row = D->free_rows[k];
        if (r->signs != NULL) {
            r->signs[k] = opt->signs[row];
        }
        if (r->mass != NULL) {
            r->mass[k] = opt->mass[row];
        }
        for (v = 0; v < vectors && r->null_vector != NULL; v++) {
            r->null_vector[v * (size_t)m + (size_t)k] =
                opt->null_vector[v * (size_t)D->n + (size_t)row];
        }
    }
    return SL_OK;
}

/* Are blocks of so many rows either free or fixed as a whole? */
static int sli_fixed_keeps_blocks(const sl_fixed *D, sl_int size) {
    sl_int k;
    for (k = 0; k < D->n_free && size > 1; k++) {
        const sl_int first = D->free_rows[k - k % size];
        if (first % size != 0 || D->free_rows[k] != first + k % size) {
            return 0;
        }
    }
    return size > 1 && D->n_free % size == 0;
}

#endif

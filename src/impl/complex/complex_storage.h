/* complex_storage.h: L of a complex matrix: every other column of its real factor, in double */
#ifndef SLI_COMPLEX_COMPLEX_STORAGE_H
#define SLI_COMPLEX_COMPLEX_STORAGE_H

#include "../factor/multifrontal.h"
#include "complex_kernels.h"

/* With SL_STORAGE_COMPLEX the columns 2k of L are computed and kept, column by column as in double,
 * and the columns 2k + 1, which are i times those, are not: L has the blocks [a -b; b a]. The two
 * pivots of a block are equal, and the entry inside it is 0. A panel has an even number of columns
 * of 8 rows, so that the position of an entry says which of the two columns it is in. */

static double sli_complex_entry(const void *values, sl_off at) {
    const double *l = (const double *)values + at / (2 * SLI_TILE) * SLI_TILE;
    const sl_off lane = at % SLI_TILE;
    return at / SLI_TILE % 2 == 0 ? l[lane] : lane % 2 == 0 ? -l[lane + 1] : l[lane - 1];
}

/* The second columns of pairs are not there. */
static void sli_complex_entry_clear(void *values, sl_off at) {
    if (at / SLI_TILE % 2 == 0) {
        ((double *)values)[at / (2 * SLI_TILE) * SLI_TILE + at % SLI_TILE] = 0.0;
    }
}

/* Are these rows whole pairs 2a, 2a + 1, one after the other? */
static int sli_are_pairs(const sl_int *rows, sl_int count) {
    sl_int k;
    for (k = 0; k + 1 < count; k += 2) {
        if (rows[k] % 2 != 0 || rows[k + 1] != rows[k] + 1) {
            return 0;
        }
    }
    return k == count;
}

/* Do the rows of S come in pairs that share a supernode, next to each other? */
static int sli_rows_are_paired(const sl_symbolic *S) {
    sl_int s, is_paired = sli_are_pairs(S->perm, S->n);
    for (s = 0; s < S->n_supers && is_paired; s++) {
        const sli_step *step = &S->steps[s];
        is_paired = step->column % 2 == 0 && sli_are_pairs(S->rows + S->rows_begin[s], step->below);
    }
    return is_paired;
}

/* Has A the form of sl_matrix_from_hermitian? Its columns 2j + 1 are i times the columns 2j. */
static int sli_matrix_is_complex(const sl_csc *A) {
    sl_int j, p, q;
    for (j = 0; j + 1 < A->n_cols; j += 2) {
        const sl_int middle = A->p[j + 1], end = A->p[j + 2];
        for (p = A->p[j], q = middle; p < middle || q < end;) {
            const sl_int row = p < middle ? A->i[p] : A->i[q];
            if (row / 2 != j / 2) {
                if (row % 2 != 0 || p + 1 >= middle || q + 1 >= end || A->i[p + 1] != row + 1 ||
                    A->i[q] != row || A->i[q + 1] != row + 1 || A->x[q + 1] != A->x[p] ||
                    A->x[q] != -A->x[p + 1]) {
                    return 0;
                }
                p += 2;
                q += 2;
            } else { /* [a 0; 0 a], of which either 0 may be missing */
                const sl_int p_zero = p + 1 < middle && A->i[p + 1] == j + 1;
                const sl_int q_zero = q < end && A->i[q] == j;
                if (row != j || p >= middle || (p_zero && A->x[p + 1] != 0.0) ||
                    (q_zero && A->x[q] != 0.0) || q + q_zero >= end || A->i[q + q_zero] != j + 1 ||
                    A->x[q + q_zero] != A->x[p]) {
                    return 0;
                }
                p += 1 + p_zero;
                q += 1 + q_zero;
            }
        }
    }
    return 1;
}

/* Both columns of a pair are treated alike. */
static sl_status sli_complex_suits(const sl_factor *F) {
    if (!F->S->is_pivoted && sli_rows_are_paired(F->S) &&
        (!F->rule.replaces || F->null.vectors % 2 == 0)) { /* regularized: there is 1 */
        return SL_OK;
    }
    return sli_refuse(SL_ERR_UNSUPPORTED,
                      "SL_STORAGE_COMPLEX: blocks of 2 rows, 2 null vectors, not regularized");
}

static int sli_complex_keeps(const sl_int *rows, sl_int count, const sl_symbolic *S) {
    return sli_are_pairs(rows, count) && /* untested: the order keeps pairs together */
           sli_rows_are_paired(S);       /* untested: the same */
}

/* A number that is not finite has no equal: it is refused as with other storages. */
SLI_COLD static void sli_complex_accepts(const sl_symbolic *S, const sli_source *from,
                                         sli_failure *failure) {
    if (from->A == NULL || !sli_matrix_is_complex(from->A)) {
        (void)sli_fail(failure, SL_ERR_UNSUPPORTED, 0, -1, -1, 0.0);
        sli_entries_finite_check(S, from, failure);
    }
}

#define SLF_NAME(f) sli_complex_##f
#define SLF_HALF 1
#include "../factor/fronts.inl.h"
#include "../factor/fronts_undef.inl.h"

static sli_own_kernels sli_complex_own(const sli_kernels *kernels) {
    const sli_complex_kernels *table = sli_complex_kernels_of(kernels->isa);
    sli_own_kernels own;
    own.sweeps = table == NULL ? NULL : &table->sweeps;
    own.front = table == NULL ? NULL : &table->front;
    return own;
}

/* The same in double: of the same matrices. */
static const sli_storage_type sli_storage_complex_in_double = {
    SL_STORAGE_DOUBLE,   /* storage */
    sizeof(double),      /* value_bytes */
    0,                   /* half */
    &sli_double_fronts,  /* fronts */
    sli_double_own,      /* kernels */
    NULL,                /* store */
    NULL,                /* entry */
    NULL,                /* entry_clear */
    sli_complex_suits,   /* suits */
    sli_complex_accepts, /* accepts */
    sli_complex_keeps,   /* keeps */
    NULL                 /* in_double */
};

static const sli_storage_type sli_storage_complex = {
    SL_STORAGE_COMPLEX,            /* storage */
    sizeof(double),                /* value_bytes */
    1,                             /* half */
    &sli_complex_fronts,           /* fronts */
    sli_complex_own,               /* kernels */
    NULL,                          /* store */
    sli_complex_entry,             /* entry */
    sli_complex_entry_clear,       /* entry_clear */
    sli_complex_suits,             /* suits */
    sli_complex_accepts,           /* accepts */
    sli_complex_keeps,             /* keeps */
    &sli_storage_complex_in_double /* in_double */
};

#endif

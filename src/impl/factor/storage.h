/* storage.h: L in double, in float or as complex: sweeps over it, its entries, panels to store */
#ifndef SLI_FACTOR_STORAGE_H
#define SLI_FACTOR_STORAGE_H

#include "factor_types.h"

/* With SL_STORAGE_FLOAT each front is factored in double and its panel is rounded when the front is
 * done, so L exists in float only. Everything else is double: D, the update matrices, null pivots,
 * the growth, and the arithmetic of sweeps.
 *
 * L + G, |G| <= u |L|, u = 2^-24, is the factor of A + E, |E| <= 2 u |L| |D| |L'| and smaller
 * terms: a backward error of u times the growth. For a definite A more holds. With C = D^(1/2) L'
 * and H = D^(1/2) G' C^-1, A + E = C' (I + H)' (I + H) C. Refinement multiplies the error, in the
 * energy norm, by about 2 ||H||, which is of the order of u sqrt(cond A), not u cond A: the pivots,
 * which hold the smallest eigenvalues, are not rounded. */

/* With SL_STORAGE_COMPLEX the columns 2k of L are computed and kept, column by column as in double,
 * and the columns 2k + 1, which are i times those, are not: L has the blocks [a -b; b a]. The two
 * pivots of a block are equal, and the entry inside it is 0. A panel has an even number of columns
 * of 8 rows, so that the position of an entry says which of the two columns it is in. */

/* Which of the kernels' sweeps read L. */
SLI_INLINE const sli_sweeps *sli_sweeps_of(const sl_factor *F) {
    return &F->kernels->sweeps[sli_is_complex(F) ? 2 : sli_is_float(F)];
}

/* The sweeps of F's factorization: x := L^-1 x over steps, and x := L'^-1 D^-1 x. */
SLI_INLINE void sli_forward_sweep(const sl_factor *F, int kind, sl_int count, const sli_step *steps,
                                  const sl_int *rows, double *x, double *scratch) {
    sli_sweeps_of(F)->forward[kind](count, steps, rows, F->values, x, scratch);
}
SLI_INLINE void sli_backward_sweep(const sl_factor *F, int kind, sl_int count,
                                   const sli_step *steps, const sl_int *rows_end, const double *D,
                                   double *x, double *scratch) {
    sli_sweeps_of(F)->backward[kind](count, steps, rows_end, F->values, D, x, scratch);
}

/* The entry of L at a position of the panels. */
SLI_INLINE double sli_entry(const sl_factor *F, sl_off at) {
    if (sli_is_complex(F)) {
        const double *l = (const double *)F->values + at / (2 * SLI_TILE) * SLI_TILE;
        const sl_off lane = at % SLI_TILE;
        return at / SLI_TILE % 2 == 0 ? l[lane] : lane % 2 == 0 ? -l[lane + 1] : l[lane - 1];
    }
    return sli_is_float(F) ? (double)((const float *)F->values)[at]
                           : ((const double *)F->values)[at];
}

SLI_INLINE void sli_entry_clear(sl_factor *F, sl_off at) {
    if (sli_is_float(F)) {
        ((float *)F->values)[at] = 0.0F;
    } else {
        ((double *)F->values)[at] = 0.0;
    }
}

/* Does rounding harm the entry l of column j in local row r? An entry that underflows loses more
 * than the share u of itself. This changes A by up to 2^-150 |d_j l_kj| in that row and row k, and
 * |l_kj| <= sqrt(magnitude_k / |d_j|). It is within the bound, u sqrt(magnitude_r magnitude_k), if
 * 2^-150 sqrt(|d_j|) <= 2^-24 sqrt(magnitude_r). The column of a null pivot is never used. With
 * several null vectors it may have entries a, which leave a a' / SLI_NULL_PIVOT in other rows. */
SLI_INLINE int sli_rounding_harms(const sl_factor *F, const sli_front *f, sl_int r, sl_int j,
                                  double l) {
    const double d =
        f->E != NULL && f->E[j] != 0.0 ? fmax(fabs(f->D[j]), fabs(f->E[j])) : fabs(f->D[j]);
    if (fabs(l) > (double)FLT_MAX || d == SLI_NULL_PIVOT) {
        return d != SLI_NULL_PIVOT;
    }
    if (l == 0.0 || fabs(l) >= (double)FLT_MIN || ldexp(d, -252) <= f->magnitude[r]) {
        return 0;
    }
    return F->null_vectors <= 1 || f->magnitude[r] > ldexp(1.0, -900);
}

/* Rounds the panel of a front to float. Refuses what float cannot hold. */
static sl_status sli_panel_round(const sl_factor *F, const sli_front *f, sl_int s,
                                 sli_failure *failure) {
    const sl_int w = f->width, tiles = sli_tiles(w + f->below);
    float *to = (float *)F->values + F->S->steps[s].panel;
    const double *from = f->panel;
    sl_int t, j, r;
    for (t = 0; t < tiles; t++) {
        const sl_int columns = sli_min(w, SLI_TILE * (t + 1));
        for (j = 0; j < columns; j++, from += SLI_TILE, to += SLI_TILE) {
            int odd = 0;
            for (r = 0; r < SLI_TILE; r++) {
                const double size = fabs(from[r]);
                odd |= (size > (double)FLT_MAX) | ((size < (double)FLT_MIN) & (size > 0.0));
            }
            for (r = 0; r < SLI_TILE && odd; r++) {
                if (sli_rounding_harms(F, f, SLI_TILE * t + r, j, from[r])) {
                    return sli_fail(failure, SL_ERR_INACCURATE, s, F->S->steps[s].column + j, -1,
                                    f->D[j]);
                }
            }
            for (r = 0; r < SLI_TILE; r++) {
                to[r] = (float)from[r];
            }
        }
    }
    return SL_OK;
}

/* Stores the panel of a front that is done. */
static sl_status sli_panel_store(const sl_factor *F, const sli_front *f, sl_int s,
                                 sli_failure *failure) {
    return F->storage == SL_STORAGE_FLOAT ? sli_panel_round(F, f, s, failure) : SL_OK;
}

/* Copies the panel of supernode s, of a factor in another storage, to doubles. */
static void sli_panel_widen(const sl_factor *F, sl_int s, double *to) {
    const sl_off first = F->S->panel_begin[s], size = F->S->panel_begin[s + 1] - first;
    sl_off k;
    for (k = 0; k < size; k++) {
        to[k] = sli_entry(F, first + k);
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
        is_paired =
            step->column % 2 == 0 && sli_are_pairs(S->rows + S->rows_begin[s], step->below);
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

#endif

/* storage.h: L in double or in float: sweeps over it, its entries, panels that are rounded */
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

/* The sweeps of F's factorization: x := L^-1 x over steps, and x := L'^-1 D^-1 x. */
SLI_INLINE void sli_forward_sweep(const sl_factor *F, int kind, sl_int count, const sli_step *steps,
                                  const sl_int *rows, double *x, double *scratch) {
    F->kernels->sweeps[F->storage != SL_STORAGE_DOUBLE].forward[kind](count, steps, rows, F->values,
                                                                      x, scratch);
}
SLI_INLINE void sli_backward_sweep(const sl_factor *F, int kind, sl_int count,
                                   const sli_step *steps, const sl_int *rows_end, const double *D,
                                   double *x, double *scratch) {
    F->kernels->sweeps[F->storage != SL_STORAGE_DOUBLE].backward[kind](count, steps, rows_end,
                                                                       F->values, D, x, scratch);
}

/* The entry of L at a position of the panels. */
SLI_INLINE double sli_entry(const sl_factor *F, sl_off at) {
    return F->storage != SL_STORAGE_DOUBLE ? (double)((const float *)F->values)[at]
                                           : ((const double *)F->values)[at];
}

SLI_INLINE void sli_entry_clear(sl_factor *F, sl_off at) {
    if (F->storage != SL_STORAGE_DOUBLE) {
        ((float *)F->values)[at] = 0.0F;
    } else {
        ((double *)F->values)[at] = 0.0;
    }
}

/* Does rounding harm the entry l of column j in local row r? An entry that underflows loses more
 * than the share u of itself. This changes A by up to 2^-150 |d_j l_kj| in that row and row k, and
 * |l_kj| <= sqrt(magnitude_k / |d_j|). It is within the bound, u sqrt(magnitude_r magnitude_k), if
 * 2^-150 sqrt(|d_j|) <= 2^-24 sqrt(magnitude_r). The column of a null pivot is never used. */
SLI_INLINE int sli_rounding_harms(const sli_front *f, sl_int r, sl_int j, double l) {
    const double d =
        f->E != NULL && f->E[j] != 0.0 ? fmax(fabs(f->D[j]), fabs(f->E[j])) : fabs(f->D[j]);
    if (fabs(l) > (double)FLT_MAX || d == SLI_NULL_PIVOT) {
        return d != SLI_NULL_PIVOT;
    }
    return l != 0.0 && fabs(l) < (double)FLT_MIN && ldexp(d, -252) > f->magnitude[r];
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
                if (sli_rounding_harms(f, SLI_TILE * t + r, j, from[r])) {
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

/* Copies the panel of supernode s, of a factor in float, to doubles. */
static void sli_panel_widen(const sl_factor *F, sl_int s, double *to) {
    const sl_off first = F->S->panel_begin[s], size = F->S->panel_begin[s + 1] - first;
    const float *from = (const float *)F->values + first;
    sl_off k;
    for (k = 0; k < size; k++) {
        to[k] = from[k];
    }
}

#endif

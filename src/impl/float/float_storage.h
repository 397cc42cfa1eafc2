/* float_storage.h: L in float: panels that are rounded when their fronts are done */
#ifndef SLI_FLOAT_FLOAT_STORAGE_H
#define SLI_FLOAT_FLOAT_STORAGE_H

#include "../factor/multifrontal.h"
#include "float_kernels.h"

/* With SL_STORAGE_FLOAT each front is factored in double and its panel is rounded when the front is
 * done, so L exists in float only. Everything else is double: D, the update matrices, null pivots,
 * the growth, and the arithmetic of sweeps.
 *
 * L + G, |G| <= u |L|, u = 2^-24, is the factor of A + E, |E| <= 2 u |L| |D| |L'| and smaller
 * terms: a backward error of u times the growth. For a definite A more holds. With C = D^(1/2) L'
 * and H = D^(1/2) G' C^-1, A + E = C' (I + H)' (I + H) C. Refinement multiplies the error, in the
 * energy norm, by about 2 ||H||, which is of the order of u sqrt(cond A), not u cond A: the pivots,
 * which hold the smallest eigenvalues, are not rounded. */

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
    return F->null.vectors <= 1 || f->magnitude[r] > ldexp(1.0, -900);
}

/* Refuses what rounding harms in row tile t of a front, whose `columns` columns are at `from`. */
SLI_NOINLINE static sl_status sli_tile_check(const sl_factor *F, const sli_front *f, sl_int t,
                                             const double *from, sl_int columns,
                                             sli_failure *failure) {
    sl_int j, r;
    for (j = 0; j < columns; j++, from += SLI_TILE) {
        for (r = 0; r < SLI_TILE; r++) {
            if (sli_rounding_harms(F, f, SLI_TILE * t + r, j, from[r])) {
                return sli_fail(failure, SL_ERR_INACCURATE, f->super, f->column + j, -1, f->D[j]);
            }
        }
    }
    return SL_OK;
}

/* Rounds the panel of a front to float. Refuses what float cannot hold. */
static sl_status sli_panel_round(const sl_factor *F, const sli_front *f, sli_failure *failure) {
    const sli_round_kernel round = sli_float_kernels_of(F->kernels->isa)->round;
    const sl_int w = f->width, tiles = sli_tiles(w + f->below);
    float *to = (float *)F->values + F->S->steps[f->super].panel;
    const double *from = f->panel;
    SLI_ALIGNED(float column[SLI_TILE]);
    sl_status status = SL_OK;
    sl_int t;
    for (t = 0; t < tiles && status == SL_OK; t++) {
        const sl_int columns = sli_min(w, SLI_TILE * (t + 1));
        if (round(w > 1 ? to : column, from, SLI_TILE * (ptrdiff_t)columns)) {
            status = sli_tile_check(F, f, t, from, columns, failure);
        }
        if (w == 1) { /* that panel is not padded */
            SLI_COPY(to, column, sli_min(1 + f->below - SLI_TILE * t, SLI_TILE));
        }
        from += SLI_TILE * (ptrdiff_t)columns;
        to += SLI_TILE * (ptrdiff_t)columns;
    }
    return status;
}

static double sli_float_entry(const void *values, sl_off at) {
    return (double)((const float *)values)[at];
}

static void sli_float_entry_clear(void *values, sl_off at) {
    ((float *)values)[at] = 0.0F;
}

static sli_own_kernels sli_float_own(const sli_kernels *kernels) {
    const sli_float_kernels *table = sli_float_kernels_of(kernels->isa);
    sli_own_kernels own;
    own.sweeps = table == NULL ? NULL : &table->sweeps;
    own.front = &kernels->front;
    return own;
}

static const sli_storage_type sli_storage_float = {
    SL_STORAGE_FLOAT, /* storage */
    sizeof(float), /* value_bytes */
    0, /* half */
    &sli_double_fronts, /* fronts */
    sli_float_own, /* kernels */
    sli_panel_round, /* store */
    sli_float_entry, /* entry */
    sli_float_entry_clear, /* entry_clear */
    NULL, /* suits */
    NULL, /* accepts */
    NULL, /* keeps */
    &sli_storage_double /* in_double */
};

#endif

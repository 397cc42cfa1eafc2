/* float_storage.h: L in float: panels that are rounded, and fronts that are computed in float */
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

/* The largest entry of A and sum of magnitudes, and the smallest sum, of fronts in float. Products
 * of pivots and entries of L then neither overflow nor lose more by underflow than by rounding. */
#define SLI_SINGLE_MOST (0.25 * (double)FLT_MAX)
#define SLI_SINGLE_LEAST 7.888609052210118e-31 /* 2^-100 */

/* An entry of A in float. None becomes 0, which would hide that its row is too small. */
SLI_INLINE float sli_single(double a) {
    const float x = (float)a;
    return x != 0.0F || a == 0.0 ? x : a < 0.0 ? -FLT_MIN : FLT_MIN;
}

/* Checks pivot number `column` of a front in float as sli_check_pivot does, and stores it.
 * Refuses what float cannot tell from rounding: a kept pivot of a semidefinite matrix, too, is
 * regular in double but not here. */
SLI_INLINE sl_status sli_check_single(const sl_factor *F, const sli_front *f, sl_int column,
                                      sli_failure *failure) {
    const sl_int s = f->super, k = f->column + column;
    const float pivot = f->single.D[column], magnitude = f->single.magnitude[column];
    const int is_null = F->null.mode == SL_PIVOTS_SKIP_NULL && pivot == FLT_MAX;
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

/* The front of supernode s in float, without its update matrix. The scratch is that of doubles:
 * there is room for D as well. */
SLI_INLINE sli_front sli_single_begin(const sl_factor *F, sl_int s, sl_int worker) {
    const sli_step *step = &F->S->steps[s];
    const sl_int rows = SLI_TILE * sli_tiles(F->S->tallest);
    sli_front f = sli_front_in_double(F, s, worker);
    f.single.panel = step->width == 1 ? (float *)(void *)f.panel : (float *)F->values + step->panel;
    f.single.magnitude = (float *)(void *)f.magnitude;
    f.single.D = f.single.magnitude + rows;
    f.single.reciprocals = (float *)(void *)f.reciprocals;
    f.panel = f.D = f.magnitude = f.E = f.reciprocals = NULL;
    return f;
}

#define SLF_NAME(f) sli_single_##f
#define SLF_VALUE float
#define SLF_SINGLE 1
#define SLF_HALF 0
#define SLF_OF(f, array) (f)->single.array
#define SLF_BEGIN sli_single_begin
#include "../factor/fronts.inl.h"
#include "../factor/fronts_undef.inl.h"

/* A front that workers share: its magnitudes, D and reciprocals follow its update matrix. */
static sli_front sli_single_shared(const sl_factor *F, sl_int s, sl_int group) {
    const sli_step *step = &F->S->steps[s];
    sli_front f = sli_single_front_of(F, s, 0);
    f.single.magnitude = f.single.update + sli_update_size(step);
    f.single.D = f.single.magnitude + SLI_TILE * (ptrdiff_t)sli_front_tiles(&f);
    f.single.reciprocals = f.single.D + SLI_TILE * (ptrdiff_t)sli_tiles(step->width) +
                           SLI_FRONT_RECIPROCALS * (ptrdiff_t)group;
    return f;
}

static const sli_sweeps *sli_float_sweeps(const sli_kernels *kernels) {
    const sli_float_kernels *own = sli_float_kernels_of(kernels->isa);
    return own == NULL ? NULL : &own->sweeps;
}

static const sli_front_kernels *sli_single_front(const sli_kernels *kernels) {
    return &sli_float_kernels_of(kernels->isa)->front;
}

/* Fronts in float have no 2x2 pivots. */
static int sli_single_suits(const sl_factor *F) {
    return F->S->n_pairs == 0;
}

static const sli_storage_type sli_storage_float = {SL_STORAGE_FLOAT,
                                                   sizeof(float),
                                                   sizeof(double),
                                                   0,
                                                   DBL_EPSILON,
                                                   sli_float_sweeps,
                                                   SLI_DOUBLE_FRONTS,
                                                   sli_panel_round,
                                                   sli_float_entry,
                                                   sli_float_entry_clear,
                                                   NULL,
                                                   NULL,
                                                   NULL,
                                                   &sli_storage_double};

static const sli_storage_type sli_storage_single = {SL_STORAGE_FLOAT_FRONTS,
                                                    sizeof(float),
                                                    sizeof(float),
                                                    0,
                                                    (double)FLT_EPSILON,
                                                    sli_float_sweeps,
                                                    sli_single_front,
                                                    sli_single_factor,
                                                    sli_single_shared,
                                                    sli_single_front_clear,
                                                    sli_single_front_load,
                                                    sli_single_front_assemble,
                                                    sli_single_front_finish,
                                                    NULL,
                                                    sli_float_entry,
                                                    sli_float_entry_clear,
                                                    sli_single_suits,
                                                    NULL,
                                                    NULL,
                                                    &sli_storage_double};

#endif

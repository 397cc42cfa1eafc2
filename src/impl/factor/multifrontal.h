/* multifrontal.h: fronts in double: each passes its update matrix up */
#ifndef SLI_FACTOR_MULTIFRONTAL_H
#define SLI_FACTOR_MULTIFRONTAL_H

#include "panel_load.h"
#include "pivot_check.h"
#include "storage_type.h"

/* Are the numbers of supernode s copied in this factorization? */
SLI_INLINE int sli_is_copied(const sl_factor *F, sl_int s) {
    return F->work.copied != NULL && F->work.copied->from[s] != -1;
}

SLI_INLINE sl_int sli_front_tiles(const sli_front *f) {
    return sli_tiles(f->width + f->below);
}

/* Clears what is used of a small front in double: a call of memset takes as long as a front. */
SLI_INLINE void sli_front_clear_small(const sli_front *f) {
    double *update = f->update + SLI_TILE * (ptrdiff_t)f->width;
    sl_int k;
    for (k = 0; k < f->width; k++) {
        memset(f->panel + SLI_TILE * (ptrdiff_t)k, 0, SLI_TILE * sizeof(double));
    }
    for (k = 0; k < f->below; k++) {
        memset(update + SLI_TILE * (ptrdiff_t)k, 0, SLI_TILE * sizeof(double));
    }
}

/* Does the check of each pivot find nothing to refuse and nothing to do? Then records the largest
 * magnitude. */
static int sli_front_is_regular(const sl_factor *F, const sli_front *f, sl_int s) {
    const double tolerance = F->rule.null_tolerance > 0.0 ? F->rule.null_tolerance : 0.0;
    const sl_int w = f->width;
    double most = 0.0;
    sl_int k, at = -1;
    int is_regular = 1;
    if (f->pairs != NULL || F->rule.replaces) {
        return 0;
    }
    for (k = 0; k < w; k++) {
        const double size = fabs(f->D[k]), magnitude = f->magnitude[k];
        is_regular &= (size > tolerance * magnitude) & (size <= DBL_MAX);
        at = magnitude > most ? f->column + k : at;
        most = magnitude > most ? magnitude : most;
    }
    if (is_regular) {
        F->extents[s].magnitude = most;
        F->extents[s].pivot = at;
    }
    return is_regular;
}

/* Factors the panel of an assembled front: its columns of L and D. */
static void sli_front_eliminate(const sli_front_kernels *kernels, const sli_front *f,
                                double *scratch) {
    const sl_int tiles = sli_front_tiles(f), ends = sli_tiles(f->width);
    sl_int c0;
    for (c0 = 0; c0 < ends; c0 += SLI_GROUP_TILES) {
        const sl_int t0 = sli_min(c0 + SLI_GROUP_TILES, ends);
        kernels->pivots(f, c0, scratch);
        if (t0 < tiles) {
            kernels->rows(f, c0, t0, tiles, scratch);
        }
    }
}

/* Computes the update matrix of a front from the assembled front and its panel. */
static void sli_front_update(const sli_front_kernels *kernels, const sli_front *f,
                             double *scratch) {
    const sl_int whole = f->width / SLI_TILE, tiles = sli_front_tiles(f);
    if (f->below > 0 && !f->is_small) {
        kernels->update(f, whole, tiles, whole, tiles, scratch);
    }
}

/* The front of supernode s in double, without its update matrix, which this worker factors. */
static sli_front sli_front_in_double(const sl_factor *F, sl_int s, sl_int worker) {
    const sli_step *step = &F->S->steps[s];
    sli_front f;
    f.update = NULL;
    f.super = s;
    f.is_small = 0;
    f.width = step->width;
    f.below = step->below;
    f.rule = &F->rule;
    f.column = step->column;
    f.panel = sli_front_panel(F, s, worker);
    f.D = F->D + step->column;
    f.pairs = F->E == NULL ? NULL : F->S->pairs + step->column;
    f.E = F->E == NULL ? NULL : F->E + step->column;
    f.magnitude = F->work.magnitude + (ptrdiff_t)worker * (SLI_TILE * sli_tiles(F->S->tallest));
    f.reciprocals = F->work.reciprocals + (ptrdiff_t)worker * SLI_FRONT_RECIPROCALS;
    return f;
}

#define SLF_NAME(f) sli_double_##f
#define SLF_HALF 0
#include "fronts.inl.h"
#include "fronts_undef.inl.h"

static sli_own_kernels sli_double_own(const sli_kernels *kernels) {
    sli_own_kernels own;
    own.sweeps = &kernels->sweeps;
    own.front = &kernels->front;
    return own;
}

static const sli_storage_type sli_storage_double = {
    SL_STORAGE_DOUBLE, /* storage */
    sizeof(double), /* value_bytes */
    0, /* half */
    &sli_double_fronts, /* fronts */
    sli_double_own, /* kernels */
    NULL, /* store */
    NULL, /* entry */
    NULL, /* entry_clear */
    NULL, /* suits */
    NULL, /* accepts */
    NULL, /* keeps */
    NULL /* in_double */
};

#endif

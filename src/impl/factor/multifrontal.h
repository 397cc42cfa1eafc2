/* multifrontal.h: the fronts of the supernodal factorization: each passes its update matrix up */
#ifndef SLI_FACTOR_MULTIFRONTAL_H
#define SLI_FACTOR_MULTIFRONTAL_H

#include "panel_load.h"
#include "pivot_check.h"
#include "storage.h"

/* The update matrix of supernode s, doubles or floats, which this worker factors if it is within a
 * task. */
SLI_INLINE void *sli_update_matrix(const sl_factor *F, sl_int s, sl_int worker) {
    const sl_off begin = F->schedule.stack_begin[s], own = F->schedule.own;
    const sl_off at = begin < own ? begin + worker * own : begin;
    return sli_is_single(F) ? (void *)((float *)(void *)F->stack + at)
                            : (void *)(F->stack + (at >> sli_is_complex(F)));
}

SLI_INLINE const sli_front_kernels *sli_front_kernels_of(const sl_factor *F) {
    return &F->kernels->fronts[sli_is_complex(F) ? 2 : sli_is_single(F)];
}

static sli_front sli_front_of(const sl_factor *F, sl_int s, sl_int worker) {
    const sli_step *step = &F->S->steps[s];
    const sl_int rows = SLI_TILE * sli_tiles(F->S->tallest);
    double *magnitude = F->magnitude + (ptrdiff_t)worker * rows;
    double *reciprocals = F->reciprocals + (ptrdiff_t)worker * SLI_FRONT_RECIPROCALS;
    sli_front f;
    f.is_complex = f.is_small = 0;
    f.pairs = NULL;
    f.width = step->width;
    f.below = step->below;
    f.rule = &F->rule;
    f.column = step->column;
    if (sli_is_single(F)) { /* the scratch is that of doubles: there is room for D as well */
        f.panel = f.update = f.D = f.magnitude = f.E = f.reciprocals = NULL;
        f.single.panel = (float *)F->values + step->panel;
        f.single.update = (float *)sli_update_matrix(F, s, worker);
        f.single.magnitude = (float *)(void *)magnitude;
        f.single.D = f.single.magnitude + rows;
        f.single.reciprocals = (float *)(void *)reciprocals;
        return f;
    }
    f.single.panel = f.single.update = f.single.D = NULL;
    f.single.magnitude = f.single.reciprocals = NULL;
    f.panel = sli_front_panel(F, s, worker);
    f.update = (double *)sli_update_matrix(F, s, worker);
    f.D = F->D + step->column;
    f.pairs = F->E == NULL ? NULL : F->S->pairs + step->column;
    f.E = F->E == NULL ? NULL : F->E + step->column;
    f.magnitude = magnitude;
    f.reciprocals = reciprocals;
    f.is_complex = sli_is_complex(F);
    return f;
}

SLI_INLINE sl_int sli_front_tiles(const sli_front *f) {
    return sli_tiles(f->width + f->below);
}

/* Clears row tiles t0 .. t1-1 of a front. */
static void sli_front_clear(const sli_front *f, sl_int t0, sl_int t1) {
    const sl_int w = f->width, whole = w / SLI_TILE, u0 = sli_max(t0 - whole, 0);
    const sl_off from = sli_tile_offset(w, t0), size = sli_tile_offset(w, t1) - from;
    const sl_off at = sli_triangle_offset(u0), end = sli_triangle_offset(t1 - whole);
    const int has_update = f->below > 0 && t1 > whole;
    if (f->panel == NULL) {
        memset(f->single.panel + from, 0, (size_t)size * sizeof(float));
        if (has_update) {
            memset(f->single.update + at, 0, (size_t)(end - at) * sizeof(float));
        }
        return;
    }
    memset(f->panel + (from >> f->is_complex), 0, (size_t)(size >> f->is_complex) * sizeof(double));
    if (has_update) {
        memset(f->update + (at >> f->is_complex), 0,
               (size_t)((end - at) >> f->is_complex) * sizeof(double));
    }
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

/* Adds the matrix's entries to the cleared panel and starts the magnitudes of its diagonal with
 * them. */
static sl_status sli_front_load(sl_factor *F, const sli_source *from, const sli_front *f, sl_int s,
                                sli_failure *failure) {
    const sl_status status = sli_panel_load(F, from, s, f->panel, f->single.panel, failure);
    const sl_int w = f->width, rows = SLI_TILE * sli_front_tiles(f);
    sl_int k, r;
    if (f->panel == NULL) {
        memset(f->single.magnitude, 0, (size_t)rows * sizeof(float));
        for (k = 0; k < w; k++) {
            f->single.magnitude[k] = (float)fabs(f->single.panel[sli_panel_at(w, k, k)]);
        }
        return status;
    }
    for (k = 0; k < rows; k++) {
        f->magnitude[k] = 0.0;
    }
    for (k = 0; k < w && f->is_complex; k += 2) {
        f->magnitude[k] = fabs(f->panel[sli_half_at(sli_panel_at(w, k, k))]);
    }
    for (k = 0; k < w && !f->is_complex; k += SLI_TILE) {
        const double *tile = f->panel + sli_panel_at(w, k, k);
        const sl_int columns = sli_min(SLI_TILE, w - k);
        for (r = 0; r < columns; r++) {
            f->magnitude[k + r] = fabs(tile[(SLI_TILE + 1) * r]);
        }
    }
    return status;
}

/* Extend-add: assembles the children's update matrices into row tiles t0 .. t1-1, the last child
 * first. */
static void sli_front_assemble(const sl_factor *F, const sli_front *f, sl_int s, sl_int worker,
                               sl_int t0, sl_int t1) {
    const sl_symbolic *S = F->S;
    const sl_int tiles = sli_front_tiles(f);
    sl_int c, k;
    for (c = s - 1; c >= S->first_descendant[s]; c = S->first_descendant[c] - 1) {
        const sli_step *child = &S->steps[c];
        const sl_int *relative = S->relative + S->rows_begin[c];
        const void *from = sli_update_matrix(F, c, worker);
        const sl_off magnitudes = child->width % SLI_TILE +
                                  sli_triangle_offset(sli_update_tiles(child->width, child->below));
        const sl_int first = t0 == 0 ? 0 : sli_lower_bound(relative, child->below, SLI_TILE * t0);
        const sl_int last =
            t1 == tiles ? child->below : sli_lower_bound(relative, child->below, SLI_TILE * t1);
        sli_front_kernels_of(F)->assemble(f, from, child->width % SLI_TILE, relative, child->below,
                                          first, last);
        if (f->panel == NULL) {
            const float *magnitude = (const float *)from + magnitudes;
            for (k = first; k < last; k++) {
                f->single.magnitude[relative[k]] += magnitude[k];
            }
        } else {
            const int half = f->is_complex;
            const double *magnitude = (const double *)from + (magnitudes >> half);
            for (k = first; k < last; k += 1 + half) {
                f->magnitude[relative[k]] += magnitude[k >> half];
            }
        }
    }
}

/* Stores the magnitudes of the rows below, or of pairs of them, next to the update matrix, for the
 * parent. */
static void sli_front_hand_over(const sli_front *f) {
    const sl_int tiles = sli_update_tiles(f->width, f->below);
    const ptrdiff_t first = SLI_TILE * (ptrdiff_t)(f->width / SLI_TILE);
    const size_t rows = SLI_TILE * (size_t)tiles;
    if (f->panel == NULL) {
        memcpy(f->single.update + sli_triangle_offset(tiles), f->single.magnitude + first,
               rows * sizeof(float));
    } else if (f->is_complex) {
        double *to = f->update + sli_triangle_offset(tiles) / 2;
        const double *from = f->magnitude + first;
        size_t k;
        for (k = 0; k < rows; k += 2) {
            to[k / 2] = from[k] + from[k + 1];
        }
    } else {
        double *to = f->update + sli_triangle_offset(tiles);
        const double *from = f->magnitude + first;
        size_t k;
        for (k = 0; k < rows; k++) {
            to[k] = from[k];
        }
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
    if (f->panel == NULL || f->pairs != NULL || F->rule.replaces) {
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

/* Ends a front: refuses pivots that are not finite, and null pivots that were not replaced; stores
 * the panel unless it is where it belongs. */
static sl_status sli_front_check(const sl_factor *F, const sli_front *f, sl_int s,
                                 sli_failure *failure) {
    const sl_int first = f->column;
    const sl_int count = sli_front_is_regular(F, f, s) ? 0 : f->width;
    sl_status status = SL_OK;
    sl_int k;
    for (k = 0; k < count && f->panel == NULL && status == SL_OK; k++) {
        status = sli_check_single(F, s, first + k, f->single.D[k], f->single.magnitude[k], failure);
    }
    for (k = 0; k < count && f->panel != NULL && status == SL_OK; k++) {
        status = f->pairs != NULL && f->pairs[k] != SLI_PAIR_NONE
                     ? sli_check_pair(F, s, first + k, f->magnitude + k, failure)
                     : sli_check_pivot(F, s, first + k, f->D[k], f->magnitude[k], failure);
    }
    return status == SL_OK ? sli_panel_store(F, f, s, failure) : status;
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

/* Factors the front of supernode s on one worker. */
static sl_status sli_front_factor(sl_factor *F, const sli_source *from, sl_int s, sl_int worker,
                                  sli_failure *failure) {
    sli_front f = sli_front_of(F, s, worker);
    const sl_int tiles = sli_front_tiles(&f);
    double *scratch = F->buffer + (ptrdiff_t)worker * sli_front_scratch(F->S->widest);
    sl_status status;
    f.is_small = tiles == 1 && f.pairs == NULL && !f.is_complex;
    if (f.is_small && f.panel != NULL) {
        sli_front_clear_small(&f);
    } else {
        sli_front_clear(&f, 0, tiles);
    }
    status = sli_front_load(F, from, &f, s, failure);
    if (status != SL_OK) {
        return status;
    }
    sli_front_assemble(F, &f, s, worker, 0, tiles);
    sli_front_eliminate(sli_front_kernels_of(F), &f, scratch);
    sli_front_update(sli_front_kernels_of(F), &f, scratch);
    sli_front_hand_over(&f);
    return sli_front_check(F, &f, s, failure);
}

#endif

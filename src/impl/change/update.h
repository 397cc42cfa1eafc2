/* update.h: one pass of a rank-k change: the columns on the paths of up to 8 vectors */
#ifndef SLI_CHANGE_UPDATE_H
#define SLI_CHANGE_UPDATE_H

#include "../analysis/reach.h"
#include "../factor/factor.h"
#include "../solve/query.h"

/* L D L' + W M W' = K N K' for W of n x k, column by column [DH01]. With the row y of W and the
 * column l of L that belong to pivot d:
 *
 *     e = d + y' M y,  W := W - l y',  l := l + W b  with b = M y / e,  M := M - M y y' M / e.
 *
 * e is the new pivot. W loses row and column, and is nonzero on the paths of its columns only. M is
 * kept as U diag(alpha) U' with a unit upper triangular U, and updated in this form [Bie76]: so its
 * signs stay those of the changes, and rounding is that of k changes one after the other. */

/* The state of a change. Vectors in a compact vector of their reach, interleaved. */
typedef struct sli_update {
    sl_factor *F;
    const sl_csc *V; /* the vectors: columns of an n x count matrix in the rows of A */
    const double *sigma;
    double sign;     /* of all pivots, 1 or -1; 0: they have both signs */
    int keeps_signs; /* a pivot that changes its sign is refused */
    int is_trial;    /* pivots are checked, and not changed */
    int is_tried;    /* the trial of this pass has succeeded */
    sl_int lanes;    /* that hold the vectors of the pass */
    int kind;
    double most;   /* the largest sum of magnitudes that a pivot of the pass was computed from */
    double loss;   /* of digits in a pivot, which later ones multiply: of pivots of both signs */
    double fall;   /* by at most this much the pass changes the largest |a| */
    double least;  /* a smaller pivot may be null, and is refused where it was larger */
    double top;    /* the largest new pivot */
    double entry;  /* the largest |a| that is known of the columns of the pass */
    double growth; /* the largest growth of rows in them */
    sli_reach R;
    sl_int pivot; /* the pivot that was refused, and its value */
    double value;

    sli_ranks *state;
    sli_step *steps; /* of the reach */
    sl_int *rows;
    double *x;               /* lanes for each column of the reach */
    double *gain;            /* for each column: what the pass adds to its sum of magnitudes */
    double *local;           /* [tile][lane][8]: the rows of the current step */
    double *c;               /* 2 lanes for each column of the current step: y and -b */
    double *other, *b;       /* of one vector: the rows of the next step, and b of the columns */
    double *trial, *scratch; /* of a trial: the compact vector, and what the kernel needs */
} sli_update;

/* The kernel for passes of `count` vectors. One vector takes another way (path.h) where all pivots
 * have one sign. */
SLI_INLINE int sli_update_kind(sl_int count) {
    return count == 1 ? SLI_NRHS_2 : sli_lanes_kind(count);
}

static void sli_update_layout(sli_update *u, sli_block *b, const sli_reach *R, sl_int lanes,
                              int has_trial) {
    const uint64_t many = (uint64_t)lanes;
    u->state = SLI_TAKE(b, sli_ranks, 1);
    u->steps = SLI_TAKE(b, sli_step, R->count);
    u->rows = SLI_TAKE(b, sl_int, R->n_rows);
    u->x = SLI_TAKE(b, double, many *(uint64_t)R->columns);
    u->gain = SLI_TAKE(b, double, R->columns);
    u->local = SLI_TAKE(b, double, many *SLI_TILE *((uint64_t)sli_tiles(R->tallest) + 4));
    u->c = SLI_TAKE(b, double, 2 * many * SLI_TILE * (uint64_t)sli_tiles(R->widest));
    u->other = SLI_TAKE(b, double, SLI_TILE *(uint64_t)sli_tiles(R->tallest));
    u->b = SLI_TAKE(b, double, SLI_TILE *(uint64_t)sli_tiles(R->widest));
    u->trial = SLI_TAKE(b, double, has_trial ? many *(uint64_t)R->columns : 0);
    u->scratch =
        SLI_TAKE(b, double, has_trial ? sli_sweep_scratch(R->tallest, R->widest, lanes) : 0);
}

/* The sum of the magnitudes |a_kk| + sum |l_kj d_j l_kj| that pivot k was computed from, at most.
 * O(descendants). */
static double sli_update_magnitude(const sl_factor *F, sl_int k) {
    const sl_symbolic *S = F->S;
    const sl_int own = S->super_of[k];
    double sum = 0.0;
    sl_int d, j;
    for (d = own; d >= S->first_descendant[own];) {
        const sli_step *step = &S->steps[d];
        const sl_int *rows = S->rows + S->rows_begin[d];
        const sl_int at = d == own ? 0 : sli_lower_bound(rows, step->below, k);
        const sl_int r = d == own ? k - step->column : step->width + at;
        if (d != own && at == step->below) { /* no descendant has a row there */
            d = S->first_descendant[d] - 1;
            continue;
        }
        for (j = 0; j < sli_min(r, step->width) && (d == own || rows[at] == k); j++) {
            const double l = sli_entry(F, step->panel + sli_panel_at(step->width, r, j));
            sum += fabs(l * F->D[step->column + j] * l);
        }
        d--;
    }
    return 2.0 * sum + fabs(F->D[k]);
}

/* Is pivot k, now d, null? magnitude: of its change alone. */
static int sli_update_is_null(const sl_factor *F, sl_int k, double d, double magnitude) {
    const double tolerance = F->rule.null_tolerance;
    const double known = F->extents[F->S->super_of[k]].magnitude;
    if (sli_is_null(d, magnitude, tolerance)) {
        return 1;
    }
    return sli_is_null(d, magnitude + known, tolerance) &&
           sli_is_null(d, magnitude + sli_update_magnitude(F, k), tolerance);
}

/* Counts a pivot that changed from d to e. */
SLI_INLINE void sli_update_count(sl_factor_info *info, double d, double e) {
    const double size = fabs(e);
    info->positive += (e > 0.0) - (d > 0.0);
    info->negative += (e < 0.0) - (d < 0.0);
    info->pivot_min = size < info->pivot_min ? size : info->pivot_min;
    info->pivot_max = size > info->pivot_max ? size : info->pivot_max;
}

/* Where a pivot grows, what is added to a row of L cancels the row: the error is that of the old
 * row, times the new pivot. An entry of the row is at most the root of the largest |l d l| over
 * |d|, which is not 0: a factor with null pivots is not changed. */
static double sli_update_cancelled(const sl_factor *F, double d, double e) {
    const sl_factor_info *info = &F->stats.factor;
    const double largest = fmax(info->growth, 1.0) * fmax(info->entry_max, F->scale);
    return fabs(e) > 4.0 * fabs(d) ? fabs(e) * sqrt(largest / fabs(d)) : 0.0;
}

/* Takes pivot k from d to e. magnitude: the sum of the magnitudes that e was computed from. */
static sl_status sli_update_take(sli_update *u, sl_int k, double e, double magnitude) {
    sl_factor *F = u->F;
    const double d = F->D[k];
    u->value = e;
    u->pivot = k;
    if (!sli_is_finite(e)) {
        return SL_ERR_NOT_FINITE;
    }
    if (fabs(e) < DBL_MIN || (u->keeps_signs && (e < 0.0) != (d < 0.0)) ||
        (fabs(e) < fabs(d) &&
         (fabs(e) <= u->least || sli_update_is_null(F, k, e, magnitude)))) {
        return SL_ERR_PIVOT;
    }
    if (!u->is_trial) {
        u->most = fmax(u->most, fmax(magnitude, sli_update_cancelled(F, d, e)));
        u->top = fabs(e) > u->top ? fabs(e) : u->top;
        sli_update_count(&F->stats.factor, d, e);
        F->D[k] = e;
    }
    return SL_OK;
}

/* Takes `count` pivots from k on, as a kernel computed them. magnitudes: the sums of magnitudes;
 * NULL: of one vector. Nearly always the extremes show that all of them can be taken. */
static sl_status sli_update_take_all(sli_update *u, sl_int k, sl_int count, const double *e,
                                     const double *magnitudes) {
    sl_factor *F = u->F;
    sl_factor_info *info = &F->stats.factor;
    const double known = F->extents[F->S->super_of[k]].magnitude;
    double *D = F->D + k, least = DBL_MAX, top = 0.0, most = 0.0;
    int are_usual = 1, shrink = 0;
    sl_status status = SL_OK;
    sl_int j;
    for (j = 0; j < count; j++) {
        const double d = D[j], size = fabs(e[j]), before = fabs(d);
        const double magnitude = magnitudes != NULL ? magnitudes[j] : before + fabs(e[j] - d);
        are_usual &= (size <= 4.0 * before) & ((e[j] < 0.0) == (d < 0.0));
        shrink |= size < before;
        least = size < least ? size : least;
        top = size > top ? size : top;
        most = magnitude > most ? magnitude : most;
    }
    if (are_usual && least >= DBL_MIN && top <= DBL_MAX &&
        (!shrink || u->is_tried ||
         (least > u->least && !sli_is_null(least, most + known, F->rule.null_tolerance)))) {
        if (!u->is_trial) {
            memcpy(D, e, (size_t)count * sizeof *D);
            info->pivot_min = least < info->pivot_min ? least : info->pivot_min;
            info->pivot_max = top > info->pivot_max ? top : info->pivot_max;
            u->top = top > u->top ? top : u->top;
            u->most = most > u->most ? most : u->most;
        }
        return SL_OK;
    }
    for (j = 0; j < count && status == SL_OK; j++) {
        const double d = D[j], size = fabs(e[j]);
        const double magnitude = magnitudes != NULL ? magnitudes[j] : fabs(d) + fabs(e[j] - d);
        if (e[j] != d || magnitude != size) {
            status = sli_update_take(u, k + j, e[j], magnitude);
        }
    }
    return status;
}

/* Changes the pivots of `columns` columns from k on. l, w: as for the kernel. Writes their c. */
static sl_status sli_update_pivots(sli_update *u, sl_int k, sl_int columns, const double *l,
                                   const double *w, double *c) {
    sl_factor *F = u->F;
    const sl_int done = F->kernels->change_ranks(u->state, l, columns, F->D + k, w, c);
    return sli_update_take_all(u, k, done, u->state->e, u->state->magnitude);
}

/* The pivots of column tile c, and the rows of that tile. w: [lane][8] of its rows. */
static sl_status sli_update_tile(sli_update *u, const sli_step *step, sl_int c, double *w) {
    const sl_int first = SLI_TILE * c, columns = sli_min(SLI_TILE, step->width - first);
    double *l = (double *)u->F->values + step->panel + sli_panel_at(step->width, first, first);
    double *at = u->c + 2 * (ptrdiff_t)u->lanes * (first - SLI_TILE * step->first_tile);
    const sl_int k = step->column + first - SLI_TILE * step->first_tile;
    const sl_status status = sli_update_pivots(u, k, columns, l, w, at);
    sl_int j, r;
    for (j = 0; j < columns && u->sign == 0.0 && status == SL_OK; j++) {
        if (first + j + 1 < step->width + step->below) {
            u->loss = fmax(u->loss, u->state->magnitude[j] / fabs(u->state->e[j]));
        }
    }
    if (status == SL_OK) {
        u->F->kernels->change[u->kind - 1](l, columns, at, w);
        /* the kernel has changed the part above them, too; memset is slow for a few bytes */
        for (r = 0; r < columns; r++) {
            for (j = r; j < columns; j++) {
                l[SLI_TILE * j + r] = 0.0;
            }
        }
    }
    return status;
}

/* Applies columns from .. to-1 to row tile t. */
static void sli_update_rows(const sli_update *u, const sli_step *step, sl_int t, sl_int from,
                            sl_int to) {
    const sl_int entered = step->first_tile;
    u->F->kernels->change[u->kind - 1](
        (double *)u->F->values + step->panel + sli_panel_at(step->width, SLI_TILE * t, from),
        to - from, u->c + 2 * (ptrdiff_t)u->lanes * (from - SLI_TILE * entered),
        u->local + SLI_TILE * (ptrdiff_t)u->lanes * (t - entered));
}

/* Moves the rows of a step between the compact vector and the tiles: into the tiles, or back. */
static void sli_update_move(const sli_update *u, const sli_step *step, const sl_int *rows,
                            int is_back) {
    const sli_kernels *kernels = u->F->kernels;
    const sl_int lanes = u->lanes, own = sli_step_columns(step), all = own + step->below;
    sl_int t, i, r, at[SLI_TILE];
    double *w = u->local;
    for (t = 0; t < all; t += SLI_TILE, w += SLI_TILE * lanes) {
        const sl_int count = sli_min(SLI_TILE, all - t);
        if (count < SLI_TILE && !is_back) {
            memset(w, 0, SLI_TILE * (size_t)lanes * sizeof *w);
        }
        for (i = 0; i < count; i++) {
            at[i] = t + i < own ? step->base + t + i : rows[t + i - own];
        }
        if (lanes == SLI_TILE && is_back) {
            kernels->interleave(u->x, lanes, at, count, w, SLI_TILE, 0);
        } else if (lanes == SLI_TILE) {
            kernels->separate(w, SLI_TILE, u->x, lanes, at, count);
        } else {
            for (i = 0; i < count; i++) {
                for (r = 0; r < lanes; r++) {
                    double *x = u->x + (ptrdiff_t)lanes * at[i] + r, *y = w + SLI_TILE * r + i;
                    *(is_back ? x : y) = *(is_back ? y : x);
                }
            }
        }
    }
}

/* Adds sign |L| |D| |L'| of the columns of a step to the gains of their rows. */
static void sli_update_gains(const sli_update *u, const sli_step *step, const sl_int *rows,
                             double sign) {
    const sl_factor *F = u->F;
    const sl_int start = step->column - SLI_TILE * step->first_tile;
    sl_int r, j;
    for (r = SLI_TILE * step->first_tile; r < step->width + step->below; r++) {
        const double *l = (const double *)F->values + step->panel + sli_panel_at(step->width, r, 0);
        double *gain = &u->gain[r < step->width ? step->base + start + r - step->column
                                                : rows[r - step->width]];
        double sum = r < step->width ? fabs(F->D[start + r]) : 0.0;
        for (j = SLI_TILE * step->first_tile; j < sli_min(r, step->width); j++) {
            sum += fabs(l[SLI_TILE * (ptrdiff_t)j] * F->D[start + j] * l[SLI_TILE * (ptrdiff_t)j]);
        }
        *gain += sign * sum;
    }
}

/* Adds what the pass has added to the magnitudes of the rows of a step. If all pivots have one
 * sign, the sum of row k is at most 2 |a_kk|, and its gain twice the change of a_kk. */
static void sli_update_extent(sli_update *u, const sli_step *step) {
    sli_extent *extent = &u->F->extents[u->F->S->super_of[step->column]];
    sl_int k, at = -1;
    double gain = 0.0;
    for (k = 0; k < sli_step_columns(step); k++) {
        if (u->gain[step->base + k] > gain) {
            gain = u->gain[step->base + k];
            at = step->column + k;
        }
    }
    if (at != -1) {
        extent->magnitude += gain;
        extent->entry += u->sign != 0.0 ? 0.5 * gain : 0.0;
        extent->pivot = at;
    }
    u->entry = fmax(u->entry, extent->entry);
    u->growth = fmax(u->growth, extent->magnitude);
}

/* Column tiles that are applied to all rows together: so their y and b stay in the first cache. */
#define SLI_UPDATE_COLUMNS 16

/* Changes the columns of one step. On failure some of them are changed. */
static sl_status sli_update_step(sli_update *u, const sli_step *step, const sl_int *rows) {
    const sl_int entered = step->first_tile, wide = sli_tiles(step->width);
    const sl_int tiles = sli_tiles(step->width + step->below);
    sl_int c0, c1, t;
    sli_update_move(u, step, rows, 0);
    if (u->sign == 0.0) {
        sli_update_gains(u, step, rows, -1.0);
    }
    for (c0 = entered; c0 < wide; c0 = c1) {
        c1 = sli_min(c0 + SLI_UPDATE_COLUMNS, wide);
        for (t = c0; t < tiles; t++) {
            sl_status status = SL_OK;
            if (t > c0) {
                sli_update_rows(u, step, t, SLI_TILE * c0,
                                sli_min(SLI_TILE * sli_min(t, c1), step->width));
            }
            if (t < c1) {
                status = sli_update_tile(u, step, t,
                                         u->local + SLI_TILE * (ptrdiff_t)u->lanes * (t - entered));
            }
            if (status != SL_OK) {
                return status;
            }
        }
    }
    sli_update_move(u, step, rows, 1);
    if (u->sign == 0.0) {
        sli_update_gains(u, step, rows, 1.0);
    }
    sli_update_extent(u, step);
    return SL_OK;
}

/* The first pivot of column v of V, n if the column is 0. */
static sl_int sli_update_first(const sl_symbolic *S, const sl_csc *V, sl_int v) {
    sl_int p, first = S->n;
    for (p = V->p[v]; p < V->p[v + 1]; p++) {
        first = V->x[p] != 0.0 ? sli_min(first, S->iperm[V->i[p]]) : first;
    }
    return first;
}

/* The largest change of an entry of A by the vectors that are loaded, where pivots have both signs.
 * What two vectors change in one entry off the diagonal is not added up. */
static double sli_update_largest(const sli_update *u, sl_int count) {
    double first[SLI_TILE] = {0.0}, second[SLI_TILE] = {0.0}, most = 0.0;
    sl_int k, r;
    for (k = 0; k < u->R.columns; k++) {
        double sum = 0.0;
        for (r = 0; r < count; r++) {
            const double x = fabs(u->x[(ptrdiff_t)k * u->lanes + r]);
            sum += u->state->alpha[r] * x * x;
            second[r] = fmax(second[r], fmin(first[r], x));
            first[r] = fmax(first[r], x);
        }
        most = fmax(most, fabs(sum));
    }
    for (r = 0; r < count; r++) {
        most = fmax(most, fabs(u->state->alpha[r]) * first[r] * second[r]);
    }
    return most;
}

/* Loads the vectors of a pass, whose reach is compiled. group: their numbers. */
static void sli_update_load(sli_update *u, const sl_int *group, sl_int count) {
    const sl_symbolic *S = u->F->S;
    const sl_csc *V = u->V;
    sl_int r, p;
    u->kind = sli_update_kind(count);
    u->lanes = (sl_int)1 << u->kind;
    u->state->ranks = count;
    u->state->lanes = u->lanes;
    u->most = u->fall = u->top = u->entry = u->growth = 0.0;
    u->loss = 1.0;
    memset(u->state->U, 0, sizeof u->state->U);
    memset(u->x, 0, (size_t)u->R.columns * (size_t)u->lanes * sizeof(double));
    memset(u->gain, 0, (size_t)u->R.columns * sizeof(double));
    for (r = 0; r < count; r++) {
        const sl_int v = group[r];
        const double alpha = u->sigma == NULL ? 1.0 : u->sigma[v];
        double most = 0.0;
        u->state->U[r][r] = 1.0;
        u->state->alpha[r] = alpha;
        for (p = V->p[v]; p < V->p[v + 1]; p++) {
            const sl_int at = V->x[p] == 0.0 ? -1 : sli_reach_index_of(&u->R, S->iperm[V->i[p]]);
            if (at != -1) {
                const double x = V->x[p];
                u->x[(ptrdiff_t)at * u->lanes + r] += x;
                u->gain[at] +=
                    u->sign == 0.0 ? fabs(alpha * x * x) : fmax(0.0, 2.0 * u->sign * alpha * x * x);
                most = fmax(most, x * x);
            }
        }
        u->fall += u->sign * alpha > 0.0 ? 0.0 : fabs(alpha) * most;
    }
    u->fall = u->sign == 0.0 ? sli_update_largest(u, count) : u->fall;
}

/* Checks the pivots of a pass that is loaded, with F as it is: they depend on L^-1 W alone. A
 * forward sweep takes less time than a copy of the columns, which would undo a failure. */
static sl_status sli_update_try(sli_update *u, const sl_int *group, sl_int count) {
    const sli_reach *R = &u->R;
    sl_status status = SL_OK;
    sl_int s, j, k, r;
    memset(u->local, 0, SLI_TILE * (size_t)u->lanes * sizeof(double));
    memcpy(u->trial, u->x, (size_t)R->columns * (size_t)u->lanes * sizeof(double));
    sli_forward_sweep(u->F, u->kind, R->count, R->steps, R->rows, u->trial, u->scratch);
    u->is_trial = 1;
    for (s = 0; s < R->count; s++) {
        const sli_step *step = &R->steps[s];
        for (j = 0; j < sli_step_columns(step) && status == SL_OK; j += SLI_TILE) {
            const double *y = u->trial + (ptrdiff_t)u->lanes * (step->base + j);
            const sl_int columns = sli_min(SLI_TILE, sli_step_columns(step) - j);
            for (k = 0; k < columns; k++, y += u->lanes) {
                for (r = 0; r < u->lanes; r++) {
                    u->local[SLI_TILE * r + k] = y[r];
                }
            }
            status = sli_update_pivots(u, step->column + j, columns, NULL, u->local, u->c);
        }
    }
    u->is_trial = 0;
    u->is_tried = status == SL_OK;
    sli_update_load(u, group, count); /* U and alpha as they were */
    return status;
}

/* Changes the columns on the paths of the vectors that are loaded. */
static sl_status sli_update_run(sli_update *u) {
    const sl_int *rows = u->R.rows;
    sl_status status = SL_OK;
    sl_int s;
    for (s = 0; s < u->R.count && status == SL_OK; s++) {
        status = sli_update_step(u, &u->R.steps[s], rows);
        rows += u->R.steps[s].below;
    }
    return status;
}

#endif

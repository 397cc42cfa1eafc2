/* update.h: one pass of a rank-k change: the columns on the paths of up to 8 vectors */
#ifndef SLI_CHANGE_UPDATE_H
#define SLI_CHANGE_UPDATE_H

#include "update_pivots.h"

/* y and -b of the columns of a step from local column j on, and their e and magnitudes. After a
 * trial they are those of the whole reach. */
SLI_INLINE sl_int sli_update_at(const sli_update *u, const sli_step *step, sl_int j) {
    return j - SLI_TILE * step->first_tile + (u->keeps ? step->base : 0);
}

/* The pivots of column tile c, and the rows of that tile. w: [lane][8] of its rows. */
static sl_status sli_update_tile(sli_update *u, const sli_step *step, sl_int c, double *w) {
    const sl_int first = SLI_TILE * c, columns = sli_min(SLI_TILE, step->width - first);
    const sl_int at = sli_update_at(u, step, first);
    double *l = u->panel + sli_panel_at(step->width, first, first);
    double *const y = u->c + 2 * (ptrdiff_t)u->lanes * at;
    const sl_int k = step->column + first - SLI_TILE * step->first_tile;
    sl_int j, r, done = columns;
    sl_status status;
    if (u->is_tried) {
        status = sli_update_take_all(u, k, columns, u->e + at, u->magnitude + at);
    } else {
        done = sli_change_kernels_of(u->F->kernels->isa)
                   ->ranks(u->state, l, columns, u->F->D + k, w, y);
        status = sli_update_take_all(u, k, done, u->state->e, u->state->magnitude);
        if (u->is_trial) {
            SLI_COPY(u->e + at, u->state->e, columns);
            SLI_COPY(u->magnitude + at, u->state->magnitude, columns);
        }
    }
    for (j = 0; j < columns && u->sign == 0.0 && status == SL_OK; j++) {
        if (first + j + 1 < step->width + step->below) {
            u->loss = fmax(u->loss, u->state->magnitude[j] / fabs(u->state->e[j]));
        }
    }
    if (status == SL_OK) {
        /* a vector adds alpha f^2 to a pivot, where f is y or, beyond the first vector, a
         * difference of what the old L has made of W: it has the digits of the larger y */
        for (j = 0; j < columns && u->state->ranks > 1 && !u->is_tried; j++) {
            const double sum = u->state->magnitude[j] * (double)u->state->ranks;
            if (u->state->swept[j] > u->swept * sum) {
                u->swept = u->state->swept[j] / sum;
            }
        }
        sli_change_kernels_of(u->F->kernels->isa)
            ->change[u->kind - 1](l, columns, y, w, u->is_trial);
        /* the kernel has changed the part above them, too; memset is slow for a few bytes */
        for (r = 0; r < columns && !u->is_trial; r++) {
            for (j = r; j < columns; j++) {
                l[SLI_TILE * j + r] = 0.0;
            }
        }
    }
    return status;
}

/* Applies columns from .. to-1 to row tile t, or to two from there on. */
static void sli_update_rows(const sli_update *u, const sli_step *step, sl_int t, sl_int from,
                            sl_int to, int is_pair) {
    const sli_change_kernels *kernels = sli_change_kernels_of(u->F->kernels->isa);
    const double *c = u->c + 2 * (ptrdiff_t)u->lanes * sli_update_at(u, step, from);
    double *l = u->panel + sli_panel_at(step->width, SLI_TILE * t, from);
    double *w = u->local + SLI_TILE * (ptrdiff_t)u->lanes * (t - step->first_tile);
    if (is_pair) {
        kernels->pair(l, u->panel + sli_panel_at(step->width, SLI_TILE * (t + 1), from), to - from,
                      c, w, u->is_trial);
    } else {
        kernels->change[u->kind - 1](l, to - from, c, w, u->is_trial);
    }
}

/* Moves rows of a step between the compact vector and the tiles, [tile][lane][8]: into the tiles,
 * or those below the columns back. lanes: a constant */
SLI_ALWAYS_INLINE void sli_update_move_rows(const sli_update *u, const sli_step *step,
                                            const sl_int *rows, int is_back, const sl_int lanes) {
    const sl_int own = sli_step_columns(step), all = own + step->below;
    sl_int i, r;
    for (i = is_back ? own : 0; i < all; i++) {
        double *x = u->x + (ptrdiff_t)lanes * (i < own ? step->base + i : rows[i - own]);
        double *w = u->local + (ptrdiff_t)lanes * (i - i % SLI_TILE) + i % SLI_TILE;
        SLI_UNROLL
        for (r = 0; r < lanes; r++) {
            if (is_back) {
                x[r] = w[SLI_TILE * r];
            } else {
                w[SLI_TILE * r] = x[r];
            }
        }
    }
}

/* The same for any number of lanes. */
static void sli_update_move(const sli_update *u, const sli_step *step, const sl_int *rows,
                            int is_back) {
    const sli_kernels *kernels = u->F->kernels;
    const sl_int lanes = u->lanes, own = sli_step_columns(step), all = own + step->below;
    sl_int t = all - all % SLI_TILE, i, at[SLI_TILE];
    if (t < all && !is_back) {
        memset(u->local + lanes * t, 0, SLI_TILE * (size_t)lanes * sizeof(double));
    }
    if (lanes == 2) {
        sli_update_move_rows(u, step, rows, is_back, 2);
    } else if (lanes == 4) {
        sli_update_move_rows(u, step, rows, is_back, 4);
    }
    for (t = is_back ? own - own % SLI_TILE : 0; t < all && lanes == SLI_TILE; t += SLI_TILE) {
        const sl_int count = sli_min(SLI_TILE, all - t);
        double *w = u->local + (ptrdiff_t)lanes * t;
        for (i = 0; i < count; i++) {
            at[i] = t + i < own ? step->base + t + i : rows[t + i - own];
        }
        if (is_back) {
            kernels->interleave(u->x, sli_rows_of(at, count, lanes), w, SLI_TILE, 0);
        } else {
            kernels->separate(w, SLI_TILE, u->x, sli_rows_of(at, count, lanes));
        }
    }
}

/* Adds sign |L| |D| |L'| of the columns of a step to the gains of their rows. */
static void sli_update_gains(const sli_update *u, const sli_step *step, const sl_int *rows,
                             double sign) {
    const sl_int entered = SLI_TILE * step->first_tile, all = step->width + step->below;
    const double *D = u->F->D + step->column;
    const sli_change_kernels *kernels = sli_change_kernels_of(u->F->kernels->isa);
    double *sums = u->local; /* before and after the vectors */
    const sl_int stride = SLI_TILE * step->width, square = step->width / SLI_TILE;
    sl_int t, r, tiles;
    for (t = step->first_tile; t < sli_tiles(all); t += tiles) {
        const sl_int first = SLI_TILE * t;
        tiles = t >= square && t + 4 <= sli_tiles(all) ? 4 : 1;
        for (r = first; r < first + SLI_TILE * tiles; r++) {
            sums[r - first] = r < step->width ? fabs(D[r - entered]) : 0.0;
        }
        /* of the diagonal tiles what is not below the diagonal is 0 */
        kernels->magnitudes(u->panel + sli_panel_at(step->width, first, entered), stride, tiles,
                            sli_min(first + SLI_TILE, step->width) - entered, D, sums);
        for (r = first; r < sli_min(first + SLI_TILE * tiles, step->width); r++) {
            u->gain[step->base + r - entered] += sign * sums[r - first];
        }
        for (; r < sli_min(first + SLI_TILE * tiles, all); r++) {
            u->gain[rows[r - step->width]] += sign * sums[r - first];
        }
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

/* Column tiles that are applied to all rows together: so their y and b stay in the first cache. A
 * trial reads L in the order of its tiles. */
#define SLI_UPDATE_COLUMNS 16

/* Changes the columns of one step. On failure some of them are changed. */
static sl_status sli_update_step(sli_update *u, const sli_step *step, const sl_int *rows) {
    const sl_int entered = step->first_tile, wide = sli_tiles(step->width);
    const sl_int tiles = sli_tiles(step->width + step->below);
    sl_status status = SL_OK;
    sl_int c0, c1, t;
    sli_update_open(u, step);
    if (u->sign == 0.0) {
        sli_update_gains(u, step, rows, -1.0);
    } else if (!u->is_trial) {
        sli_loss_open(u->F, u->F->S->super_of[step->column]);
    }
    sli_update_move(u, step, rows, 0);
    for (c0 = entered; c0 < wide; c0 = c1) { /* only a trial fails, and takes all at once */
        sl_int from = SLI_TILE * c0, next;
        c1 = u->is_trial ? wide : sli_min(c0 + SLI_UPDATE_COLUMNS, wide);
        for (t = c0; t < tiles && status == SL_OK; t++, from = next) {
            const sl_int to = sli_min(SLI_TILE * sli_min(t, c1), step->width);
            const int is_pair =
                u->lanes == 2 && from == SLI_TILE * c0 && from < to && t + 1 < tiles;
            next = is_pair && t < c1 ? to : SLI_TILE * c0;
            if (from < to) {
                sli_update_rows(u, step, t, from, to, is_pair);
                t += is_pair && t >= c1;
            }
            if (t < c1) {
                status = sli_update_tile(u, step, t,
                                         u->local + SLI_TILE * (ptrdiff_t)u->lanes * (t - entered));
            }
        }
    }
    if (!u->is_trial) {
        sli_update_close(u, step);
    }
    if (status != SL_OK) {
        return status;
    }
    sli_update_move(u, step, rows, 1);
    if (u->is_trial) {
        return SL_OK;
    }
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
SLI_COLD static double sli_update_largest(const sli_update *u, sl_int count) {
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
SLI_COLD static void sli_update_load(sli_update *u, const sl_int *group, sl_int count) {
    const sl_symbolic *S = u->F->S;
    const sl_csc *V = u->V;
    double largest = -1.0;
    sl_int r, p;
    u->kind = sli_update_kind(count);
    u->lanes = (sl_int)1 << u->kind;
    u->state->ranks = count;
    u->state->is_mixed = u->sign == 0.0;
    u->state->lanes = u->lanes;
    u->most = u->fall = u->top = u->entry = u->growth = 0.0;
    u->low = DBL_MAX;
    u->is_tried = 0;
    u->loss = u->swept = 1.0;
    u->lost = 0.0;
    memset(u->state->U, 0, sizeof u->state->U);
    SLI_ZERO(u->x, (size_t)u->R.columns * (size_t)u->lanes);
    SLI_ZERO(u->gain, u->R.columns);
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
                u->row = fabs(alpha * x * x) > largest ? S->iperm[V->i[p]] : u->row;
                largest = fmax(largest, fabs(alpha * x * x));
            }
        }
        u->fall += u->sign * alpha > 0.0 ? 0.0 : fabs(alpha) * most;
        u->state->unit[r] = most > 0.0 ? 1.0 / most : 0.0;
        u->state->square[r] = most;
    }
    u->fall = u->sign == 0.0 ? sli_update_largest(u, count) : u->fall;
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

/* Checks the pivots of a pass that is loaded, and changes nothing: the pass without its changes of
 * L, which takes less time than a copy of the columns. Its y, b and pivots remain for the pass. */
static sl_status sli_update_try(sli_update *u) {
    const size_t size = (size_t)u->R.columns * (size_t)u->lanes;
    sl_status status;
    SLI_COPY(u->trial, u->x, size);
    u->is_trial = 1;
    status = sli_update_run(u);
    u->is_trial = 0;
    u->is_tried = status == SL_OK;
    SLI_COPY(u->x, u->trial, size);
    return status;
}

#endif

/* path.h: rank-one changes, supernode by supernode on one path */
#ifndef SLI_CHANGE_PATH_H
#define SLI_CHANGE_PATH_H

#include "update.h"

/* All pivots have one sign. A path needs no compact vector: what is left of w below a supernode
 * goes to the front of its parent by relative indices. */

/* Entries of L from which on a path does not stay in the second cache, but for a small part. */
#define SLI_PATH_CACHED (1 << 19)

static void sli_path_layout(sli_update *u, sli_block *b, const sli_reach *R, int is_path) {
    const uint64_t columns = (uint64_t)R->columns + SLI_TILE * (uint64_t)R->count;
    u->ahead = R->entries > SLI_PATH_CACHED ? SLI_PREFETCH_DISTANCE / 2 : 0;
    u->path = SLI_TAKE(b, sli_rank_one, is_path ? R->count : 0);
    u->vectors = SLI_TAKE(b, double, is_path ? 2 * (2 * columns + (uint64_t)R->n_rows) : 0);
}

/* Loads vector v into the rows of supernode s, times the root of its weight. Returns the sign of
 * the weight. */
SLI_COLD static double sli_path_load(sli_update *u, sl_int v, sl_int s, double *w) {
    const sl_symbolic *S = u->F->S;
    const sl_csc *V = u->V;
    const double sigma = u->sigma == NULL ? 1.0 : u->sigma[v], scale = sqrt(fabs(sigma));
    const sli_step *step = &S->steps[s];
    double most = 0.0;
    sl_int p;
    memset(w, 0, SLI_TILE * (size_t)sli_tiles(step->width + step->below) * sizeof *w);
    for (p = V->p[v]; p < V->p[v + 1]; p++) {
        const sl_int k = S->iperm[V->i[p]];
        if (V->x[p] != 0.0) {
            const sl_int at =
                k < step->column + step->width
                    ? k - step->column
                    : step->width + sli_lower_bound(S->rows + S->rows_begin[s], step->below, k);
            w[at] += scale * V->x[p];
            most = fmax(most, V->x[p] * V->x[p]);
        }
    }
    u->fall = u->sign * sigma > 0.0 ? 0.0 : fabs(sigma) * most;
    return sigma < 0.0 ? -1.0 : 1.0;
}

/* Adds what vector v adds to the magnitudes of supernode s. Returns how many of its entries are
 * there. The sum of row k is at most 2 |a_kk|, and its gain twice the change of a_kk. */
static sl_int sli_path_extent(sli_update *u, sl_int v, sl_int s) {
    const sl_symbolic *S = u->F->S;
    const sl_csc *V = u->V;
    sli_extent *extent = &u->F->extents[s];
    const double weight = u->sign * (u->sigma == NULL ? 1.0 : u->sigma[v]);
    double most = 0.0;
    sl_int p, found = 0;
    for (p = V->p[v]; p < V->p[v + 1]; p++) {
        const sl_int k = S->iperm[V->i[p]];
        if (S->super_of[k] == s) {
            const double gain = weight * V->x[p] * V->x[p];
            found++;
            if (gain > most) {
                most = gain;
                extent->pivot = k;
            }
        }
    }
    extent->magnitude += 2.0 * most;
    extent->entry += most;
    return found;
}

/* Takes the pivots of a supernode that is swept, or checks them, or, after all were checked and are
 * usual, only writes them. */
static sl_status sli_path_take(sli_update *u, const sli_rank_one *one) {
    sl_factor *F = u->F;
    const sl_int entered = SLI_TILE * one->first_tile, count = one->width - entered;
    const sl_int k = F->S->super_first[one->super] + entered;
    const double *e = one->e + entered;
    sl_int j;
    if (!u->is_trial) {
        sli_loss_open(F, one->super);
    }
    if (!u->is_tried || !u->are_usual) {
        return sli_update_take_all(u, k, count, e, NULL);
    }
    for (j = 0; j < count; j++) {
        const double d = F->D[k + j];
        F->history.loss[k + j] += fabs(d) + fabs(e[j] - d);
        F->D[k + j] = e[j];
    }
    return SL_OK;
}

/* Lays the vectors of the next supernode of the path, s, into the room at *next, and loads into
 * them vector v or what the supernode before has left. */
static sli_rank_one *sli_path_open(sli_update *u, sl_int v, sl_int s, sl_int count, double **next) {
    const sl_symbolic *S = u->F->S;
    const sli_step *step = &S->steps[s];
    const sl_int wide = SLI_TILE * sli_tiles(step->width);
    const sl_int rows = SLI_TILE * sli_tiles(step->width + step->below);
    sli_rank_one *one = &u->path[count];
    one->w = *next;
    one->y = one->w + rows;
    one->b = one->y + rows;
    one->e = one->b + wide;
    *next = one->e + wide;
    if (count == 0) {
        one->sum = -sli_path_load(u, v, s, one->w);
    } else {
        const sli_rank_one *last = one - 1;
        const sl_int *to = S->relative + S->rows_begin[last->super];
        const double *from = (u->is_trial ? last->y : last->w) + last->width;
        sl_int i;
        one->sum = last->sum;
        one->first_tile = to[0] / SLI_TILE; /* it has a parent, and so a row below */
        memset(one->w + SLI_TILE * one->first_tile, 0,
               (size_t)(rows - SLI_TILE * one->first_tile) * sizeof *one->w);
        for (i = 0; i < last->below; i++) {
            one->w[to[i]] = from[i];
        }
    }
    one->ahead = u->ahead;
    one->super = s;
    one->D = u->F->D + step->column;
    one->width = step->width;
    one->below = step->below;
    return one;
}

/* Sweeps a vector along its path, and changes the columns, if it is a trial the pivots only.
 * *count := the supernodes of the path. On failure some columns are changed, none by a trial. */
static sl_status sli_path_sweep(sli_update *u, uint64_t seed, sl_int *count) {
    const sl_symbolic *S = u->F->S;
    const sli_change_kernels *kernels = sli_change_kernels_of(u->F->kernels->isa);
    sl_int s = S->super_of[sli_key(seed)];
    double *next = u->vectors;
    sl_status status = SL_OK;
    u->path[0].first_tile = (sli_key(seed) - S->super_first[s]) / SLI_TILE;
    for (*count = 0; s != -1 && status == SL_OK; s = S->super_parent[s], ++*count) {
        sli_rank_one *one = sli_path_open(u, sli_value(seed), s, *count, &next);
        sli_update_open(u, &S->steps[s]);
        one->panel = u->panel;
        kernels->panel(one, 1, !u->is_trial);
        if (!u->is_trial) {
            sli_update_close(u, &S->steps[s]);
        }
        status = sli_path_take(u, one);
    }
    return status;
}

/* Changes what a trial has swept: the pivots, and the panels from the root down, as what was swept
 * last is in the cache. */
static void sli_path_write(sli_update *u, sl_int count) {
    const sli_change_kernels *kernels = sli_change_kernels_of(u->F->kernels->isa);
    sl_int k;
    for (k = 0; k < count; k++) {
        (void)sli_path_take(u, &u->path[k]);
    }
    for (k = count - 1; k >= 0; k--) {
        const sli_step *step = &u->F->S->steps[u->path[k].super];
        sli_update_open(u, step);
        u->path[k].panel = u->panel;
        kernels->panel(&u->path[k], 0, 1);
        sli_update_close(u, step);
    }
}

/* Notes what vector v has added to the magnitudes of the path. */
static void sli_path_note(sli_update *u, sl_int v, sl_int count) {
    sl_factor *F = u->F;
    sl_int k, rest = u->V->p[v + 1] - u->V->p[v];
    for (k = 0; k < count; k++) {
        const sl_int s = u->path[k].super;
        rest -= rest > 0 ? sli_path_extent(u, v, s) : 0;
        u->entry = fmax(u->entry, F->extents[s].entry);
        u->growth = fmax(u->growth, F->extents[s].magnitude);
        if (F->history.marks != NULL) {
            F->history.marks[s] = 0;
        }
    }
}

/* Changes L by one vector, if `is_tried` after all pivots were checked. seed: its first column and
 * its number. On failure some columns are changed, none if it is tried. */
static sl_status sli_path_run(sli_update *u, uint64_t seed, int is_tried) {
    sl_factor_info *info = &u->F->stats.factor;
    sl_int count;
    sl_status status;
    u->is_trial = is_tried;
    u->is_tried = 0;
    u->most = u->top = u->entry = u->growth = 0.0;
    u->low = DBL_MAX;
    u->are_usual = 1;
    u->loss = u->swept = 1.0;
    u->lost = 0.0;
    u->state->ranks = 1;
    status = sli_path_sweep(u, seed, &count);
    u->is_trial = 0;
    if (status != SL_OK) {
        return status;
    }
    u->is_tried = is_tried;
    if (is_tried) {
        sli_path_write(u, count);
    }
    info->pivot_min = fmin(info->pivot_min, u->low);
    info->pivot_max = fmax(info->pivot_max, u->top);
    sli_path_note(u, sli_value(seed), count);
    return SL_OK;
}

#endif

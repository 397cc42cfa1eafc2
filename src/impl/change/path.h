/* path.h: rank-one changes, supernode by supernode on one path */
#ifndef SLI_CHANGE_PATH_H
#define SLI_CHANGE_PATH_H

#include "update.h"

/* All pivots have one sign. A path needs no compact vector: what is left of w below a supernode
 * goes to the front of its parent by relative indices. */

/* Loads vector v into the rows of supernode s, times the root of its weight. Returns the sign of
 * the weight. */
static double sli_path_load(sli_update *u, sl_int v, sl_int s, double *w) {
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

/* Changes the columns on the path of a vector, or tries whether that is possible. seed: its first
 * column and its number. On failure some are changed. */
static sl_status sli_path_run(sli_update *u, uint64_t seed, int is_trial) {
    sl_factor *F = u->F;
    const sl_symbolic *S = F->S;
    sl_int s = S->super_of[sli_key(seed)], i, rest, entered, k;
    const sl_int v = sli_value(seed);
    double *w = u->local, *next = u->other, *last;
    sl_status status = SL_OK;
    sli_rank_one one;
    one.is_trial = u->is_trial = is_trial;
    one.sum = -sli_path_load(u, v, s, w);
    one.e = u->c;
    one.b = u->b;
    one.first_tile = (sli_key(seed) - S->super_first[s]) / SLI_TILE;
    u->most = u->top = u->entry = u->growth = 0.0;
    u->loss = u->swept = 1.0;
    u->lost = 0.0;
    u->state->ranks = 1;
    for (rest = u->V->p[v + 1] - u->V->p[v]; s != -1 && status == SL_OK; s = S->super_parent[s]) {
        const sli_step *step = &S->steps[s];
        const sl_int *to = S->relative + S->rows_begin[s];
        sli_loss_open(F, s);
        sli_update_open(u, step);
        one.panel = u->panel;
        one.D = F->D + step->column;
        one.width = step->width;
        one.below = step->below;
        one.w = w;
        sli_change_kernels_of(F->kernels->isa)->panel(&one);
        sli_update_close(u, step);
        entered = SLI_TILE * one.first_tile;
        k = step->column + entered;
        status = sli_update_take_all(u, k, step->width - entered, one.e + entered, NULL);
        if (!is_trial) {
            rest -= rest > 0 ? sli_path_extent(u, v, s) : 0;
            u->entry = fmax(u->entry, F->extents[s].entry);
            u->growth = fmax(u->growth, F->extents[s].magnitude);
            if (F->history.marks != NULL) {
                F->history.marks[s] = 0;
            }
        }
        if (S->super_parent[s] != -1) {
            const sli_step *up = &S->steps[S->super_parent[s]];
            one.first_tile = to[0] / SLI_TILE;
            memset(next + SLI_TILE * one.first_tile, 0,
                   SLI_TILE * (size_t)(sli_tiles(up->width + up->below) - one.first_tile) *
                       sizeof *next);
            for (i = 0; i < step->below; i++) {
                next[to[i]] = w[step->width + i];
            }
            last = w;
            w = next;
            next = last;
        }
    }
    u->is_trial = 0;
    u->is_tried = is_trial && status == SL_OK;
    return status;
}

#endif

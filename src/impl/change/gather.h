/* gather.h: adds the updates of descendants, computed from their panels, to a front */
#ifndef SLI_CHANGE_GATHER_H
#define SLI_CHANGE_GATHER_H

#include "../factor/multifrontal.h"

/* Scratch of a worker that gathers updates. */
typedef struct sli_left_work {
    /* n: the local row of each row of the current supernode; undefined for other rows */
    sl_int *local;
    /* rows of the tallest front: the relative indices of a descendant in the current supernode */
    sl_int *relative;
    double *buffer;        /* kernel scratch */
    const uint64_t *seeds; /* n_seeds: the columns of L that hold what has changed, ascending */
    sl_int n_seeds;
} sli_left_work;

/* A descendant of the supernode of a front: its rows first, first+1, .. below the diagonal are rows
 * of the front, and its update has the columns before `last`. */
typedef struct sli_descendant {
    sl_int super, first, last;
} sli_descendant;

/* Adds the update of a descendant to the front f. update: room for its triangle. */
static void sli_left_update(const sl_factor *F, const sli_left_work *p, const sli_front *f,
                            const sli_descendant *d, double *update) {
    const sl_symbolic *S = F->S;
    const sl_int *rows = S->rows + S->rows_begin[d->super];
    const sl_int first = d->first, last = d->last;
    sli_front from = sli_double_front_of(F, d->super, 0);
    const sl_int w = from.width, tiles = sli_front_tiles(&from);
    const sl_int c0 = (w + first) / SLI_TILE, c1 = sli_tiles(w + last);
    sl_int t, r;
    from.update = update;
    for (t = c0; t < tiles; t++) {
        memset(from.update + sli_triangle_offset(t - c0), 0,
               (size_t)sli_min(t + 1 - c0, c1 - c0) * SLI_TILE * SLI_TILE * sizeof(double));
    }
    F->kernels->front.update(&from, c0, c1, c0, tiles, p->buffer);
    for (r = first; r < from.below; r++) {
        p->relative[r - first] = p->local[rows[r]];
    }
    F->kernels->front.assemble(f, from.update, (w + first) % SLI_TILE, p->relative, last - first, 0,
                               from.below - first);
}

/* Adds |l d l| of rows first .. last-1 of a descendant to the magnitudes of f. The relative indices
 * are those of its update. */
static void sli_left_magnitudes(const sl_factor *F, const sli_left_work *p, const sli_front *f,
                                const sli_descendant *d) {
    const sli_front from = sli_double_front_of(F, d->super, 0);
    const sl_int w = from.width;
    sl_int r, j;
    for (r = d->first; r < d->last; r++) {
        const double *l = from.panel + sli_panel_at(w, w + r, 0);
        double *magnitude = f->magnitude + p->relative[r - d->first];
        for (j = 0; j < w; j++, l += SLI_TILE) {
            if (from.pairs != NULL && from.pairs[j] == SLI_PAIR_FIRST) {
                const sli_pair size = sli_pair_absolute(from.D[j], from.D[j + 1], from.E[j]);
                *magnitude += sli_pair_gain(&size, l[0], l[SLI_TILE]);
            } else if (from.pairs == NULL || from.pairs[j] == SLI_PAIR_NONE) {
                *magnitude += fabs(*l * *l * from.D[j]);
            }
        }
    }
}

#endif

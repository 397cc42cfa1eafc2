/* kept.h: supernodes whose numbers are kept in a factorization: copies them where they are those of
 * another factor, and computes what the fronts above them assemble */
#ifndef SLI_CHANGE_KEPT_H
#define SLI_CHANGE_KEPT_H

#include "../factor/multifrontal.h"

/* Whole subtrees of L are kept. No front of theirs is assembled: the update matrix of the root of a
 * subtree is gathered from the panels of those of its supernodes that have rows below the root. */
typedef struct sli_kept {
    sli_copied copied;     /* from: the supernode of F */
    const sl_factor *F;    /* the factor that has the numbers; it may be the one that is computed */
    const sl_int *columns; /* n: its column of L, or -1; not read where its rows are the same */
    int is_subset;         /* the columns ascend: as many rows below as in F are the same ones */
    /* all its pivots have one sign, so that magnitudes are on the diagonals of update matrices */
    int has_one_sign;
    /* a piece a worker */
    sl_int *local;    /* n */
    sl_int *relative; /* rows of the tallest front */
    /* update_room: the largest triangle of a kept supernode, and what vector loads read beyond */
    double *update;
    sl_off update_room;
} sli_kept;

/* Allocates the scratch of the workers of G. */
static sl_status sli_kept_room(sli_kept *p, const sl_factor *G, sli_block *b) {
    const sl_symbolic *S = G->S;
    const uint64_t workers = (uint64_t)G->schedule.workers;
    sl_status status = SL_OK;
    sl_int s;
    p->has_one_sign =
        p->F->E == NULL && (p->F->stats.factor.positive == 0 || p->F->stats.factor.negative == 0);
    for (s = 0; s < S->n_supers; s++) {
        const sli_step *step = &S->steps[s];
        const sl_off size =
            sli_triangle_offset(sli_update_tiles(step->width, step->below)) + SLI_TILE;
        p->update_room = p->copied.from[s] != -1 && size > p->update_room ? size : p->update_room;
    }
    SLI_LAYOUT(b, &G->allocator, status) {
        p->local = SLI_TAKE(b, sl_int, workers * (uint64_t)S->n);
        p->relative = SLI_TAKE(b, sl_int, workers * (uint64_t)S->tallest);
        p->update = SLI_TAKE(b, double, workers *(uint64_t)p->update_room);
    }
    return status;
}

/* Copies the rows below of a panel of w columns, from a panel with other or more rows. keep: for
 * each of `count` rows its local row there. */
static void sli_kept_rows(double *to, const double *from, sl_int w, const sl_int *keep,
                          sl_int count) {
    const sl_int tiles = sli_tiles(w + count);
    sl_int t, j, r;
    for (r = 0; r < count && w == 1; r++) {
        to[1 + r] = from[keep[r]];
    }
    for (t = w / SLI_TILE; t < tiles && w > 1; t++) {
        const double *at[SLI_TILE]; /* column 0 of each row */
        double *tile = to + sli_tile_offset(w, t);
        for (r = 0; r < SLI_TILE; r++) {
            const sl_int local = SLI_TILE * t + r, row = local < w           ? local
                                                         : local < w + count ? keep[local - w]
                                                                             : -1;
            at[r] = row == -1 ? NULL : from + sli_panel_at(w, row, 0);
        }
        for (j = 0; j < w; j++) {
            for (r = 0; r < SLI_TILE; r++) {
                tile[j * SLI_TILE + r] = at[r] == NULL ? 0.0 : at[r][j * SLI_TILE];
            }
        }
    }
}

/* Copies the numbers of kept supernode s of G. keep: scratch for its rows below. */
static void sli_kept_copy(sl_factor *G, sl_int s, sl_int *keep) {
    const sli_kept *p = (const sli_kept *)(const void *)G->work.copied;
    const sl_factor *F = p->F;
    const sl_int there = p->copied.from[s];
    const sli_step *step = &F->S->steps[there], *own = &G->S->steps[s];
    const sl_int w = step->width, *rows = F->S->rows + F->S->rows_begin[there];
    const double *from = (const double *)F->values + step->panel;
    double *panel = (double *)G->values + own->panel;
    int is_whole = own->below == step->below;
    const sl_int searched = is_whole && p->is_subset ? 0 : own->below;
    sl_int k, m;
    for (k = 0, m = 0; k < searched; k++, m++) {
        const sl_int row = p->columns[G->S->rows[G->S->rows_begin[s] + k]];
        if (m >= step->below || rows[m] != row) {
            m = sli_lower_bound(rows, step->below, row);
        }
        keep[k] = w + m;
        is_whole &= m == k;
    }
    if (is_whole) {
        memcpy(panel, from, (size_t)sli_panel_size(w, own->below) * sizeof(double));
    } else {
        panel[0] = 0.0;
        memcpy(panel, from, (size_t)sli_tile_offset(w, w / SLI_TILE) * sizeof(double));
        sli_kept_rows(panel, from, w, keep, own->below);
    }
    SLI_COPY(G->D + own->column, F->D + step->column, w);
    if (F->rule.shifts != NULL) {
        SLI_COPY(G->rule.shifts + own->column, F->rule.shifts + step->column, w);
    }
    G->extents[s] = F->extents[there];
    if (G->extents[s].pivot != -1) {
        G->extents[s].pivot += own->column - step->column;
    }
}

/* Scratch of a worker that gathers updates. */
typedef struct sli_gather_work {
    /* n: the local row of each row of the current supernode; undefined for other rows */
    sl_int *local;
    /* rows of the tallest front: the relative indices of a descendant in the current supernode */
    sl_int *relative;
    double *buffer; /* kernel scratch */
} sli_gather_work;

/* A descendant of the supernode of a front: its rows first, first+1, .. below the diagonal are rows
 * of the front, and its update has the columns before `last`. */
typedef struct sli_descendant {
    sl_int super, first, last;
} sli_descendant;

/* Adds the update of a descendant to the front f, and that of one column to its magnitudes, too.
 * update: room for its triangle. */
static void sli_gather_update(const sl_factor *F, const sli_gather_work *p, const sli_front *f,
                              const sli_descendant *d, double *update) {
    const sl_symbolic *S = F->S;
    const sl_int *rows = S->rows + S->rows_begin[d->super];
    const sl_int first = d->first, last = d->last;
    sli_front from = sli_double_front_of(F, d->super, 0);
    const sl_int w = from.width, tiles = sli_front_tiles(&from);
    const sl_int c0 = (w + first) / SLI_TILE, c1 = sli_tiles(w + last);
    sl_int t, r;
    for (r = first; r < from.below; r++) {
        p->relative[r - first] = p->local[rows[r]];
    }
    if (w == 1) {
        const double *l = (const double *)F->values + S->steps[d->super].panel + 1;
        sli_plain_assemble(f, l + first, *from.D, p->relative, 0, from.below - first);
        return;
    }
    from.update = update;
    for (t = c0; t < tiles; t++) {
        memset(from.update + sli_triangle_offset(t - c0), 0,
               (size_t)sli_min(t + 1 - c0, c1 - c0) * SLI_TILE * SLI_TILE * sizeof(double));
    }
    F->kernels->front.update(&from, c0, c1, c0, tiles, p->buffer);
    F->kernels->front.assemble(f, from.update, (w + first) % SLI_TILE, p->relative, last - first, 0,
                               from.below - first);
}

/* Adds |l d l| of rows first .. last-1 of a descendant to the magnitudes of f. The relative indices
 * are those of its update. */
static void sli_gather_magnitudes(const sl_factor *F, const sli_gather_work *p, const sli_front *f,
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

/* Adds the update of the root s of a kept subtree itself to its cleared update matrix. */
static void sli_kept_update_own(const sl_factor *G, const sli_gather_work *p, const sli_front *f,
                                sl_int s, int has_one_sign) {
    sl_int k;
    for (k = 0; k < f->below; k++) {
        p->relative[k] = f->width + k;
    }
    if (f->width == 1) {
        sli_plain_assemble(f, (const double *)G->values + G->S->steps[s].panel + 1, *f->D,
                           p->relative, 0, f->below);
        return;
    }
    sli_front_update(&G->kernels->front, f, p->buffer);
    if (!has_one_sign) {
        sli_descendant all;
        all.super = s;
        all.first = 0;
        all.last = f->below;
        sli_gather_magnitudes(G, p, f, &all);
    }
}

/* Computes the update matrix of a kept subtree with root s, from the panels of those of its
 * supernodes that have rows below s. update: room for the largest triangle of one. has_one_sign:
 * all kept pivots have one sign, so that the magnitudes are on the diagonal of the result. */
static void sli_kept_update(const sl_factor *G, const sli_gather_work *p, sl_int s, sl_int worker,
                            int has_one_sign, double *update) {
    const sl_symbolic *S = G->S;
    const sli_front f = sli_double_front_of(G, s, worker);
    const sl_int *rows = S->rows + S->rows_begin[s];
    const sl_int whole = f.width / SLI_TILE, tiles = sli_front_tiles(&f);
    sl_int k, d;
    for (k = 0; k < f.below; k++) {
        p->local[rows[k]] = f.width + k;
    }
    for (k = 0; k < SLI_TILE * tiles; k++) {
        f.magnitude[k] = 0.0;
    }
    memset(f.update, 0,
           (size_t)sli_triangle_offset(sli_update_tiles(f.width, f.below)) * sizeof(double));
    sli_kept_update_own(G, p, &f, s, has_one_sign);
    for (d = s - 1; d >= S->first_descendant[s];) {
        const sl_int below = S->steps[d].below;
        sli_descendant from;
        from.super = d;
        from.first = sli_lower_bound(S->rows + S->rows_begin[d], below, S->super_first[s + 1]);
        from.last = below;
        if (from.first < below) {
            sli_gather_update(G, p, &f, &from, update);
            if (!has_one_sign && S->steps[d].width > 1) { /* else it has added them */
                sli_gather_magnitudes(G, p, &f, &from);
            }
            d--;
        } else { /* no descendant of d has a row below s either */
            d = S->first_descendant[d] - 1;
        }
    }
    for (k = f.width; k < f.width + f.below && has_one_sign; k++) {
        const sl_int tile = k / SLI_TILE - whole, column = k - SLI_TILE * whole;
        f.magnitude[k] =
            fabs(f.update[sli_triangle_offset(tile) + (sl_off)column * SLI_TILE + k % SLI_TILE]);
    }
    sli_double_front_hand_over(&f);
}

/* Copies kept supernode s to G, whose descendants are there, and prepares what it passes up. */
static void sli_kept_run(sl_factor *G, sl_int s, sl_int worker) {
    const sli_kept *p = (const sli_kept *)(const void *)G->work.copied;
    const sl_int up = G->S->super_parent[s];
    sli_gather_work work;
    work.local = p->local + (ptrdiff_t)worker * G->S->n;
    work.relative = p->relative + (ptrdiff_t)worker * G->S->tallest;
    work.buffer = G->work.buffer + (ptrdiff_t)worker * sli_front_scratch(G->S->widest);
    if (p->F != G) {
        sli_kept_copy(G, s, work.relative);
    }
    if (up != -1 && p->copied.from[up] == -1 && !G->schedule.is_plain[s]) {
        sli_kept_update(G, &work, s, worker, p->has_one_sign,
                        p->update + (ptrdiff_t)(p->update_room * worker));
    }
}

/* Of F, what `from` and `columns` say; without its scratch. */
static sli_kept sli_kept_of(const sl_factor *F, const sl_int *from, const sl_int *columns,
                            int is_subset) {
    sli_kept p;
    SLI_CLEAR(p);
    p.F = F;
    p.copied.from = from;
    p.copied.copy = sli_kept_run;
    p.columns = columns;
    p.is_subset = is_subset;
    return p;
}

/* Flops of the update matrix of kept supernode s, as sli_kept_update computes it. *visits +=
 * descendants. */
static double sli_kept_flops(const sl_symbolic *S, sl_int s, sl_int *visits) {
    const sl_int end = S->super_first[s + 1];
    double flops = (double)S->steps[s].width * S->steps[s].below * S->steps[s].below;
    sl_int d;
    for (d = s - 1; d >= S->first_descendant[s];) {
        const sl_int below = S->steps[d].below;
        const double m = below - sli_lower_bound(S->rows + S->rows_begin[d], below, end);
        if (m > 0.0) {
            flops += S->steps[d].width * m * m;
            ++*visits;
            d--;
        } else {
            d = S->first_descendant[d] - 1;
        }
    }
    return flops;
}

#endif

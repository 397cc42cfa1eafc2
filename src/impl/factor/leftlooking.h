/* leftlooking.h: supernodes factored again by pulling from all their descendants: for changes that reach few of them */
#ifndef SLI_LEFTLOOKING_H
#define SLI_LEFTLOOKING_H

#include "multifrontal.h"
#include "reach.h"

/* What pulling needs while it runs. */
typedef struct sli_pulling {
    sl_int *local;  /* n: local rows in the supernode at hand; elsewhere it means nothing */
    sl_int *places; /* rows of the tallest front: those of a descendant in it */
} sli_pulling;

static void sli_pulling_layout(sli_pulling *p, sli_block *b, const sl_symbolic *S) {
    p->local = SLI_TAKE(b, sl_int, S->n);
    p->places = SLI_TAKE(b, sl_int, S->tallest);
}

/* What descendant d takes from supernode s: its rows from number `first` on are rows of s, the ones
 * before `last` are columns of s. */
static void sli_pull(sl_factor *F, const sli_pulling *p, const sli_front *f, sl_int d, sl_int first,
                     sl_int last) {
    const sl_symbolic *S = F->S;
    const sl_int *rows = S->rows + S->rows_begin[d];
    sli_front from = sli_front_of(F, d, 0);
    const sl_int w = from.width, tiles = sli_front_tiles(&from);
    const sl_int c0 = (w + first) / SLI_TILE, c1 = sli_tiles(w + last);
    sl_int t, r, j;
    from.update = F->waiting; /* no other update matrix is under way */
    for (t = c0; t < tiles; t++) {
        memset(from.update + sli_triangle_offset(t - c0), 0,
               (size_t)sli_min(t + 1 - c0, c1 - c0) * SLI_TILE * SLI_TILE * sizeof(double));
    }
    F->kernels->update(&from, c0, c1, c0, tiles, F->buffer);
    for (r = first; r < from.below; r++) {
        p->places[r - first] = p->local[rows[r]];
    }
    F->kernels->assemble(f, from.update, (w + first) % SLI_TILE, p->places, last - first, 0,
                         from.below - first);
    for (r = first; r < last; r++) { /* |l d l| of the pivots to come */
        const double *l = from.panel + sli_panel_at(w, w + r, 0);
        for (j = 0; j < w; j++) {
            f->magnitude[p->places[r - first]] +=
                fabs(l[SLI_TILE * (ptrdiff_t)j] * l[SLI_TILE * (ptrdiff_t)j] * from.D[j]);
        }
    }
}

/* Supernode s from A and its descendants, parents before children: those that have no row among the
 * columns of s have no descendant with one. */
static sl_status sli_left_looking(sl_factor *F, const sli_pulling *p, const sli_source *from,
                                  sl_int s, sli_failure *failure) {
    const sl_symbolic *S = F->S;
    sli_front f = sli_front_of(F, s, 0);
    const sl_int *rows = S->rows + S->rows_begin[s];
    const sl_int start = S->super_first[s], end = S->super_first[s + 1];
    sl_int k, d;
    sl_status status;
    for (k = 0; k < f.width; k++) {
        p->local[start + k] = k;
    }
    for (k = 0; k < f.below; k++) {
        p->local[rows[k]] = f.width + k;
    }
    memset(f.panel, 0, (size_t)sli_panel_size(f.width, f.below) * sizeof(double));
    status = sli_front_load(F, from, &f, s, failure);
    if (status != SL_OK) {
        return status;
    }
    for (d = s - 1; d >= S->descendant[s];) {
        const sl_int *of = S->rows + S->rows_begin[d], below = S->steps[d].below;
        const sl_int first = sli_lower_bound(of, below, start);
        const sl_int last = first + sli_lower_bound(of + first, below - first, end);
        if (first < last) {
            sli_pull(F, p, &f, d, first, last);
            d--;
        } else {
            d = S->descendant[d] - 1;
        }
    }
    sli_front_eliminate(F->kernels, &f, F->buffer);
    return sli_front_check(F, &f, s, failure);
}

/* Every supernode on the way from the seeds, columns of L in ascending order, to the roots. */
static sl_status sli_left_looking_all(sl_factor *F, const sli_pulling *p, const sli_source *from,
                                      const uint64_t *seeds, sl_int count, sli_failure *failure) {
    const sl_symbolic *S = F->S;
    sl_status status = SL_OK;
    sl_int k = 0, s, next;
    while (k < count && status == SL_OK) {
        s = S->super_of[sli_key(seeds[k])];
        next = sli_next_seed(S, seeds, count, &k);
        for (; s != -1 && s < next && status == SL_OK; s = S->super_parent[s]) {
            status = sli_left_looking(F, p, from, s, failure);
        }
    }
    return status;
}

#endif

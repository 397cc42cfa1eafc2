/* null_sums.h: sums over right-hand sides of a singular system: |b|, and z' b of null vectors z */
#ifndef SLI_SINGULAR_NULL_SUMS_H
#define SLI_SINGULAR_NULL_SUMS_H

#include "../solve/packed.h"

/* Adds the magnitudes of `count` doubles of a step, as sli_chains_dot adds products. */
static void sli_chains_norm(double *chains, const double *row, ptrdiff_t count, ptrdiff_t next) {
    ptrdiff_t f = 0;
    sl_int q;
    for (; f + SLI_TILE <= count; f += SLI_TILE, row += next) {
        SLI_UNROLL
        for (q = 0; q < SLI_TILE; q++) {
            chains[q] += fabs(row[q]);
        }
    }
    for (q = 0; f < count; q++, f++) {
        chains[q] += fabs(row[q]);
    }
}

/* Adds the products of v with lanes r .. r+7 of a step, or with all lanes if they are fewer. */
static void sli_chains_add_step(double *chains, const double *v, const sli_packed *b,
                                const sli_step *step, sl_int r) {
    sli_chains_add(chains, v + step->column, sli_packed_row(b, step->base) + r,
                   sli_max(b->lanes, SLI_TILE), sli_step_columns(step),
                   sli_min(b->lanes, SLI_TILE));
}

/* sums(r) := those of the chains of all lanes. */
static void sli_chains_sum_all(const double *chains, sl_int lanes, double *sums) {
    sl_int r;
    for (r = 0; r < lanes; r += SLI_TILE) {
        sli_chains_sum(chains + r, sli_min(lanes, SLI_TILE), sums + r);
    }
}

/* norms(r) := the sum of |b|. */
static void sli_norms(const sli_packed *b, double *norms) {
    const sli_reach *R = b->R;
    const sl_int lanes = b->lanes;
    double chains[SLI_BLOCK_SINGULAR];
    sl_int s, r;
    SLI_ZERO(chains, sli_max(lanes, SLI_TILE));
    for (s = 0; s < R->count; s++) {
        for (r = 0; r < lanes; r += SLI_TILE) {
            sli_chains_norm(chains + r, sli_packed_row(b, R->steps[s].base) + r,
                            (ptrdiff_t)sli_step_columns(&R->steps[s]) * sli_min(lanes, SLI_TILE),
                            sli_max(lanes, SLI_TILE));
        }
    }
    sli_chains_sum_all(chains, lanes, norms);
}

/* Finds the next null pivot of a tree, from number dot->next on, whose null vector is known, and
 * computes z' b before the forward sweep of the tree's steps first .. root. Returns 0 if there is
 * none. */
static int sli_null_dot_next(const sl_factor *F, const sli_packed *b, sl_int first, sl_int root,
                             sli_null_dot *dot) {
    const sl_int last = sli_tree_range_of(F->S, &b->R->steps[root]).root, lanes = b->lanes;
    double chains[SLI_BLOCK_SINGULAR];
    const double *z;
    sl_int column = -1, r;
    for (; dot->next < F->null.count && F->null.pivots[dot->next] <= last && column == -1;
         dot->next++) {
        dot->number = dot->next;
        dot->null = F->null.pivots[dot->next];
        column = sli_null_column(F, dot->null);
    }
    if (column == -1) {
        return 0;
    }
    z = F->null.g + (size_t)column * (size_t)F->S->n;
    SLI_ZERO(chains, sli_max(lanes, SLI_TILE));
    for (; first <= root; first++) {
        for (r = 0; r < lanes; r += SLI_TILE) {
            sli_chains_add_step(chains + r, z, b, &b->R->steps[first], r);
        }
    }
    sli_chains_sum_all(chains, lanes, dot->sums);
    for (r = 0; r < lanes; r++) {
        dot->sums[r] /= z[dot->null];
    }
    return 1;
}

#endif

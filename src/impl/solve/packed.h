/* packed.h: blocks of vectors over a reach: trees, and sums that are the same in every reach */
#ifndef SLI_SOLVE_PACKED_H
#define SLI_SOLVE_PACKED_H

#include "query.h"

/* Adds the products of v with the columns x lanes doubles of a step, which begins at a whole tile.
 * 8 independent chains of additions hide the latency. Double f of a step goes to chain f % 8, in a
 * local sweep as in a full one, so the bits agree. next: from 8 doubles to the next 8. Called with
 * constant lanes. */
SLI_ALWAYS_INLINE void sli_chains_dot(double *chains, const double *v, const double *row,
                                      ptrdiff_t next, sl_int columns, sl_int lanes) {
    const ptrdiff_t count = (ptrdiff_t)columns * lanes;
    ptrdiff_t f = 0;
    double sums[SLI_TILE]; /* in registers: chains could be a part of v */
    sl_int q;
    memcpy(sums, chains, sizeof sums);
    for (; f + SLI_TILE <= count; f += SLI_TILE, v += SLI_TILE / lanes, row += next) {
        SLI_UNROLL
        for (q = 0; q < SLI_TILE; q++) { /* sum(r) += v(k) y(k, r) */
            sums[q] += v[q / lanes] * row[q];
        }
    }
    memcpy(chains, sums, sizeof sums);
    for (q = 0; f < count; q++, f++) { /* untested: none left of 8 lanes */
        chains[q] += v[q / lanes] * row[q];
    }
}

/* sums(r) := the sum of the chains of right-hand side r, in order. */
SLI_NOINLINE static void sli_chains_sum(const double *chains, sl_int lanes, double *sums) {
    sl_int q;
    for (q = 0; q < lanes; q++) {
        sums[q] = chains[q];
    }
    for (; q < SLI_TILE; q++) {
        sums[q % lanes] += chains[q];
    }
}

/* Expands a call for each number of lanes, as a constant. */
#define SLI_FOR_LANES(lanes, call) \
    if ((lanes) == 1) { \
        call(1); \
    } else if ((lanes) == 2) { \
        call(2); \
    } else if ((lanes) == 4) { \
        call(4); \
    } else { \
        call(8); \
    }

SLI_NOINLINE static void sli_chains_add(double *chains, const double *v, const double *row,
                                        ptrdiff_t next, sl_int columns, sl_int lanes) {
#define SLI_CALL(constant) sli_chains_dot(chains, v, row, next, columns, constant)
    SLI_FOR_LANES(lanes, SLI_CALL)
#undef SLI_CALL
}

/* A packed block of vectors over a reach: columns x lanes. Sums take 8 lanes after 8 lanes. */
typedef struct sli_packed {
    const sli_reach *R;
    double *v;
    sl_int lanes;
} sli_packed;

SLI_INLINE sli_packed sli_packed_of(const sli_reach *R, double *v, sl_int lanes) {
    sli_packed b;
    b.R = R;
    b.v = v;
    b.lanes = lanes;
    return b;
}

SLI_INLINE double *sli_packed_row(const sli_packed *b, sl_int row) {
    return b->v + (ptrdiff_t)row * b->lanes;
}

/* The columns of the whole tree whose root is a step of a reach. */
typedef struct sli_tree_range {
    sl_int first, root;
} sli_tree_range;

SLI_INLINE sli_tree_range sli_tree_range_of(const sl_symbolic *S, const sli_step *root) {
    const sl_int super = S->super_of[root->column];
    sli_tree_range tree;
    tree.first = S->super_first[S->first_descendant[super]];
    tree.root = S->super_first[super + 1] - 1;
    return tree;
}

/* z' b of a null pivot whose null vector z is known, scaled to 1 there. */
typedef struct sli_null_dot {
    sl_int null;
    sl_int number; /* among the null pivots */
    sl_int next;   /* the number that the search continues with */
    double sums[SLI_BLOCK_SINGULAR];
} sli_null_dot;

/* The number of the first null pivot in the tree of a root. */
SLI_INLINE sl_int sli_null_first(const sl_factor *F, const sli_reach *R, sl_int root) {
    return sli_lower_bound(F->null.pivots, F->null.count,
                           sli_tree_range_of(F->S, &R->steps[root]).first);
}

#endif

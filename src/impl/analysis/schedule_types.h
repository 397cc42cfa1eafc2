/* schedule_types.h: tasks of a factorization, sizes of fronts and of what they pass up */
#ifndef SLI_ANALYSIS_SCHEDULE_TYPES_H
#define SLI_ANALYSIS_SCHEDULE_TYPES_H

#include "../kernels/front.h"
#include "symbolic_types.h"

/* A front above all tasks, while its matrix is factored. */
typedef struct sli_top {
    sl_int children, waiting; /* waiting: of the children that are not done */
    sl_int pieces;            /* of a large front, which several workers factor; else 0 */
    sl_int first_piece;       /* in the schedule's steps */
    sl_int piece_tiles;       /* row tiles of a piece below the pivots */
    /* pieces that are cleared, groups of pivots that are done, pieces that are eliminated and whose
     * rows of the update matrix are done */
    sl_int cleared, pivots, eliminated, updated;
    int is_begun, is_loading, is_loaded, is_finishing;
} sli_top;

/* What a supernode is in a factorization: one with a front; a plain column that is computed in its
 * panel; one whose entries of A are its rows one by one; a plain column that the parent reads from
 * the stack, as the panel has other numbers. */
enum { SLI_PLAIN_NOT, SLI_PLAIN, SLI_PLAIN_DIRECT, SLI_PLAIN_PASSED };

/* A task is a subtree, a run of consecutive supernodes, that is factored by one worker. The fronts
 * above all tasks follow, large ones by several workers. A single worker has one task: the whole
 * forest. */
typedef struct sli_schedule {
    sl_int workers;
    sl_int n_tasks, n_tops, n_bundles;
    sl_int *first, *last; /* n_tasks: supernodes first..last; large tasks first */
    sl_int *worker;       /* n_tasks: its worker, where that is fixed */
    sl_int *bundle_end;   /* n_bundles: the tasks that are taken at a time end here */
    sl_int *top;          /* n_tops: supernodes above the tasks, ascending */
    /* n_supers: start of each update matrix, in doubles. Positions below `own` are relative to the
     * room of the worker that factors the task */
    sl_off *stack_begin;
    unsigned char *is_plain; /* n_supers, of a factorization: SLI_PLAIN_* */
    sli_top *tops;           /* n_tops */
    sl_int *ready;           /* n_tops: those whose children are done */
    sl_int *steps;           /* the next step of each piece of a large front; -1: it is being run */
    sl_off own;              /* doubles of a worker's stacks */
    sl_off stack;            /* doubles of all stacks together */
} sli_schedule;

/* A front of SLI_SHARED_FLOPS takes about 50 us; taking a piece of it costs up to 1 us. A bundle of
 * tasks has at least SLI_BUNDLE_FLOPS. Several workers that are SLI_WORTHWHILE times as fast at
 * best are no faster than one. */
#if defined(SLI_SMALL_TASKS)
#define SLI_SHARED_FLOPS 2e4
#define SLI_BUNDLE_FLOPS 1e4
#define SLI_WORTHWHILE 0.0
#else
#define SLI_SHARED_FLOPS 4e6
#define SLI_BUNDLE_FLOPS 2e5
#define SLI_WORTHWHILE 1.25
#endif

/* Doubles that a supernode passes to its parent: the update matrix and the magnitudes of its rows.
 * Half of it is aligned, too: that of a complex matrix. */
SLI_INLINE sl_off sli_update_size(const sli_step *s) {
    const sl_int tiles = sli_update_tiles(s->width, s->below);
    return sli_triangle_offset(tiles) + SLI_TILE * (sl_off)(tiles + tiles % 2);
}

/* Is supernode s one column that its children change in its diagonal entry only? Then what it
 * passes up is known from its column of L and its pivot, and it needs no front. */
static int sli_is_plain(const sl_symbolic *S, sl_int s) {
    int is_plain = S->steps[s].width == 1;
    sl_int c;
    for (c = s - 1; is_plain && c >= S->first_descendant[s]; c = S->first_descendant[c] - 1) {
        is_plain = S->steps[c].below == 1;
    }
    return is_plain;
}

/* Doubles that supernode s passes to its parent in the stack. */
SLI_INLINE sl_off sli_passed_size(const sli_schedule *p, const sl_symbolic *S, sl_int s) {
    return p->is_plain[s] == SLI_PLAIN_NOT ? sli_update_size(&S->steps[s])
           : p->is_plain[s] != SLI_PLAIN_PASSED
               ? 0
               : SLI_TILE * (sl_off)sli_tiles(1 + S->steps[s].below);
}

/* Flops of a front: the sum of (entries)^2 over its columns. */
SLI_INLINE double sli_front_flops(const sli_step *s) {
    const double w = s->width, h = w + s->below;
    return w * (h * h - (w - 1.0) * h + (w - 1.0) * (2.0 * w - 1.0) / 6.0);
}

/* Is supernode s a front that is large enough for several workers? */
SLI_INLINE int sli_front_is_large(const sl_symbolic *S, sl_int s) {
    return S->steps[s].width > 1 && sli_front_flops(&S->steps[s]) >= SLI_SHARED_FLOPS;
}

/* Numbers that follow the update matrix of a large front: its magnitudes, D where it is in float,
 * and reciprocals. Of a complex matrix, there is room for half of this. */
SLI_INLINE sl_off sli_large_scratch(const sli_step *s) {
    return 2 * (SLI_TILE * (sl_off)sli_tiles(s->width + s->below) +
                SLI_FRONT_RECIPROCALS * (sl_off)sli_front_groups(s->width));
}

/* Pieces of a large front, and the row tiles of those below the pivots. */
static sl_int sli_large_pieces(const sli_step *s, sl_int workers, sl_int *tiles) {
    const sl_int below = sli_tiles(s->width + s->below) - sli_tiles(s->width);
    *tiles = sli_max(SLI_GROUP_TILES, below / (4 * workers) + 1);
    return sli_front_groups(s->width) + (below + *tiles - 1) / *tiles;
}

#endif

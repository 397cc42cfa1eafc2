/* reach.h: the columns that a set of rows touches: the elimination tree's paths from them to the roots */
#ifndef SLI_REACH_H
#define SLI_REACH_H

#include "sort.h"
#include "symbolic_types.h"

/* A reach, compiled for the kernels: its supernodes ascending, each from the first column needed,
 * and the places of their rows in a vector that holds the reach's columns alone. */
typedef struct sli_reach {
    sl_int count;           /* supernodes */
    sl_int columns;         /* length of the vector */
    sl_int tallest, widest; /* largest height and width, for the scratch */
    sl_off n_rows;          /* length of rows */
    sl_off entries;         /* doubles of L that a sweep reads */
    const sli_step *steps;  /* count */
    const sl_int *rows;     /* n_rows, step after step */
} sli_reach;

/* The reach of everything: what the analysis holds already. */
static sli_reach sli_reach_all(const sl_symbolic *S) {
    sli_reach R;
    R.count = S->n_supers;
    R.columns = S->n;
    R.tallest = S->tallest;
    R.widest = S->widest;
    R.n_rows = S->rows_begin[S->n_supers];
    R.entries = S->panel_begin[S->n_supers];
    R.steps = S->steps;
    R.rows = S->rows;
    return R;
}

/* Where paths end before the roots of the tree: a forest of whole subtrees, and a boundary that holds
 * at least all rows of L below it. Of a reach inside it the boundary is the end of the vector. */
typedef struct sli_fence {
    sl_int n_roots;
    const sl_int *roots; /* ascending: the supernodes that the subtrees hang from */
    sl_int n_rows;
    const sl_int *rows; /* ascending: the boundary, columns of L */
} sli_fence;

/* The subtree that holds supernode s, or -1. */
SLI_INLINE sl_int sli_fence_find(const sl_symbolic *S, const sli_fence *fence, sl_int s) {
    const sl_int at = sli_lower_bound(fence->roots, fence->n_roots, s);
    return at < fence->n_roots && S->descendant[fence->roots[at]] <= s ? at : -1;
}

/* The place of a column in the boundary, or -1. */
SLI_INLINE sl_int sli_fence_boundary(const sli_fence *fence, sl_int column) {
    const sl_int at = sli_lower_bound(fence->rows, fence->n_rows, column);
    return at < fence->n_rows && fence->rows[at] == column ? at : -1;
}

/* One past the last supernode of the paths from s on, which is inside; fence NULL: the whole tree. */
SLI_INLINE sl_int sli_fence_end(const sl_symbolic *S, const sli_fence *fence, sl_int s) {
    return fence == NULL ? S->n_supers
                         : fence->roots[sli_lower_bound(fence->roots, fence->n_roots, s)] + 1;
}

/* The supernode where the climb from the k-th seed must stop: the next one that holds a seed. In a
 * postorder the first ancestor at or after it is on the next seed's own path, so that paths join
 * without a mark on any column. */
SLI_INLINE sl_int sli_next_seed(const sl_symbolic *S, const uint64_t *seeds, sl_int count,
                                sl_int *k) {
    const sl_int here = S->super_of[sli_key(seeds[*k])];
    sl_int s = here;
    while (++*k < count && s == here) {
        s = S->super_of[sli_key(seeds[*k])];
        if (s != here) {
            return s;
        }
    }
    return S->n_supers;
}

/* Doubles of L that a sweep reads of a panel it enters at a tile. */
SLI_INLINE sl_off sli_entries_from(sl_int width, sl_int below, sl_int first_tile) {
    return sli_panel_size(width, below) - sli_tile_offset(width, first_tile) -
           (sl_off)SLI_TILE * SLI_TILE * first_tile * (sli_tiles(width + below) - first_tile);
}

/* Adds the supernodes of column k's path below supernode `high` that have no descendant at or before
 * `low`. */
static void sli_reach_climb(const sl_symbolic *S, sl_int k, sl_int low, sl_int high, sli_reach *R) {
    sl_int s = S->super_of[k];
    while (s != -1 && s < high && S->descendant[s] > low) {
        const sl_int first = S->super_first[s], width = S->super_first[s + 1] - first;
        const sl_int below = (sl_int)(S->rows_begin[s + 1] - S->rows_begin[s]);
        R->count++;
        R->n_rows += below;
        R->columns += width;
        R->widest = sli_max(R->widest, width);
        R->tallest = sli_max(R->tallest, width + below);
        R->entries += sli_entries_from(width, below, (k - first) / SLI_TILE);
        k = below > 0 ? S->rows[S->rows_begin[s]] : k;
        s = S->super_parent[s];
    }
}

/* Adds what column k brings to a reach: the supernodes of its path up to where it meets the path of
 * the nearest column of the reach before it or behind it; -1 for none. Exact are supernodes, rows,
 * height and width; columns are those of whole supernodes, and entries leave out that k may enter
 * what it shares at an earlier tile. O(supernodes added). */
static void sli_reach_add(const sl_symbolic *S, sl_int k, sl_int before, sl_int behind,
                          sli_reach *R) {
    sli_reach_climb(S, k, before < 0 ? -1 : S->super_of[before],
                    behind < 0 ? S->n_supers : S->super_of[behind], R);
}

/* Counts the supernodes and rows of the reach of seeds, columns of L, ascending, inside a fence or, where
 * that is NULL, to the roots. O(reach). */
static void sli_reach_measure_within(const sl_symbolic *S, const sli_fence *fence,
                                     const uint64_t *seeds, sl_int count, sli_reach *R) {
    sl_int k, low = -1;
    memset(R, 0, sizeof *R);
    for (k = 0; k < count; k++) {
        const sl_int s = S->super_of[sli_key(seeds[k])];
        sli_reach_climb(S, sli_key(seeds[k]), low, sli_fence_end(S, fence, s), R);
        low = s;
    }
    R->columns += fence == NULL ? 0 : fence->n_rows;
}

static void sli_reach_measure(const sl_symbolic *S, const uint64_t *seeds, sl_int count,
                              sli_reach *R) {
    sli_reach_measure_within(S, NULL, seeds, count, R);
}

/* Adds supernode s, which a seed or children on the waiting list enter; its parent is not in the reach
 * unless it is below supernode `end`. The list is threaded through `up` of the steps whose parent has
 * not come yet; its top waits for the smallest supernode. */
static void sli_reach_enter(const sl_symbolic *S, sli_step *steps, sl_int at, sl_int s, sl_int seed,
                            sl_int end, sl_int *waiting) {
    const sl_int first = S->super_first[s];
    sli_step *step = &steps[at];
    sl_int column = seed;
    while (*waiting != -1 && S->super_parent[S->super_of[steps[*waiting].column]] == s) {
        sli_step *child = &steps[*waiting];
        const sl_int c = S->super_of[child->column];
        column = sli_min(column, S->rows[S->rows_begin[c]]);
        *waiting = child->up;
        child->up = at;
    }
    step->panel = S->panel_begin[s];
    step->first_tile = (column - first) / SLI_TILE;
    step->column = first + SLI_TILE * step->first_tile;
    step->width = S->super_first[s + 1] - first;
    step->below = (sl_int)(S->rows_begin[s + 1] - S->rows_begin[s]);
    step->up = -1;
    if (S->super_parent[s] != -1 && S->super_parent[s] < end) {
        step->up = *waiting;
        *waiting = at;
    }
}

/* The last of the steps low..high that starts at or before a row; one does. Steps ascend. */
SLI_INLINE sl_int sli_reach_find(const sli_step *steps, sl_int low, sl_int high, sl_int row) {
    while (low < high) {
        const sl_int middle = low + (high - low + 1) / 2;
        if (steps[middle].column <= row) {
            low = middle;
        } else {
            high = middle - 1;
        }
    }
    return low;
}

#define SLI_CLIMB 8 /* ancestors that cost about what a look-up among a few thousand steps costs */

/* The first `inside` rows of a step to places in the vector: the rows ascend, and so do the ancestors
 * that own them. The owner of the next row is mostly a few ancestors up; where it is not, climbing on
 * would make a tree of one long branch quadratic, so that it is looked up among all `count` steps. */
static void sli_reach_places(const sl_int *rows, sl_int inside, const sli_step *steps, sl_int count,
                             sl_int at, sl_int *places) {
    sl_int i = 0;
    while (i < inside) {
        sl_int end, shift, climbed = 0;
        do {
            at = climbed++ < SLI_CLIMB ? steps[at].up
                                       : sli_reach_find(steps, at + 1, count - 1, rows[i]);
            end = steps[at].column + sli_step_columns(&steps[at]);
        } while (rows[i] >= end);
        shift = steps[at].base - steps[at].column;
        for (; i < inside && rows[i] < end; i++) {
            places[i] = rows[i] + shift;
        }
    }
}

/* Rows of a boundary that begins at `base` to places in the vector: both ascend. */
static void sli_fence_places(const sli_fence *fence, sl_int base, const sl_int *rows, sl_int count,
                             sl_int *places) {
    sl_int i, at = 0;
    for (i = 0; i < count; i++) {
        at += sli_lower_bound(fence->rows + at, fence->n_rows - at, rows[i]);
        places[i] = base + at;
    }
}

/* Compiles the reach of seeds; sli_reach_measure_within tells the room it takes. O(reach), times a
 * logarithm where rows skip many ancestors and for rows in the boundary. */
static void sli_reach_fill_within(const sl_symbolic *S, const sli_fence *fence,
                                  const uint64_t *seeds, sl_int count, sli_step *steps,
                                  sl_int *rows, sli_reach *R) {
    sl_int k = 0, at = 0, waiting = -1, s, next, end;
    memset(R, 0, sizeof *R);
    while (k < count) {
        sl_int seed = sli_key(seeds[k]);
        s = S->super_of[seed];
        end = sli_fence_end(S, fence, s);
        next = sli_min(sli_next_seed(S, seeds, count, &k), end);
        for (; s != -1 && s < next; s = S->super_parent[s]) {
            sli_reach_enter(S, steps, at++, s, seed, end, &waiting);
            seed = INT32_MAX;
        }
    }
    R->count = at;
    for (at = 0; at < R->count; at++) {
        const sli_step *step = &steps[at];
        steps[at].base = R->columns;
        R->columns += sli_step_columns(step);
        R->widest = sli_max(R->widest, step->width);
        R->tallest = sli_max(R->tallest, step->width + step->below);
        R->entries += sli_entries_from(step->width, step->below, step->first_tile);
    }
    for (at = 0; at < R->count; at++) {
        const sl_int own = S->super_of[steps[at].column], below = steps[at].below;
        const sl_int *from = S->rows + S->rows_begin[own];
        sl_int inside = below;
        if (fence != NULL) {
            inside = sli_lower_bound(from, below, S->super_first[sli_fence_end(S, fence, own)]);
            sli_fence_places(fence, R->columns, from + inside, below - inside,
                             rows + R->n_rows + inside);
        }
        sli_reach_places(from, inside, steps, R->count, at, rows + R->n_rows);
        R->n_rows += below;
    }
    R->columns += fence == NULL ? 0 : fence->n_rows;
    R->steps = steps;
    R->rows = rows;
}

static void sli_reach_fill(const sl_symbolic *S, const uint64_t *seeds, sl_int count,
                           sli_step *steps, sl_int *rows, sli_reach *R) {
    sli_reach_fill_within(S, NULL, seeds, count, steps, rows, R);
}

/* The place of a column in the reach's vector. *at, 0 at first, remembers the step for the next
 * column, which is not smaller. */
SLI_INLINE sl_int sli_reach_place(const sli_reach *R, sl_int *at, sl_int column) {
    while (column >= R->steps[*at].column + sli_step_columns(&R->steps[*at])) {
        ++*at;
    }
    return column - R->steps[*at].column + R->steps[*at].base;
}

/* The place of any column in the reach's vector, -1 where it has none. */
static sl_int sli_reach_place_of(const sli_reach *R, sl_int column) {
    const sli_step *step;
    if (R->count == 0) {
        return -1;
    }
    step = &R->steps[sli_reach_find(R->steps, 0, R->count - 1, column)];
    return column >= step->column && column < step->column + sli_step_columns(step)
               ? step->base + column - step->column
               : -1;
}

/* A walk over the supernodes that two reaches share: set up by sli_meeting_of, then sli_meet until it
 * gives 0. */
typedef struct sli_meeting {
    const sli_step *a, *a_end, *b, *b_end;
    sl_int count;      /* columns shared of the supernode at hand */
    sl_int column;     /* the first of them, and */
    sl_int in_a, in_b; /* its places in the two vectors */
} sli_meeting;

SLI_INLINE sli_meeting sli_meeting_of(const sli_reach *a, const sli_reach *b) {
    sli_meeting m;
    memset(&m, 0, sizeof m);
    m.a = a->steps;
    m.a_end = a->steps + a->count;
    m.b = b->steps;
    m.b_end = b->steps + b->count;
    return m;
}

SLI_INLINE int sli_meet(sli_meeting *m) {
    while (m->a < m->a_end && m->b < m->b_end) {
        if (m->a->panel == m->b->panel) { /* a panel belongs to one supernode */
            m->column = sli_max(m->a->column, m->b->column);
            m->count = m->a->column + sli_step_columns(m->a) - m->column;
            m->in_a = m->a->base + m->column - m->a->column;
            m->in_b = m->b->base + m->column - m->b->column;
            m->a++;
            m->b++;
            return 1;
        }
        if (m->a->panel < m->b->panel) {
            m->a++;
        } else {
            m->b++;
        }
    }
    return 0;
}

#endif

/* reach.h: the reach of a set of columns: their paths to the roots, compiled for the kernels */
#ifndef SLI_ANALYSIS_REACH_H
#define SLI_ANALYSIS_REACH_H

#include "../base/sort.h"
#include "symbolic_types.h"

/* The reach of all columns, which the analysis has already compiled. */
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
    R.plain = S->plain;
    return R;
}

/* Leaves steps first .. first+count-1 in a reach; rows and sizes stay as they are. */
SLI_INLINE void sli_reach_cut(sli_reach *R, sl_int first, sl_int count) {
    R->steps += first;
    R->plain = R->plain == NULL ? NULL : R->plain + first;
    R->count = count;
}

/* Where paths end below the roots of the tree: a forest of whole subtrees, and a boundary that
 * contains at least all rows of L below them. In a compact vector of a reach inside the extent, the
 * boundary comes last. */
typedef struct sli_region_extent {
    sl_int n_roots;
    const sl_int *roots; /* ascending: the roots of the subtrees */
    sl_int n_rows;
    const sl_int *rows; /* ascending: the boundary, columns of L */
} sli_region_extent;

/* The index of the subtree that contains supernode s, or -1. */
SLI_INLINE sl_int sli_extent_find(const sl_symbolic *S, const sli_region_extent *extent, sl_int s) {
    const sl_int at = sli_lower_bound(extent->roots, extent->n_roots, s);
    return at < extent->n_roots && S->first_descendant[extent->roots[at]] <= s ? at : -1;
}

/* The index of a column in the boundary, or -1. */
SLI_INLINE sl_int sli_extent_boundary(const sli_region_extent *extent, sl_int column) {
    const sl_int at = sli_lower_bound(extent->rows, extent->n_rows, column);
    return at < extent->n_rows && extent->rows[at] == column ? at : -1;
}

/* The end of the path of supernode s, which is inside the extent: one past its last supernode.
 * extent NULL: the path ends at the root of the tree. */
SLI_INLINE sl_int sli_extent_end(const sl_symbolic *S, const sli_region_extent *extent, sl_int s) {
    return extent == NULL ? S->n_supers
                          : extent->roots[sli_lower_bound(extent->roots, extent->n_roots, s)] + 1;
}

/* The supernode where the path of the k-th seed stops: the next supernode that contains a seed. In
 * a postorder the first ancestor at or after it is on the next seed's own path, so that paths join
 * without a mark on any column. Advances *k past the seeds of this supernode. */
SLI_INLINE sl_int sli_next_seed(const sl_symbolic *S, const uint64_t *seeds, sl_int count,
                                sl_int *k) {
    const sl_int here = S->super_of[sli_key(seeds[*k])];
    sl_int s = here;
    while (++*k < count) {
        s = S->super_of[sli_key(seeds[*k])];
        if (s != here) {
            return s;
        }
    }
    return S->n_supers;
}

/* Doubles of L that a sweep reads of a panel, from a row tile on. */
SLI_INLINE sl_off sli_entries_from(sl_int width, sl_int below, sl_int first_tile) {
    return sli_panel_size(width, below) - sli_tile_offset(width, first_tile) -
           (sl_off)SLI_TILE * SLI_TILE * first_tile * (sli_tiles(width + below) - first_tile);
}

/* Adds the supernodes of column k's path that are below supernode `high` and have no descendant at
 * or before `low`. */
static void sli_reach_add_path(const sl_symbolic *S, sl_int k, sl_int low, sl_int high,
                               sli_reach *R) {
    sl_int s = S->super_of[k];
    while (s != -1 && s < high && S->first_descendant[s] > low) {
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

/* Adds column k to a reach: the supernodes of its path up to the paths of the nearest columns
 * before and behind it that are in the reach already; -1: none. count, n_rows, tallest and widest
 * are exact. columns counts whole supernodes, and entries does not include that k may enter a
 * shared supernode at an earlier tile. O(supernodes added). */
SLI_INLINE void sli_reach_add(const sl_symbolic *S, sl_int k, sl_int before, sl_int behind,
                              sli_reach *R) {
    sli_reach_add_path(S, k, before < 0 ? -1 : S->super_of[before],
                       behind < 0 ? S->n_supers : S->super_of[behind], R);
}

/* Measures the reach of seeds, which are ascending columns of L: inside an extent, or, if it is
 * NULL, up to the roots. O(reach). */
static void sli_reach_measure_within(const sl_symbolic *S, const sli_region_extent *extent,
                                     const uint64_t *seeds, sl_int count, sli_reach *R) {
    sl_int k, low = -1;
    memset(R, 0, sizeof *R);
    for (k = 0; k < count; k++) {
        const sl_int s = S->super_of[sli_key(seeds[k])];
        sli_reach_add_path(S, sli_key(seeds[k]), low, sli_extent_end(S, extent, s), R);
        low = s;
    }
    R->columns += extent == NULL ? 0 : extent->n_rows;
}

SLI_INLINE void sli_reach_measure(const sl_symbolic *S, const uint64_t *seeds, sl_int count,
                                  sli_reach *R) {
    sli_reach_measure_within(S, NULL, seeds, count, R);
}

/* A reach that is being compiled. The pending list links, through `up`, the steps whose parent has
 * not been added yet, the one with the smallest parent on top. */
typedef struct sli_reach_draft {
    const sl_symbolic *S;
    sli_step *steps;
    sl_int count;   /* steps so far */
    sl_int pending; /* the top of the list, or -1 */
} sli_reach_draft;

/* Adds supernode s as the next step. It is entered by a seed or by children on the pending list;
 * its parent is in the reach only if it is below supernode `end`. */
SLI_INLINE void sli_reach_enter(sli_reach_draft *d, sl_int s, sl_int seed, sl_int end) {
    const sl_symbolic *S = d->S;
    const sl_int first = S->super_first[s], at = d->count++;
    sli_step *step = &d->steps[at];
    sl_int column = seed;
    while (d->pending != -1 && S->super_parent[S->super_of[d->steps[d->pending].column]] == s) {
        sli_step *child = &d->steps[d->pending];
        const sl_int c = S->super_of[child->column];
        column = sli_min(column, S->rows[S->rows_begin[c]]);
        d->pending = child->up;
        child->up = at;
    }
    step->panel = S->panel_begin[s];
    step->first_tile = (column - first) / SLI_TILE;
    step->column = first + SLI_TILE * step->first_tile;
    step->width = S->super_first[s + 1] - first;
    step->below = (sl_int)(S->rows_begin[s + 1] - S->rows_begin[s]);
    step->up = -1;
    if (S->super_parent[s] != -1 && S->super_parent[s] < end) {
        step->up = d->pending;
        d->pending = at;
    }
}

/* The last of the steps low..high whose first column is at or before a row. There is one. Steps
 * ascend. */
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

/* this many ancestors cost about as much as a search among a few thousand steps */
#define SLI_REACH_WALK 8

/* Converts the first `inside` rows of a step to indices of the compact vector. Both the rows and
 * the ancestors that own them ascend, and the owner of the next row is usually a few ancestors up.
 * If it is not, it is searched among all `count` steps: following ancestors only would take
 * quadratic time in a tree with one long branch. */
static void sli_reach_map_rows(const sl_int *rows, sl_int inside, const sli_step *steps,
                               sl_int count, sl_int at, sl_int *indices) {
    sl_int i = 0;
    while (i < inside) {
        sl_int end, shift, walked = 0;
        do {
            at = walked++ < SLI_REACH_WALK ? steps[at].up
                                           : sli_reach_find(steps, at + 1, count - 1, rows[i]);
            end = steps[at].column + sli_step_columns(&steps[at]);
        } while (rows[i] >= end);
        shift = steps[at].base - steps[at].column;
        for (; i < inside && rows[i] < end; i++) {
            indices[i] = rows[i] + shift;
        }
    }
}

/* Converts rows in a boundary, which starts at index `base`. Both ascend. */
SLI_NOINLINE static void sli_extent_map_rows(const sli_region_extent *extent, sl_int base,
                                             const sl_int *rows, sl_int count, sl_int *indices) {
    sl_int i, at = 0;
    for (i = 0; i < count; i++) {
        at += sli_lower_bound(extent->rows + at, extent->n_rows - at, rows[i]);
        indices[i] = base + at;
    }
}

/* The arrays of a reach, of the sizes that sli_reach_measure_within gives. */
typedef struct sli_reach_arrays {
    sli_step *steps;
    sl_int *rows;
} sli_reach_arrays;

/* Compiles the reach of seeds. O(reach), with a logarithmic factor where rows skip many ancestors
 * and for rows in the boundary. */
SLI_AT_LINE static void sli_reach_fill_within(const sl_symbolic *S, const sli_region_extent *extent,
                                              const uint64_t *seeds, sl_int count,
                                              const sli_reach_arrays *arrays, sli_reach *R) {
    sli_step *steps = arrays->steps;
    sl_int *rows = arrays->rows;
    sl_int k = 0, at, s, next, end;
    sli_reach_draft draft;
    draft.S = S;
    draft.steps = steps;
    draft.count = 0;
    draft.pending = -1;
    memset(R, 0, sizeof *R);
    while (k < count) {
        sl_int seed = sli_key(seeds[k]);
        s = S->super_of[seed];
        end = sli_extent_end(S, extent, s);
        next = sli_min(sli_next_seed(S, seeds, count, &k), end);
        for (; s != -1 && s < next; s = S->super_parent[s]) {
            sli_reach_enter(&draft, s, seed, end);
            seed = INT32_MAX;
        }
    }
    R->count = draft.count;
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
        if (extent != NULL) {
            inside = sli_lower_bound(from, below, S->super_first[sli_extent_end(S, extent, own)]);
            sli_extent_map_rows(extent, R->columns, from + inside, below - inside,
                                rows + R->n_rows + inside);
        }
        sli_reach_map_rows(from, inside, steps, R->count, at, rows + R->n_rows);
        R->n_rows += below;
    }
    R->columns += extent == NULL ? 0 : extent->n_rows;
    R->steps = steps;
    R->rows = rows;
}

SLI_INLINE void sli_reach_fill(const sl_symbolic *S, const uint64_t *seeds, sl_int count,
                               sli_step *steps, sl_int *rows, sli_reach *R) {
    sli_reach_arrays arrays;
    arrays.steps = steps;
    arrays.rows = rows;
    sli_reach_fill_within(S, NULL, seeds, count, &arrays, R);
}

/* The index of a column in the compact vector. *at, 0 at first, keeps the step for the next call,
 * whose column must not be smaller. */
SLI_INLINE sl_int sli_reach_index(const sli_reach *R, sl_int *at, sl_int column) {
    while (column >= R->steps[*at].column + sli_step_columns(&R->steps[*at])) {
        ++*at;
    }
    return column - R->steps[*at].column + R->steps[*at].base;
}

/* The step of any column, or -1 if it is not in the reach. */
static sl_int sli_reach_step_of(const sli_reach *R, sl_int column) {
    const sl_int s = R->count == 0 ? -1 : sli_reach_find(R->steps, 0, R->count - 1, column);
    return s != -1 && column >= R->steps[s].column &&
                   column < R->steps[s].column + sli_step_columns(&R->steps[s])
               ? s
               : -1;
}

/* The index of any column in the compact vector, or -1 if it is not in the reach. */
SLI_NOINLINE static sl_int sli_reach_index_of(const sli_reach *R, sl_int column) {
    const sl_int s = sli_reach_step_of(R, column);
    return s == -1 ? -1 : R->steps[s].base + column - R->steps[s].column;
}

/* Iterates over the columns that two reaches share, in runs that have no gap in either vector:
 * sli_intersection_of, then sli_intersection_next until it returns 0. From where two paths join on
 * they are one run. */
typedef struct sli_intersection {
    const sli_step *a, *a_end, *b, *b_end;
    sl_int count;      /* columns of the current run */
    sl_int in_a, in_b; /* the indices of the first one in the two compact vectors */
} sli_intersection;

SLI_INLINE sli_intersection sli_intersection_of(const sli_reach *a, const sli_reach *b) {
    sli_intersection m;
    memset(&m, 0, sizeof m);
    m.a = a->steps;
    m.a_end = a->steps + a->count;
    m.b = b->steps;
    m.b_end = b->steps + b->count;
    return m;
}

SLI_INLINE int sli_intersection_next(sli_intersection *m) {
    while (m->a < m->a_end && m->b < m->b_end) {
        if (m->a->panel == m->b->panel) { /* the panel identifies the supernode */
            const sl_int column = sli_max(m->a->column, m->b->column);
            m->count = m->a->column - column;
            m->in_a = m->a->base - m->count;
            m->in_b = m->b->base + column - m->b->column;
            do {
                m->count += sli_step_columns(m->a);
                m->a++;
                m->b++;
            } while (m->a < m->a_end && m->b < m->b_end && m->a->panel == m->b->panel &&
                     m->a->column == m->b->column);
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

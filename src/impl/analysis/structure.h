/* structure.h: rows of the supernodes, relative indices, and the scatter map of A into L */
#ifndef SLI_ANALYSIS_STRUCTURE_H
#define SLI_ANALYSIS_STRUCTURE_H

#include "pattern.h"

/* A supernode while its rows are found: 32 bytes, where its step will be. */
typedef struct sli_structure_super {
    sl_off to;     /* an entry of the last row in column k goes to this position + 8 k */
    sl_off rows;   /* where local row 0 would be in S->rows */
    sl_int last;   /* the last row that was found */
    sl_int height; /* local rows so far */
    sl_int width;  /* columns */
    sl_int up;     /* the parent */
} sli_structure_super;

/* Fills scatter_begin, one place behind: where the entries of each supernode begin. */
static void sli_structure_count(const sli_analysis *w, const sl_symbolic *S) {
    const sl_int *begin = w->columns.begin, *old_of = w->old_of, *super_of = S->super_of;
    sl_off *starts = S->scatter_begin, total = 0;
    sl_int k;
    for (k = w->n - 1; k >= 0; k--) { /* its first column writes last: without branches */
        total += begin[old_of[k] + 1] - begin[old_of[k]];
        starts[super_of[k] + 1] = begin[w->n] - total;
    }
    starts[0] = 0;
}

/* Sorts the entries of A by rows, all by old numbers: spare := column and position in A; column :=
 * where rows begin. Within a row they keep the order of the columns: duplicates are neighbors. */
static void sli_structure_sort(const sli_analysis *w) {
    const sl_int *begin = w->columns.begin, *entry = w->columns.entry;
    sl_int k, total = 0, p = 0, *at = w->column + 1;
    SLI_ZERO(w->column, w->n + 1);
    for (; p < begin[w->n]; p++) {
        at[entry[SLI_ENTRY * (size_t)p]]++;
    }
    for (k = 0; k < w->n; k++) {
        total += at[k];
        at[k] = total - at[k];
    }
    for (k = 0; k < w->n; k++) {
        const sl_int *end = w->columns.entry + SLI_ENTRY * (size_t)begin[k + 1];
        for (; entry < end; entry += SLI_ENTRY) {
            sl_int *here = w->spare + 2 * (size_t)at[entry[0]]++;
            here[0] = k;
            here[1] = entry[1];
        }
    }
}

/* Fills what follows from the sizes of the supernodes, and starts them. Their first rows will be in
 * the first tiles. w->earlier becomes the first part of each that was split. */
static void sli_structure_start(const sli_analysis *w, const sl_symbolic *S) {
    const sli_amalgamation *g = &w->amalgamation;
    sl_off rows = 0, panel = 0;
    sl_int s;
    for (s = 0; s < S->n_supers; s++) {
        sli_structure_super *v = &w->supers[s];
        const sl_int first = g->first[s], width = g->width[s];
        panel = sli_panel_start(width, panel);
        S->super_first[s] = first;
        S->super_parent[s] = v->up = g->parent[s];
        S->rows_begin[s] = rows;
        S->panel_begin[s] = panel;
        v->width = width;
        v->to = panel - SLI_TILE * (sl_off)first + SLI_TILE - 1;
        v->rows = rows - width;
        v->last = -1;
        v->height = 0;
        rows += g->below[s];
        panel += sli_panel_size(width, g->below[s]);
        if (w->earlier != NULL) {
            w->earlier[s] = w->earlier[s] == -1 ? s : w->earlier[w->earlier[s]];
        }
    }
    S->super_first[s] = w->n;
    S->rows_begin[s] = rows;
    S->panel_begin[s] = panel;
}

/* Adds row k to a supernode, as its next local row: the next one of its tile, or the first one of
 * the next tile. */
SLI_ALWAYS_INLINE void sli_structure_add(sli_structure_super *v, sl_int k) {
    const sl_int local = v->height, columns = sli_min(v->width, local);
    const sl_off starts = -(sl_off)(local % SLI_TILE == 0); /* a mask: nothing predicts it */
    v->height = local + 1;
    v->last = k;
    v->to += 1 + (starts & (SLI_TILE * (sl_off)columns - SLI_TILE));
}

/* Adds row k below v and its ancestors, up to the first one that has it. The relative index is the
 * local row that the parent has for it, or will have next. All parts of a supernode get the row.
 * bottom: the first part of each, or NULL. */
SLI_ALWAYS_INLINE void sli_structure_climb(sli_structure_super *all, sli_structure_super *v,
                                           sl_int k, sl_int *rows, sl_int *relative,
                                           const sl_int *bottom) {
    while (v->last != k) {
        sli_structure_super *up = all + v->up;
        const sl_off at = v->rows + v->height;
        rows[at] = k;
        relative[at] = up->height - (up->last == k);
        sli_structure_add(v, k);
        v = bottom != NULL && /* branches untested: one copy stays in a supernode */
                    bottom[up - all] != bottom[v - all] /* branches untested: the same */
                ? all + bottom[up - all]
                : up;
    }
}

/* Fills the rows of supernodes, their relative indices and the scatter map, in a pass over a range
 * of the rows of A. Row k is a row of the supernodes on the paths from those of its entries to that
 * of k. So all rows, and the entries of the map, are found in ascending order. Rows with columns
 * before the range below them are left to a later pass, as are then all rows above them. */
static void sli_structure_rows(void *data, const sli_range *r) {
    const sli_analysis *w = (const sli_analysis *)data;
    const sl_symbolic *S = w->S;
    const sl_int *super_of = S->super_of, *new_of = w->new_of, *bottom = w->earlier, *row;
    sl_int *rows = S->rows, *relative = S->relative, *from = S->scatter_from, k;
    sl_off *to = S->scatter_to, *next = S->scatter_begin + 1;
    sli_structure_super *all = w->supers;
    for (k = r->first; k < r->last; k++) {
        const sl_int *begin = w->column + w->old_of[k];
        const sl_int *end = w->spare + 2 * (size_t)begin[1];
        sli_structure_super *own = all + super_of[k];
        if ((r->first > 0 && S->super_first[S->first_descendant[super_of[k]]] < r->first) ||
            own->last >= k) {
            continue;
        }
        sli_structure_add(own, k);
        if (bottom != NULL) {
            sli_structure_climb(all, all + bottom[super_of[k]], k, rows, relative, bottom);
        }
        for (row = w->spare + 2 * (size_t)begin[0]; row < end; row += 2) {
            const sl_int column = new_of[row[0]], s = super_of[column];
            sli_structure_super *v = all + s;
            sl_off e;
            sli_structure_climb(all, bottom != NULL ? all + bottom[s] : v, k, rows, relative,
                                bottom);
            e = next[s]++;
            from[e] = row[1];
            to[e] = v->to + SLI_TILE * (sl_off)column;
        }
    }
}

/* Fills first_descendant. As supernodes are in postorder, the children of s are s - 1, then the
 * supernode before the first descendant of s - 1, and so on, down to the first descendant of s. */
static void sli_fill_descendants(const sl_symbolic *S) {
    sl_int *low = S->first_descendant, s;
    sli_order_natural(S->n_supers, low);
    for (s = 0; s < S->n_supers; s++) {
        const sl_int up = S->super_parent[s];
        if (up != -1) {
            low[up] = sli_min(low[up], low[s]);
        }
    }
}

/* Fills all arrays of S by supernodes but the steps. That of an edit has no first_descendant. */
SLI_NOINLINE static void sli_fill_structure(sli_analysis *w, const sl_symbolic *S) {
    const sli_range all = {0, w->n, 0, 0};
    const sl_int count = w->team == NULL ? 1 : sli_shares_count(w->team, w->n);
    w->S = S;
    sli_structure_count(w, S);
    sli_structure_start(w, S);
    if (S->first_descendant != NULL) {
        sli_fill_descendants(S);
    }
    if (count > 1) {
        sli_range_run(w->team, w->n, count, sli_structure_rows, w);
    }
    sli_structure_rows(w, &all);
}

/* Do nearly all supernodes have one column? Where one in ten is wider, runs are short, and sweeps
 * lose time by them. */
SLI_INLINE int sli_is_mostly_plain(sl_int count, sl_int supers) {
    return 20 * (int64_t)count > 19 * (int64_t)supers;
}

/* Fills S->plain, if there is room for it. It is not kept if too few supernodes have one column, or
 * if their panels are padded, as in old files. */
static void sli_fill_plain(sl_symbolic *S) {
    sl_int s, count = 0, padded = 0;
    sl_off end = -1; /* of the panel of one column before */
    for (s = 0; s < S->n_supers && S->plain != NULL; s++) {
        const sli_step *step = &S->steps[s];
        const int is_plain = step->width == 1;
        S->plain[s] = is_plain ? step->below : -1;
        padded |= is_plain && end >= 0 && step->panel != end;
        end = is_plain ? step->panel + 1 + step->below : -1;
        count += is_plain;
    }
    S->plain = !padded && sli_is_mostly_plain(count, S->n_supers) ? S->plain : NULL;
}

/* Fills the steps of a sweep over all supernodes: the vector has all n columns, so that `base` is
 * the column. */
static void sli_fill_steps(sl_symbolic *S) {
    sl_int s;
    S->tallest = 0;
    S->widest = 0;
    for (s = 0; s < S->n_supers; s++) {
        sli_step *step = &S->steps[s];
        step->panel = S->panel_begin[s];
        step->column = S->super_first[s];
        step->base = S->super_first[s];
        step->width = S->super_first[s + 1] - S->super_first[s];
        step->below = (sl_int)(S->rows_begin[s + 1] - S->rows_begin[s]);
        step->first_tile = 0;
        step->up = S->super_parent[s];
        S->widest = sli_max(S->widest, step->width);
        S->tallest = sli_max(S->tallest, step->width + step->below);
    }
}

/* The last row tile of supernode s. */
SLI_INLINE sl_int sli_last_tile(const sl_symbolic *S, sl_int s) {
    return sli_tiles(S->steps[s].width + S->steps[s].below) - 1;
}

/* Finds the pivots k >= j such that entry m of the scatter map goes to L(k, j). m belongs to
 * supernode s. tile: where to start, the row tile of m or a later one; set to the tile of m. Within
 * a supernode the rows ascend along the map: a backward pass that starts with the last tile visits
 * each tile once. */
static void sli_scatter_map_pivots(const sl_symbolic *S, sl_int s, sl_off m, sl_int *tile,
                                   sl_int *k, sl_int *j) {
    const sl_int first = S->super_first[s], w = S->steps[s].width;
    sl_off in_tile = S->scatter_to[m] - S->panel_begin[s];
    sl_int local;
    while (sli_tile_offset(w, *tile) > in_tile) {
        --*tile;
    }
    in_tile -= sli_tile_offset(w, *tile);
    local = SLI_TILE * *tile + (sl_int)(in_tile % SLI_TILE);
    *j = first + (sl_int)(in_tile / SLI_TILE);
    *k = local < w ? first + local : S->rows[S->rows_begin[s] + local - w];
    SLI_ASSERT(S->panel_begin[s] + sli_panel_at(w, local, *j - first) == S->scatter_to[m]);
}

#endif

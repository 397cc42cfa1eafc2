/* edit_join.h: joins kept subtrees and fresh supernodes to the analysis of an edited matrix */
#ifndef SLI_EDIT_JOIN_H
#define SLI_EDIT_JOIN_H

#include "edit_graph.h"

/* What the joining needs besides the edit and the fresh supernodes. */
typedef struct sli_edit_join {
    sli_edit *e;
    sli_restriction r;
    sl_symbolic *T;           /* the result */
    sl_int *super_new;        /* supernodes of S: the final number of a kept one */
    sl_int *column_new;       /* columns of S: the final one, or -1 */
    sl_int *next;             /* supernodes of S: the next root in a list of kept subtrees */
    uint64_t *list, *scratch; /* of one supernode: its rows below or its entries, the most */
    sl_int most;
    void *block;
} sli_edit_join;

static sl_status sli_edit_join_room(sli_edit_join *j, const sl_allocator *a) {
    const sl_symbolic *S = j->e->S;
    sli_block b = {NULL, 0};
    sl_status status = SL_OK;
    sl_int s;
    j->most = S->tallest;
    for (s = 0; s < S->n_supers; s++) {
        j->most = sli_max(j->most, (sl_int)(S->scatter_begin[s + 1] - S->scatter_begin[s]));
    }
    SLI_LAYOUT(&b, a, status) {
        j->super_new = SLI_TAKE(&b, sl_int, S->n_supers);
        j->next = SLI_TAKE(&b, sl_int, S->n_supers);
        j->column_new = SLI_TAKE(&b, sl_int, S->n);
        j->list = SLI_TAKE(&b, uint64_t, j->most);
        j->scratch = SLI_TAKE(&b, uint64_t, j->most);
    }
    j->block = b.base;
    return status;
}

/* Appends kept supernode s with its columns and their rows. */
static void sli_edit_join_kept(sli_edit_join *j, sli_joint *at, sl_int s) {
    const sl_symbolic *S = j->e->S;
    sl_int k;
    j->super_new[s] = at->super;
    for (k = S->super_first[s]; k < S->super_first[s + 1]; k++) {
        const sl_int column = at->column + k - S->super_first[s];
        j->column_new[k] = column;
        j->T->perm[column] = j->e->new_of[S->perm[k]];
        j->T->counts[column] = S->counts[k];
    }
    sli_joint_add(at, S->super_first[s + 1] - S->super_first[s],
                  S->rows_begin[s + 1] - S->rows_begin[s]);
}

/* Numbers supernodes and columns: each fresh supernode follows its children, the fresh ones first.
 * Kept trees without a row below come first of all. */
static void sli_edit_join_number(sli_edit_join *j) {
    const sl_symbolic *S = j->e->S, *fresh = &j->r.T;
    sli_joint at = sli_joint_start(j->T);
    sl_int s, t, k, root;
    for (t = 0; t <= fresh->n_supers; t++) {
        j->r.head[t] = -1;
    }
    for (s = S->n_supers - 1; s >= 0; s--) {
        if (sli_edit_is_root(j->e, s)) {
            t = S->super_parent[s] == -1
                    ? fresh->n_supers
                    : fresh->super_of[j->r.w.new_of[sli_edit_first_below(j->e, s)]];
            j->next[s] = j->r.head[t];
            j->r.head[t] = s;
        }
    }
    for (t = -1; t < fresh->n_supers; t++) {
        for (root = j->r.head[t == -1 ? fresh->n_supers : t]; root != -1; root = j->next[root]) {
            for (s = S->first_descendant[root]; s <= root; s++) {
                sli_edit_join_kept(j, &at, s);
            }
        }
        if (t != -1) {
            const sl_int first = fresh->super_first[t], width = fresh->super_first[t + 1] - first;
            for (k = 0; k < width; k++) {
                j->T->perm[at.column + k] = j->e->fresh[j->r.w.old_of[first + k]];
            }
            j->r.T_new[t] = at.super;
            sli_joint_add(&at, width, fresh->rows_begin[t + 1] - fresh->rows_begin[t]);
        }
    }
    sli_joint_end(&at);
}

/* Completes the maps from rows and from columns of S to the final columns. */
static void sli_edit_join_maps(sli_edit_join *j) {
    const sl_symbolic *S = j->e->S;
    sl_int s, k;
    for (k = 0; k < j->T->n; k++) {
        j->T->iperm[j->T->perm[k]] = k;
    }
    for (s = 0; s < S->n_supers; s++) {
        for (k = S->super_first[s]; j->e->mark[s] != SLI_NODE_KEPT && k < S->super_first[s + 1];
             k++) {
            const sl_int row = j->e->new_of[S->perm[k]];
            j->column_new[k] = row == -1 ? -1 : j->T->iperm[row];
        }
    }
    j->r.column_of = j->T->iperm;
}

/* Fills rows and tree of kept supernode s. Returns whether the rows below are in another order than
 * before. */
static int sli_edit_join_rows(sli_edit_join *j, sl_int s) {
    const sl_symbolic *S = j->e->S;
    sl_symbolic *T = j->T;
    const sl_int to = j->super_new[s], below = S->steps[s].below;
    const sl_int *from = S->rows + S->rows_begin[s];
    sl_int *rows = T->rows + T->rows_begin[to];
    const sl_int first = S->super_first[s], shift = T->super_first[to] - first;
    sl_int k, last = -1;
    int is_moved = 0;
    for (k = 0; k < below; k++) {
        rows[k] = j->column_new[from[k]];
        is_moved |= rows[k] <= last;
        last = rows[k];
    }
    if (is_moved) {
        for (k = 0; k < below; k++) {
            j->list[k] = sli_keyed(rows[k], 0);
        }
        sli_sort(j->list, below, j->scratch);
        for (k = 0; k < below; k++) {
            rows[k] = sli_key(j->list[k]);
        }
    }
    /* only the last column has its parent elsewhere: the first row below */
    for (k = first; k < S->super_first[s + 1] - 1; k++) {
        T->parent[k + shift] = S->parent[k] + shift;
    }
    T->parent[k + shift] = below > 0 ? rows[0] : -1;
    T->super_parent[to] = below > 0 ? T->super_of[rows[0]] : -1;
    return is_moved;
}

/* Fills the map of entries of kept supernode s, which ascends by rows. */
static void sli_edit_join_map(sli_edit_join *j, sl_int s, int is_moved) {
    const sl_symbolic *S = j->e->S;
    sl_symbolic *T = j->T;
    const sl_int to = j->super_new[s], width = S->steps[s].width, below = S->steps[s].below;
    const sl_off begin = S->scatter_begin[s], base = T->scatter_begin[to],
                 shift = T->panel_begin[to] - S->panel_begin[s];
    const sl_int count = (sl_int)(S->scatter_begin[s + 1] - begin);
    sl_int m, tile = sli_last_tile(S, s);
    for (m = 0; m < count && !is_moved; m++) {
        T->scatter_from[base + m] = j->e->position[S->scatter_from[begin + m]];
        T->scatter_to[base + m] = S->scatter_to[begin + m] + shift;
    }
    for (m = count - 1; m >= 0 && is_moved; m--) {
        sl_int k, column;
        sli_scatter_map_pivots(S, s, begin + m, &tile, &k, &column);
        j->list[m] = sli_keyed(j->column_new[k], m);
    }
    if (!is_moved) {
        return;
    }
    sli_sort(j->list, count, j->scratch);
    for (m = 0; m < count; m++) {
        const sl_off from = begin + sli_value(j->list[m]);
        const sl_int row = sli_key(j->list[m]) - T->super_first[to];
        sl_int k, column, last = sli_last_tile(S, s);
        const sl_int local = row < width ? row
                                         : width + sli_lower_bound(T->rows + T->rows_begin[to],
                                                                   below, sli_key(j->list[m]));
        sli_scatter_map_pivots(S, s, from, &last, &k, &column);
        T->scatter_from[base + m] = j->e->position[S->scatter_from[from]];
        T->scatter_to[base + m] =
            T->panel_begin[to] + sli_panel_at(width, local, column - S->super_first[s]);
    }
}

/* scatter_begin := sums of the numbers of entries of each supernode. */
static void sli_edit_join_count(sli_edit_join *j) {
    const sl_symbolic *S = j->e->S, *fresh = &j->r.T;
    sl_symbolic *T = j->T;
    sl_off m;
    sl_int s, t;
    SLI_ZERO(T->scatter_begin, T->n_supers + 1);
    for (s = 0; s < S->n_supers; s++) {
        if (j->e->mark[s] == SLI_NODE_KEPT) {
            T->scatter_begin[j->super_new[s]] = S->scatter_begin[s + 1] - S->scatter_begin[s];
        }
    }
    for (t = 0; t < fresh->n_supers; t++) {
        for (m = fresh->scatter_begin[t]; m < fresh->scatter_begin[t + 1]; m++) {
            T->scatter_begin[j->r.T_new[t]] += fresh->scatter_from[m] != -1;
        }
    }
    (void)sli_starts(T->scatter_begin, T->n_supers);
}

/* The number of fundamental supernodes: a column continues one if it has one child, of one entry
 * more. children: n of scratch. */
static sl_int sli_edit_join_fundamental(const sl_symbolic *T, sl_int *children) {
    sl_int k, count = T->n;
    SLI_ZERO(children, T->n);
    for (k = 0; k < T->n; k++) {
        if (T->parent[k] != -1) { /* two for a child that is not of the same structure */
            children[T->parent[k]] += T->counts[k] == T->counts[T->parent[k]] + 1 ? 1 : 2;
        }
    }
    for (k = 0; k < T->n; k++) {
        count -= children[k] == 1;
    }
    return count;
}

/* Fills everything. Rows and parents of kept supernodes need the numbers of all others. */
static void sli_edit_join_fill(sli_edit_join *j, sl_stats *stats) {
    const sl_symbolic *S = j->e->S;
    sl_symbolic *T = j->T;
    sl_int s, t;
    sli_edit_join_number(j);
    sli_edit_join_maps(j);
    sli_edit_join_count(j);
    for (s = 0; s < S->n_supers; s++) {
        if (j->e->mark[s] == SLI_NODE_KEPT) {
            const int is_moved = sli_edit_join_rows(j, s);
            sli_edit_join_map(j, s, is_moved);
        }
    }
    for (t = 0; t < j->r.T.n_supers; t++) {
        sl_off at = T->scatter_begin[j->r.T_new[t]];
        sli_joint_fill_fresh(T, &j->r, t, &at);
    }
    stats->symbolic.supernodes_fundamental = sli_edit_join_fundamental(T, j->e->cursor);
    sli_joint_complete(T, j->e->cursor, stats);
}

/* Creates the analysis of B. */
static sl_status sli_edit_join_make(sl_symbolic **out, sli_edit_join *j, const sl_allocator *a,
                                    sl_stats *stats) {
    const sl_symbolic *S = j->e->S;
    sl_symbolic draft;
    sl_off rows, entries = 0;
    sl_int s, k;
    sl_status status = sli_edit_join_room(j, a);
    SLI_CLEAR(draft);
    draft.allocator = *a;
    draft.n = j->e->n;
    draft.nnz_input = sli_nnz(j->e->B);
    (void)sli_pattern_hash(j->e->B, &draft.pattern);
    draft.n_supers = j->r.T.n_supers;
    rows = j->r.T.rows_begin[j->r.T.n_supers];
    for (s = 0; s < S->n_supers; s++) {
        if (j->e->mark[s] == SLI_NODE_KEPT) {
            draft.n_supers++;
            rows += S->rows_begin[s + 1] - S->rows_begin[s];
            entries += S->scatter_begin[s + 1] - S->scatter_begin[s];
        }
    }
    for (k = 0; k < j->r.n_entries; k++) {
        entries += j->r.w.columns.entry[SLI_ENTRY * (size_t)k + 1] != -1;
    }
    status = status == SL_OK ? sli_joint_room(out, &draft, rows, entries, stats) : status;
    if (status == SL_OK) {
        j->T = *out;
        sli_edit_join_fill(j, stats);
    }
    return status;
}

#endif

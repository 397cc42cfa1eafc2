/* submatrix_symbolic.h: joins kept subtrees and new supernodes to the analysis of A[R, R] */
#ifndef SLI_EDIT_SUBMATRIX_SYMBOLIC_H
#define SLI_EDIT_SUBMATRIX_SYMBOLIC_H

#include "submatrix_analysis.h"

/* Where the next supernode goes. */
typedef struct sli_joint {
    sl_symbolic *S;
    sl_int super, column;
    sl_off rows, panel;
} sli_joint;

/* Allocates the analysis of a draft, whose n and n_supers are known. */
static sl_status sli_joint_room(sl_symbolic **out, sl_symbolic *draft, sl_off rows, sl_off entries,
                                sl_stats *stats) {
    sli_block b = {NULL, 0};
    sl_status status = SL_OK;
    SLI_LAYOUT(&b, &draft->allocator, status) {
        (void)sli_take(&b, 1, sizeof(sl_symbolic));
        sli_symbolic_layout(draft, &b, rows, entries);
        stats->symbolic.bytes = b.used;
    }
    if (status == SL_OK) {
        *out = (sl_symbolic *)(void *)b.base;
        **out = *draft;
    }
    return status;
}

SLI_INLINE sli_joint sli_joint_start(sl_symbolic *S) {
    sli_joint j;
    SLI_CLEAR(j);
    j.S = S;
    return j;
}

/* Ends the numbering behind the last supernode. */
SLI_INLINE void sli_joint_end(const sli_joint *j) {
    j->S->super_first[j->super] = j->column;
    j->S->rows_begin[j->super] = j->rows;
    j->S->panel_begin[j->super] = j->panel;
}

/* Appends the next supernode, whose columns are numbered already. */
static void sli_joint_add(sli_joint *j, sl_int width, sl_off below) {
    sl_symbolic *S = j->S;
    sl_int k;
    S->super_first[j->super] = j->column;
    S->rows_begin[j->super] = j->rows;
    S->panel_begin[j->super] = sli_panel_start(width, j->panel);
    for (k = 0; k < width; k++) {
        S->super_of[j->column++] = j->super;
    }
    j->rows += below;
    j->panel = S->panel_begin[j->super] + sli_panel_size(width, (sl_int)below);
    j->super++;
}

/* Appends the subtrees of a list of kept roots. */
SLI_HOT static void sli_joint_add_kept(sli_joint *j, sli_restriction *r, sl_int root) {
    for (; root != -1; root = r->next[root]) {
        sl_int q, k;
        for (q = root + r->S->first_descendant[r->kept[root]] - r->kept[root]; q <= root; q++) {
            const sl_int s = r->kept[q], width = r->S->super_first[s + 1] - r->S->super_first[s];
            for (k = 0; k < width; k++) {
                r->column_of[r->first_rank[q] + k] = j->column + k;
            }
            r->kept_new[q] = j->super;
            sli_joint_add(j, width, r->below_begin[q + 1] - r->below_begin[q]);
        }
    }
}

/* Numbers supernodes and columns: each new supernode follows its children, the new ones first.
 * Roots that have no row of R below them come first of all. */
static void sli_joint_number(sl_symbolic *S, sli_restriction *r) {
    const sl_symbolic *T = &r->T;
    sli_joint j = sli_joint_start(S);
    sl_int q, t, k;
    for (t = 0; t <= T->n_supers; t++) {
        r->head[t] = -1;
    }
    for (q = r->n_kept - 1; q >= 0; q--) {
        if (sli_restriction_is_root(r, q)) {
            t = T->n_supers;
            if (r->below_begin[q] < r->below_begin[q + 1]) {
                t = T->super_of[r->w.new_of[r->fresh_of[r->below[r->below_begin[q]]]]];
            }
            r->next[q] = r->head[t];
            r->head[t] = q;
        }
    }
    sli_joint_add_kept(&j, r, r->head[T->n_supers]);
    for (t = 0; t < T->n_supers; t++) {
        const sl_int first = T->super_first[t], width = T->super_first[t + 1] - first;
        sli_joint_add_kept(&j, r, r->head[t]);
        for (k = 0; k < width; k++) {
            r->column_of[r->fresh[r->w.old_of[first + k]]] = j.column + k;
        }
        r->T_new[t] = j.super;
        sli_joint_add(&j, width, T->rows_begin[t + 1] - T->rows_begin[t]);
    }
    sli_joint_end(&j);
}

/* Fills the tree and the rows of kept supernode q. A column whose parent was removed gets the next
 * row of R below its supernode: an ancestor in any case, and its parent if no zero is stored. */
SLI_HOT static void sli_joint_fill_kept(sl_symbolic *S, const sli_restriction *r, sl_int q) {
    const sl_symbolic *from = r->S;
    const sl_int s = r->kept[q], to = r->kept_new[q], up = from->super_parent[s];
    const sl_int first = from->super_first[s], end = from->super_first[s + 1];
    const sl_int base = S->super_first[to] - first; /* from a column of A's L to the final one */
    const sl_off begin = S->rows_begin[to];
    const sl_int below = (sl_int)(S->rows_begin[to + 1] - begin);
    sl_int k;
    for (k = 0; k < below; k++) {
        S->rows[begin + k] = r->column_of[r->below[r->below_begin[q] + k]];
    }
    S->super_parent[to] = below == 0 ? -1 : S->super_of[S->rows[begin]];
    SLI_ASSERT(up == -1 || sli_restriction_is_root(r, q) || S->super_parent[to] == to + up - s);
    for (k = first; k < end; k++) {
        const sl_int parent = from->parent[k];
        const sl_int rank = parent < end ? -1 : sli_subset_find(&r->R, parent);
        S->parent[k + base] = parent != -1 && parent < end ? parent + base
                              : rank != -1                 ? r->column_of[rank]
                              : below > 0                  ? S->rows[begin]
                                                           : -1;
        S->counts[k + base] = sli_min(from->counts[k], end - k + below);
    }
    (void)up;
}

/* Fills the tree, the rows and the map of entries of new supernode t. */
static void sli_joint_fill_fresh(sl_symbolic *S, const sli_restriction *r, sl_int t, sl_off *at) {
    const sl_symbolic *T = &r->T;
    const sl_int to = r->T_new[t], base = S->super_first[to] - T->super_first[t];
    const sl_int *old_of = r->w.old_of;
    sl_off p;
    sl_int k;
    for (p = 0; p < T->rows_begin[t + 1] - T->rows_begin[t]; p++) {
        S->rows[S->rows_begin[to] + p] =
            r->column_of[r->fresh[old_of[T->rows[T->rows_begin[t] + p]]]];
    }
    S->super_parent[to] = T->super_parent[t] == -1 ? -1 : r->T_new[T->super_parent[t]];
    for (k = T->super_first[t]; k < T->super_first[t + 1]; k++) {
        const sl_int parent = r->w.parent[k];
        S->parent[k + base] = parent == -1 ? -1 : r->column_of[r->fresh[old_of[parent]]];
        S->counts[k + base] = r->w.counts[k];
    }
    for (p = T->scatter_begin[t]; p < T->scatter_begin[t + 1]; p++) {
        if (T->scatter_from[p] != -1) {
            S->scatter_from[*at] = T->scatter_from[p];
            S->scatter_to[(*at)++] = T->scatter_to[p] - T->panel_begin[t] + S->panel_begin[to];
        }
    }
}

/* Fills what follows from the supernodes, their rows and the map of entries. scratch: n */
static void sli_joint_complete(sl_symbolic *S, sl_int *scratch, sl_stats *stats) {
    sl_int s;
    sli_fill_steps(S);
    sli_fill_descendants(S);
    for (s = 0; s < S->n_supers; s++) {
        sli_fill_relative_of(S, s, scratch);
    }
    sli_fill_identity(S, stats->symbolic.triangle);
    stats->symbolic.nnz_a = S->scatter_begin[S->n_supers];
    sli_analyze_stats(S, scratch, stats);
    S->stats.symbolic = stats->symbolic;
}

/* Fills everything that follows the numbering. The map of entries has those of new supernodes. */
static void sli_joint_fill(sl_symbolic *S, sli_restriction *r, sl_stats *stats) {
    sl_int *scratch = (sl_int *)(void *)r->list; /* count: the subset is sorted */
    sl_int s, q, k;
    sl_off at = 0;
    for (k = 0; k < S->n; k++) {
        S->perm[r->column_of[k]] = r->R.row_of[k];
    }
    for (k = 0; k < S->n; k++) {
        S->iperm[S->perm[k]] = k;
    }
    for (q = 0; q < r->n_kept; q++) {
        sli_joint_fill_kept(S, r, q);
    }
    SLI_ZERO(S->scatter_begin, S->n_supers + 1);
    for (q = 0; q < r->T.n_supers; q++) {
        const sl_off before = at;
        sli_joint_fill_fresh(S, r, q, &at);
        S->scatter_begin[r->T_new[q] + 1] = at - before;
    }
    for (s = 0; s < S->n_supers; s++) {
        S->scatter_begin[s + 1] += S->scatter_begin[s];
    }
    sli_joint_complete(S, scratch, stats);
}

/* An analysis of A[R, R] without arrays. */
static sl_symbolic sli_restriction_draft(const sli_restriction *r, const sl_allocator *a) {
    sl_symbolic draft;
    SLI_CLEAR(draft);
    draft.allocator = *a;
    draft.n = r->R.count;
    draft.nnz_input = -1; /* no matrix has this pattern */
    draft.pattern = sli_hash_ints(r->S->identity, r->rows, r->R.count);
    draft.is_pivoted = r->S->is_pivoted;
    draft.is_partial = 1; /* it cannot be saved */
    return draft;
}

/* Creates the analysis of A[R, R] of which nothing is kept. */
static sl_status sli_restriction_make(sl_symbolic **out, sli_restriction *r, const sl_allocator *a,
                                      sl_stats *stats) {
    sl_symbolic draft = sli_restriction_draft(r, a);
    sli_restriction_tree(r, a, stats);
    (void)sli_analysis_lap(&r->w);
    SLI_COPY(r->w.perm, r->R.row_of, r->R.count);
    return sli_symbolic_build(out, &draft, &r->w, stats);
}

/* Creates the analysis of A[R, R] from the kept columns and the new ones. */
static sl_status sli_joint_make(sl_symbolic **out, sli_restriction *r, const sl_allocator *a,
                                sl_stats *stats) {
    sl_symbolic draft = sli_restriction_draft(r, a);
    sl_status status = sli_restriction_analyze(r, a, stats);
    draft.n_supers = r->n_kept + r->T.n_supers;
    if (status == SL_OK) {
        const sl_off rows = r->below_begin[r->n_kept] + r->T.rows_begin[r->T.n_supers];
        status = sli_joint_room(out, &draft, rows, r->n_entries, stats);
    }
    if (status == SL_OK) {
        sli_joint_number(*out, r);
        sli_joint_fill(*out, r, stats);
    }
    return status;
}

#endif

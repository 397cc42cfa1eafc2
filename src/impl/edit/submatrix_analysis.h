/* submatrix_analysis.h: the analysis of A[R, R] from that of A: new for columns with a removed
 * descendant only */
#ifndef SLI_EDIT_SUBMATRIX_ANALYSIS_H
#define SLI_EDIT_SUBMATRIX_ANALYSIS_H

#include "submatrix_kept.h"

/* Allocates the graph of the new columns, which has no entry yet, and their analysis. entries: how
 * many there may be. */
static sl_status sli_restriction_work(sli_restriction *r, uint64_t entries, const sl_allocator *a) {
    sli_analysis *w = &r->w;
    sli_block b = {NULL, 0};
    sl_status status = entries > INT32_MAX ? sli_refuse(SL_ERR_TOO_LARGE,
                                                        "more than 2^31 - 1 entries of new columns")
                                           : SL_OK;
    SLI_LAYOUT(&b, a, status) {
        sli_analysis_layout(w, &b, r->n_fresh, (sl_int)entries);
    }
    r->blocks[2] = b.base;
    if (status == SL_OK) {
        r->entry_from = w->column; /* what only another order needs */
        r->entry_row = w->spare;
        r->entry_column = w->spare + entries;
    }
    return status;
}

SLI_INLINE void sli_restriction_enter(sli_restriction *r, sl_int a, sl_int b, sl_int from) {
    r->entry_row[r->n_entries] = a;
    r->entry_column[r->n_entries] = b;
    r->entry_from[r->n_entries++] = from;
}

/* The bits of a row of A and its neighbors: 0 if it is not in R; 1 also for some that are not. */
SLI_INLINE uint32_t *sli_restriction_bits(const sli_restriction *r, sl_int row) {
    return &r->bits[((uint32_t)row / 32) & r->bits_mask];
}

/* The new column of a row of A, or -1, without an array by rows. */
SLI_INLINE sl_int sli_restriction_number(const sli_restriction *r, sl_int row) {
    sl_int rank;
    if ((*sli_restriction_bits(r, row) >> (row % 32) & 1) == 0) {
        return -1;
    }
    rank = sli_subset_find(&r->R, r->S->iperm[row]);
    return rank == -1 || r->n_kept == 0 ? rank : r->fresh_of[rank];
}

/* Lists the cliques of the new columns. */
static void sli_restriction_cliques(sli_restriction *r) {
    sl_int q;
    sl_off at;
    for (q = 0; q < r->n_kept; q++) {
        if (sli_restriction_is_root(r, q)) {
            for (at = r->below_begin[q] + 1; at < r->below_begin[q + 1]; at++) {
                sli_restriction_enter(r, r->fresh_of[r->below[at]],
                                      r->fresh_of[r->below[r->below_begin[q]]], -1);
            }
        }
    }
}

/* Lists the entries of A in new columns. Its pattern has not been compared with the analyzed one.
 * Where it is read in place, no branch asks whether an entry is in R: nothing would predict it. */
SLI_HOT static sl_status sli_restriction_graph(sli_restriction *r, sl_stats *stats) {
    const sl_csc *A = r->A;
    const sl_triangle triangle = r->S->stats.symbolic.triangle;
    const sl_int *number_at = r->number_at;
    const int copies = r->B_values != NULL;
    sl_int *row = r->entry_row, *column = r->entry_column, *from = r->entry_from;
    sl_int k, p, e = r->n_entries;
    int others = 0; /* entries that are not read: in the analyzed matrix all may be */
    for (k = 0; k < r->R.count; k++) { /* in the caller's order, in which A is read faster */
        const sl_int j = r->rows[k], own = r->number_of[k], end = sli_value(r->list[k]);
        if (k + SLI_RESTRICT_AHEAD < r->R.count) {
            const uint64_t ahead = r->list[k + SLI_RESTRICT_AHEAD];
            SLI_PREFETCH(A->i + sli_key(ahead), 0);
            SLI_PREFETCH(A->i + sli_value(ahead), 0);
        }
        if (copies) {
            r->B_begin[k] = e;
        }
        for (p = sli_key(r->list[k]); p < end; p++) {
            const sl_int i = A->i[p];
            sl_int other = own, is_there;
            if (i < 0 || i >= A->n_rows) {
                return sli_fail_at(stats, SL_ERR_MALFORMED, i, j, sli_min(i, 0),
                                   "a row of A is out of range; rows count from 0");
            }
            is_there = sli_is_read(triangle, i, j);
            others |= !is_there;
            if (number_at != NULL) {
                other = number_at[i];
            } else if (i != j) {
                other = is_there ? sli_restriction_number(r, i) : -1;
            }
            is_there &= other >= 0;
            if (copies) {
                if (!is_there) {
                    continue;
                }
                r->B_rows[e] = i;
            }
            row[e] = other;
            column[e] = own;
            from[e] = p;
            e += is_there;
        }
    }
    if (others && r->S->nnz_input == r->S->scatter_begin[r->S->n_supers]) {
        return sli_refuse(SL_ERR_OTHER_PATTERN, "A stores the other triangle");
    }
    if (copies) {
        r->B_begin[k] = e;
    }
    for (k = r->n_entries; k < e && copies; k++) { /* only values in R are fetched */
        SLI_PREFETCH(A->x + from[sli_min(k + SLI_RESTRICT_AHEAD, e - 1)], 0);
        r->B_values[k] = A->x[from[k]];
        from[k] = k;
    }
    r->n_entries = e;
    return SL_OK;
}

/* Room for the graph and, where A is not read in place, for its entries. */
static sl_status sli_restriction_copy(sli_restriction *r, uint64_t entries, const sl_allocator *a) {
    const int copies = r->R.count < r->S->n / SLI_RESTRICT_IN_PLACE;
    sli_block b = {NULL, 0};
    sl_status status = sli_restriction_work(r, entries, a);
    if (copies) {
        SLI_LAYOUT(&b, a, status) {
            r->B_begin = SLI_TAKE(&b, sl_int, (uint64_t)r->R.count + 1);
            r->B_rows = SLI_TAKE(&b, sl_int, entries);
            r->B_values = SLI_TAKE(&b, double, entries);
        }
    }
    r->blocks[5] = b.base;
    r->B = *r->A;
    if (copies) {
        r->B.n_cols = r->R.count;
        r->B.p = r->B_begin;
        r->B.i = r->B_rows;
        r->B.x = r->B_values;
    }
    return status;
}

/* Room for the graph: checks the columns of R. */
static sl_status sli_restriction_room(sli_restriction *r, const sl_allocator *a, sl_stats *stats) {
    const sl_int *p = r->A->p;
    uint64_t entries = 0;
    sl_int q, k;
    for (q = 0; q < r->n_kept; q++) {
        entries += sli_restriction_is_root(r, q)
                       ? (uint64_t)(r->below_begin[q + 1] - r->below_begin[q])
                       : 0;
    }
    if (r->number_at != NULL) {
        SLI_NONE(r->number_at, r->S->n);
    } else {
        SLI_ZERO(r->bits, (size_t)r->bits_mask + 1);
    }
    for (k = 0; k < r->R.count; k++) {
        const sl_int j = r->rows[k];
        sl_int number = r->number_of[k];
        if (k + SLI_RESTRICT_AHEAD < r->R.count) {
            SLI_PREFETCH(p + r->rows[k + SLI_RESTRICT_AHEAD], 0);
        }
        if (p[j] < 0 || p[j + 1] < p[j] || p[j + 1] > sli_nnz(r->A)) {
            return sli_fail_at(stats, SL_ERR_MALFORMED, -1, j, 0.0, "A.p descends");
        }
        if (r->n_kept > 0) {
            r->number_of[k] = number = r->fresh_of[number];
        }
        r->list[k] = sli_keyed(p[j], number == -1 ? p[j] : p[j + 1]);
        entries += (uint64_t)(sli_value(r->list[k]) - p[j]);
        if (r->number_at != NULL) {
            r->number_at[j] = number;
        } else {
            *sli_restriction_bits(r, j) |= (uint32_t)1 << (j % 32);
        }
    }
    return sli_restriction_copy(r, entries, a);
}

/* Sorts the entries of the graph by columns. */
static void sli_restriction_sort(sli_restriction *r) {
    const sli_pattern *columns = &r->w.columns;
    sl_int *at = r->w.scratch, e;
    SLI_ZERO(at, r->n_fresh);
    for (e = 0; e < r->n_entries; e++) {
        at[sli_min(r->entry_row[e], r->entry_column[e])]++;
    }
    sli_pattern_starts(&r->w.columns, r->n_fresh, at, 1, 0);
    for (e = 0; e < r->n_entries; e++) {
        const sl_int a = r->entry_row[e], b = r->entry_column[e], column = sli_min(a, b);
        sl_int *entry = columns->entry + SLI_ENTRY * (size_t)at[column]++;
        entry[0] = a + b - column;
        entry[1] = r->entry_from[e];
    }
}

/* Finds the supernodes of the new columns. */
static void sli_restriction_tree(sli_restriction *r, const sl_allocator *a, sl_stats *stats) {
    sl_options given = sli_options_with(a);
    sli_restriction_sort(r);
    given.ordering = SL_ORDERING_GIVEN;
    given.relaxation = r->relaxation;
    sli_analyze_tree(&r->w, &given, stats);
}

/* Finds the supernodes of the new columns and their structure. */
static sl_status sli_restriction_analyze(sli_restriction *r, const sl_allocator *a,
                                         sl_stats *stats) {
    sli_analysis *w = &r->w;
    sl_symbolic *T = &r->T;
    sli_block b = {NULL, 0};
    sl_status status = SL_OK;
    uint64_t rows = 0;
    sl_int t;
    sli_restriction_tree(r, a, stats);
    T->n = r->n_fresh;
    T->n_supers = w->amalgamation.count;
    T->super_of = w->super_of;
    T->super_first = w->amalgamation.first;
    T->super_parent = w->amalgamation.parent;
    for (t = 0; t < T->n_supers; t++) {
        rows += (uint64_t)w->amalgamation.below[t];
    }
    SLI_CLEAR(b);
    SLI_LAYOUT(&b, a, status) {
        T->rows_begin = SLI_TAKE(&b, sl_off, (uint64_t)T->n_supers + 1);
        T->rows = SLI_TAKE(&b, sl_int, rows);
        T->relative = SLI_TAKE(&b, sl_int, rows);
        T->panel_begin = SLI_TAKE(&b, sl_off, (uint64_t)T->n_supers + 1);
        T->scatter_begin = SLI_TAKE(&b, sl_off, (uint64_t)T->n_supers + 1);
        T->scatter_from = SLI_TAKE(&b, sl_int, r->n_entries);
        T->scatter_to = SLI_TAKE(&b, sl_off, r->n_entries);
        r->T_new = SLI_TAKE(&b, sl_int, T->n_supers);
        r->head = SLI_TAKE(&b, sl_int, (uint64_t)T->n_supers + 1);
    }
    r->blocks[3] = b.base;
    if (status != SL_OK) {
        return status;
    }
    w->supers = (sli_structure_super *)(void *)w->amalgamation.zeros; /* of 40 n bytes */
    sli_fill_structure(w, T);
    return SL_OK;
}

/* Lists the entries of the new columns and what is left of the kept ones. */
static sl_status sli_restriction_list(sli_restriction *r, const sl_allocator *a, sl_stats *stats) {
    sl_status status = r->n_kept > 0 ? sli_restriction_filter(r, a) : SL_OK;
    status = status == SL_OK ? sli_restriction_room(r, a, stats) : status;
    if (status != SL_OK) {
        return status;
    }
    sli_restriction_cliques(r);
    return sli_restriction_graph(r, stats);
}

#endif

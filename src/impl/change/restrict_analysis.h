/* restrict_analysis.h: the analysis of A[R, R] from that of A: new for columns with a removed
 * descendant only */
#ifndef SLI_CHANGE_RESTRICT_ANALYSIS_H
#define SLI_CHANGE_RESTRICT_ANALYSIS_H

#include "../analysis/symbolic.h"
#include "subset.h"

/* Below this share of kept columns none is kept. Bands, checkerboards and random rows of which 36
 * to 42 % are kept take as long either way. */
#define SLI_RESTRICT_KEPT 0.4

/* Rows of R are scattered in memory: so many ahead they are fetched. */
#define SLI_RESTRICT_AHEAD 16

/* If a supernode of A and all its descendants are in R, L has the same numbers in A and in A[R, R],
 * without the rows that are not in R. These kept supernodes are whole subtrees. All other columns
 * of R are analyzed anew. Their graph has the entries of A between them and, for each subtree, a
 * clique of the rows below it, which are new columns: its Schur complement. A clique is given as
 * the entries of its first row, as elimination of that row completes it.
 *
 * Columns of R have three numberings: the rank in L of A, the order of the new columns, and the
 * final one. [HA18] */
typedef struct sli_restriction {
    const sl_symbolic *S; /* of A */
    const sl_csc *A;
    const sl_int *rows; /* those of A, in the caller's order */
    int may_keep; /* 0: nothing is kept */
    sli_subset R;
    uint64_t *list, *scratch; /* count each */

    sl_int n_kept;
    sl_int *kept;       /* n_kept: supernodes of A, ascending */
    sl_int *first_rank; /* n_kept: of the first column */
    sl_int *kept_new;   /* n_kept: the final number */
    sl_int *next;       /* n_kept: the next root in a list of subtrees */
    sl_int *limit;      /* n_kept: where the columns of A of its subtree end */
    sl_int n_fresh;
    sl_int *fresh;     /* n_fresh: the ranks of the new columns */
    sl_int *fresh_of;  /* count: the number of the new column, or -1 */
    sl_int *number_of; /* count: the same, by the caller's order */
    uint32_t *bits;    /* bits_mask + 1: a filter of R by rows of A */
    uint32_t bits_mask;

    sl_csc B; /* the entries of A in new columns; columns are those of the caller's order */
    sl_int *B_begin, *B_rows;
    double *B_values;

    sl_off *below_begin; /* n_kept + 1 */
    sl_int *below;       /* below_begin[n_kept]: the rows of R below each supernode, as ranks */
    sl_relaxation relaxation;
    sl_int n_entries; /* of the graph of new columns: one triangle */
    sl_int *entry_row, *entry_column;
    sl_int *entry_from; /* position in B; -1: of a clique */

    sli_analysis w;       /* of the new columns */
    sl_symbolic T;        /* the same, not renumbered yet; only its structure is filled */
    sl_int *T_new, *head; /* supernodes of T: the final number, the list of subtrees below */
    sl_int *column_of;    /* count: the final column of a rank */
    sl_off copied;        /* doubles of L that were copied */
    void *blocks[4];      /* memory of the arrays: by count, by rows and entries, w, T */
} sli_restriction;

static void sli_restriction_free(sli_restriction *r, const sl_allocator *a) {
    int k;
    for (k = 0; k < 4; k++) {
        sli_free(a, r->blocks[k]);
    }
}

/* Releases the scratch of the analysis. */
static void sli_restriction_done(sli_restriction *r, const sl_allocator *a) {
    int k;
    for (k = 2; k < 4; k++) {
        sli_free(a, r->blocks[k]);
        r->blocks[k] = NULL;
    }
}

/* The number of supernodes in the subtree with this kept root. */
SLI_INLINE sl_int sli_restriction_size(const sli_restriction *r, sl_int root) {
    return r->kept[root] - r->S->first_descendant[r->kept[root]] + 1;
}

/* Is this supernode the root of a subtree of kept ones? */
SLI_INLINE int sli_restriction_is_root(const sli_restriction *r, sl_int q) {
    return r->limit[q] == r->S->super_first[r->kept[q] + 1];
}

/* Do enough columns of R follow each other in L that many supernodes may be in R? */
static int sli_restriction_has_runs(const sli_restriction *r) {
    const sl_int *columns = r->R.columns;
    sl_int k, follow = 1;
    for (k = 1; k < r->R.count; k++) {
        follow += columns[k] == columns[k - 1] + 1;
    }
    return follow >= SLI_RESTRICT_KEPT * r->R.count;
}

/* Separates kept supernodes from new columns. In a postorder the columns of a subtree are
 * consecutive; they are in R if as many of its columns are. */
static void sli_restriction_split(sli_restriction *r) {
    const sl_symbolic *S = r->S;
    const sl_int *columns = r->R.columns;
    sl_int k = r->may_keep && sli_restriction_has_runs(r) ? 0 : r->R.count, q;
    while (k < r->R.count) {
        const sl_int s = S->super_of[columns[k]], end = S->super_first[s + 1];
        const sl_int low = S->super_first[S->first_descendant[s]];
        const sl_int last = sli_min(k + (end - S->super_first[s]), r->R.count) - 1;
        const sl_int first = last + 1 - (end - low); /* the rank of low, if all are in R */
        SLI_PREFETCH(S->super_of + columns[sli_min(k + SLI_RESTRICT_AHEAD, r->R.count - 1)], 0);
        if (columns[last] == end - 1 && first >= 0 && columns[first] == low) {
            r->kept[r->n_kept] = s;
            r->first_rank[r->n_kept++] = k;
            for (; k <= last; k++) {
                r->fresh_of[k] = -1;
            }
        } else {
            for (; k < r->R.count && columns[k] < end; k++) {
                r->fresh_of[k] = r->n_fresh;
                r->fresh[r->n_fresh++] = k;
            }
        }
    }
    if (r->n_kept == 0 || r->R.count - r->n_fresh < SLI_RESTRICT_KEPT * r->R.count) {
        r->n_kept = 0;
        r->n_fresh = r->R.count;
        for (k = 0; k < r->R.count; k++) {
            r->fresh[k] = r->fresh_of[k] = k;
        }
    }
    for (q = r->n_kept - 1; q >= 0; q--) { /* a parent that is kept has the distance it has in A */
        const sl_int s = r->kept[q], up = S->super_parent[s];
        const sl_int at = up == -1 ? r->n_kept : q + up - s;
        r->limit[q] = at < r->n_kept && r->kept[at] == up ? r->limit[at] : S->super_first[s + 1];
    }
}

/* Lists the rows below the kept supernodes that are in R. The columns of a subtree have consecutive
 * ranks. */
static void sli_restriction_filter(sli_restriction *r) {
    const sl_symbolic *S = r->S;
    sl_off at = 0, p;
    sl_int q;
    for (q = 0; q < r->n_kept; q++) {
        const sl_int s = r->kept[q], limit = r->limit[q];
        const sl_int shift = r->first_rank[q] - S->super_first[s];
        r->below_begin[q] = at;
        for (p = S->rows_begin[s]; p < S->rows_begin[s + 1]; p++) {
            const sl_int row = S->rows[p];
            const sl_int rank = row < limit ? row + shift : sli_subset_find(&r->R, row);
            if (rank != -1) {
                r->below[at++] = rank;
            }
        }
    }
    r->below_begin[q] = at;
}

SLI_INLINE void sli_restriction_enter(sli_restriction *r, sl_int a, sl_int b, sl_int from) {
    r->entry_row[r->n_entries] = sli_max(a, b);
    r->entry_column[r->n_entries] = sli_min(a, b);
    r->entry_from[r->n_entries++] = from;
}

/* The bits of a row of A and its neighbors: 0 if it is not in R; 1 also for some that are not. */
SLI_INLINE uint32_t *sli_restriction_bits(const sli_restriction *r, sl_int row) {
    return &r->bits[((uint32_t)row / 32) & r->bits_mask];
}

/* Lists the graph of the new columns: the cliques, and the entries of A. Its pattern has not been
 * compared with the analyzed one. */
static sl_status sli_restriction_graph(sli_restriction *r, sl_stats *stats) {
    const sl_csc *A = r->A;
    const sl_triangle triangle = r->S->stats.symbolic.triangle;
    sl_int q, k, p, count = 0;
    sl_off at;
    for (q = 0; q < r->n_kept; q++) {
        if (sli_restriction_is_root(r, q)) {
            for (at = r->below_begin[q] + 1; at < r->below_begin[q + 1]; at++) {
                sli_restriction_enter(r, r->fresh_of[r->below[at]],
                                      r->fresh_of[r->below[r->below_begin[q]]], -1);
            }
        }
    }
    for (k = 0; k < r->R.count; k++) { /* in the caller's order, in which A is read faster */
        const sl_int j = r->rows[k], own = r->number_of[k];
        const sl_int end = own == -1 ? A->p[j] : A->p[j + 1];
        if (k + SLI_RESTRICT_AHEAD < r->R.count) {
            SLI_PREFETCH(A->i + A->p[r->rows[k + SLI_RESTRICT_AHEAD]], 0);
            SLI_PREFETCH(A->x + A->p[r->rows[k + SLI_RESTRICT_AHEAD]], 0);
        }
        r->B_begin[k] = count;
        for (p = A->p[j]; p < end; p++) {
            const sl_int i = A->i[p];
            sl_int other = own;
            if (i < 0 || i >= A->n_rows) {
                return sli_fail_at(stats, SL_ERR_PATTERN, i, j, 0.0);
            }
            if (i != j) {
                const int may_be = (*sli_restriction_bits(r, i) >> (i % 32) & 1) != 0 &&
                                   sli_is_read(triangle, i, j);
                other = may_be ? sli_subset_find(&r->R, r->S->iperm[i]) : -1;
                other = other == -1 ? -1 : r->fresh_of[other];
            }
            if (other != -1) {
                r->B_rows[count] = i;
                r->B_values[count] = A->x[p];
                sli_restriction_enter(r, other, own, count++);
            }
        }
    }
    r->B_begin[k] = count;
    return SL_OK;
}

/* Room for the rows below kept supernodes and for the graph. */
static sl_status sli_restriction_room(sli_restriction *r, const sl_allocator *a, sl_stats *stats) {
    const sl_symbolic *S = r->S;
    const sl_int *p = r->A->p;
    uint64_t rows = 0, entries = 0, own = 0;
    sli_block b = {NULL, 0, 0};
    sl_status status = SL_OK;
    sl_int q, k;
    int pass;
    for (q = 0; q < r->n_kept; q++) {
        const sl_off here = S->rows_begin[r->kept[q] + 1] - S->rows_begin[r->kept[q]];
        rows += (uint64_t)here;
        entries += sli_restriction_is_root(r, q) ? (uint64_t)here : 0;
    }
    memset(r->bits, 0, ((size_t)r->bits_mask + 1) * sizeof(uint32_t));
    for (k = 0; k < r->R.count; k++) {
        r->number_of[r->R.row_of[k]] = r->fresh_of[k];
    }
    for (k = 0; k < r->R.count; k++) {
        const sl_int j = r->rows[k];
        if (k + SLI_RESTRICT_AHEAD < r->R.count) {
            SLI_PREFETCH(p + r->rows[k + SLI_RESTRICT_AHEAD], 0);
        }
        if (p[j] < 0 || p[j + 1] < p[j] || p[j + 1] > sli_nnz(r->A)) {
            return sli_fail_at(stats, SL_ERR_PATTERN, -1, j, 0.0);
        }
        own += r->number_of[k] == -1 ? 0 : (uint64_t)(p[j + 1] - p[j]);
        *sli_restriction_bits(r, j) |= (uint32_t)1 << (j % 32);
    }
    entries += own;
    if (entries > INT32_MAX) {   /* untested: 2^31 entries */
        return SL_ERR_TOO_LARGE; /* untested: the same */
    }
    for (pass = 0; pass < 2 && status == SL_OK; pass++) {
        r->below_begin = SLI_TAKE(&b, sl_off, (uint64_t)r->n_kept + 1);
        r->below = SLI_TAKE(&b, sl_int, rows);
        r->entry_row = SLI_TAKE(&b, sl_int, entries);
        r->entry_column = SLI_TAKE(&b, sl_int, entries);
        r->entry_from = SLI_TAKE(&b, sl_int, entries);
        r->B_begin = SLI_TAKE(&b, sl_int, (uint64_t)r->R.count + 1);
        r->B_rows = SLI_TAKE(&b, sl_int, own);
        r->B_values = SLI_TAKE(&b, double, own);
        status = pass == 0 ? sli_block_alloc(&b, a) : SL_OK;
    }
    r->blocks[1] = b.base;
    r->B.n_rows = r->A->n_rows;
    r->B.n_cols = r->R.count;
    r->B.p = r->B_begin;
    r->B.i = r->B_rows;
    r->B.x = r->B_values;
    return status;
}

/* Sorts the entries of the graph by rows and by columns. */
static void sli_restriction_sort(sli_restriction *r) {
    sli_pattern *rows = &r->w.rows, *columns = &r->w.columns;
    const size_t bytes = ((size_t)r->n_fresh + 1) * sizeof(sl_int);
    sl_int e;
    memset(rows->begin, 0, bytes);
    memset(columns->begin, 0, bytes);
    for (e = 0; e < r->n_entries; e++) {
        rows->begin[r->entry_row[e]]++;
        columns->begin[r->entry_column[e]]++;
    }
    sli_pattern_starts(rows, r->n_fresh, rows->begin, 1, 0);
    sli_pattern_starts(columns, r->n_fresh, columns->begin, 1, 0);
    for (e = 0; e < r->n_entries; e++) { /* each begin advances to its end; shifted back below */
        const sl_int at = rows->begin[r->entry_row[e]]++;
        rows->to[at] = r->entry_column[e];
        rows->from[at] = r->entry_from[e];
        columns->to[columns->begin[r->entry_column[e]]++] = r->entry_row[e];
    }
    memmove(rows->begin + 1, rows->begin, bytes - sizeof(sl_int));
    memmove(columns->begin + 1, columns->begin, bytes - sizeof(sl_int));
    rows->begin[0] = columns->begin[0] = 0;
}

/* Finds the supernodes of the new columns. */
static sl_status sli_restriction_tree(sli_restriction *r, const sl_allocator *a, sl_stats *stats) {
    sl_options given = sli_options_with(a);
    sli_block b = {NULL, 0, 0};
    sl_status status = SL_OK;
    int pass;
    for (pass = 0; pass < 2 && status == SL_OK; pass++) {
        sli_analysis_layout(&r->w, &b, r->n_fresh, r->n_entries);
        status = pass == 0 ? sli_block_alloc(&b, a) : SL_OK;
    }
    r->blocks[2] = b.base;
    if (status == SL_OK) {
        sli_restriction_sort(r);
        given.ordering = SL_ORDERING_GIVEN;
        given.relaxation = r->relaxation;
        sli_analyze_tree(&r->w, &given, stats);
    }
    return status;
}

/* Finds the supernodes of the new columns and their structure. */
static sl_status sli_restriction_analyze(sli_restriction *r, const sl_allocator *a,
                                         sl_stats *stats) {
    sli_analysis *w = &r->w;
    sl_symbolic *T = &r->T;
    sli_block b = {NULL, 0, 0};
    sl_status status = sli_restriction_tree(r, a, stats);
    uint64_t rows = 0;
    sl_int t;
    int pass;
    if (status != SL_OK) {
        return status;
    }
    T->n = r->n_fresh;
    T->n_supers = w->amalgamation.count;
    T->super_of = w->super_of;
    T->super_first = w->amalgamation.first;
    T->super_parent = w->amalgamation.parent;
    for (t = 0; t < T->n_supers; t++) {
        rows += (uint64_t)w->amalgamation.below[t];
    }
    memset(&b, 0, sizeof b);
    for (pass = 0; pass < 2 && status == SL_OK; pass++) {
        T->rows_begin = SLI_TAKE(&b, sl_off, (uint64_t)T->n_supers + 1);
        T->rows = SLI_TAKE(&b, sl_int, rows);
        T->relative = SLI_TAKE(&b, sl_int, rows);
        T->panel_begin = SLI_TAKE(&b, sl_off, (uint64_t)T->n_supers + 1);
        T->scatter_begin = SLI_TAKE(&b, sl_off, (uint64_t)T->n_supers + 1);
        T->scatter_from = SLI_TAKE(&b, sl_int, r->n_entries);
        T->scatter_to = SLI_TAKE(&b, sl_off, r->n_entries);
        r->T_new = SLI_TAKE(&b, sl_int, T->n_supers);
        r->head = SLI_TAKE(&b, sl_int, (uint64_t)T->n_supers + 1);
        status = pass == 0 ? sli_block_alloc(&b, a) : SL_OK;
    }
    r->blocks[3] = b.base;
    if (status != SL_OK) {
        return status;
    }
    T->rows_begin[0] = T->panel_begin[0] = 0;
    for (t = 0; t < T->n_supers; t++) {
        const sl_int below = w->amalgamation.below[t];
        T->rows_begin[t + 1] = T->rows_begin[t] + below;
        T->panel_begin[t + 1] = T->panel_begin[t] + sli_panel_size(w->amalgamation.width[t], below);
    }
    sli_fill_structure(w, T, NULL);
    return SL_OK;
}

/* Describes R: its kept supernodes and new columns. r has S, A, rows and the count of R. */
static sl_status sli_restriction_begin(sli_restriction *r, const sl_allocator *a, sl_stats *stats) {
    const uint64_t count = (uint64_t)r->R.count;
    sli_block b = {NULL, 0, 0};
    sl_status status = SL_OK;
    int pass;
    /* a bit for each row of A, where R is not small: then from 128 bits for a row of R on */
    while (r->bits_mask < count * 4 && r->bits_mask < (uint32_t)r->S->n / 32) {
        r->bits_mask = 2 * r->bits_mask + 1;
    }
    for (pass = 0; pass < 2 && status == SL_OK; pass++) {
        sli_subset_layout(&r->R, &b, r->S->n);
        r->list = SLI_TAKE(&b, uint64_t, count);
        r->scratch = SLI_TAKE(&b, uint64_t, count);
        r->kept = SLI_TAKE(&b, sl_int, count);
        r->first_rank = SLI_TAKE(&b, sl_int, count);
        r->kept_new = SLI_TAKE(&b, sl_int, count);
        r->next = SLI_TAKE(&b, sl_int, count);
        r->limit = SLI_TAKE(&b, sl_int, count);
        r->number_of = SLI_TAKE(&b, sl_int, count);
        r->bits = SLI_TAKE(&b, uint32_t, (uint64_t)r->bits_mask + 1);
        r->fresh = SLI_TAKE(&b, sl_int, count);
        r->fresh_of = SLI_TAKE(&b, sl_int, count);
        r->column_of = SLI_TAKE(&b, sl_int, count);
        status = pass == 0 ? sli_block_alloc(&b, a) : SL_OK;
    }
    r->blocks[0] = b.base;
    status = status == SL_OK ? sli_subset_fill(&r->R, r->S, r->rows, r->list, r->scratch, stats)
                             : status;
    if (status == SL_OK) {
        sli_restriction_split(r);
    }
    return status;
}

/* Lists the entries of the new columns and what is left of the kept ones. */
static sl_status sli_restriction_list(sli_restriction *r, const sl_allocator *a, sl_stats *stats) {
    const sl_status status = sli_restriction_room(r, a, stats);
    if (status != SL_OK) {
        return status;
    }
    sli_restriction_filter(r);
    return sli_restriction_graph(r, stats);
}

#endif

/* submatrix_kept.h: a set R of rows of A, and what the analysis of A[R, R] keeps of that of A */
#ifndef SLI_EDIT_SUBMATRIX_KEPT_H
#define SLI_EDIT_SUBMATRIX_KEPT_H

#include "../analysis/symbolic_build.h"
#include "subset.h"

/* Below this share of kept columns none is kept. Bands, checkerboards and random rows of which 36
 * to 42 % are kept take as long with as without it. */
#define SLI_RESTRICT_KEPT 0.4

/* Rows of R are scattered in memory: so many ahead they are fetched. */
#define SLI_RESTRICT_AHEAD 16

/* From one row in so many on an array by rows of A finds the new columns. It takes a bit for each
 * bit that would filter the rows. */
#define SLI_RESTRICT_MANY 32

/* From one row in so many on the values of A are read in place. Of fewer rows they are so far apart
 * that it takes longer to read them in the order of L than to copy them before. */
#define SLI_RESTRICT_IN_PLACE 3

/* If a supernode of A and all its descendants are in R, L has the same numbers in A and in A[R, R],
 * without the rows that are not in R. These kept supernodes are whole subtrees. All other columns
 * of R are analyzed again. Their graph has the entries of A between them and, for each subtree, a
 * clique of the rows below it, which are new columns: its Schur complement. A clique is given as
 * the entries of its first row, as elimination of that row completes it.
 *
 * Columns of R have three numberings: the rank in L of A, the order of the new columns, and the
 * final one. [HA18] */
typedef struct sli_restriction {
    const sl_symbolic *S; /* of A */
    const sl_csc *A;
    const sl_int *rows; /* those of A, in the caller's order */
    int may_keep;       /* 0: nothing is kept */
    sli_subset R;
    uint64_t *list, *scratch; /* count each; finally list has where rows of A begin and end */
    sl_int *number_of;        /* count: first the rank, then the new column or -1, by row of R */
    sl_int *number_at;        /* the same by rows of A, where R is not small; else NULL */
    uint32_t *bits;           /* bits_mask + 1: there, a filter of R by rows of A */
    uint32_t bits_mask;

    sl_int n_kept;
    sl_int *kept;       /* n_kept: supernodes of A, ascending */
    sl_int *first_rank; /* n_kept: of the first column */
    sl_int *kept_new;   /* n_kept: the final number */
    sl_int *next;       /* n_kept: the next root in a list of subtrees */
    sl_int *limit;      /* n_kept: where the columns of A of its subtree end */
    sl_int n_fresh;
    sl_int *fresh;    /* n_fresh: the ranks of the new columns */
    sl_int *fresh_of; /* count: the number of the new column, or -1, if anything is kept */

    sl_off *below_begin; /* n_kept + 1 */
    sl_int *below;       /* below_begin[n_kept]: the rows of R below each supernode, as ranks */
    sl_relaxation relaxation;
    sl_int n_entries; /* of the graph of new columns: one triangle */
    sl_int *entry_row, *entry_column;
    sl_int *entry_from; /* position in A or B; -1: of a clique; until the tree is found */
    /* if B_values is not NULL, B is a copy of the entries of A in the graph, by the columns of the
     * caller's order */
    sl_csc B;
    sl_int *B_begin, *B_rows;
    double *B_values;

    sli_analysis w;       /* of the new columns */
    sl_symbolic T;        /* the same, not renumbered yet; only its structure is filled */
    sl_int *T_new, *head; /* supernodes of T: the final number, the list of subtrees below */
    sl_int *column_of;    /* count: the final column of a rank */
    sl_off copied;        /* doubles of L that were copied */
    void *blocks[6];      /* memory of the arrays: by count, of what is kept, w, T, rows below, B */
} sli_restriction;

static void sli_restriction_free(sli_restriction *r, const sl_allocator *a) {
    int k;
    for (k = 0; k < 6; k++) {
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
SLI_HOT static void sli_restriction_split(sli_restriction *r) {
    const sl_symbolic *S = r->S;
    const sl_int *columns = r->R.columns;
    const sl_int most = (sl_int)((1.0 - SLI_RESTRICT_KEPT) * r->R.count);
    sl_int k = 0, q;
    r->n_fresh = 0;
    while (k < r->R.count && r->n_fresh <= most) {
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
    if (r->n_fresh > most) {
        r->n_kept = 0;
        r->n_fresh = r->R.count;
    }
    for (q = r->n_kept - 1; q >= 0; q--) { /* a parent that is kept has the distance it has in A */
        const sl_int s = r->kept[q], up = S->super_parent[s];
        const sl_int at = up == -1 ? r->n_kept : q + up - s;
        r->limit[q] = at < r->n_kept && r->kept[at] == up ? r->limit[at] : S->super_first[s + 1];
    }
}

/* Lists the rows below the kept supernodes that are in R. The columns of a subtree have consecutive
 * ranks. */
SLI_HOT static sl_status sli_restriction_filter(sli_restriction *r, const sl_allocator *a) {
    const sl_symbolic *S = r->S;
    sli_block b = {NULL, 0};
    sl_status status = SL_OK;
    uint64_t rows = 0;
    sl_off at = 0, p;
    sl_int q;
    for (q = 0; q < r->n_kept; q++) {
        rows += (uint64_t)(S->rows_begin[r->kept[q] + 1] - S->rows_begin[r->kept[q]]);
    }
    SLI_LAYOUT(&b, a, status) {
        r->below_begin = SLI_TAKE(&b, sl_off, (uint64_t)r->n_kept + 1);
        r->below = SLI_TAKE(&b, sl_int, rows);
    }
    r->blocks[4] = b.base;
    if (status != SL_OK) {
        return status;
    }
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
    return SL_OK;
}

/* Describes R: its kept supernodes and new columns. r has S, A, rows and the count of R. */
static sl_status sli_restriction_begin(sli_restriction *r, const sl_allocator *a, sl_stats *stats) {
    const uint64_t count = (uint64_t)r->R.count;
    const int is_many = r->R.count >= r->S->n / SLI_RESTRICT_MANY;
    sli_block b = {NULL, 0}, kept = {NULL, 0};
    sl_status status = SL_OK;
    /* a bit for each row of A, where R is not small: then from 128 bits for a row of R on */
    while (!is_many && r->bits_mask < count * 4 && r->bits_mask < (uint32_t)r->S->n / 32) {
        r->bits_mask = 2 * r->bits_mask + 1;
    }
    SLI_LAYOUT(&b, a, status) {
        sli_subset_layout(&r->R, &b, r->S->n);
        r->list = r->R.list;
        r->scratch = r->R.scratch;
        r->number_of = SLI_TAKE(&b, sl_int, count);
        r->bits = SLI_TAKE(&b, uint32_t, (uint64_t)r->bits_mask + 1);
        r->number_at = is_many ? SLI_TAKE(&b, sl_int, r->S->n) : NULL;
    }
    r->blocks[0] = b.base;
    r->n_fresh = r->R.count;
    status = status == SL_OK ? sli_subset_fill(&r->R, r->S, r->rows, r->number_of, stats) : status;
    if (status != SL_OK || !r->may_keep || !sli_restriction_has_runs(r)) {
        return status;
    }
    SLI_LAYOUT(&kept, a, status) {
        r->kept = SLI_TAKE(&kept, sl_int, count);
        r->first_rank = SLI_TAKE(&kept, sl_int, count);
        r->kept_new = SLI_TAKE(&kept, sl_int, count);
        r->next = SLI_TAKE(&kept, sl_int, count);
        r->limit = SLI_TAKE(&kept, sl_int, count);
        r->fresh = SLI_TAKE(&kept, sl_int, count);
        r->fresh_of = SLI_TAKE(&kept, sl_int, count);
        r->column_of = SLI_TAKE(&kept, sl_int, count);
    }
    r->blocks[1] = kept.base;
    if (status == SL_OK) {
        sli_restriction_split(r);
    }
    return status;
}

#endif

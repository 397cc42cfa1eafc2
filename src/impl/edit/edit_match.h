/* edit_match.h: which rows of an edited matrix have other neighbors than before */
#ifndef SLI_EDIT_MATCH_H
#define SLI_EDIT_MATCH_H

#include "../analysis/symbolic.h"
#include "../factor/factor_types.h"

/* A matrix A with its analysis S, the edited matrix B, and how S changes. A node is a supernode of
 * S; node S->n_supers is above all roots. A row of B is active if it is new, or if its neighbors
 * are not those that it had in A. Supernodes without an active row in their subtree are kept. */
typedef struct sli_edit {
    const sl_symbolic *S;
    const sl_csc *A, *B;
    const sl_int *new_of;      /* rows of A: the row of B, or -1 */
    sl_triangle triangle;      /* the one of B that is read */
    sl_int n;                  /* rows of B */
    sl_int *column_of;         /* n: the column of L in S, or -1 for a new row */
    sl_int *node;              /* n: where the row is; -1: not placed yet, or in no subtree of S */
    sl_int *number;            /* n: the position in a list of rows, or -1 */
    unsigned char *is_active;  /* n: 1; rows up to two edges away: 2, 3; 0: others */
    unsigned char *is_matched; /* entries of B: the same entry is in A */
    sl_int *position;          /* entries of A that are read: their position in B; negative: none */
    sl_int *cursor, *waiting;  /* n: scratch of the matching */

    sl_int n_changed; /* active rows */
    sl_int n_near;
    sl_int *around; /* n_near rows: those with is_active > 0; room for n */
    sl_off *begin;  /* n_near + 1: their neighbors */
    sl_int *to;
    uint64_t *list, *scratch; /* n_near each */
    int is_join;              /* of sli_edit_lowest: a common ancestor, not one of the nodes */
    sl_off steps;             /* steps of searches that are still allowed */

    unsigned char *mark; /* n_supers + 1: SLI_NODE_* */
    sl_int *weight;      /* n_supers + 1: active rows in the subtree */
    sl_int *head, *next; /* n_supers + 1, n: rows that were moved to each node */
    sl_int n_grouped;    /* rows that get a new order: they come first in fresh */
    sl_int n_fresh;
    sl_int *fresh;   /* n_fresh: rows whose columns are analyzed again, in their order */
    sl_int moved;    /* rows that moved to another node */
    void *blocks[3]; /* memory of the arrays: by n, by near rows, neighbors */
} sli_edit;

/* The largest is_active. */
#define SLI_EDIT_LAYERS 3

enum { SLI_NODE_KEPT = 0, SLI_NODE_FRESH, SLI_NODE_GROUPED };

static void sli_edit_layout(sli_edit *e, sli_block *b) {
    const uint64_t n = (uint64_t)e->n, supers = (uint64_t)e->S->n_supers;
    e->column_of = SLI_TAKE(b, sl_int, n);
    e->node = SLI_TAKE(b, sl_int, n);
    e->number = SLI_TAKE(b, sl_int, n);
    e->is_active = SLI_TAKE(b, unsigned char, n);
    e->is_matched = SLI_TAKE(b, unsigned char, sli_nnz(e->B));
    e->position = SLI_TAKE(b, sl_int, sli_nnz(e->A));
    e->cursor = SLI_TAKE(b, sl_int, n);
    e->waiting = SLI_TAKE(b, sl_int, n);
    e->mark = SLI_TAKE(b, unsigned char, supers + 1);
    e->weight = SLI_TAKE(b, sl_int, supers + 1);
    e->head = SLI_TAKE(b, sl_int, supers + 1);
    e->next = SLI_TAKE(b, sl_int, n);
    e->around = SLI_TAKE(b, sl_int, n);
    e->fresh = SLI_TAKE(b, sl_int, n);
}

/* The columns of S of the n rows of B, -1 for new ones. Refuses a row of B that is out of range or
 * given twice. */
static sl_status sli_edit_columns(const sl_symbolic *S, const sl_int *new_of, sl_int n,
                                  sl_int *column_of, sl_stats *stats) {
    sl_int j;
    SLI_NONE(column_of, n);
    for (j = 0; j < S->n; j++) {
        const sl_int row = new_of[j];
        if (row < -1 || row >= n || (row >= 0 && column_of[row] != -1)) {
            return sli_fail_at(stats, SL_ERR_ARGUMENT, j, -1, (double)row,
                               "new_of of this row, value, is out of range or given twice");
        }
        if (row >= 0) {
            column_of[row] = S->iperm[j];
        }
    }
    return SL_OK;
}

/* Finds the column and node of each row. */
static sl_status sli_edit_rows(sli_edit *e, sl_stats *stats) {
    const sl_symbolic *S = e->S;
    const sl_status status = sli_edit_columns(S, e->new_of, e->n, e->column_of, stats);
    sl_int j;
    if (status != SL_OK) {
        return status;
    }
    memset(e->mark, SLI_NODE_KEPT, (size_t)S->n_supers + 1);
    for (j = 0; j < S->n; j++) {
        if (e->new_of[j] == -1) {
            e->mark[S->super_of[S->iperm[j]]] = SLI_NODE_FRESH;
        }
    }
    for (j = 0; j < e->n; j++) {
        e->node[j] = e->column_of[j] == -1 ? -1 : S->super_of[e->column_of[j]];
        e->is_active[j] = e->column_of[j] == -1;
    }
    return SL_OK;
}

/* A match is looked for among so many entries from the last one of its column on; the rest waits
 * for sli_edit_match_column. */
#define SLI_EDIT_AHEAD 12

/* Entries of A that were not found wait in a list of their column of B, whose links are stored as
 * negative positions. */
#define SLI_EDIT_LAST INT32_MIN

SLI_INLINE sl_int sli_edit_link(sl_int p) { /* its own inverse */
    return -1 - p;
}

/* The column and row of B that hold the entry of two rows. Returns 0 if B reads none there. */
SLI_INLINE int sli_edit_place(const sli_edit *e, sl_int i, sl_int j, sl_int *row, sl_int *column) {
    const int is_upper = e->triangle == SL_TRIANGLE_UPPER;
    *row = is_upper ? sli_min(i, j) : sli_max(i, j);
    *column = is_upper ? sli_max(i, j) : sli_min(i, j);
    return i == j || e->triangle != SL_TRIANGLE_NONE;
}

SLI_INLINE void sli_edit_activate(sli_edit *e, sl_int row) {
    if (row != -1) {
        e->is_active[row] = 1;
    }
}

/* Finds the entries of column j of A that B has where they are expected. */
static void sli_edit_match_ahead(sli_edit *e, sl_int j) {
    const sl_csc *A = e->A, *B = e->B;
    const sl_triangle triangle = e->S->stats.symbolic.triangle;
    const sl_int own = e->new_of[j];
    sl_int p, row, column;
    for (p = A->p[j]; p < A->p[j + 1]; p++) {
        const sl_int other = e->new_of[A->i[p]];
        e->position[p] = -1;
        if (!sli_is_read(triangle, A->i[p], j)) {
            continue;
        }
        if (own != -1 && other != -1 && sli_edit_place(e, own, other, &row, &column)) {
            sl_int q = e->cursor[column];
            const sl_int end = sli_min(q + SLI_EDIT_AHEAD, B->p[column + 1]);
            while (q < end && B->i[q] != row) {
                q++;
            }
            if (q < end) {
                e->position[p] = q;
                e->is_matched[q] = 1;
                e->cursor[column] = q + 1;
            } else {
                e->position[p] = e->waiting[column];
                e->waiting[column] = sli_edit_link(p);
            }
        } else {
            sli_edit_activate(e, own);
            sli_edit_activate(e, other);
        }
    }
}

/* Finds the entries that wait for a column of B among those of it that are not matched. where: 0
 * for each row. */
static void sli_edit_match_waiting(sli_edit *e, sl_int column, sl_int *where) {
    const sl_csc *B = e->B;
    sl_int q, link = e->waiting[column];
    for (q = B->p[column + 1] - 1; q >= B->p[column]; q--) {
        where[B->i[q]] = e->is_matched[q] ? where[B->i[q]] : q + 1;
    }
    while (link != SLI_EDIT_LAST) {
        const sl_int p = sli_edit_link(link), next = e->position[p];
        const sl_int i = e->new_of[e->A->i[p]];
        const sl_int row = i != column ? i : e->new_of[sli_column_of(e->A, p)];
        e->position[p] = where[row] - 1;
        if (where[row] != 0) {
            e->is_matched[where[row] - 1] = 1;
            where[row] = 0;
        } else {
            sli_edit_activate(e, row);
            sli_edit_activate(e, column);
        }
        link = next;
    }
    for (q = B->p[column]; q < B->p[column + 1]; q++) {
        where[B->i[q]] = 0;
    }
}

/* Matches the entries of both matrices and finds the active rows. */
static void sli_edit_match(sli_edit *e) {
    const sl_csc *A = e->A, *B = e->B;
    sl_int j, q, *where = e->number;
    for (j = 0; j < e->n; j++) {
        e->cursor[j] = B->p[j];
        e->waiting[j] = SLI_EDIT_LAST;
        where[j] = 0;
    }
    SLI_ZERO(e->is_matched, sli_nnz(B));
    for (j = 0; j < A->n_cols; j++) {
        sli_edit_match_ahead(e, j);
    }
    for (j = 0; j < e->n; j++) {
        if (e->waiting[j] != SLI_EDIT_LAST) {
            sli_edit_match_waiting(e, j, where);
        }
    }
    for (j = 0; j < e->n; j++) {
        for (q = B->p[j]; q < B->p[j + 1]; q++) {
            if (!e->is_matched[q] && sli_is_read(e->triangle, B->i[q], j)) {
                e->is_active[B->i[q]] = e->is_active[j] = 1;
            }
        }
    }
}

#endif

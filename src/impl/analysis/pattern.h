/* pattern.h: the scratch of the analysis; the lower triangle of P A P', by ranges of entries */
#ifndef SLI_ANALYSIS_PATTERN_H
#define SLI_ANALYSIS_PATTERN_H

#include "../ordering/order.h"
#include "supernodes.h"

/* Scratch of the analysis. Rows have three numberings: that of A; the order found or given, used
 * by columns and perm; and the final postorder of supernodes, used by everything else. */
typedef struct sli_analysis {
    sl_int n;
    sl_int workers; /* 0: one */
    sli_team *team; /* NULL: one worker */
    const sl_options *opt;
    sl_stats *found;
    int keeps_order; /* the caller's; is_in_order: the columns need no postorder */
    int is_in_order;
    const sl_symbolic *S; /* the object that is filled */
    double clock;         /* when it was last read */
    int64_t clock_entries;
    const sl_csc *A;
    sli_hash pattern; /* of A */
    sl_int *column;   /* nnz or n + 1: of each entry of A; sli_structure_sort changes them */
    sl_int side;      /* an entry of A is read if side (row - column) >= 0; 0: all are */
    sli_pattern columns;
    sli_amalgamation amalgamation;
    sl_int *perm;                       /* n: the order found or given */
    sli_order_choice choice;            /* n: another order */
    sl_int *old_of, *new_of;            /* n: from the last numbering to the one before, and back */
    sl_int *parent, *counts, *super_of; /* n each */
    sl_int *scratch;                    /* 5n */
    sl_int *room;   /* SLI_ANALYSIS_ROOM for each worker; the memory of the next two, too */
    uint64_t *list; /* 2n: tree and supernodes, with four arrays of these */
    struct sli_structure_super *supers; /* n: the rows of the supernodes */
    /* n: is the row in this position of perm the first of a 2x2 pivot? NULL: there are none */
    const unsigned char *pairs;
    unsigned char *is_first; /* n: the same, by column */
    sl_int *earlier;         /* n: the part before each supernode, if it was split, or -1 */
    sli_septree septree;     /* n each: by rows of A */
    size_t ordered;          /* bytes of the block that hold what the ordering fills */
    sl_int *moved;           /* nnz: rows of the entries of A in P A P' */
    sl_int *spare;           /* 3 for each entry: the ordering, rows, entries by rows */
} sli_analysis;

/* The memory of one worker, in sl_int. */
#define SLI_ANALYSIS_ROOM(n) ((uint64_t)(n) + 16)

/* Counts a range of entries: turns the column of each into that in P A P', or n if it is not
 * read, and keeps its row. */
SLI_ALWAYS_INLINE void sli_pattern_count(const sli_analysis *w, const sli_range *r, sl_int *at,
                                         sl_int side) {
    const sl_int *row = w->A->i, *iperm = w->scratch, n = w->n;
    sl_int *column = w->column, *moved = w->moved, p;
    for (p = r->first; p < r->last; p++) {
        const sl_int a = iperm[row[p]], b = iperm[column[p]], k = sli_min(a, b);
        const sl_int to = /* branches untested: 0 is constant in a copy */
            side * (row[p] - column[p]) >= 0 ? k : n; /* branches untested: the same */
        moved[p] = a + b - k;
        column[p] = to;
        at[to]++;
    }
}

static void sli_pattern_count_item(void *data, const sli_range *r) {
    const sli_analysis *w = (const sli_analysis *)data;
    sl_int *at = w->room + (uint64_t)r->item * SLI_ANALYSIS_ROOM(w->n);
    SLI_ZERO(at, w->n + 1);
    if (w->side == 0) { /* a copy for this case has half of the operations */
        sli_pattern_count(w, r, at, 0);
    } else {
        sli_pattern_count(w, r, at, w->side);
    }
}

static void sli_pattern_fill_item(void *data, const sli_range *r) {
    const sli_analysis *w = (const sli_analysis *)data;
    const sl_int *column = w->column, *moved = w->moved;
    sl_int *at = w->room + (uint64_t)r->item * SLI_ANALYSIS_ROOM(w->n), p;
    for (p = r->first; p < r->last; p++) {
        sl_int *entry = w->columns.entry + SLI_ENTRY * (size_t)at[column[p]]++;
        entry[0] = moved[p];
        entry[1] = p;
    }
}

/* Fills the lower triangle of P A P', so that later passes walk it in elimination order. It is a
 * counting sort. Each range has counters of its own. scratch gets the inverse of perm. */
static void sli_pattern_fill(sli_analysis *w) {
    const sl_int ranges = sli_max(w->workers, 1), nnz = sli_nnz(w->A);
    sl_int r, unread;
    for (r = 0; r < w->n; r++) {
        w->scratch[w->perm[r]] = r;
    }
    /* Tree and supernodes fill 7 n elements from parent on later: pages are touched once. */
    w->moved = w->choice.has_tree || nnz / 7 >= w->n ? w->spare : w->parent;
    sli_range_run(w->team, nnz, ranges, sli_pattern_count_item, w);
    sli_pattern_starts(&w->columns, w->n, w->room, ranges, (size_t)SLI_ANALYSIS_ROOM(w->n));
    unread = w->columns.begin[w->n];
    for (r = 0; r < ranges; r++) {
        sl_int *at = w->room + (uint64_t)r * SLI_ANALYSIS_ROOM(w->n) + w->n;
        unread += *at;
        *at = unread - *at;
    }
    sli_range_run(w->team, nnz, ranges, sli_pattern_fill_item, w);
}

#endif

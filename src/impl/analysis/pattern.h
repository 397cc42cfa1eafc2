/* pattern.h: the scratch of the analysis; both triangles of P A P', by ranges of entries */
#ifndef SLI_ANALYSIS_PATTERN_H
#define SLI_ANALYSIS_PATTERN_H

#include "../ordering/order.h"
#include "supernodes.h"

/* A supernode while rows of L are added to it. */
typedef struct sli_growing {
    sl_off base;  /* rows and relative have local row r at base + r */
    /* where tile 0 and column 0 of A would be in L if all tiles had all columns */
    sl_off panel;
    sl_off to;    /* the next position in the scatter map */
    sl_int width;
    sl_int local;  /* local rows so far: the columns, then the rows below */
    sl_int mark;   /* the last row that was added */
    sl_int parent; /* -1 at a root */
} sli_growing;

#define SLI_ANALYSIS_RUNS 64

/* Scratch of the analysis. Rows have three numberings: that of A; the order found or given, used
 * by rows, columns and perm; and the final postorder of supernodes, used by everything else. */
typedef struct sli_analysis {
    sl_int n;
    sl_int workers; /* 0: one */
    double clock;   /* when it was last read */
    const sl_csc *A;
    sli_hash pattern; /* of A */
    sl_int *column;   /* nnz: of each entry of A */
    sl_int side;      /* an entry of A is read if side (row - column) >= 0 */
    sli_pattern rows, columns;
    sli_amalgamation amalgamation;
    sl_int *perm;                       /* n: the order found or given */
    sli_order_choice choice;            /* n: another order */
    sl_int *old_of, *new_of;            /* n: from the last numbering to the one before, and back */
    sl_int *parent, *counts, *super_of; /* n each */
    sl_int *scratch;                    /* 5n */
    uint64_t *list;                     /* 2n */
    sli_growing *growing;               /* n, later, in the memory of list and others */
    /* n: is the row in this position of perm the first of a 2x2 pivot? NULL: there are none */
    const unsigned char *pairs;
    unsigned char *is_first; /* n: the same, by column */
    sl_int *earlier;         /* n: the part before each supernode, if it was split, or -1 */
    sli_septree septree;     /* n each: by rows of A */
    size_t ordered;          /* bytes of the block that hold what the ordering fills */
    sl_int *spare;           /* 3 for each entry: for the ordering, then lists of rows */
    sl_symbolic *S;          /* what is filled, by runs of supernodes, in descending order */
    sl_int n_runs, first[SLI_ANALYSIS_RUNS], last[SLI_ANALYSIS_RUNS];
} sli_analysis;

/* Counts or fills the range of entries of one worker. */
static void sli_pattern_range(const sli_analysis *w, sl_int r, int is_counted) {
    const sl_int *row = w->A->i, *column = w->column, *iperm = w->scratch, side = w->side;
    const sl_int ranges = sli_max(w->workers, 1);
    const sl_int end = (sl_int)((int64_t)sli_nnz(w->A) * (r + 1) / ranges);
    sl_int *row_at = (sl_int *)(void *)w->growing + 2 * (size_t)r * (size_t)w->n;
    sl_int *column_at = row_at + w->n, p = (sl_int)((int64_t)sli_nnz(w->A) * r / ranges);
    if (!is_counted) {
        memset(row_at, 0, 2 * (size_t)w->n * sizeof(sl_int));
    }
    for (; p < end && !is_counted; p++) {
        const sl_int a = iperm[row[p]], b = iperm[column[p]], k = sli_max(a, b);
        const int is_read = side * (row[p] - column[p]) >= 0;
        row_at[k] += is_read;
        column_at[a + b - k] += is_read;
    }
    for (; p < end; p++) {
        if (side * (row[p] - column[p]) >= 0) {
            const sl_int a = iperm[row[p]], b = iperm[column[p]], k = sli_max(a, b);
            const sl_int i = a + b - k, at = row_at[k]++;
            w->rows.to[at] = i;
            w->rows.from[at] = p;
            w->columns.to[column_at[i]++] = k;
        }
    }
}

static void sli_pattern_count_item(void *data, sl_int r, sl_int worker) {
    (void)worker;
    sli_pattern_range((const sli_analysis *)data, r, 0);
}

static void sli_pattern_fill_item(void *data, sl_int r, sl_int worker) {
    (void)worker;
    sli_pattern_range((const sli_analysis *)data, r, 1);
}

/* Fills both triangles of P A P': rows (row k holds the columns up to k and their positions in A)
 * and columns (column k holds the rows from k on). Later passes walk them in elimination order, and
 * each pass reads only the triangle that it needs. It is a counting sort. Each range has counters
 * of its own: n of rows and n of columns. scratch: the inverse of perm. */
static void sli_pattern_fill(sli_analysis *w, sl_triangle triangle, sli_team *team) {
    const sl_int ranges = sli_max(w->workers, 1);
    sl_int *at = (sl_int *)(void *)w->growing;
    w->side = triangle == SL_TRIANGLE_NONE ? 0 : triangle == SL_TRIANGLE_UPPER ? -1 : 1;
    sli_team_loop(team, ranges, NULL, sli_pattern_count_item, w);
    sli_pattern_starts(&w->rows, w->n, at, ranges, 2 * (size_t)w->n);
    sli_pattern_starts(&w->columns, w->n, at + w->n, ranges, 2 * (size_t)w->n);
    sli_team_loop(team, ranges, NULL, sli_pattern_fill_item, w);
}

#endif

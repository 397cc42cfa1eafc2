/* entries_calls.h: calls for entries and diagonals of A^-1 */
#ifndef SLI_INVERSE_ENTRIES_CALLS_H
#define SLI_INVERSE_ENTRIES_CALLS_H

#include "entries.h"
#include "column.h"

/* Checks and runs a call. */
static sl_status sli_inverse_entries(sli_entries *q, sl_work *W, sl_stats *stats) {
    const sli_requests *r = &q->requests;
    sl_work own;
    sl_status status;
    status = sli_argument(r->count < 0                     ? "count is below 0"
                          : r->count > 0 && q->out == NULL ? "out is NULL"
                                                           : NULL);
    if (status == SL_OK) {
        status = sli_check_entries(q->F, r->rows, r->count, r->columns, r->count, stats);
    }
    if (status != SL_OK) {
        return sli_report(stats, status);
    }
    sli_inverse_clear_stats(stats);
    own = sli_work_own(&q->F->allocator);
    status = r->count > 0 ? sli_entries_run(q, W == NULL ? &own : W, stats) : SL_OK;
    sli_free(&own.allocator, own.block);
    return sli_report(stats, status);
}

SL_API sl_status sl_inverse_diagonal(const sl_factor *F, double *out, const sl_int *rows,
                                     sl_int count, sl_work *W, sl_stats *stats) {
    sl_status status;
    sli_entries q;
    sli_stats_clear_error(stats);
    status = F == NULL ? sli_argument("F is NULL") : sli_list(&rows, &count, F->S->n);
    if (status != SL_OK) {
        return sli_report(stats, status);
    }
    q = sli_entries_of(F, out, rows, rows, count);
    return sli_inverse_entries(&q, W, stats);
}

/* A forward sweep of two lanes over an entry of L, relative to one lane, as it was measured for
 * single pairs on grids of 900 to 5e5 rows; and the entries from which L comes from memory. */
#define SLI_PAIR_CACHED 1.7
#define SLI_PAIR_READ 1.25
#define SLI_PAIR_LARGE 5e5

/* Is the entry of two columns cheaper by a forward and a backward sweep of one lane than by one
 * forward sweep of two? That has the columns of both paths once. */
static int sli_entry_is_local(const sl_symbolic *S, sl_int a, sl_int b) {
    sl_int s = S->super_of[a], t = S->super_of[b];
    double apart = 0.0, common = 0.0;
    while (s != t) { /* -1, the end of a path, is the largest */
        sl_int *first = (uint32_t)s < (uint32_t)t ? &s : &t;
        apart += (double)(S->panel_begin[*first + 1] - S->panel_begin[*first]);
        *first = S->super_parent[*first];
    }
    for (; s != -1; s = S->super_parent[s]) {
        common += (double)(S->panel_begin[s + 1] - S->panel_begin[s]);
    }
    return apart + 2.0 * common <
           (apart + common < SLI_PAIR_LARGE ? SLI_PAIR_CACHED : SLI_PAIR_READ) * (apart + common);
}

SL_API sl_status sl_inverse_pairs(const sl_factor *F, double *out, const sl_int *rows,
                                  const sl_int *columns, sl_int count, sl_work *W,
                                  sl_stats *stats) {
    sli_entries q;
    sli_stats_clear_error(stats);
    if (F == NULL || (count > 0 && (rows == NULL || columns == NULL))) {
        return sli_report(stats, sli_argument(F == NULL      ? "F is NULL"
                                              : rows == NULL ? "rows is NULL"
                                                             : "columns is NULL"));
    }
    if (count > 0 && out != NULL && F->null.count == 0) {
        const sl_int row = sli_only_row(rows, count), column = sli_only_row(columns, count);
        if (row != column) { /* all entries are of one row or of one column */
            sl_status status = sli_check_entries(F, rows, count, columns, count, stats);
            if (status != SL_OK || count > 1 ||
                sli_entry_is_local(F->S, F->S->iperm[row], F->S->iperm[column])) {
                status = status != SL_OK ? status
                         : column != -1  ? sli_entries_of_column(F, out, (size_t)count, rows, count,
                                                                 column, W, stats)
                                         : sli_entries_of_column(F, out, (size_t)count, columns,
                                                                 count, row, W, stats);
                return sli_report(stats, status);
            }
        }
    }
    q = sli_entries_of(F, out, rows, columns, count);
    return sli_inverse_entries(&q, W, stats);
}

#endif

/* row_sets.h: sets of rows of A: checks their range, sorts them by column of L */
#ifndef SLI_INVERSE_ROW_SETS_H
#define SLI_INVERSE_ROW_SETS_H

#include "../base/sort.h"
#include "../factor/factor_types.h"

/* Refuses a row out of range. stats name it as a row or, if is_column, as a column. NULL is the
 * set of all rows. */
static sl_status sli_check_rows(const sl_symbolic *S, const sl_int *rows, sl_int count,
                                int is_column, sl_stats *stats) {
    sl_int k;
    for (k = 0; k < count && rows != NULL; k++) {
        if (rows[k] < 0 || rows[k] >= S->n) {
            return !is_column ? sli_refuse_row(stats, rows[k])
                              : sli_fail_at(stats, SL_ERR_ARGUMENT, -1, rows[k],
                                            sli_min(rows[k], 0), "a column is out of range");
        }
    }
    return SL_OK;
}

/* May entries of the inverse of F in these rows and columns be computed? */
SLI_NOINLINE static sl_status sli_check_entries(const sl_factor *F, const sl_int *rows,
                                                sl_int n_rows, const sl_int *columns,
                                                sl_int n_columns, sl_stats *stats) {
    sl_status status = sli_inverse_check(F);
    status = status == SL_OK ? sli_check_rows(F->S, rows, n_rows, 0, stats) : status;
    return status == SL_OK ? sli_check_rows(F->S, columns, n_columns, 1, stats) : status;
}

/* seeds := the rows as columns of L, ascending, with repetitions; refuses a row out of range.
 * scratch: count elements. */
static sl_status sli_sort_rows(const sl_symbolic *S, const sl_int *rows, sl_int count,
                               uint64_t *seeds, uint64_t *scratch, sl_stats *stats) {
    const sl_status status = sli_check_rows(S, rows, count, 0, stats);
    sl_int k;
    for (k = 0; k < count && status == SL_OK; k++) {
        seeds[k] = sli_keyed(S->iperm[rows[k]], 0);
    }
    if (status == SL_OK) {
        sli_sort(seeds, count, scratch);
    }
    return status;
}

#endif

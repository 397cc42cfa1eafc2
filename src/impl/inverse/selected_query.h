/* selected_query.h: reads a selected inverse: its diagonal, entries, statistics, arrays */
#ifndef SLI_INVERSE_SELECTED_QUERY_H
#define SLI_INVERSE_SELECTED_QUERY_H

#include "selected.h"

/* The position of supernode s in the list, or -1. */
SLI_INLINE sl_int sli_selected_find(const sl_selected *Z, sl_int s) {
    sl_int at = s;
    if (Z->traversal.forest.count < Z->traversal.S->n_supers) {
        at = sli_lower_bound(Z->traversal.supers, Z->traversal.forest.count, s);
    }
    return at < Z->traversal.forest.count && Z->traversal.supers[at] == s ? at : -1;
}

/* The position in Z of the entry of pivots k and l, or -1. */
static sl_off sli_selected_position(const sl_selected *Z, sl_int k, sl_int l) {
    const sl_symbolic *S = Z->traversal.S;
    const sl_int column = sli_min(k, l), s = S->super_of[column], at = sli_selected_find(Z, s);
    const sl_int r = at == -1 ? -1 : sli_front_row(S, s, sli_max(k, l));
    return r == -1 ? -1
                   : Z->begin[at] + sli_panel_at(S->steps[s].width, r, column - S->super_first[s]);
}

/* Copies the requested entries. All of them are looked up before the first is written, so that out
 * is unchanged on error. */
static sl_status sli_selected_read(const sl_selected *Z, double *out, const sl_int *rows,
                                   const sl_int *columns, sl_int count, sl_stats *stats) {
    const sl_symbolic *S = Z->traversal.S;
    sl_int k;
    int pass;
    for (pass = 0; pass < 2; pass++) {
        for (k = 0; k < count; k++) {
            const sl_int i = rows == NULL ? k : rows[k], j = columns == NULL ? i : columns[k];
            sl_off at;
            if (pass == 0 && (i < 0 || i >= S->n || j < 0 || j >= S->n)) {
                return sli_fail_at(stats, SL_ERR_ARGUMENT, i, columns == NULL ? -1 : j,
                                   sli_min(sli_min(i, j), 0), "a row or column is out of range");
            }
            at = sli_selected_position(Z, S->iperm[i], S->iperm[j]);
            if (at == -1) {
                return sli_fail_at(stats, SL_ERR_OTHER_PATTERN, i, columns == NULL ? -1 : j, 0.0,
                                   "Z does not have this entry");
            }
            if (pass == 1) {
                out[k] = Z->Z[at];
            }
        }
    }
    return SL_OK;
}

/* The whole diagonal, read panel by panel. Looking it up row by row took a twelfth of the time of
 * the whole inverse. */
static void sli_selected_read_diagonal(const sl_selected *Z, double *out) {
    const sl_symbolic *S = Z->traversal.S;
    sl_int s, j;
    for (s = 0; s < S->n_supers; s++) {
        const sl_int width = S->steps[s].width, *row = S->perm + S->super_first[s];
        for (j = 0; j < width; j++) {
            out[row[j]] = Z->Z[Z->begin[s] + sli_panel_at(width, j, j)];
        }
    }
}

SL_API sl_status sl_selected_entries(const sl_selected *Z, double *out, const sl_int *rows,
                                     const sl_int *columns, sl_int count, sl_stats *stats) {
    sl_status status;
    sli_stats_clear_error(stats);
    status = sli_argument(Z == NULL                         ? "Z is NULL"
                          : rows == NULL && columns != NULL ? "rows is NULL, but columns is not"
                                                            : NULL);
    status = status == SL_OK ? sli_list(&rows, &count, Z->traversal.S->n) : status;
    if (status == SL_OK) {
        status = sli_argument(count > 0 && out == NULL ? "out is NULL" : NULL);
    }
    if (status != SL_OK) {
        return sli_report(stats, status);
    }
    if (rows == NULL && Z->traversal.forest.count == Z->traversal.S->n_supers) {
        sli_selected_read_diagonal(Z, out);
        return SL_OK;
    }
    return sli_report(stats, sli_selected_read(Z, out, rows, columns, count, stats));
}

SL_API sl_selected_arrays sl_selected_view(const sl_selected *Z) {
    sl_selected_arrays v;
    SLI_CLEAR(v);
    if (Z != NULL) {
        v.info.supernodes = Z->traversal.forest.count;
        v.info.columns = sli_traversal_count_columns(&Z->traversal);
        v.info.entries = Z->begin[Z->traversal.forest.count];
        v.info.seconds = Z->seconds;
        v.info.bytes = Z->bytes;
        v.symbolic = Z->traversal.S;
        v.count = Z->traversal.forest.count;
        v.supers = Z->traversal.supers;
        v.begin = Z->begin;
        v.Z = Z->Z;
    }
    return v;
}

#endif

/* selected_ask.h: what can be asked of a selected inverse: its diagonal, its entries, a look inside */
#ifndef SLI_SELECTED_ASK_H
#define SLI_SELECTED_ASK_H

#include "selected.h"

/* The place of supernode s in the list, or -1. */
SLI_INLINE sl_int sli_selected_find(const sl_selected *Z, sl_int s) {
    sl_int at = s;
    if (Z->descent.forest.count < Z->descent.S->n_supers) {
        at = sli_lower_bound(Z->descent.supers, Z->descent.forest.count, s);
    }
    return at < Z->descent.forest.count && Z->descent.supers[at] == s ? at : -1;
}

/* Where the entry of pivots k and l stands in Z, or -1. */
static sl_off sli_selected_at(const sl_selected *Z, sl_int k, sl_int l) {
    const sl_symbolic *S = Z->descent.S;
    const sl_int column = sli_min(k, l), s = S->super_of[column], at = sli_selected_find(Z, s);
    const sl_int r = at == -1 ? -1 : sli_descent_row(S, s, sli_max(k, l));
    return r == -1 ? -1
                   : Z->begin[at] + sli_panel_at(S->steps[s].width, r, column - S->super_first[s]);
}

/* All entries asked for are looked up before the first is written: out stays untouched on error. */
static sl_status sli_selected_ask(const sl_selected *Z, double *out, const sl_int *rows,
                                  const sl_int *columns, sl_int count, sl_stats *stats) {
    const sl_symbolic *S = Z->descent.S;
    sl_int k;
    int pass;
    for (pass = 0; pass < 2; pass++) {
        for (k = 0; k < count; k++) {
            const sl_int i = rows == NULL ? k : rows[k], j = columns == NULL ? i : columns[k];
            sl_off at;
            if (pass == 0 && (i < 0 || i >= S->n || j < 0 || j >= S->n)) {
                return sli_fail_at(stats, SL_ERR_ARGUMENT, i, columns == NULL ? -1 : j, 0.0);
            }
            at = sli_selected_at(Z, S->iperm[i], S->iperm[j]);
            if (at == -1) {
                return sli_fail_at(stats, SL_ERR_PATTERN, i, columns == NULL ? -1 : j, 0.0);
            }
            if (pass == 1) {
                out[k] = Z->Z[at];
            }
        }
    }
    return SL_OK;
}

/* The diagonal in the order of the panels: looked up row by row it took a twelfth of the whole time. */
static void sli_selected_all(const sl_selected *Z, double *out) {
    const sl_symbolic *S = Z->descent.S;
    sl_int s, j;
    for (s = 0; s < S->n_supers; s++) {
        const sl_int width = S->steps[s].width, *row = S->perm + S->super_first[s];
        for (j = 0; j < width; j++) {
            out[row[j]] = Z->Z[Z->begin[s] + sli_panel_at(width, j, j)];
        }
    }
}

SL_API sl_status sl_selected_diagonal(const sl_selected *Z, double *out, const sl_int *rows,
                                      sl_int count, sl_stats *stats) {
    sli_stats_clear_error(stats);
    if (Z == NULL || (rows != NULL && count < 0)) {
        return SL_ERR_ARGUMENT;
    }
    count = rows == NULL ? Z->descent.S->n : count;
    if (count > 0 && out == NULL) {
        return SL_ERR_ARGUMENT;
    }
    if (rows == NULL && Z->descent.forest.count == Z->descent.S->n_supers) {
        sli_selected_all(Z, out);
        return SL_OK;
    }
    return sli_selected_ask(Z, out, rows, NULL, count, stats);
}

SL_API sl_status sl_selected_entries(const sl_selected *Z, double *out, const sl_int *rows,
                                     const sl_int *columns, sl_int count, sl_stats *stats) {
    sli_stats_clear_error(stats);
    if (Z == NULL || count < 0 || (count > 0 && (out == NULL || rows == NULL || columns == NULL))) {
        return SL_ERR_ARGUMENT;
    }
    return sli_selected_ask(Z, out, rows, columns, count, stats);
}

SL_API sl_selected_view_t sl_selected_view(const sl_selected *Z) {
    sl_selected_view_t v = {NULL, 0, NULL, NULL, NULL};
    if (Z != NULL) {
        v.symbolic = Z->descent.S;
        v.count = Z->descent.forest.count;
        v.supers = Z->descent.supers;
        v.begin = Z->begin;
        v.Z = Z->Z;
    }
    return v;
}

#endif

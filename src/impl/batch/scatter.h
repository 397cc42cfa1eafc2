/* scatter.h: scatters a matrix into a value array in the order of the scatter map */
#ifndef SLI_BATCH_SCATTER_H
#define SLI_BATCH_SCATTER_H

#include "../../public/several.h"
#include "../matrix/csc_triangle.h"
#include "../factor/factor_types.h"
#include "../analysis/structure.h"

/* Work arrays of the scattering of a matrix K. An entry belongs to the column of its earlier pivot,
 * both in K and in the map. Column by column, the rows of the map are marked with their positions,
 * and the entries of K look their rows up. */
typedef struct sli_scatter_work {
    sl_int *begin; /* n + 1: where each column begins in from and to */
    sl_int *from;  /* positions of the entries of K that are read */
    sl_int *to;    /* their rows, later their positions in the map, -1 for none */
    /* n: the position of row k of the current column in the map, -1 between columns */
    sl_int *index;
    sl_int *head; /* columns of the widest supernode: the first map entry of each column */
    /* map entries of the largest supernode: the next one in its column, -1 at the end */
    sl_int *next;
    sl_int *row; /* map entries of the largest supernode: its row */
} sli_scatter_work;

static void sli_scatter_layout(sli_scatter_work *w, sli_block *b, const sl_symbolic *S,
                               sl_int entries) {
    sl_off most = 0;
    sl_int s;
    for (s = 0; s < S->n_supers; s++) {
        const sl_off here = S->scatter_begin[s + 1] - S->scatter_begin[s];
        most = here > most ? here : most;
    }
    w->begin = SLI_TAKE(b, sl_int, (size_t)S->n + 1);
    w->from = SLI_TAKE(b, sl_int, entries);
    w->to = SLI_TAKE(b, sl_int, entries);
    w->index = SLI_TAKE(b, sl_int, S->n);
    w->head = SLI_TAKE(b, sl_int, S->widest);
    w->next = SLI_TAKE(b, sl_int, most);
    w->row = SLI_TAKE(b, sl_int, most);
}

/* Sorts K's entries by columns. Within a column they keep the order of K, in which duplicates are
 * summed. */
static void sli_scatter_sort(const sl_symbolic *S, sli_scatter_work *w, const sl_csc *K,
                             sl_triangle triangle) {
    const sl_int *iperm = S->iperm;
    sl_int j, p, total = 0;
    SLI_ZERO(w->begin, S->n + 1);
    for (j = 0; j < S->n; j++) {
        for (p = K->p[j]; p < K->p[j + 1]; p++) {
            w->begin[sli_min(iperm[K->i[p]], iperm[j])] += sli_is_read(triangle, K->i[p], j);
        }
    }
    for (j = 0; j <= S->n; j++) {
        const sl_int here = w->begin[j];
        w->begin[j] = total;
        total += here;
    }
    /* each begin advances to its column's end, and is shifted back below */
    for (j = 0; j < S->n; j++) {
        for (p = K->p[j]; p < K->p[j + 1]; p++) {
            if (sli_is_read(triangle, K->i[p], j)) {
                const sl_int at = w->begin[sli_min(iperm[K->i[p]], iperm[j])]++;
                w->from[at] = p;
                w->to[at] = sli_max(iperm[K->i[p]], iperm[j]);
            }
        }
    }
    memmove(w->begin + 1, w->begin, (size_t)S->n * sizeof(sl_int));
    w->begin[0] = 0;
}

/* Lists the map entries of supernode s by columns, ascending in each. */
static void sli_scatter_list(const sl_symbolic *S, sli_scatter_work *w, sl_int s) {
    const sl_off start = S->scatter_begin[s];
    sl_int k, j, m, tile = sli_last_tile(S, s);
    SLI_NONE(w->head, S->steps[s].width);
    for (m = (sl_int)(S->scatter_begin[s + 1] - start) - 1; m >= 0; m--) {
        sli_scatter_map_pivots(S, s, start + m, &tile, &k, &j);
        j -= S->super_first[s];
        w->row[m] = k;
        w->next[m] = w->head[j];
        w->head[j] = m;
    }
}

/* Finds the map positions of K's entries in column j. Returns the first entry of K without one, if
 * before `missing`, else missing. */
static sl_int sli_scatter_find(sli_scatter_work *w, sl_int j, sl_int head, sl_int start,
                               sl_int missing) {
    sl_int m, q;
    for (m = head; m != -1; m = w->next[m]) {
        /* duplicates share a row: the last entry receives all values */
        w->index[w->row[m]] = start + m;
    }
    for (q = w->begin[j]; q < w->begin[j + 1]; q++) {
        w->to[q] = w->index[w->to[q]];
        missing = w->to[q] == -1 ? sli_min(missing, w->from[q]) : missing;
    }
    for (m = head; m != -1; m = w->next[m]) {
        w->index[w->row[m]] = -1;
    }
    return missing;
}

/* Finds the map position of every entry. Returns the first entry of K that has none, or
 * INT32_MAX. */
static sl_int sli_scatter_find_all(const sl_symbolic *S, sli_scatter_work *w) {
    sl_int s, j, missing = INT32_MAX;
    SLI_NONE(w->index, S->n);
    for (s = 0; s < S->n_supers; s++) {
        const sl_int first = S->super_first[s], last = S->super_first[s + 1];
        if (w->begin[first] < w->begin[last]) {
            sli_scatter_list(S, w, s);
            for (j = first; j < last; j++) {
                if (w->begin[j] < w->begin[j + 1]) {
                    missing = sli_scatter_find(w, j, w->head[j - first],
                                               (sl_int)S->scatter_begin[s], missing);
                }
            }
        }
    }
    return missing;
}

/* Length of an array of values in the order of S. It fits: the map has no more entries than A. */
SLI_INLINE sl_int sli_symbolic_entries(const sl_symbolic *S) {
    return (sl_int)S->scatter_begin[S->n_supers];
}

SL_API sl_status sl_symbolic_scatter(const sl_symbolic *S, double *values, const sl_csc *K,
                                     sl_stats *stats) {
    sl_options opt;
    sli_scatter_work w;
    sli_block b = {NULL, 0};
    sl_triangle triangle = SL_TRIANGLE_NONE;
    sl_int q, missing;
    sl_status status;
    sli_stats_clear_error(stats);
    status = S == NULL ? sli_argument("S is NULL") : sl_csc_check(K, stats);
    if (status == SL_OK) {
        status = sli_argument(K->n_rows != K->n_cols                          ? "A is not square"
                              : sli_nnz(K) > 0 && K->x == NULL                ? "A.x is NULL"
                              : sli_symbolic_entries(S) > 0 && values == NULL ? "values is NULL"
                                                                              : NULL);
    }
    if (status == SL_OK && K->n_cols != S->n) {
        status = sli_refuse(SL_ERR_OTHER_PATTERN, "A has another size than the analyzed matrix");
    }
    if (status != SL_OK) {
        return sli_report(stats, status);
    }
    SLI_CLEAR(w);
    opt = sli_options_with(&S->allocator);
    status = sli_csc_triangle(K, sli_triangle_scan(K), &triangle, &opt, stats);
    SLI_LAYOUT(&b, &S->allocator, status) {
        sli_scatter_layout(&w, &b, S, sli_nnz(K));
    }
    if (status != SL_OK) {
        return sli_report(stats, status);
    }
    sli_scatter_sort(S, &w, K, triangle);
    missing = sli_scatter_find_all(S, &w);
    if (missing == INT32_MAX) {
        for (q = 0; q < sli_symbolic_entries(S); q++) {
            values[q] = 0.0;
        }
        for (q = 0; q < w.begin[S->n]; q++) {
            values[w.to[q]] += K->x[w.from[q]];
        }
    } else {
        status = sli_fail_at(stats, SL_ERR_OTHER_PATTERN, K->i[missing], sli_column_of(K, missing),
                             K->x[missing], "this entry is not in the analyzed pattern");
    }
    sli_free(&S->allocator, b.base);
    return sli_report(stats, status);
}

#endif

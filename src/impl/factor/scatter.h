/* spread.h: a matrix spread over the map of the analysis, entry by entry, once for any number of factorizations */
#ifndef SLI_SPREAD_H
#define SLI_SPREAD_H

#include "../public/several.h"
#include "factor_parts.h"
#include "mapping.h"

/* What spreading a matrix K needs. Both sides of the search are sorted by column, the earlier pivot of an
 * entry: there the rows of the map are marked with their places, and those of K look them up. */
typedef struct sli_spreading {
    sl_int *begin; /* n + 1: where each column starts in .. */
    sl_int *from;  /* .. the entries of K that are read, and .. */
    sl_int *to;    /* .. their rows, and at last their places in the map, -1 for none */
    sl_int *place; /* n: where row k of the column at hand stands in the map, -1 between columns */
    sl_int *head;  /* the widest supernode: for each of its columns the first entry of the map .. */
    sl_int *next;  /* .. and the one after each, -1 at the end; the most that one supernode has */
    sl_int *row;   /* the same: its row */
} sli_spreading;

static void sli_spreading_layout(sli_spreading *w, sli_block *b, const sl_symbolic *S,
                                 sl_int entries) {
    sl_off most = 0;
    sl_int s;
    for (s = 0; s < S->n_supers; s++) {
        const sl_off here = S->map_begin[s + 1] - S->map_begin[s];
        most = here > most ? here : most;
    }
    w->begin = SLI_TAKE(b, sl_int, (size_t)S->n + 1);
    w->from = SLI_TAKE(b, sl_int, entries);
    w->to = SLI_TAKE(b, sl_int, entries);
    w->place = SLI_TAKE(b, sl_int, S->n);
    w->head = SLI_TAKE(b, sl_int, S->widest);
    w->next = SLI_TAKE(b, sl_int, most);
    w->row = SLI_TAKE(b, sl_int, most);
}

/* K's entries by columns, each column in the order of K, so that duplicates are summed in it. */
static void sli_spreading_sort(const sl_symbolic *S, sli_spreading *w, const sl_csc *K,
                               sl_triangle triangle) {
    const sl_int *iperm = S->iperm;
    sl_int j, p, total = 0;
    memset(w->begin, 0, ((size_t)S->n + 1) * sizeof(sl_int));
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
    for (j = 0; j < S->n; j++) { /* every begin moves to its end, and back afterwards */
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

/* A supernode's part of the map by columns, ascending in each. */
static void sli_spreading_list(const sl_symbolic *S, sli_spreading *w, sl_int s) {
    const sl_off start = S->map_begin[s];
    sl_int k, j, m, tile = sli_last_tile(S, s);
    for (j = 0; j < S->steps[s].width; j++) {
        w->head[j] = -1;
    }
    for (m = (sl_int)(S->map_begin[s + 1] - start) - 1; m >= 0; m--) {
        sli_map_pivots(S, s, start + m, &tile, &k, &j);
        j -= S->super_first[s];
        w->row[m] = k;
        w->next[m] = w->head[j];
        w->head[j] = m;
    }
}

/* The places of column j's entries of K. Returns the first entry of K so far that has none, or bad. */
static sl_int sli_spreading_find(sli_spreading *w, sl_int j, sl_int head, sl_int start,
                                 sl_int bad) {
    sl_int m, q;
    for (m = head; m != -1; m = w->next[m]) {
        w->place[w->row[m]] = start + m; /* of several for duplicates the last takes all */
    }
    for (q = w->begin[j]; q < w->begin[j + 1]; q++) {
        w->to[q] = w->place[w->to[q]];
        bad = w->to[q] == -1 ? sli_min(bad, w->from[q]) : bad;
    }
    for (m = head; m != -1; m = w->next[m]) {
        w->place[w->row[m]] = -1;
    }
    return bad;
}

/* Every entry's place. Returns the first entry of K that has none, or INT32_MAX. */
static sl_int sli_spreading_find_all(const sl_symbolic *S, sli_spreading *w) {
    sl_int s, j, bad = INT32_MAX;
    for (j = 0; j < S->n; j++) {
        w->place[j] = -1;
    }
    for (s = 0; s < S->n_supers; s++) {
        const sl_int first = S->super_first[s], last = S->super_first[s + 1];
        if (w->begin[first] < w->begin[last]) {
            sli_spreading_list(S, w, s);
            for (j = first; j < last; j++) {
                if (w->begin[j] < w->begin[j + 1]) {
                    bad =
                        sli_spreading_find(w, j, w->head[j - first], (sl_int)S->map_begin[s], bad);
                }
            }
        }
    }
    return bad;
}

SL_API sl_int sl_symbolic_entries(const sl_symbolic *S) {
    return S == NULL ? 0 : (sl_int)S->map_begin[S->n_supers]; /* no more than A has */
}

SL_API sl_status sl_symbolic_spread(const sl_symbolic *S, double *values, const sl_csc *K,
                                    sl_stats *stats) {
    sl_options opt;
    sli_spreading w;
    sli_block b = {NULL, 0, 0};
    sl_triangle triangle = SL_TRIANGLE_NONE;
    sl_int q, bad;
    int pass;
    sl_status status = sl_csc_check(K, stats);
    if (S == NULL || status != SL_OK) {
        return S == NULL ? SL_ERR_ARGUMENT : status;
    }
    if (K->n_rows != K->n_cols || (sli_nnz(K) > 0 && K->x == NULL) ||
        (sl_symbolic_entries(S) > 0 && values == NULL)) {
        return SL_ERR_ARGUMENT;
    }
    if (K->n_cols != S->n) {
        return SL_ERR_PATTERN;
    }
    memset(&w, 0, sizeof w);
    memset(&opt, 0, sizeof opt);
    opt.allocator = S->allocator;
    status = sli_csc_triangle(K, &triangle, &opt, stats);
    for (pass = 0; pass < 2 && status == SL_OK; pass++) {
        sli_spreading_layout(&w, &b, S, sli_nnz(K));
        status = pass == 0 ? sli_block_alloc(&b, &S->allocator) : SL_OK;
    }
    if (status != SL_OK) {
        return status;
    }
    sli_spreading_sort(S, &w, K, triangle);
    bad = sli_spreading_find_all(S, &w);
    if (bad == INT32_MAX) {
        for (q = 0; q < sl_symbolic_entries(S); q++) {
            values[q] = 0.0;
        }
        for (q = 0; q < w.begin[S->n]; q++) {
            values[w.to[q]] += K->x[w.from[q]];
        }
    } else {
        status = sli_fail_at(stats, SL_ERR_PATTERN, K->i[bad], sli_column_of(K, bad), K->x[bad]);
    }
    sli_free(&S->allocator, b.base);
    return status;
}

#endif

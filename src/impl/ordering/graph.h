/* graph.h: the pattern of a symmetric matrix, from whichever triangle is stored, as graph and as ordered halves */
#ifndef SLI_GRAPH_H
#define SLI_GRAPH_H

#include "csc.h"
#include "symbolic_types.h"

/* The full pattern without its diagonal; an entry given twice is an edge given twice. */
typedef struct sli_graph {
    sl_int n;
    sl_off *begin; /* n + 1 */
    sl_int *to;    /* begin[n] neighbours */
} sli_graph;

/* G has room for n + 1 positions and twice A's entries; n is A's rows over block, as many of which
 * side by side are one vertex. */
SLI_INLINE void sli_graph_fill(sli_graph *G, const sl_csc *A, sl_triangle triangle, sl_int block) {
    const sl_int columns = A->n_cols;
    sl_int j, p;
    sl_off total = 0;
    memset(G->begin, 0, ((size_t)G->n + 1) * sizeof(sl_off));
    for (j = 0; j < columns; j++) {
        const sl_int v = block == 1 ? j : j / block;
        for (p = A->p[j]; p < A->p[j + 1]; p++) {
            const sl_int u = block == 1 ? A->i[p] : A->i[p] / block;
            const int is_edge = u != v && sli_is_read(triangle, A->i[p], j);
            G->begin[u] += is_edge;
            G->begin[v] += is_edge;
        }
    }
    for (j = 0; j <= G->n; j++) {
        const sl_off here = G->begin[j];
        G->begin[j] = total;
        total += here;
    }
    for (j = 0; j < columns; j++) { /* every begin moves to its end, and back afterwards */
        const sl_int v = block == 1 ? j : j / block;
        for (p = A->p[j]; p < A->p[j + 1]; p++) {
            const sl_int u = block == 1 ? A->i[p] : A->i[p] / block;
            if (u != v && sli_is_read(triangle, A->i[p], j)) {
                G->to[G->begin[v]++] = u;
                G->to[G->begin[u]++] = v;
            }
        }
    }
    if (G->n > 0) {
        memmove(G->begin + 1, G->begin, (size_t)G->n * sizeof(sl_off));
    }
    G->begin[0] = 0;
}

/* Whether every list of neighbours ascends, as it does when the rows of A do and none is given
 * twice. */
SLI_INLINE int sli_graph_is_sorted(const sli_graph *G) {
    sl_int v;
    sl_off e;
    for (v = 0; v < G->n; v++) {
        for (e = G->begin[v] + 1; e < G->begin[v + 1]; e++) {
            if (G->to[e - 1] >= G->to[e]) {
                return 0;
            }
        }
    }
    return 1;
}

/* Sorts every list into `to`: a symmetric graph handed out vertex by vertex arrives sorted. at: n
 * of scratch. */
SLI_INLINE void sli_graph_sort(const sli_graph *G, sl_int *to, sl_off *at) {
    sl_int v;
    sl_off e;
    memcpy(at, G->begin, (size_t)G->n * sizeof(sl_off));
    for (v = 0; v < G->n; v++) {
        for (e = G->begin[v]; e < G->begin[v + 1]; e++) {
            to[at[G->to[e]]++] = v;
        }
    }
}

/* Takes repeated edges out of sorted lists. */
SLI_INLINE void sli_graph_unite(sli_graph *G) {
    sl_int v;
    sl_off e, count = 0, first = 0;
    for (v = 0; v < G->n; v++) {
        const sl_off end = G->begin[v + 1];
        const sl_off kept = count;
        for (e = first; e < end; e++) {
            if (count == kept || G->to[count - 1] != G->to[e]) {
                G->to[count++] = G->to[e];
            }
        }
        first = end;
        G->begin[v] = kept;
    }
    G->begin[G->n] = count;
}

/* Counts to starting positions. */
static void sli_half_starts(sli_half *h, sl_int n) {
    sl_int k, total = 0;
    for (k = 0; k <= n; k++) {
        const sl_int here = h->begin[k];
        h->begin[k] = total;
        total += here;
    }
}

/* P A P' as rows (row k: the columns up to k, and where in A they stand) and as columns (column k:
 * the rows from k on). What follows walks them in elimination order, each pass only the half that
 * it needs. */
static void sli_halves_fill(const sl_csc *A, sl_triangle triangle, const sl_int *iperm,
                            sli_half *rows, sli_half *columns) {
    const sl_int n = A->n_cols;
    sl_int j, p;
    memset(rows->begin, 0, ((size_t)n + 1) * sizeof(sl_int));
    memset(columns->begin, 0, ((size_t)n + 1) * sizeof(sl_int));
    for (j = 0; j < n; j++) {
        for (p = A->p[j]; p < A->p[j + 1]; p++) {
            if (sli_is_read(triangle, A->i[p], j)) {
                rows->begin[sli_max(iperm[A->i[p]], iperm[j])]++;
                columns->begin[sli_min(iperm[A->i[p]], iperm[j])]++;
            }
        }
    }
    sli_half_starts(rows, n);
    sli_half_starts(columns, n);
    for (j = 0; j < n; j++) {
        for (p = A->p[j]; p < A->p[j + 1]; p++) {
            if (sli_is_read(triangle, A->i[p], j)) {
                const sl_int k = sli_max(iperm[A->i[p]], iperm[j]),
                             i = sli_min(iperm[A->i[p]], iperm[j]);
                const sl_int at = rows->begin[k]++;
                rows->to[at] = i;
                rows->from[at] = p;
                columns->to[columns->begin[i]++] = k;
            }
        }
    }
    memmove(rows->begin + 1, rows->begin, (size_t)n * sizeof(sl_int));
    memmove(columns->begin + 1, columns->begin, (size_t)n * sizeof(sl_int));
    rows->begin[0] = columns->begin[0] = 0;
}

SLI_INLINE uint64_t sli_stir(uint64_t h, uint64_t what) {
    h = (h ^ what) * 0xd6e8feb86659fd93u;
    return h ^ h >> 32;
}

/* Stirs count numbers in, two at once and in four chains: the multiplications of one chain wait for
 * each other, and every refactorization comes through here. */
static uint64_t sli_stir_all(uint64_t h, const sl_int *a, sl_int count) {
    uint64_t chain[4] = {h, h + 1, h + 2, h + 3};
    sl_int k = 0;
    int c;
    for (; k <= count - 8; k += 8) {
        for (c = 0; c < 4; c++) {
            chain[c] = sli_stir(chain[c], (uint64_t)(uint32_t)a[k + 2 * c] << 32 |
                                              (uint32_t)a[k + 2 * c + 1]);
        }
    }
    for (; k < count; k++) {
        chain[0] = sli_stir(chain[0], (uint32_t)a[k]);
    }
    return sli_stir(sli_stir(sli_stir(chain[0], chain[1]), chain[2]), chain[3]);
}

/* A number that two patterns share only by a 2^-64 accident. */
static uint64_t sli_fingerprint(const sl_csc *A) {
    const uint64_t h = sli_stir_all((uint64_t)(uint32_t)A->n_cols + 0x9e3779b97f4a7c15u,
                                    A->n_cols > 0 ? A->p + 1 : NULL, A->n_cols);
    return sli_stir_all(h, A->i, sli_nnz(A));
}

#endif

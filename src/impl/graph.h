/* graph.h: the graph of a symmetric matrix, from whichever triangle is stored */
#ifndef SLI_GRAPH_H
#define SLI_GRAPH_H

#include "csc.h"
#include "symbolic_types.h"

/* begin of a graph with room for it; the number of entries read is returned. */
static sl_off sli_graph_count(sli_graph *G, const sl_csc *A, sl_triangle triangle) {
    sl_int j, p;
    sl_off read = 0, total = 0;
    memset(G->begin, 0, ((size_t)G->n + 1) * sizeof(sl_off));
    for (j = 0; j < A->n_cols; j++) {
        for (p = A->p[j]; p < A->p[j + 1]; p++) {
            const sl_int i = A->i[p];
            if (sli_is_read(triangle, i, j)) {
                read++;
                G->begin[i]++;
                G->begin[j] += i != j;
            }
        }
    }
    for (j = 0; j <= G->n; j++) {
        const sl_off here = G->begin[j];
        G->begin[j] = total;
        total += here;
    }
    return read;
}

/* The edges; every begin moves to its end on the way and back afterwards. */
static void sli_graph_fill(sli_graph *G, const sl_csc *A, sl_triangle triangle) {
    sl_int j, p;
    for (j = 0; j < A->n_cols; j++) {
        for (p = A->p[j]; p < A->p[j + 1]; p++) {
            const sl_int i = A->i[p];
            if (sli_is_read(triangle, i, j)) {
                sl_off at = G->begin[j]++;
                G->to[at] = i;
                G->from[at] = p;
                if (i != j) {
                    at = G->begin[i]++;
                    G->to[at] = j;
                    G->from[at] = p;
                }
            }
        }
    }
    memmove(G->begin + 1, G->begin, (size_t)G->n * sizeof(sl_off));
    G->begin[0] = 0;
}

/* A number that two patterns share only by a 2^-64 accident. */
static uint64_t sli_fingerprint(const sl_csc *A) {
    uint64_t h = (uint64_t)(uint32_t)A->n_cols + 0x9e3779b97f4a7c15u;
    sl_int k;
    for (k = 0; k < A->n_cols; k++) {
        h = (h ^ (uint32_t)A->p[k + 1]) * 0xd6e8feb86659fd93u;
        h ^= h >> 32;
    }
    for (k = 0; k < sli_nnz(A); k++) {
        h = (h ^ (uint32_t)A->i[k]) * 0xd6e8feb86659fd93u;
        h ^= h >> 32;
    }
    return h;
}

#endif

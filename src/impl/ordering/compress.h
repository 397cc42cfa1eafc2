/* order_compress.h: rows with the same neighbours ordered as one: unknowns of one vertex, cliques */
#ifndef SLI_ORDER_COMPRESS_H
#define SLI_ORDER_COMPRESS_H

#include "order_own.h"

/* Fewer rows than this share of them must be left for a graph of their own to be worth making. */
#define SLI_COMPRESS_WORTH 0.8

typedef struct sli_compressed {
    sli_graph G;
    sl_int *weight; /* G.n: rows in each vertex */
    sl_int *first;  /* n: the first row with the neighbours of this one, and their edge */
    sl_int *number; /* n: a first row's vertex in G */
    sl_int *perm;   /* G.n */
} sli_compressed;

/* Whether u and v, which are neighbours, have the same neighbours otherwise. */
static int sli_compress_are_twins(const sli_graph *G, sl_int u, sl_int v) {
    sl_off a = G->begin[u], b = G->begin[v];
    for (;;) {
        a += a < G->begin[u + 1] && G->to[a] == v;
        b += b < G->begin[v + 1] && G->to[b] == u;
        if (a == G->begin[u + 1] || b == G->begin[v + 1]) {
            return a == G->begin[u + 1] && b == G->begin[v + 1];
        }
        if (G->to[a++] != G->to[b++]) {
            return 0;
        }
    }
}

/* first of every row of a graph with sorted lists; how many different ones there are. key: n of
 * scratch. */
static sl_int sli_compress_find(const sli_graph *G, sl_int *first, uint32_t *key) {
    sl_int v, count = 0;
    sl_off e;
    for (v = 0; v < G->n; v++) {
        key[v] = sli_scatter((uint32_t)v);
        for (e = G->begin[v]; e < G->begin[v + 1]; e++) {
            key[v] += sli_scatter((uint32_t)G->to[e]);
        }
    }
    for (v = 0; v < G->n; v++) {
        first[v] = v;
        for (e = G->begin[v]; e < G->begin[v + 1] && G->to[e] < v; e++) {
            const sl_int u = G->to[e];
            if (key[u] == key[v] && first[u] == u && sli_compress_are_twins(G, u, v)) {
                first[v] = u;
                break;
            }
        }
        count += first[v] == v;
    }
    return count;
}

/* The graph of the first rows: a row that has others as neighbours has their first one too. */
static void sli_compress_fill(sli_compressed *c, const sli_graph *G) {
    sl_int v, k = 0;
    sl_off e, edges = 0;
    for (v = 0; v < G->n; v++) {
        if (c->first[v] == v) {
            c->weight[k] = 0;
            c->number[v] = k++;
        }
        c->weight[c->number[c->first[v]]]++;
    }
    for (v = 0; v < G->n; v++) {
        if (c->first[v] != v) {
            continue;
        }
        c->G.begin[c->number[v]] = edges;
        for (e = G->begin[v]; e < G->begin[v + 1]; e++) {
            if (c->first[G->to[e]] == G->to[e]) {
                c->G.to[edges++] = c->number[G->to[e]];
            }
        }
    }
    c->G.begin[c->G.n] = edges;
}

/* From vertices back to rows. start: G.n + 1 of scratch. */
static void sli_compress_expand(const sli_compressed *c, sl_int rows, sl_int *perm, sli_nest *nest,
                                sl_int *start) {
    sl_int k, v, at = 0;
    for (k = 0; k < c->G.n; k++) {
        start[c->perm[k]] = at;
        at += c->weight[c->perm[k]];
    }
    for (v = 0; v < rows; v++) {
        perm[start[c->number[c->first[v]]]++] = v;
    }
    for (v = rows - 1; v >= 0; v--) { /* a vertex's number is no larger than its rows' */
        nest->of[v] = nest->of[c->number[c->first[v]]];
    }
}

/* The order of a graph whose rows may come in groups of twins. scratch: n. */
static sl_status sli_order_compressed(const sli_graph *G, int by_metis, sl_int *perm,
                                      sl_int *scratch, sli_nest *nest, const sl_allocator *a) {
    sli_compressed c;
    sli_block b = {NULL, 0, 0};
    sl_status status = SL_OK;
    int pass;
    memset(&c, 0, sizeof c);
    c.G.n = sli_compress_find(G, scratch, (uint32_t *)(void *)perm);
    if ((double)c.G.n > SLI_COMPRESS_WORTH * (double)G->n) {
        return sli_order_own(G, NULL, by_metis, NULL, 0, perm, nest, a);
    }
    c.first = scratch;
    for (pass = 0; pass < 2 && status == SL_OK; pass++) {
        c.G.begin = SLI_TAKE(&b, sl_off, (size_t)c.G.n + 1);
        c.G.to = SLI_TAKE(&b, sl_int, G->begin[G->n]);
        c.weight = SLI_TAKE(&b, sl_int, c.G.n);
        c.number = SLI_TAKE(&b, sl_int, G->n);
        c.perm = SLI_TAKE(&b, sl_int, c.G.n);
        status = pass == 0 ? sli_block_alloc(&b, a) : SL_OK;
    }
    if (status != SL_OK) {
        return status;
    }
    sli_compress_fill(&c, G);
    status = sli_order_own(&c.G, c.weight, by_metis, NULL, 0, c.perm, nest, a);
    if (status == SL_OK) {
        sli_compress_expand(&c, G->n, perm, nest, (sl_int *)(void *)c.G.begin);
    }
    sli_free(a, b.base);
    return status;
}

#endif

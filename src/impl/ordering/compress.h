/* compress.h: graph compression: indistinguishable rows are ordered as one vertex */
#ifndef SLI_ORDERING_COMPRESS_H
#define SLI_ORDERING_COMPRESS_H

#include "coarsen.h"
#include "job.h"

/* The graph is compressed if at most this percentage of its vertices remains. */
#define SLI_COMPRESS_SHARE 80

typedef struct sli_compressed {
    sli_graph G;
    sl_int *weight; /* G.n: number of rows in each vertex */
    sl_int *first;  /* n: the first row indistinguishable from this one */
    sl_int *number; /* n: the vertex in G of a first row */
    sl_int *perm;   /* G.n */
} sli_compressed;

/* Returns whether the neighbors u and v have the same neighbors otherwise. */
static int sli_compress_is_indistinguishable(const sli_graph *G, sl_int u, sl_int v) {
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

/* One row in this many is looked at to see whether there may be any. */
#define SLI_COMPRESS_SAMPLE 16

static int sli_compress_is_likely(const sli_graph *G) {
    sl_int v;
    sl_off e;
    for (v = 0; v < G->n; v += SLI_COMPRESS_SAMPLE) {
        for (e = G->begin[v]; e < G->begin[v + 1]; e++) {
            const sl_int u = G->to[e];
            if (sli_graph_degree(G, u) == sli_graph_degree(G, v) &&
                sli_compress_is_indistinguishable(G, u, v)) {
                return 1;
            }
        }
    }
    return 0;
}

/* The search for indistinguishable rows, by ranges of rows. */
typedef struct sli_compress_search {
    const sli_graph *G;
    sl_int *first;
    uint32_t *key;                /* n: hashes of the closed neighborhoods */
    sl_int count[SLI_SHARES_MAX]; /* first rows of each range */
} sli_compress_search;

static void sli_compress_keys(void *data, const sli_range *r) {
    const sli_compress_search *w = (const sli_compress_search *)data;
    const sli_graph *G = w->G;
    sl_int v;
    sl_off e;
    for (v = r->first; v < r->last; v++) {
        uint32_t key = sli_hash32((uint32_t)v);
        for (e = G->begin[v]; e < G->begin[v + 1]; e++) {
            key += sli_hash32((uint32_t)G->to[e]);
        }
        w->key[v] = key;
    }
}

/* Indistinguishable rows are neighbors of each other: the first one that is found is the first of
 * all. */
static void sli_compress_firsts(void *data, const sli_range *r) {
    sli_compress_search *w = (sli_compress_search *)data;
    const sli_graph *G = w->G;
    sl_int v, count = 0;
    sl_off e;
    for (v = r->first; v < r->last; v++) {
        sl_int first = v;
        for (e = G->begin[v]; e < G->begin[v + 1] && G->to[e] < first; e++) {
            const sl_int u = G->to[e];
            first = w->key[u] == w->key[v] && sli_compress_is_indistinguishable(G, u, v) ? u : v;
        }
        w->first[v] = first;
        count += first == v;
    }
    w->count[r->item] = count;
}

/* Finds the first indistinguishable row of each row, in a graph with sorted lists. Returns the
 * number of first rows. key: n of scratch. */
static sl_int sli_compress_find(const sli_graph *G, sl_int *first, uint32_t *key, sli_team *team) {
    const sl_int ranges = sli_shares_count(team, G->n);
    sl_int item, count = 0;
    sli_compress_search w;
    w.G = G;
    w.first = first;
    w.key = key;
    sli_range_run(team, G->n, ranges, sli_compress_keys, &w);
    sli_range_run(team, G->n, ranges, sli_compress_firsts, &w);
    for (item = 0; item < ranges; item++) {
        count += w.count[item];
    }
    return count;
}

/* Fills the compressed graph from the lists of the first rows. That suffices: a neighbor of any row
 * of a vertex is a neighbor of the first one too. */
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

/* Expands the order and the separator tree from vertices to rows. start: G.n + 1 of scratch. */
static void sli_compress_expand(const sli_compressed *c, sl_int rows, sl_int *perm,
                                sli_septree *septree, sl_int *start) {
    sl_int k, v, at = 0;
    for (k = 0; k < c->G.n; k++) {
        start[c->perm[k]] = at;
        at += c->weight[c->perm[k]];
    }
    for (v = 0; v < rows; v++) {
        perm[start[c->number[c->first[v]]]++] = v;
    }
    /* backwards: a vertex's number is at most that of its rows */
    for (v = rows - 1; v >= 0 && septree->count > 0; v--) {
        septree->node_of[v] = septree->node_of[c->number[c->first[v]]];
    }
}

/* Compresses the graph of a job if that is worthwhile. *inner := the job of what is left, or a copy
 * of the job. b: to be freed. */
static sl_status sli_compress(const sli_order_job *job, sli_order_job *inner, sli_compressed *c,
                              sli_block *b) {
    const sli_graph *G = job->G;
    sl_status status = SL_OK;
    *inner = *job;
    inner->may_compress = 0;
    c->G.n = !sli_compress_is_likely(G)
                 ? G->n
                 : sli_compress_find(G, job->scratch, (uint32_t *)(void *)job->perm, job->team);
    if (100 * (int64_t)c->G.n > SLI_COMPRESS_SHARE * (int64_t)G->n) {
        return SL_OK;
    }
    c->first = job->scratch;
    SLI_LAYOUT(b, job->a, status) {
        c->G.begin = SLI_TAKE(b, sl_off, (size_t)c->G.n + 1);
        c->G.to = SLI_TAKE(b, sl_int, G->begin[G->n]);
        c->weight = SLI_TAKE(b, sl_int, c->G.n);
        c->number = SLI_TAKE(b, sl_int, G->n);
        c->perm = SLI_TAKE(b, sl_int, c->G.n);
    }
    if (status == SL_OK) {
        sli_compress_fill(c, G);
        inner->G = &c->G;
        inner->weight = c->weight;
        inner->perm = c->perm;
        inner->scratch = job->scratch + G->n;
    }
    return status;
}

#endif

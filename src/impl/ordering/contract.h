/* contract.h: contraction of a graph, and what its edges cost, in loops that workers share */
#ifndef SLI_ORDERING_CONTRACT_H
#define SLI_ORDERING_CONTRACT_H

#include "../base/alloc.h"
#include "../base/parallel.h"

/* A graph of the multilevel hierarchy, without loops or repeated edges. A vertex of a coarser level
 * represents a set of finest vertices; an edge represents all finest edges between two sets. */
typedef struct sli_level {
    sl_int n;
    sl_off *begin; /* n + 1 */
    sl_int *to;    /* begin[n] */
    /* begin[n]: number of finest edges, or after sli_weigh_edges what a separator costs; NULL: 1
     * each */
    sl_int *edge;
    sl_int *weight; /* n: number of finest vertices; NULL: 1 each */
    sl_int *coarse; /* n: the vertex of the next coarser level that contains this one */
    void *block;    /* the allocation that holds all arrays */
} sli_level;

/* The vertices of each cluster, a vertex of the next coarser level: those of cluster k are
 * member[start[k]] .. member[start[k + 1] - 1]. */
typedef struct sli_clusters {
    sl_int *member; /* as many as vertices */
    sl_int *start;  /* one more than vertices */
} sli_clusters;

#define SLI_LEVELS_MAX 64

SLI_INLINE sl_int sli_level_weight(const sli_level *g, sl_int v) {
    return g->weight == NULL ? 1 : g->weight[v];
}

SLI_INLINE sl_int sli_level_edge(const sli_level *g, sl_off e) {
    return g->edge == NULL ? 1 : g->edge[e];
}

/* Loops over ranges of the vertices of a level, for the workers of a team. Each worker has `room`
 * numbers of scratch, and sets them in its first range. */
typedef struct sli_shares {
    sli_team *team;
    sl_off *scratch;
    sl_int room;
    unsigned char begun[SLI_TEAM_MAX];
} sli_shares;

/* Ranges for each worker, if there are several and the level is large. */
#define SLI_SHARES 4
#if defined(SLI_SMALL_TASKS)
#define SLI_SHARES_FROM 50
#else
#define SLI_SHARES_FROM 5000
#endif
#define SLI_SHARES_MAX (SLI_SHARES * SLI_TEAM_MAX)

SLI_INLINE sl_int sli_shares_count(const sli_shares *r, sl_int n) {
    return r->team->workers == 1 || n < SLI_SHARES_FROM ? 1 : SLI_SHARES * r->team->workers;
}

SLI_INLINE sl_int sli_share_begin(const sli_shares *r, sl_int n, sl_int item) {
    return (sl_int)((int64_t)n * item / sli_shares_count(r, n));
}

/* The scratch of a worker; *is_new := whether this is its first range. */
SLI_INLINE sl_off *sli_shares_scratch(sli_shares *r, sl_int worker, int *is_new) {
    *is_new = !r->begun[worker];
    r->begun[worker] = 1;
    return r->scratch + (size_t)worker * (size_t)r->room;
}

/* A contraction of g to c. Each range writes its edges behind the room of those before it; then
 * they move together. */
typedef struct sli_contraction {
    const sli_level *g;
    const sli_clusters *clusters;
    sli_level *c;
    sli_shares *ranges;
    sl_off begin[SLI_SHARES_MAX + 1], end[SLI_SHARES_MAX]; /* the edges of each range */
} sli_contraction;

/* Counts the edges of the vertices in a range of clusters. */
static void sli_contract_count(void *data, sl_int item, sl_int worker) {
    sli_contraction *t = (sli_contraction *)data;
    const sl_int *start = t->clusters->start;
    const sl_int last = start[sli_share_begin(t->ranges, t->c->n, item + 1)];
    sl_off count = 0;
    sl_int m;
    (void)worker;
    for (m = start[sli_share_begin(t->ranges, t->c->n, item)]; m < last; m++) {
        const sl_int v = t->clusters->member[m];
        count += t->g->begin[v + 1] - t->g->begin[v];
    }
    t->begin[item + 1] = count;
}

/* Contracts a range of clusters. */
static void sli_contract_item(void *data, sl_int item, sl_int worker) {
    sli_contraction *t = (sli_contraction *)data;
    const sli_level *g = t->g;
    const sli_clusters *clusters = t->clusters;
    sli_level *c = t->c;
    const sl_int last = sli_share_begin(t->ranges, c->n, item + 1);
    int is_new;
    sl_off e, count = t->begin[item], *at = sli_shares_scratch(t->ranges, worker, &is_new);
    sl_int k, m;
    for (k = 0; k < c->n && is_new; k++) {
        at[k] = -1;
    }
    for (k = sli_share_begin(t->ranges, c->n, item); k < last; k++) {
        const sl_off first = count;
        c->begin[k] = first;
        c->weight[k] = 0;
        for (m = clusters->start[k]; m < clusters->start[k + 1]; m++) {
            const sl_int v = clusters->member[m];
            c->weight[k] += sli_level_weight(g, v);
            for (e = g->begin[v]; e < g->begin[v + 1]; e++) {
                const sl_int u = g->coarse[g->to[e]];
                if (u == k) {
                    continue;
                }
                if (at[u] < first) {
                    at[u] = count;
                    c->to[count] = u;
                    c->edge[count++] = sli_level_edge(g, e);
                } else {
                    c->edge[at[u]] += sli_level_edge(g, e);
                }
            }
        }
    }
    t->end[item] = count;
}

/* Fills c, whose arrays have room, with the contracted graph. */
static void sli_contract(const sli_level *g, const sli_clusters *clusters, sli_level *c,
                         sli_shares *ranges) {
    const sl_int count = sli_shares_count(ranges, c->n);
    sl_off total;
    sl_int k, item;
    sli_contraction t;
    t.g = g;
    t.clusters = clusters;
    t.c = c;
    t.ranges = ranges;
    memset(ranges->begun, 0, sizeof ranges->begun);
    t.begin[0] = 0;
    if (count > 1) {
        sli_team_loop(ranges->team, count, NULL, sli_contract_count, &t);
    }
    for (item = 1; item < count; item++) {
        t.begin[item] += t.begin[item - 1];
    }
    sli_team_loop(ranges->team, count, NULL, sli_contract_item, &t);
    total = t.end[0];
    for (item = 1; item < count; item++) {
        const sl_off first = t.begin[item], edges = t.end[item] - first;
        const sl_int last = sli_share_begin(ranges, c->n, item + 1);
        memmove(c->to + total, c->to + first, (size_t)edges * sizeof(sl_int));
        memmove(c->edge + total, c->edge + first, (size_t)edges * sizeof(sl_int));
        for (k = sli_share_begin(ranges, c->n, item); k < last; k++) {
            c->begin[k] -= first - total;
        }
        total += edges;
    }
    c->begin[c->n] = total;
}

/* Makes the coarser level of n clusters. */
static sl_status sli_coarsen_clusters(const sli_level *g, sl_int n, const sli_clusters *clusters,
                                      sli_level *c, sli_shares *ranges, const sl_allocator *a) {
    sli_block b = {NULL, 0, 0};
    sl_status status = SL_OK;
    int pass;
    c->n = n;
    for (pass = 0; pass < 2 && status == SL_OK; pass++) {
        c->begin = SLI_TAKE(&b, sl_off, (size_t)n + 1);
        c->weight = SLI_TAKE(&b, sl_int, n);
        c->coarse = SLI_TAKE(&b, sl_int, n);
        c->to = SLI_TAKE(&b, sl_int, g->begin[g->n]);
        c->edge = SLI_TAKE(&b, sl_int, g->begin[g->n]);
        status = pass == 0 ? sli_block_alloc(&b, a) : SL_OK;
    }
    c->block = b.base;
    if (status == SL_OK) {
        sli_contract(g, clusters, c, ranges);
    }
    return status;
}

/* Scratch for weighing the edges of level l. to, count: room for the finest edges; start: n + 1;
 * the other arrays: n. */
typedef struct sli_edge_weights {
    sli_level *levels;
    int l;
    sl_int *cluster, *member, *start, *to, *count;
    sli_shares *ranges;
} sli_edge_weights;

/* Sorts the finest vertices by the vertex of level l that contains them. */
static void sli_cluster_members(sli_edge_weights *w) {
    const sli_level *levels = w->levels;
    const int l = w->l;
    const sl_int n = levels[0].n, clusters = levels[l].n;
    sl_int v, k;
    int m;
    memset(w->start, 0, ((size_t)clusters + 1) * sizeof(sl_int));
    for (v = 0; v < n; v++) {
        sl_int c = v;
        for (m = 0; m < l; m++) {
            c = levels[m].coarse[c];
        }
        w->cluster[v] = c;
        w->start[c + 1]++;
    }
    for (k = 0; k < clusters; k++) {
        w->start[k + 1] += w->start[k];
    }
    for (v = 0; v < n; v++) {
        w->member[w->start[w->cluster[v]]++] = v;
    }
    memmove(w->start + 1, w->start, (size_t)clusters * sizeof(sl_int));
    w->start[0] = 0;
}

/* Counts the vertices on one side of each edge, for a range of vertices of the level. */
static void sli_weigh_item(void *data, sl_int item, sl_int worker) {
    sli_edge_weights *w = (sli_edge_weights *)data;
    const sli_level *finest = &w->levels[0], *g = &w->levels[w->l];
    const sl_int last = sli_share_begin(w->ranges, g->n, item + 1);
    int is_new;
    sl_off e, *at = sli_shares_scratch(w->ranges, worker, &is_new);
    sl_int k, i, *seen = (sl_int *)(void *)(at + g->n);
    for (k = 0; k < g->n && is_new; k++) {
        seen[k] = -1;
    }
    for (k = sli_share_begin(w->ranges, g->n, item); k < last; k++) {
        for (e = g->begin[k]; e < g->begin[k + 1]; e++) {
            at[g->to[e]] = e;
            g->edge[e] = 0;
        }
        for (i = w->start[k]; i < w->start[k + 1]; i++) {
            const sl_int v = w->member[i];
            for (e = finest->begin[v]; e < finest->begin[v + 1]; e++) {
                const sl_int c = w->cluster[finest->to[e]];
                if (c != k && seen[c] != v) {
                    seen[c] = v;
                    g->edge[at[c]]++;
                }
            }
        }
    }
}

/* Sets the weight of each edge of level l to the number of finest vertices on both sides of the
 * border that it represents: what a vertex separator there costs. The number of finest edges would
 * charge a diagonal border in a square grid twice as much as a straight one. The level has at most
 * half as many vertices as the ranges have room. */
static void sli_weigh_edges(sli_edge_weights *w) {
    const sli_level *g = &w->levels[w->l];
    sl_off e, *at = w->ranges->scratch;
    sl_int k;
    sli_cluster_members(w);
    memset(w->ranges->begun, 0, sizeof w->ranges->begun);
    sli_team_loop(w->ranges->team, sli_shares_count(w->ranges, g->n), NULL, sli_weigh_item, w);
    /* The weights so far count the vertices of one side; add those of the other side from the
     * transposed lists. */
    memcpy(at, g->begin, (size_t)g->n * sizeof(sl_off));
    for (k = 0; k < g->n; k++) {
        for (e = g->begin[k]; e < g->begin[k + 1]; e++) {
            const sl_off there = at[g->to[e]]++;
            w->to[there] = k;
            w->count[there] = g->edge[e];
        }
    }
    for (k = 0; k < g->n; k++) {
        for (e = g->begin[k]; e < g->begin[k + 1]; e++) {
            at[g->to[e]] = e;
        }
        for (e = g->begin[k]; e < g->begin[k + 1]; e++) {
            g->edge[at[w->to[e]]] += w->count[e];
        }
    }
}

#endif

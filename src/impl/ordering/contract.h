/* contract.h: contraction of a graph, in loops that workers share */
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
    /* begin[n]: what a separator costs there, see sli_weigh_edges; NULL: 1 each, or see
     * SLI_HUB_EDGES */
    sl_int *edge;
    sl_int *weight;    /* n: number of finest vertices; NULL: 1 each */
    sl_int *coarse;    /* n: the vertex of the next coarser level that contains this one */
    sl_off hub_degree; /* a vertex with this many neighbors is a hub; 0: there is none */
    int is_even;       /* of the finest level: see SLI_PATCH_EVEN */
    void *block;       /* the allocation that holds all arrays */
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

/* A vertex with this many times the mean number of neighbors, and LEAST, is a hub, such as the apex
 * of a fan. */
#define SLI_HUB_TIMES 3
#define SLI_HUB_LEAST 24
/* There are no hubs if more than one vertex in this many would be one. */
#define SLI_HUB_SHARE 64
/* The weight of an edge that is not at a hub, in a graph that has hubs. One vertex of a separator
 * cuts all edges of a hub; with the weight of others they hold the whole fan together. */
#define SLI_HUB_EDGES 4

SLI_INLINE int sli_level_is_hub(const sli_level *g, sl_int v) {
    return g->hub_degree != 0 && g->begin[v + 1] - g->begin[v] >= g->hub_degree;
}

/* The weight of edge e of v. */
SLI_INLINE sl_int sli_level_edge(const sli_level *g, sl_int v, sl_off e) {
    if (g->edge != NULL) {
        return g->edge[e];
    }
    return g->hub_degree == 0 || sli_level_is_hub(g, v) || sli_level_is_hub(g, g->to[e])
               ? 1
               : SLI_HUB_EDGES;
}

/* Loops over ranges of the vertices of a level, for the workers of a team. Each worker has `room`
 * numbers of scratch. */
typedef struct sli_shares {
    sli_team *team;
    sl_off *scratch;
    sl_int room;
} sli_shares;

/* Ranges for each worker, if there are several and the level is large. */
#define SLI_SHARES 4
#if defined(SLI_SMALL_TASKS)
#define SLI_SHARES_FROM 50
#else
#define SLI_SHARES_FROM 2000
#endif
#define SLI_SHARES_MAX (SLI_SHARES * SLI_TEAM_MAX)

SLI_INLINE sl_int sli_shares_count(const sli_team *team, sl_int n) {
    return team->workers == 1 || n < SLI_SHARES_FROM ? 1 : SLI_SHARES * team->workers;
}

/* The vertices first .. last-1 of a loop, as one item. */
typedef struct sli_range {
    sl_int first, last, item, worker;
} sli_range;

typedef void sli_range_body(void *data, const sli_range *r);

typedef struct sli_range_loop {
    sl_int n, count;
    sli_range_body *body;
    void *data;
} sli_range_loop;

static void sli_range_item(void *data, sl_int item, sl_int worker) {
    const sli_range_loop *l = (const sli_range_loop *)data;
    const sli_range r = {(sl_int)((int64_t)l->n * item / l->count),
                         (sl_int)((int64_t)l->n * (item + 1) / l->count), item, worker};
    l->body(l->data, &r);
}

/* Runs a loop over n vertices, in so many ranges. */
static void sli_range_run(sli_team *team, sl_int n, sl_int count, sli_range_body *body,
                          void *data) {
    sli_range_loop l = {n, count, body, data};
    sli_team_loop(team, count, NULL, sli_range_item, &l);
}

/* A contraction of g to c. Each range writes its edges behind the room of those before it; then
 * they move together. */
typedef struct sli_contraction {
    const sli_level *g;
    const sli_clusters *clusters;
    sli_level *c;
    sli_shares *ranges;
    sl_int first[SLI_SHARES_MAX + 1];                      /* the first cluster of each range */
    sl_off begin[SLI_SHARES_MAX + 1], end[SLI_SHARES_MAX]; /* the edges of each range */
} sli_contraction;

/* Counts the edges of the vertices in a range of clusters. */
static void sli_contract_count(void *data, const sli_range *r) {
    sli_contraction *t = (sli_contraction *)data;
    const sl_int *start = t->clusters->start;
    sl_off count = 0;
    sl_int m;
    for (m = start[r->first]; m < start[r->last]; m++) {
        const sl_int v = t->clusters->member[m];
        count += t->g->begin[v + 1] - t->g->begin[v];
    }
    t->begin[r->item + 1] = count;
    t->first[r->item + 1] = r->last;
}

/* The weight of a finest edge in a cluster's edge. */
SLI_INLINE sl_int sli_contract_weight(const sli_level *g, sl_int v, sl_off e) {
    return g->edge == NULL && sli_level_is_hub(g, g->to[e]) ? 0 : sli_level_edge(g, v, e);
}

#define SLI_CONTRACT_BITS 31

/* Adds the edges of v, a vertex of the finest level, to those of its cluster, which begin at
 * `first`, as sli_contract_range does, if all of them have weight 1. An edge within the cluster
 * looks like another one of v to the same cluster: neither counts. Returns the new count. */
SLI_INLINE sl_off sli_contract_plain(const sli_level *g, sli_level *c, sl_int v, sl_off *at,
                                     sl_off first, sl_off count) {
    const sl_int *to = g->to, *coarse = g->coarse;
    const sl_off least = first << SLI_CONTRACT_BITS, end = g->begin[v + 1];
    sl_int *edge = c->edge;
    sl_off e;
    at[coarse[v]] = least + v;
    for (e = g->begin[v]; e < end; e++) {
        const sl_int u = coarse[to[e]];
        const sl_off known = at[u], slot = known >> SLI_CONTRACT_BITS;
        if (known < least) {
            at[u] = (count << SLI_CONTRACT_BITS) + v;
            c->to[count] = u;
            edge[count++] = 1;
        } else {
            at[u] = (slot << SLI_CONTRACT_BITS) + v;
            edge[slot] += known != at[u];
        }
    }
    return count;
}

/* Contracts a range of clusters. Weights of edges are added; from the finest level, they are the
 * number of vertices of a cluster that have neighbors in the other. at[u] is, for the edge to u,
 * its position in the upper bits, and in the lower ones the last vertex that has an edge there;
 * with 2^32 edges there is no room for that, and these weights are 1. */
static void sli_contract_range(void *data, const sli_range *r) {
    sli_contraction *t = (sli_contraction *)data;
    const sli_level *g = t->g;
    const sli_clusters *clusters = t->clusters;
    sli_level *c = t->c;
    sl_off e, count = t->begin[r->item];
    sl_off *at = t->ranges->scratch + (size_t)r->worker * (size_t)t->ranges->room;
    const int bits =
        g->begin[g->n] >> 32 == 0 ? SLI_CONTRACT_BITS : 0; /* branches untested: 2^32 edges */
    const sl_off low = ((sl_off)1 << bits) - 1;
    const int is_plain = (bits > 0) & (g->edge == NULL) & (g->hub_degree == 0);
    sl_int k, m;
    SLI_NONE(at, c->n);
    for (k = r->first; k < r->last; k++) {
        const sl_off first = count;
        c->begin[k] = first;
        c->weight[k] = 0;
        for (m = clusters->start[k]; m < clusters->start[k + 1]; m++) {
            const sl_int v = clusters->member[m];
            /* lists of patches are far apart */
            SLI_PREFETCH(g->to + g->begin[clusters->member[sli_min(m + 32, g->n - 1)]], 0);
            c->weight[k] += sli_level_weight(g, v);
            if (is_plain) {
                count = sli_contract_plain(g, c, v, at, first, count);
                continue;
            }
            for (e = g->begin[v]; e < g->begin[v + 1]; e++) {
                const sl_int u = g->coarse[g->to[e]];
                if (u == k) {
                    continue;
                }
                if (at[u] < first << bits) {
                    at[u] = (count << bits) + (v & low);
                    c->to[count] = u;
                    c->edge[count++] = sli_contract_weight(g, v, e);
                } else if (g->edge != NULL || (at[u] & low) != (v & low)) {
                    at[u] += (v & low) - (at[u] & low);
                    c->edge[at[u] >> bits] += sli_contract_weight(g, v, e);
                }
            }
        }
        at[k] = -1;
    }
    t->end[r->item] = count;
}

/* Fills c, whose arrays have room, with the contracted graph. */
static void sli_contract(const sli_level *g, const sli_clusters *clusters, sli_level *c,
                         sli_shares *ranges) {
    const sl_int count = sli_shares_count(ranges->team, c->n);
    sl_off total;
    sl_int k, item;
    sli_contraction t;
    t.g = g;
    t.clusters = clusters;
    t.c = c;
    t.ranges = ranges;
    t.begin[0] = 0;
    if (count > 1) {
        sli_range_run(ranges->team, c->n, count, sli_contract_count, &t);
    }
    for (item = 1; item < count; item++) {
        t.begin[item] += t.begin[item - 1];
    }
    sli_range_run(ranges->team, c->n, count, sli_contract_range, &t);
    total = t.end[0];
    for (item = 1; item < count; item++) {
        const sl_off first = t.begin[item], edges = t.end[item] - first;
        memmove(c->to + total, c->to + first, (size_t)edges * sizeof(sl_int));
        memmove(c->edge + total, c->edge + first, (size_t)edges * sizeof(sl_int));
        for (k = t.first[item]; k < t.first[item + 1]; k++) {
            c->begin[k] -= first - total;
        }
        total += edges;
    }
    c->begin[c->n] = total;
}

/* Makes the coarser level of n clusters. */
static sl_status sli_coarsen_clusters(const sli_level *g, sl_int n, const sli_clusters *clusters,
                                      sli_level *c, sli_shares *ranges, const sl_allocator *a) {
    sli_block b = {NULL, 0};
    sl_status status = SL_OK;
    c->n = n;
    SLI_LAYOUT(&b, a, status) {
        c->begin = SLI_TAKE(&b, sl_off, (size_t)n + 1);
        c->weight = SLI_TAKE(&b, sl_int, n);
        c->coarse = SLI_TAKE(&b, sl_int, n);
        c->to = SLI_TAKE(&b, sl_int, g->begin[g->n]);
        c->edge = SLI_TAKE(&b, sl_int, g->begin[g->n]);
    }
    c->block = b.base;
    if (status == SL_OK) {
        sli_contract(g, clusters, c, ranges);
    }
    return status;
}

#endif

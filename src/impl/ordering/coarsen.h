/* coarsen.h: multilevel coarsening: each graph is contracted along a matching of its vertices */
#ifndef SLI_ORDERING_COARSEN_H
#define SLI_ORDERING_COARSEN_H

#include "../base/alloc.h"

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

/* Coarsening stops when a level would keep more than this share of the vertices: such a level does
 * not repay a pass over it. */
#define SLI_COARSEN_STALL 0.95
#define SLI_LEVELS_MAX 64

SLI_INLINE sl_int sli_level_weight(const sli_level *g, sl_int v) {
    return g->weight == NULL ? 1 : g->weight[v];
}

SLI_INLINE sl_int sli_level_edge(const sli_level *g, sl_off e) {
    return g->edge == NULL ? 1 : g->edge[e];
}

/* A hash of v: a reproducible pseudo-random number. */
SLI_INLINE uint32_t sli_hash32(uint32_t v) {
    v ^= v >> 16;
    v *= 0x7feb352du;
    v ^= v >> 15;
    v *= 0x846ca68bu;
    return v ^ v >> 16;
}

/* Returns the unmatched neighbor of v with the largest edge weight per vertex weight, or -1. The
 * search starts at a pseudo-random position in the list, so that in a regular grid not all pairs
 * have the same direction. */
static sl_int sli_match_best(const sli_level *g, sl_int v, sl_int heaviest, const sl_int *mate) {
    const sl_off first = g->begin[v], degree = g->begin[v + 1] - first;
    const sl_int own = sli_level_weight(g, v);
    sl_int best = -1, best_edge = 0, best_weight = 1;
    sl_off k, e;
    SLI_ASSERT(degree > 0); /* the graph is connected */
    e = first + (sl_off)(sli_hash32((uint32_t)v) % (uint64_t)degree);
    for (k = 0; k < degree; k++, e = e + 1 == first + degree ? first : e + 1) {
        const sl_int u = g->to[e], weight = sli_level_weight(g, u), edge = sli_level_edge(g, e);
        if (mate[u] == -1 && weight <= heaviest - own &&
            (int64_t)edge * best_weight > (int64_t)best_edge * weight) {
            best = u;
            best_edge = edge;
            best_weight = weight;
        }
    }
    return best;
}

/* Matches vertices in pairs: mate[v] := the vertex matched with v, or -1. Vertices are visited in
 * pseudo-random order, but only within windows, for locality of memory access. Returns the number
 * of pairs. */
static sl_int sli_match(const sli_level *g, sl_int heaviest, sl_int *mate) {
    const sl_int window = 512;
    sl_off first;
    sl_int k, v, pairs = 0;
    for (v = 0; v < g->n; v++) {
        mate[v] = -1;
    }
    for (first = 0; first < g->n; first += window) {
        const uint32_t turn = sli_hash32((uint32_t)first);
        for (k = 0; k < window; k++) {
            const sl_off at =
                first + (sl_off)(((uint32_t)k * 197u + turn) & (uint32_t)(window - 1));
            sl_int u;
            if (at >= g->n || mate[at] != -1) {
                continue;
            }
            v = (sl_int)at;
            u = sli_match_best(g, v, heaviest, mate);
            if (u != -1) {
                mate[v] = u;
                mate[u] = v;
                pairs++;
            }
        }
    }
    return pairs;
}

/* Matches the remaining vertices through a common neighbor (two-hop matching), such as the leaves
 * of a star. Returns the number of pairs. */
static sl_int sli_match_two_hop(const sli_level *g, sl_int heaviest, sl_int *mate) {
    sl_int v, pairs = 0;
    for (v = 0; v < g->n; v++) {
        sl_int unmatched = -1;
        sl_off e;
        for (e = g->begin[v]; e < g->begin[v + 1]; e++) {
            const sl_int u = g->to[e];
            if (mate[u] != -1) {
                continue;
            }
            if (unmatched != -1 &&
                sli_level_weight(g, u) <= heaviest - sli_level_weight(g, unmatched)) {
                mate[u] = unmatched;
                mate[unmatched] = u;
                unmatched = -1;
                pairs++;
            } else {
                unmatched = u;
            }
        }
    }
    return pairs;
}

/* Numbers the pairs and the single vertices in the order of their first members, which become
 * clusters. Returns how many there are. */
static sl_int sli_number_pairs(const sli_level *g, const sl_int *mate, sli_clusters *clusters) {
    sl_int v, count = 0, members = 0;
    for (v = 0; v < g->n; v++) {
        const sl_int u = mate[v];
        if (u != -1 && u < v) {
            continue;
        }
        g->coarse[v] = count;
        clusters->start[count++] = members;
        clusters->member[members++] = v;
        if (u > v) {
            g->coarse[u] = g->coarse[v];
            clusters->member[members++] = u;
        }
    }
    clusters->start[count] = members;
    return count;
}

/* Fills c, whose arrays have room, with the contracted graph. at: c->n of scratch. */
static void sli_contract(const sli_level *g, const sli_clusters *clusters, sli_level *c,
                         sl_off *at) {
    sl_int k, m;
    sl_off e, count = 0;
    for (k = 0; k < c->n; k++) {
        at[k] = -1;
    }
    for (k = 0; k < c->n; k++) {
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
    c->begin[k] = count;
}

/* Makes the coarser level of n clusters. at: n of scratch. */
static sl_status sli_coarsen_clusters(const sli_level *g, sl_int n, const sli_clusters *clusters,
                                      sli_level *c, sl_off *at, const sl_allocator *a) {
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
        sli_contract(g, clusters, c, at);
    }
    return status;
}

/* A graph with this many neighbors for each vertex, or more, is wide: that of A^2 or A^3 for a
 * Laplacian A of a mesh, which joins vertices at two or three edges (18 and 36 neighbors), or of
 * finite elements of high order. */
#define SLI_WIDE_DEGREE 16
/* A cluster of neighbors has at most the weight of this many pairs. */
#define SLI_NEIGHBORHOOD_PAIRS 8
/* Clusters of neighbors are used if they leave at most one vertex in this many. */
#define SLI_NEIGHBORHOOD_SHRINK 4

SLI_INLINE int sli_level_is_wide(const sli_level *g) {
    return g->begin[g->n] >= SLI_WIDE_DEGREE * (sl_off)g->n;
}

/* Makes clusters of a vertex that is in none, and those of its neighbors that are in none. Returns
 * the number of clusters. */
static sl_int sli_cluster_neighborhoods(const sli_level *g, sl_int heaviest,
                                        sli_clusters *clusters) {
    sl_int v, count = 0, members = 0;
    sl_off e;
    for (v = 0; v < g->n; v++) {
        g->coarse[v] = -1;
    }
    for (v = 0; v < g->n; v++) {
        int64_t weight = sli_level_weight(g, v);
        if (g->coarse[v] != -1) {
            continue;
        }
        clusters->start[count] = members;
        clusters->member[members++] = v;
        g->coarse[v] = count;
        for (e = g->begin[v]; e < g->begin[v + 1]; e++) {
            const sl_int u = g->to[e];
            if (g->coarse[u] == -1 && weight + sli_level_weight(g, u) <= heaviest) {
                weight += sli_level_weight(g, u);
                clusters->member[members++] = u;
                g->coarse[u] = count;
            }
        }
        count++;
    }
    clusters->start[count] = members;
    return count;
}

/* Makes the next coarser level, of pairs, or if the finest level is wide, of neighborhoods: these
 * replace three or four levels of pairs, each of which reads and contracts most of the edges again.
 * heaviest: a pair's largest weight; mate, at: g->n of scratch. *shrunk := whether the level is
 * small enough to be used; c is empty if not. */
static sl_status sli_coarsen(const sli_level *g, sl_int heaviest, sli_level *c, sl_int *mate,
                             sli_clusters *clusters, sl_off *at, int *shrunk,
                             const sl_allocator *a) {
    sl_int pairs, count = g->n;
    memset(c, 0, sizeof *c);
    *shrunk = 1;
    if (g->edge == NULL && sli_level_is_wide(g)) {
        count = sli_cluster_neighborhoods(
            g, sli_min(heaviest, INT32_MAX / SLI_NEIGHBORHOOD_PAIRS) * SLI_NEIGHBORHOOD_PAIRS,
            clusters);
    }
    if (count > g->n / SLI_NEIGHBORHOOD_SHRINK) {
        pairs = sli_match(g, heaviest, mate);
        if (pairs < g->n / 4) {
            pairs += sli_match_two_hop(g, heaviest, mate);
        }
        *shrunk = (double)(g->n - pairs) < SLI_COARSEN_STALL * (double)g->n;
        if (!*shrunk) {
            return SL_OK;
        }
        count = sli_number_pairs(g, mate, clusters);
    }
    return sli_coarsen_clusters(g, count, clusters, c, at, a);
}

/* Scratch for weighing the edges of a level. to, count: room for the finest edges; start: n + 1;
 * the other arrays: n. */
typedef struct sli_edge_weights {
    sl_int *cluster, *member, *start, *seen, *to, *count;
    sl_off *at;
} sli_edge_weights;

/* Sorts the finest vertices by the vertex of level l that contains them. */
static void sli_cluster_members(const sli_level *levels, int l, sli_edge_weights *w) {
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

/* Sets the weight of each edge of level l to the number of finest vertices on both sides of the
 * border that it represents: what a vertex separator there costs. The number of finest edges would
 * charge a diagonal border in a square grid twice as much as a straight one. */
static void sli_weigh_edges(sli_level *levels, int l, sli_edge_weights *w) {
    const sli_level *finest = &levels[0];
    sli_level *g = &levels[l];
    sl_int k, i;
    sl_off e;
    sli_cluster_members(levels, l, w);
    for (k = 0; k < g->n; k++) {
        w->seen[k] = -1;
    }
    for (k = 0; k < g->n; k++) {
        for (e = g->begin[k]; e < g->begin[k + 1]; e++) {
            w->at[g->to[e]] = e;
            g->edge[e] = 0;
        }
        for (i = w->start[k]; i < w->start[k + 1]; i++) {
            const sl_int v = w->member[i];
            for (e = finest->begin[v]; e < finest->begin[v + 1]; e++) {
                const sl_int c = w->cluster[finest->to[e]];
                if (c != k && w->seen[c] != v) {
                    w->seen[c] = v;
                    g->edge[w->at[c]]++;
                }
            }
        }
    }
    /* The weights so far count the vertices of one side; add those of the other side from the
     * transposed lists. */
    memcpy(w->at, g->begin, (size_t)g->n * sizeof(sl_off));
    for (k = 0; k < g->n; k++) {
        for (e = g->begin[k]; e < g->begin[k + 1]; e++) {
            const sl_off there = w->at[g->to[e]]++;
            w->to[there] = k;
            w->count[there] = g->edge[e];
        }
    }
    for (k = 0; k < g->n; k++) {
        for (e = g->begin[k]; e < g->begin[k + 1]; e++) {
            w->at[g->to[e]] = e;
        }
        for (e = g->begin[k]; e < g->begin[k + 1]; e++) {
            g->edge[w->at[w->to[e]]] += w->count[e];
        }
    }
}

#endif

/* coarsen.h: multilevel coarsening: each graph is contracted along a matching of its vertices */
#ifndef SLI_ORDERING_COARSEN_H
#define SLI_ORDERING_COARSEN_H

#include "contract.h"

/* Coarsening stops when a level would keep more than this share of the vertices: such a level does
 * not repay a pass over it. */
#define SLI_COARSEN_STALL 0.95
/* A hash of v: a reproducible pseudo-random number. */
SLI_INLINE uint32_t sli_hash32(uint32_t v) {
    v ^= v >> 16;
    v *= 0x7feb352du;
    v ^= v >> 15;
    v *= 0x846ca68bu;
    return v ^ v >> 16;
}

/* The vertex that is visited after k others, in pseudo-random order, but only within windows, for
 * locality of memory access. It may be beyond the last one, up to the next multiple of 512. */
SLI_INLINE sl_off sli_visited(sl_off k) {
    return (k & ~(sl_off)511) | ((k * 197 + (k >> 9) * 157) & 511);
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
        const sl_int u = g->to[e], weight = sli_level_weight(g, u), edge = sli_level_edge(g, v, e);
        if (mate[u] == -1 && weight <= heaviest - own &&
            (int64_t)edge * best_weight > (int64_t)best_edge * weight) {
            best = u;
            best_edge = edge;
            best_weight = weight;
        }
    }
    return best;
}

/* Matches vertices in pairs: mate[v] := the vertex matched with v, or -1. Returns the number of
 * pairs. */
static sl_int sli_match(const sli_level *g, sl_int heaviest, sl_int *mate) {
    sl_off k;
    sl_int v, pairs = 0;
    SLI_NONE(mate, g->n);
    for (k = 0; k < (sl_off)g->n + 511; k++) {
        const sl_off at = sli_visited(k);
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

/* A graph with this many neighbors for each vertex, or more, is wide: that of A^2 or A^3 for a
 * Laplacian A of a mesh, which joins vertices at two or three edges (18 and 36 neighbors), or of
 * finite elements of high order. */
#define SLI_WIDE_DEGREE 16
/* A cluster of neighbors in a wide graph has at most the weight of this many pairs. */
#define SLI_NEIGHBORHOOD_PAIRS 8

SLI_INLINE int sli_level_is_wide(const sli_level *g) {
    return g->begin[g->n] >= SLI_WIDE_DEGREE * (sl_off)g->n;
}

/* The weight of a ball is at most this many times that of the heaviest pair. */
#define SLI_BALL_PAIRS 4
/* In a graph that is even, as that of a surface, balls grow to patches of this weight: dissecting
 * patches of 20 vertices instead of balls and pairs takes a fourth less time, with the same fill
 * and paths in the mean of 12 meshes. In graphs of random points and networks, L would have 3 to 9
 * percent more entries. */
#define SLI_PATCH_WEIGHT 48
/* A graph is even if its vertices have at most DEGREE neighbors in the mean, and the mean square of
 * these numbers exceeds the square of the mean by at most EVEN percent: 1 to 5 on surfaces, 11 for
 * points at random. */
#define SLI_PATCH_DEGREE 9
#define SLI_PATCH_EVEN 8

/* Appends a cluster of v and, unless it gets too heavy, those neighbors that are in none; of a
 * patch, also their neighbors and so on. Returns its weight. */
SLI_INLINE sl_int sli_cluster_grow(const sli_level *g, sl_int v, sl_int heaviest, int is_patch,
                                   sl_int number, sli_clusters *clusters) {
    int64_t weight = sli_level_weight(g, v);
    sl_int members = clusters->start[number], m = members;
    sl_off e;
    clusters->member[members++] = v;
    g->coarse[v] = number;
    do {
        v = clusters->member[m++];
        for (e = g->begin[v]; e < g->begin[v + 1]; e++) {
            const sl_int u = g->to[e];
            if (g->coarse[u] == -1 && weight + sli_level_weight(g, u) <= heaviest &&
                !sli_level_is_hub(g, u)) {
                weight += sli_level_weight(g, u);
                clusters->member[members++] = u;
                g->coarse[u] = number;
            }
        }
    } while (is_patch && m < members && weight < heaviest);
    clusters->start[number + 1] = members;
    return (sl_int)weight;
}

/* Returns whether all neighbors of v are in no cluster. */
SLI_INLINE int sli_cluster_is_free(const sli_level *g, sl_int v) {
    sl_off e = g->begin[v];
    while (e < g->begin[v + 1] && g->coarse[g->to[e]] == -1) {
        e++;
    }
    return e == g->begin[v + 1];
}

/* Makes clusters of the finest level, of a vertex that is in none, and those of its neighbors that
 * are in none. With balls, first of vertices where none of the neighbors is in a cluster yet; then
 * others join the lightest of them that is next to them. Balls are rounder, and one level of them
 * replaces three or four levels of pairs. A hub is a cluster of its own. weight: g->n of scratch.
 * Returns the number of clusters. */
static sl_int sli_cluster_neighborhoods(const sli_level *g, sl_int heaviest, int has_balls,
                                        sli_clusters *clusters, sl_int *weight) {
    sl_int v, best, count = 0, members = 0;
    sl_off e, k;
    SLI_NONE(g->coarse, g->n);
    clusters->start[0] = 0;
    for (k = 0; k < (sl_off)g->n + 511; k++) {
        const sl_off at = sli_visited(k), ahead = at + 8192;
        if (ahead < g->n) { /* patches grow beyond the window where levels of a search are long */
            SLI_PREFETCH(g->to + g->begin[ahead], 0);
        }
        if (at < g->n && g->coarse[at] == -1 && !sli_level_is_hub(g, (sl_int)at) &&
            (!has_balls || sli_cluster_is_free(g, (sl_int)at))) {
            weight[count] =
                sli_cluster_grow(g, (sl_int)at, heaviest, has_balls && g->is_even, count, clusters);
            count++;
        }
    }
    if (clusters->start[count] == g->n) {
        return count;
    }
    for (v = 0; v < g->n; v++) { /* those that join are at -2 - cluster, for nobody joins them */
        best = -1;
        for (e = g->begin[v]; e < g->begin[v + 1] && g->coarse[v] == -1; e++) {
            const sl_int c = g->coarse[g->to[e]];
            best = c >= 0 && (best == -1 || weight[c] < weight[best]) ? c : best;
        }
        if (best != -1 && weight[best] <= heaviest - sli_level_weight(g, v) &&
            !sli_level_is_hub(g, v)) {
            weight[best] += sli_level_weight(g, v);
            g->coarse[v] = -2 - best;
        }
    }
    for (v = 0; v < g->n; v++) {
        if (g->coarse[v] < -1) {
            g->coarse[v] = -2 - g->coarse[v];
        } else if (g->coarse[v] == -1) {
            sli_cluster_grow(g, v, sli_level_is_hub(g, v) ? 0 : heaviest, 0, count++, clusters);
        }
    }
    SLI_ZERO(clusters->start, count + 1);
    for (v = 0; v < g->n; v++) {
        clusters->start[g->coarse[v]]++;
    }
    for (v = 0; v <= count; v++) {
        members += clusters->start[v];
        clusters->start[v] = members;
    }
    for (v = g->n - 1; v >= 0; v--) {
        clusters->member[--clusters->start[g->coarse[v]]] = v;
    }
    return count;
}

/* How a level is made coarser. */
typedef struct sli_coarsening {
    sl_int heaviest;       /* the largest weight of a pair */
    int has_balls;         /* of the finest level */
    sl_int *mate;          /* n of scratch */
    sli_clusters clusters; /* scratch */
    sli_shares *ranges;
    const sl_allocator *a;
} sli_coarsening;

/* Makes the next coarser level: of the finest, of balls, or of neighborhoods, as heavy as the
 * heaviest pair, which replace two levels of pairs, or in a wide graph three or four; of others, or
 * where clusters are small, of pairs. *shrunk := whether the level is small enough to be used; c is
 * empty if not. */
static sl_status sli_coarsen(sli_coarsening *t, const sli_level *g, sli_level *c, int *shrunk) {
    sl_int pairs, count = g->n;
    memset(c, 0, sizeof *c);
    *shrunk = 1;
    if (g->edge == NULL) {
        const sl_int times = sli_level_is_wide(g) ? SLI_NEIGHBORHOOD_PAIRS
                             : t->has_balls       ? SLI_BALL_PAIRS
                                                  : 1;
        const sl_int most = t->has_balls && g->is_even
                                ? SLI_PATCH_WEIGHT
                                : times * sli_min(t->heaviest, INT32_MAX / times);
        count = sli_cluster_neighborhoods(g, most, t->has_balls, &t->clusters, t->mate);
    }
    if (count > g->n / 2) {
        pairs = sli_match(g, t->heaviest, t->mate);
        if (pairs < g->n / 4) {
            pairs += sli_match_two_hop(g, t->heaviest, t->mate);
        }
        *shrunk = (double)(g->n - pairs) < SLI_COARSEN_STALL * (double)g->n;
        if (!*shrunk) {
            return SL_OK;
        }
        count = sli_number_pairs(g, t->mate, &t->clusters);
    }
    return sli_coarsen_clusters(g, count, &t->clusters, c, t->ranges, t->a);
}

#endif

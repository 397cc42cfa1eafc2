/* order_coarsen.h: ever smaller graphs, each made of the one before by joining vertices two by two */
#ifndef SLI_ORDER_COARSEN_H
#define SLI_ORDER_COARSEN_H

#include "alloc.h"
#include "symbolic_types.h"

/* A graph without loops or repeated edges. A vertex of a coarser level stands for some of the
 * finest, an edge for the finest edges between two of them. */
typedef struct sli_level {
    sl_int n;
    sl_off *begin;  /* n + 1 */
    sl_int *to;     /* begin[n] */
    sl_int *edge;   /* begin[n]: finest edges; NULL: 1 each */
    sl_int *weight; /* n: finest vertices; NULL: 1 each */
    sl_int *coarse; /* n: vertex of the next coarser level */
    void *block;    /* that all this is cut from */
} sli_level;

/* A level that keeps more than this share of its vertices is not worth its pass. */
#define SLI_COARSEN_STALL 0.95
#define SLI_LEVELS_MAX 64

SLI_INLINE sl_int sli_level_weight(const sli_level *g, sl_int v) {
    return g->weight == NULL ? 1 : g->weight[v];
}

SLI_INLINE sl_int sli_level_edge(const sli_level *g, sl_off e) {
    return g->edge == NULL ? 1 : g->edge[e];
}

/* A number that looks random, the same for the same v. */
SLI_INLINE uint32_t sli_scatter(uint32_t v) {
    v ^= v >> 16;
    v *= 0x7feb352du;
    v ^= v >> 15;
    v *= 0x846ca68bu;
    return v ^ v >> 16;
}

/* The free neighbour of v with the most edges a vertex, or -1. The search starts anywhere in the
 * list, so that pairs do not all lie in one direction. */
static sl_int sli_match_best(const sli_level *g, sl_int v, sl_int heaviest, const sl_int *mate) {
    const sl_off first = g->begin[v], degree = g->begin[v + 1] - first;
    const sl_int own = sli_level_weight(g, v);
    sl_int best = -1, best_edge = 0, best_weight = 1;
    sl_off k, e = degree > 0 ? first + (sl_off)(sli_scatter((uint32_t)v) % (uint64_t)degree) : 0;
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

/* mate[v] := the vertex that v joins, v itself if none. Vertices are visited in a scattered order,
 * but only within windows, which keeps memory close. Returns the number of pairs. */
static sl_int sli_match(const sli_level *g, sl_int heaviest, sl_int *mate) {
    const sl_int window = 512;
    sl_int first, k, v, pairs = 0;
    for (v = 0; v < g->n; v++) {
        mate[v] = -1;
    }
    for (first = 0; first < g->n; first += window) {
        const uint32_t turn = sli_scatter((uint32_t)first);
        for (k = 0; k < window; k++) {
            sl_int u;
            v = first + (sl_int)(((uint32_t)k * 197u + turn) & (uint32_t)(window - 1));
            if (v >= g->n || mate[v] != -1) {
                continue;
            }
            u = sli_match_best(g, v, heaviest, mate);
            if (u != -1) {
                mate[v] = u;
                mate[u] = v;
                pairs++;
            }
        }
        if (first > INT32_MAX - window) {
            break;
        }
    }
    return pairs;
}

/* Joins what is still alone through a common neighbour: the leaves of a star. */
static sl_int sli_match_over(const sli_level *g, sl_int heaviest, sl_int *mate) {
    sl_int v, pairs = 0;
    for (v = 0; v < g->n; v++) {
        sl_int waiting = -1;
        sl_off e;
        for (e = g->begin[v]; e < g->begin[v + 1]; e++) {
            const sl_int u = g->to[e];
            if (mate[u] != -1) {
                continue;
            }
            if (waiting != -1 &&
                sli_level_weight(g, u) <= heaviest - sli_level_weight(g, waiting)) {
                mate[u] = waiting;
                mate[waiting] = u;
                waiting = -1;
                pairs++;
            } else {
                waiting = u;
            }
        }
    }
    return pairs;
}

/* Numbers the pairs in the order of their first members; returns how many there are. */
static sl_int sli_number_pairs(const sli_level *g, const sl_int *mate) {
    sl_int v, count = 0;
    for (v = 0; v < g->n; v++) {
        const sl_int u = mate[v];
        g->coarse[v] = u == -1 || v <= u ? count++ : g->coarse[u];
    }
    return count;
}

/* Fills c, which has room, with the graph of the pairs. at: c->n of scratch. */
static void sli_contract(const sli_level *g, const sl_int *mate, sli_level *c, sl_off *at) {
    sl_int v, k, member[2];
    sl_off e, count = 0;
    for (k = 0; k < c->n; k++) {
        at[k] = -1;
    }
    for (v = 0, k = 0; v < g->n; v++) {
        const sl_off first = count;
        int m;
        if (mate[v] != -1 && mate[v] < v) {
            continue;
        }
        member[0] = v;
        member[1] = mate[v];
        c->begin[k] = first;
        c->weight[k] = 0;
        for (m = 0; m < 2 && member[m] != -1; m++) {
            c->weight[k] += sli_level_weight(g, member[m]);
            for (e = g->begin[member[m]]; e < g->begin[member[m] + 1]; e++) {
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
        k++;
    }
    c->begin[k] = count;
}

/* Makes the next level. scratch: g->n. *shrunk: whether there is one worth having. */
static sl_status sli_coarsen(const sli_level *g, sl_int heaviest, sli_level *c, sl_int *mate,
                             sl_off *at, int *shrunk, const sl_allocator *a) {
    sli_block b = {NULL, 0, 0};
    sl_status status = SL_OK;
    int pass;
    sl_int pairs = sli_match(g, heaviest, mate);
    if (pairs < g->n / 4) {
        pairs += sli_match_over(g, heaviest, mate);
    }
    memset(c, 0, sizeof *c);
    *shrunk = (double)(g->n - pairs) < SLI_COARSEN_STALL * (double)g->n;
    if (!*shrunk) {
        return SL_OK;
    }
    c->n = sli_number_pairs(g, mate);
    for (pass = 0; pass < 2 && status == SL_OK; pass++) {
        c->begin = SLI_TAKE(&b, sl_off, (size_t)c->n + 1);
        c->weight = SLI_TAKE(&b, sl_int, c->n);
        c->coarse = SLI_TAKE(&b, sl_int, c->n);
        c->to = SLI_TAKE(&b, sl_int, g->begin[g->n]);
        c->edge = SLI_TAKE(&b, sl_int, g->begin[g->n]);
        status = pass == 0 ? sli_block_alloc(&b, a) : SL_OK;
    }
    c->block = b.base;
    if (status == SL_OK) {
        sli_contract(g, mate, c, at);
    }
    return status;
}

/* What weighing a level needs: to, count: room for the finest edges; the others: n. */
typedef struct sli_weighing {
    sl_int *cluster, *member, *start, *seen, *to, *count; /* start: n + 1 */
    sl_off *at;
} sli_weighing;

/* Finest vertices by the vertex of level l that they are in. */
static void sli_weigh_members(const sli_level *levels, int l, sli_weighing *w) {
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

/* Makes the weight of an edge of level l the number of finest vertices at that border, of both
 * sides: what a separator takes. Finest edges would count a slanting border in a square grid twice
 * and a straight one once. */
static void sli_weigh_level(sli_level *levels, int l, sli_weighing *w) {
    const sli_level *finest = &levels[0];
    sli_level *g = &levels[l];
    sl_int k, i;
    sl_off e;
    sli_weigh_members(levels, l, w);
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
    /* so far the vertices of one side; the other side's come from the transposed lists */
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

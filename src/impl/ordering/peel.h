/* peel.h: rows with at most two neighbors are eliminated before anything else is ordered */
#ifndef SLI_ORDERING_PEEL_H
#define SLI_ORDERING_PEEL_H

#include "forest.h"
#include "graph.h"
#include "../base/alloc.h"

/* Rows are peeled if at least one row in this many has at most two neighbors. */
#define SLI_PEEL_SHARE 8
/* Where both ends have more neighbors, an edge is not searched for: it may then be there twice. */
#define SLI_PEEL_SEARCH 32
/* For many solves, this many rounds at most eliminate only rows with at most one neighbor: trees of
 * this height disappear without fill, and longer branches are halved. These rounds end once fewer
 * than one row in SLI_PEEL_ENDS is left to them. For little fill there is no limit. */
#define SLI_PEEL_LEAVES 8
#define SLI_PEEL_ENDS 256
/* Most entries of a column of L that belongs to an eliminated row. */
#define SLI_PEEL_ENTRIES 3

/* Eliminates rows in rounds. In a round no two neighbors are eliminated, so that a chain is halved
 * and a tree of n rows disappears in O(log n) rounds: that is the length of all paths in the
 * elimination tree [MR85]. A row with one neighbor has no fill; one with two has at most the edge
 * between them. All arrays have n entries, unless said otherwise. */
typedef struct sli_peel {
    sli_graph rest;      /* edges of the rows that are left: at first all, numbered as in G */
    sl_int *length;      /* entries in use in the list of a row */
    sl_int *degree;      /* neighbors left; -1: eliminated */
    sl_int *ends;        /* 2 n: the neighbors of an eliminated row; -1, -1: there is no edge */
    sl_int *stamp;       /* the last round that changed the row's list */
    sl_int *now, *later; /* rows that may be eliminated in this round, and in the next */
    sl_int *sequence;    /* the rows eliminated; then those that are left */
    sl_int count, n_later, round;
    sl_int most; /* neighbors of a row that may be eliminated */
} sli_peel;

static void sli_peel_layout(sli_peel *p, sli_block *b, sl_int n, sl_off edges) {
    p->rest.begin = SLI_TAKE(b, sl_off, (size_t)n + 1);
    p->rest.to = SLI_TAKE(b, sl_int, edges);
    p->length = SLI_TAKE(b, sl_int, n);
    p->degree = SLI_TAKE(b, sl_int, n);
    p->ends = SLI_TAKE(b, sl_int, 2 * (size_t)n);
    p->stamp = SLI_TAKE(b, sl_int, n);
    p->now = SLI_TAKE(b, sl_int, n);
    p->later = SLI_TAKE(b, sl_int, n);
    p->sequence = SLI_TAKE(b, sl_int, n);
}

/* Have enough rows at most two neighbors? */
static int sli_peel_is_worthwhile(const sli_graph *G) {
    sl_int v, few = 0;
    for (v = 0; v < G->n; v++) {
        few += G->begin[v + 1] - G->begin[v] <= 2;
    }
    return few > G->n / SLI_PEEL_SHARE;
}

/* The row that an entry of v's list leads to, past those that are eliminated, or -1. */
SLI_INLINE sl_int sli_peel_follow(const sli_peel *p, sl_int v, sl_int u) {
    while (u != -1 && p->degree[u] == -1) {
        const sl_int *ends = p->ends + 2 * (size_t)u;
        u = ends[0] == v ? ends[1] : ends[0];
    }
    return u;
}

/* Shortens the list of v to the rows that are left. */
static const sl_int *sli_peel_list(sli_peel *p, sl_int v) {
    sl_int *list = p->rest.to + p->rest.begin[v], k, kept = 0;
    for (k = 0; k < p->length[v]; k++) {
        const sl_int u = sli_peel_follow(p, v, list[k]);
        if (u != -1) {
            list[kept++] = u;
        }
    }
    p->length[v] = kept;
    return list;
}

static int sli_peel_has_edge(sli_peel *p, sl_int u, sl_int v) {
    const sl_int at = p->degree[u] < p->degree[v] ? u : v, other = at == u ? v : u;
    const sl_int *list;
    sl_int k = 0;
    if (p->degree[at] > SLI_PEEL_SEARCH) {
        return 0;
    }
    list = sli_peel_list(p, at);
    while (k < p->length[at] && list[k] != other) {
        k++;
    }
    return k < p->length[at];
}

/* The list of u has changed, and u has `fewer` neighbors less. */
SLI_INLINE void sli_peel_touch(sli_peel *p, sl_int u, sl_int fewer) {
    const int was_listed = p->stamp[u] == p->round && p->degree[u] <= p->most;
    p->degree[u] -= fewer;
    p->stamp[u] = p->round;
    if (p->degree[u] <= p->most && !was_listed) {
        p->later[p->n_later++] = u;
    }
}

/* Eliminates v, which has at most two neighbors. */
static void sli_peel_eliminate(sli_peel *p, sl_int v) {
    const sl_int *list = sli_peel_list(p, v);
    sl_int *ends = p->ends + 2 * (size_t)v;
    const sl_int count = p->length[v], a = count > 0 ? list[0] : -1, b = count > 1 ? list[1] : -1;
    const int is_joined = b != -1 && a != b && !sli_peel_has_edge(p, a, b);
    ends[0] = is_joined ? a : -1;
    ends[1] = is_joined ? b : -1;
    p->degree[v] = -1;
    p->sequence[p->count++] = v;
    if (b != -1 && a != b) {
        sli_peel_touch(p, a, !is_joined);
        sli_peel_touch(p, b, !is_joined);
    } else if (a != -1) {
        sli_peel_touch(p, a, count);
    }
}

/* Lists the rows that may be eliminated in the next round. */
static void sli_peel_list_rows(sli_peel *p, sl_int n, sl_int most) {
    sl_int v;
    p->most = most;
    p->n_later = 0;
    for (v = 0; v < n; v++) {
        p->later[p->n_later] = v;
        p->n_later += p->degree[v] != -1 && p->degree[v] <= most;
    }
}

/* Eliminates what is in `later`, except for rows whose neighbors are eliminated before them. */
static void sli_peel_round(sli_peel *p) {
    const sl_int count = p->n_later;
    sl_int k, *keep = p->now;
    p->now = p->later;
    p->later = keep;
    p->n_later = 0;
    p->round++;
    for (k = 0; k < count; k++) {
        if (p->stamp[p->now[k]] != p->round) { /* otherwise it is in `later` */
            sli_peel_eliminate(p, p->now[k]);
        }
    }
}

/* Eliminates rows with at most one neighbor until there are none. */
static void sli_peel_leaves(sli_peel *p, const sli_graph *G) {
    sl_int *only = p->now, v;
    sl_off e;
    for (v = 0; v < G->n; v++) {
        only[v] = 0;
        for (e = G->begin[v]; e < G->begin[v + 1]; e++) {
            only[v] ^= G->to[e];
        }
    }
    p->count = sli_forest_leaves(G->n, p->degree, only, p->sequence);
    for (v = 0; v < p->count; v++) {
        sl_int *ends = p->ends + 2 * (size_t)p->sequence[v];
        ends[0] = ends[1] = -1;
    }
}

/* Eliminates all rows that can be. */
static void sli_peel_run(sli_peel *p, const sli_graph *G, int for_little_fill) {
    const sl_int n = G->n;
    sl_int v;
    p->count = p->round = 0;
    for (v = 0; v < n; v++) {
        p->length[v] = p->degree[v] = (sl_int)(G->begin[v + 1] - G->begin[v]);
        p->stamp[v] = 0;
    }
    if (for_little_fill) {
        sli_peel_leaves(p, G);
    }
    if (p->count == n) {
        return;
    }
    memcpy(p->rest.begin, G->begin, ((size_t)n + 1) * sizeof(sl_off));
    memcpy(p->rest.to, G->to, (size_t)G->begin[n] * sizeof(sl_int));
    sli_peel_list_rows(p, n, 1);
    while (!for_little_fill && p->n_later > n / SLI_PEEL_ENDS && p->round < SLI_PEEL_LEAVES) {
        sli_peel_round(p);
    }
    sli_peel_list_rows(p, n, 2);
    while (p->n_later > 0) {
        sli_peel_round(p);
    }
}

/* Numbers the rows that are left in their order and makes `rest` their graph. */
static void sli_peel_finish(sli_peel *p, sl_int n) {
    sl_int v, k, *number = p->now, *seen = p->later, left = 0;
    sl_off to = 0;
    for (v = 0; v < n; v++) {
        if (p->degree[v] != -1) {
            sli_peel_list(p, v);
            p->sequence[p->count + left] = v;
            seen[left] = -1;
            number[v] = left++;
        }
    }
    for (k = 0; k < left; k++) {
        sl_off e = p->rest.begin[p->sequence[p->count + k]];
        const sl_off end = e + p->length[p->sequence[p->count + k]];
        p->rest.begin[k] = to;
        for (; e < end; e++) {
            const sl_int u = number[p->rest.to[e]];
            p->rest.to[to] = u;
            to += seen[u] != k;
            seen[u] = k;
        }
    }
    p->rest.begin[left] = to;
    p->rest.n = left;
}

/* Puts the rows eliminated before those that are left, whose order is in perm. */
static void sli_peel_expand(const sli_peel *p, sl_int *perm) {
    sl_int k;
    for (k = p->rest.n - 1; k >= 0; k--) {
        perm[p->count + k] = p->sequence[p->count + perm[k]];
    }
    memcpy(perm, p->sequence, (size_t)p->count * sizeof(sl_int));
}

#endif

/* order_leaves.h: minimum degree in the parts that are too small to dissect, on rows of bits */
#ifndef SLI_ORDER_LEAVES_H
#define SLI_ORDER_LEAVES_H

#include "order_coarsen.h"

#define SLI_LEAF_MAX 1024 /* vertices of a leaf that is ordered; larger ones keep their order */

/* A leaf with its halo: the vertices of separators round it, which are eliminated later and so
 * count in every degree. */
typedef struct sli_leaf {
    sl_int n;       /* own vertices: bits 0..n-1; halo bits follow */
    size_t words;   /* 64-bit words a row */
    uint64_t *rows; /* n x words: the graph of what is left */
    sl_int *degree; /* n; -1 once eliminated */
    size_t room;    /* words in rows */
} sli_leaf;

SLI_INLINE sl_int sli_bits(uint64_t w) {
#if defined(__GNUC__) && defined(__POPCNT__)
    return (sl_int)__builtin_popcountll(w);
#else
    w -= w >> 1 & 0x5555555555555555u;
    w = (w & 0x3333333333333333u) + (w >> 2 & 0x3333333333333333u);
    w = (w + (w >> 4)) & 0x0f0f0f0f0f0f0f0fu;
    return (sl_int)(w * 0x0101010101010101u >> 56);
#endif
}

SLI_INLINE sl_int sli_lowest_bit(uint64_t w) {
#if defined(__GNUC__)
    return (sl_int)__builtin_ctzll(w);
#else
    return sli_bits((w & (0 - w)) - 1);
#endif
}

SLI_INLINE sl_int sli_leaf_degree(const sli_leaf *l, sl_int v) {
    const uint64_t *row = l->rows + (size_t)v * l->words;
    sl_int degree = 0;
    size_t k;
    for (k = 0; k < l->words; k++) {
        degree += sli_bits(row[k]);
    }
    return degree;
}

/* Takes v out: its neighbours become neighbours of each other. */
static void sli_leaf_eliminate(sli_leaf *l, sl_int v) {
    const uint64_t *row = l->rows + (size_t)v * l->words;
    size_t k, own = ((size_t)l->n + 63) / 64, w;
    l->degree[v] = -1;
    for (k = 0; k < own; k++) {
        uint64_t bits = row[k];
        while (bits != 0) {
            const sl_int u = (sl_int)(64 * k) + sli_lowest_bit(bits);
            uint64_t *other = l->rows + (size_t)u * l->words;
            bits &= bits - 1;
            if (u >= l->n) {
                break;
            }
            for (w = 0; w < l->words; w++) {
                other[w] |= row[w];
            }
            other[(size_t)u / 64] &= ~((uint64_t)1 << (u % 64));
            other[(size_t)v / 64] &= ~((uint64_t)1 << (v % 64));
            l->degree[u] = sli_leaf_degree(l, u);
        }
    }
}

/* The first vertex of the fewest neighbours, which are no fewer than bound. */
static sl_int sli_leaf_best(const sli_leaf *l, sl_int bound) {
    sl_int v, best = -1;
    for (v = 0; v < l->n; v++) {
        if (l->degree[v] >= 0 && (best == -1 || l->degree[v] < l->degree[best])) {
            best = v;
            if (l->degree[v] <= bound) {
                break;
            }
        }
    }
    return best;
}

/* The graph of a leaf as rows of bits; whether there is room for it. place: for each vertex of g -1
 * on entry and on return. */
static int sli_leaf_fill(sli_leaf *l, const sli_level *g, const sl_int *vertices, sl_int count,
                         sl_int *place) {
    sl_int k, bits = count;
    sl_off e;
    int fits;
    for (k = 0; k < count; k++) {
        place[vertices[k]] = k;
    }
    for (k = 0; k < count; k++) {
        for (e = g->begin[vertices[k]]; e < g->begin[vertices[k] + 1]; e++) {
            if (place[g->to[e]] == -1) {
                place[g->to[e]] = bits++;
            }
        }
    }
    l->n = count;
    l->words = ((size_t)bits + 63) / 64;
    fits = count <= SLI_LEAF_MAX && l->words * (size_t)count <= l->room;
    if (fits) {
        memset(l->rows, 0, l->words * (size_t)count * sizeof(uint64_t));
    }
    for (k = 0; k < count && fits; k++) {
        uint64_t *row = l->rows + (size_t)k * l->words;
        for (e = g->begin[vertices[k]]; e < g->begin[vertices[k] + 1]; e++) {
            const sl_int b = place[g->to[e]];
            row[b / 64] |= (uint64_t)1 << (b % 64);
        }
        l->degree[k] = sli_leaf_degree(l, k);
    }
    for (k = 0; k < count; k++) {
        for (e = g->begin[vertices[k]]; e < g->begin[vertices[k] + 1]; e++) {
            place[g->to[e]] = -1;
        }
        place[vertices[k]] = -1;
    }
    return fits;
}

/* Reorders vertices, all of one leaf, in place: always the one with the fewest neighbours next.
 * order: count of scratch. */
static void sli_leaf_order(sli_leaf *l, const sli_level *g, sl_int *vertices, sl_int count,
                           sl_int *place, sl_int *order) {
    sl_int k, least = 0;
    if (!sli_leaf_fill(l, g, vertices, count, place)) {
        return;
    }
    for (k = 0; k < count; k++) {
        const sl_int best = sli_leaf_best(l, k == 0 ? 0 : least - 1);
        least = l->degree[best];
        order[k] = vertices[best];
        sli_leaf_eliminate(l, best);
    }
    memcpy(vertices, order, (size_t)count * sizeof(sl_int));
}

#endif

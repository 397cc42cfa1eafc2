/* order_leaves.h: minimum degree in the parts that are too small to dissect, on rows of bits */
#ifndef SLI_ORDER_LEAVES_H
#define SLI_ORDER_LEAVES_H

#include "cpu.h"
#include "order_coarsen.h"

#define SLI_LEAF_MAX 1024 /* vertices of a leaf that is ordered; larger ones keep their order */
#define SLI_LEAF_GONE UINT32_MAX

/* A leaf with its halo: the vertices of separators round it, which are eliminated later and so
 * count in every degree. */
typedef struct sli_leaf {
    sl_int n;                          /* own vertices: bits 0..n-1; halo bits follow */
    size_t words;                      /* 64-bit words a row */
    uint64_t *rows;                    /* n x words: the graph of what is left, with its diagonal */
    uint32_t *key;                     /* n: degree, then number; SLI_LEAF_GONE once eliminated */
    size_t room;                       /* words in rows */
    uint64_t alive[SLI_LEAF_MAX / 64]; /* own vertices that are not eliminated */
    int has_popcnt;                    /* any processor with AVX2 has that instruction */
} sli_leaf;

/* Bits of a word: one instruction in functions compiled for it, see below. */
SLI_ALWAYS_INLINE uint32_t sli_bits(uint64_t w) {
#if defined(__GNUC__)
    return (uint32_t)__builtin_popcountll(w);
#else
    w -= w >> 1 & 0x5555555555555555u;
    w = (w & 0x3333333333333333u) + (w >> 2 & 0x3333333333333333u);
    w = (w + (w >> 4)) & 0x0f0f0f0f0f0f0f0fu;
    return (uint32_t)(w * 0x0101010101010101u >> 56);
#endif
}

SLI_ALWAYS_INLINE sl_int sli_lowest_bit(uint64_t w) {
#if defined(__GNUC__)
    return (sl_int)__builtin_ctzll(w);
#else
    return (sl_int)sli_bits((w & (0 - w)) - 1);
#endif
}

/* other |= row without bit v; the degree, of which row v is part. */
SLI_ALWAYS_INLINE uint32_t sli_leaf_join(uint64_t *other, const uint64_t *row, size_t words,
                                         sl_int v) {
    uint32_t degree = 0;
    size_t k;
    other[v / 64] &= ~((uint64_t)1 << (v % 64));
    for (k = 0; k < words; k++) {
        other[k] |= row[k];
        degree += sli_bits(other[k]);
    }
    return degree - 1;
}

/* Takes v out, and with it all that have no other neighbours than v has: the neighbours of v become
 * neighbours of each other. Appends them to order[at] on; where that ends. */
SLI_ALWAYS_INLINE sl_int sli_leaf_eliminate(sli_leaf *l, sl_int v, sl_int *order, sl_int at) {
    const uint32_t degree = l->key[v] / SLI_LEAF_MAX;
    const size_t own = ((size_t)l->n + 63) / 64;
    uint64_t *row = l->rows + (size_t)v * l->words, gone[SLI_LEAF_MAX / 64];
    const sl_int first = at;
    size_t k, w;
    memset(gone, 0, own * sizeof(uint64_t));
    row[v / 64] &= ~((uint64_t)1 << (v % 64));
    l->key[v] = SLI_LEAF_GONE;
    order[at++] = v;
    for (k = 0; k < own; k++) {
        uint64_t bits = row[k] & l->alive[k];
        for (; bits != 0; bits &= bits - 1) {
            const sl_int u = (sl_int)(64 * k) + sli_lowest_bit(bits);
            const uint32_t now = sli_leaf_join(l->rows + (size_t)u * l->words, row, l->words, v);
            l->key[u] = now * SLI_LEAF_MAX + (uint32_t)u;
            if (now + 1 == degree) { /* the clique of v, and nothing else */
                l->key[u] = SLI_LEAF_GONE;
                gone[k] |= (uint64_t)1 << (u % 64);
                order[at++] = u;
            }
        }
    }
    l->alive[v / 64] &= ~((uint64_t)1 << (v % 64));
    for (k = 0; k < own && at > first + 1; k++) {
        uint64_t bits = row[k] & l->alive[k] & ~gone[k];
        for (; bits != 0; bits &= bits - 1) {
            const sl_int u = (sl_int)(64 * k) + sli_lowest_bit(bits);
            uint64_t *other = l->rows + (size_t)u * l->words;
            for (w = 0; w < own; w++) {
                other[w] &= ~gone[w];
            }
            l->key[u] -= (uint32_t)(at - first - 1) * SLI_LEAF_MAX;
        }
    }
    for (k = 0; k < own; k++) {
        l->alive[k] &= ~gone[k];
    }
    return at;
}

/* The first vertex of the fewest neighbours. */
SLI_INLINE sl_int sli_leaf_best(const sli_leaf *l) {
    uint32_t least[4] = {SLI_LEAF_GONE, SLI_LEAF_GONE, SLI_LEAF_GONE, SLI_LEAF_GONE};
    sl_int v = 0, k;
    for (; v <= l->n - 4; v += 4) {
        for (k = 0; k < 4; k++) {
            least[k] = l->key[v + k] < least[k] ? l->key[v + k] : least[k];
        }
    }
    for (; v < l->n; v++) {
        least[0] = l->key[v] < least[0] ? l->key[v] : least[0];
    }
    for (k = 1; k < 4; k++) {
        least[0] = least[k] < least[0] ? least[k] : least[0];
    }
    return (sl_int)(least[0] % SLI_LEAF_MAX);
}

/* order: the vertices in the order of elimination. */
SLI_ALWAYS_INLINE void sli_leaf_run_body(sli_leaf *l, sl_int *order) {
    sl_int at = 0;
    while (at < l->n) {
        at = sli_leaf_eliminate(l, sli_leaf_best(l), order, at);
    }
}

static void sli_leaf_run(sli_leaf *l, sl_int *order) {
    sli_leaf_run_body(l, order);
}

#if defined(SLI_X86)
SLI_TARGET("popcnt") static void sli_leaf_run_popcnt(sli_leaf *l, sl_int *order) {
    sli_leaf_run_body(l, order);
}
#endif

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
        memset(l->alive, 0, sizeof l->alive);
        memset(l->rows, 0, l->words * (size_t)count * sizeof(uint64_t));
    }
    for (k = 0; k < count && fits; k++) {
        uint64_t *row = l->rows + (size_t)k * l->words;
        for (e = g->begin[vertices[k]]; e < g->begin[vertices[k] + 1]; e++) {
            const sl_int b = place[g->to[e]];
            row[b / 64] |= (uint64_t)1 << (b % 64);
        }
        l->key[k] = (sli_leaf_join(row, row, l->words, k) + 1) * SLI_LEAF_MAX + (uint32_t)k;
        row[k / 64] |= (uint64_t)1 << (k % 64);
        l->alive[k / 64] |= (uint64_t)1 << (k % 64);
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
    sl_int k;
    if (!sli_leaf_fill(l, g, vertices, count, place)) {
        return;
    }
#if defined(SLI_X86)
    if (l->has_popcnt) {
        sli_leaf_run_popcnt(l, order);
    } else
#endif
    {
        sli_leaf_run(l, order);
    }
    for (k = 0; k < count; k++) {
        order[k] = vertices[order[k]];
    }
    memcpy(vertices, order, (size_t)count * sizeof(sl_int));
}

#endif

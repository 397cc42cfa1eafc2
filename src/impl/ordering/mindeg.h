/* mindeg.h: minimum degree ordering of leaf subgraphs, with the graph as a bit matrix */
#ifndef SLI_ORDERING_MINDEG_H
#define SLI_ORDERING_MINDEG_H

#include "../kernels/dispatch.h"
#include "coarsen.h"

#define SLI_MINDEG_MAX 1024 /* most vertices of a leaf; larger leaves keep their order */
#define SLI_MINDEG_ELIMINATED UINT32_MAX

/* A leaf subgraph and its halo, the vertices of surrounding separators. They are eliminated later,
 * so that they count in every degree. */
typedef struct sli_mindeg {
    sl_int n;       /* vertices of the leaf: bits 0..n-1; the halo follows */
    size_t words;   /* 64-bit words of a row */
    uint64_t *rows; /* n x words: adjacency matrix with diagonal */
    uint32_t *key;  /* n: degree, then number; SLI_MINDEG_ELIMINATED once eliminated, and up to a
                       multiple of 8 */
    size_t room;    /* words available in rows */
    uint64_t alive[SLI_MINDEG_MAX / 64]; /* vertices of the leaf not yet eliminated */
    int has_avx2;                        /* and with it an instruction that counts bits */
    sl_int *local; /* of each vertex of the graph: -1, but for those that have numbers */
    sl_int *order; /* scratch for all vertices of the graph */
    sl_int *bit;   /* scratch for all edges of a leaf: its neighbors, by their numbers */
} sli_mindeg;

/* The number of bits set: one instruction where the function that inlines this is compiled for it,
 * see sli_mindeg_run_avx2. */
SLI_ALWAYS_INLINE uint32_t sli_popcount(uint64_t w) {
#if defined(SLI_GNU)
    return (uint32_t)__builtin_popcountll(w);
#else
    w -= w >> 1 & 0x5555555555555555u;
    w = (w & 0x3333333333333333u) + (w >> 2 & 0x3333333333333333u);
    w = (w + (w >> 4)) & 0x0f0f0f0f0f0f0f0fu;
    return (uint32_t)(w * 0x0101010101010101u >> 56);
#endif
}

SLI_ALWAYS_INLINE sl_int sli_lowest_bit(uint64_t w) {
#if defined(SLI_GNU)
    return (sl_int)__builtin_ctzll(w);
#else
    return (sl_int)sli_popcount((w & (0 - w)) - 1);
#endif
}

/* other |= row, without bit v. Returns the new degree; `other` includes its own diagonal bit. */
SLI_ALWAYS_INLINE uint32_t sli_mindeg_join(uint64_t *other, const uint64_t *row, size_t words,
                                           sl_int v) {
    uint32_t degree = 0;
    size_t k;
    other[v / 64] &= ~((uint64_t)1 << (v % 64));
    for (k = 0; k < words; k++) {
        other[k] |= row[k];
        degree += sli_popcount(other[k]);
    }
    return degree - 1;
}

/* Eliminates v: its neighbors become a clique. Vertices whose neighbors are then just that clique
 * are indistinguishable from v and eliminated with it (mass elimination). Appends all of them to
 * order from `at` on and returns the new end. */
SLI_ALWAYS_INLINE sl_int sli_mindeg_eliminate(sli_mindeg *m, sl_int v, sl_int *order, sl_int at) {
    const uint32_t degree = m->key[v] / SLI_MINDEG_MAX;
    const size_t leaf_words = ((size_t)m->n + 63) / 64;
    uint64_t *row = m->rows + (size_t)v * m->words, eliminated[SLI_MINDEG_MAX / 64];
    const sl_int first = at;
    size_t k, w;
    memset(eliminated, 0, leaf_words * sizeof(uint64_t));
    row[v / 64] &= ~((uint64_t)1 << (v % 64));
    m->key[v] = SLI_MINDEG_ELIMINATED;
    order[at++] = v;
    for (k = 0; k < leaf_words; k++) {
        uint64_t bits = row[k] & m->alive[k];
        for (; bits != 0; bits &= bits - 1) {
            const sl_int u = (sl_int)(64 * k) + sli_lowest_bit(bits);
            const uint32_t now = sli_mindeg_join(m->rows + (size_t)u * m->words, row, m->words, v);
            m->key[u] = now * SLI_MINDEG_MAX + (uint32_t)u;
            if (now + 1 == degree) { /* adjacent to the clique of v and to nothing else */
                m->key[u] = SLI_MINDEG_ELIMINATED;
                eliminated[k] |= (uint64_t)1 << (u % 64);
                order[at++] = u;
            }
        }
    }
    m->alive[v / 64] &= ~((uint64_t)1 << (v % 64));
    for (k = 0; k < leaf_words && at > first + 1; k++) {
        uint64_t bits = row[k] & m->alive[k] & ~eliminated[k];
        for (; bits != 0; bits &= bits - 1) {
            const sl_int u = (sl_int)(64 * k) + sli_lowest_bit(bits);
            uint64_t *other = m->rows + (size_t)u * m->words;
            for (w = 0; w < leaf_words; w++) {
                other[w] &= ~eliminated[w];
            }
            m->key[u] -= (uint32_t)(at - first - 1) * SLI_MINDEG_MAX;
        }
    }
    for (k = 0; k < leaf_words; k++) {
        m->alive[k] &= ~eliminated[k];
    }
    return at;
}

/* The vertex of minimum degree, the one with the smallest number among several. */
SLI_ALWAYS_INLINE sl_int sli_mindeg_best(const sli_mindeg *m) {
    uint32_t least[8];
    sl_int v, k;
    memcpy(least, m->key, sizeof least);
    for (v = 8; v < m->n; v += 8) {
        for (k = 0; k < 8; k++) {
            least[k] = m->key[v + k] < least[k] ? m->key[v + k] : least[k];
        }
    }
    for (k = 0; k < 4; k++) {
        least[k] = least[k + 4] < least[k] ? least[k + 4] : least[k];
    }
    for (k = 1; k < 4; k++) {
        least[0] = least[k] < least[0] ? least[k] : least[0];
    }
    return (sl_int)(least[0] % SLI_MINDEG_MAX);
}

/* order := the vertices in the order of elimination. */
SLI_ALWAYS_INLINE void sli_mindeg_run_body(sli_mindeg *m, sl_int *order) {
    sl_int at = 0;
    while (at < m->n) {
        at = sli_mindeg_eliminate(m, sli_mindeg_best(m), order, at);
    }
}

static void sli_mindeg_run(sli_mindeg *m, sl_int *order) {
    sli_mindeg_run_body(m, order);
}

#if defined(SLI_X86) && defined(SLI_GNU)
SLI_TARGET("avx2,popcnt") static void sli_mindeg_run_avx2(sli_mindeg *m, sl_int *order) {
    sli_mindeg_run_body(m, order);
}
#endif

/* Numbers the vertices of a leaf, and after them those of its halo. m->bit := the numbers of all
 * neighbors, one vertex after the other; m->order := the vertices of the halo. Returns how many
 * vertices have numbers. */
static sl_int sli_mindeg_number(const sli_mindeg *m, const sli_level *g, const sl_int *vertices,
                                sl_int count) {
    sl_int k, bits = count, *local = m->local, *bit = m->bit, *halo = m->order;
    sl_off e;
    for (k = 0; k < count; k++) {
        local[vertices[k]] = k;
    }
    for (k = 0; k < count; k++) {
        for (e = g->begin[vertices[k]]; e < g->begin[vertices[k] + 1]; e++) {
            const sl_int u = g->to[e], known = local[u], b = known == -1 ? bits : known;
            halo[bits - count] = u; /* counts only if u is new: a branch would be mispredicted */
            local[u] = b;
            *bit++ = b;
            bits += known == -1;
        }
    }
    return bits;
}

/* Fills the bit matrix of a leaf. Returns whether it fits. */
static int sli_mindeg_fill(sli_mindeg *m, const sli_level *g, const sl_int *vertices,
                           sl_int count) {
    const sl_int bits = sli_mindeg_number(m, g, vertices, count), *bit = m->bit;
    sl_int k;
    sl_off e;
    int fits;
    m->n = count;
    m->words = ((size_t)bits + 63) / 64;
    fits = count <= SLI_MINDEG_MAX && m->words * (size_t)count <= m->room;
    if (fits) {
        memset(m->alive, 0, sizeof m->alive);
        for (k = count; k % 8 != 0; k++) {
            m->key[k] = SLI_MINDEG_ELIMINATED;
        }
        memset(m->rows, 0, m->words * (size_t)count * sizeof(uint64_t));
    }
    for (k = 0; k < count && fits; k++) {
        const sl_off degree = g->begin[vertices[k] + 1] - g->begin[vertices[k]];
        uint64_t *row = m->rows + (size_t)k * m->words;
        for (e = 0; e < degree; e++) {
            const uint32_t b = (uint32_t)bit[e];
            row[b / 64] |= (uint64_t)1 << (b % 64);
        }
        bit += degree;
        m->key[k] = (uint32_t)degree * SLI_MINDEG_MAX + (uint32_t)k;
        row[k / 64] |= (uint64_t)1 << (k % 64);
        m->alive[k / 64] |= (uint64_t)1 << (k % 64);
    }
    for (k = 0; k < count; k++) {
        m->local[vertices[k]] = -1;
    }
    for (k = 0; k < bits - count; k++) {
        m->local[m->order[k]] = -1;
    }
    return fits;
}

/* Reorders the vertices of a leaf in place by minimum degree. */
static void sli_mindeg_order(sli_mindeg *m, const sli_level *g, sl_int *vertices, sl_int count) {
    sl_int k, *order = m->order;
    if (!sli_mindeg_fill(m, g, vertices, count)) {
        return;
    }
#if defined(SLI_X86) && defined(SLI_GNU)
    if (m->has_avx2) {
        sli_mindeg_run_avx2(m, order);
    } else
#endif
    {
        sli_mindeg_run(m, order);
    }
    for (k = 0; k < count; k++) {
        order[k] = vertices[order[k]];
    }
    SLI_COPY(vertices, order, count);
}

#endif

/* heap.h: a priority queue of vertices by gain, the largest gain first */
#ifndef SLI_ORDERING_HEAP_H
#define SLI_ORDERING_HEAP_H

#include "../base/base.h"

typedef struct sli_heap_item {
    sl_int key, vertex;
} sli_heap_item;

/* A binary heap. Several heaps may share `position`, because a vertex is in at most one of them. */
typedef struct sli_heap {
    sl_int count;
    sli_heap_item *item; /* count; item[0] has the largest key */
    sl_int *position;    /* by vertex: its index in item, or -1 */
} sli_heap;

SLI_INLINE void sli_heap_up(sli_heap *h, sl_int k, sli_heap_item v) {
    while (k > 0 && h->item[(k - 1) / 2].key < v.key) {
        h->item[k] = h->item[(k - 1) / 2];
        h->position[h->item[k].vertex] = k;
        k = (k - 1) / 2;
    }
    h->item[k] = v;
    h->position[v.vertex] = k;
}

SLI_INLINE void sli_heap_down(sli_heap *h, sl_int k, sli_heap_item v) {
    for (;;) {
        sl_int c = 2 * k + 1;
        if (c >= h->count) {
            break;
        }
        c += c + 1 < h->count && h->item[c + 1].key > h->item[c].key;
        if (h->item[c].key <= v.key) {
            break;
        }
        h->item[k] = h->item[c];
        h->position[h->item[k].vertex] = k;
        k = c;
    }
    h->item[k] = v;
    h->position[v.vertex] = k;
}

/* Adds v, or gives it another key. */
SLI_INLINE void sli_heap_set(sli_heap *h, sl_int vertex, sl_int key) {
    const sl_int k = h->position[vertex] == -1 ? h->count++ : h->position[vertex];
    sli_heap_item v;
    v.vertex = vertex;
    v.key = key;
    if (k > 0 && h->item[(k - 1) / 2].key < key) {
        sli_heap_up(h, k, v);
    } else {
        sli_heap_down(h, k, v);
    }
}

SLI_INLINE void sli_heap_remove(sli_heap *h, sl_int vertex) {
    const sl_int k = h->position[vertex];
    const sli_heap_item last = h->item[--h->count];
    h->position[vertex] = -1;
    if (last.vertex != vertex) {
        h->position[last.vertex] = k;
        sli_heap_set(h, last.vertex, last.key);
    }
}

#endif

/* heap.h: a priority queue of vertices by gain, the largest gain first */
#ifndef SLI_ORDERING_HEAP_H
#define SLI_ORDERING_HEAP_H

#include "../base/base.h"

/* A binary heap. Several heaps may share `position` and `key`, because a vertex is in at most one
 * of them. */
typedef struct sli_heap {
    sl_int count;
    sl_int *item;     /* count; item[0] has the largest key */
    sl_int *position; /* by vertex: its index in item, or -1 */
    sl_int *key;      /* by vertex: its gain */
} sli_heap;

SLI_INLINE void sli_heap_up(sli_heap *h, sl_int k, sl_int v) {
    while (k > 0 && h->key[h->item[(k - 1) / 2]] < h->key[v]) {
        h->item[k] = h->item[(k - 1) / 2];
        h->position[h->item[k]] = k;
        k = (k - 1) / 2;
    }
    h->item[k] = v;
    h->position[v] = k;
}

SLI_INLINE void sli_heap_down(sli_heap *h, sl_int k, sl_int v) {
    for (;;) {
        sl_int c = 2 * k + 1;
        if (c >= h->count) {
            break;
        }
        c += c + 1 < h->count && h->key[h->item[c + 1]] > h->key[h->item[c]];
        if (h->key[h->item[c]] <= h->key[v]) {
            break;
        }
        h->item[k] = h->item[c];
        h->position[h->item[k]] = k;
        k = c;
    }
    h->item[k] = v;
    h->position[v] = k;
}

SLI_INLINE void sli_heap_add(sli_heap *h, sl_int v) {
    sli_heap_up(h, h->count++, v);
}

/* Restores the heap after key[v] has changed. */
SLI_INLINE void sli_heap_update(sli_heap *h, sl_int v) {
    const sl_int k = h->position[v];
    if (k > 0 && h->key[h->item[(k - 1) / 2]] < h->key[v]) {
        sli_heap_up(h, k, v);
    } else {
        sli_heap_down(h, k, v);
    }
}

SLI_INLINE void sli_heap_remove(sli_heap *h, sl_int v) {
    const sl_int k = h->position[v], last = h->item[--h->count];
    h->position[v] = -1;
    if (last != v) {
        h->position[last] = k;
        h->item[k] = last;
        sli_heap_update(h, last);
    }
}

#endif

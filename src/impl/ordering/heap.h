/* order_heap.h: a queue of vertices by gain, the largest first */
#ifndef SLI_ORDER_HEAP_H
#define SLI_ORDER_HEAP_H

#include "base.h"

/* A binary heap over arrays that several heaps may share: a vertex is in one of them at most. */
typedef struct sli_heap {
    sl_int count;
    sl_int *item;  /* count, item[0] has the largest key */
    sl_int *place; /* a vertex: where it stands in item, -1 if nowhere */
    sl_int *key;   /* a vertex: its gain */
} sli_heap;

SLI_INLINE void sli_heap_up(sli_heap *h, sl_int k, sl_int v) {
    while (k > 0 && h->key[h->item[(k - 1) / 2]] < h->key[v]) {
        h->item[k] = h->item[(k - 1) / 2];
        h->place[h->item[k]] = k;
        k = (k - 1) / 2;
    }
    h->item[k] = v;
    h->place[v] = k;
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
        h->place[h->item[k]] = k;
        k = c;
    }
    h->item[k] = v;
    h->place[v] = k;
}

SLI_INLINE void sli_heap_add(sli_heap *h, sl_int v) {
    sli_heap_up(h, h->count++, v);
}

/* After key[v] has changed. */
SLI_INLINE void sli_heap_settle(sli_heap *h, sl_int v) {
    const sl_int k = h->place[v];
    if (k > 0 && h->key[h->item[(k - 1) / 2]] < h->key[v]) {
        sli_heap_up(h, k, v);
    } else {
        sli_heap_down(h, k, v);
    }
}

SLI_INLINE void sli_heap_remove(sli_heap *h, sl_int v) {
    const sl_int k = h->place[v], last = h->item[--h->count];
    h->place[v] = -1;
    if (last != v) {
        h->place[last] = k;
        h->item[k] = last;
        sli_heap_settle(h, last);
    }
}

#endif

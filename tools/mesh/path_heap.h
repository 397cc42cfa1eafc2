/* path_heap.h: a binary heap of paths for Dijkstra's algorithm, the shortest on top */
#ifndef TOOLS_PATH_HEAP_H
#define TOOLS_PATH_HEAP_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>

/** The end of a path: a vertex, or another point that the caller numbers. */
typedef struct path_end {
    double length;
    int64_t point;
} path_end;

/** All zero is an empty heap; release with free(at). A point may be in it several times: it is
 *  pushed again when a shorter path to it is found. */
typedef struct path_heap {
    path_end *at;
    size_t count;
    size_t capacity; /* elements at `at` */
} path_heap;

/** Adds a path.
 *
 *  Returns  true; false: out of memory, the heap is unchanged.
 */
static inline bool path_heap_push(path_heap *h, double length, int64_t point) {
    if (h->count == h->capacity) {
        size_t wanted = h->capacity < 64 ? 64 : 2 * h->capacity;
        path_end *larger = (path_end *)realloc(h->at, wanted * sizeof *larger);
        if (larger == NULL) {
            return false;
        }
        h->at = larger;
        h->capacity = wanted;
    }
    size_t at = h->count++;
    for (; at > 0 && h->at[(at - 1) / 2].length > length; at = (at - 1) / 2) {
        h->at[at] = h->at[(at - 1) / 2];
    }
    path_end e = {length, point};
    h->at[at] = e;
    return true;
}

/** Removes the shortest path of a heap that is not empty. */
static inline path_end path_heap_pop(path_heap *h) {
    path_end top = h->at[0], last = h->at[--h->count];
    size_t at = 0;
    for (size_t child = 1; child < h->count; child = 2 * at + 1) {
        child += child + 1 < h->count && h->at[child + 1].length < h->at[child].length;
        if (h->at[child].length >= last.length) {
            break;
        }
        h->at[at] = h->at[child];
        at = child;
    }
    h->at[at] = last;
    return top;
}

#endif

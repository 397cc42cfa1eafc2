/* dissection.c: the separators of a nested dissection, found again in the elimination tree */
#include "dissection.h"

#include <stdlib.h>

enum {
    SHARE = 10,
    SMALLEST = 4
}; /* a part has at least 1/SHARE of its region, a region that many columns */

/* The children of column k are first[k], next[first[k]], ...; size[k]: columns of its subtree. */
typedef struct tree {
    sl_int *first, *next, *size;
} tree;

static bool make_tree(tree *t, const sl_symbolic_view_t *view) {
    size_t n = (size_t)view->n;
    t->first = (sl_int *)malloc((n + 1) * sizeof *t->first);
    t->next = (sl_int *)malloc((n + 1) * sizeof *t->next);
    t->size = (sl_int *)malloc((n + 1) * sizeof *t->size);
    if (t->first == NULL || t->next == NULL || t->size == NULL) {
        return false;
    }
    for (sl_int k = 0; k < view->n; k++) {
        t->first[k] = -1;
        t->next[k] = -1;
        t->size[k] = 1;
    }
    for (sl_int k = 0; k < view->n; k++) { /* children come before their parents */
        sl_int up = view->parent[k];
        if (up >= 0) {
            t->next[k] = t->first[up];
            t->first[up] = k;
            t->size[up] += t->size[k];
        }
    }
    return true;
}

/* The largest child of k, and the size of the second; -1 and 0 where there are none. */
static sl_int heaviest_child(const tree *t, sl_int k, sl_int *second) {
    sl_int best = -1, best_size = 0;
    *second = 0;
    for (sl_int c = t->first[k]; c >= 0; c = t->next[c]) {
        if (t->size[c] > best_size) {
            *second = best_size;
            best_size = t->size[c];
            best = c;
        } else if (t->size[c] > *second) {
            *second = t->size[c];
        }
    }
    return best;
}

/* Marks the chain from the root of a region to the column where it falls apart; -1 if it never does (then no mark). */
static sl_int mark_separator(sl_int *level, const tree *t, sl_int root, sl_int depth) {
    sl_int region = t->size[root], second = 0, end = root;
    for (sl_int c = heaviest_child(t, end, &second); (int64_t)second * SHARE < region;
         c = heaviest_child(t, end, &second)) {
        if (c < 0) {
            return -1;
        }
        end = c;
    }
    for (sl_int k = root;; k = heaviest_child(t, k, &second)) {
        level[k] = depth;
        if (k == end) {
            return end;
        }
    }
}

sl_int dissection_levels(sl_int *level, const sl_symbolic_view_t *view, sl_int most) {
    tree t = {NULL, NULL, NULL};
    sl_int *regions = (sl_int *)malloc(((size_t)view->n + 1) * sizeof *regions);
    sl_int *depths = (sl_int *)malloc(((size_t)view->n + 1) * sizeof *depths);
    sl_int found = -1, waiting = 0;
    if (make_tree(&t, view) && regions != NULL && depths != NULL) {
        found = 0;
        for (sl_int k = 0; k < view->n; k++) {
            level[k] = -1;
            if (view->parent[k] < 0) {
                regions[waiting] = k;
                depths[waiting++] = 0;
            }
        }
        while (waiting > 0) {
            sl_int root = regions[--waiting], depth = depths[waiting];
            sl_int end = t.size[root] >= SMALLEST ? mark_separator(level, &t, root, depth) : -1;
            if (end < 0) {
                continue;
            }
            found = depth + 1 > found ? depth + 1 : found;
            for (sl_int c = t.first[end]; c >= 0 && depth + 1 < most; c = t.next[c]) {
                if ((int64_t)t.size[c] * SHARE >= t.size[root]) {
                    regions[waiting] = c;
                    depths[waiting++] = depth + 1;
                }
            }
        }
    }
    free(depths);
    free(regions);
    free(t.size);
    free(t.next);
    free(t.first);
    return found;
}

/* order_tree.h: the tree of separators over one graph: a label a vertex, and who stands at which border */
#ifndef SLI_ORDER_TREE_H
#define SLI_ORDER_TREE_H

#include "order_coarsen.h"

/* A node is a separator, a leaf a part without one. After sli_tree_number nodes are numbered from
 * left to right, so that a subtree is an interval: whether a vertex is below t, and on which side,
 * is seen from its label alone, in the one graph that all nodes share. */
typedef struct sli_tree {
    sl_int count, room;
    sl_int root;
    sl_int *parent;       /* -1 at the root */
    sl_int *left, *right; /* -1 at a leaf */
    sl_int *low, *high;   /* the subtree is low..high */
    sl_int *weight;       /* finest vertices in the subtree */
    sl_int *scratch;      /* 2 room */
} sli_tree;

static void sli_tree_layout(sli_tree *t, sli_block *b, sl_int room) {
    t->room = room;
    t->parent = SLI_TAKE(b, sl_int, room);
    t->left = SLI_TAKE(b, sl_int, room);
    t->right = SLI_TAKE(b, sl_int, room);
    t->low = SLI_TAKE(b, sl_int, room);
    t->high = SLI_TAKE(b, sl_int, room);
    t->weight = SLI_TAKE(b, sl_int, room);
    t->scratch = SLI_TAKE(b, sl_int, 2 * (size_t)room);
}

static sl_int sli_tree_add(sli_tree *t, sl_int parent) {
    const sl_int node = t->count++;
    t->parent[node] = parent;
    t->left[node] = t->right[node] = -1;
    t->weight[node] = 0;
    return node;
}

/* Splits a leaf in two. */
static void sli_tree_split(sli_tree *t, sl_int leaf) {
    t->left[leaf] = sli_tree_add(t, leaf);
    t->right[leaf] = sli_tree_add(t, leaf);
}

SLI_INLINE int sli_tree_is_leaf(const sli_tree *t, sl_int node) {
    return t->left[node] == -1;
}

SLI_INLINE int sli_tree_is_below(const sli_tree *t, sl_int node, sl_int label) {
    return t->low[node] <= label && label <= t->high[node];
}

/* The node that parts a from b, neither of which is above the other. */
SLI_INLINE sl_int sli_tree_meet(const sli_tree *t, sl_int a, sl_int b) {
    while (!sli_tree_is_below(t, a, b)) {
        a = t->parent[a];
    }
    return a;
}

/* The next node after one in postorder, whose subtree is done. */
SLI_INLINE sl_int sli_tree_next(const sli_tree *t, sl_int node) {
    const sl_int up = t->parent[node];
    if (up == -1 || t->right[up] == node) {
        return up;
    }
    node = t->right[up];
    while (t->left[node] != -1) {
        node = t->left[node];
    }
    return node;
}

SLI_INLINE sl_int sli_tree_first(const sli_tree *t) {
    sl_int node = t->root;
    while (t->left[node] != -1) {
        node = t->left[node];
    }
    return node;
}

static void sli_tree_renumber(sl_int *a, const sl_int *number, sl_int count, int values,
                              sl_int *scratch) {
    sl_int k;
    memcpy(scratch, a, (size_t)count * sizeof(sl_int));
    for (k = 0; k < count; k++) {
        a[number[k]] = values && scratch[k] != -1 ? number[scratch[k]] : scratch[k];
    }
}

/* Numbers the nodes from left to right, and the labels of n vertices with them. */
static void sli_tree_number(sli_tree *t, sl_int n, sl_int *label) {
    sl_int *number = t->scratch, *keep = t->scratch + t->room, node, k, next = 0;
    /* in a postorder walk a node is numbered when its left subtree is done */
    for (node = sli_tree_first(t); node != -1; node = sli_tree_next(t, node)) {
        const sl_int up = t->parent[node];
        if (t->left[node] == -1) {
            number[node] = next++;
        }
        if (up != -1 && t->left[up] == node) {
            number[up] = next++;
        }
    }
    t->root = number[t->root];
    sli_tree_renumber(t->parent, number, t->count, 1, keep);
    sli_tree_renumber(t->left, number, t->count, 1, keep);
    sli_tree_renumber(t->right, number, t->count, 1, keep);
    sli_tree_renumber(t->weight, number, t->count, 0, keep);
    for (k = 0; k < n; k++) {
        label[k] = number[label[k]];
    }
    for (node = sli_tree_first(t); node != -1; node = sli_tree_next(t, node)) {
        t->low[node] = t->left[node] == -1 ? node : t->low[t->left[node]];
        t->high[node] = t->left[node] == -1 ? node : t->high[t->right[node]];
    }
}

/* order[k] := the nodes, parents first, level by level. */
static void sli_tree_levels(const sli_tree *t, sl_int *order) {
    sl_int head, tail = 0;
    order[tail++] = t->root;
    for (head = 0; head < tail; head++) {
        if (!sli_tree_is_leaf(t, order[head])) {
            order[tail++] = t->left[order[head]];
            order[tail++] = t->right[order[head]];
        }
    }
}

/* ---- borders: for each node a list of vertices that may have a neighbour across it ---- */

typedef struct sli_borders {
    sl_int *head; /* a node: the first entry, -1 if none */
    sl_int count, room;
    sl_int *vertex, *next; /* room */
    void *block;
    int failed; /* there was no memory for more */
    const sl_allocator *a;
} sli_borders;

SLI_INLINE void sli_borders_init(sli_borders *l, const sl_allocator *a) {
    l->count = l->room = 0;
    l->vertex = l->next = NULL;
    l->block = NULL;
    l->failed = 0;
    l->a = a;
}

static void sli_borders_grow(sli_borders *l) {
    sli_block b = {NULL, 0, 0};
    sl_int *vertex = NULL, *next = NULL;
    const sl_int room = l->room < INT32_MAX / 2 ? sli_max(2 * l->room, 1024) : INT32_MAX;
    int pass;
    for (pass = 0; pass < 2 && !l->failed; pass++) {
        vertex = SLI_TAKE(&b, sl_int, room);
        next = SLI_TAKE(&b, sl_int, room);
        l->failed = pass == 0 && (room == l->room || sli_block_alloc(&b, l->a) != SL_OK);
    }
    if (!l->failed) {
        if (l->count > 0) {
            memcpy(vertex, l->vertex, (size_t)l->count * sizeof(sl_int));
            memcpy(next, l->next, (size_t)l->count * sizeof(sl_int));
        }
        sli_free(l->a, l->block);
        l->vertex = vertex;
        l->next = next;
        l->room = room;
        l->block = b.base;
    }
}

static void sli_borders_add(sli_borders *l, sl_int node, sl_int v) {
    if (l->count == l->room) {
        sli_borders_grow(l);
        if (l->failed) {
            return;
        }
    }
    l->vertex[l->count] = v;
    l->next[l->count] = l->head[node];
    l->head[node] = l->count++;
}

/* Lists every vertex of a level at the nodes that part it from a neighbour. */
static void sli_borders_fill(sli_borders *l, const sli_tree *t, const sli_level *g,
                             const sl_int *label) {
    sl_int v, k;
    sl_off e;
    for (k = 0; k < t->count; k++) {
        l->head[k] = -1;
    }
    l->count = 0;
    for (v = 0; v < g->n; v++) {
        const sl_int own = label[v];
        sl_int last = own, listed = -1;
        for (e = g->begin[v]; e < g->begin[v + 1]; e++) {
            const sl_int other = label[g->to[e]];
            if (other != own && other != last) {
                const sl_int node = sli_tree_meet(t, own, other);
                last = other;
                if (node != listed && node != own && node != other) {
                    listed = node;
                    sli_borders_add(l, node, v);
                }
            }
        }
    }
}

#endif

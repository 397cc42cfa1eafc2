/* labels.h: the separator tree during dissection: a label for each vertex, and border lists */
#ifndef SLI_ORDERING_LABELS_H
#define SLI_ORDERING_LABELS_H

#include "coarsen.h"

/* The separator tree of one graph. An inner node is a separator, a leaf is a subgraph that is not
 * dissected. The label of a vertex is its node. After sli_label_tree_number the nodes are numbered
 * in inorder, so that each subtree is an interval of labels. The label of a
 * vertex then shows whether it is below a node and on which side, so that all nodes can share one
 * graph. */
typedef struct sli_label_tree {
    sl_int count, room;
    sl_int root;
    sl_int *parent;       /* -1 at the root */
    sl_int *left, *right; /* -1 at a leaf */
    sl_int *low, *high;   /* the subtree of a node is low..high */
    sl_int *weight;       /* weight of the finest vertices in the subtree */
    sl_int *scratch;      /* 2 room */
} sli_label_tree;

static void sli_label_tree_layout(sli_label_tree *t, sli_block *b, sl_int room) {
    t->room = room;
    t->parent = SLI_TAKE(b, sl_int, room);
    t->left = SLI_TAKE(b, sl_int, room);
    t->right = SLI_TAKE(b, sl_int, room);
    t->low = SLI_TAKE(b, sl_int, room);
    t->high = SLI_TAKE(b, sl_int, room);
    t->weight = SLI_TAKE(b, sl_int, room);
    t->scratch = SLI_TAKE(b, sl_int, 2 * (size_t)room);
}

/* Adds a leaf below parent, -1 for the root, and returns it. */
static sl_int sli_label_tree_add(sli_label_tree *t, sl_int parent) {
    const sl_int node = t->count++;
    t->parent[node] = parent;
    t->left[node] = t->right[node] = -1;
    t->weight[node] = 0;
    return node;
}

/* Splits a leaf in two. */
static void sli_label_tree_split(sli_label_tree *t, sl_int leaf) {
    t->left[leaf] = sli_label_tree_add(t, leaf);
    t->right[leaf] = sli_label_tree_add(t, leaf);
}

SLI_INLINE int sli_label_tree_is_leaf(const sli_label_tree *t, sl_int node) {
    return t->left[node] == -1;
}

SLI_INLINE int sli_label_tree_is_below(const sli_label_tree *t, sl_int node, sl_int label) {
    return t->low[node] <= label && label <= t->high[node];
}

/* The lowest common ancestor of a and b: the node that separates them. Neither is an ancestor of
 * the other. */
SLI_INLINE sl_int sli_label_tree_lca(const sli_label_tree *t, sl_int a, sl_int b) {
    while (!sli_label_tree_is_below(t, a, b)) {
        a = t->parent[a];
    }
    return a;
}

/* The successor of a node in postorder, or -1 after the root. */
SLI_INLINE sl_int sli_label_tree_next(const sli_label_tree *t, sl_int node) {
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

SLI_INLINE sl_int sli_label_tree_first(const sli_label_tree *t) {
    sl_int node = t->root;
    while (t->left[node] != -1) {
        node = t->left[node];
    }
    return node;
}

/* Moves the entries of an array to the new numbers of their nodes; values: they are nodes, too. */
static void sli_label_tree_renumber(sl_int *a, const sl_int *number, sl_int count, int values,
                                    sl_int *scratch) {
    sl_int k;
    memcpy(scratch, a, (size_t)count * sizeof(sl_int));
    for (k = 0; k < count; k++) {
        a[number[k]] = values && scratch[k] != -1 ? number[scratch[k]] : scratch[k];
    }
}

/* Numbers the nodes in inorder and updates the labels of n vertices. */
static void sli_label_tree_number(sli_label_tree *t, sl_int n, sl_int *label) {
    sl_int *number = t->scratch, *keep = t->scratch + t->room, node, k, next = 0;
    /* In a postorder walk a node gets its inorder number once its left subtree is done. */
    for (node = sli_label_tree_first(t); node != -1; node = sli_label_tree_next(t, node)) {
        const sl_int up = t->parent[node];
        if (t->left[node] == -1) {
            number[node] = next++;
        }
        if (up != -1 && t->left[up] == node) {
            number[up] = next++;
        }
    }
    t->root = number[t->root];
    sli_label_tree_renumber(t->parent, number, t->count, 1, keep);
    sli_label_tree_renumber(t->left, number, t->count, 1, keep);
    sli_label_tree_renumber(t->right, number, t->count, 1, keep);
    sli_label_tree_renumber(t->weight, number, t->count, 0, keep);
    for (k = 0; k < n; k++) {
        label[k] = number[label[k]];
    }
    for (node = sli_label_tree_first(t); node != -1; node = sli_label_tree_next(t, node)) {
        t->low[node] = t->left[node] == -1 ? node : t->low[t->left[node]];
        t->high[node] = t->left[node] == -1 ? node : t->high[t->right[node]];
    }
}

/* order := the nodes in breadth-first order, parents first. */
static void sli_label_tree_breadth_first(const sli_label_tree *t, sl_int *order) {
    sl_int head, tail = 0;
    order[tail++] = t->root;
    for (head = 0; head < tail; head++) {
        if (!sli_label_tree_is_leaf(t, order[head])) {
            order[tail++] = t->left[order[head]];
            order[tail++] = t->right[order[head]];
        }
    }
}

/* Borders: for each inner node, a list of the vertices that may have a neighbor on its other side.
 * The lists share one pool of entries that grows on demand. */

typedef struct sli_borders {
    sl_int *head; /* by node: its first entry, or -1 */
    sl_int count, room;
    sl_int *vertex, *next; /* room */
    void *block;
    int failed; /* an allocation failed */
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
    const sl_int room =
        l->room < INT32_MAX / 2 ? sli_max(2 * l->room, 1024) : INT32_MAX; /* untested: 2^30 */
    int pass;
    for (pass = 0; pass < 2 && !l->failed; pass++) {
        vertex = SLI_TAKE(&b, sl_int, room);
        next = SLI_TAKE(&b, sl_int, room);
        l->failed = pass == 0 &&
                    (room == l->room || /* untested: 2^31 */
                     sli_block_alloc(&b, l->a) != SL_OK);
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

/* Enters v into the border list of node. Sets `failed` if memory runs out. */
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

/* Enters each vertex of a level into the lists of the nodes that separate it from a neighbor. */
static void sli_borders_fill(sli_borders *l, const sli_label_tree *t, const sli_level *g,
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
                const sl_int node = sli_label_tree_lca(t, own, other);
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

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
    SLI_ASSERT(t->count + 2 <= t->room);
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
    SLI_COPY(scratch, a, count);
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

/* The next node of the subtree of `top` in preorder, parents first, or -1. */
SLI_INLINE sl_int sli_label_tree_below(const sli_label_tree *t, sl_int top, sl_int node) {
    if (!sli_label_tree_is_leaf(t, node)) {
        return t->left[node];
    }
    while (node != top && node == t->right[t->parent[node]]) {
        node = t->parent[node];
    }
    return node == top ? -1 : t->right[t->parent[node]];
}

/* Borders: for each inner node, a list of the vertices that may have a neighbor on its other side.
 * The lists of all workers share a pool of entries, in chunks of which each has twice as many as
 * the one before. A worker takes SLI_BORDERS_RANGE entries at a time. */
#define SLI_BORDERS_FIRST 1024
#define SLI_BORDERS_RANGE 256
#define SLI_BORDERS_CHUNKS 21

typedef struct sli_border {
    sl_int vertex, next; /* next: an entry, or -1 */
} sli_border;

typedef struct sli_border_pool {
    sli_border *chunk[SLI_BORDERS_CHUNKS]; /* NULL: not needed so far */
    sl_int count;
    int failed; /* an allocation failed */
    sli_atomic lock;
    const sl_allocator *a;
} sli_border_pool;

/* The borders as one worker adds to them. */
typedef struct sli_borders {
    sl_int *head; /* by node: its first entry, or -1 */
    sl_int *tail; /* by node: its last entry, if it has one; or NULL */
    sli_border_pool *pool;
    sl_int at, end; /* the range of entries that it fills */
} sli_borders;

SLI_INLINE void sli_border_pool_free(sli_border_pool *p) {
    int k;
    for (k = 0; k < SLI_BORDERS_CHUNKS; k++) {
        sli_free(p->a, p->chunk[k]);
    }
}

/* The chunk of an entry; *first := its first entry. */
SLI_INLINE int sli_border_chunk(sl_int entry, sl_int *first) {
    const uint32_t units = (uint32_t)entry / SLI_BORDERS_FIRST + 1;
#if defined(SLI_GNU)
    const int chunk = 31 - __builtin_clz(units);
#else
    int chunk = 0;
    while (units >> (chunk + 1) != 0) {
        chunk++;
    }
#endif
    *first = (sl_int)(((uint32_t)1 << chunk) - 1) * SLI_BORDERS_FIRST;
    return chunk;
}

SLI_INLINE sli_border *sli_border_at(const sli_border_pool *p, sl_int entry) {
    sl_int first;
    const int chunk = sli_border_chunk(entry, &first);
    return p->chunk[chunk] + (entry - first);
}

/* Takes a range of entries from the pool. Returns whether there is one. */
static int sli_borders_take(sli_borders *l) {
    sli_border_pool *p = l->pool;
    sl_int first;
    int chunk;
    sli_lock(&p->lock);
    chunk = p->failed ? 0 : sli_border_chunk(p->count, &first);
    if (!p->failed && chunk == SLI_BORDERS_CHUNKS) { /* untested: 2^31 */
        p->failed = 1;                               /* untested: the same */
    }
    if (!p->failed && p->chunk[chunk] == NULL) {
        p->chunk[chunk] = (sli_border *)sli_alloc(p->a, ((size_t)SLI_BORDERS_FIRST << chunk) *
                                                            sizeof(sli_border));
        p->failed = p->chunk[chunk] == NULL;
    }
    if (!p->failed) {
        l->at = p->count;
        l->end = p->count += SLI_BORDERS_RANGE;
    }
    sli_unlock(&p->lock);
    return l->at < l->end;
}

/* Enters v into the border list of node. Without memory, the pool has failed. */
static void sli_borders_add(sli_borders *l, sl_int node, sl_int v) {
    sli_border *b;
    if (l->at == l->end && !sli_borders_take(l)) {
        return;
    }
    if (l->tail != NULL && l->head[node] == -1) {
        l->tail[node] = l->at;
    }
    b = sli_border_at(l->pool, l->at);
    b->vertex = v;
    b->next = l->head[node];
    l->head[node] = l->at++;
}

/* A level, and the labels of its vertices. */
typedef struct sli_labelling {
    const sli_level *g;
    sli_label_tree *tree;
    sl_int *label;
} sli_labelling;

/* Enters a range of the vertices of a level into the lists of the nodes that separate them from a
 * neighbor. */
static void sli_borders_fill(sli_borders *l, const sli_labelling *in, const sli_range *r) {
    const sli_level *g = in->g;
    const sli_label_tree *t = in->tree;
    const sl_int *label = in->label;
    sl_int v;
    sl_off e;
    SLI_NONE(l->head, t->count);
    for (v = r->first; v < r->last; v++) {
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

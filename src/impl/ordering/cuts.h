/* cuts.h: short paths for graphs like trees: minimum degree, its elimination tree cut by cliques */
#ifndef SLI_ORDERING_CUTS_H
#define SLI_ORDERING_CUTS_H

#include "job.h"

/* Trees of at most so many rows are not cut. With 8, paths are a tenth shorter in the narrowest
 * graphs; with 60, a third longer. */
#define SLI_CUTS_LEAF 24
/* A clique between two subtrees leaves at least this share of the rows on each side. */
#define SLI_CUTS_SIDE 5

/* Minimum degree fills a graph that is like a tree, a long strip or a row of fans, hardly at all,
 * but eliminates it from its ends, so that paths have the length of the graph. The rows of L below
 * a pivot are a clique which separates the subtree of the pivot from all other rows. So the tree is
 * dissected instead of the graph: the clique that cuts it best is eliminated last, and what is left
 * falls apart into trees, which are cut in the same way. That costs some fill along the cuts, and
 * time proportional to the rows of L's structure for each level of cuts.
 *
 * A node is a pivot of minimum degree with the rows that are eliminated together with it. Once rows
 * have been placed, they are taken out of all nodes and lists: the order of minimum degree is one
 * without further fill for any part of its L. Rows are named by their position in that order. */
typedef struct sli_cuts {
    sl_int n, nodes;
    sl_int *row;                  /* n: by minimum degree; dense rows come last, in no node */
    sl_int *at;                   /* n: of each row, its position */
    sl_int *node_of;              /* n: of each position */
    sl_int *mark;                 /* n: of each position, -1 once it is placed */
    sl_int *start;                /* nodes + 1: the first position of each */
    sl_int *own;                  /* nodes: rows that have not been placed */
    sl_off *begin;                /* nodes: where its list begins */
    sl_int *count, *list;         /* nodes; the positions below each node */
    sl_int *parent;               /* nodes: that of the first one in its list, or -1 */
    sl_int *below;                /* nodes: rows of its subtree */
    sl_int *tree, *order, *spare; /* nodes */
    sl_int *part, *end;           /* a stack of trees: where each begins and ends in order */
    sl_int parts;
} sli_cuts;

static void sli_cuts_layout(sli_cuts *c, sli_block *b, sl_off room) {
    c->begin = SLI_TAKE(b, sl_off, c->nodes);
    c->row = SLI_TAKE(b, sl_int, c->n);
    c->at = SLI_TAKE(b, sl_int, c->n);
    c->node_of = SLI_TAKE(b, sl_int, c->n);
    c->mark = SLI_TAKE(b, sl_int, c->n);
    c->start = SLI_TAKE(b, sl_int, (size_t)c->nodes + 1);
    c->own = SLI_TAKE(b, sl_int, c->nodes);
    c->count = SLI_TAKE(b, sl_int, c->nodes);
    c->list = SLI_TAKE(b, sl_int, room);
    c->parent = SLI_TAKE(b, sl_int, c->nodes);
    c->below = SLI_TAKE(b, sl_int, c->nodes);
    c->tree = SLI_TAKE(b, sl_int, c->nodes);
    c->order = SLI_TAKE(b, sl_int, c->nodes);
    c->spare = SLI_TAKE(b, sl_int, c->nodes);
    c->part = SLI_TAKE(b, sl_int, c->nodes);
    c->end = SLI_TAKE(b, sl_int, c->nodes);
}

/* Takes an order by minimum degree and the rows of each pivot. */
static void sli_cuts_start(sli_cuts *c, const sl_int *perm, const sl_int *sizes) {
    sl_int s, k;
    for (k = 0; k < c->n; k++) {
        c->row[k] = perm[k];
        c->at[perm[k]] = k;
        c->mark[k] = -1;
    }
    for (s = 0, c->start[0] = 0; s < c->nodes; s++) {
        c->start[s + 1] = c->start[s] + sizes[s];
        c->own[s] = sizes[s];
        c->order[s] = s;
        for (k = c->start[s]; k < c->start[s + 1]; k++) {
            c->node_of[k] = s;
        }
    }
}

/* Appends a position to the list of a node, unless it is there. */
SLI_INLINE sl_off sli_cuts_append(sli_cuts *c, sl_int s, sl_int k, sl_off end) {
    if (k >= c->start[s + 1] && k < c->start[c->nodes] && c->mark[k] != s) {
        c->mark[k] = s;
        c->list[end++] = k;
    }
    return end;
}

/* The lists of all nodes: what is next to their rows, and the lists of their children. */
static void sli_cuts_fill(sli_cuts *c, const sli_graph *G) {
    sl_int *child = c->tree, *sibling = c->spare, s, t, k;
    sl_off end = 0, e;
    SLI_NONE(child, c->nodes);
    for (s = 0; s < c->nodes; s++) {
        c->begin[s] = end;
        for (k = c->start[s]; k < c->start[s + 1]; k++) {
            for (e = G->begin[c->row[k]]; e < G->begin[c->row[k] + 1]; e++) {
                end = sli_cuts_append(c, s, c->at[G->to[e]], end);
            }
        }
        for (t = child[s]; t != -1; t = sibling[t]) {
            for (e = c->begin[t]; e < c->begin[t] + c->count[t]; e++) {
                end = sli_cuts_append(c, s, c->list[e], end);
            }
        }
        c->count[s] = (sl_int)(end - c->begin[s]);
        if (c->count[s] > 0) {
            for (e = c->begin[s], k = c->n; e < end; e++) {
                k = sli_min(k, c->list[e]);
            }
            sibling[s] = child[c->node_of[k]];
            child[c->node_of[k]] = s;
        }
    }
    SLI_ZERO(c->mark, c->n);
}

/* Takes placed rows out of the list of a node. */
static void sli_cuts_renew(sli_cuts *c, sl_int s) {
    sl_int *list = c->list + c->begin[s], k, kept = 0, least = c->n;
    for (k = 0; k < c->count[s]; k++) {
        if (c->mark[list[k]] != -1) {
            least = sli_min(least, list[k]);
            list[kept++] = list[k];
        }
    }
    c->count[s] = kept;
    c->parent[s] = kept == 0 ? -1 : c->node_of[least];
}

/* Pushes the trees of the nodes first..end-1 of the order. */
static void sli_cuts_push(sli_cuts *c, sl_int first, sl_int end) {
    sl_int *part = c->part + c->parts, *last = c->end + c->parts, trees = 0, k;
    for (k = end - 1; k >= first; k--) {
        const sl_int s = c->order[k];
        sli_cuts_renew(c, s);
        if (c->parent[s] == -1) {
            last[trees] = 0;
            c->tree[s] = trees++;
        } else {
            c->tree[s] = c->tree[c->parent[s]];
        }
        last[c->tree[s]]++;
    }
    for (k = 0; k < trees; k++) {
        part[k] = k == 0 ? first : last[k - 1];
        last[k] += part[k];
    }
    for (k = first; k < end; k++) { /* within each tree nodes ascend: children precede parents */
        c->spare[part[c->tree[c->order[k]]]++] = c->order[k];
    }
    for (k = 0; k < trees; k++) {
        part[k] = k == 0 ? first : last[k - 1];
    }
    SLI_COPY(c->order + first, c->spare + first, end - first);
    c->parts += trees;
}

/* Where to cut a tree of so many rows: the list of a node is the cut, and its own rows if is_front
 * is set. */
static sl_int sli_cuts_find(const sli_cuts *c, sl_int first, sl_int end, sl_int total,
                            int *is_front) {
    int64_t least = INT64_MAX;
    sl_int k, best = -1, center = -1;
    for (k = first; k < end; k++) {
        const sl_int s = c->order[k], below = c->below[s];
        const sl_int side = sli_min(below, total - below - c->count[s]);
        center = center == -1 && below >= total - below ? s : center;
        if (c->parent[s] != -1 && side >= total / SLI_CUTS_SIDE) {
            const int64_t cost = (int64_t)c->count[s] * (total - side);
            if (cost < least) {
                least = cost;
                best = s;
            }
        }
    }
    *is_front = best == -1 || c->count[best] > c->count[center] + c->own[center];
    return *is_front ? center : best;
}

/* Writes a row in front of `at`. */
SLI_INLINE sl_int sli_cuts_place(sli_cuts *c, sl_int k, sl_int *perm, sl_int at) {
    perm[--at] = c->row[k];
    c->mark[k] = -1;
    c->own[c->node_of[k]]--;
    return at;
}

/* The same for all rows of a node that have not been placed. */
static sl_int sli_cuts_place_node(sli_cuts *c, sl_int s, sl_int *perm, sl_int at) {
    sl_int k;
    for (k = c->start[s + 1] - 1; k >= c->start[s]; k--) {
        at = c->mark[k] == -1 ? at : sli_cuts_place(c, k, perm, at);
    }
    return at;
}

/* Cuts the trees on the stack. Their rows end at `at`. */
static void sli_cuts_run(sli_cuts *c, sl_int *perm, sl_int at) {
    while (c->parts > 0) {
        const sl_int first = c->part[--c->parts], end = c->end[c->parts];
        const sl_int root = c->order[end - 1];
        sl_int k, kept = first, cut;
        int is_front;
        for (k = first; k < end; k++) {
            c->below[c->order[k]] = c->own[c->order[k]];
        }
        for (k = first; k < end - 1; k++) {
            c->below[c->parent[c->order[k]]] += c->below[c->order[k]];
        }
        if (c->below[root] <= SLI_CUTS_LEAF) {
            for (k = end - 1; k >= first; k--) {
                at = sli_cuts_place_node(c, c->order[k], perm, at);
            }
            continue;
        }
        cut = sli_cuts_find(c, first, end, c->below[root], &is_front);
        for (k = 0; k < c->count[cut]; k++) {
            at = sli_cuts_place(c, c->list[c->begin[cut] + k], perm, at);
        }
        if (is_front) {
            at = sli_cuts_place_node(c, cut, perm, at);
        }
        for (k = first; k < end; k++) {
            if (c->own[c->order[k]] > 0) {
                c->order[kept++] = c->order[k];
            }
        }
        sli_cuts_push(c, first, kept);
    }
}

/* Replaces an order by minimum degree of the graph of a job. sizes: rows of each of its pivots;
 * room: the sum of the rows below each of them. */
static sl_status sli_order_cuts(const sli_order_job *job, const sl_int *sizes, sl_int nodes,
                                sl_off room) {
    sli_cuts c;
    sli_block b = {NULL, 0};
    sl_status status = SL_OK;
    SLI_CLEAR(c);
    c.n = job->G->n;
    c.nodes = nodes;
    SLI_LAYOUT(&b, job->a, status) {
        sli_cuts_layout(&c, &b, room);
    }
    if (status == SL_OK) {
        sli_cuts_start(&c, job->perm, sizes);
        sli_cuts_fill(&c, job->G);
        SLI_ASSERT(nodes == 0 || c.begin[nodes - 1] + c.count[nodes - 1] <= room);
        sli_cuts_push(&c, 0, nodes);
        sli_cuts_run(&c, job->perm, c.start[nodes]);
        sli_free(job->a, b.base);
    }
    return status;
}

#endif

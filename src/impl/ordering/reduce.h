/* reduce.h: rows ordered apart: those with few neighbors first, constraints last */
#ifndef SLI_ORDERING_REDUCE_H
#define SLI_ORDERING_REDUCE_H

#include "job.h"

/* Has a row no diagonal entry, but many neighbors? */
static int sli_order_is_constraint(const sl_csc *A, sl_int row, sl_off degree) {
    sl_int p = A->p[row];
    if (degree < 8 || degree * degree < A->n_cols) {
        return 0;
    }
    while (p < A->p[row + 1] && A->i[p] != row) {
        p++;
    }
    return p == A->p[row + 1];
}

/* A row with many neighbors and without a diagonal entry is a constraint, as in [L m; m' 0] with a
 * Laplacian L and weights m. After all of its neighbors, it would follow a null pivot of L. So the
 * last one of them moves behind it: L without that row is definite. Both are in the last dense
 * block, and the exchange costs nothing. */
static void sli_order_border(const sli_order_job *job) {
    const sl_csc *A = job->A;
    const sli_graph *G = job->G;
    sl_int *perm = job->perm, *position = job->scratch;
    sl_int k, v, last;
    sl_off e;
    for (v = 0; v < G->n && (sli_graph_degree(G, v) < 8 ||
                           !sli_order_is_constraint(A, v, sli_graph_degree(G, v)));
         v++) {
    }
    if (v == G->n) {
        return; /* usual */
    }
    for (k = 0; k < G->n; k++) {
        position[perm[k]] = k;
    }
    for (k = 0; k < G->n; k++) {
        const sl_int row = perm[k];
        if (!sli_order_is_constraint(A, row, sli_graph_degree(G, row))) {
            continue;
        }
        last = -1;
        for (e = G->begin[row]; e < G->begin[row + 1]; e++) {
            last = sli_max(last, position[G->to[e]]);
        }
        if (last > k) {
            continue;
        }
        v = perm[last];
        for (; last < k; last++) {
            perm[last] = perm[last + 1];
            position[perm[last]] = last;
        }
        perm[k] = v;
        position[v] = k;
        job->septree->count = 0; /* its nodes would no longer be contiguous */
    }
}

/* Eliminates rows with at most one neighbor until there are none, each followed by that neighbor if
 * it can be next. degree: neighbors left, -1 of rows that are eliminated; only: the XOR of the
 * neighbors left, which is the only one of a leaf and stays its parent, -1 at a root. Returns how
 * many rows are in the sequence. */
static sl_int sli_forest_leaves(sl_int n, sl_int *degree, sl_int *only, sl_int *sequence) {
    sl_int v, u, count = 0;
    for (v = 0; v < n; v++) {
        for (u = v; u != -1 && (degree[u] == 0 || degree[u] == 1); u = only[u]) {
            sequence[count++] = u;
            if (degree[u] == 1) {
                degree[only[u]]--;
                only[only[u]] ^= u;
            } else {
                only[u] = -1;
            }
            degree[u] = -1;
        }
    }
    return count;
}

/* Orders a matrix from the leaves, in a postorder, if its graph is a forest without a row that
 * sli_order_border would move, and finds the elimination tree. Neither a graph nor lists are
 * needed. Returns whether it is such a matrix. A first factor takes 0.8 of the time. */
static int sli_order_forest(const sli_order_job *job) {
    const sl_csc *A = job->A;
    const sl_int n = A->n_cols, nnz = sli_nnz(A);
    sl_int *perm = job->perm, *parent = job->choice->parent;
    sl_int *degree = job->scratch, *only = degree + n, *more = degree + 2 * (size_t)n;
    sl_int k, p, edges = 0;
    if (nnz >= (job->triangle == SL_TRIANGLE_BOTH ? 3 : 2) * (int64_t)n) {
        return 0;
    }
    SLI_ZERO(degree, 2 * (size_t)n);
    for (p = 0; p < nnz; p++) {
        const sl_int i = A->i[p], j = job->column[p];
        const int is_edge = i != j && sli_is_read(job->triangle, i, j);
        degree[i] += is_edge;
        degree[j] += is_edge;
        only[i] ^= is_edge ? j : 0;
        only[j] ^= is_edge ? i : 0;
        edges += is_edge;
    }
    for (k = 0; k < n && edges < n; k++) {
        if (degree[k] >= 8 && sli_order_is_constraint(A, k, degree[k])) {
            return 0;
        }
    }
    if (edges >= n || sli_forest_leaves(n, degree, only, more) < n) {
        return 0;
    }
    for (k = 0; k < n && (only[more[k]] == -1 || only[more[k]] == more[k + 1]); k++) {
        perm[k] = more[k];
        parent[k] = only[more[k]] == -1 ? -1 : k + 1;
    }
    if (k == n) { /* tridiagonal matrices: 11 percent of a first factor */
        return 1;
    }
    sli_postorder(only, more, n, perm, degree, more + n);
    for (k = 0; k < n; k++) {
        degree[perm[k]] = k;
    }
    for (k = 0; k < n; k++) {
        const sl_int up = only[perm[k]];
        parent[k] = up == -1 ? -1 : degree[up];
    }
    return 1;
}

/* Rows are peeled if at least one row in this many has at most two neighbors. */
#define SLI_PEEL_SHARE 8
/* Where both ends have more neighbors, an edge is not searched for: it may then be there twice. */
#define SLI_PEEL_SEARCH 32
/* For many solves, this many rounds at most eliminate only rows with at most one neighbor: trees of
 * this height disappear without fill, and longer branches are halved. These rounds end once fewer
 * than one row in SLI_PEEL_ENDS is left to them. For little fill there is no limit. */
#define SLI_PEEL_LEAVES 8
#define SLI_PEEL_ENDS 256

/* Eliminates rows in rounds. In a round no two neighbors are eliminated, so that a chain is halved
 * and a tree of n rows disappears in O(log n) rounds: that is the length of all paths in the
 * elimination tree [MR85]. A row with one neighbor has no fill; one with two has at most the edge
 * between them. All arrays have n entries, unless said otherwise. */
typedef struct sli_peel {
    sli_graph rest;      /* edges of the rows that are left: at first all, numbered as in G */
    sl_int *length;      /* entries in use in the list of a row */
    sl_int *degree;      /* neighbors left; -1: eliminated */
    sl_int *ends;        /* 2 n: the neighbors of an eliminated row; -1, -1: there is no edge */
    sl_int *stamp;       /* the last round that changed the row's list */
    sl_int *now, *later; /* rows that may be eliminated in this round, and in the next */
    sl_int *sequence;    /* the rows eliminated; then those that are left */
    sl_int count, n_later, round;
    sl_int most; /* neighbors of a row that may be eliminated */
} sli_peel;

static void sli_peel_layout(sli_peel *p, sli_block *b, sl_int n, sl_off edges) {
    p->rest.begin = SLI_TAKE(b, sl_off, (size_t)n + 1);
    p->rest.to = SLI_TAKE(b, sl_int, edges);
    p->length = SLI_TAKE(b, sl_int, n);
    p->degree = SLI_TAKE(b, sl_int, n);
    p->ends = SLI_TAKE(b, sl_int, 2 * (size_t)n);
    p->stamp = SLI_TAKE(b, sl_int, n);
    p->now = SLI_TAKE(b, sl_int, n);
    p->later = SLI_TAKE(b, sl_int, n);
    p->sequence = SLI_TAKE(b, sl_int, n);
}

/* Have enough rows at most two neighbors? */
static int sli_peel_is_worthwhile(const sli_graph *G) {
    sl_int v, few = 0;
    for (v = 0; v < G->n; v++) {
        few += sli_graph_degree(G, v) <= 2;
    }
    return few > G->n / SLI_PEEL_SHARE;
}

/* The row that an entry of v's list leads to, past those that are eliminated, or -1. */
SLI_INLINE sl_int sli_peel_follow(const sli_peel *p, sl_int v, sl_int u) {
    while (u != -1 && p->degree[u] == -1) {
        const sl_int *ends = p->ends + 2 * (size_t)u;
        u = ends[0] == v ? ends[1] : ends[0];
    }
    return u;
}

/* Shortens the list of v to the rows that are left. */
static const sl_int *sli_peel_list(sli_peel *p, sl_int v) {
    sl_int *list = p->rest.to + p->rest.begin[v], k, kept = 0;
    for (k = 0; k < p->length[v]; k++) {
        const sl_int u = sli_peel_follow(p, v, list[k]);
        if (u != -1) {
            list[kept++] = u;
        }
    }
    p->length[v] = kept;
    return list;
}

static int sli_peel_has_edge(sli_peel *p, sl_int u, sl_int v) {
    const sl_int at = p->degree[u] < p->degree[v] ? u : v, other = at == u ? v : u;
    const sl_int *list;
    sl_int k = 0;
    if (p->degree[at] > SLI_PEEL_SEARCH) {
        return 0;
    }
    list = sli_peel_list(p, at);
    while (k < p->length[at] && list[k] != other) {
        k++;
    }
    return k < p->length[at];
}

/* The list of u has changed, and u has `fewer` neighbors less. */
SLI_INLINE void sli_peel_touch(sli_peel *p, sl_int u, sl_int fewer) {
    const int was_listed = p->stamp[u] == p->round && p->degree[u] <= p->most;
    p->degree[u] -= fewer;
    p->stamp[u] = p->round;
    if (p->degree[u] <= p->most && !was_listed) {
        p->later[p->n_later++] = u;
    }
}

/* Eliminates v, which has at most two neighbors. */
static void sli_peel_eliminate(sli_peel *p, sl_int v) {
    const sl_int *list = sli_peel_list(p, v);
    sl_int *ends = p->ends + 2 * (size_t)v;
    const sl_int count = p->length[v], a = count > 0 ? list[0] : -1, b = count > 1 ? list[1] : -1;
    const int is_joined = b != -1 && a != b && !sli_peel_has_edge(p, a, b);
    ends[0] = is_joined ? a : -1;
    ends[1] = is_joined ? b : -1;
    p->degree[v] = -1;
    p->sequence[p->count++] = v;
    if (b != -1 && a != b) {
        sli_peel_touch(p, a, !is_joined);
        sli_peel_touch(p, b, !is_joined);
    } else if (a != -1) {
        sli_peel_touch(p, a, count);
    }
}

/* Lists the rows that may be eliminated in the next round. */
static void sli_peel_list_rows(sli_peel *p, sl_int n, sl_int most) {
    sl_int v;
    p->most = most;
    p->n_later = 0;
    for (v = 0; v < n; v++) {
        p->later[p->n_later] = v;
        p->n_later += p->degree[v] != -1 && p->degree[v] <= most;
    }
}

/* Eliminates what is in `later`, except for rows whose neighbors are eliminated before them. */
static void sli_peel_round(sli_peel *p) {
    const sl_int count = p->n_later;
    sl_int k, *keep = p->now;
    p->now = p->later;
    p->later = keep;
    p->n_later = 0;
    p->round++;
    for (k = 0; k < count; k++) {
        if (p->stamp[p->now[k]] != p->round) { /* otherwise it is in `later` */
            sli_peel_eliminate(p, p->now[k]);
        }
    }
}

/* Eliminates rows with at most one neighbor until there are none. */
static void sli_peel_leaves(sli_peel *p, const sli_graph *G) {
    sl_int *only = p->now, v;
    sl_off e;
    for (v = 0; v < G->n; v++) {
        only[v] = 0;
        for (e = G->begin[v]; e < G->begin[v + 1]; e++) {
            only[v] ^= G->to[e];
        }
    }
    p->count = sli_forest_leaves(G->n, p->degree, only, p->sequence);
    for (v = 0; v < p->count; v++) {
        sl_int *ends = p->ends + 2 * (size_t)p->sequence[v];
        ends[0] = ends[1] = -1;
    }
}

/* Eliminates all rows that can be. */
static void sli_peel_run(sli_peel *p, const sli_graph *G, int for_little_fill) {
    const sl_int n = G->n;
    sl_int v;
    p->count = p->round = 0;
    for (v = 0; v < n; v++) {
        p->length[v] = p->degree[v] = (sl_int)sli_graph_degree(G, v);
        p->stamp[v] = 0;
    }
    if (for_little_fill) {
        sli_peel_leaves(p, G);
    }
    if (p->count == n) {
        return;
    }
    SLI_COPY(p->rest.begin, G->begin, n + 1);
    SLI_COPY(p->rest.to, G->to, G->begin[n]);
    sli_peel_list_rows(p, n, 1);
    while (!for_little_fill && p->n_later > n / SLI_PEEL_ENDS && p->round < SLI_PEEL_LEAVES) {
        sli_peel_round(p);
    }
    sli_peel_list_rows(p, n, 2);
    while (p->n_later > 0) {
        sli_peel_round(p);
    }
}

/* Numbers the rows that are left in their order and makes `rest` their graph. */
static void sli_peel_finish(sli_peel *p, sl_int n) {
    sl_int v, k, *number = p->now, *seen = p->later, left = 0;
    sl_off to = 0;
    for (v = 0; v < n; v++) {
        if (p->degree[v] != -1) {
            sli_peel_list(p, v);
            p->sequence[p->count + left] = v;
            seen[left] = -1;
            number[v] = left++;
        }
    }
    for (k = 0; k < left; k++) {
        sl_off e = p->rest.begin[p->sequence[p->count + k]];
        const sl_off end = e + p->length[p->sequence[p->count + k]];
        p->rest.begin[k] = to;
        for (; e < end; e++) {
            const sl_int u = number[p->rest.to[e]];
            p->rest.to[to] = u;
            to += seen[u] != k;
            seen[u] = k;
        }
    }
    p->rest.begin[left] = to;
    p->rest.n = left;
}

/* Puts the rows eliminated before those that are left, whose order is in perm. */
static void sli_peel_expand(const sli_peel *p, sl_int *perm) {
    sl_int k;
    for (k = p->rest.n - 1; k >= 0; k--) {
        perm[p->count + k] = p->sequence[p->count + perm[k]];
    }
    SLI_COPY(perm, p->sequence, p->count);
}

#endif

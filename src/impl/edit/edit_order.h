/* edit_order.h: the order of an edited matrix: a new order of small subtrees with active rows */
#ifndef SLI_EDIT_ORDER_H
#define SLI_EDIT_ORDER_H

#include "edit_separate.h"

/* Marks the ancestors of fresh nodes as fresh, and the subtrees that get a new order. */
static void sli_edit_mark(sli_edit *e) {
    const sl_symbolic *S = e->S;
    sl_int s;
    sli_edit_weigh(e);
    for (s = 0; s < S->n_supers; s++) {
        const sl_int up = S->super_parent[s];
        if (up != -1 && e->mark[s] != SLI_NODE_KEPT) {
            e->mark[up] = SLI_NODE_FRESH;
        }
    }
    for (s = S->n_supers - 1; s >= 0; s--) {
        if (e->weight[s] > 0 && sli_edit_is_small(e, s)) {
            const sl_int low = S->first_descendant[s];
            memset(e->mark + low, SLI_NODE_GROUPED, (size_t)(s - low + 1));
            s = low;
        }
    }
}

/* Appends the rows of node s to fresh: first those that came to it, so that they do not enter the
 * structure of the others without need. */
static void sli_edit_append(sli_edit *e, sl_int s) {
    const sl_symbolic *S = e->S;
    sl_int k, row;
    for (row = e->head[s]; row != -1; row = e->next[row]) {
        e->fresh[e->n_fresh++] = row;
    }
    for (k = s < S->n_supers ? S->super_first[s] : 0; s < S->n_supers && k < S->super_first[s + 1];
         k++) {
        row = e->new_of[S->perm[k]];
        if (row != -1 && e->node[row] == s) { /* it stays in its node */
            e->fresh[e->n_fresh++] = row;
        }
    }
}

/* Lists the rows whose columns are analyzed again: first those that get a new order, unsorted. */
static void sli_edit_collect(sli_edit *e) {
    const sl_symbolic *S = e->S;
    sl_int s, k;
    for (s = 0; s <= S->n_supers; s++) {
        e->head[s] = -1;
    }
    e->n_fresh = 0;
    for (k = e->n_near - 1; k >= 0; k--) {
        const sl_int row = e->around[k], node = e->node[row];
        if (node == -1) {
            e->fresh[e->n_fresh++] = row;
        } else if (e->column_of[row] == -1 || S->super_of[e->column_of[row]] != node) {
            e->next[row] = e->head[node];
            e->head[node] = row;
        }
    }
    for (s = 0; s < S->n_supers; s++) {
        if (e->mark[s] == SLI_NODE_GROUPED) {
            sli_edit_append(e, s);
        }
    }
    e->n_grouped = e->n_fresh;
    for (s = 0; s <= S->n_supers; s++) {
        if (e->mark[s] == SLI_NODE_FRESH) {
            sli_edit_append(e, s);
        }
    }
}

/* Fills the graph of the rows that get a new order; number: their positions in fresh, -1 for all
 * other rows. Without G->to the edges are counted. */
static void sli_edit_graph(const sli_edit *e, sli_graph *G) {
    const sl_csc *B = e->B;
    sl_int k, p;
    for (k = 0; k < e->n_grouped; k++) {
        const sl_int j = e->fresh[k];
        for (p = B->p[j]; p < B->p[j + 1]; p++) {
            const sl_int i = e->number[B->i[p]];
            if (i != -1 && i != k && sli_is_read(e->triangle, B->i[p], j) && G->to == NULL) {
                G->begin[i]++;
                G->begin[k]++;
            } else if (i != -1 && i != k && sli_is_read(e->triangle, B->i[p], j)) {
                G->to[G->begin[i]++] = k;
                G->to[G->begin[k]++] = i;
            }
        }
    }
}

/* Makes the graph of the grouped rows, whose G->begin has room for it. The caller frees `edges`. */
static sl_status sli_edit_make_graph(sli_edit *e, sli_graph *G, sli_block *edges,
                                     const sl_allocator *a) {
    const sl_int count = e->n_grouped;
    sl_off total;
    sl_status status = SL_OK;
    sl_int k;
    SLI_NONE(e->number, e->n);
    for (k = 0; k < count; k++) {
        e->number[e->fresh[k]] = k;
    }
    SLI_ZERO(G->begin, count + 1);
    sli_edit_graph(e, G);
    total = sli_starts(G->begin, count);
    SLI_LAYOUT(edges, a, status) {
        G->to = SLI_TAKE(edges, sl_int, total);
    }
    if (status == SL_OK) {
        sli_edit_graph(e, G);
        sli_starts_restore(G->begin, count);
        status = sli_graph_make_canonical(G, a);
    }
    return status;
}

/* Orders the grouped rows by their graph. */
static sl_status sli_edit_order(sli_edit *e, const sl_allocator *a) {
    const sl_int count = e->n_grouped;
    sli_graph G;
    sli_block b = {NULL, 0}, edges = {NULL, 0};
    sli_septree septree;
    sli_team alone = sli_team_of(1);
    sl_int *perm = NULL, *scratch = NULL, k;
    sli_order_cost cost;
    sli_order_job job;
    sl_status status = SL_OK;
    SLI_CLEAR(G);
    SLI_CLEAR(septree);
    if (count == 0) {
        return SL_OK;
    }
    G.n = count;
    SLI_LAYOUT(&b, a, status) {
        G.begin = SLI_TAKE(&b, sl_off, (uint64_t)count + 1);
        perm = SLI_TAKE(&b, sl_int, count);
        scratch = SLI_TAKE(&b, sl_int, count);
        septree.node_of = SLI_TAKE(&b, sl_int, count);
        septree.parent = SLI_TAKE(&b, sl_int, (uint64_t)count + 1);
    }
    if (status != SL_OK) {
        return status;
    }
    status = sli_edit_make_graph(e, &G, &edges, a);
    if (status == SL_OK) {
        SLI_CLEAR(job);
        job.G = &G;
        job.perm = perm;
        job.scratch = scratch;
        job.septree = &septree;
        job.team = &alone;
        job.a = a;
        status = sli_graph_is_irregular(&G, 0) ? sli_order_mindeg(&job, scratch, &cost)
                                               : sli_order_compressed(&job, sli_order_nd);
    }
    if (status == SL_OK) {
        for (k = 0; k < count; k++) {
            scratch[k] = e->fresh[perm[k]];
        }
        for (k = 0; k < count; k++) { /* memcpy: gcc 12 for s390x sees a negative count */
            e->fresh[k] = scratch[k];
        }
    }
    sli_free(a, edges.base);
    sli_free(a, b.base);
    return status;
}

#endif

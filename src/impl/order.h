/* order.h: the fill-reducing order of the rows: natural, given, or nested dissection by component */
#ifndef SLI_ORDER_H
#define SLI_ORDER_H

#include "order_metis.h"
#include "permute.h"
#include "status.h"

static void sli_order_natural(sl_int n, sl_int *perm) {
    sl_int k;
    for (k = 0; k < n; k++) {
        perm[k] = k;
    }
}

static sl_status sli_order_given(const sl_int *given, sl_int n, sl_int *perm, sl_int *scratch,
                                 sl_stats *stats) {
    sl_int bad;
    if (given == NULL && n > 0) {
        return SL_ERR_ARGUMENT;
    }
    bad = sli_perm_invert(given, n, scratch);
    if (bad >= 0) {
        return sli_fail_at(stats, SL_ERR_ARGUMENT, bad, -1, 0.0);
    }
    if (n > 0) {
        memcpy(perm, given, (size_t)n * sizeof(sl_int));
    }
    return SL_OK;
}

#if !defined(SL_NO_METIS)
#define SLI_ORDER_TINY 4 /* a component this small has nothing to dissect */

/* One breadth-first search a component, the queue being perm itself; each component is then
 * dissected in its place. */
static sl_status sli_order_graph(const sli_graph *G, const sl_int *metis_options, sl_int *perm,
                                 sl_int *local, const sl_allocator *a) {
    sl_int root, head, tail = 0, start;
    sl_status status = SL_OK;
    for (root = 0; root < G->n; root++) {
        local[root] = -1;
    }
    for (root = 0; root < G->n && status == SL_OK; root++) {
        if (local[root] >= 0) {
            continue;
        }
        start = tail;
        local[root] = 0;
        perm[tail++] = root;
        for (head = start; head < tail; head++) {
            sl_off e;
            for (e = G->begin[perm[head]]; e < G->begin[perm[head] + 1]; e++) {
                const sl_int u = G->to[e];
                if (local[u] < 0) {
                    local[u] = tail - start;
                    perm[tail++] = u;
                }
            }
        }
        if (tail - start > SLI_ORDER_TINY) {
            status = sli_order_component(G, perm + start, tail - start, local, metis_options, a);
        }
    }
    return status;
}

/* Puts the lists of an unsorted graph in order, so that a matrix has one order however it is
 * stored. */
static sl_status sli_order_canonical(sli_graph *G, const sl_allocator *a) {
    const sl_off edges = G->begin[G->n];
    sli_block b = {NULL, 0, 0};
    sl_int *to = NULL;
    sl_off *at = NULL;
    sl_status status = SL_OK;
    int pass;
    if (sli_graph_is_sorted(G)) {
        return SL_OK;
    }
    for (pass = 0; pass < 2 && status == SL_OK; pass++) {
        to = SLI_TAKE(&b, sl_int, edges);
        at = SLI_TAKE(&b, sl_off, G->n);
        status = pass == 0 ? sli_block_alloc(&b, a) : SL_OK;
    }
    if (status == SL_OK) {
        sli_graph_sort(G, to, at);
        memcpy(G->to, to, (size_t)edges * sizeof(sl_int));
        sli_free(a, b.base);
    }
    return status;
}

static sl_status sli_order_dissection(const sl_csc *A, sl_triangle triangle, const sl_options *opt,
                                      sl_int *perm, sl_int *local, const sl_allocator *a) {
    sli_graph G;
    sli_block b = {NULL, 0, 0};
    sl_status status = SL_OK;
    int pass;
    if (!sli_metis_options_are_sound(opt != NULL ? opt->metis_options : NULL)) {
        return SL_ERR_ARGUMENT;
    }
    memset(&G, 0, sizeof G);
    for (pass = 0; pass < 2 && status == SL_OK; pass++) {
        G.n = A->n_cols;
        G.begin = SLI_TAKE(&b, sl_off, (size_t)G.n + 1);
        G.to = SLI_TAKE(&b, sl_int, 2 * (size_t)sli_nnz(A));
        status = pass == 0 ? sli_block_alloc(&b, a) : SL_OK;
    }
    if (status == SL_OK) {
        sli_graph_fill(&G, A, triangle);
        status = sli_order_canonical(&G, a);
        if (status == SL_OK) {
            status = sli_order_graph(&G, opt != NULL ? opt->metis_options : NULL, perm, local, a);
        }
        sli_free(a, b.base);
    }
    return status;
}
#endif

/* perm: n, the order of a checked symmetric pattern. scratch: n. */
static sl_status sli_order(const sl_csc *A, sl_triangle triangle, const sl_options *opt,
                           sl_int *perm, sl_int *scratch, const sl_allocator *a, sl_stats *stats) {
    sl_ordering ordering = opt != NULL ? opt->ordering : SL_ORDERING_DEFAULT;
#if defined(SL_NO_METIS)
    (void)a;
    (void)triangle;
    if (ordering == SL_ORDERING_DEFAULT) {
        ordering = SL_ORDERING_NATURAL;
    }
#else
    if (ordering == SL_ORDERING_DEFAULT || ordering == SL_ORDERING_METIS) {
        return sli_order_dissection(A, triangle, opt, perm, scratch, a);
    }
#endif
    if (ordering == SL_ORDERING_GIVEN) {
        return sli_order_given(opt->perm, A->n_cols, perm, scratch, stats);
    }
    if (ordering == SL_ORDERING_NATURAL) {
        sli_order_natural(A->n_cols, perm);
        return SL_OK;
    }
    return ordering == SL_ORDERING_METIS ? SL_ERR_UNSUPPORTED : SL_ERR_ARGUMENT;
}

#endif

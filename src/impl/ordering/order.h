/* order.h: the fill-reducing order of the rows: natural, given, or nested dissection */
#ifndef SLI_ORDER_H
#define SLI_ORDER_H

#include "order_compress.h"
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

#endif

/* Puts the lists of an unsorted graph in order and takes repeated edges out, so that a matrix has one
 * order however it is stored. */
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
        sli_graph_unite(G);
        sli_free(a, b.base);
    }
    return status;
}

/* An order of blocks of rows to one of rows; the same for the tree. */
static void sli_order_expand(sl_int blocks, sl_int block, sl_int *perm, sli_nest *nest) {
    sl_int k, c;
    for (k = blocks - 1; k >= 0; k--) {
        const sl_int v = perm[k], node = nest->count > 0 ? nest->of[k] : 0;
        for (c = block - 1; c >= 0; c--) {
            perm[k * block + c] = v * block + c;
            nest->of[k * block + c] = node;
        }
    }
}

/* By the graph of A, whose rows come in blocks. */
static sl_status sli_order_by_graph(const sl_csc *A, sl_triangle triangle, sl_ordering ordering,
                                    const sl_options *opt, sl_int *perm, sl_int *scratch,
                                    sli_nest *nest, const sl_allocator *a) {
    const sl_int block = opt != NULL && opt->block_size > 1 ? opt->block_size : 1;
    sli_graph G;
    sli_block b = {NULL, 0, 0};
    sl_status status = SL_OK;
    int pass;
    memset(&G, 0, sizeof G);
    for (pass = 0; pass < 2 && status == SL_OK; pass++) {
        G.n = A->n_cols / block;
        G.begin = SLI_TAKE(&b, sl_off, (size_t)G.n + 1);
        G.to = SLI_TAKE(&b, sl_int, 2 * (size_t)sli_nnz(A));
        status = pass == 0 ? sli_block_alloc(&b, a) : SL_OK;
    }
    if (status != SL_OK) {
        return status;
    }
    sli_graph_fill(&G, A, triangle, block);
    status = sli_order_canonical(&G, a);
    if (status == SL_OK && ordering != SL_ORDERING_METIS) {
        const int by_metis = ordering == SL_ORDERING_QUALITY;
        if (opt != NULL && opt->coordinates != NULL && !by_metis) {
            status = sli_order_own(&G, NULL, 0, opt->coordinates, opt->dimensions, perm, nest, a);
        } else {
            status = sli_order_compressed(&G, by_metis, perm, scratch, nest, a);
        }
    }
#if !defined(SL_NO_METIS)
    if (status == SL_OK && ordering == SL_ORDERING_METIS) {
        status = sli_order_graph(&G, opt != NULL ? opt->metis_options : NULL, perm, scratch, a);
    }
#endif
    if (status == SL_OK && block > 1) {
        sli_order_expand(G.n, block, perm, nest);
    }
    sli_free(a, b.base);
    return status;
}

/* Whether blocks and points are what n rows can have; *bad: the row of a point that is not finite,
 * -1 otherwise. */
static int sli_order_wishes_are_sound(const sl_options *opt, sl_int n, sl_int *bad) {
    sl_int v, k;
    *bad = -1;
    if (opt == NULL) {
        return 1;
    }
    if (opt->block_size < 0 || (opt->block_size > 1 && n % opt->block_size != 0) ||
        (opt->coordinates != NULL && opt->dimensions != 2 && opt->dimensions != 3)) {
        return 0;
    }
    for (v = 0; opt->coordinates != NULL && v < n / sli_max(opt->block_size, 1); v++) {
        for (k = 0; k < opt->dimensions; k++) {
            if (!sli_is_finite(opt->coordinates[(size_t)v * (size_t)opt->dimensions + (size_t)k])) {
                *bad = v * sli_max(opt->block_size, 1);
                return 0;
            }
        }
    }
    return 1;
}

/* perm: n, the order of a checked symmetric pattern; nest: its tree, n each, where it has one.
 * scratch: n. */
static sl_status sli_order(const sl_csc *A, sl_triangle triangle, const sl_options *opt,
                           sl_int *perm, sl_int *scratch, sli_nest *nest, const sl_allocator *a,
                           sl_stats *stats) {
    const sl_ordering wished = opt != NULL ? opt->ordering : SL_ORDERING_DEFAULT;
    const sl_ordering ordering = wished == SL_ORDERING_DEFAULT ? SL_ORDERING_FAST : wished;
    sl_int bad;
    nest->count = 0;
    if (!sli_order_wishes_are_sound(opt, A->n_cols, &bad)) {
        return bad == -1 ? SL_ERR_ARGUMENT : sli_fail_at(stats, SL_ERR_NOT_FINITE, bad, -1, 0.0);
    }
    switch (ordering) {
    case SL_ORDERING_GIVEN:
        return sli_order_given(opt->perm, A->n_cols, perm, scratch, stats);
    case SL_ORDERING_NATURAL:
        sli_order_natural(A->n_cols, perm);
        return SL_OK;
    case SL_ORDERING_FAST:
    case SL_ORDERING_BUILTIN:
        return sli_order_by_graph(A, triangle, ordering, opt, perm, scratch, nest, a);
    case SL_ORDERING_METIS:
    case SL_ORDERING_QUALITY:
#if defined(SL_NO_METIS)
        return SL_ERR_UNSUPPORTED;
#else
        return ordering == SL_ORDERING_METIS && !sli_metis_options_are_sound(opt->metis_options)
                   ? SL_ERR_ARGUMENT
                   : sli_order_by_graph(A, triangle, ordering, opt, perm, scratch, nest, a);
#endif
    default:
        return SL_ERR_ARGUMENT;
    }
}

#endif

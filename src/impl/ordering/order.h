/* order.h: the elimination order: natural, given, or fill-reducing */
#ifndef SLI_ORDERING_ORDER_H
#define SLI_ORDERING_ORDER_H

#include "border.h"
#include "compress.h"
#include "forest.h"
#include "graph_kind.h"
#include "peel.h"
#include "../matrix/permute.h"
#include "../base/status.h"

static void sli_order_natural(sl_int n, sl_int *perm) {
    sl_int k;
    for (k = 0; k < n; k++) {
        perm[k] = k;
    }
}

/* Copies a given order after a check that it is a permutation. scratch: n. */
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

#if defined(SLI_METIS)
#define SLI_ORDER_TINY 4 /* components of at most this size are not passed to METIS */

/* Orders the graph by METIS, component by component. A breadth-first search finds each component,
 * with perm itself as its queue; the component is then reordered in place. */
static sl_status sli_order_metis(const sli_graph *G, const sl_int *metis_options, sl_int *perm,
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
            status = sli_metis_order(G, perm + start, tail - start, local, metis_options, a);
        }
    }
    return status;
}

#endif

/* Sorts unsorted adjacency lists and removes repeated edges, so that a matrix has one order however
 * it is stored. */
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
        sli_graph_deduplicate(G);
        sli_free(a, b.base);
    }
    return status;
}

/* Expands the order and the separator tree from blocks of rows to rows. */
static void sli_order_expand(sl_int blocks, sl_int block, sl_int *perm, sli_septree *septree) {
    sl_int k, c;
    for (k = blocks - 1; k >= 0; k--) {
        const sl_int v = perm[k], node = septree->count > 0 ? septree->node_of[k] : 0;
        for (c = block - 1; c >= 0; c--) {
            perm[k * block + c] = v * block + c;
            septree->node_of[k * block + c] = node;
        }
    }
}

/* For each directed edge, a dissection takes as long as about this many operations of a
 * factorization. Measured on grids of 1e4 to 1e5 rows in 2D, 20^3 and 30^3, and scans. */
#define SLI_ORDER_ND_FLOPS 5000.0
/* For one factor, a dissection follows where half of the operations of minimum degree, about what
 * it saves, exceed this for each directed edge. Its time equals what it saves at 9000 on 7-point
 * volumes and on tetrahedra: at 6200 and 7600 minimum degree is better by a fifth, at 14000
 * dissection. */
#define SLI_ORDER_ND_SAVES 8000.0

/* Is the first factor wanted as early as possible? */
static int sli_order_is_hurried(sl_ordering ordering, const sl_options *opt) {
    return ordering == SL_ORDERING_MINDEG ||
           (ordering == SL_ORDERING_ND && opt != NULL && opt->purpose == SL_PURPOSE_ONE_FACTOR);
}

/* A second order, by minimum degree, of a graph on which it may be the better one. The analysis
 * counts both. */
typedef struct sli_order_choice {
    sl_int *other;  /* n rows */
    sl_off entries; /* about those of L; 0: not known */
    sl_int *parent; /* n rows: the elimination tree of an order in postorder, if has_tree */
    int has_tree;   /* A is a forest, and L has no fill */
    int is_wanted, is_there;
} sli_order_choice;

/* Orders a graph of rows or of blocks of rows. perm and septree hold its vertices. */
static sl_status sli_order_graph(const sli_graph *G, sl_ordering ordering, const sl_options *opt,
                                 sl_int *perm, sl_int *scratch, sli_septree *septree,
                                 sli_order_choice *choice, sli_team *team, const sl_allocator *a) {
    const int is_hurried = sli_order_is_hurried(ordering, opt);
#if defined(SLI_METIS)
    if (ordering == SL_ORDERING_METIS) {
        return sli_order_metis(G, opt->metis_options, perm, scratch, a);
    }
#endif
    if (is_hurried && ordering == SL_ORDERING_ND &&
        sli_order_levels(G, perm, scratch, &choice->entries)) {
        return SL_OK;
    }
    if (is_hurried) {
        sli_order_cost cost = {0.0, 0.0, 0.0, 0.0, 0.0};
        const sl_status status = sli_order_mindeg(G, perm, &cost, a);
        if (status != SL_OK || ordering == SL_ORDERING_MINDEG ||
            0.5 * cost.flops <= SLI_ORDER_ND_SAVES * (double)G->begin[G->n] ||
            sli_order_is_irregular(G, 1)) {
            return status;
        }
    }
    return sli_order_compressed(G, perm, scratch, septree, team, a);
}

/* Orders a graph as sli_order_graph does, and *other by minimum degree if that is wanted and the
 * graph irregular, but not thin. Minimum degree comes first, as it takes a fraction of the time,
 * and its tree may show which of the two is better. In bipartite graphs dissection saves little:
 * with PDE control in the plane, 13 to 20 % of the paths for 14 to 20 % more fill. */
static sl_status sli_order_both(const sli_graph *G, int is_peeled, sl_ordering ordering,
                                const sl_options *opt, sl_int *perm, sl_int *scratch,
                                sli_septree *septree, sli_order_choice *choice, sli_team *team,
                                const sl_allocator *a) {
    const int is_irregular = choice->is_wanted && sli_order_is_irregular(G, is_peeled);
    const int may_expand = choice->is_wanted && (is_peeled || sli_order_is_dense(G));
    const sli_graph_shape shape =
        is_irregular || may_expand ? sli_order_shape(G, perm, scratch) : SLI_SHAPE_OTHER;
    const int is_bipartite = choice->is_wanted && is_peeled && shape != SLI_SHAPE_THIN &&
                             sli_order_is_bipartite(G, perm, scratch);
    if ((is_irregular && shape != SLI_SHAPE_THIN) || is_bipartite || shape == SLI_SHAPE_EXPANDING) {
        sli_order_cost cost;
        const sl_status status = sli_order_mindeg(G, choice->other, &cost, a);
        const double share = status == SL_OK ? sli_order_path_share(&cost, G->n) : 0.0;
        if (status != SL_OK) {
            return status;
        }
        if (sli_order_has_core(&cost) || sli_order_is_without_fill(&cost, G) ||
            (is_bipartite && share < SLI_ORDER_PATHS_SHORT)) {
            memcpy(perm, choice->other, (size_t)G->n * sizeof(sl_int));
            septree->count = 0;
            return SL_OK;
        }
        choice->is_there = is_irregular && share < SLI_ORDER_PATHS_LONG;
    }
    return sli_order_graph(G, ordering, opt, perm, scratch, septree, choice, team, a);
}

/* The same, after rows with at most two neighbors have been eliminated. */
static sl_status sli_order_peeled(const sli_graph *G, sl_ordering ordering, const sl_options *opt,
                                  sl_int *perm, sl_int *scratch, sli_septree *septree,
                                  sli_order_choice *choice, sli_team *team, const sl_allocator *a) {
    sli_peel p;
    sli_block b = {NULL, 0, 0};
    sl_status status = SL_OK;
    int pass;
    memset(&p, 0, sizeof p);
    for (pass = 0; pass < 2 && status == SL_OK; pass++) {
        sli_peel_layout(&p, &b, G->n, G->begin[G->n]);
        status = pass == 0 ? sli_block_alloc(&b, a) : SL_OK;
    }
    if (status != SL_OK) {
        return status;
    }
    sli_peel_run(&p, G, sli_order_is_hurried(ordering, opt));
    sli_peel_finish(&p, G->n);
    status = sli_order_canonical(&p.rest, a);
    if (status == SL_OK) {
        status = sli_order_both(&p.rest, 1, ordering, opt, perm, scratch, septree, choice, team, a);
    }
    if (status == SL_OK) {
        sli_peel_expand(&p, perm);
        choice->entries = p.rest.n > 0 && choice->entries == 0
                              ? 0
                              : choice->entries + SLI_PEEL_ENTRIES * (sl_off)p.count;
        septree->count = 0; /* of the rows that were left only */
        if (choice->is_there) {
            sli_peel_expand(&p, choice->other);
        }
    }
    sli_free(a, b.base);
    return status;
}

/* Orders the rows by the graph of A, with blocks of rows as vertices. */
static sl_status sli_order_by_graph(const sl_csc *A, const sl_int *column, sl_triangle triangle,
                                    sl_ordering ordering, const sl_options *opt, sl_int *perm,
                                    sl_int *scratch, sli_septree *septree, sli_order_choice *choice,
                                    sli_team *team, const sl_allocator *a) {
    const sl_int block = opt != NULL && opt->block_size > 1 ? opt->block_size : 1;
    const int may_peel = ordering == SL_ORDERING_MINDEG || ordering == SL_ORDERING_ND;
    sli_graph G;
    sli_block b = {NULL, 0, 0};
    sl_status status = SL_OK;
    int pass;
    if (block == 1 && sli_order_is_hurried(ordering, opt) &&
        sli_order_forest(A, column, triangle, perm, choice->parent, scratch)) {
        choice->has_tree = 1;
        choice->entries = 2 * (sl_off)A->n_cols;
        return SL_OK;
    }
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
    sli_graph_fill(&G, A, column, triangle, block);
    status = sli_order_canonical(&G, a);
    choice->is_wanted &= block == 1;
    if (status == SL_OK) {
        status =
            may_peel && sli_peel_is_worthwhile(&G)
                ? sli_order_peeled(&G, ordering, opt, perm, scratch, septree, choice, team, a)
                : sli_order_both(&G, 0, ordering, opt, perm, scratch, septree, choice, team, a);
    }
    if (status == SL_OK && block > 1) {
        choice->entries = 0; /* those counted are blocks */
        sli_order_expand(G.n, block, perm, septree);
    } else if (status == SL_OK) {
        sli_septree none;
        sli_order_border(A, &G, perm, scratch, septree);
        if (choice->is_there) {
            sli_order_border(A, &G, choice->other, scratch, &none);
        }
    }
    sli_free(a, b.base);
    return status;
}

/* Are purpose and block size valid for n rows? */
static int sli_order_options_are_valid(const sl_options *opt, sl_int n) {
    return opt == NULL ||
           ((opt->purpose == SL_PURPOSE_MANY_SOLVES || opt->purpose == SL_PURPOSE_ONE_FACTOR) &&
            opt->block_size >= 0 && (opt->block_size <= 1 || n % opt->block_size == 0));
}

/* The workers that order A as the options say; those of METIS do not share. A hurried order of
 * fewer than 1e5 entries is that of one worker in nearly all cases, and takes 1 to 4 ms: waking
 * others would cost 2 % of that. */
static sl_int sli_order_workers(const sl_csc *A, const sl_options *opt) {
    const int is_shared = opt != NULL && opt->ordering == SL_ORDERING_ND;
    const double share = is_shared && sli_order_is_hurried(opt->ordering, opt) ? 0.06 : 0.5;
    const double flops = share * SLI_ORDER_ND_FLOPS * (double)sli_nnz(A);
    return is_shared ? sli_min(sli_workers_for(&opt->threads, flops), SLI_TEAM_MAX) : 1;
}

/* Finds the elimination order of a checked symmetric pattern. perm := n rows; septree := the
 * separator tree if the ordering has one (n entries of each array); choice: another order where
 * dissection, for many solves, may not be the best; column: of each entry; scratch: 4n. */
static sl_status sli_order(const sl_csc *A, const sl_int *column, sl_triangle triangle,
                           const sl_options *opt, sl_int *perm, sl_int *scratch,
                           sli_septree *septree, sli_order_choice *choice, sli_team *team,
                           const sl_allocator *a, sl_stats *stats) {
    const sl_ordering ordering = opt != NULL ? opt->ordering : SL_ORDERING_ND;
    septree->count = 0;
    choice->is_there = 0;
    choice->entries = 0;
    choice->has_tree = 0;
    choice->is_wanted =
        ordering == SL_ORDERING_ND && (opt == NULL || opt->purpose == SL_PURPOSE_MANY_SOLVES);
    if (!sli_order_options_are_valid(opt, A->n_cols)) {
        return SL_ERR_ARGUMENT;
    }
    switch (ordering) {
    case SL_ORDERING_GIVEN:
        return sli_order_given(opt->perm, A->n_cols, perm, scratch, stats);
    case SL_ORDERING_NATURAL:
        sli_order_natural(A->n_cols, perm);
        return SL_OK;
    case SL_ORDERING_ND:
    case SL_ORDERING_MINDEG:
        return sli_order_by_graph(A, column, triangle, ordering, opt, perm, scratch, septree,
                                  choice, team, a);
    case SL_ORDERING_METIS:
#if !defined(SLI_METIS)
        return SL_ERR_UNSUPPORTED;
#else
        return !sli_metis_options_are_valid(opt->metis_options)
                   ? SL_ERR_ARGUMENT
                   : sli_order_by_graph(A, column, triangle, ordering, opt, perm, scratch, septree,
                                        choice, team, a);
#endif
    default:
        return SL_ERR_ARGUMENT;
    }
}

#endif

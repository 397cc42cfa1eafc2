/* order.h: the elimination order: reduce the graph, describe it, choose, order, expand */
#ifndef SLI_ORDERING_ORDER_H
#define SLI_ORDERING_ORDER_H

#include "choice.h"
#include "compress.h"
#include "cuts.h"
#include "metis.h"
#include "nd.h"
#include "reduce.h"
#include "../matrix/submatrix.h"
#include "../base/status.h"

/* Copies a given order after a check that it is a permutation. */
static sl_status sli_order_given(const sli_order_job *job) {
    const sl_int *given = job->opt->perm, n = job->A->n_cols;
    const sl_int bad = sli_rows_invert(given, n, n, job->scratch);
    if (bad >= 0) {
        return sli_fail_at(job->stats, SL_ERR_ARGUMENT, bad, -1, given[bad],
                           "options.perm has a row out of range or twice at this position");
    }
    if (n > 0) {
        SLI_COPY(job->perm, given, n);
    }
    return SL_OK;
}

/* Orders the graph of a job, with indistinguishable rows as one vertex if that is worthwhile.
 * Nobody looks for them in a graph twice. */
static sl_status sli_order_compressed(const sli_order_job *job,
                                      sl_status (*order)(const sli_order_job *)) {
    sli_order_job inner;
    sli_compressed c;
    sli_block b = {NULL, 0};
    sl_status status;
    if (!job->may_compress) {
        return order(job);
    }
    SLI_CLEAR(c);
    status = sli_compress(job, &inner, &c, &b);
    if (status == SL_OK) {
        status = order(&inner);
    }
    if (status == SL_OK && inner.weight != NULL) {
        sli_compress_expand(&c, job->G->n, job->perm, job->septree, (sl_int *)(void *)c.G.begin);
    }
    sli_free(job->a, b.base);
    return status;
}

/* Orders what is left of the graph as its description suggests. */
static sl_status sli_order_chosen(const sli_order_job *job) {
    sli_graph_facts f;
    sl_status status = SL_OK;
    if (job->ordering == SL_ORDERING_MINDEG) {
        return sli_order_mindeg(job, job->scratch, &f.cost);
    }
    f = sli_graph_describe(job);
    while (status == SL_OK) {
        switch (sli_order_choose(&f)) { /* branches untested: each has a case */
        case SLI_TRY_LEVELS:
            f.bits |= SLI_TRIED_LEVELS;
            f.bits |= job->weight == NULL && sli_order_levels(job) ? SLI_IS_NARROW : 0;
            break;
        case SLI_TRY_MINDEG:
            status = sli_order_mindeg(job, job->scratch, &f.cost);
            sli_graph_describe_mindeg(job, &f); /* the scratch has the vertices of each pivot */
            break;
        case SLI_BY_TRIED:
            return SL_OK;
        case SLI_BY_CUTS:
            return sli_order_cuts(job, job->scratch, f.cost.pivots, (sl_off)f.cost.lists);
        case SLI_BY_DISSECTION:
            return sli_order_compressed(job, sli_order_nd);
        }
    }
    return status;
}

/* Orders what is left of the graph. Minimum degree finds indistinguishable rows in the list of each
 * neighbor: where some of these are long, rows are compressed first. */
static sl_status sli_order_rest(const sli_order_job *job) {
    const sl_off n = job->G->n, mean = n > 0 ? job->G->begin[n] / n : 0;
#if defined(SLI_METIS)
    if (job->ordering == SL_ORDERING_METIS) {
        return sli_order_metis(job);
    }
#endif
    return mean * mean <= n && sli_graph_is_irregular(job->G, job->is_peeled)
               ? sli_order_compressed(job, sli_order_chosen)
               : sli_order_chosen(job);
}

/* The same, after rows with at most two neighbors have been eliminated. */
static sl_status sli_order_peeled(const sli_order_job *job) {
    sli_order_job rest = *job;
    sli_peel p;
    sli_block b = {NULL, 0};
    sl_status status = SL_OK;
    SLI_CLEAR(p);
    SLI_LAYOUT(&b, job->a, status) {
        sli_peel_layout(&p, &b, job->G->n, job->G->begin[job->G->n]);
    }
    if (status != SL_OK) {
        return status;
    }
    sli_peel_run(&p, job->G, job->is_hurried);
    sli_peel_finish(&p, job->G->n);
    rest.G = &p.rest;
    rest.is_peeled = 1;
    status = sli_graph_make_canonical(&p.rest, job->a);
    if (status == SL_OK) {
        status = sli_order_rest(&rest);
    }
    if (status == SL_OK) {
        sli_peel_expand(&p, job->perm);
        job->septree->count = 0; /* of the rows that were left only */
    }
    sli_free(job->a, b.base);
    return status;
}

/* Expands the order and the separator tree from blocks of rows to rows. */
static void sli_order_expand(const sli_order_job *job) {
    const sl_int block = job->block;
    sl_int *perm = job->perm, k, c;
    sli_septree *septree = job->septree;
    for (k = job->G->n - 1; k >= 0; k--) {
        const sl_int v = perm[k], node = septree->count > 0 ? septree->node_of[k] : 0;
        for (c = block - 1; c >= 0; c--) {
            perm[k * block + c] = v * block + c;
            septree->node_of[k * block + c] = node;
        }
    }
}

/* Orders the rows by the graph of A, with blocks of rows as vertices. */
static sl_status sli_order_by_graph(sli_order_job *job) {
    sli_graph G;
    sli_block b = {NULL, 0};
    sl_status status = SL_OK;
    SLI_CLEAR(G);
    SLI_LAYOUT(&b, job->a, status) {
        G.n = job->A->n_cols / job->block;
        G.begin = SLI_TAKE(&b, sl_off, (size_t)G.n + 1);
        G.to = SLI_TAKE(&b, sl_int, 2 * (size_t)sli_nnz(job->A));
    }
    if (status != SL_OK) {
        return status;
    }
    sli_graph_fill(&G, job->A, job->column, job->triangle, job->block);
    status = sli_graph_make_canonical(&G, job->a);
    job->G = &G;
    if (status == SL_OK) {
        status = job->ordering != SL_ORDERING_METIS && sli_peel_is_worthwhile(&G)
                     ? sli_order_peeled(job)
                     : sli_order_rest(job);
    }
    if (status == SL_OK && job->block > 1) {
        sli_order_expand(job);
    } else if (status == SL_OK) {
        sli_order_border(job);
    }
    sli_free(job->a, b.base);
    return status;
}

/* What is wrong with the options of an order of n rows, or NULL. */
static const char *sli_order_options_wrong(const sl_options *opt, sl_int n) {
    return opt == NULL ? NULL
           : (unsigned)opt->purpose > (unsigned)SL_PURPOSE_ONE_FACTOR
               ? "options.purpose is not a value of sl_purpose"
           : (unsigned)opt->ordering > (unsigned)SL_ORDERING_MINDEG || (int)opt->ordering == 2
               ? "options.ordering is not a value of sl_ordering"
           : opt->ordering == SL_ORDERING_GIVEN && opt->perm == NULL && n > 0
               ? "options.perm is NULL though ordering is GIVEN"
           : opt->block_size < 0 ? "options.block_size is below 0"
           : opt->block_size > 1 && n % opt->block_size != 0
               ? "options.block_size does not divide n"
               : NULL;
}

/* Is the first factor wanted as early as possible? */
static int sli_order_is_hurried(const sl_options *opt) {
    return opt != NULL &&
           (opt->ordering == SL_ORDERING_MINDEG ||
            (opt->ordering == SL_ORDERING_ND && opt->purpose == SL_PURPOSE_ONE_FACTOR));
}

/* The workers that order A as the options say; those of METIS do not share. A hurried order of
 * fewer than 1e5 entries is that of one worker in nearly all cases, and takes 1 to 4 ms: waking
 * others would cost 2 % of that. */
static sl_int sli_order_workers(const sl_csc *A, const sl_options *opt) {
    const double share = sli_order_is_hurried(opt) ? 0.06 : 0.5;
    const double flops = share * SLI_ORDER_ND_FLOPS * (double)sli_nnz(A);
    return opt != NULL && opt->ordering == SL_ORDERING_ND
               ? sli_min(sli_workers_for(&opt->threads, flops), SLI_TEAM_MAX)
               : 1;
}

/* Finds the elimination order of a checked symmetric pattern: perm, the separator tree if the
 * ordering has one. */
static sl_status sli_order(sli_order_job *job) {
    const sl_options *opt = job->opt;
    const char *wrong = sli_order_options_wrong(opt, job->A->n_cols);
    if (wrong != NULL) {
        return sli_order_refuse(job, SL_ERR_ARGUMENT, wrong);
    }
    job->ordering = opt != NULL ? opt->ordering : SL_ORDERING_ND;
    job->is_hurried = sli_order_is_hurried(opt);
    job->block = opt != NULL && opt->block_size > 1 ? opt->block_size : 1;
    job->is_small = job->A->n_cols / job->block < SLI_DISSECT_SMALL;
    job->may_compress = 1;
    switch (job->ordering) {
    case SL_ORDERING_GIVEN:
        return sli_order_given(job);
    case SL_ORDERING_NATURAL:
        sli_order_natural(job->A->n_cols, job->perm);
        return SL_OK;
    case SL_ORDERING_METIS:
#if defined(SLI_METIS)
        return sli_order_by_graph(job);
#else
        return sli_order_refuse(job, SL_ERR_UNSUPPORTED, "options.ordering needs SL_METIS");
#endif
    default:
        if (job->block == 1 && job->is_hurried && sli_order_forest(job)) {
            job->choice->has_tree = 1;
            return SL_OK;
        }
        return sli_order_by_graph(job);
    }
}

#endif

/* job.h: what an ordering is given, and what it finds */
#ifndef SLI_ORDERING_JOB_H
#define SLI_ORDERING_JOB_H

#include "graph.h"
#include "../base/parallel.h"

/* The separator tree over all rows: its nodes in elimination order, none of them empty. */
typedef struct sli_septree {
    sl_int count;    /* 0: the ordering has no such tree */
    sl_int *node_of; /* by row: its node */
    sl_int *parent;  /* by node: the separator above it, which has a higher number, or -1 */
} sli_septree;

/* What else an ordering finds. */
typedef struct sli_order_choice {
    sl_int *parent; /* n rows: the elimination tree of an order in postorder, if has_tree */
    int has_tree;   /* A is a forest, and L has no fill */
} sli_order_choice;

/* An ordering under way. The caller of sli_order fills the first part and clears the rest. A step
 * that reduces the graph hands on a copy with what is left, and expands what comes back. */
typedef struct sli_order_job {
    const sl_csc *A;
    const sl_int *column; /* nnz: of each entry */
    sl_triangle triangle;
    const sl_options *opt;
    sl_int *perm;    /* n: the order */
    sl_int *scratch; /* 4 n */
    sli_septree *septree;
    sli_order_choice *choice;
    sli_team *team;
    const sl_allocator *a;
    sl_stats *stats;

    sl_ordering ordering; /* set by sli_order, as all that follows */
    int is_hurried;       /* the first factor is wanted as early as possible */
    sl_int block;         /* rows of a vertex of the first graph */
    const sli_graph *G;   /* the graph that is left */
    int is_small;         /* there are few rows or blocks: see SLI_DISSECT_SMALL */
    int is_peeled;        /* rows with few neighbors are gone from it */
    int may_compress;     /* the graph may have indistinguishable rows: nobody has looked yet */
    const sl_int *weight; /* G->n: rows of each vertex; NULL: 1 each */
} sli_order_job;

/* The rows that the vertices of a job's graph stand for. */
static sl_int sli_job_rows(const sli_order_job *job) {
    sl_int v, rows = job->G->n;
    for (v = 0; v < job->G->n && job->weight != NULL; v++) {
        rows += job->weight[v] - 1;
    }
    return rows;
}

/* Reports an error in the stats of a job: the caller of the analysis may be in another thread. */
SLI_COLD static sl_status sli_order_refuse(const sli_order_job *job, sl_status status,
                                           const char *what) {
    return sli_fail_at(job->stats, status, -1, -1, 0.0, what);
}

#endif

/* metis.h: the call to METIS, for each connected component */
#ifndef SLI_ORDERING_METIS_H
#define SLI_ORDERING_METIS_H

#include "job.h"

#if defined(SLI_METIS)

#include <metis.h>

/* Builds the component's graph in METIS's format, numbered by component. */
static void sli_metis_graph(const sli_graph *G, const sl_int *vertices, sl_int count,
                            const sl_int *local, idx_t *xadj, idx_t *adjncy) {
    sl_int k;
    idx_t edges = 0;
    for (k = 0; k < count; k++) {
        const sl_int v = vertices[k];
        sl_off e;
        xadj[k] = edges;
        for (e = G->begin[v]; e < G->begin[v + 1]; e++) {
            adjncy[edges++] = local[G->to[e]];
        }
    }
    xadj[count] = edges;
}

/* Reorders the vertices of a component of a job's graph in place. The index of each in vertices is
 * in the scratch of the job on entry. */
static sl_status sli_metis_order(const sli_order_job *job, sl_int *vertices, sl_int count) {
    const sli_graph *G = job->G;
    idx_t nv = (idx_t)count, *xadj = NULL, *adjncy = NULL, *perm = NULL, *iperm = NULL;
    sli_block b = {NULL, 0};
    sl_off edges = 0;
    sl_status status = SL_OK;
    sl_int k;
    int result;
    for (k = 0; k < count; k++) {
        edges += G->begin[vertices[k] + 1] - G->begin[vertices[k]];
    }
    if (sizeof(idx_t) < sizeof(sl_off) && edges > INT32_MAX) { /* untested: 2^31 edges */
        return sli_order_refuse(job, SL_ERR_TOO_LARGE,         /* untested: the same */
                                "METIS has 32-bit indices");
    }
    SLI_LAYOUT(&b, job->a, status) {
        xadj = SLI_TAKE(&b, idx_t, (size_t)count + 1);
        adjncy = SLI_TAKE(&b, idx_t, edges);
        perm = SLI_TAKE(&b, idx_t, count);
        iperm = SLI_TAKE(&b, idx_t, count);
    }
    if (status != SL_OK) {
        return status;
    }
    sli_metis_graph(G, vertices, count, job->scratch, xadj, adjncy);
    result = METIS_NodeND(&nv, xadj, adjncy, NULL, NULL, perm, iperm);
    if (result == METIS_OK) {
        for (k = 0; k < count; k++) { /* xadj is free now: it keeps the old order */
            xadj[k] = vertices[k];
        }
        for (k = 0; k < count; k++) {
            vertices[k] = (sl_int)xadj[perm[k]];
        }
    }
    sli_free(job->a, b.base);
    return result == METIS_OK ? SL_OK
           : result == METIS_ERROR_MEMORY
               ? sli_order_refuse(job, SL_ERR_MEMORY, "METIS has no memory")
               : sli_order_refuse(job, SL_ERR_ORDERING, "METIS_NodeND has failed");
}

/* Orders the graph of a job by METIS, component by component. A breadth-first search finds each
 * component, with perm itself as its queue; the component is then reordered in place. */
static sl_status sli_order_metis(const sli_order_job *job) {
    const sli_graph *G = job->G;
    sl_int *perm = job->perm, *local = job->scratch;
    sl_int root, head, tail = 0, start;
    sl_status status = SL_OK;
    SLI_NONE(local, G->n);
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
        if (tail - start > 4) { /* others need no order */
            status = sli_metis_order(job, perm + start, tail - start);
        }
    }
    return status;
}

#endif

#endif

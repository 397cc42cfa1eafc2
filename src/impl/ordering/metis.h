/* metis.h: the call to METIS: the order of a connected component */
#ifndef SLI_ORDERING_METIS_H
#define SLI_ORDERING_METIS_H

#include "../base/alloc.h"
#include "graph.h"
#include "coarsen.h"

#if defined(SLI_METIS)

#include <metis.h>

/* Returns whether METIS can run with these options. With others it prints a message or never ends.
 * Options that METIS_NodeND does not read may have any value; -1 is METIS's default. */
static int sli_metis_options_are_valid(const sl_int *options) {
    static const struct {
        int option, low, high;
    } sli_ranges[] = {
        {METIS_OPTION_OBJTYPE, METIS_OBJTYPE_NODE, METIS_OBJTYPE_NODE},
        {METIS_OPTION_CTYPE, METIS_CTYPE_RM, METIS_CTYPE_SHEM},
        {METIS_OPTION_IPTYPE, METIS_IPTYPE_EDGE, METIS_IPTYPE_NODE},
        {METIS_OPTION_RTYPE, METIS_RTYPE_SEP2SIDED, METIS_RTYPE_SEP1SIDED},
        {METIS_OPTION_NITER, 1, INT32_MAX},
        {METIS_OPTION_COMPRESS, 0, 1},
        {METIS_OPTION_CCORDER, 0, 1},
        {METIS_OPTION_PFACTOR, 0, INT32_MAX},
        {METIS_OPTION_NSEPS, 1, INT32_MAX},
        {METIS_OPTION_UFACTOR, 1, 999}, /* from 1000 on, bisections may leave a side empty */
    };
    size_t k;
    for (k = 0; options != NULL && k < sizeof sli_ranges / sizeof *sli_ranges; k++) {
        const sl_int value = options[sli_ranges[k].option];
        if (value != -1 && (value < sli_ranges[k].low || value > sli_ranges[k].high)) {
            return 0;
        }
    }
    return 1;
}

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

/* Reorders the vertices of a component of G in place. local[v]: the index of v in vertices on
 * entry. */
static sl_status sli_metis_order(const sli_graph *G, sl_int *vertices, sl_int count,
                                 const sl_int *local, const sl_int *metis_options,
                                 const sl_allocator *a) {
    idx_t options[METIS_NOPTIONS], nv = (idx_t)count, *xadj = NULL, *adjncy = NULL, *perm = NULL,
                                   *iperm = NULL;
    sli_block b = {NULL, 0, 0};
    sl_off edges = 0;
    sl_status status = SL_OK;
    sl_int k;
    int pass, result;
    for (k = 0; k < count; k++) {
        edges += G->begin[vertices[k] + 1] - G->begin[vertices[k]];
    }
    if (sizeof(idx_t) < sizeof(sl_off) && edges > INT32_MAX) { /* untested: 2^31 edges */
        return SL_ERR_TOO_LARGE;                               /* untested: the same */
    }
    for (pass = 0; pass < 2 && status == SL_OK; pass++) {
        xadj = SLI_TAKE(&b, idx_t, (size_t)count + 1);
        adjncy = SLI_TAKE(&b, idx_t, edges);
        perm = SLI_TAKE(&b, idx_t, count);
        iperm = SLI_TAKE(&b, idx_t, count);
        status = pass == 0 ? sli_block_alloc(&b, a) : SL_OK;
    }
    if (status != SL_OK) {
        return status;
    }
    sli_metis_graph(G, vertices, count, local, xadj, adjncy);
    METIS_SetDefaultOptions(options);
    for (k = 0; metis_options != NULL && k < METIS_NOPTIONS; k++) {
        options[k] = metis_options[k];
    }
    options[METIS_OPTION_NUMBERING] = 0;
    options[METIS_OPTION_DBGLVL] = 0; /* any other level prints */
    result = METIS_NodeND(&nv, xadj, adjncy, NULL, options, perm, iperm);
    if (result == METIS_OK) {
        for (k = 0; k < count; k++) { /* xadj is free now: it keeps the old order */
            xadj[k] = vertices[k];
        }
        for (k = 0; k < count; k++) {
            vertices[k] = (sl_int)xadj[perm[k]];
        }
    }
    sli_free(a, b.base);
    return result == METIS_OK             ? SL_OK
           : result == METIS_ERROR_MEMORY ? SL_ERR_MEMORY
                                          : SL_ERR_ORDERING;
}

#endif

#endif

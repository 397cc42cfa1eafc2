/* quotient_order.h: minimum degree ordering of a whole graph, and what it costs */
#ifndef SLI_ORDERING_QUOTIENT_ORDER_H
#define SLI_ORDERING_QUOTIENT_ORDER_H

#include "quotient.h"

/* Writes the vertices in a postorder of the tree of absorbed elements: fronts that update one
 * another are then close together, and the analysis reads them a third faster. A merged vertex
 * follows the pivot at the end of its chain. Dense ones are there already. sizes: vertices of each
 * pivot. */
static void sli_quotient_write(sli_quotient *q, sl_int *perm, sl_int *sizes) {
    sl_int *start = q->head, *into = q->list; /* the lists are done with */
    sl_int v, k, at = 0;
    for (v = 0; v < q->n; v++) {
        into[v] = q->node[v].into;
    }
    sli_postorder(into, q->sequence, q->pivots, q->sequence, q->bucket, q->mark);
    for (k = 0; k < q->pivots; k++) {
        sizes[k] = 1;
        q->bucket[q->sequence[k]] = k;
    }
    for (v = 0; v < q->n; v++) {
        sl_int root = v;
        if (q->node[v].elements == SLI_QUOTIENT_PIVOT || q->node[v].into == -1) {
            continue;
        }
        while (q->node[root].elements != SLI_QUOTIENT_PIVOT) {
            root = q->node[root].into;
        }
        for (k = v; k != root;) { /* shortens the chain for those that come later */
            const sl_int up = q->node[k].into;
            q->node[k].into = root;
            k = up;
        }
        sizes[q->bucket[root]]++;
    }
    for (k = 0; k < q->pivots; k++) {
        perm[at] = q->sequence[k];
        start[q->sequence[k]] = at + 1;
        at += sizes[k];
    }
    for (v = 0; v < q->n; v++) {
        if (q->node[v].elements != SLI_QUOTIENT_PIVOT && q->node[v].into != -1) {
            perm[start[q->node[v].into]++] = v;
        }
    }
}

/* What an order costs: whole numbers, but for quarters. */
typedef struct sli_order_cost {
    double flops;   /* about the operations of a factorization */
    double entries; /* of L */
    double paths;   /* entries of L on the paths from all rows to the roots */
    double widest;  /* rows below the tallest pivot */
    double fronts;  /* entries of a triangle as tall as the tallest pivot on the path of each row */
    double lists;   /* rows below all pivots */
    sl_int pivots;
} sli_order_cost;

/* below: n of scratch, for the rows of each subtree; then for the tallest pivot of each path. */
static void sli_quotient_cost(const sli_quotient *q, sl_int *below, sli_order_cost *cost) {
    sl_int k;
    SLI_CLEAR(*cost);
    cost->flops = 0.25 * q->flops;
    cost->widest = q->widest;
    cost->pivots = q->pivots;
    SLI_ZERO(below, q->n);
    for (k = 0; k < q->pivots; k++) {
        const sl_int v = q->sequence[k], width = q->weight[v];
        const double height = 2.0 * q->node[v].degree + width;
        below[v] += width;
        cost->entries += 0.5 * (height + 1) * width;
        cost->lists += q->node[v].degree;
        cost->paths += 0.5 * height * width * below[v];
        if (q->node[v].into != -1) {
            below[q->node[v].into] += below[v];
        }
    }
    for (k = q->pivots - 1; k >= 0; k--) {
        const sl_int v = q->sequence[k], up = q->node[v].into;
        const sl_int height = q->node[v].degree + q->weight[v];
        below[v] = up != -1 && below[up] > height ? below[up] : height;
        cost->fronts += 0.5 * below[v] * below[v] * q->weight[v];
    }
}

/* Orders the graph of a job, which has no repeated edges, by approximate minimum degree. Of equal
 * degrees the latest comes first, and of vertices that no pivot has updated the last, as in AMD
 * [ADD96]: from the first on, 9-point grids and thin plates have 1.3 to 1.5 times the fill.
 * *cost := of this order, without dense vertices; sizes := the vertices of each of its pivots. */
static sl_status sli_order_mindeg(const sli_order_job *job, sl_int *sizes, sli_order_cost *cost) {
    sli_quotient q;
    sli_block b = {NULL, 0};
    sl_status status = SL_OK;
    sl_int pivot;
    SLI_CLEAR(q);
    q.n = job->G->n;
    q.total = sli_job_rows(job);
    SLI_LAYOUT(&b, job->a, status) {
        sli_quotient_layout(&q, &b, job->G->begin[q.n]);
    }
    if (status != SL_OK) {
        return status;
    }
    sli_quotient_start(&q, job);
    while (q.rows < q.live) {
        while (q.head[q.least] == -1) {
            q.least++;
        }
        if (q.base > INT32_MAX - 3 * (sl_off)q.total - 3) {
            for (pivot = 0; pivot < q.n; pivot++) {
                q.mark[pivot] = q.mark[pivot] != 0;
            }
            q.base = 2;
        }
        pivot = q.head[q.least];
        sli_quotient_dequeue(&q, pivot);
        if (q.node[pivot].elements == SLI_QUOTIENT_WAITS) {
            sli_quotient_catch_up(&q, pivot);
        } else {
            sli_quotient_eliminate(&q, pivot);
        }
    }
    sli_quotient_cost(&q, q.head, cost);
    sli_quotient_write(&q, job->perm, sizes);
    sli_free(job->a, b.base);
    return SL_OK;
}

#endif

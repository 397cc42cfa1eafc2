/* quotient.h: elimination of variables of approximate minimum degree from a quotient graph */
#ifndef SLI_ORDERING_QUOTIENT_H
#define SLI_ORDERING_QUOTIENT_H

#include "job.h"
#include "../base/alloc.h"

#if !defined(SLI_MARKS_BEGIN) /* a test defines it as a variable */
#define SLI_MARKS_BEGIN 2
#endif

#define SLI_QUOTIENT_LONG 32 /* of longer lists of variables nearly all entries are left */

/* instead of a number of elements */
enum { SLI_QUOTIENT_PIVOT = -1, SLI_QUOTIENT_MERGED = -2, SLI_QUOTIENT_WAITS = -3 };

/* What is read together of a variable or an element: half a cache line. */
typedef struct sli_quotient_node {
    sl_off begin;    /* where its list begins */
    sl_int length;   /* entries in it; 0 if it is dead */
    sl_int elements; /* elements in the list of a variable, or SLI_QUOTIENT_PIVOT, ... */
    sl_int degree;   /* bound on the external degree; of an element, weight of its list */
    sl_int next;     /* list of equal degrees; chain of equal hashes within the front */
    sl_int previous; /* list of equal degrees; the hash within the front */
    sl_int into;     /* what a variable is merged into, or an element absorbed by; or -1 */
} sli_quotient_node;

/* The quotient graph. A variable stands for rows that have become indistinguishable. A pivot
 * becomes an element, whose list names the variables of its front. The list of a variable holds
 * elements first, then the variables that only an entry of A joins to it. No list ever grows, so
 * that the graph stays within its first size, plus one front that is being formed. [ADD96]
 *
 * A variable of far more neighbors than the pivot waits: its degree is a lower bound, its list not
 * updated. Where many constraints share few variables, updates took 9/10 of the time. */
typedef struct sli_quotient {
    sl_int n, total;         /* vertices of the graph, and the rows that they stand for */
    sl_off end, room;        /* of list: positions used, and available */
    sl_int *list;            /* all lists */
    sli_quotient_node *node; /* n */
    sl_int *weight;      /* n: rows of a variable; 0: merged; negated in the front being formed */
    sl_int *mark;        /* n: 0 for a dead element, otherwise see sli_quotient_overlaps */
    sl_int *head;        /* total: first variable of each degree, or -1 */
    sl_int *bucket;      /* n: first variable of each hash, or -1 */
    sl_int *sequence;    /* n: pivots in the order of elimination */
    sl_int live;         /* rows that are not dense */
    sl_int pivots, rows; /* pivots and rows eliminated */
    double flops;        /* about 4 times the operations of the pivots so far; a whole number */
    sl_int least;        /* no variable has a smaller degree */
    sl_int widest;       /* largest degree of an element */
    sl_int base;         /* marks below it are old */
} sli_quotient;

static void sli_quotient_layout(sli_quotient *q, sli_block *b, sl_off edges) {
    const sl_int n = q->n;
    q->room = edges + edges / 4 + n;
    q->node = SLI_TAKE(b, sli_quotient_node, n);
    q->list = SLI_TAKE(b, sl_int, q->room);
    q->weight = SLI_TAKE(b, sl_int, n);
    q->mark = SLI_TAKE(b, sl_int, n);
    q->head = SLI_TAKE(b, sl_int, q->total);
    q->bucket = SLI_TAKE(b, sl_int, n);
    q->sequence = SLI_TAKE(b, sl_int, n);
}

SLI_INLINE void sli_quotient_enqueue(sli_quotient *q, sl_int v) {
    const sl_int degree = q->node[v].degree, first = q->head[degree];
    q->node[v].next = first;
    q->node[v].previous = -1;
    if (first != -1) {
        q->node[first].previous = v;
    }
    q->head[degree] = v;
    q->least = degree < q->least ? degree : q->least;
}

SLI_INLINE void sli_quotient_dequeue(sli_quotient *q, sl_int v) {
    const sl_int before = q->node[v].previous, after = q->node[v].next;
    if (after != -1) {
        q->node[after].previous = before;
    }
    if (before != -1) {
        q->node[before].next = after;
    } else {
        q->head[q->node[v].degree] = after;
    }
}

/* Makes every vertex of a job's graph a variable, except for dense ones, whose degrees would be
 * updated by every pivot: they are written to the end of its perm. */
static void sli_quotient_start(sli_quotient *q, const sli_order_job *job) {
    const sli_graph *G = job->G;
    sl_int v, end = q->n;
    sl_off e;
    q->live = 0;
    q->pivots = q->rows = q->least = q->widest = 0;
    q->end = 0;
    q->flops = 0.0;
    q->base = SLI_MARKS_BEGIN;
    for (v = 0; v < q->n; v++) {
        sl_off degree = sli_graph_degree(G, v);
        int is_dense;
        for (e = G->begin[v]; e < G->begin[v + 1] && job->weight != NULL; e++) {
            degree += job->weight[G->to[e]] - 1;
        }
        is_dense = degree > 16 && sli_is_dense_row(degree, q->total);
        q->weight[v] = is_dense ? 0 : job->weight != NULL ? job->weight[v] : 1;
        q->live += q->weight[v];
        q->node[v].elements = is_dense ? SLI_QUOTIENT_MERGED : 0;
        q->mark[v] = 1;
        q->bucket[v] = q->node[v].into = -1;
        if (is_dense) {
            job->perm[--end] = v;
        }
    }
    for (v = 0; v < q->n; v++) {
        q->node[v].begin = q->end;
        q->node[v].degree = 0;
        for (e = G->begin[v]; e < G->begin[v + 1] && q->weight[v] != 0; e++) {
            if (q->weight[G->to[e]] != 0) {
                q->node[v].degree += q->weight[G->to[e]];
                q->list[q->end++] = G->to[e];
            }
        }
        q->node[v].length = (sl_int)(q->end - q->node[v].begin);
    }
    SLI_NONE(q->head, q->total);
    for (v = 0; v < q->n; v++) { /* the last row comes first: see sli_order_mindeg */
        if (q->weight[v] != 0) {
            sli_quotient_enqueue(q, v);
        }
    }
}

/* Moves the lists together. Meanwhile the first entry of a list is kept in place of its begin, and
 * the owner of the list stands there instead, as ~owner. */
static void sli_quotient_collect(sli_quotient *q) {
    sl_off from = 0, to = 0;
    sl_int v, k;
    for (v = 0; v < q->n; v++) {
        if (q->node[v].length > 0) {
            const sl_off at = q->node[v].begin;
            q->node[v].begin = q->list[at];
            q->list[at] = ~v;
        }
    }
    while (from < q->end) {
        v = q->list[from++];
        if (v >= 0) {
            continue; /* no longer in any list */
        }
        v = ~v;
        q->list[to] = (sl_int)q->node[v].begin;
        q->node[v].begin = to++;
        for (k = 1; k < q->node[v].length; k++) {
            q->list[to++] = q->list[from++];
        }
    }
    q->end = to;
}

/* Moves the variables of one list into the front that is being formed, which ends at `to`. */
SLI_INLINE sl_off sli_quotient_gather(sli_quotient *q, sl_off from, sl_int count, sl_off to,
                                      sl_int *total) {
    for (; count > 0; count--) {
        const sl_int v = q->list[from++], weight = q->weight[v];
        if (weight > 0) {
            q->weight[v] = -weight;
            *total += weight;
            q->list[to++] = v;
            sli_quotient_dequeue(q, v);
        }
    }
    return to;
}

SLI_INLINE void sli_quotient_absorb(sli_quotient *q, sl_int element, sl_int pivot) {
    q->mark[element] = 0;
    q->node[element].length = 0;
    q->node[element].into = pivot;
}

/* Makes the variable `pivot` an element: its list becomes the variables next to it, directly or
 * through its elements, which it absorbs. Returns the weight of the list. */
static sl_int sli_quotient_form(sli_quotient *q, sl_int pivot) {
    const sl_int elements = q->node[pivot].elements;
    sl_int total = 0, k;
    sl_off at, begin, to;
    q->node[pivot].elements = SLI_QUOTIENT_PIVOT;
    q->weight[pivot] = -q->weight[pivot]; /* stays out of its own front */
    if (elements > 0 && q->room - q->end < q->n - q->pivots) {
        sli_quotient_collect(q);
    }
    at = q->node[pivot].begin;
    begin = to = elements > 0 ? q->end : at; /* without elements in place */
    for (k = 0; k < elements; k++) {
        const sl_int e = q->list[at + k];
        SLI_ASSERT(q->mark[e] != 0); /* lists lose absorbed elements with each front */
        to = sli_quotient_gather(q, q->node[e].begin, q->node[e].length, to, &total);
        sli_quotient_absorb(q, e, pivot);
    }
    to = sli_quotient_gather(q, at + elements, q->node[pivot].length - elements, to, &total);
    q->end = elements > 0 ? to : q->end;
    q->node[pivot].begin = begin;
    q->node[pivot].length = (sl_int)(to - begin);
    return total;
}

/* mark[e] - base := the weight of what element e has outside the front, for every element next to a
 * variable of the front. */
static void sli_quotient_overlaps(sli_quotient *q, sl_int pivot) {
    const sl_int *front = q->list + q->node[pivot].begin;
    const sl_int size = q->node[pivot].length;
    const sl_int base = q->base;
    sl_int k, p;
    for (k = 0; k < size; k++) {
        const sl_int weight = -q->weight[front[k]], count = q->node[front[k]].elements;
        const sl_int *elements = q->list + q->node[front[k]].begin;
        for (p = 0; p < count; p++) {
            const sl_int e = elements[p], mark = q->mark[e];
            if (mark >= base) {
                q->mark[e] = mark - weight;
            } else if (mark != 0) {
                q->mark[e] = q->node[e].degree + base - weight;
            }
        }
    }
}

/* Rewrites the list of variable v of the front: the new element comes first, elements within the
 * front are absorbed, variables of the front are left out. Returns whether anything but the new
 * element is left. Otherwise v can be eliminated with the pivot. */
static int sli_quotient_rewrite(sli_quotient *q, sl_int v, sl_int pivot) {
    sl_int *list = q->list + q->node[v].begin;
    const sl_int elements = q->node[v].elements, length = q->node[v].length;
    sl_int k, to = 0, degree = 0, first_variable;
    uint32_t hash = 0;
    for (k = 0; k < elements; k++) {
        const sl_int e = list[k], outside = q->mark[e] - q->base;
        if (q->mark[e] == 0) {
            continue;
        }
        if (outside > 0) {
            degree += outside;
            hash += (uint32_t)e;
            list[to++] = e;
        } else {
            sli_quotient_absorb(q, e, pivot);
        }
    }
    first_variable = to;
    k = elements;
    if (length - elements > SLI_QUOTIENT_LONG) {
        for (; k < length; k++) {
            const sl_int u = list[k], weight = q->weight[u];
            if (weight > 0) {
                degree += weight;
                hash += (uint32_t)u;
                list[to++] = u;
            }
        }
    }
    for (; k < length; k++) { /* without a branch: processors do not foresee which ones are left */
        const sl_int u = list[k], weight = q->weight[u] > 0 ? q->weight[u] : 0;
        degree += weight;
        hash += weight > 0 ? (uint32_t)u : 0;
        list[to] = u;
        to += weight > 0;
    }
    if (to == 0) {
        return 0;
    }
    list[to] = list[first_variable]; /* the pivot, or what it absorbed, has left a gap */
    list[first_variable] = list[0];
    list[0] = pivot;
    q->node[v].elements = first_variable + 1;
    q->node[v].length = to + 1;
    q->node[v].degree = degree < q->node[v].degree ? degree : q->node[v].degree;
    hash = (uint32_t)((uint64_t)(hash * 0x9e3779b1u) * (uint32_t)q->n >> 32); /* 0 .. n-1 */
    q->node[v].previous = (sl_int)hash;
    q->node[v].next = q->bucket[hash];
    q->bucket[hash] = v;
    return 1;
}

/* Merges variable v into `root`, a pivot or a variable. */
SLI_INLINE void sli_quotient_merge(sli_quotient *q, sl_int v, sl_int root) {
    q->node[v].into = root;
    q->weight[root] += q->weight[v]; /* both negative */
    q->weight[v] = 0;
    q->node[v].length = 0;
    q->node[v].elements = SLI_QUOTIENT_MERGED;
}

/* Returns whether the lists of u and v agree after their first entry, the new element. All entries
 * of u's list are marked with base. */
SLI_INLINE int sli_quotient_is_indistinguishable(const sli_quotient *q, sl_int u, sl_int v) {
    const sl_int *list = q->list + q->node[v].begin;
    sl_int k = 1;
    if (q->node[u].length != q->node[v].length || q->node[u].elements != q->node[v].elements) {
        return 0;
    }
    while (k < q->node[v].length && q->mark[list[k]] == q->base) {
        k++;
    }
    return k == q->node[v].length;
}

/* Merges the variables of the front that are indistinguishable, among those of one hash. */
static void sli_quotient_merge_chain(sli_quotient *q, sl_int u) {
    for (; u != -1 && q->node[u].next != -1; u = q->node[u].next, q->base++) {
        const sl_int *list = q->list + q->node[u].begin;
        sl_int k, before = u, v = q->node[u].next;
        for (k = 1; k < q->node[u].length; k++) {
            q->mark[list[k]] = q->base;
        }
        while (v != -1) {
            const sl_int after = q->node[v].next;
            if (sli_quotient_is_indistinguishable(q, u, v)) {
                sli_quotient_merge(q, v, u);
                q->node[before].next = after;
            } else {
                before = v;
            }
            v = after;
        }
    }
}

/* Is a degree far above the least one? */
SLI_INLINE int sli_quotient_is_far(sl_int degree, sl_int least) {
    return degree >> 3 > least + 4;
}

/* Updates a variable that waits. If its degree is far, it waits on. */
static void sli_quotient_catch_up(sli_quotient *q, sl_int v) {
    sli_quotient_node *p = &q->node[v];
    sl_int *list = q->list + p->begin;
    const sl_int most = q->live - q->rows - q->weight[v], length = p->length;
    sl_int k, elements = 0, to = 0, degree = 0;
    sl_off at, end;
    q->mark[v] = q->base;
    for (k = 0; k < length; k++) {
        sl_int u = list[k];
        const int is_pivot = q->node[u].elements == SLI_QUOTIENT_PIVOT;
        while (is_pivot && q->node[u].into != -1) {
            u = q->node[u].into;
        }
        if (q->weight[u] == 0 || q->mark[u] == q->base) {
            continue;
        }
        q->mark[u] = q->base;
        degree += is_pivot ? 0 : q->weight[u];
        list[to++] = list[elements];
        list[is_pivot ? elements++ : to - 1] = u;
    }
    p->length = to;
    for (k = 0; k < elements && degree < most && !sli_quotient_is_far(degree, q->least); k++) {
        at = q->node[list[k]].begin;
        for (end = at + q->node[list[k]].length; at < end; at++) {
            const sl_int u = q->list[at];
            degree += q->mark[u] == q->base ? 0 : q->weight[u];
            q->mark[u] = q->base;
        }
    }
    q->base++;
    p->elements = sli_quotient_is_far(degree, q->least) ? SLI_QUOTIENT_WAITS : elements;
    p->degree = degree;
    sli_quotient_enqueue(q, v);
}

/* Does v wait, which has no elements? Its degree loses the rows eliminated, after the caller has
 * added what is left of the front. pivot: its weight, negative. */
static int sli_quotient_waits(sli_quotient *q, sl_int v, sl_int total, sl_int pivot) {
    sli_quotient_node *p = &q->node[v];
    if (p->elements == 0 && !sli_quotient_is_far(p->degree, total)) {
        return 0;
    }
    p->elements = SLI_QUOTIENT_WAITS;
    p->degree = sli_max(p->degree - total + pivot - q->weight[v], 0);
    return 1;
}

/* Eliminates a variable of least degree, and with it those that have no other neighbors. */
static void sli_quotient_eliminate(sli_quotient *q, sl_int pivot) {
    const sl_int total = sli_quotient_form(q, pivot), count = q->node[pivot].length;
    sl_int *front = q->list + q->node[pivot].begin;
    sl_int k, kept = 0, left = total;
    double height;
    q->rows -= q->weight[pivot];
    sli_quotient_overlaps(q, pivot);
    for (k = 0; k < count; k++) {
        const sl_int v = front[k];
        if (q->node[v].elements <= 0 && sli_quotient_waits(q, v, total, q->weight[pivot])) {
            continue;
        }
        if (!sli_quotient_rewrite(q, v, pivot)) {
            left += q->weight[v];
            q->rows -= q->weight[v];
            sli_quotient_merge(q, v, pivot);
        }
    }
    q->widest = total > q->widest ? total : q->widest;
    q->base += q->widest + 1;
    for (k = 0; k < count; k++) {
        if (q->node[front[k]].elements > 0) {
            const sl_int hash = q->node[front[k]].previous, first = q->bucket[hash];
            q->bucket[hash] = -1;
            sli_quotient_merge_chain(q, first);
        }
    }
    for (k = 0; k < count; k++) {
        const sl_int v = front[k], weight = -q->weight[v];
        if (weight != 0) {
            q->weight[v] = weight;
            q->node[v].degree =
                sli_min(q->node[v].degree + left - weight, q->live - q->rows - weight);
            sli_quotient_enqueue(q, v);
            front[kept++] = v;
        }
    }
    q->weight[pivot] = -q->weight[pivot];
    q->node[pivot].degree = left;
    q->mark[pivot] = kept > 0;
    q->end -= q->end == q->node[pivot].begin + count ? count - kept : 0;
    q->node[pivot].length = kept;
    q->sequence[q->pivots++] = pivot;
    height = 2.0 * left + q->weight[pivot];
    q->flops += height * height * q->weight[pivot];
}

#endif

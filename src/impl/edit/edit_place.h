/* edit_place.h: places new rows in the tree of supernodes, and moves rows until every entry of the
 * edited matrix joins two nodes of which one is an ancestor of the other */
#ifndef SLI_EDIT_PLACE_H
#define SLI_EDIT_PLACE_H

#include "edit_match.h"

/* Marks the neighbors of the rows of a layer as the next one. */
static void sli_edit_grow(sli_edit *e, int layer) {
    const sl_csc *B = e->B;
    const int is_whole = e->triangle == SL_TRIANGLE_BOTH;
    sl_int j, p;
    for (j = 0; j < e->n; j++) {
        for (p = is_whole && e->is_active[j] != layer ? B->p[j + 1] : B->p[j]; p < B->p[j + 1];
             p++) {
            const int a = e->is_active[j], b = e->is_active[B->i[p]];
            if (a == 0 && b == layer && sli_is_read(e->triangle, B->i[p], j)) {
                e->is_active[j] = (unsigned char)(layer + 1);
            } else if (b == 0 && a == layer && (is_whole || sli_is_read(e->triangle, B->i[p], j))) {
                e->is_active[B->i[p]] = (unsigned char)(layer + 1);
            }
        }
    }
}

/* Lists the active rows and those near them. */
static void sli_edit_list(sli_edit *e) {
    sl_int j;
    e->n_near = 0;
    for (j = 0; j < e->n; j++) {
        e->number[j] = -1;
        if (e->is_active[j]) {
            e->number[j] = e->n_near;
            e->around[e->n_near++] = j;
        }
    }
}

/* Enters two rows into each other's lists, where they have one; without `to` the lengths are
 * counted. */
SLI_INLINE void sli_edit_enter(sli_edit *e, sl_int i, sl_int j) {
    const sl_int k = e->number[i];
    if (k != -1 && e->to == NULL) {
        e->begin[k]++;
    } else if (k != -1) {
        e->to[e->begin[k]++] = j;
    }
}

/* Counts the neighbors of the near rows, or lists them; begin then moves to the end of each
 * list. The columns of a matrix with both triangles are complete. */
static void sli_edit_scan(sli_edit *e) {
    const sl_csc *B = e->B;
    sl_int j, k, p;
    for (k = 0; k < e->n_near && e->triangle == SL_TRIANGLE_BOTH; k++) {
        j = e->around[k];
        for (p = B->p[j]; p < B->p[j + 1]; p++) {
            if (B->i[p] != j) {
                sli_edit_enter(e, j, B->i[p]);
            }
        }
    }
    for (j = 0; j < e->n && e->triangle != SL_TRIANGLE_BOTH; j++) {
        const int is_active = e->is_active[j];
        for (p = B->p[j]; p < B->p[j + 1]; p++) {
            if ((is_active || e->is_active[B->i[p]]) && B->i[p] != j &&
                sli_is_read(e->triangle, B->i[p], j)) {
                sli_edit_enter(e, j, B->i[p]);
                sli_edit_enter(e, B->i[p], j);
            }
        }
    }
}

/* Lists the neighbors of each near row. */
static sl_status sli_edit_neighbors(sli_edit *e, const sl_allocator *a) {
    sli_block b = {NULL, 0};
    sl_off total;
    sl_status status = SL_OK;
    SLI_LAYOUT(&b, a, status) {
        e->begin = SLI_TAKE(&b, sl_off, (uint64_t)e->n_near + 1);
        e->list = SLI_TAKE(&b, uint64_t, e->n_near);
        e->scratch = SLI_TAKE(&b, uint64_t, e->n_near);
    }
    e->blocks[1] = b.base;
    if (status != SL_OK) {
        return status;
    }
    SLI_ZERO(e->begin, e->n_near + 1);
    e->to = NULL;
    sli_edit_scan(e);
    total = sli_starts(e->begin, e->n_near);
    SLI_CLEAR(b);
    SLI_LAYOUT(&b, a, status) {
        e->to = SLI_TAKE(&b, sl_int, total);
    }
    e->blocks[2] = b.base;
    if (status != SL_OK) {
        return status;
    }
    sli_edit_scan(e);
    sli_starts_restore(e->begin, e->n_near);
    return SL_OK;
}

/* Is node a an ancestor of b, or the same? */
SLI_INLINE int sli_edit_is_above(const sli_edit *e, sl_int a, sl_int b) {
    return a == e->S->n_supers || (e->S->first_descendant[a] <= b && b <= a);
}

/* The lowest common ancestor of two nodes. */
static sl_int sli_edit_meet(sli_edit *e, sl_int a, sl_int b) {
    while (!sli_edit_is_above(e, a, b) && e->steps > 0) {
        a = e->S->super_parent[a];
        a = a == -1 ? e->S->n_supers : a;
        e->steps--;
    }
    return a;
}

/* The lowest node that is above or below the nodes of all neighbors of a near row, or -1 if none
 * of them is placed: the lowest of their nodes if these are on one path to a root, else the lowest
 * common ancestor of the ends of the paths. *conflicts := neighbors that are on no path with the
 * row itself. */
static sl_int sli_edit_lowest(sli_edit *e, sl_int row, sl_int *conflicts) {
    const sl_int own = e->node[row], k = e->number[row];
    sl_int lowest = -1;
    sl_off at;
    e->is_join = 0;
    *conflicts = 0;
    for (at = e->begin[k]; at < e->begin[k + 1]; at++) {
        const sl_int node = e->node[e->to[at]];
        if (node == -1) {
            continue;
        }
        *conflicts +=
            own != -1 && !sli_edit_is_above(e, own, node) && !sli_edit_is_above(e, node, own);
        if (lowest == -1) {
            lowest = node;
        } else if (sli_edit_is_above(e, lowest, node)) {
            lowest = e->is_join ? lowest : node;
        } else if (!sli_edit_is_above(e, node, lowest)) {
            lowest = sli_edit_meet(e, lowest, node);
            e->is_join = 1;
        }
    }
    return lowest;
}

/* A subtree gets a new order if at least one in so many of its rows is active, and if it has so
 * many rows: it is ordered without regard to the rows above it, which costs fill at its border. */
#define SLI_EDIT_SHARE 32
#define SLI_EDIT_LEAST 256

/* Counts the active rows in each subtree. */
static void sli_edit_weigh(sli_edit *e) {
    const sl_symbolic *S = e->S;
    sl_int s, k;
    SLI_ZERO(e->weight, S->n_supers + 1);
    for (k = 0; k < e->n_near; k++) {
        if (e->is_active[e->around[k]] == 1 && e->node[e->around[k]] != -1) {
            e->weight[e->node[e->around[k]]]++;
        }
    }
    for (s = 0; s < S->n_supers; s++) {
        if (S->super_parent[s] != -1) {
            e->weight[S->super_parent[s]] += e->weight[s];
        }
    }
}

/* Does the subtree of a node get a new order? */
SLI_INLINE int sli_edit_is_small(const sli_edit *e, sl_int s) {
    const sl_symbolic *S = e->S;
    const sl_off size =
        s == S->n_supers ? 0 : S->super_first[s + 1] - S->super_first[S->first_descendant[s]];
    return s < S->n_supers && size <= (sl_off)SLI_EDIT_SHARE * e->weight[s] &&
           size + e->weight[s] >= SLI_EDIT_LEAST;
}

/* Moves a row to a node, or places it there. */
static void sli_edit_move(sli_edit *e, sl_int row, sl_int node) {
    if (e->node[row] != -1) {
        e->mark[e->node[row]] = SLI_NODE_FRESH;
        e->moved++;
    }
    e->mark[node] = SLI_NODE_FRESH;
    e->node[row] = node;
}

/* Moves one end of each new entry between two subtrees to their separator: first the rows with the
 * most of these entries. */
static void sli_edit_resolve(sli_edit *e) {
    sl_int k, count = 0, conflicts;
    for (k = 0; k < e->n_near && e->steps > 0; k++) {
        const sl_int row = e->around[k];
        if (e->node[row] != -1 && e->is_active[row] == 1) {
            (void)sli_edit_lowest(e, row, &conflicts);
            if (conflicts > 0) {
                e->list[count++] = sli_keyed(INT32_MAX - conflicts, row);
            }
        }
    }
    sli_sort(e->list, count, e->scratch);
    for (k = 0; k < count && e->steps > 0; k++) {
        const sl_int row = sli_value(e->list[k]);
        const sl_int node = sli_edit_lowest(e, row, &conflicts);
        if (conflicts > 0) {
            sli_edit_move(e, row, node);
        }
    }
}

/* Places new rows in breadth-first order from the rows that have places. Those that are not
 * connected with them get none. */
static void sli_edit_place_new(sli_edit *e) {
    sl_int *queue = e->next, head, tail = 0, k, conflicts;
    sl_off at;
    for (k = 0; k < e->n_near; k++) {
        const sl_int row = e->around[k];
        for (at = e->begin[k]; e->node[row] == -1 && at < e->begin[k + 1]; at++) {
            if (e->node[e->to[at]] != -1) {
                e->cursor[row] = 1;
                queue[tail++] = row;
                break;
            }
        }
    }
    for (head = 0; head < tail && e->steps > 0; head++) {
        const sl_int row = queue[head];
        sli_edit_move(e, row, sli_edit_lowest(e, row, &conflicts));
        k = e->number[row];
        for (at = e->begin[k]; at < e->begin[k + 1]; at++) {
            if (e->node[e->to[at]] == -1 && e->cursor[e->to[at]] == 0) {
                e->cursor[e->to[at]] = 1;
                queue[tail++] = e->to[at];
            }
        }
    }
}

/* Moves active rows down, out of separators in which they separate nothing any more. */
static void sli_edit_lower(sli_edit *e) {
    sl_int k, conflicts;
    for (k = 0; k < e->n_near && e->steps > 0; k++) {
        const sl_int row = e->around[k], own = e->node[row];
        const sl_int lowest =
            own == -1 || e->is_active[row] != 1 ? -1 : sli_edit_lowest(e, row, &conflicts);
        if (lowest != -1 && lowest != own && sli_edit_is_above(e, own, lowest)) {
            sli_edit_move(e, row, lowest);
        }
    }
}

/* Places all active rows. Returns whether that took a moderate number of steps. */
static int sli_edit_place_all(sli_edit *e) {
    sl_int k;
    for (k = 0; k < e->n_near; k++) {
        e->cursor[e->around[k]] = 0;
        if (e->node[e->around[k]] != -1 && e->is_active[e->around[k]] == 1) {
            e->mark[e->node[e->around[k]]] = SLI_NODE_FRESH;
        }
    }
    e->steps = 4 * ((sl_off)e->n + e->S->n_supers) + 1000;
    sli_edit_resolve(e);
    sli_edit_place_new(e);
    sli_edit_lower(e);
    return e->steps > 0;
}

#endif

/* edit_graph.h: the graph of the columns that an edit analyzes again, and their supernodes */
#ifndef SLI_EDIT_GRAPH_H
#define SLI_EDIT_GRAPH_H

#include "edit_order.h"
#include "submatrix_symbolic.h"

/* As in a restriction, a kept subtree is a clique of the rows below its root, which are all fresh:
 * here all subtrees without a fresh supernode are kept. Fresh columns are numbered by their
 * positions in the list of fresh rows. */

/* Is supernode s the root of a kept subtree? */
SLI_INLINE int sli_edit_is_root(const sli_edit *e, sl_int s) {
    const sl_int up = e->S->super_parent[s];
    return e->mark[s] == SLI_NODE_KEPT && (up == -1 || e->mark[up] != SLI_NODE_KEPT);
}

/* The position in the list of fresh rows of a column of S. */
SLI_INLINE sl_int sli_edit_number(const sli_edit *e, sl_int column) {
    return e->number[e->new_of[e->S->perm[column]]];
}

/* The first fresh row below the root s of a kept subtree. */
static sl_int sli_edit_first_below(const sli_edit *e, sl_int s) {
    const sl_symbolic *S = e->S;
    sl_int first = INT32_MAX;
    sl_off p;
    for (p = S->rows_begin[s]; p < S->rows_begin[s + 1]; p++) {
        first = sli_min(first, sli_edit_number(e, S->rows[p]));
    }
    return first;
}

/* Room for the graph. */
static sl_status sli_edit_graph_room(const sli_edit *e, sli_restriction *r, const sl_allocator *a) {
    const sl_symbolic *S = e->S;
    uint64_t entries = 0;
    sl_int s, k;
    for (s = 0; s < S->n_supers; s++) {
        entries += sli_edit_is_root(e, s) ? (uint64_t)(S->rows_begin[s + 1] - S->rows_begin[s]) : 0;
    }
    for (k = 0; k < e->n_fresh; k++) {
        entries += (uint64_t)(e->B->p[e->fresh[k] + 1] - e->B->p[e->fresh[k]]);
    }
    return sli_restriction_work(r, entries, a);
}

/* Lists the graph: the cliques, and the entries of B between fresh rows. */
static void sli_edit_list_graph(const sli_edit *e, sli_restriction *r) {
    const sl_symbolic *S = e->S;
    const sl_csc *B = e->B;
    sl_int s, k, p;
    sl_off at;
    for (s = 0; s < S->n_supers; s++) {
        if (sli_edit_is_root(e, s)) {
            const sl_int first = sli_edit_first_below(e, s);
            for (at = S->rows_begin[s]; at < S->rows_begin[s + 1]; at++) {
                const sl_int number = sli_edit_number(e, S->rows[at]);
                if (number != first) {
                    sli_restriction_enter(r, number, first, -1);
                }
            }
        }
    }
    for (k = 0; k < e->n_fresh; k++) {
        for (p = B->p[e->fresh[k]]; p < B->p[e->fresh[k] + 1]; p++) {
            const sl_int other = e->number[B->i[p]];
            if (other != -1 && sli_is_read(e->triangle, B->i[p], e->fresh[k])) {
                sli_restriction_enter(r, other, k, p);
            }
        }
    }
}

/* Finds the supernodes of the fresh columns and their structure. */
static sl_status sli_edit_analyze_fresh(sli_edit *e, sli_restriction *r, sl_relaxation relaxation,
                                        const sl_allocator *a, sl_stats *stats) {
    sl_status status;
    sl_int k;
    SLI_NONE(e->number, e->n);
    for (k = 0; k < e->n_fresh; k++) {
        e->number[e->fresh[k]] = k;
    }
    r->S = e->S;
    r->n_fresh = e->n_fresh;
    r->fresh = e->fresh;
    r->relaxation = relaxation;
    status = sli_edit_graph_room(e, r, a);
    if (status != SL_OK) {
        return status;
    }
    sli_edit_list_graph(e, r);
    return sli_restriction_analyze(r, a, stats);
}

#endif

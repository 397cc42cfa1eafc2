/* etree.h: elimination tree and column counts, and renumbering of the columns */
#ifndef SLI_ANALYSIS_ETREE_H
#define SLI_ANALYSIS_ETREE_H

#include "symbolic_types.h"
#include "../ordering/graph.h"
#include "../base/sort.h"

#define SLI_MERGED UINT32_MAX

/* So many rows of lists are moved for each column and entry of A: meshes in any good order need
 * 1 or 2. */
#if defined(SL_VERIFY)
#define SLI_MERGE_MOST 1
#else
#define SLI_MERGE_MOST 8
#endif

/* The lists of rows below columns whose parents are not the next columns: each row once, in any
 * order. The lists of disjoint subtrees have together no more rows than A has entries. */
typedef struct sli_merge {
    sl_int *list;    /* the lists */
    size_t end;      /* of the last list */
    uint32_t *from;  /* n: where the list of a column begins, or SLI_MERGED */
    sl_int *waiting; /* the columns that have a list, in the order of the lists */
    sl_int count;
    sl_int gaps; /* lists among them that were merged */
} sli_merge;

/* Removes the gaps between the lists. */
static void sli_merge_compact(sli_merge *m, const sl_int *counts) {
    sl_int q, kept = 0;
    m->end = 0;
    for (q = 0; q < m->count; q++) {
        const sl_int c = m->waiting[q];
        if (m->from[c] != SLI_MERGED) {
            const size_t length = (size_t)counts[c] - 1;
            memmove(m->list + m->end, m->list + m->from[c], length * sizeof(sl_int));
            m->from[c] = (uint32_t)m->end;
            m->waiting[kept++] = c;
            m->end += length;
        }
    }
    m->count = kept;
    m->gaps = 0;
}

/* Appends the rows that are not marked with `id`, and marks them. Without a branch, which nothing
 * would predict. Returns the end of the list. */
SLI_ALWAYS_INLINE size_t sli_merge_rows(sl_int *list, size_t end, sl_int id, sl_int *mark,
                                        const sl_int *rows, sl_int count, size_t stride) {
    const sl_int *last = rows + (size_t)count * stride;
    for (; rows < last; rows += stride) {
        const sl_int r = *rows;
        list[end] = r;
        end += (size_t)(mark[r] != id);
        mark[r] = id;
    }
    return end;
}

/* parent[k] := the first row below the diagonal of column k of L, or -1; counts[k] := the entries
 * of column k, diagonal included. Returns whether the columns are numbered in a postorder or, if
 * `keeps_order`, whether each only child with the same rows is numbered before its parent. -1: they
 * are numbered so that this would take too long, and nothing is known.
 *
 * A column has the rows of its column of A and of its children. The list of a column whose parent
 * is the next one becomes that of its parent. So in a postorder only entries of A are read, and the
 * lists of the other children. sequence: another order of the columns, each after its children, or
 * NULL. list: room for three times the entries of A and one; scratch: 5n. [Liu90] */
static int sli_tree_and_counts(sl_int n, const sli_pattern *columns, sl_int *parent, sl_int *counts,
                               sl_int *list, sl_int *scratch, int keeps_order,
                               const sl_int *sequence) {
    /* mark: the last list with the row; child, sibling: lists of the children that have lists */
    sl_int *mark = scratch, *child = scratch + n, *sibling = scratch + 2 * (size_t)n;
    const size_t entries = (size_t)columns->begin[n];
    const uint64_t most =
        sequence == NULL ? SLI_MERGE_MOST * ((uint64_t)entries + (uint64_t)n) : UINT64_MAX;
    uint64_t moved = 0;
    size_t start = 0, end = 0; /* the list of this column; it may hold rows up to the last one */
    sl_int t, id = -1, size = 0;
    int is_in_order = sequence == NULL, continues = 0;
    sli_merge m = {list, 0, NULL, NULL, 0, 0};
    m.from = (uint32_t *)(void *)(scratch + 3 * (size_t)n);
    m.waiting = scratch + 4 * (size_t)n;
    memset(mark, 0xff, 2 * (size_t)n * sizeof(sl_int)); /* -1, also in child */
    for (t = 0; t < n; t++) {
        const sl_int k = sequence == NULL ? t : sequence[t];
        const sl_int next = sequence == NULL || t + 1 == n ? t + 1 : sequence[t + 1];
        sl_int c;
        size_t before = end;
        if (before > 2 * entries) {
            sli_merge_compact(&m, counts);
            memmove(list + m.end, list + start, (before - start) * sizeof(sl_int));
            before += m.end - start;
            start = m.end;
        }
        if (!continues) {
            id = k;
            mark[k] = id; /* the other rows come after it */
        }
        size -= continues;
        end = sli_merge_rows(list, before, id, mark,
                             columns->entry + SLI_ENTRY * (size_t)columns->begin[k],
                             columns->begin[k + 1] - columns->begin[k], SLI_ENTRY);
        for (c = child[k]; c != -1; c = sibling[c]) {
            end = sli_merge_rows(list, end, id, mark, list + m.from[c], counts[c] - 1, 1);
            moved += (uint64_t)counts[c];
            m.from[c] = SLI_MERGED;
            m.gaps++;
        }
        size += (sl_int)(end - before);
        counts[k] = size + 1;
        c = child[k];
        if (c != -1) {
            is_in_order &= !keeps_order || continues || sibling[c] != -1 || counts[c] != size + 2;
            while (m.count > 0 && m.from[m.waiting[m.count - 1]] == SLI_MERGED) {
                m.count--;
                m.gaps--;
            }
            c = m.count == 0 ? -1 : m.waiting[m.count - 1];
            m.end = c == -1 ? 0 : m.from[c] + (size_t)counts[c] - 1;
            is_in_order &= keeps_order || m.gaps == 0;
            if (start - m.end >= end - start) { /* otherwise the gap stays, which is short */
                memmove(list + m.end, list + start, (end - start) * sizeof(sl_int));
                end -= start - m.end;
                start = m.end;
            }
        }
        continues = size > 0 && mark[next] == id;
        parent[k] = next;
        if (!continues) {
            const size_t from = m.end;
            uint32_t least = UINT32_MAX;
            sl_int up;
            moved += end - start;
            for (; start < end; start++) {
                const sl_int r = list[start];
                const uint32_t beyond = (uint32_t)r - (uint32_t)k - 1; /* large for rows up to k */
                list[m.end] = r;
                m.end += r > k;
                least = beyond < least ? beyond : least;
            }
            start = end = m.end;
            up = size > 0 ? k + 1 + (sl_int)least : n;
            parent[k] = up == n ? -1 : up;
            is_in_order &= keeps_order || up < n || m.count == 0;
            if (up < n) {
                m.from[k] = (uint32_t)from;
                m.waiting[m.count++] = k;
                sibling[k] = child[up];
                child[up] = k;
            }
            if (moved > most) {
                return -1;
            }
            size = 0;
        }
    }
    return is_in_order;
}

/* A postorder of the elimination tree, for sli_tree_and_counts: each list that does not become that
 * of the parent comes from a subtree with at most half of the entries of A below the parent. So all
 * lists together take O(nnz log nnz). Finds the tree from the rows, in nearly O(nnz). keys: 2n;
 * rows: nnz; scratch: 2n. [Liu90] */
static void sli_tree_sequence(sl_int n, const sli_pattern *columns, sl_int *parent,
                              sl_int *sequence, uint64_t *keys, sl_int *rows, sl_int *scratch) {
    sl_int *at = scratch, *ancestor = scratch + n, *weight = ancestor, j, k, p = 0;
    memset(at, 0, (size_t)n * sizeof(sl_int));
    for (k = 0; k < columns->begin[n]; k++) {
        at[columns->entry[SLI_ENTRY * (size_t)k]]++;
    }
    for (k = 0; k < n; k++) {
        p += at[k];
        at[k] = p - at[k];
    }
    for (j = 0; j < n; j++) {
        for (p = columns->begin[j]; p < columns->begin[j + 1]; p++) {
            rows[at[columns->entry[SLI_ENTRY * (size_t)p]]++] = j;
        }
    }
    for (k = 0, p = 0; k < n; k++) {
        parent[k] = ancestor[k] = -1;
        for (; p < at[k]; p++) {
            for (j = rows[p]; j != -1 && j < k;) {
                const sl_int up = ancestor[j];
                parent[j] = up == -1 ? k : parent[j];
                ancestor[j] = k;
                j = up;
            }
        }
    }
    memset(weight, 0, (size_t)n * sizeof(sl_int));
    for (k = 0; k < n; k++) {
        weight[k] += columns->begin[k + 1] - columns->begin[k];
        keys[k] = sli_keyed(weight[k], k);
        if (parent[k] != -1) {
            weight[parent[k]] += weight[k];
        }
    }
    sli_sort(keys, n, keys + n);
    for (k = 0; k < n; k++) {
        sequence[k] = sli_value(keys[k]);
    }
    sli_postorder(parent, sequence, n, sequence, scratch, scratch + n);
}

/* Renumbers the columns: order[k] = the old number of the new column k. Updates old_of, its inverse
 * new_of, and the tree. scratch: 2n. */
static void sli_relabel(const sl_int *order, sl_int n, sl_int *old_of, sl_int *new_of,
                        sl_int *parent, sl_int *scratch) {
    sl_int *fresh = scratch, *number = scratch + n, k;
    for (k = 0; k < n; k++) {
        fresh[k] = old_of[order[k]];
        number[order[k]] = k;
    }
    memcpy(old_of, fresh, (size_t)n * sizeof(sl_int));
    for (k = 0; k < n; k++) {
        const sl_int old = parent[order[k]];
        new_of[old_of[k]] = k;
        fresh[k] = old == -1 ? -1 : number[old];
    }
    memcpy(parent, fresh, (size_t)n * sizeof(sl_int));
}

#endif

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

/* What the tree and the counts are found from, and where they go. */
typedef struct sli_tree_job {
    sl_int n;
    const sli_pattern *columns;
    sl_int *parent;         /* n: the first row below the diagonal of each column of L, or -1 */
    sl_int *counts;         /* n: entries of each column of L, diagonal included */
    sl_int *list;           /* room for three times the entries of A and one */
    sl_int *scratch;        /* 5 n */
    const sl_int *sequence; /* another order of the columns, each after its children, or NULL */
    int keeps_order;        /* see SLI_TREE_IN_ORDER */
} sli_tree_job;

typedef enum sli_tree_result {
    SLI_TREE_OUT_OF_ORDER,
    /* the columns are numbered in a postorder or, if the job keeps the order, each only child with
     * the same rows is numbered before its parent */
    SLI_TREE_IN_ORDER,
    SLI_TREE_TOO_LONG /* the numbers of the columns make it too long, and nothing is known */
} sli_tree_result;

/* The lists of rows below columns whose parents are not the next columns: each row once, in any
 * order. The lists of disjoint subtrees have together no more rows than A has entries. They are at
 * the front of `list`; that of the column under way is behind them, at start..end-1. It may hold
 * rows up to this column. */
typedef struct sli_merge {
    /* copied from the job, and from its columns */
    sl_int n;
    int keeps_order;
    sl_int *parent, *counts;
    const sl_int *begin, *entry;
    sl_int *list;
    size_t kept_end;         /* of the last list of another column */
    size_t start, end;       /* of the list of this column */
    uint32_t *from;          /* n: where the list of a column begins, or SLI_MERGED */
    sl_int *waiting;         /* the columns that have a list, in the order of the lists */
    sl_int count;            /* of them */
    sl_int gaps;             /* lists among them that were merged */
    sl_int *mark;            /* n: the last list with the row */
    sl_int *child, *sibling; /* n: lists of the children that have lists */
    sl_int id, size; /* of the list of this column: its mark, and its rows below the column */
    int is_in_order;
    uint64_t moved; /* rows of lists */
} sli_merge;

static sli_merge sli_merge_start(const sli_tree_job *job) {
    sli_merge m;
    SLI_CLEAR(m);
    m.n = job->n;
    m.parent = job->parent;
    m.counts = job->counts;
    m.keeps_order = job->keeps_order;
    m.begin = job->columns->begin;
    m.entry = job->columns->entry;
    m.list = job->list;
    m.mark = job->scratch;
    m.child = job->scratch + job->n;
    m.sibling = job->scratch + 2 * (size_t)job->n;
    m.from = (uint32_t *)(void *)(job->scratch + 3 * (size_t)job->n);
    m.waiting = job->scratch + 4 * (size_t)job->n;
    m.is_in_order = job->sequence == NULL;
    SLI_NONE(m.mark, 2 * (size_t)job->n); /* also in child */
    return m;
}

/* Removes the gaps between the lists. By value: the state otherwise stays in registers. */
static sli_merge sli_merge_compact(sli_merge m) {
    const sl_int *counts = m.counts;
    const size_t rows = m.end - m.start;
    sl_int q, kept = 0;
    m.kept_end = 0;
    for (q = 0; q < m.count; q++) {
        const sl_int c = m.waiting[q];
        if (m.from[c] != SLI_MERGED) {
            const size_t length = (size_t)counts[c] - 1;
            memmove(m.list + m.kept_end, m.list + m.from[c], length * sizeof(sl_int));
            m.from[c] = (uint32_t)m.kept_end;
            m.waiting[kept++] = c;
            m.kept_end += length;
        }
    }
    m.count = kept;
    m.gaps = 0;
    memmove(m.list + m.kept_end, m.list + m.start, rows * sizeof(sl_int));
    m.start = m.kept_end;
    m.end = m.start + rows;
    return m;
}

/* Appends `count` rows, `stride` apart, to the list of this column, unless they are marked as rows
 * of it, and marks them. Without a branch, which nothing would predict. */
SLI_ALWAYS_INLINE void sli_merge_rows(sli_merge *m, const sl_int *rows, sl_int count,
                                      size_t stride) {
    const sl_int *last = rows + (size_t)count * stride;
    sl_int *list = m->list, *mark = m->mark;
    const sl_int id = m->id;
    size_t end = m->end;
    for (; rows < last; rows += stride) {
        const sl_int r = *rows;
        list[end] = r;
        end += (size_t)(mark[r] != id);
        mark[r] = id;
    }
    m->end = end;
}

/* Completes the list of column k by the rows of A and of the children that have lists. */
SLI_ALWAYS_INLINE void sli_merge_column(sli_merge *m, sl_int k) {
    sl_int *counts = m->counts, c;
    const size_t before = m->end;
    sli_merge_rows(m, m->entry + SLI_ENTRY * (size_t)m->begin[k], m->begin[k + 1] - m->begin[k],
                   SLI_ENTRY);
    for (c = m->child[k]; c != -1; c = m->sibling[c]) {
        sli_merge_rows(m, m->list + m->from[c], counts[c] - 1, 1);
        m->moved += (uint64_t)counts[c];
        m->from[c] = SLI_MERGED;
        m->gaps++;
    }
    m->size += (sl_int)(m->end - before);
    counts[k] = m->size + 1;
}

/* Forgets the lists of the children of column k, and moves its own to the place of the last ones.
 * continues: its list was that of the column before it. */
SLI_ALWAYS_INLINE void sli_merge_close_gap(sli_merge *m, sl_int k, int continues) {
    const sl_int *counts = m->counts;
    const int keeps_order = m->keeps_order;
    sl_int c = m->child[k];
    m->is_in_order &= !keeps_order || continues || m->sibling[c] != -1 || counts[c] != m->size + 2;
    while (m->count > 0 && m->from[m->waiting[m->count - 1]] == SLI_MERGED) {
        m->count--;
        m->gaps--;
    }
    c = m->count == 0 ? -1 : m->waiting[m->count - 1];
    m->kept_end = c == -1 ? 0 : m->from[c] + (size_t)counts[c] - 1;
    m->is_in_order &= keeps_order || m->gaps == 0;
    if (m->start - m->kept_end >= m->end - m->start) { /* otherwise the gap stays, which is short */
        memmove(m->list + m->kept_end, m->list + m->start, (m->end - m->start) * sizeof(sl_int));
        m->end -= m->start - m->kept_end;
        m->start = m->kept_end;
    }
}

/* Keeps the list of column k, without the rows up to k, for its parent, which is not the next
 * column: the least of these rows. */
SLI_ALWAYS_INLINE void sli_merge_keep(sli_merge *m, sl_int k) {
    const sl_int n = m->n;
    const size_t from = m->kept_end;
    size_t at = m->start, to = from;
    uint32_t least = UINT32_MAX;
    sl_int up;
    m->moved += m->end - m->start;
    for (; at < m->end; at++) {
        const sl_int r = m->list[at];
        const uint32_t beyond = (uint32_t)r - (uint32_t)k - 1; /* large for rows up to k */
        m->list[to] = r;
        to += r > k;
        least = beyond < least ? beyond : least;
    }
    m->start = m->end = m->kept_end = to;
    up = m->size > 0 ? k + 1 + (sl_int)least : n;
    m->parent[k] = up == n ? -1 : up;
    m->is_in_order &= m->keeps_order || up < n || m->count == 0;
    if (up < n) {
        m->from[k] = (uint32_t)from;
        m->waiting[m->count++] = k;
        m->sibling[k] = m->child[up];
        m->child[up] = k;
    }
}

/* Finds the tree and the counts of a job. A column has the rows of its column of A and of its
 * children. The list of a column whose parent is the next one becomes that of its parent. So in a
 * postorder only entries of A are read, and the lists of the other children. [Liu90] */
static sli_tree_result sli_tree_and_counts(const sli_tree_job *job) {
    const sl_int n = job->n, *sequence = job->sequence;
    const size_t entries = (size_t)job->columns->begin[n];
    const uint64_t most =
        sequence == NULL ? SLI_MERGE_MOST * ((uint64_t)entries + (uint64_t)n) : UINT64_MAX;
    sl_int t;
    int continues = 0;
    sli_merge m = sli_merge_start(job);
    for (t = 0; t < n; t++) {
        const sl_int k = sequence == NULL ? t : sequence[t];
        const sl_int next = sequence == NULL || t + 1 == n ? t + 1 : sequence[t + 1];
        if (m.end > 2 * entries) {
            m = sli_merge_compact(m);
        }
        if (!continues) {
            m.id = k;
            m.mark[k] = k; /* the other rows come after it */
        }
        m.size -= continues;
        sli_merge_column(&m, k);
        if (m.child[k] != -1) {
            sli_merge_close_gap(&m, k, continues);
        }
        continues = m.size > 0 && m.mark[next] == m.id;
        m.parent[k] = next;
        if (!continues) {
            sli_merge_keep(&m, k);
            m.size = 0;
            if (m.moved > most) {
                return SLI_TREE_TOO_LONG;
            }
        }
    }
    return m.is_in_order ? SLI_TREE_IN_ORDER : SLI_TREE_OUT_OF_ORDER;
}

/* The elimination tree from the rows, in nearly O(nnz). at: where the row k of `rows`, the
 * columns of its entries, ends; ancestor: n of scratch. [Liu90] */
static void sli_tree_of_rows(sl_int n, const sl_int *at, const sl_int *rows, sl_int *parent,
                             sl_int *ancestor) {
    sl_int j, k, p = 0;
    for (k = 0; k < n; k++) {
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
}

/* sequence := a postorder of the elimination tree, for sli_tree_and_counts: each list that does not
 * become that of the parent comes from a subtree with at most half of the entries of A below the
 * parent. So all lists together take O(nnz log nnz). keys: 2 n of scratch. */
static void sli_tree_sequence(const sli_tree_job *job, sl_int *sequence, uint64_t *keys) {
    const sli_pattern *columns = job->columns;
    const sl_int n = job->n;
    sl_int *rows = job->list, *parent = job->parent;
    sl_int *at = job->scratch, *ancestor = job->scratch + n, *weight = ancestor, j, k, p = 0;
    SLI_ZERO(at, n);
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
    sli_tree_of_rows(n, at, rows, parent, ancestor);
    SLI_ZERO(weight, n);
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
    sli_postorder(parent, sequence, n, sequence, job->scratch, job->scratch + n);
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
    SLI_COPY(old_of, fresh, n);
    for (k = 0; k < n; k++) {
        const sl_int old = parent[order[k]];
        new_of[old_of[k]] = k;
        fresh[k] = old == -1 ? -1 : number[old];
    }
    SLI_COPY(parent, fresh, n);
}

#endif

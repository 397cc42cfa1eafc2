/* edit_separate.h: smallest separators near an edit, where rows have come and gone */
#ifndef SLI_EDIT_SEPARATE_H
#define SLI_EDIT_SEPARATE_H

#include "edit_place.h"

/* The rows near an edit that are below a node, or that separate two subtrees of it and may move: a
 * band around its separator. The rows of the outermost layer stay where they are. A minimum vertex
 * cut between those of one subtree and those of the other becomes the separator, if it has fewer
 * rows. Each vertex of the band is on one augmenting path at most: `from` and `to` are its
 * neighbors on it. [FF56] */
typedef struct sli_band {
    sli_edit *e;
    sl_int node;
    sl_int n, n_movable;        /* rows; the first n_movable ones are in the separator */
    sl_int branch[2];           /* the two subtrees */
    sl_int *row;                /* n */
    sl_int *from, *to;          /* n: SLI_BAND_NONE, SLI_BAND_END or a vertex */
    sl_int *queue, *parent;     /* 2 n each: states, 2 v before v and 2 v + 1 behind it */
    unsigned char *kind, *seen; /* n: SLI_BAND_*; 2 n */
} sli_band;

enum { SLI_BAND_NONE = -2, SLI_BAND_END = -1 };

/* kinds: an outer row of a side, a row that may be in the separator, with its outer neighbors */
enum {
    SLI_BAND_OUT = 0,
    SLI_BAND_LEFT,
    SLI_BAND_RIGHT,
    SLI_BAND_INNER,
    SLI_BAND_FIRST = 4,
    SLI_BAND_LAST = 8
};

static void sli_band_layout(sli_band *w, sli_block *b, sl_int rows) {
    const uint64_t n = (uint64_t)rows;
    w->row = SLI_TAKE(b, sl_int, n);
    w->from = SLI_TAKE(b, sl_int, n);
    w->to = SLI_TAKE(b, sl_int, n);
    w->queue = SLI_TAKE(b, sl_int, 2 * n);
    w->parent = SLI_TAKE(b, sl_int, 2 * n);
    w->kind = SLI_TAKE(b, unsigned char, n);
    w->seen = SLI_TAKE(b, unsigned char, 2 * n);
}

/* The child of w->node above a node below it. */
static sl_int sli_band_branch(const sli_band *w, sl_int node) {
    const sl_symbolic *S = w->e->S;
    sl_int c = w->node == S->n_supers ? node : w->node - 1;
    if (w->node == S->n_supers) {
        while (S->super_parent[c] != -1 && w->e->steps > 0) {
            c = S->super_parent[c];
            w->e->steps--;
        }
        return c;
    }
    while (S->first_descendant[c] > node && w->e->steps > 0) {
        c = S->first_descendant[c] - 1;
        w->e->steps--;
    }
    return c;
}

SLI_INLINE int sli_band_is_below(const sli_band *w, sl_int node) {
    return node != -1 && node != w->node && sli_edit_is_above(w->e, w->node, node);
}

/* Adds the rows below the node that are connected with the movable ones through rows near the edit.
 * cursor: positions in the band + 1. */
static void sli_band_grow(sli_band *w) {
    const sli_edit *e = w->e;
    sl_int head;
    sl_off at;
    for (head = 0; head < w->n; head++) {
        const sl_int k = e->number[w->row[head]];
        if (e->is_active[w->row[head]] == SLI_EDIT_LAYERS) {
            continue;
        }
        for (at = e->begin[k]; at < e->begin[k + 1]; at++) {
            const sl_int row = e->to[at];
            if (e->cursor[row] == 0 && sli_band_is_below(w, e->node[row])) {
                e->cursor[row] = w->n + 1;
                w->row[w->n++] = row;
            }
        }
    }
}

/* Finds the two subtrees of the node with the most rows of the band. scratch: w->queue. */
static int sli_band_branches(sli_band *w) {
    sl_int k, m, count = 0, *name = w->queue, *size = w->parent;
    for (k = w->n_movable; k < w->n; k++) {
        const sl_int branch = sli_band_branch(w, w->e->node[w->row[k]]);
        w->from[k] = branch;
        for (m = 0; m < count && name[m] != branch; m++) {
        }
        if (m == 16) {
            return 0;
        }
        if (m == count) {
            name[count] = branch;
            size[count++] = 0;
        }
        size[m]++;
    }
    if (count < 2) {
        return 0;
    }
    for (k = 0; k < 2; k++) {
        for (m = k + 1; m < count; m++) {
            if (size[m] > size[k]) {
                const sl_int n = name[m], s = size[m];
                name[m] = name[k];
                size[m] = size[k];
                name[k] = n;
                size[k] = s;
            }
        }
        w->branch[k] = name[k];
    }
    return 1;
}

/* Finds the kind of each row. Returns how many rows of the separator may move. */
static sl_int sli_band_kinds(sli_band *w) {
    const sli_edit *e = w->e;
    sl_int k, count = 0, has[2] = {0, 0};
    sl_off at;
    for (k = 0; k < w->n; k++) {
        const int is_outer = e->is_active[w->row[k]] == SLI_EDIT_LAYERS;
        const int side = k < w->n_movable             ? -1
                         : w->from[k] == w->branch[0] ? 0
                         : w->from[k] == w->branch[1] ? 1
                                                      : 2;
        w->kind[k] = side == 2 || (side == -1 && is_outer) ? SLI_BAND_OUT
                     : !is_outer                           ? SLI_BAND_INNER
                     : side == 0                           ? SLI_BAND_LEFT
                                                           : SLI_BAND_RIGHT;
    }
    for (k = 0; k < w->n; k++) {
        const sl_int own = e->number[w->row[k]];
        int kind = w->kind[k], is_fixed = 0;
        for (at = e->begin[own]; kind == SLI_BAND_INNER && at < e->begin[own + 1]; at++) {
            const sl_int v = e->cursor[e->to[at]] - 1;
            const int other = v == -1 ? -1 : w->kind[v] & 3;
            w->kind[k] |= other == SLI_BAND_LEFT    ? SLI_BAND_FIRST
                          : other == SLI_BAND_RIGHT ? SLI_BAND_LAST
                                                    : 0;
            is_fixed |= k < w->n_movable && v >= w->n_movable && other == SLI_BAND_OUT;
        }
        if (is_fixed) {
            w->kind[k] = SLI_BAND_OUT;
        }
        has[0] |= w->kind[k] == SLI_BAND_LEFT;
        has[1] |= w->kind[k] == SLI_BAND_RIGHT;
        count += k < w->n_movable && w->kind[k] != SLI_BAND_OUT;
    }
    return has[0] && has[1] ? count : 0;
}

SLI_INLINE sl_int sli_band_push(sli_band *w, sl_int state, sl_int parent, sl_int tail) {
    if (!w->seen[state]) {
        w->seen[state] = 1;
        w->parent[state] = parent;
        w->queue[tail++] = state;
    }
    return tail;
}

/* Searches an augmenting path in breadth-first order. Returns its last vertex, or -1; then `seen`
 * has the states that can be reached from the left side. */
static sl_int sli_band_search(sli_band *w) {
    const sli_edit *e = w->e;
    sl_int v, head, tail = 0;
    sl_off at;
    memset(w->seen, 0, 2 * (size_t)w->n);
    for (v = 0; v < w->n; v++) {
        if ((w->kind[v] & 3) == SLI_BAND_INNER && (w->kind[v] & SLI_BAND_FIRST) != 0) {
            tail = sli_band_push(w, 2 * v, -1, tail);
        }
    }
    for (head = 0; head < tail && w->e->steps > 0; head++) {
        const sl_int state = w->queue[head], k = e->number[w->row[state / 2]];
        v = state / 2;
        if (state % 2 == 0) { /* before v: through it, or back along the path that it is on */
            if (w->from[v] == SLI_BAND_NONE) {
                tail = sli_band_push(w, state + 1, state, tail);
            } else if (w->from[v] != SLI_BAND_END) {
                tail = sli_band_push(w, 2 * w->from[v] + 1, state, tail);
            }
            continue;
        }
        if ((w->kind[v] & SLI_BAND_LAST) != 0) { /* nothing leads behind the end of a path */
            return v;
        }
        w->e->steps -= 1 + e->begin[k + 1] - e->begin[k];
        if (w->from[v] != SLI_BAND_NONE) {
            tail = sli_band_push(w, state - 1, state, tail);
        }
        for (at = e->begin[k]; at < e->begin[k + 1]; at++) {
            const sl_int u = e->cursor[e->to[at]] - 1;
            if (u != -1 && u != w->to[v] && (w->kind[u] & 3) == SLI_BAND_INNER) {
                tail = sli_band_push(w, 2 * u, state, tail);
            }
        }
    }
    return -1;
}

/* Adds the path that ends behind vertex `last`. */
static void sli_band_augment(sli_band *w, sl_int last) {
    sl_int count = 0, k, state;
    for (state = 2 * last + 1; state != -1; state = w->parent[state]) {
        w->queue[count++] = state; /* the search is over */
    }
    w->from[w->queue[count - 1] / 2] = SLI_BAND_END;
    for (k = count - 2; k >= 0; k--) {
        const sl_int a = w->queue[k + 1], b = w->queue[k];
        if (a % 2 == 1 && a / 2 == b / 2) { /* the vertex leaves its path */
            w->from[a / 2] = w->to[a / 2] = SLI_BAND_NONE;
        } else if (a % 2 == 1) {
            w->to[a / 2] = b / 2;
            w->from[b / 2] = a / 2;
        }
    }
    w->to[last] = SLI_BAND_END;
}

/* Moves the rows of the band to the sides of the cut. */
static void sli_band_apply(sli_band *w) {
    sli_edit *e = w->e;
    sl_int k, count = 0, conflicts, progress = 1;
    for (k = 0; k < w->n; k++) {
        const sl_int row = w->row[k];
        const int is_cut = w->seen[2 * k] && !w->seen[2 * k + 1];
        const sl_int side = w->seen[2 * k] ? w->branch[0] : w->branch[1];
        if ((w->kind[k] & 3) != SLI_BAND_INNER || (is_cut && k < w->n_movable)) {
            continue;
        }
        if (is_cut) {
            sli_edit_move(e, row, w->node);
        } else if (k < w->n_movable || !sli_edit_is_above(e, side, e->node[row])) {
            e->mark[e->node[row]] = SLI_NODE_FRESH;
            e->node[row] = -1;
            e->moved++;
            w->queue[count++] = row;
        }
    }
    while (count > 0) { /* a row follows those of its side; what no side has stays at the node */
        sl_int left = 0;
        for (k = 0; k < count; k++) {
            const sl_int row = w->queue[k], lowest = sli_edit_lowest(e, row, &conflicts);
            if (sli_band_is_below(w, lowest) || !progress) { /* then some neighbor has a place */
                const int is_lost = lowest == -1; /* untested: rows follow those they came from */
                sli_edit_move(e, row, is_lost ? w->node : lowest); /* untested: the same */
            } else {
                w->queue[left++] = row;
            }
        }
        progress = left < count;
        count = left;
    }
}

/* Finds a smaller separator in the band. */
static void sli_band_cut(sli_band *w) {
    sl_int k, movable, paths = 0, last = 0;
    sli_band_grow(w);
    movable = sli_band_branches(w) ? sli_band_kinds(w) : 0;
    for (k = 0; k < w->n; k++) {
        w->from[k] = w->to[k] = SLI_BAND_NONE;
    }
    while (paths < movable && (last = sli_band_search(w)) != -1) {
        sli_band_augment(w, last);
        paths++;
    }
    if (paths < movable && w->e->steps > 0) { /* the last search was complete */
        sli_band_apply(w);
    }
    for (k = 0; k < w->n; k++) {
        w->e->cursor[w->row[k]] = 0;
    }
}

/* The node whose subtrees a row near the edit separates, or -1. The row's own node, which is on one
 * path with that of each neighbor, is the same or above. */
static sl_int sli_edit_separates(sli_edit *e, sl_int row) {
    sl_int conflicts;
    const sl_int node = e->node[row] == -1 ? -1 : sli_edit_lowest(e, row, &conflicts);
    return node != -1 && e->is_join ? node : -1;
}

/* Finds smaller separators for all nodes above the subtrees that get a new order. */
static sl_status sli_edit_separate(sli_edit *e, const sl_allocator *a) {
    const sl_symbolic *S = e->S;
    sli_band w;
    sli_block b = {NULL, 0};
    sl_status status = SL_OK;
    sl_int k, m, count = 0;
    SLI_CLEAR(w);
    w.e = e;
    SLI_LAYOUT(&b, a, status) {
        sli_band_layout(&w, &b, e->n_near);
    }
    if (status != SL_OK) {
        return status;
    }
    for (k = 0; k < e->n_near; k++) {
        const sl_int row = e->around[k];
        const sl_int node = sli_edit_separates(e, row);
        e->cursor[row] = 0;
        if (node != -1 && !sli_edit_is_small(e, node)) {
            e->list[count++] = sli_keyed(S->n_supers - node, row); /* from the roots down */
        }
    }
    sli_sort(e->list, count, e->scratch);
    for (k = 0; k < count && e->steps > 0; k = m) {
        w.node = S->n_supers - sli_key(e->list[k]);
        w.n = 0;
        for (m = k; m < count && sli_key(e->list[m]) == sli_key(e->list[k]); m++) {
            const sl_int row = sli_value(e->list[m]);
            if (sli_edit_separates(e, row) == w.node) {
                e->cursor[row] = w.n + 1;
                w.row[w.n++] = row;
            }
        }
        w.n_movable = w.n;
        if (w.n > 0) {
            sli_band_cut(&w);
        }
    }
    sli_free(a, b.base);
    return SL_OK;
}

#endif

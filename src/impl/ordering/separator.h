/* separator.h: a minimum vertex separator in a band, by maximum flow */
#ifndef SLI_ORDERING_SEPARATOR_H
#define SLI_ORDERING_SEPARATOR_H

#include "bisect.h"

/* A flow of vertex-disjoint paths from the left side to the right. Each vertex is split into two
 * states, 2 v its entrance and 2 v + 1 its exit, and at most one path passes between them. By
 * Menger's theorem the largest number of such paths is the size of the smallest vertex separator.
 * [FF56]
 *
 * A search for an augmenting path starts at each source once. If it finds one, what it has seen is
 * forgotten. Otherwise that never leads to a sink: no later path enters these states, so that what
 * can be reached from them stays the same. */
typedef struct sli_flow {
    sli_subgraph *sub;
    sl_int *before, *after;  /* n: neighbors of v on its path; SLI_FLOW_NONE if v is on no path */
    sl_int *path, *via;      /* n: vertices whose exits an augmenting path visits, source first; the
                                entrance that led to each */
    sl_int *list;            /* 2 n: states that the search has seen */
    unsigned char *state;    /* 2 n: SLI_FLOW_SEEN etc. */
    sl_off *next;            /* n: the edge to try next */
    unsigned char *terminal; /* n: 1 source, 2 sink, 0 neither */
    int64_t left;            /* states that may still be seen before the flow is given up */
} sli_flow;

enum {
    SLI_FLOW_SEEN = 1, /* the left side reaches the state */
    SLI_FLOW_USED = 2, /* an entrance of a vertex that is on a path */
    SLI_FLOW_ENDS = 4  /* the state reaches the right side */
};
enum { SLI_FLOW_NONE = -1, SLI_FLOW_END = -2 /* the path begins or ends here */ };

/* A search may see each state so many times, in the mean. Bands of volumes of 2.6e5 vertices see
 * them up to 52 times. A test defines it as 0. */
#if !defined(SLI_FLOW_VISITS)
#define SLI_FLOW_VISITS 500
#endif

/* Chooses the terminals: vertices with neighbors outside the band. If the whole of
 * a side lies in the band, its layer farthest from the border replaces them. */
static void sli_flow_terminals(sli_flow *f) {
    const sli_subgraph *sub = f->sub;
    int last[2] = {-1, -1}, touches_outside[2] = {0, 0};
    sl_int v;
    for (v = 0; v < sub->n; v++) {
        const int s = sub->side[v];
        touches_outside[s] |= sub->external[v] > 0;
        last[s] = sub->layer[v] > last[s] ? sub->layer[v] : last[s];
    }
    for (v = 0; v < sub->n; v++) {
        const int s = sub->side[v];
        const int is_end = touches_outside[s] ? sub->external[v] > 0 : sub->layer[v] == last[s];
        f->terminal[v] = (unsigned char)(is_end ? 1 + s : 0);
    }
}

/* The entrance to try next from the exit of v, or -1: first those of vertices on no path, which
 * lead on, then those of others, which lead back along their paths, and last its own, where a path
 * that leaves v may turn back. */
SLI_INLINE sl_int sli_flow_step(const sli_flow *f, sl_int v) {
    const sl_int *to = f->sub->to;
    const unsigned char *state = f->state;
    const sl_off begin = f->sub->begin[v], end = f->sub->begin[v + 1], degree = end - begin;
    sl_off e = f->next[v];
    sl_int u = -1;
    while (e < end && state[2 * to[e]] != 0) {
        e++;
    }
    if (e < end) {
        u = to[e];
    } else {
        while (e < end + degree && state[2 * to[e - degree]] != SLI_FLOW_USED) {
            e++;
        }
        u = e < end + degree ? to[e - degree] : state[2 * v] == SLI_FLOW_USED ? v : -1;
    }
    f->next[v] = e + 1;
    return u;
}

/* Searches for an augmenting path from the entrance of u to a sink. Returns the number of exits
 * that it visits, 0 if there is none. */
static sl_int sli_flow_find_path(sli_flow *f, sl_int u) {
    unsigned char *state = f->state;
    sl_int *list = f->list, length = 0, count = 0, v, k;
    do {
        state[2 * u] |= SLI_FLOW_SEEN;
        list[count++] = 2 * u;
        v = f->before[u] == SLI_FLOW_NONE ? u : f->before[u];
        if (v >= 0 && /* branches untested: its successor alone leads here, or it itself */
            state[2 * v + 1] == 0) { /* branches untested: the same */
            state[2 * v + 1] = SLI_FLOW_SEEN;
            list[count++] = 2 * v + 1;
            f->path[length] = v;
            f->via[length++] = u;
            f->next[v] = f->sub->begin[v];
            if (f->terminal[v] == 2) { /* no path ends here yet: its entrance would lead back */
                break;
            }
        }
        u = -1;
        while (length > 0 && (u = sli_flow_step(f, f->path[length - 1])) == -1) {
            length--;
        }
    } while (u != -1);
    f->left -= count;
    for (k = 0; k < count && length > 0; k++) {
        state[list[k]] &= SLI_FLOW_USED;
    }
    return length;
}

/* Augments the flow along the path. */
static void sli_flow_augment(sli_flow *f, sl_int length) {
    sl_int k, last = SLI_FLOW_END;
    for (k = 0; k < length; k++) {
        const sl_int u = f->via[k];
        if (u == last) { /* the path that passed through it turns back */
            f->before[u] = f->after[u] = SLI_FLOW_NONE;
            f->state[2 * u] = 0;
        } else {
            f->before[u] = last;
            f->state[2 * u] = SLI_FLOW_USED;
            if (last >= 0) {
                f->after[last] = u;
            }
        }
        last = f->path[k];
    }
    f->after[last] = SLI_FLOW_END;
}

/* Finds paths through vertices that are on no path, and sees none of these twice: as arcs towards
 * the right come first, most paths are nearly straight. */
static void sli_flow_start(sli_flow *f) {
    const sli_subgraph *sub = f->sub;
    sl_int s, k;
    for (s = 0; s < sub->n; s++) {
        sl_int length = 0, u = f->terminal[s] == 1 && f->state[2 * s] == 0 ? s : -1;
        for (;;) {
            sl_int v;
            sl_off e;
            if (u != -1) {
                f->state[2 * u] = SLI_FLOW_SEEN;
                f->next[u] = sub->begin[u];
                f->path[length++] = u;
                if (f->terminal[u] == 2) {
                    break;
                }
            } else if (length == 0 || --length == 0) {
                break;
            }
            v = f->path[length - 1];
            e = f->next[v];
            while (e < sub->begin[v + 1] && f->state[2 * sub->to[e]] != 0) {
                e++;
            }
            u = e < sub->begin[v + 1] ? sub->to[e] : -1;
            f->next[v] = e + 1;
        }
        for (k = 0; k < length; k++) {
            f->before[f->path[k]] = k == 0 ? SLI_FLOW_END : f->path[k - 1];
            f->after[f->path[k]] = k == length - 1 ? SLI_FLOW_END : f->path[k + 1];
        }
    }
    for (s = 0; s < sub->n; s++) {
        f->state[2 * s] = f->before[s] == SLI_FLOW_NONE ? 0 : SLI_FLOW_USED;
    }
}

/* Finds a maximum flow, and then sees the states that the left side reaches. Returns whether the
 * searches ended in time. */
static int sli_flow_maximize(sli_flow *f) {
    const sl_int n = f->sub->n;
    sl_int v, found = 1;
    memset(f->state, 0, 2 * (size_t)n);
    f->left = SLI_FLOW_VISITS * 2 * (int64_t)n;
    for (v = 0; v < n; v++) {
        f->before[v] = f->after[v] = SLI_FLOW_NONE;
    }
    sli_flow_start(f);
    while (found && f->left > 0) { /* in the second round there is no path any more */
        found = 0;
        for (v = 0; v < n && f->left > 0; v++) {
            if (f->terminal[v] == 1 && (f->state[2 * v] & SLI_FLOW_SEEN) == 0) {
                const sl_int length = sli_flow_find_path(f, v);
                if (length > 0) {
                    sli_flow_augment(f, length);
                    found = 1;
                }
            }
        }
    }
    return f->left > 0;
}

SLI_INLINE sl_int sli_flow_mark(sli_flow *f, sl_int state, sl_int tail) {
    if ((f->state[state] & SLI_FLOW_ENDS) == 0) {
        f->state[state] |= SLI_FLOW_ENDS;
        f->list[tail++] = state;
    }
    return tail;
}

/* Marks the states from which a sink can be reached. */
static void sli_flow_mark_sink_side(sli_flow *f) {
    const sli_subgraph *sub = f->sub;
    sl_int v, head, tail = 0;
    sl_off e;
    for (v = 0; v < sub->n; v++) {
        if (f->terminal[v] == 2) {
            tail = sli_flow_mark(f, 2 * v + 1, tail);
        }
    }
    for (head = 0; head < tail; head++) {
        v = f->list[head] / 2;
        if (f->list[head] % 2 == 1) {
            if (f->before[v] == SLI_FLOW_NONE) {
                tail = sli_flow_mark(f, 2 * v, tail);
            } else if (f->after[v] >= 0) {
                tail = sli_flow_mark(f, 2 * f->after[v], tail);
            }
        } else {
            if (f->before[v] != SLI_FLOW_NONE) {
                tail = sli_flow_mark(f, 2 * v + 1, tail);
            }
            for (e = sub->begin[v]; e < sub->begin[v + 1]; e++) {
                tail = sli_flow_mark(f, 2 * sub->to[e] + 1, tail);
            }
        }
    }
}

/* Adds the exit of v, and all that can be reached from it, to the states marked as reached. None of
 * them reaches a sink. Returns the weight of the vertices that the left side gains. */
static int64_t sli_flow_extend_source_side(sli_flow *f, sl_int v) {
    const sli_subgraph *sub = f->sub;
    sl_int head, tail = 0, next_state;
    int64_t gained = 0;
    sl_off e;
    f->state[2 * v + 1] |= SLI_FLOW_SEEN;
    f->list[tail++] = 2 * v + 1;
    for (head = 0; head < tail; head++) {
        v = f->list[head] / 2;
        if (f->list[head] % 2 == 0) {
            /* not an entrance where a path begins: all of those are marked */
            next_state = f->before[v] == SLI_FLOW_NONE ? 2 * v + 1 : 2 * f->before[v] + 1;
            if ((f->state[next_state] & SLI_FLOW_SEEN) == 0) {
                f->state[next_state] |= SLI_FLOW_SEEN;
                f->list[tail++] = next_state;
            }
            continue;
        }
        gained += sub->weight[v];
        if (f->before[v] != SLI_FLOW_NONE && (f->state[2 * v] & SLI_FLOW_SEEN) == 0) {
            f->state[2 * v] |= SLI_FLOW_SEEN;
            f->list[tail++] = 2 * v;
        }
        for (e = sub->begin[v]; e < sub->begin[v + 1]; e++) {
            next_state = 2 * sub->to[e];
            if ((f->state[next_state] & SLI_FLOW_SEEN) == 0) {
                f->state[next_state] |= SLI_FLOW_SEEN;
                f->list[tail++] = next_state;
            }
        }
    }
    return gained;
}

/* Chooses a balanced one among the smallest separators: starts with the one nearest to the left,
 * then moves vertices that do not reach a sink to the left side until it has half of the weight. */
static void sli_flow_balance(sli_flow *f) {
    const sli_subgraph *sub = f->sub;
    int64_t left = sub->total[0], half = sub->total[0] + sub->total[1];
    sl_int v, k;
    for (v = 0; v < sub->n; v++) {
        const int in = f->state[2 * v] & SLI_FLOW_SEEN, out = f->state[2 * v + 1] & SLI_FLOW_SEEN;
        left += (int64_t)sub->weight[v] * (out + sub->side[v] - 1);
        half -= (int64_t)sub->weight[v] * (in & ~out);
    }
    half /= 2;
    if (left < half) {
        sli_flow_mark_sink_side(f);
    }
    for (k = 0; k < 2 * sub->n && left < half; k++) {
        /* the left side from far to near, then the right side */
        v = k < sub->n ? sub->n - 1 - k : k - sub->n;
        if ((sub->side[v] == (k >= sub->n)) &
            ((f->state[2 * v + 1] & (SLI_FLOW_SEEN | SLI_FLOW_ENDS)) == 0)) {
            left += sli_flow_extend_source_side(f, v);
        }
    }
}

/* The fallback if the search takes too long: the border vertices of the lighter side. */
static void sli_separator_from_border(sli_subgraph *sub) {
    const int side = sub->total[0] > sub->total[1];
    sl_int v;
    for (v = 0; v < sub->n; v++) {
        sub->side[v] = sub->side[v] == side && sub->layer[v] == 0 ? 2 : sub->side[v];
    }
}

/* Makes a smallest vertex separator the separator of a band. terminal, next: n of scratch; scratch:
 * 7 n. */
static void sli_subgraph_separate(sli_subgraph *sub, unsigned char *terminal, sl_int *scratch,
                                  sl_off *next) {
    const size_t n = (size_t)sub->n;
    sl_int v;
    sli_flow f;
    f.sub = sub;
    f.before = scratch;
    f.after = scratch + n;
    f.path = scratch + 2 * n;
    f.via = scratch + 3 * n;
    f.list = scratch + 4 * n;
    f.state = (unsigned char *)(scratch + 6 * n);
    f.next = next;
    f.terminal = terminal;
    sli_flow_terminals(&f);
    if (sub->n > INT32_MAX / 2 || !sli_flow_maximize(&f)) { /* untested: 2^30 vertices */
        sli_separator_from_border(sub);
        return;
    }
    sli_flow_balance(&f);
    for (v = 0; v < sub->n; v++) {
        const int in = (f.state[2 * v] & SLI_FLOW_SEEN) != 0,
                  out = (f.state[2 * v + 1] & SLI_FLOW_SEEN) != 0;
        sub->side[v] = (unsigned char)(out ? 0 : in ? 2 : 1);
    }
}

#endif

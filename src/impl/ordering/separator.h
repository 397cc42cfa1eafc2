/* separator.h: a minimum vertex separator in a band, by maximum flow */
#ifndef SLI_ORDERING_SEPARATOR_H
#define SLI_ORDERING_SEPARATOR_H

#include "bisect.h"

/* A flow of vertex-disjoint paths from the left side to the right. Each vertex is split into two
 * states, 2 v its entrance and 2 v + 1 its exit, and at most one path passes between them. By
 * Menger's theorem the largest number of such paths is the size of the smallest vertex separator. A
 * round searches for an augmenting path from each source vertex in turn and enters no state twice.
 * [FF56] */
typedef struct sli_flow {
    sli_subgraph *sub;
    sl_int *before, *after;  /* n: neighbors of v on its path; SLI_FLOW_NONE if v is on no path */
    sl_int *seen;            /* 2 n: the last round that entered the state */
    sl_int *path;            /* 2 n: states of an augmenting path, source first */
    sl_off *next;            /* n: the edge to try next */
    unsigned char *terminal; /* n: 1 source, 2 sink, 0 neither */
} sli_flow;

enum { SLI_FLOW_NONE = -1, SLI_FLOW_END = -2 /* the path begins or ends here */ };

#if !defined(SLI_FLOW_ROUNDS) /* a test defines it as 1 */
#define SLI_FLOW_ROUNDS 60    /* no band seen needed more than 20 */
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

/* The state to visit next from the exit of v, or -1 if none is left. */
SLI_INLINE sl_int sli_flow_next_state(sli_flow *f, sl_int v, sl_int round) {
    const sl_off end = f->sub->begin[v + 1];
    sl_off e = f->next[v];
    while (e < end && f->seen[2 * f->sub->to[e]] == round) {
        e++;
    }
    f->next[v] = e;
    /* Go back through the vertex if a path leaves it here. */
    return e < end                                                    ? 2 * f->sub->to[e]
           : f->before[v] != SLI_FLOW_NONE && f->seen[2 * v] != round ? 2 * v
                                                                      : -1;
}

/* Appends a state to the path, and behind the entrance of a vertex on no path its exit, which
 * nothing else leads to. Returns the new length. */
SLI_INLINE sl_int sli_flow_push(sli_flow *f, sl_int state, sl_int round, sl_int length) {
    const sl_int v = state >> 1;
    f->seen[state] = round;
    f->path[length++] = state;
    if (state == 2 * v) {
        if (f->before[v] != SLI_FLOW_NONE) {
            return length;
        }
        f->seen[state + 1] = round;
        f->path[length++] = state + 1;
    }
    f->next[v] = f->sub->begin[v];
    return length;
}

/* Searches for an augmenting path from the entrance of v to a sink. Returns its number of states, 0
 * if there is none. */
static sl_int sli_flow_find_path(sli_flow *f, sl_int v, sl_int round) {
    sl_int length = sli_flow_push(f, 2 * v, round, 0);
    while (length > 0) {
        const sl_int state = f->path[length - 1];
        sl_int next_state = -1;
        v = state >> 1;
        if (state != 2 * v) {
            if (f->terminal[v] == 2) { /* no path ends here yet: its entrance would lead back */
                break;
            }
            next_state = sli_flow_next_state(f, v, round);
            length -= next_state == -1 && f->before[v] == SLI_FLOW_NONE;
        } else if (f->before[v] >= 0 && f->seen[2 * f->before[v] + 1] != round) {
            next_state = 2 * f->before[v] + 1; /* go back along the path that enters here */
        }
        length = next_state == -1 ? length - 1 : sli_flow_push(f, next_state, round, length);
    }
    return length;
}

/* Augments the flow along `path`. */
static void sli_flow_augment(sli_flow *f, sl_int length) {
    sl_int k;
    f->before[f->path[0] / 2] = SLI_FLOW_END;
    for (k = 0; k < length; k++) {
        const sl_int state = f->path[k], v = state / 2;
        if (state % 2 == 0) {
            /* the state that follows shows whether the path passes through v or turns back */
            continue;
        }
        if (k + 1 == length) {
            f->after[v] = SLI_FLOW_END;
        } else if (f->path[k + 1] == 2 * v) {
            f->before[v] = f->after[v] = SLI_FLOW_NONE;
        } else {
            f->after[v] = f->path[k + 1] / 2;
            f->before[f->after[v]] = v;
        }
    }
}

/* Finds a maximum flow. Returns whether the search ended within SLI_FLOW_ROUNDS; then seen == *last
 * marks the states that the left side reaches. */
static int sli_flow_maximize(sli_flow *f, sl_int *last) {
    const sl_int n = f->sub->n;
    sl_int v, round, found = 1;
    for (v = 0; v < n; v++) {
        f->before[v] = f->after[v] = SLI_FLOW_NONE;
        f->seen[2 * v] = f->seen[2 * v + 1] = 0;
    }
    for (round = 1; found && round <= SLI_FLOW_ROUNDS; round++) {
        found = 0;
        for (v = 0; v < n; v++) {
            if (f->terminal[v] == 1 && f->seen[2 * v] != round) {
                /* An entrance where a path begins is a dead end, but it must be marked as
                 * reached. */
                const sl_int length = sli_flow_find_path(f, v, round);
                if (length > 0) {
                    sli_flow_augment(f, length);
                    found = 1;
                }
            }
        }
        *last = round;
    }
    return !found;
}

SLI_INLINE sl_int sli_flow_mark(sli_flow *f, sl_int state, sl_int tail) {
    if (f->seen[state] != -1) {
        f->seen[state] = -1;
        f->path[tail++] = state;
    }
    return tail;
}

/* Marks by -1 the states from which a sink can be reached. */
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
        v = f->path[head] / 2;
        if (f->path[head] % 2 == 1) {
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
static int64_t sli_flow_extend_source_side(sli_flow *f, sl_int v, sl_int mark) {
    const sli_subgraph *sub = f->sub;
    sl_int head, tail = 0, next_state;
    int64_t gained = 0;
    sl_off e;
    f->seen[2 * v + 1] = mark;
    f->path[tail++] = 2 * v + 1;
    for (head = 0; head < tail; head++) {
        v = f->path[head] / 2;
        if (f->path[head] % 2 == 0) {
            /* not an entrance where a path begins: all of those are marked */
            next_state = f->before[v] == SLI_FLOW_NONE ? 2 * v + 1 : 2 * f->before[v] + 1;
            if (f->seen[next_state] != mark) {
                f->seen[next_state] = mark;
                f->path[tail++] = next_state;
            }
            continue;
        }
        gained += sub->weight[v];
        if (f->before[v] != SLI_FLOW_NONE && f->seen[2 * v] != mark) {
            f->seen[2 * v] = mark;
            f->path[tail++] = 2 * v;
        }
        for (e = sub->begin[v]; e < sub->begin[v + 1]; e++) {
            next_state = 2 * sub->to[e];
            if (f->seen[next_state] != mark) {
                f->seen[next_state] = mark;
                f->path[tail++] = next_state;
            }
        }
    }
    return gained;
}

/* Chooses a balanced one among the smallest separators: starts with the one nearest to the left,
 * then moves vertices that do not reach a sink to the left side until it has half of the weight. */
static void sli_flow_balance(sli_flow *f, sl_int mark) {
    const sli_subgraph *sub = f->sub;
    int64_t left = sub->total[0], half = sub->total[0] + sub->total[1];
    sl_int v, k;
    for (v = 0; v < sub->n; v++) {
        const int in = f->seen[2 * v] == mark, out = f->seen[2 * v + 1] == mark;
        left += (sub->side[v] == 1 && out ? sub->weight[v] : 0) -
                (sub->side[v] == 0 && !out ? sub->weight[v] : 0);
        half -= in && !out ? sub->weight[v] : 0;
    }
    half /= 2;
    for (k = 0; k < 2 * sub->n && left < half; k++) {
        /* the left side from far to near, then the right side */
        v = k < sub->n ? sub->n - 1 - k : k - sub->n;
        if (sub->side[v] == (k >= sub->n) && f->seen[2 * v + 1] != mark &&
            f->seen[2 * v + 1] != -1) {
            left += sli_flow_extend_source_side(f, v, mark);
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
 * 6 n. */
static void sli_subgraph_separate(sli_subgraph *sub, unsigned char *terminal, sl_int *scratch,
                                  sl_off *next) {
    const size_t n = (size_t)sub->n;
    sl_int v, last = 0;
    sli_flow f;
    f.sub = sub;
    f.before = scratch;
    f.after = scratch + n;
    f.seen = scratch + 2 * n;
    f.path = scratch + 4 * n;
    f.next = next;
    f.terminal = terminal;
    sli_flow_terminals(&f);
    if (sub->n > INT32_MAX / 2 || !sli_flow_maximize(&f, &last)) { /* untested: 2^30 vertices */
        sli_separator_from_border(sub);
        return;
    }
    sli_flow_mark_sink_side(&f);
    sli_flow_balance(&f, last);
    for (v = 0; v < sub->n; v++) {
        const int in = f.seen[2 * v] == last, out = f.seen[2 * v + 1] == last;
        sub->side[v] = (unsigned char)(out ? 0 : in ? 2 : 1);
    }
}

#endif

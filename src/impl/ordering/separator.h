/* order_cut.h: the smallest set of vertices in a band whose removal parts the two sides */
#ifndef SLI_ORDER_CUT_H
#define SLI_ORDER_CUT_H

#include "order_bisect.h"

/* A flow of vertex-disjoint paths from the left side to the right. A vertex is entered and left:
 * state 2 v is its entrance, 2 v + 1 its exit; between them one path fits. By Menger's theorem as
 * many paths as possible are as many as the smallest cut has vertices. A round looks for a way from
 * every start in turn and enters no state twice. [FF56] */
typedef struct sli_flow {
    sli_piece *p;
    sl_int *before, *after; /* n: the path's vertices round v; SLI_FLOW_NONE off every path */
    sl_int *seen;           /* 2 n: the last round that entered a state */
    sl_int *way;            /* 2 n: states of a way, from the left */
    sl_off *next;           /* n: the edge to try next */
    unsigned char *end;     /* n: 1 may start a path, 2 may end one */
} sli_flow;

#define SLI_FLOW_NONE (-1)
#define SLI_FLOW_END (-2)  /* the path begins or ends here */
#define SLI_FLOW_ROUNDS 60 /* no band met needed more than 20 */

/* Vertices that touch what lies outside are ends; a side that lies in the band as a whole ends in
 * its farthest layer. */
static void sli_flow_ends(sli_flow *f) {
    const sli_piece *p = f->p;
    int far[2] = {-1, -1}, anchored[2] = {0, 0};
    sl_int v;
    for (v = 0; v < p->n; v++) {
        const int s = p->side[v];
        anchored[s] |= p->anchor[v] > 0;
        far[s] = p->layer[v] > far[s] ? p->layer[v] : far[s];
    }
    for (v = 0; v < p->n; v++) {
        const int s = p->side[v];
        const int is_end = anchored[s] ? p->anchor[v] > 0 : p->layer[v] == far[s];
        f->end[v] = (unsigned char)(is_end ? 1 + s : 0);
    }
}

/* Puts the edges of every vertex that lead towards the right first, those towards the left last: a
 * way that goes straight on leaves most room for others. */
static void sli_flow_aim(sli_flow *f) {
    sli_piece *p = f->p;
    sl_int v;
    for (v = 0; v < p->n; v++) {
        const int own = p->side[v] == 0 ? -1 - p->layer[v] : p->layer[v];
        sl_off e, front = p->begin[v], back = p->begin[v + 1];
        for (e = front; e < back;) {
            const sl_int u = p->to[e];
            const int other = p->side[u] == 0 ? -1 - p->layer[u] : p->layer[u];
            if (other > own) {
                p->to[e++] = p->to[front];
                p->to[front++] = u;
            } else if (other < own) {
                p->to[e] = p->to[--back];
                p->to[back] = u;
            } else {
                e++;
            }
        }
    }
}

/* The state to go on to from an exit, -1 if none is left. */
static sl_int sli_flow_leave(sli_flow *f, sl_int v, sl_int round) {
    const sli_piece *p = f->p;
    for (; f->next[v] < p->begin[v + 1]; f->next[v]++) {
        const sl_int u = p->to[f->next[v]];
        if (f->seen[2 * u] != round) {
            return 2 * u;
        }
    }
    /* back through the vertex, where a path comes out of it */
    return f->before[v] != SLI_FLOW_NONE && f->seen[2 * v] != round ? 2 * v : -1;
}

/* A way from entrance v to the right; its length, 0 if there is none. */
static sl_int sli_flow_way(sli_flow *f, sl_int v, sl_int round) {
    sl_int length = 0, state = 2 * v;
    f->way[length++] = state;
    f->seen[state] = round;
    while (length > 0) {
        sl_int onward = -1;
        state = f->way[length - 1];
        v = state / 2;
        if (state % 2 == 1) {
            if (f->end[v] == 2 && f->after[v] != SLI_FLOW_END) {
                break;
            }
            onward = sli_flow_leave(f, v, round);
        } else if (f->before[v] == SLI_FLOW_NONE) {
            onward = 2 * v + 1;
        } else if (f->before[v] >= 0) { /* back along the path that comes in here */
            onward = 2 * f->before[v] + 1;
        }
        if (onward == -1 || f->seen[onward] == round) {
            length--;
            continue;
        }
        f->seen[onward] = round;
        f->way[length++] = onward;
        if (onward % 2 == 1) {
            f->next[onward / 2] = f->p->begin[onward / 2];
        }
    }
    return length;
}

/* Sends one path more along a way. */
static void sli_flow_send(sli_flow *f, sl_int length) {
    sl_int k;
    f->before[f->way[0] / 2] = SLI_FLOW_END;
    for (k = 0; k < length; k++) {
        const sl_int state = f->way[k], v = state / 2;
        if (state % 2 == 0) {
            continue; /* in and through, or in and back: what follows says */
        }
        if (k + 1 == length) {
            f->after[v] = SLI_FLOW_END;
        } else if (f->way[k + 1] == 2 * v) {
            f->before[v] = f->after[v] = SLI_FLOW_NONE;
        } else {
            f->after[v] = f->way[k + 1] / 2;
            f->before[f->after[v]] = v;
        }
    }
}

/* As many paths as there can be; whether the search came to its end. Then seen == *last marks what
 * the left can reach. */
static int sli_flow_run(sli_flow *f, sl_int *last) {
    const sl_int n = f->p->n;
    sl_int v, round, found = 1;
    for (v = 0; v < n; v++) {
        f->before[v] = f->after[v] = SLI_FLOW_NONE;
        f->seen[2 * v] = f->seen[2 * v + 1] = 0;
    }
    for (round = 1; found && round <= SLI_FLOW_ROUNDS; round++) {
        found = 0;
        for (v = 0; v < n; v++) {
            if (f->end[v] == 1 && f->seen[2 * v] != round) {
                /* where a path begins the way ends at once, and yet the entrance is reached */
                const sl_int length = sli_flow_way(f, v, round);
                if (length > 0) {
                    sli_flow_send(f, length);
                    found = 1;
                }
            }
        }
        *last = round;
    }
    return !found;
}

SLI_INLINE sl_int sli_flow_see(sli_flow *f, sl_int state, sl_int tail) {
    if (f->seen[state] != -1) {
        f->seen[state] = -1;
        f->way[tail++] = state;
    }
    return tail;
}

/* Marks by -1 the states from which the right can be reached. */
static void sli_flow_back(sli_flow *f) {
    const sli_piece *p = f->p;
    sl_int v, head, tail = 0;
    sl_off e;
    for (v = 0; v < p->n; v++) {
        if (f->end[v] == 2) {
            tail = sli_flow_see(f, 2 * v + 1, tail);
        }
    }
    for (head = 0; head < tail; head++) {
        v = f->way[head] / 2;
        if (f->way[head] % 2 == 1) {
            if (f->before[v] == SLI_FLOW_NONE) {
                tail = sli_flow_see(f, 2 * v, tail);
            } else if (f->after[v] >= 0) {
                tail = sli_flow_see(f, 2 * f->after[v], tail);
            }
        } else {
            if (f->before[v] != SLI_FLOW_NONE) {
                tail = sli_flow_see(f, 2 * v + 1, tail);
            }
            for (e = p->begin[v]; e < p->begin[v + 1]; e++) {
                tail = sli_flow_see(f, 2 * p->to[e] + 1, tail);
            }
        }
    }
}

/* Adds an exit and what can be reached from it to what is marked; none of it can reach the right.
 * Returns the weight of the vertices that the left gains. */
static int64_t sli_flow_extend(sli_flow *f, sl_int v, sl_int mark) {
    const sli_piece *p = f->p;
    sl_int head, tail = 0, onward;
    int64_t gained = 0;
    sl_off e;
    f->seen[2 * v + 1] = mark;
    f->way[tail++] = 2 * v + 1;
    for (head = 0; head < tail; head++) {
        v = f->way[head] / 2;
        if (f->way[head] % 2 == 0) {
            onward = f->before[v] == SLI_FLOW_NONE ? 2 * v + 1
                     : f->before[v] >= 0           ? 2 * f->before[v] + 1
                                                   : -1;
            if (onward != -1 && f->seen[onward] != mark) {
                f->seen[onward] = mark;
                f->way[tail++] = onward;
            }
            continue;
        }
        gained += p->weight[v];
        if (f->before[v] != SLI_FLOW_NONE && f->seen[2 * v] != mark) {
            f->seen[2 * v] = mark;
            f->way[tail++] = 2 * v;
        }
        for (e = p->begin[v]; e < p->begin[v + 1]; e++) {
            onward = 2 * p->to[e];
            if (f->seen[onward] != mark) {
                f->seen[onward] = mark;
                f->way[tail++] = onward;
            }
        }
    }
    return gained;
}

/* Of all smallest cuts takes one that balances: starting with the one nearest to the left, vertices
 * from which the right cannot be reached join the left until it has half. */
static void sli_flow_balance(sli_flow *f, sl_int mark) {
    const sli_piece *p = f->p;
    int64_t left = p->total[0], half = p->total[0] + p->total[1];
    sl_int v, k;
    for (v = 0; v < p->n; v++) {
        const int in = f->seen[2 * v] == mark, out = f->seen[2 * v + 1] == mark;
        left += (p->side[v] == 1 && out ? p->weight[v] : 0) -
                (p->side[v] == 0 && !out ? p->weight[v] : 0);
        half -= in && !out ? p->weight[v] : 0;
    }
    half /= 2;
    for (k = 0; k < 2 * p->n && left < half; k++) {
        v = k < p->n ? p->n - 1 - k : k - p->n; /* the left from far to near, then the right */
        if (p->side[v] == (k >= p->n) && f->seen[2 * v + 1] != mark && f->seen[2 * v + 1] != -1) {
            left += sli_flow_extend(f, v, mark);
        }
    }
}

/* The way out where a search takes too long: the border vertices of the lighter side. */
static void sli_cut_cover(sli_piece *p) {
    const int side = p->total[0] > p->total[1];
    sl_int v;
    for (v = 0; v < p->n; v++) {
        p->side[v] = p->side[v] == side && p->layer[v] == 0 ? 2 : p->side[v];
    }
}

/* Makes a smallest cut the separator of a band. end: n, scratch: 6 n, next: n of scratch. */
static void sli_piece_cut_vertices(sli_piece *p, unsigned char *end, sl_int *scratch,
                                   sl_off *next) {
    const size_t n = (size_t)p->n;
    sl_int v, last = 0;
    sli_flow f;
    f.p = p;
    f.before = scratch;
    f.after = scratch + n;
    f.seen = scratch + 2 * n;
    f.way = scratch + 4 * n;
    f.next = next;
    f.end = end;
    sli_flow_ends(&f);
    sli_flow_aim(&f);
    if (p->n > INT32_MAX / 2 || !sli_flow_run(&f, &last)) {
        sli_cut_cover(p);
        return;
    }
    sli_flow_back(&f);
    sli_flow_balance(&f, last);
    for (v = 0; v < p->n; v++) {
        const int in = f.seen[2 * v] == last, out = f.seen[2 * v + 1] == last;
        p->side[v] = (unsigned char)(out ? 0 : in ? 2 : 1);
    }
}

#endif

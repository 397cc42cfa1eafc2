/* ball.c: the vertices within a distance along edges (Dijkstra), found in time proportional to their number */
#include "ball.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "int_list.h"

/* A binary heap of (distance, vertex), the nearest on top; a vertex whose distance falls is put in again. */
typedef struct entry {
    double distance;
    sl_int vertex;
} entry;

typedef struct search {
    incidence *around; /* place[v]: v's position in reached, -1: not reached */
    entry *heap;
    size_t n_heap, heap_room;
    int_list reached;
    double *distance; /* the shortest so far, by position */
    size_t room;      /* at distance */
} search;

static bool push(search *s, double distance, sl_int vertex) {
    if (s->n_heap == s->heap_room) {
        size_t wanted = s->heap_room < 64 ? 64 : 2 * s->heap_room;
        entry *larger = (entry *)realloc(s->heap, wanted * sizeof *larger);
        if (larger == NULL) {
            return false;
        }
        s->heap = larger;
        s->heap_room = wanted;
    }
    size_t at = s->n_heap++;
    for (; at > 0 && s->heap[(at - 1) / 2].distance > distance; at = (at - 1) / 2) {
        s->heap[at] = s->heap[(at - 1) / 2];
    }
    entry e = {distance, vertex};
    s->heap[at] = e;
    return true;
}

static entry pop(search *s) {
    entry top = s->heap[0], last = s->heap[--s->n_heap];
    size_t at = 0;
    for (;;) {
        size_t child = 2 * at + 1;
        if (child >= s->n_heap) {
            break;
        }
        child += child + 1 < s->n_heap && s->heap[child + 1].distance < s->heap[child].distance;
        if (s->heap[child].distance >= last.distance) {
            break;
        }
        s->heap[at] = s->heap[child];
        at = child;
    }
    s->heap[at] = last;
    return top;
}

/* Notes that v can be reached by a path of this length. */
static bool reach(search *s, sl_int v, double distance) {
    sl_int place = s->around->place[v];
    if (place >= 0) {
        if (distance >= s->distance[place]) {
            return true;
        }
        s->distance[place] = distance;
        return push(s, distance, v);
    }
    size_t count = s->reached.count;
    if (count == s->room) {
        size_t wanted = s->room < 64 ? 64 : 2 * s->room;
        double *larger = (double *)realloc(s->distance, wanted * sizeof *larger);
        if (larger == NULL) {
            return false;
        }
        s->distance = larger;
        s->room = wanted;
    }
    if (!int_list_add(&s->reached, v)) {
        return false;
    }
    s->around->place[v] = (sl_int)count;
    s->distance[count] = distance;
    return push(s, distance, v);
}

/* Goes on from v to the other corners of its faces. */
static bool go_on(search *s, sl_int v, double distance, double radius) {
    const incidence *a = s->around;
    const double *from = a->m->xyz + 3 * (size_t)v;
    for (sl_off p = a->begin[v]; p < a->begin[v + 1]; p++) {
        const sl_int *f = a->m->faces + 3 * (size_t)a->face[p];
        for (int c = 0; c < 3; c++) {
            const double *to = a->m->xyz + 3 * (size_t)f[c];
            double length =
                distance + hypot(hypot(to[0] - from[0], to[1] - from[1]), to[2] - from[2]);
            if (f[c] != v && length <= radius && !reach(s, f[c], length)) {
                return false;
            }
        }
    }
    return true;
}

void ball_free(ball *b) {
    free(b->vertices);
    free(b->along_edges);
    memset(b, 0, sizeof *b);
}

bool ball_find(ball *out, incidence *around, const sl_int *sources, sl_int count, double radius) {
    search s;
    memset(&s, 0, sizeof s);
    s.around = around;
    memset(out, 0, sizeof *out);
    bool ok = true;
    for (sl_int k = 0; k < count && ok && radius >= 0; k++) {
        ok = reach(&s, sources[k], 0);
    }
    out->vertices = (sl_int *)malloc(sizeof *out->vertices);
    out->along_edges = (double *)malloc(sizeof *out->along_edges);
    ok = ok && out->vertices != NULL && out->along_edges != NULL;
    size_t room = 1;
    while (ok && s.n_heap > 0) {
        entry e = pop(&s);
        if (e.distance > s.distance[around->place[e.vertex]]) {
            continue; /* an older entry of a vertex that came nearer since */
        }
        if ((size_t)out->n == room) {
            room *= 2;
            sl_int *vertices = (sl_int *)realloc(out->vertices, room * sizeof *vertices);
            out->vertices = vertices != NULL ? vertices : out->vertices;
            double *lengths = (double *)realloc(out->along_edges, room * sizeof *lengths);
            out->along_edges = lengths != NULL ? lengths : out->along_edges;
            if (vertices == NULL || lengths == NULL) {
                ok = false;
                break;
            }
        }
        out->vertices[out->n] = e.vertex;
        out->along_edges[out->n++] = e.distance;
        ok = go_on(&s, e.vertex, e.distance, radius);
    }
    for (size_t k = 0; k < s.reached.count; k++) {
        around->place[s.reached.at[k]] = -1;
    }
    free(s.heap);
    free(s.reached.at);
    free(s.distance);
    if (!ok) {
        ball_free(out);
    }
    return ok;
}

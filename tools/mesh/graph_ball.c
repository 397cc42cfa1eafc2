/* graph_ball.c: all vertices within a given edge-path distance of some sources (Dijkstra) */
#include "graph_ball.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "int_list.h"
#include "path_heap.h"

typedef struct search {
    incidence *inc; /* local_index[v]: position of v in reached, -1: not reached */
    path_heap heap;
    int_list reached;
    double *distance; /* shortest path so far, by position in reached */
    size_t capacity;  /* elements at distance */
} search;

/* Records a path of this length to v. */
static bool record_path(search *s, sl_int v, double distance) {
    sl_int local_index = s->inc->local_index[v];
    if (local_index >= 0) {
        if (distance >= s->distance[local_index]) {
            return true;
        }
        s->distance[local_index] = distance;
        return path_heap_push(&s->heap, distance, v);
    }
    size_t count = s->reached.count;
    if (count == s->capacity) {
        size_t wanted = s->capacity < 64 ? 64 : 2 * s->capacity;
        double *larger = (double *)realloc(s->distance, wanted * sizeof *larger);
        if (larger == NULL) {
            return false;
        }
        s->distance = larger;
        s->capacity = wanted;
    }
    if (!int_list_add(&s->reached, v)) {
        return false;
    }
    s->inc->local_index[v] = (sl_int)count;
    s->distance[count] = distance;
    return path_heap_push(&s->heap, distance, v);
}

/* Extends the path to v by one edge, to the other corners of v's faces. */
static bool extend_paths(search *s, sl_int v, double distance, double radius) {
    const incidence *a = s->inc;
    for (sl_off p = a->begin[v]; p < a->begin[v + 1]; p++) {
        const sl_int *f = a->m->faces + 3 * (size_t)a->face[p];
        for (int k = 0; k < 3;
             k++) { /* the edge opposite to corner k, where it begins or ends at v */
            sl_int one = f[(k + 1) % 3], other = f[(k + 2) % 3], to = one == v ? other : one;
            if ((one != v && other != v) || to == v) {
                continue;
            }
            double length = distance + incidence_edge_length(a, a->face[p], k);
            if (length <= radius && !record_path(s, to, length)) {
                return false;
            }
        }
    }
    return true;
}

void graph_ball_free(graph_ball *b) {
    free(b->vertices);
    free(b->path_length);
    memset(b, 0, sizeof *b);
}

bool graph_ball_create(graph_ball *out, incidence *inc, const sl_int *sources, sl_int count,
                       double radius) {
    search s;
    memset(&s, 0, sizeof s);
    s.inc = inc;
    memset(out, 0, sizeof *out);
    bool ok = true;
    for (sl_int k = 0; k < count && ok && radius >= 0; k++) {
        ok = record_path(&s, sources[k], 0);
    }
    out->vertices = (sl_int *)malloc(sizeof *out->vertices);
    out->path_length = (double *)malloc(sizeof *out->path_length);
    ok = ok && out->vertices != NULL && out->path_length != NULL;
    size_t capacity = 1;
    while (ok && s.heap.count > 0) {
        const path_end e = path_heap_pop(&s.heap);
        const sl_int v = (sl_int)e.point;
        if (e.length > s.distance[inc->local_index[v]]) {
            continue; /* an outdated entry: a shorter path was found later */
        }
        if ((size_t)out->n == capacity) {
            capacity *= 2;
            sl_int *vertices = (sl_int *)realloc(out->vertices, capacity * sizeof *vertices);
            out->vertices = vertices != NULL ? vertices : out->vertices;
            double *lengths = (double *)realloc(out->path_length, capacity * sizeof *lengths);
            out->path_length = lengths != NULL ? lengths : out->path_length;
            if (vertices == NULL || lengths == NULL) {
                ok = false;
                break;
            }
        }
        out->vertices[out->n] = v;
        out->path_length[out->n++] = e.length;
        ok = extend_paths(&s, v, e.length, radius);
    }
    for (size_t k = 0; k < s.reached.count; k++) {
        inc->local_index[s.reached.at[k]] = -1;
    }
    free(s.heap.at);
    free(s.reached.at);
    free(s.distance);
    if (!ok) {
        graph_ball_free(out);
    }
    return ok;
}

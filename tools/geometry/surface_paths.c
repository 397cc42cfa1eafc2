/* surface_paths.c: short paths over the faces of a mesh, through points of their edges */
#include "surface_search.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { POINTS_MAX = 15 };

/* The ends of the edge opposite to corner s % 3 of face s / 3, lower number first. */
static void ends_of(sl_int ends[2], const mesh *m, sl_int s) {
    const sl_int *face = m->faces + s / 3 * 3;
    sl_int u = face[(s + 1) % 3], v = face[(s + 2) % 3];
    ends[0] = u < v ? u : v;
    ends[1] = u < v ? v : u;
}

/* Numbers the edges: sides are sorted by both ends, in two passes of counting. */
static bool number_edges(surface_search *s) {
    const mesh *m = s->inc->m;
    size_t n = (size_t)m->n_vertices;
    sl_int count = 3 * m->n_faces, ends[2], before[2] = {-1, -1};
    sl_int *order = (sl_int *)malloc(((size_t)count + 1) * sizeof *order);
    sl_off *next = (sl_off *)calloc(n + 2, sizeof *next);
    bool ok = order != NULL && next != NULL;
    for (int pass = 0; pass < 2 && ok; pass++) { /* by the higher end, then by the lower one */
        const sl_int *from = pass == 0 ? NULL : order;
        sl_int *to = pass == 0 ? order : s->side;
        memset(next, 0, (n + 2) * sizeof *next);
        for (sl_int k = 0; k < count; k++) {
            ends_of(ends, m, k);
            next[ends[pass == 0 ? 1 : 0] + 1]++;
        }
        for (size_t v = 0; v < n; v++) {
            next[v + 1] += next[v];
        }
        for (sl_int k = 0; k < count; k++) {
            sl_int side = from != NULL ? from[k] : k;
            ends_of(ends, m, side);
            to[next[ends[pass == 0 ? 1 : 0]]++] = side;
        }
    }
    for (sl_int k = 0; k < count && ok; k++) {
        ends_of(ends, m, s->side[k]);
        if (ends[0] != before[0] || ends[1] != before[1]) {
            s->begin[s->n_edges++] = k;
        }
        s->edge_of[s->side[k]] = s->n_edges - 1;
        memcpy(before, ends, sizeof before);
    }
    s->begin[s->n_edges] = count;
    free(next);
    free(order);
    return ok;
}

static void place(double x[3], const surface_search *s, int64_t point) {
    const mesh *m = s->inc->m;
    if (point < m->n_vertices) {
        memcpy(x, m->xyz + 3 * point, 3 * sizeof *x);
        return;
    }
    int64_t edge = (point - m->n_vertices) / s->points, k = (point - m->n_vertices) % s->points;
    double share = (double)(k + 1) / (double)(s->points + 1);
    sl_int ends[2];
    ends_of(ends, m, s->side[s->begin[edge]]);
    for (int c = 0; c < 3; c++) {
        double a = m->xyz[3 * (size_t)ends[0] + (size_t)c];
        double b = m->xyz[3 * (size_t)ends[1] + (size_t)c];
        x[c] = a + share * (b - a);
    }
}

/* Notes a shorter path to a point; its last step is from `parent` across a face. */
static bool reach(surface_search *s, path_end e, sl_int origin, int64_t parent, sl_int face) {
    if (s->length[e.point] == INFINITY) {
        s->found[s->n_found++] = e.point;
    }
    s->length[e.point] = e.length;
    s->origin[e.point] = origin;
    s->parent[e.point] = parent;
    s->across[e.point] = face;
    return path_heap_push(&s->heap, e.length, e.point);
}

/* Extends a path to all points of a face. */
static bool extend(surface_search *s, path_end e, sl_int face) {
    const mesh *m = s->inc->m;
    double from[3], to[3];
    place(from, s, e.point);
    for (int k = 0; k < 3; k++) {
        int64_t edge = s->edge_of[3 * face + k];
        for (int i = -1; i < s->points; i++) {
            int64_t point =
                i < 0 ? (int64_t)m->faces[3 * face + k] : m->n_vertices + edge * s->points + i;
            place(to, s, point);
            double x = to[0] - from[0], y = to[1] - from[1], z = to[2] - from[2];
            const path_end next = {e.length + sqrt(x * x + y * y + z * z), point};
            if (next.length < s->length[point] && next.length <= s->limit &&
                !reach(s, next, s->origin[e.point], e.point, face)) {
                return false;
            }
        }
    }
    return true;
}

bool surface_search_run(surface_search *s, const sl_int *sources, sl_int count, double limit) {
    const sl_int n = s->inc->m->n_vertices;
    bool ok = true;
    for (size_t k = 0; k < s->n_found; k++) {
        s->length[s->found[k]] = INFINITY;
    }
    s->n_found = 0;
    s->heap.count = 0;
    s->limit = limit;
    for (sl_int k = 0; k < count && ok; k++) {
        const path_end start = {0, sources[k]};
        ok = s->length[sources[k]] == 0 || reach(s, start, k, -1, -1);
    }
    for (size_t k = 0; k < s->curve.count * (size_t)s->points && ok; k++) {
        const int64_t edge = s->curve.at[k / (size_t)s->points];
        const path_end start = {0, n + edge * s->points + (int64_t)(k % (size_t)s->points)};
        ok = reach(s, start, 0, -1, -1);
    }
    while (ok && s->heap.count > 0) {
        path_end e = path_heap_pop(&s->heap);
        if (e.length > s->length[e.point]) {
            continue;
        }
        if (e.point < n) {
            for (sl_off p = s->inc->begin[e.point]; p < s->inc->begin[e.point + 1] && ok; p++) {
                ok = extend(s, e, s->inc->face[p]);
            }
        } else {
            int64_t edge = (e.point - n) / s->points;
            for (sl_off p = s->begin[edge]; p < s->begin[edge + 1] && ok; p++) {
                ok = extend(s, e, s->side[p] / 3);
            }
        }
    }
    return ok;
}

bool surface_search_create(surface_search **out, const incidence *inc, int points) {
    size_t corners = 3 * (size_t)inc->m->n_faces, n = (size_t)inc->m->n_vertices;
    surface_search *s = (surface_search *)calloc(1, sizeof *s);
    *out = NULL;
    if (s == NULL || points < 0 || points > POINTS_MAX || inc->m->n_faces > INT32_MAX / 3) {
        free(s);
        return false;
    }
    s->inc = inc;
    s->points = points;
    s->edge_of = (sl_int *)malloc((corners + 1) * sizeof *s->edge_of);
    s->side = (sl_int *)malloc((corners + 1) * sizeof *s->side);
    s->begin = (sl_off *)malloc((corners + 2) * sizeof *s->begin);
    bool ok = s->edge_of != NULL && s->side != NULL && s->begin != NULL && number_edges(s);
    size_t total = n + (size_t)s->n_edges * (size_t)points + 1;
    if (ok) {
        s->length = (double *)malloc(total * sizeof *s->length);
        s->origin = (sl_int *)malloc(total * sizeof *s->origin);
        s->found = (int64_t *)malloc(total * sizeof *s->found);
        s->parent = (int64_t *)malloc(total * sizeof *s->parent);
        s->across = (sl_int *)malloc(total * sizeof *s->across);
    }
    for (size_t k = 0; k < total && s->length != NULL; k++) {
        s->length[k] = INFINITY;
    }
    if (s->length == NULL || s->origin == NULL || s->found == NULL || s->parent == NULL ||
        s->across == NULL) {
        surface_search_free(s);
        return false;
    }
    *out = s;
    return true;
}

bool surface_search_set_curve(surface_search *s, const sl_int *ends, sl_int count) {
    s->curve.count = 0;
    free(s->is_curve);
    s->is_curve = (unsigned char *)calloc((size_t)s->n_edges + 1, 1);
    bool ok = s->is_curve != NULL;
    for (sl_int k = 0; k < count && ok; k++) {
        const sl_int edge = surface_search_edge(s, ends[2 * k], ends[2 * k + 1]);
        ok = edge >= 0 && (s->is_curve[edge] || int_list_add(&s->curve, edge));
        if (ok) {
            s->is_curve[edge] = 1;
        }
    }
    return ok;
}

sl_int surface_search_edge(const surface_search *s, sl_int a, sl_int b) {
    const incidence *inc = s->inc;
    for (sl_off p = inc->begin[a]; p < inc->begin[a + 1]; p++) {
        for (int k = 0; k < 3; k++) {
            sl_int ends[2];
            ends_of(ends, inc->m, 3 * inc->face[p] + k);
            if (ends[0] == (a < b ? a : b) && ends[1] == (a < b ? b : a)) {
                return s->edge_of[3 * inc->face[p] + k];
            }
        }
    }
    return -1;
}

void surface_search_ends(sl_int ends[2], const surface_search *s, sl_int edge) {
    ends_of(ends, s->inc->m, s->side[s->begin[edge]]);
}

void surface_search_place(double x[3], const surface_search *s, int64_t point) {
    place(x, s, point);
}

const double *surface_search_lengths(const surface_search *s) {
    return s->length;
}

const sl_int *surface_search_origins(const surface_search *s) {
    return s->origin;
}

void surface_search_free(surface_search *s) {
    if (s != NULL) {
        free(s->is_curve);
        free(s->curve.at);
        free(s->straight);
        free(s->angle);
        free(s->across);
        free(s->parent);
        free(s->heap.at);
        free(s->found);
        free(s->origin);
        free(s->length);
        free(s->begin);
        free(s->side);
        free(s->edge_of);
        free(s);
    }
}

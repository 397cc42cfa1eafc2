/* surface_paths.c: short paths over the faces of a mesh, exact where these are flat */
#include "surface_paths.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "tools/mesh/path_heap.h"

enum { POINTS_MAX = 15 };

/* Points are the vertices, then `points` of each edge, from its lower to its higher vertex. */
struct surface_search {
    const incidence *inc;
    int points;
    sl_int n_edges;
    sl_int *edge_of; /* 3 n_faces: the edge opposite to a corner */
    sl_off *begin;   /* n_edges + 1: the sides of an edge are side[begin[e]] .. */
    sl_int *side;    /* 3 n_faces */
    double *length;  /* of the shortest path so far, by point */
    sl_int *origin;  /* the position of its source, by point */
    int64_t *found;  /* the points with a path, in the order of discovery */
    size_t n_found;
    double limit;
    path_heap heap;
    /* of surface_search_unfold, n_vertices each; NULL: not needed yet */
    unsigned char *flat; /* see find_flat */
    double *unfolded[2]; /* for mixed false and true; INFINITY where no path leads */
    sl_int *unfolded_from;
};

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

/* Notes a shorter path to a point. */
static bool reach(surface_search *s, double length, int64_t point, sl_int origin) {
    if (s->length[point] == INFINITY) {
        s->found[s->n_found++] = point;
    }
    s->length[point] = length;
    s->origin[point] = origin;
    return path_heap_push(&s->heap, length, point);
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
            double length = e.length + sqrt(x * x + y * y + z * z);
            if (length < s->length[point] && length <= s->limit &&
                !reach(s, length, point, s->origin[e.point])) {
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
        for (int i = 0; i < 2 && s->found[k] < n; i++) {
            if (s->unfolded[i] != NULL) {
                s->unfolded[i][s->found[k]] = INFINITY;
            }
        }
    }
    s->n_found = 0;
    s->heap.count = 0;
    s->limit = limit;
    for (sl_int k = 0; k < count && ok; k++) {
        ok = s->length[sources[k]] == 0 || reach(s, 0, sources[k], k);
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
    }
    for (size_t k = 0; k < total && s->length != NULL; k++) {
        s->length[k] = INFINITY;
    }
    if (s->length == NULL || s->origin == NULL || s->found == NULL) {
        surface_search_free(s);
        return false;
    }
    *out = s;
    return true;
}

const double *surface_search_lengths(const surface_search *s) {
    return s->length;
}

const sl_int *surface_search_origins(const surface_search *s) {
    return s->origin;
}

/* The distance of corner c of a face with the distances of a and b, corners of the same face: that
 * of the point which has these two in the plane of the face, beyond the edge from a to b. INFINITY:
 * the line from there to c does not cross that edge. */
static double unfolded(const mesh *m, sl_int a, sl_int b, sl_int c, double to_a, double to_b) {
    const double *p = m->xyz + 3 * (size_t)a, *q = m->xyz + 3 * (size_t)b,
                 *r = m->xyz + 3 * (size_t)c;
    double edge2 = 0, side2 = 0, along = 0;
    for (int d = 0; d < 3; d++) {
        edge2 += (q[d] - p[d]) * (q[d] - p[d]);
        side2 += (r[d] - p[d]) * (r[d] - p[d]);
        along += (q[d] - p[d]) * (r[d] - p[d]);
    }
    const double edge = sqrt(edge2), x = along / edge, y = sqrt(fmax(0, side2 - x * x));
    const double from_x = (to_a * to_a - to_b * to_b + edge2) / (2 * edge);
    const double depth2 = to_a * to_a - from_x * from_x;
    if (!(depth2 >= 0 && y > 0)) {
        return INFINITY;
    }
    const double depth = sqrt(depth2), crossing = from_x + (x - from_x) * depth / (depth + y);
    return crossing >= 0 && crossing <= edge ? hypot(x - from_x, y + depth) : INFINITY;
}

/* Marks the vertices around which the faces are as in a plane, and those of the border that have no
 * other neighbors inside. */
static bool find_flat(surface_search *s) {
    enum { BORDER = 2 };
    const mesh *m = s->inc->m;
    const double full = 2 * acos(-1), rounding = 1e-6;
    const size_t n = (size_t)m->n_vertices;
    double *angle = (double *)calloc(n + 1, sizeof *angle);
    s->flat = (unsigned char *)calloc(n + 1, 1);
    if (angle == NULL || s->flat == NULL) {
        free(angle);
        return false;
    }
    for (size_t k = 0; k < 3 * (size_t)m->n_faces; k++) {
        const double *x = m->xyz + 3 * (size_t)m->faces[k];
        const double *y = m->xyz + 3 * (size_t)m->faces[k / 3 * 3 + (k + 1) % 3];
        const double *z = m->xyz + 3 * (size_t)m->faces[k / 3 * 3 + (k + 2) % 3];
        double yy = 0, zz = 0, yz = 0;
        for (int d = 0; d < 3; d++) {
            yy += (y[d] - x[d]) * (y[d] - x[d]);
            zz += (z[d] - x[d]) * (z[d] - x[d]);
            yz += (y[d] - x[d]) * (z[d] - x[d]);
        }
        angle[m->faces[k]] += atan2(sqrt(fmax(0, yy * zz - yz * yz)), yz);
    }
    for (size_t v = 0; v < n; v++) {
        s->flat[v] = fabs(angle[v] - full) < rounding;
    }
    for (sl_int e = 0; e < s->n_edges; e++) {
        sl_int ends[2];
        ends_of(ends, m, s->side[s->begin[e]]);
        for (int k = 0; k < 2 && s->begin[e + 1] - s->begin[e] == 1; k++) {
            s->flat[ends[k]] = BORDER;
        }
    }
    memset(angle, 0, n * sizeof *angle); /* now 1: next to a vertex inside that is not flat */
    for (size_t k = 0; k < 3 * (size_t)m->n_faces; k++) {
        for (size_t i = 1; i < 3 && s->flat[m->faces[k]] == 0; i++) {
            angle[m->faces[k / 3 * 3 + (k + i) % 3]] = 1;
        }
    }
    for (size_t v = 0; v < n; v++) {
        s->flat[v] = s->flat[v] == 1 || (s->flat[v] == BORDER && angle[v] == 0);
    }
    free(angle);
    return true;
}

/* A vertex and the length of its path. */
typedef struct reached {
    double length;
    sl_int vertex;
} reached;

static int by_length(const void *a, const void *b) {
    const reached *p = (const reached *)a, *q = (const reached *)b;
    return p->length != q->length ? (p->length > q->length) - (p->length < q->length)
                                  : (p->vertex > q->vertex) - (p->vertex < q->vertex);
}

/* Distances where the surface is flat, and the sources that they are from. */
typedef struct flat_lengths {
    const surface_search *s;
    double *length; /* by vertex; INFINITY: not known */
    sl_int *origin;
    bool mixed; /* whether the ends of an edge may have different sources */
} flat_lengths;

/* Shortens the way to v: along an edge from a flat vertex or a source, or across the opposite edge
 * of a face between two of them. Returns whether it did. */
static bool shorten(flat_lengths *w, sl_int v) {
    const surface_search *s = w->s;
    const mesh *m = s->inc->m;
    const double before = w->length[v];
    for (sl_off p = s->inc->begin[v]; p < s->inc->begin[v + 1]; p++) {
        const sl_int *face = m->faces + 3 * (size_t)s->inc->face[p];
        const int c = face[0] == v ? 0 : face[1] == v ? 1 : 2;
        const sl_int end[2] = {face[(c + 1) % 3], face[(c + 2) % 3]};
        double length = INFINITY;
        int known = 0;
        for (int k = 0; k < 2; k++) {
            const double *x = m->xyz + 3 * (size_t)end[k], *y = m->xyz + 3 * (size_t)v;
            const double there = w->length[end[k]];
            if (isfinite(there) && (s->flat[end[k]] || there == 0)) {
                const double here = there + hypot(hypot(x[0] - y[0], x[1] - y[1]), x[2] - y[2]);
                known++;
                if (here < w->length[v] * (1 - 1e-12)) {
                    w->length[v] = here;
                    w->origin[v] = w->origin[end[k]];
                }
            }
        }
        if (known == 2 && (w->mixed || w->origin[end[0]] == w->origin[end[1]])) {
            length = unfolded(m, end[0], end[1], v, w->length[end[0]], w->length[end[1]]);
        }
        if (length < w->length[v] * (1 - 1e-12)) {
            w->length[v] = length;
            w->origin[v] = w->origin[end[0]];
        }
    }
    return w->length[v] < before;
}

/* Allocates what surface_search_unfold needs at its first call. */
static bool prepare_unfolding(surface_search *s, bool mixed) {
    const size_t n = (size_t)s->inc->m->n_vertices;
    double *out = s->unfolded[mixed];
    if (out == NULL) {
        out = s->unfolded[mixed] = (double *)malloc((n + 1) * sizeof *out);
        for (size_t v = 0; v < n && out != NULL; v++) {
            out[v] = INFINITY;
        }
    }
    if (s->unfolded_from == NULL) {
        s->unfolded_from = (sl_int *)malloc((n + 1) * sizeof *s->unfolded_from);
    }
    return out != NULL && s->unfolded_from != NULL && (s->flat != NULL || find_flat(s));
}

const double *surface_search_unfold(surface_search *s, bool mixed) {
    enum { PASSES = 8 }; /* more than one for obtuse faces, which are crossed against the order */
    const mesh *m = s->inc->m;
    size_t count = 0;
    bool changed = true;
    reached *order = (reached *)malloc((s->n_found + 1) * sizeof *order);
    if (order == NULL || !prepare_unfolding(s, mixed)) {
        free(order);
        return NULL;
    }
    flat_lengths w = {s, s->unfolded[mixed], s->unfolded_from, mixed};
    for (size_t k = 0; k < s->n_found; k++) {
        const int64_t v = s->found[k];
        if (v < m->n_vertices) {
            order[count].vertex = (sl_int)v;
            order[count++].length = s->length[v];
            w.length[v] = s->length[v] == 0 ? 0 : INFINITY;
            w.origin[v] = s->origin[v];
        }
    }
    qsort(order, count, sizeof *order, by_length);
    for (int pass = 0; pass < PASSES && changed; pass++) {
        changed = false;
        for (size_t k = 0; k < count; k++) {
            changed = shorten(&w, order[k].vertex) || changed;
        }
    }
    free(order);
    return w.length;
}

void surface_search_free(surface_search *s) {
    if (s != NULL) {
        free(s->unfolded_from);
        free(s->unfolded[1]);
        free(s->unfolded[0]);
        free(s->flat);
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

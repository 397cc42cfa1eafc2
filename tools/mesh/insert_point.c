/* insert_point.c: a vertex in a face or on an edge of a mesh, whose surface stays */
#include "insert_point.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* A coordinate of a point that is below this is 0. */
static const double on_edge = 1e-9;

static double dot(const double *a, const double *b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* The part of the way from a to b at which the line between them is nearest to x. */
static double along_line(const double *a, const double *b, const double *x) {
    double e[3], d[3];
    for (int k = 0; k < 3; k++) {
        e[k] = b[k] - a[k];
        d[k] = x[k] - a[k];
    }
    const double size = dot(e, e);
    return size > 0 ? fmax(0, fmin(1, dot(d, e) / size)) : 0;
}

/* The squared distance of x from a point of the face. */
static double away(const double *const corner[3], double u, double v, const double *x) {
    double d[3];
    for (int k = 0; k < 3; k++) {
        d[k] = (1 - u - v) * corner[0][k] + u * corner[1][k] + v * corner[2][k] - x[k];
    }
    return dot(d, d);
}

/* The nearest point of one face: in the face, or on one of its sides. Returns the squared
 * distance. */
static double nearest_in_face(const double *const corner[3], const double *x, double *u,
                              double *v) {
    double b[3], c[3], d[3], least = INFINITY;
    for (int k = 0; k < 3; k++) {
        b[k] = corner[1][k] - corner[0][k];
        c[k] = corner[2][k] - corner[0][k];
        d[k] = x[k] - corner[0][k];
    }
    const double bb = dot(b, b), bc = dot(b, c), cc = dot(c, c), det = bb * cc - bc * bc;
    const double p = cc * dot(b, d) - bc * dot(c, d), q = bb * dot(c, d) - bc * dot(b, d);
    if (det > 0 && p >= 0 && q >= 0 && p + q <= det) {
        *u = p / det;
        *v = q / det;
        return away(corner, *u, *v, x);
    }
    for (int k = 0; k < 3; k++) {
        const int next = (k + 1) % 3;
        const double t = along_line(corner[k], corner[next], x);
        double w[3] = {0, 0, 0};
        w[k] = 1 - t;
        w[next] += t;
        const double here = away(corner, w[1], w[2], x);
        if (here < least) {
            least = here;
            *u = w[1];
            *v = w[2];
        }
    }
    return least;
}

face_point nearest_face_point(const mesh *m, const double x[3]) {
    face_point out = {-1, 0, 0};
    double least = INFINITY;
    for (sl_int f = 0; f < m->n_faces; f++) {
        const double *corner[3];
        double u = 0, v = 0;
        for (int k = 0; k < 3; k++) {
            corner[k] = m->xyz + 3 * (size_t)m->faces[3 * (size_t)f + (size_t)k];
        }
        const double here = nearest_in_face(corner, x, &u, &v);
        if (here < least) {
            const face_point p = {f, u, v};
            least = here;
            out = p;
        }
    }
    return out;
}

/* Replaces a corner of a face by p in the face itself, and another one in a copy at the end. */
static void divide_face(mesh *m, size_t face, int first, int second, sl_int p) {
    sl_int *old = m->faces + 3 * face, *added = m->faces + 3 * (size_t)m->n_faces++;
    memcpy(added, old, 3 * sizeof *old);
    old[first] = p;
    added[second] = p;
}

/* Divides all faces that have both vertices as corners. */
static void divide_edge(mesh *m, sl_int from, sl_int to, sl_int p) {
    const sl_int n_faces = m->n_faces;
    for (size_t f = 0; f < (size_t)n_faces; f++) {
        int at[2] = {-1, -1};
        for (int k = 0; k < 3; k++) {
            at[0] = m->faces[3 * f + (size_t)k] == from ? k : at[0];
            at[1] = m->faces[3 * f + (size_t)k] == to ? k : at[1];
        }
        if (at[0] >= 0 && at[1] >= 0) {
            divide_face(m, f, at[0], at[1], p);
        }
    }
}

/* The number of faces that have both vertices as corners. */
static size_t faces_at(const mesh *m, sl_int from, sl_int to) {
    size_t count = 0;
    for (size_t f = 0; f < (size_t)m->n_faces; f++) {
        const sl_int *c = m->faces + 3 * f;
        count += (c[0] == from || c[1] == from || c[2] == from) &&
                 (c[0] == to || c[1] == to || c[2] == to);
    }
    return count;
}

/* Gives the arrays room for one vertex and `faces` faces more. */
static bool make_room(mesh *m, size_t faces) {
    const size_t n = (size_t)m->n_vertices + 1, count = (size_t)m->n_faces + faces;
    double *xyz = (double *)realloc(m->xyz, 3 * n * sizeof *xyz);
    m->xyz = xyz != NULL ? xyz : m->xyz;
    sl_int *larger = (sl_int *)realloc(m->faces, 3 * count * sizeof *larger);
    m->faces = larger != NULL ? larger : m->faces;
    return xyz != NULL && larger != NULL;
}

bool insert_face_point(mesh *m, const face_point *p, sl_int *vertex) {
    const double w[3] = {1 - p->u - p->v, p->u, p->v};
    int zeros = 0, zero = 0, one = 0;
    if (p->face < 0 || p->face >= m->n_faces) {
        return false;
    }
    for (int k = 0; k < 3; k++) {
        if (!(w[k] >= -on_edge)) {
            return false;
        }
        zeros += w[k] < on_edge;
        zero = w[k] < on_edge ? k : zero;
        one = w[k] > w[one] ? k : one;
    }
    const sl_int c[3] = {m->faces[3 * (size_t)p->face], m->faces[3 * (size_t)p->face + 1],
                         m->faces[3 * (size_t)p->face + 2]};
    if (zeros >= 2) {
        *vertex = c[one];
        return true;
    }
    const sl_int from = c[(zero + 1) % 3], to = c[(zero + 2) % 3];
    const size_t more = zeros == 1 ? faces_at(m, from, to) : 2;
    if (m->n_vertices == INT32_MAX || more > (size_t)(INT32_MAX - m->n_faces) ||
        !make_room(m, more)) {
        return false;
    }
    *vertex = m->n_vertices++;
    for (size_t d = 0; d < 3; d++) {
        m->xyz[3 * (size_t)*vertex + d] = w[0] * m->xyz[3 * (size_t)c[0] + d] +
                                          w[1] * m->xyz[3 * (size_t)c[1] + d] +
                                          w[2] * m->xyz[3 * (size_t)c[2] + d];
    }
    if (zeros == 1) {
        divide_edge(m, from, to, *vertex);
    } else { /* a b c becomes p b c, a p c and a b p */
        const size_t face = (size_t)p->face;
        divide_face(m, face, 0, 1, *vertex);
        sl_int *last = m->faces + 3 * (size_t)m->n_faces++;
        last[0] = c[0];
        last[1] = c[1];
        last[2] = *vertex;
    }
    return true;
}

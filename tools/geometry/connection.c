/* connection.c: tangent planes of a triangle mesh, and the connection Laplacian between them */
#include "connection.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "laplacian.h"
#include "planar_triangle.h"
#include "tools/matrix/triplets.h"
#include "tools/mesh/edge_sides.h"

static const double pi = 3.14159265358979323846;

/* Sets other[s] to the side at the other face of the edge, or to -1 at a border; returns the number
 * of irregular edges. */
static sl_int join_sides(sl_int *other, const mesh *m, const edge_side *sides) {
    const size_t count = 3 * (size_t)m->n_faces;
    sl_int irregular = 0;
    for (size_t k = 0, end; k < count; k = end) {
        end = end_of_edge(sides, k, count);
        for (size_t i = k; i < end; i++) {
            other[sides[i].side] = -1;
        }
        const sl_int a = sides[k].side, b = sides[end - 1].side;
        if (sides[k].low == sides[k].high) {
            continue; /* a face with a repeated vertex */
        }
        if (end - k == 2 && m->faces[side_after(a)] != m->faces[side_after(b)]) {
            other[a] = b;
            other[b] = a;
        } else {
            irregular += end - k > 1;
        }
    }
    return irregular;
}

/* Corner 3 f + k of a face has the number of the side opposite to it. Its first edge, to corner
 * k + 1, is side k + 2; its last one is side k + 1. */

static sl_int corner_before(const sl_int *other, sl_int corner) {
    const sl_int side = other[side_after(side_after(corner))];
    return side < 0 ? -1 : side_after(side_after(side));
}

static sl_int corner_after(const sl_int *other, sl_int corner) {
    const sl_int side = other[side_after(corner)];
    return side < 0 ? -1 : side_after(side);
}

/* The angles of the corners of a face, from 0 to pi. */
static void corner_angles(double angle[3], const mesh *m, const sl_int *face) {
    const planar_triangle p = planar_triangle_of(m, face);
    const double base = p.x[1][0], *top = p.x[2];
    angle[0] = atan2(top[1], top[0]);
    angle[1] = atan2(top[1], base - top[0]);
    angle[2] = fmax(0, pi - angle[0] - angle[1]);
}

/* The corners around a vertex that follow one another, from a border or, if there is none, from
 * any corner on. The vertex has `sum` as the sum of its angles so far. */
static void walk_fan(connection *c, const sl_int *other, unsigned char *seen, sl_int corner,
                     double *sum, bool *is_closed) {
    sl_int first = corner;
    for (sl_int k = corner_before(other, corner); k != corner; k = corner_before(other, k)) {
        if (k < 0) {
            break;
        }
        first = k;
    }
    sl_int k = first;
    do {
        double *angle = c->angle + 2 * (size_t)k;
        const double own = angle[1];
        angle[0] = *sum;
        *sum += own;
        angle[1] = *sum;
        seen[k] = 1;
        k = corner_after(other, k);
    } while (k >= 0 && k != first);
    *is_closed = k == first;
}

/* Places the corners of each vertex one after the other. */
static void place_corners(connection *c, const sl_int *other, unsigned char *seen, double *scale) {
    const size_t n = (size_t)c->m->n_vertices, corners = 3 * (size_t)c->m->n_faces;
    double *sum = scale; /* the sums first */
    memset(sum, 0, n * sizeof *sum);
    /* a vertex whose corners are closed has one fan; its sum is marked by its sign */
    for (size_t k = 0; k < corners; k++) {
        const sl_int v = c->m->faces[k];
        bool is_closed;
        if (seen[k]) {
            continue;
        }
        const bool is_first = sum[v] == 0;
        double total = fabs(sum[v]);
        walk_fan(c, other, seen, (sl_int)k, &total, &is_closed);
        sum[v] = is_first && is_closed ? -total : total;
    }
    for (size_t v = 0; v < n; v++) {
        scale[v] = sum[v] < 0 ? 2 * pi / -sum[v] : 1;
    }
    for (size_t k = 0; k < corners; k++) {
        c->angle[2 * k] *= scale[c->m->faces[k]];
        c->angle[2 * k + 1] *= scale[c->m->faces[k]];
    }
}

static double length_of(const double *x) {
    return hypot(hypot(x[0], x[1]), x[2]);
}

static void cross(double *out, const double *x, const double *y) {
    for (int d = 0; d < 3; d++) {
        const int e = (d + 1) % 3, g = (d + 2) % 3;
        out[d] = x[e] * y[g] - x[g] * y[e];
    }
}

/* Scales a vector to length 1; false, and unchanged, if it has none. */
static bool normalize(double *x) {
    const double length = length_of(x);
    for (int d = 0; d < 3 && length > 0 && isfinite(length); d++) {
        x[d] /= length;
    }
    return length > 0 && isfinite(length);
}

/* The directions of the edges from corner k of a face to the next and the previous corner; those
 * without length are 0. */
static void edges_at(double next[3], double last[3], const mesh *m, size_t corner) {
    const double *x = m->xyz + 3 * (size_t)m->faces[corner],
                 *y = m->xyz + 3 * (size_t)m->faces[side_after((sl_int)corner)],
                 *z = m->xyz + 3 * (size_t)m->faces[side_after(side_after((sl_int)corner))];
    for (int d = 0; d < 3; d++) {
        next[d] = y[d] - x[d];
        last[d] = z[d] - x[d];
    }
    if (!normalize(next)) {
        memset(next, 0, 3 * sizeof *next);
    }
    if (!normalize(last)) {
        memset(last, 0, 3 * sizeof *last);
    }
}

/* The coordinate axis farthest from a direction, projected to the plane orthogonal to it. */
static void any_orthogonal(double out[3], const double n[3]) {
    int least = fabs(n[0]) <= fabs(n[1]) ? 0 : 1;
    least = fabs(n[2]) < fabs(n[least]) ? 2 : least;
    for (int d = 0; d < 3; d++) {
        out[d] = (d == least) - n[least] * n[d];
    }
    (void)normalize(out);
}

/* Computes the axes. `normal` and `turn` have room for 3 and 2 values a vertex and are 0. */
static void place_axes(connection *c, double *normal, double *turn) {
    const mesh *m = c->m;
    double next[3], last[3], n[3];
    for (size_t k = 0; k < 3 * (size_t)m->n_faces; k++) {
        double *sum = normal + 3 * (size_t)m->faces[k];
        edges_at(next, last, m, k);
        cross(n, next, last); /* its length is the sine of the angle, which serves as a weight */
        for (int d = 0; d < 3; d++) {
            sum[d] += n[d];
        }
    }
    for (size_t v = 0; v < (size_t)m->n_vertices; v++) {
        double *axes = c->axes + 6 * v, *up = normal + 3 * v;
        if (!normalize(up)) {
            up[0] = up[1] = 0;
            up[2] = 1;
        }
        any_orthogonal(axes, up);
        cross(axes + 3, up, axes);
    }
    for (size_t k = 0; k < 3 * (size_t)m->n_faces; k++) {
        const size_t v = (size_t)m->faces[k];
        const double *axes = c->axes + 6 * v;
        edges_at(next, last, m, k);
        for (int side = 0; side < 2; side++) {
            const double *e = side == 0 ? next : last, angle = c->angle[2 * k + (size_t)side];
            const double x = e[0] * axes[0] + e[1] * axes[1] + e[2] * axes[2],
                         y = e[0] * axes[3] + e[1] * axes[4] + e[2] * axes[5];
            turn[2 * v] += x * cos(angle) + y * sin(angle); /* the direction times exp(-i angle) */
            turn[2 * v + 1] += y * cos(angle) - x * sin(angle);
        }
    }
    for (size_t v = 0; v < (size_t)m->n_vertices; v++) {
        const double length = hypot(turn[2 * v], turn[2 * v + 1]);
        const double x = length > 0 ? turn[2 * v] / length : 1,
                     y = length > 0 ? turn[2 * v + 1] / length : 0;
        double *axes = c->axes + 6 * v;
        for (int d = 0; d < 3; d++) {
            const double a = axes[d], b = axes[3 + d];
            axes[d] = x * a + y * b;
            axes[3 + d] = x * b - y * a;
        }
    }
}

bool connection_create(connection *out, const mesh *m) {
    const size_t n = (size_t)m->n_vertices, corners = 3 * (size_t)m->n_faces;
    memset(out, 0, sizeof *out);
    if (!mesh_faces_are_in_range(m)) {
        return false;
    }
    out->m = m;
    out->angle = (double *)calloc(2 * corners + 1, sizeof(double));
    out->axes = (double *)calloc(6 * n + 1, sizeof(double));
    edge_side *sides = sorted_sides(m);
    sl_int *other = (sl_int *)malloc((corners + 1) * sizeof *other);
    unsigned char *seen = (unsigned char *)calloc(corners + 1, 1);
    double *work = (double *)calloc(5 * n + 1, sizeof *work);
    bool ok = out->angle != NULL && out->axes != NULL && sides != NULL && other != NULL &&
              seen != NULL && work != NULL;
    if (ok) {
        out->irregular = join_sides(other, m, sides);
        for (size_t f = 0; f < (size_t)m->n_faces; f++) {
            double angle[3];
            corner_angles(angle, m, m->faces + 3 * f);
            for (size_t k = 0; k < 3; k++) {
                out->angle[6 * f + 2 * k + 1] = angle[k];
            }
        }
        place_corners(out, other, seen, work);
        memset(work, 0, n * sizeof *work);
        place_axes(out, work, work + 3 * n);
    }
    free(work);
    free(seen);
    free(other);
    free(sides);
    if (!ok) {
        connection_free(out);
    }
    return ok;
}

void connection_free(connection *c) {
    free(c->angle);
    free(c->axes);
    memset(c, 0, sizeof *c);
}

void connection_to_space(double vector[3], const connection *c, sl_int vertex, const double z[2]) {
    const double *axes = c->axes + 6 * (size_t)vertex;
    for (int d = 0; d < 3; d++) {
        vector[d] = z[0] * axes[d] + z[1] * axes[3 + d];
    }
}

void connection_from_space(double z[2], const connection *c, sl_int vertex,
                           const double vector[3]) {
    const double *axes = c->axes + 6 * (size_t)vertex;
    z[0] = vector[0] * axes[0] + vector[1] * axes[1] + vector[2] * axes[2];
    z[1] = vector[0] * axes[3] + vector[1] * axes[4] + vector[2] * axes[5];
}

/* Adds t L of a face: real parts to list[0], imaginary ones to list[1]. */
static bool add_face(triplets *list, double *diagonal, const connection *c, size_t f, double t) {
    const sl_int *face = c->m->faces + 3 * f;
    const laplacian_face measure = laplacian_of_face(c->m, face);
    bool ok = true;
    for (size_t k = 0; k < 3 && ok; k++) {
        const size_t a = (k + 1) % 3, b = (k + 2) % 3; /* the edge from corner a to corner b */
        const sl_int u = face[a], v = face[b];
        const double weight = u == v ? 0 : t * measure.weight[k];
        /* -weight r, from u to v */
        const double turn = c->angle[6 * f + 2 * b + 1] - c->angle[6 * f + 2 * a];
        const double y = weight * sin(turn);
        diagonal[u] += weight;
        diagonal[v] += weight;
        ok = triplets_add(&list[0], u > v ? u : v, u > v ? v : u, weight * cos(turn)) &&
             triplets_add(&list[1], u > v ? u : v, u > v ? v : u,
                          u < v   ? y
                          : u > v ? -y
                                  : 0);
    }
    return ok;
}

sl_status connection_system(sl_matrix **out, const connection *c, double t) {
    const sl_int n = c->m->n_vertices;
    triplets list[2] = {{0, 0, NULL, NULL, NULL}, {0, 0, NULL, NULL, NULL}};
    sl_matrix *re = NULL, *im = NULL;
    *out = NULL;
    if (!(t >= 0 && t <= 1e200)) {
        return SL_ERR_ARGUMENT;
    }
    double *diagonal = (double *)malloc(((size_t)n + 1) * sizeof *diagonal);
    bool ok = diagonal != NULL;
    if (ok) {
        laplacian_mass(diagonal, c->m);
    }
    for (size_t f = 0; f < (size_t)c->m->n_faces && ok; f++) {
        ok = add_face(list, diagonal, c, f, t);
    }
    for (sl_int v = 0; v < n && ok; v++) {
        ok = triplets_add(&list[0], v, v, diagonal[v]) && triplets_add(&list[1], v, v, 0);
    }
    free(diagonal);
    sl_status status = ok ? triplets_finish(&re, n, n, &list[0], true) : SL_ERR_MEMORY;
    status = status == SL_OK ? triplets_finish(&im, n, n, &list[1], true) : status;
    if (status == SL_OK) {
        const sl_csc x = sl_matrix_view(re), y = sl_matrix_view(im);
        const sl_hermitian H = {n, x.p, x.i, x.x, y.x};
        status = sl_matrix_from_hermitian(out, &H, NULL, NULL);
    }
    triplets_free(&list[0]);
    triplets_free(&list[1]);
    sl_matrix_free(re);
    sl_matrix_free(im);
    return status;
}

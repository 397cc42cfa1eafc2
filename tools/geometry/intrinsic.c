/* intrinsic.c: intrinsic Delaunay triangulations of a surface, also one that is not manifold */
#include "intrinsic.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "laplacian.h"
#include "planar_triangle.h"
#include "tools/mesh/edge_sides.h"

void intrinsic_free(intrinsic *a) {
    mesh_free(&a->m);
    free(a->lengths);
    memset(a, 0, sizeof *a);
}

static bool runs_upward(const sl_int *faces, sl_int side) {
    return faces[side_after(side)] < faces[side_after(side_after(side))];
}

/* Glues the sides of oriented manifold faces: twin[s] is the other side of the edge, -1 at the
 * boundary. False: an edge is not manifold. */
static bool glue(sl_int *twin, const mesh *m, const edge_side *sides) {
    size_t count = 3 * (size_t)m->n_faces;
    for (size_t k = 0, end; k < count; k = end) {
        end = end_of_edge(sides, k, count);
        sl_int s = sides[k].side, t = end == k + 2 ? sides[k + 1].side : -1;
        if (end > k + 2 || (t >= 0 && runs_upward(m->faces, s) == runs_upward(m->faces, t))) {
            return false;
        }
        twin[s] = t;
        if (t >= 0) {
            twin[t] = s;
        }
    }
    return true;
}

/* Side s of face f in its copy f + n_faces, which has the other orientation: corners 0 2 1. */
static sl_int other_copy(sl_int s, sl_int n_faces) {
    return 3 * (s / 3 + n_faces) + (s % 3 == 0 ? 0 : 3 - s % 3);
}

/* Adds the copies with the other orientation to the faces of m, and glues around each edge: of each
 * face the copy that runs downward to the copy of the next face that runs upward. */
static void glue_cover(sl_int *twin, mesh *m, const edge_side *sides) {
    sl_int n = m->n_faces;
    for (sl_int f = 0; f < n; f++) {
        const sl_int *from = m->faces + 3 * (size_t)f;
        sl_int *to = m->faces + 3 * ((size_t)f + (size_t)n);
        to[0] = from[0];
        to[1] = from[2];
        to[2] = from[1];
    }
    size_t count = 3 * (size_t)n;
    for (size_t k = 0, end; k < count; k = end) {
        end = end_of_edge(sides, k, count);
        for (size_t i = k; i < end; i++) {
            sl_int s = sides[i].side, t = sides[i + 1 < end ? i + 1 : k].side;
            sl_int down = runs_upward(m->faces, s) ? other_copy(s, n) : s;
            sl_int up = runs_upward(m->faces, t) ? t : other_copy(t, n);
            twin[down] = up;
            twin[up] = down;
        }
    }
    m->n_faces = 2 * n;
}

/* Copies the vertices and the usable faces; there is room for two copies of each face. */
static bool copy_mesh(intrinsic *out, const mesh *m) {
    size_t n = (size_t)m->n_vertices, corners = 3 * (size_t)m->n_faces;
    out->m.xyz = (double *)malloc((3 * n + 1) * sizeof(double));
    out->m.faces = (sl_int *)malloc((2 * corners + 1) * sizeof(sl_int));
    out->lengths = (double *)malloc((2 * corners + 1) * sizeof(double));
    if (out->m.xyz == NULL || out->m.faces == NULL || out->lengths == NULL) {
        return false;
    }
    memcpy(out->m.xyz, m->xyz, 3 * n * sizeof(double));
    out->m.n_vertices = m->n_vertices;
    for (size_t f = 0; f < (size_t)m->n_faces; f++) {
        const sl_int *v = m->faces + 3 * f;
        double size = 0;
        for (int k = 0; k < 3; k++) {
            if (v[k] < 0 || v[k] >= m->n_vertices) {
                return false;
            }
            for (int c = 0; c < 3; c++) {
                size += fabs(m->xyz[3 * (size_t)v[k] + (size_t)c]);
            }
        }
        if (v[0] == v[1] || v[1] == v[2] || v[2] == v[0] || !(size < 1e140)) {
            out->left_out++;
        } else {
            memcpy(out->m.faces + 3 * (size_t)out->m.n_faces++, v, 3 * sizeof *v);
        }
    }
    return true;
}

/* The lengths, and `added` to each. False: all are 0. */
static bool measure(intrinsic *out) {
    const mesh *m = &out->m;
    size_t count = 3 * (size_t)m->n_faces;
    double sum = 0, least = INFINITY;
    for (size_t s = 0; s < count; s++) {
        const double *a = m->xyz + 3 * (size_t)m->faces[side_after((sl_int)s)];
        const double *b = m->xyz + 3 * (size_t)m->faces[side_after(side_after((sl_int)s))];
        out->lengths[s] = hypot(hypot(a[0] - b[0], a[1] - b[1]), a[2] - b[2]);
        sum += out->lengths[s] / (double)count;
    }
    for (size_t s = 0; s < count; s++) {
        const double *l = out->lengths + s / 3 * 3;
        least = fmin(least, l[0] + l[1] + l[2] - 2 * out->lengths[s]);
    }
    if (!(sum > 0)) {
        return false;
    }
    out->added = fmax(0, 1e-5 * sum - least);
    for (size_t s = 0; s < count; s++) {
        out->lengths[s] += out->added;
    }
    return true;
}

/* Places the apex of a triangle whose base lies on the x axis from the origin. */
static void place_apex(double *x, double *y, double base, double from_origin, double from_end) {
    const double l[3] = {from_end, from_origin, base};
    *x = 0.5 * (base + (from_origin - from_end) * ((from_origin + from_end) / base));
    *y = 2 * planar_area_of_lengths(l) / base;
}

/* Replaces the edge of sides s and t by the other diagonal of its two faces, and writes the four
 * sides around it to outer. With F = (p, a, b), G = (q, b, a): F' = (p, a, q), G' = (q, b, p). */
static void flip(intrinsic *out, sl_int *twin, sl_int s, sl_int t, sl_int outer[4]) {
    sl_int F = 3 * (s / 3), G = 3 * (t / 3);
    sl_int *faces = out->m.faces;
    double *l = out->lengths;
    const sl_int pa = side_after(side_after(s)), bp = side_after(s), aq = side_after(t),
                 qb = side_after(side_after(t));
    const sl_int p = faces[s], a = faces[side_after(s)], b = faces[side_after(side_after(s))],
                 q = faces[t];
    const sl_int from[4] = {pa, bp, aq, qb};
    const sl_int to[4] = {F + 2, G, F, G + 2};
    const double l_pa = l[pa], l_bp = l[bp], l_aq = l[aq], l_qb = l[qb], l_ab = l[s];
    sl_int beyond[4];
    double x[2], y[2];
    for (int k = 0; k < 4; k++) { /* a neighbor may be one of the two faces themselves */
        beyond[k] = twin[from[k]];
        for (int i = 0; i < 4; i++) {
            if (twin[from[k]] == from[i]) {
                beyond[k] = to[i];
            }
        }
    }
    place_apex(&x[0], &y[0], l_ab, l_pa, l_bp);
    place_apex(&x[1], &y[1], l_ab, l_aq, l_qb);
    const sl_int corners_F[3] = {p, a, q}, corners_G[3] = {q, b, p};
    memcpy(faces + F, corners_F, sizeof corners_F);
    memcpy(faces + G, corners_G, sizeof corners_G);
    l[F] = l_aq;
    l[F + 2] = l_pa;
    l[G] = l_bp;
    l[G + 2] = l_qb;
    l[F + 1] = l[G + 1] = hypot(x[0] - x[1], y[0] + y[1]);
    twin[F + 1] = G + 1;
    twin[G + 1] = F + 1;
    for (int k = 0; k < 4; k++) {
        outer[k] = to[k];
        twin[to[k]] = beyond[k];
        if (beyond[k] >= 0) {
            twin[beyond[k]] = to[k];
        }
    }
}

/* Whether the two angles opposite to an edge sum to more than pi, beyond rounding. */
static bool is_bad(const intrinsic *a, sl_int s, sl_int t) {
    laplacian_face f = laplacian_of_lengths(a->lengths + s / 3 * 3);
    laplacian_face g = laplacian_of_lengths(a->lengths + t / 3 * 3);
    double one = f.weight[s % 3], two = g.weight[t % 3];
    return one + two < -1e-10 * (1 + fabs(one) + fabs(two));
}

/* Flips edges until all are Delaunay. False: out of memory. */
static bool make_delaunay(intrinsic *out, sl_int *twin) {
    sl_int count = 3 * out->m.n_faces;
    size_t waiting = 0;
    sl_off limit = 1000 + 50 * (sl_off)count;
    sl_int *stack = (sl_int *)malloc(((size_t)count + 1) * sizeof *stack);
    unsigned char *waits = (unsigned char *)calloc((size_t)count + 1, 1);
    bool ok = stack != NULL && waits != NULL;
    for (sl_int s = count - 1; s >= 0 && ok; s--) {
        waits[s] = 1;
        stack[waiting++] = s;
    }
    while (ok && waiting > 0 && out->flips < limit) {
        sl_int s = stack[--waiting], t = twin[s], outer[4];
        waits[s] = 0;
        if (t < 0 || s / 3 == t / 3 || !is_bad(out, s, t)) {
            continue;
        }
        flip(out, twin, s, t, outer);
        out->flips++;
        for (int k = 0; k < 4; k++) {
            if (!waits[outer[k]]) {
                waits[outer[k]] = 1;
                stack[waiting++] = outer[k];
            }
        }
    }
    out->delaunay = ok && waiting == 0;
    free(waits);
    free(stack);
    return ok;
}

/* Whether an edge at the boundary has a negative weight: no flip can change that. */
static bool has_bad_boundary(const intrinsic *a, const sl_int *twin) {
    for (sl_int s = 0; s < 3 * a->m.n_faces; s++) {
        if (twin[s] < 0 && laplacian_of_lengths(a->lengths + s / 3 * 3).weight[s % 3] < -1e-10) {
            return true;
        }
    }
    return false;
}

/* One attempt, with or without a double cover. *retry: the faces need a cover. */
static bool create(intrinsic *out, const mesh *m, bool cover, bool *retry) {
    sl_int *twin = NULL;
    edge_side *sides = NULL;
    memset(out, 0, sizeof *out);
    out->share = cover ? 0.5 : 1;
    *retry = false;
    bool ok = m->n_faces <= INT32_MAX / 6 && copy_mesh(out, m) && measure(out);
    if (ok) {
        twin = (sl_int *)malloc((6 * (size_t)out->m.n_faces + 1) * sizeof *twin);
        sides = sorted_sides(&out->m);
        ok = twin != NULL && sides != NULL;
    }
    if (ok && cover) {
        sl_int n = out->m.n_faces;
        glue_cover(twin, &out->m, sides);
        for (sl_int s = 0; s < 3 * n; s++) {
            out->lengths[other_copy(s, n)] = out->lengths[s];
        }
    } else if (ok) {
        *retry = !glue(twin, &out->m, sides);
    }
    if (ok && !*retry) {
        ok = make_delaunay(out, twin);
        *retry = ok && has_bad_boundary(out, twin);
    }
    free(sides);
    free(twin);
    if (!ok) {
        intrinsic_free(out);
    }
    return ok;
}

bool intrinsic_create(intrinsic *out, const mesh *m) {
    bool retry;
    bool ok = create(out, m, false, &retry);
    if (ok && retry) {
        intrinsic_free(out);
        ok = create(out, m, true, &retry);
    }
    return ok;
}

bool intrinsic_is_needed(const mesh *m, sl_off *negative, sl_int *flat) {
    edge_side *sides = sorted_sides(m);
    size_t count = 3 * (size_t)m->n_faces;
    *negative = 0;
    *flat = 0;
    for (size_t k = 0, end; k < count && sides != NULL; k = end) {
        double weight = 0, size = 0;
        end = end_of_edge(sides, k, count);
        for (size_t i = k; i < end; i++) {
            sl_int s = sides[i].side;
            laplacian_face f = laplacian_of_face(m, m->faces + s / 3 * 3);
            weight += f.weight[s % 3];
            size += fabs(f.weight[s % 3]);
            *flat += s % 3 == 0 && f.weight[0] == 0 && f.weight[1] == 0 && f.weight[2] == 0;
        }
        *negative += weight < -1e-8 * (1 + size);
    }
    free(sides);
    return *negative > 0 || *flat > 0;
}

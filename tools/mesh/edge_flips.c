/* edge_flips.c: the faces of a mesh whose edges are flipped one by one */
#include "edge_flips.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "edge_sides.h"

void edge_flips_free(edge_flips *a) {
    free(a->m.faces);
    free(a->twin);
    memset(a, 0, sizeof *a);
}

bool edge_flips_create(edge_flips *out, const mesh *m) {
    const size_t count = 3 * (size_t)m->n_faces;
    memset(out, 0, sizeof *out);
    if (!mesh_faces_are_in_range(m)) {
        return false;
    }
    out->m = *m;
    out->m.faces = (sl_int *)malloc((count + 1) * sizeof(sl_int));
    out->twin = (sl_int *)malloc((count + 1) * sizeof(sl_int));
    edge_side *sides = sorted_sides(m);
    if (out->m.faces == NULL || out->twin == NULL || sides == NULL) {
        edge_flips_free(out);
        free(sides);
        return false;
    }
    memcpy(out->m.faces, m->faces, count * sizeof(sl_int));
    for (size_t s = 0; s < count; s++) {
        out->twin[s] = -1;
    }
    for (size_t k = 0, end; k < count; k = end) {
        end = end_of_edge(sides, k, count);
        const sl_int s = sides[k].side, t = end == k + 2 ? sides[k + 1].side : -1;
        if (t >= 0 && s / 3 != t / 3 && /* a face that names a vertex twice is its own neighbor */
            m->faces[side_after(s)] != m->faces[side_after(t)]) { /* opposite directions */
            out->twin[s] = t;
            out->twin[t] = s;
        }
    }
    free(sides);
    return true;
}

/* The normal of a face, of the length of twice its area. */
static void normal_of(double out[3], const mesh *m, sl_int i, sl_int j, sl_int k) {
    const double *a = m->xyz + 3 * (size_t)i, *b = m->xyz + 3 * (size_t)j,
                 *c = m->xyz + 3 * (size_t)k;
    for (int d = 0; d < 3; d++) {
        const int e = (d + 1) % 3, g = (d + 2) % 3;
        out[d] = (b[e] - a[e]) * (c[g] - a[g]) - (b[g] - a[g]) * (c[e] - a[e]);
    }
}

bool edge_flips_corners(sl_int corners[4], const edge_flips *a, sl_int side) {
    const sl_int twin = a->twin[side];
    const sl_int u = a->m.faces[side_after(side)], v = a->m.faces[side_after(side_after(side))];
    corners[0] = u;
    corners[1] = v;
    corners[2] = a->m.faces[side];
    corners[3] = twin < 0 ? corners[2] : a->m.faces[twin];
    const sl_int c = corners[2], d = corners[3];
    if (twin < 0 || u == v || c == d || c == u || c == v || d == u || d == v) {
        return false;
    }
    const double smallest = 0.05; /* of the area of both faces together */
    double before[2][3], now[2][3], size = 0, direction[3];
    normal_of(before[0], &a->m, c, u, v);
    normal_of(before[1], &a->m, d, v, u);
    normal_of(now[0], &a->m, c, u, d);
    normal_of(now[1], &a->m, d, v, c);
    for (int k = 0; k < 3; k++) {
        direction[k] = before[0][k] + before[1][k];
        size += direction[k] * direction[k];
    }
    for (int f = 0; f < 2; f++) {
        double along = 0;
        for (int k = 0; k < 3; k++) {
            along += now[f][k] * direction[k];
        }
        if (!(along > smallest * size)) {
            return false;
        }
    }
    return isfinite(size) && size > 0;
}

/* Glues side s to side t, which may be -1. */
static void join(edge_flips *a, sl_int s, sl_int t) {
    a->twin[s] = t;
    if (t >= 0) {
        a->twin[t] = s;
    }
}

void edge_flips_flip(sl_int pair[2], edge_flips *a, sl_int side) {
    /* faces c u v and d v u become c u d and d v c */
    const sl_int s = side, t = a->twin[side], s1 = side_after(s), s2 = side_after(s1),
                 t1 = side_after(t), t2 = side_after(t1);
    const sl_int c = a->m.faces[s], d = a->m.faces[t];
    const sl_int beyond_ud = a->twin[t1], beyond_vc = a->twin[s1];
    a->m.faces[s2] = d;
    a->m.faces[t2] = c;
    join(a, s, beyond_ud);
    join(a, t, beyond_vc);
    join(a, s1, t1);
    pair[0] = s / 3;
    pair[1] = t / 3;
}

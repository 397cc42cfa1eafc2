/* remesh.c: a mesh whose topology changes in places: flips, splits and collapses of edges */
#include "remesh.h"

#include <stdlib.h>
#include <string.h>

#include "edge_sides.h"

enum { MOST_AROUND = 32 }; /* edges of a vertex that is edited */

/* A side s of a face runs from faces[after(s)] to faces[after(after(s))]. */
static sl_int from_of(const remesh *r, sl_int s) {
    return r->faces.m.faces[side_after(s)];
}

static sl_int to_of(const remesh *r, sl_int s) {
    return r->faces.m.faces[side_after(side_after(s))];
}

/* The next side around the vertex at which s begins, or -1 at the border. */
static sl_int around(const remesh *r, sl_int s) {
    return r->faces.twin[side_after(side_after(s))];
}

/* Each side of the face begins at a corner of it. */
static void remember_sides(remesh *r, sl_int face) {
    for (sl_int s = 3 * face; s < 3 * face + 3; s++) {
        r->side[from_of(r, s)] = s;
    }
}

static void join(remesh *r, sl_int s, sl_int t) {
    if (s >= 0) {
        r->faces.twin[s] = t;
    }
    if (t >= 0) {
        r->faces.twin[t] = s;
    }
}

void remesh_free(remesh *r) {
    free(r->faces.m.xyz);
    edge_flips_free(&r->faces);
    free(r->valence);
    free(r->side);
    memset(r, 0, sizeof *r);
}

/* Gives an array room for `count` elements. */
static bool grow(void *array, size_t count, size_t size) {
    void **at = (void **)array, *larger = realloc(*at, (count + 1) * size);
    if (larger != NULL) {
        *at = larger;
    }
    return larger != NULL;
}

static bool make_room(remesh *r) {
    mesh *m = &r->faces.m;
    if (m->n_vertices + 1 > r->most_vertices) {
        const sl_int most = m->n_vertices + m->n_vertices / 8 + 16;
        const size_t count = (size_t)most;
        if (!grow(&m->xyz, 3 * count, sizeof *m->xyz) ||
            !grow(&r->valence, count, sizeof *r->valence) ||
            !grow(&r->side, count, sizeof *r->side)) {
            return false;
        }
        r->most_vertices = most;
    }
    if (m->n_faces + 2 > r->most_faces) {
        const sl_int most = m->n_faces + m->n_faces / 8 + 16;
        if (!grow(&m->faces, 3 * (size_t)most, sizeof *m->faces) ||
            !grow(&r->faces.twin, 3 * (size_t)most, sizeof *r->faces.twin)) {
            return false;
        }
        r->most_faces = most;
    }
    return true;
}

bool remesh_create(remesh *out, const mesh *m) {
    const size_t n = (size_t)m->n_vertices;
    memset(out, 0, sizeof *out);
    if (!edge_flips_create(&out->faces, m)) {
        return false;
    }
    out->faces.m.xyz = (double *)malloc((3 * n + 1) * sizeof(double));
    out->valence = (sl_int *)calloc(n + 1, sizeof(sl_int));
    out->side = (sl_int *)malloc((n + 1) * sizeof(sl_int));
    if (out->faces.m.xyz == NULL || out->valence == NULL || out->side == NULL) {
        remesh_free(out);
        return false;
    }
    out->most_vertices = m->n_vertices;
    out->most_faces = m->n_faces;
    memcpy(out->faces.m.xyz, m->xyz, 3 * n * sizeof(double));
    memset(out->side, 0xff, n * sizeof(sl_int)); /* -1 */
    for (sl_int f = 0; f < m->n_faces; f++) {
        remember_sides(out, f);
        for (sl_int s = 3 * f; s < 3 * f + 3; s++) { /* an edge at the border has one side */
            out->valence[from_of(out, s)]++;
            out->valence[to_of(out, s)] += out->faces.twin[s] < 0;
        }
    }
    return true;
}

/* Lists the sides that begin at a vertex. Returns how many; 0: it is at the border, has too many,
 * or has faces beside those around it, which would be left behind. */
static int sides_around(const remesh *r, sl_int v, sl_int *sides) {
    const sl_int start = r->side[v];
    sl_int s = start;
    int count = 0;
    do {
        if (s < 0 || count == MOST_AROUND) {
            return 0;
        }
        sides[count++] = s;
        s = around(r, s);
    } while (s != start);
    return count == r->valence[v] ? count : 0;
}

/* Are two vertices joined? The first one is not at the border. */
static bool are_joined(const remesh *r, const sl_int *sides, int count, sl_int v) {
    for (int k = 0; k < count; k++) {
        if (to_of(r, sides[k]) == v) {
            return true;
        }
    }
    return false;
}

bool remesh_flip(remesh *r, sl_int side) {
    sl_int corners[4], sides[MOST_AROUND], pair[2];
    if (r->faces.m.faces[side] < 0 || !edge_flips_corners(corners, &r->faces, side)) {
        return false;
    }
    const int count = sides_around(r, corners[2], sides);
    if (count == 0 || are_joined(r, sides, count, corners[3]) || r->valence[corners[0]] < 4 ||
        r->valence[corners[1]] < 4) {
        return false;
    }
    edge_flips_flip(pair, &r->faces, side);
    remember_sides(r, pair[0]);
    remember_sides(r, pair[1]);
    r->valence[corners[0]]--;
    r->valence[corners[1]]--;
    r->valence[corners[2]]++;
    r->valence[corners[3]]++;
    return true;
}

bool remesh_split(remesh *r, sl_int side) {
    mesh *m = &r->faces.m;
    if (m->faces[side] < 0 || r->faces.twin[side] < 0 || !make_room(r)) {
        return false;
    }
    /* faces c u v and d v u become c u w, c w v, d v w and d w u */
    const sl_int s = side, s1 = side_after(s), s2 = side_after(s1);
    const sl_int t = r->faces.twin[s], t1 = side_after(t), t2 = side_after(t1);
    const sl_int c = m->faces[s], u = m->faces[s1], v = m->faces[s2], d = m->faces[t];
    const sl_int beyond_vc = r->faces.twin[s1], beyond_ud = r->faces.twin[t1];
    const sl_int w = m->n_vertices++, p = 3 * m->n_faces, q = p + 3;
    m->n_faces += 2;
    for (int k = 0; k < 3; k++) {
        m->xyz[3 * (size_t)w + (size_t)k] =
            0.5 * m->xyz[3 * (size_t)u + (size_t)k] + 0.5 * m->xyz[3 * (size_t)v + (size_t)k];
    }
    m->faces[s2] = m->faces[t2] = w;
    m->faces[p] = c;
    m->faces[p + 1] = m->faces[q + 1] = w;
    m->faces[p + 2] = v;
    m->faces[q] = d;
    m->faces[q + 2] = u;
    join(r, s, q);
    join(r, t, p);
    join(r, s1, p + 2);
    join(r, t1, q + 2);
    join(r, p + 1, beyond_vc);
    join(r, q + 1, beyond_ud);
    r->valence[w] = 4;
    r->valence[c]++;
    r->valence[d]++;
    remember_sides(r, s / 3);
    remember_sides(r, t / 3);
    remember_sides(r, p / 3);
    remember_sides(r, q / 3);
    return true;
}

/* Twice the area of a face with other corners, as a vector. */
static void face_normal(double out[3], const double *a, const double *b, const double *c) {
    for (int d = 0; d < 3; d++) {
        const int e = (d + 1) % 3, g = (d + 2) % 3;
        out[d] = (b[e] - a[e]) * (c[g] - a[g]) - (b[g] - a[g]) * (c[e] - a[e]);
    }
}

/* Does the face of a side that begins at v keep its orientation if v moves to u? */
static bool keeps_orientation(const remesh *r, sl_int side, sl_int u) {
    const double *x = r->faces.m.xyz, *b = x + 3 * (size_t)to_of(r, side),
                 *c = x + 3 * (size_t)r->faces.m.faces[side];
    double before[3], after[3], product = 0, size = 0;
    face_normal(before, x + 3 * (size_t)from_of(r, side), b, c);
    face_normal(after, x + 3 * (size_t)u, b, c);
    for (int k = 0; k < 3; k++) {
        product += before[k] * after[k];
        size += before[k] * before[k];
    }
    return product > 0.05 * size;
}

/* May the end v of a side move to its begin u? */
static bool may_collapse(const remesh *r, sl_int u, sl_int v, const sl_int *of_v, int count) {
    sl_int of_u[MOST_AROUND];
    const int others = sides_around(r, u, of_u);
    int shared = 0;
    for (int k = 0; k < count && others > 0; k++) {
        const sl_int w = to_of(r, of_v[k]), opposite = r->faces.m.faces[of_v[k]];
        shared += are_joined(r, of_u, others, w);
        if (w != u && opposite != u && !keeps_orientation(r, of_v[k], u)) {
            return false;
        }
    }
    return others > 0 && shared == 2 && r->valence[u] + r->valence[v] - 4 <= MOST_AROUND / 2;
}

/* Removes the face of a side that is collapsed: its other two sides become one edge. */
static void remove_face(remesh *r, sl_int s) {
    const sl_int s1 = side_after(s), s2 = side_after(s1), x = r->faces.twin[s1],
                 y = r->faces.twin[s2];
    const sl_int f = s / 3;
    join(r, x, y);
    if (x >= 0) {
        r->side[from_of(r, x)] = x;
        r->side[to_of(r, x)] = y;
    }
    for (sl_int k = 3 * f; k < 3 * f + 3; k++) {
        r->faces.m.faces[k] = r->faces.twin[k] = -1;
    }
}

bool remesh_collapse(remesh *r, sl_int side) {
    sl_int of_v[MOST_AROUND];
    if (r->faces.m.faces[side] < 0 || r->faces.twin[side] < 0) {
        return false;
    }
    const sl_int u = from_of(r, side), v = to_of(r, side), twin = r->faces.twin[side];
    const sl_int c = r->faces.m.faces[side], d = r->faces.m.faces[twin];
    const int count = sides_around(r, v, of_v);
    if (count == 0 || r->valence[c] < 4 || r->valence[d] < 4 ||
        r->faces.twin[side_after(side)] < 0 || r->faces.twin[side_after(twin)] < 0 ||
        !may_collapse(r, u, v, of_v, count)) {
        return false;
    }
    for (int k = 0; k < count; k++) {
        r->faces.m.faces[side_after(of_v[k])] = u;
    }
    remove_face(r, side);
    remove_face(r, twin);
    r->valence[u] += r->valence[v] - 4;
    r->valence[v] = 0;
    r->valence[c]--;
    r->valence[d]--;
    r->side[v] = -1;
    return true;
}

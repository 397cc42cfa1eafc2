/* incidence.c: the faces around each vertex of a mesh, and scratch to number some vertices */
#include "incidence.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static bool is_listed(const sl_int *f, const double *lengths) {
    return lengths != NULL || (f[0] != f[1] && f[1] != f[2] && f[2] != f[0]);
}

void incidence_free(incidence *a) {
    free(a->begin);
    free(a->face);
    free(a->local_index);
    free(a->face_mark);
    memset(a, 0, sizeof *a);
}

bool incidence_create(incidence *out, const mesh *m) {
    return incidence_create_of(out, m, NULL);
}

double incidence_edge_length(const incidence *a, sl_int f, int k) {
    const sl_int *v = a->m->faces + 3 * (size_t)f;
    const double *x = a->m->xyz + 3 * (size_t)v[(k + 1) % 3];
    const double *y = a->m->xyz + 3 * (size_t)v[(k + 2) % 3];
    return a->lengths != NULL ? a->lengths[3 * (size_t)f + (size_t)k]
                              : hypot(hypot(x[0] - y[0], x[1] - y[1]), x[2] - y[2]);
}

bool incidence_create_of(incidence *out, const mesh *m, const double *lengths) {
    size_t n = (size_t)m->n_vertices, corners = 3 * (size_t)m->n_faces;
    memset(out, 0, sizeof *out);
    if (!mesh_faces_are_in_range(m)) {
        return false;
    }
    out->m = m;
    out->lengths = lengths;
    out->begin = (sl_off *)calloc(n + 2, sizeof *out->begin);
    out->face = (sl_int *)malloc((corners + 1) * sizeof *out->face);
    out->local_index = (sl_int *)malloc((n + 1) * sizeof *out->local_index);
    out->face_mark = (unsigned char *)calloc((size_t)m->n_faces + 1, 1);
    if (out->begin == NULL || out->face == NULL || out->local_index == NULL ||
        out->face_mark == NULL) {
        incidence_free(out);
        return false;
    }
    /* begin[v + 2] counts the faces of v; after the prefix sums, begin[v + 1] is the next free
     * position of v, and its end once all faces are stored */
    for (size_t k = 0; k < corners; k++) {
        out->begin[m->faces[k] + 2] += is_listed(m->faces + k / 3 * 3, lengths);
    }
    for (size_t v = 0; v < n; v++) {
        out->begin[v + 2] += out->begin[v + 1];
        out->local_index[v] = -1;
    }
    for (size_t k = 0; k < corners; k++) {
        if (is_listed(m->faces + k / 3 * 3, lengths)) {
            out->face[out->begin[m->faces[k] + 1]++] = (sl_int)(k / 3);
        }
    }
    return true;
}

sl_int incidence_edge_faces(const incidence *a, sl_int u, sl_int v, sl_int *faces,
                            sl_int max_faces) {
    sl_int found = 0;
    if (a->begin[u + 1] - a->begin[u] > a->begin[v + 1] - a->begin[v]) {
        sl_int w = u;
        u = v;
        v = w;
    }
    for (sl_off p = a->begin[u]; p < a->begin[u + 1]; p++) {
        const sl_int *f = a->m->faces + 3 * (size_t)a->face[p];
        if (f[0] == v || f[1] == v || f[2] == v) {
            if (found < max_faces) {
                faces[found] = a->face[p];
            }
            found++;
        }
    }
    return found;
}

bool incidence_vertices_are_distinct(incidence *inc, const sl_int *vertices, sl_int count) {
    sl_int marked = 0;
    bool ok = count >= 0;
    for (; ok && marked < count; marked++) {
        sl_int v = vertices[marked];
        if (v < 0 || v >= inc->m->n_vertices || inc->local_index[v] >= 0) {
            ok = false;
            break;
        }
        inc->local_index[v] = marked;
    }
    for (sl_int k = 0; k < marked; k++) {
        inc->local_index[vertices[k]] = -1;
    }
    return ok;
}

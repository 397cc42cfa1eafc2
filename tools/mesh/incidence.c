/* incidence.c: the faces around each vertex of a mesh, and scratch with which parts of it are numbered locally */
#include "incidence.h"

#include <stdlib.h>
#include <string.h>

static bool has_shape(const sl_int *f) {
    return f[0] != f[1] && f[1] != f[2] && f[2] != f[0];
}

void incidence_free(incidence *a) {
    free(a->begin);
    free(a->face);
    free(a->place);
    free(a->taken);
    memset(a, 0, sizeof *a);
}

bool incidence_create(incidence *out, const mesh *m) {
    size_t n = (size_t)m->n_vertices, corners = 3 * (size_t)m->n_faces;
    memset(out, 0, sizeof *out);
    for (size_t k = 0; k < corners; k++) {
        if (m->faces[k] < 0 || m->faces[k] >= m->n_vertices) {
            return false;
        }
    }
    out->m = m;
    out->begin = (sl_off *)calloc(n + 2, sizeof *out->begin);
    out->face = (sl_int *)malloc((corners + 1) * sizeof *out->face);
    out->place = (sl_int *)malloc((n + 1) * sizeof *out->place);
    out->taken = (unsigned char *)calloc((size_t)m->n_faces + 1, 1);
    if (out->begin == NULL || out->face == NULL || out->place == NULL || out->taken == NULL) {
        incidence_free(out);
        return false;
    }
    /* counts at v + 2, then their sums; while placing, begin[v + 1] is the next free place of v */
    for (size_t k = 0; k < corners; k++) {
        out->begin[m->faces[k] + 2] += has_shape(m->faces + k / 3 * 3);
    }
    for (size_t v = 0; v < n; v++) {
        out->begin[v + 2] += out->begin[v + 1];
        out->place[v] = -1;
    }
    for (size_t k = 0; k < corners; k++) {
        if (has_shape(m->faces + k / 3 * 3)) {
            out->face[out->begin[m->faces[k] + 1]++] = (sl_int)(k / 3);
        }
    }
    return true;
}

sl_int incidence_edge(const incidence *a, sl_int u, sl_int v, sl_int *faces, sl_int most) {
    sl_int found = 0;
    if (a->begin[u + 1] - a->begin[u] > a->begin[v + 1] - a->begin[v]) {
        sl_int w = u;
        u = v;
        v = w;
    }
    for (sl_off p = a->begin[u]; p < a->begin[u + 1]; p++) {
        const sl_int *f = a->m->faces + 3 * (size_t)a->face[p];
        if (f[0] == v || f[1] == v || f[2] == v) {
            if (found < most) {
                faces[found] = a->face[p];
            }
            found++;
        }
    }
    return found;
}

bool incidence_are_distinct(incidence *around, const sl_int *vertices, sl_int count) {
    sl_int marked = 0;
    bool ok = count >= 0;
    for (; ok && marked < count; marked++) {
        sl_int v = vertices[marked];
        if (v < 0 || v >= around->m->n_vertices || around->place[v] >= 0) {
            ok = false;
            break;
        }
        around->place[v] = marked;
    }
    for (sl_int k = 0; k < marked; k++) {
        around->place[vertices[k]] = -1;
    }
    return ok;
}

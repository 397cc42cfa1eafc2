/* edge_curve.c: curves along the edges of a mesh, through given vertices */
#include "edge_curve.h"

#include <math.h>
#include <string.h>

#include "surface_search.h"

void edge_curve_free(edge_curve *c) {
    free(c->vertices.at);
    free(c->ends.at);
    memset(c, 0, sizeof *c);
}

/* Adds the edges from a to b, last one first. */
static bool add_path(edge_curve *c, surface_search *along, sl_int a, sl_int b, bool *is_joined) {
    *is_joined = surface_search_edge(along, a, b) >= 0;
    if (*is_joined) {
        return int_list_add(&c->ends, a) && int_list_add(&c->ends, b);
    }
    bool ok = surface_search_run(along, &a, 1, INFINITY);
    *is_joined = ok && isfinite(along->length[b]);
    while (ok && *is_joined && b != a) {
        const sl_int before = (sl_int)along->parent[b];
        ok = int_list_add(&c->ends, before) && int_list_add(&c->ends, b);
        b = before;
    }
    return ok;
}

/* Lists the vertices of the edges, and the one at which a curve without edges is. */
static bool list_vertices(edge_curve *c, sl_int n, sl_int only) {
    unsigned char *seen = (unsigned char *)calloc((size_t)n + 1, 1);
    bool ok = seen != NULL;
    for (size_t k = 0; k < c->vertices.count && ok; k++) {
        seen[c->vertices.at[k]] = 1;
    }
    for (size_t k = 0; k <= c->ends.count && ok; k++) {
        const sl_int v = k < c->ends.count ? c->ends.at[k] : only;
        ok = seen[v] || int_list_add(&c->vertices, v);
        seen[v] = 1;
    }
    free(seen);
    return ok;
}

bool edge_curve_add(edge_curve *c, const mesh *m, const sl_int *through, sl_int count,
                    sl_int *gap) {
    incidence inc;
    surface_search *along = NULL; /* through vertices only: along edges */
    *gap = -1;
    bool ok = incidence_create(&inc, m);
    ok = ok && surface_search_create(&along, &inc, 0);
    for (sl_int k = 0; k + 1 < count && ok; k++) {
        bool is_joined = true;
        ok = through[k] == through[k + 1] ||
             add_path(c, along, through[k], through[k + 1], &is_joined);
        if (ok && !is_joined) {
            *gap = k;
            ok = false;
        }
    }
    ok = ok && (count == 0 || list_vertices(c, m->n_vertices, through[0]));
    surface_search_free(along);
    incidence_free(&inc);
    return ok;
}

void edge_curve_lengths(double *length, sl_int *place, const edge_curve *c, const mesh *m) {
    for (size_t k = 0; k < c->vertices.count; k++) {
        place[c->vertices.at[k]] = (sl_int)k;
        length[k] = 0;
    }
    for (size_t k = 0; k < c->ends.count; k += 2) {
        const double *a = m->xyz + 3 * (size_t)c->ends.at[k];
        const double *b = m->xyz + 3 * (size_t)c->ends.at[k + 1];
        const double half = hypot(hypot(a[0] - b[0], a[1] - b[1]), a[2] - b[2]) / 2;
        length[place[c->ends.at[k]]] += half;
        length[place[c->ends.at[k + 1]]] += half;
    }
}

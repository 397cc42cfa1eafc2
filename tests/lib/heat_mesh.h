/* heat_mesh.h: a mesh with its solver for the heat method, and distances indexed by vertex */
#ifndef SL_TEST_HEAT_MESH_H
#define SL_TEST_HEAT_MESH_H

#include "surfaces.h"

#include "tools/geometry/heat_distance.h"

static inline double euclidean_distance(const double *a, const double *b) {
    return hypot(hypot(a[0] - b[0], a[1] - b[1]), a[2] - b[2]);
}

/* A mesh, which it owns, and its solver; t = times * (mean edge length)^2. */
typedef struct heat_mesh_t {
    mesh m;
    heat_solver s;
} heat_mesh_t;

static inline void heat_mesh_make(heat_mesh_t *y, mesh m, double times) {
    y->m = m;
    double h = mesh_mean_edge_length(&y->m);
    SL_CHECK(heat_solver_create(&y->s, &y->m, times * h * h, NULL));
}

static inline void heat_mesh_free(heat_mesh_t *y) {
    assert_scratch_is_clean(&y->s.inc);
    heat_solver_free(&y->s);
    mesh_free(&y->m);
}

/* Distances of all vertices in the order of their numbers; NaN where the solver returns none. */
static inline double *distance_by_vertex(heat_mesh_t *y, const sl_int *sources, sl_int count,
                                         const heat_options *reach) {
    heat_field f;
    double *d = test_reals((size_t)y->m.n_vertices);
    for (sl_int v = 0; v < y->m.n_vertices; v++) {
        d[v] = NAN;
    }
    SL_CHECK(heat_distance(&f, &y->s, sources, count, reach));
    for (sl_int k = 0; k < f.n; k++) {
        assert_true(isnan(d[f.vertices[k]]) && f.distance[k] >= 0);
        d[f.vertices[k]] = f.distance[k];
    }
    heat_field_free(&f);
    return d;
}

#endif

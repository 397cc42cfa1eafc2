/* heat_subject.h: a mesh with its factors for the heat method, and distances by vertex */
#ifndef SL_TEST_HEAT_SUBJECT_H
#define SL_TEST_HEAT_SUBJECT_H

#include "bent_grids.h"

#include "../tools/heat_distance.h"

static inline double in_space(const double *a, const double *b) {
    return hypot(hypot(a[0] - b[0], a[1] - b[1]), a[2] - b[2]);
}

/* A solver over a mesh that it takes over; t = times the squared mean edge. */
typedef struct subject_t {
    mesh m;
    heat_solver s;
} subject_t;

static inline void subject_make(subject_t *y, mesh m, double times) {
    y->m = m;
    double h = mesh_mean_edge_length(&y->m);
    SL_CHECK(heat_solver_create(&y->s, &y->m, times * h * h));
}

static inline void subject_free(subject_t *y) {
    scratch_is_clean(&y->s.around);
    heat_solver_free(&y->s);
    mesh_free(&y->m);
}

/* Distances of all vertices by number, NaN where there is none. */
static inline double *by_vertex(subject_t *y, const sl_int *sources, sl_int count,
                                const heat_reach *reach) {
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

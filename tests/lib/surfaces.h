/* surfaces.h: meshes with known distances, angles and layouts; the Laplacian factor of a mesh */
#ifndef SL_TEST_SURFACES_H
#define SL_TEST_SURFACES_H

#include "test.h"

#include "tools/mesh/adjacency.h"
#include "tools/mesh/submesh.h"
#include "tools/mesh/grid.h"
#include "tools/geometry/laplacian.h"
#include "tools/mesh/mesh.h"
#include "tools/geometry/patch_solver.h"

/* A jittered grid on [0, 1] x [0, 1]. */
static inline mesh flat_grid(sl_int side, double jitter) {
    mesh m;
    assert_true(mesh_grid(&m, side, side, jitter, 5));
    return m;
}

/* A grid rolled onto a cylinder by half a turn: a developable surface. The chords of the edges are
 * shorter than the arcs of the cylinder; the mesh itself is flat only if its vertices lie on
 * straight lines along the axis, so there is no jitter. */
static inline mesh rolled_grid(sl_int side) {
    mesh m = flat_grid(side, 0);
    for (sl_int v = 0; v < m.n_vertices; v++) {
        double *x = m.xyz + 3 * (size_t)v, angle = 3.0 * x[0];
        x[0] = sin(angle);
        x[2] = cos(angle);
    }
    return m;
}

/* A grid of width 2 half in a plane tangent to the unit sphere, projected from the center onto the
 * sphere. */
static inline mesh sphere_grid(sl_int side, double half) {
    mesh m = flat_grid(side, 0);
    for (sl_int v = 0; v < m.n_vertices; v++) {
        double *x = m.xyz + 3 * (size_t)v, u = half * (2 * x[0] - 1), w = half * (2 * x[1] - 1);
        double r = sqrt(1 + u * u + w * w);
        x[0] = u / r;
        x[1] = w / r;
        x[2] = 1 / r;
    }
    return m;
}

/* A torus of a x b squares, each split into two triangles: closed, genus 1. */
static inline mesh torus_grid(sl_int a, sl_int b) {
    mesh m = {a * b, 2 * a * b, NULL, NULL};
    m.xyz = (double *)malloc(3 * (size_t)m.n_vertices * sizeof(double));
    m.faces = (sl_int *)malloc(3 * (size_t)m.n_faces * sizeof(sl_int));
    assert_true(m.xyz != NULL && m.faces != NULL);
    for (sl_int i = 0; i < a; i++) {
        for (sl_int j = 0; j < b; j++) {
            double u = 6.283185307179586 * i / a, w = 6.283185307179586 * j / b;
            double *x = m.xyz + 3 * (size_t)(i * b + j);
            sl_int *f = m.faces + 6 * (size_t)(i * b + j);
            sl_int here = i * b + j, right = (i + 1) % a * b + j;
            sl_int up = i * b + (j + 1) % b, across = (i + 1) % a * b + (j + 1) % b;
            const sl_int corners[6] = {here, right, across, here, across, up};
            x[0] = (2 + cos(w)) * cos(u);
            x[1] = (2 + cos(w)) * sin(u);
            x[2] = sin(w);
            memcpy(f, corners, sizeof corners);
        }
    }
    return m;
}

/* A mesh with the factor of its Laplacian and the incidence that its patches need. */
typedef struct mesh_factor_t {
    mesh m;
    incidence inc;
    sl_matrix *L;
    sl_symbolic *S;
    sl_factor *F;
} mesh_factor_t;

static inline void mesh_factor_make(mesh_factor_t *w, mesh m) {
    sl_options opt = options_none();
    memset(w, 0, sizeof *w);
    w->m = m;
    opt.pivots = SL_PIVOTS_SKIP_NULL;
    opt.consistency_tolerance = PATCH_SOLVER_CONSISTENCY;
    assert_true(incidence_create(&w->inc, &w->m));
    assert_true(laplacian_cotangent(&w->L, &w->m));
    const sl_csc A = sl_matrix_view(w->L);
    SL_CHECK(sl_symbolic_create(&w->S, &A, NULL, NULL));
    SL_CHECK(sl_factor_create(&w->F, w->S, &A, &opt, NULL));
}

/* The scratch arrays of the incidence are back in their initial state. */
static inline void assert_scratch_is_clean(const incidence *a) {
    for (sl_int v = 0; v < a->m->n_vertices; v++) {
        assert_int_equal(a->local_index[v], -1);
    }
    for (sl_int f = 0; f < a->m->n_faces; f++) {
        assert_int_equal(a->face_mark[f], 0);
    }
}

static inline void mesh_factor_free(mesh_factor_t *w) {
    assert_scratch_is_clean(&w->inc);
    sl_factor_free(w->F);
    sl_symbolic_free(w->S);
    sl_matrix_free(w->L);
    incidence_free(&w->inc);
    mesh_free(&w->m);
}

/* The faces between the `count` vertices nearest to start by edges. */
static inline submesh grown_patch(mesh_factor_t *w, sl_int start, sl_int count) {
    const sl_int n = w->m.n_vertices;
    sl_int *near = test_ints((size_t)n), *vertices = test_ints((size_t)n + 3), n_vertices = 0;
    sl_int *faces = test_ints((size_t)w->m.n_faces), n_faces = 0;
    unsigned char *seen = calloc((size_t)n + 1, 1);
    adjacency graph;
    submesh p;
    assert_true(adjacency_from_mesh(&graph, &w->m));
    count = adjacency_bfs(near, count < n ? count : n, &graph, start, seen);
    for (sl_int k = 0; k < count; k++) {
        seen[near[k]] = 1;
    }
    for (sl_int f = 0; f < w->m.n_faces; f++) {
        const sl_int *v = w->m.faces + 3 * f;
        if (seen[v[0]] && seen[v[1]] && seen[v[2]]) {
            faces[n_faces++] = f;
            for (int c = 0; c < 3; c++) {
                vertices[n_vertices] = v[c];
                n_vertices += seen[v[c]] == 1;
                seen[v[c]] = 2; /* listed */
            }
        }
    }
    assert_true(submesh_from_faces(&p, &w->inc, vertices, n_vertices, faces, n_faces));
    adjacency_free(&graph);
    free(seen);
    free(faces);
    free(vertices);
    free(near);
    return p;
}

/* Largest difference between two columns of n entries after the mean difference is subtracted. */
static inline double largest_difference(const double *a, const double *b, sl_int n) {
    double mean = 0, worst = 0;
    for (sl_int k = 0; k < n; k++) {
        mean += (a[k] - b[k]) / n;
    }
    for (sl_int k = 0; k < n; k++) {
        worst = fmax(worst, fabs(a[k] - b[k] - mean));
    }
    return worst;
}

#endif

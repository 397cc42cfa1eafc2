/* bad_meshes.h: meshes like those of CAD programs: needle fans, faces without area, double faces */
#ifndef SL_TEST_BAD_MESHES_H
#define SL_TEST_BAD_MESHES_H

#include "test.h"

#include "tools/mesh/mesh.h"

static inline mesh bad_mesh_allocate(sl_int n_vertices, sl_int n_faces) {
    mesh m = {n_vertices, n_faces, NULL, NULL};
    m.xyz = (double *)calloc(3 * (size_t)n_vertices + 1, sizeof(double));
    m.faces = (sl_int *)calloc(3 * (size_t)n_faces + 1, sizeof(sl_int));
    assert_true(m.xyz != NULL && m.faces != NULL);
    return m;
}

static inline void bad_mesh_face(mesh *m, sl_int face, sl_int a, sl_int b, sl_int c) {
    m->faces[3 * face] = a;
    m->faces[3 * face + 1] = b;
    m->faces[3 * face + 2] = c;
}

/* An outline of n points, rounded with points that are dense at four corners, extruded along z:
 * sides in `layers` layers of right triangles, each cap a fan from its first vertex. The faces of
 * the fans are needles, with angles down to about 1 / n^2, and so are the sides if `layers` is
 * small. Closed: n (layers + 1) vertices. */
static inline mesh extruded_outline(sl_int n, sl_int layers, double height) {
    mesh m = bad_mesh_allocate(n * (layers + 1), 2 * n * layers + 2 * (n - 2));
    sl_int used = 0;
    for (sl_int l = 0; l <= layers; l++) {
        for (sl_int k = 0; k < n; k++) {
            double *x = m.xyz + 3 * (l * n + k), angle = 6.283185307179586 * (double)k / (double)n;
            double c = cos(angle), s = sin(angle); /* a superellipse: flat sides, round corners */
            x[0] = copysign(pow(fabs(c), 0.3), c);
            x[1] = 0.6 * copysign(pow(fabs(s), 0.3), s);
            x[2] = height * (double)l / (double)layers;
        }
    }
    for (sl_int l = 0; l < layers; l++) {
        for (sl_int k = 0; k < n; k++) {
            sl_int next = (k + 1) % n, low = l * n, high = low + n;
            bad_mesh_face(&m, used++, low + k, low + next, high + next);
            bad_mesh_face(&m, used++, low + k, high + next, high + k);
        }
    }
    for (sl_int k = 1; k + 1 < n; k++) {
        bad_mesh_face(&m, used++, 0, k + 1, k);
        bad_mesh_face(&m, used++, layers * n, layers * n + k, layers * n + k + 1);
    }
    assert_int_equal(used, m.n_faces);
    return m;
}

/* A copy of m with `count` more faces, each from the faces of m in steps: duplicated, or with the
 * opposite orientation. Frees m. */
static inline mesh with_double_faces(mesh m, sl_int count, bool opposed) {
    mesh out = bad_mesh_allocate(m.n_vertices, m.n_faces + count);
    memcpy(out.xyz, m.xyz, 3 * (size_t)m.n_vertices * sizeof(double));
    memcpy(out.faces, m.faces, 3 * (size_t)m.n_faces * sizeof(sl_int));
    for (sl_int k = 0; k < count; k++) {
        const sl_int *f = m.faces + 3 * (k * (m.n_faces / count));
        bad_mesh_face(&out, m.n_faces + k, f[0], f[opposed ? 2 : 1], f[opposed ? 1 : 2]);
    }
    mesh_free(&m);
    return out;
}

/* A copy of m in which `count` edges from one face to the next are split at their middle in one of
 * the two faces only; a face without area closes the gap, as CAD programs do at T-junctions. Frees
 * m. */
static inline mesh with_flat_faces(mesh m, sl_int count) {
    mesh out = bad_mesh_allocate(m.n_vertices + count, m.n_faces + 2 * count);
    memcpy(out.xyz, m.xyz, 3 * (size_t)m.n_vertices * sizeof(double));
    memcpy(out.faces, m.faces, 3 * (size_t)m.n_faces * sizeof(sl_int));
    for (sl_int k = 0; k < count; k++) {
        sl_int at = k * (m.n_faces / count), v = m.n_vertices + k;
        const sl_int a = m.faces[3 * at], b = m.faces[3 * at + 1], c = m.faces[3 * at + 2];
        for (int d = 0; d < 3; d++) {
            out.xyz[3 * v + d] = 0.5 * (m.xyz[3 * a + d] + m.xyz[3 * b + d]);
        }
        bad_mesh_face(&out, at, a, v, c);
        bad_mesh_face(&out, m.n_faces + 2 * k, v, b, c);
        bad_mesh_face(&out, m.n_faces + 2 * k + 1, a, b, v); /* no area */
    }
    mesh_free(&m);
    return out;
}

#endif

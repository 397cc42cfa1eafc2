/* laplacian.c: Laplacians and lumped masses of a triangle mesh, and the systems M + t L */
#include "laplacian.h"

#include <math.h>
#include <stdlib.h>

#include "planar_triangle.h"
#include "tools/adapters/sparse_local_mesh.h"
#include "tools/mesh/adjacency.h"
#include "tools/matrix/triplets.h"

#define AREA_MAX 1e290 /* the sum of 2^31 such areas is still finite */
#define TIME_MAX 1e200 /* times a weight, plus a mass, is still finite */

laplacian_face laplacian_of_face(const mesh *m, const sl_int *face) {
    const sl_mesh surface = {m->n_vertices, m->n_faces, m->xyz, 0, 0, m->faces, 0};
    const laplacian_face none = {0, {0, 0, 0}};
    laplacian_face result;
    result.area = sl_mesh_measure(result.weight, &surface, face);
    return result.area <= AREA_MAX ? result : none;
}

/* Half the cotangent at the corner opposite to an edge, from the lengths of the edges. */
laplacian_face laplacian_of_lengths(const double lengths[3]) {
    laplacian_face result = {planar_area_of_lengths(lengths), {0, 0, 0}};
    for (int k = 0; k < 3 && result.area > 0; k++) {
        double a = lengths[k], b = lengths[(k + 1) % 3], c = lengths[(k + 2) % 3];
        double long_side = fmax(b, c), short_side = fmin(b, c);
        double twice = (long_side - a) * (long_side + a) + short_side * short_side;
        result.weight[k] = 0.125 * (twice / result.area);
    }
    return result;
}

/* The f-th face of m, by its lengths unless these are NULL. */
static laplacian_face face_of(const mesh *m, const double *lengths, size_t f, double share) {
    laplacian_face measure = lengths != NULL ? laplacian_of_lengths(lengths + 3 * f)
                                             : laplacian_of_face(m, m->faces + 3 * f);
    measure.area *= share;
    for (int k = 0; k < 3; k++) {
        measure.weight[k] *= share;
    }
    return measure;
}

void laplacian_mass_of(double *mass, const mesh *m, const double *lengths, double share) {
    for (sl_int v = 0; v < m->n_vertices; v++) {
        mass[v] = 0;
    }
    for (size_t f = 0; f < (size_t)m->n_faces; f++) {
        double third = face_of(m, lengths, f, share).area / 3;
        for (int k = 0; k < 3; k++) {
            mass[m->faces[3 * f + (size_t)k]] += third;
        }
    }
    for (sl_int v = 0; v < m->n_vertices; v++) {
        mass[v] = mass[v] > 0 ? mass[v] : 1;
    }
}

void laplacian_mass(double *mass, const mesh *m) {
    laplacian_mass_of(mass, m, NULL, 1);
}

/* Assembles diagonal + t L. diagonal (n_vertices) is overwritten. */
static bool assemble(sl_matrix **out, const mesh *m, const double *lengths, double share,
                     double *diagonal, double t) {
    triplets list = {0, 0, NULL, NULL, NULL};
    bool ok = triplets_reserve(&list, (size_t)m->n_vertices + 3 * (size_t)m->n_faces);
    for (size_t f = 0; f < (size_t)m->n_faces && ok; f++) {
        const sl_int *face = m->faces + 3 * f;
        laplacian_face measure = face_of(m, lengths, f, share);
        for (int k = 0; k < 3 && ok; k++) {
            sl_int u = face[(k + 1) % 3];
            sl_int v = face[(k + 2) % 3];
            double weight = t * measure.weight[k];
            if (u == v) { /* the edge contributes nothing; its entry keeps the pattern */
                weight = 0;
            }
            diagonal[u] += weight;
            diagonal[v] += weight;
            ok = triplets_add(&list, u > v ? u : v, u > v ? v : u, -weight);
        }
    }
    for (sl_int v = 0; v < m->n_vertices && ok; v++) {
        ok = triplets_add(&list, v, v, diagonal[v]);
    }
    if (!ok) {
        triplets_free(&list);
        return false;
    }
    return triplets_finish(out, m->n_vertices, m->n_vertices, &list, true) == SL_OK;
}

static bool assemble_system(sl_matrix **out, const mesh *m, const double *lengths, double share,
                            double t, bool with_mass) {
    *out = NULL;
    if (!mesh_faces_are_in_range(m)) {
        return false;
    }
    double *diagonal = (double *)calloc((size_t)m->n_vertices + 1, sizeof *diagonal);
    if (diagonal == NULL) {
        return false;
    }
    if (with_mass) {
        laplacian_mass_of(diagonal, m, lengths, share);
    }
    bool ok = assemble(out, m, lengths, share, diagonal, t);
    free(diagonal);
    return ok;
}

bool laplacian_cotangent_of(sl_matrix **out, const mesh *m, const double *lengths, double share) {
    return assemble_system(out, m, lengths, share, 1.0, false);
}

bool laplacian_cotangent(sl_matrix **out, const mesh *m) {
    return laplacian_cotangent_of(out, m, NULL, 1);
}

bool laplacian_system_of(sl_matrix **out, const mesh *m, const double *lengths, double share,
                         double t) {
    if (!(t >= 0 && t <= TIME_MAX)) {
        *out = NULL;
        return false;
    }
    return assemble_system(out, m, lengths, share, t, true);
}

bool laplacian_system(sl_matrix **out, const mesh *m, double t) {
    return laplacian_system_of(out, m, NULL, 1, t);
}

bool laplacian_uniform(sl_matrix **out, const mesh *m, double shift) {
    adjacency a;
    *out = NULL;
    if (!adjacency_from_mesh(&a, m)) {
        return false;
    }
    triplets list = {0, 0, NULL, NULL, NULL};
    bool ok = triplets_reserve(&list, (size_t)a.n + (size_t)(a.begin[a.n] / 2));
    for (sl_int v = 0; v < a.n && ok; v++) {
        ok = triplets_add(&list, v, v, (double)(a.begin[v + 1] - a.begin[v]) + shift);
        for (sl_off p = a.begin[v]; p < a.begin[v + 1] && ok; p++) {
            ok = a.neighbor[p] < v || triplets_add(&list, a.neighbor[p], v, -1.0);
        }
    }
    sl_int n = a.n;
    adjacency_free(&a);
    if (!ok) {
        triplets_free(&list);
        return false;
    }
    return triplets_finish(out, n, n, &list, true) == SL_OK;
}

double mesh_mean_edge_length(const mesh *m) {
    adjacency a;
    if (!adjacency_from_mesh(&a, m)) {
        return NAN;
    }
    double sum = 0;
    for (sl_int v = 0; v < a.n; v++) {
        for (sl_off p = a.begin[v]; p < a.begin[v + 1]; p++) {
            const double *x = m->xyz + 3 * (size_t)v;
            const double *y = m->xyz + 3 * (size_t)a.neighbor[p];
            sum += hypot(hypot(x[0] - y[0], x[1] - y[1]), x[2] - y[2]);
        }
    }
    double mean = a.begin[a.n] > 0 ? sum / (double)a.begin[a.n] : 0;
    adjacency_free(&a);
    return mean;
}

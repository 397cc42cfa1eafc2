/* arap_surface.c: as-rigid-as-possible deformations of a surface in space: rotations and forces */
#include "arap_surface.h"

#include <stdlib.h>
#include <string.h>

#include "laplacian.h"
#include "rotation_fit.h"

static const double identity[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1};

void arap_surface_free(arap_surface *a) {
    free(a->weights);
    free(a->rotations);
    memset(a, 0, sizeof *a);
}

bool arap_surface_create(arap_surface *out, const mesh *m) {
    size_t n = (size_t)m->n_vertices, nf = (size_t)m->n_faces;
    memset(out, 0, sizeof *out);
    out->m = m;
    out->weights = (double *)malloc((3 * nf + 1) * sizeof(double));
    out->rotations = (double *)malloc((9 * n + 1) * sizeof(double));
    if (out->weights == NULL || out->rotations == NULL) {
        arap_surface_free(out);
        return false;
    }
    for (size_t f = 0; f < nf; f++) {
        laplacian_face measure = laplacian_of_face(m, m->faces + 3 * f);
        memcpy(out->weights + 3 * f, measure.weight, sizeof measure.weight);
    }
    for (size_t v = 0; v < n; v++) {
        memcpy(out->rotations + 9 * v, identity, sizeof identity);
    }
    return true;
}

/* x = the vector at rest of the edge opposite to corner k of a face, from its vertex `from` to its
 * vertex `to`. */
static void edge_at_rest(double x[3], size_t *from, size_t *to, const mesh *m, size_t f, size_t k) {
    const sl_int *face = m->faces + 3 * f;
    *from = (size_t)face[(k + 1) % 3];
    *to = (size_t)face[(k + 2) % 3];
    for (size_t d = 0; d < 3; d++) {
        x[d] = m->xyz[3 * *from + d] - m->xyz[3 * *to + d];
    }
}

/* Adds sum w y x' of the edges of face f to S; returns sum w (|x|^2 + |y|^2). */
static double add_face(double S[9], const arap_surface *a, const double *Y, size_t f) {
    size_t n = (size_t)a->m->n_vertices;
    double sum = 0;
    for (size_t k = 0; k < 3; k++) {
        double x[3], y[3], w = a->weights[3 * f + k];
        size_t from, to;
        edge_at_rest(x, &from, &to, a->m, f, k);
        for (size_t d = 0; d < 3; d++) {
            y[d] = Y[d * n + from] - Y[d * n + to];
            sum += w * (x[d] * x[d] + y[d] * y[d]);
        }
        for (size_t d = 0; d < 9; d++) {
            S[d] += w * y[d % 3] * x[d / 3];
        }
    }
    return sum;
}

double arap_surface_rotations(arap_surface *a, const double *Y) {
    size_t n = (size_t)a->m->n_vertices, nf = (size_t)a->m->n_faces;
    double energy = 0;
    memset(a->rotations, 0, 9 * n * sizeof *a->rotations);
    for (size_t f = 0; f < nf; f++) {
        double S[9] = {0};
        energy += add_face(S, a, Y, f);
        for (size_t c = 0; c < 3; c++) {
            double *sum = a->rotations + 9 * (size_t)a->m->faces[3 * f + c];
            for (size_t d = 0; d < 9; d++) {
                sum[d] += S[d];
            }
        }
    }
    for (size_t v = 0; v < n; v++) {
        energy -= 2.0 / 3 * rotation_fit(a->rotations + 9 * v, a->rotations + 9 * v);
    }
    return energy;
}

void arap_surface_forces(const arap_surface *a, double *B) {
    size_t n = (size_t)a->m->n_vertices, nf = (size_t)a->m->n_faces;
    memset(B, 0, 3 * n * sizeof *B);
    for (size_t f = 0; f < nf; f++) {
        const sl_int *face = a->m->faces + 3 * f;
        double R[9];
        for (size_t d = 0; d < 9; d++) {
            R[d] = (a->rotations[9 * (size_t)face[0] + d] + a->rotations[9 * (size_t)face[1] + d] +
                    a->rotations[9 * (size_t)face[2] + d]) /
                   3;
        }
        for (size_t k = 0; k < 3; k++) {
            double x[3], w = a->weights[3 * f + k];
            size_t from, to;
            edge_at_rest(x, &from, &to, a->m, f, k);
            for (size_t d = 0; d < 3; d++) {
                double force = w * (R[d] * x[0] + R[d + 3] * x[1] + R[d + 6] * x[2]);
                B[d * n + from] += force;
                B[d * n + to] -= force;
            }
        }
    }
}

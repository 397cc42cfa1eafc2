/* sparse_local_mesh.h: mass and stiffness matrix of a triangle mesh, products of matrices
 *
 *     #include "sparse_local.h"
 *     #include "sparse_local_mesh.h"                     C99 or C++, no other file, no pack
 *
 *     sl_mesh mesh = {n_vertices, n_faces, xyz, 0, 0, faces, 0};
 *     status = sl_mesh_matrix(&A, &mesh, 1, t, NULL, &stats);    M + t L
 *
 * Temporary memory is from malloc. Errors have a text through stats only: sl_error_text(text,
 * sizeof text, status, &stats). */
#ifndef SPARSE_LOCAL_MESH_H
#define SPARSE_LOCAL_MESH_H

#include <float.h>
#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

/** A mesh in the caller's arrays. Strides are in bytes; 0: three numbers, without a gap. */
typedef struct sl_mesh {
    sl_int n_vertices;
    sl_int n_faces;
    const void *positions; /* x, y, z of each vertex, doubles or floats */
    size_t position_stride;
    int positions_are_float;
    const sl_int *faces; /* three vertices of each face */
    size_t face_stride;
} sl_mesh;

static inline sl_status sl_mesh_refuse(sl_stats *stats, sl_status status, const char *what,
                                       sl_int row) {
    if (stats != NULL) {
        const sl_error error = {row, -1, -1, 0, what};
        stats->error = error;
    }
    return status;
}

/* count + 1 elements; NULL if the bytes overflow. */
static inline void *sl_mesh_array(sl_off count, size_t size) {
    return (uint64_t)count < SIZE_MAX / size ? calloc((size_t)count + 1, size) : NULL;
}

static inline void sl_mesh_position(double xyz[3], const sl_mesh *surface, sl_int vertex) {
    const size_t size = surface->positions_are_float ? sizeof(float) : sizeof(double);
    const size_t stride = surface->position_stride != 0 ? surface->position_stride : 3 * size;
    const char *from = (const char *)surface->positions + stride * (size_t)vertex;
    float narrow[3];
    if (surface->positions_are_float) {
        memcpy(narrow, from, sizeof narrow);
        for (int c = 0; c < 3; c++) {
            xyz[c] = (double)narrow[c];
        }
    } else {
        memcpy(xyz, from, 3 * sizeof *xyz);
    }
}

static inline void sl_mesh_face(sl_int face[3], const sl_mesh *surface, sl_int f) {
    const size_t stride = surface->face_stride != 0 ? surface->face_stride : 3 * sizeof *face;
    memcpy(face, (const char *)surface->faces + stride * (size_t)f, 3 * sizeof *face);
}

static inline double sl_mesh_dot(const double *a, const double *b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* The area of a face, and half the cotangent at each corner: 0 if the face is too flat to have one.
 * Edges are scaled to components of at most 1: their squares neither overflow nor underflow. */
static inline double sl_mesh_measure(double weights[3], const sl_mesh *surface,
                                     const sl_int face[3]) {
    double corner[3][3], edge[3][3], normal[3], scale = 0, longest = 0;
    for (int k = 0; k < 3; k++) {
        sl_mesh_position(corner[k], surface, face[k]);
        weights[k] = 0;
    }
    for (int k = 0; k < 3; k++) { /* edge k is opposite to corner k */
        for (int c = 0; c < 3; c++) {
            edge[k][c] = corner[(k + 2) % 3][c] - corner[(k + 1) % 3][c];
            scale = fmax(scale, fabs(edge[k][c]));
        }
    }
    if (scale == 0 || scale > DBL_MAX) {
        return scale;
    }
    for (int k = 0; k < 3; k++) {
        for (int c = 0; c < 3; c++) {
            edge[k][c] /= scale;
        }
        longest = fmax(longest, sl_mesh_dot(edge[k], edge[k]));
    }
    for (int c = 0; c < 3; c++) {
        const int d = (c + 1) % 3, e = (c + 2) % 3;
        normal[c] = edge[0][d] * edge[1][e] - edge[0][e] * edge[1][d];
    }
    const double twice_area = sqrt(sl_mesh_dot(normal, normal));
    for (int k = 0; k < 3 && twice_area > 1.5e-8 * longest; k++) { /* sqrt(DBL_EPSILON) */
        weights[k] = -0.5 * sl_mesh_dot(edge[(k + 1) % 3], edge[(k + 2) % 3]) / twice_area;
    }
    return 0.5 * twice_area * scale * scale;
}

static inline sl_status sl_mesh_check(const sl_mesh *surface, sl_stats *stats) {
    if (surface == NULL || surface->n_vertices < 0 || surface->n_faces < 0 ||
        (surface->n_vertices > 0 && surface->positions == NULL) ||
        (surface->n_faces > 0 && surface->faces == NULL)) {
        return sl_mesh_refuse(stats, SL_ERR_ARGUMENT, "mesh: an array is NULL or a count negative",
                              -1);
    }
    if (6 * (sl_off)surface->n_faces + surface->n_vertices > INT32_MAX) {
        return sl_mesh_refuse(stats, SL_ERR_TOO_LARGE, "mesh: 6 n_faces + n_vertices >= 2^31",
                              -1);
    }
    for (sl_int v = 0; v < surface->n_vertices; v++) {
        double xyz[3];
        sl_mesh_position(xyz, surface, v);
        if (!(fabs(xyz[0]) <= DBL_MAX && fabs(xyz[1]) <= DBL_MAX && fabs(xyz[2]) <= DBL_MAX)) {
            return sl_mesh_refuse(stats, SL_ERR_NOT_FINITE, "mesh: the position of a vertex", v);
        }
    }
    for (sl_int f = 0; f < surface->n_faces; f++) {
        sl_int face[3];
        sl_mesh_face(face, surface, f);
        for (int k = 0; k < 3; k++) {
            if (face[k] < 0 || face[k] >= surface->n_vertices) {
                return sl_mesh_refuse(
                    stats, SL_ERR_ARGUMENT,
                    "mesh: a face has a vertex outside 0..n_vertices-1; the row is the face", f);
            }
        }
    }
    return SL_OK;
}

/* The entries of m M + l L: six of each face in i, j, x, then the diagonal. */
static inline sl_status sl_mesh_entries(const sl_mesh *surface, double m, double l,
                                        sl_int *const ij[2], double *x, double *mass,
                                        sl_stats *stats) {
    const size_t n = (size_t)surface->n_vertices, off = 6 * (size_t)surface->n_faces;
    size_t count = 0;
    for (sl_int f = 0; f < surface->n_faces; f++) {
        sl_int face[3];
        double weights[3];
        sl_mesh_face(face, surface, f);
        const double area = sl_mesh_measure(weights, surface, face);
        if (!(area <= 1e290)) { /* the sum of 2^31 such areas is still finite */
            return sl_mesh_refuse(stats, SL_ERR_NOT_FINITE,
                                  "mesh: the area of a face overflows; the row is the face", f);
        }
        for (int k = 0; k < 3; k++) {
            const sl_int u = face[(k + 1) % 3], v = face[(k + 2) % 3];
            mass[face[k]] += area / 3;
            x[off + (size_t)u] += weights[k];
            x[off + (size_t)v] += weights[k];
            ij[0][count] = u, ij[1][count] = v, x[count++] = -l * weights[k];
            ij[0][count] = v, ij[1][count] = u, x[count++] = -l * weights[k];
        }
    }
    for (size_t v = 0; v < n; v++) {
        ij[0][off + v] = ij[1][off + v] = (sl_int)v;
        x[off + v] = l * x[off + v] + m * (mass[v] > 0 ? mass[v] : 1);
    }
    return SL_OK;
}

/** Creates m M + l L, with the lumped mass matrix M and the cotangent Laplacian L, which is
 *  positive semidefinite: M with m = 1, l = 0; L with 0, 1; heat after the time t with 1, t.
 *
 *  Each row of L sums to 0. Entries at edges opposite to obtuse angles may be positive. A face that
 *  is flat, or names a vertex twice, adds its area but no cotangents; its edges stay in L.
 *  A vertex without area has mass 1, so that M + t L is positive definite for t >= 0.
 *
 *  out    [out]  the matrix, n_vertices x n_vertices, both triangles; diagonal if l is 0. NULL on
 *                error.
 *  m, l   [in]   finite numbers.
 *  opt    [in]   allocator of the matrix.
 *  stats  [out]  error.row: the vertex or the face that is refused.
 *  Returns  SL_OK; SL_ERR_ARGUMENT: a NULL, a negative count, a vertex out of range;
 *           SL_ERR_NOT_FINITE; SL_ERR_TOO_LARGE: 6 n_faces + n_vertices above 2^31 - 1;
 *           SL_ERR_MEMORY.
 *  Cost     O(n_vertices + n_faces).
 */
static inline sl_status sl_mesh_matrix(sl_matrix **out, const sl_mesh *surface, double m, double l,
                                       const sl_options *opt, sl_stats *stats) {
    if (out == NULL || !(fabs(m) <= DBL_MAX && fabs(l) <= DBL_MAX)) {
        return sl_mesh_refuse(stats, SL_ERR_ARGUMENT, "out is NULL, or m or l not finite", -1);
    }
    *out = NULL;
    sl_status status = sl_mesh_check(surface, stats);
    if (status != SL_OK) {
        return status;
    }
    const sl_int n = surface->n_vertices;
    const sl_off off = 6 * (sl_off)surface->n_faces, count = off + n, skipped = l == 0 ? off : 0;
    sl_int *const ij[2] = {(sl_int *)sl_mesh_array(count, sizeof(sl_int)),
                           (sl_int *)sl_mesh_array(count, sizeof(sl_int))};
    double *x = (double *)sl_mesh_array(count, sizeof *x);
    double *mass = (double *)sl_mesh_array(n, sizeof *mass);
    if (ij[0] == NULL || ij[1] == NULL || x == NULL || mass == NULL) {
        status = sl_mesh_refuse(stats, SL_ERR_MEMORY, NULL, -1);
    } else {
        status = sl_mesh_entries(surface, m, l, ij, x, mass, stats);
    }
    if (status == SL_OK) {
        status = sl_matrix_from_triplets(out, n, n, count - skipped, ij[0] + skipped,
                                         ij[1] + skipped, x + skipped, opt, stats);
    }
    free(ij[0]);
    free(ij[1]);
    free(x);
    free(mass);
    return status;
}

static inline int sl_mesh_has_values(const sl_csc *A) {
    return A->n_cols == 0 || (A->p != NULL && (A->p[A->n_cols] == 0 || A->x != NULL));
}

/* The triplets of A diag(d) B, column by column; their number. With i = NULL they are counted.
 * place (rows of A) is all 0: above `begin`, the position of a row in this column, plus 1. */
static inline sl_off sl_mesh_triplets(const sl_csc *A, const double *d, const sl_csc *B,
                                      sl_off *place, sl_int *const ij[2], double *x) {
    sl_off count = 0;
    for (sl_int c = 0; c < B->n_cols; c++) {
        const sl_off begin = count;
        for (sl_int p = B->p[c]; p < B->p[c + 1]; p++) {
            const sl_int k = B->i[p];
            const double factor = d != NULL ? d[k] * B->x[p] : B->x[p];
            for (sl_int q = A->p[k]; q < A->p[k + 1]; q++) {
                const sl_int row = A->i[q];
                if (place[row] <= begin) {
                    place[row] = ++count;
                    if (ij != NULL) {
                        ij[0][count - 1] = row, ij[1][count - 1] = c;
                    }
                }
                if (ij != NULL) {
                    x[place[row] - 1] += A->x[q] * factor;
                }
            }
        }
    }
    return count;
}

/** Creates C = A diag(d) B, every entry of A and B where it is stored (SL_AS_STORED). L M^-1 L is
 *  the product of L, the reciprocals of M's diagonal, and L.
 *
 *  out    [out]  the matrix, rows of A x columns of B, rows ascending; NULL on error.
 *  A, B   [in]   with values; columns of A = rows of B. A triangle is not completed.
 *  d      [in]   as many numbers as A has columns; NULL: all are 1.
 *  opt    [in]   allocator of C.
 *  stats  [out]  error.row, error.column: a malformed entry.
 *  Returns  SL_OK; SL_ERR_ARGUMENT: a NULL, sizes that differ; SL_ERR_MALFORMED; SL_ERR_TOO_LARGE:
 *           2^31 or more entries of C; SL_ERR_MEMORY.
 *  Cost     O(multiplications + rows + columns).
 */
static inline sl_status sl_matrix_product(sl_matrix **out, const sl_csc *A, const double *d,
                                          const sl_csc *B, const sl_options *opt, sl_stats *stats) {
    if (out == NULL) {
        return sl_mesh_refuse(stats, SL_ERR_ARGUMENT, "out is NULL", -1);
    }
    *out = NULL;
    sl_status status = sl_csc_check(A, stats);
    if (status == SL_OK) {
        status = sl_csc_check(B, stats);
    }
    if (status != SL_OK) {
        return status;
    }
    if (A->n_cols != B->n_rows || !sl_mesh_has_values(A) || !sl_mesh_has_values(B)) {
        return sl_mesh_refuse(stats, SL_ERR_ARGUMENT,
                              "A and B: both need values, and A as many columns as B has rows", -1);
    }
    const size_t rows = (size_t)A->n_rows;
    sl_off count = 0, *place = (sl_off *)sl_mesh_array(A->n_rows, sizeof *place);
    sl_int *ij[2] = {NULL, NULL};
    double *x = NULL;
    if (place != NULL) {
        count = sl_mesh_triplets(A, d, B, place, NULL, NULL);
        memset(place, 0, rows * sizeof *place);
        if (count <= INT32_MAX) {
            ij[0] = (sl_int *)sl_mesh_array(count, sizeof **ij);
            ij[1] = (sl_int *)sl_mesh_array(count, sizeof **ij);
            x = (double *)sl_mesh_array(count, sizeof *x);
        }
    }
    if (count > INT32_MAX) {
        status = sl_mesh_refuse(stats, SL_ERR_TOO_LARGE, "product: 2^31 or more entries", -1);
    } else if (place == NULL || ij[0] == NULL || ij[1] == NULL || x == NULL) {
        status = sl_mesh_refuse(stats, SL_ERR_MEMORY, NULL, -1);
    } else {
        (void)sl_mesh_triplets(A, d, B, place, ij, x);
        status = sl_matrix_from_triplets(out, A->n_rows, B->n_cols, count, ij[0], ij[1], x, opt,
                                         stats);
    }
    free(place);
    free(ij[0]);
    free(ij[1]);
    free(x);
    return status;
}

#endif /* SPARSE_LOCAL_MESH_H */

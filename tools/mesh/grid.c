/* grid.c: synthetic problems of any size: grid and torus meshes, Laplacians of 2D and 3D grids */
#include "grid.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "tools/matrix/triplets.h"

/* SplitMix64, uniform in [-1, 1).
 * Steele, Lea, Flood: Fast splittable pseudorandom number generators, 2014. */
static double next_symmetric(uint64_t *state) {
    *state += 0x9e3779b97f4a7c15u;
    uint64_t z = *state;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    z ^= z >> 31;
    return (double)(z >> 11) * 0x1p-52 - 1.0;
}

static void place_vertices(double *xyz, sl_int nx, sl_int ny, double jitter, uint64_t seed) {
    sl_int longest = nx > ny ? nx : ny;
    double h = longest > 1 ? 1.0 / (double)(longest - 1) : 1.0;
    for (sl_int iy = 0; iy < ny; iy++) {
        for (sl_int ix = 0; ix < nx; ix++) {
            double moved_x = next_symmetric(&seed) * jitter;
            double moved_y = next_symmetric(&seed) * jitter;
            bool border = ix == 0 || iy == 0 || ix == nx - 1 || iy == ny - 1;
            *xyz++ = h * ((double)ix + (border ? 0 : moved_x));
            *xyz++ = h * ((double)iy + (border ? 0 : moved_y));
            *xyz++ = 0;
        }
    }
}

static void connect_squares(sl_int *faces, sl_int nx, sl_int ny) {
    for (sl_int iy = 0; iy + 1 < ny; iy++) {
        for (sl_int ix = 0; ix + 1 < nx; ix++) {
            sl_int a = ix + nx * iy;
            sl_int corners[6] = {a, a + 1, a + 1 + nx, a, a + 1 + nx, a + nx};
            memcpy(faces, corners, sizeof corners);
            faces += 6;
        }
    }
}

/* Allocates the arrays of a mesh. */
static bool allocate(mesh *out, int64_t vertices, int64_t faces) {
    memset(out, 0, sizeof *out);
    if (vertices > INT32_MAX || faces > INT32_MAX) {
        return false;
    }
    out->n_vertices = (sl_int)vertices;
    out->n_faces = (sl_int)faces;
    out->xyz = (double *)malloc((size_t)vertices * 3 * sizeof *out->xyz);
    out->faces = (sl_int *)malloc(((size_t)faces * 3 + 1) * sizeof *out->faces);
    if (out->xyz == NULL || out->faces == NULL) {
        mesh_free(out);
        return false;
    }
    return true;
}

bool mesh_grid(mesh *out, sl_int nx, sl_int ny, double jitter, uint64_t seed) {
    memset(out, 0, sizeof *out);
    if (nx < 1 || ny < 1 || !(jitter >= 0) || !isfinite(jitter) ||
        !allocate(out, (int64_t)nx * ny, 2 * (int64_t)(nx - 1) * (ny - 1))) {
        return false;
    }
    place_vertices(out->xyz, nx, ny, jitter, seed);
    connect_squares(out->faces, nx, ny);
    return true;
}

bool mesh_torus(mesh *out, sl_int nu, sl_int nv, double jitter, uint64_t seed) {
    const double turn = 2 * acos(-1.0), tube = 0.4;
    memset(out, 0, sizeof *out);
    if (nu < 3 || nv < 3 || !(jitter >= 0) || !isfinite(jitter) ||
        !allocate(out, (int64_t)nu * nv, 2 * (int64_t)nu * nv)) {
        return false;
    }
    double *xyz = out->xyz;
    sl_int *faces = out->faces;
    for (sl_int v = 0; v < nv; v++) {
        for (sl_int u = 0; u < nu; u++) {
            double a = turn * (u + jitter * next_symmetric(&seed)) / nu;
            double b = turn * (v + jitter * next_symmetric(&seed)) / nv;
            sl_int right = (u + 1) % nu, above = nu * ((v + 1) % nv), here = nu * v;
            sl_int corners[6] = {u + here, right + here,  right + above,
                                 u + here, right + above, u + above};
            *xyz++ = (1 + tube * cos(b)) * cos(a);
            *xyz++ = (1 + tube * cos(b)) * sin(a);
            *xyz++ = tube * sin(b);
            memcpy(faces, corners, sizeof corners);
            faces += 6;
        }
    }
    return true;
}

/* Each point adds its diagonal entry and its edge to the next point in each direction. */
static bool add_points(triplets *t, const sl_int size[3], double shift) {
    sl_int stride[3] = {1, size[0], size[0] * size[1]};
    sl_int row = 0;
    sl_int at[3];
    for (at[2] = 0; at[2] < size[2]; at[2]++) {
        for (at[1] = 0; at[1] < size[1]; at[1]++) {
            for (at[0] = 0; at[0] < size[0]; at[0]++, row++) {
                int degree = 0;
                for (int d = 0; d < 3; d++) {
                    bool next = at[d] + 1 < size[d];
                    degree += next + (at[d] > 0);
                    if (next && !triplets_add(t, row + stride[d], row, -1.0)) {
                        return false;
                    }
                }
                if (!triplets_add(t, row, row, degree + shift)) {
                    return false;
                }
            }
        }
    }
    return true;
}

bool grid_laplacian_3d(sl_matrix **out, sl_int nx, sl_int ny, sl_int nz, double shift) {
    const sl_int size[3] = {nx, ny, nz};
    *out = NULL;
    if (nx < 1 || ny < 1 || nz < 1 || (int64_t)nx * ny > INT32_MAX ||
        (int64_t)nx * ny * nz > INT32_MAX) {
        return false;
    }
    sl_int n = nx * ny * nz;
    triplets t = {0, 0, NULL, NULL, NULL};
    size_t entries = (size_t)n * (size_t)(1 + (nx > 1) + (ny > 1) + (nz > 1));
    if (!triplets_reserve(&t, entries) || !add_points(&t, size, shift)) {
        triplets_free(&t);
        return false;
    }
    return triplets_finish(out, n, n, &t, true) == SL_OK;
}

bool grid_laplacian_2d(sl_matrix **out, sl_int nx, sl_int ny, double shift) {
    return grid_laplacian_3d(out, nx, ny, 1, shift);
}

/* surface_generator.c: synthetic surfaces of any size, by name: grids, spheres, tori, a knot */
#include "surface_generator.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "edge_sides.h"
#include "grid.h"

static const double pi = 3.14159265358979323846;

enum { MAX_SUBDIVISIONS = 10 };

static void to_sphere(double *x) {
    double length = sqrt(x[0] * x[0] + x[1] * x[1] + x[2] * x[2]);
    for (int d = 0; d < 3; d++) {
        x[d] /= length;
    }
}

static bool icosahedron(mesh *m) {
    static const sl_int faces[60] = {0, 11, 5, 0, 5,  1,  0,  1,  7,  0,  7, 10, 0, 10, 11,
                                     1, 5,  9, 5, 11, 4,  11, 10, 2,  10, 7, 6,  7, 1,  8,
                                     3, 9,  4, 3, 4,  2,  3,  2,  6,  3,  6, 8,  3, 8,  9,
                                     4, 9,  5, 2, 4,  11, 6,  2,  10, 8,  6, 7,  9, 8,  1};
    const double g = 0.5 * (1 + sqrt(5.0));
    const double xyz[36] = {-1, g,  0,  1, g, 0,  -1, -g, 0,  1, -g, 0, 0,  -1, g,  0,  1, g,
                            0,  -1, -g, 0, 1, -g, g,  0,  -1, g, 0,  1, -g, 0,  -1, -g, 0, 1};
    m->n_vertices = 12;
    m->n_faces = 20;
    m->xyz = (double *)malloc(sizeof xyz);
    m->faces = (sl_int *)malloc(sizeof faces);
    if (m->xyz == NULL || m->faces == NULL) {
        return false;
    }
    memcpy(m->xyz, xyz, sizeof xyz);
    memcpy(m->faces, faces, sizeof faces);
    for (int v = 0; v < 12; v++) {
        to_sphere(m->xyz + 3 * v);
    }
    return true;
}

/* Adds the midpoint of each edge, projected to the sphere. middle[3 f + c] is the vertex on the
 * edge of face f from corner c to the next. The sides of an edge are found by sorting: no hashing
 * is needed, and the vertex numbers are the same on every machine. */
static bool add_midpoints(mesh *fine, sl_int *middle, const mesh *m) {
    size_t count = 3 * (size_t)m->n_faces, end;
    edge_side *sides = sorted_sides(m);
    if (sides == NULL) {
        return false;
    }
    for (size_t k = 0; k < count; k = end) {
        double *x = fine->xyz + 3 * (size_t)fine->n_vertices;
        for (size_t d = 0; d < 3; d++) {
            x[d] = m->xyz[3 * (size_t)sides[k].low + d] + m->xyz[3 * (size_t)sides[k].high + d];
        }
        to_sphere(x);
        end = end_of_edge(sides, k, count);
        for (size_t s = k; s < end; s++) {
            middle[side_after(sides[s].side)] = fine->n_vertices;
        }
        fine->n_vertices++;
    }
    free(sides);
    return true;
}

/* Splits each triangle into four. The surface is closed: it has 3 n_faces / 2 edges. */
static bool subdivide(mesh *m) {
    mesh fine;
    memset(&fine, 0, sizeof fine);
    size_t vertices = (size_t)m->n_vertices + 3 * (size_t)m->n_faces / 2;
    sl_int *middle = (sl_int *)malloc(3 * (size_t)m->n_faces * sizeof *middle);
    fine.xyz = (double *)malloc(3 * vertices * sizeof *fine.xyz);
    fine.faces = (sl_int *)malloc(12 * (size_t)m->n_faces * sizeof *fine.faces);
    fine.n_vertices = m->n_vertices;
    fine.n_faces = 4 * m->n_faces;
    bool ok = middle != NULL && fine.xyz != NULL && fine.faces != NULL;
    if (ok) {
        memcpy(fine.xyz, m->xyz, 3 * (size_t)m->n_vertices * sizeof *fine.xyz);
        ok = add_midpoints(&fine, middle, m);
    }
    for (size_t f = 0; ok && f < (size_t)m->n_faces; f++) {
        const sl_int *old = m->faces + 3 * f, *mid = middle + 3 * f;
        const sl_int four[12] = {old[0], mid[0], mid[2], old[1], mid[1], mid[0],
                                 old[2], mid[2], mid[1], mid[0], mid[1], mid[2]};
        memcpy(fine.faces + 12 * f, four, sizeof four);
    }
    free(middle);
    if (!ok) {
        mesh_free(&fine);
        return false;
    }
    mesh_free(m);
    *m = fine;
    return true;
}

static bool make_sphere(mesh *m, sl_int cuts) {
    bool ok = icosahedron(m);
    for (sl_int k = 0; ok && k < cuts; k++) {
        ok = subdivide(m);
    }
    return ok;
}

/* Bumps of several sizes, without any symmetry. */
static void add_bumps(mesh *m) {
    for (size_t v = 0; v < (size_t)m->n_vertices; v++) {
        double *x = m->xyz + 3 * v;
        double r = 1 + 0.22 * sin(2.3 * x[0] + 0.7) * cos(1.9 * x[1] - 0.4) +
                   0.13 * sin(4.1 * x[1] + 2.2 * x[2] + 1.1) +
                   0.07 * cos(7.3 * x[2] - 3.1 * x[0] + 0.3) +
                   0.03 * sin(11.7 * x[0] + 9.2 * x[1] - 5.5 * x[2]);
        x[0] *= 1.25 * r;
        x[1] *= r;
        x[2] *= 0.9 * r;
    }
}

/* The radius of the star in a direction: a sphere with five arms of different lengths. */
static double star_radius(const double x[3]) {
    static const double arms[5][5] = {/* unit direction, length, sharpness */
                                      {0.099, 0.990, 0.099, 1.5, 14},
                                      {0.962, 0.253, 0.101, 1.1, 16},
                                      {-0.913, 0.355, 0.203, 1.3, 18},
                                      {0.488, -0.781, 0.390, 1.0, 14},
                                      {-0.551, -0.827, -0.110, 0.8, 12}};
    double r = 0.6;
    for (int k = 0; k < 5; k++) {
        double cosine = arms[k][0] * x[0] + arms[k][1] * x[1] + arms[k][2] * x[2];
        r += arms[k][3] * exp(arms[k][4] * (cosine - 1));
    }
    return r;
}

static void grow_arms(mesh *m) {
    for (size_t v = 0; v < (size_t)m->n_vertices; v++) {
        double *x = m->xyz + 3 * v, r = star_radius(x);
        x[0] *= r;
        x[1] *= r;
        x[2] *= r;
    }
}

/* Adds area * centroid (up to a factor) and area of a face of the star to the sums of its corners;
 * sum: 4 numbers per vertex. */
static void add_face(double *sum, const mesh *m, const sl_int *f) {
    const double *a = m->xyz + 3 * (size_t)f[0], *b = m->xyz + 3 * (size_t)f[1],
                 *c = m->xyz + 3 * (size_t)f[2];
    double n[3], area;
    for (int d = 0; d < 3; d++) {
        int e = (d + 1) % 3, g = (d + 2) % 3;
        n[d] = (b[e] - a[e]) * (c[g] - a[g]) - (b[g] - a[g]) * (c[e] - a[e]);
    }
    area = sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
    for (int corner = 0; corner < 3; corner++) {
        double *to = sum + 4 * (size_t)f[corner];
        for (int d = 0; d < 3; d++) {
            to[d] += area * (a[d] + b[d] + c[d]);
        }
        to[3] += area;
    }
}

/* Moves the vertices on the sphere so that the faces of the star have similar areas: each vertex
 * moves to the area-weighted centroid of its faces, ROUNDS times. */
static bool equalize_areas(mesh *m) {
    enum { ROUNDS = 16 };
    size_t n = (size_t)m->n_vertices;
    double *sum = (double *)malloc(4 * n * sizeof *sum);
    for (int round = 0; sum != NULL && round < ROUNDS; round++) {
        memset(sum, 0, 4 * n * sizeof *sum);
        grow_arms(m);
        for (size_t f = 0; f < (size_t)m->n_faces; f++) {
            add_face(sum, m, m->faces + 3 * f);
        }
        for (size_t v = 0; v < n; v++) {
            memcpy(m->xyz + 3 * v, sum + 4 * v, 3 * sizeof *sum);
            to_sphere(m->xyz + 3 * v);
        }
    }
    bool ok = sum != NULL;
    free(sum);
    return ok;
}

static bool make_star(mesh *m, sl_int cuts) {
    bool ok = icosahedron(m);
    for (sl_int k = 0; ok && k < cuts; k++) {
        ok = subdivide(m) && equalize_areas(m);
    }
    if (ok) {
        grow_arms(m);
    }
    return ok;
}

static void point_of_knot(double out[3], double s) {
    out[0] = sin(s) + 2 * sin(2 * s);
    out[1] = -sin(3 * s);
    out[2] = cos(s) - 2 * cos(2 * s);
}

static void point_of_circle(double out[3], double s) {
    out[0] = cos(s);
    out[1] = 0;
    out[2] = -sin(s);
}

static void cross(double out[3], const double a[3], const double b[3]) {
    for (int d = 0; d < 3; d++) {
        out[d] = a[(d + 1) % 3] * b[(d + 2) % 3] - a[(d + 2) % 3] * b[(d + 1) % 3];
    }
}

/* Two unit vectors normal to the curve at s. The second is derived from the second derivative,
 * which does not vanish on either curve. */
static void frame(double side[3], double out[3], void (*point)(double *, double), double s) {
    const double h = 1e-4;
    double before[3], at[3], after[3], along[3];
    point(before, s - h);
    point(at, s);
    point(after, s + h);
    for (int d = 0; d < 3; d++) {
        along[d] = after[d] - before[d];
        out[d] = -(after[d] - 2 * at[d] + before[d]);
    }
    to_sphere(along);
    to_sphere(out);
    cross(side, out, along);
    to_sphere(side);
    cross(out, along, side);
}

static bool make_tube(mesh *m, sl_int w, sl_int h, double radius, void (*point)(double *, double)) {
    m->n_vertices = w * h;
    m->n_faces = 2 * w * h;
    m->xyz = (double *)malloc(3 * (size_t)m->n_vertices * sizeof *m->xyz);
    m->faces = (sl_int *)malloc(3 * (size_t)m->n_faces * sizeof *m->faces);
    if (m->xyz == NULL || m->faces == NULL) {
        return false;
    }
    double *x = m->xyz;
    sl_int *f = m->faces;
    for (sl_int i = 0; i < w; i++) {
        double s = 2 * pi * i / w, center[3], side[3], out[3];
        point(center, s);
        frame(side, out, point, s);
        for (sl_int j = 0; j < h; j++, x += 3, f += 6) {
            double t = 2 * pi * j / h;
            sl_int i1 = i + 1 < w ? i + 1 : 0, j1 = j + 1 < h ? j + 1 : 0;
            for (int d = 0; d < 3; d++) {
                x[d] = center[d] + radius * (cos(t) * out[d] + sin(t) * side[d]);
            }
            const sl_int square[6] = {i * h + j, i1 * h + j,  i1 * h + j1,
                                      i * h + j, i1 * h + j1, i * h + j1};
            memcpy(f, square, sizeof square);
        }
    }
    return true;
}

static bool make_hills(mesh *m, sl_int w, sl_int h) {
    if (!mesh_grid(m, w, h, 0.2, 1)) {
        return false;
    }
    for (size_t v = 0; v < (size_t)m->n_vertices; v++) {
        double *x = m->xyz + 3 * v;
        x[2] = 0.10 * sin(7 * x[0] + 1) * cos(6 * x[1]) + 0.05 * sin(13 * x[0] - 11 * x[1]) +
               0.02 * cos(31 * x[0] + 4) * sin(29 * x[1] + 1);
    }
    return true;
}

typedef enum kind { GRID, HILLS, SPHERE, BLOB, STAR, TORUS, KNOT, N_KINDS } kind;

static const char *const names[N_KINDS] = {
    "grid:", "hills:", "sphere:", "blob:", "star:", "torus:", "knot:"};

static kind kind_of(const char *text) {
    int k = 0;
    while (k < N_KINDS && strncmp(text, names[k], strlen(names[k])) != 0) {
        k++;
    }
    return (kind)k;
}

bool surface_is_specification(const char *text) {
    return kind_of(text) != N_KINDS;
}

static bool fail(char *message, size_t size, const char *text, const char *words) {
    if (message != NULL && size > 0) {
        (void)snprintf(message, size, "%s: %s", text, words);
    }
    return false;
}

static bool make(mesh *out, kind k, sl_int w, sl_int h) {
    switch (k) {
    case GRID:
        return mesh_grid(out, w, h, 0.2, 1);
    case HILLS:
        return make_hills(out, w, h);
    case SPHERE:
    case BLOB:
        if (!make_sphere(out, w)) {
            return false;
        }
        if (k == BLOB) {
            add_bumps(out);
        }
        return true;
    case STAR:
        return make_star(out, w);
    case TORUS:
        return make_tube(out, w, h, 0.35, point_of_circle);
    case KNOT:
        return make_tube(out, w, h, 0.5, point_of_knot);
    case N_KINDS:
        break;
    }
    return false;
}

bool surface_generate(mesh *out, const char *text, char *message, size_t message_size) {
    memset(out, 0, sizeof *out);
    kind k = kind_of(text);
    if (k == N_KINDS) {
        return fail(message, message_size, text, "no surface has this name");
    }
    const char *sizes = text + strlen(names[k]);
    bool one = k == SPHERE || k == BLOB || k == STAR;
    int w = 0, h = 0;
    char rest = 0;
    if (one ? sscanf(sizes, "%9d%c", &w, &rest) != 1
            : sscanf(sizes, "%9dx%9d%c", &w, &h, &rest) != 2) {
        return fail(message, message_size, text,
                    one ? "a number is needed after the colon, like 5"
                        : "two sizes are needed after the colon, like 100x100");
    }
    int fewest = one ? 0 : k == TORUS || k == KNOT ? 3 : 1;
    if (w < fewest || (one && w > MAX_SUBDIVISIONS) || (!one && h < fewest) ||
        (!one && 2 * (int64_t)w * h > INT32_MAX / 3)) {
        return fail(message, message_size, text, "a size is out of range");
    }
    if (!make(out, k, (sl_int)w, (sl_int)h)) {
        mesh_free(out);
        return fail(message, message_size, text, "out of memory");
    }
    return true;
}

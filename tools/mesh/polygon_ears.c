/* polygon_ears.c: divides polygons that are not convex into triangles, by ears */
#include "polygon_ears.h"

#include <math.h>
#include <stdlib.h>

/* Of the square of the area of a polygon: a triangle of the fan that is smaller is not seen as
 * turned over, nor is a corner with such a triangle seen as reflex. */
static const double rounding = 1e-12;

/* A polygon in the plane, and the ring of the corners that are left. */
typedef struct ring {
    double *x, *y; /* corners */
    sl_int *before, *next;
    double least; /* a smaller area is none */
    double steps; /* corners that may still be looked at */
} ring;

/* Twice the area of a triangle; positive if it is counterclockwise. */
static double area_of(const ring *r, sl_int a, sl_int b, sl_int c) {
    return (r->x[b] - r->x[a]) * (r->y[c] - r->y[a]) - (r->x[c] - r->x[a]) * (r->y[b] - r->y[a]);
}

static bool is_same_point(const ring *r, sl_int a, sl_int b) {
    return r->x[a] == r->x[b] && r->y[a] == r->y[b];
}

/* Whether corner b, between a and c, can be cut off: it is convex, and no reflex corner is in the
 * triangle or on its sides. */
static bool is_ear(ring *r, sl_int b) {
    const sl_int a = r->before[b], c = r->next[b];
    if (!(area_of(r, a, b, c) > r->least)) {
        return false;
    }
    for (sl_int k = r->next[c]; k != a; k = r->next[k]) {
        r->steps--;
        if (area_of(r, r->before[k], k, r->next[k]) <= r->least && area_of(r, a, b, k) >= 0 &&
            area_of(r, b, c, k) >= 0 && area_of(r, c, a, k) >= 0 && !is_same_point(r, a, k) &&
            !is_same_point(r, b, k) && !is_same_point(r, c, k)) {
            return false;
        }
    }
    return true;
}

/* Cuts ears until a triangle is left, and writes the corners of all triangles as positions in the
 * polygon. Once around without an ear, a corner without area is cut; if there is none, or the last
 * triangle is turned over, the polygon crosses itself, and the result is false. */
static bool cut_ears(ring *r, size_t corners, sl_int *triangle) {
    sl_int at = 0;
    size_t left = corners, tried = 0;
    while (left > 3) {
        const bool is_straight =
            tried >= left && fabs(area_of(r, r->before[at], at, r->next[at])) <= r->least;
        if (tried >= 2 * left || r->steps < 0) {
            return false;
        }
        if (is_straight || is_ear(r, at)) {
            const sl_int a = r->before[at], c = r->next[at];
            *triangle++ = a;
            *triangle++ = at;
            *triangle++ = c;
            r->next[a] = c;
            r->before[c] = a;
            left--;
            tried = 0;
            at = c;
        } else {
            tried++;
            at = r->next[at];
        }
    }
    *triangle++ = r->before[at];
    *triangle++ = at;
    *triangle = r->next[at];
    return area_of(r, r->before[at], at, r->next[at]) >= -r->least;
}

static const double *corner(const sl_int *faces, const double *xyz, size_t k) {
    return xyz + 3 * (size_t)(k == 0 ? faces[0] : k == 1 ? faces[1] : faces[3 * (k - 2) + 2]);
}

static void normal_of(const double *a, const double *b, const double *c, double normal[3]) {
    for (int d = 0; d < 3; d++) {
        const int e = (d + 1) % 3, f = (d + 2) % 3;
        normal[d] = (b[e] - a[e]) * (c[f] - a[f]) - (b[f] - a[f]) * (c[e] - a[e]);
    }
}

/* The normal of the polygon; its length is twice the area. */
static double polygon_normal(const sl_int *faces, size_t corners, const double *xyz,
                             double normal[3]) {
    normal[0] = normal[1] = normal[2] = 0;
    for (size_t k = 2; k < corners; k++) {
        double n[3];
        normal_of(corner(faces, xyz, 0), corner(faces, xyz, k - 1), corner(faces, xyz, k), n);
        for (int d = 0; d < 3; d++) {
            normal[d] += n[d];
        }
    }
    return hypot(hypot(normal[0], normal[1]), normal[2]);
}

static bool fan_turns_over(const sl_int *faces, size_t corners, const double *xyz,
                           const double normal[3], double length) {
    for (size_t k = 2; k < corners; k++) {
        double n[3];
        normal_of(corner(faces, xyz, 0), corner(faces, xyz, k - 1), corner(faces, xyz, k), n);
        const double along = (n[0] * normal[0] + n[1] * normal[1] + n[2] * normal[2]) / length;
        if (along < -rounding * length) {
            return true;
        }
    }
    return false;
}

/* Projects the polygon along its normal: on the coordinate plane in which it is largest, turned so
 * that it is counterclockwise. */
static void project(ring *r, const sl_int *faces, size_t corners, const double *xyz,
                    const double normal[3]) {
    int axis = fabs(normal[0]) > fabs(normal[1]) ? 0 : 1;
    axis = fabs(normal[2]) > fabs(normal[axis]) ? 2 : axis;
    const int first = (axis + (normal[axis] > 0 ? 1 : 2)) % 3;
    const int second = (axis + (normal[axis] > 0 ? 2 : 1)) % 3;
    const double *origin = corner(faces, xyz, 0);
    for (size_t k = 0; k < corners; k++) {
        const double *x = corner(faces, xyz, k);
        r->x[k] = x[first] - origin[first];
        r->y[k] = x[second] - origin[second];
        r->before[k] = (sl_int)(k > 0 ? k - 1 : corners - 1);
        r->next[k] = (sl_int)(k + 1 < corners ? k + 1 : 0);
    }
    r->least = rounding * fabs(normal[axis]);
}

ears_result ears_instead_of_fan(sl_int *faces, size_t corners, const double *xyz) {
    double normal[3];
    const double length = polygon_normal(faces, corners, xyz, normal);
    if (!(length > 0) || !isfinite(length) ||
        !fan_turns_over(faces, corners, xyz, normal, length)) {
        return EARS_FAN;
    }
    if (corners > EARS_CORNERS_MAX) {
        return EARS_TOO_LARGE;
    }
    ears_result result = EARS_NO_MEMORY;
    const size_t triangles = corners - 2;
    double *x = (double *)malloc(2 * corners * sizeof *x);
    sl_int *number = (sl_int *)malloc((3 * corners + 3 * triangles) * sizeof *number);
    if (x != NULL && number != NULL) {
        const double most = 8; /* of the square; shapes that take the cube are rare */
        ring r = {
            x, x + corners, number, number + corners, 0, most * (double)corners * (double)corners};
        sl_int *vertex = number + 2 * corners, *triangle = vertex + corners;
        for (size_t k = 0; k < corners; k++) {
            vertex[k] = k == 0 ? faces[0] : k == 1 ? faces[1] : faces[3 * (k - 2) + 2];
        }
        project(&r, faces, corners, xyz, normal);
        result = cut_ears(&r, corners, triangle) ? EARS_CUT
                 : r.steps < 0                   ? EARS_TOO_LARGE
                                                 : EARS_IMPOSSIBLE;
        for (size_t k = 0; k < 3 * triangles && result == EARS_CUT; k++) {
            faces[k] = vertex[triangle[k]];
        }
    }
    free(number);
    free(x);
    return result;
}

/* planar_triangle.c: a face in coordinates of its own plane, and its linear map to a layout */
#include "planar_triangle.h"

#include <math.h>

planar_triangle planar_triangle_of(const mesh *m, const sl_int *face) {
    const double *o = m->xyz + 3 * (size_t)face[0];
    double e[3], d[3], length = 0, along = 0, rest = 0;
    for (int c = 0; c < 3; c++) {
        e[c] = m->xyz[3 * (size_t)face[1] + (size_t)c] - o[c];
        d[c] = m->xyz[3 * (size_t)face[2] + (size_t)c] - o[c];
    }
    length = hypot(hypot(e[0], e[1]), e[2]);
    for (int c = 0; c < 3; c++) {
        along += length > 0 ? d[c] * (e[c] / length) : 0;
    }
    for (int c = 0; c < 3; c++) {
        rest = hypot(rest, length > 0 ? d[c] - along * (e[c] / length) : d[c]);
    }
    planar_triangle f = {{{0, 0}, {length, 0}, {along, rest}}};
    return f;
}

/* The product of Kahan, with a >= b >= c: no difference cancels. */
double planar_area_of_lengths(const double lengths[3]) {
    double a = fmax(lengths[0], fmax(lengths[1], lengths[2]));
    double c = fmin(lengths[0], fmin(lengths[1], lengths[2]));
    double b = fmax(fmin(lengths[0], lengths[1]), fmin(fmax(lengths[0], lengths[1]), lengths[2]));
    double rest = c - (a - b);
    return rest > 0 ? 0.25 * sqrt((a + (b + c)) * rest) * sqrt((c + (a - b)) * (a + (b - c))) : 0;
}

planar_triangle planar_triangle_of_lengths(const double lengths[3]) {
    double base = lengths[2], near = lengths[1], far = lengths[0];
    double along = base > 0 ? 0.5 * (base + (near - far) * ((near + far) / base)) : 0;
    double height = base > 0 ? 2 * planar_area_of_lengths(lengths) / base : 0;
    planar_triangle f = {{{0, 0}, {base, 0}, {along, height}}};
    return f;
}

bool planar_map_of(planar_map *out, const planar_triangle *f, const double *const to[3]) {
    double base = f->x[1][0], height = f->x[2][1];
    if (!(base > 0 && height > 0)) {
        return false;
    }
    for (int c = 0; c < 2; c++) {
        double along = (to[1][c] - to[0][c]) / base;
        out->a[c][0] = along;
        out->a[c][1] = (to[2][c] - to[0][c] - along * f->x[2][0]) / height;
    }
    /* a is the sum of two similarities: one preserves orientation, the other reverses it */
    double keeps = 0.5 * hypot(out->a[0][0] + out->a[1][1], out->a[1][0] - out->a[0][1]);
    double turns = 0.5 * hypot(out->a[0][0] - out->a[1][1], out->a[1][0] + out->a[0][1]);
    out->sigma_max = keeps + turns;
    out->sigma_min = keeps - turns;
    return isfinite(out->sigma_max);
}

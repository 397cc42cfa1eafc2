/* render_shade.c: the color of a part of a face: color map, checkerboard, isolines, light */
#include "render_shade.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const double isoline_width = 1.0; /* pixels */

static void face_normal(double normal[3], const double *a, const double *b, const double *c) {
    double u[3], v[3];
    for (int d = 0; d < 3; d++) {
        u[d] = b[d] - a[d];
        v[d] = c[d] - a[d];
    }
    for (int d = 0; d < 3; d++) {
        normal[d] = u[(d + 1) % 3] * v[(d + 2) % 3] - u[(d + 2) % 3] * v[(d + 1) % 3];
    }
}

static double dot(const double *a, const double *b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void normalize(double x[3]) {
    const double square = dot(x, x);
    double length =
        square > 1e-200 && square < 1e200 ? sqrt(square) : hypot(hypot(x[0], x[1]), x[2]);
    for (int d = 0; d < 3; d++) {
        x[d] = length > 0 && isfinite(length) ? x[d] / length : 0;
    }
}

/* Adds the area-weighted normals of all faces to those of their corners. size[v] sums up their
 * lengths; at a vertex with a reference, each is first turned to the reference's side. */
static void sum_normals(const render_shade *s, double *sum, double *size, const double *reference) {
    for (size_t k = 0; k < (size_t)s->m->n_faces; k++) {
        const sl_int *f = s->m->faces + 3 * k;
        double normal[3];
        face_normal(normal, s->eye + 3 * (size_t)f[0], s->eye + 3 * (size_t)f[1],
                    s->eye + 3 * (size_t)f[2]);
        const double length = hypot(hypot(normal[0], normal[1]), normal[2]);
        for (int c = 0; c < 3 && isfinite(length); c++) {
            const size_t v = (size_t)f[c];
            const double sign = reference != NULL && dot(normal, reference + 3 * v) < 0 ? -1 : 1;
            size[v] += length;
            for (size_t d = 0; d < 3; d++) {
                sum[3 * v + d] += sign * normal[d];
            }
        }
    }
}

/* The largest normal of the faces at each vertex. */
static void largest_normals(const render_shade *s, double *largest) {
    for (size_t k = 0; k < (size_t)s->m->n_faces; k++) {
        const sl_int *f = s->m->faces + 3 * k;
        double normal[3];
        face_normal(normal, s->eye + 3 * (size_t)f[0], s->eye + 3 * (size_t)f[1],
                    s->eye + 3 * (size_t)f[2]);
        for (int c = 0; c < 3; c++) {
            double *other = largest + 3 * (size_t)f[c];
            if (dot(normal, normal) > dot(other, other)) {
                memcpy(other, normal, sizeof normal);
            }
        }
    }
}

/* Area-weighted means of the normals of the incident faces. Where these cancel, as those of faces
 * that lie on one another with opposite orientations do, rounding alone would decide about their
 * mean: there all normals are turned to one side. Light does not depend on the side. */
static bool vertex_normals(render_shade *s) {
    const size_t n = (size_t)s->m->n_vertices;
    const double canceled = 0.05;
    double *size = (double *)calloc(n + 1, sizeof *size);
    double *aligned = (double *)calloc(3 * n + 1, sizeof *aligned);
    double *largest = (double *)calloc(3 * n + 1, sizeof *largest);
    s->normal = (double *)calloc(3 * n + 1, sizeof *s->normal);
    const bool ok = s->normal != NULL && size != NULL && aligned != NULL && largest != NULL;
    if (ok) {
        largest_normals(s, largest);
        sum_normals(s, aligned, size, largest);
        memset(size, 0, n * sizeof *size);
        sum_normals(s, s->normal, size, NULL);
    }
    for (size_t v = 0; v < n && ok; v++) {
        double *sum = s->normal + 3 * v;
        if (dot(sum, sum) <= canceled * canceled * size[v] * size[v]) {
            memcpy(sum, aligned + 3 * v, 3 * sizeof *sum);
        }
        normalize(sum);
    }
    free(largest);
    free(aligned);
    free(size);
    return ok;
}

static void find_range(render_shade *s) {
    const render_style *style = s->style;
    s->low = style->low;
    s->high = style->high;
    if (style->scalar != NULL && s->low == 0 && s->high == 0) {
        s->low = HUGE_VAL;
        s->high = -HUGE_VAL;
        for (size_t k = 0; k < 3 * (size_t)s->m->n_faces; k++) {
            double x = style->scalar[s->m->faces[k]];
            if (isfinite(x)) {
                s->low = fmin(s->low, x);
                s->high = fmax(s->high, x);
            }
        }
    }
}

/* The texture coordinates of corner c of a face; false: it has none. */
static bool corner_uv(double out[2], const render_shade *s, size_t face, size_t c) {
    const render_style *style = s->style;
    size_t v = (size_t)s->m->faces[3 * face + c];
    if (style->corner_uv == NULL && style->uv != NULL && style->has_uv != NULL &&
        !style->has_uv[v]) {
        return false;
    }
    const double *uv = style->corner_uv != NULL ? style->corner_uv + 6 * face + 2 * c
                       : style->uv != NULL      ? style->uv + 2 * v
                                                : NULL;
    if (uv == NULL || !isfinite(uv[0]) || !isfinite(uv[1])) {
        return false;
    }
    out[0] = uv[0];
    out[1] = uv[1];
    return true;
}

static void find_checks(render_shade *s) {
    double low[2] = {HUGE_VAL, HUGE_VAL}, high[2] = {-HUGE_VAL, -HUGE_VAL}, uv[2];
    s->checks = s->style->checks;
    if (s->checks > 0 || (s->style->uv == NULL && s->style->corner_uv == NULL)) {
        return;
    }
    for (size_t k = 0; k < 3 * (size_t)s->m->n_faces; k++) {
        for (int d = 0; corner_uv(uv, s, k / 3, k % 3) && d < 2; d++) {
            low[d] = fmin(low[d], uv[d]);
            high[d] = fmax(high[d], uv[d]);
        }
    }
    double side = fmax(high[0] - low[0], high[1] - low[1]);
    s->checks = side > 0 ? 20 / side : 1;
}

bool render_shade_begin(render_shade *s, const mesh *m, const render_style *style,
                        const double *eye, double pixel) {
    memset(s, 0, sizeof *s);
    s->m = m;
    s->style = style;
    s->eye = eye;
    s->pixel = pixel;
    find_range(s);
    find_checks(s);
    return style->unlit || style->flat || vertex_normals(s);
}

void render_shade_end(render_shade *s) {
    free(s->normal);
    s->normal = NULL;
}

void render_shade_face(render_triangle *tri, const render_shade *s, sl_int face, const double *a,
                       const double *b, const double *c) {
    const sl_int *f = s->m->faces + 3 * (size_t)face;
    double area = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
    memset(tri, 0, sizeof *tri);
    tri->face = face;
    tri->height[0] = fabs(area) / hypot(c[0] - b[0], c[1] - b[1]);
    tri->height[1] = fabs(area) / hypot(a[0] - c[0], a[1] - c[1]);
    tri->height[2] = fabs(area) / hypot(b[0] - a[0], b[1] - a[1]);
    face_normal(tri->normal, s->eye + 3 * (size_t)f[0], s->eye + 3 * (size_t)f[1],
                s->eye + 3 * (size_t)f[2]);
    normalize(tri->normal);
    for (int k = 0; k < 3 && s->normal != NULL; k++) {
        tri->side[k] = dot(tri->normal, s->normal + 3 * (size_t)f[k]) < 0 ? -1 : 1;
    }
    if (s->style->scalar != NULL) {
        const double *x = s->style->scalar;
        double du = x[f[1]] - x[f[0]], dv = x[f[2]] - x[f[0]];
        tri->slope = hypot(du * (c[1] - a[1]) - dv * (b[1] - a[1]),
                           dv * (b[0] - a[0]) - du * (c[0] - a[0])) /
                     fabs(area);
    }
    tri->has_uv = true;
    for (size_t k = 0; k < 3; k++) {
        tri->has_uv = corner_uv(tri->uv[k], s, (size_t)face, k) && tri->has_uv;
    }
}

static rgb checked(const render_shade *s, const render_triangle *tri, const double w[3]) {
    static const rgb light = {0xf4, 0xee, 0xe0}, dark = {0x3d, 0x6f, 0x9e};
    double u = 0, v = 0;
    for (int k = 0; k < 3; k++) {
        u += w[k] * tri->uv[k][0];
        v += w[k] * tri->uv[k][1];
    }
    double odd = fmod(floor(u * s->checks) + floor(v * s->checks), 2);
    return odd != 0 ? dark : light;
}

/* How much of a part of a face a line covers, 0..1. `distance` is that of the part's center from
 * the middle of the line, `reach` half the part's width. */
static double line_share(double half_width, double distance, double reach) {
    return fmax(0, fmin(1, 0.5 + 0.5 * (half_width - distance) / reach));
}

/* How much of a part with this value at its center an isoline covers. Their levels are
 * low + k (high - low) / (isolines + 1) for k = 1..isolines. Where lines would be closer than two
 * widths, there are none: they would hide the color. */
static double isoline_share(const render_shade *s, const render_triangle *tri, double value,
                            double reach) {
    int count = s->style->isolines;
    double step = (s->high - s->low) / (count + 1);
    if (count < 1 || !(step > 0)) {
        return 0;
    }
    double level = floor((value - s->low) / step + 0.5), width = isoline_width * s->pixel;
    if (!(level >= 1 && level <= count && width * tri->slope <= 0.5 * step)) {
        return 0;
    }
    double off = fabs(value - s->low - level * step);
    return tri->slope > 0 ? line_share(0.5 * width, off / tri->slope, reach) : off == 0;
}

static rgb base_color(const render_shade *s, const render_triangle *tri, const double w[3],
                      double reach) {
    static const rgb plain = {0xd9, 0xd4, 0xcc}, line = {0x20, 0x20, 0x20};
    const render_style *style = s->style;
    const sl_int *f = s->m->faces + 3 * (size_t)tri->face;
    int nearest = w[0] >= w[1] && w[0] >= w[2] ? 0 : w[1] >= w[2] ? 1 : 2;
    if (tri->has_uv) {
        return checked(s, tri, w);
    }
    if (style->scalar != NULL) {
        double x =
            w[0] * style->scalar[f[0]] + w[1] * style->scalar[f[1]] + w[2] * style->scalar[f[2]];
        rgb color = color_map(!isfinite(x)       ? NAN
                              : s->high > s->low ? (x - s->low) / (s->high - s->low)
                                                 : 0.5);
        return color_mix(color, line, isoline_share(s, tri, x, reach));
    }
    if (style->vertex_color != NULL) {
        if (style->nearest) {
            return style->vertex_color[f[nearest]];
        }
        double sum = w[0] + w[1];
        rgb pair = color_mix(style->vertex_color[f[0]], style->vertex_color[f[1]],
                             sum > 0 ? fmin(1, fmax(0, w[1] / sum)) : 0);
        return color_mix(pair, style->vertex_color[f[2]], fmin(1, fmax(0, w[2])));
    }
    return style->face_color != NULL ? style->face_color[tri->face] : plain;
}

/* Diffuse light from the upper left behind the camera; both sides of the surface are lit. */
static rgb lit(const render_shade *s, const render_triangle *tri, const double w[3], rgb color) {
    static const double light[3] = {-0.36, 0.48, 0.8};
    double normal[3] = {tri->normal[0], tri->normal[1], tri->normal[2]};
    if (s->normal != NULL) {
        const sl_int *f = s->m->faces + 3 * (size_t)tri->face;
        for (int d = 0; d < 3; d++) {
            normal[d] = 0;
            for (int c = 0; c < 3; c++) {
                normal[d] += w[c] * tri->side[c] * s->normal[3 * (size_t)f[c] + (size_t)d];
            }
        }
        normalize(normal);
    }
    double side = normal[2] < 0 ? -1 : 1;
    double cosine = side * dot(normal, light);
    double intensity = 0.45 + 0.55 * fmax(0, cosine);
    rgb black = {0, 0, 0};
    return color_mix(black, color, intensity);
}

rgb render_shade_part(const render_shade *s, const render_triangle *tri, const double w[3],
                      double area) {
    const double reach = 0.5 * sqrt(area);
    rgb color = base_color(s, tri, w, reach);
    if (!s->style->unlit) {
        color = lit(s, tri, w, color);
    }
    /* Thin faces have no lines along them, which would hide their color. */
    double half_width = 0.5 * s->style->edges * s->pixel, share = 0;
    for (int c = 0; half_width > 0 && c < 3; c++) {
        if (tri->height[c] > 6 * half_width) {
            share = fmax(share, line_share(half_width, w[c] * tri->height[c], reach));
        }
    }
    return share > 0 ? color_mix(color, s->style->edge_color, share) : color;
}

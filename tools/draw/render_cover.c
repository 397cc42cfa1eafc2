/* render_cover.c: the parts of a triangle in the cells of a raster: areas, centers, sample masks */
#include "render_cover.h"

#include <math.h>
#include <stdbool.h>
#include <string.h>

enum { MOST_CORNERS = 8, SAMPLES = 4 }; /* a triangle clipped at four lines has up to 7 corners */

/* Barycentric coordinates are interpolated along the edges, not computed from areas: they remain
 * within 0..1 in the thinnest triangle. */
typedef struct point {
    double at[2];
    double w[3];
} point;

typedef struct polygon {
    int n;
    point c[MOST_CORNERS];
} polygon;

/* What is constant in a triangle. */
typedef struct triangle {
    const double *const *corner;
    double edge[3][3]; /* edge[k][0] x + edge[k][1] y + edge[k][2] is at least 0 inside */
    double twice;      /* twice the area */
    double slope[2];   /* change of the depth for a cell to the right and downward */
} triangle;

static point between(const point *a, const point *b, double t) {
    point c;
    for (int d = 0; d < 2; d++) {
        c.at[d] = a->at[d] + t * (b->at[d] - a->at[d]);
    }
    for (int k = 0; k < 3; k++) {
        c.w[k] = a->w[k] + t * (b->w[k] - a->w[k]);
    }
    return c;
}

/* The part of p with sign * at[axis] >= sign * limit. */
static polygon clip(const polygon *p, int axis, double limit, double sign) {
    polygon out;
    out.n = 0;
    for (int k = 0; k < p->n; k++) { /* from a to b; most of them are on one side */
        const point *a = &p->c[k], *b = &p->c[k + 1 < p->n ? k + 1 : 0];
        double da = sign * (a->at[axis] - limit), db = sign * (b->at[axis] - limit);
        if (da >= 0 && out.n < MOST_CORNERS) {
            out.c[out.n++] = *a;
        }
        if ((da < 0) != (db < 0) && out.n < MOST_CORNERS) {
            out.c[out.n] = between(a, b, da / (da - db));
            out.c[out.n++].at[axis] = limit;
        }
    }
    return out;
}

/* The area of a polygon and the barycentric coordinates of its center of mass. */
static double measure(double w[3], const polygon *p) {
    double area = 0;
    memset(w, 0, 3 * sizeof *w);
    for (int k = 1; k + 1 < p->n; k++) {
        const point *a = &p->c[0], *b = &p->c[k], *c = &p->c[k + 1];
        double twice = fabs((b->at[0] - a->at[0]) * (c->at[1] - a->at[1]) -
                            (b->at[1] - a->at[1]) * (c->at[0] - a->at[0]));
        area += 0.5 * twice;
        for (int d = 0; d < 3; d++) {
            w[d] += twice / 6 * (a->w[d] + b->w[d] + c->w[d]);
        }
    }
    double sum = w[0] + w[1] + w[2];
    for (int d = 0; d < 3 && sum > 0; d++) {
        w[d] /= sum;
    }
    return sum > 0 ? area : 0;
}

/* The depth in the middle of the cell. A plane seen nearly from the side has any depth there, so it
 * is extended by no more than the part's own range and the width of a cell. */
static double depth_of(const triangle *t, const polygon *p, const cover_part *part) {
    const double *const *corners = t->corner;
    double low = HUGE_VAL, high = -HUGE_VAL, depth = 0, at[2] = {0, 0};
    for (int k = 0; k < p->n; k++) {
        double z = 0;
        for (int d = 0; d < 3; d++) {
            z += p->c[k].w[d] * corners[d][2];
        }
        low = z < low ? z : low;
        high = z > high ? z : high;
    }
    for (int d = 0; d < 3; d++) {
        depth += part->w[d] * corners[d][2];
        at[0] += part->w[d] * corners[d][0];
        at[1] += part->w[d] * corners[d][1];
    }
    depth += t->slope[0] * (part->x + 0.5 - at[0]) + t->slope[1] * (part->y + 0.5 - at[1]);
    const double more = high - low + 1;
    return fmax(low - more, fmin(high + more, depth));
}

/* The samples are off the middle of their squares, so that edges along the cells meet none. */
static uint16_t mask_of(const triangle *t, int x, int y, const bool cuts[3]) {
    static const double offset = 0.5 + 0.0618;
    unsigned outside = 0;
    for (int e = 0; e < 3; e++) {
        const double *edge = t->edge[e];
        if (!cuts[e]) {
            continue;
        }
        double first = edge[0] * (x + offset / SAMPLES) + edge[1] * (y + (1 - offset) / SAMPLES);
        for (int k = 0; k < SAMPLES * SAMPLES; k++) {
            double at = first + (edge[0] * (k % SAMPLES) + edge[1] * (k / SAMPLES)) / SAMPLES;
            outside |= (unsigned)(at + edge[2] < 0) << k;
        }
    }
    return (uint16_t)~outside;
}

/* Which edges have a part of the cell outside. Returns whether there is none. */
static bool is_full(bool cuts[3], const triangle *t, int x, int y) {
    for (int e = 0; e < 3; e++) {
        const double *edge = t->edge[e];
        double least = edge[0] * (edge[0] < 0 ? x + 1 : x) + edge[1] * (edge[1] < 0 ? y + 1 : y);
        cuts[e] = least + edge[2] < 0;
    }
    return !(cuts[0] || cuts[1] || cuts[2]);
}

static bool prepare(triangle *t, const double *const corner[3]) {
    const double *a = corner[0], *b = corner[1], *c = corner[2];
    double u[3], v[3];
    for (int d = 0; d < 3; d++) {
        u[d] = b[d] - a[d];
        v[d] = c[d] - a[d];
    }
    const double twice = u[0] * v[1] - u[1] * v[0];
    t->corner = corner;
    t->twice = fabs(twice);
    if (!(fabs(twice) > 0) || !isfinite(twice)) {
        return false;
    }
    t->slope[0] = (u[2] * v[1] - v[2] * u[1]) / twice;
    t->slope[1] = (v[2] * u[0] - u[2] * v[0]) / twice;
    for (int e = 0; e < 3; e++) { /* from corner p to q, times the orientation */
        const double *p = corner[e], *q = corner[(e + 1) % 3], sign = twice > 0 ? 1 : -1;
        t->edge[e][0] = -sign * (q[1] - p[1]);
        t->edge[e][1] = sign * (q[0] - p[0]);
        t->edge[e][2] = -t->edge[e][0] * p[0] - t->edge[e][1] * p[1];
    }
    return true;
}

/* The cells from..to-1 that hold the numbers ends[0]..ends[1], within first..end-1. */
static void cells_between(int *from, int *to, const double ends[2], int first, int end) {
    *from = !(ends[0] > first) ? first : ends[0] >= end ? end : (int)floor(ends[0]);
    *to = !(ends[1] > first) ? first : ends[1] >= end ? end : (int)ceil(ends[1]);
}

/* The lowest and the highest coordinate. */
static void range(double ends[2], const polygon *p, int axis) {
    ends[0] = HUGE_VAL;
    ends[1] = -HUGE_VAL;
    for (int k = 0; k < p->n; k++) {
        const double at = p->c[k].at[axis];
        ends[0] = at < ends[0] ? at : ends[0];
        ends[1] = at > ends[1] ? at : ends[1];
    }
}

/* The part of the cell (part->x, part->y), from the part of its row, which runs from ends[0] to
 * ends[1]. */
static void cover_cell(cover_part *part, const triangle *t, const polygon *row,
                       const double ends[2], const bool cuts[3]) {
    polygon right, cell;
    const polygon *rest = row;
    if (ends[0] < part->x) {
        right = clip(rest, 0, part->x, 1);
        rest = &right;
    }
    if (ends[1] > part->x + 1) {
        cell = clip(rest, 0, part->x + 1, -1);
        rest = &cell;
    }
    part->area = fmin(1, measure(part->w, rest));
    if (part->area > 0) {
        part->depth = depth_of(t, rest, part);
        part->mask = mask_of(t, part->x, part->y, cuts);
    }
}

/* A cell that is in the triangle as a whole. */
static void cover_full_cell(cover_part *part, const triangle *t) {
    const double *a = t->corner[0], *b = t->corner[1], *c = t->corner[2];
    const double x = part->x + 0.5, y = part->y + 0.5;
    for (int k = 0; k < 2; k++) { /* edge e is opposite to corner e + 2 */
        const double *e = t->edge[(k + 1) % 3];
        part->w[k] = (e[0] * x + e[1] * y + e[2]) / t->twice;
    }
    part->w[2] = 1 - part->w[0] - part->w[1];
    part->depth = part->w[0] * a[2] + part->w[1] * b[2] + part->w[2] * c[2];
    part->area = 1;
    part->mask = 0xffff;
}

void cover_triangle(const double *const corner[3], int left, int right, int top, int bottom,
                    cover_visitor *visit, void *context) {
    triangle t;
    polygon whole;
    double ends[2];
    int first_row, end_row;
    if (!prepare(&t, corner)) {
        return;
    }
    memset(&whole, 0, sizeof whole);
    whole.n = 3;
    for (int k = 0; k < 3; k++) {
        memcpy(whole.c[k].at, corner[k], sizeof whole.c[k].at);
        whole.c[k].w[k] = 1;
    }
    range(ends, &whole, 1);
    cells_between(&first_row, &end_row, ends, top, bottom);
    for (int y = first_row; y < end_row; y++) {
        polygon below = clip(&whole, 1, y, 1), row = clip(&below, 1, y + 1, -1);
        cover_part part;
        int end;
        memset(&part, 0, sizeof part);
        part.y = y;
        range(ends, &row, 0);
        cells_between(&part.x, &end, ends, left, right);
        for (; part.x < end; part.x++) {
            bool cuts[3];
            if (is_full(cuts, &t, part.x, part.y)) {
                cover_full_cell(&part, &t);
            } else {
                cover_cell(&part, &t, &row, ends, cuts);
            }
            if (part.area > 0) {
                visit(context, &part);
            }
        }
    }
}

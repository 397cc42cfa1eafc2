/* render.c: renders a mesh to a picture: projection, visible colors, marks and lines */
#include "render.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "render_cover.h"
#include "render_layers.h"
#include "render_shade.h"
#include "thin_view.h"

enum { SUPERSAMPLE = 2, CELLS = 1 << 15 /* of a band: they stay in the cache */ };

static const double margin = 0.04; /* fraction of the picture, on each side */
static const double largest_coordinate = 1e150;

static const rgb background = {255, 255, 255};

render_view render_view_default(void) {
    render_view view = {800, 600, 1, 30, 20, 0, 1, CAMERA_UP_Y, true};
    return view;
}

/* State of one rendering; pixels has SUPERSAMPLE times the width and height of the result. */
typedef struct scene {
    const mesh *m;
    const render_style *style;
    render_shade shade;
    picture pixels;
    double unit;      /* cells per unit of width */
    double *depth;    /* width x height; larger is nearer */
    double *screen;   /* 3 n_vertices: x and y in pixels, depth; NaN: not drawable */
    double *eye;      /* 3 n_vertices: camera coordinates (right, up, toward the camera) */
    double box[8][3]; /* camera coordinates of the corners of style->box */
    int n_box;        /* 8, or 0 without a box */
} scene;

static bool is_drawn(const scene *s, sl_int face) {
    if (s->style->hidden != NULL && s->style->hidden[face]) {
        return false;
    }
    for (int c = 0; c < 3; c++) {
        if (!isfinite(s->screen[3 * (size_t)s->m->faces[3 * (size_t)face + (size_t)c]])) {
            return false;
        }
    }
    return true;
}

static bool is_drawable(const double *x) {
    return fabs(x[0]) < largest_coordinate && fabs(x[1]) < largest_coordinate &&
           fabs(x[2]) < largest_coordinate;
}

/* The coordinate axis along which the mesh has no extent, or -1. */
static int flat_axis(const mesh *m) {
    double low[3] = {HUGE_VAL, HUGE_VAL, HUGE_VAL}, high[3] = {-HUGE_VAL, -HUGE_VAL, -HUGE_VAL};
    for (size_t k = 0; k < 3 * (size_t)m->n_faces; k++) {
        const double *x = m->xyz + 3 * (size_t)m->faces[k];
        for (int d = 0; d < 3 && is_drawable(x); d++) {
            low[d] = fmin(low[d], x[d]);
            high[d] = fmax(high[d], x[d]);
        }
    }
    for (int d = 0; d < 3; d++) {
        int e = (d + 1) % 3, g = (d + 2) % 3;
        if (high[d] - low[d] <= 1e-6 * fmax(high[e] - low[e], high[g] - low[g])) {
            return d;
        }
    }
    return -1;
}

void render_axes(double axes[3][3], const render_view *view, const mesh *m) {
    int flat = view->automatic ? flat_axis(m) : -1;
    if (flat == 0) { /* seen from +x: y to the right, z up */
        camera_axes(axes, CAMERA_UP_Z, 90, 0);
    } else if (flat == 1) { /* seen from +y: x to the right, -z up */
        camera_axes(axes, CAMERA_UP_Y, 0, 90);
    } else if (flat == 2) { /* seen from +z: x to the right, y up */
        camera_axes(axes, CAMERA_UP_Y, 0, 0);
    } else {
        camera_axes(axes, view->up, view->azimuth, view->elevation);
    }
    if (view->automatic) {
        (void)thin_view_turn(axes, m, (double)view->height / view->width);
    }
}

void render_look_from(render_view *view, const double direction[3]) {
    camera_angles(&view->azimuth, &view->elevation, view->up, direction);
}

/* Camera coordinates of the corners of the box; a box that is not drawable is left out. */
static void place_box(scene *s, double axes[3][3]) {
    const double *box = s->style->box;
    s->n_box = box != NULL && is_drawable(box) && is_drawable(box + 3) ? 8 : 0;
    for (int k = 0; k < s->n_box; k++) {
        const double x[3] = {box[k & 1 ? 3 : 0], box[k & 2 ? 4 : 1], box[k & 4 ? 5 : 2]};
        for (int d = 0; d < 3; d++) {
            s->box[k][d] = axes[d][0] * x[0] + axes[d][1] * x[1] + axes[d][2] * x[2];
        }
    }
}

/* Computes camera coordinates centered on what is drawn; returns its radius. */
static double center_eye(scene *s, double axes[3][3]) {
    double low[3] = {HUGE_VAL, HUGE_VAL, HUGE_VAL}, high[3] = {-HUGE_VAL, -HUGE_VAL, -HUGE_VAL};
    size_t n = (size_t)s->m->n_vertices;
    for (size_t v = 0; v < n; v++) {
        const double *x = s->m->xyz + 3 * v;
        bool drawable = is_drawable(x);
        for (int d = 0; d < 3; d++) {
            s->eye[3 * v + (size_t)d] =
                drawable ? axes[d][0] * x[0] + axes[d][1] * x[1] + axes[d][2] * x[2] : NAN;
        }
        s->screen[3 * v] = s->eye[3 * v]; /* is_drawn reads it */
    }
    for (sl_int f = 0; f < s->m->n_faces; f++) {
        for (size_t c = 0; c < 3 && is_drawn(s, f); c++) {
            const double *e = s->eye + 3 * (size_t)s->m->faces[3 * (size_t)f + c];
            for (int d = 0; d < 3; d++) {
                low[d] = fmin(low[d], e[d]);
                high[d] = fmax(high[d], e[d]);
            }
        }
    }
    place_box(s, axes);
    for (int k = 0; k < s->n_box; k++) {
        for (int d = 0; d < 3; d++) {
            low[d] = fmin(low[d], s->box[k][d]);
            high[d] = fmax(high[d], s->box[k][d]);
        }
    }
    double radius2 = 0;
    for (int d = 0; d < 3; d++) {
        double middle = low[d] <= high[d] ? 0.5 * low[d] + 0.5 * high[d] : 0;
        double half = low[d] <= high[d] ? 0.5 * high[d] - 0.5 * low[d] : 0;
        radius2 += half * half;
        for (size_t v = 0; v < n; v++) {
            s->eye[3 * v + (size_t)d] -= middle;
        }
        for (int k = 0; k < s->n_box; k++) {
            s->box[k][d] -= middle;
        }
    }
    return sqrt(radius2);
}

/* How much perspective enlarges what is this far toward the camera; distance 0: not at all. */
static double enlargement(double distance, double toward) {
    return distance > 0 && distance > toward ? distance / (distance - toward) : 1;
}

/* Computes the screen positions, by parallel or perspective projection, and scales them to the
 * picture. */
static void project(scene *s, const render_view *view) {
    double axes[3][3];
    render_axes(axes, view, s->m);
    double radius = center_eye(s, axes);
    double distance = view->perspective > 1 ? view->perspective * radius : 0;
    double low[2] = {HUGE_VAL, HUGE_VAL}, high[2] = {-HUGE_VAL, -HUGE_VAL};
    for (sl_int v = 0; v < s->m->n_vertices; v++) {
        double *e = s->eye + 3 * (size_t)v, *p = s->screen + 3 * (size_t)v;
        double larger = enlargement(distance, e[2]);
        p[0] = e[0] * larger;
        p[1] = -e[1] * larger;
        /* As 1 / distance, it is linear on the screen. */
        p[2] = distance > 0 ? distance * larger : e[2];
    }
    for (sl_int f = 0; f < s->m->n_faces; f++) {
        for (size_t c = 0; c < 3 && is_drawn(s, f); c++) {
            const double *p = s->screen + 3 * (size_t)s->m->faces[3 * (size_t)f + c];
            for (int d = 0; d < 2; d++) {
                low[d] = fmin(low[d], p[d]);
                high[d] = fmax(high[d], p[d]);
            }
        }
    }
    for (int k = 0; k < s->n_box; k++) {
        const double larger = enlargement(distance, s->box[k][2]);
        low[0] = fmin(low[0], s->box[k][0] * larger);
        high[0] = fmax(high[0], s->box[k][0] * larger);
        low[1] = fmin(low[1], -s->box[k][1] * larger);
        high[1] = fmax(high[1], -s->box[k][1] * larger);
    }
    double width = s->pixels.width, height = s->pixels.height;
    double room = 1 - 2 * margin;
    double scale = fmin(high[0] > low[0] ? room * width / (high[0] - low[0]) : HUGE_VAL,
                        high[1] > low[1] ? room * height / (high[1] - low[1]) : HUGE_VAL);
    scale = isfinite(scale) ? scale * view->zoom : 1;
    for (sl_int v = 0; v < s->m->n_vertices; v++) {
        double *p = s->screen + 3 * (size_t)v;
        p[0] = 0.5 * width + scale * (p[0] - 0.5 * (low[0] + high[0]));
        p[1] = 0.5 * height + scale * (p[1] - 0.5 * (low[1] + high[1]));
        p[2] *= scale;
    }
}

static int clamp_pixel(double x, int size) {
    return !(x > 0) ? 0 : x >= size ? size : (int)x;
}

/* The face whose parts are drawn into a band of rows. */
typedef struct face_in_band {
    const scene *s;
    render_triangle tri;
    render_cell *cells; /* from the first row of the band on */
    int top;
} face_in_band;

static void draw_part(void *context, const cover_part *part) {
    face_in_band *f = (face_in_band *)context;
    const size_t width = (size_t)f->s->pixels.width;
    render_cell *cell = &f->cells[(size_t)(part->y - f->top) * width + (size_t)part->x];
    if (!render_cell_hides(cell, part->depth)) {
        rgb color = render_shade_part(&f->s->shade, &f->tri, part->w, part->area);
        render_cell_add(cell, part->area, part->mask, part->depth, color);
    }
}

/* Draws all faces into the rows top..bottom-1. */
static void draw_band(scene *s, render_cell *cells, int top, int bottom) {
    const size_t width = (size_t)s->pixels.width, count = (size_t)(bottom - top) * width;
    face_in_band f;
    f.s = s;
    f.cells = cells;
    f.top = top;
    for (size_t k = 0; k < count; k++) {
        cells[k].count = 0;
    }
    for (sl_int face = 0; face < s->m->n_faces; face++) {
        const sl_int *v = s->m->faces + 3 * (size_t)face;
        const double *corner[3];
        for (int c = 0; c < 3; c++) {
            corner[c] = s->screen + 3 * (size_t)v[c];
        }
        const double *a = corner[0], *b = corner[1], *c = corner[2];
        if (is_drawn(s, face) && fmin(fmin(a[1], b[1]), c[1]) < bottom &&
            fmax(fmax(a[1], b[1]), c[1]) > top) {
            render_shade_face(&f.tri, &s->shade, face, a, b, c);
            cover_triangle(corner, 0, s->pixels.width, top, bottom, draw_part, &f);
        }
    }
    for (size_t k = 0; k < count; k++) {
        const size_t at = (size_t)top * width + k;
        s->pixels.at[at] = render_cell_color(&cells[k], background, &s->depth[at]);
    }
}

/* Draws the surface in bands of rows, so that the layers of few cells are in memory at a time. */
static bool draw_surface(scene *s) {
    const int width = s->pixels.width, height = s->pixels.height, fewest = height / 64 + 1;
    int rows = CELLS / width < fewest ? fewest : CELLS / width;
    rows = rows < height ? rows : height;
    render_cell *cells = (render_cell *)malloc((size_t)rows * (size_t)width * sizeof *cells);
    for (int top = 0; cells != NULL && top < height; top += rows) {
        draw_band(s, cells, top, top + rows < height ? top + rows : height);
    }
    free(cells);
    return cells != NULL;
}

/* Draws a disk at a point that the surface does not hide by more than `tolerance` in depth. */
static void draw_dot(scene *s, const double at[3], double radius, double tolerance, rgb color) {
    int x = clamp_pixel(at[0], s->pixels.width - 1), y = clamp_pixel(at[1], s->pixels.height - 1);
    if (isfinite(at[0]) &&
        at[2] + tolerance >= s->depth[(size_t)y * (size_t)s->pixels.width + (size_t)x]) {
        picture_disk(&s->pixels, at[0], at[1], radius, color);
    }
}

static void draw_overlay(scene *s) {
    double low = HUGE_VAL, high = -HUGE_VAL;
    for (sl_int v = 0; v < s->m->n_vertices; v++) {
        low = fmin(low, s->screen[3 * (size_t)v + 2]);
        high = fmax(high, s->screen[3 * (size_t)v + 2]);
    }
    double tolerance = high > low ? fmax(1, 0.01 * (high - low)) : 1;
    for (int k = 0; k < s->style->n_segments; k++) {
        const render_segment *line = &s->style->segments[k];
        const double *a = s->screen + 3 * (size_t)line->from, *b = s->screen + 3 * (size_t)line->to;
        double length = hypot(b[0] - a[0], b[1] - a[1]);
        int steps = length < 1e5 ? (int)(length / fmax(0.5, 0.25 * s->unit * line->width)) + 1 : 0;
        for (int i = 0; steps > 0 && i <= steps; i++) {
            double t = (double)i / steps, point[3];
            for (int d = 0; d < 3; d++) {
                point[d] = a[d] + t * (b[d] - a[d]);
            }
            draw_dot(s, point, 0.5 * s->unit * line->width, tolerance, line->color);
        }
    }
    for (int k = 0; k < s->style->n_marks; k++) {
        const render_mark *mark = &s->style->marks[k];
        draw_dot(s, s->screen + 3 * (size_t)mark->vertex, s->unit * mark->radius, tolerance,
                 mark->color);
    }
}

bool render_mesh(picture *out, const mesh *m, const render_view *view, const render_style *style) {
    scene s;
    memset(out, 0, sizeof *out);
    memset(&s, 0, sizeof s);
    s.m = m;
    s.style = style;
    const int64_t width = (int64_t)view->width * view->scale,
                  height = (int64_t)view->height * view->scale;
    if (view->width < 1 || view->height < 1 || width < 1 || width > 8192 || height > 8192 ||
        !picture_create(&s.pixels, SUPERSAMPLE * (int)width, SUPERSAMPLE * (int)height,
                        background)) {
        return false;
    }
    s.unit = SUPERSAMPLE * view->scale;
    size_t pixels = (size_t)s.pixels.width * (size_t)s.pixels.height;
    size_t n = (size_t)m->n_vertices;
    s.depth = (double *)malloc(pixels * sizeof *s.depth);
    s.screen = (double *)malloc((3 * n + 1) * sizeof *s.screen);
    s.eye = (double *)malloc((3 * n + 1) * sizeof *s.eye);
    bool ok = s.depth != NULL && s.screen != NULL && s.eye != NULL;
    if (ok) {
        project(&s, view);
        ok = render_shade_begin(&s.shade, m, style, s.eye, s.unit);
    }
    ok = ok && draw_surface(&s);
    if (ok) {
        draw_overlay(&s);
        picture_shrink(&s.pixels, SUPERSAMPLE);
        *out = s.pixels;
    } else {
        picture_free(&s.pixels);
    }
    render_shade_end(&s.shade);
    free(s.eye);
    free(s.screen);
    free(s.depth);
    return ok;
}

bool render_layout(picture *out, const mesh *m, const double *uv, const render_view *view,
                   const render_style *style) {
    mesh flat = *m;
    render_view above = *view;
    render_style unlit = *style;
    memset(out, 0, sizeof *out);
    flat.xyz = (double *)calloc(3 * (size_t)m->n_vertices + 1, sizeof *flat.xyz);
    if (flat.xyz == NULL) {
        return false;
    }
    for (size_t v = 0; v < (size_t)m->n_vertices; v++) {
        flat.xyz[3 * v] = uv[2 * v];
        flat.xyz[3 * v + 1] = uv[2 * v + 1];
    }
    above.automatic = false;
    above.up = CAMERA_UP_Y;
    above.azimuth = above.elevation = above.perspective = 0;
    unlit.unlit = true;
    bool ok = render_mesh(out, &flat, &above, &unlit);
    free(flat.xyz);
    return ok;
}

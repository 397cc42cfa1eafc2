/* draw_graph.c: draws the graph of a small mesh with numbered vertices, as SVG */
#include "draw_graph.h"

#include <math.h>
#include <stdio.h>

#include "colors.h"
#include "tools/io/output_file.h"

static const double width = 480, height = 400, border = 24, radius = 10;

/* Orthogonal projection along a coordinate axis. */
typedef struct projection {
    int right, up;       /* the two axes of the picture */
    double scale;        /* pixels per unit of the mesh */
    double low[3];       /* smallest coordinates of the mesh */
    double left, bottom; /* where `low` is in the picture */
} projection;

static projection projection_of(const mesh *m) {
    projection s = {0, 1, 1, {HUGE_VAL, HUGE_VAL, HUGE_VAL}, 0, 0};
    double high[3] = {-HUGE_VAL, -HUGE_VAL, -HUGE_VAL}, extent[3];
    for (size_t k = 0; k < 3 * (size_t)m->n_faces; k++) {
        for (int d = 0; d < 3; d++) {
            double x = m->xyz[3 * (size_t)m->faces[k] + (size_t)d];
            s.low[d] = fmin(s.low[d], x);
            high[d] = fmax(high[d], x);
        }
    }
    for (int d = 0; d < 3; d++) {
        extent[d] = high[d] - s.low[d];
    }
    int thinnest = extent[0] < extent[2] ? 0 : 2; /* z where all are equal */
    thinnest = extent[1] < extent[thinnest] ? 1 : thinnest;
    s.right = thinnest == 0 ? 1 : 0;
    s.up = thinnest == 2 ? 1 : 2;
    double w = extent[s.right], h = extent[s.up];
    double scale = fmin(w > 0 ? (width - 2 * border) / w : HUGE_VAL,
                        h > 0 ? (height - 2 * border) / h : HUGE_VAL);
    s.scale = isfinite(scale) ? scale : 1;
    s.left = 0.5 * (width - s.scale * (w > 0 ? w : 0));
    s.bottom = 0.5 * (height + s.scale * (h > 0 ? h : 0));
    return s;
}

static double picture_x(const projection *s, const mesh *m, sl_int v) {
    return s->left + s->scale * (m->xyz[3 * v + s->right] - s->low[s->right]);
}

static double picture_y(const projection *s, const mesh *m, sl_int v) {
    return s->bottom - s->scale * (m->xyz[3 * v + s->up] - s->low[s->up]);
}

static void print_vertex(FILE *f, const projection *s, const mesh *m, sl_int v, int kind) {
    rgb c = {0xd0, 0xd0, 0xd0};
    c = kind >= 0 ? color_of_kind(kind) : c;
    double x = picture_x(s, m, v), y = picture_y(s, m, v);
    fprintf(f,
            "<circle cx=\"%.1f\" cy=\"%.1f\" r=\"%.0f\" stroke=\"#444\" fill=\"#%02x%02x%02x\"/>"
            "<text x=\"%.1f\" y=\"%.1f\" text-anchor=\"middle\">%d</text>\n",
            x, y, radius, c.r, c.g, c.b, x, y + 3.5, (int)v);
}

bool draw_graph(const char *path, const mesh *m, const int *kind, char *message,
                size_t message_size) {
    FILE *f = output_open(path, message, message_size);
    if (f != NULL) {
        projection s = projection_of(m);
        fprintf(f,
                "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 %.0f %.0f\" "
                "width=\"%.0f\" height=\"%.0f\" font-family=\"sans-serif\" font-size=\"10\">\n"
                "<rect width=\"100%%\" height=\"100%%\" fill=\"white\"/>\n",
                width, height, width, height);
        for (size_t k = 0; k < (size_t)m->n_faces; k++) {
            const sl_int *v = m->faces + 3 * k;
            fprintf(f,
                    "<path d=\"M%.1f %.1fL%.1f %.1fL%.1f %.1fZ\" fill=\"none\" stroke=\"#888\"/>\n",
                    picture_x(&s, m, v[0]), picture_y(&s, m, v[0]), picture_x(&s, m, v[1]),
                    picture_y(&s, m, v[1]), picture_x(&s, m, v[2]), picture_y(&s, m, v[2]));
        }
        for (size_t k = 0; k < 3 * (size_t)m->n_faces; k++) { /* repeats are harmless */
            print_vertex(f, &s, m, m->faces[k], kind != NULL ? kind[m->faces[k]] : -1);
        }
        fprintf(f, "</svg>\n");
    }
    return f != NULL && output_close(f, message, message_size);
}

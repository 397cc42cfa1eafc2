/* picture.c: raster pictures in memory: lines, disks, boxes, scaling */
#include "picture.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

bool picture_create(picture *p, int width, int height, rgb background) {
    memset(p, 0, sizeof *p);
    if (width < 1 || height < 1 || width > 16384 || height > 16384) {
        return false;
    }
    size_t count = (size_t)width * (size_t)height;
    p->at = (rgb *)malloc(count * sizeof *p->at);
    if (p->at == NULL) {
        return false;
    }
    p->width = width;
    p->height = height;
    for (size_t k = 0; k < count; k++) {
        p->at[k] = background;
    }
    return true;
}

void picture_free(picture *p) {
    if (p != NULL) {
        free(p->at);
        memset(p, 0, sizeof *p);
    }
}

/* The first pixel whose center is at or right of x, clamped to 0..size. */
static int first_pixel(double x, int size) {
    double k = ceil(x - 0.5);
    return !(k > 0) ? 0 : k >= size ? size : (int)k;
}

/* Draws a line with round ends. Along its rim the part of the color falls from 1 to 0 over a
 * distance of `rim`. */
static void draw_line(picture *p, const double from[2], const double to[2], double width,
                      double rim, rgb color) {
    const double r = 0.5 * width, reach = r + 0.5 * rim;
    const double x0 = from[0], y0 = from[1], x1 = to[0], y1 = to[1];
    double dx = x1 - x0, dy = y1 - y0;
    double length2 = dx * dx + dy * dy;
    if (!(length2 <= 1e20)) {
        return;
    }
    int left = first_pixel(fmin(x0, x1) - reach, p->width);
    int right = first_pixel(fmax(x0, x1) + reach, p->width);
    int top = first_pixel(fmin(y0, y1) - reach, p->height);
    int bottom = first_pixel(fmax(y0, y1) + reach, p->height);
    for (int y = top; y < bottom; y++) {
        for (int x = left; x < right; x++) {
            double px = x + 0.5 - x0, py = y + 0.5 - y0;
            double t = length2 > 0 ? (px * dx + py * dy) / length2 : 0;
            t = t < 0 ? 0 : t > 1 ? 1 : t;
            px -= t * dx;
            py -= t * dy;
            rgb *at = &p->at[(size_t)y * (size_t)p->width + (size_t)x];
            if (rim > 0) {
                double inside = (r - hypot(px, py)) / rim + 0.5;
                *at = color_mix(*at, color, fmax(0, fmin(1, inside)));
            } else if (px * px + py * py <= r * r) {
                *at = color;
            }
        }
    }
}

void picture_line(picture *p, double x0, double y0, double x1, double y1, double width, rgb color) {
    const double from[2] = {x0, y0}, to[2] = {x1, y1};
    draw_line(p, from, to, width, 0, color);
}

void picture_stroke(picture *p, double x0, double y0, double x1, double y1, double width,
                    rgb color) {
    const double from[2] = {x0, y0}, to[2] = {x1, y1};
    draw_line(p, from, to, width, 1, color);
}

void picture_disk(picture *p, double x, double y, double radius, rgb color) {
    picture_line(p, x, y, x, y, 2 * radius, color);
}

void picture_box(picture *p, double x0, double y0, double x1, double y1, rgb color) {
    int left = first_pixel(x0, p->width), right = first_pixel(x1, p->width);
    int bottom = first_pixel(y1, p->height);
    for (int y = first_pixel(y0, p->height); y < bottom; y++) {
        for (int x = left; x < right; x++) {
            p->at[(size_t)y * (size_t)p->width + (size_t)x] = color;
        }
    }
}

void picture_shrink(picture *p, int factor) {
    int width = p->width / factor, height = p->height / factor, area = factor * factor;
    for (int y = 0; y < height; y++) {
        for (int x = 0; x < width; x++) {
            int r = area / 2, g = area / 2, b = area / 2;
            for (int v = 0; v < factor; v++) {
                const rgb *row = p->at + (size_t)(y * factor + v) * (size_t)p->width + x * factor;
                for (int u = 0; u < factor; u++) {
                    r += row[u].r;
                    g += row[u].g;
                    b += row[u].b;
                }
            }
            rgb mean = {(unsigned char)(r / area), (unsigned char)(g / area),
                        (unsigned char)(b / area)};
            /* In place: a pixel is written only after all of its sources were read. */
            p->at[(size_t)y * (size_t)width + (size_t)x] = mean;
        }
    }
    p->width = width;
    p->height = height;
}

void picture_paste(picture *p, const picture *from, int x, int y) {
    for (int v = 0; v < from->height; v++) {
        for (int u = 0; u < from->width; u++) {
            if (x + u >= 0 && x + u < p->width && y + v >= 0 && y + v < p->height) {
                p->at[(size_t)(y + v) * (size_t)p->width + (size_t)(x + u)] =
                    from->at[(size_t)v * (size_t)from->width + (size_t)u];
            }
        }
    }
}

/* render_layers.c: what a cell of a picture shows of many faces: areas and colors, nearest first */
#include "render_layers.h"

#include <math.h>
#include <string.h>

static const float same_depth = 0.02f; /* widths of a cell */
static const float all = 0.999f;       /* of a cell, but for rounding */

static int samples(unsigned mask) {
    int count = 0;
    for (; mask != 0; mask &= mask - 1) {
        count++;
    }
    return count;
}

/* How much of a layer's area is beside `mask`, by its samples. */
static float area_beside(const render_layer *l, unsigned mask) {
    int own = samples(l->mask);
    return own == 0 ? l->area : l->area * (float)samples(l->mask & ~mask) / (float)own;
}

bool render_cell_hides(const render_cell *cell, double depth) {
    for (int k = 0; k < cell->count; k++) {
        if (cell->layer[k].area >= all) {
            return cell->layer[k].far > (float)depth + same_depth;
        }
    }
    return false;
}

static void mix(render_layer *l, float weight, const render_layer *other, float other_weight) {
    float sum = weight + other_weight;
    for (int c = 0; c < 3 && sum > 0; c++) {
        l->color[c] = (weight * l->color[c] + other_weight * other->color[c]) / sum;
    }
    l->near = fmaxf(l->near, other->near);
    l->far = fminf(l->far, other->far);
}

/* Joins a layer with another one in the same depth: both are seen. */
static void join(render_layer *l, const render_layer *other) {
    mix(l, l->weight, other, other->weight);
    l->area = fminf(1, l->area + area_beside(other, l->mask));
    l->weight += other->weight;
    l->mask |= other->mask;
}

/* Removes layer k. */
static void drop(render_cell *cell, int k) {
    render_layer *l = &cell->layer[k];
    cell->count--;
    memmove(l, l + 1, (size_t)(cell->count - k) * sizeof *l);
}

/* Joins layer k with the one behind it, of which only what is beside layer k is seen. */
static void join_next(render_cell *cell, int k) {
    render_layer *l = &cell->layer[k], *behind = l + 1;
    float seen = fminf(1 - l->area, area_beside(behind, l->mask));
    mix(l, l->area, behind, seen);
    l->area += seen;
    l->weight = l->area;
    l->mask |= behind->mask;
    drop(cell, k + 1);
}

/* The first of the two layers that are closest to each other. */
static int closest_layers(const render_cell *cell) {
    int closest = 0;
    for (int k = 1; k + 1 < cell->count; k++) {
        const render_layer *l = &cell->layer[k], *best = &cell->layer[closest];
        closest = l[0].far - l[1].near < best[0].far - best[1].near ? k : closest;
    }
    return closest;
}

void render_cell_add(render_cell *cell, double area, uint16_t mask, double depth, rgb color) {
    const render_layer added = {(float)depth,
                                (float)depth,
                                (float)area,
                                (float)area,
                                {(float)color.r, (float)color.g, (float)color.b},
                                mask};
    int at = 0;
    while (at < cell->count && cell->layer[at].far > added.near + same_depth) {
        at++;
    }
    render_layer *l = &cell->layer[at];
    if (at == cell->count || l->near < added.far - same_depth) {
        memmove(l + 1, l, (size_t)(cell->count - at) * sizeof *l);
        *l = added;
        cell->count++;
        if (cell->count > RENDER_LAYERS) {
            join_next(cell, closest_layers(cell));
        }
        return;
    }
    join(l, &added);
    while (at + 1 < cell->count && l[1].near >= added.far - same_depth) {
        join(l, &l[1]); /* the face is the bridge between them */
        drop(cell, at + 1);
    }
}

rgb render_cell_color(const render_cell *cell, rgb background, double *depth) {
    float sum[3] = {0, 0, 0}, covered = 0;
    unsigned mask = 0;
    rgb out;
    *depth = -HUGE_VAL;
    if (cell->count == 0) {
        return background;
    }
    for (int k = 0; k < cell->count && covered < 1; k++) {
        const render_layer *l = &cell->layer[k];
        float seen = fminf(1 - covered, area_beside(l, mask));
        for (int c = 0; c < 3; c++) {
            sum[c] += seen * l->color[c];
        }
        covered += seen;
        mask |= l->mask;
        if (covered >= 0.5f && *depth == -HUGE_VAL) {
            *depth = l->near;
        }
    }
    const float rest = covered >= all ? 0 : 1 - covered, scale = rest > 0 ? 1 : 1 / covered;
    out.r = (unsigned char)fminf(255, scale * sum[0] + rest * background.r + 0.5f);
    out.g = (unsigned char)fminf(255, scale * sum[1] + rest * background.g + 0.5f);
    out.b = (unsigned char)fminf(255, scale * sum[2] + rest * background.b + 0.5f);
    return out;
}

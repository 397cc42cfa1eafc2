/* render_layers.h: what a cell of a picture shows of many faces: areas and colors, nearest first */
#ifndef TOOLS_RENDER_LAYERS_H
#define TOOLS_RENDER_LAYERS_H

#include <stdbool.h>
#include <stdint.h>

#include "tools/mesh/rgb.h"

enum { RENDER_LAYERS = 4 };

/** Faces of one cell that are about equally far away. */
typedef struct render_layer {
    float near; /* the depths of its faces: larger is nearer */
    float far;
    float area;     /* fraction of the cell that it covers */
    float weight;   /* sum of the areas of its faces; more than area if faces coincide */
    float color[3]; /* mean, 0..255 */
    uint16_t mask;  /* which of the 4 x 4 samples of the cell it covers */
} render_layer;

/** The layers of one cell, nearest first; all zero: none. */
typedef struct render_cell {
    int count;                             /* beside the first layer, which is often the only one */
    render_layer layer[RENDER_LAYERS + 1]; /* the last one only while a face is added */
} render_cell;

/** Whether a nearer layer covers all of the cell, so that a face at this depth is not seen. */
bool render_cell_hides(const render_cell *cell, double depth);

/** Adds the part of a face. Faces whose depths differ from one to the next by at most a fiftieth of
 *  the width of a cell are one layer, and each has its share of the color: two faces in the same
 *  place give the mean of their colors, whatever rounding says about which is nearer. If there are
 *  too many layers, the two with the smallest distance become one.
 *
 *  area   [in]  0..1.
 *  depth  [in]  in widths of a cell.
 */
void render_cell_add(render_cell *cell, double area, uint16_t mask, double depth, rgb color);

/** The color of the cell over a background. The samples decide how much of a layer the nearer ones
 *  hide; layers too thin to have a sample are assumed to be beside the nearer ones.
 *
 *  depth  [out]  of the layer with which half of the cell is covered; -HUGE_VAL if none is.
 */
rgb render_cell_color(const render_cell *cell, rgb background, double *depth);

#endif

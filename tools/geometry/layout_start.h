/* layout_start.h: layouts with the boundary on a circle: harmonic, or without flipped faces */
#ifndef TOOLS_LAYOUT_START_H
#define TOOLS_LAYOUT_START_H

#include "tools/mesh/sheet.h"

/** The boundary of a disk with holes. */
typedef struct layout_boundary {
    sl_int n_loops;
    sl_int *vertex; /* loop k is vertex[begin[k]] .. vertex[begin[k + 1] - 1], the surface on its
                       left */
    sl_int *begin;
    sl_int outer; /* the loop that is longest in space */
} layout_boundary;

/** Finds the boundary of a sheet of one part; release with layout_boundary_free. False: out of
 *  memory. */
bool layout_boundary_find(layout_boundary *out, const sheet *s);
void layout_boundary_free(layout_boundary *b);

typedef enum layout_weights {
    WEIGHTS_COTANGENT, /* harmonic; other loops are free */
    WEIGHTS_POSITIVE,  /* cotangents, but at least 0.01 and at most 100 */
    WEIGHTS_EQUAL
} layout_weights;

/** Puts the outer loop on a circle, by edge lengths, and each other vertex at the weighted mean of
 *  its neighbors. With positive weights, holes are filled by a vertex each, and by the theorem of
 *  Tutte no face is flipped, as far as digits suffice.
 *
 *  uv  [out]  2 n_vertices of s->m.
 *  Returns  SL_OK; SL_ERR_MEMORY; as sl_fixed_create and sl_fixed_solve.
 *  Source   Tutte: How to draw a graph, 1963; Eck et al.: Multiresolution analysis of arbitrary
 *           meshes, 1995.
 */
sl_status layout_on_circle(double *uv, const sheet *s, const layout_boundary *b,
                           layout_weights weights);

#endif

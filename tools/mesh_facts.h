/* mesh_facts.h: what can be said about a triangle mesh: components, borders, faults, angles */
#ifndef TOOLS_MESH_FACTS_H
#define TOOLS_MESH_FACTS_H

#include <stdbool.h>

#include "mesh.h"

typedef struct mesh_facts {
    sl_int used;          /* vertices that a face uses */
    sl_off edges;         /* counted once each; edges between one vertex and itself are none */
    sl_int components;    /* of the used vertices, joined by edges */
    sl_off border_edges;  /* of one face */
    sl_off fan_edges;     /* of three or more: not manifold */
    sl_off twisted_edges; /* of two faces that run along it in the same direction */
    sl_int border_loops;  /* connected pieces of the border */
    sl_int pinched;       /* used vertices whose faces form more than one fan: not manifold */
    sl_int repeated;      /* faces with a vertex twice */
    sl_int flat;          /* faces without area, the repeated ones aside */
    sl_off euler;         /* used - edges + faces */
    double area;
    double edge_shortest, edge_mean, edge_longest;
    double angle_smallest,
        angle_largest;      /* degrees, over faces with area; NaN where there are none */
    double low[3], high[3]; /* box of the used vertices */
} mesh_facts;

/** Counts and measures.
 *
 *  Returns  true; false: out of memory, or a face index out of range.
 *  Cost     O(faces log faces).
 *  Example  tests/test_tools_surface.c
 */
bool mesh_facts_find(mesh_facts *out, const mesh *m);

#endif

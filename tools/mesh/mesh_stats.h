/* mesh_stats.h: counts and measures of a triangle mesh: components, boundary, defects, angles */
#ifndef TOOLS_MESH_STATS_H
#define TOOLS_MESH_STATS_H

#include <stdbool.h>

#include "mesh.h"

/** Counts and measures. An edge is an unordered pair of different vertices that a face joins. */
typedef struct mesh_stats {
    sl_int used_vertices;         /* vertices of at least one face */
    sl_off edges;                 /* each counted once */
    sl_int components;            /* connected components of the used vertices */
    sl_off boundary_edges;        /* edges with one face */
    sl_off nonmanifold_edges;     /* edges with three or more faces */
    sl_off inconsistent_edges;    /* edges with two faces of opposite orientation */
    sl_int boundary_loops;        /* connected components of the boundary */
    sl_int nonmanifold_vertices;  /* used vertices whose faces form more than one fan */
    sl_int repeated_vertex_faces; /* faces that use a vertex twice */
    sl_int zero_area_faces;       /* other faces without area */
    sl_off euler;                 /* used_vertices - edges + n_faces */
    double area;
    double edge_min, edge_mean, edge_max; /* edge lengths; 0 without edges */
    double angle_min, angle_max;          /* degrees, over faces with area; NaN if there are none */
    double box_min[3], box_max[3];        /* bounding box of the used vertices */
} mesh_stats;

/** Computes all of them.
 *
 *  Returns  true; false: a face index is out of range, out of memory.
 *  Cost     O(faces log faces).
 *  Example  tests/tools/test_surface.c
 */
bool mesh_stats_compute(mesh_stats *out, const mesh *m);

#endif

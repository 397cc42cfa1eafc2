/* surface_search.h: inside of surface_paths.h: the searches and the paths that they have found */
#ifndef TOOLS_SURFACE_SEARCH_H
#define TOOLS_SURFACE_SEARCH_H

#include "surface_paths.h"

#include "tools/mesh/int_list.h"
#include "tools/mesh/path_heap.h"

/* Points are the vertices, then `points` of each edge, from its lower to its higher vertex. */
struct surface_search {
    const incidence *inc;
    int points;
    sl_int n_edges;
    sl_int *edge_of; /* 3 n_faces: the edge opposite to a corner */
    sl_off *begin;   /* n_edges + 1: the sides of an edge are side[begin[e]] .. */
    sl_int *side;    /* 3 n_faces: corners opposite to edges */
    double *length;  /* of the shortest path so far, by point */
    sl_int *origin;  /* the position of its source, by point */
    int64_t *parent; /* the point before the last one of the path, by point; -1: a source */
    sl_int *across;  /* the face of the last step, by point */
    int64_t *found;  /* the points with a path, in the order of discovery */
    size_t n_found;
    double limit;
    int_list curve;          /* edges whose points are sources */
    unsigned char *is_curve; /* n_edges; NULL: no curve */
    path_heap heap;
    /* of surface_search_straighten, n_vertices each; NULL: not needed yet */
    double *angle;    /* the sum of the angles around a vertex; INFINITY on the border */
    double *straight; /* lengths; INFINITY where no path leads */
};

/* The edge from a to b; -1: there is none. */
sl_int surface_search_edge(const surface_search *s, sl_int a, sl_int b);

/* The ends of an edge, the lower one first. */
void surface_search_ends(sl_int ends[2], const surface_search *s, sl_int edge);

/* Where a point is. */
void surface_search_place(double x[3], const surface_search *s, int64_t point);

#endif

/* mesh_build.h: a mesh while a reader fills it: growing arrays, polygons cut into fans, indices checked */
#ifndef TOOLS_MESH_BUILD_H
#define TOOLS_MESH_BUILD_H

#include "input.h"
#include "mesh.h"

/** The mesh so far. The arrays double when full, so memory follows the data and not the counts of a header. */
typedef struct mesh_build {
    input *in;
    mesh made;
    size_t vertex_room;
    size_t face_room;
    sl_int *corners; /* of the polygon at hand */
    size_t n_corners;
    size_t corner_room;
    sl_int largest; /* index of any face so far, -1: none; faces may come before their vertices */
    int64_t largest_line; /* where it stood; 0 where there are no lines */
    int64_t largest_face; /* the polygon it stood in, counted from 0 */
    int64_t polygons;
} mesh_build;

/** Adds a vertex; refuses coordinates that are not finite. All of these set in's message when they refuse. */
bool mesh_build_vertex(mesh_build *b, double x, double y, double z);

/** Adds a corner, 0 or more, to the polygon at hand. */
bool mesh_build_corner(mesh_build *b, int64_t vertex);

/** Ends the polygon at hand: three corners or more become a fan. */
bool mesh_build_polygon(mesh_build *b);

/* The formats; each reads all of b->in into b. */
bool mesh_read_obj(mesh_build *b);
bool mesh_read_off(mesh_build *b);
bool mesh_read_ply(mesh_build *b);
bool mesh_read_stl(mesh_build *b);

#endif

/* sheet.h: the faces of a mesh as oriented parts, each a manifold with a boundary */
#ifndef TOOLS_SHEET_H
#define TOOLS_SHEET_H

#include <stdbool.h>

#include "mesh.h"

/** Faces of a mesh, glued along edges; whatever is not glued is a boundary.
 *
 *  An edge with two faces is glued, unless that would make a Moebius strip. Edges with three or
 *  more faces are not, except for two of them that would else be the sides of a slit. A vertex of
 *  the sheet is a fan of faces that are glued around it, so that a vertex of the mesh where the
 *  sheet is cut, or where two surfaces touch, becomes several. Faces with a repeated vertex are
 *  left out. Faces are turned over so that neighbors agree; in most parts the first face keeps its
 *  orientation.
 *
 *  Side 3 f + k of face f is opposite to its corner k, as in edge_sides.h.
 */
typedef struct sheet {
    mesh m;            /* the faces, with the vertices of the sheet */
    sl_int *corner;    /* 3 m.n_faces: the corner, 3 face + 0..2, of the mesh that each is */
    sl_int *vertex;    /* m.n_vertices: the vertex of the mesh */
    sl_int *mate;      /* 3 m.n_faces: the side that each side is glued to, or -1 */
    sl_int *part;      /* m.n_faces: the connected part of each */
    sl_int n_parts;    /* in the order of their first faces */
    sl_int left_out;   /* faces with a repeated vertex */
    const mesh *whole; /* borrowed */
} sheet;

/** Glues the faces of a mesh.
 *
 *  out    [out]  release with sheet_free; all zero on error.
 *  whole  [in]   borrowed, must outlive out.
 *  taken  [in]   n_faces of it, 1 for the faces to take; NULL: all.
 *  Returns  true; false: out of memory, or a corner that is no vertex.
 *  Cost     O(n_faces log n_faces).
 *  Example  tests/tools/test_sheet.c
 */
bool sheet_create(sheet *out, const mesh *whole, const unsigned char *taken);

/** Releases the arrays and sets s to all zero. */
void sheet_free(sheet *s);

/** Numbers the vertices anew after sides have been separated (mate = -1 for both). False: out of
 *  memory. */
bool sheet_renumber(sheet *s);

/** The side that follows a boundary side along the boundary, the surface on its left. */
sl_int sheet_next_boundary(const sheet *s, sl_int side);

/** The vertices at which a side begins and ends. */
sl_int sheet_from(const sheet *s, sl_int side);
sl_int sheet_to(const sheet *s, sl_int side);

/** Part `part` as a sheet of its own, with the same `whole`. False: out of memory. */
bool sheet_take_part(sheet *out, const sheet *s, sl_int part);

/** The boundary of a sheet: its vertices, loop after loop.
 *
 *  loops  [out]  room for 3 n_faces: boundary vertices, the surface on their left.
 *  begin  [out]  room for 3 n_faces + 1: loop k is loops[begin[k]] .. loops[begin[k + 1] - 1].
 *  Returns  the number of loops; -1: out of memory.
 */
sl_int sheet_boundary(const sheet *s, sl_int *loops, sl_int *begin);

#endif

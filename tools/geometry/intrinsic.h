/* intrinsic.h: intrinsic Delaunay triangulations of a surface, also one that is not manifold */
#ifndef TOOLS_INTRINSIC_H
#define TOOLS_INTRINSIC_H

#include "tools/mesh/mesh.h"

/** A triangulation of the surface of a mesh with the same vertices, whose edges are straight on the
 *  surface and given by their lengths alone.
 *
 *  Edges are flipped until no two angles opposite to an edge sum to more than pi. All weights of
 *  the cotangent Laplacian are then 0 or more, and M + t L has a non-negative inverse: heat is
 *  never negative [BS07]. First, the same small number is added to all lengths, so that in each
 *  face two edges exceed the third by at least 1e-5 mean lengths: faces without area get one
 *  [SC20].
 *
 *  Where an edge has more than two faces, or two of different orientation, or where an edge at the
 *  boundary has a negative weight, which no flip can change, the faces are glued as a double cover:
 *  each face twice, with both orientations, so that each edge of the cover joins two faces [SC20].
 *  Its Laplacian, halved, is that of the surface.
 *
 *  A face may have a vertex twice, and two edges may join the same vertices.
 *
 *  [BS07]  Bobenko, Springborn: A discrete Laplace-Beltrami operator for simplicial surfaces, 2007.
 *  [SC20]  Sharp, Crane: A Laplacian for nonmanifold triangle meshes, 2020.
 */
typedef struct intrinsic {
    mesh m;          /* the vertices of the mesh, and the faces of the triangulation */
    double *lengths; /* 3 m.n_faces: of the edge opposite to each corner */
    double share;    /* of each face in areas and weights: 1, or 0.5 in a double cover */
    double added;    /* to each length */
    sl_off flips;
    sl_int left_out; /* faces of the mesh with a repeated vertex, or edges that are not finite */
    bool delaunay;   /* false: the flips were stopped */
} intrinsic;

/** Computes it.
 *
 *  out  [out]  release with intrinsic_free; all zero on error.
 *  m    [in]   needed during the call only.
 *  Returns  true; false: out of memory, a face index out of range, too many faces for a cover, or
 *           no edge has a length.
 *  Cost     O(n log n) and the flips, of which there are few on most meshes.
 *  Example  tests/tools/test_intrinsic.c
 */
bool intrinsic_create(intrinsic *out, const mesh *m);

/** Releases the arrays and sets a to all zero. */
void intrinsic_free(intrinsic *a);

/** Whether the cotangent Laplacian of a mesh is of little use: an edge has a negative weight, or a
 *  face has no area. false if out of memory.
 *
 *  negative  [out]  the number of such edges.
 *  flat      [out]  the number of faces without weights.
 */
bool intrinsic_is_needed(const mesh *m, sl_off *negative, sl_int *flat);

#endif

/* mesh_edits.h: a mesh whose edges are flipped, split and collapsed; a factor of M + t L follows */
#ifndef TOOLS_MESH_EDITS_H
#define TOOLS_MESH_EDITS_H

#include "edit_system.h"
#include "tools/mesh/remesh.h"

/** A mesh, its system, and a factor of it. The kinds of its edits:
 *
 *  EDIT_FLIP      an edge is flipped
 *  EDIT_SPLIT     an edge gets a vertex in its middle: a new row
 *  EDIT_COLLAPSE  an edge is collapsed: a row less
 *  EDIT_REMESH    all of these in a patch (remesh_vertices)
 *
 * Vertices without faces are removed by the first edit.
 */
typedef struct mesh_edits {
    double t;
    sl_int patch; /* vertices of EDIT_REMESH */
    remesh mesh;
    sl_matrix *A, *B; /* what the factor is of; the matrix after the edit, or NULL */
    sl_int *new_of;   /* rows of A: those of B; NULL without B */
    sl_symbolic *S;
    sl_factor *F;
    sl_work *W;
    sl_stats stats;  /* of the last analysis and factorization */
    uint64_t random; /* state of app_random */
} mesh_edits;

/** Assembles, analyzes and factors M + t L. Like all functions of this folder it ends the program
 *  with a message on errors.
 *
 *  out    [out]  release with mesh_edits_free.
 *  m      [in]   is copied.
 *  patch  [in]   vertices of a patch, 2 or more.
 */
void mesh_edits_create(mesh_edits *out, const mesh *m, double t, sl_int patch, uint64_t seed);

/** Releases everything and sets e to all zero. */
void mesh_edits_free(mesh_edits *e);

/** Edits the mesh at a random place and assembles the matrix. The factor does not follow yet.
 *
 *  Returns  true; false: no place was found, and nothing has changed.
 */
bool mesh_edits_edit(mesh_edits *e, edit_kind kind);

/** Analysis and factor follow the last edit. Where a new order is due, it is made. */
edit_way mesh_edits_follow(mesh_edits *e);

#endif

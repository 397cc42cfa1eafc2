/* disk_patch.h: patches that are topological disks: grown from a vertex or checked from a list */
#ifndef TOOLS_DISK_PATCH_H
#define TOOLS_DISK_PATCH_H

#include <stdbool.h>
#include <stddef.h>

#include "submesh.h"

/** A submesh whose faces form a disk. All faces have the orientation of its first face. */
typedef struct disk_patch {
    submesh p;
    sl_int n_boundary;
    sl_int *boundary; /* local boundary vertices in order; the disk lies on their left */
} disk_patch;

/** Grows a disk of up to count vertices around start, face by face in breadth-first order.
 *
 *  A face is added only if the patch remains a disk. A patch that closes around a peak meets itself
 *  there and first keeps a seam: a row of faces that are left out although all their vertices
 *  belong to the patch. The patch is then filled: the vertices that it encloses are added if they
 *  are fewer than its own and if the result is a disk without a seam. A seam around a handle
 *  remains. Faces with a repeated vertex are skipped, as are faces that would give an edge a third
 *  face.
 *
 *  out      [out]     release with disk_patch_free; all zero on error.
 *  inc      [in,out]  the mesh; its scratch is used and restored.
 *  start    [in]      a vertex of the mesh with at least one face.
 *  count    [in]      3 or more. The disk has fewer vertices if its component has, or if no further
 *                     face can be added. Vertices that are filled in come on top of count.
 *  seam     [out]     the number of faces left out between vertices of the disk; may be NULL.
 *  message  [out]     the reason on error, message_size bytes; may be NULL with message_size 0.
 *  Returns  true; false: start is out of range or has no face, count is below 3, out of memory.
 *  Cost     O(k log k) for the k faces around the vertices found.
 *  Example  tests/tools/test_disk.c
 */
bool disk_patch_grow(disk_patch *out, incidence *inc, sl_int start, sl_int count, sl_int *seam,
                     char *message, size_t message_size);

/** The disk spanned by a list of vertices: all faces whose corners are all listed.
 *
 *  Arguments as in disk_patch_grow; vertices are count vertices of the mesh.
 *  Returns  true; false: as submesh_from_vertices, or the faces do not form a disk: there are none,
 *           a listed vertex has no face in the patch, an edge has three faces, the faces form
 *           several pieces, the patch has no boundary (a closed surface) or several, it touches
 *           itself at a vertex, it has a handle, or it is a Moebius strip. The message names the
 *           offending vertices where there are any.
 */
bool disk_patch_from_vertices(disk_patch *out, incidence *inc, const sl_int *vertices, sl_int count,
                              char *message, size_t message_size);

/** The disk formed by given vertices and faces of the mesh. Errors as in
 *  disk_patch_from_vertices. */
bool disk_patch_from_faces(disk_patch *out, incidence *inc, const sl_int *vertices,
                           sl_int n_vertices, const sl_int *faces, sl_int n_faces, char *message,
                           size_t message_size);

/** Releases the arrays and sets d to all zero. */
void disk_patch_free(disk_patch *d);

#endif

/* disk.h: patches that are topological disks: grown from a vertex, or checked from a list; their boundary as a loop */
#ifndef TOOLS_DISK_H
#define TOOLS_DISK_H

#include <stdbool.h>
#include <stddef.h>

#include "part.h"

/** A part whose faces form a disk, all turned the same way (as the first face stands in the mesh). */
typedef struct disk {
    part p;
    sl_int n_boundary;
    sl_int *
        boundary; /* the vertices of the part on its boundary, in order; the disk lies to the left */
} disk;

/** Grows a disk of up to count vertices around start, face by face in breadth-first order.
 *
 *  A face is taken only if what is there stays a disk. A patch that meets itself behind a peak first keeps a seam, a row
 *  of faces left out although their vertices are in; then what it encloses (less than it has itself) is taken too, if
 *  that makes a disk without a seam. Around a handle the seam stays. Faces with a repeated vertex are passed over, and
 *  so is what would make an edge of three faces.
 *
 *  out       [out]  release with disk_free; all zero on error.
 *  around    [in,out]  its scratch is used and given back as it was.
 *  count     [in]   3 or more; the disk has fewer if the component has, or if no face can be taken any more; what it
 *                   encloses comes on top.
 *  seam      [out]  how many faces between the disk's vertices are left out; may be NULL.
 *  message   [out]  on error what is wrong; may be NULL with message_size 0.
 *  Returns  true; false: start out of range or at no face, count below 3, out of memory.
 *  Cost     O(faces around the vertices found); log of it for finding the boundary.
 *  Example  tests/test_tools_disk.c
 */
bool disk_grow(disk *out, incidence *around, sl_int start, sl_int count, sl_int *seam,
               char *message, size_t message_size);

/** The disk that a list of vertices spans, if it is one.
 *
 *  Returns  true; false: as part_span, or no disk: no faces, a vertex at no face of the patch, an edge of three faces,
 *           several pieces, no boundary (a closed surface), several boundaries, a vertex where the patch touches
 *           itself, a handle, a Moebius strip. The message names the vertices at fault where there are such.
 */
bool disk_of_list(disk *out, incidence *around, const sl_int *vertices, sl_int count, char *message,
                  size_t message_size);

/** The disk of given vertices and faces, if they form one; refuses as disk_of_list does. */
bool disk_of_faces(disk *out, incidence *around, const sl_int *vertices, sl_int n_vertices,
                   const sl_int *faces, sl_int n_faces, char *message, size_t message_size);

void disk_free(disk *d);

#endif

/* single_frame.h: coordinates in single precision, relative to the mesh if it is far away */
#ifndef TOOLS_SINGLE_FRAME_H
#define TOOLS_SINGLE_FRAME_H

#include "mesh.h"

/** A vertex at x is written as (x - center) / scale. */
typedef struct single_frame {
    double center[3]; /* of the bounding box; 0 0 0 unless that is far from the origin */
    double scale;     /* a power of 2; 1 unless single precision has no room for the mesh */
} single_frame;

/** The frame of a mesh. It is the identity where the origin is within four radii of the mesh, so
 *  that coordinates in single precision stay as they are. All coordinates are finite. */
single_frame single_frame_of(const mesh *m);

/** Whether the frame is the identity. */
bool single_frame_is_identity(const single_frame *f);

/** Number k of the 3 n_vertices coordinates of m in the frame. */
float single_frame_coordinate(const single_frame *f, const mesh *m, size_t k);

#endif

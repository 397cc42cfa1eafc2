/* thin_view.h: a camera for a mesh that is much longer than wide, by its principal axes */
#ifndef TOOLS_THIN_VIEW_H
#define TOOLS_THIN_VIEW_H

#include <stdbool.h>

#include "tools/mesh/mesh.h"

/** Turns a camera so that a long, thin mesh lies along the diagonal of the picture, and shows the
 *  wider one of its sides. Along an edge of the picture it would be drawn as a bare line.
 *
 *  axes   [in,out]  rows: right, up, toward the camera; the signs of the new axes follow the old
 *                   ones.
 *  slope  [in]      height of the picture divided by its width.
 *  Returns  whether the mesh is more than 10 times as long as wide, by the deviations of the
 *           corners of faces along its principal axes; if not, the axes stay.
 *  Cost     O(faces).
 *  Example  tests/tools/test_camera.c
 */
bool thin_view_turn(double axes[3][3], const mesh *m, double slope);

#endif

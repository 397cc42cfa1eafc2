/* upward.h: which coordinate axis of a mesh points upward, guessed from its extent */
#ifndef TOOLS_UPWARD_H
#define TOOLS_UPWARD_H

#include "camera.h"
#include "tools/mesh/mesh.h"

/** Guesses which of the two axes that mesh files use points upward, y or z. It is z if the mesh
 *  does not stand on the plane y = 0, and if it
 *  - stands on the plane z = 0, or
 *  - is a low relief over the x-y plane, as landscapes are: at most two fifths as high as it is
 *    wide and deep, and all faces look to the same side, or
 *  - is at least one and a half times as long along z as along x and along y.
 *  To stand on a plane is to have 0 as the lowest coordinate, and to be around 0 along the others.
 *
 *  reason  [out]  for z: what the guess follows from, a clause such as "the mesh stands on z = 0";
 *                 for y: NULL.
 *  Returns  CAMERA_UP_Z or CAMERA_UP_Y. Vertices without a face do not count. O(n_faces).
 */
camera_up upward_of(const mesh *m, const char **reason);

#endif

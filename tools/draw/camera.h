/* camera.h: the axes of a camera from its azimuth, its elevation and the upward axis of the mesh */
#ifndef TOOLS_CAMERA_H
#define TOOLS_CAMERA_H

/** The coordinate axis that points upward in the picture. */
typedef enum camera_up { CAMERA_UP_Y = 0, CAMERA_UP_X, CAMERA_UP_Z } camera_up;

/** Computes the right-handed orthonormal axes of a camera.
 *
 *  At azimuth 0 and elevation 0 the camera looks
 *
 *      up  from  right in the picture
 *      y   +z    +x
 *      x   -z    +y
 *      z   -y    +x
 *
 *  axes       [out]  rows: right, up, toward the camera, in coordinates of the mesh.
 *  azimuth    [in]   degrees around the upward axis; 90 is the view from the right axis above.
 *  elevation  [in]   degrees above the horizon, -90..90.
 */
void camera_axes(double axes[3][3], camera_up up, double azimuth, double elevation);

/** The inverse of camera_axes: the azimuth and elevation of a camera in `direction`, seen from the
 *  mesh. A direction that is zero or not finite leaves both unchanged. */
void camera_angles(double *azimuth, double *elevation, camera_up up, const double direction[3]);

#endif

/* camera.c: the axes of a camera from its azimuth, its elevation and the upward axis of the mesh */
#include "camera.h"

#include <math.h>
#include <string.h>

static const double degree = 3.14159265358979323846 / 180;

/* The coordinate axes that, at azimuth and elevation 0, point up, right and (times sign) to the
 * camera. right x up = sign * front, so that no view is mirrored. */
typedef struct frame {
    int up, right, front;
    double sign;
} frame;

static frame frame_of(camera_up up) {
    static const frame frames[3] = {{1, 0, 2, 1}, {0, 1, 2, -1}, {2, 0, 1, -1}}; /* y, x, z */
    return frames[up];
}

void camera_axes(double axes[3][3], camera_up up, double azimuth, double elevation) {
    frame f = frame_of(up);
    double ca = cos(azimuth * degree), sa = sin(azimuth * degree);
    double ce = cos(elevation * degree), se = sin(elevation * degree);
    memset(axes, 0, 9 * sizeof(double));
    axes[0][f.right] = ca;
    axes[0][f.front] = -f.sign * sa;
    axes[1][f.up] = ce;
    axes[1][f.right] = -se * sa;
    axes[1][f.front] = -f.sign * se * ca;
    axes[2][f.up] = se;
    axes[2][f.right] = ce * sa;
    axes[2][f.front] = f.sign * ce * ca;
}

void camera_angles(double *azimuth, double *elevation, camera_up up, const double direction[3]) {
    frame f = frame_of(up);
    double length = hypot(hypot(direction[0], direction[1]), direction[2]);
    if (length > 0 && isfinite(length)) {
        *azimuth = atan2(direction[f.right], f.sign * direction[f.front]) / degree;
        *elevation = asin(direction[f.up] / length) / degree;
    }
}

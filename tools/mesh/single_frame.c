/* single_frame.c: coordinates in single precision, relative to the mesh if it is far away */
#include "single_frame.h"

#include <math.h>

single_frame single_frame_of(const mesh *m) {
    enum { FAR = 4, LEAST = -60, MOST = 100 }; /* in radii; exponents of the radius */
    single_frame f = {{0, 0, 0}, 1};
    double low[3] = {0, 0, 0}, high[3] = {0, 0, 0}, radius = 0, largest = 0;
    int exponent = 0;
    for (size_t k = 0; k < 3 * (size_t)m->n_vertices; k++) {
        low[k % 3] = k < 3 ? m->xyz[k] : fmin(low[k % 3], m->xyz[k]);
        high[k % 3] = k < 3 ? m->xyz[k] : fmax(high[k % 3], m->xyz[k]);
    }
    for (int d = 0; d < 3; d++) {
        radius = fmax(radius, 0.5 * high[d] - 0.5 * low[d]);
        largest = fmax(largest, fmax(fabs(low[d]), fabs(high[d])));
    }
    if (largest > FAR * radius) {
        for (int d = 0; d < 3; d++) {
            f.center[d] = 0.5 * low[d] + 0.5 * high[d];
        }
        largest = 0;
        for (int d = 0; d < 3; d++) {
            largest = fmax(largest, fmax(f.center[d] - low[d], high[d] - f.center[d]));
        }
    }
    (void)frexp(largest, &exponent);
    if (largest > 0 && (exponent < LEAST || exponent > MOST)) {
        f.scale = ldexp(1, exponent < -1000 ? -1000 : exponent > 1000 ? 1000 : exponent);
    }
    return f;
}

bool single_frame_is_identity(const single_frame *f) {
    return f->scale == 1 && f->center[0] == 0 && f->center[1] == 0 && f->center[2] == 0;
}

float single_frame_coordinate(const single_frame *f, const mesh *m, size_t k) {
    return (float)((m->xyz[k] - f->center[k % 3]) / f->scale);
}

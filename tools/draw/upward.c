/* upward.c: which coordinate axis of a mesh points upward, guessed from its extent */
#include "upward.h"

#include <math.h>
#include <stdbool.h>
#include <stddef.h>

typedef struct extent {
    double low[3], high[3];
} extent;

static extent extent_of(const mesh *m) {
    extent e;
    for (int d = 0; d < 3; d++) {
        e.low[d] = HUGE_VAL;
        e.high[d] = -HUGE_VAL;
        for (size_t k = 0; k < 3 * (size_t)m->n_faces; k++) {
            const double x = m->xyz[3 * (size_t)m->faces[k] + (size_t)d];
            e.low[d] = fmin(e.low[d], x);
            e.high[d] = fmax(e.high[d], x);
        }
    }
    return e;
}

static double length(const extent *e, int axis) {
    return e->high[axis] - e->low[axis];
}

/* Whether the lowest coordinate is 0, up to a thousandth, and 0 is in between along the other axes:
 * what was only moved to positive coordinates has 0 at the end of several axes. */
static bool stands_on(const extent *e, int axis) {
    bool around = true;
    for (int d = 0; d < 3; d++) {
        const double inside = 0.01 * length(e, d);
        around = around && (d == axis || (e->low[d] < -inside && e->high[d] > inside));
    }
    return around && fabs(e->low[axis]) <= 1e-3 * length(e, axis);
}

/* Whether no two faces look to different sides of the x-y plane. */
static bool is_over_plane(const mesh *m) {
    bool above = false, below = false;
    for (size_t f = 0; f < (size_t)m->n_faces; f++) {
        const sl_int *v = m->faces + 3 * f;
        const double *a = m->xyz + 3 * (size_t)v[0], *b = m->xyz + 3 * (size_t)v[1],
                     *c = m->xyz + 3 * (size_t)v[2];
        const double side = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
        above = above || side > 0;
        below = below || side < 0;
    }
    return above != below;
}

camera_up upward_of(const mesh *m, const char **reason) {
    const extent e = extent_of(m);
    const double x = length(&e, 0), y = length(&e, 1), z = length(&e, 2);
    *reason = NULL;
    if (!(z > 0) || !isfinite(x + y + z) || stands_on(&e, 1)) {
        return CAMERA_UP_Y;
    }
    if (stands_on(&e, 2)) {
        *reason = "the mesh stands on z = 0";
    } else if (z <= 0.4 * fmin(x, y) && is_over_plane(m)) {
        *reason = "the mesh is a relief over the x-y plane";
    } else if (z >= 1.5 * fmax(x, y)) {
        *reason = "the mesh is longest along z";
    }
    return *reason != NULL ? CAMERA_UP_Z : CAMERA_UP_Y;
}

/* look.c: from where to look at a mesh so that some of its faces are in front */
#include "look.h"

#include <math.h>

void look_at_faces(char *text, app_output *o, const mesh *m, const sl_int *faces, sl_int count) {
    /* upwards, to the right, to the front, at azimuth 0 (render.h); sign: the front of z upwards is backwards */
    static const struct {
        int up, right, front;
        double sign;
    } axes[3] = {{1, 0, 2, 1}, {0, 1, 2, 1}, {2, 0, 1, -1}};
    double normal[3] = {0, 0, 0};
    render_view view;
    app_view(&view, o);
    for (sl_int i = 0; i < (faces != NULL ? count : m->n_faces); i++) {
        const sl_int *f = m->faces + 3 * (size_t)(faces != NULL ? faces[i] : i);
        const double *a = m->xyz + 3 * (size_t)f[0], *b = m->xyz + 3 * (size_t)f[1];
        const double *c = m->xyz + 3 * (size_t)f[2];
        for (int k = 0; k < 3; k++) {
            int p = (k + 1) % 3, q = (k + 2) % 3;
            normal[k] += (b[p] - a[p]) * (c[q] - a[q]) - (b[q] - a[q]) * (c[p] - a[p]);
        }
    }
    double right = normal[axes[view.up].right], up = normal[axes[view.up].up];
    double front = axes[view.up].sign * normal[axes[view.up].front];
    double across = hypot(right, front);
    if (o->view == NULL && isfinite(across) && isfinite(up) && (across > 0 || up != 0)) {
        const double degrees = 180 / 3.14159265358979323846;
        (void)snprintf(text, LOOK_TEXT, "%.4f,%.4f", degrees * atan2(right, front),
                       degrees * atan2(up, across));
        o->view = text;
    }
}

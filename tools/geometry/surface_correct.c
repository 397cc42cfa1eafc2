/* surface_correct.c: what the lengths of short paths say about distances */
#include <math.h>
#include <string.h>

#include "surface_paths.h"

surface_correction surface_paths_correct(double *distance, const sl_int *vertices, sl_int n,
                                         const double *straight, double slack) {
    surface_correction c;
    memset(&c, 0, sizeof c);
    for (sl_int k = 0; k < n; k++) {
        const double path = straight[vertices[k]], d = distance[k];
        if (isnan(d) || !isfinite(path)) {
            continue;
        }
        if (d <= path && d >= path - slack && d >= 0) {
            c.kept++;
            continue;
        }
        c.raised += d < path;
        c.lowered += d > path;
        c.largest = fmax(c.largest, fabs(path - d));
        distance[k] = path;
    }
    return c;
}

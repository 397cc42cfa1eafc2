/* surface_correct.c: what the lengths of short paths say about distances */
#include <math.h>
#include <string.h>

#include "surface_paths.h"

surface_correction surface_paths_correct(double *distance, const sl_int *vertices, sl_int n,
                                         const surface_lengths *u, double slack) {
    surface_correction c;
    sl_int counted = 0;
    memset(&c, 0, sizeof c);
    for (sl_int k = 0; k < n; k++) {
        const sl_int v = vertices[k];
        double high = u->three[v], d = distance[k];
        /* without u1, which is longer than its search followed, only high is known */
        double gap = isfinite(u->one[v]) ? u->one[v] - high : 2 * high;
        double low = high - 0.5 * gap - slack;
        if (isnan(d) || !isfinite(high)) {
            continue;
        }
        if (u->flat[v] <= high * (1 + 1e-12)) {
            const bool agree = u->flat[v] - u->mixed[v] <= slack;
            low = agree ? u->mixed[v] - slack : fmax(low, u->mixed[v] - slack);
            high = fmin(high, u->flat[v] + slack);
            gap = high - low;
        }
        double moved = fmax(0, fmax(low, fmin(high, d)));
        c.raised += moved > d;
        c.lowered += moved < d;
        c.largest = fmax(c.largest, fabs(moved - d));
        double bound = fmin(gap, high) + slack;
        c.mean_width += bound;
        c.largest_width = fmax(c.largest_width, bound);
        counted++;
        distance[k] = moved;
    }
    c.mean_width = counted > 0 ? c.mean_width / counted : 0;
    return c;
}

/* distortion.c: measures how a planar layout of a patch distorts angles, areas and lengths */
#include "distortion.h"

#include <math.h>
#include <string.h>

#include "laplacian.h"
#include "planar_triangle.h"

/* The map of face f, and its area in space. False: the face is degenerate, as in the Laplacian: the
 * singular values of its map are rounding errors. */
static bool map_of(planar_map *map, double *area, const mesh *patch, const double *uv, sl_int f) {
    const sl_int *face = patch->faces + 3 * (size_t)f;
    const double *const to[3] = {uv + 2 * (size_t)face[0], uv + 2 * (size_t)face[1],
                                 uv + 2 * (size_t)face[2]};
    planar_triangle flat = planar_triangle_of(patch, face);
    laplacian_face measure = laplacian_of_face(patch, face);
    *area = 0.5 * flat.x[1][0] * flat.x[2][1];
    return *area > 0 &&
           (measure.weight[0] != 0 || measure.weight[1] != 0 || measure.weight[2] != 0) &&
           planar_map_of(map, &flat, to);
}

distortion distortion_of(const mesh *patch, const double *uv) {
    distortion d;
    memset(&d, 0, sizeof d);
    double logs = 0, squares = 0, kept = 0, bent = 0, area;
    planar_map map;
    for (sl_int f = 0; f < patch->n_faces; f++) {
        if (!map_of(&map, &area, patch, uv, f)) {
            d.degenerate++;
            continue;
        }
        d.area += area;
        d.area_flat += area * map.sigma_max * map.sigma_min;
        bent += 0.5 * area * (map.sigma_max - map.sigma_min) * (map.sigma_max - map.sigma_min);
        d.isometric += area * ((map.sigma_max - 1) * (map.sigma_max - 1) +
                               (map.sigma_min - 1) * (map.sigma_min - 1));
        if (map.sigma_min < 0) {
            d.flipped++;
        } else if (map.sigma_min == 0) {
            d.degenerate++;
        } else {
            double scale = log(map.sigma_max * map.sigma_min),
                   ratio = map.sigma_max / map.sigma_min;
            d.angle += area * ratio;
            d.angle_ratio_max = fmax(d.angle_ratio_max, ratio);
            logs += area * scale;
            squares += area * scale * scale;
            kept += area;
        }
    }
    d.conformal = bent == 0 ? 0 : d.area_flat != 0 ? bent / d.area_flat : INFINITY;
    d.angle = kept > 0 ? d.angle / kept : INFINITY;
    d.isometric = d.area > 0 ? d.isometric / d.area : 0;
    d.area_spread = kept > 0 ? sqrt(fmax(0, squares / kept - logs / kept * (logs / kept))) : 0;
    return d;
}

void distortion_normalize(const mesh *patch, double *uv) {
    double area = 0, flat = 0, one, mean[2] = {0, 0};
    planar_map map;
    for (sl_int f = 0; f < patch->n_faces; f++) {
        if (map_of(&map, &one, patch, uv, f)) {
            area += one;
            flat += one * map.sigma_max * map.sigma_min;
        }
    }
    size_t n = (size_t)patch->n_vertices;
    for (size_t k = 0; k < 2 * n; k++) {
        mean[k % 2] += uv[k] / (double)n;
    }
    double scale = flat > 0 && isfinite(area / flat) ? sqrt(area / flat) : 1;
    for (size_t k = 0; k < 2 * n; k++) {
        uv[k] = scale * (uv[k] - mean[k % 2]);
    }
}

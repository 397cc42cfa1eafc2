/* distortion.c: what a layout of a patch in the plane does to angles and areas */
#include "distortion.h"

#include <math.h>
#include <string.h>

#include "flat_face.h"

/* The map of face f, and its area in space; false: there is none. */
static bool map_of(flat_map *map, double *area, const mesh *part, const double *uv, sl_int f) {
    const sl_int *face = part->faces + 3 * (size_t)f;
    const double *const to[3] = {uv + 2 * (size_t)face[0], uv + 2 * (size_t)face[1],
                                 uv + 2 * (size_t)face[2]};
    flat_face flat = flat_face_of(part, face);
    *area = 0.5 * flat.x[1][0] * flat.x[2][1];
    return *area > 0 && flat_face_map(map, &flat, to);
}

distortion distortion_of(const mesh *part, const double *uv) {
    distortion d;
    memset(&d, 0, sizeof d);
    double logs = 0, squares = 0, kept = 0, bent = 0, area;
    flat_map map;
    for (sl_int f = 0; f < part->n_faces; f++) {
        if (!map_of(&map, &area, part, uv, f)) {
            d.no_shape++;
            continue;
        }
        d.area += area;
        d.area_flat += area * map.large * map.small;
        bent += 0.5 * area * (map.large - map.small) * (map.large - map.small);
        d.rigid += area * ((map.large - 1) * (map.large - 1) + (map.small - 1) * (map.small - 1));
        if (map.small < 0) {
            d.flipped++;
        } else if (map.small == 0) {
            d.no_shape++;
        } else {
            double scale = log(map.large * map.small), ratio = map.large / map.small;
            d.angle += area * ratio;
            d.angle_most = fmax(d.angle_most, ratio);
            logs += area * scale;
            squares += area * scale * scale;
            kept += area;
        }
    }
    d.conformal = bent / d.area_flat;
    d.angle /= kept;
    d.rigid /= d.area;
    d.stretch = sqrt(fmax(0, squares / kept - logs / kept * (logs / kept)));
    return d;
}

void distortion_normalize(const mesh *part, double *uv) {
    double area = 0, flat = 0, one, mean[2] = {0, 0};
    flat_map map;
    for (sl_int f = 0; f < part->n_faces; f++) {
        if (map_of(&map, &one, part, uv, f)) {
            area += one;
            flat += one * map.large * map.small;
        }
    }
    size_t n = (size_t)part->n_vertices;
    for (size_t k = 0; k < 2 * n; k++) {
        mean[k % 2] += uv[k] / (double)n;
    }
    double scale = flat > 0 && isfinite(area / flat) ? sqrt(area / flat) : 1;
    for (size_t k = 0; k < 2 * n; k++) {
        uv[k] = scale * (uv[k] - mean[k % 2]);
    }
}

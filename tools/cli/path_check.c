/* path_check.c: compares the distances and cells of the heat method with paths over the faces */
#include "path_check.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "tools/geometry/laplacian.h"
#include "tools/geometry/straight_lines.h"

/* What the path to the site of a cell may exceed that to the nearest one, in mean edges. */
static const double cell_slack = 0.25;

void path_check_open(path_check *check, const mesh *m) {
    const double began = app_now();
    memset(check, 0, sizeof *check);
    check->m = m;
    check->edge = app_mean_edge_length(m);
    check->slack = 0.03;
    if (!incidence_create(&check->inc, m) || !surface_search_create(&check->one, &check->inc, 1) ||
        !surface_search_create(&check->three, &check->inc, 3)) {
        app_die("out of memory for paths over the faces");
    }
    check->seconds = app_now() - began;
}

void path_check_close(path_check *check) {
    surface_search_free(check->three);
    surface_search_free(check->one);
    incidence_free(&check->inc);
    memset(check, 0, sizeof *check);
}

/* Removes vertices beyond the radius: those whose distance exceeds it, unless `either` and their
 * path does not; and those that no path reaches, because the limit of the paths is above the
 * radius. */
static void keep_near(heat_field *f, const double *path, double radius, bool either) {
    sl_int kept = 0;
    for (sl_int k = 0; k < f->n && radius > 0; k++) {
        const double length = path[f->vertices[k]];
        if ((f->distance[k] <= radius && isfinite(length)) || (either && length <= radius)) {
            f->vertices[kept] = f->vertices[k];
            f->distance[kept] = f->distance[k];
            f->heat[kept] = f->heat[k];
            f->path[kept++] = f->path[k];
        }
    }
    f->n = radius > 0 ? kept : f->n;
}

/* Moves distances as far as lengths of paths and of straight lines ask for. */
static void move_distances(path_check *check, heat_field *f, const surface_lengths *u,
                           const sl_int *sources, sl_int count) {
    surface_correction c =
        surface_paths_correct(f->distance, f->vertices, f->n, u, check->slack * check->edge);
    /* along edges, which may be those of other faces */
    for (sl_int k = 0; k < f->n && f->path != NULL; k++) {
        if (f->distance[k] > f->path[k]) {
            c.largest = fmax(c.largest, f->distance[k] - f->path[k]);
            c.lowered++;
            f->distance[k] = f->path[k];
        }
    }
    const sl_int straight =
        straight_lines_raise(f->distance, check->m, f->vertices, f->n, sources, count, &c.largest);
    if (straight < 0) {
        app_die("out of memory for straight lines");
    }
    check->straight += straight;
    check->sum.raised += c.raised;
    check->sum.lowered += c.lowered;
    check->sum.largest = fmax(check->sum.largest, c.largest);
    check->sum.largest_width = fmax(check->sum.largest_width, c.largest_width);
    check->width_sum += c.mean_width * (double)f->n;
    check->distances += f->n;
}

void path_check_distances(path_check *check, heat_field *f, const sl_int *sources, sl_int count,
                          double radius, double limit) {
    const double began = app_now();
    if (!surface_search_run(check->one, sources, count, 2 * limit) ||
        !surface_search_run(check->three, sources, count, limit)) {
        app_die("out of memory for paths over the faces");
    }
    const double *flat = surface_search_unfold(check->three, false);
    const double *mixed = count > 1 ? surface_search_unfold(check->three, true) : flat;
    if (flat == NULL || mixed == NULL) {
        app_die("out of memory for paths over the faces");
    }
    const double *u3 = surface_search_lengths(check->three);
    const surface_lengths u = {surface_search_lengths(check->one), u3, flat, mixed};
    keep_near(f, u3, radius, true);
    double *before = app_alloc((size_t)f->n, sizeof *before);
    memcpy(before, f->distance, (size_t)f->n * sizeof *before);
    move_distances(check, f, &u, sources, count);
    for (sl_int k = 0; k < f->n; k++) {
        check->far += fabs(f->distance[k] - before[k]) > 0.5 * check->edge;
    }
    free(before);
    keep_near(f, u3, radius, false);
    check->seconds += app_now() - began;
}

void path_check_report(const path_check *check) {
    const surface_correction *c = &check->sum;
    printf("paths      over the faces in %.1f ms: of %lld distances %d raised, %d lowered, %lld "
           "raised "
           "to the straight line, by up to %.3g, %lld by more than half an edge; errors of at most "
           "about %.3g, %.3g on average\n",
           1e3 * check->seconds, (long long)check->distances, (int)c->raised, (int)c->lowered,
           (long long)check->straight, c->largest, (long long)check->far, c->largest_width,
           check->distances > 0 ? check->width_sum / (double)check->distances : 0);
    if (c->largest > 4 * check->edge) {
        app_warn("the heat method is off by up to %.3g, %.1f mean edges: %lld of %lld distances "
                 "are those of short paths",
                 c->largest, c->largest / check->edge, (long long)c->raised + c->lowered,
                 (long long)check->distances);
    }
}

static void show_progress(double fraction) {
    app_progress("comparing with paths", fraction);
}

void path_check_cells(path_check *check, sl_int *cell, const sl_int *sites, sl_int count,
                      double radius) {
    const double began = app_now(), allowed = cell_slack * check->edge;
    const sl_int n = check->m->n_vertices;
    cell_correction c;
    app_stage("comparing with paths");
    if (!cell_paths_correct(&c, cell, check->one, check->three, n, sites, count, radius, allowed,
                            show_progress)) {
        app_die("out of memory for paths over the faces");
    }
    app_progress_end();
    printf("paths      over the faces in %.1f ms: %d vertices moved to nearer sites, %d without a "
           "site given one; of the others %d may be nearer to another site, by at most %.3g, %.3g "
           "on average\n",
           1e3 * (check->seconds + app_now() - began), (int)c.moved, (int)c.given, (int)c.disputed,
           c.remains, c.mean_gap);
    if (c.farther > 4 * check->edge) {
        app_warn("the heat method gave vertices to sites that are farther than others by up to "
                 "%.3g, %.1f mean edges: %d of %d cells are those of short paths",
                 c.farther, c.farther / check->edge, (int)c.moved, (int)n);
    }
}

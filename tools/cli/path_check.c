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
    if (!incidence_create(&check->inc, m) ||
        !surface_search_create(&check->three, &check->inc, 3)) {
        app_die("out of memory for paths over the faces");
    }
    check->seconds = app_now() - began;
}

void path_check_set_curve(path_check *check, const edge_curve *curve) {
    check->curve = curve;
    if (!surface_search_set_curve(check->three, curve->ends.at, (sl_int)(curve->ends.count / 2))) {
        app_die("out of memory for the curve");
    }
}

void path_check_close(path_check *check) {
    surface_search_free(check->three);
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

/* Moves distances as far as lengths of paths and of straight lines ask for, and counts those within
 * the radius, if there is one. */
static void move_distances(path_check *check, heat_field *f, const double *straight,
                           const sl_int *sources, sl_int count, double radius) {
    const double *through = surface_search_lengths(check->three);
    double *before = app_alloc((size_t)f->n, sizeof *before);
    const surface_correction c =
        surface_paths_correct(f->distance, f->vertices, f->n, straight, check->slack * check->edge);
    memcpy(before, f->distance, (size_t)f->n * sizeof *before);
    check->largest = fmax(check->largest, c.largest);
    const edge_curve *curve = check->curve;
    if (straight_lines_raise(f->distance, check->m, f->vertices, f->n, sources, count,
                             curve != NULL ? curve->ends.at : NULL,
                             curve != NULL ? (sl_int)(curve->ends.count / 2) : 0,
                             &check->largest) < 0) {
        app_die("out of memory for straight lines");
    }
    for (sl_int k = 0; k < f->n; k++) {
        const double path = straight[f->vertices[k]];
        const bool is_line = f->distance[k] > before[k], is_known = isfinite(path);
        /* along edges, which may be those of other faces */
        f->distance[k] = f->path != NULL ? fmin(f->distance[k], f->path[k]) : f->distance[k];
        if (radius > 0 && !(f->distance[k] <= radius && is_known)) {
            continue; /* keep_near removes it */
        }
        const bool is_path = !is_line && f->distance[k] == path;
        const double gap = is_path ? through[f->vertices[k]] - path : 0;
        check->lines += is_line;
        check->paths += is_path;
        check->kept += is_known && !is_line && !is_path;
        check->others += !is_known && !is_line;
        check->gap += gap;
        check->widest = fmax(check->widest, gap);
    }
    free(before);
}

void path_check_distances(path_check *check, heat_field *f, const sl_int *sources, sl_int count,
                          double radius, double limit) {
    const double began = app_now();
    const double *through = surface_search_lengths(check->three);
    if (!surface_search_run(check->three, sources, count, limit)) {
        app_die("out of memory for paths over the faces");
    }
    keep_near(f, through, radius, true);
    const double *straight = surface_search_straighten(check->three, f->vertices, f->n);
    if (straight == NULL) {
        app_die("out of memory for paths over the faces");
    }
    move_distances(check, f, straight, sources, count, radius);
    keep_near(f, through, radius, false);
    check->seconds += app_now() - began;
}

void path_check_report(const path_check *check) {
    /* Against paths through 15 points of each edge, on the meshes of the tests and on scans: a
     * straightened path is too long by less than a tenth of what straightening took off, on
     * average, and by less than half of the most that it took off. */
    const double mean_share = 0.1, most_share = 0.5, slack = check->slack * check->edge;
    const double count = (double)(check->kept + check->paths + check->lines);
    const double mean = (mean_share * check->gap + (double)check->kept * slack) / fmax(1, count);
    const double most = fmax(check->kept > 0 ? slack : 0, most_share * check->widest);
    printf("Of %.0f distances %lld are those of the heat method, %lld are lengths of straightened "
           "paths and %lld of straight lines; %lld have no path to compare with.\n",
           count + (double)check->others, (long long)check->kept, (long long)check->paths,
           (long long)check->lines, (long long)check->others);
    printf(
        "They are off by about %.2g on average and at most about %.2g, which is %.2g mean edges.\n",
        mean, most, check->edge > 0 ? most / check->edge : 0);
    app_detail("paths      over the faces in %.1f ms: distances moved by up to %.3g\n",
               1e3 * check->seconds, check->largest);
    if (check->largest > 4 * check->edge) {
        app_warn("the heat method is off by up to %.3g, %.1f mean edges; lengths of paths take its "
                 "place",
                 check->largest, check->largest / check->edge);
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
    surface_search *one = NULL;
    app_stage("comparing with paths");
    if (!surface_search_create(&one, &check->inc, 1) ||
        !cell_paths_correct(&c, cell, one, check->three, n, sites, count, radius, allowed,
                            show_progress)) {
        app_die("out of memory for paths over the faces");
    }
    surface_search_free(one);
    app_progress_end();
    app_detail(
        "paths      over the faces in %.1f ms: %d vertices moved to nearer sites, %d without a "
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

/* geodesic_distances.c: distances of the command geodesic, from all sources or from each of them */
#include "geodesic.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "path_check.h"
#include "tools/geometry/distance_accuracy.h"
#include "tools/geometry/heat_patch.h"

static void write_distances(const geodesic_command *cmd, const heat_field *f) {
    size_t n = (size_t)cmd->m.n_vertices;
    if (cmd->output.csv != NULL) {
        FILE *csv = app_create(cmd->output.csv);
        fprintf(csv, "vertex,distance,path,heat\n");
        for (sl_int k = 0; k < f->n; k++) {
            fprintf(csv, "%d,%.17g,%.17g,%.17g\n", (int)f->vertices[k], f->distance[k], f->path[k],
                    f->heat[k]);
        }
        app_close(csv);
    }
    if (cmd->output.out == NULL && cmd->output.png == NULL) {
        return;
    }
    double *distance = app_alloc(n, sizeof *distance);
    for (size_t v = 0; v < n; v++) {
        distance[v] = NAN;
    }
    for (sl_int k = 0; k < f->n; k++) {
        distance[f->vertices[k]] = f->distance[k];
    }
    const mesh_field field = {"distance", distance};
    char title[80];
    (void)snprintf(title, sizeof title, "distance\nfrom %d%s\nt = %.3g\n(units of\nthe mesh)",
                   (int)cmd->sources[0], cmd->n_sources > 1 ? "+" : "", cmd->s.t);
    const render_style style = {.scalar = distance, .legend = title, .isolines = 20};
    geodesic_write_field(cmd, &field, NULL, &style);
    free(distance);
}

/* Prepares the ball around the sources with its plans, with --region in regions, and prints a
 * summary. */
static void prepare_patch(geodesic_command *cmd, heat_patch *patch) {
    sl_stats stats;
    double began = app_now();
    app_must(heat_patch_create(patch, &cmd->s, cmd->sources, cmd->n_sources,
                               heat_options_patch_radius(&cmd->heat), cmd->region),
             "plans around the sources", NULL);
    double seconds = app_now() - began;
    if (cmd->region) {
        app_print_region("region (L)", &patch->poisson.stats, patch->poisson.stats.region.seconds);
        stats.region = sl_region_view(patch->heat_region).info;
        app_print_region("region (M)", &stats, stats.region.seconds);
    }
    app_detail("prepared   %d vertices around the sources: plans%s in %.3f ms\n", (int)patch->b.n,
               cmd->region ? " and both regions" : "", 1e3 * seconds);
}

/* The radius within which the heat method returns distances. Where these are compared with paths,
 * all of the patch: a distance may fall below --radius by that. */
static double wanted_radius(const geodesic_command *cmd) {
    return cmd->raw ? cmd->heat.radius : 0;
}

/* Seconds, the best of as many repetitions as fit into 0.2 s, at least two: the first runs with
 * cold caches. */
static double best_distance(heat_field *f, const geodesic_command *cmd, heat_patch *patch) {
    double began = app_now(), seconds = INFINITY;
    memset(f, 0, sizeof *f);
    for (int k = 0; k < 2 || (k < 20 && app_now() - began < 0.2); k++) {
        heat_field_free(f);
        double begin = app_now();
        app_must(heat_patch_distance(f, patch, cmd->sources, cmd->n_sources, wanted_radius(cmd),
                                     cmd->heat.solves),
                 "distances", NULL);
        seconds = fmin(seconds, app_now() - begin);
    }
    return seconds;
}

void geodesic_distances(geodesic_command *cmd) {
    heat_field f;
    heat_patch patch;
    sl_stats all;
    prepare_patch(cmd, &patch);
    double seconds = best_distance(&f, cmd, &patch), farthest = 0;
    heat_patch_free(&patch);
    all.symbolic = sl_symbolic_view(cmd->s.S).info;
    if (!cmd->raw) {
        path_check check;
        app_stage("comparing with paths");
        path_check_open(&check, &cmd->m);
        path_check_set_curve(&check, &cmd->from_list.curve);
        path_check_distances(&check, &f, cmd->sources, cmd->n_sources, cmd->heat.radius,
                             heat_options_patch_radius(&cmd->heat));
        app_progress_end();
        path_check_report(&check);
        path_check_close(&check);
    }
    for (sl_int k = 0; k < f.n; k++) {
        farthest = fmax(farthest, f.distance[k]);
    }
    if (cmd->raw) {
        printf("All %d distances are those of the heat method, compared with nothing.\n", (int)f.n);
    }
    printf("They are those of %d of %d vertices, up to %.6g.\n", (int)f.n, (int)cmd->m.n_vertices,
           farthest);
    app_detail("distances  in %.3f ms\n", 1e3 * seconds);
    app_detail("touched    %d vertices; %.3g of %.3g entries of each factor, ", (int)f.n_patch,
               (double)f.heat_stats.plan.x_entries, (double)all.symbolic.nnz_panels);
    if (f.pinned) {
        app_detail("a factor of the ball with %d sources held at 0\n", (int)cmd->n_sources);
    } else {
        app_detail("%d solves for the distance\n", f.solves);
    }
    app_print_reads("heat", &f.heat_stats);
    if (!f.pinned) {
        app_print_reads("distance", &f.poisson_stats);
    }
    if (f.negative > 0) {
        app_warn("negative heat at %d vertices: the heat method is wrong there, a larger "
                 "--scaled-time may help",
                 (int)f.negative);
    }
    if (f.faces_without_gradient > 0) {
        app_detail("no heat    at %d faces: too far away for this time, or degenerate\n",
                   (int)f.faces_without_gradient);
    }
    if (options_verbose && cmd->n_sources <= 100) { /* costs vertices x sources */
        distance_print_bounds(&cmd->m, cmd->sources, cmd->n_sources, &f);
    }
    if (cmd->exact != NULL) {
        distance_print_accuracy(&cmd->m, cmd->sources, cmd->n_sources, &f,
                                strcmp(cmd->exact, "sphere") == 0);
    }
    write_distances(cmd, &f);
    heat_field_free(&f);
}

void geodesic_distances_of_each(geodesic_command *cmd) {
    heat_patch patch;
    path_check check;
    FILE *csv = cmd->output.csv != NULL ? app_create(cmd->output.csv) : NULL;
    double seconds = 0;
    sl_off found = 0;
    sl_int negative = 0; /* sources with negative heat somewhere */
    prepare_patch(cmd, &patch);
    if (csv != NULL) {
        fprintf(csv, "source,vertex,distance\n");
    }
    if (!cmd->raw) {
        path_check_open(&check, &cmd->m);
    }
    for (sl_int i = 0; i < cmd->n_sources; i++) {
        heat_field f;
        double began = app_now();
        app_must(heat_patch_distance(&f, &patch, cmd->sources + i, 1, wanted_radius(cmd),
                                     cmd->heat.solves),
                 "distances", NULL);
        seconds += app_now() - began;
        negative += f.negative > 0;
        if (!cmd->raw) {
            path_check_distances(&check, &f, cmd->sources + i, 1, cmd->heat.radius,
                                 heat_options_patch_radius(&cmd->heat));
        }
        found += f.n;
        if (i == 0) {
            app_print_reads("heat", &f.heat_stats);
            app_print_reads("distance", &f.poisson_stats);
        }
        for (sl_int k = 0; k < f.n && csv != NULL; k++) {
            fprintf(csv, "%d,%d,%.17g\n", (int)cmd->sources[i], (int)f.vertices[k], f.distance[k]);
        }
        heat_field_free(&f);
        app_progress("sources", (double)(i + 1) / (double)cmd->n_sources);
    }
    app_progress_end();
    heat_patch_free(&patch);
    if (!cmd->raw) {
        path_check_report(&check);
        path_check_close(&check);
    }
    printf("%lld distances from each of %d sources took %.3f ms per source.\n", (long long)found,
           (int)cmd->n_sources, 1e3 * seconds / (double)cmd->n_sources);
    if (negative > 0) {
        app_warn("negative heat from %d of %d sources: the heat method is wrong there, a larger "
                 "--scaled-time may help",
                 (int)negative, (int)cmd->n_sources);
    }
    if (csv != NULL) {
        app_close(csv);
    }
}

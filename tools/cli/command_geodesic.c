/* command_geodesic.c: distances on the surface by the heat method, and Voronoi cells of sites */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "app.h"
#include "command.h"
#include "heat_system.h"
#include "heat_factors.h"
#include "laplacian_choice.h"
#include "path_check.h"
#include "solve_accuracy.h"
#include "tools/geometry/distance_accuracy.h"
#include "tools/geometry/heat_distance.h"
#include "tools/geometry/laplacian.h"

static const options_usage usage = {
    "geodesic", "MESH", 1, 1,
    "Computes distances on the surface by the heat method, or Voronoi cells."};

static const options_manual manual = {
    "Heat flows from the sources for a short time; its negative gradient, scaled to length 1, is "
    "the gradient of the distance, which a Poisson problem integrates (Crane et al. 2013). With "
    "--radius all computations are confined to a ball around the sources.\n"
    "Exact: all linear solves, hence the heat in the ball. Approximate: the method itself, to an "
    "edge "
    "or two on even meshes if --scaled-time is 4 or more, and to much more on bad ones. Distances "
    "are "
    "therefore compared with paths over the faces through 3 and through 1 points of each edge, and "
    "moved where they exceed the shorter one, or fall short of it by more than a quarter of an "
    "edge "
    "and half the difference of both (not with --raw). With 1, the usual "
    "value, an error of "
    "about 1 % remains on regular grids however fine they are; larger values smooth the distance "
    "where shortest paths meet. In a short time heat can become negative behind obtuse faces, and "
    "distances there are wrong; unless a time is given, it is increased until no heat is negative. "
    "With --radius the distance near the rim of the ball is approximate too, because the gradient "
    "beyond the rim is unknown: by default no flux crosses the rim (--solves local solves with the "
    "factor of the mesh); --cut truncates the right-hand side at the rim, which takes one solve "
    "and "
    "is less accurate.\n"
    "--voronoi assigns each vertex to the source (site) from which most heat arrives (Herholz et "
    "al. 2017). For a short time that is the nearest site, except where two are almost equally "
    "near, and on bad meshes. Vertices therefore move to the site with the shortest path over the "
    "faces where theirs is farther by more than the same tolerance (not with --raw).",
    "mesh, region, prepared, distances: sizes and times; with --region, region (L) and region (M) "
    "are those of the factors of the Laplacian L and of heat, M + t L. touched: vertices of the "
    "ball and entries of L read. heat, distance: what the solves read. bounds: how far distances "
    "violate what holds on every surface. paths: what was moved, and "
    "what errors remain; with --voronoi, how many vertices may still be nearer to another site, "
    "and by how much. exact: errors with --exact.\n"
    "--csv has columns vertex,distance,path,heat, where path is the length along edges; with "
    "--each source,vertex,distance; with --voronoi vertex,site.",
    "star:6 --from 100 --png distance.png\nbunny.obj --from 17 --radius 0.3 --csv distance.csv\n"
    "torus:120x40 --voronoi --from random:60 --png cells.png"};

/* With --each, number of sources from which regions pay for their creation. Where a region would
 * save nothing, it has no boundary and its creation is almost free. */
enum { REGION_PAYS = 70 };

typedef struct geodesic_command {
    /* options */
    const char *from, *exact, *laplacian;
    const char *heat_file, *poisson_file;     /* NULL: the factors are computed */
    double radius, margin, time, scaled_time; /* radius, time, scaled_time: 0 if not given */
    sl_int solves;
    bool cut, region, each, voronoi, raw;
    app_output output;
    /* computed from them */
    mesh m;
    intrinsic surface; /* all zero: the mesh as it is */
    heat_solver s;
    sl_int *sources, n_sources;
    heat_options heat;
} geodesic_command;

static render_mark *marks_of(const geodesic_command *cmd) {
    render_mark *marks = app_alloc((size_t)cmd->n_sources, sizeof *marks);
    const rgb red = {0xd5, 0x2b, 0x1e};
    for (sl_int k = 0; k < cmd->n_sources; k++) {
        marks[k].vertex = cmd->sources[k];
        marks[k].radius = cmd->n_sources > 20 ? 3 : 5;
        marks[k].color = red;
    }
    return marks;
}

/* Writes the mesh with the field and draws it with the sources marked. */
static void write_field(const geodesic_command *cmd, const mesh_field *field, const rgb *colors,
                        const render_style *how) {
    mesh_extra extra;
    render_style style = *how;
    render_mark *marks = marks_of(cmd);
    memset(&extra, 0, sizeof extra);
    extra.fields = field;
    extra.n_fields = 1;
    extra.color = colors;
    style.marks = marks;
    style.n_marks = cmd->n_sources;
    app_write(&cmd->output, &cmd->m, &extra, &style);
    free(marks);
}

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
    write_field(cmd, &field, NULL, &style);
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
        sl_region_stats(patch->heat_region, &stats);
        app_print_region("region (M)", &stats, stats.region.seconds);
    }
    printf("prepared   %d vertices around the sources: plans%s in %.3f ms\n", (int)patch->b.n,
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

static void distances(geodesic_command *cmd) {
    heat_field f;
    heat_patch patch;
    sl_stats all;
    prepare_patch(cmd, &patch);
    double seconds = best_distance(&f, cmd, &patch), farthest = 0;
    heat_patch_free(&patch);
    sl_symbolic_stats(cmd->s.S, &all);
    if (!cmd->raw) {
        path_check check;
        app_stage("comparing with paths");
        path_check_open(&check, &cmd->m);
        path_check_distances(&check, &f, cmd->sources, cmd->n_sources, cmd->heat.radius,
                             heat_options_patch_radius(&cmd->heat));
        app_progress_end();
        path_check_report(&check);
        path_check_close(&check);
    }
    for (sl_int k = 0; k < f.n; k++) {
        farthest = fmax(farthest, f.distance[k]);
    }
    printf("distances  of %d vertices, up to %.6g, in %.3f ms\n", (int)f.n, farthest,
           1e3 * seconds);
    printf("touched    %d vertices; %.3g of %.3g entries of each factor, %d solves for the "
           "distance\n",
           (int)f.n_patch, (double)f.heat_stats.plan.x_entries, (double)all.symbolic.nnz_panels,
           f.solves);
    app_print_reads("heat", &f.heat_stats);
    app_print_reads("distance", &f.poisson_stats);
    if (f.negative > 0) {
        app_warn("negative heat at %d vertices: the heat method is wrong there, a larger "
                 "--scaled-time may help",
                 (int)f.negative);
    }
    if (f.faces_without_gradient > 0) {
        printf("no heat    at %d faces: too far away for this time, or degenerate\n",
               (int)f.faces_without_gradient);
    }
    if (cmd->n_sources <= 100) { /* costs vertices x sources */
        distance_print_bounds(&cmd->m, cmd->sources, cmd->n_sources, &f);
    }
    if (cmd->exact != NULL) {
        distance_print_accuracy(&cmd->m, cmd->sources, cmd->n_sources, &f,
                                strcmp(cmd->exact, "sphere") == 0);
    }
    write_distances(cmd, &f);
    heat_field_free(&f);
}

/* Distances from each source separately, with the plans of one ball around all of them. */
static void distances_of_each(geodesic_command *cmd) {
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
    printf("distances  %lld, from each of %d sources, in %.3f ms: %.3f ms per source\n",
           (long long)found, (int)cmd->n_sources, 1e3 * seconds,
           1e3 * seconds / (double)cmd->n_sources);
    if (!cmd->raw) {
        path_check_report(&check);
        path_check_close(&check);
    }
    if (negative > 0) {
        app_warn("negative heat from %d of %d sources: the heat method is wrong there, a larger "
                 "--scaled-time may help",
                 (int)negative, (int)cmd->n_sources);
    }
    if (csv != NULL) {
        app_close(csv);
    }
}

/* Distinct colors: hues in steps of the golden ratio, three levels of brightness. */
static rgb cell_color(sl_int k) {
    double hue = fmod(0.1 + 0.61803398875 * (double)k, 1), level = k % 3 == 0   ? 0.95
                                                                   : k % 3 == 1 ? 0.8
                                                                                : 0.65;
    double channel[3];
    for (int c = 0; c < 3; c++) {
        double x = fabs(fmod(6 * hue + (c == 0 ? 0 : c == 1 ? 4 : 2), 6) - 3) - 1;
        channel[c] = 255 * level * (0.45 + 0.55 * fmax(0, fmin(1, x)));
    }
    rgb color = {(unsigned char)channel[0], (unsigned char)channel[1], (unsigned char)channel[2]};
    return color;
}

static void write_cells(const geodesic_command *cmd, const sl_int *cell) {
    size_t n = (size_t)cmd->m.n_vertices;
    if (cmd->output.csv != NULL) {
        FILE *csv = app_create(cmd->output.csv);
        fprintf(csv, "vertex,site\n");
        for (size_t v = 0; v < n; v++) {
            fprintf(csv, "%d,%d\n", (int)v, cell[v] < 0 ? -1 : (int)cmd->sources[cell[v]]);
        }
        app_close(csv);
    }
    double *site = app_alloc(n, sizeof *site);
    rgb *colors = app_alloc(n, sizeof *colors);
    const rgb none = {0xd8, 0xd8, 0xd8};
    for (size_t v = 0; v < n; v++) {
        site[v] = cell[v] < 0 ? -1 : (double)cmd->sources[cell[v]];
        colors[v] = cell[v] < 0 ? none : cell_color(cell[v]);
    }
    const mesh_field field = {"site", site};
    const render_style style = {.vertex_color = colors, .nearest = true};
    write_field(cmd, &field, colors, &style);
    free(colors);
    free(site);
}

static void show_progress(double fraction) {
    app_progress("cells", fraction);
}

static void cells(geodesic_command *cmd) {
    size_t n = (size_t)cmd->m.n_vertices;
    sl_int *cell = app_alloc(n, sizeof *cell),
           *sizes = app_alloc((size_t)cmd->n_sources + 1, sizeof *sizes);
    double *largest_heat = app_alloc(n, sizeof *largest_heat), began = app_now();
    sl_off touched;
    app_must(heat_cells(cell, largest_heat, &cmd->s, cmd->sources, cmd->n_sources, cmd->heat.radius,
                        &touched, show_progress),
             "cells", NULL);
    app_progress_end();
    double seconds = app_now() - began;
    if (!cmd->raw) {
        path_check check;
        path_check_open(&check, &cmd->m);
        path_check_cells(&check, cell, cmd->sources, cmd->n_sources, cmd->heat.radius);
        path_check_close(&check);
    }
    for (size_t v = 0; v < n; v++) {
        sizes[cell[v] < 0 ? cmd->n_sources : cell[v]]++;
    }
    sl_int smallest = cmd->n_sources > 0 ? sizes[0] : 0, largest = 0;
    for (sl_int k = 0; k < cmd->n_sources; k++) {
        smallest = sizes[k] < smallest ? sizes[k] : smallest;
        largest = sizes[k] > largest ? sizes[k] : largest;
    }
    printf("cells      of %d sites, %d to %d vertices each, in %.3f ms; %lld values of heat\n",
           (int)cmd->n_sources, (int)smallest, (int)largest, 1e3 * seconds, (long long)touched);
    if (sizes[cmd->n_sources] > 0) {
        printf("no site    for %d vertices: outside the radius, or too far away for this time\n",
               (int)sizes[cmd->n_sources]);
    }
    write_cells(cmd, cell);
    free(largest_heat);
    free(sizes);
    free(cell);
}

/* The vertices of --from without repetitions. */
static sl_int *sources_of(const char *from, const mesh *m, sl_int *count) {
    if (from != NULL) {
        sl_int *list = app_vertices("from", from, m->n_vertices, 1, count);
        *count = app_distinct(list, *count, m->n_vertices);
        return list;
    }
    sl_int *first = app_alloc(1, sizeof *first);
    first[0] = app_default_vertex(m);
    *count = 1;
    return first;
}

/* Reads the mesh, finds the sources, gets both factors and aims the camera. */
static void open_command(geodesic_command *cmd, const char *operand) {
    double time = cmd->time, scaled = cmd->scaled_time;
    app_mesh(&cmd->m, operand, true);
    app_set_up(&cmd->output, &cmd->m, cmd->output.png != NULL);
    cmd->sources = sources_of(cmd->from, &cmd->m, &cmd->n_sources);
    double edge = app_mean_edge_length(&cmd->m);
    double t = time > 0 ? time : (scaled > 0 ? scaled : HEAT_FACTORS_FIRST) * edge * edge;
    bool is_saved = cmd->heat_file != NULL;
    if (!(t > 0)) {
        app_die("%s: all edges have no length", operand);
    }
    heat_check_time(t);
    if (t < 0.1 * edge * edge) {
        app_warn("the time is too short for heat to cross an edge: the heat method will be wrong");
    }
    double began = app_now();
    if (is_saved) {
        heat_factors_open(&cmd->s, &cmd->surface, &cmd->m, cmd->laplacian, cmd->heat_file,
                          cmd->poisson_file);
    } else {
        heat_factors_create(&cmd->s, &cmd->surface, &cmd->m, cmd->laplacian, t, NULL);
    }
    printf(
        "mesh       %d vertices, %d faces, mean edge %.4g; time %.4g; both factors %s in %.1f ms\n",
        (int)cmd->m.n_vertices, (int)cmd->m.n_faces, edge, cmd->s.t,
        is_saved ? "mapped and checked" : "made", 1e3 * (app_now() - began));
    accuracy_warn_poisson(cmd->s.m, cmd->s.inc.lengths,
                          cmd->surface.lengths != NULL ? cmd->surface.share : 1);
    if (!is_saved && !(time > 0) && !(scaled > 0)) {
        heat_factors_find_time(&cmd->s, edge * edge, cmd->sources, cmd->n_sources, &cmd->heat);
    }
    if (cmd->n_sources == 1 && cmd->heat.radius > 0) {
        app_aim_camera(&cmd->output, &cmd->m, cmd->sources, 1, true);
    }
}

static void check_options(const geodesic_command *cmd) {
    if (cmd->margin < 1 || cmd->solves < 1 || cmd->solves > 1000) {
        app_die_usage("expected --margin 1 or more, --solves 1 to 1000");
    }
    if (cmd->region && (cmd->radius == 0 || cmd->voronoi)) {
        app_die_usage("--region: only for distances within --radius");
    }
    if (cmd->each && (cmd->voronoi || cmd->exact != NULL || cmd->output.out != NULL ||
                      cmd->output.png != NULL)) {
        app_die_usage("--each: writes only --csv");
    }
    if (cmd->exact != NULL && strcmp(cmd->exact, "plane") != 0 &&
        strcmp(cmd->exact, "sphere") != 0) {
        app_die_usage("--exact %s: expected plane or sphere", cmd->exact);
    }
    if (cmd->time > 0 && cmd->scaled_time > 0) {
        app_die_usage("--time and --scaled-time: give one of them");
    }
    if ((cmd->heat_file != NULL) != (cmd->poisson_file != NULL)) {
        app_die_usage("--heat and --poisson: give both or none");
    }
    if (cmd->heat_file != NULL && (cmd->time > 0 || cmd->scaled_time > 0)) {
        app_die_usage("%s: has its own time", cmd->heat_file);
    }
}

int command_geodesic(int argc, char **argv) {
    geodesic_command cmd;
    const char *operand = NULL;
    memset(&cmd, 0, sizeof cmd);
    cmd.margin = HEAT_MARGIN;
    cmd.solves = HEAT_SOLVES;
    const option options[] = {
        {OPTION_TEXT, "from", &cmd.from, "VERTICES",
         "sources or sites: 3,17,100-200 or random:5 (the first vertex of a face with an area)"},
        {OPTION_ABOVE_0, "radius", &cmd.radius, "R", "largest distance wanted (unlimited)"},
        {OPTION_REAL, "margin", &cmd.margin, "F",
         "radius of the ball along edges, in units of --radius (1.5)"},
        {OPTION_COUNT, "solves", &cmd.solves, "N", "local solves for the distance in a ball (3)"},
        {OPTION_FLAG, "cut", &cmd.cut, NULL,
         "one solve, with the right-hand side truncated at the rim of the ball"},
        {OPTION_ABOVE_0, "time", &cmd.time, "T", "diffuse heat for the time T"},
        {OPTION_ABOVE_0, "scaled-time", &cmd.scaled_time, "S",
         "diffuse heat for S times the squared mean edge length (4, or more if heat would be "
         "negative)"},
        {OPTION_TEXT, "heat", &cmd.heat_file, "FILE",
         "take the factor of heat, and with it the time, from this file; with --poisson"},
        {OPTION_TEXT, "poisson", &cmd.poisson_file, "FILE",
         "take the factor of the Laplacian from this file; save --poisson writes both"},
        {OPTION_TEXT, "exact", &cmd.exact, "plane|sphere",
         "print the errors for a mesh that is a plane or a sphere"},
        {OPTION_FLAG, "region", &cmd.region, NULL,
         "create regions of both factors around the ball and solve in them; the cost of a distance "
         "is then independent of the size of the mesh. Creating them takes as long as 15 to 70 "
         "distances without (default with --each from 70 sources)"},
        {OPTION_FLAG, "each", &cmd.each, NULL,
         "distances from each source separately, with one set of plans in a ball around all"},
        {OPTION_FLAG, "raw", &cmd.raw, NULL,
         "keep distances and cells of the heat method as they are, without the comparison with "
         "paths; it takes about 10 seconds for each million vertices and source"},
        {OPTION_FLAG, "voronoi", &cmd.voronoi, NULL, "nearest site in place of the distance"},
        LAPLACIAN_OPTION(&cmd.laplacian),
        APP_OUTPUT_OPTIONS(&cmd.output),
        {OPTION_END, NULL, NULL, NULL, NULL}};
    options_read(&usage, &manual, options, argc, argv, &operand);
    check_options(&cmd);
    laplacian_check(cmd.laplacian);
    app_check_output(&cmd.output, cmd.output.out);
    cmd.heat.radius = cmd.radius;
    cmd.heat.margin = cmd.margin;
    cmd.heat.solves = cmd.cut ? 1 : (int)cmd.solves;
    open_command(&cmd, operand);
    cmd.region = cmd.region || (cmd.each && cmd.radius > 0 && cmd.n_sources >= REGION_PAYS);
    if (cmd.voronoi) {
        cells(&cmd);
    } else if (cmd.each) {
        distances_of_each(&cmd);
    } else {
        distances(&cmd);
    }
    free(cmd.sources);
    heat_solver_free(&cmd.s);
    intrinsic_free(&cmd.surface);
    mesh_free(&cmd.m);
    return 0;
}

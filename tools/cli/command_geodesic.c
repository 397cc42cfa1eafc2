/* command_geodesic.c: sparse-local geodesic: distances by the heat method, near or everywhere, and nearest sites */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "app.h"
#include "command.h"
#include "distance_checks.h"
#include "heat_place.h"
#include "laplacian.h"
#include "look.h"

static const char text[] =
    "Distances along the surface from some vertices by the heat method (Crane et al. 2013): heat "
    "flows for a short time, its gradient scaled to length 1 is the gradient of the distance, "
    "which a Poisson problem puts together. With --radius only a ball around the sources is "
    "touched.\nExact: all linear solves, and so the heat within the ball. Approximate, also "
    "without --radius: the method, by about an edge's length if --scaled-time is 4 or more (with "
    "1, the usual value, an error of about a percent stays on regular grids however fine; larger "
    "values round off where distances meet). In a short time heat may fall below 0 behind obtuse "
    "faces, and distances are wrong: unless a time is given it is raised until none does. With "
    "--radius also the distance at the rim of the ball: the gradient beyond it is not known. By "
    "default nothing flows through the rim (--solves local solves on the mesh's factor); --cut "
    "takes the right-hand side as it ends there, one solve, and is worse.\n--voronoi gives each "
    "vertex to the site (source) from which most heat arrives (Herholz et al. 2017): for a short "
    "time the nearest one, but for a margin where two are almost as near.";

enum { FIRST_TIME = 4, LAST_TIME = 256 }; /* squared mean edges */
enum {
    REGION_PAYS = 70
}; /* distances; where a region saves nothing, it is made without a boundary, in no time */

typedef struct job {
    mesh m;
    heat_solver s;
    sl_int *sources, n_sources;
    const char *exact; /* plane, sphere or NULL */
    app_output output;
    char view[LOOK_TEXT]; /* where the first source is seen from the front */
    heat_reach reach;
    bool region; /* --region */
    bool each;   /* --each */
} job;

static render_mark *marks_of(const job *q) {
    render_mark *marks = app_alloc((size_t)q->n_sources, sizeof *marks);
    const rgb red = {0xd5, 0x2b, 0x1e};
    for (sl_int k = 0; k < q->n_sources; k++) {
        marks[k].vertex = q->sources[k];
        marks[k].radius = q->n_sources > 20 ? 3 : 5;
        marks[k].color = red;
    }
    return marks;
}

/* Writes the mesh with the field, and draws it with the sources marked. */
static void write_field(const job *q, const mesh_field *field, const rgb *colors,
                        const render_style *how) {
    mesh_extra extra;
    render_style style = *how;
    render_mark *marks = marks_of(q);
    memset(&extra, 0, sizeof extra);
    extra.fields = field;
    extra.n_fields = 1;
    extra.color = colors;
    style.marks = marks;
    style.n_marks = q->n_sources;
    app_write(&q->output, &q->m, &extra, &style);
    free(marks);
}

static void write_distances(const job *q, const heat_field *f) {
    size_t n = (size_t)q->m.n_vertices;
    if (q->output.csv != NULL) {
        FILE *csv = app_create(q->output.csv);
        fprintf(csv, "vertex,distance,path,heat\n");
        for (sl_int k = 0; k < f->n; k++) {
            fprintf(csv, "%d,%.17g,%.17g,%.17g\n", (int)f->vertices[k], f->distance[k], f->path[k],
                    f->heat[k]);
        }
        app_close(csv, q->output.csv);
    }
    if (q->output.out == NULL && q->output.png == NULL) {
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
    const render_style style = {.scalar = distance, .isolines = 20};
    write_field(q, &field, NULL, &style);
    free(distance);
}

/* The ball and its plans, with a line on them; in regions where these are asked for. */
static void open_place(job *q, heat_place *place) {
    sl_stats stats;
    double began = app_now();
    app_must(heat_place_create(place, &q->s, q->sources, q->n_sources, heat_reach_width(&q->reach),
                               q->region),
             "plans around the sources", NULL);
    double seconds = app_now() - began;
    if (q->region) {
        app_print_region("region", &place->poisson.stats, place->poisson.stats.seconds_region);
        sl_region_stats(place->heat_region, &stats);
        app_print_region("of heat", &stats, stats.seconds_region);
    }
    printf("prepared   %d vertices around the sources: planned%s in %.3f ms\n", (int)place->b.n,
           q->region ? ", with both regions," : "", 1e3 * seconds);
}

/* The best of a few times, as many as go into a fifth of a second, but two at least: the first is in memory that is
 * cold. Seconds. */
static double best_distance(heat_field *f, const job *q, heat_place *place) {
    double began = app_now(), seconds = INFINITY;
    memset(f, 0, sizeof *f);
    for (int k = 0; k < 2 || (k < 20 && app_now() - began < 0.2); k++) {
        heat_field_free(f);
        double begin = app_now();
        app_must(heat_place_distance(f, place, q->sources, q->n_sources, q->reach.radius,
                                     q->reach.solves),
                 "distances", NULL);
        seconds = fmin(seconds, app_now() - begin);
    }
    return seconds;
}

static void distances(job *q) {
    heat_field f;
    heat_place place;
    sl_stats all;
    open_place(q, &place);
    double seconds = best_distance(&f, q, &place), farthest = 0;
    heat_place_free(&place);
    sl_symbolic_stats(q->s.S, &all);
    for (sl_int k = 0; k < f.n; k++) {
        farthest = fmax(farthest, f.distance[k]);
    }
    printf("distances  of %d vertices, up to %.6g, in %.3f ms\n", (int)f.n, farthest,
           1e3 * seconds);
    printf("touched    %d vertices; %.3g of %.3g entries of each factor, %d solves for the "
           "distance\n",
           (int)f.n_ball, (double)f.heat_stats.x_entries, (double)all.nnz_panels, f.solves);
    app_print_reads("heat", &f.heat_stats);
    app_print_reads("distance", &f.poisson_stats);
    if (f.negative > 0) {
        printf("warning    heat below 0 at %d vertices: distances will be wrong, a larger "
               "--scaled-time may "
               "help\n",
               (int)f.negative);
    }
    if (f.cold > 0) {
        printf("no heat    at %d faces: too far for this time, or without a shape\n", (int)f.cold);
    }
    if (q->n_sources <= 100) { /* each vertex looks at each source */
        distance_print_bounds(&q->m, q->sources, q->n_sources, &f);
    }
    if (q->exact != NULL) {
        distance_print_errors(&q->m, q->sources, q->n_sources, &f, strcmp(q->exact, "sphere") == 0);
    }
    write_distances(q, &f);
    heat_field_free(&f);
}

/* Distances from each source by itself, all in one place. */
static void distances_of_each(job *q) {
    heat_place place;
    FILE *csv = q->output.csv != NULL ? app_create(q->output.csv) : NULL;
    double seconds = 0;
    sl_off found = 0;
    open_place(q, &place);
    if (csv != NULL) {
        fprintf(csv, "source,vertex,distance\n");
    }
    for (sl_int i = 0; i < q->n_sources; i++) {
        heat_field f;
        double began = app_now();
        app_must(
            heat_place_distance(&f, &place, q->sources + i, 1, q->reach.radius, q->reach.solves),
            "distances", NULL);
        seconds += app_now() - began;
        found += f.n;
        if (i == 0) {
            app_print_reads("heat", &f.heat_stats);
            app_print_reads("distance", &f.poisson_stats);
        }
        for (sl_int k = 0; k < f.n && csv != NULL; k++) {
            fprintf(csv, "%d,%d,%.17g\n", (int)q->sources[i], (int)f.vertices[k], f.distance[k]);
        }
        heat_field_free(&f);
        app_progress("sources", (double)(i + 1) / (double)q->n_sources);
    }
    app_progress_end();
    heat_place_free(&place);
    printf("distances  %lld, from %d sources by themselves, in %.3f ms: %.3f ms each\n",
           (long long)found, (int)q->n_sources, 1e3 * seconds,
           1e3 * seconds / (double)q->n_sources);
    if (csv != NULL) {
        app_close(csv, q->output.csv);
    }
}

/* Colours that stand apart, by the golden section of the circle of hues. */
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

static void write_cells(const job *q, const sl_int *cell) {
    size_t n = (size_t)q->m.n_vertices;
    if (q->output.csv != NULL) {
        FILE *csv = app_create(q->output.csv);
        fprintf(csv, "vertex,site\n");
        for (size_t v = 0; v < n; v++) {
            fprintf(csv, "%d,%d\n", (int)v, cell[v] < 0 ? -1 : (int)q->sources[cell[v]]);
        }
        app_close(csv, q->output.csv);
    }
    double *site = app_alloc(n, sizeof *site);
    rgb *colors = app_alloc(n, sizeof *colors);
    const rgb none = {0xd8, 0xd8, 0xd8};
    for (size_t v = 0; v < n; v++) {
        site[v] = cell[v] < 0 ? -1 : (double)q->sources[cell[v]];
        colors[v] = cell[v] < 0 ? none : cell_color(cell[v]);
    }
    const mesh_field field = {"site", site};
    const render_style style = {.vertex_color = colors, .nearest = true};
    write_field(q, &field, colors, &style);
    free(colors);
    free(site);
}

static void tell(double share) {
    app_progress("cells", share);
}

static void cells(job *q) {
    size_t n = (size_t)q->m.n_vertices;
    sl_int *cell = app_alloc(n, sizeof *cell),
           *sizes = app_alloc((size_t)q->n_sources + 1, sizeof *sizes);
    double *most = app_alloc(n, sizeof *most), began = app_now();
    sl_off touched;
    app_must(
        heat_cells(cell, most, &q->s, q->sources, q->n_sources, q->reach.radius, &touched, tell),
        "cells", NULL);
    app_progress_end();
    double seconds = app_now() - began;
    for (size_t v = 0; v < n; v++) {
        sizes[cell[v] < 0 ? q->n_sources : cell[v]]++;
    }
    sl_int smallest = q->n_sources > 0 ? sizes[0] : 0, largest = 0;
    for (sl_int k = 0; k < q->n_sources; k++) {
        smallest = sizes[k] < smallest ? sizes[k] : smallest;
        largest = sizes[k] > largest ? sizes[k] : largest;
    }
    printf("cells      of %d sites, of %d to %d vertices, in %.3f ms; %lld values of heat\n",
           (int)q->n_sources, (int)smallest, (int)largest, 1e3 * seconds, (long long)touched);
    if (sizes[q->n_sources] > 0) {
        printf("no site    for %d vertices: beyond the radius, or too far for heat in this time\n",
               (int)sizes[q->n_sources]);
    }
    write_cells(q, cell);
    free(most);
    free(sizes);
    free(cell);
}

/* Those that --from names, each once; else the first corner of a face with a shape. */
static sl_int *sources_of(const char *from, const mesh *m, sl_int *count) {
    if (from != NULL) {
        sl_int *list = app_vertices("from", from, m->n_vertices, 1, count);
        *count = app_distinct(list, *count, m->n_vertices);
        return list;
    }
    sl_int *first = app_alloc(1, sizeof *first), f = 0;
    while (f + 1 < m->n_faces && !(laplacian_of_face(m, m->faces + 3 * (size_t)f).area > 0)) {
        f++;
    }
    first[0] = m->faces[3 * (size_t)f];
    *count = 1;
    return first;
}

/* Finds a time that will do, unless one was given: from 4 squared edges on, twice as long until no heat is below 0 where
 * the sources' heat is looked at. Each is a factorization of new numbers over the same analysis. */
static void find_time(job *q, double squared_edge) {
    sl_int before = 0;
    double scaled = FIRST_TIME;
    for (;; scaled *= 2) {
        heat_field f;
        app_must(heat_distance(&f, &q->s, q->sources, q->n_sources, &q->reach), "distances", NULL);
        sl_int negative = f.negative;
        heat_field_free(&f);
        if (negative == 0 || scaled >= LAST_TIME) {
            break;
        }
        before = before == 0 ? negative : before;
        app_must(heat_solver_set_time(&q->s, 2 * scaled * squared_edge), "factor of heat", NULL);
    }
    if (before > 0) {
        printf("time       raised to %g squared edges: %d vertices had heat below 0, behind obtuse "
               "faces\n",
               scaled, (int)before);
    }
}

/* Mesh, sources, both factors, and from where to look. time, scaled: 0 where they are not given. */
static void open_job(job *q, const char *operand, const char *from, double time, double scaled) {
    app_mesh(&q->m, operand, true);
    q->sources = sources_of(from, &q->m, &q->n_sources);
    double edge = mesh_mean_edge_length(&q->m);
    double t = time > 0 ? time : (scaled > 0 ? scaled : FIRST_TIME) * edge * edge;
    if (!(t > 0)) {
        app_die("%s: its edges have no length", operand);
    }
    if (t < 0.1 * edge * edge) {
        printf("warning    in this time heat does not get over an edge: distances will be wrong\n");
    }
    double began = app_now();
    app_stage("factoring the mesh twice");
    app_must(heat_solver_create(&q->s, &q->m, t), "factors of heat and Laplacian", NULL);
    app_progress_end();
    printf(
        "mesh       %d vertices, %d faces, edges of %.4g; time %.4g; factored twice in %.1f ms\n",
        (int)q->m.n_vertices, (int)q->m.n_faces, edge, t, 1e3 * (app_now() - began));
    if (!(time > 0) && !(scaled > 0)) {
        find_time(q, edge * edge);
    }
    if (q->n_sources == 1 && q->reach.radius > 0) {
        const incidence *a = &q->s.around;
        sl_int v = q->sources[0];
        look_at_faces(q->view, &q->output, &q->m, a->face + a->begin[v],
                      (sl_int)(a->begin[v + 1] - a->begin[v]));
    }
}

int command_geodesic(int argc, char **argv) {
    job q;
    const char *operand = NULL, *from = NULL;
    double radius = 0, margin = HEAT_MARGIN, scaled = 0, time = 0;
    sl_int solves = HEAT_SOLVES;
    bool voronoi = false, cut = false;
    memset(&q, 0, sizeof q);
    const option options[] = {
        {OPTION_TEXT, "from", &from, "VERTICES",
         "the sources or sites: 3,17,100-200 or random:5 (the first that has a face)"},
        {OPTION_REAL, "radius", &radius, "R", "only so far; without it the whole mesh"},
        {OPTION_REAL, "margin", &margin, "F", "the ball is F times as wide, along edges (1.5)"},
        {OPTION_COUNT, "solves", &solves, "N", "local solves for the distance in a ball (3)"},
        {OPTION_FLAG, "cut", &cut, NULL, "one solve of the right-hand side cut at the ball"},
        {OPTION_REAL, "time", &time, "T", "heat flows for the time T"},
        {OPTION_REAL, "scaled-time", &scaled, "S",
         "heat flows for S times the squared mean length of an edge (4, or more if heat then falls "
         "below 0)"},
        {OPTION_TEXT, "exact", &q.exact, "plane|sphere",
         "compare with straight distances, or with those on the sphere that the mesh is"},
        {OPTION_FLAG, "region", &q.region, NULL,
         "make regions of both factors around the ball and solve in them: distances then cost the "
         "same however large the mesh. Making them takes as long as 15 to 70 distances without: it "
         "is the default with --each from 70 sources on"},
        {OPTION_FLAG, "each", &q.each, NULL,
         "the distances from each source by itself, not from the nearest, in one ball around all "
         "of them: one set of plans; --csv writes source, vertex, distance"},
        {OPTION_FLAG, "voronoi", &voronoi, NULL, "the nearest site instead of the distance"},
        APP_OUTPUT_OPTIONS(&q.output),
        {OPTION_END, NULL, NULL, NULL, NULL}};
    const options_usage usage = {"geodesic", "MESH", 1, 1, text};
    options_read(&usage, options, argc, argv, &operand);
    if (radius < 0 || margin < 1 || solves < 1 || solves > 1000) {
        app_die_usage("--radius 0 or more, --margin 1 or more, --solves 1 to 1000");
    }
    if (q.region && (radius == 0 || voronoi)) {
        app_die_usage("--region: for distances within --radius");
    }
    if (q.each && (voronoi || q.exact != NULL || q.output.out != NULL || q.output.png != NULL)) {
        app_die_usage("--each: writes --csv alone");
    }
    if (q.exact != NULL && strcmp(q.exact, "plane") != 0 && strcmp(q.exact, "sphere") != 0) {
        app_die_usage("--exact %s: not plane or sphere", q.exact);
    }
    if (time < 0 || scaled < 0 || (time > 0 && scaled > 0)) {
        app_die_usage("--time or --scaled-time, one of them, above 0");
    }
    q.reach.radius = radius;
    q.reach.margin = margin;
    q.reach.solves = cut ? 1 : (int)solves;
    open_job(&q, operand, from, time, scaled);
    q.region = q.region || (q.each && radius > 0 && q.n_sources >= REGION_PAYS);
    if (voronoi) {
        cells(&q);
    } else if (q.each) {
        distances_of_each(&q);
    } else {
        distances(&q);
    }
    free(q.sources);
    heat_solver_free(&q.s);
    mesh_free(&q.m);
    return 0;
}

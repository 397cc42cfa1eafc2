/* command_geodesic.c: distances on the surface by the heat method, and Voronoi cells of sites */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "app.h"
#include "command.h"
#include "geodesic.h"
#include "heat_system.h"
#include "heat_factors.h"
#include "laplacian_choice.h"
#include "solve_accuracy.h"
#include "tools/geometry/heat_distance.h"
#include "tools/geometry/laplacian.h"
#include "tools/mesh/insert_point.h"

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
    "therefore compared with paths over the faces: the shortest one through 3 points of each edge, "
    "straightened in the strip of triangles that it crosses. A distance that exceeds its path, or "
    "falls short of it by more than 0.03 mean edges, becomes the length of the path, and one that "
    "is shorter than the straight line that of the line (not with --raw). The first line of output "
    "says how many distances are which, the second how far off they are. "
    "Several sources are all equally warm and held at 0, by a factor of the Laplacian of the ball, "
    "and the gradient is taken from the distance three times more. From one source, with "
    "--scaled-time 1, the usual value, an error of "
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
    "faces where theirs is farther by more than a quarter of an edge and half the difference "
    "(not with --raw).",
    "How many distances are those of the heat method, lengths of paths and of straight lines, and "
    "how far off they can be. With --verbose: mesh, region, prepared, distances: sizes and times; "
    "with --region, region (L) and region (M) are those of the factors of the Laplacian L and of "
    "heat, M + t L. touched: vertices of the ball and entries of L read. heat, distance: what the "
    "solves read. bounds: how far distances violate what holds on every surface. paths: the time "
    "of the comparison; with --voronoi, how many vertices may still be nearer to another site, and "
    "by how much.\n"
    "--csv has columns vertex,distance,path,heat, where path is the length along edges; with "
    "--each source,vertex,distance; with --voronoi vertex,site. Vertices without a value have no "
    "row; in files of --out they are NaN, in .glb and .gltf 0 in the attribute _HAS_DISTANCE.",
    "star:6 --from 100 --png distance.png\nbunny.obj --from 17 --radius 0.3 --csv distance.csv\n"
    "torus:120x40 --voronoi --from random:60 --png cells.png"};

/* With --each, number of sources from which regions pay for their creation. Where a region would
 * save nothing, it has no boundary and its creation is almost free. */
enum { REGION_PAYS = 70 };

/* A point of the surface: face:F,U,V, or point:X,Y,Z for the nearest one to a point in space. Makes
 * it a vertex. */
static sl_int place_source(const char *from, mesh *m) {
    double x[3];
    char rest = 0;
    face_point p;
    sl_int vertex = 0;
    const bool in_face = strncmp(from, "face:", 5) == 0;
    if (sscanf(strchr(from, ':') + 1, "%lf,%lf,%lf%c", &x[0], &x[1], &x[2], &rest) != 3 ||
        !isfinite(x[0]) || !isfinite(x[1]) || !isfinite(x[2])) {
        app_die_usage("--from %s: expected face:F,U,V or point:X,Y,Z", from);
    }
    if (in_face) {
        if (!(x[0] >= 0 && x[0] < m->n_faces && x[0] == floor(x[0]))) {
            app_die("--from %s: there is no such face; the last one is %d", from,
                    (int)m->n_faces - 1);
        }
        if (!(x[1] >= 0 && x[2] >= 0 && x[1] + x[2] <= 1)) {
            app_die_usage("--from %s: U and V are 0 or more, and together at most 1", from);
        }
        p.face = (sl_int)x[0];
        p.u = x[1];
        p.v = x[2];
    } else {
        p = nearest_face_point(m, x);
    }
    if (!insert_face_point(m, &p, &vertex)) {
        app_die("--from %s: out of memory for a vertex there", from);
    }
    const double *at = m->xyz + 3 * (size_t)vertex;
    app_detail("source     in face %d at (%.3g, %.3g), vertex %d at %.6g %.6g %.6g\n", (int)p.face,
               p.u, p.v, (int)vertex, at[0], at[1], at[2]);
    return vertex;
}

static void find_sources(geodesic_command *cmd) {
    const char *from = cmd->from;
    const bool is_point =
        from != NULL && (strncmp(from, "face:", 5) == 0 || strncmp(from, "point:", 6) == 0);
    const sl_int vertex = is_point ? place_source(from, &cmd->m) : 0;
    source_list_read(&cmd->from_list, "from", is_point ? NULL : from, &cmd->m);
    cmd->sources = cmd->from_list.vertices;
    cmd->n_sources = cmd->from_list.count;
    if (is_point) {
        cmd->sources[0] = vertex;
    }
}

/* Reads the mesh, finds the sources, gets both factors and aims the camera. */
static void open_command(geodesic_command *cmd, const char *operand) {
    double time = cmd->time, scaled = cmd->scaled_time;
    app_mesh(&cmd->m, operand, true);
    app_set_up(&cmd->output, &cmd->m, cmd->output.png != NULL);
    find_sources(cmd);
    double edge = app_mean_edge_length(&cmd->m);
    const bool at_once = cmd->n_sources > 1 && !cmd->each && !cmd->voronoi && !cmd->cut;
    const double first = at_once ? HEAT_FACTORS_SEVERAL : HEAT_FACTORS_FIRST;
    double t = time > 0 ? time : (scaled > 0 ? scaled : first) * edge * edge;
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
    app_detail(
        "mesh       %d vertices, %d faces, mean edge %.4g; time %.4g; both factors %s in %.1f ms\n",
        (int)cmd->m.n_vertices, (int)cmd->m.n_faces, edge, cmd->s.t,
        is_saved ? "mapped and checked" : "made", 1e3 * (app_now() - began));
    accuracy_warn_poisson(cmd->s.m, cmd->s.inc.lengths,
                          cmd->surface.lengths != NULL ? cmd->surface.share : 1);
    if (!is_saved && !(time > 0) && !(scaled > 0)) {
        heat_factors_find_time(&cmd->s, first, edge * edge, cmd->sources, cmd->n_sources,
                               &cmd->heat);
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
    if ((cmd->each || cmd->voronoi || cmd->exact != NULL) && cmd->from != NULL &&
        strncmp(cmd->from, "curve:", 6) == 0) {
        app_die_usage(
            "--from %.20s: a curve is one source, and not for --each, --voronoi and --exact",
            cmd->from);
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
         "sources or sites: " SOURCE_LIST_HELP
         "; or one point of the surface, which becomes a vertex: face:F,U,V, (1-U-V, U, V) of the "
         "corners of face F, or point:X,Y,Z, the nearest one to a point in space (the first vertex "
         "of a face with an area)"},
        {OPTION_ABOVE_0, "radius", &cmd.radius, "R", "largest distance wanted (unlimited)"},
        {OPTION_REAL, "margin", &cmd.margin, "F",
         "radius of the ball along edges, in units of --radius (1.5)"},
        {OPTION_COUNT, "solves", &cmd.solves, "N", "local solves for the distance in a ball (3)"},
        {OPTION_FLAG, "cut", &cmd.cut, NULL,
         "one solve, with the right-hand side truncated at the rim of the ball"},
        {OPTION_ABOVE_0, "time", &cmd.time, "T", "diffuse heat for the time T"},
        {OPTION_ABOVE_0, "scaled-time", &cmd.scaled_time, "S",
         "diffuse heat for S times the squared mean edge length (4, from several sources at once "
         "1, or more if heat would be negative)"},
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
         "paths; it takes about 10 seconds for each 100,000 vertices and source"},
        {OPTION_FLAG, "voronoi", &cmd.voronoi, NULL, "nearest site in place of the distance"},
        LAPLACIAN_OPTION(&cmd.laplacian),
        APP_OUTPUT_OPTIONS(&cmd.output),
        APP_WELD_OPTION,
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
        geodesic_cells(&cmd);
    } else if (cmd.each) {
        geodesic_distances_of_each(&cmd);
    } else {
        geodesic_distances(&cmd);
    }
    source_list_free(&cmd.from_list);
    heat_solver_free(&cmd.s);
    intrinsic_free(&cmd.surface);
    mesh_free(&cmd.m);
    return 0;
}

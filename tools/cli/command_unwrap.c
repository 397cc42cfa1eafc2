/* command_unwrap.c: planar layouts of surfaces: conformal, rigid, without flipped faces */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "command.h"
#include "solve_accuracy.h"
#include "tools/io/field_table.h"
#include "tools/mesh/adjacency.h"
#include "unwrap.h"

static const options_usage usage = {"unwrap", "MESH", 1, 1,
                                    "Lays a surface out in the plane: texture coordinates."};

static const options_manual manual = {
    "Each connected part gets a layout of its own, and all are placed side by side. Holes stay "
    "holes. "
    "Handles are cut along short loops, closed parts between two vertices far apart and "
    "further to where they would shrink most. Edges with three or more faces are cut, too.\n"
    "slim: no face is flipped. The symmetric Dirichlet energy falls from a conformal layout, or, "
    "if that "
    "has flipped faces, from one with the boundary on a circle (Rabinovich et al. 2017), at the "
    "end "
    "by Newton's method. A disk with holes is cut only if that lowers the energy.\n"
    "arap: as rigid as possible; faces may be flipped (Liu et al. 2008).\n"
    "scp: angles are preserved as well as possible, the boundary is free (Mullen et al. 2008).\n"
    "lscm: the same with two or more vertices held (Levy et al. 2002).\n"
    "harmonic: the longest boundary on a circle, harmonic coordinates inside.\n"
    "tutte: the longest boundary on a circle, no face flipped.\n"
    "With --pins, lscm holds vertices exactly, and slim and arap by stiff springs.",
    "How many parts there are and how many edges are cut; how the method ended; how far the worst "
    "face is stretched; and in the last line whether the layout is good. The ratio of a face is "
    "that "
    "of the singular values of its map, 1 if it preserves angles. energy: of slim the mean of "
    "a^2 + b^2 + 1/a^2 + 1/b^2 with these values, at least 4; of arap the mean of (a - 1)^2 + "
    "(b - 1)^2.\n"
    "--out FILE.obj has the mesh as it is, with texture coordinates at the corners of faces; in "
    "other formats the vertices along cuts are repeated.\n"
    "Exit status 1: not converged within --iterations, or faces are flipped with slim or tutte.",
    "star:6 --png mesh.png --layout layout.png\n"
    "bunny.obj --out bunny_uv.obj\n"
    "hills:100x100 --method lscm --pins pins.csv --csv layout.csv"};

static const char *const method_names[] = {"slim", "arap", "scp", "lscm", "harmonic", "tutte"};
enum { METHODS = sizeof method_names / sizeof *method_names };

static unwrap_method method_named(const char *text) {
    for (int k = 0; k < METHODS; k++) {
        if (strcmp(text, method_names[k]) == 0) {
            return (unwrap_method)k;
        }
    }
    app_die_usage("--method %s: expected slim, arap, scp, lscm, harmonic or tutte", text);
}

/* ---- the surface ---- */

/* Marks the faces between the vertices of the options; NULL: all. */
static unsigned char *faces_taken(const unwrap_command *cmd) {
    const sl_int n = cmd->m.n_vertices;
    sl_int count = cmd->size, *list = NULL;
    if (cmd->list == NULL && cmd->size == 0) {
        return NULL;
    }
    unsigned char *inside = app_alloc((size_t)n, 1);
    unsigned char *taken = app_alloc((size_t)cmd->m.n_faces, 1);
    if (cmd->list != NULL) {
        list = app_vertices("list", cmd->list, n, 1, &count);
    } else {
        adjacency graph;
        const sl_int start = cmd->vertex >= 0 ? cmd->vertex : app_default_vertex(&cmd->m);
        if (start >= n) {
            app_die("--center: vertex %d: the mesh has no such vertex", (int)start);
        }
        count = count < n ? count : n;
        list = app_alloc((size_t)count, sizeof *list);
        if (!adjacency_from_mesh(&graph, &cmd->m)) {
            app_die("out of memory for the edges of the mesh");
        }
        count = adjacency_bfs(list, count, &graph, start, inside);
        adjacency_free(&graph);
    }
    for (sl_int k = 0; k < count; k++) {
        inside[list[k]] = 1;
    }
    for (size_t f = 0; f < (size_t)cmd->m.n_faces; f++) {
        const sl_int *v = cmd->m.faces + 3 * f;
        taken[f] = inside[v[0]] && inside[v[1]] && inside[v[2]];
    }
    free(inside);
    free(list);
    return taken;
}

static void open_surface(unwrap_command *cmd, const char *operand) {
    app_mesh(&cmd->m, operand, true);
    app_set_up(&cmd->picture, &cmd->m, cmd->picture.png != NULL || cmd->patch_png != NULL);
    unsigned char *taken = faces_taken(cmd);
    if (!sheet_create(&cmd->s, &cmd->m, taken)) {
        app_die("out of memory for %d faces", (int)cmd->m.n_faces);
    }
    free(taken);
    if (cmd->s.n_parts == 0) {
        app_die("there is no face with three different vertices to lay out");
    }
    app_aim_camera(&cmd->picture, &cmd->s.m, NULL, 0, true);
    accuracy_warn_poisson(&cmd->s.m, NULL, 1);
    if (cmd->s.left_out > 0) {
        app_warn("%d faces have the same vertex twice and get no place in the layout",
                 (int)cmd->s.left_out);
    }
}

/* Reads --pins: a table vertex,u,v as --csv writes it. */
static void read_pins(unwrap_command *cmd, field_table *t) {
    char message[512];
    if (cmd->pins == NULL) {
        return;
    }
    if (!field_table_read(t, cmd->pins, cmd->m.n_vertices, message, sizeof message)) {
        app_die("%s", message);
    }
    if (t->n_fields < 2) {
        app_die("%s: expected the columns vertex,u,v", cmd->pins);
    }
    cmd->pin_u = t->values[0];
    cmd->pin_v = t->values[1];
}

static void lay_out_all(unwrap_command *cmd) {
    cmd->n_parts = cmd->s.n_parts;
    cmd->parts = app_alloc((size_t)cmd->n_parts, sizeof *cmd->parts);
    for (sl_int k = 0; k < cmd->n_parts; k++) {
        if (!sheet_take_part(&cmd->parts[k].s, &cmd->s, k)) {
            app_die("out of memory for %d faces", (int)cmd->s.m.n_faces);
        }
        unwrap_lay_out(cmd, &cmd->parts[k]);
        app_progress("parts", (double)(k + 1) / (double)cmd->n_parts);
    }
    app_progress_end();
}

/* ---- the report ---- */

typedef struct summary {
    sl_int cut, loops, flipped, flat, raised, faces;
    int iterations, from_tutte, unfinished;
    double energy, area, ratio, worst, lengths;
} summary;

static summary summarize(const unwrap_command *cmd) {
    summary all;
    memset(&all, 0, sizeof all);
    for (sl_int k = 0; k < cmd->n_parts; k++) {
        const unwrap_part *p = &cmd->parts[k];
        all.cut += p->cut;
        all.loops += p->boundary.n_loops - 1;
        all.flipped += p->flipped;
        all.flat += p->q.degenerate;
        all.raised += p->l.raised;
        all.faces += p->s.m.n_faces;
        all.iterations = p->iterations > all.iterations ? p->iterations : all.iterations;
        all.from_tutte += p->from_tutte;
        all.unfinished += !p->converged;
        all.energy += p->l.whole * p->energy;
        all.ratio += isfinite(p->q.angle) ? p->l.whole * p->q.angle : 0;
        all.lengths += p->l.whole * p->q.isometric;
        all.area += p->l.whole;
        all.worst = fmax(all.worst, p->q.angle_ratio_max);
    }
    return all;
}

static void print_method(const unwrap_command *cmd, const summary *all, double seconds) {
    static const char *const ends[] = {" (4: no distortion)", " (0: no distortion)",
                                       " (0: all angles are preserved)"};
    printf("layout     %s, %.3g s", method_names[cmd->method], seconds);
    if (cmd->method <= UNWRAP_SCP) {
        printf(": %d iterations, energy %.6g%s", all->iterations, all->energy / all->area,
               ends[cmd->method]);
    }
    printf(all->from_tutte == 0 ? ".\n"
           : cmd->n_parts == 1  ? "; begun on a circle.\n"
                                : "; %d parts begun on a circle.\n",
           all->from_tutte);
}

static void warn(const unwrap_command *cmd, const summary *all) {
    if (all->unfinished > 0) {
        app_warn("%d of %d parts have not converged within %d iterations: raise --iterations",
                 all->unfinished, (int)cmd->n_parts, (int)cmd->iterations);
    }
    if (all->flipped > 0) {
        app_warn("%d of %d faces are flipped or flat in the layout: it overlaps itself%s",
                 (int)all->flipped, (int)all->faces,
                 cmd->method == UNWRAP_SLIM || cmd->method == UNWRAP_TUTTE
                     ? ""
                     : "; --method slim flips none");
    }
    if (all->raised > 0) {
        app_warn("%d of %d faces are thinner than 1 : %g, and laid out as if they were that thick",
                 (int)all->raised, (int)all->faces, 1 / LAYOUT_THINNEST);
    }
    if (all->worst > 100) {
        app_warn("the worst face is stretched %.3g times as much one way as the other", all->worst);
    }
}

static void report(const unwrap_command *cmd, double seconds) {
    const summary all = summarize(cmd);
    printf("surface    %d faces in %d part%s, %d hole%s; cut along %d edges.\n", (int)all.faces,
           (int)cmd->n_parts, cmd->n_parts == 1 ? "" : "s", (int)all.loops,
           all.loops == 1 ? "" : "s", (int)all.cut);
    print_method(cmd, &all, seconds);
    for (sl_int k = 0; k < cmd->n_parts && options_verbose; k++) {
        const unwrap_part *p = &cmd->parts[k];
        printf("part       %d: %d faces, %d edges cut, %d iterations, energy %.9g; flipped %d, "
               "worst ratio %.4g, mean %.4g; conformal %.3g, lengths %.3g, areas %.3g\n",
               (int)k, (int)p->s.m.n_faces, (int)p->cut, p->iterations, p->energy, (int)p->flipped,
               p->q.angle_ratio_max, p->q.angle, p->q.conformal, p->q.isometric, p->q.area_spread);
    }
    printf("faces      %d flipped; the ratio of the worst is %.4g, the mean %.4g.\n",
           (int)all.flipped, all.worst, all.ratio / all.area);
    warn(cmd, &all);
    const char *verdict = all.flipped > 0 || !isfinite(all.worst) ? "bad"
                          : all.worst > 100                       ? "poor"
                          : all.worst > 10                        ? "fair"
                                                                  : "good";
    printf("result     %s: %s.\n", verdict,
           all.flipped > 0   ? "it overlaps itself"
           : all.worst > 100 ? "no face is flipped, but some are squashed"
           : all.worst > 10  ? "no face is flipped, some are stretched by more than 10"
                             : "no face is flipped or stretched by more than 10");
}

static void close_surface(unwrap_command *cmd) {
    for (sl_int k = 0; k < cmd->n_parts; k++) {
        unwrap_part_free(&cmd->parts[k]);
    }
    free(cmd->parts);
    sheet_free(&cmd->s);
    mesh_free(&cmd->m);
}

int command_unwrap(int argc, char **argv) {
    unwrap_command cmd;
    const char *method = "slim", *operand = NULL;
    field_table pins;
    memset(&cmd, 0, sizeof cmd);
    memset(&pins, 0, sizeof pins);
    cmd.vertex = -1;
    cmd.iterations = 500;
    cmd.tolerance = 1e-5;
    cmd.checks = 20;
    const option options[] = {
        {OPTION_TEXT, "method", &method, "slim|arap|scp|lscm|harmonic|tutte",
         "what the layout preserves, see above (slim)"},
        {OPTION_COUNT, "patch", &cmd.size, "N",
         "lay out only the faces between the N vertices nearest to --center by edges"},
        {OPTION_COUNT, "center", &cmd.vertex, "V",
         "the vertex around which --patch is (the first vertex of a face with an area)"},
        {OPTION_TEXT, "list", &cmd.list, "LIST",
         "lay out only the faces between these vertices: 3,17,100-200"},
        {OPTION_TEXT, "pins", &cmd.pins, "FILE",
         "places of some vertices: a table vertex,u,v, as --csv writes it"},
        {OPTION_COUNT, "iterations", &cmd.iterations, "N",
         "largest number of iterations of slim, arap and scp (500)"},
        {OPTION_REAL, "tolerance", &cmd.tolerance, "E",
         "slim and arap have converged when an iteration lowers the energy by at most E of "
         "itself (1e-5)"},
        {OPTION_OUTPUT, "out", &cmd.out, "FILE",
         "write the mesh with texture coordinates, scaled to the unit square unless there are "
         "pins: .obj, .ply, .vtk, .glb or .gltf"},
        {OPTION_OUTPUT, "csv", &cmd.picture.csv, "FILE",
         "write a table vertex,u,v,part, in the units of the mesh"},
        {OPTION_OUTPUT, "layout", &cmd.layout_png, "FILE", "draw the layout in the plane (.png)"},
        {OPTION_OUTPUT, "close", &cmd.patch_png, "FILE",
         "draw the faces that are laid out alone, with the checkerboard (.png)"},
        {OPTION_COUNT, "checks", &cmd.checks, "N",
         "squares of the checkerboard along the longer side of the layout (20)"},
        APP_PICTURE_OPTIONS(&cmd.picture),
        APP_WELD_OPTION,
        {OPTION_END, NULL, NULL, NULL, NULL}};
    options_read(&usage, &manual, options, argc, argv, &operand);
    cmd.method = method_named(method);
    if (!(cmd.tolerance >= 0)) {
        app_die_usage("--tolerance: expected 0 or more");
    }
    app_check_output(&cmd.picture, cmd.out);
    open_surface(&cmd, operand);
    read_pins(&cmd, &pins);
    const double began = app_now();
    lay_out_all(&cmd);
    report(&cmd, app_now() - began);
    unwrap_pack(&cmd);
    unwrap_write(&cmd);
    const summary all = summarize(&cmd);
    const bool keeps = cmd.method == UNWRAP_SLIM || cmd.method == UNWRAP_TUTTE;
    close_surface(&cmd);
    field_table_free(&pins);
    return all.unfinished > 0 || (keeps && all.flipped > 0);
}

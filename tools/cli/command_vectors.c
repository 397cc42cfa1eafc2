/* command_vectors.c: parallel transport of tangent vectors, and the logarithmic map of a vertex */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "app.h"
#include "command.h"
#include "heat_system.h"
#include "tools/draw/arrows.h"
#include "path_check.h"
#include "tools/geometry/vector_heat.h"

static const options_usage usage = {
    "vectors", "MESH", 1, 1,
    "Transports tangent vectors over a surface, or computes the logarithmic map of a vertex."};

static const options_manual manual = {
    "The vector heat method (Sharp, Soliman, Crane 2019): vectors diffuse from the sources for a "
    "short time with the connection Laplacian, a complex Hermitian matrix, which turns them from "
    "tangent plane to tangent plane. Each vertex gets the vector of the nearest source, moved "
    "along the shortest path. With --log the result is the vector from the source to each vertex, "
    "along the surface and in the tangent plane of the source (by diffusion of points; Soliman, "
    "Sharp 2025). With --radius the same is computed by local solves, for the vertices near the "
    "sources alone.\n"
    "Exact: linear solves, and both results on planes and on what can be unrolled to a plane. "
    "Elsewhere errors are those of the mesh and of the diffusion, which averages over several "
    "edges; where two paths are almost equally short, so are the results. Far from the source "
    "logarithms become too long or too short: their lengths are compared with paths over the faces "
    "as the command geodesic does, and moved where they differ by more than a quarter of an edge "
    "and half the difference of two paths (not with --raw); directions stay. In a short time heat "
    "can become negative behind obtuse faces: results there are nan. Unless a time is given, "
    "it grows until no heat is. "
    "Faces must be oriented alike: vectors turn arbitrarily where they are not, and at edges of "
    "three faces.",
    "prepared: complex rows, entries of L, and the time for both factors. transport or logarithm: "
    "number of vertices and time. reads: rows and entries of L that the last complex solve reads, "
    "in real rows.\n"
    "--csv has columns vertex,x,y,z: vectors in space, in the tangent plane of the vertex or, with "
    "--log, of the source. --png draws arrows of the vectors, or with "
    "--log a checkerboard of the logarithms. --out has the vectors as fields x, y, z and with "
    "--log their coordinates in the tangent plane as texture coordinates.",
    "star:6 --from 100 --png vectors.png\nbunny.obj --from 17,400 --vectors 1,0,0:0,0,1 --csv "
    "v.csv\nbunny.obj --from 17 --log --radius 0.2 --png log.png"};

typedef struct vectors_command {
    const char *from, *vectors;
    bool log, raw;
    double radius;
    heat_time time;
    app_output output;
    mesh m;
    vector_heat s;
    sl_int *sources, n_sources;
    double *given; /* 2 n_sources: in the tangent planes */
    vector_field f;
    double *space; /* 3 f.n */
} vectors_command;

/* Reads the vectors in space, one for each source or one for all; returns their number. */
static sl_int read_vectors(double *out, const char *text, sl_int most) {
    const char *at = text;
    for (sl_int k = 0;; k++) {
        for (int d = 0; d < 3; d++) {
            char *end = NULL;
            const double x = strtod(at, &end);
            const bool is_last = d == 2;
            if (end == at || !isfinite(x) || k == most ||
                (is_last ? *end != ':' && *end != '\0' : *end != ',')) {
                app_die_usage("--vectors %s: expected X,Y,Z or, separated by colons, one for each "
                              "of the %d sources",
                              text, (int)most);
            }
            out[3 * (size_t)k + (size_t)d] = x;
            at = end + (*end != '\0');
            if (is_last && *end == '\0') {
                return k + 1;
            }
        }
    }
}

/* The vectors in the tangent planes of the sources. */
static void place_vectors(vectors_command *cmd) {
    const size_t n = (size_t)cmd->n_sources;
    double *space = app_alloc(3 * n, sizeof *space);
    sl_int count = cmd->vectors != NULL ? read_vectors(space, cmd->vectors, cmd->n_sources) : 0;
    if (count > 1 && count < cmd->n_sources) {
        app_die_usage("--vectors: %d vectors for %d sources", (int)count, (int)cmd->n_sources);
    }
    cmd->given = app_alloc(2 * n, sizeof *cmd->given);
    for (size_t k = 0; k < n; k++) {
        const double x[3] = {1, 0, 0}, y[3] = {0, 1, 0};
        const double *vector = count > 1 ? space + 3 * k : count == 1 ? space : x;
        double *z = cmd->given + 2 * k;
        connection_from_space(z, &cmd->s.frames, cmd->sources[k], vector);
        if (count == 0 && hypot(z[0], z[1]) < 0.1) {
            connection_from_space(z, &cmd->s.frames, cmd->sources[k], y);
        }
        if (!(hypot(z[0], z[1]) > 0)) {
            app_die("--vectors: at vertex %d nothing of the vector is tangent to the surface",
                    (int)cmd->sources[k]);
        }
    }
    free(space);
}

static void prepare(vectors_command *cmd, double t) {
    const double began = app_now();
    app_stage("factoring");
    app_must(vector_heat_create(&cmd->s, &cmd->m, t), "factors", &cmd->s.stats);
    app_progress_end();
    app_detail("%-10s %d complex rows, %lld real entries of L, t = %.6g, %.1f ms\n", "prepared",
               (int)cmd->m.n_vertices, (long long)cmd->s.stats.symbolic.nnz_panels, cmd->s.t,
               1e3 * (app_now() - began));
}

/* Gives the logarithms lengths that paths over the faces allow (path_check.h); directions stay. */
static void bound_lengths(vectors_command *cmd) {
    const size_t n = (size_t)cmd->f.n;
    double *length = app_alloc(n, sizeof *length), *z = cmd->f.z;
    heat_field field;
    path_check check;
    memset(&field, 0, sizeof field);
    field.n = cmd->f.n;
    field.vertices = cmd->f.vertices;
    field.distance = length;
    for (size_t k = 0; k < n; k++) {
        length[k] = hypot(z[2 * k], z[2 * k + 1]);
    }
    app_stage("comparing with paths");
    path_check_open(&check, &cmd->m);
    check.slack = 0.25; /* the plane, where logarithms are exact, stays as it is */
    path_check_distances(&check, &field, cmd->sources, 1, 0,
                         cmd->radius > 0 ? 2 * cmd->radius : INFINITY);
    app_progress_end();
    path_check_report(&check);
    path_check_close(&check);
    for (size_t k = 0; k < n; k++) {
        const double before = hypot(z[2 * k], z[2 * k + 1]);
        const double scale = before > 0 ? length[k] / before : 1;
        z[2 * k] *= scale;
        z[2 * k + 1] *= scale;
    }
    free(length);
}

static void solve(vectors_command *cmd) {
    vector_field *f = &cmd->f;
    const double began = app_now();
    if (cmd->log) {
        app_must(vector_heat_logarithm(f, &cmd->s, cmd->sources[0], cmd->radius), "logarithm",
                 NULL);
    } else {
        app_must(vector_heat_transport(f, &cmd->s, cmd->sources, cmd->given, cmd->n_sources,
                                       cmd->radius),
                 "transport", NULL);
    }
    app_detail("%-10s from %d %s to %d of %d, %.1f ms\n", cmd->log ? "logarithm" : "transport",
               (int)cmd->n_sources, cmd->n_sources == 1 ? "vertex" : "vertices", (int)f->n,
               (int)cmd->m.n_vertices, 1e3 * (app_now() - began));
    app_print_reads("reads", &f->stats);
}

/* Prepares and solves; unless a time is given, it grows until heat arrives everywhere. */
static void compute(vectors_command *cmd) {
    enum { LAST_TIME = 64 }; /* in squared mean edge lengths, 4 times more each time */
    const bool is_given = cmd->time.time > 0 || cmd->time.scaled > 0;
    const vector_field *f = &cmd->f;
    double t = heat_time_value(&cmd->time, &cmd->m, 0);
    const double last = is_given ? t : LAST_TIME * t;
    for (;; t *= 4) {
        prepare(cmd, t);
        place_vectors(cmd);
        solve(cmd);
        if (f->unreached == 0 || t >= last) {
            break;
        }
        vector_field_free(&cmd->f);
        vector_heat_free(&cmd->s);
        free(cmd->given);
    }
    printf("%s from %d %s %s %d of %d vertices.\n",
           cmd->log ? "The logarithmic map" : "Parallel transport", (int)cmd->n_sources,
           cmd->n_sources == 1 ? "vertex" : "vertices", cmd->log ? "covers" : "reaches", (int)f->n,
           (int)cmd->m.n_vertices);
    if (f->unreached > 0) {
        app_warn("no heat arrives at %d vertices%s", (int)f->unreached,
                 is_given ? ": a longer time helps" : "");
    }
    if (cmd->s.frames.irregular > 0) {
        app_warn("%d edges have three or more faces or faces of unlike orientation; vectors turn "
                 "arbitrarily there",
                 (int)cmd->s.frames.irregular);
    }
    if (cmd->log && !cmd->raw) {
        bound_lengths(cmd);
    }
    cmd->space = app_alloc(3 * (size_t)f->n, sizeof *cmd->space);
    for (sl_int k = 0; k < f->n; k++) {
        connection_to_space(cmd->space + 3 * (size_t)k, &cmd->s.frames,
                            cmd->log ? cmd->sources[0] : f->vertices[k], f->z + 2 * (size_t)k);
    }
}

static void write_csv(const vectors_command *cmd) {
    FILE *csv = app_create(cmd->output.csv);
    fprintf(csv, "vertex,x,y,z\n");
    for (sl_int k = 0; k < cmd->f.n; k++) {
        const double *x = cmd->space + 3 * (size_t)k;
        fprintf(csv, "%d,%.17g,%.17g,%.17g\n", (int)cmd->f.vertices[k], x[0], x[1], x[2]);
    }
    app_close(csv);
}

/* The picture of the logarithms: squares of the tangent plane. */
static void draw_logarithm(const vectors_command *cmd, render_style *style, const double *uv) {
    unsigned char *has_uv = app_alloc((size_t)cmd->m.n_vertices, 1);
    app_output only_png = cmd->output;
    double sum = 0;
    only_png.out = NULL;
    for (size_t v = 0; v < (size_t)cmd->m.n_vertices; v++) {
        has_uv[v] = isfinite(uv[2 * v]) && isfinite(uv[2 * v + 1]);
        sum += has_uv[v] ? hypot(uv[2 * v], uv[2 * v + 1]) : 0;
    }
    style->uv = uv;
    style->has_uv = has_uv;
    style->checks = sum > 0 ? 8 * (double)cmd->f.n / sum : 0;
    app_write(&only_png, &cmd->m, NULL, style);
    free(has_uv);
}

/* The picture of transported vectors. */
static void draw_arrows(const vectors_command *cmd, render_style *style) {
    enum { N_ARROWS = 400 };
    const rgb dark = {0x1f, 0x3b, 0x6e};
    const sl_int n = cmd->f.n;
    arrows a;
    app_output only_png = cmd->output;
    only_png.out = NULL;
    if (!arrows_create(&a, &cmd->m, cmd->f.vertices, n, cmd->space, N_ARROWS, 1.5, dark)) {
        app_die("out of memory for arrows");
    }
    style->segments = a.segments;
    style->n_segments = a.n_segments;
    app_write(&only_png, &a.m, NULL, style);
    arrows_free(&a);
}

/* Writes --out and --png. Fields are NaN where nothing was computed. */
static void write_results(const vectors_command *cmd) {
    const size_t n = (size_t)cmd->m.n_vertices;
    double *fields = app_alloc(5 * n, sizeof *fields), *uv = fields + 3 * n;
    for (size_t k = 0; k < 5 * n; k++) {
        fields[k] = NAN;
    }
    for (size_t k = 0; k < (size_t)cmd->f.n; k++) {
        const size_t v = (size_t)cmd->f.vertices[k];
        for (size_t d = 0; d < 3; d++) {
            fields[d * n + v] = cmd->space[3 * k + d];
        }
        uv[2 * v] = cmd->f.z[2 * k];
        uv[2 * v + 1] = cmd->f.z[2 * k + 1];
    }
    const mesh_field named[] = {{"x", fields}, {"y", fields + n}, {"z", fields + 2 * n}};
    const mesh_extra extra = {.uv = cmd->log ? uv : NULL, .fields = named, .n_fields = 3};
    render_style style;
    app_output only_mesh = cmd->output;
    only_mesh.png = NULL;
    app_write(&only_mesh, &cmd->m, &extra, NULL);
    memset(&style, 0, sizeof style);
    render_mark *marks = app_alloc((size_t)cmd->n_sources, sizeof *marks);
    for (sl_int k = 0; k < cmd->n_sources; k++) {
        const render_mark red = {cmd->sources[k], 4, {0xd5, 0x2b, 0x1e}};
        marks[k] = red;
    }
    style.marks = marks;
    style.n_marks = cmd->n_sources;
    if (cmd->log) {
        draw_logarithm(cmd, &style, uv);
    } else {
        draw_arrows(cmd, &style);
    }
    free(marks);
    free(fields);
}

int command_vectors(int argc, char **argv) {
    const char *operand = NULL;
    char vertex[16];
    vectors_command cmd;
    memset(&cmd, 0, sizeof cmd);
    const option options[] = {
        {OPTION_TEXT, "from", &cmd.from, "VERTICES",
         "source vertices: 3,17,100-200 or random:5 (the first vertex of a face with an area)"},
        {OPTION_TEXT, "vectors", &cmd.vectors, "VECTORS",
         "the vector X,Y,Z in space of all sources, or one for each, separated by colons; what of "
         "it is tangent to the surface counts (1,0,0, or 0,1,0 where that is almost normal)"},
        {OPTION_FLAG, "log", &cmd.log, NULL, "compute the logarithmic map of the one source"},
        {OPTION_FLAG, "raw", &cmd.raw, NULL,
         "with --log: keep the lengths as they are, without the comparison with paths"},
        {OPTION_ABOVE_0, "radius", &cmd.radius, "R",
         "only for vertices within the distance R, along edges, of a source"},
        {OPTION_ABOVE_0, "time", &cmd.time.time, "T", "diffuse for the time T"},
        {OPTION_ABOVE_0, "scaled-time", &cmd.time.scaled, "S",
         "diffuse for S times the squared mean edge length (1, 4, 16 or 64, the first one that "
         "leaves no heat negative)"},
        APP_OUTPUT_OPTIONS(&cmd.output),
        APP_WELD_OPTION,
        {OPTION_END, NULL, NULL, NULL, NULL}};
    options_read(&usage, &manual, options, argc, argv, &operand);
    app_check_output(&cmd.output, cmd.output.out);
    if (cmd.log && cmd.vectors != NULL) {
        app_die_usage("--log and --vectors: give one of them");
    }
    app_mesh(&cmd.m, operand, true);
    app_set_up(&cmd.output, &cmd.m, cmd.output.png != NULL);
    if (cmd.from == NULL) {
        (void)snprintf(vertex, sizeof vertex, "%d", (int)app_default_vertex(&cmd.m));
        cmd.from = vertex;
    }
    cmd.sources = app_vertices("from", cmd.from, cmd.m.n_vertices, 1, &cmd.n_sources);
    cmd.n_sources = app_distinct(cmd.sources, cmd.n_sources, cmd.m.n_vertices);
    if (cmd.log && cmd.n_sources != 1) {
        app_die_usage("--log: expected one vertex in --from, not %d", (int)cmd.n_sources);
    }
    compute(&cmd);
    if (cmd.output.csv != NULL) {
        write_csv(&cmd);
    }
    app_aim_camera(&cmd.output, &cmd.m, cmd.sources, cmd.n_sources, false);
    write_results(&cmd);
    vector_field_free(&cmd.f);
    vector_heat_free(&cmd.s);
    free(cmd.space);
    free(cmd.given);
    free(cmd.sources);
    mesh_free(&cmd.m);
    return 0;
}

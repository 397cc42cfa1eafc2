/* layout_command.c: shared by param, arap and scp: options, patch, factor, layouts, output */
#include "layout_command.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "solve_accuracy.h"
#include "tools/geometry/harmonic_map.h"
#include "tools/io/input.h"
#include "tools/mesh/int_list.h"
#include "tools/geometry/laplacian.h"

void layout_command_defaults(layout_command *job) {
    memset(job, 0, sizeof *job);
    job->vertex = -1;
    job->checks = 20;
    job->boundary = "circle";
}

static sl_int *read_list(const char *path, sl_int *count) {
    char message[512];
    input in;
    if (!input_open(&in, path, message, sizeof message)) {
        app_die("%s", message);
    }
    in.line = 1;
    in.comment = '#';
    int_list list = {NULL, 0, 0};
    while (input_more(&in)) {
        int64_t v;
        if (!input_integer(&in, &v) || !input_at_word_end(&in) || v < 0 || v > INT32_MAX) {
            (void)input_error(&in, "not a vertex number");
            app_die("%s", message);
        }
        if (list.count == INT32_MAX || !int_list_add(&list, (sl_int)v)) {
            app_die("out of memory");
        }
    }
    input_close(&in);
    *count = (sl_int)list.count;
    return list.at;
}

/* The vertex from which the patch is grown. */
static sl_int first_vertex(const layout_command *job) {
    return job->vertex >= 0 ? job->vertex : app_default_vertex(&job->m);
}

/* Takes the patch from a list of vertices or grows it. */
static void find_patch(layout_command *job) {
    char message[512] = "";
    sl_int n = job->m.n_vertices;
    bool ok;
    job->seam = 0;
    if (job->list != NULL || job->list_file != NULL) {
        sl_int count;
        if (job->list != NULL && job->list_file != NULL) {
            app_die_usage("--list and --list-file: give one of them");
        }
        sl_int *list = job->list != NULL ? app_vertices("list", job->list, n, 1, &count)
                                         : read_list(job->list_file, &count);
        ok = disk_patch_from_vertices(&job->d, &job->inc, list, count, message, sizeof message);
        free(list);
    } else {
        sl_int start = first_vertex(job), size = job->size;
        if (size == 0) {
            size = n / 4 < LAYOUT_SIZE ? n / 4 : LAYOUT_SIZE;
            size = size < 3 ? 3 : size;
        }
        ok = disk_patch_grow(&job->d, &job->inc, start, size, &job->seam, message, sizeof message);
        if (ok && job->d.p.m.n_vertices < size) {
            printf("the disk around vertex %d cannot grow beyond %d vertices\n", (int)start,
                   (int)job->d.p.m.n_vertices);
        }
    }
    if (!ok) {
        app_die("%s", message);
    }
    if (job->seam > 0) {
        printf("the patch meets itself: %d faces are omitted as a seam\n", (int)job->seam);
    }
}

static void factor_mesh(layout_command *job) {
    sl_options opt;
    sl_stats stats;
    memset(&opt, 0, sizeof opt);
    opt.pivots = SL_PIVOTS_SKIP_NULL; /* the constants are the null space of L */
    opt.consistency_tolerance = PATCH_SOLVER_CONSISTENCY;
    if (!laplacian_cotangent(&job->L, &job->m)) {
        app_die("out of memory");
    }
    const sl_csc A = sl_matrix_view(job->L);
    app_stage("analyzing the Laplacian");
    double began = app_now();
    app_must(sl_symbolic_create(&job->S, &A, NULL, &stats), "analysis of the Laplacian", &stats);
    app_stage_factor(stats.symbolic.flops);
    app_must(sl_factor_create(&job->F, job->S, &A, &opt, &stats), "factor of the Laplacian",
             &stats);
    job->seconds_factor = app_now() - began;
    app_progress_end();
}

static void plan_patch(layout_command *job) {
    double began = app_now();
    app_must(patch_solver_create(&job->s, job->S, job->F, &job->d.p), "plan of the patch", NULL);
    double planned = app_now();
    job->seconds_plan = planned - began;
    if (job->region) {
        app_must(patch_solver_use_region(&job->s, job->S), "region of the patch", NULL);
        job->seconds_region = app_now() - planned;
    }
}

void layout_command_regrow(layout_command *job, sl_int size) {
    char message[512] = "";
    patch_solver_free(&job->s);
    disk_patch_free(&job->d);
    if (!disk_patch_grow(&job->d, &job->inc, first_vertex(job), size, &job->seam, message,
                         sizeof message)) {
        app_die("%s", message);
    }
    plan_patch(job);
}

void layout_command_open(layout_command *job, const char *operand) {
    if (strcmp(job->boundary, "circle") != 0 && strcmp(job->boundary, "unrolled") != 0) {
        app_die_usage("--boundary %s: expected circle or unrolled", job->boundary);
    }
    app_check_output(&job->picture, job->out);
    app_mesh(&job->m, operand, true);
    app_set_up(&job->picture, &job->m, job->picture.png != NULL || job->patch_png != NULL);
    if (!incidence_create(&job->inc, &job->m)) {
        app_die("out of memory");
    }
    find_patch(job);
    app_aim_camera(&job->picture, &job->d.p.m, NULL, 0, true);
    factor_mesh(job);
    plan_patch(job);
    sl_stats all;
    all.symbolic = sl_symbolic_view(job->S).info;
    printf("mesh       %d vertices, %d faces; Laplacian factored in %.1f ms\n",
           (int)job->m.n_vertices, (int)job->m.n_faces, 1e3 * job->seconds_factor);
    printf("patch      %d vertices, %d faces, %d on its boundary, %d with neighbors outside\n",
           (int)job->d.p.m.n_vertices, (int)job->d.p.m.n_faces, (int)job->d.n_boundary,
           (int)job->d.p.n_interface);
    printf("plan       reads %.3g of %.3g entries of the factor (%.1f %%); created in %.2f ms\n",
           (double)job->s.stats.plan.x_entries, (double)all.symbolic.nnz_panels,
           all.symbolic.nnz_panels > 0
               ? 1e2 * (double)job->s.stats.plan.x_entries / (double)all.symbolic.nnz_panels
               : 0,
           1e3 * job->seconds_plan);
    if (job->region) {
        app_print_region("region", &job->s.stats, job->seconds_region);
    }
    app_print_reads("reads", &job->s.stats);
    accuracy_warn_poisson(&job->d.p.m, NULL, 1);
}

double *layout_command_boundary(const layout_command *job) {
    double *uv = app_alloc(2 * (size_t)job->d.n_boundary, sizeof *uv);
    if (strcmp(job->boundary, "circle") == 0) {
        boundary_to_circle(uv, &job->d);
    } else {
        boundary_unroll(uv, &job->d);
    }
    return uv;
}

double *layout_command_flux(const layout_command *job, const double *boundary) {
    double *b = app_alloc(2 * (size_t)job->d.n_boundary, sizeof *b);
    double *B = app_alloc(2 * (size_t)job->d.p.m.n_vertices, sizeof *B);
    boundary_neumann_rhs(b, boundary, job->d.n_boundary);
    boundary_scatter(B, b, &job->d);
    free(b);
    return B;
}

void layout_command_report_head(void) {
    printf("%-34s %10s %10s %10s %10s %8s %6s\n", "layout", "conformal", "angles", "lengths",
           "areas", "flipped", "flat"); /* explained by LAYOUT_OUTPUT */
}

distortion layout_command_report(const layout_command *job, const char *name, const double *X) {
    sl_int n = job->d.p.m.n_vertices;
    double *uv = app_alloc(2 * (size_t)n, sizeof *uv);
    layout_from_columns(uv, X, n);
    distortion_normalize(&job->d.p.m, uv);
    distortion q = distortion_of(&job->d.p.m, uv);
    printf("%-34s %10.3g %10.4f %10.3g %10.3g %8d %6d\n", name, q.conformal, q.angle, q.isometric,
           q.area_spread, (int)q.flipped, (int)q.degenerate);
    free(uv);
    return q;
}

/* The layout translated and scaled uniformly into the unit square. */
static double *unit_square(const layout_command *job, const double *X) {
    sl_int n = job->d.p.m.n_vertices;
    double *uv = app_alloc(2 * (size_t)n, sizeof *uv), low[2] = {INFINITY, INFINITY}, side = 0;
    layout_from_columns(uv, X, n);
    for (sl_int k = 0; k < 2 * n; k++) {
        low[k % 2] = fmin(low[k % 2], uv[k]);
    }
    for (sl_int k = 0; k < 2 * n; k++) {
        uv[k] -= low[k % 2];
        side = fmax(side, uv[k]);
    }
    for (sl_int k = 0; k < 2 * n && side > 0; k++) {
        uv[k] /= side;
    }
    return uv;
}

static void write_png(const picture *p, bool ok, const char *path) {
    if (!ok) {
        app_die("%s: out of memory for the picture", path);
    }
    app_write_png(p, path);
}

/* Draws the whole mesh, with the checkerboard on the faces of the patch. */
static void draw_mesh(const layout_command *job, const double *uv, const render_style *checkered) {
    size_t corners = 6 * (size_t)job->m.n_faces;
    double *corner_uv = app_alloc(corners, sizeof *corner_uv);
    render_style style = *checkered;
    render_view view;
    picture p;
    for (size_t k = 0; k < corners; k++) {
        corner_uv[k] = NAN;
    }
    for (sl_int f = 0; f < job->d.p.m.n_faces; f++) {
        const sl_int *there = job->m.faces + 3 * (size_t)job->d.p.mesh_faces[f];
        const sl_int *here = job->d.p.m.faces + 3 * (size_t)f;
        for (size_t c = 0; c < 3; c++) { /* the patch may have reversed the face */
            size_t k = job->d.p.vertices[here[0]] == there[c]   ? 0
                       : job->d.p.vertices[here[1]] == there[c] ? 1
                                                                : 2;
            memcpy(corner_uv + 6 * (size_t)job->d.p.mesh_faces[f] + 2 * c, uv + 2 * (size_t)here[k],
                   2 * sizeof *uv);
        }
    }
    style.uv = NULL;
    style.corner_uv = corner_uv;
    app_view(&view, &job->picture);
    bool ok = render_mesh(&p, &job->m, &view, &style);
    write_png(&p, ok, job->picture.png);
    picture_free(&p);
    free(corner_uv);
}

static void write_csv(const layout_command *job, const double *X) {
    sl_int n = job->d.p.m.n_vertices;
    double *uv = app_alloc(2 * (size_t)n, sizeof *uv);
    FILE *csv = app_create(job->picture.csv);
    layout_from_columns(uv, X, n);
    distortion_normalize(&job->d.p.m, uv);
    fprintf(csv, "vertex,u,v\n");
    for (sl_int v = 0; v < n; v++) {
        fprintf(csv, "%d,%.17g,%.17g\n", (int)job->d.p.vertices[v], uv[2 * v], uv[2 * v + 1]);
    }
    app_close(csv);
    free(uv);
}

void layout_command_write(const layout_command *job, const double *X) {
    static const rgb gray = {0x28, 0x28, 0x28};
    char message[512];
    double *uv = unit_square(job, X);
    render_style style;
    render_view view;
    picture p;
    memset(&style, 0, sizeof style);
    style.uv = uv;
    style.checks = job->checks > 0 ? (double)job->checks : 20; /* the layout is one unit wide */
    if (job->out != NULL) {
        mesh_extra extra;
        memset(&extra, 0, sizeof extra);
        extra.uv = uv;
        if (!mesh_write(job->out, &job->d.p.m, &extra, message, sizeof message)) {
            app_die("%s", message);
        }
    }
    if (job->picture.csv != NULL) {
        write_csv(job, X);
    }
    if (job->layout_png != NULL) {
        app_view(&view, &job->picture);
        style.edges = job->d.p.m.n_faces <= 20000 ? 0.4 : 0;
        style.edge_color = gray;
        bool ok = render_layout(&p, &job->d.p.m, uv, &view, &style);
        write_png(&p, ok, job->layout_png);
        picture_free(&p);
        style.edges = 0;
    }
    if (job->patch_png != NULL) {
        app_view(&view, &job->picture);
        bool ok = render_mesh(&p, &job->d.p.m, &view, &style);
        write_png(&p, ok, job->patch_png);
        picture_free(&p);
    }
    if (job->picture.png != NULL) {
        draw_mesh(job, uv, &style);
    }
    free(uv);
}

void layout_command_close(layout_command *job) {
    patch_solver_free(&job->s);
    disk_patch_free(&job->d);
    sl_factor_free(job->F);
    sl_symbolic_free(job->S);
    sl_matrix_free(job->L);
    incidence_free(&job->inc);
    mesh_free(&job->m);
}

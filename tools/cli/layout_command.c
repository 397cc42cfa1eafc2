/* layout_job.c: what the commands param, arap and scp share: the patch asked for, its first layout, what is written */
#include "layout_job.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "harmonic_map.h"
#include "input.h"
#include "int_list.h"
#include "laplacian.h"

void layout_job_defaults(layout_job *j) {
    memset(j, 0, sizeof *j);
    j->vertex = -1;
    j->checks = 20;
    j->boundary = "circle";
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
            (void)input_refuse(&in, "not the number of a vertex");
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

/* Where a patch is grown from. */
static sl_int first_vertex(const layout_job *j) {
    sl_int v = j->vertex >= 0 ? j->vertex : 0;
    while (j->vertex < 0 && v + 1 < j->m.n_vertices &&
           j->around.begin[v] == j->around.begin[v + 1]) {
        v++;
    }
    return v;
}

/* The patch: listed, or grown. */
static void find_patch(layout_job *j) {
    char message[512] = "";
    sl_int n = j->m.n_vertices, seam = 0;
    bool ok;
    if (j->list != NULL || j->list_file != NULL) {
        sl_int count;
        if (j->list != NULL && j->list_file != NULL) {
            app_die_usage("--list and --list-file: one of them");
        }
        sl_int *list = j->list != NULL ? app_vertices("list", j->list, n, 1, &count)
                                       : read_list(j->list_file, &count);
        ok = disk_of_list(&j->d, &j->around, list, count, message, sizeof message);
        free(list);
    } else {
        sl_int start = first_vertex(j), size = j->size;
        if (size == 0) {
            size = n / 4 < LAYOUT_JOB_SIZE ? n / 4 : LAYOUT_JOB_SIZE;
            size = size < 3 ? 3 : size;
        }
        ok = disk_grow(&j->d, &j->around, start, size, &seam, message, sizeof message);
        if (ok && j->d.p.m.n_vertices < size) {
            printf("the disk around vertex %d ends at %d vertices\n", (int)start,
                   (int)j->d.p.m.n_vertices);
        }
    }
    if (!ok) {
        app_die("%s", message);
    }
    if (seam > 0) {
        printf("the patch meets itself: %d faces are left out as a seam\n", (int)seam);
    }
}

static void factor_mesh(layout_job *j) {
    sl_options opt;
    sl_stats stats;
    memset(&opt, 0, sizeof opt);
    opt.definiteness = SL_SEMIDEFINITE; /* L is singular: constants */
    opt.consistency_tolerance = PATCH_SOLVER_CONSISTENCY;
    if (!laplacian_cotangent(&j->L, &j->m)) {
        app_die("out of memory");
    }
    const sl_csc A = sl_matrix_view(j->L);
    app_stage("analysing the mesh");
    double began = app_now();
    app_must(sl_symbolic_create(&j->S, &A, NULL, &stats), "analysis of the Laplacian", &stats);
    app_stage("factoring the mesh");
    app_must(sl_factor_create(&j->F, j->S, &A, &opt, &stats), "factor of the Laplacian", &stats);
    j->seconds_factor = app_now() - began;
    app_progress_end();
}

static void plan_patch(layout_job *j) {
    double began = app_now();
    app_must(patch_solver_create(&j->s, j->S, j->F, &j->d.p), "plan of the patch", NULL);
    double planned = app_now();
    j->seconds_plan = planned - began;
    if (j->region) {
        app_must(patch_solver_confine(&j->s, j->S), "region of the patch", NULL);
        j->seconds_region = app_now() - planned;
    }
}

void layout_job_regrow(layout_job *j, sl_int size) {
    char message[512] = "";
    patch_solver_free(&j->s);
    disk_free(&j->d);
    if (!disk_grow(&j->d, &j->around, first_vertex(j), size, NULL, message, sizeof message)) {
        app_die("%s", message);
    }
    plan_patch(j);
}

void layout_job_open(layout_job *j, const char *operand) {
    if (strcmp(j->boundary, "circle") != 0 && strcmp(j->boundary, "unrolled") != 0) {
        app_die_usage("--boundary %s: not circle or unrolled", j->boundary);
    }
    app_mesh(&j->m, operand, true);
    if (!incidence_create(&j->around, &j->m)) {
        app_die("out of memory");
    }
    find_patch(j);
    look_at_faces(j->view, &j->picture, &j->d.p.m, NULL, 0);
    factor_mesh(j);
    plan_patch(j);
    sl_stats all;
    sl_symbolic_stats(j->S, &all);
    printf("mesh       %d vertices, %d faces; Laplacian factored in %.1f ms\n",
           (int)j->m.n_vertices, (int)j->m.n_faces, 1e3 * j->seconds_factor);
    printf("patch      %d vertices, %d faces, %d on its boundary, %d of them joined to the rest\n",
           (int)j->d.p.m.n_vertices, (int)j->d.p.m.n_faces, (int)j->d.n_boundary,
           (int)j->d.p.n_rim);
    printf("plan       reads %.3g of %.3g entries of the factor (%.1f %%); made in %.2f ms\n",
           (double)j->s.stats.x_entries, (double)all.nnz_panels,
           all.nnz_panels > 0 ? 1e2 * (double)j->s.stats.x_entries / (double)all.nnz_panels : 0,
           1e3 * j->seconds_plan);
    if (j->region) {
        app_print_region("region", &j->s.stats, j->seconds_region);
    }
    app_print_reads("reads", &j->s.stats);
}

double *layout_job_boundary(const layout_job *j) {
    double *uv = app_alloc(2 * (size_t)j->d.n_boundary, sizeof *uv);
    if (strcmp(j->boundary, "circle") == 0) {
        boundary_on_circle(uv, &j->d);
    } else {
        boundary_unrolled(uv, &j->d);
    }
    return uv;
}

double *layout_job_flux(const layout_job *j, const double *boundary) {
    double *b = app_alloc(2 * (size_t)j->d.n_boundary, sizeof *b);
    double *B = app_alloc(2 * (size_t)j->d.p.m.n_vertices, sizeof *B);
    boundary_neumann(b, boundary, j->d.n_boundary);
    boundary_spread(B, b, &j->d);
    free(b);
    return B;
}

double *layout_job_harmonic(layout_job *j) {
    sl_int n = j->d.p.m.n_vertices;
    double *boundary = layout_job_boundary(j), *X = layout_job_flux(j, boundary);
    double *uv = app_alloc(2 * (size_t)n, sizeof *uv);
    app_must(patch_solver_mesh(&j->s, X, X, 2), "harmonic layout", NULL);
    layout_from_columns(uv, X, n);
    distortion_normalize(&j->d.p.m, uv);
    layout_to_columns(X, uv, n);
    free(uv);
    free(boundary);
    return X;
}

void layout_job_report_head(void) {
    printf("%-34s %10s %10s %10s %10s %8s\n", "layout", "conformal", "angles", "lengths", "areas",
           "flipped");
}

distortion layout_job_report(const layout_job *j, const char *name, const double *X) {
    sl_int n = j->d.p.m.n_vertices;
    double *uv = app_alloc(2 * (size_t)n, sizeof *uv);
    layout_from_columns(uv, X, n);
    distortion_normalize(&j->d.p.m, uv);
    distortion q = distortion_of(&j->d.p.m, uv);
    printf("%-34s %10.3g %10.4f %10.3g %10.3g %8d\n", name, q.conformal, q.angle, q.rigid,
           q.stretch, (int)q.flipped);
    free(uv);
    return q;
}

/* The layout moved and scaled into the unit square, sides in proportion. */
static double *unit_square(const layout_job *j, const double *X) {
    sl_int n = j->d.p.m.n_vertices;
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

static void write_png(const picture *p, bool made, const char *path) {
    if (!made) {
        app_die("%s: no memory for the picture", path);
    }
    app_write_png(p, path);
}

/* The whole mesh, checkered on the faces of the patch. */
static void draw_mesh(const layout_job *j, const double *uv, const render_style *checkered) {
    size_t corners = 6 * (size_t)j->m.n_faces;
    double *corner_uv = app_alloc(corners, sizeof *corner_uv);
    render_style style = *checkered;
    render_view view;
    picture p;
    for (size_t k = 0; k < corners; k++) {
        corner_uv[k] = NAN;
    }
    for (sl_int f = 0; f < j->d.p.m.n_faces; f++) {
        const sl_int *there = j->m.faces + 3 * (size_t)j->d.p.mesh_faces[f];
        const sl_int *here = j->d.p.m.faces + 3 * (size_t)f;
        for (size_t c = 0; c < 3; c++) { /* a face may have been turned */
            size_t k = j->d.p.vertices[here[0]] == there[c]   ? 0
                       : j->d.p.vertices[here[1]] == there[c] ? 1
                                                              : 2;
            memcpy(corner_uv + 6 * (size_t)j->d.p.mesh_faces[f] + 2 * c, uv + 2 * (size_t)here[k],
                   2 * sizeof *uv);
        }
    }
    style.uv = NULL;
    style.corner_uv = corner_uv;
    app_view(&view, &j->picture);
    bool made = render_mesh(&p, &j->m, &view, &style);
    write_png(&p, made, j->picture.png);
    picture_free(&p);
    free(corner_uv);
}

static void write_csv(const layout_job *j, const double *X) {
    sl_int n = j->d.p.m.n_vertices;
    double *uv = app_alloc(2 * (size_t)n, sizeof *uv);
    FILE *csv = app_create(j->picture.csv);
    layout_from_columns(uv, X, n);
    distortion_normalize(&j->d.p.m, uv);
    fprintf(csv, "vertex,u,v\n");
    for (sl_int v = 0; v < n; v++) {
        fprintf(csv, "%d,%.17g,%.17g\n", (int)j->d.p.vertices[v], uv[2 * v], uv[2 * v + 1]);
    }
    app_close(csv, j->picture.csv);
    free(uv);
}

void layout_job_write(const layout_job *j, const double *X) {
    static const rgb grey = {0x28, 0x28, 0x28};
    char message[512];
    double *uv = unit_square(j, X);
    render_style style;
    render_view view;
    picture p;
    memset(&style, 0, sizeof style);
    style.uv = uv;
    style.checks = j->checks > 0 ? (double)j->checks : 20; /* the layout is one unit wide */
    if (j->out != NULL) {
        mesh_extra extra;
        memset(&extra, 0, sizeof extra);
        extra.uv = uv;
        if (!mesh_write(j->out, &j->d.p.m, &extra, message, sizeof message)) {
            app_die("%s", message);
        }
    }
    if (j->picture.csv != NULL) {
        write_csv(j, X);
    }
    if (j->layout != NULL) {
        app_view(&view, &j->picture);
        style.edges = j->d.p.m.n_faces <= 20000 ? 0.4 : 0;
        style.edge_color = grey;
        bool made = render_layout(&p, &j->d.p.m, uv, &view, &style);
        write_png(&p, made, j->layout);
        picture_free(&p);
        style.edges = 0;
    }
    if (j->close != NULL) {
        app_view(&view, &j->picture);
        bool made = render_mesh(&p, &j->d.p.m, &view, &style);
        write_png(&p, made, j->close);
        picture_free(&p);
    }
    if (j->picture.png != NULL) {
        draw_mesh(j, uv, &style);
    }
    free(uv);
}

void layout_job_close(layout_job *j) {
    patch_solver_free(&j->s);
    disk_free(&j->d);
    sl_factor_free(j->F);
    sl_symbolic_free(j->S);
    sl_matrix_free(j->L);
    incidence_free(&j->around);
    mesh_free(&j->m);
}

/* unwrap_output.c: places the layouts of parts side by side; files and pictures of unwrap */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "unwrap.h"

/* ---- side by side ---- */

/* Turns a layout so that its longer side is horizontal, and moves its low corner to the origin;
 * returns its height. */
static double lay_flat(unwrap_part *p, double *width) {
    const size_t n = (size_t)p->s.m.n_vertices;
    double xx = 0, xy = 0, yy = 0, low[2] = {INFINITY, INFINITY}, high[2] = {-INFINITY, -INFINITY};
    for (size_t v = 0; v < n; v++) { /* the mean is the origin */
        xx += p->uv[2 * v] * p->uv[2 * v];
        xy += p->uv[2 * v] * p->uv[2 * v + 1];
        yy += p->uv[2 * v + 1] * p->uv[2 * v + 1];
    }
    const double angle = 0.5 * atan2(2 * xy, xx - yy), c = cos(angle), s = sin(angle);
    for (size_t v = 0; v < n; v++) {
        const double x = p->uv[2 * v], y = p->uv[2 * v + 1];
        p->uv[2 * v] = c * x + s * y;
        p->uv[2 * v + 1] = c * y - s * x;
        for (size_t k = 0; k < 2; k++) {
            low[k] = fmin(low[k], p->uv[2 * v + k]);
            high[k] = fmax(high[k], p->uv[2 * v + k]);
        }
    }
    for (size_t k = 0; k < 2 * n; k++) {
        p->uv[k] -= low[k % 2];
    }
    *width = high[0] - low[0];
    return high[1] - low[1];
}

typedef struct shelf_item {
    double width, height;
    unwrap_part *part;
} shelf_item;

static int highest_first(const void *a, const void *b) {
    const shelf_item *x = (const shelf_item *)a, *y = (const shelf_item *)b;
    return x->height != y->height ? (x->height > y->height ? -1 : 1)
                                  : (x->part > y->part) - (x->part < y->part);
}

void unwrap_pack(unwrap_command *cmd) {
    shelf_item *items = app_alloc((size_t)cmd->n_parts, sizeof *items);
    double area = 0, widest = 0, x = 0, y = 0, shelf = 0;
    if (cmd->pin_u != NULL) {
        free(items);
        return;
    }
    for (sl_int k = 0; k < cmd->n_parts; k++) {
        shelf_item *item = &items[k];
        item->part = &cmd->parts[k];
        item->height = lay_flat(item->part, &item->width);
        area += item->width * item->height;
        widest = fmax(widest, item->width);
    }
    qsort(items, (size_t)cmd->n_parts, sizeof *items, highest_first);
    const double side = fmax(widest, 1.1 * sqrt(area)), gap = cmd->n_parts > 1 ? 0.01 * side : 0;
    for (sl_int k = 0; k < cmd->n_parts; k++) {
        const shelf_item *item = &items[k];
        if (x > 0 && x + item->width > side) {
            x = 0;
            y += shelf + gap;
            shelf = 0;
        }
        for (size_t v = 0; v < (size_t)item->part->s.m.n_vertices; v++) {
            item->part->uv[2 * v] += x;
            item->part->uv[2 * v + 1] += y;
        }
        x += item->width + gap;
        shelf = fmax(shelf, item->height);
    }
    free(items);
}

/* ---- all parts together ---- */

/** The parts as one mesh with a layout. */
typedef struct atlas {
    mesh m;
    double *uv;
    double *corner_uv; /* 6 n_faces of the whole mesh, NaN where it has no layout */
} atlas;

static atlas join_parts(const unwrap_command *cmd) {
    atlas a;
    memset(&a, 0, sizeof a);
    for (sl_int k = 0; k < cmd->n_parts; k++) {
        a.m.n_vertices += cmd->parts[k].s.m.n_vertices;
        a.m.n_faces += cmd->parts[k].s.m.n_faces;
    }
    a.m.xyz = app_alloc(3 * (size_t)a.m.n_vertices, sizeof *a.m.xyz);
    a.m.faces = app_alloc(3 * (size_t)a.m.n_faces, sizeof *a.m.faces);
    a.uv = app_alloc(2 * (size_t)a.m.n_vertices, sizeof *a.uv);
    a.corner_uv = app_alloc(6 * (size_t)cmd->m.n_faces, sizeof *a.corner_uv);
    for (size_t k = 0; k < 6 * (size_t)cmd->m.n_faces; k++) {
        a.corner_uv[k] = NAN;
    }
    size_t n = 0, corners = 0;
    for (sl_int k = 0; k < cmd->n_parts; k++) {
        const unwrap_part *p = &cmd->parts[k];
        const size_t count = (size_t)p->s.m.n_vertices;
        memcpy(a.m.xyz + 3 * n, p->s.m.xyz, 3 * count * sizeof *a.m.xyz);
        memcpy(a.uv + 2 * n, p->uv, 2 * count * sizeof *a.uv);
        for (size_t c = 0; c < 3 * (size_t)p->s.m.n_faces; c++) {
            const size_t v = (size_t)p->s.m.faces[c];
            a.m.faces[corners++] = (sl_int)(n + v);
            memcpy(a.corner_uv + 2 * (size_t)p->s.corner[c], p->uv + 2 * v, 2 * sizeof *p->uv);
        }
        n += count;
    }
    return a;
}

static void atlas_free(atlas *a) {
    mesh_free(&a->m);
    free(a->uv);
    free(a->corner_uv);
}

/* Moves a layout into the unit square; NaN stays. */
static void to_unit_square(double *uv, size_t count, const double low[2], double side) {
    for (size_t k = 0; k < 2 * count; k++) {
        uv[k] = side > 0 ? (uv[k] - low[k % 2]) / side : uv[k] - low[k % 2];
    }
}

static void scale_atlas(atlas *a, const mesh *whole) {
    double low[2] = {INFINITY, INFINITY}, side = 0;
    const size_t n = (size_t)a->m.n_vertices;
    for (size_t k = 0; k < 2 * n; k++) {
        low[k % 2] = fmin(low[k % 2], a->uv[k]);
    }
    for (size_t k = 0; k < 2 * n; k++) {
        side = fmax(side, a->uv[k] - low[k % 2]);
    }
    to_unit_square(a->uv, n, low, side);
    to_unit_square(a->corner_uv, 3 * (size_t)whole->n_faces, low, side);
}

/* ---- files and pictures ---- */

static void write_csv(const unwrap_command *cmd) {
    FILE *csv = app_create(cmd->picture.csv);
    fprintf(csv, "vertex,u,v,part\n");
    for (sl_int k = 0; k < cmd->n_parts; k++) {
        const unwrap_part *p = &cmd->parts[k];
        for (sl_int v = 0; v < p->s.m.n_vertices; v++) {
            fprintf(csv, "%d,%.17g,%.17g,%d\n", (int)p->s.vertex[v], p->uv[2 * v], p->uv[2 * v + 1],
                    (int)k);
        }
    }
    app_close(csv);
}

/* OBJ has the mesh as it is, with texture coordinates at corners; in other formats, whose vertices
 * have them, those along cuts are repeated. */
static void write_mesh(const unwrap_command *cmd, const atlas *a) {
    char message[512];
    mesh_extra extra;
    memset(&extra, 0, sizeof extra);
    const bool corners = input_path_ends(cmd->out, ".obj");
    extra.corner_uv = corners ? a->corner_uv : NULL;
    extra.uv = corners ? NULL : a->uv;
    if (!mesh_write(cmd->out, corners ? &cmd->m : &a->m, &extra, message, sizeof message)) {
        app_die("%s", message);
    }
    app_print_left(cmd->out, &extra);
}

/* Draws the layout in the plane if `uv` is given, else a mesh in space. */
static void draw(const unwrap_command *cmd, const mesh *m, const double *uv,
                 const render_style *style, const char *path) {
    render_view view;
    picture p;
    app_view(&view, &cmd->picture);
    const bool ok =
        uv != NULL ? render_layout(&p, m, uv, &view, style) : render_mesh(&p, m, &view, style);
    if (!ok) {
        app_die("%s: out of memory for the picture", path);
    }
    app_write_png(&p, path);
    picture_free(&p);
}

void unwrap_write(const unwrap_command *cmd) {
    static const rgb gray = {0x28, 0x28, 0x28};
    render_style style;
    atlas a = join_parts(cmd);
    if (cmd->picture.csv != NULL) {
        write_csv(cmd);
    }
    if (cmd->out != NULL && cmd->pin_u != NULL) {
        write_mesh(cmd, &a); /* where the pins are */
    }
    scale_atlas(&a, &cmd->m);
    if (cmd->out != NULL && cmd->pin_u == NULL) {
        write_mesh(cmd, &a);
    }
    memset(&style, 0, sizeof style);
    style.checks = cmd->checks > 0 ? (double)cmd->checks : 20;
    style.uv = a.uv;
    if (cmd->patch_png != NULL) {
        draw(cmd, &a.m, NULL, &style, cmd->patch_png);
    }
    if (cmd->layout_png != NULL) {
        style.edges = a.m.n_faces <= 20000 ? 0.4 : 0;
        style.edge_color = gray;
        draw(cmd, &a.m, a.uv, &style, cmd->layout_png);
        style.edges = 0;
    }
    if (cmd->picture.png != NULL) {
        style.uv = NULL;
        style.corner_uv = a.corner_uv;
        draw(cmd, &cmd->m, NULL, &style, cmd->picture.png);
    }
    atlas_free(&a);
}

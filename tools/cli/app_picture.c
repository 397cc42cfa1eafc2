/* app_picture.c: camera, color range, legend and files of the pictures, shared by all commands */
#include "app.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "tools/draw/legend.h"
#include "tools/draw/upward.h"

static bool is_automatic(const char *up) {
    return up == NULL || strcmp(up, "auto") == 0;
}

const char *app_guess_up(const char *up, const mesh *m, bool is_drawn) {
    const char *reason;
    if (!is_automatic(up)) {
        return up;
    }
    const camera_up axis = upward_of(m, &reason);
    if (axis == CAMERA_UP_Z && is_drawn) {
        app_detail("%-10s z, because %s; --up y is the other choice\n", "upward", reason);
    }
    return axis == CAMERA_UP_Z ? "z" : "y";
}

void app_set_up(app_output *o, const mesh *m, bool is_drawn) {
    o->up = app_guess_up(o->up, m, is_drawn);
}

/* Reads an integer of 1 to most, which `end` follows; NULL: there is none. Returns what comes
 * after. */
static const char *read_pixels(int *out, const char *text, int most, char end) {
    char *after = NULL;
    long value = text != NULL && *text >= '0' && *text <= '9' ? strtol(text, &after, 10) : 0;
    *out = (int)(value < most ? value : most);
    return value < 1 || value > most || *after != end ? NULL : after + 1;
}

void app_view(render_view *view, const app_output *o) {
    *view = render_view_default();
    char rest = 0;
    if (o->size != NULL && read_pixels(&view->height, read_pixels(&view->width, o->size, 8000, 'x'),
                                       8000, '\0') == NULL) {
        app_die_usage("--size %s: expected WxH such as 800x600, each from 1 to 8000", o->size);
    }
    if (o->scale != NULL &&
        (read_pixels(&view->scale, o->scale, 4, '\0') == NULL || view->width > 8000 / view->scale ||
         view->height > 8000 / view->scale)) {
        app_die_usage("--scale %s: expected 1 to 4, and at most 8000 pixels along each side",
                      o->scale);
    }
    if (o->view != NULL) {
        if (sscanf(o->view, "%lf,%lf%c", &view->azimuth, &view->elevation, &rest) != 2 ||
            !isfinite(view->azimuth) || !isfinite(view->elevation)) {
            app_die_usage("--view %s: expected azimuth,elevation such as 30,20", o->view);
        }
        view->automatic = false;
    }
    if (!is_automatic(o->up)) {
        static const char order[] = "yxz"; /* of camera_up */
        const char *axis = strchr(order, o->up[0]);
        if (axis == NULL || o->up[0] == '\0' || o->up[1] != '\0') {
            app_die_usage("--up %s: expected x, y, z or auto", o->up);
        }
        view->up = (camera_up)(axis - order);
    }
    if (o->view == NULL) {
        const double *d = o->direction;
        const double steepest = 55;
        render_look_from(view, d);
        if (!o->is_frontal) {
            view->elevation = fmax(-steepest, fmin(steepest, view->elevation));
        } else if (isfinite(d[0] + d[1] + d[2]) && (d[0] != 0 || d[1] != 0 || d[2] != 0)) {
            view->automatic = false;
        }
    }
}

void app_check_output(const app_output *o, const char *out) {
    render_view view;
    app_view(&view, o);
    if (out != NULL && !mesh_write_knows(out)) {
        app_die("%s: unknown mesh format: the name must end in %s", out, mesh_write_formats);
    }
}

void app_aim_camera(app_output *o, const mesh *m, const sl_int *vertices, sl_int count,
                    bool is_frontal) {
    unsigned char *chosen = app_alloc((size_t)m->n_vertices, 1);
    render_view view;
    app_view(&view, o);
    memset(o->direction, 0, sizeof o->direction);
    o->is_frontal = is_frontal;
    for (sl_int k = 0; vertices != NULL && k < count; k++) {
        chosen[vertices[k]] = 1;
    }
    for (size_t f = 0; f < (size_t)m->n_faces; f++) {
        const sl_int *v = m->faces + 3 * f;
        const double *a = m->xyz + 3 * (size_t)v[0], *b = m->xyz + 3 * (size_t)v[1],
                     *c = m->xyz + 3 * (size_t)v[2];
        bool counts = vertices == NULL || chosen[v[0]] || chosen[v[1]] || chosen[v[2]];
        for (int d = 0; d < 3 && counts; d++) {
            int e = (d + 1) % 3, g = (d + 2) % 3;
            o->direction[d] += (b[e] - a[e]) * (c[g] - a[g]) - (b[g] - a[g]) * (c[e] - a[e]);
        }
    }
    free(chosen);
}

static int by_size(const void *a, const void *b) {
    double x = *(const double *)a, y = *(const double *)b;
    return x < y ? -1 : x > y;
}

void app_range(double *low, double *high, const mesh *m, const double *value) {
    size_t count = 0;
    double *sorted = app_alloc(3 * (size_t)m->n_faces, sizeof *sorted);
    for (size_t k = 0; k < 3 * (size_t)m->n_faces; k++) {
        double x = value[m->faces[k]];
        if (isfinite(x)) {
            sorted[count++] = x;
        }
    }
    qsort(sorted, count, sizeof *sorted, by_size);
    *low = count > 0 ? sorted[count / 200] : 0;
    *high = count > 0 ? sorted[count - 1 - count / 200] : 1;
    free(sorted);
}

void app_write_png(const picture *p, const char *path) {
    char message[512];
    if (!picture_write_png(p, path, message, sizeof message)) {
        app_die("%s", message);
    }
}

/* The ends of the color map as render_mesh chooses them. */
static void find_range(render_style *style, sl_int n) {
    double low = INFINITY, high = -INFINITY;
    for (sl_int v = 0; v < n && style->low == 0 && style->high == 0; v++) {
        if (isfinite(style->scalar[v])) {
            low = fmin(low, style->scalar[v]);
            high = fmax(high, style->scalar[v]);
        }
    }
    if (low <= high) {
        style->low = low;
        style->high = high;
    }
}

/* Warns of a picture in which there is nothing to see: hardly a pixel, or no value. */
static void warn_if_empty(const picture *p, const mesh *m, const render_style *style) {
    const size_t count = (size_t)p->width * (size_t)p->height;
    size_t drawn = 0, known = style->scalar == NULL;
    for (size_t k = 0; k < count; k++) {
        drawn += memcmp(&p->at[k], &p->at[0], sizeof *p->at) != 0;
    }
    for (size_t k = 0; k < 3 * (size_t)m->n_faces && known == 0; k++) {
        known = isfinite(style->scalar[m->faces[k]]) != 0;
    }
    if (1000 * drawn < count) {
        app_warn("there is almost nothing in the picture: the mesh covers %zu of %zu pixels", drawn,
                 count);
    } else if (known == 0) {
        app_warn("the picture is gray: no vertex of a face has a value");
    }
}

/* Renders the mesh, with a legend at its right if the style has one and the picture room for it. */
static bool render_with_legend(picture *p, const mesh *m, const render_view *whole,
                               const render_style *given) {
    const rgb white = {255, 255, 255};
    render_view view = *whole;
    render_style style = *given;
    picture drawn;
    int width = given->legend != NULL ? legend_width(view.width, view.height) : 0;
    if (width == 0) {
        const bool is_drawn = render_mesh(p, m, &view, &style);
        if (is_drawn) {
            warn_if_empty(p, m, &style);
        }
        return is_drawn;
    }
    if (style.scalar != NULL) {
        find_range(&style, m->n_vertices);
    }
    view.width -= width;
    if (!picture_create(p, view.scale * whole->width, view.scale * whole->height, white)) {
        return false;
    }
    if (!render_mesh(&drawn, m, &view, &style)) {
        picture_free(p);
        return false;
    }
    warn_if_empty(&drawn, m, &style);
    picture_paste(p, &drawn, 0, 0);
    picture_free(&drawn);
    if (style.scalar != NULL) {
        legend_draw(p, view.scale, style.legend, style.low, style.high, style.isolines);
    } else {
        legend_draw_keys(p, view.scale, style.legend, style.keys, style.n_keys);
    }
    return true;
}

void app_print_missing(const mesh *m, const mesh_field *fields, int n_fields) {
    bool is_first = true;
    for (int k = 0; k < n_fields; k++) {
        const sl_int missing = mesh_missing(fields[k].value, 1, m->n_vertices);
        if (missing > 0) {
            printf(is_first ? "There is no value of %s at %d of %d vertices" : ", of %s at %d",
                   fields[k].name, (int)missing, (int)m->n_vertices);
            is_first = false;
        }
    }
    printf(is_first ? "" : ".\n");
}

void app_write(const app_output *o, const mesh *m, const mesh_extra *extra,
               const render_style *style) {
    char message[512];
    if (extra != NULL && (o->out != NULL || o->png != NULL)) {
        app_print_missing(m, extra->fields, extra->n_fields);
    }
    mesh_extra all;
    memset(&all, 0, sizeof all);
    all = extra != NULL ? *extra : all;
    all.source = app_source;
    if (o->out != NULL && !mesh_write(o->out, m, &all, message, sizeof message)) {
        app_die("%s", message);
    }
    if (o->out != NULL) {
        app_print_left(o->out, &all);
    }
    if (o->png != NULL) {
        render_view view;
        picture p;
        app_view(&view, o);
        if (!render_with_legend(&p, m, &view, style)) {
            app_die("%s: out of memory for a picture of %d x %d", o->png, view.scale * view.width,
                    view.scale * view.height);
        }
        app_write_png(&p, o->png);
        picture_free(&p);
    }
}

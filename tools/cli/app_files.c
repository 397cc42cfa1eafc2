/* app_files.c: input and output shared by all commands: meshes, vertex lists, tables, pictures */
#include "app.h"

#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "tools/draw/legend.h"
#include "tools/geometry/laplacian.h"
#include "tools/io/output_file.h"
#include "tools/mesh/surface_generator.h"

const char app_mesh_help[] =
    "a mesh file (.obj, .off, .ply, .stl, optionally .gz) or a generated surface: "
    "grid:100x100, hills:100x100, sphere:5, blob:5, star:5, torus:120x40, knot:400x24.";

void app_mesh(mesh *out, const char *operand, bool faces_needed) {
    char message[512];
    bool made = surface_is_specification(operand);
    if (made ? !surface_generate(out, operand, message, sizeof message)
             : !mesh_read(out, operand, message, sizeof message)) {
        app_die("%s", message);
    }
    if (faces_needed && out->n_faces == 0) {
        app_die("%s: has no faces, only %d vertices; this command needs a surface", operand,
                (int)out->n_vertices);
    }
}

bool app_is_saved(const char *operand) {
    const size_t length = strlen(operand);
    return length > 4 && strcmp(operand + length - 4, ".slf") == 0;
}

/* Reads a vertex number at *text and advances *text past it. */
static sl_int read_vertex(const char *option_name, const char **text, sl_int n) {
    char *after = NULL;
    errno = 0;
    long v = strtol(*text, &after, 10);
    if (after == *text || **text == '+' || **text == '-') {
        app_die_usage("--%s: \"%s\" is not a list of vertices (3,17,100-200 or all or random:5)",
                      option_name, *text);
    }
    if (errno != 0 || v >= n) {
        app_die("--%s: there is no vertex %.*s; the last one is %d", option_name,
                (int)(after - *text), *text, (int)n - 1);
    }
    *text = after;
    return (sl_int)v;
}

/* Names the vertices that were drawn, so that a run can be repeated with a part of them. */
static void print_drawn(const char *option_name, const sl_int *vertices, sl_int count) {
    enum { SHOWN = 200 };
    printf("drawn      --%s ", option_name);
    for (sl_int k = 0; k < count && k < SHOWN; k++) {
        printf(k > 0 ? ",%d" : "%d", (int)vertices[k]);
    }
    if (count > SHOWN) {
        printf(" and %d more", (int)(count - SHOWN));
    }
    printf("\n");
}

static sl_int *random_vertices(const char *option_name, const char *text, sl_int n, uint64_t seed,
                               sl_int *count) {
    char *after = NULL;
    long wanted = strtol(text, &after, 10);
    if (after == text || *after != '\0' || wanted < 1 || wanted > n) {
        app_die_usage("--%s random:%s: expected a number from 1 to %d", option_name, text, (int)n);
    }
    sl_int *all = app_alloc((size_t)n, sizeof *all);
    for (sl_int v = 0; v < n; v++) {
        all[v] = v;
    }
    for (sl_int k = 0; k < wanted; k++) {
        sl_int from = k + app_random_below(&seed, n - k);
        sl_int v = all[from];
        all[from] = all[k];
        all[k] = v;
    }
    *count = (sl_int)wanted;
    print_drawn(option_name, all, *count);
    return all;
}

sl_int *app_vertices(const char *option_name, const char *text, sl_int n, uint64_t seed,
                     sl_int *count) {
    if (strncmp(text, "random:", 7) == 0) {
        return random_vertices(option_name, text + 7, n, seed, count);
    }
    bool all = strcmp(text, "all") == 0;
    size_t capacity = all ? (size_t)n : 0;
    sl_int *list = app_alloc(capacity, sizeof *list);
    sl_int used = 0;
    for (; all && used < n; used++) {
        list[used] = used;
    }
    while (!all) {
        sl_int first = read_vertex(option_name, &text, n);
        sl_int last = first;
        if (*text == '-') {
            text++;
            last = read_vertex(option_name, &text, n);
        }
        if (last < first || last - first >= INT32_MAX - used) {
            app_die_usage("--%s: %d-%d is an empty range or makes the list too long", option_name,
                          (int)first, (int)last);
        }
        size_t needed = (size_t)used + (size_t)(last - first) + 1;
        if (needed > capacity) {
            capacity = 2 * needed;
            sl_int *larger = realloc(list, capacity * sizeof *list);
            if (larger == NULL) {
                app_die("out of memory");
            }
            list = larger;
        }
        for (sl_int v = first; v <= last; v++) {
            list[used++] = v;
        }
        if (*text == '\0') {
            break;
        }
        if (*text++ != ',') {
            app_die_usage("--%s: \"%s\": expected a comma between vertices", option_name, text - 1);
        }
    }
    *count = used;
    return list;
}

sl_int app_distinct(sl_int *vertices, sl_int count, sl_int n) {
    unsigned char *seen = app_alloc((size_t)n, 1);
    sl_int kept = 0;
    for (sl_int k = 0; k < count; k++) {
        if (!seen[vertices[k]]) {
            seen[vertices[k]] = 1;
            vertices[kept++] = vertices[k];
        }
    }
    free(seen);
    return kept;
}

FILE *app_create(const char *path) {
    char message[512];
    FILE *file = output_open(path, message, sizeof message);
    if (file == NULL) {
        app_die("%s", message);
    }
    return file;
}

void app_close(FILE *file) {
    char message[512];
    if (!output_close(file, message, sizeof message)) {
        app_die("%s", message);
    }
}

void app_view(render_view *view, const app_output *o) {
    *view = render_view_default();
    char rest = 0;
    if (o->size != NULL &&
        (sscanf(o->size, "%dx%d%c", &view->width, &view->height, &rest) != 2 || view->width < 1 ||
         view->height < 1 || view->width > 8000 || view->height > 8000)) {
        app_die_usage("--size %s: expected WxH such as 800x600, each from 1 to 8000", o->size);
    }
    if (o->view != NULL) {
        if (sscanf(o->view, "%lf,%lf%c", &view->azimuth, &view->elevation, &rest) != 2) {
            app_die_usage("--view %s: expected azimuth,elevation such as 30,20", o->view);
        }
        view->automatic = false;
    }
    if (o->up != NULL) {
        static const char order[] = "yxz"; /* of camera_up */
        const char *axis = strchr(order, o->up[0]);
        if (axis == NULL || o->up[0] == '\0' || o->up[1] != '\0') {
            app_die_usage("--up %s: expected x, y or z", o->up);
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
        app_die(
            "%s: unknown mesh format: the name must end in .obj or .ply, optionally followed by "
            ".gz",
            out);
    }
}

sl_int app_default_vertex(const mesh *m) {
    sl_int first = INT32_MAX, any = INT32_MAX;
    for (size_t f = 0; f < (size_t)m->n_faces; f++) {
        const sl_int *v = m->faces + 3 * f;
        sl_int least = v[0] < v[1] ? v[0] : v[1];
        least = v[2] < least ? v[2] : least;
        any = least < any ? least : any;
        if (least < first && laplacian_of_face(m, v).area > 0) {
            first = least;
        }
    }
    return first < INT32_MAX ? first : any < INT32_MAX ? any : 0;
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

/* Renders the mesh, with a legend at its right if the style has one and the picture room for it. */
static bool render_with_legend(picture *p, const mesh *m, const render_view *whole,
                               const render_style *given) {
    const rgb white = {255, 255, 255};
    render_view view = *whole;
    render_style style = *given;
    picture drawn;
    int width = given->legend != NULL ? legend_width(view.width, view.height) : 0;
    if (width == 0 || style.scalar == NULL) {
        return render_mesh(p, m, &view, &style);
    }
    find_range(&style, m->n_vertices);
    view.width -= width;
    if (!picture_create(p, whole->width, whole->height, white)) {
        return false;
    }
    if (!render_mesh(&drawn, m, &view, &style)) {
        picture_free(p);
        return false;
    }
    picture_paste(p, &drawn, 0, 0);
    picture_free(&drawn);
    legend_draw(p, width, style.legend, style.low, style.high, style.isolines);
    return true;
}

void app_write(const app_output *o, const mesh *m, const mesh_extra *extra,
               const render_style *style) {
    char message[512];
    if (o->out != NULL && !mesh_write(o->out, m, extra, message, sizeof message)) {
        app_die("%s", message);
    }
    if (o->png != NULL) {
        render_view view;
        picture p;
        app_view(&view, o);
        if (!render_with_legend(&p, m, &view, style)) {
            app_die("%s: out of memory for a picture of %d x %d", o->png, view.width, view.height);
        }
        app_write_png(&p, o->png);
        picture_free(&p);
    }
}

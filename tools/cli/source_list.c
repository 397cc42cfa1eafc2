/* source_list.c: the sources that --from names: vertices, or curves along edges, from a file too */
#include "source_list.h"

#include <stdlib.h>
#include <string.h>

/* Adds the curves, which are parts of the text. */
static void add_curves(source_list *out, const char *option_name, const char *text, const mesh *m) {
    char *copy = app_list_text(option_name, text), *part = copy;
    while (part != NULL) {
        char *end = strchr(part, ';');
        sl_int count, gap;
        if (end != NULL) {
            *end = '\0';
        }
        sl_int *through = app_vertices_in_order(option_name, part, m->n_vertices, &count);
        if (!edge_curve_add(&out->curve, m, through, count, &gap)) {
            if (gap < 0) {
                app_die("--%s: out of memory for a curve", option_name);
            }
            app_die("--%s: no path along edges joins vertex %d to vertex %d of the curve",
                    option_name, (int)through[gap], (int)through[gap + 1]);
        }
        free(through);
        part = end != NULL ? end + 1 : NULL;
    }
    free(copy);
    out->count = (sl_int)out->curve.vertices.count;
    out->vertices = app_alloc((size_t)out->count, sizeof *out->vertices);
    memcpy(out->vertices, out->curve.vertices.at, (size_t)out->count * sizeof *out->vertices);
    app_detail("curve      of %d edges through %d vertices\n", (int)(out->curve.ends.count / 2),
               (int)out->count);
}

void source_list_read(source_list *out, const char *option_name, const char *text, const mesh *m) {
    memset(out, 0, sizeof *out);
    if (text != NULL && strncmp(text, "curve:", 6) == 0) {
        add_curves(out, option_name, text + 6, m);
    } else if (text != NULL) {
        out->vertices = app_vertices(option_name, text, m->n_vertices, 1, &out->count);
        out->count = app_distinct(out->vertices, out->count, m->n_vertices);
    } else {
        out->vertices = app_alloc(1, sizeof *out->vertices);
        out->vertices[0] = app_default_vertex(m);
        out->count = 1;
    }
}

void source_list_free(source_list *s) {
    edge_curve_free(&s->curve);
    free(s->vertices);
    memset(s, 0, sizeof *s);
}

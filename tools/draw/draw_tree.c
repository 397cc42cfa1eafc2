/* draw_tree.c: draws the elimination tree as SVG and the patterns of P A P' and L as a picture */
#include "draw_tree.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "tools/io/output_file.h"

/* Trees of at most MAX_COLUMNS columns are drawn column by column. In larger trees a leaf supernode
 * is drawn if its subtree has at least n / SUBTREE_SHARE columns. */
enum { MAX_COLUMNS = 80, SUBTREE_SHARE = 500 };

static const double width = 800, height = 460, border = 24;

/* ---- the tree: its nodes are columns if there are few, otherwise supernodes ---- */

typedef struct nodes {
    sl_int count;
    bool columns;         /* the nodes are columns */
    sl_int *parent;       /* count; -1 at a root */
    sl_int *first_column; /* count + 1 */
    double *x;            /* count: position in slots, one slot per leaf; NaN: not drawn */
    double *low, *high;   /* count: positions of the first and last child drawn */
    sl_int *depth;        /* count: columns from the node's first column to the root */
    sl_int *below;        /* count: columns of the subtree */
    sl_int deepest;       /* largest depth drawn */
    double slots;
} nodes;

static void nodes_free(nodes *t) {
    free(t->below);
    free(t->depth);
    free(t->high);
    free(t->low);
    free(t->x);
    free(t->first_column);
    free(t->parent);
}

static bool nodes_make(nodes *t, const sl_symbolic_arrays *view) {
    memset(t, 0, sizeof *t);
    t->columns = view->n <= MAX_COLUMNS;
    t->count = t->columns ? view->n : view->n_supers;
    size_t size = (size_t)t->count + 1;
    t->parent = (sl_int *)malloc(size * sizeof *t->parent);
    t->first_column = (sl_int *)malloc(size * sizeof *t->first_column);
    t->x = (double *)malloc(size * sizeof *t->x);
    t->low = (double *)malloc(size * sizeof *t->low);
    t->high = (double *)malloc(size * sizeof *t->high);
    t->depth = (sl_int *)malloc(size * sizeof *t->depth);
    t->below = (sl_int *)calloc(size, sizeof *t->below);
    if (!t->parent || !t->first_column || !t->x || !t->low || !t->high || !t->depth || !t->below) {
        return false;
    }
    for (sl_int k = 0; k < t->count; k++) {
        t->parent[k] = t->columns ? view->parent[k] : view->super_parent[k];
        t->first_column[k] = t->columns ? k : view->super_first[k];
        t->x[k] = NAN;
        t->low[k] = HUGE_VAL;
        t->high[k] = -HUGE_VAL;
    }
    t->first_column[t->count] = view->n;
    for (sl_int k = 0; k < t->count; k++) {
        t->below[k] += t->first_column[k + 1] - t->first_column[k];
        if (t->parent[k] >= 0) {
            t->below[t->parent[k]] += t->below[k];
        }
    }
    return true;
}

/* A leaf takes the next slot, an inner node the middle of its children. Children precede their
 * parents. */
static void place_nodes(nodes *t, const int *kind) {
    sl_int n = t->first_column[t->count];
    for (sl_int k = 0; k < t->count; k++) {
        bool has_children = t->low[k] <= t->high[k];
        bool colored = kind != NULL && kind[t->first_column[k + 1] - 1] >= 0;
        if (!has_children && !t->columns && !colored && (t->below[k] < n / SUBTREE_SHARE) &&
            t->parent[k] >= 0) {
            continue;
        }
        t->x[k] = has_children ? 0.5 * (t->low[k] + t->high[k]) : t->slots++;
        sl_int up = t->parent[k];
        if (up >= 0) {
            t->low[up] = fmin(t->low[up], t->x[k]);
            t->high[up] = fmax(t->high[up], t->x[k]);
        }
    }
    for (sl_int k = t->count - 1; k >= 0; k--) {
        sl_int columns = t->first_column[k + 1] - t->first_column[k];
        t->depth[k] = columns - 1 + (t->parent[k] >= 0 ? t->depth[t->parent[k]] + 1 : 0);
        if (isfinite(t->x[k]) && t->depth[k] > t->deepest) {
            t->deepest = t->depth[k];
        }
    }
}

static double picture_x(const nodes *t, double slot) {
    return border + (width - 2 * border) * (slot + 0.5) / (t->slots > 0 ? t->slots : 1);
}

static double picture_y(const nodes *t, sl_int depth) {
    return border + (height - 2 * border) * depth / (t->deepest > 0 ? t->deepest : 1);
}

static void print_color(FILE *f, const char *what, int kind) {
    rgb c = {0xb0, 0xb0, 0xb0};
    c = kind >= 0 ? color_of_kind(kind) : c;
    fprintf(f, " %s=\"#%02x%02x%02x\"", what, c.r, c.g, c.b);
}

/* A node is a vertical line whose length is its number of columns. Another line joins its upper end
 * to the lower end of its parent. */
static void print_nodes(FILE *f, const nodes *t, const sl_symbolic_arrays *view, const int *kind,
                        bool colored) {
    for (sl_int k = t->count - 1; k >= 0; k--) {
        int own = kind != NULL ? kind[t->first_column[k + 1] - 1] : -1;
        if (!isfinite(t->x[k]) || (own >= 0) != colored) {
            continue;
        }
        sl_int up = t->parent[k];
        sl_int last = t->depth[k] - (t->first_column[k + 1] - t->first_column[k] - 1);
        double x = picture_x(t, t->x[k]);
        fprintf(f, "<path fill=\"none\" stroke-width=\"%s\"", own >= 0 ? "2" : "1");
        print_color(f, "stroke", own);
        if (up >= 0) {
            fprintf(f, " d=\"M%.1f %.1fL", picture_x(t, t->x[up]), picture_y(t, t->depth[up]));
        } else {
            fprintf(f, " d=\"M");
        }
        fprintf(f, "%.1f %.1fV%.1f\"/>\n", x, picture_y(t, last), picture_y(t, t->depth[k]) + 0.01);
    }
    for (sl_int k = 0; t->columns && k < t->count; k++) {
        int own = kind != NULL ? kind[k] : -1;
        if ((own >= 0) == colored) {
            double x = picture_x(t, t->x[k]), y = picture_y(t, t->depth[k]);
            fprintf(f, "<circle cx=\"%.1f\" cy=\"%.1f\" r=\"9\" stroke=\"#444\"", x, y);
            print_color(f, "fill", own);
            fprintf(f, "/><text x=\"%.1f\" y=\"%.1f\" text-anchor=\"middle\">%d</text>\n", x,
                    y + 3.5, (int)view->perm[k]);
        }
    }
}

bool draw_tree(const char *path, const sl_symbolic_arrays *view, const int *kind, char *message,
               size_t message_size) {
    nodes t;
    FILE *f = NULL;
    if (!nodes_make(&t, view)) {
        if (message != NULL && message_size > 0) {
            (void)snprintf(message, message_size, "%s: out of memory", path);
        }
    } else if ((f = output_open(path, message, message_size)) != NULL) {
        place_nodes(&t, kind);
        fprintf(f,
                "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 %.0f %.0f\" "
                "width=\"%.0f\" height=\"%.0f\" font-family=\"sans-serif\" font-size=\"10\">\n"
                "<rect width=\"100%%\" height=\"100%%\" fill=\"white\"/>\n",
                width, height, width, height);
        print_nodes(f, &t, view, kind, false);
        print_nodes(f, &t, view, kind, true);
        fprintf(f, "</svg>\n");
    }
    nodes_free(&t);
    return f != NULL && output_close(f, message, message_size);
}

/* ---- the patterns ---- */

/* Draws entry (i, j) as a box of at least one pixel; (x, 0) is the upper left corner of the
 * matrix. */
static void put_entry(picture *p, double x, double cell, sl_int i, sl_int j, rgb color) {
    double gap = cell >= 5 ? 0.1 * cell : 0, size = fmax(1, cell - gap);
    picture_box(p, x + j * cell, i * cell, x + j * cell + size, i * cell + size, color);
}

bool draw_pattern(picture *out, const sl_csc *A, const sl_symbolic_arrays *view, const int *kind,
                  int side) {
    static const rgb white = {255, 255, 255}, dark = {0x1f, 0x3a, 0x5f}, fill = {0xf0, 0x9a, 0x4a},
                     frame = {0x80, 0x80, 0x80};
    if (!picture_create(out, 2 * side + 20, side, white)) {
        return false;
    }
    double cell = (double)side / (view->n > 0 ? view->n : 1), x = side + 20;
    for (sl_int k = 0; kind != NULL && k < view->n; k++) {
        if (kind[k] >= 0) {
            picture_box(out, x + k * cell, k * cell, x + (k + 1) * cell, side,
                        color_mix(white, color_of_kind(kind[k]), 0.35));
        }
    }
    for (sl_int s = 0; s < view->n_supers; s++) {
        for (sl_int j = view->super_first[s]; j < view->super_first[s + 1]; j++) {
            for (sl_int i = j + 1; i < view->super_first[s + 1]; i++) {
                put_entry(out, x, cell, i, j, fill);
            }
            for (sl_off p = view->rows_begin[s]; p < view->rows_begin[s + 1]; p++) {
                put_entry(out, x, cell, view->rows[p], j, fill);
            }
        }
    }
    for (sl_int c = 0; c < A->n_cols; c++) {
        put_entry(out, x, cell, view->iperm[c], view->iperm[c], dark);
        for (sl_int p = A->p[c]; p < A->p[c + 1]; p++) {
            sl_int i = view->iperm[A->i[p]], j = view->iperm[c];
            put_entry(out, 0, cell, i, j, dark);
            put_entry(out, 0, cell, j, i, dark);
            put_entry(out, x, cell, i > j ? i : j, i > j ? j : i, dark);
        }
    }
    for (int k = 0; k < 2; k++) {
        double l = k * x + 0.5, r = k * x + side - 0.5;
        picture_line(out, l, 0.5, r, 0.5, 1, frame);
        picture_line(out, l, side - 0.5, r, side - 0.5, 1, frame);
        picture_line(out, l, 0.5, l, side - 0.5, 1, frame);
        picture_line(out, r, 0.5, r, side - 0.5, 1, frame);
    }
    return true;
}

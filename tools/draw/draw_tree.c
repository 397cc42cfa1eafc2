/* draw_tree.c: pictures of an analysis: the elimination tree, the patterns of P A P' and L */
#include "draw_tree.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { FEW = 80, SHARE = 500 };

static const double width = 800, height = 460, border = 24;

/* ---- the tree: nodes are columns where there are few, else supernodes ---- */

typedef struct nodes {
    sl_int count;
    bool columns;
    sl_int *parent;       /* -1: a root */
    sl_int *first_column; /* count + 1 */
    double *x;            /* slot among the leaves; NaN: not drawn */
    double *low, *high;   /* slots of the first and last child drawn */
    sl_int *depth;        /* columns from the root to the node's first column */
    sl_int *below;        /* columns of the subtree */
    sl_int deepest;
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

static bool nodes_make(nodes *t, const sl_symbolic_view_t *view) {
    memset(t, 0, sizeof *t);
    t->columns = view->n <= FEW;
    t->count = t->columns ? view->n : view->n_supers;
    size_t room = (size_t)t->count + 1;
    t->parent = (sl_int *)malloc(room * sizeof *t->parent);
    t->first_column = (sl_int *)malloc(room * sizeof *t->first_column);
    t->x = (double *)malloc(room * sizeof *t->x);
    t->low = (double *)malloc(room * sizeof *t->low);
    t->high = (double *)malloc(room * sizeof *t->high);
    t->depth = (sl_int *)malloc(room * sizeof *t->depth);
    t->below = (sl_int *)calloc(room, sizeof *t->below);
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

/* Leaves get the next slot, others stand in the middle of their children; nodes come in postorder. */
static void place_nodes(nodes *t, const int *kind) {
    sl_int n = t->first_column[t->count];
    for (sl_int k = 0; k < t->count; k++) {
        bool has_children = t->low[k] <= t->high[k];
        bool colored = kind != NULL && kind[t->first_column[k + 1] - 1] >= 0;
        if (!has_children && !t->columns && !colored && (t->below[k] < n / SHARE) &&
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

static double across(const nodes *t, double slot) {
    return border + (width - 2 * border) * (slot + 0.5) / (t->slots > 0 ? t->slots : 1);
}

static double down(const nodes *t, sl_int depth) {
    return border + (height - 2 * border) * depth / (t->deepest > 0 ? t->deepest : 1);
}

static void print_color(FILE *f, const char *what, int kind) {
    rgb c = {0xb0, 0xb0, 0xb0};
    c = kind >= 0 ? color_of_kind(kind) : c;
    fprintf(f, " %s=\"#%02x%02x%02x\"", what, c.r, c.g, c.b);
}

/* A node of several columns is a line downwards; from its upper end a line leads to the parent's lower end. */
static void print_nodes(FILE *f, const nodes *t, const sl_symbolic_view_t *view, const int *kind,
                        bool colored) {
    for (sl_int k = t->count - 1; k >= 0; k--) {
        int own = kind != NULL ? kind[t->first_column[k + 1] - 1] : -1;
        if (!isfinite(t->x[k]) || (own >= 0) != colored) {
            continue;
        }
        sl_int up = t->parent[k];
        sl_int last = t->depth[k] - (t->first_column[k + 1] - t->first_column[k] - 1);
        double x = across(t, t->x[k]);
        fprintf(f, "<path fill=\"none\" stroke-width=\"%s\"", own >= 0 ? "2" : "1");
        print_color(f, "stroke", own);
        if (up >= 0) {
            fprintf(f, " d=\"M%.1f %.1fL", across(t, t->x[up]), down(t, t->depth[up]));
        } else {
            fprintf(f, " d=\"M");
        }
        fprintf(f, "%.1f %.1fV%.1f\"/>\n", x, down(t, last), down(t, t->depth[k]) + 0.01);
    }
    for (sl_int k = 0; t->columns && k < t->count; k++) {
        int own = kind != NULL ? kind[k] : -1;
        if ((own >= 0) == colored) {
            double x = across(t, t->x[k]), y = down(t, t->depth[k]);
            fprintf(f, "<circle cx=\"%.1f\" cy=\"%.1f\" r=\"9\" stroke=\"#444\"", x, y);
            print_color(f, "fill", own);
            fprintf(f, "/><text x=\"%.1f\" y=\"%.1f\" text-anchor=\"middle\">%d</text>\n", x,
                    y + 3.5, (int)view->perm[k]);
        }
    }
}

bool draw_tree(const char *path, const sl_symbolic_view_t *view, const int *kind, char *message,
               size_t message_size) {
    nodes t;
    FILE *f = NULL;
    bool ok = nodes_make(&t, view) && (f = fopen(path, "w")) != NULL;
    if (ok) {
        place_nodes(&t, kind);
        fprintf(f,
                "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 %.0f %.0f\" "
                "width=\"%.0f\" height=\"%.0f\" font-family=\"sans-serif\" font-size=\"10\">\n"
                "<rect width=\"100%%\" height=\"100%%\" fill=\"white\"/>\n",
                width, height, width, height);
        print_nodes(f, &t, view, kind, false);
        print_nodes(f, &t, view, kind, true);
        fprintf(f, "</svg>\n");
        ok = ferror(f) == 0;
        ok = fclose(f) == 0 && ok;
    }
    nodes_free(&t);
    if (!ok && message != NULL && message_size > 0) {
        (void)snprintf(message, message_size, "%s: cannot be written", path);
    }
    return ok;
}

/* ---- the patterns ---- */

/* Entry (i, j) as a box of at least one pixel, the frame's corner at (x, 0). */
static void put_entry(picture *p, double x, double cell, sl_int i, sl_int j, rgb color) {
    double gap = cell >= 5 ? 0.1 * cell : 0, size = fmax(1, cell - gap);
    picture_box(p, x + j * cell, i * cell, x + j * cell + size, i * cell + size, color);
}

bool draw_pattern(picture *out, const sl_csc *A, const sl_symbolic_view_t *view, const int *kind,
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

/* plot.c: line, point and bar charts as SVG */
#include "plot.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "colors.h"
#include "tools/io/output_file.h"

enum { NAME_SIZE = 80, MAX_SERIES = 32 };

static const double width = 640, height = 420, left = 78, right = 20, top = 40, bottom = 56;

typedef struct series {
    char name[NAME_SIZE];
    plot_style style;
    int kind; /* of color_of_kind */
    size_t count, capacity;
    double *xy; /* 2 count */
} series;

struct plot {
    char title[2 * NAME_SIZE], name[2][NAME_SIZE];
    bool is_log[2];
    int n_series;
    series all[MAX_SERIES];
};

plot *plot_create(const char *title, const char *x_name, const char *y_name, bool log_x,
                  bool log_y) {
    plot *p = (plot *)calloc(1, sizeof *p);
    if (p != NULL) {
        (void)snprintf(p->title, sizeof p->title, "%s", title);
        (void)snprintf(p->name[0], sizeof p->name[0], "%s", x_name);
        (void)snprintf(p->name[1], sizeof p->name[1], "%s", y_name);
        p->is_log[0] = log_x;
        p->is_log[1] = log_y;
    }
    return p;
}

void plot_free(plot *p) {
    for (int k = 0; p != NULL && k < p->n_series; k++) {
        free(p->all[k].xy);
    }
    free(p);
}

/* The series of that name, or the next unused one; NULL: there is none. */
static series *series_named(plot *p, const char *name) {
    int k = 0;
    while (k < p->n_series && strncmp(p->all[k].name, name, NAME_SIZE - 1) != 0) {
        k++;
    }
    return k < MAX_SERIES ? &p->all[k] : NULL;
}

void plot_color(plot *p, const char *name, int kind) {
    series *s = series_named(p, name);
    if (s != NULL) {
        s->kind = kind;
    }
}

bool plot_add(plot *p, const char *name, plot_style style, double x, double y) {
    if (!isfinite(x) || !isfinite(y) || (p->is_log[0] && x <= 0) || (p->is_log[1] && y <= 0)) {
        return true;
    }
    series *s = series_named(p, name);
    if (s == NULL) {
        return false;
    }
    if (s == p->all + p->n_series) {
        static const int kinds[8] = {4, 0, 2, 5, 1, 6, 7, 3}; /* blue first, yellow last */
        (void)snprintf(s->name, sizeof s->name, "%s", name);
        s->style = style;
        s->kind = kinds[p->n_series++ % 8];
    }
    if (s->count == s->capacity) {
        size_t capacity = s->capacity > 0 ? 2 * s->capacity : 16;
        double *larger = (double *)realloc(s->xy, 2 * capacity * sizeof *larger);
        if (larger == NULL) {
            return false;
        }
        s->xy = larger;
        s->capacity = capacity;
    }
    s->xy[2 * s->count] = x;
    s->xy[2 * s->count++ + 1] = y;
    return true;
}

/* ---- axes ---- */

typedef struct axis {
    double low, high; /* range of values; of their logarithms on a logarithmic axis */
    bool is_log;
    double begin, end; /* positions of low and high in the picture */
} axis;

static double on_axis(const axis *a, double x) {
    double t = ((a->is_log ? log10(x) : x) - a->low) / (a->high - a->low);
    return a->begin + t * (a->end - a->begin);
}

/* Half of the smallest distance between two bars of a series. */
static double bar_half(const series *s) {
    double least = HUGE_VAL;
    for (size_t k = 0; k < s->count; k++) {
        for (size_t i = 0; i < k; i++) {
            double d = fabs(s->xy[2 * k] - s->xy[2 * i]);
            least = d > 0 ? fmin(least, d) : least;
        }
    }
    return isfinite(least) ? 0.5 * least : 0.5;
}

static axis find_axis(const plot *p, int d) {
    axis a = {HUGE_VAL, -HUGE_VAL, p->is_log[d], d == 0 ? left : height - bottom,
              d == 0 ? width - right : top};
    for (int k = 0; k < p->n_series; k++) {
        const series *s = &p->all[k];
        double half = d == 0 && s->style == PLOT_BARS ? bar_half(s) : 0;
        if (d == 1 && s->style == PLOT_BARS && !a.is_log) {
            a.low = fmin(a.low, 0);
        }
        for (size_t i = 0; i < s->count; i++) {
            double x = s->xy[2 * i + (size_t)d];
            a.low = fmin(a.low, a.is_log ? log10(x) : x - half);
            a.high = fmax(a.high, a.is_log ? log10(x) : x + half);
        }
    }
    if (!(a.low <= a.high)) {
        a.low = 0;
        a.high = 1;
    }
    double padding = a.high > a.low ? 0.04 * (a.high - a.low) : 0.5;
    a.low -= a.low == 0 ? 0 : padding;
    a.high += padding;
    return a;
}

/* Distance between ticks: 1, 2 or 5 times a power of ten, chosen to give four to nine ticks. */
static double tick_step(double range) {
    double step = pow(10, floor(log10(range / 4)));
    return range / step >= 20 ? 5 * step : range / step >= 10 ? 2 * step : step;
}

static void print_text(FILE *f, double x, double y, const char *where, const char *text) {
    fprintf(f, "<text x=\"%.1f\" y=\"%.1f\" text-anchor=\"%s\">", x, y, where);
    for (; *text != '\0'; text++) {
        switch (*text) {
        case '<':
            fprintf(f, "&lt;");
            break;
        case '&':
            fprintf(f, "&amp;");
            break;
        default:
            fputc(*text, f);
        }
    }
    fprintf(f, "</text>\n");
}

static void print_tick(FILE *f, const axis *a, int d, double value, bool labeled) {
    char text[32];
    double at = on_axis(a, value);
    (void)snprintf(text, sizeof text, "%g", fabs(value) < 1e-12 * (a->high - a->low) ? 0 : value);
    if (d == 0) {
        fprintf(f, "<path d=\"M%.1f %.1fV%.1f\" stroke=\"#ddd\"/>\n", at, top, height - bottom);
        print_text(f, at, height - bottom + 16, "middle", labeled ? text : "");
    } else {
        fprintf(f, "<path d=\"M%.1f %.1fH%.1f\" stroke=\"#ddd\"/>\n", left, at, width - right);
        print_text(f, left - 6, at + 4, "end", labeled ? text : "");
    }
}

static void print_axis(FILE *f, const plot *p, const axis *a, int d) {
    if (a->is_log) {
        bool few_decades = a->high - a->low < 2; /* label 2 and 5 as well */
        for (double k = floor(a->low); k <= a->high; k++) {
            for (int digit = 1; digit < 10; digit++) {
                double value = digit * pow(10, k);
                if (log10(value) >= a->low && log10(value) <= a->high &&
                    (digit == 1 || a->high - a->low < 4)) {
                    print_tick(f, a, d, value,
                               digit == 1 || (few_decades && (digit == 2 || digit == 5)));
                }
            }
        }
    } else {
        double step = tick_step(a->high - a->low);
        for (double k = ceil(a->low / step); k * step <= a->high; k++) {
            print_tick(f, a, d, k * step, true);
        }
    }
    if (d == 0) {
        print_text(f, 0.5 * (left + width - right), height - 14, "middle", p->name[0]);
    } else {
        fprintf(f, "<g transform=\"translate(18 %.1f) rotate(-90)\">",
                0.5 * (top + height - bottom));
        print_text(f, 0, 0, "middle", p->name[1]);
        fprintf(f, "</g>\n");
    }
}

/* ---- series ---- */

static void print_series(FILE *f, const series *s, const axis *x, const axis *y) {
    rgb c = color_of_kind(s->kind);
    bool has_line = s->style == PLOT_LINES || s->style == PLOT_DASHES;
    double half = s->style == PLOT_BARS ? 0.9 * bar_half(s) : 0;
    if (has_line) {
        fprintf(f,
                "<polyline fill=\"none\" stroke=\"#%02x%02x%02x\" stroke-width=\"2\"%s points=\"",
                c.r, c.g, c.b, s->style == PLOT_DASHES ? " stroke-dasharray=\"6 4\"" : "");
        for (size_t i = 0; i < s->count; i++) {
            fprintf(f, "%.2f,%.2f ", on_axis(x, s->xy[2 * i]), on_axis(y, s->xy[2 * i + 1]));
        }
        fprintf(f, "\"/>\n");
    }
    fprintf(f, "<g fill=\"#%02x%02x%02x\">\n", c.r, c.g, c.b);
    for (size_t i = 0; i < s->count; i++) {
        double value = s->xy[2 * i], at = on_axis(x, value), up = on_axis(y, s->xy[2 * i + 1]);
        if (s->style == PLOT_BARS) {
            double from = on_axis(x, x->is_log ? value : value - half);
            double to = on_axis(x, x->is_log ? value : value + half);
            fprintf(f, "<path d=\"M%.2f %.2fV%.2fH%.2fV%.2fZ\"/>\n", from, y->begin, up, to,
                    y->begin);
        } else {
            fprintf(f, "<circle cx=\"%.2f\" cy=\"%.2f\" r=\"%s\"/>\n", at, up,
                    has_line ? "3" : "2");
        }
    }
    fprintf(f, "</g>\n");
}

/* The legend is to the right of the frame. */
static void print_legend(FILE *f, const plot *p) {
    for (int k = 0; p->n_series > 1 && k < p->n_series; k++) {
        const series *s = &p->all[k];
        rgb c = color_of_kind(s->kind);
        double x = width - 4, y = top + 8 + 18 * k;
        bool is_dot = s->style == PLOT_POINTS; /* a short path with round ends */
        fprintf(f, "<path d=\"M%.1f %.1fh%d\" stroke=\"#%02x%02x%02x\" stroke-width=\"%d\"%s/>\n",
                is_dot ? x + 12 : x, y - 4, is_dot ? 0 : 24, c.r, c.g, c.b, is_dot ? 6 : 3,
                is_dot                      ? " stroke-linecap=\"round\""
                : s->style == PLOT_DASHES ? " stroke-dasharray=\"6 4\""
                                            : "");
        print_text(f, x + 30, y, "start", s->name);
    }
}

/* Width of the legend: a letter of a 12 pixel font is about 6.6 pixels wide. */
static double legend_width(const plot *p) {
    size_t longest = 0;
    for (int k = 0; p->n_series > 1 && k < p->n_series; k++) {
        size_t length = strlen(p->all[k].name);
        longest = length > longest ? length : longest;
    }
    return longest > 0 ? 40 + 6.6 * (double)longest : 0;
}

bool plot_write(const plot *p, const char *path, char *message, size_t message_size) {
    FILE *f = output_open(path, message, message_size);
    if (f != NULL) {
        axis x = find_axis(p, 0), y = find_axis(p, 1);
        double whole = width + legend_width(p);
        fprintf(f,
                "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 %.0f %.0f\" "
                "width=\"%.0f\" height=\"%.0f\" font-family=\"sans-serif\" font-size=\"12\">\n"
                "<rect width=\"100%%\" height=\"100%%\" fill=\"white\"/>\n",
                whole, height, whole, height);
        if (p->n_series > 0) {
            print_axis(f, p, &x, 0);
            print_axis(f, p, &y, 1);
        }
        for (int k = 0; k < p->n_series; k++) {
            print_series(f, &p->all[k], &x, &y);
        }
        fprintf(f,
                "<rect x=\"%.1f\" y=\"%.1f\" width=\"%.1f\" height=\"%.1f\" fill=\"none\" "
                "stroke=\"#444\"/>\n",
                left, top, width - left - right, height - top - bottom);
        print_legend(f, p);
        fprintf(f, "<g font-size=\"14\">");
        print_text(f, 0.5 * width, 24, "middle", p->title);
        fprintf(f, "</g>\n</svg>\n");
    }
    return f != NULL && output_close(f, message, message_size);
}

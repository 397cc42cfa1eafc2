/* plot.c: series of points, written as a gnuplot script with its data inside and drawn where gnuplot is installed */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "bench.h"

enum { MAX_SERIES = 24 };

typedef struct series {
    char name[48];
    char style[32];
    double *xy;
    int count, room;
} series;

struct bench_plot {
    char path[512]; /* without its ending */
    char title[128], x_label[64], y_label[64], log[8];
    series all[MAX_SERIES];
    int n_series;
};

bench_plot *bench_plot_open(const bench_run *run, const char *name, const char *title,
                            const char *x_label, const char *y_label, const char *log) {
    bench_plot *plot = bench_alloc(1, sizeof *plot);
    memset(plot, 0, sizeof *plot);
    snprintf(plot->path, sizeof plot->path, "%s/%s", run->out_dir, name);
    snprintf(plot->title, sizeof plot->title, "%s", title);
    snprintf(plot->x_label, sizeof plot->x_label, "%s", x_label);
    snprintf(plot->y_label, sizeof plot->y_label, "%s", y_label);
    snprintf(plot->log, sizeof plot->log, "%s", log);
    return plot;
}

void bench_plot_point(bench_plot *plot, const char *name, const char *style, double x, double y) {
    series *s = plot->all;
    while (s < plot->all + plot->n_series && strcmp(s->name, name) != 0) {
        s++;
    }
    if (s == plot->all + plot->n_series) {
        if (plot->n_series == MAX_SERIES) {
            return;
        }
        plot->n_series++;
        snprintf(s->name, sizeof s->name, "%s", name);
        snprintf(s->style, sizeof s->style, "%s", style);
    }
    if (s->count == s->room) {
        s->room = s->room ? 2 * s->room : 16;
        s->xy = realloc(s->xy, 2 * (size_t)s->room * sizeof *s->xy);
        if (!s->xy) {
            bench_must(SL_ERR_MEMORY, "keeping points of a plot");
        }
    }
    s->xy[2 * s->count] = x;
    s->xy[2 * s->count + 1] = y;
    s->count++;
}

static int write_script(const bench_plot *plot, const char *path) {
    FILE *file = fopen(path, "w");
    if (!file) {
        return 0;
    }
    fprintf(
        file,
        "set terminal svg size 820,520 dynamic background 'white' font 'sans,13'\n"
        "set output '%s.svg'\nset title \"%s\"\nset xlabel \"%s\"\nset ylabel \"%s\"\n"
        "set grid\nset key outside right top\nset style fill solid 0.5\nset boxwidth 0.9 relative\n"
        "set offsets graph 0.02, graph 0.02, graph 0.02, 0\n",
        plot->path, plot->title, plot->x_label, plot->y_label);
    if (plot->log[0]) {
        fprintf(file, "set logscale %s\nset format %s '%%.0s%%c'\n", plot->log, "x");
    }
    if (strchr(plot->log, 'y')) {
        fprintf(file, "set format y '%%g'\n");
    }
    for (int k = 0; k < plot->n_series; k++) {
        const series *s = &plot->all[k];
        fprintf(file, "$data%d << EOD\n", k);
        for (int p = 0; p < s->count; p++) {
            fprintf(file, "%.9g %.9g\n", s->xy[2 * p], s->xy[2 * p + 1]);
        }
        fprintf(file, "EOD\n");
    }
    for (int k = 0; k < plot->n_series; k++) {
        fprintf(file, "%s$data%d using 1:2 with %s title \"%s\"", k == 0 ? "plot " : ", ", k,
                plot->all[k].style, plot->all[k].name);
    }
    fprintf(file, "\n");
    return fclose(file) == 0;
}

void bench_plot_close(bench_plot *plot) {
    char script[600], command[1300];
    snprintf(script, sizeof script, "%s.gp", plot->path);
    if (plot->n_series > 0 && write_script(plot, script)) {
        snprintf(command, sizeof command, "command -v gnuplot >/dev/null 2>&1 && gnuplot '%s'",
                 script);
        if (system(command) == 0) {
            printf("  plot: %s.svg\n", plot->path);
        } else {
            printf("  plot: %s (gnuplot is not installed, or failed)\n", script);
        }
    }
    for (int k = 0; k < plot->n_series; k++) {
        free(plot->all[k].xy);
    }
    free(plot);
}

/* plot.c: line and bar plots of a run, written as SVG files to its output folder */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "tools/draw/plot.h"
#include "bench.h"

struct bench_plot {
    char path[512];
    plot *drawn;
    int is_empty;
};

bench_plot *bench_plot_open(const bench_run *run, const char *name, const char *title,
                            const char *x_label, const char *y_label, const char *log) {
    bench_plot *p = bench_alloc(1, sizeof *p);
    snprintf(p->path, sizeof p->path, "%s/%s.svg", run->out_dir, name);
    p->drawn =
        plot_create(title, x_label, y_label, strchr(log, 'x') != NULL, strchr(log, 'y') != NULL);
    p->is_empty = 1;
    bench_must(p->drawn ? SL_OK : SL_ERR_MEMORY, "creating a plot");
    return p;
}

void bench_plot_point(bench_plot *p, const char *name, const char *style, double x, double y) {
    const char *color = strstr(style, "lc "), *dash = strstr(style, "dt ");
    plot_style drawn = strncmp(style, "boxes", 5) == 0      ? PLOT_BARS
                       : strncmp(style, "points", 6) == 0   ? PLOT_POINTS
                       : dash != NULL && atoi(dash + 3) > 1 ? PLOT_DASHES
                                                            : PLOT_LINES;
    int added = plot_add(p->drawn, name, drawn, x, y);
    if (added && color != NULL) {
        plot_color(p->drawn, name, atoi(color + 3));
    }
    bench_must(added ? SL_OK : SL_ERR_MEMORY, "adding a point to a plot");
    p->is_empty = 0;
}

void bench_plot_close(bench_plot *p) {
    char message[600];
    if (!p->is_empty) {
        if (!plot_write(p->drawn, p->path, message, sizeof message)) {
            fflush(stdout);
            fprintf(stderr, "bench: %s\n", message);
            exit(2);
        }
        printf("  plot: %s\n", p->path);
    }
    plot_free(p->drawn);
    free(p);
}

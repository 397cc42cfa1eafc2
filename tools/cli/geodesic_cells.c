/* geodesic_cells.c: Voronoi cells of the command geodesic */
#include "geodesic.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "path_check.h"

/* Distinct colors: hues in steps of the golden ratio, three levels of brightness. */
static rgb cell_color(sl_int k) {
    double hue = fmod(0.1 + 0.61803398875 * (double)k, 1), level = k % 3 == 0   ? 0.95
                                                                   : k % 3 == 1 ? 0.8
                                                                                : 0.65;
    double channel[3];
    for (int c = 0; c < 3; c++) {
        double x = fabs(fmod(6 * hue + (c == 0 ? 0 : c == 1 ? 4 : 2), 6) - 3) - 1;
        channel[c] = 255 * level * (0.45 + 0.55 * fmax(0, fmin(1, x)));
    }
    rgb color = {(unsigned char)channel[0], (unsigned char)channel[1], (unsigned char)channel[2]};
    return color;
}

static void write_cells(const geodesic_command *cmd, const sl_int *cell) {
    size_t n = (size_t)cmd->m.n_vertices;
    if (cmd->output.csv != NULL) {
        FILE *csv = app_create(cmd->output.csv);
        fprintf(csv, "vertex,site\n");
        for (size_t v = 0; v < n; v++) {
            if (cell[v] >= 0) {
                fprintf(csv, "%d,%d\n", (int)v, (int)cmd->sources[cell[v]]);
            }
        }
        app_close(csv);
    }
    double *site = app_alloc(n, sizeof *site);
    rgb *colors = app_alloc(n, sizeof *colors);
    const rgb none = {0xd8, 0xd8, 0xd8};
    for (size_t v = 0; v < n; v++) {
        site[v] = cell[v] < 0 ? NAN : (double)cmd->sources[cell[v]];
        colors[v] = cell[v] < 0 ? none : cell_color(cell[v]);
    }
    const mesh_field field = {"site", site};
    const render_style style = {.vertex_color = colors, .nearest = true};
    geodesic_write_field(cmd, &field, colors, &style);
    free(colors);
    free(site);
}

static void show_progress(double fraction) {
    app_progress("cells", fraction);
}

void geodesic_cells(geodesic_command *cmd) {
    size_t n = (size_t)cmd->m.n_vertices;
    sl_int *cell = app_alloc(n, sizeof *cell),
           *sizes = app_alloc((size_t)cmd->n_sources + 1, sizeof *sizes);
    double *largest_heat = app_alloc(n, sizeof *largest_heat), began = app_now();
    sl_off touched;
    app_must(heat_cells(cell, largest_heat, &cmd->s, cmd->sources, cmd->n_sources, cmd->heat.radius,
                        &touched, show_progress),
             "cells", NULL);
    app_progress_end();
    double seconds = app_now() - began;
    if (!cmd->raw) {
        path_check check;
        path_check_open(&check, &cmd->m);
        path_check_cells(&check, cell, cmd->sources, cmd->n_sources, cmd->heat.radius);
        path_check_close(&check);
    }
    for (size_t v = 0; v < n; v++) {
        sizes[cell[v] < 0 ? cmd->n_sources : cell[v]]++;
    }
    sl_int smallest = cmd->n_sources > 0 ? sizes[0] : 0, largest = 0;
    for (sl_int k = 0; k < cmd->n_sources; k++) {
        smallest = sizes[k] < smallest ? sizes[k] : smallest;
        largest = sizes[k] > largest ? sizes[k] : largest;
    }
    printf("Each vertex has the nearest of %d sites; cells have %d to %d vertices, and %d vertices "
           "have "
           "no site.\n",
           (int)cmd->n_sources, (int)smallest, (int)largest, (int)sizes[cmd->n_sources]);
    app_detail("cells      of %d sites, %d to %d vertices each, in %.3f ms; %lld values of heat\n",
               (int)cmd->n_sources, (int)smallest, (int)largest, 1e3 * seconds, (long long)touched);
    write_cells(cmd, cell);
    free(largest_heat);
    free(sizes);
    free(cell);
}

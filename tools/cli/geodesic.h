/* geodesic.h: the state of the command geodesic, and its ways to an answer */
#ifndef TOOLS_GEODESIC_H
#define TOOLS_GEODESIC_H

#include "app.h"
#include "source_list.h"
#include "tools/geometry/heat_distance.h"
#include "tools/geometry/intrinsic.h"

typedef struct geodesic_command {
    /* options */
    const char *from, *exact, *laplacian;
    const char *heat_file, *poisson_file;     /* NULL: the factors are computed */
    double radius, margin, time, scaled_time; /* radius, time, scaled_time: 0 if not given */
    sl_int solves;
    bool cut, region, each, voronoi, raw;
    app_output output;
    /* computed from them */
    mesh m;
    intrinsic surface; /* all zero: the mesh as it is */
    heat_solver s;
    sl_int *sources, n_sources;
    source_list from_list; /* has them, unless they are one point of the surface */
    heat_options heat;
} geodesic_command;

/** Writes the mesh with the field and draws it with the sources marked. colors may be NULL. */
void geodesic_write_field(const geodesic_command *cmd, const mesh_field *field, const rgb *colors,
                          const render_style *how);

/** Computes, checks, prints and writes the distances to the nearest source. */
void geodesic_distances(geodesic_command *cmd);

/** The same from each source separately, with the plans of one ball around all of them. */
void geodesic_distances_of_each(geodesic_command *cmd);

/** Computes, checks, prints and writes the Voronoi cells of the sources. */
void geodesic_cells(geodesic_command *cmd);

#endif

/* unwrap.h: the command unwrap: its options, the parts of a surface, their layouts and files */
#ifndef TOOLS_UNWRAP_H
#define TOOLS_UNWRAP_H

#include "app.h"
#include "tools/io/input.h"
#include "tools/geometry/distortion.h"
#include "tools/geometry/layout.h"
#include "tools/geometry/layout_start.h"
#include "tools/mesh/sheet.h"

typedef enum unwrap_method {
    UNWRAP_SLIM,
    UNWRAP_ARAP,
    UNWRAP_SCP,
    UNWRAP_LSCM,
    UNWRAP_HARMONIC,
    UNWRAP_TUTTE
} unwrap_method;

/** A part of the surface, cut open, and its layout. */
typedef struct unwrap_part {
    sheet s;
    layout_boundary boundary;
    layout l;
    double *uv;     /* 2 s.m.n_vertices */
    sl_int *pinned; /* n_pinned vertices of s.m */
    double *place;  /* 2 n_pinned */
    sl_int n_pinned;
    sl_int cut;     /* edges that are cut */
    sl_int flipped; /* faces, at the end */
    bool converged;
    bool from_tutte; /* slim: the conformal start had flipped faces */
    int iterations;
    double energy; /* of the method */
    distortion q;
} unwrap_part;

typedef struct unwrap_command {
    /* options */
    unwrap_method method;
    const char *list, *pins, *out, *layout_png, *patch_png;
    sl_int vertex, size; /* --center, --patch */
    sl_int iterations, checks;
    double tolerance;
    app_output picture;
    /* the surface */
    mesh m;
    sheet s;
    const double *pin_u, *pin_v; /* n_vertices of m, NaN where there is no pin; NULL: no pins */
    sl_int n_parts;
    unwrap_part *parts;
} unwrap_command;

/** Cuts a part open and lays it out by the method of the command. Dies on failure. */
void unwrap_lay_out(const unwrap_command *cmd, unwrap_part *p);

/** Releases a part. */
void unwrap_part_free(unwrap_part *p);

/** Places the parts side by side, unless there are pins; all layouts keep their scale. */
void unwrap_pack(unwrap_command *cmd);

/** Writes the files and pictures of the options. */
void unwrap_write(const unwrap_command *cmd);

#endif

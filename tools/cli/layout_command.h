/* layout_command.h: shared by param, arap and scp: options, patch, factor, layouts, output */
#ifndef TOOLS_LAYOUT_COMMAND_H
#define TOOLS_LAYOUT_COMMAND_H

#include "app.h"
#include "tools/mesh/disk_patch.h"
#include "tools/geometry/distortion.h"
#include "tools/geometry/patch_solver.h"

/** Options of a command and, once opened, the mesh, its factor, the patch and its solver. All zero
 *  before layout_command_defaults. */
typedef struct layout_command {
    /* options */
    const char *list;       /* --list */
    const char *list_file;  /* --list-file */
    sl_int vertex;          /* --center */
    sl_int size;            /* --patch */
    const char *boundary;   /* --boundary */
    const char *out;        /* --out */
    const char *layout_png; /* --layout */
    const char *patch_png;  /* --close */
    sl_int checks;          /* --checks */
    bool region;            /* --region */
    app_output picture;     /* --png, --csv and the camera */
    /* computed from them */
    mesh m;
    incidence inc;
    sl_matrix *L;
    sl_symbolic *S;
    sl_factor *F;
    disk_patch d;
    patch_solver s;
    sl_int seam;           /* faces left out between vertices of the patch */
    double seconds_factor; /* analysis and factorization of the whole mesh, once */
    double seconds_plan;   /* plans of the patch and its own Laplacian, once per patch */
    double seconds_region; /* the region and the plans in it, with --region */
} layout_command;

/** Default number of vertices of a patch. */
enum { LAYOUT_SIZE = 2000 };

#define LAYOUT_OPTIONS(c) \
    {OPTION_COUNT, "center", &(c)->vertex, "V", \
     "grow the patch from this vertex in breadth-first order as a disk (the first vertex of a " \
     "face with an area)"}, \
        {OPTION_COUNT, "patch", &(c)->size, "N", \
         "number of vertices of the grown patch (2000, at most a quarter of the mesh)"}, \
        {OPTION_TEXT, "list", &(c)->list, "LIST", \
         "the patch is these vertices, 3,17,100-200, instead of a grown one; an error if they " \
         "do not form a disk"}, \
        {OPTION_TEXT, "list-file", &(c)->list_file, "FILE", \
         "read the list from a file: vertex numbers, # starts a comment"}, \
        {OPTION_FLAG, "region", &(c)->region, NULL, \
         "create a region around the patch and end the local solves at its boundary; the cost of " \
         "a solve is then independent of the size of the mesh. Creating the region takes as long " \
         "as 25 to 100 solves without it, so it is off by default: one layout takes 1 solve, " \
         "--system patch and arap some 20"}, \
        {OPTION_TEXT, "boundary", &(c)->boundary, "circle|unrolled", \
         "initial layout of the boundary: on a circle by arc length, or unrolled with its own " \
         "edge lengths and angles as far as the Gaussian curvature inside permits (circle)"}, \
        {OPTION_OUTPUT, "out", &(c)->out, "FILE", \
         "write the patch with texture coordinates scaled to the unit square: .obj, .ply, " \
         ".vtk, .glb or .gltf"}, \
        {OPTION_OUTPUT, "csv", &(c)->picture.csv, "FILE", \
         "write a table vertex,u,v of the layout, scaled to the area of the patch"}, \
        {OPTION_OUTPUT, "layout", &(c)->layout_png, "FILE", \
         "draw the layout in the plane (.png)"}, \
        {OPTION_OUTPUT, "close", &(c)->patch_png, "FILE", \
         "draw the patch alone with the checkerboard (.png)"}, \
        {OPTION_COUNT, "checks", &(c)->checks, "N", \
         "squares of the checkerboard along the longer side of the layout (20)"}, \
        APP_PICTURE_OPTIONS(&(c)->picture)

/** Explains the lines and columns that all three commands print. */
#define LAYOUT_OUTPUT \
    "mesh, patch, plan, reads: sizes, times, and what one local solve reads of the factor.\n" \
    "A table with a row per layout, each scaled to the area of the patch. conformal: conformal " \
    "energy over area (0 if angles are preserved); angles: mean ratio of the two singular values " \
    "of a face (1 if angles are preserved); lengths: mean squared error (0 if lengths are " \
    "preserved); areas: spread of their logarithm (0 if areas are in proportion); flipped: " \
    "number of flipped faces; flat: faces without area. Flipped faces are also reported on " \
    "standard error.\n" \
    "solve, residual: the system and the factor, and ||b - N x|| / ||b||."

void layout_command_defaults(layout_command *job);

/** Reads the mesh, finds the patch, factors the Laplacian of the mesh, plans the solves on the
 *  patch and prints a summary. Dies with the reason on failure. */
void layout_command_open(layout_command *job, const char *operand);

/** Replaces the patch by one of `size` vertices, grown from the same vertex. Dies with the reason
 *  on failure. */
void layout_command_regrow(layout_command *job, sl_int size);

/** The initial layout of the boundary according to --boundary: 2 x d.n_boundary, column-major.
 *  Release with free. */
double *layout_command_boundary(const layout_command *job);

/** The Neumann data of a boundary layout as a right-hand side: n x 2, column-major, zero inside the
 *  patch. Release with free. */
double *layout_command_flux(const layout_command *job, const double *boundary);

/** Prints the distortion of the layout X (n x 2, column-major) as a row that begins with its
 *  name. */
distortion layout_command_report(const layout_command *job, const char *name, const double *X);

/** Prints the column headings of layout_command_report. */
void layout_command_report_head(void);

/** Writes the files and pictures that the options request; X is n x 2, column-major. */
void layout_command_write(const layout_command *job, const double *X);

void layout_command_close(layout_command *job);

#endif

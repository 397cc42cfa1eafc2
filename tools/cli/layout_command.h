/* layout_job.h: what the commands param, arap and scp share: the patch asked for, its first layout, what is written */
#ifndef TOOLS_LAYOUT_JOB_H
#define TOOLS_LAYOUT_JOB_H

#include "app.h"
#include "disk.h"
#include "distortion.h"
#include "look.h"
#include "patch_solver.h"

/** A command's options and, once opened, the mesh, its factor, the patch and the solver on it. All zero before
 *  layout_job_defaults. */
typedef struct layout_job {
    /* options */
    const char *list;      /* --list */
    const char *list_file; /* --list-file */
    sl_int vertex;         /* --center */
    sl_int size;           /* --patch */
    const char *boundary;  /* --boundary */
    const char *out;       /* --out */
    const char *layout;    /* --layout */
    const char *close;     /* --close */
    sl_int checks;         /* --checks */
    bool region;           /* --region */
    app_output picture;    /* --png and how */
    char view[LOOK_TEXT];  /* where the patch is seen from the front */
    /* what is made of them */
    mesh m;
    incidence around;
    sl_matrix *L;
    sl_symbolic *S;
    sl_factor *F;
    disk d;
    patch_solver s;
    double seconds_factor; /* analysis and factor of the whole mesh, once */
    double seconds_plan;   /* the patch, once its vertices are known: plans, its own Laplacian */
    double seconds_region; /* the region and the plans in it, where one was asked for */
} layout_job;

/** How many vertices a patch has where --patch does not say. */
enum { LAYOUT_JOB_SIZE = 2000 };

#define LAYOUT_JOB_REGION_HELP                                                                     \
    "end the local solves at the boundary of a region made around the patch: a solve then costs "  \
    "the same however large the mesh. Making it takes as long as 25 to 100 solves without, so it " \
    "is not the default: a layout needs one solve, the patch's own problem or arap some 20"

#define LAYOUT_JOB_OPTIONS(j)                                                                      \
    {OPTION_COUNT, "center", &(j)->vertex, "V",                                                    \
     "grow the patch from this vertex in breadth-first order, a disk at every step (the first "    \
     "that has a face)"},                                                                          \
        {OPTION_COUNT, "patch", &(j)->size, "N",                                                   \
         "vertices of the grown patch (2000, or a fourth of the mesh where that is less)"},        \
        {OPTION_TEXT, "list", &(j)->list, "LIST",                                                  \
         "instead: the patch of these vertices, 3,17,100-200; refused with the reason if it is "   \
         "no disk"},                                                                               \
        {OPTION_TEXT, "list-file", &(j)->list_file, "FILE",                                        \
         "the same from a file: numbers, # begins a comment"},                                     \
        {OPTION_FLAG, "region", &(j)->region, NULL, LAYOUT_JOB_REGION_HELP},                       \
        {OPTION_TEXT, "boundary", &(j)->boundary, "circle|unrolled",                               \
         "where the boundary is laid first: on a circle by arc length, or unrolled with its own "  \
         "lengths and angles as far as the curvature inside allows (circle)"},                     \
        {OPTION_TEXT, "out", &(j)->out, "FILE",                                                    \
         "write the patch with its texture coordinates, fitted to the unit square: .obj or .ply"}, \
        {OPTION_TEXT, "csv", &(j)->picture.csv, "FILE",                                            \
         "write vertex, u, v: the layout, with the area of the patch"},                            \
        {OPTION_TEXT, "layout", &(j)->layout, "FILE", "draw the layout in the plane (PNG)"},       \
        {OPTION_TEXT, "close", &(j)->close, "FILE", "draw the patch alone, checkered (PNG)"},      \
        {OPTION_COUNT, "checks", &(j)->checks, "N",                                                \
         "squares of the checkerboard along the larger side (20)"},                                \
        APP_PICTURE_OPTIONS(&(j)->picture)

void layout_job_defaults(layout_job *j);

/** Reads the mesh, finds the patch, factors the mesh's Laplacian, plans the patch; prints what came out. Dies with the
 *  reason where that fails. */
void layout_job_open(layout_job *j, const char *operand);

/** Takes another patch of the same mesh: `size` vertices grown from the vertex that was asked for. Dies with the reason
 *  where that fails. */
void layout_job_regrow(layout_job *j, sl_int size);

/** The boundary in the plane (2 d.n_boundary), as --boundary says, and the Neumann data of it spread to the patch
 *  (n x 2, column-major). */
double *layout_job_boundary(const layout_job *j);
double *layout_job_flux(const layout_job *j, const double *boundary);

/** The harmonic layout by the mesh's system, one local solve: n x 2, column-major, with the area of the patch. The
 *  caller frees it. */
double *layout_job_harmonic(layout_job *j);

/** Prints a line on the layout X (n x 2, column-major), after its name. */
distortion layout_job_report(const layout_job *j, const char *name, const double *X);
void layout_job_report_head(void);

/** Writes and draws what was asked for; X is n x 2, column-major. */
void layout_job_write(const layout_job *j, const double *X);

void layout_job_close(layout_job *j);

#endif

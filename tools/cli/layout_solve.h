/* layout_solve.h: harmonic layouts by a system that suits the patch; warnings about layouts */
#ifndef TOOLS_LAYOUT_SOLVE_H
#define TOOLS_LAYOUT_SOLVE_H

#include "layout_command.h"

/** The matrix of a harmonic layout: see patch_solver.h. */
typedef enum layout_system {
    LAYOUT_AUTO, /* of the mesh; of the patch if it has a seam, or if it flips fewer faces */
    LAYOUT_MESH,
    LAYOUT_PATCH
} layout_system;

/** Reads --system; dies if text is not auto, mesh or patch. */
layout_system layout_system_named(const char *text);

/** How a harmonic layout was found. */
typedef struct layout_solution {
    layout_system used; /* LAYOUT_MESH or LAYOUT_PATCH */
    patch_report patch; /* measured against the patch's own system N x = b in either case */
    double inside;      /* ||b - N x|| / ||b|| off the interface, where both systems agree */
    double backward;    /* componentwise, inside */
    bool solved;        /* the residual of the system that was used is small enough */
    double seconds;
} layout_solution;

/** Solves for the layout X (n x 2, column-major) with the right-hand side flux; dies on failure. */
layout_solution layout_solve(layout_command *job, double *X, const double *flux,
                             layout_system system);

/** Prints which system was solved by which factor, in what time, and its residual. If it was not
 *  solved, says so on standard error and returns false. */
bool layout_print_solution(const layout_command *job, const layout_solution *how);

/** Warns on standard error of what makes a layout useless or arbitrary: flipped faces, faces
 *  without area in space, vertices without weights, values that are not finite.
 *
 *  X  [in]  n x 2, column-major.
 *  q  [in]  from layout_command_report.
 */
void layout_warn(const layout_command *job, const double *X, const distortion *q);

/** The harmonic layout where arap and scp start: n x 2, column-major, scaled to the area of the
 *  patch. Prints how it was found. Release with free. */
double *layout_start(layout_command *job);

#endif

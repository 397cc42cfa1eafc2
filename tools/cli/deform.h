/* deform.h: the state of the command deform, and what it prints, draws and writes */
#ifndef TOOLS_DEFORM_H
#define TOOLS_DEFORM_H

#include "app.h"
#include "handle_script.h"
#include "tools/geometry/deformer_relax.h"

/* Milliseconds of a step of the script. */
typedef struct step_times {
    double pin, release, solve, fresh;
    int solves;        /* ARAP: of a frame */
    double energy;     /* ARAP: at its end */
    double moved;      /* by its last step */
    double difference; /* of --check */
} step_times;

typedef struct deform_command {
    const char *script_path, *method, *frames, *steps, *at;
    sl_int iterations;
    bool check;
    double bound, tolerance;
    deformer_rest last; /* of the last frame, ARAP */
    sl_int unfinished;  /* frames that have not converged */
    double lately;      /* the farthest that the second half of their solves moved a vertex */
    app_output output;
    mesh m;
    deformer d;
    handle_script script;
    sl_int *watched, n_watched;
    double *near_positions; /* n_watched x 3 */
    double box[6];
    FILE *table;
    step_times total;
    double worst; /* difference of --check */
    sl_int pinned, released;
    bool has_warned; /* that pins are refused */
} deform_command;

/** Draws the present shape with its handles; writes the mesh too if `output` says so. */
void deform_write_shape(const deform_command *cmd, const app_output *output);

/** The name of the picture of a frame; release with free. */
char *deform_frame_path(const deform_command *cmd, sl_int frame);

/** Draws a frame of --frames. */
void deform_write_frame(const deform_command *cmd, sl_int frame);

/** Writes --csv. */
void deform_write_csv(const deform_command *cmd);

/** Prints how many components have no handle, if there are such, and what becomes of them. */
void deform_print_free(const deform_command *cmd);

/** Prints what pins and frames took, and what --check found. */
void deform_print_summary(const deform_command *cmd);

#endif

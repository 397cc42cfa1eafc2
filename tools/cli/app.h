/* app.h: what the commands of sparse-local share: errors, memory, time, progress, the mesh asked for, files written */
#ifndef TOOLS_APP_H
#define TOOLS_APP_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

#include "mesh.h"
#include "mesh_write.h"
#include "options.h"
#include "render.h"

#if defined(__GNUC__)
#define APP_PRINTF __attribute__((format(printf, 1, 2)))
#define APP_NORETURN __attribute__((noreturn))
#else
#define APP_PRINTF
#define APP_NORETURN
#endif

/* ---- errors and memory: a command that cannot go on says why and ends the program ---- */

/** Prints "sparse-local: ..." to standard error and ends with status 1: the data are at fault. */
APP_NORETURN APP_PRINTF void app_die(const char *format, ...);

/** The same with status 2: the command line is at fault. */
APP_NORETURN APP_PRINTF void app_die_usage(const char *format, ...);

/** Dies unless status is SL_OK, naming what was done and, where stats is not NULL and tells, the row at fault. */
void app_must(sl_status status, const char *what, const sl_stats *stats);

/** count elements of size bytes, zeroed; dies when there is no memory. Release with free. */
void *app_alloc(size_t count, size_t size);

/* ---- what a solve reads ---- */

/** Prints a line on what one solve of a plan reads, after `name`, 10 characters at most: rows, entries of L on both ways,
 *  entries of a region's inverse. Counts, so that they tell what times on a busy machine do not. */
void app_print_reads(const char *name, const sl_stats *plan);

/** Prints a line on a region: what it holds, what it keeps, what it took. */
void app_print_region(const char *name, const sl_stats *region, double seconds);

/* ---- time and progress ---- */

/** Seconds of a clock that only runs forward. */
double app_now(void);

/** Says on standard error how far long work is: only where that is a terminal, and not before a second has passed. */
void app_progress(const char *what, double fraction);

/** Says on standard error what is being done, of which no share is known: only where that is a terminal. */
void app_stage(const char *what);

/** Wipes the progress line; the next piece of work starts its own second. */
void app_progress_end(void);

/* ---- what most commands take ---- */

/** Where the answer goes and how it is drawn; all NULL or 0 is fine. */
typedef struct app_output {
    const char *out;  /* a mesh file with the fields: .ply or .obj, .gz after it or not */
    const char *png;  /* a picture */
    const char *csv;  /* the numbers */
    const char *size; /* of the picture: "800x600" */
    const char *view; /* "azimuth,elevation" in degrees; NULL: chosen by the mesh */
    const char *up;   /* "x", "y" or "z" */
    double toward[3]; /* the side to be seen where there is no view; 0 0 0: any */
} app_output;

/** The options of an app_output, to be put into a command's table. */
#define APP_OUTPUT_OPTIONS(o)                                                                      \
    {OPTION_TEXT, "out", &(o)->out, "FILE",                                                        \
     "write the mesh with what was computed: .ply or .obj, plain or .gz"},                         \
        {OPTION_TEXT, "csv", &(o)->csv, "FILE", "write the numbers"}, APP_PICTURE_OPTIONS(o)

#define APP_PICTURE_OPTIONS(o)                                                                     \
    {OPTION_TEXT, "png", &(o)->png, "FILE", "draw a picture"},                                     \
        {OPTION_TEXT, "size", &(o)->size, "WxH", "pixels of the picture (800x600)"},               \
        {OPTION_TEXT, "view", &(o)->view, "A,E",                                                   \
         "look from azimuth A and elevation E, in degrees (30,20; a flat mesh: from above)"},      \
    {                                                                                              \
        OPTION_TEXT, "up", &(o)->up, "x|y|z", "the axis that points upwards (y)"                   \
    }

/** What MESH may be, for the help texts. */
extern const char app_mesh_help[];

/** Reads a file or makes a surface (surface.h); dies with the file and the line where that fails.
 *
 *  faces_needed  [in]  also dies where there are no faces.
 */
void app_mesh(mesh *out, const char *operand, bool faces_needed);

/** Reads a list of vertices "3,17,100-200", "all" or "random:5" (5 distinct ones); dies where one is not below n.
 *
 *  count  [out]  how many.
 *  Returns  the list, in the order given, repetitions kept (a local question refuses those: app_distinct); free it.
 */
sl_int *app_vertices(const char *option_name, const char *text, sl_int n, uint64_t seed,
                     sl_int *count);

/** Keeps the first of each vertex; returns how many are left. */
sl_int app_distinct(sl_int *vertices, sl_int count, sl_int n);

/** The next of the numbers that a seed gives, in 0..2^64-1; the same on every machine. */
uint64_t app_random(uint64_t *state);

/** A number in 0..below-1. */
sl_int app_random_below(uint64_t *state, sl_int below);

/** Opens a file for writing text; dies where that cannot be. app_close dies where something was not written. */
FILE *app_create(const char *path);
void app_close(FILE *file, const char *path);

/** Fills in the view that the options ask for; dies on malformed ones. */
void app_view(render_view *view, const app_output *o);

/** Where the options give no view: turns the camera to the side where these vertices are. */
void app_look_at(app_output *o, const mesh *m, const sl_int *vertices, sl_int count);

/** The range of a field for the colour map: all values at the corners of faces but the lowest and the highest half per
 *  cent, so that a speck of dust does not make the rest one colour. 0 and 1 where there are none. */
void app_range(double *low, double *high, const mesh *m, const double *value);

/** Writes what `o` asks for: o->out with the fields of `extra`, and o->png as `style` says. Dies where that fails. */
void app_write(const app_output *o, const mesh *m, const mesh_extra *extra,
               const render_style *style);

/** Writes a picture as PNG; dies where that fails. */
void app_write_png(const picture *p, const char *path);

#endif

/* app.h: shared by all commands: errors, memory, time, progress, mesh input, file output */
#ifndef TOOLS_APP_H
#define TOOLS_APP_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

#include "tools/mesh/mesh.h"
#include "tools/mesh/mesh_write.h"
#include "options.h"
#include "tools/draw/render.h"

#if defined(__GNUC__)
#define APP_PRINTF_OF(k) __attribute__((format(printf, k, k + 1)))
#define APP_NORETURN __attribute__((noreturn))
#else
#define APP_PRINTF_OF(k)
#define APP_NORETURN
#endif
#define APP_PRINTF APP_PRINTF_OF(1)

/* ---- errors and memory: a command that cannot continue prints the reason and exits ---- */

/** Prints "sparse-local: ..." to standard error and exits with status 1: the input is wrong. */
APP_NORETURN APP_PRINTF void app_die(const char *format, ...);

/** Prints "sparse-local: ..." to standard error and exits with status 2: the command line is
 *  wrong. */
APP_NORETURN APP_PRINTF void app_die_usage(const char *format, ...);

/** Prints "sparse-local: warning: ..." to standard error: the results may be of no use. */
APP_PRINTF void app_warn(const char *format, ...);

/** The sentence of sl_error_text, in which rows are vertices, without names of the header; static
 *  storage. */
const char *app_error_text(sl_status status, const sl_stats *stats);

/** Dies unless status is SL_OK. The message names the operation `what` and the reason, of stats or,
 *  if stats is NULL, of the last error. */
void app_must(sl_status status, const char *what, const sl_stats *stats);

/** Allocates count elements of size bytes, zeroed; dies if out of memory. Release with free. */
void *app_alloc(size_t count, size_t size);

/* ---- what is printed ----
 *
 * A command prints its result as at most five lines, each a sentence. */

/** Prints what only --verbose asks for: sizes, times, counts. */
APP_PRINTF void app_detail(const char *format, ...);

/** Prints a line, labeled `name` (at most 10 characters), on what one solve with a plan reads: rows
 *  and entries of L in both sweeps, entries of a region's inverse. Unlike times, these counts do
 *  not depend on the load of the machine. */
void app_print_reads(const char *name, const sl_stats *plan);

/** Prints a line on a region: its size, its memory, and the time it took to create. */
void app_print_region(const char *name, const sl_stats *region, double seconds);

/* ---- time and progress ---- */

/** Seconds of a monotonic clock. */
double app_now(void);

/** Milliseconds of processor time of this process. */
double app_processor_ms(void);

/** Shows the progress of a long computation and the time that is left on standard error: on a
 *  terminal once a second has passed since the first call, elsewhere in lines of their own after
 *  10, 20, 40, ... seconds. fraction: 0..1. */
void app_progress(const char *what, double fraction);

/** Shows on standard error what is being computed, if that is a terminal. */
void app_stage(const char *what);

/** The same for a factorization of `flops` operations, with an estimate of its time. */
void app_stage_factor(double flops);

/** Clears the progress line and restarts the second after which app_progress shows it. */
void app_progress_end(void);

/* ---- input and output of most commands ---- */

/** Output files and the camera of the picture; all zero: no output, default camera. */
typedef struct app_output {
    const char *out;   /* mesh file with the results at its vertices (mesh_write.h) */
    const char *png;   /* picture */
    const char *csv;   /* table */
    const char *size;  /* of the picture: "800x600" */
    const char *view;  /* "azimuth,elevation" in degrees; NULL: default, or see direction */
    const char *scale; /* pixels per pixel of size: "2" */
    const char *up;    /* "x", "y", "z" or "auto"; NULL: auto */
    /* Without `view` the camera is on this side of the mesh; 0 0 0: on the default side. */
    double direction[3];
    /* true: the camera is exactly in this direction; false: at most 55 degrees above or below the
     * horizon, so that vertical edges remain vertical in the picture. */
    bool is_frontal;
} app_output;

/** Rows of an option table for the fields of an app_output. */
#define APP_OUTPUT_OPTIONS(o) \
    {OPTION_OUTPUT, "out", &(o)->out, "FILE", \
     "write the mesh with the results at its vertices: .ply, .obj, .vtk, .glb or .gltf, " \
     "optionally .gz"}, \
        {OPTION_OUTPUT, "csv", &(o)->csv, "FILE", "write the results as a table"}, \
        APP_PICTURE_OPTIONS(o)

#define APP_PICTURE_OPTIONS(o) \
    {OPTION_OUTPUT, "png", &(o)->png, "FILE", "draw the result as a picture"}, \
        {OPTION_TEXT, "size", &(o)->size, "WxH", "size of the picture in pixels (800x600)"}, \
        {OPTION_TEXT, "scale", &(o)->scale, "N", \
         "draw N pixels for each pixel of --size, 1 to 4: text and lines keep their size and are " \
         "sharper (1)"}, \
        APP_CAMERA_OPTIONS(o)

#define APP_CAMERA_OPTIONS(o) \
    {OPTION_TEXT, "view", &(o)->view, "A,E", \
     "azimuth and elevation of the camera in degrees (default: the side where the sources or " \
     "the patch are, else 30,20; a flat mesh is seen from above)"}, \
    { \
        OPTION_TEXT, "up", &(o)->up, "AXIS", \
            "axis that points upward in the picture, or auto: z if the extent of the mesh says " \
            "so, " \
            "else y (auto)" \
    }

/** Distance within which app_mesh merges vertices; below 0: it does not. */
extern double app_weld;

/** The file that app_mesh writes then, with what each vertex of the mesh has become; NULL: none. */
extern const char *app_weld_map;

/** The rows of an option table that set them. */
#define APP_WELD_OPTION \
    {OPTION_OPTIONAL, "weld", &app_weld, "TOLERANCE", \
     "merge the vertices of the mesh that have equal coordinates, or that are within " \
     "--weld=TOLERANCE of each other; lists of vertices count those of the file"}, \
    { \
        OPTION_OUTPUT, "weld-map", &app_weld_map, "FILE", \
            "with --weld: write a table vertex,merged: the number in all other output of each " \
            "vertex of the file" \
    }

/** Describes the operand MESH, for the help texts. */
extern const char app_mesh_help[];

/** Reads a mesh file or generates a surface (surface_generator.h). On failure dies with the file
 *  and the line. Merges vertices if --weld is given; otherwise warns of vertices of a file that
 *  have the coordinates of others.
 *
 *  faces_needed  [in]  whether to die as well if the mesh has no faces.
 */
void app_mesh(mesh *out, const char *operand, bool faces_needed);

/** The file of the last app_mesh, if the mesh has its vertices as they are; else NULL. */
extern const char *app_source;

/** Says in a line what the file of the last app_mesh has and the mesh in the file `out` has not. */
void app_print_left(const char *out, const mesh_extra *extra);

/** mesh_mean_edge_length (laplacian.h); dies if out of memory. */
double app_mean_edge_length(const mesh *m);

/** Whether an operand is a file of sparse-local save: its name ends in .slf. */
bool app_is_saved(const char *operand);

/** Dies if --weld is given with a file of sparse-local save. */
void app_refuse_weld(const char *operand);

/** Parses a list of vertices: "3,17,100-200", "all", "random:5" (5 distinct vertices, whose numbers
 *  are printed) or "@FILE" (app_list_text). After --weld, numbers are those of the file, and the
 *  list has what these vertices have become, each once. Dies if the list is malformed or a vertex
 *  is not below n.
 *
 *  count  [out]  length of the list.
 *  Returns  the list in the order given, including repetitions; local solves refuse those, see
 *           app_distinct. Release with free.
 */
sl_int *app_vertices(const char *option_name, const char *text, sl_int n, uint64_t seed,
                     sl_int *count);

/** The same without random vertices and with all repetitions, also after --weld. */
sl_int *app_vertices_in_order(const char *option_name, const char *text, sl_int n, sl_int *count);

/** A copy of the text; of "@FILE" the content of the file, as a list of what blanks, commas and
 *  ends of lines separate, with a semicolon between lines. # starts a comment. Dies if the file
 *  cannot be read. Release with free. */
char *app_list_text(const char *option_name, const char *text);

/** Parses a list of vertices: "3,17,100-200" or "all".
 *
 *  out           [out]  as app_vertices returns it; NULL on failure.
 *  message       [out]  what is wrong, at most message_size bytes.
 *  Returns  0; or the exit status: 2 for a malformed list, 1 for a vertex that is not below n.
 */
int app_read_vertices(sl_int **out, sl_int *count, const char *text, sl_int n, char *message,
                      size_t message_size);

/** Removes repeated vertices, keeping the first of each; returns the new length of the list. */
sl_int app_distinct(sl_int *vertices, sl_int count, sl_int n);

/** The next pseudorandom number in 0..2^64-1; the sequence of a seed is the same on every
 *  machine. */
uint64_t app_random(uint64_t *state);

/** A pseudorandom number in 0..below-1. */
sl_int app_random_below(uint64_t *state, sl_int below);

/** Opens a text file for writing (output_open); dies if it cannot be opened. */
FILE *app_create(const char *path);

/** Closes a file of app_create and gives it its name; dies if not everything could be written. */
void app_close(FILE *file);

/** Sets the view from the options; dies if one is malformed. */
void app_view(render_view *view, const app_output *o);

/** Dies if an option of the picture is malformed, or if --out names no format of mesh_write: before
 *  the work, not after it. `out` is NULL or the file. */
void app_check_output(const app_output *o, const char *out);

/** The vertex that commands start from unless one is given: of the connected part with the largest
 *  area, the first one that belongs to a face with an area; without areas, the first one that
 *  belongs to a face. */
sl_int app_default_vertex(const mesh *m);

/** Sets o->direction to the mean normal of the faces at these vertices, weighted by area, so that a
 *  picture shows them. Dies if an option of the picture is malformed.
 *
 *  vertices    [in]  count vertices of m; NULL: all faces of m.
 *  is_frontal  [in]  see app_output.
 */
void app_aim_camera(app_output *o, const mesh *m, const sl_int *vertices, sl_int count,
                    bool is_frontal);

/** Replaces "auto" in o->up by the axis that upward_of guesses, and prints a line if that is z and
 *  `is_drawn`. Without this call auto is y. */
void app_set_up(app_output *o, const mesh *m, bool is_drawn);

/** The same for the value of an option --up; returns "y" or "z" for "auto" or NULL, else `up`. */
const char *app_guess_up(const char *up, const mesh *m, bool is_drawn);

/** The range of a field for the color map: its values at the corners of faces without the lowest
 *  and the highest 0.5 %, so that a few outliers do not leave one color for the rest. 0 and 1 if no
 *  value is finite. */
void app_range(double *low, double *high, const mesh *m, const double *value);

/** Prints a line on how many vertices have no value of a field, if there are any. */
void app_print_missing(const mesh *m, const mesh_field *fields, int n_fields);

/** Writes the mesh with `extra` to o->out and the picture in `style` to o->png. Prints how many
 *  vertices have no value, and warns of a picture that shows nothing. Dies on failure. */
void app_write(const app_output *o, const mesh *m, const mesh_extra *extra,
               const render_style *style);

/** Writes a picture as PNG; dies on failure. */
void app_write_png(const picture *p, const char *path);

#endif

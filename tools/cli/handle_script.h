/* handle_script.h: reads a script of handles that are grabbed, moved and released */
#ifndef TOOLS_HANDLE_SCRIPT_H
#define TOOLS_HANDLE_SCRIPT_H

#include <stdbool.h>
#include <stddef.h>

#include "tools/mesh/mesh.h"

/* A script has a step per line; # starts a comment.
 *
 *  grab VERTICES [within R]    holds vertices where they are: 3,17,100-200 or 3 17 100-200; with R
 *                              also all vertices within the Euclidean distance R of one of these,
 *                              at rest. The handles are numbered 0, 1, ... in order of their grabs.
 *  move HANDLE DX DY DZ        moves what the handle holds
 *  turn HANDLE AX AY AZ DEG    turns it about an axis through its mean
 *  release HANDLE              lets go
 *  frame                       computes and draws the surface
 */
typedef enum script_action {
    SCRIPT_GRAB = 0,
    SCRIPT_MOVE,
    SCRIPT_TURN,
    SCRIPT_RELEASE,
    SCRIPT_FRAME
} script_action;

/** A step. */
typedef struct script_step {
    script_action action;
    long line;
    sl_int handle;    /* SCRIPT_FRAME: number of the frame, from 0 */
    double values[4]; /* the numbers of a move or a turn */
} script_step;

/** The vertices of a handle. */
typedef struct script_handle {
    sl_int *vertices;
    sl_int count;
    bool is_released; /* by the end of the script */
} script_handle;

typedef struct handle_script {
    script_step *steps;
    size_t n_steps;
    script_handle *handles;
    sl_int n_handles;
    sl_int n_frames;
} handle_script;

/** The word of an action: "grab". */
const char *script_word(script_action action);

/** Reads and checks a script.
 *
 *  out      [out]  release with handle_script_free; all zero on error.
 *  path     [in]   plain or gzipped.
 *  m        [in]   the mesh at rest, for vertex numbers and distances.
 *  message  [out]  the reason on error, with file and line.
 *  Returns  true; false: no such file, a malformed line, a vertex out of range or held already, a
 *           handle that does not exist or was released, an axis of length 0, out of memory.
 *  Cost     O(length of the script); O(vertices x vertices listed) for each grab within R.
 *  Example  tests/tools/test_deform.c
 */
bool handle_script_read(handle_script *out, const char *path, const mesh *m, char *message,
                        size_t message_size);

/** Releases the script and makes it empty. */
void handle_script_free(handle_script *s);

/** The handle of a step; NULL for SCRIPT_FRAME. */
const script_handle *script_step_handle(const handle_script *s, const script_step *step);

/** A box around the mesh at rest and all places to which the script moves vertices from there.
 *
 *  box  [out]  the low corner, then the high one.
 *  Returns  true; false: out of memory.
 */
bool handle_script_box(double box[6], const handle_script *s, const mesh *m);

/** Moves or turns `count` points (x y z each) as a step says. */
void script_step_apply(const script_step *step, double *points, sl_int count);

#endif

/* edit_system.h: a system M + t L that is edited at random places, and a factor that follows it */
#ifndef TOOLS_EDIT_SYSTEM_H
#define TOOLS_EDIT_SYSTEM_H

#include <stdint.h>

#include "edit_check.h"
#include "tools/matrix/edited_matrix.h"
#include "tools/mesh/edge_flips.h"

/** What is edited.
 *
 *  EDIT_WEIGHT  a spring along an edge is added, changed or removed: the weight of the edge changes
 *  EDIT_PATCH   springs along all edges of a patch are added, or some removed
 *  EDIT_PIN     a vertex is pinned, its row and column become 0 but for the diagonal; or released
 *  EDIT_FLIP    an edge is flipped: two faces are replaced by two others
 *
 * The matrix is always definite: a sum of masses, faces and springs, with rows eliminated. The
 * kinds after EDIT_KINDS change the rows; they are those of mesh_edits.h.
 */
typedef enum edit_kind {
    EDIT_WEIGHT = 0,
    EDIT_PATCH,
    EDIT_PIN,
    EDIT_FLIP,
    EDIT_KINDS,
    EDIT_SPLIT = EDIT_KINDS,
    EDIT_COLLAPSE,
    EDIT_REMESH,
    EDIT_ALL_KINDS
} edit_kind;

/** How the factor followed. The first four are those of sl_factor_change_entries.
 *
 *  EDIT_OUTSIDE  by rank-one changes: entries outside of the analyzed pattern, from flips,
 *                are present where L holds the fill
 *  EDIT_ANEW     by a new analysis and factorization: an entry outside of L, or too many changes or
 *                too much drift while entries are outside of the pattern; in mesh_edits.h by a new
 *                order
 *  EDIT_KEPT     by sl_symbolic_edit and sl_factor_edit, with columns of the factor before
 */
typedef enum edit_way {
    EDIT_NONE = SL_CHANGE_NONE,
    EDIT_UPDATE = SL_CHANGE_UPDATE,
    EDIT_REACH = SL_CHANGE_REACH,
    EDIT_REFACTOR = SL_CHANGE_REFACTOR,
    EDIT_OUTSIDE,
    EDIT_ANEW,
    EDIT_KEPT,
    EDIT_WAYS
} edit_way;

/** A pinned vertex and the entries that its row had. */
typedef struct edit_pin {
    sl_int vertex;
    entry_changes saved;
} edit_pin;

typedef struct edit_system {
    double t;
    edge_flips faces;
    edited_matrix A;
    sl_symbolic *S;
    sl_factor *F;
    sl_work *W;
    sl_stats stats;   /* of the last analysis, factorization and change */
    triplets springs; /* present ones: ends and stiffness */
    double typical;   /* mean magnitude of the entries off the diagonal */
    sl_int patch;     /* vertices of EDIT_PATCH */
    edit_pin *pins;
    sl_int n_pins, most_pins;
    unsigned char *is_pinned; /* n */
    sl_int *near_pins;        /* n: pinned neighbors */
    sl_int *queue;            /* n: scratch of EDIT_PATCH */
    unsigned char *seen;      /* n: scratch, 0 between calls */
    uint64_t random;          /* state of app_random */
} edit_system;

/** Assembles, analyzes and factors M + t L. Like all functions of this folder it ends the program
 *  with a message on errors.
 *
 *  out    [out]  release with edit_system_free.
 *  m      [in]   borrowed, must outlive out.
 *  patch  [in]   vertices of a patch, 2 or more.
 */
void edit_system_create(edit_system *out, const mesh *m, double t, sl_int patch, uint64_t seed);

/** Releases everything and sets e to all zero. */
void edit_system_free(edit_system *e);

/** Edits the system at a random place: the matrix, and the mesh of a flip. The factor does not
 *  follow yet.
 *
 *  changes  [out]  release with triplets_free.
 *  Returns  true; false: no place was found, and nothing has changed.
 */
bool edit_system_edit(edit_system *e, edit_kind kind, entry_changes *changes);

/** The factor follows the changes of the last edit. */
edit_way edit_system_follow(edit_system *e, const entry_changes *changes);

/** Compares the factor with a new one of the present matrix. */
edit_check edit_system_check(edit_system *e);

#endif

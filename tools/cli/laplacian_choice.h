/* laplacian_choice.h: the option --laplacian: of the faces, or of a Delaunay triangulation */
#ifndef TOOLS_LAPLACIAN_CHOICE_H
#define TOOLS_LAPLACIAN_CHOICE_H

#include "app.h"
#include "tools/geometry/intrinsic.h"

/* The entry of a table of options; value is a const char **. */
#define LAPLACIAN_OPTION(value) \
    { \
        OPTION_TEXT, "laplacian", value, "auto|cotangent|intrinsic", \
            "the Laplacian of the faces of the mesh (cotangent), or of a Delaunay triangulation " \
            "of the " \
            "same surface, which leaves no heat negative (intrinsic); auto: intrinsic if the " \
            "other one has " \
            "negative weights or if faces have no area (auto)" \
    }

/** Dies if name is neither NULL nor one of the three. */
void laplacian_check(const char *name);

/** Computes the Delaunay triangulation if the option calls for it, and prints a line on it.
 *
 *  out   [out]  release with intrinsic_free; all zero if the mesh is to be used as it is.
 *  name  [in]   the value of the option; NULL: auto.
 *  Returns  whether out is to be used in place of m.
 */
bool laplacian_choose(intrinsic *out, const mesh *m, const char *name);

#endif

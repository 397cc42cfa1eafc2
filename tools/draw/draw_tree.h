/* draw_tree.h: draws the elimination tree as SVG and the patterns of P A P' and L as a picture */
#ifndef TOOLS_DRAW_TREE_H
#define TOOLS_DRAW_TREE_H

#include <stdbool.h>
#include <stddef.h>

#include "sparse_local.h"
#include "picture.h"

/** Draws the elimination tree as SVG. The root is at the top; the depth of a column is the length
 *  of its path to the root.
 *
 *  Up to 80 columns, each is a circle with the number of its row of A. A larger tree has a line for
 *  each supernode that is colored or whose subtree has at least a 500th of all columns.
 *
 *  kind  [in]  n, by pivot: -1 is gray, otherwise color_of_kind(kind); NULL: all gray.
 *  Returns  true; false with a message: the file cannot be written, out of memory.
 */
bool draw_tree(const char *path, const sl_symbolic_arrays *view, const int *kind, char *message,
               size_t message_size);

/** Draws the patterns of P A P' (both triangles) and, to the right of it, L. Fill-in is drawn in a
 *  lighter color.
 *
 *  out   [out]  2 side + 20 pixels wide, side pixels high; release with picture_free.
 *  A     [in]   the matrix that was analyzed.
 *  view  [in]   arrays of its analysis; with relaxed supernodes their explicit zeros are drawn too.
 *  kind  [in]   n, by pivot: columns of L with kind >= 0 have a background tint of
 *               color_of_kind(kind); NULL: none.
 *  Returns  true; false: out of memory.
 */
bool draw_pattern(picture *out, const sl_csc *A, const sl_symbolic_arrays *view, const int *kind,
                  int side);

#endif

/* draw_tree.h: pictures of an analysis: the elimination tree, the patterns of P A P' and L */
#ifndef TOOLS_DRAW_TREE_H
#define TOOLS_DRAW_TREE_H

#include <stdbool.h>
#include <stddef.h>

#include "../sparse_local.h"
#include "picture.h"

/** Draws the elimination tree as SVG, the root on top, each column as far down as its path to the root is long.
 *
 *  Up to 80 columns: a circle for each, with the number of its row of A. More: a line for each supernode that is
 *  coloured or has a 500th of all columns below it.
 *
 *  kind  [in]  n, by pivots: -1 grey, else color_of_kind(kind); NULL: all grey.
 *  Returns  true; false with a message: the file cannot be written, out of memory.
 */
bool draw_tree(const char *path, const sl_symbolic_view_t *view, const int *kind, char *message,
               size_t message_size);

/** Draws P A P' (both triangles) and beside it L; entries of L that A does not have are light.
 *
 *  out   [out]  2 side + 20 wide, side high; release with picture_free.
 *  A     [in]   as it was analysed.
 *  view  [in]   of the analysis, without relaxation: else its zeros are drawn too.
 *  kind  [in]   n, by pivots: columns of L with kind >= 0 lie on a tint of color_of_kind(kind); NULL: none.
 *  Returns  true; false: out of memory.
 */
bool draw_pattern(picture *out, const sl_csc *A, const sl_symbolic_view_t *view, const int *kind,
                  int side);

#endif

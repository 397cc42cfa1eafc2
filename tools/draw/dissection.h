/* dissection.h: the separators of a nested dissection by level */
#ifndef TOOLS_DISSECTION_H
#define TOOLS_DISSECTION_H

#include "../sparse_local.h"

/** The level of the separator that each column belongs to.
 *
 *  level  [out]  n, by pivots: 0 for the separators of the whole, one more for each level below; -1: in no separator.
 *  view   [in]   of an analysis; an ordering that keeps no tree of separators has none.
 *  most   [in]   levels to look for, 1 or more.
 *  Returns  how many levels were found; -1: out of memory.
 *  Cost     O(n).
 *  Source   [HDA17] 2.
 */
sl_int dissection_levels(sl_int *level, const sl_symbolic_view_t *view, sl_int most);

#endif

/* dissection.h: levels of the separators of a nested dissection */
#ifndef TOOLS_DISSECTION_H
#define TOOLS_DISSECTION_H

#include "sparse_local.h"

/** Finds the level of the separator to which each column belongs.
 *
 *  level       [out]  n, by pivot: 0 for the separators of the whole graph, one more for each level
 *                     below them; -1: in no separator.
 *  view        [in]   arrays of an analysis; without a separator tree every level is -1.
 *  max_levels  [in]   number of levels wanted, 1 or more.
 *  Returns  the number of levels found; -1: out of memory.
 *  Cost     O(n).
 *  Source   [HDA17] 2.
 */
sl_int dissection_levels(sl_int *level, const sl_symbolic_arrays *view, sl_int max_levels);

#endif

/* dissection.h: the separators of a nested dissection, found again in the elimination tree */
#ifndef TOOLS_DISSECTION_H
#define TOOLS_DISSECTION_H

#include <stdbool.h>

#include "../sparse_local.h"

/** The level of the separator that each column belongs to.
 *
 *  A separator is ordered behind the parts that it separates: in the elimination tree a chain of columns from the root of
 *  a region down to the column where the region falls into parts. A column with two children or more, the second of them
 *  with at least a tenth of the region below it, is taken for such an end; children of a tenth or more are the regions
 *  of the next level.
 *
 *  level  [out]  n, by pivots: 0 for the separators of the whole, one more for each level below; -1: in no separator.
 *  view   [in]   of an analysis.
 *  most   [in]   levels to look for, 1 or more.
 *  Returns  how many levels were found (0 where n = 0); -1: out of memory.
 *  Cost     O(n).
 *  Source   [HDA17] 2.
 */
sl_int dissection_levels(sl_int *level, const sl_symbolic_view_t *view, sl_int most);

#endif

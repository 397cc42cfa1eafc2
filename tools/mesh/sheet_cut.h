/* sheet_cut.h: cuts a part of a sheet along short paths until it is a disk, perhaps with holes */
#ifndef TOOLS_SHEET_CUT_H
#define TOOLS_SHEET_CUT_H

#include "sheet.h"

/** Cuts all handles of a sheet of one part, and a sphere between two vertices far apart. Holes
 *  stay.
 *
 *  s      [in,out]  renumbered.
 *  edges  [out]     the number of edges that are cut; 0 if the part has a boundary and no handle.
 *  Returns  true; false: out of memory, and s is as it was or cut in part.
 *  Cost     O(n log n).
 *  Source   Erickson, Whittlesey: Greedy optimal homotopy and homology generators, 2005: a tree of
 *           shortest paths, a spanning tree of the dual graph among the other edges, and the loops
 *           that the edges in neither of them close.
 *  Example  tests/tools/test_sheet.c
 */
bool sheet_open(sheet *s, sl_int *edges);

/** Cuts a sheet of one part that has a boundary along the shortest path of edges from it to a
 *  vertex. Arguments as in sheet_open. */
bool sheet_cut_to(sheet *s, sl_int vertex, sl_int *edges);

#endif

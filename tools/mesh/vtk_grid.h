/* vtk_grid.h: the surface of the cells of an unstructured grid of VTK */
#ifndef TOOLS_VTK_GRID_H
#define TOOLS_VTK_GRID_H

#include "int_list.h"
#include "mesh_build.h"

/** Cells and their types, as the file lists them. */
typedef struct vtk_grid {
    int_list cells; /* for each cell the number of corners, then the corners */
    int_list types; /* for each cell */
    int64_t n_cells;
} vtk_grid;

/** Adds the faces of all cells: triangles, strips, quadrilaterals, pixels and polygons as they are,
 *  and of tetrahedra, voxels, hexahedra, wedges and pyramids the faces that no second cell has,
 *  turned outward. A triangle or a quadrilateral that is a face of such a cell is left out. Notes
 *  the cells that are points or lines, and that of solids only the surface is read.
 *
 *  Returns  true; false, with the message of b->in: as many types as cells are needed; a cell of
 *           another type, or with another number of corners than its type has; out of memory.
 *  Cost     O(n log n) for n faces of solids.
 *  Example  tests/tools/test_vtk_grid.c
 */
bool vtk_grid_add_faces(mesh_build *b, const vtk_grid *g);

/** Releases the lists. */
void vtk_grid_free(vtk_grid *g);

#endif

/* edge_sides.c: the sides of the faces of a mesh, and which of them lie on the same edge */
#include "edge_sides.h"

#include <stdlib.h>

static int by_ends(const void *a, const void *b) {
    const edge_side *x = (const edge_side *)a, *y = (const edge_side *)b;
    if (x->low != y->low) {
        return x->low < y->low ? -1 : 1;
    }
    if (x->high != y->high) {
        return x->high < y->high ? -1 : 1;
    }
    return (x->side > y->side) - (x->side < y->side);
}

sl_int side_after(sl_int side) {
    return side % 3 == 2 ? side - 2 : side + 1;
}

edge_side *sorted_sides(const mesh *m) {
    size_t count = 3 * (size_t)m->n_faces;
    edge_side *sides = (edge_side *)malloc((count + 1) * sizeof *sides);
    for (size_t s = 0; s < count && sides != NULL; s++) {
        sl_int u = m->faces[side_after((sl_int)s)], v = m->faces[side_after(side_after((sl_int)s))];
        edge_side e = {u < v ? u : v, u < v ? v : u, (sl_int)s};
        sides[s] = e;
    }
    if (sides != NULL) {
        qsort(sides, count, sizeof *sides, by_ends);
    }
    return sides;
}

size_t end_of_edge(const edge_side *sides, size_t k, size_t count) {
    size_t end = k + 1;
    while (end < count && sides[end].low == sides[k].low && sides[end].high == sides[k].high) {
        end++;
    }
    return end;
}

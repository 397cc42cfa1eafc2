/* dissection.c: the separators of a nested dissection by level, out of the tree that the analysis keeps */
#include "dissection.h"

#include <stdbool.h>
#include <stdlib.h>

sl_int dissection_levels(sl_int *level, const sl_symbolic_view_t *view, sl_int most) {
    bool *is_cut = (bool *)calloc((size_t)view->n_parts + 1, sizeof *is_cut);
    sl_int found = 0;
    if (is_cut == NULL) {
        return -1;
    }
    for (sl_int part = 0; part < view->n_parts; part++) {
        if (view->part_parent[part] >= 0) {
            is_cut[view->part_parent[part]] = true;
        }
    }
    for (sl_int k = 0; k < view->n; k++) {
        sl_int part = view->n_parts > 0 ? view->part_of[k] : -1;
        level[k] = -1;
        if (part >= 0 && is_cut[part] && view->part_level[part] < most) {
            level[k] = view->part_level[part];
            found = level[k] >= found ? level[k] + 1 : found;
        }
    }
    free(is_cut);
    return found;
}

/* dissection.c: levels of the separators of a nested dissection */
#include "dissection.h"

#include <stdbool.h>
#include <stdlib.h>

sl_int dissection_levels(sl_int *level, const sl_symbolic_arrays *view, sl_int max_levels) {
    /* Inner nodes of the separator tree are separators; its leaves are subgraphs that were not
     * dissected. */
    bool *is_separator = (bool *)calloc((size_t)view->n_nodes + 1, sizeof *is_separator);
    sl_int found = 0;
    if (is_separator == NULL) {
        return -1;
    }
    for (sl_int node = 0; node < view->n_nodes; node++) {
        if (view->node_parent[node] >= 0) {
            is_separator[view->node_parent[node]] = true;
        }
    }
    for (sl_int k = 0; k < view->n; k++) {
        sl_int node = view->n_nodes > 0 ? view->node_of[k] : -1;
        level[k] = -1;
        if (node >= 0 && is_separator[node] && view->node_level[node] < max_levels) {
            level[k] = view->node_level[node];
            found = level[k] >= found ? level[k] + 1 : found;
        }
    }
    free(is_separator);
    return found;
}

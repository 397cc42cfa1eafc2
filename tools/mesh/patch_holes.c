/* disk_holes.c: what a patch encloses: the pieces of the rest of the mesh that are smaller than the patch itself */
#include "disk_holes.h"

#include <stdlib.h>
#include <string.h>

#include "int_list.h"

enum {
    OUTSIDE = -1,
    SMALL = -2,
    LARGE = -3
}; /* place of a vertex off the patch; in the patch: 0 */

typedef struct flood {
    incidence *around;
    int_list found; /* all vertices marked SMALL or LARGE, piece after piece */
    size_t largest_at,
        largest; /* where the largest of the small pieces stands, and how many it has */
    bool some_large, no_memory;
} flood;

static void mark(flood *s, sl_int v, sl_int as) {
    if (int_list_add(&s->found, v)) {
        s->around->place[v] = as;
    } else {
        s->no_memory = true;
    }
}

/* The piece that v is in, until it ends, has more than `most` vertices, or meets one that is known to be large. */
static void flood_from(flood *s, sl_int v, size_t most) {
    const incidence *a = s->around;
    size_t first = s->found.count;
    bool is_large = false;
    mark(s, v, SMALL);
    for (size_t head = first; head < s->found.count && !is_large && !s->no_memory; head++) {
        sl_int u = s->found.at[head];
        for (sl_off p = a->begin[u]; p < a->begin[u + 1]; p++) {
            for (size_t c = 0; c < 3; c++) {
                sl_int w = a->m->faces[3 * (size_t)a->face[p] + c];
                is_large = is_large || a->place[w] == LARGE;
                if (a->place[w] == OUTSIDE && !s->no_memory) {
                    mark(s, w, SMALL);
                }
            }
        }
        is_large = is_large || s->found.count - first > most;
    }
    if (is_large) {
        for (size_t k = first; k < s->found.count; k++) {
            s->around->place[s->found.at[k]] = LARGE;
        }
        s->some_large = true;
    } else if (s->found.count - first > s->largest) {
        s->largest_at = first;
        s->largest = s->found.count - first;
    }
}

bool disk_enclosed(sl_int **vertices, sl_int *count, incidence *around, sl_int most) {
    flood s;
    memset(&s, 0, sizeof s);
    s.around = around;
    sl_int *list = *vertices, n = *count;
    for (sl_int k = 0; k < n; k++) {
        around->place[list[k]] = 0;
    }
    for (sl_int k = 0; k < n && !s.no_memory; k++) {
        for (sl_off p = around->begin[list[k]]; p < around->begin[list[k] + 1]; p++) {
            for (size_t c = 0; c < 3 && !s.no_memory; c++) {
                sl_int w = around->m->faces[3 * (size_t)around->face[p] + c];
                if (around->place[w] == OUTSIDE) {
                    flood_from(&s, w, (size_t)most);
                }
            }
        }
    }
    if (!s.some_large) { /* something must be left: the largest of all */
        for (size_t k = 0; k < s.largest; k++) {
            around->place[s.found.at[s.largest_at + k]] = LARGE;
        }
    }
    sl_int *larger =
        s.no_memory ? NULL
                    : (sl_int *)realloc(list, ((size_t)n + s.found.count + 1) * sizeof *larger);
    if (larger != NULL) {
        *vertices = larger;
        for (size_t k = 0; k < s.found.count; k++) {
            if (around->place[s.found.at[k]] == SMALL) {
                larger[(*count)++] = s.found.at[k];
            }
        }
    }
    for (sl_int k = 0; k < n; k++) {
        around->place[(*vertices)[k]] = OUTSIDE;
    }
    for (size_t k = 0; k < s.found.count; k++) {
        around->place[s.found.at[k]] = OUTSIDE;
    }
    free(s.found.at);
    return larger != NULL;
}

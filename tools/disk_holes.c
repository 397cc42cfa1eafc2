/* disk_holes.c: what a patch encloses: the pieces of the rest of the mesh that are smaller than the patch itself */
#include "disk_holes.h"

#include <stdlib.h>
#include <string.h>

enum {
    OUTSIDE = -1,
    SMALL = -2,
    LARGE = -3
}; /* place of a vertex off the patch; in the patch: 0 */

typedef struct flood {
    incidence *around;
    sl_int *found; /* all vertices marked SMALL or LARGE, piece after piece */
    size_t n_found, room;
    size_t largest_at,
        largest; /* where the largest of the small pieces stands, and how many it has */
    bool some_large, no_memory;
} flood;

static void mark(flood *s, sl_int v, sl_int as) {
    if (s->n_found == s->room) {
        size_t wanted = s->room < 64 ? 64 : 2 * s->room;
        sl_int *larger = (sl_int *)realloc(s->found, wanted * sizeof *larger);
        if (larger == NULL) {
            s->no_memory = true;
            return;
        }
        s->found = larger;
        s->room = wanted;
    }
    s->around->place[v] = as;
    s->found[s->n_found++] = v;
}

/* The piece that v is in, until it ends, has more than `most` vertices, or meets one that is known to be large. */
static void flood_from(flood *s, sl_int v, size_t most) {
    const incidence *a = s->around;
    size_t first = s->n_found;
    bool is_large = false;
    mark(s, v, SMALL);
    for (size_t head = first; head < s->n_found && !is_large && !s->no_memory; head++) {
        sl_int u = s->found[head];
        for (sl_off p = a->begin[u]; p < a->begin[u + 1]; p++) {
            for (size_t c = 0; c < 3; c++) {
                sl_int w = a->m->faces[3 * (size_t)a->face[p] + c];
                is_large = is_large || a->place[w] == LARGE;
                if (a->place[w] == OUTSIDE && !s->no_memory) {
                    mark(s, w, SMALL);
                }
            }
        }
        is_large = is_large || s->n_found - first > most;
    }
    if (is_large) {
        for (size_t k = first; k < s->n_found; k++) {
            s->around->place[s->found[k]] = LARGE;
        }
        s->some_large = true;
    } else if (s->n_found - first > s->largest) {
        s->largest_at = first;
        s->largest = s->n_found - first;
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
            around->place[s.found[s.largest_at + k]] = LARGE;
        }
    }
    sl_int *larger =
        s.no_memory ? NULL : (sl_int *)realloc(list, ((size_t)n + s.n_found + 1) * sizeof *larger);
    if (larger != NULL) {
        *vertices = larger;
        for (size_t k = 0; k < s.n_found; k++) {
            if (around->place[s.found[k]] == SMALL) {
                larger[(*count)++] = s.found[k];
            }
        }
    }
    for (sl_int k = 0; k < n; k++) {
        around->place[(*vertices)[k]] = OUTSIDE;
    }
    for (size_t k = 0; k < s.n_found; k++) {
        around->place[s.found[k]] = OUTSIDE;
    }
    free(s.found);
    return larger != NULL;
}

/* patch_holes.c: fills the holes of a patch: small pieces of the mesh that it encloses */
#include "patch_holes.h"

#include <stdlib.h>
#include <string.h>

#include "int_list.h"

/* local_index during the search: 0 in the patch, else not visited, or in a small or large piece */
enum { OUTSIDE = -1, SMALL = -2, LARGE = -3 };

typedef struct hole_search {
    incidence *inc;
    int_list found;             /* all vertices marked SMALL or LARGE, piece after piece */
    size_t largest_at, largest; /* the largest small piece: its position in found and its size */
    bool some_large, no_memory;
} hole_search;

static void mark(hole_search *s, sl_int v, sl_int as) {
    if (int_list_add(&s->found, v)) {
        s->inc->local_index[v] = as;
    } else {
        s->no_memory = true;
    }
}

/* Visits the piece of v until it is complete, has more than max_vertices vertices, or meets a piece
 * that is known to be large. */
static void visit_piece(hole_search *s, sl_int v, size_t max_vertices) {
    const incidence *a = s->inc;
    size_t first = s->found.count;
    bool is_large = false;
    mark(s, v, SMALL);
    for (size_t head = first; head < s->found.count && !is_large && !s->no_memory; head++) {
        sl_int u = s->found.at[head];
        for (sl_off p = a->begin[u]; p < a->begin[u + 1]; p++) {
            for (size_t c = 0; c < 3; c++) {
                sl_int w = a->m->faces[3 * (size_t)a->face[p] + c];
                is_large = is_large || a->local_index[w] == LARGE;
                if (a->local_index[w] == OUTSIDE && !s->no_memory) {
                    mark(s, w, SMALL);
                }
            }
        }
        is_large = is_large || s->found.count - first > max_vertices;
    }
    if (is_large) {
        for (size_t k = first; k < s->found.count; k++) {
            s->inc->local_index[s->found.at[k]] = LARGE;
        }
        s->some_large = true;
    } else if (s->found.count - first > s->largest) {
        s->largest_at = first;
        s->largest = s->found.count - first;
    }
}

bool patch_fill_holes(sl_int **vertices, sl_int *count, incidence *inc, sl_int max_vertices) {
    hole_search s;
    memset(&s, 0, sizeof s);
    s.inc = inc;
    sl_int *list = *vertices, n = *count;
    for (sl_int k = 0; k < n; k++) {
        inc->local_index[list[k]] = 0;
    }
    for (sl_int k = 0; k < n && !s.no_memory; k++) {
        for (sl_off p = inc->begin[list[k]]; p < inc->begin[list[k] + 1]; p++) {
            for (size_t c = 0; c < 3 && !s.no_memory; c++) {
                sl_int w = inc->m->faces[3 * (size_t)inc->face[p] + c];
                if (inc->local_index[w] == OUTSIDE) {
                    visit_piece(&s, w, (size_t)max_vertices);
                }
            }
        }
    }
    if (!s.some_large) { /* the largest piece is the outside */
        for (size_t k = 0; k < s.largest; k++) {
            inc->local_index[s.found.at[s.largest_at + k]] = LARGE;
        }
    }
    sl_int *larger =
        s.no_memory ? NULL
                    : (sl_int *)realloc(list, ((size_t)n + s.found.count + 1) * sizeof *larger);
    if (larger != NULL) {
        *vertices = larger;
        for (size_t k = 0; k < s.found.count; k++) {
            if (inc->local_index[s.found.at[k]] == SMALL) {
                larger[(*count)++] = s.found.at[k];
            }
        }
    }
    for (sl_int k = 0; k < n; k++) {
        inc->local_index[(*vertices)[k]] = OUTSIDE;
    }
    for (size_t k = 0; k < s.found.count; k++) {
        inc->local_index[s.found.at[k]] = OUTSIDE;
    }
    free(s.found.at);
    return larger != NULL;
}

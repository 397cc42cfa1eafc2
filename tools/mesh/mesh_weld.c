/* mesh_weld.c: merges vertices with equal coordinates while a mesh is read */
#include <stdlib.h>
#include <string.h>

#include "mesh_build.h"

typedef struct position {
    double x[3];
    sl_int vertex;
} position;

static bool same_position(const position *a, const position *b) {
    return a->x[0] == b->x[0] && a->x[1] == b->x[1] && a->x[2] == b->x[2];
}

static int by_position(const void *a, const void *b) {
    const position *p = (const position *)a, *q = (const position *)b;
    for (int d = 0; d < 3; d++) {
        if (p->x[d] != q->x[d]) {
            return p->x[d] < q->x[d] ? -1 : 1;
        }
    }
    return p->vertex < q->vertex ? -1 : p->vertex > q->vertex;
}

bool mesh_build_weld(mesh_build *b, sl_int first_vertex, sl_int first_face) {
    mesh *m = &b->result;
    size_t first = (size_t)first_vertex, n = (size_t)m->n_vertices - first;
    if (n == 0) {
        return true; /* there may be no arrays */
    }
    position *points = (position *)malloc(n * sizeof *points);
    sl_int *number = (sl_int *)malloc(n * sizeof *number);
    if (points == NULL || number == NULL) {
        free(points);
        free(number);
        return input_error(b->in, "out of memory");
    }
    double *xyz = m->xyz + 3 * first;
    for (size_t v = 0; v < n; v++) {
        memcpy(points[v].x, xyz + 3 * v, sizeof points[v].x);
        points[v].vertex = (sl_int)v;
    }
    qsort(points, n, sizeof *points, by_position);
    for (size_t k = 0; k < n; k++) { /* number[v]: the first vertex at its position */
        bool again = k > 0 && same_position(&points[k], &points[k - 1]);
        number[points[k].vertex] = again ? number[points[k - 1].vertex] : points[k].vertex;
    }
    sl_int kept = 0;
    for (size_t v = 0; v < n; v++) { /* renumber; a first vertex precedes its duplicates */
        if (number[v] == (sl_int)v) {
            memmove(xyz + 3 * (size_t)kept, xyz + 3 * v, 3 * sizeof *xyz);
            number[v] = kept++;
        } else {
            number[v] = number[number[v]];
        }
    }
    for (size_t k = 3 * (size_t)first_face; k < 3 * (size_t)m->n_faces; k++) {
        m->faces[k] = first_vertex + number[m->faces[k] - first_vertex];
    }
    m->n_vertices = first_vertex + kept;
    b->largest = m->n_vertices - 1; /* all corners were in range */
    free(number);
    free(points);
    return true;
}

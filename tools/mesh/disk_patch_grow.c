/* disk_patch_grow.c: grows a disk around a vertex, face by face in breadth-first order */
#include "disk_patch.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "patch_holes.h"
#include "int_list.h"

typedef struct growth {
    incidence *inc;
    sl_int *vertices, n_vertices, vertex_capacity;
    int_list faces;
    int_list queue; /* candidate faces; a face is queued again when a neighbor is added */
    size_t head;    /* of the queue */
    bool no_memory;
} growth;

static void take_vertex(growth *g, sl_int v) {
    if (g->inc->local_index[v] < 0 && g->n_vertices < g->vertex_capacity) {
        g->inc->local_index[v] = g->n_vertices;
        g->vertices[g->n_vertices++] = v;
    }
}

/* Adds a face to the disk and queues its neighbors. */
static void take_face(growth *g, sl_int face) {
    const sl_int *f = g->inc->m->faces + 3 * (size_t)face;
    if (!int_list_add(&g->faces, face)) {
        g->no_memory = true;
        return;
    }
    g->inc->face_mark[face] = 1;
    for (int c = 0; c < 3; c++) {
        take_vertex(g, f[c]);
    }
    for (int c = 0; c < 3; c++) {
        sl_int beside[8];
        sl_int count = incidence_edge_faces(g->inc, f[c], f[(c + 1) % 3], beside, 8);
        for (sl_int k = 0; k < count && k < 8; k++) {
            if (!g->inc->face_mark[beside[k]]) {
                g->no_memory = g->no_memory || !int_list_add(&g->queue, beside[k]);
            }
        }
    }
}

/* The number of faces of the disk at the edge (u, v): 0, 1, or 2 for two or more. */
static int count_disk_faces(const growth *g, sl_int u, sl_int v) {
    sl_int beside[8];
    sl_int count = incidence_edge_faces(g->inc, u, v, beside, 8);
    int found = count > 8 ? 2 : 0; /* the disk never grows across an edge with this many faces */
    for (sl_int k = 0; k < count && k < 8; k++) {
        found += g->inc->face_mark[beside[k]];
    }
    return found < 2 ? found : 2;
}

/* A disk plus a face is a disk again in two cases only: the face shares one edge and adds a new
 * vertex, or it shares two edges and the vertex between them. */
static bool stays_disk(const growth *g, sl_int face) {
    const sl_int *f = g->inc->m->faces + 3 * (size_t)face;
    int shared = 0, apex = -1;
    for (int c = 0; c < 3; c++) {
        int at = count_disk_faces(g, f[c], f[(c + 1) % 3]);
        if (at == 2) {
            return false;
        }
        if (at == 1) {
            shared++;
            apex = (c + 2) % 3;
        }
    }
    if (shared == 1) {
        return g->inc->local_index[f[apex]] < 0 && g->n_vertices < g->vertex_capacity;
    }
    return shared == 2;
}

static void grow(growth *g) {
    while (g->head < g->queue.count && !g->no_memory) {
        sl_int face = g->queue.at[g->head++];
        if (!g->inc->face_mark[face] && stays_disk(g, face)) {
            take_face(g, face);
        }
    }
}

/* The number of faces outside the disk whose corners all belong to it. */
static sl_int count_seam(const growth *g) {
    sl_int corners = 0;
    for (sl_int k = 0; k < g->n_vertices; k++) {
        const incidence *a = g->inc;
        for (sl_off p = a->begin[g->vertices[k]]; p < a->begin[g->vertices[k] + 1]; p++) {
            const sl_int *f = a->m->faces + 3 * (size_t)a->face[p];
            corners += !a->face_mark[a->face[p]] && a->local_index[f[0]] >= 0 &&
                       a->local_index[f[1]] >= 0 && a->local_index[f[2]] >= 0;
        }
    }
    return corners / 3;
}

/* The disk spanned by the vertices and those that they enclose: it has no seam. False: not a
 * disk. */
static bool close_seam(disk_patch *out, const growth *g) {
    sl_int count = g->n_vertices;
    sl_int *list = (sl_int *)malloc(((size_t)count + 1) * sizeof *list);
    if (list == NULL) {
        return false;
    }
    memcpy(list, g->vertices, (size_t)count * sizeof *list);
    bool ok = patch_fill_holes(&list, &count, g->inc, count) &&
              disk_patch_from_vertices(out, g->inc, list, count, NULL, 0);
    free(list);
    return ok;
}

static bool fail(char *message, size_t message_size, const char *reason, sl_int v) {
    (void)snprintf(message, message_size, reason, (int)v);
    return false;
}

bool disk_patch_grow(disk_patch *out, incidence *inc, sl_int start, sl_int count, sl_int *seam,
                     char *message, size_t message_size) {
    memset(out, 0, sizeof *out);
    if (start < 0 || start >= inc->m->n_vertices) {
        return fail(message, message_size,
                    "cannot grow a patch from vertex %d: the mesh has no such vertex", start);
    }
    if (inc->begin[start] == inc->begin[start + 1]) {
        return fail(message, message_size, "cannot grow a patch from vertex %d: it has no face",
                    start);
    }
    if (count < 3) {
        return fail(message, message_size,
                    "a patch of %d vertices is too small: 3 or more are needed", count);
    }
    growth g;
    sl_int left_out = 0;
    memset(&g, 0, sizeof g);
    g.inc = inc;
    g.vertex_capacity = count < inc->m->n_vertices ? count : inc->m->n_vertices;
    g.vertices = (sl_int *)malloc((size_t)g.vertex_capacity * sizeof *g.vertices);
    g.no_memory = g.vertices == NULL;
    if (!g.no_memory) {
        take_vertex(&g, start);
        take_face(&g, inc->face[inc->begin[start]]);
        grow(&g);
        left_out = count_seam(&g);
    }
    for (sl_int k = 0; k < g.n_vertices; k++) {
        inc->local_index[g.vertices[k]] = -1;
    }
    for (size_t k = 0; k < g.faces.count; k++) {
        inc->face_mark[g.faces.at[k]] = 0;
    }
    bool ok = !g.no_memory;
    if (ok) {
        ok = left_out > 0 && close_seam(out, &g);
        if (!ok) {
            ok = disk_patch_from_faces(out, inc, g.vertices, g.n_vertices, g.faces.at,
                                       (sl_int)g.faces.count, message, message_size);
        } else {
            left_out = 0;
        }
    } else {
        (void)snprintf(message, message_size, "out of memory");
    }
    if (seam != NULL) {
        *seam = left_out;
    }
    free(g.queue.at);
    free(g.faces.at);
    free(g.vertices);
    return ok;
}

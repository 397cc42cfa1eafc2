/* disk_grow.c: grows a disk around a vertex, face by face in breadth-first order */
#include "disk.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "disk_holes.h"
#include "int_list.h"

typedef struct growth {
    incidence *around;
    sl_int *vertices, n_vertices, vertex_room;
    int_list faces;
    int_list
        queue; /* faces that may be taken, in order; one comes again when one beside it is taken */
    size_t head; /* of the queue */
    bool no_memory;
} growth;

static void take_vertex(growth *g, sl_int v) {
    if (g->around->place[v] < 0 && g->n_vertices < g->vertex_room) {
        g->around->place[v] = g->n_vertices;
        g->vertices[g->n_vertices++] = v;
    }
}

/* Takes the face, and puts those beside it into the queue. */
static void take_face(growth *g, sl_int face) {
    const sl_int *f = g->around->m->faces + 3 * (size_t)face;
    if (!int_list_add(&g->faces, face)) {
        g->no_memory = true;
        return;
    }
    g->around->taken[face] = 1;
    for (int c = 0; c < 3; c++) {
        take_vertex(g, f[c]);
    }
    for (int c = 0; c < 3; c++) {
        sl_int beside[8];
        sl_int count = incidence_edge(g->around, f[c], f[(c + 1) % 3], beside, 8);
        for (sl_int k = 0; k < count && k < 8; k++) {
            if (!g->around->taken[beside[k]]) {
                g->no_memory = g->no_memory || !int_list_add(&g->queue, beside[k]);
            }
        }
    }
}

/* How many faces of the disk are at the edge (u, v): 0, 1, or 2 for more too. */
static int taken_at(const growth *g, sl_int u, sl_int v) {
    sl_int beside[8];
    sl_int count = incidence_edge(g->around, u, v, beside, 8);
    int found = count > 8 ? 2 : 0; /* an edge of so many faces is none to grow over */
    for (sl_int k = 0; k < count && k < 8; k++) {
        found += g->around->taken[beside[k]];
    }
    return found < 2 ? found : 2;
}

/* A disk and a face that shares one edge with it and a new vertex, or two edges with the vertex between them, make a
 * disk. Anything else does not. */
static bool stays_disk(const growth *g, sl_int face) {
    const sl_int *f = g->around->m->faces + 3 * (size_t)face;
    int shared = 0, apex = -1;
    for (int c = 0; c < 3; c++) {
        int at = taken_at(g, f[c], f[(c + 1) % 3]);
        if (at == 2) {
            return false;
        }
        if (at == 1) {
            shared++;
            apex = (c + 2) % 3;
        }
    }
    if (shared == 1) {
        return g->around->place[f[apex]] < 0 && g->n_vertices < g->vertex_room;
    }
    return shared == 2;
}

static void grow(growth *g) {
    while (g->head < g->queue.count && !g->no_memory) {
        sl_int face = g->queue.at[g->head++];
        if (!g->around->taken[face] && stays_disk(g, face)) {
            take_face(g, face);
        }
    }
}

/* Faces with all corners in the disk that are not in it. */
static sl_int count_seam(const growth *g) {
    sl_int corners = 0;
    for (sl_int k = 0; k < g->n_vertices; k++) {
        const incidence *a = g->around;
        for (sl_off p = a->begin[g->vertices[k]]; p < a->begin[g->vertices[k] + 1]; p++) {
            const sl_int *f = a->m->faces + 3 * (size_t)a->face[p];
            corners += !a->taken[a->face[p]] && a->place[f[0]] >= 0 && a->place[f[1]] >= 0 &&
                       a->place[f[2]] >= 0;
        }
    }
    return corners / 3;
}

/* The disk without its seam: with what it encloses, and all faces between. False: that is none. */
static bool close_up(disk *out, const growth *g) {
    sl_int count = g->n_vertices;
    sl_int *list = (sl_int *)malloc(((size_t)count + 1) * sizeof *list);
    if (list == NULL) {
        return false;
    }
    memcpy(list, g->vertices, (size_t)count * sizeof *list);
    bool ok = disk_enclosed(&list, &count, g->around, count) &&
              disk_of_list(out, g->around, list, count, NULL, 0);
    free(list);
    return ok;
}

static bool fail(char *message, size_t message_size, const char *reason, sl_int v) {
    (void)snprintf(message, message_size, reason, (int)v);
    return false;
}

bool disk_grow(disk *out, incidence *around, sl_int start, sl_int count, sl_int *seam,
               char *message, size_t message_size) {
    memset(out, 0, sizeof *out);
    if (start < 0 || start >= around->m->n_vertices) {
        return fail(message, message_size, "there is no vertex %d to grow a patch from", start);
    }
    if (around->begin[start] == around->begin[start + 1]) {
        return fail(message, message_size, "no face is at vertex %d: no patch grows from there",
                    start);
    }
    if (count < 3) {
        return fail(message, message_size, "a patch of %d vertices: 3 or more are needed", count);
    }
    growth g;
    sl_int left_out = 0;
    memset(&g, 0, sizeof g);
    g.around = around;
    g.vertex_room = count < around->m->n_vertices ? count : around->m->n_vertices;
    g.vertices = (sl_int *)malloc((size_t)g.vertex_room * sizeof *g.vertices);
    g.no_memory = g.vertices == NULL;
    if (!g.no_memory) {
        take_vertex(&g, start);
        take_face(&g, around->face[around->begin[start]]);
        grow(&g);
        left_out = count_seam(&g);
    }
    for (sl_int k = 0; k < g.n_vertices; k++) {
        around->place[g.vertices[k]] = -1;
    }
    for (size_t k = 0; k < g.faces.count; k++) {
        around->taken[g.faces.at[k]] = 0;
    }
    bool ok = !g.no_memory;
    if (ok) {
        ok = left_out > 0 && close_up(out, &g);
        if (!ok) {
            ok = disk_of_faces(out, around, g.vertices, g.n_vertices, g.faces.at,
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

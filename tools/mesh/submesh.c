/* part.c: a part of a mesh as a small mesh of its own, and where it is joined to the rest */
#include "part.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

void part_free(part *p) {
    mesh_free(&p->m);
    free(p->vertices);
    free(p->mesh_faces);
    free(p->rim);
    memset(p, 0, sizeof *p);
}

static bool part_allocate(part *p, sl_int n_vertices, sl_int n_faces) {
    size_t nv = (size_t)n_vertices, nf = (size_t)n_faces;
    memset(p, 0, sizeof *p);
    p->m.n_vertices = n_vertices;
    p->m.n_faces = n_faces;
    p->m.xyz = (double *)malloc((3 * nv + 1) * sizeof(double));
    p->m.faces = (sl_int *)malloc((3 * nf + 1) * sizeof(sl_int));
    p->vertices = (sl_int *)malloc((nv + 1) * sizeof(sl_int));
    p->mesh_faces = (sl_int *)malloc((nf + 1) * sizeof(sl_int));
    p->rim = (sl_int *)malloc((nv + 1) * sizeof(sl_int));
    if (p->m.xyz == NULL || p->m.faces == NULL || p->vertices == NULL || p->mesh_faces == NULL ||
        p->rim == NULL) {
        part_free(p);
        return false;
    }
    return true;
}

static void unmark(incidence *around, const sl_int *vertices, sl_int count) {
    for (sl_int k = 0; k < count; k++) {
        around->place[vertices[k]] = -1;
    }
}

/* A vertex is on the rim if more faces are around it in the mesh than in the part. */
static bool find_rim(part *p, const incidence *around) {
    sl_int *left = (sl_int *)malloc(((size_t)p->m.n_vertices + 1) * sizeof *left);
    if (left == NULL) {
        return false;
    }
    for (sl_int k = 0; k < p->m.n_vertices; k++) {
        sl_int v = p->vertices[k];
        left[k] = (sl_int)(around->begin[v + 1] - around->begin[v]);
    }
    for (size_t c = 0; c < 3 * (size_t)p->m.n_faces; c++) {
        left[p->m.faces[c]]--;
    }
    for (sl_int k = 0; k < p->m.n_vertices; k++) {
        if (left[k] > 0) {
            p->rim[p->n_rim++] = k;
        }
    }
    free(left);
    return true;
}

bool part_of_faces(part *out, incidence *around, const sl_int *vertices, sl_int n_vertices,
                   const sl_int *faces, sl_int n_faces) {
    if (!part_allocate(out, n_vertices, n_faces)) {
        return false;
    }
    for (sl_int k = 0; k < n_vertices; k++) {
        out->vertices[k] = vertices[k];
        around->place[vertices[k]] = k;
        memcpy(out->m.xyz + 3 * (size_t)k, around->m->xyz + 3 * (size_t)vertices[k],
               3 * sizeof(double));
    }
    for (sl_int f = 0; f < n_faces; f++) {
        out->mesh_faces[f] = faces[f];
        for (size_t c = 0; c < 3; c++) {
            sl_int v = around->m->faces[3 * (size_t)faces[f] + c];
            out->m.faces[3 * (size_t)f + c] = around->place[v];
        }
    }
    unmark(around, vertices, n_vertices);
    if (!find_rim(out, around)) {
        part_free(out);
        return false;
    }
    return true;
}

/* Faces all of whose corners are marked, each once (at its first corner in the list's order); NULL: out of memory. */
static sl_int *faces_between(const incidence *around, const sl_int *vertices, sl_int count,
                             sl_int *n_faces) {
    size_t room = 1, found = 0;
    for (sl_int k = 0; k < count; k++) {
        room += (size_t)(around->begin[vertices[k] + 1] - around->begin[vertices[k]]);
    }
    sl_int *faces = (sl_int *)malloc(room * sizeof *faces);
    for (sl_int k = 0; k < count && faces != NULL; k++) {
        for (sl_off p = around->begin[vertices[k]]; p < around->begin[vertices[k] + 1]; p++) {
            const sl_int *f = around->m->faces + 3 * (size_t)around->face[p];
            if (around->place[f[0]] >= k && around->place[f[1]] >= k && around->place[f[2]] >= k) {
                faces[found++] = around->face[p];
            }
        }
    }
    *n_faces = (sl_int)found;
    return faces;
}

bool part_span(part *out, incidence *around, const sl_int *vertices, sl_int count, char *message,
               size_t message_size) {
    memset(out, 0, sizeof *out);
    sl_int n = around->m->n_vertices, marked = 0;
    bool ok = true;
    for (; marked < count && ok; marked++) {
        sl_int v = vertices[marked];
        if (v < 0 || v >= n) {
            (void)snprintf(message, message_size, "vertex %d of a mesh of %d", (int)v, (int)n);
            ok = false;
            break;
        }
        if (around->place[v] >= 0) {
            (void)snprintf(message, message_size, "vertex %d is listed twice", (int)v);
            ok = false;
            break;
        }
        around->place[v] = marked;
    }
    sl_int n_faces = 0;
    sl_int *faces = ok ? faces_between(around, vertices, count, &n_faces) : NULL;
    unmark(around, vertices, marked);
    if (ok && (faces == NULL || !part_of_faces(out, around, vertices, count, faces, n_faces))) {
        (void)snprintf(message, message_size, "out of memory");
        ok = false;
    }
    free(faces);
    return ok;
}

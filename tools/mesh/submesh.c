/* submesh.c: some vertices and faces of a mesh as a mesh with local numbers, and its interface */
#include "submesh.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

void submesh_free(submesh *p) {
    mesh_free(&p->m);
    free(p->vertices);
    free(p->mesh_faces);
    free(p->lengths);
    free(p->interface);
    memset(p, 0, sizeof *p);
}

static bool part_allocate(submesh *p, sl_int n_vertices, sl_int n_faces) {
    size_t nv = (size_t)n_vertices, nf = (size_t)n_faces;
    memset(p, 0, sizeof *p);
    p->m.n_vertices = n_vertices;
    p->m.n_faces = n_faces;
    p->m.xyz = (double *)malloc((3 * nv + 1) * sizeof(double));
    p->m.faces = (sl_int *)malloc((3 * nf + 1) * sizeof(sl_int));
    p->vertices = (sl_int *)malloc((nv + 1) * sizeof(sl_int));
    p->mesh_faces = (sl_int *)malloc((nf + 1) * sizeof(sl_int));
    p->interface = (sl_int *)malloc((nv + 1) * sizeof(sl_int));
    if (p->m.xyz == NULL || p->m.faces == NULL || p->vertices == NULL || p->mesh_faces == NULL ||
        p->interface == NULL) {
        submesh_free(p);
        return false;
    }
    return true;
}

static void unmark(incidence *inc, const sl_int *vertices, sl_int count) {
    for (sl_int k = 0; k < count; k++) {
        inc->local_index[vertices[k]] = -1;
    }
}

/* A vertex belongs to the interface if it has more faces in the mesh than in the submesh. */
static bool find_interface(submesh *p, const incidence *inc) {
    sl_int *left = (sl_int *)malloc(((size_t)p->m.n_vertices + 1) * sizeof *left);
    if (left == NULL) {
        return false;
    }
    for (sl_int k = 0; k < p->m.n_vertices; k++) {
        sl_int v = p->vertices[k];
        left[k] = (sl_int)(inc->begin[v + 1] - inc->begin[v]);
    }
    for (size_t c = 0; c < 3 * (size_t)p->m.n_faces; c++) {
        left[p->m.faces[c]]--;
    }
    for (sl_int k = 0; k < p->m.n_vertices; k++) {
        if (left[k] > 0) {
            p->interface[p->n_interface++] = k;
        }
    }
    free(left);
    return true;
}

/* The lengths of the faces, if they have any. */
static bool copy_lengths(submesh *p, const incidence *inc) {
    size_t n_faces = (size_t)p->m.n_faces;
    if (inc->lengths == NULL) {
        return true;
    }
    p->lengths = (double *)malloc((3 * n_faces + 1) * sizeof *p->lengths);
    for (size_t f = 0; f < n_faces && p->lengths != NULL; f++) {
        memcpy(p->lengths + 3 * f, inc->lengths + 3 * (size_t)p->mesh_faces[f],
               3 * sizeof *p->lengths);
    }
    return p->lengths != NULL;
}

bool submesh_from_faces(submesh *out, incidence *inc, const sl_int *vertices, sl_int n_vertices,
                        const sl_int *faces, sl_int n_faces) {
    if (!part_allocate(out, n_vertices, n_faces)) {
        return false;
    }
    for (sl_int k = 0; k < n_vertices; k++) {
        out->vertices[k] = vertices[k];
        inc->local_index[vertices[k]] = k;
        memcpy(out->m.xyz + 3 * (size_t)k, inc->m->xyz + 3 * (size_t)vertices[k],
               3 * sizeof(double));
    }
    for (sl_int f = 0; f < n_faces; f++) {
        out->mesh_faces[f] = faces[f];
        for (size_t c = 0; c < 3; c++) {
            sl_int v = inc->m->faces[3 * (size_t)faces[f] + c];
            out->m.faces[3 * (size_t)f + c] = inc->local_index[v];
        }
    }
    unmark(inc, vertices, n_vertices);
    if (!copy_lengths(out, inc) || !find_interface(out, inc)) {
        submesh_free(out);
        return false;
    }
    return true;
}

/* The faces whose corners are all numbered. Each is found once, at its corner with the lowest
 * number. Returns NULL if out of memory. */
static sl_int *faces_between(const incidence *inc, const sl_int *vertices, sl_int count,
                             sl_int *n_faces) {
    size_t capacity = 1, found = 0;
    for (sl_int k = 0; k < count; k++) {
        capacity += (size_t)(inc->begin[vertices[k] + 1] - inc->begin[vertices[k]]);
    }
    sl_int *faces = (sl_int *)malloc(capacity * sizeof *faces);
    for (sl_int k = 0; k < count && faces != NULL; k++) {
        sl_off first = inc->begin[vertices[k]];
        for (sl_off p = first; p < inc->begin[vertices[k] + 1]; p++) {
            if (p > first && inc->face[p] == inc->face[p - 1]) {
                continue; /* a face with this vertex at two corners */
            }
            const sl_int *f = inc->m->faces + 3 * (size_t)inc->face[p];
            if (inc->local_index[f[0]] >= k && inc->local_index[f[1]] >= k &&
                inc->local_index[f[2]] >= k) {
                faces[found++] = inc->face[p];
            }
        }
    }
    *n_faces = (sl_int)found;
    return faces;
}

bool submesh_from_vertices(submesh *out, incidence *inc, const sl_int *vertices, sl_int count,
                           char *message, size_t message_size) {
    memset(out, 0, sizeof *out);
    sl_int n = inc->m->n_vertices, marked = 0;
    bool ok = true;
    for (; marked < count && ok; marked++) {
        sl_int v = vertices[marked];
        if (v < 0 || v >= n) {
            (void)snprintf(message, message_size,
                           "vertex %d is out of range: the mesh has %d vertices", (int)v, (int)n);
            ok = false;
            break;
        }
        if (inc->local_index[v] >= 0) {
            (void)snprintf(message, message_size, "vertex %d is listed twice", (int)v);
            ok = false;
            break;
        }
        inc->local_index[v] = marked;
    }
    sl_int n_faces = 0;
    sl_int *faces = ok ? faces_between(inc, vertices, count, &n_faces) : NULL;
    unmark(inc, vertices, marked);
    if (ok && (faces == NULL || !submesh_from_faces(out, inc, vertices, count, faces, n_faces))) {
        (void)snprintf(message, message_size, "out of memory");
        ok = false;
    }
    free(faces);
    return ok;
}

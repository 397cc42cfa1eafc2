/* repeated_faces.c: a mesh without faces whose three vertices are those of an earlier face */
#include "repeated_faces.h"

#include <stdlib.h>
#include <string.h>

/* A face by its vertices in ascending order. */
typedef struct sorted_face {
    sl_int v[3];
    sl_int face;
} sorted_face;

static sorted_face sort_corners(const sl_int *corners, sl_int face) {
    sorted_face s = {{corners[0], corners[1], corners[2]}, face};
    for (int k = 0; k < 3; k++) { /* 0 and 1, 1 and 2, 0 and 1 again */
        sl_int *a = &s.v[k % 2], *b = &s.v[k % 2 + 1];
        if (*a > *b) {
            const sl_int swapped = *a;
            *a = *b;
            *b = swapped;
        }
    }
    return s;
}

static int by_vertices(const void *a, const void *b) {
    const sorted_face *p = (const sorted_face *)a, *q = (const sorted_face *)b;
    for (int k = 0; k < 3; k++) {
        if (p->v[k] != q->v[k]) {
            return p->v[k] < q->v[k] ? -1 : 1;
        }
    }
    return p->face < q->face ? -1 : p->face > q->face;
}

bool mesh_without_repeated_faces(mesh *out, const mesh *m, sl_int *removed) {
    const size_t n = (size_t)m->n_vertices, count = (size_t)m->n_faces;
    sorted_face *sorted = (sorted_face *)malloc((count + 1) * sizeof *sorted);
    unsigned char *is_repeated = (unsigned char *)calloc(count + 1, 1);
    memset(out, 0, sizeof *out);
    out->xyz = (double *)malloc((3 * n + 1) * sizeof *out->xyz);
    out->faces = (sl_int *)malloc((3 * count + 1) * sizeof *out->faces);
    const bool ok = sorted != NULL && is_repeated != NULL && out->xyz != NULL && out->faces != NULL;
    for (size_t f = 0; f < count && ok; f++) {
        sorted[f] = sort_corners(m->faces + 3 * f, (sl_int)f);
    }
    if (ok) {
        qsort(sorted, count, sizeof *sorted, by_vertices);
    }
    for (size_t f = 1; f < count && ok; f++) {
        is_repeated[sorted[f].face] = memcmp(sorted[f].v, sorted[f - 1].v, sizeof sorted[f].v) == 0;
    }
    if (ok && n > 0) {
        memcpy(out->xyz, m->xyz, 3 * n * sizeof *out->xyz);
        out->n_vertices = m->n_vertices;
    }
    for (size_t f = 0; f < count && ok; f++) {
        if (!is_repeated[f]) {
            memcpy(out->faces + 3 * (size_t)out->n_faces, m->faces + 3 * f, 3 * sizeof(sl_int));
            out->n_faces++;
        }
    }
    free(is_repeated);
    free(sorted);
    if (!ok) {
        mesh_free(out);
    } else if (removed != NULL) {
        *removed = m->n_faces - out->n_faces;
    }
    return ok;
}

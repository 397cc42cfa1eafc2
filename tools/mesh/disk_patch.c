/* disk_patch.c: checks that a submesh is a disk, orients its faces and finds its boundary loop */
#include "disk_patch.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* A side of a face: a directed edge in the face's orientation. */
typedef struct side {
    sl_int low, high; /* its two vertices, low < high */
    sl_int face;
    sl_int from; /* the vertex where it starts */
} side;

typedef struct disk_check {
    disk_patch *d;
    side *sides; /* 3 n_faces, sorted: the sides of an edge are adjacent */
    /* 3 n_faces, at 3 face + corner: the side of the same edge in the other face, -1: none */
    sl_int *next;
    sl_int *work; /* 3 n_faces + n_vertices + 2 */
    char *message;
    size_t message_size;
} disk_check;

static int by_edge(const void *a, const void *b) {
    const side *s = (const side *)a, *t = (const side *)b;
    if (s->low != t->low) {
        return s->low < t->low ? -1 : 1;
    }
    if (s->high != t->high) {
        return s->high < t->high ? -1 : 1;
    }
    return (s->face > t->face) - (s->face < t->face);
}

void disk_patch_free(disk_patch *d) {
    submesh_free(&d->p);
    free(d->boundary);
    memset(d, 0, sizeof *d);
}

static sl_int mesh_vertex(const disk_check *q, sl_int v) {
    return q->d->p.vertices[v];
}

static bool fail(const disk_check *q, const char *reason) {
    (void)snprintf(q->message, q->message_size, "the patch is not a disk: %s", reason);
    return false;
}

static bool fail_at_vertex(const disk_check *q, const char *reason, sl_int v) {
    (void)snprintf(q->message, q->message_size, "the patch is not a disk: %s vertex %d", reason,
                   (int)mesh_vertex(q, v));
    return false;
}

/* The side of face f that starts at vertex `from`, as 3 face + corner. */
static sl_int side_from(const disk_check *q, sl_int f, sl_int from) {
    const sl_int *face = q->d->p.m.faces + 3 * (size_t)f;
    return 3 * f + (face[0] == from ? 0 : face[1] == from ? 1 : 2);
}

/* Sorts the sides and pairs the two sides of each interior edge. */
static bool pair_sides(disk_check *q) {
    const mesh *m = &q->d->p.m;
    size_t count = 3 * (size_t)m->n_faces;
    for (size_t k = 0; k < count; k++) {
        sl_int u = m->faces[k], v = m->faces[k / 3 * 3 + (k + 1) % 3];
        side s = {u < v ? u : v, u < v ? v : u, (sl_int)(k / 3), u};
        q->sides[k] = s;
        q->next[k] = -1;
    }
    qsort(q->sides, count, sizeof *q->sides, by_edge);
    for (size_t k = 0; k + 1 < count; k++) {
        const side *s = &q->sides[k], *t = s + 1;
        if (s->low != t->low || s->high != t->high) {
            continue;
        }
        if (k + 2 < count && t[1].low == s->low && t[1].high == s->high) {
            (void)snprintf(
                q->message, q->message_size,
                "the patch is not a disk: the edge of vertices %d and %d has three faces",
                (int)mesh_vertex(q, s->low), (int)mesh_vertex(q, s->high));
            return false;
        }
        sl_int a = side_from(q, s->face, s->from), b = side_from(q, t->face, t->from);
        q->next[a] = b;
        q->next[b] = a;
    }
    return true;
}

/* Visits all faces from face 0 in breadth-first order and gives them its orientation.
 * turn: +1 keep the face, -1 reverse it, 0 not visited. */
static bool orient_faces(disk_check *q) {
    sl_int n_faces = q->d->p.m.n_faces, found = 1;
    sl_int *queue = q->work, *turn = q->work + n_faces, *faces = q->d->p.m.faces;
    memset(turn, 0, (size_t)n_faces * sizeof *turn);
    queue[0] = 0;
    turn[0] = 1;
    for (sl_int head = 0; head < found; head++) {
        sl_int f = queue[head];
        for (sl_int c = 0; c < 3; c++) {
            sl_int other = q->next[3 * f + c];
            if (other < 0) {
                continue;
            }
            /* two sides in the same direction mean opposite orientations */
            sl_int wanted = faces[3 * f + c] == faces[other] ? -turn[f] : turn[f];
            if (turn[other / 3] == 0) {
                turn[other / 3] = wanted;
                queue[found++] = other / 3;
            } else if (turn[other / 3] != wanted) {
                return fail(q, "it has one side only, like a Moebius strip");
            }
        }
    }
    if (found < n_faces) {
        return fail(q, "its faces form several pieces that share no edge");
    }
    for (sl_int f = 0; f < n_faces; f++) {
        if (turn[f] < 0) { /* sides 0 and 2 are swapped: the pairs are no longer used */
            sl_int v = faces[3 * f + 1];
            faces[3 * f + 1] = faces[3 * f + 2];
            faces[3 * f + 2] = v;
        }
    }
    return true;
}

/* The unpaired sides form the boundary: each vertex starts at most one, and all form one loop. */
static bool find_boundary(disk_check *q, sl_int edges) {
    disk_patch *d = q->d;
    const mesh *m = &d->p.m;
    sl_int *after = q->work, sides = 0, start = -1;
    for (sl_int v = 0; v < m->n_vertices; v++) {
        after[v] = -1;
    }
    for (size_t k = 0; k < 3 * (size_t)m->n_faces; k++) {
        sl_int u = m->faces[k], v = m->faces[k / 3 * 3 + (k + 1) % 3];
        side key = {u < v ? u : v, u < v ? v : u, (sl_int)(k / 3), u};
        const side *s =
            (const side *)bsearch(&key, q->sides, 3 * (size_t)m->n_faces, sizeof key, by_edge);
        bool paired = (s > q->sides && s[-1].low == key.low && s[-1].high == key.high) ||
                      (s + 1 < q->sides + 3 * (size_t)m->n_faces && s[1].low == key.low &&
                       s[1].high == key.high);
        if (paired) {
            continue;
        }
        if (after[u] >= 0) {
            return fail_at_vertex(q, "it touches itself at", u);
        }
        after[u] = v;
        start = start < 0 || u < start ? u : start;
        sides++;
    }
    if (sides == 0) {
        return fail(q, "it is closed: it has no boundary");
    }
    d->boundary = (sl_int *)malloc((size_t)sides * sizeof *d->boundary);
    if (d->boundary == NULL) {
        (void)snprintf(q->message, q->message_size, "out of memory");
        return false;
    }
    for (sl_int v = start; d->n_boundary == 0 || v != start; v = after[v]) {
        d->boundary[d->n_boundary++] = v;
    }
    if (d->n_boundary < sides) {
        return fail(q, "it has more than one boundary, like a ring");
    }
    if (m->n_vertices - edges + m->n_faces != 1) {
        return fail(q, "it has a handle, or touches itself at an interior vertex");
    }
    return true;
}

static bool inspect(disk_check *q) {
    const mesh *m = &q->d->p.m;
    if (m->n_faces == 0) {
        return fail(q, "no face has all its corners in the patch");
    }
    memset(q->work, 0, ((size_t)m->n_vertices + 1) * sizeof *q->work);
    for (size_t k = 0; k < 3 * (size_t)m->n_faces; k++) {
        q->work[m->faces[k]] = 1;
    }
    for (sl_int v = 0; v < m->n_vertices; v++) {
        if (!q->work[v]) {
            return fail_at_vertex(q, "it has no face at", v);
        }
    }
    if (!pair_sides(q)) {
        return false;
    }
    sl_int edges = 0;
    for (sl_int k = 0; k < 3 * m->n_faces; k++) {
        edges += q->next[k] < k; /* the later side of a pair counts, and each unpaired side (-1) */
    }
    return orient_faces(q) && find_boundary(q, edges);
}

/* Completes the disk from its submesh d->p. Frees d on error. */
static bool finish(disk_patch *d, char *message, size_t message_size) {
    size_t sides = 3 * (size_t)d->p.m.n_faces;
    disk_check q = {d, NULL, NULL, NULL, message, message_size};
    q.sides = (side *)malloc((sides + 1) * sizeof *q.sides);
    q.next = (sl_int *)malloc((sides + 1) * sizeof *q.next);
    q.work = (sl_int *)malloc((sides + (size_t)d->p.m.n_vertices + 2) * sizeof *q.work);
    bool ok = q.sides != NULL && q.next != NULL && q.work != NULL;
    if (ok) {
        ok = inspect(&q);
    } else {
        (void)snprintf(message, message_size, "out of memory");
    }
    free(q.sides);
    free(q.next);
    free(q.work);
    if (!ok) {
        disk_patch_free(d);
    }
    return ok;
}

bool disk_patch_from_vertices(disk_patch *out, incidence *inc, const sl_int *vertices, sl_int count,
                              char *message, size_t message_size) {
    memset(out, 0, sizeof *out);
    return submesh_from_vertices(&out->p, inc, vertices, count, message, message_size) &&
           finish(out, message, message_size);
}

bool disk_patch_from_faces(disk_patch *out, incidence *inc, const sl_int *vertices,
                           sl_int n_vertices, const sl_int *faces, sl_int n_faces, char *message,
                           size_t message_size) {
    memset(out, 0, sizeof *out);
    if (!submesh_from_faces(&out->p, inc, vertices, n_vertices, faces, n_faces)) {
        (void)snprintf(message, message_size, "out of memory");
        return false;
    }
    return finish(out, message, message_size);
}
